//! Starts for the search of modes: a scan over every parameter that acts non-linearly.
//!
//! The likelihood of a frequency, of the place of a step or of a narrow line has modes that are a
//! hundredth or a thousandth of the prior wide. Draws of the prior hit them by luck, and what was not
//! hit is missing from the evidence without a sign. A scan finds them surely where it is fine enough,
//! and how fine is enough does not depend on the noise: it is the spacing at which the response of the
//! data to the effect still resembles that of the neighbouring value, as in a bank of matched filters
//! (Owen 1996, Physical Review D 53, 6749). The grid of a parameter is therefore halved wherever the
//! responses at two neighbours are not alike. At every value the other non-linear parameters are tried
//! at a few values each, and the parameters in which the response is linear are solved for in closed
//! form (variable projection; Golub and Pereyra 1973, SIAM Journal on Numerical Analysis 10, 413).

use gumption_engine::number::smallest_first;
use nalgebra::{DMatrix, DVector};

use crate::latent::{EDGE, Map, Role};
use crate::likelihood::Likelihood;
use crate::whitened::{self, WhitenedResiduals};
use gumption_engine::linalg::dot;

/// Responses are alike from this coefficient of correlation on. Halfway between such neighbours at
/// least 0.85 of the largest gain in the likelihood remains.
const ALIKE: f64 = 0.7;

/// Values of a grid before it is refined.
const FIRST_VALUES: usize = 33;

/// Values of a grid at most.
const MOST_VALUES: usize = 6000;

/// Evaluations of a value of the data at most, for each scan of a parameter; several times as many where its
/// responses differ everywhere.
const MOST_EVALUATIONS: usize = 20_000_000;

/// Normal scores are scanned within this of 0.
const FAR: f64 = 3.0;

/// Peaks of a scan that become starts.
const PEAKS: usize = 6;

/// A second difference below this share of the first is rounding: the response is linear.
const LINEAR: f64 = 1e-7;

/// Which of the scanned parameters are linear, and the grids of the others.
pub(crate) struct ScanPlan {
    pub(crate) linear: Vec<usize>,
    other: Vec<usize>,
}

impl ScanPlan {
    /// The same with one parameter held.
    pub(crate) fn without(&self, held: usize) -> Self {
        let rest =
            |parameters: &[usize]| parameters.iter().copied().filter(|&p| p != held).collect();
        Self { linear: rest(&self.linear), other: rest(&self.other) }
    }
}

/// A residual vector, whitened by the noise, and its coordinates along what is integrated out.
#[derive(Clone)]
pub(crate) struct Whitened {
    values: Vec<f64>,
    shared: Vec<f64>,
}

impl Whitened {
    fn dot(&self, other: &Self) -> f64 {
        dot(&self.values, &other.values) - dot(&self.shared, &other.shared)
    }

    /// (other - self)/by.
    fn slope(&self, other: &Self, by: f64) -> Self {
        let of = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (b - a) / by).collect();
        Self { values: of(&self.values, &other.values), shared: of(&self.shared, &other.shared) }
    }
}

/// One value of the scanned parameter.
struct Scanned {
    score: f64,
    /// For each combination of the other non-linear parameters the response to the effect.
    responses: Vec<Whitened>,
    /// The products of the responses with themselves.
    squares: Vec<f64>,
    /// Whether the responses are known to be like those of the next value.
    like_next: bool,
    cost: f64,
    /// The scores of all unknown quantities of least cost.
    best: Vec<f64>,
}

impl Scanned {
    fn without_responses(self) -> Self {
        Self { responses: Vec::new(), squares: Vec::new(), ..self }
    }

    /// Whether the responses at two values resemble each other, for all of the other parameters.
    fn is_like(&self, other: &Self) -> bool {
        let largest = |scan: &Self| scan.squares.iter().copied().fold(0.0, f64::max);
        let least = 1e-6 * largest(self).max(largest(other));
        self.responses
            .iter()
            .zip(&other.responses)
            .zip(self.squares.iter().zip(&other.squares))
            .all(|((a, b), (aa, bb))| {
                aa.max(*bb) <= least
                    || !(aa * bb).is_finite()
                    || a.dot(b).abs() >= ALIKE * (aa * bb).sqrt()
            })
    }
}

