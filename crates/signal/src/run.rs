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
use super::note::{ChannelNote, in_unit, short};
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
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};
use gumption_engine::number::{Shortest, elementary, smallest_first};

/// A channel that went through its steps.
struct Stepped {
    channel: usize,
    clock: usize,
    base: TimeBase,
    held: InMemorySamples,
    findings: Vec<Finding>,
    through: Option<Through>,
    notes: Vec<ChannelNote>,
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
    let mut of_steps: Vec<ChannelNote> = Vec::new();
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
            for (finding, fact) in found {
                findings.push(finding);
                notes.push(ChannelNote { channel, fact });
            }
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
/// findings where its gain is not corrected, each with what to bear in mind about it.
fn through_filter(
    settings: &RecipeSettings,
    channel: usize,
    step: &ChannelStep,
    effect: &StepEffect,
    before: &Analysed,
) -> Result<Vec<(Finding, Fact)>, String> {
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
            let hertz = Shortest(frequency.value);
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
                let label = |what: &str| format!("{what} of the {} at {hertz} Hz", step.name());
                let (name, step, at) =
                    (&settings.channels[channel].name, step.name(), frequency.value);
                let value = Argument::Number(format!("{:.6}", passage.gain.value));
                let fact = fact!("filter-not-corrected", name, step, at, value);
                findings.push((Finding::of(&label("gain"), "1", passage.gain), fact));
                let unit = settings.phase.name();
                let value = Argument::Number(format!("{:.6} {unit}", phase.value));
                let fact = fact!("filter-not-corrected.phase", name, step, at, value);
                findings.push((Finding::of(&label("phase"), unit, phase), fact));
            }
        }
    }
    Ok(findings)
}

pub(super) fn signal(base: TimeBase, values: Option<&Vec<f64>>) -> Signal {
    Signal { values: values.cloned().unwrap_or_default(), rate: base.rate.value, start: base.start }
}

pub(super) type InMemory = Option<(usize, TimeBase, InMemorySamples)>;

/// A channel's values in memory, with its recording and its instants.
pub(super) fn held<P: SampleSource>(
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
fn notes(settings: &RecipeSettings, analysed: &[Analysed]) -> Vec<ChannelNote> {
    let mut notes = Vec::new();
    for of in analysed {
        let name = &settings.channels[of.channel].name;
        let channel = of.channel;
        let note = |fact: Fact| ChannelNote { channel, fact };
        let residuals = &of.residuals;
        let expected = residuals.known.as_ref().is_some_and(|known| known.factors.is_some());
        if residuals.correlated && !expected {
            let lag = residuals.autocorrelation.first().copied().unwrap_or(0.0);
            let coefficient = Argument::Number(format!("{lag:.2}"));
            let way = match (&residuals.coloured, residuals.parts) {
                (_, parts @ 1..) => fact!("noise-of-parts", parts),
                (Some(coloured), _) if coloured.fits => fact!("noise-of-process"),
                _ => fact!("noise-unknown"),
            };
            notes.push(note(match residuals.memory {
                Memory::Suspected => fact!("short-record.suspected", name, coefficient, way),
                _ => fact!("correlated-residuals", name, coefficient, way),
            }));
        }
        notes.extend(through::note(name, of));
        if residuals.memory == Memory::Open && !expected {
            notes.push(note(fact!("short-record", name)));
        }
        let found: Vec<Spurious> = of.fitted_besides().collect();
        if !found.is_empty() {
            let unit = unit_text(settings, of);
            let tones = found.iter().map(|found| {
                let frequency = short(found.cycles * of.base.rate.value, 6);
                fact!("other-tone", frequency, amplitude = in_unit(found.amplitude, 3, &unit))
            });
            let tones: Vec<Fact> = tones.collect();
            notes.push(note(fact!("found-tone", name, tones)));
        }
        if clear_degree(&of.design, &of.fit, residuals) > 0 {
            let range = in_unit(of.drift_range(), 2, &unit_text(settings, of));
            notes.push(note(fact!("found-drift", name, range, degree = of.design.drift)));
        }
        if of.besides.too_near {
            let within = short(of.base.rate.value / of.design.samples as f64, 2);
            notes.push(note(fact!("tones-too-near", name, within)));
        }
        notes.extend(unexplained::notes(settings, of));
        let known = residuals.known.as_ref().map(|known| known.before);
        let flickers = residuals.coloured.as_ref().is_some_and(|coloured| coloured.flickers);
        let flickers = known.map_or(flickers, |before| before.flickers);
        if known.map_or_else(|| unexplained::level_wanders(of), |before| before.wanders) {
            notes.push(note(fact!("wandering-level", name)));
        } else if flickers {
            notes.push(note(fact!("wandering-level.flicker", name)));
        }
        let stated = settings.channels[of.channel].resolution;
        if of.resolution > stated {
            // as many digits as single precision has
            let step = in_unit(of.resolution, 6, &unit_text(settings, of));
            notes.push(note(match stated > 0.0 {
                true => fact!("looks-quantized.finer", name, step),
                false => fact!("looks-quantized", name, step),
            }));
        }
        if let Some(rounding) = of.rounding.as_ref().filter(|rounding| rounding.repeated > 0.05)
            && let Some(phases) = rounding.phases
        {
            let samples = of.design.samples;
            notes.push(note(fact!("coherent-sampling", name, samples, phases)));
        }
        let reference = settings.reference.and_then(|channel| {
            analysed.iter().find(|other| other.channel == channel && channel != of.channel)
        });
        let common = reference
            .and_then(|reference| correlation(of, reference, of.fundamentals.first()?.cycles));
        if let Some(common) = common.filter(|common| common.abs() > 0.1) {
            let coefficient = Argument::Number(format!("{common:.2}"));
            notes.push(note(fact!("common-noise", name, coefficient)));
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
                let by = Argument::Number(format!("{:.2e}", hertz(*step)));
                let frequency = hertz(fundamental.cycles);
                notes.push(note(fact!("frequency-differs", name, by, frequency)));
            }
        }
    }
    notes
}
