//! The standard normal distribution.

use std::f64::consts::FRAC_1_SQRT_2;

/// 1 / sqrt(2) minus its double.
const FRAC_1_SQRT_2_REST: f64 = -4.833_646_656_726_456_5e-17;

/// 2 / sqrt(π).
const TWO_OVER_SQRT_PI: f64 = std::f64::consts::FRAC_2_SQRT_PI;

/// The probability of a standard normal quantity below `x`.
///
/// Every x; relative error below 1e-15 wherever the result is a normal double.
pub fn cdf(x: f64) -> f64 {
    sf(-x)
}

/// The probability of a standard normal quantity above `x`.
///
/// Every x; relative error below 1e-15 wherever the result is a normal double. It is erfc(x / √2)
/// / 2, with a first-order correction for the rounding of x / √2, which erfc would magnify x²-fold.
pub fn sf(x: f64) -> f64 {
    let y = x * FRAC_1_SQRT_2;
    let tail = libm::erfc(y);
    if !(tail > 0.0 && tail < 2.0) {
        return 0.5 * tail;
    }
    let rest = libm::fma(x, FRAC_1_SQRT_2, -y) + x * FRAC_1_SQRT_2_REST;
    0.5 * (tail - TWO_OVER_SQRT_PI * libm::exp(-y * y) * rest)
}

/// The x that a standard normal quantity stays below with probability `p` in \[0, 1\].
///
/// Relative error below 1e-15 for the exact double `p`; for an upper tail that 1 - p cannot hold,
/// see [`quantile_upper`]. Source: Wichura 1988, algorithm AS 241 (PPND16).
pub fn quantile(p: f64) -> f64 {
    if p > 0.5 { quantile_upper(1.0 - p) } else { -quantile_upper(p) }
}

/// The x that a standard normal quantity exceeds with probability `q` in \[0, 1\].
///
/// Relative error below 1e-15, for tails down to the smallest double. Source: Wichura 1988,
/// algorithm AS 241 (PPND16).
pub fn quantile_upper(q: f64) -> f64 {
    if !(0.0..=1.0).contains(&q) {
        return f64::NAN;
    }
    let offset = 0.5 - q;
    if offset.abs() <= CENTRAL {
        return from_center(offset);
    }
    if offset > 0.0 { from_tail(q) } else { -from_tail(1.0 - q) }
}

/// Where the central approximation of AS 241 ends: |p - 1/2|.
pub(super) const CENTRAL: f64 = 0.425;

/// The quantile of p = 1/2 + `offset` for |offset| <= [`CENTRAL`]; relative error below 1e-15 also
/// for the smallest offsets. Source: Wichura 1988, algorithm AS 241, coefficients A and B.
pub(super) fn from_center(offset: f64) -> f64 {
    const ABOVE: [f64; 8] = [
        3.387_132_872_796_366_608_0,
        1.331_416_678_917_843_774_5e2,
        1.971_590_950_306_551_442_7e3,
        1.373_169_376_550_946_112_5e4,
        4.592_195_393_154_987_145_7e4,
        6.726_577_092_700_870_085_3e4,
        3.343_057_558_358_812_810_5e4,
        2.509_080_928_730_122_672_7e3,
    ];
    const BELOW: [f64; 8] = [
        1.0,
        4.231_333_070_160_091_125_2e1,
        6.871_870_074_920_579_083_0e2,
        5.394_196_021_424_751_107_7e3,
        2.121_379_430_158_659_586_7e4,
        3.930_789_580_009_271_061_0e4,
        2.872_908_573_572_194_267_4e4,
        5.226_495_278_852_854_561_0e3,
    ];
    let r = 0.180_625 - offset * offset;
    offset * (polynomial(&ABOVE, r) / polynomial(&BELOW, r))
}

