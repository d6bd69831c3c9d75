//! Changes the way in which an input is known, and keeps typed values that have a meaning there.

use std::collections::HashMap;
use std::path::Path;

use gumption_files::{FileReader, schema};
use gumption_text::value_text::with_plus_minus;
use jsonc_parser::ast::Value;
use serde::Deserialize;
use serde_json::{Value as Json, json};

use crate::edit::{self, Edit};
use crate::quantity;
use crate::tree::{self, PathStep};
use crate::ways::{self, CENTRES, Role, WIDTHS, Way};
use crate::{LiveError, inputs, limited};

/// A request of the call `reshape`.
#[derive(Debug, Deserialize)]
pub(crate) struct ReshapeRequest {
    text: String,
    /// The input.
    path: Vec<PathStep>,
    /// A way of `kinds`, or a distribution.
    way: String,
    /// What was typed into fields of this input before, by key.
    #[serde(default)]
    kept: HashMap<String, String>,
}

/// Keys that say how an input is known; the others of a distribution say something beside it.
const OWN: [&str; 14] = [
    "k",
    "p",
    "lower",
    "upper",
    "values",
    "file",
    "column",
    "s",
    "n",
    "id",
    "ref_type",
    "output",
    "beta",
    "inexactness",
];

/// The text with another way in which an input is known.
pub(crate) fn reshaped(files: FileReader<'_>, asked: &ReshapeRequest) -> Result<Json, LiveError> {
    let text = limited(&asked.text)?;
    let bare = text.strip_prefix('\u{feff}').unwrap_or(text);
    let Some(way) = ways::way(&asked.way) else {
        return Err(LiveError::Request(format!("there is no distribution `{}`", asked.way)));
    };
    let fault = |why: String| LiveError::Request(why);
    let root = tree::parse(bare).map_err(fault)?;
    let Some(input) = tree::at(&root, &asked.path) else {
        return Err(LiveError::Request("there is no such input".to_owned()));
    };
    let Value::Object(object) = input else {
        let made = written_out(files, asked, text, way)?;
        return Ok(json!({ "text": made }));
    };
    let value = |key: &str| tree::member(object, key).map(|of| tree::raw(bare, &of.value));
    let has = |key: &str| tree::member(object, key).is_some();
    let number = |key: &str| {
        let typed = value(key).or_else(|| asked.kept.get(key).cloned());
        typed.and_then(|text| text.parse::<f64>().ok())
    };
    let limits = number("lower").zip(number("upper"));
    let step = |key: &str| {
        let mut path = asked.path.clone();
        path.push(PathStep::Key(key.to_owned()));
        path
    };
    let shapes = schema::distributions();
    let keys_of = |name: &str| {
        let of = shapes.iter().find(|of| of.name == name || of.aliases.contains(&name));
        of.map_or(&[][..], |of| of.keys)
    };
    let keys = keys_of(way.distribution);
    let mut edits = vec![Edit::set(step("distribution"), json!(way.distribution))];
    // limits are kept if the new distribution has them too
    let asks_width = ways::WAYS.iter().any(|own| own.name == way.name);
    let keeps_limits = !asks_width && has("lower") && has("upper") && keys.contains(&"lower");
    let mut taken: Vec<String> = Vec::new();
    if keeps_limits {
        taken.extend(["lower", "upper"].map(str::to_owned));
    }
    for (key, role) in way.needed {
        let replaced = keeps_limits && matches!(role, Role::Centre | Role::Width);
        if has(key) || replaced {
            taken.push((*key).to_owned());
            continue;
        }
        let old = match role {
            Role::Centre => CENTRES.into_iter().find(|old| has(old)),
            Role::Width => WIDTHS.into_iter().find(|old| has(old)),
            _ => None,
        };
        if let Some(old) = old.filter(|old| !taken.iter().any(|of| of == old)) {
            taken.push(old.to_owned());
            edits.push(Edit::rename(step(old), key));
            continue;
        }
        if let Some(before) = asked.kept.get(*key) {
            edits.push(Edit::typed(step(key), before));
            continue;
        }
        let centre = CENTRES.into_iter().find_map(number).or(limits.map(|(a, b)| 0.5 * (a + b)));
        let width = WIDTHS.into_iter().find_map(number).or(limits.map(|(a, b)| 0.5 * (b - a)));
        edits.push(Edit::set(step(key), role.value(centre, width)));
    }
    // keys of the old distribution go, unless they say something beside it that holds for the new one
    let old = value("distribution").unwrap_or_default();
    // the resolution of readings is a width, and that of others the value of a count
    let is_alike = (old == "readings") == (way.distribution == "readings");
    let is_own = |key: &str| OWN.contains(&key) || CENTRES.contains(&key) || WIDTHS.contains(&key);
    for key in keys_of(&old) {
        let stays = is_alike && keys.contains(key) && !is_own(key);
        if has(key) && !stays && !taken.iter().any(|of| of == key) {
            edits.push(Edit::remove(step(key)));
        }
    }
    // `100 ohm ± 0.1 %` is decided by the way
    let undecided =
        CENTRES.into_iter().filter_map(value).find(|of| with_plus_minus(of).contains('±'));
    let centre = way.needed.iter().find(|(_, role)| *role == Role::Centre);
    if let (Some(typed), Some((key, _))) = (undecided, centre) {
        edits.push(Edit::typed(step(key), &typed));
    }
    let made = quantity::edited(text, &edits).map_err(fault)?;
    Ok(json!({ "text": made }))
}

/// An input that was a value in words, as an object with keys.
fn written_out(
    files: FileReader<'_>,
    asked: &ReshapeRequest,
    text: &str,
    way: Way,
) -> Result<String, LiveError> {
    let name = asked.path.last().map(PathStep::to_string).unwrap_or_default();
    let read = files.model_text("the model", text, Path::new(""), &[]).ok();
    let known = read.as_ref().and_then(|file| inputs::drawn(&file.task, &name));
    let mut input = serde_json::Map::new();
    let unit = known.map_or("1", |(variable, _)| variable.unit.text());
    input.insert("unit".to_owned(), json!(unit));
    input.insert("distribution".to_owned(), json!(way.distribution));
    let centre = known.map(|(_, of)| of.mean());
    let width = known.map(|(_, of)| of.standard_uncertainty());
    for (key, role) in way.needed {
        let value = role.value(centre, width);
        input.insert((*key).to_owned(), value);
    }
    let edit = Edit::set(asked.path.clone(), Json::Object(input));
    edit::edited(text, &[edit]).map_err(LiveError::Request)
}
