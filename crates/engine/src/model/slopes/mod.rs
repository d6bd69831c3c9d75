//! A program made ready for the values and the partial derivatives of many rows at once.
//!
//! Rows stand in columns as trials do, and derivatives go forward with the values, for each
//! operation only those that are not zero by construction. What is the same in all rows is computed
//! once. Every result has the bits of [`Program::gradients`] with dual numbers.

mod build;
mod registers;

use super::program::Program;
use crate::number::derivative;
use crate::number::derivative::chain;
use crate::number::{
    Binary, COLUMN, Column, Operand, Unary, apply_binary, apply_sin_cos, apply_unary,
};

/// One step over columns: on values, on derivatives of operations (which lie beside the values), or
/// on derivatives by variables.
#[derive(Clone, Copy, Debug)]
enum SlopeStep {
    Unary(Unary, usize, usize),
    Binary(Binary, Operand, Operand, usize),
    SinCos {
        angle: usize,
        sin: usize,
        cos: usize,
    },
    /// The derivative of an operation at `x`, where its result is `y`.
    SlopeOfUnary {
        operation: Unary,
        x: usize,
        y: usize,
        slope: usize,
    },
    /// The derivatives of an operation by both operands.
    SlopesOfBinary {
        operation: Binary,
        x: usize,
        y: usize,
        value: usize,
        slopes: [usize; 2],
    },
    /// The derivative through an operation of one operand that depends on the variable.
    Chain {
        gradient: usize,
        slope: usize,
        out: usize,
    },
    /// The derivative through an operation of two operands that depend on it.
    ChainTwo {
        gradients: [usize; 2],
        slopes: [usize; 2],
        out: usize,
    },
    /// The derivative of the operand that `min`, `max` or a choice takes.
    Choose {
        operation: Binary,
        x: usize,
        y: usize,
        gradients: [usize; 2],
        out: usize,
    },
}

/// An output's value and its derivatives by the variables that it depends on. Registers of values
/// and of derivatives are counted apart.
#[derive(Clone, Debug)]
pub(crate) struct Slope {
    pub(crate) value: Operand,
    pub(crate) gradient: Vec<(usize, Operand)>,
}

/// A program over columns of rows, with derivatives.
#[derive(Clone, Debug)]
pub(crate) struct Slopes {
    steps: Vec<SlopeStep>,
    /// Numbers of registers: of values, of derivatives.
    registers: [usize; 2],
    /// Registers that hold the same number all the time, of values and of derivatives.
    filled: [Vec<(usize, f64)>; 2],
    /// The variables that vary between rows, with their registers.
    pub(crate) varying: Vec<(usize, usize)>,
    pub outputs: Vec<Slope>,
}

/// The columns of one thread.
#[derive(Debug)]
pub(crate) struct Columns {
    pub(crate) values: Vec<Column>,
    pub(crate) gradients: Vec<Column>,
}

impl Slopes {
    /// `same[v]` is the value of variable `v` where it is the same in all rows; derivatives are taken
    /// by the first `wanted` variables. `None` where dual numbers are not the way of this program
    /// ([`Program::goes_backward`]) or the columns would need too much memory.
    pub(crate) fn new(program: &Program, same: &[Option<f64>], wanted: usize) -> Option<Self> {
        build::build(program, same, wanted)
    }

    pub(crate) fn columns(&self) -> Columns {
        let make = |arena: usize| {
            let mut columns = vec![Column::ZERO; self.registers[arena]];
            for &(register, value) in &self.filled[arena] {
                columns[register].0.fill(value);
            }
            columns
        };
        Columns { values: make(0), gradients: make(1) }
    }

