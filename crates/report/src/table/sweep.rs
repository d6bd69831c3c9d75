//! A sweep over conditions: one table for each output, one line for each row.

use std::collections::BTreeMap;

use super::comparison::{decision, limits_text, rule};
use super::{in_unit, row_numbers, text, unit_text};
use crate::evaluation::Taken;
use crate::number::{MISSING, exact, justified, place_of_ends, position, rounded, significant, to};
use crate::sheet::{Figure, Sheet};
use gumption_analysis::capability_line::{self, FittedLine, LineForm};
use gumption_engine::model::{CapabilityLine, Output, Quantity};
use gumption_engine::number::largest_first;
use gumption_engine::propagate::gum::Gum;
use gumption_engine::propagate::monte_carlo::{MonteCarlo, StatedInterval};
use gumption_engine::propagate::{
    Conformity, ConformityLevel, OutputEvaluation, RowEvaluation, Stated, naming,
};
use gumption_engine::task::{Settings, Task};

/// What else there is of a sweep.
pub(crate) const MORE: &str = "Budgets, shortest intervals, numerical standard errors and correlations of every row: \
     --format json.";

/// Which rows' coverage interval is that of the trials, because clause 8 fails for the GUM's or there is
/// none; `None` where every row has the GUM's.
pub(crate) fn taken(settings: &Settings, rows: &[RowEvaluation], output: usize) -> Option<String> {
    let is_of_trials = |row: &RowEvaluation| {
        let found = row.outputs.get(output);
        found.is_some_and(|found| matches!(Taken::of(settings, found), Taken::Interval { .. }))
    };
    let (of_trials, others): (Vec<usize>, Vec<usize>) =
        (0..rows.len()).partition(|&row| is_of_trials(&rows[row]));
    let of = |places: &[usize]| {
        let plural = if places.len() == 1 { "row" } else { "rows" };
        format!("{plural} {}", row_numbers(places))
    };
    let place = match (of_trials.is_empty(), others.is_empty()) {
        (true, _) => return None,
        (_, true) => "in every row".to_owned(),
        // the shorter list says it
        _ if of_trials.len() <= others.len() => format!("in {}", of(&of_trials)),
        _ => format!("in all rows but {}", of(&others)),
    };
    Some(format!(
        "The stated coverage interval is the Monte Carlo interval, not estimate ± U, {place}."
    ))
}

/// The decisions about the rows of an output with a tolerance: the limits, the rule, and which rows
/// are rejected; `None` where there is none.
pub(crate) fn conformity(task: &Task, rows: &[RowEvaluation], output: usize) -> Option<String> {
    let quantity = &task.model.outputs.get(output)?.quantity;
    let found: Vec<(usize, &Conformity)> = rows
        .iter()
        .enumerate()
        .filter_map(|(row, of)| Some((row, of.outputs.get(output)?.conformity.as_deref()?)))
        .collect();
    let (_, first) = found.first()?;
    let rejected: Vec<usize> =
        found.iter().filter(|(_, of)| !of.conforms).map(|(row, _)| *row).collect();
    let plural = if rejected.len() == 1 { "row" } else { "rows" };
    let limits = |found: &Conformity| limits_text(quantity, &found.tolerance, None);
    let limits = match found.last() {
        Some((_, last)) if found.iter().any(|(_, of)| of.tolerance != first.tolerance) => format!(
            "of each row ({} in the first one, {} in the last one)",
            limits(first),
            limits(last)
        ),
        _ => limits(first),
    };
    let decided_apart = explained(
        rows.iter().filter_map(|row| row.outputs.get(output)),
        task.settings.digits_on_pages(),
    );
    let decided = if first.level.is_some() {
        let count = |level| found.iter().filter(|(_, of)| of.level == Some(level)).count();
        let counts = ConformityLevel::ALL.map(|level| format!("{} {}", level.name(), count(level)));
        format!("{} of {} rows", counts.join(", "), found.len())
    } else if rejected.is_empty() {
        format!("{0} of {0} rows accepted", found.len())
    } else {
        let (accepted, rows) = (found.len() - rejected.len(), row_numbers(&rejected));
        format!("{accepted} of {} rows accepted, rejected: {plural} {rows}", found.len())
    };
    Some(format!(
        "Tolerance {limits}, {}: {decided}. Probabilities, guard bands and risks of every row: --format \
         json.{}",
        rule(first, task.settings.coverage),
        decided_apart.map_or_else(String::new, |said| format!(" {said}"))
    ))
}

