//! Markdown, LaTeX and HTML: what they show is what the JSON answer has, rounded once.

use crate::words::Language;
use gumption_engine::fact;
use std::path::Path;

use roxmltree::Document;
use serde_json::Value;

use super::*;
use crate::{BudgetColumn, Extent, Shown, html, latex, markdown};
use gumption_engine::propagate::{convergence, histograms};
use gumption_files::read_text;

/// The rows of all tables of a page, cell by cell, as a reader sees them.
type Rows = Vec<Vec<String>>;

/// The three pages of a case with their rows.
fn pages(case: &Case, columns: &[BudgetColumn]) -> [(&'static str, String, Rows); 3] {
    let report = case.report();
    let drawn = histograms(&case.task, &case.evaluation, 0, &Control::default()).unwrap();
    let histograms = [drawn.unwrap_or_default()];
    let replaced = ["tilt=35 deg".to_owned()];
    let model = "{\"title\": \"<model>\"}\n";
    let settled = convergence(&case.task, &case.evaluation, 0, &Control::default()).unwrap();
    let settled = settled.unwrap_or_default();
    let shown = Shown {
        extent: Extent::default(),
        columns,
        histograms: &histograms,
        convergence: &settled,
        replaced: &replaced,
        language: Language::English,
        model,
    };
    let markdown = markdown(&report, &shown);
    let latex = latex(&report, &shown);
    let html = html(&report, &shown);
    let of_markdown = rows_of_markdown(&markdown);
    let of_latex = rows_of_latex(&latex);
    let of_html = rows_of_html(&html);
    [("markdown", markdown, of_markdown), ("latex", latex, of_latex), ("html", html, of_html)]
}

fn rows_of_markdown(page: &str) -> Rows {
    let lines = page.lines().filter(|line| line.starts_with('|'));
    lines
        .map(|line| {
            let cells = line.trim_matches('|').replace("\\|", "\u{1}");
            let cells = cells.split('|').map(|cell| cell.trim().replace(['\\', '\u{1}'], ""));
            cells.collect()
        })
        .collect()
}

fn rows_of_latex(page: &str) -> Rows {
    let lines = page.lines().filter(|line| line.ends_with("\\\\") && line.contains('&'));
    lines
        .map(|line| {
            let cells = line.trim_end_matches("\\\\").replace("\\&", "\u{1}");
            let plain = |cell: &str| {
                let cell = cell.replace("\\_", "_").replace("\\%", "%").replace("{--}", "-");
                cell.replace("$\\infty$", "∞").replace('\u{1}', "&").trim().to_owned()
            };
            cells.split('&').map(plain).collect()
        })
        .collect()
}

fn body(page: &str) -> &str {
    let from = page.find("<body>").unwrap();
    &page[from..page.find("</body>").unwrap() + "</body>".len()]
}

/// The rows of a page that is well-formed, loads nothing and runs nothing.
fn rows_of_html(page: &str) -> Rows {
    assert!(page.starts_with("<!DOCTYPE html>") && page.ends_with("</html>\n"));
    let body = body(page);
    let document = Document::parse(body).unwrap_or_else(|error| panic!("{error}:\n{body}"));
    for element in document.descendants().filter(roxmltree::Node::is_element) {
        let name = element.tag_name().name();
        assert!(!["script", "iframe", "img", "link", "image", "use"].contains(&name), "{name}");
        for attribute in element.attributes() {
            let key = attribute.name();
            assert!(!key.starts_with("on") && !["src", "style"].contains(&key), "{key}");
            // only within the page
            assert!(key != "href" || attribute.value().starts_with("#section-"), "{attribute:?}");
            assert!(!attribute.value().contains("NaN"), "{attribute:?}");
        }
    }
    let rows = document.descendants().filter(|node| node.has_tag_name("tr"));
    rows.map(|row| {
        let cells = row.children().filter(roxmltree::Node::is_element);
        let text = |cell: roxmltree::Node<'_, '_>| {
            let parts = cell.descendants().filter_map(|n| n.text().filter(|_| n.is_text()));
            parts.collect::<String>().trim().to_owned()
        };
        cells.map(text).collect()
    })
    .collect()
}

/// Whether a text is the number rounded once to the place of its last digit. The allowance is for
/// the decimal literal that the test compares with.
fn agrees(text: &str, value: f64) -> bool {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len() as i32);
    let place = exponent.parse::<i32>().unwrap() - decimals;
    let read: f64 = text.parse().unwrap();
    // zeros left of the point may stand for rounded digits
    let zeros = mantissa.len() - mantissa.trim_end_matches('0').len();
    let place = if decimals == 0 && read != 0.0 { place + zeros as i32 } else { place };
    (read - value).abs() <= 0.5 * 10_f64.powi(place) * (1.0 + 1e-9)
}

