//! Values between the points of a table.

use std::error::Error;
use std::fmt;

use crate::number::{Routine, Shortest};

/// How values between the points of a table are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum InterpolationMethod {
    /// Straight lines from point to point.
    #[default]
    Linear,
    /// A cubic spline with continuous second derivatives, whose first and last two pieces are each
    /// one cubic ("not-a-knot"): a table of a cubic polynomial comes back exactly.
    Cubic,
}

impl InterpolationMethod {
    /// All methods.
    pub const ALL: [Self; 2] = [Self::Linear, Self::Cubic];

    /// The name in files and formulas.
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Cubic => "cubic",
        }
    }
}

/// Why points make no table.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum TableFault {
    /// Fewer than two points.
    TooFew,
    /// The point of this number, from 0, has the same abscissa as the one before it.
    Repeated(usize),
    /// The point of this number, from 0, is out of order.
    Unsorted(usize),
    /// The point of this number, from 0, has a coordinate that is not finite.
    NotFinite(usize),
}

impl fmt::Display for TableFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFew => f.write_str("a table needs at least two points"),
            Self::Repeated(_) => f.write_str("the same abscissa appears twice"),
            Self::Unsorted(_) => {
                f.write_str("the abscissas neither rise nor fall all the way; sort the rows")
            }
            Self::NotFinite(_) => f.write_str("a coordinate is not a finite number"),
        }
    }
}

impl Error for TableFault {}

/// A function known at some points: what `table(...)` of a formula computes.
///
/// ```
/// use gumption_engine::model::{Interpolation, InterpolationMethod};
/// use gumption_engine::number::Routine;
///
/// let points = [[0.0, 0.0], [1.0, 1.0], [2.0, 8.0], [3.0, 27.0]];
/// let cubic = Interpolation::new("x^3", &points, InterpolationMethod::Cubic)?;
/// assert!((cubic.value(&[1.5]) - 3.375).abs() < 1e-14);
/// assert!(cubic.value(&[3.5]).is_nan());
/// # Ok::<(), gumption_engine::model::TableFault>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Interpolation {
    label: String,
    xs: Vec<f64>,
    ys: Vec<f64>,
    /// The slopes of the curve at the points; none of straight lines.
    slopes: Option<Vec<f64>>,
}

/// What rounding of an abscissa may take it beyond the ends by, relative to the length.
const ROUNDING: f64 = 1e-12;

impl Interpolation {
    /// A table from its points, abscissa first, which rise or fall; `label` is what messages call
    /// it.
    ///
    /// # Errors
    /// What is wrong with the points.
    pub fn new(
        label: impl Into<String>,
        points: &[[f64; 2]],
        method: InterpolationMethod,
    ) -> Result<Self, TableFault> {
        if let Some(index) = points.iter().position(|point| !point.iter().all(|x| x.is_finite())) {
            return Err(TableFault::NotFinite(index));
        }
        let [Some(first), Some(last)] = [points.first(), points.last()] else {
            return Err(TableFault::TooFew);
        };
        if points.len() < 2 {
            return Err(TableFault::TooFew);
        }
        let falls = last[0] < first[0];
        for (index, pair) in points.windows(2).enumerate() {
            let [[x, _], [next, _]] = [pair[0], pair[1]];
            if next == x {
                return Err(TableFault::Repeated(index + 1));
            }
            if (next < x) != falls {
                return Err(TableFault::Unsorted(index + 1));
            }
        }
        let mut points = points.to_vec();
        if falls {
            points.reverse();
        }
        let (xs, ys): (Vec<f64>, Vec<f64>) = points.iter().map(|&[x, y]| (x, y)).unzip();
        let slopes = (method == InterpolationMethod::Cubic).then(|| not_a_knot(&xs, &ys));
        Ok(Self { label: label.into(), xs, ys, slopes })
    }

    /// The ends of the range in which the table has values.
    pub fn range(&self) -> [f64; 2] {
        [self.xs[0], self.xs[self.xs.len() - 1]]
    }

    /// Number of points.
    pub fn points(&self) -> usize {
        self.xs.len()
    }

    /// How far straight lines and the cubic through the points are apart at most, half way between
    /// points: what the choice of a method moves values by.
    pub fn method_difference(&self) -> f64 {
        let cubic = Self { slopes: Some(not_a_knot(&self.xs, &self.ys)), ..self.clone() };
        let straight = Self { slopes: None, ..self.clone() };
        let middles = self.xs.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        middles.map(|x| (cubic.value(&[x]) - straight.value(&[x])).abs()).fold(0.0, f64::max)
    }

