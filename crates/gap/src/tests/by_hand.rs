//! Cases whose fields were set by hand: data and priors that are none are refused.

use super::cases::{line, observed};
use crate::{Case, DiagnosisOptions, ObservedOutput, OverrideError, Prior, diagnose};
use gumption_engine::task::Row;

/// Why a case is not diagnosed after a change.
fn refused(change: impl FnOnce(&mut Case)) -> String {
    let mut case = line();
    change(&mut case);
    match diagnose(&case, None, DiagnosisOptions::new(1), &|_| {}) {
        Err(OverrideError::Case { reason }) => reason,
        other => panic!("{other:?}"),
    }
}

/// The first output's data.
fn first(case: &mut Case) -> &mut ObservedOutput {
    case.observed[0].as_mut().unwrap()
}

#[test]
fn data_that_are_none() {
    type Change = fn(&mut Case);
    let wrong: [(Change, &str); 12] = [
        (|case| first(case).values[3] = f64::NAN, "`y`: the values must be finite numbers; row 3"),
        (|case| first(case).values.truncate(5), "`y`: there are 5 values in 6 rows"),
        (
            |case| first(case).standard_uncertainties = Some(vec![0.3; 3]),
            "`y`: there are 3 standard uncertainties in 6 rows",
        ),
        (|case| first(case).standard_uncertainties = Some(vec![0.0; 6]), "must be above 0"),
        (|case| first(case).standard_uncertainties = Some(vec![-0.3; 6]), "must be above 0"),
        (|case| first(case).standard_uncertainties = Some(vec![f64::NAN; 6]), "must be above 0"),
        (|case| first(case).simulation_uncertainties = Some(vec![-1.0; 6]), "must be 0 or above"),
        (|case| first(case).simulation_covariance = Some(vec![vec![1.0; 6]; 5]), "6 by 6"),
        (|case| case.observed = vec![None, None], "no output was observed"),
        (|case| drop(case.observed.pop()), "for 1 outputs, and the model has 2"),
        (|case| case.simulated = 9, "9 of the conditions"),
        (|case| case.reachable = vec![Some([f64::NAN, 1.0])], "no finite range"),
    ];
    for (change, reason) in wrong {
        let found = refused(change);
        assert!(found.contains(reason), "{found}");
    }
}

#[test]
fn priors_that_are_none() {
    let shares = "the prior probabilities must be from 0 to 1 and sum to one";
    assert_eq!(refused(|case| case.prior.none = f64::NAN), shares);
    assert_eq!(refused(|case| case.prior.none = 5.0), shares);
    assert_eq!(refused(|case| case.prior.one = 0.0), shares);
    // two effects are no three
    let none = refused(|case| {
        case.prior = Prior { none: 0.0, one: 0.0, two: 0.0, three: 1.0, unexplained: 0.0 };
    });
    assert!(none.starts_with("no hypothesis has a prior probability above 0"), "{none}");
    let missing = "the effect `offset` has 0 prior distributions for 1 parameters";
    assert_eq!(refused(|case| case.candidates[0].priors.clear()), missing);
}

#[test]
fn tasks_and_rows_that_do_not_fit() {
    assert_eq!(refused(|case| case.task.rows.clear()), "there are no rows");
    assert!(refused(|case| case.task.settings.coverage = 95.0.into()).contains("coverage"));
    let mut case = line();
    case.observed[0] = Some(observed(&[1.0; 6], Some(&[0.1; 6])));
    let row = Row { conditions: vec![f64::NAN], ..case.task.rows[0].clone() };
    let found = diagnose(&case, Some(&[row]), DiagnosisOptions::new(1), &|_| {});
    assert!(matches!(found, Err(OverrideError::Case { .. })));
}
