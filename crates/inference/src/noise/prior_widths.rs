//! Priors of the effects' parameters that are wider or narrower than stated.
//!
//! What is stated of a parameter beforehand is often a habit. A prior that is much too narrow makes an
//! effect that the data show impossible; one that is much too wide makes every size of it improbable,
//! so that a departure of any form, the size of which is counted in units of the noise, wins over the
//! effect that made it (Lindley 1957, Biometrika 44, 187). Priors of other widths are therefore
//! weighed beside the stated ones, with a small probability of their own.

use crate::Case;
use crate::beside;
use crate::logarithm::ln_add;
use crate::noise::noise_model::WORTH_TRYING;
use crate::noise::weighing::{Weighing, ln_total};
use crate::posterior::{self, Effort, Posterior, WeighedHypothesis};
use crate::setup::Setup;
use gumption_engine::distribution::{Distribution, LogUniform, Normal, Rectangular, Truncated};
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};
use gumption_engine::number::{elementary, largest_first};
use gumption_engine::parallel;
use gumption_units::{Turn, Unit};
use std::f64::consts::TAU;

/// By how much priors are widened where they contradict the data, and where they still do: the unit of a
/// size that was mistaken.
pub(crate) const WIDER: f64 = 10.0;
pub(crate) const WIDEST: f64 = 1000.0;

/// By how much priors are narrowed where they may hide an effect.
pub(crate) const NARROWER: f64 = 10.0;

/// Prior probability that the priors of the effects' parameters are too narrow, and that they are too
/// wide.
const PRIOR_WIDER: f64 = 0.05;
const PRIOR_WIDEST: f64 = 0.005;
const PRIOR_NARROWER: f64 = 0.15;

/// The widest priors are tried where what no effect within its prior explains has more than this
/// probability, with wider priors as well; and others with a departure beside an effect where one has.
const WORTH_WIDEST: f64 = 0.5;

/// Pairs with wider priors are tried where what no effect within its prior explains has more than
/// this probability, and of them those with one of the best single effects. Narrower ones are tried
/// where "unexplained" has.
const WORTH_PAIRS: f64 = 0.05;
const MEMBERS: usize = 3;

/// The part of a turn from which on a rectangular prior of an angle is one of all angles.
const WHOLE_TURN: f64 = 0.95;

/// A probability below which a prior has nothing on a side of zero that counts.
const LEAST: f64 = 1e-9;

/// How wide the priors of the effects' parameters are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PriorWidths {
    /// As stated.
    AsStated,
    /// `WIDER` times as wide.
    Wider,
    /// `WIDEST` times as wide.
    Widest,
    /// Sizes a `NARROWER`th as wide.
    Narrower,
}

impl PriorWidths {
    /// The prior probability of these widths; as stated, it is that of the noise.
    pub(crate) fn prior(self) -> f64 {
        match self {
            Self::AsStated => 1.0,
            Self::Wider => PRIOR_WIDER,
            Self::Widest => PRIOR_WIDEST,
            Self::Narrower => PRIOR_NARROWER,
        }
    }

    /// By how much the priors are wider than stated, where they are.
    pub fn widened(self) -> Option<f64> {
        match self {
            Self::Wider => Some(WIDER),
            Self::Widest => Some(WIDEST),
            Self::AsStated | Self::Narrower => None,
        }
    }
}

/// A case with priors of other widths than stated.
#[derive(Clone, Debug)]
pub struct OtherPriors {
    wider: Case,
    widest: Case,
    narrower: Case,
}

impl OtherPriors {
    /// A case with priors of other widths.
    pub fn of(case: &Case) -> Self {
        Self {
            wider: case.with_priors(|prior, unit| widened(prior, unit, WIDER)),
            widest: case.with_priors(|prior, unit| widened(prior, unit, WIDEST)),
            narrower: case.with_priors(|prior, _| narrowed(prior)),
        }
    }
}

