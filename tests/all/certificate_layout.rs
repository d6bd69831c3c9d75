//! Certificates as laboratories issue them: which U is stated, columns of one's own, letterhead.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::certificate::{folder, path};
use crate::support::{gumption, output, root};

/// The certificates of `models/certificates` with a layout.
const LAID_OUT: [&str; 6] =
    ["accelerometer", "gauge_blocks", "multimeter", "pressure_gauge", "thermometer", "weights"];

fn of_file(name: &str, options: &[&str]) -> Value {
    let said = output(&[&["certificate", name, "--format", "json", "--quiet"], options].concat());
    serde_json::from_str(&said).expect("JSON")
}

/// Value, U, k and basis of a row.
fn stated(row: &Value) -> [&str; 4] {
    let text = |key: &str| row["stated"][key].as_str().expect("a text");
    let basis = row["basis"].as_str().expect("a text");
    [text("value"), text("expanded_uncertainty"), text("coverage_factor"), basis]
}

/// A certificate of every output of a model file.
fn of_model(model: &Path, options: &[&str]) -> Value {
    let text = fs::read_to_string(model).expect("a model");
    let file: Value = serde_json::from_str(&text).expect("JSON");
    let outputs = file["outputs"].as_object().expect("outputs").keys();
    let rows: Vec<Value> =
        outputs.map(|output| json!({"model": "m.json", "output": output})).collect();
    let folder = folder(&[("m.json", file.clone()), ("c.json", json!({"rows": rows}))]);
    of_file(&path(folder.path(), "c.json"), options)
}

/// EA-4/02 M:2022, S2, S3, S5, S7, S9 and S10: value, U and k as printed there, but that S9 takes the
/// k = 1.65 of its dominating rectangular quantity alone (with both k is 1.71), S10 rounds U to one
/// digit and k to 1.83, and S7 takes k = 2 for its 30 effective degrees of freedom and more.
#[test]
fn examples_of_ea_4_02_are_stated_as_printed() {
    let cases = root().join("tests/cases");
    let published = root().join("models/examples/published");
    let resistor = json!({
        "inputs": {
            "R_S": {"unit": "ohm", "distribution": "normal", "mean": 10000.053, "expanded": 0.005, "k": 2},
            "dR_D": {"unit": "mohm", "distribution": "rectangular", "mean": 20, "half_width": 10},
            "dR_TS": {"unit": "mohm", "distribution": "rectangular", "mean": 0, "half_width": 2.75},
            "dR_TX": {"unit": "mohm", "distribution": "rectangular", "mean": 0, "half_width": 5.5},
            "r_C": {"unit": "1", "distribution": "triangular", "mean": 1, "half_width": 1e-6},
            "r": {"unit": "1", "distribution": "readings",
                "values": [1.0000104, 1.0000107, 1.0000106, 1.0000103, 1.0000105]}},
        "equations": {"R_X": "(R_S + dR_D + dR_TS)*r_C*r - dR_TX"},
        "outputs": {"R_X": {"unit": "ohm"}}});
    let own = folder(&[("s3.json", resistor)]);
    let case = |name: &str| cases.join(name).join("model.json");
    for (model, wanted) in [
        (published.join("ea402-s2-weight.json"), ["10000.025", "0.059", "2.00", "normal"]),
        (own.path().join("s3.json"), ["10000.178", "0.017", "2.00", "normal"]),
        (case("ea402-s5-thermocouple-emf"), ["36229", "50", "2.00", "normal"]),
        (case("ea402-s7-step-attenuator"), ["30.043", "0.045", "2.02", "t"]),
        (case("ea402-s9-multimeter"), ["0.100", "0.051", "1.71", "monte-carlo"]),
        (case("ea402-s10-caliper"), ["0.100", "0.059", "1.84", "monte-carlo"]),
    ] {
        let found = of_model(&model, &[]);
        assert_eq!(stated(&found["rows"][0]), wanted, "{}", model.display());
    }
    // a dominating rectangular quantity, for which EA-4/02 has k = 2: 8 % of U
    let furnace = case("ea402-s5-furnace-temperature");
    let found = of_model(&furnace, &[]);
    assert_eq!(stated(&found["rows"][0]), ["1000.5", "1.2", "1.83", "monte-carlo"]);
    let found = of_model(&furnace, &["--statement", "gum"]);
    assert_eq!(stated(&found["rows"][0]), ["1000.5", "1.3", "2.00", "normal"]);
}

