//! Readings that replace those of a model: columns with the names of inputs, a line for each reading.
//!
//! Columns with the names of conditions say to which point a line belongs.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;

use super::conditions::{Conditions, is_same};
use super::input_set::InputSet;
use super::overrides::Override;
use super::readings::FileReadings;
use super::readings_file::NewReadings;
use gumption_columns::separator::DecimalMarks;
use gumption_engine::fact;
use gumption_engine::model::Quantity;
use gumption_engine::number::Shortest;
use gumption_engine::task::{Sharing, Warning};
use gumption_text::text_table::TextTable;
use gumption_text::value_text::ValueOf;
use gumption_text::{Collector, DiagnosticKind, Place, column_heading};
use gumption_units::{Unit, listed, nearest};

/// At most so many names are listed in a message.
const MOST_NAMES: usize = 12;

/// A column, by its heading.
#[derive(Debug)]
struct ReadingColumn {
    index: usize,
    heading: String,
    /// The heading without the name of a model file.
    text: String,
    name: String,
    /// `None` where the heading has no unit.
    unit: Option<Unit>,
    is_taken: Cell<bool>,
}

/// How numbers of a column come to a unit of the model.
#[derive(Clone, Copy, Debug)]
struct Conversion<'u> {
    /// The unit of the column where it is another one.
    own: Option<&'u Unit>,
    unit: &'u Unit,
}

impl Conversion<'_> {
    /// The value in the model's unit, with the zeros of both scales.
    fn of(&self, number: f64) -> f64 {
        let converted = self.own.map(|own| Unit::convert(number, own, self.unit));
        // that there is a conversion was found out before
        converted.and_then(Result::ok).unwrap_or(number)
    }
}

/// The rows of the model's conditions that a line belongs to.
#[derive(Debug)]
struct Point {
    rows: Vec<usize>,
    lines: Vec<usize>,
    /// Its conditions with their values, in words; empty of all rows.
    name: String,
}

/// The columns of a file, read for one model.
#[derive(Debug)]
pub(super) struct ReadingColumns<'a> {
    log: &'a Collector,
    new: NewReadings<'a>,
    table: &'a TextTable,
    columns: Vec<ReadingColumn>,
    conditions: Vec<ReadingColumn>,
    marks: RefCell<DecimalMarks>,
    points: Vec<Point>,
    /// The number of the model's rows.
    rows: usize,
    /// The rows that share a value where points differ.
    sharing: Option<Sharing>,
    /// The names of the model's conditions.
    known: Vec<String>,
}

impl<'a> ReadingColumns<'a> {
    /// Reads the headings, and which lines belong to which rows of the conditions.
    pub(super) fn read(
        log: &'a Collector,
        new: NewReadings<'a>,
        conditions: &Conditions,
    ) -> Option<Self> {
        if conditions.unreadable {
            return None;
        }
        let table = &new.file.table;
        let mut of_conditions = Vec::new();
        let mut columns: Vec<ReadingColumn> = Vec::new();
        for (index, heading) in table.columns().iter().enumerate() {
            let Some(column) = column(log, table, new.model, index, heading) else { continue };
            let mut all = of_conditions.iter().chain(&columns);
            if let Some(first) = all.find(|other: &&ReadingColumn| other.name == column.name) {
                let reason = format!(
                    "the columns `{}` and `{heading}` both are `{}`",
                    first.heading, column.name
                );
                log.report_at(table.header(), DiagnosticKind::Table { reason });
                return None;
            }
            match conditions.quantities.iter().any(|condition| condition.name == column.name) {
                true => of_conditions.push(column),
                false => columns.push(column),
            }
        }
        let marks = RefCell::new(DecimalMarks::of(table.separator()));
        let mut read = Self {
            log,
            new,
            table,
            columns,
            conditions: of_conditions,
            marks,
            points: Vec::new(),
            rows: conditions.rows.len(),
            sharing: None,
            known: conditions.quantities.iter().map(|condition| condition.name.clone()).collect(),
        };
        read.points = read.points_of(conditions)?;
        read.sharing = read.sharing_of(conditions)?;
        Some(read)
    }

