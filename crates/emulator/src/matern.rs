//! The covariance function of Matérn with ν = 5/2 (Rasmussen and Williams 2006, equation 4.17), one length
//! for each dimension.

use gumption_engine::number::{CodePath, Kernel, elementary};

/// The correlation of the values at two points, and what its derivatives are made of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Correlation {
    /// (1 + r + r²/3) exp(-r), with r² five times the sum of the squared distances in lengths.
    pub(crate) value: f64,
    /// -2 times its derivative by r²: (1 + r) exp(-r)/3.
    pub(crate) falling: f64,
}

/// The squares of scaled distances, in whose place correlations come.
struct InPlace<'s>(&'s mut [f64]);

impl Kernel for InPlace<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for square in self.0 {
            *square = of_square(*square).value;
        }
    }
}

/// The correlations of a point with others; `inverse_squares` are 5/length² by dimension.
pub(crate) fn correlations(a: &[f64], others: &[Vec<f64>], inverse_squares: &[f64]) -> Vec<f64> {
    let square = |b: &Vec<f64>| squared_distance(a, b, inverse_squares);
    let mut values: Vec<f64> = others.iter().map(square).collect();
    CodePath::best().run(InPlace(&mut values));
    values
}

/// The correlation of two points; `inverse_squares` are 5/length² by dimension.
pub(crate) fn correlation(a: &[f64], b: &[f64], inverse_squares: &[f64]) -> Correlation {
    of_square(squared_distance(a, b, inverse_squares))
}

#[inline(always)]
fn squared_distance(a: &[f64], b: &[f64], inverse_squares: &[f64]) -> f64 {
    let mut square = 0.0;
    for ((a, b), inverse) in a.iter().zip(b).zip(inverse_squares) {
        square += (a - b) * (a - b) * inverse;
    }
    square
}

#[inline(always)]
fn of_square(square: f64) -> Correlation {
    let r = square.sqrt();
    let decay = elementary::exp(-r);
    Correlation { value: (1.0 + r + square / 3.0) * decay, falling: (1.0 + r) * decay / 3.0 }
}

/// 5/length² of logarithms of lengths.
pub(crate) fn inverse_squares(ln_lengths: &[f64]) -> Vec<f64> {
    ln_lengths.iter().map(|ln| 5.0 * elementary::exp(-2.0 * ln)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At r = 1: (1 + 1 + 1/3)/e; its slope along the distance d, r = √5 d/l, by differences over 1e-5,
    /// whose error is 1e-10.
    #[test]
    fn values_and_slopes() {
        let inverse = inverse_squares(&[0.3]);
        let distance = 1.0 / inverse[0].sqrt();
        let at = |d: f64| correlation(&[d], &[0.0], &inverse);
        assert!((at(distance).value - (7.0 / 3.0) / std::f64::consts::E).abs() < 1e-15);
        assert_eq!(at(0.0).value, 1.0);
        assert_eq!(correlations(&[0.4], &[vec![0.0]], &inverse), [at(0.4).value]);
        let slope = -at(distance).falling * inverse[0] * distance;
        let difference = (at(distance + 1e-5).value - at(distance - 1e-5).value) / 2e-5;
        assert!((slope - difference).abs() < 1e-9, "{slope} {difference}");
    }
}
