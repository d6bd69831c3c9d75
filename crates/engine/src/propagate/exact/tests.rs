//! Exact figures against closed forms, and against values found with 30 digits (mpmath).

use super::*;
use crate::distribution::*;
use crate::model::Tolerance;
use crate::propagate::evaluation::joint;
use crate::task::{Coverage, Settings, Task};

fn exact_of(task: &Task) -> Result<Noiseless, String> {
    let row = &task.rows[0];
    let joint = joint(task, row).unwrap();
    evaluate(&Problem { task, row, joint: &joint, output: 0, drawn_dof: f64::INFINITY })
}

/// A task with inputs x0, x1, ... of unit 1 in a formula.
pub(in crate::propagate) fn task(inputs: Vec<Distribution>, formula: &str, p: f64) -> Task {
    let mut builder = Task::builder("test");
    for (i, distribution) in inputs.into_iter().enumerate() {
        builder = builder.input(&format!("x{i}"), Input::new(distribution, "1").unwrap());
    }
    builder
        .equation("y", formula)
        .output("y", "1")
        .settings(Settings::default().with_coverage(Coverage::Probability(p)))
        .build()
        .unwrap()
}

fn rectangular(mean: f64, half: f64) -> Distribution {
    Rectangular::new(mean, half).unwrap().into()
}

fn normal(mean: f64, std: f64) -> Distribution {
    Normal::new(mean, std).unwrap().into()
}

fn t(mean: f64, scale: f64, dof: f64) -> Distribution {
    StudentT::new(mean, scale, dof).unwrap().into()
}

fn bound(found: &Noiseless) -> f64 {
    match found.accuracy {
        Accuracy::Bound(bound) => bound,
        Accuracy::Scatter(_) => f64::NAN,
    }
}

/// JCGM 101, 9.2.2 to 9.2.4 (Tables 2 to 4): four normal, four rectangular quantities, and one of these
/// ten times as wide. Of the sums of rectangular ones the distribution function is a polynomial in
/// pieces, whose root was found with 40 digits. 1e-14 u is rounding.
#[test]
fn tables_of_the_supplement() {
    let root = 3f64.sqrt();
    let four = |inputs| exact_of(&task(inputs, "x0 + x1 + x2 + x3", 0.95)).unwrap();
    let cases = [
        (vec![normal(0.0, 1.0); 4], 3.919_927_969_080_108_5, 2.0),
        (vec![rectangular(0.0, root); 4], 3.879_406_741_347_820_756, 2.0),
        (
            [vec![rectangular(0.0, root); 3], vec![rectangular(0.0, 10.0 * root)]].concat(),
            17.015_814_099_866_66,
            10.148_891_565_092_22,
        ),
    ];
    for (inputs, end, u) in cases {
        let found = four(inputs);
        let [low, high] = found.symmetric_interval;
        assert!((high - end).abs() < 1.5e-14 * u, "{high:.17} for {end:.17}");
        assert!((low + end).abs() < 1.5e-14 * u, "{low:.17} for {end:.17}");
        assert!((found.standard_uncertainty.unwrap() / u - 1.0).abs() < 1e-14);
        assert!(found.median.abs() < 1e-14 && bound(&found) < 1e-12 * u);
    }
}

/// Two rectangles make a trapezoid: with half-widths a > b the 97.5 % quantile is
/// a + b - sqrt(8 a b 0.025) where that lies on the flank, and on the top else.
#[test]
fn two_rectangles() {
    // a narrow normal contribution in the flat part of a wide rectangle moves nothing
    let wide = exact_of(&task(vec![rectangular(0.0, 1.0), normal(0.0, 1e-6)], "x0 + x1", 0.95));
    assert!((wide.unwrap().symmetric_interval[1] - 0.95).abs() < 1e-14);
    for (a, b) in [(1.0, 1.0), (1.0, 0.3), (1.0, 1e-4), (5.0, 1e-9)] {
        let found =
            exact_of(&task(vec![rectangular(0.0, a), rectangular(0.0, b)], "x0 + x1", 0.95));
        let high = found.unwrap().symmetric_interval[1];
        let flank = a + b - (0.2f64 * a * b).sqrt();
        let end = if flank > a - b { flank } else { 0.95 * a };
        assert!((high - end).abs() < 1e-14 * a, "{high} for {end}");
    }
}