    /// The piece that an abscissa lies in, and the abscissa within the range; none outside.
    fn piece(&self, x: f64) -> Option<(usize, f64)> {
        let [low, high] = self.range();
        let slack = ROUNDING * (high - low);
        if !(x >= low - slack && x <= high + slack) {
            return None;
        }
        let x = x.clamp(low, high);
        let above = self.xs.partition_point(|&of| of <= x);
        Some((above.clamp(1, self.xs.len() - 1) - 1, x))
    }

    /// Value and slope of a piece at an abscissa.
    fn at(&self, piece: usize, x: f64) -> [f64; 2] {
        let ([a, b], [p, q]) =
            ([self.xs[piece], self.xs[piece + 1]], [self.ys[piece], self.ys[piece + 1]]);
        let width = b - a;
        let steep = (q - p) / width;
        let of = x - a;
        let (value, slope) = match &self.slopes {
            None => (p + steep * of, steep),
            Some(slopes) => {
                let [d, e] = [slopes[piece], slopes[piece + 1]];
                let second = (3.0 * steep - 2.0 * d - e) / width;
                let third = (d + e - 2.0 * steep) / (width * width);
                let value = p + of * (d + of * (second + of * third));
                (value, d + of * (2.0 * second + of * 3.0 * third))
            }
        };
        // a point of the table is itself
        let value = if x == a {
            p
        } else if x == b {
            q
        } else {
            value
        };
        [value, slope]
    }
}

impl Routine for Interpolation {
    fn name(&self) -> &'static str {
        "table"
    }

    fn value(&self, operands: &[f64]) -> f64 {
        let x = operands.first().copied().unwrap_or(f64::NAN);
        self.piece(x).map_or(f64::NAN, |(piece, x)| self.at(piece, x)[0])
    }

    /// At a point of a table between two straight lines the mean of their slopes.
    fn slopes(&self, operands: &[f64], _: f64) -> Vec<f64> {
        let x = operands.first().copied().unwrap_or(f64::NAN);
        let slope = self.piece(x).map_or(f64::NAN, |(piece, x)| {
            let [_, slope] = self.at(piece, x);
            if piece > 0 && x == self.xs[piece] && self.slopes.is_none() {
                0.5 * (slope + self.at(piece - 1, x)[1])
            } else {
                slope
            }
        });
        vec![slope]
    }

    fn undefined(&self, operands: &[f64]) -> String {
        let [low, high] = self.range().map(Shortest);
        let x = Shortest(operands.first().copied().unwrap_or(f64::NAN));
        format!("{} at {x}, outside its range {low} to {high}", self.label)
    }
}

