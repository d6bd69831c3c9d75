//! Minimizes the weighted sum of squares by the Gauss-Newton method with the true abscissae
//! eliminated.
//!
//! Near a guess of the parameters and of the true abscissae the condition that every true point
//! lies on the curve is linear. Its misfits e = y - f - f'(x - x*) have the covariance matrix S =
//! Vy - F' Vxy - Vyx F' + F' Vx F', and the change of the parameters is the generalized
//! least-squares solution for e; the remaining misfits correct the abscissae. Finally, the
//! covariance matrix of the parameters is the inverse of A' S^-1 A, where A holds the derivatives
//! with respect to the parameters (ISO/TS 28037, clauses 6 to 10 are cases of it).

use std::sync::Arc;

use super::chebyshev::Chebyshev;
use super::curve::Differentiated;
use super::error::RegressionError;
use super::least_squares::{self, Solution};
use super::points::{Noise, Points, Root};
use crate::linalg::dot;

/// The basis of the parameters.
#[derive(Clone, Debug)]
pub(super) enum Basis<'p> {
    Chebyshev(Chebyshev),
    Program(Differentiated<'p>),
}

/// A column depends on the previous ones if less than this fraction of it remains without them.
const DEPENDENT: f64 = 1e-11;

/// Most steps of a fit.
const MOST_STEPS: usize = 500;

/// Misfits within this fraction of the largest ordinate are rounding: the curve goes through the
/// points, and sums of squares fall and rise without end.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The initial damping in the search for a formula's parameters.
const FIRST_DAMPING: f64 = 1e-3;
const MOST_DAMPING: f64 = 1e18;

/// The working memory of a fit, with the parts that are the same for all sets of points.
#[derive(Debug)]
pub(super) struct Solver<'p> {
    noise: &'p Noise,
    basis: Basis<'p>,
    count: usize,
    /// Whether uncertainties are only relative.
    estimated: bool,
    /// Of complex points, the factors of both parts in each row.
    parts: &'p [[f64; 2]],
    /// The true abscissae.
    abscissae: Vec<f64>,
    /// The parameters.
    pub(super) parameters: Vec<f64>,
    /// The root of the normal equations and the last step.
    pub(super) solution: Solution,
    /// Derivatives with respect to the parameters, one column after the other, and the same
    /// whitened.
    derivatives: Vec<f64>,
    whitened: Vec<f64>,
    misfits: Vec<f64>,
    white_misfits: Vec<f64>,
    slopes: Vec<f64>,
    /// Derivatives at a point, of the real part first.
    each: [Vec<f64>; 2],
    /// Of each misfit that is independent of the others, unless all weigh alike.
    weights: Vec<f64>,
    /// The root of the covariance matrix of misfits with a full one.
    root: Option<Arc<Root>>,
}

/// A fit's linearization, from which fits to points near its own begin.
#[derive(Debug)]
pub(super) struct Linearized {
    parameters: Vec<f64>,
    /// Ordinates less misfits, at an abscissa of 0: a misfit is linear in the coordinates.
    offsets: Vec<f64>,
    slopes: Vec<f64>,
    derivatives: Vec<f64>,
    whitened: Vec<f64>,
    weights: Vec<f64>,
    root: Option<Arc<Root>>,
    /// The root of the normal equations.
    triangle: Vec<f64>,
}

/// When a fit ends.
#[derive(Clone, Copy, Debug)]
enum End {
    /// After a step that changes nothing by more than this number of standard uncertainties.
    Step(f64),
    /// When what further steps would still change is below this number of standard uncertainties:
    /// each step is the same fraction of the one before, so that the rest is a geometric series.
    Rest(f64),
}

impl<'p> Solver<'p> {
    pub(super) fn new(
        noise: &'p Noise,
        basis: Basis<'p>,
        count: usize,
        points: &'p Points,
    ) -> Self {
        Self {
            noise,
            basis,
            count,
            estimated: points.estimated,
            parts: &points.parts,
            abscissae: Vec::new(),
            parameters: vec![0.0; count],
            solution: Solution::default(),
            derivatives: Vec::new(),
            whitened: Vec::new(),
            misfits: Vec::new(),
            white_misfits: Vec::new(),
            slopes: Vec::new(),
            each: [vec![0.0; count], vec![0.0; count]],
            weights: Vec::new(),
            root: None,
        }
    }

