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

const HEADERS: [&str; 11] = [
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
];

/// Where the formulas find the inputs.
#[derive(Clone, Debug, Default)]
pub(super) struct Places {
    /// The coverage probability.
    pub(super) probability: String,
    /// For each row of conditions its cells.
    pub(super) rows: Vec<RowPlaces>,
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
    leaf.line(1, "Shaded cells may be changed; budgets and results follow.")?;
    leaf.text(3, 0, "coverage probability")?;
    leaf.number((3, 1), evaluation.coverage_probability, None, Look::Input)?;
    let mut places = Places { probability: leaf.cell(3, 1), rows: Vec::new() };
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
            let digits = position(u, evaluation.settings.digits);
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
            cells.coefficients.push(leaf.cell(at, ESTIMATE));
            at += 1;
        }
        places.rows.push(cells);
        at += 1;
    }
    leaf.text(3, 3, &table::coverage_text(evaluation.settings.coverage))?;
    Ok(places)
}