/// Cells of a row of the equations, which stand above the budgets.
const EQUATION: usize = 2;

/// The first row behind row `from` that begins with a cell.
fn row<'r>(rows: &'r Rows, from: usize, name: &str) -> &'r [String] {
    let found = rows.iter().skip(from).find(|row| row.first().is_some_and(|cell| cell == name));
    found.unwrap_or_else(|| panic!("{name} in {rows:#?}"))
}

fn assert_agrees(what: &str, text: &str, value: &Value) {
    match value.as_f64() {
        Some(value) => assert!(agrees(text, value), "{what}: {text} for {value}"),
        None => assert!(["-", "∞", "undefined", "{undefined}"].contains(&text), "{what}: {text}"),
    }
}

/// The numbers of an output's section against the JSON answer.
fn assert_output(format: &str, rows: &Rows, answer: &Value, name: &str) {
    let output = &answer["outputs"][name];
    // the section begins with the budget, which ends with the output
    let of_output = |row: &Vec<String>| row.len() > EQUATION && row[0] == name;
    let end = rows.iter().position(of_output).unwrap();
    let head = rows[..end].iter().rposition(|row| row[0].contains("quantity")).unwrap();
    for line in output["gum"]["budget"].as_array().unwrap() {
        let Some(input) = line["input"].as_str() else {
            let pair = &line["correlation"];
            let name = format!("r({}, {})", pair[0].as_str().unwrap(), pair[1].as_str().unwrap());
            let cells = row(rows, head, &name);
            assert_agrees(&name, &cells[1], &line["coefficient"]);
            let share = Value::from(100.0 * line["share"].as_f64().unwrap());
            assert_agrees(&name, cells.last().unwrap(), &share);
            continue;
        };
        let cells = row(rows, head, input);
        let share = Value::from(100.0 * line["share"].as_f64().unwrap());
        let what = |which: &str| format!("{format}, {name}, {input}: {which}");
        assert_agrees(&what("estimate"), &cells[1], &line["estimate"]);
        assert_agrees(&what("u"), &cells[2], &line["standard_uncertainty"]);
        assert_agrees(&what("sensitivity"), &cells[6], &line["sensitivity"]);
        assert_agrees(&what("contribution"), &cells[7], &line["contribution"]);
        assert_agrees(&what("share"), &cells[8], &share);
    }
    let total = row(rows, head, name);
    assert_agrees("estimate", &total[1], &output["gum"]["estimate"]);
    assert_agrees("u", &total[2], &output["gum"]["standard_uncertainty"]);
    let gum = &output["gum"];
    for (label, key) in [
        ("combined standard uncertainty", "standard_uncertainty"),
        ("coverage factor", "coverage_factor"),
        ("expanded uncertainty", "expanded_uncertainty"),
    ] {
        assert_agrees(label, &row(rows, end, label)[1], &gum[key]);
    }
    let Some(trials) = output["monte_carlo"].as_object() else { return };
    let errors = &trials["numerical_standard_error"];
    let ends = |key: &str, end: usize| [trials[key][end].clone(), errors[key][end].clone()];
    for (label, [value, error]) in [
        ("estimate", [trials["estimate"].clone(), errors["estimate"].clone()]),
        ("median", [trials["median"].clone(), errors["median"].clone()]),
        ("coverage interval, symmetric: from", ends("symmetric_interval", 0)),
        ("coverage interval, symmetric: to", ends("symmetric_interval", 1)),
        ("coverage interval, shortest: from", ends("shortest_interval", 0)),
        ("coverage interval, shortest: to", ends("shortest_interval", 1)),
    ] {
        let cells = row(rows, end, label);
        assert_agrees(label, &cells[2], &value);
        assert_agrees(label, &cells[3], &error);
    }
}

