//! Quantiles, coverage intervals and probabilities of a distribution whose distribution function, or
//! whose quantile function, is known.

use std::cell::Cell;
use std::sync::Arc;

use super::invert::{At, Inversion};
use super::separate::Outer;
use crate::distribution::Distribution;

/// The distribution of an output.
pub(super) enum Law {
    /// A sum of several groups about `mean`, and what the output is of it.
    Sum {
        inversion: Inversion,
        mean: f64,
        outer: Outer,
        symmetric: bool,
        /// Where the last quantiles were found, below and above the median.
        last: Cell<[f64; 2]>,
    },
    /// A monotone function of one quantity.
    One { distribution: Arc<Distribution>, rising: bool, function: Box<dyn Fn(f64) -> f64> },
}

/// A value and how far it may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Found {
    pub(super) value: f64,
    pub(super) bound: f64,
}

/// The rounding of the special functions behind quantiles of one quantity, relative to their spread.
const SPECIAL: f64 = 2e-14;

impl Law {
    /// The value below which the output lies with probability `p`; `q` is 1 - `p` with its own digits.
    pub(super) fn quantile(&self, p: f64, q: f64) -> Option<Found> {
        match self {
            Self::One { distribution, rising, function } => {
                let [p, q] = if *rising { [p, q] } else { [q, p] };
                let x =
                    if p < 0.5 { distribution.quantile(p) } else { distribution.quantile_upper(q) };
                let value = function(x);
                let middle = function(distribution.quantile(0.5));
                let bound = SPECIAL * (value - middle).abs() + 8.0 * f64::EPSILON * value.abs();
                value.is_finite().then_some(Found { value, bound })
            }
            Self::Sum { inversion, mean, outer, last, .. } => {
                let p = if rises(outer) { p } else { q };
                let (x, at) = solved(inversion, p, last)?;
                let value = transformed(outer, mean + x);
                let sum = mean + x;
                let slope = slope(outer, sum);
                let bound = 1.01 * slope * (inversion.error + 2e-16) / at.density
                    + 4.0 * f64::EPSILON * (slope * (sum.abs() + mean.abs()) + value.abs());
                (value.is_finite() && bound.is_finite()).then_some(Found { value, bound })
            }
        }
    }

    /// The probability of values up to `y`.
    pub(super) fn probability(&self, y: f64) -> f64 {
        if y.is_infinite() {
            return if y > 0.0 { 1.0 } else { 0.0 };
        }
        match self {
            Self::Sum { inversion, mean, outer, .. } => {
                let rises = rises(outer);
                let x = match *outer {
                    Outer::Sum => y,
                    Outer::Product { factor, shift } => {
                        let ratio = (y - shift) / factor;
                        if ratio <= 0.0 {
                            return if rises { 0.0 } else { 1.0 };
                        }
                        crate::number::elementary::ln(ratio)
                    }
                };
                let p = inversion.at(x - mean).cdf.clamp(0.0, 1.0);
                if rises { p } else { 1.0 - p }
            }
            Self::One { .. } => {
                // halvings of the probability
                let (mut low, mut high) = (0.0, 1.0);
                for _ in 0..60 {
                    let p = 0.5 * (low + high);
                    match self.quantile(p, 1.0 - p) {
                        Some(found) if found.value <= y => low = p,
                        _ => high = p,
                    }
                }
                0.5 * (low + high)
            }
        }
    }

    /// The density at the quantile of `p`, and how far it may be off; the steepness of the density
    /// there.
    fn density(&self, p: f64) -> Option<[f64; 2]> {
        match self {
            Self::Sum { inversion, mean, outer, last, .. } => {
                let p = if rises(outer) { p } else { 1.0 - p };
                let (x, _) = solved(inversion, p, last)?;
                let slope = slope(outer, mean + x);
                Some([inversion.at(x).density / slope, inversion.density_error / slope])
            }
            Self::One { .. } => {
                // the slope of the quantile function, by differences of fourth order
                let step = 1e-3 * p.min(1.0 - p);
                let at = |k: f64| Some(self.quantile(p + k * step, 1.0 - p - k * step)?.value);
                let near = at(1.0)? - at(-1.0)?;
                let far = at(2.0)? - at(-2.0)?;
                let slope = (8.0 * near - far) / (12.0 * step);
                (slope > 0.0).then(|| [1.0 / slope, 1e-9 / slope])
            }
        }
    }

    /// Whether the density is known to be symmetric and to fall from its middle.
    fn is_symmetric(&self) -> bool {
        match self {
            Self::Sum { symmetric, outer, .. } => *symmetric && *outer == Outer::Sum,
            Self::One { .. } => false,
        }
    }

    /// Whether quantiles of equal probabilities of both sides are equally far from the median, as far
    /// as they are known.
    fn has_equal_sides(&self) -> bool {
        let Some(median) = self.quantile(0.5, 0.5) else { return false };
        [1e-4, 1e-3, 0.01, 0.05, 0.15, 0.3, 0.45].into_iter().all(|p| {
            let ends = self.quantile(p, 1.0 - p).zip(self.quantile(1.0 - p, p));
            ends.is_some_and(|(low, high)| {
                let off = low.bound + high.bound + 2.0 * median.bound;
                (low.value + high.value - 2.0 * median.value).abs() <= off
            })
        })
    }

