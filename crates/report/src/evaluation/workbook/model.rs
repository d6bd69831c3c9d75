//! The worksheet of the model: each operation with its value, and what the outputs change by with
//! it, from which the sensitivity coefficients come.

use rust_xlsxwriter::XlsxError;

use super::inputs::Places;
use super::tape::{Tape, slope, value, words};
use crate::workbook::{Cached, Leaf, Look, here};
use crate::{EvaluationReport, plain};
use gumption_engine::model::Node;

const VALUE: u16 = 2;
const SLOPES: [u16; 2] = [3, 4];
const ADJOINTS: u16 = 5;

/// The cells of the model in a row of conditions.
#[derive(Clone, Debug)]
pub(super) struct ModelPlaces {
    /// For each output its value.
    pub outputs: Vec<String>,
    /// For each output and variable the sensitivity coefficient; `None` where the model does not use
    /// the variable.
    pub(super) sensitivities: Vec<Vec<Option<String>>>,
}

pub(super) fn write(
    leaf: &mut Leaf,
    report: &EvaluationReport<'_>,
    tapes: &[Tape],
    inputs: &Places,
) -> Result<Vec<ModelPlaces>, XlsxError> {
    let task = report.task;
    leaf.title(0, "Model")?;
    leaf.line(
        1,
        "Each step with its value and its partial derivatives by its operands; then, from the last \
         step back, what each output changes by with it. Those of the quantities are the \
         sensitivity coefficients. Steps count from one in each table.",
    )?;
    let mut headers: Vec<String> =
        ["step", "operation", "value", "by first operand", "by second operand"]
            .map(str::to_owned)
            .to_vec();
    let outputs = task.model.outputs.iter();
    headers.extend(outputs.map(|output| format!("{} by it", plain(&output.quantity.name))));
    let name = |variable: usize| {
        let conditions = variable.checked_sub(task.variables.len());
        let condition = conditions.and_then(|place| task.model.conditions.get(place));
        let known = task.variables.get(variable).map(|variable| variable.name.as_str());
        plain(known.or(condition.map(|c| c.name.as_str())).unwrap_or_default())
    };
    let mut places = Vec::new();
    let mut top = 3;
    for (tape, cells) in tapes.iter().zip(&inputs.rows) {
        leaf.headers(top, headers.iter().map(String::as_str))?;
        let row = |step: usize| top + 1 + step as u32;
        let cell = |step: usize| here(row(step), VALUE);
        for (place, step) in tape.steps.iter().enumerate() {
            let at = row(place);
            leaf.number((at, 0), (place + 1) as f64, None, Look::Plain)?;
            leaf.text(at, 1, &words(step.node, &name))?;
            let now = Cached::Number(step.value);
            let formula = match step.node {
                Node::Variable(v) => {
                    let estimate = cells.variables.get(v).map(|cells| cells[0].clone());
                    let condition = v.checked_sub(task.variables.len());
                    estimate.or_else(|| cells.conditions.get(condition?).cloned())
                }
                node => value(node, &cell),
            };
            match formula {
                Some(formula) => leaf.formula((at, VALUE), &formula, &now, None, Look::Plain)?,
                None => leaf.number((at, VALUE), step.value, None, Look::Plain)?,
            }
            for (which, known) in step.slopes.iter().enumerate() {
                let formula = slope(step.node, which, &cell, &cell(place));
                if let Some((known, formula)) = known.zip(formula) {
                    let now = Cached::Number(known);
                    leaf.formula((at, SLOPES[which]), &formula, &now, None, Look::Plain)?;
                }
            }
            if !step.varies {
                continue;
            }
            for (output, &known) in step.adjoints.iter().enumerate() {
                let column = ADJOINTS + output as u16;
                let own = tape.outputs.get(output) == Some(&place);
                // a step that the output does not depend on stays out of the formula
                let terms = step.users.iter().filter(|(user, _)| tape.reaches(*user, output));
                let terms: Vec<String> = own
                    .then(|| "1".to_owned())
                    .into_iter()
                    .chain(terms.map(|&(user, which)| {
                        format!("{}*{}", here(row(user), column), here(row(user), SLOPES[which]))
                    }))
                    .collect();
                if !terms.is_empty() {
                    let now = Cached::Number(known);
                    leaf.formula((at, column), &terms.join("+"), &now, None, Look::Plain)?;
                }
            }
        }
        let sensitivity = |output: usize, step: Option<usize>| {
            let step = step.filter(|&step| tape.reaches(step, output))?;
            Some(leaf.cell(row(step), ADJOINTS + output as u16))
        };
        places.push(ModelPlaces {
            outputs: tape.outputs.iter().map(|&step| leaf.cell(row(step), VALUE)).collect(),
            sensitivities: (0..tape.outputs.len())
                .map(|output| {
                    let steps = tape.variables.iter();
                    steps.map(|&step| sensitivity(output, step)).collect()
                })
                .collect(),
        });
        top = row(tape.steps.len()) + 1;
    }
    leaf.freeze(3)?;
    Ok(places)
}
