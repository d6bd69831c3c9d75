//! `gumption compare` from the outside.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use serde_json::{Value, json};

use crate::support::{command, root};

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let output = command().current_dir(folder).arg("compare").args(arguments).output();
    output.expect("the program runs")
}

fn answer(folder: &Path, arguments: &[&str]) -> Value {
    let output = run(folder, &[arguments, &["--format", "json"]].concat());
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{said}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// A folder with a file in it.
fn with(name: &str, text: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(name);
    fs::write(&path, text).expect("written");
    (folder, path)
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// Table 1 of Chiominto et al. (2024), as printed, and the normalized errors of its Table 2.
const PAPER: [([f64; 4], f64); 9] = [
    ([423.0, 13.0, 422.0, 13.0], 0.04),
    ([422.0, 11.0, 419.0, 12.0], 0.18),
    ([425.0, 11.0, 421.0, 11.0], 0.26),
    ([422.0, 9.0, 422.0, 13.0], 0.05),
    ([423.0, 12.0, 419.0, 11.0], 0.25),
    ([423.0, 9.0, 419.0, 10.0], 0.31),
    ([423.0, 10.0, 425.0, 22.0], 0.09),
    ([430.0, 11.0, 429.0, 23.0], 0.05),
    ([426.0, 7.0, 424.0, 17.0], 0.07),
];

fn paper() -> String {
    let rows = PAPER.iter().enumerate().map(|(row, ([x1, u1, x2, u2], _))| {
        format!("MEMS {} {},{x1},{u1},{x2},{u2}\n", row / 3 + 1, ["x", "y", "z"][row % 3])
    });
    "label,x1,U1,x2,U2\n".to_owned() + &rows.collect::<String>()
}

/// Every value of Table 2 lies in the range that the digits of Table 1 allow, widened by the rounding
/// of Table 2 itself (0.005); all pairs are compatible.
#[test]
fn the_papers_table_2_from_its_table_1() {
    let (folder, _) = with("table1.csv", &paper());
    let found = answer(folder.path(), &["table1.csv", "--rounding", "--fail"]);
    let rows = found["rows"].as_array().expect("a list");
    assert_eq!(rows.len(), 9);
    for (row, ([x1, u1, x2, u2], published)) in rows.iter().zip(PAPER) {
        let [low, high] = [&row["range"][0], &row["range"][1]].map(number);
        assert!(low - 0.005 <= published && published <= high + 0.005, "{row} {published}");
        assert!(low <= number(&row["en"]) && number(&row["en"]) <= high);
        let expected = (x1 - x2).abs() / (u1 * u1 + u2 * u2).sqrt();
        assert!((number(&row["en"]) - expected).abs() < 1e-14);
        assert_eq!((number(&row["difference"]), &row["compatible"]), (x1 - x2, &json!(true)));
    }
    // MEMS 2, x: the printed table gives 0.00
    assert_eq!(number(&rows[3]["en"]), 0.0);
    assert!((number(&rows[3]["probability"]) - 1.0).abs() < 1e-15);
    let plain = answer(folder.path(), &["table1.csv"]);
    assert!(plain["rows"][0].get("range").is_none());
}

#[test]
fn every_format_shows_the_same_rows() {
    let (folder, _) = with("table1.csv", &paper());
    for format in ["table", "html", "markdown", "csv"] {
        let output = run(folder.path(), &["table1.csv", "--rounding", "--format", format]);
        assert_eq!(output.status.code(), Some(0));
        let text = String::from_utf8(output.stdout).expect("UTF-8");
        assert!(text.contains("MEMS 3 z"), "{text}");
        match format {
            "csv" => assert_eq!(text.lines().count(), 10),
            "html" => {
                assert!(text.contains("<svg") && !text.contains("<script"));
                roxmltree::Document::parse(
                    &text[text.find("<svg").expect("a figure")
                        ..text.find("</svg>").expect("its end") + 6],
                )
                .expect("a well-formed figure");
            }
            "markdown" => assert!(text.contains("| MEMS 1 x | 423 ± 13 | 422 ± 13 |"), "{text}"),
            _ => assert!(text.contains("All 9 pairs are compatible."), "{text}"),
        }
    }
}

#[test]
fn pairs_that_are_not_compatible() {
    let (folder, _) = with("t.csv", "label;x1;U1;x2;U2;r\na;10,0;0,3;10,2;0,4;0,5\nb;1;1;9;1;0\n");
    let found = answer(folder.path(), &["t.csv"]);
    // 0.3^2 + 0.4^2 - 2 x 0.5 x 0.3 x 0.4 = 0.13
    assert!((number(&found["rows"][0]["U"]) - 0.13f64.sqrt()).abs() < 1e-14);
    assert_eq!(found["rows"][1]["compatible"], false);
    assert_eq!(run(folder.path(), &["t.csv"]).status.code(), Some(0));
    let failed = run(folder.path(), &["t.csv", "--fail"]);
    assert_eq!(failed.status.code(), Some(3));
    assert!(String::from_utf8_lossy(&failed.stdout).contains("1 of 2 pairs is not compatible: b."));
}

/// 1001 mV less 1.002 V is compared in V, the unit of the first column, which every form says.
#[test]
fn every_form_has_the_unit() {
    let (folder, _) = with("t.csv", "label,x1 [V],U1 [mV],x2 [mV],U2 [uV]\na,1.002,3,1001,2000\n");
    let shown = |arguments: &[&str]| {
        String::from_utf8_lossy(&run(folder.path(), arguments).stdout).into_owned()
    };
    let found = answer(folder.path(), &["t.csv"]);
    assert_eq!(found["rows"][0]["unit"], "V");
    assert!((number(&found["rows"][0]["difference"]) - 0.001).abs() < 1e-15);
    let line = |text: &str| text.lines().find(|line| line.contains("1.002")).map(str::to_owned);
    let has_unit = |line: &str| line.split_whitespace().any(|cell| cell == "V");
    assert!(has_unit(&line(&shown(&["t.csv"])).expect("a row")));
    assert!(has_unit(&line(&shown(&["t.csv", "--format", "markdown"])).expect("a row")));
    assert!(shown(&["t.csv", "--format", "csv"]).trim_end().ends_with(",V"));
    let html = shown(&["t.csv", "--format", "html"]);
    assert!(html.contains("difference in V"), "{html}");
    fs::write(folder.path().join("l.csv"), "label,x [V],U [V]\na,10,0.1\nb,10.1,0.1\n").unwrap();
    assert_eq!(answer(folder.path(), &["l.csv"])["unit"], "V");
    // the mean of both, with U = 0.1/sqrt(2)
    let page = shown(&["l.csv"]);
    assert!(page.contains("Reference value 10.050 V with U = 0.071 V"), "{page}");
}

/// Laboratories by hand: the mean of 10 and 12 with U = 2 each, and one far off that is left out.
#[test]
fn laboratories_and_their_reference_value() {
    let (folder, _) = with("labs.csv", "label,x,U,k\nA,10,2,2\nB,12,3,3\nC,100,2,2\n");
    let found = answer(folder.path(), &["labs.csv"]);
    assert_eq!(found["reference"]["laboratories"], json!(["A", "B"]));
    assert_eq!(found["largest_consistent_subset"], "all subsets");
    assert!((number(&found["reference"]["value"]) - 11.0).abs() < 1e-12);
    assert!((number(&found["reference"]["U"]) - 2f64.sqrt()).abs() < 1e-12);
    assert_eq!(found["weighted_mean"]["consistent"], false);
    assert_eq!(
        (&found["rows"][2]["in_reference"], &found["rows"][2]["compatible"]),
        (&json!(false), &json!(false))
    );
    assert_eq!(run(folder.path(), &["labs.csv", "--fail"]).status.code(), Some(3));
    // the advice and the option stand beside the headline, above the table
    let advice = "otherwise use Mandel-Paule: `--estimator mandel-paule` (see below).";
    let page = |arguments: &[&str]| {
        let page = String::from_utf8(run(folder.path(), arguments).stdout).expect("text");
        page.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let headline = page(&["labs.csv"]);
    let place = headline.find(advice).expect("the advice");
    assert!(place < headline.find("laboratory").expect("the table"), "{headline}");
    assert!(!page(&["labs.csv", "--estimator", "mandel-paule"]).contains(advice));
    fs::write(folder.path().join("r.csv"), "C,A,B\n1,0,0\n0,1,0.2\n0,0.2,1\n").expect("written");
    let found = answer(folder.path(), &["labs.csv", "--correlations", "r.csv"]);
    assert!((number(&found["reference"]["U"]) - 2.0 * 0.6f64.sqrt()).abs() < 1e-12);
    for format in ["table", "html", "markdown", "csv"] {
        let output = run(folder.path(), &["labs.csv", "--format", format]);
        assert_eq!(output.status.code(), Some(0));
        assert!(String::from_utf8_lossy(&output.stdout).contains("100"));
    }
}

/// By hand: 0, 3, 6 with u = 1 have chi-squared 18 and R = 3; tau^2 = 8 by both random-effects
/// models; every estimate is 3 with u = sqrt(3), and u(d)^2 = 9 - 3.
#[test]
fn estimators_of_laboratories_that_disagree() {
    let (folder, _) = with("labs.csv", "label,x,U\nA,0,2\nB,3,2\nC,6,2\n");
    let plain = answer(folder.path(), &["labs.csv"]);
    assert_eq!(plain["estimator"], "largest-consistent-subset");
    assert_eq!(plain["recommended"]["estimator"], "mandel-paule");
    assert_eq!(plain["estimators"].as_array().expect("a list").len(), 5);
    for name in ["birge", "dersimonian-laird", "mandel-paule"] {
        let found = answer(folder.path(), &["labs.csv", "--estimator", name]);
        assert_eq!(found["estimator"], name);
        assert!((number(&found["reference"]["value"]) - 3.0).abs() < 1e-12);
        let u = number(&found["reference"]["standard_uncertainty"]);
        assert!((u - 3f64.sqrt()).abs() < 1e-12);
        assert!((number(&found["rows"][0]["U"]) - 2.0 * 6f64.sqrt()).abs() < 1e-12);
        let own = |of: &&Value| of["estimator"] == name;
        let values = found["estimators"].as_array().expect("a list");
        let own = values.iter().find(own).expect("its entry");
        if name == "birge" {
            assert!((number(&own["birge_ratio"]) - 3.0).abs() < 1e-12 && own["tau"].is_null());
        } else {
            assert!((number(&own["tau"]) - 8f64.sqrt()).abs() < 1e-12);
            assert_eq!(own["hartung_knapp"]["dof"], 2);
        }
    }
    let weighted = answer(folder.path(), &["labs.csv", "--estimator", "weighted"]);
    assert_eq!(weighted["estimator"], "weighted-mean");
    assert_eq!(weighted["reference"]["consistent"], false);
    let page = run(folder.path(), &["labs.csv", "--estimator", "mandel-paule"]);
    let page = String::from_utf8_lossy(&page.stdout).into_owned();
    assert!(page.contains("Reference value 3.0 with U = 3.5 (k = 2)"), "{page}");
    let wrong = run(folder.path(), &["labs.csv", "--estimator", "mandel-paul"]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&wrong.stderr).contains("did you mean mandel-paule?"));
    fs::write(folder.path().join("t.csv"), "label,x1,U1,x2,U2\na,1,1,2,1\n").expect("written");
    let wrong = run(folder.path(), &["t.csv", "--estimator", "birge"]);
    assert_eq!(wrong.status.code(), Some(2));
}

/// The second results come from a run: its GUM side, with its coverage factor.
#[test]
fn against_a_run() {
    let (folder, _) = with("t.csv", "label,x1,U1\na_x,4.95,0.02\na_z,8.19,0.02\n");
    let model = root().join("models/inclined_plane.json");
    let model = model.to_str().expect("a path");
    let arguments = ["run", model, "--trials", "0", "--format", "json", "--output", "run.json"];
    let made = command().current_dir(folder.path()).args(arguments).output().expect("it runs");
    assert_eq!(made.status.code(), Some(0));
    let run_answer: Value =
        serde_json::from_slice(&fs::read(folder.path().join("run.json")).expect("read"))
            .expect("JSON");
    let found = answer(folder.path(), &["t.csv", "--against", "run.json"]);
    let gum = &run_answer["outputs"]["a_x"]["gum"];
    let row = &found["rows"][0];
    assert!((number(&row["difference"]) - (4.95 - number(&gum["estimate"]))).abs() < 1e-14);
    let u = (0.01f64.powi(2) + number(&gum["standard_uncertainty"]).powi(2)).sqrt();
    assert!((number(&row["U"]) / (2.0 * u) - 1.0).abs() < 1e-12);
    // a sweep needs its conditions as columns
    let model = root().join("models/inclined_plane_campaign.json");
    let model = model.to_str().expect("a path");
    let arguments = ["run", model, "--trials", "0", "--format", "json", "--output", "sweep.json"];
    command().current_dir(folder.path()).args(arguments).output().expect("it runs");
    let refused = run(folder.path(), &["t.csv", "--against", "sweep.json"]);
    assert_eq!(refused.status.code(), Some(2));
    let text = "label,tilt_nominal,rotation_nominal,x1,U1\na_x,35,30,4.97,0.02\n";
    fs::write(folder.path().join("s.csv"), text).expect("written");
    let found = answer(folder.path(), &["s.csv", "--against", "sweep.json"]);
    assert!(number(&found["rows"][0]["difference"]).abs() < 0.01);
    // the conditions in other units: 35 deg in rad
    let text = "label,tilt_nominal [rad],rotation_nominal,x1,U1\na_x,0.6108652381980153,30 deg,4.97,0.02\n";
    fs::write(folder.path().join("r.csv"), text).expect("written");
    let other = answer(folder.path(), &["r.csv", "--against", "sweep.json"]);
    assert_eq!(other["rows"], found["rows"]);
    let text = text.replace("[rad]", "[s]");
    fs::write(folder.path().join("w.csv"), text).expect("written");
    let refused = run(folder.path(), &["w.csv", "--against", "sweep.json"]);
    assert_eq!(refused.status.code(), Some(2));
    let said = String::from_utf8_lossy(&refused.stderr);
    assert!(said.contains("`tilt_nominal` of the run is in `deg`"), "{said}");
}

/// A workbook as others write it: shared strings left out, numbers as they are.
fn workbook(path: &Path) {
    use std::io::Write;
    let file = fs::File::create(path).expect("a file");
    let mut zip = zip::ZipWriter::new(file);
    let parts = [
        ("[Content_Types].xml", r#"<?xml version="1.0"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Override PartName="/xl/workbook.xml" ContentType="application/vnd.openxmlformats-officedocument.spreadsheetml.sheet.main+xml"/><Override PartName="/xl/worksheets/sheet1.xml" ContentType="application/vnd.openxmlformats-officedocument.spreadsheetml.worksheet+xml"/></Types>"#.to_owned()),
        ("_rels/.rels", r#"<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="r1" Type="http://schemas.openxmlformats.org/officeDocument/2006/relationships/officeDocument" Target="xl/workbook.xml"/></Relationships>"#.to_owned()),
        ("xl/workbook.xml", r#"<?xml version="1.0"?><workbook xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main" xmlns:r="http://schemas.openxmlformats.org/officeDocument/2006/relationships"><sheets><sheet name="a" sheetId="1" r:id="r1"/></sheets></workbook>"#.to_owned()),
        ("xl/_rels/workbook.xml.rels", r#"<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="r1" Type="http://schemas.openxmlformats.org/officeDocument/2006/relationships/worksheet" Target="worksheets/sheet1.xml"/></Relationships>"#.to_owned()),
        ("xl/worksheets/sheet1.xml", {
            let cell = |(column, text): (usize, &str)| {
                let letter = ["A", "B", "C", "D", "E"][column];
                match text.parse::<f64>() {
                    Ok(_) => format!(r#"<c r="{letter}%ROW%"><v>{text}</v></c>"#),
                    Err(_) => format!(r#"<c r="{letter}%ROW%" t="inlineStr"><is><t>{text}</t></is></c>"#),
                }
            };
            let rows = paper().lines().enumerate().map(|(row, line)| {
                let cells: String = line.split(',').enumerate().map(cell).collect();
                let row = (row + 2).to_string();
                format!(r#"<row r="{row}">{}</row>"#, cells.replace("%ROW%", &row))
            }).collect::<String>();
            format!(r#"<?xml version="1.0"?><worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"><sheetData>{rows}</sheetData></worksheet>"#)
        }),
    ];
    for (name, text) in parts {
        zip.start_file(name, zip::write::SimpleFileOptions::default()).expect("a part");
        zip.write_all(text.as_bytes()).expect("written");
    }
    zip.finish().expect("a workbook");
}

#[test]
fn a_workbook_gives_what_its_csv_gives() {
    let (folder, _) = with("t.csv", &paper());
    workbook(&folder.path().join("t.xlsx"));
    let of = |name: &str| answer(folder.path(), &[name, "--rounding"]);
    assert_eq!(of("t.xlsx"), of("t.csv"));
    fs::write(folder.path().join("no.xlsx"), "label,x1").expect("written");
    let refused = run(folder.path(), &["no.xlsx"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("it is not a workbook"));
}

/// Mistakes name the file, the line and what would be right, and nothing is written.
#[test]
fn mistakes_of_tables() {
    let (folder, _) = with("t.csv", "label,x1,U1,x2,U2\na,1,1,2,\n");
    let refused = run(folder.path(), &["t.csv", "--output", "out.json", "--format", "json"]);
    assert_eq!(refused.status.code(), Some(2));
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(said.starts_with("t.csv:2:8:") && said.contains("`U2`"), "{said}");
    assert!(!folder.path().join("out.json").exists());
    for arguments in [
        vec!["t.csv", "--against", "missing.json"],
        vec!["t.csv", "--correlations", "t.csv"],
        vec!["missing.csv"],
    ] {
        let refused = run(folder.path(), &arguments);
        assert_eq!(refused.status.code(), Some(2), "{arguments:?}");
        assert!(!refused.stderr.is_empty() && refused.stdout.is_empty());
    }
}

/// Where no two results agree there is no consistent subset, and the page says so whatever the order
/// of the rows.
#[test]
fn one_laboratory_is_no_consistent_subset() {
    for rows in ["A,10.00,0.02\nB,10.03,0.02\n", "B,10.03,0.02\nA,10.00,0.02\n"] {
        let (folder, _) = with("labs.csv", &format!("label,x,U\n{rows}"));
        let page = run(folder.path(), &["labs.csv", "--format", "markdown"]).stdout;
        let page = String::from_utf8_lossy(&page).replace('\n', " ");
        assert!(page.contains("No two results agree"), "{page}");
        assert!(!page.contains("1 laboratories"), "{page}");
    }
}

/// The robust average of copper in wholemeal flour, 3.20549 by R and statsmodels, with s* = 0.6742 by
/// the factor 1.134 (`analysis/compare/proficiency/tests`), and u = 1.25 s*/sqrt(24).
#[test]
fn a_proficiency_test_in_every_format() {
    let table = root().join("models/examples/proficiency.csv");
    let table = table.to_str().expect("a path");
    let folder = root();
    let found = answer(folder, &[table, "--scheme", "iso13528"]);
    let assigned = &found["assigned"];
    assert_eq!(assigned["method"], "algorithm-a");
    assert!((number(&assigned["value"]) - 3.20549).abs() < 1e-4);
    let sigma = number(&found["sigma_pt"]);
    assert!((sigma - 0.67415).abs() < 1e-5);
    let u = number(&assigned["standard_uncertainty"]);
    assert!((u - 1.25 * sigma / 24f64.sqrt()).abs() < 1e-12);
    let row = &found["rows"][16];
    assert_eq!((&row["label"], &row["signal"]), (&json!("17"), &json!("action signal")));
    assert!((number(&row["z"]) - (28.95 - number(&assigned["value"])) / sigma).abs() < 1e-12);
    assert_eq!((&row["zeta"], &row["en"]), (&Value::Null, &Value::Null));
    let codes: Vec<&Value> =
        found["warnings"].as_array().expect("a list").iter().map(|note| &note["code"]).collect();
    assert_eq!(codes, ["assigned-value-chosen", "sigma-chosen"]);
    for format in ["table", "html", "markdown", "csv"] {
        let output = run(folder, &[table, "--scheme", "iso13528", "--format", format, "--fail"]);
        assert_eq!(output.status.code(), Some(3));
        let text = String::from_utf8(output.stdout).expect("UTF-8");
        assert!(text.contains("action signal"), "{text}");
        match format {
            "csv" => assert_eq!(text.lines().count(), 25),
            "html" => {
                let [from, to] = ["<svg", "</svg>"].map(|tag| text.find(tag).expect("a figure"));
                roxmltree::Document::parse(&text[from..to + 6]).expect("a well-formed figure");
                assert!(text.contains("z score"));
            }
            _ => assert!(text.contains("Assigned value 3.21 ug/g with u = 0.17 ug/g"), "{text}"),
        }
    }
}

/// By hand: 10.5 and 9.4 about 10 with u = 0.3 and sigma = 0.4; the first one with u = 0.4 has zeta
/// 1 and En 0.5. The numbers stand in other units than the options.
#[test]
fn stated_values_of_a_proficiency_test() {
    let (folder, _) = with("t.csv", "label;x [V];U [mV];k\nA;10,5;1200;3\nB;9,4;;\n");
    let options = ["--assigned", "10000 mV", "--assigned-u", "0.3 V", "--sigma", "4 %"];
    let arguments = [&["t.csv", "--scheme", "iso13528"], &options[..]].concat();
    let found = answer(folder.path(), &arguments);
    let near = |value: &Value, wanted: f64| (number(value) - wanted).abs() < 1e-12;
    let [first, second] = [&found["rows"][0], &found["rows"][1]];
    for (key, wanted) in [("z", 1.25), ("z_prime", 1.0), ("zeta", 1.0), ("en", 0.5)] {
        assert!(near(&first[key], wanted), "{key}: {first}");
    }
    assert!(near(&second["z"], -1.5) && near(&second["z_prime"], -1.2));
    assert_eq!((&second["zeta"], &second["en"]), (&Value::Null, &Value::Null));
    assert_eq!(found["deciding_score"], "z_prime");
    assert_eq!((&found["unit"], &found["assigned"]["method"]), (&json!("V"), &json!("stated")));
}

/// Results that do not scatter have no scores, and errors name what would be right.
#[test]
fn proficiency_tests_without_scores() {
    let (folder, _) = with("same.csv", "label,x\nA,5\nB,5\nC,5\n");
    let found = answer(folder.path(), &["same.csv", "--scheme", "iso13528"]);
    assert_eq!((&found["sigma_pt"], &found["rows"][0]["z"]), (&json!(0.0), &Value::Null));
    let html = run(folder.path(), &["same.csv", "--scheme", "iso13528", "--format", "html"]);
    assert!(!String::from_utf8_lossy(&html.stdout).contains("<svg"));
    let failed = run(folder.path(), &["same.csv", "--scheme", "iso13528", "--fail"]);
    assert_eq!(failed.status.code(), Some(3));
    for (table, options, wanted) in [
        ("label,x\nA,5\n", vec![], "`--assigned VALUE --sigma VALUE`"),
        ("label,x\nA,nan\nB,5\n", vec![], "is not a finite number"),
        ("label,x\nA,5\nA,6\n", vec![], "stands here a second time"),
        ("label,x\nA,5\nMedian,6\n", vec![], "`--assigned VALUE --assigned-u U`"),
        ("label,x,k\nA,5,2\nB,6,2\n", vec![], "has no column `U`"),
        ("label,x,U\nA,5,0\nB,6,2\n", vec![], "must be above zero"),
        ("label,y1\nA,5\nB,6\n", vec![], "a proficiency test has label, x"),
        ("label,x\nA,5\nB,6\n", vec!["--sigma", "5 %"], "can be a share of the value"),
        ("label,x\nA,5\nB,6\n", vec!["--sigma", "0"], "must be above 0"),
        ("label,x\nA,5\nB,6\n", vec!["--assigned", "mean"], "`median`"),
    ] {
        fs::write(folder.path().join("t.csv"), table).expect("written");
        let refused =
            run(folder.path(), &[&["t.csv", "--scheme", "iso13528"], &options[..]].concat());
        let said = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert_eq!(refused.status.code(), Some(2), "{table}: {said}");
        assert!(said.contains(wanted), "{table}: {said}");
    }
    let alone = run(folder.path(), &["same.csv", "--sigma", "niqr"]);
    assert_eq!(alone.status.code(), Some(2));
}
