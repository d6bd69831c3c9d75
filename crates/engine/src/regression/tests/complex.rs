//! Complex points: parameters and covariances against a fit by hand, and trials with a known truth.

use std::sync::Arc;

use super::lower;
use crate::distribution::{Normal, StreamKey};
use crate::linalg::packed;
use crate::model::Recorder;
use crate::model::typed::Complex;
use crate::number::{COLUMN, Column, Number};
use crate::regression::{
    ComplexForm, ComplexSpread, Curve, Points, Refit, Regression, RegressionError, Spread,
};

/// The seismic response S0 exp(-i w tau)/(1 - (x/f0)^2 + 2 i d x/f0) of x, S0, f0, d and tau.
fn response<T: Number>([x, s0, f0, d, tau]: [T; 5]) -> Complex<T> {
    let ratio = x / f0;
    let below = Complex { re: -ratio.square() + 1.0, im: d * ratio * 2.0 };
    Complex::polar(s0, -(x * tau * std::f64::consts::TAU)) / below
}

fn curve() -> Curve {
    let recorder = Recorder::default();
    let Complex { re, im } = response(std::array::from_fn(|index| recorder.variable(index)));
    Curve::Program(recorder.program(5, &[re, im]))
}

/// The truth and the frequencies of the tests, in kHz and ms.
const TRUTH: [f64; 4] = [0.2275, 51.4, 0.083, 2e-4];

fn frequencies() -> Vec<f64> {
    (0..30).map(|k| 0.5 * libm::pow(1.15, f64::from(k))).collect()
}

fn at(x: f64, [s0, f0, d, tau]: [f64; 4]) -> Complex<f64> {
    response([x, s0, f0, d, tau])
}

/// Standard normal numbers.
fn normals(seed: u64, count: usize) -> Vec<f64> {
    let mut stream = StreamKey::new(seed, "z").block(0);
    let mut all = Vec::new();
    while all.len() < count {
        let mut column = Column::ZERO;
        Normal::standard_draw(&mut stream, &mut column);
        all.extend_from_slice(&column.0[..COLUMN.min(count - all.len())]);
    }
    all
}

/// Relative u of the modulus, u of the phase in radians, and their correlation coefficient.
const U: [f64; 3] = [0.003, 0.004, 0.6];

/// Modulus and phase of every frequency with these errors.
fn measured(seed: u64) -> [Vec<f64>; 2] {
    let z = normals(seed, 60);
    let [u, v, r] = U;
    let pair = |(k, x): (usize, f64)| {
        let h = at(x, TRUTH);
        let (e, g) = (z[2 * k], r * z[2 * k] + (1.0 - r * r).sqrt() * z[2 * k + 1]);
        (h.modulus() * (1.0 + u * e), h.phase() + v * g)
    };
    let (modulus, phase) = frequencies().into_iter().enumerate().map(pair).unzip();
    [modulus, phase]
}

fn polar([modulus, phase]: &[Vec<f64>; 2]) -> Points {
    let [u, v, r] = U;
    let each = [modulus.iter().map(|m| u * m).collect(), vec![v; 30]];
    let spread = ComplexSpread::Each(each, vec![r; 30]);
    Points::complex(&frequencies(), ComplexForm::Polar, [modulus, phase], spread).unwrap()
}

fn fit(points: Points) -> Regression {
    Regression::of("h", &curve(), &Arc::new(points), &[0.2, 45.0, 0.05, 0.0]).unwrap()
}

