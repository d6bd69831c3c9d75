//! Everything about one output.

use super::{Shown, figures};
use crate::EvaluationReport;
use crate::document::{Block, Document, sentence};
use crate::number::{justified, place_of_ends, position, with_uncertainty};
use crate::sheet::Sheet;
use crate::table;
use crate::table::budget;
use crate::table::budget::Budget;
use crate::table::{comparison, has_name, in_unit};
use gumption_engine::model::{Output, Quantity};
use gumption_engine::propagate::OutputEvaluation;
use gumption_engine::task::{Coverage, Settings};

/// What stands below the result of an output on a page with many.
const BELOW: &str = "Budget, both methods and distribution";

/// The section of an output of the first row; `folded` below its result.
pub(super) fn section(
    document: &mut Document,
    report: &EvaluationReport<'_>,
    shown: &Shown<'_>,
    (output, folded): (usize, bool),
) {
    let EvaluationReport { task, evaluation, .. } = *report;
    let Some(found) = evaluation.rows.first().and_then(|row| row.outputs.get(output)) else {
        return;
    };
    let Some(output_of) = task.model.outputs.get(output) else { return };
    let quantity = &output_of.quantity;
    document.section(table::title_text(quantity));
    let mut said = verdict(&evaluation.settings, output_of, found);
    said.extend(comparison::differences(report, output_of, found));
    document.blocks.push(Block::Verdict(said));
    let mut below = Document::default();
    details(&mut below, report, shown, (output, found));
    match folded {
        true => document.blocks.push(Block::Folded(BELOW.to_owned(), below.blocks)),
        false => document.blocks.append(&mut below.blocks),
    }
}

/// How an output comes about: its budget, its figures by both methods, its distribution.
fn details(
    document: &mut Document,
    report: &EvaluationReport<'_>,
    shown: &Shown<'_>,
    (output, found): (usize, &OutputEvaluation),
) {
    let EvaluationReport { task, evaluation, .. } = *report;
    let Some(output_of) = task.model.outputs.get(output) else { return };
    let (quantity, digits) = (&output_of.quantity, evaluation.settings.digits);
    match &found.gum {
        Some(gum) => {
            let budget = Budget { task, output: quantity, gum, digits };
            document.table(budget.sheet(shown.columns));
            document.sentence(&budget::legend(quantity, shown.columns));
            if let Some(said) = budget::subtotals(task, gum) {
                document.sentence(&said);
            }
            document.figure(figures::shares(task, gum));
            document.table(conclusions(&evaluation.settings, quantity, found, digits));
        }
        None => document.text(table::NO_BUDGET),
    }
    if let Some(sheet) = comparison::sheet(found, digits) {
        document.table(sheet);
    }
    if let Some(said) = comparison::without_noise(quantity, found) {
        document.sentence(&said);
    }
    if let Some(figures) = &found.monte_carlo {
        if !figures.shortest_exact {
            document.sentence(comparison::NEARLY_SHORTEST);
        }
        if !figures.shortest_unique {
            document.sentence(comparison::NOT_UNIQUE);
        }
        if let Some(end) = &figures.adaptive {
            document.sentence(&comparison::stability(quantity, end, figures.trials));
        }
    }
    let histogram = shown.histogram(0, output);
    document.figure(histogram.and_then(|counts| {
        figures::distribution(quantity, found, counts, evaluation.coverage_probability)
    }));
}

/// The result, what clause 8 says of it, and whether it conforms.
fn verdict(settings: &Settings, stated: &Output, found: &OutputEvaluation) -> Vec<String> {
    let output = &stated.quantity;
    let mut said = vec![result(settings, output, found)];
    match &found.monte_carlo {
        Some(figures) => said.push(comparison::verdict(output, found, figures)),
        None => {
            let gum = found.gum.as_ref();
            let interval =
                gum.and_then(|gum| comparison::interval_text(output, gum, settings.digits));
            said.extend(interval.map(|said| sentence(&said)));
        }
    }
    said.extend(found.conformity.iter().flat_map(|c| comparison::conformity(output, c)));
    said.extend(comparison::capability(stated, found));
    said
}

