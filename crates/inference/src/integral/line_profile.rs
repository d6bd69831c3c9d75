//! Profiles of the posterior along single parameters, about modes that its curvature does not describe.
//!
//! The Gaussian approximation at a mode is what the integral is begun with, and Fisher scoring is what
//! leads there. Both fail where the response has edges: the position of a step changes nothing until it
//! passes a condition of the data, so that its derivative is zero, scoring leaves it where it began, and
//! the approximation is as wide as the prior where the posterior is as narrow as the distance of two
//! conditions. An integral that is begun so draws past the mode, and its own draws do not tell.
//!
//! At every mode each parameter is therefore moved to both sides by several distances. Where the density
//! does not fall as that of a normal distribution does, the profile along this parameter is followed over
//! its whole prior: the parameters in which the response is linear are solved for at every value, the
//! grid is halved where the integral over it is not known yet and beside its peaks, and the mode moves to
//! the best value until no parameter gains any more. The integral is then begun with the parts of the
//! profile between its edges, each with a mean and a standard deviation of its own.

use gumption_engine::number::{COLUMN, elementary, largest_first, smallest_first};

use crate::integral::mixture::{TEMPER, ln_share};
use crate::integral::response_scan::{Scan, ScanPlan};
use crate::integral::search::{self, GAIN, Mode};
use crate::likelihood::Likelihood;

/// Distances from a mode, in scores, at which its approximation is looked at.
const PROBES: [f64; 5] = [0.5, 0.125, 0.03, 0.008, 0.002];

/// A fall of the logarithm of the density that is too much where the approximation has less than a half,
/// and too little where it has more than the second one.
const STEEP: f64 = 5.0;
const CERTAIN: f64 = 16.0;

/// By how much the density may rise beside a mode.
const RISING: f64 = 1.0;

/// Values of a profile before it is refined, and at most.
const FIRST_VALUES: usize = 49;
const MOST_VALUES: usize = 600;

/// The part of the integral that one interval of the grid may leave unknown.
const UNKNOWN: f64 = 0.01;

/// Peaks beside which intervals are halved in any case, and to which share of the whole.
const PEAKS: usize = 3;
const FINEST: f64 = 1.0 / 2048.0;

/// A change of the logarithm of the density between neighbours that is an edge.
const AN_EDGE: f64 = 1.0;

/// Parts of a profile that are told apart at most, and those of a hypothesis.
const PARTS: usize = 6;
const MOST_PARTS: usize = 20;

/// A part with less than this share of the integral is left out; where those that are kept hold less
/// than the second one, a part as wide as the whole profile stands beside them.
const SLIGHT: f64 = 1e-3;
const MOST_OF_IT: f64 = 0.97;

/// Modes that are looked at, the best.
const SEARCHED: usize = 5;

/// Times over all parameters that a mode moves.
const ROUNDS: usize = 4;

/// Evaluations of a value of the data at most, for one hypothesis.
const MOST_EVALUATIONS: usize = 3_000_000;

/// Modes, and the neighbourhoods in which the integral is begun.
#[derive(Debug)]
pub(crate) struct Resolved {
    pub(crate) modes: Vec<Mode>,
    pub(crate) neighbourhoods: Vec<Mode>,
}

