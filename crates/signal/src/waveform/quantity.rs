//! Figures of a waveform: its peaks and their times, durations and integrals, with their sensitivity coefficients to
//! the values of the signal.

use super::corrected::WaveformSource;
use crate::Signal;

/// A figure of a waveform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WaveformQuantity {
    /// The greatest value: the vertex of the parabola through the greatest sample and its neighbours.
    Maximum,
    /// The least value, likewise.
    Minimum,
    /// The instant of the greatest value, in seconds.
    MaximumTime,
    /// The instant of the least value, in seconds.
    MinimumTime,
    /// The time between the last crossing of a level before the greatest value and the first after it, in seconds;
    /// straight lines between samples.
    Duration {
        /// The level, of the greatest value, between 0 and 1.
        level: f64,
    },
    /// The integral over time, by trapezoids.
    Integral {
        /// Its first and last instant, in seconds; none: those of the record.
        between: Option<[f64; 2]>,
    },
    /// The integral of the square over time, by trapezoids.
    SquaredIntegral {
        /// Its first and last instant, in seconds; none: those of the record.
        between: Option<[f64; 2]>,
    },
    /// The greatest value over that of another channel.
    Ratio {
        /// The other channel, by its place in the recipe.
        channel: usize,
    },
}

/// A figure with its budget.
#[derive(Clone, Debug, PartialEq)]
pub struct QuantityFound {
    /// Its name.
    pub name: String,
    /// Which.
    pub quantity: WaveformQuantity,
    /// Its value.
    pub value: f64,
    /// The contributions to its standard uncertainty.
    pub contributions: Vec<(WaveformSource, f64)>,
    /// Its values in the trials, rising; none where there are no trials.
    pub trials: Vec<f64>,
    /// Its values in the trials, by their numbers.
    pub(super) drawn: Vec<f64>,
}

/// A value and its sensitivity coefficients to samples.
#[derive(Clone, Debug)]
pub(super) struct Sensitive {
    pub(super) value: f64,
    pub(super) coefficients: Vec<(usize, f64)>,
    /// Its change by a relative change of the sampling rate.
    pub(super) per_rate: f64,
}

impl WaveformQuantity {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Maximum => "maximum",
            Self::Minimum => "minimum",
            Self::MaximumTime => "maximum-time",
            Self::MinimumTime => "minimum-time",
            Self::Duration { .. } => "duration",
            Self::Integral { .. } => "integral",
            Self::SquaredIntegral { .. } => "squared-integral",
            Self::Ratio { .. } => "ratio",
        }
    }

    /// Whether it is a value of the signal at an instant.
    pub(super) fn is_value(self) -> bool {
        matches!(self, Self::Maximum | Self::Minimum | Self::Ratio { .. })
    }

    /// The figure of a signal, with its sensitivity coefficients.
    ///
    /// # Errors
    /// A sentence on why the signal does not have it.
    pub(super) fn of(self, signal: &Signal) -> Result<Sensitive, String> {
        match self {
            Self::Maximum | Self::Ratio { .. } => Ok(vertex(signal, 1.0)?[0].clone()),
            Self::Minimum => Ok(vertex(signal, -1.0)?[0].clone()),
            Self::MaximumTime => Ok(vertex(signal, 1.0)?[1].clone()),
            Self::MinimumTime => Ok(vertex(signal, -1.0)?[1].clone()),
            Self::Duration { level } => duration(signal, level),
            Self::Integral { between } => integral(signal, between, false),
            Self::SquaredIntegral { between } => integral(signal, between, true),
        }
    }
}

impl QuantityFound {
    /// The standard uncertainty by the law of propagation.
    pub fn standard_uncertainty(&self) -> f64 {
        self.contributions.iter().map(|(_, u)| u * u).sum::<f64>().sqrt()
    }

    /// The mean of its values in the trials and their standard deviation; none where there are fewer than two, or where
    /// a trial does not have the figure.
    pub fn of_trials(&self) -> Option<[f64; 2]> {
        let n = self.trials.len();
        if n < 2 || self.trials.iter().any(|value| !value.is_finite()) {
            return None;
        }
        let mean = self.trials.iter().sum::<f64>() / n as f64;
        let squares: f64 = self.trials.iter().map(|value| (value - mean) * (value - mean)).sum();
        Some([mean, (squares / (n - 1) as f64).sqrt()])
    }
}

/// The ratio of a channel's greatest value to another's, whose errors are independent of its own.
pub(super) fn ratio(of: &QuantityFound, to: &QuantityFound, channel: usize) -> QuantityFound {
    let value = of.value / to.value;
    let own = of.contributions.iter().map(|(source, u)| (*source, (u / to.value).abs()));
    let other = to.standard_uncertainty() * (value / to.value).abs();
    let drawn: Vec<f64> = of.drawn.iter().zip(&to.drawn).map(|(own, other)| own / other).collect();
    QuantityFound {
        name: of.name.clone(),
        quantity: WaveformQuantity::Ratio { channel },
        value,
        contributions: own.chain([(WaveformSource::OtherChannel, other)]).collect(),
        trials: ascending(&drawn),
        drawn,
    }
}

