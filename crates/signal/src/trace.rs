//! A record with its fit and what the fit leaves, thinned out for figures. Nothing that is seen is
//! smoothed: of the values that share a column of a figure the least and the greatest are kept.

use super::analysed::Fundamental;
use super::drift;
use super::frequency::windowed;
use super::passes::SampleSource;
use super::recipe::TimeBase;
use super::sine_fit::{ToneCoefficients, ToneDesign};
use gumption_engine::number::elementary::{exp, hypot, ln, sin_cos_turn};

/// Columns of a figure at most.
pub const TRACE_COLUMNS: usize = 320;

/// Periods of the slowest oscillation that a waveform shows.
const PERIODS: f64 = 4.0;

/// Samples that a waveform shows at least, where the record has them.
const FEWEST: u64 = 40;

/// The first samples of a record that a spectrum is taken of, at most.
const TRANSFORMED: usize = 1 << 18;

/// The range of the values in each of consecutive stretches of a record.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SampleRanges {
    /// The instant of the first sample, in seconds.
    pub start: f64,
    /// The duration of a stretch, in seconds.
    pub step: f64,
    /// Samples of a stretch; the last one may have fewer.
    pub samples: u64,
    /// The least and the greatest value of each, in the channel's unit.
    pub ranges: Vec<[f64; 2]>,
}

/// A part of an amplitude spectrum that is one column of a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectrumColumn {
    /// The frequency of the greatest amplitude in it, in hertz.
    pub hertz: f64,
    /// The least and the greatest amplitude in it: peak values in the channel's unit.
    pub amplitudes: [f64; 2],
}

/// An oscillation of a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TraceTone {
    /// Which of the row's frequencies it belongs to.
    pub fundamental: usize,
    /// Which multiple of it.
    pub multiple: u32,
    /// Its frequency, in hertz.
    pub hertz: f64,
    /// Its amplitude in the record, a peak value in the channel's unit.
    pub amplitude: f64,
}

/// A channel's record as figures show it, after the channel's steps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RecordTrace {
    /// The channel, by its place among those of the recipe.
    pub channel: usize,
    /// Samples of the record.
    pub samples: u64,
    /// The first periods.
    pub waveform: SampleRanges,
    /// The fit at evenly spaced instants from the first sample of the waveform to its last.
    pub fit: Vec<f64>,
    /// What the fit leaves, over the whole record.
    pub residuals: SampleRanges,
    /// The amplitude spectrum under a Hann window, by frequency; no more than [`TRACE_COLUMNS`].
    pub spectrum: Vec<SpectrumColumn>,
    /// The same of what the fit leaves.
    pub residual_spectrum: Vec<SpectrumColumn>,
    /// Samples that the spectra are of: the first ones.
    pub transformed: u64,
    /// The oscillations of the fit.
    pub tones: Vec<TraceTone>,
}

impl SampleRanges {
    /// Of so many samples.
    fn new(base: TimeBase, samples: u64) -> Self {
        let each = samples.div_ceil(TRACE_COLUMNS as u64).max(1);
        Self {
            start: base.start,
            step: each as f64 / base.rate.value,
            samples: each,
            ranges: Vec::new(),
        }
    }

    /// Takes the value of a sample; samples come in order.
    fn take(&mut self, sample: u64, value: f64) {
        let column = (sample / self.samples) as usize;
        match self.ranges.get_mut(column) {
            Some([low, high]) => (*low, *high) = (low.min(value), high.max(value)),
            None => self.ranges.push([value; 2]),
        }
    }
}

/// What is gathered of a channel on the way through its record.
struct Gathered {
    trace: RecordTrace,
    values: Vec<f64>,
    left: Vec<f64>,
}

