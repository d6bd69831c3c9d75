//! `gumption run`

use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::{Args, ValueEnum};

use super::exit::say;
use super::options::{self, Answer, CoverageOption, Model, Page, Seed, Threads};
use super::output::Place;
use super::{CommandLine, Exit, Failure, output, progress, save, signals};
use gumption_engine::propagate::monte_carlo::Histogram;
use gumption_engine::propagate::{
    Control, Evaluation, EvaluationError, evaluate, histograms, warnings,
};
use gumption_engine::task::{MethodChoice, StoppingRule, Task, Trials, Warning};
use gumption_files::ModelFile;
use gumption_report as report;
use gumption_report::{BudgetColumn, EvaluationReport, Provenance, Shown, TableStyle};

/// Evaluate a model file.
#[derive(Debug, Args)]
pub(super) struct Run {
    #[command(flatten)]
    model: Model,
    #[command(flatten)]
    answer: Answer<Page>,
    #[command(flatten)]
    seed: Seed,
    /// Number of Monte Carlo trials; 0 for the GUM evaluation alone, `adaptive` for as many as the
    /// digits need (JCGM 101, 7.9)
    #[arg(long, value_name = "N|adaptive", value_parser = options::trials)]
    trials: Option<Trials>,
    /// When an adaptive run stops: by JCGM 101, 7.9, or by Stein's two-stage rule, which meets the
    /// tolerance more often; 7.9 unless the file says otherwise
    #[arg(long, value_name = "7.9|stein", value_parser = options::rule())]
    rule: Option<StoppingRule>,
    /// Figures without the noise of trials beside those of the trials: exact ones of sums and products
    /// of independent contributions, or those of quasi-random points; auto takes exact ones where
    /// there are any; none unless asked for
    #[arg(long, value_name = "METHOD", value_parser = options::method())]
    method: Option<MethodChoice>,
    /// Make as many trials as the validation of the GUM interval needs (JCGM 101, 8.2)
    #[arg(long, conflicts_with = "trials")]
    validate: bool,
    /// Largest number of trials of an adaptive run
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(20_000..))]
    max_trials: Option<u64>,
    #[command(flatten)]
    threads: Threads,
    /// Memory for kept trial values
    #[arg(long, value_name = "SIZE", default_value = "64M", value_parser = options::memory)]
    memory: usize,
    #[command(flatten)]
    coverage: CoverageOption,
    /// Significant digits of the standard uncertainty that are held meaningful (clause 8)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=15))]
    digits: Option<u32>,
    /// Take the coverage factor at the real number of effective degrees of freedom
    #[arg(long, value_name = "real")]
    dof: Option<DofRule>,
    /// More columns of the budget in a table: names with commas between them
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = options::columns())]
    columns: Vec<BudgetColumn>,
    /// Draw the distribution of each output below the table, with the coverage intervals
    #[arg(long)]
    histogram: bool,
    /// Write a result file, from which inputs of other models can be taken
    #[arg(long, value_name = "FILE")]
    save: Option<PathBuf>,
    /// Write the trials: a .csv or a .npy file
    #[arg(long, value_name = "FILE", value_parser = save::samples)]
    samples: Option<save::SampleFile>,
    /// End with exit code 3 if clause 8 finds a GUM interval not valid, an output does not conform, or
    /// that is undecided
    #[arg(long)]
    fail: bool,
}

/// Rows of conditions whose distributions are drawn in a terminal, at most.
const MOST_DRAWN_ROWS: usize = 100;

#[derive(Clone, Copy, Debug, ValueEnum)]
enum DofRule {
    Real,
}

