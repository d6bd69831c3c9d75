//! A program made ready for columns of trials: what is constant is computed once, what no output
//! needs is dropped, and every remaining step has registers to read from and to write to.

use super::program::{Node, Program};
use std::sync::Arc;

use crate::number::{
    Binary, COLUMN, Column, Number, Operand, Routine, Unary, apply_binary, apply_sin_cos,
    apply_unary,
};

/// One step over columns.
#[derive(Clone, Copy, Debug)]
enum Step {
    Unary(Unary, usize, usize),
    Binary(Binary, Operand, Operand, usize),
    SinCos {
        angle: usize,
        sin: usize,
        cos: usize,
    },
    /// The routine of this number.
    Routine(usize),
}

/// A call of a function of several numbers.
#[derive(Clone, Debug)]
struct ScheduledRoutine {
    routine: Arc<dyn Routine>,
    operands: Vec<Operand>,
    out: usize,
}

/// Where an output's column is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ScheduledOutput {
    /// In this register.
    Register(usize),
    /// The output is the same in all trials.
    Constant(f64),
}

/// A program over columns.
#[derive(Clone, Debug)]
pub struct Schedule {
    steps: Vec<Step>,
    routines: Vec<ScheduledRoutine>,
    /// Number of registers, those of the varying variables first.
    pub registers: usize,
    /// For each varying variable, in order, whether an output depends on it.
    pub used: Vec<bool>,
    /// Where each output is found after a run.
    pub outputs: Vec<ScheduledOutput>,
}

impl Schedule {
    /// `bound[v]` is the value of variable `v` where it is the same in all trials; the other
    /// variables arrive in registers 0, 1, 2, … in their order.
    pub fn new(program: &Program, bound: &[Option<f64>]) -> Self {
        Self::with_variables(program, bound, false)
    }

    /// The same; the registers of the variables are never written to, so that one set of values can
    /// be used again.
    pub fn keeping_variables(program: &Program, bound: &[Option<f64>]) -> Self {
        Self::with_variables(program, bound, true)
    }

    fn with_variables(program: &Program, bound: &[Option<f64>], keep: bool) -> Self {
        let folded = fold(program, bound);
        let needed = program.needed_by(&folded, program.outputs.iter().copied());
        let mut register_of_variable = vec![usize::MAX; program.variables];
        let mut registers = 0;
        for (v, slot) in register_of_variable.iter_mut().enumerate() {
            if bound.get(v).copied().flatten().is_none() {
                *slot = registers;
                registers += 1;
            }
        }

        let mut used = vec![false; registers];
        for (index, node) in program.nodes.iter().enumerate() {
            if let Node::Variable(v) = *node
                && needed[index]
                && folded[index].is_none()
            {
                used[register_of_variable[v]] = true;
            }
        }

        let mut last_use = last_uses(program, &folded, &needed);
        for &output in &program.outputs {
            last_use[output] = usize::MAX;
        }
        if keep {
            for (last, node) in last_use.iter_mut().zip(&program.nodes) {
                if matches!(node, Node::Variable(_)) {
                    *last = usize::MAX;
                }
            }
        }
        let partner = sine_partners(program, &folded, &needed);

        let mut register: Vec<usize> = vec![usize::MAX; program.nodes.len()];
        let mut free: Vec<usize> = Vec::new();
        let (mut steps, mut routines) = (Vec::new(), Vec::new());
        let operand = |register: &[usize], index: usize| match folded[index] {
            Some(c) => Operand::Constant(c),
            None => Operand::Register(register[index]),
        };
        for (index, node) in program.nodes.iter().enumerate() {
            if !needed[index] || folded[index].is_some() {
                continue;
            }
            let mut take = |free: &mut Vec<usize>| {
                free.pop().unwrap_or_else(|| {
                    registers += 1;
                    registers - 1
                })
            };
            let operands: [Option<usize>; 2] = match *node {
                Node::Routine(call) => {
                    let call = &program.routines[call];
                    let out = take(&mut free);
                    register[index] = out;
                    let operands = call.operands.iter().map(|&x| operand(&register, x)).collect();
                    let routine = Arc::clone(&call.routine);
                    steps.push(Step::Routine(routines.len()));
                    routines.push(ScheduledRoutine { routine, operands, out });
                    let mut ended: Vec<usize> = call.operands.clone();
                    ended.sort_unstable();
                    ended.dedup();
                    for x in ended {
                        if last_use[x] == index && folded[x].is_none() {
                            free.push(register[x]);
                        }
                    }
                    [None, None]
                }
                Node::Constant(_) => [None, None],
                Node::Variable(v) => {
                    register[index] = register_of_variable[v];
                    [None, None]
                }
                Node::Unary(_, x) if register[index] != usize::MAX => [Some(x), None],
                Node::Unary(operation, x) => {
                    register[index] = take(&mut free);
                    match partner[index] {
                        Some(other) => {
                            register[other] = take(&mut free);
                            let (sin, cos) = if operation == Unary::Sin {
                                (index, other)
                            } else {
                                (other, index)
                            };
                            steps.push(Step::SinCos {
                                angle: register[x],
                                sin: register[sin],
                                cos: register[cos],
                            });
                        }
                        None => steps.push(Step::Unary(operation, register[x], register[index])),
                    }
                    [Some(x), None]
                }
                Node::Binary(operation, x, y) => {
                    let out = take(&mut free);
                    register[index] = out;
                    let (x_operand, y_operand) = (operand(&register, x), operand(&register, y));
                    steps.push(Step::Binary(operation, x_operand, y_operand, out));
                    [Some(x), (y != x).then_some(y)]
                }
            };
            // a register is free once the last step that reads it has been written
            for x in operands.into_iter().flatten() {
                if last_use[x] == index && folded[x].is_none() {
                    free.push(register[x]);
                }
            }
        }
        let outputs = program
            .outputs
            .iter()
            .map(|&o| match folded[o] {
                Some(c) => ScheduledOutput::Constant(c),
                None => ScheduledOutput::Register(register[o]),
            })
            .collect();
        Self { steps, routines, registers, used, outputs }
    }