/// A setup with its single effects begun, and the pairs to be tried.
pub(crate) type Begun<'c> = (Setup<'c>, Vec<WeighedHypothesis>, Vec<Vec<usize>>);

/// What is to be weighed with priors of other widths; `None` where that would come to nothing.
pub(crate) fn begin<'c>(
    widths: PriorWidths,
    others: &'c OtherPriors,
    weighings: &[Weighing<'_>],
    seed: u64,
    effort: Effort<'_>,
) -> Option<Begun<'c>> {
    match widths {
        PriorWidths::AsStated => None,
        PriorWidths::Wider => wider(&others.wider, weighings, seed, effort),
        PriorWidths::Widest => widest(&others.widest, weighings, seed, effort),
        PriorWidths::Narrower => narrower(&others.narrower, weighings, seed, effort),
    }
}

/// Every effect alone with a wider prior, where one explains the data so much better than anything
/// else that the conflict may be probable; and where nothing explains them that its prior does not
/// hold back, pairs with wider priors.
fn wider<'c>(
    case: &'c Case,
    weighings: &[Weighing<'_>],
    seed: u64,
    effort: Effort<'_>,
) -> Option<Begun<'c>> {
    let (setup, singles, own) = alone(case, weighings, PRIOR_WIDER, seed, effort)?;
    let total = ln_add(own, ln_total(weighings));
    let pairs = if ln_held_back(weighings) - total > elementary::ln(WORTH_PAIRS) {
        let effects = singles.iter().filter(|h| !h.effects.is_empty());
        let mut best: Vec<&WeighedHypothesis> = effects.collect();
        largest_first(&mut best, |a| a.ln_weight());
        best.truncate(MEMBERS);
        let has =
            |pair: &Vec<usize>| best.iter().any(|h| h.effects.iter().all(|e| pair.contains(e)));
        case.pairs().into_iter().filter(has).collect()
    } else {
        Vec::new()
    };
    let is_worth = !pairs.is_empty() || own - ln_total(weighings) > elementary::ln(WORTH_TRYING);
    is_worth.then_some((setup, singles, pairs))
}

/// Every effect alone with the widest priors, where effects within wider ones explain little.
fn widest<'c>(
    case: &'c Case,
    weighings: &[Weighing<'_>],
    seed: u64,
    effort: Effort<'_>,
) -> Option<Begun<'c>> {
    if ln_held_back(weighings) - ln_total(weighings) < elementary::ln(WORTH_WIDEST) {
        return None;
    }
    let (setup, singles, own) = alone(case, weighings, PRIOR_WIDEST, seed, effort)?;
    let is_worth = own - ln_total(weighings) > elementary::ln(WORTH_TRYING);
    is_worth.then_some((setup, singles, Vec::new()))
}

/// No gap and every effect alone with the priors of `case`, which have this prior probability, and the
/// logarithm of that times what the effects come to, summed: their evidences, and where what no effect
/// explains is probable those with a departure beside them as well.
fn alone<'c>(
    case: &'c Case,
    weighings: &[Weighing<'_>],
    prior: f64,
    seed: u64,
    effort: Effort<'_>,
) -> Option<(Setup<'c>, Vec<WeighedHypothesis>, f64)> {
    let first = weighings.first()?;
    let setup = Setup::new(case).sharing(&first.setup);
    let singles = posterior::singles(&setup, seed, effort);
    let departs = ln_sum(weighings, |weighing| weighing.posterior.departs());
    let with_departure = departs - ln_total(weighings) > elementary::ln(WORTH_WIDEST);
    let effects: Vec<&WeighedHypothesis> =
        singles.iter().filter(|h| !h.effects.is_empty()).collect();
    let ln_weights = parallel::map(effects, |h| {
        let beside = with_departure.then(|| beside::ln_near_alone(&setup, &first.discrepancy, h));
        beside.flatten().map_or(h.ln_weight(), |ln| ln_add(ln, h.ln_weight()))
    });
    let own = ln_weights.into_iter().fold(f64::NEG_INFINITY, ln_add);
    Some((setup, singles, own + elementary::ln(prior)))
}

