//! Trials from standard normal scores, so that a quantity can get another shape or width while
//! everything keeps its random numbers.

use gumption_engine::distribution::{BLOCK, Draws, FromScore, StreamKey, Varying};
use gumption_engine::model::{Following, Schedule, ScheduledOutput};
use gumption_engine::number::{COLUMN, CodePath, Column, largest_first};
use gumption_engine::propagate::gum::{Gum, GumRow};
use gumption_engine::propagate::monte_carlo::stream_name;
use gumption_engine::propagate::onto_branch;
use gumption_engine::propagate::{EvaluationError, NetCoordinate, joint};
use gumption_engine::special;
use gumption_engine::task::{Row, Task};

/// Scrambled nets that the Sobol indices come from.
pub(super) const NETS: u64 = 16;

/// Points of each net.
pub(super) const NET_POINTS: usize = 4096;

/// One row of a task, prepared for trials with changes.
#[derive(Debug)]
pub(super) struct Sampler {
    schedule: Schedule,
    varying: Varying,
    /// The task's variables with an uncertainty, in the order of their registers.
    pub variables: Vec<usize>,
    keys: Vec<StreamKey>,
    /// Streams of a second, independent sample.
    second: Vec<StreamKey>,
    seed: u64,
    /// The dimension of each quantity in a scrambled net, the one with the largest share first.
    dimensions: Vec<usize>,
    /// How values follow from scores; `None` for variables that are drawn as values.
    from_score: Vec<Option<FromScore>>,
    /// The outputs at the estimates; 0 where they are not finite.
    middles: Vec<f64>,
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

/// A change with the steps that it requires to be computed again.
#[derive(Clone, Debug)]
pub(super) struct Prepared<'a> {
    change: &'a Change,
    /// `None` where nothing changes.
    following: Option<Following>,
    /// Whether the previous change gives the same quantity the same shape, with other limits.
    has_shape_before: bool,
}

impl Prepared<'_> {
    /// Whether the change can move an output; the unchanged case moves all, so that all are
    /// evaluated.
    pub(super) fn moves(&self, output: usize) -> bool {
        self.following.as_ref().is_none_or(|following| following.moves(output))
    }
}

/// A set of quantities with the steps to be computed again for other values of them.
#[derive(Clone, Debug)]
pub(super) struct PreparedSet<'a> {
    places: &'a [usize],
    following: Following,
}

/// Buffers of one thread.
#[derive(Debug)]
pub(super) struct Buffers {
    scores: Vec<Column>,
    values: Vec<Column>,
    second: Vec<Column>,
    registers: Vec<Column>,
    outputs: Vec<Column>,
}

impl Sampler {
    /// A row of the task.
    ///
    /// # Errors
    /// Correlations that cannot be drawn.
    pub(super) fn new(task: &Task, row: &Row, gum: &GumRow) -> Result<Self, EvaluationError> {
        let joint = joint(task, row)?;
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
        let middles = gum.estimates.iter().map(|&y| if y.is_finite() { y } else { 0.0 });
        let middles: Vec<f64> = middles.collect();
        let outputs = task.model.outputs.iter().zip(&middles);
        let branches = outputs.map(|(output, &middle)| output.period.map(|turn| (middle, turn)));
        Ok(Self {
            schedule: Schedule::keeping_all(&task.model.program, &bound),
            branches: branches.collect(),
            middles,
            // names of variables never contain a bar
            keys: key(""),
            second: key("|second sample"),
            seed: task.settings.seed,
            dimensions: dimensions(&variables, gum),
            varying,
            variables,
            from_score,
        })
    }

    pub(super) fn outputs(&self) -> usize {
        self.schedule.outputs.len()
    }

    /// The outputs at the estimates; 0 where they are not finite.
    pub(super) fn middles(&self) -> &[f64] {
        &self.middles
    }

    /// Whether an output depends on the quantity at an index.
    pub(super) fn is_used(&self, place: usize) -> bool {
        self.schedule.used.get(place).copied().unwrap_or(false)
    }

    /// Whether the quantity at an index can get another shape.
    pub(super) fn has_scores(&self, place: usize) -> bool {
        self.from_score.get(place).is_some_and(Option::is_some)
    }

