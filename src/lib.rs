//! gumption
#![deny(unsafe_code)]
#[cfg(feature = "cli")]
pub mod command;
pub mod distribution;
pub mod file;
pub mod model;
pub mod number;
pub mod propagate;
pub mod report;
pub mod task;
pub mod unit;
