//! The command line: arguments in, exit code out. One file for each subcommand.

#![cfg_attr(test, allow(clippy::disallowed_methods))] // tests compare within tolerances

mod assumptions;
mod certificate;
mod check;
mod compare;
mod completions;
mod dcc;
mod definition;
mod diagnosed;
mod diagnostics;
mod diff;
mod evaluated;
mod exit;
mod exported;
mod figures;
pub mod freed_memory;
mod gap;
mod gap_check;
mod help;
mod import;
mod internal_error;
mod man_pages;
mod merge;
mod models;
mod new;
mod observe;
#[cfg(feature = "open")]
mod open;
mod options;
mod output;
mod paint;
mod parted_run;
mod parts;
mod plan;
#[cfg_attr(target_family = "wasm", path = "no_progress.rs")]
mod progress;
mod readings;
mod replacement;
mod run;
mod save;
mod schema;
mod shared_draws;
mod signals;
pub mod simulator;
mod surroundings;
mod verify;

use std::ffi::OsString;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{ArgAction, Parser, Subcommand};
use gumption_engine::model::typed::{Catalogue, CatalogueEntry};
use gumption_files::FileReader;
use gumption_live::Live;
use gumption_units::all_nearest;

pub use check::Mistake;
pub use diagnosed::DiagnosedCase;
pub use exit::{Exit, Failure};
pub use exported::{ExportedAnswer, NotExported};
pub use parted_run::{MergedRun, PartedMerging, PartedRun, PassOfRun};
pub use parts::PartsFolder;
pub use surroundings::GivenFile;
pub use verify::PublishedExamples;

/// Measurement uncertainty by the GUM and by Monte Carlo, side by side.
#[derive(Debug, Parser)]
#[command(
    name = "gumption",
    version,
    max_term_width = 100,
    disable_help_subcommand = true,
    disable_help_flag = true
)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// Colours on a terminal, always or never; auto respects NO_COLOR
    #[arg(
        long,
        global = true,
        value_name = "WHEN",
        hide_possible_values = true,
        default_value = "auto",
        help_heading = definition::REST,
        display_order = 1000
    )]
    color: paint::When,
    /// Print help
    #[arg(long, short, global = true, action = ArgAction::Help, help_heading = definition::REST, display_order = 1001)]
    help: Option<bool>,
}

#[derive(Debug, Subcommand)]
enum Command {
    Run(run::Run),
    Merge(merge::Merge),
    Assumptions(assumptions::Assumptions),
    Certificate(certificate::Certificate),
    Check(check::Check),
    Compare(compare::Compare),
    Dcc(dcc::Dcc),
    Import(import::Import),
    Readings(readings::Readings),
    New(new::New),
    Models(models::Models),
    Verify(verify::Verify),
    Diff(diff::Diff),
    Plan(plan::Planning),
    Gap(gap::Gap),
    GapCheck(gap_check::GapCheck),
    Observe(observe::Observe),
    #[cfg(feature = "open")]
    Open(open::Open),
    Schema(schema::Schema),
    Help(help::Help),
    Completions(completions::Completions),
    Man(man_pages::ManPages),
}

impl Command {
    /// Whether the command waits for its user most of the time.
    fn idles(&self) -> bool {
        #[cfg(feature = "open")]
        if matches!(self, Self::Open(_)) {
            return true;
        }
        false
    }
}

/// The result of a command that was called as a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answered {
    /// The text for standard output.
    pub answer: Vec<u8>,
    /// The text for standard error.
    pub notes: String,
    /// How it ended.
    pub exit: Exit,
}

/// The command line with its typed measurements and published examples.
#[derive(Clone, Debug, Default)]
pub struct CommandLine {
    catalogue: Catalogue,
    published: PublishedExamples,
}

impl CommandLine {
    /// The command line with these typed measurements and published examples.
    pub fn new(catalogue: Catalogue, published: PublishedExamples) -> Self {
        Self { catalogue, published }
    }