    /// The points of the lines, in the order of the rows; all lines are one point where no column is a
    /// condition.
    fn points_of(&self, conditions: &Conditions) -> Option<Vec<Point>> {
        let lines = 0..self.table.rows();
        if self.conditions.is_empty() {
            let point = Point {
                rows: (0..self.rows).collect(),
                lines: lines.collect(),
                name: String::new(),
            };
            return Some(vec![point]);
        }
        let quantities = &conditions.quantities;
        let places: Vec<usize> = self
            .conditions
            .iter()
            .filter_map(|column| quantities.iter().position(|of| of.name == column.name))
            .collect();
        let mut points: Vec<Point> = Vec::new();
        let mut known: HashMap<Vec<u64>, usize> = HashMap::new();
        for (row, values) in conditions.rows.iter().enumerate() {
            let exact: Vec<u64> = places.iter().map(|at| values[*at].to_bits()).collect();
            let same = |point: &Point| {
                let first = point.rows.first().and_then(|first| conditions.rows.get(*first));
                first.is_some_and(|first| places.iter().all(|at| is_same(first[*at], values[*at])))
            };
            let own = known.get(&exact).copied().or_else(|| points.iter().position(same));
            let own = own.unwrap_or(points.len());
            known.insert(exact, own);
            if let Some(point) = points.get_mut(own) {
                point.rows.push(row);
                continue;
            }
            let name = named(&places, quantities, values);
            if points.len() == self.table.rows() {
                let reason = format!(
                    "the model's conditions have more points than there are lines: there are no readings \
                     at {name}"
                );
                self.log.report_at(self.table.header(), DiagnosticKind::Table { reason });
                return None;
            }
            points.push(Point { rows: vec![row], lines: Vec::new(), name });
        }
        let conversions: Option<Vec<Conversion<'_>>> = self
            .conditions
            .iter()
            .zip(&places)
            .map(|(column, at)| self.conversion(column, &quantities[*at].unit))
            .collect();
        let conversions = conversions?;
        let mut is_right = true;
        let is_filled = |line: &usize| {
            (0..self.table.columns().len()).any(|column| !self.table.text(*line, column).is_empty())
        };
        for line in lines.filter(is_filled) {
            let cells = self.conditions.iter().zip(&conversions);
            let values: Option<Vec<f64>> =
                cells.map(|(column, to)| self.number(line, column, to)).collect();
            let Some(values) = values else {
                is_right = false;
                continue;
            };
            let holds = |point: &&mut Point| {
                let row = point.rows.first().and_then(|first| conditions.rows.get(*first));
                row.is_some_and(|row| {
                    places.iter().zip(&values).all(|(at, value)| is_same(row[*at], *value))
                })
            };
            match points.iter_mut().find(holds) {
                Some(point) => point.lines.push(line),
                None => {
                    is_right = false;
                    let mut whole = vec![f64::NAN; quantities.len()];
                    for (at, value) in places.iter().zip(values) {
                        whole[*at] = value;
                    }
                    let asked = named(&places, quantities, &whole);
                    let given: Vec<String> = points
                        .iter()
                        .take(MOST_NAMES)
                        .map(|point| point.name.clone())
                        .chain((points.len() > MOST_NAMES).then(|| "...".to_owned()))
                        .collect();
                    let reason = format!(
                        "{asked} is no row of the model's conditions; they have {}",
                        given.join("; ")
                    );
                    let column = self.conditions.first().map_or(0, |column| column.index);
                    let place = self.table.place(line, column);
                    self.log.report_at(place, DiagnosticKind::Table { reason });
                }
            }
        }
        is_right.then_some(points)
    }

    /// Which rows share a value of an input, if points differ; `None` after an error.
    #[allow(clippy::option_option)]
    fn sharing_of(&self, conditions: &Conditions) -> Option<Option<Sharing>> {
        if self.conditions.is_empty() {
            return Some(None);
        }
        let Some(several) = self.points.iter().find(|point| point.rows.len() > 1) else {
            return Some(Some(Sharing::Row));
        };
        if let [column] = self.conditions.as_slice() {
            let condition = self.known.iter().position(|name| *name == column.name)?;
            return Some(Some(Sharing::Condition(condition)));
        }
        let others: Vec<String> = conditions
            .quantities
            .iter()
            .map(|of| &of.name)
            .filter(|name| self.conditions.iter().all(|column| column.name != **name))
            .map(|name| format!("`{name}`"))
            .collect();
        let reason = format!(
            "{} rows of the model's conditions have {}, and nothing says which of them a line belongs to; \
             add the column {}",
            several.rows.len(),
            several.name,
            listed(&others, " or ")
        );
        self.log.report_at(self.table.header(), DiagnosticKind::Table { reason });
        None
    }