/// The traces of channels with their fits, in their order; one pass over the record.
pub(super) fn traces<E>(
    passes: &mut dyn SampleSource<Error = E>,
    base: TimeBase,
    design: &ToneDesign,
    fundamentals: &[Fundamental],
    channels: &[(usize, &ToneCoefficients)],
) -> Result<Vec<RecordTrace>, E> {
    let slowest =
        fundamentals.iter().map(|fundamental| fundamental.cycles).fold(f64::INFINITY, f64::min);
    let shown = ((PERIODS / slowest).ceil() as u64).max(FEWEST).min(design.samples);
    let tone = |place: usize, fit: &ToneCoefficients| {
        let of = design.tones.get(place)?;
        let amplitude = hypot(*fit.cosines.get(place)?, *fit.sines.get(place)?);
        let hertz = of.cycles * base.rate.value;
        Some(TraceTone { fundamental: of.fundamental, multiple: of.multiple, hertz, amplitude })
    };
    let new = |(channel, fit): &(usize, &ToneCoefficients)| Gathered {
        trace: RecordTrace {
            channel: *channel,
            samples: design.samples,
            waveform: SampleRanges::new(base, shown),
            residuals: SampleRanges::new(base, design.samples),
            tones: (0..design.tones.len()).filter_map(|place| tone(place, fit)).collect(),
            ..RecordTrace::default()
        },
        values: Vec::new(),
        left: Vec::new(),
    };
    let mut gathered: Vec<Gathered> = channels.iter().map(new).collect();
    let fits: Vec<ToneCoefficients> =
        channels.iter().map(|(_, fit)| design.at_first(fit)).collect();
    for (gathered, fit) in gathered.iter_mut().zip(&fits) {
        let last = shown.saturating_sub(1) as f64;
        let instants = (0..=TRACE_COLUMNS).map(|place| last * place as f64 / TRACE_COLUMNS as f64);
        gathered.trace.fit = instants.map(|instant| at(design, fit, instant)).collect();
    }
    design.each(passes, |first, blocks, waves| {
        for ((of, fit), values) in gathered.iter_mut().zip(&fits).zip(blocks) {
            let fitted = waves.values(fit, values.len());
            for (number, (value, fitted)) in (first..).zip(values.iter().zip(&fitted)) {
                if number < shown {
                    of.trace.waveform.take(number, *value);
                }
                of.trace.residuals.take(number, value - fitted);
                if of.values.len() < TRANSFORMED {
                    of.values.push(*value);
                    of.left.push(value - fitted);
                }
            }
        }
    })?;
    let finished = |gathered: Gathered| RecordTrace {
        spectrum: spectrum(&gathered.values, base.rate.value),
        residual_spectrum: spectrum(&gathered.left, base.rate.value),
        transformed: gathered.values.len() as u64,
        ..gathered.trace
    };
    Ok(gathered.into_iter().map(finished).collect())
}

/// The fit at an instant, in sample intervals from the first sample; of the first periods only.
fn at(design: &ToneDesign, fit: &ToneCoefficients, instant: f64) -> f64 {
    let waves = design.tones.iter().zip(fit.cosines.iter().zip(&fit.sines));
    let level = fit.offset + drift::at(&fit.drift, design.samples, instant);
    waves.fold(level, |sum, (tone, (a, b))| {
        let turns = tone.cycles * instant;
        let (sin, cos) = sin_cos_turn(turns - turns.floor());
        sum + a * cos + b * sin
    })
}

