//! Tables that are pasted or named as the data of a case: headings, numbers, and what is none.

use gumption_columns::heading;
use gumption_columns::separator::{DecimalMarks, Separator, is_skipped};
use gumption_engine::model::formula::check_name;
use gumption_text::{FileSource, bytes};
use jsonc_parser::ast::{Object, ObjectProp, Value};
use serde::Deserialize;
use serde_json::{Value as Json, json};

use crate::tree;
use crate::{LiveError, limited};

/// Maximum number of columns of a table that is shown.
const MOST_COLUMNS: usize = 200;

/// Values of a column that are shown.
const SHOWN: usize = 3;

/// A request of the call `table`.
#[derive(Debug, Deserialize)]
pub(crate) struct TableRequest {
    /// The table as somebody pasted it.
    text: String,
}

/// Why a text is no table of numbers under headings; the page has the words.
fn fault(kind: &str, of: &Json) -> Json {
    json!({ "fault": kind, "of": of })
}

/// The columns of a pasted table.
pub(crate) fn pasted(asked: &TableRequest) -> Result<Json, LiveError> {
    Ok(columns(limited(&asked.text)?, true))
}

/// The columns of the data of a case, be they in the case or in a file; null where it has none.
pub(crate) fn of_case(text: &str, root: &Value<'_>, folder: &dyn FileSource) -> Json {
    let Some(observations) = tree::get(root, "observations") else { return Json::Null };
    if let Some(lists) = tree::get(observations, "values").and_then(Value::as_object) {
        return of_lists(text, lists);
    }
    let name = tree::get(observations, "file").and_then(Value::as_string_lit);
    let Some(name) = name.filter(|name| !name.value.is_empty()) else { return Json::Null };
    let content = folder.content(&name.value, bytes::MOST);
    let read = |content: Vec<u8>| bytes::text(&content).map(std::borrow::Cow::into_owned);
    match content.and_then(read) {
        Ok(text) => columns(&text, false),
        Err(message) => fault("said", &json!(message)),
    }
}

fn of_lists(text: &str, lists: &Object<'_>) -> Json {
    let mut rows = 0;
    let column = |of: &ObjectProp<'_>| {
        let cells = of.value.as_array().map(|array| array.elements.as_slice()).unwrap_or_default();
        rows = rows.max(cells.len());
        let first: Vec<String> =
            cells.iter().take(SHOWN).map(|cell| tree::raw(text, cell)).collect();
        let heading = of.name.as_str();
        let (name, unit) = bare(heading);
        json!({ "heading": heading, "key": heading, "name": name, "unit": unit, "first": first, "none": null })
    };
    let columns: Vec<Json> = lists.properties.iter().take(MOST_COLUMNS).map(column).collect();
    json!({ "columns": columns, "rows": rows })
}

/// A heading without its unit, and the unit.
fn bare(heading: &str) -> (&str, Option<&str>) {
    match heading::named(heading) {
        Some((bare, unit)) if !bare.is_empty() => (bare, Some(unit)),
        _ => (heading, None),
    }
}

/// The columns of a text; from a spreadsheet there are tabs between the cells, whatever else is in
/// the headings.
fn columns(text: &str, is_pasted: bool) -> Json {
    let text = text.trim_start_matches('\u{feff}');
    let mut lines = text.lines().filter(|line| !is_skipped(line));
    let Some(header) = lines.next() else { return fault("empty", &Json::Null) };
    let separator = match is_pasted && header.contains('\t') {
        true => Separator::Tab,
        false => Separator::of_header(header),
    };
    let cells = |line: &str| separator.cells(line.trim_end_matches(['\r', ' ']));
    let headings = match cells(header) {
        Ok(headings) => headings,
        Err(message) => return fault("said", &json!(message)),
    };
    let is_number = |cell: &String| cell.replace(',', ".").parse::<f64>().is_ok();
    if headings.iter().all(is_number) {
        return fault("headings", &Json::Null);
    }
    if headings.len() > MOST_COLUMNS {
        return fault("columns", &json!([headings.len(), MOST_COLUMNS]));
    }
    let mut read: Vec<Column> = headings.iter().map(|_| Column::default()).collect();
    let mut marks = DecimalMarks::of(separator);
    let mut count = 0;
    for line in lines {
        count += 1;
        let found = match cells(line) {
            Ok(found) => found,
            Err(message) => return fault("said", &json!(message)),
        };
        // what is empty at the end of a line may be missing
        if found.len() > headings.len() || found.is_empty() {
            return fault("row", &json!([count, found.len(), headings.len()]));
        }
        let missing = std::iter::repeat_n(String::new(), headings.len() - found.len());
        for (column, cell) in read.iter_mut().zip(found.into_iter().chain(missing)) {
            if let Err(message) = column.take(&cell, count, &mut marks) {
                return fault("said", &json!(message));
            }
        }
    }
    if count == 0 {
        return fault("rows", &Json::Null);
    }
    let mut taken = Vec::new();
    let told = headings.iter().zip(&read).enumerate().filter(|(_, (heading, column))| {
        // the empty columns of a sheet
        !(heading.is_empty() && column.is_empty)
    });
    let told: Vec<Json> = told
        .map(|(place, (text, column))| {
            let (bare, unit) = bare(text);
            let name = free_name(bare, place + 1, &mut taken);
            // a name that formulas can use, with the unit as it is written
            let key = unit.map_or(name.clone(), |unit| format!("{name} [{unit}]"));
            json!({
                "heading": text,
                "key": if is_pasted { &key } else { text },
                "name": if is_pasted { &name } else { bare },
                "unit": unit,
                "first": column.first,
                "values": column.fault.is_none().then(|| format!("[{}]", column.numbers.join(", "))),
                "none": column.fault,
            })
        })
        .collect();
    json!({ "columns": told, "rows": count })
}

