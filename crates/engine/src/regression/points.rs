//! The points to which a curve is fitted.

use super::error::{Coordinate, RegressionError};
use crate::linalg::{BlockedRoot, packed};

/// The variances and covariances of one coordinate of all points, in squares of its unit.
#[derive(Clone, Debug, PartialEq)]
pub enum Spread {
    /// No uncertainties: abscissae are exact; for ordinates a common standard uncertainty is
    /// estimated from the residuals.
    None,
    /// The variance of each point, independent of the others.
    Each(Vec<f64>),
    /// The lower triangle of the covariance matrix, row by row.
    Joint(Vec<f64>),
}

/// The covariances of abscissae with ordinates.
#[derive(Clone, Debug, PartialEq)]
pub enum Cross {
    /// They are independent.
    None,
    /// Between the two coordinates of each point.
    Each(Vec<f64>),
    /// Between abscissa i and ordinate j, row by row.
    Joint(Vec<f64>),
}

/// Points with their stated uncertainties.
#[derive(Clone, Debug, PartialEq)]
pub struct Points {
    /// Abscissae.
    pub x: Vec<f64>,
    /// Ordinates, as many.
    pub y: Vec<f64>,
    /// Uncertainty of the abscissae.
    pub of_x: Spread,
    /// Uncertainty of the ordinates.
    pub of_y: Spread,
    /// Covariances of the two.
    pub cross: Cross,
    /// Whether the stated uncertainties are only relative: the residuals then determine their
    /// common factor. It is true if nothing is stated for the ordinates.
    pub estimated: bool,
    /// If the ordinates are complex, the factors of the real and the imaginary part of which each
    /// row of x and y is the sum ([`Points::complex`]); else empty.
    pub(super) parts: Vec<[f64; 2]>,
}

/// The covariances of all coordinates, as the solver needs them.
#[derive(Clone, Debug)]
pub(super) enum Noise {
    /// Different points are independent: variances of x, of y, and their covariance; empty for
    /// none.
    Single { x: Vec<f64>, y: Vec<f64>, xy: Vec<f64> },
    /// Exact abscissae, and the root of the covariance matrix of the ordinates.
    Ordinates(Root),
    /// Everything: full symmetric matrices, row by row.
    Full { x: Vec<f64>, y: Vec<f64>, xy: Vec<f64> },
}

/// A Cholesky root, small or large.
#[derive(Clone, Debug)]
pub(super) enum Root {
    Packed(Vec<f64>),
    Blocked(BlockedRoot),
}

/// From this order on tiles are faster.
const LARGE: usize = 256;

/// A pivot below this fraction of its variance is rounding: the matrix is singular.
const LEAST_PIVOT: f64 = 1e-13;

impl Root {
    /// The root of a symmetric matrix; the first row with an invalid pivot.
    pub(super) fn of(
        order: usize,
        entry: impl Fn(usize, usize) -> f64 + Sync,
    ) -> Result<Self, usize> {
        if order >= LARGE {
            return BlockedRoot::of(order, LEAST_PIVOT, entry).map(Self::Blocked);
        }
        let mut lower: Vec<f64> = (0..order)
            .flat_map(|i| (0..=i).map(move |j| (i, j)))
            .map(|(i, j)| entry(i, j))
            .collect();
        packed::cholesky(&mut lower, 0.0)?;
        let rounding = |i: usize| {
            let pivot = lower[packed::triangle(i) + i];
            pivot * pivot <= LEAST_PIVOT * entry(i, i)
        };
        match (0..order).find(|&i| rounding(i)) {
            Some(row) => Err(row),
            None => Ok(Self::Packed(lower)),
        }
    }

    /// Replaces y by inv(L) y.
    pub(super) fn solve(&self, y: &mut [f64]) {
        match self {
            Self::Packed(lower) => packed::solve(lower, y),
            Self::Blocked(root) => root.solve(y),
        }
    }

    /// Replaces y by inv(L') y.
    pub(super) fn solve_transposed(&self, y: &mut [f64]) {
        match self {
            Self::Packed(lower) => packed::solve_transposed(lower, y),
            Self::Blocked(root) => root.solve_transposed(y),
        }
    }

