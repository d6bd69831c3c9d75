//! Assignment of registers: one is free again once nothing more reads it, so that few columns are in
//! use at a time.

use super::{SlopeStep, Slopes};
use crate::number::Operand;

/// Values and derivatives of operations lie apart from derivatives by variables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Arena {
    Values = 0,
    Gradients = 1,
}

impl SlopeStep {
    /// Shows every register of the step: those that are read, then those that are written (`true`).
    fn registers(&mut self, mut see: impl FnMut(Arena, &mut usize, bool)) {
        use Arena::{Gradients, Values};
        match self {
            Self::Unary(_, x, out) => {
                see(Values, x, false);
                see(Values, out, true);
            }
            Self::Binary(_, x, y, out) => {
                for operand in [x, y] {
                    if let Operand::Register(register) = operand {
                        see(Values, register, false);
                    }
                }
                see(Values, out, true);
            }
            Self::SinCos { angle, sin, cos } => {
                see(Values, angle, false);
                see(Values, sin, true);
                see(Values, cos, true);
            }
            Self::SlopeOfUnary { x, y, slope, .. } => {
                see(Values, x, false);
                see(Values, y, false);
                see(Values, slope, true);
            }
            Self::SlopesOfBinary { x, y, value, slopes: [by_x, by_y], .. } => {
                for read in [x, y, value] {
                    see(Values, read, false);
                }
                see(Values, by_x, true);
                see(Values, by_y, true);
            }
            Self::Chain { gradient, slope, out } => {
                see(Gradients, gradient, false);
                see(Values, slope, false);
                see(Gradients, out, true);
            }
            Self::ChainTwo { gradients, slopes, out } => {
                gradients.iter_mut().for_each(|register| see(Gradients, register, false));
                slopes.iter_mut().for_each(|register| see(Values, register, false));
                see(Gradients, out, true);
            }
            Self::Choose { x, y, gradients, out, .. } => {
                see(Values, x, false);
                see(Values, y, false);
                gradients.iter_mut().for_each(|register| see(Gradients, register, false));
                see(Gradients, out, true);
            }
        }
    }
}

/// Numbers the registers again, as few of them as the steps need at a time.
pub(super) fn assign(mut slopes: Slopes) -> Slopes {
    /// Never free again.
    const ALWAYS: usize = usize::MAX;
    let mut last: [Vec<usize>; 2] = slopes.registers.map(|count| vec![0; count]);
    for (number, step) in slopes.steps.iter_mut().enumerate() {
        // what nothing reads is free after the step that writes it
        step.registers(|arena, register, _| last[arena as usize][*register] = number);
    }
    for (arena, filled) in slopes.filled.iter().enumerate() {
        for &(register, _) in filled {
            last[arena][register] = ALWAYS;
        }
    }
    for output in &slopes.outputs {
        let gradient = output.gradient.iter().map(|(_, operand)| (1, *operand));
        for (arena, operand) in gradient.chain([(0, output.value)]) {
            if let Operand::Register(register) = operand {
                last[arena][register] = ALWAYS;
            }
        }
    }

    let mut assigned: [Vec<usize>; 2] = slopes.registers.map(|count| vec![usize::MAX; count]);
    let mut free: [Vec<usize>; 2] = [Vec::new(), Vec::new()];
    let mut count = [0; 2];
    let mut take = |free: &mut [Vec<usize>; 2], arena: usize| {
        free[arena].pop().unwrap_or_else(|| {
            count[arena] += 1;
            count[arena] - 1
        })
    };
    for (_, register) in &mut slopes.varying {
        assigned[0][*register] = take(&mut free, 0);
        *register = assigned[0][*register];
    }
    for (arena, filled) in slopes.filled.iter_mut().enumerate() {
        for (register, _) in filled {
            assigned[arena][*register] = take(&mut free, arena);
            *register = assigned[arena][*register];
        }
    }
    for (number, step) in slopes.steps.iter_mut().enumerate() {
        let mut ended: Vec<(usize, usize)> = Vec::new();
        step.registers(|arena, register, written| {
            let (arena, of) = (arena as usize, *register);
            if written {
                assigned[arena][of] = take(&mut free, arena);
            }
            *register = assigned[arena][of];
            if last[arena][of] == number && !ended.contains(&(arena, *register)) {
                ended.push((arena, *register));
            }
        });
        for (arena, register) in ended {
            free[arena].push(register);
        }
    }
    let placed = |arena: usize, operand: &mut Operand| {
        if let Operand::Register(register) = operand {
            *register = assigned[arena][*register];
        }
    };
    for output in &mut slopes.outputs {
        placed(0, &mut output.value);
        output.gradient.iter_mut().for_each(|(_, operand)| placed(1, operand));
    }
    slopes.registers = count;
    slopes
}
