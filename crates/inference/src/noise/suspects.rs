//! Values that are off: which set of them may be worth an evidence of its own.
//!
//! One after the other is tried as long as each pays. Values of similar size hide each other: with
//! one of them told, the others still speak against it as much as before, or for uncertainties that
//! are stated too small. Where one alone does not pay, sets of several are therefore looked for, in
//! the Gaussian approximation: the best further value is added, and those are taken out again whose
//! place others have taken (floating search: Pudil, Novovicova, Kittler 1994, Pattern Recognition
//! Letters 15, 1119).

use gumption_engine::parallel;

use crate::logarithm::ln_add;
use crate::noise::beside_departure::beside_departure;
use crate::noise::influence::{Influence, SizeGains, suspect};
use crate::noise::noise_model::{
    MOST_SUSPECTS, NoiseModel, STILL_OFF, SUSPECT_SIZES, Suspect, WORTH_TRYING,
};
use crate::noise::prior_widths::PriorWidths;
use crate::noise::remainder::Remainder;
use crate::noise::weighing::{Weighing, ln_total, ln_weight_at_mode};
use crate::posterior::{self, Effort, WeighedHypothesis};
use gumption_engine::number::{elementary, largest_first};

/// One of so many values may be off, where several at once are looked for: what most of the data say
/// is no mistake.
const MOST_SHARE: usize = 4;

/// Values of a set that are added and taken out again, at most so many times for each of them.
const MOST_STEPS: usize = 4;

/// So many neighbours that are off to the same side are a departure: that of values which are off by
/// mistake the same ones are neighbours has a probability of a few hundredths.
const NEIGHBOURS: usize = 3;

/// Of so many sets of a number of values and hypotheses, the best, modes are looked for again.
const CONFIRMED: usize = 3;

/// Sets whose weights differ by less than this factor's logarithm are as good as each other.
const SAME: f64 = 1e-9;

/// A set of values that are off which may be worth an evidence of its own: the last one that was
/// tried and one more, or several. `None` where no further value is suspicious.
pub(crate) fn more_suspects(
    weighings: &[Weighing<'_>],
    seed: u64,
    effort: Effort<'_>,
) -> Option<Vec<Suspect>> {
    let is_known = |w: &&Weighing<'_>| {
        let noise = &w.setup.data.noise;
        noise.factor.is_none()
            && noise.serial.is_none()
            && noise.shared.is_none()
            && noise.common.is_none()
            && w.widths == PriorWidths::AsStated
    };
    let last = weighings.iter().rfind(is_known)?;
    if let Some(larger) = larger_suspects(last) {
        return Some(larger);
    }
    if last.setup.data.noise.suspects.len() >= MOST_SUSPECTS {
        return None;
    }
    let enough = ln_total(weighings) + elementary::ln(WORTH_TRYING);
    let influence = |hypothesis| Influence::of(&last.setup, hypothesis);
    let influences = parallel::map(&last.posterior.hypotheses, influence);
    one_more(last, &influences, enough)
        .or_else(|| several_more(last, &influences, enough, seed, effort))
        .or_else(|| beside_departure(last, enough))
}

/// The suspects of a weighing and these more.
fn with(last: &Weighing<'_>, more: &[(usize, usize)]) -> NoiseModel {
    let mut suspects = last.setup.data.noise.suspects.clone();
    suspects.extend(more.iter().map(|&wrong| suspect(&last.setup, wrong)));
    NoiseModel::with_suspects(suspects)
}

/// The logarithm of the prior probability that these more are off.
fn ln_prior(last: &Weighing<'_>, more: &[(usize, usize)]) -> f64 {
    elementary::ln(with(last, more).prior(last.setup.data.len()))
}

/// Whether a value is among the suspects of a weighing.
fn is_suspect(last: &Weighing<'_>, value: usize) -> bool {
    let Suspect { id, output, .. } = suspect(&last.setup, (value, 0));
    last.setup.data.noise.suspects.iter().any(|known| known.is_of(id, output))
}

/// The suspects of a weighing and the value whose evidences it would raise most, if that is enough.
fn one_more(
    last: &Weighing<'_>,
    influences: &[Option<Influence>],
    enough: f64,
) -> Option<Vec<Suspect>> {
    let values = last.setup.data.len();
    let of_hypothesis = |(hypothesis, influence): (_, &Option<Influence>)| -> Vec<SizeGains> {
        let ln = ln_weight_at_mode(&last.setup, hypothesis);
        let Some(influence) = influence else { return Vec::new() };
        let alone = influence.with(&[]);
        (0..values).map(|value| alone.more(value).map(|gain| ln + gain)).collect()
    };
    let found = parallel::map(last.posterior.hypotheses.iter().zip(influences), of_hypothesis);
    let sum = |value: usize, size: usize| {
        found
            .iter()
            .filter_map(|gains| gains.get(value))
            .fold(f64::NEG_INFINITY, |sum, gains| ln_add(sum, gains[size]))
    };
    let (ln, more) = (0..values)
        .filter(|&value| !is_suspect(last, value))
        .flat_map(|value| (0..SUSPECT_SIZES.len()).map(move |size| (value, size)))
        .map(|(value, size)| (sum(value, size) + ln_prior(last, &[(value, size)]), (value, size)))
        .max_by(|a, b| a.0.total_cmp(&b.0))?;
    (ln > enough).then(|| with(last, &[more]).suspects)
}

