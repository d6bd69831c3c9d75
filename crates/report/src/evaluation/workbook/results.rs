//! The worksheet of the results: a column for each output, or in a sweep a line for each output in each
//! row of conditions.

use rust_xlsxwriter::XlsxError;

use super::budget::Totals;
use crate::number::{place_of_ends, position};
use crate::workbook::{Cached, Leaf, Look, PERCENT, here};
use crate::{EvaluationReport, plain, table};
use gumption_engine::decimal::Decimal;
use gumption_engine::model::Quantity;
use gumption_engine::propagate::gum::{Dof, Gum};
use gumption_engine::propagate::monte_carlo::MonteCarlo;
use gumption_engine::propagate::{Conformity, OutputEvaluation};

/// The line of the headers, or of the first header.
const TOP: u32 = 3;

/// Figures of every output.
const HEADERS: [&str; 18] = [
    "output",
    "unit",
    "estimate",
    "standard uncertainty",
    "dof",
    "coverage factor",
    "expanded uncertainty",
    "GUM interval, from",
    "GUM interval, to",
    "Monte Carlo trials",
    "Monte Carlo estimate",
    "Monte Carlo standard uncertainty",
    "median",
    "symmetric interval, from",
    "symmetric interval, to",
    "shortest interval, from",
    "shortest interval, to",
    "clause 8: GUM interval",
];

/// Figures of outputs with a tolerance.
const CONFORMITY: [&str; 8] = [
    "tolerance, from",
    "tolerance, to",
    "guard band",
    "acceptance, from",
    "acceptance, to",
    "decision by the estimate",
    "probability of conformity",
    "numerical standard error of it",
];

/// Figures of outputs with a capability of the laboratory.
const CAPABILITY: [&str; 2] = ["capability (CMC)", "expanded uncertainty to be stated"];

/// Places of figures among the headers.
const ESTIMATE: usize = 2;
const UNCERTAINTY: usize = 3;
const GUM: usize = 2;
const TRIALS: usize = 9;
const VERDICT: usize = 17;
const TOLERANCE: usize = 18;

/// Where the figures of an output stand.
#[derive(Clone, Copy, Debug)]
enum Line {
    /// Below each other in a column.
    Column(u16),
    /// Beside each other from a place on.
    Row(u32, u16),
}

impl Line {
    /// The place of a figure.
    fn at(self, figure: usize) -> (u32, u16) {
        match self {
            Self::Column(column) => (TOP + figure as u32, column),
            Self::Row(row, first) => (row, first + figure as u16),
        }
    }
}