    /// The same with one more measurement that files can name; it replaces one of the same name.
    #[must_use]
    pub fn with(self, entry: CatalogueEntry) -> Self {
        Self { catalogue: self.catalogue.with(entry), ..self }
    }

    /// The reader of files, which may name the measurements.
    pub fn files(&self) -> FileReader<'_> {
        FileReader::new(&self.catalogue)
    }

    /// The answers of the live page, for files that may name the measurements.
    pub fn live(&self) -> Live<'_> {
        Live::new(&self.catalogue, self.published.starting_points())
    }

    /// Runs with the arguments of the process. Prints errors on standard error, and ends with 0
    /// (done), 1 (error of the system), 2 (error in the arguments or files), 3 (done, and the
    /// result is "no" with `--fail`), 75 (`merge`: another pass is needed), or 130, 143 or 129
    /// (interrupted, terminated, hung up).
    pub fn main(&self) -> ExitCode {
        self.main_of(std::env::args_os())
    }

    /// The same with these arguments; the first one is the name of the program.
    pub fn main_of(&self, arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
        signals::watch();
        internal_error::watch();
        let arguments = match definition::parsed(arguments) {
            Ok(arguments) => arguments,
            Err(told) => match misspelt(&told) {
                Some(message) => return Failure::Argument(message).report(),
                None => told.exit(),
            },
        };
        arguments.color.choose();
        if !arguments.command.idles() {
            freed_memory::keep();
        }
        match gumption_report::within_screen(paint::screen(), || self.execute(arguments.command)) {
            Ok(exit) => exit.code(),
            Err(failure) => failure.report(),
        }
    }

    /// Runs a command as a function: returns what would go to standard output and standard error,
    /// and changes nothing of the process. `arguments` follow the name of the program. `input`
    /// replaces standard input for `-`: as a file if a command reads a model file, otherwise its
    /// text. `stop` acts like a signal.
    ///
    /// # Errors
    /// The message that the program prints on standard error with the exit codes 1 and 2; its
    /// `Display` is the same text, without colours.
    pub fn call(
        &self,
        arguments: impl IntoIterator<Item = OsString>,
        input: Option<GivenFile>,
        stop: Arc<AtomicBool>,
    ) -> Result<Answered, Failure> {
        let name = std::iter::once(OsString::from("gumption"));
        let arguments = match definition::parsed(name.chain(arguments)) {
            Ok(arguments) => arguments,
            // help and version are answers
            Err(told) if !told.use_stderr() => {
                let answer = told.to_string().into_bytes();
                return Ok(Answered { answer, notes: String::new(), exit: Exit::Done });
            }
            Err(error) => {
                let told = misspelt(&error);
                let told = told.unwrap_or_else(|| error.to_string().trim_end().to_owned());
                return Err(Failure::Argument(told));
            }
        };
        let input = input.map(Arc::new);
        let given = surroundings::Surroundings { stop, input, ..Default::default() };
        let (exit, left) = surroundings::within(given, || self.execute(arguments.command));
        Ok(Answered { answer: left.answer, notes: left.notes, exit: exit? })
    }

    fn execute(&self, command: Command) -> Result<Exit, Failure> {
        match command {
            Command::Run(command) => command.execute(self),
            Command::Merge(command) => command.execute(self),
            Command::Assumptions(command) => command.execute(self),
            Command::Certificate(command) => command.execute(self),
            Command::Check(command) => command.execute(self),
            Command::Compare(command) => command.execute(),
            Command::Dcc(command) => command.execute(),
            Command::Import(command) => command.execute(),
            Command::Readings(command) => command.execute(self),
            Command::Models(command) => command.execute(self),
            Command::Verify(command) => command.execute(self),
            Command::Diff(command) => command.execute(self),
            Command::Plan(command) => command.execute(self),
            Command::Gap(command) => command.execute(self),
            Command::GapCheck(command) => command.execute(self),
            Command::Observe(command) => command.execute(self),
            #[cfg(feature = "open")]
            Command::Open(command) => command.execute(self),
            Command::Schema(command) => command.execute(),
            Command::Help(command) => command.execute(),
            Command::Completions(command) => command.execute(),
            Command::Man(command) => command.execute(),
            Command::New(command) => command.execute(self),
        }
    }
}

