//! Everything about one output.

use super::{Shown, figures, terminal};
use crate::EvaluationReport;
use crate::document::{Block, Document, sentence};
use crate::number::{justified, place_of_ends, position, to, with_uncertainty};
use crate::sheet::Sheet;
use crate::table;
use crate::table::budget;
use crate::table::budget::Budget;
use crate::table::{comparison, in_unit, rows, unit_text};
use gumption_engine::model::{Output, Quantity};
use gumption_engine::propagate::gum::Gum;
use gumption_engine::propagate::monte_carlo::MonteCarlo;
use gumption_engine::propagate::{Basis, CapabilityStatement, OutputEvaluation, Stated};
use gumption_engine::task::{Coverage, Settings};

/// The parts of the section of an output, in the order in which a page has them.
#[derive(Debug, Default)]
pub(super) struct OutputSection {
    pub(super) title: String,
    /// The result, what clause 8 says of it, and whether it conforms.
    pub(super) verdict: Document,
    pub(super) budget: Document,
    /// The figures that follow from the budget.
    pub(super) conclusions: Document,
    /// Both methods side by side.
    pub(super) comparison: Document,
    pub(super) distribution: Document,
}

/// What stands below the result of an output on a page with many.
const BELOW: &str = "Budget, both methods and distribution";

/// The section of an output of the first row; `folded` below its result.
pub(super) fn section(
    document: &mut Document,
    report: &EvaluationReport<'_>,
    shown: &Shown<'_>,
    (output, folded): (usize, bool),
) {
    let Some(section) = section_of(report, shown, (0, output), document.terminal) else { return };
    document.section(section.title);
    document.blocks.extend(section.verdict.blocks);
    let below = [section.budget, section.conclusions, section.comparison, section.distribution];
    let below = below.into_iter().flat_map(|part| part.blocks);
    match folded {
        true => document.blocks.push(Block::Folded(BELOW.to_owned(), below.collect())),
        false => document.blocks.extend(below),
    }
}

/// The parts of the section of an output in a row, with its figures in characters or drawn; `None`
/// where there is no such output or row.
pub(super) fn section_of(
    report: &EvaluationReport<'_>,
    shown: &Shown<'_>,
    (row, output): (usize, usize),
    in_characters: bool,
) -> Option<OutputSection> {
    let EvaluationReport { task, evaluation, .. } = *report;
    let found = evaluation.rows.get(row)?.outputs.get(output)?;
    let output_of = task.model.outputs.get(output)?;
    let quantity = &output_of.quantity;
    let digits = evaluation.settings.digits_on_pages();
    let mut section =
        OutputSection { title: table::title_text(quantity), ..OutputSection::default() };
    section.budget.terminal = in_characters;
    section.distribution.terminal = in_characters;
    let mut said = verdict(&evaluation.settings, output_of, found);
    said.extend(comparison::differences(report, output_of, found, shown.language));
    section.verdict.blocks.push(Block::Verdict(said));
    match &found.gum {
        Some(gum) => {
            let budget = Budget { task, output: quantity, gum, digits };
            section.budget.table(budget.sheet(shown.columns, in_characters));
            section.budget.sentence(&budget::legend(quantity, shown.columns));
            if let Some(said) = rows::constants(task, gum) {
                section.budget.sentence(&said);
            }
            if let Some(said) = budget::subtotals(task, gum) {
                section.budget.sentence(&said);
            }
            section.budget.picture(|| figures::shares(task, gum), || None);
            section.conclusions.table(conclusions(&evaluation.settings, quantity, found, digits));
        }
        None => section.budget.text(table::NO_BUDGET),
    }
    let side_by_side = &mut section.comparison;
    if let Some(sheet) = comparison::sheet(found, digits) {
        side_by_side.table(sheet);
    }
    if let Some(said) = comparison::without_noise(quantity, found) {
        side_by_side.sentence(&said);
    }
    if let Some(figures) = &found.monte_carlo {
        if !figures.shortest_exact {
            side_by_side.sentence(comparison::NEARLY_SHORTEST);
        }
        if !figures.shortest_unique {
            side_by_side.sentence(comparison::NOT_UNIQUE);
        }
        if let Some(end) = &figures.adaptive {
            side_by_side.sentence(&comparison::stability(quantity, end, figures.trials));
        }
    }
    let histogram = shown.histogram(row, output);
    let probability = evaluation.coverage_probability;
    section.distribution.picture(
        || figures::distribution(quantity, found, histogram?, probability),
        || Some(terminal::histogram(quantity, found, histogram?)),
    );
    let stages = shown.convergence.get(output).map_or(&[][..], Vec::as_slice);
    section.distribution.picture(|| figures::convergence(quantity, stages), || None);
    Some(section)
}

