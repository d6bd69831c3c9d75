//! What the reader of inputs finds, and what correlations, paired readings and shared values are
//! read against.

use std::ops::Range;

use super::codata::MeasuredConstant;
use super::dcc::Certified;
use super::known::KnownVariables;
use super::model_readings::ModelReadings;
use gumption_engine::model::InputQuantity;
use gumption_engine::task::{Evidence, Variable, Warning};

/// The inputs of a file.
#[derive(Debug, Default)]
pub(super) struct InputSet {
    pub(super) quantities: Vec<InputQuantity>,
    pub variables: Vec<Variable>,
    /// The key of each variable, for messages.
    pub(super) places: Vec<Range<usize>>,
    /// The key of each quantity.
    pub(super) quantity_places: Vec<Range<usize>>,
    /// What is known about the variables in each row.
    pub(super) known: KnownVariables,
    pub(super) warnings: Vec<Warning>,
    /// Quantities whose unit could not be read: they fit every dimension.
    pub(super) without_unit: Vec<String>,
    /// Quantities of which no unit is said.
    pub(super) unstated: Vec<String>,
    /// The files of samples that were read: name and content.
    pub(super) files: Vec<(String, Vec<u8>)>,
    /// Variables with the name of a file that what is known of them was read from.
    pub(super) read_from: Vec<(usize, String)>,
    /// The variables with readings, by name, and what of a file of readings they have taken.
    pub(super) readings: ModelReadings,
    /// Those whose readings come from a file that replaces what the model says.
    pub(super) replaced: Vec<String>,
    /// The variables whose readings are said to be paired.
    pub(super) paired: Vec<usize>,
    /// The first variable of the parts of a complex quantity, with the correlation coefficient of the
    /// two and its place.
    pub(super) pairs: Vec<(usize, f64, Range<usize>)>,
    /// Variables, by name, that are results of a certificate which says how its results vary together,
    /// with the name of its file.
    pub(super) certified: Vec<(String, Certified, String)>,
    /// The variables that are measured constants.
    pub(super) constants: Vec<(usize, &'static MeasuredConstant)>,
    /// Variables, by name, that are values of a certificate, with their place in it.
    pub(super) from_certificates: Vec<(String, String)>,
    /// Readings that distributions are to be tested against.
    pub(super) evidence: Vec<Evidence>,
}
