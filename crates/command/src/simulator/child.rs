//! A running program: its input, what it writes, and its end.

use std::collections::BTreeSet;
use std::io::{self, BufReader, Read, Write};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender, SyncSender};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use gumption_text::printable;

/// The end of standard error that is kept, in bytes.
const TAIL: usize = 4096;

/// Lines of standard error in a message.
const LINES: usize = 10;

/// Time between two looks at the flags that stop a run.
const TICK: Duration = Duration::from_millis(50);

/// Time for a program that is asked to end, and for the pipes of one that has ended.
const GRACE: Duration = Duration::from_millis(500);

/// The programs that run, by their process ids.
static RUNNING: Mutex<BTreeSet<u32>> = Mutex::new(BTreeSet::new());

/// Ends all running programs at once, before the process itself ends. It may be called by the thread that
/// is starting one, so it does not wait for the list for more than a second.
pub(crate) fn end_all() {
    for _ in 0..100 {
        if let Ok(running) = RUNNING.try_lock() {
            running.iter().for_each(|&id| end_group(id, End::Now));
            return;
        }
        thread::sleep(Duration::from_millis(10));
    }
}

/// What a program has written.
#[derive(Debug)]
pub(super) enum Written {
    /// All of its standard output, or a line of it.
    Answer(Vec<u8>),
    /// A line, and something behind it that came with it.
    MoreThanLine,
    /// More than the limit, in bytes.
    TooMuch(usize),
    /// Its standard output has ended.
    Nothing,
}

/// Why there is nothing to wait for any longer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Expired {
    /// The time of the run is over.
    Timeout,
    /// The runs are to stop.
    Stopped,
}

/// What is an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Answers {
    /// All of standard output.
    Whole,
    /// Each line.
    Lines,
}

/// When the wait for a program ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patience<'s> {
    /// `None` for no limit.
    pub(super) until: Option<Instant>,
    /// Flags, any of which stops the run.
    pub(super) stops: [&'s AtomicBool; 2],
}

impl Patience<'_> {
    fn expired(&self) -> Option<Expired> {
        if self.stops.iter().any(|stop| stop.load(Ordering::Relaxed)) {
            Some(Expired::Stopped)
        } else {
            self.until.filter(|until| Instant::now() >= *until).map(|_| Expired::Timeout)
        }
    }

    /// Time until the next look.
    fn tick(&self) -> Duration {
        let left = self.until.map(|until| until.saturating_duration_since(Instant::now()));
        left.map_or(TICK, |left| left.min(TICK))
    }
}

/// A program that was started. Dropped, it is ended.
#[derive(Debug)]
pub(super) struct Running {
    child: Child,
    /// `None` once the program has been told that there is no more input.
    input: Option<Sender<Vec<u8>>>,
    written: Receiver<Written>,
    errors: Arc<Mutex<Vec<u8>>>,
    errors_ended: Receiver<()>,
    /// When its end was seen; its id may belong to another process from then on.
    ended: Option<Instant>,
}

impl Running {
    /// Starts a program, in a process group of its own on Unix, so that it can be ended together with what
    /// it started. Windows has no such groups: there the program alone is ended.
    ///
    /// # Errors
    /// The system does not start it.
    pub(super) fn start(words: &[String], most: usize, answers: Answers) -> io::Result<Self> {
        let (name, arguments) = words.split_first().ok_or(io::ErrorKind::InvalidInput)?;
        let mut command = Command::new(name);
        command.args(arguments);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        set_apart(&mut command);
        let mut running = RUNNING.lock().unwrap_or_else(PoisonError::into_inner);
        let mut child = command.spawn()?;
        running.insert(child.id());
        drop(running);
        let pipes = (child.stdin.take(), child.stdout.take(), child.stderr.take());
        let (input, requests) = mpsc::channel();
        // a program that writes faster than its lines are read waits
        let (write, written) = mpsc::sync_channel(1);
        let (end_errors, errors_ended) = mpsc::channel();
        let errors = Arc::new(Mutex::new(Vec::new()));
        let tail = Arc::clone(&errors);
        let started =
            Self { child, input: Some(input), written, errors, errors_ended, ended: None };
        let (Some(stdin), Some(stdout), Some(stderr)) = pipes else {
            return Err(io::ErrorKind::BrokenPipe.into());
        };
        let spawn = |name: &str, work: Box<dyn FnOnce() + Send>| {
            thread::Builder::new().name(name.to_owned()).spawn(work).map(drop)
        };
        spawn("simulator input", Box::new(move || send(stdin, &requests)))?;
        spawn("simulator output", Box::new(move || receive(stdout, most, answers, &write)))?;
        spawn("simulator errors", Box::new(move || keep_tail(stderr, &tail, end_errors)))?;
        Ok(started)
    }

