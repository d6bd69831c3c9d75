//! Budgets that laboratories keep in spreadsheets, as model files.
//!
//! A budget is a table somewhere on a sheet: a header, one row for each quantity, perhaps a row of
//! the result, perhaps the equation. What is found is said, and so is what had to be guessed.

mod columns;
mod grid;
mod linear;
mod own;
mod pint;
mod suncal;
mod yaml;

use crate::open::{FileKind, are_results};
use std::cell::RefCell;
use std::path::Path;

use super::diagnostics::{Collector, Diagnostics};
use super::reader::read_text;
use super::separator::DecimalMarks;
use super::source::SourceText;
use super::value_text::grouped_digits;
use super::{DiagnosticKind, bytes};
use columns::{Column, Header, HeaderCoverage};
use gumption_engine::model::formula::{Formula, Scope, Typing, check_name};
use gumption_engine::number::Shortest;
use gumption_units::Unit;
use linear::standard_uncertainty;
use serde_json::{Map, Value, json};

/// A model file that was made of a budget.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportedBudget {
    /// The model file, as JSON text that ends in a newline.
    pub text: String,
    /// What was found, in sentences.
    pub understood: Vec<String>,
    /// What had to be guessed, in sentences.
    pub guessed: Vec<String>,
}

/// Reads a budget from a CSV file or from the first sheet of an XLSX file; of a workbook that this
/// program has made, its model file with the cells that were changed; of a YAML file the first
/// calculation of an uncertainty of a suncal project.
///
/// # Errors
/// A file that cannot be read, or in which no budget is found; rows with mistakes, all at once.
pub fn import_budget(path: &Path) -> Result<ImportedBudget, Diagnostics> {
    match bytes::of_file(path, bytes::MOST) {
        Ok(content) => import_budget_bytes(path, content),
        Err(message) => {
            let log = Collector::new(SourceText::new(path.display().to_string(), ""));
            log.report(&(0..0), DiagnosticKind::Unreadable { message });
            Err(log.into_diagnostics())
        }
    }
}

/// As [`import_budget`], of the content of a file of that name, which is not looked for on the disk.
///
/// # Errors
/// As [`import_budget`].
pub fn import_budget_bytes(path: &Path, content: Vec<u8>) -> Result<ImportedBudget, Diagnostics> {
    let name = path.display().to_string();
    let source = |text: &str| SourceText::new(name.clone(), text);
    let failed = |kind: DiagnosticKind| {
        let log = Collector::new(source(""));
        log.report(&(0..0), kind);
        Err(log.into_diagnostics())
    };
    let is_workbook =
        path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("xlsx"));
    if is_workbook {
        match own::of_workbook(path, &content) {
            Ok(None) => {}
            Ok(Some(made)) => return made,
            Err(message) => return failed(DiagnosticKind::Unreadable { message }),
        }
    }
    let is_project = path.extension().is_some_and(|extension| {
        extension.eq_ignore_ascii_case("yaml") || extension.eq_ignore_ascii_case("yml")
    });
    if is_project {
        return match bytes::text(&content) {
            Ok(text) => suncal::of_project(path, &text),
            Err(message) => failed(DiagnosticKind::Unreadable { message }),
        };
    }
    let (cells, text) = match grid::of_content(content, is_workbook) {
        Ok(read) => read,
        Err(kind) => return failed(kind),
    };
    let title = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let log = Collector::new(source(&text));
    let marks = RefCell::new(cells.marks());
    let mut budget =
        Budget { cells: &cells, marks, log: &log, understood: vec![], guessed: vec![] };
    let made = budget.model(&title.unwrap_or_default());
    let (understood, guessed) = (budget.understood, budget.guessed);
    log.finish(made.map(|text| ImportedBudget { text, understood, guessed }))
}

/// A row of the budget.
#[derive(Clone, Debug, Default)]
struct Row {
    line: usize,
    /// The name in formulas.
    name: String,
    /// The words of the sheet.
    about: String,
    estimate: Option<f64>,
    unit: String,
    width: Option<f64>,
    std: Option<f64>,
    distribution: Option<&'static str>,
    divisor: Option<f64>,
    sensitivity: Option<f64>,
    /// As the sheet writes it; empty where it does not.
    unit_of_sensitivity: String,
    dof: Option<f64>,
}

struct Budget<'a> {
    cells: &'a grid::Cells,
    marks: RefCell<DecimalMarks>,
    log: &'a Collector,
    understood: Vec<String>,
    guessed: Vec<String>,
}

