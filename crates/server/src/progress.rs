//! The shares of long work that are done, for pages that ask.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Maximum length of the name that a page gives its work.
const LONGEST: usize = 64;

type Shares = HashMap<String, f64>;

/// The share of each piece of work that is going on, by the name that the page gave it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Progress(Arc<Mutex<Shares>>);

/// A piece of work whose share can be asked for until it is dropped.
#[derive(Debug)]
pub(crate) struct ToldWork {
    name: Option<String>,
    all: Progress,
}

impl Progress {
    fn shares(&self) -> MutexGuard<'_, Shares> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Work begins; without a name, and with one that is in use, nobody can ask for its share.
    pub(crate) fn begin(&self, name: Option<String>) -> ToldWork {
        let mut shares = self.shares();
        let name = name.filter(|name| name.len() <= LONGEST && !shares.contains_key(name));
        if let Some(name) = &name {
            shares.insert(name.clone(), 0.0);
        }
        drop(shares);
        ToldWork { name, all: self.clone() }
    }

    /// The share that is done of the work of that name, from 0 to 1.
    pub(crate) fn of(&self, name: &str) -> Option<f64> {
        self.shares().get(name).copied()
    }
}

impl ToldWork {
    /// So much is done; a share never falls.
    pub(crate) fn tell(&self, share: f64) {
        if let Some(name) = &self.name
            && let Some(known) = self.all.shares().get_mut(name)
        {
            *known = known.max(share.clamp(0.0, 1.0));
        }
    }
}

impl Drop for ToldWork {
    fn drop(&mut self) {
        if let Some(name) = &self.name {
            self.all.shares().remove(name);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_is_told_while_the_work_lasts_and_never_falls() {
        let all = Progress::default();
        assert_eq!(all.of("a"), None);
        let work = all.begin(Some("a".to_owned()));
        assert_eq!(all.of("a"), Some(0.0));
        work.tell(0.4);
        work.tell(0.2);
        assert_eq!(all.of("a"), Some(0.4));
        // a second one of that name tells nothing and ends nothing
        drop(all.begin(Some("a".to_owned())));
        drop(all.begin(None));
        assert_eq!(all.of("a"), Some(0.4));
        drop(work);
        assert_eq!(all.of("a"), None);
    }
}
