//! What is made of evaluations: the audit of assumptions, comparisons of results, what changed
//! between two evaluations, and calibration certificates.

#![deny(unsafe_code)]

pub mod assumptions;
pub mod certificate;
pub mod compare;
pub mod diff;
