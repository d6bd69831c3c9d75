//! The gap between a model and measured data: whether the data depart by more than the uncertainties
//! explain, where, which effect is missing, and how far the gap shrinks once it is added.
// the expected values of tests may be as inexact as the platform
#![cfg_attr(test, allow(clippy::disallowed_methods))]
#![allow(clippy::needless_range_loop)] // lanes and small matrices read best by their places

mod beside_departure;
mod case;
mod case_check;
pub mod check;
mod common_noise;
mod composed;
mod copies;
mod correlated;
mod covariance;
mod data;
mod departure;
mod departure_prediction;
mod diagnose;
mod diagnosis;
mod differential_evolution;
mod discrepancy;
mod equivalent;
mod evaluators;
mod evidence;
mod evidence_error;
mod expected_entropy;
mod exploration;
mod far_input;
mod goodness_of_fit;
mod influence;
mod latent;
mod likelihood;
mod line_profile;
mod logarithm;
mod mixture;
mod model;
mod needless;
mod next;
mod noise_model;
mod notes;
mod over_noises;
mod parameters;
mod periodic_residuals;
mod posterior;
mod predict;
mod prior_conflict;
mod prior_widths;
mod profile_path;
mod reachable;
mod remainder;
mod replication;
mod resolution;
mod response_scan;
mod row_drift;
mod scan;
mod search;
mod selection;
mod setup;
mod shared_noise;
mod shrink;
mod strength;
mod suspects;
mod turns;
mod unit_slip;
mod unlisted;
mod weighed;
mod weighed_noise;
mod whitened;

pub use case::{Candidate, Case, ObservedOutput, Prior};
pub use composed::{ComposedEffect, ComposedForm, ComposedParameter, ComposedPrior, ComposedTerm};
pub use diagnose::{DiagnosisOptions, diagnose, diagnose_until};
pub use diagnosis::{
    DepartureForm, DepartureKind, DepartureOver, DepartureShape, DescribedEffect, Diagnosis,
    DiagnosisNote, EffectParameter, EstimatedNoise, GapRegion, GapStrength, GapTest, Hypothesis,
    HypothesisKind, MostProbable, NamedQuantity, NextMeasurements, NoiseEstimate,
    OutputCorrelation, Predicted, PresentEffect, PriorConflict, ProposalKind, ProposedMeasurement,
    ReplicatedEffect, ReplicatedEffects, RowGap, SerialCorrelation, SettingError, Shrinkage,
    Shrunk, StrengthPart, SuspectValue, UncertaintyFactor, UnlistedEffect, ValueGap,
};
pub use model::{Effect, ModelForm, OverridableModel, OverrideError};
pub use replication::{MOST_GROUPS, OwnSizes, Replication};
pub use selection::{ModelSelection, noise, nominal, select_model};

#[cfg(test)]
mod tests;
