//! `gumption diff` as a user runs it.

use std::path::PathBuf;

use serde_json::Value;
use tempfile::TempDir;

use crate::support::{gumption, output};

const FIRST: &str = r#"{
  "inputs": {
    "voltage": {"unit": "V", "distribution": "normal", "mean": 5, "std": 0.01},
    "resistance": {"unit": "ohm", "distribution": "rectangular", "mean": 100, "half_width": 0.1},
    "drift": {"unit": "V", "distribution": "rectangular", "mean": 0, "half_width": 0.002}
  },
  "equations": {"power": "(voltage + drift)^2/resistance"},
  "outputs": {"power": {"unit": "mW"}}
}"#;

/// Two files in a folder of their own, the second with some texts replaced.
fn files(replaced: &[(&str, &str)]) -> (TempDir, [PathBuf; 2]) {
    let folder = tempfile::tempdir().unwrap();
    let paths = ["a.json", "b.json"].map(|name| folder.path().join(name));
    let second = replaced.iter().fold(FIRST.to_owned(), |text, (old, new)| {
        assert!(text.contains(old), "{old}");
        text.replace(old, new)
    });
    std::fs::write(&paths[0], FIRST).unwrap();
    std::fs::write(&paths[1], second).unwrap();
    (folder, paths)
}

fn json(paths: &[PathBuf; 2]) -> Value {
    let [a, b] = paths.each_ref().map(|path| path.to_str().unwrap());
    serde_json::from_str(&output(&["diff", a, b, "--format", "json"])).unwrap()
}

#[test]
fn shares_explain_the_change() {
    let (_folder, paths) =
        files(&[("0.01}", "0.02}"), ("0.1}", "0.3}"), ("\"mean\": 5", "\"mean\": 6")]);
    let answer = json(&paths);
    let power = &answer["outputs"]["power"];
    let inputs = power["inputs"].as_array().unwrap();
    let sum = |key: &str| inputs.iter().map(|input| input[key].as_f64().unwrap()).sum::<f64>();
    assert!((sum("share_of_change") - 1.0).abs() < 1e-12, "{power}");
    let [before, after] = [0, 1].map(|i| power["U"][i].as_f64().unwrap());
    assert!((sum("change_of_U") / (after - before) - 1.0).abs() < 1e-12, "{power}");
    let names: Vec<&str> = inputs.iter().map(|input| input["input"].as_str().unwrap()).collect();
    assert_eq!(names, ["voltage", "resistance", "drift"]);
    assert_eq!(inputs[0]["from"]["estimate"], 5.0);
    assert_eq!(inputs[0]["to"]["standard_uncertainty"], 0.02);
    assert_eq!(inputs[1]["from"]["distribution"], "rectangular");
    assert_eq!(inputs[1]["from"]["dof"], Value::Null);
    // the drift's coefficient moves with the voltage, which is the voltage's doing
    assert_eq!(inputs[2]["from"], inputs[2]["to"]);
    assert_eq!(inputs[2]["share_of_change"], 0.0);

    // each file gives the U of its own run
    for (path, expanded) in paths.iter().zip([before, after]) {
        let path = path.to_str().unwrap();
        let run = output(&["run", path, "--trials", "0", "--format", "json", "--quiet"]);
        let run: Value = serde_json::from_str(&run).unwrap();
        let own = run["outputs"]["power"]["gum"]["expanded_uncertainty"].as_f64().unwrap();
        assert!((own / expanded - 1.0).abs() < 1e-14);
    }
}

