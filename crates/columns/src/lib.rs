//! Columns of numbers in files: recordings as streams of blocks, the units of headings, separators and
//! decimal marks.
//!
//! This is a crate of its own because code that reads millions of numbers must be fast in every
//! build.

#![cfg_attr(test, allow(clippy::disallowed_methods))] // tests compare within tolerances

pub mod gravity;
pub mod heading;
pub mod read_failure;
pub mod recording;
pub mod separator;

/// The kind of a number with a unit, which decides whether conversions shift zeros of scales.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueOf {
    /// A quantity: 20 degC is 293.15 K.
    Quantity,
    /// A difference or a width: 20 degC is 20 K.
    Difference,
    /// A quantity or a difference, which cannot be told: for example a limit of an output in degC.
    Either,
}
