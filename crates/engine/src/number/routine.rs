//! Functions of several numbers that are no operation: a table's interpolation, the root of an
//! equation.

use std::fmt::Debug;

use super::COLUMN;

/// A function that a program calls as one step, with its derivatives.
///
/// Where it has no value it gives a NaN, and [`Routine::undefined`] says why.
pub trait Routine: Debug + Send + Sync {
    /// The name that formulas and messages use.
    fn name(&self) -> &'static str;

    /// The value at some operands.
    fn value(&self, operands: &[f64]) -> f64;

    /// What the value changes by with each operand, where it is `value`; as many numbers as
    /// operands.
    fn slopes(&self, operands: &[f64], value: f64) -> Vec<f64>;

    /// Why there is no value at these operands, in words.
    fn undefined(&self, operands: &[f64]) -> String;

    /// The values of a column of trials, each with the bits of [`Routine::value`].
    fn column(&self, operands: &[[f64; COLUMN]], out: &mut [f64; COLUMN]) {
        let mut each = vec![0.0; operands.len()];
        for (trial, out) in out.iter_mut().enumerate() {
            for (value, operand) in each.iter_mut().zip(operands) {
                *value = operand[trial];
            }
            *out = self.value(&each);
        }
    }
}
