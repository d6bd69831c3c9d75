//! Budgets that laboratories keep in spreadsheets, as model files.
//!
//! A budget is a table somewhere on a sheet: a header, one row for each quantity, perhaps a row of
//! the result, perhaps the equation. What is found is said, and so is what had to be guessed.

mod bare_number;
pub(crate) mod both;
pub(crate) mod columns;
pub(crate) mod concise;
mod corrected;
pub(crate) mod coverage;
mod cut;
mod document;
mod equation;
mod extent;
mod grid;
pub(crate) mod heading;
mod limits;
mod linear;
pub(crate) mod mark;
mod negligible;
pub(crate) mod number;
mod own;
mod pint;
mod rows;
mod scaled;
mod sheets;
mod signs;
mod stated;
mod suncal;
mod symbol;
mod temperature;
mod title;
mod yaml;

use gumption_files::open::{FileKind, are_results};
use std::cell::RefCell;
use std::path::Path;

use columns::{Column, Header};
use document::document;
use equation::{Equation, Equations};
use gumption_columns::separator::DecimalMarks;
use gumption_engine::model::formula::{Formula, FormulaError, Scope, Typing};
use gumption_files::read_text;
use gumption_text::{Collector, DiagnosticKind, Diagnostics, SourceText, bytes, workbook};
use gumption_units::Unit;
use number::value;
use rows::{Row, Table};
use sheets::Chosen;
use stated::Stated;

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

/// Reads a budget from a CSV file or from the sheet of an XLSX file that holds one; of a workbook that this
/// program has made, its model file with the cells that were changed; of a YAML file the first
/// calculation of an uncertainty of a suncal project.
///
/// # Errors
/// A file that cannot be read, or in which no budget is found; rows with mistakes, all at once.
pub fn import_budget(path: &Path) -> Result<ImportedBudget, Diagnostics> {
    import_budget_sheet(path, None)
}