/// The measurement result as JCGM 100, 7.2.4 states it; the Monte Carlo interval where the GUM's
/// is not valid or does not exist.
fn result(settings: &Settings, output: &Quantity, found: &OutputEvaluation) -> String {
    let refuted = found.validation.is_some_and(|v| v.gum_valid == Some(false));
    let name = crate::plain(&output.name);
    let coverage = table::coverage_text(settings.coverage);
    let gum = found.gum.as_ref();
    let expanded = gum.and_then(|gum| Some((gum, gum.expanded_uncertainty()?)));
    if let Some((gum, expanded)) = expanded.filter(|_| !refuted || found.monte_carlo.is_none()) {
        let factor = gum.coverage_factor.map_or(f64::NAN, |factor| factor);
        let factor = crate::number::rounded(factor, -2);
        let (estimate, expanded) = with_uncertainty(gum.estimate, expanded, settings.digits);
        let value = match has_name(&output.unit) {
            true => in_unit(&format!("({estimate} ± {expanded})"), &output.unit),
            false => format!("{estimate} ± {expanded}"),
        };
        return format!("{name} = {value}; k = {factor}, coverage probability {coverage}");
    }
    if let Some(figures) = &found.monte_carlo {
        let u = figures.standard_uncertainty.or_else(|| gum.map(|gum| gum.standard_uncertainty));
        let ends = place_of_ends(figures, u, settings.digits);
        let stated = figures.stated_interval();
        let [low, high] = [0, 1].map(|end| justified(stated.ends[end], ends, stated.errors[end]));
        let estimate = match figures.estimate {
            Some(estimate) => {
                let digits = u.and_then(|u| position(u, settings.digits));
                justified(estimate, digits, figures.errors.estimate.unwrap_or(f64::NAN))
            }
            None => justified(figures.median, ends, figures.errors.median),
        };
        let kind = if stated.shortest { "shortest" } else { "probabilistically symmetric" };
        let high = in_unit(&high, &output.unit);
        let estimate = in_unit(&estimate, &output.unit);
        return format!(
            "{name} = {estimate}; coverage interval from {low} to {high} (Monte Carlo, {kind}), \
             coverage probability {coverage}"
        );
    }
    match gum {
        Some(gum) => {
            let (estimate, u) =
                with_uncertainty(gum.estimate, gum.standard_uncertainty, settings.digits);
            let u = in_unit(&u, &output.unit);
            format!("{name} = {} with standard uncertainty {u}", in_unit(&estimate, &output.unit))
        }
        None => format!("{name} is not defined at these estimates"),
    }
}

/// Combined standard uncertainty, degrees of freedom, coverage factor, expanded uncertainty.
fn conclusions(
    settings: &Settings,
    output: &Quantity,
    found: &OutputEvaluation,
    digits: u32,
) -> Sheet {
    let mut sheet = Sheet::default();
    let Some(gum) = &found.gum else { return sheet };
    let lines = budget::conclusions(settings, output, gum, digits);
    sheet.text("result", lines.iter().map(|line| line.name.to_owned()));
    sheet.figures("value", lines.iter().map(|line| line.figure.clone()));
    let unit = |line: &budget::Conclusion<'_>| {
        line.unit.filter(|unit| has_name(unit)).map_or_else(String::new, |unit| unit.text().into())
    };
    sheet.units("unit", lines.iter().map(unit));
    let remark = |line: &budget::Conclusion<'_>| match (line.name, settings.coverage) {
        ("coverage factor", Coverage::Factor { fixed: true, .. }) => {
            line.remark.clone() + ", fixed"
        }
        _ => line.remark.clone(),
    };
    sheet.text("", lines.iter().map(remark));
    sheet
}
