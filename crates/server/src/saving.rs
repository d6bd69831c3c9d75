//! A file is saved only over what the page has seen of it.
//!
//! Between looking and writing nobody else may write: servers on the same folder take turns by a lock
//! that the system gives up when its process ends.

use std::fs::File;
use std::io::{self, ErrorKind};
use std::path::Path;
use std::time::{Duration, Instant};

use super::answers::Answers;
use super::folder::{OpenedFolder, Unopened, read, words};
use super::watch::version;

/// How long another server may take with the folder.
const PATIENCE: Duration = Duration::from_secs(5);

/// Where the lock is held on systems on which a folder cannot be locked itself.
const LOCK: &str = ".gumption-lock";

/// The longest text that is saved, in bytes.
pub(crate) const LONGEST: u64 = 16 << 20;

/// What came of a wish to save.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Saved {
    /// It is done.
    Done,
    /// Another content is there than the page has seen; `None` where the file is gone.
    Conflict(Option<Vec<u8>>),
}

/// Why a file cannot be saved.
#[derive(Debug)]
pub(crate) enum Unsaved {
    /// The path is not one to be written.
    Path(Unopened),
    /// The system is at fault.
    System(String),
}

impl From<Unopened> for Unsaved {
    fn from(error: Unopened) -> Self {
        Self::Path(error)
    }
}

/// Puts a text in place of the version that the page has seen; `None` where it has seen none, as no
/// file is to be there.
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
    // followed while the lock is held: the other server may have made it
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

/// Whether a path is one of a file that the page writes: nothing hidden, since programs do what
/// hidden files say, and nothing but what this program reads.
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

/// Holds the folder until it is dropped.
fn lock(folder: &Path) -> io::Result<File> {
    // no file is left behind where the folder itself can be held
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

/// Waits for a lock, but not for ever.
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
