//! The beta distribution: the regularized incomplete beta function I_x(a, b) and its inverse.

use super::normal;
use super::quadrature::decaying;
use super::root::{Point, Trend, find};
use super::weight::{beta_excess, beta_weight, exp_m1_minus, ln_1p_minus, ln_gamma_1p};

/// Shapes from here on use the quadrature for the tail that they determine.
const LARGE: f64 = 8.0;

/// Maximum number of terms of a series. The ratio of terms is at most 15/16 ([`smaller_side`]), so
/// about 600 terms are needed.
const TERMS: u32 = 1000;

/// I_x(a, b): the probability of a beta quantity of shapes a and b below `x`.
///
/// Shapes 0.05 to 1e6; relative error below 1e-13 for results above 1e-100, and also for the
/// smallest results some 1e-16 times their logarithm. 0 for x <= 0 and 1 for x >= 1.
pub fn cdf(x: f64, a: f64, b: f64) -> f64 {
    if !is_shape(a) || !is_shape(b) || x.is_nan() {
        f64::NAN
    } else if x <= 0.0 {
        0.0
    } else if x >= 1.0 {
        1.0
    } else {
        Masses::at(x, 1.0 - x, a, b).lower
    }
}

/// 1 - I_x(a, b): the probability of a beta quantity of shapes a and b above `x`.
///
/// Shapes 0.05 to 1e6; accuracy as of [`cdf`]. 1 for x <= 0 and 0 for x >= 1.
#[cfg(test)]
pub fn sf(x: f64, a: f64, b: f64) -> f64 {
    if !is_shape(a) || !is_shape(b) || x.is_nan() {
        f64::NAN
    } else if x <= 0.0 {
        1.0
    } else if x >= 1.0 {
        0.0
    } else {
        Masses::at(x, 1.0 - x, a, b).upper
    }
}

/// The x with I_x(a, b) = `p`.
///
/// Shapes 0.05 to 1e6, p in \[0, 1\]. The relative error of x, or of 1 - x before it is subtracted
/// where x is above 1/2, is below 2e-14 for shapes from 1 on; below that some 1e-14 / shape, because
/// x goes as p^(1 / a). Results below the smallest normal double are 0.
pub fn quantile(p: f64, a: f64, b: f64) -> f64 {
    if !is_shape(a) || !is_shape(b) || !(0.0..=1.0).contains(&p) {
        return f64::NAN;
    }
    let q = 1.0 - p;
    if p == 0.0 || p == 1.0 {
        return p;
    }
    let middle = Masses::at(0.5, 0.5, a, b);
    let below = if p <= 0.5 { p <= middle.lower } else { q >= middle.upper };
    if below { lower_half(p, q, a, b) } else { 1.0 - lower_half(q, p, b, a) }
}

fn is_shape(shape: f64) -> bool {
    (f64::MIN_POSITIVE..f64::INFINITY).contains(&shape)
}

/// The x in (0, 1/2\] with the masses `p` below and `q` above it.
fn lower_half(p: f64, q: f64, a: f64, b: f64) -> f64 {
    // I_x <= x^a / (a B(a, b)) for b >= 1, nearly equal for small x.
    let ln_bound = (libm::log(p) + ln_gamma_1p(a) + libm::lgamma(b) - libm::lgamma(a + b)) / a;
    let smallest = f64::MIN_POSITIVE;
    if ln_bound < libm::log(smallest) {
        return 0.0;
    }
    let bound = libm::exp(ln_bound);
    let start = if a > 1.0 && b > 1.0 { bound.max(carter(q, a, b)) } else { bound }.min(0.499);
    if p <= 0.5 {
        find(Trend::Rising, p, start, smallest, 0.6, |x| {
            let masses = Masses::at(x, 1.0 - x, a, b);
            Point { value: masses.lower, rate: masses.weight / (1.0 - x) }
        })
    } else {
        find(Trend::Falling, q, start, smallest, 0.6, |x| {
            let masses = Masses::at(x, 1.0 - x, a, b);
            Point { value: masses.upper, rate: masses.weight / (1.0 - x) }
        })
    }
}

