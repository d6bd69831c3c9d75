//! One block of trials: the inputs drawn, the model evaluated, the outputs handed over.

use std::sync::Arc;

use crate::parallel;

use super::condensed::Condensed;
use crate::distribution::{BLOCK, Draws, Joint, StreamKey, Varying};
use crate::model::{Schedule, ScheduledOutput};
use crate::number::{COLUMN, CodePath, Column, Kernel};
use crate::propagate::whole_turns::{on_branch, onto_branch};
use crate::task::{ColumnFunction, Row, Sharing, Task};

/// One row of a task made ready for trials.
#[derive(Debug)]
pub(crate) struct RowTrials {
    schedule: Schedule,
    /// The variables that vary, in the order of their registers.
    varying: Varying,
    registers: Vec<usize>,
    keys: Vec<StreamKey>,
    /// For each output, the branch that phases are taken on: its middle and the length of a turn.
    branches: Vec<Option<(f64, f64)>>,
    /// For each output its tolerance limits, infinite where there are none; the lower one above the
    /// upper one where values beyond either of them are inside.
    limits: Vec<[f64; 2]>,
    /// What computes the outputs in place of the schedule.
    function: Option<Called>,
    /// The outputs' values in the first blocks, as far as they are held.
    held: Vec<Box<[[f64; BLOCK]]>>,
    /// What is kept of the first blocks, where it was made before the run.
    pub(super) condensed: Condensed,
}

/// A function that takes columns.
#[derive(Debug)]
struct Called {
    function: Arc<dyn ColumnFunction>,
    /// For each variable of the program its value where it does not vary.
    bound: Vec<Option<f64>>,
}

/// Buffers of one thread, reused from block to block.
#[derive(Debug)]
pub(crate) struct Workspace {
    registers: Vec<Column>,
    /// The outputs' values in the block's trials.
    pub outputs: Vec<[f64; BLOCK]>,
}

impl RowTrials {
    /// A row of the task. `estimates` are the outputs' values at the estimates of the inputs, the
    /// middle of a phase's branch; `joint` is the joint draw of the row's distributions.
    pub(crate) fn new(task: &Task, row: &Row, estimates: &[f64], joint: &Arc<Joint>) -> Self {
        let mut bound: Vec<Option<f64>> = row.distributions.iter().map(|d| d.constant()).collect();
        let varying: Vec<usize> =
            (0..row.distributions.len()).filter(|&v| bound[v].is_none()).collect();
        bound.extend(row.conditions.iter().map(|&value| Some(value)));
        let schedule = Schedule::new(&task.model.program, &bound);
        let keys = varying
            .iter()
            .map(|&v| StreamKey::new(task.settings.seed, &stream_name(task, row, v)))
            .collect();
        let branches: Vec<Option<(f64, f64)>> = task
            .model
            .outputs
            .iter()
            .zip(estimates)
            .map(|(output, &middle)| {
                output.period.map(|turn| (if middle.is_finite() { middle } else { 0.0 }, turn))
            })
            .collect();
        let unlimited = [f64::NEG_INFINITY, f64::INFINITY];
        let limits = task.model.outputs.iter().map(|output| output.at(&row.conditions).tolerance);
        let limits =
            limits.map(|tolerance| tolerance.map_or(unlimited, |tolerance| tolerance.ends()));
        let limits = limits.zip(&branches).map(|(limits, branch)| match *branch {
            Some((middle, turn)) => on_branch(limits, middle, turn),
            None => limits,
        });
        let limits = limits.collect();
        Self {
            registers: (0..varying.len()).collect(),
            varying: Varying::new(&row.distributions, &varying, joint),
            schedule,
            keys,
            branches,
            limits,
            function: task
                .function
                .as_ref()
                .map(|function| Called { function: Arc::clone(function), bound }),
            held: Vec::new(),
            condensed: Condensed::default(),
        }
    }

    /// Holds the values of the blocks before `end`, as far as `memory` (bytes) has room, so that they
    /// need not be computed again.
    pub(crate) fn hold(&mut self, path: CodePath, end: u64, memory: usize) {
        let room = memory / (size_of::<[f64; BLOCK]>() * self.outputs().max(1));
        let (first, end) = (self.held.len() as u64, end.min(room as u64));
        let make = |workspace: &mut Workspace, block: u64| {
            self.block(path, block, workspace);
            workspace.outputs.clone().into_boxed_slice()
        };
        let made = parallel::map_with(first..end, || self.workspace(), make);
        self.held.extend(made);
    }

    /// Of so many of the first trials there is what the figures of a run need.
    pub(super) fn condensed_trials(&self) -> u64 {
        self.condensed.len() * BLOCK as u64
    }

    pub(crate) fn workspace(&self) -> Workspace {
        Workspace {
            registers: vec![Column::ZERO; self.schedule.registers],
            outputs: vec![[0.0; BLOCK]; self.schedule.outputs.len()],
        }
    }

    pub(crate) fn limits(&self, output: usize) -> [f64; 2] {
        self.limits.get(output).copied().unwrap_or([f64::NEG_INFINITY, f64::INFINITY])
    }

    pub(crate) fn outputs(&self) -> usize {
        self.schedule.outputs.len()
    }

    /// Fills the workspace's outputs with the trials of block `block`.
    pub(crate) fn block(&self, path: CodePath, block: u64, workspace: &mut Workspace) {
        if let Some(held) = usize::try_from(block).ok().and_then(|block| self.held.get(block)) {
            workspace.outputs.copy_from_slice(held);
            return;
        }
        if let Some(called) = &self.function {
            self.called(called, path, block, workspace);
            return;
        }
        let wanted = WantedValues::Outputs;
        path.run(BlockKernel { path, trials: self, block, workspace, wanted });
    }

