//! Options that several commands share.

use gumption_report::words::{self, Language};
use std::borrow::Cow;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Once};

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};

use super::exit::say_line;
use super::output::AnswerPlace;
use super::surroundings::{GivenFile, in_call};
use super::{CommandLine, Failure, output};
use gumption_engine::number::of_percent;
use gumption_engine::parallel::{self, Pool};
use gumption_engine::propagate::Control;
use gumption_engine::task::{
    Coverage, MethodChoice, Row, StatementMethod, StoppingRule, Trials, Warning,
};
use gumption_files::{CaseFile, FileReader, ModelFile, Override, ReadingsFile};
use gumption_report::{BudgetColumn, plain};
use gumption_text::bytes;

/// The format of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    /// A text page
    Table,
    /// The whole answer for programs
    Json,
    /// One line for each output
    Csv,
}

/// The format of an answer that is available in many formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Page {
    /// A text page
    Table,
    /// The whole answer for programs
    Json,
    /// One line for each output
    Csv,
    /// A Markdown page, as GitHub shows it; with `--output` its figures are SVG files beside it
    Markdown,
    /// A LaTeX file for `article` with `booktabs` and `siunitx`; with `--output` its figures are PDF files
    /// beside it
    Latex,
    /// An HTML page with figures, in one file
    Html,
    /// A workbook with the budget as live formulas
    Xlsx,
}

/// The options for giving an answer in one of the formats of a command.
#[derive(Clone, Debug, Args)]
pub(super) struct AnswerOptions<F: ValueEnum + Send + Sync + 'static> {
    /// Format of the answer
    #[arg(long, value_enum, default_value = "table")]
    pub(super) format: F,
    /// Write to FILE instead of standard output (- for standard output)
    #[arg(long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// Print no progress, notes or warnings on standard error
    #[arg(long)]
    pub(super) quiet: bool,
}

impl<F: ValueEnum + Send + Sync + 'static> AnswerOptions<F> {
    /// Opens the destination of the answer; `read` are the files from which it is computed.
    pub(super) fn open(&self, read: &[PathBuf]) -> Result<AnswerPlace, Failure> {
        self.check_figures(read)?;
        let [file] = output::open([("--output", output::to_file(self.output.as_deref()))], read)?;
        let is_page = self.format.to_possible_value().is_some_and(|of| of.get_name() == "table");
        let page = if is_page { AnswerPlace::Page } else { AnswerPlace::StandardOutput };
        Ok(file.map_or(page, AnswerPlace::File))
    }

    /// Whether the answer goes to a file.
    pub(super) fn is_to_file(&self) -> bool {
        output::to_file(self.output.as_deref()).is_some()
    }

    /// Prints warnings and notes on standard error, unless `--quiet` is given.
    pub(super) fn say(&self, warnings: &[Warning]) {
        let said = |warning| words::note(warning, Language::English);
        self.note(warnings.iter().map(said));
    }

    /// Prints sentences on standard error, unless `--quiet` is given.
    pub(super) fn note<T: std::fmt::Display>(&self, texts: impl IntoIterator<Item = T>) {
        for text in texts.into_iter().filter(|_| !self.quiet) {
            say_line(&format!("note: {text}"));
        }
    }

    /// Whether the answer would go to a terminal.
    pub(super) fn is_terminal(&self) -> bool {
        !self.is_to_file() && in_call(|_| ()).is_none() && io::stdout().is_terminal()
    }
}

/// Whether an HTML page has a script.
#[derive(Clone, Debug, Args)]
pub(super) struct Interactive {
    /// Add a script to the HTML page: values under the pointer, sortable tables, enlargeable
    /// figures, methods that can be hidden. The script loads nothing, and the page is complete
    /// without it
    #[arg(long)]
    interactive: bool,
}