impl Budget<'_> {
    fn fail(&self, line: usize, reason: String) {
        let span = self.cells.line(line);
        self.log.report(&span, DiagnosticKind::Table { reason });
    }

    /// The model file of the budget.
    fn model(&mut self, title: &str) -> Option<String> {
        let Some(header) = Header::find(self.cells) else {
            if are_results(self.cells.row(0).iter().map(|cell| cell.trim())) {
                self.log.report(&self.cells.line(0), FileKind::Results.described());
                return None;
            }
            self.fail(
                0,
                "no budget is found: a header row names the columns, such as quantity, estimate, \
                 unit, +-, distribution, divisor, sensitivity, degrees of freedom (or Größe, \
                 Schätzwert, Einheit, Unsicherheit, Verteilung, Teiler, Sensitivitätskoeffizient, \
                 Freiheitsgrade)"
                    .to_owned(),
            );
            return None;
        };
        let shown: Vec<String> = header
            .columns
            .iter()
            .map(|(place, column)| {
                format!("`{}` as {}", self.cells.text(header.line, *place), column.name())
            })
            .collect();
        self.understood.push(format!("line {}: columns {}", header.line + 1, shown.join(", ")));
        for place in &header.unknown {
            let text = self.cells.text(header.line, *place);
            self.guessed.push(format!("the column `{text}` is not taken"));
        }
        let equation = self.equation();
        let measured = equation.as_ref().map(|(name, _)| name.as_str());
        let (rows, result) = self.rows(&header, measured);
        if rows.is_empty() && self.log.is_clean() {
            self.fail(header.line, "no row below this header is a quantity".to_owned());
        }
        if !self.log.is_clean() {
            return None;
        }
        let measurand = match (&equation, &result) {
            (Some((name, _)), _) => name.clone(),
            (None, Some(result)) if !result.name.is_empty() => result.name.clone(),
            _ => "y".to_owned(),
        };
        let taken = rows.iter().any(|row| row.name == measurand);
        let measurand = if taken { format!("{measurand}_result") } else { measurand };
        let unit = result.as_ref().map(|result| result.unit.clone()).unwrap_or_default();
        match &equation {
            Some((_, formula)) => {
                self.understood.push(format!("the equation {measurand} = {formula}"));
                self.unused(&rows, &measurand, formula);
                let unit = if unit.is_empty() {
                    self.unit_of_equation(&rows, &measurand, formula)
                } else {
                    unit
                };
                let model = |checked| document(title, &rows, &measurand, &unit, formula, checked);
                self.checked(model)
            }
            None => {
                let linear = self.linear(&header, &rows, result.as_ref(), &measurand)?;
                Some(document(title, &rows, &measurand, &linear.unit, &linear.formula, false))
            }
        }
    }

    /// The usual unit of what an equation gives; empty for a plain number or after a mistake.
    fn unit_of_equation(&mut self, rows: &[Row], measurand: &str, formula: &str) -> String {
        let mut scope = Scope::new();
        for row in rows {
            let unit = Unit::parse(&row.unit).unwrap_or_default();
            scope.define(row.name.as_str(), Typing::in_unit(&unit));
        }
        let typing = Formula::parse(formula).ok().and_then(|formula| formula.check(&scope).ok());
        let dimension = typing.and_then(|typing| typing.dimension).filter(|of| !of.is_none());
        let Some(unit) = dimension.map(|dimension| dimension.usual_unit()) else {
            return String::new();
        };
        self.guessed.push(format!("the unit of {measurand} is not given: `{unit}` is taken"));
        unit
    }

    /// Says which rows the equation does not name.
    fn unused(&mut self, rows: &[Row], measurand: &str, formula: &str) {
        let Ok(formula) = Formula::parse(formula) else { return };
        let used: Vec<&str> = formula.names().map(|(name, _)| name).collect();
        for row in rows.iter().filter(|row| !used.contains(&row.name.as_str())) {
            self.guessed.push(format!(
                "line {}: `{}` is not in the equation of {measurand}: it contributes nothing",
                row.line + 1,
                row.name
            ));
        }
    }

    /// The model with a check of units where it passes, else without.
    fn checked(&mut self, model: impl Fn(bool) -> String) -> Option<String> {
        let with = model(true);
        let Err(first) = read_text("the model", &with, Path::new(""), &[]) else {
            return Some(with);
        };
        let without = model(false);
        match read_text("the model", &without, Path::new(""), &[]) {
            Ok(_) => {
                let reason = first.0.first().map(|fault| fault.kind.to_string());
                self.guessed.push(format!(
                    "units are not checked, because the equation does not pass: {}",
                    reason.unwrap_or_default()
                ));
                Some(without)
            }
            Err(faults) => {
                let reasons: Vec<String> =
                    faults.0.iter().take(5).map(|fault| fault.kind.to_string()).collect();
                self.fail(
                    0,
                    format!("the model of this budget has mistakes: {}", reasons.join("; ")),
                );
                None
            }
        }
    }

    /// A line of the sheet such as `R = U/I`, or a cell behind `equation`.
    fn equation(&self) -> Option<(String, String)> {
        const LABELS: [&str; 8] = [
            "equation",
            "formula",
            "model",
            "model equation",
            "gleichung",
            "formel",
            "modell",
            "modellgleichung",
        ];
        for line in 0..self.cells.lines() {
            let row = self.cells.row(line);
            for (place, cell) in row.iter().enumerate() {
                let label = columns::plain(cell);
                let written = if LABELS.contains(&label.as_str()) {
                    row.iter().skip(place + 1).find(|cell| !cell.trim().is_empty())
                } else {
                    Some(cell).filter(|cell| cell.contains('='))
                };
                let Some(written) = written else { continue };
                let written = LABELS
                    .iter()
                    .find_map(|label| {
                        let lower = written.to_lowercase();
                        lower.strip_prefix(label)?.trim_start().strip_prefix(':')?;
                        written.get(written.find(':')? + 1..)
                    })
                    .unwrap_or(written);
                let Some((name, formula)) = written.split_once('=') else { continue };
                let (name, formula) = (columns::identifier(name), formula.trim().replace(';', ","));
                let uses = Formula::parse(&formula).ok();
                let uses = uses.is_some_and(|formula| formula.names().next().is_some());
                if check_name(&name).is_ok() && uses {
                    return Some((name, formula));
                }
            }
        }
        None
    }

    /// The rows of the quantities, and that of the result.
    fn rows(&mut self, header: &Header, measurand: Option<&str>) -> (Vec<Row>, Option<Row>) {
        let (mut rows, mut result): (Vec<Row>, Option<Row>) = (Vec::new(), None);
        let mut empty = 0;
        for line in header.line + 1..self.cells.lines() {
            let label = header.cell(self.cells, line, Column::Quantity).trim().to_owned();
            let is_blank = self.cells.row(line).iter().all(|cell| cell.trim().is_empty());
            if is_blank {
                // a budget may have one empty line, not two
                empty += 1;
                if empty > 1 && !rows.is_empty() {
                    break;
                }
                continue;
            }
            empty = 0;
            let mut row = Row { line, about: label.clone(), ..Row::default() };
            let symbol = header.cell(self.cells, line, Column::Symbol).trim().to_owned();
            let is_measurand = [&label, &symbol]
                .into_iter()
                .any(|words| measurand.is_some_and(|name| columns::identifier(words) == name));
            let is_result = columns::is_result(&label) || is_measurand;
            row.unit = self.unit(header, line, is_result);
            row.estimate = self.in_unit(header, line, (Column::Estimate, is_result), &mut row);
            row.width = self.in_unit(header, line, (Column::Width, is_result), &mut row);
            row.std = self.in_unit(header, line, (Column::Std, is_result), &mut row);
            let number = |column: Column| self.number(header, line, column, is_result);
            if let Some((c, unit)) = self.with_unit(header, line, Column::Sensitivity, is_result) {
                row.sensitivity = Some(c);
                unit.clone_into(&mut row.unit_of_sensitivity);
            }
            let stated = header.cell(self.cells, line, Column::UnitOfSensitivity).trim();
            if row.unit_of_sensitivity.is_empty() && !matches!(stated, "-" | "–") {
                stated.clone_into(&mut row.unit_of_sensitivity);
            }
            row.divisor = self.divisor(header, line, is_result);
            row.dof = number(Column::Dof).filter(|dof| dof.is_finite() && *dof < 1e6);
            let of_shape = header.cell(self.cells, line, Column::Distribution).trim();
            let is_alone = row.width.is_none() && row.std.is_none() && row.sensitivity.is_none();
            if columns::is_factor(&label) && is_alone && row.unit.is_empty() && of_shape.is_empty()
            {
                let text = format!("line {}: `{label}` is a coverage factor, not taken", line + 1);
                self.understood.push(text);
                continue;
            }
            let nothing = row.estimate.is_none() && row.width.is_none() && row.std.is_none();
            if label.is_empty() && nothing {
                continue;
            }
            if is_result || label.contains('=') {
                if columns::is_of_uncertainty(&label) {
                    row.estimate = None;
                }
                let known = result.get_or_insert_with(|| row.clone());
                known.estimate = known.estimate.or(row.estimate);
                if known.unit.is_empty() {
                    known.unit.clone_from(&row.unit);
                }
                continue;
            }
            if nothing {
                self.guessed.push(format!("line {}: `{label}` has no numbers; left out", line + 1));
                continue;
            }
            let words = if symbol.is_empty() { &label } else { &symbol };
            row.name = self.name(words, &rows, line);
            row.distribution = self.distribution(header, line);
            self.coverage(header, &mut row);
            self.contradictions(&row);
            // the measurand stands below the quantities without an uncertainty of its own
            rows.push(row);
        }
        // an equation names its result itself
        if result.is_none()
            && let Some(reason) = last_is_result(&rows)
            && (measurand.is_none() || reason == NO_UNCERTAINTY)
            && let Some(last) = rows.pop()
        {
            self.guessed.push(format!(
                "line {}: `{}` {reason} and is taken for the result",
                last.line + 1,
                last.name
            ));
            result = Some(last);
        }
        if let Some(result) = &mut result
            && columns::is_result(&result.about)
        {
            result.name = String::new();
        }
        (rows, result)
    }

    /// A name for formulas.
    fn name(&mut self, words: &str, rows: &[Row], line: usize) -> String {
        let mut name = columns::identifier(words);
        if check_name(&name).is_err() {
            name = format!("x_{}", rows.len() + 1);
        }
        let wanted = name.clone();
        let mut number = 2;
        while rows.iter().any(|row| row.name == name) {
            name = format!("{wanted}_{number}");
            number += 1;
        }
        if name != words {
            self.guessed.push(format!("line {}: `{words}` is called `{name}`", line + 1));
        }
        name
    }

    /// The number in a cell and the unit behind it, which is empty where there is none.
    fn with_unit<'c>(
        &'c self,
        header: &Header,
        line: usize,
        column: Column,
        lenient: bool,
    ) -> Option<(f64, &'c str)> {
        let text = header.cell(self.cells, line, column).trim();
        if text.is_empty() || matches!(text, "-" | "–" | "—") {
            return None;
        }
        if column == Column::Dof
            && ["inf", "infinity", "∞", "unendlich", "infinite"]
                .contains(&text.to_lowercase().as_str())
        {
            return None;
        }
        let read = grid::number_with_unit(text, self.cells.decimal_comma());
        let is_unit = |unit: &str| grouped_digits(unit).is_none() && Unit::parse(unit).is_ok();
        let read = read.filter(|(_, unit)| unit.is_empty() || is_unit(unit));
        if read.is_none() && !lenient {
            let reason = format!("`{text}` in the column of the {} is no number", column.name());
            self.fail(line, reason);
        }
        if let Some((_, unit)) = read
            && let digits = text.strip_suffix(unit).unwrap_or(text)
            && let Err(reason) = self.marks.borrow_mut().with_point(digits)
            && self.log.is_clean()
        {
            self.fail(line, reason);
        }
        read
    }

    /// A number that has no unit.
    fn number(&self, header: &Header, line: usize, column: Column, lenient: bool) -> Option<f64> {
        let (value, unit) = self.with_unit(header, line, column, lenient)?;
        if !unit.is_empty() && !lenient {
            self.fail(
                line,
                format!("the {} has no unit, so that `{unit}` is too much", column.name()),
            );
        }
        Some(value)
    }

    /// A number in the unit of its row, which is that of its first number where no column has one; per
    /// cent are a share of the estimate where the unit is neither per cent nor one.
    fn in_unit(
        &mut self,
        header: &Header,
        line: usize,
        (column, lenient): (Column, bool),
        row: &mut Row,
    ) -> Option<f64> {
        let (value, unit) = self.with_unit(header, line, column, lenient)?;
        let unit = unit.to_owned();
        let text = header.cell(self.cells, line, column).trim();
        if column != Column::Estimate && value < 0.0 && !lenient {
            self.fail(line, format!("the {} `{text}` is below zero", column.name()));
            return None;
        }
        if !unit.is_empty() {
            return self.converted((value, &unit), line, (column, lenient), row);
        }
        if !text.ends_with('%') || row.unit.is_empty() {
            return Some(value);
        }
        if row.unit == "%" {
            return Some(100.0 * value);
        }
        let Some(estimate) = row.estimate.filter(|_| column != Column::Estimate) else {
            let reason = format!("`{text}` is a share, but the unit of this row is `{}`", row.unit);
            self.fail(line, reason);
            return None;
        };
        self.guessed.push(format!(
            "line {}: `{text}` is taken of the estimate {}",
            line + 1,
            Shortest(estimate)
        ));
        Some(value * estimate.abs())
    }

    /// A number with a unit behind it, in that of its row.
    fn converted(
        &self,
        (value, unit): (f64, &str),
        line: usize,
        (column, lenient): (Column, bool),
        row: &mut Row,
    ) -> Option<f64> {
        if row.unit.is_empty() {
            unit.clone_into(&mut row.unit);
        }
        let (from, to) = (Unit::parse(unit).ok()?, Unit::parse(&row.unit).ok()?);
        let factor = Unit::conversion_factor(&from, &to).ok();
        // of a temperature the size of the degree
        let shifted = column == Column::Estimate && from.zero() != to.zero();
        match factor.filter(|_| !shifted) {
            Some(1.0) => Some(value),
            // each step rounded once
            Some(_) => Some(to.from_si(from.to_si(value))),
            None if lenient => None,
            None => {
                let reason =
                    format!("the {} is in `{unit}`, but the row in `{}`", column.name(), row.unit);
                self.fail(line, reason);
                None
            }
        }
    }

    /// The coverage factor of a row from the header of its column.
    fn coverage(&mut self, header: &Header, row: &mut Row) {
        let line = row.line + 1;
        let place = header.columns.iter().find(|(_, column)| *column == Column::Width);
        let of_header = place
            .filter(|_| row.width.is_some() && row.divisor.is_none())
            .map(|(place, _)| self.cells.text(header.line, *place));
        match of_header.map(HeaderCoverage::of) {
            Some(HeaderCoverage::Factor(factor)) => row.divisor = Some(factor),
            Some(HeaderCoverage::Expanded) if matches!(row.distribution, None | Some("normal")) => {
                row.divisor = Some(2.0);
                self.guessed.push(format!(
                    "line {line}: `{}` is expanded, and nothing says by which factor: k = 2 is taken",
                    row.name
                ));
            }
            _ => {}
        }
    }

    /// Says what a row's shape, uncertainty and divisor do not say together.
    fn contradictions(&mut self, row: &Row) {
        let line = row.line + 1;
        let shape = row.distribution.filter(|shape| *shape != "normal");
        let uncertain = row.std.or(row.width).is_some_and(|u| u > 0.0);
        if let Some(shape) = row.distribution.filter(|_| !uncertain) {
            self.guessed.push(format!(
                "line {line}: `{}` is {shape} without an uncertainty; it is taken for a constant",
                row.name
            ));
        } else if let (Some(shape), true) = (shape, is_normal_here(row)) {
            self.guessed.push(format!(
                "line {line}: `{}` is {shape}, but its uncertainty is not half a width: a normal \
                 distribution of that standard uncertainty is taken",
                row.name
            ));
        }
    }

    /// A divisor: a number, a root such as `√3` or `sqrt(3)`, or a factor such as `k = 2`.
    fn divisor(&self, header: &Header, line: usize, lenient: bool) -> Option<f64> {
        let text = header.cell(self.cells, line, Column::Divisor).trim().to_lowercase();
        let text = match text.strip_prefix('k').map(str::trim_start) {
            Some(rest) => rest.strip_prefix('=').map_or(text.as_str(), str::trim_start).to_owned(),
            None => text,
        };
        if text.is_empty() || matches!(text.as_str(), "-" | "–" | "—") {
            return None;
        }
        let radicand = text
            .strip_prefix('√')
            .or_else(|| text.strip_prefix("sqrt"))
            .or_else(|| text.strip_prefix("wurzel"))
            .map(|rest| rest.trim().trim_start_matches('(').trim_end_matches(')').trim());
        let comma = self.cells.decimal_comma();
        let read = match radicand {
            Some(radicand) => grid::number(radicand, comma).map(f64::sqrt),
            None => grid::number(&text, comma),
        };
        match read {
            Some(divisor) if divisor > 0.0 => Some(divisor),
            _ if lenient => None,
            _ => {
                self.fail(line, format!("the divisor `{text}` is no number above 0"));
                None
            }
        }
    }

    fn unit(&mut self, header: &Header, line: usize, lenient: bool) -> String {
        let text = header.cell(self.cells, line, Column::Unit).trim();
        if text.is_empty() || matches!(text, "-" | "–" | "1") {
            return String::new();
        }
        match Unit::parse(text) {
            Ok(_) => text.to_owned(),
            Err(_) if lenient => String::new(),
            Err(error) => {
                self.guessed.push(format!(
                    "line {}: `{text}` is taken for a plain number, because it is no unit known \
                     here ({error})",
                    line + 1
                ));
                String::new()
            }
        }
    }

    fn distribution(&mut self, header: &Header, line: usize) -> Option<&'static str> {
        let text = header.cell(self.cells, line, Column::Distribution).trim();
        let found = columns::distribution(text);
        if found.is_none() && !text.is_empty() && !matches!(text, "-" | "–") {
            self.guessed.push(format!(
                "line {}: the distribution `{text}` is not known; the divisor decides",
                line + 1
            ));
        }
        found
    }
}