#[test]
fn the_page_leaves_out_what_did_not_change() {
    let removed = ("\"half_width\": 0.1},", "\"half_width\": 0.1}");
    let drift = r#"
    "drift": {"unit": "V", "distribution": "rectangular", "mean": 0, "half_width": 0.002}"#;
    let (folder, paths) =
        files(&[removed, (drift, ""), ("(voltage + drift)^2", "voltage^2"), ("0.01}", "0.02}")]);
    let [a, b] = paths.each_ref().map(|path| path.file_name().unwrap());
    let run = gumption().current_dir(folder.path()).arg("diff").args([a, b]).assert().success();
    let page = String::from_utf8(run.get_output().stdout.clone()).unwrap();
    insta::assert_snapshot!(page, @r#"
    from a.json to b.json

    equation `power`: from "(voltage + drift)^2/resistance" to "voltage^2/resistance"

    power: U from 2.03 to 4.01 mW (+97.2 %), by the law of propagation
    what changed  from                             to                        change of  share
                                                                               U in mW   in %
    ─────────────────────────────────────────────────────────────────────────────────────────
    voltage       5.000 V, u 0.010, normal         5.000 V, u 0.020, normal       1.99  100.4
    drift         0.0000 V, u 0.0012, rectangular  absent                        -0.01   -0.4
    "#);
}

/// Mistakes of both files are reported, each with its file's name.
#[test]
fn mistakes_of_both_files() {
    let (_folder, paths) = files(&[("\"mean\": 5", "\"mean\": \"five\"")]);
    std::fs::write(&paths[0], FIRST.replace("voltage + drift", "voltage + drifft")).unwrap();
    let run = gumption().arg("diff").args(&paths).assert().code(2);
    let message = String::from_utf8(run.get_output().stderr.clone()).unwrap();
    for part in ["a.json:7:", "drifft", "b.json:3:", "five"] {
        assert!(message.contains(part), "{part}: {message}");
    }
    gumption().args(["diff", "-", "-"]).assert().code(2);
}

#[test]
fn standard_input_and_files() {
    let (folder, paths) = files(&[]);
    let file = folder.path().join("answer.json");
    gumption()
        .args(["diff", "-", paths[1].to_str().unwrap(), "--format", "json", "--output"])
        .arg(&file)
        .write_stdin(FIRST)
        .assert()
        .success()
        .stdout("");
    let answer: Value = serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap();
    assert_eq!(answer["a"], "<stdin>");
    assert_eq!(answer["changes"], Value::Array(Vec::new()));
    assert_eq!(answer["outputs"]["power"]["inputs"][0]["share_of_change"], Value::Null);
}

/// Saves the result of each file beside it.
fn saved(paths: &[PathBuf; 2]) -> [PathBuf; 2] {
    saved_with(paths, "1000")
}

fn saved_with(paths: &[PathBuf; 2], trials: &str) -> [PathBuf; 2] {
    paths.each_ref().map(|path| {
        let result = path.with_extension("result.json");
        let (path, to) = (path.to_str().unwrap(), result.to_str().unwrap());
        output(&["run", path, "--trials", trials, "--save", to, "--quiet"]);
        result
    })
}

/// Where only standard uncertainties change, saved results tell the same as their model files: the
/// same U, inputs and shares, to the rounding of another order of sums. One with the other, too.
#[test]
fn saved_results_tell_the_same() {
    let (_folder, paths) = files(&[("0.01}", "0.02}"), ("0.1}", "0.3}")]);
    let results = saved(&paths);
    let of_models = json(&paths);
    let mixed =
        [[&results[0], &paths[1]], [&paths[0], &results[1]]].map(|pair| pair.map(Clone::clone));
    for pair in [results, mixed[0].clone(), mixed[1].clone()] {
        let answer = json(&pair);
        assert_eq!(answer["changes"], Value::Array(Vec::new()));
        let [one, other] = [&answer, &of_models].map(|answer| &answer["outputs"]["power"]);
        assert_eq!(one["U"], other["U"]);
        let lines = [one, other].map(|power| power["inputs"].as_array().unwrap());
        assert_eq!(lines[0].len(), lines[1].len());
        for (one, other) in lines[0].iter().zip(lines[1]) {
            for key in ["input", "what"] {
                assert_eq!(one[key], other[key]);
            }
            for side in ["from", "to"] {
                for key in ["estimate", "standard_uncertainty", "distribution", "dof", "unit"] {
                    assert_eq!(one[side][key], other[side][key], "{one}");
                }
            }
            for key in ["change_of_U", "share_of_change"] {
                let [a, b] = [one, other].map(|line| line[key].as_f64().unwrap());
                assert!((a - b).abs() < 1e-12, "{one} {other}");
            }
        }
        let sum = |key: &str| lines[0].iter().map(|line| line[key].as_f64().unwrap()).sum::<f64>();
        let [before, after] = [0, 1].map(|i| one["U"][i].as_f64().unwrap());
        assert!((sum("share_of_change") - 1.0).abs() < 1e-12);
        assert!((sum("change_of_U") / (after - before) - 1.0).abs() < 1e-12);
    }
}

/// A moved estimate acts through sensitivity coefficients, which a saved result tells without the
/// reason.
#[test]
fn the_page_of_saved_results() {
    let (folder, paths) = files(&[("0.01}", "0.02}"), ("\"mean\": 100", "\"mean\": 50")]);
    saved(&paths);
    let names = ["a.result.json", "b.result.json"];
    let run = gumption().current_dir(folder.path()).arg("diff").args(names).assert().success();
    let page = String::from_utf8(run.get_output().stdout.clone()).unwrap();
    insta::assert_snapshot!(page, @r"
    from a.result.json to b.result.json

    output `power`: other sensitivity coefficients to `voltage`, `resistance`, `drift`; what that does
    to U is counted with these inputs

    power: U from 2.03 to 8.10 mW (+298.1 %), by the law of propagation
    what changed  from                               to                                 change of  share
                                                                                          U in mW   in %
    ────────────────────────────────────────────────────────────────────────────────────────────────────
    voltage       5.000 V, u 0.010, normal,          5.000 V, u 0.020, normal,               5.92   97.7
                  sensitivity 100.0                  sensitivity 200.0
    resistance    100.000 ohm, u 0.058,              50.000 ohm, u 0.058, rectangular,       0.12    2.0
                  rectangular, sensitivity -2.500    sensitivity -10.00
    drift         0.0000 V, u 0.0012, rectangular,   0.0000 V, u 0.0012, rectangular,        0.02    0.3
                  sensitivity 100.0                  sensitivity 200.0
    ");
}

/// A torque of a force at an angle about 0 deg, whose cosine has no sensitivity to it.
fn torque(half_width: f64) -> String {
    format!(
        r#"{{"inputs": {{
        "F": {{"unit": "N", "distribution": "normal", "mean": 98.1, "std": 0.001}},
        "phi": {{"unit": "deg", "distribution": "rectangular", "mean": 0, "half_width": {half_width}}}}},
        "equations": {{"M": "F*0.5 [m]*cos(phi)"}}, "outputs": {{"M": {{"unit": "N m"}}}},
        "monte_carlo": {{"trials": 20000}}}}"#
    )
}