impl Interactive {
    /// The modification of the page.
    ///
    /// # Errors
    /// The answer is not an HTML page.
    pub(super) fn of<F: ValueEnum + Send + Sync>(
        &self,
        answer: &AnswerOptions<F>,
    ) -> Result<fn(String) -> String, Failure> {
        let is_html = answer.format.to_possible_value().is_some_and(|of| of.get_name() == "html");
        match (self.interactive, is_html) {
            (false, _) => Ok(|page| page),
            (true, true) => Ok(|page| gumption_report::interactive(&page)),
            (true, false) => {
                Err(Failure::Argument("`--interactive` goes with `--format html`".to_owned()))
            }
        }
    }
}

/// A workbook cannot be printed on a screen.
pub(super) fn workbook_in_terminal() -> Failure {
    let reason = "a workbook cannot be shown in a terminal; add `--output FILE.xlsx`, or give it \
                  to a pipe";
    Failure::Argument(reason.to_owned())
}

/// The seed of the random numbers.
#[derive(Clone, Debug, Args)]
pub(super) struct Seed {
    /// Seed of the random streams
    #[arg(long, value_name = "N", value_parser = seed, allow_negative_numbers = true)]
    seed: Option<u64>,
}

impl Seed {
    /// The given seed, or else that of the file.
    pub(super) fn or(&self, of_file: u64) -> u64 {
        self.seed.unwrap_or(of_file)
    }
}

/// The coverage of intervals and expanded uncertainties.
#[derive(Clone, Debug, Args)]
pub(super) struct CoverageOption {
    /// Coverage probability
    #[arg(long, value_name = "P", value_parser = probability, allow_negative_numbers = true)]
    coverage: Option<f64>,
    /// Coverage factor for infinite degrees of freedom, which sets the coverage probability
    /// [default: 2, approximately 95 %]
    #[arg(
        long,
        value_name = "K",
        value_parser = factor,
        allow_negative_numbers = true,
        conflicts_with = "coverage"
    )]
    k: Option<f64>,
}

impl CoverageOption {
    /// Whether it is given.
    pub(super) fn is_given(&self) -> bool {
        self.coverage.is_some() || self.k.is_some()
    }

    /// The given coverage, or else that of the file. A factor that the file keeps fixed stays
    /// fixed.
    pub(super) fn or(&self, of_file: Coverage) -> Coverage {
        let given = self.k.map(|factor| of_file.with_factor(factor));
        self.coverage.map(Coverage::Probability).or(given).unwrap_or(of_file)
    }
}

/// The number of threads.
#[derive(Clone, Debug, Args)]
pub(super) struct Threads {
    /// Number of threads [default: all of the machine]
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    threads: Option<usize>,
}

impl Threads {
    /// Their number; 0 for all.
    pub(super) fn count(&self) -> usize {
        self.threads.unwrap_or(0)
    }

    /// Starts the threads; a failure of the system is reported once.
    fn started(&self) -> Arc<Pool> {
        static SAID: Once = Once::new();
        let pool = parallel::pool(self.count());
        // in a browser only the calling thread exists
        if let Some(reason) = parallel::refused().filter(|_| !cfg!(target_family = "wasm")) {
            SAID.call_once(|| {
                say_line(&format!(
                    "warning: the system provides no threads ({}): one thread does all the work, \
                     and the answer is the \
                     same",
                    plain(reason)
                ));
            });
        }
        pool
    }

    /// Runs `work` on them.
    pub(super) fn install<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        self.started().install(work)
    }

    /// A run with these threads that a flag stops.
    pub(super) fn control<'s>(&self, stop: &'s AtomicBool) -> Control<'s> {
        self.started();
        Control::default().with_threads(self.count()).with_stop(stop)
    }
}

/// Other folders in which files may name files.
#[derive(Clone, Debug, Args)]
pub(super) struct AllowedFolders {
    /// Let files name other files below this folder too, not only below their own (repeatable)
    #[arg(long = "allow-path", value_name = "DIR")]
    folders: Vec<PathBuf>,
}

impl AllowedFolders {
    /// The reader of files, which may name others below these folders.
    pub(super) fn files<'f>(&'f self, program: &'f CommandLine) -> FileReader<'f> {
        program.files().allowing(&self.folders)
    }
}

/// How far files that others may have written are trusted.
#[derive(Clone, Debug, Args)]
pub(super) struct Trust {
    #[command(flatten)]
    folders: AllowedFolders,
    /// Accept saved results that were changed after they were written
    #[arg(long)]
    accept_changed: bool,
}

