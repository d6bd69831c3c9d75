//! The opened folder, and the paths of requests that lead to files in it.
//!
//! A path of a request is words between `/`, the same on every system. It is checked as written,
//! and again with its links resolved.

use std::fmt;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

/// In a folder with a file of this name, all files may name each other, as for the command line.
pub(crate) const ROOT: &str = ".gumption-root";

/// The longest path of a request, in bytes.
const LONGEST: usize = 1024;

/// Names of devices that Windows has in every folder, with any extension.
const DEVICES: [&str; 6] = ["con", "prn", "aux", "nul", "conin$", "conout$"];

/// Why a path does not lead to a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unopened {
    /// The path leads, or could lead, out of the folder.
    Refused(String),
    /// Nothing is there.
    Missing,
    /// It cannot be read.
    Unreadable(String),
}

impl fmt::Display for Unopened {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refused(message) | Self::Unreadable(message) => f.write_str(message),
            Self::Missing => f.write_str("there is no such file"),
        }
    }
}

/// The folder whose files the page may read and write.
#[derive(Clone, Debug)]
pub struct OpenedFolder {
    /// Links followed.
    root: PathBuf,
    /// The file named on the command line, as a path of a request.
    named: Option<String>,
}

impl OpenedFolder {
    /// Opens a folder. For a file, which is then shown first, it is the file's own folder, or the
    /// nearest parent folder with a file `.gumption-root`, below which files may name each other.
    ///
    /// # Errors
    /// Nothing exists at the path, or neither a file nor a folder; or no request can express the
    /// file's name.
    pub fn new(path: &Path) -> io::Result<Self> {
        let found = path.canonicalize()?;
        if found.is_dir() {
            return Ok(Self { root: found, named: None });
        }
        if !found.is_file() {
            let message = "it is neither a file nor a folder";
            return Err(io::Error::new(ErrorKind::InvalidInput, message));
        }
        // a link stands for its file's own folder, whose other files the model may name
        let invalid = |message: &str| io::Error::new(ErrorKind::InvalidInput, message.to_owned());
        let Some(own) = found.parent() else { return Err(invalid("it is in no folder")) };
        let root = own.ancestors().find(|folder| folder.join(ROOT).is_file()).unwrap_or(own);
        let below = found.strip_prefix(root).unwrap_or(&found);
        let names: Option<Vec<&str>> = below.iter().map(|word| word.to_str()).collect();
        let name = names.ok_or_else(|| invalid("its name is not UTF-8"))?.join("/");
        words(&name).map_err(|message| invalid(&message))?;
        Ok(Self { root: root.to_owned(), named: Some(name) })
    }

    /// The folder, links followed.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// The file named on the command line.
    pub fn named(&self) -> Option<&str> {
        self.named.as_deref()
    }

    /// The folder's name.
    pub fn name(&self) -> String {
        let name = self.root.file_name().unwrap_or(self.root.as_os_str());
        name.to_string_lossy().into_owned()
    }

    /// The disk path for a path of a request, whether or not something exists there.
    ///
    /// # Errors
    /// The path leads out of the folder.
    pub fn path(&self, asked: &str) -> Result<PathBuf, Unopened> {
        let words = words(asked).map_err(Unopened::Refused)?;
        let path = words.iter().fold(self.root.clone(), |path, word| path.join(word));
        let outside =
            || Unopened::Refused("it is a link that leads out of the opened folder".to_owned());
        match path.canonicalize() {
            Ok(found) if found.starts_with(&self.root) => Ok(found),
            Ok(_) => Err(outside()),
            Err(_) => {
                // a link that leads nowhere now may lead anywhere later
                if path.symlink_metadata().is_ok_and(|found| found.is_symlink()) {
                    return Err(outside());
                }
                // the folder of a new file must exist
                let folder = path.parent().unwrap_or(&self.root);
                match folder.canonicalize() {
                    Ok(found) if !found.starts_with(&self.root) => Err(outside()),
                    Ok(found) => Ok(words.last().map_or(found.clone(), |name| found.join(name))),
                    Err(_) => Err(Unopened::Missing),
                }
            }
        }
    }

    /// The content of a file, at most `most` bytes.
    ///
    /// # Errors
    /// The path leads out of the folder or to nothing, or the file is not a file, is too long, or
    /// cannot be read.
    pub fn content(&self, asked: &str, most: u64) -> Result<Vec<u8>, Unopened> {
        read(&self.path(asked)?, most)
    }
}

/// The content of a file at a checked path.
pub(crate) fn read(path: &Path, most: u64) -> Result<Vec<u8>, Unopened> {
    let failed = |error: io::Error| match error.kind() {
        ErrorKind::NotFound => Unopened::Missing,
        _ => Unopened::Unreadable(format!("it cannot be read: {error}")),
    };
    // opening a pipe would wait for a writer
    if !fs::metadata(path).map_err(failed)?.is_file() {
        return Err(Unopened::Unreadable("it is not a file".to_owned()));
    }
    let mut content = Vec::new();
    let file = File::open(path).map_err(failed)?;
    file.take(most.saturating_add(1)).read_to_end(&mut content).map_err(failed)?;
    if content.len() as u64 > most {
        return Err(Unopened::Unreadable(format!("it is longer than {most} bytes")));
    }
    Ok(content)
}

