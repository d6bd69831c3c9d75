//! Uses of evaluations: comparisons of results, differences between two evaluations, plans for a
//! target uncertainty, calibration certificates, and recomputed published values.

#![cfg_attr(test, allow(clippy::disallowed_methods))] // tests compare within tolerances
#![deny(unsafe_code)]

pub mod capability_line;
pub mod certificate;
pub mod compare;
pub mod diff;
pub mod plan;
pub mod verification;
