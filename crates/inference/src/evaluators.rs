//! The programs of hypotheses made ready for the points of the data, each of them made once.
//!
//! A diagnosis comes back to a hypothesis at every step and with every noise, while the program with
//! its effects at the data's conditions stays the same: to record it and to fold what is constant at
//! each point costs more than many columns of draws do.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use super::likelihood::Evaluator;

/// Programs at points that are kept, at most: about a kilobyte each.
const MOST_KEPT: usize = 50_000;

/// Evaluators by number of points and effects. Setups with the same rows of a case may share them:
/// rows are taken together at the same conditions or not at all, which the number of points tells.
#[derive(Debug, Default)]
pub(crate) struct Evaluators {
    known: Mutex<KnownEvaluators>,
}

#[derive(Debug, Default)]
struct KnownEvaluators {
    by_effects: HashMap<(usize, Vec<usize>), Arc<Evaluator>>,
    kept: usize,
}

impl Evaluators {
    /// The evaluator with these effects at so many points; `make` makes it if it is not known.
    pub(crate) fn of(
        &self,
        points: usize,
        effects: &[usize],
        make: impl FnOnce() -> Evaluator,
    ) -> Arc<Evaluator> {
        let key = (points, effects.to_vec());
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = known().by_effects.get(&key) {
            return Arc::clone(found);
        }
        let made = Arc::new(make());
        let mut known = known();
        let size = made.schedules();
        if known.kept + size <= MOST_KEPT {
            known.kept += size;
            known.by_effects.insert(key, Arc::clone(&made));
        }
        made
    }
}