    /// The indices of quantities that are drawn together.
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
            outputs: vec![Column::ZERO; self.outputs()],
        }
    }

    /// Changes made ready.
    pub(super) fn prepared<'a>(&self, changes: &'a [Change]) -> Vec<Prepared<'a>> {
        let before = std::iter::once(&Change::None).chain(changes);
        let prepared = changes.iter().zip(before).map(|(change, before)| {
            let following = match change {
                Change::None => None,
                Change::Shape(place, _) | Change::Width { place, .. } => {
                    Some(self.schedule.following(&[*place]))
                }
            };
            let has_shape_before = match (change, before) {
                (Change::Shape(place, own), Change::Shape(other, before)) => {
                    place == other && own.has_shape_of(before)
                }
                _ => false,
            };
            Prepared { change, following, has_shape_before }
        });
        prepared.collect()
    }

    /// A set made ready.
    pub(super) fn prepared_set<'a>(&self, places: &'a [usize]) -> PreparedSet<'a> {
        PreparedSet { places, following: self.schedule.following(places) }
    }

    /// An estimate of the memory of a prepared change or set, in bytes.
    pub(super) fn prepared_bytes(&self) -> usize {
        // a step takes about as much as an entry of the registers' table
        64 * self.schedule.registers
    }

    /// Passes on the outputs of the first `count` trials of block `block` with each of the changes,
    /// column by column.
    pub(super) fn changed(
        &self,
        path: CodePath,
        block: u64,
        count: usize,
        changes: &[Prepared<'_>],
        buffers: &mut Buffers,
        taker: &mut dyn Taker,
    ) {
        let Buffers { scores, values, registers, outputs: found, .. } = buffers;
        let quantities = self.variables.len();
        let places = self.places();
        let followings = changes.iter().filter_map(|prepared| prepared.following.as_ref());
        followings.for_each(|following| make_room(registers, following));
        let mut draws = Draws::new(&self.varying, &self.keys, path, block);
        let mut standard = Column::ZERO;
        for first in (0..count).step_by(COLUMN) {
            draws.scores_on(path, scores, &places);
            self.values(path, scores, values);
            registers[..quantities].clone_from_slice(values);
            self.schedule.run_on(path, registers);
            for (number, prepared) in changes.iter().enumerate() {
                let Prepared { change, following, has_shape_before } = prepared;
                let mut scheduled = &self.schedule.outputs;
                if let Some(following) = following {
                    let changed = &mut registers[following.variables[0]];
                    match change {
                        Change::None => {}
                        Change::Shape(place, from_score) => {
                            if !has_shape_before {
                                from_score.standard_on(path, &scores[*place], &mut standard);
                            }
                            from_score.placed(&standard, changed);
                        }
                        Change::Width { place, mean, factor } => {
                            widen(&values[*place], *mean, *factor, changed);
                        }
                    }
                    following.run_on(path, registers);
                    scheduled = &following.outputs;
                }
                let outputs = self.all(scheduled, registers, found);
                taker.take(path, number, outputs, (count - first).min(COLUMN));
            }
        }
    }

    /// Passes on the outputs at the points of a scrambled net, column by column: for the first
    /// sample (0) and the second one (1), then for the second with each of the sets of quantities
    /// taken from the first. With (A, B) = (second, first) these are the terms of Jansen's
    /// estimators: A, B, and A with one set from B. The dimensions of the second sample follow
    /// those of the first.
    pub(super) fn mixed(
        &self,
        path: CodePath,
        net: u64,
        sets: &[PreparedSet<'_>],
        buffers: &mut Buffers,
        taker: &mut dyn Taker,
    ) {
        let Buffers { scores, values, second, registers, outputs: found } = buffers;
        let quantities = self.variables.len();
        sets.iter().for_each(|set| make_room(registers, &set.following));
        let seed = self.seed.wrapping_mul(NETS).wrapping_add(net);
        let coordinates = [0, quantities].map(|first| -> Vec<NetCoordinate> {
            self.dimensions.iter().map(|d| NetCoordinate::new(first + d, seed)).collect()
        });
        let blocks = NET_POINTS.div_ceil(BLOCK);
        for block in 0..blocks {
            let streams = net * blocks as u64 + block as u64;
            let mut draws = [&self.keys, &self.second]
                .map(|keys| Draws::new(&self.varying, keys, path, streams));
            let points = block * BLOCK..((block + 1) * BLOCK).min(NET_POINTS);
            for first in points.step_by(COLUMN) {
                let samples = draws.iter_mut().zip(&coordinates);
                for ((draws, coordinates), sample) in samples.zip([&mut *values, &mut *second]) {
                    self.scores_at(coordinates, first, scores);
                    draws.scores_from_on(path, scores, &self.places());
                    self.values(path, scores, sample);
                }
                // the second sample last, as the sets are put into it
                for (number, sample) in [&*values, &*second].into_iter().enumerate() {
                    registers[..quantities].clone_from_slice(sample);
                    self.schedule.run_on(path, registers);
                    let outputs = self.all(&self.schedule.outputs, registers, found);
                    taker.take(path, number, outputs, COLUMN);
                }
                for (number, PreparedSet { places, following }) in sets.iter().enumerate() {
                    for (&place, &register) in places.iter().zip(&following.variables) {
                        registers[register].0 = values[place].0;
                    }
                    following.run_on(path, registers);
                    let outputs = self.all(&following.outputs, registers, found);
                    taker.take(path, 2 + number, outputs, COLUMN);
                }
            }
        }
    }

    /// Independent standard normal scores of the quantities that have them, at `COLUMN` points of a
    /// net.
    fn scores_at(&self, coordinates: &[NetCoordinate], first: usize, scores: &mut [Column]) {
        let quantities = coordinates.iter().zip(&self.from_score).zip(scores);
        for ((coordinate, _), scores) in quantities.filter(|((_, from), _)| from.is_some()) {
            for (point, score) in scores.0.iter_mut().enumerate() {
                *score = special::normal::quantile(coordinate.at((first + point) as u32));
            }
        }
    }

    /// The places of all quantities.
    fn places(&self) -> Vec<usize> {
        (0..self.variables.len()).collect()
    }

    /// The values of all quantities in the first `blocks` blocks, column by column.
    pub(super) fn drawn(&self, path: CodePath, block: u64, buffers: &mut Buffers) -> Vec<Column> {
        let Buffers { scores, values, .. } = buffers;
        let places = self.places();
        let mut draws = Draws::new(&self.varying, &self.keys, path, block);
        let mut drawn = Vec::with_capacity(BLOCK / COLUMN * places.len());
        for _ in 0..BLOCK / COLUMN {
            draws.scores_on(path, scores, &places);
            self.values(path, scores, values);
            drawn.extend_from_slice(values);
        }
        drawn
    }

    /// The steps to an output if only the quantity at `place` changes; `None` if the output does
    /// not depend on it.
    pub(super) fn widening(&self, place: usize, output: usize) -> Option<Widening<'_>> {
        let outputs = self.schedule.outputs.get(output..=output)?;
        let following = self.schedule.following_to(&[place], outputs);
        following.moves(0).then_some(Widening { sampler: self, place, output, following })
    }

    fn values(&self, path: CodePath, scores: &[Column], values: &mut [Column]) {
        for (q, from_score) in self.from_score.iter().enumerate() {
            match from_score {
                Some(from_score) => from_score.values_on(path, &scores[q], &mut values[q]),
                None => values[q].0 = scores[q].0,
            }
        }
    }

    /// The columns of all outputs after the steps that end in `scheduled` have run; those that are
    /// not in a register as they are go to `found`.
    fn all<'a>(
        &'a self,
        scheduled: &'a [ScheduledOutput],
        registers: &'a [Column],
        found: &'a mut [Column],
    ) -> Outputs<'a> {
        for (output, (&at, found)) in scheduled.iter().zip(&mut *found).enumerate() {
            if in_register(at, &self.branches[output]).is_none() {
                self.found(at, registers, output, &mut found.0);
            }
        }
        Outputs { scheduled, branches: &self.branches, registers, found }
    }

    /// The column of a scheduled output.
    fn found(&self, found: ScheduledOutput, registers: &[Column], output: usize, out: &mut [f64]) {
        match found {
            ScheduledOutput::Register(register) => out.copy_from_slice(&registers[register].0),
            ScheduledOutput::Constant(value) => out.fill(value),
        }
        if let Some((middle, turn)) = self.branches[output] {
            onto_branch(out, middle, turn);
        }
    }
}

