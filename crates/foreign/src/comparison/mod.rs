//! Tables of results to be compared: two results a row, or one result a laboratory.

mod both;
mod branches;
mod check;
mod columns;
mod conditions;
mod correlations;
mod headings;
mod numbers;
mod party;
mod proficiency;
mod sheet;
mod stated;
mod study;
#[cfg(test)]
mod tests;

use std::collections::BTreeSet;
use std::path::Path;

use super::answer;
use check::TableKind;
use columns::Columns;
use gumption_analysis::compare::{Laboratory, Participant, ResultPair, StatedResult, StudyReading};
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};
use gumption_engine::task::Warning;
use gumption_files::open::no_table;
use gumption_text::text_table::{TextTable, alone};
use gumption_text::{Collector, DiagnosticKind, Diagnostics, Place, SourceText, bytes};
use gumption_units::Unit;
use headings::Role;
use numbers::{Number, Numbers};
pub use proficiency::{assigned_by, sigma_by};
use sheet::Content;
pub use study::limit_of;

/// A table that was read and found right.
#[derive(Clone, Debug, PartialEq)]
pub enum ComparisonTable {
    /// Two results a row: columns `label`, `x1`, `U1`, `x2`, `U2` and perhaps `k1`, `k2`, `r`.
    Pairs(Vec<ResultPair>),
    /// One result a laboratory: columns `label`, `x`, `U` and perhaps `k`.
    Laboratories {
        /// The laboratories, in order.
        laboratories: Vec<Laboratory>,
        /// Their correlation coefficients, row by row; empty where they are independent.
        correlations: Vec<Vec<f64>>,
    },
    /// The participants of a proficiency test, in order: columns `label`, `x` and perhaps `U`, `k`.
    Proficiency(Vec<Participant>),
    /// The readings of a gauge study, in order: columns `part`, `operator`, `value`.
    Gauge(Vec<StudyReading>),
}

/// A table, and what is worth knowing of how it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadComparison {
    /// The results.
    pub table: ComparisonTable,
    /// The unit of each row, in which it is compared; an empty text where none is stated. For a
    /// proficiency test that of all rows.
    pub units: Vec<String>,
    /// Columns that are not read, uncertainties that are shares, the sheet.
    pub warnings: Vec<Warning>,
}

/// What else is to be read.
#[derive(Clone, Copy, Debug, Default)]
pub struct ComparisonOptions<'a> {
    /// The JSON answer of a run whose results are the second ones.
    pub against: Option<&'a Path>,
    /// A table of correlation coefficients between laboratories.
    pub correlations: Option<&'a Path>,
    /// The sheet of a workbook; without it the one that is shown and holds a table of results.
    pub sheet: Option<&'a str>,
    /// Whether the results are those of a proficiency test.
    pub is_proficiency_test: bool,
    /// Whether the table is that of a gauge study.
    pub is_gauge_study: bool,
}

/// At most so many laboratories: their covariance matrix is decomposed again and again.
const MOST_LABORATORIES: usize = 200;

/// Reads and checks a table: a CSV file, or the sheet of an XLSX file that holds one.
///
/// # Errors
/// All mistakes of the table, in the order of their places.
pub fn read_comparison(
    path: &Path,
    options: ComparisonOptions<'_>,
) -> Result<ReadComparison, Diagnostics> {
    let name = path.display().to_string();
    let content = bytes::of_file(path, bytes::MOST)
        .map_err(|message| DiagnosticKind::Unreadable { message })
        .and_then(|bytes| sheet::results(path, bytes, options));
    match content {
        Ok(content) => read(&name, content, options),
        Err(kind) => {
            let log = Collector::new(SourceText::new(name, ""));
            log.report(&(0..0), kind);
            Err(log.into_diagnostics())
        }
    }
}

/// Reads and checks the text of a CSV table; `name` is used in messages.
///
/// # Errors
/// All mistakes of the table, in the order of their places.
pub fn read_comparison_text(
    name: &str,
    text: &str,
    options: ComparisonOptions<'_>,
) -> Result<ReadComparison, Diagnostics> {
    if let Some(sheet) = options.sheet {
        let log = Collector::new(SourceText::new(name, ""));
        let message = format!("it is no workbook (.xlsx), and so has no sheet `{sheet}`");
        log.report(&(0..0), DiagnosticKind::Unreadable { message });
        return Err(log.into_diagnostics());
    }
    read(name, Content { text: text.to_owned(), ..Content::default() }, options)
}

