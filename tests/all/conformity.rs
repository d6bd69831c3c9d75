//! Tolerances, risks and the laboratory's capability from the outside.

use std::fs;

use calamine::{Data, Reader, Xlsx, open_workbook};
use serde_json::{Value, json};

use crate::support::command;

/// A model y = x with x normal about `mean` and these further keys of its output.
fn model(mean: f64, std: f64, more: &str) -> String {
    format!(
        r#"{{"inputs": {{"x": {{"unit": "um", "distribution": "normal", "mean": {mean}, "std": {std}}}}},
        "equations": {{"y": "x"}}, "outputs": {{"y": {{"unit": "um", {more}}}}},
        "monte_carlo": {{"trials": 300000}}}}"#
    )
}

fn run(text: &str, more: &[&str]) -> (Option<i32>, String, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("m.json");
    fs::write(&path, text).expect("written");
    let output = command().current_dir(folder.path()).arg("run").arg("m.json").args(more).output();
    let output = output.expect("the program runs");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

fn answer(text: &str) -> Value {
    answer_with(text, &[])
}

fn answer_with(text: &str, more: &[&str]) -> Value {
    let (code, answer, said) = run(text, &[&["--format", "json"], more].concat());
    assert_eq!(code, Some(0), "{said}");
    serde_json::from_str(&answer).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("a number, not {value}"))
}

