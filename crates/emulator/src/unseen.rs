//! What an emulator did not know: its errors on runs that it had not seen.

use crate::scatter::Scatter;
use crate::singular::SingularVectors;
use gumption_engine::linalg::{add_multiple, dot};

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

    /// Of a simulator whose runs scatter, for what is not known of its mean: of the errors of all rows of some
    /// runs, at least one, along directions in which the mean may be wrong. From each norm is taken what the
    /// scatter has there. The covariance is what the scatter leaves in the mean at the runs, columns of factors
    /// `scattered` of all of them, and what of the errors is beyond what the scatter alone shows along any
    /// direction.
    pub(crate) fn of_mean(
        errors: &[Vec<f64>],
        directions: &SingularVectors,
        scattered: Vec<Vec<f64>>,
        scatter: &Scatter,
    ) -> Self {
        let runs = errors.len() as f64;
        let own =
            |of: &[f64]| -> f64 { directions.vectors.iter().map(|v| square(dot(v, of))).sum() };
        let expected: f64 = directions.vectors.iter().map(|vector| scatter.along(vector)).sum();
        let norms = errors.iter().map(|error| (own(error) - expected).max(0.0).sqrt()).collect();
        let within = |error: &Vec<f64>| {
            let mut sum = vec![0.0; error.len()];
            for (along, vector) in directions.coefficients(error).iter().zip(&directions.vectors) {
                add_multiple(&mut sum, *along, vector);
            }
            sum
        };
        let within: Vec<Vec<f64>> = errors.iter().map(within).collect();
        let edge = square(1.0 + (directions.vectors.len() as f64 / runs).sqrt());
        let found = SingularVectors::of(&within, LEFT);
        let beyond = found.vectors.iter().zip(&found.sizes).filter_map(|(vector, size)| {
            let beyond = size * size - edge * scatter.along(vector);
            (beyond > 0.0).then(|| vector.iter().map(|v| beyond.sqrt() * v).collect())
        });
        let mut columns: Vec<Vec<f64>> = beyond.collect();
        let share = 1.0 / runs.sqrt();
        columns.extend(scattered.into_iter().map(|of| of.iter().map(|v| share * v).collect()));
        // the mean square over the columns times their number is their sum
        let count = (columns.len() as f64).sqrt();
        columns.iter_mut().flatten().for_each(|entry| *entry *= count);
        Self { norms, factor: SingularVectors::of(&columns, LEFT) }
    }

    /// The root mean square of the norms: what the covariance that the error leaves has in all rows together.
    pub fn norm(&self) -> f64 {
        (dot(&self.norms, &self.norms) / self.norms.len().max(1) as f64).sqrt()
    }
}

fn square(of: f64) -> f64 {
    of * of
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
