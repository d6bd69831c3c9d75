//! The uncertainty budget of one output, and what follows from it.

use super::columns::{self, BudgetColumn};
use super::rows::{InputRow, page_rows};
use super::{Grid, coverage_text, text, unit_text};
use crate::number::{coefficient, exact, position, rounded, significant, with_uncertainty};
use crate::plot::horizontal_bar;
use crate::printed::grouped;
use crate::sheet::{ColumnKind, Figure, Sheet};
use crate::subtotals::Subtotals;
use gumption_engine::model::Quantity;
use gumption_engine::propagate::InputFigures;
use gumption_engine::propagate::gum::{BudgetLine, CorrelationLine, Dof, Gum};
use gumption_engine::task::{Coverage, Settings, Task};
use gumption_units::Unit;

/// Significant digits of sensitivity coefficients.
const SENSITIVITY_DIGITS: u32 = 4;

/// Correlation coefficients with a line each, at most; the shares of more are added up.
const MOST_COEFFICIENTS: usize = 500;

/// Letters of the longest bar beside a share.
const BAR: usize = 8;

/// Degrees of freedom above this are written as a power of ten.
const MANY: f64 = 1e7;

/// The usual columns: their headers as words, and broken for pages that would become too wide.
const HEADERS: [[&str; 2]; 9] = [
    ["quantity"; 2],
    ["estimate"; 2],
    ["standard\nuncertainty", "standard\nuncer-\ntainty"],
    ["unit"; 2],
    ["distribution", "distri-\nbution"],
    ["dof"; 2],
    ["sensitivity\ncoefficient", "sensi-\ntivity"],
    ["contribution", "contri-\nbution"],
    ["share\nin %"; 2],
];

/// The budget of one output, and what it is written with.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Budget<'a> {
    pub(crate) task: &'a Task,
    pub(crate) output: &'a Quantity,
    pub(crate) gum: &'a Gum,
    pub(crate) digits: u32,
}

/// A column of the budget.
#[derive(Clone, Debug)]
pub(super) struct Field {
    /// The header as words, and broken.
    pub(super) headers: [&'static str; 2],
    pub(super) kind: ColumnKind,
    /// The cells: inputs, correlation coefficients, the output.
    pub(super) cells: Vec<String>,
}

impl Budget<'_> {
    /// The budget with the combined standard uncertainty as its last line and the further columns in
    /// their places.
    pub(crate) fn sheet(&self, columns: &[BudgetColumn], has_bars: bool) -> Sheet {
        let further = columns::fields(self, columns);
        let mut sheet = Sheet { footer: true, ..Sheet::default() };
        let mut push = |field: &Field, aside: bool| {
            let [header, narrow] = field.headers;
            sheet.push(header, field.cells.iter().cloned(), field.kind);
            sheet.narrow(narrow);
            if aside {
                sheet.aside();
            }
        };
        for (position, field) in self.usual_fields().iter().enumerate() {
            push(field, false);
            let behind = further.iter().filter(|(behind, _)| *behind == position);
            behind.for_each(|(_, field)| push(field, true));
        }
        if has_bars {
            self.add_bars(&mut sheet);
        }
        sheet
    }

    /// Adds a column with a bar for the share of each input, if the page has room for it.
    fn add_bars(&self, sheet: &mut Sheet) {
        let mut with_bars = sheet.clone();
        let share = |row: InputRow<'_>| match row {
            InputRow::Composed(..) => 0.0,
            InputRow::Variable(_, line) => line.share,
        };
        let rows = page_rows(self.task, self.gum).into_iter().map(share);
        let bars = rows.map(|share| horizontal_bar(share, BAR)).collect::<Vec<_>>();
        let blank = sheet.rows().saturating_sub(bars.len());
        let blank = std::iter::repeat_n(String::new(), blank);
        with_bars.text("", bars.into_iter().chain(blank));
        // the headers stay whole if they are whole without bars
        let has_room = match Grid::wide(sheet).natural_width() <= super::width() {
            true => Grid::wide(&with_bars).natural_width() <= super::width(),
            false => Grid::of(&with_bars).natural_width() <= super::width(),
        };
        if has_room {
            *sheet = with_bars;
        }
    }

    fn usual_fields(&self) -> Vec<Field> {
        let Self { task, output, gum, digits } = *self;
        let lines = lines(task, output, gum, digits);
        let field = |(position, headers): (usize, [&'static str; 2])| Field {
            headers,
            kind: match position {
                0 | 4 => ColumnKind::Text,
                3 => ColumnKind::Units,
                _ => ColumnKind::Numbers,
            },
            cells: lines.iter().map(|line| line[position].clone()).collect(),
        };
        HEADERS.into_iter().enumerate().map(field).collect()
    }
}

