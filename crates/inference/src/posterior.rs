//! The posterior probabilities of all hypotheses.

use std::sync::atomic::{AtomicBool, Ordering};

use gumption_engine::parallel;

use super::beside::{Beside, prior_alone};
use super::data::by_rows;
use super::discrepancy::{Discrepancy, Unexplained};
use super::latent::{AT_BOUND, EDGE, Map};
use super::likelihood::Likelihood;
use super::logarithm::ln_add;
use super::setup::Setup;
use crate::integral::evidence::EvidenceEstimate;
use crate::integral::evidence_error;
use crate::integral::exploration::Exploration;
use gumption_engine::number::elementary;

/// A hypothesis that effects explain the data: none of them, or one or more together.
#[derive(Clone, Debug)]
pub struct WeighedHypothesis {
    /// Places of the candidates that act.
    pub effects: Vec<usize>,
    /// Prior probability.
    pub prior: f64,
    /// Its evidence.
    pub evidence: EvidenceEstimate,
    /// Posterior probability.
    pub probability: f64,
}

/// All hypotheses with their probabilities.
#[derive(Debug)]
pub struct Posterior {
    /// All that were tried.
    pub hypotheses: Vec<WeighedHypothesis>,
    /// Those with a departure beside the effects that none of them makes.
    pub beside: Vec<Beside>,
    /// "Unexplained": a departure without any of the effects.
    pub unexplained: Unexplained,
    /// Prior probability of "unexplained".
    pub prior: f64,
    /// Prior probability of a departure, beside effects or not.
    pub(crate) departure_prior: f64,
    /// Posterior probability of "unexplained".
    pub probability: f64,
    /// What of it is that of errors of each setting, without an effect and without a pattern.
    pub of_settings: f64,
    /// Logarithm of the evidence of all hypotheses together.
    pub(crate) ln_evidence: f64,
    /// Logarithm of the evidence of what else may be true, over this setup's prior probability.
    rivals: f64,
}

/// How much is computed.
#[derive(Clone, Copy, Debug)]
pub struct Effort<'s> {
    /// Starts of the search for modes.
    pub starts: usize,
    /// The standard error of a probability that is good enough.
    pub error: f64,
    /// Generations of chains.
    pub generations: usize,
    /// Refinements at most.
    pub rounds: usize,
    /// The effective number of draws of hypotheses that are reported in detail.
    pub effective_sample_size: f64,
    /// Once this is set, nothing new is begun.
    pub stop: Option<&'s AtomicBool>,
}

impl Effort<'_> {
    /// Whether what is known so far is asked for.
    pub fn is_stopped(&self) -> bool {
        self.stop.is_some_and(|stop| stop.load(Ordering::Relaxed))
    }

    /// For an answer.
    pub const FULL: Effort<'static> = Effort {
        starts: 16,
        error: 0.005,
        generations: 240,
        rounds: 24,
        effective_sample_size: 1000.0,
        stop: None,
    };
    /// Less where every draw costs a pass over much data: there the posterior is narrow and nearly
    /// normal, so that few draws serve as well.
    fn for_values(self, values: usize) -> Self {
        if values <= MANY_VALUES {
            return self;
        }
        let (starts, generations, rounds) = (0, 0, 3);
        Self { starts, generations, rounds, effective_sample_size: 60.0, error: 0.03, ..self }
    }

    /// For a first look, and for many data sets.
    pub const QUICK: Effort<'static> = Effort {
        starts: 8,
        error: 0.015,
        generations: 120,
        rounds: 12,
        effective_sample_size: 400.0,
        stop: None,
    };
}

/// A normal score beyond this is far out in its prior.
const FAR_OUT: f64 = 2.5;

/// Hypotheses above this probability are looked at from end to end.
const LEADING: f64 = 0.01;

/// With more values than this, modes are searched in a part of the data first.
pub(crate) const MANY_VALUES: usize = 20_000;

