//! The hypotheses weighed with every noise model that the data do not rule out.

use std::sync::Arc;

use gumption_engine::number::elementary;
use gumption_engine::parallel;

use crate::Case;
use crate::discrepancy::Discrepancy;
use crate::logarithm::ln_add;
use crate::noise::needless::without_needless;
use crate::noise::noise_model::{Factor, NoiseModel, SERIAL, Suspect, WORTH_TRYING, lag};
use crate::noise::prior_widths::{self, Begun, OtherPriors, PriorWidths};
use crate::noise::suspects::more_suspects;
use crate::noise::weighing::{Weighing, ln_total, ln_weight_at_mode};
use crate::noise::{common_noise_search, shared_noise_search};
use crate::posterior::{self, Beginnings, Effort, MANY_VALUES};
use crate::setup::Setup;

/// A serial correlation is tried although its evidence at the modes without it is lower by this
/// factor's logarithm: modes move with it.
const MOVED: f64 = 2.0;

/// The hypotheses weighed with every noise model that the data do not rule out, the one as stated
/// first; and with priors of other widths where the stated ones contradict the data or may hide what
/// explains them.
pub fn weighings<'c>(
    case: &'c Case,
    others: &'c OtherPriors,
    seed: u64,
    effort: Effort<'_>,
    progress: &(dyn Fn(f64) + Sync),
) -> Vec<Weighing<'c>> {
    let begun = |(setup, singles, pairs): Begun<'c>,
                 (widths, prior): (PriorWidths, f64),
                 known: &[Weighing<'c>],
                 [from, to]: [f64; 2]| {
        // with other priors the noise is as it is stated, and a discrepancy's forms are those there;
        // with the same priors as there, modes are near those there
        let (discrepancy, before) = match known.first() {
            Some(stated) if widths != PriorWidths::AsStated => {
                (Arc::clone(&stated.discrepancy), None)
            }
            stated => (Arc::new(Discrepancy::new(&setup)), stated.map(Weighing::before)),
        };
        let posterior = posterior::posterior(
            &setup,
            Beginnings { singles, pairs, before },
            &discrepancy,
            seed,
            effort,
            ln_rivals(known, prior),
            &|share| {
                progress(from + (to - from) * share);
            },
        );
        Weighing { widths, setup, discrepancy, posterior, prior, probability: 0.0 }
    };
    let weighing = |setup: Setup<'c>, prior: f64, known: &[Weighing<'c>], parts: [f64; 2]| {
        let before = known.first().map(Weighing::before);
        let rivals = ln_rivals(known, prior);
        let singles = posterior::singles_again(&setup, before, rivals, seed, effort);
        let pairs = setup.case.pairs();
        begun((setup, singles, pairs), (PriorWidths::AsStated, prior), known, parts)
    };
    let setup = Setup::new(case);
    let values = setup.data.len();
    let stated = NoiseModel::default().prior(values);
    let mut weighings = vec![weighing(setup, stated, &[], [0.0, 0.35])];
    let noisy = |model: NoiseModel, known: &[Weighing<'c>], parts: [f64; 2]| {
        let prior = model.prior(values);
        weighing(known[0].setup.with_noise(model), prior, known, parts)
    };
    let stated = &weighings[0].setup.data.uncertainties;
    // of much data each model costs a pass for every draw
    let few = weighings[0].setup.data.len() <= MANY_VALUES && !effort.is_stopped();
    if stated.iter().any(Option::is_some) && few {
        let usual = noisy(NoiseModel::with_factor(Factor::Usual), &weighings, [0.35, 0.7]);
        let is_beyond = usual.is_beyond_factors();
        weighings.push(usual);
        if is_beyond && !effort.is_stopped() {
            let far = NoiseModel::with_factor(Factor::Far);
            weighings.push(noisy(far, &weighings, [0.35, 0.7]));
        }
    }
    if few && !effort.is_stopped() {
        for setup in serial_correlations(&weighings) {
            let prior = setup.data.noise.prior(values);
            weighings.push(weighing(setup, prior, &weighings, [0.7, 0.7]));
        }
    }
    if few && !effort.is_stopped() {
        for noise in shared_noise_search::worth_trying(&weighings) {
            let is_departure = noise.is_departure();
            let mut own = noisy(NoiseModel::with_shared(noise), &weighings, [0.7, 0.7]);
            // where "unexplained" is ruled out beforehand they are errors of the settings all the same
            if is_departure && own.posterior.prior > 0.0 {
                own.posterior.none_is_unexplained();
            }
            weighings.push(own);
        }
    }
    if few && !effort.is_stopped() {
        for noise in common_noise_search::worth_trying(&weighings) {
            let noise = NoiseModel::with_common(noise);
            weighings.push(noisy(noise, &weighings, [0.7, 0.7]));
        }
    }
    for widths in [PriorWidths::Wider, PriorWidths::Widest, PriorWidths::Narrower] {
        if !few || effort.is_stopped() {
            break;
        }
        let other = prior_widths::begin(widths, others, &weighings, seed, effort);
        if let Some(other) = other {
            weighings.push(begun(other, (widths, widths.prior()), &weighings, [0.7, 0.8]));
        }
    }
    let off = |suspects: Vec<Suspect>, known: &[Weighing<'c>]| {
        noisy(NoiseModel::with_suspects(suspects), known, [0.8, 1.0])
    };
    while few && !effort.is_stopped() {
        let Some(suspects) = more_suspects(&weighings, seed, effort) else { break };
        weighings.push(off(suspects, &weighings));
    }
    if few && !effort.is_stopped() {
        let needed = without_needless(&weighings);
        weighings.extend(needed.map(|suspects| off(suspects, &weighings)));
    }
    weigh(&mut weighings);
    progress(1.0);
    weighings
}