    /// Replaces z by L z.
    pub(super) fn multiply(&self, z: &mut [f64]) {
        match self {
            Self::Packed(lower) => {
                for (i, row) in packed::rows(lower).enumerate().rev() {
                    z[i] = crate::linalg::dot(row, &z[..=i]);
                }
            }
            Self::Blocked(root) => root.multiply(z),
        }
    }
}

impl Points {
    /// Points without stated uncertainties.
    pub fn new(x: Vec<f64>, y: Vec<f64>) -> Self {
        let (of_x, of_y) = (Spread::None, Spread::None);
        Self { x, y, of_x, of_y, cross: Cross::None, estimated: true, parts: Vec::new() }
    }

    /// The same with stated uncertainties of the ordinates.
    #[must_use]
    pub fn with_y(self, of_y: Spread) -> Self {
        let estimated = of_y == Spread::None;
        Self { of_y, estimated, ..self }
    }

    /// The same with stated uncertainties of the abscissae.
    #[must_use]
    pub fn with_x(self, of_x: Spread) -> Self {
        Self { of_x, ..self }
    }

    /// The same with covariances of abscissae and ordinates.
    #[must_use]
    pub fn with_cross(self, cross: Cross) -> Self {
        Self { cross, ..self }
    }

    /// The same with uncertainties that are only relative.
    #[must_use]
    pub fn estimated(self) -> Self {
        Self { estimated: true, ..self }
    }

    /// Number of rows: of points, or twice as many if they are complex.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// The smallest and the largest abscissa.
    pub fn range(&self) -> [f64; 2] {
        let least = self.x.iter().copied().fold(f64::INFINITY, f64::min);
        [least, self.x.iter().copied().fold(f64::NEG_INFINITY, f64::max)]
    }

    /// Whether the abscissae are exact.
    pub fn is_exact_in_x(&self) -> bool {
        self.of_x == Spread::None
    }

    /// The standard uncertainty of an ordinate; `None` if none is stated.
    pub fn uncertainty_of_y(&self, point: usize) -> Option<f64> {
        uncertainty(&self.of_y, point)
    }

    /// The standard uncertainty of an abscissa; `None` if it is exact.
    pub fn uncertainty_of_x(&self, point: usize) -> Option<f64> {
        uncertainty(&self.of_x, point)
    }

    /// Checks that the points can be fitted, and decomposes their covariances.
    pub(super) fn noise(&self) -> Result<Noise, RegressionError> {
        self.noise_of_rows().map_err(|error| error.at_point(|row| row % self.count().max(1)))
    }

    fn noise_of_rows(&self) -> Result<Noise, RegressionError> {
        let n = self.len();
        for (coordinate, values) in [(Coordinate::X, &self.x), (Coordinate::Y, &self.y)] {
            if let Some(point) = values.iter().position(|value| !value.is_finite()) {
                return Err(RegressionError::NotFinite { coordinate, point });
            }
        }
        if self.y.len() != n {
            let (coordinate, expected) = (Coordinate::Y, n);
            return Err(RegressionError::Length { coordinate, expected, found: self.y.len() });
        }
        let spreads = [(Coordinate::X, &self.of_x), (Coordinate::Y, &self.of_y)];
        for (coordinate, spread) in spreads {
            check_spread(coordinate, spread, n)?;
        }
        self.check_cross()?;
        let joint = |spread: &Spread| matches!(spread, Spread::Joint(_));
        if !joint(&self.of_x) && !joint(&self.of_y) && !matches!(self.cross, Cross::Joint(_)) {
            return self.single();
        }
        if self.is_exact_in_x() {
            let Spread::Joint(lower) = &self.of_y else { return self.single() };
            let root = Root::of(n, |i, j| lower[packed::triangle(i) + j]).map_err(|point| {
                RegressionError::NotDefinite { coordinate: Some(Coordinate::Y), point }
            })?;
            return Ok(Noise::Ordinates(root));
        }
        let xy = match &self.cross {
            Cross::None => vec![0.0; n * n],
            Cross::Each(each) => {
                let mut full = vec![0.0; n * n];
                each.iter().enumerate().for_each(|(i, value)| full[i * n + i] = *value);
                full
            }
            Cross::Joint(all) => all.clone(),
        };
        let noise = Noise::Full { x: full(&self.of_x, n), y: full(&self.of_y, n), xy };
        noise.joint_root()?;
        Ok(noise)
    }

