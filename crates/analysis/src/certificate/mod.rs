//! Calibration certificates: evaluations as statements of a laboratory.
//!
//! [`issue`] evaluates the models of a [`Certificate`](crate::certificate::contents::Certificate)
//! and gives a [`Statement`] for each row of its table: value, expanded uncertainty, coverage
//! factor, and their [`Basis`]. [`rounding`] rounds them to the digits of a certificate.
//! [`Issued::correlations`] gives the correlations between rows, so that the difference of two rows
//! gets the right uncertainty.

pub mod contents;
mod correlations;
mod issue;
pub mod rounding;
mod statement;

pub use gumption_engine::propagate::Basis;
pub use issue::{Failed, Issued, issue};
pub use statement::{Limit, Statement};
