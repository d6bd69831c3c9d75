//! Mistakes with their places.

use std::cell::RefCell;
use std::collections::HashMap;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use super::Fault;
use super::source::{Place, Source};

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

    /// The sentence about the mistake, on one line whatever the file's names have in them.
    pub fn message(&self) -> String {
        let mut message = String::new();
        for c in self.fault.to_string().chars() {
            if c.is_control() { message.extend(c.escape_default()) } else { message.push(c) }
        }
        message
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
    /// The problems by where they begin.
    by_start: RefCell<HashMap<usize, Vec<usize>>>,
}

impl Log {
    pub(crate) fn new(source: Arc<Source>) -> Self {
        Self { source, problems: RefCell::default(), by_start: RefCell::default() }
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
            same_start.push(problems.len());
            problems.push(problem);
        }
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
