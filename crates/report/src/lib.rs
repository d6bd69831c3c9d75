//! Reports: what an evaluation looks like, one file for each format.

#![cfg_attr(test, allow(clippy::disallowed_methods))] // tests compare within tolerances

mod answer;
pub mod assumptions;
mod budget_template;
pub mod certificate;
pub mod compare;
mod csv;
pub mod diff;
mod document;
mod equation;
mod evaluation;
mod fits;
pub mod gap;
mod html;
mod json;
mod json_inputs;
pub mod number;
pub mod observe;
pub mod plan;
mod plot;
mod printed;
pub mod reference;
mod regions;
mod samples;
mod saved;
mod sheet;
mod statement;
mod subtotals;
mod table;
pub mod verification;
pub mod waveform;
pub mod words;
mod workbook;

pub use answer::{on_one_line, pretty};
pub use budget_template::budget_template;
pub use csv::{csv, of_records as csv_of_records, write_csv};
pub use document::{FigureNames, PageWithFigures, equation_latex, with_figures};
pub use evaluation::{
    Extent, MOST_RESULTS, OutputParts, PageChoice, PageParts, ResultStatement, Shown, html,
    input_picture, latex, markdown, page_parts, table, trials_of_pairs, xlsx,
};
pub use html::{FigureSize, equation_html, interactive, interactive_script_digest, page_style};
pub use json::{json, write_json};
pub use printed::{grouped, with_comma};
pub use samples::TrialsForm;
pub use saved::{SaveError, saved, saved_result};
pub(crate) use table::conditions_text;
pub use table::{BudgetColumn, Grid, Screen, plain, within_screen, within_width, wrapped};

use gumption_engine::propagate::Evaluation;
use gumption_engine::task::{Task, Warning};
use gumption_text::bytes::sha256;

/// Where a result comes from: enough to repeat it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Provenance {
    /// SHA-256 of the model file, in hexadecimal.
    pub model_sha256: String,
    /// SHA-256 of every other file that was read, by its name as the model file has it.
    pub files: Vec<(String, String)>,
}

impl Provenance {
    /// The digests of a model file's text and of the files that it names, each with its content.
    pub fn of(text: &str, files: &[(String, Vec<u8>)]) -> Self {
        let digests = files.iter().map(|(name, bytes)| (name.clone(), sha256(bytes)));
        Self { model_sha256: sha256(text.as_bytes()), files: digests.collect() }
    }
}

/// Everything that a report may show.
#[derive(Clone, Copy, Debug)]
pub struct EvaluationReport<'a> {
    /// What was evaluated.
    pub task: &'a Task,
    /// The results.
    pub evaluation: &'a Evaluation,
    /// Warnings and notes, in order.
    pub warnings: &'a [Warning],
    /// Where it comes from.
    pub provenance: &'a Provenance,
}

#[cfg(test)]
mod tests;
