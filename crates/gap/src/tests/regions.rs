//! The scan for regions.

use super::cases::line;
use crate::check::truth_with;
use gumption_inference::scan::regions;
use gumption_inference::setup::Setup;

fn false_alarms(sets: u64) -> usize {
    let mut case = line();
    let noise: Vec<Vec<f64>> = vec![vec![0.1, 0.1, 0.12, 0.1, 0.2, 0.1]; 2];
    (0..sets)
        .filter(|&number| {
            let (_, measured) = truth_with(&case, &noise, &[], 11, number);
            for (observed, values) in case.observed.iter_mut().flatten().zip(measured) {
                observed.values = values;
            }
            let setup = Setup::new(&case);
            !regions(&setup, &setup.linear.variances.clone(), number).is_empty()
        })
        .count()
}

/// At a false-alarm rate of 5 %, more than 14 of 120 sets have probability 7e-4.
#[test]
fn data_without_a_gap_name_a_region_rarely() {
    let found = false_alarms(120);
    assert!(found <= 14, "{found} of 120");
}

/// At most 5 % of 1,000 simulated data sets. Takes minutes.
#[test]
#[ignore = "heavy: run by .ci/extra"]
fn false_alarms_of_a_thousand_sets() {
    let found = false_alarms(1000);
    assert!(found <= 50, "{found} of 1000");
}

/// Two values far off are found where they are.
#[test]
fn a_local_effect_is_found_where_it_is() {
    let mut case = line();
    for (observed, shift) in case.observed.iter_mut().flatten().zip([2.0, 0.0]) {
        observed.values[3] += shift;
        observed.values[4] += shift;
    }
    let setup = Setup::new(&case);
    let found = regions(&setup, &setup.linear.variances.clone(), 1);
    assert_eq!(found[0].output, Some(0));
    // the point at 5 is four standard uncertainties high by itself
    assert_eq!(found[0].range, Some((0, [3.0, 5.0])));
    assert!(found[0].p_value < 1e-6);
    assert!(found[0].mean_z > 5.0);
}

/// A whole output departs, with signs in turn so that no input makes it: no condition is named, which
/// would be idle, and not the other output.
#[test]
fn what_departs_everywhere_has_no_condition() {
    let mut case = line();
    for (row, value) in case.observed[0].iter_mut().flat_map(|of| &mut of.values).enumerate() {
        *value += if row.is_multiple_of(2) { 0.5 } else { -0.5 };
    }
    let setup = Setup::new(&case);
    let found = regions(&setup, &setup.linear.variances.clone(), 1);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!((found[0].output, found[0].range), (Some(0), None));
}

/// Where both outputs depart they are one region.
#[test]
fn outputs_that_depart_together_are_one_region() {
    let mut case = line();
    for values in case.observed.iter_mut().flatten().map(|of| &mut of.values) {
        for (row, value) in values.iter_mut().enumerate() {
            *value += if row.is_multiple_of(2) { 0.6 } else { -0.6 };
        }
    }
    let setup = Setup::new(&case);
    let found = regions(&setup, &setup.linear.variances.clone(), 1);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!((found[0].output, found[0].range), (None, None));
}
