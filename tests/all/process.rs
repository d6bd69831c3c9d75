//! Programs that tests start, with a limit on every wait: a test that would wait for ever fails.

use std::ffi::OsStr;
use std::io::{self, BufRead, BufReader, Read};
use std::ops::{Deref, DerefMut};
use std::path::Path;
use std::process::{ExitStatus, Output, Stdio};
use std::sync::mpsc;
use std::time::{Duration, Instant};

/// How long a test waits for anything. The longest takes a minute on a slow machine.
pub(crate) const PATIENCE: Duration = Duration::from_secs(600);

/// Waits until something is so.
pub(crate) fn until(what: &str, mut holds: impl FnMut() -> bool) {
    let begun = Instant::now();
    let mut pause = Duration::from_millis(1);
    while !holds() {
        assert!(begun.elapsed() < PATIENCE, "not within {PATIENCE:?}: {what}");
        std::thread::sleep(pause);
        pause = (2 * pause).min(Duration::from_millis(20));
    }
}

/// What a reader gives in a thread of its own, where that may take for ever.
fn in_time<R: Read + Send + 'static, T: Send + 'static>(
    reader: R,
    read: impl FnOnce(R) -> T + Send + 'static,
) -> impl FnOnce() -> T {
    let (give, take) = mpsc::channel();
    std::thread::spawn(move || give.send(read(reader)));
    move || take.recv_timeout(PATIENCE).expect("a program that closes its output")
}

/// The first line that a program writes, and what comes behind it.
pub(crate) fn first_line<R: Read + Send + 'static>(output: R) -> (String, BufReader<R>) {
    let first = in_time(output, |output| {
        let (mut line, mut reader) = (String::new(), BufReader::new(output));
        reader.read_line(&mut line).map(|_| (line, reader))
    });
    first().expect("a line")
}

/// A program to be started, as that of the standard library.
#[derive(Debug)]
pub(crate) struct Command {
    program: std::process::Command,
    /// Whether standard input, output and error are said.
    said: [bool; 3],
}

impl Command {
    pub(crate) fn new(program: impl AsRef<OsStr>) -> Self {
        Self { program: std::process::Command::new(program), said: [false; 3] }
    }

    pub(crate) fn arg(&mut self, argument: impl AsRef<OsStr>) -> &mut Self {
        self.program.arg(argument);
        self
    }

    pub(crate) fn args<A: AsRef<OsStr>>(
        &mut self,
        arguments: impl IntoIterator<Item = A>,
    ) -> &mut Self {
        self.program.args(arguments);
        self
    }

    pub(crate) fn env(&mut self, name: impl AsRef<OsStr>, value: impl AsRef<OsStr>) -> &mut Self {
        self.program.env(name, value);
        self
    }

    pub(crate) fn current_dir(&mut self, folder: impl AsRef<Path>) -> &mut Self {
        self.program.current_dir(folder);
        self
    }

    pub(crate) fn stdin(&mut self, from: impl Into<Stdio>) -> &mut Self {
        self.said[0] = true;
        self.program.stdin(from);
        self
    }

    pub(crate) fn stdout(&mut self, to: impl Into<Stdio>) -> &mut Self {
        self.said[1] = true;
        self.program.stdout(to);
        self
    }

    pub(crate) fn stderr(&mut self, to: impl Into<Stdio>) -> &mut Self {
        self.said[2] = true;
        self.program.stderr(to);
        self
    }

    pub(crate) fn get_program(&self) -> &OsStr {
        self.program.get_program()
    }

    pub(crate) fn spawn(&mut self) -> io::Result<Child> {
        self.program.spawn().map(Child)
    }

    pub(crate) fn status(&mut self) -> io::Result<ExitStatus> {
        self.spawn()?.wait()
    }

    /// Its end and what it writes, without input; where something else is said, that.
    pub(crate) fn output(&mut self) -> io::Result<Output> {
        let said = self.said;
        if !said[0] {
            self.stdin(Stdio::null());
        }
        if !said[1] {
            self.stdout(Stdio::piped());
        }
        if !said[2] {
            self.stderr(Stdio::piped());
        }
        self.spawn()?.wait_with_output()
    }
}

/// A program that runs, as that of the standard library.
#[derive(Debug)]
pub(crate) struct Child(std::process::Child);

impl Child {
    /// Waits for its end.
    pub(crate) fn wait(&mut self) -> io::Result<ExitStatus> {
        drop(self.0.stdin.take());
        let begun = Instant::now();
        let mut pause = Duration::from_micros(500);
        loop {
            if let Some(status) = self.0.try_wait()? {
                return Ok(status);
            }
            if begun.elapsed() > PATIENCE {
                self.0.kill()?;
                self.0.wait()?;
                panic!("a program that did not end within {PATIENCE:?}");
            }
            std::thread::sleep(pause);
            pause = (2 * pause).min(Duration::from_millis(10));
        }
    }

    /// Waits for its end, and gives what it has written to pipes.
    pub(crate) fn wait_with_output(mut self) -> io::Result<Output> {
        fn whole<R: Read + Send + 'static>(pipe: Option<R>) -> impl FnOnce() -> Vec<u8> {
            let read = pipe.map(|pipe| {
                in_time(pipe, |mut pipe| {
                    let mut bytes = Vec::new();
                    pipe.read_to_end(&mut bytes).map(|_| bytes)
                })
            });
            || read.map_or_else(Vec::new, |read| read().expect("what it wrote"))
        }
        let (stdout, stderr) = (whole(self.0.stdout.take()), whole(self.0.stderr.take()));
        let status = self.wait()?;
        Ok(Output { status, stdout: stdout(), stderr: stderr() })
    }
}

impl Deref for Child {
    type Target = std::process::Child;

    fn deref(&self) -> &std::process::Child {
        &self.0
    }
}

impl DerefMut for Child {
    fn deref_mut(&mut self) -> &mut std::process::Child {
        &mut self.0
    }
}

/// Whether this process was started with SIGHUP ignored, as under `nohup`; the programs that it starts
/// inherit that, and heed it.
#[cfg(unix)]
fn hangup_is_ignored() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
        .is_some_and(|mask| mask & 1 == 1)
}

/// Signals that end a program here, with its exit code as shells have it.
#[cfg(unix)]
pub(crate) fn ending(signals: &[(&'static str, i32)]) -> Vec<(&'static str, i32)> {
    let heard = |(name, _): &&(&str, i32)| *name != "-HUP" || !hangup_is_ignored();
    signals.iter().filter(heard).copied().collect()
}

/// The standard library's own programs have no limit.
#[test]
fn no_test_starts_a_program_without_a_limit() {
    let folder = crate::support::root().join("tests/all");
    let mut looked = 0;
    for entry in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let Ok(text) = std::fs::read_to_string(&entry) else { continue };
        looked += 1;
        if entry.ends_with("process.rs") {
            continue;
        }
        let of_std = text.lines().filter(|line| line.contains("std::process"));
        for line in of_std {
            assert!(!line.contains("Command") && !line.contains("Child,"), "{entry:?}: {line}");
        }
    }
    assert!(looked > 50, "{looked}");
}
