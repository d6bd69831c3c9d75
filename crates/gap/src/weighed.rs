//! The hypotheses of a case weighed against its data: the most probable one, and those that the data
//! cannot tell from it.

use std::borrow::Cow;
use std::sync::Arc;

use super::composed::{self, ComposedEffect, Compositions};
use super::departure;
use super::diagnosis::{
    DepartureForm, GapPart, GapShare, HypothesisKind, LeftBeside, MostProbable, PriorConflict,
    UnlistedEffect,
};
use super::prior_conflict;
use super::shares::shares;
use super::shrink::{self, Correction};
use super::unlisted;
use super::weighed_noise::WeighedNoise;
use crate::Case;
use gumption_engine::number::{elementary, largest_first};
use gumption_engine::task::Row;
use gumption_inference::beside::Beside;
use gumption_inference::discrepancy::Discrepancy;
use gumption_inference::latent::Role;
use gumption_inference::noise::over_noises;
use gumption_inference::noise::prior_widths::{self, OtherPriors};
use gumption_inference::noise::resolution::Rounding;
use gumption_inference::noise::weighing::{self, Weighing};
use gumption_inference::noise::weighings::weighings;
use gumption_inference::posterior::{Effort, Posterior, WeighedHypothesis};
use gumption_inference::predict;
use gumption_inference::setup::Setup;

/// Two hypotheses look alike if their best predictions differ by less than this, in standard
/// uncertainties of the data and over all of them: the expected logarithm of the odds is half its
/// square.
const ALIKE: f64 = 2.0;

/// A look-alike with less than this share of the verdict's probability is not worth a name.
const WORTH_A_NAME: f64 = 0.01;

/// A rival with less than this probability needs no measurement to be refuted.
const RIVAL: f64 = 1e-4;

/// The hypotheses of a case weighed against its data.
pub(crate) struct Weighed<'c> {
    /// Whether wider priors than stated are most probable.
    pub(crate) prior_conflict: bool,
    /// Whether the verdict's effects are more probable than "unexplained" only with narrower priors.
    pub(crate) wide_priors: bool,
    /// Effects whose priors the data contradict.
    pub(crate) prior_conflicts: Vec<PriorConflict>,
    /// What is known of a departure that no candidate makes.
    pub(crate) departure: Vec<DepartureForm>,
    /// Effects that would make it.
    pub(crate) composed: Vec<ComposedEffect>,
    /// The same as far as they count in predictions: those that were composed with the noise that is
    /// most probable.
    pub(crate) compositions: Compositions,
    /// Effects that ship with the program and would make it.
    pub(crate) unlisted: Vec<UnlistedEffect>,
    /// What the noise may be.
    pub(crate) noise: WeighedNoise,
    /// With the noise that is most probable.
    pub(crate) setup: Setup<'c>,
    pub(crate) discrepancy: Arc<Discrepancy>,
    pub(crate) posterior: Posterior,
    /// Place of the most probable hypothesis that is not "unexplained".
    pub(crate) best: usize,
    /// Whether it is more probable than "unexplained".
    pub(crate) explained: bool,
    /// What the verdict adds to the model.
    pub(crate) correction: Correction,
    /// Variances of the noise by value.
    pub(crate) variances: Vec<f64>,
}

/// The probability of a hypothesis, with a departure beside its effects or without.
fn total(posterior: &Posterior, place: usize) -> f64 {
    let alone = &posterior.hypotheses[place];
    alone.probability + posterior.probability_beside(&alone.effects)
}

impl<'c> Weighed<'c> {
    /// `others` is the case with priors of other widths.
    pub(crate) fn new(
        case: &'c Case,
        others: &'c OtherPriors,
        seed: u64,
        effort: Effort<'_>,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Self {
        let weighings = weighings(case, others, seed, effort, progress);
        let prior_conflict = weighing::most_probable_widths(&weighings).widened().is_some();
        let hidden = prior_widths::hidden(&weighings);
        let prior_conflicts =
            prior_conflict::conflicts(case, &weighings, case.coverage_probability());
        let noise = WeighedNoise::of(&weighings);
        let departure = departure::forms(&weighings);
        let (composed, compositions) = composed(&weighings);
        let coverage = case.coverage_probability();
        let unlisted = unlisted::explaining(case, &weighings, seed, coverage);
        let (setup, discrepancy, posterior) = over_noises::summed(weighings);
        let places = 0..posterior.hypotheses.len();
        let best = places.max_by(|&a, &b| total(&posterior, a).total_cmp(&total(&posterior, b)));
        let best = best.unwrap_or(0);
        let explained = total(&posterior, best) >= posterior.probability;
        let named = &posterior.hypotheses[best];
        let wide_priors = explained && hidden.contains(&named.effects);
        let departs =
            !explained || posterior.probability_beside(&named.effects) > named.probability;
        let correction = if departs {
            Correction::Departure(compositions.clone())
        } else {
            Correction::Effects(named.effects.clone())
        };
        let variances = noise_variances(&setup, &posterior, best, explained);
        Self {
            prior_conflict,
            wide_priors,
            prior_conflicts,
            departure,
            composed,
            compositions,
            unlisted,
            noise,
            setup,
            discrepancy,
            posterior,
            best,
            explained,
            correction,
            variances,
        }
    }

