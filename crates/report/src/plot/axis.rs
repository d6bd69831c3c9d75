//! An axis: the positions of values on it, and its tick marks.

use crate::number::{exact, rounded};
use gumption_engine::decimal::Decimal;
use gumption_engine::number::ascending;
use gumption_engine::number::elementary::{ln, log10, pow};

/// Positive values that span more than this factor may be spaced geometrically.
const WIDE: f64 = 8.0;

/// Values are geometric if their ratios vary by less than this fraction of the variation of their
/// differences (squares of relative deviations).
const CLEARLY: f64 = 0.5;

/// Free space at each end, as a fraction of the axis.
const MARGIN: f64 = 0.04;

/// The same for an axis with marks and bars.
const SPACE: f64 = 0.06;

/// A linear or logarithmic axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Axis {
    /// Whether positions are decimal logarithms.
    log: bool,
    /// Positions of its ends.
    ends: [f64; 2],
}

impl Axis {
    /// An axis over all values; logarithmic if the distinct values are spaced geometrically.
    pub(crate) fn over(values: impl IntoIterator<Item = f64>) -> Self {
        let mut levels: Vec<f64> = values.into_iter().filter(|value| value.is_finite()).collect();
        ascending(&mut levels);
        levels.dedup();
        let log = is_geometric(&levels);
        let position = |value: f64| if log { log10(value) } else { value };
        let (Some(&first), Some(&last)) = (levels.first(), levels.last()) else {
            return Self { log: false, ends: [0.0, 1.0] };
        };
        let (from, to) = (position(first), position(last));
        let margin = match MARGIN * (to - from) {
            0.0 => 0.5 * from.abs().max(1.0),
            margin => margin,
        };
        Self { log, ends: [from - margin, to + margin] }
    }

    /// A linear axis between two values.
    pub(crate) fn linear(from: f64, to: f64) -> Self {
        Self { log: false, ends: [from, to] }
    }

    /// A linear axis over the finite values, with some space at the ends; `None` if they have no
    /// range.
    pub(crate) fn around(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let finite = values.into_iter().filter(|value| value.is_finite());
        let [from, to] = finite
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], value| [a.min(value), b.max(value)]);
        let margin = SPACE * (to - from);
        (margin.is_finite() && margin > 0.0).then(|| Self::linear(from - margin, to + margin))
    }

    /// A linear axis that is symmetric about zero.
    pub(crate) fn about_zero(values: impl IntoIterator<Item = f64>) -> Self {
        let farthest =
            values.into_iter().filter(|v| v.is_finite()).map(f64::abs).fold(0.0, f64::max);
        let end = if farthest > 0.0 { 1.08 * farthest } else { 1.0 };
        Self::linear(-end, end)
    }

    /// A logarithmic axis between two positive values.
    pub(crate) fn logarithmic(from: f64, to: f64) -> Self {
        Self { log: true, ends: [log10(from), log10(to)] }
    }

    /// Whether positions are logarithms.
    pub(crate) fn is_logarithmic(&self) -> bool {
        self.log
    }

    /// The position of a value.
    pub(crate) fn position(&self, value: f64) -> f64 {
        if self.log { log10(value) } else { value }
    }

    /// The positions of both ends.
    pub(crate) fn ends(&self) -> [f64; 2] {
        self.ends
    }

    /// Round values for tick marks, approximately `most` at most: their positions and texts.
    pub(crate) fn marks(&self, most: usize) -> Vec<(f64, String)> {
        let most = most.max(2);
        if self.log {
            let [from, to] = self.ends.map(|end| pow(10.0, end));
            for digits in [[1, 2, 5].as_slice(), &[1, 3], &[1]] {
                let marks = decades(self.ends, digits);
                if (3..=most).contains(&marks.len()) {
                    return marks.into_iter().map(|value| (log10(value), exact(value))).collect();
                }
            }
            let decades = decades(self.ends, &[1]);
            if decades.len() > most {
                let step = decades.len().div_ceil(most);
                let marks = decades.into_iter().step_by(step);
                return marks.map(|value| (log10(value), exact(value))).collect();
            }
            return steps([from, to], most)
                .into_iter()
                .filter(|(value, _)| *value > 0.0)
                .map(|(value, text)| (log10(value), text))
                .collect();
        }
        steps(self.ends, most)
    }
}

