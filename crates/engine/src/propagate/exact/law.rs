//! Quantiles, coverage intervals and probabilities of a distribution whose distribution function, or
//! whose quantile function, is known.

use std::cell::Cell;
use std::sync::Arc;

use super::invert::{At, Inversion};
use super::separate::Outer;
use crate::distribution::Distribution;
use crate::propagate::shortest::{Interval, Purpose, ShortestSearch};

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
pub(super) struct BoundedValue {
    pub(super) value: f64,
    pub(super) bound: f64,
}

/// The rounding of the special functions behind quantiles of one quantity, relative to their spread.
const SPECIAL: f64 = 2e-14;

/// The share of the smaller probability at a quantile over which the slope there is taken.
const OF_SLOPE: f64 = 0.01;

/// Probabilities below so many errors of the distribution function are not told from none.
const RESOLVED: f64 = 1e4;

/// A shortest interval that may have anything from a range of probabilities below it that is a larger share
/// of the probability outside is one of many.
const FLAT: f64 = 0.01;

impl Law {
    /// The value below which the output lies with probability `p`; `q` is 1 - `p` with its own digits.
    pub(super) fn quantile(&self, p: f64, q: f64) -> Option<BoundedValue> {
        match self {
            Self::One { distribution, rising, function } => {
                let [p, q] = if *rising { [p, q] } else { [q, p] };
                let x =
                    if p < 0.5 { distribution.quantile(p) } else { distribution.quantile_upper(q) };
                let value = function(x);
                let middle = function(distribution.quantile(0.5));
                let bound = SPECIAL * (value - middle).abs() + 8.0 * f64::EPSILON * value.abs();
                value.is_finite().then_some(BoundedValue { value, bound })
            }
            Self::Sum { inversion, outer, last, .. } => {
                let p = if rises(outer) { p } else { q };
                let (x, at) = solved(inversion, p, last)?;
                self.of_sum(x, at)
            }
        }
    }