fn read(
    name: &str,
    content: Content,
    options: ComparisonOptions<'_>,
) -> Result<ReadComparison, Diagnostics> {
    let source = SourceText::new(name, &content.text);
    let log = Collector::new(source.clone());
    if let Some((place, kind)) = no_table(&source) {
        log.report(&place, kind);
        return log.finish(None);
    }
    let said = content.said.map(|fact| Warning::new("", fact));
    let mut warnings: Vec<Warning> = said.into_iter().collect();
    let table = TextTable::parse(&log, &source).and_then(|cells| {
        let numbers = Numbers::new(&log, &cells, content.sheet.as_ref());
        if options.is_gauge_study {
            let (readings, unit) = study::read(&numbers, &mut warnings)?;
            return Some((ComparisonTable::Gauge(readings), vec![unit]));
        }
        let answer = match options.against {
            Some(path) => Some(answer::read(&log, path)?),
            None => None,
        };
        let conditions: Vec<&str> = answer.iter().flat_map(|answer| answer.conditions()).collect();
        let run = answer.is_some().then_some(conditions.as_slice());
        let columns = Columns::of(&numbers, run, &mut warnings)?;
        if !numbers.has_known_mark(|place| columns.is_of_numbers(place)) {
            return None;
        }
        let is_of_pairs = columns.has(Role::Value(1));
        let (shares, units, moved) = (BTreeSet::new(), Vec::new(), Vec::new());
        let mut reader = ComparisonReader { numbers, columns, shares, units, moved, options };
        let table = if options.is_proficiency_test {
            reader.proficiency_test()
        } else if is_of_pairs {
            reader.pairs(answer.as_ref())
        } else {
            reader.laboratories()
        };
        warnings.extend(reader.relative());
        warnings.extend(reader.turned());
        Some((table?, reader.units))
    });
    log.finish(table.map(|(table, units)| ReadComparison { table, units, warnings }))
}

struct ComparisonReader<'a> {
    numbers: Numbers<'a>,
    columns: Columns,
    /// Units of uncertainties that were taken of the values.
    shares: BTreeSet<String>,
    /// The unit of each row that was read.
    units: Vec<String>,
    /// Angles that are compared on another branch, in words.
    moved: Vec<Fact>,
    options: ComparisonOptions<'a>,
}

/// Why a row of a reference value or a mean is refused in a table of laboratories: it would be averaged with them.
fn reference_or_laboratory(name: &str) -> String {
    format!(
        "`{name}` can be the value that the laboratories are compared with, or one of them: write the former \
         beside each result, in a table of pairs (label, x1, U1, x2, U2), and give the latter the name of \
         its laboratory"
    )
}

/// A result in the units of its cells.
struct InUnits {
    value: Number,
    uncertainty: Number,
    stated: StatedResult,
    /// The column of the uncertainty.
    column: usize,
    /// The unit of a run's output, also where the table has none.
    of_run: Option<String>,
}