/// The slopes at the points of the spline whose third derivative is continuous at the second and
/// the last but one point; through three points the parabola, through two the line.
fn not_a_knot(xs: &[f64], ys: &[f64]) -> Vec<f64> {
    let n = xs.len();
    let widths: Vec<f64> = xs.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let steep: Vec<f64> =
        ys.windows(2).zip(&widths).map(|(pair, width)| (pair[1] - pair[0]) / width).collect();
    if n == 2 {
        return vec![steep[0]; 2];
    }
    if n == 3 {
        let [h, k] = [widths[0], widths[1]];
        let bend = (steep[1] - steep[0]) / (h + k);
        return vec![steep[0] - h * bend, steep[0] + h * bend, steep[1] + k * bend];
    }
    // a tridiagonal system, with the two conditions of the ends made tridiagonal
    let (mut below, mut diagonal) = (vec![0.0; n], vec![0.0; n]);
    let (mut above, mut right) = (vec![0.0; n], vec![0.0; n]);
    let end = |h: f64, k: f64, s: f64, t: f64| {
        let both = h + k;
        (k, both, ((h + 2.0 * both) * k * s + h * h * t) / both)
    };
    (diagonal[0], above[0], right[0]) = end(widths[0], widths[1], steep[0], steep[1]);
    for i in 1..n - 1 {
        let [h, k] = [widths[i - 1], widths[i]];
        (below[i], diagonal[i], above[i]) = (k, 2.0 * (h + k), h);
        right[i] = 3.0 * (k * steep[i - 1] + h * steep[i]);
    }
    (diagonal[n - 1], below[n - 1], right[n - 1]) =
        end(widths[n - 2], widths[n - 3], steep[n - 2], steep[n - 3]);
    for i in 1..n {
        let factor = below[i] / diagonal[i - 1];
        diagonal[i] -= factor * above[i - 1];
        right[i] -= factor * right[i - 1];
    }
    let mut slopes = vec![0.0; n];
    slopes[n - 1] = right[n - 1] / diagonal[n - 1];
    for i in (0..n - 1).rev() {
        slopes[i] = (right[i] - above[i] * slopes[i + 1]) / diagonal[i];
    }
    slopes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A table of a cubic polynomial at uneven points comes back exactly, with its derivative;
    /// 1e-13 is the rounding of the system of eight unknowns.
    #[test]
    fn cubics_come_back() {
        let f = |x: f64| 1.0 - 2.0 * x + 0.5 * x * x - 0.25 * x * x * x;
        let slope = |x: f64| -2.0 + x - 0.75 * x * x;
        let xs = [-1.0, -0.3, 0.2, 0.9, 1.1, 2.5, 3.0, 4.2];
        for n in 4..=xs.len() {
            let points: Vec<[f64; 2]> = xs[..n].iter().map(|&x| [x, f(x)]).collect();
            let table = Interpolation::new("f", &points, InterpolationMethod::Cubic).unwrap();
            for x in [-0.7, 0.0, 0.25, 0.8] {
                let value = table.value(&[x]);
                assert!((value - f(x)).abs() < 1e-13, "{n} {x}");
                assert!((table.slopes(&[x], value)[0] - slope(x)).abs() < 1e-12, "{n} {x}");
            }
        }
    }

    /// scipy.interpolate.CubicSpline (1.17.1, not-a-knot): a sine at ten points, six uneven points,
    /// three points. 1e-14 is the rounding of a system of ten unknowns.
    #[test]
    fn splines_are_those_of_scipy() {
        let check = |points: &[[f64; 2]], expected: &[[f64; 2]]| {
            let table = Interpolation::new("t", points, InterpolationMethod::Cubic).unwrap();
            for &[x, y] in expected {
                let value = table.value(&[x]);
                assert!((value - y).abs() < 1e-14 * y.abs().max(1.0), "{x}: {value}");
            }
            table
        };
        let sine: Vec<[f64; 2]> =
            (0..10).map(|i| f64::from(i) * 0.7).map(|x| [x, libm::sin(x)]).collect();
        let expected = [
            [0.25, 0.251_857_632_738_685_2],
            [1.0, 0.839_619_755_328_918_2],
            [4.0, -0.756_460_340_540_927_6],
            [6.1, -0.186_329_951_470_395_4],
        ];
        let table = check(&sine, &expected);
        assert!((table.slopes(&[1.0], 0.0)[0] - 0.540_500_297_889_583_6).abs() < 1e-14);
        let uneven = [[0.0, 1.0], [1.0, 3.0], [3.0, 2.0], [4.0, 5.0], [4.5, 4.0], [7.0, -1.0]];
        let expected = [
            [0.5, 2.715_311_986_863_710_6],
            [2.0, 1.711_001_642_036_124_7],
            [3.7, 4.466_724_137_931_035],
            [6.0, -3.753_694_581_280_787_4],
        ];
        let table = check(&uneven, &expected);
        assert!((table.slopes(&[6.0], 0.0)[0] + 2.792_282_430_213_465).abs() < 1e-13);
        let three = [[0.0, 1.0], [1.0, 3.0], [3.0, 2.0]];
        check(&three, &[[0.5, 2.208_333_333_333_333_5], [2.0, 3.333_333_333_333_333]]);
    }

    #[test]
    fn straight_lines_and_their_kinks() {
        let points = [[3.0, 30.0], [1.0, 10.0], [0.0, 4.0]];
        let table = Interpolation::new("t", &points, InterpolationMethod::Linear).unwrap();
        assert_eq!(table.value(&[0.5]), 7.0);
        assert_eq!(table.value(&[1.0]), 10.0);
        assert_eq!(table.slopes(&[0.5], 7.0), [6.0]);
        assert_eq!(table.slopes(&[2.0], 20.0), [10.0]);
        assert_eq!(table.slopes(&[1.0], 10.0), [8.0]);
        assert_eq!(table.range(), [0.0, 3.0]);
        assert!(table.value(&[3.0 + 1e-14]).is_finite());
        assert!(table.value(&[3.1]).is_nan() && table.value(&[f64::NAN]).is_nan());
        assert_eq!(table.undefined(&[3.5]), "t at 3.5, outside its range 0 to 3");
    }

    #[test]
    fn points_that_make_no_table() {
        let fault = |points: &[[f64; 2]]| {
            Interpolation::new("t", points, InterpolationMethod::Linear).unwrap_err()
        };
        assert_eq!(fault(&[]), TableFault::TooFew);
        assert_eq!(fault(&[[1.0, 2.0]]), TableFault::TooFew);
        assert_eq!(fault(&[[1.0, 2.0], [2.0, 1.0], [2.0, 3.0]]), TableFault::Repeated(2));
        assert_eq!(fault(&[[1.0, 2.0], [2.0, 1.0], [1.5, 3.0]]), TableFault::Unsorted(2));
        assert_eq!(fault(&[[1.0, f64::NAN], [2.0, 1.0]]), TableFault::NotFinite(0));
    }
}
