//! The parts of a page one by one, for a page that has a place of its own for each.

use super::figures;
use super::{Shown, document, results};
use crate::EvaluationReport;
use crate::document::{Document, fragment};
use crate::html::FigureSize;
use crate::printed::in_print;
use crate::table::{conditions_text, title_text};
use gumption_engine::distribution::Distribution;

/// The parts of a page, each as HTML that needs the style of [`crate::page_style`]. Whatever a file
/// says stands in it as text.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct PageParts {
    /// One entry for each output, about the chosen row of conditions.
    pub outputs: Vec<OutputParts>,
    /// The conditions of each row, as plain text; none where there is one row alone.
    pub rows: Vec<String>,
    /// What concerns all outputs: a table and a figure for each of them where there is more than one
    /// row of conditions, correlations, coverage regions, calibration functions.
    pub together: String,
}

/// The parts about one output.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct OutputParts {
    /// Name, unit and words, as plain text.
    pub title: String,
    /// The result, what clause 8 of JCGM 101 says of it, and whether it conforms, in sentences.
    pub verdict: String,
    /// The budget with the shares of the variance.
    pub budget: String,
    /// Combined standard uncertainty, degrees of freedom, coverage factor, expanded uncertainty.
    pub conclusions: String,
    /// Both methods side by side, with both coverage intervals.
    pub comparison: String,
    /// The distribution of the trials with the density that the GUM gives, and how the figures settle
    /// with the number of trials; empty without a histogram and stages.
    pub distribution: String,
}

/// What the parts of a page are about; all outputs of the first row unless it is said.
#[derive(Clone, Copy, Debug, Default)]
pub struct PageChoice {
    /// The output, counted from 0: of the others the title alone is given.
    pub output: Option<usize>,
    /// The row of conditions, counted from 0.
    pub row: usize,
}

/// The parts of the page of an evaluation, with the decimal mark of the language in tables and figures.
pub fn page_parts(
    report: &EvaluationReport<'_>,
    shown: &Shown<'_>,
    size: FigureSize,
    choice: PageChoice,
) -> PageParts {
    in_print(shown.language.notation(), || parts(report, shown, size, choice))
}

fn parts(
    report: &EvaluationReport<'_>,
    shown: &Shown<'_>,
    size: FigureSize,
    choice: PageChoice,
) -> PageParts {
    let conditions = &report.task.model.conditions;
    let rows = report.evaluation.rows.as_slice();
    let swept = if rows.len() > 1 { rows } else { &[] };
    let part = |output: usize| {
        if choice.output.is_some_and(|only| only != output) {
            let quantity = &report.task.model.outputs.get(output)?.quantity;
            return Some(OutputParts { title: title_text(quantity), ..OutputParts::default() });
        }
        let section = results::section_of(report, shown, (choice.row, output), false)?;
        Some(OutputParts {
            title: section.title,
            verdict: fragment(&section.verdict, size),
            budget: fragment(&section.budget, size),
            conclusions: fragment(&section.conclusions, size),
            comparison: fragment(&section.comparison, size),
            distribution: fragment(&section.distribution, size),
        })
    };
    let mut together = Document::default();
    document::together_of(&mut together, report, shown);
    PageParts {
        outputs: (0..report.task.model.outputs.len()).filter_map(part).collect(),
        rows: swept.iter().map(|row| conditions_text(conditions, &row.conditions)).collect(),
        together: fragment(&together, size),
    }
}

/// A small picture of a density, an `svg` element.
pub fn input_picture(distribution: &Distribution) -> String {
    figures::picture(distribution)
}
