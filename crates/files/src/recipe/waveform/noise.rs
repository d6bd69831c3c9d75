//! The noise of a waveform.

use super::super::quantity::{of_member, quantity, same_dimension};
use super::Named;
use crate::keys;
use gumption_signal::{NoiseColour, QuietPart};
use gumption_text::DiagnosticKind;
use gumption_text::object::Object;
use gumption_units::Unit;

/// Where the noise is known from.
pub(super) enum NoiseFile {
    /// Stated, or from the record itself.
    Own(QuietPart),
    /// From a channel without a signal.
    Channel(Named, NoiseColour),
}

/// The noise of a record whose values are in `unit`.
pub(super) fn read(of: &Object<'_>, unit: &Unit) -> Option<NoiseFile> {
    let Some(member) = of.get("noise") else {
        let reason = "the noise of the record must be known: a part of it without a signal, `\"noise\": {\"from\": 0, \
                      \"to\": 0.001}` (s), a channel without a signal, `{\"channel\": \"quiet\"}`, or `{\"standard_uncertainty\": \
                      ...}` (white, in the unit of the channel)";
        of.report(DiagnosticKind::Recipe { reason: reason.to_owned() });
        return None;
    };
    let inner = Object::new(of.log, "`noise`", &member.value, &member.key_span)?;
    keys::check(&inner, keys::WAVEFORM_NOISE);
    let given: Vec<_> = ["standard_uncertainty", "channel", "from"]
        .into_iter()
        .filter(|key| inner.get(key).is_some())
        .collect();
    if let [first, second, ..] = given[..] {
        of.log.report(&inner.get(second)?.key_span, DiagnosticKind::Exclusive { first, second });
        return None;
    }
    let colour = match inner.text("colour") {
        None if inner.get("colour").is_some() => return None,
        None | Some("measured") => NoiseColour::Measured,
        Some("white") => NoiseColour::White,
        Some(found) => {
            let diagnostic = DiagnosticKind::NotOneOf {
                key: "colour".into(),
                found: found.to_owned(),
                allowed: vec!["measured".into(), "white".into()],
            };
            of.log.report(&inner.get("colour")?.value.span, diagnostic);
            return None;
        }
    };
    match given.first() {
        Some(&"standard_uncertainty") => {
            let member = inner.get("standard_uncertainty")?;
            let found = of_member(&inner, member, unit.text())?;
            same_dimension(&inner, member, &found.unit, unit).then_some(())?;
            if found.value < 0.0 {
                let (key, found) = (member.key.clone(), found.value);
                of.log.report(&member.value.span, DiagnosticKind::NotPositive { key, found });
                return None;
            }
            let stated = unit.from_si(found.si()) - unit.from_si(0.0);
            Some(NoiseFile::Own(QuietPart::Stated(stated)))
        }
        Some(&"channel") => {
            let place = inner.get("channel")?.value.span.clone();
            Some(NoiseFile::Channel((inner.text("channel")?.to_owned(), place), colour))
        }
        _ => {
            let [from, to] = between(&inner)?;
            Some(NoiseFile::Own(QuietPart::Between { from, to, colour }))
        }
    }
}

/// The part whose mean is taken off, if one is.
#[expect(clippy::option_option, reason = "outside `None` after a mistake")]
pub(super) fn baseline(of: &Object<'_>) -> Option<Option<[f64; 2]>> {
    let Some(member) = of.get("baseline") else { return Some(None) };
    let inner = Object::new(of.log, "`baseline`", &member.value, &member.key_span)?;
    keys::check(&inner, keys::BASELINE);
    between(&inner).map(Some)
}

/// Two instants in seconds, both of which must be there.
pub(super) fn between(of: &Object<'_>) -> Option<[f64; 2]> {
    let (from, to) = (of.required("from"), of.required("to"));
    from.and(to)?;
    let [from, to] = ["from", "to"].map(|key| quantity(of, key, "s"));
    Some([from?.si(), to?.si()])
}
