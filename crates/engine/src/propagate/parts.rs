//! A run on more than one machine: cut into passes over ranges of blocks, which are made anywhere and
//! put together.
//!
//! The trials of a run lie in blocks that are numbered from 0, and a pass ([`SharedPass`]) says what is
//! to be counted in them. [`SharedPass::part`] does so for a range of blocks; [`Merging`] takes the
//! parts in any order, one at a time, and gives the evaluation, which has the bits of
//! [`evaluate`](super::evaluate), or the next pass. Passes and parts are bytes, to be carried in files
//! or messages; they belong to one task with one version of this program, which whoever carries them
//! has to see to.
//!
//! ```
//! use gumption_engine::distribution::Input;
//! use gumption_engine::propagate::parts::{Merged, Merging, SharedPass, blocks};
//! use gumption_engine::propagate::{Control, evaluate};
//! use gumption_engine::task::{Settings, Task, Trials};
//! use gumption_measurements::InclinedPlane;
//!
//! let plane = InclinedPlane {
//!     a_ref: Input::normal(10.0, 0.01, "m/s^2")?,
//!     tilt: Input::rectangular(35.0, 0.1, "deg")?,
//!     rotation: Input::constant(0.0, "deg")?,
//! };
//! let settings = Settings::default().with_trials(Trials::Fixed(100_000));
//! let (task, control) = (Task::of(plane, settings)?, Control::default());
//! let last = blocks(&task)?;
//! let mut pass = SharedPass::first(&task, &control)?;
//! let evaluation = loop {
//!     let mut merging = Merging::new(&task, &pass, control)?;
//!     for range in [40..last, 0..40] {
//!         let part = pass.part(&task, range.clone(), &control)?.expect("it is not stopped");
//!         merging.add(range, &part)?;
//!     }
//!     match merging.finish(false)? {
//!         Merged::Evaluation(evaluation, _) => break evaluation,
//!         Merged::Again(next) => pass = next,
//!         _ => unreachable!("there is nothing else"),
//!     }
//! };
//! let whole = evaluate(&task, &control)?;
//! let [a, b] = [&evaluation, &whole].map(|of| of.rows[0].outputs[2].monte_carlo.clone());
//! assert_eq!(a, b);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use crate::parallel;

use super::Control;
use super::evaluation::{
    ROWS_AT_A_TIME, decided, evaluate_rows, goes_on, in_pool, joint, of_one_row, reach,
};
use super::evaluation_error::EvaluationError;
use super::figures::Evaluation;
use super::gum::{self, Gum, GumRow};
use super::moment_order::moment_orders;
use super::monte_carlo::{
    ByteReader, Finished, Gathered, Prepared, Request, RowOutcome, RowPass, RowTrials, Writer,
    share,
};
use crate::distribution::{BLOCK, Scores};
use crate::number::COLUMN;
use crate::task::{Row, Task, Trials};

pub use super::monte_carlo::Damaged;

/// Why a run cannot be cut into parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NotShared {
    /// It has no trials.
    NoTrials,
    /// The number of trials is found as they are made, each block after the one before it.
    Adaptive,
}

impl fmt::Display for NotShared {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NoTrials => "a run without trials has no blocks to share",
            Self::Adaptive => {
                "an adaptive run decides after each block whether there is another, so its blocks \
                 cannot be shared; give a number of trials"
            }
        })
    }
}

impl std::error::Error for NotShared {}

/// Up to so many rows of conditions are cut as one is; of more, each is made whole by one part. The
/// same number shares the memory.
const MOST_CUT_ROWS: usize = ROWS_AT_A_TIME;

/// Whether the rows of a task are cut into parts.
fn is_cut(task: &Task) -> bool {
    matches!(task.settings.trials, Trials::Fixed(_)) && task.rows.len() <= MOST_CUT_ROWS
}

