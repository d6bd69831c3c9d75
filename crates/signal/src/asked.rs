//! Whether what is asked for can be done: numbers in their ranges, channels that are there, values
//! that are numbers.

use std::collections::HashSet;

use super::passes::SampleSource;
use super::recipe::{Frequency, Method, RecipeSettings, TimeBase};
use super::refused::Refused;
use super::track::ChannelRecording;

/// Checks settings, frequencies and recordings of a row before anything is made of them.
pub(super) fn check<P: SampleSource>(
    settings: &RecipeSettings,
    frequencies: &[Frequency],
    tracks: &mut [ChannelRecording<P>],
) -> Result<(), Refused<P::Error>> {
    numbers(settings, frequencies)?;
    for track in tracks.iter() {
        instants(&track.base)?;
    }
    channels(settings, tracks)?;
    tracks.iter_mut().try_for_each(values)
}

const ABOVE_ZERO: &str = "a finite number above 0";
const NOT_NEGATIVE: &str = "0 or a finite number above it";

fn above_zero<E>(what: &'static str, found: f64) -> Result<(), Refused<E>> {
    if found > 0.0 && found.is_finite() {
        return Ok(());
    }
    Err(Refused::OutOfRange { what, found, range: ABOVE_ZERO })
}

fn not_negative<E>(what: &'static str, found: f64) -> Result<(), Refused<E>> {
    if found >= 0.0 && found.is_finite() {
        return Ok(());
    }
    Err(Refused::OutOfRange { what, found, range: NOT_NEGATIVE })
}

fn numbers<E>(settings: &RecipeSettings, frequencies: &[Frequency]) -> Result<(), Refused<E>> {
    let count = frequencies.len() as f64;
    let what = "number of frequencies";
    match (settings.method, frequencies.len()) {
        (_, 0) => return Err(Refused::OutOfRange { what, found: count, range: "1 or more" }),
        (Method::Fft, 2..) => {
            let range = "1 for the Fourier transform";
            return Err(Refused::OutOfRange { what, found: count, range });
        }
        _ => {}
    }
    for frequency in frequencies {
        if let Some(hertz) = frequency.hertz {
            above_zero("frequency [Hz]", hertz)?;
        }
        not_negative("standard uncertainty of a frequency [Hz]", frequency.standard_uncertainty)?;
    }
    if settings.components.contains(&0) {
        let (what, range) = ("multiple of a component", "1 or more");
        return Err(Refused::OutOfRange { what, found: 0.0, range });
    }
    for channel in &settings.channels {
        not_negative("resolution of a channel", channel.resolution)?;
        not_negative("relative uncertainty of a channel's scale", channel.scale_uncertainty)?;
    }
    Ok(())
}

fn instants<E>(base: &TimeBase) -> Result<(), Refused<E>> {
    above_zero("sampling rate [Hz]", base.rate.value)?;
    not_negative("standard uncertainty of the sampling rate [Hz]", base.rate.standard_uncertainty)?;
    not_negative("jitter [s]", base.jitter)?;
    if !base.start.is_finite() {
        let (what, found) = ("instant of the first value [s]", base.start);
        return Err(Refused::OutOfRange { what, found, range: "a finite number" });
    }
    Ok(())
}

/// Every channel of a recording is one of the recipe's, once, and the reference is among them.
fn channels<P: SampleSource>(
    settings: &RecipeSettings,
    tracks: &[ChannelRecording<P>],
) -> Result<(), Refused<P::Error>> {
    let count = settings.channels.len();
    let held = || tracks.iter().flat_map(|track| track.channels.iter().copied());
    let searched = tracks.iter().filter_map(|track| Some(track.search?.channel));
    let mut named = held().chain(searched).chain(settings.reference);
    if let Some(channel) = named.find(|channel| *channel >= count) {
        return Err(Refused::UnknownChannel { channel, channels: count });
    }
    let mut once = HashSet::new();
    if let Some(channel) = held().find(|channel| !once.insert(*channel)) {
        return Err(Refused::ChannelTwice { channel });
    }
    match settings.reference.filter(|channel| !once.contains(channel)) {
        Some(channel) => Err(Refused::ReferenceMissing { channel }),
        None => Ok(()),
    }
}

/// Every channel of a recording has a finite value at each of its instants.
fn values<P: SampleSource>(track: &mut ChannelRecording<P>) -> Result<(), Refused<P::Error>> {
    if track.passes.is_checked() {
        return Ok(());
    }
    let expected = track.passes.frames();
    let mut counts = vec![0; track.channels.len()];
    let mut not_finite = None;
    track
        .passes
        .pass(&mut |first, blocks| {
            for ((count, &channel), values) in counts.iter_mut().zip(&track.channels).zip(blocks) {
                *count += values.len() as u64;
                let place = values.iter().position(|value| !value.is_finite());
                if let (None, Some(place)) = (not_finite, place) {
                    not_finite = Some((channel, first + place as u64));
                }
            }
        })
        .map_err(Refused::Unreadable)?;
    let of_channels = track.channels.iter().zip(counts);
    let mut unequal = of_channels.filter(|(_, samples)| *samples != expected);
    if let Some((&channel, samples)) = unequal.next() {
        return Err(Refused::Unequal { channel, samples, expected });
    }
    match not_finite {
        Some((channel, sample)) => Err(Refused::NotFinite { channel, sample }),
        None => Ok(()),
    }
}
