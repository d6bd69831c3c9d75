//! Changes the distribution of an input, and keeps typed values that have a meaning there.

use std::path::Path;

use gumption_engine::number::Shortest;
use gumption_files::{FileReader, schema};
use jsonc_parser::ast::Value;
use serde::Deserialize;
use serde_json::{Value as Json, json};

use crate::edit::{self, Edit};
use crate::tree::{self, PathStep};
use crate::{LiveError, inputs, limited};

/// A request of the call `reshape`.
#[derive(Debug, Deserialize)]
pub(crate) struct ReshapeRequest {
    text: String,
    /// The input.
    path: Vec<PathStep>,
    distribution: String,
}

/// The meaning of a key of a distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Role {
    /// Where it lies.
    Centre,
    /// Its width: whatever the parameter, the typed number is kept.
    Width,
    /// Its limits.
    Lower,
    Upper,
    /// A share of the width.
    Share(f64),
    /// A number to begin with.
    Number(f64),
    /// A text to be filled in.
    Text,
    /// Numbers to be filled in.
    List,
}

impl Role {
    /// The initial value of a key, from the location and the width of the input.
    fn value(self, centre: Option<f64>, width: Option<f64>) -> Json {
        let both = centre.zip(width);
        let figure = match self {
            Self::Text => return json!(""),
            Self::List => return json!([]),
            Self::Centre => centre,
            Self::Width => width,
            Self::Lower => both.map(|(centre, width)| centre - width),
            Self::Upper => both.map(|(centre, width)| centre + width),
            Self::Share(share) => width.map(|width| share * width),
            Self::Number(value) => Some(value),
        };
        figure.map_or(Json::Null, plain_number)
    }
}

/// The keys that a new distribution gets.
pub(crate) fn needed(name: &str) -> &'static [(&'static str, Role)] {
    use Role::{Centre, List, Lower, Number, Share, Text, Upper, Width};
    match name {
        "constant" => &[("value", Centre)],
        "normal" | "lognormal" => &[("mean", Centre), ("std", Width)],
        "rectangular" | "triangular" | "arcsine" => &[("mean", Centre), ("half_width", Width)],
        "trapezoidal" => &[("mean", Centre), ("half_width", Width), ("beta", Number(0.5))],
        "curvilinear-trapezoid" => {
            &[("lower", Lower), ("upper", Upper), ("inexactness", Share(0.1))]
        }
        "t" => &[("mean", Centre), ("scale", Width), ("dof", Number(9.0))],
        "readings" | "samples" => &[("values", List)],
        "exponential" => &[("mean", Centre)],
        "gamma" => &[("shape", Number(2.0)), ("rate", Number(1.0))],
        "beta" => &[("alpha", Number(2.0)), ("beta", Number(2.0))],
        "log-uniform" => &[("lower", Lower), ("upper", Upper)],
        "poisson-count" => &[("count", Centre)],
        "weibull" | "pareto" => &[("shape", Number(3.0)), ("scale", Centre)],
        "gumbel" => &[("location", Centre), ("scale", Width)],
        "chi-squared" => &[("dof", Number(9.0))],
        "binomial" => &[("trials", Number(100.0)), ("probability", Number(0.5))],
        "hypergeometric" => {
            &[("population", Number(100.0)), ("marked", Number(50.0)), ("draws", Number(10.0))]
        }
        "split-normal" => &[("mode", Centre), ("std_low", Width), ("std_high", Width)],
        "quantiles" => &[("probabilities", List), ("values", List)],
        "dcc" => &[("file", Text), ("id", Text)],
        "result" => &[("file", Text), ("output", Text)],
        _ => &[],
    }
}

/// Keys for the location and the width of a distribution.
const CENTRES: [&str; 4] = ["mean", "value", "mode", "count"];
const WIDTHS: [&str; 6] = ["std", "half_width", "semi_range", "scale", "expanded", "std_low"];

