//! The lines of a budget: in the order of the file, and in the order of a page, with the largest
//! contribution first and constants apart.

use super::{in_unit, text};
use crate::number::exact;
use gumption_engine::model::Quantity;
use gumption_engine::number::largest_first;
use gumption_engine::propagate::InputFigures;
use gumption_engine::propagate::gum::{BudgetLine, Gum};
use gumption_engine::task::{Task, Variable};

/// Constants that are listed below a budget, at most.
const MOST_CONSTANTS: usize = 20;

/// A line of the budget that belongs to an input.
pub(crate) enum InputRow<'a> {
    /// A quantity that is made of components, above their lines. What it contributes stands there.
    Composed(&'a Quantity, InputFigures),
    /// A variable: an input, or a component of one.
    Variable(&'a Variable, BudgetLine),
}

/// The lines of all inputs, in the order of the file.
pub(crate) fn input_rows<'a>(task: &'a Task, gum: &Gum) -> Vec<InputRow<'a>> {
    let mut composed =
        task.model.inputs.iter().zip(InputFigures::of_gum(task, gum)).filter(|(_, f)| f.composed);
    let mut next = composed.next();
    let mut rows = Vec::new();
    for line in gum.budget() {
        let Some(variable) = task.variables.get(line.variable) else { continue };
        while let Some((input, figures)) = next.take() {
            if figures.variables.start > line.variable {
                next = Some((input, figures));
                break;
            }
            rows.push(InputRow::Composed(&input.quantity, figures));
            next = composed.next();
        }
        rows.push(InputRow::Variable(variable, line));
    }
    rows
}

/// The lines of the inputs without constants, in descending order of their contributions; the
/// components of a quantity follow its line.
pub(super) fn page_rows<'a>(task: &'a Task, gum: &Gum) -> Vec<InputRow<'a>> {
    // each group with the sum of its squared contributions
    let mut groups: Vec<(Vec<(InputRow<'a>, f64)>, f64)> = Vec::new();
    let mut components = 0..0;
    for row in input_rows(task, gum) {
        let (contribution, begins) = match &row {
            InputRow::Composed(_, figures) => {
                components = figures.variables.clone();
                (f64::INFINITY, true)
            }
            InputRow::Variable(..) if is_constant(&row) => continue,
            InputRow::Variable(_, line) => {
                (line.contribution, !components.contains(&line.variable))
            }
        };
        let square = if contribution.is_finite() { contribution * contribution } else { 0.0 };
        match groups.last_mut() {
            Some((rows, sum)) if !begins => {
                rows.push((row, contribution));
                *sum += square;
            }
            _ => groups.push((vec![(row, contribution)], square)),
        }
    }
    groups.retain(|(rows, _)| !matches!(rows.as_slice(), [(InputRow::Composed(..), _)]));
    largest_first(&mut groups, |(_, sum)| *sum);
    let in_order = |(mut rows, _): (Vec<(InputRow<'a>, f64)>, f64)| {
        largest_first(&mut rows, |(_, contribution)| *contribution);
        rows.into_iter().map(|(row, _)| row)
    };
    groups.into_iter().flat_map(in_order).collect()
}

fn is_constant(row: &InputRow<'_>) -> bool {
    matches!(row, InputRow::Variable(_, line) if line.distribution == "constant")
}

/// The constants, which contribute nothing, as a sentence without its full stop; `None` if there are
/// none.
pub(crate) fn constants(task: &Task, gum: &Gum) -> Option<String> {
    let rows = input_rows(task, gum);
    let all: Vec<String> = rows
        .iter()
        .filter(|row| is_constant(row))
        .filter_map(|row| match row {
            InputRow::Variable(variable, line) => {
                let value = in_unit(&exact(line.estimate), &variable.unit);
                Some(format!("{} = {value}", text::plain(&variable.name)))
            }
            InputRow::Composed(..) => None,
        })
        .collect();
    let more = all.len().saturating_sub(MOST_CONSTANTS);
    let mut listed = all.into_iter().take(MOST_CONSTANTS).collect::<Vec<_>>().join(", ");
    if more > 0 {
        listed += &format!(" and {more} more");
    }
    (!listed.is_empty()).then(|| format!("constants: {listed}"))
}
