//! Mistakes with their places.

use std::borrow::Cow;
use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use super::Fault;
use super::source::{Place, Source};

/// At most so many mistakes are collected: a table of a million faulty cells helps nobody.
const MOST: usize = 1000;

/// The longest part of a sentence between two quotation marks, in letters.
const LONGEST: usize = 1000;

/// A mistake in a user's file.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// The text in which it lies.
    pub source: Arc<Source>,
    /// The place: a half-open range of bytes.
    pub span: Range<usize>,
    /// What is wrong.
    pub fault: Fault,
}

impl Problem {
    /// Line and column, counted from 1.
    pub fn position(&self) -> (usize, usize) {
        self.source.position(self.span.start)
    }

    /// The sentence about the mistake, on one line whatever the file's names have in them; very long
    /// quoted texts are cut.
    pub fn message(&self) -> String {
        let mut message = String::new();
        for (number, part) in self.fault.to_string().split('`').enumerate() {
            if number > 0 {
                message.push('`');
            }
            for c in shortened(part).chars() {
                if c.is_control() { message.extend(c.escape_default()) } else { message.push(c) }
            }
        }
        message
    }
}

/// A part of a sentence without the middle of what is longer than anything that is said.
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

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (line, column) = self.position();
        write!(f, "{}:{line}:{column}: {}", self.source.name, self.message())
    }
}

/// All mistakes that were found, in the order of their places.
#[derive(Clone, Debug, PartialEq)]
pub struct Problems(pub Vec<Problem>);

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, problem) in self.0.iter().enumerate() {
            if number > 0 {
                f.write_str("\n")?;
            }
            problem.fmt(f)?;
        }
        Ok(())
    }
}

impl std::error::Error for Problems {}

/// Collects mistakes while a file is read.
#[derive(Debug)]
pub(crate) struct Log {
    pub(crate) source: Arc<Source>,
    problems: RefCell<Vec<Problem>>,
    /// Whether there are more than are collected.
    more: Cell<bool>,
    /// The problems by where they begin.
    by_start: RefCell<HashMap<usize, Vec<usize>>>,
}

impl Log {
    pub(crate) fn new(source: Arc<Source>) -> Self {
        let (problems, by_start) = (RefCell::default(), RefCell::default());
        Self { source, problems, more: Cell::new(false), by_start }
    }

    /// A mistake in the file itself.
    pub(crate) fn report(&self, span: &Range<usize>, fault: Fault) {
        self.report_at(Place { source: self.source.clone(), span: span.clone() }, fault);
    }

    /// A mistake in some text.
    pub(crate) fn report_at(&self, place: Place, fault: Fault) {
        let problem = Problem { source: place.source, span: place.span, fault };
        let mut problems = self.problems.borrow_mut();
        let mut by_start = self.by_start.borrow_mut();
        let same_start = by_start.entry(problem.span.start).or_default();
        if !same_start.iter().any(|&earlier| problems.get(earlier) == Some(&problem)) {
            if problems.len() >= MOST {
                self.more.set(true);
                return;
            }
            same_start.push(problems.len());
            problems.push(problem);
        }
    }

    /// What was found, unless something was reported.
    ///
    /// # Errors
    /// All that was reported, in the order of the places.
    pub(crate) fn finish<T>(self, found: Option<T>) -> Result<T, Problems> {
        match found {
            Some(found) if self.is_clean() => Ok(found),
            _ => Err(self.into_problems()),
        }
    }

    /// Whether there are more mistakes than are collected, so that nothing more needs to be read.
    pub(crate) fn is_full(&self) -> bool {
        self.more.get()
    }

    /// The value, or the mistake reported at `span`.
    pub(crate) fn value<T>(&self, span: &Range<usize>, result: Result<T, Fault>) -> Option<T> {
        result.map_err(|fault| self.report(span, fault)).ok()
    }

    pub(crate) fn is_clean(&self) -> bool {
        self.problems.borrow().is_empty()
    }

    /// The mistakes in order: those of this file by place, then those of other files.
    pub(crate) fn into_problems(self) -> Problems {
        let mut problems = self.problems.into_inner();
        let own = self.source;
        problems.sort_by_key(|p| (!Arc::ptr_eq(&p.source, &own), p.span.start, p.span.end));
        without_consequences(&mut problems);
        if self.more.get() {
            let end = own.text.trim_end().len();
            let fault = Fault::MoreMistakes { most: MOST };
            problems.push(Problem { source: own, span: end..end, fault });
        }
        Problems(problems)
    }
}

/// Leaves out what is missing only because its name is misspelt.
fn without_consequences(problems: &mut Vec<Problem>) {
    let mut explained = Vec::new();
    for (at, problem) in problems.iter().enumerate() {
        let missing = match &problem.fault {
            Fault::UnknownKey { nearest: Some(right), what, .. } => {
                problems.iter().take(at).rposition(
                    |p| matches!(&p.fault, Fault::MissingKey { key, what: of } if key == right && of == what),
                )
            }
            Fault::UnknownInput { nearest: Some(right), .. } => problems
                .iter()
                .position(|p| matches!(&p.fault, Fault::MissingInput { name, .. } if name == right)),
            _ => None,
        };
        explained.extend(missing);
    }
    let mut number = 0;
    problems.retain(|_| {
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
        let fault = Fault::NoSuchInput { name: unit, nearest: None };
        let problem = Problem { source: Source::new("m", "{}"), span: 0..0, fault };
        let message = problem.message();
        assert!(message.starts_with("there is no input `aää") && message.len() < 2000, "{message}");
        assert!(message.contains("ä…ä") && message.contains("äb\\nc`"), "{message}");
    }

    #[test]
    fn more_mistakes_than_are_of_use_are_not_collected() {
        let log = Log::new(Source::new("m", &"x".repeat(5000)));
        for place in 0..2000 {
            log.report(&(place..place + 1), Fault::NumberTooLarge);
        }
        assert!(log.is_full());
        let problems = log.into_problems().0;
        assert_eq!(problems.len(), MOST + 1);
        let last = problems.last().unwrap();
        assert_eq!(
            (last.position(), &last.fault),
            ((1, 5001), &Fault::MoreMistakes { most: MOST })
        );
    }
}
