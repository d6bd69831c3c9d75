//! The rows of a budget: what their cells say.

use std::ops::RangeInclusive;

use super::ask::{ReadSheet, beginning};
use super::both::sides;
use super::columns::{self, Column, identifier};
use super::concise::concise;
use super::equation::as_formula;
use super::grid::is_empty;
use super::number::{half_digit, without_groups, written};
use super::table::Header;
use super::widths::{StatedShape, divisor_of, without_factor};
use super::words;
use gumption_engine::decimal::to_15_digits;
use gumption_engine::fact;
use gumption_engine::model::formula::{Formula, check_name};
use gumption_engine::number::Shortest;
use gumption_text::named_shape::NamedShape;
use gumption_text::share::{self, Share};
use gumption_text::value_text::{PLUS_MINUS, grouped_digits};
use gumption_units::{Unit, listed};

/// A row of the budget: a quantity.
#[derive(Clone, Debug, Default)]
pub(super) struct Row {
    pub(super) line: usize,
    /// The name in formulas.
    pub(super) name: String,
    /// The words of the sheet.
    pub(super) about: String,
    pub(super) estimate: Option<f64>,
    /// As the sheet writes it; empty for a plain number.
    pub(super) unit: String,
    pub(super) width: Option<f64>,
    pub(super) std: Option<f64>,
    pub(super) distribution: Option<&'static str>,
    pub(super) divisor: Option<f64>,
    /// The coverage probability that the divisor is of, where no factor is stated.
    pub(super) probability: Option<f64>,
    pub(super) sensitivity: Option<f64>,
    /// As the sheet writes it; `None` where it does not.
    pub(super) unit_of_sensitivity: Option<String>,
    pub(super) contribution: Option<Cell>,
    pub(super) dof: Option<f64>,
    /// Whether the sheet says that its evaluation is of type A (JCGM 100, 4.2).
    pub(super) is_type_a: bool,
}

impl Row {
    /// The standard uncertainty, in its own unit; 0 of a constant.
    pub(super) fn standard_uncertainty(&self) -> f64 {
        let root = || self.distribution.and_then(divisor_of);
        match (self.width, self.std) {
            (Some(width), _) => width / self.divisor.or_else(root).unwrap_or(1.0),
            (None, std) => std.unwrap_or(0.0),
        }
    }
}

/// A number in a cell.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cell {
    pub(super) value: f64,
    /// Half a unit of its last digit.
    pub(super) half_digit: f64,
    /// Behind the number, or of the heading; empty where neither states one.
    pub(super) unit: String,
    /// As it is written.
    pub(super) text: String,
}

/// What a row is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RowKind {
    Quantity,
    Constant,
    Result,
    /// The combined standard uncertainty of the result.
    Combined,
    /// The expanded uncertainty of the result.
    Expanded,
    /// The coverage factor of the result.
    Factor,
    /// Not read.
    Ignored,
}

impl RowKind {
    const NAMES: [(&str, Self); 7] = [
        ("quantity", Self::Quantity),
        ("constant", Self::Constant),
        ("result", Self::Result),
        ("combined", Self::Combined),
        ("expanded", Self::Expanded),
        ("k", Self::Factor),
        ("ignore", Self::Ignored),
    ];

    fn named(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(known, _)| *known == name).map(|(_, kind)| *kind)
    }
}

/// A row that states something of the result.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfResult {
    pub(super) line: usize,
    pub(super) kind: RowKind,
}

/// What a sheet holds below its headings.
#[derive(Clone, Debug, Default)]
pub(super) struct Rows {
    pub(super) quantities: Vec<Row>,
    pub(super) of_result: Vec<OfResult>,
    /// The lines that options name, from 0, with what they are.
    said: Vec<(usize, RowKind)>,
}

impl Rows {
    /// What an option says that a line is.
    pub(super) fn said(&self, line: usize) -> Option<RowKind> {
        self.said.iter().find(|(said, _)| *said == line).map(|(_, kind)| *kind)
    }
}