/// The same by hand: Gauss-Newton steps with normal equations and difference quotients, in real and
/// imaginary parts with their own covariance matrix of each point, [[s, t], [t, w]]. Derivatives of
/// second order are good to 1e-9 of the parameters, and so are the parameters; the covariance to 1e-6.
fn by_hand(measured: &[Vec<f64>; 2]) -> ([f64; 4], [[f64; 4]; 4], f64) {
    let [u, v, r] = U;
    let mut q = [0.22, 50.0, 0.07, 0.0];
    let steps = [1e-6, 1e-4, 1e-6, 1e-7];
    let mut last = ([[0.0; 4]; 4], 0.0);
    for _ in 0..40 {
        let (mut a, mut b, mut chi2) = ([[0.0; 4]; 4], [0.0; 4], 0.0);
        for (k, x) in frequencies().into_iter().enumerate() {
            let (m, phi) = (measured[0][k], measured[1][k]);
            let (c, s) = (libm::cos(phi), libm::sin(phi));
            // the covariance matrix of both parts: J V J', J = [[c, -m s], [s, m c]]
            let [vm, vp, cross] = [(u * m).powi(2), v * v, r * u * m * v];
            let rr = c * c * vm - 2.0 * c * m * s * cross + (m * s).powi(2) * vp;
            let ii = s * s * vm + 2.0 * s * m * c * cross + (m * c).powi(2) * vp;
            let ri = c * s * vm + m * (c * c - s * s) * cross - m * m * c * s * vp;
            let det = rr * ii - ri * ri;
            let weighted = |p: [f64; 2], o: [f64; 2]| {
                (ii * p[0] * o[0] - ri * (p[0] * o[1] + p[1] * o[0]) + rr * p[1] * o[1]) / det
            };
            let h = at(x, q);
            let e = [m * c - h.re, m * s - h.im];
            let slopes: [[f64; 2]; 4] = std::array::from_fn(|p| {
                let [mut above, mut below] = [q, q];
                (above[p], below[p]) = (q[p] + steps[p], q[p] - steps[p]);
                let (above, below) = (at(x, above), at(x, below));
                [(above.re - below.re), (above.im - below.im)].map(|d| d / (2.0 * steps[p]))
            });
            chi2 += weighted(e, e);
            for i in 0..4 {
                b[i] += weighted(slopes[i], e);
                (0..4).for_each(|j| a[i][j] += weighted(slopes[i], slopes[j]));
            }
        }
        let inverse = inverse(a);
        for i in 0..4 {
            q[i] += (0..4).map(|j| inverse[i][j] * b[j]).sum::<f64>();
        }
        last = (inverse, chi2);
    }
    (q, last.0, last.1)
}

/// Gauss-Jordan elimination.
fn inverse(mut a: [[f64; 4]; 4]) -> [[f64; 4]; 4] {
    let mut inverse: [[f64; 4]; 4] =
        std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    for k in 0..4 {
        let pivot = a[k][k];
        for j in 0..4 {
            (a[k][j], inverse[k][j]) = (a[k][j] / pivot, inverse[k][j] / pivot);
        }
        for i in (0..4).filter(|i| *i != k) {
            let factor = a[i][k];
            for j in 0..4 {
                a[i][j] -= factor * a[k][j];
                inverse[i][j] -= factor * inverse[k][j];
            }
        }
    }
    inverse
}

