//! Student's t distribution with real degrees of freedom, and the coverage factor.

use std::f64::consts::{FRAC_PI_2, SQRT_2};

use super::beta;
use super::normal;
use super::root::{Point, Trend, find};
use super::weight::{ln_1p_minus, stirling_error};

/// From here on the distribution is the normal one: the quantile differs from it by a relative (z²
/// + 1) / (4 dof), below 4e-18 for every z that corresponds to a double tail.
const NORMAL: f64 = 1e20;

/// The probability of a t quantity below `t`, for `dof` > 0 degrees of freedom (infinite: normal).
///
/// Relative error below 1e-13 for results above 1e-100, and also for the smallest results some
/// 1e-16 times their logarithm.
pub fn cdf(t: f64, dof: f64) -> f64 {
    sf(-t, dof)
}

/// The probability of a t quantity above `t`, for `dof` > 0 degrees of freedom (infinite: normal).
///
/// Accuracy as of [`cdf`].
pub fn sf(t: f64, dof: f64) -> f64 {
    if dof.is_nan() || dof <= 0.0 || t.is_nan() {
        return f64::NAN;
    }
    if dof >= NORMAL {
        return normal::sf(t);
    }
    let masses = Masses::at(t.abs(), dof);
    if t > 0.0 { 0.5 * masses.outer } else { 0.5 * masses.inner + 0.5 }
}

/// The t that a t quantity with `dof` > 0 degrees of freedom stays below with probability `p`.
///
/// Relative error below 1e-14 for dof from 0.5 on, some 5e-15 / dof below that, for the exact double
/// `p` in \[0, 1\] with tails down to 1e-12. Beyond the range of doubles the result is infinite.
pub fn quantile(p: f64, dof: f64) -> f64 {
    // 1 - p is exact for p >= 1/2, and 1 - 2 p wherever `magnitude` relies on it.
    if p > 0.5 {
        magnitude(2.0 * p - 1.0, 2.0 * (1.0 - p), dof)
    } else {
        -magnitude(1.0 - 2.0 * p, 2.0 * p, dof)
    }
}

/// The coverage factor k for which a t quantity with `dof` > 0 degrees of freedom lies within
/// -k ... k with this probability, in \[0, 1\] (JCGM 100, G.3).
///
/// Accuracy as of [`quantile`].
pub fn two_sided_factor(probability: f64, dof: f64) -> f64 {
    magnitude(probability, 1.0 - probability, dof)
}

/// The t with P(|T| <= t) = `inner` and P(|T| > t) = `outer`; the smaller of the two is used.
fn magnitude(inner: f64, outer: f64, dof: f64) -> f64 {
    let probabilities = 0.0..=1.0;
    if dof.is_nan()
        || dof <= 0.0
        || !probabilities.contains(&inner)
        || !probabilities.contains(&outer)
    {
        return f64::NAN;
    }
    if inner == 0.0 {
        return 0.0;
    }
    if outer == 0.0 {
        return f64::INFINITY;
    }
    if dof == 1.0 {
        cauchy(inner, outer)
    } else if dof == 2.0 {
        // P(|T| <= t) = t / sqrt(2 + t^2).
        let inner = if inner <= 0.5 { inner } else { 1.0 - outer };
        SQRT_2 * inner / (outer * (1.0 + inner)).sqrt()
    } else if dof >= NORMAL {
        normal_magnitude(inner, outer)
    } else if inner <= 0.5 {
        let start = inner / (2.0 * peak(dof));
        find(Trend::Rising, inner, start, f64::MIN_POSITIVE, f64::MAX, |t| {
            let masses = Masses::at(t, dof);
            Point { value: masses.inner, rate: masses.rate }
        })
    } else {
        from_outer(outer, dof)
    }
}

fn cauchy(inner: f64, outer: f64) -> f64 {
    if inner <= 0.5 { libm::tan(FRAC_PI_2 * inner) } else { 1.0 / libm::tan(FRAC_PI_2 * outer) }
}

fn normal_magnitude(inner: f64, outer: f64) -> f64 {
    if inner <= 0.5 {
        normal::from_center(0.5 * inner)
    } else {
        normal::quantile_upper(0.5 * outer)
    }
}