/// Modes as they are, or, where their approximations fail, moved to where no single parameter gains,
/// with the parts of the posterior about them. There are `most` modes at most.
pub(crate) fn resolved(likelihood: &Likelihood<'_>, modes: Vec<Mode>, most: usize) -> Resolved {
    let edged = edged(likelihood, &modes[..modes.len().min(SEARCHED)]);
    if edged.iter().all(Vec::is_empty) {
        return Resolved { neighbourhoods: modes.clone(), modes };
    }
    let mut left = MOST_EVALUATIONS;
    let mut moved = Vec::new();
    let mut neighbourhoods = Vec::new();
    let mut whole = Vec::new();
    for (n, mode) in modes.into_iter().enumerate() {
        let own = edged.get(n).filter(|edged| !edged.is_empty());
        let search = own.and_then(|edged| ProfileSearch::at(likelihood, edged, &mode));
        let Some(search) = search else {
            search::join(&mut neighbourhoods, vec![mode.clone()], MOST_PARTS);
            search::join(&mut moved, vec![mode], most);
            continue;
        };
        let (mode, last) = search.ascended(mode, &mut left);
        if search::is_known(&moved, &mode) {
            continue;
        }
        let (mut parts, wide) = search.parts(&mode, last, &mut left);
        smallest_first(&mut parts, |part| part.cost);
        let best = parts.first().filter(|part| part.cost < mode.cost + AN_EDGE).cloned();
        let best = best.unwrap_or(mode);
        search::join(&mut neighbourhoods, vec![best.clone()], MOST_PARTS);
        search::join(&mut neighbourhoods, parts, MOST_PARTS);
        // parts lie within the one that is as wide as all of them, so that it does not join them
        if search::join(&mut moved, vec![best], most) {
            whole.extend(wide);
        }
    }
    neighbourhoods.extend(whole);
    Resolved { modes: moved, neighbourhoods }
}

/// For each mode the variables along which the density does not fall as the information has it.
fn edged(likelihood: &Likelihood<'_>, modes: &[Mode]) -> Vec<Vec<usize>> {
    let farthest = search::farthest(likelihood);
    let variables = variables(likelihood);
    // mode, variable and the fall that the information has, of each point that is asked
    let mut asked = Vec::new();
    let mut points: Vec<Vec<f64>> = modes.iter().map(|mode| mode.scores.clone()).collect();
    for (n, mode) in modes.iter().enumerate() {
        for &variable in &variables {
            // at a bound the density may fall as steeply as it will
            if mode.scores[variable].abs() >= farthest[variable] {
                continue;
            }
            let information = mode.information[(variable, variable)];
            let deviation = 1.0 / information.max(f64::MIN_POSITIVE).sqrt();
            for distance in PROBES.into_iter().chain([deviation.min(1.0)]) {
                for step in [-distance, distance] {
                    let mut point = mode.scores.clone();
                    point[variable] += step;
                    if point[variable].abs() <= farthest[variable] {
                        asked.push((n, variable, 0.5 * information * step * step));
                        points.push(point);
                    }
                }
            }
        }
    }
    let found = densities(likelihood, &points);
    let (own, found) = found.split_at(modes.len());
    let mut edged = vec![Vec::new(); modes.len()];
    for ((n, variable, wanted), density) in asked.into_iter().zip(found) {
        let fall = own[n] - density;
        let steeper = wanted <= 0.5 && fall > STEEP;
        let flatter = wanted > CERTAIN && fall < STEEP;
        if (steeper || flatter || fall < -RISING || fall.is_nan()) && !edged[n].contains(&variable)
        {
            edged[n].push(variable);
        }
    }
    edged
}

/// The unknown quantities that belong to the model and not to the noise.
fn variables(likelihood: &Likelihood<'_>) -> Vec<usize> {
    (0..likelihood.unknowns()).filter(|&unknown| !likelihood.roles[unknown].is_noise()).collect()
}

/// The logarithms of prior density times likelihood at points.
fn densities(likelihood: &Likelihood<'_>, points: &[Vec<f64>]) -> Vec<f64> {
    let of = |points: &[Vec<f64>]| likelihood.log_target(&likelihood.columns(points), points.len());
    points.chunks(COLUMN).flat_map(of).collect()
}

/// What is searched about a mode.
struct ProfileSearch<'l, 'c> {
    likelihood: &'l Likelihood<'c>,
    /// The variables along which profiles are followed.
    edged: Vec<usize>,
    scan: Scan<'l, 'c>,
    plan: ScanPlan,
}

/// A value of the parameter along which a profile goes.
#[derive(Clone, Debug)]
struct Value {
    /// The score of the parameter.
    score: f64,
    /// The logarithm of the density, with the linear parameters solved for.
    ln_density: f64,
    scores: Vec<f64>,
}