    /// The readings of a variable with one of these names, in its unit. Outside `None` without a column,
    /// inside after an error.
    #[allow(clippy::option_option)]
    pub(super) fn of(&self, names: &[&str], unit: &Unit) -> Option<Option<FileReadings>> {
        let columns: Vec<&ReadingColumn> =
            self.columns.iter().filter(|column| names.contains(&column.name.as_str())).collect();
        let column = match columns.as_slice() {
            [] => return None,
            [column] => column,
            [first, second, ..] => {
                first.is_taken.set(true);
                second.is_taken.set(true);
                let reason = format!(
                    "the columns `{}` and `{}` both are the readings of `{}`; leave one of them out",
                    first.heading, second.heading, second.name
                );
                self.log.report_at(self.table.header(), DiagnosticKind::Table { reason });
                return Some(None);
            }
        };
        column.is_taken.set(true);
        Some(self.lists(column, unit))
    }

    fn lists(&self, column: &ReadingColumn, unit: &Unit) -> Option<FileReadings> {
        let to = self.conversion(column, unit)?;
        let mut lists = vec![Vec::new(); if self.conditions.is_empty() { 1 } else { self.rows }];
        let mut is_right = true;
        for point in &self.points {
            let Some(values) = self.values(column, point, &to) else {
                is_right = false;
                continue;
            };
            for row in &point.rows {
                if let Some(list) = lists.get_mut(*row) {
                    list.clone_from(&values);
                }
            }
        }
        let replacing = Some((self.new.file.name().to_owned(), self.place_of(column)));
        let sharing = self.sharing.clone();
        is_right.then_some(FileReadings { lists, sharing, note: None, replacing })
    }

    /// The labels of the lines, in a column that says to which group a reading belongs.
    pub(super) fn labels(&self, name: &str, of: &str) -> Option<Vec<f64>> {
        let Some(column) = self.columns.iter().find(|column| column.name == name) else {
            let reason = format!(
                "`{of}` has its readings in groups; add the column `{name}`, which says to which group a \
                 line belongs"
            );
            self.log.report_at(self.table.header(), DiagnosticKind::Table { reason });
            return None;
        };
        column.is_taken.set(true);
        if !self.conditions.is_empty() {
            let reason = format!(
                "`{of}` has its readings in groups, which are read for all rows of the conditions together; \
                 leave the column `{}` out",
                self.conditions[0].heading
            );
            self.log.report_at(self.table.header(), DiagnosticKind::Table { reason });
            return None;
        }
        let point = self.points.first()?;
        // labels have no unit
        self.values(column, point, &Conversion { own: None, unit: &Unit::one() })
    }

    /// The values of a column at a point. Cells below the last one may be empty.
    fn values(
        &self,
        column: &ReadingColumn,
        point: &Point,
        to: &Conversion<'_>,
    ) -> Option<Vec<f64>> {
        let is_filled = |line: &usize| !self.table.text(*line, column.index).is_empty();
        let filled = point.lines.iter().rposition(is_filled).map_or(0, |at| at + 1);
        let numbers = point.lines.iter().take(filled).map(|line| self.number(*line, column, to));
        // all errors of a column come at once
        let numbers: Vec<Option<f64>> = numbers.collect();
        let values = numbers.into_iter().collect::<Option<Vec<f64>>>()?;
        if values.is_empty() {
            let at = if point.name.is_empty() { "" } else { " at " };
            let reason = format!("there are no readings of `{}`{at}{}", column.name, point.name);
            self.log.report_at(self.place_of(column), DiagnosticKind::Table { reason });
            return None;
        }
        Some(values)
    }

