//! Pieces of gamma and beta densities that keep their accuracy for large shapes.
//!
//! Source of the form: Loader 2000, "Fast and accurate computation of binomial probabilities".

use std::f64::consts::TAU;

/// ζ(k) - 1 for k = 2, 3, ...
const ZETA_MINUS_ONE: [f64; 27] = [
    0.644_934_066_848_226_436_47,
    0.202_056_903_159_594_285_40,
    0.082_323_233_711_138_191_516,
    0.036_927_755_143_369_926_331,
    0.017_343_061_984_449_139_715,
    8.349_277_381_922_826_839_8e-3,
    4.077_356_197_944_339_378_7e-3,
    2.008_392_826_082_214_417_9e-3,
    9.945_751_278_180_853_371_5e-4,
    4.941_886_041_194_645_587_2e-4,
    2.460_865_533_080_482_986_4e-4,
    1.227_133_475_784_891_467_5e-4,
    6.124_813_505_870_482_925_9e-5,
    3.058_823_630_702_049_355_2e-5,
    1.528_225_940_865_187_173_2e-5,
    7.637_197_637_899_762_273_6e-6,
    3.817_293_264_999_839_856_5e-6,
    1.908_212_716_553_938_925_7e-6,
    9.539_620_338_727_961_131_5e-7,
    4.769_329_867_878_064_631_2e-7,
    2.384_505_027_277_329_9e-7,
    1.192_199_259_653_110_730_7e-7,
    5.960_818_905_125_947_961_2e-8,
    2.980_350_351_465_228_018_6e-8,
    1.490_155_482_836_504_123_5e-8,
    7.450_711_789_835_429_492e-9,
    3.725_334_024_788_457_054_8e-9,
];

/// 1 - γ, γ being Euler's constant.
const ONE_MINUS_EULER: f64 = 0.422_784_335_098_467_139_39;

/// ln(1 + u) - u for u > -1, to a few units in the last place.
///
/// Near 0 with r = u / (2 + u): ln(1 + u) = 2 artanh(r), so the result is
/// -u r + 2 (r^3 / 3 + r^5 / 5 + ...).
pub(crate) fn ln_1p_minus(u: f64) -> f64 {
    if !(-0.4..=0.5).contains(&u) {
        return libm::log1p(u) - u;
    }
    let r = u / (2.0 + u);
    let square = r * r;
    // |r| <= 1/4, so the first term left out is below 2^-60 of the sum.
    let mut sum = 0.0;
    for k in (1..=14_u8).rev() {
        sum = sum * square + 1.0 / f64::from(2 * k + 1);
    }
    2.0 * r * square * sum - u * r
}

/// e^v - 1 - v, to a few units in the last place.
pub(super) fn exp_m1_minus(v: f64) -> f64 {
    if v.abs() > 0.5 {
        return libm::expm1(v) - v;
    }
    // The Taylor series from its small end: v^2 / 2 (1 + v / 3 (1 + v / 4 (...))).
    let mut sum = 1.0;
    for k in (3..=16_u8).rev() {
        sum = 1.0 + sum * v / f64::from(k);
    }
    0.5 * v * v * sum
}

/// ln Γ(1 + a) for a > -1/2, with a small relative error near its zero a = 0.
///
/// Below 1/2 the series 6.1.33 of Abramowitz and Stegun 1964.
pub(super) fn ln_gamma_1p(a: f64) -> f64 {
    if a.abs() > 0.5 {
        return libm::lgamma(1.0 + a);
    }
    let mut sum = 0.0;
    let mut k = ZETA_MINUS_ONE.len() + 1;
    for coefficient in ZETA_MINUS_ONE.iter().rev() {
        // (-a)^k (ζ(k) - 1) / k, by Horner's rule; k is at most 28.
        sum = -a * sum + coefficient / k as f64;
        k -= 1;
    }
    a * a * sum + a * ONE_MINUS_EULER - libm::log1p(a)
}

/// Stirling's formula over the gamma function, sqrt(2 π a) (a / e)^a / Γ(a + 1), for a > 0.
///
/// The relative error is below 1e-15. It is a product for a < 10, as the difference of the
/// logarithms would lose a digit.
pub(super) fn stirling_ratio(a: f64) -> f64 {
    if a < 10.0 {
        return (TAU * a).sqrt() * libm::pow(a, a) * libm::exp(-a) / libm::tgamma(a + 1.0);
    }
    libm::exp(-stirling_error(a))
}