/// Where to search for modes: the best points of scans over the scores in `scanned`, with everything
/// else as in `base`.
pub(crate) fn starts(
    likelihood: &Likelihood<'_>,
    base: &[f64],
    scanned: std::ops::Range<usize>,
) -> Vec<Vec<f64>> {
    let Some(scan) = Scan::about(likelihood, base, FAR) else { return Vec::new() };
    let Some(plan) = scan.plan(scanned.collect()) else { return Vec::new() };
    if plan.other.is_empty() {
        return scan.at(&plan, &[base.to_vec()]).into_iter().map(|(_, best, _)| best).collect();
    }
    plan.other.iter().flat_map(|&held| peaks(scan.over(&plan, held))).collect()
}

/// What is scanned, and about which point.
pub(crate) struct Scan<'l, 'c> {
    likelihood: &'l Likelihood<'c>,
    base: Vec<f64>,
    /// Normal scores are scanned within this of 0.
    far: f64,
    /// The residuals at the base, with which responses are compared.
    without: Whitened,
}

/// The whitened residuals at points, and their coordinates along what is integrated out.
fn whitened_at(likelihood: &Likelihood<'_>, points: &[Vec<f64>]) -> Vec<Whitened> {
    let covariance = likelihood.covariance;
    let of = |found: WhitenedResiduals| {
        // with estimated noise the scan leaves out what is integrated linearly: it only has to come
        // near
        let shared = if covariance.fitted || covariance.basis.is_empty() {
            Vec::new()
        } else {
            covariance.project(&found.values)
        };
        Whitened { values: found.values, shared }
    };
    whitened::residuals(likelihood, points).into_iter().map(of).collect()
}

impl<'l, 'c> Scan<'l, 'c> {
    /// A scan with everything else as in `base`, of normal scores within `far` of 0.
    pub(crate) fn about(likelihood: &'l Likelihood<'c>, base: &[f64], far: f64) -> Option<Self> {
        let without = whitened_at(likelihood, &[base.to_vec()]).pop()?;
        Some(Self { likelihood, base: base.to_vec(), far, without })
    }

    fn map(&self, of: usize) -> Option<&Map> {
        match self.likelihood.roles.get(of)? {
            Role::Variable { maps, .. } => maps.first(),
            Role::Noise { map, .. } | Role::Power { map, .. } => Some(map),
        }
    }

    /// Within which distance of 0 a score is scanned.
    pub(crate) fn most(&self, of: usize) -> f64 {
        if self.map(of).is_some_and(Map::is_bounded) { EDGE } else { self.far }
    }

    fn value(&self, of: usize, score: f64) -> f64 {
        self.map(of).map_or(f64::NAN, |map| map.value(score))
    }