/// The logarithm of prior probabilities times evidences of what no effect within its prior explains:
/// hypotheses with a parameter that its prior holds back, and "unexplained".
fn ln_held_back(weighings: &[Weighing<'_>]) -> f64 {
    ln_sum(weighings, |Weighing { setup, posterior, .. }| {
        let held = posterior.hypotheses.iter().filter(|h| h.is_held_back(setup));
        posterior.departs() + held.map(|h| h.probability).sum::<f64>()
    })
}

/// The logarithm of prior probabilities times evidences of a share of each weighing.
fn ln_sum(weighings: &[Weighing<'_>], share: impl Fn(&Weighing<'_>) -> f64) -> f64 {
    let of = |w: &Weighing<'_>| w.ln_weight() + elementary::ln(share(w).max(f64::MIN_POSITIVE));
    weighings.iter().map(of).fold(f64::NEG_INFINITY, ln_add)
}

/// Every effect alone with narrower priors, and those pairs that may become probable with them, where
/// "unexplained" is probable.
///
/// A prior that is narrowed by a factor is nowhere denser than so many times the stated one, so that
/// the evidence of a hypothesis rises by that factor at most for each prior that is narrowed. What
/// would be improbable even then is left out.
fn narrower<'c>(
    case: &'c Case,
    weighings: &[Weighing<'_>],
    seed: u64,
    effort: Effort<'_>,
) -> Option<Begun<'c>> {
    let first = weighings.first()?;
    let total = ln_total(weighings);
    let unexplained = ln_sum(weighings, |weighing| weighing.posterior.departs());
    if unexplained - total < elementary::ln(WORTH_PAIRS) {
        return None;
    }
    let stated = &first.setup.case.candidates;
    let narrowed = |effect: usize| -> usize {
        let priors = stated[effect].priors.iter().zip(&case.candidates[effect].priors);
        priors.filter(|(stated, narrowed)| stated != narrowed).count()
    };
    let reach = |hypothesis: &WeighedHypothesis| -> f64 {
        let count: usize = hypothesis.effects.iter().map(|&effect| narrowed(effect)).sum();
        hypothesis.ln_weight()
            + count as f64 * elementary::ln(NARROWER)
            + elementary::ln(PRIOR_NARROWER)
    };
    let worth = elementary::ln(WORTH_TRYING) + total;
    let effects = first.posterior.hypotheses.iter().filter(|h| !h.effects.is_empty());
    let reached = effects.clone().map(reach).fold(f64::NEG_INFINITY, ln_add);
    if reached < worth {
        return None;
    }
    let share = elementary::ln(first.posterior.hypotheses.len() as f64);
    let pairs = effects.filter(|h| h.effects.len() == 2 && reach(h) > worth - share);
    let pairs = pairs.map(|h| h.effects.clone()).collect();
    let setup = Setup::new(case).sharing(&first.setup);
    let singles = posterior::singles(&setup, seed, effort);
    Some((setup, singles, pairs))
}

