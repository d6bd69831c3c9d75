//! Signals that ask the program to end: Ctrl-C, the SIGTERM of schedulers and services, the SIGHUP of
//! a terminal that closes.
//!
//! A command that can return partial results requests a flag: the first signal sets it, and the
//! second ends the process. Without a flag the first signal ends the process, but not while a file
//! is being completed, and only after removing temporary files.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::simulator;
use super::surroundings::in_call;

/// A shell adds this to the number of the signal that ended a program.
const BY_SIGNAL: u8 = 128;

/// The number of Ctrl-C's signal.
const INTERRUPT: u8 = 2;

/// The flag that the first signal sets.
static FLAG: Mutex<Option<Arc<AtomicBool>>> = Mutex::new(None);

/// The number of the first signal; 0 before it.
static RECEIVED: AtomicU8 = AtomicU8::new(0);

/// Held while the process must not end.
static WHOLE: Mutex<()> = Mutex::new(());

/// Files and folders to remove at the end.
static TEMPORARY: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn lock<T>(mutex: &'static Mutex<T>) -> MutexGuard<'static, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A flag that the first signal sets; the second ends the process.
pub(super) fn stop_flag() -> Arc<AtomicBool> {
    if let Some(flag) = in_call(|call| Arc::clone(&call.stop)) {
        return flag;
    }
    let flag = Arc::new(AtomicBool::new(false));
    *lock(&FLAG) = Some(Arc::clone(&flag));
    flag
}

/// The exit code of a command stopped by a signal.
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

/// A file or folder that is removed when the process ends, unless it is kept.
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

/// Removes a file or folder, which may no longer exist.
fn remove(path: &Path) {
    let _ = if path.is_dir() { std::fs::remove_dir_all(path) } else { std::fs::remove_file(path) };
}

/// Handles a signal with this number.
#[cfg(any(unix, windows))]
fn received(number: u8) {
    let _ = RECEIVED.compare_exchange(0, number, Ordering::Relaxed, Ordering::Relaxed);
    if let Some(flag) = &*lock(&FLAG)
        && !flag.swap(true, Ordering::Relaxed)
    {
        return;
    }
    let _whole = whole();
    simulator::end_all();
    lock(&TEMPORARY).iter().for_each(|path| remove(path));
    std::process::exit(i32::from(exit_code()));
}

/// Ends the process from any thread, possibly the one that holds the lock: a file that is being
/// completed gets one second.
pub(super) fn end(code: i32) {
    let free = (0..100).find_map(|_| {
        let free = WHOLE.try_lock().ok();
        if free.is_none() {
            std::thread::sleep(std::time::Duration::from_millis(10));
        }
        free
    });
    simulator::end_all();
    if let Ok(temporary) = TEMPORARY.try_lock() {
        temporary.iter().for_each(|path| remove(path));
    }
    drop(free);
    std::process::exit(code);
}

/// Installs the signal handling. It must run before any thread is started: threads inherit which
/// signals they leave to the thread that waits here.
#[cfg(unix)]
pub(super) fn watch() {
    use nix::sys::signal::{SigSet, Signal};

    // a write beyond a file size limit then fails and is reported (setrlimit(2), RLIMIT_FSIZE)
    let mut unheard = SigSet::empty();
    unheard.add(Signal::SIGXFSZ);
    let _ = unheard.thread_block();
    let mut signals = SigSet::empty();
    signals.add(Signal::SIGINT);
    signals.add(Signal::SIGTERM);
    // with `nohup` it is ignored on purpose
    if !is_ignored(Signal::SIGHUP as u8) {
        signals.add(Signal::SIGHUP);
    }
    // without handlers, signals end the process, which is acceptable
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

/// Whether the process was started with a signal ignored, if the system tells.
#[cfg(unix)]
fn is_ignored(number: u8) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (number - 1) & 1 == 1)
}

/// There are no signals to handle.
#[cfg(not(any(unix, windows)))]
pub(super) fn watch() {}

/// Takes over Ctrl-C.
#[cfg(windows)]
pub(super) fn watch() {
    // without a handler Ctrl-C ends the process, which is acceptable
    let _ = ctrlc::set_handler(|| received(INTERRUPT));
}
