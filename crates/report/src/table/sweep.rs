//! A sweep over conditions: one table for each output, one line for each row.

use std::collections::BTreeMap;

use super::comparison::{decision, limits_text, rule};
use super::grid::{Grid, PAGE};
use super::{USUAL, conditions_text, row_numbers, text, title, width};
use crate::evaluation::Taken;
use crate::number::{
    MISSING, align, exact, justified, place_of_ends, position, rounded, significant, to,
};
use crate::sheet::{Figure, Sheet};
use gumption_engine::model::{Output, Quantity};
use gumption_engine::number::largest_first;
use gumption_engine::propagate::gum::Gum;
use gumption_engine::propagate::monte_carlo::{MonteCarlo, StatedInterval};
use gumption_engine::propagate::{Conformity, OutputEvaluation, RowEvaluation, naming};
use gumption_engine::task::{Settings, Task};

/// The tables of all outputs, part by part, an empty line apart.
pub(super) fn tables<'a>(
    task: &'a Task,
    rows: &'a [RowEvaluation],
    digits: u32,
) -> impl Iterator<Item = String> + 'a {
    let conditions = &task.model.conditions;
    let varying: Vec<usize> =
        (0..conditions.len()).filter(|&position| varies(rows, position)).collect();
    let unvaried = fixed(conditions, rows, &varying);
    let sweep = Sweep { task, rows, digits, has_trials: rows.iter().any(has_trials) };
    let [wide, narrow] =
        [WIDE, NARROW].map(|uncertainty| SweepLayout { labels: Labels::Conditions, uncertainty });
    let numbers = SweepLayout { labels: Labels::Numbers, uncertainty: WIDE };
    let layouts = [wide, narrow];
    // what was measured in every row may stand among the conditions: where all of them leave no room
    // for the answer, those that tell the rows apart name them
    let named = naming(rows);
    let choices = [&varying, &named].into_iter().flat_map(|of| layouts.map(|layout| (layout, of)));
    let chosen = choices.into_iter().find(|(layout, of)| sweep.fits(*layout, of));
    // a narrow page folds its tables behind the one condition that names the rows
    let folded = || match (named.as_slice(), width() < USUAL) {
        ([_], true) => (layouts[1], named.clone()),
        _ => (numbers, varying.clone()),
    };
    let (layout, varying) = chosen.map_or_else(folded, |(layout, of)| (layout, of.clone()));
    let hidden = if matches!(layout.labels, Labels::Numbers) {
        None
    } else {
        let count = (0..conditions.len()).filter(|&place| varies(rows, place)).count();
        others(count - varying.len())
    };
    let by_number = matches!(layout.labels, Labels::Numbers).then(|| varying.clone());
    let by_number = by_number.into_iter().flat_map(|varying| numbered(conditions, rows, varying));
    let outputs = task.model.outputs.iter().enumerate();
    let tables = outputs.flat_map(move |(output, Output { quantity, .. })| {
        let mut above = title(quantity) + "\n";
        let varying = varying.clone();
        let pages = (0..rows.len()).step_by(PAGE);
        let pages = pages.map(move |first| {
            let grid = sweep.grid(output, layout, &varying, first);
            std::mem::take(&mut above) + &grid.render(width())
        });
        let said = taken(&task.settings, rows, output).into_iter();
        let said = said.chain(conformity(task, rows, output));
        pages.chain(said.map(|said| text::wrapped(&said)))
    });
    let last = text::wrapped(MORE);
    unvaried.into_iter().chain(hidden).chain(by_number).chain(tables).chain([last])
}

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
        "The coverage interval to be taken is that of the Monte Carlo method, and not estimate ± U, \
         {place}."
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
    let decided_apart =
        explained(rows.iter().filter_map(|row| row.outputs.get(output)), task.settings.digits);
    Some(format!(
        "Tolerance {}, {}: {} of {} rows accepted{}. Probabilities, guard bands and risks of every row: \
         --format json.{}",
        limits,
        rule(first, task.settings.coverage),
        found.len() - rejected.len(),
        found.len(),
        if rejected.is_empty() {
            String::new()
        } else {
            format!(", rejected: {plural} {}", row_numbers(&rejected))
        },
        decided_apart.map_or_else(String::new, |said| format!(" {said}"))
    ))
}

