//! The contents of a calibration certificate: results, device and form.

mod administrative;
mod form;
mod layout;
mod letterhead;

pub use administrative::{
    AdministrativeData, Device, NAME_OF_READINGS, Party, PerformanceLocation,
};
pub use form::{DecimalMark, Language, Localized, Rounding};
pub use layout::{ColumnContent, ColumnUnit, LayoutColumn, LayoutTable};
pub use letterhead::{Letterhead, Picture, PictureFormat};

use std::sync::Arc;

use gumption_engine::distribution::Distribution;
use gumption_engine::model::{Capability, InputQuantity};
use gumption_engine::regression::CurveFunction;
use gumption_engine::task::{Coverage, Task};
use gumption_units::Unit;

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
    /// The tables by which the laboratory lays out the results; one with a line for each row and
    /// the usual columns if it is empty.
    pub layout: Vec<LayoutTable>,
    /// Pictures and accreditation at the head of the first page.
    pub letterhead: Letterhead,
    /// Whether the pages state the correlation coefficients of the rows.
    pub correlations: bool,
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

impl Asked {
    /// The value of a condition or the estimate of an input in a row of conditions, with its unit;
    /// `None` if there is no such quantity.
    pub fn value(&self, row: usize, name: &str) -> Option<(f64, &Unit)> {
        let at = self.task.rows.get(row)?;
        if let Some(place) = self.task.model.conditions.iter().position(|c| c.name == name) {
            return Some((*at.conditions.get(place)?, &self.task.model.conditions[place].unit));
        }
        let (input, parts) = self.input(row, name)?;
        Some((parts.iter().map(|d| d.mean()).sum(), &input.quantity.unit))
    }

    /// The standard uncertainty of an input in a row of conditions, in its unit; 0 for a constant,
    /// `None` if there is no such input.
    pub fn standard_uncertainty(&self, row: usize, name: &str) -> Option<f64> {
        let (_, parts) = self.input(row, name)?;
        Some(parts.iter().map(|d| d.standard_uncertainty().powi(2)).sum::<f64>().sqrt())
    }

    /// An input with the distributions of its components in a row of conditions.
    fn input(&self, row: usize, name: &str) -> Option<(&InputQuantity, &[Arc<Distribution>])> {
        let at = self.task.rows.get(row)?;
        let mut first = 0;
        for input in &self.task.model.inputs {
            if input.quantity.name == name {
                return Some((input, at.distributions.get(first..first + input.parts)?));
            }
            first += input.parts;
        }
        None
    }
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
    /// The index of its table in [`Certificate::layout`]; 0 without a layout.
    pub table: usize,
    /// The label of the row instead of the output's name.
    pub label: Option<Localized>,
    /// The nominal value, in the output's unit.
    pub nominal: Option<f64>,
    /// The laboratory's capability: for the row, or else for the output.
    pub capability: Option<Capability>,
}
