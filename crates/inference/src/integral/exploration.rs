//! The search for the modes of all hypotheses, which tell each other what they found.
//!
//! An evidence misses what lies in a mode that nobody found, and nothing in its own draws tells. What
//! tells is the other hypotheses: the modes of a pair hold points of its members, and those of the
//! members points of the pair. They are therefore tried on each other until nothing new turns up; and
//! the integrals that decide the answer are made a second time with other random numbers.

use gumption_engine::number::largest_first;
use gumption_engine::parallel;

use crate::integral::evidence::{DISAGREE, EvidenceEstimate};
use crate::integral::response_scan;
use crate::integral::search::Mode;
use crate::latent::converted_point;
use crate::likelihood::Likelihood;
use crate::posterior::{Before, Effort, HOPELESS, MANY_VALUES, WeighedHypothesis};
use crate::setup::Setup;
use gumption_engine::distribution::StreamKey;

/// Values of the part of much data in which modes are searched first.
const PART: usize = 2000;

/// Modes of a hypothesis that others start from.
const HANDED_ON: usize = 2;

/// The members of a pair are looked for beside each of so many single effects, the best.
const BESIDE: usize = 3;

/// Rounds in which hypotheses tell each other of their modes.
const ROUNDS: usize = 4;

/// A second integral is refined this often at most, until it is known as well as the first.
const REFINED: usize = 8;

/// The effective draws that a second integral is to have.
const EFFECTIVE: f64 = 300.0;

pub(crate) struct Exploration<'s, 'c> {
    setup: &'s Setup<'c>,
    part: Option<Setup<'c>>,
    seed: u64,
    effort: Effort<'s>,
}

impl<'s, 'c> Exploration<'s, 'c> {
    pub(crate) fn new(setup: &'s Setup<'c>, seed: u64, effort: Effort<'s>) -> Self {
        let part = (setup.data.len() > MANY_VALUES).then(|| setup.thinned(PART));
        Self { setup, part, seed, effort }
    }

    /// A hypothesis with a first estimate of its evidence; `known` are those with fewer effects.
    /// Where its modes are known with another noise, it is explored only if these are not hopeless
    /// beside what `leads`, the logarithm of a prior times an evidence. `None` once nothing new is to
    /// be begun.
    pub(crate) fn begin(
        &self,
        effects: Vec<usize>,
        known: &[WeighedHypothesis],
        before: Option<Before<'_, '_>>,
        leads: f64,
    ) -> Option<WeighedHypothesis> {
        if self.effort.is_stopped() {
            return None;
        }
        let again = before.and_then(|before| self.again(&effects, before));
        let hopeless = again.filter(|again| again.ln_weight() < leads - HOPELESS);
        Some(hopeless.unwrap_or_else(|| self.begun(effects, known)))
    }

    /// A hypothesis as its best modes with another noise have it; `None` where there are none.
    pub(crate) fn again(
        &self,
        effects: &[usize],
        (setup, posterior): Before<'_, '_>,
    ) -> Option<WeighedHypothesis> {
        if self.part.is_some() {
            return None;
        }
        let likelihood = self.setup.likelihood(effects);
        let from = setup.likelihood(effects).roles;
        let modes = &posterior.of(effects)?.evidence.modes;
        let starts: Vec<Vec<f64>> = modes
            .iter()
            .take(HANDED_ON)
            .filter_map(|mode| converted_point(&mode.scores, &from, &likelihood.roles))
            .map(|point| match &self.setup.data.noise.shared {
                Some(shared) => shared.with_noise_within(point, &likelihood.roles),
                None => point,
            })
            .collect();
        if starts.is_empty() {
            return None;
        }
        let evidence = EvidenceEstimate::begin(&likelihood, self.key(effects, ""), &starts, 0);
        Some(self.with_evidence(effects.to_vec(), evidence))
    }

    fn begun(&self, effects: Vec<usize>, known: &[WeighedHypothesis]) -> WeighedHypothesis {
        let starts = seeds(self.setup, &effects, known);
        let evidence = self.integral(&effects, known, starts, "");
        self.with_evidence(effects, evidence)
    }

