//! Saves a file only if the page has seen its present content.
//!
//! Nobody else may write between the comparison and the write: servers on the same folder take
//! turns by a lock that the system releases when a process ends.

use std::fs::File;
use std::io::{self, ErrorKind};
use std::path::Path;
use std::time::{Duration, Instant};

use super::answers::Answers;
use super::folder::{OpenedFolder, Unopened, read, words};
use super::watch::version;

/// How long to wait for another server's lock on the folder.
const PATIENCE: Duration = Duration::from_secs(5);

/// The lock file, on systems that cannot lock a folder.
const LOCK: &str = ".gumption-lock";

/// The longest text that can be saved, in bytes.
pub(crate) const LONGEST: u64 = 16 << 20;

/// The result of saving.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Saved {
    /// It is done.
    Done,
    /// The file has other content than the page has seen; `None` if the file no longer exists.
    Conflict(Option<Vec<u8>>),
}

/// Why a file cannot be saved.
#[derive(Debug)]
pub(crate) enum Unsaved {
    /// The path may not be written.
    Path(Unopened),
    /// The system is at fault.
    System(String),
}

impl From<Unopened> for Unsaved {
    fn from(error: Unopened) -> Self {
        Self::Path(error)
    }
}

/// Replaces the version that the page has seen by a text; `None` if the file must not exist yet.
pub(crate) fn save(
    folder: &OpenedFolder,
    asked: &str,
    text: &str,
    seen: Option<&str>,
    answers: &dyn Answers,
) -> Result<Saved, Unsaved> {
    allowed(folder, asked).map_err(|message| Unsaved::Path(Unopened::Refused(message)))?;
    let failed = |error: io::Error| Unsaved::System(error.to_string());
    let _turn = lock(folder.root()).map_err(failed)?;
    // resolved while the lock is held: another server may have created it
    let path = folder.path(asked)?;
    let there = match read(&path, LONGEST) {
        Ok(content) => Some(content),
        Err(Unopened::Missing) => None,
        Err(error) => return Err(error.into()),
    };
    if there.as_deref().map(version).as_deref() != seen {
        return Ok(Saved::Conflict(there));
    }
    answers.replace(&path, text.as_bytes()).map_err(failed)?;
    Ok(Saved::Done)
}

/// Whether the page may write to a path: no hidden files, since programs obey them, and only files
/// that this program reads.
fn allowed(folder: &OpenedFolder, asked: &str) -> Result<(), String> {
    if words(asked)?.iter().any(|word| word.starts_with('.')) {
        return Err("hidden files are not written".to_owned());
    }
    let is_model = asked.to_ascii_lowercase().ends_with(".json");
    if is_model || folder.named() == Some(asked) {
        return Ok(());
    }
    Err("files that are written have names that end in `.json`".to_owned())
}

/// Locks the folder until the result is dropped.
fn lock(folder: &Path) -> io::Result<File> {
    // no lock file is left behind if the folder itself can be locked
    let own = File::open(folder).and_then(wait);
    match own {
        Err(error) if error.kind() == ErrorKind::TimedOut => Err(error),
        Ok(file) => Ok(file),
        Err(_) => {
            let options = &mut File::options();
            wait(options.write(true).create(true).truncate(false).open(folder.join(LOCK))?)
        }
    }
}

/// Waits for a lock, but not forever.
fn wait(file: File) -> io::Result<File> {
    let until = Instant::now() + PATIENCE;
    loop {
        match file.try_lock() {
            Ok(()) => return Ok(file),
            Err(std::fs::TryLockError::Error(error)) => return Err(error),
            Err(std::fs::TryLockError::WouldBlock) if Instant::now() < until => {
                std::thread::sleep(Duration::from_millis(5));
            }
            Err(std::fs::TryLockError::WouldBlock) => {
                let message = "another program holds the folder locked";
                return Err(io::Error::new(ErrorKind::TimedOut, message));
            }
        }
    }
}
