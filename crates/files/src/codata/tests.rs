//! Published values of NIST (CODATA 2022, web version 9.0) against what follows from the adjusted ones.

use super::*;

/// Published standard uncertainties.
const PUBLISHED: [(&str, f64); 25] = [
    ("alpha", 1.1e-12),
    ("R_inf", 1.2e-05),
    ("m_e", 2.8e-40),
    ("m_p", 5.2e-37),
    ("m_n", 8.5e-37),
    ("m_mu", 4.2e-36),
    ("m_d", 1.0e-36),
    ("m_h", 1.6e-36),
    ("m_alpha", 2.1e-36),
    ("m_u", 5.2e-37),
    ("M_u", 3.1e-13),
    ("mu_0", 2.0e-16),
    ("epsilon_0", 1.4e-21),
    ("Z_0", 5.9e-08),
    ("a_0", 8.2e-21),
    ("r_e", 1.3e-24),
    ("lambda_C", 7.6e-22),
    ("sigma_e", 6.2e-38),
    ("mu_B", 2.9e-33),
    ("mu_N", 1.6e-36),
    ("E_h", 4.8e-30),
    ("G", 1.5e-15),
    ("gamma_p", 1.1e-01),
    ("gamma_p_shielded", 1.1e+00),
    ("d_220", 3.2e-18),
];

/// Published correlation coefficients times 1e5, of each constant with those before it in the order of
/// [`PUBLISHED`] (the pairs of physics.nist.gov, as the R package `constants` 2022.0 has collected them).
#[rustfmt::skip]
const PAIRS: [&[i32]; 24] = [
    &[125],
    &[-99999, 225],
    &[-99844, 455, 99845],
    &[-61198, 277, 61199, 61281],
    &[-14, 10, 14, 14, 9],
    &[-99845, 453, 99846, 99991, 61298, 14],
    &[-99567, 453, 99568, 99716, 61122, 14, 99719],
    &[-99713, 438, 99715, 99840, 61203, 14, 99847, 99567],
    &[-99838, 438, 99839, 99965, 61279, 14, 99972, 99691, 99875],
    &[-99838, 438, 99839, 99965, 61279, 14, 99972, 99691, 99875, 100000],
    &[100000, 125, -99999, -99844, -61198, -14, -99845, -99567, -99713, -99838, -99838],
    &[-100000, -125, 99999, 99844, 61198, 14, 99845, 99567, 99713, 99838, 99838, -100000],
    &[100000, 125, -99999, -99844, -61198, -14, -99845, -99567, -99713, -99838, -99838, 100000, -100000],
    &[99998, -575, -99999, -99846, -61199, -14, -99846, -99568, -99715, -99839, -99839, 99998, -99998, 99998],
    &[100000, -108, -100000, -99845, -61198, -14, -99846, -99568, -99715, -99839, -99839, 100000, -100000, 100000, 99999],
    &[99999, -225, -100000, -99845, -61199, -14, -99846, -99568, -99715, -99839, -99839, 99999, -99999, 99999, 99999, 100000],
    &[100000, -108, -100000, -99845, -61198, -14, -99846, -99568, -99715, -99839, -99839, 100000, -100000, 100000, 99999, 100000, 100000],
    &[99999, -225, -100000, -99845, -61199, -14, -99846, -99568, -99715, -99839, -99839, 99999, -99999, 99999, 99999, 100000, 100000, 100000],
    &[99844, -455, -99845, -100000, -61281, -14, -99991, -99716, -99840, -99965, -99965, 99844, -99844, 99844, 99846, 99845, 99845, 99845, 99845],
    &[125, 100000, 225, 455, 277, 10, 453, 453, 438, 438, 438, 125, -125, 125, -575, -108, -225, -108, -225, -455],
    &[0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0],
    &[72540, -330, -72541, -72653, -44523, -22, -72646, -72446, -72537, -72627, -72627, 72540, -72540, 72540, 72541, 72541, 72541, 72541, 72541, 72653, -330, 0],
    &[7595, -32, -7595, -7604, -4660, 21, -7603, -7582, -7592, -7601, -7601, 7595, -7595, 7595, 7595, 7595, 7595, 7595, 7595, 7604, -32, 0, 5524],
    &[0, 0, 0, 0, -7697, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0],
];

fn named(name: &str) -> &'static MeasuredConstant {
    MeasuredConstant::named(name).expect("a constant")
}