/// Into how many blocks the trials of a task are cut: ranges of them are the parts of each of its
/// passes. A block is 1024 trials of what was asked for; the blocks of several rows of conditions are
/// counted together.
///
/// # Errors
/// A run that cannot be shared.
pub fn blocks(task: &Task) -> Result<u64, NotShared> {
    let rows = task.rows.len() as u64;
    match task.settings.trials {
        Trials::Fixed(0) => Err(NotShared::NoTrials),
        Trials::Fixed(trials) => Ok(trials.div_ceil(BLOCK as u64).saturating_mul(rows)),
        Trials::Adaptive if rows > 1 => Ok(rows),
        Trials::Adaptive => Err(NotShared::Adaptive),
    }
}

/// A pass over the blocks of a run: what is to be counted in them.
#[derive(Clone, Debug)]
pub struct SharedPass {
    number: u64,
    work: Work,
}

#[derive(Clone, Debug)]
enum Work {
    /// Whole rows of conditions.
    Rows,
    /// The trials of every row, as far as its figures are not there yet.
    Cut(Vec<RowState>),
}

/// How far a row that is cut has come.
#[derive(Clone, Debug)]
enum RowState {
    Finished(Box<Finished>),
    Open(Box<RowPass>),
}

impl SharedPass {
    /// The first pass of a run. `control` has the memory that the run on one machine would have.
    ///
    /// # Errors
    /// Correlations that cannot be drawn; threads that cannot be started.
    pub fn first(task: &Task, control: &Control<'_>) -> Result<Self, EvaluationError> {
        let Trials::Fixed(trials) = task.settings.trials else {
            return Ok(Self { number: 1, work: Work::Rows });
        };
        if !is_cut(task) {
            return Ok(Self { number: 1, work: Work::Rows });
        }
        let control = &of_one_row(task, control);
        let rows = in_pool(task, control, || {
            let first = |row: CutRow| {
                let request = row.request(task, trials);
                RowState::Open(Box::new(RowPass::first(&row.trials, request, control)))
            };
            let rows = CutRow::all(task, control)?;
            Ok::<_, EvaluationError>(rows.into_iter().map(first).collect())
        })??;
        Ok(Self { number: 1, work: Work::Cut(rows) })
    }

    /// How many passes there were with it.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// The pass as bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut out = Writer::default();
        out.number(self.number);
        let rows = match &self.work {
            Work::Rows => &[][..],
            Work::Cut(rows) => rows,
        };
        for row in rows {
            match row {
                RowState::Finished(finished) => {
                    out.flag(true);
                    finished.write(&mut out);
                }
                RowState::Open(pass) => {
                    out.flag(false);
                    pass.write(&mut out);
                }
            }
        }
        out.into_bytes()
    }

    /// The pass over the blocks of a task that these bytes are.
    ///
    /// # Errors
    /// Bytes that are none.
    pub fn from_bytes(bytes: &[u8], task: &Task) -> Result<Self, Damaged> {
        let mut from = ByteReader::new(bytes);
        let number = from.at_most(u64::from(u32::MAX), "too many passes")?;
        let Trials::Fixed(asked) = task.settings.trials else {
            from.end()?;
            return Ok(Self { number, work: Work::Rows });
        };
        let most = task.settings.decide_up_to.max(asked);
        let scores = Scores::WRITTEN.values().count();
        let outputs = task.model.outputs.len();
        let rows = task.rows.iter().take(if is_cut(task) { MOST_CUT_ROWS } else { 0 }).map(|row| {
            let inputs = varying(row);
            if from.flag()? {
                let finished = Finished::read(&mut from, outputs, inputs)?;
                return Ok(RowState::Finished(Box::new(finished)));
            }
            let pass = RowPass::read(&mut from, outputs, inputs, scores)?;
            Damaged::unless((asked..=most).contains(&pass.trials), "a pass over other trials")?;
            Ok(RowState::Open(Box::new(pass)))
        });
        let rows = rows.collect::<Result<Vec<_>, Damaged>>()?;
        from.end()?;
        let work = if is_cut(task) { Work::Cut(rows) } else { Work::Rows };
        Ok(Self { number, work })
    }

    /// Makes the part of the pass that belongs to a range of the task's blocks; `None` if it was
    /// stopped.
    ///
    /// # Errors
    /// Correlations that cannot be drawn; threads that cannot be started.
    pub fn part(
        &self,
        task: &Task,
        blocks: Range<u64>,
        control: &Control<'_>,
    ) -> Result<Option<Vec<u8>>, EvaluationError> {
        let of = self::blocks(task).unwrap_or(0);
        in_pool(task, control, || match &self.work {
            Work::Rows => rows(task, share(&blocks, of, task.rows.len() as u64), control),
            Work::Cut(states) => {
                let control = &of_one_row(task, control);
                let mut out = Writer::default();
                for (row, state) in CutRow::all(task, control)?.into_iter().zip(states) {
                    let RowState::Open(pass) = state else { continue };
                    let prepared = row.prepared(task, control, pass);
                    let Some(part) = prepared.part(share(&blocks, of, prepared.chunks())) else {
                        return Ok(None);
                    };
                    prepared.write(&part, &mut out);
                }
                Ok(Some(out.into_bytes()))
            }
        })?
    }
}

