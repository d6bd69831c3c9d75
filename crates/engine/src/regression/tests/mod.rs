//! Fits against published examples and certified values.

mod complex;
mod strd;
mod trials;

use std::sync::Arc;

use super::{Cross, Curve, Points, Regression, RegressionError, Spread, choose_degree};
use crate::linalg::packed;

fn lower(n: usize, entry: impl Fn(usize, usize) -> f64) -> Vec<f64> {
    let entries: Vec<f64> =
        (0..n).flat_map(|i| (0..=i).map(move |j| (i, j))).map(|(i, j)| entry(i, j)).collect();
    assert_eq!(entries.len(), packed::triangle(n));
    entries
}

fn squares(values: &[f64]) -> Spread {
    Spread::Each(values.iter().map(|u| u * u).collect())
}

/// a, b, u(a), u(b), cov(a, b), chi-squared, each to half a unit of the last printed place.
fn check_line(points: &Points, printed: [f64; 6]) {
    let line =
        Regression::of("line", &Curve::polynomial(1), &Arc::new(points.clone()), &[]).unwrap();
    let found = [
        line.estimate(0),
        line.estimate(1),
        line.standard_uncertainty(0),
        line.standard_uncertainty(1),
        line.covariance(0, 1),
    ];
    for (found, printed) in found.into_iter().zip(printed) {
        assert!((found - printed).abs() <= 5.1e-5, "{found} {printed}");
    }
    assert!((line.chi2 - printed[5]).abs() <= 5.1e-4, "{} {}", line.chi2, printed[5]);
    assert_eq!(line.is_valid(), Some(true));
}

fn six() -> Vec<f64> {
    (1..=6).map(f64::from).collect()
}

/// The straight-line examples of ISO/TS 28037:2010, clauses 6 to 9.
#[test]
fn lines_of_iso_ts_28037() {
    let equal = Points::new(six(), vec![3.3, 5.6, 7.1, 9.3, 10.7, 12.1]).with_y(squares(&[0.5; 6]));
    check_line(&equal, [1.8667, 1.7571, 0.4655, 0.1195, -0.0500, 1.665]);
    let unequal = Points::new(six(), vec![3.2, 4.3, 7.6, 8.6, 11.7, 12.8])
        .with_y(squares(&[0.5, 0.5, 0.5, 1.0, 1.0, 1.0]));
    check_line(&unequal, [0.8852, 2.0570, 0.5297, 0.1779, -0.0823, 4.131]);
    let both =
        Points::new(vec![1.2, 1.9, 2.9, 4.0, 4.7, 5.9], vec![3.4, 4.4, 7.2, 8.5, 10.8, 13.5])
            .with_x(squares(&[0.2; 6]))
            .with_y(squares(&[0.2, 0.2, 0.2, 0.4, 0.4, 0.4]));
    check_line(&both, [0.5788, 2.1597, 0.4764, 0.1355, -0.0577, 2.743]);
    let pairs = both.with_cross(Cross::Each(vec![0.036; 6]));
    check_line(&pairs, [0.5816, 2.1700, 0.2856, 0.0902, -0.0228, 6.483]);
    let block = |i: usize, j: usize| match (i < 5, j < 5) {
        (true, true) => 1.0 + f64::from(u8::from(i == j)),
        (false, false) => 4.0 + f64::from(u8::from(i == j)),
        _ => 0.0,
    };
    let y = vec![1.3, 4.1, 6.9, 7.5, 10.2, 12.0, 14.5, 17.1, 19.5, 21.0];
    let joint =
        Points::new((1..=10).map(f64::from).collect(), y).with_y(Spread::Joint(lower(10, block)));
    check_line(&joint, [-0.6456, 2.2014, 1.2726, 0.2015, -0.1669, 2.074]);
}

