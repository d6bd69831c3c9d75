//! The step `waveform`: what a transient signal came through, and what is asked of the corrected record.

mod low_pass;
mod noise;
mod quantities;
mod response;

use std::ops::Range;

use super::channels::ChannelFile;
use super::quantity::{Quantity, positive, quantity};
use super::steps::{converted, measured, whole_text};
use crate::context::Context;
use crate::keys;
use gumption_engine::task::Warning;
use gumption_signal::{
    ChannelStep, LineResponse, Measured, NoiseColour, QuietPart, WaveformChannel, WaveformQuantity,
    WaveformStep,
};
use gumption_text::object::Object;
use gumption_text::{Collector, DiagnosticKind, Folder};
use gumption_units::{Unit, nearest};

/// What files of a recipe are read with: the files that it may name, and those that were read, with their content.
pub(super) struct RecipeFiles<'f> {
    pub(super) context: Context<'f>,
    pub(super) folder: Folder<'f>,
    pub(super) read: Vec<(String, Vec<u8>)>,
    pub(super) warnings: Vec<Warning>,
}

/// A name of another channel, and where it stands.
type Named = (String, Range<usize>);

/// The step as written; the channels that it names are not looked for yet.
#[derive(Clone, Debug)]
pub(super) struct WaveformFile {
    step: WaveformStep,
    /// The channel with the record of the noise.
    quiet: Option<(Named, NoiseColour)>,
    /// The other channel of each quantity.
    others: Vec<Option<Named>>,
}

/// Reads the step of a channel whose values are in `of_values`; beside it the unit of the answer.
pub(super) fn read(
    of: &Object<'_>,
    of_values: &Unit,
    files: &mut RecipeFiles<'_>,
) -> Option<(WaveformFile, Unit)> {
    let (response, of_response) = match of.get("response") {
        Some(member) => response::read(of, member, files)?,
        None => (LineResponse::Flat, Unit::one()),
    };
    let natural = match of_response.text() {
        "1" | "" => of_values.text().to_owned(),
        _ => format!("{}/{}", whole_text(of_values), whole_text(&of_response)),
    };
    let (factor, unit) = converted(of, &natural)?;
    let low_pass = low_pass::read(of)?;
    let truncation = low_pass::truncation(of, &unit, low_pass.is_some())?;
    let delay = match of.get("delay") {
        Some(_) => measured(&quantity(of, "delay", "s")?),
        None => {
            Measured { value: 0.0, standard_uncertainty: 0.0, degrees_of_freedom: f64::INFINITY }
        }
    };
    let noise = noise::read(of, of_values)?;
    let quantities = quantities::read(of)?;
    let (noise, quiet) = match noise {
        noise::NoiseFile::Own(part) => (part, None),
        noise::NoiseFile::Channel(named, colour) => (QuietPart::Stated(0.0), Some((named, colour))),
    };
    let step = WaveformStep {
        response,
        factor,
        low_pass,
        truncation,
        noise,
        baseline: noise::baseline(of)?,
        delay,
        of_scale: 0.0,
        of_rate: 0.0,
        additional: low_pass::additional(of, &unit)?,
        quantities: quantities.iter().map(|of| (of.name.clone(), of.quantity)).collect(),
    };
    let others = quantities.into_iter().map(|of| of.other).collect();
    Some((WaveformFile { step, quiet, others }, unit))
}

