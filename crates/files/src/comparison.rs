//! Tables of results to be compared: two results a row, or one result a laboratory.

use std::borrow::Cow;
use std::cell::{Cell, RefCell};
use std::path::Path;

use super::diagnostics::{Collector, Diagnostics};
use super::open::{no_table, open_as};
use super::separator::DecimalMarks;
use super::source::{Place, SourceText};
use super::text_table::TextTable;
use super::{DiagnosticKind, answer, bytes, column_heading, table, workbook};
use gumption_analysis::compare::{Laboratory, ResultPair, StatedResult};
use gumption_units::{IncompatibleUnits, Unit};

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
}

/// What else is to be read.
#[derive(Clone, Copy, Debug, Default)]
pub struct ComparisonOptions<'a> {
    /// The JSON answer of a run whose results are the second ones.
    pub against: Option<&'a Path>,
    /// A table of correlation coefficients between laboratories.
    pub correlations: Option<&'a Path>,
}

const OF_PAIRS: [&str; 8] = ["label", "x1", "U1", "x2", "U2", "k1", "k2", "r"];
const OF_LABORATORIES: [&str; 4] = ["label", "x", "U", "k"];

/// Coverage factor of a stated uncertainty unless the table has another.
const USUAL_FACTOR: f64 = 2.0;

/// At most so many laboratories: their covariance matrix is decomposed again and again.
const MOST_LABORATORIES: usize = 200;

/// Reads and checks a table: a CSV file, or the first sheet of an XLSX file.
///
/// # Errors
/// All mistakes of the table, in the order of their places.
pub fn read_comparison(
    path: &Path,
    options: ComparisonOptions<'_>,
) -> Result<ComparisonTable, Diagnostics> {
    open_as(
        path,
        |bytes| text_of(path, bytes),
        |name, text, _| read_comparison_text(name, text, options),
    )
}

/// Reads and checks the text of a CSV table; `name` is used in messages.
///
/// # Errors
/// All mistakes of the table, in the order of their places.
pub fn read_comparison_text(
    name: &str,
    text: &str,
    options: ComparisonOptions<'_>,
) -> Result<ComparisonTable, Diagnostics> {
    let source = SourceText::new(name, text);
    let log = Collector::new(source.clone());
    if let Some((place, kind)) = no_table(&source) {
        log.report(&place, kind);
        return log.finish(None);
    }
    let table = TextTable::parse(&log, &source).and_then(|cells| {
        let marks = RefCell::new(cells.marks());
        let units = column_units(&log, &cells)?;
        let reader =
            Reader { log: &log, cells: &cells, units, marks, mixed: Cell::new(false), options };
        if cells.column("x1").is_some() { reader.pairs() } else { reader.laboratories() }
    });
    log.finish(table)
}

/// The text of a table; the first sheet of a workbook as CSV, line by line.
fn text_of(path: &Path, bytes: Vec<u8>) -> Result<String, String> {
    let is_workbook =
        path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("xlsx"));
    if is_workbook {
        return workbook::first_sheet(bytes);
    }
    bytes::text(&bytes).map(Cow::into_owned)
}

/// Columns of values and of expanded uncertainties.
const VALUES: [&str; 3] = ["x", "x1", "x2"];
const UNCERTAINTIES: [&str; 3] = ["U", "U1", "U2"];

