//! Output files of a run besides the answer: a result file, and its trials.

use std::io;
use std::path::{Path, PathBuf};

use super::Failure;
use super::output::Destination;
use gumption_engine::propagate::{Control, EvaluationError, for_each_block};
use gumption_engine::task::{Task, Trials};
use gumption_report as report;
use gumption_report::{EvaluationReport, SaveError, TrialsForm};

/// A file for trials, and its format.
#[derive(Clone, Debug)]
pub(super) struct SampleFile {
    path: PathBuf,
    form: TrialsForm,
}

impl SampleFile {
    pub(super) fn path(&self) -> &Path {
        &self.path
    }
}

/// A file for trials; its extension selects the format.
pub(super) fn samples(text: &str) -> Result<SampleFile, String> {
    let path = PathBuf::from(text);
    let form = path.extension().and_then(|e| TrialsForm::of_extension(&e.to_string_lossy()));
    let form = form.ok_or("a file name that ends in .csv or .npy is needed")?;
    Ok(SampleFile { path, form })
}

/// Checks that the task has the data to be written.
pub(super) fn check(
    task: &Task,
    save: Option<&Path>,
    samples: Option<&SampleFile>,
) -> Result<(), Failure> {
    let option = match (save, samples) {
        (Some(_), _) => "--save",
        (None, Some(_)) => "--samples",
        (None, None) => return Ok(()),
    };
    let refuse = |reason: &str| Err(Failure::Argument(format!("`{option}` {reason}")));
    if task.rows.len() != 1 {
        return refuse(
            "writes one result for each output, but the model has several rows of conditions; \
             evaluate one row at a time",
        );
    }
    if task.settings.trials == Trials::Fixed(0) {
        return refuse("needs Monte Carlo trials, but their number is 0");
    }
    Ok(())
}

/// Writes the requested files besides the answer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Saver<'a> {
    pub(super) report: &'a EvaluationReport<'a>,
    pub(super) control: &'a Control<'a>,
    /// The quantiles of the outputs, if they are known.
    pub(super) quantiles: Option<&'a [Vec<f64>]>,
}

impl From<EvaluationError> for Failure {
    fn from(error: EvaluationError) -> Self {
        Self::System(error.to_string())
    }
}

/// Why a block is not written.
enum BlockError {
    Io(io::Error),
    Evaluation(EvaluationError),
}

impl From<EvaluationError> for BlockError {
    fn from(error: EvaluationError) -> Self {
        Self::Evaluation(error)
    }
}

impl Saver<'_> {
    /// Writes the result file; `false` if the run was stopped and the file is unchanged.
    pub(super) fn result(&self, file: Destination) -> Result<bool, Failure> {
        let text = match report::saved_result(self.report, self.quantiles, self.control) {
            Ok(Some(text)) => text,
            // the run was stopped before the first trial
            Ok(None) | Err(SaveError::NoTrials | SaveError::Rows) => return Ok(false),
            Err(SaveError::Evaluation(error)) => return Err(error.into()),
            Err(error) => return Err(Failure::Argument(format!("`--save`: {error}"))),
        };
        file.write_with(|out| out.write_all(text.as_bytes()).map(|()| true))?;
        Ok(true)
    }

    /// Writes the trials, block by block; `false` if the run was stopped and the file is unchanged.
    pub(super) fn samples(&self, asked: &SampleFile, file: Destination) -> Result<bool, Failure> {
        let EvaluationReport { task, evaluation, .. } = *self.report;
        if self.control.is_stopped() {
            return Ok(false);
        }
        let form = asked.form;
        let names: Vec<&str> =
            task.model.outputs.iter().map(|output| output.quantity.name.as_str()).collect();
        let figures = evaluation.rows.iter().flat_map(|row| &row.outputs);
        let trials = figures.filter_map(|output| output.monte_carlo.as_deref()).map(|m| m.trials);
        let header = form.header(&names, trials.max().unwrap_or(0));
        let (mut whole, mut failed) = (false, None);
        file.write_with(|out| {
            out.write_all(&header)?;
            let blocks = for_each_block(task, evaluation, 0, self.control, |block| {
                out.write_all(&form.block(block)).map_err(BlockError::Io)
            });
            match blocks {
                Ok(done) => whole = done,
                Err(BlockError::Io(error)) => return Err(error),
                Err(BlockError::Evaluation(error)) => failed = Some(error),
            }
            Ok(whole)
        })?;
        failed.map_or(Ok(whole), |error| Err(error.into()))
    }
}
