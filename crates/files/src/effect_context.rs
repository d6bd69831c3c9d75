//! What effects are read against.

use gumption_engine::task::Task;
use gumption_gap::{Effect, History, ObservedOutput, OverridableModel};

/// What effects are read against: the sim, and what was measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct EffectContext<'a> {
    pub(super) sim: &'a OverridableModel,
    pub(super) task: &'a Task,
    pub(super) observed: &'a [Option<ObservedOutput>],
    /// Conditions that follow from the order of the rows, with their places.
    pub(super) history: &'a [(usize, History)],
    /// The place of the condition that says when each row was taken.
    pub(super) clock: Option<usize>,
}

impl EffectContext<'_> {
    /// Whether an observed output is computed otherwise once the effect acts. An effect whose
    /// overrides need each other, which is reported where it is read, counts as one that acts.
    pub(super) fn is_changed_by(&self, effect: &Effect) -> bool {
        let Ok(changed) = self.sim.changed_by(effect) else { return true };
        changed
            .into_iter()
            .zip(self.observed)
            .any(|(changed, observed)| changed && observed.is_some())
    }
}