/// The dimension of each of the varying quantities in a net: those of the largest shares of an output's
/// variance take the first ones, which fill the space most evenly.
fn dimensions(variables: &[usize], gum: &GumRow) -> Vec<usize> {
    let mut shares = vec![0.0_f64; variables.len()];
    for line in gum.outputs.iter().flatten().flat_map(Gum::budget) {
        if let Ok(place) = variables.binary_search(&line.variable) {
            shares[place] = shares[place].max(line.share.abs());
        }
    }
    let mut order: Vec<usize> = (0..variables.len()).collect();
    largest_first(&mut order, |&place| shares[place]);
    let mut dimensions = vec![0; variables.len()];
    order.iter().enumerate().for_each(|(dimension, &place)| dimensions[place] = dimension);
    dimensions
}

/// The register of an output whose values are taken as they are.
#[inline(always)]
fn in_register(scheduled: ScheduledOutput, branch: &Option<(f64, f64)>) -> Option<usize> {
    match (scheduled, branch) {
        (ScheduledOutput::Register(register), None) => Some(register),
        _ => None,
    }
}

/// A column of trials of every output.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outputs<'a> {
    scheduled: &'a [ScheduledOutput],
    branches: &'a [Option<(f64, f64)>],
    registers: &'a [Column],
    found: &'a [Column],
}