    /// Whether one step is sufficient: the curve is linear in its parameters and x is exact.
    pub(super) fn is_linear(&self) -> bool {
        matches!(self.basis, Basis::Chebyshev(_)) && self.is_exact_in_x()
    }

    fn is_exact_in_x(&self) -> bool {
        match self.noise {
            Noise::Single { x, .. } => x.is_empty(),
            Noise::Ordinates(_) => true,
            Noise::Full { .. } => false,
        }
    }

    /// Finds the parameters, starting from the present ones; returns the weighted sum of squares.
    /// Iteration ends when a step changes nothing by more than `tolerance` standard uncertainties.
    pub(super) fn fit(
        &mut self,
        x: &[f64],
        y: &[f64],
        tolerance: f64,
    ) -> Result<f64, RegressionError> {
        self.abscissae.clear();
        self.abscissae.extend_from_slice(x);
        self.iterate(x, y, End::Step(tolerance))
    }

    /// The same near a fit, from its linearization. Iteration ends when further steps would change
    /// nothing by more than `tolerance` standard uncertainties.
    pub(super) fn fit_near(
        &mut self,
        fit: &Linearized,
        x: &[f64],
        y: &[f64],
        tolerance: f64,
    ) -> Result<f64, RegressionError> {
        self.begin(fit, x, y);
        self.iterate(x, y, End::Rest(tolerance))
    }

    /// The linearization of the fit to these points, given its parameters.
    pub(super) fn linearized(
        &mut self,
        parameters: &[f64],
        Points { x, y, .. }: &Points,
        tolerance: f64,
    ) -> Result<Linearized, RegressionError> {
        self.parameters.clear();
        self.parameters.extend_from_slice(parameters);
        self.fit(x, y, tolerance)?;
        self.linearize(x, y)?;
        self.whiten()?;
        let whitened = self.whitened.clone();
        self.solve()?;
        let points = x.iter().zip(y).zip(&self.misfits).zip(&self.slopes);
        Ok(Linearized {
            parameters: self.parameters.clone(),
            offsets: points.map(|(((x, y), misfit), slope)| y - misfit - slope * x).collect(),
            slopes: self.slopes.clone(),
            derivatives: self.derivatives.clone(),
            whitened,
            weights: self.weights.clone(),
            root: self.root.clone(),
            triangle: self.solution.triangle.clone(),
        })
    }

    /// Parameters and abscissae of the linearized fit to these points.
    fn begin(&mut self, fit: &Linearized, x: &[f64], y: &[f64]) {
        self.slopes.clone_from(&fit.slopes);
        self.derivatives.clone_from(&fit.derivatives);
        self.weights.clone_from(&fit.weights);
        self.root.clone_from(&fit.root);
        let points = x.iter().zip(y).zip(&fit.offsets).zip(&fit.slopes);
        self.misfits.clear();
        self.misfits.extend(points.map(|(((x, y), offset), slope)| y - offset - slope * x));
        let mut white = std::mem::take(&mut self.white_misfits);
        white.clone_from(&self.misfits);
        self.whiten_column(&mut white);
        self.solution.parameters.clear();
        let columns = fit.whitened.chunks_exact(white.len().max(1));
        self.solution.parameters.extend(columns.map(|column| dot(column, &white)));
        least_squares::solve_normal(&fit.triangle, &mut self.solution.parameters);
        self.white_misfits = white;
        let steps = fit.parameters.iter().zip(&self.solution.parameters);
        self.parameters.clear();
        self.parameters.extend(steps.map(|(parameter, step)| parameter + step));
        self.abscissae.clear();
        self.abscissae.extend_from_slice(x);
        if !self.is_exact_in_x() {
            self.correct_abscissae(x);
        }
    }

    /// Solves the whitened equations.
    fn solve(&mut self) -> Result<(), RegressionError> {
        least_squares::solve(
            &mut self.whitened,
            &mut self.white_misfits,
            DEPENDENT,
            &mut self.solution,
        )
        .map_err(|parameter| RegressionError::Dependent { parameter })
    }

