//! The tables of a certificate whose columns the laboratory chooses.

use super::CertificateReport;
use super::conformity;
use super::sentences::SentenceLanguage;
use super::sheets;
use super::stated::{self, StatedRow};
use super::words::{self, Words, stacked};
use crate::number::{exact, position, rounded, to};
use crate::plain;
use crate::printed::with_symbols;
use crate::sheet::{Figure, Sheet};
use gumption_analysis::certificate::Basis;
use gumption_analysis::certificate::contents::{
    Certificate, ColumnContent, ColumnUnit, LayoutColumn, LayoutTable, Rounding,
};
use gumption_analysis::certificate::rounding::expanded;
use gumption_engine::decimal::{Decimal, Direction};
use gumption_units::Unit;

/// Significant digits of the standard uncertainty to which the estimate of an input is shown, if no
/// column of U has its kind of unit.
const DIGITS_OF_INPUTS: u32 = 2;

/// A table with its title, which may be empty.
pub(super) struct TitledSheet {
    pub(super) title: String,
    pub(super) sheet: Sheet,
}

/// The result tables: those of the layout, or the usual one.
pub(super) fn tables(report: &CertificateReport<'_>) -> Vec<TitledSheet> {
    let layout = &report.certificate.layout;
    if layout.is_empty() {
        return vec![TitledSheet { title: String::new(), sheet: sheets::results(report) }];
    }
    let languages = &report.certificate.languages;
    let table = |(place, table): (usize, &LayoutTable)| {
        let title = table.title.as_ref().map(|title| plain(&title.all(languages).join(" / ")));
        let lines = lines(report, place);
        TitledSheet { title: title.unwrap_or_default(), sheet: sheet(report, table, &lines) }
    };
    layout.iter().enumerate().map(table).collect()
}

/// A line of a table: the rows of one evaluation under the same conditions.
pub(super) struct TableLine<'a> {
    rows: Vec<StatedRow<'a>>,
}

/// The lines of the table at `place`, in the order of their first rows.
pub(super) fn lines<'a>(report: &CertificateReport<'a>, place: usize) -> Vec<TableLine<'a>> {
    let mut lines: Vec<TableLine<'a>> = Vec::new();
    for row in stated::rows(report).into_iter().filter(|row| row.line.table == place) {
        let is_same = |line: &&mut TableLine<'_>| {
            line.rows.first().is_some_and(|first| {
                (first.line.evaluation, first.line.row) == (row.line.evaluation, row.line.row)
                    // one output cannot stand twice in a line
                    && !line.has(&row.quantity.name)
            })
        };
        match lines.iter_mut().find(is_same) {
            Some(line) => line.rows.push(row),
            None => lines.push(TableLine { rows: vec![row] }),
        }
    }
    lines
}

impl<'a> TableLine<'a> {
    /// The row that states an output.
    fn of(&self, output: &str) -> Option<&StatedRow<'a>> {
        self.rows.iter().find(|row| row.quantity.name == output)
    }

    fn has(&self, output: &str) -> bool {
        self.of(output).is_some()
    }

    /// A value in a unit: of an output before rounding, of an input or of a condition.
    fn value_in(&self, name: &str, unit: &Unit) -> Option<f64> {
        let (value, own) = match self.of(name) {
            Some(row) => (row.statement.value, &row.quantity.unit),
            None => {
                let first = self.rows.first()?;
                first.asked.value(first.line.row, name)?
            }
        };
        Unit::convert(value, own, unit).ok()
    }
}

