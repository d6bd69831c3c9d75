//! The low-pass of a waveform, and what is known of the part that it takes away.

use super::super::quantity::{of_member, same_dimension};
use super::above_zero;
use crate::keys;
use gumption_signal::{Cutoff, LowPass, Truncation};
use gumption_text::DiagnosticKind;
use gumption_text::json::{Json, Member};
use gumption_text::object::Object;
use gumption_units::Unit;

/// Whether a member is the text.
fn is(member: &Member, text: &str) -> bool {
    matches!(&member.value.value, Json::Text(found) if found == text)
}

/// The low-pass. What came through a response needs one, or the word that it does without.
pub(super) fn read(of: &Object<'_>) -> Option<Option<LowPass>> {
    let Some(member) = of.get("low_pass") else {
        if of.get("response").is_none() {
            return Some(None);
        }
        let reason = "a division by a response makes noise grow where the response is small: state the low-pass that \
                      limits it, `\"low_pass\": {\"cutoff\": 50e3}` (Hz) or `{\"cutoff\": \"proposed\"}`, or write \
                      `\"low_pass\": \"none\"`";
        of.report(DiagnosticKind::Recipe { reason: reason.to_owned() });
        return None;
    };
    if is(member, "none") {
        return Some(None);
    }
    let inner = Object::new(of.log, "`low_pass`", &member.value, &member.key_span)?;
    keys::check(&inner, keys::LOW_PASS);
    let cutoff = inner.required("cutoff")?;
    let cutoff = match is(cutoff, "proposed") {
        true => Cutoff::Proposed,
        false => Cutoff::Stated(above_zero(&inner, "cutoff", "Hz")?),
    };
    let order = match inner.get("order") {
        Some(_) => inner.whole("order", 1, 24)?,
        None => 2,
    };
    let delay = match inner.get("delay") {
        Some(_) => Some(super::quantity(&inner, "delay", "s")?.si()),
        None => None,
    };
    Some(Some(LowPass { cutoff, order: u32::try_from(order).ok()?, delay }))
}

/// The additional standard uncertainty, in the unit of the answer; 0 where none is stated.
pub(super) fn additional(of: &Object<'_>, unit: &Unit) -> Option<f64> {
    match of.get("additional") {
        Some(member) => size(of, member, unit),
        None => Some(0.0),
    }
}

/// A size above zero, in the unit of the answer.
fn size(of: &Object<'_>, member: &Member, unit: &Unit) -> Option<f64> {
    let found = of_member(of, member, unit.text())?;
    same_dimension(of, member, &found.unit, unit).then_some(())?;
    if found.value <= 0.0 {
        let (key, found) = (member.key.clone(), found.value);
        of.log.report(&member.value.span, DiagnosticKind::NotPositive { key, found });
        return None;
    }
    Some(unit.from_si(found.si()))
}

/// What is known of the part that a low-pass takes away; `unit` is that of the answer.
pub(super) fn truncation(of: &Object<'_>, unit: &Unit, has_low_pass: bool) -> Option<Truncation> {
    let member = match (of.get("truncation"), has_low_pass) {
        (None, false) => return Some(Truncation::Nothing),
        (Some(member), false) => {
            let diagnostic = DiagnosticKind::OnlyWith { key: "truncation", with: "low_pass" };
            of.log.report(&member.key_span, diagnostic);
            return None;
        }
        (Some(member), true) => member,
        (None, true) => {
            let reason = "the low-pass takes part of the signal away: state a bound of that, `\"truncation\": \
                          {\"from\": 20e3, \"decay\": 2}` (from 20 kHz on the spectrum falls at least with the second \
                          power of the frequency) or `{\"bound\": ...}` (in the unit of the answer), or write \
                          `\"truncation\": \"none\"` if the signal has nothing there";
            of.report(DiagnosticKind::Recipe { reason: reason.to_owned() });
            return None;
        }
    };
    if is(member, "none") {
        return Some(Truncation::Nothing);
    }
    let inner = Object::new(of.log, "`truncation`", &member.value, &member.key_span)?;
    keys::check(&inner, keys::TRUNCATION);
    if let Some(bound) = inner.get("bound") {
        if let Some(second) = inner.get("from").or(inner.get("decay")) {
            let diagnostic = DiagnosticKind::Exclusive { first: "bound", second: "decay" };
            of.log.report(&second.key_span, diagnostic);
            return None;
        }
        return size(&inner, bound, unit).map(Truncation::Bound);
    }
    let from = above_zero(&inner, "from", "Hz");
    inner.required("decay")?;
    let power = inner.number("decay")?;
    if power.is_nan() || power <= 1.0 {
        let (key, range) = ("decay".to_owned(), "above 1");
        let diagnostic = DiagnosticKind::OutOfRange { key, found: power, range };
        of.log.report(&inner.get("decay")?.value.span, diagnostic);
        return None;
    }
    Some(Truncation::Decay { from: from?, power })
}
