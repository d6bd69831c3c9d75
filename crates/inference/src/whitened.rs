//! Whitened residuals of a hypothesis at points of its unknown quantities, each as a vector of its
//! own: for what is computed from them outside of the lanes of a column.

use super::likelihood::{Likelihood, Visitor};
use gumption_engine::number::{COLUMN, CodePath, Column};

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
        let scores = likelihood.columns(points);
        let mut kept = KeptResiduals::new(likelihood);
        likelihood.visit(&scores, points.len(), &mut kept);
        all.extend(kept.by_lane(points.len()));
    }
    all
}

/// Keeps the residuals of a column of points, value by value.
struct KeptResiduals {
    residuals: Vec<Column>,
    /// Where the noise is estimated.
    ln_variances: Vec<Column>,
    fitted: bool,
}

impl KeptResiduals {
    fn new(likelihood: &Likelihood<'_>) -> Self {
        let (fitted, values) = (likelihood.covariance.fitted, likelihood.data.len());
        let zeros = |count: usize| vec![Column::ZERO; count];
        Self {
            residuals: zeros(values),
            ln_variances: zeros(if fitted { values } else { 0 }),
            fitted,
        }
    }

    /// Each of so many lanes as vectors of its own.
    fn by_lane(&self, lanes: usize) -> Vec<WhitenedResiduals> {
        let values = by_lane(&self.residuals, lanes);
        if self.fitted {
            let both = values.into_iter().zip(by_lane(&self.ln_variances, lanes));
            return both
                .map(|(values, ln_variances)| WhitenedResiduals { values, ln_variances })
                .collect();
        }
        let of = |values: Vec<f64>| {
            let ln_variances = vec![0.0; values.len()];
            WhitenedResiduals { values, ln_variances }
        };
        values.into_iter().map(of).collect()
    }
}

/// Lanes that are written side by side: a cache line of each column.
const LINE: usize = 8;

/// The first lanes of columns, each as a vector.
fn by_lane(columns: &[Column], lanes: usize) -> Vec<Vec<f64>> {
    let mut all = Vec::with_capacity(lanes);
    for first in (0..lanes).step_by(LINE) {
        let mut vectors: [Vec<f64>; LINE] = std::array::from_fn(|_| vec![0.0; columns.len()]);
        for (value, column) in columns.iter().enumerate() {
            let line = &column.0[first..first + LINE];
            for (vector, lane) in vectors.iter_mut().zip(line) {
                vector[value] = *lane;
            }
        }
        all.extend(vectors.into_iter().take(lanes - first));
    }
    all
}

impl Visitor for KeptResiduals {
    fn row(&mut self, _: CodePath, row: usize, residuals: &[Column], ln_variances: &[Column]) {
        let own = row * residuals.len()..(row + 1) * residuals.len();
        self.residuals[own.clone()].clone_from_slice(residuals);
        if self.fitted {
            self.ln_variances[own].clone_from_slice(ln_variances);
        }
    }
}
