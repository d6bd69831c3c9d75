//! Extreme parameters: draws and quantiles stay numbers, impossible parameters are refused.

use super::*;

fn extremes() -> Vec<(&'static str, Distribution)> {
    vec![
        ("gamma, least shape", Gamma::new(0.01, 1.0).unwrap().into()),
        ("gamma, small shape and large rate", Gamma::new(0.01, 1e290).unwrap().into()),
        ("gamma, small rate", Gamma::new(2.0, 1e-290).unwrap().into()),
        ("gamma, shape 1e9", Gamma::new(1e9, 1.0).unwrap().into()),
        ("gamma, shape 1e12", Gamma::new(1e12, 1e3).unwrap().into()),
        ("beta, least shapes", Beta::new(0.01, 0.01).unwrap().into()),
        ("beta, unlike shapes", Beta::new(0.01, 1e9).unwrap().into()),
        ("beta, shapes 1e9", Beta::new(1e9, 3e9).unwrap().into()),
        ("beta, wide", Beta::between(2.0, 2.0, -8e307, 8e307).unwrap().into()),
        ("exponential", Exponential::new(1e306).unwrap().into()),
        ("lognormal, wide", Lognormal::new(1e290, 1e296).unwrap().into()),
        ("lognormal, small", Lognormal::new(1e-280, 1e-274).unwrap().into()),
        ("lognormal, narrow", Lognormal::new(1.0, 1e-12).unwrap().into()),
        ("log-uniform", LogUniform::new(f64::MIN_POSITIVE, f64::MAX).unwrap().into()),
        ("curvilinear", CurvilinearTrapezoid::new(0.0, 1.0, 0.5 - 1e-16).unwrap().into()),
        ("curvilinear, exact", CurvilinearTrapezoid::new(0.0, 1.0, 1e-300).unwrap().into()),
        ("many counts", PoissonCount::new(999_999_999_999_999).unwrap().into()),
    ]
}

#[test]
fn draws_and_tails_stay_finite() {
    for (name, distribution) in shapes().into_iter().chain(extremes()) {
        let values = draws(&distribution, 100 * BLOCK);
        assert!(values.iter().all(|v| v.is_finite()), "{name}");
        if matches!(distribution, Distribution::Gamma(_) | Distribution::Lognormal(_)) {
            assert!(values.iter().all(|&v| v > 0.0), "{name}");
        }
        let tails = [2f64.powi(-53), 1e-9, 1e-3, 0.1, 0.5, 0.9, 1.0 - 2f64.powi(-53)];
        let quantiles = tails.map(|p| distribution.quantile(p));
        assert!(quantiles.iter().all(|q| q.is_finite()), "{name}: {quantiles:?}");
        assert!(quantiles.is_sorted(), "{name}: {quantiles:?}");
        let (mean, u) = (distribution.mean(), distribution.standard_uncertainty());
        assert!(mean.is_finite() && u.is_finite() && u > 0.0, "{name}: {mean}, {u}");
    }
}

/// Kolmogorov-Smirnov as in the battery, at 102,400 draws.
#[test]
fn extreme_shapes_follow_the_quantile_function() {
    let n = 100 * BLOCK;
    for (name, distribution) in extremes() {
        let mut values = draws(&distribution, n);
        values.sort_unstable_by(f64::total_cmp);
        let worst = (1..1000)
            .map(|i| {
                let p = f64::from(i) / 1000.0;
                let q = distribution.quantile(p);
                let below = values.partition_point(|&v| v < q) as f64 / n as f64;
                let up_to = values.partition_point(|&v| v <= q) as f64 / n as f64;
                (below - p).max(p - up_to)
            })
            .fold(0.0, f64::max);
        let statistic = worst * (n as f64).sqrt();
        assert!(statistic < 2.6, "{name}: {statistic}");
    }
}

#[test]
fn parameters_out_of_range_are_refused() {
    use Invalid::{
        EqualSamples, LimitsReversed, NotFinite, NotPositive, OutOfRange, TooFewSamples,
    };
    for beta in [-0.1, 1.1] {
        assert!(matches!(
            Trapezoidal::new(0.0, 1.0, beta),
            Err(OutOfRange { parameter: "beta", .. })
        ));
    }
    assert!(matches!(Trapezoidal::new(0.0, 1.0, f64::NAN), Err(NotFinite { .. })));
    for inexactness in [1.0, 2.0] {
        assert!(matches!(
            CurvilinearTrapezoid::new(-1.0, 1.0, inexactness),
            Err(OutOfRange { parameter: "inexactness", .. })
        ));
    }
    assert!(matches!(CurvilinearTrapezoid::new(-1.0, 1.0, 0.0), Err(NotPositive { .. })));
    assert!(matches!(Arcsine::between(1.0, 1.0), Err(LimitsReversed { .. })));
    assert!(matches!(Exponential::new(0.0), Err(NotPositive { parameter: "mean", .. })));
    assert!(matches!(Gamma::new(-1.0, 1.0), Err(NotPositive { parameter: "shape", .. })));
    assert!(matches!(Gamma::new(1e-3, 1.0), Err(OutOfRange { parameter: "shape", .. })));
    assert!(matches!(Gamma::new(1.0, 0.0), Err(NotPositive { parameter: "rate", .. })));
    assert!(matches!(Lognormal::new(-1.0, 1.0), Err(NotPositive { parameter: "mean", .. })));
    assert!(matches!(Lognormal::new(1.0, 1e7), Err(OutOfRange { parameter: "std", .. })));
    assert!(matches!(Lognormal::new(1.0, 1e-200), Err(Invalid::WidthLost { .. })));
    assert!(matches!(Beta::new(0.0, 1.0), Err(NotPositive { parameter: "alpha", .. })));
    assert!(matches!(Beta::between(1.0, 1.0, 1.0, 0.0), Err(LimitsReversed { .. })));
    assert!(matches!(LogUniform::new(0.0, 1.0), Err(NotPositive { parameter: "lower", .. })));
    assert!(matches!(LogUniform::new(2.0, 1.0), Err(LimitsReversed { .. })));
    assert!(matches!(PoissonCount::new(u64::MAX), Err(OutOfRange { parameter: "count", .. })));
    assert!(matches!(Samples::new(vec![1.0]), Err(TooFewSamples { count: 1 })));
    assert!(matches!(Samples::new(vec![2.0, 2.0]), Err(EqualSamples { count: 2 })));
    assert!(matches!(Samples::new(vec![2.0, f64::INFINITY]), Err(NotFinite { .. })));
}