    fn with_evidence(&self, effects: Vec<usize>, evidence: EvidenceEstimate) -> WeighedHypothesis {
        let prior = self.setup.prior();
        let count = self.setup.case.candidates.len();
        let share = |done: f64, count: usize| if count == 0 { 0.0 } else { done / count as f64 };
        let prior = match effects.len() {
            0 => prior.none,
            1 => share(prior.one, count),
            2 => share(prior.two, self.setup.case.pairs().len()),
            _ => share(prior.three, count * count.saturating_sub(1) * count.saturating_sub(2) / 6),
        };
        WeighedHypothesis { effects, prior, evidence, probability: 0.0 }
    }

    /// No gap and every effect alone.
    pub(crate) fn singles(
        &self,
        before: Option<Before<'_, '_>>,
        rivals: f64,
    ) -> Vec<WeighedHypothesis> {
        let none = self.begun(Vec::new(), &[]);
        let leads = rivals.max(none.ln_weight());
        let known = std::slice::from_ref(&none);
        let count = self.setup.case.candidates.len();
        let single = |one| self.begin(vec![one], known, before, leads);
        let singles = parallel::map(0..count, single).into_iter().flatten();
        std::iter::once(none).chain(singles).collect()
    }

    fn key(&self, effects: &[usize], run: &str) -> StreamKey {
        let candidates = &self.setup.case.candidates;
        let name: Vec<&str> = effects.iter().map(|&e| candidates[e].effect.name.as_str()).collect();
        StreamKey::new(self.seed, &format!("gap/{}{run}", name.join("+")))
    }

    fn integral(
        &self,
        effects: &[usize],
        known: &[WeighedHypothesis],
        mut starts: Vec<Vec<f64>>,
        run: &str,
    ) -> EvidenceEstimate {
        let key = self.key(effects, run);
        if let Some(part) = &self.part {
            let likelihood = part.likelihood(effects);
            starts.extend(scanned(part, &likelihood, effects, known));
            let found = EvidenceEstimate::begin(&likelihood, key, &starts, 16);
            starts = found.modes.into_iter().take(3).map(|mode| mode.scores).collect();
        }
        let likelihood = self.setup.likelihood(effects);
        if self.part.is_none() {
            starts.extend(scanned(self.setup, &likelihood, effects, known));
        }
        EvidenceEstimate::begin(&likelihood, key, &starts, self.effort.starts)
    }

    /// Tries the modes of pairs on their members, and what that gives on the pairs, until nothing new
    /// is found. Of pairs for which the logarithm of prior times evidence is below `least` nothing is
    /// learnt.
    pub(crate) fn reconcile(&self, hypotheses: &mut [WeighedHypothesis], least: f64) {
        let pairs = hypotheses.partition_point(|h| h.effects.len() < 2);
        for _ in 0..ROUNDS {
            let (fewer, pairs) = hypotheses.split_at_mut(pairs);
            let tells = |pair: &WeighedHypothesis| pair.ln_weight() >= least;
            let singles = fewer.iter_mut().filter(|single| single.effects.len() == 1);
            let gained = parallel::map(singles, |single| {
                let starts = self.projected(&single.effects, pairs.iter().filter(|p| tells(p)));
                let likelihood = self.setup.likelihood(&single.effects);
                let new = single.evidence.explore(&likelihood, &starts);
                new.then(|| single.effects.clone())
            });
            let gained: Vec<Vec<usize>> = gained.into_iter().flatten().collect();
            if gained.is_empty() {
                return;
            }
            let fewer = &*fewer;
            let has = |pair: &WeighedHypothesis| {
                tells(pair) && gained.iter().flatten().any(|effect| pair.effects.contains(effect))
            };
            parallel::map(pairs.iter_mut().filter(|pair| has(pair)), |pair| {
                let starts = seeds(self.setup, &pair.effects, fewer);
                let likelihood = self.setup.likelihood(&pair.effects);
                pair.evidence.explore(&likelihood, &starts);
            });
        }
    }

