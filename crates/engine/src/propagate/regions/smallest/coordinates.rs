//! Coordinates in which trials are nearly normal.

use super::components::components;
use super::{TOGETHER, TrialPlace};
use crate::linalg::packed;
use crate::number::elementary::{exp, ln};
use crate::parallel;
use crate::special;

/// The distance of the knots of a score.
const STEP: f64 = 0.25;

/// The trials beyond the last knot of a score.
const TAIL: f64 = 8.0;

/// The share of equal values from which on a quantity takes single values.
const EQUAL: f64 = 1e-3;

/// Coordinates that the trials have a nearly normal distribution in, and the density of the coordinates:
/// how much of their volume there is to the volume of a place.
pub(super) enum Coordinates {
    /// Normal scores of linear combinations of the places, without their correlation.
    Scores {
        /// The combinations, row by row.
        combinations: Vec<f64>,
        scores: Vec<Monotone>,
        /// The Cholesky root of the scores' covariance matrix.
        root: Vec<f64>,
        /// The modulus of the determinant of the combinations over that of the root.
        determinant: f64,
    },
    /// The places, their distances from 0 being those of a normal distribution.
    Radial {
        /// From the logarithm of the distance to that of the other one.
        distance: Monotone,
        order: usize,
    },
}

impl Coordinates {
    /// Scores of the outputs, whose deviations this lower triangle makes of the places; `None` where
    /// one takes single values.
    pub(super) fn outputs(trials: &[TrialPlace], to_outputs: &[f64]) -> Option<Self> {
        let order = packed::rows(to_outputs).len();
        let mut combinations = vec![0.0; order * order];
        for (row, to) in combinations.chunks_mut(order).zip(packed::rows(to_outputs)) {
            row[..to.len()].copy_from_slice(to);
        }
        Self::scores(trials, order, combinations)
    }

    /// Scores of components that are independent as far as there are any.
    pub(super) fn components(trials: &[TrialPlace], to_outputs: &[f64]) -> Option<Self> {
        let order = packed::rows(to_outputs).len();
        Self::scores(trials, order, components(trials, order))
    }

    /// The places with other distances.
    pub(super) fn radial(trials: &[TrialPlace], to_outputs: &[f64]) -> Option<Self> {
        let order = packed::rows(to_outputs).len();
        let mut distances: Vec<f64> =
            trials.iter().map(|place| ln(length(&place[..order]))).collect();
        let score = |p: f64| {
            let square = 2.0 * special::gamma::quantile(p, 0.5 * order as f64);
            0.5 * ln(square)
        };
        Some(Self::Radial { distance: Monotone::of_quantiles(&mut distances, score)?, order })
    }

    fn scores(trials: &[TrialPlace], order: usize, combinations: Vec<f64>) -> Option<Self> {
        let of_row = |row: &[f64]| {
            let mut values: Vec<f64> = trials.iter().map(|place| product(row, place)).collect();
            Monotone::of_quantiles(&mut values, special::normal::quantile)
        };
        let scores = parallel::map(combinations.chunks(order), of_row);
        let scores: Vec<Monotone> = scores.into_iter().collect::<Option<_>>()?;
        let mut root = covariance(trials, order, |place| {
            let mut at = TrialPlace::default();
            for ((at, row), score) in at.iter_mut().zip(combinations.chunks(order)).zip(&scores) {
                *at = score.at(product(row, place)).0;
            }
            at
        });
        packed::cholesky(&mut root, 1e-6).ok()?;
        let size = nalgebra::DMatrix::from_row_slice(order, order, &combinations).determinant();
        let determinant = size.abs() * exp(-packed::ln_diagonal(&root));
        Some(Self::Scores { combinations, scores, root, determinant })
    }

