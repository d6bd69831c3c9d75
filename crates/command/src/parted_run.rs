//! A run that is made in parts: its passes and parts as the bytes of files, whoever carries them.
//!
//! `gumption run --blocks` and `gumption merge` carry them in files of a folder; a program that has an
//! executor of its own hands them over as they are.

use std::fmt::Display;
use std::ops::Range;

use super::{Failure, run};
use gumption_engine::propagate::parts::{Merged, Merging, SharedPass, blocks};
use gumption_engine::propagate::{Control, Evaluation, EvaluationError};
use gumption_engine::task::Task;
use gumption_files::{ModelFile, SharedFileHeader, SharedFileKind, SharedRun, shared_file};

/// A run that is made in parts.
#[derive(Clone, Copy, Debug)]
pub struct PartedRun<'a> {
    pub(super) file: &'a ModelFile,
    pub(super) task: &'a Task,
    pub(super) run: &'a SharedRun,
}

/// A pass over the blocks of a run, and the bytes that the engine writes of it.
#[derive(Clone, Debug)]
pub struct PassOfRun {
    pub(super) pass: SharedPass,
    pub(super) bytes: Vec<u8>,
}

impl PassOfRun {
    pub(super) fn of(pass: SharedPass) -> Self {
        let bytes = pass.to_bytes();
        Self { pass, bytes }
    }

    /// Its number, from 1.
    pub fn number(&self) -> u64 {
        self.pass.number()
    }

    /// The header of a file of this pass.
    pub(super) fn header(&self, run: &SharedRun, kind: SharedFileKind) -> SharedFileHeader {
        SharedFileHeader::new(run.clone(), self.number(), &self.bytes, kind)
    }

    /// The file `next-pass` that holds it.
    pub fn file(&self, run: &SharedRun) -> Vec<u8> {
        self.header(run, SharedFileKind::Pass).file(&self.bytes)
    }
}

/// Why something that is called so is not taken.
pub(super) fn refused(name: &dyn Display, reason: &dyn Display) -> Failure {
    Failure::Argument(format!("{name}: {reason}"))
}

impl<'a> PartedRun<'a> {
    /// The run of a task that a model file gave; `run` is what its parts are told by.
    pub fn new(file: &'a ModelFile, task: &'a Task, run: &'a SharedRun) -> Self {
        Self { file, task, run }
    }

    /// How many blocks there are to share.
    ///
    /// # Errors
    /// A run that cannot be shared.
    pub fn blocks(&self) -> Result<u64, Failure> {
        blocks(self.task).map_err(|reason| Failure::Argument(reason.to_string()))
    }

    fn failed(&self, error: EvaluationError) -> Failure {
        run::failure(self.file, error)
    }

    /// The first pass.
    ///
    /// # Errors
    /// Correlations that cannot be drawn; threads that cannot be started.
    pub fn first(&self, control: &Control<'_>) -> Result<PassOfRun, Failure> {
        let pass = SharedPass::first(self.task, control).map_err(|error| self.failed(error))?;
        Ok(PassOfRun::of(pass))
    }

    /// The pass of a file; `name` is used in messages.
    ///
    /// # Errors
    /// A file that is none, or of another run.
    pub fn pass(&self, name: &dyn Display, file: &[u8]) -> Result<PassOfRun, Failure> {
        let (header, content) = shared_file(file).map_err(|error| refused(name, &error))?;
        if header.kind != SharedFileKind::Pass {
            return Err(refused(name, &"it is a part of a run, not the file `next-pass`"));
        }
        if let Some(difference) = self.run.difference(&header.run) {
            return Err(refused(name, &format!("this file {difference}")));
        }
        let pass =
            SharedPass::from_bytes(content, self.task).map_err(|error| refused(name, &error))?;
        Ok(PassOfRun { pass, bytes: content.to_owned() })
    }

