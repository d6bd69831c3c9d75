//! What a low-pass takes away of a signal: a bound from a bound on the signal's spectrum.

use super::spectrum::Lines;
use crate::Phasor;

/// How far a line must stand above the root mean square of its noise to tell the size of the spectrum.
const ABOVE_NOISE: f64 = 4.0;

/// What is known of the part of the signal that the low-pass takes away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Truncation {
    /// The signal has nothing there.
    Nothing,
    /// At no instant it is greater than this, in the unit of the answer.
    Bound(f64),
    /// The spectrum falls at least with a power of the frequency; the octave above `from` tells its size.
    Decay {
        /// From this frequency on, in hertz.
        from: f64,
        /// The power, above 1.
        power: f64,
    },
}

/// A bound on what is missing.
#[derive(Clone, Debug)]
pub(super) enum Missing {
    /// On its size at each instant.
    AtInstants(f64),
    /// On the modulus of each line's part of the signal, and the sum of those above half the sampling rate.
    AtLines(Vec<f64>, f64),
}

/// A bound on the lines of the signal.
pub(super) struct SpectrumBound {
    moduli: Vec<f64>,
    /// The sum over the lines above half the sampling rate, of which a low-pass leaves nothing.
    above: f64,
}

impl SpectrumBound {
    /// Below `from` the spectrum is what the record says; above it, the smallest power law that no line of the octave
    /// above `from` exceeds which stands above its noise. `spectrum` are the lines of the corrected signal without a low-pass, `noise` the root
    /// mean square of their noise.
    ///
    /// # Errors
    /// No line stands above the noise.
    pub(super) fn of(
        (from, power): (f64, f64),
        spectrum: &[Phasor],
        noise: impl Fn(usize) -> f64,
        lines: &Lines,
    ) -> Result<Self, String> {
        let size = |line: usize| spectrum[line].norm_sqr().sqrt();
        let law = |hertz: f64| gumption_engine::number::elementary::pow(from / hertz, power);
        let is_above = |line: usize| lines.hertz(line) >= from && line > 0;
        let tells = |line: usize| {
            is_above(line)
                && lines.hertz(line) <= 2.0 * from
                && size(line) > ABOVE_NOISE * noise(line)
        };
        let level = (0..lines.count())
            .filter(|line| tells(*line))
            .map(|line| size(line) / law(lines.hertz(line)))
            .fold(0.0, f64::max);
        if level == 0.0 {
            return Err(format!(
                "no line of the spectrum from {from} Hz to {} Hz stands above {ABOVE_NOISE} times its noise, so that it does \
                 not tell how large the signal is there: let `from` be lower, or state a `bound`",
                2.0 * from
            ));
        }
        let modulus =
            |line| if is_above(line) { level * law(lines.hertz(line)) } else { size(line) };
        let moduli = (0..lines.count()).map(modulus).collect();
        let top = lines.hertz(lines.count() - 1).max(from);
        let above = level * law(top) * top / (power - 1.0) / lines.spacing;
        Ok(Self { moduli, above })
    }

    /// What a low-pass with these gains takes away.
    pub(super) fn missing(&self, gain: impl Fn(usize) -> Phasor) -> Missing {
        let one = Phasor::new(1.0, 0.0);
        let lost = self.moduli.iter().enumerate();
        let lost =
            lost.map(|(line, modulus)| (one - gain(line)).norm_sqr().sqrt() * modulus).collect();
        Missing::AtLines(lost, self.above)
    }
}

impl Missing {
    /// The greatest size at any instant.
    pub(super) fn size(&self, lines: &Lines) -> f64 {
        match self {
            Self::AtInstants(bound) => *bound,
            Self::AtLines(moduli, above) => {
                let sum: f64 =
                    moduli.iter().enumerate().map(|(line, m)| lines.weight(line) * m).sum();
                (sum + 2.0 * above) / lines.samples as f64
            }
        }
    }

    /// The greatest change of a figure with the sensitivity coefficients g(n), whose sums of
    /// g(n) exp(2 pi i k n/N) are `transformed`. A figure that is a value of the signal changes by no more than the
    /// bound at its instant.
    pub(super) fn change(
        &self,
        (sensitivity, is_value): (&[f64], bool),
        transformed: &[Phasor],
        lines: &Lines,
    ) -> f64 {
        match self {
            Self::AtInstants(bound) if is_value => *bound,
            Self::AtInstants(bound) => bound * sensitivity.iter().map(|g| g.abs()).sum::<f64>(),
            Self::AtLines(moduli, above) => {
                let size = |of: &Phasor| of.norm_sqr().sqrt();
                let each = moduli.iter().zip(transformed).enumerate();
                let sum: f64 = each.map(|(line, (m, g))| lines.weight(line) * m * size(g)).sum();
                let last = transformed.last().map_or(0.0, size);
                (sum + 2.0 * above * last) / lines.samples as f64
            }
        }
    }
}