    /// The coordinates of a place, and their density there.
    pub(super) fn of(&self, place: &TrialPlace) -> (TrialPlace, f64) {
        let mut at = TrialPlace::default();
        match self {
            Self::Scores { combinations, scores, root, determinant } => {
                let mut density = *determinant;
                let rows = combinations.chunks(scores.len());
                for ((at, row), score) in at.iter_mut().zip(rows).zip(scores) {
                    let (own, slope) = score.at(product(row, place));
                    *at = own;
                    density *= slope;
                }
                packed::solve(root, &mut at[..scores.len()]);
                (at, density)
            }
            Self::Radial { distance, order } => {
                let from = ln(length(&place[..*order]));
                let (to, slope) = distance.at(from);
                let factor = exp(to - from);
                for (at, x) in at.iter_mut().zip(&place[..*order]) {
                    *at = x * factor;
                }
                (at, slope * exp((to - from) * *order as f64))
            }
        }
    }

    /// The density of the coordinates at these coordinates.
    pub(super) fn density_at(&self, at: &TrialPlace) -> f64 {
        match self {
            Self::Scores { scores, root, determinant, .. } => {
                let rows = packed::rows(root).map(|row| product(row, at));
                let slopes = scores.iter().zip(rows).map(|(score, own)| score.slope_back(own).1);
                determinant * slopes.product::<f64>()
            }
            Self::Radial { distance, order } => {
                let to = ln(length(&at[..*order]));
                let (from, slope) = distance.slope_back(to);
                slope * exp((to - from) * *order as f64)
            }
        }
    }
}

/// The length of a vector, not 0, whose logarithm would be none.
fn length(vector: &[f64]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt().max(1e-150)
}

/// A combination of a place's coordinates.
#[inline]
fn product(row: &[f64], place: &TrialPlace) -> f64 {
    row.iter().zip(place).map(|(c, x)| c * x).sum()
}

/// The covariance matrix of what is made of the trials, as a packed triangle.
fn covariance(
    trials: &[TrialPlace],
    order: usize,
    of: impl Fn(&TrialPlace) -> TrialPlace + Sync,
) -> Vec<f64> {
    let pairs: Vec<(usize, usize)> =
        (0..order).flat_map(|i| (0..=i).map(move |j| (i, j))).collect();
    let some = |chunk: &[TrialPlace]| {
        let (mut sums, mut products) = (TrialPlace::default(), vec![0.0; pairs.len()]);
        for place in chunk {
            let at = of(place);
            sums.iter_mut().zip(at).for_each(|(sum, x)| *sum += x);
            products.iter_mut().zip(&pairs).for_each(|(sum, (i, j))| *sum += at[*i] * at[*j]);
        }
        (sums, products)
    };
    let none = (TrialPlace::default(), vec![0.0; pairs.len()]);
    let all = parallel::map(trials.chunks(TOGETHER), some).into_iter();
    let (sums, products) = all.fold(none, |(mut sums, mut products), (more, others)| {
        sums.iter_mut().zip(more).for_each(|(sum, x)| *sum += x);
        products.iter_mut().zip(others).for_each(|(sum, x)| *sum += x);
        (sums, products)
    });
    let count = trials.len() as f64;
    let covariance = |(&(i, j), product): (&(usize, usize), f64)| {
        product / count - sums[i] / count * (sums[j] / count)
    };
    pairs.iter().zip(products).map(covariance).collect()
}

/// A function that grows: cubics between knots with slopes by Fritsch and Butland (SIAM J. Sci. Stat.
/// Comput. 5 (1984) 300), lines beyond them.
pub(super) struct Monotone {
    from: Vec<f64>,
    to: Vec<f64>,
    slopes: Vec<f64>,
}

impl Monotone {
    /// From the quantiles of the values to those of another distribution, by its quantile function;
    /// `None` where the values have no density. The values are sorted.
    fn of_quantiles(values: &mut [f64], quantile: impl Fn(f64) -> f64) -> Option<Self> {
        crate::number::ascending(values);
        let count = values.len();
        let equal = values.windows(2).filter(|pair| pair[0] == pair[1]).count();
        if equal as f64 > EQUAL * count as f64 {
            return None;
        }
        let last = (special::normal::quantile_upper(TAIL / count as f64) / STEP).floor();
        let scores = (0..=2 * last as usize).map(|knot| (knot as f64 - last) * STEP);
        let (mut from, mut to) = (Vec::new(), Vec::new());
        for score in scores {
            let p = special::normal::cdf(score);
            let rank = p * count as f64 - 0.5;
            let below = (rank.max(0.0) as usize).min(count - 2);
            let beyond = rank - below as f64;
            from.push(values[below] + beyond * (values[below + 1] - values[below]));
            to.push(quantile(p));
        }
        Self::new(from, to)
    }

