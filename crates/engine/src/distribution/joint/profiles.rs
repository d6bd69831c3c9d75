//! A cache of profiles, as equal shapes are frequent.

use std::sync::Arc;

use super::copula::{self, Margin};
use super::profile::{Profile, Table};
use super::standard::Standard;

/// Maximum number of cached profiles.
const MOST: usize = 64;

/// Profiles by their shapes.
#[derive(Debug, Default)]
pub(super) struct Profiles(Vec<(Standard, Arc<Profiled>)>);

/// A profile with its Hermite coefficients, and its table for draws.
#[derive(Debug)]
pub(super) struct Profiled {
    profile: Profile,
    terms: Vec<f64>,
    pub(super) table: Arc<Table>,
}

impl Profiles {
    /// The profile of a shape; `None` for shapes that need none.
    pub(super) fn of(&mut self, standard: &Standard) -> Option<Arc<Profiled>> {
        if let Some((_, known)) = self.0.iter().find(|(shape, _)| shape == standard) {
            return Some(Arc::clone(known));
        }
        let (profile, table) = Profile::of(&standard.distribution()?);
        let terms = copula::hermite(&profile);
        let profiled = Arc::new(Profiled { profile, terms, table: Arc::new(table) });
        if self.0.len() >= MOST {
            self.0.clear();
        }
        self.0.push((standard.clone(), Arc::clone(&profiled)));
        Some(profiled)
    }
}

impl Profiled {
    pub(super) fn margin(&self) -> Margin<'_> {
        Margin::Shaped { profile: &self.profile, terms: &self.terms }
    }
}