impl ReadSheet<'_> {
    /// The rows that options name: lines from 0 with what they are. `None` after a mistake.
    pub(super) fn said_rows(&self) -> Option<Vec<(usize, RowKind)>> {
        let mut said = Vec::new();
        for (name, numbers) in self.options.rows.iter().filter(|(name, _)| name != "heading") {
            let Some(kind) = RowKind::named(name) else {
                let names: Vec<&str> = RowKind::NAMES.iter().map(|(name, _)| *name).collect();
                self.fail(
                    0,
                    format!(
                        "`--row {name}={numbers}`: a row is one of heading, {}",
                        names.join(", ")
                    ),
                );
                return None;
            };
            for number in numbers.split(',') {
                let line =
                    number.trim().parse::<usize>().ok().and_then(|number| number.checked_sub(1));
                let Some(line) = line.filter(|line| *line < self.cells.lines()) else {
                    self.fail(0, format!("`--row {name}={numbers}`: the sheet has no row `{number}`; rows are counted from 1"));
                    return None;
                };
                said.push((line, kind));
            }
        }
        Some(said)
    }

    /// All rows below the headings; `measurand` is the name on the left of the equation, `used` are the names
    /// on its right side, and `said` is what options say of lines.
    pub(super) fn rows(
        &self,
        header: &Header,
        measurand: Option<&str>,
        used: &[String],
        said: Vec<(usize, RowKind)>,
    ) -> Option<Rows> {
        let mut found = Rows { said, ..Rows::default() };
        let mut blank = 0;
        for line in header.line + 1..self.cells.lines() {
            let held = self.cells.row(line).iter().filter(|cell| !cell.trim().is_empty()).count();
            if held == 0 {
                blank += 1;
                continue;
            }
            let asked = || self.kind(header, line, measurand, used, blank);
            let Some(kind) = found.said(line).or_else(asked) else { continue };
            match kind {
                RowKind::Quantity | RowKind::Constant => {
                    blank = 0;
                    if let Some(row) = self.quantity(header, line, kind, used, &found.quantities) {
                        found.quantities.push(row);
                    } else if self.log.is_clean() {
                        self.fail(line, "the row cannot be read");
                    }
                }
                RowKind::Ignored => {
                    let text = beginning(self.first_cell(line));
                    self.note(fact!("import.row-not-read", row = line + 1, text));
                }
                kind => found.of_result.push(OfResult { line, kind }),
            }
        }
        if found.quantities.is_empty() && self.log.is_clean() {
            self.fail(header.first, "no row below this heading is a quantity");
        }
        self.log.is_clean().then_some(())?;
        self.may_be_combined(&found);
        self.log.is_clean().then_some(found)
    }

    fn first_cell(&self, line: usize) -> &str {
        let mut cells = self.cells.row(line).iter().map(|cell| cell.trim());
        cells.find(|cell| !cell.is_empty()).unwrap_or("")
    }

    /// The words of a row that may name it: symbol, quantity, description.
    fn names(&self, header: &Header, line: usize) -> Vec<&str> {
        let columns = [Column::Symbol, Column::Quantity, Column::Description];
        let cells = columns.into_iter().map(|column| header.cell(self.cells, line, column));
        cells.filter(|text| !text.is_empty()).collect()
    }

    /// What a row is that no option names; `None` of lines of words, and after a question. `blank` is the
    /// number of empty lines above it.
    fn kind(
        &self,
        header: &Header,
        line: usize,
        measurand: Option<&str>,
        used: &[String],
        blank: usize,
    ) -> Option<RowKind> {
        let names = self.names(header, line);
        let is_of_table = |(place, column): &&(usize, Column)| {
            (column.is_of_numbers()
                || matches!(
                    column,
                    Column::Sensitivity | Column::Divisor | Column::Factor | Column::Dof
                ))
                && !is_empty(self.cells.text(line, *place).trim())
        };
        let has_numbers = header.columns.iter().any(|column| is_of_table(&column));
        let speaks = self.cells.row(line).iter().any(|cell| columns::is_of_correlation(cell));
        if speaks && !has_numbers {
            // told by [`ReadSheet::correlations`]
            return None;
        }
        if !has_numbers {
            let is_equation = self.cells.row(line).iter().any(|cell| cell.contains('='));
            let first = self.first_cell(line);
            if !is_equation && self.names_quantities(header, first) {
                self.ask(
                    line..=line,
                    format!("`{first}` may be the equation of the result"),
                    ["the equation", "a remark"],
                    format!("`--equation \"y = {first}\"`, or `--row ignore={}`", line + 1),
                );
                return None;
            }
            if !is_equation {
                let text = beginning(self.first_cell(line));
                self.note(fact!("import.row-without-numbers", row = line + 1, text));
            }
            return None;
        }
        let is_used = names.first().is_some_and(|name| used.contains(&self.name_of(name)));
        let is_measurand =
            |name: &&str| measurand.is_some_and(|wanted| self.name_of(name) == wanted);
        if names.iter().any(is_measurand) {
            return Some(RowKind::Result);
        }
        if let Some(place) = (header.width()..self.cells.row(line).len())
            .find(|place| !self.cells.text(line, *place).trim().is_empty())
        {
            self.fail(line, format!("`{}` stands below no heading: numbers with decimal commas between commas are written in quotation marks", self.cells.text(line, place).trim()));
            return None;
        }
        // the words of totals may stand right before their numbers
        let row = self.cells.row(line).iter().map(|cell| cell.trim());
        let candidates =
            names.iter().copied().chain(names.is_empty().then_some(row).into_iter().flatten());
        if !is_used && let Some(kind) = candidates.into_iter().find_map(of_words) {
            let is_stated = |column| !is_empty(header.cell(self.cells, line, column));
            // `U` may be a voltage
            let is_letter = names.first().is_some_and(|name| name.chars().count() == 1);
            if is_letter && is_stated(Column::Estimate) && self.has_uncertainty(header, line) {
                let about = format!("`{}` has an estimate and an uncertainty", names[0]);
                self.ask_kind(
                    line..=line,
                    &about,
                    [("a quantity", "quantity"), ("the result", "result")],
                );
                return None;
            }
            if kind == RowKind::Result && is_stated(Column::Sensitivity) {
                self.ask_kind(
                    line..=line,
                    &format!("`{}` has the words of a result, and a coefficient", names[0]),
                    [("the result", "result"), ("a quantity", "quantity")],
                );
                return None;
            }
            return Some(kind);
        }
        if names.is_empty() {
            self.ask_kind(
                line..=line,
                "a row has numbers and no name",
                [
                    ("the combined standard uncertainty", "combined"),
                    ("not a part of the budget", "ignore"),
                ],
            );
            return None;
        }
        if is_used {
            let has_width = self.has_uncertainty(header, line);
            if !has_width {
                let text = beginning(names[0]);
                self.note(fact!("import.row-constant", row = line + 1, text));
            }
            return Some(if has_width { RowKind::Quantity } else { RowKind::Constant });
        }
        let shape = header.cell(self.cells, line, Column::Distribution);
        if words::meaning("text", shape) == Some("constant") {
            return Some(RowKind::Constant);
        }
        if blank > 1 {
            self.ask_kind(
                line..=line,
                &format!("`{}` stands below the table", names[0]),
                [("a quantity of the budget", "quantity"), ("not a part of the budget", "ignore")],
            );
            return None;
        }
        if !self.has_uncertainty(header, line) {
            self.ask_kind(
                line..=line,
                &format!("`{}` has no uncertainty", names[0]),
                [("the result", "result"), ("a constant", "constant")],
            );
            return None;
        }
        let lacks = |column: Column| {
            let is_stated = |line: usize| !is_empty(header.cell(self.cells, line, column));
            header.place(column).is_some()
                && !is_stated(line)
                && (header.line + 1..line).any(is_stated)
        };
        if measurand.is_none() && lacks(Column::Sensitivity) {
            self.ask_kind(line..=line, &format!("`{}` has no sensitivity coefficient, and other rows have one", names[0]), [
                ("the result", "result"),
                ("not a part of the budget, or a quantity whose coefficient is to be written into the row", "ignore"),
            ]);
            return None;
        }
        Some(RowKind::Quantity)
    }

    /// Whether a text can be read as a formula of two quantities of the sheet at least, `A-B`.
    fn names_quantities(&self, header: &Header, text: &str) -> bool {
        if self.options.equation.is_some() {
            return false;
        }
        let Ok(formula) = Formula::parse(&as_formula(text, self.cells.decimal_comma())) else {
            return false;
        };
        let known = self.names_of_rows(header);
        let names: Vec<&str> = formula.names().map(|(name, _)| name).collect();
        names.len() > 1 && names.iter().all(|name| known.iter().any(|other| other == name))
    }

    fn ask_kind(&self, lines: RangeInclusive<usize>, about: &str, readings: [(&str, &str); 2]) {
        let number = lines.end() + 1;
        let option = readings.map(|(_, kind)| format!("`--row {kind}={number}`")).join(" or ");
        self.ask(lines, about, readings.map(|(reading, _)| reading), option);
    }

    /// Whether a row states an uncertainty, 0 among them.
    pub(super) fn has_uncertainty(&self, header: &Header, line: usize) -> bool {
        let columns = [Column::Standard, Column::Relative, Column::Upper, Column::Deviation];
        let mut all = Column::WIDTHS.into_iter().chain(columns);
        let estimate = header.cell(self.cells, line, Column::Estimate);
        all.any(|column| !is_empty(header.cell(self.cells, line, column)))
            || sides(estimate).is_some()
            || concise(estimate, self.cells.decimal_comma()).is_some()
    }

    /// Asks whether the last row, whose uncertainty is the combined one of all others, is the result.
    fn may_be_combined(&self, found: &Rows) {
        let Some((last, others)) =
            found.quantities.split_last().filter(|(_, others)| others.len() > 1)
        else {
            return;
        };
        let is_said = found.said(last.line) == Some(RowKind::Quantity);
        let of = |row: &Row| row.sensitivity.unwrap_or(1.0) * row.standard_uncertainty();
        let combined = others.iter().map(|row| of(row) * of(row)).sum::<f64>().sqrt();
        let u = of(last).abs();
        // two digits of a combined uncertainty are rounded by up to 5 %
        let is_combined = |u: f64| (u - combined).abs() <= 0.05 * combined && combined > 0.0;
        let is_result = !found.of_result.is_empty()
            || is_said
            || others.iter().any(|row| row.unit != last.unit);
        if !is_result && (is_combined(u) || is_combined(u / 2.0)) {
            let number = last.line + 1;
            self.ask(
                others[0].line..=last.line,
                format!("`{}` has the combined uncertainty of the rows above", last.about),
                ["the result", "a further quantity"],
                format!("`--row result={number}` or `--row quantity={number}`"),
            );
        }
    }

    fn name_of(&self, words: &str) -> String {
        let words = words.split('=').next().unwrap_or(words);
        let plain = columns::with_unit_in_brackets(words);
        identifier(plain.as_ref().map_or(words, |(name, _)| *name))
    }

    /// The number in a cell; `None` where nothing stands, `Err` after a mistake.
    pub(super) fn number(
        &self,
        header: &Header,
        line: usize,
        place: usize,
    ) -> Result<Option<Cell>, ()> {
        self.number_of(header, line, place, self.cells.text(line, place))
    }

    /// The number in a text of a cell.
    fn number_of(
        &self,
        header: &Header,
        line: usize,
        place: usize,
        text: &str,
    ) -> Result<Option<Cell>, ()> {
        let text = text.trim();
        if is_empty(text) {
            return Ok(None);
        }
        if let Some(reason) = self.cells.no_number(line, place) {
            self.fail(line, reason);
            return Err(());
        }
        let digits = without_factor(text.trim_start_matches(PLUS_MINUS[0]).trim());
        let read = written(digits, self.cells.decimal_comma());
        let known = read.and_then(|(value, plain, unit)| {
            let unit = columns::without_in(unit);
            let is_unit = grouped_digits(unit).is_none() && Unit::parse(unit).is_ok();
            let meant = if is_unit || unit.is_empty() {
                Some(unit.to_owned())
            } else {
                columns::unit_as_meant(unit)
            };
            Some((value, plain, meant?))
        });
        let Some((value, plain, unit)) = known else {
            self.fail(
                line,
                format!(
                    "`{text}` in {} is no number with a unit that is known",
                    header.named(place)
                ),
            );
            return Err(());
        };
        if self.cells.is_written(line, place) {
            let own = digits.strip_suffix(&unit).unwrap_or(digits).trim();
            let own = without_groups(own).unwrap_or_else(|| own.to_owned());
            if let Err(reason) = self.marks.borrow_mut().with_point(&own) {
                self.fail(line, reason);
                return Err(());
            }
        }
        let unit = match (unit.as_str(), header.unit(place)) {
            ("", of_heading) => of_heading.unwrap_or("").to_owned(),
            (own, Some(of_heading)) if !is_same_unit(own, of_heading) => {
                self.ask(
                    line..=line,
                    format!("`{text}` is in `{own}`, and its heading says `{of_heading}`"),
                    [own, of_heading],
                    "`--column-unit NAME=UNIT`, or correct the cell",
                );
                return Err(());
            }
            (own, _) => own.to_owned(),
        };
        Ok(Some(Cell { value, half_digit: half_digit(&plain), unit, text: text.to_owned() }))
    }

    /// A quantity; `None` after a mistake or a question.
    fn quantity(
        &self,
        header: &Header,
        line: usize,
        kind: RowKind,
        used: &[String],
        others: &[Row],
    ) -> Option<Row> {
        let cell = |column| header.cell(self.cells, line, column);
        let names = self.names(header, line);
        let words = names.first().copied().unwrap_or("");
        if super::number::number(words, self.cells.decimal_comma()).is_some() {
            self.ask(
                line..=line,
                format!("the number `{words}` stands in the place of the name of a quantity"),
                ["a name", "a number, whose column is another one"],
                "`--column symbol=COLUMN` or `--column quantity=COLUMN` for the names, and `--column \
                 estimate=COLUMN` or `--column ignore=COLUMN` for the numbers",
            );
            return None;
        }
        let bracketed = columns::with_unit_in_brackets(words);
        let mut name = self.name_of(words);
        if check_name(&name).is_err() {
            name = format!("x_{}", others.len() + 1);
        }
        let wanted = name.clone();
        if used.contains(&wanted)
            && let Some(first) = others.iter().find(|row| row.name == wanted)
        {
            self.ask(
                first.line..=line,
                format!("two rows are called `{wanted}`, which the equation uses"),
                [&format!("row {}", first.line + 1) as &str, &format!("row {}", line + 1)],
                format!("`--row ignore={}`, or another name", line + 1),
            );
            return None;
        }
        let mut number = 2;
        while others.iter().any(|row| row.name == name) {
            name = format!("{wanted}_{number}");
            number += 1;
        }
        if name != words {
            let (words, name) = (beginning(words), beginning(&name));
            self.note(fact!("import.row-named", row = line + 1, words, name));
        }
        let mut row = Row { line, name, about: self.about(header, line), ..Row::default() };
        // estimate, perhaps with its uncertainty behind it
        let place = header.place(Column::Estimate);
        let text = cell(Column::Estimate);
        let (text, behind) = sides(text).map_or((text, None), |(x, u)| (x, Some(u)));
        let comma = self.cells.decimal_comma();
        let in_digits =
            concise(text, comma).filter(|(.., unit)| unit.is_empty() || Unit::parse(unit).is_ok());
        let estimate = match (in_digits, place) {
            (Some((value, _, unit)), Some(place)) => {
                let unit = if unit.is_empty() { header.unit(place).unwrap_or("") } else { unit };
                Some(Cell { value, half_digit: 0.0, unit: unit.to_owned(), text: text.to_owned() })
            }
            (None, Some(place)) => self.number_of(header, line, place, text).ok()?,
            (_, None) => None,
        };
        row.estimate = estimate.as_ref().map(|cell| cell.value);
        // uncertainties as they stand
        let mut widths: Vec<(Column, Cell, String)> = Vec::new();
        for column in Column::WIDTHS {
            let Some(place) = header.place(column) else { continue };
            if let Some(found) = self.number(header, line, place).ok()? {
                widths.push((column, found, cell(column).to_owned()));
            }
        }
        if let (Some(behind), Some(place)) = (behind, place) {
            let found = self.number_of(header, line, place, behind).ok()??;
            widths.push((Column::Uncertainty, found, behind.to_owned()));
        }
        if widths.len() > 1 {
            let named: Vec<String> = widths.iter().map(|(.., text)| format!("`{text}`")).collect();
            self.ask(
                line..=line,
                format!(
                    "the row states its uncertainty {} times: {}",
                    widths.len(),
                    listed(&named, " and ")
                ),
                [],
                "`--column ignore=COLUMN` for the ones that do not count",
            );
            return None;
        }
        let std = self.optional(header, line, Column::Standard)?;
        let behind = in_digits.map(|(_, value, unit)| Cell {
            value,
            half_digit: 0.0,
            unit: unit.to_owned(),
            text: text.to_owned(),
        });
        let (mut std, second) = match std {
            Some(std) => (Some(std), behind),
            None => (behind, None),
        };
        let deviation = self.optional(header, line, Column::Deviation)?;
        if deviation.is_some() && std.is_none() && widths.is_empty() {
            let letter = header.letter(Column::Deviation);
            self.ask(
                line..=line,
                "the row has a standard deviation and no uncertainty",
                ["that of a mean, a standard uncertainty", "that of single readings"],
                format!("`--column u={letter}`, or write the standard uncertainty into the row"),
            );
            return None;
        }
        let relative = self.optional(header, line, Column::Relative)?;
        let all = widths.iter().map(|(_, cell, _)| cell).chain(&std);
        let units: Vec<&str> = all.clone().map(|cell| cell.unit.as_str()).collect();
        row.unit =
            self.unit(header, line, estimate.as_ref(), bracketed.map(|(_, unit)| unit), &units)?;
        for cell in all.chain(&relative) {
            if cell.value < 0.0 {
                self.fail(line, format!("the uncertainty `{}` is below zero", cell.text));
                return None;
            }
        }
        // what the distribution and the factors say
        let shape = StatedShape::of(self, header, line)?;
        row.dof = self.dof(header, line, &shape).ok()?;
        if shape.is_student && row.dof.is_none() {
            self.fail(
                line,
                "a t distribution needs its degrees of freedom: write them into a column `dof`",
            );
            return None;
        }
        self.type_of(header, &mut row)?;
        self.limits(header, &mut row)?;
        let mut of_shape = None;
        if let Some((column, cell, text)) = widths.first().filter(|_| kind == RowKind::Quantity) {
            let value =
                self.in_unit_of_row(cell, &row, &self.unit_of_uncertainty(cell, header, line)?)?;
            if value > 0.0 {
                self.width(header, &mut row, *column, value, text, &shape)?;
            }
            of_shape = Some(row.standard_uncertainty());
        } else if let Some(width) = row.width {
            self.width(header, &mut row, Column::HalfWidth, width, "between the limits", &shape)?;
            of_shape = Some(row.standard_uncertainty());
        }
        if let Some(cell) = &mut std {
            if columns::coverage(&cell.text).factor(None).is_some_and(|k| k != 1.0) {
                self.ask(
                    line..=line,
                    format!(
                        "`{}` below a heading of standard uncertainties states a coverage factor",
                        cell.text
                    ),
                    ["a standard uncertainty", "an expanded one"],
                    "`--column U=COLUMN`, or correct the cell",
                );
                return None;
            }
            let unit = self.unit_of_uncertainty(cell, header, line)?;
            cell.value = self.in_unit_of_row(cell, &row, &unit)?;
        }
        let share = match (&relative, row.estimate) {
            (Some(cell), Some(x)) if x != 0.0 => {
                let size = Unit::parse(&cell.unit).map_or(1.0, |unit| unit.factor());
                Some(to_15_digits(cell.value * size * x.abs()))
            }
            (Some(cell), _) => {
                self.fail(
                    line,
                    format!(
                        "`{}` is a share of an estimate that the row does not state, or that is 0",
                        cell.text
                    ),
                );
                return None;
            }
            (None, _) => None,
        };
        let second = match &second {
            Some(cell) => Some((self.in_unit_of_row(cell, &row, &cell.unit)?, 0.0)),
            None => None,
        };
        let std_cell = std.as_ref().map(|cell| (cell.value, cell.half_digit));
        let stated = [std_cell, share.map(|u| (u, 0.0)), second];
        self.same_uncertainty(line, of_shape, stated)?;
        if kind == RowKind::Constant {
            row.width = None;
        } else if row.width.is_none() {
            row.distribution = shape_of_std(self, header, line);
            row.std = std.map(|cell| cell.value).or(share);
        }
        self.sensitivity(header, &mut row)?;
        row.contribution = self.optional(header, line, Column::Contribution)?;
        Some(row)
    }

    /// The number in a column that a sheet may lack; `None` after a mistake.
    fn optional(&self, header: &Header, line: usize, column: Column) -> Option<Option<Cell>> {
        match header.place(column) {
            Some(place) => self.number(header, line, place).ok(),
            None => Some(None),
        }
    }

    /// What the sheet says of a quantity in words.
    fn about(&self, header: &Header, line: usize) -> String {
        let is_word = |(_, column): &&(usize, Column)| {
            matches!(
                column,
                Column::Quantity | Column::Symbol | Column::Description | Column::Remark
            )
        };
        let order = [Column::Symbol, Column::Quantity, Column::Description, Column::Remark];
        let mut texts: Vec<&str> = Vec::new();
        for wanted in order {
            let of_kind =
                header.columns.iter().filter(is_word).filter(|(_, column)| *column == wanted);
            for (place, _) in of_kind {
                let text = self.cells.text(line, *place).trim();
                if !is_empty(text) && !texts.contains(&text) {
                    texts.push(text);
                }
            }
        }
        texts.join("; ")
    }

    /// The unit of a row: all that states one has to say the same.
    fn unit(
        &self,
        header: &Header,
        line: usize,
        estimate: Option<&Cell>,
        of_name: Option<String>,
        of_uncertainties: &[&str],
    ) -> Option<String> {
        let own = header.cell(self.cells, line, Column::Unit);
        let own =
            if is_empty(own) || own == "1" { "" } else { own.trim_matches(['[', ']', '(', ')']) };
        let own = match Unit::parse(own) {
            Ok(_) if own.parse::<f64>().is_err() => own.to_owned(),
            _ => match columns::unit_as_meant(own) {
                Some(meant) => meant,
                None => {
                    self.fail(
                        line,
                        format!("`{own}` in the column of the unit is no unit that is known"),
                    );
                    return None;
                }
            },
        };
        let is_plain = header.cell(self.cells, line, Column::Unit) == "1";
        let mut stated: Vec<String> = vec![own];
        stated.extend(estimate.map(|cell| cell.unit.clone()));
        stated.extend(of_name);
        stated.retain(|unit| !unit.is_empty());
        if let [first, others @ ..] = stated.as_slice() {
            if let Some(other) = others.iter().find(|other| !is_same_unit(first, other)) {
                self.ask(
                    line..=line,
                    "the row states two units",
                    [first, other],
                    "`--column ignore=COLUMN`, `--column-unit estimate=UNIT`, or correct the row",
                );
                return None;
            }
            let of_all = self.unit_of_all(header).filter(|of_all| {
                let both = Unit::parse(of_all).ok().zip(Unit::parse(first).ok());
                !is_same_unit(of_all, first) && both.is_some_and(|(a, b)| a.is_compatible(&b))
            });
            if let Some(of_all) = of_all {
                self.ask(
                    line..=line,
                    "a line beside the table states the unit of all values, and the row another one",
                    [first, &of_all],
                    "`--row ignore=ROW` for that line, or correct it",
                );
                return None;
            }
            return Some(first.clone());
        }
        if is_plain {
            return Some(String::new());
        }
        if let Some(unit) = self.unit_of_all(header) {
            return Some(unit);
        }
        let is_known = |unit: &&&str| !unit.is_empty();
        let Some(first) = of_uncertainties.iter().find(is_known) else {
            return Some(String::new());
        };
        if estimate.is_some_and(|cell| cell.value != 0.0) {
            self.ask(
                line..=line,
                format!(
                    "the estimate `{}` has no unit, and its uncertainty is in `{first}`",
                    estimate.map_or("", |cell| &cell.text)
                ),
                [&format!("in `{first}` as well") as &str, "in another unit"],
                "`--column-unit estimate=UNIT`, or `--column unit=COLUMN`",
            );
            return None;
        }
        Some((*first).to_owned())
    }

    /// The unit of an uncertainty: its own, or that of the column of their units.
    fn unit_of_uncertainty(&self, cell: &Cell, header: &Header, line: usize) -> Option<String> {
        let of_column = header.cell(self.cells, line, Column::UnitOfUncertainty);
        if is_empty(of_column) {
            return Some(cell.unit.clone());
        }
        if Unit::parse(of_column).is_err() {
            self.fail(line, format!("`{of_column}`, the unit of the uncertainty, is not known"));
            return None;
        }
        if !cell.unit.is_empty() && !is_same_unit(&cell.unit, of_column) {
            self.fail(line, format!("`{}` stands beside its unit `{of_column}`", cell.text));
            return None;
        }
        Some(of_column.to_owned())
    }

    /// The number of an uncertainty in the unit of its row; per cent and ppm are of the estimate.
    fn in_unit_of_row(&self, cell: &Cell, row: &Row, unit: &str) -> Option<f64> {
        let line = row.line;
        if unit.is_empty() {
            return Some(cell.value);
        }
        let (own, value) = (Unit::parse(unit).ok()?, cell.value);
        let of_row = Unit::parse(&row.unit).ok()?;
        let known = (!row.unit.is_empty()).then_some(&of_row);
        let is_ratio = own.dimension().is_none() && own.turn().is_none() && own.factor() != 1.0;
        if known.is_none()
            && is_ratio
            && !own.is_relative()
            && row.estimate.is_some_and(|x| x != 0.0)
        {
            self.fail(line, share::two_meanings(unit, "1"));
            return None;
        }
        match Share::of(&own, known) {
            Share::Own => match Unit::conversion_factor(&own, &of_row) {
                Ok(scale) => Some(to_15_digits(value * scale)),
                Err(_) => {
                    self.fail(
                        line,
                        format!(
                            "the uncertainty `{}` is in `{unit}`, and the quantity in `{}`",
                            cell.text,
                            if row.unit.is_empty() { "1" } else { &row.unit }
                        ),
                    );
                    None
                }
            },
            Share::OfValue if row.unit.is_empty() => {
                self.ask(
                    line..=line,
                    format!("`{}` of a quantity without a unit", cell.text),
                    ["a share of the estimate", "a plain number"],
                    "`--column-unit estimate=UNIT`, or write the number",
                );
                None
            }
            Share::OfValue => {
                let counts = of_row.zero().is_none() && of_row.level_exponent().is_zero();
                match row.estimate.filter(|x| *x != 0.0 && counts) {
                    Some(x) => Some(to_15_digits(value * own.factor() * x.abs())),
                    None => {
                        self.fail(line, format!("`{}` is a share, and of the estimate of this row nothing can be taken: write it in `{}`", cell.text, row.unit));
                        None
                    }
                }
            }
            Share::Doubtful => {
                self.fail(
                    line,
                    share::two_meanings(unit, if row.unit.is_empty() { "1" } else { &row.unit }),
                );
                None
            }
        }
    }

    /// Takes the middle and the half-width of limits; the estimate, if it is stated, is their middle.
    fn limits(&self, header: &Header, row: &mut Row) -> Option<()> {
        let line = row.line;
        let (lower, upper) = (
            self.optional(header, line, Column::Lower)?,
            self.optional(header, line, Column::Upper)?,
        );
        let (Some(lower), Some(upper)) = (lower, upper) else { return Some(()) };
        let scaled = |cell: &Cell| {
            let of = |unit: &str| Unit::parse(unit).ok();
            if cell.unit.is_empty() || is_same_unit(&cell.unit, &row.unit) {
                return Some(cell.value);
            }
            let (own, of_row) = (of(&cell.unit)?, of(&row.unit)?);
            let scale =
                Unit::conversion_factor(&own, &of_row).ok().filter(|_| own.has_zero_of(&of_row))?;
            Some(to_15_digits(cell.value * scale))
        };
        let (Some(low), Some(high)) = (scaled(&lower), scaled(&upper)) else {
            self.fail(line, "the limits and the quantity are in different units");
            return None;
        };
        let middle = to_15_digits((low + high) / 2.0);
        let half = to_15_digits((high - low) / 2.0);
        if half <= 0.0 {
            self.fail(
                line,
                format!(
                    "the lower limit `{}` is not below the upper one, `{}`",
                    lower.text, upper.text
                ),
            );
            return None;
        }
        let estimate = row.estimate.unwrap_or(middle);
        if (estimate - middle).abs() > 1e-9 * (estimate.abs() + half) {
            self.ask(
                line..=line,
                format!("the estimate {} is not in the middle of the limits `{}` and `{}`", Shortest(estimate), lower.text, upper.text),
                ["values, between which the quantity lies", "deviations from the estimate"],
                "`--column half-width=COLUMN` with `--column ignore=COLUMN` for the other limit, or write the \
                 values between which it lies",
            );
            return None;
        }
        row.estimate = Some(estimate);
        row.width = Some(half);
        Some(())
    }

    /// Whether the evaluation is of type A; a column of types holds `A` and `B` alone.
    fn type_of(&self, header: &Header, row: &mut Row) -> Option<()> {
        let text = header.cell(self.cells, row.line, Column::Type);
        let letter = ["type ", "typ "].iter().find_map(|word| {
            text.get(..word.len()).filter(|begin| begin.to_lowercase() == **word)?;
            text.get(word.len()..)
        });
        match letter.unwrap_or(text).trim() {
            "A" | "a" => row.is_type_a = true,
            "B" | "b" => {}
            _ if is_empty(text) => {}
            _ => {
                let letter = header.letter(Column::Type);
                self.ask(
                    row.line..=row.line,
                    format!("`{text}` is no type of evaluation, A or B"),
                    ["a distribution", "a remark"],
                    format!("`--column distribution={letter}` or `--column remark={letter}`"),
                );
                return None;
            }
        }
        Some(())
    }

    /// Asks where a row states its standard uncertainty twice, and the two differ by more than their digits and
    /// one hundredth.
    fn same_uncertainty(
        &self,
        line: usize,
        of_shape: Option<f64>,
        stated: [Option<(f64, f64)>; 3],
    ) -> Option<()> {
        let all = of_shape.map(|u| (u, 0.0)).into_iter().chain(stated.into_iter().flatten());
        let all: Vec<(f64, f64)> = all.collect();
        for pair in all.windows(2) {
            let [(a, half_a), (b, half_b)] = *pair else { continue };
            if (a - b).abs() > 0.01 * a.max(b) + 1.2 * (half_a + half_b) {
                self.ask(
                    line..=line,
                    "the row states two standard uncertainties",
                    [
                        &format!(
                            "{}, of its half-width or expanded uncertainty",
                            Shortest(to_15_digits(a))
                        ) as &str,
                        &format!("{}, as it stands", Shortest(to_15_digits(b))),
                    ],
                    "`--column ignore=COLUMN` for the one that does not count, or correct the row",
                );
                return None;
            }
        }
        Some(())
    }

    /// The sensitivity coefficient, with its unit where one is stated.
    fn sensitivity(&self, header: &Header, row: &mut Row) -> Option<()> {
        let Some(place) = header.place(Column::Sensitivity) else { return Some(()) };
        let text = header.cell(self.cells, row.line, Column::Sensitivity);
        if is_empty(text) {
            return Some(());
        }
        let comma = self.cells.decimal_comma();
        let (value, unit) =
            match super::number::constant(text, comma).filter(|_| !text.contains('%')) {
                Some(value) if self.cells.no_number(row.line, place).is_none() => {
                    (value, header.unit(place).unwrap_or("").to_owned())
                }
                _ => {
                    let cell = self.number(header, row.line, place).ok()??;
                    (cell.value, cell.unit)
                }
            };
        let of_column = header.cell(self.cells, row.line, Column::UnitOfSensitivity);
        let unit = if unit.is_empty() { of_column } else { &unit };
        let known = Unit::parse(unit)
            .map(|_| unit.to_owned())
            .ok()
            .or_else(|| columns::unit_as_meant(unit));
        let Some(known) = known.filter(|unit| unit == "1" || unit.parse::<f64>().is_err()) else {
            self.fail(
                row.line,
                format!("`{unit}` is no unit of a sensitivity coefficient that is known"),
            );
            return None;
        };
        row.sensitivity = Some(value);
        row.unit_of_sensitivity = Some(known).filter(|unit| !unit.is_empty());
        Some(())
    }
}

