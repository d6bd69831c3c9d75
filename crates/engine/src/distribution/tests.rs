//! The battery that every distribution goes through.

mod closed_forms;
mod divisors;
mod external;
mod extremes;

use super::*;

/// Shapes with a location, which moves without a change of anything else.
fn located() -> Vec<(&'static str, Distribution)> {
    vec![
        ("normal", Normal::new(10.0, 0.3).unwrap().into()),
        ("normal, 4 dof", Normal::with_dof(10.0, 0.3, 4.0).unwrap().into()),
        ("rectangular", Rectangular::new(-2.0, 0.5).unwrap().into()),
        ("rectangular by limits", Rectangular::between(1.0, 4.0).unwrap().into()),
        ("rectangular, 2 dof", Rectangular::new(1.0, 0.05).unwrap().with_dof(2.0).unwrap().into()),
        ("rectangular, 0.5 dof", Rectangular::new(1.0, 2.0).unwrap().with_dof(0.5).unwrap().into()),
        ("triangular, 2 dof", Triangular::new(3.0, 0.5).unwrap().with_dof(2.0).unwrap().into()),
        (
            "triangular, skew, 3 dof",
            Triangular::between(0.0, 3.0, Some(0.5)).unwrap().with_dof(3.0).unwrap().into(),
        ),
        (
            "triangular, mode at the limit, 0.5 dof",
            Triangular::between(0.0, 3.0, Some(3.0)).unwrap().with_dof(0.5).unwrap().into(),
        ),
        (
            "trapezoidal, 2 dof",
            Trapezoidal::new(3.0, 0.5, 0.4).unwrap().with_dof(2.0).unwrap().into(),
        ),
        (
            "trapezoidal as a rectangle, 8 dof",
            Trapezoidal::new(3.0, 0.5, 1.0).unwrap().with_dof(8.0).unwrap().into(),
        ),
        (
            "trapezoidal as a triangle, 0.5 dof",
            Trapezoidal::new(3.0, 0.5, 0.0).unwrap().with_dof(0.5).unwrap().into(),
        ),
        ("triangular", Triangular::new(3.0, 0.5).unwrap().into()),
        ("triangular, skew", Triangular::between(0.0, 3.0, Some(0.5)).unwrap().into()),
        ("triangular, mode at the limit", Triangular::between(0.0, 3.0, Some(3.0)).unwrap().into()),
        ("t", StudentT::new(1.0, 2.0, 9.0).unwrap().into()),
        ("t, many dof", StudentT::new(1.0, 2.0, 1e6).unwrap().into()),
        ("readings", Readings::new((0..12).map(|i| f64::from(i * i)).collect()).unwrap().into()),
        ("trapezoidal", Trapezoidal::new(3.0, 0.5, 0.4).unwrap().into()),
        ("trapezoidal as a triangle", Trapezoidal::new(3.0, 0.5, 0.0).unwrap().into()),
        ("trapezoidal as a rectangle", Trapezoidal::between(-1.0, 4.0, 1.0).unwrap().into()),
        ("curvilinear", CurvilinearTrapezoid::new(9.9, 10.1, 0.05).unwrap().into()),
        ("curvilinear, inexact", CurvilinearTrapezoid::new(-2.0, 2.0, 1.999).unwrap().into()),
        ("curvilinear, exact", CurvilinearTrapezoid::new(-2.0, 2.0, 1e-6).unwrap().into()),
        ("arcsine", Arcsine::new(2.0, 0.5).unwrap().into()),
        ("arcsine by limits", Arcsine::between(-1.0, 3.0).unwrap().into()),
        ("beta", Beta::new(2.0, 5.0).unwrap().into()),
        ("beta between limits", Beta::between(3.0, 1.5, 10.0, 30.0).unwrap().into()),
        ("beta, U-shaped", Beta::new(0.5, 0.5).unwrap().into()),
        ("beta, nearly all at the limits", Beta::new(0.05, 0.05).unwrap().into()),
        ("beta, nearly all at one limit", Beta::new(0.1, 3.0).unwrap().into()),
        ("beta, narrow", Beta::new(3e5, 1e6).unwrap().into()),
        ("samples", Samples::new(samples()).unwrap().into()),
    ]
}