/// Values in rising order.
pub(super) fn ascending(values: &[f64]) -> Vec<f64> {
    let mut values = values.to_vec();
    gumption_engine::number::ascending(&mut values);
    values
}

/// The greatest value (`sign` 1) or the least (-1) and its instant.
fn vertex(signal: &Signal, sign: f64) -> Result<[Sensitive; 2], String> {
    let values = &signal.values;
    let place =
        (0..values.len()).max_by(|a, b| (sign * values[*a]).total_cmp(&(sign * values[*b])));
    let place = place.filter(|place| (1..values.len() - 1).contains(place)).ok_or_else(|| {
        let which = if sign > 0.0 { "greatest" } else { "least" };
        format!("the {which} value stands at the end of the record, so that there is no peak")
    })?;
    let [before, at, after] = [values[place - 1], values[place], values[place + 1]];
    let (slope, curvature) = (0.5 * (after - before), before - 2.0 * at + after);
    let flat = curvature == 0.0;
    let shift = if flat { 0.0 } else { -slope / curvature };
    let weights = [0.5 * shift * (shift - 1.0), 1.0 - shift * shift, 0.5 * shift * (shift + 1.0)];
    let value = weights[0] * before + weights[1] * at + weights[2] * after;
    // of the shift: those of slope and curvature
    let of_shift = [-0.5 + shift, -2.0 * shift, 0.5 + shift]
        .map(|g| if flat { 0.0 } else { -g / curvature / signal.rate });
    let coefficients = |of: [f64; 3]| (place - 1..=place + 1).zip(of).collect();
    Ok([
        Sensitive { value, coefficients: coefficients(weights), per_rate: 0.0 },
        Sensitive {
            value: signal.instant(place as f64 + shift),
            coefficients: coefficients(of_shift),
            per_rate: -(place as f64 + shift) / signal.rate,
        },
    ])
}

/// The time between the crossings of a level about the greatest value.
fn duration(signal: &Signal, level: f64) -> Result<Sensitive, String> {
    let [peak, _] = vertex(signal, 1.0)?;
    let values = &signal.values;
    let height = level * peak.value;
    let middle = peak.coefficients[1].0;
    let missing = |side: &str| {
        format!(
            "the signal does not fall to {level} of its greatest value {side} it, so that it has no duration"
        )
    };
    let before =
        (0..middle).rev().find(|at| values[*at] <= height).ok_or_else(|| missing("before"))?;
    let after = (middle..values.len()).find(|at| values[*at] <= height);
    let after = after.ok_or_else(|| missing("after"))?;
    let mut found = Sensitive { value: 0.0, coefficients: Vec::new(), per_rate: 0.0 };
    for (sign, from) in [(-1.0, before), (1.0, after - 1)] {
        let [a, b] = [values[from], values[from + 1]];
        let share = (height - a) / (b - a);
        found.value += sign * (from as f64 + share) / signal.rate;
        // the instant moves by (change of the level - change of the value)/slope
        let per = sign / ((b - a) * signal.rate);
        found.coefficients.extend([(from, -per * (1.0 - share)), (from + 1, -per * share)]);
        found.coefficients.extend(peak.coefficients.iter().map(|(at, g)| (*at, per * level * g)));
    }
    found.per_rate = -found.value;
    Ok(found)
}

