//! Bayesian inference of what a model leaves out: the posterior of candidate effects, of a departure
//! that none of them explains, and of the data's noise, given measured data and their uncertainties.
//!
//! A [`Case`] holds data, model and candidates. [`setup`] maps its unknowns to standard normal scores,
//! [`likelihood`] and [`covariance`] weigh the data, [`integral`] integrates over the unknowns of a
//! hypothesis, [`posterior`] compares the hypotheses, and [`noise`] weighs them with every noise that the
//! data may have. What is told of them is the diagnosis's, in the crate above.
// the expected values of tests may be as inexact as the platform
#![cfg_attr(test, allow(clippy::disallowed_methods))]
#![allow(clippy::needless_range_loop)] // lanes and small matrices read best by their places

pub mod beside;
mod case;
mod case_check;
pub mod correlated;
pub mod covariance;
pub mod data;
pub mod discrepancy;
pub mod equivalent;
mod evaluators;
pub mod expected_entropy;
mod history;
pub mod integral;
pub mod latent;
pub mod likelihood;
pub mod linear_point;
pub mod logarithm;
pub mod metric;
pub mod model;
pub mod noise;
pub mod posterior;
pub mod predict;
pub mod reachable;
mod replication;
pub mod scan;
pub mod setup;
pub mod shape;
mod simulated_outputs;
mod simulator;
pub mod simulator_states;
pub mod tangent;
pub mod term_evidence;
mod whitened;

pub use case::{Candidate, Case, ObservedOutput, Prior};
pub use history::{History, HistoryKind};
pub use model::{Effect, ModelForm, OverridableModel, OverrideError};
pub use replication::{MOST_GROUPS, OwnSizes, Replication};
pub use simulator::{LinearAt, SimulatorModel, simulator_conditions};

#[cfg(test)]
mod tests;
