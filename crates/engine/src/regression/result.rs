//! A fitted calibration function.

use crate::number::ascending;
use std::sync::Arc;

use super::chebyshev::Chebyshev;
use super::curve::{Curve, Differentiated};
use super::degree::DegreeChoice;
use super::error::RegressionError;
use super::least_squares;
use super::points::{Noise, Points};
use super::solver::{Basis, Solver};
use crate::special;

/// Iteration ends when the change of the parameters is below this number of standard uncertainties.
const TOLERANCE: f64 = 1e-11;

/// Residuals below this fraction of the ordinates are rounding.
const NO_SCATTER: f64 = 1e-14;

/// A curve fitted to points.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Regression {
    /// Its name.
    pub name: String,
    /// Its form.
    pub curve: Curve,
    /// The points.
    pub points: Arc<Points>,
    pub(super) noise: Arc<Noise>,
    /// The parameters.
    pub estimates: Vec<f64>,
    /// Their covariance matrix, row by row.
    pub(super) covariance: Vec<f64>,
    /// The same in the basis of the fit.
    pub(super) inner: Inner,
    /// The weighted sum of squares of the residuals; with unit weights if no uncertainties are
    /// stated.
    pub chi2: f64,
    /// Degrees of freedom: number of points, of complex ones twice their number, minus number of
    /// parameters.
    pub dof: usize,
    /// The common factor of the stated standard uncertainties from the residuals, if it is used;
    /// the standard deviation of the residuals if none are stated.
    pub factor: Option<f64>,
    /// Whether that factor is taken as known exactly.
    pub(super) factor_is_exact: bool,
    /// The compared degrees, if the degree was chosen.
    pub degrees: Vec<DegreeChoice>,
}

/// The parameters in the basis of the fit, and their covariance matrix.
#[derive(Clone, Debug)]
pub(super) struct Inner {
    pub(super) basis: Option<Chebyshev>,
    pub(super) estimates: Vec<f64>,
    covariance: Vec<f64>,
}

impl Regression {
    /// Fits a curve; `start` are values near the parameters of a [`Curve::Program`].
    ///
    /// # Errors
    /// The points cannot be fitted ([`RegressionError`]).
    pub fn of(
        name: &str,
        curve: &Curve,
        points: &Arc<Points>,
        start: &[f64],
    ) -> Result<Self, RegressionError> {
        let noise = Arc::new(points.noise()?);
        Self::with(name, curve, (points, noise), start)
    }

    /// The same with covariances that are already decomposed.
    pub(super) fn with(
        name: &str,
        curve: &Curve,
        (points, noise): (&Arc<Points>, Arc<Noise>),
        start: &[f64],
    ) -> Result<Self, RegressionError> {
        let (count, found) = (curve.parameters(), points.len());
        let (estimated, is_complex) = (points.estimated, curve.is_complex());
        if is_complex != points.is_complex() {
            return Err(RegressionError::Complexity { curve: is_complex });
        }
        let needed = count + usize::from(estimated);
        if found < needed {
            return Err(RegressionError::TooFewPoints {
                points: points.count(),
                parameters: count,
                needed: needed.div_ceil(if is_complex { 2 } else { 1 }),
                estimated,
            });
        }
        if let Noise::Single { x, y, .. } = &*noise
            && y.is_empty()
            && !x.is_empty()
        {
            return Err(RegressionError::OrdinatesUnknown);
        }
        let mut different = points.x.clone();
        ascending(&mut different);
        different.dedup();
        if different.len() < count && !is_complex {
            let different = different.len();
            return Err(RegressionError::TooFewAbscissae { different, parameters: count });
        }
        drop(different);
        let basis = match curve {
            Curve::Polynomial { .. } => Some(Chebyshev::over(points.range(), count)),
            Curve::Program(_) => None,
        };
        let mut solver = Solver::new(&noise, basis_of(curve, basis), count, points);
        if basis.is_none() {
            search(&mut solver, curve, points, start)?;
        }
        let chi2 = solver.fit(&points.x, &points.y, TOLERANCE)?;
        let dof = found - count;
        let factor = if estimated { Some((chi2 / dof as f64).sqrt()) } else { None };
        let mut inner = least_squares::inverse_of_normal(&solver.solution.triangle, count);
        if let Some(factor) = factor {
            inner.iter_mut().for_each(|entry| *entry *= factor * factor);
        }
        let parameters = std::mem::take(&mut solver.parameters);
        drop(solver);
        let (estimates, covariance) = match (basis, curve) {
            (Some(basis), Curve::Polynomial { origin, .. }) => {
                let matrix = basis.to_powers(*origin);
                (product(&matrix, &parameters), conjugated(&matrix, &inner, count))
            }
            _ => (parameters.clone(), inner.clone()),
        };
        Ok(Self {
            name: name.to_owned(),
            curve: curve.clone(),
            points: Arc::clone(points),
            noise,
            estimates,
            covariance,
            inner: Inner { basis, estimates: parameters, covariance: inner },
            chi2,
            dof,
            factor,
            factor_is_exact: false,
            degrees: Vec::new(),
        })
    }