/// The hint for an unknown command: the nearest command, or all commands; and the right form if a
/// file is given instead of a command.
fn misspelt(error: &clap::Error) -> Option<String> {
    if error.kind() != ErrorKind::InvalidSubcommand {
        return None;
    }
    let Some(ContextValue::String(name)) = error.get(ContextKind::InvalidSubcommand) else {
        return None;
    };
    let program = definition::definition();
    let names: Vec<&str> = program.get_subcommands().map(clap::Command::get_name).collect();
    let near = all_nearest(name, names.iter().copied());
    let hint = if Path::new(name).is_file() {
        format!(
            "it is a file: write a command before it, such as `gumption run {name}`; `gumption \
             check {name}` lists its errors"
        )
    } else if let Some(question) = did_you_mean(&near) {
        format!("{question} `gumption --help` lists all")
    } else {
        format!("the commands are {}", names.join(", "))
    };
    Some(format!("there is no command `{name}`; {hint}"))
}

/// The question after a message with the nearest names, if there are any.
fn did_you_mean(near: &[&str]) -> Option<String> {
    let near: Vec<String> = near.iter().map(|name| format!("`{name}`")).collect();
    (!near.is_empty()).then(|| format!("did you mean {}?", gumption_units::listed(&near, " or ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn call(arguments: &[&str], input: Option<GivenFile>) -> Result<Answered, Failure> {
        let arguments = arguments.iter().map(OsString::from);
        CommandLine::default().call(arguments, input, Arc::default())
    }

    fn given(text: &str) -> Option<GivenFile> {
        let held = vec![("f.csv".to_owned(), b"f\n1\n2\n".to_vec())];
        let (name, text) = ("mine".to_owned(), text.to_owned());
        Some(GivenFile { name, text, held, ..GivenFile::default() })
    }

    #[test]
    fn a_command_called_as_a_function_gives_back_what_it_prints() {
        let model = r#"{"format": 1,
            "inputs": {"a": {"unit": "m", "distribution": "normal", "mean": 1, "std": 0.1}},
            "conditions": {"file": "f.csv", "units": {"f": "Hz"}},
            "equations": {"y": "a*f"}, "outputs": {"y": {"unit": "m/s"}}}"#;
        let arguments = ["run", "-", "--format", "csv", "--trials", "1000"];
        let answered = call(&arguments, given(model)).unwrap();
        assert_eq!(String::from_utf8(answered.answer).unwrap().lines().count(), 3);
        assert!(answered.notes.contains("few"), "{}", answered.notes);
        assert_eq!(answered.exit, Exit::Done);
        // one call must not use the surroundings of another
        let schema = call(&["schema"], None).unwrap();
        assert!(schema.answer.starts_with(b"{") && schema.notes.is_empty());
    }

    #[test]
    fn its_failures_have_the_text_of_the_program() {
        let wrong = call(&["run", "-"], given("{\n \"inputs\": 1}")).unwrap_err().to_string();
        assert!(wrong.contains("mine:2:12: "), "{wrong}");
        let wrong = call(&["run", "--nothing"], None).unwrap_err().to_string();
        assert!(wrong.contains("unexpected argument '--nothing'"), "{wrong}");
        assert!(call(&["--version"], None).unwrap().answer.starts_with(b"gumption "));
    }

    #[test]
    fn a_call_is_stopped_by_its_own_flag() {
        let model = r#"{"format": 1,
            "inputs": {"a": {"unit": "m", "distribution": "normal", "mean": 1, "std": 0.1}},
            "equations": {"y": "a*a"}, "outputs": {"y": {"unit": "m^2"}}}"#;
        let arguments = ["run", "-", "--format", "json", "--trials", "1e11"].map(OsString::from);
        let stop = Arc::new(AtomicBool::new(true));
        let answered = CommandLine::default().call(arguments, given(model), stop).unwrap();
        assert_eq!(answered.exit, Exit::Interrupted);
    }
}