/// Lognormal products are lognormal: exp(mu +- k sigma).
#[test]
fn products_of_lognormals() {
    let inputs: Vec<Distribution> = [(1.0, 0.3), (2.0, 0.5), (3.0, 0.2)]
        .map(|(mean, std)| Lognormal::new(mean, std).unwrap().into())
        .to_vec();
    let (mut mu, mut square, mut expectation) = (0.0, 0.0, 1.0);
    for (sign, (mean, std)) in [(1.0, (1.0, 0.3)), (1.0, (2.0, 0.5)), (-1.0, (3.0, 0.2))] {
        let sigma: f64 = libm::log1p(std * std / (mean * mean));
        mu += sign * (libm::log(mean) - 0.5 * sigma);
        square += sigma;
        expectation *= if sign > 0.0 { mean } else { (1.0 + std * std / (mean * mean)) / mean };
    }
    let k = crate::special::normal::quantile(0.975);
    let found = exact_of(&task(inputs, "x0*x1/x2", 0.95)).unwrap();
    let end = |sign: f64| libm::exp(mu + sign * k * square.sqrt());
    assert!((found.symmetric_interval[0] - end(-1.0)).abs() < 3e-14);
    assert!((found.symmetric_interval[1] - end(1.0)).abs() < 3e-14);
    assert!((found.estimate.unwrap() - expectation).abs() < 1e-14);
    let u = expectation * libm::expm1(square).sqrt();
    assert!((found.standard_uncertainty.unwrap() - u).abs() < 1e-13);
}

/// A product keeps the signs of its factors: all figures are those of the product of moduli, mirrored
/// as often as there are negative ones. What is not defined has none.
#[test]
fn signs_of_factors() {
    let lognormal = |mean, std| Distribution::from(Lognormal::new(mean, std).unwrap());
    let of = |a: f64, formula: &str| {
        let inputs = vec![lognormal(3.0, 0.3), normal(a, 0.1), lognormal(2.0, 0.5)];
        exact_of(&task(inputs, formula, 0.95))
    };
    for (formula, of_moduli, odd) in [
        ("x0*x1*x2", "x0*x1*x2", true),
        ("-x0*x1*x2", "x0*x1*x2", false),
        ("x0*(-2)*x2*abs(x1)", "2*x0*x2*x1", true),
        ("x0*(2 - 5)*x2/x1", "3*x0*x2/x1", false),
        ("x0/(x1*x2)", "x0/(x1*x2)", true),
        ("cbrt(x0*x1*x2)", "cbrt(x0*x1*x2)", true),
        ("x0*x1^3", "x0*x1^3", true),
        ("x0*x1^2*x2", "x0*x1^2*x2", false),
        ("sqrt(-x0*x1)", "sqrt(x0*x1)", false),
        ("ln(x0/x1^2)", "ln(x0/x1^2)", false),
    ] {
        let found = of(-5.0, formula).unwrap_or_else(|reason| panic!("{formula}: {reason}"));
        let moduli = of(5.0, of_moduli).unwrap();
        let sign = if odd { -1.0 } else { 1.0 };
        let near =
            |a: f64, b: f64| assert!((a - sign * b).abs() <= 1e-9 * b.abs(), "{formula}: {a} {b}");
        near(found.estimate.unwrap(), moduli.estimate.unwrap());
        near(found.median, moduli.median);
        let mut ends = moduli.symmetric_interval;
        if odd {
            ends.reverse();
        }
        near(found.symmetric_interval[0], ends[0]);
        near(found.symmetric_interval[1], ends[1]);
    }
    for formula in ["ln(x0*x1)", "sqrt(x0*x1)", "(x0*x1)^0.5", "x0*sqrt(x1)", "x0*x2*x1^0.3"] {
        assert!(of(-5.0, formula).is_err(), "{formula}");
    }
}

/// Correlated normal quantities are one: 1 + 4 + 2 * 0.7 * 2.
#[test]
fn correlated_normals() {
    let mut builder = Task::builder("test");
    for (name, std) in [("a", 1.0), ("b", 2.0)] {
        builder = builder.input(name, Input::new(normal(0.0, std), "1").unwrap());
    }
    let task = builder
        .correlate("a", "b", 0.7)
        .equation("y", "a + b")
        .output("y", "1")
        .coverage(0.95)
        .build()
        .unwrap();
    let found = exact_of(&task).unwrap();
    let u = 7.8f64.sqrt();
    assert!((found.standard_uncertainty.unwrap() - u).abs() < 1e-14);
    let k = crate::special::normal::quantile(0.975);
    assert!((found.symmetric_interval[1] - k * u).abs() < 1e-13);
}