/// The line of a capability over the U of all rows; `None` where none is asked for.
pub(crate) fn capability_line(
    task: &Task,
    rows: &[RowEvaluation],
    output: usize,
) -> Option<(CapabilityLine, FittedLine, f64)> {
    let asked = task.model.outputs.get(output)?.capability_line?;
    let point = |row: &RowEvaluation| {
        let stated = Stated::of(row.outputs.get(output)?, &task.settings)?;
        Some((*row.conditions.get(asked.condition)?, stated.expanded_uncertainty))
    };
    let points: Vec<(f64, f64)> = rows.iter().map(point).collect::<Option<_>>()?;
    let form = if asked.is_quadratic { LineForm::Quadratic } else { LineForm::Linear };
    let line = capability_line::fit(&points, form, asked.digits)?;
    let excess = points.iter().map(|(at, expanded)| (line.at(*at) / expanded - 1.0).max(0.0));
    Some((asked, line, excess.sum::<f64>() / points.len() as f64))
}

/// The same as a sentence.
pub(crate) fn capability_line_text(
    task: &Task,
    rows: &[RowEvaluation],
    output: usize,
) -> Option<String> {
    let (asked, line, excess) = capability_line(task, rows, output)?;
    let unit = &task.model.outputs.get(output)?.quantity.unit;
    let condition = task.model.conditions.get(asked.condition)?;
    let [a, b] = [line.constant, line.slope].map(exact);
    let name = &condition.name;
    let text = match asked.is_quadratic {
        true => in_unit(&format!("Q[{a}; {b} {name}]"), unit),
        false => in_unit(&format!("({a} + {b} {name})"), unit),
    };
    let of = match condition.unit.text() {
        "" | "1" => String::new(),
        unit => format!(", {name} in {unit}"),
    };
    Some(format!(
        "CMC line: {text}{of}. U of all {} rows lies on or below it (k of this page), on average by {} %.",
        rows.len(),
        rounded(100.0 * excess, -1)
    ))
}

/// What the estimate that decides is, where a column shows it because it is not that of the GUM.
pub(crate) fn explained<'a>(
    outputs: impl Iterator<Item = &'a OutputEvaluation>,
    digits: u32,
) -> Option<&'static str> {
    let mut lines = outputs.map(|output| line(Some(output), digits));
    lines.any(|line| line.is_decided_apart).then_some(
        "The estimate that decides is the stated value: if clause 8 of JCGM 101 refutes the GUM \
         interval, the expectation of the output's distribution, if it has a variance.",
    )
}

/// Shares with a column of their own, at most.
const MOST_SHARES: usize = 8;

/// What has a share of the variance: an input, or the correlation of two.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Sharing {
    Input(usize),
    Correlation([usize; 2]),
}

/// All shares of a row.
fn sharing(gum: &Gum) -> impl Iterator<Item = (Sharing, f64)> + '_ {
    let inputs = gum.budget().map(|line| (Sharing::Input(line.variable), line.share));
    let correlations = gum.correlations();
    inputs.chain(correlations.map(|line| (Sharing::Correlation(line.variables), line.share)))
}

/// The shares of the variance in every row in per cent, the largest ones by themselves and the others
/// together, so that a row adds up to 100; `None` where none contributes.
pub(crate) fn shares(task: &Task, rows: &[RowEvaluation], output: usize) -> Option<Sheet> {
    let gums: Vec<Option<&Gum>> =
        rows.iter().map(|row| row.outputs.get(output)?.gum.as_ref()).collect();
    let mut largest: BTreeMap<Sharing, f64> = BTreeMap::new();
    for (of, share) in gums.iter().flatten().flat_map(|gum| sharing(gum)) {
        let known = largest.entry(of).or_default();
        *known = share.abs().max(*known);
    }
    let mut chosen: Vec<(Sharing, f64)> =
        largest.into_iter().filter(|(_, share)| *share > 0.0).collect();
    largest_first(&mut chosen, |of| of.1);
    let others = chosen.len().saturating_sub(MOST_SHARES);
    chosen.truncate(MOST_SHARES);
    let mut chosen: Vec<Sharing> = chosen.into_iter().map(|(of, _)| of).collect();
    chosen.sort_unstable();
    if chosen.is_empty() {
        return None;
    }
    let mut sheet = of_rows(task, rows);
    let mut column = |header: &str, holds: &dyn Fn(Sharing) -> bool| {
        let share = |gum: &Option<&Gum>| {
            let own = sharing((*gum)?).filter(|(of, _)| holds(*of));
            Some(100.0 * own.map(|(_, share)| share).sum::<f64>())
        };
        let cells = gums.iter().map(|gum| Figure::rounded(share(gum), |v| rounded(v, -1)));
        sheet.figures(header, cells);
    };
    let name = |variable: usize| {
        text::plain(task.variables.get(variable).map_or("", |variable| &variable.name))
    };
    for &of in &chosen {
        let header = match of {
            Sharing::Input(variable) => name(variable),
            Sharing::Correlation([a, b]) => format!("r({}, {})", name(a), name(b)),
        };
        column(&header, &|other| other == of);
    }
    if others > 0 {
        column(&format!("{others} others"), &|other| !chosen.contains(&other));
    }
    Some(sheet)
}

