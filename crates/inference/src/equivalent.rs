//! Hypotheses that are the same function of the conditions: whatever the parameters of one are, those
//! of the other can be chosen so that it says the same in the whole reachable range. No measurement
//! of these outputs can tell them apart.
//!
//! It is found numerically: what one hypothesis says for some draws of its posterior is fitted by the
//! other, with parameters that may go beyond their priors, and with inputs that may move within their
//! standard uncertainties; and the other way round.

use std::rc::Rc;

use gumption_engine::parallel;
use nalgebra::{DMatrix, DVector};

use super::reachable::Place;
use crate::posterior::Posterior;
use crate::predict::Predictor;
use crate::setup::Setup;
use gumption_engine::number::{COLUMN, largest_first};
use gumption_engine::task::Row;

/// Hypotheses that are looked at, at most: single effects, and leading ones of several.
const MOST_SINGLE: usize = 16;
const MOST_SEVERAL: usize = 6;

/// Hypotheses of several effects need this probability.
const LEADING: f64 = 0.01;

/// Places at which they are compared, at most.
const MOST_PLACES: usize = 60;

/// Draws of one hypothesis that the other is to follow.
const DRAWS: usize = 3;

/// Differences below this share of what the effects do are rounding.
const SAME: f64 = 1e-6;

/// Steps of a fit.
const STEPS: usize = 40;

/// A step that leaves more than this of the sum of squares is one to a best fit that is not exact.
const STALLED: f64 = 0.999;

/// Dampings of a step that are tried, each ten times the one before.
const DAMPINGS: usize = 8;

/// Half the step of differences in the scores.
const DIFFERENCE: f64 = 1e-4;

/// A hypothesis over the reachable range, in units of the noise.
struct Surface<'s> {
    effects: Vec<String>,
    predictor: Predictor<'s>,
    /// The standard deviation of the noise at each place, of each output.
    scales: Vec<f64>,
    /// Scores of all unknown quantities at draws of the posterior, the inputs at their estimates.
    draws: Vec<Vec<f64>>,
    /// What it says there, in units of the noise.
    targets: Vec<Vec<f64>>,
    /// Places of the inputs and of the effects' parameters among the unknown quantities.
    inputs: std::ops::Range<usize>,
    parameters: std::ops::Range<usize>,
}

/// The groups of hypotheses that are the same function, each with more than one of them.
pub fn groups(
    setup: &Setup<'_>,
    posterior: &Posterior,
    places: &[Place],
    variances: &[f64],
) -> Vec<Vec<Vec<String>>> {
    let places = spread(places);
    let rows: Vec<Row> = places.iter().map(|place| place.row.clone()).collect();
    let probability = |h: usize| {
        let alone = &posterior.hypotheses[h];
        alone.probability + posterior.probability_beside(&alone.effects)
    };
    let of = |several: bool| {
        let mut chosen: Vec<usize> = (0..posterior.hypotheses.len())
            .filter(|&h| {
                let hypothesis = &posterior.hypotheses[h];
                let count = hypothesis.effects.len();
                let wanted =
                    if several { count > 1 && probability(h) > LEADING } else { count == 1 };
                wanted && !hypothesis.evidence.modes.is_empty() && hypothesis.evidence.has_draws()
            })
            .collect();
        largest_first(&mut chosen, |&a| probability(a));
        chosen.truncate(if several { MOST_SEVERAL } else { MOST_SINGLE });
        chosen
    };
    let chosen: Vec<usize> = [of(false), of(true)].concat();
    let outputs = setup.data.outputs.len();
    let of_place = |place: &&Place| -> Vec<f64> {
        let noise = |output: usize| place.noise(setup, variances, output);
        (0..outputs).map(|output| noise(output).sqrt().max(f64::MIN_POSITIVE)).collect()
    };
    let scales: Vec<f64> = places.iter().flat_map(of_place).collect();
    let surfaces: Vec<Surface<'_>> = parallel::map(chosen, |h| {
        let hypothesis = &posterior.hypotheses[h];
        let inputs = 0..setup.unknown_inputs.len();
        let mut draws = hypothesis.evidence.resampled(DRAWS);
        for draw in &mut draws {
            draw[inputs.clone()].fill(0.0);
        }
        let predictor = Predictor::new(setup, &hypothesis.effects, &rows, &setup.data.outputs);
        let values = predictor.values(&draws);
        let targets = (0..draws.len()).map(|draw| column(&values, &scales, draw)).collect();
        Surface {
            effects: setup.effect_names(&hypothesis.effects),
            predictor,
            scales: scales.clone(),
            targets,
            draws,
            inputs,
            parameters: setup.roles.len()..hypothesis.evidence.unknowns(),
        }
    });
    let nominal = Predictor::new(setup, &[], &rows, &setup.data.outputs);
    let at_estimates = vec![vec![0.0; setup.roles.len()]];
    let nominal: Vec<f64> = first(&nominal.values(&at_estimates), &scales);
    let pairs: Vec<(usize, usize)> =
        (0..surfaces.len()).flat_map(|a| (a + 1..surfaces.len()).map(move |b| (a, b))).collect();
    let same = parallel::map(pairs, |(first, second)| {
        let (a, b) = (&surfaces[first], &surfaces[second]);
        (a.follows(b, &nominal) && b.follows(a, &nominal)).then_some((first, second))
    });
    // what is the same as the same is the same
    let mut group: Vec<usize> = (0..surfaces.len()).collect();
    for (a, b) in same.into_iter().flatten() {
        let (from, to) = (group[a].max(group[b]), group[a].min(group[b]));
        group.iter_mut().filter(|own| **own == from).for_each(|own| *own = to);
    }
    (0..surfaces.len())
        .map(|group_of| -> Vec<Vec<String>> {
            let members = (0..surfaces.len()).filter(|&member| group[member] == group_of);
            members.map(|member| surfaces[member].effects.clone()).collect()
        })
        .filter(|group| group.len() > 1)
        .collect()
}

