//! What the noise of the data may be, other than stated.
//!
//! The commonest causes of a gap on a bench are no effects at all: uncertainties that are stated too
//! small, and a row that is wrong. A diagnosis that takes the stated noise for certain explains them
//! by whatever effect or discrepancy comes nearest. What the noise is therefore belongs to every
//! hypothesis: as stated, or with the uncertainties of each output multiplied by an unknown factor
//! (Birge 1932, Physical Review 40, 207), or with noise that the outputs of a row, neighbouring rows or
//! those of one setting share, or with single values off by many standard uncertainties.
//! Probabilities of effects are summed over it.

use std::sync::Arc;

use gumption_engine::parallel;

use super::common_noise::{self, CommonNoise};
use super::discrepancy::Discrepancy;
use super::latent::{AT_BOUND, EDGE, Map, Role};
use super::logarithm::ln_add;
use super::needless::without_needless;
use super::posterior::{
    self, Before, Beginnings, Effort, MANY_VALUES, Posterior, WeighedHypothesis,
};
use super::prior_widths::{self, Begun, OtherPriors, PriorWidths};
use super::setup::Setup;
use super::shared_noise::{self, SharedNoise};
use super::suspects::more_suspects;
use crate::{Case, Prior};
use gumption_engine::number::elementary;

/// The factor on stated uncertainties is log-uniform between these.
pub(crate) const FACTORS: [f64; 2] = [0.25, 10.0];
/// The same where the data speak for more than that: a unit that was mistaken.
pub const FAR_FACTORS: [f64; 2] = [0.25, 1000.0];

/// Prior probability that the noise and the priors are as they are stated. It and those of all else
/// count relative to each other; what was not tried takes nothing from them.
const PRIOR_AS_STATED: f64 = 0.35;

/// Prior probability that stated uncertainties are off by a factor.
const PRIOR_FACTOR: f64 = 0.2;

/// Prior probability that they are off by one that may be beyond the usual ones.
const PRIOR_FAR_FACTOR: f64 = 0.01;

/// Prior probability that at least one value is off.
const PRIOR_SUSPECT: f64 = 0.15;

/// Prior probability that there is one more, once there is one.
const PRIOR_ANOTHER: f64 = 0.3;

/// Prior probability that neighbouring rows share noise.
const PRIOR_SERIAL: f64 = 0.25;

/// Prior probability that the rows of a setting share an error.
const PRIOR_SHARED: f64 = 0.1;

/// Prior probability that the outputs of a row share noise.
const PRIOR_COMMON: f64 = 0.1;

/// The prior odds of no gap are multiplied by this where the noise is not as stated. A diagnosis is
/// asked for where data depart; noise that is not as stated is a reason for that, after which there
/// is less need of an effect. With the usual priors no gap is then as probable as all else together.
const EXPLAINED_AWAY: f64 = 6.0;

/// Coefficients of correlation that are tried for it, equally probable beforehand.
const SERIAL: [f64; 4] = [0.3, 0.6, 0.8, 0.92];

/// A serial correlation is tried although its evidence at the modes without it is lower by this
/// factor's logarithm: modes move with it.
const MOVED: f64 = 2.0;

/// The sizes of what is wrong with a value that is off, in standard uncertainties, with their prior
/// probabilities: mostly a reading that went wrong a little; a digit or the decimal point that was
/// typed wrong is off by any number of standard uncertainties.
pub(crate) const SUSPECT_SIZES: [(f64, f64); 6] =
    [(1e1, 0.9), (1e2, 0.02), (1e3, 0.02), (1e4, 0.02), (1e5, 0.02), (1e6, 0.02)];

/// A value that still is off by more than this, in standard uncertainties with what is wrong with it
/// included, is off by more than its size says.
pub(crate) const STILL_OFF: f64 = 3.0;

/// Values that are off, at most.
pub(crate) const MOST_SUSPECTS: usize = 5;

/// A value is suspected, or other priors are tried, where that may come to have this posterior
/// probability.
pub(crate) const WORTH_TRYING: f64 = 0.02;

