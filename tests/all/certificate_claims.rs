//! What the sentences and the numbers of a certificate claim is true of each other, and what reads a
//! digital certificate finds what was stated.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::support::command;

/// A certificate file with all that a digital certificate needs, and more keys.
fn certificate(rows: Value, more: Value) -> Value {
    let mut file = json!({
        "number": "1", "device": {"name": "d", "manufacturer": "M", "model": "m", "serial_number": "1"},
        "customer": {"name": "C", "city": "R", "country": "IT", "email": "c@e.org"},
        "laboratory": {"name": "L", "city": "T", "country": "IT", "email": "l@e.org"},
        "responsible": "R", "calibration_date": "2026-03-02", "rows": rows
    });
    for (key, value) in more.as_object().into_iter().flatten() {
        file[key] = value.clone();
    }
    file
}

fn normal(unit: &str, mean: f64, std: f64) -> Value {
    json!({"unit": unit, "distribution": "normal", "mean": mean, "std": std})
}

/// Three degrees of freedom: U = 3.31 u.
fn student(dof: f64) -> Value {
    json!({"unit": "V", "distribution": "normal", "mean": 10, "std": 0.01, "dof": dof})
}

/// A model whose output is `y`, with a tolerance if there is one.
fn model(inputs: Value, equation: &str, tolerance: Option<Value>) -> Value {
    let mut output = json!({"unit": "V"});
    output.as_object_mut().expect("an object").extend(tolerance.map(|t| ("tolerance".into(), t)));
    json!({"inputs": inputs, "equations": {"y": equation}, "outputs": {"y": output}})
}

fn folder(files: &[(&str, &Value)]) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, content) in files {
        fs::write(folder.path().join(name), content.to_string()).expect("a file");
    }
    folder
}

fn said(folder: &Path, arguments: &[&str]) -> (bool, String, String) {
    let done = command().args(arguments).current_dir(folder).output().expect("a run");
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    (done.status.success(), text(done.stdout), text(done.stderr))
}

fn output(folder: &Path, arguments: &[&str]) -> String {
    let (success, out, error) = said(folder, arguments);
    assert!(success, "{arguments:?}: {error}");
    out
}