/// Shapes of positive quantities.
fn positive() -> Vec<(&'static str, Distribution)> {
    vec![
        ("exponential", Exponential::new(3.0).unwrap().into()),
        ("gamma", Gamma::new(3.5, 2.0).unwrap().into()),
        ("gamma, shape 1", Gamma::new(1.0, 0.5).unwrap().into()),
        ("gamma, shape below 1", Gamma::new(0.7, 2.0).unwrap().into()),
        ("gamma, small shape", Gamma::new(0.05, 2.0).unwrap().into()),
        ("gamma, shape 50", Gamma::new(50.0, 3.0).unwrap().into()),
        ("gamma, large shape", Gamma::new(1e5, 1e3).unwrap().into()),
        ("lognormal", Lognormal::new(2.0, 0.2).unwrap().into()),
        ("lognormal, skew", Lognormal::new(2.0, 1.5).unwrap().into()),
        ("log-uniform", LogUniform::new(1e-3, 1e3).unwrap().into()),
        ("log-uniform, narrow", LogUniform::new(2.0, 2.1).unwrap().into()),
        ("no counts", PoissonCount::new(0).unwrap().into()),
        ("counts", PoissonCount::new(9).unwrap().into()),
    ]
}

fn shapes() -> Vec<(&'static str, Distribution)> {
    located().into_iter().chain(positive()).collect()
}

/// Twenty-one of them, unordered, one twice.
fn samples() -> Vec<f64> {
    (0..21).map(|i| f64::from((i * 8) % 20) * 0.25 - 2.0).collect()
}

/// `count` draws; `count` is a multiple of a block's length.
fn draws(distribution: &Distribution, count: usize) -> Vec<f64> {
    let key = StreamKey::new(20, "x");
    let mut values = Vec::with_capacity(count);
    for block in 0..count / BLOCK {
        let mut stream = key.block(block as u64);
        for _ in 0..BLOCK / crate::number::COLUMN {
            let mut column = Column::ZERO;
            distribution.draw(&mut stream, &mut column);
            values.extend(column.0);
        }
    }
    values
}

/// Kolmogorov-Smirnov at 409,600 draws against the quantile function: at the 4000 points p the
/// share of draws below quantile(p) is p; where draws share a value (samples, limits that values
/// round to), the shares below it and up to it enclose p. The statistic sqrt(n) D exceeds 2.6 with
/// a probability of 2 exp(-2 2.6^2) = 3e-6 a shape.
#[test]
fn draws_follow_the_quantile_function() {
    let n = 400 * BLOCK;
    for (name, distribution) in shapes() {
        let values = draws(&distribution, n);
        assert!(values.iter().all(|v| v.is_finite()), "{name}");
        let points = 4000;
        let shares: Vec<f64> = (1..points).map(|i| f64::from(i) / f64::from(points)).collect();
        let quantiles: Vec<f64> = shares.iter().map(|&p| distribution.quantile(p)).collect();
        assert!(quantiles.is_sorted(), "{name}");
        // by the first quantile above a draw, and by the first that is not below it
        let (mut below, mut up_to) = (vec![0; shares.len() + 1], vec![0; shares.len() + 1]);
        for v in values {
            let first = quantiles.partition_point(|&q| q < v);
            up_to[first] += 1;
            let equal = quantiles[first..].iter().take_while(|&&q| q == v).count();
            below[first + equal] += 1;
        }
        let (mut draws_below, mut draws_up_to, mut worst) = (0, 0, 0.0_f64);
        for ((p, below), up_to) in shares.into_iter().zip(below).zip(up_to) {
            draws_below += below;
            draws_up_to += up_to;
            let share = |draws: i32| f64::from(draws) / n as f64;
            worst = worst.max(share(draws_below) - p).max(p - share(draws_up_to));
        }
        let statistic = worst * (n as f64).sqrt();
        assert!(statistic < 2.6, "{name}: {statistic}");
    }
}

/// Mean and standard deviation of 409,600 draws lie within six standard errors of the stated
/// ones (2e-9 each); the fourth moments of all shapes here exist.
#[test]
fn draws_have_the_stated_moments() {
    let n = 400 * BLOCK;
    for (name, distribution) in shapes().into_iter().filter(|(name, _)| *name != "normal, 4 dof") {
        let values = draws(&distribution, n);
        let (mean, std) = (distribution.mean(), distribution.standard_deviation());
        let m1 = values.iter().map(|v| v - mean).sum::<f64>() / n as f64;
        let m2 = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / n as f64;
        let m4 = values.iter().map(|v| (v - mean).powi(4)).sum::<f64>() / n as f64;
        assert!(m1.abs() < 6.0 * std / (n as f64).sqrt(), "{name}: mean off by {m1}");
        let error = ((m4 - m2 * m2) / n as f64).sqrt();
        assert!((m2 - std * std).abs() < 6.0 * error, "{name}: variance {m2} not {}", std * std);
    }
}