/// Where clause 8 refutes the U that is compared, the change of the trials' stands beside it. M is
/// c (1 - phi^2/2) with c = 49.05 N m, so that its symmetric interval holds phi^2 from 0.0227 to 0.9773
/// times h of phi, squared: half its length is c h^2 (0.9551 - 0.0005)/4 = 8.914e-4 N m for 0.5 deg and
/// 16 times as much for 2 deg. The tolerance covers u(F) and five standard errors of 20 000 trials.
#[test]
fn a_u_that_is_not_valid_is_said_to_be_so() {
    let folder = tempfile::tempdir().unwrap();
    let paths = [("a.json", 0.5), ("b.json", 2.0)].map(|(name, half_width)| {
        let path = folder.path().join(name);
        std::fs::write(&path, torque(half_width)).unwrap();
        path
    });
    for files in [paths.clone(), saved_with(&paths, "20000")] {
        let answer = json(&files);
        let found = &answer["outputs"]["M"];
        let figure = |key: &str, side: usize| found[key][side].as_f64().unwrap();
        assert!((figure("U", 0) / figure("U", 1) - 1.0).abs() < 1e-12, "{found}");
        assert_eq!(found["gum_valid"], serde_json::json!([false, false]));
        let exact = 49.05 * 2.0_f64.to_radians().powi(2) * 0.9546 / 4.0;
        assert!((figure("U_by_trials", 1) / exact - 1.0).abs() < 0.03, "{found}");
        assert!(figure("U_by_trials", 1) / figure("U_by_trials", 0) > 9.0, "{found}");
        let phi = found["inputs"].as_array().unwrap().iter().find(|of| of["input"] == "phi");
        let phi = phi.expect("an input that changed");
        assert_ne!(phi["from"], phi["to"]);
        let [a, b] = files.each_ref().map(|path| path.to_str().unwrap());
        let page = output(&["diff", a, b]);
        let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(page.contains("U is not validated in either file"), "{page}");
        assert!(page.contains("by the law of propagation") && page.contains("(+0.0 %)"), "{page}");
        assert!(!page.contains("No input changed") && page.contains("phi"), "{page}");
    }
}

/// The page in HTML shows the way from U to U: the largest change first, with its sign.
#[test]
fn a_figure_shows_the_parts_of_the_change() {
    let (_folder, paths) = files(&[("0.01}", "0.02}"), ("0.1}", "0.05}")]);
    let [a, b] = paths.each_ref().map(|path| path.to_str().unwrap());
    let page = output(&["diff", a, b, "--format", "html"]);
    let place = |text: &str| page.find(&format!("\n{text}\n")).unwrap_or_else(|| panic!("{text}"));
    let [before, voltage, resistance, after] =
        ["U before", "voltage", "resistance", "U after"].map(place);
    assert!(before < voltage && voltage < resistance && resistance < after);
    let largest = page[voltage..resistance].contains("\n+");
    assert!(largest && page[resistance..after].contains("\n\u{2212}"), "{page}");
    assert!(page.contains("\nU(power) in mW\n"));
}
