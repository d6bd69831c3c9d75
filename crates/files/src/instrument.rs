//! The keys beside a width that say what its specification counts in: `resolution`, `range` and
//! `full_scale`.

use super::keys::FileShape;
use gumption_text::json::Json;
use gumption_text::object::Object;
use gumption_text::value_text::ValueOf;
use gumption_text::width::{Instrument, Width, without_plus_minus};
use gumption_text::{DiagnosticKind, WIDTHS};
use gumption_units::Unit;

/// The keys, each with the words of a specification that need it.
const KEYS: [(&str, &str); 3] =
    [("resolution", "`counts` or `digits`"), ("range", "`% of range`"), ("full_scale", "`% FS`")];

/// The widths of a shape that can be specifications, with their texts.
fn specifications<'a>(object: &Object<'a>, kind: &FileShape) -> Vec<(&'static str, &'a str)> {
    let keys = WIDTHS.into_iter().chain(["std_low", "std_high"]);
    let own = keys.filter(|key| kind.fields.contains(key));
    own.filter_map(|key| match &object.get(key)?.value.value {
        Json::Text(text) => Some((key, text.as_str())),
        _ => None,
    })
    .collect()
}

/// What the keys of an object state of its instrument, in its unit; `None` after an error.
pub(super) fn stated(object: &Object<'_>, unit: &Unit) -> Option<Instrument> {
    let value = |key: &'static str| {
        let Some(member) = object.get(key) else { return Some(None) };
        let found = object.value(key, unit, ValueOf::Difference)?;
        if found > 0.0 {
            return Some(Some(found));
        }
        let key = key.to_owned();
        object.log.report(&member.value.span, DiagnosticKind::NotPositive { key, found });
        None
    };
    let [resolution, range, full_scale] = KEYS.map(|(key, _)| value(key));
    Some(Instrument { resolution: resolution?, range: range?, full_scale: full_scale? })
}

/// Reports a key whose words no width of the shape has: it would have no effect.
pub(super) fn check(object: &Object<'_>, kind: &FileShape, unit: &Unit) {
    // of readings, the resolution is a width itself
    let is_known = |key: &str| kind.name != "readings" && kind.fields.contains(&key);
    let present = KEYS.into_iter().filter(|(key, _)| is_known(key) && object.get(key).is_some());
    let own = object.log.own_units();
    for (key, words) in present {
        let Some(stated) = stated(object, unit) else { return };
        let without = match key {
            "resolution" => Instrument { resolution: None, ..stated },
            "range" => Instrument { range: None, ..stated },
            _ => Instrument { full_scale: None, ..stated },
        };
        let read = |text: &str, of: &Instrument| Width::specification(text, unit, &own, Some(of));
        let is_used = specifications(object, kind).into_iter().any(|(width, text)| {
            without_plus_minus(text, width)
                .is_ok_and(|text| read(&text, &stated) != read(&text, &without))
        });
        let Some(member) = object.get(key).filter(|_| !is_used) else { continue };
        let value = &member.value.value;
        let found = value.written().unwrap_or_else(|| value.kind()).to_owned();
        let instead = match key {
            "resolution" => {
                "the uncertainty of a display's step is a component of its own, rectangular with half \
                 of the step"
            }
            _ => "limits are given by their `half_width`, or as `lower` and `upper`",
        };
        let reason = format!(
            "it gives their value to {words} in a width beside it, and no width has them; {instead}"
        );
        let diagnostic = DiagnosticKind::Value { key: key.to_owned(), found, reason };
        object.log.report(&member.key_span, diagnostic);
    }
}
