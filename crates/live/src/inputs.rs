//! The rows of the page's tables: the contents of the file, with the path of every cell.

use gumption_engine::distribution::Distribution;
use gumption_engine::task::{Task, Variable};
use gumption_report::number::with_uncertainty;
use gumption_report::{input_picture, plain};
use jsonc_parser::ast::{Object, Value};
use serde_json::{Value as Json, json};

use crate::quantity;
use crate::tree::{self, PathStep, path_of, raw};
use crate::ways::{self, CENTRES};

/// Maximum number of rows of a table.
const MOST: usize = 500;

/// The keys of an object as cells; lists and objects as JSON text.
fn cells(text: &str, object: &Object<'_>, path: &[PathStep]) -> Vec<Json> {
    let one = |member: &jsonc_parser::ast::ObjectProp<'_>| {
        let key = member.name.as_str();
        let mut path = path.to_vec();
        path.push(PathStep::Key(key.to_owned()));
        let kind = match &member.value {
            Value::NumberLit(_) => "number",
            Value::StringLit(_) => "text",
            Value::Array(array) if array.elements.iter().all(is_scalar) => "list",
            Value::NullKeyword(_) => "null",
            _ => "other",
        };
        json!({ "key": key, "path": path, "raw": raw(text, &member.value), "kind": kind })
    };
    object.properties.iter().map(one).collect()
}

fn is_scalar(value: &Value<'_>) -> bool {
    !matches!(value, Value::Array(_) | Value::Object(_))
}

/// The inputs and their components, one row each.
pub(crate) fn rows(text: &str, root: &Value<'_>, task: Option<&Task>) -> Vec<Json> {
    let mut rows = Vec::new();
    let inputs = tree::get(root, "inputs").and_then(Value::as_object);
    for member in inputs.into_iter().flat_map(|object| &object.properties) {
        let name = member.name.as_str();
        let path = path_of(["inputs", name]);
        rows.push(row(text, name, &member.value, &path, task));
        let components = tree::get(&member.value, "components").and_then(Value::as_array);
        for (place, component) in components.iter().flat_map(|of| &of.elements).enumerate() {
            let of = tree::get(component, "name").map(|name| raw(text, name));
            let full = format!("{name}/{}", of.unwrap_or_default());
            let mut path = path.clone();
            path.extend([PathStep::Key("components".to_owned()), PathStep::Place(place)]);
            let mut row = row(text, &full, component, &path, task);
            row["component"] = json!(true);
            rows.push(row);
        }
        if rows.len() > MOST {
            break;
        }
    }
    rows
}

fn row(text: &str, name: &str, value: &Value<'_>, path: &[PathStep], task: Option<&Task>) -> Json {
    let mut row = match value {
        Value::Object(object) => {
            let form = if tree::member(object, "components").is_some() {
                "components"
            } else if tree::member(object, "complex").is_some() {
                "complex"
            } else {
                "object"
            };
            let way = ways::way_of(text, object);
            let typed = CENTRES.into_iter().find_map(|key| tree::member(object, key));
            let undecided = typed.is_some_and(|of| quantity::is_undecided(&raw(text, &of.value)));
            let cells = cells(text, object, path);
            json!({ "form": form, "way": way, "undecided": undecided, "cells": cells })
        }
        other => json!({ "form": "text", "text": raw(text, other), "cells": [] }),
    };
    row["name"] = json!(name);
    row["path"] = json!(path);
    row["component"] = json!(false);
    // the state of an input with components is that of the components
    let of_components = row["form"] == "components";
    let known = task.filter(|_| !of_components).and_then(|task| drawn(task, name));
    if let Some((variable, distribution)) = known {
        let u = distribution.standard_uncertainty();
        let (estimate, uncertainty) = with_uncertainty(distribution.mean(), u, 2);
        row["distribution"] = json!(distribution.name());
        row["estimate"] = json!(distribution.mean());
        row["standard_uncertainty"] = json!(u);
        row["said"] = json!([estimate, uncertainty, plain(variable.unit.text())]);
        row["type"] = json!(variable.evaluation.letter());
        if u > 0.0 && u.is_finite() {
            row["picture"] = json!(input_picture(distribution));
        }
    }
    row
}

/// The distribution of a variable in the first row of conditions.
pub(crate) fn drawn<'t>(task: &'t Task, name: &str) -> Option<(&'t Variable, &'t Distribution)> {
    let place = task.variables.iter().position(|variable| variable.name == name)?;
    let distribution = task.rows.first()?.distributions.get(place)?;
    Some((task.variables.get(place)?, distribution))
}

/// The conditions: one row each, and whether they come from a table file.
pub(crate) fn conditions(text: &str, root: &Value<'_>, task: Option<&Task>) -> Json {
    let object = tree::get(root, "conditions").and_then(Value::as_object);
    let Some(object) = object else { return Json::Null };
    let path = path_of(["conditions"]);
    let of_file = tree::member(object, "file").is_some_and(|of| is_scalar(&of.value));
    let rows: Vec<Json> = if of_file {
        vec![json!({ "name": "", "path": path, "cells": cells(text, object, &path) })]
    } else {
        let one = |member: &jsonc_parser::ast::ObjectProp<'_>| {
            let name = member.name.as_str();
            let path = path_of(["conditions", name]);
            match &member.value {
                Value::Object(object) => {
                    json!({ "name": name, "path": path, "cells": cells(text, object, &path) })
                }
                other => {
                    json!({ "name": name, "path": path, "text": raw(text, other), "cells": [] })
                }
            }
        };
        object.properties.iter().map(one).collect()
    };
    json!({ "file": of_file, "rows": rows, "count": task.map(|task| task.rows.len()) })
}

/// The reported outputs: one row each, with the keys of a tolerance among the cells.
pub(crate) fn outputs(text: &str, root: &Value<'_>) -> Vec<Json> {
    let object = tree::get(root, "outputs").and_then(Value::as_object);
    let one = |member: &jsonc_parser::ast::ObjectProp<'_>| {
        let name = member.name.as_str();
        let path = path_of(["outputs", name]);
        let own = member.value.as_object();
        let mut all = own.map(|object| cells(text, object, &path)).unwrap_or_default();
        let tolerance = tree::get(&member.value, "tolerance").and_then(Value::as_object);
        all.extend(
            tolerance
                .into_iter()
                .flat_map(|object| cells(text, object, &path_of(["outputs", name, "tolerance"]))),
        );
        json!({ "name": name, "path": path, "cells": all })
    };
    object.into_iter().flat_map(|object| &object.properties).map(one).collect()
}

/// The individually declared correlation coefficients.
pub(crate) fn correlations(text: &str, root: &Value<'_>) -> Json {
    let Some(found) = tree::get(root, "correlations") else { return json!([]) };
    let Some(array) = found.as_array() else { return Json::Null };
    let one = |(place, of): (usize, &Value<'_>)| {
        let of = of.as_array()?;
        let [a, b, r] = of.elements.as_slice() else { return None };
        Some(json!({
            "path": [PathStep::Key("correlations".to_owned()), PathStep::Place(place)],
            "between": [raw(text, a), raw(text, b)],
            "raw": raw(text, r),
        }))
    };
    array.elements.iter().enumerate().filter_map(one).collect()
}