/// The cells of a line.
type BudgetCells = [String; 9];

/// What stands for the distribution of a quantity that is made of components.
pub(crate) const COMPOSED: &str = "components";

/// The line of a quantity that is made of components.
fn composed(quantity: &Quantity, figures: &InputFigures, digits: u32) -> BudgetCells {
    let (estimate, uncertainty) =
        with_uncertainty(figures.estimate, figures.standard_uncertainty, digits);
    let mut line = BudgetCells::default();
    line[0] = text::plain(&quantity.name);
    line[1] = estimate;
    line[2] = uncertainty;
    line[3] = unit_text(&quantity.unit);
    line[4] = COMPOSED.to_owned();
    line[5] = effective(figures.dof, true);
    line
}

fn lines(task: &Task, output: &Quantity, gum: &Gum, digits: u32) -> Vec<BudgetCells> {
    let inputs = page_rows(task, gum).into_iter().map(|row| {
        let (variable, line) = match row {
            InputRow::Composed(quantity, figures) => return composed(quantity, &figures, digits),
            InputRow::Variable(variable, line) => (variable, line),
        };
        let (estimate, uncertainty) =
            with_uncertainty(line.estimate, line.standard_uncertainty, digits);
        [
            text::plain(&variable.name),
            estimate,
            uncertainty,
            unit_text(&variable.unit),
            distribution(&line),
            dof(line.dof),
            significant(line.sensitivity, SENSITIVITY_DIGITS),
            significant(line.contribution, digits),
            percent(line.share),
        ]
    });
    let mut lines: Vec<BudgetCells> = inputs.chain(coefficients(task, gum)).collect();
    let (estimate, combined) = with_uncertainty(gum.estimate, gum.standard_uncertainty, digits);
    let mut total = BudgetCells::default();
    total[0] = text::plain(&output.name);
    total[1] = estimate;
    total[2] = combined.clone();
    total[3] = unit_text(&output.unit);
    total[4] = "combined".to_owned();
    total[5] = effective(gum.dof, false);
    total[7] = combined;
    total[8] = percent(if gum.standard_uncertainty > 0.0 { 1.0 } else { 0.0 });
    lines.push(total);
    lines
}

/// The lines of the correlation coefficients; a single one if there are very many.
fn coefficients(task: &Task, gum: &Gum) -> Vec<BudgetCells> {
    let count = gum.correlations().count();
    if count > MOST_COEFFICIENTS {
        let mut cells = BudgetCells::default();
        cells[0] = format!("{} coefficients", grouped(count as u64));
        cells[4] = "correlation".to_owned();
        cells[8] = percent(gum.correlations().map(|line| line.share).sum());
        return vec![cells];
    }
    let line = |line: CorrelationLine| {
        let [a, b] = line.variables.map(|position| task.variables.get(position));
        let mut cells = BudgetCells::default();
        cells[0] = format!("r({}, {})", text::plain(&a?.name), text::plain(&b?.name));
        cells[1] = coefficient(line.coefficient);
        cells[4] = "correlation".to_owned();
        cells[8] = percent(line.share);
        Some(cells)
    };
    gum.correlations().filter_map(line).collect()
}

/// How many lines the correlation coefficients have.
pub(super) fn coefficient_lines(gum: &Gum) -> usize {
    let count = gum.correlations().count();
    if count > MOST_COEFFICIENTS { 1 } else { count }
}

fn distribution(line: &BudgetLine) -> String {
    match line.drawn_as {
        Some(drawn) => format!("{} (drawn as {drawn})", line.distribution),
        None => line.distribution.to_owned(),
    }
}

/// What the columns mean.
pub(crate) fn legend(output: &Quantity, columns: &[BudgetColumn]) -> String {
    let mut legend = if output.unit.has_name() {
        let unit = unit_text(&output.unit);
        format!(
            "sensitivity coefficients in {unit} per unit of the quantity, contributions in {unit}"
        )
    } else {
        "sensitivity coefficients per unit of the quantity".to_owned()
    };
    if columns.contains(&BudgetColumn::Relative) {
        let name = &output.name;
        legend += &format!(
            "; relative: standard uncertainty to the modulus of the estimate; of y: \
             contribution to the modulus of {name}"
        );
    }
    legend
}

