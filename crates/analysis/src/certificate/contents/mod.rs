//! A calibration certificate that is to be made: what is stated, for which device, in which form.

mod administrative;
mod form;

pub use administrative::{AdministrativeData, Device, Party, PerformanceLocation};
pub use form::{DecimalMark, Language, Localized, Rounding};

use std::sync::Arc;

use gumption_engine::model::Capability;
use gumption_engine::regression::CurveFunction;
use gumption_engine::task::{Coverage, Task};

/// A certificate that is to be made.
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
    /// Whether the models are stated: their equations and what the symbols mean.
    pub equations: bool,
    /// What is evaluated: each model file with each set of replacements once.
    pub evaluations: Vec<Asked>,
    /// The rows of the table, in order.
    pub lines: Vec<Line>,
    /// The calibration functions that are stated, in order.
    pub functions: Vec<StatedFunction>,
    /// Names of the conditions that the table shows; all of them if there are none.
    pub shown: Vec<String>,
    /// Names of inputs that are one and the same quantity in all model files.
    pub shared: Vec<String>,
    /// Names of inputs that have a value of their own in every evaluation.
    pub separate: Vec<String>,
}

/// A model file with the replacements of some rows.
#[derive(Clone, Debug)]
pub struct Asked {
    /// The model file, as the certificate file names it.
    pub model: String,
    /// The place of the model file among those of the certificate.
    pub file: usize,
    /// What is replaced: names with their values as text.
    pub set: Vec<(String, String)>,
    /// The evaluation.
    pub task: Task,
}

/// A calibration function that is stated with its expanded uncertainty over its range.
#[derive(Clone, Debug)]
pub struct StatedFunction {
    /// The place of the model file among those of the certificate.
    pub file: usize,
    /// The function.
    pub curve: Arc<CurveFunction>,
    /// The coverage that is asked for.
    pub coverage: Coverage,
    /// What it is called instead of its name.
    pub label: Option<Localized>,
}

/// A row of the table.
#[derive(Clone, Debug)]
pub struct Line {
    /// The evaluation, by its place.
    pub evaluation: usize,
    /// The row of conditions, by its place in the task.
    pub row: usize,
    /// The output, by its place in the model.
    pub output: usize,
    /// What the row is called instead of the output's name.
    pub label: Option<Localized>,
    /// The nominal value, in the output's unit.
    pub nominal: Option<f64>,
    /// The laboratory's capability: that of the row, or else of the output.
    pub capability: Option<Capability>,
}
