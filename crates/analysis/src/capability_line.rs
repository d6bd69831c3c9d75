//! The line of a capability over a condition, fitted to the expanded uncertainties of a sweep so that
//! none lies above it: Q\[a; bL\] = sqrt(a^2 + (b L)^2), or a + b L, as schedules of accreditation and the
//! CMCs of the CIPM MRA have it.

use gumption_engine::number::elementary::hypot;

/// How the two terms add.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineForm {
    /// The root of the sum of squares, Q\[a; bL\].
    Quadratic,
    /// The sum a + b L.
    Linear,
}

/// A line that is fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedLine {
    /// How the terms add.
    pub form: LineForm,
    /// The value at 0, at least 0.
    pub constant: f64,
    /// The slope over the modulus of the condition, at least 0.
    pub slope: f64,
}

impl FittedLine {
    /// The line at a value of the condition.
    pub fn at(&self, condition: f64) -> f64 {
        let (a, b) = (self.constant, self.slope * condition.abs());
        match self.form {
            LineForm::Quadratic => hypot(a, b),
            LineForm::Linear => a + b,
        }
    }
}

/// The smallest line over points (condition, U), with the least mean excess of U, or of U^2 for
/// Q\[a; bL\]: a linear programme in a and b, or their squares, whose solution is the side of the convex
/// hull over the mean of the conditions, or a line with a = 0 or b = 0. Both numbers are rounded up to
/// this many significant digits, so that no point comes to lie above it. `None` without points, or with
/// one that is not finite.
pub fn fit(points: &[(f64, f64)], form: LineForm, digits: u32) -> Option<FittedLine> {
    let transformed = |value: f64| match form {
        LineForm::Quadratic => value * value,
        LineForm::Linear => value.abs(),
    };
    let mut points: Vec<(f64, f64)> =
        points.iter().map(|(x, y)| (transformed(*x), transformed(*y))).collect();
    if points.is_empty() || points.iter().any(|(x, y)| !x.is_finite() || !y.is_finite()) {
        return None;
    }
    let middle = points.iter().map(|(x, _)| x).sum::<f64>() / points.len() as f64;
    points.sort_by(|a, b| a.0.total_cmp(&b.0).then(b.1.total_cmp(&a.1)));
    points.dedup_by(|later, first| later.0 == first.0);
    let hull = upper_hull(&points);
    let highest = points.iter().map(|(_, y)| *y).fold(0.0, f64::max);
    let mut lines = vec![(highest, 0.0)];
    lines.extend(hull.windows(2).map(|side| {
        let slope = (side[1].1 - side[0].1) / (side[1].0 - side[0].0);
        (side[0].1 - slope * side[0].0, slope)
    }));
    // through 0 there is one where no point lies there
    let steepest = points.iter().map(|(x, y)| y / x).fold(0.0, f64::max);
    lines.extend(steepest.is_finite().then_some((0.0, steepest)));
    let rounding = 1e-12 * highest;
    let is_above = |(a, b): &(f64, f64)| points.iter().all(|(x, y)| a + b * x >= y - rounding);
    let (a, b) =
        lines.into_iter().filter(|(a, b)| *a >= 0.0 && *b >= 0.0).filter(is_above).min_by(
            |first, second| (first.0 + first.1 * middle).total_cmp(&(second.0 + second.1 * middle)),
        )?;
    let up = |value: f64| {
        let value = match form {
            LineForm::Quadratic => value.sqrt(),
            LineForm::Linear => value,
        };
        rounded_up(value, digits)
    };
    Some(FittedLine { form, constant: up(a), slope: up(b) })
}

/// The upper side of the convex hull of points in ascending order.
fn upper_hull(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut hull: Vec<(f64, f64)> = Vec::new();
    for &point in points {
        while let [.., before, last] = hull[..] {
            let turn = (last.0 - before.0) * (point.1 - before.1)
                - (last.1 - before.1) * (point.0 - before.0);
            if turn < 0.0 {
                break;
            }
            hull.pop();
        }
        hull.push(point);
    }
    hull
}