    /// The score of a value, within what is scanned; values rise with their scores.
    fn score(&self, of: usize, value: f64) -> f64 {
        let most = self.most(of);
        let (mut low, mut high) = (-most, most);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.value(of, middle) < value {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }

    /// The whitened residuals at points, whatever their number.
    fn residuals(&self, points: &[Vec<f64>]) -> Vec<Whitened> {
        whitened_at(self.likelihood, points)
    }

    /// Whether the response is linear in each parameter and in those together; `None` where nothing
    /// is to be scanned.
    pub(crate) fn plan(&self, all: Vec<usize>) -> Option<ScanPlan> {
        if all.is_empty() {
            return None;
        }
        let mut linear: Vec<usize> = Vec::new();
        for &p in &all {
            // second differences in this parameter, alone and with those that are linear already,
            // at two settings of everything else
            let is_linear = [0.31, -0.57].iter().all(|&elsewhere| {
                let mut middle = self.base.to_vec();
                for &other in &all {
                    middle[other] = elsewhere;
                }
                let at = |moves: &[(usize, f64)]| {
                    let mut point = middle.clone();
                    for &(parameter, score) in moves {
                        point[parameter] = score;
                    }
                    point
                };
                let scores = [-0.8, 0.1, 1.1];
                let values = scores.map(|score| self.value(p, score));
                let mut points: Vec<Vec<f64>> = scores.iter().map(|&s| at(&[(p, s)])).collect();
                for &other in &linear {
                    points.extend(
                        [(-0.8, -0.8), (1.1, -0.8), (-0.8, 1.1), (1.1, 1.1)]
                            .map(|(a, b)| at(&[(p, a), (other, b)])),
                    );
                }
                let found = self.residuals(&points);
                let line = found[0].slope(&found[2], values[2] - values[0]);
                let part = found[0].slope(&found[1], values[1] - values[0]);
                let size = line.dot(&line).max(part.dot(&part));
                let bend = line.slope(&part, 1.0);
                let straight = bend.dot(&bend) <= LINEAR * LINEAR * size * 1e4 && size.is_finite();
                straight
                    && found[3..].chunks_exact(4).all(|four| {
                        let (here, there) =
                            (four[0].slope(&four[1], 1.0), four[2].slope(&four[3], 1.0));
                        let mixed = here.slope(&there, 1.0);
                        let size = here.dot(&here).max(there.dot(&there));
                        mixed.dot(&mixed) <= LINEAR * LINEAR * size * 1e4
                    })
            });
            if is_linear {
                linear.push(p);
            }
        }
        let other = all.into_iter().filter(|p| !linear.contains(p)).collect();
        Some(ScanPlan { linear, other })
    }

    /// The least cost over the linear parameters at points, with the whole point and the response.
    pub(crate) fn at(
        &self,
        plan: &ScanPlan,
        points: &[Vec<f64>],
    ) -> Vec<(f64, Vec<f64>, Whitened)> {
        let group = plan.linear.len() + 1;
        const STEP: f64 = 0.5;
        let mut asked = Vec::with_capacity(points.len() * group);
        for point in points {
            let mut middle = point.clone();
            for &p in &plan.linear {
                middle[p] = 0.0;
            }
            asked.push(middle.clone());
            for &p in &plan.linear {
                let mut moved = middle.clone();
                moved[p] = STEP;
                asked.push(moved);
            }
        }
        let found = self.residuals(&asked);
        asked
            .chunks_exact(group)
            .zip(found.chunks_exact(group))
            .map(|(points, residuals)| self.solved(plan, &points[0], residuals))
            .collect()
    }

    fn solved(
        &self,
        plan: &ScanPlan,
        middle: &[f64],
        residuals: &[Whitened],
    ) -> (f64, Vec<f64>, Whitened) {
        let own = &residuals[0];
        let mut best = middle.to_vec();
        let mut square = own.dot(own);
        // what this point moves the residuals by, with the first linear parameter where there is one
        let mut response = own.slope(&self.without, 1.0);
        if !plan.linear.is_empty() {
            let k = plan.linear.len();
            let middles: Vec<f64> = plan.linear.iter().map(|&p| self.value(p, 0.0)).collect();
            let steps: Vec<f64> = plan
                .linear
                .iter()
                .zip(&middles)
                .map(|(&p, middle)| self.value(p, 0.5) - middle)
                .collect();
            // residuals fall by `columns` times the parameters' moves
            let columns: Vec<Whitened> = residuals[1..]
                .iter()
                .zip(&steps)
                .map(|(moved, step)| moved.slope(own, *step))
                .collect();
            let scales: Vec<Option<f64>> = plan
                .linear
                .iter()
                .map(|&p| match self.map(p) {
                    Some(Map::Normal { deviation, .. }) => Some(*deviation),
                    _ => None,
                })
                .collect();
            let matrix = DMatrix::from_fn(k, k, |i, j| {
                let prior = if i == j { scales[i].map_or(0.0, |sd| 1.0 / (sd * sd)) } else { 0.0 };
                let ridge = if i == j { 1.0 + 1e-9 } else { 1.0 };
                columns[i].dot(&columns[j]) * ridge + prior
            });
            let products = DVector::from_fn(k, |i, _| columns[i].dot(own));
            if let Some(root) = matrix.cholesky() {
                let moves = root.solve(&products);
                for (i, &p) in plan.linear.iter().enumerate() {
                    best[p] = self.score(p, middles[i] + moves[i]);
                }
            }
            let moves: Vec<f64> = plan
                .linear
                .iter()
                .zip(&middles)
                .map(|(&p, middle)| self.value(p, best[p]) - middle)
                .collect();
            for i in 0..k {
                square -= 2.0 * moves[i] * columns[i].dot(own);
                for j in 0..k {
                    square += moves[i] * moves[j] * columns[i].dot(&columns[j]);
                }
            }
            if let Some(first) = columns.into_iter().next() {
                response = first;
            }
        }
        let bounded = |p: usize| self.map(p).is_some_and(Map::is_bounded);
        let prior: f64 = (0..best.len()).filter(|&p| !bounded(p)).map(|p| best[p] * best[p]).sum();
        let cost = 0.5 * (square + prior);
        (if cost.is_finite() { cost } else { f64::INFINITY }, best, response)
    }

    /// Scores of the non-linear parameters other than the scanned one, in all combinations.
    fn combinations(&self, plan: &ScanPlan, held: usize) -> Vec<Vec<f64>> {
        let others: Vec<usize> = plan.other.iter().copied().filter(|&p| p != held).collect();
        let each = match others.len() {
            0 => 1,
            1 => 8,
            2 => 4,
            3 => 3,
            _ => 1,
        };
        let mut all = vec![self.base.to_vec()];
        for parameter in others {
            let most = if self.map(parameter).is_some_and(Map::is_bounded) { EDGE } else { 1.6 };
            all = all
                .into_iter()
                .flat_map(|point| {
                    (0..each).map(move |n| {
                        let mut point = point.clone();
                        point[parameter] = most * ((2 * n + 1) as f64 / each as f64 - 1.0);
                        point
                    })
                })
                .collect();
        }
        all
    }

    fn scanned(
        &self,
        plan: &ScanPlan,
        held: usize,
        others: &[Vec<f64>],
        scores: &[f64],
    ) -> Vec<Scanned> {
        let points: Vec<Vec<f64>> = scores
            .iter()
            .flat_map(|&score| {
                others.iter().map(move |point| {
                    let mut point = point.clone();
                    point[held] = score;
                    point
                })
            })
            .collect();
        let found = self.at(plan, &points);
        let mut found = found.into_iter();
        scores
            .iter()
            .map(|&score| {
                let own: Vec<_> = found.by_ref().take(others.len()).collect();
                let mut scanned = Scanned {
                    score,
                    responses: Vec::with_capacity(own.len()),
                    squares: Vec::with_capacity(own.len()),
                    like_next: false,
                    cost: f64::INFINITY,
                    best: self.base.to_vec(),
                };
                for (cost, best, response) in own {
                    if cost < scanned.cost {
                        scanned.cost = cost;
                        scanned.best = best;
                    }
                    scanned.squares.push(response.dot(&response));
                    scanned.responses.push(response);
                }
                scanned
            })
            .collect()
    }

    /// The scan over one parameter: values in order with their costs.
    fn over(&self, plan: &ScanPlan, held: usize) -> Vec<Scanned> {
        let others = self.combinations(plan, held);
        let most = self.most(held);
        let values = self.likelihood.data.len().max(1);
        let each = others.len() * (plan.linear.len() + 1) * values;
        let affordable = (MOST_EVALUATIONS / each).min(MOST_VALUES) / 8;
        let first: Vec<f64> = (0..FIRST_VALUES)
            .map(|n| most * (2.0 * n as f64 / (FIRST_VALUES - 1) as f64 - 1.0))
            .collect();
        let mut whole = Vec::new();
        let mut ends = self.scanned(plan, held, &others, &first).into_iter();
        let mut last = ends.next();
        // one stretch after the other, as responses take room
        for next in ends {
            let mut stretch: Vec<Scanned> = last.into_iter().chain([next]).collect();
            loop {
                let mut open = Vec::new();
                for n in 1..stretch.len() {
                    if !stretch[n - 1].like_next {
                        let like = stretch[n - 1].is_like(&stretch[n]);
                        stretch[n - 1].like_next = like;
                        if !like {
                            open.push(0.5 * (stretch[n - 1].score + stretch[n].score));
                        }
                    }
                }
                if open.is_empty() || stretch.len() + open.len() > affordable {
                    break;
                }
                stretch.extend(self.scanned(plan, held, &others, &open));
                smallest_first(&mut stretch, |a| a.score);
            }
            last = stretch.pop();
            whole.extend(stretch.into_iter().map(Scanned::without_responses));
        }
        whole.extend(last);
        whole
    }
}

/// The points of the least costs among their neighbours, best first.
fn peaks(grid: Vec<Scanned>) -> Vec<Vec<f64>> {
    let cost = |n: usize| grid.get(n).map_or(f64::INFINITY, |scanned| scanned.cost);
    // of neighbours that are equal the last one counts, if those before are not lower
    let mut before = f64::INFINITY;
    let mut peaks = Vec::new();
    for n in 0..grid.len() {
        if cost(n) == cost(n + 1) {
            continue;
        }
        if cost(n).is_finite() && cost(n) < before && cost(n) < cost(n + 1) {
            peaks.push(n);
        }
        before = cost(n);
    }
    smallest_first(&mut peaks, |&a| cost(a));
    peaks.truncate(PEAKS);
    let mut grid: Vec<Option<Vec<f64>>> = grid.into_iter().map(|s| Some(s.best)).collect();
    peaks.into_iter().filter_map(|n| grid[n].take()).collect()
}