/// The parameter along which a profile goes, and its values in order.
type Profile = (usize, Vec<Value>);

/// A stretch of a profile without an edge.
struct Stretch {
    /// Its share of the integral over the profile.
    share: f64,
    mean: f64,
    deviation: f64,
    /// The point of the profile that is nearest to the mean.
    scores: Vec<f64>,
}

/// A point with the standard deviations along the parameters whose profiles were followed.
#[derive(Clone)]
struct ProfiledPoint {
    ln_mass: f64,
    scores: Vec<f64>,
    deviations: Vec<(usize, f64)>,
}

impl<'l, 'c> ProfileSearch<'l, 'c> {
    /// `None` where the response is linear in all of the edged variables: it has no edges then, but the
    /// mode is beside one of another variable.
    fn at(likelihood: &'l Likelihood<'c>, edged: &[usize], mode: &Mode) -> Option<Self> {
        let scan = Scan::about(likelihood, &mode.scores, search::FARTHEST)?;
        let plan = scan.plan(variables(likelihood))?;
        let is_linear = |parameter: &usize| plan.linear.contains(parameter);
        let edged: Vec<usize> =
            edged.iter().copied().filter(|parameter| !is_linear(parameter)).collect();
        (!edged.is_empty()).then_some(Self { likelihood, edged, scan, plan })
    }

    /// The mode moved along the profiles as long as it gains, and the last one that goes through it.
    fn ascended(&self, mut mode: Mode, left: &mut usize) -> (Mode, Option<Profile>) {
        let mut last = None;
        let mut unchanged = 0;
        for &held in self.edged.iter().cycle().take(ROUNDS * self.edged.len()) {
            let values = self.profile(&mode.scores, held, left);
            let best = values.iter().max_by(|a, b| a.ln_density.total_cmp(&b.ln_density));
            // scoring costs more than the profile: not where the mode is the best of it
            let own = values.iter().find(|value| value.score == mode.scores[held]);
            let own = own.map_or(f64::NEG_INFINITY, |own| own.ln_density);
            let best = best.filter(|best| best.ln_density > own + GAIN);
            let from = best.map(|best| std::slice::from_ref(&best.scores));
            let found = from.map(|from| search::modes(self.likelihood, from, 1));
            let better = found.into_iter().flatten().find(|new| new.cost < mode.cost - GAIN);
            unchanged = if better.is_some() { 1 } else { unchanged + 1 };
            if last.is_none() || better.is_some() {
                last = Some((held, values));
            }
            if let Some(better) = better {
                mode = better;
            }
            if unchanged == self.edged.len() {
                break;
            }
        }
        (mode, last)
    }