#[test]
fn parameters_and_covariances_are_those_by_hand() {
    let measured = measured(1);
    let (q, covariance, chi2) = by_hand(&measured);
    let found = fit(polar(&measured));
    assert_eq!((found.dof, found.is_complex(), found.is_linear()), (56, true, false));
    assert!((found.chi2 / chi2 - 1.0).abs() < 1e-6, "{} {chi2}", found.chi2);
    for i in 0..4 {
        let u = covariance[i][i].sqrt();
        assert!((found.estimate(i) - q[i]).abs() < 1e-5 * u, "{i} {} {}", found.estimate(i), q[i]);
        for j in 0..4 {
            let scale = (covariance[i][i] * covariance[j][j]).sqrt();
            assert!((found.covariance(i, j) - covariance[i][j]).abs() < 1e-6 * scale, "{i} {j}");
        }
    }
    // the same as real and imaginary parts, with the full matrix of all of them
    let n = 30;
    let [u, v, r] = U;
    let (mut re, mut im) = (Vec::new(), Vec::new());
    let jacobians: Vec<[[f64; 2]; 2]> = (0..n)
        .map(|k| {
            let (m, phi) = (measured[0][k], measured[1][k]);
            let (c, s) = (libm::cos(phi), libm::sin(phi));
            re.push(m * c);
            im.push(m * s);
            [[c, -m * s], [s, m * c]]
        })
        .collect();
    let entry = |i: usize, j: usize| {
        let (p, o) = (i % n, j % n);
        let m = measured[0][p];
        let known = [[(u * m).powi(2), r * u * m * v], [r * u * m * v, v * v]];
        let [a, b] = [jacobians[p][i / n], jacobians[o][j / n]];
        let pairs = (0..4).map(|k| a[k / 2] * known[k / 2][k % 2] * b[k % 2]);
        if p == o { pairs.sum() } else { 0.0 }
    };
    let spread = ComplexSpread::Joint(lower(2 * n, entry));
    let form = ComplexForm::Cartesian;
    let joint = fit(Points::complex(&frequencies(), form, [&re, &im], spread).unwrap());
    // and with the full matrix of moduli and phases
    let entry = |i: usize, j: usize| {
        let m = measured[0][i % n];
        let cross = r * u * m * v;
        let of = [[(u * m).powi(2), cross], [cross, v * v]][i / n][j / n];
        if i % n == j % n { of } else { 0.0 }
    };
    let [modulus, phase] = &measured;
    let spread = ComplexSpread::Joint(lower(2 * n, entry));
    let points = Points::complex(&frequencies(), ComplexForm::Polar, [modulus, phase], spread);
    for other in [joint, fit(points.unwrap())] {
        assert!((other.chi2 / found.chi2 - 1.0).abs() < 1e-9);
        for k in 0..4 {
            let u = found.standard_uncertainty(k);
            assert!((other.estimate(k) - found.estimate(k)).abs() < 1e-7 * u, "{k}");
            assert!((other.standard_uncertainty(k) / u - 1.0).abs() < 1e-9, "{k}");
        }
        // ordinates and their covariances come back from the rows
        for (a, b) in other.complex_residuals().iter().zip(found.complex_residuals()) {
            let (a_u, b_u) = (a.covariance.unwrap(), b.covariance.unwrap());
            for part in 0..2 {
                assert!((a.value[part] - b.value[part]).abs() < 1e-14);
                assert!((a.relative[part] - b.relative[part]).abs() < 1e-10);
                assert!((a_u[part][0] - b_u[part][0]).abs() < 1e-8 * a_u[0][0]);
                assert!((a_u[part][1] - b_u[part][1]).abs() < 1e-8 * a_u[0][0]);
            }
        }
    }
}

/// Residuals of the truth are the errors that were drawn, to second order of 0.004 times four standard
/// deviations; derivatives are difference quotients; u of modulus and phase at 0 Hz are those of S0 and 0.
#[test]
fn what_a_complex_fit_gives() {
    let found = fit(polar(&measured(2)));
    let [u, v, r] = U;
    for residual in found.complex_residuals() {
        let h = at(residual.x, found.estimates.clone().try_into().unwrap());
        let ratio = Complex { re: residual.value[0], im: residual.value[1] } / h;
        assert!((ratio.modulus() - 1.0 - residual.relative[0]).abs() < 2e-4);
        assert!((ratio.phase() - residual.relative[1]).abs() < 4e-4);
        let [[rr, ri], [ir, ii]] = residual.covariance.unwrap();
        assert!((rr.sqrt() / u - 1.0).abs() < 0.05 && (ii.sqrt() / v - 1.0).abs() < 0.05);
        assert!((ri / ir - 1.0).abs() < 1e-9 && (ri / (u * v) - r).abs() < 0.05, "{ri}");
    }
    let ([re, im], each) = found.complex_gradient(9.0);
    let moved = |k: usize, by: f64| {
        let mut parameters = found.estimates.clone();
        parameters[k] += by;
        found.complex_value(9.0, &parameters)
    };
    assert_eq!([re, im], moved(0, 0.0));
    for (k, derivative) in each.iter().enumerate() {
        let step = 1e-5 * found.estimate(k).abs();
        let (above, below) = (moved(k, step), moved(k, -step));
        for part in 0..2 {
            let quotient = (above[part] - below[part]) / (2.0 * step);
            let size = derivative[0].abs() + derivative[1].abs();
            assert!((quotient - derivative[part]).abs() < 1e-6 * size, "{k} {part}");
        }
    }
    let still = found.polar_at(0.0);
    assert!((still.modulus_uncertainty / found.standard_uncertainty(0) - 1.0).abs() < 1e-12);
    assert_eq!((still.modulus, still.phase), (found.estimate(0), 0.0));
    assert!(still.phase_uncertainty < 1e-15);
    assert!(found.at(1.0).is_nan() && found.residuals().iter().all(|r| r.is_nan()));
    assert_eq!(found.covariance_matrix()[1], found.covariance(0, 1));
}

