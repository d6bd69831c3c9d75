//! The steps of a channel: what is done with its signal before amplitudes are taken.

use super::Measured;
use super::Signal;
use super::whole_periods::whole_periods;

/// A step of a channel, with its parameters.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// The mean is taken off.
    RemoveMean,
    /// The straight line of least squares is taken off.
    RemoveTrend,
    /// Only a whole number of periods of the recipe's frequency is kept, between zero crossings.
    WholePeriods,
}

/// What a step may use beside its signal.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a> {
    /// The recipe's frequency, in hertz; the first where there are several, 0 where it is unknown.
    pub frequency: f64,
    /// The signal of the reference channel, after its own steps.
    pub reference: Option<&'a Signal>,
}

/// What a step found beside the signal that it hands on.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What it is: `sampling rate`.
    pub name: String,
    /// Its unit: `Hz`.
    pub unit: String,
    /// The value.
    pub value: Measured,
}

/// A signal after a step, and what the step found.
#[derive(Clone, Debug, PartialEq)]
pub struct Stepped {
    /// The signal.
    pub signal: Signal,
    /// What was found.
    pub findings: Vec<Finding>,
}

impl Step {
    /// Whether it looks at the reference channel.
    pub(super) fn needs_reference(&self) -> bool {
        match self {
            Self::RemoveMean | Self::RemoveTrend | Self::WholePeriods => false,
        }
    }

    /// Does the step.
    ///
    /// # Errors
    /// A sentence on why it cannot be done with this signal.
    pub fn apply(&self, signal: Signal, surroundings: Surroundings<'_>) -> Result<Stepped, String> {
        let only = |signal| Ok(Stepped { signal, findings: Vec::new() });
        match self {
            Self::RemoveMean => only(without_line(signal, false)),
            Self::RemoveTrend => only(without_line(signal, true)),
            Self::WholePeriods => {
                let cycles = surroundings.frequency / signal.rate;
                let part = whole_periods(&signal.values, cycles).ok_or_else(|| {
                    "there is not one whole period between zero crossings".to_owned()
                })?;
                let values = signal.values.get(part.first..part.first + part.samples);
                let start = signal.instant(part.first as f64);
                only(Signal { values: values.unwrap_or(&[]).to_vec(), start, ..signal })
            }
        }
    }
}

/// The signal less its mean, or less its straight line of least squares.
fn without_line(mut signal: Signal, trend: bool) -> Signal {
    let count = signal.values.len().max(1) as f64;
    let mean = signal.values.iter().sum::<f64>() / count;
    let middle = (count - 1.0) / 2.0;
    let moment: f64 =
        signal.values.iter().enumerate().map(|(i, v)| (i as f64 - middle) * (v - mean)).sum();
    let squares = count * (count * count - 1.0) / 12.0;
    let slope = if trend && squares > 0.0 { moment / squares } else { 0.0 };
    for (i, value) in signal.values.iter_mut().enumerate() {
        *value -= mean + slope * (i as f64 - middle);
    }
    signal
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALONE: Surroundings<'_> = Surroundings { frequency: 10.0, reference: None };

    #[test]
    fn lines_and_part_periods_go() {
        let signal = |values: Vec<f64>| Signal { values, rate: 1000.0, start: 2.0 };
        let line = signal((0..100).map(|i| 3.0 + 0.5 * f64::from(i)).collect());
        let flat = Step::RemoveTrend.apply(line.clone(), ALONE).unwrap().signal;
        assert!(flat.values.iter().all(|v| v.abs() < 1e-12));
        let centred = Step::RemoveMean.apply(line, ALONE).unwrap().signal;
        assert!((centred.values[0] + 24.75).abs() < 1e-12);
        let sine = (0..1050).map(|i| (0.02 * std::f64::consts::PI * f64::from(i) - 1.0).sin());
        let whole = Step::WholePeriods.apply(signal(sine.collect()), ALONE).unwrap().signal;
        // crossings at 1/(0.02 pi) = 15.9 and 10 periods of 100 samples later; the mean of the half
        // period too much, 0.03, moves them by half a sample
        assert_eq!(whole.values.len(), 1000);
        assert!((whole.start - 2.0165).abs() < 0.001, "{}", whole.start);
    }
}
