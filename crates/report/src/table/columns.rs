//! Columns of the budget that are shown on request.

use super::budget::{Budget, Field, coefficient_lines};
use super::rows::{InputRow, page_rows};
use super::text;
use crate::number::{MISSING, exact, significant};
use crate::sheet::ColumnKind;
use gumption_engine::decimal::to_digits;
use gumption_engine::model::Quantity;
use gumption_engine::propagate::InputFigures;
use gumption_engine::propagate::gum::BudgetLine;
use gumption_engine::task::Variable;
use gumption_units::Unit;

/// Significant digits of divisors: 1.732, 2.449.
const DIVISOR_DIGITS: u32 = 4;

/// Significant digits of stated widths, which come back from u(x_i) and its divisor. The one of
/// readings is computed and has those of the page.
const WIDTH_DIGITS: u32 = 6;

/// A column of the budget that is shown on request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BudgetColumn {
    /// The stated width: half-width of the limits, expanded or standard uncertainty.
    Width,
    /// What the stated width is divided by to give the standard uncertainty.
    Divisor,
    /// Standard uncertainty and contribution relative to the estimates, in per cent.
    Relative,
    /// Type A or B.
    Type,
    /// The group for subtotals.
    Group,
    /// The source of uncertainty, in words.
    About,
}

/// Places of the usual columns.
const ESTIMATE: usize = 1;
const UNCERTAINTY: usize = 2;
const DISTRIBUTION: usize = 4;
const CONTRIBUTION: usize = 7;
const SHARE: usize = 8;

impl BudgetColumn {
    /// All of them, in the order of the table.
    pub const ALL: [Self; 6] =
        [Self::Width, Self::Divisor, Self::Relative, Self::Type, Self::Group, Self::About];

    /// The name that the command line uses.
    pub fn name(self) -> &'static str {
        match self {
            Self::Width => "width",
            Self::Divisor => "divisor",
            Self::Relative => "relative",
            Self::Type => "type",
            Self::Group => "group",
            Self::About => "about",
        }
    }

    /// The column of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|column| column.name() == name)
    }
}

/// The fields of the wanted columns, each with the place of the usual column that it stands behind.
pub(super) fn fields(budget: &Budget<'_>, wanted: &[BudgetColumn]) -> Vec<(usize, Field)> {
    let wanted = BudgetColumn::ALL.into_iter().filter(|column| wanted.contains(column));
    wanted.flat_map(|column| of(budget, column)).collect()
}

fn of(budget: &Budget<'_>, column: BudgetColumn) -> Vec<(usize, Field)> {
    let Budget { gum, digits, output, .. } = *budget;
    let numbers = |headers, cells| Field { headers, kind: ColumnKind::Numbers, cells };
    let blank = String::new;
    match column {
        BudgetColumn::Width => {
            let width = |line: &BudgetLine, _: &Variable| {
                let width = line.divisor.map(|divisor| divisor * line.standard_uncertainty);
                match width {
                    Some(width) if line.distribution == "readings" => significant(width, digits),
                    Some(width) => exact(to_digits(width, WIDTH_DIGITS)),
                    None => missing(),
                }
            };
            vec![(ESTIMATE, numbers(["value ±"; 2], cells(budget, width, blank())))]
        }
        BudgetColumn::Divisor => {
            let divisor = |line: &BudgetLine, _: &Variable| {
                let divisor = line.divisor.map(|divisor| to_digits(divisor, DIVISOR_DIGITS));
                divisor.map_or_else(missing, exact)
            };
            vec![(ESTIMATE, numbers(["divisor"; 2], cells(budget, divisor, blank())))]
        }
        BudgetColumn::Relative => {
            let of_estimate = ["relative\nin %", "rela-\ntive\nin %"];
            let of_y = ["of y\nin %"; 2];
            let own = |line: &BudgetLine, variable: &Variable| {
                relative(line.standard_uncertainty, line.estimate, &variable.unit, digits)
            };
            let of_sum = |quantity: &Quantity, sum: &InputFigures| {
                relative(sum.standard_uncertainty, sum.estimate, &quantity.unit, digits)
            };
            let share = |value: f64| relative(value, gum.estimate, &output.unit, digits);
            let contribution = |line: &BudgetLine, _: &Variable| share(line.contribution);
            let total = share(gum.standard_uncertainty);
            vec![
                (UNCERTAINTY, numbers(of_estimate, all_cells(budget, own, of_sum, total.clone()))),
                (CONTRIBUTION, numbers(of_y, cells(budget, contribution, total))),
            ]
        }
        BudgetColumn::Type => {
            let letter =
                |_: &BudgetLine, variable: &Variable| variable.evaluation.letter().to_owned();
            let cells = cells(budget, letter, blank());
            vec![(DISTRIBUTION, Field { headers: ["type"; 2], kind: ColumnKind::Text, cells })]
        }
        BudgetColumn::Group => {
            let group = |_: &BudgetLine, variable: &Variable| {
                text::plain(variable.group.as_deref().unwrap_or_default())
            };
            let cells = cells(budget, group, blank());
            vec![(SHARE, Field { headers: ["group"; 2], kind: ColumnKind::Text, cells })]
        }
        BudgetColumn::About => {
            let about = |_: &BudgetLine, variable: &Variable| text::plain(&variable.about);
            let of_sum = |quantity: &Quantity, _: &InputFigures| text::plain(&quantity.about);
            let cells = all_cells(budget, about, of_sum, blank());
            let headers = ["source of\nuncertainty"; 2];
            vec![(SHARE, Field { headers, kind: ColumnKind::Text, cells })]
        }
    }
}

/// The cells of all variables, none for sums of components and correlation coefficients, that of the
/// output.
fn cells(
    budget: &Budget<'_>,
    of_input: impl Fn(&BudgetLine, &Variable) -> String,
    total: String,
) -> Vec<String> {
    all_cells(budget, of_input, |_, _| String::new(), total)
}

/// The cells of all variables and sums of components, none for the correlation coefficients, that of
/// the output.
fn all_cells(
    budget: &Budget<'_>,
    of_input: impl Fn(&BudgetLine, &Variable) -> String,
    of_sum: impl Fn(&Quantity, &InputFigures) -> String,
    total: String,
) -> Vec<String> {
    let Budget { task, gum, .. } = *budget;
    let inputs = page_rows(task, gum).into_iter().map(|row| match row {
        InputRow::Composed(quantity, figures) => of_sum(quantity, &figures),
        InputRow::Variable(variable, line) => of_input(&line, variable),
    });
    let coefficients = std::iter::repeat_n(String::new(), coefficient_lines(gum));
    inputs.chain(coefficients).chain([total]).collect()
}

/// A value relative to the modulus of an estimate, in per cent. A share of a temperature in degrees
/// Celsius or of a level says nothing, and there is none of zero.
fn relative(value: f64, estimate: f64, unit: &Unit, digits: u32) -> String {
    let share = 100.0 * value / estimate.abs();
    let is_share = !unit.is_celsius() && unit.level_exponent().is_zero() && share.is_finite();
    if is_share { significant(share, digits) } else { missing() }
}

fn missing() -> String {
    MISSING.to_owned()
}