/// 400 sets of points: chi-squared has the mean 56, and the squared distance of the parameters from the
/// truth in their covariance matrix the mean 4, with standard deviations of sqrt(2 nu/400); u times 2 holds
/// 95.45 % of each parameter, 1.04 % the standard deviation of the share. Limits of five of them: a false
/// failure in 3e-6 (six limits of 6e-7 each).
#[test]
fn intervals_hold_the_truth() {
    let (mut chi2, mut distance, mut held) = (0.0, 0.0, [0_u32; 4]);
    for seed in 0..400 {
        let found = fit(polar(&measured(1000 + seed)));
        chi2 += found.chi2 / 400.0;
        let errors: Vec<f64> = (0..4).map(|k| found.estimate(k) - TRUTH[k]).collect();
        let mut root = lower(4, |i, j| found.covariance(i, j));
        packed::cholesky(&mut root, 0.0).unwrap();
        let mut white = errors.clone();
        packed::solve(&root, &mut white);
        distance += white.iter().map(|e| e * e).sum::<f64>() / 400.0;
        for k in 0..4 {
            held[k] += u32::from(errors[k].abs() < 2.0 * found.standard_uncertainty(k));
        }
    }
    assert!((chi2 - 56.0).abs() < 5.0 * (112.0_f64 / 400.0).sqrt(), "{chi2}");
    assert!((distance - 4.0).abs() < 5.0 * (8.0_f64 / 400.0).sqrt(), "{distance}");
    for held in held {
        assert!((f64::from(held) / 400.0 - 0.9545).abs() < 5.0 * 0.0104, "{held}");
    }
}

/// Trials of a fit of their own each have the standard uncertainties of the law of propagation, the curve
/// being nearly linear within these: in 2048 trials to 1.6 %, five of which are allowed, and means to five
/// of u/sqrt(2048) with 0.02 u for the bending.
#[test]
fn trials_scatter_as_the_covariance_says() {
    let fit = Arc::new(fit(polar(&measured(3))));
    let refit = Refit::new((0..4).collect(), (0..4).collect(), Arc::clone(&fit));
    let mut streams = [0, 1, 2, 3].map(|k| StreamKey::new(1, &format!("h.{k}")).block(0));
    let (mut registers, mut all) = (vec![Column::ZERO; 4], vec![Vec::new(); 4]);
    for _ in 0..16 {
        refit.draw(&mut streams, &mut registers, &[0, 1, 2, 3]);
        all.iter_mut().zip(&registers).for_each(|(all, column)| all.extend_from_slice(&column.0));
    }
    for (k, trials) in all.iter().enumerate() {
        let (n, u) = (trials.len() as f64, fit.standard_uncertainty(k));
        let mean = trials.iter().sum::<f64>() / n;
        let square = trials.iter().map(|t| (t - mean).powi(2)).sum::<f64>() / n;
        assert!((mean - fit.estimate(k)).abs() < (5.0 / n.sqrt() + 0.02) * u, "{k} {mean}");
        assert!((square.sqrt() / u - 1.0).abs() < 0.08, "{k} {}", square.sqrt() / u);
    }
}

