//! Mistakes with their places.

use std::cell::RefCell;
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
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (line, column) = self.position();
        write!(f, "{}:{line}:{column}: {}", self.source.name, self.fault)
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
}

impl Log {
    pub(crate) fn new(source: Arc<Source>) -> Self {
        Self { source, problems: RefCell::new(Vec::new()) }
    }

    /// A mistake in the file itself.
    pub(crate) fn report(&self, span: &Range<usize>, fault: Fault) {
        self.report_at(Place { source: self.source.clone(), span: span.clone() }, fault);
    }

    /// A mistake in some text.
    pub(crate) fn report_at(&self, place: Place, fault: Fault) {
        let problem = Problem { source: place.source, span: place.span, fault };
        let mut problems = self.problems.borrow_mut();
        if !problems.contains(&problem) {
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
        Problems(problems)
    }
}
