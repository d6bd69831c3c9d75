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

/// The longest part with a whole number of periods of `cycles` (about) in a sample interval. A
/// crossing is where the signal goes up through its mean, interpolated between two samples; a
/// further crossing counts after half a period at least, so that noise makes none. Of each group of
/// crossings that noise splits the mean is taken. None with less than one period.
pub fn whole_periods(values: &[f64], cycles: f64) -> Option<WholePeriods> {
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    let half = 0.5 / cycles;
    let mut groups: Vec<(f64, f64, u32)> = Vec::new();
    for (i, pair) in values.windows(2).enumerate() {
        let [before, after] = [pair[0] - mean, pair[1] - mean];
        if before < 0.0 && after >= 0.0 {
            let at = i as f64 + before / (before - after);
            match groups.last_mut() {
                Some((first, sum, count)) if at - *first < half => {
                    *sum += at;
                    *count += 1;
                }
                _ => groups.push((at, at, 1)),
            }
        }
    }
    let instant = |group: &(f64, f64, u32)| group.1 / f64::from(group.2);
    let (from, to) = (instant(groups.first()?), instant(groups.last()?));
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
}