/// The words of a path of a request.
///
/// # Errors
/// A description of the problem.
pub(crate) fn words(asked: &str) -> Result<Vec<&str>, String> {
    if asked.is_empty() || asked.len() > LONGEST {
        return Err(format!("a path of 1 to {LONGEST} bytes is needed"));
    }
    asked.split('/').map(|word| name(word).map(|()| word)).collect()
}

/// Whether a word is a name that means the same file on every system.
fn name(word: &str) -> Result<(), String> {
    let refuse = |reason: &str| Err(format!("`{}` {reason}", word.escape_debug()));
    if word.is_empty() || word == "." || word == ".." {
        return refuse("in a path is not a name: the path must be relative, without `.` and `..`");
    }
    if word.chars().any(|c| c.is_control() || "\\:*?\"<>|".contains(c)) {
        return refuse("is no name: one of `\\ : * ? \" < > |` or a control character is in it");
    }
    if word.ends_with([' ', '.']) {
        return refuse("is no name: it ends with a space or a full stop");
    }
    let stem = word.split('.').next().unwrap_or(word).trim_end().to_ascii_lowercase();
    let numbered = ["com", "lpt"]
        .iter()
        .any(|device| stem.strip_prefix(device).is_some_and(|number| number.chars().count() == 1));
    if numbered || DEVICES.contains(&stem.as_str()) {
        return refuse("is the name of a device");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_lead_elsewhere_are_refused() {
        for wrong in [
            "",
            "/",
            "/etc/passwd",
            "..",
            "../a",
            "a/../b",
            "a//b",
            "./a",
            "a/.",
            "a\\b",
            "C:a",
            "C:/a",
            "\\\\host\\share",
            "a\0b",
            "a\nb",
            "NUL",
            "nul.json",
            "com1",
            "LPT9.txt",
            "a ",
            "a.",
            "con .json",
            "a.json::$DATA",
        ] {
            assert!(words(wrong).is_err(), "{wrong:?}");
        }
        assert!(words(&"a".repeat(LONGEST + 1)).is_err());
        for right in ["a", "a.json", "b/c d/e.csv", "Größe µ.json", "..a", "common.json", "com10"]
        {
            assert!(words(right).is_ok(), "{right:?}");
        }
    }

    #[test]
    fn only_files_below_the_folder_are_read() {
        let place = tempfile::tempdir().unwrap();
        let at = |name: &str| place.path().join(name);
        fs::create_dir_all(at("own/below")).unwrap();
        for file in ["own/a.json", "own/below/b.csv", "secret"] {
            fs::write(at(file), "12345").unwrap();
        }
        let folder = OpenedFolder::new(&at("own")).unwrap();
        let content = |asked: &str| folder.content(asked, 5);
        assert_eq!(content("a.json").unwrap(), b"12345");
        assert_eq!(content("below/b.csv").unwrap(), b"12345");
        assert_eq!(content("no.json"), Err(Unopened::Missing));
        assert_eq!(content("no/no.json"), Err(Unopened::Missing));
        assert!(matches!(content("below"), Err(Unopened::Unreadable(_))));
        assert!(matches!(content("../secret"), Err(Unopened::Refused(_))));
        assert!(matches!(folder.content("a.json", 4), Err(Unopened::Unreadable(_))));
        #[cfg(unix)]
        {
            use std::os::unix::fs::symlink;
            symlink(at("secret"), at("own/link")).unwrap();
            symlink(place.path(), at("own/up")).unwrap();
            symlink(at("nothing"), at("own/dangling")).unwrap();
            symlink(at("own/a.json"), at("own/near")).unwrap();
            for outside in ["link", "up/secret", "up/new", "dangling"] {
                assert!(matches!(folder.path(outside), Err(Unopened::Refused(_))), "{outside}");
            }
            assert_eq!(content("near").unwrap(), b"12345");
        }
    }

    #[test]
    fn a_file_opens_its_folder() {
        let place = tempfile::tempdir().unwrap();
        let file = place.path().join("m.json");
        fs::write(&file, "{}").unwrap();
        let folder = OpenedFolder::new(&file).unwrap();
        assert_eq!(folder.named(), Some("m.json"));
        assert_eq!(folder.root(), place.path().canonicalize().unwrap());
        assert!(OpenedFolder::new(&place.path().join("no")).is_err());
        // files that belong together are opened together, but only through one of these files
        fs::create_dir(place.path().join("below")).unwrap();
        let below = place.path().join("below").join("n.json");
        fs::write(&below, "{}").unwrap();
        fs::write(place.path().join(ROOT), "").unwrap();
        let folder = OpenedFolder::new(&below).unwrap();
        assert_eq!(folder.named(), Some("below/n.json"));
        assert_eq!(folder.root(), place.path().canonicalize().unwrap());
        let folder = OpenedFolder::new(&place.path().join("below")).unwrap();
        assert!(folder.root().ends_with("below"));
    }
}