/// All outputs of one row of conditions, a line each.
pub(crate) fn summary(task: &Task, row: &RowEvaluation, digits: u32) -> Sheet {
    let outputs = &task.model.outputs;
    let lines: Vec<SweepLine> =
        (0..outputs.len()).map(|place| line(row.outputs.get(place), digits)).collect();
    let mut sheet = Sheet::default();
    sheet.text("output", outputs.iter().map(|output| text::plain(&output.quantity.name)));
    answer(&mut sheet, &lines, has_trials(row));
    let unit = |output: &Output| unit_text(&output.quantity.unit);
    sheet.units("unit", outputs.iter().map(unit));
    sheet
}

/// The header of uncertainties that are raised to the laboratory's capability in some rows.
const RAISED: &str = "to be stated\n(CMC)";

/// The header of the estimates that were decided about, where some are not those of the GUM.
const DECIDING: &str = "estimate\nthat decides";

/// The columns of the answer.
fn answer(sheet: &mut Sheet, lines: &[SweepLine], has_trials: bool) {
    let column = |position: usize| lines.iter().map(move |line| line.texts[position].clone());
    sheet.numbers("estimate", column(0));
    sheet.numbers("standard\nuncertainty", column(1));
    sheet.narrow("standard\nuncer-\ntainty");
    sheet.numbers("expanded\nuncertainty", column(2));
    sheet.narrow("expanded\nuncer-\ntainty");
    sheet.numbers("k", column(3));
    if lines.iter().any(|line| line.is_raised) {
        sheet.numbers(RAISED, lines.iter().map(|line| line.stated.clone()));
    }
    if has_trials {
        sheet.numbers("Monte Carlo\nfrom", column(4));
        sheet.numbers("to", column(5));
        sheet.text("GUM interval\nvalidated", column(6));
        sheet.narrow("GUM\ninterval\nvalidated");
        if lines.iter().any(|line| line.shortest == Some(true)) {
            let kind = |line: &SweepLine| match line.shortest {
                Some(true) => "shortest".to_owned(),
                Some(false) => "symmetric".to_owned(),
                None => missing(),
            };
            sheet.text("Monte Carlo\ninterval is", lines.iter().map(kind));
            sheet.narrow("interval\nis");
            sheet.aside();
        }
    }
    if lines.iter().any(|line| line.is_decided_apart) {
        sheet.numbers(DECIDING, lines.iter().map(|line| line.deciding.clone()));
    }
    if lines.iter().any(|line| line.decision != MISSING) {
        sheet.text("decision", lines.iter().map(|line| line.decision.to_owned()));
    }
}

/// Conditions up to which all of them stand beside the answer.
const MOST_SHOWN: usize = 3;

/// Further conditions in one table, at most, so that it is no wider than a sheet of paper.
const MOST_APART: usize = 7;

/// The conditions that stand beside the answer, by their places: none where it takes many to
/// tell the rows apart.
fn shown(task: &Task, rows: &[RowEvaluation]) -> Vec<usize> {
    let count = task.model.conditions.len();
    if count <= MOST_SHOWN {
        return (0..count).collect();
    }
    Some(naming(rows)).filter(|named| named.len() <= MOST_SHOWN).unwrap_or_default()
}

/// The conditions that do not stand beside the answer, each table with those that do.
pub(crate) fn apart(task: &Task, rows: &[RowEvaluation]) -> Vec<Sheet> {
    let shown = shown(task, rows);
    let count = task.model.conditions.len();
    let others: Vec<usize> = (0..count).filter(|place| !shown.contains(place)).collect();
    let table = |others: &[usize]| {
        let mut sheet = of_rows(task, rows);
        conditions(&mut sheet, task, rows, others);
        sheet
    };
    others.chunks(MOST_APART).map(table).collect()
}

/// A table whose first columns tell which row it is: the conditions that stand beside the answer, or the
/// row's number.
fn of_rows(task: &Task, rows: &[RowEvaluation]) -> Sheet {
    let mut sheet = Sheet::default();
    let shown = shown(task, rows);
    if shown.is_empty() {
        sheet.numbers("row", (1..=rows.len()).map(|number| number.to_string()));
    }
    conditions(&mut sheet, task, rows, &shown);
    sheet.naming = sheet.columns.len();
    sheet
}

