//! Functions of several numbers that are not operations: interpolation in a table, the root of an
//! equation.

use std::fmt::Debug;

use super::COLUMN;

/// A function that a program calls as one step, with its derivatives.
///
/// Where it is undefined it returns NaN, and [`Routine::undefined`] gives the reason.
pub trait Routine: Debug + Send + Sync {
    /// The name in formulas and messages.
    fn name(&self) -> &'static str;

    /// The value at some operands.
    fn value(&self, operands: &[f64]) -> f64;

    /// The partial derivatives with respect to the operands, where the value is `value`; as many
    /// numbers as operands.
    fn slopes(&self, operands: &[f64], value: f64) -> Vec<f64>;

    /// Why the function is undefined at these operands, in words.
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
