//! The root of a monotone function in log-log coordinates.

/// A positive function at one argument.
pub(crate) struct Point {
    /// The value f(x).
    pub(crate) value: f64,
    /// |df / d ln x|.
    pub(crate) rate: f64,
}

/// Whether the function rises or falls with x.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Trend {
    Rising,
    Falling,
}

/// Number of steps that may be Newton's. From the usual starting approximations 60 000 random
/// quantiles took at most 17.
const NEWTON_STEPS: u32 = 40;

/// Maximum number of steps of a search: after Newton's, enough bisections of the logarithm of the
/// whole range of doubles (2^11 factors of 2) to reach one unit in the last place (2^-52).
const STEPS: u32 = NEWTON_STEPS + 64;

/// The x in \[`low`, `high`\] (both positive) with f(x) = `target`: Newton's method on ln f over
/// ln x, kept within a bracket; where Newton leaves the bracket, its geometric mean. The nearest
/// end if there is no root.
///
/// The tails met here are concave in these coordinates, so that Newton's steps settle on one side
/// of the root. A step below 1e-9 is the last one, as its successor would be within rounding.
pub(crate) fn find(
    trend: Trend,
    target: f64,
    start: f64,
    mut low: f64,
    mut high: f64,
    f: impl Fn(f64) -> Point,
) -> f64 {
    let inside = |x: f64, low: f64, high: f64| x > low && x < high;
    let mut x = if inside(start, low, high) { start } else { low.sqrt() * high.sqrt() };
    for step in 0..STEPS {
        let Point { value, rate } = f(x);
        if (value < target) == (trend == Trend::Rising) {
            low = x;
        } else {
            high = x;
        }
        let rise = libm::log(target / value) * (value / rate);
        let newton = if trend == Trend::Rising { rise } else { -rise };
        let next = x * libm::exp(newton);
        if newton.abs() < 1e-9 {
            return next;
        }
        x = if step < NEWTON_STEPS && inside(next, low, high) {
            next
        } else {
            low.sqrt() * high.sqrt()
        };
        if !inside(x, low, high) {
            break;
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    // 1e-15 is the rounding of the last step.
    #[test]
    fn powers_both_ways() {
        for target in [1e-200, 0.3, 1.0, 1e250] {
            let rising = find(Trend::Rising, target, 1.0, f64::MIN_POSITIVE, f64::MAX, |x| Point {
                value: x,
                rate: x,
            });
            assert!((rising / target - 1.0).abs() < 1e-15, "{rising:e} for {target:e}");
            let falling = find(Trend::Falling, target, 1.0, f64::MIN_POSITIVE, f64::MAX, |x| {
                Point { value: 1.0 / x, rate: 1.0 / x }
            });
            assert!((falling * target - 1.0).abs() < 1e-15, "{falling:e} for {target:e}");
        }
    }

    // Newton's steps are useless here: the halvings alone come to a relative 1e-15.
    #[test]
    fn ends_with_a_wrong_rate_and_without_a_root() {
        let x = find(Trend::Rising, 7.0, 1.0, f64::MIN_POSITIVE, f64::MAX, |x| Point {
            value: x,
            rate: 1e-300,
        });
        assert!((x / 7.0 - 1.0).abs() < 1e-14, "{x}");
        let x = find(Trend::Rising, 2.0, 0.3, 0.25, 0.5, |_| Point { value: 0.0, rate: 0.0 });
        assert!((x - 0.5).abs() < 1e-15, "{x}");
    }
}