/// Why the last row of a budget is taken for its result.
const NO_UNCERTAINTY: &str = "has no uncertainty of its own";

/// Why the last row is the result and no quantity, if it is: it lacks what every other one has, or it
/// is their sum with their combined uncertainty.
fn last_is_result(rows: &[Row]) -> Option<&'static str> {
    let (last, others) = rows.split_last().filter(|(_, others)| !others.is_empty())?;
    let bare = |row: &Row| row.width.is_none() && row.std.is_none();
    if bare(last) {
        return others.iter().all(|row| !bare(row)).then_some(NO_UNCERTAINTY);
    }
    if last.distribution.is_some() || last.sensitivity.is_some() {
        return None;
    }
    if others.iter().all(|row| row.sensitivity.is_some()) {
        return Some("has neither a sensitivity coefficient nor a distribution");
    }
    // a sum of two rows may be a third one by chance, with its uncertainty as well hardly
    let near = |a: f64, b: f64| (a - b).abs() <= 0.01 * a.abs().max(b.abs());
    let of = |row: &Row| row.sensitivity.unwrap_or(1.0);
    let sum: f64 = others.iter().map(|row| of(row) * row.estimate.unwrap_or(0.0)).sum();
    let squares =
        others.iter().filter_map(|row| Some((of(row) * standard_uncertainty(row)?).powi(2)));
    let combined = squares.sum::<f64>().sqrt();
    let stated = last.std.or(last.width)?;
    let is_sum = last.estimate.is_some_and(|estimate| near(estimate, sum));
    let is_combined = near(stated, combined) || near(stated, 2.0 * combined);
    (others.len() > 1 && is_sum && is_combined)
        .then_some("is the sum of the others with their combined uncertainty")
}