impl Trust {
    /// The reader of files with this trust.
    pub(super) fn files<'f>(&'f self, program: &'f CommandLine) -> FileReader<'f> {
        self.folders.files(program).accepting_changed_results(self.accept_changed)
    }
}

/// The paths of a given file and of the files that it names.
pub(super) fn with_named<'n>(
    file: &Path,
    names: impl IntoIterator<Item = &'n String>,
) -> Vec<PathBuf> {
    let folder = file.parent().unwrap_or(Path::new(""));
    let named = names.into_iter().map(|name| folder.join(name));
    std::iter::once(file.to_owned()).chain(named).collect()
}

/// The model file of an evaluation.
#[derive(Debug, Args)]
pub(super) struct ModelArguments {
    /// The model file; - for standard input
    model: PathBuf,
    #[command(flatten)]
    trust: Trust,
    /// Replace an input's estimate (NAME=35, NAME="35 deg"), a field (NAME.half_width=0.2) or readings
    /// (NAME.values="5.01, 5.02 V")
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = replacement)]
    pub(super) replacements: Vec<Override>,
}

impl ModelArguments {
    /// The model file with the replacements.
    pub(super) fn read(&self, program: &CommandLine) -> Result<ModelFile, Failure> {
        self.read_for(program, None, &TodaysReadings::default())
    }

    /// The same for a run with this number of trials, whatever the file says, and with the readings
    /// of the day.
    pub(super) fn read_for(
        &self,
        program: &CommandLine,
        trials: Option<Trials>,
        readings: &TodaysReadings,
    ) -> Result<ModelFile, Failure> {
        let readings = readings.read()?;
        let files = self.trust.files(program).making(trials).with_readings(readings.as_ref());
        let replaced = &self.replacements;
        let text = |files: FileReader<'_>, name: &str, text: &str, folder: &Path| {
            files.model_text(name, text, folder, replaced)
        };
        Ok(opened(files, &self.model, text, |path| files.model(path, replaced))??)
    }

    /// Its path; `None` for standard input.
    pub(super) fn path(&self) -> Option<&Path> {
        Some(self.model.as_path()).filter(|path| *path != Path::new("-"))
    }

    /// The paths of the file and of the files that it names.
    pub(super) fn paths(&self, file: &ModelFile) -> Vec<PathBuf> {
        with_named(&self.model, file.files.iter().map(|(name, _)| name))
    }
}

/// Readings that replace those of a model file.
#[derive(Clone, Debug, Default, Args)]
pub(super) struct TodaysReadings {
    /// Replace readings: a table (.csv, .xlsx) with columns by the names of inputs, with units, and a
    /// line for each reading; a column of a condition says to which point a line belongs
    #[arg(long = "readings", id = "file_of_readings", value_name = "FILE")]
    pub(super) file: Option<PathBuf>,
}

impl TodaysReadings {
    /// The readings, if a file is given.
    pub(super) fn read(&self) -> Result<Option<ReadingsFile>, Failure> {
        Ok(self.file.as_deref().map(ReadingsFile::open).transpose()?)
    }
}

/// The file that replaces standard input if a program calls a command.
fn given_file(path: &Path) -> Option<Arc<GivenFile>> {
    in_call(|call| call.input.clone()).flatten().filter(|_| path == Path::new("-"))
}

/// The file named by an argument: standard input for `-`.
pub(super) fn given<T>(
    path: &Path,
    text: impl FnOnce(&str) -> T,
    file: impl FnOnce(&Path) -> T,
) -> Result<T, Failure> {
    if path == Path::new("-") { Ok(text(&standard_input()?)) } else { Ok(file(path)) }
}