impl Run {
    pub(super) fn execute(&self, program: &CommandLine) -> Result<Exit, Failure> {
        let file = self.model.read(program)?;
        let text = &file.source.text;
        let mut task = file.task.clone();
        self.settings(&mut task);
        if self.rule.is_some() && task.settings.trials != Trials::Adaptive {
            let reason = "`--rule` is about adaptive runs; add `--trials adaptive`";
            return Err(Failure::Argument(reason.to_owned()));
        }
        save::check(&task, self.save.as_deref(), self.samples.as_ref())?;
        self.check_format(&task)?;
        if self.fail && task.settings.trials == Trials::Fixed(0) {
            let reason = "`--fail` has nothing to judge by without trials, but their number is 0";
            return Err(Failure::Argument(reason.to_owned()));
        }
        let asked = [
            ("--output", self.answer.output.as_deref()),
            ("--save", self.save.as_deref()),
            ("--samples", self.samples.as_ref().map(save::SampleFile::path)),
        ];
        let [answer, saved, samples] = output::open(asked, &self.model.paths(&file))?;
        let stop = signals::stop_flag();
        let (evaluation, warnings) = self.evaluate(&file, &task, &stop)?;
        let provenance = provenance(text, &file.files);
        let report = EvaluationReport {
            task: &task,
            evaluation: &evaluation,
            warnings: &warnings,
            provenance: &provenance,
        };
        self.answer.say(&warnings);
        let control = self.control(&stop);
        let histograms = self.histograms(&report, &control)?;
        let replaced: Vec<String> =
            self.model.replacements.iter().map(|set| set.text.clone()).collect();
        let shown = Shown {
            columns: &self.columns,
            histograms: &histograms,
            replaced: &replaced,
            model: text,
        };
        // what fails is told when all that can be written is
        let saver = save::Saver { report: &report, control: &control };
        let left = [
            saved.map(|file| (file.path().to_owned(), saver.result(file))),
            samples
                .zip(self.samples.as_ref())
                .map(|(file, asked)| (file.path().to_owned(), saver.samples(asked, file))),
        ];
        let place = answer.map_or(Place::StandardOutput, Place::File);
        let format = self.answer.format;
        let written = place.write_with(|out| write(format, &report, &shown, out));
        let mut failures: Vec<Failure> = written.err().into_iter().collect();
        for (path, left) in left.into_iter().flatten() {
            match left {
                Ok(true) => {}
                Ok(false) => {
                    let name = report::plain(&path.display().to_string());
                    say(&format!("gumption: interrupted, `{name}` is not written\n"));
                }
                Err(failure) => failures.push(failure),
            }
        }
        let mut failures = failures.into_iter();
        if let Some(first) = failures.next() {
            failures.for_each(|failure| say(&failure.to_string()));
            return Err(first);
        }
        if evaluation.stopped || stop.load(Ordering::Relaxed) {
            return Ok(Exit::Interrupted);
        }
        if self.fail { self.judged(&task, &evaluation) } else { Ok(Exit::Done) }
    }

    /// How a run with `--fail` ends: with "no" where clause 8 or the conformity of an output is
    /// against it, or undecided.
    fn judged(&self, task: &Task, evaluation: &Evaluation) -> Result<Exit, Failure> {
        let judgements = judgements(task, evaluation);
        if judgements.iter().all(|judgement| judgement.verdict.is_none()) {
            let reason = "`--fail` has nothing to judge: no output has a GUM interval to compare \
                          with, or tolerance limits";
            return Err(Failure::Argument(reason.to_owned()));
        }
        let against: Vec<&Judgement> =
            judgements.iter().filter(|of| of.verdict != Some(Verdict::Yes)).collect();
        for judgement in against.iter().take(MOST_JUDGEMENTS) {
            self.answer.note([judgement.text().as_str()]);
        }
        Ok(if against.is_empty() { Exit::Done } else { Exit::No })
    }

    /// Whether the answer can be given in the format that was asked for.
    fn check_format(&self, task: &Task) -> Result<(), Failure> {
        let refuse = |reason: &str| Err(Failure::Argument(reason.to_owned()));
        let format = self.answer.format;
        if format == Page::Xlsx && self.answer.is_terminal() {
            return Err(options::workbook_in_terminal());
        }
        let results = task.rows.len().saturating_mul(task.model.outputs.len());
        if format == Page::Xlsx && results > report::MOST_RESULTS {
            return Err(Failure::Argument(format!(
                "there are {results} results, but a workbook takes at most {}; take \
                 `--format csv`, or evaluate fewer rows of conditions",
                report::MOST_RESULTS
            )));
        }
        if !self.histogram {
            return Ok(());
        }
        if format != Page::Table {
            return refuse(
                "`--histogram` goes with `--format table`; `--format html` shows the distribution \
                 without it",
            );
        }
        if task.settings.trials == Trials::Fixed(0) {
            return refuse("`--histogram` needs Monte Carlo trials, but their number is 0");
        }
        if task.rows.len() > MOST_DRAWN_ROWS {
            return Err(Failure::Argument(format!(
                "`--histogram` draws at most {MOST_DRAWN_ROWS} rows of conditions, but there are \
                 {}; evaluate fewer of them",
                task.rows.len()
            )));
        }
        Ok(())
    }

    /// For each row the histograms of its outputs, where the answer shows them.
    fn histograms(
        &self,
        report: &EvaluationReport<'_>,
        control: &Control<'_>,
    ) -> Result<Vec<Vec<Option<Histogram>>>, Failure> {
        let EvaluationReport { task, evaluation, .. } = *report;
        let rows = match self.answer.format {
            Page::Html if evaluation.rows.len() == 1 => 1,
            Page::Table if self.histogram => evaluation.rows.len(),
            _ => 0,
        };
        let mut all = Vec::with_capacity(rows);
        for row in 0..rows {
            all.push(histograms(task, evaluation, row, control)?.unwrap_or_default());
        }
        Ok(all)
    }