/// Shapes that are stated by a half width, and the square of what that is divided by.
const HALF_WIDTHS: [(&str, f64); 3] = [("rectangular", 3.0), ("triangular", 6.0), ("arcsine", 2.0)];

/// What a shape's half width is divided by.
fn divisor_of(shape: &str) -> Option<f64> {
    HALF_WIDTHS.iter().find(|(name, _)| *name == shape).map(|(_, square)| square.sqrt())
}

fn near(a: f64, b: f64) -> bool {
    (a / b - 1.0).abs() < 0.01
}

/// Whether a row whose shape is not normal becomes a normal input: its uncertainty is a standard one,
/// or divided by something else than the shape's divisor.
fn is_normal_here(row: &Row) -> bool {
    let usual = row.distribution.and_then(divisor_of);
    row.width.is_none()
        || row.divisor.zip(usual).is_some_and(|(divisor, usual)| !near(divisor, usual))
}

/// What an input of the model file says of a row.
fn input(row: &Row) -> Value {
    let mut input = Map::new();
    if !row.unit.is_empty() {
        input.insert("unit".to_owned(), row.unit.as_str().into());
    }
    let mut put = |key: &str, value: Value| input.insert(key.to_owned(), value);
    let mean = row.estimate.unwrap_or(0.0);
    let uncertain = row.std.filter(|std| *std > 0.0).or(row.width.filter(|width| *width > 0.0));
    if uncertain.is_none() {
        put("distribution", "constant".into());
        put("value", json!(mean));
    } else if let (Some(width), divisor) = (row.width.filter(|width| *width > 0.0), row.divisor) {
        // a divisor of root 3, 6 or 2 stands for a shape where none is named
        let of_divisor = divisor.and_then(|divisor| {
            let shape = HALF_WIDTHS.iter().find(|(_, square)| near(divisor, square.sqrt()));
            shape.map(|(name, _)| *name)
        });
        let named = row.distribution.or(of_divisor).unwrap_or("normal");
        match divisor_of(named) {
            Some(usual) if divisor.is_none_or(|divisor| near(divisor, usual)) => {
                put("distribution", named.into());
                put("mean", json!(mean));
                put("half_width", json!(width));
            }
            _ => {
                put("distribution", "normal".into());
                put("mean", json!(mean));
                match divisor {
                    Some(divisor) if divisor != 1.0 => {
                        put("expanded", json!(width));
                        put("k", json!(divisor));
                    }
                    _ => {
                        put("std", json!(width));
                    }
                }
            }
        }
    } else {
        put("distribution", "normal".into());
        put("mean", json!(mean));
        put("std", json!(row.std));
    }
    let shaped = input.get("distribution").and_then(Value::as_str).map(str::to_owned);
    if let Some(dof) = row.dof
        && matches!(shaped.as_deref(), Some("normal" | "rectangular" | "triangular"))
    {
        input.insert("dof".to_owned(), json!(dof));
    }
    if !row.about.is_empty() && row.about != row.name {
        input.insert("about".to_owned(), row.about.as_str().into());
    }
    Value::Object(input)
}

