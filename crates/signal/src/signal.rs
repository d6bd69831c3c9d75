//! A sampled signal.

/// Values of one channel at evenly spaced instants: value `i` was taken at `start + i / rate`.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    /// The values, in the unit that its owner states.
    pub values: Vec<f64>,
    /// The sampling rate, in hertz.
    pub rate: f64,
    /// The instant of the first value, in seconds.
    pub start: f64,
}

impl Signal {
    /// The instant of a value, in seconds; `index` need not be a value's.
    pub fn instant(&self, index: f64) -> f64 {
        self.start + index / self.rate
    }

    /// The time from the first value to one interval after the last, in seconds.
    pub fn duration(&self) -> f64 {
        self.values.len() as f64 / self.rate
    }
}
