//! A program that is started once for each run.

use gumption_emulator::SimulatorCase;

use super::answer;
use super::call::{Call, FailedCall, NoResult};
use super::child::{Answers, Patience, Running, Written, failure};

/// Starts the program, gives it the request, and reads its answer when it has ended.
pub(super) fn run(
    words: &[String],
    call: &Call<'_>,
    patience: &Patience<'_>,
) -> Result<Vec<f64>, FailedCall> {
    let started = Running::start(words, answer::most_bytes(call.case), Answers::Whole);
    let mut running = started.map_err(|error| NoResult::not_started(words, &error))?;
    running.send(call.request.clone());
    running.end_input();
    finish(&mut running, call.case, patience).map_err(|why| FailedCall::of(why, running))
}

fn finish(
    running: &mut Running,
    case: &SimulatorCase,
    patience: &Patience<'_>,
) -> Result<Vec<f64>, NoResult> {
    let written = match running.written(patience)? {
        Written::Answer(written) => written,
        Written::TooMuch(most) => return Err(NoResult::too_much(most)),
        Written::MoreThanLine | Written::Nothing => Vec::new(),
    };
    let status = running.status(patience)?;
    if let Some(found) = failure(status) {
        return Err(NoResult::Failed(found));
    }
    answer::outputs(&written, "its standard output", case).map_err(NoResult::Failed)
}
