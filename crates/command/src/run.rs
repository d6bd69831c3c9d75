//! `gumption run`

use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

use clap::{Args, ValueEnum};

use super::evaluated::Evaluated;
use super::options::{
    self, CoverageOption, ModelArguments, Seed, StatementOption, Threads, TodaysReadings,
};
use super::parted_run::PartedRun;
use super::{CommandLine, Exit, Failure, parts, progress, signals};
use gumption_engine::propagate::{Control, Evaluation, EvaluationError, evaluate};
use gumption_engine::task::{MethodChoice, SettingsChanges, StoppingRule, Task, Trials};
use gumption_files::{ModelFile, SharedRun};
use gumption_report::Provenance;

/// Evaluate a model file by GUM and by Monte Carlo and print its budget and intervals.
#[derive(Debug, Args)]
pub(super) struct Run {
    #[command(flatten)]
    model: ModelArguments,
    #[command(flatten)]
    readings: TodaysReadings,
    #[command(flatten)]
    evaluated: Evaluated,
    #[command(flatten)]
    seed: Seed,
    /// Number of Monte Carlo trials; 0 for only the GUM evaluation, `adaptive` for as many as the
    /// digits need (JCGM 101, 7.9)
    #[arg(
        long, value_name = "N|adaptive", value_parser = options::trials,
        allow_negative_numbers = true
    )]
    trials: Option<Trials>,
    /// When an adaptive run stops: by JCGM 101, 7.9, or by Stein's two-stage rule, which meets the
    /// tolerance more often [default: that of the file, else 7.9]
    #[arg(long, value_name = "7.9|stein", value_parser = options::rule())]
    rule: Option<StoppingRule>,
    /// Results without the noise of trials in addition to those of the trials: exact ones for sums
    /// and products of independent contributions, or quasi-random ones; auto takes exact ones if
    /// available [default: none]
    #[arg(long, value_name = "METHOD", value_parser = options::method())]
    method: Option<MethodChoice>,
    /// Make as many trials as the validation of the GUM interval needs (JCGM 101, 8.2)
    #[arg(long, conflicts_with = "trials")]
    validate: bool,
    /// Largest number of trials of an adaptive run
    #[arg(
        long, value_name = "N", value_parser = options::max_trials,
        allow_negative_numbers = true
    )]
    max_trials: Option<u64>,
    #[command(flatten)]
    threads: Threads,
    /// Memory for kept trial values
    #[arg(
        long, value_name = "SIZE", default_value = "64M", value_parser = options::memory,
        allow_negative_numbers = true
    )]
    memory: usize,
    #[command(flatten)]
    coverage: CoverageOption,
    #[command(flatten)]
    statement: StatementOption,
    /// Number of significant digits of the standard uncertainty that are regarded as meaningful
    /// (clause 8)
    #[arg(
        long, value_name = "N", value_parser = options::digits,
        allow_negative_numbers = true
    )]
    digits: Option<u32>,
    /// Number of significant digits of uncertainties on pages, which decide nothing; those of
    /// --digits unless given
    #[arg(
        long, value_name = "N", value_parser = options::digits,
        allow_negative_numbers = true
    )]
    shown_digits: Option<u32>,
    /// Take the coverage factor at the real number of effective degrees of freedom
    #[arg(long, value_name = "real")]
    dof: Option<DofRule>,
    /// Make a part of the run, for `gumption merge`: the blocks A to B - 1 of 1024 trials each, or
    /// the K-th of N parts
    #[arg(
        long, value_name = "A..B|K/N", value_parser = parts::blocks, requires = "partial",
        conflicts_with_all = ["output", "save", "samples", "histogram", "columns", "fail"]
    )]
    blocks: Option<parts::Blocks>,
    /// Write that part to a file
    #[arg(long, value_name = "FILE", requires = "blocks")]
    partial: Option<PathBuf>,
    /// Make the part for a later pass: the file `next-pass` of `gumption merge`
    #[arg(long, value_name = "FILE", requires = "blocks")]
    pass: Option<PathBuf>,
    /// Make the run in parts that are kept in a folder; a stopped run continues from these parts
    #[arg(long, value_name = "DIR", conflicts_with_all = ["blocks", "samples"])]
    resume: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum DofRule {
    Real,
}

