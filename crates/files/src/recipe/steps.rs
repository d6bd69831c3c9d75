//! The steps of a channel: names, or objects with a name and parameters. A new step is one arm of
//! [`step`], and its name with its parameters in [`ALL`].

use std::ops::Range;

use super::super::keys::{self, STEPS};
use super::quantity::{Quantity, positive, quantity, same_dimension, unit};
use super::waveform::{self, RecipeFiles, WaveformFile};
use gumption_signal::{Band, Butterworth, ChannelStep, Measured, Response, ResponsePoint};
use gumption_text::DiagnosticKind;
use gumption_text::json::{Json, Member, Node};
use gumption_text::object::Object;
use gumption_units::Unit;

/// The step that an object describes, whose keys were checked, and the unit that values have after
/// it. `of_values` is the unit before.
fn step(name: &str, of: &Object<'_>, of_values: &Unit) -> Option<(ChannelStep, Unit)> {
    let same = |step| Some((step, of_values.clone()));
    match name {
        "remove-mean" => same(ChannelStep::RemoveMean),
        "remove-trend" => same(ChannelStep::RemoveTrend),
        "whole-periods" => same(ChannelStep::WholePeriods),
        "low-pass" => same(filter(of, Band::LowPass(hertz(of, "cutoff")?))?),
        "high-pass" => same(filter(of, Band::HighPass(hertz(of, "cutoff")?))?),
        "band-pass" => {
            let (low, high) = (hertz(of, "low")?, hertz(of, "high")?);
            if low >= high {
                let reason = format!(
                    "`high` is {} Hz, but must be above `low`, {} Hz",
                    gumption_engine::number::Shortest(high),
                    gumption_engine::number::Shortest(low)
                );
                of.log.report(&of.get("high")?.value.span, DiagnosticKind::Recipe { reason });
                return None;
            }
            same(filter(of, Band::BandPass(low, high))?)
        }
        "derivative" | "integral" => derivative(of, of_values, name == "integral"),
        "tangential" | "radial" => rotation(of, of_values, name == "radial"),
        "correct" => same(correct(of)?),
        "delay" => {
            let segments = match of.get("segments") {
                Some(_) => Some(usize::try_from(of.whole("segments", 2, 10_000)?).ok()?),
                None => None,
            };
            same(ChannelStep::Delay { segments })
        }
        "rms" => same(ChannelStep::Rms),
        _ => None,
    }
}

/// A frequency in hertz, above zero, that must be there.
fn hertz(of: &Object<'_>, key: &'static str) -> Option<f64> {
    of.required(key)?;
    let found = quantity(of, key, "Hz")?;
    positive(of, key, &found).then(|| found.si())
}

fn filter(of: &Object<'_>, band: Band) -> Option<ChannelStep> {
    let poles = match of.get("order") {
        Some(_) => of.whole("order", 1, 24)?,
        None if matches!(band, Band::BandPass(..)) => 2,
        None => 6,
    };
    let poles = usize::try_from(poles).ok()?;
    if matches!(band, Band::BandPass(..)) && poles % 2 == 1 {
        let reason = format!("a band-pass filter has an even order, not {poles}");
        of.log.report(&of.get("order")?.value.span, DiagnosticKind::Recipe { reason });
        return None;
    }
    let truth = |key: &'static str, otherwise| match of.get(key) {
        Some(_) => of.truth(key),
        None => Some(otherwise),
    };
    let both_ways = truth("both_ways", false)?;
    let filter = Butterworth { band, poles, both_ways };
    Some(ChannelStep::Filter { filter, correct: truth("correct", true)? })
}

/// The highest frequency that is kept, where the recipe says.
fn highest(of: &Object<'_>) -> Option<Option<f64>> {
    if of.get("highest").is_some() { hertz(of, "highest").map(Some) } else { Some(None) }
}

fn derivative(of: &Object<'_>, of_values: &Unit, integral: bool) -> Option<(ChannelStep, Unit)> {
    let times = match of.get("times") {
        Some(_) => of.whole("times", 1, 4)?,
        None => 1,
    };
    let times = i32::try_from(times).ok()?;
    let order = if integral { -times } else { times };
    let whole = whole_text(of_values);
    let text = match order {
        1 => format!("{whole}/s"),
        -1 => format!("{whole}*s"),
        _ if integral => format!("{whole}*s^{times}"),
        _ => format!("{whole}/s^{times}"),
    };
    let (factor, after) = converted(of, &text)?;
    Some((ChannelStep::Derivative { order, highest: highest(of)?, factor }, after))
}