fn assert_numbers(case: &Case, outputs: &[&str]) {
    let answer = case.json();
    for (format, _, rows) in pages(case, &[]) {
        for output in outputs {
            assert_output(format, &rows, &answer, output);
        }
    }
}

#[test]
fn numbers_are_those_of_the_json() {
    let all = ["a_x", "a_y", "a_z"];
    assert_numbers(&Case::new(plane_at(35.0, 20_000)), &all);
    assert_numbers(&Case::new(grouped(20_000)), &all);
    assert_numbers(&Case::new(correlated(20_000)), &["a_x", "a_z"]);
    assert_numbers(&Case::new(plane_at(35.0, 0)), &all);
}

#[test]
fn a_page_has_what_is_needed_to_repeat_it() {
    let mut case = Case::new(plane_at(35.0, 20_000));
    case.task.title = "50 % of <a_b> & $c$".to_owned();
    case.warnings.push(Warning::new("", fact!("underflow", name = "a_b")));
    for (format, page, rows) in pages(&case, &[]) {
        assert_eq!(row(&rows, 0, "model file, SHA-256")[1], "0123", "{format}");
        assert_eq!(row(&rows, 0, "data.csv, SHA-256")[1], "4567", "{format}");
        assert_eq!(row(&rows, 0, "seed")[1], "1", "{format}");
        assert_eq!(row(&rows, 0, "trials")[1], "20000", "{format}");
        assert_eq!(row(&rows, 0, "replaced")[1], "tilt=35 deg", "{format}");
        assert!(page.contains(env!("CARGO_PKG_VERSION")), "{format}");
        assert!(page.contains("smallest number"), "{format}");
        assert!(page.contains("clause 8: the GUM interval is"), "{format}");
        assert_eq!(page.contains("&lt;model&gt;"), format == "html");
    }
}

#[test]
fn html_has_its_figures() {
    let case = Case::new(correlated(20_000));
    let [.., (_, page, _)] = pages(&case, &[]);
    // shares, distribution and settling of a_x and a_z; a_y does not vary; the inputs
    // each once for a page and once for a narrow screen
    assert_eq!(page.matches("<svg").count(), 14);
    // what a method found is marked, so that a script can hide it
    for method in ["GUM", "Monte Carlo"] {
        assert_eq!(page.matches(&format!("data-method=\"{method}\"")).count(), 4, "{method}");
    }
    for needed in
        ["GUM: normal", "Monte Carlo, symmetric", "Monte Carlo, shortest", "r(a_ref, tilt)"]
    {
        assert!(page.contains(needed), "{needed}");
    }
    let without = Case::new(plane_at(35.0, 0));
    let [.., (_, page, _)] = pages(&without, &[]);
    // shares of a_x and a_z, and of a_y, which is a_ref times the sine of an angle of 0
    assert!(!page.contains("Monte Carlo trials (bars)") && !page.contains("figures settle"));
}

#[test]
fn columns_have_their_places() {
    let case = Case::new(grouped(0));
    for (format, _, rows) in pages(&case, &BudgetColumn::ALL) {
        let is_header = |row: &&Vec<String>| row.len() > EQUATION && row[0].contains("quantity");
        let header = rows.iter().find(is_header).unwrap();
        assert_eq!(header.len(), 16, "{format}: {header:?}");
        let tilt = row(&rows, 0, "tilt");
        assert!(tilt.contains(&"angles".to_owned()), "{format}: {tilt:?}");
    }
}

#[test]
fn a_sweep_has_a_row_for_each_row_of_conditions() {
    let case = sweep(&[15.0, 35.0, 55.0], 20_000);
    let rows_of = case.json()["rows"].as_array().unwrap().clone();
    for (format, _, rows) in pages(&case, &[]) {
        for (number, answer) in rows_of.iter().enumerate() {
            let gum = &answer["outputs"]["a_x"]["gum"];
            let wanted = answer["conditions"]["tilt"].to_string().replace(".0", "");
            let found = rows.iter().find(|row| row.get(1) == Some(&wanted)).unwrap();
            assert_agrees("estimate", &found[2], &gum["estimate"]);
            assert_agrees("u", &found[3], &gum["standard_uncertainty"]);
            assert_agrees("U", &found[4], &gum["expanded_uncertainty"]);
            let interval = &answer["outputs"]["a_x"]["monte_carlo"]["symmetric_interval"];
            assert_agrees("from", &found[6], &interval[0]);
            assert_agrees("to", &found[7], &interval[1]);
            assert!(number < 3, "{format}");
        }
    }
}

