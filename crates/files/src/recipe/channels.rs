//! The channels of a recipe.

use std::ops::Range;

use super::super::keys;
use super::column::column;
use super::quantity::{of_member, positive, unit};
use super::recordings::{RecordingFile, SearchFile};
use super::waveform::{RecipeFiles, WaveformFile};
use super::{check_name, steps};
use gumption_columns::gravity;
use gumption_columns::recording::{ColumnName, Conversion, Wanted};
use gumption_engine::fact;
use gumption_engine::task::Warning;
use gumption_signal::{Channel, ChannelRateSearch};
use gumption_text::json::Member;
use gumption_text::object::Object;
use gumption_text::value_text::ValueOf;
use gumption_text::{Collector, DiagnosticKind, column_heading};
use gumption_units::Unit;
use gumption_units::nearest;

/// A channel, as the recipe describes it.
#[derive(Clone, Debug)]
pub(super) struct ChannelFile {
    pub(super) channel: Channel,
    pub(super) recording: usize,
    /// Units of the channel for one raw unit.
    pub(super) gain: f64,
    pub(super) place: Range<usize>,
    pub(super) step_places: Vec<Range<usize>>,
    /// The step whose answer is the waveform, if it has one.
    pub(super) waveform: Option<WaveformFile>,
    column: ColumnName,
    /// The unit of its raw values; 1 of counts.
    raw_unit: Unit,
    /// The unit of its values before the steps.
    pub(super) own_unit: Unit,
    zero: f64,
    range: Option<[f64; 2]>,
}

pub(super) fn read(
    root: &Object<'_>,
    recordings: &[RecordingFile],
    files: &mut RecipeFiles<'_>,
) -> Option<Vec<ChannelFile>> {
    let member = root.required("channels")?;
    let object = Object::new(root.log, "`channels`", &member.value, &member.key_span)?;
    refuse_uncertainties_of(root.log, object.members());
    let read: Vec<Option<ChannelFile>> = object
        .members()
        .iter()
        .map(|member| channel(root.log, member, recordings, files))
        .collect();
    if read.is_empty() {
        root.log.report(&member.key_span, DiagnosticKind::NoValues { name: "channels".into() });
        return None;
    }
    read.into_iter().collect()
}

/// Refuses a channel whose figures would have the names of the uncertainties of another one's: `u_a`
/// beside `a`.
fn refuse_uncertainties_of(log: &Collector, members: &[Member]) {
    for member in members {
        let of = member.key.strip_prefix("u_");
        if let Some(of) = of.filter(|base| members.iter().any(|other| other.key == *base)) {
            let reason =
                format!("`{}_amplitude` is the uncertainty of the amplitude of `{of}`", member.key);
            let name = member.key.clone();
            log.report(&member.key_span, DiagnosticKind::BadName { name, reason });
        }
    }
}

fn channel(
    log: &Collector,
    member: &Member,
    recordings: &[RecordingFile],
    files: &mut RecipeFiles<'_>,
) -> Option<ChannelFile> {
    check_name(log, &member.key, &member.key_span);
    let object = Object::new(log, "a channel", &member.value, &member.key_span)?;
    keys::check(&object, keys::CHANNEL);
    let recording = recording(&object, recordings);
    let column = object.required("column").and_then(|member| column(log, member));
    let own = unit(&object, "unit", "1");
    // what is not said to be in another unit is in the channel's, or in counts where it is scaled
    let scaled = object.get("scale").is_some() || object.get("sensitivity").is_some();
    let raw = match (object.get("raw_unit"), scaled, &own) {
        (None, false, Some(own)) => Some(own.clone()),
        _ => unit(&object, "raw_unit", "1"),
    };
    if let (Some(member), Some(ColumnName::Name(name)), Some(raw)) =
        (object.get("column"), &column, &raw)
    {
        column_heading::check(log, &member.value.span, name, (raw, ValueOf::Quantity));
    }
    let scale = own.as_ref().zip(raw.as_ref()).and_then(|(own, raw)| scale(&object, own, raw));
    let zero = object.number("offset").unwrap_or(0.0);
    let range = range(&object);
    let resolution = resolution(&object, range);
    let steps = steps::read(&object, own.as_ref()?, files)?;
    let (gain, scale_uncertainty) = scale?;
    Some(ChannelFile {
        channel: Channel {
            name: member.key.clone(),
            unit: steps.unit,
            scale_uncertainty,
            resolution: resolution * gain.abs(),
            steps: steps.steps,
        },
        recording: recording?,
        gain,
        place: member.key_span.clone(),
        step_places: steps.places,
        waveform: steps.waveform,
        column: column?,
        raw_unit: raw?,
        own_unit: own?,
        zero,
        range,
    })
}

fn recording(of: &Object<'_>, recordings: &[RecordingFile]) -> Option<usize> {
    let Some(member) = of.get("recording") else {
        if recordings.len() != 1 {
            of.required("recording");
        }
        return (recordings.len() == 1).then_some(0);
    };
    let name = of.text("recording")?;
    let place = recordings.iter().position(|recording| recording.name == name);
    if place.is_none() {
        let near = nearest(name, recordings.iter().map(|recording| recording.name.as_str()));
        let reason = match near {
            Some(near) => format!("there is no recording `{name}`; did you mean `{near}`?"),
            None => format!("there is no recording `{name}`"),
        };
        of.log.report(&member.value.span, DiagnosticKind::Recipe { reason });
    }
    place
}