    fn iterate(&mut self, x: &[f64], y: &[f64], end: End) -> Result<f64, RegressionError> {
        let (mut steps, linear) = (0, self.is_linear());
        // the steps before, of parameters and of abscissae
        let (mut before, mut before_in_x) = (0.0, 0.0);
        loop {
            self.linearize(x, y)?;
            self.whiten()?;
            self.solve()?;
            let squares = self.left();
            let (moved, scale) = (self.moved(), self.scale(squares));
            let ends = end.is_reached(moved, before, scale) || self.is_rounding() || self.meets(y);
            before = moved;
            for (parameter, step) in self.parameters.iter_mut().zip(&self.solution.parameters) {
                *parameter += step;
            }
            steps += 1;
            let exact = self.is_exact_in_x();
            // a second step of a linear fit corrects the rounding of the first
            if (linear && steps == 2) || (ends && exact) {
                return Ok(squares);
            }
            if steps == MOST_STEPS || !squares.is_finite() {
                return Err(RegressionError::NotConverged { steps });
            }
            if !exact {
                // constant parameters mean nothing while the abscissae still move: the first step,
                // from a curve without slope, leaves them at the measured values
                let moved = self.correct_abscissae(x);
                if ends && steps > 1 && end.is_reached(moved, before_in_x, scale) {
                    return Ok(squares);
                }
                before_in_x = moved;
            }
        }
    }

    /// The sum of squares after the last step.
    fn left(&self) -> f64 {
        self.white_misfits.iter().skip(self.count).map(|misfit| misfit * misfit).sum()
    }

    /// The factor of the stated uncertainties.
    fn scale(&self, squares: f64) -> f64 {
        let spare = self.white_misfits.len().saturating_sub(self.count).max(1) as f64;
        if self.estimated { (squares / spare).sqrt() } else { 1.0 }
    }

    /// The last step of the parameters, in units of the misfits: R times the step.
    fn moved(&self) -> f64 {
        let moved: f64 =
            self.white_misfits.iter().take(self.count).map(|change| change * change).sum();
        moved.sqrt()
    }

    /// Whether the last step is at the rounding of the parameters.
    fn is_rounding(&self) -> bool {
        let mut steps = self.parameters.iter().zip(&self.solution.parameters);
        steps.all(|(parameter, step)| step.abs() <= 1e-13 * parameter.abs())
    }

    /// Whether the curve passes through the points apart from rounding.
    fn meets(&self, y: &[f64]) -> bool {
        let largest = y.iter().fold(0.0_f64, |largest, y| largest.max(y.abs()));
        self.misfits.iter().all(|misfit| misfit.abs() <= ROUNDING * largest)
    }

    /// Misfits, slopes and derivatives at the parameters and abscissae.
    fn linearize(&mut self, x: &[f64], y: &[f64]) -> Result<(), RegressionError> {
        let n = x.len();
        self.misfits.resize(n, 0.0);
        self.slopes.resize(n, 0.0);
        self.derivatives.resize(n * self.count, 0.0);
        if !self.parts.is_empty() {
            return self.linearize_parts(y);
        }
        for point in 0..n {
            let (at, parameters) = (self.abscissae[point], &self.parameters);
            let [each, _] = &mut self.each;
            let (value, slope) = match &mut self.basis {
                Basis::Chebyshev(basis) => basis.at(at, parameters, each),
                Basis::Program(program) => program.at(at, parameters, each),
            };
            if !(value.is_finite() && each.iter().all(|d| d.is_finite())) {
                return Err(RegressionError::Undefined { point });
            }
            self.misfits[point] = y[point] - value - slope * (x[point] - at);
            self.slopes[point] = slope;
            for (k, derivative) in each.iter().enumerate() {
                self.derivatives[k * n + point] = *derivative;
            }
        }
        Ok(())
    }