    /// The command line beats the file.
    fn settings(&self, task: &mut Task) {
        let settings = &mut task.settings;
        settings.coverage = self.coverage.or(settings.coverage);
        if let Some(trials) = self.trials {
            settings.trials = trials;
            settings.decide_up_to = 0;
        }
        if self.validate {
            settings.trials = Trials::Adaptive;
            settings.for_validation = true;
        }
        settings.rule = self.rule.unwrap_or(settings.rule);
        settings.method = self.method.or(settings.method);
        settings.max_trials = self.max_trials.unwrap_or(settings.max_trials);
        settings.seed = self.seed.or(settings.seed);
        if let Some(digits) = self.digits {
            *settings = settings.with_digits(digits);
        }
        settings.real_dof |= self.dof.is_some();
    }

    fn control<'s>(&self, stop: &'s AtomicBool) -> Control<'s> {
        self.threads.control(stop).with_memory(self.memory)
    }

    fn evaluate(
        &self,
        file: &ModelFile,
        task: &Task,
        stop: &AtomicBool,
    ) -> Result<(Evaluation, Vec<Warning>), Failure> {
        let rows = task.rows.len() as u64;
        let trials = match task.settings.trials {
            Trials::Fixed(trials) => Some(trials.saturating_mul(rows)),
            Trials::Adaptive => None,
        };
        let bar = progress::bar(trials, self.answer.quiet);
        let advance = |trials: u64| bar.inc(trials);
        let control = self.control(stop).with_progress(&advance);
        let result = evaluate(task, &control);
        bar.finish_and_clear();
        let evaluation = result.map_err(|error| failure(file, error))?;
        let mut notes = file.warnings.clone();
        notes.extend(warnings(task, &evaluation));
        Ok((evaluation, notes))
    }
}

/// Writes the answer in a format.
fn write(
    format: Page,
    report: &EvaluationReport<'_>,
    shown: &Shown<'_>,
    out: &mut dyn Write,
) -> io::Result<()> {
    match format {
        Page::Table => {
            let style = TableStyle { columns: shown.columns.to_vec(), ..TableStyle::default() };
            report::write_table(report, &style, &mut *out)?;
            out.write_all(report::histograms(report, shown).as_bytes())
        }
        Page::Json => report::write_json(report, out),
        Page::Csv => report::write_csv(report, out),
        Page::Markdown => out.write_all(report::markdown(report, shown).as_bytes()),
        Page::Latex => out.write_all(report::latex(report, shown).as_bytes()),
        Page::Html => out.write_all(report::html(report, shown).as_bytes()),
        Page::Xlsx => out.write_all(&report::xlsx(report, shown)?),
    }
}

/// An evaluation that failed, as a mistake with its place where it is the user's.
pub(super) fn failure(file: &ModelFile, error: EvaluationError) -> Failure {
    let message = error.to_string();
    match error {
        EvaluationError::Threads(_) => Failure::System(message),
        // everything else follows from what the file says
        _ => Failure::Diagnostics(file.evaluation_failed(message)),
    }
}

/// The digests of a file and of the tables that it reads.
pub(super) fn provenance(text: &str, files: &[(String, Vec<u8>)]) -> Provenance {
    Provenance::of(text, files)
}

/// What `--fail` asks of an output, and the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    Yes,
    No,
    Undecided,
}

/// The answer for an output in a row; `None` where it could not be asked.
struct Judgement {
    output: String,
    row: Option<usize>,
    asked: &'static str,
    verdict: Option<Verdict>,
}

impl Judgement {
    fn text(&self) -> String {
        let row = self.row.map_or(String::new(), |row| format!("row {}, ", row + 1));
        let verdict = match self.verdict {
            Some(Verdict::Yes) => "yes",
            Some(Verdict::No) => "no",
            Some(Verdict::Undecided) => "undecided",
            None => "it could not be checked",
        };
        format!("--fail: {row}`{}`: {}: {verdict}", self.output, self.asked)
    }
}

/// Judgements that are told, at most.
const MOST_JUDGEMENTS: usize = 20;

fn judgements(task: &Task, evaluation: &Evaluation) -> Vec<Judgement> {
    let mut all = Vec::new();
    for (number, row) in evaluation.rows.iter().enumerate() {
        for (output, found) in task.model.outputs.iter().zip(&row.outputs) {
            let judgement = |asked, verdict| Judgement {
                output: output.quantity.name.clone(),
                row: (evaluation.rows.len() > 1).then_some(number),
                asked,
                verdict,
            };
            let valid = found.validation.map(|validation| match validation.gum_valid {
                Some(true) => Verdict::Yes,
                Some(false) => Verdict::No,
                None => Verdict::Undecided,
            });
            let conforms = found
                .conformity
                .as_ref()
                .map(|conformity| if conformity.conforms { Verdict::Yes } else { Verdict::No });
            all.push(judgement("is the GUM interval valid (clause 8)", valid));
            if output.tolerance.is_some() {
                all.push(judgement("does it conform", conforms));
            }
        }
    }
    all
}