/// A square root at zero has no sensitivity coefficient; a constant no distribution.
#[test]
fn what_is_not_defined_is_said() {
    let text = r#"{"inputs": {"x": {"distribution": "normal", "mean": 0, "std": 1},
        "c": {"distribution": "constant", "value": 2}},
        "equations": {"y": "sqrt(max(x, 0))", "z": "c"}, "outputs": {"y": {}, "z": {}},
        "monte_carlo": {"trials": 2000}}"#;
    let file = read_text("file", text, Path::new(""), &[]).unwrap();
    let case = Case::new(file.task);
    assert!(case.evaluation.rows[0].outputs[0].gum.is_none());
    for (format, page, _) in pages(&case, &[]) {
        assert!(page.contains("There is no budget"), "{format}");
        assert!(page.contains("use the Monte Carlo"), "{format}");
    }
}

/// A task that was made in Rust has no file, and Markdown no figures: it has no line without a digest
/// and no heading without a section.
#[test]
fn markdown_of_a_task_without_a_file() {
    let task = plane_at(35.0, 0);
    let evaluation = evaluate(&task, &Control::default()).unwrap();
    let provenance = Provenance::default();
    let warnings = [];
    let report = EvaluationReport {
        task: &task,
        evaluation: &evaluation,
        warnings: &warnings,
        provenance: &provenance,
    };
    let page = markdown(&report, &Shown::default());
    assert!(!page.contains("What is known") && !page.contains("model file"), "{page}");
    let lines: Vec<&str> = page.lines().filter(|line| !line.is_empty()).collect();
    let is_heading = |line: &str| line.starts_with("## ");
    assert!(lines.windows(2).all(|pair| !(is_heading(pair[0]) && is_heading(pair[1]))), "{page}");
    assert!(html(&report, &Shown::default()).contains("What is known about the inputs"));
}

/// The case of a model as text.
fn case_of(text: &str) -> Case {
    let file = read_text("file", text, Path::new(""), &[]).unwrap();
    Case::new(file.task)
}