/// JCGM 106, 7: an upper limit 1.4 standard uncertainties above the estimate gives
/// Phi(1.40) = 0.919 243, and limits 1.5 above and 0.611 below Phi(1.5) - Phi(-0.6111) = 0.662 64.
/// Tolerance: five numerical standard errors of 200 000 trials; a false failure once in a million.
#[test]
fn conformance_probabilities() {
    let cases = [
        (-5.47, 0.05, r#""tolerance": {"upper": -5.4}"#, 0.919_243),
        (13.6, 1.8, r#""tolerance": {"lower": 12.5, "upper": 16.3}"#, 0.662_64),
    ];
    for (mean, std, more, expected) in cases {
        let found = answer(&model(mean, std, more));
        let of = &found["outputs"]["y"]["conformity"];
        let p = number(&of["probability"]);
        assert!((p - expected).abs() < 5.0 * number(&of["numerical_standard_error"]), "{p}");
        assert_eq!(of["conforms"], true);
        let risk = number(&of["specific_risk"]["false_acceptance"]);
        assert!((risk - (1.0 - p)).abs() < 1e-15);
        assert!(of["specific_risk"]["false_rejection"].is_null() && of.get("guard_band").is_none());
    }
}

/// Without trials it is decided by the law of propagation: Phi(0.3) = 0.617 911 (JCGM 106, 7.2) of a
/// normal quantity 0.3 u below its limit, and of t with 3 degrees of freedom
/// 1/2 + (a/(1 + a^2) + atan a)/pi with a = 0.3/sqrt(3), 0.608 118.
#[test]
fn decisions_without_trials() {
    let limit = r#""tolerance": {"upper": 0.1, "risk": 0.05}"#;
    let few = model(0.097, 0.01, limit).replace("0.01}", "0.01, \"dof\": 3}");
    for (text, expected) in [(model(0.097, 0.01, limit), 0.617_911), (few, 0.608_118)] {
        let (code, found, said) = run(&text, &["--trials", "0", "--format", "json"]);
        assert_eq!(code, Some(0), "{said}");
        assert!(
            said.contains("the decision on its tolerance uses the law of propagation"),
            "{said}"
        );
        let found: Value = serde_json::from_str(&found).expect("JSON");
        let of = &found["outputs"]["y"]["conformity"];
        // six printed digits of the closed forms
        assert!((number(&of["probability"]) - expected).abs() < 1e-6, "{of}");
        assert_eq!(of["conforms"], false);
        let (code, page, _) = run(&text, &["--trials", "0", "--fail", "--full"]);
        assert_eq!(code, Some(3), "{page}");
        assert!(page.contains("Decision: rejected"), "{page}");
    }
    let (code, ..) = run(&model(0.0, 0.01, limit), &["--trials", "0", "--fail"]);
    assert_eq!(code, Some(0));
}

/// The ball bearings of JCGM 106, 9.5.4. u from 200 000 trials is 0.25 um to 0.16 %, and the risk
/// follows it about in proportion.
#[test]
fn global_risks_with_a_prior() {
    let prior = r#""prior": {"distribution": "gamma", "shape": 4, "rate": 4}"#;
    let tolerance = format!(r#""tolerance": {{"upper": 2, {prior}}}"#);
    let found = answer(&model(1.2, 0.25, &tolerance));
    let global = &found["outputs"]["y"]["conformity"]["global_risk"];
    let risk = number(&global["false_acceptance"]);
    assert!((risk / 0.008_019 - 1.0).abs() < 0.02, "{risk}");
    let guarded = format!(r#""tolerance": {{"upper": 2, {prior}, "risk": 0.001}}"#);
    let found = answer(&model(1.9, 0.25, &guarded));
    let of = &found["outputs"]["y"]["conformity"];
    assert!((number(&of["global_risk"]["false_acceptance"]) - 0.001).abs() < 1e-6);
    assert!((number(&of["guard_band"]["upper"]) - 1.67).abs() < 0.01);
    assert_eq!((&of["conforms"], &of["guard_band"]["lower"]), (&json!(false), &json!(null)));
    assert!(number(&of["specific_risk"]["false_rejection"]) > 0.6);
    let (code, page, _) = run(&model(1.9, 0.25, &guarded), &["--fail", "--quiet", "--full"]);
    assert_eq!(code, Some(3));
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    for said in [
        "guarded acceptance (JCGM 106, 8.3)",
        "at most 0.1 %",
        "Decision: rejected.",
        "Global risks",
    ] {
        assert!(page.contains(said), "{said}: {page}");
    }
    // within the tolerance, so by simple acceptance it is accepted
    let (code, page, _) =
        run(&model(1.9, 0.25, r#""tolerance": {"upper": 2}"#), &["--fail", "--quiet"]);
    assert_eq!(code, Some(0));
    assert!(page.contains("simple acceptance (JCGM 106, 8.2)"), "{page}");
}

/// With a prior the conformance probability is that of the posterior (JCGM 106, 6.3 and 7.1): for the
/// ball bearing that was measured as 1.9 um 84.01 % by quadrature, beside Phi(0.4) = 65.5 % of the
/// measurement alone, to five numerical standard errors of its trials.
#[test]
fn the_posterior_where_a_prior_is_stated() {
    let prior =
        r#""tolerance": {"upper": 2, "prior": {"distribution": "gamma", "shape": 4, "rate": 4}}"#;
    let text = model(1.9, 0.25, prior);
    let found = answer(&text);
    let of = &found["outputs"]["y"]["conformity"];
    assert!((number(&of["probability"]) - 0.8401).abs() < 5e-5, "{of}");
    assert!((number(&of["specific_risk"]["false_acceptance"]) - 0.1599).abs() < 5e-5, "{of}");
    assert!((number(&of["probability_without_prior"]) - 0.6554).abs() < 5.3e-3, "{of}");
    let (_, page, _) = run(&text, &["--full"]);
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    for said in ["probability of 84.01 %", "does not conform: 15.99 %", "with the prior"] {
        assert!(page.contains(said), "{said}: {page}");
    }
}

/// What rounds to certainty is not said to be certain: of 300 000 trials that all conform the
/// probability is above 99.99 % (less than 1e-5 is missing, with 95 %), of 10 000 above 99.9 %.
#[test]
fn a_probability_near_one_is_not_called_certain() {
    let text = model(1.0, 0.01, r#""tolerance": {"upper": 2}"#);
    let page = |text: &str, options: &[&str]| {
        let (_, page, _) = run(text, &[&["--full"], options].concat());
        page.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let said = page(&text, &[]);
    assert!(
        said.contains("probability of more than 99.99 % (all 300 000 trials conform)"),
        "{said}"
    );
    assert!(said.contains("the value does not conform: less than 0.01 %"), "{said}");
    let said = page(&text, &["--trials", "10000"]);
    assert!(said.contains("probability of more than 99.9 % (all 10 000 trials conform)"), "{said}");
    let said = page(&model(3.0, 0.01, r#""tolerance": {"upper": 2}"#), &[]);
    assert!(said.contains("less than 0.01 % (none of the 300 000 trials conforms)"), "{said}");
    let prior =
        r#""tolerance": {"upper": 2, "prior": {"distribution": "normal", "mean": 1, "std": 0.1}}"#;
    let said = page(&model(1.0, 0.01, prior), &[]);
    assert!(
        said.contains("more than 99.99 % (with the prior, by JCGM 106, 6.3 and 7.1; without"),
        "{said}"
    );
}

/// The guard band for a specific risk is that of the result's distribution about the acceptance limit, with
/// trials and without: t(0.999; 4) = 7.173 of a normal quantity with 4 degrees of freedom and u = 0.002,
/// t(0.95; 2) = 2.920 of three readings with s/sqrt(3) = 0.001/sqrt(3); (1 - 2 x 0.01) a of a rectangular
/// distribution of half-width a = 0.01, here from trials: the rank of 1 % of 300 000 scatters by 54, which
/// is 3.6e-6 of the value, and the mean by u/sqrt(300 000) = 1.05e-5; five of both together, 5.6e-5, leave
/// a false failure rate of 6e-7.
#[test]
fn guard_bands_follow_the_distribution() {
    let of = |input: &str, limit: f64, risk: f64| {
        format!(
            r#"{{"inputs": {{"x": {{"unit": "V", {input}}}}}, "equations": {{"y": "x"}},
            "outputs": {{"y": {{"unit": "V", "tolerance": {{"upper": {limit}, "risk": {risk}}}}}}},
            "monte_carlo": {{"trials": 300000}}}}"#
        )
    };
    let few =
        of(r#""distribution": "normal", "mean": 10.001, "std": 0.002, "dof": 4"#, 10.01, 0.001);
    let three = of(r#""distribution": "readings", "values": [9.999, 10.001, 10.0]"#, 10.001, 0.05);
    let even =
        of(r#""distribution": "rectangular", "mean": 9.9988, "half_width": 0.01"#, 10.01, 0.01);
    let cases = [
        (few, 7.173 * 0.002, 1e-6, false),
        (three, 2.920 * 0.001 / 3f64.sqrt(), 3e-7, false),
        (even, 0.98 * 0.01, 5.6e-5, true),
    ];
    for (model, expected, tolerance, conforms) in cases {
        for trials in ["300000", "0"] {
            let found = answer_with(&model, &["--trials", trials]);
            let of = &found["outputs"]["y"]["conformity"];
            if conforms && trials == "0" {
                // the law of propagation takes it to be normal: 2.326 a/sqrt(3)
                let normal = 2.326_348 * 0.01 / 3f64.sqrt();
                assert!((number(&of["guard_band"]["width"]) - normal).abs() < 1e-7, "{of}");
                continue;
            }
            assert!((number(&of["guard_band"]["width"]) - expected).abs() < tolerance, "{of}");
            assert_eq!(of["conforms"], conforms, "{of}");
            let risk = number(&of["guard_band"]["risk"]);
            assert_eq!(1.0 - number(&of["probability"]) <= risk, conforms, "{of}");
        }
    }
}

/// The levels of ILAC-G8:09/2019, 4.2.3, with w = U = 2 u = 0.1 um at an upper limit of 1.1 um: pass up to
/// TL - w, conditional pass up to TL, conditional fail up to TL + w, fail beyond. The risks of a normal
/// distribution are sf(2), sf(1), 1/2, sf(1), sf(2) and sf(3) to six digits: below 2.5 % for pass and
/// fail, and up to 50 % for the conditional ones, as its Table 1 says.
#[test]
fn statements_of_four_levels() {
    let tolerance = r#""tolerance": {"upper": 1.1, "guard_band": 1, "statement": "non-binary"}"#;
    let cases = [
        (1.0, "pass", "false_acceptance", 0.022_750),
        (1.05, "conditional pass", "false_acceptance", 0.158_655),
        (1.1, "conditional pass", "false_acceptance", 0.5),
        (1.15, "conditional fail", "false_rejection", 0.158_655),
        (1.2, "conditional fail", "false_rejection", 0.022_750),
        (1.25, "fail", "false_rejection", 0.001_350),
    ];
    let options = ["--trials", "0", "--k", "2"];
    for (mean, level, wrong, risk) in cases {
        let text = model(mean, 0.05, tolerance);
        let found = answer_with(&text, &options);
        let of = &found["outputs"]["y"]["conformity"];
        assert_eq!((&of["statement"], &of["conforms"]), (&json!(level), &json!(level == "pass")));
        assert!((number(&of["specific_risk"][wrong]) - risk).abs() < 1e-6, "{of}");
        let (code, page, _) = run(&text, &[&options[..], &["--fail", "--full"]].concat());
        assert_eq!(code, Some(if level == "pass" { 0 } else { 3 }));
        assert!(page.contains(&format!("Decision: {level}.")), "{page}");
    }
    let binary = model(1.05, 0.05, r#""tolerance": {"upper": 1.1, "guard_band": 1}"#);
    let found = answer_with(&binary, &options);
    assert!(found["outputs"]["y"]["conformity"].get("statement").is_none());
    // both limits, a sweep and the formula of the workbook
    let swept = r#"{"inputs": {"e": {"distribution": "normal", "mean": 0, "std": 0.05}},
        "conditions": {"x": {"values": [0.75, 0.85, 0.95, 1.0, 1.07, 1.15, 1.25]}},
        "equations": {"y": "x + e"}, "outputs": {"y": {"unit": "1", "tolerance": {"lower": 0.9,
        "upper": 1.1, "guard_band": 0.5, "statement": "non-binary"}}}}"#;
    let (_, page, _) = run(swept, &options);
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    let counted = "pass 2, conditional pass 1, conditional fail 2, fail 2 of 7 rows.";
    assert!(page.contains(counted), "{page}");
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("m.json"), model(1.15, 0.05, tolerance)).expect("written");
    let asked = ["run", "m.json", "--format", "xlsx", "--output", "m.xlsx", "--trials", "0"];
    assert!(command().current_dir(folder.path()).args(asked).status().expect("runs").success());
    let mut book: Xlsx<_> = open_workbook(folder.path().join("m.xlsx")).expect("a workbook");
    let name = book.sheet_names()[0].clone();
    let has = |text: &str, all: &[String]| all.iter().any(|cell| cell.contains(text));
    let values = book.worksheet_range(&name).expect("a sheet");
    let values: Vec<String> = values.used_cells().map(|(.., cell)| cell.to_string()).collect();
    let formulas = book.worksheet_formula(&name).expect("a sheet");
    let formulas: Vec<String> = formulas.used_cells().map(|(.., text)| text.clone()).collect();
    assert!(has("conditional fail", &values), "{values:?}");
    assert!(has("\"conditional fail\",\"fail\")))", &formulas), "{formulas:?}");
}

/// A capability is one for k = 2: with k = 3 it is 1.5 times as much, and the same u = 0.25 mV is decided
/// with, w = 1.959 964 u for 2.5 %.
#[test]
fn a_capability_is_brought_to_the_coverage() {
    let text = r#"{"inputs": {"x": {"unit": "V", "distribution": "normal", "mean": 1, "std": "0.1 mV"}},
        "equations": {"y": "x"}, "outputs": {"y": {"unit": "V", "cmc": "0.05 %", "cmc_floor": true,
        "tolerance": {"upper": 1.0006, "risk": 0.025}}}}"#;
    for (coverage, expected) in [("2", 0.0005), ("3", 0.00075)] {
        let found = answer_with(text, &["--k", coverage, "--trials", "0"]);
        let of = &found["outputs"]["y"];
        assert_eq!(number(&of["cmc"]["expanded_uncertainty"]), expected, "{of}");
        let of = &of["conformity"];
        assert!((number(&of["stated_standard_uncertainty"]) - 0.000_25).abs() < 1e-12, "{of}");
        assert!((number(&of["guard_band"]["width"]) - 1.959_964 * 0.000_25).abs() < 1e-9, "{of}");
    }
}

#[test]
fn the_laboratorys_capability() {
    let found = answer(&model(10.0, 0.01, r#""cmc": "0.4 % + 0.01 um""#));
    let of = &found["outputs"]["y"]["cmc"];
    assert!((number(&of["cmc"]) - 0.05).abs() < 1e-15 && of["raised"] == json!(false));
    assert!((number(&of["expanded_uncertainty"]) - 0.02).abs() < 1e-12);
    let codes = |found: &Value| -> Vec<String> {
        let all = found["warnings"].as_array().expect("a list");
        all.iter().filter_map(|w| w["code"].as_str().map(str::to_owned)).collect()
    };
    assert_eq!(codes(&found), ["below-cmc"]);
    let raised = answer(&model(10.0, 0.01, r#""cmc": 0.05, "cmc_floor": true"#));
    assert_eq!(
        raised["outputs"]["y"]["cmc"],
        json!({"cmc": 0.05, "expanded_uncertainty": 0.05, "raised": true})
    );
    assert_eq!(codes(&raised), ["raised-to-cmc"]);
    let (_, page, said) = run(&model(10.0, 0.01, r#""cmc": 0.05"#), &[]);
    assert!(page.contains("is below the laboratory's capability (CMC) of 0.05 um"), "{page}");
    assert!(said.contains("must not be stated"), "{said}");
    // what is stated is not rounded below it
    let (_, page, said) = run(&model(10.0, 0.001, r#""cmc": 0.01244, "cmc_floor": true"#), &[]);
    assert!(page.contains("capability (CMC) of 0.01244 um and raised to it: 0.013 um"), "{page}");
    assert!(said.contains("state 0.013 um"), "{said}");
    let options = ["--format", "markdown"];
    let (_, page, _) = run(&model(10.0, 0.001, r#""cmc": 0.01244, "cmc_floor": true"#), &options);
    assert!(page.contains("y = (10.000 ± 0.013) µm"), "{page}");
    assert!(codes(&answer(&model(10.0, 0.1, r#""cmc": 0.05"#))).is_empty());
}

/// 0.5 % of 1 V and of 2 V are stated in their rows, on pages as in CSV.
#[test]
fn every_row_has_what_is_to_be_stated() {
    let text = r#"{"inputs": {"a": {"unit": "V", "distribution": "normal", "mean": 0, "std": 0.001}},
        "conditions": {"p": {"unit": "V", "values": [1, 2]}}, "equations": {"y": "a + p"},
        "outputs": {"y": {"unit": "V", "cmc": "0.5 % of p", "cmc_floor": true}}}"#;
    let (_, page, said) = run(text, &["--trials", "0"]);
    for (row, stated) in [("1 ", "0.0050"), ("2 ", "0.010")] {
        let line = page.lines().find(|line| line.trim_start().starts_with(row)).expect("a row");
        assert!(line.split_whitespace().any(|cell| cell == stated), "{page}");
    }
    assert!(said.contains("in 2 of 2 rows, and raised to it there"), "{said}");
    let (_, csv, _) = run(text, &["--trials", "0", "--format", "csv"]);
    let stated: Vec<&str> =
        csv.lines().skip(1).filter_map(|line| line.rsplit(',').next()).collect();
    assert_eq!(stated, ["0.005", "0.01"]);
}

/// 2 x 0.0505 V is 0.101 V, as the capability is, and 0.10 to the nearest: 0.11 is stated, and why.
#[test]
fn a_certificate_says_where_rounding_gives_way() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = r#"{"inputs": {"a": {"unit": "V", "distribution": "normal", "mean": 10, "std": 0.0505}},
        "equations": {"y": "a"}, "outputs": {"y": {"unit": "V", "cmc": 0.101, "cmc_floor": true}},
        "monte_carlo": {"trials": 0}}"#;
    fs::write(folder.path().join("m.json"), model).expect("written");
    for (digits, is_said) in [(2, true), (3, false)] {
        let file = json!({"language": "en", "digits": digits,
            "rows": [{"model": "m.json", "output": "y"}]});
        fs::write(folder.path().join("c.json"), file.to_string()).expect("written");
        let output = command().current_dir(folder.path()).args(["certificate", "c.json"]).output();
        let page = String::from_utf8(output.expect("the program runs").stdout).expect("UTF-8");
        let words: Vec<&str> = page.split_whitespace().collect();
        assert_eq!(
            words.join(" ").contains("U is rounded up, because it would otherwise be below"),
            is_said,
            "{page}"
        );
    }
}

/// Where U is raised to the capability, `run` decides with the U that is to be stated, as the
/// certificate does: u = 0.12/2 = 0.06, w = 1.644 854 u = 0.098 691, so that 1000 is above 1000.09 - w =
/// 999.991 309 and rejected, with P = Phi(0.09/0.06) = Phi(1.5) = 0.933 193. With the evaluated u = 0.04
/// it were accepted up to 1000.0242.
#[test]
fn what_is_raised_to_the_capability_is_decided_with_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = |floor: bool| {
        json!({"inputs": {"x": {"unit": "mbar", "distribution": "normal", "mean": 1000, "std": 0.04}},
            "equations": {"y": "x"},
            "outputs": {"y": {"unit": "mbar", "cmc": "0.01 % of 1000 mbar + 0.02 mbar",
                "cmc_floor": floor, "tolerance": {"upper": 1000.09, "risk": 0.05}}}})
    };
    fs::write(folder.path().join("q.json"), model(true).to_string()).expect("a file");
    let certificate = json!({"rows": [{"model": "q.json", "output": "y"}]});
    fs::write(folder.path().join("c.json"), certificate.to_string()).expect("a file");
    let said = |arguments: &[&str]| {
        let mut run = command();
        let output = run.current_dir(folder.path()).args(arguments).output().expect("it runs");
        (output.status.code(), String::from_utf8(output.stdout).expect("UTF-8"))
    };
    for trials in ["0", "100000"] {
        let run = ["run", "q.json", "--trials", trials, "--quiet"];
        let (_, found) = said(&[&run[..], &["--format", "json"]].concat());
        let found: Value = serde_json::from_str(&found).expect("JSON");
        let of = &found["outputs"]["y"]["conformity"];
        assert!((number(&of["guard_band"]["width"]) - 0.098_691).abs() < 1e-6, "{of}");
        assert!((number(&of["guard_band"]["upper"]) - 999.991_309).abs() < 1e-6, "{of}");
        assert!((number(&of["probability"]) - 0.933_193).abs() < 1e-6, "{of}");
        assert_eq!(number(&of["stated_standard_uncertainty"]), 0.06);
        assert_eq!(of["conforms"], false);
        // a sum of binary fractions that is 0.12 but for its last bit
        let raised = json!({"cmc": 0.12, "expanded_uncertainty": 0.12, "raised": true});
        assert_eq!(found["outputs"]["y"]["cmc"], raised);
        assert_eq!(said(&[&run[..], &["--fail"]].concat()).0, Some(3));
        for format in [&["--full"][..], &["--format", "markdown"], &["--format", "html"]] {
            let (_, page) = said(&[&run[..], format].concat());
            let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(
                page.contains("guard band 0.0987 mbar, accepted up to 999.9913 mbar"),
                "{page}"
            );
            assert!(page.contains("with the laboratory's capability, u = 0.0600 mbar"), "{page}");
            assert!(page.contains("Decision: rejected"), "{page}");
        }
        let certificate = ["certificate", "c.json", "--trials", trials, "--quiet"];
        let (_, page) = said(&[&certificate[..], &["--format", "markdown"]].concat());
        assert!(page.contains("0.0987 mbar") && page.contains("999.9913 mbar"), "{page}");
    }
    // a row with a capability of its own is decided with what that row states
    let rows = json!([{"model": "q.json", "output": "y", "cmc": 0.01}]);
    fs::write(folder.path().join("c.json"), json!({ "rows": rows }).to_string()).expect("a file");
    let (_, page) = said(&["certificate", "c.json", "--trials", "0", "--format", "markdown"]);
    assert!(page.contains("0.0658 mbar") && page.contains("1000.0242 mbar"), "{page}");
    fs::write(folder.path().join("q.json"), model(false).to_string()).expect("a file");
    assert_eq!(said(&["run", "q.json", "--trials", "0", "--quiet", "--fail"]).0, Some(0));
}

/// Trials of a row are counted against its own limits: errors 0.0005 p with u = 0.0002 p and limits of
/// 0.001 p conform with Phi(2.5) = 0.993 790 in every row. Five numerical standard errors of 300 000
/// trials, 0.000 72: a false failure once in a million.
#[test]
fn trials_are_counted_against_the_limits_of_their_row() {
    let text = r#"{"conditions": {"p": {"unit": "V", "values": [1, 5, 10]}},
        "inputs": {"d": {"unit": "V", "distribution": "normal", "mean": "0.0005*p", "std": "0.0002*p"}},
        "equations": {"e": "d"},
        "outputs": {"e": {"unit": "V", "tolerance": {"lower": "-0.001*p", "upper": "0.001*p"}}},
        "monte_carlo": {"trials": 300000}}"#;
    for method in ["monte-carlo", "exact"] {
        let found = answer_with(text, &["--method", method]);
        for row in found["rows"].as_array().expect("rows") {
            let of = &row["outputs"]["e"];
            let p = number(&of["conformity"]["probability"]);
            assert!((p - 0.993_790).abs() < 0.000_72, "{of}");
            if method == "exact" {
                let exact = number(&of["exact"]["conformity_probability"]);
                assert!((exact - 0.993_790).abs() < 1e-6, "{of}");
            }
        }
    }
}

/// A U that is above the capability but for the last bit of its sum is rounded as it is: 0.1244 to
/// 0.12, and not up to 0.13.
#[test]
fn a_capability_that_is_a_sum_is_its_decimal() {
    let folder = tempfile::tempdir().expect("a folder");
    for cmc in ["0.01 % of 1000 mbar + 0.02 mbar", "0.12 mbar", "0.01 % + 0.02 mbar"] {
        let model = json!({
            "inputs": {"x": {"unit": "mbar", "distribution": "normal", "mean": 1000, "std": 0.0622}},
            "equations": {"y": "x"}, "outputs": {"y": {"unit": "mbar", "cmc": cmc}}});
        fs::write(folder.path().join("q.json"), model.to_string()).expect("a file");
        let certificate = json!({"rows": [{"model": "q.json", "output": "y"}]});
        fs::write(folder.path().join("c.json"), certificate.to_string()).expect("a file");
        let mut run = command();
        let run = run.current_dir(folder.path()).args(["certificate", "c.json", "--trials", "0"]);
        let said = run.args(["--quiet", "--format", "json"]).output().expect("it runs").stdout;
        let found: Value = serde_json::from_slice(&said).expect("JSON");
        assert_eq!(found["rows"][0]["stated"]["expanded_uncertainty"], "0.12", "{cmc}");
        let limit = json!({"cmc": 0.12, "below": false, "raised": false});
        assert_eq!(found["rows"][0]["limit"], limit, "{cmc}");
    }
}

/// Limits and capability at the measuring point: 5e-4 p is 0.05, 0.25 and 0.5 mbar at 100, 500 and
/// 1000 mbar, where the errors are 7e-4 p - 0.11 mbar: -0.04, 0.24 and 0.59; 0.01 % of p + 0.02 mbar is
/// 0.03, 0.07 and 0.12 mbar, so that the raised u is half of that and the first error conforms with
/// Phi(0.01/0.015) - Phi(-0.09/0.015 ...) = Phi(0.6667) - Phi(-6) = 0.747 507.
#[test]
fn limits_and_capability_follow_the_conditions() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, content: &Value| {
        fs::write(folder.path().join(name), content.to_string()).expect("a file");
    };
    let said = |arguments: &[&str]| {
        let mut run = command();
        let output = run.current_dir(folder.path()).args(arguments).output().expect("it runs");
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
        (output.status.code(), text(output.stdout), text(output.stderr))
    };
    let model = |cmc: &str| {
        json!({"conditions": {"p": {"unit": "mbar", "values": [100, 500, 1000]}},
            "inputs": {"e": {"unit": "mbar", "distribution": "normal",
                "mean": "7e-4*p - 0.11 [mbar]", "std": 0.01}},
            "equations": {"E": "e"},
            "outputs": {"E": {"unit": "mbar", "cmc": cmc, "cmc_floor": true,
                "tolerance": {"lower": "-5e-4*p", "upper": "5e-4*p"}}}})
    };
    write("c.json", &json!({"rows": [{"model": "m.json", "output": "E"}]}));
    for cmc in ["0.01 % of p + 0.02 mbar", "1e-4*p + 0.02 [mbar]", "20 ubar + 100 ppm of p"] {
        write("m.json", &model(cmc));
        let run = ["run", "m.json", "--trials", "0", "--quiet"];
        let (_, found, wrong) = said(&[&run[..], &["--format", "json"]].concat());
        let found: Value = serde_json::from_str(&found).unwrap_or_else(|_| panic!("{wrong}"));
        let expected = [(0.05, 0.03, true), (0.25, 0.07, true), (0.5, 0.12, false)];
        for (row, (limit, cmc, conforms)) in expected.into_iter().enumerate() {
            let of = &found["rows"][row]["outputs"]["E"];
            let conformity = &of["conformity"];
            assert_eq!(
                (number(&conformity["lower"]), number(&conformity["upper"])),
                (-limit, limit)
            );
            assert_eq!(of["cmc"], json!({"cmc": cmc, "expanded_uncertainty": cmc, "raised": true}));
            assert_eq!(number(&conformity["stated_standard_uncertainty"]), 0.5 * cmc);
            assert_eq!(conformity["conforms"], conforms);
        }
        let first = &found["rows"][0]["outputs"]["E"]["conformity"]["probability"];
        assert!((number(first) - 0.747_507).abs() < 1e-6, "{first}");
        assert_eq!(said(&[&run[..], &["--fail"]].concat()).0, Some(3));
        for format in ["table", "markdown", "html"] {
            let (_, page, _) = said(&[&run[..], &["--format", format]].concat());
            let page =
                page.split_whitespace().collect::<Vec<_>>().join(" ").replace('\u{2212}', "-");
            let limits = "Tolerance of each row (from -0.05 to 0.05 mbar in the first one, from -0.5 to \
                          0.5 mbar in the last one)";
            assert!(page.contains(limits), "{format}: {page}");
            assert!(page.contains("2 of 3 rows accepted, rejected: row 3"), "{format}: {page}");
        }
        let certificate = ["certificate", "c.json", "--trials", "0", "--quiet", "--format"];
        let (_, page, _) = said(&[&certificate[..], &["markdown"]].concat());
        let page = page.replace('\u{2212}', "-");
        for part in ["from -0.05 to 0.05 mbar", "from -0.25 to 0.25 mbar", "from -0.5 to 0.5 mbar"]
        {
            assert!(page.contains(part), "{part}: {page}");
        }
        let (_, answer, _) = said(&[&certificate[..], &["json"]].concat());
        let answer: Value = serde_json::from_str(&answer).expect("JSON");
        let limits: Vec<f64> =
            (0..3).map(|row| number(&answer["rows"][row]["limit"]["cmc"])).collect();
        assert_eq!(limits, [0.03, 0.07, 0.12]);
    }
    // a row of the certificate with a capability of its own
    let row = json!({"model": "m.json", "output": "E", "cmc": "0.02 % of p + 0.1 mbar"});
    write("c.json", &json!({ "rows": [row] }));
    let (_, answer, wrong) = said(&["certificate", "c.json", "--trials", "0", "--format", "json"]);
    let answer: Value = serde_json::from_str(&answer).unwrap_or_else(|_| panic!("{wrong}"));
    let limits: Vec<f64> = (0..3).map(|row| number(&answer["rows"][row]["limit"]["cmc"])).collect();
    assert_eq!(limits, [0.12, 0.2, 0.3]);
    // what could be of the error or of the pressure is asked
    write("m.json", &model("0.01 % + 0.02 mbar"));
    let (code, _, wrong) = said(&["run", "m.json", "--trials", "0"]);
    assert_eq!(code, Some(2));
    assert!(wrong.contains("could be of the value of `E` or of the condition `p`"), "{wrong}");
    write("m.json", &model("0.01 % of reading + 0.02 mbar"));
    assert_eq!(said(&["run", "m.json", "--trials", "0"]).0, Some(0));
    // each of these at its place
    let wrong = |key: &str, text: &str| {
        let mut model = model("0.02 mbar");
        match key {
            "cmc" => model["outputs"]["E"]["cmc"] = json!(text),
            _ => model["outputs"]["E"]["tolerance"][key] = json!(text),
        }
        write("m.json", &model);
        let (code, _, wrong) = said(&["check", "m.json"]);
        assert_eq!(code, Some(2), "{wrong}");
        wrong
    };
    assert!(wrong("upper", "5e-4*q").contains("`q`"));
    assert!(wrong("upper", "5e-4*p/1[s]").contains("`upper` has the unit"));
    let reversed = wrong("upper", "5e-4*p - 0.2 [mbar]");
    assert!(reversed.contains("in row 1 of the conditions"), "{reversed}");
    let negative = wrong("cmc", "1e-4*p - 0.05 [mbar]");
    assert!(negative.contains("it is -0.04 in row 1 of the conditions"), "{negative}");
}

/// Every page of a sweep says what is decided of its rows.
#[test]
fn sweeps_say_what_is_decided_of_each_row() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = r#"{"format": 1,
      "conditions": {"p": {"unit": "bar", "values": [0, 5, 10]}},
      "inputs": {
        "ref": {"unit": "bar", "distribution": "normal", "mean": "p", "std": 0.002},
        "ind": {"unit": "bar", "distribution": "constant", "value": "p*1.004"}},
      "equations": {"e": "ind - ref"},
      "outputs": {"e": {"unit": "bar", "tolerance": {"lower": -0.03, "upper": 0.03}}}}"#;
    fs::write(folder.path().join("m.json"), model).expect("a file");
    for format in ["table", "html", "markdown"] {
        let mut run = command();
        run.current_dir(folder.path());
        let run = run.args(["run", "m.json", "--trials", "10000", "--format", format]).output();
        let page = String::from_utf8(run.expect("it runs").stdout).expect("UTF-8");
        let words = page.split_whitespace().collect::<Vec<_>>().join(" ");
        // errors of 0, 0.02 and 0.04 bar
        assert!(words.contains("2 of 3 rows accepted, rejected: row 3"), "{format}: {words}");
        assert!(words.contains("decision") && words.contains("simple acceptance"), "{format}");
    }
}

/// A guard band of U = 0.4 about limits that are 0.4 apart leaves nothing to accept, however the value.
#[test]
fn guard_bands_that_leave_nothing() {
    for factor in ["1", "0.51"] {
        let text = model(
            10.4,
            0.2,
            &format!(r#""tolerance": {{"lower": 10.2, "upper": 10.6, "guard_band": {factor}}}"#),
        );
        let of = &answer(&text)["outputs"]["y"]["conformity"];
        assert_eq!((&of["conforms"], &of["guard_band"]["lower"]), (&json!(false), &json!(null)));
        let (_, page, _) = run(&text, &["--full"]);
        let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(page.contains("more than half of the tolerance, so that no value is accepted"));
    }
    let whole =
        model(10.4, 0.2, r#""tolerance": {"lower": 10.2, "upper": 10.6, "guard_band": 0.4}"#);
    assert!(answer(&whole)["outputs"]["y"]["conformity"]["guard_band"]["lower"].is_number());
}

/// Cells of the results of a workbook by the texts before them, or below the headers of a sweep.
fn cells(text: &str, label: &str) -> Vec<Data> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("m.json");
    fs::write(&path, text).expect("written");
    let arguments = ["run", "m.json", "--format", "xlsx", "--output", "m.xlsx", "--quiet"];
    let run = command().current_dir(folder.path()).args(arguments).output();
    assert!(run.expect("the program runs").status.success());
    let mut book: Xlsx<_> = open_workbook(folder.path().join("m.xlsx")).expect("a workbook");
    let sheet = book.worksheet_range("Results").expect("a sheet");
    let (row, column) = sheet
        .used_cells()
        .find(|(_, _, cell)| **cell == *label)
        .map(|(row, column, _)| (row, column))
        .unwrap_or_else(|| panic!("{label} in {sheet:?}"));
    let beside = sheet.get((row, column + 1)).filter(|_| column == 0);
    let below = sheet.rows().skip(row + 1).filter_map(|row| row.get(column));
    let below = below.filter(|cell| column > 0 && **cell != Data::Empty);
    beside.into_iter().chain(below).cloned().collect()
}

const ROOT_OF_SQUARES: &str = r#"{"inputs": {
    "x": {"unit": "mm", "distribution": "normal", "mean": 0.01, "std": 0.03},
    "z": {"unit": "mm", "distribution": "rectangular", "mean": 0, "half_width": 0.03}},
    "equations": {"y": "sqrt(x^2 + z^2)"},
    "outputs": {"y": {"unit": "mm", "tolerance": {"upper": 0.02}}},
    "monte_carlo": {"trials": 20000}}"#;

/// What the estimate of the trials decides is decided with it in the workbook, too: it is 0.032 mm, and
/// that of the law of propagation 0.010 mm, within the tolerance.
#[test]
fn the_workbook_decides_with_the_estimate_that_decides() {
    let found = answer(ROOT_OF_SQUARES);
    let of = &found["outputs"]["y"];
    assert_eq!(of["conformity"]["conforms"], false);
    assert_eq!(cells(ROOT_OF_SQUARES, "decision by the estimate"), [Data::from("rejected")]);
    let decides = cells(ROOT_OF_SQUARES, "estimate that decides");
    assert_eq!(decides, [Data::Float(number(&of["monte_carlo"]["estimate"]))]);

    let conditions =
        r#"{"conditions": {"q": {"unit": "mm", "values": [0.005, 0.01, 0.05]}}, "inputs""#;
    let sweep = ROOT_OF_SQUARES.replace("0.01,", "\"q\",").replacen("{\"inputs\"", conditions, 1);
    let rejected = vec![Data::from("rejected"); 3];
    assert_eq!(cells(&sweep, "decision by the estimate"), rejected);
    let (_, page, _) = run(&sweep, &[]);
    assert!(page.contains("that decides") && page.contains("0 of 3 rows accepted"), "{page}");
    assert!(
        page.replace('\n', " ").contains("The estimate that decides is the stated value"),
        "{page}"
    );
    let first = page.lines().find(|line| line.starts_with("0.005")).expect("a row");
    assert!(first.contains("0.031") && first.ends_with("rejected"), "{page}");
    // where the law of propagation decides it is live, and the page has no other estimate
    let plain = model(0.01, 0.001, r#""tolerance": {"upper": 0.02}"#);
    assert_eq!(cells(&plain, "decision by the estimate"), [Data::from("accepted")]);
    assert_eq!(cells(&plain, "estimate that decides"), [Data::Float(0.01)]);
}

/// Where no value has so small a risk the workbook says so, and decides as the page does.
#[test]
fn the_workbook_rejects_where_there_is_no_guard_band() {
    let text =
        ROOT_OF_SQUARES.replace("\"upper\": 0.02", "\"lower\": 0, \"upper\": 0.02, \"risk\": 0.05");
    let (_, page, _) = run(&text, &["--full"]);
    assert!(page.split_whitespace().collect::<Vec<_>>().join(" ").contains("so small a one"));
    assert_eq!(cells(&text, "decision by the estimate"), [Data::from("rejected")]);
    for label in ["guard band", "acceptance, from", "acceptance, to"] {
        assert_eq!(cells(&text, label), [Data::from("-")], "{label}");
    }
}

/// Below the capability nothing is to be stated, unless it is raised to it.
#[test]
fn the_workbook_states_nothing_below_the_capability() {
    let stated = |more: &str| cells(&model(1.0, 0.15, more), "expanded uncertainty to be stated");
    assert_eq!(stated(r#""cmc": 0.301"#), [Data::from("-")]);
    assert_eq!(stated(r#""cmc": 0.301, "cmc_floor": true"#), [Data::Float(0.31)]);
    assert_eq!(stated(r#""cmc": 0.2"#), [Data::Float(0.3)]);
}

/// A share of a level says as little as one of a temperature in degrees Celsius.
#[test]
fn levels_have_no_relative_uncertainty() {
    for (unit, share) in [("dB", "-"), ("degC", "-"), ("V", "9.6")] {
        let text = model(-3.01, 0.29, "\"about\": \"a\"").replace("\"um\"", &format!("\"{unit}\""));
        let (code, page, said) = run(&text, &["--columns", "relative", "--trials", "0"]);
        assert_eq!(code, Some(0), "{said}");
        let line = page.lines().find(|line| line.starts_with("x ")).expect("a line");
        assert_eq!(line.split_whitespace().nth(3), Some(share), "{page}");
    }
}

/// Guard bands by their names, with U = 0.8 um of k = 2 and T = 2 um, so TUR = 2.5: RSS accepts to
/// sqrt(4 - 0.64), RP-10 to 2.5 - 0.8, Dobbert's rule to 2 - 0.8 M with M = 1.04 - exp(0.38 ln 2.5 - 0.54);
/// by hand, to 1e-9. The 4:1 rule holds from U = 0.5 um on.
#[test]
fn guard_bands_have_names() {
    let prior = r#""prior": {"distribution": "normal", "mean": 0, "std": 1}"#;
    let of = |rule: &str, std: f64, more: &[&str]| {
        let keys =
            format!(r#""tolerance": {{"lower": -2, "upper": 2, "guard_band": "{rule}", {prior}}}"#);
        answer_with(&model(1.2, std, &keys), more)["outputs"]["y"]["conformity"].clone()
    };
    let m = 1.04 - f64::exp(0.38 * f64::ln(2.5) - 0.54);
    for (rule, upper) in [("rss", f64::sqrt(3.36)), ("rp-10", 1.7), ("dobbert", 2.0 - 0.8 * m)] {
        let found = of(rule, 0.4, &[]);
        assert_eq!(found["guard_band"]["rule"], rule);
        assert!((number(&found["guard_band"]["upper"]) - upper).abs() < 1e-9, "{found}");
        assert!((number(&found["guard_band"]["lower"]) + upper).abs() < 1e-9, "{found}");
        assert!((number(&found["tur"]) - 2.5).abs() < 1e-9 && found["four_to_one"] == false);
        // without trials the same
        assert!(
            (number(&of(rule, 0.4, &["--trials", "0"])["guard_band"]["upper"]) - upper).abs()
                < 1e-9
        );
        let keys = format!(r#""tolerance": {{"lower": -2, "upper": 2, "guard_band": "{rule}"}}"#);
        let text = model(1.2, 0.4, &keys);
        let live = |label: &str| match &cells(&text, label)[..] {
            [Data::Float(value)] => *value,
            other => panic!("{other:?}"),
        };
        assert!((live("acceptance, to") - upper).abs() < 1e-9);
    }
    let found = of("rss", 0.25, &[]);
    assert_eq!((&found["tur"], &found["four_to_one"]), (&json!(4.0), &json!(true)));
    // the conditional risk is above the global one by the share that is accepted
    let global = &found["global_risk"];
    let accepted =
        number(&global["false_acceptance"]) / number(&global["conditional_false_acceptance"]);
    assert!(accepted > 0.9 && accepted < 0.95, "{accepted}");
    // U above T: nothing is accepted
    let found = of("rss", 1.1, &[]);
    assert_eq!((&found["conforms"], &found["guard_band"]["width"]), (&json!(false), &json!(null)));
    // for another coverage there is no TUR, and the page says what U is of
    let keys = r#""tolerance": {"lower": -2, "upper": 2, "guard_band": "rss"}"#;
    let other = model(1.2, 0.4, keys).replacen('{', "{\"coverage_factor\": 3, ", 1);
    assert!(answer(&other)["outputs"]["y"]["conformity"].get("tur").is_none());
    let (_, page, _) = run(&other, &["--full"]);
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(page.contains("the rule has it for approximately 95 %"), "{page}");
    for (tolerance, said) in [
        (r#""tolerance": {"upper": 2, "guard_band": "rss"}"#, "`lower` is not there"),
        (r#""tolerance": {"lower": 0, "upper": 2, "guard_band": "rds"}"#, "\"dobbert\""),
        (
            r#""tolerance": {"lower": 0, "upper": 2, "risk": 0.02, "guard_band": "rss"}"#,
            "`guard_band`",
        ),
    ] {
        let (code, _, errors) = run(&model(1.2, 0.4, tolerance), &[]);
        assert!(code == Some(2) && errors.contains(said), "{errors}");
    }
}
