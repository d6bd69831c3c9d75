//! An evaluation as a document: what a page of any look says about it.

mod brief;
mod document;
mod figures;
mod parts;
mod repeat;
mod results;
mod sweep;
mod terminal;
mod workbook;

pub use figures::trials_of_pairs;
pub use parts::{OutputParts, PageChoice, PageParts, input_picture, page_parts};
pub use results::ResultStatement;
pub(crate) use results::Taken;
pub use workbook::{MOST_RESULTS, xlsx};

use super::document as look;
use super::{BudgetColumn, EvaluationReport};
use gumption_engine::propagate::monte_carlo::{Histogram, MonteCarlo};

/// How much a text page shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Extent {
    /// The result of each output on one line; of a sweep, a table.
    Brief,
    /// The results, what is doubtful, and the budgets: what fits on one screen.
    #[default]
    Usual,
    /// Everything.
    Full,
}

/// What a page shows beside the results.
#[derive(Clone, Copy, Debug, Default)]
pub struct Shown<'a> {
    /// Further columns of the budgets.
    pub columns: &'a [BudgetColumn],
    /// For each row of conditions the histograms of its outputs; none at all, or as many as rows.
    pub histograms: &'a [Vec<Option<Histogram>>],
    /// For each output of the row that is shown how its figures settle with the number of trials, the
    /// last ones being those of all ([`gumption_engine::propagate::convergence`]); or none.
    pub convergence: &'a [Vec<MonteCarlo>],
    /// For each output of the row that is shown its values in the first trials
    /// ([`gumption_engine::propagate::first_trials`], as many as [`trials_of_pairs`]); or none.
    pub trials: &'a [Vec<f64>],
    /// What the command line replaces in the model file, as it was typed.
    pub replaced: &'a [String],
    /// How much a text page shows; other pages show everything.
    pub extent: Extent,
    /// The language of the notes.
    pub language: crate::words::Language,
    /// The text of the model file, for pages that show it.
    pub model: &'a str,
}

impl Shown<'_> {
    fn histogram(&self, row: usize, output: usize) -> Option<&Histogram> {
        self.histograms.get(row)?.get(output)?.as_ref()
    }
}

/// The evaluation as a page for a terminal of at most 100 columns, or as many as it has
/// ([`crate::within_width`]). Warnings are not part of it.
pub fn table(report: &EvaluationReport<'_>, shown: &Shown<'_>) -> String {
    look::text(|| document::text(report, &Shown { model: "", ..*shown }))
}

/// The evaluation in GitHub Flavored Markdown.
pub fn markdown(report: &EvaluationReport<'_>, shown: &Shown<'_>) -> String {
    look::markdown(|| document::of(report, &Shown { model: "", ..*shown }))
}

/// The evaluation as a LaTeX file for `article` with `booktabs` and `siunitx`.
pub fn latex(report: &EvaluationReport<'_>, shown: &Shown<'_>) -> String {
    look::latex(&document::of(report, &Shown { model: "", ..*shown }))
}

/// The evaluation as one HTML file with figures that needs nothing else: it loads nothing and runs
/// nothing, reads in light and dark and prints on A4.
pub fn html(report: &EvaluationReport<'_>, shown: &Shown<'_>) -> String {
    look::html(|| document::of(report, shown))
}