    /// The number of parameters.
    pub fn count(&self) -> usize {
        self.estimates.len()
    }

    /// A parameter.
    pub fn estimate(&self, parameter: usize) -> f64 {
        self.estimates[parameter]
    }

    /// The covariance of two parameters.
    pub fn covariance(&self, first: usize, second: usize) -> f64 {
        self.covariance[first * self.count() + second]
    }

    /// The standard uncertainty of a parameter.
    pub fn standard_uncertainty(&self, parameter: usize) -> f64 {
        self.covariance(parameter, parameter).sqrt()
    }

    /// The correlation coefficient of two parameters.
    pub fn correlation(&self, first: usize, second: usize) -> f64 {
        let product = self.standard_uncertainty(first) * self.standard_uncertainty(second);
        (self.covariance(first, second) / product).clamp(-1.0, 1.0)
    }

    /// Degrees of freedom of the parameters' uncertainties: infinite if the uncertainties of the
    /// points are stated.
    pub fn degrees_of_freedom(&self) -> f64 {
        let is_estimated = self.factor.is_some() && !self.factor_is_exact;
        if is_estimated { self.dof as f64 } else { f64::INFINITY }
    }

    /// The same fit if the scatter of its points were known exactly, with infinite degrees of
    /// freedom; `None` if it is.
    pub(crate) fn with_infinite_dof(&self) -> Option<Self> {
        self.degrees_of_freedom()
            .is_finite()
            .then(|| Self { factor_is_exact: true, ..self.clone() })
    }

    /// The probability of a sum of squares at least this large if the curve and the stated
    /// uncertainties are right; `None` if there is nothing to compare.
    pub fn p_value(&self) -> Option<f64> {
        let tested = self.factor.is_none() && self.dof > 0;
        tested.then(|| special::gamma::sf(0.5 * self.chi2, 0.5 * self.dof as f64))
    }

    /// Whether the points agree with the curve: the sum of squares does not exceed the 95 %
    /// quantile of the chi-squared distribution.
    pub fn is_valid(&self) -> Option<bool> {
        self.p_value().map(|p| p >= 0.05)
    }

    /// The 95 % quantile of the chi-squared distribution with these degrees of freedom.
    pub fn limit_of_chi2(&self) -> Option<f64> {
        let tested = self.factor.is_none() && self.dof > 0;
        tested.then(|| 2.0 * special::gamma::quantile(0.95, 0.5 * self.dof as f64))
    }

    /// Ordinates minus the curve at the stated abscissae; NaN for a complex curve
    /// ([`Regression::complex_residuals`]).
    pub fn residuals(&self) -> Vec<f64> {
        let points = self.points.x.iter().zip(&self.points.y);
        points.map(|(x, y)| y - self.at(*x)).collect()
    }

    /// The curve at x; NaN for a complex curve ([`Regression::complex_value`]).
    pub fn at(&self, x: f64) -> f64 {
        self.inner_at(x).0
    }

    /// The standard uncertainty of the curve at x.
    pub fn uncertainty_at(&self, x: f64) -> f64 {
        let each = self.inner_at(x).2;
        quadratic(&each, &self.inner.covariance).sqrt()
    }

    /// Value, slope and derivatives at x, in the basis of the fit.
    fn inner_at(&self, x: f64) -> (f64, f64, Vec<f64>) {
        let mut each = vec![0.0; self.count()];
        let (value, slope) = match &mut basis_of(&self.curve, self.inner.basis) {
            Basis::Chebyshev(basis) => basis.at(x, &self.inner.estimates, &mut each),
            Basis::Program(program) => program.at(x, &self.inner.estimates, &mut each),
        };
        (value, slope, each)
    }

    /// Whether residuals can determine an uncertainty if none is stated.
    pub fn has_scatter(&self) -> bool {
        let largest = self.points.y.iter().fold(0.0, |largest: f64, y| largest.max(y.abs()));
        match (self.factor, &self.points.of_y) {
            (None, _) => true,
            (Some(factor), super::Spread::None) => factor > NO_SCATTER * largest,
            (Some(factor), _) => factor > 0.0,
        }
    }

    /// Whether the curve increases (1) or decreases (-1) over the whole range of the points;
    /// otherwise an x at which it turns.
    ///
    /// # Errors
    /// An x at which it turns, in the unit of x.
    pub fn direction(&self) -> Result<f64, f64> {
        const PLACES: usize = 400;
        let [least, most] = self.points.range();
        let at = |k: usize| least + (most - least) * (k as f64 / PLACES as f64);
        let sign = (self.at(most) - self.at(least)).signum();
        let turns = |k: &usize| self.inner_at(at(*k)).1 * sign < 0.0;
        match (0..=PLACES).find(turns) {
            Some(k) => Err(at(k)),
            None => Ok(sign),
        }
    }