impl ComparisonReader<'_> {
    fn fail(&self, reason: String) {
        self.fail_at(self.numbers.table.header(), reason);
    }

    fn fail_at(&self, place: Place, reason: String) {
        self.numbers.log.report_at(place, DiagnosticKind::Table { reason });
    }

    fn pairs(&mut self, answer: Option<&answer::Answer>) -> Option<ComparisonTable> {
        if let Some(path) = self.options.correlations {
            self.fail(format!(
                "`{}` is for a table of laboratories (label, x, U); a table of pairs has its \
                 coefficients in the column `r`",
                path.display()
            ));
        }
        let kind = if answer.is_some() { TableKind::AgainstRun } else { TableKind::Pairs };
        self.check_columns(kind)?;
        let second = [Role::Value(2), Role::Expanded(2), Role::Standard(2), Role::Factor(2)];
        if let (Some(_), Some(place)) =
            (answer, second.into_iter().find_map(|role| self.columns.place(role)))
        {
            let name = self.heading(place);
            self.fail(format!("the column `{name}` comes from the run; take it out"));
            return None;
        }
        let label = self.columns.place(Role::Label)?;
        let against = match answer {
            Some(answer) => Some((answer, self.conditions(answer)?)),
            None => None,
        };
        // whether the table has units, by its first result
        let mut has_units = None;
        let mut wanted = None;
        let mut pairs = Vec::new();
        for row in self.rows() {
            let Some(name) = self.label(row, label) else { continue };
            let first = self.stated(row, 1);
            let second = match &against {
                Some((answer, conditions)) => {
                    let own = first.as_ref().map(|first| first.value.unit.is_some());
                    let in_unit = own.map(|own| *has_units.get_or_insert(own));
                    let at = self.at(row, answer, conditions);
                    at.and_then(|at| self.of_answer(row, label, answer, &at, in_unit == Some(true)))
                }
                None => self.stated(row, 2),
            };
            let correlation = match self.columns.place(Role::Correlation) {
                Some(place) => self.numbers.bare(row, place),
                None => Some(0.0),
            };
            let (Some(first), Some(second), Some(correlation)) = (first, second, correlation)
            else {
                continue;
            };
            if !(-1.0..=1.0).contains(&correlation) {
                let range = "from -1 to 1";
                let kind =
                    DiagnosticKind::OutOfRange { key: "r".into(), found: correlation, range };
                let place = self.columns.place(Role::Correlation).unwrap_or(label);
                self.numbers.log.report_at(self.numbers.table.place(row, place), kind);
                continue;
            }
            // with a run in the unit of its output, else in that of the first value
            let unit = if answer.is_some() { &second } else { &first }.value.unit.clone();
            let unit: Option<Unit> =
                if answer.is_some() { unit } else { wanted.get_or_insert(unit).clone() };
            let column = first.column;
            let of_run = second.of_run.clone();
            let both = [first, second].map(|result| self.converted(row, result, unit.as_ref()));
            let [Some(mut first), Some(mut second)] = both else { continue };
            let mut named = [(name.clone(), &mut first), (format!("{name}, second"), &mut second)];
            if let Err(reason) = self.on_one_branch(&mut named, unit.as_ref()) {
                self.fail_at(self.numbers.table.place(row, label), reason);
                continue;
            }
            let pair = ResultPair { label: name, results: [first, second], correlation };
            if pair.compare().is_none() {
                let reason = "the difference has no uncertainty, so nothing can be compared";
                self.fail_at(self.numbers.table.place(row, column), reason.to_owned());
            }
            self.units.push(unit.map(|unit| unit.to_string()).or(of_run).unwrap_or_default());
            pairs.push(pair);
        }
        Some(ComparisonTable::Pairs(pairs))
    }

    fn laboratories(&mut self) -> Option<ComparisonTable> {
        if let Some(path) = self.options.against {
            self.fail(format!(
                "`{}` is to be compared with a table with the columns label, x1, U1",
                path.display()
            ));
            return None;
        }
        self.check_columns(TableKind::Laboratories)?;
        let count = self.numbers.table.rows();
        if count > MOST_LABORATORIES {
            let kind = DiagnosticKind::TooMany {
                what: "laboratories",
                found: count,
                most: MOST_LABORATORIES,
            };
            self.numbers.log.report_at(self.numbers.table.header(), kind);
            return None;
        }
        let label = self.columns.place(Role::Label)?;
        let mut wanted = None;
        let mut laboratories: Vec<Laboratory> = Vec::new();
        for row in self.rows() {
            let Some(name) = self.label(row, label) else { continue };
            if headings::is_reference(&name) {
                self.fail_at(self.numbers.table.place(row, label), reference_or_laboratory(&name));
                continue;
            }
            if self.is_without_result(row, &name) {
                continue;
            }
            let Some(result) = self.stated(row, 0) else { continue };
            let place = self.numbers.table.place(row, result.column);
            let unit: Option<Unit> = wanted.get_or_insert(result.value.unit.clone()).clone();
            let Some(result) = self.converted(row, result, unit.as_ref()) else { continue };
            if result.expanded == 0.0 {
                let kind = DiagnosticKind::NotPositive { key: "U".into(), found: 0.0 };
                self.numbers.log.report_at(place, kind);
            }
            if laboratories.iter().any(|other| other.label == name) {
                let reason = format!("the laboratory `{name}` stands here a second time");
                self.fail_at(self.numbers.table.place(row, label), reason);
            }
            self.units.push(unit.map(|unit| unit.to_string()).unwrap_or_default());
            laboratories.push(Laboratory { label: name, result });
        }
        let unit = wanted.flatten();
        let named = laboratories
            .iter_mut()
            .map(|laboratory| (laboratory.label.clone(), &mut laboratory.result));
        let mut named: Vec<branches::Named<'_>> = named.collect();
        if let Err(reason) = self.on_one_branch(&mut named, unit.as_ref()) {
            self.fail(reason);
        }
        if count < 2 {
            self.fail("a comparison needs at least two laboratories".to_owned());
        }
        let correlations = match self.options.correlations {
            Some(path) => {
                let labels: Vec<&str> =
                    laboratories.iter().map(|laboratory| laboratory.label.as_str()).collect();
                correlations::read(self.numbers.log, path, &labels)?
            }
            None => Vec::new(),
        };
        Some(ComparisonTable::Laboratories { laboratories, correlations })
    }

    /// The heading of a column, as it stands there.
    fn heading(&self, place: usize) -> &str {
        self.numbers.table.columns().get(place).map_or("", String::as_str)
    }

    /// The rows with a cell for each column; the others are mistakes already.
    fn rows(&self) -> Vec<usize> {
        let table = self.numbers.table;
        (0..table.rows()).filter(|row| table.is_whole(*row)).collect()
    }

    /// The label of a row; a row without one is a mistake.
    fn label(&self, row: usize, place: usize) -> Option<String> {
        let name = self.numbers.name(row, place).trim();
        if name.is_empty() {
            let reason = format!(
                "row {}: `{}` is empty; every result has a name",
                row + 1,
                self.heading(place)
            );
            self.fail_at(self.numbers.table.place(row, place), reason);
            return None;
        }
        Some(name.to_owned())
    }

    /// Whether a row has neither a value nor an uncertainty, which is a mistake: a laboratory that has not
    /// measured, or a footnote.
    fn is_without_result(&self, row: usize, name: &str) -> bool {
        let roles = [Role::Value(0), Role::Expanded(0), Role::Standard(0)];
        let mut places = roles.into_iter().filter_map(|role| self.columns.place(role));
        if !places.all(|place| self.numbers.is_empty(row, place)) {
            return false;
        }
        let table = self.numbers.table;
        let held = (0..table.columns().len()).filter(|place| !table.text(row, *place).is_empty());
        let reason = if held.count() < 2 {
            alone(name)
        } else {
            format!("`{name}` has no result: remove the row, or begin it with `#`")
        };
        self.fail_at(table.place(row, self.columns.place(Role::Label).unwrap_or(0)), reason);
        true
    }

    /// That uncertainties are shares of the values.
    fn relative(&self) -> Option<Warning> {
        let units: Vec<Fact> = self.shares.iter().map(|name| fact!("quoted", name)).collect();
        let fact = |units| fact!("relative-uncertainties", units = Argument::all_of(units));
        (!units.is_empty()).then(|| Warning::new("", fact(units)))
    }

    /// That angles are compared on another branch than the one they are written on.
    fn turned(&self) -> Option<Warning> {
        const MOST: usize = 5;
        let mut moved: Vec<Fact> = self.moved.iter().take(MOST).cloned().collect();
        if self.moved.len() > MOST {
            moved.push(fact!("more", count = self.moved.len() - MOST));
        }
        let fact = |moved| fact!("angle-branch", angles = Argument::all_of(moved));
        (!moved.is_empty()).then(|| Warning::new("", fact(moved)))
    }

    /// The run's result for a row: the output of that label, at the conditions of the row; with its unit
    /// where the table has units.
    fn of_answer(
        &self,
        row: usize,
        label: usize,
        answer: &answer::Answer,
        at: &[(&str, f64)],
        in_unit: bool,
    ) -> Option<InUnits> {
        let found = answer.result(self.numbers.name(row, label), at);
        let found = found.and_then(|(stated, unit)| {
            let own = in_unit.then(|| self.numbers.log.unit(unit)).transpose();
            Ok((stated, own.map_err(|error| error.to_string())?, Some(unit.to_owned())))
        });
        let (stated, unit, of_run) = found
            .map_err(|reason| self.fail_at(self.numbers.table.place(row, label), reason))
            .ok()?;
        let number =
            |value: f64| Number { value, printed: value, half_unit: 0.0, unit: unit.clone() };
        let (value, uncertainty) = (number(stated.value), number(stated.expanded));
        Some(InUnits { value, uncertainty, stated, column: label, of_run })
    }
}
