//! `gumption assumptions`

use gumption_engine::fact;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::{Args, ValueEnum};

use super::exit::say;
use super::options::{AnswerOptions, CoverageOption, Interactive, ModelArguments, Seed, Threads};
use super::{CommandLine, Exit, Failure, options, progress, run, signals};
use gumption_assumptions::{Audit, Question, audit, trials_to_make};
use gumption_engine::task::{Task, Trials, Warning};
use gumption_files::ModelFile;
use gumption_report as report;

/// Test the Type B assumptions of a model file: which ones matter, which ones the readings
/// contradict.
#[derive(Debug, Args)]
pub(super) struct Assumptions {
    #[command(flatten)]
    model: ModelArguments,
    #[command(flatten)]
    answer: AnswerOptions<AssumptionsFormat>,
    #[command(flatten)]
    interactive: Interactive,
    /// Allowed relative change of the expanded uncertainty
    #[arg(
        long, value_name = "SHARE", default_value = "0.05", value_parser = allowed,
        allow_negative_numbers = true
    )]
    allow: f64,
    #[command(flatten)]
    seed: Seed,
    /// Number of Monte Carlo trials of each variant, at least 20000
    #[arg(long, value_name = "N", value_parser = trials, allow_negative_numbers = true)]
    trials: Option<u64>,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    coverage: CoverageOption,
}

/// The format of the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum AssumptionsFormat {
    /// A text page
    Table,
    /// A Markdown page, as GitHub shows it; with `--output` its figures are SVG files beside it
    Markdown,
    /// An HTML page with figures, in one file
    Html,
    /// The whole answer for programs
    Json,
    /// One line for each variant of the evaluation
    Csv,
}

/// Minimum number of trials with which changes can be detected.
const FEWEST: u64 = 20_000;

/// Maximum number of trials: some hundred megabytes of kept values for each variant.
const MOST: u64 = 1_000_000_000;

/// Number of trials if the file requests none, or an adaptive run.
const USUAL: u64 = 1_000_000;

fn allowed(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(share) if share > 0.0 && share <= 100.0 => Ok(share),
        _ => Err("a share above 0 is needed, such as 0.05 for 5 %".to_owned()),
    }
}

fn trials(text: &str) -> Result<u64, String> {
    match options::trials(text) {
        Ok(Trials::Fixed(count)) if (FEWEST..=MOST).contains(&count) => Ok(count),
        _ => Err(format!("a whole number from {FEWEST} to 1e9 is needed")),
    }
}

impl Assumptions {
    pub(super) fn execute(&self, program: &CommandLine) -> Result<Exit, Failure> {
        let page = self.interactive.of(&self.answer)?;
        let file = self.model.read(program)?;
        let mut task = file.task.clone();
        task.settings.seed = self.seed.or(task.settings.seed);
        task.settings.coverage = self.coverage.or(task.settings.coverage);
        let mut warnings = file.warnings.clone();
        let question = Question { trials: self.trials(&task, &mut warnings), allowed: self.allow };
        let place = self.answer.open(&self.model.paths(&file))?;
        let stop = signals::stop_flag();
        let Some(found) = self.audit(&file, &task, question, &stop)? else {
            say("gumption: interrupted; an incomplete audit gives no answer\n");
            return Ok(Exit::Interrupted);
        };
        warnings.extend(found.warnings.iter().cloned());
        let provenance = run::provenance(&file.source.text, &file.files);
        let report = report::assumptions::AuditReport {
            task: &task,
            audit: &found,
            warnings: &warnings,
            provenance: &provenance,
        };
        let answer = || match self.answer.format {
            AssumptionsFormat::Table => report::assumptions::table(&report),
            AssumptionsFormat::Markdown => report::assumptions::markdown(&report),
            AssumptionsFormat::Html => page(report::assumptions::html(&report)),
            AssumptionsFormat::Json => report::assumptions::json(&report),
            AssumptionsFormat::Csv => report::assumptions::csv(&report),
        };
        self.answer.say(&warnings);
        self.answer.write_page(place, answer)?;
        Ok(Exit::Done)
    }

    /// The command line takes precedence over the file.
    fn trials(&self, task: &Task, warnings: &mut Vec<Warning>) -> u64 {
        match (self.trials, task.settings.trials) {
            (Some(trials), _) => trials,
            (None, Trials::Adaptive | Trials::Fixed(0)) => USUAL,
            (None, Trials::Fixed(trials)) if trials < FEWEST => {
                warnings.push(Warning::new("", fact!("few-trials.audit", trials, made = FEWEST)));
                FEWEST
            }
            (None, Trials::Fixed(trials)) => trials.min(MOST),
        }
    }

    fn audit(
        &self,
        file: &ModelFile,
        task: &Task,
        question: Question,
        stop: &AtomicBool,
    ) -> Result<Option<Audit>, Failure> {
        let bar = progress::bar(Some(trials_to_make(task, question)), self.answer.quiet);
        let advance = |trials: u64| bar.inc(trials);
        let control = self.threads.control(stop).with_progress(&advance);
        let result = audit(task, &file.evidence, question, &control);
        bar.finish_and_clear();
        let found = result.map_err(|error| run::failure(file, error))?;
        Ok(found.filter(|_| !stop.load(Ordering::Relaxed)))
    }
}