fn answer(folder: &Path, arguments: &[&str]) -> Value {
    let out = output(folder, &[arguments, &["--format", "json", "--quiet"]].concat());
    serde_json::from_str(&out).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn rows(outputs: &[&str]) -> Value {
    outputs.iter().map(|of| json!({"model": "m.json", "output": of})).collect()
}

/// The texts of elements with a name.
fn elements(xml: &str, name: &str) -> Vec<String> {
    let document = roxmltree::Document::parse(xml).expect("XML");
    let nodes = document.descendants().filter(|node| node.tag_name().name() == name);
    nodes.map(|node| node.text().unwrap_or_default().to_owned()).collect()
}

/// U, k and the degrees of freedom of a certificate's t row come back (they lost one).
#[test]
fn t_rows_of_a_digital_certificate_are_read_back() {
    let back = json!({"inputs": {"r": {"distribution": "dcc", "file": "c.xml",
        "ref_type": "basic_measuredValue"}}, "equations": {"z": "r"}, "outputs": {"z": {"unit": "V"}},
        "monte_carlo": {"trials": 0}});
    for dof in [2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 30.0] {
        let mut file = model(json!({"x": student(dof)}), "x", None);
        file["monte_carlo"] = json!({"trials": 0});
        let certificate = certificate(rows(&["y"]), json!({}));
        let folder = folder(&[("m.json", &file), ("c.json", &certificate), ("b.json", &back)]);
        let stated = answer(folder.path(), &["certificate", "c.json"]);
        let xml = output(folder.path(), &["certificate", "c.json", "--format", "dcc", "--quiet"]);
        fs::write(folder.path().join("c.xml"), xml).expect("a file");
        let found = &answer(folder.path(), &["run", "b.json"])["outputs"]["z"]["gum"];
        let stated = &stated["rows"][0]["stated"];
        let k = format!("{:.2}", number(&found["coverage_factor"]));
        assert_eq!(json!(k), stated["coverage_factor"], "{dof}");
        let expanded: f64 = stated["expanded_uncertainty"].as_str().unwrap().parse().unwrap();
        // k is rounded to 0.005 of at least 2
        let ratio = number(&found["expanded_uncertainty"]) / expanded;
        assert!((ratio - 1.0).abs() < 0.0025, "{dof}: {found}");
        assert!(dof > 12.0 || number(&found["dof"]) == dof, "{found}");
    }
    let written = json!({"inputs": {"x": "10.000 V ± 0.033 V (k=3.31, p=95.45 %)"},
        "equations": {"z": "x"}, "outputs": {"z": {"unit": "V"}}, "monte_carlo": {"trials": 0}});
    let folder = folder(&[("b.json", &written)]);
    let found = &answer(folder.path(), &["run", "b.json"])["outputs"]["z"]["gum"];
    assert_eq!(number(&found["dof"]), 3.0);
    assert!((number(&found["expanded_uncertainty"]) / 0.033 - 1.0).abs() < 0.002, "{found}");
}

/// 10^(-pH) of three readings has no expectation: certificate, page, tables and decision have the
/// estimate by the law of propagation, 10^-2.80 mol/L = 1.5849 mmol/L, with the interval between
/// 10^-(2.80 +- 4.527 * 0.01/sqrt(3)) mol/L, 1.4924 to 1.6832 mmol/L, t = 4.527 being the quantile of two
/// degrees of freedom. The certificate said 8.2 mmol/L, U = 6.7, k = 316, and rejected. The ends have
/// numerical standard errors of 1.1 % of their distance from the middle with 200 000 trials.
#[test]
fn a_mean_that_does_not_exist_is_stated_nowhere() {
    let readings = json!({"distribution": "readings", "values": [2.79, 2.81, 2.80]});
    let file = json!({"inputs": {"pH": readings}, "equations": {"c": "10^(-pH)*1 [mol/L]"},
        "outputs": {"c": {"unit": "mmol/L", "tolerance": {"upper": 2}}}});
    let certificate = certificate(rows(&["c"]), json!({}));
    let folder = folder(&[("m.json", &file), ("c.json", &certificate)]);
    for seed in ["1", "2", "3", "4"] {
        let options = ["--trials", "200000", "--seed", seed];
        let certificate = [&["certificate", "c.json"], &options[..]].concat();
        let row = answer(folder.path(), &certificate)["rows"][0].clone();
        assert!((number(&row["value"]) - 1.584_893).abs() < 1e-6, "{row}");
        assert!((number(&row["expanded_uncertainty"]) - 0.0972).abs() < 0.005, "{row}");
        // U over u = ln(10) 1.5849 * 0.01/sqrt(3) = 0.021070
        assert!((number(&row["coverage_factor"]) - 4.6).abs() < 0.3, "{row}");
        let run = [&["run", "m.json"], &options[..]].concat();
        let found = answer(folder.path(), &run)["outputs"]["c"].clone();
        assert!(found["monte_carlo"]["estimate"].is_null(), "{found}");
        assert!(found["monte_carlo"]["standard_uncertainty"].is_null(), "{found}");
        let ends = found["monte_carlo"]["symmetric_interval"].clone();
        assert!((number(&ends[0]) - 1.4924).abs() < 0.006, "{ends}");
        assert!((number(&ends[1]) - 1.6832).abs() < 0.006, "{ends}");
        let decided = &found["conformity"];
        assert_eq!(decided["conforms"], true, "{decided}");
        let page = output(folder.path(), &run);
        assert!(page.contains("c           1.585"), "{page}");
        let is_estimate = |line: &&str| line.starts_with("estimate ") && line.contains("1.58");
        let line = page.lines().find(is_estimate).expect("the estimates side by side");
        assert_eq!(line.split_whitespace().nth(2), Some("-"), "{line}");
    }
}

/// An agreed factor k = 2 of three degrees of freedom covers 2/pi (t/(sqrt 3 (1 + t^2/3)) + atan(t/sqrt
/// 3)) = 0.8607 at t = 2; D-SI asks for the probability, and had that of a normal distribution.
#[test]
fn an_agreed_factor_has_its_own_probability_in_dsi() {
    let file = model(json!({"x": student(3.0)}), "x", None);
    let fixed = json!({"coverage_factor": 2, "coverage_factor_fixed": true});
    let certificate = certificate(rows(&["y"]), fixed);
    let folder = folder(&[("m.json", &file), ("c.json", &certificate)]);
    for trials in [&["--trials", "0"][..], &[]] {
        let arguments = [&["certificate", "c.json"], trials].concat();
        let row = answer(folder.path(), &arguments)["rows"][0].clone();
        assert_eq!(row["basis"], "fixed-factor", "{row}");
        assert_eq!(
            (&row["stated"]["expanded_uncertainty"], &row["stated"]["coverage_factor"]),
            (&json!("0.020"), &json!("2.00"))
        );
        let xml =
            output(folder.path(), &[&arguments[..], &["--format", "dcc", "--quiet"]].concat());
        assert_eq!(elements(&xml, "coverageProbabilityXMLList"), ["0.86067"]);
        assert_eq!(elements(&xml, "distributionXMLList"), ["t"]);
        assert!(!xml.contains("no coverage probability is stated"), "{xml}");
        assert!(xml.contains("Effective degrees of freedom ν_eff: row 1: 3."), "{xml}");
    }
    // of a rectangle nothing is known but by trials: no probability, and no number that needs one
    let r = json!({"unit": "V", "distribution": "rectangular", "mean": 10, "half_width": 0.01});
    fs::write(folder.path().join("m.json"), model(json!({"x": r}), "x", None).to_string()).unwrap();
    let row = answer(folder.path(), &["certificate", "c.json"])["rows"][0].clone();
    assert_eq!(
        (&row["basis"], &row["coverage_probability"]),
        (&json!("fixed-factor"), &Value::Null)
    );
    let xml = output(folder.path(), &["certificate", "c.json", "--format", "dcc", "--quiet"]);
    assert!(elements(&xml, "coverageProbabilityXMLList").is_empty());
    assert!(
        xml.contains("U = 0.012 V, k = 2.00") && xml.contains("no coverage probability"),
        "{xml}"
    );
}

/// Sentences of a digital certificate point to no table.
#[test]
fn a_digital_certificate_speaks_of_no_table() {
    let inputs = json!({"x": student(3.0), "r": {"unit": "V", "distribution": "rectangular",
        "mean": 0, "half_width": 1}});
    let mut file = model(inputs, "x", None);
    file["equations"]["w"] = json!("r");
    file["outputs"]["w"] = json!({"unit": "V"});
    let certificate = certificate(rows(&["y", "w"]), json!({"language": ["en", "de", "it", "fr"]}));
    let folder = folder(&[("m.json", &file), ("c.json", &certificate)]);
    let xml = output(folder.path(), &["certificate", "c.json", "--format", "dcc", "--quiet"]);
    for word in [" table", "Tabelle", "tabella", "tableau"] {
        let texts = elements(&xml, "content");
        assert!(texts.iter().all(|text| !text.contains(word)), "{word}: {texts:?}");
    }
    for said in ["ν_eff: row 1: 3", "ν_eff: Zeile 1: 3"] {
        assert!(xml.contains(said), "{said}");
    }
    let csv = output(folder.path(), &["certificate", "c.json", "--format", "csv", "--quiet"]);
    let dof: Vec<&str> = csv.lines().skip(1).filter_map(|line| line.split(',').nth(8)).collect();
    assert_eq!(dof, ["3", ""]);
}

/// Standard uncertainty of a difference, by the sentence of the certificate.
fn of_difference(found: &Value) -> f64 {
    let u = |row: usize| number(&found["rows"][row]["correlated_standard_uncertainty"]);
    let r = number(&found["correlations"][0][1]);
    (u(0) * u(0) + u(1) * u(1) - 2.0 * r * u(0) * u(1)).sqrt()
}

/// Of rows with few degrees of freedom, and of rows raised to the capability.
#[test]
fn the_sentence_about_differences_holds() {
    let file = json!({"inputs": {
        "ref": {"unit": "V", "distribution": "readings", "values": [10.00, 10.02, 9.99, 10.01]},
        "res": {"unit": "V", "distribution": "rectangular", "mean": 0, "half_width": 0.01, "per": "row"}},
        "conditions": {"f": {"unit": "Hz", "values": [1, 2]}},
        "equations": {"y": "ref + res + 0*f*1 [V/Hz]"}, "outputs": {"y": {"unit": "V"}}});
    let plain = certificate(rows(&["y"]), json!({"correlations": true}));
    let dir = folder(&[("m.json", &file), ("c.json", &plain)]);
    let found = answer(dir.path(), &["certificate", "c.json"]);
    // only the resolution differs: sqrt(2) 0.01/sqrt(3)
    assert!((of_difference(&found) / 0.01 - (2.0_f64 / 3.0).sqrt()).abs() < 1e-9, "{found}");
    let page = output(dir.path(), &["certificate", "c.json", "--quiet"]);
    assert!(page.contains("u_i") && page.contains("0.00866"), "{page}");
    // u = 0.01 V in common, U raised to 0.06 V with k = 2: sqrt(2 (0.03^2 - 0.01^2)) = 0.04
    let mut file = model(json!({"x": normal("V", 10.0, 0.01)}), "x + 0*f*1 [V/Hz]", None);
    file["conditions"] = json!({"f": {"unit": "Hz", "values": [1, 2]}});
    let raised = json!([{"model": "m.json", "output": "y", "cmc": 0.06, "cmc_floor": true}]);
    let dir = folder(&[
        ("m.json", &file),
        ("c.json", &certificate(raised, json!({"correlations": true}))),
    ]);
    let found = answer(dir.path(), &["certificate", "c.json"]);
    assert!((of_difference(&found) - 0.04).abs() < 1e-12, "{found}");
    let page = output(dir.path(), &["certificate", "c.json", "--quiet"]).replace("\n", " ");
    assert!(page.contains("is assumed to be uncorrelated"), "{page}");
}

/// What is raised to the capability was neither evaluated nor confirmed, and its k is said.
#[test]
fn rows_raised_to_the_capability_are_said_to_be() {
    let mut file = model(json!({"x": student(5.0)}), "x", None);
    file["outputs"]["y"] = json!({"unit": "V", "cmc": 0.06, "cmc_floor": true});
    let certificate = certificate(rows(&["y"]), json!({}));
    let folder = folder(&[("m.json", &file), ("c.json", &certificate)]);
    let found = answer(folder.path(), &["certificate", "c.json"]);
    let said = found["statements"]["en"].to_string();
    assert!(said.contains("with the coverage factor k = 2.00 of the capability"), "{said}");
    assert!(!said.contains("confirms") && !said.contains("law of propagation"), "{said}");
    let page = output(folder.path(), &["run", "m.json", "--format", "markdown", "--quiet"]);
    let headline = "(10.000 ± 0.060) V, k = 2.00, raised to the laboratory's capability (CMC)";
    assert!(page.contains(headline), "{page}");
    let csv = output(folder.path(), &["run", "m.json", "--format", "csv", "--quiet"]);
    let lines: Vec<&str> = csv.lines().collect();
    assert!(lines[0].ends_with(",cmc,stated_expanded_uncertainty"), "{csv}");
    assert!(lines[1].ends_with(",0.06,0.06"), "{csv}");
}

/// A probability that rests on prior knowledge is not stated without it (JCGM 106, 6.3). For a normal
/// prior N(1.1, 0.02) and a measurement of 1.29 with u = 0.05 the share below 1.3 by the measurement
/// alone is cdf(0.2) = 57.93 %.
#[test]
fn prior_knowledge_is_stated() {
    let prior = json!({"distribution": "normal", "mean": 1.1, "std": 0.02});
    let tolerance = json!({"lower": 0.9, "upper": 1.3, "prior": prior});
    let file = model(json!({"x": normal("V", 1.29, 0.05)}), "x", Some(tolerance));
    let certificate = certificate(rows(&["y"]), json!({"monte_carlo": {"trials": 0}}));
    let folder = folder(&[("m.json", &file), ("c.json", &certificate)]);
    let page = output(folder.path(), &["certificate", "c.json", "--format", "markdown", "--quiet"]);
    for part in
        ["with mean 1.1 V and standard deviation 0.02 V", "alone it is 57.93 %", "Global risks"]
    {
        assert!(page.contains(part), "{part}: {page}");
    }
    let found = answer(folder.path(), &["certificate", "c.json"]);
    let decision = &found["rows"][0]["conformity"];
    assert_eq!(decision["conforms"], true);
    assert_eq!((number(&decision["lower"]), number(&decision["upper"])), (0.9, 1.3));
    assert!((number(&decision["probability_without_prior"]) - 0.579_26).abs() < 1e-5, "{decision}");
    assert!(number(&decision["probability"]) > 0.9999);
}

/// A decision that the stated digits do not show says with which value it was made.
#[test]
fn a_decision_beyond_the_stated_digits_is_explained() {
    let tolerance = json!({"upper": 1.1});
    let page = |mean: f64| {
        let inputs = json!({"x": normal("V", mean, 0.05)});
        let file = model(inputs, "x", Some(tolerance.clone()));
        let certificate = certificate(rows(&["y"]), json!({"monte_carlo": {"trials": 0}}));
        let folder = folder(&[("m.json", &file), ("c.json", &certificate)]);
        output(folder.path(), &["certificate", "c.json", "--format", "markdown", "--quiet"])
    };
    let said = page(1.1004);
    assert!(said.contains("does not conform"), "{said}");
    assert!(said.contains("made with the value before rounding, 1.1004 V"), "{said}");
    assert!(!page(1.21).contains("before rounding"));
}

/// 10.064 V with U = 0.06 V is stated as 10.06 V, which is not beyond 10.06 V: it was told as `10.06 V` to
/// four digits. Likewise 10.055 V, stated as 10.06 V, is accepted up to 10.1 V - 0.041 V.
#[test]
fn the_value_of_a_decision_has_the_digits_that_decide() {
    let pages = |mean: f64, u: f64, tolerance: Value, format: &str| {
        let file = model(json!({"x": normal("V", mean, u)}), "x", Some(tolerance));
        let more = json!({"monte_carlo": {"trials": 0}, "digits": 1, "rounding": "up",
            "language": ["en", "de", "fr", "it"]});
        let certificate = certificate(rows(&["y"]), more);
        let folder = folder(&[("m.json", &file), ("c.json", &certificate)]);
        output(folder.path(), &["certificate", "c.json", "--format", format, "--quiet"])
    };
    for format in ["table", "markdown", "html", "latex", "dcc"] {
        let said = pages(10.064, 0.03, json!({"upper": 10.06}), format);
        let said: String = said.split_whitespace().collect::<Vec<_>>().join(" ");
        // one decimal mark for all languages of a page; in a digital certificate that of each
        for before in
            ["before rounding, ", "vor der Rundung, ", "avant arrondi, ", "arrotondamento, "]
        {
            let mut rest = said.split(before).skip(1);
            let told = |rest: &str| rest.starts_with("10.064") || rest.starts_with("10,064");
            assert!(rest.any(told), "{format}, {before}");
        }
        let said = pages(10.055, 0.0205, json!({"upper": 10.1, "guard_band": 1}), format);
        assert!(said.contains("10.055"), "{format}");
    }
    // U is 0.041 V, and stated as 0.05 V
    let said = pages(10.055, 0.0205, json!({"upper": 10.1, "guard_band": 1}), "markdown");
    assert!(said.contains("with U before rounding; guard band 0.0410 V, accepted up to"), "{said}");
}

/// An error of 0.022 K at 25 degC has no nominal value of 298.15 K; the temperature is a condition.
#[test]
fn a_nominal_value_with_another_zero_is_refused() {
    let model = json!({"inputs": {"x": normal("K", 0.022, 0.005)},
        "conditions": {"t": {"unit": "degC", "values": [25]}},
        "equations": {"err": "x", "out": "x + t"},
        "outputs": {"err": {"unit": "K"}, "out": {"unit": "degC"}}, "monte_carlo": {"trials": 0}});
    let refused = |output: &str, nominal: &str| {
        let rows = json!([{"model": "m.json", "output": output, "nominal": nominal}]);
        let file = certificate(rows, json!({"conditions": ["t"]}));
        let folder = folder(&[("m.json", &model), ("c.json", &file)]);
        let (success, _, error) = said(folder.path(), &["certificate", "c.json"]);
        let refused = error.contains("a difference of temperatures");
        assert_eq!(success, !refused, "{error}");
        refused
    };
    for (output, nominal, expected) in [
        ("err", "25 degC", true),
        ("err", "t", true),
        ("out", "298.15 K", true),
        ("err", "20 mK", false),
        ("err", "x", false),
        ("out", "25 degC", false),
        ("out", "t", false),
    ] {
        assert_eq!(refused(output, nominal), expected, "{output}, {nominal}");
    }
}

/// Rows 1 and 3 are of one output, and the first alone has a nominal value, which was left out: rows with
/// one and rows without are two lists of one result, and each value that is read back is its own row, with
/// its coefficients (row 2 and row 3 share the input that varies).
#[test]
fn a_nominal_value_of_some_rows_is_in_the_digital_certificate() {
    let file = json!({"inputs": {"x": normal("V", -1.23456, 0.0123), "n": normal("V", 0.0, 0.0123)},
        "equations": {"y": "x + n", "z": "2*n"}, "outputs": {"y": {"unit": "V"}, "z": {"unit": "V"}},
        "monte_carlo": {"trials": 0}});
    let rows = json!([
        {"model": "m.json", "output": "y", "set": {"x": "-1 V"}},
        {"model": "m.json", "output": "y", "nominal": -1.25},
        {"model": "m.json", "output": "z"}]);
    let certificate = certificate(rows, json!({"shared_inputs": ["n"], "separate_inputs": ["x"]}));
    let folder = folder(&[("m.json", &file), ("c.json", &certificate)]);
    let xml = output(folder.path(), &["certificate", "c.json", "--format", "dcc", "--quiet"]);
    assert_eq!(elements(&xml, "valueXMLList"), ["-1.000", "-1.25", "-1.235", "0.000"]);
    assert!(elements(&xml, "content").iter().any(|of| of == "Row 2"), "{xml}");
    fs::write(folder.path().join("d.xml"), xml).expect("a file");
    let input = |row: &str| json!({"distribution": "dcc", "file": "d.xml", "ref_type": "basic_measuredValue", "within": row});
    let back = json!({"inputs": {"a": input("Row 1"), "b": input("Row 2"), "c": input("z")},
        "equations": {"ab": "a - b", "bc": "b - c"},
        "outputs": {"ab": {"unit": "V"}, "bc": {"unit": "V"}}, "monte_carlo": {"trials": 0}});
    fs::write(folder.path().join("b.json"), back.to_string()).expect("a file");
    let found = &answer(folder.path(), &["run", "b.json"])["outputs"];
    let u = |of: &str| number(&found[of]["gum"]["standard_uncertainty"]);
    // x varies by itself in both, and n drops out: sqrt(2) 0.0123; x + n - 2n: the same; U has two digits
    for of in ["ab", "bc"] {
        assert!((u(of) / (0.0123 * 2f64.sqrt()) - 1.0).abs() < 0.03, "{of} {}", u(of));
    }
}

/// Two rows that share an input, one of them a t and the other none: their coefficient is beyond what
/// the two distributions can have, and the nearest is taken with a note; the interval's quantity of a
/// row is that row.
#[test]
fn correlated_rows_of_a_digital_certificate_can_be_used() {
    let mut file = model(json!({"x": student(3.0), "n": normal("V", 0.0, 0.004)}), "x", None);
    file["equations"]["w"] = json!("x + n");
    file["outputs"]["w"] = json!({"unit": "V"});
    let mut rows = rows(&["y", "w"]);
    rows[1]["statement"] = json!("monte-carlo");
    let certificate = certificate(rows, json!({}));
    let folder = folder(&[("m.json", &file), ("c.json", &certificate)]);
    let xml = output(folder.path(), &["certificate", "c.json", "--format", "dcc", "--quiet"]);
    fs::write(folder.path().join("c.xml"), xml).expect("a file");
    let of = |quantity: u64| json!({"distribution": "dcc", "file": "c.xml", "quantity": quantity});
    let mut u = Vec::new();
    for second in [1, 2] {
        let back = json!({"inputs": {"r1": of(0), "r2": of(second)}, "equations": {"z": "r2 - r1"},
            "outputs": {"z": {"unit": "V"}}, "monte_carlo": {"trials": 10_000}});
        fs::write(folder.path().join("b.json"), back.to_string()).expect("a file");
        let found = answer(folder.path(), &["run", "b.json"]);
        assert!(found["warnings"].to_string().contains("certificate-correlation-moved"), "{found}");
        u.push(number(&found["outputs"]["z"]["gum"]["standard_uncertainty"]));
    }
    assert_eq!(u[0], u[1]);
    // without the coefficient it is hypot(0.01, 0.018)
    assert!(u[0] < 0.0125, "{u:?}");
}

/// Units with names of the laboratory's own come back with their definition.
#[test]
fn own_units_of_a_digital_certificate_are_read_back() {
    let units = json!({"tex": "1e-6*kg/m", "HBW": "1"});
    let file = json!({"units": units, "inputs": {"a": normal("tex", 10.0, 0.1),
        "b": normal("N/(mm^2*HBW)", 3.0, 0.1)}, "equations": {"y": "a", "w": "b"},
        "outputs": {"y": {"unit": "tex"}, "w": {"unit": "N/(mm^2*HBW)"}}});
    let certificate = certificate(rows(&["y", "w"]), json!({"monte_carlo": {"trials": 0}}));
    let folder = folder(&[("m.json", &file), ("c.json", &certificate)]);
    let xml = output(folder.path(), &["certificate", "c.json", "--format", "dcc", "--quiet"]);
    fs::write(folder.path().join("c.xml"), xml).expect("a file");
    let of = |quantity: u64| json!({"distribution": "dcc", "file": "c.xml", "quantity": quantity});
    let back = json!({"inputs": {"y": of(0), "w": of(1)}, "equations": {"z": "y", "v": "w"},
        "outputs": {"z": {"unit": "mg/m"}, "v": {"unit": "Pa"}}, "monte_carlo": {"trials": 0}});
    fs::write(folder.path().join("b.json"), back.to_string()).expect("a file");
    let found = answer(folder.path(), &["run", "b.json"]);
    let estimate = |name: &str| number(&found["outputs"][name]["gum"]["estimate"]);
    assert!(
        (estimate("z") / 10.0 - 1.0).abs() < 1e-12 && (estimate("v") / 3e6 - 1.0).abs() < 1e-12
    );
    // a file with the same unit of its own
    let own = json!({"units": {"tex": "1e-6*kg/m"}, "inputs": {"y": of(0)},
        "equations": {"z": "y"}, "outputs": {"z": {"unit": "tex"}}, "monte_carlo": {"trials": 0}});
    fs::write(folder.path().join("b.json"), own.to_string()).expect("a file");
    let found = answer(folder.path(), &["run", "b.json"]);
    assert_eq!(number(&found["outputs"]["z"]["gum"]["estimate"]), 10.0);
}

/// What is no budget says what it is.
#[test]
fn certificates_are_no_budgets() {
    let file = model(json!({"x": normal("V", 10.0, 0.01)}), "x", None);
    let certificate = certificate(rows(&["y"]), json!({"monte_carlo": {"trials": 0}}));
    let folder = folder(&[("m.json", &file), ("c.json", &certificate)]);
    for (format, name) in [("dcc", "c.xml"), ("json", "answer.json")] {
        let text = output(folder.path(), &["certificate", "c.json", "--format", format, "--quiet"]);
        fs::write(folder.path().join(name), text).expect("a file");
        let (success, _, error) = said(folder.path(), &["import", name]);
        assert!(!success && error.contains("by an input of the distribution `dcc`"), "{error}");
    }
    fs::write(folder.path().join("r.csv"), "label,x1,U1\ny,10,0.02\n").expect("a file");
    let (_, _, error) = said(folder.path(), &["compare", "r.csv", "--against", "answer.json"]);
    assert!(
        error.contains("the JSON answer of a certificate, and not that of an evaluation"),
        "{error}"
    );
}

/// A guard band of w = U (ILAC-G8:09/2019, 4.2.2): with U = 0.10 V below 1.1 V, 0.99 V is accepted and
/// 1.05 V is not shown to conform. The specification and the agreement of the rule are said.
#[test]
fn a_guard_band_may_be_a_multiple_of_u() {
    let tolerance = |more: Value| {
        let mut tolerance = json!({"upper": 1.1, "specification": "DIN 1", "agreed": true});
        let more = more.as_object().expect("an object").clone();
        tolerance.as_object_mut().expect("an object").extend(more);
        tolerance
    };
    let page = |mean: f64, trials: u64| {
        let inputs = json!({"x": normal("V", mean, 0.05)});
        let file = model(inputs, "x", Some(tolerance(json!({"guard_band": 1}))));
        let settings = json!({"monte_carlo": {"trials": trials}});
        let certificate = certificate(rows(&["y"]), settings);
        let folder = folder(&[("m.json", &file), ("c.json", &certificate)]);
        let found = answer(folder.path(), &["certificate", "c.json"])["rows"][0].clone();
        assert_eq!(number(&found["conformity"]["guard_band"]["factor"]), 1.0);
        let width = number(&found["conformity"]["guard_band"]["width"]);
        assert!((width - 0.1).abs() < 1e-12, "{width}");
        output(folder.path(), &["certificate", "c.json", "--format", "markdown", "--quiet"])
    };
    for trials in [0, 100_000] {
        let said = page(0.99, trials);
        for part in ["Specification: DIN 1.", "guard band of 1 U", "agreed with the customer"] {
            assert!(said.contains(part), "{part}: {said}");
        }
        assert!(said.contains("guard band 0.100 V, accepted up to 1.000 V"), "{said}");
        assert!(said.contains("The result conforms"), "{said}");
        assert!(page(1.05, trials).contains("It is not shown that the result conforms"));
    }
    for (more, part) in [
        (json!({"guard_band": 1, "risk": 0.05}), "`guard_band`"),
        (json!({"guard_band": -1}), "above 0, in multiples of U"),
        (json!({"risk": 0.05, "statement": "non-binary"}), "needs the key `guard_band`"),
        (json!({"guard_band": 1, "statement": "four"}), "one of `binary`"),
    ] {
        let file = model(json!({"x": normal("V", 1.0, 0.05)}), "x", Some(tolerance(more)));
        let folder = folder(&[("m.json", &file)]);
        let (success, _, error) = said(folder.path(), &["check", "m.json"]);
        assert!(!success && error.contains(part), "{error}");
    }
}

/// The four levels of ILAC-G8:09/2019, 4.2.3, on the page and in the digital certificate, whose schema has
/// a status for each: with U = 0.1 V below 1.1 V, P(1.05 V) = cdf(1) = 0.8413.
#[test]
fn a_certificate_states_four_levels() {
    let levels = [
        (0.99, "Pass: the result", "pass"),
        (1.05, "Conditional pass: the result is within the tolerance", "conditionalPass"),
        (1.15, "Conditional fail: the result is outside the tolerance", "conditionalFail"),
        (1.25, "Fail: the result", "fail"),
    ];
    let tolerance = json!({"upper": 1.1, "guard_band": 1, "statement": "non-binary"});
    for (mean, stated, status) in levels {
        let inputs = json!({"x": normal("V", mean, 0.05)});
        let file = model(inputs, "x", Some(tolerance.clone()));
        let settings = json!({"monte_carlo": {"trials": 0}});
        let certificate = certificate(rows(&["y"]), settings);
        let folder = folder(&[("m.json", &file), ("c.json", &certificate)]);
        let page = |format: &str| {
            output(folder.path(), &["certificate", "c.json", "--format", format, "--quiet"])
        };
        let said = page("markdown");
        assert!(said.contains(stated) && said.contains("ILAC-G8:09/2019, 4.2.3"), "{said}");
        assert!(mean != 1.05 || said.contains("conforms with a probability of 84.13 %"), "{said}");
        let dcc = page("dcc");
        assert!(dcc.contains(&format!("<dcc:conformity>{status}<")), "{dcc}");
    }
}

/// The clause of a guard band of U, and the factor of a capability, are those of approximately 95 %; of
/// other coverages it is said what they are.
#[test]
fn clauses_of_95_percent_are_cited_for_that_alone() {
    let of = |settings: Value| {
        let inputs = json!({"x": normal("V", 9.9985, 0.001)});
        let file = model(inputs, "x", Some(json!({"upper": 10, "guard_band": 1})));
        let mut row = rows(&["y"]);
        row[0]["cmc"] = "4 mV".into();
        row[0]["cmc_floor"] = true.into();
        let folder = folder(&[("m.json", &file), ("c.json", &certificate(row, settings))]);
        output(folder.path(), &["certificate", "c.json", "--format", "markdown", "--quiet"])
    };
    for settings in [json!({"coverage_factor": 2}), json!({"coverage_probability": 0.95})] {
        let said = of(settings);
        assert!(said.contains("guard band of 1 U (ILAC-G8:09/2019, 4.2.2), with U"), "{said}");
        assert!(said.contains("of the capability") && !said.contains("converted from"), "{said}");
    }
    for (factor, width) in [(1, "0.00200 V"), (3, "0.00600 V")] {
        let said = of(json!({"coverage_factor": factor}));
        assert!(!said.contains("U (ILAC-G8"), "{said}");
        let part = format!(
            "(U with k = {factor}.00; ILAC-G8:09/2019, 4.2.2, defines the guard band for U of"
        );
        assert!(said.contains(&part) && said.contains(width), "{said}");
        let part =
            format!("converted from the coverage factor 2 of the capability to k = {factor}.00");
        assert!(said.contains(&part), "{said}");
    }
}

/// More than two digits (ILAC-P14:09/2020, 5.3) and a rounding that takes away more than 5 % (EA-4/02
/// M:2022, 6.3) have notes: 0.0221 V as 0.02 V is 9.5 % less.
#[test]
fn digits_that_a_certificate_may_not_have_are_told() {
    let notes = |settings: Value| {
        let file = model(json!({"x": normal("V", 9.0, 0.01105)}), "x", None);
        let certificate = certificate(rows(&["y"]), settings);
        let folder = folder(&[("m.json", &file), ("c.json", &certificate)]);
        answer(folder.path(), &["certificate", "c.json"])["warnings"].clone()
    };
    let with = |settings: Value| {
        let mut all = json!({"coverage_factor": 2});
        all.as_object_mut().expect("an object").extend(settings.as_object().cloned().expect("one"));
        notes(all).as_array().expect("a list").to_vec()
    };
    let has = |found: &[Value], code: &str| found.iter().any(|note| note["code"] == code);
    let three = with(json!({"digits": 3}));
    assert!(has(&three, "more-than-two-digits"), "{three:?}");
    let one = with(json!({"digits": 1, "rounding": "nearest"}));
    assert!(has(&one, "rounded-away"), "{one:?}");
    assert!(one.iter().any(|note| note["text"].to_string().contains("9.5 % less")), "{one:?}");
    for settings in [json!({"digits": 2}), json!({"digits": 1, "rounding": "ea"}), json!({})] {
        let found = with(settings);
        assert!(!has(&found, "rounded-away") && !has(&found, "more-than-two-digits"), "{found:?}");
    }
}
