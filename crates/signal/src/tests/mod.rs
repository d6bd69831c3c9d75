//! Fits against independent least squares, and studies of simulated recordings with known truth.

mod least_squares;
mod observations;
mod refusals;
pub(crate) mod simulated;
mod study;
mod through_steps;
