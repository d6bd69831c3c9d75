//! The beginning of a text page: the result of each output on one line, what is decided, and what is
//! doubtful.

use super::results::result;
use crate::table::comparison;
use crate::{EvaluationReport, plain};
use gumption_engine::model::Output;
use gumption_engine::propagate::{OutputEvaluation, RowEvaluation};
use gumption_engine::task::{Settings, Task};

/// The outputs of a row as lines: `a_x = (4.967 ± 0.018) m/s^2, k = 1.96, coverage probability 95 %`.
pub(super) fn results(report: &EvaluationReport<'_>, row: &RowEvaluation) -> Vec<String> {
    let settings = &report.evaluation.settings;
    of_outputs(report.task, row)
        .map(|(output, found)| result(settings, &output.quantity, found))
        .collect()
}

/// What is decided of outputs with a tolerance, and what is doubtful: one sentence for all outputs of
/// which it is said.
pub(super) fn remarks(report: &EvaluationReport<'_>, row: &RowEvaluation) -> Vec<String> {
    let settings = &report.evaluation.settings;
    let mut said: Vec<(String, Vec<&str>)> = Vec::new();
    for (output, found) in of_outputs(report.task, row) {
        for sentence in of_output(settings, output, found) {
            let name = output.quantity.name.as_str();
            match said.iter_mut().find(|(other, _)| *other == sentence) {
                Some((_, names)) => names.push(name),
                None => said.push((sentence, vec![name])),
            }
        }
    }
    let line = |(sentence, names): (String, Vec<&str>)| {
        let names: Vec<String> = names.into_iter().map(plain).collect();
        format!("{}: {sentence}", names.join(", "))
    };
    said.into_iter().map(line).collect()
}

fn of_output(settings: &Settings, output: &Output, found: &OutputEvaluation) -> Vec<String> {
    let trials = found.monte_carlo.as_deref().map(|figures| figures.trials);
    let decided = found.conformity.as_deref().map(|conformity| {
        comparison::decided(&output.quantity, conformity, (trials, settings.coverage))
    });
    let capability = comparison::capability(output, found, settings.digits_on_pages());
    decided.into_iter().chain(comparison::doubt(found, settings)).chain(capability).collect()
}

fn of_outputs<'a>(
    task: &'a Task,
    row: &'a RowEvaluation,
) -> impl Iterator<Item = (&'a Output, &'a OutputEvaluation)> {
    task.model.outputs.iter().zip(&row.outputs)
}
