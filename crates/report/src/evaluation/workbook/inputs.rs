//! The worksheet of what may be changed: estimates, standard uncertainties, degrees of freedom,
//! correlation coefficients, conditions and the coverage probability.

use rust_xlsxwriter::XlsxError;

use crate::number::position;
use crate::workbook::{Cached, Leaf, Look, here};
use crate::{EvaluationReport, plain, table};
use gumption_engine::propagate::gum::Gum;

/// Columns of the worksheet.
const ESTIMATE: u16 = 1;
const UNCERTAINTY: u16 = 2;
const UNIT: u16 = 3;
const DISTRIBUTION: u16 = 4;
const DOF: u16 = 5;
const TYPE: u16 = 6;
const DIVISOR: u16 = 7;
const WIDTH: u16 = 8;
const GROUP: u16 = 9;
const ABOUT: u16 = 10;
const CHANGED: u16 = 11;

const HEADERS: [&str; 12] = [
    "quantity",
    "estimate",
    "standard uncertainty",
    "unit",
    "distribution",
    "dof",
    "type",
    "divisor",
    "value ±",
    "group",
    "source of uncertainty",
    "changed",
];

/// What stands beside figures that formulas do not follow, once an input is another.
const OLD: &str = "inputs were changed: not of these inputs";

/// The share by which a number in a formula may differ from the same in a cell: spreadsheets cut it to 15
/// digits.
const SAME: f64 = 1e-13;

/// Where the formulas find the inputs.
#[derive(Clone, Debug, Default)]
pub(super) struct Places {
    /// The coverage probability.
    pub(super) probability: String,
    /// The cell that counts the changed inputs; empty where none can be changed.
    changed: String,
    /// For each row of conditions its cells.
    pub(super) rows: Vec<RowPlaces>,
}

impl Places {
    /// Says what stands here of the inputs as evaluated, and that an input was changed, once one is.
    pub(super) fn marked(
        &self,
        leaf: &mut Leaf,
        at: (u32, u16),
        what: &str,
    ) -> Result<(), XlsxError> {
        if self.changed.is_empty() {
            return Ok(());
        }
        let formula = format!("IF({}>0,\"{what}: {OLD}\",\"{what}\")", self.changed);
        leaf.formula(at, &formula, &Cached::Text(what.to_owned()), None, Look::Words)
    }

    /// A word that holds for the inputs as evaluated: once an input is changed, the cell says so.
    pub(super) fn word(
        &self,
        leaf: &mut Leaf,
        at: (u32, u16),
        word: &str,
    ) -> Result<(), XlsxError> {
        if self.changed.is_empty() {
            return leaf.word(at, word, Look::Plain);
        }
        let formula = format!("IF({}>0,\"{OLD}\",\"{word}\")", self.changed);
        leaf.formula(at, &formula, &Cached::Text(word.to_owned()), None, Look::Plain)
    }
}

/// The cells of a row of conditions.
#[derive(Clone, Debug, Default)]
pub(super) struct RowPlaces {
    /// For each variable estimate, standard uncertainty and degrees of freedom.
    pub variables: Vec<[String; 3]>,
    /// For each condition its value.
    pub(super) conditions: Vec<String>,
    /// For each line of a correlation coefficient its value.
    pub(super) coefficients: Vec<String>,
}

