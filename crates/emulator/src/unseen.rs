//! What an emulator did not know: its errors on runs that it had not seen.

use crate::singular::SingularVectors;
use gumption_engine::linalg::dot;

/// Directions of errors are kept until what is left has this norm over all rows, in u.
const LEFT: f64 = 1e-3;

/// The errors of an emulator on runs before it learnt from them.
#[derive(Clone, Debug, PartialEq)]
pub struct UnseenError {
    /// The norm over all rows of the error of each run, in u.
    pub norms: Vec<f64>,
    /// A factor of the covariance that the error leaves, along its own directions: with V the vectors and s
    /// the sizes, V diag(s²) V' is the mean square of the errors, in u².
    pub factor: SingularVectors,
}

impl UnseenError {
    /// Of the errors of all rows of some runs, at least one.
    pub(crate) fn of(errors: &[Vec<f64>]) -> Self {
        let norms = errors.iter().map(|error| dot(error, error).sqrt()).collect();
        Self { norms, factor: SingularVectors::of(errors, LEFT) }
    }

    /// The root mean square of the norms: what the covariance that the error leaves has in all rows together.
    pub fn norm(&self) -> f64 {
        (dot(&self.norms, &self.norms) / self.norms.len().max(1) as f64).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two errors along two rows: mean squares 9/2 and 16/2.
    #[test]
    fn the_factor_is_that_of_the_mean_square() {
        let unseen = UnseenError::of(&[vec![3.0, 0.0, 0.0], vec![0.0, 0.0, -4.0]]);
        assert_eq!((&unseen.norms[..], unseen.norm()), (&[3.0, 4.0][..], 12.5_f64.sqrt()));
        let squares: Vec<f64> = unseen.factor.sizes.iter().map(|size| size * size).collect();
        assert!((squares[0] - 8.0).abs() < 1e-14 && (squares[1] - 4.5).abs() < 1e-14);
        assert_eq!(unseen.factor.vectors[0][2].abs(), 1.0);
    }
}
