//! Plans towards a wanted uncertainty, as the program gives them.

use std::fs;
use std::path::Path;
use std::process::Output;

use serde_json::Value;

use crate::support::{command, root};

fn run(folder: &Path, arguments: &[&str]) -> Output {
    command().current_dir(folder).args(arguments).output().expect("the program runs")
}

fn answer(folder: &Path, arguments: &[&str]) -> Value {
    let found = run(folder, arguments);
    assert!(found.status.success(), "{}", String::from_utf8_lossy(&found.stderr));
    serde_json::from_slice(&found.stdout).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

const SUM: &str = r#"{"format": 1, "inputs": {
    "a": {"unit": "mm", "distribution": "normal", "mean": 100, "std": 3},
    "b": {"unit": "mm", "distribution": "normal", "mean": 50, "std": 4},
    "c": {"unit": "mm", "distribution": "constant", "value": 1}},
    "equations": {"y": "a + b + c"}, "outputs": {"y": {"unit": "mm"}}, "coverage_factor": 2}"#;

/// y = a + b with u = 3 and 4 and k = 2: for U <= 7 b alone needs sqrt(12.25 - 9), a alone cannot do
/// it; the drift b may grow for sqrt(3.25)/4 of its year. The tolerance is that of the bisection.
#[test]
fn a_plan_by_hand() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("sum.json"), SUM).expect("a file");
    let target = "U(y) <= 0.7 cm";
    let arguments = [
        "plan", "sum.json", "--target", target, "--format", "json", "--trials", "100000",
        "--drift", "b=1 yr",
    ];
    let found = answer(folder.path(), &arguments);
    assert_eq!(number(&found["target"]), 7.0);
    assert!((number(&found["now"]) - 10.0).abs() < 1e-12);
    let inputs = found["inputs"].as_array().expect("a list");
    assert_eq!(inputs.len(), 3);
    assert!(inputs[0]["needed"].is_null() && inputs[2]["needed"].is_null());
    assert!((number(&inputs[1]["needed"]) - 3.25f64.sqrt()).abs() < 1e-12);
    assert!(inputs.iter().all(|input| input["readings_needed"].is_null()));
    let cheapest = found["cheapest"].as_array().expect("a list");
    let planned = |place: usize| number(&cheapest[place]["standard_uncertainty"]);
    assert!((planned(0).powi(2) + planned(1).powi(2) - 12.25).abs() < 1e-11);
    // u0 is 3 and 4, costs u0/u: a^3 : b^3 = 3 : 4
    assert!((planned(0).powi(3) / planned(1).powi(3) - 0.75).abs() < 1e-11);
    // within five standard errors (false failure 6e-7)
    let (half, error) =
        (number(&found["check"]["U"]), number(&found["check"]["numerical_standard_error"]));
    assert!((half - 7.0).abs() < 5.0 * error, "{half} +- {error}");
    assert!((number(&found["interval"]["longest"]) - 3.25f64.sqrt() / 4.0).abs() < 1e-12);
}

#[test]
fn pages_and_costs_of_the_examples() {
    let folder = root().join("models/plan");
    let with = |format: &str| {
        let arguments =
            ["plan", "source.json", "--cost", "costs.json", "--target", "U(source) <= 8 uV"];
        let mut all = arguments.to_vec();
        all.extend(["--trials", "100000", "--format", format]);
        let found = run(&folder, &all);
        assert!(found.status.success(), "{}", String::from_utf8_lossy(&found.stderr));
        String::from_utf8(found.stdout).expect("text")
    };
    let found: Value = serde_json::from_str(&with("json")).expect("JSON");
    assert_eq!((&found["currency"], &found["costs"]), (&"EUR".into(), &"stated".into()));
    assert!(number(&found["planned"]["expanded_uncertainty"]) <= 8e-6);
    let cost: f64 =
        found["cheapest"].as_array().expect("a list").iter().map(|of| number(&of["cost"])).sum();
    assert!((cost - number(&found["cost"])).abs() < 1e-9 * cost);
    let page = with("table");
    assert!(page.lines().all(|line| line.chars().count() <= 100), "{page}");
    for text in [&page, &with("markdown"), &with("html"), &with("csv")] {
        for name in ["reference/calibration", "reference/drift", "difference", "thermal"] {
            assert!(text.contains(name), "{text}");
        }
    }
    assert!(with("html").matches("<svg class=\"wide\"").count() == 1);
    let checked = run(&folder, &["check", "costs.json"]);
    assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stderr));
}

