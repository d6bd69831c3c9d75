//! How a command can end.

use std::fmt;
use std::io::Write;
use std::process::ExitCode;

use super::surroundings::in_call;
use super::{diagnostics, signals};
use gumption_report::plain;
use gumption_text::{Diagnostics, printable};

/// A regular end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Done.
    Done,
    /// Done, and the result is "no" with `--fail`.
    No,
    /// A file was checked and has errors; the errors are the answer.
    Wrong,
    /// The parts of a run are merged, and another pass over its blocks is needed.
    Again,
    /// Interrupted by a signal.
    Interrupted,
}

impl Exit {
    pub(super) fn code(self) -> ExitCode {
        ExitCode::from(match self {
            Self::Done => 0,
            Self::Wrong => 2,
            Self::No => 3,
            // EX_TEMPFAIL of sysexits.h: try again
            Self::Again => 75,
            Self::Interrupted => signals::exit_code(),
        })
    }
}

/// A command that failed.
#[derive(Debug)]
pub enum Failure {
    /// Errors in the user's files.
    Diagnostics(Diagnostics),
    /// An error in the user's arguments.
    Argument(String),
    /// An error of the system: a full disk, a missing permission.
    System(String),
}

impl From<Diagnostics> for Failure {
    fn from(diagnostics: Diagnostics) -> Self {
        Self::Diagnostics(diagnostics)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Diagnostics(diagnostics) => f.write_str(&diagnostics::render(diagnostics, false)),
            Self::Argument(message) | Self::System(message) => {
                writeln!(f, "gumption: {}", plain(message))
            }
        }
    }
}

impl Failure {
    /// Prints the error on standard error and returns the exit code.
    pub(super) fn report(&self) -> ExitCode {
        match self {
            Self::Diagnostics(diagnostics) => say(&diagnostics::render(diagnostics, true)),
            Self::Argument(_) | Self::System(_) => say(&self.to_string()),
        }
        ExitCode::from(if matches!(self, Self::System(_)) { 1 } else { 2 })
    }
}

/// Prints a sentence, which may contain texts of files, on a line of standard error.
pub(super) fn say_line(sentence: &str) {
    say(&(printable(sentence) + "\n"));
}

/// Prints a text on standard error. Failures to write, as on a full disk, are ignored: the computed
/// result is more important.
pub(super) fn say(text: &str) {
    if in_call(|call| call.notes.push_str(text)).is_some() {
        return;
    }
    let mut out = anstream::stderr().lock();
    let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
}
