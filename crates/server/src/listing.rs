//! The files of the opened folder.

use std::fs;
use std::path::Path;
use std::time::UNIX_EPOCH;

use serde::Serialize;

use super::answers::Answers;
use super::folder::{OpenedFolder, ROOT, read, words};

/// Maximum depth of folders that are listed.
const DEEPEST: usize = 5;

/// Maximum number of listed files.
const MOST: usize = 2000;

/// Maximum number of folder entries that are examined: a home folder may hold millions.
const MOST_SEEN: usize = 50_000;

/// The longest file whose content is examined, in bytes.
const LONGEST: u64 = 5 << 20;

/// The files of the folder for the page.
#[derive(Debug, Serialize)]
pub(crate) struct Listing {
    root: String,
    files: Vec<Listed>,
    open: Option<String>,
    /// Whether there are more files than the limit.
    more: bool,
}

#[derive(Debug, Serialize)]
struct Listed {
    path: String,
    kind: &'static str,
    /// When it was changed, in seconds since 1970; 0 if the system does not say.
    modified: u64,
    title: Option<String>,
}

/// Whether the page can use a file, by its extension.
fn is_wanted(name: &str) -> bool {
    matches!(extension(name).as_deref(), Some("json" | "csv" | "xlsx" | "xml")) || is_picture(name)
}

/// Whether a file is a picture as a letterhead may have it, by its extension.
fn is_picture(name: &str) -> bool {
    matches!(extension(name).as_deref(), Some("png" | "svg"))
}

fn extension(name: &str) -> Option<String> {
    name.rsplit_once('.').map(|(_, of)| of.to_ascii_lowercase())
}

/// How deep a folder is listed.
fn depth(folder: &OpenedFolder) -> usize {
    let is_whole = folder.named().is_none() || folder.root().join(ROOT).is_file();
    if is_whole { DEEPEST } else { 0 }
}

/// The files below the folder; only those directly in it if a file was opened whose folder does not
/// say that files below it belong together.
pub(crate) fn listing(folder: &OpenedFolder, answers: &dyn Answers) -> Listing {
    let mut found = FoundPaths { paths: Vec::new(), seen: 0, more: false };
    found.look_into(folder.root(), "", depth(folder));
    let described = |path: String| {
        let modified = modified(&folder.root().join(&path));
        if is_picture(&path) {
            return Listed { path, kind: "picture", modified, title: None };
        }
        // unreadable files are listed too: opening them gives the reason
        let content = folder.path(&path).and_then(|path| read(&path, LONGEST));
        let (kind, title) = match content {
            Ok(content) => {
                let of = answers.describe(&path, &content);
                (of.kind, of.title)
            }
            Err(_) => ("other", None),
        };
        Listed { path, kind, modified, title }
    };
    Listing {
        root: folder.name(),
        files: found.paths.into_iter().map(described).collect(),
        open: folder.named().map(str::to_owned),
        more: found.more,
    }
}

/// When a file was changed, in seconds since 1970.
fn modified(path: &Path) -> u64 {
    let time = fs::metadata(path).and_then(|of| of.modified()).ok();
    time.and_then(|time| time.duration_since(UNIX_EPOCH).ok()).map_or(0, |since| since.as_secs())
}

struct FoundPaths {
    paths: Vec<String>,
    seen: usize,
    more: bool,
}

impl FoundPaths {
    fn look_into(&mut self, folder: &Path, prefix: &str, depth: usize) {
        let Ok(entries) = fs::read_dir(folder) else { return };
        let mut entries: Vec<_> = entries.take(MOST_SEEN).flatten().collect();
        entries.sort_by_key(fs::DirEntry::file_name);
        let mut folders = Vec::new();
        for entry in entries {
            self.seen += 1;
            if self.seen > MOST_SEEN || self.paths.len() >= MOST {
                self.more = true;
                return;
            }
            let name = entry.file_name();
            // the page cannot use names that no request can express
            let Some(name) = name.to_str().filter(|name| words(name).is_ok()) else { continue };
            if name.starts_with('.') {
                continue;
            }
            let Ok(kind) = entry.file_type() else { continue };
            // links to folders may form a cycle
            if kind.is_dir() {
                folders.push(name.to_owned());
            } else if is_wanted(name) {
                self.paths.push(format!("{prefix}{name}"));
            }
        }
        for name in folders.into_iter().filter(|_| depth > 0) {
            self.look_into(&folder.join(&name), &format!("{prefix}{name}/"), depth - 1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_that_belongs_together_is_listed_whole() {
        let place = tempfile::tempdir().unwrap();
        fs::create_dir(place.path().join("below")).unwrap();
        for file in ["m.json", "logo.svg", "below/Mark.PNG", "below/n.json", "x.jpg"] {
            fs::write(place.path().join(file), "{}").unwrap();
        }
        let paths = |opened: &str| {
            let folder = OpenedFolder::new(&place.path().join(opened)).unwrap();
            let mut found = FoundPaths { paths: Vec::new(), seen: 0, more: false };
            found.look_into(folder.root(), "", depth(&folder));
            found.paths
        };
        let all = ["logo.svg", "m.json", "below/Mark.PNG", "below/n.json"];
        assert_eq!(paths(""), all);
        assert_eq!(paths("m.json"), all[..2]);
        fs::write(place.path().join(ROOT), "").unwrap();
        assert_eq!(paths("m.json"), all);
        assert!(is_picture("below/Mark.PNG") && !is_picture("m.json"));
    }
}
