//! Whether what stands in a saved result can stand together. A file with its digest intact is as it
//! was written; one without, or one that was changed, is looked at more closely.

use gumption_engine::distribution::{Root, RootCorrelation, RootName, Scores};
use gumption_text::DiagnosticKind;
use gumption_text::json::Json;
use gumption_text::object::Object;

/// Rounding of figures that were computed from each other.
const ROUNDING: f64 = 1e-9;

/// The same of sums of many terms.
const ROUNDING_OF_SUMS: f64 = 1e-6;

/// How many times the spread of the trials and u together an estimate may lie from their median.
/// The estimate of the largest of a thousand quantities lies 9 off.
const FARTHEST: f64 = 20.0;

/// An output as the file has it.
pub(super) struct StatedOutput<'a> {
    pub(super) estimate: f64,
    pub(super) standard_uncertainty: f64,
    pub(super) standard_deviation: f64,
    pub(super) quantiles: &'a [f64],
    pub(super) scores: Scores,
    pub(super) sensitivities: Option<&'a [f64]>,
    pub(super) roots: &'a [Root],
    pub(super) correlations: &'a [RootCorrelation],
}

/// Reports what cannot be.
pub(super) fn check(object: &Object<'_>, of: &StatedOutput<'_>) {
    let report = |key: &str, reason: &'static str| {
        let place = object.get(key).map_or(object.place(), |member| &member.value.span);
        object.log.report(place, DiagnosticKind::SavedEntry { reason });
    };
    // null, and what is not there, is no number
    let number = |key: &str| object.get(key).and_then(|member| member.value.number());
    let ends = |key: &str| match &object.get(key)?.value.value {
        Json::List(ends) => match ends.as_slice() {
            [low, high] => Some([low.number()?, high.number()?]),
            _ => None,
        },
        _ => None,
    };
    for key in ["interval", "symmetric_interval", "shortest_interval"] {
        if ends(key).is_some_and(|[low, high]| low > high) {
            report(key, "the lower end of an interval cannot be above the upper one");
        }
    }
    if let Some(status) = object.text("dof_status")
        && (status == "finite") != number("dof").is_some()
    {
        report("dof", "`dof` is a number where `dof_status` is finite, and null elsewhere");
    }
    let (y, u) = (of.estimate, of.standard_uncertainty);
    if let (Some(k), Some(expanded)) = (number("coverage_factor"), number("expanded_uncertainty"))
        && (expanded - k * u).abs() > ROUNDING * (k * u).abs()
    {
        let reason = "the expanded uncertainty must be `coverage_factor` times \
                      `standard_uncertainty`";
        report("expanded_uncertainty", reason);
    }
    if let (Some(expanded), Some([low, high])) = (number("expanded_uncertainty"), ends("interval"))
    {
        let rounding = ROUNDING * (y.abs() + expanded.abs());
        if (low - (y - expanded)).abs() > rounding || (high - (y + expanded)).abs() > rounding {
            let reason = "the interval must be the estimate minus and plus `expanded_uncertainty`";
            report("interval", reason);
        }
    }
    if let Some(variance) = linear_variance(of)
        && (variance - u * u).abs() > ROUNDING_OF_SUMS * (variance + u * u)
    {
        let reason = "the standard uncertainty must be what `sensitivities` and `inputs` give";
        report("standard_uncertainty", reason);
    }
    let at = |score: f64| {
        let place = ((score - of.scores.from) / of.scores.step).round();
        of.quantiles.get(place.max(0.0) as usize).copied()
    };
    // the quartiles of the standard normal distribution
    let (Some(low), Some(median), Some(high)) = (at(-0.674_49), at(0.0), at(0.674_49)) else {
        return;
    };
    let spread = high - low;
    let deviation = Some(of.standard_deviation).filter(|found| found.is_finite());
    let scatter = deviation.unwrap_or(spread);
    if (y - median).abs() > FARTHEST * (u + scatter) + ROUNDING * (y.abs() + median.abs()) {
        report("estimate", "the estimate is far from all of `quantiles`");
    }
    // a quarter of the values lies beyond each quartile, so that the variance is at least an eighth
    // of the square of their distance; quartiles are the nearest of the table
    if deviation.is_some_and(|found| 4.0 * found < spread) {
        report(
            "standard_deviation",
            "a standard deviation this small belongs to other `quantiles`",
        );
    }
    if let Some([low, high]) = ends("symmetric_interval")
        && !(low..=high).contains(&median)
    {
        report("symmetric_interval", "the interval must hold the median of `quantiles`");
    }
}

/// The variance by the law of propagation from sensitivities, inputs and their correlations.
fn linear_variance(of: &StatedOutput<'_>) -> Option<f64> {
    let weights: Vec<f64> = of
        .sensitivities?
        .iter()
        .zip(of.roots)
        .map(|(c, root)| c * root.standard_uncertainty)
        .collect();
    let place = |name: &RootName| of.roots.iter().position(|root| root.name == *name);
    let pairs = of.correlations.iter().filter_map(|pair| {
        let (first, second) = (place(&pair.first)?, place(&pair.second)?);
        Some(2.0 * pair.coefficient * weights.get(first)? * weights.get(second)?)
    });
    let own: f64 = weights.iter().map(|weight| weight * weight).sum();
    Some(own + pairs.sum::<f64>())
}
