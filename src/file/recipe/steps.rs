//! The steps of a channel: names, or objects with a name and parameters. A new step is one arm of
//! [`step`], its name in [`NAMES`], and its parameters in [`KEYS`].

use std::ops::Range;

use super::super::Fault;
use super::super::json::{Json, Member, Node};
use super::super::object::Object;
use crate::observe::Step;

/// The names of the steps.
pub(crate) const NAMES: [&str; 3] = ["remove-mean", "remove-trend", "whole-periods"];

/// The keys of a step.
const KEYS: [&str; 1] = ["step"];

/// The step that an object describes, whose keys were checked.
fn step(name: &str, _of: &Object<'_>) -> Option<Step> {
    match name {
        "remove-mean" => Some(Step::RemoveMean),
        "remove-trend" => Some(Step::RemoveTrend),
        "whole-periods" => Some(Step::WholePeriods),
        _ => None,
    }
}

type Steps = (Vec<Step>, Vec<Range<usize>>);

/// The steps of a channel, in order, and where they stand; nothing after a mistake.
pub(super) fn read(channel: &Object<'_>) -> Option<Steps> {
    let mut steps = Steps::default();
    if channel.get("steps").is_none() {
        return Some(steps);
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
        object.check_keys(&KEYS);
        object.required("step")?;
        let name = object.text("step")?;
        if !NAMES.contains(&name) {
            let allowed = NAMES.map(str::to_owned).to_vec();
            let fault = Fault::NotOneOf { key: "step".into(), found: name.to_owned(), allowed };
            channel.log.report(&node.span, fault);
            return None;
        }
        steps.0.push(step(name, &object)?);
        steps.1.push(node.span.clone());
    }
    Some(steps)
}
