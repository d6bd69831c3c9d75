//! Distributions of other crates.

use rand_distr::Distribution as _;

use super::*;

fn weibull() -> External {
    let drawn = rand_distr::Weibull::new(2.0, 1.5).unwrap();
    // scipy.stats.weibull_min(1.5, scale=2): mean and std
    External::new("weibull", 1.805_490_585_901_867_2, 1.225_871_583_509_352_8, move |random| {
        drawn.sample(random)
    })
    .unwrap()
}

/// The name is its own; without quantiles there are none, and a coefficient is refused.
#[test]
fn what_is_not_known_is_not_made_up() {
    let external: Distribution = weibull().into();
    assert_eq!(external.name(), "weibull");
    assert!(external.quantile(0.5).is_nan() && !external.has_quantiles());
    let other = Normal::new(0.0, 1.0).unwrap().into();
    let r = Correlation { first: 0, second: 1, coefficient: 0.5 };
    let refused = Joint::new(&[external, other], &[r]).unwrap_err();
    assert_eq!(refused, CorrelationError::NoQuantiles { member: 0 });
}

/// `rand_distr` takes scale and shape, `statrs` shape and scale: what does not belong together is
/// refused, and by its name.
#[test]
fn a_law_of_other_parameters_is_refused() {
    let mixed = rand_distr::Weibull::new(1.5, 2.0).unwrap();
    let sample = move |random: &mut StreamRng| mixed.sample(random);
    let refused = External::new("weibull", 1.805, 1.226, sample).unwrap_err();
    assert_eq!(refused.parameter(), "mean");
    let quantile = |p: f64| 1.5 * (-(-p).ln_1p()).sqrt();
    assert_eq!(weibull().with_quantile(quantile).unwrap_err().parameter(), "quantile");
    for (mean, std) in [(f64::NAN, 1.0), (1.8, 0.0), (1.8, f64::INFINITY)] {
        assert!(External::new("x", mean, std, |_| 1.8).is_err(), "{mean} {std}");
    }
    assert_eq!(External::new("x", 0.0, 1.0, |_| f64::NAN).unwrap_err().parameter(), "draw");
}

/// A spread that the draws do not have is refused, unless long tails hide what it is: those of a
/// lognormal distribution of sigma 3, whose standard deviation is 8,100 medians.
#[test]
fn a_standard_deviation_of_other_draws_is_refused() {
    let of = |std: f64, drawn: f64| {
        let normal = rand_distr::Normal::new(0.0, drawn).unwrap();
        External::new("x", 0.0, std, move |random| normal.sample(random))
    };
    for (std, drawn) in [(1.0, 5.0), (5.0, 1.0), (1.0, 1.2), (1e-200, 5e-200)] {
        assert_eq!(of(std, drawn).unwrap_err().parameter(), "std", "{std} {drawn}");
    }
    assert!(of(1.0, 1.0).is_ok() && of(1.0, 1.05).is_ok() && of(1e-200, 1e-200).is_ok());
    let (mean, square) = (4.5_f64.exp(), 18.0_f64.exp());
    let long = rand_distr::LogNormal::new(0.0, 3.0).unwrap();
    let std = (square - mean * mean).sqrt();
    assert!(External::new("long", mean, std, move |random| long.sample(random)).is_ok());
}

/// Moved, draws and quantiles go along.
#[test]
fn values_move_with_the_estimate() {
    let whole = weibull().with_quantile(|p: f64| 2.0 * (-(-p).ln_1p()).powf(1.0 / 1.5)).unwrap();
    let before: Distribution = whole.into();
    let moved = before.moved_to(11.805_490_585_901_867_2).unwrap();
    assert_eq!(moved.standard_uncertainty(), before.standard_uncertainty());
    assert!((moved.quantile(0.3) - before.quantile(0.3) - 10.0).abs() < 1e-14);
    for (after, before) in draws(&moved, BLOCK).iter().zip(draws(&before, BLOCK)) {
        assert!((after - before - 10.0).abs() < 1e-14);
    }
    assert!(before.moved_to(f64::NAN).is_err());
}