    /// The file of the part that belongs to a range of blocks; `None` if it was stopped.
    ///
    /// # Errors
    /// Blocks that the run has not; correlations that cannot be drawn; threads that cannot be started.
    pub fn part(
        &self,
        pass: &PassOfRun,
        range: Range<u64>,
        control: &Control<'_>,
    ) -> Result<Option<Vec<u8>>, Failure> {
        let all = self.blocks()?;
        if range.is_empty() || range.end > all {
            let Range { start, end } = range;
            let reason = format!("the run has {all} blocks, and no part of {start}..{end}");
            return Err(Failure::Argument(reason));
        }
        let part = pass.pass.part(self.task, range.clone(), control);
        let part = part.map_err(|error| self.failed(error))?;
        let header = |range| pass.header(self.run, SharedFileKind::Part(range));
        Ok(part.map(|part| header(range).file(&part)))
    }

    /// The blocks of a part of this pass; `None` of one of a pass before it. `again` is what makes a
    /// part again.
    ///
    /// # Errors
    /// A part of another run or of another pass.
    pub(super) fn range(
        &self,
        pass: &PassOfRun,
        name: &dyn Display,
        header: &SharedFileHeader,
        again: &dyn Display,
    ) -> Result<Option<Range<u64>>, Failure> {
        if let Some(difference) = self.run.difference(&header.run) {
            return Err(refused(name, &format!("this part {difference}")));
        }
        let SharedFileKind::Part(range) = &header.kind else { return Ok(None) };
        let number = pass.number();
        if header.pass < number {
            return Ok(None);
        }
        let digest = pass.header(self.run, SharedFileKind::Pass).pass_digest;
        if header.pass != number || header.pass_digest != digest {
            let reason = format!(
                "this part is of another pass over the blocks (number {}, and the run is at number \
                 {number}); make it again{again}",
                header.pass,
            );
            return Err(refused(name, &reason));
        }
        let all = self.blocks()?;
        if range.is_empty() || range.end > all {
            return Err(refused(name, &format!("it has blocks that the run of {all} has not")));
        }
        Ok(Some(range.clone()))
    }

    /// Begins to put the parts of a pass together.
    ///
    /// # Errors
    /// Correlations that cannot be drawn; threads that cannot be started.
    pub fn merging(
        &self,
        pass: &'a PassOfRun,
        control: Control<'a>,
    ) -> Result<PartedMerging<'a>, Failure> {
        let merging = Merging::new(self.task, &pass.pass, control);
        let merging = merging.map_err(|error| self.failed(error))?;
        Ok(PartedMerging { of: *self, pass, merging })
    }
}

/// Puts the parts of a pass together as they come, in any order.
#[derive(Debug)]
pub struct PartedMerging<'a> {
    of: PartedRun<'a>,
    pass: &'a PassOfRun,
    merging: Merging<'a>,
}

impl PartedMerging<'_> {
    /// Takes the file of a part; `name` is used in messages. It gives the blocks of the part.
    ///
    /// # Errors
    /// A file that is none, or of another run or pass; blocks that are there already.
    pub fn add(&mut self, name: &dyn Display, file: &[u8]) -> Result<Range<u64>, Failure> {
        let (header, content) = shared_file(file).map_err(|error| refused(name, &error))?;
        let range = self.of.range(self.pass, name, &header, &"")?;
        let range = range.ok_or_else(|| refused(name, &"it is no part of this pass"))?;
        self.merging.add(range.clone(), content).map_err(|error| refused(name, &error))?;
        Ok(range)
    }

    /// The ranges of blocks that are not there yet.
    pub fn missing(&self) -> Vec<Range<u64>> {
        self.merging.missing()
    }

    /// The evaluation, or the next pass; all blocks must be there.
    ///
    /// # Errors
    /// As of an evaluation on one machine.
    pub fn finish(self, with_quantiles: bool) -> Result<MergedRun, Failure> {
        let Self { of, merging, .. } = self;
        Ok(match merging.finish(with_quantiles).map_err(|error| of.failed(error))? {
            Merged::Evaluation(evaluation, quantiles) => {
                MergedRun::Evaluation(evaluation, quantiles)
            }
            Merged::Again(next) => MergedRun::Again(PassOfRun::of(next)),
            other => {
                return Err(Failure::System(format!("parts gave what is not known: {other:?}")));
            }
        })
    }
}

/// What was made of all parts of a pass.
#[derive(Debug)]
pub enum MergedRun {
    /// The evaluation, and the quantiles that a result file holds, where they took passes.
    Evaluation(Box<Evaluation>, Option<Vec<Vec<f64>>>),
    /// The next pass.
    Again(PassOfRun),
}