/// The same over the prior probability of what is weighed beside it.
fn ln_rivals(known: &[Weighing<'_>], prior: f64) -> f64 {
    ln_total(known) - elementary::ln(prior)
}

/// The serial correlations that may be worth an evidence of their own, with setups of them: by the
/// densities of the data at the modes that the hypotheses have without the correlation, and with it.
fn serial_correlations<'c>(weighings: &[Weighing<'c>]) -> Vec<Setup<'c>> {
    let Some(Weighing { setup, posterior, .. }) = weighings.first() else { return Vec::new() };
    if setup.linear.fitted || setup.data.rows() < LEAST_ROWS {
        return Vec::new();
    }
    let total = ln_total(weighings);
    let at_modes = |setup: &Setup<'_>| -> Vec<f64> {
        parallel::map(&posterior.hypotheses, |hypothesis| {
            let Some(mode) = hypothesis.evidence.modes.first() else { return f64::NEG_INFINITY };
            let likelihood = setup.likelihood(&hypothesis.effects);
            let scores = likelihood.columns(std::slice::from_ref(&mode.scores));
            likelihood.log_likelihood(&scores, 1)[0]
        })
    };
    let without = at_modes(setup);
    let ln_prior = elementary::ln(NoiseModel::with_serial(0.0).prior(setup.data.len()));
    let is_worth = |serial: &Setup<'_>| {
        let gains = at_modes(serial).into_iter().zip(&without).map(|(with, ln)| with - ln);
        let hypotheses = posterior.hypotheses.iter().zip(gains);
        let all = hypotheses.map(|(hypothesis, gain)| ln_weight_at_mode(setup, hypothesis) + gain);
        let sum = all.filter(|ln| !ln.is_nan()).fold(f64::NEG_INFINITY, ln_add);
        sum + ln_prior + MOVED - total > elementary::ln(WORTH_TRYING)
    };
    let with = |serial: &f64| setup.with_noise(NoiseModel::with_serial(*serial));
    SERIAL.iter().map(with).filter(is_worth).collect()
}

/// Fewer rows say nothing of a serial correlation.
const LEAST_ROWS: usize = 8;

/// By how much the logarithm of the density of residuals rises if neighbouring rows are correlated.
pub fn serial_gain(setup: &Setup<'_>, residuals: &[f64], coefficient: f64) -> f64 {
    let outputs = setup.data.outputs.len();
    let mut gain = 0.0;
    for (row, ids) in setup.data.ids.windows(2).enumerate() {
        let lag = lag(coefficient, ids[0], ids[1]);
        for output in 0..outputs {
            let (before, here) = (
                residuals.get(row * outputs + output),
                residuals.get((row + 1) * outputs + output),
            );
            let (Some(before), Some(here)) = (before, here) else { return f64::NEG_INFINITY };
            let rest = here - lag * before;
            gain -= 0.5 * (rest * rest / (1.0 - lag * lag) - here * here);
            gain -= 0.5 * elementary::ln(1.0 - lag * lag);
        }
    }
    gain
}

/// Posterior probabilities of the noise models.
fn weigh(weighings: &mut [Weighing<'_>]) {
    let total = ln_total(weighings);
    for weighing in weighings.iter_mut() {
        weighing.probability = elementary::exp(weighing.ln_weight() - total);
    }
}
