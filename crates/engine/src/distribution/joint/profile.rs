//! A quantity as a function of a standard normal one: quantile(Phi(z)), tabulated.
//!
//! The axis of z is divided into cells a quarter wide. In each cell the function is a polynomial
//! through its values at the eight nodes of the Gauss-Legendre rule, so that the same numbers serve
//! integrals and draws. If a cell's polynomial deviates from the function, at the ends or in the
//! middle, the cell is halved again for the integrals (kinks, steps of empirical distributions),
//! and draws in that cell use the quantile function itself.

use std::sync::Arc;

use crate::distribution::{Distribution, SavedResult};
use crate::number::{COLUMN, smallest_first};
use crate::special;

/// Nodes of a cell.
pub(super) const NODES: usize = 8;

/// The Gauss-Legendre rule of eight points on \[-1, 1\]: nodes, in order, and weights.
const RULE: [(f64, f64); NODES] = [
    (-0.960_289_856_497_536_231_68, 0.101_228_536_290_376_259_15),
    (-0.796_666_477_413_626_739_59, 0.222_381_034_453_374_470_54),
    (-0.525_532_409_916_328_985_82, 0.313_706_645_877_887_287_34),
    (-0.183_434_642_495_649_804_94, 0.362_683_783_378_361_982_97),
    (0.183_434_642_495_649_804_94, 0.362_683_783_378_361_982_97),
    (0.525_532_409_916_328_985_82, 0.313_706_645_877_887_287_34),
    (0.796_666_477_413_626_739_59, 0.222_381_034_453_374_470_54),
    (0.960_289_856_497_536_231_68, 0.101_228_536_290_376_259_15),
];

/// Width of a cell.
const WIDTH: f64 = 0.25;

/// Number of cells on either side of 0 in the table for draws. One standard normal value in 1e19
/// lies beyond.
const TABLE: i32 = 36;

/// Maximum number of cells on either side of 0. Beyond z = 37 a tail is below the smallest doubles.
const MOST: i32 = 148;

/// Maximum number of pieces for integrals.
const MOST_PIECES: usize = 8192;

/// Allowed error of a polynomial in an integral: deviation in standard deviations times width times
/// density of z.
const INTEGRAL: f64 = 1e-10;

/// Allowed error of a polynomial in a draw, as a fraction of its change over the cell.
const DRAW: f64 = 1e-9;

/// 1 / sqrt(2 pi).
const DENSITY: f64 = 0.398_942_280_401_432_677_94;

/// The density of a standard normal quantity.
pub(super) fn density(z: f64) -> f64 {
    DENSITY * libm::exp(-0.5 * z * z)
}

/// The value of a quantity at `z` of a standard normal one with which it increases. Never infinite:
/// the tails end at 37.
pub(super) fn at_normal(distribution: &Distribution, z: f64) -> f64 {
    if let Some(saved) = distribution.saved() {
        return saved.at(z);
    }
    let z = z.clamp(-37.0, 37.0);
    if z < 0.0 {
        distribution.quantile(special::normal::cdf(z))
    } else {
        distribution.quantile_upper(special::normal::sf(z))
    }
}

/// A polynomial over \[-1, 1\], the constant first.
type Polynomial = [f64; NODES];

/// The polynomial through `values` at the nodes: Legendre coefficients by the rule, which is exact
/// for them, then sorted by powers. One value is subtracted first, so that rounding is relative to
/// their change.
fn through(values: &[f64; NODES]) -> Polynomial {
    let base = values[NODES / 2];
    let mut sum = [0.0; NODES];
    let (mut before, mut legendre) = ([0.0; NODES], [0.0; NODES]);
    legendre[0] = 1.0;
    for k in 0..NODES {
        let terms = RULE.iter().zip(values);
        let projection: f64 = terms.map(|((t, w), v)| w * (v - base) * horner(&legendre, *t)).sum();
        let coefficient = (k as f64 + 0.5) * projection;
        for (s, l) in sum.iter_mut().zip(&legendre) {
            *s += coefficient * l;
        }
        // (k + 1) P_(k+1) = (2 k + 1) t P_k - k P_(k-1)
        let mut next = [0.0; NODES];
        let k = k as f64;
        for i in 0..NODES {
            let raised = if i > 0 { legendre[i - 1] } else { 0.0 };
            next[i] = ((2.0 * k + 1.0) * raised - k * before[i]) / (k + 1.0);
        }
        (before, legendre) = (legendre, next);
    }
    sum[0] += base;
    sum
}

#[inline(always)]
fn horner(polynomial: &Polynomial, t: f64) -> f64 {
    polynomial.iter().rev().fold(0.0, |sum, c| sum * t + c)
}

/// The function over one interval of z, in standard deviations from the mean.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    left: f64,
    width: f64,
    values: [f64; NODES],
    polynomial: Polynomial,
}

