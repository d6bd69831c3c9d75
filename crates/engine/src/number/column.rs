//! Columns: many trials at once.
//!
//! An operation runs over a whole column in one plain loop without branches, which the compiler
//! turns into vector instructions with the width of the code path ([`super::path`]). The element's
//! arithmetic is that of `scalar`, so a trial has the same bits as a single number.

use super::{Binary, Unary, elementary, scalar};

/// Trials in a column. With two dozen live columns a model stays within the first-level cache.
pub const COLUMN: usize = 128;

/// One quantity's values in [`COLUMN`] trials.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Column(pub [f64; COLUMN]);

impl Column {
    /// A column of zeros.
    pub const ZERO: Self = Self([0.0; COLUMN]);
}

/// An operand of a step over columns: a register, or a number that is the same in all trials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Operand {
    Register(usize),
    Constant(f64),
}

/// `registers[out] = operation(registers[x])`; `x` and `out` differ.
#[inline(always)]
pub(crate) fn apply_unary(registers: &mut [Column], operation: Unary, x: usize, out: usize) {
    let Ok([x, out]) = registers.get_disjoint_mut([x, out]) else {
        unreachable!("a step writes to a register of its own");
    };
    let (x, out) = (&x.0, &mut out.0);
    match operation {
        Unary::Negate => map(x, out, |x| scalar::unary(Unary::Negate, x)),
        Unary::Abs => map(x, out, |x| scalar::unary(Unary::Abs, x)),
        Unary::Sqrt => map(x, out, |x| scalar::unary(Unary::Sqrt, x)),
        Unary::Exp => map(x, out, |x| scalar::unary(Unary::Exp, x)),
        Unary::Ln => map(x, out, |x| scalar::unary(Unary::Ln, x)),
        Unary::Sin => elementary::sin_column(x, out),
        Unary::Cos => elementary::cos_column(x, out),
        _ => map_called(x, out, operation),
    }
}

/// The sine and the cosine of the same angles; the three registers differ.
#[inline(always)]
pub(crate) fn apply_sin_cos(registers: &mut [Column], x: usize, sin: usize, cos: usize) {
    let Ok([x, sin, cos]) = registers.get_disjoint_mut([x, sin, cos]) else {
        unreachable!("a step writes to registers of its own");
    };
    elementary::sin_cos_column(&x.0, &mut sin.0, &mut cos.0);
}

/// `registers[out] = operation(x, y)`; `out` differs from both operands.
#[inline(always)]
pub(crate) fn apply_binary(
    registers: &mut [Column],
    operation: Binary,
    x: Operand,
    y: Operand,
    out: usize,
) {
    match operation {
        Binary::Add => zip(registers, x, y, out, |x, y| x + y),
        Binary::Subtract => zip(registers, x, y, out, |x, y| x - y),
        Binary::Multiply => zip(registers, x, y, out, |x, y| x * y),
        Binary::Divide => zip(registers, x, y, out, |x, y| x / y),
        Binary::Hypot => {
            zip(registers, x, y, out, |x, y| scalar::binary(Binary::Hypot, x, y));
        }
        Binary::Min => zip(registers, x, y, out, |x, y| scalar::binary(Binary::Min, x, y)),
        Binary::Max => zip(registers, x, y, out, |x, y| scalar::binary(Binary::Max, x, y)),
        _ => zip_called(registers, operation, x, y, out),
    }
}

#[inline(always)]
fn map(x: &[f64; COLUMN], out: &mut [f64; COLUMN], f: impl Fn(f64) -> f64) {
    for i in 0..COLUMN {
        out[i] = f(x[i]);
    }
}

#[inline(always)]
fn zip(registers: &mut [Column], x: Operand, y: Operand, out: usize, f: impl Fn(f64, f64) -> f64) {
    use Operand::{Constant, Register};
    match (x, y) {
        (Register(x), Register(y)) if x == y => {
            let Ok([x, out]) = registers.get_disjoint_mut([x, out]) else {
                unreachable!("a step writes to a register of its own");
            };
            map(&x.0, &mut out.0, |x| f(x, x));
        }
        (Register(x), Register(y)) => {
            let Ok([x, y, out]) = registers.get_disjoint_mut([x, y, out]) else {
                unreachable!("a step writes to a register of its own");
            };
            for i in 0..COLUMN {
                out.0[i] = f(x.0[i], y.0[i]);
            }
        }
        (Register(x), Constant(y)) => {
            let Ok([x, out]) = registers.get_disjoint_mut([x, out]) else {
                unreachable!("a step writes to a register of its own");
            };
            map(&x.0, &mut out.0, |x| f(x, y));
        }
        (Constant(x), Register(y)) => {
            let Ok([y, out]) = registers.get_disjoint_mut([y, out]) else {
                unreachable!("a step writes to a register of its own");
            };
            map(&y.0, &mut out.0, |y| f(x, y));
        }
        (Constant(x), Constant(y)) => registers[out].0.fill(f(x, y)),
    }
}

/// Rare operations, with one call for each element.
#[inline(never)]
fn map_called(x: &[f64; COLUMN], out: &mut [f64; COLUMN], operation: Unary) {
    map(x, out, |x| scalar::unary(operation, x));
}

#[inline(never)]
fn zip_called(registers: &mut [Column], operation: Binary, x: Operand, y: Operand, out: usize) {
    zip(registers, x, y, out, |x, y| scalar::binary(operation, x, y));
}