/// The result, what clause 8 says of it, and whether it conforms.
fn verdict(settings: &Settings, stated: &Output, found: &OutputEvaluation) -> Vec<String> {
    let output = &stated.quantity;
    let mut said = vec![result(settings, output, found)];
    match &found.monte_carlo {
        Some(figures) => said.extend(comparison::verdict(output, found, figures, settings)),
        None => {
            let gum = found.gum.as_ref();
            let interval = gum
                .and_then(|gum| comparison::interval_text(output, gum, settings.digits_on_pages()));
            said.extend(interval.map(|said| sentence(&said)));
        }
    }
    let trials = found.monte_carlo.as_deref().map(|figures| figures.trials);
    let beside = (trials, settings.coverage);
    said.extend(found.conformity.iter().flat_map(|c| comparison::conformity(output, c, beside)));
    said.extend(comparison::capability(stated, found, settings.digits_on_pages()));
    said
}

/// The measurement result on one line.
pub(super) fn result(settings: &Settings, output: &Quantity, found: &OutputEvaluation) -> String {
    let name = crate::plain(&output.name);
    let coverage = table::coverage_text(settings.coverage);
    match ResultStatement::of(settings, found) {
        ResultStatement::Expanded { estimate, expanded, factor } => {
            let unit = &output.unit;
            let value = match unit.has_reference() {
                // an uncertainty of a level is a ratio, without the reference
                true => {
                    let expanded = in_unit(&expanded, &unit.of_differences());
                    format!("{} ± {expanded}", in_unit(&estimate, unit))
                }
                false => in_unit(&format!("({estimate} ± {expanded})"), unit),
            };
            let probability = format!("coverage probability {coverage}");
            let about = match raised(found) {
                Some(_) => "raised to the laboratory's capability (CMC)",
                None if is_agreed(settings, found) => "an agreed factor",
                None => &probability,
            };
            format!("{name} = {value}, k = {factor}, {about}")
        }
        ResultStatement::Interval { estimate, low, high, shortest } => {
            let kind = if shortest { "shortest" } else { "symmetric" };
            let estimate = in_unit(&estimate, &output.unit);
            format!(
                "{name} = {estimate}, from {low} to {high}, coverage probability {coverage} \
                 (Monte Carlo, {kind})"
            )
        }
        ResultStatement::Standard { estimate, uncertainty } => {
            let u = in_unit(&uncertainty, &output.unit.of_differences());
            format!("{name} = {} with standard uncertainty {u}", in_unit(&estimate, &output.unit))
        }
        ResultStatement::Undefined => format!("{name} is not defined at these estimates"),
    }
}

/// An estimate and its expanded uncertainty, which rounding does not bring below the capability.
fn with_capability(of: &CapabilityStatement, digits: u32) -> (String, String) {
    match of.rounded(digits) {
        Some(expanded) => (to(of.estimate, Some(expanded.position())), expanded.to_string()),
        None => with_uncertainty(of.estimate, of.expanded_uncertainty, digits),
    }
}

/// The laboratory's capability, where the expanded uncertainty is raised to it.
fn raised(found: &OutputEvaluation) -> Option<&CapabilityStatement> {
    found.capability.as_deref().filter(|stated| stated.raised)
}

/// Whether the factor is an agreed one, which belongs to no coverage probability.
fn is_agreed(settings: &Settings, found: &OutputEvaluation) -> bool {
    let stated = Stated::of(found, settings);
    let fixed = matches!(settings.coverage, Coverage::Factor { fixed: true, .. });
    fixed && stated.is_some_and(|stated| stated.basis == Basis::Fixed)
}

/// The measurement result as JCGM 100, 7.2.4 states it; the Monte Carlo interval where the GUM's
/// is not validated or does not exist. All figures are rounded, in the output's unit.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ResultStatement {
    /// An estimate with its expanded uncertainty.
    Expanded {
        /// The estimate.
        estimate: String,
        /// The expanded uncertainty.
        expanded: String,
        /// The coverage factor.
        factor: String,
    },
    /// An estimate with a coverage interval by the Monte Carlo method.
    Interval {
        /// The estimate.
        estimate: String,
        /// The lower end.
        low: String,
        /// The upper end.
        high: String,
        /// Whether it is the shortest interval, or else the probabilistically symmetric one.
        shortest: bool,
    },
    /// An estimate with its standard uncertainty alone.
    Standard {
        /// The estimate.
        estimate: String,
        /// The standard uncertainty.
        uncertainty: String,
    },
    /// There is none at these estimates.
    Undefined,
}