/// The stated moments are those of the quantile function, by the midpoint rule in t with
/// p = t^3 (10 - 15 t + 6 t^2), whose weight 30 t^2 (1 - t)^2 dt leaves nothing of the ends. The
/// kinks of some shapes cost 1e-7 of a standard deviation at 2e4 points. The steps of samples cost
/// more; they have a test of their own, as has the t, where few moments exist.
#[test]
fn stated_moments_are_those_of_the_quantile_function() {
    for (name, distribution) in shapes() {
        if distribution.drawn_dof().is_finite() || name == "samples" {
            continue;
        }
        let n = 20_000;
        let (mut mean, mut variance) = (0.0, 0.0);
        for i in 0..n {
            let t = (f64::from(i) + 0.5) / f64::from(n);
            let p = t * t * t * (10.0 - t * (15.0 - 6.0 * t));
            let weight = 30.0 * (t * (1.0 - t)).powi(2) / f64::from(n);
            let offset = distribution.quantile(p) - distribution.mean();
            mean += weight * offset;
            variance += weight * offset * offset;
        }
        let u = distribution.standard_deviation();
        assert!(mean.abs() < 1e-6 * u, "{name}: mean off by {mean}");
        assert!((variance.sqrt() / u - 1.0).abs() < 1e-6, "{name}: {} not {u}", variance.sqrt());
    }
}

#[test]
fn moving_an_estimate_moves_the_limits_along() {
    for (name, distribution) in located() {
        let moved = distribution.moved_to(100.0).unwrap();
        assert!((moved.mean() - 100.0).abs() < 1e-12, "{name}");
        let shift = 100.0 - distribution.mean();
        assert!((moved.quantile(0.9) - distribution.quantile(0.9) - shift).abs() < 1e-12, "{name}");
        assert!(distribution.moved_to(f64::NAN).is_err(), "{name}");
    }
}

/// The lognormal keeps its standard deviation, a count becomes another count; the others keep
/// their relative standard uncertainty.
#[test]
fn moving_the_estimate_of_a_positive_quantity() {
    for (name, distribution) in positive() {
        let moved = distribution.moved_to(7.0).unwrap();
        assert!((moved.mean() - 7.0).abs() < 1e-14 * 7.0, "{name}");
        let expected = match &distribution {
            Distribution::Lognormal(_) => distribution.standard_uncertainty(),
            Distribution::PoissonCount(_) => 7f64.sqrt(),
            _ => distribution.standard_uncertainty() * (7.0 / distribution.mean()),
        };
        assert!((moved.standard_uncertainty() / expected - 1.0).abs() < 1e-13, "{name}");
        for estimate in [0.0, -1.0, f64::INFINITY] {
            assert!(distribution.moved_to(estimate).is_err(), "{name}");
        }
    }
    assert!(PoissonCount::new(3).unwrap().moved_to(4.5).is_err());
}

struct Draw<'a>(&'a Distribution);

impl crate::number::Kernel for Draw<'_> {
    type Output = Vec<u64>;

    #[inline(always)]
    fn run(self) -> Vec<u64> {
        let mut stream = StreamKey::new(20, "x").block(3);
        let mut bits = Vec::new();
        for _ in 0..BLOCK / crate::number::COLUMN {
            let mut column = Column::ZERO;
            self.0.draw(&mut stream, &mut column);
            bits.extend(column.0.map(f64::to_bits));
        }
        bits
    }
}

#[test]
fn draws_have_the_same_bits_at_every_vector_width() {
    for (name, distribution) in shapes() {
        let plain = Draw(&distribution);
        let plain = crate::number::Kernel::run(plain);
        for path in crate::number::CodePath::available() {
            assert_eq!(path.run(Draw(&distribution)), plain, "{name}, {path:?}");
        }
    }
}

/// JCGM 100, 4.4.3 (Table 1 of the example): twenty readings of a temperature, mean 100.145 degC,
/// experimental standard deviation 1.489 degC, of the mean 0.333 degC.
#[test]
fn readings_of_the_guide() {
    let values = vec![
        96.90, 98.18, 98.25, 98.61, 99.03, 99.49, 99.56, 99.74, 99.89, 100.07, 100.33, 100.42,
        100.68, 100.95, 101.11, 101.20, 101.57, 101.84, 102.36, 102.72,
    ];
    let readings = Readings::new(values).unwrap();
    assert!((readings.mean() - 100.145).abs() < 5e-4);
    assert!((readings.standard_uncertainty() * 20f64.sqrt() - 1.489).abs() < 5e-4);
    assert!((readings.standard_uncertainty() - 0.333).abs() < 5e-4);
    assert_eq!(readings.dof(), 19.0);
}

