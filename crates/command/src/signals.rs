//! Signals that ask the program to end: Ctrl-C, the SIGTERM of schedulers and services, the SIGHUP of
//! a terminal that closes.
//!
//! A command that can hand back what it has asks for a flag: the first signal sets it, and the
//! second ends the process. Without a flag the first one does, but not in the middle of a file that
//! is becoming whole, and not without taking temporary files along.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::surroundings::in_call;

/// What a shell adds to the number of the signal that ended a program.
const BY_SIGNAL: u8 = 128;

/// The number of Ctrl-C's signal.
const INTERRUPT: u8 = 2;

/// What the first signal is to set.
static FLAG: Mutex<Option<Arc<AtomicBool>>> = Mutex::new(None);

/// The number of the first signal; 0 before.
static RECEIVED: AtomicU8 = AtomicU8::new(0);

/// Held while the process must not end.
static WHOLE: Mutex<()> = Mutex::new(());

/// Files and folders that are to be gone in the end.
static TEMPORARY: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn lock<T>(mutex: &'static Mutex<T>) -> MutexGuard<'static, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A flag that the first signal sets; a second one ends the process.
pub(super) fn stop_flag() -> Arc<AtomicBool> {
    if let Some(flag) = in_call(|call| Arc::clone(&call.stop)) {
        return flag;
    }
    let flag = Arc::new(AtomicBool::new(false));
    *lock(&FLAG) = Some(Arc::clone(&flag));
    flag
}

/// The exit code of a command that a signal stopped.
pub(super) fn exit_code() -> u8 {
    match RECEIVED.load(Ordering::Relaxed) {
        0 => BY_SIGNAL + INTERRUPT,
        number => BY_SIGNAL.saturating_add(number),
    }
}

/// While this is held, signals do not end the process.
pub(super) fn whole() -> MutexGuard<'static, ()> {
    lock(&WHOLE)
}

/// A file or folder that goes with the process unless it is forgotten.
#[derive(Debug)]
pub(super) struct Temporary(PathBuf);

impl Temporary {
    pub(super) fn new(path: PathBuf) -> Self {
        lock(&TEMPORARY).push(path.clone());
        Self(path)
    }

    pub(super) fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        remove(&self.0);
        lock(&TEMPORARY).retain(|path| *path != self.0);
    }
}

/// Removes what may be gone already.
fn remove(path: &Path) {
    let _ = if path.is_dir() { std::fs::remove_dir_all(path) } else { std::fs::remove_file(path) };
}

/// What a signal of that number does.
#[cfg(any(unix, windows))]
fn received(number: u8) {
    let _ = RECEIVED.compare_exchange(0, number, Ordering::Relaxed, Ordering::Relaxed);
    if let Some(flag) = &*lock(&FLAG)
        && !flag.swap(true, Ordering::Relaxed)
    {
        return;
    }
    let _whole = whole();
    lock(&TEMPORARY).iter().for_each(|path| remove(path));
    std::process::exit(i32::from(exit_code()));
}

/// Ends the process from whichever thread, which may be the one that keeps it whole: what is becoming
/// whole has a second for it.
pub(super) fn end(code: i32) {
    let free = (0..100).find_map(|_| {
        let free = WHOLE.try_lock().ok();
        if free.is_none() {
            std::thread::sleep(std::time::Duration::from_millis(10));
        }
        free
    });
    if let Ok(temporary) = TEMPORARY.try_lock() {
        temporary.iter().for_each(|path| remove(path));
    }
    drop(free);
    std::process::exit(code);
}

/// Takes over the signals. It must come before any thread is started: threads inherit which signals
/// they leave to the one that waits here.
#[cfg(unix)]
pub(super) fn watch() {
    use nix::sys::signal::{SigSet, Signal};

    // a write beyond a limit of files then fails, and is told (setrlimit(2), RLIMIT_FSIZE)
    let mut unheard = SigSet::empty();
    unheard.add(Signal::SIGXFSZ);
    let _ = unheard.thread_block();
    let mut signals = SigSet::empty();
    signals.add(Signal::SIGINT);
    signals.add(Signal::SIGTERM);
    // `nohup` has it ignored, which is a wish
    if !is_ignored(Signal::SIGHUP as u8) {
        signals.add(Signal::SIGHUP);
    }
    // where they cannot be taken over, they end the process, which is all right as well
    if signals.thread_block().is_err() {
        return;
    }
    let wait = move || {
        while let Ok(signal) = signals.wait() {
            received(signal as u8);
        }
    };
    if std::thread::Builder::new().name("signals".to_owned()).spawn(wait).is_err() {
        let _ = signals.thread_unblock();
    }
}

/// Whether the process was started with a signal ignored, as far as the system tells.
#[cfg(unix)]
fn is_ignored(number: u8) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (number - 1) & 1 == 1)
}

/// There are none to take over.
#[cfg(not(any(unix, windows)))]
pub(super) fn watch() {}

/// Takes over Ctrl-C.
#[cfg(windows)]
pub(super) fn watch() {
    // without a handler Ctrl-C ends the process, which is all right as well
    let _ = ctrlc::set_handler(|| received(INTERRUPT));
}