/// The text of a unit such that it can be a factor.
pub(super) fn whole_text(unit: &Unit) -> String {
    let text = unit.text();
    if text.chars().all(char::is_alphanumeric) { text.to_owned() } else { format!("({text})") }
}

/// The unit of the answer, that of the step's key `unit` or else `natural`, and how many of it are
/// one of `natural`.
pub(super) fn converted(of: &Object<'_>, natural: &str) -> Option<(f64, Unit)> {
    let natural = Unit::parse(natural).ok()?;
    let Some(member) = of.get("unit") else { return Some((1.0, natural)) };
    let wanted = unit(of, "unit", "1")?;
    same_dimension(of, member, &wanted, &natural).then_some(())?;
    Some((Unit::conversion_factor(&natural, &wanted).ok()?, wanted))
}

fn rotation(of: &Object<'_>, of_values: &Unit, radial: bool) -> Option<(ChannelStep, Unit)> {
    let member = of.required("radius")?;
    if member.value.number().is_some() {
        let reason = "`radius` needs a unit, such as {\"value\": 170, \"unit\": \"mm\"}".to_owned();
        of.log.report(&member.value.span, DiagnosticKind::Recipe { reason });
        return None;
    }
    let found = quantity(of, "radius", "m")?;
    positive(of, "radius", &found).then_some(())?;
    let radian = Unit::parse("rad").ok()?;
    if !of_values.is_compatible(&radian) {
        let reason = format!(
            "this step takes an angle, in a unit such as `deg`; the values are in `{of_values}`"
        );
        of.log.report(of.place(), DiagnosticKind::Recipe { reason });
        return None;
    }
    let (factor, after) = converted(of, "m/s^2")?;
    let step = ChannelStep::Rotation {
        radial,
        radius: measured(&found),
        highest: highest(of)?,
        radians: Unit::conversion_factor(of_values, &radian).ok()?,
        factor,
    };
    Some((step, after))
}

pub(super) fn measured(of: &Quantity) -> Measured {
    Measured {
        value: of.si(),
        standard_uncertainty: of.si_uncertainty(),
        degrees_of_freedom: f64::INFINITY,
    }
}

fn correct(of: &Object<'_>) -> Option<ChannelStep> {
    let kinds = ["response", "high_passes", "delay", "phase"];
    let given: Vec<&'static str> = kinds.into_iter().filter(|key| of.get(key).is_some()).collect();
    if let [first, second, ..] = given[..] {
        of.log.report(&of.get(second)?.key_span, DiagnosticKind::Exclusive { first, second });
        return None;
    }
    let plain = of.get("gain");
    if let (Some(member), Some(&with @ ("response" | "high_passes"))) = (plain, given.first()) {
        let diagnostic = DiagnosticKind::Exclusive { first: with, second: "gain" };
        of.log.report(&member.key_span, diagnostic);
        return None;
    }
    if given.is_empty() && plain.is_none() {
        of.required("gain")?;
    }
    let mut gain =
        Measured { value: 1.0, standard_uncertainty: 0.0, degrees_of_freedom: f64::INFINITY };
    if plain.is_some() {
        let found = quantity(of, "gain", "1")?;
        positive(of, "gain", &found).then_some(())?;
        gain = measured(&found);
    }
    let (mut of_phase, mut of_delay) = (0.0, 0.0);
    let response = match given.first() {
        Some(&"response") => Response::Points(points(of)?),
        Some(&"high_passes") => {
            let corners = of.numbers("high_passes")?;
            let wrong = corners.iter().find(|corner| **corner <= 0.0);
            if let Some(found) = wrong {
                let diagnostic =
                    DiagnosticKind::NotPositive { key: "high_passes".into(), found: *found };
                of.log.report(&of.get("high_passes")?.value.span, diagnostic);
                return None;
            }
            Response::HighPasses(corners)
        }
        Some(&"phase") => {
            let phase = measured(&quantity(of, "phase", "deg")?);
            of_phase = phase.standard_uncertainty;
            let point = ResponsePoint { frequency: 0.0, gain: gain.value, phase: phase.value };
            Response::Points(vec![point])
        }
        Some(_) => {
            let delay = measured(&quantity(of, "delay", "s")?);
            of_delay = delay.standard_uncertainty;
            Response::Delayed { gain: gain.value, delay: delay.value }
        }
        None => Response::Delayed { gain: gain.value, delay: 0.0 },
    };
    let of_gain = gain.standard_uncertainty / gain.value;
    Some(ChannelStep::Correct { response, of_gain, of_phase, of_delay })
}