/// The amplitude spectrum of values under a Hann window, in columns of equal ratio of frequency.
fn spectrum(values: &[f64], rate: f64) -> Vec<SpectrumColumn> {
    let power = windowed(values);
    let Some(last) = power.len().checked_sub(1).filter(|last| *last > 0) else {
        return Vec::new();
    };
    // the first column begins with the lowest frequency, the last one ends with the highest
    let ratio = ln(last as f64) / TRACE_COLUMNS as f64;
    let end = |column: usize| {
        let end = exp(ratio * (column + 1) as f64);
        if column + 1 == TRACE_COLUMNS { last + 1 } else { (end.ceil() as usize).min(last + 1) }
    };
    // the window's gain is 1/2, and half of a line's power is at negative frequencies
    let amplitude = |bin: usize| 4.0 * power[bin].sqrt() / values.len() as f64;
    let mut columns = Vec::new();
    let mut from = 1;
    for column in 0..TRACE_COLUMNS {
        let to = end(column);
        let bins = from..to;
        let highest = bins.clone().max_by(|a, b| power[*a].total_cmp(&power[*b]));
        let Some(highest) = highest else { continue };
        let least = bins.map(amplitude).fold(f64::INFINITY, f64::min);
        columns.push(SpectrumColumn {
            hertz: highest as f64 * rate / values.len() as f64,
            amplitudes: [least, amplitude(highest)],
        });
        from = to;
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line at the middle of a bin has its own amplitude under a Hann window; half a bin beside it
    /// (8/(3 pi)) of it, 1.42 dB less. No bin is left out, and none is in two columns.
    #[test]
    fn lines_have_their_amplitude() {
        let tau = 2.0 * std::f64::consts::PI;
        for (bin, expected) in [(40.0, 3.0), (40.5, 3.0 * 8.0 / (3.0 * std::f64::consts::PI))] {
            let of = |i: u32| 5.0 + 3.0 * (tau * bin * f64::from(i) / 10_000.0 + 0.4).cos();
            let columns = spectrum(&(0..10_000).map(of).collect::<Vec<f64>>(), 2000.0);
            assert!(columns.len() <= TRACE_COLUMNS);
            assert!(columns.windows(2).all(|pair| pair[0].hertz < pair[1].hertz));
            let highest = columns.iter().max_by(|a, b| a.amplitudes[1].total_cmp(&b.amplitudes[1]));
            let highest = highest.unwrap();
            // the line's image at the negative frequency is 80 bins away, where the window has 1e-5
            assert!((highest.amplitudes[1] / expected - 1.0).abs() < 1e-4, "{highest:?}");
            assert!((highest.hertz - bin * 0.2).abs() <= 0.1 + 1e-12);
        }
    }

    #[test]
    fn few_values_have_few_columns() {
        assert_eq!(spectrum(&[], 1.0), []);
        assert_eq!(spectrum(&[1.0], 1.0), []);
        let columns = spectrum(&[1.0, -1.0, 1.0, -1.0, 1.0, -1.0], 6.0);
        assert_eq!(columns.iter().map(|of| of.hertz).collect::<Vec<f64>>(), [1.0, 2.0, 3.0]);
    }

    #[test]
    fn ranges_keep_the_extremes() {
        let rate = crate::Measured {
            value: 100.0,
            standard_uncertainty: 0.0,
            degrees_of_freedom: f64::INFINITY,
        };
        let base =
            TimeBase { rate, start: 2.0, jitter: 0.0, beside_frequency: None, of_middle: None };
        let mut ranges = SampleRanges::new(base, 1000);
        (0..1000_u64).for_each(|i| ranges.take(i, if i == 777 { 9.0 } else { -(i as f64) }));
        assert_eq!((ranges.samples, ranges.step, ranges.ranges.len()), (4, 0.04, 250));
        assert_eq!(ranges.ranges[0], [-3.0, 0.0]);
        assert_eq!(ranges.ranges[194], [-779.0, 9.0]);
    }

    /// Two oscillations under known noise: dots are the samples, the line goes through the
    /// oscillations as they were put in, and what is left is the noise. The observation is the same as
    /// without traces.
    #[test]
    fn a_trace_shows_what_was_recorded() {
        use crate::{
            Amplitude, Channel, ChannelRecording, Frequency, InMemorySamples, Measured, Method,
            PhaseUnit, RecipeSettings, observe, observe_with_traces,
        };
        let tau = 2.0 * std::f64::consts::PI;
        let clean =
            |t: f64| 3.0 + 2.0 * (tau * 0.01 * t + 0.5).cos() + 0.1 * (tau * 0.03 * t).sin();
        let noise = |i: u32| if i.is_multiple_of(2) { 1e-4 } else { -1e-4 };
        let values: Vec<f64> = (0..5000).map(|i| clean(f64::from(i)) + noise(i)).collect();
        let exact = |value| Measured {
            value,
            standard_uncertainty: 0.0,
            degrees_of_freedom: f64::INFINITY,
        };
        let settings = RecipeSettings {
            channels: vec![Channel {
                name: "a".to_owned(),
                unit: gumption_units::Unit::parse("V").unwrap(),
                scale_uncertainty: 0.0,
                resolution: 0.0,
                steps: Vec::new(),
            }],
            reference: None,
            components: vec![1],
            harmonics: 3,
            method: Method::SineFit,
            amplitude: Amplitude::Peak,
            phase: PhaseUnit::Degree,
            trials: 0,
            seed: 1,
        };
        let frequency = Frequency { hertz: Some(10.0), standard_uncertainty: 0.0, estimate: false };
        let base = TimeBase {
            rate: exact(1000.0),
            start: 1.5,
            jitter: 0.0,
            beside_frequency: None,
            of_middle: None,
        };
        let tracks = || {
            let passes = InMemorySamples { channels: vec![values.clone()] };
            [ChannelRecording { passes, base, channels: vec![0], search: None }]
        };
        let (observation, traces) =
            observe_with_traces(&settings, &[frequency], &mut tracks()).unwrap();
        assert_eq!(observation, observe(&settings, &[frequency], &mut tracks()).unwrap());
        let [trace] = traces.as_slice() else { panic!("{}", traces.len()) };
        // four periods of 100 samples, two samples a column
        assert_eq!((trace.waveform.samples, trace.waveform.ranges.len()), (2, 200));
        assert_eq!((trace.waveform.start, trace.waveform.step), (1.5, 0.002));
        let [a, b] = [values[20], values[21]];
        assert_eq!(trace.waveform.ranges[10], [a.min(b), a.max(b)]);
        // the noise alternates, at half the sampling rate: what a fit takes of it over 5000 samples is
        // below 1e-6
        for (place, fit) in trace.fit.iter().enumerate() {
            let t = 399.0 * place as f64 / TRACE_COLUMNS as f64;
            assert!((fit - clean(t)).abs() < 1e-6, "{place}");
        }
        assert_eq!(trace.residuals.ranges.len(), 5000_usize.div_ceil(16));
        for [low, high] in &trace.residuals.ranges {
            assert!((low + 1e-4).abs() < 1e-6 && (high - 1e-4).abs() < 1e-6);
        }
        let found: Vec<(u32, f64)> = trace.tones.iter().map(|of| (of.multiple, of.hertz)).collect();
        assert_eq!(found, [(1, 10.0), (2, 20.0), (3, 30.0)]);
        assert!((trace.tones[0].amplitude - 2.0).abs() < 1e-6);
        assert!((trace.tones[2].amplitude - 0.1).abs() < 1e-6);
        // whole periods: the fundamental's line has its amplitude, and nothing of it is left
        let at_ten = trace.spectrum.iter().find(|of| of.hertz == 10.0).unwrap();
        assert!((at_ten.amplitudes[1] - 2.0).abs() < 1e-5, "{at_ten:?}");
        let left = trace.residual_spectrum.iter().filter(|of| of.hertz < 400.0);
        assert!(left.clone().count() > 100 && left.into_iter().all(|of| of.amplitudes[1] < 1e-6));
    }
}
