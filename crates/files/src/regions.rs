//! The outputs of a file that are covered together.

use super::keys;
use gumption_engine::model::Output;
use gumption_engine::propagate::Region;
use gumption_text::DiagnosticKind;
use gumption_text::json::Json;
use gumption_text::object::Object;
use gumption_units::nearest;

/// Outputs of a region, at most.
const MOST_OUTPUTS: usize = 1000;

/// Reads `regions` of the root object; outputs are named as in the file.
pub(super) fn read(root: &Object<'_>, outputs: &[Output]) -> Vec<Region> {
    let (log, mut regions) = (root.log, Vec::new());
    let Some(list) = root.list("regions") else { return regions };
    for node in list.iter().take_while(|_| !log.is_full()) {
        let Some(object) = Object::new(log, "a region", node, &node.span) else { continue };
        keys::check(&object, keys::REGION);
        let probability = object.number("probability");
        if let (Some(found), Some(member)) = (probability, object.get("probability"))
            && !(found > 0.0 && found < 1.0)
        {
            let key = "probability".into();
            log.report(
                &member.value.span,
                DiagnosticKind::NotProbability { key, found, below: 1.0 },
            );
        }
        if object.required("outputs").is_none() {
            continue;
        }
        let Some(names) = object.list("outputs") else { continue };
        if names.len() > MOST_OUTPUTS {
            let (what, found) = ("outputs of a region", names.len());
            object.report(DiagnosticKind::TooMany { what, found, most: MOST_OUTPUTS });
            continue;
        }
        let mut found: Vec<usize> = Vec::new();
        for name in names {
            let Json::Text(text) = &name.value else {
                let (what, expected) = ("an output of a region".to_owned(), "a name");
                let diagnostic =
                    DiagnosticKind::WrongType { what, found: name.value.kind(), expected };
                log.report(&name.span, diagnostic);
                continue;
            };
            // a complex output is its two parts
            let is = |output: &&Output| {
                let own = &output.quantity.name;
                own == text || own.rsplit_once('.').is_some_and(|(whole, _)| whole == text)
            };
            let before = found.len();
            for output in outputs.iter().filter(is) {
                let place = outputs.iter().position(|o| o.quantity.name == output.quantity.name);
                match place.filter(|place| !found.contains(place)) {
                    Some(place) => found.push(place),
                    None => {
                        let reason = format!("it has the output `{text}` twice");
                        log.report(&name.span, DiagnosticKind::Region { reason });
                    }
                }
            }
            if found.len() == before && outputs.iter().all(|output| !is(&output)) {
                let known = outputs.iter().map(|output| output.quantity.name.as_str());
                let diagnostic = DiagnosticKind::UnknownOutput {
                    name: text.clone(),
                    nearest: nearest(text, known.clone()).map(str::to_owned),
                    known: known.map(str::to_owned).collect(),
                };
                log.report(&name.span, diagnostic);
            }
        }
        if found.len() < 2 && log.is_clean() {
            let reason = "a region is of two outputs or more".to_owned();
            let place = object.get("outputs").map_or(object.place(), |member| &member.value.span);
            log.report(place, DiagnosticKind::Region { reason });
        }
        regions.push(Region { outputs: found, probability });
    }
    regions
}
