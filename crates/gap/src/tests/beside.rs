//! An effect of the list beside something that the list does not have.

use super::cases::{candidate, case, normal, observed};
use super::generator::SplitMix64;
use crate::{Case, Diagnosis, DiagnosisOptions, GapPart, HypothesisKind, diagnose};
use gumption_engine::task::{Row, Sharing};

/// Sixty rows of y = a + 0.5 x over x = 0 to 59 with what is left of it, and four candidates.
fn with_left(left: impl Fn(f64) -> f64, u: f64, seed: u64) -> Case {
    let mut random = SplitMix64(seed);
    random.next();
    let value = |n: usize| 1.0 + 0.5 * n as f64 + left(n as f64) + random.normal(u);
    let values: Vec<f64> = (0..60).map(value).collect();
    let size = || normal(0.0, 1.0);
    case(
        normal(1.0, 0.02),
        Sharing::All,
        &[("y", "a + 0.5*x")],
        vec![observed(&values, Some(&[u; 60]))],
        vec![
            candidate("cubic", "k", size(), &[("y", "y + k*(x/30 - 1)^3")]),
            candidate("quadratic", "k", size(), &[("y", "y + k*(x/30 - 1)^2")]),
            candidate("step", "k", size(), &[("y", "y + k*tanh((x - 20)/2)")]),
            candidate("offset", "k", size(), &[("y", "y + k")]),
        ],
    )
}

fn diagnosed(case: &Case) -> Diagnosis {
    diagnose(case, None, DiagnosisOptions::new(1), &|_| {}).unwrap()
}

fn present(found: &Diagnosis, effect: &str) -> f64 {
    found.present.iter().find(|of| of.effect == effect).unwrap().probability
}

/// A cubic term of 0.7 with a wave of 0.15 that the list does not have, in noise of 0.02: the cubic has a
/// mean square of 0.49/7 = 0.07 and the wave of 0.011, of both 86 %. A Gaussian process alone has to
/// follow the cubic as well, of the same condition; the cubic term with one beside it is more probable by
/// some nats.
#[test]
fn an_effect_is_there_though_something_is_left_beside_it() {
    let left = |x: f64| 0.7 * (x / 30.0 - 1.0).powi(3) + 0.15 * (0.55 * x).sin();
    let found = diagnosed(&with_left(left, 0.02, 1));
    let verdict = &found.most_probable;
    assert_eq!(verdict.kind, HypothesisKind::Explained, "{verdict:?}");
    assert_eq!(verdict.effects, ["cubic"]);
    // pairs of it with what does not act have a part
    assert!(verdict.probability > 0.8 && present(&found, "cubic") > 0.9, "{verdict:?}");
    for other in ["quadratic", "step", "offset"] {
        assert!(present(&found, other) < 0.3, "{other}: {}", present(&found, other));
    }
    let beside = verdict.beside.as_ref().unwrap();
    assert_eq!(beside.probability, verdict.probability, "{beside:?}");
    assert_eq!(beside.form.over.name(), Some("x"));
    // the root mean square of a sine of 0.15
    assert!((beside.form.size - 0.106).abs() < 0.02, "{beside:?}");
    let shares = &found.shrinkage.shares;
    let total: f64 = shares.iter().map(|of| of.share_of_gap).sum();
    assert!((total - 1.0).abs() < 1e-12, "{total}");
    assert_eq!(shares[0].what, GapPart::Effect("cubic".to_owned()));
    // the wave is not quite orthogonal to the cubic over some five periods
    assert!((shares[0].share_of_gap - 0.86).abs() < 0.06, "{shares:?}");
    assert_eq!(beside.share_of_gap, shares[1].share_of_gap);
    // the size is found beside the wave: 0.7 within three of its standard uncertainties
    let size = &found.hypotheses[0].parameters[0];
    assert!(found.hypotheses[0].beside && size.standard_uncertainty < 0.1, "{size:?}");
    assert!((size.estimate - 0.7).abs() < 3.0 * size.standard_uncertainty, "{size:?}");
    // hypotheses are one for each set of names, and all there are
    let sum: f64 = found.hypotheses.iter().map(|of| of.probability).sum();
    assert!((sum - 1.0).abs() < 1e-9, "{sum}");
}

/// Nothing is left beside an effect that explains the data, and no effect is named for a departure.
#[test]
fn nothing_is_left_beside_an_effect_that_explains_the_data() {
    let found = diagnosed(&with_left(|x| 0.7 * (x / 30.0 - 1.0).powi(3), 0.02, 2));
    let verdict = &found.most_probable;
    assert_eq!(verdict.effects, ["cubic"]);
    assert!(verdict.beside.is_none() && verdict.probability > 0.8, "{verdict:?}");
    assert!(!found.hypotheses[0].beside);
    let shares: Vec<&str> = found.shrinkage.shares.iter().map(|of| of.what.name()).collect();
    assert_eq!(shares, ["cubic", "noise"]);
    let found = diagnosed(&with_left(|x| 0.15 * (0.55 * x).sin(), 0.02, 3));
    assert_eq!(found.most_probable.kind, HypothesisKind::Unexplained, "{:?}", found.most_probable);
    for effect in ["cubic", "quadratic", "step", "offset"] {
        assert!(present(&found, effect) < 0.3, "{effect}: {}", present(&found, effect));
    }
}

/// A square wave forecast beyond its last time: the standard uncertainty rises to the size of the wave, and
/// never falls again.
#[test]
fn a_forecast_is_never_surer_farther_ahead() {
    let square = |x: f64| if ((x / 7.0) as usize).is_multiple_of(2) { 0.3 } else { -0.3 };
    let case = with_left(square, 0.02, 4);
    let ahead = [59.0, 60.0, 61.0, 62.0, 64.0, 67.0, 71.0, 76.0, 85.0, 100.0, 150.0, 400.0];
    let at = |x: f64| Row { conditions: vec![x], ..case.task.rows[0].clone() };
    let rows: Vec<Row> = ahead.iter().map(|&x| at(x)).collect();
    let found = diagnose(&case, Some(&rows), DiagnosisOptions::new(1), &|_| {}).unwrap();
    let predicted = found.prediction.unwrap();
    let u: Vec<f64> = predicted.iter().map(|row| row.outputs[0].1).collect();
    for pair in u.windows(2) {
        // between the places on the way at which it is asked
        assert!(pair[1] > 0.97 * pair[0], "{u:?}");
    }
    assert!(u[u.len() - 1] > 0.2, "{u:?}");
    let sim = 1.0 + 0.5 * 150.0;
    assert!((predicted[10].outputs[0].0 - sim).abs() < 2.0 * u[10] + 0.3, "{predicted:?}");
}
