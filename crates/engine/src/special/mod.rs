//! Special functions behind coverage factors and quantiles.
//!
//! - [`normal`]: the standard normal distribution, both tails down to the smallest doubles;
//! - [`student`]: Student's t with real degrees of freedom, and the two-sided coverage factor;
//! - [`gamma`]: the regularized incomplete gamma function and its inverse;
//! - [`beta`]: the regularized incomplete beta function and its inverse.
//!
//! Invalid arguments (a NaN, a probability outside \[0, 1\], a shape that is not positive) give
//! NaN; the probabilities 0 and 1 give the exact ends of the support. Every iteration has a fixed
//! bound. Elementary functions come from `libm`, so that results have the same bits on every
//! machine.
//!
//! Incomplete gamma and beta functions share one design. The distribution function is the weight
//! x^a e^(-x) / Γ(a), or x^a (1 - x)^b / B(a, b), times the integral of a ratio that is 1 at its
//! start. The weight is in the saddle-point form of Loader 2000, which does not cancel for large
//! shapes (`weight`). The integral is a series of positive terms for small shapes and a Gauss
//! quadrature in a logarithmic variable for large ones (`quadrature`). The tail on the near side
//! of the mean is the one computed, so a small probability keeps its relative accuracy. Quantiles
//! are roots in log-log coordinates, bracketed (`root`).

pub mod beta;
pub mod gamma;
pub(crate) mod legendre;
pub mod normal;
mod quadrature;
#[cfg(test)]
mod reference;
pub(crate) mod root;
pub mod student;
pub(crate) mod tails;
mod weight;

pub(crate) use weight::ln_1p_minus;
