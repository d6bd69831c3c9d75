//! Which files of the folder change on the disk.
//!
//! They are looked at twice a second while somebody listens. That works on every system and file
//! system, also for files on another machine, for which no system tells changes.

use std::collections::VecDeque;
use std::fs;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, SystemTime};

use serde::Serialize;
use sha2::{Digest, Sha256};
use tokio::sync::broadcast;

use super::folder::OpenedFolder;
use super::token::hexadecimal;

/// How often the files are looked at.
pub(crate) const EVERY: Duration = Duration::from_millis(500);

/// Files that are watched, at most; the one longest not asked for goes.
const MOST: usize = 64;

/// Changes that wait for a slow listener, at most.
const WAITING: usize = 64;

/// The longest file whose content is compared, in bytes.
const LONGEST: u64 = 64 << 20;

/// What a content is told apart by.
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

/// What the file system says of a file.
type Stamp = Option<(Option<SystemTime>, u64)>;

#[derive(Debug)]
struct Watched {
    path: String,
    stamp: Stamp,
    version: Option<String>,
}

/// The files that the page has to do with.
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

    /// How many listen.
    pub(crate) fn listeners(&self) -> usize {
        self.listeners.receiver_count()
    }

    /// Watches a file that has, or had a moment ago, this content.
    pub(crate) fn add(&self, path: &str, content: &[u8]) {
        // changed in between, it has a stamp of its own, and is looked at again
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

    /// Looks at all files, and tells what changed.
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
                // nobody listens any more: nobody misses it
                let _ = self.listeners.send(Change { path, version: now });
            }
        }
    }

    /// Tells at once what this server has written itself.
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
