//! Polynomials as sums of Chebyshev polynomials over a range, and their coefficients as powers.

/// Chebyshev polynomials T_k(t) of t = (x - middle)/half, k below a count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Chebyshev {
    pub(super) count: usize,
    middle: f64,
    half: f64,
}

impl Chebyshev {
    /// The polynomials for a range of x.
    pub(super) fn over([least, most]: [f64; 2], count: usize) -> Self {
        let half = 0.5 * (most - least);
        let half = if half > 0.0 { half } else { 1.0 };
        Self { count, middle: 0.5 * least + 0.5 * most, half }
    }

    /// The value at x of the sum with these coefficients, its slope, and the value of each polynomial.
    #[inline(always)]
    pub(super) fn at(&self, x: f64, coefficients: &[f64], each: &mut [f64]) -> (f64, f64) {
        let t = (x - self.middle) / self.half;
        let (mut before, mut value) = (0.0, 1.0);
        let (mut slope_before, mut slope) = (0.0, 0.0);
        let (mut sum, mut slope_of_sum) = (0.0, 0.0);
        for (k, (each, coefficient)) in each.iter_mut().zip(coefficients).enumerate() {
            *each = value;
            sum += coefficient * value;
            slope_of_sum += coefficient * slope;
            let (twice, slope_of_twice) = match k {
                0 => (t, 1.0),
                _ => (2.0 * t, 2.0),
            };
            let next = twice * value - before;
            let next_slope = slope_of_twice * value + twice * slope - slope_before;
            (before, value) = (value, next);
            (slope_before, slope) = (slope, next_slope);
        }
        (sum, slope_of_sum / self.half)
    }

    /// The matrix that converts the coefficients to those of the powers of x - origin, row by row.
    pub(super) fn to_powers(self, origin: f64) -> Vec<f64> {
        let n = self.count;
        // t as a polynomial of x - origin
        let (shift, factor) = ((origin - self.middle) / self.half, 1.0 / self.half);
        let times_t = |of: &[f64]| -> Vec<f64> {
            let mut product = vec![0.0; n];
            for k in 0..n {
                let lower = if k > 0 { factor * of[k - 1] } else { 0.0 };
                product[k] = shift * of[k] + lower;
            }
            product
        };
        let mut before = vec![0.0; n];
        let mut current = vec![0.0; n];
        current[0] = 1.0;
        let mut matrix = vec![0.0; n * n];
        for k in 0..n {
            for (power, entry) in current.iter().enumerate() {
                matrix[power * n + k] = *entry;
            }
            let product = times_t(&current);
            let twice = if k == 0 { 1.0 } else { 2.0 };
            let next: Vec<f64> = product.iter().zip(&before).map(|(p, b)| twice * p - b).collect();
            before = std::mem::replace(&mut current, next);
        }
        matrix
    }
}