#[test]
fn what_cannot_be_planned_is_said() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    fs::write(path.join("sum.json"), SUM).expect("a file");
    let cost = |text: &str| fs::write(path.join("cost.json"), text).expect("a file");
    let wrong = |arguments: &[&str]| {
        let mut all = vec!["plan", "sum.json", "--trials", "0"];
        all.extend(arguments);
        let found = run(path, &all);
        assert_eq!(found.status.code(), Some(2), "{arguments:?}");
        assert!(found.stdout.is_empty(), "{arguments:?}");
        String::from_utf8(found.stderr)
            .expect("text")
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ")
    };
    let target = |target: &str| wrong(&["--target", target]);
    assert!(target("U(z) <= 1").contains("there is no output `z`"));
    assert!(target("U(y) <= 1 kg").contains("`1 kg`"));
    assert!(target("U(y) <= 0 mm").contains("above zero"));
    assert!(target("y < 7").contains("is written"));
    assert!(target("U(y) <= 11 mm").contains("is already met: U(y) is 10 mm now"));
    let costs = || wrong(&["--target", "U(y) <= 7 mm", "--cost", "cost.json"]);
    cost(r#"{"costs": {"a": {"cost": 1}}}"#);
    assert!(costs().contains(
        "cannot be reached: U(y) is still 8 mm with every improvement that the file of costs has"
    ));
    // an offer in the wrong unit: a has 3 mm
    cost(r#"{"costs": {"a": {"offers": [{"standard_uncertainty": 1500, "cost": 15}]}}}"#);
    assert!(costs().contains(
        "U(y) is still 10 mm with every improvement that the file of costs has. The offer of 1500 \
         mm for a (cost 15) is not better than the present value, \
         3 mm. Numbers without a unit are in mm"
    ));
    cost(r#"{"costs": {"aa": {"cost": 1}}}"#);
    assert!(costs().contains("`aa`") && costs().contains("cost.json:1"));
    cost(r#"{"costs": {"a": {"per_reading": 1}}}"#);
    assert!(costs().contains("not evaluated from readings"));
    cost(r#"{"costs": {"a": {"cost": 1, "least": "1 kg"}}}"#);
    assert!(costs().contains("1 kg"));
    cost("");
    assert!(costs().contains("cost.json"));
    let drift = |drift: &str| wrong(&["--target", "U(y) <= 7 mm", "--drift", drift]);
    assert!(drift("d=1 yr").contains("no input or component `d`"));
    assert!(drift("b").contains("is written"));
    assert!(drift("c=1 yr").contains("no uncertainty that could grow"));
}

/// Three readings carry nearly all of U: by the law of propagation U is k u with k of the effective
/// degrees of freedom, and the trials of their t distribution are wider, so that a target between the
/// two is not met. What is proposed instead is the target times the ratio of the two.
#[test]
fn a_target_that_only_the_law_of_propagation_meets_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let model = r#"{"inputs": {
        "E1": {"unit": "mV", "distribution": "normal", "mean": 176.1, "std": 0.3},
        "E2": {"unit": "mV", "distribution": "normal", "mean": -1.2, "std": 0.3},
        "Ex": {"unit": "mV", "distribution": "readings", "values": [85.2, 85.4, 85.1]},
        "pH1": {"distribution": "normal", "mean": 4.005, "expanded": 0.01, "k": 2},
        "pH2": {"distribution": "normal", "mean": 7.0, "expanded": 0.01, "k": 2}},
        "equations": {"pHx": "pH1 + (Ex - E1)*(pH2 - pH1)/(E2 - E1)"}, "outputs": {"pHx": {}}}"#;
    fs::write(path.join("ph.json"), model).expect("a file");
    let said = |target: &str, trials: &str| {
        let found = run(path, &["plan", "ph.json", "--target", target, "--trials", trials]);
        assert_eq!(found.status.code(), Some(2), "{target}");
        String::from_utf8(found.stderr).expect("text")
    };
    let few = said("U(pHx) <= 0.011", "200000");
    let has = |part: &str| few.contains(part);
    assert!(has("met by the law of propagation (0.01055), which is used for planning"), "{few}");
    let number_behind = |words: &str| -> f64 {
        let rest = few.split_once(words).expect("these words").1;
        let end = rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(rest.len());
        rest[..end].parse().expect("a number")
    };
    let (by_trials, instead) =
        (number_behind("trials give "), number_behind("plan for U(pHx) <= "));
    // a million trials give 0.0121, and 200 000 half the length of the interval to 0.4 %
    assert!((by_trials / 0.0121 - 1.0).abs() < 0.02, "{few}");
    // both are rounded to four digits
    assert!((instead / (0.011 * 0.01055 / by_trials) - 1.0).abs() < 1e-3, "{few}");
    assert!(said("U(pHx) <= 0.02", "200000").contains("already met: U(pHx) is 0.01055 now"));
    assert!(said("U(pHx) <= 0.011", "0").contains("already met"));
}

/// A share of an estimate that its uncertainty hides is hardly what is wanted.
#[test]
fn a_share_of_next_to_nothing_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    // y = 1.5 mm with U = 10 mm
    let text = SUM.replace("\"mean\": 100", "\"mean\": -49.5");
    fs::write(folder.path().join("near.json"), text).expect("a file");
    fs::write(folder.path().join("far.json"), SUM).expect("a file");
    for (file, target, told) in [
        ("near.json", "U(y) <= 50 %", true),
        ("near.json", "U(y) <= 7 mm", false),
        ("far.json", "U(y) <= 5 %", false),
    ] {
        let found = run(folder.path(), &["plan", file, "--target", target, "--trials", "0"]);
        assert!(found.status.success(), "{}", String::from_utf8_lossy(&found.stderr));
        let page = String::from_utf8_lossy(&found.stdout).into_owned();
        assert_eq!(page.contains("smaller than its uncertainty"), told, "{file} {target}: {page}");
    }
}

