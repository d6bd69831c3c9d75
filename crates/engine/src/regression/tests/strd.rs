//! The Statistical Reference Datasets of NIST: certified values of linear and non-linear fits.
//!
//! The data were checked against the certified residual standard deviations in exact arithmetic.

use std::collections::HashMap;
use std::sync::Arc;

use super::super::{Curve, Points, Regression, Spread};
use super::worst;
use crate::model::formula::{Formula, Scope, Typing};
use crate::model::{Program, Recorder};

const NORRIS_X: [f64; 36] = [
    0.2, 337.4, 118.2, 884.6, 10.1, 226.5, 666.3, 996.3, 448.6, 777.0, 558.2, 0.4, 0.6, 775.5,
    666.9, 338.0, 447.5, 11.6, 556.0, 228.1, 995.8, 887.6, 120.2, 0.3, 0.3, 556.8, 339.1, 887.2,
    999.0, 779.0, 11.1, 118.3, 229.2, 669.1, 448.9, 0.5,
];
const NORRIS_Y: [f64; 36] = [
    0.1, 338.8, 118.1, 888.0, 9.2, 228.1, 668.5, 998.5, 449.1, 778.9, 559.2, 0.3, 0.1, 778.1,
    668.8, 339.3, 448.9, 10.8, 557.7, 228.3, 998.0, 888.8, 119.6, 0.3, 0.6, 557.6, 339.3, 888.0,
    998.5, 778.9, 10.2, 117.6, 228.9, 668.4, 449.2, 0.2,
];
const PONTIUS_Y: [f64; 40] = [
    0.11019, 0.21956, 0.32949, 0.43899, 0.54803, 0.65694, 0.76562, 0.87487, 0.98292, 1.09146,
    1.20001, 1.30822, 1.41599, 1.52399, 1.63194, 1.73947, 1.84646, 1.95392, 2.06128, 2.16844,
    0.11052, 0.22018, 0.32939, 0.43886, 0.54798, 0.65739, 0.76596, 0.87474, 0.98300, 1.09150,
    1.20004, 1.30818, 1.41613, 1.52408, 1.63159, 1.73965, 1.84696, 1.95445, 2.06177, 2.16829,
];
#[rustfmt::skip]
const FILIP_X: [f64; 82] = [
    -6.860120914, -4.324130045, -4.358625055, -4.358426747, -6.955852379, -6.661145254,
    -6.355462942, -6.118102026, -7.115148017, -6.815308569, -6.519993057, -6.204119983,
    -5.853871964, -6.109523091, -5.79832982, -5.482672118, -5.171791386, -4.851705903,
    -4.517126416, -4.143573228, -3.709075441, -3.499489089, -6.300769497, -5.953504836,
    -5.642065153, -5.031376979, -4.680685696, -4.329846955, -3.928486195, -8.56735134,
    -8.363211311, -8.107682739, -7.823908741, -7.522878745, -7.218819279, -6.920818754,
    -6.628932138, -6.323946875, -5.991399828, -8.781464495, -8.663140179, -8.473531488,
    -8.247337057, -7.971428747, -7.676129393, -7.352812702, -7.072065318, -6.774174009,
    -6.478861916, -6.159517513, -6.835647144, -6.53165267, -6.224098421, -5.910094889,
    -5.598599459, -5.290645224, -4.974284616, -4.64454848, -4.290560426, -3.885055584,
    -3.408378962, -3.13200249, -8.726767166, -8.66695597, -8.511026475, -8.165388579, -7.886056648,
    -7.588043762, -7.283412422, -6.995678626, -6.691862621, -6.392544977, -6.067374056,
    -6.684029655, -6.378719832, -6.065855188, -5.752272167, -5.132414673, -4.811352704,
    -4.098269308, -3.66174277, -3.2644011,
];
#[rustfmt::skip]
const FILIP_Y: [f64; 82] = [
    0.8116, 0.9072, 0.9052, 0.9039, 0.8053, 0.8377, 0.8667, 0.8809, 0.7975, 0.8162, 0.8515, 0.8766,
    0.8885, 0.8859, 0.8959, 0.8913, 0.8959, 0.8971, 0.9021, 0.909, 0.9139, 0.9199, 0.8692, 0.8872,
    0.89, 0.891, 0.8977, 0.9035, 0.9078, 0.7675, 0.7705, 0.7713, 0.7736, 0.7775, 0.7841, 0.7971,
    0.8329, 0.8641, 0.8804, 0.7668, 0.7633, 0.7678, 0.7697, 0.77, 0.7749, 0.7796, 0.7897, 0.8131,
    0.8498, 0.8741, 0.8061, 0.846, 0.8751, 0.8856, 0.8919, 0.8934, 0.894, 0.8957, 0.9047, 0.9129,
    0.9209, 0.9219, 0.7739, 0.7681, 0.7665, 0.7703, 0.7702, 0.7761, 0.7809, 0.7961, 0.8253, 0.8602,
    0.8809, 0.8301, 0.8664, 0.8834, 0.8898, 0.8964, 0.8963, 0.9074, 0.9119, 0.9228,
];

