//! The integral of a decaying ratio from 0 to infinity, by Gauss-Legendre quadrature.

/// The positive nodes of the Gauss-Legendre rule of 40 points on \[-1, 1\], and their weights:
/// roots of the Legendre polynomial P_40, found with 50 digits.
const RULE: [(f64, f64); 20] = [
    (0.038_772_417_506_050_821_933, 0.077_505_947_978_424_811_264),
    (0.116_084_070_675_255_208_48, 0.077_039_818_164_247_965_588),
    (0.192_697_580_701_371_099_72, 0.076_110_361_900_626_242_372),
    (0.268_152_185_007_253_681_14, 0.074_723_169_057_968_264_2),
    (0.341_994_090_825_758_473_01, 0.072_886_582_395_804_059_061),
    (0.413_779_204_371_605_001_52, 0.070_611_647_391_286_779_695),
    (0.483_075_801_686_178_712_91, 0.067_912_045_815_233_903_826),
    (0.549_467_125_095_128_202_08, 0.064_804_013_456_601_038_075),
    (0.612_553_889_667_980_237_95, 0.061_306_242_492_928_939_167),
    (0.671_956_684_614_179_548_38, 0.057_439_769_099_391_551_367),
    (0.727_318_255_189_927_103_28, 0.053_227_846_983_936_824_355),
    (0.778_305_651_426_519_387_69, 0.048_695_807_635_072_232_061),
    (0.824_612_230_833_311_663_2, 0.043_870_908_185_673_271_992),
    (0.865_959_503_212_259_503_82, 0.038_782_167_974_472_017_64),
    (0.902_098_806_968_874_296_73, 0.033_460_195_282_547_847_393),
    (0.932_812_808_278_676_533_36, 0.027_937_006_980_023_401_098),
    (0.957_916_819_213_791_655_8, 0.022_245_849_194_166_957_262),
    (0.977_259_949_983_774_262_66, 0.016_421_058_381_907_888_713),
    (0.990_726_238_699_457_006_45, 0.010_498_284_531_152_813_615),
    (0.998_237_709_710_559_200_35, 0.004_521_277_098_533_191_258_5),
];

/// What is left out beyond the range: a ratio of e^-38, below 1e-16 of the integral.
const DECAY: f64 = 38.0;

/// The integral over v from 0 to infinity of e^-h(v), where h(0) = 0 and h is convex with the
/// given slope (not negative) and curvature at 0. `h` gives its value and its slope.
///
/// The range ends where h is 38; convexity makes Newton's steps for that end settle on its far
/// side. The rule of 40 points integrates the ratios met here (Gaussian, exponential, and
/// exponential of an exponential) over their range to a relative 1e-14.
pub(super) fn decaying(slope: f64, curvature: f64, h: impl Fn(f64) -> (f64, f64)) -> f64 {
    let mut end = 2.0 * DECAY / (slope + (slope * slope + 2.0 * DECAY * curvature).sqrt());
    for _ in 0..16 {
        let (value, rate) = h(end);
        let excess = value - DECAY;
        if (0.0..=2.0).contains(&excess) || excess.is_nan() {
            break;
        }
        end -= excess / rate;
    }
    let half = 0.5 * end;
    let mut sum = 0.0;
    for (node, weight) in RULE.iter().rev() {
        let near = libm::exp(-h(half * (1.0 - node)).0);
        let far = libm::exp(-h(half * (1.0 + node)).0);
        sum += weight * (near + far);
    }
    half * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    // The rule is exact for polynomials up to degree 79; 1e-15 is rounding.
    #[test]
    fn the_rule_integrates_polynomials() {
        for degree in [0, 2, 10, 40, 78] {
            let sum: f64 = RULE.iter().map(|(x, w)| 2.0 * w * x.powi(degree)).sum();
            let exact = 2.0 / f64::from(degree + 1);
            assert!((sum / exact - 1.0).abs() < 1e-14, "degree {degree}: {sum} for {exact}");
        }
    }

    // 1e-14 is the stated accuracy of the rule for such ratios.
    #[test]
    fn known_integrals() {
        let gaussian = decaying(0.0, 1.0, |v| (0.5 * v * v, v));
        assert!((gaussian / (std::f64::consts::PI / 2.0).sqrt() - 1.0).abs() < 1e-14);
        let exponential = decaying(3.0, 0.0, |v| (3.0 * v, 3.0));
        assert!((exponential * 3.0 - 1.0).abs() < 1e-14);
        // e^z E1(z): the slowest start of an exponential of an exponential in use is z = 1 / 4.
        for (z, exact) in [(1.0, 0.596_347_362_323_194_07), (0.25, 1.340_885_444_831_393_35)] {
            let double = decaying(z, z, |v| (z * libm::expm1(v), z * libm::exp(v)));
            assert!((double / exact - 1.0).abs() < 1e-14, "z {z}: {double}");
        }
    }
}