    /// Gives it a request. A program that reads no input may have ended before.
    pub(super) fn send(&self, request: Vec<u8>) {
        if let Some(input) = &self.input {
            let _ = input.send(request);
        }
    }

    /// Tells it that there are no more requests.
    pub(super) fn end_input(&mut self) {
        self.input = None;
    }

    /// Waits for what it writes. What it has started and left behind may keep its output open: half a second
    /// after its end, this is ended as well.
    pub(super) fn written(&mut self, patience: &Patience<'_>) -> Result<Written, Expired> {
        loop {
            match self.written.recv_timeout(patience.tick()) {
                Ok(written) => return Ok(written),
                Err(RecvTimeoutError::Disconnected) => return Ok(Written::Nothing),
                Err(RecvTimeoutError::Timeout) => {}
            }
            if let Some(expired) = patience.expired() {
                return Err(expired);
            }
            self.try_status();
            match self.ended.map(|ended| ended.elapsed()) {
                Some(since) if since > 2 * GRACE => return Ok(Written::Nothing),
                // the id of a group is not given away while the group has members
                Some(since) if since > GRACE => end_group(self.child.id(), End::Now),
                _ => {}
            }
        }
    }

    /// What it has written that nobody waited for.
    pub(super) fn written_already(&self) -> Option<Written> {
        self.written.try_recv().ok()
    }

    /// Waits for its end.
    pub(super) fn status(&mut self, patience: &Patience<'_>) -> Result<ExitStatus, Expired> {
        let mut pause = Duration::from_micros(200);
        loop {
            if let Some(status) = self.try_status() {
                return Ok(status);
            }
            if let Some(expired) = patience.expired() {
                return Err(expired);
            }
            thread::sleep(pause.min(patience.tick()));
            pause = (2 * pause).min(TICK);
        }
    }

    /// Its status, if it has ended.
    fn try_status(&mut self) -> Option<ExitStatus> {
        // under the lock, so that nobody ends another process that gets its id afterwards
        let mut running = RUNNING.lock().unwrap_or_else(PoisonError::into_inner);
        let status = self.child.try_wait().ok().flatten()?;
        running.remove(&self.child.id());
        self.ended.get_or_insert_with(Instant::now);
        Some(status)
    }

    /// Waits half a second for its end, which that of its input should bring.
    pub(super) fn end_by_itself(&mut self) {
        self.end_input();
        let never = AtomicBool::new(false);
        let until = Some(Instant::now() + GRACE);
        let _ = self.status(&Patience { until, stops: [&never, &never] });
    }

    /// Ends it: it is asked to end, and has half a second for that.
    pub(super) fn end(&mut self) {
        self.end_input();
        if self.ended.is_some() {
            return;
        }
        end_group(self.child.id(), End::Asked);
        // its output ends when it has ended, and what it started as well
        let until = Instant::now() + GRACE;
        let left = || until.saturating_duration_since(Instant::now());
        while self.written.recv_timeout(left()).is_ok() {}
        // until here nobody waited for it, so that its id is still its own
        end_group(self.child.id(), End::Now);
        let _ = self.child.kill();
        while self.try_status().is_none() && until.elapsed() < GRACE {
            thread::sleep(Duration::from_millis(1));
        }
    }

    /// The last lines of its standard error; empty if it wrote none.
    pub(super) fn last_errors(&self) -> String {
        // what it has started may keep the pipe open
        let _ = self.errors_ended.recv_timeout(GRACE);
        let bytes = self.errors.lock().unwrap_or_else(PoisonError::into_inner);
        let text = String::from_utf8_lossy(&bytes);
        let lines: Vec<&str> = text.trim_end().lines().collect();
        let last = &lines[lines.len().saturating_sub(LINES)..];
        let shown = last.iter().map(|line| printable(&line.replace('\t', "    ")));
        shown.collect::<Vec<String>>().join(" | ")
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.end();
    }
}

/// How a program ended, as a part of a sentence; `None` if it succeeded.
pub(super) fn failure(status: ExitStatus) -> Option<String> {
    if status.success() {
        return None;
    }
    #[cfg(unix)]
    if let Some(signal) = std::os::unix::process::ExitStatusExt::signal(&status) {
        let name = nix::sys::signal::Signal::try_from(signal).map_or("", |known| known.as_str());
        return Some(format!("it was ended by signal {signal} ({name})"));
    }
    Some(match status.code() {
        Some(code) => format!("it ended with exit code {code}"),
        None => "it was ended by a signal".to_owned(),
    })
}

