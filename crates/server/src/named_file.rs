//! The files that a file of the page names.

use std::path::{Path, PathBuf};

use super::folder::{OpenedFolder, Unopened};
use super::watch::Watch;

/// The files below the opened folder as a file in it names them: relative to its own folder.
#[derive(Clone, Copy, Debug)]
pub struct NamedFiles<'a> {
    folder: &'a OpenedFolder,
    watch: &'a Watch,
    /// The path of the file as a request has it; `None` of a text without a file.
    of: Option<&'a str>,
}

impl<'a> NamedFiles<'a> {
    pub(crate) fn new(folder: &'a OpenedFolder, watch: &'a Watch, of: Option<&'a str>) -> Self {
        Self { folder, watch, of }
    }

    /// The folder on the disk that the names are relative to.
    ///
    /// # Errors
    /// That it is not in the opened one.
    pub fn disk(&self) -> Result<PathBuf, Unopened> {
        let path = match self.of {
            Some(of) => self.folder.path(of)?,
            None => return Ok(self.folder.root().to_owned()),
        };
        Ok(path.parent().unwrap_or(Path::new("")).to_owned())
    }

    /// The path of the file that names the others, as messages have it.
    pub fn name(&self) -> Option<&'a str> {
        self.of
    }

    /// The content of a file by its name, of at most so many bytes. From then on a change of it is
    /// told to the page.
    ///
    /// # Errors
    /// A name that leads out of the opened folder, or to nothing that can be read.
    pub fn content(&self, name: &str, most: u64) -> Result<Vec<u8>, Unopened> {
        let asked = below(self.of, name)?;
        let content = self.folder.content(&asked, most)?;
        self.watch.add(&asked, &content);
        Ok(content)
    }
}

/// The path below the opened folder that a name leads to from the folder of a file.
fn below(of: Option<&str>, name: &str) -> Result<String, Unopened> {
    let own = of.and_then(|of| of.rsplit_once('/')).map_or("", |(folder, _)| folder);
    let mut words: Vec<&str> = own.split('/').filter(|word| !word.is_empty()).collect();
    if name.starts_with('/') {
        return Err(Unopened::Refused("its path is not relative".to_owned()));
    }
    for word in name.split('/') {
        match word {
            "." => {}
            ".." => {
                words.pop().ok_or_else(|| {
                    Unopened::Refused("it lies outside of the opened folder".to_owned())
                })?;
            }
            word => words.push(word),
        }
    }
    Ok(words.join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_relative_to_the_folder_of_their_file() {
        let found = |of, name| below(of, name).unwrap();
        assert_eq!(found(None, "a.csv"), "a.csv");
        assert_eq!(found(Some("m.json"), "./b/a.csv"), "b/a.csv");
        assert_eq!(found(Some("x/y/m.json"), "../a.csv"), "x/a.csv");
        for (of, name) in [(None, "../a"), (Some("x/m.json"), "../../a"), (None, "/etc/passwd")] {
            assert!(below(of, name).is_err(), "{name}");
        }
    }
}