/// A sum of two Cauchy quantities is one of the sum of the scales: its 97.5 % quantile is
/// tan(0.475 pi) of it.
#[test]
fn heavy_tails() {
    let found = exact_of(&task(vec![t(0.0, 1.0, 1.0), t(3.0, 2.0, 1.0)], "x0 + x1", 0.95)).unwrap();
    let far = 3.0 * libm::tan(0.475 * std::f64::consts::PI);
    let high = found.symmetric_interval[1];
    assert!((high - 3.0 - far).abs() < bound(&found) && bound(&found) < 1e-9, "{high} for {far}");
}

/// A gamma quantity and the sum of two of half its shape are the same.
#[test]
fn sums_of_gammas() {
    let gamma = |shape| Distribution::from(Gamma::new(shape, 2.0).unwrap());
    let two = exact_of(&task(vec![gamma(4.0), gamma(4.5)], "x0 + x1", 0.95)).unwrap();
    let one = exact_of(&task(vec![gamma(8.5)], "x0", 0.95)).unwrap();
    for end in [0, 1] {
        let off = two.symmetric_interval[end] - one.symmetric_interval[end];
        assert!(off.abs() <= bound(&two) + 1e-12, "{off:e}, {:e}", bound(&two));
        let (a, b) = (two.shortest_interval.unwrap(), one.shortest_interval.unwrap());
        assert!((a[end] - b[end]).abs() < 1e-8, "{a:?} {b:?}");
    }
    assert!((two.median - one.median).abs() <= bound(&two) + 1e-12);
}

/// What cannot be had is refused with a reason: functions of many inputs, phases, sums whose
/// characteristic function decays slowly.
#[test]
fn refused_with_a_reason() {
    let inputs = vec![normal(1.0, 0.1); 4];
    let why = exact_of(&task(inputs, "x0*x1 + x2*x3*x0 + sin(x1*x3)", 0.95)).unwrap_err();
    assert!(why.contains("are in one function"), "{why}");
    let exponential: Distribution = Exponential::new(1.0).unwrap().into();
    let why = exact_of(&task(vec![exponential.clone(), exponential], "x0 + x1", 0.95)).unwrap_err();
    assert!(why.contains("decays"), "{why}");
}

/// Sums of t quantities, of which Welch and Satterthwaite give the ends only nearly, and the linear form
/// of the gauge block of JCGM 101, 9.5, in nanometres: ends found with 24 digits and more (mpmath, the
/// integral of Gil-Pelaez over panels). 2e-15 of the end is its own rounding.
#[test]
fn sums_of_t() {
    let few = vec![t(0.0, 1.0, 3.0), t(0.0, 2.0, 7.0)];
    let block = vec![
        t(0.0, 25.0, 18.0),
        t(0.0, 6.0, 24.0),
        t(0.0, 4.0, 5.0),
        t(0.0, 7.0, 8.0),
        rectangular(0.0, 28.75),
        rectangular(0.0, 5.0),
    ];
    let cases = [
        (few, "x0 + x1", 0.95, 5.722_959_864_532_580_933),
        (block, "x0 + x1 + x2 + x3 - x4 - x5", 0.99, 87.214_348_338_324_117_58),
    ];
    for (inputs, formula, p, end) in cases {
        let found = exact_of(&task(inputs, formula, p)).unwrap();
        let [low, high] = found.symmetric_interval;
        let allowed = bound(&found) + 2e-15 * end;
        assert!((high - end).abs() <= allowed, "{high:.17} for {end:.17}, {allowed:e}");
        assert!((low + end).abs() <= allowed, "{low:.17} for {end:.17}, {allowed:e}");
        // at least 1e-9 of the standard uncertainty is promised
        assert!(bound(&found) < 1e-10 * end);
    }
}

/// A sum of a lognormal quantity and a t about 0, whose shapes have no closed form together, with its
/// tolerance: the probability is that of the interval's own ends.
#[test]
fn probabilities_of_tolerances() {
    let inputs = || vec![rectangular(2.0, 1.0), t(0.0, 0.3, 4.0), normal(1.0, 0.2)];
    let free = exact_of(&task(inputs(), "x0 + x1 - x2", 0.9)).unwrap();
    let mut limited = task(inputs(), "x0 + x1 - x2", 0.9);
    let [low, high] = free.symmetric_interval;
    limited.model.outputs[0].tolerance = Some(Tolerance { lower: Some(low), upper: Some(high) });
    let inside = exact_of(&limited).unwrap().inside.unwrap();
    assert!((inside - 0.9).abs() < 1e-12, "{inside}");
}

