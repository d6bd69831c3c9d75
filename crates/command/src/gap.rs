//! `gumption gap`

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{Exit, Failure, options, output, progress, run};
use gumption_engine::task::Row;
use gumption_files as file;
use gumption_files::CaseFile;
use gumption_gap as gap;
use gumption_gap::Diagnosis;
use gumption_report as report;
use gumption_report::Provenance;

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
    /// Number of threads; all of the machine's unless given
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
    /// A page of text with plots, for people
    Table,
    /// A page with figures for a browser and for print, in one file
    Html,
    /// The whole answer for programs
    Json,
    /// One line for each hypothesis: prior, posterior probability, evidence
    Csv,
}

impl Gap {
    pub(super) fn execute(&self) -> Result<Exit, Failure> {
        let whole = progress::whole_on_interrupt();
        let file = file::read_case(&self.case)?;
        let at = match &self.predict {
            Some(path) => Some(file::read_case_at(&self.case, path)?),
            None => None,
        };
        if !self.quiet {
            run::say(&file.warnings);
        }
        let diagnosis = self.diagnose(&file, at.as_deref())?;
        let answer = match self.format {
            Format::Table => report::gap::table(&diagnosis),
            Format::Html => report::gap::html(&diagnosis, &self.provenance(&file)?),
            Format::Json => report::gap::json(&diagnosis),
            Format::Csv => report::gap::csv(&diagnosis),
        };
        // a page on standard output has the notes itself
        if !self.quiet && (self.format != Format::Table || self.output.is_some()) {
            say(&diagnosis);
        }
        match &self.output {
            Some(path) => {
                let _writing = whole.lock();
                output::write_file(&answer, path)?;
            }
            None => output::write(&answer, None)?,
        }
        Ok(Exit::Done)
    }

    /// The digests of all files that the answer rests on.
    fn provenance(&self, file: &CaseFile) -> Result<Provenance, Failure> {
        let mut files = file.files.clone();
        if let Some(path) = &self.predict {
            let name = path.display().to_string();
            let read = std::fs::read(path);
            let bytes = read.map_err(|e| Failure::System(format!("cannot read `{name}`: {e}")))?;
            files.push((name, bytes));
        }
        Ok(run::provenance(&file.source.text, &files))
    }

    fn diagnose(&self, file: &CaseFile, at: Option<&[Row]>) -> Result<Diagnosis, Failure> {
        let seed = self.seed.unwrap_or(file.case.task.settings.seed);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(self.threads.unwrap_or(0))
            .build()
            .map_err(|error| Failure::System(format!("cannot start threads: {error}")))?;
        let bar = progress::share(self.quiet);
        let told = |share: f64| progress::tell(&bar, share);
        let diagnosis =
            pool.install(|| gap::diagnose(&file.case, at, gap::DiagnosisOptions::new(seed), &told));
        bar.finish_and_clear();
        diagnosis.map_err(|error| Failure::System(error.to_string()))
    }
}

/// What to bear in mind, on standard error.
#[allow(clippy::print_stderr)]
fn say(diagnosis: &Diagnosis) {
    for note in &diagnosis.notes {
        anstream::eprintln!("note: {}", note.text);
    }
}