/// A column for each of these conditions.
fn conditions(sheet: &mut Sheet, task: &Task, rows: &[RowEvaluation], places: &[usize]) {
    for &place in places {
        let Some(condition) = task.model.conditions.get(place) else { continue };
        let values = rows.iter().map(|row| row.conditions.get(place).copied());
        sheet.figures(&header(condition), values.map(|value| Figure::rounded(value, exact)));
    }
}

/// The table of an output over the first rows of a sweep, without a look.
pub(crate) fn sheet(task: &Task, rows: &[RowEvaluation], output: usize, digits: u32) -> Sheet {
    let mut sheet = of_rows(task, rows);
    let lines: Vec<SweepLine> =
        rows.iter().map(|row| line(row.outputs.get(output), digits)).collect();
    answer(&mut sheet, &lines, rows.iter().any(has_trials));
    sheet
}

fn has_trials(row: &RowEvaluation) -> bool {
    row.outputs.iter().any(|output| output.monte_carlo.is_some())
}

fn header(condition: &Quantity) -> String {
    let name = text::plain(&condition.name);
    if condition.unit.has_name() {
        format!("{name}\nin {}", unit_text(&condition.unit))
    } else {
        name
    }
}

fn missing() -> String {
    MISSING.to_owned()
}

/// What stands in a line.
struct SweepLine {
    /// Estimate, u, U, k, the two ends of the Monte Carlo interval, the verdict.
    texts: [String; 7],
    /// Whether that interval is the shortest one, if there is one.
    shortest: Option<bool>,
    /// The expanded uncertainty to be stated, beside the laboratory's capability.
    stated: String,
    /// Whether it is the capability.
    is_raised: bool,
    /// The estimate that was decided about.
    deciding: String,
    /// Whether it is another one than the estimate of the GUM, as they are printed.
    is_decided_apart: bool,
    /// What is decided of an output with a tolerance.
    decision: &'static str,
}

/// The interval is the one that is stated of a result: the shortest where the output is skew
/// (JCGM 101, 5.3.4), the symmetric one otherwise.
fn line(output: Option<&OutputEvaluation>, digits: u32) -> SweepLine {
    let gum = output.and_then(|output| output.gum.as_ref());
    let figures = output.and_then(|output| output.monte_carlo.as_deref());
    let gum_position = gum.and_then(|gum| position(gum.standard_uncertainty, digits));
    let own = figures.and_then(|figures| figures.standard_uncertainty);
    let spread = own.or_else(|| gum.map(|gum| gum.standard_uncertainty));
    let own_position = figures.and_then(|figures| place_of_ends(figures, spread, digits));
    let own_position = own_position.or(gum_position);
    let stated = figures.map(MonteCarlo::stated_interval);
    let end = |end: usize| {
        let text = |of: &StatedInterval| justified(of.ends[end], own_position, of.errors[end]);
        stated.as_ref().map_or_else(missing, text)
    };
    let validation = output.and_then(|output| output.validation);
    let verdict = match validation.map(|validation| validation.gum_valid) {
        Some(Some(true)) => "yes",
        Some(Some(false)) => "no",
        Some(None) => "undecided",
        None => MISSING,
    };
    let texts = [
        gum.map_or_else(missing, |gum| to(gum.estimate, gum_position)),
        gum.map_or_else(missing, |gum| to(gum.standard_uncertainty, gum_position)),
        gum.and_then(Gum::expanded_uncertainty)
            .map_or_else(missing, |expanded| significant(expanded, digits)),
        gum.and_then(|gum| gum.coverage_factor).map_or_else(missing, |k| rounded(k, -2)),
        end(0),
        end(1),
        verdict.to_owned(),
    ];
    let conformity = output.and_then(|output| output.conformity.as_deref());
    let decision = conformity.map_or(MISSING, decision);
    let error = figures.and_then(|figures| figures.errors.estimate).unwrap_or(0.0);
    let own = own.and_then(|u| position(u, digits));
    let deciding = conformity.map(|found| {
        let is_propagated = gum.is_some_and(|gum| gum.estimate == found.estimate);
        if is_propagated { texts[0].clone() } else { justified(found.estimate, own, error) }
    });
    let beside = output.and_then(|output| output.capability.as_deref());
    SweepLine {
        stated: beside
            .and_then(|beside| beside.rounded(digits))
            .map_or_else(missing, |expanded| expanded.to_string()),
        is_raised: beside.is_some_and(|beside| beside.raised),
        is_decided_apart: deciding.as_ref().is_some_and(|text| *text != texts[0]),
        deciding: deciding.unwrap_or_else(missing),
        texts,
        shortest: stated.map(|of| of.shortest),
        decision,
    }
}
