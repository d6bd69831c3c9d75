//! Effects of the list with a departure beside them that none of the list makes.
//!
//! Nobody's list is complete: an effect that makes nearly all of a gap leaves residuals that a departure
//! of another cause fills. Such a hypothesis has the effects' parameters and the departure at once, so
//! that their size is found with the departure there, and not taken from a fit without it.
//!
//! Its evidence is a sum over the forms and amplitudes of the departure. Beside the heaviest of them,
//! which makes the covariance of the residuals larger and nothing else, it is an integral as for every
//! other hypothesis. All others have what they are more or less probable than that one in closed form,
//! with the effects linear in their parameters about their mode beside the heaviest.

use std::borrow::Cow;
use std::sync::Arc;

use gumption_engine::distribution::StreamKey;
use gumption_engine::number::{elementary, largest_first};
use gumption_engine::parallel;
use gumption_engine::special;

use super::discrepancy::{Base, Discrepancy, Unexplained, Weighted, amplitude_steps};
use super::latent::converted_point;
use super::posterior::{Before, Effort, HOPELESS, Posterior, WeighedHypothesis, ln_weight};
use super::setup::Setup;
use crate::integral::evidence::EvidenceEstimate;
use crate::integral::search::{self, Mode};
use crate::{Case, Prior};

/// Share of the prior of a departure in which effects of the list act as well. Nobody's list is complete:
/// what is not on it is as often there with effects of the list as without them.
const BESIDE_EFFECTS: f64 = 0.5;

/// What part of that share single effects have, all of them equally probable; pairs have the rest.
const OF_SINGLES: f64 = 0.5;

/// Hypotheses that are tried with a departure beside them, at most.
const MOST: usize = 4;

/// A hypothesis is tried with a departure beside it if its most probable point leaves residuals as
/// large as these with less than this probability.
const DOUBTFUL: f64 = 0.02;

/// Where the noise is estimated, and no residuals are too large, a hypothesis is tried that has more than
/// this probability.
const PROBABLE: f64 = 1e-3;

/// How often the mode of the effects and the heaviest form of the departure are looked for in turn.
const ROUNDS: usize = 4;

/// Amplitudes of one form that differ by less than this factor have the same mode of the effects.
const ALIKE: f64 = 1.25;

/// Modes that the next search begins from.
const HANDED_ON: usize = 3;

/// Refinements of an integral at most.
const REFINED: usize = 8;

/// The prior probability of a departure without effects of a case, where `all` are those of all hypotheses.
pub(crate) fn prior_alone(case: &Case, all: &Prior) -> f64 {
    let can_act = !case.candidates.is_empty() && all.one + all.two > 0.0;
    all.unexplained * if can_act { 1.0 - BESIDE_EFFECTS } else { 1.0 }
}

/// The prior probability of these effects with a departure beside them. More than two effects have none.
pub(crate) fn prior(case: &Case, all: &Prior, effects: &[usize]) -> f64 {
    let pairs = if all.two > 0.0 { case.pairs().len() } else { 0 };
    let of_singles = match (all.one > 0.0, pairs > 0) {
        (true, true) => OF_SINGLES,
        (true, false) => 1.0,
        (false, _) => 0.0,
    };
    let (share, count) = match effects.len() {
        1 => (of_singles, case.candidates.len()),
        2 => (1.0 - of_singles, pairs),
        _ => return 0.0,
    };
    let beside_effects = all.unexplained - prior_alone(case, all);
    if count > 0 { beside_effects * share / count as f64 } else { 0.0 }
}

/// The logarithm of prior times evidence of effects with a departure beside them and their parameters near
/// those without it; `None` where they leave no more than the noise.
pub(crate) fn ln_near_alone(
    setup: &Setup<'_>,
    discrepancy: &Discrepancy,
    hypothesis: &WeighedHypothesis,
) -> Option<f64> {
    let base = Arc::new(doubtful(setup, hypothesis)?);
    let found = discrepancy.evidence_beside(setup, &base, f64::NEG_INFINITY);
    Some(ln_weight(prior(setup.case, &setup.prior(), &hypothesis.effects), found.ln_evidence))
}

