//! Keeps report pages for the browser for a while.
//!
//! A report page contains its styles, which the policy of the live page forbids. Therefore it is
//! fetched separately, with a policy that allows it nothing else.

use std::collections::VecDeque;
use std::io;
use std::sync::{Arc, Mutex, PoisonError};

use super::token::Token;

/// Maximum number of pages that are kept.
const MOST: usize = 16;

/// Bytes of them, at most.
const MOST_BYTES: usize = 64 << 20;

type Kept = VecDeque<(Token, Arc<str>)>;

/// The last pages.
#[derive(Debug, Default)]
pub(crate) struct ShownPages(Mutex<Kept>);

impl ShownPages {
    /// Keeps a page, and returns the name to fetch it by.
    pub(crate) fn keep(&self, html: &str) -> io::Result<String> {
        let name = Token::new()?;
        let text = name.text().to_owned();
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.push_back((name, html.into()));
        let too_much = |kept: &Kept| {
            kept.len() > MOST || kept.iter().map(|(_, page)| page.len()).sum::<usize>() > MOST_BYTES
        };
        while kept.len() > 1 && too_much(&kept) {
            kept.pop_front();
        }
        Ok(text)
    }

    /// The page of that name.
    pub(crate) fn get(&self, name: &str) -> Option<Arc<str>> {
        let kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.iter().find(|(of, _)| of.is(name)).map(|(_, page)| Arc::clone(page))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_pages_are_kept() {
        let pages = ShownPages::default();
        let first = pages.keep("first").unwrap();
        assert_eq!(pages.get(&first).as_deref(), Some("first"));
        let names: Vec<String> = (0..MOST).map(|_| pages.keep("more").unwrap()).collect();
        assert!(pages.get(&first).is_none() && pages.get(&names[0]).is_some());
    }
}
