//! Calibration certificates: evaluations turned into what a laboratory states.
//!
//! [`issue`] evaluates the models of a [`Certificate`](crate::certificate::contents::Certificate) and
//! gives a [`Statement`] for each row of its table: value, expanded uncertainty, coverage factor, and
//! what they rest on ([`Basis`]). [`rounding`] brings them to the digits of a certificate, and
//! [`Issued::correlations`] says how the rows vary together, so that the difference of two of them
//! gets its right uncertainty.

pub mod contents;
mod correlations;
mod issue;
pub mod rounding;
mod statement;

pub use gumption_engine::propagate::Basis;
pub use issue::{Failed, Issued, issue};
pub use statement::{Limit, Statement};
