//! What effects are read against.

use gumption_engine::task::Task;
use gumption_gap::{ObservedOutput, OverridableModel};

/// What effects are read against: the sim, and what was measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct EffectContext<'a> {
    pub(super) sim: &'a OverridableModel,
    pub(super) task: &'a Task,
    pub(super) observed: &'a [Option<ObservedOutput>],
}
