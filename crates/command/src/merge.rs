//! `gumption merge`

use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

use clap::Args;

use super::evaluated::Evaluated;
use super::options::{Threads, Trust};
use super::parted_run::{MergedRun, PartedRun};
use super::parts::{NEXT_PASS, PartsFolder};
use super::{CommandLine, Exit, Failure, signals};
use gumption_files::{SharedModelError, SharedRun};

/// Merge the parts of a run (`gumption run --blocks`) and print its answer.
///
/// Combines the parts that `gumption run --blocks` wrote to a folder. The answer is the same as
/// that of a run on one machine. If another pass over the blocks is needed, the command ends with
/// exit code 75 and writes a file `next-pass` in the folder, for `gumption run --blocks … --pass`.
#[derive(Debug, Args)]
pub(super) struct Merge {
    /// The folder with the parts
    folder: PathBuf,
    /// The model file, if it is not where the parts were made
    #[arg(long, value_name = "FILE")]
    model: Option<PathBuf>,
    #[command(flatten)]
    trust: Trust,
    #[command(flatten)]
    evaluated: Evaluated,
    #[command(flatten)]
    threads: Threads,
}

impl Merge {
    pub(super) fn execute(&self, program: &CommandLine) -> Result<Exit, Failure> {
        let folder = PartsFolder::open(&self.folder)?;
        let run = folder.run()?;
        if run.version != env!("CARGO_PKG_VERSION") {
            return Err(Failure::Argument(format!(
                "the parts in `{}` were made by gumption {}, but this is {}; versions may differ \
                 in the last digits, so use that version to merge",
                self.folder.display(),
                run.version,
                env!("CARGO_PKG_VERSION")
            )));
        }
        let model = run.model(self.trust.files(program), self.model.as_deref());
        let file = model.map_err(|error| match error {
            SharedModelError::Model(diagnostics) => Failure::Diagnostics(diagnostics),
            other => Failure::Argument(format!("{other}; name it with `--model FILE`")),
        })?;
        let task = file.task.clone();
        self.evaluated.check(&task)?;
        let mut read: Vec<PathBuf> = folder.files().collect();
        read.extend(self.model.clone());
        read.extend(run.model_path.as_ref().map(PathBuf::from));
        let places = self.evaluated.open(&read)?;
        // a signal ends it at once: the parts are kept
        let never = AtomicBool::new(false);
        let control = self.threads.control(&never).with_memory(run.memory);
        match folder.merge(&PartedRun::new(&file, &task, &run), self.evaluated.saves(), &control)? {
            MergedRun::Evaluation(evaluation, quantiles) => {
                let SharedRun { set, .. } = &run;
                let found = (&file, &task, &*evaluation, quantiles);
                let stop = signals::stop_flag();
                let control = control.with_stop(&stop);
                self.evaluated.give(found, set, places, (&control, &stop))
            }
            MergedRun::Again(next) => {
                let number = next.number();
                folder.write_next(&run, &next)?;
                let path = self.folder.join(NEXT_PASS);
                self.evaluated.answer.note([format!(
                    "pass {number} over the blocks is needed: repeat each part with `--pass {}`, \
                     and merge again",
                    path.display()
                )
                .as_str()]);
                Ok(Exit::Again)
            }
        }
    }
}
