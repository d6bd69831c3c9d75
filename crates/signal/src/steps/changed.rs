//! A signal that a step has changed.

use crate::{Signal, Unsuitable};

/// A signal after a step, value by value at the instants of the signal before it.
#[derive(Clone, Debug, PartialEq)]
pub struct Changed {
    /// The values. A delay that the step causes is in them.
    pub signal: Signal,
    /// So many values at the start still feel the start.
    pub settling: usize,
    /// So many values at the end feel the end.
    pub unsettling: usize,
}

impl Changed {
    /// The signal without the values that feel its ends.
    ///
    /// # Errors
    /// Nothing is left.
    pub fn settled(&self) -> Result<Signal, Unsuitable> {
        let samples = self.signal.values.len();
        let needed = self.settling + self.unsettling + 1;
        if samples < needed {
            return Err(Unsuitable::TooShort { samples, needed });
        }
        Ok(Signal {
            values: self.signal.values[self.settling..samples - self.unsettling].to_vec(),
            rate: self.signal.rate,
            start: self.signal.instant(self.settling as f64),
        })
    }
}