/// The model file as text, an input in each line.
fn document(
    title: &str,
    rows: &[Row],
    measurand: &str,
    unit: &str,
    formula: &str,
    checked: bool,
) -> String {
    let mut text = String::from("{\n");
    let mut line = |key: &str, value: &Value, last: bool| {
        text.push_str(&format!("  {}: {value}{}\n", json!(key), if last { "" } else { "," }));
    };
    line("format", &json!(2), false);
    line("title", &json!(title), false);
    if !checked {
        line("check_units", &json!(false), false);
    }
    text.push_str("  \"inputs\": {\n");
    for (place, row) in rows.iter().enumerate() {
        let comma = if place + 1 == rows.len() { "" } else { "," };
        text.push_str(&format!("    {}: {}{comma}\n", json!(row.name), input(row)));
    }
    text.push_str("  },\n");
    let output = if unit.is_empty() { json!({}) } else { json!({ "unit": unit }) };
    let mut equations = Map::new();
    equations.insert(measurand.to_owned(), formula.into());
    let mut outputs = Map::new();
    outputs.insert(measurand.to_owned(), output);
    text.push_str(&format!("  \"equations\": {},\n", Value::Object(equations)));
    text.push_str(&format!("  \"outputs\": {}\n}}\n", Value::Object(outputs)));
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn import(name: &str, content: &[u8]) -> Result<ImportedBudget, Diagnostics> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, content).unwrap();
        import_budget(&path)
    }

    fn task(budget: &ImportedBudget) -> gumption_engine::task::Task {
        read_text("m", &budget.text, Path::new(""), &[])
            .unwrap_or_else(|faults| panic!("{}\n{faults}", budget.text))
            .task
    }

    /// EA-4/02, S2: calibration of a weight of 10 kg. Published: 10 000.025 g, u = 29.3 mg, of parts
    /// that are rounded to a tenth of a milligram.
    #[test]
    fn a_budget_with_sensitivities() {
        let text = "Calibration of a weight\n\nQuantity,Estimate,Unit,Standard uncertainty,\
            Distribution,Sensitivity coefficient c_i\n\
            m_S,10000.005,g,0.0225,normal,1\n\
            Delta m_D,0,g,0.00866,rectangular,1\n\
            dm,0.020,g,0.0144,normal,1\n\
            dm_C,0,g,0.00577,rectangular,1\n\
            dB,0,g,0.00577,rectangular,1\n\n\
            m_X,10000.025,g,,,\n";
        let budget = import("S2.csv", text.as_bytes()).unwrap();
        let task = task(&budget);
        let of = &task.rows[0].distributions;
        let variance: f64 = of.iter().map(|d| d.standard_uncertainty().powi(2)).sum();
        assert!((variance.sqrt() - 0.0293).abs() < 1e-4);
        assert!(budget.guessed.iter().any(|said| said.contains("Delta_m_D")));
    }

    /// A German sheet with semicolons, decimal commas, a formula and divisors as roots.
    #[test]
    fn a_german_budget_with_an_equation() {
        let text = "R = U/I;;;;;;\n\nGröße;Schätzwert;Einheit;Halbbreite;Verteilung;Teiler;\
            Freiheitsgrade\nU;5,0112;V;0,0046;Normal;2;50\nI;0,01;A;0,00001;Rechteck;√3;∞\n";
        let budget = import("r.csv", text.as_bytes()).unwrap();
        let task = task(&budget);
        assert_eq!(task.model.outputs[0].quantity.name, "R");
        let of = &task.rows[0].distributions;
        assert_eq!(
            [of[0].mean(), of[0].standard_uncertainty(), of[0].dof()],
            [5.0112, 0.0023, 50.0]
        );
        assert_eq!(of[1].name(), "rectangular");
        assert!(budget.text.contains(r#""R":"U/I""#), "{}", budget.text);
    }

    /// The standard uncertainties of a budget's inputs, in units of their own.
    fn uncertainties(text: &str) -> (Vec<f64>, ImportedBudget) {
        let budget = import("b.csv", text.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
        let found = task(&budget);
        (found.rows[0].distributions.iter().map(|d| d.standard_uncertainty()).collect(), budget)
    }

    fn guesses(budget: &ImportedBudget, part: &str) -> bool {
        budget.guessed.iter().any(|said| said.contains(part))
    }

    /// A header that names the factor of its uncertainties; before, they were taken for standard ones.
    #[test]
    fn expanded_uncertainties_have_the_factor_of_their_header() {
        // u = U/k; the quantile of 0.975 is 1.959964
        for (header, u) in [
            ("Expanded uncertainty (k=2)", 2e-4),
            ("U (k = 2.5)", 1.6e-4),
            ("U (p=95 %)", 4e-4 / 1.959_963_984_540_054),
            ("Erweiterte Messunsicherheit (k=2)", 2e-4),
            ("Erw. Unsicherheit (k=2)", 2e-4),
        ] {
            let text =
                format!("Quantity,Estimate,Unit,{header},Distribution\nm,1,kg,0.0004,normal\n");
            let (found, budget) = uncertainties(&text);
            assert!((found[0] / u - 1.0).abs() < 1e-12, "{header}: {found:?}");
            assert!(!guesses(&budget, "expanded"), "{:?}", budget.guessed);
        }
        for header in ["U", "Expanded uncertainty", "Erweiterte Unsicherheit"] {
            let text = format!("Quantity,Estimate,Unit,{header}\nm,1,kg,0.0004\n");
            let (found, budget) = uncertainties(&text);
            assert_eq!(found, [2e-4], "{header}");
            assert!(guesses(&budget, "k = 2 is taken"), "{:?}", budget.guessed);
        }
    }

    /// Per cent of the estimate, but of a quantity in per cent per cent.
    #[test]
    fn per_cent_are_of_the_estimate() {
        let text = "Quantity,Estimate,Unit,+-,Divisor,Distribution,c_i\n\
                    x,5,V,0.4 %,2,normal,1\nh,50,%,2 %,2,normal,0.02\n";
        let (found, budget) = uncertainties(text);
        assert!((found[0] - 0.01).abs() < 1e-15 && (found[1] - 1.0).abs() < 1e-15, "{found:?}");
        assert!(guesses(&budget, "of the estimate 5"), "{:?}", budget.guessed);
        let error = import("x.csv", b"quantity,estimate,unit,+-\nx,5,V,-0.1\n").unwrap_err();
        assert!(error.to_string().contains("below zero"), "{error}");
    }

    /// The factor of a summary is no input, and what is printed beside it not the result's estimate.
    #[test]
    fn summaries_are_no_inputs() {
        let text = "Quantity,Estimate,Unit,Standard uncertainty,Sensitivity coefficient\n\
                    U,5.01,V,0.01,1\nI,2,A,0.02,3\nCombined standard uncertainty,0.061,,,\n\
                    k,2,,,\nExpanded uncertainty,0.12,,,\n";
        let budget = import("b.csv", text.as_bytes()).unwrap();
        let found = task(&budget);
        assert_eq!(found.variables.len(), 2);
        assert!(budget.text.contains(r#""y":"U + (3)*I""#), "{}", budget.text);
    }

    /// A row that is named as the equation's left side is the result, with its unit.
    #[test]
    fn the_row_of_the_measurand_is_the_result() {
        let text = "R = U/I,,,\n\nQuantity,Estimate,Unit,Standard uncertainty\n\
                    U,5.01,V,0.01\nI,1.25,mA,0.001\nR,4.01,kohm,\n";
        let budget = import("b.csv", text.as_bytes()).unwrap();
        let found = task(&budget);
        let output = &found.model.outputs[0].quantity;
        assert_eq!((output.name.as_str(), output.unit.text()), ("R", "kohm"));
        assert_eq!(found.variables.len(), 2);
        assert!(!guesses(&budget, "not checked"), "{:?}", budget.guessed);
    }

    /// What a shape does not say of its uncertainty is told.
    #[test]
    fn other_divisors_and_missing_uncertainties_are_told() {
        let text = "Quantity,Estimate,Unit,+-,Divisor,Distribution\nb,1,V,,,normal\n\
                    a,1,V,0.1,2,rectangular\n";
        let (found, budget) = uncertainties(text);
        assert_eq!(found, [0.0, 0.05]);
        assert!(guesses(&budget, "`a` is rectangular, but"), "{:?}", budget.guessed);
        assert!(guesses(&budget, "`b` is normal without"), "{:?}", budget.guessed);
    }

    /// Quantities in units of one dimension are added in one of them; before, as bare numbers.
    #[test]
    fn sums_are_in_one_unit() {
        let text = "Quantity,Estimate,Unit,Standard uncertainty\n\
                    a,5,V,0.002\nb,2,mV,1\n";
        let (found, budget) = uncertainties(text);
        assert_eq!(found, [0.002, 1.0]);
        assert!(budget.text.contains(r#""y":"a + (0.001)*b""#), "{}", budget.text);
        assert_eq!(task(&budget).model.outputs[0].quantity.unit.text(), "V");
        assert!(guesses(&budget, "`b` in mV is converted to V"), "{:?}", budget.guessed);
        for (row, part) in [
            ("b,2,A,1", "`b` is in `A`, the result in `V`"),
            ("b,2,,1", "`b` is without a unit, the result in `V`"),
        ] {
            let text = format!("Quantity,Estimate,Unit,Standard uncertainty\na,5,V,0.002\n{row}\n");
            let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
            assert!(error.contains(part), "{error}");
        }
    }

    /// A coefficient of a quantity in mV, of a result in V: with its unit, without it, and the same
    /// number in both readings.
    #[test]
    fn coefficients_have_units() {
        let table = |rows: &str| {
            let head = "Quantity,Estimate,Unit,Standard uncertainty,c_i,Unit of c_i";
            format!("{head}\n{rows}\nResult,5.002,V,,,\n")
        };
        for rows in [
            "a,5,V,0.002,1,V/V\nb,2,mV,1,1,V/V",
            "a,5,V,0.002,1,1\nb,2,mV,1,0.001,V/mV",
            "a,5,V,0.002,1,1\nb,2,mK,1,1,V/K",
            "a,5,V,0.002,1,\nb,2,mV,1,0.001,",
        ] {
            let budget = import("b.csv", table(rows).as_bytes()).unwrap();
            assert!(budget.text.contains(r#""y":"a + (0.001)*b""#), "{}", budget.text);
        }
        // the contribution tells which
        let text = "Quantity,Estimate,Unit,Standard uncertainty,c_i,Contribution\n\
                    a,5,V,0.002,1,2 mV\nb,2,mV,1,1,1 mV\nResult,5.002,V,,,\n";
        let budget = import("b.csv", text.as_bytes()).unwrap();
        assert!(budget.text.contains(r#""y":"a + (0.001)*b""#), "{}", budget.text);
        assert!(!guesses(&budget, "contributes"), "{:?}", budget.guessed);
        for (rows, part) in [
            ("a,5,V,0.002,1,\nb,2,mV,1,1,", "can be 1 V/mV or 1 V/V"),
            ("a,5,V,0.002,1,1\nb,2,mV,1,1,V/A", "a coefficient in `V/A` times `mV`"),
            ("a,5,V,0.002,1,1\nb,2,mV,1,1,V/foo", "`V/foo` of the coefficient is not known"),
        ] {
            let error = import("b.csv", table(rows).as_bytes()).unwrap_err().to_string();
            assert!(error.contains(part), "{error}");
        }
    }

    /// EA-4/02, S2 as it is printed: units behind the numbers, in g and mg, and digits in groups.
    /// Published: 10 000,025 g with u = 29,3 mg.
    #[test]
    fn numbers_with_units_in_their_cells() {
        let text = "Größe;Schätzwert;Standardunsicherheit;Verteilung;Sensitivitätskoeffizient;Beitrag\n\
            m_S;10 000,005 g;22,5 mg;Normal;1,0;22,5 mg\n\
            dm_D;0,000 g;8,66 mg;Rechteck;1,0;8,66 mg\n\
            dm;0,020 g;14,4 mg;Normal;1,0;14,4 mg\n\
            dm_C;0,000 g;5,77 mg;Rechteck;1,0;5,77 mg\n\
            dB;0,000 g;5,77 mg;Rechteck;1,0;5,77 mg\n\
            m_X;10 000,025 g;;;;29,3 mg\n";
        let (found, budget) = uncertainties(text);
        let combined = found.iter().map(|u| u * u).sum::<f64>().sqrt();
        // of published parts that are rounded to a tenth of a milligram
        assert!((combined - 0.0293).abs() < 1e-4, "{found:?}");
        assert!(budget.text.contains(r#""m_X":"m_S + dm_D + dm + dm_C + dB""#), "{}", budget.text);
        assert_eq!(task(&budget).model.outputs[0].quantity.unit.text(), "g");
        assert!(!guesses(&budget, "contributes"), "{:?}", budget.guessed);
        let text = "Quantity,Estimate,Standard uncertainty,Sensitivity coefficient\n\
                    l,50.0002 mm,100 nm,1\ndt,0.1 K,50 mK,575 nm/K\n";
        let (found, budget) = uncertainties(text);
        assert!((found[0] - 1e-4).abs() < 1e-18 && (found[1] - 0.05).abs() < 1e-15, "{found:?}");
        assert!(budget.text.contains(r#""y":"l + (0.000575)*dt""#), "{}", budget.text);
        for (row, part) in [
            ("l,50 mm,1 V,1", "the standard uncertainty is in `V`, but the row in `mm`"),
            ("l,50 12 mm,1 mm,1", "`50 12 mm` in the column of the estimate is no number"),
            ("t,20 degC,0.1 degF,1", ""),
        ] {
            let text =
                format!("Quantity,Estimate,Standard uncertainty,Sensitivity coefficient\n{row}\n");
            match import("b.csv", text.as_bytes()) {
                Ok(_) => assert_eq!(part, "", "{row}"),
                Err(error) => assert!(error.to_string().contains(part), "{error}"),
            }
        }
    }

    /// A budget of half widths in cells with units, with the factor of its expanded uncertainty.
    #[test]
    fn half_widths_with_units_and_a_summary() {
        let text = "Source of uncertainty,Value ±,Probability distribution,Divisor,ci,ui(y)\n\
            Calibration,0.5 um,normal,2,1,0.25 um\n\
            Resolution,0.5 um,rectangular,√3,1,0.29 um\n\
            Temperature,1 degC,rectangular,sqrt(3),0.2 um/degC,0.12 um\n\
            Combined standard uncertainty,,normal,,,0.40 um\n\
            Expanded uncertainty,,,k = 2,,0.8 um\n";
        let (found, budget) = uncertainties(text);
        let right = [0.25, 0.5 / 3f64.sqrt(), 1.0 / 3f64.sqrt()];
        assert!(found.iter().zip(right).all(|(u, right)| (u - right).abs() < 1e-15), "{found:?}");
        let formula = r#""y":"Calibration + Resolution + (0.2)*Temperature""#;
        assert!(budget.text.contains(formula), "{}", budget.text);
        assert_eq!(task(&budget).model.outputs[0].quantity.unit.text(), "um");
        assert!(!guesses(&budget, "contributes"), "{:?}", budget.guessed);
        let text = "Quantity,Estimate,Unit,Standard uncertainty,c_i\nV,5,V,15 uV,1\n\
                    T,23,degC,0.5,10 uV/K\n";
        let budget = import("b.csv", text.as_bytes()).unwrap();
        assert!(budget.text.contains(r#""std":0.000015}"#), "{}", budget.text);
        assert!(budget.text.contains("(1e-5)*T"), "{}", budget.text);
    }

    /// A result below its quantities that has an uncertainty, but neither a coefficient nor a shape.
    #[test]
    fn the_last_row_may_be_the_result() {
        for text in [
            "Quantity,Estimate,Unit,Standard uncertainty,Distribution,c_i\n\
             a,5,V,0.003,normal,1\nb,2,V,0.004,normal,1\nU_x,7,V,0.005,,\n",
            "Quantity,Estimate,Unit,Standard uncertainty\na,5,V,0.003\nb,2,V,0.004\nU_x,7,V,0.005\n",
            "Quantity,Estimate,Unit,U (k=2)\na,5,V,0.006\nb,2,V,0.008\nU_x,7,V,0.01\n",
        ] {
            let (found, budget) = uncertainties(text);
            assert_eq!(found, [0.003, 0.004], "{}", budget.text);
            assert!(guesses(&budget, "taken for the result"), "{:?}", budget.guessed);
            assert_eq!(task(&budget).model.outputs[0].quantity.name, "U_x");
        }
    }

    /// What the equation does not name, and contributions of the sheet that are others, are told.
    #[test]
    fn what_contributes_nothing_or_something_else_is_told() {
        let text = "R = U/I,,,\n\nQuantity,Estimate,Unit,Standard uncertainty\n\
                    U,5.01,V,0.01\nI,1.25,mA,0.001\ndT,0,K,0.1\n";
        let budget = import("b.csv", text.as_bytes()).unwrap();
        assert_eq!(task(&budget).model.outputs[0].quantity.unit.text(), "ohm");
        assert!(guesses(&budget, "`ohm` is taken"), "{:?}", budget.guessed);
        assert!(guesses(&budget, "`dT` is not in the equation of R"), "{:?}", budget.guessed);
        let text = "Quantity,Estimate,Unit,Standard uncertainty,c_i,Contribution\n\
                    a,5,V,0.002,1,0.002\nb,2,K,0.5,3,0.5\n";
        let (_, budget) = uncertainties(text);
        assert!(guesses(&budget, "`b` contributes 0.5, this model 1.5 V"), "{:?}", budget.guessed);
        assert!(!guesses(&budget, "`a` contributes"), "{:?}", budget.guessed);
    }

    #[test]
    fn what_is_no_budget() {
        for (content, part) in [
            ("a,b\n1,2\n", "no budget is found"),
            ("label,x,U\nA,1,0.1\n", "gumption compare"),
            ("", "no budget is found"),
            ("quantity,estimate,+-\n", "no row below"),
            ("quantity,estimate,+-\nx,one,2\n", "no number"),
            ("quantity;estimate;+-\nx;1.234;0,5\n", "with the same decimal mark"),
            ("quantity,estimate,+-,divisor\nx,1,2,zero\n", "divisor"),
        ] {
            let error = import("x.csv", content.as_bytes()).unwrap_err().to_string();
            assert!(error.contains(part), "{content}: {error}");
        }
        let error = import("x.xlsx", b"no workbook").unwrap_err().to_string();
        assert!(error.contains("no workbook"), "{error}");
    }
}
