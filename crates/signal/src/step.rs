//! The steps of a channel: what is done with its signal before amplitudes are taken.

use super::channel_step::ChannelStep;
use super::effects::StepEffect;
use super::found;
use super::surroundings::{Finding, Surroundings};
use super::through::Through;
use super::whole_periods::whole_periods;
use super::{Correction, Derivative, Measured, Periodic, Response, Rotation, Signal};

/// What may be left of a filter's start, of the signal's greatest distance from its mean.
const TRANSIENT: f64 = 1e-6;

/// A signal after a step, and what the step found.
#[derive(Clone, Debug, PartialEq)]
pub struct Stepped {
    /// The signal.
    pub signal: Signal,
    /// What was found.
    pub findings: Vec<Finding>,
    /// What it did to oscillations and noise, where it did.
    pub effect: Option<StepEffect>,
}

impl ChannelStep {
    /// Does the step.
    ///
    /// # Errors
    /// A sentence on why it cannot be done with this signal.
    pub fn apply(&self, signal: Signal, surroundings: Surroundings<'_>) -> Result<Stepped, String> {
        self.apply_after(signal, surroundings, [None, None])
    }

    /// The same with the steps that the reference and the signal have already gone through.
    pub(super) fn apply_after(
        &self,
        signal: Signal,
        surroundings: Surroundings<'_>,
        through: [Option<&Through>; 2],
    ) -> Result<Stepped, String> {
        let only = |signal| Ok(Stepped { signal, findings: Vec::new(), effect: None });
        match self {
            Self::RemoveMean => only(without_mean(signal)),
            Self::RemoveTrend => only(without_trend(signal, surroundings)),
            Self::WholePeriods => {
                let cycles = surroundings.frequency / signal.rate;
                let part = whole_periods(&signal.values, cycles).ok_or_else(|| {
                    "there is not one whole period between zero crossings".to_owned()
                })?;
                let values = signal.values.get(part.first..part.first + part.samples);
                let start = signal.instant(part.first as f64);
                only(Signal { values: values.unwrap_or(&[]).to_vec(), start, ..signal })
            }
            Self::Filter { filter, correct } => {
                let said = |error: super::Unsuitable| error.to_string();
                let filter = filter.at(signal.rate).map_err(said)?;
                let after = filter.apply(&signal, TRANSIENT);
                let cut = after.settling + after.unsettling;
                let signal = after.settled().map_err(|_| {
                    format!(
                        "the filter needs {cut} of the {} values until its start is forgotten; the \
                         recording is too short for it",
                        signal.values.len()
                    )
                })?;
                let effect = Some(StepEffect::Filtered { filter, correct: *correct });
                Ok(Stepped { signal, findings: Vec::new(), effect })
            }
            Self::Derivative { order, highest, factor } => {
                let ends = surroundings.ends(&signal)?;
                let highest = highest.unwrap_or_else(|| surroundings.highest());
                let derivative = Derivative { order: *order, highest, ends };
                let after = derivative.apply(&signal).map_err(|error| error.to_string())?;
                let effect = StepEffect::Derived { derivative, factor: *factor, of_radius: 0.0 };
                Ok(after.signal.scaled(*factor, effect))
            }
            Self::Rotation { radial, radius, highest, radians, factor } => {
                let ends = surroundings.ends(&signal)?;
                let highest = highest.unwrap_or_else(|| surroundings.highest());
                let frequency = Measured { value: surroundings.frequency, ..*radius };
                let rotation = Rotation { radius: *radius, frequency };
                let mut angle = signal;
                angle.values.iter_mut().for_each(|value| *value *= radians);
                let [tangential, of_radius] =
                    rotation.signals(&angle, highest, ends).map_err(|error| error.to_string())?;
                let known = (radius.standard_uncertainty / radius.value).abs();
                let derivative = |order| Derivative { order, highest, ends };
                let factor_of_radius = factor * radius.value;
                if *radial {
                    let values = &of_radius.signal.values;
                    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
                    // of a square of a sine the mean is half of the peak
                    let speed = (2.0 * mean / radius.value).max(0.0).sqrt();
                    let effect = StepEffect::Squared {
                        derivative: derivative(1),
                        factor: factor_of_radius * radians,
                        of_radius: known,
                        speed,
                        frequency: surroundings.frequency,
                    };
                    Ok(of_radius.signal.scaled(*factor, effect))
                } else {
                    let effect = StepEffect::Derived {
                        derivative: derivative(2),
                        factor: factor_of_radius * radians,
                        of_radius: known,
                    };
                    Ok(tangential.signal.scaled(*factor, effect))
                }
            }
            Self::Correct { response, of_gain, of_phase, of_delay } => {
                let ends = surroundings.ends(&signal)?;
                response.reaches(surroundings.frequency)?;
                // what a high-pass took out near zero does not come back
                let lowest = match response {
                    Response::HighPasses(_) => surroundings.frequency / 2.0,
                    _ => 0.0,
                };
                let between = [lowest, f64::INFINITY];
                let correction = Correction { response: response.clone(), between, ends };
                let after = correction.apply(&signal).map_err(|error| error.to_string())?;
                let effect = Some(StepEffect::Corrected {
                    correction,
                    of_gain: *of_gain,
                    of_phase: *of_phase,
                    of_delay: *of_delay,
                });
                let findings = match surroundings.reference {
                    Some(reference) => {
                        found::nearer(reference, &signal, &after.signal, surroundings)
                    }
                    None => Vec::new(),
                };
                Ok(Stepped { signal: after.signal, findings, effect })
            }
            Self::Delay { segments } => {
                let reference = surroundings.reference.ok_or("there is no reference signal")?;
                let findings = found::delay(reference, &signal, surroundings, *segments, through)?;
                Ok(Stepped { signal, findings, effect: None })
            }
            Self::Rms => {
                let findings = found::rms(&signal, surroundings, through[1])?;
                Ok(Stepped { signal, findings, effect: None })
            }
        }
    }
}