/// A million draws: mean and standard deviation, and the shares beyond quantiles. Each within five
/// standard errors (a false failure in a million); the kurtosis of this Weibull distribution is
/// 4.39, so that the standard deviation has the relative standard error sqrt(3.39 / 4 / n).
#[test]
fn draws_have_moments_and_quantiles_of_the_law() {
    let external: Distribution = weibull().into();
    let count = 1024 * BLOCK;
    let drawn = draws(&external, count);
    let n = count as f64;
    let (mean, std) = (external.mean(), external.standard_uncertainty());
    let found = drawn.iter().sum::<f64>() / n;
    assert!((found - mean).abs() < 5.0 * std / n.sqrt(), "{found}");
    let scatter = (drawn.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / n).sqrt();
    assert!((scatter / std - 1.0).abs() < 5.0 * (3.39 / 4.0 / n).sqrt(), "{scatter}");
    // scipy.stats.weibull_min(1.5, scale=2).ppf
    for (p, quantile) in QUANTILES {
        let share = drawn.iter().filter(|x| **x <= quantile).count() as f64 / n;
        assert!((share - p).abs() < 5.0 * (p * (1.0 - p) / n).sqrt(), "{p}: {share}");
    }
}

const QUANTILES: [(f64, f64); 4] = [
    (0.025, 0.172_443_725_496_144_53),
    (0.5, 1.566_439_537_549_302_5),
    (0.975, 4.774_848_956_100_407),
    (0.999, 7.254_173_824_678_951_6),
];

/// Draws of the laws of other crates have their moments: means and variances of 100,000 draws within six
/// standard errors, which seven laws miss with a probability below 1e-7; and the share below the
/// quartiles is a quarter and three.
#[test]
fn laws_of_other_crates_are_drawn_as_stated() {
    let laws = [
        External::weibull(1.5, 3.0),
        External::weibull(40.0, 1e12),
        External::gumbel(-2.0, 0.1),
        External::pareto(9.0, 2.0),
        External::chi_squared(3.0),
        External::binomial(20, 0.3),
        External::hypergeometric(500, 60, 80),
    ];
    for law in laws.map(Result::unwrap) {
        let name = law.name();
        let law: Distribution = law.into();
        let drawn = draws(&law, 100_000);
        let count = drawn.len() as f64;
        let z: Vec<f64> =
            drawn.iter().map(|x| (x - law.mean()) / law.standard_uncertainty()).collect();
        let mean = z.iter().sum::<f64>() / count;
        assert!(mean.abs() < 6.0 / count.sqrt(), "{name}: {mean}");
        let squares = z.iter().map(|z| z * z);
        let variance = squares.clone().sum::<f64>() / count;
        let error = ((squares.map(|s| s * s).sum::<f64>() / count - 1.0) / count).sqrt();
        assert!((variance - 1.0).abs() < 6.0 * error, "{name}: {variance}");
        for p in [0.25, 0.75] {
            let quantile = law.quantile(p);
            if quantile.is_nan() {
                continue;
            }
            let below = drawn.iter().filter(|x| **x < quantile).count() as f64 / count;
            assert!((below - p).abs() < 6.0 * (p * (1.0 - p) / count).sqrt(), "{name}: {below}");
        }
    }
}

/// Quantiles of statrs at three digits of tables: chi-squared with 10 degrees of freedom, 18.307 at 0.95;
/// Weibull of shape 2, sqrt(ln 2) at 0.5; Gumbel, -ln(ln 2); Pareto of shape 3, 2^(1/3).
#[test]
fn quantiles_of_laws_are_those_of_tables() {
    let laws = [
        (External::chi_squared(10.0), 0.95, 18.307_038_053_275_14),
        (External::weibull(2.0, 1.0), 0.5, 0.832_554_611_157_697_8),
        (External::gumbel(0.0, 1.0), 0.5, 0.366_512_920_581_664_35),
        (External::pareto(3.0, 1.0), 0.5, 1.259_921_049_894_873_2),
    ];
    for (law, p, quantile) in laws {
        let found = Distribution::from(law.unwrap()).quantile(p);
        // statrs promises twelve digits at least
        assert!((found / quantile - 1.0).abs() < 1e-12, "{found} {quantile}");
    }
}

/// Parameters beyond the ranges are refused by their names.
#[test]
fn laws_refuse_parameters_by_name() {
    for (law, parameter) in [
        (External::weibull(0.0, 1.0), "shape"),
        (External::weibull(1e-3, 1.0), "mean"),
        (External::gumbel(f64::NAN, 1.0), "location"),
        (External::pareto(2.0, 1.0), "shape"),
        (External::chi_squared(-1.0), "dof"),
        (External::binomial(u64::MAX, 0.5), "trials"),
        (External::binomial(5, 1.0), "probability"),
        (External::hypergeometric(5, 6, 1), "marked"),
        (External::hypergeometric(5, 5, 1), "std"),
    ] {
        assert_eq!(law.unwrap_err().parameter(), parameter);
    }
}