/// Units of the channel for one raw unit, and the relative standard uncertainty of that.
fn scale(of: &Object<'_>, own: &Unit, raw: &Unit) -> Option<(f64, f64)> {
    let (key, member, divides) = match (of.get("scale"), of.get("sensitivity")) {
        (Some(_), Some(second)) => {
            let diagnostic = DiagnosticKind::Exclusive { first: "scale", second: "sensitivity" };
            of.log.report(&second.key_span, diagnostic);
            return None;
        }
        (Some(member), None) => ("scale", member, false),
        (None, Some(member)) => ("sensitivity", member, true),
        (None, None) => {
            let Ok(factor) = Unit::conversion_factor(raw, own) else {
                if let Some(member) = of.get("raw_unit") {
                    super::quantity::same_dimension(of, member, raw, own);
                }
                return None;
            };
            // an offset would be one of a scale that begins elsewhere
            if let Some(member) =
                of.get("raw_unit").filter(|_| Unit::convert(0.0, raw, own) != Ok(0.0))
            {
                let reason = format!(
                    "values in `{raw}` count from another zero than those in `{own}`, and a channel is \
                     scaled, never shifted; let `unit` be `{raw}`, too, and convert in the model"
                );
                of.log.report(&member.value.span, DiagnosticKind::Recipe { reason });
                return None;
            }
            return Some((factor, 0.0));
        }
    };
    let quantity = of_member(of, member, "1")?;
    if quantity.value == 0.0 {
        positive(of, key, &quantity);
        return None;
    }
    let dimension = raw.dimension();
    let becomes = if divides {
        dimension.checked_div(quantity.unit.dimension())
    } else {
        dimension.checked_mul(quantity.unit.dimension())
    };
    if becomes != Some(own.dimension()) {
        let wanted = if divides {
            dimension.checked_div(own.dimension())
        } else {
            own.dimension().checked_div(dimension)
        };
        let expected = if divides { format!("{raw}/({own})") } else { format!("{own}/({raw})") };
        let reason = format!(
            "raw values in `{raw}` with a `{key}` in `{}` do not become `{own}`; its unit must be such \
             as `{expected}`{}",
            quantity.unit,
            match (wanted, becomes) {
                (Some(wanted), _) if gravity::meant(quantity.unit.text(), wanted).is_some() =>
                    gravity::hint(quantity.unit.text(), wanted),
                (_, Some(becomes)) => gravity::hint(own.text(), becomes),
                _ => String::new(),
            }
        );
        of.log.report(&member.value.span, DiagnosticKind::Recipe { reason });
        return None;
    }
    let size = quantity.si();
    let gain = if divides { raw.factor() / size } else { raw.factor() * size };
    let relative = (quantity.standard_uncertainty / quantity.value).abs();
    Some((own.from_si(gain), relative))
}

/// The limits of raw values.
fn range(of: &Object<'_>) -> Option<[f64; 2]> {
    let member = of.get("range")?;
    let numbers = of.numbers("range")?;
    match numbers.as_slice() {
        [lower, upper] if lower < upper => Some([*lower, *upper]),
        _ => {
            let reason =
                "`range` is the lowest and the highest raw value, in that order".to_owned();
            of.log.report(&member.value.span, DiagnosticKind::Recipe { reason });
            None
        }
    }
}

/// The resolution in the raw unit; 0 where it is not known.
fn resolution(of: &Object<'_>, range: Option<[f64; 2]>) -> f64 {
    if let (Some(_), Some(second)) = (of.get("resolution"), of.get("bits")) {
        let diagnostic = DiagnosticKind::Exclusive { first: "resolution", second: "bits" };
        of.log.report(&second.key_span, diagnostic);
    }
    if let Some(member) = of.get("resolution") {
        let found = of.number("resolution").unwrap_or(0.0);
        if found < 0.0 {
            let diagnostic = DiagnosticKind::NotPositive { key: "resolution".into(), found };
            of.log.report(&member.value.span, diagnostic);
        }
        return found;
    }
    let (Some(member), Some(bits)) = (of.get("bits"), of.whole("bits", 1, 64)) else { return 0.0 };
    match range {
        Some([lower, upper]) => (upper - lower) / 2f64.powi(i32::try_from(bits).unwrap_or(64)),
        None => {
            if of.get("range").is_none() {
                let diagnostic = DiagnosticKind::OnlyWith { key: "bits", with: "range" };
                of.log.report(&member.key_span, diagnostic);
            }
            0.0
        }
    }
}

impl ChannelFile {
    /// A note where it is in grams: what oscillates and is written in `g` is an acceleration as a rule.
    pub(super) fn in_grams(&self) -> Option<Warning> {
        let acceleration = super::quantity::own_unit("m/s^2").dimension();
        let meant = gravity::meant(self.own_unit.text(), acceleration)?;
        let (name, unit) = (&self.channel.name, &self.own_unit);
        Some(Warning::new(name, fact!("grams", name, unit, meant = &meant)))
    }

    /// Its column, and what its raw values become.
    pub(super) fn wanted(&self) -> (Wanted, Conversion) {
        let wanted = Wanted {
            column: self.column.clone(),
            channel: self.channel.name.clone(),
            unit: self.raw_unit.clone(),
            becomes: self.own_unit.clone(),
        };
        (wanted, Conversion { zero: self.zero, gain: self.gain, range: self.range })
    }
}

impl SearchFile {
    /// The search, in one of the channels of its recording.
    pub(super) fn resolved(
        &self,
        log: &Collector,
        recording: usize,
        channels: &[ChannelFile],
    ) -> Option<ChannelRateSearch> {
        let at =
            |file: &ChannelFile| file.channel.name == self.channel && file.recording == recording;
        let channel = channels.iter().position(at);
        if channel.is_none() {
            let reason = format!("this recording has no channel `{}`", self.channel);
            log.report(&self.place, DiagnosticKind::Recipe { reason });
        }
        Some(ChannelRateSearch {
            channel: channel?,
            frequency: self.frequency,
            between: self.between,
            step: self.step,
        })
    }
}
