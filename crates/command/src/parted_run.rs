//! A run that is made in parts: its passes and parts as the bytes of files, independent of their
//! transport.
//!
//! `gumption run --blocks` and `gumption merge` store them in files of a folder; a program with its
//! own executor passes them on directly.

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

/// A pass over the blocks of a run, and its description in bytes.
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

    /// The content of the file `next-pass`.
    pub fn file(&self, run: &SharedRun) -> Vec<u8> {
        self.header(run, SharedFileKind::Pass).file(&self.bytes)
    }
}

/// Why a file of this name is rejected.
pub(super) fn refused(name: &dyn Display, reason: &dyn Display) -> Failure {
    Failure::Argument(format!("{name}: {reason}"))
}

impl<'a> PartedRun<'a> {
    /// The run of a task from a model file; `run` identifies its parts.
    pub fn new(file: &'a ModelFile, task: &'a Task, run: &'a SharedRun) -> Self {
        Self { file, task, run }
    }

    /// The number of blocks that can be distributed.
    ///
    /// # Errors
    /// The run cannot be divided.
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
    /// The file is not a pass, or belongs to another run.
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

    /// The file of the part with a range of blocks; `None` if it was stopped.
    ///
    /// # Errors
    /// Blocks that the run does not have; correlations that cannot be drawn; threads that cannot be
    /// started.
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

    /// The blocks of a part of this pass; `None` for a part of an earlier pass. `again` says how to
    /// repeat a part.
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
                "this part belongs to another pass over the blocks (number {}, but the run is at \
                 number \
                 {number}); make it again{again}",
                header.pass,
            );
            return Err(refused(name, &reason));
        }
        let all = self.blocks()?;
        if range.is_empty() || range.end > all {
            return Err(refused(
                name,
                &format!("it has blocks that the run of {all} does not have"),
            ));
        }
        Ok(Some(range.clone()))
    }

    /// Begins to merge the parts of a pass.
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

/// Merges the parts of a pass in any order.
#[derive(Debug)]
pub struct PartedMerging<'a> {
    of: PartedRun<'a>,
    pass: &'a PassOfRun,
    merging: Merging<'a>,
}

impl PartedMerging<'_> {
    /// Adds the file of a part; `name` is used in messages. Returns the blocks of the part.
    ///
    /// # Errors
    /// The file is not a part, or belongs to another run or pass; its blocks are already present.
    pub fn add(&mut self, name: &dyn Display, file: &[u8]) -> Result<Range<u64>, Failure> {
        let (header, content) = shared_file(file).map_err(|error| refused(name, &error))?;
        let range = self.of.range(self.pass, name, &header, &"")?;
        let range = range.ok_or_else(|| refused(name, &"it is not a part of this pass"))?;
        self.merging.add(range.clone(), content).map_err(|error| refused(name, &error))?;
        Ok(range)
    }

    /// The missing ranges of blocks.
    pub fn missing(&self) -> Vec<Range<u64>> {
        self.merging.missing()
    }

    /// The evaluation, or the next pass; all blocks must be present.
    ///
    /// # Errors
    /// The errors of an evaluation on one machine.
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

/// The result of all parts of a pass.
#[derive(Debug)]
pub enum MergedRun {
    /// The evaluation, and the quantiles for a result file if they needed passes.
    Evaluation(Box<Evaluation>, Option<Vec<Vec<f64>>>),
    /// The next pass.
    Again(PassOfRun),
}
