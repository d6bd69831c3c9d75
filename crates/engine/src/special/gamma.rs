//! The gamma distribution of unit scale: the regularized incomplete gamma functions P(a, x) and
//! Q(a, x), and their inverse.

use super::normal;
use super::quadrature::decaying;
use super::root::{Point, Trend, find};
use super::weight::{exp_m1_minus, gamma_weight, ln_gamma_1p};
use crate::number::elementary;

/// Shapes from here on use the quadrature on both sides of the mean.
const LARGE: f64 = 8.0;

/// Maximum number of terms of a series. The terms of the longest one (shape and x below 8) fall
/// below rounding after about 60.
const TERMS: u32 = 200;

/// The logarithmic derivative of the gamma function; NaN at 0 and at negative whole numbers.
///
/// The asymptotic series (DLMF 5.11.2) from 10 on, where its first neglected term is below 1e-15 of
/// the result, reached by the recurrence ψ(x) = ψ(x + 1) − 1/x and, below 0, by reflection.
pub fn digamma(x: f64) -> f64 {
    if x <= 0.0 {
        if x == x.floor() {
            return f64::NAN;
        }
        let angle = std::f64::consts::PI * x;
        return digamma(1.0 - x) - std::f64::consts::PI / elementary::tan(angle);
    }
    let (mut x, mut sum) = (x, 0.0);
    while x < 10.0 {
        sum -= 1.0 / x;
        x += 1.0;
    }
    let z = 1.0 / (x * x);
    let series = z
        * (1.0 / 12.0
            - z * (1.0 / 120.0
                - z * (1.0 / 252.0
                    - z * (1.0 / 240.0 - z * (1.0 / 132.0 - z * (691.0 / 32760.0 - z / 12.0))))));
    sum + elementary::ln(x) - 0.5 / x - series
}

/// P(a, x): the probability of a gamma quantity of shape a and unit scale below `x`.
///
/// Shapes 1e-3 to 1e7; relative error below 1e-13 for results above 1e-100, and also for the
/// smallest results some 1e-16 times their logarithm. 0 for x <= 0.
#[cfg(test)]
pub fn cdf(x: f64, shape: f64) -> f64 {
    if !is_shape(shape) || x.is_nan() {
        f64::NAN
    } else if x <= 0.0 {
        0.0
    } else if x.is_infinite() {
        1.0
    } else {
        Masses::at(x, shape).lower
    }
}

/// Q(a, x): the probability of a gamma quantity of shape a and unit scale above `x`.
///
/// Shapes 1e-3 to 1e7; accuracy as of `cdf`. 1 for x <= 0.
pub fn sf(x: f64, shape: f64) -> f64 {
    if !is_shape(shape) || x.is_nan() {
        f64::NAN
    } else if x <= 0.0 {
        1.0
    } else if x.is_infinite() {
        0.0
    } else {
        Masses::at(x, shape).upper
    }
}

/// The x with P(a, x) = `p`.
///
/// Shapes 1e-3 to 1e7, p in \[0, 1\]. The relative error is below 1e-14 for shapes from 1 on; below
/// that some 5e-15 / shape, because x goes as p^(1 / shape). Results below the smallest normal
/// double are 0.
pub fn quantile(p: f64, shape: f64) -> f64 {
    between(p, 1.0 - p, shape)
}

/// The x with Q(a, x) = `q`, for tails down to the smallest double. Accuracy as of [`quantile`].
pub fn quantile_upper(q: f64, shape: f64) -> f64 {
    between(1.0 - q, q, shape)
}

/// The x with the tails `p` below and `q` above; the smaller of the two is used.
fn between(p: f64, q: f64, shape: f64) -> f64 {
    if !is_shape(shape) || !(0.0..=1.0).contains(&p) || !(0.0..=1.0).contains(&q) {
        return f64::NAN;
    }
    if p == 0.0 {
        return 0.0;
    }
    if q == 0.0 {
        return f64::INFINITY;
    }
    // P(a, x) <= x^a / Γ(a + 1), nearly equal for small x: a lower bound of the root.
    let ln_bound = (libm::log(p) + ln_gamma_1p(shape)) / shape;
    let (smallest, largest) = (f64::MIN_POSITIVE, f64::MAX);
    if ln_bound < libm::log(smallest) {
        return 0.0;
    }
    let bound = libm::exp(ln_bound);
    let start = if shape < 1.0 { bound } else { bound.max(wilson_hilferty(p, q, shape)) };
    if p <= 0.5 {
        find(Trend::Rising, p, start, smallest, largest, |x| {
            let masses = Masses::at(x, shape);
            Point { value: masses.lower, rate: masses.weight }
        })
    } else {
        // For shapes below 1, Q(a, x) <= e^-x beyond 1: an upper bound of the root.
        let start = if shape < 1.0 && q < 0.1 * shape { -libm::log(q) } else { start };
        find(Trend::Falling, q, start, smallest, largest, |x| {
            let masses = Masses::at(x, shape);
            Point { value: masses.upper, rate: masses.weight }
        })
    }
}

