//! Estimates of the parameters of effects.

use super::cases::{candidate, case, normal, observed};
use crate::{DiagnosisOptions, diagnose};
use gumption_engine::task::Sharing;

/// An offset o of which the data know only the sum with an input a: y = a + o, 20 values of which the mean
/// m is known to v^2 = 0.1^2/20 + 0.01^2. The posterior mean of o is m 0.4^2/(0.4^2 + v^2) with the
/// variance 0.4^2 v^2/(0.4^2 + v^2). One draw of both would be off by a standard uncertainty. Of some
/// thousand effective draws the mean scatters by a few hundredths of a standard uncertainty: 0.15 are more
/// than four times that.
#[test]
fn an_estimate_is_the_mean_where_that_predicts_the_same() {
    let values: Vec<f64> =
        (0..20).map(|n| 1.3 + 0.1 * f64::from(n % 5 - 2) / 2f64.sqrt()).collect();
    let task = case(
        normal(1.0, 0.01),
        Sharing::All,
        &[("y", "a + 0*x")],
        vec![observed(&values, Some(&[0.1; 20]))],
        vec![candidate("offset", "o", normal(0.0, 0.4), &[("y", "y + o")])],
    );
    let v2: f64 = 0.1 * 0.1 / 20.0 + 0.01 * 0.01;
    let expected = 0.3 * 0.16 / (0.16 + v2);
    let u = (0.16 * v2 / (0.16 + v2)).sqrt();
    for seed in 1..=3 {
        let found = diagnose(&task, None, DiagnosisOptions::new(seed), &|_| {}).unwrap();
        assert_eq!(found.most_probable.effects, ["offset"]);
        let of = &found.hypotheses[0].parameters[0];
        assert!((of.estimate - expected).abs() < 0.15 * u, "{of:?}, not {expected}");
        assert!((of.standard_uncertainty / u - 1.0).abs() < 0.15, "{of:?}, not {u}");
        let [low, high] = of.interval;
        assert!((0.5 * (low + high) - of.estimate).abs() < 0.3 * u, "{of:?}");
    }
}