/// A limit that lies beyond the axis has an arrow with its number at the edge, one on the axis none; and
/// an interval that lies beyond it as a whole has both numbers.
#[test]
fn a_limit_beyond_the_axis_is_an_arrow_with_its_number() {
    let page = |limits: &str| {
        let case = case_of(
            &r#"{"inputs": {"R": {"distribution": "normal", "mean": 100.013, "std": 0.002}},
            "equations": {"y": "R"}, "outputs": {"y": {"tolerance": LIMITS}},
            "monte_carlo": {"trials": 20000}}"#
                .replace("LIMITS", limits),
        );
        let [.., (_, page, _)] = pages(&case, &[]);
        page
    };
    // once for a page and once for a narrow screen
    let texts = |page: &str, text: &str| {
        page.matches(&format!("fill=\"#D55E00\">\n{text}\n</text>")).count()
    };
    let inside = page(r#"{"lower": 100.005, "upper": 100.02}"#);
    assert_eq!([texts(&inside, "100.005"), texts(&inside, "100.02")], [0, 0]);
    let below = page(r#"{"lower": 99.873, "upper": 100.02}"#);
    assert_eq!([texts(&below, "99.873"), texts(&below, "100.02")], [2, 0]);
    let both = page(r#"{"lower": 101.25, "upper": 102.5}"#);
    assert_eq!(texts(&both, "101.25 … 102.5"), 2);
}

/// Correlated inputs: the shares of a row, those of the correlations among them, add up to 100 %, to the
/// rounding of each; and where there are more than columns, the others stand together.
#[test]
fn shares_of_a_sweep_add_up() {
    let few = r#"{"inputs": {
            "a": {"distribution": "normal", "mean": 1, "std": 0.1},
            "b": {"distribution": "normal", "mean": 2, "std": 0.2},
            "c": {"distribution": "normal", "mean": 3, "std": 0.1}},
        "correlations": [["a", "b", -0.7], ["b", "c", 0.3]],
        "conditions": {"t": {"values": [1, 2, 5]}},
        "equations": {"y": "a + b*t + c"}, "outputs": {"y": {}}, "monte_carlo": {"trials": 0}}"#;
    let inputs: Vec<String> = (1..=12)
        .map(|n| format!(r#""x{n}": {{"distribution": "normal", "mean": 1, "std": 0.{n:02}}}"#))
        .collect();
    let sum: Vec<String> = (1..=12).map(|n| format!("x{n}")).collect();
    let many = format!(
        r#"{{"inputs": {{{}}}, "conditions": {{"t": {{"values": [1, 2]}}}},
        "correlations": [["x11", "x12", 0.5]],
        "equations": {{"y": "t*({})"}}, "outputs": {{"y": {{}}}}, "monte_carlo": {{"trials": 0}}}}"#,
        inputs.join(", "),
        sum.join(" + ")
    );
    for (text, column) in [(few, "r(a, b)"), (&many, "5 others")] {
        let case = case_of(text);
        let sheet = crate::table::sweep::shares(&case.task, &case.evaluation.rows, 0).unwrap();
        let titles: Vec<String> = sheet.columns.iter().map(|column| column.title()).collect();
        assert!(titles.iter().any(|title| title == column), "{titles:?}");
        for row in 0..sheet.rows() {
            let shares = sheet.columns.iter().skip(1);
            let shares: Vec<f64> = shares.map(|of| of.cell(row).parse().unwrap()).collect();
            let (sum, count) = (shares.iter().sum::<f64>(), shares.len() as f64);
            assert!((sum - 100.0).abs() <= 0.05 * count, "{titles:?}: {shares:?}");
        }
    }
}

/// Squares about zero, which clause 8 refutes, and far from it, where it does not: a sweep says which rows
/// have the interval of the trials, and its figure shows that.
#[test]
fn a_sweep_takes_the_interval_that_is_valid() {
    let text = |means: &str| {
        r#"{"inputs": {"x": {"distribution": "normal", "mean": 0, "std": 1}},
        "conditions": {"t": {"values": MEANS}},
        "equations": {"y": "(x + t)^2"}, "outputs": {"y": {}}, "monte_carlo": {"trials": 20000}}"#
            .replace("MEANS", means)
    };
    let said = |means: &str| {
        let [.., (_, page, _)] = pages(&case_of(&text(means)), &[]);
        page
    };
    let taken = "The coverage interval to be taken is that of the Monte Carlo method";
    let all = said("[0.1, 0.2]");
    assert!(all.contains(taken) && all.contains("in every row."), "{all}");
    assert!(all.contains("where the GUM interval is not valid (vermilion); below: half"));
    assert!(!all.contains("with their expanded uncertainties U"));
    let some = said("[0.1, 0.2, 5000, 6000, 7000]");
    assert!(some.contains(taken) && some.contains("in rows 1, 2."));
    assert!(some.contains("(vermilion); blue: estimates with their expanded uncertainties U"));
    let none = said("[5000, 6000]");
    assert!(!none.contains(taken) && none.contains("Above: estimates with their expanded"));
}

/// A run that was stopped says how many trials its figures are of, and not that all were made.
#[test]
fn a_stopped_run_says_the_trials_that_were_made() {
    let mut case = Case::new(plane_at(35.0, 20_000));
    case.evaluation.stopped = true;
    case.evaluation.settings.trials = Trials::Fixed(1_000_000_000);
    let [made, asked] = [20_000, 1_000_000_000].map(crate::grouped);
    let table = crate::table(&case.report(), &Shown::default());
    let all = pages(&case, &[]).map(|(format, page, _)| (format, page));
    for (format, page) in all.into_iter().chain([("table", table)]) {
        let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
        let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        let said = format!("; {made} Monte Carlo trials, seed 1, as it was stopped; {asked} were");
        if format != "latex" {
            assert!(page.contains(&words(&said)), "{format}: {page}");
        }
        assert!(!page.contains(&words(&format!("{asked} Monte Carlo trials"))), "{format}");
    }
}
