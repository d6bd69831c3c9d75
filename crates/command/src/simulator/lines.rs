//! A program that is kept for many runs: a line of JSON for each request and each answer.

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
        if let Some(Written::Answer(_)) = self.0.written_already() {
            return Err(one_line());
        }
        self.0.send(call.request.clone());
        let line = match self.0.written(patience)? {
            Written::Answer(line) => line,
            Written::TooMuch(most) => return Err(NoResult::too_much(most)),
            Written::Nothing => {
                let status = self.0.status(patience)?;
                let how = failure(status).unwrap_or_else(|| "it ended".to_owned());
                return Err(NoResult::Failed(format!("{how} without an answer")));
            }
        };
        let outputs = answer::outputs(&line, "its line", call.case).map_err(NoResult::Failed)?;
        match self.0.written_already() {
            Some(Written::Answer(_)) => Err(one_line()),
            _ => Ok(outputs),
        }
    }
}