/// A measured value that may be off: a row of the case and an observed output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Suspect {
    /// Its row, by the identity that copies of data share.
    pub id: usize,
    /// The observed output.
    pub output: usize,
    /// Place of the size of what is wrong with it.
    pub(crate) size: usize,
}

impl Suspect {
    /// Whether it is this value.
    pub fn is_of(&self, id: usize, output: usize) -> bool {
        (self.id, self.output) == (id, output)
    }

    /// The size of what is wrong with it, in standard uncertainties, and its prior probability.
    pub(crate) fn size(&self) -> (f64, f64) {
        SUSPECT_SIZES[self.size]
    }
}

/// A noise that the data may have.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NoiseModel {
    /// By which unknown factor stated uncertainties are multiplied, if they are.
    pub(crate) factor: Option<Factor>,
    /// The values that are off.
    pub suspects: Vec<Suspect>,
    /// The coefficient of correlation of the noise of neighbouring rows.
    pub serial: Option<f64>,
    /// The error that the rows of each setting share.
    pub shared: Option<SharedNoise>,
    /// The noise that the outputs of a row share.
    pub common: Option<CommonNoise>,
}

/// An unknown factor on stated uncertainties.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Factor {
    /// As stated uncertainties are off now and then.
    Usual,
    /// As of a unit that was mistaken.
    Far,
}

impl Factor {
    /// Its bounds.
    pub fn limits(self) -> [f64; 2] {
        match self {
            Self::Usual => FACTORS,
            Self::Far => FAR_FACTORS,
        }
    }

    /// What is known beforehand of its logarithm for an output.
    pub(crate) fn role(self, output: usize) -> Role {
        let [lower, upper] = self.limits();
        let map =
            Map::Uniform { lower: elementary::ln(lower), width: elementary::ln(upper / lower) };
        Role::Noise { output, map }
    }

    /// Its prior probability.
    fn prior(self) -> f64 {
        match self {
            Self::Usual => PRIOR_FACTOR,
            Self::Far => PRIOR_FAR_FACTOR,
        }
    }
}

/// A kind of noise that is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DrawnNoise {
    /// As it is stated.
    AsStated,
    /// Stated uncertainties are off by a factor.
    Factor,
    /// Neighbouring rows are correlated by this coefficient.
    Serial(f64),
    /// Single values are off.
    Off,
}

impl NoiseModel {
    /// Stated uncertainties with an unknown factor.
    fn with_factor(factor: Factor) -> Self {
        Self { factor: Some(factor), ..Self::default() }
    }

    /// With these values off.
    pub(crate) fn with_suspects(suspects: Vec<Suspect>) -> Self {
        Self { suspects, ..Self::default() }
    }

    /// With noise that neighbouring rows share in part.
    fn with_serial(coefficient: f64) -> Self {
        Self { serial: Some(coefficient), ..Self::default() }
    }

    /// With an error that the rows of each setting share.
    pub(crate) fn with_shared(noise: SharedNoise) -> Self {
        Self { shared: Some(noise), ..Self::default() }
    }

    /// With noise that the outputs of a row share.
    pub(crate) fn with_common(noise: CommonNoise) -> Self {
        Self { common: Some(noise), ..Self::default() }
    }

    /// What a value's standard uncertainty is multiplied by: a suspect is off by a normal quantity of
    /// its own.
    pub fn stretch(&self, id: usize, output: usize) -> f64 {
        let suspect = self.suspects.iter().find(|suspect| suspect.is_of(id, output));
        suspect.map_or(1.0, |suspect| elementary::hypot(1.0, suspect.size().0))
    }

    /// The prior probabilities of a case's hypotheses with it. Where no uncertainties are stated nobody
    /// has seen that the data depart by more than they should, and the noise is not as stated either.
    pub fn hypotheses(&self, case: &Case) -> Prior {
        let mut observed = case.observed.iter().flatten();
        let is_stated = observed.any(|of| of.standard_uncertainties.is_some());
        if is_stated && *self == Self::default() {
            case.prior
        } else {
            Self::other_than_stated(case.prior)
        }
    }

