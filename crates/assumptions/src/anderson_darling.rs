//! The Anderson-Darling test of readings against a distribution without unknown parameters.

/// The statistic A^2 of probabilities in ascending order (T. W. Anderson, D. A. Darling, JASA 49
/// (1954) 765); infinite where one is 0 or 1.
pub(super) fn statistic(probabilities: &[[f64; 2]]) -> f64 {
    let n = probabilities.len() as f64;
    let pairs = probabilities.iter().zip(probabilities.iter().rev());
    let sum: f64 = pairs
        .enumerate()
        // F of the i-th, 1 - F of the i-th from the end
        .map(|(i, ([below, _], [_, above]))| {
            (2.0 * i as f64 + 1.0) * (libm::log(*below) + libm::log(*above))
        })
        .sum();
    -n - sum / n
}

/// The probability that n readings from the distribution give at least this statistic: the
/// approximation of G. and J. Marsaglia, Journal of Statistical Software 9 (2004) 2, accurate to
/// about 2e-5.
pub(super) fn p_value(statistic: f64, n: usize) -> f64 {
    if !statistic.is_finite() {
        return 0.0;
    }
    let limit = limiting(statistic);
    (1.0 - (limit + correction(limit, n as f64))).clamp(0.0, 1.0)
}

/// The polynomial of ascending coefficients.
fn polynomial(x: f64, coefficients: &[f64]) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// The distribution function of the statistic for infinitely many readings.
fn limiting(z: f64) -> f64 {
    if z <= 0.0 {
        0.0
    } else if z < 2.0 {
        let c = [2.000_12, 0.247_105, -0.064_982_1, 0.034_796_2, -0.011_672, 0.001_686_91];
        libm::exp(-1.233_714_1 / z) / z.sqrt() * polynomial(z, &c)
    } else {
        let c = [1.0776, -2.306_95, 0.434_24, -0.082_433, 0.008_056, -0.000_314_6];
        libm::exp(-libm::exp(polynomial(z, &c)))
    }
}

/// The correction of the limiting distribution for n readings.
fn correction(x: f64, n: f64) -> f64 {
    let kink = 0.012_65 + 0.1757 / n;
    if x > 0.8 {
        let c = [-130.2137, 745.2337, -1705.091, 1950.646, -1116.360, 255.7844];
        polynomial(x, &c) / n
    } else if x < kink {
        let v = x / kink;
        v.sqrt() * (1.0 - v) * (49.0 * v - 102.0) * (0.0037 / (n * n) + 0.000_78 / n + 0.000_06) / n
    } else {
        let v = (x - kink) / (0.8 - kink);
        let c = [-0.000_226_33, 6.540_34, -14.6538, 14.458, -8.259, 1.918_64];
        polynomial(v, &c) * (0.042_13 + 0.013_65 / n) / n
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The series of Anderson and Darling (1954) for infinitely many readings: with t = (4j + 1)^2
    /// pi^2 / 8z, the sum over j of (-1)^j (1/2)(3/2)...(j - 1/2)/j! (4j + 1) exp(-t) times the
    /// integral over w from 0 to infinity of exp(z/(8 (w^2 + 1)) - t w^2), times sqrt(2 pi)/z.
    fn series(z: f64) -> f64 {
        let mut sum = 0.0;
        let mut factor = 1.0;
        for j in 0..6 {
            let j = f64::from(j);
            let t = (4.0 * j + 1.0).powi(2) * std::f64::consts::PI.powi(2) / (8.0 * z);
            let f = |w: f64| libm::exp(z / (8.0 * (w * w + 1.0)) - t * w * w);
            // Simpson's rule to 40 standard deviations
            let (n, end) = (4000, 10.0 / t.sqrt());
            let h = end / f64::from(n);
            let inner = (1..n).map(|i| if i % 2 == 1 { 4.0 } else { 2.0 } * f(h * f64::from(i)));
            let integral = h / 3.0 * (f(0.0) + inner.sum::<f64>() + f(end));
            sum += factor * (4.0 * j + 1.0) * libm::exp(-t) * integral;
            factor *= -(j + 0.5) / (j + 1.0);
        }
        (2.0 * std::f64::consts::PI).sqrt() / z * sum
    }

    /// The approximation deviates by up to 2e-5, far less than the third decimal of a printed
    /// p-value; the 5 % point is 2.492 (Stephens, JASA 69 (1974) 730, Table 1), printed to three
    /// decimals.
    #[test]
    fn the_limiting_distribution() {
        for z in [0.3, 0.5, 1.0, 1.5, 1.99, 2.01, 2.492, 3.0, 4.0, 6.0] {
            assert!((limiting(z) - series(z)).abs() < 3e-5, "{z} {} {}", limiting(z), series(z));
        }
        assert!((limiting(2.492) - 0.95).abs() < 5e-5);
    }

    /// One reading: A^2 = -1 - ln(F (1 - F)), so A^2 >= z if F (1 - F) <= exp(-1 - z), with
    /// probability 1 - sqrt(1 - 4 exp(-1 - z)). The approximation is for larger n, but close.
    #[test]
    fn few_readings() {
        let statistic = statistic(&[[0.1, 0.9]]);
        assert!((statistic - (-1.0 - (0.09f64).ln())).abs() < 1e-14);
        let exact = 1.0 - (1.0 - 4.0 * (-1.0 - statistic).exp()).sqrt();
        assert!((p_value(statistic, 1) - exact).abs() < 0.01, "{exact} {}", p_value(statistic, 1));
    }
}