/// The t with P(|T| > t) = `outer`, at most 1/2, by a search from an approximation.
fn from_outer(outer: f64, dof: f64) -> f64 {
    let z = normal::quantile_upper(0.5 * outer);
    let square = z * z;
    // The expansion of Cornish and Fisher (Abramowitz and Stegun 26.7.5), good for large dof.
    let expansion = z
        * (1.0
            + (square + 1.0) / (4.0 * dof)
            + ((5.0 * square + 16.0) * square + 3.0) / (96.0 * dof * dof));
    // The leading term of the tail, good for small dof: 2 f(0) (dof / t^2)^(dof / 2) / sqrt(dof).
    let ln_power = libm::log(2.0 * peak(dof) / (outer * dof.sqrt())) / dof;
    let ln_start = 0.5 * libm::log(dof) + ln_power;
    if ln_start > libm::log(f64::MAX) {
        return f64::INFINITY;
    }
    // Better for larger dof with dof / (dof + t^2) for dof / t^2: 1 + t^2 / dof = e^(2 ln_power).
    let power = if ln_power > 300.0 {
        libm::exp(ln_start)
    } else {
        (dof * libm::expm1(2.0 * ln_power).max(0.0)).sqrt()
    };
    let start = if dof < 1.0 { power } else { power.max(expansion) };
    find(Trend::Falling, outer, start, f64::MIN_POSITIVE, f64::MAX, |t| {
        let masses = Masses::at(t, dof);
        Point { value: masses.outer, rate: masses.rate }
    })
}

/// The density at 0: Γ((dof + 1) / 2) / (sqrt(π dof) Γ(dof / 2)).
fn peak(dof: f64) -> f64 {
    let half = 0.5 * dof;
    if half < 10.0 {
        return libm::tgamma(half + 0.5) / libm::tgamma(half) / (std::f64::consts::PI * dof).sqrt();
    }
    let exponent =
        half * ln_1p_minus(1.0 / dof) + (stirling_error(half + 0.5) - stirling_error(half));
    libm::exp(exponent) / std::f64::consts::TAU.sqrt()
}

/// P(|T| <= t), P(|T| > t) and dP(|T| <= t) / d ln t.
struct Masses {
    inner: f64,
    outer: f64,
    rate: f64,
}

impl Masses {
    /// For t >= 0 and 0 < dof < [`NORMAL`]. The smaller mass has the full relative accuracy.
    fn at(t: f64, dof: f64) -> Self {
        let scaled = t / dof.sqrt();
        let square = scaled * scaled;
        if (dof + 1.0) * square < 1e-17 {
            // The density is still at its peak.
            let inner = 2.0 * peak(dof) * t;
            return Self { inner, outer: 1.0 - inner, rate: inner };
        }
        if square * 1e-17 > dof + 1.0 {
            // Only the leading term of the tail is left.
            let rate = 2.0 * peak(dof) * dof.sqrt() * libm::pow(scaled, -dof);
            let outer = rate / dof;
            return Self { inner: 1.0 - outer, outer, rate };
        }
        // t^2 / (dof + t^2) has the beta distribution of shapes 1/2 and dof / 2.
        let square = t * t / dof;
        let masses =
            beta::Masses::at(square / (1.0 + square), 1.0 / (1.0 + square), 0.5, 0.5 * dof);
        Self { inner: masses.lower, outer: masses.upper, rate: 2.0 * masses.weight }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DOFS: [f64; 17] = [
        0.1,
        0.5,
        1.0,
        1.5,
        2.0,
        3.0,
        15.9,
        16.1,
        50.0,
        1e3,
        1e6,
        1e9,
        1e12,
        0.999e20,
        1e20,
        1e300,
        f64::INFINITY,
    ];

    // EA-4/02 M: 2022, table of coverage factors for a coverage probability of 95.45 %.
    #[test]
    fn coverage_factors_of_ea_4_02() {
        let table = [
            (1.0, 13.97),
            (2.0, 4.53),
            (3.0, 3.31),
            (4.0, 2.87),
            (5.0, 2.65),
            (6.0, 2.52),
            (7.0, 2.43),
            (8.0, 2.37),
            (9.0, 2.32),
            (10.0, 2.28),
            (20.0, 2.13),
            (50.0, 2.05),
            (f64::INFINITY, 2.00),
        ];
        for (dof, k) in table {
            let factor = two_sided_factor(0.9545, dof);
            // Half a unit of the table's last digit.
            assert!((factor - k).abs() <= 0.005, "dof {dof}: {factor} for {k}");
        }
    }

    #[test]
    fn ends_and_nonsense() {
        for dof in DOFS {
            assert_eq!(quantile(0.0, dof), f64::NEG_INFINITY);
            assert_eq!(quantile(1.0, dof), f64::INFINITY);
            assert_eq!(quantile(0.5, dof), 0.0);
            assert_eq!(two_sided_factor(0.0, dof), 0.0);
            assert_eq!(two_sided_factor(1.0, dof), f64::INFINITY);
            assert_eq!((cdf(0.0, dof), sf(0.0, dof)), (0.5, 0.5));
            assert_eq!((cdf(f64::INFINITY, dof), sf(f64::INFINITY, dof)), (1.0, 0.0));
            assert_eq!((cdf(f64::NEG_INFINITY, dof), sf(f64::NEG_INFINITY, dof)), (0.0, 1.0));
            for p in [-0.1, -1e-20, 1.1, f64::NAN] {
                assert!(quantile(p, dof).is_nan(), "p {p}");
                assert!(two_sided_factor(p, dof).is_nan(), "p {p}");
            }
            assert!(cdf(f64::NAN, dof).is_nan());
        }
        for dof in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
            assert!(quantile(0.3, dof).is_nan() && two_sided_factor(0.3, dof).is_nan());
            assert!(cdf(0.3, dof).is_nan() && sf(0.3, dof).is_nan());
        }
    }

