//! Errors with their places.

use std::borrow::Cow;
use std::cell::{Cell, Ref, RefCell};
use std::collections::HashMap;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use super::DiagnosticKind;
use super::date::Day;
use super::source::{Place, SourceText};
use gumption_engine::model::formula::{Formula, FormulaError};
use gumption_engine::regression::CurveFunction;
use gumption_units::{Unit, UnitError};

/// Maximum number of errors that are collected: a list of a million faulty cells helps nobody.
const MOST: usize = 1000;

/// The longest quoted part of a message, in characters; the middle of a longer one is cut.
const LONGEST: usize = 1000;

/// An error in a user's file.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// The text that contains the error.
    pub source: Arc<SourceText>,
    /// The position: a half-open range of bytes.
    pub span: Range<usize>,
    /// What is wrong.
    pub kind: DiagnosticKind,
}

impl Diagnostic {
    /// Line and column, counted from 1.
    pub fn position(&self) -> (usize, usize) {
        self.source.position(self.span.start)
    }

    /// The message, always on one line; very long quoted texts are shortened.
    pub fn message(&self) -> String {
        let mut message = String::new();
        for (number, part) in self.kind.to_string().split('`').enumerate() {
            if number > 0 {
                message.push('`');
            }
            message += &printable(&shortened(part));
        }
        message
    }
}

/// A text of a file on one line; characters for which [`is_obeyed`] holds appear as escapes of
/// Rust, such as `\u{1b}`.
pub fn printable(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if is_obeyed(c) { out.extend(c.escape_default()) } else { out.push(c) }
    }
    out
}

/// Whether a terminal would interpret the character, whether it changes the direction of text, or
/// whether it has no width.
pub fn is_obeyed(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{ad}' | '\u{feff}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{2069}')
}

/// A part of a message; the middle of a very long quotation is left out.
fn shortened(part: &str) -> Cow<'_, str> {
    let Some((cut, _)) = part.char_indices().nth(LONGEST) else {
        return part.into();
    };
    let head = part.char_indices().nth(LONGEST / 2).map_or(cut, |(at, _)| at);
    let tail = part.char_indices().nth_back(LONGEST / 4).map_or(cut, |(at, _)| at);
    match (part.get(..head), part.get(tail..)) {
        (Some(head), Some(tail)) => format!("{head}…{tail}").into(),
        _ => part.into(),
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, message) = (printable(&self.source.name), self.message());
        // there are no positions in a file that cannot be read
        if self.source.text.is_empty() {
            return write!(f, "{name}: {message}");
        }
        let (line, column) = self.position();
        write!(f, "{name}:{line}:{column}: {message}")
    }
}

/// All errors found, in the order of their positions.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostics(pub Vec<Diagnostic>);

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, diagnostic) in self.0.iter().enumerate() {
            if number > 0 {
                f.write_str("\n")?;
            }
            diagnostic.fmt(f)?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}

/// Collects errors while a file is read.
#[derive(Debug)]
pub struct Collector {
    /// The text that is read.
    pub source: Arc<SourceText>,
    diagnostics: RefCell<Vec<Diagnostic>>,
    /// Whether there were more errors than are collected.
    more: Cell<bool>,
    /// Indices of the diagnostics by the byte at which they begin.
    by_start: RefCell<HashMap<usize, Vec<usize>>>,
    /// Units that the file defines.
    units: RefCell<Vec<Unit>>,
    /// The day from which the dates of the file count.
    date_origin: Cell<Option<Day>>,
}

impl Collector {
    /// Nothing found yet.
    pub fn new(source: Arc<SourceText>) -> Self {
        let (diagnostics, by_start) = (RefCell::default(), RefCell::default());
        let (units, date_origin) = (RefCell::default(), Cell::default());
        Self { source, diagnostics, more: Cell::new(false), by_start, units, date_origin }
    }

    /// Parses a unit: one that the file defines, or one of the built-in units.
    pub fn unit(&self, text: &str) -> Result<Unit, UnitError> {
        Unit::parse_among(text, &self.own_units())
    }

