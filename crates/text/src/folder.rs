//! Where the files that a file names are looked for, and which of them may be read.
//!
//! A file may come from a stranger, and what it names is quoted in messages, evaluated, and attached
//! to certificates. So it names files below its own folder, or below one that the user allows: on
//! the command line, or by an empty file [`ROOT`] in a folder above, which says that everything
//! below belongs together. Links are followed before that is looked at.

use std::fmt;
use std::path::{Component, Path, PathBuf};

use super::{DiagnosticKind, bytes};

/// A file of this name makes its folder one below which files may name each other.
pub(crate) const ROOT: &str = ".gumption-root";

/// Where the files that a text names come from, for programs that do not leave that to the disk: one
/// that serves a folder and nothing else, or one that has no disk at all.
pub trait FileSource: fmt::Debug + Sync {
    /// The content of the file of this name, as the text has it, of at most so many bytes.
    ///
    /// # Errors
    /// Why there is none, as a sentence for the user, such as `no such file`.
    fn content(&self, name: &str, most: u64) -> Result<Vec<u8>, String>;
}

/// The folder of a file, and which other folders it may name files in.
#[derive(Clone, Copy, Debug)]
pub struct Folder<'a> {
    path: &'a Path,
    /// `None` for all.
    allowed: Option<&'a [PathBuf]>,
    /// Files that are in memory, by their names.
    held: &'a [(String, Vec<u8>)],
    /// What gives the content of all others in place of the disk.
    source: Option<&'a dyn FileSource>,
    /// The folder above which nothing is looked for, whatever stands there.
    within: Option<&'a Path>,
}

impl<'a> Folder<'a> {
    /// A folder whose files may name others below it and below these.
    pub fn new(path: &'a Path, allowed: &'a [PathBuf]) -> Self {
        Self { path, allowed: Some(allowed), held: &[], source: None, within: None }
    }

    /// The same with files that are in memory.
    pub fn holding(self, held: &'a [(String, Vec<u8>)]) -> Self {
        Self { held, ..self }
    }

    /// The same with this in place of the disk.
    pub fn sourced(self, source: Option<&'a dyn FileSource>) -> Self {
        Self { source, ..self }
    }

    /// The same, where a file `.gumption-root` above this folder says nothing.
    pub fn within(self, folder: Option<&'a Path>) -> Self {
        Self { within: folder, ..self }
    }

    /// Whether what is named comes from memory or from a source, and not from the disk.
    pub fn holds(self, name: &str) -> bool {
        self.source.is_some() || self.held(name).is_some()
    }

    /// The content in memory of that name.
    pub(crate) fn held(self, name: &str) -> Option<&'a [u8]> {
        let found = self.held.iter().find(|(held, _)| held == name);
        found.map(|(_, bytes)| bytes.as_slice())
    }

    /// The content of the file of that name, from memory or from the disk, of at most so many bytes.
    ///
    /// # Errors
    /// As [`Folder::file`], or that it cannot be read.
    pub fn content(self, name: &str, most: u64) -> Result<Vec<u8>, DiagnosticKind> {
        if let Some(bytes) = self.held(name) {
            return Ok(bytes.to_owned());
        }
        if let Some(source) = self.source {
            return source.content(name, most).map_err(|message| DiagnosticKind::Unreadable {
                message: format!("`{name}`: {message}"),
            });
        }
        bytes::of_file(&self.file(name)?, most).map_err(|message| DiagnosticKind::Unreadable {
            message: format!("`{name}`: {message}"),
        })
    }

    /// The file of that name as messages call it: from the disk by its path from the current folder, as
    /// the file that names it is called, so that an editor finds it.
    pub fn shown(self, name: &str) -> String {
        if self.holds(name) { name.to_owned() } else { self.path.join(name).display().to_string() }
    }

    /// The current folder, for files that the user names himself.
    pub fn of_the_user() -> Self {
        Self { path: Path::new(""), allowed: None, held: &[], source: None, within: None }
    }

    /// The folder above which nothing is looked for.
    pub fn limit(self) -> Option<&'a Path> {
        self.within
    }

    /// All content in memory.
    pub fn memory(self) -> &'a [(String, Vec<u8>)] {
        self.held
    }

    /// What gives content in place of the disk.
    pub fn source(self) -> Option<&'a dyn FileSource> {
        self.source
    }

    /// Its path.
    pub fn path(self) -> &'a Path {
        self.path
    }

    /// The folders that are allowed beside it.
    pub fn allowed(self) -> &'a [PathBuf] {
        self.allowed.unwrap_or(&[])
    }

    /// The path of the file of that name.
    ///
    /// # Errors
    /// That the file lies outside of what may be read. Whether it exists is not told then.
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
        // as it is written, so that nobody learns what exists elsewhere
        if !is_below(&without_dots(&own.join(name))) {
            return Err(outside());
        }
        match path.canonicalize() {
            Ok(found) if !is_below(&found) => Err(outside()),
            // whoever opens it says that it is not there
            _ => Ok(path),
        }
    }
}

/// The folder with its links followed; as it is written where that cannot be done.
fn canonical(folder: &Path) -> PathBuf {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    folder.canonicalize().unwrap_or_else(|_| folder.to_owned())
}

/// A path without `.` and `..`, by its words alone.
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
        }
        fs::write(at(ROOT), "").unwrap();
        assert!(asked("../secret.csv") && !asked("/etc/passwd"));
        // but not for those who have opened the folder below it and nothing else
        let limited = |name: &str| Folder::new(&own, &[]).within(Some(&own)).file(name).is_ok();
        assert!(limited("a.csv") && !limited("../secret.csv"));
        let all = |name: &str| Folder::new(&own, &[]).within(Some(place.path())).file(name).is_ok();
        assert!(all("../secret.csv"));
    }
}