/// Effects with a departure beside them.
#[derive(Clone, Debug)]
pub struct Beside {
    /// The effects, with draws of their parameters; the evidence is that with all departures.
    pub named: WeighedHypothesis,
    /// The departures, beside the effects.
    pub departure: Unexplained,
}

impl Beside {
    /// Effects with a departure beside them; `starts` are points to look for their modes from. What lies far
    /// below `floor`, a logarithm of evidence, need not be known well.
    pub fn fitted(
        setup: &Setup<'_>,
        discrepancy: &Discrepancy,
        effects: &[usize],
        starts: &[Mode],
        key: StreamKey,
        effort: Effort<'_>,
        floor: f64,
    ) -> Option<Self> {
        let starts = &starts[..starts.len().min(HANDED_ON)];
        let mut base = Arc::new(Base::at(setup, effects, starts.first()?)?);
        let mut departure = discrepancy.evidence_beside(setup, &base, floor);
        let mut points: Vec<Vec<f64>> = starts.iter().map(|mode| mode.scores.clone()).collect();
        let mut last: Option<(Weighted, EvidenceEstimate)> = None;
        for _ in 0..ROUNDS {
            let heaviest = departure.kinds.first()?;
            let is_like = |before: &Weighted| {
                let ratio = heaviest.multiplier / before.multiplier;
                heaviest.form == before.form && ratio < ALIKE && ratio * ALIKE > 1.0
            };
            if last.as_ref().is_some_and(|(before, _)| is_like(before)) {
                break;
            }
            let with = setup.with_functions(&discrepancy.columns(setup, heaviest));
            let starts = if last.is_none() { effort.starts } else { 0 };
            let found = EvidenceEstimate::begin(&with.likelihood(effects), key, &points, starts);
            let mode = found.modes.first()?;
            points = found.modes.iter().take(HANDED_ON).map(|mode| mode.scores.clone()).collect();
            base = Arc::new(Base::at(setup, effects, mode)?);
            let heaviest = heaviest.clone();
            departure = discrepancy.evidence_beside(setup, &base, floor);
            last = Some((heaviest, found));
        }
        let (heaviest, mut evidence) = last?;
        let with = setup.with_functions(&discrepancy.columns(setup, &heaviest));
        let likelihood = with.likelihood(effects);
        for _ in 0..REFINED {
            if departure.ln_evidence < floor - HOPELESS
                || evidence.effective_sample_size > effort.effective_sample_size
                || effort.is_stopped()
            {
                break;
            }
            evidence.refine(&likelihood, 4);
        }
        // the exact integral beside the heaviest form, over that with effects linear in their parameters;
        // where the noise is estimated the departure's size follows it, and is not the same in both
        let is_it =
            |kind: &&Weighted| (kind.form, kind.multiplier) == (heaviest.form, heaviest.multiplier);
        let own = departure.kinds.iter().find(is_it);
        if let Some(own) = own.filter(|_| !setup.linear.fitted) {
            let ln_form = discrepancy.forms[own.form].ln_weight;
            let ln_step = -elementary::ln(amplitude_steps(false) as f64);
            let linear = departure.ln_evidence + elementary::ln(own.weight) - ln_form - ln_step;
            departure.ln_evidence += evidence.ln_evidence - linear;
        }
        evidence.ln_evidence = departure.ln_evidence;
        let named =
            WeighedHypothesis { effects: effects.to_vec(), prior: 0.0, evidence, probability: 0.0 };
        Some(Self { named, departure })
    }
}

/// The modes that effects have beside a departure with another noise, as points here; `None` where they
/// were not tried so.
fn modes_before(
    setup: &Setup<'_>,
    effects: &[usize],
    (other, before): Before<'_, '_>,
) -> Option<Vec<Mode>> {
    let evidence = &before.beside(effects)?.named.evidence;
    let (likelihood, from) = (setup.likelihood(effects), other.likelihood(effects).roles);
    let modes = evidence.modes.iter().take(HANDED_ON);
    let points: Vec<Vec<f64>> =
        modes.filter_map(|mode| converted_point(&mode.scores, &from, &likelihood.roles)).collect();
    (!points.is_empty()).then(|| search::at_points(&likelihood, &points))
}

