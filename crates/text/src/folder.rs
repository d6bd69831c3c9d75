//! Finds the files that a file names, and decides which of them may be read.
//!
//! A file may come from a stranger, and the files that it names are quoted in messages, evaluated,
//! and attached to certificates. Therefore it may name only files below its own folder or below a
//! folder that the user allows. The user allows a folder on the command line, or by an empty file
//! [`ROOT`] in a parent folder, which says that everything below belongs together. Links are
//! resolved before the check.

use std::path::{Component, Path, PathBuf};
use std::{fmt, io};

use super::{DiagnosticKind, bytes};
use gumption_columns::read_failure;

/// In a folder with a file of this name, all files may name each other.
pub(crate) const ROOT: &str = ".gumption-root";

/// A source of the files that a text names, for programs that do not read the disk directly: a
/// server of one folder, or a program without a disk.
pub trait FileSource: fmt::Debug + Sync {
    /// The content of the named file, at most `most` bytes. The name is as written in the text.
    ///
    /// # Errors
    /// Why the file cannot be read, as a sentence for the user, such as `no such file`.
    fn content(&self, name: &str, most: u64) -> Result<Vec<u8>, String>;
}

/// The folder of a file, and the other folders in which it may name files.
#[derive(Clone, Copy, Debug)]
pub struct Folder<'a> {
    path: &'a Path,
    /// `None` for all.
    allowed: Option<&'a [PathBuf]>,
    /// Files in memory, by name.
    held: &'a [(String, Vec<u8>)],
    /// The source of all other files instead of the disk.
    source: Option<&'a dyn FileSource>,
    /// The folder above which no `.gumption-root` is looked for.
    within: Option<&'a Path>,
}

impl<'a> Folder<'a> {
    /// A folder whose files may name other files below it and below the `allowed` folders.
    pub fn new(path: &'a Path, allowed: &'a [PathBuf]) -> Self {
        Self { path, allowed: Some(allowed), held: &[], source: None, within: None }
    }

    /// The same folder with files that are held in memory.
    pub fn holding(self, held: &'a [(String, Vec<u8>)]) -> Self {
        Self { held, ..self }
    }

    /// The same folder with this source instead of the disk.
    pub fn sourced(self, source: Option<&'a dyn FileSource>) -> Self {
        Self { source, ..self }
    }

    /// The same folder, but a file `.gumption-root` above `folder` has no effect.
    pub fn within(self, folder: Option<&'a Path>) -> Self {
        Self { within: folder, ..self }
    }

    /// Whether the named file comes from memory or from a source instead of the disk.
    pub fn holds(self, name: &str) -> bool {
        self.source.is_some() || self.held(name).is_some()
    }

    /// The content of the named file in memory.
    pub(crate) fn held(self, name: &str) -> Option<&'a [u8]> {
        let found = self.held.iter().find(|(held, _)| held == name);
        found.map(|(_, bytes)| bytes.as_slice())
    }

    /// The content of the named file, from memory or from the disk, at most `most` bytes.
    ///
    /// # Errors
    /// The errors of [`Folder::file`], or that the file cannot be read.
    pub fn content(self, name: &str, most: u64) -> Result<Vec<u8>, DiagnosticKind> {
        if let Some(bytes) = self.held(name) {
            return Ok(bytes.to_owned());
        }
        if let Some(source) = self.source {
            return source.content(name, most).map_err(|message| unreadable(name, &message));
        }
        bytes::of_file(&self.file(name)?, most).map_err(|message| unreadable(name, &message))
    }

    /// The path of the named file, which exists on the disk.
    ///
    /// # Errors
    /// The errors of [`Folder::file`], or there is no such file.
    pub fn existing(self, name: &str) -> Result<PathBuf, DiagnosticKind> {
        let path = self.file(name)?;
        match path.metadata() {
            Ok(found) if found.is_dir() => Err(unreadable(name, read_failure::FOLDER)),
            Ok(_) => Ok(path),
            Err(error) => Err(unreadable(name, &read_failure::of_file(&path, &error))),
        }
    }

    /// The name of the file in messages: for a file on disk its path from the current folder, so
    /// that an editor finds it.
    pub fn shown(self, name: &str) -> String {
        if self.holds(name) { name.to_owned() } else { self.path.join(name).display().to_string() }
    }

    /// The current folder, for files that the user names on the command line.
    pub fn of_the_user() -> Self {
        Self { path: Path::new(""), allowed: None, held: &[], source: None, within: None }
    }

    /// The folder above which no `.gumption-root` is looked for.
    pub fn limit(self) -> Option<&'a Path> {
        self.within
    }

    /// All content in memory.
    pub fn memory(self) -> &'a [(String, Vec<u8>)] {
        self.held
    }

    /// The source that replaces the disk.
    pub fn source(self) -> Option<&'a dyn FileSource> {
        self.source
    }

    /// Its path.
    pub fn path(self) -> &'a Path {
        self.path
    }

    /// The other allowed folders.
    pub fn allowed(self) -> &'a [PathBuf] {
        self.allowed.unwrap_or(&[])
    }

    /// The path of the named file.
    ///
    /// # Errors
    /// The file lies outside the folders that may be read. The message does not reveal whether it
    /// exists.
    pub fn file(self, name: &str) -> Result<PathBuf, DiagnosticKind> {
        let path = self.path.join(name);
        let Some(allowed) = self.allowed else { return Ok(path) };
        let outside = || DiagnosticKind::Outside { name: name.to_owned() };
        let own = canonical(self.path);
        let limit = self.within.map(canonical);
        let mut above = own
            .ancestors()
            .take_while(|ancestor| limit.as_ref().is_none_or(|limit| ancestor.starts_with(limit)));
        let root = above.find(|folder| folder.join(ROOT).is_file()).map(Path::to_owned);
        let mut folders = vec![own.clone()];
        folders.extend(root);
        folders.extend(allowed.iter().map(|folder| canonical(folder)));
        let is_below = |path: &Path| folders.iter().any(|folder| path.starts_with(folder));
        // as written, so that the message does not reveal what exists elsewhere
        if !is_below(&without_dots(&own.join(name))) {
            return Err(outside());
        }
        // the caller that opens a missing file reports it, with the names in its folder
        let found = path.canonicalize().or_else(|_| canonical_parent(&path));
        if found.is_ok_and(|found| !is_below(&found)) { Err(outside()) } else { Ok(path) }
    }
}