    fn single(&self) -> Result<Noise, RegressionError> {
        let each = |spread: &Spread| match spread {
            Spread::Each(variances) => variances.clone(),
            _ => Vec::new(),
        };
        let (x, y) = (each(&self.of_x), each(&self.of_y));
        let xy = match &self.cross {
            Cross::Each(each) => each.clone(),
            _ => Vec::new(),
        };
        // the determinant of each point's own matrix
        let bound = |i: usize| x.get(i).copied().unwrap_or(0.0) * y.get(i).copied().unwrap_or(1.0);
        if let Some(point) = xy.iter().enumerate().position(|(i, c)| *c != 0.0 && c * c >= bound(i))
        {
            return Err(RegressionError::NotDefinite { coordinate: None, point });
        }
        Ok(Noise::Single { x, y, xy })
    }

    fn check_cross(&self) -> Result<(), RegressionError> {
        let n = self.len();
        let (values, expected) = match &self.cross {
            Cross::None => return Ok(()),
            Cross::Each(values) => (values, n),
            Cross::Joint(values) => (values, n * n),
        };
        if values.len() != expected {
            let coordinate = Coordinate::Both;
            return Err(RegressionError::Length { coordinate, expected, found: values.len() });
        }
        match values.iter().position(|value| !value.is_finite()) {
            Some(point) => {
                Err(RegressionError::NotFinite { coordinate: Coordinate::Both, point: point % n })
            }
            None => Ok(()),
        }
    }
}

impl Noise {
    /// The root of the covariance matrix of all abscissae, then all ordinates.
    pub(super) fn joint_root(&self) -> Result<Option<Root>, RegressionError> {
        let Self::Full { x, y, xy } = self else { return Ok(None) };
        let n = libm::sqrt(x.len() as f64) as usize;
        let entry = |i: usize, j: usize| match (i < n, j < n) {
            (true, true) => x[i * n + j],
            (false, true) => xy[j * n + (i - n)],
            (true, false) => xy[i * n + (j - n)],
            (false, false) => y[(i - n) * n + (j - n)],
        };
        let root = Root::of(2 * n, entry).map_err(|row| {
            let coordinate = Some(if row < n { Coordinate::X } else { Coordinate::Y });
            RegressionError::NotDefinite { coordinate, point: row % n }
        })?;
        Ok(Some(root))
    }
}

fn uncertainty(spread: &Spread, point: usize) -> Option<f64> {
    match spread {
        Spread::None => None,
        Spread::Each(variances) => variances.get(point).map(|variance| variance.sqrt()),
        Spread::Joint(lower) => lower.get(packed::triangle(point) + point).map(|v| v.sqrt()),
    }
}

fn full(spread: &Spread, n: usize) -> Vec<f64> {
    let mut full = vec![0.0; n * n];
    match spread {
        Spread::None => {}
        Spread::Each(variances) => {
            variances.iter().enumerate().for_each(|(i, v)| full[i * n + i] = *v);
        }
        Spread::Joint(lower) => {
            for (i, row) in packed::rows(lower).enumerate() {
                for (j, value) in row.iter().enumerate() {
                    full[i * n + j] = *value;
                    full[j * n + i] = *value;
                }
            }
        }
    }
    full
}

fn check_spread(coordinate: Coordinate, spread: &Spread, n: usize) -> Result<(), RegressionError> {
    let (found, expected) = match spread {
        Spread::None => return Ok(()),
        Spread::Each(variances) => (variances.len(), n),
        Spread::Joint(lower) => (lower.len(), packed::triangle(n)),
    };
    if found != expected {
        return Err(RegressionError::Length { coordinate, expected, found });
    }
    let variance = |point: usize| match spread {
        Spread::Each(variances) => variances[point],
        Spread::Joint(lower) => lower[packed::triangle(point) + point],
        Spread::None => 0.0,
    };
    // an abscissa may be exact although others are not
    let may_vanish = coordinate == Coordinate::X && matches!(spread, Spread::Each(_));
    for point in 0..n {
        let variance = variance(point);
        if !variance.is_finite() {
            return Err(RegressionError::NotFinite { coordinate, point });
        }
        if variance < 0.0 || (variance == 0.0 && !may_vanish) {
            return Err(RegressionError::NoVariance { coordinate, point });
        }
    }
    Ok(())
}