    /// The parts of the posterior about a mode, and one as wide as all of them where they leave much
    /// out. `last` is a profile that goes through it.
    fn parts(
        &self,
        mode: &Mode,
        last: Option<Profile>,
        left: &mut usize,
    ) -> (Vec<Mode>, Option<Mode>) {
        let first = last.as_ref().map(|(held, _)| *held);
        let mut order = self.edged.clone();
        if let Some(at) = order.iter().position(|held| Some(*held) == first) {
            order[..=at].rotate_right(1);
        }
        let mut last = last.map(|(_, values)| values);
        let mut parts = vec![ProfiledPoint {
            ln_mass: 0.0,
            scores: mode.scores.clone(),
            deviations: Vec::new(),
        }];
        let mut wide = parts[0].clone();
        let mut kept = 1.0;
        for held in order {
            let mut finer = Vec::new();
            for (n, part) in parts.iter().enumerate() {
                let profile = last.take();
                let profile = profile.unwrap_or_else(|| self.profile(&part.scores, held, left));
                let Some(stretches) = stretches(&profile) else { continue };
                if n == 0 {
                    let about = |stretch: &Stretch| {
                        let shift = stretch.mean - mode.scores[held];
                        stretch.share * (stretch.deviation * stretch.deviation + shift * shift)
                    };
                    let square: f64 = stretches.iter().map(about).sum();
                    wide.deviations.push((held, square.sqrt()));
                    kept *= stretches.iter().take(PARTS).map(|stretch| stretch.share).sum::<f64>();
                }
                let slight = |stretch: &Stretch| stretch.share < SLIGHT;
                finer.extend(stretches.into_iter().take(PARTS).filter(|s| !slight(s)).map(
                    |stretch| {
                        let mut deviations = part.deviations.clone();
                        deviations.push((held, stretch.deviation));
                        let ln_mass = part.ln_mass + elementary::ln(stretch.share);
                        ProfiledPoint { ln_mass, scores: stretch.scores, deviations }
                    },
                ));
            }
            if finer.is_empty() {
                continue;
            }
            largest_first(&mut finer, |part| part.ln_mass);
            finer.truncate(PARTS);
            parts = finer;
        }
        let modes = self.modes(&parts);
        let wide = (kept < MOST_OF_IT).then(|| {
            let mut wide = self.modes(std::slice::from_ref(&wide)).pop()?;
            // it gets as many draws as the best part, or as its part of the integral asks for
            let shares: Vec<f64> = modes.iter().map(ln_share_of_draws).collect();
            let best = shares.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let all: f64 = shares.iter().map(|ln| elementary::exp(ln - best)).sum();
            let wanted = best + elementary::ln((all * (1.0 - kept) / kept.max(SLIGHT)).max(1.0));
            wide.cost += (ln_share_of_draws(&wide) - wanted) / TEMPER;
            Some(wide)
        });
        (modes, wide.flatten())
    }

    /// Parts as modes: as wide as the profiles are along the parameters whose profiles were followed.
    fn modes(&self, parts: &[ProfiledPoint]) -> Vec<Mode> {
        let points: Vec<Vec<f64>> = parts.iter().map(|part| part.scores.clone()).collect();
        let mut modes = search::at_points(self.likelihood, &points);
        for (mode, part) in modes.iter_mut().zip(parts) {
            for &(held, deviation) in &part.deviations {
                mode.information = search::freed(&mode.information, held);
                mode.information[(held, held)] = 1.0 / (deviation * deviation).max(1e-24);
            }
        }
        modes.retain(|mode| mode.cost.is_finite());
        modes
    }

    /// The profile along one parameter, in the order of its values; empty where no more may be
    /// evaluated.
    fn profile(&self, base: &[f64], held: usize, left: &mut usize) -> Vec<Value> {
        let plan = self.plan.without(held);
        let each = (plan.linear.len() + 2) * self.likelihood.data.len().max(1);
        let most = self.scan.most(held);
        let width = 2.0 * most;
        let mut open: Vec<f64> = (0..FIRST_VALUES)
            .map(|n| most * (2.0 * n as f64 / (FIRST_VALUES - 1) as f64 - 1.0))
            .collect();
        if base[held].abs() < most && !open.contains(&base[held]) {
            open.push(base[held]);
        }
        let mut values: Vec<Value> = Vec::new();
        while !open.is_empty() && values.len() + open.len() <= MOST_VALUES {
            if *left < open.len() * each {
                break;
            }
            *left -= open.len() * each;
            values.extend(self.values(&plan, base, held, &open));
            smallest_first(&mut values, |value| value.score);
            open = to_halve(&values, width);
        }
        values
    }

    fn values(&self, plan: &ScanPlan, base: &[f64], held: usize, scores: &[f64]) -> Vec<Value> {
        let points: Vec<Vec<f64>> = scores
            .iter()
            .map(|&score| {
                let mut point = base.to_vec();
                point[held] = score;
                point
            })
            .collect();
        let solved = self.scan.at(plan, &points);
        let points: Vec<Vec<f64>> = solved.into_iter().map(|(_, best, _)| best).collect();
        let densities = densities(self.likelihood, &points);
        let value = |((&score, scores), ln): ((&f64, Vec<f64>), f64)| {
            let ln_density = if ln.is_nan() { f64::NEG_INFINITY } else { ln };
            Value { score, ln_density, scores }
        };
        scores.iter().zip(points).zip(densities).map(value).collect()
    }
}

