//! What cannot be observed is refused, and says why.

use super::simulated::Bench;
use crate::{
    ChannelRecording, Frequency, InMemorySamples, Measured, Method, Observation, RecipeSettings,
    Refused, TimeBase, observe,
};

/// Two channels of 2000 values at 1 kHz, 10.3 Hz.
struct Asked {
    settings: RecipeSettings,
    frequencies: Vec<Frequency>,
    base: TimeBase,
    values: InMemorySamples,
    places: Vec<usize>,
}

impl Asked {
    fn new() -> Self {
        let bench = Bench::default();
        let rate = Measured {
            value: 1000.0,
            standard_uncertainty: 0.0,
            degrees_of_freedom: f64::INFINITY,
        };
        Self {
            settings: bench.settings(),
            frequencies: vec![frequency(10.3)],
            base: TimeBase {
                rate,
                start: 0.0,
                jitter: 0.0,
                beside_frequency: None,
                of_middle: None,
            },
            values: bench.values(1),
            places: vec![0, 1],
        }
    }

    fn observed(self) -> Result<Observation, Refused<std::convert::Infallible>> {
        let Self { settings, frequencies, base, values: passes, places: channels } = self;
        let mut tracks = [ChannelRecording { passes, base, channels, search: None }];
        observe(&settings, &frequencies, &mut tracks)
    }
}

fn frequency(hertz: f64) -> Frequency {
    Frequency { hertz: Some(hertz), standard_uncertainty: 0.0, estimate: false }
}

/// The refusal after a change of what can be observed.
fn refusal(change: impl FnOnce(&mut Asked)) -> Refused<std::convert::Infallible> {
    let mut asked = Asked::new();
    change(&mut asked);
    asked.observed().unwrap_err()
}

#[test]
fn what_is_whole_is_observed() {
    assert_eq!(Asked::new().observed().unwrap().frequencies[0].len(), 2);
    // a channel that no recording holds is left out, if it is not the reference
    let mut first = Asked::new();
    first.places = vec![0];
    assert_eq!(first.observed().unwrap().frequencies[0].len(), 1);
}

#[test]
fn values_that_are_missing_or_no_numbers() {
    for short in [0, 1] {
        let refused = refusal(|of| of.values.channels[short].truncate(1600));
        let expected = Refused::Unequal { channel: short, samples: 1600, expected: 2000 };
        assert_eq!(refused, expected);
    }
    let refused = refusal(|of| of.values.channels.truncate(1));
    assert_eq!(refused, Refused::Unequal { channel: 1, samples: 0, expected: 2000 });
    for value in [f64::NAN, f64::INFINITY] {
        let refused = refusal(|of| of.values.channels[1][100] = value);
        assert_eq!(refused, Refused::NotFinite { channel: 1, sample: 100 });
        assert_eq!(
            refused.to_string(),
            "channel 1: the value of sample 100 is not a finite number"
        );
    }
}

#[test]
fn channels_that_are_not_there() {
    let unknown = |channel| Refused::UnknownChannel { channel, channels: 2 };
    assert_eq!(refusal(|of| of.places = vec![0, 7]), unknown(7));
    assert_eq!(refusal(|of| of.settings.reference = Some(9)), unknown(9));
    assert_eq!(refusal(|of| of.places = vec![0, 0]), Refused::ChannelTwice { channel: 0 });
    assert_eq!(refusal(|of| of.places = vec![1]), Refused::ReferenceMissing { channel: 0 });
}

/// A dead channel has no phase, whatever its level.
#[test]
fn a_reference_that_does_not_oscillate() {
    for level in [0.0, 1.0, -3.7e5] {
        let refused = refusal(|of| of.values.channels[0].fill(level));
        let Refused::ReferenceSilent { channel: 0, hertz } = refused else {
            panic!("{level}: {refused:?}");
        };
        assert!((hertz - 10.3).abs() < 1e-9);
    }
    // a dead channel that nobody counts phases from is one without amplitude
    let mut dead = Asked::new();
    dead.values.channels[1].fill(1.0);
    let found = dead.observed().unwrap();
    assert!(found.frequencies[0][1].components[0].amplitude.measured.value < 1e-12);
}

#[test]
fn numbers_out_of_range() {
    let named = |change: fn(&mut Asked)| match refusal(change) {
        Refused::OutOfRange { what, .. } => what,
        other => panic!("{other:?}"),
    };
    assert_eq!(named(|of| of.base.jitter = -1.0), "jitter [s]");
    assert_eq!(named(|of| of.base.jitter = f64::NAN), "jitter [s]");
    assert_eq!(named(|of| of.base.rate.value = 0.0), "sampling rate [Hz]");
    assert_eq!(named(|of| of.base.start = f64::NAN), "instant of the first value [s]");
    for hertz in [-7.0, 0.0, f64::NAN] {
        let refused = refusal(|of| of.frequencies = vec![frequency(hertz)]);
        assert!(matches!(refused, Refused::OutOfRange { what: "frequency [Hz]", .. }));
    }
    assert_eq!(named(|of| of.frequencies.clear()), "number of frequencies");
    assert_eq!(named(|of| of.settings.components = vec![0]), "multiple of a component");
    assert_eq!(named(|of| of.settings.channels[0].resolution = -1.0), "resolution of a channel");
    let refused = refusal(|of| {
        of.settings.method = Method::Fft;
        of.frequencies.push(frequency(14.0));
    });
    let text = "the number of frequencies is 2, and must be 1 for the Fourier transform";
    assert_eq!(refused.to_string(), text);
}

/// One trial, or ten, tell a standard uncertainty to 70 % and 22 %: that of the propagation, which is
/// right of an amplitude 100 times the noise, is kept. Of one that the noise hides it is not.
#[test]
fn few_trials_do_not_decide() {
    let observed = |noise: f64, trials: u64| {
        let bench = Bench { noise, trials, samples: 400, ..Bench::default() };
        bench.observe(bench.values(3)).frequencies[0][1].components[0].clone()
    };
    let right = observed(0.005, 0).amplitude.measured.standard_uncertainty;
    for trials in [1, 2, 3, 10, 100, 2000] {
        let found = observed(0.005, trials);
        assert!(!found.amplitude.from_trials && !found.phase.from_trials, "{trials}");
        assert!(found.amplitude.trials.is_some());
        assert!((found.amplitude.measured.standard_uncertainty / right - 1.0).abs() < 1e-12);
    }
    // the noise of an amplitude is 0.07 of that of the 400 values, 0.0014, beside a clear reference
    let channels = vec![vec![(1.0, 0.3), (0.0, 0.0)], vec![(0.002, -1.2), (0.0, 0.0)]];
    let bench = Bench { noise: 0.02, trials: 2000, samples: 400, channels, ..Bench::default() };
    let phase =
        |seed| bench.observe(bench.values(seed)).frequencies[0][1].components[0].phase.clone();
    assert!((1..=5).any(|seed| phase(seed).from_trials));
}