/// Without stated uncertainties the residuals give the common one of both parts, as of a sum in closed
/// form: y = a + i b of five points has the means, and s^2 of all ten residuals with 8 degrees of freedom.
#[test]
fn unknown_uncertainties_come_from_both_parts() {
    let recorder = Recorder::default();
    let constant = recorder.program(3, &[recorder.variable(1), recorder.variable(2)]);
    let curve = Curve::Program(constant);
    let (re, im) = ([1.0, 2.0, 4.0, 3.0, 5.0], [-1.0, 0.5, 0.0, 2.0, -1.5]);
    let x = [0.0, 1.0, 2.0, 3.0, 4.0];
    let points = Points::complex(&x, ComplexForm::Cartesian, [&re, &im], ComplexSpread::None);
    let found = Regression::of("c", &curve, &Arc::new(points.unwrap()), &[0.0, 0.0]).unwrap();
    assert!((found.estimate(0) - 3.0).abs() < 1e-14 && found.estimate(1).abs() < 1e-14);
    let squares = 10.0 + 7.5;
    assert!((found.factor.unwrap() - (squares / 8.0_f64).sqrt()).abs() < 1e-14);
    assert!((found.standard_uncertainty(1) - (squares / 40.0_f64).sqrt()).abs() < 1e-14);
    assert_eq!(found.degrees_of_freedom(), 8.0);
    assert!(found.complex_residuals().iter().all(|residual| residual.covariance.is_none()));
}

#[test]
fn complex_points_that_cannot_be_fitted() {
    let x = [1.0, 2.0, 3.0];
    let of = |u: [f64; 3], r: f64, modulus: f64| {
        let moduli = [0.2, modulus, 0.2];
        let values = [moduli.as_slice(), &[0.0; 3]];
        let spread = ComplexSpread::Each([u.to_vec(), vec![0.1; 3]], vec![0.0, r, 0.0]);
        let points = Points::complex(&x, ComplexForm::Polar, values, spread)?;
        Regression::of("h", &curve(), &Arc::new(points), &[0.2, 45.0, 0.05, 0.0])
    };
    assert!(matches!(of([0.1; 3], 1.0, 0.2), Err(RegressionError::NotDefinite { point: 1, .. })));
    let zero = of([0.1, 0.0, 0.1], 0.0, 0.2);
    assert!(matches!(zero, Err(RegressionError::NoVariance { point: 1, .. })));
    // without a modulus a phase means nothing
    let nothing = of([0.1; 3], 0.0, 0.0);
    assert!(matches!(nothing, Err(RegressionError::NoVariance { point: 1, .. })), "{nothing:?}");
    let short = Points::complex(&x, ComplexForm::Polar, [&[1.0; 3], &[0.0]], ComplexSpread::None);
    assert!(matches!(short, Err(RegressionError::Length { expected: 3, found: 1, .. })));
    let one = Points::complex(&[1.0], ComplexForm::Polar, [&[1.0], &[0.0]], ComplexSpread::None);
    let one = Arc::new(one.unwrap());
    assert!(matches!(
        Regression::of("h", &curve(), &one, &[]),
        Err(RegressionError::TooFewPoints { points: 1, parameters: 4, needed: 3, .. })
    ));
    let real = Regression::of("l", &Curve::polynomial(1), &one, &[]);
    assert!(matches!(real, Err(RegressionError::Complexity { curve: false })));
    let points = Points::new(vec![1.0; 9], vec![1.0; 9]).with_y(Spread::Each(vec![1.0; 9]));
    let complex = Regression::of("h", &curve(), &Arc::new(points), &[]);
    assert!(matches!(complex, Err(RegressionError::Complexity { curve: true })));
}
