//! A row of a recipe: recordings in, observations out.

use std::rc::Rc;

use super::analysed::{Analysed, local, unit_text};
use super::analysis::ChannelGroup;
use super::asked;
use super::beside::{amplitude, clear_degree};
use super::channel_step::ChannelStep;
use super::coloured::Memory;
use super::common_noise::correlation;
use super::effects::StepEffect;
use super::near_noise;
use super::note::{Note, short};
use super::observation::{ChannelObservation, Observation};
use super::passes::{InMemorySamples, SampleSource, gathered};
use super::recipe::{Frequency, Method, RecipeSettings, TimeBase};
use super::refused::{MOST_HELD, Refused};
use super::search;
use super::spurious::Spurious;
use super::surroundings::{Finding, Surroundings};
use super::through::{self, Through};
use super::trace::RecordTrace;
use super::track::ChannelRecording;
use super::unexplained;
use super::values::observed;
use super::{Measured, Signal};
use gumption_engine::number::{elementary, smallest_first};

/// A channel that went through its steps.
struct Stepped {
    channel: usize,
    clock: usize,
    base: TimeBase,
    held: InMemorySamples,
    findings: Vec<Finding>,
    through: Option<Through>,
    notes: Vec<Note>,
}

/// Takes amplitudes, phases and what goes with them from the recordings of one row.
///
/// # Errors
/// [`Refused`] says what is missing in which channel.
pub fn observe<P: SampleSource>(
    settings: &RecipeSettings,
    frequencies: &[Frequency],
    tracks: &mut [ChannelRecording<P>],
) -> Result<Observation, Refused<P::Error>> {
    Ok(row(settings, frequencies, tracks, false)?.0)
}

/// The same, and for each channel what figures show of its record, which takes another pass.
///
/// # Errors
/// As [`observe`].
pub fn observe_with_traces<P: SampleSource>(
    settings: &RecipeSettings,
    frequencies: &[Frequency],
    tracks: &mut [ChannelRecording<P>],
) -> Result<(Observation, Vec<RecordTrace>), Refused<P::Error>> {
    row(settings, frequencies, tracks, true)
}

fn row<P: SampleSource>(
    settings: &RecipeSettings,
    frequencies: &[Frequency],
    tracks: &mut [ChannelRecording<P>],
    traced: bool,
) -> Result<(Observation, Vec<RecordTrace>), Refused<P::Error>> {
    asked::check(settings, frequencies, tracks)?;
    let mut findings: Vec<(usize, Finding)> = search::rates(settings, frequencies, tracks)?;
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
        let through = None;
        let channels = &plain;
        let group =
            ChannelGroup { settings, frequencies, base, track, clock, channels, through, traced };
        analysed.extend(group.analyse(&mut recording.passes)?);
        track += 1;
    }
    let mut of_steps: Vec<Note> = Vec::new();
    for stepped in stepped {
        let channels = [(stepped.channel, 0)];
        let (base, clock) = (stepped.base, stepped.clock);
        let through = stepped.through.as_ref();
        let channels = &channels;
        let group =
            ChannelGroup { settings, frequencies, base, track, clock, channels, through, traced };
        analysed.extend(group.analyse(&mut stepped.held.unfailing())?);
        findings.extend(stepped.findings.into_iter().map(|finding| (stepped.channel, finding)));
        of_steps.extend(stepped.notes);
        track += 1;
    }
    smallest_first(&mut analysed, |analysed| analysed.channel as f64);
    let reference = settings
        .reference
        .and_then(|channel| analysed.iter().find(|analysed| analysed.channel == channel));
    if let Some(silent) = reference.and_then(silent) {
        return Err(silent);
    }
    let found = |channel: usize| {
        let of = findings.iter().filter(|(number, _)| *number == channel);
        of.map(|(_, finding)| finding.clone()).collect()
    };
    let at = |fundamental: usize| -> Vec<ChannelObservation> {
        let channels = analysed.iter();
        channels
            .filter_map(|analysed| {
                observed(settings, analysed, reference, fundamental, found(analysed.channel))
            })
            .collect()
    };
    let count = if settings.method == Method::Fft { 1 } else { frequencies.len() };
    let mut notes = notes(settings, &analysed);
    notes.extend(of_steps);
    let observed: Vec<Vec<ChannelObservation>> = (0..count).map(at).collect();
    notes.extend(
        observed.iter().flatten().filter_map(|observation| near_noise::note(settings, observation)),
    );
    let observation = Observation { frequencies: observed, notes };
    Ok((observation, analysed.into_iter().filter_map(|analysed| analysed.trace).collect()))
}