/// Widths and shapes of random sums.
fn random_sum(number: u64) -> Vec<Distribution> {
    let mut state = number.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x1234_5678;
    let mut next = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    };
    let count = 2 + (4.0 * next()) as usize;
    (0..count)
        .map(|_| {
            let width = 0.05 + next();
            match (6.0 * next()) as u32 {
                0 => normal(1.0, width),
                1 => rectangular(-2.0, width),
                2 => t(0.0, width, 5.0 + (20.0 * next()).floor()),
                3 => Arcsine::new(0.0, width).unwrap().into(),
                4 => Triangular::between(0.0, width, Some(width * next())).unwrap().into(),
                _ => Gamma::new(2.0 + 5.0 * next(), 3.0 / width).unwrap().into(),
            }
        })
        .collect()
}

/// How many standard errors the ends of trials' intervals are from the exact ones.
fn scores(models: u64, trials: u64) -> Vec<f64> {
    let mut scores = Vec::new();
    for number in 0..models {
        let inputs = random_sum(number);
        let names: Vec<String> = (0..inputs.len()).map(|i| format!("x{i}")).collect();
        let mut task = task(inputs, &names.join(" + "), 0.95);
        let Ok(exact) = exact_of(&task) else {
            continue;
        };
        task.settings.trials = trials.into();
        task.settings.seed = number;
        let run = crate::propagate::evaluate(&task, &Default::default()).unwrap();
        let found = run.rows[0].outputs[0].monte_carlo.clone().unwrap();
        for end in [0, 1] {
            let off = found.symmetric_interval[end] - exact.symmetric_interval[end];
            scores.push(off / found.errors.symmetric_interval[end]);
        }
    }
    scores
}

fn mean_and_variance(of: &[f64]) -> [f64; 2] {
    let n = of.len() as f64;
    let mean = of.iter().sum::<f64>() / n;
    [mean, of.iter().map(|z| (z - mean) * (z - mean)).sum::<f64>() / (n - 1.0)]
}

/// Trials scatter about the exact ends as their standard errors say: of 60 random sums the scores have
/// mean 0 within 0.5, five standard errors of it, and variance 1 within 0.65, five of it.
#[test]
fn trials_scatter_about_exact_ends() {
    let scores = scores(60, 40_000);
    assert!(scores.len() > 100, "{} ends", scores.len());
    let [mean, variance] = mean_and_variance(&scores);
    assert!(mean.abs() < 0.5 && (variance - 1.0).abs() < 0.65, "{mean} {variance}");
}

/// The same of 1,000 sums with 1e8 trials each: within four standard errors of mean and variance, and
/// the distribution of the scores within 1.95/sqrt(n) of the standard normal one (Kolmogorov's
/// statistic; exceeded once in a thousand times).
#[test]
#[ignore = "1e11 trials, 40 min of a core"]
fn trials_scatter_about_exact_ends_of_a_thousand_sums() {
    let mut scores = scores(1000, 100_000_000);
    let [mean, variance] = mean_and_variance(&scores);
    scores.sort_unstable_by(f64::total_cmp);
    let n = scores.len() as f64;
    let departure = scores
        .iter()
        .enumerate()
        .map(|(i, &z)| {
            let p = crate::special::normal::cdf(z);
            (p - i as f64 / n).abs().max((p - (i as f64 + 1.0) / n).abs())
        })
        .fold(0.0, f64::max);
    let largest = scores[0].abs().max(scores[scores.len() - 1].abs());
    println!(
        "{n} ends: mean {mean:.3}, variance {variance:.3}, largest {largest:.2}, \
         sqrt(n) D {:.2}",
        n.sqrt() * departure
    );
    // the ends of one sum are nearly independent
    assert!(mean.abs() < 4.0 / n.sqrt() && (variance - 1.0).abs() < 4.0 * (2.0 / n).sqrt());
    assert!(departure < 1.95 / n.sqrt());
}

