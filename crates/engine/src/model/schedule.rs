//! A program made ready for columns of trials: what is constant is computed once, what no output
//! needs is dropped, and every remaining step has registers to read from and to write to.

use super::program::{Node, Program};
use std::sync::Arc;

use crate::number::{
    Binary, COLUMN, CodePath, Column, Kernel, Number, Operand, Routine, Unary, apply_binary,
    apply_sin_cos, apply_unary,
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

/// Which values are still there after a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum KeptValues {
    Outputs,
    /// And those of the variables, so that one set of values can be used again.
    Variables,
    /// Every value, so that only what follows from a change need be computed again.
    All,
}

/// A program over columns.
#[derive(Clone, Debug)]
pub struct Schedule {
    steps: Vec<Step>,
    routines: Vec<ScheduledRoutine>,
    kept: KeptValues,
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
        Self::keeping(program, bound, KeptValues::Outputs)
    }

    /// The same; the registers of the variables are never written to, so that one set of values can
    /// be used again.
    pub fn keeping_variables(program: &Program, bound: &[Option<f64>]) -> Self {
        Self::keeping(program, bound, KeptValues::Variables)
    }

    /// The same; no register is written to twice, so that [`Schedule::following`] can tell what is to
    /// be computed again where some variables change.
    pub fn keeping_all(program: &Program, bound: &[Option<f64>]) -> Self {
        Self::keeping(program, bound, KeptValues::All)
    }

    fn keeping(program: &Program, bound: &[Option<f64>], kept: KeptValues) -> Self {
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
        for (last, node) in last_use.iter_mut().zip(&program.nodes) {
            let lasts = match kept {
                KeptValues::Outputs => false,
                KeptValues::Variables => matches!(node, Node::Variable(_)),
                KeptValues::All => true,
            };
            if lasts {
                *last = usize::MAX;
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
        Self { steps, routines, kept, registers, used, outputs }
    }

    /// Runs all steps on one column of trials.
    pub fn run_on(&self, path: CodePath, registers: &mut [Column]) {
        run_steps_on(path, &self.steps, &self.routines, registers);
    }

    /// What is to be computed again where only the varying variables at these places, in their order,
    /// have other values.
    ///
    /// # Panics
    /// Of a schedule that does not keep all values.
    pub fn following(&self, places: &[usize]) -> Following {
        self.following_to(places, &self.outputs)
    }

    /// The same for some of the outputs alone.
    ///
    /// # Panics
    /// As [`Schedule::following`].
    pub fn following_to(&self, places: &[usize], outputs: &[ScheduledOutput]) -> Following {
        assert!(self.kept == KeptValues::All, "values that are needed again are not kept");
        let mut own: Vec<Option<usize>> = vec![None; self.registers];
        let mut registers = self.registers;
        let mut take = || {
            registers += 1;
            registers - 1
        };
        let variables = places.iter().map(|&place| *own[place].insert(take()));
        let variables: Vec<usize> = variables.collect();
        let mut steps: Vec<Step> = Vec::new();
        let mut routines: Vec<ScheduledRoutine> = Vec::new();
        for step in &self.steps {
            let operand = |operand: Operand| match operand {
                Operand::Register(r) => Operand::Register(own[r].unwrap_or(r)),
                constant @ Operand::Constant(_) => constant,
            };
            let follows = |operand: &Operand| match *operand {
                Operand::Register(r) => own[r].is_some(),
                Operand::Constant(_) => false,
            };
            match *step {
                Step::Unary(operation, x, out) => {
                    if let Some(x) = own[x] {
                        let to = take();
                        own[out] = Some(to);
                        steps.push(Step::Unary(operation, x, to));
                    }
                }
                Step::Binary(operation, x, y, out) => {
                    if follows(&x) || follows(&y) {
                        let (x, y, to) = (operand(x), operand(y), take());
                        own[out] = Some(to);
                        steps.push(Step::Binary(operation, x, y, to));
                    }
                }
                Step::SinCos { angle, sin, cos } => {
                    if let Some(angle) = own[angle] {
                        let to = [take(), take()];
                        (own[sin], own[cos]) = (Some(to[0]), Some(to[1]));
                        steps.push(Step::SinCos { angle, sin: to[0], cos: to[1] });
                    }
                }
                Step::Routine(number) => {
                    let ScheduledRoutine { routine, operands, out } = &self.routines[number];
                    if operands.iter().any(follows) {
                        let operands = operands.iter().map(|&x| operand(x)).collect();
                        let to = take();
                        own[*out] = Some(to);
                        steps.push(Step::Routine(routines.len()));
                        let routine = Arc::clone(routine);
                        routines.push(ScheduledRoutine { routine, operands, out: to });
                    }
                }
            }
        }
        let outputs = outputs.iter().map(|output| match *output {
            ScheduledOutput::Register(r) => ScheduledOutput::Register(own[r].unwrap_or(r)),
            constant @ ScheduledOutput::Constant(_) => constant,
        });
        let outputs: Vec<ScheduledOutput> = outputs.collect();
        let mut needed = vec![false; registers];
        for output in &outputs {
            if let ScheduledOutput::Register(register) = *output {
                needed[register] = true;
            }
        }
        let mut kept = Vec::with_capacity(steps.len());
        for step in steps.into_iter().rev() {
            if step.results(&routines).into_iter().flatten().any(|result| needed[result]) {
                step.for_each_read(&routines, |register| needed[register] = true);
                kept.push(step);
            }
        }
        kept.reverse();
        let steps = kept;
        let reads = (0..self.registers).filter(|&register| needed[register]).collect();
        let first = self.registers;
        let mut following =
            Following { steps, routines, first, registers, variables, reads, outputs };
        following.share_registers();
        following
    }
}

/// The steps of a schedule that depend on some of its variables. They read what the schedule has
/// left in its registers and write to registers of their own behind those, so that one run of the
/// schedule serves any number of changes; every value has the bits that the whole schedule would give.
#[derive(Clone, Debug)]
pub struct Following {
    steps: Vec<Step>,
    routines: Vec<ScheduledRoutine>,
    /// The first register behind those of the schedule.
    first: usize,
    /// Number of registers, those of the schedule first.
    pub registers: usize,
    /// Where the other values of the variables are put, in the order in which they were named.
    pub variables: Vec<usize>,
    /// Registers of the schedule that the steps read, in rising order.
    pub reads: Vec<usize>,
    /// Where each output is found after a run.
    pub outputs: Vec<ScheduledOutput>,
}

impl Following {
    /// Runs the steps on one column of trials.
    pub fn run_on(&self, path: CodePath, registers: &mut [Column]) {
        run_steps_on(path, &self.steps, &self.routines, registers);
    }

    /// Whether an output depends on the variables whose values are others.
    pub fn moves(&self, output: usize) -> bool {
        match self.outputs.get(output) {
            Some(ScheduledOutput::Register(register)) => *register >= self.first,
            Some(ScheduledOutput::Constant(_)) | None => false,
        }
    }

    /// Lets values that are not needed at the same time share registers, so that the columns of many
    /// changes stay in the nearest cache. The other values of the variables are put anew before each
    /// run.
    fn share_registers(&mut self) {
        let first = self.first;
        let mut last_use = vec![0; self.registers];
        for (index, step) in self.steps.iter().enumerate() {
            step.for_each_read(&self.routines, |register| last_use[register] = index);
        }
        for output in &self.outputs {
            if let ScheduledOutput::Register(register) = *output {
                last_use[register] = usize::MAX;
            }
        }
        let mut place: Vec<usize> = (0..self.registers).collect();
        let mut free: Vec<usize> = Vec::new();
        self.registers = first;
        let mut take = |free: &mut Vec<usize>| {
            free.pop().unwrap_or_else(|| {
                self.registers += 1;
                self.registers - 1
            })
        };
        for variable in &mut self.variables {
            place[*variable] = take(&mut free);
            *variable = place[*variable];
        }
        for (index, step) in self.steps.iter_mut().enumerate() {
            let mut ended = Vec::new();
            step.for_each_read(&self.routines, |register| {
                if register >= first && last_use[register] == index && !ended.contains(&register) {
                    ended.push(register);
                }
            });
            let operand = |operand: &mut Operand, place: &[usize]| {
                if let Operand::Register(register) = operand {
                    *register = place[*register];
                }
            };
            let mut result = |register: &mut usize, place: &mut [usize]| {
                place[*register] = take(&mut free);
                *register = place[*register];
            };
            match step {
                Step::Unary(_, x, out) => {
                    *x = place[*x];
                    result(out, &mut place);
                }
                Step::Binary(_, x, y, out) => {
                    operand(x, &place);
                    operand(y, &place);
                    result(out, &mut place);
                }
                Step::SinCos { angle, sin, cos } => {
                    *angle = place[*angle];
                    result(sin, &mut place);
                    result(cos, &mut place);
                }
                Step::Routine(number) => {
                    let ScheduledRoutine { operands, out, .. } = &mut self.routines[*number];
                    operands.iter_mut().for_each(|x| operand(x, &place));
                    result(out, &mut place);
                }
            }
            free.extend(ended.into_iter().map(|register| place[register]));
        }
        for output in &mut self.outputs {
            if let ScheduledOutput::Register(register) = output {
                *register = place[*register];
            }
        }
    }
}

impl Step {
    /// The registers that the step writes to.
    fn results(&self, routines: &[ScheduledRoutine]) -> [Option<usize>; 2] {
        match *self {
            Self::Unary(_, _, out) | Self::Binary(_, _, _, out) => [Some(out), None],
            Self::SinCos { sin, cos, .. } => [Some(sin), Some(cos)],
            Self::Routine(number) => [Some(routines[number].out), None],
        }
    }

    /// Calls `f` with every register that the step reads.
    fn for_each_read(&self, routines: &[ScheduledRoutine], mut f: impl FnMut(usize)) {
        let mut read = |operand: &Operand| {
            if let Operand::Register(register) = *operand {
                f(register);
            }
        };
        match self {
            Self::Unary(_, x, _) | Self::SinCos { angle: x, .. } => f(*x),
            Self::Binary(_, x, y, _) => [x, y].into_iter().for_each(read),
            Self::Routine(number) => routines[*number].operands.iter().for_each(&mut read),
        }
    }
}

/// Runs steps on one column of trials. Compiled once for each path: a call is a few nanoseconds, a
/// column takes hundreds.
#[inline(never)]
fn run_steps_on(
    path: CodePath,
    steps: &[Step],
    routines: &[ScheduledRoutine],
    registers: &mut [Column],
) {
    path.run(StepsKernel { steps, routines, registers });
}

struct StepsKernel<'a> {
    steps: &'a [Step],
    routines: &'a [ScheduledRoutine],
    registers: &'a mut [Column],
}

