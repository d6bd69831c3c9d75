//! Trials from standard normal scores, so that a quantity can be given another shape or width while
//! everything keeps its random numbers.

use gumption_engine::distribution::{BLOCK, Draws, FromScore, StreamKey, Varying};
use gumption_engine::model::{Schedule, ScheduledOutput};
use gumption_engine::number::{COLUMN, CodePath, Column, Kernel};
use gumption_engine::propagate::monte_carlo::{onto_branch, stream_name};
use gumption_engine::propagate::{EvaluationError, gum, joint};
use gumption_engine::task::{Row, Task};

/// One row of a task made ready for trials with changes.
#[derive(Debug)]
pub(super) struct Sampler {
    schedule: Schedule,
    varying: Varying,
    /// The task's variables that vary, in the order of their registers.
    pub variables: Vec<usize>,
    keys: Vec<StreamKey>,
    /// Streams of a second, independent sample.
    second: Vec<StreamKey>,
    /// How values follow from scores; `None` for those that are drawn as values.
    from_score: Vec<Option<FromScore>>,
    branches: Vec<Option<(f64, f64)>>,
}

/// What is other than stated in a variant of the evaluation.
#[derive(Clone, Debug)]
pub(super) enum Change {
    /// Nothing.
    None,
    /// The quantity at this place follows from its scores in another way.
    Shape(usize, FromScore),
    /// The distances of the quantity at this place from its mean are multiplied.
    Width { place: usize, mean: f64, factor: f64 },
}

/// Buffers of one thread.
#[derive(Debug)]
pub(super) struct Buffers {
    scores: Vec<Column>,
    values: Vec<Column>,
    second: Vec<Column>,
    registers: Vec<Column>,
}

/// The values of all outputs in a block.
pub(super) type Block = Vec<[f64; BLOCK]>;

impl Sampler {
    /// A row of the task.
    ///
    /// # Errors
    /// Correlations that cannot be drawn.
    pub(super) fn new(task: &Task, row: &Row) -> Result<Self, EvaluationError> {
        let joint = joint(task, row)?;
        let estimates = gum::evaluate(task, row).estimates;
        let mut bound: Vec<Option<f64>> = row.distributions.iter().map(|d| d.constant()).collect();
        let variables: Vec<usize> =
            (0..row.distributions.len()).filter(|&v| bound[v].is_none()).collect();
        bound.extend(row.conditions.iter().map(|&value| Some(value)));
        let varying = Varying::new(&row.distributions, &variables, &joint);
        let key = |sample: &str| {
            let name = |&v: &usize| stream_name(task, row, v) + sample;
            variables.iter().map(|v| StreamKey::new(task.settings.seed, &name(v))).collect()
        };
        let values_only = varying.without_scores();
        let from_score = varying.distributions().iter().zip(&values_only);
        let from_score = from_score.map(|(d, is)| (!is).then(|| FromScore::of(d))).collect();
        let outputs = task.model.outputs.iter().zip(&estimates);
        let branches = outputs.map(|(output, &middle)| {
            output.period.map(|turn| (if middle.is_finite() { middle } else { 0.0 }, turn))
        });
        Ok(Self {
            schedule: Schedule::keeping_variables(&task.model.program, &bound),
            branches: branches.collect(),
            // no name of a variable has a bar
            keys: key(""),
            second: key("|second sample"),
            varying,
            variables,
            from_score,
        })
    }

    pub(super) fn outputs(&self) -> usize {
        self.schedule.outputs.len()
    }

    /// Whether an output depends on the quantity at a place.
    pub(super) fn is_used(&self, place: usize) -> bool {
        self.schedule.used.get(place).copied().unwrap_or(false)
    }

    /// Whether the quantity at a place can be given another shape.
    pub(super) fn has_scores(&self, place: usize) -> bool {
        self.from_score.get(place).is_some_and(Option::is_some)
    }

    /// The places of quantities that are drawn together.
    pub(super) fn linked(&self) -> Vec<Vec<usize>> {
        self.varying.linked()
    }

    pub(super) fn buffers(&self) -> Buffers {
        let columns = vec![Column::ZERO; self.variables.len()];
        Buffers {
            scores: columns.clone(),
            second: columns.clone(),
            values: columns,
            registers: vec![Column::ZERO; self.schedule.registers],
        }
    }

    pub(super) fn blocks(&self, count: usize) -> Vec<Block> {
        vec![vec![[0.0; BLOCK]; self.outputs()]; count]
    }

    /// The outputs in block `block` with each of the changes.
    pub(super) fn changed(
        &self,
        path: CodePath,
        block: u64,
        changes: &[Change],
        buffers: &mut Buffers,
        out: &mut [Block],
    ) {
        path.run(Changed { path, sampler: self, block, changes, buffers, out });
    }

    /// The outputs in block `block` of the first and of the second sample, then of the second with
    /// each of the sets of quantities taken from the first. With (A, B) = (second, first) that is
    /// what Jansen's estimators need: A, B and A with one set from B.
    pub(super) fn mixed(
        &self,
        path: CodePath,
        block: u64,
        sets: &[Vec<usize>],
        buffers: &mut Buffers,
        out: &mut [Block],
    ) {
        path.run(Mixed { path, sampler: self, block, sets, buffers, out });
    }

    /// The values of all quantities in the first `blocks` blocks, column by column.
    pub(super) fn drawn(&self, path: CodePath, block: u64, buffers: &mut Buffers) -> Vec<Column> {
        path.run(Drawn { path, sampler: self, block, buffers })
    }

    /// The outputs for one column of values, of which that at `place` is changed to `mean` plus
    /// `factor` times its distance from it.
    pub(super) fn widened(
        &self,
        path: CodePath,
        values: &[Column],
        (place, mean, factor): (usize, f64, f64),
        buffers: &mut Buffers,
        take: impl FnMut(usize, &[f64; COLUMN]),
    ) {
        path.run(Widened { sampler: self, values, place, mean, factor, buffers, take });
    }

