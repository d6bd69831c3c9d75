//! `gumption gap`

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{Exit, Failure, options, output};
use crate::file;
use crate::gap;
use crate::report;

/// Diagnose where measured data depart from a sim, and which effect is missing.
#[derive(Debug, Args)]
pub(super) struct Gap {
    /// The case: a model file with observations and candidate effects
    case: PathBuf,
    /// Conditions (CSV) at which to give the corrected prediction as well
    #[arg(long, value_name = "CONDITIONS.csv")]
    predict: Option<PathBuf>,
    /// Format of the answer
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
    /// Seed of the random numbers
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Number of threads; all of them unless told
    #[arg(long, value_name = "N", value_parser = options::threads)]
    threads: Option<usize>,
    /// Write the answer to this file instead of standard output
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// No progress, notes or warnings on standard error
    #[arg(long)]
    quiet: bool,
}

/// The format of the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A page of text for people
    Table,
    /// The whole answer for programs
    Json,
}

impl Gap {
    pub(super) fn execute(&self) -> Result<Exit, Failure> {
        let file = file::read_case(&self.case)?;
        let at = match &self.predict {
            Some(path) => Some(file::read_case_at(&self.case, path)?),
            None => None,
        };
        let seed = self.seed.unwrap_or(file.case.task.settings.seed);
        let diagnosis = gap::diagnose(&file.case, at.as_deref(), gap::Options { seed }, &|_| {});
        let answer = match self.format {
            Format::Table => report::gap::json(&diagnosis),
            Format::Json => report::gap::json(&diagnosis),
        };
        output::write(&answer, self.output.as_deref())?;
        Ok(Exit::Done)
    }
}
