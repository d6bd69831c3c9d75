//! The gap between a model and measured data: whether the data depart by more than the uncertainties
//! explain, where, which effect is missing, and how far the gap shrinks once it is added.
// the expected values of tests may be as inexact as the platform
#![cfg_attr(test, allow(clippy::disallowed_methods))]
#![allow(clippy::needless_range_loop)] // lanes and small matrices read best by their places

pub mod check;
mod composed;
mod departure;
mod departure_prediction;
mod diagnose;
mod diagnosis;
mod far_input;
mod goodness_of_fit;
mod known_gap;
mod next;
mod notes;
mod parameters;
mod periodic_residuals;
mod prior_conflict;
mod replication;
mod row_drift;
mod selection;
mod shares;
mod shrink;
pub mod simulated;
mod strength;
mod turns;
mod unit_slip;
mod unlisted;
mod weighed;
mod weighed_noise;

pub use composed::{ComposedEffect, ComposedParameter, ComposedPrior, ComposedTerm};
pub use diagnose::{DiagnosisOptions, diagnose, diagnose_until};
pub use diagnosis::{
    DepartureForm, DepartureKind, DepartureOver, DepartureShape, DescribedEffect, Diagnosis,
    DiagnosisNote, EffectParameter, EstimatedNoise, GapPart, GapShare, GapStrength, GapTest,
    Hypothesis, HypothesisKind, LeftBeside, MostProbable, NamedQuantity, NextMeasurements,
    NoiseEstimate, OutputCorrelation, Predicted, PresentEffect, PriorConflict, ProposalKind,
    ProposedMeasurement, ReplicatedEffect, ReplicatedEffects, RowGap, RunAtVerdict,
    SerialCorrelation, SettingError, Shrinkage, Shrunk, SimulatorReport, StrengthPart,
    SuspectValue, UncertaintyFactor, UnlistedEffect, ValueGap,
};
pub use gumption_inference::noise::prior_widths::is_whole_turn;
pub use gumption_inference::scan::GapRegion;
pub use gumption_inference::shape::ComposedForm;
pub use gumption_inference::{
    Candidate, Case, Effect, History, HistoryKind, MOST_GROUPS, ModelForm, ObservedOutput,
    OverridableModel, OverrideError, OwnSizes, Prior, Replication, SimulatorModel,
    simulator_conditions,
};
pub use selection::{ModelSelection, noise, nominal, select_model};

#[cfg(test)]
mod tests;
