//! Moments and quantiles against closed forms and published examples.

use super::*;

fn close(value: f64, expected: f64) {
    assert!((value / expected - 1.0).abs() < 1e-13, "{value} is not {expected}");
}

/// JCGM 101, 6.4.3.4: a certificate states 10.0 V +- 0.1 V, the 0.1 rounded to one digit; then
/// u^2 = (0.2)^2/12 + (0.05)^2/9 and u = 0.060 V, where exact limits would give 0.058 V.
#[test]
fn inexact_limits_of_a_certificate() {
    let x = CurvilinearTrapezoid::new(9.9, 10.1, 0.05).unwrap();
    close(x.mean(), 10.0);
    close(x.standard_uncertainty(), (0.04f64 / 12.0 + 0.0025 / 9.0).sqrt());
    assert!((x.standard_uncertainty() - 0.060).abs() < 5e-4);
    let exact = Rectangular::between(9.9, 10.1).unwrap();
    assert!((exact.standard_uncertainty() - 0.058).abs() < 5e-4);
}

/// JCGM 101, expression (8): the density is ln((w + d)/|s|)/4d on the flanks. Its integral from a
/// quantile to the end, by the midpoint rule, is the tail that was asked for.
#[test]
fn flanks_of_the_curvilinear_trapezoid() {
    let (w, d) = (2.0, 0.7);
    let x = CurvilinearTrapezoid::new(-w, w, d).unwrap();
    for tail in [1e-9, 1e-4, 0.01, 0.05] {
        for (from, sign) in [(x.quantile(1.0 - tail), 1.0), (x.quantile(tail), -1.0)] {
            let from = sign * from;
            assert!(from > w - d && from < w + d);
            let n = 100_000;
            let step = (w + d - from) / f64::from(n);
            let density = |i: i32| {
                let s = from + (f64::from(i) + 0.5) * step;
                ((w + d) / s).ln() / (4.0 * d)
            };
            let mass = (0..n).map(density).sum::<f64>() * step;
            // 1e-7: the rounding of 1 - 1e-9 and of the quantile near the end
            assert!((mass / tail - 1.0).abs() < 1e-7, "{mass} not {tail}");
        }
    }
    close(x.quantile(1e-300), -w - d);
}

#[test]
fn bounded_shapes() {
    close(
        Trapezoidal::between(0.0, 10.0, 0.4).unwrap().standard_uncertainty(),
        (116f64 / 24.0).sqrt(),
    );
    close(Arcsine::new(2.0, 0.5).unwrap().standard_uncertainty(), 0.125f64.sqrt());
    close(Arcsine::new(2.0, 0.5).unwrap().quantile(0.75), 2.0 + 0.125f64.sqrt());
    let beta = Beta::between(2.0, 5.0, 10.0, 17.0).unwrap();
    close(beta.mean(), 12.0);
    close(beta.standard_uncertainty(), 1.25f64.sqrt());
    // beta(1/2, 1/2) is an arc sine, beta(1, 1) a rectangle
    let (u_shaped, arcsine) = (Beta::new(0.5, 0.5).unwrap(), Arcsine::between(0.0, 1.0).unwrap());
    close(u_shaped.standard_uncertainty(), arcsine.standard_uncertainty());
    for p in [0.01, 0.3, 0.5, 0.9] {
        close(u_shaped.quantile(p), arcsine.quantile(p));
        close(Beta::new(1.0, 1.0).unwrap().quantile(p), p);
    }
}

/// JCGM 101, 6.4.4 to 6.4.5: the trapezoid with no top is the triangle, with no flanks the
/// rectangle.
#[test]
fn limiting_trapezoids() {
    let triangle = Trapezoidal::new(1.0, 2.0, 0.0).unwrap();
    let rectangle = Trapezoidal::new(1.0, 2.0, 1.0).unwrap();
    for p in [1e-6, 0.2, 0.5, 0.77, 0.999] {
        close(triangle.quantile(p), Triangular::new(1.0, 2.0).unwrap().quantile(p));
        close(rectangle.quantile(p), Rectangular::new(1.0, 2.0).unwrap().quantile(p));
    }
}

#[test]
fn positive_shapes() {
    let exponential = Exponential::new(3.0).unwrap();
    close(exponential.standard_uncertainty(), 3.0);
    close(exponential.quantile(0.5), 3.0 * 2f64.ln());
    let gamma = Gamma::new(4.0, 2.0).unwrap();
    close(gamma.mean(), 2.0);
    close(gamma.standard_uncertainty(), 1.0);
    close(Gamma::new(1.0, 1.0 / 3.0).unwrap().quantile(0.2), exponential.quantile(0.2));
    let lognormal = Lognormal::new(2.0, 1.0).unwrap();
    close(lognormal.quantile(0.5), 2.0 / 1.25f64.sqrt());
    let log_uniform = LogUniform::new(0.001, 1000.0).unwrap();
    let range = 1e6f64.ln();
    close(log_uniform.mean(), 999.999 / range);
    let variance = (1e6 - 1e-6) / (2.0 * range) - (999.999 / range).powi(2);
    close(log_uniform.standard_uncertainty(), variance.sqrt());
    close(log_uniform.quantile(0.75), 10f64.powf(1.5));
    // between 1 and 8 the series of the variance is taken
    let variance = 63.0 / (2.0 * 8f64.ln()) - (7.0 / 8f64.ln()).powi(2);
    close(LogUniform::new(1.0, 8.0).unwrap().standard_uncertainty(), variance.sqrt());
    // limits that differ by a billionth make a rectangle
    let narrow = LogUniform::new(1.0, 1.0 + 2f64.powi(-30)).unwrap();
    assert!((narrow.standard_uncertainty() * 12f64.sqrt() * 2f64.powi(30) - 1.0).abs() < 1e-8);
}

/// JCGM 101, 6.4.11: after q counts the expectation and the variance are q + 1.
#[test]
fn counts() {
    let nine = PoissonCount::new(9).unwrap();
    assert_eq!((nine.mean(), nine.count()), (10.0, 9));
    close(nine.standard_uncertainty(), 10f64.sqrt());
    assert_eq!(
        PoissonCount::new(0).unwrap().quantile(0.5),
        Gamma::new(1.0, 1.0).unwrap().quantile(0.5)
    );
}

#[test]
fn samples_have_the_divisor_n() {
    let samples = Samples::new(vec![1e9 + 6.0, 1e9 + 1.0, 1e9 + 3.0, 1e9 + 2.0]).unwrap();
    assert_eq!(samples.mean(), 1e9 + 3.0);
    assert_eq!(samples.standard_uncertainty(), 3.5f64.sqrt());
    let quantiles = [0.01, 0.25, 0.26, 0.75, 0.99].map(|p| samples.quantile(p) - 1e9);
    assert_eq!(quantiles, [1.0, 1.0, 2.0, 3.0, 6.0]);
    assert_eq!(samples.values().len(), 4);
}

/// Every sample comes up, each as often as any other: with 1,024,000 draws of 21 samples the count
/// of each has a standard deviation of 215; six of them leave 4e-8 for all.
#[test]
fn samples_are_equally_likely() {
    let values = samples();
    let distribution: Distribution = Samples::new(values.clone()).unwrap().into();
    let drawn = draws(&distribution, 1000 * BLOCK);
    for &value in &values {
        let multiplicity = values.iter().filter(|&&v| v == value).count() as f64;
        let count = drawn.iter().filter(|&&v| v == value).count() as f64;
        let expected = multiplicity * drawn.len() as f64 / values.len() as f64;
        assert!((count - expected).abs() < 6.0 * expected.sqrt(), "{value}: {count}");
    }
}
