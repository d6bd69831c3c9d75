//! A run of a program, and why it has no result.

use std::io;
use std::time::Duration;

use gumption_columns::read_failure;
use gumption_emulator::SimulatorCase;

use super::child::{Expired, Running};

/// A run to be made.
pub(super) struct Call<'c> {
    pub(super) case: &'c SimulatorCase,
    pub(super) request: Vec<u8>,
}

/// Why a run has no result.
#[derive(Debug)]
pub(super) enum NoResult {
    /// The runs are to stop.
    Stopped,
    /// The run took longer than it may.
    Timeout,
    /// What was found.
    Failed(String),
}

impl NoResult {
    pub(super) fn not_started(words: &[String], error: &io::Error) -> Self {
        let name = words.first().map_or("", String::as_str);
        let reason = match error.kind() {
            io::ErrorKind::NotFound => "there is no such program".to_owned(),
            _ => read_failure::in_words(error),
        };
        Self::Failed(format!("`{name}` cannot be started: {reason}"))
    }

    pub(super) fn too_much(most: usize) -> Self {
        Self::Failed(format!("it wrote more than {most} bytes to its standard output"))
    }
}

impl From<Expired> for NoResult {
    fn from(expired: Expired) -> Self {
        match expired {
            Expired::Stopped => Self::Stopped,
            Expired::Timeout => Self::Timeout,
        }
    }
}

/// A run without a result, with the last lines of the program's standard error.
#[derive(Debug)]
pub(super) struct FailedCall {
    why: NoResult,
    errors: String,
}

impl FailedCall {
    /// Ends the program.
    pub(super) fn of(why: NoResult, mut running: Running) -> Self {
        running.end();
        Self { why, errors: running.last_errors() }
    }

    /// The reason of the failure; `None` if the runs are to stop.
    pub(super) fn reason(&self, timeout: Option<Duration>) -> Option<String> {
        let found = match &self.why {
            NoResult::Stopped => return None,
            NoResult::Timeout => {
                let seconds = timeout.unwrap_or_default().as_secs_f64();
                format!("it did not end within {seconds} s")
            }
            NoResult::Failed(found) => found.clone(),
        };
        let errors = match self.errors.as_str() {
            "" => String::new(),
            errors => format!("; its standard error ends with: {errors}"),
        };
        Some(format!("{found}{errors}"))
    }
}

impl From<NoResult> for FailedCall {
    fn from(why: NoResult) -> Self {
        Self { why, errors: String::new() }
    }
}
