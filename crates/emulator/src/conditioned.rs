//! Points and lengths made ready for the values of functions at the points.

use gumption_engine::linalg::packed::{self, triangle};
use gumption_engine::linalg::{add_multiple, dot};

use crate::matern::{correlation, inverse_squares};
use crate::trend::{Trend, functions};

/// What is added to the correlation of each value with itself, so that rounding leaves it positive definite.
const NUGGET: f64 = 1e-9;

/// The same for the functions of the trend, relative.
const RIDGE: f64 = 1e-12;

/// The least variance of a residual that is taken for one.
const LEAST_VARIANCE: f64 = 1e-30;

/// How values scatter about a function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValueScatter {
    /// The variance of a value, above 0.
    pub variance: f64,
    /// So many of the first values scatter; the others are exact.
    pub count: usize,
}

/// Points and lengths made ready for values at them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Conditioned {
    pub(crate) points: Vec<Vec<f64>>,
    pub(crate) inverse_squares: Vec<f64>,
    /// The Cholesky root of the correlations, a packed lower triangle.
    pub(crate) root: Vec<f64>,
    /// The functions of the trend at the points, whitened by the root.
    trend: Vec<Vec<f64>>,
    /// The Cholesky root of their products with each other.
    trend_root: Vec<f64>,
    /// Where the values scatter.
    nugget: Option<Nugget>,
}

/// A scatter of the first values about the function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Nugget {
    /// The variance of the scatter, relative to that of the function.
    pub(crate) share: f64,
    pub(crate) scatter: ValueScatter,
}

/// A function, as its values at the points give it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Target {
    /// What the correlations with the points are multiplied by.
    pub(crate) weights: Vec<f64>,
    /// What the functions of the trend are multiplied by.
    trend: Vec<f64>,
    pub(crate) variance: f64,
    /// The sum of the squares of the whitened residuals.
    pub(crate) squares: f64,
}

impl Conditioned {
    pub(crate) fn new(
        points: Vec<Vec<f64>>,
        trend: Trend,
        ln_lengths: &[f64],
        nugget: Option<Nugget>,
    ) -> Self {
        let scattered = nugget.map_or(0, |nugget| nugget.scatter.count);
        let share = nugget.map_or(0.0, |nugget| nugget.share);
        let inverse_squares = inverse_squares(ln_lengths);
        let mut root = Vec::with_capacity(triangle(points.len()));
        for (i, point) in points.iter().enumerate() {
            root.extend(points[..i].iter().map(|b| correlation(point, b, &inverse_squares).value));
            root.push(1.0 + NUGGET + if i < scattered { share } else { 0.0 });
        }
        packed::cholesky_of_definite(&mut root);
        let count = trend.functions(points.len(), ln_lengths.len());
        let mut trend = vec![Vec::with_capacity(points.len()); count];
        for point in &points {
            for (column, function) in trend.iter_mut().zip(functions(count, point)) {
                column.push(function);
            }
        }
        let mut trend_root = Vec::new();
        for i in 0..count {
            packed::solve(&root, &mut trend[i]);
            trend_root.extend(trend[..i].iter().map(|other| dot(other, &trend[i])));
            trend_root.push(dot(&trend[i], &trend[i]) * (1.0 + RIDGE));
        }
        packed::cholesky_of_definite(&mut trend_root);
        Self { points, inverse_squares, root, trend, trend_root, nugget }
    }

    /// The function with these values at the points.
    pub(crate) fn target(&self, values: &[f64]) -> Target {
        let mut residual = values.to_vec();
        packed::solve(&self.root, &mut residual);
        let mut trend: Vec<f64> = self.trend.iter().map(|of| dot(of, &residual)).collect();
        packed::solve(&self.trend_root, &mut trend);
        packed::solve_transposed(&self.trend_root, &mut trend);
        for (factor, of) in trend.iter().zip(&self.trend) {
            add_multiple(&mut residual, -factor, of);
        }
        let squares = dot(&residual, &residual);
        let likeliest = squares / values.len().max(1) as f64 + LEAST_VARIANCE;
        let known = self.nugget.map(|nugget| nugget.scatter.variance / nugget.share);
        let variance = known.unwrap_or(likeliest);
        packed::solve_transposed(&self.root, &mut residual);
        Target { weights: residual, trend, variance, squares }
    }

    /// Half the logarithm of the determinant of the correlations.
    pub(crate) fn ln_root(&self) -> f64 {
        packed::ln_diagonal(&self.root)
    }

    /// The inverse of the correlations, a packed lower triangle.
    pub(crate) fn inverse(&self) -> Vec<f64> {
        let mut root = self.root.clone();
        packed::invert(&mut root);
        let mut inverse = vec![0.0; root.len()];
        for row in packed::rows(&root) {
            for (i, &factor) in row.iter().enumerate() {
                add_multiple(&mut inverse[triangle(i)..triangle(i + 1)], factor, &row[..=i]);
            }
        }
        inverse
    }

    /// The variance, relative to that of a target, that the points leave at one with these correlations to
    /// them.
    pub(crate) fn left(&self, correlations: Vec<f64>, point: &[f64]) -> f64 {
        let (known, unknown) = self.whitened(correlations, point);
        (1.0 - dot(&known, &known)).max(NUGGET) + dot(&unknown, &unknown)
    }

    /// The variance of the value at a point with these correlations to those known that comes from their
    /// scatter.
    pub(crate) fn scattered(&self, correlations: Vec<f64>, point: &[f64]) -> f64 {
        let Some(Nugget { scatter, .. }) = self.nugget else { return 0.0 };
        let (mut weights, mut factors) = self.whitened(correlations, point);
        packed::solve_transposed(&self.trend_root, &mut factors);
        for (factor, of) in factors.iter().zip(&self.trend) {
            add_multiple(&mut weights, *factor, of);
        }
        packed::solve_transposed(&self.root, &mut weights);
        let own = &weights[..scatter.count.min(weights.len())];
        scatter.variance * dot(own, own)
    }

    /// Correlations with the points, and what is left of the functions of the trend at a point, both whitened.
    fn whitened(&self, mut correlations: Vec<f64>, point: &[f64]) -> (Vec<f64>, Vec<f64>) {
        packed::solve(&self.root, &mut correlations);
        let count = self.trend.len();
        let trend = functions(count, point).zip(&self.trend);
        let mut unknown: Vec<f64> =
            trend.map(|(function, of)| function - dot(of, &correlations)).collect();
        packed::solve(&self.trend_root, &mut unknown);
        (correlations, unknown)
    }
}

impl Target {
    /// The value at a point with these correlations to those known.
    pub(crate) fn value(&self, point: &[f64], correlations: &[f64]) -> f64 {
        let trend = functions(self.trend.len(), point).zip(&self.trend);
        let trend: f64 = trend.map(|(function, factor)| function * factor).sum();
        trend + dot(correlations, &self.weights)
    }

    /// The slope of the trend along a dimension.
    pub(crate) fn trend_slope(&self, dimension: usize) -> f64 {
        self.trend.get(dimension + 1).copied().unwrap_or(0.0)
    }
}
