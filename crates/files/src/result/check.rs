//! Whether what stands in a result file can be, and can stand together. A file with its digest intact
//! is as it was written; one without, or one that was changed, is looked at more closely.

use super::form::{
    DofStatus, InputForm, MOST_QUANTILES, MOST_RANKS, MOST_TRIALS, OutputForm, ResultForm,
};
use gumption_text::DiagnosticKind;

/// Rounding of figures that were computed from each other.
const ROUNDING: f64 = 1e-9;

/// The same of sums of many terms.
const ROUNDING_OF_SUMS: f64 = 1e-6;

/// How many times the spread of the trials and u together an estimate may lie from their median.
/// The estimate of the largest of a thousand quantities lies 9 off.
const FARTHEST: f64 = 20.0;

/// What is wrong, and the keys that lead to it with `/` between them.
pub(super) type Mistakes = Vec<(String, DiagnosticKind)>;

fn entry(reason: impl Into<String>) -> DiagnosticKind {
    DiagnosticKind::SavedEntry { reason: reason.into() }
}

/// Numbers, lengths and places beyond what they may be.
pub(super) fn ranges(form: &ResultForm) -> Mistakes {
    let mut found = Vec::new();
    let p = form.coverage_probability;
    if let Some(p) = p.filter(|p| *p <= 0.0 || *p >= 1.0) {
        let key = "coverage_probability".to_owned();
        found.push((key.clone(), DiagnosticKind::NotProbability { key, found: p, below: 1.0 }));
    }
    positive(&mut found, "scores", &[("step", Some(form.scores.step))]);
    if !(2..=MOST_QUANTILES).contains(&form.scores.count) {
        let reason = format!("from 2 to {MOST_QUANTILES} scores are needed here");
        found.push(("scores/count".to_owned(), entry(reason)));
    }
    if form.provenance.trials.is_some_and(|trials| trials > MOST_TRIALS) {
        let reason = format!("at most {MOST_TRIALS} trials stand behind a result");
        found.push(("provenance/trials".to_owned(), entry(reason)));
    }
    let is_coefficient = |r: f64| (-1.0..=1.0).contains(&r);
    for (at, (_, _, r)) in form.output_correlations.iter().enumerate() {
        if !r.is_none_or(is_coefficient) {
            let reason = "two names of outputs and a coefficient from -1 to 1 are needed here";
            found.push((format!("output_correlations/{at}"), entry(reason)));
        }
    }
    let count = form.inputs.len();
    for (at, &(i, j, r)) in form.input_correlations.iter().enumerate() {
        if i == j || i.max(j) >= count || !is_coefficient(r) {
            let reason = "two places in `inputs`, counted from 0, and a coefficient from -1 to 1 are \
                          needed here";
            found.push((format!("input_correlations/{at}"), entry(reason)));
        }
    }
    for (at, input) in form.inputs.iter().enumerate() {
        let InputForm { standard_uncertainty, standard_deviation, dof, .. } = *input;
        let figures = [
            ("standard_uncertainty", Some(standard_uncertainty)),
            ("standard_deviation", standard_deviation),
            ("dof", dof),
        ];
        positive(&mut found, &format!("inputs/{at}"), &figures);
    }
    let ranks = form.outputs.iter().find_map(|(_, output)| Some(output.ranks.as_ref()?.len()));
    for (name, output) in &form.outputs {
        let place = format!("outputs/{name}");
        let spread = output.standard_deviation.filter(|_| output.standard_uncertainty != 0.0);
        let figures = [
            ("dof", output.dof),
            ("drawn_dof", output.drawn_dof),
            ("coverage_factor", output.coverage_factor),
            ("effective_trials", output.effective_trials),
            ("standard_deviation", spread),
        ];
        positive(&mut found, &place, &figures);
        let mut report = |key: &str, reason: &str| {
            found.push((format!("{place}/{key}"), entry(reason)));
        };
        if output.sensitivities.as_ref().is_some_and(|c| c.len() != count) {
            report("sensitivities", "as many sensitivity coefficients as `inputs` are needed here");
        }
        let Some(own) = &output.ranks else { continue };
        if !are_ranks(own) {
            let reason = "ranks are each whole number from 1 to their count once, two to a million";
            report("ranks", reason);
        }
        if Some(own.len()) != ranks {
            report("ranks", "all outputs of a file have as many ranks, those of the same trials");
        }
    }
    found
}