fn polynomial(x: &[f64], y: &[f64], degree: usize) -> Regression {
    let points = Arc::new(Points::new(x.to_vec(), y.to_vec()));
    Regression::of("f", &Curve::polynomial(degree), &points, &[]).unwrap()
}

/// Coefficients and standard deviations to so many digits (relative errors below), and the residual
/// standard deviation.
fn check(fit: &Regression, certified: &[f64], deviations: &[f64], s: f64, limit: f64) {
    let error = worst(fit.estimates.iter().copied(), certified);
    assert!(error < limit, "estimates {error}");
    let found = (0..fit.count()).map(|k| fit.standard_uncertainty(k));
    let error = worst(found, deviations);
    assert!(error < limit, "standard deviations {error}");
    assert!((fit.factor.unwrap() / s - 1.0).abs() < limit, "{:?}", fit.factor);
}

/// Norris and Pontius, of lower difficulty: 12 digits are left.
#[test]
fn norris_and_pontius() {
    check(
        &polynomial(&NORRIS_X, &NORRIS_Y, 1),
        &[-0.262_323_073_774_029, 1.002_116_818_020_45],
        &[0.232_818_234_301_152, 0.429_796_848_199_937e-3],
        0.884_796_396_144_373,
        1e-12,
    );
    let x: Vec<f64> = (0..40).map(|k| 150_000.0 * f64::from(k % 20 + 1)).collect();
    check(
        &polynomial(&x, &PONTIUS_Y, 2),
        &[0.673_565_789_473_684e-3, 0.732_059_160_401_003e-6, -0.316_081_871_345_029e-14],
        &[0.107_938_612_033_077e-3, 0.157_817_399_981_659e-9, 0.486_652_849_992_036e-16],
        0.205_177_424_076_185e-3,
        1e-11,
    );
}

/// Filip, of higher difficulty: a polynomial of degree 10 whose powers are dependent to 15 digits. In
/// Chebyshev polynomials 8 digits and more are left, where raw powers leave none.
#[test]
fn filip() {
    let fit = polynomial(&FILIP_X, &FILIP_Y, 10);
    let certified = [
        -1_467.489_614_229_80,
        -2_772.179_591_933_42,
        -2_316.371_081_608_93,
        -1_127.973_940_983_72,
        -354.478_233_703_349,
        -75.124_201_739_375_7,
        -10.875_318_035_534_3,
        -1.062_214_985_889_47,
        -0.670_191_154_593_408e-1,
        -0.246_781_078_275_479e-2,
        -0.402_962_525_080_404e-4,
    ];
    let error = worst(fit.estimates.iter().copied(), &certified);
    assert!(error < 1e-8, "{error}");
    assert!((fit.standard_uncertainty(0) / 298.084_530_995_537 - 1.0).abs() < 1e-8);
    assert!((fit.factor.unwrap() / 0.334_801_051_324_544e-2 - 1.0).abs() < 1e-10);
}

/// A formula of x and parameters in their order as a program.
fn program(text: &str, parameters: &[&str]) -> Program {
    let formula = Formula::parse(text).unwrap();
    let names = || std::iter::once("x").chain(parameters.iter().copied());
    let scope: Scope = names().map(|name| (name, Typing::NUMBER)).collect();
    let recorder = Recorder::default();
    let values: HashMap<String, _> =
        names().enumerate().map(|(k, name)| (name.to_owned(), recorder.variable(k))).collect();
    let value = formula.record(&scope, &values).unwrap();
    recorder.program(1 + parameters.len(), &[value])
}

/// The certified parameters of a formula from each of the starts, to 8 digits, and the sum of squares
/// to 9.
fn check_formula(
    (text, parameters): (&str, &[&str]),
    (x, y): (&[f64], &[f64]),
    starts: &[&[f64]],
    (certified, deviations, squares): (&[f64], &[f64], f64),
) {
    let curve = Curve::Program(program(text, parameters));
    let points = Arc::new(Points::new(x.to_vec(), y.to_vec()));
    for start in starts {
        let fit = Regression::of("f", &curve, &points, start).unwrap();
        let error = worst(fit.estimates.iter().copied(), certified);
        assert!(error < 1e-8, "{text} {start:?} {error}");
        let found = (0..fit.count()).map(|k| fit.standard_uncertainty(k));
        let error = worst(found, deviations);
        // the Jacobian of the least well conditioned magnifies the 1e-8 of the estimates
        assert!(error < 2e-6, "{text} {start:?} {error}");
        assert!((fit.chi2 / squares - 1.0).abs() < 1e-9, "{text} {}", fit.chi2);
    }
}