/// Where all points have the same uncertainties in x and in y the line is Deming's, in closed form (W.
/// E. Deming, Statistical Adjustment of Data, 1943): with d = u(y)^2/u(x)^2 the slope is
/// (Syy - d Sxx + sqrt((Syy - d Sxx)^2 + 4 d Sxy^2))/(2 Sxy). The least squares of y alone, from which
/// the search starts, satisfy its first two steps.
#[test]
fn equal_uncertainties_of_both_give_the_line_of_deming() {
    let cases = [
        (vec![1.0, 2.0, 3.0, 4.0], vec![1.1, 2.6, 2.7, 3.9], 0.5, 0.1),
        (six(), vec![1.3, 0.6, 3.1, 2.3, 6.7, 4.1], 0.5, 0.5),
    ];
    for (x, y, ux, uy) in cases {
        let n = x.len();
        let mean = |values: &[f64]| values.iter().sum::<f64>() / n as f64;
        let (at, of) = (mean(&x), mean(&y));
        let sum = |f: &dyn Fn(usize) -> f64| (0..n).map(f).sum::<f64>();
        let sxx = sum(&|i| (x[i] - at).powi(2));
        let syy = sum(&|i| (y[i] - of).powi(2));
        let sxy = sum(&|i| (x[i] - at) * (y[i] - of));
        let d: f64 = uy * uy / (ux * ux);
        let half = syy - d * sxx;
        let slope = (half + (half * half + 4.0 * d * sxy * sxy).sqrt()) / (2.0 * sxy);
        let exact = [of - slope * at, slope];
        let chi2 = sum(&|i| (y[i] - exact[0] - exact[1] * x[i]).powi(2))
            / (uy * uy + slope * slope * ux * ux);
        let points = Points::new(x.clone(), y.clone());
        let diagonal = |u: f64| Spread::Joint(lower(n, |i, j| if i == j { u * u } else { 0.0 }));
        let each = points.clone().with_x(squares(&vec![ux; n])).with_y(squares(&vec![uy; n]));
        let full = points.with_x(diagonal(ux)).with_y(diagonal(uy));
        for points in [each.clone(), full, each.with_cross(Cross::Each(vec![0.0; n]))] {
            let points = Arc::new(points);
            let line = Regression::of("line", &Curve::polynomial(1), &points, &[]).unwrap();
            for (k, exact) in exact.into_iter().enumerate() {
                assert!((line.estimate(k) - exact).abs() < 1e-8, "{} {exact}", line.estimate(k));
            }
            assert!((line.chi2 / chi2 - 1.0).abs() < 1e-8, "{} {chi2}", line.chi2);
        }
    }
}

/// The general case of clause 10 has to give each of the others: with full matrices that say the same
/// as standard uncertainties and pairs.
#[test]
fn the_general_case_holds_the_others() {
    let (ux, uy) = ([0.2; 6], [0.2, 0.2, 0.2, 0.4, 0.4, 0.4]);
    let points =
        Points::new(vec![1.2, 1.9, 2.9, 4.0, 4.7, 5.9], vec![3.4, 4.4, 7.2, 8.5, 10.8, 13.5]);
    let diagonal =
        |u: [f64; 6]| Spread::Joint(lower(6, |i, j| if i == j { u[i] * u[i] } else { 0.0 }));
    let mut cross = vec![0.0; 36];
    (0..6).for_each(|i| cross[i * 7] = 0.036);
    let full = points.with_x(diagonal(ux)).with_y(diagonal(uy)).with_cross(Cross::Joint(cross));
    check_line(&full, [0.5816, 2.1700, 0.2856, 0.0902, -0.0228, 6.483]);
}