impl Signal {
    fn scaled(mut self, factor: f64, effect: StepEffect) -> Stepped {
        self.values.iter_mut().for_each(|value| *value *= factor);
        Stepped { signal: self, findings: Vec::new(), effect: Some(effect) }
    }
}

/// The signal less its mean.
pub(super) fn without_mean(mut signal: Signal) -> Signal {
    let mean = signal.values.iter().sum::<f64>() / signal.values.len().max(1) as f64;
    signal.values.iter_mut().for_each(|value| *value -= mean);
    signal
}

/// The signal less its straight line of least squares, fitted together with the oscillation and its
/// multiples where they are one: part of a period has a slope of its own, and a line that took it
/// would leave of the oscillation what looks like noise.
fn without_trend(mut signal: Signal, surroundings: Surroundings<'_>) -> Signal {
    let middle = (signal.values.len() as f64 - 1.0) / 2.0;
    let line = Signal {
        values: (0..signal.values.len()).map(|i| i as f64 - middle).collect(),
        ..signal.clone()
    };
    let rest = |signal: &Signal| match Periodic::fit(signal, surroundings.harmonics(signal)) {
        Ok(periodic) if surroundings.frequencies == 1 => periodic.without(signal),
        // no period to tell from a line, or several frequencies
        _ => without_mean(signal.clone()).values,
    };
    let (of_line, of_signal) = (rest(&line), rest(&signal));
    let squares: f64 = of_line.iter().map(|t| t * t).sum();
    let moment: f64 = of_line.iter().zip(&of_signal).map(|(t, y)| t * y).sum();
    let slope = if squares > 0.0 { moment / squares } else { 0.0 };
    for (value, t) in signal.values.iter_mut().zip(&line.values) {
        *value -= slope * t;
    }
    without_mean(signal)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALONE: Surroundings<'_> = Surroundings {
        frequency: 10.0,
        frequencies: 1,
        multiples: 5,
        reference: None,
        resolution: 0.0,
    };

    #[test]
    fn lines_and_part_periods_go() {
        let signal = |values: Vec<f64>| Signal { values, rate: 1000.0, start: 2.0 };
        let line = signal((0..100).map(|i| 3.0 + 0.5 * f64::from(i)).collect());
        let flat = ChannelStep::RemoveTrend.apply(line.clone(), ALONE).unwrap().signal;
        assert!(flat.values.iter().all(|v| v.abs() < 1e-12));
        let centred = ChannelStep::RemoveMean.apply(line, ALONE).unwrap().signal;
        assert!((centred.values[0] + 24.75).abs() < 1e-12);
        let sine = (0..1050).map(|i| (0.02 * std::f64::consts::PI * f64::from(i) - 1.0).sin());
        let whole = ChannelStep::WholePeriods.apply(signal(sine.collect()), ALONE).unwrap().signal;
        // crossings at 1/(0.02 pi) = 15.9 and 10 periods of 100 samples later; the mean of the half
        // period too much, 0.03, moves them by half a sample
        assert_eq!(whole.values.len(), 1000);
        assert!((whole.start - 2.0165).abs() < 0.001, "{}", whole.start);
    }
}