/// Every u rounds to its published two digits.
#[test]
fn uncertainties_are_the_published_ones() {
    assert_eq!(MEASURED.len(), PUBLISHED.len());
    for (constant, (symbol, published)) in MEASURED.iter().zip(PUBLISHED) {
        assert_eq!(constant.symbol, symbol);
        let u = constant.relative_uncertainty() * constant.value;
        assert_eq!(format!("{u:.1e}"), format!("{published:.1e}"), "{symbol}");
    }
}

/// All 300 coefficients are the published ones, which are rounded to 1e-5 as are those that they are
/// computed from: within 1.5e-5, the half digit of the published one and what the roundings of those add.
#[test]
fn correlations_are_the_published_ones() {
    for (place, published) in PAIRS.iter().enumerate() {
        assert_eq!(published.len(), place + 1);
        for (before, published) in published.iter().enumerate() {
            let (a, b) = (&MEASURED[place + 1], &MEASURED[before]);
            let off = (a.correlation(b) - f64::from(*published) * 1e-5).abs();
            assert!(off < 1.5e-5, "{} and {}: {}", a.name, b.name, a.correlation(b));
        }
    }
}

/// The values follow from the adjusted ones and the exact constants by the formulas of CODATA (Rev. Mod.
/// Phys. 97 (2025) 025002, section XV), to half a digit of the result and of what it is made from: 4e-11.
#[test]
fn values_follow_from_each_other() {
    let of = |name: &str| named(name).value;
    let (h, c, e, n_a) = (6.626_070_15e-34, 299_792_458.0, 1.602_176_634e-19, 6.022_140_76e23);
    let (alpha, r_inf, pi) = (of("alpha"), of("R_inf"), std::f64::consts::PI);
    let (hbar, m_e) = (h / (2.0 * pi), 2.0 * h * r_inf / (c * alpha * alpha));
    // relative atomic masses and moments as published
    let m_u = m_e / 5.485_799_090_441e-4;
    let mu_n = 0.5 * e * hbar / (1.007_276_466_578_9 * m_u);
    let expected = [
        ("m_e", m_e),
        ("m_u", m_u),
        ("M_u", n_a * m_u),
        ("m_p", 1.007_276_466_578_9 * m_u),
        ("m_n", 1.008_664_916_06 * m_u),
        ("m_d", 2.013_553_212_544 * m_u),
        ("m_h", 3.014_932_246_932 * m_u),
        ("m_alpha", 4.001_506_179_129 * m_u),
        ("mu_0", 2.0 * alpha * h / (e * e * c)),
        ("epsilon_0", e * e / (2.0 * alpha * h * c)),
        ("Z_0", 2.0 * alpha * h / (e * e)),
        ("a_0", alpha / (4.0 * pi * r_inf)),
        ("r_e", alpha.powi(3) / (4.0 * pi * r_inf)),
        ("lambda_C", alpha * alpha / (2.0 * r_inf)),
        ("sigma_e", 8.0 * pi / 3.0 * (alpha.powi(3) / (4.0 * pi * r_inf)).powi(2)),
        ("mu_B", 0.5 * e * hbar / m_e),
        ("mu_N", mu_n),
        ("E_h", 2.0 * r_inf * h * c),
    ];
    for (name, value) in expected {
        assert!((of(name) / value - 1.0).abs() < 4e-11, "{name}: {value:e}");
    }
    // to half a digit of the published ratios
    let loose = [
        ("m_mu", 206.768_282_7 * m_e, 3e-10),
        ("gamma_p", 2.0 * 2.792_847_344_63 * mu_n / hbar, 2e-10),
        ("gamma_p_shielded", 2.0 * 2.792_775_648 * mu_n / hbar, 3e-10),
    ];
    for (name, value, within) in loose {
        assert!((of(name) / value - 1.0).abs() < within, "{name}: {value:e}");
    }
}

/// Units can be read, and names are those of one constant each.
#[test]
fn units_and_names_are_clear() {
    for constant in &MEASURED {
        assert!(Unit::parse(constant.unit).is_ok(), "{}", constant.unit);
        let alike = |other: &&MeasuredConstant| {
            [other.name, other.symbol]
                .iter()
                .any(|name| [constant.name, constant.symbol].contains(name))
        };
        assert_eq!(MEASURED.iter().filter(alike).count(), 1, "{}", constant.name);
    }
}
