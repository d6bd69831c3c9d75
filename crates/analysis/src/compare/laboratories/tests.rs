use super::*;
use gumption_engine::distribution::{BLOCK, StreamKey};

fn laboratory(label: &str, value: f64, u: f64) -> Laboratory {
    let result = StatedResult::new(value, 2.0 * u, 2.0);
    Laboratory { label: label.into(), result }
}

/// By hand: 1/u^2 = 1, 1, 1/4: mean (10 + 12 + 14/4)/(9/4) = 34/3, u = 2/3; chi-squared
/// (16/9 + 4/9 + (64/9)/4) = 4, of 2 degrees of freedom exp(-2) = 0.1353.
#[test]
fn a_weighted_mean_by_hand() {
    let all = [laboratory("a", 10.0, 1.0), laboratory("b", 12.0, 1.0), laboratory("c", 14.0, 2.0)];
    let found = compare(&all, &[]).unwrap();
    let reference = &found.reference;
    assert!((reference.value - 34.0 / 3.0).abs() < 1e-13);
    assert!((reference.standard_uncertainty - 2.0 / 3.0).abs() < 1e-14);
    assert!((reference.chi_squared - 4.0).abs() < 1e-13 && reference.dof == 2);
    assert!((reference.p_value - (-2.0f64).exp()).abs() < 1e-13);
    assert!(found.search.is_none() && found.rows.iter().all(|row| row.member));
    // u(d_i)^2 = u_i^2 - u^2 (Cox 2002, eq 7)
    for (row, u) in found.rows.iter().zip([1.0f64, 1.0, 2.0]) {
        let expected = 2.0 * (u * u - 4.0 / 9.0).sqrt();
        assert!((row.expanded - expected).abs() < 1e-13, "{row:?}");
        assert!((row.zeta - row.difference.abs() / (0.5 * expected)).abs() < 1e-13);
    }
}

/// A result that is none, and coefficients that are no matrix, are not compared.
#[test]
fn impossible_results_and_coefficients() {
    let all = [laboratory("a", 10.0, 1.0), laboratory("b", 11.0, 1.0)];
    let of = |value: f64, expanded: f64, factor: f64| {
        let result = StatedResult::new(value, expanded, factor);
        let wrong = Laboratory { label: "c".into(), result };
        compare(&[all[0].clone(), wrong, all[1].clone()], &[]).map(drop)
    };
    assert_eq!(of(10.0, 2.0, 2.0), Ok(()));
    for (value, expanded, factor) in [
        (f64::NAN, 2.0, 2.0),
        (10.0, -2.0, 2.0),
        (10.0, 0.0, 2.0),
        (10.0, f64::INFINITY, 2.0),
        (10.0, 2.0, 0.0),
        (10.0, 2.0, -2.0),
    ] {
        let refused = Impossible::Result { label: "c".into() };
        assert_eq!(of(value, expanded, factor), Err(refused), "{value} {expanded} {factor}");
    }
    for wrong in [
        vec![vec![1.0, 0.5]],
        vec![vec![1.0], vec![0.5, 1.0]],
        vec![vec![1.0, 0.5], vec![0.0, 1.0]],
        vec![vec![1.0, 0.0], vec![0.5, 1.0]],
        vec![vec![2.0, 0.0], vec![0.0, 2.0]],
        vec![vec![0.0, 0.0], vec![0.0, 0.0]],
        vec![vec![1.0, f64::NAN], vec![f64::NAN, 1.0]],
        vec![vec![1.0, f64::NAN], vec![0.5, 1.0]],
    ] {
        let refused = compare(&all, &wrong).map(drop);
        assert!(matches!(refused, Err(Impossible::Coefficients { .. })), "{wrong:?} {refused:?}");
    }
}

/// Two correlated results by hand: V = [[1, r],[r, 1]] weights both alike, u^2 = (1 + r)/2, and
/// d_1 = (x1 - x2)/2 has the variance (1 - r)/2.
#[test]
fn correlated_results() {
    let all = [laboratory("a", 10.0, 1.0), laboratory("b", 11.0, 1.0)];
    let r = 0.6;
    let found = compare(&all, &[vec![1.0, r], vec![r, 1.0]]).unwrap();
    assert!((found.reference.value - 10.5).abs() < 1e-14);
    assert!((found.reference.standard_uncertainty - 0.8f64.sqrt()).abs() < 1e-14);
    assert!((found.reference.chi_squared - 0.5 / (1.0 - r)).abs() < 1e-13);
    assert!((found.rows[0].expanded - 2.0 * 0.2f64.sqrt()).abs() < 1e-14);
    let contradictory = [vec![1.0, 1.0], vec![1.0, 1.0]];
    let pair =
        Impossible::FullyCorrelated { laboratories: ["a".into(), "b".into()], coefficient: 1.0 };
    assert_eq!(compare(&all, &contradictory), Err(pair));
    assert_eq!(compare(&all[..1], &[]), Err(Impossible::TooFew));
}

