//! Complex ordinates: a response, of which modulus and phase were measured over frequency.
//!
//! Each point is two rows of the fit, real sums of the real and the imaginary part: the parts
//! themselves, or the radial and the tangential part in the direction of the measured value. The
//! standard uncertainty of the radial part is that of the modulus, and of the tangential one the
//! modulus times that of the phase, so that no phase is wrapped (first order: the radial row
//! neglects half the square of a phase residual in radians).

use super::Curve;
use super::curve::Differentiated;
use super::error::{Coordinate, RegressionError};
use super::points::{Points, Spread};
use super::result::{Regression, product};
use crate::linalg::{dot, packed};
use crate::number::elementary::{atan2, cos, hypot, sin};

/// How complex values are stated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ComplexForm {
    /// Real part, then imaginary part.
    Cartesian,
    /// Modulus, then phase in radians.
    Polar,
}

/// Uncertainties of both parts of complex values, of the phase in radians.
#[derive(Clone, Debug, PartialEq)]
pub enum ComplexSpread {
    /// A common standard uncertainty of real and imaginary part is estimated from the residuals.
    None,
    /// Standard uncertainties of the first and of the second part of each point, and the
    /// correlation coefficients of both; different points are independent.
    Each([Vec<f64>; 2], Vec<f64>),
    /// The lower triangle of the covariance matrix of all first parts, then all second parts, row by
    /// row.
    Joint(Vec<f64>),
}

/// A point beside a complex curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComplexResidual {
    /// The abscissa.
    pub x: f64,
    /// Real and imaginary part of the point.
    pub value: [f64; 2],
    /// Real and imaginary part of point / curve - 1: to first order the relative difference of the
    /// moduli, and the difference of the phases in radians.
    pub relative: [f64; 2],
    /// The covariance matrix of both parts of `relative` by the stated uncertainties of the point;
    /// `None` if none are stated.
    pub covariance: Option<[[f64; 2]; 2]>,
}

/// A complex curve at an abscissa.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolarValue {
    /// Its modulus.
    pub modulus: f64,
    /// The standard uncertainty of the modulus.
    pub modulus_uncertainty: f64,
    /// Its phase in radians, from -pi to pi.
    pub phase: f64,
    /// The standard uncertainty of the phase in radians.
    pub phase_uncertainty: f64,
}

impl ComplexResidual {
    /// The relative difference of the moduli of point and curve.
    pub fn modulus(&self) -> f64 {
        hypot(1.0 + self.relative[0], self.relative[1]) - 1.0
    }

    /// The phase of the point minus the phase of the curve in radians, from -pi to pi.
    pub fn phase(&self) -> f64 {
        atan2(self.relative[1], 1.0 + self.relative[0])
    }
}

impl Points {
    /// Points with complex ordinates and exact abscissae; `values` are both parts of them. A modulus
    /// is positive.
    ///
    /// # Errors
    /// Another number of values or uncertainties than of abscissae, or a correlation coefficient
    /// that is not between -1 and 1.
    pub fn complex(
        x: &[f64],
        form: ComplexForm,
        values: [&[f64]; 2],
        spread: ComplexSpread,
    ) -> Result<Self, RegressionError> {
        let n = x.len();
        let length = |found: usize, expected: usize| match found == expected {
            true => Ok(()),
            false => Err(RegressionError::Length { coordinate: Coordinate::Y, expected, found }),
        };
        for values in values {
            length(values.len(), n)?;
        }
        let [first, second] = values;
        let mut parts = vec![[1.0, 0.0]; n];
        parts.resize(2 * n, [0.0, 1.0]);
        let mut y = values.concat();
        // the length along the second part for a unit of it
        let mut scales = vec![1.0; n];
        if form == ComplexForm::Polar {
            for (i, (modulus, phase)) in first.iter().zip(second).enumerate() {
                let (c, s) = (cos(*phase), sin(*phase));
                (parts[i], parts[n + i]) = ([c, s], [-s, c]);
                // a phase that is not finite makes the row so
                (y[n + i], scales[i]) = (0.0 * phase, *modulus);
            }
        }
        let of_y = match spread {
            ComplexSpread::None => Spread::None,
            ComplexSpread::Each([mut variances, second], correlations) => {
                for found in [variances.len(), second.len(), correlations.len()] {
                    length(found, n)?;
                }
                for i in 0..n {
                    let (u, v, r) = (variances[i], scales[i] * second[i], correlations[i]);
                    if r.is_nan() || r.abs() >= 1.0 {
                        let coordinate = Some(Coordinate::Y);
                        return Err(RegressionError::NotDefinite { coordinate, point: i });
                    }
                    if r != 0.0 && u > 0.0 {
                        // the second row without what the first one says of it
                        let share = r * v / u;
                        let own = parts[i];
                        parts[n + i].iter_mut().zip(own).for_each(|(of, own)| *of -= share * own);
                        y[n + i] -= share * y[i];
                    }
                    variances[i] = u * u;
                    variances.push(v * v * (1.0 - r * r));
                }
                Spread::Each(variances)
            }
            ComplexSpread::Joint(mut lower) => {
                length(lower.len(), packed::triangle(2 * n))?;
                let scale = |row: usize| row.checked_sub(n).map_or(1.0, |point| scales[point]);
                for i in 0..2 * n {
                    for j in 0..=i {
                        lower[packed::triangle(i) + j] *= scale(i) * scale(j);
                    }
                }
                Spread::Joint(lower)
            }
        };
        Ok(Self { parts, ..Self::new(x.repeat(2), y).with_y(of_y) })
    }