/// What the estimate that decides is, where a column shows it because it is not that of the GUM.
pub(crate) fn explained<'a>(
    outputs: impl Iterator<Item = &'a OutputEvaluation>,
    digits: u32,
) -> Option<&'static str> {
    let mut lines = outputs.map(|output| line(Some(output), digits));
    lines.any(|line| line.is_decided_apart).then_some(
        "The estimate that decides is the value that is stated: where clause 8 of JCGM 101 refutes the \
         GUM, the expectation of the output's distribution, if the distribution has a variance.",
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
    let mut sheet = Sheet::default();
    conditions(&mut sheet, task, rows, &shown(task, rows));
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
    let unit = |output: &Output| text::plain(output.quantity.unit.text());
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
    sheet.numbers("expanded\nuncertainty", column(2));
    sheet.numbers("k", column(3));
    if lines.iter().any(|line| line.is_raised) {
        sheet.numbers(RAISED, lines.iter().map(|line| line.stated.clone()));
    }
    if has_trials {
        sheet.numbers("Monte Carlo\nfrom", column(4));
        sheet.numbers("to", column(5));
        sheet.text("GUM\ninterval", column(6));
        if lines.iter().any(|line| line.shortest == Some(true)) {
            let kind = |line: &SweepLine| match line.shortest {
                Some(true) => "shortest".to_owned(),
                Some(false) => "symmetric".to_owned(),
                None => missing(),
            };
            sheet.text("Monte Carlo\ninterval is", lines.iter().map(kind));
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

/// The conditions that stand beside the answer, by their places.
fn shown(task: &Task, rows: &[RowEvaluation]) -> Vec<usize> {
    let count = task.model.conditions.len();
    let naming = if count > MOST_SHOWN { naming(rows) } else { Vec::new() };
    if naming.is_empty() { (0..count).collect() } else { naming }
}

/// The conditions that do not stand beside the answer, each table with those that do.
pub(crate) fn apart(task: &Task, rows: &[RowEvaluation]) -> Vec<Sheet> {
    let shown = shown(task, rows);
    let count = task.model.conditions.len();
    let others: Vec<usize> = (0..count).filter(|place| !shown.contains(place)).collect();
    let table = |others: &[usize]| {
        let mut sheet = Sheet::default();
        conditions(&mut sheet, task, rows, &[&shown, others].concat());
        sheet
    };
    others.chunks(MOST_APART).map(table).collect()
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
    let mut sheet = Sheet::default();
    conditions(&mut sheet, task, rows, &shown(task, rows));
    let lines: Vec<SweepLine> =
        rows.iter().map(|row| line(row.outputs.get(output), digits)).collect();
    answer(&mut sheet, &lines, rows.iter().any(has_trials));
    sheet
}

fn has_trials(row: &RowEvaluation) -> bool {
    row.outputs.iter().any(|output| output.monte_carlo.is_some())
}

/// What the tables are made of.
#[derive(Clone, Copy, Debug)]
struct Sweep<'a> {
    task: &'a Task,
    rows: &'a [RowEvaluation],
    digits: u32,
    /// Whether there are trials in any row.
    has_trials: bool,
}

/// How they are set.
#[derive(Clone, Copy, Debug)]
struct SweepLayout {
    labels: Labels,
    /// The word below "standard" and "expanded".
    uncertainty: &'static str,
}

/// The word below "standard" and "expanded", and its form for narrow columns.
const WIDE: &str = "uncertainty";
const NARROW: &str = "uncer-\ntainty";

/// What stands at the start of a line.
#[derive(Clone, Copy, Debug)]
enum Labels {
    /// The varying conditions.
    Conditions,
    /// The number of the row.
    Numbers,
}

/// That conditions do not stand in the table.
fn others(count: usize) -> Option<String> {
    let plural = if count == 1 { "condition" } else { "conditions" };
    (count > 0)
        .then(|| text::wrapped(&format!("{count} more {plural} of every row: --format csv.")))
}

fn varies(rows: &[RowEvaluation], position: usize) -> bool {
    let mut values = rows.iter().map(|row| row.conditions.get(position));
    let first = values.next();
    values.any(|value| Some(value) != first)
}

/// The conditions that are the same in all rows.
fn fixed(conditions: &[Quantity], rows: &[RowEvaluation], varying: &[usize]) -> Option<String> {
    let row = rows.first()?;
    let (quantities, values) = chosen(conditions, row, |position| !varying.contains(&position));
    (!quantities.is_empty())
        .then(|| text::wrapped(&format!("at {}", conditions_text(&quantities, &values))))
}

/// The varying conditions of every row, by its number, page by page.
fn numbered<'a>(
    conditions: &'a [Quantity],
    rows: &'a [RowEvaluation],
    varying: Vec<usize>,
) -> impl Iterator<Item = String> + 'a {
    rows.chunks(PAGE).enumerate().map(move |(page, rows)| {
        let mut grid = Grid::default();
        grid.numbers("row", numbers(page * PAGE, rows.len()));
        grid.text(
            "conditions",
            rows.iter().map(|row| {
                let (quantities, values) =
                    chosen(conditions, row, |position| varying.contains(&position));
                conditions_text(&quantities, &values)
            }),
        );
        grid.render(width())
    })
}

