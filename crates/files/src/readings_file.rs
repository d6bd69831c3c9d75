//! A file of readings that replace those of model files.

use std::borrow::Cow;
use std::path::Path;

use gumption_text::text_table::TextTable;
use gumption_text::workbook::choice::{self, Wanted};
use gumption_text::workbook::{self, Book};
use gumption_text::{Collector, DiagnosticKind, Diagnostics, SourceText, bytes};

/// What a sheet of a workbook must contain.
const READINGS: Wanted =
    Wanted { a: "a table of readings", one: "one table of readings", has_option: false };

/// A table of readings as text: a heading of names with units, and a line for each reading.
#[derive(Clone, Debug)]
pub struct ReadingsFile {
    name: String,
    content: Vec<u8>,
    pub(super) table: TextTable,
}

/// The readings that a model is to be read with.
#[derive(Clone, Copy, Debug)]
pub(super) struct NewReadings<'c> {
    /// Their file.
    pub(super) file: &'c ReadingsFile,
    /// The name of the model file in a certificate, whose other models may have the other columns.
    pub(super) model: Option<&'c str>,
}

impl ReadingsFile {
    /// The file at a path: CSV, or the only sheet of a workbook that holds cells.
    ///
    /// # Errors
    /// The file cannot be read, is neither text nor a workbook, or is no table.
    pub fn open(path: &Path) -> Result<Self, Diagnostics> {
        let shown = path.display().to_string();
        // answers name the file and not the folders of this machine
        let name =
            path.file_name().map_or(shown.clone(), |name| name.to_string_lossy().into_owned());
        match bytes::of_file(path, bytes::MOST) {
            Ok(content) => Self::shown_as(&shown, name, content),
            Err(message) => Err(refused(&shown, DiagnosticKind::Unreadable { message })),
        }
    }

    /// The content of a file of this name, which is a workbook where the name ends in `.xlsx`.
    ///
    /// # Errors
    /// It is neither text nor a workbook, or is no table.
    pub fn of(name: &str, content: Vec<u8>) -> Result<Self, Diagnostics> {
        Self::shown_as(name, name.to_owned(), content)
    }

    /// The same, with another name in messages.
    fn shown_as(shown: &str, name: String, content: Vec<u8>) -> Result<Self, Diagnostics> {
        let text = text(shown, &content).map_err(|kind| refused(shown, kind))?;
        let source = SourceText::new(shown, &text);
        let log = Collector::new(source.clone());
        let table = TextTable::parse(&log, &source);
        let table = log.finish(table)?;
        Ok(Self { name, content, table })
    }

    /// The name, without its folder.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The bytes.
    pub fn content(&self) -> &[u8] {
        &self.content
    }

    /// Adds it to the files that a model was read with.
    pub(super) fn add_to(&self, log: &Collector, files: &mut Vec<(String, Vec<u8>)>) {
        match files.iter().find(|(name, _)| *name == self.name) {
            None => files.push((self.name.clone(), self.content.clone())),
            Some((_, content)) if *content == self.content => {}
            Some(_) => {
                let reason = format!(
                    "the model names another file `{}`; give the file of readings a name of its own",
                    self.name
                );
                log.report_at(self.table.header(), DiagnosticKind::Table { reason });
            }
        }
    }
}

fn text(name: &str, content: &[u8]) -> Result<String, DiagnosticKind> {
    let unreadable = |message| DiagnosticKind::Unreadable { message };
    if !workbook::is_workbook(Path::new(name)).map_err(unreadable)? {
        return bytes::text(content).map(Cow::into_owned).map_err(unreadable);
    }
    let mut book = Book::open(content.to_owned()).map_err(unreadable)?;
    let (table, _) = choice::of(
        &mut book,
        None,
        &READINGS,
        |book, sheet| book.table(sheet).map_err(unreadable),
        |table| !table.header().is_empty(),
    )?;
    table.text().map(|(text, ..)| text).map_err(unreadable)
}

fn refused(name: &str, kind: DiagnosticKind) -> Diagnostics {
    let log = Collector::new(SourceText::new(name, ""));
    log.report(&(0..0), kind);
    log.into_diagnostics()
}