/// Three readings a, a + 1, a - 1 at four pressures, with a resolution of 1 mbar and a reference whose
/// U grows: u² = s²/3 + 1/12 + (U/2)², and k is that of t at the integer part of
/// ν = 2 u⁴/(s²/3)².
fn gauge() -> Value {
    json!({
        "conditions": {"p": {"unit": "bar", "values": [1, 4, 7, 10]}},
        "inputs": {
            "ind": {"unit": "mbar", "mean": "p", "components": [
                {"name": "readings", "distribution": "readings", "values": [-1, 0, 1]},
                {"name": "resolution", "distribution": "rectangular", "half_width": 0.5}]},
            "ref": {"unit": "mbar", "distribution": "normal", "mean": "p", "expanded": "0.4 mbar + 0.01 % of reading", "k": 2}},
        "equations": {"E": "ind - ref"},
        "outputs": {"E": {"unit": "mbar", "tolerance": {"lower": -6, "upper": 6}}}})
}

#[test]
fn statement_is_a_decision_of_file_row_and_command_line() {
    let mut model = gauge();
    model["inputs"]["ref"]["expanded"] = json!(1.2);
    let row = |statement: &str| json!({"model": "m.json", "output": "E", "set": {"p": 1}, "statement": statement});
    let rows = json!([row("auto"), row("gum"), row("monte-carlo"), {"model": "m.json", "output": "E", "set": {"p": 1}}]);
    let files = [("c.json", json!({"statement": "gum", "rows": rows})), ("m.json", model.clone())];
    let own = folder(&files);
    let name = path(own.path(), "c.json");
    let found = of_file(&name, &[]);
    // u = 0.8813, ν = 10.8: 2.28 u = 2.0; the trials have 2.9 and k = 3.3
    let by_law = ["0.0", "2.0", "2.28", "t"];
    let by_trials = ["0.0", "2.9", "3.3", "monte-carlo"];
    let all: Vec<[&str; 4]> = found["rows"].as_array().expect("rows").iter().map(stated).collect();
    assert_eq!(all, [by_law, by_law, by_trials, by_law]);
    let found = of_file(&name, &["--statement", "monte-carlo"]);
    let all: Vec<[&str; 4]> = found["rows"].as_array().expect("rows").iter().map(stated).collect();
    assert_eq!(all, [by_trials; 4]);
    let said = gumption()
        .args(["certificate", &name, "--statement", "monte-carlo", "--trials", "0"])
        .assert()
        .code(2);
    let said = String::from_utf8_lossy(&said.get_output().stderr).into_owned();
    assert!(said.contains("`statement` is `monte-carlo`, and there are no trials"), "{said}");
    // a model file has it too, and `run` states what a certificate states
    model["statement"] = json!("monte-carlo");
    model["conditions"]["p"]["values"] = json!([1]);
    let own = folder(&[("m.json", model)]);
    let page = output(&["run", &path(own.path(), "m.json"), "--quiet"]);
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(page.contains("The symmetric Monte Carlo interval is stated."), "{page}");
    let wrong = folder(&[
        (
            "c.json",
            json!({"statement": "both", "statement_tolerance": 2,
        "rows": [{"model": "m.json", "output": "E"}]}),
        ),
        ("m.json", gauge()),
    ]);
    let said = gumption().args(["certificate", &path(wrong.path(), "c.json")]).assert().code(2);
    let said = String::from_utf8_lossy(&said.get_output().stderr).into_owned();
    for wanted in ["`statement`", "auto", "monte-carlo", "statement_tolerance"] {
        assert!(said.contains(wanted), "{said}");
    }
}