fn sheet(report: &CertificateReport<'_>, table: &LayoutTable, lines: &[TableLine<'_>]) -> Sheet {
    let languages = &report.certificate.languages;
    let header = |word: fn(&Words) -> &'static str| stacked(languages, word);
    let mut sheet = Sheet::default();
    let number = |line: &TableLine<'_>| {
        let numbers: Vec<String> = line.rows.iter().map(|row| row.number.to_string()).collect();
        numbers.join(", ")
    };
    sheet.text(&header(|w| w.row), lines.iter().map(number));
    for column in &table.columns {
        let heading = heading(report, column, lines);
        let cell = |line: &TableLine<'_>| cell(report, table, column, line);
        let cells = lines.iter().map(cell);
        match column.content {
            ColumnContent::Label | ColumnContent::Limits | ColumnContent::Decision => {
                sheet.text(&heading, cells.map(|figure| figure.text));
            }
            _ => sheet.figures(&heading, cells),
        }
    }
    // the sentences refer to what k and U rest on
    let shows = |content| table.columns.iter().any(|column| column.content == content);
    let rows: Vec<&StatedRow<'_>> = lines.iter().flat_map(|line| &line.rows).collect();
    let has_factor = rows.iter().any(|row| row.statement.basis == Basis::Student);
    if !shows(ColumnContent::Dof) && has_factor && lines.iter().all(|line| line.rows.len() == 1) {
        sheet.figures("ν_eff", rows.iter().map(|row| row.dof()));
    }
    for row in intervals(report, lines) {
        let [low, high] = row.ends;
        sheet.figures(&format!("{}{}", header(|w| w.low), row.of), low);
        sheet.figures(&format!("{}{}", header(|w| w.high), row.of), high);
    }
    sheet
}

/// The endpoints of the coverage intervals of an output, line by line.
struct Intervals {
    /// The name of the output in brackets if the table has several.
    of: String,
    ends: [Vec<Figure>; 2],
}

/// The coverage intervals of the outputs that have some.
fn intervals(report: &CertificateReport<'_>, lines: &[TableLine<'_>]) -> Vec<Intervals> {
    let names = outputs(lines);
    let empty = || Figure { text: String::new(), value: None };
    let of = |name: &String| {
        let ends = lines.iter().map(|line| line.of(name).and_then(|row| row.interval(report)));
        let ends: Vec<Option<[Figure; 2]>> = ends.collect();
        if ends.iter().all(Option::is_none) {
            return None;
        }
        let [low, high] = [0, 1].map(|place: usize| {
            let end = |ends: &Option<[Figure; 2]>| {
                ends.as_ref().map_or_else(empty, |ends| ends[place].clone())
            };
            ends.iter().map(end).collect()
        });
        let of = if names.len() > 1 { format!("\n({})", plain(name)) } else { String::new() };
        Some(Intervals { of, ends: [low, high] })
    };
    names.iter().filter_map(of).collect()
}

/// The names of the outputs of a table, each once.
fn outputs(lines: &[TableLine<'_>]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for row in lines.iter().flat_map(|line| &line.rows) {
        if !names.contains(&row.quantity.name) {
            names.push(row.quantity.name.clone());
        }
    }
    names
}

