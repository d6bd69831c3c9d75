//! Options and output of an evaluation: formats, result file, trials, figures, and `--fail`.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;

use super::exit::say;
use super::options::{self, AnswerOptions, Interactive, Page};
use super::output::{AnswerPlace, Destination};
use super::{Exit, Failure, output, save};
use gumption_engine::propagate::monte_carlo::{Histogram, MonteCarlo};
use gumption_engine::propagate::{
    Control, Evaluation, convergence, first_trials, histograms, warnings,
};
use gumption_engine::task::{Task, Trials};
use gumption_files::ModelFile;
use gumption_report as report;
use gumption_report::words;
use gumption_report::{BudgetColumn, EvaluationReport, Extent, Shown};

/// How to give the answer of an evaluation, and what to write besides it.
#[derive(Debug, Args)]
pub(super) struct Evaluated {
    #[command(flatten)]
    pub(super) answer: AnswerOptions<Page>,
    #[command(flatten)]
    interactive: Interactive,
    /// More columns of the budget in a table: names separated by commas
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = options::columns())]
    columns: Vec<BudgetColumn>,
    /// Print only the result of each output, on one line
    #[arg(long, conflicts_with_all = ["full", "columns", "histogram"])]
    brief: bool,
    /// Print all budgets, both methods side by side, distributions, the model and the settings
    #[arg(long)]
    full: bool,
    /// Draw the distribution of each output below the table, with the coverage intervals
    #[arg(long)]
    histogram: bool,
    /// Write a result file, which inputs of other models can use
    #[arg(long, value_name = "FILE")]
    save: Option<PathBuf>,
    /// Write the trials to a .csv or .npy file
    #[arg(long, value_name = "FILE", value_parser = save::samples)]
    samples: Option<save::SampleFile>,
    /// Exit with code 3 if clause 8 does not validate a GUM interval, an output does not conform,
    /// or either is undecided
    #[arg(long)]
    fail: bool,
}

/// The model, the task, and its evaluation.
type Answered<'a> = (&'a ModelFile, &'a Task, &'a Evaluation, Option<Vec<Vec<f64>>>);

/// Maximum number of rows of conditions whose distributions are drawn in a terminal.
const MOST_DRAWN_ROWS: usize = 100;

/// The output files, opened before the evaluation.
#[derive(Debug)]
pub(super) struct Places {
    answer: Option<Destination>,
    saved: Option<Destination>,
    samples: Option<Destination>,
}

impl Evaluated {
    /// Checks that the answer of a task can be given as requested.
    pub(super) fn check(&self, task: &Task) -> Result<(), Failure> {
        save::check(task, self.save.as_deref(), self.samples.as_ref())?;
        self.check_format(task)?;
        let decides = task.model.outputs.iter().any(|output| output.tolerance.is_some());
        if self.fail && task.settings.trials == Trials::Fixed(0) && !decides {
            let reason = "`--fail` needs Monte Carlo trials or a tolerance, but the number of \
                          trials is 0, and no output has a tolerance";
            return Err(Failure::Argument(reason.to_owned()));
        }
        Ok(())
    }

    /// How much a text page shows.
    fn extent(&self) -> Extent {
        match (self.brief, self.full) {
            (true, _) => Extent::Brief,
            (_, true) => Extent::Full,
            _ => Extent::Usual,
        }
    }

    /// Whether a result file is to be written.
    pub(super) fn saves(&self) -> bool {
        self.save.is_some()
    }

    /// Opens the files; `read` are the files from which the answer is computed.
    pub(super) fn open(&self, read: &[PathBuf]) -> Result<Places, Failure> {
        let asked = [
            ("--output", output::to_file(self.answer.output.as_deref())),
            ("--save", self.save.as_deref()),
            ("--samples", self.samples.as_ref().map(save::SampleFile::path)),
        ];
        let [answer, saved, samples] = output::open(asked, read)?;
        let written = [&saved, &samples].into_iter().flatten().map(|file| file.path().to_owned());
        self.answer.check_figures(&read.iter().cloned().chain(written).collect::<Vec<_>>())?;
        Ok(Places { answer, saved, samples })
    }