#[derive(Debug)]
struct Column {
    first: Vec<String>,
    numbers: Vec<String>,
    /// The first cell that is no number, with its row.
    fault: Option<(usize, String)>,
    is_empty: bool,
}

impl Default for Column {
    fn default() -> Self {
        Self { first: Vec::new(), numbers: Vec::new(), fault: None, is_empty: true }
    }
}

impl Column {
    fn take(&mut self, cell: &str, row: usize, marks: &mut DecimalMarks) -> Result<(), String> {
        self.is_empty &= cell.is_empty();
        if self.first.len() < SHOWN {
            self.first.push(cell.to_owned());
        }
        // remarks and times have points and commas of their own
        let looks = cell.trim_start_matches(['+', '-', '−']).replace(',', ".");
        let is_number = looks.starts_with(|c: char| c.is_ascii_digit() || c == '.')
            && looks.parse::<f64>().is_ok_and(f64::is_finite);
        if !is_number {
            self.fault.get_or_insert_with(|| (row, cell.to_owned()));
        } else if self.fault.is_none() {
            self.numbers.push(marks.with_point(cell)?.into_owned());
        }
        Ok(())
    }
}

/// A name for a column that formulas can use, and that no column before has.
fn free_name(heading: &str, number: usize, taken: &mut Vec<String>) -> String {
    let mut name: String = heading
        .trim()
        .chars()
        .map(|c| if c.is_alphanumeric() || c == '_' { c } else { '_' })
        .collect();
    while name.contains("__") {
        name = name.replace("__", "_");
    }
    let mut name = name.trim_matches('_').to_owned();
    if name.is_empty() || name.starts_with(|c: char| c.is_numeric()) {
        name = format!("column_{}", if name.is_empty() { number.to_string() } else { name });
    }
    if check_name(&name).is_err() {
        name.push('_');
    }
    let first = name.clone();
    let mut next = 2;
    while taken.contains(&name) {
        name = format!("{first}_{next}");
        next += 1;
    }
    taken.push(name.clone());
    name
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pasted(text: &str) -> Json {
        columns(text, true)
    }

    #[test]
    fn the_data_of_a_case_are_shown_as_they_are_written() {
        let text = r#"{"observations": {"values": {"f [Hz]": [1.50, 2, 3, 4], "y": [1, 2]}}}"#;
        let root = tree::parse(text).unwrap();
        let found = of_case(text, &root, &crate::HeldFiles::default());
        assert_eq!(found["rows"], 4);
        assert_eq!(found["columns"][0]["first"], json!(["1.50", "2", "3"]));
        assert_eq!(
            (&found["columns"][0]["name"], &found["columns"][0]["unit"]),
            (&json!("f"), &json!("Hz"))
        );
        let text = r#"{"observations": {"file": "a.csv"}}"#;
        let held = crate::HeldFiles(vec![("a.csv".to_owned(), b"t [s],x\n1,2\n".to_vec())]);
        let found = of_case(text, &tree::parse(text).unwrap(), &held);
        assert_eq!(found["columns"][0]["key"], "t [s]");
        let found = of_case(text, &tree::parse(text).unwrap(), &crate::HeldFiles::default());
        assert_eq!(found["fault"], "said");
        let text = r#"{"observations": {}}"#;
        assert_eq!(of_case(text, &tree::parse(text).unwrap(), &held), Json::Null);
    }

    #[test]
    fn a_spreadsheet_is_pasted_with_decimal_commas_and_units() {
        let found =
            pasted("f [Hz]\tU, gemessen / V\t\tBemerkung\r\n1,0\t2,50\t\tgut\r\n2\t3\t\t\r\n");
        assert_eq!(found["rows"], 2);
        let columns = found["columns"].as_array().unwrap();
        assert_eq!(columns.len(), 3);
        assert_eq!(columns[0]["key"], "f [Hz]");
        assert_eq!(columns[0]["values"], "[1.0, 2]");
        assert_eq!((&columns[1]["name"], &columns[1]["unit"]), (&json!("U_gemessen"), &json!("V")));
        assert_eq!(columns[1]["values"], "[2.50, 3]");
        assert_eq!(columns[2]["values"], Json::Null);
        assert_eq!(columns[2]["none"], json!([1, "gut"]));
    }

    #[test]
    fn other_separators_and_names_that_are_none() {
        let found = pasted("2nd;sin;x;x\n1;2;3;4\n");
        let names: Vec<&Json> =
            found["columns"].as_array().unwrap().iter().map(|of| &of["name"]).collect();
        assert_eq!(names, ["column_2nd", "sin_", "x", "x_2"]);
        assert_eq!(pasted("x,y\n1,2.5\n")["columns"][1]["values"], "[2.5]");
    }

    #[test]
    fn what_is_no_table_is_told() {
        assert_eq!(pasted(" \n")["fault"], "empty");
        assert_eq!(pasted("1\t2\n3\t4")["fault"], "headings");
        assert_eq!(pasted("a\tb\n")["fault"], "rows");
        let found = pasted("a\tb\n1\t2\n1\t2\t3\n");
        assert_eq!((&found["fault"], &found["of"]), (&json!("row"), &json!([2, 3, 2])));
        let found = pasted("a\tb\n1,5\t2.5\n");
        assert!(found["of"].as_str().unwrap().contains("decimal"), "{found}");
    }
}
