//! `gumption gap`

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use clap::{Args, ValueEnum};

use super::options::{AnswerOptions, Case, CoverageOption, Interactive, Seed, Threads};
use super::simulator::{SimulatedCase, SimulatorOptions};
use super::{CommandLine, Exit, Failure, output, progress, run, signals};
use gumption_engine::task::Row;
use gumption_files::CaseFile;
use gumption_gap as gap;
use gumption_gap::Diagnosis;
use gumption_gap::simulated::SimulatorDiagnosis;
use gumption_report as report;
use gumption_report::Provenance;
use gumption_text::bytes;

/// Diagnose where measured data depart from a model, and which effect is missing.
#[derive(Debug, Args)]
pub(super) struct Gap {
    #[command(flatten)]
    case: Case,
    /// Table of conditions (CSV) at which to compute the corrected prediction as well
    #[arg(long, value_name = "CONDITIONS.csv")]
    predict: Option<PathBuf>,
    #[command(flatten)]
    simulator: SimulatorOptions,
    #[command(flatten)]
    answer: AnswerOptions<GapFormat>,
    #[command(flatten)]
    interactive: Interactive,
    #[command(flatten)]
    seed: Seed,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    coverage: CoverageOption,
}

/// The format of the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum GapFormat {
    /// A text page with plots
    Table,
    /// An HTML page with figures, in one file
    Html,
    /// A Markdown page, for GitHub and editors; with `--output` its figures are SVG files beside it
    Markdown,
    /// The whole answer for programs
    Json,
    /// One line for each hypothesis: prior, posterior probability, evidence
    Csv,
}

impl Gap {
    pub(super) fn execute(&self, program: &CommandLine) -> Result<Exit, Failure> {
        let page = self.interactive.of(&self.answer)?;
        let mut file = self.case.read(program)?;
        let settings = &mut file.case.task.settings;
        settings.coverage = self.coverage.or(settings.coverage);
        let at = self.predict.as_ref().map(|path| self.case.at(program, path)).transpose()?;
        let mut read = self.case.paths(&file);
        read.extend(self.predict.clone());
        let [design] = output::open([("--design", self.simulator.design())], &read)?;
        if self.simulator.is_design_alone() {
            let seed = self.seed.or(file.case.task.settings.seed);
            let written = design.map(|to| self.simulator.write_design(&file.case, seed, to));
            return written.unwrap_or(Ok(())).map(|()| Exit::Done);
        }
        let place = self.answer.open(&read)?;
        // from the first output on, an interrupt gives the results so far
        let stop = signals::stop_flag();
        self.answer.say(&file.warnings);
        let simulated = self.simulator.simulated(&file.case, &self.threads, &stop)?;
        let diagnosis = match simulated {
            None => self.diagnose(&file, at.as_deref(), &stop)?,
            Some((mut simulated, notes)) => {
                self.answer.note(notes);
                let found = self.diagnose_simulated(&file, &mut simulated)?;
                if let Some((found, to)) = found.as_ref().zip(design) {
                    let first = simulated.runs().runs().made().len() + 1;
                    self.simulator.write_runs(&file.case, &found.more, first, to)?;
                }
                let found = match (found, at) {
                    (Some(found), Some(at)) if !found.diagnosis.interrupted => {
                        self.predict_simulated(&file, &found, at, &stop)?
                    }
                    (found, _) => found.map(|found| found.diagnosis),
                };
                let Some(diagnosis) = found else {
                    self.answer.note([simulated.interrupted()]);
                    return Ok(Exit::Interrupted);
                };
                diagnosis
            }
        };
        let provenance = self.provenance(&file)?;
        let answer = || match self.answer.format {
            GapFormat::Table => report::gap::table(&diagnosis, &provenance),
            GapFormat::Html => page(report::gap::html(&diagnosis, &provenance)),
            GapFormat::Markdown => report::gap::markdown(&diagnosis, &provenance),
            GapFormat::Json => report::gap::json(&diagnosis),
            GapFormat::Csv => report::gap::csv(&diagnosis),
        };
        // a page on standard output contains the notes itself
        if self.answer.format != GapFormat::Table || self.answer.is_to_file() {
            self.answer.note(diagnosis.notes.iter().map(report::gap::note));
        }
        self.answer.write_page(place, answer)?;
        Ok(if diagnosis.interrupted { Exit::Interrupted } else { Exit::Done })
    }

    /// The digests of all files on which the answer depends.
    fn provenance(&self, file: &CaseFile) -> Result<Provenance, Failure> {
        let mut files = file.files.clone();
        if let Some(path) = &self.predict {
            let name = path.display().to_string();
            let bytes = bytes::of_file(path, bytes::MOST)
                .map_err(|reason| Failure::System(format!("`{name}`: {reason}")))?;
            files.push((name, bytes));
        }
        Ok(run::provenance(&file.source.text, &files))
    }

    fn diagnose_simulated(
        &self,
        file: &CaseFile,
        simulated: &mut SimulatedCase,
    ) -> Result<Option<SimulatorDiagnosis>, Failure> {
        let options = self.options(file);
        self.under_progress(|told| simulated.diagnose(&file.case, options, told))
    }

    fn predict_simulated(
        &self,
        file: &CaseFile,
        found: &SimulatorDiagnosis,
        at: Vec<Row>,
        stop: &Arc<AtomicBool>,
    ) -> Result<Option<Diagnosis>, Failure> {
        let elsewhere = self.simulator.elsewhere(&file.case, &at, &self.threads, stop)?;
        match elsewhere {
            Some(mut elsewhere) => self.threads.install(|| elsewhere.predict(found, at)),
            None => Ok(Some(found.diagnosis.clone())),
        }
    }

    fn diagnose(
        &self,
        file: &CaseFile,
        at: Option<&[Row]>,
        stop: &AtomicBool,
    ) -> Result<Diagnosis, Failure> {
        let options = self.options(file);
        let diagnosis =
            self.under_progress(|told| gap::diagnose_until(&file.case, at, options, told, stop));
        diagnosis.map_err(|error| Failure::System(error.to_string()))
    }

    fn options(&self, file: &CaseFile) -> gap::DiagnosisOptions {
        gap::DiagnosisOptions::new(self.seed.or(file.case.task.settings.seed))
    }

    /// Does some work on the threads that were asked for, which tells the share that is done.
    fn under_progress<T: Send>(&self, work: impl FnOnce(&(dyn Fn(f64) + Sync)) -> T + Send) -> T {
        let bar = progress::share(self.answer.quiet);
        let told = |share: f64| progress::tell(&bar, share);
        let done = self.threads.install(|| work(&told));
        bar.finish_and_clear();
        done
    }
}
