//! The figures that are asked of a waveform.

use super::super::check_name;
use super::Named;
use super::noise::between;
use crate::keys;
use gumption_signal::WaveformQuantity;
use gumption_text::DiagnosticKind;
use gumption_text::json::{Json, Member, Node};
use gumption_text::object::Object;

/// A figure that is asked for.
pub(super) struct Asked {
    pub(super) quantity: WaveformQuantity,
    /// Its name in the answer.
    pub(super) name: String,
    /// The channel that it names.
    pub(super) other: Option<Named>,
}

/// The figures of a waveform: names, or objects with a name and parameters.
pub(super) fn read(of: &Object<'_>) -> Option<Vec<Asked>> {
    if of.get("quantities").is_none() {
        return Some(Vec::new());
    }
    let mut found: Vec<Asked> = Vec::new();
    for node in of.list("quantities")? {
        let alone = Node {
            span: node.span.clone(),
            value: Json::Object(vec![Member {
                key: "quantity".to_owned(),
                key_span: node.span.clone(),
                value: node.clone(),
            }]),
        };
        let whole = if matches!(node.value, Json::Text(_)) { &alone } else { node };
        let object = Object::new(of.log, "a quantity of a waveform", whole, &whole.span)?;
        let asked = one(&object)?;
        if found.iter().any(|other| other.name == asked.name) {
            let name = asked.name;
            let reason = format!(
                "two quantities are called `{name}`; give one of them another name: `\"name\": \"{name}_2\"`"
            );
            of.log.report(&node.span, DiagnosticKind::Recipe { reason });
            return None;
        }
        found.push(asked);
    }
    Some(found)
}

fn one(object: &Object<'_>) -> Option<Asked> {
    object.required("quantity")?;
    let which = object.text("quantity")?;
    let Some((_, own)) = keys::WAVEFORM_QUANTITIES.iter().find(|(known, _)| *known == which) else {
        let diagnostic = DiagnosticKind::NotOneOf {
            key: "quantity".into(),
            found: which.to_owned(),
            allowed: keys::WAVEFORM_QUANTITIES.map(|(name, _)| name.to_owned()).to_vec(),
        };
        object.log.report(&object.get("quantity")?.value.span, diagnostic);
        return None;
    };
    keys::check_names(object, &[&["quantity", "name"], *own].concat());
    let mut other = None;
    let found = match which {
        "maximum" => WaveformQuantity::Maximum,
        "minimum" => WaveformQuantity::Minimum,
        "maximum-time" => WaveformQuantity::MaximumTime,
        "minimum-time" => WaveformQuantity::MinimumTime,
        "duration" => {
            object.required("level")?;
            let level = object.number("level")?;
            if !(level > 0.0 && level < 1.0) {
                let (key, range) = ("level".to_owned(), "between 0 and 1, of the greatest value");
                let diagnostic = DiagnosticKind::OutOfRange { key, found: level, range };
                object.log.report(&object.get("level")?.value.span, diagnostic);
                return None;
            }
            WaveformQuantity::Duration { level }
        }
        "ratio" => {
            let place = object.required("channel")?.value.span.clone();
            other = Some((object.text("channel")?.to_owned(), place));
            WaveformQuantity::Ratio { channel: 0 }
        }
        _ => {
            // both, or those of the record
            let has_one = object.get("from").is_some() || object.get("to").is_some();
            let between = if has_one { Some(between(object)?) } else { None };
            match which {
                "integral" => WaveformQuantity::Integral { between },
                _ => WaveformQuantity::SquaredIntegral { between },
            }
        }
    };
    let name = match object.get("name") {
        Some(member) => {
            let name = object.text("name")?;
            check_name(object.log, name, &member.value.span);
            name.to_owned()
        }
        None => which.replace('-', "_"),
    };
    Some(Asked { quantity: found, name, other })
}