/// The units that the headings of values and uncertainties state, `x1 [V]` and `U1 [mV]`; empty where
/// they state none. Mistakes are reported.
fn column_units(log: &Collector, cells: &TextTable) -> Option<Vec<(&'static str, Unit)>> {
    let mut units: Vec<(&'static str, Unit)> = Vec::new();
    let mut without = None;
    for name in VALUES.into_iter().chain(UNCERTAINTIES) {
        let Some(place) = cells.column(name) else { continue };
        let heading = &cells.columns()[place];
        let fail = |reason: String| log.report_at(cells.header(), DiagnosticKind::Table { reason });
        match column_heading::named(heading).map(|(_, unit)| (unit, log.unit(unit))) {
            None => without = Some(name),
            Some((text, Err(_))) if text.replace(' ', "").starts_with("k=") => {
                fail(format!(
                    "`{heading}`: coverage factors stand in a column of their own, `k` (of pairs `k1` \
                     and `k2`), and are 2 where there is none"
                ));
                return None;
            }
            Some((text, Err(error))) => {
                fail(format!("`{heading}`: `{text}` is no unit: {error}"));
                return None;
            }
            Some((_, Ok(unit))) => {
                if let Some((other, first)) = units.first()
                    && !first.is_compatible(&unit)
                {
                    let first = first.text();
                    fail(format!(
                        "`{heading}` cannot be converted to `{first}`, the unit of `{other}`; write \
                         values and expanded uncertainties in units of one quantity"
                    ));
                    return None;
                }
                units.push((name, unit));
            }
        }
    }
    if let (Some((with, unit)), Some(without)) = (units.first(), without) {
        let reason = format!(
            "the column `{with}` has the unit `{}` and `{without}` none; write units into the \
             headings of all values and uncertainties, or of none",
            unit.text()
        );
        log.report_at(cells.header(), DiagnosticKind::Table { reason });
        return None;
    }
    Some(units)
}

struct Reader<'a> {
    log: &'a Collector,
    cells: &'a TextTable,
    /// The units of columns; empty where the headings have none.
    units: Vec<(&'static str, Unit)>,
    marks: RefCell<DecimalMarks>,
    /// Whether the numbers have two decimal marks, which was said.
    mixed: Cell<bool>,
    options: ComparisonOptions<'a>,
}

impl Reader<'_> {
    fn pairs(&self) -> Option<ComparisonTable> {
        if let Some(path) = self.options.correlations {
            let reason = format!(
                "`{}` is for a table of laboratories (label, x, U); a table of pairs has its \
                 coefficients in the column `r`",
                path.display()
            );
            self.log.report_at(self.cells.header(), DiagnosticKind::Table { reason });
        }
        let answer = match self.options.against {
            Some(path) => Some(answer::read(self.log, path)?),
            None => None,
        };
        let conditions: Vec<&str> = answer.iter().flat_map(|answer| answer.conditions()).collect();
        let required: &[&str] = if answer.is_some() { &OF_PAIRS[..3] } else { &OF_PAIRS[..5] };
        self.check_columns(required, &OF_PAIRS, &conditions)?;
        if let (Some(_), Some(place)) =
            (&answer, ["x2", "U2", "k2"].iter().find(|name| self.cells.column(name).is_some()))
        {
            let reason = format!("the column `{place}` comes from the run; take it out");
            self.log.report_at(self.cells.header(), DiagnosticKind::Table { reason });
            return None;
        }
        let mut pairs = Vec::new();
        for row in self.rows() {
            let (second, unit) = match &answer {
                None => {
                    let unit = self.unit("x1").cloned();
                    (self.stated(row, ["x2", "U2", "k2"], unit.as_ref()), unit)
                }
                Some(answer) => {
                    let Some((result, unit)) = self.of_answer(row, answer, &conditions) else {
                        continue;
                    };
                    (Some(result), unit)
                }
            };
            let first = self.stated(row, ["x1", "U1", "k1"], unit.as_ref());
            let correlation = self.number(row, "r").unwrap_or(Some(0.0));
            let (Some(first), Some(second), Some(correlation)) = (first, second, correlation)
            else {
                continue;
            };
            if !(-1.0..=1.0).contains(&correlation) {
                let range = "from -1 to 1";
                let diagnostic =
                    DiagnosticKind::OutOfRange { key: "r".into(), found: correlation, range };
                self.log.report_at(self.place(row, "r"), diagnostic);
                continue;
            }
            let label = self.cells.text(row, "label").to_owned();
            let pair = ResultPair { label, results: [first, second], correlation };
            if pair.compare().is_none() {
                let reason = "the difference has no uncertainty, so nothing can be compared";
                self.log.report_at(
                    self.place(row, "U1"),
                    DiagnosticKind::Table { reason: reason.into() },
                );
            }
            pairs.push(pair);
        }
        Some(ComparisonTable::Pairs(pairs))
    }

    fn laboratories(&self) -> Option<ComparisonTable> {
        if let Some(path) = self.options.against {
            let reason = format!(
                "`{}` is to be compared with a table with the columns label, x1, U1",
                path.display()
            );
            self.log.report_at(self.cells.header(), DiagnosticKind::Table { reason });
            return None;
        }
        self.check_columns(&OF_LABORATORIES[..3], &OF_LABORATORIES, &[])?;
        let count = self.cells.rows();
        if count > MOST_LABORATORIES {
            let diagnostic = DiagnosticKind::TooMany {
                what: "laboratories",
                found: count,
                most: MOST_LABORATORIES,
            };
            self.log.report_at(self.cells.header(), diagnostic);
            return None;
        }
        let mut laboratories: Vec<Laboratory> = Vec::new();
        for row in self.rows() {
            let Some(result) = self.stated(row, ["x", "U", "k"], self.unit("x")) else {
                continue;
            };
            if result.expanded == 0.0 {
                let diagnostic = DiagnosticKind::NotPositive { key: "U".into(), found: 0.0 };
                self.log.report_at(self.place(row, "U"), diagnostic);
            }
            let label = self.cells.text(row, "label").to_owned();
            if laboratories.iter().any(|other| other.label == label) {
                let reason = format!("the laboratory `{label}` stands here a second time");
                self.log.report_at(self.place(row, "label"), DiagnosticKind::Table { reason });
            }
            laboratories.push(Laboratory { label, result });
        }
        if count < 2 {
            let reason = "a comparison needs at least two laboratories".to_owned();
            self.log.report_at(self.cells.header(), DiagnosticKind::Table { reason });
        }
        let correlations = match self.options.correlations {
            Some(path) => self.correlations(path, &laboratories)?,
            None => Vec::new(),
        };
        Some(ComparisonTable::Laboratories { laboratories, correlations })
    }

    /// A matrix of coefficients in the order of the laboratories: a header of their names, then
    /// the rows in that order.
    fn correlations(&self, path: &Path, all: &[Laboratory]) -> Option<Vec<Vec<f64>>> {
        let name = path.display().to_string();
        let text = bytes::of_file(path, bytes::MOST).and_then(|bytes| text_of(path, bytes));
        let source = SourceText::new(name.clone(), text.as_deref().unwrap_or(""));
        let whole = || Place { source: source.clone(), span: 0..0 };
        if let Err(message) = text {
            self.log.report_at(whole(), DiagnosticKind::Unreadable { message });
            return None;
        }
        let matrix = match table::parse(&source) {
            Ok(matrix) => matrix,
            Err(kinds) => {
                kinds
                    .into_iter()
                    .for_each(|(place, diagnostic)| self.log.report_at(place, diagnostic));
                return None;
            }
        };
        let places: Vec<Option<usize>> = all
            .iter()
            .map(|laboratory| matrix.columns.iter().position(|name| *name == laboratory.label))
            .collect();
        let square = matrix.rows.len() == matrix.columns.len() && all.len() == matrix.columns.len();
        let Some(places) = places.into_iter().collect::<Option<Vec<usize>>>().filter(|_| square)
        else {
            let reason = format!(
                "a matrix of correlation coefficients has a header with the names of all {} \
                 laboratories, and as many rows in that order",
                all.len()
            );
            self.log.report_at(whole(), DiagnosticKind::Table { reason });
            return None;
        };
        let at = |i: usize, j: usize| matrix.rows[i][j];
        for (i, j) in (0..places.len()).flat_map(|i| (0..=i).map(move |j| (i, j))) {
            let (r, other) = (at(i, j), at(j, i));
            if r != other || !(-1.0..=1.0).contains(&r) || (i == j && r != 1.0) {
                let reason =
                    "the coefficients must be symmetric, from -1 to 1, and 1 on the diagonal";
                self.log
                    .report_at(matrix.place(i, j), DiagnosticKind::Table { reason: reason.into() });
                return None;
            }
        }
        Some(places.iter().map(|&i| places.iter().map(|&j| at(i, j)).collect()).collect())
    }

    fn check_columns(&self, required: &[&str], known: &[&str], more: &[&str]) -> Option<()> {
        let list = |names: &[&str]| names.join(", ");
        let missing: Vec<&str> =
            required.iter().copied().filter(|name| self.cells.column(name).is_none()).collect();
        if !missing.is_empty() {
            let reason = format!(
                "the table has no column {}; a table of pairs has {} (and perhaps k1, k2, r), one of \
                 laboratories {} (and perhaps k)",
                list(&missing),
                list(&OF_PAIRS[..5]),
                list(&OF_LABORATORIES[..3])
            );
            self.log.report_at(self.cells.header(), DiagnosticKind::Table { reason });
            return None;
        }
        let is_known = |name: &str| known.contains(&name) || more.contains(&name);
        let has_unit = |name: &str| {
            let bare = column_heading::bare(name);
            VALUES.contains(&bare) || UNCERTAINTIES.contains(&bare)
        };
        let unknown = |name: &&String| {
            let bare = if has_unit(name) { column_heading::bare(name) } else { name.as_str() };
            !is_known(bare)
        };
        let unknown: Vec<&String> = self.cells.columns().iter().filter(unknown).collect();
        for name in &unknown {
            let reason = format!(
                "the column `{name}` is not known; there are {}",
                list(&[known, more].concat())
            );
            self.log.report_at(self.cells.header(), DiagnosticKind::Table { reason });
        }
        unknown.is_empty().then_some(())
    }

    /// The rows with a cell for each column; the others are mistakes already.
    fn rows(&self) -> impl Iterator<Item = usize> {
        (0..self.cells.rows()).filter(|row| self.cells.is_whole(*row))
    }

    fn place(&self, row: usize, column: &str) -> Place {
        self.cells.place(row, column)
    }

    /// The number in a cell: `None` where there is no such column, `Some(None)` after a mistake.
    fn number(&self, row: usize, column: &str) -> Option<Option<f64>> {
        self.cells.column(column)?;
        let text = match self.marks.borrow_mut().with_point(self.cells.text(row, column)) {
            Ok(text) => text,
            Err(reason) => {
                // of all cells that follow it would be said again
                if !self.mixed.replace(true) {
                    let place = self.place(row, column);
                    self.log.report_at(place, DiagnosticKind::Table { reason });
                }
                return Some(None);
            }
        };
        let value = text.parse::<f64>().ok().filter(|value| value.is_finite());
        if value.is_none() {
            let (column, found) = (column.to_owned(), self.cells.text(row, column).to_owned());
            let place = self.place(row, &column);
            self.log.report_at(place, DiagnosticKind::Cell { row: row + 1, column, found });
        }
        Some(value)
    }

    /// The unit of a column; `None` where no heading has one.
    fn unit(&self, column: &str) -> Option<&Unit> {
        self.units.iter().find(|(name, _)| *name == column).map(|(_, unit)| unit)
    }

    /// A stated result of a row, in that unit where there are units.
    fn stated(
        &self,
        row: usize,
        [x, u, k]: [&str; 3],
        wanted: Option<&Unit>,
    ) -> Option<StatedResult> {
        let (value, expanded) = (self.number(row, x)?, self.number(row, u)?);
        let factor = self.number(row, k).unwrap_or(Some(USUAL_FACTOR));
        let (value, expanded, factor) = (value?, expanded?, factor?);
        if expanded < 0.0 {
            let range = "at least 0";
            let diagnostic =
                DiagnosticKind::OutOfRange { key: u.to_owned(), found: expanded, range };
            self.log.report_at(self.place(row, u), diagnostic);
        }
        if factor <= 0.0 {
            let diagnostic = DiagnosticKind::NotPositive { key: k.to_owned(), found: factor };
            self.log.report_at(self.place(row, k), diagnostic);
        }
        if expanded < 0.0 || factor <= 0.0 {
            return None;
        }
        let rounding =
            [x, u].map(|column| half_unit(&self.cells.text(row, column).replace(',', ".")));
        let stated = StatedResult { value, expanded, factor, rounding };
        let (Some(wanted), Some(of_x), Some(of_u)) = (wanted, self.unit(x), self.unit(u)) else {
            return Some(stated);
        };
        let converted = || -> Result<StatedResult, IncompatibleUnits> {
            let by_x = Unit::conversion_factor(of_x, wanted)?;
            let by_u = Unit::conversion_factor(of_u, wanted)?;
            Ok(StatedResult {
                value: Unit::convert(value, of_x, wanted)?,
                expanded: expanded * by_u,
                factor,
                rounding: [rounding[0] * by_x, rounding[1] * by_u],
            })
        };
        converted()
            .map_err(|error| {
                let reason = error.to_string();
                self.log.report_at(self.place(row, x), DiagnosticKind::Table { reason });
            })
            .ok()
    }

    /// The run's result for a row: the output of that label, at the conditions of the row; with its unit
    /// where the table has units.
    fn of_answer(
        &self,
        row: usize,
        answer: &answer::Answer,
        conditions: &[&str],
    ) -> Option<(StatedResult, Option<Unit>)> {
        let at: Vec<(&str, f64)> =
            conditions.iter().filter_map(|name| Some((*name, self.number(row, name)??))).collect();
        let found = answer.result(self.cells.text(row, "label"), &at);
        let found = found.and_then(|(stated, unit)| {
            let unit = (!self.units.is_empty()).then(|| self.log.unit(unit)).transpose();
            Ok((stated, unit.map_err(|error| error.to_string())?))
        });
        found
            .map_err(|reason| {
                self.log.report_at(self.place(row, "label"), DiagnosticKind::Table { reason });
            })
            .ok()
    }
}

