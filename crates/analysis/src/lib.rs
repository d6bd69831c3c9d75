//! What is made of evaluations: comparisons of results, what changed between two evaluations, plans
//! towards a wanted uncertainty, calibration certificates, and published values recomputed.

#![cfg_attr(test, allow(clippy::disallowed_methods))] // tests compare within tolerances
#![deny(unsafe_code)]

pub mod certificate;
pub mod compare;
pub mod diff;
pub mod plan;
pub mod verification;
