//! Data that the case has in itself, and data of a file.

use std::path::Path;

use super::super::{CaseFile, FileReader};
use gumption_engine::number::elementary;
use gumption_gap::{DiagnosisOptions, diagnose};
use gumption_report::Provenance;
use gumption_text::SourceText;
use gumption_text::table;
use serde_json::{Value, json};

/// A case whose output comes from a column, with a low-pass filter in the list.
fn case(data: (&str, Value)) -> Value {
    let (key, data) = data;
    json!({
        "conditions": {"f": {"unit": "Hz"}},
        "outputs": {"s": {"unit": "1"}},
        "observations": {key: data, "columns": {
            "s": {"value": "s", "standard_uncertainty": "u_s", "sim": "sim"}}},
        "effects": {"low": {
            "parameters": {"fc": {"unit": "Hz", "distribution": "log-uniform", "lower": 10, "upper": 1000}},
            "overrides": {"s": "s/sqrt(1 + (f/fc)^2)"}}}
    })
}

fn read(case: &Value, folder: &Path) -> Result<CaseFile, String> {
    let read = FileReader::default().case_text("case.json", &case.to_string(), folder);
    read.map_err(|found| found.0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
}

/// The same numbers as a table and as lists, which keep the digits that were written.
fn data() -> (String, Value) {
    let noise = [0.0021, -0.0047, 0.0034, 0.0008, -0.0026];
    let (mut table, mut lists) = ("f [Hz],s,u_s,sim\n".to_owned(), String::new());
    let mut columns = vec![Vec::new(); 4];
    for row in 0..12_u8 {
        let f = 5.0 * elementary::exp(0.3 * f64::from(row));
        let s = (1.0 / (1.0 + (f / 65.0) * (f / 65.0))).sqrt() + noise[usize::from(row) % 5];
        let cells = [format!("{f:.1}"), format!("{s:.4}"), "0.005".into(), "1".into()];
        table.push_str(&(cells.join(",") + "\n"));
        columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
    }
    for (name, column) in ["f [Hz]", "s", "u_s", "sim"].iter().zip(&columns) {
        lists.push_str(&format!(
            "{}\"{name}\": [{}]",
            if lists.is_empty() { "{" } else { ", " },
            column.join(", ")
        ));
    }
    (table, serde_json::from_str(&(lists + "}")).unwrap())
}

#[test]
fn data_in_the_case_give_the_diagnosis_of_data_in_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let (text, lists) = data();
    std::fs::write(folder.path().join("data.csv"), &text).unwrap();
    let by_file = read(&case(("file", json!("data.csv"))), folder.path()).unwrap();
    let inline = read(&case(("values", lists)), folder.path()).unwrap();
    assert_eq!((by_file.files.len(), inline.files.len()), (1, 0));
    let said = |file: &CaseFile| {
        let found = diagnose(&file.case, None, DiagnosisOptions::new(1), &|_| {}).unwrap();
        let page = gumption_report::gap::html(&found, &Provenance::default());
        (gumption_report::gap::json(&found), page)
    };
    assert_eq!(said(&by_file), said(&inline));
    // with other values as well, as a check of the diagnosis makes them
    let other = vec![vec![0.5; 12]];
    let files = inline.variant(&other, Some("low")).unwrap();
    let [(name, text)] = files.as_slice() else { panic!("one file") };
    assert_eq!(name, "case.json");
    let made: Value = serde_json::from_slice(text).unwrap();
    assert_eq!(made["observations"]["values"]["s"], json!(vec![0.5; 12]));
    assert_eq!(made["effects"], json!({}));
}

#[test]
fn the_last_written_digits_are_kept() {
    let node = gumption_text::json::parse(&SourceText::new(
        "t",
        r#"{"v": {"a": [1.50, 2e-3], "b": [10, 20]}}"#,
    ));
    let gumption_text::json::Json::Object(members) = node.unwrap().value else {
        panic!("an object")
    };
    let log = gumption_text::Collector::new(SourceText::new("t", ""));
    let lists = table::of_lists(&log, &members[0], "`v`").unwrap();
    let lines = table::parse(&SourceText::new("t", "a,b\n1.50,10\n2e-3,20\n"), None).unwrap();
    assert_eq!((&lists.columns, &lists.rows), (&lines.columns, &lines.rows));
    assert_eq!(lists.last_digits, lines.last_digits);
    assert_eq!(lists.last_digits, [Some(-3), Some(0)]);
}

#[test]
fn mistakes_in_the_data_say_where_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |values: Value| read(&case(("values", values)), folder.path()).unwrap_err();
    let said = refused(json!({"f": [1, 2, 3], "s": [1, 2], "u_s": [1, 1, 1], "sim": [1, 1, 1]}));
    assert!(said.contains("`s` has 2 values, but `f` has 3"), "{said}");
    let said = refused(json!({"f": [1, "x"], "s": [1, null], "u_s": [1, 1], "sim": [1, 1]}));
    assert!(said.contains("row 2, column `f`: `x` is not a finite number"), "{said}");
    assert!(said.contains("row 2, column `s`: the cell is empty"), "{said}");
    let said = refused(json!({"f": [], "s": [], "u_s": [], "sim": []}));
    assert!(said.contains("the column `f` has no values"), "{said}");
    assert!(refused(json!({})).contains("`values` has no values"));
    assert!(refused(json!({"f": 1})).contains("a list"));
    let said = refused(json!({"f": [1, 2], "s": [1, 1], "u_s": [1, 1]}));
    assert!(said.contains("`values` has no column `sim`"), "{said}");
    let said = refused(json!({"f": [1, 2], "s": [1, 1], "u_s": [1, 0], "sim": [1, 1]}));
    assert!(said.contains("in row 2 is 0"), "{said}");
    let mut both = case(("file", json!("data.csv")));
    both["observations"]["values"] = json!({"s": [1]});
    assert!(read(&both, folder.path()).unwrap_err().contains("exclude each other"));
    let mut neither = case(("file", json!("data.csv")));
    neither["observations"].as_object_mut().unwrap().remove("file");
    let said = read(&neither, folder.path()).unwrap_err();
    assert!(said.contains("`observations` needs the measured data"), "{said}");
}
