//! The parameters of one trial: a fit to points drawn about the stated ones.
//!
//! If a curve is linear in its parameters and its abscissae are exact, the parameters are linear in
//! the data, and their joint distribution is normal, or t: no trial needs a fit. Otherwise each
//! trial has its own fit.

use std::sync::Arc;

use super::points::{Noise, Root};
use super::result::Regression;
use crate::distribution::{Normal, Stream};
use crate::number::{COLUMN, Column};

/// A trial's fit ends when further steps would change nothing by more than this fraction of a standard
/// uncertainty, which no number of trials can resolve.
const TOLERANCE: f64 = 1e-7;

/// The parameters of a fit that trials draw together.
#[derive(Clone, Debug)]
pub(crate) struct Refit {
    /// Indices of the parameters among the quantities that are drawn.
    pub(crate) members: Vec<usize>,
    /// Which parameters they are.
    pub(crate) parameters: Vec<usize>,
    pub(crate) fit: Arc<Regression>,
    /// The root of the covariance matrix of all coordinates, if points are correlated.
    root: Option<Arc<Root>>,
}

impl Refit {
    pub(crate) fn new(members: Vec<usize>, parameters: Vec<usize>, fit: Arc<Regression>) -> Self {
        // it was already computed for the fit
        let root = fit.noise.joint_root().ok().flatten().map(Arc::new);
        Self { members, parameters, fit, root }
    }

    /// The same parameters, indexed among those at `varying` (in order) only; all of them are
    /// there.
    pub(crate) fn among(&self, varying: &[usize]) -> Self {
        let index = |member: &usize| varying.binary_search(member).unwrap_or(*member);
        Self { members: self.members.iter().map(index).collect(), ..self.clone() }
    }

    /// Draws the next column of every member; `register[q]` is its destination. A function of its
    /// own, compiled once.
    #[inline(never)]
    pub(crate) fn draw(
        &self,
        streams: &mut [Stream],
        registers: &mut [Column],
        register: &[usize],
    ) {
        let Some(stream) = self.members.first().and_then(|&first| streams.get_mut(first)) else {
            return;
        };
        let (fit, points) = (&*self.fit, &*self.fit.points);
        let n = points.len();
        let in_x = if points.is_exact_in_x() { 0 } else { n };
        let mut normals: Vec<Column> = vec![Column::ZERO; in_x + n];
        normals.iter_mut().for_each(|column| Normal::standard_draw(stream, column));
        let factors = self.factors(stream);
        let (mut solver, powers) = (fit.solver(), fit.powers());
        let near = solver.linearized(&fit.inner.estimates, points, TOLERANCE);
        let mut drawn = vec![0.0; in_x + n];
        let (mut x, mut y) = (points.x.clone(), points.y.clone());
        for (trial, factor) in factors.into_iter().enumerate() {
            for (drawn, column) in drawn.iter_mut().zip(&normals) {
                *drawn = column.0[trial];
            }
            self.scatter(&mut drawn);
            let (of_x, of_y) = drawn.split_at(in_x);
            for (i, y) in y.iter_mut().enumerate() {
                *y = points.y[i] + factor * of_y[i];
            }
            for (i, scatter) in of_x.iter().enumerate() {
                x[i] = points.x[i] + factor * scatter;
            }
            let fitted =
                near.as_ref().is_ok_and(|near| solver.fit_near(near, &x, &y, TOLERANCE).is_ok());
            let found = match fitted {
                true => fit.outer(&solver.parameters, &powers),
                false => vec![f64::NAN; fit.count()],
            };
            for (&member, &parameter) in self.members.iter().zip(&self.parameters) {
                registers[register[member]].0[trial] = found[parameter];
            }
        }
    }

    /// The factor of the stated uncertainties in each trial: 1 if they are known, else their common
    /// factor with its own uncertainty, s sqrt(nu/chi2).
    fn factors(&self, stream: &mut Stream) -> [f64; COLUMN] {
        let Some(factor) = self.fit.factor else { return [1.0; COLUMN] };
        if self.fit.factor_is_exact {
            return [factor; COLUMN];
        }
        let (mut squares, mut normals) = ([0.0; COLUMN], Column::ZERO);
        for _ in 0..self.fit.dof {
            Normal::standard_draw(stream, &mut normals);
            for (sum, z) in squares.iter_mut().zip(&normals.0) {
                *sum += z * z;
            }
        }
        squares.map(|sum| factor * (self.fit.dof as f64 / sum).sqrt())
    }

    /// Converts independent standard normal numbers to errors of all coordinates, x before y.
    fn scatter(&self, drawn: &mut [f64]) {
        let n = self.fit.points.len();
        match (&*self.fit.noise, &self.root) {
            (Noise::Ordinates(root), _) => root.multiply(drawn),
            (_, Some(root)) => root.multiply(drawn),
            (Noise::Single { x, y, xy }, None) => {
                let (of_x, of_y) = drawn.split_at_mut(if x.is_empty() { 0 } else { n });
                for i in 0..n {
                    let variance = y.get(i).copied().unwrap_or(1.0);
                    let Some(error) = of_x.get_mut(i) else {
                        of_y[i] *= variance.sqrt();
                        continue;
                    };
                    let z = *error;
                    let std = x[i].sqrt();
                    *error = std * z;
                    let cross = xy.get(i).copied().unwrap_or(0.0);
                    let common = if std > 0.0 { cross / std } else { 0.0 };
                    let own = (variance - common * common).max(0.0).sqrt();
                    of_y[i] = common * z + own * of_y[i];
                }
            }
            (Noise::Full { .. }, None) => drawn.fill(f64::NAN),
        }
    }
}
