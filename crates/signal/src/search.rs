//! The sampling rates of recordings that are found from an oscillation of known frequency: the rate
//! at which it is strongest, refined with its multiples in the fit.

use super::analysis::ChannelGroup;
use super::passes::{SampleSource, gathered};
use super::recipe::{ChannelRateSearch, Frequency, RecipeSettings};
use super::refused::Refused;
use super::surroundings::Finding;
use super::track::ChannelRecording;
use super::{Measured, Noise, RateSearch, Signal, measured, sampling_rate};

/// Gives every recording that is searched its rate; what was found, with the channels.
pub(super) fn rates<P: SampleSource>(
    settings: &RecipeSettings,
    frequencies: &[Frequency],
    tracks: &mut [ChannelRecording<P>],
) -> Result<Vec<(usize, Finding)>, Refused<P::Error>> {
    let mut findings = Vec::new();
    for track in tracks {
        let Some(search) = track.search else { continue };
        let (value, beside) = rate(settings, frequencies, track, search)?;
        track.base.rate = value;
        track.base.beside_frequency = beside;
        findings.push((search.channel, Finding::of("sampling rate", "Hz", value)));
    }
    Ok(findings)
}

/// The rate, and the part of its standard uncertainty that is the noise's where the frequency is the
/// recipe's own.
fn rate<P: SampleSource>(
    settings: &RecipeSettings,
    frequencies: &[Frequency],
    track: &mut ChannelRecording<P>,
    search: ChannelRateSearch,
) -> Result<(Measured, Option<f64>), Refused<P::Error>> {
    let channel = search.channel;
    let refused = |reason: &str| Refused::Rate { channel, reason: reason.to_owned() };
    let stated =
        frequencies.first().filter(|frequency| !frequency.estimate).and_then(|frequency| {
            Some(Measured {
                value: frequency.hertz?,
                standard_uncertainty: frequency.standard_uncertainty,
                degrees_of_freedom: f64::INFINITY,
            })
        });
    let frequency = search.frequency.or(stated).ok_or_else(|| {
        refused("a sampling rate is found from a known frequency, not from one that is estimated")
    })?;
    let column = track.channels.iter().position(|own| *own == channel);
    let column = column.ok_or_else(|| refused("the recording does not have the channel"))?;
    let samples = track.passes.frames();
    if samples > super::MOST_HELD {
        return Err(Refused::TooLong { channel, samples });
    }
    let mut held = gathered(&mut track.passes, &[column]).map_err(Refused::Unreadable)?;
    let mut signal = Signal {
        values: held.channels.pop().unwrap_or_default(),
        rate: track.base.rate.value,
        start: track.base.start,
    };
    let look =
        RateSearch { frequency, between: search.between, step: search.step, noise: Noise::White };
    let first = sampling_rate(&signal, &look).map_err(|error| refused(&error.to_string()))?;
    held.channels.push(std::mem::take(&mut signal.values));
    // the same maximum with multiples in the fit, which would else pull it, and with noise of any
    // colour
    let mut base = track.base;
    base.rate.value = first.rate.value;
    let hertz = Some(frequency.value);
    let frequencies = [Frequency { hertz, standard_uncertainty: 0.0, estimate: true }];
    let channels = [(channel, 0)];
    let settings = RecipeSettings { method: super::Method::SineFit, ..settings.clone() };
    let group = ChannelGroup {
        settings: &settings,
        frequencies: &frequencies,
        base,
        track: 0,
        clock: 0,
        channels: &channels,
        through: None,
        traced: false,
    };
    let analysed = group.analyse(&mut held.unfailing())?;
    let found =
        analysed.first().and_then(|analysed| Some((analysed.fundamentals.first()?, analysed)));
    let (fundamental, of) = found.ok_or(Refused::NotFound { channel })?;
    let rate = frequency.value / fundamental.cycles;
    let from_noise = rate * fundamental.of_estimate / fundamental.cycles;
    let from_frequency = rate * frequency.standard_uncertainty / frequency.value;
    let value = measured::of_parts(
        rate,
        &[
            (from_noise, of.residuals.noise_freedom()),
            (from_frequency, frequency.degrees_of_freedom),
        ],
    );
    Ok((value, search.frequency.is_none().then_some(from_noise)))
}