/// The quantile whose upper tail is `q`, below 0.075. Source: Wichura 1988, algorithm AS 241,
/// coefficients C to F.
fn from_tail(q: f64) -> f64 {
    const NEAR_ABOVE: [f64; 8] = [
        1.423_437_110_749_683_577_34,
        4.630_337_846_156_545_295_90,
        5.769_497_221_460_691_405_50,
        3.647_848_324_763_204_605_04,
        1.270_458_252_452_368_382_58,
        2.417_807_251_774_506_117_70e-1,
        2.272_384_498_926_918_458_33e-2,
        7.745_450_142_783_414_076_40e-4,
    ];
    const NEAR_BELOW: [f64; 8] = [
        1.0,
        2.053_191_626_637_758_821_87,
        1.676_384_830_183_803_849_40,
        6.897_673_349_851_000_045_50e-1,
        1.481_039_764_274_800_745_90e-1,
        1.519_866_656_361_645_719_66e-2,
        5.475_938_084_995_344_946_00e-4,
        1.050_750_071_644_416_843_24e-9,
    ];
    const FAR_ABOVE: [f64; 8] = [
        6.657_904_643_501_103_777_20,
        5.463_784_911_164_114_369_90,
        1.784_826_539_917_291_335_80,
        2.965_605_718_285_048_912_30e-1,
        2.653_218_952_657_612_309_30e-2,
        1.242_660_947_388_078_438_60e-3,
        2.711_555_568_743_487_578_15e-5,
        2.010_334_399_292_288_132_65e-7,
    ];
    const FAR_BELOW: [f64; 8] = [
        1.0,
        5.998_322_065_558_879_376_90e-1,
        1.369_298_809_227_358_053_10e-1,
        1.487_536_129_085_061_485_25e-2,
        7.868_691_311_456_132_591_00e-4,
        1.846_318_317_510_054_681_80e-5,
        1.421_511_758_316_445_888_70e-7,
        2.044_263_103_389_939_785_64e-15,
    ];
    if q == 0.0 {
        return f64::INFINITY;
    }
    let r = (-libm::log(q)).sqrt();
    if r <= 5.0 {
        polynomial(&NEAR_ABOVE, r - 1.6) / polynomial(&NEAR_BELOW, r - 1.6)
    } else {
        polynomial(&FAR_ABOVE, r - 5.0) / polynomial(&FAR_BELOW, r - 5.0)
    }
}

/// The polynomial with these coefficients, the constant first.
fn polynomial(coefficients: &[f64; 8], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_nonsense() {
        assert_eq!((quantile(0.0), quantile(1.0)), (f64::NEG_INFINITY, f64::INFINITY));
        assert_eq!((quantile_upper(0.0), quantile_upper(1.0)), (f64::INFINITY, f64::NEG_INFINITY));
        assert_eq!((cdf(f64::NEG_INFINITY), cdf(f64::INFINITY)), (0.0, 1.0));
        assert_eq!((sf(f64::NEG_INFINITY), sf(f64::INFINITY)), (1.0, 0.0));
        assert_eq!(quantile(0.5), 0.0);
        for p in [-1e-300, 1.0 + f64::EPSILON, f64::NAN, f64::INFINITY] {
            assert!(quantile(p).is_nan() && quantile_upper(p).is_nan(), "p = {p}");
        }
        assert!(cdf(f64::NAN).is_nan() && sf(f64::NAN).is_nan());
    }

    // A relative error e of the tail moves x by e / x^2 of itself, at least in the tail; 2e-15 is
    // both functions' errors.
    #[test]
    fn quantile_inverts_the_tail() {
        for i in 1..=3700 {
            let x = f64::from(i) * 0.01;
            let back = quantile_upper(sf(x));
            // Near 0 the tail is close to 1/2, whose rounding is an absolute error of x.
            assert!((back - x).abs() <= 2e-15 * x.max(0.3), "{back} for {x}");
            assert_eq!(quantile(cdf(-x)), -back, "symmetry at {x}");
        }
    }

    #[test]
    fn quantile_rises() {
        let mut last = f64::NEG_INFINITY;
        for i in 1..100_000 {
            let x = quantile(f64::from(i) * 1e-5);
            assert!(x > last, "at {i}e-5");
            last = x;
        }
    }
}
