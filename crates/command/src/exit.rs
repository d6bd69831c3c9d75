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
    /// Done, and the answer is "no" where `--fail` was given.
    No,
    /// A file was checked and found wrong; the mistakes are the answer.
    Wrong,
    /// The parts of a run are put together, and another pass over its blocks is needed.
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
            // EX_TEMPFAIL of sysexits.h: to be tried again
            Self::Again => 75,
            Self::Interrupted => signals::exit_code(),
        })
    }
}

/// A command that could not be done.
#[derive(Debug)]
pub enum Failure {
    /// The user's files are at fault.
    Diagnostics(Diagnostics),
    /// The user's arguments are at fault.
    Argument(String),
    /// The system is at fault: a full disk, a missing permission.
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
    /// Says what is wrong on standard error and gives the exit code.
    pub(super) fn report(&self) -> ExitCode {
        match self {
            Self::Diagnostics(diagnostics) => say(&diagnostics::render(diagnostics, true)),
            Self::Argument(_) | Self::System(_) => say(&self.to_string()),
        }
        ExitCode::from(if matches!(self, Self::System(_)) { 1 } else { 2 })
    }
}

/// Says a sentence, in which texts of files may stand, on a line of standard error.
pub(super) fn say_line(sentence: &str) {
    say(&(printable(sentence) + "\n"));
}

/// Says something on standard error. Where that cannot be written, as on a full disk, it is not
/// said: what was computed counts more.
pub(super) fn say(text: &str) {
    if in_call(|call| call.notes.push_str(text)).is_some() {
        return;
    }
    let mut out = anstream::stderr().lock();
    let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
}
