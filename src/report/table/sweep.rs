//! A sweep over conditions: one table for each output, one line for each row.

use super::grid::Grid;
use super::{WIDTH, conditions_text, has_name, text, title};
use crate::model::{Output, Quantity};
use crate::propagate::gum::Gum;
use crate::propagate::{OutputEvaluation, RowEvaluation};
use crate::report::number::{MISSING, align, exact, justified, place, rounded, significant, to};
use crate::task::Task;

/// The tables of all outputs.
pub(super) fn tables(task: &Task, rows: &[RowEvaluation], digits: u32) -> String {
    let conditions = &task.model.conditions;
    let varying: Vec<usize> = (0..conditions.len()).filter(|&place| varies(rows, place)).collect();
    let outputs = &task.model.outputs;
    let grids = |labels: &Labels<'_>, width: &str| -> Vec<Grid> {
        (0..outputs.len()).map(|output| grid(task, rows, output, labels, width, digits)).collect()
    };
    let fits = |tables: &[Grid]| tables.iter().all(|grid| grid.natural_width() <= WIDTH);
    let mut tables = grids(&Labels::Conditions(&varying), WIDE);
    let mut parts = Vec::new();
    parts.extend(fixed(conditions, rows, &varying));
    if !fits(&tables) {
        tables = grids(&Labels::Conditions(&varying), NARROW);
    }
    if !fits(&tables) {
        tables = grids(&Labels::Numbers, WIDE);
        parts.push(numbered(conditions, rows, &varying));
    }
    for (Output { quantity, .. }, grid) in outputs.iter().zip(&tables) {
        parts.push(title(quantity) + "\n" + &grid.render(WIDTH));
    }
    parts.push(text::wrapped(
        "Budgets, shortest intervals, numerical standard errors and correlations of every row: \
         --format json.",
    ));
    parts.join("\n")
}

/// The word below "standard" and "expanded", and its form for narrow columns.
const WIDE: &str = "uncertainty";
const NARROW: &str = "uncer-\ntainty";

/// What stands at the start of a line.
enum Labels<'a> {
    /// The conditions at these places.
    Conditions(&'a [usize]),
    /// The number of the row.
    Numbers,
}

fn varies(rows: &[RowEvaluation], place: usize) -> bool {
    let mut values = rows.iter().map(|row| row.conditions.get(place));
    let first = values.next();
    values.any(|value| Some(value) != first)
}

/// The conditions that are the same in all rows.
fn fixed(conditions: &[Quantity], rows: &[RowEvaluation], varying: &[usize]) -> Option<String> {
    let row = rows.first()?;
    let (quantities, values) = chosen(conditions, row, |place| !varying.contains(&place));
    (!quantities.is_empty())
        .then(|| text::wrapped(&format!("at {}", conditions_text(&quantities, &values))))
}

/// The varying conditions of every row, by its number.
fn numbered(conditions: &[Quantity], rows: &[RowEvaluation], varying: &[usize]) -> String {
    let mut grid = Grid::default();
    grid.numbers("row", (1..=rows.len()).map(|number| number.to_string()));
    grid.text(
        "conditions",
        rows.iter().map(|row| {
            let (quantities, values) = chosen(conditions, row, |place| varying.contains(&place));
            conditions_text(&quantities, &values)
        }),
    );
    grid.render(WIDTH)
}

fn chosen(
    conditions: &[Quantity],
    row: &RowEvaluation,
    keep: impl Fn(usize) -> bool,
) -> (Vec<Quantity>, Vec<f64>) {
    let all = conditions.iter().cloned().zip(row.conditions.iter().copied()).enumerate();
    all.filter(|(place, _)| keep(*place)).map(|(_, condition)| condition).unzip()
}

fn grid(
    task: &Task,
    rows: &[RowEvaluation],
    output: usize,
    labels: &Labels<'_>,
    uncertainty: &str,
    digits: u32,
) -> Grid {
    let mut grid = Grid::default();
    match labels {
        Labels::Numbers => grid.numbers("row", (1..=rows.len()).map(|number| number.to_string())),
        Labels::Conditions(places) => {
            for &place in *places {
                let Some(condition) = task.model.conditions.get(place) else { continue };
                let values = rows.iter().map(|row| row.conditions.get(place).copied());
                grid.numbers(&header(condition), values.map(|v| v.map_or_else(missing, exact)));
            }
        }
    }
    let lines: Vec<[String; 7]> =
        rows.iter().map(|row| line(row.outputs.get(output), digits)).collect();
    let column = |place: usize| lines.iter().map(move |line| line[place].clone());
    grid.numbers("estimate", column(0));
    grid.numbers(&format!("standard\n{uncertainty}"), column(1));
    grid.numbers(&format!("expanded\n{uncertainty}"), column(2));
    grid.numbers("k", column(3));
    if rows.iter().any(|row| row.outputs.get(output).is_some_and(|o| o.monte_carlo.is_some())) {
        let ends = [4, 5].map(|place| align(&column(place).collect::<Vec<_>>()));
        let [low, high] = ends;
        let intervals = low.into_iter().zip(high).map(|(low, high)| format!("{low}  {high}"));
        grid.text("Monte Carlo interval\n(symmetric) from, to", intervals);
        grid.text("GUM\ninterval", column(6));
    }
    grid
}

fn header(condition: &Quantity) -> String {
    let name = text::plain(&condition.name);
    if has_name(&condition.unit) {
        format!("{name}\nin {}", text::plain(condition.unit.text()))
    } else {
        name
    }
}

fn missing() -> String {
    MISSING.to_owned()
}

/// Estimate, u, U, k, the two ends of the Monte Carlo interval, the verdict.
fn line(output: Option<&OutputEvaluation>, digits: u32) -> [String; 7] {
    let gum = output.and_then(|output| output.gum.as_ref());
    let figures = output.and_then(|output| output.monte_carlo.as_ref());
    let gum_place = gum.and_then(|gum| place(gum.standard_uncertainty, digits));
    let own = figures.and_then(|figures| figures.standard_uncertainty);
    let own_place = own.and_then(|u| place(u, digits)).or(gum_place);
    let end = |end: usize| {
        figures.map_or_else(missing, |figures| {
            let error = figures.errors.symmetric_interval[end];
            justified(figures.symmetric_interval[end], own_place, error)
        })
    };
    let validation = output.and_then(|output| output.validation);
    let verdict = match validation.map(|validation| validation.gum_valid) {
        Some(Some(true)) => "valid",
        Some(Some(false)) => "not valid",
        Some(None) => "undecided",
        None => MISSING,
    };
    [
        gum.map_or_else(missing, |gum| to(gum.estimate, gum_place)),
        gum.map_or_else(missing, |gum| to(gum.standard_uncertainty, gum_place)),
        gum.and_then(Gum::expanded_uncertainty)
            .map_or_else(missing, |expanded| significant(expanded, digits)),
        gum.and_then(|gum| gum.coverage_factor).map_or_else(missing, |k| rounded(k, -2)),
        end(0),
        end(1),
        verdict.to_owned(),
    ]
}