/// What stands above a column, with its unit.
fn heading(
    report: &CertificateReport<'_>,
    column: &LayoutColumn,
    lines: &[TableLine<'_>],
) -> String {
    let languages = &report.certificate.languages;
    let word = |word: fn(&Words) -> &'static str| stacked(languages, word);
    let of_output = |symbol: &str| match outputs(lines).len() {
        1 => symbol.to_owned(),
        _ => format!("{symbol}({})", plain(&column.quantity)),
    };
    let named = match (&column.heading, column.content) {
        (Some(heading), _) => {
            let texts: Vec<String> = heading.all(languages).into_iter().map(plain).collect();
            texts.join(" /\n")
        }
        (None, ColumnContent::Value) => plain(&column.quantity),
        (None, ColumnContent::Expanded) => of_output("U"),
        (None, ColumnContent::Factor) => of_output("k"),
        (None, ColumnContent::Dof) => of_output("ν_eff"),
        (None, ColumnContent::Probability) => word(|w| w.probability),
        (None, ColumnContent::Limits) => word(|w| w.limits_heading),
        (None, ColumnContent::Decision) => word(|w| w.conformity),
        (None, ColumnContent::Label) => String::new(),
    };
    let unit = shown_unit(column, lines).filter(|unit| unit.has_name());
    match unit.filter(|_| has_unit(column.content)) {
        Some(unit) => {
            let unit = plain(with_symbols(&unit).text());
            format!("{named}\n{}", words::in_unit(languages, &unit))
        }
        None => named,
    }
}

/// Whether the numbers of a column have a unit.
fn has_unit(content: ColumnContent) -> bool {
    matches!(content, ColumnContent::Value | ColumnContent::Expanded | ColumnContent::Limits)
}

/// The unit of the numbers of a column; `None` if it is in no line.
fn shown_unit(column: &LayoutColumn, lines: &[TableLine<'_>]) -> Option<Unit> {
    match &column.unit {
        ColumnUnit::Other(unit) | ColumnUnit::Relative { unit, .. } => Some(unit.clone()),
        ColumnUnit::Own => lines.iter().find_map(|line| own_unit(column, line)),
    }
}

fn own_unit(column: &LayoutColumn, line: &TableLine<'_>) -> Option<Unit> {
    let own = match line.of(&column.quantity) {
        Some(row) => &row.quantity.unit,
        None => {
            let first = line.rows.first()?;
            first.asked.value(first.line.row, &column.quantity)?.1
        }
    };
    Some(match column.content {
        ColumnContent::Expanded => own.of_differences(),
        _ => own.clone(),
    })
}

/// The cell of a column in a line; empty if the line does not state the output.
fn cell(
    report: &CertificateReport<'_>,
    table: &LayoutTable,
    column: &LayoutColumn,
    line: &TableLine<'_>,
) -> Figure {
    let empty = || Figure { text: String::new(), value: None };
    let found = match (column.content, line.of(&column.quantity)) {
        (ColumnContent::Label, _) => {
            let label = line.rows.iter().find_map(|row| row.line.label.as_ref());
            let label = label.map(|label| label.all(&report.certificate.languages).join(" / "));
            return Figure { text: plain(&label.unwrap_or_default()), value: None };
        }
        (ColumnContent::Value, None) => of_input(report, table, column, line),
        (ColumnContent::Value, Some(row)) => value(report, column, row),
        (ColumnContent::Expanded, Some(row)) => uncertainty(report, column, row, line),
        (ColumnContent::Factor, Some(row)) => Some(row.factor()),
        (ColumnContent::Dof, Some(row)) => Some(row.dof()),
        (ColumnContent::Probability, Some(row)) => Some(row.percent()),
        (ColumnContent::Limits, Some(row)) => limits(report, column, row),
        (ColumnContent::Decision, Some(row)) => decision(report, row),
        (_, None) => None,
    };
    found.unwrap_or_else(empty)
}

/// The unit of a column of an output's row.
fn unit_of<'c>(column: &'c LayoutColumn, row: &'c StatedRow<'_>) -> &'c Unit {
    match &column.unit {
        ColumnUnit::Other(unit) => unit,
        ColumnUnit::Own | ColumnUnit::Relative { .. } => &row.quantity.unit,
    }
}

/// U of a row in another unit of its kind, rounded by the rule of the certificate.
fn converted_expanded(
    report: &CertificateReport<'_>,
    row: &StatedRow<'_>,
    unit: &Unit,
) -> Option<Decimal> {
    let own = &row.quantity.unit;
    if own.text() == unit.text() {
        return row.statement.rounded;
    }
    let factor = Unit::conversion_factor(own, unit).ok()?;
    expanded(
        factor * row.statement.expanded_uncertainty,
        report.certificate.digits,
        rule(report, row),
    )
}

/// The rule of rounding of a row: up where rounding to the nearest would bring U below the
/// laboratory's capability.
fn rule(report: &CertificateReport<'_>, row: &StatedRow<'_>) -> Rounding {
    if row.is_kept(report) { Rounding::Up } else { report.certificate.rounding }
}

fn value(
    report: &CertificateReport<'_>,
    column: &LayoutColumn,
    row: &StatedRow<'_>,
) -> Option<Figure> {
    let unit = unit_of(column, row);
    if unit.text() == row.quantity.unit.text() {
        return Some(row.value());
    }
    let value = Unit::convert(row.statement.value, &row.quantity.unit, unit).ok()?;
    let Some(rounded) = converted_expanded(report, row, unit) else {
        return Some(Figure::of(value, exact(value)));
    };
    let shown = Decimal::shortest(value)?.round(rounded.position(), Direction::Nearest);
    Some(Figure::of(shown.value(), shown.to_string()))
}

