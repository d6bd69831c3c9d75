//! The lines of a record's spectrum.

use crate::{Phasor, Signal, transform};

/// The lines from zero to half the sampling rate.
#[derive(Clone, Debug)]
pub(super) struct Lines {
    /// Samples of the record.
    pub(super) samples: usize,
    /// The distance of two lines, in hertz.
    pub(super) spacing: f64,
}

impl Lines {
    pub(super) fn of(signal: &Signal) -> Self {
        let samples = signal.values.len();
        Self { samples, spacing: signal.rate / samples as f64 }
    }

    /// Their number.
    pub(super) fn count(&self) -> usize {
        self.samples / 2 + 1
    }

    /// The frequency of a line, in hertz.
    pub(super) fn hertz(&self, line: usize) -> f64 {
        line as f64 * self.spacing
    }

    /// Whether a line is its own mirror image, so that its value is real: at zero and at half the rate.
    pub(super) fn is_real(&self, line: usize) -> bool {
        line == 0 || 2 * line == self.samples
    }

    /// How many lines of the whole spectrum it stands for.
    pub(super) fn weight(&self, line: usize) -> f64 {
        if self.is_real(line) { 1.0 } else { 2.0 }
    }

    /// The lines of the transform of values.
    pub(super) fn forward(&self, values: &[f64]) -> Vec<Phasor> {
        let mut spectrum = transform::forward(values);
        spectrum.truncate(self.count());
        spectrum
    }

    /// The values of lines.
    pub(super) fn inverse(&self, mut lines: Vec<Phasor>) -> Vec<f64> {
        lines.resize(self.samples, Phasor::new(0.0, 0.0));
        transform::inverse(lines)
    }
}