    /// The verdict and what these data cannot tell from it, as places of hypotheses.
    pub(crate) fn indistinguishable(&self) -> Vec<usize> {
        let modes = best_predictions(&self.setup, &self.discrepancy, &self.posterior);
        indistinguishable(
            &self.setup,
            &self.posterior,
            self.best,
            self.explained,
            &modes,
            &self.variances,
        )
    }

    /// The best of the named hypotheses, with a departure beside its effects or without.
    pub(crate) fn winner(&self) -> Cow<'_, WeighedHypothesis> {
        self.posterior.together(&self.posterior.hypotheses[self.best])
    }

    /// What makes how much of the gap; empty where there is none.
    pub(crate) fn shares(&self) -> Vec<GapShare> {
        let Self { setup, discrepancy, posterior, correction, variances, .. } = self;
        let winner = self.winner();
        let departs = matches!(correction, Correction::Departure(_));
        let named = &winner.effects[..];
        let effects = if self.explained { named } else { &[] };
        let departure = match posterior.beside(effects).filter(|_| self.explained) {
            Some(of) => &of.departure,
            None => &posterior.unexplained,
        };
        let departure = departure.kinds.first().filter(|_| departs);
        let acting = posterior.hypotheses.iter().find(|h| h.effects == effects);
        let at = if self.explained { Some(&*winner) } else { acting };
        let mode = at.and_then(|at| at.evidence.modes.first());
        let Some(mode) = mode.filter(|_| departs || !effects.is_empty()) else { return Vec::new() };
        shares(setup, discrepancy, effects, mode, departure, variances)
    }

    /// The verdict, and what is left beside its effects; `group` are its look-alikes.
    pub(crate) fn most_probable(&self, group: &[usize], shares: &[GapShare]) -> MostProbable {
        let mut verdict =
            most_probable(&self.setup, &self.posterior, self.best, self.explained, group);
        if self.explained && matches!(self.correction, Correction::Departure(_)) {
            let own = self.departure.iter().find(|form| form.beside == verdict.effects);
            let share = shares.iter().find(|share| share.what == GapPart::Departure);
            let effects = &self.posterior.hypotheses[self.best].effects;
            verdict.beside = own.or(self.departure.first()).map(|form| LeftBeside {
                probability: self.posterior.probability_beside(effects),
                form: form.clone(),
                share_of_gap: share.map_or(f64::NAN, |share| share.share_of_gap),
            });
        }
        verdict.prior_conflict = self.prior_conflict
            && self.prior_conflicts.iter().any(|conflict| verdict.effects == conflict.effects);
        verdict
    }
}

/// Departures that are composed where "unexplained" is probable; those for predictions as well, where
/// the noise that it is probable with is the most probable one.
fn composed(weighings: &[Weighing<'_>]) -> (Vec<ComposedEffect>, Compositions) {
    let unexplained = departure::probability(weighings);
    let leading = departure::leading(weighings);
    let Some(weighing) = weighings.get(leading).filter(|_| unexplained > departure::WORTH_TELLING)
    else {
        return (Vec::new(), Compositions::default());
    };
    let Weighing { setup, discrepancy, posterior, .. } = weighing;
    let found = composed::compose(setup, discrepancy, posterior);
    let effects = found.effects(setup, unexplained);
    let same = weighing::most_probable(weighings) == leading;
    (effects, if same { found } else { Compositions::default() })
}

/// Variances with those of values that are rounded more coarsely than their noise.
fn with_rounding(setup: &Setup<'_>, mut variances: Vec<f64>) -> Vec<f64> {
    let outputs = setup.data.outputs.len();
    for output in 0..outputs {
        let Some(rounding) = Rounding::of(setup.case, &setup.data, output) else { continue };
        for row in rounding.rows() {
            variances[row * outputs + output] += rounding.variance(row);
        }
    }
    variances
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
        let own = (0..data.len()).map(|value| stated(value).map_or(1.0, |u| u * u)).collect();
        return with_rounding(setup, own);
    }
    if !explained
        && let Some(kind) = posterior.unexplained.kinds.first()
        && let Some(variances) = &kind.variances
    {
        return variances.to_vec();
    }
    let evidence = &posterior.together(&posterior.hypotheses[best]).evidence;
    let draws = evidence.resampled(128);
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
                None => {
                    let ln = ln[output] + power[output] * setup.ln_sizes[value];
                    elementary::exp(2.0 * (ln + data.ln_scales[value]))
                }
            };
        }
    }
    let own = sums.iter().map(|sum| sum / draws.len().max(1) as f64).collect();
    with_rounding(setup, own)
}