/// The approximation of Carter 1947 (Abramowitz and Stegun 26.5.22), for shapes above 1; 0 where it
/// does not exist.
fn carter(q: f64, a: f64, b: f64) -> f64 {
    let z = normal::quantile_upper(q);
    let (u, v) = (1.0 / (2.0 * a - 1.0), 1.0 / (2.0 * b - 1.0));
    let lambda = (z * z - 3.0) / 6.0;
    let h = 2.0 / (u + v);
    let under = h + lambda;
    if under.is_nan() || under <= 0.0 {
        return 0.0;
    }
    // The source's y_p is -z, and its w is -w.
    let w = z * under.sqrt() / h + (v - u) * (lambda + 5.0 / 6.0 - 2.0 / (3.0 * h));
    a / (a + b * libm::exp(-2.0 * w))
}

/// Both tails at one point, and the weight x^a y^b / B(a, b).
pub(super) struct Masses {
    pub(super) lower: f64,
    pub(super) upper: f64,
    pub(super) weight: f64,
}

impl Masses {
    /// For a, b > 0 and x + y = 1, both positive. The smaller tail has the full relative accuracy.
    pub(super) fn at(x: f64, y: f64, a: f64, b: f64) -> Self {
        let excess = beta_excess(x, y, a, b);
        let weight = beta_weight(x, y, a, b, excess);
        if excess <= 0.0 {
            let (lower, upper) = smaller_side(x, y, a, b, -excess, weight);
            Self { lower, upper, weight }
        } else {
            let (upper, lower) = smaller_side(y, x, b, a, excess, weight);
            Self { lower, upper, weight }
        }
    }
}

/// I_x(a, b) and its complement for x below the mean, where `shortfall` = a - (a + b) x.
fn smaller_side(x: f64, y: f64, a: f64, b: f64, shortfall: f64, weight: f64) -> (f64, f64) {
    let corner = if a < LARGE { 1.0 / 16.0 } else { 0.25 / a };
    if b < 1.0 && y < corner {
        // Close to the end 1, where the complement takes a few terms and leaves at least 1 / 20.
        let upper = weight * series(y, b, a);
        (1.0 - upper, upper)
    } else {
        let lower = if a < LARGE {
            // x <= 15 / 16: otherwise b < 1 is dealt with above, and b >= 1 has y >= b / (a + b).
            weight * series(x, a, b)
        } else {
            weight * decaying(shortfall, (a + b) * x * y, |v| descent(x, y, a, b, shortfall, v))
        };
        (lower, 1.0 - lower)
    }
}

/// I_x(a, b) / (x^a y^b / B(a, b)) = (1 + x (a + b) / (a + 1) + ...) / a, all terms positive.
/// Source: DLMF 8.17.8.
fn series(x: f64, a: f64, b: f64) -> f64 {
    let mut term = 1.0 / a;
    let mut sum = term;
    let (mut above, mut below) = (a + b, a + 1.0);
    for _ in 0..TERMS {
        let ratio = above / below * x;
        term *= ratio;
        sum += term;
        if term < sum * 1e-17 * (1.0 - ratio) {
            break;
        }
        above += 1.0;
        below += 1.0;
    }
    sum
}

