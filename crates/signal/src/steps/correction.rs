//! A signal corrected in amplitude and phase for the response of what it came through
//! (D'Emilia et al., 2019, section 3.4).

use std::f64::consts::TAU;

use crate::rotation::Oscillation;
use crate::spectral::{Ends, multiplied};
use crate::{Changed, Filter, Measured, Phasor, Signal, Unsuitable, measured, phasor, wrapped};
use gumption_engine::decimal::significant;
use gumption_engine::number::Shortest;

/// A known complex response: what the chain multiplied a component's phasor by.
#[derive(Clone, Debug, PartialEq)]
pub enum Response {
    /// One gain and one delay in seconds at all frequencies; positive where the signal comes late.
    /// In the source the nominal over the calibrated sensitivity, and 15 deg at 0.5 Hz, 0.083 s.
    Delayed {
        /// Amplitude after over amplitude before.
        gain: f64,
        /// In seconds.
        delay: f64,
    },
    /// High-pass filters of first order in a row, of these corner frequencies in hertz: the source's
    /// model of an IEPE chain (0.1 Hz and 0.3 Hz): the product of i f / (i f + corner).
    HighPasses(Vec<f64>),
    /// A filter that was run.
    Filtered(Filter),
    /// Points of a calibration by rising frequency; between them the gain and the phase on a
    /// straight line (the phase by the shorter way round), beyond them the nearest point's. A recipe's
    /// frequencies must not lie beyond several; one alone holds everywhere.
    Points(Vec<ResponsePoint>),
}

/// A point of a calibration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ResponsePoint {
    /// In hertz.
    pub frequency: f64,
    /// Amplitude after over amplitude before.
    pub gain: f64,
    /// Phase after less phase before, in radians.
    pub phase: f64,
}

/// How far beyond its points a response may be taken, as a share of the frequency: the recording's own
/// frequency is not quite the nominal one of a point.
const BEYOND_POINTS: f64 = 0.01;

impl Response {
    /// Whether it is known at a frequency in hertz.
    ///
    /// # Errors
    /// The frequency lies beyond the points of the calibration, in words.
    pub fn reaches(&self, frequency: f64) -> Result<(), String> {
        let Self::Points(points) = self else { return Ok(()) };
        // one point alone holds everywhere
        let [first, .., last] = points.as_slice() else { return Ok(()) };
        let [low, high] = [first.frequency, last.frequency];
        if frequency >= low * (1.0 - BEYOND_POINTS) && frequency <= high * (1.0 + BEYOND_POINTS) {
            return Ok(());
        }
        Err(format!(
            "the points of `response` are from {} Hz to {} Hz, and the oscillation is at {} Hz; give a \
             point beyond it",
            Shortest(low),
            Shortest(high),
            significant(frequency, 6)
        ))
    }

    /// The complex gain at a frequency in hertz; one where there are no points.
    pub fn at(&self, frequency: f64) -> Phasor {
        match self {
            Self::Delayed { gain, delay } => phasor::at_turns(-frequency * delay) * *gain,
            Self::HighPasses(corners) => corners
                .iter()
                .map(|&corner| Phasor::new(0.0, frequency) / Phasor::new(corner, frequency))
                .product(),
            Self::Filtered(filter) => filter.response(frequency),
            Self::Points(points) => {
                let after = points.partition_point(|point| point.frequency <= frequency);
                let (gain, phase) = match (points[..after].last(), points.get(after)) {
                    (Some(a), Some(b)) => {
                        let part = (frequency - a.frequency) / (b.frequency - a.frequency);
                        let turned = wrapped(b.phase - a.phase);
                        (a.gain + part * (b.gain - a.gain), a.phase + part * turned)
                    }
                    (Some(end), None) | (None, Some(end)) => (end.gain, end.phase),
                    (None, None) => (1.0, 0.0),
                };
                phasor::at_turns(phase / TAU) * gain
            }
        }
    }
}

/// A correction.
#[derive(Clone, Debug, PartialEq)]
pub struct Correction {
    /// What the signal came through.
    pub response: Response,
    /// The frequencies that are corrected and kept, in hertz, the limits included; all others, with
    /// the mean unless the lower limit is zero, are taken out. A response that falls to nothing
    /// towards zero needs a lower limit, or it blows up what little came through.
    pub between: [f64; 2],
    /// What is done about leakage.
    pub ends: Ends,
}

impl Correction {
    /// The complex gain that a component's phasor is multiplied by, at a frequency in hertz. The mean is
    /// divided by the modulus alone where the response of its points has a phase other than 0 or 180 deg,
    /// which a mean cannot have.
    pub fn gain(&self, frequency: f64) -> Phasor {
        let response = self.response.at(frequency);
        let is_turned = frequency == 0.0 && response.im.abs() > 1e-12 * response.re.abs();
        let response =
            if is_turned { Phasor::new(phasor::modulus(response), 0.0) } else { response };
        let kept = frequency >= self.between[0] && frequency <= self.between[1];
        if kept && response.norm_sqr() > 0.0 { response.inv() } else { Phasor::new(0.0, 0.0) }
    }