    /// The prior probabilities of hypotheses with a noise that is not as stated, from those with the
    /// noise as stated.
    pub fn other_than_stated(stated: Prior) -> Prior {
        let total = 1.0 + (EXPLAINED_AWAY - 1.0) * stated.none;
        let Prior { none, one, two, three, unexplained } = stated;
        Prior {
            none: EXPLAINED_AWAY * none / total,
            one: one / total,
            two: two / total,
            three: three / total,
            unexplained: unexplained / total,
        }
    }

    /// The noise at a uniform number between 0 and 1, from the prior probabilities of those that are
    /// weighed with data that state uncertainties or do not.
    pub fn drawn(stated: bool, uniform: f64) -> DrawnNoise {
        let as_stated = Self::default().prior(0);
        let [factor, serial] = if stated { [PRIOR_FACTOR, PRIOR_SERIAL] } else { [0.0; 2] };
        let place = uniform * (as_stated + factor + serial + PRIOR_SUSPECT);
        if place < as_stated {
            DrawnNoise::AsStated
        } else if place < as_stated + factor {
            DrawnNoise::Factor
        } else if place < as_stated + factor + serial {
            let share = (place - as_stated - factor) / serial;
            DrawnNoise::Serial(
                SERIAL[((share * SERIAL.len() as f64) as usize).min(SERIAL.len() - 1)],
            )
        } else {
            DrawnNoise::Off
        }
    }

    /// How many values are off, at most, and the probability that there is one more.
    pub fn suspects() -> (usize, f64) {
        (MOST_SUSPECTS, PRIOR_ANOTHER)
    }

    /// The size of what is wrong with a value that is off, in standard uncertainties, at a uniform
    /// number between 0 and 1.
    pub fn suspect_size(uniform: f64) -> f64 {
        let mut below = 0.0;
        let mut sizes = SUSPECT_SIZES.iter().map(|(size, prior)| {
            below += prior;
            (size, below)
        });
        sizes.find(|(_, below)| uniform < *below).map_or(SUSPECT_SIZES[0].0, |(size, _)| *size)
    }

    /// Its prior probability, for data of so many values.
    pub(crate) fn prior(&self, values: usize) -> f64 {
        if let Some(factor) = self.factor {
            return factor.prior();
        }
        if self.serial.is_some() {
            return PRIOR_SERIAL / SERIAL.len() as f64;
        }
        if let Some(shared) = &self.shared {
            return PRIOR_SHARED * shared.prior();
        }
        if let Some(common) = &self.common {
            return PRIOR_COMMON * common.share;
        }
        let mut prior = match self.suspects.len() {
            0 => return PRIOR_AS_STATED,
            _ => PRIOR_SUSPECT,
        };
        for more in 0..self.suspects.len() {
            // one of the sets of so many values
            prior *= (more + 1) as f64 / values.saturating_sub(more).max(1) as f64;
            prior *= if more == 0 { 1.0 - PRIOR_ANOTHER } else { PRIOR_ANOTHER };
        }
        self.suspects.iter().fold(prior, |prior, suspect| prior * suspect.size().1)
    }
}