    /// The same of complex points with exact abscissae: both rows of a point from both parts of the
    /// curve.
    fn linearize_parts(&mut self, y: &[f64]) -> Result<(), RegressionError> {
        let (rows, points) = (y.len(), y.len() / 2);
        for point in 0..points {
            let (at, [re, im]) = (self.abscissae[point], &mut self.each);
            let values = match &mut self.basis {
                Basis::Chebyshev(_) => [(f64::NAN, f64::NAN); 2],
                Basis::Program(program) => program.outputs(at, &self.parameters, [re, im]),
            };
            let values = values.map(|(value, _)| value);
            if !values.iter().chain(&*re).chain(&*im).all(|value| value.is_finite()) {
                return Err(RegressionError::Undefined { point });
            }
            for row in [point, points + point] {
                let [of_re, of_im] = self.parts[row];
                self.misfits[row] = y[row] - of_re * values[0] - of_im * values[1];
                for (k, (re, im)) in re.iter().zip(&*im).enumerate() {
                    self.derivatives[k * rows + row] = of_re * re + of_im * im;
                }
            }
        }
        Ok(())
    }

    /// Derivatives and misfits in units in which the misfits are independent with variance 1.
    fn whiten(&mut self) -> Result<(), RegressionError> {
        let n = self.misfits.len();
        self.whitened.clear();
        self.whitened.extend_from_slice(&self.derivatives);
        self.white_misfits.clear();
        self.white_misfits.extend_from_slice(&self.misfits);
        match self.noise {
            Noise::Single { x, y, xy } if x.is_empty() && y.is_empty() && xy.is_empty() => {}
            Noise::Single { .. } => {
                let (noise, slopes) = (self.noise, &self.slopes);
                self.weights.clear();
                self.weights.extend((0..n).map(|i| 1.0 / noise.of_misfit(i, slopes[i]).sqrt()));
            }
            Noise::Ordinates(_) => {}
            Noise::Full { x, y, xy } => {
                let d = &self.slopes;
                let entry = |i: usize, j: usize| {
                    y[i * n + j] - d[i] * xy[i * n + j] - d[j] * xy[j * n + i]
                        + d[i] * d[j] * x[i * n + j]
                };
                let root = Root::of(n, entry).map_err(|point| RegressionError::NotDefinite {
                    coordinate: Some(super::Coordinate::Y),
                    point,
                })?;
                self.root = Some(Arc::new(root));
            }
        }
        let mut whitened = std::mem::take(&mut self.whitened);
        let mut misfits = std::mem::take(&mut self.white_misfits);
        whitened.chunks_exact_mut(n.max(1)).for_each(|column| self.whiten_column(column));
        self.whiten_column(&mut misfits);
        (self.whitened, self.white_misfits) = (whitened, misfits);
        Ok(())
    }

    fn whiten_column(&self, column: &mut [f64]) {
        match (self.noise, &self.root) {
            (Noise::Ordinates(root), _) => root.solve(column),
            (_, Some(root)) => root.solve(column),
            (_, None) => {
                for (entry, weight) in column.iter_mut().zip(&self.weights) {
                    *entry *= weight;
                }
            }
        }
    }

    /// The true abscissae after the step, and their change: the square root of the sum of squares,
    /// each in its standard uncertainty.
    fn correct_abscissae(&mut self, x: &[f64]) -> f64 {
        let n = x.len();
        let mut moved = 0.0;
        // a change within the rounding of the abscissa counts as zero
        let share = |to: f64, from: f64, variance: f64| {
            let by = to - from;
            if by.abs() <= 1e-13 * to.abs() { 0.0 } else { by * by / variance }
        };
        let mut left = std::mem::take(&mut self.misfits);
        for (column, step) in self.derivatives.chunks_exact(n).zip(&self.solution.parameters) {
            for (left, derivative) in left.iter_mut().zip(column) {
                *left -= derivative * step;
            }
        }
        match self.noise {
            Noise::Single { x: variances, xy, .. } => {
                for (i, left) in left.iter_mut().enumerate() {
                    let (variance, slope) = (variances[i], self.slopes[i]);
                    let weight = *left / self.noise.of_misfit(i, slope);
                    let cross = xy.get(i).copied().unwrap_or(0.0);
                    let to = x[i] + (variance * slope - cross) * weight;
                    moved += share(to, self.abscissae[i], variance);
                    self.abscissae[i] = to;
                }
            }
            Noise::Ordinates(_) => {}
            Noise::Full { x: variances, xy, .. } => {
                if let Some(root) = &self.root {
                    root.solve(&mut left);
                    root.solve_transposed(&mut left);
                }
                for (i, x) in x.iter().enumerate() {
                    let row = i * n..(i + 1) * n;
                    let terms = variances[row.clone()].iter().zip(&xy[row]).zip(&self.slopes);
                    let terms = terms.zip(&left);
                    let change: f64 =
                        terms.map(|(((v, c), slope), weight)| (v * slope - c) * weight).sum();
                    let to = x + change;
                    moved += share(to, self.abscissae[i], variances[i * n + i]);
                    self.abscissae[i] = to;
                }
            }
        }
        self.misfits = left;
        moved.sqrt()
    }