/// The logarithm of the share of draws that the mixture gives to a mode, but for a constant.
fn ln_share_of_draws(mode: &Mode) -> f64 {
    let covariance = mode.information.clone().try_inverse();
    covariance.map_or(f64::NEG_INFINITY, |covariance| ln_share(mode, &covariance, 0.0))
}

/// The highest logarithm of the density of a profile.
fn highest(values: &[Value]) -> f64 {
    values.iter().map(|value| value.ln_density).fold(f64::NEG_INFINITY, f64::max)
}

/// The middles of the intervals that are to be halved.
fn to_halve(values: &[Value], width: f64) -> Vec<f64> {
    let highest = highest(values);
    if !highest.is_finite() {
        return Vec::new();
    }
    let density = |n: usize| elementary::exp(values[n].ln_density - highest);
    let length = |n: usize| values[n + 1].score - values[n].score;
    let intervals = values.len().saturating_sub(1);
    let total: f64 = (0..intervals).map(|n| 0.5 * length(n) * (density(n) + density(n + 1))).sum();
    let mut peaks: Vec<usize> = (0..values.len())
        .filter(|&n| {
            let own = values[n].ln_density;
            (n == 0 || own > values[n - 1].ln_density)
                && (n + 1 == values.len() || own >= values[n + 1].ln_density)
        })
        .collect();
    largest_first(&mut peaks, |&n| values[n].ln_density);
    peaks.truncate(PEAKS);
    let beside = |n: usize| {
        let edge = (values[n].ln_density - values[n + 1].ln_density).abs() > AN_EDGE;
        edge && length(n) > FINEST * width && peaks.iter().any(|&peak| peak == n || peak == n + 1)
    };
    (0..intervals)
        .filter(|&n| {
            let unknown = length(n) * (density(n) - density(n + 1)).abs() > UNKNOWN * total;
            (unknown && length(n) > 1e-9 * width) || beside(n)
        })
        .map(|n| 0.5 * (values[n].score + values[n + 1].score))
        .collect()
}

/// The stretches of a profile between its edges, those with most of the integral first; `None` where
/// there is nothing to integrate.
fn stretches(values: &[Value]) -> Option<Vec<Stretch>> {
    let highest = highest(values);
    if !highest.is_finite() || values.len() < 2 {
        return None;
    }
    let last = values.len() - 1;
    let length = |n: usize| {
        let before = values[n.saturating_sub(1)].score;
        0.5 * (values[(n + 1).min(last)].score - before)
    };
    let weights: Vec<f64> =
        (0..=last).map(|n| length(n) * elementary::exp(values[n].ln_density - highest)).collect();
    let total: f64 = weights.iter().sum();
    let mut stretches = Vec::new();
    let mut first = 0;
    for n in 0..=last {
        let ends = n == last || (values[n + 1].ln_density - values[n].ln_density).abs() > AN_EDGE;
        if !ends {
            continue;
        }
        let own = first..n + 1;
        first = n + 1;
        let sum: f64 = weights[own.clone()].iter().sum();
        if sum <= 0.0 {
            continue;
        }
        let mean = own.clone().map(|n| weights[n] * values[n].score).sum::<f64>() / sum;
        let square = |n: usize| {
            let from_mean = values[n].score - mean;
            weights[n] * (from_mean * from_mean + length(n) * length(n) / 12.0)
        };
        let variance = own.clone().map(square).sum::<f64>() / sum;
        let nearest = own.min_by(|&a, &b| {
            let distance = |n: usize| (values[n].score - mean).abs();
            distance(a).total_cmp(&distance(b))
        })?;
        let scores = values[nearest].scores.clone();
        let deviation = variance.sqrt();
        stretches.push(Stretch { share: sum / total, mean, deviation, scores });
    }
    largest_first(&mut stretches, |stretch| stretch.share);
    Some(stretches)
}