impl Piece {
    fn middle(&self) -> f64 {
        self.left + 0.5 * self.width
    }

    fn at(&self, z: f64) -> f64 {
        horner(&self.polynomial, (z - self.middle()) / (0.5 * self.width))
    }

    /// The nodes: z, the weight of dz there, and the value.
    pub(super) fn nodes(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        let (middle, half) = (self.middle(), 0.5 * self.width);
        RULE.iter().zip(&self.values).map(move |((t, w), &v)| (middle + half * t, half * w, v))
    }

    /// The same function of -z.
    fn mirrored(&self) -> Self {
        let mut piece = self.clone();
        piece.left = -(self.left + self.width);
        piece.values.reverse();
        for odd in piece.polynomial.iter_mut().skip(1).step_by(2) {
            *odd = -*odd;
        }
        piece
    }

    /// The contribution to the variance: the integral of the square under the normal density.
    fn variance(&self) -> f64 {
        self.nodes().map(|(z, w, v)| w * density(z) * v * v).sum()
    }
}

/// A cell of the table for draws: the value minus the mean as a polynomial, and the values at both
/// ends, which bound the draws.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    polynomial: Polynomial,
    low: f64,
    high: f64,
}

/// Number of entries of the table: cells, and further entries without a cell.
const PLACES: usize = 128;

/// An entry without a cell, for values outside the table.
const OUTSIDE: i32 = PLACES as i32 - 1;

/// The values of a quantity at standard normal ones: cells on \[-9, 9\]. Entries without a cell are
/// NaN, and the quantile function itself is used.
#[derive(Clone, Debug)]
pub(super) struct Table {
    distribution: Arc<Distribution>,
    mean: f64,
    /// For each power the coefficients by entry.
    polynomials: Box<[[f64; PLACES]; NODES]>,
    low: Box<[f64; PLACES]>,
    high: Box<[f64; PLACES]>,
}

impl Table {
    fn new(distribution: &Arc<Distribution>, mean: f64, cells: &[Option<Cell>]) -> Self {
        let none = || Box::new([f64::NAN; PLACES]);
        let (mut low, mut high) = (none(), none());
        let mut polynomials = Box::new([[f64::NAN; PLACES]; NODES]);
        for (place, cell) in cells.iter().enumerate().take(OUTSIDE as usize) {
            let Some(cell) = cell else { continue };
            (low[place], high[place]) = (cell.low, cell.high);
            for (powers, coefficient) in polynomials.iter_mut().zip(cell.polynomial) {
                powers[place] = coefficient;
            }
        }
        Self { distribution: Arc::clone(distribution), mean, polynomials, low, high }
    }

    /// Whether both belong to the same distribution.
    pub(super) fn is_of(&self, other: &Self) -> bool {
        self.distribution == other.distribution
    }

    /// The values of a column, operation by operation, so that several are computed at a time.
    #[inline(always)]
    pub(super) fn values(&self, z: &[f64; COLUMN], out: &mut [f64; COLUMN]) {
        let mut places = [OUTSIDE; COLUMN];
        let mut t = [0.0; COLUMN];
        for ((place, t), z) in places.iter_mut().zip(&mut t).zip(z) {
            let position = (z + f64::from(TABLE) * WIDTH) / WIDTH;
            let is_inside = position >= 0.0 && position < f64::from(2 * TABLE);
            *place = if is_inside { position as i32 } else { OUTSIDE };
            *t = 2.0 * (position - f64::from(*place)) - 1.0;
        }
        let at = |of: &[f64; PLACES], place: i32| of[place as usize % PLACES];
        let mut sums = [0.0; COLUMN];
        for powers in self.polynomials.iter().rev() {
            for ((sum, t), place) in sums.iter_mut().zip(&t).zip(&places) {
                *sum = *sum * t + at(powers, *place);
            }
        }
        let mut all = true;
        for ((out, sum), place) in out.iter_mut().zip(&sums).zip(&places) {
            *out = (self.mean + sum).max(at(&self.low, *place)).min(at(&self.high, *place));
            all &= !out.is_nan();
        }
        if !all {
            self.fill(z, out);
        }
    }

    /// The quantile function where the table has no cell.
    #[inline(never)]
    fn fill(&self, z: &[f64; COLUMN], out: &mut [f64; COLUMN]) {
        for (z, out) in z.iter().zip(out).filter(|(_, out)| out.is_nan()) {
            *out = at_normal(&self.distribution, *z);
        }
    }

    /// Number of cells with |z| below 6 that need the quantile function itself.
    #[cfg(test)]
    fn exact_cells(&self) -> usize {
        self.low.iter().skip(12).take(48).filter(|low| low.is_nan()).count()
    }
}