/// The natural logarithm of Q(a, x), also if Q is smaller than any double.
///
/// Shapes 0.5 to 1e7; relative error of Q below 1e-9, which is enough to rank tails. By the power
/// series below a + 1 and by the continued fraction above (DLMF 8.7.1 and 8.9.2).
pub fn ln_sf(x: f64, shape: f64) -> f64 {
    if !is_shape(shape) || x.is_nan() {
        return f64::NAN;
    }
    if x <= 0.0 {
        return 0.0;
    }
    let ln_weight = shape * libm::log(x) - x - libm::lgamma(shape);
    if x < shape + 1.0 {
        let (mut term, mut sum) = (1.0 / shape, 1.0 / shape);
        let mut denominator = shape;
        while term > 1e-17 * sum {
            denominator += 1.0;
            term *= x / denominator;
            sum += term;
        }
        return libm::log1p(-(libm::exp(ln_weight) * sum).min(1.0));
    }
    // the modified method of Lentz
    let mut b = x + 1.0 - shape;
    let mut c = 1e300;
    let mut d = 1.0 / b;
    let mut fraction = d;
    for i in 1..100_000 {
        let i = f64::from(i);
        let a = -i * (i - shape);
        b += 2.0;
        d = 1.0 / (a * d + b);
        c = b + a / c;
        let step = c * d;
        fraction *= step;
        if (step - 1.0).abs() < 1e-12 {
            break;
        }
    }
    ln_weight + libm::log(fraction)
}

fn is_shape(shape: f64) -> bool {
    (f64::MIN_POSITIVE..f64::INFINITY).contains(&shape)
}

/// The approximation of Wilson and Hilferty 1931; 0 where it is not positive.
fn wilson_hilferty(p: f64, q: f64, shape: f64) -> f64 {
    let spread = 1.0 / (9.0 * shape);
    let normal = if p > 0.5 { normal::quantile_upper(q) } else { normal::quantile(p) };
    let root = 1.0 - spread + normal * spread.sqrt();
    if root > 0.0 { shape * root * root * root } else { 0.0 }
}

/// Both tails at one point, and the weight x^a e^(-x) / Γ(a), which is dP / d ln x.
struct Masses {
    lower: f64,
    upper: f64,
    weight: f64,
}

impl Masses {
    /// For a, x > 0 and finite. The smaller tail has the full relative accuracy.
    fn at(x: f64, a: f64) -> Self {
        let weight = gamma_weight(x, a);
        if x <= a {
            let lower = if a < LARGE {
                weight * lower_series(x, a)
            } else {
                // With t = x e^-v the integrand is t^a e^-t.
                let h =
                    |v: f64| ((a - x) * v + x * exp_m1_minus(-v), (a - x) - x * libm::expm1(-v));
                weight * decaying(a - x, x, h)
            };
            let upper = if a < 1.0 { small_upper(x, a) } else { 1.0 - lower };
            Self { lower, upper, weight }
        } else if x < 1.0 {
            Self { lower: weight * lower_series(x, a), upper: small_upper(x, a), weight }
        } else {
            // With t = x e^v the integrand is t^a e^-t.
            let h = |v: f64| ((x - a) * v + x * exp_m1_minus(v), (x - a) + x * libm::expm1(v));
            let upper = weight * decaying(x - a, x, h);
            Self { lower: 1.0 - upper, upper, weight }
        }
    }
}

/// P(a, x) / (x^a e^(-x) / Γ(a)) = 1 / a + x / (a (a + 1)) + ..., for x up to a or up to 1.
/// Source: DLMF 8.11.4.
fn lower_series(x: f64, a: f64) -> f64 {
    let mut term = 1.0 / a;
    let mut sum = term;
    let mut divisor = a;
    for _ in 0..TERMS {
        divisor += 1.0;
        term *= x / divisor;
        sum += term;
        if term < sum * 1e-17 {
            break;
        }
    }
    sum
}

