//! Oscillations fitted to samples: by least squares, by the bins of a Fourier transform, and what
//! they leave.

pub(super) mod coloured;
pub(super) mod common_noise;
pub(super) mod dirichlet;
pub(super) mod drift;
pub(super) mod frequency;
pub(super) mod lattice;
pub(super) mod outlying;
pub(super) mod periodic;
pub(super) mod polar;
pub(super) mod quantization;
pub(super) mod residuals;
pub(super) mod rounding;
pub(super) mod sine_fit;
pub(super) mod spurious;
pub(super) mod turns;
pub(super) mod whole_periods;
