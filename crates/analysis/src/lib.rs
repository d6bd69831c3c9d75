//! What is made of evaluations: the audit of assumptions, comparisons of results, what changed
//! between two evaluations, calibration certificates, and published values recomputed.

#![deny(unsafe_code)]

pub mod assumptions;
pub mod certificate;
pub mod compare;
pub mod diff;
pub mod verification;
