//! Columns of numbers in files: recordings as streams of blocks, the units of headings, separators and
//! decimal marks.
//!
//! Apart from the files that describe a measurement, since what reads millions of numbers has to be fast
//! in every build.

#![cfg_attr(test, allow(clippy::disallowed_methods))] // tests compare within tolerances

pub mod gravity;
pub mod heading;
pub mod recording;
pub mod separator;

/// What a number with a unit is about, which decides whether zeros of scales are counted from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueOf {
    /// A quantity: 20 degC is 293.15 K.
    Quantity,
    /// A difference or a width: 20 degC is 20 K.
    Difference,
    /// A quantity or a difference, which nothing here tells: of a limit of an output in degC.
    Either,
}