/// The tabulated function of one quantity.
#[derive(Clone, Debug)]
pub(super) struct Profile {
    /// In the order of z.
    pieces: Vec<Piece>,
    /// The variance contained in the pieces: 1 apart from tails beyond the range of doubles.
    pub(super) variance: f64,
}

impl Profile {
    /// The profile of a distribution that has a variance, and its table for draws.
    pub(super) fn of(distribution: &Arc<Distribution>) -> (Self, Table) {
        let mean =
            distribution.saved().map_or_else(|| distribution.mean(), SavedResult::drawn_mean);
        let std = distribution.standard_deviation();
        let (profile, cells) = Self::new(mean, std, |z| at_normal(distribution, z));
        (profile, Table::new(distribution, mean, &cells))
    }

    /// The profile of an increasing function of z with this mean and standard deviation, and the
    /// cells of its table.
    pub(super) fn new(
        mean: f64,
        std: f64,
        value: impl Fn(f64) -> f64,
    ) -> (Self, Vec<Option<Cell>>) {
        let sampler = Sampler { mean, std, value };
        let mut pieces = Vec::new();
        let mut cells: Vec<Option<Cell>> = vec![None; 2 * TABLE as usize];
        let mut open = Vec::new();
        let mut rough_variance = 0.0;
        for number in 0..MOST {
            let mut added = 0.0;
            for cell in [number, -1 - number] {
                let sampled = sampler.piece(f64::from(cell) * WIDTH, WIDTH);
                added += sampled.piece.variance();
                if number < TABLE {
                    cells[(cell + TABLE) as usize] = sampled.cell(&sampler);
                }
                open.push(sampled);
            }
            rough_variance += added;
            let complete = added < 1e-17 && (rough_variance - 1.0).abs() < 1e-9;
            if number + 1 >= TABLE && complete {
                break;
            }
        }
        // halved level by level, so that the limit on pieces drops only the finest ones
        while !open.is_empty() {
            let mut halves = Vec::new();
            for sampled in open {
                if sampled.is_settled() || pieces.len() + halves.len() >= MOST_PIECES {
                    pieces.push(sampled.piece);
                } else {
                    let (left, half) = (sampled.piece.left, 0.5 * sampled.piece.width);
                    halves.push(sampler.piece(left, half));
                    halves.push(sampler.piece(left + half, half));
                }
            }
            open = halves;
        }
        smallest_first(&mut pieces, |piece| piece.left);
        let variance = pieces.iter().map(Piece::variance).sum();
        (Self { pieces, variance }, cells)
    }

    pub(super) fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// The mean of the product with another quantity that increases with it: the correlation
    /// coefficient of comonotone quantities.
    pub(super) fn comonotone(&self, other: &Self) -> f64 {
        product(&self.pieces, &other.pieces)
    }

    /// The same for a quantity that decreases as this one increases.
    pub(super) fn antimonotone(&self, other: &Self) -> f64 {
        let mirrored: Vec<Piece> = other.pieces.iter().rev().map(Piece::mirrored).collect();
        product(&self.pieces, &mirrored)
    }
}

/// The mean of the product of two functions of the same standard normal quantity. Pieces result
/// from halving the same cells, so one of two overlapping pieces lies within the other.
fn product(a: &[Piece], b: &[Piece]) -> f64 {
    let (mut i, mut j, mut sum) = (0, 0, 0.0);
    while let (Some(p), Some(q)) = (a.get(i), b.get(j)) {
        let (fine, coarse) = if p.width <= q.width { (p, q) } else { (q, p) };
        let end = fine.left + fine.width;
        if fine.left >= coarse.left && end <= coarse.left + coarse.width {
            sum += fine.nodes().map(|(z, w, v)| w * density(z) * v * coarse.at(z)).sum::<f64>();
        }
        let (p_end, q_end) = (p.left + p.width, q.left + q.width);
        if p_end <= q_end {
            i += 1;
        }
        if q_end <= p_end {
            j += 1;
        }
    }
    sum
}

/// A function to be divided into pieces.
struct Sampler<F> {
    mean: f64,
    std: f64,
    value: F,
}

/// A piece with its error.
struct Sampled {
    piece: Piece,
    /// The largest deviation from the function, in standard deviations.
    deviation: f64,
    /// The function's values at both ends.
    ends: [f64; 2],
}

impl<F: Fn(f64) -> f64> Sampler<F> {
    fn standardized(&self, value: f64) -> f64 {
        (value - self.mean) / self.std
    }