/// What every hypothesis says at its most probable point, by value; with a departure beside its effects
/// where that is more probable.
fn best_predictions(
    setup: &Setup<'_>,
    discrepancy: &Discrepancy,
    posterior: &Posterior,
) -> Vec<Option<Vec<f64>>> {
    let rows: Vec<Row> = setup
        .data
        .points
        .iter()
        .filter_map(|point| point.rows.first())
        .map(|&row| setup.row(row).clone())
        .collect();
    let totals = (0..posterior.hypotheses.len()).map(|place| total(posterior, place));
    let most = totals.fold(0.0, f64::max);
    posterior
        .hypotheses
        .iter()
        .enumerate()
        .map(|(place, hypothesis)| {
            if total(posterior, place) < 1e-3 * WORTH_A_NAME * most {
                return None;
            }
            let beside = posterior.beside(&hypothesis.effects);
            let beside = beside.filter(|beside| beside.named.probability > hypothesis.probability);
            if let Some(Beside { departure, .. }) = beside {
                let kinds = shrink::top(&departure.kinds);
                let said = discrepancy.predict(setup, kinds, &rows, &[]);
                return Some(said.into_iter().flatten().map(|(mean, _)| mean).collect());
            }
            let mode = hypothesis.evidence.modes.first()?.scores.clone();
            let values = predict::values(setup, &hypothesis.effects, &[mode], &rows);
            Some(values.into_iter().flatten().filter_map(|draws| draws.first().copied()).collect())
        })
        .collect()
}

/// The places of the hypotheses that these data cannot tell from the best one, itself first.
fn indistinguishable(
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
    let least = WORTH_A_NAME * total(posterior, best);
    let mut alike: Vec<usize> = (0..predictions.len())
        .filter(|&place| place != best && total(posterior, place) >= least)
        .filter(|&place| predictions[place].as_ref().is_some_and(|other| distance(other) < ALIKE))
        .collect();
    largest_first(&mut alike, |&a| total(posterior, a));
    let mut group = vec![best];
    group.extend(alike);
    group
}

/// The hypothesis to tell the best one from: the most probable one that is not the best with more
/// effects added, since an addition that the data leave open makes no difference to be measured; a
/// look-alike first.
pub(crate) fn rival(posterior: &Posterior, best: usize, group: &[usize]) -> Option<usize> {
    let own = &posterior.hypotheses.get(best)?.effects;
    let adds = |place: usize| {
        let effects = &posterior.hypotheses[place].effects;
        own.iter().all(|effect| effects.contains(effect))
    };
    let probability = |place: usize| total(posterior, place);
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

fn most_probable(
    setup: &Setup<'_>,
    posterior: &Posterior,
    best: usize,
    explained: bool,
    group: &[usize],
) -> MostProbable {
    if !explained {
        return MostProbable {
            kind: HypothesisKind::Unexplained,
            effects: Vec::new(),
            prior_conflict: false,
            beside: None,
            probability: posterior.probability,
            indistinguishable: Vec::new(),
            indistinguishable_probability: posterior.probability,
        };
    }
    let winner = &posterior.hypotheses[best];
    MostProbable {
        kind: if winner.effects.is_empty() {
            HypothesisKind::None
        } else {
            HypothesisKind::Explained
        },
        effects: setup.effect_names(&winner.effects),
        prior_conflict: false,
        beside: None,
        probability: total(posterior, best),
        indistinguishable: group
            .iter()
            .map(|&h| setup.effect_names(&posterior.hypotheses[h].effects))
            .collect(),
        indistinguishable_probability: group.iter().map(|&h| total(posterior, h)).sum(),
    }
}