    /// The units that the file defines.
    pub fn own_units(&self) -> Ref<'_, [Unit]> {
        Ref::map(self.units.borrow(), Vec::as_slice)
    }

    /// The day from which the dates of the file count, if it states one.
    pub fn date_origin(&self) -> Option<Day> {
        self.date_origin.get()
    }

    /// States the day from which the dates of the file count.
    pub fn define_date_origin(&self, origin: Day) {
        self.date_origin.set(Some(origin));
    }

    /// Parses a formula; its brackets may contain units of the file.
    pub fn formula(&self, text: &str) -> Result<Formula, FormulaError> {
        self.formula_with(text, &[])
    }

    /// Parses a formula that may call these calibration functions.
    pub fn formula_with(
        &self,
        text: &str,
        curves: &[Arc<CurveFunction>],
    ) -> Result<Formula, FormulaError> {
        Formula::parse_with(text, curves, &self.own_units())
    }

    /// Defines a unit.
    pub fn define_unit(&self, unit: Unit) {
        let mut units = self.units.borrow_mut();
        if !units.iter().any(|known| known.text() == unit.text()) {
            units.push(unit);
        }
    }

    /// Reports an error in the file itself.
    pub fn report(&self, span: &Range<usize>, kind: DiagnosticKind) {
        self.report_at(Place { source: self.source.clone(), span: span.clone() }, kind);
    }

    /// An error in some text.
    pub fn report_at(&self, place: Place, kind: DiagnosticKind) {
        let diagnostic = Diagnostic { source: place.source, span: place.span, kind };
        let mut diagnostics = self.diagnostics.borrow_mut();
        let mut by_start = self.by_start.borrow_mut();
        let same_start = by_start.entry(diagnostic.span.start).or_default();
        if !same_start.iter().any(|&earlier| diagnostics.get(earlier) == Some(&diagnostic)) {
            if diagnostics.len() >= MOST {
                self.more.set(true);
                return;
            }
            same_start.push(diagnostics.len());
            diagnostics.push(diagnostic);
        }
    }

    /// The value that was read, if nothing was reported.
    ///
    /// # Errors
    /// All reported errors, in the order of their positions.
    pub fn finish<T>(self, found: Option<T>) -> Result<T, Diagnostics> {
        match found {
            Some(found) if self.is_clean() => Ok(found),
            _ => Err(self.into_diagnostics()),
        }
    }

    /// Whether the limit of collected errors is exceeded, so that reading may stop.
    pub fn is_full(&self) -> bool {
        self.more.get()
    }

    /// The value; an error is reported at `span`.
    pub fn value<T>(&self, span: &Range<usize>, result: Result<T, DiagnosticKind>) -> Option<T> {
        result.map_err(|diagnostic| self.report(span, diagnostic)).ok()
    }

    /// Whether an error was reported that begins where `span` begins.
    pub fn has_mistake_at(&self, span: &Range<usize>) -> bool {
        self.by_start.borrow().get(&span.start).is_some_and(|found| !found.is_empty())
    }

    /// Whether nothing was reported.
    pub fn is_clean(&self) -> bool {
        self.diagnostics.borrow().is_empty()
    }

    /// The errors in order: first those of this file by position, then those of other files.
    pub fn into_diagnostics(self) -> Diagnostics {
        let mut diagnostics = self.diagnostics.into_inner();
        let own = self.source;
        diagnostics.sort_by_key(|p| (!Arc::ptr_eq(&p.source, &own), p.span.start, p.span.end));
        without_consequences(&mut diagnostics);
        if self.more.get() {
            let end = own.text.trim_end().len();
            let diagnostic = DiagnosticKind::MoreMistakes { most: MOST };
            diagnostics.push(Diagnostic { source: own, span: end..end, kind: diagnostic });
        }
        Diagnostics(diagnostics)
    }
}

/// Removes reports of missing keys that are missing only because a key is misspelt.
fn without_consequences(diagnostics: &mut Vec<Diagnostic>) {
    let mut explained = Vec::new();
    for (at, diagnostic) in diagnostics.iter().enumerate() {
        let missing = match &diagnostic.kind {
            DiagnosticKind::UnknownKey { nearest: Some(right), what, .. } => {
                // without `expanded`, `std` is reported as missing, and `k` remains without its
                // partner
                let is_expanded = right == "expanded";
                let is_alone = |p: &Diagnostic| matches!(&p.kind, DiagnosticKind::OnlyWith { with, .. } if with == right);
                explained.extend(diagnostics.iter().position(is_alone).filter(|_| is_expanded));
                diagnostics.iter().take(at).rposition(
                    |p| matches!(&p.kind, DiagnosticKind::MissingKey { key, what: of } if (key == right || is_expanded && *key == "std") && of == what),
                )
            }
            DiagnosticKind::UnknownInput { nearest: Some(right), .. } => diagnostics
                .iter()
                .position(|p| matches!(&p.kind, DiagnosticKind::MissingInput { name, .. } if name == right)),
            _ => None,
        };
        explained.extend(missing);
    }
    let mut number = 0;
    diagnostics.retain(|_| {
        number += 1;
        !explained.contains(&(number - 1))
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn very_long_names_are_cut_in_messages() {
        let unit = format!("a{}b\nc", "ä".repeat(100_000));
        let diagnostic = DiagnosticKind::NoSuchInput { name: unit, nearest: None };
        let diagnostic =
            Diagnostic { source: SourceText::new("m", "{}"), span: 0..0, kind: diagnostic };
        let message = diagnostic.message();
        assert!(message.starts_with("there is no input `aää") && message.len() < 2000, "{message}");
        assert!(message.contains("ä…ä") && message.contains("äb\\nc`"), "{message}");
    }

    #[test]
    fn more_mistakes_than_are_of_use_are_not_collected() {
        let log = Collector::new(SourceText::new("m", &"x".repeat(5000)));
        for place in 0..2000 {
            log.report(&(place..place + 1), DiagnosticKind::NumberTooLarge);
        }
        assert!(log.is_full());
        let diagnostics = log.into_diagnostics().0;
        assert_eq!(diagnostics.len(), MOST + 1);
        let last = diagnostics.last().unwrap();
        assert_eq!(
            (last.position(), &last.kind),
            ((1, 5001), &DiagnosticKind::MoreMistakes { most: MOST })
        );
    }
}