/// An offer that is no better than what there is is named in a plan that goes without it.
#[test]
fn an_offer_that_helps_nothing_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("sum.json"), SUM).expect("a file");
    let costs = r#"{"costs": {"a": {"offers": [{"standard_uncertainty": 1500, "cost": 15},
        {"standard_uncertainty": "1500 um", "cost": 15}]}, "b": {"cost": 1}}}"#;
    fs::write(folder.path().join("cost.json"), costs).expect("a file");
    let arguments =
        ["plan", "sum.json", "--target", "U(y) <= 7 mm", "--cost", "cost.json", "--trials", "0"];
    let found = run(folder.path(), &arguments);
    assert_eq!(found.status.code(), Some(0));
    let page = String::from_utf8(found.stdout).expect("text");
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(page.matches("is not better than the present value, 3 mm").count(), 1, "{page}");
    assert!(page.contains("The offer of 1500 mm for a (cost 15)"), "{page}");
}

/// The coefficients of a calibration line stay as they are, with their correlation: at the reading y0
/// the line through points of scatter s has u^2 = s^2/b^2 (1/6 + (x0 - mean x)^2/Sxx), and the reading's
/// (u/b)^2 is what is left of u(force) = 0.18 kN. Halving a width costs 1. The tolerance is that of the
/// bisection and of the fit.
#[test]
fn parameters_of_a_fit_are_kept() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = r#"{"fits": {"line": {"x": {"unit": "kN", "values": [1, 2, 3, 4, 5, 6]},
            "y": {"unit": "mV/V", "values": [3.3, 5.6, 7.1, 9.3, 10.7, 12.1]}}},
        "inputs": {"reading": {"unit": "mV/V", "distribution": "rectangular", "mean": 10.5,
            "half_width": 0.5}},
        "equations": {"force": "inverse(line, reading)"}, "outputs": {"force": {"unit": "kN"}}}"#;
    fs::write(folder.path().join("force.json"), model).expect("a file");
    let target = "u(force) <= 0.18 kN";
    let arguments = ["plan", "force.json", "--target", target, "--format", "json", "--trials", "0"];
    let found = answer(folder.path(), &arguments);
    let points = [3.3, 5.6, 7.1, 9.3, 10.7, 12.1];
    let mean: f64 = points.iter().sum::<f64>() / 6.0;
    let about = |of: f64| of - 3.5;
    let products = points.iter().zip(1..).map(|(y, x)| about(f64::from(x)) * y);
    let slope = products.sum::<f64>() / 17.5;
    let off = |(y, x): (&f64, i32)| (y - mean - slope * about(f64::from(x))).powi(2);
    let scatter = points.iter().zip(1..).map(off).sum::<f64>() / 4.0;
    let beside = (10.5 - mean) / slope;
    let of_fit = scatter / slope.powi(2) * (1.0 / 6.0 + beside.powi(2) / 17.5);
    let needed = slope * (0.18_f64.powi(2) - of_fit).sqrt();
    let inputs = found["inputs"].as_array().expect("a list");
    for input in inputs {
        if input["input"] == "reading" {
            let found = number(&input["needed"]);
            assert!((found / needed - 1.0).abs() < 1e-9, "{found} {needed}");
        } else {
            assert!(input["why"].as_str().expect("a reason").contains("calibration function"));
            assert!(input["needed"].is_null(), "{input}");
        }
    }
    let cheapest = found["cheapest"].as_array().expect("a list");
    assert_eq!(cheapest.len(), 1);
    let by_hand = 0.5 / 3.0_f64.sqrt() / needed - 1.0;
    assert!((number(&found["cost"]) / by_hand - 1.0).abs() < 1e-8, "{} {by_hand}", found["cost"]);
}