/// What is known of a row before its trials.
struct CutRow {
    trials: RowTrials,
    gums: Vec<Option<Gum>>,
    moment_order: Vec<f64>,
}

impl CutRow {
    /// Every row of a task.
    fn all(task: &Task, control: &Control<'_>) -> Result<Vec<Self>, EvaluationError> {
        let reaches = reach(&task.model.program, task.variables.len());
        let linear = gum::GumRows::of(task).evaluate_all(&task.rows, control.path);
        let of_row = |(row, linear): (&Row, GumRow)| {
            let joint = joint(task, row)?;
            let trials = RowTrials::new(task, row, &linear.estimates, &joint);
            let moment_order = moment_orders(task, row, &reaches, &linear);
            Ok(Self { trials, gums: linear.outputs, moment_order })
        };
        task.rows.iter().zip(linear).map(of_row).collect()
    }

    fn request(&self, task: &Task, trials: u64) -> Request<'_> {
        let probability = task.settings.coverage.probability();
        Request { trials, probability, moment_order: &self.moment_order }
    }

    fn prepared<'a>(self, task: &Task, control: &Control<'a>, pass: &RowPass) -> Prepared<'a> {
        let probability = task.settings.coverage.probability();
        Prepared::new(self.trials, probability, self.moment_order, *control, pass.clone())
    }
}

/// How many inputs vary in a row.
fn varying(row: &Row) -> usize {
    row.distributions.iter().filter(|distribution| distribution.constant().is_none()).count()
}

/// The figures of some whole rows.
fn rows(
    task: &Task,
    range: Range<u64>,
    control: &Control<'_>,
) -> Result<Option<Vec<u8>>, EvaluationError> {
    let reaches = reach(&task.model.program, task.variables.len());
    let gum = gum::GumRows::of(task);
    let control = &of_one_row(task, control);
    let rows = &task.rows[range.start as usize..range.end as usize];
    let of_row = |(row, linear): (_, GumRow)| -> Result<Finished, EvaluationError> {
        let joint = joint(task, row)?;
        let mut trials = RowTrials::new(task, row, &linear.estimates, &joint);
        let moment_order = moment_orders(task, row, &reaches, &linear);
        Ok(decided(task, &mut trials, &linear.outputs, &moment_order, control))
    };
    let found = parallel::map(rows.chunks(COLUMN), |rows| {
        let linear = gum.evaluate_all(rows, control.path);
        parallel::map(rows.iter().zip(linear), of_row)
    });
    let found: Vec<Finished> = found.into_iter().flatten().collect::<Result<_, _>>()?;
    let mut out = Writer::default();
    found.iter().for_each(|row| row.write(&mut out));
    Ok((!control.is_stopped()).then(|| out.into_bytes()))
}

/// What was made of the parts of a pass.
#[derive(Debug)]
#[non_exhaustive]
pub enum Merged {
    /// The evaluation, the same as that of a run on one machine, and the quantiles, if they were
    /// asked for and took passes: those of [`quantiles`](super::quantiles) at
    /// [`Scores::WRITTEN`].
    Evaluation(Box<Evaluation>, Option<Vec<Vec<f64>>>),
    /// Another pass is needed.
    Again(SharedPass),
}

/// Why a part is not taken.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PartError {
    /// Its bytes are no part of this pass.
    Damaged(Damaged),
    /// It has blocks that a part before it had, or that the run has not.
    Blocks(Range<u64>),
}

