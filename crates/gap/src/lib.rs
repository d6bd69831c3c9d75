//! The sim-to-real gap: whether measured data depart from a sim by more than its uncertainties
//! explain, where, which effect is missing, and how far the gap shrinks once it is added.
#![allow(clippy::disallowed_methods)] // elementary functions of the platform, to be replaced
#![allow(clippy::needless_range_loop)] // lanes and small matrices read best by their places

mod answer;
mod case;
pub mod check;
mod correlated;
mod covariance;
mod data;
mod diagnose;
mod diagnosis;
mod discrepancy;
mod doubt;
mod evidence;
mod latent;
mod likelihood;
mod mixture;
mod next;
mod posterior;
mod predict;
mod ridge;
mod roam;
mod scan;
mod search;
mod setup;
mod shrink;
mod sim;

pub use answer::{Answer, answer, noise, nominal};
pub use case::{Candidate, Case, Observed, Prior};
pub use diagnose::{Options, diagnose};
pub use diagnosis::{
    Diagnosis, Gap, Hypothesis, Kind, Named, NextMeasurement, Noise, Note, Parameter, Predicted,
    Region, RowGap, Shrinkage, Shrunk, ValueGap, Verdict,
};
pub use sim::{Circular, Effect, Maker, Sim};

#[cfg(test)]
mod tests;