/// Writes requests until there are no more, or the program reads no more.
fn send(mut stdin: impl Write, requests: &Receiver<Vec<u8>>) {
    for request in requests {
        if stdin.write_all(&request).and_then(|()| stdin.flush()).is_err() {
            return;
        }
    }
}

/// Reads answers of at most `most` bytes until the output ends.
fn receive(stdout: impl Read, most: usize, answers: Answers, write: &SyncSender<Written>) {
    let mut stdout = BufReader::new(stdout);
    loop {
        let mut answer = Vec::new();
        let read = read_answer(&mut stdout, most, answers, &mut answer);
        let is_end = match answers {
            Answers::Whole => true,
            Answers::Lines => !answer.ends_with(b"\n"),
        };
        let written = if read.is_ok() && answer.len() > most {
            Written::TooMuch(most)
        } else if answers == Answers::Lines && answer.is_empty() {
            return;
        } else if answers == Answers::Lines && !stdout.buffer().is_empty() {
            Written::MoreThanLine
        } else {
            Written::Answer(answer)
        };
        let is_answer = matches!(written, Written::Answer(_));
        if write.send(written).is_err() || is_end && is_answer {
            return;
        }
        if !is_answer {
            // until it is ended: a closed pipe would be another failure
            let _ = io::copy(&mut stdout, &mut io::sink());
            return;
        }
    }
}

/// Reads up to one byte more than `most`.
fn read_answer(
    stdout: &mut impl io::BufRead,
    most: usize,
    answers: Answers,
    answer: &mut Vec<u8>,
) -> io::Result<usize> {
    let mut limited = stdout.take(most as u64 + 1);
    match answers {
        Answers::Whole => limited.read_to_end(answer),
        Answers::Lines => io::BufRead::read_until(&mut limited, b'\n', answer),
    }
}

/// Reads everything, and keeps the end of it.
fn keep_tail(mut stderr: impl Read, tail: &Mutex<Vec<u8>>, end: Sender<()>) {
    let mut block = [0; TAIL];
    while let Ok(count @ 1..) = stderr.read(&mut block) {
        let mut tail = tail.lock().unwrap_or_else(PoisonError::into_inner);
        tail.extend_from_slice(&block[..count]);
        let cut = tail.len().saturating_sub(TAIL);
        tail.drain(..cut);
    }
    drop(end);
}

/// How a program is ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    /// With SIGTERM, which a program can handle.
    Asked,
    /// With SIGKILL.
    Now,
}

/// Starts the program in a group of its own, with the signals that this process waits for.
#[cfg(unix)]
fn set_apart(command: &mut Command) {
    use nix::sys::signal::SigSet;
    use std::os::unix::process::CommandExt;

    command.process_group(0);
    #[allow(unsafe_code)]
    // SAFETY: between fork and exec the closure calls `pthread_sigmask` alone, which is async-signal-safe
    // (POSIX.1-2017, 2.4.3); it neither allocates nor locks. Without it the program and all that it starts
    // would inherit that SIGINT and SIGTERM are blocked.
    unsafe {
        command.pre_exec(|| SigSet::empty().thread_set_mask().map_err(io::Error::from));
    }
}

#[cfg(not(unix))]
fn set_apart(_: &mut Command) {}

/// Sends a signal to a program and to all that it has started in its group.
#[cfg(unix)]
fn end_group(id: u32, end: End) {
    use nix::sys::signal::{Signal, killpg};
    use nix::unistd::Pid;

    let signal = match end {
        End::Asked => Signal::SIGTERM,
        End::Now => Signal::SIGKILL,
    };
    if let Ok(id) = i32::try_from(id) {
        let _ = killpg(Pid::from_raw(id), signal);
    }
}

#[cfg(not(unix))]
fn end_group(_: u32, _: End) {}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;
    use nix::sys::signal::{SigSet, Signal};

    /// Otherwise a program could not end what it starts: this process blocks the signals that it waits for.
    #[test]
    fn a_program_inherits_no_blocked_signals() {
        let mut blocked = SigSet::empty();
        blocked.add(Signal::SIGTERM);
        blocked.thread_block().unwrap();
        let words = ["grep", "SigBlk", "/proc/self/status"].map(str::to_owned);
        let mut running = Running::start(&words, 1000, Answers::Whole).unwrap();
        let never = AtomicBool::new(false);
        let patience = Patience { until: None, stops: [&never, &never] };
        let Written::Answer(found) = running.written(&patience).unwrap() else {
            panic!("no answer")
        };
        assert_eq!(String::from_utf8(found).unwrap(), "SigBlk:\t0000000000000000\n");
        assert!(running.status(&patience).unwrap().success());
    }
}