#[test]
fn certificates_of_a_laboratory_are_made_in_every_format() {
    for name in LAID_OUT {
        let file = root().join(format!("models/certificates/{name}.json"));
        let file = file.to_str().expect("a path");
        for format in ["table", "markdown", "latex", "html", "csv", "json", "dcc"] {
            let page = output(&["certificate", file, "--format", format, "--quiet"]);
            assert!(page.contains("EX-2026-1") || format == "csv", "{name}, {format}");
            let pictures = page.matches("data:image/svg+xml;base64,").count();
            assert_eq!(pictures, if format == "html" { 2 } else { 0 }, "{name}, {format}");
        }
    }
}

/// u² of a weight: (0.05/2)² + 0.02²/3 + 0.02²/3 + 0.005²/3 + 0.03²/3 mg², pooled s = 0.02 mg of three
/// weighings; 12 degrees of freedom leave k at 2.00.
#[test]
fn a_table_has_limits_and_decisions() {
    let file = root().join("models/certificates/weights.json");
    let page =
        output(&["certificate", file.to_str().expect("a path"), "--format", "csv", "--quiet"]);
    let u = (0.025f64.powi(2) + (2.0 * 0.02f64.powi(2) + 0.005f64.powi(2) + 0.03f64.powi(2)) / 3.0)
        .sqrt();
    assert_eq!(format!("{:.3}", 2.0 * u), "0.069");
    let lines: Vec<&str> = page.lines().skip(1).collect();
    assert!(lines.iter().all(|line| line.contains(",0.069,mg,2.00,")), "{page}");
    let decisions: Vec<&str> = lines.iter().filter_map(|line| line.rsplit(',').next()).collect();
    assert_eq!(decisions, ["accepted", "accepted", "rejected"]);
    let page = output(&["certificate", file.to_str().expect("a path"), "--quiet"]);
    assert!(page.contains("±0,5") && page.contains("nicht konform / does not conform"), "{page}");
    // the rule stands once, and not a sentence for each row
    assert_eq!(page.matches("Decision rule: simple acceptance").count(), 1, "{page}");
}

/// U of the voltmeter at 0.1 V is 2.8 µV, 28 µV/V of the standard; at 100 V 830 µV, 8.3 µV/V.
#[test]
fn a_column_of_u_is_relative_or_in_another_unit() {
    let file = root().join("models/certificates/multimeter.json");
    let page =
        output(&["certificate", file.to_str().expect("a path"), "--format", "markdown", "--quiet"]);
    let row = |number: &str| {
        let line = page.lines().find(|line| line.starts_with(&format!("| {number} ")));
        let cells = line.expect("the row").split('|').map(str::trim);
        cells.map(str::to_owned).collect::<Vec<String>>()
    };
    let first = row("1");
    assert_eq!(first[6..9], ["2.8", "28", "2.00"], "{first:?}");
    assert_eq!(row("5")[6..9], ["830", "8.3", "2.00"]);
    // 0.85 µV of 10 V in another unit, and a level whose U is in dB
    let model = json!({"inputs": {"L": {"unit": "dBm", "distribution": "normal", "mean": -3.2, "expanded": 0.22, "k": 2}},
        "equations": {"P": "L"}, "outputs": {"P": {"unit": "dBm"}}});
    let certificate = |columns: Value| json!({"rows": [{"model": "m.json", "output": "P"}], "layout": {"columns": columns}});
    let own = folder(&[("c.json", certificate(json!(["P", "U"]))), ("m.json", model.clone())]);
    let page = output(&["certificate", &path(own.path(), "c.json"), "--quiet"]);
    let table: Vec<&str> =
        page.lines().skip_while(|line| !line.starts_with("row")).take(4).collect();
    assert!(table[0].ends_with('U') && table[1].contains("in dBm  in dB"), "{page}");
    let own = folder(&[
        ("c.json", json!({"rows": [{"model": "m.json", "output": "P"}]})),
        ("m.json", model),
    ]);
    let page = output(&["certificate", &path(own.path(), "c.json"), "--quiet"]);
    assert!(page.contains("unit (U)") && page.contains("dBm   dB"), "{page}");
}