    /// The output where the sum is `x` from its mean.
    fn of_sum(&self, x: f64, at: At) -> Option<BoundedValue> {
        let Self::Sum { inversion, mean, outer, .. } = self else {
            return None;
        };
        let sum = mean + x;
        let value = transformed(outer, sum);
        let slope = slope(outer, sum);
        let bound = 1.01 * slope * (inversion.error + 2e-16) / at.density
            + 4.0 * f64::EPSILON * (slope * (sum.abs() + mean.abs()) + value.abs());
        (value.is_finite() && bound.is_finite()).then_some(BoundedValue { value, bound })
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

    /// A quantile, and the density there with how far that may be off; to see where about something is
    /// that need not be what is known best.
    fn end(&self, [p, q]: [f64; 2], purpose: Purpose) -> Option<(BoundedValue, [f64; 2])> {
        match self {
            Self::Sum { inversion, mean, outer, last, .. } => {
                let (x, at) = solved(inversion, if rises(outer) { p } else { q }, last)?;
                let density = match purpose {
                    Purpose::Survey => [at.density, inversion.density_error],
                    Purpose::Find => inversion.density(x),
                };
                let slope = slope(outer, mean + x);
                Some((self.of_sum(x, at)?, density.map(|density| density / slope)))
            }
            Self::One { .. } => {
                // the slope of the quantile function, by differences of sixth order
                let step = OF_SLOPE * p.min(q);
                let at = |k: f64| self.quantile(p + k * step, q - k * step);
                let mut differences = [0.0; 3];
                let mut off: f64 = 0.0;
                for (difference, k) in differences.iter_mut().zip([1.0, 2.0, 3.0]) {
                    let (after, before) = (at(k)?, at(-k)?);
                    *difference = after.value - before.value;
                    off = off.max(after.bound + before.bound);
                }
                let [near, far, farther] = differences;
                let slope = (45.0 * near - 9.0 * far + farther) / (60.0 * step);
                let of_fourth = (8.0 * near - far) / (12.0 * step);
                let off = off / step + (slope - of_fourth).abs();
                (slope > 0.0).then_some(())?;
                Some((self.quantile(p, q)?, [1.0 / slope, off / (slope * slope)]))
            }
        }
    }

    /// Whether the density is known to be symmetric and to fall from its middle.
    fn is_symmetric(&self) -> bool {
        matches!(self, Self::Sum { symmetric: true, outer: Outer::Sum, .. })
    }

    /// The interval with these probabilities below and above it.
    fn interval(
        &self,
        p: f64,
        tails: [f64; 2],
        purpose: Purpose,
    ) -> Option<([BoundedValue; 2], Interval)> {
        let [below, above] = tails;
        if matches!(self, Self::Sum { inversion, .. } if below.min(above) < RESOLVED * inversion.error)
        {
            return None;
        }
        let (low, [dense_low, off_low]) = self.end([below, p + above], purpose)?;
        let (high, [dense_high, off_high]) = self.end([p + below, above], purpose)?;
        let interval = Interval {
            tails,
            ends: [low.value, high.value],
            off: low.bound + high.bound,
            excess: [dense_low - dense_high, off_low + off_high],
        };
        Some(([low, high], interval))
    }

    /// Where the values begin and end, as far as it is known.
    fn limits(&self) -> [Option<BoundedValue>; 2] {
        match self {
            Self::One { .. } => {
                let least = f64::MIN_POSITIVE;
                [self.quantile(least, 1.0), self.quantile(1.0, least)]
            }
            Self::Sum { outer: Outer::Sum, .. } => [None; 2],
            Self::Sum { outer: Outer::Product { factor, shift }, .. } => {
                let limit = Some(BoundedValue { value: *shift, bound: 0.0 });
                if *factor > 0.0 { [limit, None] } else { [None, limit] }
            }
        }
    }

    /// What the least length of an interval is that reaches beyond the places that are known.
    fn beyond(&self, p: f64) -> Option<f64> {
        let Self::Sum { inversion, mean, outer, .. } = self else {
            return Some(f64::INFINITY);
        };
        if inversion.known.is_infinite() {
            return Some(f64::INFINITY);
        }
        let ends = [-1.0, 1.0].map(|sign| transformed(outer, mean + sign * inversion.known));
        let [least, most] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let (from, to) = (self.quantile(1.0 - p, p)?, self.quantile(p, 1.0 - p)?);
        Some(f64::min(to.value - least, most - from.value))
    }

    /// The shortest interval of probability `p`, with what its ends may be off, and whether it is the
    /// only one; `symmetric` is the probabilistically symmetric one.
    pub(super) fn shortest(
        &self,
        p: f64,
        symmetric: [BoundedValue; 2],
    ) -> Option<([BoundedValue; 2], bool)> {
        let tail = 1.0 - p;
        let center = 0.5 * tail;
        let at = |tails: [f64; 2], purpose| Some(self.interval(p, tails, purpose)?.1);
        let mut search = ShortestSearch { tail, at };
        let is_symmetric = self.is_symmetric();
        let least = if is_symmetric {
            search.about(at([center, center], Purpose::Find)?)
        } else {
            search.least()?
        };
        if least.interval.length() > self.beyond(p)? {
            return None;
        }
        let [from, to] = least.range;
        let is_flat = to - from > FLAT * tail;
        let unique = least.alone && !is_flat;
        let length = symmetric[1].value - symmetric[0].value;
        if is_symmetric || is_flat && least.includes(center) {
            return Some((symmetric, unique));
        }
        // it begins or ends where the values do
        match self.limits() {
            [Some(limit), _] if from <= 0.0 => {
                return Some(([limit, self.quantile(p, tail)?], unique));
            }
            [_, Some(limit)] if to >= tail => {
                return Some(([self.quantile(tail, p)?, limit], unique));
            }
            _ => {}
        }
        let tails = least.interval.tails;
        let mut ends = self.interval(p, tails, Purpose::Find)?.0;
        if least.includes(center) || least.interval.length() >= length {
            ends = symmetric;
        }
        if !is_flat {
            let [low, high] = [[tails[0], p + tails[1]], [p + tails[0], tails[1]]];
            for (end, end_tails) in ends.iter_mut().zip([low, high]) {
                let (_, [density, _]) = self.end(end_tails, Purpose::Find)?;
                end.bound += f64::max(tails[0] - from, to - tails[0]) / density;
            }
        }
        Some((ends, unique))
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
        }
        .clamp(-inversion.known, inversion.known);
        if next == x && x.abs() == inversion.known {
            return None;
        }
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
