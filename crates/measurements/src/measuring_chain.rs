//! The frequency response of a measuring chain of first-order filters.

use std::f64::consts::TAU;

use gumption_engine::measurement;
use gumption_engine::model::typed::{Complex, Equations};
use gumption_engine::number::Number;

measurement! {
    /// Amplitude ratio, phase and delay of a measuring chain: high-pass filters of sensor and
    /// amplifier, AC coupling of the acquisition, low-pass of the sensor, all of first order.
    ///
    /// A high-pass stage of cut-off frequency f_c has the response 1 / (1 - i f_c / f), a low-pass
    /// stage 1 / (1 + i f / f_c); the stages' responses are multiplied. A stage that is left out
    /// has the cut-off frequency 0 (high-pass) or infinity (low-pass) and the response 1.
    ///
    /// The phase is positive where the output leads the acceleration, as high-pass stages make it.
    /// The delay has the other sign: it is positive where the output comes later,
    /// delay = -phase / (360 deg frequency), with the sum of the stages' phases, so that it does
    /// not jump where the phase of the product passes 180 deg. A lead of 15 deg at 0.5 Hz is a
    /// delay of -0.0833 s. The frequency must not be 0.
    pub MeasuringChain as "measuring-chain"
        from "D'Emilia, Gaspari, Natale (2019), section 3.1 and Figures 4-6";
    inputs {
        /// Frequency of the oscillation.
        frequency: "Hz",
        /// Cut-off frequency of the first high-pass filter (sensor).
        high_pass_1: "Hz" or 0.0,
        /// Cut-off frequency of the second high-pass filter (amplifier).
        high_pass_2: "Hz" or 0.0,
        /// Cut-off frequency of the AC coupling of the acquisition, a high-pass filter.
        ac_coupling: "Hz" or 0.0,
        /// Cut-off frequency of the low-pass filter (sensor).
        low_pass: "Hz" or f64::INFINITY,
    }
    outputs MeasuringChainResponse {
        /// Ratio of the amplitudes of output and acceleration, relative to the pass band.
        gain: "1" = "|product of 1 / (1 - i high_pass / frequency), 1 / (1 + i frequency / \
            low_pass)|",
        /// Phase of the output relative to the acceleration, positive where the output leads.
        phase: "deg" = "arg of the same product" periodic 360.0,
        /// Delay of the output, positive where it comes later.
        delay: "s" = "(atan(frequency / low_pass) - sum of atan(high_pass / frequency)) / (2 pi \
            frequency)",
    }
}

/// 1 / (1 + i x)
fn first_order<T: Number>(x: T) -> Complex<T> {
    let square = x.square() + 1.0;
    Complex { re: T::constant(1.0) / square, im: -(x / square) }
}

impl<T: Number> Equations<T> for MeasuringChain<T> {
    type Outputs = MeasuringChainResponse<T>;

    fn equations(self) -> Self::Outputs {
        let f = self.frequency;
        let stages = [
            -(self.high_pass_1 / f),
            -(self.high_pass_2 / f),
            -(self.ac_coupling / f),
            f / self.low_pass,
        ];
        let response = stages
            .into_iter()
            .fold(Complex::real(T::constant(1.0)), |product, x| product * first_order(x));
        let lag = stages.into_iter().fold(T::constant(0.0), |lag, x| lag + x.atan());
        MeasuringChainResponse {
            gain: response.modulus(),
            phase: response.phase(),
            delay: lag / (f * TAU),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gumption_engine::model::typed::Typed;

    const INFINITY: f64 = f64::INFINITY;

    fn chain(frequency: f64, high: [f64; 3], low_pass: f64) -> MeasuringChainResponse<f64> {
        let [high_pass_1, high_pass_2, ac_coupling] = high;
        MeasuringChain { frequency, high_pass_1, high_pass_2, ac_coupling, low_pass }.equations()
    }

    /// 0.1 Hz and 0.3 Hz in cascade at 1 Hz, evaluated with 40 digits from the moduli and angles of
    /// the stages one by one.
    #[test]
    fn cascade_of_two_high_pass_filters() {
        let response = chain(1.0, [0.1, 0.3, 0.0], INFINITY);
        assert!((response.gain - 0.953_072_775_555_726_1).abs() < 1e-15);
        assert!((response.phase.to_degrees() - 22.409_837_371_493_264).abs() < 1e-13);
    }

    /// At its cut-off frequency a stage has the gain 1/sqrt(2) and 45 deg.
    #[test]
    fn single_stages_at_their_cut_off() {
        for (response, degrees) in
            [(chain(0.5, [0.0, 0.0, 0.5], INFINITY), 45.0), (chain(60.0, [0.0; 3], 60.0), -45.0)]
        {
            assert!((response.gain - std::f64::consts::FRAC_1_SQRT_2).abs() < 1e-15);
            assert!((response.phase.to_degrees() - degrees).abs() < 1e-13);
        }
    }

    /// The source prints 0.084 s for 15 deg at 0.5 Hz; 15/360/0.5 s is 0.0833 s.
    #[test]
    fn fifteen_degrees_at_half_a_hertz() {
        let cut_off = 0.5 * 15f64.to_radians().tan();
        let response = chain(0.5, [cut_off, 0.0, 0.0], INFINITY);
        assert!((response.phase.to_degrees() - 15.0).abs() < 1e-13);
        assert!((response.delay + 1.0 / 12.0).abs() < 1e-15);
    }

    /// Three stages far below their cut-off lead by nearly 270 deg: the phase of the product is on
    /// another branch, the delay is that of the sum.
    #[test]
    fn delay_does_not_jump_with_the_branch_of_the_phase() {
        let response = chain(0.01, [1.0, 1.0, 1.0], INFINITY);
        let lead = 3.0 * 100f64.atan();
        assert!((response.delay + lead / (TAU * 0.01)).abs() < 1e-12);
        assert!((response.phase + TAU - lead).abs() < 1e-14);
    }

    #[test]
    fn absent_stages_have_finite_derivatives() {
        let model = Typed::of::<MeasuringChain<()>>().model().unwrap();
        let at = [2.0, 0.0, 0.0, 0.0, INFINITY];
        let (values, gradients) = model.program.gradients(&at);
        assert_eq!(values, [1.0, 0.0, 0.0]);
        assert!(gradients.iter().flatten().all(|c| c.is_finite()), "{gradients:?}");
        // d(phase)/d(cut-off) of an absent high-pass stage is 1/f, here in degrees per hertz
        assert!((gradients[1][1] - 0.5f64.to_degrees()).abs() < 1e-13);
        assert_eq!(model.program.first_undefined(&at), None);
    }
}
