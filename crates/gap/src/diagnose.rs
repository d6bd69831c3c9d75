//! The whole diagnosis, step by step.

use super::diagnosis::{
    Diagnosis, Gap, Hypothesis, Kind, Named, Noise, Note, Parameter, Predicted, Verdict,
};
use super::discrepancy::{Discrepancy, by_rows};
use super::latent::Role;
use super::posterior::{self, Effort, Posterior};
use super::predict;
use super::setup::Setup;
use super::shrink::{self, Correction};
use super::{next, scan};
use crate::Case;
use gumption_engine::number::COLUMN;
use gumption_engine::special;
use gumption_engine::task::{Coverage, Row};

/// Two hypotheses look alike if their best predictions differ by less than this, in standard
/// uncertainties of the data and over all of them: the expected logarithm of the odds is half its
/// square.
const ALIKE: f64 = 2.0;

/// A look-alike with less than this share of the verdict's probability is not worth a name.
const WORTH_A_NAME: f64 = 0.01;

/// A rival with less than this probability needs no measurement to be refuted.
const RIVAL: f64 = 1e-4;

/// Rows of the data that are handed back, at most; of longer records every so many-th.
const MOST_ROWS: usize = 2000;

/// How a diagnosis is made.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Seed of the random numbers.
    pub seed: u64,
}

/// The hypotheses of a case weighed against its data.
pub(crate) struct Weighed<'c> {
    pub(crate) setup: Setup<'c>,
    pub(crate) discrepancy: Discrepancy,
    pub(crate) posterior: Posterior,
    /// Place of the most probable hypothesis that is not "unexplained".
    pub(crate) best: usize,
    /// Whether it is more probable than "unexplained".
    pub(crate) explained: bool,
    /// What the verdict adds to the sim.
    pub(crate) correction: Correction,
    /// Variances of the noise by value.
    pub(crate) variances: Vec<f64>,
}