/// Clause 6 and annex E: nothing is stated, and the residuals tell s with n - 2 degrees of freedom.
/// With unit weights a, b are those of the same points, u scaled by s = sqrt(chi2/(n - 2)).
#[test]
fn unknown_uncertainties_come_from_the_residuals() {
    let points = Points::new(six(), vec![3.014, 5.225, 7.004, 9.061, 11.201, 12.762]);
    let line =
        Regression::of("line", &Curve::polynomial(1), &Arc::new(points.clone()), &[]).unwrap();
    assert_eq!((line.dof, line.degrees_of_freedom(), line.p_value()), (4, 4.0, None));
    // by the closed formulas: Sxx = 17.5, u(b) = s/sqrt(Sxx)
    let s = line.factor.unwrap();
    assert!((line.standard_uncertainty(1) - s / 17.5_f64.sqrt()).abs() < 1e-14);
    assert!((s * s * 4.0 - line.chi2).abs() < 1e-14);
    let residuals: f64 = line.residuals().iter().map(|r| r * r).sum();
    assert!((residuals - line.chi2).abs() < 1e-14);
}

/// Relative error in digits, the largest over all coefficients: NIST's log relative error.
fn worst(found: impl Iterator<Item = f64>, certified: &[f64]) -> f64 {
    found.zip(certified).map(|(f, c)| ((f - c) / c).abs()).fold(0.0, f64::max)
}

/// NIST StRD Wampler1 and Wampler2: y = sum of x^k, and of (x/10)^k, exactly, for x = 0 to 20.
#[test]
fn wampler_exact() {
    let x: Vec<f64> = (0..=20).map(f64::from).collect();
    for (base, limit) in [(1.0, 1e-9), (0.1, 1e-12)] {
        let certified: Vec<f64> = (0..6).map(|k| libm::pow(base, f64::from(k))).collect();
        let y = x.iter().map(|x| certified.iter().rev().fold(0.0, |s, c| s * x + c)).collect();
        let fit =
            Regression::of("w", &Curve::polynomial(5), &Arc::new(Points::new(x.clone(), y)), &[])
                .unwrap();
        let error = worst(fit.estimates.iter().copied(), &certified);
        assert!(error < limit, "{base} {error}");
    }
}

/// NIST StRD Wampler3 to Wampler5: the same with alternating large residuals, whose certified
/// coefficients are all 1 and whose residual standard deviations are 2360.14502379268 times 1, 100
/// and 10,000.
#[test]
fn wampler_with_residuals() {
    // the residuals of Wampler3, which are orthogonal to the polynomials of degree 5
    let delta = [
        759.0, -2048.0, 2048.0, -2048.0, 2523.0, -2048.0, 2048.0, -2048.0, 1838.0, -2048.0, 2048.0,
        -2048.0, 1838.0, -2048.0, 2048.0, -2048.0, 2523.0, -2048.0, 2048.0, -2048.0, 759.0,
    ];
    let x: Vec<f64> = (0..=20).map(f64::from).collect();
    for (factor, limit) in [(1.0, 1e-9), (100.0, 1e-8), (10_000.0, 1e-6)] {
        let y = x
            .iter()
            .zip(delta)
            .map(|(x, d)| [1.0; 6].iter().rev().fold(0.0, |s, c| s * x + c) + factor * d)
            .collect();
        let points = Points::new(x.clone(), y);
        let fit = Regression::of("w", &Curve::polynomial(5), &Arc::new(points), &[]).unwrap();
        let error = worst(fit.estimates.iter().copied(), &[1.0; 6]);
        assert!(error < limit, "{factor} {error}");
        let s = fit.factor.unwrap() / factor;
        assert!((s / 2_360.145_023_792_68 - 1.0).abs() < 1e-13, "{s}");
    }
}