/// The points of a response, by rising frequency.
fn points(of: &Object<'_>) -> Option<Vec<ResponsePoint>> {
    let mut points: Vec<ResponsePoint> = Vec::new();
    let member = of.get("response")?;
    for node in of.list("response")? {
        let point = Object::new(of.log, "a point of a response", node, &node.span)?;
        keys::check(&point, keys::POINT);
        point.required("gain")?;
        let gain = quantity(&point, "gain", "1")?;
        positive(&point, "gain", &gain).then_some(())?;
        let phase = match point.get("phase") {
            Some(_) => quantity(&point, "phase", "deg")?.si(),
            None => 0.0,
        };
        let frequency = hertz(&point, "frequency")?;
        if points.last().is_some_and(|last| last.frequency >= frequency) {
            let reason = "the points of a response stand by rising frequency".to_owned();
            of.log.report(&node.span, DiagnosticKind::Recipe { reason });
            return None;
        }
        points.push(ResponsePoint { frequency, gain: gain.si(), phase });
    }
    if points.is_empty() {
        of.log.report(&member.key_span, DiagnosticKind::NoValues { name: "response".into() });
        return None;
    }
    Some(points)
}

/// The steps of a channel.
pub(super) struct Steps {
    pub(super) steps: Vec<ChannelStep>,
    /// Where they stand.
    pub(super) places: Vec<Range<usize>>,
    /// The unit of values after them.
    pub(super) unit: Unit,
    /// The last one, if the answer is the waveform.
    pub(super) waveform: Option<WaveformFile>,
}

/// The steps of a channel, in order, whose values are in `unit`; nothing after a mistake.
pub(super) fn read(
    channel: &Object<'_>,
    unit: &Unit,
    files: &mut RecipeFiles<'_>,
) -> Option<Steps> {
    let mut read =
        Steps { steps: Vec::new(), places: Vec::new(), unit: unit.clone(), waveform: None };
    if channel.get("steps").is_none() {
        return Some(read);
    }
    for node in channel.list("steps")? {
        // a name alone is an object with nothing else
        let alone = Node {
            span: node.span.clone(),
            value: Json::Object(vec![Member {
                key: "step".to_owned(),
                key_span: node.span.clone(),
                value: node.clone(),
            }]),
        };
        let whole = if matches!(node.value, Json::Text(_)) { &alone } else { node };
        let object = Object::new(channel.log, "a step", whole, &whole.span)?;
        object.required("step")?;
        let name = object.text("step")?;
        let Some((_, keys)) = STEPS.iter().find(|(known, _)| *known == name) else {
            let allowed = STEPS.map(|(name, _)| name.to_owned()).to_vec();
            let diagnostic =
                DiagnosticKind::NotOneOf { key: "step".into(), found: name.to_owned(), allowed };
            channel.log.report(&node.span, diagnostic);
            return None;
        };
        keys::check_names(&object, &[&["step"], *keys].concat());
        if read.waveform.is_some() {
            let reason = "`waveform` is the last step: its answer is the signal itself".to_owned();
            channel.log.report(&node.span, DiagnosticKind::Recipe { reason });
            return None;
        }
        if name == "waveform" {
            waveform::check_before(&object, &read.steps)?;
            let (found, unit) = waveform::read(&object, &read.unit, files)?;
            read.waveform = Some(found);
            read.places.push(node.span.clone());
            read.unit = unit;
            continue;
        }
        let (step, unit) = step(name, &object, &read.unit)?;
        read.steps.push(step);
        read.places.push(node.span.clone());
        read.unit = unit;
    }
    Some(read)
}