    /// As [`RowTrials::block`], by a function that takes columns.
    #[cold]
    fn called(
        &self,
        Called { function, bound }: &Called,
        path: CodePath,
        block: u64,
        workspace: &mut Workspace,
    ) {
        let variables = self.drawn((path, block), bound, BLOCK, workspace);
        let mut found = vec![vec![f64::NAN; BLOCK]; self.outputs()];
        function.evaluate(&variables, &mut found);
        let outputs = workspace.outputs.iter_mut().zip(found).zip(&self.branches);
        for ((out, found), branch) in outputs {
            for (out, value) in out.iter_mut().zip(found) {
                *out = value;
            }
            if let Some((middle, turn)) = *branch {
                onto_branch(out, middle, turn);
            }
        }
    }

    /// The program's variables in the first `count` trials of a block: those that are drawn, and those that
    /// are bound to a value.
    fn drawn(
        &self,
        (path, block): (CodePath, u64),
        bound: &[Option<f64>],
        count: usize,
        workspace: &mut Workspace,
    ) -> Vec<Vec<f64>> {
        let mut drawn =
            vec![Vec::with_capacity(count.next_multiple_of(COLUMN)); self.varying.len()];
        let wanted = WantedValues::All { drawn: &mut drawn, count };
        path.run(BlockKernel { path, trials: self, block, workspace, wanted });
        let mut drawn = drawn.into_iter();
        let column = |bound: &Option<f64>| match bound {
            Some(value) => vec![*value; count],
            None => {
                let mut column = drawn.next().unwrap_or_default();
                column.truncate(count);
                column
            }
        };
        bound.iter().map(column).collect()
    }

    /// The program's variables in the first `count` trials, at most those of one block.
    pub(crate) fn first_draws(&self, path: CodePath, row: &Row, count: usize) -> Vec<Vec<f64>> {
        let known = row.distributions.iter().map(|distribution| distribution.constant());
        let bound: Vec<Option<f64>> =
            known.chain(row.conditions.iter().map(|value| Some(*value))).collect();
        self.drawn((path, 0), &bound, count.min(BLOCK), &mut self.workspace())
    }

    /// The drawn values of the varying variables, in the order of the task's variables with
    /// constants left out, in trial `trial` of block `block`.
    #[cold]
    pub(crate) fn inputs_of(&self, path: CodePath, block: u64, trial: usize) -> Vec<f64> {
        let mut workspace = self.workspace();
        let wanted = WantedValues::Inputs { column: trial / COLUMN };
        path.run(BlockKernel { path, trials: self, block, workspace: &mut workspace, wanted });
        let registers = self.registers.iter().map(|&register| &workspace.registers[register]);
        registers.map(|column| column.0[trial % COLUMN]).collect()
    }
}

/// The stream of a variable: its name, and where rows have values of their own, what tells the
/// rows apart.
pub fn stream_name(task: &Task, row: &Row, variable: usize) -> String {
    let name = &task.variables[variable].name;
    match task.variables[variable].sharing {
        Sharing::All => name.clone(),
        Sharing::Row => format!("{name}#{:?}", row.conditions),
        Sharing::Condition(c) => format!("{name}#{c}#{:?}", row.conditions.get(c)),
    }
}

struct BlockKernel<'a> {
    path: CodePath,
    trials: &'a RowTrials,
    block: u64,
    workspace: &'a mut Workspace,
    wanted: WantedValues<'a>,
}

/// What is asked of a block. Both stand in one kernel, so that drawing is compiled once for each
/// code path.
enum WantedValues<'a> {
    /// The outputs' values in all trials.
    Outputs,
    /// The drawn values of all inputs in one column of trials, left in the registers.
    Inputs { column: usize },
    /// The drawn values of all inputs in the first trials, as whole columns.
    All { drawn: &'a mut [Vec<f64>], count: usize },
}

impl Kernel for BlockKernel<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { path, trials, block, workspace, mut wanted } = self;
        let Workspace { registers, outputs } = workspace;
        let schedule = &trials.schedule;
        let mut draws = Draws::new(&trials.varying, &trials.keys, path, block);
        let all: Vec<bool>;
        let (used, last) = match &wanted {
            WantedValues::Outputs => (&schedule.used, BLOCK),
            WantedValues::Inputs { .. } | WantedValues::All { .. } => {
                all = vec![true; trials.varying.len()];
                let last = if let WantedValues::Inputs { column } = wanted {
                    column * COLUMN
                } else {
                    BLOCK
                };
                (&all, last)
            }
        };
        for first in (0..BLOCK).step_by(COLUMN) {
            draws.column(registers, &trials.registers, used);
            if first == last {
                return;
            }
            if let WantedValues::All { drawn, count } = &mut wanted {
                for (values, &register) in drawn.iter_mut().zip(&trials.registers) {
                    values.extend(&registers[register].0);
                }
                if first + COLUMN >= *count {
                    return;
                }
                continue;
            }
            schedule.run_on(path, registers);
            for (output, slot) in schedule.outputs.iter().enumerate() {
                let out = &mut outputs[output][first..first + COLUMN];
                match *slot {
                    ScheduledOutput::Register(register) => {
                        out.copy_from_slice(&registers[register].0)
                    }
                    ScheduledOutput::Constant(value) => out.fill(value),
                }
                if let Some((middle, turn)) = trials.branches[output] {
                    onto_branch(out, middle, turn);
                }
            }
        }
    }
}