/// The text with another distribution of an input.
pub(crate) fn reshaped(files: FileReader<'_>, asked: &ReshapeRequest) -> Result<Json, LiveError> {
    let text = limited(&asked.text)?;
    let bare = text.strip_prefix('\u{feff}').unwrap_or(text);
    let shapes = schema::distributions();
    let known = |name: &str| shapes.iter().find(|of| of.name == name || of.aliases.contains(&name));
    let Some(shape) = known(&asked.distribution) else {
        return Err(LiveError::Request(format!(
            "there is no distribution `{}`",
            asked.distribution
        )));
    };
    let fault = |why: String| LiveError::Request(why);
    let root = tree::parse(bare).map_err(fault)?;
    let Some(input) = tree::at(&root, &asked.path) else {
        return Err(LiveError::Request("there is no such input".to_owned()));
    };
    let Value::Object(object) = input else {
        let made = written_out(files, asked, text, shape.name)?;
        return Ok(json!({ "text": made }));
    };
    let value = |key: &str| tree::member(object, key).map(|of| tree::raw(bare, &of.value));
    let has = |key: &str| tree::member(object, key).is_some();
    let number = |key: &str| value(key).and_then(|text| text.parse::<f64>().ok());
    let limits = number("lower").zip(number("upper"));
    let step = |key: &str| {
        let mut path = asked.path.clone();
        path.push(PathStep::Key(key.to_owned()));
        path
    };
    let mut edits = vec![Edit::set(step("distribution"), json!(shape.name))];
    // limits are kept if the new distribution has them too
    let keeps_limits = has("lower") && has("upper") && shape.keys.contains(&"lower");
    let mut taken: Vec<String> = Vec::new();
    for (key, role) in needed(shape.name) {
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
        let centre = CENTRES.into_iter().find_map(number).or(limits.map(|(a, b)| 0.5 * (a + b)));
        let width = WIDTHS.into_iter().find_map(number).or(limits.map(|(a, b)| 0.5 * (b - a)));
        let value = role.value(centre, width);
        edits.push(Edit::set(step(key), value));
    }
    // keys that only the old distribution has are removed; those of readings mean something else there
    let old = value("distribution").and_then(|name| known(&name));
    let is_alike = old.is_some_and(|old| (old.name == "readings") == (shape.name == "readings"));
    for key in old.map_or(&[][..], |old| old.keys) {
        let stays = is_alike && shape.keys.contains(key) || taken.iter().any(|of| of == key);
        if has(key) && !stays {
            edits.push(Edit::remove(step(key)));
        }
    }
    let made = edit::edited(text, &edits).map_err(fault)?;
    Ok(json!({ "text": made }))
}

/// A number without the last digits due to rounding.
fn plain_number(value: f64) -> Json {
    let text = gumption_engine::decimal::significant(value, 12);
    let short = text.parse::<f64>().ok().unwrap_or(value);
    serde_json::from_str(&Shortest(short).to_string()).unwrap_or(Json::Null)
}

/// An input that was a value in words, as an object with keys.
fn written_out(
    files: FileReader<'_>,
    asked: &ReshapeRequest,
    text: &str,
    shape: &str,
) -> Result<String, LiveError> {
    let name = asked.path.last().map(PathStep::to_string).unwrap_or_default();
    let read = files.model_text("the model", text, Path::new(""), &[]).ok();
    let known = read.as_ref().and_then(|file| inputs::drawn(&file.task, &name));
    let mut input = serde_json::Map::new();
    let unit = known.map_or("1", |(variable, _)| variable.unit.text());
    input.insert("unit".to_owned(), json!(unit));
    input.insert("distribution".to_owned(), json!(shape));
    let centre = known.map(|(_, of)| of.mean());
    let width = known.map(|(_, of)| of.standard_uncertainty());
    for (key, role) in needed(shape) {
        let value = role.value(centre, width);
        input.insert((*key).to_owned(), value);
    }
    let edit = Edit::set(asked.path.clone(), Json::Object(input));
    edit::edited(text, &[edit]).map_err(LiveError::Request)
}