/// The hypotheses weighed with one noise model.
#[derive(Debug)]
pub struct Weighing<'c> {
    /// How wide the priors of the effects' parameters are.
    pub widths: PriorWidths,
    /// The case with this noise.
    pub setup: Setup<'c>,
    /// The departures that are weighed beside the effects.
    pub discrepancy: Arc<Discrepancy>,
    /// The hypotheses, weighed.
    pub posterior: Posterior,
    /// Prior probability of the noise model, or of priors of other widths.
    prior: f64,
    /// Its posterior probability.
    pub probability: f64,
}

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
        for noise in shared_noise::worth_trying(&weighings) {
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
        for noise in common_noise::worth_trying(&weighings) {
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

/// The logarithm of prior probabilities times evidences, summed.
pub(crate) fn ln_total(weighings: &[Weighing<'_>]) -> f64 {
    weighings.iter().map(Weighing::ln_weight).fold(f64::NEG_INFINITY, ln_add)
}

/// The same over the prior probability of what is weighed beside it.
fn ln_rivals(known: &[Weighing<'_>], prior: f64) -> f64 {
    ln_total(known) - elementary::ln(prior)
}

impl<'c> Weighing<'c> {
    /// What another weighing learns from this one.
    pub(crate) fn before(&self) -> Before<'_, 'c> {
        (&self.setup, &self.posterior)
    }

    /// Logarithm of the prior probability times the evidence.
    pub fn ln_weight(&self) -> f64 {
        elementary::ln(self.prior) + self.posterior.ln_evidence
    }

    /// Whether the leading hypothesis has a factor on stated uncertainties at the upper end of the usual
    /// ones.
    fn is_beyond_factors(&self) -> bool {
        let leading = self.posterior.leading();
        let Some(mode) = leading.and_then(|of| of.evidence.modes.first()) else { return false };
        self.setup.roles.iter().zip(&mode.scores).any(|(role, score)| match role {
            Role::Noise { output, .. } => {
                self.setup.has_factor(*output) && *score > AT_BOUND * EDGE
            }
            _ => false,
        })
    }
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
        let all = hypotheses.map(|(of, gain)| ln_weight_at_mode(setup, of) + gain);
        let sum = all.filter(|ln| !ln.is_nan()).fold(f64::NEG_INFINITY, ln_add);
        sum + ln_prior + MOVED - total > elementary::ln(WORTH_TRYING)
    };
    let with = |of: &f64| setup.with_noise(NoiseModel::with_serial(*of));
    SERIAL.iter().map(with).filter(is_worth).collect()
}

/// An evidence with a larger standard error is that of draws far from the modes, which may stand at
/// the end of what is searched: what they leave is more than those draws do.
const FAR_DRAWS: f64 = 0.5;

/// The logarithm of the weight of a hypothesis with a noise that is not as stated, without what the
/// residuals at its best mode gain by that.
pub(crate) fn ln_weight_at_mode(setup: &Setup<'_>, hypothesis: &WeighedHypothesis) -> f64 {
    let evidence = &hypothesis.evidence;
    let too_much = match evidence.modes.first() {
        Some(mode) if evidence.standard_error > FAR_DRAWS => {
            (evidence.ln_evidence - mode.ln_evidence()).max(0.0)
        }
        _ => 0.0,
    };
    hypothesis.ln_weight() - too_much + ln_explained_away(setup, hypothesis)
}

/// By how much the logarithm of the prior probability of a hypothesis rises if the noise is another.
fn ln_explained_away(setup: &Setup<'_>, hypothesis: &WeighedHypothesis) -> f64 {
    let other = NoiseModel::other_than_stated(setup.case.prior);
    let (here, there) = (setup.prior(), other);
    let [here, there] = if hypothesis.effects.is_empty() {
        [here.none, there.none]
    } else {
        [here.one + here.two + here.three, there.one + there.two + there.three]
    };
    if here > 0.0 && there > 0.0 { elementary::ln(there / here) } else { 0.0 }
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

/// The coefficient of correlation of two rows, the later one second.
pub(crate) fn lag(coefficient: f64, before: usize, here: usize) -> f64 {
    let gap = here.saturating_sub(before).max(1);
    (1..gap).fold(coefficient, |lag, _| lag * coefficient)
}

/// Posterior probabilities of the noise models.
fn weigh(weighings: &mut [Weighing<'_>]) {
    let total = ln_total(weighings);
    for weighing in weighings.iter_mut() {
        weighing.probability = elementary::exp(weighing.ln_weight() - total);
    }
}

/// The place of the most probable weighing.
pub fn most_probable(weighings: &[Weighing<'_>]) -> usize {
    (0..weighings.len())
        .max_by(|&a, &b| weighings[a].probability.total_cmp(&weighings[b].probability))
        .unwrap_or(0)
}

/// How wide the priors are that are most probable.
pub fn most_probable_widths(weighings: &[Weighing<'_>]) -> PriorWidths {
    weighings[most_probable(weighings)].widths
}