impl fmt::Display for PartError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Damaged(damaged) => damaged.fmt(f),
            Self::Blocks(range) => {
                let Range { start, end } = range;
                write!(f, "the blocks {start}..{end} are there twice, or are none of this run")
            }
        }
    }
}

impl std::error::Error for PartError {}

impl From<Damaged> for PartError {
    fn from(damaged: Damaged) -> Self {
        Self::Damaged(damaged)
    }
}

/// Puts the parts of a pass together as they come, in any order. Memory does not grow with the number
/// of trials or of parts, but where the run on one machine would hold the tails of all trials.
#[derive(Debug)]
pub struct Merging<'a> {
    task: &'a Task,
    control: Control<'a>,
    number: u64,
    /// The ranges that are there: by its start the end of each.
    covered: BTreeMap<u64, u64>,
    all: u64,
    state: State<'a>,
}

#[derive(Debug)]
enum State<'a> {
    Rows(Vec<Option<Finished>>),
    Cut(Vec<Gathering<'a>>),
}

/// What is put together of a row that is cut.
#[derive(Debug)]
enum Gathering<'a> {
    Finished(Box<Finished>),
    Open { prepared: Box<Prepared<'a>>, gums: Vec<Option<Gum>>, trials: u64, gathered: Gathered },
}

impl<'a> Merging<'a> {
    /// Of a pass over the blocks of a task, with no part yet.
    ///
    /// # Errors
    /// Correlations that cannot be drawn; threads that cannot be started.
    pub fn new(
        task: &'a Task,
        pass: &SharedPass,
        control: Control<'a>,
    ) -> Result<Self, EvaluationError> {
        let state = in_pool(task, &control, || -> Result<State<'a>, EvaluationError> {
            let Work::Cut(states) = &pass.work else {
                return Ok(State::Rows(vec![None; task.rows.len()]));
            };
            let control = of_one_row(task, &control);
            let rows = CutRow::all(task, &control)?.into_iter().zip(states);
            let rows = rows.map(|(mut row, state)| match state {
                RowState::Finished(finished) => Gathering::Finished(finished.clone()),
                RowState::Open(pass) => {
                    let gums = std::mem::take(&mut row.gums);
                    let prepared = row.prepared(task, &control, pass);
                    let gathered = prepared.gather();
                    let (prepared, trials) = (Box::new(prepared), pass.trials);
                    Gathering::Open { prepared, gums, trials, gathered }
                }
            });
            Ok(State::Cut(rows.collect()))
        })??;
        let (number, all) = (pass.number, blocks(task).unwrap_or(0));
        Ok(Self { task, control, number, covered: BTreeMap::new(), all, state })
    }

    /// Takes the part of a range of blocks.
    ///
    /// # Errors
    /// Bytes that are no such part, and blocks that are there already; nothing is taken then.
    pub fn add(&mut self, blocks: Range<u64>, part: &[u8]) -> Result<(), PartError> {
        let before = self.covered.range(..blocks.end).next_back();
        let free = before.is_none_or(|(_, end)| *end <= blocks.start);
        if blocks.is_empty() || blocks.end > self.all || !free {
            return Err(PartError::Blocks(blocks));
        }
        let mut from = ByteReader::new(part);
        match &mut self.state {
            State::Rows(found) => {
                let own = share(&blocks, self.all, found.len() as u64);
                let own = own.start as usize..own.end as usize;
                let outputs = self.task.model.outputs.len();
                let rows = self.task.rows[own.clone()].iter();
                let rows = rows.map(|row| Finished::read(&mut from, outputs, varying(row)));
                let rows = rows.collect::<Result<Vec<_>, _>>()?;
                from.end()?;
                for (slot, row) in found[own].iter_mut().zip(rows) {
                    *slot = Some(row);
                }
            }
            State::Cut(rows) => {
                let mut read = Vec::new();
                for row in rows.iter() {
                    let Gathering::Open { prepared, .. } = row else { continue };
                    let own = share(&blocks, self.all, prepared.chunks());
                    read.push((own.start, prepared.read(&mut from, own)?));
                }
                from.end()?;
                // nothing is taken before all is read
                let mut read = read.into_iter();
                for row in rows {
                    let Gathering::Open { gathered, .. } = row else { continue };
                    let Some((first, part)) = read.next() else { break };
                    gathered.add(first, part);
                }
            }
        }
        self.cover(blocks);
        Ok(())
    }

    /// Notes a range; those that touch become one.
    fn cover(&mut self, blocks: Range<u64>) {
        let Range { mut start, mut end } = blocks;
        if let Some((&first, &last)) = self.covered.range(..start).next_back()
            && last == start
        {
            start = first;
        }
        if let Some(last) = self.covered.remove(&end) {
            end = last;
        }
        self.covered.insert(start, end);
    }

    /// The ranges of blocks that are not there yet.
    pub fn missing(&self) -> Vec<Range<u64>> {
        let mut missing = Vec::new();
        let mut next = 0;
        for (&start, &end) in &self.covered {
            if start > next {
                missing.push(next..start);
            }
            next = end;
        }
        if next < self.all {
            missing.push(next..self.all);
        }
        missing
    }

    /// The evaluation, or the next pass. All blocks must be there; where some are missing the figures
    /// are not those of the run. `with_quantiles` asks for what a result file holds; where it takes
    /// no passes ([`quantiles`](super::quantiles)) there is none of it.
    ///
    /// # Errors
    /// As [`evaluate`](super::evaluate).
    pub fn finish(self, with_quantiles: bool) -> Result<Merged, EvaluationError> {
        let Self { task, control, number, state, .. } = self;
        in_pool(task, &control, || {
            let mut quantiles = None;
            let found = match state {
                State::Rows(found) => found,
                State::Cut(rows) => {
                    let with_quantiles = with_quantiles && rows.len() == 1;
                    let of_one = of_one_row(task, &control);
                    let step = |row| finish_row(task, row, with_quantiles, &of_one, &mut quantiles);
                    let rows: Vec<RowState> = rows.into_iter().map(step).collect();
                    if rows.iter().any(|row| matches!(row, RowState::Open(_))) {
                        let work = Work::Cut(rows);
                        return Ok(Merged::Again(SharedPass { number: number + 1, work }));
                    }
                    let finished = rows.into_iter().map(|row| match row {
                        RowState::Finished(finished) => Some(*finished),
                        RowState::Open(_) => None,
                    });
                    finished.collect()
                }
            };
            let found: Vec<Mutex<Option<Finished>>> = found.into_iter().map(Mutex::new).collect();
            let known =
                |row: usize| found.get(row)?.lock().unwrap_or_else(PoisonError::into_inner).take();
            let evaluation = evaluate_rows(task, &control, &known)?;
            Ok(Merged::Evaluation(Box::new(evaluation), quantiles))
        })?
    }
}