/// Writes the results; GUM figures as formulas where `totals` has their cells.
pub(super) fn write(
    leaf: &mut Leaf,
    report: &EvaluationReport<'_>,
    totals: &[Totals],
) -> Result<(), XlsxError> {
    let EvaluationReport { task, evaluation, .. } = *report;
    leaf.title(0, &plain(&task.title))?;
    leaf.line(1, &table::settings_text(evaluation))?;
    let tolerances = task.model.outputs.iter().any(|output| output.tolerance.is_some());
    let further = if tolerances { CONFORMITY.as_slice() } else { &[] };
    let capabilities = task.model.outputs.iter().any(|output| output.capability.is_some());
    let capability = if capabilities { CAPABILITY.as_slice() } else { &[] };
    let place_of_capability = HEADERS.len() + further.len();
    let headers = HEADERS.iter().chain(further).chain(capability).copied();
    let conditions: Vec<String> = task
        .model
        .conditions
        .iter()
        .filter(|_| task.swept)
        .map(|condition| format!("{} in {}", plain(&condition.name), plain(condition.unit.text())))
        .collect();
    let first = conditions.len() as u16;
    if task.swept {
        leaf.headers(TOP, conditions.iter().map(String::as_str).chain(headers.clone()))?;
    } else {
        let outputs = task.model.outputs.iter().map(|output| plain(&output.quantity.name));
        let outputs: Vec<String> = std::iter::once("output".to_owned()).chain(outputs).collect();
        leaf.headers(TOP, outputs.iter().map(String::as_str))?;
        for (at, header) in (TOP..).zip(headers.clone()).skip(1) {
            leaf.text(at, 0, header)?;
        }
    }
    let mut at = TOP + 1;
    for (number, row) in evaluation.rows.iter().enumerate() {
        for (output, (declared, found)) in task.model.outputs.iter().zip(&row.outputs).enumerate() {
            let quantity = &declared.quantity;
            let line =
                if task.swept { Line::Row(at, first) } else { Line::Column(output as u16 + 1) };
            if task.swept {
                for (column, &value) in (0..first).zip(&row.conditions) {
                    leaf.number((at, column), value, None, Look::Plain)?;
                }
                leaf.text(at, first, &plain(&quantity.name))?;
                at += 1;
            }
            let cells = totals.get(output).and_then(|rows| rows.get(number)?.as_ref());
            figures(leaf, line, (quantity, found), evaluation.settings.digits, cells)?;
            if let Some(beside) = found.capability.as_deref() {
                let digits = evaluation.settings.digits;
                let expanded = beside.rounded(digits);
                let stated = expanded.map_or(beside.expanded_uncertainty, Decimal::value);
                let shown = expanded.map(Decimal::position);
                let [cmc, to_be_stated] = [0, 1].map(|at| line.at(place_of_capability + at));
                leaf.number(cmc, beside.cmc, None, Look::Plain)?;
                leaf.number(to_be_stated, stated, shown, Look::Plain)?;
            }
        }
    }
    if !task.swept {
        at = TOP + headers.count() as u32;
    }
    if !totals.is_empty() {
        leaf.line(
            at + 1,
            "Figures of the GUM, the limits of acceptance and the decision follow what is changed \
             under Inputs; those of the Monte Carlo method are of the inputs as evaluated.",
        )?;
    } else {
        leaf.line(
            at + 1,
            "There are too many budgets for a workbook; all of them: --format json.",
        )?;
    }
    leaf.freeze(TOP + 1)
}

/// The figures of an output.
fn figures(
    leaf: &mut Leaf,
    line: Line,
    (quantity, found): (&Quantity, &OutputEvaluation),
    digits: u32,
    cells: Option<&[String; 7]>,
) -> Result<(), XlsxError> {
    let (row, column) = line.at(1);
    match line {
        Line::Column(_) => leaf.word((row, column), &plain(quantity.unit.text()), Look::Plain)?,
        Line::Row(..) => leaf.text(row, column, &plain(quantity.unit.text()))?,
    }
    if let Some(gum) = &found.gum {
        propagated(leaf, line, gum, digits, cells)?;
    }
    if let Some(figures) = &found.monte_carlo {
        trials(leaf, line, figures, digits)?;
        let verdict = match found.validation.map(|validation| validation.gum_valid) {
            Some(Some(true)) => "valid",
            Some(Some(false)) => "not valid",
            Some(None) => "undecided",
            None => "-",
        };
        leaf.word(line.at(VERDICT), verdict, Look::Plain)?;
    }
    match &found.conformity {
        Some(conformity) => decided(leaf, line, conformity, (found, digits)),
        None => Ok(()),
    }
}

/// The figures of the law of propagation.
fn propagated(
    leaf: &mut Leaf,
    line: Line,
    gum: &Gum,
    digits: u32,
    cells: Option<&[String; 7]>,
) -> Result<(), XlsxError> {
    let own = position(gum.standard_uncertainty, digits);
    let expanded = gum.expanded_uncertainty();
    let interval = gum.interval();
    let dof = match gum.dof {
        Dof::Finite(dof) => Cached::Number(dof),
        Dof::Infinite => Cached::Text("∞".to_owned()),
        Dof::Undefined => Cached::Text("undefined".to_owned()),
    };
    let whole = matches!(gum.dof, Dof::Finite(_)).then_some(-1);
    let number = |value: Option<f64>| Cached::Number(value.unwrap_or(f64::NAN));
    let values = [
        (number(Some(gum.estimate)), own),
        (number(Some(gum.standard_uncertainty)), own),
        (dof, whole),
        (number(gum.coverage_factor), Some(-2)),
        (number(expanded), expanded.and_then(|expanded| position(expanded, digits))),
        (number(interval.map(|ends| ends[0])), own),
        (number(interval.map(|ends| ends[1])), own),
    ];
    for (figure, (value, shown)) in values.into_iter().enumerate() {
        let place = line.at(GUM + figure);
        match (cells.and_then(|cells| cells.get(figure)), value) {
            (Some(cell), value) => leaf.formula(place, cell, &value, shown, Look::Plain)?,
            (None, Cached::Number(value)) => leaf.number(place, value, shown, Look::Plain)?,
            (None, Cached::Text(text)) => leaf.word(place, &text, Look::Plain)?,
        }
    }
    Ok(())
}

