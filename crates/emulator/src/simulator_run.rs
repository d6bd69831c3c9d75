//! A run of a simulator as an emulator learns from it.

/// A run at the scores of a hypothesis' unknowns.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulatorRun {
    /// The scores.
    pub scores: Vec<f64>,
    /// The outputs of all rows, in u.
    pub outputs: Vec<f64>,
}