    fn piece(&self, left: f64, width: f64) -> Sampled {
        let (middle, half) = (left + 0.5 * width, 0.5 * width);
        let values = RULE.map(|(t, _)| self.standardized((self.value)(middle + half * t)));
        let piece = Piece { left, width, values, polynomial: through(&values) };
        let ends = [left, left + width].map(|z| (self.value)(z));
        let checks = [(left, ends[0]), (middle, (self.value)(middle)), (left + width, ends[1])];
        let deviation = checks
            .into_iter()
            .map(|(z, value)| (piece.at(z) - self.standardized(value)).abs())
            .fold(0.0, f64::max);
        Sampled { piece, deviation, ends }
    }
}

impl Sampled {
    fn is_settled(&self) -> bool {
        let Piece { left, width, .. } = self.piece;
        let nearest = if left >= 0.0 { left } else { -(left + width) };
        self.deviation * width * density(nearest.max(0.0)) <= INTEGRAL
    }

    /// The cell for draws, if its polynomial is accurate enough.
    fn cell<F: Fn(f64) -> f64>(&self, of: &Sampler<F>) -> Option<Cell> {
        let [low, high] = self.ends;
        let largest = low.abs().max(high.abs()).max(of.mean.abs());
        let rounding = 16.0 * f64::EPSILON * largest;
        let allowed = DRAW * (high - low) + rounding;
        let polynomial = self.piece.polynomial.map(|c| of.std * c);
        (self.deviation * of.std <= allowed).then_some(Cell { polynomial, low, high })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::{Normal, Readings, Rectangular, StudentT, Triangular};

    fn shapes() -> Vec<Distribution> {
        vec![
            Rectangular::new(2.0, 0.3).unwrap().into(),
            Triangular::new(-1.0, 5.0).unwrap().into(),
            Triangular::between(0.0, 10.0, Some(9.0)).unwrap().into(),
            Normal::with_dof(1e6, 1.0, 5.0).unwrap().into(),
            StudentT::new(0.0, 2.0, 2.1).unwrap().into(),
            Readings::new(vec![1.0, 2.0, 4.0, 8.0]).unwrap().into(),
        ]
    }

    /// The rule integrates powers up to degree 15; 1e-15 is rounding.
    #[test]
    fn the_rule_integrates_polynomials() {
        for degree in [0, 2, 8, 14] {
            let sum: f64 = RULE.iter().map(|(t, w)| w * t.powi(degree)).sum();
            assert!((sum - 2.0 / f64::from(degree + 1)).abs() < 1e-15, "degree {degree}: {sum}");
        }
    }

    /// Tabulated values equal the quantile function to 1e-9 of the standard deviation and rounding
    /// of the value, increase with z, and stay within the limits.
    #[test]
    fn looked_up_values_are_the_quantiles() {
        for distribution in shapes() {
            let table = Profile::of(&Arc::new(distribution.clone())).1;
            let std = distribution.standard_deviation();
            let mut last = f64::NEG_INFINITY;
            for step in 0..160 {
                let mut z = [0.0; COLUMN];
                for (i, z) in z.iter_mut().enumerate() {
                    *z = -10.0 + 20.0 * (step * COLUMN + i) as f64 / (160 * COLUMN) as f64;
                }
                let mut out = [0.0; COLUMN];
                table.values(&z, &mut out);
                for (z, x) in z.into_iter().zip(out) {
                    let exact = at_normal(&distribution, z);
                    // in far tails the standard deviation is not a suitable scale; there relative
                    // to the value
                    let scale = std + (exact - distribution.mean()).abs();
                    let allowed = 1e-9 * scale + 16.0 * f64::EPSILON * exact.abs();
                    assert!((x - exact).abs() <= allowed, "{distribution:?} at {z}: {x}, {exact}");
                    assert!(x >= last - allowed, "{distribution:?} falls at {z}");
                    last = x;
                }
            }
            assert!(table.exact_cells() <= 1, "{distribution:?}: {}", table.exact_cells());
        }
    }

    /// Any z gives a finite value, also beyond the table.
    #[test]
    fn no_draw_is_infinite() {
        for distribution in shapes() {
            let table = Profile::of(&Arc::new(distribution.clone())).1;
            let mut z = [40.0; COLUMN];
            z[..4].copy_from_slice(&[-1e9, -40.0, 9.0, -9.0]);
            let mut out = [0.0; COLUMN];
            table.values(&z, &mut out);
            assert!(out.iter().all(|x| x.is_finite()), "{distribution:?}");
        }
    }

    /// The pieces contain the whole variance; a t distribution with 2.1 degrees of freedom has a
    /// hundredth of it beyond the range of doubles.
    #[test]
    fn pieces_hold_the_variance() {
        for distribution in shapes() {
            let heavy = distribution.drawn_dof() < 2.5;
            let variance = Profile::of(&Arc::new(distribution.clone())).0.variance;
            let allowed = if heavy { 0.05 } else { 1e-8 };
            assert!((variance - 1.0).abs() < allowed, "{distribution:?}: {variance}");
        }
    }
}