    /// The number in a cell, in the unit of the model.
    fn number(&self, line: usize, column: &ReadingColumn, to: &Conversion<'_>) -> Option<f64> {
        let cell = self.table.text(line, column.index);
        let report = |kind| self.log.report_at(self.table.place(line, column.index), kind);
        let text = match self.marks.borrow_mut().with_point(cell) {
            Ok(text) => text.into_owned(),
            Err(reason) => {
                report(DiagnosticKind::Table { reason });
                return None;
            }
        };
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Some(to.of(number)),
            _ => {
                let (column, found) = (column.heading.clone(), cell.to_owned());
                report(DiagnosticKind::Cell { row: line + 1, column, found });
                None
            }
        }
    }

    /// How the numbers of a column come to a unit of the model; `None` after an error.
    fn conversion<'u>(&self, column: &'u ReadingColumn, unit: &'u Unit) -> Option<Conversion<'u>> {
        let of_text = |text: &str| self.log.unit(text).ok();
        let declared = (unit, ValueOf::Quantity);
        let other = column_heading::contradiction(of_text, &column.text, declared);
        let (Some(own), Some(other)) = (&column.unit, other) else {
            return Some(Conversion { own: None, unit });
        };
        if Unit::convert(1.0, own, unit).is_ok() {
            return Some(Conversion { own: Some(own), unit });
        }
        let (model, hint) = match self.new.model {
            Some(model) => (
                format!(" in `{model}`"),
                format!("; a column of another model file is headed `MODEL:{}`", column.text),
            ),
            None => (String::new(), String::new()),
        };
        let reason = format!(
            "the column `{}` is in `{}`, which cannot be converted to `{}`, the unit of `{}`{model}{hint}",
            column.heading, other.heading, other.declared, column.name
        );
        self.log.report_at(self.place_of(column), DiagnosticKind::Table { reason });
        None
    }

    fn place_of(&self, column: &ReadingColumn) -> Place {
        self.table.heading(column.index)
    }

    /// Reports columns that no readings of the model have taken, and those that replacements contradict;
    /// and notes which readings are kept.
    pub(super) fn finish(&self, inputs: &mut InputSet, overrides: &[Override]) {
        let (of_readings, replaced) = (inputs.readings.inputs.clone(), inputs.replaced.clone());
        for column in self.columns.iter().filter(|column| !column.is_taken.get()) {
            if self.new.model.is_none() {
                let reason = self.why_not(column, inputs, &of_readings);
                self.log.report_at(self.place_of(column), DiagnosticKind::Table { reason });
            }
        }
        let taken = self.columns.iter().filter(|column| column.is_taken.get());
        inputs.readings.taken = taken.map(|column| column.heading.clone()).collect();
        inputs.readings.conditions =
            self.conditions.iter().map(|column| column.heading.clone()).collect();
        let file = self.new.file.name();
        let quoted = |name: &String| format!("`{name}`");
        if !replaced.is_empty() {
            inputs.readings.file = Some(file.to_owned());
            let names = listed(&replaced.iter().map(quoted).collect::<Vec<_>>(), ", ");
            let fact = fact!("readings-replaced", file, names);
            inputs.warnings.push(Warning::new("readings", fact));
        }
        let is_listed = |name: &str| overrides.iter().find(|change| change.is_list_of(name, true));
        for (name, change) in replaced.iter().filter_map(|name| Some((name, is_listed(name)?))) {
            let text = change.text.clone();
            let reason = format!("`{file}` has readings of `{name}` as well");
            let place = self.table.header();
            self.log.report_at(place, DiagnosticKind::Override { text, reason });
        }
        let is_kept = |name: &&String| !replaced.contains(name) && is_listed(name).is_none();
        let kept: Vec<String> = of_readings.iter().filter(is_kept).map(quoted).collect();
        if !kept.is_empty() && !replaced.is_empty() {
            let fact = fact!("readings-kept", file, names = listed(&kept, ", "));
            inputs.warnings.push(Warning::new("readings", fact));
        }
    }

    /// Why a column has no place in the model.
    fn why_not(&self, column: &ReadingColumn, inputs: &InputSet, of_readings: &[String]) -> String {
        let ReadingColumn { name, .. } = column;
        let is_input = inputs.quantities.iter().any(|of| of.quantity.name == *name)
            || inputs.variables.iter().any(|variable| variable.name == *name);
        why_not(name, is_input, of_readings, &self.known)
    }
}

/// The column of a heading; `None` where it belongs to another model, or after an error.
fn column(
    log: &Collector,
    table: &TextTable,
    model: Option<&str>,
    index: usize,
    heading: &str,
) -> Option<ReadingColumn> {
    let text = match model.and_then(|model| Some((model, heading.rsplit_once(':')?))) {
        Some((model, (own, text))) if own.trim() == model => text.trim(),
        Some(_) => return None,
        None => heading.trim(),
    };
    let report = |reason| {
        log.report_at(table.heading(index), DiagnosticKind::Table { reason });
        None
    };
    if text.is_empty() {
        return report(format!("column {} has no name in the header", index + 1));
    }
    let Some((name, unit)) = column_heading::heading(log, text) else {
        return report(format!(
            "the heading `{heading}` names no unit that is known; a number other than 1 and a value are none"
        ));
    };
    let (name, unit) = if name == text { (text, None) } else { (name, Some(unit)) };
    Some(ReadingColumn {
        index,
        heading: heading.to_owned(),
        text: text.to_owned(),
        name: name.to_owned(),
        unit,
        is_taken: Cell::new(false),
    })
}