/// The cosine of an angle about 0 deg is no part of U, and all of what the trials give: neither a lower
/// target nor a better force helps, and what is advised does.
#[test]
fn an_input_that_the_law_of_propagation_does_not_see_is_named() {
    let torque = |half_width: f64| {
        format!(
            r#"{{"inputs": {{
            "F": {{"unit": "N", "distribution": "normal", "mean": 98.1, "std": 0.001}},
            "phi": {{"unit": "deg", "distribution": "rectangular", "mean": 0, "half_width": {half_width}}}}},
            "equations": {{"M": "F*0.5 [m]*cos(phi)"}}, "outputs": {{"M": {{"unit": "N m"}}}},
            "monte_carlo": {{"trials": 50000}}}}"#
        )
    };
    let folder = tempfile::tempdir().expect("a folder");
    let plan = |half_width: f64, target: &str, more: &[&str]| {
        fs::write(folder.path().join("m.json"), torque(half_width)).expect("a file");
        let asked = [&["plan", "m.json", "--target", target], more].concat();
        let found = run(folder.path(), &asked);
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let words = text(&found.stderr) + &text(&found.stdout);
        words.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let target = "U(M) <= 0.0015 N m";
    let said = plan(2.0, target, &[]);
    assert!(said.contains("`phi` is the cause"), "{said}");
    assert!(!said.contains("plan for U(M)"), "{said}");
    let behind = said.split("with u(`phi`) = ").nth(1).expect("a number");
    let needed: f64 = behind.split(' ').next().and_then(|u| u.parse().ok()).expect("a number");
    // with it the trials do come to the target: it is met
    let met = plan(needed * 3.0_f64.sqrt(), target, &["--trials", "220000"]);
    assert!(met.contains("is already met"), "{met}");
    // a plan that the trials refute says the same
    let page = plan(2.0, "U(M) <= 0.0005 N m", &[]);
    assert!(page.contains("a lower target does not help: `phi` is the cause"), "{page}");
    let found = plan(2.0, "U(M) <= 0.0005 N m", &["--format", "json", "--quiet"]);
    let found: Value = serde_json::from_str(&found).expect("JSON");
    assert_eq!(found["check"]["excess"]["input"], "phi");
}