/// Places spread over all of them, the ends among them.
fn spread(places: &[Place]) -> Vec<&Place> {
    let count = places.len().min(MOST_PLACES);
    if count == places.len() {
        return places.iter().collect();
    }
    // steps of the golden section, so that no axis of a grid is left out
    let step = (places.len() as f64 * 0.618_033_988_749_894_9) as usize;
    let step = (step..).find(|step| gcd(*step, places.len()) == 1).unwrap_or(1);
    let ends = [0, places.len() - 1];
    let inner = (1..count - 1).map(|n| n * step % places.len());
    ends.into_iter().chain(inner).map(|place| &places[place]).collect()
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// The values of the first draw in units of the noise.
fn first(values: &crate::predict::Values, scales: &[f64]) -> Vec<f64> {
    column(values, scales, 0)
}

fn column(values: &crate::predict::Values, scales: &[f64], draw: usize) -> Vec<f64> {
    let of_output = |(draws, scale): (&Vec<f64>, &f64)| draws[draw] / scale;
    values.iter().flatten().zip(scales).map(of_output).collect()
}

impl Surface<'_> {
    /// Whether what the other hypothesis says can be said by this one.
    fn follows(&self, other: &Self, nominal: &[f64]) -> bool {
        other.targets.iter().all(|target| {
            let effect = target.iter().zip(nominal).map(|(t, n)| (t - n).abs()).fold(0.0, f64::max);
            let size = target.iter().map(|t| t.abs()).fold(0.0, f64::max);
            if !effect.is_finite() || effect <= 1e-9 * size {
                return false;
            }
            // rounding of the values themselves is no difference either
            let tolerance = SAME * effect + 1e-13 * size;
            let unknowns = [
                self.parameters.clone().collect::<Vec<_>>(),
                self.parameters.clone().chain(self.inputs.clone()).collect(),
            ];
            let tries = if self.inputs.is_empty() { 1 } else { 2 };
            unknowns.iter().take(tries).any(|unknowns| {
                self.draws.iter().any(|start| self.fits(target, start, unknowns, tolerance))
            })
        })
    }

    /// Whether a least-squares fit of some unknown quantities comes within a tolerance everywhere
    /// (Levenberg, Marquardt). The steps of several dampings are tried side by side, each with the
    /// points from which the next step follows.
    fn fits(&self, target: &[f64], start: &[f64], unknowns: &[usize], tolerance: f64) -> bool {
        let most = |vector: &DVector<f64>| vector.iter().map(|r| r.abs()).fold(0.0, f64::max);
        let mut here = self.around(target, vec![start.to_vec()], unknowns).next();
        let mut damping = 1e-3;
        let mut last = f64::INFINITY;
        for step in 0..STEPS {
            let Some(Around { at, residuals: own, square, slopes }) = here.take() else {
                return false;
            };
            let within = self.inputs.clone().all(|input| at[input].abs() <= 1.0);
            if most(&own) <= tolerance {
                return within;
            }
            // an effect of known size says what it says
            if unknowns.is_empty() {
                return false;
            }
            let slopes = DMatrix::from_columns(&slopes());
            if !square.is_finite() || slopes.iter().any(|slope| !slope.is_finite()) {
                return false;
            }
            // a fit that is not within reach after a few steps will not come there
            if step % 8 == 7 {
                if square > 0.5 * last {
                    return false;
                }
                last = square;
            }
            let normal = slopes.tr_mul(&slopes);
            let gradient = slopes.tr_mul(&own);
            let largest = normal.diagonal().max().max(f64::MIN_POSITIVE);
            let dampings = (0..DAMPINGS).scan(damping, |next, _| {
                let own = *next;
                *next *= 10.0;
                Some(own)
            });
            let moves: Vec<(f64, Vec<f64>)> = dampings
                .filter_map(|damping| {
                    let mut damped = normal.clone();
                    for (n, unknown) in unknowns.iter().enumerate() {
                        // inputs move as little as they can, in standard uncertainties: where an input
                        // does what a parameter or another input does, each by its size
                        let is_input = self.inputs.contains(unknown);
                        let own = normal[(n, n)].max(1e-12 * largest);
                        damped[(n, n)] += damping * if is_input { largest } else { own };
                    }
                    let by = damped.cholesky()?.solve(&gradient);
                    let mut next = at.clone();
                    for (n, &unknown) in unknowns.iter().enumerate() {
                        next[unknown] += by[n];
                    }
                    Some((damping, next))
                })
                .collect();
            let together = (COLUMN / (2 * unknowns.len() + 1)).max(1);
            let found = moves.chunks(together).find_map(|moves| {
                let points = moves.iter().map(|(_, next)| next.clone()).collect();
                let around = self.around(target, points, unknowns);
                let mut tried = moves.iter().map(|(damping, _)| *damping).zip(around);
                tried.find(|(_, there)| there.square < square)
            });
            let Some((own, there)) = found else { return false };
            // the steps to an exact fit are no small ones
            if there.square > STALLED * square {
                return false;
            }
            damping = (0.1 * own).max(1e-15);
            here = Some(there);
        }
        false
    }

    /// What is left of a target at points, and its derivatives there by some unknown quantities.
    fn around<'f>(
        &'f self,
        target: &'f [f64],
        at: Vec<Vec<f64>>,
        unknowns: &'f [usize],
    ) -> impl Iterator<Item = Around<impl Fn() -> Vec<DVector<f64>> + 'f>> + 'f {
        let group = 2 * unknowns.len() + 1;
        let mut points = Vec::with_capacity(at.len() * group);
        for at in &at {
            points.push(at.clone());
            for &unknown in unknowns {
                for sign in [1.0, -1.0] {
                    let mut moved = at.clone();
                    moved[unknown] += sign * DIFFERENCE;
                    points.push(moved);
                }
            }
        }
        let values = Rc::new(self.predictor.values(&points));
        at.into_iter().enumerate().map(move |(number, at)| {
            let first = number * group;
            let own = column(&values, &self.scales, first);
            let left = target.iter().zip(own).map(|(t, v)| t - v);
            let residuals = DVector::from_iterator(target.len(), left);
            let values = Rc::clone(&values);
            let slopes = move || {
                let side = |n: usize| DVector::from_vec(column(&values, &self.scales, first + n));
                let slope = |n: usize| (side(2 * n + 1) - side(2 * n + 2)) / (2.0 * DIFFERENCE);
                (0..unknowns.len()).map(slope).collect()
            };
            Around { at, square: residuals.norm_squared(), residuals, slopes }
        })
    }
}

/// What is left of a target at a point.
struct Around<S> {
    at: Vec<f64>,
    residuals: DVector<f64>,
    /// The sum of their squares.
    square: f64,
    /// Makes the derivatives of what is said there by the unknown quantities.
    slopes: S,
}
