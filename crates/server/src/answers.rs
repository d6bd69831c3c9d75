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
    /// Its name in `/assets/`; `index.html` is served at `/`.
    pub name: &'static str,
    /// Its media type.
    pub content_type: &'static str,
    /// Its content.
    pub content: &'static [u8],
}

/// The kind of a file, as far as its content tells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileDescription {
    /// A word for the kind, such as `model`.
    pub kind: &'static str,
    /// The title in the file.
    pub title: Option<String>,
}

/// A text of the page, possibly not yet saved, with the path of its file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextOfFile {
    /// The path below the opened folder, with `/` between its parts.
    pub path: String,
    /// The text.
    pub text: String,
    /// The folder to which the files that it names are relative.
    pub folder: PathBuf,
    /// The opened folder, above which nothing is read.
    pub root: PathBuf,
}

/// A file for download.
#[derive(Clone, PartialEq, Eq)]
pub struct Exported {
    /// Its content.
    pub content: Vec<u8>,
    /// Its media type.
    pub content_type: &'static str,
    /// The suggested file name.
    pub name: String,
}

impl fmt::Debug for Exported {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { content, content_type, name } = self;
        write!(f, "Exported({name}, {content_type}, {} bytes)", content.len())
    }
}

/// A page that shows what a text says, and what a program can do with.
#[derive(Clone, PartialEq, Eq)]
pub struct EvaluatedPage {
    /// The page as HTML.
    pub html: String,
    /// The answer for programs as JSON, of texts whose page offers changes.
    pub answer: Option<String>,
}

impl fmt::Debug for EvaluatedPage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "EvaluatedPage({} bytes)", self.html.len())
    }
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// Nothing of that name exists.
    Unknown(String),
    /// The request is malformed.
    Request(String),
    /// The user's text has an error; the message for the user.
    Content(String),
    /// The user's text has errors, each with its position.
    Mistakes {
        /// The message for the user.
        message: String,
        /// The errors as the page lists them.
        list: serde_json::Value,
    },
    /// It was stopped before there was a result.
    Stopped(String),
    /// An error of the program or of the system.
    Internal(String),
}

/// Answers requests. Calls may come on any thread, several at a time.
pub trait Answers: Send + Sync + 'static {
    /// The program's version.
    fn version(&self) -> &str;

    /// The files of the page.
    fn assets(&self) -> &[ServedAsset];

    /// A call of the page, JSON in and JSON out. When `stop` becomes true, the answer is what has
    /// been computed so far.
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

    /// The kind of a file with this name and content.
    fn describe(&self, name: &str, content: &[u8]) -> FileDescription;

    /// Evaluates a text and writes the result in a format.
    ///
    /// # Errors
    /// Why there is no result.
    fn export(
        &self,
        file: &TextOfFile,
        format: &str,
        stop: &Arc<AtomicBool>,
    ) -> Result<Exported, Refusal>;

    /// Evaluates a text and writes an HTML page; long work tells `told` the share that is done.
    ///
    /// # Errors
    /// Why there is no page.
    fn page(
        &self,
        file: &TextOfFile,
        told: &(dyn Fn(f64) + Sync),
        stop: &Arc<AtomicBool>,
    ) -> Result<EvaluatedPage, Refusal>;

    /// Writes a file at a path, new or as a replacement; completely or not at all.
    ///
    /// # Errors
    /// It cannot be written.
    fn replace(&self, path: &Path, content: &[u8]) -> io::Result<()>;
}