/// The descent of the logarithm of t^a (1 - t)^b from x to the t whose odds are e^-v of those of x,
/// and its slope: a v + (a + b) ln(1 + x (e^-v - 1)). Up to v = 1 its linear part is apart; above
/// x = 1/2 the roles of t and 1 - t are exchanged.
fn descent(x: f64, y: f64, a: f64, b: f64, shortfall: f64, v: f64) -> (f64, f64) {
    let n = a + b;
    let (share, linear, growth, w) =
        if x <= 0.5 { (x, a, libm::expm1(-v), -v) } else { (y, -b, libm::expm1(v), v) };
    let value = if v > 1.0 {
        linear * v + n * libm::log1p(share * growth)
    } else {
        shortfall * v + n * (ln_1p_minus(share * growth) + share * exp_m1_minus(w))
    };
    let part = n * share * (1.0 + growth) / (1.0 + share * growth);
    (value, if x <= 0.5 { linear - part } else { linear + part })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPES: [f64; 11] = [0.05, 0.3, 0.5, 1.0, 1.5, 7.999, 8.0, 40.0, 1e3, 1e5, 1e6];

    #[test]
    fn ends_and_nonsense() {
        for a in SHAPES {
            for b in SHAPES {
                assert_eq!((quantile(0.0, a, b), quantile(1.0, a, b)), (0.0, 1.0));
                assert_eq!((cdf(0.0, a, b), sf(0.0, a, b)), (0.0, 1.0));
                assert_eq!((cdf(1.0, a, b), sf(1.0, a, b)), (1.0, 0.0));
                assert!(cdf(f64::NAN, a, b).is_nan() && sf(f64::NAN, a, b).is_nan());
                for p in [-0.1, 1.1, f64::NAN] {
                    assert!(quantile(p, a, b).is_nan(), "p {p}");
                }
            }
            for b in [0.0, -1.0, f64::NAN, f64::INFINITY] {
                assert!(quantile(0.3, a, b).is_nan() && quantile(0.3, b, a).is_nan());
                assert!(cdf(0.3, a, b).is_nan() && sf(0.3, b, a).is_nan());
            }
        }
    }

    // I_x(a, 1) = x^a and I_x(1, 1) = x. 1e-14: some roundings of exponents up to 20.
    #[test]
    fn second_shape_one_is_a_power() {
        for a in [0.05, 0.5, 1.0, 2.0, 7.9, 8.1, 25.0] {
            for i in 1..100 {
                let x = 0.01 * f64::from(i);
                let power = libm::pow(x, a);
                assert!((cdf(x, a, 1.0) / power - 1.0).abs() < 1e-14 * (1.0 + a), "{x}, {a}");
            }
        }
    }

    // The error of p, with that of rounding x to a double: it moves I_x by x f(x) / I_x, the root
    // of the shapes or so, and more below the mean of small second shapes, where x is next to 1.
    #[test]
    fn quantile_inverts_and_rises() {
        for a in SHAPES {
            for b in SHAPES {
                let mut last = 0.0;
                for i in 1..100 {
                    let p = f64::from(i) * 0.01;
                    let x = quantile(p, a, b);
                    assert!(
                        x > last || (x == last && x > 0.999),
                        "{p}, {a}, {b}: {x:e} after {last:e}"
                    );
                    last = x;
                    if x < 0.9 {
                        let error = (cdf(x, a, b) / p - 1.0).abs();
                        let allowed = 1.5e-14 + 8e-16 * a.min(b).sqrt();
                        assert!(error < allowed, "{p}, {a}, {b}: {error:e}");
                    }
                }
            }
        }
    }

    // I_x(a, b) = 1 - I_(1-x)(b, a), for x that are exact in both; the tail
    // of 2^-1000 at the shape 1000 has the largest error.
    #[test]
    fn symmetry() {
        for a in SHAPES {
            for b in SHAPES {
                for i in 1..16 {
                    let x = f64::from(i) / 16.0;
                    let (value, mirrored) = (cdf(x, a, b), sf(1.0 - x, b, a));
                    let scale = value.min(1.0 - value);
                    assert!((value - mirrored).abs() <= 5e-13 * scale, "{x}, {a}, {b}");
                }
            }
        }
    }

    #[test]
    fn absurd_arguments_end() {
        let shapes = [f64::MIN_POSITIVE, 1e-300, 1e-10, 1e-3, 1.0, 1e10, 1e100];
        for a in shapes {
            for b in shapes {
                for p in [5e-324, 0.1, 0.5, 0.9, 1.0 - f64::EPSILON] {
                    let x = quantile(p, a, b);
                    assert!((0.0..=1.0).contains(&x), "quantile({p:e}, {a:e}, {b:e}) = {x}");
                }
                for x in [5e-324, 1e-200, 0.5, 1.0 - f64::EPSILON] {
                    let p = cdf(x, a, b);
                    assert!((0.0..=1.0).contains(&p), "cdf({x:e}, {a:e}, {b:e}) = {p}");
                }
            }
        }
    }
}