pub(super) fn write(leaf: &mut Leaf, report: &EvaluationReport<'_>) -> Result<Places, XlsxError> {
    let EvaluationReport { task, evaluation, .. } = *report;
    leaf.title(0, "Inputs")?;
    leaf.line(
        1,
        "Shaded cells may be changed; budgets and results follow, and other figures say so.",
    )?;
    leaf.text(3, 0, "coverage probability")?;
    leaf.number((3, ESTIMATE), evaluation.coverage_probability, None, Look::Input)?;
    let changed = leaf.cell(3, CHANGED);
    let mut places = Places { probability: leaf.cell(3, ESTIMATE), changed, rows: Vec::new() };
    let mut at = 5;
    for (row, found) in task.rows.iter().zip(&evaluation.rows) {
        let mut cells = RowPlaces::default();
        for (condition, &value) in task.model.conditions.iter().zip(&found.conditions) {
            leaf.text(at, 0, &plain(&condition.name))?;
            // estimates that follow it are numbers, so that a change would be half a one
            leaf.number((at, ESTIMATE), value, None, Look::Plain)?;
            leaf.text(at, UNIT, &plain(condition.unit.text()))?;
            leaf.text(at, DISTRIBUTION, "condition")?;
            cells.conditions.push(leaf.cell(at, ESTIMATE));
            at += 1;
        }
        leaf.headers(at, HEADERS)?;
        at += 1;
        for (variable, distribution) in task.variables.iter().zip(row.distributions.iter()) {
            let u = distribution.standard_uncertainty();
            let digits = position(u, evaluation.settings.digits_on_pages());
            leaf.text(at, 0, &plain(&variable.name))?;
            leaf.number((at, ESTIMATE), distribution.mean(), None, Look::Input)?;
            leaf.number((at, UNCERTAINTY), u, None, Look::Input)?;
            leaf.text(at, UNIT, &plain(variable.unit.text()))?;
            leaf.text(at, DISTRIBUTION, distribution.name())?;
            if distribution.dof().is_finite() {
                leaf.number((at, DOF), distribution.dof(), None, Look::Input)?;
            } else {
                leaf.word((at, DOF), "∞", Look::Input)?;
            }
            leaf.text(at, TYPE, variable.evaluation.letter())?;
            if let Some(divisor) = distribution.divisor() {
                leaf.number((at, DIVISOR), divisor, None, Look::Plain)?;
                let width = format!("{}*{}", here(at, UNCERTAINTY), here(at, DIVISOR));
                let cached = Cached::Number(u * divisor);
                leaf.formula((at, WIDTH), &width, &cached, digits, Look::Plain)?;
            }
            leaf.text(at, GROUP, &plain(variable.group.as_deref().unwrap_or_default()))?;
            leaf.text(at, ABOUT, &plain(&variable.about))?;
            let known = [distribution.mean(), u, distribution.dof()];
            changes(leaf, at, &[ESTIMATE, UNCERTAINTY, DOF], &known)?;
            let cell = |column| leaf.cell(at, column);
            cells.variables.push([cell(ESTIMATE), cell(UNCERTAINTY), cell(DOF)]);
            at += 1;
        }
        let gum = found.outputs.iter().find_map(|output| output.gum.as_ref());
        for line in gum.into_iter().flat_map(Gum::correlations) {
            let [a, b] = line.variables.map(|v| task.variables.get(v).map_or("", |v| &v.name));
            leaf.text(at, 0, &format!("r({}, {})", plain(a), plain(b)))?;
            leaf.number((at, ESTIMATE), line.coefficient, None, Look::Input)?;
            leaf.text(at, DISTRIBUTION, "correlation")?;
            changes(leaf, at, &[ESTIMATE], &[line.coefficient])?;
            cells.coefficients.push(leaf.cell(at, ESTIMATE));
            at += 1;
        }
        places.rows.push(cells);
        at += 1;
    }
    leaf.text(3, 3, &table::coverage_text(evaluation.settings.coverage))?;
    let own = unlike(3, ESTIMATE, evaluation.coverage_probability);
    let below = format!("{}:{}", here(5, CHANGED), here(at, CHANGED));
    leaf.formula(
        (3, CHANGED),
        &format!("SUM({below})+IF({own},1,0)"),
        &Cached::Number(0.0),
        Some(0),
        Look::Plain,
    )?;
    Ok(places)
}

/// Whether a line was changed, 1 or 0: its cells against what stood in them.
fn changes(leaf: &mut Leaf, at: u32, columns: &[u16], known: &[f64]) -> Result<(), XlsxError> {
    let differ: Vec<String> =
        columns.iter().zip(known).map(|(column, known)| unlike(at, *column, *known)).collect();
    let formula = format!("IF(OR({}),1,0)", differ.join(","));
    leaf.formula((at, CHANGED), &formula, &Cached::Number(0.0), Some(0), Look::Plain)
}

/// That a cell holds another value than this one.
fn unlike(row: u32, column: u16, known: f64) -> String {
    let cell = here(row, column);
    match known.is_finite() {
        true => {
            format!("IF(ISNUMBER({cell}),ABS({cell}-({known:?}))>{:?},TRUE)", SAME * known.abs())
        }
        // infinite degrees of freedom, and what no cell holds, are words
        false => format!("ISNUMBER({cell})"),
    }
}