/// The reason for a named file that cannot be read.
fn unreadable(name: &str, reason: &str) -> DiagnosticKind {
    DiagnosticKind::Unreadable { message: format!("`{name}`: {reason}") }
}

/// The folder of a path with its links resolved, or the nearest folder above it that exists.
fn canonical_parent(path: &Path) -> io::Result<PathBuf> {
    let existing = path.ancestors().skip(1).find(|folder| folder.is_dir());
    existing.unwrap_or(Path::new("")).canonicalize()
}

/// The folder with its links resolved, or as written if that fails.
fn canonical(folder: &Path) -> PathBuf {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    folder.canonicalize().unwrap_or_else(|_| folder.to_owned())
}

/// A path without `.` and `..`, resolved textually.
fn without_dots(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                plain.pop();
            }
            other => plain.push(other),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn files_lie_below_their_own_folder_or_an_allowed_one() {
        let place = tempfile::tempdir().unwrap();
        let at = |name: &str| place.path().join(name);
        for folder in ["own/below", "other"] {
            fs::create_dir_all(at(folder)).unwrap();
        }
        for file in ["own/a.csv", "own/below/b.csv", "other/c.csv", "secret.csv"] {
            fs::write(at(file), "1").unwrap();
        }
        let own = at("own");
        let asked = |name: &str| Folder::new(&own, &[]).file(name).is_ok();
        for inside in ["a.csv", "./a.csv", "below/b.csv", "below/../a.csv", "../own/a.csv", "no"] {
            assert!(asked(inside), "{inside}");
        }
        let absolute = at("own/a.csv").canonicalize().unwrap();
        assert!(asked(absolute.to_str().unwrap()));
        for outside in [
            "../secret.csv",
            "../other/c.csv",
            "../no",
            "below/../../secret.csv",
            "/etc/passwd",
            "..",
        ] {
            assert!(!asked(outside), "{outside}");
        }
        let allowed = [at("other")];
        let asked = |name: &str| Folder::new(&own, &allowed).file(name).is_ok();
        assert!(asked("../other/c.csv") && asked("a.csv") && !asked("../secret.csv"));
        assert!(Folder::of_the_user().file("/etc/passwd").is_ok());
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(at("secret.csv"), at("own/link.csv")).unwrap();
            std::os::unix::fs::symlink(at("own/a.csv"), at("own/near.csv")).unwrap();
            assert!(!asked("link.csv") && asked("near.csv"));
            // nor does a linked folder reveal its names
            std::os::unix::fs::symlink(place.path(), at("own/linked")).unwrap();
            assert!(!asked("linked/secret.csv") && !asked("linked/none.csv"));
        }
        fs::write(at(ROOT), "").unwrap();
        assert!(asked("../secret.csv") && !asked("/etc/passwd"));
        // but not if only the folder below it was opened
        let limited = |name: &str| Folder::new(&own, &[]).within(Some(&own)).file(name).is_ok();
        assert!(limited("a.csv") && !limited("../secret.csv"));
        let all = |name: &str| Folder::new(&own, &[]).within(Some(place.path())).file(name).is_ok();
        assert!(all("../secret.csv"));
    }
}