/// The file named by an argument, for content that may name files: as [`given`], but a file that a
/// program gives instead of standard input has its own name, folder and files.
pub(super) fn opened<T>(
    files: FileReader<'_>,
    path: &Path,
    text: impl FnOnce(FileReader<'_>, &str, &str, &Path) -> T,
    file: impl FnOnce(&Path) -> T,
) -> Result<T, Failure> {
    if let Some(of) = given_file(path) {
        return Ok(text(
            files.holding(&of.held).within(of.within.as_deref()),
            &of.name,
            &of.text,
            &of.folder,
        ));
    }
    given(path, |read| text(files, "<stdin>", read, Path::new("")), file)
}

/// The case of a diagnosis of the gap.
#[derive(Debug, Args)]
pub(super) struct Case {
    /// The case: a model file with observations and candidate effects; - for standard input
    case: PathBuf,
    #[command(flatten)]
    trust: Trust,
}

impl Case {
    /// The case.
    pub(super) fn read(&self, program: &CommandLine) -> Result<CaseFile, Failure> {
        let files = self.trust.files(program);
        let text = |files: FileReader<'_>, name: &str, text: &str, folder: &Path| {
            files.case_text(name, text, folder)
        };
        Ok(opened(files, &self.case, text, |path| files.case(path))??)
    }

    /// The model of the sim at the rows of a table of conditions.
    pub(super) fn at(&self, program: &CommandLine, rows: &Path) -> Result<Vec<Row>, Failure> {
        let files = self.trust.files(program);
        let text = |files: FileReader<'_>, name: &str, text: &str, folder: &Path| {
            files.case_text_at(name, text, folder, rows)
        };
        Ok(opened(files, &self.case, text, |path| files.case_at(path, rows))??)
    }

    /// The paths of the file and of the files that it names.
    pub(super) fn paths(&self, file: &CaseFile) -> Vec<PathBuf> {
        with_named(&self.case, file.files.iter().map(|(name, _)| name))
    }
}

/// A seed.
fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("a whole number from 0 to {} is needed", u64::MAX))
}

/// A number of threads.
fn threads(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(count @ 1..=1024) => Ok(count),
        _ => Err("a whole number from 1 to 1024 is needed".to_owned()),
    }
}

/// A number of trials.
pub(super) fn trials(text: &str) -> Result<Trials, String> {
    const NEEDED: &str = "a whole number (0, or from 2 to 1e12) or `adaptive` is needed";
    if text == "adaptive" {
        return Ok(Trials::Adaptive);
    }
    let value: f64 = text.parse().map_err(|_| NEEDED.to_owned())?;
    // 1e-400 is not representable, and 0 means only the GUM evaluation
    let mantissa = text.split(['e', 'E']).next().unwrap_or_default();
    if value == 0.0 && mantissa.contains(|c: char| matches!(c, '1'..='9')) {
        return Err(NEEDED.to_owned());
    }
    if value.fract() == 0.0 && (0.0..=1e12).contains(&value) && value != 1.0 {
        Ok(Trials::Fixed(value as u64))
    } else {
        Err(NEEDED.to_owned())
    }
}

/// Minimum value of the largest number of trials of an adaptive run: two blocks.
const LEAST_OF_MOST: u64 = 20_000;

/// The largest number of trials of an adaptive run; 1e9 is accepted.
pub(super) fn max_trials(text: &str) -> Result<u64, String> {
    match trials(text) {
        Ok(Trials::Fixed(most)) if most >= LEAST_OF_MOST => Ok(most),
        _ => Err(format!("a whole number from {LEAST_OF_MOST} to 1e12 is needed")),
    }
}

/// A number of significant digits.
pub(super) fn digits(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(digits @ 1..=15) => Ok(digits),
        _ => Err("a whole number from 1 to 15 is needed".to_owned()),
    }
}

/// Maximum number of bytes of memory.
#[cfg(target_pointer_width = "64")]
const MOST_MEMORY: usize = 1 << 40;
#[cfg(not(target_pointer_width = "64"))]
const MOST_MEMORY: usize = usize::MAX / 2;

