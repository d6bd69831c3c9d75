//! `gumption verify --paths`

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;

use super::{Exit, Failure, options, output};
use crate::file;
use crate::model::typed;
use crate::number::CodePath;
use crate::propagate::{Control, trial_hash};
use crate::task::Trials;

/// Compare code paths.
#[derive(Debug, Args)]
pub(super) struct Verify {
    /// Run every code path that this machine has and print the hash over all trials of each
    #[arg(long, required = true)]
    paths: bool,
    /// The model file whose trials are compared; a built-in one unless given
    #[arg(long, value_name = "FILE")]
    model: Option<PathBuf>,
    /// Number of trials
    #[arg(long, value_name = "N", default_value = "1000000", value_parser = options::trials)]
    trials: Trials,
    /// Number of threads; all of the machine's unless given
    #[arg(long, value_name = "N", value_parser = options::threads)]
    threads: Option<usize>,
    /// End with exit code 3 if the hashes differ
    #[arg(long)]
    fail: bool,
}

impl Verify {
    pub(super) fn execute(&self) -> Result<Exit, Failure> {
        let file = match &self.model {
            Some(path) => file::read(path, &[])?,
            None => {
                let name = "inclined-plane-spurious";
                let example = typed::find(name).map_or("", |entry| entry.example);
                file::read_text(name, example, std::path::Path::new(""), &[])?
            }
        };
        let Trials::Fixed(trials) = self.trials else {
            return Err(Failure::Argument("a fixed number of trials is compared".to_owned()));
        };
        let mut text = String::new();
        let mut hashes = Vec::new();
        for path in CodePath::available() {
            let control =
                Control { path, threads: self.threads.unwrap_or(0), ..Control::default() };
            let hash = trial_hash(&file.task, trials, &control)
                .map_err(|error| Failure::System(error.to_string()))?;
            let _ = writeln!(text, "{:8} {hash:016x}", path.name());
            hashes.push(hash);
        }
        let same = hashes.windows(2).all(|pair| pair[0] == pair[1]);
        let verdict = if same { "the same bits on every path" } else { "the paths DIFFER" };
        let _ = writeln!(text, "{trials} trials: {verdict}");
        output::write(&text, None)?;
        Ok(if !same && self.fail { Exit::No } else { Exit::Done })
    }
}
