//! `gumption check`

use gumption_report::words;
use gumption_report::words::Note;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;

use super::exit::say;
use super::options::{self, AnswerOptions, Format, Trust};
use super::{CommandLine, Exit, Failure, diagnostics};
use gumption_report::{plain, pretty};
use gumption_text::{Diagnostic, Diagnostics};

/// Check a file and list all of its errors.
#[derive(Debug, Args)]
pub(super) struct Check {
    /// The file; - for standard input
    file: PathBuf,
    #[command(flatten)]
    trust: Trust,
    #[command(flatten)]
    answer: AnswerOptions<Format>,
}

/// The answer for programs.
#[derive(Debug, Serialize)]
struct Verdict<'n> {
    ok: bool,
    errors: Vec<Mistake>,
    /// Notes about correct but unusual content, as a run prints them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<Note<'n>>,
}

/// An error in a file as `check --format json` reports it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Mistake {
    /// The file's name.
    pub file: String,
    /// The line, counted from 1.
    pub line: usize,
    /// The column in characters, counted from 1.
    pub column: usize,
    /// A short identifier of the kind of error.
    pub code: &'static str,
    /// What is wrong, in a sentence.
    pub message: String,
    /// What was probably meant.
    pub suggestion: Option<String>,
}

impl From<&Diagnostic> for Mistake {
    fn from(diagnostic: &Diagnostic) -> Self {
        let (line, column) = diagnostic.position();
        Self {
            file: diagnostic.source.name.clone(),
            line,
            column,
            code: diagnostic.kind.code(),
            message: diagnostic.message() + diagnostics::command(&diagnostic.kind),
            suggestion: diagnostic.kind.suggestion(),
        }
    }
}

impl Check {
    pub(super) fn execute(&self, program: &CommandLine) -> Result<Exit, Failure> {
        let files = self.trust.files(program);
        let place = self.answer.open(std::slice::from_ref(&self.file))?;
        let text = |text: &str| files.check_text("<stdin>", text, Path::new(""));
        let result = options::given(&self.file, text, |path| files.check(path))?;
        let (found, notes) = match result {
            Ok(notes) => (Diagnostics(Vec::new()), notes),
            Err(found) => (found, Vec::new()),
        };
        let right = found.0.is_empty();
        let answer = match self.answer.format {
            Format::Json => {
                let errors = found.0.iter().map(Mistake::from).collect();
                let warnings = words::notes(&notes);
                let verdict = Verdict { ok: right, errors, warnings };
                pretty(&verdict)
            }
            Format::Csv => {
                return Err(Failure::Argument("`check` answers as table or json".into()));
            }
            Format::Table if right => {
                format!("{}: no errors found\n", plain(&self.file.display().to_string()))
            }
            Format::Table => {
                // a list of errors is an error message wherever it is sent
                return Err(Failure::Diagnostics(found));
            }
        };
        self.answer.say(&notes);
        place.write(&answer)?;
        if !right && !self.answer.quiet {
            say(&diagnostics::render(&found, true));
        }
        Ok(if right { Exit::Done } else { Exit::Wrong })
    }
}