/// The waveforms of a recipe; none of one whose channels are analysed at frequencies.
pub(super) fn resolved(
    root: &Object<'_>,
    channels: &[ChannelFile],
) -> Option<Vec<WaveformChannel>> {
    let mut found = Vec::new();
    let mut quiet_ones = Vec::new();
    for (channel, file) in channels.iter().enumerate() {
        let Some(waveform) = &file.waveform else { continue };
        let quiet = match &waveform.quiet {
            Some((named, colour)) => {
                let at = position(root.log, named, channels)?;
                same_unit(root.log, named, [channel, at], channels)?;
                quiet_ones.push(at);
                Some((at, *colour))
            }
            None => None,
        };
        let mut step = waveform.step.clone();
        step.of_scale = file.channel.scale_uncertainty;
        for ((_, quantity), other) in step.quantities.iter_mut().zip(&waveform.others) {
            if let (WaveformQuantity::Ratio { channel: of }, Some(named)) = (quantity, other) {
                *of = position(root.log, named, channels)?;
                let has_maximum = channels[*of].waveform.as_ref().is_some_and(|other| {
                    other.step.quantities.iter().any(|of| of.1 == WaveformQuantity::Maximum)
                });
                if *of == channel || !has_maximum {
                    let reason = format!(
                        "a `ratio` is that of two channels' greatest values: `{}` must be another channel with a step \
                         `waveform` whose `quantities` have `maximum`",
                        named.0
                    );
                    root.log.report(&named.1, DiagnosticKind::Recipe { reason });
                    return None;
                }
            }
        }
        let name = file.channel.name.clone();
        let before = file.channel.steps.clone();
        found.push(WaveformChannel { channel, name, before, step, quiet });
    }
    if found.is_empty() {
        return Some(found);
    }
    for (channel, file) in channels.iter().enumerate() {
        if file.waveform.is_none() && !quiet_ones.contains(&channel) {
            let reason = format!(
                "`{}` has no step `waveform`, and is the `noise` of no other channel; a recipe has either waveforms \
                 or oscillations: give it the step, or move it to a recipe of its own",
                file.channel.name
            );
            root.log.report(&file.place, DiagnosticKind::Recipe { reason });
            return None;
        }
        if file.waveform.is_none() && !file.channel.steps.is_empty() {
            let reason = "a record of noise has no steps".to_owned();
            let place = file.step_places.first().unwrap_or(&file.place);
            root.log.report(place, DiagnosticKind::Recipe { reason });
            return None;
        }
    }
    for key in keys::OF_OSCILLATIONS {
        if let Some(member) = root.get(key) {
            let reason =
                format!("`{key}` belongs to oscillations; a recipe of waveforms does not have it");
            root.log.report(&member.key_span, DiagnosticKind::Recipe { reason });
            return None;
        }
    }
    Some(found)
}

/// Whether steps may stand before a waveform: the mean may be taken off.
pub(super) fn check_before(of: &Object<'_>, before: &[ChannelStep]) -> Option<()> {
    let Some(other) = before.iter().find(|step| **step != ChannelStep::RemoveMean) else {
        return Some(());
    };
    let reason = format!(
        "`{}` stands before `waveform`, which takes a record as it is, or without its mean (`remove-mean`)",
        other.name()
    );
    of.report(DiagnosticKind::Recipe { reason });
    None
}

/// The place of a channel that is named.
fn position(log: &Collector, (name, place): &Named, channels: &[ChannelFile]) -> Option<usize> {
    let names = || channels.iter().map(|file| file.channel.name.as_str());
    let found = names().position(|known| known == name);
    if found.is_none() {
        let reason = match nearest(name, names()) {
            Some(near) => format!("there is no channel `{name}`; did you mean `{near}`?"),
            None => format!("there is no channel `{name}`"),
        };
        log.report(place, DiagnosticKind::Recipe { reason });
    }
    found
}

/// That a record of noise is in the unit of the record whose noise it is.
fn same_unit(
    log: &Collector,
    named: &Named,
    [channel, quiet]: [usize; 2],
    channels: &[ChannelFile],
) -> Option<()> {
    let [own, other] = [channel, quiet].map(|at| &channels[at].own_unit);
    if own == other {
        return Some(());
    }
    let reason = format!(
        "`{}` is in {other}, and the record whose noise it is in {own}: give both the same unit",
        named.0
    );
    log.report(&named.1, DiagnosticKind::Recipe { reason });
    None
}

/// A quantity at a key that must be there and be above zero, in coherent SI units.
fn above_zero(of: &Object<'_>, key: &'static str, default: &str) -> Option<f64> {
    of.required(key)?;
    let found: Quantity = quantity(of, key, default)?;
    positive(of, key, &found).then(|| found.si())
}
