//! The low-pass that keeps the noise of a division within bounds.

use std::f64::consts::TAU;

use crate::Phasor;
use crate::phasor::at_turns;
use gumption_engine::number::elementary;

/// A low-pass of equal poles, 1/(1 + j f/f1)^order.
///
/// Its step response does not overshoot. f1 follows from the cut-off, at which the gain is 1/sqrt(2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LowPass {
    /// The frequency at which the gain is 1/sqrt(2).
    pub cutoff: Cutoff,
    /// The number of poles, 1 or more.
    pub order: u32,
    /// The delay that is taken off the filter's own, in seconds; none: it shifts no phase at all, so that only its
    /// gain is used.
    pub delay: Option<f64>,
}

/// Where the cut-off is from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cutoff {
    /// It is stated, in hertz.
    Stated(f64),
    /// It is that with which the variances by noise and by truncation have the smallest sum.
    Proposed,
}

impl LowPass {
    /// The gain at a frequency in hertz, with the cut-off in hertz.
    pub(super) fn gain(&self, cutoff: f64, hertz: f64) -> Phasor {
        let order = f64::from(self.order);
        // 2^(1/order) - 1 is the square of cut-off over corner
        let corner = cutoff / (elementary::pow(2.0, 1.0 / order) - 1.0).sqrt();
        let of_pole = hertz / corner;
        let modulus = elementary::pow(1.0 + of_pole * of_pole, -0.5 * order);
        match self.delay {
            None => Phasor::new(modulus, 0.0),
            Some(delay) => {
                let phase = -order * elementary::atan2(of_pole, 1.0);
                at_turns(phase / TAU + hertz * delay) * modulus
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The gain at the cut-off is 1/sqrt(2) by definition; with all of its delay left the filter is the power of one
    /// pole, computed here by complex division. Rounding of a few operations.
    #[test]
    fn gains_are_those_of_poles() {
        for order in 1..5 {
            let low_pass = LowPass { cutoff: Cutoff::Stated(50.0), order, delay: Some(0.0) };
            let corner = 50.0 / (2f64.powf(1.0 / f64::from(order)) - 1.0).sqrt();
            for hertz in [0.0, 10.0, 50.0, 400.0] {
                let pole = Phasor::new(1.0, 0.0) / Phasor::new(1.0, hertz / corner);
                let expected = pole.powu(order);
                assert!((low_pass.gain(50.0, hertz) - expected).norm_sqr() < 1e-28);
                let zero_phase = LowPass { delay: None, ..low_pass };
                let found = zero_phase.gain(50.0, hertz);
                assert!((found.re - expected.norm_sqr().sqrt()).abs() < 1e-14 && found.im == 0.0);
            }
            let at = low_pass.gain(50.0, 50.0).norm_sqr();
            assert!((at - 0.5).abs() < 1e-14, "{order}: {at}");
        }
    }
}