/// Whether distinct positive values, in order, are spaced more evenly by ratios than by differences.
fn is_geometric(levels: &[f64]) -> bool {
    let (Some(&first), Some(&last)) = (levels.first(), levels.last()) else { return false };
    if levels.len() < 3 || first <= 0.0 || last / first < WIDE {
        return false;
    }
    let unevenness = |position: &dyn Fn(f64) -> f64| {
        let steps: Vec<f64> =
            levels.windows(2).map(|pair| position(pair[1]) - position(pair[0])).collect();
        let mean = steps.iter().sum::<f64>() / steps.len() as f64;
        let square = steps.iter().map(|step| (step / mean - 1.0).powi(2)).sum::<f64>();
        square / steps.len() as f64
    };
    unevenness(&ln) < CLEARLY * unevenness(&|value| value)
}

/// Multiples of powers of ten between two positions of a logarithmic axis.
fn decades(ends: [f64; 2], digits: &[u64]) -> Vec<f64> {
    let powers = ends[0].floor() as i32..=ends[1].ceil() as i32;
    let all = powers
        .flat_map(|power| digits.iter().map(move |digit| Decimal::new(*digit, power).value()));
    all.filter(|value| (ends[0]..=ends[1]).contains(&log10(*value))).collect()
}

/// Multiples of 1, 2 or 5 times a power of ten between two values.
fn steps(ends: [f64; 2], most: usize) -> Vec<(f64, String)> {
    let span = ends[1] - ends[0];
    if !span.is_finite() || span <= 0.0 {
        return Vec::new();
    }
    let rough = span / most as f64;
    let mut power = log10(rough).floor() as i32;
    let digit = [1.0, 2.0, 5.0].into_iter().find(|digit| digit * 10_f64.powi(power) >= rough);
    let digit = digit.unwrap_or_else(|| {
        power += 1;
        1.0
    });
    let step = digit * 10_f64.powi(power);
    let (first, last) = ((ends[0] / step).ceil() as i64, (ends[1] / step).floor() as i64);
    let values = || (first..=last).map(|count| count as f64 * step);
    let texts: Vec<String> = values().map(|value| rounded(value, power)).collect();
    // numbers of one axis have one exponent
    let has_exponents = texts.iter().any(|text| text.contains('e'));
    let with_exponent = |count: i64| match count * digit as i64 {
        0 => "0".to_owned(),
        multiple => format!("{multiple}e{power}"),
    };
    match has_exponents {
        true => values().zip((first..=last).map(with_exponent)).collect(),
        false => values().zip(texts).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(axis: &Axis, most: usize) -> Vec<String> {
        axis.marks(most).into_iter().map(|(_, text)| text).collect()
    }

    #[test]
    fn round_marks() {
        assert_eq!(texts(&Axis::linear(-0.31, 0.31), 5), ["-0.2", "0.0", "0.2"]);
        assert_eq!(texts(&Axis::linear(35.0, 91.0), 6), ["40", "50", "60", "70", "80", "90"]);
        assert_eq!(texts(&Axis::linear(0.0, 3.1e6), 4), ["0", "1000000", "2000000", "3000000"]);
        assert_eq!(texts(&Axis::linear(0.0, 1.6e-5), 4), ["0", "5e-6", "10e-6", "15e-6"]);
    }

    #[test]
    fn geometric_levels_get_a_logarithmic_axis() {
        let axis = Axis::over([0.5, 1.0, 2.0, 4.0, 8.0, 16.0]);
        assert!(axis.log);
        assert_eq!(texts(&axis, 8), ["0.5", "1", "2", "5", "10"]);
        assert!(!Axis::over((1..=10).map(f64::from)).log);
        assert!(!Axis::over([0.0, 1.0, 10.0, 100.0]).log);
        // the third octaves of a shaker, with nominal values
        let axis = Axis::over([5.0, 6.3, 8.0, 10.0, 12.5, 16.0, 20.0, 25.0, 31.5, 40.0, 50.0]);
        assert!(axis.log);
        assert_eq!(texts(&axis, 8), ["5", "10", "20", "50"]);
        assert_eq!(
            texts(&Axis::logarithmic(1e-3, 1e9), 5),
            ["0.001", "1", "1000", "1000000", "1000000000"]
        );
    }

    #[test]
    fn one_value_has_room() {
        let axis = Axis::over([80.0]);
        assert!(axis.ends()[0] < 80.0 && axis.ends()[1] > 80.0);
        assert!(!axis.marks(5).is_empty());
    }
}