/// The logarithm of a weight and the values of a set that are off, in their order.
type WeighedSet = (f64, Vec<(usize, usize)>);

/// The suspects of a weighing and the smallest set of more than one value that is enough together,
/// also with the evidence at modes that were looked for again: where an effect is not linear, values
/// that are taken out let it go elsewhere than the approximation says.
fn several_more(
    last: &Weighing<'_>,
    influences: &[Option<Influence>],
    enough: f64,
    seed: u64,
    effort: Effort<'_>,
) -> Option<Vec<Suspect>> {
    let known = last.setup.data.noise.suspects.len();
    let most = MOST_SUSPECTS.min(last.setup.data.len() / MOST_SHARE).saturating_sub(known);
    if most < 2 {
        return None;
    }
    let hypotheses = last.posterior.hypotheses.iter().zip(influences);
    let found: Vec<Vec<WeighedSet>> = parallel::map(hypotheses, |(hypothesis, influence)| {
        let ln = ln_weight_at_mode(&last.setup, hypothesis);
        let influence = influence.as_ref().filter(|_| ln.is_finite());
        let sets = influence.map(|influence| best_sets(last, influence, most)).unwrap_or_default();
        sets.into_iter().map(|(gain, set)| (ln + gain, set)).collect()
    });
    (2..=most).find_map(|count| {
        let mut sums: Vec<WeighedSet> = Vec::new();
        for (ln, set) in found.iter().flatten().filter(|(_, set)| set.len() == count) {
            match sums.iter_mut().find(|(_, known)| known == set) {
                Some((sum, _)) => *sum = ln_add(*sum, *ln),
                None => sums.push((*ln, set.clone())),
            }
        }
        sums.retain(|(ln, _)| *ln > enough);
        largest_first(&mut sums, |a| a.0);
        sums.truncate(CONFIRMED);
        let of = |set: &Vec<(usize, usize)>| {
            let own = found.iter().zip(&last.posterior.hypotheses);
            let mut own: Vec<(f64, &WeighedHypothesis)> = own
                .filter_map(|(hypotheses, h)| {
                    Some((hypotheses.iter().find(|(_, other)| other == set)?.0, h))
                })
                .collect();
            largest_first(&mut own, |a| a.0);
            own.into_iter().take(CONFIRMED).map(|(_, h)| h).collect::<Vec<_>>()
        };
        sums.into_iter().find_map(|(_, set)| {
            let model = with(last, &set);
            let prior = elementary::ln(model.prior(last.setup.data.len()));
            let setup = last.setup.with_noise(model);
            let is_enough = of(&set).into_iter().any(|hypothesis| {
                let effects = &hypothesis.effects;
                let again = posterior::again(&setup, effects, last.before(), seed, effort);
                again.is_some_and(|again| again.ln_weight() + prior > enough)
            });
            is_enough.then_some(setup.data.noise.suspects)
        })
    })
}

/// The best set of each number of values up to `most` that was found, by what a hypothesis gains with
/// it and its prior probability.
fn best_sets(last: &Weighing<'_>, influence: &Influence, most: usize) -> Vec<WeighedSet> {
    let free: Vec<usize> =
        (0..influence.values()).filter(|&value| !is_suspect(last, value)).collect();
    let score = |set: &[(usize, usize)]| influence.with(set).gain() + ln_prior(last, set);
    let mut best: Vec<Option<WeighedSet>> = vec![None; most + 1];
    let mut set: Vec<(usize, usize)> = Vec::new();
    for _ in 0..MOST_STEPS * most {
        if set.len() == most {
            break;
        }
        let together = influence.with(&set);
        let more = free
            .iter()
            .filter(|value| set.iter().all(|(member, _)| member != *value))
            .map(|&value| {
                let gains = together.more(value);
                let sizes = SUSPECT_SIZES.iter().zip(gains).enumerate();
                sizes
                    .map(|(size, ((_, prior), gain))| {
                        (gain + elementary::ln(*prior), (value, size))
                    })
                    .fold((f64::NEG_INFINITY, (value, 0)), |a, b| if b.0 > a.0 { b } else { a })
            })
            .max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, more)) = more else { break };
        set.push(more);
        set = better(&mut best, score(&set), set);
        while set.len() > 2 {
            // the last one was the best to add
            let without = (0..set.len() - 1).map(|member| {
                let mut fewer = set.clone();
                fewer.remove(member);
                (score(&fewer), fewer)
            });
            let Some((ln, fewer)) = without.max_by(|a, b| a.0.total_cmp(&b.0)) else { break };
            let known = best[fewer.len()].as_ref().map_or(f64::NEG_INFINITY, |(ln, _)| *ln);
            if ln <= known + SAME {
                break;
            }
            set = better(&mut best, ln, fewer);
        }
    }
    let told = |(ln, mut set): WeighedSet| {
        let ln = if influence.is_fitted() {
            influence.gain_with_less_noise(&mut set) + ln_prior(last, &set)
        } else {
            ln
        };
        set.sort_unstable();
        (ln, set)
    };
    let all = best.into_iter().flatten();
    all.filter(|(_, set)| !is_departure(last, influence, set)).map(told).collect()
}

