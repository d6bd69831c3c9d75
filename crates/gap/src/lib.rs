//! The gap between a model and measured data: whether the data depart by more than the uncertainties
//! explain, where, which effect is missing, and how far the gap shrinks once it is added.
// the expected values of tests may be as inexact as the platform
#![cfg_attr(test, allow(clippy::disallowed_methods))]
#![allow(clippy::needless_range_loop)] // lanes and small matrices read best by their places

mod case;
pub mod check;
mod composed;
mod correlated;
mod covariance;
mod data;
mod departure;
mod departure_prediction;
mod diagnose;
mod diagnosis;
mod differential_evolution;
mod discrepancy;
mod evidence;
mod evidence_error;
mod exploration;
mod goodness_of_fit;
mod latent;
mod likelihood;
mod logarithm;
mod mixture;
mod model;
mod next;
mod noise_model;
mod notes;
mod parameters;
mod posterior;
mod predict;
mod prior_conflict;
mod profile_path;
mod response_scan;
mod scan;
mod search;
mod selection;
mod setup;
mod shrink;
mod weighed;
mod weighed_noise;
mod whitened;

pub use case::{Candidate, Case, ObservedOutput, Prior};
pub use composed::{ComposedEffect, ComposedForm, ComposedParameter, ComposedPrior, ComposedTerm};
pub use diagnose::{DiagnosisOptions, diagnose};
pub use diagnosis::{
    DepartureForm, DepartureKind, DepartureOver, DepartureShape, Diagnosis, DiagnosisNote,
    EffectParameter, EstimatedNoise, GapRegion, GapTest, Hypothesis, HypothesisKind, MostProbable,
    NamedQuantity, NextMeasurement, NoiseEstimate, Predicted, PresentEffect, PriorConflict, RowGap,
    SerialCorrelation, Shrinkage, Shrunk, SuspectValue, UncertaintyFactor, ValueGap,
};
pub use model::{Effect, ModelForm, OverridableModel, OverrideError};
pub use selection::{ModelSelection, noise, nominal, select_model};

#[cfg(test)]
mod tests;
