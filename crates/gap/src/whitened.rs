//! Whitened residuals of a hypothesis at points of its unknown quantities, each as a vector of its
//! own: for what is computed from them outside of the lanes of a column.

use super::likelihood::{Likelihood, Visitor};
use gumption_engine::number::{COLUMN, Column};

/// Residuals at one point, row by row, outputs fastest.
#[derive(Clone, Debug)]
pub(crate) struct WhitenedResiduals {
    /// The residuals, whitened by the blocks or by the estimated noise.
    pub(crate) values: Vec<f64>,
    /// Where the noise is estimated, the logarithms of its variances; else zeros.
    pub(crate) ln_variances: Vec<f64>,
}

/// The residuals at these points, whatever their number.
pub(crate) fn residuals(
    likelihood: &Likelihood<'_>,
    points: &[Vec<f64>],
) -> Vec<WhitenedResiduals> {
    let mut all = Vec::with_capacity(points.len());
    for points in points.chunks(COLUMN) {
        let mut scores = vec![Column::ZERO; likelihood.unknowns()];
        for (i, column) in scores.iter_mut().enumerate() {
            for (lane, out) in column.0.iter_mut().enumerate() {
                *out = points[lane.min(points.len() - 1)][i];
            }
        }
        let nothing = vec![0.0; likelihood.data.len()];
        let lane = WhitenedResiduals { values: nothing.clone(), ln_variances: nothing };
        let mut kept = Kept { lanes: vec![lane; points.len()] };
        likelihood.visit(&scores, points.len(), &mut kept);
        all.extend(kept.lanes);
    }
    all
}

/// Keeps the residuals of every lane.
struct Kept {
    lanes: Vec<WhitenedResiduals>,
}

impl Visitor for Kept {
    #[inline(always)]
    fn row(&mut self, row: usize, residuals: &[Column], ln_variances: &[Column]) {
        let first = row * residuals.len();
        for (output, (residual, ln)) in residuals.iter().zip(ln_variances).enumerate() {
            for (n, kept) in self.lanes.iter_mut().enumerate() {
                kept.values[first + output] = residual.0[n];
                kept.ln_variances[first + output] = ln.0[n];
            }
        }
    }
}