/// As [`import_budget`], of the sheet of that name of an XLSX file.
///
/// # Errors
/// As [`import_budget`]; a sheet that is not there.
pub fn import_budget_sheet(
    path: &Path,
    sheet: Option<&str>,
) -> Result<ImportedBudget, Diagnostics> {
    match bytes::of_file(path, bytes::MOST) {
        Ok(content) => imported(path, content, sheet),
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
    imported(path, content, None)
}

fn imported(
    path: &Path,
    content: Vec<u8>,
    sheet: Option<&str>,
) -> Result<ImportedBudget, Diagnostics> {
    let name = path.display().to_string();
    let source = |text: &str| SourceText::new(name.clone(), text);
    let failed = |kind: DiagnosticKind| {
        let log = Collector::new(source(""));
        log.report(&(0..0), kind);
        Err(log.into_diagnostics())
    };
    let is_workbook = match workbook::is_workbook(path) {
        Ok(is_workbook) => is_workbook,
        Err(message) => return failed(DiagnosticKind::Unreadable { message }),
    };
    if let Some(sheet) = sheet.filter(|_| !is_workbook) {
        let message = format!("it is no workbook (.xlsx), and so has no sheet `{sheet}`");
        return failed(DiagnosticKind::Unreadable { message });
    }
    if is_workbook && sheet.is_none() {
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
    let read = if is_workbook {
        Chosen::of(content, sheet)
    } else {
        grid::of_text(&content).map(|(cells, text)| Chosen { cells, text, said: Vec::new() })
    };
    let Chosen { cells, text, said } = match read {
        Ok(read) => read,
        Err(kind) => return failed(kind),
    };
    let title = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let log = Collector::new(source(&text));
    let marks = RefCell::new(cells.marks());
    let mut budget = Budget { cells: &cells, marks, log: &log, understood: said, guessed: vec![] };
    let made = budget.model(&title.unwrap_or_default());
    let said = [budget.understood, budget.guessed];
    let [understood, guessed] = said.map(|of| of.iter().map(|said| shortened(said)).collect());
    log.finish(made.map(|text| ImportedBudget { text, understood, guessed }))
}

/// A sentence whose quotes are no longer than a cell that people write: of a longer one the beginning.
fn shortened(sentence: &str) -> String {
    const MOST: usize = 120;
    let parts = sentence.split('`').enumerate().map(|(place, part)| {
        match part.char_indices().nth(MOST).filter(|_| place % 2 == 1) {
            Some((end, _)) if part.len() > 2 * MOST => format!("{}…", &part[..end]),
            _ => part.to_owned(),
        }
    });
    parts.collect::<Vec<_>>().join("`")
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
        self.log.report(&span, DiagnosticKind::Table { reason: shortened(&reason) });
    }

    /// The model file of the budget.
    fn model(&mut self, title: &str) -> Option<String> {
        let header = Header::find(self.cells);
        if !self.is_shown(header.as_ref()) {
            return None;
        }
        let Some(header) = header else {
            if are_results(self.cells.row(0).iter().map(|cell| cell.trim())) {
                self.log.report(&self.cells.line(0), FileKind::Results.described());
                return None;
            }
            if let Some((line, known, unknown)) = Header::nearly(self.cells) {
                let quoted = |of: &[String]| {
                    let of: Vec<String> = of.iter().map(|of| format!("`{of}`")).collect();
                    gumption_units::listed(&of, " and ")
                };
                let others = match unknown.len() {
                    0 => String::new(),
                    1 => format!(", and {} is not known", quoted(&unknown)),
                    _ => format!(", and {} are not known", quoted(&unknown)),
                };
                let reason = format!(
                    "no budget is found: {} head columns here, none of which holds an uncertainty{others}: \
                     head the column of uncertainties `Standard uncertainty`, `Half-width` or `U (k=2)`",
                    quoted(&known)
                );
                self.fail(line, reason);
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
        if let Some(line) = header.repeated(self.cells) {
            let reason = format!(
                "line {} begins a second budget: keep one budget in a file (or on a sheet); where the one \
                 above goes on, delete the line",
                line.max(header.line) + 1
            );
            self.fail(line.max(header.line), reason);
            return None;
        }
        if !self.has_known_mark(&header) || !self.has_own_numbers(&header) {
            return None;
        }
        let shown: Vec<String> = header
            .columns
            .iter()
            .map(|(place, column)| {
                let unit = header.unit(*column);
                let unit = unit.map_or_else(String::new, |unit| format!(" in {unit}"));
                format!("`{}` as {}{unit}", header.heading(*place), column.name())
            })
            .collect();
        self.understood.push(format!("line {}: columns {}", header.first + 1, shown.join(", ")));
        self.hidden_columns(&header);
        if header.has_widths_as_values {
            let column = header.columns.iter().find(|(_, column)| *column == Column::Width);
            let text = column.map_or("", |(place, _)| header.heading(*place));
            self.guessed.push(format!(
                "`{text}` is taken for half-widths and expanded uncertainties, as its numbers over \
                 the divisors are the standard uncertainties or make the contributions; estimates are 0"
            ));
        }
        if let Some((text, unit)) = &header.unit_of_all {
            self.understood
                .push(format!("`{text}`: {unit} is the unit of the columns that say none"));
        }
        let readings = header.number_of_readings(self.cells);
        for place in header.unknown.iter().filter(|place| readings != Some(**place)) {
            let text = header.heading(*place);
            self.guessed.push(format!("the column `{text}` is not taken"));
        }
        if !header.doubtful.is_empty() {
            header.doubtful.iter().for_each(|reason| self.fail(header.first, reason.clone()));
            return None;
        }
        let known = self.names(&header);
        let found = Equations::of(self.cells);
        let names = [Column::Symbol, Column::Quantity];
        let is_name = |line: usize, place: usize| {
            let mut columns = header.columns.iter();
            line > header.line && columns.any(|(at, of)| *at == place && names.contains(of))
        };
        if let Some((line, reason)) = found.cut_row(is_name) {
            self.fail(line, reason);
            return None;
        }
        let (mut equations, unread) = match found.of_result(&known) {
            Ok(Equations { read, unread, .. }) => (read, unread),
            Err((line, reason)) => {
                self.fail(line, reason);
                return None;
            }
        };
        if equations.is_empty()
            && let Some(place) = header.possible_coefficients(self.cells)
        {
            let reason = format!(
                "the column `{}` may hold sensitivity coefficients, without which the result is the sum of \
                 the quantities: head it `Sensitivity coefficient`, or take it away",
                header.heading(place)
            );
            self.fail(header.first, reason);
            return None;
        }
        let measured = equations.last().map(|equation| equation.name.clone());
        let used: Vec<String> = equations.iter().flat_map(Equation::names).collect();
        let Table { mut rows, result, stated, factor } =
            self.rows(&header, measured.as_deref(), &used);
        if !equations.is_empty() {
            self.differences_in_kelvin(&mut rows);
            self.units_of_bare_numbers(&rows, &mut equations);
        }
        self.needs_estimates(&header, &rows, &equations);
        let has_coefficients = rows.iter().any(|row| row.sensitivity.is_some());
        self.unread(&unread, has_coefficients || !equations.is_empty(), &equations, &known);
        self.remarks(&header, &equations);
        if rows.is_empty() && self.log.is_clean() {
            self.fail(header.line, "no row below this header is a quantity".to_owned());
        }
        if !self.log.is_clean() {
            return None;
        }
        let measurand = match (&measured, &result) {
            (Some(name), _) => name.clone(),
            (None, Some(result)) if !result.name.is_empty() => result.name.clone(),
            _ => "y".to_owned(),
        };
        let taken = rows.iter().any(|row| row.name == measurand);
        let measurand = if taken { format!("{measurand}_result") } else { measurand };
        let unit = result.as_ref().map(|result| result.unit.clone()).unwrap_or_default();
        let made = if equations.is_empty() {
            let linear = self.linear(&header, &rows, result.as_ref(), &measurand)?;
            let formulas = [(measurand, linear.formula)];
            document(title, &rows, &formulas, &linear.unit, false)
        } else {
            let mut formulas: Vec<(String, String)> =
                equations.iter().map(|of| (of.name.clone(), of.formula.clone())).collect();
            if let Some((name, _)) = formulas.last_mut() {
                name.clone_from(&measurand);
            }
            for (name, formula) in &formulas {
                self.understood.push(format!("the equation {name} = {formula}"));
            }
            self.unused(&rows, &equations, &used);
            let unit =
                if unit.is_empty() { self.unit_of_equation(&rows, &equations) } else { unit };
            let model = |checked| document(title, &rows, &formulas, &unit, checked);
            let line = equations.last().map_or(0, |equation| equation.line);
            let made = self.checked((&rows, &stated), &unit, line, &model)?;
            self.of_numbers(made, &stated, &model)
        };
        self.compare(&made, &stated, factor)?;
        Some(made)
    }

    /// Refuses a sheet without estimates whose equation is no sum: of a product all sensitivities would be
    /// 0, and so would the result and its uncertainty.
    fn needs_estimates(&self, header: &Header, rows: &[Row], equations: &[Equation]) {
        let Some(equation) = equations.last() else { return };
        if rows.iter().any(|row| row.estimate.is_some()) || equation::is_linear(equations) {
            return;
        }
        let comma = self.cells.decimal_comma();
        let has_number = |place: &&usize| {
            let lines = header.line + 1..self.cells.lines();
            lines.into_iter().any(|line| value(self.cells.text(line, **place), comma).is_some())
        };
        let advice = match header.unknown.iter().find(has_number) {
            Some(place) => format!(
                "has the column `{}` them? Then head it `Estimate`",
                header.heading(*place).trim()
            ),
            None => "write them into a column `Estimate`".to_owned(),
        };
        let reason = format!(
            "the equation `{} = {}` needs the estimates of its quantities, and no column has them: {advice}",
            equation.name, equation.formula
        );
        self.fail(header.first, reason);
    }

    /// The names that the rows below the header would have in formulas.
    fn names(&self, header: &Header) -> Vec<String> {
        let lines = header.line + 1..self.cells.lines();
        let cells = lines.flat_map(|line| {
            [Column::Symbol, Column::Quantity].map(|column| header.cell(self.cells, line, column))
        });
        cells.map(columns::identifier).filter(|name| !name.is_empty()).collect()
    }

    /// Lines that are no part of the table and would change the result if they were.
    fn remarks(&mut self, header: &Header, equations: &[Equation]) {
        for line in 0..self.cells.lines() {
            if (header.first..=header.line).contains(&line)
                || equations.iter().any(|equation| equation.line == line)
            {
                continue;
            }
            let cells = self.cells.row(line).iter();
            let Some(cell) = cells.into_iter().find(|cell| columns::is_of_correlation(cell)) else {
                continue;
            };
            self.guessed.push(format!(
                "line {}: `{}` is not taken, and the quantities are independent without it: write names \
                 and coefficient into the model file, `\"correlations\": [[\"a\", \"b\", r]]`",
                line + 1,
                cell.trim()
            ));
        }
    }

    /// The usual unit of what the equations give; empty for a plain number or after a mistake.
    fn unit_of_equation(&mut self, rows: &[Row], equations: &[Equation]) -> String {
        let mut scope = Scope::new();
        for row in rows {
            let unit = Unit::parse(&row.unit).unwrap_or_default();
            scope.define(row.name.as_str(), Typing::in_unit(&unit));
        }
        let typing = Self::typing_of(equations, scope);
        let dimension = typing.and_then(|typing| typing.dimension).filter(|of| !of.is_none());
        let Some(unit) = dimension.map(|dimension| dimension.usual_unit()) else {
            return String::new();
        };
        let measurand = equations.last().map(|equation| equation.name.as_str()).unwrap_or_default();
        self.guessed.push(format!("the unit of {measurand} is not given: `{unit}` is taken"));
        unit
    }

    /// The model with a check of units where it passes; without it only where numbers in the units of
    /// the sheet give the same as those in SI units, or the estimate that the sheet states, and no two quantities
    /// of different dimension are added or compared; `line` is that of the equation.
    fn checked(
        &mut self,
        (rows, stated): (&[Row], &[Stated]),
        unit: &str,
        line: usize,
        model: &impl Fn(bool) -> String,
    ) -> Option<String> {
        let with = model(true);
        let Err(first) = read_text("the model", &with, Path::new(""), &[]) else {
            return Some(with);
        };
        let without = model(false);
        match read_text("the model", &without, Path::new(""), &[]) {
            Ok(_) => {
                let reason = first.0.first().map(|fault| fault.kind.to_string());
                let reason = reason.unwrap_or_default();
                if first.0.iter().any(|fault| is_of_two_quantities(&fault.kind)) {
                    self.fail(
                        line,
                        format!("the equation does not pass the check of units: {reason}"),
                    );
                    return None;
                }
                let units = rows.iter().map(|row| row.unit.as_str()).chain([unit]);
                let scaled = units.into_iter().find(|unit| {
                    Unit::parse(unit)
                        .is_ok_and(|unit| unit.factor() != 1.0 || unit.zero().is_some())
                });
                let is_stated = scaled.is_some() && stated::is_of_numbers(&without, stated);
                if let Some(scaled) = scaled.filter(|_| !is_stated) {
                    let text = format!(
                        "the equation does not pass the check of units, without which `{scaled}` would \
                         not be converted: {reason}"
                    );
                    self.fail(line, text);
                    return None;
                }
                self.guessed.push(format!(
                    "units are not checked, because the equation does not pass: {reason}"
                ));
                Some(without)
            }
            Err(faults) => {
                let reasons: Vec<String> =
                    faults.0.iter().take(5).map(|fault| fault.kind.to_string()).collect();
                self.fail(
                    line,
                    format!("the model of this budget has mistakes: {}", reasons.join("; ")),
                );
                None
            }
        }
    }
}

/// Whether a mistake is that two quantities of different dimension are added or compared; a bare number
/// beside one may be in its unit.
fn is_of_two_quantities(kind: &DiagnosticKind) -> bool {
    match kind {
        DiagnosticKind::Formula { error: FormulaError::MixedDimensions { operands, .. } } => {
            operands.iter().all(|operand| {
                let parsed = Formula::parse(&operand.text);
                parsed.map_or(true, |formula| formula.names().next().is_some())
            })
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests;
