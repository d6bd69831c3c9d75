//! The contents of a calibration certificate: results, device and form.

mod administrative;
mod form;

pub use administrative::{AdministrativeData, Device, Party, PerformanceLocation};
pub use form::{DecimalMark, Language, Localized, Rounding};

use std::sync::Arc;

use gumption_engine::model::Capability;
use gumption_engine::regression::CurveFunction;
use gumption_engine::task::{Coverage, Task};

/// The contents of a certificate.
#[derive(Clone, Debug)]
pub struct Certificate {
    /// Device, parties, dates and texts.
    pub administrative: AdministrativeData,
    /// The languages of its sentences; at least one.
    pub languages: Vec<Language>,
    /// The decimal mark of all pages: one for the whole certificate, so that a number looks the same
    /// in its table and in every language's sentences.
    pub decimal_mark: DecimalMark,
    /// How expanded uncertainties are rounded.
    pub rounding: Rounding,
    /// Significant digits of a rounded expanded uncertainty.
    pub digits: u32,
    /// Whether the models are stated, with their equations and the meaning of the symbols.
    pub equations: bool,
    /// The evaluations: each model file once for each set of replacements.
    pub evaluations: Vec<Asked>,
    /// The rows of the table, in order.
    pub lines: Vec<Line>,
    /// The calibration functions to state, in order.
    pub functions: Vec<StatedFunction>,
    /// Names of the conditions in the table; empty for all.
    pub shown: Vec<String>,
    /// Names of inputs that are the same quantity in all model files.
    pub shared: Vec<String>,
    /// Names of inputs that have a value of their own in every evaluation.
    pub separate: Vec<String>,
}

/// A model file with the replacements of some rows.
#[derive(Clone, Debug)]
pub struct Asked {
    /// The model file, as the certificate file names it.
    pub model: String,
    /// The index of the model file among those of the certificate.
    pub file: usize,
    /// Replacements: names with their values as text.
    pub set: Vec<(String, String)>,
    /// The evaluation.
    pub task: Task,
}

/// A calibration function that is stated with its expanded uncertainty over its range.
#[derive(Clone, Debug)]
pub struct StatedFunction {
    /// The index of the model file among those of the certificate.
    pub file: usize,
    /// The function.
    pub curve: Arc<CurveFunction>,
    /// The coverage that is asked for.
    pub coverage: Coverage,
    /// Its label instead of its name.
    pub label: Option<Localized>,
}

/// A row of the table.
#[derive(Clone, Debug)]
pub struct Line {
    /// The evaluation, by its place.
    pub evaluation: usize,
    /// The index of the row of conditions in the task.
    pub row: usize,
    /// The index of the output in the model.
    pub output: usize,
    /// The label of the row instead of the output's name.
    pub label: Option<Localized>,
    /// The nominal value, in the output's unit.
    pub nominal: Option<f64>,
    /// The laboratory's capability: for the row, or else for the output.
    pub capability: Option<Capability>,
}