/// The refusal of a reference that has no oscillation at one of the frequencies: an amplitude of
/// nothing but rounding, as of a constant.
fn silent<E>(reference: &Analysed) -> Option<Refused<E>> {
    let rounding = 4.0 * f64::EPSILON * reference.fit.offset.abs();
    let mut tones = reference
        .design
        .tones
        .iter()
        .enumerate()
        .filter(|(_, tone)| tone.multiple == 1 && !tone.beside);
    let (_, tone) = tones.find(|(place, _)| amplitude(&reference.fit, *place) <= rounding)?;
    let hertz = reference
        .fundamentals
        .get(tone.fundamental)
        .map_or(0.0, |fundamental| fundamental.hertz.value);
    Some(Refused::ReferenceSilent { channel: reference.channel, hertz })
}

/// The channels, the reference first.
fn in_order(settings: &RecipeSettings) -> Vec<usize> {
    let others = (0..settings.channels.len()).filter(|c| Some(*c) != settings.reference);
    settings.reference.into_iter().chain(others).collect()
}

fn through_steps<P: SampleSource>(
    settings: &RecipeSettings,
    frequencies: &[Frequency],
    tracks: &mut [ChannelRecording<P>],
    done: &[Stepped],
    channel: usize,
) -> Result<Option<Stepped>, Refused<P::Error>> {
    let steps = &settings.channels[channel].steps;
    if steps.is_empty() {
        return Ok(None);
    }
    let mut of_reference = None;
    let reference = match settings.reference {
        Some(reference)
            if steps.iter().any(ChannelStep::takes_reference) && reference != channel =>
        {
            match done.iter().find(|done| done.channel == reference) {
                Some(of) => {
                    of_reference = of.through.as_ref();
                    Some(signal(of.base, of.held.channels.first()))
                }
                None => held(tracks, reference)?
                    .map(|(_, base, held)| signal(base, held.channels.first())),
            }
        }
        _ => None,
    };
    let Some((clock, mut base, held)) = held(tracks, channel)? else { return Ok(None) };
    let mut frequency = frequencies.first().and_then(|frequency| frequency.hertz).unwrap_or(0.0);
    let highest = settings.components.iter().copied().max().unwrap_or(1).max(settings.harmonics);
    let mut now = signal(base, held.channels.first());
    let (mut findings, mut notes) = (Vec::new(), Vec::new());
    let mut through: Option<Through> = None;
    for (step, of) in steps.iter().enumerate() {
        let refused = |reason| Refused::Step { channel, step, reason };
        if of.has_effect() && through.is_none() {
            base.start = now.start;
            let channels = [(channel, 0)];
            let group = ChannelGroup {
                settings,
                frequencies,
                base,
                track: 0,
                clock,
                channels: &channels,
                through: None,
                traced: false,
            };
            let mut held = InMemorySamples { channels: vec![now.values] };
            let before = group.analyse(&mut held.unfailing())?.pop();
            now.values = held.channels.pop().unwrap_or_default();
            let first = before.as_ref().and_then(|analysed| analysed.fundamentals.first());
            frequency = first.map_or(frequency, |fundamental| fundamental.hertz.value);
            through = before.map(|before| Through { effects: Rc::default(), before });
        }
        let surroundings = Surroundings {
            frequency,
            frequencies: frequencies.len(),
            multiples: highest,
            reference: reference.as_ref(),
            resolution: if through.as_ref().is_none_or(|through| through.effects.0.is_empty()) {
                settings.channels[channel].resolution
            } else {
                0.0
            },
        };
        let before = [of_reference, through.as_ref()];
        let after = of.apply_after(now, surroundings, before).map_err(refused)?;
        now = after.signal;
        // what a step finds in the channel's own unit
        findings.extend(after.findings.into_iter().map(|mut finding| {
            if finding.unit.is_empty() {
                finding.unit = settings.channels[channel].unit.text().to_owned();
            }
            finding
        }));
        if let (Some(effect), Some(through)) = (after.effect, &mut through) {
            let found = through_filter(settings, channel, of, &effect, &through.before);
            let found = found.map_err(refused)?;
            notes.extend(found.iter().map(|finding| not_corrected(settings, channel, finding)));
            findings.extend(found);
            Rc::make_mut(&mut through.effects).0.push(effect);
        }
    }
    base.start = now.start;
    let held = InMemorySamples { channels: vec![now.values] };
    Ok(Some(Stepped { channel, clock, base, held, findings, through, notes }))
}

/// The least gain of a filter at a component that is asked for.
const LEAST_GAIN: f64 = 1e-4;