impl Run {
    pub(super) fn execute(&self, program: &CommandLine) -> Result<Exit, Failure> {
        let mut file = self.model.read_for(program, self.trials, &self.readings)?;
        self.settings(&mut file.task);
        let (file, task) = (&file, &file.task);
        if self.rule.is_some() && task.settings.trials != Trials::Adaptive {
            let reason = "`--rule` is for adaptive runs; add `--trials adaptive`";
            return Err(Failure::Argument(reason.to_owned()));
        }
        let stop = signals::stop_flag();
        let control = self.control(&stop);
        let shared = || {
            let (path, set) = (self.model.path(), &self.model.replacements);
            SharedRun::new(file, path, set, &task.settings, self.memory)
        };
        let quiet = self.evaluated.answer.quiet;
        if let (Some(blocks), Some(partial)) = (&self.blocks, &self.partial) {
            let read = self.paths(file);
            let asked =
                parts::AskedPart { blocks, partial, pass: self.pass.as_deref(), read, quiet };
            let run = shared();
            return parts::make(PartedRun::new(file, task, &run), asked, &control);
        }
        self.evaluated.check(task)?;
        let places = self.evaluated.open(&self.paths(file))?;
        let (evaluation, quantiles) = match &self.resume {
            Some(folder) => {
                let asked = (folder.as_path(), self.evaluated.saves());
                let run = shared();
                let run = PartedRun::new(file, task, &run);
                let found = parts::resume(run, asked, &control, quiet)?;
                let Some((evaluation, quantiles)) = found else { return Ok(Exit::Interrupted) };
                (*evaluation, quantiles)
            }
            None => (self.evaluate(file, task, &control)?, None),
        };
        let replaced: Vec<String> =
            self.model.replacements.iter().map(|set| set.text.clone()).collect();
        let found = (file, task, &evaluation, quantiles);
        self.evaluated.give(found, &replaced, places, (&control, &stop))
    }

    /// The paths of the files that the answer is computed from.
    fn paths(&self, file: &ModelFile) -> Vec<PathBuf> {
        let mut paths = self.model.paths(file);
        paths.extend(self.readings.file.clone());
        paths
    }

    /// The command line takes precedence over the file.
    fn settings(&self, task: &mut Task) {
        let settings = task.settings;
        let asked = SettingsChanges {
            coverage: Some(self.coverage.or(settings.coverage)),
            trials: self.trials,
            validate: self.validate,
            rule: self.rule,
            method: self.method,
            max_trials: self.max_trials,
            seed: Some(self.seed.or(settings.seed)),
            digits: self.digits,
            shown_digits: self.shown_digits,
            real_dof: self.dof.is_some(),
            statement: self.statement.requested(),
        };
        task.settings = asked.applied(settings);
    }

    fn control<'s>(&self, stop: &'s AtomicBool) -> Control<'s> {
        self.threads.control(stop).with_memory(self.memory)
    }

    fn evaluate(
        &self,
        file: &ModelFile,
        task: &Task,
        control: &Control<'_>,
    ) -> Result<Evaluation, Failure> {
        let rows = task.rows.len() as u64;
        let trials = match task.settings.trials {
            Trials::Fixed(trials) => Some(trials.saturating_mul(rows)),
            Trials::Adaptive => None,
        };
        let bar = progress::bar(trials, self.evaluated.answer.quiet);
        let advance = |trials: u64| bar.inc(trials);
        let result = evaluate(task, &control.with_progress(&advance));
        bar.finish_and_clear();
        result.map_err(|error| failure(file, error))
    }
}

/// A failed evaluation, as an error with its position if the user caused it.
pub(super) fn failure(file: &ModelFile, error: EvaluationError) -> Failure {
    Failure::Diagnostics(file.evaluation_failed(error.to_string()))
}

/// The digests of a file and of the tables that it reads.
pub(super) fn provenance(text: &str, files: &[(String, Vec<u8>)]) -> Provenance {
    Provenance::of(text, files)
}
