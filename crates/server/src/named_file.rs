//! Access to the files that a file of the page names.

use std::path::{Path, PathBuf};

use super::folder::{OpenedFolder, ROOT, Unopened};
use super::watch::Watch;

/// The files below the opened folder, named relative to the folder of the file that names them.
#[derive(Clone, Copy, Debug)]
pub struct NamedFiles<'a> {
    folder: &'a OpenedFolder,
    watch: &'a Watch,
    /// The path of the naming file in requests; `None` for a text without a file.
    of: Option<&'a str>,
}

impl<'a> NamedFiles<'a> {
    pub(crate) fn new(folder: &'a OpenedFolder, watch: &'a Watch, of: Option<&'a str>) -> Self {
        Self { folder, watch, of }
    }

    /// The folder on the disk to which the names are relative.
    ///
    /// # Errors
    /// The folder is not in the opened one.
    pub fn disk(&self) -> Result<PathBuf, Unopened> {
        let path = match self.of {
            Some(of) => self.folder.path(of)?,
            None => return Ok(self.folder.root().to_owned()),
        };
        Ok(path.parent().unwrap_or(Path::new("")).to_owned())
    }

    /// The path of the file that names the others, for messages.
    pub fn name(&self) -> Option<&'a str> {
        self.of
    }

    /// The content of a named file, at most `most` bytes. From then on the page is notified of its
    /// changes.
    ///
    /// # Errors
    /// The name leads out of the opened folder, or to nothing that can be read.
    pub fn content(&self, name: &str, most: u64) -> Result<Vec<u8>, Unopened> {
        let asked = below(self.folder.root(), self.of, name)?;
        let content = self.folder.content(&asked, most)?;
        self.watch.add(&asked, &content);
        Ok(content)
    }
}

/// The folder below which a file may name others, as words: its own, or the nearest parent within
/// the opened folder that has a root file.
fn allowed<'o>(root: &Path, own: &[&'o str]) -> Vec<&'o str> {
    let depths = (0..=own.len()).rev();
    let says_so = |&depth: &usize| {
        own[..depth].iter().fold(root.to_owned(), |path, word| path.join(word)).join(ROOT).is_file()
    };
    let depth = { depths }.find(says_so).unwrap_or(own.len());
    own[..depth].to_vec()
}

/// The path below the opened folder for a name in a file.
fn below(root: &Path, of: Option<&str>, name: &str) -> Result<String, Unopened> {
    let own = of.and_then(|of| of.rsplit_once('/')).map_or("", |(folder, _)| folder);
    let own: Vec<&str> = own.split('/').filter(|word| !word.is_empty()).collect();
    let outside = || Unopened::Refused("it lies outside of the folder of this file".to_owned());
    if name.starts_with('/') {
        return Err(Unopened::Refused("its path is not relative".to_owned()));
    }
    let mut words = own.clone();
    for word in name.split('/') {
        match word {
            "." => {}
            ".." => {
                words.pop().ok_or_else(outside)?;
            }
            word => words.push(word),
        }
    }
    if !words.starts_with(&allowed(root, &own)) {
        return Err(outside());
    }
    Ok(words.join("/"))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn names_lie_below_the_folder_of_their_file() {
        let place = tempfile::tempdir().unwrap();
        let root = place.path();
        let found = |of, name| below(root, of, name);
        assert_eq!(found(None, "a.csv").unwrap(), "a.csv");
        assert_eq!(found(Some("m.json"), "./b/a.csv").unwrap(), "b/a.csv");
        assert_eq!(found(Some("x/y/m.json"), "../y/a.csv").unwrap(), "x/y/a.csv");
        let above = Some("x/y/m.json");
        for (of, name) in
            [(None, "../a"), (above, "../a"), (above, "../../a"), (None, "/etc/passwd")]
        {
            assert!(found(of, name).is_err(), "{name}");
        }
        fs::create_dir(root.join("x")).unwrap();
        fs::write(root.join("x").join(ROOT), "").unwrap();
        assert_eq!(found(above, "../a").unwrap(), "x/a");
        assert!(found(above, "../../a").is_err());
    }
}
