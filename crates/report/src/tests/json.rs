//! The answer for programs.

use super::*;
use crate as report;
use gumption_engine::fact;

#[test]
fn whole_answer_in_the_order_of_the_contract() {
    let mut case = only_z(Case::new(plane_at(35.0, 2000)));
    let fact = fact!("few-trials", trials = 2000_u64, probability = 0.95, needed = 200_000_u64);
    case.warnings.push(Warning::new("", fact));
    // sensitivities and figures from trials have digits that are not the point here
    insta::with_settings!({filters => vec![
        (r"-?\d+\.\d{6,}(e-?\d+)?", "[number]"),
        (r#""gumption": "[^"]*""#, r#""gumption": "[version]""#),
    ]}, {
        insta::assert_snapshot!(report::json(&case.report()), @r#"
        {
          "gumption": "[version]",
          "title": "inclined-plane",
          "coverage_probability": 0.95,
          "source": null,
          "model": {
            "name": "inclined-plane",
            "source": "Prato, Mazzoleni, Schiavi (2020), equations (1)-(3); Chiominto et al. (2024), equation (1)"
          },
          "equations": {
            "a_x": "abs(a_ref*sin(tilt)*cos(rotation))",
            "a_y": "abs(a_ref*sin(tilt)*sin(rotation))",
            "a_z": "abs(a_ref*cos(tilt))"
          },
          "inputs": [
            {
              "name": "a_ref",
              "unit": "m/s^2",
              "estimate": 10.0,
              "standard_uncertainty": 0.01,
              "dof": null,
              "distribution": "normal",
              "type": "B",
              "group": null,
              "source": "Reference acceleration along the vertical, RMS."
            },
            {
              "name": "tilt",
              "unit": "deg",
              "estimate": 35.0,
              "standard_uncertainty": [number],
              "dof": null,
              "distribution": "rectangular",
              "type": "B",
              "group": null,
              "source": "Tilt angle of the plane against the horizontal."
            },
            {
              "name": "rotation",
              "unit": "deg",
              "estimate": 0.0,
              "standard_uncertainty": 0.0,
              "dof": null,
              "distribution": "constant",
              "type": "B",
              "group": null,
              "source": "Rotation angle of the sensor on the plane."
            }
          ],
          "outputs": {
            "a_z": {
              "unit": "m/s^2",
              "gum": {
                "estimate": [number],
                "standard_uncertainty": [number],
                "dof": null,
                "dof_status": "infinite",
                "coverage_factor": [number],
                "expanded_uncertainty": [number],
                "interval": [
                  [number],
                  [number]
                ],
                "budget": [
                  {
                    "input": "a_ref",
                    "estimate": 10.0,
                    "standard_uncertainty": 0.01,
                    "distribution": "normal",
                    "type": "B",
                    "group": null,
                    "dof": null,
                    "sensitivity": [number],
                    "contribution": [number],
                    "share": [number]
                  },
                  {
                    "input": "tilt",
                    "estimate": 35.0,
                    "standard_uncertainty": [number],
                    "distribution": "rectangular",
                    "type": "B",
                    "group": null,
                    "dof": null,
                    "sensitivity": [number],
                    "contribution": [number],
                    "share": [number]
                  },
                  {
                    "input": "rotation",
                    "estimate": 0.0,
                    "standard_uncertainty": 0.0,
                    "distribution": "constant",
                    "type": "B",
                    "group": null,
                    "dof": null,
                    "sensitivity": 0.0,
                    "contribution": 0.0,
                    "share": 0.0
                  }
                ],
                "subtotals": [
                  {
                    "group": null,
                    "share": 1.0
                  },
                  {
                    "type": "A",
                    "share": 0.0
                  },
                  {
                    "type": "B",
                    "share": 1.0
                  }
                ]
              },
              "monte_carlo": {
                "trials": 2000,
                "seed": 1,
                "estimate": [number],
                "standard_uncertainty": [number],
                "median": [number],
                "symmetric_interval": [
                  [number],
                  [number]
                ],
                "shortest_interval": [
                  [number],
                  [number]
                ],
                "shortest_exact": true,
                "shortest_unique": true,
                "skewness": [number],
                "excess_kurtosis": [number],
                "numerical_standard_error": {
                  "estimate": [number],
                  "standard_uncertainty": [number],
                  "median": [number],
                  "symmetric_interval": [
                    [number],
                    [number]
                  ],
                  "shortest_interval": [
                    null,
                    null
                  ],
                  "skewness": null,
                  "excess_kurtosis": null
                }
              },
              "validation": {
                "digits": 2,
                "tolerance": 0.0005,
                "d_low": [number],
                "d_high": [number],
                "gum_valid": null
              }
            }
          },
          "output_correlations": [],
          "warnings": [
            {
              "code": "few-trials",
              "where": "",
              "text": "2000 trials are few for a coverage probability of 0.95: JCGM 101, 7.2.2 advises at least 200000"
            }
          ],
          "provenance": {
            "model_sha256": "0123",
            "seed": 1,
            "trials": 2000,
            "files": {
              "data.csv": "4567"
            }
          }
        }
        "#);
    });
}

#[test]
fn same_bytes_on_any_number_of_threads() {
    let answers = [1, 2, 5].map(|threads| {
        let mut case = Case::new(plane_at(35.0, 20_000));
        let control = Control::default().with_threads(threads);
        case.evaluation = evaluate(&case.task, &control).unwrap();
        report::json(&case.report())
    });
    assert!(answers.iter().all(|answer| *answer == answers[0]));
}

#[test]
fn correlation_rows_come_after_the_inputs() {
    let answer = Case::new(correlated(2000)).json();
    let gum = &answer["outputs"]["a_z"]["gum"];
    let row = &gum["budget"][3];
    assert!(row["input"].is_null() && row["contribution"].is_null());
    assert_eq!(row["correlation"], serde_json::json!(["a_ref", "tilt"]));
    assert_eq!(row["coefficient"], -0.6);
    let shares = gum["budget"].as_array().unwrap().iter().map(|row| row["share"].as_f64());
    assert!((shares.map(Option::unwrap).sum::<f64>() - 1.0).abs() < 1e-12);
    let pairs = &answer["output_correlations"];
    assert_eq!((&pairs[1][0], &pairs[1][1]), (&"a_x".into(), &"a_z".into()));
    // rotation 0: a_y does not vary to first order, but does not in the trials either
    assert!(pairs[0][2].is_null());
}

#[test]
fn subtotals_by_group_and_type() {
    let answer = Case::new(grouped(2000)).json();
    let gum = &answer["outputs"]["a_y"]["gum"];
    let subtotals = gum["subtotals"].as_array().unwrap();
    let labels: Vec<String> = subtotals
        .iter()
        .map(|entry| entry.get("group").unwrap_or(&entry["type"]).to_string())
        .collect();
    assert_eq!(labels, [r#""angles""#, "null", r#""A""#, r#""B""#]);
    let share = |place: usize| subtotals[place]["share"].as_f64().unwrap();
    assert!((share(0) + share(1) - 1.0).abs() < 1e-12);
    assert!((share(2) - share(1)).abs() < 1e-12);
    assert_eq!(gum["budget"][1]["drawn_as"], "t");
    assert_eq!(gum["budget"][0]["dof"], 4.0);
}

#[test]
fn nothing_without_trials() {
    let answer = Case::new(plane_at(35.0, 0)).json();
    let output = &answer["outputs"]["a_z"];
    assert!(output["monte_carlo"].is_null() && output["validation"].is_null());
    assert_eq!(output["gum"]["dof_status"], "infinite");
    assert!(output["gum"]["dof"].is_null());
}

#[test]
fn rows_of_a_sweep() {
    let answer = sweep(&[0.0, 35.0], 2000).json();
    assert!(answer.get("outputs").is_none());
    let rows = answer["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 2);
    assert_eq!(rows[1]["conditions"], serde_json::json!({"f": 80.0, "tilt": 35.0}));
    assert!(rows[1]["outputs"]["a_z"]["gum"]["budget"].is_array());
    assert_eq!(rows[1]["output_correlations"].as_array().unwrap().len(), 3);
}

#[test]
fn a_stopped_run_says_so() {
    let mut case = Case::new(plane_at(35.0, 2000));
    case.evaluation.stopped = true;
    let answer = case.json();
    assert_eq!(answer["stopped"], true);
    assert_eq!(answer["outputs"]["a_x"]["monte_carlo"]["stopped"], true);
}

/// A temperature of two components: u^2 = 0.04^2 + (0.05/sqrt(3))^2.
fn composed() -> Case {
    let task = Task::builder("humidity")
        .input("t", Input::constant(23.0, "degC").unwrap().about("air temperature"))
        .component("t", "cal", Input::normal(0.0, 0.04, "degC").unwrap().about("calibration"))
        .component("t", "res", Input::rectangular(0.0, 0.05, "degC").unwrap())
        .input("gain", Input::normal(2.0, 0.01, "1").unwrap())
        .equation("count", "t/[degC]")
        .equation("y", "gain*count")
        .output("y", "1")
        .trials(0)
        .build()
        .unwrap();
    Case::new(task)
}

#[test]
fn inputs_of_the_answer_have_their_components() {
    let answer = composed().json();
    assert_eq!(answer["equations"]["y"], "gain*count");
    assert_eq!(answer["equations"].as_object().unwrap().keys().next().unwrap(), "count");
    let [t, gain] = answer["inputs"].as_array().unwrap().as_slice() else { panic!("{answer}") };
    assert_eq!((&t["estimate"], &t["source"]), (&23.0.into(), &"air temperature".into()));
    let u = (0.0016_f64 + 0.0025 / 3.0).sqrt();
    assert!((t["standard_uncertainty"].as_f64().unwrap() - u).abs() < 1e-15);
    assert!(t["distribution"].is_null() && t["dof"].is_null());
    let parts = t["components"].as_array().unwrap();
    assert_eq!(parts.len(), 2, "the constant that they are added to is none");
    assert_eq!((&parts[0]["name"], &parts[0]["source"]), (&"t/cal".into(), &"calibration".into()));
    assert!(gain.get("components").is_none());
    assert_eq!(gain["distribution"], "normal");
}

#[test]
fn a_budget_states_the_estimate_of_a_sum_of_components() {
    let case = composed();
    for page in [
        report::table(&case.report(), &full()),
        report::markdown(&case.report(), &Default::default()),
        report::latex(&case.report(), &Default::default()),
        report::html(&case.report(), &Default::default()),
    ] {
        let words: Vec<&str> =
            page.split([' ', '\n', '|', '<', '>', '&']).filter(|w| !w.is_empty()).collect();
        let place = |word: &str| words.iter().position(|found| *found == word);
        // the list of quantities names the component before
        let component = words.iter().rposition(|found| *found == "t/cal").unwrap();
        assert!(place("23.000").unwrap() < component, "{page}");
        assert!(page.contains("0.049") && page.contains("components"), "{page}");
        assert!(
            [
                "gain*count",
                r"gain\*count",
                "<mi>gain</mi><mo>⋅</mo><mi>count</mi>",
                r"\mathit{gain} \cdot \mathit{count}"
            ]
            .iter()
            .any(|e| page.contains(e)),
            "{page}"
        );
    }
}

/// What is the same in all rows stands once, what differs stands in the rows.
#[test]
fn inputs_that_differ_between_rows_stand_there() {
    let task = Task::builder("sweep")
        .input("x", Input::normal(1.0, 0.1, "1").unwrap())
        .input("b", Input::normal(0.0, 0.2, "1").unwrap())
        .equation("y", "x + b")
        .output("y", "1")
        .conditions(&[("f", "1")], [[2.0], [3.0]])
        .estimate("x", "f")
        .trials(0)
        .build()
        .unwrap();
    let answer = Case::new(task).json();
    assert!(answer["inputs"][0]["estimate"].is_null());
    assert_eq!(answer["inputs"][1]["standard_uncertainty"], 0.2);
    for (row, estimate) in [(0, 2.0), (1, 3.0)] {
        let inputs = answer["rows"][row]["inputs"].as_array().unwrap();
        assert_eq!(inputs.len(), 1);
        assert_eq!((&inputs[0]["name"], &inputs[0]["estimate"]), (&"x".into(), &estimate.into()));
    }
}