/// A hypothesis at its best mode, if it leaves more there than the noise, which is known; `None` where it has
/// none.
fn doubtful(setup: &Setup<'_>, hypothesis: &WeighedHypothesis) -> Option<Base> {
    let base = Base::at(setup, &hypothesis.effects, hypothesis.evidence.modes.first()?)?;
    let left = setup.linear.whiten_blocks(&base.left(setup));
    let (chi2, dof) = (setup.linear.square(&left), left.len() as f64);
    let ln_p = special::gamma::ln_sf(0.5 * chi2, 0.5 * dof);
    (ln_p <= elementary::ln(DOUBTFUL)).then_some(base)
}

impl Posterior {
    /// The hypotheses that are tried with a departure beside them, best first: those that leave more
    /// than the noise, in the order of what they explain with one. Those are left out that with their
    /// parameters near those without a departure have a prior times evidence below `least`, as a
    /// logarithm.
    fn to_be_tried(
        &self,
        setup: &Setup<'_>,
        discrepancy: &Discrepancy,
        before: Option<Before<'_, '_>>,
        least: f64,
    ) -> Vec<&WeighedHypothesis> {
        let all = setup.prior();
        let has_prior =
            |h: &&WeighedHypothesis| h.prior > 0.0 && prior(setup.case, &all, &h.effects) > 0.0;
        let named = self.hypotheses.iter().filter(has_prior);
        if setup.linear.fitted {
            // as with the noise as it is stated; without that those that explain most alone
            let known = before.map_or(&[][..], |(_, before)| &before.beside);
            let share = self.share();
            let place = |h: &&WeighedHypothesis| {
                known.iter().position(|beside| beside.named.effects == h.effects)
            };
            let mut tried: Vec<&WeighedHypothesis> =
                named.filter(|h| place(h).is_some() || h.probability * share > PROBABLE).collect();
            largest_first(&mut tried, |h| h.ln_weight());
            tried.sort_by_key(|h| place(h).unwrap_or(usize::MAX));
            return tried;
        }
        // what fits and leads lacks nothing
        let unexplained = ln_weight(self.prior, self.unexplained.ln_evidence);
        let leads = self.leading().filter(|h| h.ln_weight() >= unexplained);
        if leads.is_some_and(|h| doubtful(setup, h).is_none()) {
            return Vec::new();
        }
        let mut named: Vec<&WeighedHypothesis> = named.collect();
        // of much data the forms are factored anew for every hypothesis
        if !discrepancy.is_kept() {
            largest_first(&mut named, |h| h.ln_weight());
            named.truncate(MOST);
        }
        let ranks = parallel::map(&named, |h| ln_near_alone(setup, discrepancy, h));
        let mut ranked: Vec<(f64, &WeighedHypothesis)> =
            ranks.into_iter().zip(named).filter_map(|(rank, h)| Some((rank?, h))).collect();
        ranked.retain(|(rank, _)| *rank > least);
        largest_first(&mut ranked, |(rank, _)| *rank);
        ranked.into_iter().map(|(_, h)| h).collect()
    }

