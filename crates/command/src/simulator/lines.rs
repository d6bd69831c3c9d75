//! A program that is kept for many runs: a line of JSON for each request and each answer.

use std::sync::{Mutex, PoisonError};

use super::answer;
use super::call::{Call, FailedCall, NoResult};
use super::child::{Answers, Patience, Running, Written, failure};

/// A program that answers line by line.
#[derive(Debug)]
pub(super) struct Lines(Running);

impl Lines {
    /// Starts the program.
    pub(super) fn start(words: &[String], call: &Call<'_>) -> Result<Self, NoResult> {
        Running::start(words, answer::most_bytes(call.case), Answers::Lines)
            .map(Self)
            .map_err(|error| NoResult::not_started(words, &error))
    }

    /// Makes a run. After a failure the program cannot be used any longer, because it could answer late.
    pub(super) fn run(
        mut self,
        call: &Call<'_>,
        patience: &Patience<'_>,
    ) -> Result<(Vec<f64>, Self), FailedCall> {
        match self.answer(call, patience) {
            Ok(outputs) => Ok((outputs, self)),
            Err(why) => Err(FailedCall::of(why, self.0)),
        }
    }

    fn answer(&mut self, call: &Call<'_>, patience: &Patience<'_>) -> Result<Vec<f64>, NoResult> {
        let one_line = || NoResult::Failed("it wrote more than one line for a request".to_owned());
        // a line that belongs to no request shifts all answers
        if self.0.written_already().is_some() {
            return Err(one_line());
        }
        self.0.send(call.request.clone());
        let line = match self.0.written(patience)? {
            Written::Answer(line) => line,
            Written::MoreThanLine => return Err(one_line()),
            Written::TooMuch(most) => return Err(NoResult::too_much(most)),
            Written::Nothing => {
                let status = self.0.status(patience)?;
                let how = failure(status).unwrap_or_else(|| "it ended".to_owned());
                return Err(NoResult::Failed(format!("{how} without an answer")));
            }
        };
        answer::outputs(&line, "its line", call.case).map_err(NoResult::Failed)
    }
}

/// The programs that wait for their next runs. Dropped, they are told that there are no more.
#[derive(Debug, Default)]
pub(super) struct Waiting(Mutex<Vec<Lines>>);

impl Waiting {
    /// One of them, if there is one.
    pub(super) fn take(&self) -> Option<Lines> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).pop()
    }

    /// Adds a program.
    pub(super) fn put(&self, program: Lines) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(program);
    }
}

impl Drop for Waiting {
    fn drop(&mut self) {
        let programs = self.0.get_mut().unwrap_or_else(PoisonError::into_inner);
        programs.iter_mut().for_each(|program| program.0.end_input());
        programs.iter_mut().for_each(|program| program.0.end_by_itself());
    }
}
