//! Why a file or a folder cannot be read, in the words of messages.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::Path;

use gumption_units::{all_nearest, listed};

/// The reason for a folder instead of a file.
pub const FOLDER: &str = "it is a folder; name a file in it";

/// Maximum number of names in a folder that are compared.
const MOST_NAMES: usize = 10_000;

/// What a path should lead to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wanted {
    File,
    Folder,
}

impl Wanted {
    /// Whether the path leads to one.
    fn is_at(self, path: &Path) -> bool {
        match self {
            Self::File => path.is_file(),
            Self::Folder => path.is_dir(),
        }
    }
}

/// Why the file cannot be read or written, as a part of a sentence: for a missing file with the
/// nearest names in its folder.
pub fn of_file(path: &Path, error: &io::Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => missing(path, Wanted::File),
        _ => in_words(error),
    }
}

/// As [`of_file`], for a folder.
pub fn of_folder(path: &Path, error: &io::Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => missing(path, Wanted::Folder),
        ErrorKind::NotADirectory => "it is not a folder".to_owned(),
        _ => in_words(error),
    }
}

/// An error of the system without its number, as a part of a sentence.
pub fn in_words(error: &io::Error) -> String {
    // an error of this program is in words
    if error.get_ref().is_some() {
        return error.to_string();
    }
    match error.kind() {
        ErrorKind::NotFound => "there is no such file".to_owned(),
        ErrorKind::PermissionDenied => "the system denies access to it".to_owned(),
        ErrorKind::IsADirectory => FOLDER.to_owned(),
        ErrorKind::NotADirectory => "a part of its path is a file, not a folder".to_owned(),
        ErrorKind::InvalidFilename => "the system allows no such name".to_owned(),
        ErrorKind::StorageFull => "the disk is full".to_owned(),
        ErrorKind::ReadOnlyFilesystem => "the disk can only be read".to_owned(),
        _ => {
            let text = error.to_string();
            let text = text.split(" (os error").next().unwrap_or_default();
            format!("the system reports \"{text}\"")
        }
    }
}

/// That the path leads to nothing, with the first of its folders that is missing, or the nearest
/// names.
fn missing(path: &Path, wanted: Wanted) -> String {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    if !folder.is_dir() && folder != path {
        // the folder of a folder is shorter, and the current folder is there
        let reason = missing(folder, Wanted::Folder);
        let own = reason.strip_prefix("there is no such folder");
        return own.map_or_else(
            || reason.clone(),
            |hint| format!("there is no folder `{}`{hint}", folder.display()),
        );
    }
    let what = match wanted {
        Wanted::File => "file",
        Wanted::Folder => "folder",
    };
    let near = path.file_name().map(|name| near_names(folder, &name.to_string_lossy(), wanted));
    let near: Vec<String> = near.iter().flatten().map(|name| format!("`{name}`")).collect();
    match near.is_empty() {
        true => format!("there is no such {what}"),
        false => format!("there is no such {what}; did you mean {}?", listed(&near, " or ")),
    }
}

/// The nearest names in a folder, compared without their extensions: those with the same extension,
/// or else others.
fn near_names(folder: &Path, name: &str, wanted: Wanted) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().take(MOST_NAMES).flatten();
    let mut names: Vec<String> = entries
        .filter_map(|entry| entry.file_name().into_string().ok())
        .filter(|name| wanted.is_at(&folder.join(name)))
        .collect();
    names.sort();
    let (stem, extension) = parts(name);
    let letters = stem.chars().count();
    // a longer name is near if it goes on where the wanted one ends
    let is_like = |other: &str| {
        let most = (letters + 1) / 3;
        other.chars().count().abs_diff(letters) <= most || other.starts_with(stem)
    };
    let (alike, others): (Vec<&str>, Vec<&str>) =
        names.iter().map(String::as_str).partition(|name| parts(name).1 == extension);
    let near_of = |names: Vec<&str>| {
        let stems = names.iter().map(|name| parts(name).0).filter(|other| is_like(other));
        let near = all_nearest(stem, stems);
        let near = names.into_iter().filter(|name| near.contains(&parts(name).0));
        near.map(str::to_owned).collect::<Vec<_>>()
    };
    let near = near_of(alike);
    if near.is_empty() { near_of(others) } else { near }
}

/// A name before its last point, and after it.
fn parts(name: &str) -> (&str, &str) {
    name.rsplit_once('.').filter(|(stem, _)| !stem.is_empty()).unwrap_or((name, ""))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_files_have_the_nearest_names_of_their_folder() {
        let place = tempfile::tempdir().unwrap();
        fs::create_dir(place.path().join("models")).unwrap();
        for name in ["inclined_plane.json", "a.json", "table.csv", "power.json", "powerful.json"] {
            fs::write(place.path().join("models").join(name), "").unwrap();
        }
        let reason = |name: &str| {
            let path = place.path().join(name);
            of_file(&path, &fs::read(&path).unwrap_err())
        };
        for (name, hint) in [
            ("models/inclined_plan.json", "; did you mean `inclined_plane.json`?"),
            ("models/powr.json", "; did you mean `power.json`?"),
            ("models/table.cvs", "; did you mean `table.csv`?"),
            ("models/power", "; did you mean `power.json`?"),
            ("models/inclined.json", "; did you mean `inclined_plane.json`?"),
            // neither an extension nor a word in common is enough
            ("models/b.json", ""),
            ("models/plane.json", ""),
            ("models/voltage.json", ""),
        ] {
            assert_eq!(reason(name), format!("there is no such file{hint}"), "{name}");
        }
        let folder = place.path().join("modles");
        let expected = format!("there is no folder `{}`; did you mean `models`?", folder.display());
        assert_eq!(reason("modles/power.json"), expected);
        assert_eq!(reason("modles/below/power.json"), expected);
        let path = place.path().join("model");
        let reason = of_folder(&path, &fs::read_dir(&path).unwrap_err());
        assert_eq!(reason, "there is no such folder; did you mean `models`?");
    }

    #[test]
    fn errors_of_the_system_have_no_numbers() {
        assert_eq!(in_words(&io::Error::other("it is locked")), "it is locked");
        let errors = (1..=120).map(io::Error::from_raw_os_error);
        let texts: Vec<String> = errors.map(|error| in_words(&error)).collect();
        assert!(texts.iter().all(|text| !text.contains("os error")), "{texts:?}");
        assert!(texts.contains(&"the system denies access to it".to_owned()));
    }
}
