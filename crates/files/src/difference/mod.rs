//! What changed between two files: what `gumption_analysis::diff` makes of their tasks, and the
//! changes of the JSON text that a task no longer knows (equations as they are written).

mod changes;
#[cfg(test)]
mod tests;

use super::ModelFile;
use super::either::ModelOrResult;
use super::result::{ResultFile, SavedOutput};
use gumption_analysis::diff::{
    Difference, LinearOutput, LinearResult, SeveralRows, add_trials, compare, compare_linear,
};
use gumption_engine::distribution::RootName;
use gumption_engine::propagate::Control;
use gumption_text::{DiagnosticKind, Diagnostics};

/// Compares two model files, two saved results, or one with the other.
///
/// # Errors
/// A model file with several rows of conditions that is compared with a saved result.
pub fn difference(
    first: &ModelOrResult,
    second: &ModelOrResult,
    control: &Control<'_>,
) -> Result<Difference, Diagnostics> {
    if let (ModelOrResult::Model(first), ModelOrResult::Model(second)) = (first, second) {
        return Ok(of_models(first, second, control));
    }
    match (linear(first, control), linear(second, control)) {
        (Ok(first), Ok(second)) => Ok(compare_linear(&first, &second)),
        (first, second) => {
            let found = [first.err(), second.err()].into_iter().flatten();
            Err(Diagnostics(found.flat_map(|diagnostics| diagnostics.0).collect()))
        }
    }
}

fn of_models(first: &ModelFile, second: &ModelFile, control: &Control<'_>) -> Difference {
    let mut difference = compare(&first.task, &second.task);
    add_trials(&mut difference, [&first.task, &second.task], control);
    difference.changes.splice(0..0, changes::list(first, second));
    difference
}

fn linear(file: &ModelOrResult, control: &Control<'_>) -> Result<LinearResult, Diagnostics> {
    match file {
        ModelOrResult::Result(file) => Ok(of_result(file)),
        ModelOrResult::Model(file) => of_model(file, control),
    }
}

fn of_model(file: &ModelFile, control: &Control<'_>) -> Result<LinearResult, Diagnostics> {
    LinearResult::of_task(&file.task, control).map_err(|SeveralRows { rows }| {
        file.diagnostic_at("conditions", DiagnosticKind::SeveralRows { rows })
    })
}

/// The outputs of a result file. One without sensitivity coefficients is its own input.
fn of_result(file: &ResultFile) -> LinearResult {
    let mut inputs = file.inputs.clone();
    let output = |saved: &SavedOutput| {
        let sensitivities = saved.sensitivities.clone().unwrap_or_else(|| {
            let own = saved.distribution.saved().map(|s| &s.origin().roots);
            let before = inputs.len();
            inputs.extend(own.into_iter().flatten().map(|(root, _)| root.clone()));
            let coefficient = |index| if index < before { 0.0 } else { 1.0 };
            (0..inputs.len()).map(coefficient).collect()
        });
        LinearOutput {
            name: saved.name.clone(),
            unit: saved.unit.clone(),
            standard_uncertainty: saved.distribution.standard_uncertainty(),
            dof: saved.distribution.dof(),
            coverage_factor: saved.coverage_factor,
            probability: file.coverage_probability,
            by_trials: saved.by_trials,
            sensitivities,
        }
    };
    let outputs = file.outputs.iter().map(output).collect();
    let index = |name: &RootName| file.inputs.iter().position(|root| root.name == *name);
    let correlations = file.input_correlations.iter();
    let correlations =
        correlations.filter_map(|c| Some((index(&c.first)?, index(&c.second)?, c.coefficient)));
    let correlations = correlations.collect();
    LinearResult { outputs, inputs, model: file.model.to_string(), correlations }
}