/// What comes after a pass over a row: its figures, or another pass.
fn finish_row(
    task: &Task,
    row: Gathering<'_>,
    with_quantiles: bool,
    control: &Control<'_>,
    quantiles: &mut Option<Vec<Vec<f64>>>,
) -> RowState {
    let (mut prepared, gums, trials, gathered) = match row {
        Gathering::Finished(finished) => return RowState::Finished(finished),
        Gathering::Open { prepared, gums, trials, gathered } => (prepared, gums, trials, gathered),
    };
    let scores: Vec<f64> = Scores::WRITTEN.values().collect();
    let finished = match prepared.finish(gathered, &scores) {
        RowOutcome::Finished(finished, found) => {
            *quantiles = found;
            finished
        }
        RowOutcome::Next(next) => return RowState::Open(next),
    };
    if let Some(further) = goes_on(task, &gums, &finished, trials) {
        let probability = task.settings.coverage.probability();
        let request =
            Request { trials: further, probability, moment_order: prepared.moment_order() };
        let first = RowPass::first(prepared.trials(), request, control);
        return RowState::Open(Box::new(first));
    }
    let wanted = with_quantiles && quantiles.is_none();
    match wanted.then(|| prepared.quantiles(&finished)).flatten() {
        Some(next) => RowState::Open(Box::new(next)),
        None => RowState::Finished(finished),
    }
}

#[cfg(test)]
mod tests;