    /// Weighs the best of the named hypotheses with a departure beside them, where they fit badly by
    /// themselves. Without it the least bad name would win, however badly it fits, or none at all.
    pub(crate) fn weigh_beside(
        &mut self,
        setup: &Setup<'_>,
        discrepancy: &Discrepancy,
        before: Option<Before<'_, '_>>,
        seed: u64,
        effort: Effort<'_>,
    ) {
        let all = setup.prior();
        let prior = |effects: &[usize]| prior(setup.case, &all, effects);
        if all.unexplained == 0.0 {
            return;
        }
        let leads = self.ln_leading();
        let mut tried = self.to_be_tried(setup, discrepancy, before, leads - 2.0 * HOPELESS);
        tried.truncate(MOST);
        let fitted = parallel::map(tried, |hypothesis| {
            let names = setup.effect_names(&hypothesis.effects).join("+");
            let key = StreamKey::new(seed, &format!("gap/{names}/beside"));
            let known = before.and_then(|before| modes_before(setup, &hypothesis.effects, before));
            let starts = if known.is_some() { 0 } else { effort.starts };
            let modes = known.unwrap_or_else(|| hypothesis.evidence.modes.clone());
            let floor = leads - elementary::ln(prior(&hypothesis.effects));
            let effort = Effort { starts, ..effort };
            Beside::fitted(setup, discrepancy, &hypothesis.effects, &modes, key, effort, floor)
        });
        self.beside = fitted.into_iter().flatten().collect();
        self.beside.iter_mut().for_each(|beside| beside.named.prior = prior(&beside.named.effects));
        self.beside.retain(|beside| beside.named.ln_weight() > leads - HOPELESS);
    }

    /// The probability of a departure that none of the list makes, beside effects of the list or not.
    pub fn departs(&self) -> f64 {
        let beside = self.beside.iter().map(|beside| beside.named.probability);
        // sums to one but for the bits
        (self.probability + beside.sum::<f64>()).min(1.0)
    }

    /// All departures together, beside effects of the list or not, with their evidence as a share of the
    /// prior of all of them.
    pub fn departures(&self) -> Unexplained {
        let share = |prior: f64| prior / self.departure_prior;
        let beside =
            self.beside.iter().map(|beside| (share(beside.named.prior), &beside.departure));
        let all = std::iter::once((share(self.prior), &self.unexplained)).chain(beside);
        Unexplained::joined(all.map(|(share, departure)| (elementary::ln(share), departure)))
    }

    /// The departures of all of them by their probabilities, heaviest first. Those that are probable with
    /// another noise only are left out.
    pub fn kinds(&self) -> Vec<Weighted> {
        let beside = self.beside.iter().map(|beside| (beside.named.probability, &beside.departure));
        let all = std::iter::once((self.probability, &self.unexplained)).chain(beside);
        let weigh = |(share, departure): (f64, &Unexplained)| {
            let weigh =
                move |kind: &Weighted| Weighted { weight: share * kind.weight, ..kind.clone() };
            departure.kinds.iter().map(weigh).collect::<Vec<_>>()
        };
        let mut kinds: Vec<Weighted> = all.flat_map(weigh).collect();
        largest_first(&mut kinds, |kind| kind.weight);
        kinds
    }

    /// A hypothesis whether a departure acts beside its effects or not: with the probabilities of both and
    /// their draws, and with the modes and the evidence of the more probable one.
    pub fn together<'p>(&'p self, alone: &'p WeighedHypothesis) -> Cow<'p, WeighedHypothesis> {
        let Some(Beside { named, .. }) = self.beside(&alone.effects) else {
            return Cow::Borrowed(alone);
        };
        let (more, less) =
            if named.probability > alone.probability { (named, alone) } else { (alone, named) };
        let probability = more.probability + less.probability;
        let mut evidence = more.evidence.clone();
        if less.probability > 0.0 {
            let share = less.probability / probability;
            evidence.scale_weights(1.0 - share);
            evidence.append(share, less.evidence.columns.clone(), &less.evidence.weights);
        }
        let (effects, prior) = (alone.effects.clone(), more.prior + less.prior);
        Cow::Owned(WeighedHypothesis { effects, prior, evidence, probability })
    }

    /// The probability of these effects with a departure beside them.
    pub fn probability_beside(&self, effects: &[usize]) -> f64 {
        self.beside(effects).map_or(0.0, |beside| beside.named.probability)
    }

    /// These effects with a departure beside them, if that was tried.
    pub fn beside(&self, effects: &[usize]) -> Option<&Beside> {
        self.beside.iter().find(|beside| beside.named.effects == effects)
    }
}