/// Shares by group and by type, where there is more than one of them.
pub(crate) fn subtotals(task: &Task, gum: &Gum) -> Option<String> {
    let Subtotals { groups, types } = Subtotals::of(task, gum);
    let entry = |name: &str, share: f64| format!("{} {} %", text::plain(name), percent(share));
    let mut sums = Vec::new();
    if groups.iter().any(|(group, _)| group.is_some()) {
        let named = groups.iter().map(|&(group, share)| entry(group.unwrap_or("no group"), share));
        sums.push(named.collect::<Vec<_>>().join(", "));
    }
    let both = types.iter().all(|(kind, _)| {
        let mut lines = gum.budget().filter(|line| line.contribution > 0.0);
        lines.any(|line| task.variables.get(line.variable).is_some_and(|v| v.evaluation == *kind))
    });
    if both {
        let [a, b] = types.map(|(kind, share)| entry(&format!("type {}", kind.letter()), share));
        sums.push(format!("{a}, {b}"));
    }
    if sums.is_empty() {
        return None;
    }
    if gum.is_correlated() {
        sums.push(entry("correlations", gum.correlations().map(|line| line.share).sum()));
    }
    Some(format!("subtotals: {}", sums.join("; ")))
}

/// A figure that follows from the budget.
#[derive(Clone, Debug)]
pub(crate) struct Conclusion {
    pub(crate) name: &'static str,
    pub(crate) figure: Figure,
    /// Its unit, if it has one.
    pub(crate) unit: Option<Unit>,
    /// What is said behind it.
    pub(crate) remark: String,
}

/// Combined standard uncertainty, degrees of freedom, coverage factor, expanded uncertainty.
pub(crate) fn conclusions(
    settings: &Settings,
    output: &Quantity,
    gum: &Gum,
    digits: u32,
) -> [Conclusion; 4] {
    let conclusion = |name, figure| Conclusion { name, figure, unit: None, remark: String::new() };
    let (_, combined) = with_uncertainty(gum.estimate, gum.standard_uncertainty, digits);
    // an agreed factor has the probability of a normal distribution, which finite degrees of freedom
    // do not leave it
    let is_agreed = matches!(settings.coverage, Coverage::Factor { fixed: true, .. })
        && matches!(gum.dof, Dof::Finite(_));
    let about = match is_agreed {
        true => "whatever the degrees of freedom".to_owned(),
        false => format!("for {}", coverage_text(settings.coverage)),
    };
    let (factor, remark) = match gum.coverage_factor {
        Some(factor) => (Figure::of(factor, rounded(factor, -2)), about),
        None => {
            let text = "not defined for these degrees of freedom".to_owned();
            (Figure { text, value: None }, String::new())
        }
    };
    let dof = match gum.dof {
        Dof::Finite(dof) => Some(dof),
        Dof::Infinite | Dof::Undefined => None,
    };
    let dof = Figure { text: effective(gum.dof, settings.real_dof), value: dof };
    let expanded = gum.expanded_uncertainty();
    let unit = expanded.map(|_| output.unit.of_differences());
    let expanded = match expanded {
        Some(expanded) => Figure::of(expanded, significant(expanded, digits)),
        None => Figure { text: "not defined".to_owned(), value: None },
    };
    [
        Conclusion {
            unit: Some(output.unit.of_differences()),
            ..conclusion(
                "combined standard uncertainty",
                Figure::of(gum.standard_uncertainty, combined),
            )
        },
        conclusion("effective degrees of freedom", dof),
        Conclusion { remark, ..conclusion("coverage factor", factor) },
        Conclusion { unit, ..conclusion("expanded uncertainty", expanded) },
    ]
}

/// Effective degrees of freedom above this are not told apart: they are an estimate, and k is that of
/// a normal distribution.
const MOST_DOF: f64 = 10_000.0;

/// The effective degrees of freedom: their integer part, with which the coverage factor is taken,
/// unless that is asked for at the real number or is zero.
fn effective(value: Dof, real: bool) -> String {
    match value {
        Dof::Undefined => "undefined".to_owned(),
        Dof::Infinite => dof(f64::INFINITY),
        Dof::Finite(value) => {
            let whole = (value * (1.0 + 1e-9)).floor();
            if whole > MOST_DOF && !real {
                return "more than 10 000".to_owned();
            }
            if real || whole < 1.0 { significant(value, 4) } else { dof(whole) }
        }
    }
}

/// Degrees of freedom of one line.
fn dof(value: f64) -> String {
    if value == f64::INFINITY {
        "∞".to_owned()
    } else if value.is_nan() {
        "undefined".to_owned()
    } else if value < MANY && value.fract() != 0.0 {
        rounded(value, position(value, 3).unwrap_or(0).min(-1))
    } else if value < MANY {
        exact(value)
    } else {
        significant(value, 2)
    }
}

fn percent(share: f64) -> String {
    rounded(100.0 * share, -1)
}