/// Points on the curve but for the rounding of their last bits, with stated uncertainties and without:
/// sums of squares of rounding fall and rise without end, and are no reason to go on.
#[test]
fn formulas_that_meet_their_points() {
    let x = [0.0, 50.0, 100.0, 150.0, 200.0];
    let y = [100.0, 119.4, 138.51, 157.33, 175.86];
    let curve = Curve::Program(program("a*(1 + b*x + c*x^2)", &["a", "b", "c"]));
    let start = [100.0, 3.9083e-3, -5.775e-7];
    let stated = Points::new(x.to_vec(), y.to_vec()).with_y(Spread::Each(vec![1e-4; 5]));
    for points in [stated, Points::new(x.to_vec(), y.to_vec())] {
        let fit = Regression::of("pt", &curve, &Arc::new(points), &start).unwrap();
        // second differences of the values are -0.29 each
        let expected = [100.0, 3.909e-3, -5.8e-7];
        for (found, expected) in fit.estimates.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-10, "{found} {expected}");
        }
    }
}

/// Misra1a, of lower difficulty, from both starts.
#[test]
fn misra1a() {
    check_formula(
        ("a*(1 - exp(-b*x))", &["a", "b"]),
        (
            &[
                77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1,
                689.1, 760.0,
            ],
            &[
                10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40,
                75.47, 81.78,
            ],
        ),
        &[&[500.0, 0.0001], &[250.0, 0.0005]],
        (
            &[2.389_421_291_8e2, 5.501_564_318_1e-4],
            &[2.707_007_524_1, 7.266_868_843_6e-6],
            1.245_513_889_4e-1,
        ),
    );
}

/// MGH09, of higher difficulty, from both starts.
#[test]
fn mgh09() {
    check_formula(
        ("a*(x^2 + x*b)/(x^2 + x*c + d)", &["a", "b", "c", "d"]),
        (
            &[4.0, 2.0, 1.0, 0.5, 0.25, 0.167, 0.125, 0.1, 0.0833, 0.0714, 0.0625],
            &[
                0.1957, 0.1947, 0.1735, 0.1600, 0.0844, 0.0627, 0.0456, 0.0342, 0.0323, 0.0235,
                0.0246,
            ],
        ),
        &[&[25.0, 39.0, 41.5, 39.0], &[0.25, 0.39, 0.415, 0.39]],
        (
            &[1.928_069_345_8e-1, 1.912_823_287_3e-1, 1.230_565_069_3e-1, 1.360_623_306_8e-1],
            &[1.143_531_222_7e-2, 1.963_322_091_1e-1, 8.084_203_123_2e-2, 9.002_554_230_8e-2],
            3.075_056_038_5e-4,
        ),
    );
}

/// Thurber, of higher difficulty: a rational function of 7 parameters, from the second start.
#[test]
fn thurber() {
    check_formula(
        (
            "(a + b*x + c*x^2 + d*x^3)/(1 + e*x + f*x^2 + g*x^3)",
            &["a", "b", "c", "d", "e", "f", "g"],
        ),
        (
            &[
                -3.067, -2.981, -2.921, -2.912, -2.840, -2.797, -2.702, -2.699, -2.633, -2.481,
                -2.363, -2.322, -1.501, -1.460, -1.274, -1.212, -1.100, -1.046, -0.915, -0.714,
                -0.566, -0.545, -0.400, -0.309, -0.109, -0.103, 0.010, 0.119, 0.377, 0.790, 0.963,
                1.006, 1.115, 1.572, 1.841, 2.047, 2.200,
            ],
            &[
                80.574, 84.248, 87.264, 87.195, 89.076, 89.608, 89.868, 90.101, 92.405, 95.854,
                100.696, 101.060, 401.672, 390.724, 567.534, 635.316, 733.054, 759.087, 894.206,
                990.785, 1090.109, 1080.914, 1122.643, 1178.351, 1260.531, 1273.514, 1288.339,
                1327.543, 1353.863, 1414.509, 1425.208, 1421.384, 1442.962, 1464.350, 1468.705,
                1447.894, 1457.628,
            ],
        ),
        &[&[1300.0, 1500.0, 500.0, 75.0, 1.0, 0.4, 0.05]],
        (
            &[
                1.288_139_680_0e3,
                1.491_079_253_5e3,
                5.832_383_687_7e2,
                7.541_664_429_1e1,
                9.662_950_286_4e-1,
                3.979_728_579_7e-1,
                4.972_729_734_9e-2,
            ],
            &[
                4.664_794_871_1,
                3.957_115_686_1e1,
                2.869_869_625_6e1,
                5.567_537_027_0,
                3.133_337_001_0e-2,
                1.498_492_238_2e-2,
                6.584_234_460_9e-3,
            ],
            5.642_708_239_7e3,
        ),
    );
}
