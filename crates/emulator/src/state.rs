//! What an inference found of a hypothesis with the emulator as it is.

/// The posterior of a hypothesis.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Its effects, in ascending order.
    pub effects: Vec<usize>,
    /// The logarithm of prior probability times evidence.
    pub score: f64,
    /// The scores of its unknowns where the posterior density is greatest.
    pub mode: Vec<f64>,
    /// Draws of the scores from the posterior; at least one.
    pub draws: Vec<Vec<f64>>,
    /// Their weights, which sum to one.
    pub weights: Vec<f64>,
}