    /// The parameters of a curve that is not linear in them, by the Levenberg-Marquardt method from
    /// the present ones, with x taken as exact. [`Solver::fit`] refines the result.
    pub(super) fn search(&mut self, x: &[f64], y: &[f64]) -> Result<(), RegressionError> {
        let n = x.len();
        self.abscissae.clear();
        self.abscissae.extend_from_slice(x);
        self.linearize(x, y)?;
        self.whiten()?;
        let sum = |misfits: &[f64]| misfits.iter().map(|misfit| misfit * misfit).sum::<f64>();
        let (mut squares, mut damping) = (sum(&self.white_misfits), FIRST_DAMPING);
        let mut lengths = vec![0.0_f64; self.count];
        for _ in 0..MOST_STEPS {
            let (columns, misfits) = (self.whitened.clone(), self.white_misfits.clone());
            for (length, column) in lengths.iter_mut().zip(columns.chunks_exact(n)) {
                *length = length.max(sum(column).sqrt());
            }
            let before = self.parameters.clone();
            loop {
                // the damping as further rows
                let rows = n + self.count;
                let mut damped = vec![0.0; rows * self.count];
                for (k, column) in damped.chunks_exact_mut(rows).enumerate() {
                    column[..n].copy_from_slice(&columns[k * n..(k + 1) * n]);
                    column[n + k] = (damping.sqrt() * lengths[k]).max(f64::MIN_POSITIVE);
                }
                let mut right = misfits.clone();
                right.resize(rows, 0.0);
                let solved = least_squares::solve(&mut damped, &mut right, 0.0, &mut self.solution);
                let moved: f64 = right.iter().take(self.count).map(|m| m * m).sum();
                for (k, parameter) in self.parameters.iter_mut().enumerate() {
                    *parameter = before[k] + self.solution.parameters.get(k).unwrap_or(&0.0);
                }
                let tried = solved.is_ok() && self.linearize(x, y).is_ok() && self.whiten().is_ok();
                let found = sum(&self.white_misfits);
                if tried && found <= squares {
                    let ends = squares - found <= 1e-12 * squares && moved <= 1e-10 * squares;
                    squares = found;
                    damping *= 0.1;
                    if ends || squares == 0.0 || self.meets(y) {
                        return Ok(());
                    }
                    break;
                }
                damping *= 10.0;
                if damping > MOST_DAMPING {
                    // no step decreases the sum: this is the minimum, or rounding hides it
                    self.parameters = before;
                    return Ok(());
                }
            }
        }
        Err(RegressionError::NotConverged { steps: MOST_STEPS })
    }
}

impl End {
    /// Whether a step ends the fit; `before` is the one before it, `scale` the factor of the
    /// standard uncertainties.
    fn is_reached(self, step: f64, before: f64, scale: f64) -> bool {
        match self {
            Self::Step(tolerance) => step <= tolerance * scale,
            Self::Rest(tolerance) => {
                let ratio = if step > 0.0 { step / before } else { 0.0 };
                ratio < 1.0 && step * ratio / (1.0 - ratio) <= tolerance * scale
            }
        }
    }
}

impl Noise {
    /// The variance of a point's misfit if the curve has this slope.
    #[inline]
    fn of_misfit(&self, point: usize, slope: f64) -> f64 {
        let Self::Single { x, y, xy } = self else { return 1.0 };
        let of = |values: &Vec<f64>| values.get(point).copied().unwrap_or(0.0);
        of(y) + slope * (slope * of(x) - 2.0 * of(xy))
    }
}