fn uncertainty(
    report: &CertificateReport<'_>,
    column: &LayoutColumn,
    row: &StatedRow<'_>,
    line: &TableLine<'_>,
) -> Option<Figure> {
    let shown = match &column.unit {
        ColumnUnit::Relative { unit, to } => {
            let base = line.value_in(to, &row.quantity.unit)?.abs();
            if base == 0.0 {
                return Some(Figure::missing());
            }
            let share = unit.from_si(row.statement.expanded_uncertainty / base);
            let Certificate { digits, .. } = *report.certificate;
            expanded(share, digits, rule(report, row))
        }
        _ => converted_expanded(report, row, unit_of(column, row)),
    };
    Some(shown.map_or_else(
        || Figure::of(0.0, "0".to_owned()),
        |shown| Figure::of(shown.value(), shown.to_string()),
    ))
}

/// The estimate of an input or the value of a condition. An input with an uncertainty has the last
/// digit of the first column of U in its kind of unit.
fn of_input(
    report: &CertificateReport<'_>,
    table: &LayoutTable,
    column: &LayoutColumn,
    line: &TableLine<'_>,
) -> Option<Figure> {
    let first = line.rows.first()?;
    let (_, own) = first.asked.value(first.line.row, &column.quantity)?;
    let unit = match &column.unit {
        ColumnUnit::Other(unit) => unit,
        ColumnUnit::Own | ColumnUnit::Relative { .. } => own,
    };
    let value = line.value_in(&column.quantity, unit)?;
    if let Some(decimals) = column.decimals {
        let place = -i32::try_from(decimals).unwrap_or(0);
        return Some(Figure::of(value, rounded(value, place)));
    }
    let u = first.asked.standard_uncertainty(first.line.row, &column.quantity);
    let Some(u) = u.filter(|u| *u > 0.0) else { return Some(Figure::of(value, exact(value))) };
    let of_u = |column: &LayoutColumn| {
        let row = line.of(&column.quantity)?;
        let is_absolute = !matches!(column.unit, ColumnUnit::Relative { .. });
        let is_alike = row.quantity.unit.is_compatible(unit);
        if column.content != ColumnContent::Expanded || !is_absolute || !is_alike {
            return None;
        }
        converted_expanded(report, row, unit).map(Decimal::position)
    };
    let place = table.columns.iter().find_map(of_u).or_else(|| {
        let factor = Unit::conversion_factor(own, unit).ok()?;
        position(factor * u, DIGITS_OF_INPUTS)
    });
    Some(Figure::of(value, to(value, place)))
}

/// The tolerance limits: `±5` if they are symmetric about 0.
fn limits(
    report: &CertificateReport<'_>,
    column: &LayoutColumn,
    row: &StatedRow<'_>,
) -> Option<Figure> {
    let output = row.asked.task.model.outputs.get(row.line.output)?;
    let tolerance = output.at(row.conditions).tolerance?;
    let (own, unit) = (&row.quantity.unit, unit_of(column, row));
    let converted = |end: f64| Some(exact(Unit::convert(end, own, unit).ok()?));
    let text = match (tolerance.lower, tolerance.upper) {
        (Some(low), Some(high)) if low == -high => format!("±{}", converted(high)?),
        (Some(low), Some(high)) => format!("{} … {}", converted(low)?, converted(high)?),
        (Some(low), None) => format!("≥ {}", converted(low)?),
        (None, Some(high)) => format!("≤ {}", converted(high)?),
        (None, None) => return None,
    };
    let mark = report.certificate.decimal_mark;
    Some(Figure { text: super::sentences::in_marks(mark, &text), value: None })
}

fn decision(report: &CertificateReport<'_>, row: &StatedRow<'_>) -> Option<Figure> {
    let found = row.conformity()?;
    let of = SentenceLanguage::on_page(report);
    let words = of.iter().map(|of| conformity::decided(&found, of.words()));
    let mut texts: Vec<&str> = Vec::new();
    for word in words {
        if !texts.contains(&word) {
            texts.push(word);
        }
    }
    Some(Figure { text: texts.join(" / "), value: None })
}

/// Whether the table of a row shows limits and decision of its output, so that no sentence has to
/// repeat them.
pub(super) fn shows_decision(report: &CertificateReport<'_>, row: &StatedRow<'_>) -> bool {
    let shows = |content| {
        report.certificate.layout.get(row.line.table).is_some_and(|table| {
            let columns = table.columns.iter();
            let mut columns = columns.filter(|column| column.content == content);
            columns.any(|column| column.quantity == row.quantity.name)
        })
    };
    shows(ColumnContent::Limits) && shows(ColumnContent::Decision)
}