/// Quotients whose divisor comes near to zero: what the quadrature leaves out beyond probabilities of
/// 1e-17 is up to all of the moments. Of a gamma divisor with shape k and rate 1 the moments are
/// E(1/c) = 1/(k - 1) and E(1/c^2) = 1/((k - 1)(k - 2)); of a beta one (a + b - 1)/(a - 1) and that times
/// (a + b - 2)/(a - 2); a with mean 2 and standard deviation 0.5 has E(a^2) = 4.25.
#[test]
fn moments_of_quotients() {
    let numerator = || -> Distribution { Lognormal::new(2.0, 0.5).unwrap().into() };
    let quotient = |divisor: Distribution| task(vec![numerator(), divisor], "x0/x1", 0.95);
    let gamma = |shape: f64| -> Distribution { Gamma::new(shape, 1.0).unwrap().into() };
    let of_inverse = |first: f64, second: f64| {
        let mean = 2.0 * first;
        [mean, (4.25 * second - mean * mean).sqrt()]
    };
    for shape in [4.5, 2.5, 2.2, 2.05] {
        let found = exact_of(&quotient(gamma(shape))).unwrap();
        let [mean, std] = of_inverse(1.0 / (shape - 1.0), 1.0 / ((shape - 1.0) * (shape - 2.0)));
        let limit = bound(&found).max(1e-13 * std);
        assert!(limit < 1e-9 * std, "{shape}: {limit}");
        assert!((found.estimate.unwrap() - mean).abs() < limit, "{shape}: {found:?} {mean}");
        let u = found.standard_uncertainty.unwrap();
        assert!((u - std).abs() < limit, "{shape}: {u} {std}");
    }
    let (a, b) = (2.3, 2.0);
    let found = exact_of(&quotient(Beta::new(a, b).unwrap().into())).unwrap();
    let first = (a + b - 1.0) / (a - 1.0);
    let [mean, std] = of_inverse(first, first * (a + b - 2.0) / (a - 2.0));
    assert!((found.estimate.unwrap() - mean).abs() < 1e-12 * mean, "{found:?} {mean}");
    assert!((found.standard_uncertainty.unwrap() / std - 1.0).abs() < 1e-10, "{found:?} {std}");
    // no variance, and neither
    for shape in [2.0, 1.5, 1.05] {
        let found = exact_of(&quotient(gamma(shape))).unwrap();
        assert_eq!(found.standard_uncertainty, None, "{shape}");
        let mean = 2.0 / (shape - 1.0);
        let estimate = found.estimate.unwrap();
        assert!((estimate / mean - 1.0).abs() < 1e-9, "{shape}: {estimate} {mean}");
    }
    for divisor in [gamma(1.0), gamma(0.8), Exponential::new(2.0).unwrap().into()] {
        let found = exact_of(&quotient(divisor)).unwrap();
        assert_eq!((found.estimate, found.standard_uncertainty), (None, None));
    }
    let falling = || -> Distribution { Triangular::between(0.0, 1.0, Some(1.0)).unwrap().into() };
    let found = exact_of(&quotient(falling())).unwrap();
    assert_eq!(found.standard_uncertainty, None);
    assert!((found.estimate.unwrap() - 4.0).abs() < 1e-9, "{found:?}");
    // one quantity alone
    let inverse = exact_of(&task(vec![gamma(2.5)], "1/x0", 0.95)).unwrap();
    let std = (1.0 / 0.75 - 1.0f64 / 2.25).sqrt();
    assert!((inverse.standard_uncertainty.unwrap() / std - 1.0).abs() < 1e-10, "{inverse:?}");
}

/// One symmetric quantity, whatever is added to it: the shortest interval is the symmetric one. Of a
/// rectangle there are many.
#[test]
fn one_symmetric_quantity() {
    let shapes: [Distribution; 4] = [
        normal(1.0, 0.1),
        t(1.0, 0.1, 5.0),
        Triangular::between(0.0, 2.0, Some(1.0)).unwrap().into(),
        Trapezoidal::new(1.0, 1.0, 0.5).unwrap().into(),
    ];
    for shape in shapes {
        for p in [0.9, 0.95, 0.9545, 0.99] {
            let found = exact_of(&task(vec![shape.clone()], "3 - 2*x0", p)).unwrap();
            assert_eq!(found.shortest_interval, Some(found.symmetric_interval), "{shape:?} {p}");
            assert!(found.shortest_unique);
        }
    }
    let flat = exact_of(&task(vec![rectangular(1.0, 1.0)], "x0", 0.95)).unwrap();
    assert!(!flat.shortest_unique);
    // 1/x of a rectangle from 2 to 4 is densest at 1/4
    let quotient = exact_of(&task(vec![rectangular(3.0, 1.0)], "1/x0", 0.95)).unwrap();
    let [low, high] = quotient.shortest_interval.unwrap();
    // 95 % of the values of x from 4 downwards end at 2.1
    assert!(
        (low - 0.25).abs() < 1e-9 && (high - 1.0 / 2.1).abs() < 1e-9 && quotient.shortest_unique
    );
}