/// The largest consistent subset is that of a search over all 2^n subsets, written in another way
/// (sums of weights), for up to 12 laboratories, some of them far off.
#[test]
fn the_largest_consistent_subset() {
    let mut with_search = 0;
    for case in 0..40u64 {
        let n = 3 + (case as usize % 10);
        let mut uniform = [0.0; BLOCK];
        StreamKey::new(case, "laboratories").block(0).uniform(&mut uniform);
        let all: Vec<Laboratory> = (0..n)
            .map(|i| {
                let [value, width, off] = [uniform[3 * i], uniform[3 * i + 1], uniform[3 * i + 2]];
                let u = 0.5 + width;
                let shift = if off > 0.7 { 8.0 * (off - 0.85) / 0.15 } else { 0.0 };
                laboratory(&i.to_string(), 4.0 * (value - 0.5) * u + shift, u)
            })
            .collect();
        let found = compare(&all, &[]).unwrap();
        let mut best: Option<(usize, f64, u32)> = None;
        for set in 1u32..1 << n {
            let members: Vec<&Laboratory> =
                (0..n).filter(|i| set >> i & 1 == 1).map(|i| &all[i]).collect();
            let weight = |l: &Laboratory| l.result.standard_uncertainty().powi(-2);
            let sum: f64 = members.iter().map(|l| weight(l)).sum();
            let mean = members.iter().map(|l| weight(l) * l.result.value).sum::<f64>() / sum;
            let chi: f64 =
                members.iter().map(|l| weight(l) * (l.result.value - mean).powi(2)).sum();
            let dof = members.len() - 1;
            let consistent = dof == 0 || special::gamma::sf(0.5 * chi, 0.5 * dof as f64) >= 0.05;
            let better = best.is_none_or(|(size, least, _)| {
                members.len() > size || members.len() == size && chi < least
            });
            if consistent && better {
                best = Some((members.len(), chi, set));
            }
        }
        let (size, chi, set) = best.unwrap();
        let members = found.reference.members.iter().fold(0u32, |set, i| set | 1 << i);
        assert_eq!(members, set, "case {case}");
        assert_eq!(found.reference.members.len(), size);
        // of a laboratory alone it is 0
        assert!((found.reference.chi_squared - chi).abs() < 1e-9 * (1.0 + chi));
        with_search += usize::from(found.search == Some(SubsetSearch::All));
    }
    assert!(with_search >= 10, "{with_search}");
}

/// Fifty laboratories, six of them far off: too many subsets, so one is taken out at a time.
#[test]
fn many_laboratories() {
    let off = |i: usize| if i % 8 == 3 { 60.0 } else { 0.0 };
    let value = |i: usize| ((i * 7919) % 101) as f64 / 101.0 - 0.5 + off(i);
    let all: Vec<Laboratory> = (0..50).map(|i| laboratory("l", value(i), 1.0)).collect();
    let found = compare(&all, &[]).unwrap();
    assert_eq!(found.search, Some(SubsetSearch::OneAtATime));
    assert!(found.rows.iter().enumerate().all(|(i, row)| row.member == (off(i) == 0.0)));
    // who is not a member does not share the reference's uncertainty: u^2 = 1 + u_ref^2
    let u = found.reference.standard_uncertainty;
    let outside = found.rows.iter().find(|row| !row.member).unwrap();
    assert!((outside.expanded - 2.0 * (1.0 + u * u).sqrt()).abs() < 1e-12);
}

/// Chi-squared without some laboratories by the precision of all is that of the others by
/// themselves; to 1e-9, as both are sums of a few dozen terms of numbers about 1.
#[test]
fn laboratories_are_taken_out_without_another_inverse() {
    let n = 9;
    let value = |i: usize| elementary_noise(i) * 3.0;
    let covariance = DMatrix::from_fn(n, n, |i, j| {
        let u = |i: usize| 0.5 + 0.1 * i as f64;
        let r = if i == j { 1.0 } else { 0.3 / (1.0 + i.abs_diff(j) as f64) };
        r * u(i) * u(j)
    });
    let results = CorrelatedResults { values: (0..n).map(value).collect(), covariance };
    let everybody: Vec<usize> = (0..n).collect();
    let precision = results.precision(&everybody).unwrap();
    for out in [&[0][..], &[8], &[2, 5], &[0, 1, 7], &[1, 3, 4, 8]] {
        let left: Vec<usize> = everybody.iter().copied().filter(|i| !out.contains(i)).collect();
        let expected = results.reference(&left).unwrap().chi_squared;
        let found = precision.chi_squared_without(out).unwrap();
        assert!((found - expected).abs() < 1e-9 * expected.max(1.0), "{out:?} {found} {expected}");
    }
}

/// Some numbers from -1 to 1.
fn elementary_noise(i: usize) -> f64 {
    ((i * 7919 + 13) % 1000) as f64 / 500.0 - 1.0
}

