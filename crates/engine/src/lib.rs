//! Measurement uncertainty: the law of propagation (JCGM 100) and the Monte Carlo method
//! (JCGM 101) side by side.

#![cfg_attr(test, allow(clippy::disallowed_methods))] // tests compare within tolerances
#![deny(unsafe_code)]

pub mod decimal;
pub mod distribution;
pub mod fact;
pub mod linalg;
pub mod model;
pub mod number;
pub mod parallel;
pub mod propagate;
pub mod regression;
pub mod special;
pub mod task;
pub mod threads;
