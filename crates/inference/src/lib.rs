//! Bayesian inference of what a model leaves out: the posterior of candidate effects, of a departure
//! that none of them explains, and of the data's noise, given measured data and their uncertainties.
//!
//! A [`Case`] holds data, model and candidates. [`setup`] maps its unknowns to standard normal scores,
//! [`likelihood`] and [`covariance`] weigh the data, [`search`] and [`evidence`] integrate over the
//! unknowns, and [`posterior`] compares the hypotheses. What is told of them is the diagnosis's, in the
//! crate above.
// the expected values of tests may be as inexact as the platform
#![cfg_attr(test, allow(clippy::disallowed_methods))]
#![allow(clippy::needless_range_loop)] // lanes and small matrices read best by their places

pub mod beside;
mod beside_departure;
mod case;
mod case_check;
pub mod common_noise;
mod common_noise_search;
pub mod copies;
pub mod correlated;
pub mod covariance;
pub mod data;
mod differential_evolution;
pub mod discrepancy;
pub mod equivalent;
mod evaluators;
pub mod evidence;
mod evidence_error;
pub mod expected_entropy;
mod exploration;
mod history;
mod influence;
pub mod latent;
pub mod likelihood;
mod line_profile;
pub mod logarithm;
pub mod metric;
pub mod mixture;
pub mod model;
mod needless;
pub mod noise_model;
pub mod over_noises;
pub mod posterior;
pub mod predict;
pub mod prior_widths;
mod profile_path;
pub mod reachable;
pub mod remainder;
mod replication;
pub mod resolution;
mod response_scan;
pub mod scan;
pub mod search;
pub mod setup;
pub mod shape;
pub mod shared_noise;
pub mod shared_noise_search;
mod suspects;
pub mod term_evidence;
pub mod weighing;
pub mod weighings;
mod whitened;

pub use case::{Candidate, Case, ObservedOutput, Prior};
pub use history::{History, HistoryKind};
pub use model::{Effect, ModelForm, OverridableModel, OverrideError};
pub use replication::{MOST_GROUPS, OwnSizes, Replication};

#[cfg(test)]
mod tests;
