//! Budgets in columns against budgets of single rows.
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use gumption_engine::distribution::Correlation;
use gumption_engine::model::Program;
use gumption_engine::number::CodePath;
use gumption_engine::propagate::gum;
use gumption_engine::propagate::gum::Dof;
use gumption_engine::propagate::gum::bulk::{
    BulkError, BulkInput, BulkOptions, BulkValue, budgets,
};
use gumption_engine::task::Task;

/// The inclined plane with spurious motion over three conditions, some inputs of which vary with
/// them, with few degrees of freedom, correlated.
const PLANE: &str = r#"{
  "inputs": {
    "a": {"unit": "m/s^2", "distribution": "normal", "mean": "h", "std": "0.1 %"},
    "tilt": {"unit": "deg", "distribution": "rectangular", "mean": "g", "half_width": 0.1},
    "b": {"unit": "m/s^2", "distribution": "normal", "mean": 0.2, "std": 0.03, "dof": 4},
    "c": {"unit": "m/s^2", "distribution": "normal", "mean": 0.1, "std": 0.02, "dof": 7},
    "d": {"unit": "m/s^2", "distribution": "constant", "value": 0.5}
  },
  "correlations": [CORRELATIONS],
  "conditions": {"g": {"unit": "deg", "values": [VALUES]}, "h": {"unit": "m/s^2", "values": [9, 10]}},
  "equations": {"s": "sqrt((a*sin(tilt) + b)^2 + (c + d)^2)", "t": "max(b, c) + a*exp(-g*2)*cos(tilt)"},
  "outputs": {"s": {"unit": "m/s^2"}, "t": {"unit": "m/s^2"}},
  "monte_carlo": {"trials": 0}
}"#;

fn task(correlations: &str) -> Task {
    let values: Vec<String> = (0..150).map(|g| g.to_string()).collect();
    let text = PLANE.replace("VALUES", &values.join(", ")).replace("CORRELATIONS", correlations);
    gumption_files::read_text("plane", &text, std::path::Path::new("."), &[]).unwrap().task
}

/// Columns of what is known of the task's variables.
fn columns(task: &Task) -> Vec<[Vec<f64>; 3]> {
    let of = |v: usize| {
        let each = |f: fn(&gumption_engine::distribution::Distribution) -> f64| {
            task.rows.iter().map(|row| f(&row.distributions[v])).collect()
        };
        [each(|d| d.mean()), each(|d| d.standard_uncertainty()), each(|d| d.dof())]
    };
    (0..task.variables.len()).map(of).collect()
}

/// A column; the number itself if all are the same and `short` is wanted.
fn each(column: &[f64], short: bool) -> BulkValue<'_> {
    let same = short && column.iter().all(|x| *x == column[0]);
    if same { BulkValue::Same(column[0]) } else { BulkValue::Rows(column) }
}

/// The same bits as an evaluation row by row, on every code path, with a declared correlation and
/// without, whether columns are given as columns or as the number that all their entries are.
#[test]
fn budgets_in_columns_are_those_of_single_rows() {
    for correlations in ["", r#"["a", "tilt", -0.5], ["b", "c", 0.3]"#] {
        let task = task(correlations);
        let columns = columns(&task);
        let conditions: [Vec<f64>; 2] =
            [0, 1].map(|c| task.rows.iter().map(|row| row.conditions[c]).collect());
        for (short, path) in CodePath::available().into_iter().flat_map(|p| [(false, p), (true, p)])
        {
            let known: Vec<BulkInput<'_>> = columns
                .iter()
                .map(|[mean, u, dof]| BulkInput {
                    estimate: each(mean, short),
                    standard_uncertainty: each(u, short),
                    dof: each(dof, short),
                })
                .collect();
            let options = BulkOptions {
                correlations: &task.correlations,
                coverage: task.settings.coverage,
                path,
                ..BulkOptions::default()
            };
            let made = budgets(
                &task.model.program,
                &known,
                &[BulkValue::Rows(&conditions[0]), BulkValue::Rows(&conditions[1])],
                options,
            )
            .unwrap();
            for (number, row) in task.rows.iter().enumerate() {
                let alone = gum::evaluate(&task, row);
                for (ours, alone) in made.iter().zip(&alone.outputs) {
                    let alone = alone.as_ref().unwrap();
                    let dof = match alone.dof {
                        Dof::Finite(dof) => dof,
                        Dof::Infinite => f64::INFINITY,
                        Dof::Undefined => f64::NAN,
                    };
                    let pairs = [
                        (ours.estimates[number], alone.estimate),
                        (ours.standard_uncertainties[number], alone.standard_uncertainty),
                        (ours.dof[number], dof),
                        (ours.coverage_factors[number], alone.coverage_factor.unwrap_or(f64::NAN)),
                    ];
                    for (ours, alone) in pairs {
                        assert_eq!(ours.to_bits(), alone.to_bits(), "row {number}, {ours} {alone}");
                    }
                    for line in alone.budget() {
                        let v = line.variable;
                        assert_eq!(ours.sensitivities[v][number], line.sensitivity);
                        assert_eq!(ours.contributions[v][number], line.contribution);
                    }
                }
            }
        }
    }
}

