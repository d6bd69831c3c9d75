//! How a command can end.

use std::fmt;
use std::process::ExitCode;

use super::diagnostics;
use gumption_files::Diagnostics;

/// A regular end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Done.
    Done,
    /// Done, and the answer is "no" where `--fail` was given.
    No,
    /// A file was checked and found wrong; the mistakes are the answer.
    Wrong,
    /// Interrupted by the user.
    Interrupted,
}

impl Exit {
    pub(super) fn code(self) -> ExitCode {
        ExitCode::from(match self {
            Self::Done => 0,
            Self::Wrong => 2,
            Self::No => 3,
            Self::Interrupted => 130,
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
            Self::Argument(message) | Self::System(message) => writeln!(f, "gumption: {message}"),
        }
    }
}

impl Failure {
    /// Says what is wrong on standard error and gives the exit code.
    #[allow(clippy::print_stderr)]
    pub(super) fn report(&self) -> ExitCode {
        match self {
            Self::Diagnostics(diagnostics) => {
                anstream::eprint!("{}", diagnostics::render(diagnostics, true))
            }
            Self::Argument(_) | Self::System(_) => eprint!("{self}"),
        }
        ExitCode::from(if matches!(self, Self::System(_)) { 1 } else { 2 })
    }
}