    /// The signal divided by the response.
    ///
    /// # Errors
    /// What [`Ends`] does not fit the signal, values that are not finite.
    pub fn apply(&self, signal: &Signal) -> Result<Changed, Unsuitable> {
        multiplied(signal, self.ends, |f| self.gain(f))
    }
}

/// A component divided by a response that is known with uncertainty, all independent: relative
/// variances of amplitude and gain add up, and variances of phase (in radians) and phase shift.
pub fn corrected(
    amplitude: Measured,
    phase: Measured,
    gain: Measured,
    shift: Measured,
) -> Oscillation {
    let value = amplitude.value / gain.value;
    Oscillation {
        amplitude: measured::of_parts(
            value,
            &[
                ((amplitude.standard_uncertainty / gain.value).abs(), amplitude.degrees_of_freedom),
                ((value * gain.standard_uncertainty / gain.value).abs(), gain.degrees_of_freedom),
            ],
        ),
        phase: measured::of_parts(
            wrapped(phase.value - shift.value),
            &[
                (phase.standard_uncertainty, phase.degrees_of_freedom),
                (shift.standard_uncertainty, shift.degrees_of_freedom),
            ],
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::phasor::{angle, modulus};
    use crate::study::{SETTINGS, Setting, study};
    use crate::{Band, Butterworth, Harmonics, Noise, Periodic, RmsOf, improvement};

    const ALL: [f64; 2] = [0.0, f64::INFINITY];

    /// The source's chain, 0.1 Hz and 0.3 Hz in a row, at 0.5 Hz: arc tangents 11.31 deg and
    /// 30.96 deg of lead, gains 0.9806 and 0.8575. A sine that came through it is the sine again.
    #[test]
    fn sine_through_an_iepe_chain_is_recovered() {
        let response = Response::HighPasses(vec![0.1, 0.3]);
        let h = response.at(0.5);
        assert!((angle(h).to_degrees() - (11.309_932 + 30.963_757)).abs() < 1e-6);
        assert!((modulus(h) - 0.980_580_676 * 0.857_492_926).abs() < 1e-9);
        let wave = |p: Phasor, offset: f64| Signal {
            values: (0..777)
                .map(|k| {
                    let (sin, cos) = (TAU * 0.5 * f64::from(k) / 100.0).sin_cos();
                    offset + p.re * cos - p.im * sin
                })
                .collect(),
            rate: 100.0,
            start: 0.0,
        };
        let (reference, through) = (wave(Phasor::new(1.0, 0.0), 0.0), wave(h, 0.2));
        let harmonics = Harmonics { frequency: 0.5, count: 1 };
        let ends = Ends::Periodic(harmonics);
        let correction = Correction { response, between: [0.2, 20.0], ends };
        let after = correction.apply(&through).unwrap().signal;
        for (a, b) in after.values.iter().zip(&reference.values) {
            assert!((a - b).abs() < 1e-11);
        }
        let of = RmsOf { harmonics: Some(harmonics), noise: Noise::White, resolution: 0.0 };
        let found = improvement(&reference, &through, &after, of).unwrap();
        // before: the moduli's law, |h - 1| / sqrt(2)
        assert!((found.before.value - modulus(h - 1.0) / 2f64.sqrt()).abs() < 1e-11);
        assert!(found.reduction.value > 1.0 - 1e-10);
    }

    #[test]
    fn points_reach_no_further_than_they_go() {
        let point = |frequency| ResponsePoint { frequency, gain: 0.5, phase: 0.0 };
        let of = Response::Points(vec![point(5.0), point(8.0)]);
        for within in [4.96, 5.0, 6.0, 8.0, 8.05] {
            assert_eq!(of.reaches(within), Ok(()));
        }
        for beyond in [4.9, 8.1, 10.0] {
            assert!(of.reaches(beyond).unwrap_err().contains("from 5 Hz to 8 Hz"));
        }
        for everywhere in [Response::HighPasses(vec![0.1]), Response::Points(vec![point(5.0)])] {
            assert_eq!(everywhere.reaches(1e6), Ok(()));
        }
    }

    /// A mean of 1 stays 1 behind a sensor whose phase is known at one frequency, and changes its sign
    /// with a sensor that does.
    #[test]
    fn the_mean_has_no_phase() {
        let signal = Signal {
            values: (0..1000).map(|k| 1.0 + (TAU * 0.05 * f64::from(k)).sin()).collect(),
            rate: 100.0,
            start: 0.0,
        };
        for (degrees, mean) in [(0.0, 0.5), (40.0, 0.5), (90.0, 0.5), (180.0, -0.5)] {
            let point =
                ResponsePoint { frequency: 5.0, gain: 2.0, phase: f64::to_radians(degrees) };
            let response = Response::Points(vec![point]);
            let correction = Correction { response, between: ALL, ends: Ends::WholePeriods };
            let values = correction.apply(&signal).unwrap().signal.values;
            let found = values.iter().sum::<f64>() / 1000.0;
            // rounding of a thousand values alone
            assert!((found - mean).abs() < 1e-12, "{degrees} deg: {found}");
        }
    }

    /// A correction for a filter undoes it within the band; one for a delay moves the signal.
    #[test]
    fn corrections_undo_filters_and_delays() {
        let filter = Butterworth { band: Band::LowPass(40.0), poles: 6, both_ways: false };
        let filter = filter.at(1000.0).unwrap();
        let wave = |delay: f64| Signal {
            values: (0..2000)
                .map(|k| {
                    let t = f64::from(k) / 1000.0 - delay;
                    (TAU * 5.0 * t).cos() + 0.2 * (TAU * 20.0 * t + 1.0).cos() + 3.0
                })
                .collect(),
            rate: 1000.0,
            start: 0.0,
        };
        let filtered = filter.apply(&wave(0.0), 1e-9);
        let settled = filtered.settled().unwrap();
        let first = filtered.settling;
        let response = Response::Filtered(filter);
        let ends = Ends::Periodic(Harmonics { frequency: 5.0, count: 4 });
        let correction = Correction { response, between: ALL, ends };
        let correction = Correction { between: [0.0, 60.0], ..correction };
        let back = correction.apply(&settled).unwrap().signal;
        for (k, value) in back.values.iter().enumerate() {
            // what is left of the filter's start, 1e-9, grows a hundredfold up to 60 Hz
            assert!((value - wave(0.0).values[first + k]).abs() < 1e-7);
        }
        let late = Response::Delayed { gain: 2.0, delay: 0.0123 };
        let correction = Correction { response: late, between: ALL, ends: Ends::WholePeriods };
        let back = correction.apply(&wave(0.0123)).unwrap().signal;
        for (a, b) in back.values.iter().zip(&wave(0.0).values) {
            assert!((2.0 * a - b).abs() < 1e-11);
        }
    }

    #[test]
    fn points_are_joined_by_straight_lines() {
        let point = |frequency, gain, phase| ResponsePoint { frequency, gain, phase };
        let points = Response::Points(vec![point(1.0, 1.0, 3.0), point(2.0, 2.0, -3.0)]);
        let h = points.at(1.5);
        assert!((modulus(h) - 1.5).abs() < 1e-15);
        // from 3 rad on to 2 pi - 3 rad: by way of pi
        assert!((angle(h).abs() - std::f64::consts::PI).abs() < 1e-12);
        assert_eq!(points.at(0.1), points.at(1.0));
        assert_eq!(points.at(9.0), points.at(2.0));
    }

    /// Amplitude and phase after the correction: noise of the recording, and a response that was
    /// measured with an error of its own.
    fn judge(setting: Setting, recordings: usize) {
        let harmonics = Harmonics { frequency: setting.frequency, count: 1 };
        let known = |value, standard_uncertainty| Measured {
            value,
            standard_uncertainty,
            degrees_of_freedom: f64::INFINITY,
        };
        for of_phase in [false, true] {
            study("correction", recordings, |noise| {
                let phase = 6.0 * noise.uniform();
                let signal = setting.record(noise, setting.sine(phase));
                let fitted = Periodic::fit(&signal, harmonics).unwrap();
                let fitted = fitted.rounded_to(setting.step());
                let part = fitted.parts[0];
                let gain = known(0.8 * (1.0 + 1e-4 * noise.next()), 0.8e-4);
                let shift = known(0.3 + 1e-4 * noise.next(), 1e-4);
                let found = corrected(part.amplitude(), part.phase(), gain, shift);
                if of_phase {
                    let truth = TAU * setting.frequency * fitted.middle + phase - 0.3;
                    let error = wrapped(found.phase.value - truth);
                    (Measured { value: error, ..found.phase }, 0.0)
                } else {
                    (found.amplitude, 1.0 / 0.8)
                }
            })
            .is_right(&format!("correction, phase {of_phase}"), Some(setting));
        }
    }

    #[test]
    fn uncertainty_is_right_quick() {
        judge(SETTINGS[0], 200);
        judge(SETTINGS[3], 200);
    }

    #[test]
    #[ignore = "heavy: run by .ci/extra"]
    fn uncertainty_is_right() {
        for setting in SETTINGS {
            judge(setting, 1000);
        }
    }
}