/// A summary of readings is drawn as the readings themselves: the same trials, bit for bit.
#[test]
fn a_summary_stands_for_the_readings() {
    // mean 2, s = 1, without rounding
    let listed = Readings::new(vec![1.0, 2.0, 3.0]).unwrap();
    let summary = Readings::of_summary(2.0, 1.0, 3).unwrap();
    assert_eq!((summary.dof(), summary.count(), summary.values().len()), (2.0, 3, 0));
    let [listed, summary] = [listed, summary].map(Distribution::from);
    assert!((summary.standard_uncertainty() - 1.0 / 3_f64.sqrt()).abs() < 2e-16);
    assert_eq!(draws(&summary, BLOCK), draws(&listed, BLOCK));
    assert_eq!(summary.divisor(), listed.divisor());
    for (s, n) in [(0.0, 3), (-1.0, 3), (1.0, 1), (f64::NAN, 3)] {
        assert!(Readings::of_summary(2.0, s, n).is_err(), "{s} {n}");
    }
    assert!(Readings::of_summary(2.0, 1.0, 9).unwrap().paired(2).is_err());
}

/// The t of few degrees of freedom has no variance, yet no draw is lost: the largest of a million
/// draws with half a degree of freedom is huge and finite.
#[test]
fn heavy_tails_stay_finite() {
    for dof in [0.5, 1.0, 2.0, 1e8, 1e9, 1e300] {
        let t: Distribution = StudentT::new(0.0, 1.0, dof).unwrap().into();
        assert!(draws(&t, 1000 * BLOCK).iter().all(|v| v.is_finite()), "{dof}");
        assert_eq!(t.standard_deviation().is_infinite(), dof <= 2.0);
    }
}

#[test]
fn impossible_parameters_are_refused() {
    assert!(matches!(Normal::new(0.0, 0.0), Err(Invalid::NotPositive { parameter: "std", .. })));
    assert!(matches!(Normal::new(f64::NAN, 1.0), Err(Invalid::NotFinite { .. })));
    assert!(matches!(Rectangular::new(0.0, -1.0), Err(Invalid::NotPositive { .. })));
    assert!(matches!(Rectangular::between(2.0, 1.0), Err(Invalid::LimitsReversed { .. })));
    assert!(matches!(
        Triangular::between(0.0, 1.0, Some(2.0)),
        Err(Invalid::OutOfRange { parameter: "mode", .. })
    ));
    assert!(matches!(StudentT::new(0.0, 1.0, 0.0), Err(Invalid::NotPositive { .. })));
    assert!(matches!(Readings::new(vec![1.0]), Err(Invalid::TooFewReadings { count: 1 })));
    assert!(matches!(Readings::new(vec![1.0, 1.0]), Err(Invalid::NoScatter { count: 2 })));
    // these are not equal
    for values in [vec![1e308, -1e308], vec![1e-320, 2e-320, 3e-320]] {
        let refused = Readings::new(values);
        assert!(matches!(refused, Err(Invalid::ScatterOutOfRange { .. })), "{refused:?}");
    }
}

/// Three joint normals keep their declared coefficients: with 1,024,000 draws each coefficient has
/// a standard error of (1 - r^2)/1012; five of them leave 6e-7 a pair.
#[test]
fn joint_normals_have_the_declared_correlations() {
    let distributions: Vec<Distribution> =
        (0..3).map(|i| Normal::new(f64::from(i), 2.0).unwrap().into()).collect();
    let correlation = |first, second, coefficient| Correlation { first, second, coefficient };
    let declared = [correlation(0, 1, 0.9), correlation(0, 2, -0.36), correlation(1, 2, -0.65)];
    let joint = Joint::new(&distributions, &declared).unwrap();
    let keys: Vec<StreamKey> = ["a", "b", "c"].map(|n| StreamKey::new(3, n)).to_vec();
    let mut registers = vec![Column::ZERO; 3];
    let mut sums = [[0.0; 3]; 3];
    let varying = Varying::all(&distributions, &joint);
    let blocks = 1000;
    for block in 0..blocks {
        let mut draws = Draws::new(&varying, &keys, crate::number::CodePath::best(), block);
        for _ in 0..BLOCK / crate::number::COLUMN {
            draws.column(&mut registers, &[0, 1, 2], &[true; 3]);
            #[allow(clippy::needless_range_loop)] // two indices each
            for i in 0..3 {
                for j in 0..3 {
                    for t in 0..crate::number::COLUMN {
                        let z = |q: usize| (registers[q].0[t] - q as f64) / 2.0;
                        sums[i][j] += z(i) * z(j);
                    }
                }
            }
        }
    }
    let n = (blocks as usize * BLOCK) as f64;
    for c in declared {
        let drawn = sums[c.first][c.second] / n;
        let error = (1.0 - c.coefficient.powi(2)) / n.sqrt();
        // the scales are known to be 1, which adds the error of two variances
        assert!((drawn - c.coefficient).abs() < 5.0 * (error + 1.0 / n.sqrt()), "{c:?}: {drawn}");
    }
}