/// Hypotheses that were weighed with another noise, and the setup of that.
pub(crate) type Before<'p, 'c> = (&'p Setup<'c>, &'p Posterior);

/// No gap and every effect alone, with first estimates of their evidences.
pub fn singles(setup: &Setup<'_>, seed: u64, effort: Effort<'_>) -> Vec<WeighedHypothesis> {
    singles_again(setup, None, f64::NEG_INFINITY, seed, effort)
}

/// The same where they were weighed with another noise; `rivals` is as for [`posterior`].
pub(crate) fn singles_again(
    setup: &Setup<'_>,
    before: Option<Before<'_, '_>>,
    rivals: f64,
    seed: u64,
    effort: Effort<'_>,
) -> Vec<WeighedHypothesis> {
    let effort = effort.for_values(setup.data.len());
    Exploration::new(setup, seed, effort).singles(before, rivals)
}

/// A hypothesis as its best modes with another noise have it, with a first estimate of its evidence;
/// `None` where there are none, or too many data to look.
pub(crate) fn again(
    setup: &Setup<'_>,
    effects: &[usize],
    before: Before<'_, '_>,
    seed: u64,
    effort: Effort<'_>,
) -> Option<WeighedHypothesis> {
    let effort = effort.for_values(setup.data.len());
    Exploration::new(setup, seed, effort).again(effects, before)
}

/// The hypotheses that are to be weighed.
pub(crate) struct Beginnings<'p, 'c> {
    /// Those of at most one effect, with first estimates of their evidences.
    pub(crate) singles: Vec<WeighedHypothesis>,
    /// Pairs of effects, not yet begun.
    pub(crate) pairs: Vec<Vec<usize>>,
    /// The same hypotheses weighed with another noise, if they were.
    pub(crate) before: Option<Before<'p, 'c>>,
}

/// Weighs all hypotheses against the data of a setup. `rivals` is the logarithm of the evidence of
/// everything else that may be true, over the prior probability of this setup: what is improbable
/// beside it need not be known well.
pub(crate) fn posterior(
    setup: &Setup<'_>,
    beginnings: Beginnings<'_, '_>,
    discrepancy: &Discrepancy,
    seed: u64,
    effort: Effort<'_>,
    rivals: f64,
    progress: &(dyn Fn(f64) + Sync),
) -> Posterior {
    let effort = effort.for_values(setup.data.len());
    let prior = setup.prior();
    let exploration = Exploration::new(setup, seed, effort);
    let Beginnings { singles: mut hypotheses, pairs, before } = beginnings;
    progress(0.2);
    let residuals = by_rows(&setup.data.linear_residuals());
    let unexplained_prior = prior_alone(setup.case, &prior);
    let floor =
        leading(&hypotheses, rivals) - elementary::ln(unexplained_prior.max(f64::MIN_POSITIVE));
    let unexplained = discrepancy.evidence(setup, &residuals, floor);
    progress(0.3);
    if prior.two > 0.0 && !effort.is_stopped() {
        let leads = leading(&hypotheses, rivals);
        let begin = |effects: Vec<usize>| exploration.begin(effects, &hypotheses, before, leads);
        let of_pairs = parallel::map(pairs, begin);
        hypotheses.extend(of_pairs.into_iter().flatten());
        if !effort.is_stopped() {
            let least = before.map_or(f64::NEG_INFINITY, |_| leads - HOPELESS);
            exploration.reconcile(&mut hypotheses, least);
        }
    }
    progress(0.6);
    let mut posterior = Posterior {
        hypotheses,
        beside: Vec::new(),
        unexplained,
        prior: unexplained_prior,
        departure_prior: prior.unexplained,
        probability: 0.0,
        of_settings: 0.0,
        ln_evidence: f64::NEG_INFINITY,
        rivals,
    };
    posterior.weigh();
    // the leading hypotheses are looked at from end to end
    let share = posterior.share();
    let leads = |h: &&mut WeighedHypothesis| {
        h.probability * share > LEADING && !h.effects.is_empty() && !effort.is_stopped()
    };
    parallel::map(posterior.hypotheses.iter_mut().filter(leads), |hypothesis| {
        let likelihood = setup.likelihood(&hypothesis.effects);
        if effort.generations > 0 {
            hypothesis.evidence.along_profile_paths(&likelihood, setup.roles.len());
        }
        hypothesis.evidence.sample_chains(&likelihood, effort.generations);
    });
    posterior.weigh();
    for round in 0..effort.rounds {
        let share = posterior.share();
        let open: Vec<bool> = posterior
            .hypotheses
            .iter()
            .map(|hypothesis| hypothesis.is_open(effort.error, share))
            .collect();
        if effort.is_stopped() || !open.iter().any(|open| *open) {
            break;
        }
        let open = posterior.hypotheses.iter_mut().zip(open).filter(|(_, open)| *open);
        parallel::map(open, |(hypothesis, _)| {
            let likelihood: Likelihood<'_> = setup.likelihood(&hypothesis.effects);
            let columns = (2 + round / 2).min(8);
            hypothesis.evidence.refine(&likelihood, columns);
        });
        posterior.weigh();
        progress(0.6 + 0.4 * (round + 1) as f64 / effort.rounds as f64);
    }
    let share = posterior.share();
    let leads = |h: &&mut WeighedHypothesis| {
        h.probability * share > LEADING && !h.effects.is_empty() && !effort.is_stopped()
    };
    let (none, others) = posterior.hypotheses.split_at_mut(1);
    let none = &*none;
    parallel::map(others.iter_mut().filter(leads), |hypothesis| {
        exploration.replicate(hypothesis, none);
    });
    posterior.weigh();
    if !effort.is_stopped() {
        posterior.weigh_beside(setup, discrepancy, before, seed, effort);
        posterior.weigh();
    }
    // what is reported in detail deserves smooth intervals
    for _ in 0..effort.rounds {
        let share = posterior.share();
        let worth = |h: &WeighedHypothesis| {
            h.probability * share > 0.05
                && !h.effects.is_empty()
                && h.evidence.effective_sample_size < effort.effective_sample_size
        };
        if effort.is_stopped() || !posterior.hypotheses.iter().any(worth) {
            break;
        }
        parallel::map(posterior.hypotheses.iter_mut().filter(|h| worth(h)), |hypothesis| {
            let likelihood = setup.likelihood(&hypothesis.effects);
            hypothesis.evidence.refine(&likelihood, 4);
        });
        posterior.weigh();
    }
    posterior.average_over_errors(seed);
    progress(1.0);
    posterior
}

impl WeighedHypothesis {
    /// The logarithm of its prior probability times its evidence.
    pub fn ln_weight(&self) -> f64 {
        ln_weight(self.prior, self.evidence.ln_evidence)
    }

    /// Whether the prior of an effect's parameter holds its most probable point back: at a bound, or
    /// many standard deviations out.
    pub(crate) fn is_held_back(&self, setup: &Setup<'_>) -> bool {
        let Some(mode) = self.evidence.modes.first() else { return false };
        let priors = self.effects.iter().flat_map(|&e| &setup.case.candidates[e].priors);
        priors.zip(mode.scores.iter().skip(setup.roles.len())).any(|(prior, score)| {
            let most = if Map::of(prior).is_bounded() { AT_BOUND * EDGE } else { FAR_OUT };
            score.abs() > most
        })
    }

    /// How many times larger the evidence about its best mode is, in the Gaussian approximation, than what
    /// single draws make of it; 1 where there are more.
    fn missed(&self) -> f64 {
        let few = self.evidence.effective_sample_size < SINGLE_DRAWS;
        let mode = self.evidence.modes.first().filter(|_| few);
        mode.map_or(1.0, |mode| elementary::exp(mode.ln_evidence() - self.evidence.ln_evidence))
    }

    /// Whether its probability, beside everything else of which this setup has a share, is not yet
    /// known well enough.
    fn is_open(&self, error: f64, share: f64) -> bool {
        let p = self.probability * share;
        if self.evidence.standard_error == 0.0 || self.prior == 0.0 {
            return false;
        }
        // what one more standard error, or a region that was missed by few draws, could change
        let own = self.evidence.standard_error.min(3.0);
        let poor = self.evidence.effective_sample_size < 60.0;
        let missed = if poor { 20.0_f64.max(self.missed()) } else { 1.0 };
        p * (1.0 - p) * own > error || (p > 0.02 && poor) || (poor && p * missed > error)
    }
}

/// With fewer effective draws an evidence is that of single ones, which may be off by any factor.
const SINGLE_DRAWS: f64 = 10.0;

/// The logarithm of a prior probability times an evidence.
pub(crate) fn ln_weight(prior: f64, ln_evidence: f64) -> f64 {
    if prior > 0.0 { elementary::ln(prior) + ln_evidence } else { f64::NEG_INFINITY }
}

/// The logarithm of prior times evidence of the leading hypothesis, or of what else may be true.
fn leading(hypotheses: &[WeighedHypothesis], rivals: f64) -> f64 {
    hypotheses.iter().map(WeighedHypothesis::ln_weight).fold(rivals, f64::max)
}

/// Hypotheses that are less probable than what leads by this factor's logarithm, with the best modes
/// that they had with another noise, are not explored anew with this one.
pub(crate) const HOPELESS: f64 = 12.0;

impl Posterior {
    /// The hypothesis with the greatest prior times evidence.
    pub fn leading(&self) -> Option<&WeighedHypothesis> {
        self.hypotheses.iter().max_by(|a, b| a.ln_weight().total_cmp(&b.ln_weight()))
    }

    /// Counts the hypothesis without effects as "unexplained", with errors of each setting that nothing
    /// explains either.
    pub(crate) fn none_is_unexplained(&mut self) {
        let none = self.hypotheses.iter_mut().filter(|hypothesis| hypothesis.effects.is_empty());
        self.of_settings = none.map(|none| std::mem::take(&mut none.probability)).sum();
        self.probability += self.of_settings;
    }

    /// All hypotheses of effects, without a departure beside them and with one.
    pub fn named(&self) -> impl Iterator<Item = &WeighedHypothesis> {
        self.hypotheses.iter().chain(self.beside.iter().map(|beside| &beside.named))
    }

    pub(crate) fn named_mut(&mut self) -> impl Iterator<Item = &mut WeighedHypothesis> {
        self.hypotheses.iter_mut().chain(self.beside.iter_mut().map(|beside| &mut beside.named))
    }

    /// The hypothesis with these effects.
    pub(crate) fn of(&self, effects: &[usize]) -> Option<&WeighedHypothesis> {
        self.hypotheses.iter().find(|hypothesis| hypothesis.effects == effects)
    }

    /// The logarithm of prior times evidence of what leads, or of what else may be true.
    pub(crate) fn ln_leading(&self) -> f64 {
        let unexplained = ln_weight(self.prior, self.unexplained.ln_evidence);
        leading(&self.hypotheses, self.rivals).max(unexplained)
    }

    /// The probability of all hypotheses together beside what else may be true.
    pub(crate) fn share(&self) -> f64 {
        elementary::exp(self.ln_evidence - ln_add(self.ln_evidence, self.rivals))
    }

    /// Probabilities from priors and evidences.
    fn weigh(&mut self) {
        let unexplained = ln_weight(self.prior, self.unexplained.ln_evidence);
        let total =
            self.named().fold(unexplained, |sum, hypothesis| ln_add(sum, hypothesis.ln_weight()));
        for hypothesis in self.named_mut() {
            hypothesis.probability = elementary::exp(hypothesis.ln_weight() - total);
        }
        self.probability = elementary::exp(unexplained - total);
        self.ln_evidence = total;
    }

    /// Averages the probabilities over the errors of the integrals.
    fn average_over_errors(&mut self, seed: u64) {
        let known = |prior: f64, evidence: &EvidenceEstimate| evidence_error::LnWeight {
            ln: ln_weight(prior, evidence.ln_evidence),
            standard_error: evidence.standard_error,
            effective_sample_size: evidence.effective_sample_size,
        };
        let mut all: Vec<evidence_error::LnWeight> =
            self.named().map(|h| known(h.prior, &h.evidence)).collect();
        // the evidence of "unexplained" is exact
        all.push(evidence_error::LnWeight {
            ln: ln_weight(self.prior, self.unexplained.ln_evidence),
            standard_error: 0.0,
            effective_sample_size: 0.0,
        });
        let averaged = evidence_error::averaged(&all, self.share(), seed);
        let mut averaged = averaged.into_iter();
        for hypothesis in self.named_mut() {
            hypothesis.probability = averaged.next().unwrap_or(0.0);
        }
        self.probability = averaged.next().unwrap_or(0.0);
    }
}
