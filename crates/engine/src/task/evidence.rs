//! Readings that speak for or against what is assumed about an input.

/// Readings of an input quantity over the population that its distribution is about.
#[derive(Clone, Debug, PartialEq)]
pub struct Evidence {
    /// Place of the variable in the task.
    pub variable: usize,
    /// The readings, in the variable's unit.
    pub readings: Vec<f64>,
}