#[test]
fn the_degree_of_a_parabola_is_two() {
    let x: Vec<f64> = (0..12).map(f64::from).collect();
    let wiggle = [0.3, -0.2, 0.1, -0.4, 0.2, 0.1, -0.3, 0.4, -0.1, 0.2, -0.2, -0.1];
    let y = x.iter().zip(wiggle).map(|(x, w)| 1.0 + 2.0 * x - 0.3 * x * x + w).collect();
    let points = Points::new(x, y).with_y(squares(&[0.25; 12]));
    let fit = choose_degree("f", 0.0, &Arc::new(points), 6).unwrap();
    assert_eq!(fit.count(), 3);
    assert_eq!(fit.degrees.len(), 6);
    assert!(fit.degrees[0].p_value.unwrap() < 1e-6 && fit.degrees[1].p_value.unwrap() > 0.05);
}

#[test]
fn points_that_cannot_be_fitted() {
    let line = |points: &Points| {
        Regression::of("l", &Curve::polynomial(1), &Arc::new(points.clone()), &[])
    };
    let stated = |x: &[f64], y: &[f64]| {
        Points::new(x.to_vec(), y.to_vec()).with_y(squares(&vec![1.0; y.len()]))
    };
    assert!(matches!(
        line(&stated(&[1.0], &[1.0])),
        Err(RegressionError::TooFewPoints { points: 1, parameters: 2, needed: 2, .. })
    ));
    assert!(line(&stated(&[1.0, 2.0], &[1.0, 2.0])).is_ok());
    assert!(matches!(
        line(&Points::new(vec![1.0, 2.0], vec![1.0, 2.0])),
        Err(RegressionError::TooFewPoints { points: 2, estimated: true, .. })
    ));
    assert!(matches!(
        line(&stated(&[3.0, 3.0, 3.0], &[1.0, 2.0, 3.0])),
        Err(RegressionError::TooFewAbscissae { different: 1, parameters: 2 })
    ));
    let zero = Points::new(six(), six()).with_y(squares(&[1.0, 1.0, 0.0, 1.0, 1.0, 1.0]));
    assert!(matches!(line(&zero), Err(RegressionError::NoVariance { point: 2, .. })));
    let singular = Points::new(six(), six()).with_y(Spread::Joint(lower(6, |_, _| 1.0)));
    assert!(matches!(line(&singular), Err(RegressionError::NotDefinite { point: 1, .. })));
    let short = Points::new(six(), six()).with_y(squares(&[1.0; 5]));
    assert!(matches!(line(&short), Err(RegressionError::Length { expected: 6, found: 5, .. })));
    let lone = Points::new(six(), six()).with_x(squares(&[1.0; 6]));
    assert!(matches!(line(&lone), Err(RegressionError::OrdinatesUnknown)));
    let beyond = Points::new(six(), six())
        .with_x(squares(&[1.0; 6]))
        .with_y(squares(&[1.0; 6]))
        .with_cross(Cross::Each(vec![1.0; 6]));
    assert!(matches!(
        line(&beyond),
        Err(RegressionError::NotDefinite { coordinate: None, point: 0 })
    ));
    let exact = line(&Points::new(six(), six())).unwrap();
    assert!(!exact.has_scatter());
}

/// Every entry of a large matrix is computed in the same order as of a small one, and the line is that
/// of independent points where the matrix says so.
#[test]
fn large_matrices() {
    let n = 300;
    let x: Vec<f64> = (0..n).map(|i| i as f64 / 7.0).collect();
    let y: Vec<f64> = x.iter().map(|x| 1.0 + 0.5 * x + libm::sin(9.0 * x)).collect();
    let each = Points::new(x.clone(), y.clone()).with_y(Spread::Each(vec![0.25; n]));
    let joint =
        Points::new(x, y).with_y(Spread::Joint(lower(n, |i, j| if i == j { 0.25 } else { 0.0 })));
    let [each, joint] = [each, joint]
        .map(|p| Regression::of("l", &Curve::polynomial(1), &Arc::new(p), &[]).unwrap());
    for k in 0..2 {
        assert!((each.estimate(k) - joint.estimate(k)).abs() < 1e-12);
        assert!((each.standard_uncertainty(k) / joint.standard_uncertainty(k) - 1.0).abs() < 1e-12);
    }
}