/// Half a unit of the last printed digit of a number.
fn half_unit(text: &str) -> f64 {
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().unwrap_or(0)),
        None => (text, 0),
    };
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.trim().len() as i32);
    // from its decimal form, which is the nearest number
    format!("5e{}", exponent - decimals - 1).parse().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<ComparisonTable, Diagnostics> {
        read_comparison_text("t.csv", text, ComparisonOptions::default())
    }

    #[test]
    fn half_units_of_printed_digits() {
        for (text, half) in
            [("423", 0.5), ("0.010", 0.0005), ("1.50e-3", 5e-6), ("-7.", 0.5), ("2e4", 5e3)]
        {
            assert_eq!(half_unit(text), half, "{text}");
        }
    }

    #[test]
    fn pairs_with_and_without_factors() {
        let text = "label;x1;U1;x2;U2;k2\n\"a; b\";1,50;0,2;1,6;0,3;3\n# note\nc;1;0;2;1;2\n";
        let Ok(ComparisonTable::Pairs(pairs)) = read(text) else { panic!() };
        assert_eq!((pairs.len(), pairs[0].label.as_str()), (2, "a; b"));
        let [a, b] = pairs[0].results;
        assert_eq!((a.value, a.factor, a.rounding), (1.5, 2.0, [0.005, 0.05]));
        assert_eq!((b.factor, b.rounding), (3.0, [0.05, 0.05]));
    }

    /// 10.012 V and 10 011.5 mV differ by 0.5 mV; the last digits are worth 0.5 mV, 0.05 mV and 5 uV.
    #[test]
    fn units_stand_in_headings() {
        let text = "label,x1 [V],U1 [mV],x2 [mV],U2 / mV,k1\na,10.012,0.4,10011.5,0.30,2\n";
        let Ok(ComparisonTable::Pairs(pairs)) = read(text) else { panic!() };
        let [a, b] = pairs[0].results;
        let near = |found: f64, wanted: f64| (found / wanted - 1.0).abs() < 1e-12;
        assert!((a.value - b.value - 5e-4).abs() < 1e-14);
        assert!(near(a.expanded, 4e-4) && near(b.expanded, 3e-4));
        assert!(near(a.rounding[0], 5e-4) && near(a.rounding[1], 5e-5));
        assert!(near(b.rounding[0], 5e-5) && near(b.rounding[1], 5e-6));
        // differences of temperatures have no zero
        let text = "label;x (degC);U (K)\na;20,1;0,2\nb;20,3;0,1\n";
        let Ok(ComparisonTable::Laboratories { laboratories, .. }) = read(text) else { panic!() };
        assert_eq!((laboratories[0].result.value, laboratories[0].result.expanded), (20.1, 0.2));
    }

    /// Rows that are too short or too long hide nothing of the others, and neither does a first bad
    /// cell.
    #[test]
    fn all_mistakes_are_told_at_once() {
        let text =
            "label,x1,U1,x2,U2,k1\na,1,,2,1,2\nb,1,1\nc,x,1,2,-1,0\nd,1,1,2,1,2,9\ne,1,-1,2,1,0\n";
        let said = read(text).unwrap_err().to_string();
        let places: Vec<String> = said
            .lines()
            .filter_map(|line| Some(line.strip_prefix("t.csv:")?.split(": ").next()?.to_owned()))
            .collect();
        assert_eq!(places, ["2:4", "3:1", "4:3", "4:9", "5:1", "6:5", "6:12"], "{said}");
        let said = read("label;x;U\na;z;1\nb;1,5;0.1\nc;1,5;0.1\n").unwrap_err().to_string();
        assert!(said.contains("`z`") && said.matches("one table").count() == 1, "{said}");
        let said = read("label,x,U,K,n\na,1,1,1,1\nb,1,1,1,1\n").unwrap_err().to_string();
        assert!(said.contains("`K` is not known") && said.contains("`n` is not known"), "{said}");
    }

    #[test]
    fn mistakes_have_places() {
        let said = |text: &str| read(text).unwrap_err().to_string();
        let cases = [
            ("label,x1,U1,x2,U2\na,1,,2,1\nb,1,1,x,1\n", "t.csv:2:4:"),
            ("label,x1,U1,x2,U2\na,1,-1,2,1\n", "at least 0"),
            ("label,x1,U1,x2,U2\na,1,0,2,0\n", "no uncertainty"),
            ("label,x1,U1,x2,U2,r\na,1,1,2,1,2\n", "from -1 to 1"),
            ("label,x1,U1,x2\na,1,1,2\n", "no column U2"),
            ("label,x1,U1,x2,U2,K1\na,1,1,2,1,2\n", "`K1` is not known"),
            ("label,x [V],U\na,1,1\nb,1,1\n", "has the unit `V` and `U` none"),
            ("label,x [V],U [%]\na,1,1\nb,1,1\n", "`U [%]` cannot be converted to `V`"),
            ("label,x [V],U [Vv]\na,1,1\nb,1,1\n", "`Vv` is no unit"),
            ("label,x,U (k=2)\na,1,1\nb,1,1\n", "stand in a column of their own, `k`"),
            ("label,x,U\na,1,1\n", "at least two laboratories"),
            ("label,x,U\na,1,1\na,2,1\n", "a second time"),
            ("label,x,U\na,1,0\nb,2,1\n", "t.csv:2:5:"),
            ("label,x,U\na,1\n", "t.csv:2:1:"),
            ("", "the table is empty"),
        ];
        for (text, expected) in cases {
            let found = said(text);
            assert!(found.contains(expected), "{text:?}: {found}");
        }
        assert_eq!(said("label,x1,U1,x2,U2\na,1,,2,1\nb,1,1,x,1\n").lines().count(), 2);
    }
}