/// Conditions with their values, in words.
fn named(places: &[usize], quantities: &[Quantity], values: &[f64]) -> String {
    let each = places.iter().filter_map(|at| {
        let (of, value) = (quantities.get(*at)?, values.get(*at)?);
        Some(format!("`{}` = {}", of.name, of.unit.after(&Shortest(*value).to_string())))
    });
    listed(&each.collect::<Vec<_>>(), " and ")
}

/// Why a column of this name has no place in a model: which of its inputs have readings, and which
/// conditions it has.
pub(super) fn why_not(
    name: &str,
    is_input: bool,
    of_readings: &[String],
    conditions: &[String],
) -> String {
    if is_input {
        return format!(
            "the input `{name}` has no readings that could be replaced; `--set {name}=...` changes its \
             estimate"
        );
    }
    // a component of readings has the column of its input
    let of_readings: Vec<&str> =
        of_readings.iter().map(|name| name.split('/').next().unwrap_or(name)).collect();
    let known = of_readings.iter().copied().chain(conditions.iter().map(String::as_str));
    if let Some(near) = nearest(name, known) {
        return format!("there is no input `{name}`; did you mean `{near}`?");
    }
    let mut names: Vec<String> =
        of_readings.iter().take(MOST_NAMES).map(|name| format!("`{name}`")).collect();
    if names.is_empty() {
        return format!("there is no input `{name}`, and none of the inputs has readings");
    }
    if of_readings.len() > MOST_NAMES {
        names.push("...".to_owned());
    }
    format!("there is no input `{name}`; inputs with readings are {}", names.join(", "))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::{FileReader, ModelFile, Override, ReadingsFile};
    use gumption_engine::distribution::Distribution;

    fn read(input: &str, conditions: &str, table: &str, set: &[&str]) -> Result<ModelFile, String> {
        let model = format!(
            r#"{{"inputs": {{"x": {{"unit": "V", {input}}}}}, "conditions": {{{conditions}}},
            "equations": {{"y": "x"}}, "outputs": {{"y": {{"unit": "V"}}}}}}"#
        );
        let set: Vec<Override> = set.iter().filter_map(|text| Override::parse(text)).collect();
        let file =
            ReadingsFile::of("today.csv", table.into()).map_err(|error| error.to_string())?;
        let reader = FileReader::default().with_readings(Some(&file));
        reader.model_text("m.json", &model, Path::new(""), &set).map_err(|error| error.to_string())
    }

    const READINGS: &str = r#""distribution": "readings", "values": [1, 2]"#;
    const GRID: &str = r#""f": {"unit": "Hz", "values": [1, 2]}, "g": {"values": [1, 2]}"#;

    fn values(file: &ModelFile) -> Vec<Vec<f64>> {
        let of_row = |distribution: &Distribution| match distribution {
            Distribution::Readings(readings) => readings.values().to_vec(),
            other => panic!("{other:?}"),
        };
        file.task.rows.iter().map(|row| of_row(&row.distributions[0])).collect()
    }

    /// Readings at a value of one of two conditions are one quantity in all rows with that value, those
    /// at a value of each are one in each row, and without conditions there is one for all rows.
    #[test]
    fn rows_share_what_was_read_once() {
        let of_f = "f [Hz],x\n1,10\n1,11\n2,20\n2,22\n";
        let file = read(READINGS, GRID, of_f, &[]).unwrap();
        assert_eq!(file.task.variables[0].sharing, Sharing::Condition(0));
        assert_eq!(values(&file), [[10.0, 11.0], [10.0, 11.0], [20.0, 22.0], [20.0, 22.0]]);
        let of_both = "g,f [kHz],x [kV]\n1,0.001,1\n1,0.001,2\n2,0.001,3\n2,0.001,5\n1,0.002,7\n1,0.002,9\n\
                       2,0.002,4\n2,0.002,8\n";
        let file = read(READINGS, GRID, of_both, &[]).unwrap();
        assert_eq!(file.task.variables[0].sharing, Sharing::Row);
        assert_eq!(values(&file), [[1e3, 2e3], [3e3, 5e3], [7e3, 9e3], [4e3, 8e3]]);
        let shared = read(READINGS, GRID, "x\n3\n4\n", &[]).unwrap();
        assert_eq!(shared.task.variables[0].sharing, Sharing::All);
        // also in place of formulas that give each row its own
        let of_rows = r#""distribution": "readings", "values": ["g*[V]", "2*g*[V]"]"#;
        let own = read(of_rows, GRID, "f [Hz],x\n1,1\n1,2\n2,1\n2,3\n", &[]).unwrap();
        assert_eq!(own.task.variables[0].sharing, Sharing::Condition(0));
        let shared = read(of_rows, GRID, "x\n3\n4\n", &[]).unwrap();
        assert_eq!(shared.task.variables[0].sharing, Sharing::All);
        // what the model says of the rows stays
        let per = format!("{READINGS}, \"per\": \"row\"");
        let stated = read(&per, GRID, of_f, &[]).unwrap();
        assert_eq!(stated.task.variables[0].sharing, Sharing::Row);
    }

    #[test]
    fn every_point_needs_lines() {
        let said =
            read(READINGS, r#""f": {"values": [1, 2, 3]}"#, "f,x\n1,1\n2,1\n", &[]).unwrap_err();
        assert!(
            said.contains("more points than there are lines") && said.contains("`f` = 3"),
            "{said}"
        );
    }

    #[test]
    fn points_that_are_not_told_apart_are_refused() {
        let three = format!(r#"{GRID}, "h": {{"values": [1, 2]}}"#);
        let table = "f [Hz],g,x\n1,1,1\n1,1,2\n1,2,1\n1,2,2\n2,1,1\n2,1,2\n2,2,1\n2,2,2\n";
        let said = read(READINGS, &three, table, &[]).unwrap_err();
        assert!(
            said.contains("2 rows of the model's conditions have `f` = 1 Hz and `g` = 1"),
            "{said}"
        );
        assert!(said.contains("add the column `h`"), "{said}");
    }

    /// What the model says of an input besides its readings stays.
    #[test]
    fn resolution_and_pooled_scatter_stay() {
        let pooled =
            r#""distribution": "readings", "values": [1, 2], "pooled": {"std": 0.1, "dof": 9}"#;
        let file = read(pooled, r#""f": {"values": [1]}"#, "x\n3\n5\n4\n4\n", &[]).unwrap();
        let of = &file.task.rows[0].distributions[0];
        // the scatter of the model over the root of the number of today's readings
        let found = [of.mean(), of.standard_uncertainty(), of.dof()];
        assert_eq!(found, [4.0, 0.05, 9.0]);
        let resolution = r#""distribution": "readings", "values": [1, 2], "resolution": 0.6"#;
        let file = read(resolution, r#""f": {"values": [1]}"#, "x\n3\n3\n", &[]).unwrap();
        let of = &file.task.rows[0].distributions[0];
        assert!((of.standard_uncertainty() - 0.3 / 3f64.sqrt()).abs() < 1e-15);
    }

    /// An estimate of the command line moves the readings, as it does those of the model.
    #[test]
    fn estimates_and_readings_are_replaced_together() {
        let file = read(READINGS, r#""f": {"values": [1]}"#, "x\n3\n5\n", &["x=7"]).unwrap();
        let of = &file.task.rows[0].distributions[0];
        assert_eq!([of.mean(), of.standard_uncertainty()], [7.0, 1.0]);
    }

    #[test]
    fn notes_name_what_was_replaced_and_what_was_kept() {
        let model = r#"{"inputs": {"x": {"distribution": "readings", "values": [1, 2]},
            "z": {"distribution": "readings", "values": [1, 2]}},
            "equations": {"y": "x + z"}, "outputs": {"y": {}}}"#;
        let today = ReadingsFile::of("today.csv", b"x\n3\n4\n".to_vec()).unwrap();
        let reader = FileReader::default().with_readings(Some(&today));
        let file = reader.model_text("m.json", model, Path::new(""), &[]).unwrap();
        let notes: Vec<_> = file.warnings.iter().map(|note| note.fact.clone()).collect();
        assert!(notes.contains(&fact!("readings-replaced", file = "today.csv", names = "`x`")));
        assert!(notes.contains(&fact!("readings-kept", file = "today.csv", names = "`z`")));
    }
}