/// ln Γ(a) - (a - 1/2) ln a + a - ln(2 π) / 2 for a >= 10, to an absolute 1e-17: the series 6.1.41
/// of Abramowitz and Stegun 1964.
pub(super) fn stirling_error(a: f64) -> f64 {
    // B_2k / (2 k (2 k - 1)) for k = 1, 2, ...
    const SERIES: [f64; 8] = [
        1.0 / 12.0,
        -1.0 / 360.0,
        1.0 / 1260.0,
        -1.0 / 1680.0,
        1.0 / 1188.0,
        -691.0 / 360_360.0,
        1.0 / 156.0,
        -3617.0 / 122_400.0,
    ];
    let inverse = 1.0 / a;
    let square = inverse * inverse;
    SERIES.iter().rev().fold(0.0, |sum, c| sum * square + c) * inverse
}

/// a ln(a / m) + m - a, never negative: the deviance of a count a from its mean m, where
/// `excess` = m - a is given on its own because the difference of the rounded numbers may be poor.
fn deviance(a: f64, mean: f64, excess: f64) -> f64 {
    let u = excess / a;
    if u > -0.5 && u < 1.0 {
        return -a * ln_1p_minus(u);
    }
    let ratio = a / mean;
    let ln_ratio = if ratio > 0.0 && ratio < f64::INFINITY {
        libm::log(ratio)
    } else {
        libm::log(a) - libm::log(mean)
    };
    a * ln_ratio + excess
}

/// x^a e^(-x) / Γ(a) for a, x > 0.
///
/// The relative error is some units in the last place, and grows with the size of the logarithm
/// of the result.
pub(super) fn gamma_weight(x: f64, a: f64) -> f64 {
    if a < 1.0 {
        return a * libm::exp(a * libm::log(x) - ln_gamma_1p(a)) * libm::exp(-x);
    }
    (a / TAU).sqrt() * stirling_ratio(a) * libm::exp(-deviance(a, x, x - a))
}

/// (a + b) x - a, which is also b - (a + b) y, for x + y = 1: from the smaller of x and y, with one
/// rounding.
pub(super) fn beta_excess(x: f64, y: f64, a: f64, b: f64) -> f64 {
    let (n, n_rest) = two_sum(a, b);
    if x <= y { libm::fma(n, x, -a) + n_rest * x } else { -(libm::fma(n, y, -b) + n_rest * y) }
}

/// The rounded sum and what the rounding left out (Knuth 1969).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_part = sum - a;
    (sum, (a - (sum - b_part)) + (b - b_part))
}

/// x^a y^b / B(a, b) for a, b > 0 and x + y = 1, both positive; `excess` from [`beta_excess`].
///
/// The relative error is some units in the last place, and grows with the size of the logarithm
/// of the result.
pub(super) fn beta_weight(x: f64, y: f64, a: f64, b: f64, excess: f64) -> f64 {
    let n = a + b;
    let (small, large) = if a < b { (a, b) } else { (b, a) };
    let stirling = stirling_ratio(a) * stirling_ratio(b) / stirling_ratio(n);
    let exponent = deviance(a, n * x, excess) + deviance(b, n * y, -excess);
    (small * (large / n) / TAU).sqrt() * stirling * libm::exp(-exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(value: f64, reference: f64, tolerance: f64) {
        let error = (value / reference - 1.0).abs();
        assert!(error <= tolerance, "{value:e} for {reference:e}: relative error {error:e}");
    }

    // References from mpmath at 40 digits. A few units in the last place: 1 unit is 2.2e-16.
    #[test]
    fn differences_keep_their_relative_accuracy() {
        close(ln_1p_minus(1e-9), -4.999_999_996_666_667e-19, 1e-15);
        close(ln_1p_minus(0.3), -0.037_635_735_532_508_945, 1e-14);
        close(ln_1p_minus(-0.4), -0.110_825_623_765_990_7, 1e-14);
        close(exp_m1_minus(1e-9), 5.000_000_001_666_667e-19, 1e-15);
        close(exp_m1_minus(-0.4), 0.070_320_046_035_639_31, 1e-14);
        close(ln_gamma_1p(1e-9), -5.772_156_640_790_659e-10, 1e-15);
        close(ln_gamma_1p(0.25), -0.098_271_836_421_813_16, 1e-14);
    }

    // The two branches of each function meet: a jump would be a wrong coefficient.
    #[test]
    fn branches_agree_where_they_meet() {
        let step = 1e-15;
        close(ln_1p_minus(0.5 + step), ln_1p_minus(0.5), 2e-14);
        close(ln_1p_minus(-0.4 - step), ln_1p_minus(-0.4), 2e-14);
        close(exp_m1_minus(0.5 + step), exp_m1_minus(0.5), 2e-14);
        close(ln_gamma_1p(0.5 + step), ln_gamma_1p(0.5), 2e-14);
        close(stirling_ratio(10.0 - 1e-14), stirling_ratio(10.0), 2e-15);
    }
}