    /// Whether the ordinates are complex.
    pub fn is_complex(&self) -> bool {
        !self.parts.is_empty()
    }

    /// The number of points.
    pub fn count(&self) -> usize {
        if self.is_complex() { self.len() / 2 } else { self.len() }
    }

    /// A complex ordinate: its parts, and their covariance matrix if one is stated.
    fn complex_ordinate(&self, point: usize) -> ([f64; 2], Option<[[f64; 2]; 2]>) {
        let rows = [point, self.count() + point];
        let [[a, b], [c, d]] = rows.map(|row| self.parts[row]);
        // the rows are a rotation with a shear, so that the determinant is 1
        let solved = |[p, q]: [f64; 2]| [d * p - b * q, a * q - c * p];
        let value = solved(rows.map(|row| self.y[row]));
        let [p, q] = rows;
        let matrix = match &self.of_y {
            Spread::None => return (value, None),
            Spread::Each(variances) => [[variances[p], 0.0], [0.0, variances[q]]],
            Spread::Joint(lower) => {
                let at = |i: usize, j: usize| lower[packed::triangle(i) + j];
                [[at(p, p), at(q, p)], [at(q, p), at(q, q)]]
            }
        };
        // both sides of the matrix, one after the other
        let [left, right] = matrix.map(solved);
        (value, Some([solved([left[0], right[0]]), solved([left[1], right[1]])]))
    }
}

impl Regression {
    /// Whether the curve is complex.
    pub fn is_complex(&self) -> bool {
        self.curve.is_complex()
    }

    /// Real and imaginary part of a complex curve at x with these parameters, in their units.
    pub fn complex_value(&self, x: f64, parameters: &[f64]) -> [f64; 2] {
        self.curve.parts(x, parameters)
    }

    /// Real and imaginary part of a complex curve at x, and the derivatives of both with respect to
    /// each parameter; NaN for a real curve.
    pub fn complex_gradient(&self, x: f64) -> ([f64; 2], Vec<[f64; 2]>) {
        let [mut re, mut im] = [(); 2].map(|()| vec![f64::NAN; self.count()]);
        let Curve::Program(program) = &self.curve else {
            return ([f64::NAN; 2], re.into_iter().zip(im).map(|(re, im)| [re, im]).collect());
        };
        let mut program = Differentiated::of(program);
        let values = program.outputs(x, &self.estimates, [&mut re, &mut im]);
        let each = re.into_iter().zip(im).map(|(re, im)| [re, im]).collect();
        (values.map(|(value, _)| value), each)
    }

    /// The covariance matrix of the parameters, row by row.
    pub fn covariance_matrix(&self) -> &[f64] {
        &self.covariance
    }

    /// Modulus and phase of a complex curve at x with their standard uncertainties.
    pub fn polar_at(&self, x: f64) -> PolarValue {
        let ([re, im], each) = self.complex_gradient(x);
        let modulus = hypot(re, im);
        // derivatives of the logarithm: of the relative modulus, and of the phase
        let of_log = |part: usize| {
            let derivatives: Vec<f64> =
                each.iter().map(|derivative| quotient(*derivative, [re, im])[part]).collect();
            dot(&derivatives, &product(&self.covariance, &derivatives)).max(0.0).sqrt()
        };
        PolarValue {
            modulus,
            modulus_uncertainty: modulus * of_log(0),
            phase: atan2(im, re),
            phase_uncertainty: of_log(1),
        }
    }

    /// The points of a complex curve beside it; none for a real curve.
    pub fn complex_residuals(&self) -> Vec<ComplexResidual> {
        let points = &*self.points;
        let count = if points.is_complex() { points.count() } else { 0 };
        let beside = |point: usize| {
            let (x, (value, covariance)) = (points.x[point], points.complex_ordinate(point));
            let curve = self.complex_value(x, &self.estimates);
            let [re, im] = quotient(value, curve);
            // both sides of the matrix over the curve
            let relative = |matrix: [[f64; 2]; 2]| {
                let [left, right] = matrix.map(|row| quotient(row, curve));
                [quotient([left[0], right[0]], curve), quotient([left[1], right[1]], curve)]
            };
            let covariance = covariance.map(relative);
            ComplexResidual { x, value, relative: [re - 1.0, im], covariance }
        };
        (0..count).map(beside).collect()
    }
}

/// A quotient of complex numbers.
fn quotient([a, b]: [f64; 2], [re, im]: [f64; 2]) -> [f64; 2] {
    let square = re * re + im * im;
    [(a * re + b * im) / square, (b * re - a * im) / square]
}