/// A hundred laboratories that do not agree: every subset without three of them would take minutes
/// if each were inverted.
#[test]
fn a_hundred_inconsistent_laboratories() {
    let all: Vec<Laboratory> = (0..200)
        .map(|i| laboratory(&i.to_string(), 5.0 * elementary_noise(i), 0.25 + 0.001 * i as f64))
        .collect();
    for count in [100, 200] {
        let found = compare(&all[..count], &[]).unwrap();
        assert_eq!(found.search, Some(SubsetSearch::OneAtATime));
        assert!(found.reference.is_consistent() && found.reference.members.len() < count);
    }
}

/// r = 1 of two laboratories with different uncertainties gives a combination of their results without
/// uncertainty (3 A - 2 B of 0.02 and 0.03), whose rounding was stated as U = 1.9e-9; three coefficients
/// can do the same without one of them being 1, or be of no distribution at all. Nine nines pass, and
/// give the uncertainty that the formula for two has: u^2 = u1^2 u2^2 (1 - r^2)/(u1^2 + u2^2 - 2 r u1 u2).
#[test]
fn singular_correlations_are_refused() {
    let all =
        [laboratory("A", 10.02, 0.02), laboratory("B", 9.98, 0.03), laboratory("C", 10.05, 0.025)];
    let matrix =
        |ab: f64, ac: f64, bc: f64| [vec![1.0, ab, ac], vec![ab, 1.0, bc], vec![ac, bc, 1.0]];
    for ab in [1.0, -1.0, 0.999_999_999_9] {
        let error = compare(&all, &matrix(ab, 0.0, 0.0)).unwrap_err();
        assert!(error.to_string().contains("`A` and `B` are correlated by"), "{error}");
    }
    // c = (a + b)/sqrt(2)
    let half = 0.5f64.sqrt();
    let error = compare(&all, &matrix(0.0, half, half)).unwrap_err();
    assert!(error.to_string().contains("the result of `C` follows"), "{error}");
    let error = compare(&all, &matrix(0.9, 0.9, -0.9)).unwrap_err();
    assert!(error.to_string().contains("the coefficients of `C` contradict"), "{error}");
    let r = 0.999_999;
    let found = compare(&all[..2], &[vec![1.0, r], vec![r, 1.0]]).unwrap();
    let [a, b] = [0.02f64, 0.03];
    let u = (a * a * b * b * (1.0 - r * r) / (a * a + b * b - 2.0 * r * a * b)).sqrt();
    assert!((found.all.standard_uncertainty / u - 1.0).abs() < 1e-9);
}

/// Two pairs that agree among themselves and not with each other: each is a largest consistent subset
/// with chi-squared 0, in whatever order the rows stand. The single subset of three that agree has none
/// beside it.
#[test]
fn ties_of_the_largest_subset_are_told() {
    let ends = [("a", 1.0), ("b", 1.0), ("c", 3.0), ("d", 3.0)];
    for order in [[0, 1, 2, 3], [2, 3, 0, 1], [0, 2, 1, 3]] {
        let all = order.map(|of| laboratory(ends[of].0, ends[of].1, 0.1));
        let found = compare(&all, &[]).unwrap();
        assert_eq!((found.reference.members.len(), found.ties.count), (2, 1));
        let mut both = [found.reference.members.clone(), found.ties.subsets[0].clone()].concat();
        both.sort_unstable();
        assert_eq!(both, [0, 1, 2, 3]);
    }
    let all = [1.0, 1.1, 1.2, 3.0].map(|value| laboratory("a", value, 0.1));
    assert_eq!(compare(&all, &[]).unwrap().ties, Ties::default());
    // of three far from each other any one does as well, and it is not compared with itself
    let found = compare(&[1.0, 2.0, 3.0].map(|value| laboratory("a", value, 0.07)), &[]).unwrap();
    assert_eq!(found.ties.count, 2);
    let compatible: Vec<_> = found.rows.iter().map(DegreeOfEquivalence::is_compatible).collect();
    assert_eq!(compatible, [None, Some(false), Some(false)]);
}

/// By hand: two laboratories with u = 0.05 have a mean in their middle and u(d)^2 = 0.05^2/2, so that
/// values 2 sqrt(2) 0.05 apart are U(d) = sqrt(2) 0.05 from it, and En is 1 of both, wherever they lie.
#[test]
fn a_normalized_error_of_one_is_compatible() {
    let apart = 0.1 * 2.0f64.sqrt();
    for start in [0.0, 0.3, 1.37, 10.1, 1e3 / 7.0] {
        let of = |apart: f64| {
            let all = [laboratory("a", start, 0.05), laboratory("b", start + apart, 0.05)];
            let rows = compare_by(&all, &[], Some(Estimator::WeightedMean)).unwrap().rows;
            rows.iter().map(DegreeOfEquivalence::is_compatible).collect::<Vec<_>>()
        };
        assert_eq!(of(apart), [Some(true); 2], "{start}");
        assert_eq!(of(apart + 1e-7), [Some(false); 2], "{start}");
    }
}
