//! The budgets of several outputs in one table: what is known about each input, and its share of the
//! variance of each output.

use super::rows::{InputRow, page_rows};
use super::{text, unit_text};
use crate::number::{MISSING, rounded, with_uncertainty};
use crate::sheet::Sheet;
use gumption_engine::number::largest_first;
use gumption_engine::propagate::RowEvaluation;
use gumption_engine::propagate::gum::{BudgetLine, Gum};
use gumption_engine::task::Task;

/// Outputs with a column of their own, at most.
pub(crate) const MOST_OUTPUTS: usize = 8;

/// What is above the table.
pub(crate) const ABOUT: &str = "Shares of the variance of each output in %:";

/// The inputs of a row of conditions with their shares of each output's variance, in descending order
/// of the largest share; `None` if there are too many outputs for columns, or no budgets.
pub(crate) fn sheet(task: &Task, row: &RowEvaluation, digits: u32) -> Option<Sheet> {
    if row.outputs.len() > MOST_OUTPUTS {
        return None;
    }
    let gums: Vec<Option<&Gum>> = row.outputs.iter().map(|output| output.gum.as_ref()).collect();
    let first = gums.iter().copied().flatten().next()?;
    let lines: Vec<Vec<BudgetLine>> =
        gums.iter().map(|gum| gum.map_or_else(Vec::new, |gum| gum.budget().collect())).collect();
    let share = |output: usize, variable: usize| {
        // the lines of a budget are in the order of the variables
        let lines = lines.get(output)?;
        let place = lines.binary_search_by_key(&variable, |line| line.variable).ok()?;
        lines.get(place).map(|line| line.share)
    };
    let largest = |variable: usize| {
        let shares = (0..lines.len()).filter_map(|output| share(output, variable));
        shares.filter(|share| share.is_finite()).fold(0.0, f64::max)
    };
    let mut inputs: Vec<_> = page_rows(task, first)
        .into_iter()
        .filter_map(|row| match row {
            InputRow::Variable(variable, line) => {
                let most = largest(line.variable);
                Some((variable, line, most))
            }
            InputRow::Composed(..) => None,
        })
        .collect();
    largest_first(&mut inputs, |(.., most)| *most);
    let mut sheet = Sheet::default();
    let known: Vec<(String, String)> = inputs
        .iter()
        .map(|(_, line, _)| with_uncertainty(line.estimate, line.standard_uncertainty, digits))
        .collect();
    sheet.text("quantity", inputs.iter().map(|(variable, ..)| text::plain(&variable.name)));
    sheet.numbers("estimate", known.iter().map(|(estimate, _)| estimate.clone()));
    sheet.numbers("standard\nuncertainty", known.iter().map(|(_, u)| u.clone()));
    sheet.narrow("standard\nuncer-\ntainty");
    sheet.units("unit", inputs.iter().map(|(variable, ..)| unit_text(&variable.unit)));
    sheet.text("distribution", inputs.iter().map(|(_, line, _)| line.distribution.to_owned()));
    sheet.narrow("distri-\nbution");
    for (place, output) in task.model.outputs.iter().enumerate() {
        let cell = |(_, line, _): &(_, BudgetLine, f64)| {
            let share = share(place, line.variable);
            share.map_or_else(|| MISSING.to_owned(), |share| rounded(100.0 * share, -1))
        };
        sheet.numbers(&text::plain(&output.quantity.name), inputs.iter().map(cell));
    }
    let correlated = gums.iter().map(|gum| gum.is_some_and(Gum::is_correlated));
    if correlated.clone().any(|is_correlated| is_correlated) {
        sheet.append(correlation_cells(&gums));
    }
    Some(sheet)
}

/// The cells of the line with the shares of all correlation coefficients.
fn correlation_cells(gums: &[Option<&Gum>]) -> Vec<String> {
    let mut cells = vec!["correlations".to_owned()];
    cells.extend(std::iter::repeat_n(String::new(), 4));
    cells.extend(gums.iter().map(|gum| {
        let share = gum.map(|gum| gum.correlations().map(|line| line.share).sum::<f64>());
        share.map_or_else(|| MISSING.to_owned(), |share| rounded(100.0 * share, -1))
    }));
    cells
}