/// What is taken of an output as its result (JCGM 100, 7.2.4): the Monte Carlo interval where the GUM's
/// is not validated or does not exist.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Taken<'a> {
    /// An estimate with its expanded uncertainty and coverage factor, and the laboratory's capability
    /// where it is beside them.
    Expanded { estimate: f64, expanded: f64, factor: f64, beside: Option<&'a CapabilityStatement> },
    /// The interval that is stated of the trials, and the value beside it with its numerical standard
    /// error.
    Interval { figures: &'a MonteCarlo, located: (f64, f64) },
    /// No interval, only a standard uncertainty.
    Standard(&'a Gum),
    /// Nothing.
    Undefined,
}

impl<'a> Taken<'a> {
    pub(crate) fn of(settings: &Settings, found: &'a OutputEvaluation) -> Self {
        if let Some(raised) = raised(found) {
            return Self::Expanded {
                estimate: raised.estimate,
                expanded: raised.expanded_uncertainty,
                factor: settings.coverage.normal_factor(),
                beside: Some(raised),
            };
        }
        let Some(stated) = Stated::of(found, settings) else {
            return found.gum.as_ref().map_or(Self::Undefined, Self::Standard);
        };
        match found.monte_carlo.as_deref().filter(|_| stated.basis == Basis::Shortest) {
            Some(figures) => {
                let located = found.located().unwrap_or((figures.median, f64::NAN));
                Self::Interval { figures, located }
            }
            None => {
                let expanded = stated.expanded_uncertainty;
                let beside = found.capability.as_deref();
                let beside = beside.filter(|beside| beside.expanded_uncertainty == expanded);
                let (estimate, factor) = (stated.value, stated.coverage_factor);
                Self::Expanded { estimate, expanded, factor, beside }
            }
        }
    }

    /// The estimate and the ends of the interval, in the output's unit; `None` where there is none.
    pub(crate) fn interval(&self) -> Option<(f64, [f64; 2])> {
        match *self {
            Self::Expanded { estimate, expanded, .. } => {
                Some((estimate, [estimate - expanded, estimate + expanded]))
            }
            Self::Interval { figures, located: (estimate, _) } => {
                Some((estimate, figures.stated_interval().ends))
            }
            Self::Standard(_) | Self::Undefined => None,
        }
    }
}

impl ResultStatement {
    /// What is stated of an output.
    pub fn of(settings: &Settings, found: &OutputEvaluation) -> Self {
        let gum = found.gum.as_ref();
        match Taken::of(settings, found) {
            Taken::Expanded { estimate, expanded, factor, beside } => {
                let factor = crate::number::rounded(factor, -2);
                let (estimate, expanded) = match beside {
                    Some(beside) => with_capability(beside, settings.digits_on_pages()),
                    None => with_uncertainty(estimate, expanded, settings.digits_on_pages()),
                };
                Self::Expanded { estimate, expanded, factor }
            }
            Taken::Interval { figures, located: (located, error) } => {
                let u = figures.standard_uncertainty;
                let u = u.or_else(|| gum.map(|gum| gum.standard_uncertainty));
                let ends = place_of_ends(figures, u, settings.digits_on_pages());
                let stated = figures.stated_interval();
                let [low, high] =
                    [0, 1].map(|end| justified(stated.ends[end], ends, stated.errors[end]));
                // without a standard deviation the interval tells how many digits there are
                let place = figures
                    .standard_uncertainty
                    .and_then(|u| position(u, settings.digits_on_pages()));
                let estimate = justified(located, place.or(ends), error);
                Self::Interval { estimate, low, high, shortest: stated.shortest }
            }
            Taken::Standard(gum) => {
                let (estimate, uncertainty) = with_uncertainty(
                    gum.estimate,
                    gum.standard_uncertainty,
                    settings.digits_on_pages(),
                );
                Self::Standard { estimate, uncertainty }
            }
            Taken::Undefined => Self::Undefined,
        }
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
    let unit = |line: &budget::Conclusion| {
        line.unit.as_ref().filter(|unit| unit.has_name()).map_or_else(String::new, unit_text)
    };
    sheet.units("unit", lines.iter().map(unit));
    let remark = |line: &budget::Conclusion| match (line.name, settings.coverage) {
        ("coverage factor", Coverage::Factor { fixed: true, .. }) => {
            line.remark.clone() + ", fixed"
        }
        _ => line.remark.clone(),
    };
    sheet.text("", lines.iter().map(remark));
    sheet
}