/// The distribution of a row that states its standard uncertainty alone.
fn shape_of_std(sheet: &ReadSheet, header: &Header, line: usize) -> Option<&'static str> {
    let text = header.cell(sheet.cells, line, Column::Distribution);
    let shape = NamedShape::of(text)?;
    if shape == NamedShape::Unknown {
        let text = beginning(text);
        sheet.note(fact!("import.distribution", row = line + 1, text));
    }
    shape.name().filter(|name| divisor_of(name).is_some())
}

/// Whether two texts are the same unit.
pub(super) fn is_same_unit(a: &str, b: &str) -> bool {
    let same = |(a, b): (Unit, Unit)| {
        Unit::conversion_factor(&a, &b).is_ok_and(|scale| (scale - 1.0).abs() < 1e-12)
            && a.has_zero_of(&b)
    };
    a == b || Unit::parse(a).ok().zip(Unit::parse(b).ok()).is_some_and(same)
}

/// What a row is by its words.
fn of_words(words: &str) -> Option<RowKind> {
    let clean = columns::plain_case(words);
    let named = |text: &str| {
        Some(match words::meaning("row", text)? {
            "result" => RowKind::Result,
            "combined" => RowKind::Combined,
            "expanded" => RowKind::Expanded,
            "k" => RowKind::Factor,
            _ => RowKind::Ignored,
        })
    };
    // `u(Rx)`, `u_c(y)` and `U (k=2)`
    let symbol = || words.split('(').next().and_then(|text| named(text.trim()));
    let is_symbol = || words.starts_with(['u', 'U', 'v', 'ν']) && words.contains('(');
    named(words.trim())
        .or_else(|| named(&clean))
        .or_else(|| symbol().filter(|_| is_symbol()))
        // `k = 2`
        .or_else(|| {
            words
                .split_once('=')
                .and_then(|(left, _)| named(left.trim()).filter(|kind| *kind == RowKind::Factor))
        })
}
