//! `gumption verify --paths`

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::output::Place;
use crate::{CommandLine, Exit, Failure, options};
use gumption_engine::number::CodePath;
use gumption_engine::propagate::{Control, trial_hash};
use gumption_engine::task::Trials;

/// Compare code paths.
#[derive(Debug, Args)]
pub(super) struct Paths {
    /// With --paths: the model file whose trials are compared [default: a built-in one]
    #[arg(long, value_name = "FILE", requires = "paths")]
    model: Option<PathBuf>,
    /// With --paths: number of trials
    #[arg(
        long,
        value_name = "N",
        default_value = "1000000",
        requires = "paths",
        value_parser = options::trials,
        allow_negative_numbers = true
    )]
    trials: Trials,
}

impl Paths {
    /// Compares the paths on a number of threads; prints to standard output.
    pub(super) fn execute(
        &self,
        program: &CommandLine,
        threads: usize,
        fail: bool,
    ) -> Result<Exit, Failure> {
        let file = match &self.model {
            Some(path) => program.files().model(path, &[])?,
            None => {
                let name = "inclined-plane-spurious";
                let template = program.catalogue.find(name).and_then(|entry| entry.template);
                let template = template.ok_or_else(|| {
                    Failure::Argument(format!("there is no `{name}` here; give a file (`--model`)"))
                })?;
                program.files().model_text(name, template, Path::new(""), &[])?
            }
        };
        let Trials::Fixed(trials) = self.trials else {
            return Err(Failure::Argument("`--paths` needs a fixed number of trials".to_owned()));
        };
        let mut text = String::new();
        let mut hashes = Vec::new();
        for path in CodePath::available() {
            let control = Control::default().with_path(path).with_threads(threads);
            let hash = trial_hash(&file.task, trials, &control)
                .map_err(|error| Failure::System(error.to_string()))?;
            let _ = writeln!(text, "{:8} {hash:016x}", path.name());
            hashes.push(hash);
        }
        let same = hashes.windows(2).all(|pair| pair[0] == pair[1]);
        let verdict = if same { "the same bits on every path" } else { "the paths DIFFER" };
        let _ = writeln!(text, "{trials} trials: {verdict}");
        Place::StandardOutput.write(&text)?;
        Ok(if !same && fail { Exit::No } else { Exit::Done })
    }
}