    // The tail's error of some 5e-15, by 1 / dof where the tail is a power of t.
    #[test]
    fn quantile_inverts_the_tail() {
        for dof in DOFS {
            for i in 1..=300 {
                let t = 0.3 * 1.02_f64.powi(i);
                let tail = cdf(-t, dof);
                if tail < 1e-300 {
                    break;
                }
                let error = (quantile(tail, dof) / -t - 1.0).abs();
                assert!(error < 2e-14 + 2e-15 / dof, "t {t}, dof {dof}: {error:e}");
            }
        }
    }

    // From the center to both ends, across every change of method.
    #[test]
    fn quantile_rises_with_p_and_falls_with_dof() {
        for dof in DOFS {
            let mut last = f64::NEG_INFINITY;
            for i in 1..2000 {
                let t = quantile(f64::from(i) / 2000.0, dof);
                assert!(t > last, "p {i} / 2000, dof {dof}: {t} after {last}");
                last = t;
            }
            let mut last = 0.0;
            for i in 1..400 {
                let k = two_sided_factor(10.0_f64.powf(-12.0 + 0.03 * f64::from(i)), dof);
                assert!(k > last, "factor, step {i}, dof {dof}: {k} after {last}");
                last = k;
            }
        }
        for p in [0.01, 0.5, 0.9, 0.9545, 0.999_999] {
            for pair in DOFS[..13].windows(2) {
                assert!(two_sided_factor(p, pair[0]) > two_sided_factor(p, pair[1]), "{pair:?}");
            }
        }
    }

    // The first terms of the expansion in 1 / dof leave a relative 1e-16 at dof 1e8; below the
    // change to the normal distribution nothing of it is left. 5e-15 is the search's error.
    #[test]
    fn large_dof_follows_the_expansion_up_to_the_normal_limit() {
        for p in [0.51, 0.7, 0.975, 0.99865, 1.0 - 1e-9] {
            let z = normal::quantile(p);
            let square = z * z;
            for dof in [1e8, 1e10, 1e14, 0.999e20, 1e20] {
                let expansion = z
                    + z * (square + 1.0) / (4.0 * dof)
                    + z * ((5.0 * square + 16.0) * square + 3.0) / (96.0 * dof * dof);
                let error = (quantile(p, dof) / expansion - 1.0).abs();
                assert!(error < 5e-15, "p {p}, dof {dof}: {error:e}");
            }
        }
    }

    // The closed forms of dof 1 and 2 against the general search just beside them: the derivative
    // by dof times 1e-13 is far below 1e-12.
    #[test]
    fn closed_forms_continue_their_neighbours() {
        for dof in [1.0, 2.0] {
            for p in [1e-12, 0.2, 0.5, 0.9, 0.9545, 0.999_999] {
                let (exact, beside) =
                    (two_sided_factor(p, dof), two_sided_factor(p, dof * (1.0 + 1e-14)));
                assert!((beside / exact - 1.0).abs() < 1e-12, "p {p}, dof {dof}");
            }
        }
    }

    #[test]
    fn absurd_arguments_end() {
        for dof in [5e-324, 1e-300, 1e-10, 1e-3, f64::MAX] {
            for p in [5e-324, 1e-300, 0.1, 0.5, 0.9, 1.0 - f64::EPSILON] {
                assert!(!quantile(p, dof).is_nan(), "quantile({p:e}, {dof:e})");
                assert!(two_sided_factor(p, dof) >= 0.0, "two_sided_factor({p:e}, {dof:e})");
            }
            for t in [-f64::MAX, -1.0, 5e-324, 1e-200, 1e200] {
                assert!((0.0..=1.0).contains(&cdf(t, dof)), "cdf({t:e}, {dof:e})");
            }
        }
    }
}