/// The figures of the trials.
fn trials(leaf: &mut Leaf, line: Line, figures: &MonteCarlo, digits: u32) -> Result<(), XlsxError> {
    let own = figures.standard_uncertainty.and_then(|u| position(u, digits));
    let ends = place_of_ends(figures, figures.standard_uncertainty, digits);
    let values = [
        (Some(figures.trials as f64), Some(0)),
        (figures.estimate, own),
        (figures.standard_uncertainty, own),
        (Some(figures.median), ends),
        (Some(figures.symmetric_interval[0]), ends),
        (Some(figures.symmetric_interval[1]), ends),
        (Some(figures.shortest_interval[0]), ends),
        (Some(figures.shortest_interval[1]), ends),
    ];
    for (figure, (value, shown)) in values.into_iter().enumerate() {
        let value = value.unwrap_or(f64::NAN);
        leaf.number(line.at(TRIALS + figure), value, shown, Look::Plain)?;
    }
    Ok(())
}

/// Tolerance, limits of acceptance and decision. The guard band stays in proportion to the standard
/// uncertainty where an input is changed; that of a laboratory's capability stays as it is.
fn decided(
    leaf: &mut Leaf,
    line: Line,
    conformity: &Conformity,
    (found, digits): (&OutputEvaluation, u32),
) -> Result<(), XlsxError> {
    let place = |figure: usize| line.at(TOLERANCE + figure);
    let cell = |figure: usize| {
        let (row, column) = place(figure);
        here(row, column)
    };
    let of = |figure: usize| {
        let (row, column) = line.at(figure);
        here(row, column)
    };
    let limits = [conformity.tolerance.lower, conformity.tolerance.upper];
    for (figure, limit) in limits.into_iter().enumerate() {
        leaf.number(place(figure), limit.unwrap_or(f64::NAN), None, Look::Plain)?;
    }
    let gum = found.gum.as_ref().filter(|gum| gum.standard_uncertainty > 0.0);
    if let (Some(gum), Some(width)) = (gum, conformity.guard_band) {
        let u = gum.standard_uncertainty;
        let shown = position(u, digits);
        let now = |value: f64| Cached::Number(value);
        if conformity.stated_uncertainty.is_some() {
            leaf.number(place(2), width, shown, Look::Plain)?;
        } else {
            let band = format!("{:?}*{}", width / u, of(UNCERTAINTY));
            leaf.formula(place(2), &band, &now(width), shown, Look::Plain)?;
        }
        let mut within = Vec::new();
        let mut accepted = true;
        for (figure, limit, sign) in [(0, limits[0], 1.0), (1, limits[1], -1.0)] {
            let at = place(3 + figure);
            let Some(limit) = limit else {
                leaf.word(at, crate::number::MISSING, Look::Plain)?;
                continue;
            };
            let (operator, compared) = if sign > 0.0 { ("+", ">=") } else { ("-", "<=") };
            let formula = format!("{}{operator}{}", cell(figure), cell(2));
            let end = limit + sign * width;
            leaf.formula(at, &formula, &now(end), shown, Look::Plain)?;
            within.push(format!("{}{compared}{}", of(ESTIMATE), cell(3 + figure)));
            accepted &= if sign > 0.0 { gum.estimate >= end } else { gum.estimate <= end };
        }
        let decision = format!("IF(AND({}),\"accepted\",\"rejected\")", within.join(","));
        let now = if accepted { "accepted" } else { "rejected" };
        leaf.formula(place(5), &decision, &Cached::Text(now.to_owned()), None, Look::Stressed)?;
    }
    leaf.share(place(6), conformity.probability, PERCENT)?;
    leaf.share(place(7), conformity.numerical_standard_error, PERCENT)
}
