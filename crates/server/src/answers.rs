//! What the server asks for.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::named_file::NamedFiles;

/// A file of the page itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ServedAsset {
    /// Its name in `/assets/`; `index.html` stands at `/`.
    pub name: &'static str,
    /// Its media type.
    pub content_type: &'static str,
    /// Its content.
    pub content: &'static [u8],
}

/// What kind of file something is, as far as its content tells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileDescription {
    /// A word for the kind, such as `model`.
    pub kind: &'static str,
    /// The title that stands in it.
    pub title: Option<String>,
}

/// A text of the page, perhaps not saved yet, with the place of its file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextOfFile {
    /// The name below the opened folder, with `/` between its parts.
    pub path: String,
    /// The text.
    pub text: String,
    /// The folder that the files it names are relative to.
    pub folder: PathBuf,
    /// The opened folder, above which nothing is read.
    pub root: PathBuf,
}

/// A file that is handed out.
#[derive(Clone, PartialEq, Eq)]
pub struct Exported {
    /// Its content.
    pub content: Vec<u8>,
    /// Its media type.
    pub content_type: &'static str,
    /// The name to be saved under.
    pub name: String,
}

impl fmt::Debug for Exported {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { content, content_type, name } = self;
        write!(f, "Exported({name}, {content_type}, {} bytes)", content.len())
    }
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// There is nothing of that name.
    Unknown(String),
    /// The request is not as it must be.
    Request(String),
    /// What the user wrote is at fault: the text of the message for him.
    Content(String),
    /// What the user wrote has mistakes, each with its place.
    Mistakes {
        /// The text of the message for him.
        message: String,
        /// The mistakes as the page lists them.
        list: serde_json::Value,
    },
    /// It was stopped before there was anything to hand out.
    Stopped(String),
    /// The program or the system is at fault.
    Internal(String),
}

/// What answers requests. Each call may come on any thread, several at a time.
pub trait Answers: Send + Sync + 'static {
    /// The program's version.
    fn version(&self) -> &str;

    /// The files of the page.
    fn assets(&self) -> &[ServedAsset];

    /// A call of the page, JSON in and JSON out. When `stop` becomes true, what there is by then is
    /// the answer.
    ///
    /// # Errors
    /// Why there is none.
    fn call(
        &self,
        name: &str,
        request: &str,
        files: &NamedFiles<'_>,
        stop: &Arc<AtomicBool>,
    ) -> Result<String, Refusal>;

    /// What a file of that name and content is.
    fn describe(&self, name: &str, content: &[u8]) -> FileDescription;

    /// A text evaluated and written in a format.
    ///
    /// # Errors
    /// Why there is nothing to hand out.
    fn export(
        &self,
        file: &TextOfFile,
        format: &str,
        stop: &Arc<AtomicBool>,
    ) -> Result<Exported, Refusal>;

    /// A text evaluated as a page of HTML.
    ///
    /// # Errors
    /// Why there is no page.
    fn page(&self, file: &TextOfFile, stop: &Arc<AtomicBool>) -> Result<String, Refusal>;

    /// Puts a file in place of the one at a path, or where there is none; whole or not at all.
    ///
    /// # Errors
    /// That it cannot be written.
    fn replace(&self, path: &Path, content: &[u8]) -> io::Result<()>;
}
