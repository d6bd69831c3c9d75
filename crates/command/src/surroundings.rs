//! The surroundings of a command: the destinations of its answer and notes, the stop flag, and
//! standard input.
//!
//! In a program these are the process's own streams and signals. A program that calls the command
//! line as a function ([`CommandLine::call`](super::CommandLine::call)) has them in memory instead,
//! for the thread of the call: commands compute on many threads, but read and write on one.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A model file that replaces standard input (`-`) in a call.
#[derive(Clone, Debug, Default)]
pub struct GivenFile {
    /// Its name in messages.
    pub name: String,
    /// Its text.
    pub text: String,
    /// The folder that contains the files it names.
    pub folder: std::path::PathBuf,
    /// The folder above which nothing is looked for, even if a `.gumption-root` allows it.
    pub within: Option<std::path::PathBuf>,
    /// Files in memory that it may name, by name.
    pub held: Vec<(String, Vec<u8>)>,
}

/// Replacements of the process's streams and signals.
#[derive(Debug, Default)]
pub(super) struct Surroundings {
    pub(super) answer: Vec<u8>,
    pub(super) notes: String,
    pub(super) stop: Arc<AtomicBool>,
    pub(super) input: Option<Arc<GivenFile>>,
}

thread_local! {
    static CALL: RefCell<Option<Surroundings>> = const { RefCell::new(None) };
}

/// Uses the surroundings of a call; `None` if the process's own are to be used.
pub(super) fn in_call<R>(work: impl FnOnce(&mut Surroundings) -> R) -> Option<R> {
    CALL.with_borrow_mut(|call| call.as_mut().map(work))
}

/// Runs `work` in these surroundings, and returns them afterwards.
pub(super) fn within<R>(given: Surroundings, work: impl FnOnce() -> R) -> (R, Surroundings) {
    /// Leaves the surroundings even if `work` panics.
    struct Leave(Option<Surroundings>);
    impl Drop for Leave {
        fn drop(&mut self) {
            CALL.set(self.0.take());
        }
    }
    let leave = Leave(CALL.replace(Some(given)));
    let result = work();
    let left = CALL.take().unwrap_or_default();
    drop(leave);
    (result, left)
}