    /// Runs all steps on one column of rows.
    #[inline(always)]
    pub(crate) fn run(&self, columns: &mut Columns) {
        let Columns { values, gradients } = columns;
        for step in &self.steps {
            match *step {
                SlopeStep::Unary(operation, x, out) => apply_unary(values, operation, x, out),
                SlopeStep::Binary(operation, x, y, out) => {
                    apply_binary(values, operation, x, y, out)
                }
                SlopeStep::SinCos { angle, sin, cos } => apply_sin_cos(values, angle, sin, cos),
                SlopeStep::SlopeOfUnary { operation, x, y, slope } => {
                    slope_of_unary(values, operation, [x, y], slope);
                }
                SlopeStep::SlopesOfBinary { operation, x, y, value, slopes } => {
                    slopes_of_binary(values, operation, [x, y, value], slopes);
                }
                SlopeStep::Chain { gradient, slope, out } => {
                    let slope = &values[slope].0;
                    let ([gradient, _], out) = apart(gradients, [gradient; 2], out);
                    for i in 0..COLUMN {
                        out[i] = chain(gradient[i], slope[i]);
                    }
                }
                SlopeStep::ChainTwo { gradients: of, slopes: [by_x, by_y], out } => {
                    let (by_x, by_y) = (&values[by_x].0, &values[by_y].0);
                    let ([first, second], out) = apart(gradients, of, out);
                    for i in 0..COLUMN {
                        out[i] = chain(first[i], by_x[i]) + chain(second[i], by_y[i]);
                    }
                }
                SlopeStep::Choose { operation, x, y, gradients: of, out } => {
                    let (x, y) = (&values[x].0, &values[y].0);
                    let (of, out) = apart(gradients, of, out);
                    choose(operation, [x, y], of, out);
                }
            }
        }
    }
}

/// Two registers to read, which may be one, and another to write.
#[inline(always)]
fn apart(
    registers: &mut [Column],
    [x, y]: [usize; 2],
    out: usize,
) -> ([&[f64; COLUMN]; 2], &mut [f64; COLUMN]) {
    if x == y {
        let Ok([x, out]) = registers.get_disjoint_mut([x, out]) else {
            unreachable!("a step writes to a register of its own");
        };
        return ([&x.0, &x.0], &mut out.0);
    }
    let Ok([x, y, out]) = registers.get_disjoint_mut([x, y, out]) else {
        unreachable!("a step writes to a register of its own");
    };
    ([&x.0, &y.0], &mut out.0)
}

#[inline(always)]
fn slope_of_unary(values: &mut [Column], operation: Unary, of: [usize; 2], out: usize) {
    let ([x, y], out) = apart(values, of, out);
    let mut each = |f: fn(f64, f64) -> f64| {
        for i in 0..COLUMN {
            out[i] = f(x[i], y[i]);
        }
    };
    match operation {
        Unary::Abs => each(|x, y| derivative::unary(Unary::Abs, x, y)),
        Unary::Sqrt => each(|x, y| derivative::unary(Unary::Sqrt, x, y)),
        Unary::Ln => each(|x, y| derivative::unary(Unary::Ln, x, y)),
        _ => {
            for i in 0..COLUMN {
                out[i] = derivative::unary(operation, x[i], y[i]);
            }
        }
    }
}

#[inline(always)]
fn slopes_of_binary(
    values: &mut [Column],
    operation: Binary,
    [x, y, value]: [usize; 3],
    slopes: [usize; 2],
) {
    for i in 0..COLUMN {
        let [x, y, value] = [x, y, value].map(|register| values[register].0[i]);
        let both = derivative::binary(operation, x, y, value);
        for (register, slope) in slopes.into_iter().zip(both) {
            values[register].0[i] = slope;
        }
    }
}

#[inline(always)]
fn choose(
    operation: Binary,
    [x, y]: [&[f64; COLUMN]; 2],
    [first, second]: [&[f64; COLUMN]; 2],
    out: &mut [f64; COLUMN],
) {
    for i in 0..COLUMN {
        let [by_first, by_second] = derivative::binary(operation, x[i], y[i], 0.0);
        let taken = if by_first != 0.0 { first[i] } else { second[i] };
        out[i] = if by_first == 0.0 && by_second == 0.0 { 0.0 } else { chain(taken, 1.0) };
    }
}

#[cfg(test)]
mod tests;