/// The number above with this many significant digits, or the number itself where it has no more but for
/// the last bits of its computation.
fn rounded_up(value: f64, digits: u32) -> f64 {
    let text = format!("{value:.*e}", digits.saturating_sub(1) as usize);
    let nearest: f64 = text.parse().unwrap_or(value);
    if nearest >= value * (1.0 - 1e-12) {
        return nearest;
    }
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let place = exponent.parse::<i32>().unwrap_or(0) + 1 - digits as i32;
    let whole: String = mantissa.chars().filter(char::is_ascii_digit).collect();
    let next = whole.parse::<u64>().unwrap_or(0) + 1;
    format!("{next}e{place}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A generator for the points (Knuth's MMIX constants), uniform from 0 to 1.
    fn draws(mut state: u64) -> impl FnMut() -> f64 {
        move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    /// By brute force: of all lines through two points, of the horizontal one and of those through 0, the
    /// one with the least mean excess among those with no point above; 200 sets of 3 to 14 points, to
    /// 1e-9 with 12 digits.
    #[test]
    fn the_line_is_that_of_brute_force() {
        let mut draw = draws(66);
        for set in 0..200 {
            let form = [LineForm::Quadratic, LineForm::Linear][set % 2];
            let of = |value: f64| if form == LineForm::Linear { value } else { value * value };
            let count = 3 + set % 12;
            let slope = 4.0 * draw() - 2.0;
            let points: Vec<(f64, f64)> = (0..count)
                .map(|_| {
                    let x = if set % 5 == 0 { 10.0 * draw().round() } else { 10.0 * draw() };
                    (x, (3.0 + slope * x + 2.0 * draw()).abs() + 0.1)
                })
                .collect();
            let found = fit(&points, form, 12).expect("a line");
            let mean = |(a, b): (f64, f64)| {
                points.iter().map(|(x, y)| a + b * of(*x) - of(*y)).sum::<f64>() / count as f64
            };
            let mut candidates = vec![];
            for (i, (x, y)) in points.iter().enumerate() {
                let (x, y) = (of(*x), of(*y));
                candidates.extend([(y, 0.0), (0.0, y / x)]);
                for (other, height) in points.iter().take(i) {
                    let b = (of(*height) - y) / (of(*other) - x);
                    candidates.push((y - b * x, b));
                }
            }
            let is_allowed = |(a, b): &(f64, f64)| {
                *a >= 0.0
                    && *b >= 0.0
                    && b.is_finite()
                    && points.iter().all(|(x, y)| a + b * of(*x) >= of(*y) * (1.0 - 1e-12))
            };
            let best = candidates.into_iter().filter(is_allowed).map(mean).fold(f64::MAX, f64::min);
            let own = mean((of(found.constant), of(found.slope)));
            assert!((own - best).abs() < 1e-9 * (1.0 + best), "set {set}: {own} {best} {found:?}");
        }
    }

    /// After rounding no point lies above, and one digit less at either number would leave one.
    #[test]
    fn rounding_goes_up() {
        // U = Q[0.1234; 0.0056 L] exactly
        let exact = FittedLine { form: LineForm::Quadratic, constant: 0.1234, slope: 0.0056 };
        let points: Vec<(f64, f64)> =
            [0.0, 5.0, 20.0, 100.0].iter().map(|l| (*l, exact.at(*l))).collect();
        let line = fit(&points, LineForm::Quadratic, 2).expect("a line");
        assert_eq!((line.constant, line.slope), (0.13, 0.0056));
        assert!(points.iter().all(|(l, u)| line.at(*l) >= *u));
        let linear = fit(&[(0.0, 0.2), (10.0, 0.31), (20.0, 0.4)], LineForm::Linear, 2);
        let linear = linear.expect("a line");
        // over the mean 10: the side from 10 to 20 and that from 0 to 10 both go through (10, 0.31)
        assert!(linear.at(10.0) >= 0.31 && linear.at(0.0) >= 0.2 && linear.at(20.0) >= 0.4);
        assert_eq!(rounded_up(0.1, 2), 0.1);
        assert_eq!(rounded_up(0.9951, 2), 1.0);
        assert_eq!(rounded_up(99.1, 2), 100.0);
        assert_eq!(rounded_up(0.0, 2), 0.0);
        // a falling U has a horizontal line
        let falling = fit(&[(1.0, 2.0), (2.0, 1.0)], LineForm::Linear, 3).expect("a line");
        assert_eq!((falling.constant, falling.slope), (2.0, 0.0));
    }
}