#[test]
fn contradictory_correlations_are_refused() {
    let distributions: Vec<Distribution> =
        (0..3).map(|_| Normal::new(0.0, 1.0).unwrap().into()).collect();
    let correlation = |first, second, coefficient| Correlation { first, second, coefficient };
    let impossible = [correlation(0, 1, 0.9), correlation(0, 2, 0.9), correlation(1, 2, -0.9)];
    assert!(matches!(
        Joint::new(&distributions, &impossible),
        Err(CorrelationError::Contradiction { .. })
    ));
    // 1 between all three, printed as 0.9999: singular up to rounding, and accepted
    let singular = [correlation(0, 1, 1.0), correlation(0, 2, 1.0), correlation(1, 2, 0.9999)];
    assert!(Joint::new(&distributions, &singular).unwrap().rounded);
}

/// Both quantile functions are the same where 1 - p is exact, to the rounding of their arithmetic,
/// and the upper one goes on where 1 - q rounds to 1, without an infinite value.
#[test]
fn upper_quantiles_are_those_of_the_other_tail() {
    for (name, distribution) in shapes() {
        let std = distribution.standard_uncertainty();
        for p in [0.5, 0.25, 0.75, 0.125, 2f64.powi(-20), 1.0 - 2f64.powi(-20)] {
            let (lower, upper) = (distribution.quantile(p), distribution.quantile_upper(1.0 - p));
            assert!((lower - upper).abs() <= 1e-12 * (std + lower.abs()), "{name} at {p}");
        }
        let mut last = distribution.quantile(1.0 - 2f64.powi(-40));
        for exponent in [-45, -50, -60, -200, -900] {
            let x = distribution.quantile_upper(2f64.powi(exponent));
            // shapes that end give their limit to rounding
            assert!(x.is_finite() && x >= last - 1e-9 * std, "{name} at 2^{exponent}: {x}");
            last = x;
        }
    }
}

/// JCGM 101, 9.5.2.8: the difference of temperature of the gauge blocks lies within 0.05 degC, and
/// that with 2 degrees of freedom (JCGM 100, H.1.4); its curvilinear trapezoid has d = 0.025.
/// JCGM 100 has its standard uncertainty, 0.029 degC, with the degrees of freedom; the trials have
/// that of 6.4.3.4, sqrt(w^2/3 + d^2/9).
#[test]
fn a_rectangle_with_degrees_of_freedom_is_a_curvilinear_trapezoid() {
    let stated: Distribution = Rectangular::new(0.0, 0.05).unwrap().with_dof(2.0).unwrap().into();
    let drawn: Distribution = CurvilinearTrapezoid::new(-0.05, 0.05, 0.025).unwrap().into();
    assert_eq!(stated.drawn_as(), Some("curvilinear-trapezoid"));
    assert_eq!(draws(&stated, BLOCK), draws(&drawn, BLOCK));
    assert_eq!(stated.quantile(0.01), drawn.quantile(0.01));
    assert_eq!((stated.dof(), stated.name()), (2.0, "rectangular"));
    assert!((stated.standard_uncertainty() - 0.05 / 3f64.sqrt()).abs() < 1e-17);
    let expected = (0.05f64.powi(2) / 3.0 + 0.025f64.powi(2) / 9.0).sqrt();
    assert!((stated.standard_deviation() - expected).abs() < 1e-16);
    // and a rectangle whose width is known exactly is drawn as it ever was
    let exact: Distribution = Rectangular::new(0.0, 0.05).unwrap().into();
    assert_eq!(exact.drawn_as(), None);
    for dof in [0.0, 0.49, f64::NAN] {
        assert!(Rectangular::new(0.0, 0.05).unwrap().with_dof(dof).is_err(), "{dof}");
    }
}