/// A size of memory: bytes, or with K, M, G (or KiB, MiB, GiB).
pub(super) fn memory(text: &str) -> Result<usize, String> {
    let needed = || "a size such as 64M, 512MiB or 1G is needed".to_owned();
    let digits = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    let (number, unit) = text.split_at(digits);
    if number.is_empty() {
        return Err(needed());
    }
    let factor: usize = match unit.trim().trim_end_matches("iB").trim_end_matches('B') {
        "" => 1,
        "K" | "k" => 1 << 10,
        "M" => 1 << 20,
        "G" => 1 << 30,
        _ => return Err(needed()),
    };
    // digits that do not fit a number are too large
    let bytes = number.parse::<usize>().ok().and_then(|number| number.checked_mul(factor));
    match bytes {
        Some(bytes) if bytes < 1 << 20 => {
            Err("at least 1 MiB is needed for kept values".to_owned())
        }
        Some(bytes) if bytes <= MOST_MEMORY => Ok(bytes),
        _ => Err("at most 1024G (1 TiB) is possible".to_owned()),
    }
}

/// A further column of the budget, by its name.
pub(super) fn columns() -> impl TypedValueParser<Value = BudgetColumn> {
    PossibleValuesParser::new(BudgetColumn::ALL.map(BudgetColumn::name))
        .try_map(|name| BudgetColumn::named(&name).ok_or("there is no such column"))
}

/// When an adaptive run stops.
pub(super) fn rule() -> impl TypedValueParser<Value = StoppingRule> {
    PossibleValuesParser::new(StoppingRule::ALL.map(StoppingRule::name))
        .try_map(|name| StoppingRule::named(&name).ok_or("there is no such rule"))
}

/// The method for results without noise.
pub(super) fn method() -> impl TypedValueParser<Value = MethodChoice> {
    PossibleValuesParser::new(MethodChoice::ALL.map(MethodChoice::name))
        .try_map(|name| MethodChoice::named(&name).ok_or("there is no such method"))
}

/// Which method gives the stated value and expanded uncertainty.
#[derive(Clone, Copy, Debug, Args)]
pub(super) struct StatementOption {
    /// Source of the stated value and U: the law of propagation with k from the effective degrees of
    /// freedom (gum), the interval of the trials (monte-carlo), or the law of propagation where the
    /// trials agree with it apart from few degrees of freedom (auto) [default: that of the file, or
    /// auto]
    #[arg(long, value_name = "METHOD", value_parser = statement())]
    statement: Option<StatementMethod>,
}

impl StatementOption {
    /// The requested method, if one is.
    pub(super) fn requested(self) -> Option<StatementMethod> {
        self.statement
    }
}

fn statement() -> impl TypedValueParser<Value = StatementMethod> {
    PossibleValuesParser::new(StatementMethod::ALL.map(StatementMethod::name))
        .try_map(|name| StatementMethod::named(&name).ok_or("there is no such method"))
}

/// A coverage probability.
pub(super) fn probability(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(p) if p > 0.0 && p < 1.0 => Ok(p),
        found => {
            let percent = text.trim_end().strip_suffix('%').map(|text| text.trim_end().parse());
            let meant = percent.unwrap_or(found).ok().and_then(of_percent);
            Err(match meant {
                Some(p) => format!("a probability between 0 and 1 is needed; did you mean {p}?"),
                None => "a probability between 0 and 1 is needed, such as 0.95".to_owned(),
            })
        }
    }
}

/// A coverage factor.
fn factor(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        // beyond 8 the probability is 1 in double precision
        Ok(factor) if factor > 0.0 && factor <= 8.0 => Ok(factor),
        _ => Err("a coverage factor above 0 and at most 8 is needed, such as 2".to_owned()),
    }
}

/// A replacement of an input.
fn replacement(text: &str) -> Result<Override, String> {
    Override::parse(text).ok_or_else(|| "NAME=VALUE or NAME.field=VALUE is needed".to_owned())
}

/// The text of standard input.
fn standard_input() -> Result<String, Failure> {
    if let Some(of) = given_file(Path::new("-")) {
        return Ok(of.text.clone());
    }
    let bytes = bytes::of(io::stdin(), bytes::MOST)
        .map_err(|message| Failure::Argument(format!("standard input: {message}")))?;
    let text = bytes::text(&bytes).map(Cow::into_owned);
    text.map_err(|reason| Failure::Argument(format!("standard input: {reason}")))
}
