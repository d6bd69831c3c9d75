//! A row of a recipe: recordings in, observations out.

use super::Signal;
use super::analysis::{Analysed, Group, MOST_HELD, Refused, local, unreadable};
use super::observation::{ChannelObservation, Observation};
use super::passes::{Held, Passes, gathered};
use super::recipe::{Frequency, Method, Settings, TimeBase};
use super::step::{Finding, Step, Surroundings};
use super::values::observed;

/// A recording with the channels that it holds.
#[derive(Debug)]
pub struct Track<P> {
    /// The values, in the units of their channels.
    pub passes: P,
    /// Their instants.
    pub base: TimeBase,
    /// The channels that it holds, by their places in the recipe.
    pub channels: Vec<usize>,
}

/// A channel that went through its steps.
struct Stepped {
    channel: usize,
    clock: usize,
    base: TimeBase,
    held: Held,
    findings: Vec<Finding>,
}

/// Takes amplitudes, phases and what goes with them from the recordings of one row.
///
/// # Errors
/// [`Refused`] says what is missing in which channel.
pub fn observe<P: Passes>(
    settings: &Settings,
    frequencies: &[Frequency],
    tracks: &mut [Track<P>],
) -> Result<Observation, Refused<P::Error>> {
    let mut stepped: Vec<Stepped> = Vec::new();
    for channel in in_order(settings) {
        if let Some(found) = through_steps(settings, frequencies, tracks, &stepped, channel)? {
            stepped.push(found);
        }
    }
    let mut analysed: Vec<Analysed> = Vec::new();
    let mut track = 0;
    for (clock, recording) in tracks.iter_mut().enumerate() {
        let plain = recording.channels.iter().enumerate();
        let plain: Vec<(usize, usize)> = plain
            .filter(|(_, channel)| settings.channels[**channel].steps.is_empty())
            .map(|(column, channel)| (*channel, column))
            .collect();
        if plain.is_empty() {
            continue;
        }
        let base = recording.base;
        let group = Group { settings, frequencies, base, track, clock, channels: &plain };
        analysed.extend(group.analyse(&mut recording.passes)?);
        track += 1;
    }
    let mut findings: Vec<(usize, Vec<Finding>)> = Vec::new();
    for mut of in stepped {
        let channels = [(of.channel, 0)];
        let (base, clock) = (of.base, of.clock);
        let group = Group { settings, frequencies, base, track, clock, channels: &channels };
        analysed.extend(group.analyse(&mut of.held).map_err(unreadable)?);
        findings.push((of.channel, of.findings));
        track += 1;
    }
    analysed.sort_by_key(|of| of.channel);
    let reference =
        settings.reference.and_then(|channel| analysed.iter().find(|of| of.channel == channel));
    let found = |channel: usize| {
        let of = findings.iter().find(|(of, _)| *of == channel);
        of.map_or(Vec::new(), |(_, findings)| findings.clone())
    };
    let at = |fundamental: usize| -> Vec<ChannelObservation> {
        let channels = analysed.iter();
        channels
            .filter_map(|of| observed(settings, of, reference, fundamental, found(of.channel)))
            .collect()
    };
    let count = if settings.method == Method::Fft { 1 } else { frequencies.len() };
    Ok(Observation { frequencies: (0..count).map(at).collect(), notes: notes(settings, &analysed) })
}

/// The channels, the reference first.
fn in_order(settings: &Settings) -> Vec<usize> {
    let others = (0..settings.channels.len()).filter(|c| Some(*c) != settings.reference);
    settings.reference.into_iter().chain(others).collect()
}