    #[inline(always)]
    fn values(&self, scores: &[Column], values: &mut [Column]) {
        for (q, from_score) in self.from_score.iter().enumerate() {
            match from_score {
                Some(from_score) => from_score.values(&scores[q], &mut values[q]),
                None => values[q].0 = scores[q].0,
            }
        }
    }

    /// The column of an output after the schedule has run.
    #[inline(always)]
    fn output(&self, registers: &[Column], output: usize, out: &mut [f64]) {
        match self.schedule.outputs[output] {
            ScheduledOutput::Register(register) => out.copy_from_slice(&registers[register].0),
            ScheduledOutput::Constant(value) => out.fill(value),
        }
        if let Some((middle, turn)) = self.branches[output] {
            onto_branch(out, middle, turn);
        }
    }
}

/// Distances from the mean multiplied.
#[inline(always)]
fn widen(values: &Column, mean: f64, factor: f64, out: &mut Column) {
    for i in 0..COLUMN {
        out.0[i] = mean + factor * (values.0[i] - mean);
    }
}

struct Changed<'a> {
    path: CodePath,
    sampler: &'a Sampler,
    block: u64,
    changes: &'a [Change],
    buffers: &'a mut Buffers,
    out: &'a mut [Block],
}

impl Kernel for Changed<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { path, sampler, block, changes, buffers, out } = self;
        let Buffers { scores, values, registers, .. } = buffers;
        let count = sampler.variables.len();
        let places: Vec<usize> = (0..count).collect();
        let mut draws = Draws::new(&sampler.varying, &sampler.keys, path, block);
        for first in (0..BLOCK).step_by(COLUMN) {
            draws.scores(scores, &places);
            sampler.values(scores, values);
            registers[..count].clone_from_slice(values);
            for (change, out) in changes.iter().zip(out.iter_mut()) {
                let changed = match change {
                    Change::None => None,
                    Change::Shape(place, from_score) => {
                        from_score.values(&scores[*place], &mut registers[*place]);
                        Some(*place)
                    }
                    Change::Width { place, mean, factor } => {
                        widen(&values[*place], *mean, *factor, &mut registers[*place]);
                        Some(*place)
                    }
                };
                sampler.schedule.run(registers);
                for (output, out) in out.iter_mut().enumerate() {
                    sampler.output(registers, output, &mut out[first..first + COLUMN]);
                }
                if let Some(place) = changed {
                    registers[place].0 = values[place].0;
                }
            }
        }
    }
}

struct Mixed<'a> {
    path: CodePath,
    sampler: &'a Sampler,
    block: u64,
    sets: &'a [Vec<usize>],
    buffers: &'a mut Buffers,
    out: &'a mut [Block],
}

impl Kernel for Mixed<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { path, sampler, block, sets, buffers, out } = self;
        let Buffers { scores, values, second, registers } = buffers;
        let count = sampler.variables.len();
        let places: Vec<usize> = (0..count).collect();
        let mut draws = Draws::new(&sampler.varying, &sampler.keys, path, block);
        let mut others = Draws::new(&sampler.varying, &sampler.second, path, block);
        for first in (0..BLOCK).step_by(COLUMN) {
            draws.scores(scores, &places);
            sampler.values(scores, values);
            others.scores(scores, &places);
            sampler.values(scores, second);
            for (number, out) in out.iter_mut().enumerate() {
                let set = number.checked_sub(2).and_then(|set| sets.get(set));
                match number {
                    0 => registers[..count].clone_from_slice(values),
                    1 => registers[..count].clone_from_slice(second),
                    _ => {}
                }
                let set = set.map_or(&[][..], Vec::as_slice);
                for &place in set {
                    registers[place].0 = values[place].0;
                }
                sampler.schedule.run(registers);
                for (output, out) in out.iter_mut().enumerate() {
                    sampler.output(registers, output, &mut out[first..first + COLUMN]);
                }
                for &place in set {
                    registers[place].0 = second[place].0;
                }
            }
        }
    }
}

struct Drawn<'a> {
    path: CodePath,
    sampler: &'a Sampler,
    block: u64,
    buffers: &'a mut Buffers,
}

impl Kernel for Drawn<'_> {
    type Output = Vec<Column>;

    #[inline(always)]
    fn run(self) -> Vec<Column> {
        let Self { path, sampler, block, buffers } = self;
        let Buffers { scores, values, .. } = buffers;
        let places: Vec<usize> = (0..sampler.variables.len()).collect();
        let mut draws = Draws::new(&sampler.varying, &sampler.keys, path, block);
        let mut drawn = Vec::with_capacity(BLOCK / COLUMN * places.len());
        for _ in 0..BLOCK / COLUMN {
            draws.scores(scores, &places);
            sampler.values(scores, values);
            drawn.extend_from_slice(values);
        }
        drawn
    }
}

struct Widened<'a, F> {
    sampler: &'a Sampler,
    values: &'a [Column],
    place: usize,
    mean: f64,
    factor: f64,
    buffers: &'a mut Buffers,
    take: F,
}

impl<F: FnMut(usize, &[f64; COLUMN])> Kernel for Widened<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { sampler, values, place, mean, factor, buffers, mut take } = self;
        let registers = &mut buffers.registers;
        registers[..values.len()].clone_from_slice(values);
        widen(&values[place], mean, factor, &mut registers[place]);
        sampler.schedule.run(registers);
        let mut out = [0.0; COLUMN];
        for output in 0..sampler.outputs() {
            sampler.output(registers, output, &mut out);
            take(output, &out);
        }
    }
}
