//! A row of a recipe whose channels are waveforms: recordings in, corrected records out.

use super::corrected::{Waveform, WaveformStep, corrected};
use super::quantity::{WaveformQuantity, ratio};
use super::quiet::{NoiseColour, QuietPart};
use crate::passes::SampleSource;
use crate::refused::Refused;
use crate::run::{held, signal};
use crate::step::without_mean;
use crate::track::ChannelRecording;
use crate::{ChannelStep, Signal, TimeBase};

/// A channel whose answer is its waveform.
#[derive(Clone, Debug)]
pub struct WaveformChannel {
    /// The channel, by its place in the recipe.
    pub channel: usize,
    /// Its name, which chooses the draws of its trials.
    pub name: String,
    /// What is done before: its mean is taken off, at most.
    pub before: Vec<ChannelStep>,
    /// How it is corrected.
    pub step: WaveformStep,
    /// The channel that has a record of its noise, in place of the step's own, and its colour.
    pub quiet: Option<(usize, NoiseColour)>,
}

/// The waveforms of the recordings of one row, in the order of `channels`.
///
/// # Errors
/// [`Refused`] says what is missing in which channel.
pub fn waveforms<P: SampleSource>(
    channels: &[WaveformChannel],
    (seed, trials): (u64, u64),
    tracks: &mut [ChannelRecording<P>],
) -> Result<Vec<Waveform>, Refused<P::Error>> {
    let mut found: Vec<Waveform> = Vec::new();
    for of in channels {
        let refused = |reason| Refused::Step { channel: of.channel, step: of.before.len(), reason };
        let (base, record) = record(tracks, of.channel, &of.before)?;
        let mut step = of.step.clone();
        step.of_rate = base.rate.standard_uncertainty / base.rate.value;
        if let Some((quiet, colour)) = of.quiet {
            let (_, signal) = self::record(tracks, quiet, &[])?;
            step.noise = QuietPart::Record { signal, colour };
        }
        found.push(corrected(&step, &record, (&of.name, seed, trials)).map_err(refused)?);
    }
    // the greatest values of all channels are known now
    let greatest = |channel: usize| {
        let place = channels.iter().position(|of| of.channel == channel)?;
        let of_maximum = |of: &&super::QuantityFound| of.quantity == WaveformQuantity::Maximum;
        found.get(place)?.quantities.iter().find(of_maximum).cloned()
    };
    let others: Vec<Vec<_>> = found
        .iter()
        .map(|of| {
            let each = of.quantities.iter().map(|of| match of.quantity {
                WaveformQuantity::Ratio { channel } => Some((greatest(channel)?, channel)),
                _ => None,
            });
            each.collect()
        })
        .collect();
    for (of, others) in found.iter_mut().zip(others) {
        for (quantity, other) in of.quantities.iter_mut().zip(others) {
            if let Some((other, channel)) = other {
                *quantity = ratio(quantity, &other, channel);
            }
        }
    }
    Ok(found)
}

/// A channel's values in memory, after what is done with them before.
fn record<P: SampleSource>(
    tracks: &mut [ChannelRecording<P>],
    channel: usize,
    before: &[ChannelStep],
) -> Result<(TimeBase, Signal), Refused<P::Error>> {
    let channels = tracks.len();
    let (_, base, samples) =
        held(tracks, channel)?.ok_or(Refused::UnknownChannel { channel, channels })?;
    let mut record = signal(base, samples.channels.first());
    if before.contains(&ChannelStep::RemoveMean) {
        record = without_mean(record);
    }
    Ok((base, record))
}