    /// The largest relative difference of the standard uncertainty of the curve over the range if
    /// it is computed from the coefficients of the powers: their loss by rounding.
    pub fn rounding(&self) -> f64 {
        let Curve::Polynomial { origin, .. } = &self.curve else { return 0.0 };
        let [least, most] = self.points.range();
        let at = |share: f64| least + share * (most - least);
        let count = self.count();
        let worst = |x: f64| {
            let powers: Vec<f64> =
                std::iter::successors(Some(1.0), |p| Some(p * (x - origin))).take(count).collect();
            let exact = self.uncertainty_at(x);
            // the largest terms of the sum, times the rounding of each
            let terms: f64 = powers
                .iter()
                .enumerate()
                .map(|(k, power)| (power * self.standard_uncertainty(k)).powi(2))
                .sum();
            f64::EPSILON * terms / (exact * exact)
        };
        (0..=20).map(|k| worst(at(f64::from(k) / 20.0))).fold(0.0, f64::max)
    }

    /// Whether the parameters are linear in normal data, so that their joint normal or t
    /// distribution is exact.
    pub fn is_linear(&self) -> bool {
        matches!(self.curve, Curve::Polynomial { .. }) && self.points.is_exact_in_x()
    }

    /// The operations of a trial's fit, roughly: in each of some steps the curve and its derivatives at
    /// every point, and the whitened equations.
    pub(crate) fn operations(&self) -> u64 {
        const STEPS: usize = 3;
        const OF_A_POLYNOMIAL: usize = 20;
        let curve = match &self.curve {
            Curve::Polynomial { .. } => OF_A_POLYNOMIAL,
            Curve::Program(program) => OF_A_POLYNOMIAL * program.operations().max(1),
        };
        (STEPS * curve * self.count() * self.points.len()) as u64
    }

    /// The working memory for fits to other points with the same uncertainty.
    pub(super) fn solver(&self) -> Solver<'_> {
        let basis = basis_of(&self.curve, self.inner.basis);
        Solver::new(&self.noise, basis, self.count(), &self.points)
    }

    /// Converts parameters from the basis of the fit to those of the curve.
    pub(super) fn outer(&self, parameters: &[f64], powers: &[f64]) -> Vec<f64> {
        if powers.is_empty() { parameters.to_vec() } else { product(powers, parameters) }
    }

    /// The matrix of [`Regression::outer`]; empty if it is the identity.
    pub(super) fn powers(&self) -> Vec<f64> {
        match (self.inner.basis, &self.curve) {
            (Some(basis), Curve::Polynomial { origin, .. }) => basis.to_powers(*origin),
            _ => Vec::new(),
        }
    }
}

impl PartialEq for Regression {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
            && self.estimates == other.estimates
            && self.covariance == other.covariance
            && (Arc::ptr_eq(&self.points, &other.points) || self.points == other.points)
    }
}

fn basis_of(curve: &Curve, basis: Option<Chebyshev>) -> Basis<'_> {
    match (curve, basis) {
        (Curve::Program(program), _) => Basis::Program(Differentiated::of(program)),
        (Curve::Polynomial { degree, .. }, basis) => {
            let usual = || Chebyshev::over([-1.0, 1.0], degree + 1);
            Basis::Chebyshev(basis.unwrap_or_else(usual))
        }
    }
}

/// The parameters of a formula; x is taken as exact and y as independent.
fn search(
    solver: &mut Solver<'_>,
    curve: &Curve,
    points: &Points,
    start: &[f64],
) -> Result<(), RegressionError> {
    let variances = (0..points.len()).map(|i| points.uncertainty_of_y(i).map(|u| u * u));
    let y: Vec<f64> = variances.map_while(|variance| variance).collect();
    let independent = Noise::Single { x: Vec::new(), y, xy: Vec::new() };
    let basis = basis_of(curve, None);
    let mut first = Solver::new(&independent, basis, curve.parameters(), points);
    for (parameter, start) in first.parameters.iter_mut().zip(start) {
        *parameter = *start;
    }
    first.search(&points.x, &points.y)?;
    solver.parameters.clone_from(&first.parameters);
    Ok(())
}

/// A square matrix times a vector.
pub(super) fn product(matrix: &[f64], vector: &[f64]) -> Vec<f64> {
    let rows = matrix.chunks_exact(vector.len().max(1));
    rows.map(|row| crate::linalg::dot(row, vector)).collect()
}

/// M C M'.
fn conjugated(matrix: &[f64], covariance: &[f64], count: usize) -> Vec<f64> {
    let mut result = vec![0.0; count * count];
    let rows: Vec<Vec<f64>> =
        matrix.chunks_exact(count.max(1)).map(|row| product(covariance, row)).collect();
    for (i, row) in rows.iter().enumerate() {
        for j in 0..=i {
            let entry = crate::linalg::dot(row, &matrix[j * count..(j + 1) * count]);
            result[i * count + j] = entry;
            result[j * count + i] = entry;
        }
    }
    result
}

/// v' C v.
fn quadratic(vector: &[f64], covariance: &[f64]) -> f64 {
    crate::linalg::dot(vector, &product(covariance, vector)).max(0.0)
}