/// What a filter does to the components that are asked for: a mistake where it takes one of them out,
/// findings where its gain is not corrected.
fn through_filter(
    settings: &RecipeSettings,
    channel: usize,
    step: &ChannelStep,
    effect: &StepEffect,
    before: &Analysed,
) -> Result<Vec<Finding>, String> {
    let StepEffect::Filtered { filter, correct } = effect else { return Ok(Vec::new()) };
    let mut findings = Vec::new();
    let rate = before.base.rate;
    for fundamental in &before.fundamentals {
        for multiple in settings.components.iter().map(|multiple| f64::from(*multiple)) {
            let of = fundamental.hertz;
            let frequency = Measured {
                value: of.value * multiple,
                standard_uncertainty: of.standard_uncertainty * multiple,
                ..of
            };
            let passage = filter.passage(frequency, rate.standard_uncertainty / rate.value);
            let hertz = gumption_engine::number::Shortest(frequency.value);
            if *correct && passage.gain.value < LEAST_GAIN {
                return Err(format!(
                    "the filter lets {:.1e} of the component at {hertz} Hz of channel `{}` pass; that \
                     is too little to be corrected",
                    passage.gain.value, settings.channels[channel].name
                ));
            }
            if !*correct {
                let times = settings.phase.in_radian();
                let phase = Measured {
                    value: passage.phase.value * times,
                    standard_uncertainty: passage.phase.standard_uncertainty * times,
                    ..passage.phase
                };
                let name = |what: &str| format!("{what} of the {} at {hertz} Hz", step.name());
                findings.push(Finding::of(&name("gain"), "1", passage.gain));
                findings.push(Finding::of(&name("phase"), settings.phase.name(), phase));
            }
        }
    }
    Ok(findings)
}

/// What to bear in mind about a gain that is left in the answer.
fn not_corrected(settings: &RecipeSettings, channel: usize, finding: &Finding) -> Note {
    let unit = if finding.unit == "1" { "" } else { &finding.unit };
    let text = format!(
        "`{}`: {}, {:.6} {unit}",
        settings.channels[channel].name, finding.name, finding.value
    );
    ("filter-not-corrected", channel, format!("{}, is not corrected", text.trim_end()))
}

fn signal(base: TimeBase, values: Option<&Vec<f64>>) -> Signal {
    Signal { values: values.cloned().unwrap_or_default(), rate: base.rate.value, start: base.start }
}

type InMemory = Option<(usize, TimeBase, InMemorySamples)>;

