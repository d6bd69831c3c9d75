//! Independent components of the trials (Hyvaerinen, IEEE Trans. Neural Netw. 10 (1999) 626).

use nalgebra::DMatrix;

use super::{TOGETHER, TrialPlace};
use crate::linalg::Eigen;
use crate::parallel;

/// Trials that the components are looked for with, and steps of the search; then all trials take part
/// in the last steps.
const FEW: usize = 1 << 14;
const STEPS: usize = 20;
const LAST_STEPS: usize = 3;

/// A rotation, row by row, after which the coordinates are as independent as a rotation makes them. The
/// trials have no correlation and variance 1. Where they are normal every rotation is as good.
pub(super) fn components(trials: &[TrialPlace], order: usize) -> Vec<f64> {
    let few = &trials[..trials.len().min(FEW)];
    let mut rotation = DMatrix::identity(order, order);
    for step in 0..STEPS + LAST_STEPS {
        let Some(next) = improved(&rotation, if step < STEPS { few } else { trials }) else {
            break;
        };
        rotation = next;
    }
    rotation.transpose().as_slice().to_vec()
}

/// A step of the search, with the contrast ln(1 + y^2)/2, which a long tail hardly moves; `None` where
/// it leads nowhere.
fn improved(rotation: &DMatrix<f64>, trials: &[TrialPlace]) -> Option<DMatrix<f64>> {
    let order = rotation.nrows();
    let rows: Vec<f64> = rotation.transpose().as_slice().to_vec();
    let some = |chunk: &[TrialPlace]| {
        let mut sums = vec![0.0; order * order];
        let mut slopes = vec![0.0; order];
        for place in chunk {
            let by_row = rows.chunks(order).zip(sums.chunks_mut(order)).zip(&mut slopes);
            for ((row, sums), sum_of_slopes) in by_row {
                let y: f64 = row.iter().zip(place).map(|(c, x)| c * x).sum();
                let inverse = 1.0 / (1.0 + y * y);
                let value = y * inverse;
                sums.iter_mut().zip(place).for_each(|(sum, x)| *sum += value * x);
                *sum_of_slopes += (1.0 - y * y) * inverse * inverse;
            }
        }
        (sums, slopes)
    };
    let mut found = parallel::map(trials.chunks(TOGETHER), some).into_iter();
    let first = found.next()?;
    let (sums, slopes) = found.fold(first, |(mut sums, mut slopes), (more, others)| {
        sums.iter_mut().zip(more).for_each(|(sum, x)| *sum += x);
        slopes.iter_mut().zip(others).for_each(|(sum, x)| *sum += x);
        (sums, slopes)
    });
    let next = DMatrix::from_fn(order, order, |i, j| {
        (sums[i * order + j] - slopes[i] * rotation[(i, j)]) / trials.len() as f64
    });
    // the nearest rotation
    let squares = &next * next.transpose();
    let eigen = Eigen::of(&squares);
    let least = eigen.values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = eigen.values.iter().copied().fold(0.0, f64::max);
    if least <= 1e-12 * most || least.is_nan() {
        return None;
    }
    let root = DMatrix::from_fn(order, order, |i, j| {
        let pairs = eigen.pairs();
        pairs.map(|(value, vector)| vector[i] * vector[j] / value.sqrt()).sum::<f64>()
    });
    Some(root * next)
}