    /// `None` unless both grow from knot to knot.
    fn new(from: Vec<f64>, to: Vec<f64>) -> Option<Self> {
        let rises = |values: &[f64]| values.windows(2).all(|pair| pair[0] < pair[1]);
        if from.len() < 2 || !rises(&from) || !rises(&to) {
            return None;
        }
        let steps = from.windows(2).zip(to.windows(2));
        let steps: Vec<(f64, f64)> =
            steps.map(|(x, y)| (x[1] - x[0], (y[1] - y[0]) / (x[1] - x[0]))).collect();
        let inner = steps.windows(2).map(|pair| {
            let [(a, before), (b, after)] = [pair[0], pair[1]];
            3.0 * (a + b) / ((a + 2.0 * b) / before + (2.0 * a + b) / after)
        });
        let ends = |step: Option<&(f64, f64)>| step.map(|(_, slope)| *slope);
        let slopes = ends(steps.first()).into_iter().chain(inner).chain(ends(steps.last()));
        let slopes = slopes.collect();
        Some(Self { from, to, slopes })
    }

    /// The value at x and the slope there.
    fn at(&self, x: f64) -> (f64, f64) {
        let after = self.from.partition_point(|knot| *knot <= x);
        let Some(cubic) = self.piece(after) else {
            let end = if after == 0 { 0 } else { self.from.len() - 1 };
            let slope = self.slopes[end];
            return (self.to[end] + slope * (x - self.from[end]), slope);
        };
        cubic.at(x - self.from[after - 1])
    }

    /// Where the value is y, and the slope there.
    fn slope_back(&self, y: f64) -> (f64, f64) {
        let after = self.to.partition_point(|knot| *knot <= y);
        let Some(cubic) = self.piece(after) else {
            let end = if after == 0 { 0 } else { self.to.len() - 1 };
            let slope = self.slopes[end];
            return (self.from[end] + (y - self.to[end]) / slope, slope);
        };
        let (offset, slope) = cubic.back(y);
        (self.from[after - 1] + offset, slope)
    }

    /// The cubic before a knot; `None` of the first, and behind the last.
    fn piece(&self, after: usize) -> Option<Cubic> {
        let before = after.checked_sub(1)?;
        let length = self.from.get(after)? - self.from[before];
        let secant = (self.to[after] - self.to[before]) / length;
        let (first, last) = (self.slopes[before], self.slopes[after]);
        Some(Cubic {
            length,
            coefficients: [
                self.to[before],
                first,
                (3.0 * secant - 2.0 * first - last) / length,
                (first + last - 2.0 * secant) / (length * length),
            ],
        })
    }
}

/// A cubic of the distance from a knot that grows up to the next.
struct Cubic {
    length: f64,
    coefficients: [f64; 4],
}

impl Cubic {
    fn at(&self, x: f64) -> (f64, f64) {
        let [a, b, c, d] = self.coefficients;
        (a + x * (b + x * (c + x * d)), b + x * (2.0 * c + x * 3.0 * d))
    }

    /// Where the value is y, to twelve digits of the length, and the slope there: Newton's steps, which
    /// are halved intervals where they leave what is known.
    fn back(&self, y: f64) -> (f64, f64) {
        let (mut low, mut high) = (0.0, self.length);
        let mut x = 0.5 * self.length;
        for _ in 0..60 {
            let (value, slope) = self.at(x);
            if value > y {
                high = x;
            } else {
                low = x;
            }
            let next = x - (value - y) / slope;
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            let moved = (next - x).abs();
            x = next;
            if moved <= 1e-12 * self.length {
                break;
            }
        }
        (x, self.at(x).1)
    }
}