/// What no measurement has is refused, and not added up.
#[test]
fn impossible_arguments_are_refused() {
    let recorder = gumption_engine::model::Recorder::default();
    let program = recorder.program(2, &[recorder.variable(0) + recorder.variable(1)]);
    let refused = |u: f64, dof: f64, coverage: f64, correlations: &[Correlation]| {
        let (estimate, standard_uncertainty) = (BulkValue::Same(1.0), BulkValue::Same(u));
        let known = [
            BulkInput { estimate, standard_uncertainty, dof: BulkValue::Same(dof) },
            BulkInput::new(BulkValue::Rows(&[1.0, 2.0]), BulkValue::Same(0.2)),
        ];
        let coverage = coverage.into();
        let options = BulkOptions { coverage, correlations, ..BulkOptions::default() };
        budgets(&program, &known, &[], options).map(drop)
    };
    let of = |first, second| Correlation { first, second, coefficient: -0.5 };
    assert_eq!(refused(0.1, 5.0, 0.95, &[]), Ok(()));
    assert_eq!(refused(0.1, f64::INFINITY, 0.95, &[of(0, 1)]), Ok(()));
    let twice = refused(0.1, f64::INFINITY, 0.95, &[of(0, 1), of(1, 0)]);
    assert_eq!(twice, Err(BulkError::CorrelationTwice([0, 1])));
    assert_eq!(refused(-0.1, 5.0, 0.95, &[]), Err(BulkError::Uncertainty { input: 0, row: 0 }));
    assert_eq!(refused(0.1, -3.0, 0.95, &[]), Err(BulkError::Dof { input: 0, row: 0 }));
    assert!(matches!(refused(0.1, 5.0, 95.0, &[]), Err(BulkError::Coverage { .. })));
}

/// sqrt(x) at 0 has no sensitivity coefficient; the other rows are not touched.
#[test]
fn a_row_without_a_budget_says_so() {
    let recorder = gumption_engine::model::Recorder::default();
    let x = recorder.variable(0);
    let program = recorder.program(1, &[gumption_engine::number::Number::sqrt(x)]);
    let known = [BulkInput::new(BulkValue::Rows(&[0.0, 4.0]), BulkValue::Same(0.1))];
    let made = budgets(&program, &known, &[], BulkOptions::default()).unwrap();
    assert_eq!(made[0].estimates, [0.0, 2.0]);
    assert!(made[0].standard_uncertainties[0].is_nan() && made[0].coverage_factors[0].is_nan());
    assert!((made[0].standard_uncertainties[1] - 0.025).abs() < 1e-17);
}

#[test]
fn what_does_not_fit_is_refused() {
    let program = Program { variables: 2, ..Program::default() };
    let one = BulkInput::new(BulkValue::Same(1.0), BulkValue::Same(0.1));
    let two = BulkInput::new(BulkValue::Rows(&[1.0, 2.0]), BulkValue::Same(0.1));
    let three = BulkInput::new(BulkValue::Rows(&[1.0, 2.0, 3.0]), BulkValue::Same(0.1));
    let run = |known: &[BulkInput<'_>], correlations: &[Correlation]| {
        budgets(&program, known, &[], BulkOptions { correlations, ..BulkOptions::default() })
            .unwrap_err()
    };
    assert_eq!(run(&[one], &[]), BulkError::Variables { found: 1, expected: 2 });
    assert_eq!(run(&[two, three], &[]), BulkError::Rows);
    let itself = Correlation { first: 1, second: 1, coefficient: 0.5 };
    assert_eq!(run(&[one, two], &[itself]), BulkError::Correlation);
}