/// The numbers of so many rows behind the first ones.
fn numbers(before: usize, count: usize) -> impl Iterator<Item = String> {
    (before + 1..=before + count).map(|number| number.to_string())
}

fn chosen(
    conditions: &[Quantity],
    row: &RowEvaluation,
    keep: impl Fn(usize) -> bool,
) -> (Vec<Quantity>, Vec<f64>) {
    let all = conditions.iter().cloned().zip(row.conditions.iter().copied()).enumerate();
    all.filter(|(position, _)| keep(*position)).map(|(_, condition)| condition).unzip()
}

impl Sweep<'_> {
    /// Whether all tables fit the page.
    fn fits(&self, layout: SweepLayout, varying: &[usize]) -> bool {
        (0..self.task.model.outputs.len()).all(|output| {
            let mut pages = (0..self.rows.len()).step_by(PAGE);
            pages.all(|first| self.grid(output, layout, varying, first).natural_width() <= width())
        })
    }

    /// A page of the table of an output, which begins with the row at `first`: of a long sweep only
    /// one is in memory.
    fn grid(&self, output: usize, layout: SweepLayout, varying: &[usize], first: usize) -> Grid {
        let rows = self.rows.get(first..).unwrap_or_default();
        let rows = &rows[..rows.len().min(PAGE)];
        let mut grid = Grid::default();
        match layout.labels {
            Labels::Numbers => grid.numbers("row", numbers(first, rows.len())),
            Labels::Conditions => {
                for &position in varying {
                    let Some(condition) = self.task.model.conditions.get(position) else {
                        continue;
                    };
                    let values = rows.iter().map(|row| row.conditions.get(position).copied());
                    grid.numbers(&header(condition), values.map(|v| v.map_or_else(missing, exact)));
                }
            }
        }
        let lines: Vec<SweepLine> =
            rows.iter().map(|row| line(row.outputs.get(output), self.digits)).collect();
        let column = |position: usize| lines.iter().map(move |line| line.texts[position].clone());
        let uncertainty = layout.uncertainty;
        grid.numbers("estimate", column(0));
        grid.numbers(&format!("standard\n{uncertainty}"), column(1));
        grid.numbers(&format!("expanded\n{uncertainty}"), column(2));
        grid.numbers("k", column(3));
        if lines.iter().any(|line| line.is_raised) {
            grid.numbers(RAISED, lines.iter().map(|line| line.stated.clone()));
        }
        if self.has_trials {
            let ends = [4, 5].map(|position| align(&column(position).collect::<Vec<_>>()));
            let [low, high] = ends;
            let are = |kind: Option<bool>| lines.iter().any(|line| line.shortest == kind);
            let (header, marked) = match (are(Some(true)), are(Some(false))) {
                (true, true) => ("Monte Carlo interval\nfrom, to; s: shortest", true),
                (true, false) => ("Monte Carlo interval\n(shortest) from, to", false),
                (false, _) => ("Monte Carlo interval\n(symmetric) from, to", false),
            };
            let intervals = low.into_iter().zip(high).zip(&lines).map(|((low, high), line)| {
                let mark = if marked && line.shortest == Some(true) { "  s" } else { "" };
                format!("{low}  {high}{mark}")
            });
            grid.text(header, intervals);
            grid.text("GUM\ninterval", column(6));
        }
        if lines.iter().any(|line| line.is_decided_apart) {
            grid.numbers(DECIDING, lines.iter().map(|line| line.deciding.clone()));
        }
        if lines.iter().any(|line| line.decision != MISSING) {
            grid.text("decision", lines.iter().map(|line| line.decision.to_owned()));
        }
        grid
    }
}

fn header(condition: &Quantity) -> String {
    let name = text::plain(&condition.name);
    if condition.unit.has_name() {
        format!("{name}\nin {}", text::plain(condition.unit.text()))
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
    let figures = output.and_then(|output| output.monte_carlo.as_ref());
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
        Some(Some(true)) => "valid",
        Some(Some(false)) => "not valid",
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