impl<'c> Weighed<'c> {
    pub(crate) fn new(
        case: &'c Case,
        seed: u64,
        effort: Effort,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Self {
        let setup = Setup::new(case);
        let discrepancy = Discrepancy::new(&setup);
        let posterior = posterior::posterior(&setup, &discrepancy, seed, effort, progress);
        let best = (0..posterior.hypotheses.len())
            .max_by(|&a, &b| {
                posterior.hypotheses[a].probability.total_cmp(&posterior.hypotheses[b].probability)
            })
            .unwrap_or(0);
        let explained = posterior.hypotheses[best].probability >= posterior.probability;
        let correction = if explained {
            Correction::Effects(posterior.hypotheses[best].effects.clone())
        } else {
            Correction::Unexplained
        };
        let variances = noise_variances(&setup, &posterior, best, explained);
        Self { setup, discrepancy, posterior, best, explained, correction, variances }
    }

    /// The verdict and what these data cannot tell from it, as places of hypotheses.
    pub(crate) fn group(&self) -> Vec<usize> {
        let modes = best_predictions(&self.setup, &self.posterior);
        group(&self.setup, &self.posterior, self.best, self.explained, &modes, &self.variances)
    }

    pub(crate) fn verdict(&self, group: &[usize]) -> Verdict {
        verdict(&self.setup, &self.posterior, self.best, self.explained, group)
    }
}

/// Coverage probability of the intervals of a case.
pub(crate) fn coverage(case: &Case) -> f64 {
    match case.task.settings.coverage {
        Coverage::Probability(p) => p,
        _ => 0.95,
    }
}

/// Diagnoses a case; `at` are rows of conditions to predict at. `progress` is told the share that is
/// done.
pub fn diagnose(
    case: &Case,
    at: Option<&[Row]>,
    options: Options,
    progress: &(dyn Fn(f64) + Sync),
) -> Diagnosis {
    let seed = options.seed;
    let weighed = Weighed::new(case, seed, Effort::FULL, &|share| progress(0.6 * share));
    let group = weighed.group();
    let verdict = weighed.verdict(&group);
    let Weighed { setup, discrepancy, posterior, best, explained, correction, variances } = weighed;
    let with_rows = plus_rows(&setup, &variances);
    let regions = scan::regions(&setup, &with_rows, seed);
    progress(0.7);
    let probability = coverage(case);
    let (shrinkage, rows) = shrink::shrinkage(
        &setup,
        &discrepancy,
        &posterior,
        &correction,
        &variances,
        probability,
        seed,
    );
    progress(0.85);
    let next = rival(&posterior, best, &group)
        .filter(|_| explained)
        .and_then(|rival| next::best(&setup, &posterior, best, rival, &variances, seed));
    progress(0.95);
    let step = rows.len().div_ceil(MOST_ROWS).max(1);
    let rows = rows.into_iter().step_by(step).collect();
    let hypotheses = hypotheses(&setup, &posterior, probability);
    let prediction = at.map(|at| prediction(&setup, &discrepancy, &posterior, at));
    let gap = gap(&setup, verdict.kind);
    let noise = noise(&setup, &variances, &posterior, best);
    let notes = notes(&setup, &posterior, &verdict, &shrinkage, &gap, best);
    progress(1.0);
    let named = |name: &str, unit: &gumption_units::Unit| Named {
        name: name.to_owned(),
        unit: unit.text().to_owned(),
    };
    Diagnosis {
        title: case.task.title.clone(),
        outputs: setup
            .data
            .outputs
            .iter()
            .map(|&output| &case.sim.outputs[output].quantity)
            .map(|quantity| named(&quantity.name, &quantity.unit))
            .collect(),
        conditions: case.sim.conditions.iter().map(|c| named(&c.name, &c.unit)).collect(),
        gap,
        regions,
        verdict,
        hypotheses,
        shrinkage,
        next,
        prediction,
        rows,
        noise,
        notes,
        probability,
        seed,
    }
}

/// Variance of the noise by value: stated, or estimated with the best hypothesis.
fn noise_variances(
    setup: &Setup<'_>,
    posterior: &Posterior,
    best: usize,
    explained: bool,
) -> Vec<f64> {
    let data = &setup.data;
    let outputs = data.outputs.len();
    let stated =
        |value: usize| data.uncertainties[value % outputs].as_ref().map(|u| u[value / outputs]);
    if !setup.covariance.fitted {
        return (0..data.len()).map(|value| stated(value).map_or(1.0, |u| u * u)).collect();
    }
    if !explained
        && let Some(kind) = posterior.unexplained.kinds.first()
        && let Some(variances) = &kind.variances
    {
        return variances.to_vec();
    }
    let evidence = &posterior.hypotheses[best].evidence;
    let draws = predict::resampled(evidence, 128);
    let mut sums = vec![0.0; data.len()];
    for draw in &draws {
        let (mut ln, mut power) = (vec![0.0; outputs], vec![0.0; outputs]);
        for (role, &score) in setup.roles.iter().zip(draw) {
            match role {
                Role::Noise { output, map } => ln[*output] = map.value(score),
                Role::Power { output, map } => power[*output] = map.value(score),
                Role::Variable { .. } => {}
            }
        }
        for (value, sum) in sums.iter_mut().enumerate() {
            let output = value % outputs;
            *sum += match stated(value) {
                Some(u) => u * u,
                None => (2.0 * (ln[output] + power[output] * setup.ln_sizes[value])).exp(),
            };
        }
    }
    sums.iter().map(|sum| sum / draws.len().max(1) as f64).collect()
}

/// Noise and what belongs to a row alone.
fn plus_rows(setup: &Setup<'_>, noise: &[f64]) -> Vec<f64> {
    if setup.covariance.fitted {
        return noise.iter().zip(&setup.linear.variances).map(|(n, v)| n.max(*v)).collect();
    }
    setup.linear.variances.clone()
}

/// The chi-square test of all residuals.
fn gap(setup: &Setup<'_>, kind: Kind) -> Gap {
    let present = kind != Kind::None;
    let values = setup.data.len() as f64;
    if setup.linear.fitted {
        return lack_of_fit(setup, present);
    }
    let residuals = by_rows(&setup.data.nominal_residuals());
    let whitened = setup.linear.whiten_blocks(&residuals);
    let projected = setup.linear.project(&whitened);
    let chi2 = (super::covariance::dot(&whitened, &whitened) - projected.norm_squared()).max(0.0);
    let p_value = special::gamma::ln_sf(0.5 * chi2, 0.5 * values).exp();
    Gap { present, p_value: Some(p_value), chi2, dof: values }
}

/// Where the noise is estimated: means of repeats against the scatter of repeats (F test of lack of
/// fit), the shared inputs being free.
fn lack_of_fit(setup: &Setup<'_>, present: bool) -> Gap {
    let data = &setup.data;
    let residuals = data.nominal_residuals();
    let (mut within, mut between, mut repeats, mut means) = (0.0, 0.0, 0usize, 0usize);
    let mut variances = Vec::new();
    for residuals in &residuals {
        let mut squares = 0.0;
        let mut count = 0;
        for point in data.points.iter().filter(|point| point.rows.len() > 1) {
            let mean =
                point.rows.iter().map(|&row| residuals[row]).sum::<f64>() / point.rows.len() as f64;
            squares += point.rows.iter().map(|&row| (residuals[row] - mean).powi(2)).sum::<f64>();
            count += point.rows.len() - 1;
        }
        variances.push((squares, count));
    }
    for (residuals, (squares, count)) in residuals.iter().zip(&variances) {
        if *count == 0 || *squares <= 0.0 {
            continue;
        }
        let variance = squares / *count as f64;
        within += squares / variance;
        repeats += count;
        for point in &data.points {
            let n = point.rows.len() as f64;
            let mean = point.rows.iter().map(|&row| residuals[row]).sum::<f64>() / n;
            between += n * mean * mean / variance;
            means += 1;
        }
    }
    if repeats == 0 || means == 0 {
        return Gap { present, p_value: None, chi2: f64::NAN, dof: 0.0 };
    }
    let f = (between / means as f64) / (within / repeats as f64);
    let (d1, d2) = (means as f64, repeats as f64);
    let p_value = special::beta::cdf(d2 / (d2 + d1 * f), 0.5 * d2, 0.5 * d1);
    Gap { present, p_value: Some(p_value), chi2: between, dof: d1 }
}

/// What every hypothesis says at its most probable point, by value.
fn best_predictions(setup: &Setup<'_>, posterior: &Posterior) -> Vec<Option<Vec<f64>>> {
    let rows: Vec<Row> = setup
        .data
        .points
        .iter()
        .filter_map(|point| point.rows.first())
        .map(|&row| setup.case.task.rows[setup.data.ids[row]].clone())
        .collect();
    let most = posterior.hypotheses.iter().map(|h| h.probability).fold(0.0, f64::max);
    posterior
        .hypotheses
        .iter()
        .map(|hypothesis| {
            if hypothesis.probability < 1e-3 * WORTH_A_NAME * most {
                return None;
            }
            let mode = hypothesis.evidence.modes.first()?.scores.clone();
            let values = predict::values(setup, &hypothesis.effects, &[mode], &rows);
            Some(values.into_iter().flatten().filter_map(|draws| draws.first().copied()).collect())
        })
        .collect()
}

/// The places of the hypotheses that these data cannot tell from the best one, itself first.
fn group(
    setup: &Setup<'_>,
    posterior: &Posterior,
    best: usize,
    explained: bool,
    predictions: &[Option<Vec<f64>>],
    variances: &[f64],
) -> Vec<usize> {
    if !explained {
        return Vec::new();
    }
    let Some(Some(own)) = predictions.get(best) else { return vec![best] };
    let outputs = setup.data.outputs.len();
    let distance = |other: &Vec<f64>| {
        let mut squares = 0.0;
        for (number, point) in setup.data.points.iter().enumerate() {
            for &row in &point.rows {
                for output in 0..outputs {
                    let place = number * outputs + output;
                    let difference = other[place] - own[place];
                    squares += difference * difference / variances[row * outputs + output];
                }
            }
        }
        squares.sqrt()
    };
    let least = WORTH_A_NAME * posterior.hypotheses[best].probability;
    let mut alike: Vec<usize> = (0..predictions.len())
        .filter(|&place| place != best && posterior.hypotheses[place].probability >= least)
        .filter(|&place| predictions[place].as_ref().is_some_and(|other| distance(other) < ALIKE))
        .collect();
    alike.sort_by(|&a, &b| {
        posterior.hypotheses[b].probability.total_cmp(&posterior.hypotheses[a].probability)
    });
    let mut group = vec![best];
    group.extend(alike);
    group
}

/// The hypothesis to tell the best one from: the most probable one that is not the best with more
/// effects added, since an addition that the data leave open makes no difference to be measured; a
/// look-alike first.
fn rival(posterior: &Posterior, best: usize, group: &[usize]) -> Option<usize> {
    let own = &posterior.hypotheses.get(best)?.effects;
    let adds = |place: usize| {
        let effects = &posterior.hypotheses[place].effects;
        own.iter().all(|effect| effects.contains(effect))
    };
    let probability = |place: usize| posterior.hypotheses[place].probability;
    let others = || {
        (0..posterior.hypotheses.len())
            .filter(|&place| place != best && probability(place) > RIVAL)
            .map(|place| (place, group.contains(&place), adds(place)))
    };
    let most = |among: &mut dyn Iterator<Item = usize>| {
        among.max_by(|&a, &b| probability(a).total_cmp(&probability(b)))
    };
    most(&mut others().filter(|(_, alike, adds)| *alike && !adds).map(|(place, ..)| place))
        .or_else(|| most(&mut others().filter(|(.., adds)| !adds).map(|(place, ..)| place)))
        .or_else(|| most(&mut others().map(|(place, ..)| place)))
}

fn names(setup: &Setup<'_>, effects: &[usize]) -> Vec<String> {
    effects.iter().map(|&e| setup.case.candidates[e].effect.name.clone()).collect()
}

fn verdict(
    setup: &Setup<'_>,
    posterior: &Posterior,
    best: usize,
    explained: bool,
    group: &[usize],
) -> Verdict {
    if !explained {
        return Verdict {
            kind: Kind::Unexplained,
            effects: Vec::new(),
            probability: posterior.probability,
            group: Vec::new(),
            group_probability: posterior.probability,
        };
    }
    let winner = &posterior.hypotheses[best];
    Verdict {
        kind: if winner.effects.is_empty() { Kind::None } else { Kind::Explained },
        effects: names(setup, &winner.effects),
        probability: winner.probability,
        group: group.iter().map(|&h| names(setup, &posterior.hypotheses[h].effects)).collect(),
        group_probability: group.iter().map(|&h| posterior.hypotheses[h].probability).sum(),
    }
}

/// All hypotheses, most probable first.
pub(crate) fn hypotheses(
    setup: &Setup<'_>,
    posterior: &Posterior,
    probability: f64,
) -> Vec<Hypothesis> {
    let mut all: Vec<Hypothesis> = posterior
        .hypotheses
        .iter()
        .map(|hypothesis| Hypothesis {
            effects: Some(names(setup, &hypothesis.effects)),
            prior: hypothesis.prior,
            probability: hypothesis.probability,
            log_evidence: hypothesis.evidence.ln_evidence,
            error: hypothesis.evidence.error,
            effective: hypothesis.evidence.effective,
            best_log_likelihood: hypothesis
                .evidence
                .modes
                .iter()
                .map(super::search::Mode::ln_likelihood)
                .fold(f64::NEG_INFINITY, f64::max),
            fitted: hypothesis.evidence.unknowns() - setup.roles.len(),
            parameters: parameters(setup, hypothesis, probability),
        })
        .collect();
    all.push(Hypothesis {
        effects: None,
        prior: posterior.prior,
        probability: posterior.probability,
        log_evidence: posterior.unexplained.ln_evidence,
        error: 0.0,
        effective: 0.0,
        best_log_likelihood: f64::NEG_INFINITY,
        fitted: 0,
        parameters: Vec::new(),
    });
    all.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    all
}

/// The parameters of a hypothesis' effects.
pub(crate) fn parameters(
    setup: &Setup<'_>,
    hypothesis: &posterior::Hypothesis,
    probability: f64,
) -> Vec<Parameter> {
    let likelihood = setup.likelihood(&hypothesis.effects);
    let evidence = &hypothesis.evidence;
    let central = central_draw(setup, hypothesis);
    let mut parameters = Vec::new();
    for &effect in &hypothesis.effects {
        let places = setup.parameters(&hypothesis.effects, effect);
        let candidate = &setup.case.candidates[effect].effect;
        for (place, quantity) in places.zip(&candidate.parameters) {
            let Some(Role::Variable { maps, .. }) = likelihood.roles.get(place) else { continue };
            let Some(map) = maps.first() else { continue };
            let mut weighted: Vec<(f64, f64)> = evidence
                .weights
                .iter()
                .enumerate()
                .filter(|(_, weight)| **weight > 0.0)
                .map(|(n, &weight)| {
                    (map.value(evidence.columns[n / COLUMN][place].0[n % COLUMN]), weight)
                })
                .collect();
            let mean: f64 = weighted.iter().map(|(x, w)| x * w).sum();
            let variance: f64 = weighted.iter().map(|(x, w)| w * (x - mean).powi(2)).sum();
            let estimate = central.get(place).map_or(mean, |score| map.value(*score));
            weighted.sort_by(|a, b| a.0.total_cmp(&b.0));
            let [lower, upper] = equal_tails(&weighted, probability);
            parameters.push(Parameter {
                name: format!("{}/{}", candidate.name, quantity.name),
                unit: quantity.unit.text().to_owned(),
                estimate,
                standard_uncertainty: variance.max(0.0).sqrt(),
                interval: [lower.min(estimate), upper.max(estimate)],
            });
        }
    }
    parameters
}

/// The draw whose prediction of the data is nearest to the mean prediction; the most probable point
/// where the hypothesis is not worth that.
fn central_draw(setup: &Setup<'_>, hypothesis: &posterior::Hypothesis) -> Vec<f64> {
    let mode =
        hypothesis.evidence.modes.first().map(|mode| mode.scores.clone()).unwrap_or_default();
    if hypothesis.effects.is_empty() || hypothesis.probability < 1e-3 {
        return mode;
    }
    let draws = predict::resampled(&hypothesis.evidence, 128);
    let step = setup.data.points.len().div_ceil(500).max(1);
    let rows: Vec<Row> = setup
        .data
        .points
        .iter()
        .step_by(step)
        .filter_map(|point| point.rows.first())
        .map(|&row| setup.case.task.rows[setup.data.ids[row]].clone())
        .collect();
    let values = predict::values(setup, &hypothesis.effects, &draws, &rows);
    let moments = shrink::moments(&values);
    let spread: Vec<f64> = (0..setup.data.outputs.len())
        .map(|output| moments.iter().map(|row| row[output].1).sum::<f64>().max(f64::MIN_POSITIVE))
        .collect();
    let distance = |draw: usize| -> f64 {
        values
            .iter()
            .zip(&moments)
            .flat_map(|(row, means)| row.iter().zip(means).zip(&spread))
            .map(|((draws, (mean, _)), spread)| (draws[draw] - mean).powi(2) / spread)
            .sum()
    };
    let nearest = (0..draws.len()).min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
    nearest.map_or(mode, |nearest| draws[nearest].clone())
}

/// The interval with equal tails; values are in order, with weights that sum to one. Half of each
/// value's weight lies on either side of it.
fn equal_tails(weighted: &[(f64, f64)], share: f64) -> [f64; 2] {
    let tail = 0.5 * (1.0 - share);
    [quantile(weighted, tail), quantile(weighted, 1.0 - tail)]
}

fn quantile(weighted: &[(f64, f64)], p: f64) -> f64 {
    let mut before = 0.0;
    let mut last: Option<(f64, f64)> = None;
    for &(value, weight) in weighted {
        let middle = before + 0.5 * weight;
        if middle >= p {
            return match last {
                Some((lower, at)) if middle > at => {
                    lower + (value - lower) * (p - at) / (middle - at)
                }
                _ => value,
            };
        }
        before += weight;
        last = Some((value, middle));
    }
    last.map_or(f64::NAN, |(value, _)| value)
}

/// Corrected predictions, averaged over the hypotheses by their probabilities.
pub(crate) fn prediction(
    setup: &Setup<'_>,
    discrepancy: &Discrepancy,
    posterior: &Posterior,
    rows: &[Row],
) -> Vec<Predicted> {
    let outputs = setup.data.outputs.len();
    let mut sums = vec![vec![(0.0, 0.0); outputs]; rows.len()];
    let mut total = 0.0;
    let mut add = |share: f64, normals: &predict::Normals| {
        total += share;
        for (sums, values) in sums.iter_mut().zip(normals) {
            for (sum, (mean, variance)) in sums.iter_mut().zip(values) {
                sum.0 += share * mean;
                sum.1 += share * (variance + mean * mean);
            }
        }
    };
    for hypothesis in posterior.hypotheses.iter().filter(|h| h.probability > 1e-3) {
        let draws = predict::resampled(&hypothesis.evidence, shrink::draws_for(rows.len()));
        let values = predict::values(setup, &hypothesis.effects, &draws, rows);
        add(hypothesis.probability, &shrink::moments(&values));
    }
    if posterior.probability > 1e-3 {
        let kinds = shrink::top(&posterior.unexplained.kinds);
        add(posterior.probability, &predict::unexplained(setup, discrepancy, kinds, rows));
    }
    rows.iter()
        .zip(sums)
        .map(|(row, sums)| {
            let linear = predict::linear_variances(setup, row);
            let outputs = sums.iter().zip(linear).map(|((mean, square), linear)| {
                let mean = mean / total;
                let variance = (square / total - mean * mean).max(0.0) + linear;
                (mean, variance.sqrt())
            });
            Predicted { conditions: row.conditions.clone(), outputs: outputs.collect() }
        })
        .collect()
}

fn noise(setup: &Setup<'_>, variances: &[f64], posterior: &Posterior, best: usize) -> Vec<Noise> {
    let outputs = setup.data.outputs.len();
    let mode = posterior.hypotheses.get(best).and_then(|h| h.evidence.modes.first());
    (0..outputs)
        .filter(|&output| setup.data.uncertainties[output].is_none())
        .map(|output| {
            let own: Vec<f64> = variances.iter().skip(output).step_by(outputs).copied().collect();
            let ln: f64 = own.iter().map(|v| 0.5 * v.ln()).sum::<f64>() / own.len().max(1) as f64;
            let power = setup.roles.iter().enumerate().find_map(|(place, role)| match role {
                Role::Power { output: of, map } if *of == output => {
                    mode.and_then(|mode| mode.scores.get(place)).map(|score| map.value(*score))
                }
                _ => None,
            });
            Noise { output, standard_uncertainty: ln.exp(), power: power.unwrap_or(0.0) }
        })
        .collect()
}

fn notes(
    setup: &Setup<'_>,
    posterior: &Posterior,
    verdict: &Verdict,
    shrinkage: &super::diagnosis::Shrinkage,
    gap: &Gap,
    best: usize,
) -> Vec<Note> {
    let mut notes = Vec::new();
    let mut note = |code: &'static str, text: String| notes.push(Note { code, text });
    if setup.covariance.fitted {
        let repeats = setup.data.points.iter().any(|point| point.rows.len() > 1);
        note(
            "estimated-noise",
            if repeats {
                "The noise of outputs without stated uncertainties is estimated from repeated rows \
                 and residuals together."
                    .to_owned()
            } else {
                "Neither stated uncertainties nor repeated rows are there, so the noise is estimated \
                 from the residuals themselves: a departure that looks like noise cannot be told from \
                 it, and the chi-square test says nothing."
                    .to_owned()
            },
        );
    }
    let winner = &posterior.hypotheses[best];
    if verdict.kind != Kind::Unexplained && winner.evidence.effective < 50.0 {
        note(
            "poor-integral",
            format!(
                "The evidence of the verdict rests on {:.0} effective draws only (standard error of its \
                 logarithm {:.2}); the probabilities are averages over that error, and less sure for \
                 it.",
                winner.evidence.effective, winner.evidence.error
            ),
        );
    }
    if verdict.group.len() > 1 {
        note(
            "look-alikes",
            "These data cannot tell the hypotheses of the verdict's group apart: their predictions \
             coincide within the uncertainties, and only the prior decides between them."
                .to_owned(),
        );
    }
    if gap.present && !shrinkage.meaningful {
        note(
            "small-gap",
            "The gap is below 3 standard uncertainties of the data, so the removed fraction is a ratio \
             of two noises and is not stated."
                .to_owned(),
        );
    }
    if verdict.kind == Kind::Explained && shrinkage.chi2_per_dof[1] > misfit(setup.data.len()) {
        note(
            "poor-fit",
            format!(
                "The verdict is the best of the hypotheses but leaves a chi-square of {:.2} per value \
                 on conditions that were left out: something is still missing.",
                shrinkage.chi2_per_dof[1]
            ),
        );
    }
    if let (Kind::None, Some(p)) = (verdict.kind, gap.p_value)
        && p < OVERDISPERSED
    {
        note(
            "scatter",
            format!(
                "The residuals are {:.2} times as large as their uncertainties allow, but without a \
                 pattern that an effect or a smooth discrepancy would make: the stated noise is \
                 probably too small, or values are wrong one by one.",
                (gap.chi2 / gap.dof).sqrt()
            ),
        );
    }
    if setup.data.points.len() < 8 {
        note(
            "few-conditions",
            format!(
                "There are only {} different conditions; effects that differ elsewhere look alike here.",
                setup.data.points.len()
            ),
        );
    }
    notes
}

/// The chi-square test speaks against the verdict "no gap" below this probability.
const OVERDISPERSED: f64 = 1e-3;

/// A mean square of normalized residuals that data without a misfit exceed with probability 1e-3.
fn misfit(values: usize) -> f64 {
    let n = values.max(1) as f64;
    special::gamma::quantile_upper(1e-3, 0.5 * n) / (0.5 * n)
}