/// Q(a, x) for a, x < 1 without the cancellation of 1 - P: with u = ln(x^a / Γ(a + 1)), and
/// P = e^u (1 - J), it is J e^u - (e^u - 1). Source: DLMF 8.7.1 for P.
fn small_upper(x: f64, a: f64) -> f64 {
    let u = a * libm::log(x) - ln_gamma_1p(a);
    let mut power = 1.0;
    let mut sum = 0.0;
    for k in 1..=20_u8 {
        let k = f64::from(k);
        power *= -x / k;
        sum -= power / (a + k);
    }
    a * sum * libm::exp(u) - libm::expm1(u)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// mpmath 1.3, 30 digits. The recurrence adds up to 14 terms: 1e-14 relative, or absolute below 1
    /// where the terms cancel.
    #[test]
    fn digamma_against_mpmath() {
        let table = [
            (0.1, -10.423754940411076),
            (1.0, -0.5772156649015329),
            (2.5, 0.7031566406452432),
            (9.9, 2.2411803166063814),
            (10.5, 2.3030010342976864),
            (-0.3, 2.113309779635399),
            (-3.7, -0.8450768588704194),
            (150.0, 5.0072982570756793),
        ];
        for (x, expected) in table {
            let found = digamma(x);
            assert!((found - expected).abs() < 1e-14 * expected.abs().max(1.0), "{x}: {found}");
        }
        assert!(digamma(0.0).is_nan() && digamma(-2.0).is_nan());
    }

    const SHAPES: [f64; 13] =
        [1e-3, 0.05, 0.5, 0.999, 1.0, 1.5, 7.999, 8.0, 30.0, 1e3, 1e5, 1e6, 1e7];

    #[test]
    fn ends_and_nonsense() {
        for a in SHAPES {
            assert_eq!((quantile(0.0, a), quantile(1.0, a)), (0.0, f64::INFINITY));
            assert_eq!((cdf(0.0, a), sf(0.0, a)), (0.0, 1.0));
            assert_eq!((cdf(f64::INFINITY, a), sf(f64::INFINITY, a)), (1.0, 0.0));
            assert!(cdf(f64::NAN, a).is_nan() && sf(f64::NAN, a).is_nan());
            for p in [-0.1, 1.1, f64::NAN] {
                assert!(quantile(p, a).is_nan(), "p {p}");
            }
        }
        for a in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(quantile(0.3, a).is_nan() && cdf(0.3, a).is_nan() && sf(0.3, a).is_nan());
        }
    }

    // The exponential distribution. 1e-14: some roundings of exponents up to 30.
    #[test]
    fn shape_one_is_the_exponential_distribution() {
        for i in 1..300 {
            let x = 0.1 * f64::from(i);
            assert!((sf(x, 1.0) / libm::exp(-x) - 1.0).abs() < 1e-14, "sf at {x}");
            assert!((cdf(x, 1.0) / -libm::expm1(-x) - 1.0).abs() < 1e-14, "cdf at {x}");
        }
    }

    // The error of p is at most 1e-14, that of x the same over d ln p / d ln x, which is at least
    // the smaller of the shape and 1 / 30 for these p; above the median p itself holds the tail
    // only to 1.1e-16 / (1 - p).
    #[test]
    fn quantile_inverts_and_rises() {
        for a in SHAPES {
            let mut last = 0.0;
            for i in 1..1000 {
                let p = f64::from(i) * 1e-3;
                let x = quantile(p, a);
                assert!(x > last || x == 0.0, "p {p}, shape {a}: {x:e} after {last:e}");
                last = x;
                if x > 0.0 {
                    let error = (cdf(x, a) / p - 1.0).abs();
                    // Rounding x to a double moves P by x f(x) / P, some 4 roots of a.
                    let allowed = 1e-14 + 8e-16 * a.sqrt();
                    assert!(error < allowed, "p {p}, shape {a}: {error:e}");
                }
            }
        }
    }

    // P and Q just below and just above each change of method. 1e-13: the error allowed, and the
    // change of the functions over the gap.
    #[test]
    fn methods_meet() {
        let gap = 1.0 + 1e-15;
        for (x, a) in [(1.0, 0.3), (1.0, 0.9), (5.0, 8.0), (8.0, 8.0), (0.5, 1.0), (20.0, 20.0)] {
            for f in [cdf, sf] {
                let corners = [f(x, a), f(x * gap, a), f(x, a * gap), f(x / gap, a / gap)];
                for value in corners {
                    assert!((value / corners[0] - 1.0).abs() < 1e-13, "({x}, {a}): {corners:?}");
                }
            }
        }
    }

    #[test]
    fn absurd_arguments_end() {
        for a in [f64::MIN_POSITIVE, 1e-300, 1e-10, 1e10, 1e100] {
            for p in [5e-324, 0.1, 0.9, 1.0 - f64::EPSILON] {
                assert!(quantile(p, a) >= 0.0, "quantile({p:e}, {a:e})");
            }
            for x in [5e-324, 1e-200, 1.0, 1e200] {
                assert!((0.0..=1.0).contains(&cdf(x, a)), "cdf({x:e}, {a:e})");
            }
        }
    }
}