fn through_steps<P: Passes>(
    settings: &Settings,
    frequencies: &[Frequency],
    tracks: &mut [Track<P>],
    done: &[Stepped],
    channel: usize,
) -> Result<Option<Stepped>, Refused<P::Error>> {
    let steps = &settings.channels[channel].steps;
    if steps.is_empty() {
        return Ok(None);
    }
    let reference = match settings.reference {
        Some(reference) if steps.iter().any(Step::needs_reference) && reference != channel => {
            match done.iter().find(|of| of.channel == reference) {
                Some(of) => Some(signal(of.base, of.held.channels.first())),
                None => held(tracks, reference)?
                    .map(|(_, base, held)| signal(base, held.channels.first())),
            }
        }
        _ => None,
    };
    let Some((clock, mut base, held)) = held(tracks, channel)? else { return Ok(None) };
    let frequency = frequencies.first().and_then(|of| of.hertz).unwrap_or(0.0);
    let mut now = signal(base, held.channels.first());
    let mut findings = Vec::new();
    for (step, of) in steps.iter().enumerate() {
        let surroundings = Surroundings { frequency, reference: reference.as_ref() };
        let after = of.apply(now, surroundings).map_err(|reason| Refused::Step {
            channel,
            step,
            reason,
        })?;
        now = after.signal;
        for finding in &after.findings {
            // a rate that a step found is the channel's from here on
            if finding.value.value == now.rate {
                base.rate = finding.value;
            }
        }
        findings.extend(after.findings);
    }
    base.start = now.start;
    base.rate.value = now.rate;
    let held = Held { channels: vec![now.values] };
    Ok(Some(Stepped { channel, clock, base, held, findings }))
}

fn signal(base: TimeBase, values: Option<&Vec<f64>>) -> Signal {
    Signal { values: values.cloned().unwrap_or_default(), rate: base.rate.value, start: base.start }
}

type InMemory = Option<(usize, TimeBase, Held)>;

/// A channel's values in memory, with its recording and its instants.
fn held<P: Passes>(tracks: &mut [Track<P>], channel: usize) -> Result<InMemory, Refused<P::Error>> {
    for (clock, track) in tracks.iter_mut().enumerate() {
        let Some(column) = track.channels.iter().position(|of| *of == channel) else { continue };
        let samples = track.passes.frames();
        if samples > MOST_HELD {
            return Err(Refused::TooLong { channel, samples });
        }
        let values = gathered(&mut track.passes, &[column]).map_err(Refused::Unreadable)?;
        return Ok(Some((clock, track.base, values)));
    }
    Ok(None)
}

/// What to bear in mind about fits.
fn notes(settings: &Settings, analysed: &[Analysed]) -> Vec<(&'static str, usize, String)> {
    let mut notes = Vec::new();
    for of in analysed {
        let name = &settings.channels[of.channel].name;
        let residuals = &of.residuals;
        if residuals.correlated {
            let lag = residuals.autocorrelation.first().copied().unwrap_or(0.0);
            let way = if residuals.local.is_some() {
                format!(
                    "the noise near each frequency is taken from {} parts of the record",
                    residuals.parts
                )
            } else {
                "the record is too short to tell the noise near each frequency, so standard \
                 uncertainties may be too small"
                    .to_owned()
            };
            let text = format!(
                "`{name}`: the residuals are correlated (coefficient {lag:.2} at lag 1); {way}"
            );
            notes.push(("correlated-residuals", of.channel, text));
        }
        for (number, fundamental) in of.fundamentals.iter().enumerate() {
            let Some((step, variance)) = residuals.cycles.get(number) else { continue };
            let stated = fundamental.of_stated.hypot(fundamental.of_rate).hypot(fundamental.of_cut);
            let noise = (variance * residuals.variance * local(residuals, 0).max(1.0)).sqrt();
            if fundamental.of_estimate == 0.0 && step.abs() > 5.0 * stated.hypot(noise) {
                let hertz = |cycles: f64| cycles * of.base.rate.value;
                let text = format!(
                    "`{name}`: the recording fits a frequency that differs by {:.2e} Hz from {} Hz, \
                     more than their uncertainties allow; look at the sampling rate, or let the \
                     frequency be estimated",
                    hertz(*step),
                    crate::number::Shortest(hertz(fundamental.cycles)),
                );
                notes.push(("frequency-differs", of.channel, text));
            }
        }
    }
    notes
}