impl Kernel for StepsKernel<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { steps, routines, registers } = self;
        for step in steps {
            match *step {
                Step::Unary(operation, x, out) => apply_unary(registers, operation, x, out),
                Step::Binary(operation, x, y, out) => apply_binary(registers, operation, x, y, out),
                Step::SinCos { angle, sin, cos } => apply_sin_cos(registers, angle, sin, cos),
                Step::Routine(number) => routines[number].run(registers),
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

#[cfg(test)]
mod tests {
    use super::super::Recorder;
    use super::*;

    /// What follows from some variables, computed again beside a run of the whole, has the bits of a
    /// whole run with the other values; and the first run's values are still there.
    #[test]
    fn what_follows_is_what_the_whole_gives() {
        let recorder = Recorder::default();
        let [x, y, z] = [0, 1, 2].map(|v| recorder.variable(v));
        let shared = (x * y).sin() + (x * y).cos();
        let outputs = [shared * z + x.sqrt(), z.exp() - y, y, (y - z).sin()];
        let schedule = Schedule::keeping_all(&recorder.program(3, &outputs), &[None; 3]);
        let column = |value: f64| Column(std::array::from_fn(|i| value + 0.001 * i as f64));
        let (stated, other) = ([0.3, 0.7, 1.1].map(column), [2.3, 0.1, 0.4].map(column));
        let found = |outputs: &[ScheduledOutput], registers: &[Column]| -> Vec<[f64; COLUMN]> {
            let value = |output: &ScheduledOutput| match *output {
                ScheduledOutput::Register(register) => registers[register].0,
                ScheduledOutput::Constant(value) => [value; COLUMN],
            };
            outputs.iter().map(value).collect()
        };
        let whole = |values: &[Column; 3]| {
            let mut registers = vec![Column::ZERO; schedule.registers];
            registers[..3].clone_from_slice(values);
            schedule.run_on(CodePath::best(), &mut registers);
            registers
        };
        for places in [vec![0], vec![1], vec![2], vec![2, 0], vec![0, 1, 2], vec![]] {
            let following = schedule.following(&places);
            let mut registers = whole(&stated);
            let before = found(&schedule.outputs, &registers);
            registers.resize(following.registers, Column::ZERO);
            let mut values = stated.clone();
            for (&place, &register) in places.iter().zip(&following.variables) {
                values[place] = other[place].clone();
                registers[register] = other[place].clone();
            }
            following.run_on(CodePath::best(), &mut registers);
            let expected = found(&schedule.outputs, &whole(&values));
            assert_eq!(found(&following.outputs, &registers), expected, "{places:?}");
            assert_eq!(found(&schedule.outputs, &registers), before);
            for (output, value) in schedule.outputs.iter().zip(&expected) {
                let alone = schedule.following_to(&places, &[*output]);
                registers.resize(alone.registers.max(registers.len()), Column::ZERO);
                for (&place, &register) in places.iter().zip(&alone.variables) {
                    registers[register] = other[place].clone();
                }
                alone.run_on(CodePath::best(), &mut registers);
                assert_eq!(found(&alone.outputs, &registers), [*value], "{places:?}");
                assert!(alone.steps.len() <= following.steps.len());
            }
            // only what was not computed again is read of the first run
            assert!(following.reads.iter().all(|read| *read < schedule.registers));
        }
        // of z there is no sine of x y to be computed
        assert!(schedule.following(&[2]).steps.len() < schedule.steps.len());
        assert!(schedule.following(&[]).steps.is_empty());
    }
}
