//! What an emulator says of a point.

/// The outputs of all rows at a point, in u.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// The expected output of each row.
    pub values: Vec<f64>,
    /// For each unknown the derivatives of all rows, by what the coordinates of the point were made from:
    /// scores or values.
    pub gradient: Vec<Vec<f64>>,
    /// The standard deviation of each row that the layers leave.
    pub deviations: Vec<f64>,
}

impl Prediction {
    /// Zeros of so many rows and unknowns.
    pub(crate) fn zero(rows: usize, unknowns: usize) -> Self {
        Self {
            values: vec![0.0; rows],
            gradient: vec![vec![0.0; rows]; unknowns],
            deviations: vec![0.0; rows],
        }
    }
}