    /// Runs all steps on one column of trials.
    #[inline(always)]
    pub fn run(&self, registers: &mut [Column]) {
        for step in &self.steps {
            match *step {
                Step::Unary(operation, x, out) => apply_unary(registers, operation, x, out),
                Step::Binary(operation, x, y, out) => apply_binary(registers, operation, x, y, out),
                Step::SinCos { angle, sin, cos } => apply_sin_cos(registers, angle, sin, cos),
                Step::Routine(number) => self.routines[number].run(registers),
            }
        }
    }
}

impl ScheduledRoutine {
    #[inline(never)]
    fn run(&self, registers: &mut [Column]) {
        let operands: Vec<[f64; COLUMN]> = self
            .operands
            .iter()
            .map(|operand| match *operand {
                Operand::Register(register) => registers[register].0,
                Operand::Constant(value) => [value; COLUMN],
            })
            .collect();
        self.routine.column(&operands, &mut registers[self.out].0);
    }
}

/// The value of every node that is the same in all trials.
pub(crate) fn fold(program: &Program, bound: &[Option<f64>]) -> Vec<Option<f64>> {
    let mut folded: Vec<Option<f64>> = Vec::with_capacity(program.nodes.len());
    for node in &program.nodes {
        folded.push(match *node {
            Node::Variable(v) => bound.get(v).copied().flatten(),
            Node::Constant(c) => Some(c),
            Node::Unary(operation, x) => folded[x].map(|x: f64| x.unary(operation)),
            Node::Binary(operation, x, y) => match (folded[x], folded[y]) {
                (Some(x), Some(y)) => Some(x.binary(operation, y)),
                _ => None,
            },
            Node::Routine(call) => {
                let call = &program.routines[call];
                let operands: Option<Vec<f64>> = call.operands.iter().map(|&x| folded[x]).collect();
                operands.map(|operands| call.routine.value(&operands))
            }
        });
    }
    folded
}

/// The last needed node that reads each node's value; a sine and a cosine of the same angle are
/// computed at the first of the two, but counting the later one only keeps the angle longer.
fn last_uses(program: &Program, folded: &[Option<f64>], needed: &[bool]) -> Vec<usize> {
    let mut last_use = vec![0; program.nodes.len()];
    for index in 0..program.nodes.len() {
        if needed[index] && folded[index].is_none() {
            program.for_each_operand(index, |operand| last_use[operand] = index);
        }
    }
    last_use
}

/// For every needed sine the cosine of the same angle, and the other way round.
fn sine_partners(program: &Program, folded: &[Option<f64>], needed: &[bool]) -> Vec<Option<usize>> {
    let mut partner = vec![None; program.nodes.len()];
    let mut sine_of = std::collections::HashMap::new();
    let mut cosine_of = std::collections::HashMap::new();
    for (index, node) in program.nodes.iter().enumerate() {
        if !needed[index] || folded[index].is_some() {
            continue;
        }
        match *node {
            Node::Unary(Unary::Sin, x) => {
                sine_of.insert(x, index);
            }
            Node::Unary(Unary::Cos, x) => {
                cosine_of.insert(x, index);
            }
            _ => {}
        }
    }
    for (x, &sine) in &sine_of {
        if let Some(&cosine) = cosine_of.get(x) {
            partner[sine] = Some(cosine);
            partner[cosine] = Some(sine);
        }
    }
    partner
}
