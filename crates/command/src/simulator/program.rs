//! A simulator that is a program.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, Sender};
use std::thread;
use std::time::{Duration, Instant};

use gumption_emulator::{RunResult, Simulator, SimulatorCase};

use super::call::{Call, FailedCall};
use super::child::Patience;
use super::lines::{Lines, Waiting};
use super::process;
use super::request::Requests;
use super::words::words;

/// A program that is started for each run or kept for many.
///
/// On standard input it gets `{"parameters": {"length": 0.5}, "conditions": {"t": [0, 0.01]}}`, with all
/// parameters and conditions of the case in their units. On standard output it writes
/// `{"angle": [0.1, 0.2]}`, with all outputs in their units and a value for each row, and ends with exit
/// code 0. Anything else is a failed run, whose reason says what was found and the last lines of the standard
/// error.
#[derive(Debug)]
pub struct Program {
    words: Vec<String>,
    at_once: usize,
    timeout: Option<Duration>,
    stop: Arc<AtomicBool>,
    /// The programs that are kept between runs; `None` if each run starts its own.
    kept: Option<Waiting>,
}

impl Program {
    /// The program of a command, whose words are split as a shell does it: at white space, with single and
    /// double quotes. It is started without a shell: variables, wildcards and pipes mean nothing.
    ///
    /// # Errors
    /// An empty command, a quote without an end, an operator of a shell.
    pub fn new(command: &str) -> Result<Self, String> {
        Ok(Self {
            words: words(command)?,
            at_once: 1,
            timeout: None,
            stop: Arc::default(),
            kept: None,
        })
    }

    /// The same, started once for many runs: it reads a request on each line of its standard input, and
    /// writes the answer to each on one line. It is started anew after a failure, and ends when its
    /// standard input ends.
    #[must_use]
    pub fn line_by_line(self) -> Self {
        Self { kept: Some(Waiting::default()), ..self }
    }

    /// The same, with so many runs at once; 0 for as many as the machine has processors.
    #[must_use]
    pub fn with_runs_at_once(self, count: usize) -> Self {
        let all = || thread::available_parallelism().map_or(1, usize::from);
        Self { at_once: if count == 0 { all() } else { count }, ..self }
    }

    /// The same, with a longest time for a run, after which the program is ended with all that it started
    /// in its process group. On Windows, which has no process groups, it alone is ended.
    #[must_use]
    pub fn with_timeout(self, timeout: Duration) -> Self {
        Self { timeout: Some(timeout), ..self }
    }

    /// The same, with a flag that ends all running programs; their runs then have no result.
    #[must_use]
    pub fn with_stop(self, stop: Arc<AtomicBool>) -> Self {
        Self { stop, ..self }
    }

    /// Makes runs until there are none left.
    fn work(&self, batch: &RequestedRuns<'_>, give: &Sender<(usize, RunResult)>) {
        loop {
            let index = batch.next.fetch_add(1, Ordering::Relaxed);
            let Some(parameters) = batch.parameters.get(index) else { return };
            let stops = [&*self.stop, &batch.enough];
            if stops.iter().any(|stop| stop.load(Ordering::Relaxed)) {
                return;
            }
            let call = Call { case: batch.case, request: batch.requests.request(parameters) };
            let until = self.timeout.and_then(|timeout| Instant::now().checked_add(timeout));
            let result = match self.call(&call, &Patience { until, stops }) {
                Ok(outputs) => Ok(outputs),
                Err(failed) => {
                    let Some(reason) = failed.reason(self.timeout) else { return };
                    Err(reason)
                }
            };
            if give.send((index, result)).is_err() {
                return;
            }
        }
    }

    fn call(&self, call: &Call<'_>, patience: &Patience<'_>) -> Result<Vec<f64>, FailedCall> {
        let Some(kept) = &self.kept else {
            return process::run(&self.words, call, patience);
        };
        let program = kept.take().map_or_else(|| Lines::start(&self.words, call), Ok)?;
        let (outputs, program) = program.run(call, patience)?;
        kept.put(program);
        Ok(outputs)
    }
}

impl Simulator for Program {
    fn run(
        &self,
        batch: &[Vec<f64>],
        case: &SimulatorCase,
        finished: &mut dyn FnMut(usize, RunResult) -> ControlFlow<()>,
    ) {
        let batch = RequestedRuns {
            parameters: batch,
            case,
            requests: Requests::of(case),
            next: AtomicUsize::new(0),
            enough: AtomicBool::new(false),
        };
        let (give, results) = mpsc::channel();
        thread::scope(|scope| {
            let mut workers = 0;
            for _ in 0..self.at_once.min(batch.parameters.len()) {
                let (batch, give) = (&batch, give.clone());
                let builder = thread::Builder::new().name("simulator".to_owned());
                // fewer threads make the same runs
                workers += usize::from(
                    builder.spawn_scoped(scope, move || self.work(batch, &give)).is_ok(),
                );
            }
            if workers == 0 {
                self.work(&batch, &give);
            }
            drop(give);
            for (index, result) in results {
                if finished(index, result).is_break() {
                    batch.enough.store(true, Ordering::Relaxed);
                    break;
                }
            }
        });
    }
}

/// Runs that are shared out.
struct RequestedRuns<'b> {
    parameters: &'b [Vec<f64>],
    case: &'b SimulatorCase,
    requests: Requests<'b>,
    next: AtomicUsize,
    /// No more results are wanted.
    enough: AtomicBool,
}
