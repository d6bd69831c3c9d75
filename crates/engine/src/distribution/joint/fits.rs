//! A cache of joint draws. Fits take time, and the check of a file, its evaluation and repeated
//! generation need the same ones.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::profiles::Profiles;
use super::standard::Standard;
use super::{Correlation, CorrelationError, Joint};
use crate::distribution::Distribution;

/// A joint draw that rows share, or its error.
pub(crate) type Shared = Result<Arc<Joint>, CorrelationError>;

/// Maximum number of quantities in all cached joint draws. Each may have a table of 7 kB, and each
/// pair of a draw has a number.
const MOST: usize = 8192;

/// Number of pairs whose numbers take the memory of a table.
const PAIRS: usize = 1000;

/// Joint draws by their parameters: the shapes of the dependent quantities and their coefficients.
/// Copies share their content.
#[derive(Clone, Debug, Default)]
pub struct Fits(Arc<Known>);

#[derive(Debug, Default)]
struct Known {
    draws: Mutex<Draws>,
    profiles: Mutex<Profiles>,
}

#[derive(Debug, Default)]
struct Draws {
    correlations: Vec<Correlation>,
    /// The quantities in the coefficients, in order.
    named: Vec<usize>,
    found: Vec<(Linked, Arc<OnceLock<Shared>>)>,
}

/// The dependent quantities with their shapes, in order.
type Linked = Vec<(usize, Standard)>;

impl Fits {
    /// The joint draw of a row of quantities with these coefficients.
    pub fn joint(
        &self,
        distributions: &[Arc<Distribution>],
        correlations: &[Correlation],
    ) -> Shared {
        let entry = self.entry(distributions, correlations);
        // other rows wait for the first one that needs the same fit
        let fit = || Joint::with(&self.0.profiles, distributions, correlations).map(Arc::new);
        entry.get_or_init(fit).clone()
    }

    /// As [`joint`](Self::joint), for an evaluation without trials: errors that concern only trials
    /// are ignored.
    pub fn of_propagation(
        &self,
        distributions: &[Arc<Distribution>],
        correlations: &[Correlation],
    ) -> Shared {
        match self.joint(distributions, correlations) {
            Err(error) if error.is_of_trials() => {
                Joint::of_propagation(distributions, correlations).map(Arc::new)
            }
            found => found,
        }
    }

    /// The entry of the joint draw, filled or not.
    fn entry(
        &self,
        distributions: &[Arc<Distribution>],
        correlations: &[Correlation],
    ) -> Arc<OnceLock<Shared>> {
        let mut draws = self.0.draws.lock().unwrap_or_else(PoisonError::into_inner);
        if draws.correlations != correlations {
            let mut named: Vec<usize> =
                correlations.iter().flat_map(|c| [c.first, c.second]).collect();
            named.sort_unstable();
            named.dedup();
            let correlations = correlations.to_vec();
            *draws = Draws { correlations, named, found: Vec::new() };
        }
        let linked = linked(&draws.named, distributions);
        if let Some((_, known)) = draws.found.iter().rev().find(|(known, _)| *known == linked) {
            return Arc::clone(known);
        }
        let size = linked.len() + draws.correlations.len() / PAIRS;
        if draws.found.len() >= (MOST / size.max(1)).max(1) {
            draws.found.clear();
        }
        let entry = Arc::default();
        draws.found.push((linked, Arc::clone(&entry)));
        entry
    }
}

fn linked(named: &[usize], distributions: &[Arc<Distribution>]) -> Linked {
    let is_paired = |d: &Distribution| match d {
        Distribution::Readings(readings) => readings.together() > 1,
        other => matches!(other, Distribution::Fitted(_)),
    };
    let mut indices = named.to_vec();
    let all = distributions.iter().enumerate();
    let has_ranks = |d: &Distribution| d.saved().is_some_and(|s| s.origin().ranks.is_some());
    indices.extend(all.filter(|(_, d)| is_paired(d) || has_ranks(d)).map(|(index, _)| index));
    indices.sort_unstable();
    indices.dedup();
    let shape = |q: usize| Some((q, Standard::of(distributions.get(q)?)));
    indices.into_iter().filter_map(shape).collect()
}