/// The sets of effects that stated priors, of whatever noise, make less probable than "unexplained"
/// and narrower ones do not.
pub fn hidden(weighings: &[Weighing<'_>]) -> Vec<Vec<usize>> {
    let is_narrower = |w: &&Weighing<'_>| w.widths == PriorWidths::Narrower;
    let Some(narrower) = weighings.iter().find(is_narrower) else { return Vec::new() };
    let of_stated = |share: &dyn Fn(&Posterior) -> f64| -> f64 {
        let stated = weighings.iter().filter(|w| !is_narrower(w));
        stated.map(|w| w.probability * share(&w.posterior)).sum()
    };
    let unexplained = of_stated(&Posterior::departs);
    let hypotheses = narrower.posterior.hypotheses.iter();
    hypotheses
        .filter(|h| !h.effects.is_empty() && h.probability > narrower.posterior.departs())
        .filter(|h| {
            of_stated(&|posterior| posterior.of(&h.effects).map_or(0.0, |h| h.probability))
                < unexplained
        })
        .map(|h| h.effects.clone())
        .collect()
}

/// What is to be said where these effects are named for their narrower priors.
pub fn note(effects: &[String]) -> Option<Fact> {
    let times = NARROWER;
    let (effect, others) = effects.split_first()?;
    if others.is_empty() {
        return Some(fact!("wide-priors", effect, times));
    }
    let together = |first: Argument, second: &String| fact!("effect-with", first, second).into();
    let effects = others.iter().fold(Argument::from(effect), together);
    Some(fact!("wide-priors.several", effects, times))
}

/// Whether a prior has all angles there are, so that no other is beyond it, and 0 is one like any other.
pub fn is_whole_turn(prior: &Distribution, unit: &Unit) -> bool {
    let range = unit.factor() * 2.0 * half_width(prior);
    unit.turn() == Some(Turn::Angle)
        && matches!(prior, Distribution::Rectangular(_))
        && range > WHOLE_TURN * TAU
}

/// A prior that is so many times as wide, in what it does not state of itself: a normal one in place of
/// any other shape, on one side of zero where that has no other; one of all angles stays.
fn widened(prior: &Distribution, unit: &Unit, times: f64) -> Distribution {
    if prior.constant().is_some() || is_whole_turn(prior, unit) {
        return prior.clone();
    }
    let normal = || Normal::new(prior.mean(), times * prior.standard_uncertainty());
    let wide = match prior {
        Distribution::Normal(_) => normal().map(Into::into),
        Distribution::Rectangular(_) => {
            Rectangular::new(prior.mean(), times * half_width(prior)).map(Into::into)
        }
        Distribution::LogUniform(_) => {
            let ends = [prior.quantile(0.25), prior.quantile(0.75)];
            let ratio = ends[1] / ends[0];
            let [low, high] = [ends[0] / ratio.sqrt(), ends[1] * ratio.sqrt()];
            LogUniform::new(low / times, high * times).map(Into::into)
        }
        _ if !prior.has_quantiles() => return prior.clone(),
        _ => {
            let limits = match [prior.quantile(LEAST), prior.quantile_upper(LEAST)] {
                [low, _] if low >= 0.0 => [0.0, f64::INFINITY],
                [_, high] if high <= 0.0 => [f64::NEG_INFINITY, 0.0],
                _ => [f64::NEG_INFINITY, f64::INFINITY],
            };
            normal().map(Into::into).and_then(|wide: Distribution| {
                let [low, high] = limits;
                if limits.iter().all(|limit| limit.is_infinite()) {
                    return Ok(wide);
                }
                Truncated::cut(wide, low, high)
            })
        }
    };
    // what is not finite once it is wider stays as it is
    wide.unwrap_or_else(|_| prior.clone())
}

/// A prior of a size that is a [`NARROWER`]th as wide. Bounds that do not lie about zero are those of
/// a position, a period or the like and stay, as does a size of unknown order of magnitude.
fn narrowed(prior: &Distribution) -> Distribution {
    let narrow = match prior {
        Distribution::Normal(_) => {
            Normal::new(prior.mean(), prior.standard_uncertainty() / NARROWER).map(Into::into)
        }
        Distribution::Rectangular(_) if prior.mean() == 0.0 => {
            Rectangular::new(0.0, half_width(prior) / NARROWER).map(Into::into)
        }
        _ => return prior.clone(),
    };
    // what is nothing once it is narrower stays as it is
    narrow.unwrap_or_else(|_| prior.clone())
}

/// Half the width of a rectangular prior: its quartiles are that far apart.
fn half_width(prior: &Distribution) -> f64 {
    prior.quantile(0.75) - prior.quantile(0.25)
}