/// Whether values of a set are what a departure makes: neighbours along a condition that are off to
/// the same side, with all rows between them.
fn is_departure(last: &Weighing<'_>, influence: &Influence, set: &[(usize, usize)]) -> bool {
    let setup = &last.setup;
    let outputs = setup.data.outputs.len();
    let values: Vec<usize> = set.iter().map(|wrong| wrong.0).collect();
    let Some(errors) = influence.errors(&values) else { return false };
    // for each row of an output the side to which its value is off
    let sides = |output: usize, side: bool| -> Vec<bool> {
        let off = |row: usize| values.iter().position(|value| *value == row * outputs + output);
        let is = |row: usize| off(row).is_some_and(|place| (errors[place] > 0.0) == side);
        (0..setup.data.rows()).map(is).collect()
    };
    setup.case.set_conditions().any(|condition| {
        let at = |row: &usize| setup.row(*row).conditions[condition];
        let order = setup.rows_along(condition);
        (0..outputs).flat_map(|output| [sides(output, false), sides(output, true)]).any(|off| {
            let mut run = 0;
            order.chunk_by(|a, b| at(a) == at(b)).any(|rows| {
                run = if rows.iter().all(|&row| off[row]) { run + rows.len() } else { 0 };
                run >= NEIGHBOURS
            })
        })
    })
}

/// The better one of a set and the best of its size that is known, which is kept.
fn better(
    best: &mut [Option<WeighedSet>],
    ln: f64,
    set: Vec<(usize, usize)>,
) -> Vec<(usize, usize)> {
    match &mut best[set.len()] {
        Some((known, other)) if *known >= ln => other.clone(),
        kept => {
            *kept = Some((ln, set.clone()));
            set
        }
    }
}

/// The same suspects with those of a larger size that still are off: without stated uncertainties a
/// value that is far off hides in the scatter that it makes itself, until it is suspected.
fn larger_suspects(weighing: &Weighing<'_>) -> Option<Vec<Suspect>> {
    let Weighing { setup, posterior, .. } = weighing;
    let hypotheses = posterior.hypotheses.iter();
    let best = hypotheses.max_by(|a, b| a.probability.total_cmp(&b.probability))?;
    let residuals = Remainder::of(setup, best).residuals;
    let outputs = setup.data.outputs.len();
    let residual = |suspect: &Suspect| {
        let row = setup.data.ids.iter().position(|&id| id == suspect.id)?;
        let residual = residuals.get(row * outputs + suspect.output)?;
        (suspect.size + 1 < SUSPECT_SIZES.len()).then_some(residual.abs())
    };
    let suspects = &setup.data.noise.suspects;
    let hides: Vec<bool> = (0..outputs)
        .map(|output| {
            let own = suspects.iter().filter(|suspect| suspect.output == output);
            let larger = own.filter_map(|suspect| {
                Some((suspect.size, residual(suspect).filter(|r| *r > 1.0)?))
            });
            let squares = residuals.iter().skip(output).step_by(outputs).map(|r| r * r);
            setup.data.uncertainties[output].is_none() && less_noise_pays(squares, larger)
        })
        .collect();
    let is_off = |suspect: &Suspect| {
        let least = if hides[suspect.output] { 1.0 } else { STILL_OFF };
        residual(suspect).is_some_and(|residual| residual > least)
    };
    let larger = suspects.iter().map(|suspect| match is_off(suspect) {
        true => Suspect { size: suspect.size + 1, ..*suspect },
        false => *suspect,
    });
    let larger: Vec<Suspect> = larger.collect();
    (larger != *suspects).then_some(larger)
}

/// Whether the evidence rises if values that are off, given by the places of their sizes and their
/// residuals, are off by the next larger size each: they do not enlarge an estimated noise then any
/// more, of which the squares of all residuals are given.
fn less_noise_pays(
    squares: impl Iterator<Item = f64>,
    larger: impl Iterator<Item = (usize, f64)>,
) -> bool {
    let (count, all) = squares.fold((0.0, 0.0), |(count, sum), square| (count + 1.0, sum + square));
    let (mut left, mut gain) = (all, 0.0);
    for (size, residual) in larger {
        let [(here, prior), (next, other)] = [SUSPECT_SIZES[size], SUSPECT_SIZES[size + 1]];
        let shrinks = here / next;
        left -= residual * residual * (1.0 - shrinks * shrinks);
        gain += elementary::ln(shrinks * other / prior);
    }
    left < all && gain - 0.5 * count * elementary::ln(left.max(f64::MIN_POSITIVE) / all) > 0.0
}