/// The integral of the values or of their squares, by trapezoids whose ends lie between samples.
fn integral(
    signal: &Signal,
    between: Option<[f64; 2]>,
    squared: bool,
) -> Result<Sensitive, String> {
    let last = signal.values.len() as f64 - 1.0;
    let [from, to] = match between {
        None => [0.0, last],
        Some(instants) => {
            let places = instants.map(|instant| (instant - signal.start) * signal.rate);
            // an instant that is a sample's may be beside it by rounding
            places.map(
                |place| if (place - place.round()).abs() < 1e-6 { place.round() } else { place },
            )
        }
    };
    if !(from >= 0.0 && to > from && to <= last) {
        return Err(format!(
            "the integral's instants do not lie within the record, which goes from {} s to {} s",
            signal.start,
            signal.instant(last)
        ));
    }
    let mut weights: Vec<(usize, f64)> = Vec::new();
    let mut add = |place: usize, weight: f64| match weights.last_mut() {
        Some((at, sum)) if *at == place => *sum += weight,
        _ => weights.push((place, weight)),
    };
    let mut start = from;
    while start < to {
        let cell = start.floor();
        let end = to.min(cell + 1.0);
        // of a straight line over part of a cell
        let middle = 0.5 * (start + end) - cell;
        add(cell as usize, (end - start) * (1.0 - middle) / signal.rate);
        add(cell as usize + 1, (end - start) * middle / signal.rate);
        start = end;
    }
    let value = |at: usize| signal.values.get(at).copied().unwrap_or(0.0);
    let of = |(at, weight): &(usize, f64)| {
        let x = value(*at);
        if squared { (*at, 2.0 * x * weight) } else { (*at, *weight) }
    };
    let sum = weights.iter().map(|(at, w)| {
        let x = value(*at);
        if squared { x * x * w } else { x * w }
    });
    let value: f64 = sum.sum();
    Ok(Sensitive { value, coefficients: weights.iter().map(of).collect(), per_rate: -value })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn half_sine() -> Signal {
        let value = |i: i32| {
            let t = f64::from(i) / 1000.0 - 0.02;
            if (0.0..0.05).contains(&t) {
                3.0 * (std::f64::consts::PI * t / 0.05).sin()
            } else {
                0.0
            }
        };
        Signal { values: (0..100).map(value).collect(), rate: 1000.0, start: 1.0 }
    }

    /// A half sine of 50 ms, its greatest value 3 at 45 ms: the parabola errs by h^4 x''''/384, relatively 4e-8; the
    /// level of one half lasts 2/3 of it (a line between samples errs by up to h^2 x''/8,
    /// over the slope 5e-6 s), the
    /// integral is 2/pi of it (trapezoids: relatively h^2 pi^2/12/T^2 = 3.3e-4), that of the square one half.
    #[test]
    fn figures_of_a_half_sine() {
        let signal = half_sine();
        let of = |quantity: WaveformQuantity| quantity.of(&signal).unwrap().value;
        assert!((of(WaveformQuantity::Maximum) - 3.0).abs() < 1e-6);
        assert!((of(WaveformQuantity::MaximumTime) - 1.045).abs() < 1e-9);
        let lasts = of(WaveformQuantity::Duration { level: 0.5 });
        assert!((lasts - 0.05 * 2.0 / 3.0).abs() < 1e-5, "{lasts}");
        let sum = of(WaveformQuantity::Integral { between: None });
        assert!((sum / (0.05 * 3.0 * std::f64::consts::FRAC_2_PI) - 1.0).abs() < 4e-4, "{sum}");
        let part = of(WaveformQuantity::Integral { between: Some([1.02, 1.045]) });
        assert!((part / sum - 0.5).abs() < 1e-12);
        let squares = of(WaveformQuantity::SquaredIntegral { between: Some([1.02, 1.07]) });
        assert!((squares / (0.05 * 9.0 / 2.0) - 1.0).abs() < 1e-12, "{squares}");
    }

    /// Sensitivity coefficients against differences: relatively 1e-5, the second order of a step of 1e-6.
    #[test]
    fn coefficients_are_derivatives() {
        let signal = half_sine();
        for quantity in [
            WaveformQuantity::Maximum,
            WaveformQuantity::MaximumTime,
            WaveformQuantity::Duration { level: 0.3 },
            WaveformQuantity::Integral { between: Some([1.0214, 1.0521]) },
            WaveformQuantity::SquaredIntegral { between: Some([1.0214, 1.0521]) },
        ] {
            let of = quantity.of(&signal).unwrap();
            let mut coefficients = vec![0.0; signal.values.len()];
            of.coefficients.iter().for_each(|(at, g)| coefficients[*at] += g);
            let size = coefficients.iter().fold(0.0_f64, |most, g| most.max(g.abs()));
            for at in (0..100).filter(|at| coefficients[*at] != 0.0) {
                let moved = |by: f64| {
                    let mut moved = signal.clone();
                    moved.values[at] += by;
                    quantity.of(&moved).unwrap().value
                };
                let slope = (moved(1e-6) - moved(-1e-6)) / 2e-6;
                assert!(
                    (slope - coefficients[at]).abs() < 1e-5 * size,
                    "{quantity:?} {at}: {slope}"
                );
            }
        }
    }

    #[test]
    fn what_a_signal_does_not_have_is_refused() {
        let rising = Signal { values: vec![0.0, 1.0, 2.0], rate: 1.0, start: 0.0 };
        assert!(WaveformQuantity::Maximum.of(&rising).is_err());
        let high = Signal { values: vec![2.0, 3.0, 2.0], rate: 1.0, start: 0.0 };
        assert!(WaveformQuantity::Duration { level: 0.5 }.of(&high).is_err());
        for between in [[-1.0, 1.0], [0.0, 2.5], [1.0, 1.0], [f64::NAN, 1.0]] {
            let quantity = WaveformQuantity::Integral { between: Some(between) };
            assert!(quantity.of(&high).is_err(), "{between:?}");
        }
    }
}
