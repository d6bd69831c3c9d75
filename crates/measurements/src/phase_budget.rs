//! The phase of a measuring chain, with what limits its observation.

use std::f64::consts::TAU;

use gumption_engine::measurement;
use gumption_engine::model::typed::Equations;
use gumption_engine::number::Number;

measurement! {
    /// Phase of a sensor's output relative to the reference, with the contributions of the source's
    /// Table 3: repeatability, resolution of the sampling, phase of the reference.
    ///
    /// A delay is found in whole samples, so it is known within one sampling interval: `resolution`
    /// is uniform within half a sample to either side, rectangular with half width 0.5, and one
    /// sample is 360 deg frequency / sampling_rate. Its standard uncertainty is
    /// 360 deg frequency / (sampling_rate sqrt(12)), given beside as `u_resolution`.
    pub PhaseBudget as "phase-budget"
        from "D'Emilia, Gaspari, Natale (2019), section 2.4 and Table 3";
    inputs {
        /// Observed phase of the output relative to the reference, a mean over repetitions.
        observed: "deg",
        /// Frequency of the oscillation.
        frequency: "Hz",
        /// Sampling rate.
        sampling_rate: "Hz",
        /// Deviation of the mean between repetitions, expectation 0.
        repeatability: "deg" or 0.0,
        /// Deviation by the sampling, in samples, expectation 0.
        resolution: "1" or 0.0,
        /// Phase deviation of the reference instrument, expectation 0.
        reference: "deg" or 0.0,
    }
    outputs PhaseBudgetResult {
        /// Phase of the output relative to the reference.
        phase: "deg" = "observed + repeatability + resolution*360 [deg]*frequency/sampling_rate + \
            reference" periodic 360.0,
        /// Standard uncertainty by the resolution.
        u_resolution: "deg" = "360 [deg]*frequency/(sampling_rate*sqrt(12))",
    }
}

impl<T: Number> Equations<T> for PhaseBudget<T> {
    type Outputs = PhaseBudgetResult<T>;

    fn equations(self) -> Self::Outputs {
        let sample = self.frequency / self.sampling_rate * TAU;
        PhaseBudgetResult {
            phase: self.observed + self.repeatability + self.resolution * sample + self.reference,
            u_resolution: sample / 12f64.sqrt(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gumption_engine::model::typed::Typed;

    /// The sensitivity to a deviation of half width 0.5, standard uncertainty 0.5/sqrt(3), gives
    /// the formula of the source.
    #[test]
    fn resolution() {
        let model = Typed::of::<PhaseBudget<()>>().model().unwrap();
        let (values, gradients) = model.program.gradients(&[15.0, 0.5, 2000.0, 0.0, 0.0, 0.0]);
        assert!((values[0] - 15.0).abs() < 1e-14);
        let expected = 360.0 * 0.5 / (2000.0 * 12f64.sqrt());
        assert!((values[1] - expected).abs() < 1e-15);
        assert!((gradients[0][4] * 0.5 / 3f64.sqrt() - expected).abs() < 1e-15);
    }
}
