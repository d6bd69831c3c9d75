//! A whole number of periods, cut out between zero crossings (Prato and others 2024, section
//! 3.4.2: no leakage into the bins of a Fourier transform).

/// A part of a signal with a whole number of periods, as nearly as whole samples allow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WholePeriods {
    /// The first sample.
    pub first: usize,
    /// How many samples.
    pub samples: usize,
    /// How many periods.
    pub periods: u32,
    /// Cycles in a sample interval, from the interpolated instants of the first and last crossing.
    pub cycles: f64,
}

/// From which part of the amplitude on, below the mean and then above it, a crossing counts. Noise of
/// 20 dB below the signal is a fourteenth of the amplitude: the two are nine standard deviations apart.
const THROUGH: f64 = 1.0 / 3.0;

/// The longest part with a whole number of periods of `cycles` (about) in a sample interval. A
/// crossing is where the signal goes up through its mean, from a third of its amplitude below to a
/// third above, so that noise makes none; interpolated between two samples, and where noise splits
/// it, their mean. None with less than one period between two crossings.
pub fn whole_periods(values: &[f64], cycles: f64) -> Option<WholePeriods> {
    let count = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / count;
    let power = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / count;
    let least = THROUGH * (2.0 * power).sqrt();
    let half = 0.5 / cycles;
    let mut crossings: Vec<f64> = Vec::new();
    // the crossings since the signal was low
    let mut rising: Option<(f64, u32)> = None;
    let mut last = values.first().map_or(0.0, |first| first - mean);
    for (i, value) in values.iter().enumerate() {
        let (before, after) = (last, value - mean);
        last = after;
        if after < -least {
            rising = Some((0.0, 0));
        }
        let Some((sum, number)) = &mut rising else { continue };
        if before < 0.0 && after >= 0.0 {
            *sum += i as f64 - 1.0 + before / (before - after);
            *number += 1;
        }
        if after > least {
            let (sum, number) = (*sum, *number);
            rising = None;
            let at = sum / f64::from(number.max(1));
            // a second one within half a period is noise's
            if number > 0 && crossings.last().is_none_or(|last| at - last >= half) {
                crossings.push(at);
            }
        }
    }
    let (from, to) = (*crossings.first()?, *crossings.last()?);
    let periods = ((to - from) * cycles).round();
    // crossings of something else than this oscillation
    let astray = ((to - from) * cycles - periods).abs() > 0.25;
    if periods < 1.0 || astray {
        return None;
    }
    let samples = (to - from).round() as usize;
    let first = from.ceil() as usize;
    (first + samples <= values.len()).then_some(WholePeriods {
        first,
        samples,
        periods: periods as u32,
        cycles: periods / (to - from),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn periods_between_interpolated_crossings() {
        let cycles = 0.0123;
        let values: Vec<f64> = (0..1000)
            .map(|i| 2.0 + (2.0 * std::f64::consts::PI * (cycles * f64::from(i) - 0.3)).sin())
            .collect();
        let part = whole_periods(&values, 0.0125).unwrap();
        // crossings at (0.3 + n)/0.0123: the first at 24.4, the last of those below 1000 at n = 11
        assert_eq!((part.first, part.periods), (25, 11));
        assert_eq!(part.samples, (11.0f64 / cycles).round() as usize);
        // linear interpolation and the mean of a part period: 1e-3 of the frequency
        assert!((part.cycles / cycles - 1.0).abs() < 1e-3, "{part:?}");
        assert_eq!(whole_periods(&values[..100], cycles), None);
    }

    /// Ten periods of 200 samples at every phase, with noise of 20 dB below the signal: nine whole
    /// ones, ten where both ends are crossings, eight where both are within one. Noise of a fourteenth
    /// of the amplitude moves an interpolated crossing by sigma/(2 pi A cycles) = 2.3 samples, of 1600 or more 0.2 % between
    /// two; without it the ends of a record counted as crossings, and one in five was refused.
    #[test]
    fn noise_makes_no_crossings() {
        for seed in 0..200u32 {
            let noise = crate::tests::simulated::normals(seed.into(), "crossings", 2000);
            let phase = f64::from(seed) / 200.0;
            let values: Vec<f64> = (0..2000)
                .map(|i| {
                    let turns = 0.005 * f64::from(i) + phase;
                    let wave = 2.0 * (2.0 * std::f64::consts::PI * turns).cos();
                    wave + 0.1 + 0.141 * noise[i as usize]
                })
                .collect();
            let part = whole_periods(&values, 0.005).unwrap();
            assert!((8..=10).contains(&part.periods), "{seed}: {part:?}");
            assert!((part.cycles / 0.005 - 1.0).abs() < 0.008, "{seed}: {part:?}");
            assert!(part.first + part.samples <= 2000);
        }
    }
}
