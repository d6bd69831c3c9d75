//! Questions about a sheet: what could be two things is asked, with both readings and the option that decides.

use std::cell::RefCell;
use std::fmt;
use std::ops::RangeInclusive;

use serde::Serialize;

use super::grid::Cells;
use super::options::ImportOptions;
use gumption_columns::separator::DecimalMarks;
use gumption_engine::fact::Fact;
use gumption_text::{Collector, DiagnosticKind, Diagnostics};

/// What a sheet does not say.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Question {
    /// What is asked, as a sentence.
    pub about: String,
    /// What can be meant.
    pub readings: Vec<String>,
    /// The option that decides, or the options.
    pub option: String,
    /// The rows that the question is about, from 1.
    #[serde(skip)]
    pub rows: RangeInclusive<usize>,
}

impl fmt::Display for Question {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.about)?;
        if !self.readings.is_empty() {
            write!(f, ": it can be {}", self.readings.join("; or "))?;
        }
        write!(f, ". Say which with {}", self.option)
    }
}

/// Why a sheet is not read.
#[derive(Clone, Debug)]
pub struct RefusedBudget {
    /// The mistakes, the questions among them.
    pub diagnostics: Diagnostics,
    /// The questions, each with the option that answers it.
    pub questions: Vec<Question>,
}

impl fmt::Display for RefusedBudget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.diagnostics.fmt(f)
    }
}

impl std::error::Error for RefusedBudget {}

impl From<Diagnostics> for RefusedBudget {
    fn from(diagnostics: Diagnostics) -> Self {
        Self { diagnostics, questions: Vec::new() }
    }
}

/// A sheet that is read, with what is said of it.
pub(super) struct ReadSheet<'a> {
    pub(super) cells: &'a Cells,
    pub(super) log: &'a Collector,
    pub(super) options: &'a ImportOptions,
    pub(super) marks: RefCell<DecimalMarks>,
    pub(super) notes: RefCell<Vec<Fact>>,
    pub(super) questions: RefCell<Vec<Question>>,
}

/// Rows that a message shows, at most.
const MOST_SHOWN: usize = 6;

impl ReadSheet<'_> {
    /// Reports a mistake in a line, from 0.
    pub(super) fn fail(&self, line: usize, reason: impl AsRef<str>) {
        self.fail_in(line..=line, reason.as_ref());
    }

    fn fail_in(&self, lines: RangeInclusive<usize>, reason: &str) {
        let last = (*lines.end()).min(lines.start() + MOST_SHOWN - 1);
        let span = self.cells.line(*lines.start()).start..self.cells.line(last).end;
        self.log.report(&span, DiagnosticKind::Table { reason: shortened(reason) });
    }

    /// Asks what lines, from 0, mean.
    pub(super) fn ask<const N: usize>(
        &self,
        lines: RangeInclusive<usize>,
        about: impl Into<String>,
        readings: [&str; N],
        option: impl Into<String>,
    ) {
        let readings = readings.map(shortened).into();
        let about = shortened(&about.into());
        let rows = lines.start() + 1..=lines.end() + 1;
        let question = Question { about, readings, option: option.into(), rows };
        self.fail_in(lines, &question.to_string());
        self.questions.borrow_mut().push(question);
    }

    /// Keeps what is worth knowing of how the sheet was read.
    pub(super) fn note(&self, note: Fact) {
        self.notes.borrow_mut().push(note);
    }
}

/// A sentence whose quotes are no longer than a cell that people write: of a longer one the beginning.
pub(super) fn shortened(sentence: &str) -> String {
    let parts = sentence.split('`').enumerate().map(|(place, part)| match place % 2 {
        1 => beginning(part),
        _ => part.to_owned(),
    });
    parts.collect::<Vec<_>>().join("`")
}

/// A quote that is no longer than a cell that people write: of a longer one the beginning.
pub(super) fn beginning(quote: &str) -> String {
    const MOST: usize = 120;
    match quote.char_indices().nth(MOST) {
        Some((end, _)) if quote.len() > 2 * MOST => format!("{}…", &quote[..end]),
        _ => quote.to_owned(),
    }
}
