//! Calibration functions: curves fitted to points, with the uncertainties of both coordinates
//! (ISO/TS 28037 straight lines, ISO/TS 28038 polynomials, and formulas by non-linear least squares).
//!
//! All of them are one problem: find the parameters and the true abscissae that minimize the
//! weighted sum of squares of all residuals, by the Gauss-Newton method with the abscissae
//! eliminated. A polynomial is fitted in Chebyshev polynomials over the range of its abscissae,
//! which keeps the digits that its power coefficients lose; the covariance matrix is converted. A
//! complex point is two real rows of the same least squares.
//!
//! ```
//! use std::sync::Arc;
//! use gumption_engine::regression::{Curve, Points, Regression, Spread};
//!
//! // ISO/TS 28037, clause 6, equal weights
//! let points = Points::new(
//!     vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
//!     vec![3.3, 5.6, 7.1, 9.3, 10.7, 12.1],
//! )
//! .with_y(Spread::Each(vec![0.25; 6]));
//! let line = Regression::of("line", &Curve::polynomial(1), &Arc::new(points), &[])?;
//! assert!((line.estimate(0) - 1.8667).abs() < 5e-5);
//! assert!((line.standard_uncertainty(1) - 0.1195).abs() < 5e-5);
//! # Ok::<(), gumption_engine::regression::RegressionError>(())
//! ```

mod chebyshev;
mod complex;
mod curve;
mod degree;
mod error;
mod function;
mod least_squares;
mod points;
mod refit;
mod result;
mod solver;
#[cfg(test)]
mod tests;

pub use complex::{ComplexForm, ComplexResidual, ComplexSpread, PolarValue};
pub use curve::Curve;
pub use degree::{DegreeChoice, choose_degree};
pub use error::{Coordinate, RegressionError};
pub use function::CurveFunction;
pub use points::{Cross, Points, Spread};
pub(crate) use refit::Refit;
pub use result::Regression;