    /// Gives the answer. The quantiles for a result file are passed if they are already known.
    /// `replaced` are the values that replaced those of the file, as given.
    pub(super) fn give(
        &self,
        (file, task, evaluation, quantiles): Answered<'_>,
        replaced: &[String],
        places: Places,
        (control, stop): (&Control<'_>, &AtomicBool),
    ) -> Result<Exit, Failure> {
        let text = &file.source.text;
        let mut notes = file.warnings.clone();
        notes.extend(warnings(task, evaluation));
        let provenance = super::run::provenance(text, &file.files);
        let report =
            EvaluationReport { task, evaluation, warnings: &notes, provenance: &provenance };
        self.answer.say(&notes);
        let histograms = self.histograms(&report, control)?;
        let convergence = self.convergence(&report, control)?;
        let trials = self.first_trials(&report, control)?;
        let shown = Shown {
            trials: &trials,
            columns: &self.columns,
            histograms: &histograms,
            convergence: &convergence,
            replaced,
            extent: self.extent(),
            language: words::Language::English,
            model: text,
        };
        // a failure is reported after everything that can be written
        let saver = save::Saver { report: &report, control, quantiles: quantiles.as_deref() };
        let Places { answer, saved, samples } = places;
        let left = [
            saved.map(|file| (file.path().to_owned(), saver.result(file))),
            samples
                .zip(self.samples.as_ref())
                .map(|(file, asked)| (file.path().to_owned(), saver.samples(asked, file))),
        ];
        let format = self.answer.format;
        let page =
            if format == Page::Table { AnswerPlace::Page } else { AnswerPlace::StandardOutput };
        let place = answer.map_or(page, AnswerPlace::File);
        let page = self.interactive.of(&self.answer)?;
        let written = match format {
            Page::Table => place.write(&report::table(&report, &shown)),
            Page::Html => place.write(&page(report::html(&report, &shown))),
            Page::Markdown => self.answer.write_page(place, || report::markdown(&report, &shown)),
            Page::Latex => self.answer.write_page(place, || report::latex(&report, &shown)),
            Page::Json => place.write_with(|out| report::write_json(&report, out)),
            Page::Csv => place.write_with(|out| report::write_csv(&report, out)),
            Page::Xlsx => place.write_with(|out| out.write_all(&report::xlsx(&report, &shown)?)),
        };
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
        if self.fail { self.judged(task, evaluation) } else { Ok(Exit::Done) }
    }

    /// The exit code with `--fail`: "no" if clause 8 or the conformity of an output fails or is
    /// undecided.
    fn judged(&self, task: &Task, evaluation: &Evaluation) -> Result<Exit, Failure> {
        let judgements = judgements(task, evaluation);
        if judgements.iter().all(|judgement| judgement.verdict.is_none()) {
            let reason =
                "`--fail` has nothing to check: no output has a GUM interval or tolerance limits";
            return Err(Failure::Argument(reason.to_owned()));
        }
        let against: Vec<&Judgement> =
            judgements.iter().filter(|of| of.verdict != Some(Verdict::Yes)).collect();
        for judgement in against.iter().take(MOST_JUDGEMENTS) {
            self.answer.note([judgement.text().as_str()]);
        }
        Ok(if against.is_empty() { Exit::Done } else { Exit::No })
    }

    /// Checks that the answer can be given in the requested format.
    fn check_format(&self, task: &Task) -> Result<(), Failure> {
        self.interactive.of(&self.answer)?;
        let refuse = |reason: &str| Err(Failure::Argument(reason.to_owned()));
        let format = self.answer.format;
        if format == Page::Xlsx && self.answer.is_terminal() {
            return Err(options::workbook_in_terminal());
        }
        let results = task.rows.len().saturating_mul(task.model.outputs.len());
        if format == Page::Xlsx && results > report::MOST_RESULTS {
            return Err(Failure::Argument(format!(
                "there are {results} results, but a workbook takes at most {}; use `--format \
                 csv`, or evaluate fewer rows of conditions",
                report::MOST_RESULTS
            )));
        }
        if !self.columns.is_empty() && matches!(format, Page::Json | Page::Csv | Page::Xlsx) {
            return refuse(
                "`--columns` is for budgets on pages (`table`, `markdown`, `latex`, `html`); the \
                 workbook and JSON have all columns, CSV has no budget",
            );
        }
        if self.extent() != Extent::Usual && format != Page::Table {
            return refuse(
                "`--brief` and `--full` are for the text page (`--format table`); the other \
                 formats have everything",
            );
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

    /// For each row the histograms of its outputs, if the answer shows them.
    fn histograms(
        &self,
        report: &EvaluationReport<'_>,
        control: &Control<'_>,
    ) -> Result<Vec<Vec<Option<Histogram>>>, Failure> {
        let EvaluationReport { task, evaluation, .. } = *report;
        let rows = match self.answer.format {
            Page::Xlsx if evaluation.rows.len() == 1 => 1,
            _ if self.has_figures(evaluation) => 1,
            Page::Table if self.histogram => evaluation.rows.len(),
            Page::Table if self.full && evaluation.rows.len() == 1 => 1,
            _ => 0,
        };
        let mut all = Vec::with_capacity(rows);
        for row in 0..rows {
            all.push(histograms(task, evaluation, row, control)?.unwrap_or_default());
        }
        Ok(all)
    }

    /// The first trials of several outputs, if the answer shows them.
    fn first_trials(
        &self,
        report: &EvaluationReport<'_>,
        control: &Control<'_>,
    ) -> Result<Vec<Vec<f64>>, Failure> {
        let EvaluationReport { task, evaluation, .. } = *report;
        if !self.has_figures(evaluation) {
            return Ok(Vec::new());
        }
        let most = report::trials_of_pairs(report);
        Ok(first_trials(task, evaluation, 0, most, control)?.unwrap_or_default())
    }

    /// Whether the page of a single row of conditions has figures.
    fn has_figures(&self, evaluation: &Evaluation) -> bool {
        evaluation.rows.len() == 1
            && (self.answer.format == Page::Html || self.answer.has_figures_beside())
    }

    /// The convergence of the results, if the answer shows it.
    fn convergence(
        &self,
        report: &EvaluationReport<'_>,
        control: &Control<'_>,
    ) -> Result<Vec<Vec<MonteCarlo>>, Failure> {
        let EvaluationReport { task, evaluation, .. } = *report;
        if !self.has_figures(evaluation) {
            return Ok(Vec::new());
        }
        Ok(convergence(task, evaluation, 0, control)?.unwrap_or_default())
    }
}

/// The result of `--fail` for an output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    Yes,
    No,
    Undecided,
}

/// The result for an output in a row; `None` if it could not be determined.
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

/// Maximum number of judgements that are listed.
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
            // without trials it is not determined
            if task.settings.trials != Trials::Fixed(0) {
                all.push(judgement("is the GUM interval validated (clause 8)", valid));
            }
            if output.tolerance.is_some() {
                all.push(judgement("does it conform", conforms));
            }
        }
    }
    all
}