    /// The shortest interval of probability `p`, with what its ends may be off, and whether there is
    /// one; `symmetric` is the probabilistically symmetric one.
    pub(super) fn shortest(&self, p: f64, symmetric: [Found; 2]) -> Option<([Found; 2], bool)> {
        if self.is_symmetric() {
            return Some((symmetric, true));
        }
        let tail = 1.0 - p;
        let ends =
            |low: f64| Some([self.quantile(low, 1.0 - low)?, self.quantile(low + p, tail - low)?]);
        let length = |low: f64| ends(low).map(|[a, b]| b.value - a.value);
        // coarse places, and the edges themselves
        const PARTS: usize = 8;
        let edge = 1e-12 * tail;
        let place = |k: usize| (tail * k as f64 / PARTS as f64).clamp(edge, tail - edge);
        let lengths: Vec<f64> =
            (0..=PARTS).map(|k| length(place(k)).unwrap_or(f64::INFINITY)).collect();
        let best = (0..=PARTS).min_by(|&a, &b| {
            let off = |k: usize| (2 * k).abs_diff(PARTS);
            lengths[a].total_cmp(&lengths[b]).then(off(a).cmp(&off(b)))
        })?;
        let is_flat = |other: usize| lengths[other] <= lengths[best] * (1.0 + 1e-7);
        let neighbours = [best.checked_sub(1), (best < PARTS).then_some(best + 1)];
        if neighbours.into_iter().flatten().any(is_flat)
            || (0..=PARTS).any(|k| k.abs_diff(best) > 1 && is_flat(k))
        {
            let flat = symmetric[1].value - symmetric[0].value <= lengths[best] * (1.0 + 1e-7);
            return if flat { Some((symmetric, false)) } else { Some((ends(place(best))?, false)) };
        }
        // the best of the places is then the middle one, where the slopes of both ends are the same but
        // for what differences leave of them
        if 2 * best == PARTS && self.has_equal_sides() {
            return Some((symmetric, true));
        }
        // the density is the same at both ends
        let excess = |low: f64| {
            let ([a, a_off], [b, b_off]) = (self.density(low)?, self.density(low + p)?);
            Some([a - b, a_off + b_off])
        };
        let (mut low, mut high) = (place(best.saturating_sub(1)), place((best + 1).min(PARTS)));
        // the shortest one starts or ends at a limit of the values
        let at_edge = best == 0 || best == PARTS;
        let (Some(mut at_low), Some(mut at_high)) = (excess(low), excess(high)) else {
            return Some((ends(place(best))?, at_edge));
        };
        if at_low[0] >= 0.0 || at_high[0] <= 0.0 {
            return at_edge.then_some((ends(place(best))?, true));
        }
        let mut at = 0.5 * (low + high);
        for _ in 0..80 {
            // regula falsi of Illinois, halvings where it stalls
            at = low - at_low[0] * (high - low) / (at_high[0] - at_low[0]);
            if !(at > low && at < high) {
                at = 0.5 * (low + high);
            }
            let here = excess(at)?;
            if here[0].abs() <= here[1] || high - low <= 1e-15 * tail {
                break;
            }
            if here[0] < 0.0 {
                if at_low[0] < 0.0 {
                    at_high[0] *= 0.5;
                }
                (low, at_low) = (at, here);
            } else {
                (high, at_high) = (at, here);
                at_low[0] *= 0.5;
            }
        }
        let step = 1e-3 * tail.min(at.max(edge)).min((tail - at).max(edge));
        let (after, before) = (excess(at + step)?, excess(at - step)?);
        let steepness = (after[0] - before[0]) / (2.0 * step);
        let off = 2.0 * excess(at)?[1] / steepness;
        let [mut a, mut b] = ends(at)?;
        a.bound += (off / self.density(at)?[0]).abs();
        b.bound += (off / self.density(at + p)?[0]).abs();
        Some(([a, b], true))
    }
}

/// The quantile of `p`, from the last one on the same side.
fn solved(inversion: &Inversion, p: f64, last: &Cell<[f64; 2]>) -> Option<(f64, At)> {
    let mut places = last.get();
    let side = usize::from(p > 0.5);
    let found = solve(inversion, p, places[side])?;
    places[side] = found.0;
    last.set(places);
    Some(found)
}

fn rises(outer: &Outer) -> bool {
    match outer {
        Outer::Sum => true,
        Outer::Product { factor, .. } => *factor > 0.0,
    }
}

fn transformed(outer: &Outer, sum: f64) -> f64 {
    match outer {
        Outer::Sum => sum,
        Outer::Product { factor, shift } => shift + factor * crate::number::elementary::exp(sum),
    }
}

/// The modulus of the slope of what the output is of the sum.
fn slope(outer: &Outer, sum: f64) -> f64 {
    match outer {
        Outer::Sum => 1.0,
        Outer::Product { factor, .. } => (factor * crate::number::elementary::exp(sum)).abs(),
    }
}

/// The place at which the distribution function is `p`: Newton's steps from `start`, halvings where they
/// leave what is known to hold it.
fn solve(inversion: &Inversion, p: f64, start: f64) -> Option<(f64, At)> {
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut x = start;
    let mut far = inversion.width;
    for _ in 0..300 {
        let at = inversion.at(x);
        let short = p - at.cdf;
        if at.density > 0.0 && short.abs() <= 2e-16 * at.density * (x.abs() + inversion.width) {
            return Some((x, at));
        }
        if short > 0.0 {
            low = x;
        } else {
            high = x;
        }
        let step = (short / at.density).clamp(-far, far);
        let newton = x + step;
        let next = if newton > low && newton < high {
            newton
        } else if low.is_finite() && high.is_finite() {
            0.5 * (low + high)
        } else {
            // beyond everything there was, farther each time
            far *= 2.0;
            x + far.copysign(short)
        };
        let moved = (next - x).abs();
        if moved <= 4e-16 * (x.abs() + inversion.width) || high - low <= 4e-16 * x.abs() {
            return (at.density > 0.0).then_some((x, at));
        }
        // what Newton's last step leaves is its square
        if moved <= 1e-8 * inversion.width && next == newton {
            return (at.density > 0.0).then_some((next, at));
        }
        x = next;
    }
    None
}
