//! Effects whose size each device has of its own.

use super::cases::{candidate, case, normal, observed};
use crate::{Case, DiagnosisOptions, ReplicatedEffect, diagnose};
use gumption_engine::task::Sharing;

/// Devices 1 to 3 with four values each, which are off by these sizes; the noise is a fixed pattern of
/// the stated standard uncertainty.
fn devices(sizes: [f64; 3]) -> Case {
    let pattern = [0.8, -1.1, 0.4, -0.1, 1.2, -0.7, -0.9, 0.4, 0.6, -1.3, 0.3, 0.4];
    let values: Vec<f64> =
        pattern.iter().enumerate().map(|(n, z)| sizes[n / 4] + 0.02 * z).collect();
    let mut case = case(
        normal(0.0, 0.001),
        Sharing::All,
        &[("y", "a + 0*x")],
        vec![observed(&values, Some(&[0.02; 12]))],
        vec![
            candidate("offset", "o", normal(0.0, 0.5), &[("y", "y + o")]),
            candidate("tilt", "t", normal(0.0, 0.5), &[("y", "y + t*(x - 2)")]),
        ],
    );
    for (n, row) in case.task.rows.iter_mut().enumerate() {
        row.conditions = vec![(n / 4 + 1) as f64];
    }
    case.replicated(0)
}

fn offset(case: &Case) -> ReplicatedEffect {
    let found = diagnose(case, None, DiagnosisOptions::new(1), &|_| {}).unwrap();
    let replication = found.replication.unwrap();
    assert_eq!(replication.groups, [1.0, 2.0, 3.0]);
    let effects = replication.effects.into_iter();
    effects.into_iter().find(|of| of.effect == "offset").unwrap()
}

/// Sizes of each device's own are found: those of the devices' means, as the spread between them is
/// far above the noise. "Unexplained" knows a value at each level as well, so that the effect is not
/// certain.
#[test]
fn each_device_has_its_own_size() {
    let case = devices([0.3, -0.25, 0.1]);
    let found = offset(&case);
    assert!(found.probability_own > 10.0 * found.probability_shared, "{found:?}");
    let y = &case.observed[0].as_ref().unwrap().values;
    for (device, size) in found.sizes.iter().enumerate() {
        let mean = y[4 * device..4 * device + 4].iter().sum::<f64>() / 4.0;
        // some 5 % are hypotheses with one size for all and values that are off, whose sizes are up
        // to 0.6 away, which makes 0.03; the rest is known to 0.01
        assert!((size.estimate - mean).abs() < 0.06, "{size:?} {mean}");
    }
    let spread = found.spread.unwrap();
    // the standard deviation of 0.3, -0.25 and 0.1 is 0.28
    assert!(spread.interval[0] < 0.28 && spread.interval[1] > 0.28, "{spread:?}");
}

/// One size for all devices is preferred where they do not differ.
#[test]
fn one_size_for_all_is_preferred() {
    let found = offset(&devices([0.3; 3]));
    assert!(found.probability_shared > 2.0 * found.probability_own, "{found:?}");
    assert!(found.probability_shared + found.probability_own > 0.8, "{found:?}");
    for size in &found.sizes {
        assert!((size.estimate - 0.3).abs() < 0.02, "{size:?}");
    }
}

/// Names of the effects and of their pairs.
#[test]
fn an_effect_is_not_paired_with_itself() {
    let case = devices([0.3; 3]);
    let names: Vec<&str> = case.candidates.iter().map(|of| of.effect.name.as_str()).collect();
    assert_eq!(names, ["offset", "tilt", "offset (own of each x)", "tilt (own of each x)"]);
    assert_eq!(case.pairs(), [vec![0, 1], vec![0, 3], vec![1, 2]]);
    assert_eq!(case.listed_name("tilt (own of each x)"), "tilt");
    assert_eq!(case.listed_name("tilt"), "tilt");
    let formula = &case.candidates[2].effect.overrides[0].1;
    assert_eq!(
        formula.text(),
        "y + (o + o_spread*(o_z1*(x == 1.0) + o_z2*(x == 2.0) + o_z3*(x == 3.0)))"
    );
}