/// A channel's values in memory, with its recording and its instants.
fn held<P: SampleSource>(
    tracks: &mut [ChannelRecording<P>],
    channel: usize,
) -> Result<InMemory, Refused<P::Error>> {
    for (clock, track) in tracks.iter_mut().enumerate() {
        let Some(column) = track.channels.iter().position(|own| *own == channel) else { continue };
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
fn notes(settings: &RecipeSettings, analysed: &[Analysed]) -> Vec<Note> {
    let mut notes = Vec::new();
    for of in analysed {
        let name = &settings.channels[of.channel].name;
        let residuals = &of.residuals;
        let expected = residuals.known.as_ref().is_some_and(|known| known.factors.is_some());
        if residuals.correlated && !expected {
            let lag = residuals.autocorrelation.first().copied().unwrap_or(0.0);
            let way = match (&residuals.coloured, residuals.parts) {
                (_, 1..) => format!(
                    "the noise near each frequency is taken from {} parts of the record",
                    residuals.parts
                ),
                (Some(coloured), _) if coloured.fits => {
                    "the noise near each frequency is that of a \
                     process of first order, which the residuals have"
                        .to_owned()
                }
                _ => "the record is too short to tell the noise near each frequency, so standard \
                     uncertainties may be too small"
                    .to_owned(),
            };
            let suspected = residuals.memory == Memory::Suspected;
            let (code, are) = if suspected {
                ("short-record", "may be correlated, which the record is too short to tell")
            } else {
                ("correlated-residuals", "are correlated")
            };
            let text =
                format!("`{name}`: the residuals {are} (coefficient {lag:.2} at lag 1); {way}");
            notes.push((code, of.channel, text));
        }
        notes.extend(through::note(name, of));
        if residuals.memory == Memory::Open && !expected {
            let text = format!(
                "`{name}`: the record is too short to tell white noise from noise with a memory; the \
                 standard uncertainties are those of white noise, and may be too small"
            );
            notes.push(("short-record", of.channel, text));
        }
        let found: Vec<Spurious> = of.fitted_besides().collect();
        if !found.is_empty() {
            let unit = unit_text(settings, of);
            let each = found.iter().map(|found| {
                let hertz = short(found.cycles * of.base.rate.value, 6);
                format!("{hertz} Hz (amplitude {}{unit})", short(found.amplitude, 3))
            });
            let each = each.collect::<Vec<_>>().join(", ");
            let text = format!(
                "`{name}`: something oscillates that the recipe does not name, at {each}; it is \
                 fitted together with the named frequencies and counts as noise in the \
                 signal-to-noise ratio"
            );
            notes.push(("found-tone", of.channel, text));
        }
        if clear_degree(&of.design, &of.fit, residuals) > 0 {
            let unit = unit_text(settings, of);
            let text = format!(
                "`{name}`: the level drifts by {}{unit} over the record; a polynomial of degree {} is \
                 fitted together with the named frequencies, the offset is the mean over the record \
                 with the drift's standard deviation in its uncertainty, and the drift counts as noise \
                 in the signal-to-noise ratio",
                short(of.drift_range(), 2),
                of.design.drift
            );
            notes.push(("found-drift", of.channel, text));
        }
        if of.besides.too_near {
            let text = format!(
                "`{name}`: something oscillates within {} Hz (one over the record's length) of a \
                 named frequency, or that one grows, fades or wanders; this record cannot tell them \
                 apart, amplitude and phase are those of both together, and only a longer record \
                 tells more",
                short(of.base.rate.value / of.design.samples as f64, 2)
            );
            notes.push(("tones-too-near", of.channel, text));
        }
        notes.extend(unexplained::notes(settings, of));
        let known = residuals.known.as_ref().map(|known| known.before);
        let flickers = residuals.coloured.as_ref().is_some_and(|coloured| coloured.flickers);
        let flickers = known.map_or(flickers, |before| before.flickers);
        if known.map_or_else(|| unexplained::level_wanders(of), |before| before.wanders) {
            let text = format!(
                "`{name}`: the level wanders and does not come back within the record; the \
                 uncertainty of the offset is that of the record's first value. A steady drift, which \
                 is no noise, leaks into amplitudes and phases more than their uncertainties say: the \
                 step `remove-trend` takes a straight line out"
            );
            notes.push(("wandering-level", of.channel, text));
        } else if flickers {
            let text = format!(
                "`{name}`: the noise grows towards the lowest frequencies of the record, as 1/f noise \
                 does, which has no level of its own; the uncertainty of the offset is that against \
                 the mean of a record ten times as long"
            );
            notes.push(("wandering-level", of.channel, text));
        }
        let stated = settings.channels[of.channel].resolution;
        if of.resolution > stated {
            let unit = unit_text(settings, of);
            let known = if stated > 0.0 { "a finer" } else { "no" };
            // as many digits as single precision has
            let step = format!("{:.5e}", of.resolution).parse().unwrap_or(of.resolution);
            let text = format!(
                "`{name}`: {known} resolution is stated, but the values are multiples of {}{unit}, \
                 which is taken for it",
                gumption_engine::number::Shortest(step)
            );
            notes.push(("looks-quantized", of.channel, text));
        }
        if let Some(rounding) = of.rounding.as_ref().filter(|rounding| rounding.repeated > 0.05)
            && let Some(phases) = rounding.phases
        {
            let text = format!(
                "`{name}`: the {} samples fall on {phases} different phases of the oscillation, and \
                 there is too little noise to blur the rounding, so that it averages out over these \
                 only",
                of.design.samples
            );
            notes.push(("coherent-sampling", of.channel, text));
        }
        let reference = settings.reference.and_then(|channel| {
            analysed.iter().find(|other| other.channel == channel && channel != of.channel)
        });
        let common = reference
            .and_then(|reference| correlation(of, reference, of.fundamentals.first()?.cycles));
        if let Some(common) = common.filter(|common| common.abs() > 0.1) {
            let text = format!(
                "`{name}`: its noise and that of the reference have something in common (the errors \
                 of the two phases are correlated, {common:.2}); the phase's uncertainty allows for it"
            );
            notes.push(("common-noise", of.channel, text));
        }
        for (number, fundamental) in of.fundamentals.iter().enumerate() {
            let Some((step, variance)) = residuals.cycles.get(number) else { continue };
            let stated = elementary::hypot(
                elementary::hypot(fundamental.of_stated, fundamental.of_rate),
                fundamental.of_cut,
            );
            let noise = (variance * residuals.variance * local(residuals, 0)[0].max(1.0)).sqrt();
            // of a recording without noise the rounding of its values is left
            let least = (5.0 * elementary::hypot(stated, noise)).max(1e-10 * fundamental.cycles);
            if fundamental.of_estimate == 0.0 && step.abs() > least {
                let hertz = |cycles: f64| cycles * of.base.rate.value;
                let text = format!(
                    "`{name}`: the recording fits a frequency that differs by {:.2e} Hz from {} Hz, \
                     more than their uncertainties allow; look at the sampling rate, or let the \
                     frequency be estimated",
                    hertz(*step),
                    gumption_engine::number::Shortest(hertz(fundamental.cycles)),
                );
                notes.push(("frequency-differs", of.channel, text));
            }
        }
    }
    notes
}