/// The correlation of rows rests on what is one unknown of all rows, which nobody chose who did not
/// look at it.
#[test]
fn correlations_stand_on_request_with_what_rows_share() {
    let certificate =
        |asked: bool| json!({"correlations": asked, "rows": [{"model": "m.json", "output": "E"}]});
    let page = |asked: bool| {
        let own = folder(&[("c.json", certificate(asked)), ("m.json", gauge())]);
        output(&["certificate", &path(own.path(), "c.json"), "--quiet"])
    };
    assert!(!page(false).contains("Correlation of the rows"));
    let asked = page(true);
    let words = asked.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("The rows share: ind/readings, ind/resolution and ref."), "{asked}");
}

/// Each with the file, the place, and what would be right.
#[test]
fn layouts_that_do_not_fit_are_errors() {
    let base = json!({"inputs": {"k": {"unit": "V", "distribution": "normal", "mean": 1, "std": 0.1},
            "b": {"unit": "V", "distribution": "constant", "value": 2}},
        "equations": {"x": "k + b", "y": "k*2"}, "outputs": {"x": {"unit": "V"}, "y": {"unit": "V"}}});
    let row = |output: &str| json!({"model": "m.json", "output": output});
    let x = json!([row("x")]);
    let both = json!([row("x"), row("y")]);
    let columns = |columns: Value| json!({"columns": columns});
    for (rows, layout, wanted) in [
        (&x, columns(json!([])), "`columns`"),
        (&x, columns(json!(["xx"])), "no output, input or condition `xx`"),
        (&x, columns(json!(["y"])), "no row of this table states the output `y`"),
        (&x, columns(json!(["k"])), "`k` is a quantity of the model, and a content of columns too"),
        (&both, columns(json!(["U"])), "the table states several outputs: write `U(x)` or `U(y)`"),
        (&x, columns(json!(["u(x)"])), "a column is not `u(...)`, but"),
        (&x, columns(json!(["U(b)"])), "`b` is no output"),
        (&x, columns(json!(["limits(x)"])), "the output `x` has no `tolerance`"),
        (
            &x,
            columns(json!([{"quantity": "x", "unit": "m"}])),
            "`x` is in `V`, which cannot be converted to `m`",
        ),
        (
            &x,
            columns(json!([{"quantity": "x", "show": "k", "unit": "%"}])),
            "a column of `k` has no unit",
        ),
        (
            &x,
            columns(json!([{"quantity": "x", "show": "U", "relative_to": "b"}])),
            "`relative_to` needs a `unit`",
        ),
        (
            &x,
            columns(json!([{"quantity": "x", "decimals": 2}])),
            "the digits of an output follow from U",
        ),
        (&x, columns(json!([{"quantity": "x", "shows": "U"}])), "unknown key `shows`"),
        (&x, json!({"tables": [{"name": "a", "columns": ["x"]}], "columns": ["x"]}), "columns"),
        (
            &x,
            json!({"tables": [{"name": "a", "columns": ["x"]}, {"name": "b", "columns": ["x"]}]}),
            "the layout has several tables: `table` says which one, of `a` and `b`",
        ),
        (&x, json!({}), "`columns`"),
    ] {
        let certificate = json!({"rows": rows, "layout": layout});
        let own = folder(&[("c.json", certificate), ("m.json", base.clone())]);
        let said = gumption().args(["certificate", &path(own.path(), "c.json")]).assert().code(2);
        let said = String::from_utf8_lossy(&said.get_output().stderr).into_owned();
        assert!(said.contains(wanted) && said.contains("c.json:1:"), "{layout}: {said}");
    }
    for (head, wanted) in [
        (json!({"logo": "none.png"}), "none.png"),
        (json!({"logo": "m.json"}), "`m.json` is neither a PNG nor an SVG picture"),
        (json!({"logo": "/etc/hostname"}), "/etc/hostname"),
    ] {
        let certificate = json!({"rows": x, "letterhead": head});
        let own = folder(&[("c.json", certificate), ("m.json", base.clone())]);
        let said = gumption().args(["certificate", &path(own.path(), "c.json")]).assert().code(2);
        let said = String::from_utf8_lossy(&said.get_output().stderr).into_owned();
        assert!(said.contains(wanted), "{head}: {said}");
    }
}