    /// The modes of the pairs of which these effects are a part, without the others.
    fn projected<'h>(
        &self,
        effects: &[usize],
        pairs: impl Iterator<Item = &'h WeighedHypothesis>,
    ) -> Vec<Vec<f64>> {
        let shared = self.setup.roles.len();
        let holds = |pair: &&WeighedHypothesis| effects.iter().all(|e| pair.effects.contains(e));
        let of = |pair: &WeighedHypothesis, mode: &Mode| {
            let mut scores = mode.scores[..shared].to_vec();
            for &effect in effects {
                scores.extend(&mode.scores[self.setup.parameters(&pair.effects, effect)]);
            }
            scores
        };
        pairs
            .filter(holds)
            .flat_map(|pair| {
                pair.evidence.modes.iter().take(HANDED_ON).map(move |mode| of(pair, mode))
            })
            .collect()
    }

    /// Makes the integral of a hypothesis a second time from other random numbers. What either found
    /// is tried on the other; where they still differ, that difference is the standard error.
    pub(crate) fn replicate(
        &self,
        hypothesis: &mut WeighedHypothesis,
        known: &[WeighedHypothesis],
    ) {
        if self.part.is_some() {
            return;
        }
        let likelihood = self.setup.likelihood(&hypothesis.effects);
        let own = &mut hypothesis.evidence;
        let mut second = self.integral(&hypothesis.effects, known, Vec::new(), "/second");
        let scores = |evidence: &EvidenceEstimate| -> Vec<Vec<f64>> {
            evidence.modes.iter().map(|mode| mode.scores.clone()).collect()
        };
        let new = own.explore(&likelihood, &scores(&second));
        second.explore(&likelihood, &scores(own));
        for round in 0..2 * REFINED {
            let apart = (own.ln_evidence - second.ln_evidence).abs();
            let well_known = second.effective_sample_size > EFFECTIVE || round >= REFINED;
            if well_known && apart < DISAGREE {
                break;
            }
            second.refine(&likelihood, 4);
            if new || apart > DISAGREE {
                own.refine(&likelihood, 4);
            }
        }
        own.disagrees_by((own.ln_evidence - second.ln_evidence).abs());
    }
}

/// Starts from scans over the parameters of the effects: of a single one with nothing else acting, of
/// a pair's members beside each other where the other is among the best alone.
fn scanned(
    setup: &Setup<'_>,
    likelihood: &Likelihood<'_>,
    effects: &[usize],
    known: &[WeighedHypothesis],
) -> Vec<Vec<f64>> {
    let shared = setup.roles.len();
    let unknowns = likelihood.unknowns();
    let base = |hypothesis: Option<&WeighedHypothesis>| {
        let mut base = vec![0.0; unknowns];
        if let Some(mode) = hypothesis.and_then(|hypothesis| hypothesis.evidence.modes.first()) {
            base[..shared].copy_from_slice(&mode.scores[..shared]);
        }
        base
    };
    if let [effect] = effects {
        let none = known.iter().find(|h| h.effects.is_empty());
        let range = setup.parameters(effects, *effect);
        return response_scan::starts(likelihood, &base(none), range);
    }
    let mut singles: Vec<&WeighedHypothesis> =
        known.iter().filter(|h| h.effects.len() == 1).collect();
    largest_first(&mut singles, |a| a.evidence.ln_evidence);
    let mut starts = Vec::new();
    for single in singles.into_iter().take(BESIDE) {
        let [own] = single.effects[..] else { continue };
        let Some(mode) = single.evidence.modes.first() else { continue };
        if !effects.contains(&own) {
            continue;
        }
        let mut base = base(Some(single));
        base[setup.parameters(effects, own)].copy_from_slice(&mode.scores[shared..]);
        for &other in effects.iter().filter(|&&other| other != own) {
            let range = setup.parameters(effects, other);
            starts.extend(response_scan::starts(likelihood, &base, range));
        }
    }
    starts
}

/// Starts for a pair: the modes of its parts beside each other.
fn seeds(setup: &Setup<'_>, effects: &[usize], singles: &[WeighedHypothesis]) -> Vec<Vec<f64>> {
    let shared = setup.roles.len();
    let unknowns =
        shared + effects.iter().map(|&e| setup.case.candidates[e].priors.len()).sum::<usize>();
    let of = |effect: usize| {
        singles
            .iter()
            .find(|single| single.effects == [effect])
            .map(|single| &single.evidence.modes)
    };
    let mut seeds = Vec::new();
    for &one in effects {
        for mode in of(one).into_iter().flatten().take(HANDED_ON) {
            let mut seed = vec![0.0; unknowns];
            seed[..shared].copy_from_slice(&mode.scores[..shared]);
            let own = setup.parameters(effects, one);
            seed[own].copy_from_slice(&mode.scores[shared..]);
            for &other in effects.iter().filter(|other| **other != one) {
                let places = setup.parameters(effects, other);
                for mode in of(other).into_iter().flatten().take(HANDED_ON) {
                    let mut both = seed.clone();
                    both[places.clone()].copy_from_slice(&mode.scores[shared..]);
                    seeds.push(both);
                }
            }
            seeds.push(seed);
        }
    }
    seeds
}
