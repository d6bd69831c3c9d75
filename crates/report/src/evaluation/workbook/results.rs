//! The worksheet of the results: a column for each output, or in a sweep a line for each output in each
//! row of conditions.

use rust_xlsxwriter::XlsxError;

use super::budget::Totals;
use super::inputs::Places;
use crate::number::{place_of_ends, position};
use crate::workbook::{Cached, Leaf, Look, PERCENT, here};
use crate::{EvaluationReport, plain, table};
use gumption_engine::decimal::Decimal;
use gumption_engine::model::{GuardRule, Output};
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
const CONFORMITY: [&str; 9] = [
    "tolerance, from",
    "tolerance, to",
    "guard band",
    "acceptance, from",
    "acceptance, to",
    "estimate that decides",
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
const OF_TRIALS: usize = 10;
const MEDIAN: usize = 12;
const VERDICT: usize = 17;
const TOLERANCE: usize = 18;

/// Where the figures of an output stand.
#[derive(Clone, Copy, Debug)]
enum FigureLine {
    /// Below each other in a column.
    Column(u16),
    /// Beside each other from a place on.
    Row(u32, u16),
}

impl FigureLine {
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
    (places, totals): (&Places, &[Totals]),
) -> Result<(), XlsxError> {
    let EvaluationReport { task, evaluation, .. } = *report;
    leaf.title(0, &plain(&task.title))?;
    leaf.line(1, &table::settings_text(evaluation))?;
    if evaluation.rows.iter().flat_map(|row| &row.outputs).any(|of| of.monte_carlo.is_some()) {
        places.marked(leaf, (2, 0), "Monte Carlo, of the inputs as evaluated")?;
    }
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
            let line = if task.swept {
                FigureLine::Row(at, first)
            } else {
                FigureLine::Column(output as u16 + 1)
            };
            if task.swept {
                for (column, &value) in (0..first).zip(&row.conditions) {
                    leaf.number((at, column), value, None, Look::Plain)?;
                }
                leaf.text(at, first, &plain(&quantity.name))?;
                at += 1;
            }
            let cells = totals.get(output).and_then(|rows| rows.get(number)?.as_ref());
            let digits = evaluation.settings.digits_on_pages();
            figures(leaf, line, (declared, found), digits, (places, cells))?;
            if let Some(beside) = found.capability.as_deref() {
                let digits = evaluation.settings.digits_on_pages();
                // what is below the capability must not be stated (ILAC-P14)
                let may_be_stated = beside.raised || !beside.below;
                let expanded = beside.rounded(digits).filter(|_| may_be_stated);
                let of_zero = if may_be_stated { beside.expanded_uncertainty } else { f64::NAN };
                let stated = expanded.map_or(of_zero, Decimal::value);
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
            "Results of the GUM, limits of acceptance and decisions by the estimate of the GUM follow \
             changes under Inputs. Results of the Monte Carlo method and decisions by its estimate are \
             of the inputs as evaluated.",
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
    line: FigureLine,
    (output, found): (&Output, &OutputEvaluation),
    digits: u32,
    (places, cells): (&Places, Option<&[String; 7]>),
) -> Result<(), XlsxError> {
    let quantity = &output.quantity;
    let (row, column) = line.at(1);
    match line {
        FigureLine::Column(_) => {
            leaf.word((row, column), &plain(quantity.unit.text()), Look::Plain)?
        }
        FigureLine::Row(..) => leaf.text(row, column, &plain(quantity.unit.text()))?,
    }
    if let Some(gum) = &found.gum {
        propagated(leaf, line, gum, digits, cells)?;
    }
    if let Some(figures) = &found.monte_carlo {
        trials(leaf, line, figures, digits)?;
        let verdict = match found.validation.map(|validation| validation.gum_valid) {
            Some(Some(true)) => "validated",
            Some(Some(false)) => "not validated",
            Some(None) => "undecided",
            None => "-",
        };
        places.word(leaf, line.at(VERDICT), verdict)?;
    }
    match &found.conformity {
        Some(conformity) => decided(leaf, line, conformity, (output, found, digits)),
        None => Ok(()),
    }
}

/// The figures of the law of propagation.
fn propagated(
    leaf: &mut Leaf,
    line: FigureLine,
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
fn trials(
    leaf: &mut Leaf,
    line: FigureLine,
    figures: &MonteCarlo,
    digits: u32,
) -> Result<(), XlsxError> {
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

/// The cell with the value that was decided about, and the turns of an angle that it is away from it.
enum Deciding {
    /// The estimate by the law of propagation, which follows the inputs.
    Propagated(f64),
    /// Another figure, of the inputs as evaluated.
    Evaluated(usize),
    /// None of the figures, such as one without the noise of trials.
    Apart,
}

impl Deciding {
    fn of(conformity: &Conformity, output: &Output, found: &OutputEvaluation) -> Self {
        let decided = conformity.estimate;
        let turned = |from: f64| {
            let away = decided - from;
            let whole = output.period.map_or(0.0, |period| (away / period).round() * period);
            ((away - whole).abs() <= SAME * decided.abs()).then_some(whole)
        };
        let gum = found.gum.as_ref().filter(|_| conformity.stated_uncertainty.is_none());
        if let Some(turns) = gum.and_then(|gum| turned(gum.estimate)) {
            return Self::Propagated(turns);
        }
        let trials = found.monte_carlo.as_deref();
        match trials.map(|of| (of.estimate == Some(decided), of.median == decided)) {
            Some((true, _)) => Self::Evaluated(OF_TRIALS),
            Some((_, true)) => Self::Evaluated(MEDIAN),
            _ => Self::Apart,
        }
    }
}

/// Values that differ by no more than this share are the same but for the rounding of turns.
const SAME: f64 = 1e-12;

/// The width of a guard band with a name, from half of the tolerance and the expanded uncertainty.
fn named_band(rule: GuardRule, t: &str, u: &str) -> String {
    match rule {
        GuardRule::Rss => format!("{t}-SQRT({t}^2-{u}^2)"),
        GuardRule::Rp10 => format!("MAX(0,{u}-{t}/4)"),
        GuardRule::Dobbert => format!("MAX(0,{u}*(1.04-EXP(0.38*LN({t}/{u})-0.54)))"),
    }
}

/// Tolerance, limits of acceptance and decision, which follow the inputs where the estimate by the law
/// of propagation decides: the guard band in proportion to its standard uncertainty. All others are
/// those of the evaluation.
fn decided(
    leaf: &mut Leaf,
    line: FigureLine,
    conformity: &Conformity,
    (output, found, digits): (&Output, &OutputEvaluation, u32),
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
    let now = |value: f64| Cached::Number(value);
    let of_trials = found.monte_carlo.as_deref().and_then(|of| of.standard_uncertainty);
    let propagated = found.gum.as_ref().map(|gum| gum.standard_uncertainty);
    let deciding = Deciding::of(conformity, output, found);
    let (formula, u) = match deciding {
        Deciding::Propagated(0.0) => (Some(of(ESTIMATE)), propagated),
        Deciding::Propagated(turns) => (Some(format!("{}+{turns:?}", of(ESTIMATE))), propagated),
        Deciding::Evaluated(figure) => (Some(of(figure)), of_trials.or(propagated)),
        Deciding::Apart => (None, of_trials.or(propagated)),
    };
    let shown = u.and_then(|u| position(u, digits));
    let estimate = conformity.estimate;
    match formula {
        Some(formula) => leaf.formula(place(5), &formula, &now(estimate), shown, Look::Plain)?,
        None => leaf.number(place(5), estimate, shown, Look::Plain)?,
    }
    let decision = table::comparison::decision(conformity);
    match conformity.guard_band {
        Some(width) => {
            let live = u.filter(|u| matches!(deciding, Deciding::Propagated(_)) && *u > 0.0);
            match live {
                Some(u) => {
                    let band = match (conformity.guard_rule, conformity.expanded_uncertainty) {
                        (Some(rule), Some(expanded)) => {
                            let expanded = format!("({:?}*{})", expanded / u, of(UNCERTAINTY));
                            named_band(rule, &format!("(({}-{})/2)", cell(1), cell(0)), &expanded)
                        }
                        _ => format!("{:?}*{}", width / u, of(UNCERTAINTY)),
                    };
                    leaf.formula(place(2), &band, &now(width), shown, Look::Plain)?;
                }
                None => leaf.number(place(2), width, shown, Look::Plain)?,
            }
            let (mut within, mut tolerated, mut near) = (Vec::new(), Vec::new(), Vec::new());
            for (figure, limit, sign) in [(0, limits[0], 1.0), (1, limits[1], -1.0)] {
                let at = place(3 + figure);
                let Some(limit) = limit else {
                    leaf.word(at, crate::number::MISSING, Look::Plain)?;
                    continue;
                };
                let (operator, compared) = if sign > 0.0 { ("+", ">=") } else { ("-", "<=") };
                let formula = format!("{}{operator}{}", cell(figure), cell(2));
                leaf.formula(at, &formula, &now(limit + sign * width), shown, Look::Plain)?;
                within.push(format!("{}{compared}{}", cell(5), cell(3 + figure)));
                let beyond = if sign > 0.0 { "-" } else { "+" };
                tolerated.push(format!("{}{compared}{}", cell(5), cell(figure)));
                near.push(format!("{}{compared}{}{beyond}{}", cell(5), cell(figure), cell(2)));
            }
            let [within, tolerated, near] =
                [within, tolerated, near].map(|all| format!("AND({})", all.join(",")));
            let formula = match conformity.level {
                None => format!("IF({within},\"accepted\",\"rejected\")"),
                Some(_) => format!(
                    "IF({within},\"pass\",IF({tolerated},\"conditional pass\",\
                     IF({near},\"conditional fail\",\"fail\")))"
                ),
            };
            let now = Cached::Text(decision.to_owned());
            leaf.formula(place(6), &formula, &now, None, Look::Stressed)?;
        }
        // no value has so small a risk
        None => {
            for figure in 2..5 {
                leaf.word(place(figure), crate::number::MISSING, Look::Plain)?;
            }
            leaf.word(place(6), decision, Look::Stressed)?;
        }
    }
    leaf.share(place(7), conformity.probability, PERCENT)?;
    leaf.share(place(8), conformity.numerical_standard_error, PERCENT)
}
