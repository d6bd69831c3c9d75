//! Model files of any size, written by rule: many inputs, correlated inputs, long formulas, many
//! outputs.

use std::fmt::Write;

use gumption::file::{Diagnostics, read_text};
use gumption::task::{Task, Trials};
use serde_json::{Map, Value, json};

/// Distinct inputs of the long formula.
const FORMULA_INPUTS: usize = 10;

/// Reads a generated model. It stands alone, so it has no folder.
fn read(model: &Value, trials: u64) -> Result<Task, Diagnostics> {
    let mut task = read_text("generated", &model.to_string(), "".as_ref(), &[])?.task;
    task.settings.trials = Trials::Fixed(trials);
    task.settings.coverage = 0.95.into();
    Ok(task)
}

fn names(count: usize) -> Vec<String> {
    (1..=count).map(|i| format!("x_{i}")).collect()
}

fn same_inputs(names: &[String], distribution: &Value) -> Value {
    let inputs = names.iter().map(|name| (name.clone(), distribution.clone()));
    Value::Object(inputs.collect::<Map<_, _>>())
}

fn rectangular() -> Value {
    json!({"distribution": "rectangular", "mean": 1, "half_width": 0.1})
}

/// The sum of `count` quantities that are known in the same way.
///
/// # Errors
/// A distribution that is not one.
pub fn sum_of(count: usize, distribution: &Value, trials: u64) -> Result<Task, Diagnostics> {
    let names = names(count);
    let model = json!({
        "format": 1,
        "inputs": same_inputs(&names, distribution),
        "equations": {"y": names.join(" + ")},
        "outputs": {"y": {}},
    });
    read(&model, trials)
}

/// The sum of `count` rectangular quantities.
///
/// # Errors
/// None are expected.
pub fn sum(count: usize, trials: u64) -> Result<Task, Diagnostics> {
    sum_of(count, &rectangular(), trials)
}

/// The sum of `count` normal quantities, each correlated with every other: 0.9 to the power of
/// their distance in the list.
///
/// # Errors
/// None are expected.
pub fn correlated(count: usize, trials: u64) -> Result<Task, Diagnostics> {
    let names = names(count);
    let row = |i: usize| (0..count).map(|j| 0.9f64.powi(i.abs_diff(j) as i32)).collect();
    let values: Vec<Vec<f64>> = (0..count).map(row).collect();
    let model = json!({
        "format": 1,
        "inputs": same_inputs(&names, &json!({"distribution": "normal", "mean": 1, "std": 0.1})),
        "correlation_matrix": {"names": names, "values": values},
        "equations": {"y": names.join(" + ")},
        "outputs": {"y": {}},
    });
    read(&model, trials)
}

/// A formula of about `operations` operations on ten quantities: a quarter sines, half products,
/// a quarter sums; no two terms alike.
///
/// # Errors
/// None are expected.
pub fn formula(operations: usize, trials: u64) -> Result<Task, Diagnostics> {
    let names = names(FORMULA_INPUTS);
    let mut text = names.join(" + ");
    for term in 0..operations / 4 {
        let (a, b) = (term % FORMULA_INPUTS, (term / FORMULA_INPUTS) % FORMULA_INPUTS);
        let factor = 1.0 + term as f64 / 8192.0;
        // writing to a string cannot fail
        let _ = write!(text, " + sin({factor}*{})*{}", names[a], names[b]);
    }
    let model = json!({
        "format": 1,
        "inputs": same_inputs(&names, &rectangular()),
        "equations": {"y": text},
        "outputs": {"y": {}},
    });
    read(&model, trials)
}

/// `count` outputs of two shared quantities.
///
/// # Errors
/// None are expected.
pub fn outputs(count: usize, trials: u64) -> Result<Task, Diagnostics> {
    let formula = |k: usize| (format!("y_{k}"), json!(format!("x_1 + {k}*x_2")));
    let output = |k: usize| (format!("y_{k}"), json!({}));
    let model = json!({
        "format": 1,
        "inputs": same_inputs(&names(2), &rectangular()),
        "equations": (1..=count).map(formula).collect::<Map<_, _>>(),
        "outputs": (1..=count).map(output).collect::<Map<_, _>>(),
    });
    read(&model, trials)
}
