//! Detects files of the folder that change on the disk.
//!
//! The files are examined twice a second while a client listens. That works on every system and
//! file system, also for files on another machine, for which no system reports changes.

use std::collections::VecDeque;
use std::fs;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, SystemTime};

use serde::Serialize;
use sha2::{Digest, Sha256};
use tokio::sync::broadcast;

use super::folder::OpenedFolder;
use super::token::hexadecimal;

/// How often the files are examined.
pub(crate) const EVERY: Duration = Duration::from_millis(500);

/// Maximum number of watched files; beyond it the one requested longest ago is dropped.
const MOST: usize = 64;

/// Maximum number of changes that wait for a slow listener.
const WAITING: usize = 64;

/// The longest file whose content is compared, in bytes.
const LONGEST: u64 = 64 << 20;

/// A digest that identifies a content.
pub(crate) fn version(content: &[u8]) -> String {
    let digest = Sha256::digest(content);
    hexadecimal(&digest[..16])
}

/// A change of a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(crate) struct Change {
    pub(crate) path: String,
    /// `None` where it is gone.
    pub(crate) version: Option<String>,
}

/// The time stamp and size of a file in the file system.
type Stamp = Option<(Option<SystemTime>, u64)>;

#[derive(Debug)]
struct Watched {
    path: String,
    stamp: Stamp,
    version: Option<String>,
}

/// The files that the page uses.
#[derive(Debug)]
pub(crate) struct Watch {
    folder: OpenedFolder,
    files: Mutex<VecDeque<Watched>>,
    listeners: broadcast::Sender<Change>,
}

impl Watch {
    pub(crate) fn new(folder: OpenedFolder) -> Self {
        Self { folder, files: Mutex::default(), listeners: broadcast::Sender::new(WAITING) }
    }

    fn files(&self) -> MutexGuard<'_, VecDeque<Watched>> {
        self.files.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What happens from now on.
    pub(crate) fn listen(&self) -> broadcast::Receiver<Change> {
        self.listeners.subscribe()
    }

    /// The number of listeners.
    pub(crate) fn listeners(&self) -> usize {
        self.listeners.receiver_count()
    }

    /// Watches a file that has, or had a moment ago, this content.
    pub(crate) fn add(&self, path: &str, content: &[u8]) {
        // changed meanwhile, it has another stamp and is compared again
        let stamp = self.stamp(path).filter(|(_, length)| *length == content.len() as u64);
        let new = Watched { path: path.to_owned(), stamp, version: Some(version(content)) };
        let mut files = self.files();
        files.retain(|of| of.path != new.path);
        files.push_back(new);
        if files.len() > MOST {
            files.pop_front();
        }
    }

    fn stamp(&self, path: &str) -> Stamp {
        let found = fs::metadata(self.folder.path(path).ok()?).ok()?;
        Some((found.modified().ok(), found.len()))
    }

    /// Examines all files, and reports what changed.
    pub(crate) fn look(&self) {
        let known: Vec<(String, Stamp)> =
            self.files().iter().map(|of| (of.path.clone(), of.stamp)).collect();
        for (path, before) in known {
            let stamp = self.stamp(&path);
            if stamp == before {
                continue;
            }
            let now = self.folder.content(&path, LONGEST).ok().map(|content| version(&content));
            let mut files = self.files();
            let Some(of) = files.iter_mut().find(|of| of.path == path) else { continue };
            of.stamp = stamp;
            if of.version != now {
                of.version.clone_from(&now);
                drop(files);
                // without listeners nobody misses it
                let _ = self.listeners.send(Change { path, version: now });
            }
        }
    }

    /// Reports at once what this server has written itself.
    pub(crate) fn written(&self, path: &str, content: &[u8]) {
        self.add(path, content);
        let _ =
            self.listeners.send(Change { path: path.to_owned(), version: Some(version(content)) });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_told_once() {
        let place = tempfile::tempdir().unwrap();
        let file = place.path().join("m.json");
        fs::write(&file, "1").unwrap();
        let watch = Watch::new(OpenedFolder::new(place.path()).unwrap());
        let mut heard = watch.listen();
        watch.add("m.json", b"1");
        watch.look();
        assert!(heard.try_recv().is_err());
        fs::write(&file, "22").unwrap();
        watch.look();
        watch.look();
        let told = Change { path: "m.json".to_owned(), version: Some(version(b"22")) };
        assert_eq!(heard.try_recv().unwrap(), told);
        assert!(heard.try_recv().is_err());
        fs::remove_file(&file).unwrap();
        watch.look();
        assert_eq!(heard.try_recv().unwrap().version, None);
        for number in 0..2 * MOST {
            watch.add(&number.to_string(), b"");
        }
        assert_eq!(watch.files().len(), MOST);
    }
}