/// Reports numbers that are not above zero.
fn positive(found: &mut Mistakes, place: &str, figures: &[(&str, Option<f64>)]) {
    for (key, value) in figures {
        if let Some(value) = value.filter(|value| *value <= 0.0) {
            let kind = DiagnosticKind::NotPositive { key: (*key).into(), found: value };
            found.push((format!("{place}/{key}"), kind));
        }
    }
}

/// Whether each whole number from 1 to their count stands there once.
fn are_ranks(ranks: &[u32]) -> bool {
    let mut seen = vec![false; ranks.len()];
    (2..=MOST_RANKS).contains(&ranks.len())
        && ranks.iter().all(|&rank| {
            let seen = (rank as usize).checked_sub(1).and_then(|place| seen.get_mut(place));
            seen.is_some_and(|seen| !std::mem::replace(seen, true))
        })
}

/// Figures of an output that cannot stand together.
pub(super) fn consistency(form: &ResultForm, name: &str, output: &OutputForm) -> Mistakes {
    let mut found = Vec::new();
    let mut report = |key: &str, reason: &str| {
        found.push((format!("outputs/{name}/{key}"), entry(reason)));
    };
    for (key, ends) in [
        ("interval", output.interval),
        ("symmetric_interval", output.symmetric_interval),
        ("shortest_interval", output.shortest_interval),
    ] {
        if ends.is_some_and(|[low, high]| low > high) {
            report(key, "the lower end of an interval cannot be above the upper one");
        }
    }
    if output.dof_status.is_some_and(|of| (of == DofStatus::Finite) != output.dof.is_some()) {
        report("dof", "`dof` is a number where `dof_status` is finite, and null elsewhere");
    }
    let (y, u) = (output.estimate, output.standard_uncertainty);
    if let (Some(k), Some(expanded)) = (output.coverage_factor, output.expanded_uncertainty)
        && (expanded - k * u).abs() > ROUNDING * (k * u).abs()
    {
        let reason = "the expanded uncertainty must be `coverage_factor` times \
                      `standard_uncertainty`";
        report("expanded_uncertainty", reason);
    }
    if let (Some(expanded), Some([low, high])) = (output.expanded_uncertainty, output.interval) {
        let rounding = ROUNDING * (y.abs() + expanded.abs());
        if (low - (y - expanded)).abs() > rounding || (high - (y + expanded)).abs() > rounding {
            let reason = "the interval must be the estimate minus and plus `expanded_uncertainty`";
            report("interval", reason);
        }
    }
    if let Some(variance) = linear_variance(form, output)
        && (variance - u * u).abs() > ROUNDING_OF_SUMS * (variance + u * u)
    {
        let reason = "the standard uncertainty must be what `sensitivities` and `inputs` give";
        report("standard_uncertainty", reason);
    }
    let at = |score: f64| {
        let place = ((score - form.scores.from) / form.scores.step).round();
        output.quantiles.get(place.max(0.0) as usize).copied()
    };
    // the quartiles of the standard normal distribution
    let (Some(low), Some(median), Some(high)) = (at(-0.674_49), at(0.0), at(0.674_49)) else {
        return found;
    };
    let spread = high - low;
    let deviation = if u == 0.0 { Some(0.0) } else { output.standard_deviation };
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
    if let Some([low, high]) = output.symmetric_interval
        && !(low..=high).contains(&median)
    {
        report("symmetric_interval", "the interval must hold the median of `quantiles`");
    }
    found
}

/// The variance by the law of propagation from sensitivities, inputs and their correlations.
fn linear_variance(form: &ResultForm, output: &OutputForm) -> Option<f64> {
    let inputs = output.sensitivities.as_ref()?.iter().zip(&form.inputs);
    let weights: Vec<f64> = inputs.map(|(c, input)| c * input.standard_uncertainty).collect();
    let pairs = form.input_correlations.iter();
    let pairs = pairs.filter_map(|&(i, j, r)| Some(2.0 * r * weights.get(i)? * weights.get(j)?));
    let own: f64 = weights.iter().map(|weight| weight * weight).sum();
    Some(own + pairs.sum::<f64>())
}