impl<'a> Outputs<'a> {
    /// The column of an output.
    #[inline(always)]
    pub(super) fn column(self, output: usize) -> &'a Column {
        match in_register(self.scheduled[output], &self.branches[output]) {
            Some(register) => &self.registers[register],
            None => &self.found[output],
        }
    }

    /// The columns of all outputs.
    #[inline(always)]
    pub(super) fn columns(self) -> impl Iterator<Item = &'a Column> {
        (0..self.scheduled.len()).map(move |output| self.column(output))
    }
}

/// Allocates the registers of steps that are computed again.
fn make_room(registers: &mut Vec<Column>, following: &Following) {
    if registers.len() < following.registers {
        registers.resize(following.registers, Column::ZERO);
    }
}

/// Distances from the mean multiplied.
fn widen(values: &Column, mean: f64, factor: f64, out: &mut Column) {
    for i in 0..COLUMN {
        out.0[i] = mean + factor * (values.0[i] - mean);
    }
}

/// Receives the outputs of trials, column by column.
pub(super) trait Taker {
    /// Receives the first `count` trials of a column of all outputs, under the change or for the
    /// sample with this number.
    fn take(&mut self, path: CodePath, number: usize, outputs: Outputs<'_>, count: usize);
}

/// The steps to an output if only one quantity changes.
#[derive(Clone, Debug)]
pub(super) struct Widening<'a> {
    sampler: &'a Sampler,
    place: usize,
    output: usize,
    following: Following,
}

impl Widening<'_> {
    /// The registers of computed values that are needed again, besides those of the variables.
    fn computed(&self) -> &[usize] {
        let variables = self.sampler.variables.len();
        let first = self.following.reads.partition_point(|&register| register < variables);
        &self.following.reads[first..]
    }

    /// Number of columns that [`Self::before`] adds for each column of trials.
    pub(super) fn columns(&self) -> usize {
        self.computed().len()
    }

    /// Adds the columns computed from a column of trials by the steps that do not depend on the
    /// quantity.
    pub(super) fn before(
        &self,
        path: CodePath,
        values: &[Column],
        buffers: &mut Buffers,
        before: &mut Vec<Column>,
    ) {
        let registers = &mut buffers.registers;
        self.run_before(path, values, registers);
        before.extend(self.computed().iter().map(|&register| registers[register].clone()));
    }

    fn run_before(&self, path: CodePath, values: &[Column], registers: &mut [Column]) {
        registers[..values.len()].clone_from_slice(values);
        self.sampler.schedule.run_on(path, registers);
    }

    /// The output for one column of trials, in which the quantity's values are `mean` plus `factor`
    /// times their distances from it. `before` holds the columns computed before, or nothing, in
    /// which case they are computed again.
    pub(super) fn widened(
        &self,
        path: CodePath,
        values: &[Column],
        before: &[Column],
        (mean, factor): (f64, f64),
        buffers: &mut Buffers,
        out: &mut [f64],
    ) {
        let registers = &mut buffers.registers;
        make_room(registers, &self.following);
        let Widening { sampler, place, output, following } = self;
        let computed = self.computed();
        if before.len() == computed.len() {
            let variables = &following.reads[..following.reads.len() - computed.len()];
            for &variable in variables {
                registers[variable].0 = values[variable].0;
            }
            for (&register, column) in computed.iter().zip(before) {
                registers[register].0 = column.0;
            }
        } else {
            self.run_before(path, values, registers);
        }
        widen(&values[*place], mean, factor, &mut registers[following.variables[0]]);
        following.run_on(path, registers);
        sampler.found(following.outputs[0], registers, *output, out);
    }
}
