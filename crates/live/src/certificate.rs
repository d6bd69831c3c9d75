//! What the form of a certificate offers: the contents of the models that it names.

use std::path::Path;

use gumption_engine::model::Quantity;
use gumption_files::{FileReader, ModelFile};
use jsonc_parser::ast::Value;
use serde::Deserialize;
use serde_json::{Map, Value as Json, json};

use crate::tree::{self, PathStep};

/// Maximum number of models whose contents an answer holds.
const MOST: usize = 100;

/// A request of the call `model`.
#[derive(Debug, Deserialize)]
pub(crate) struct ModelRequest {
    /// The model file, as the certificate names it.
    model: String,
}

/// The contents of a model file that a certificate may name.
pub(crate) fn contents(files: FileReader<'_>, asked: &ModelRequest) -> Json {
    of_model(files, &asked.model)
}

/// The contents of the models that the rows and functions of a certificate name, by these names.
pub(crate) fn models(files: FileReader<'_>, root: &Value<'_>) -> Json {
    let mut models = Map::new();
    let named =
        ["rows", "functions"].into_iter().filter_map(|key| tree::get(root, key)?.as_array());
    for of in named.flat_map(|array| &array.elements) {
        let Some(name) = tree::get(of, "model").and_then(Value::as_string_lit) else { continue };
        if models.len() >= MOST {
            break;
        }
        if !models.contains_key(name.value.as_ref()) {
            models.insert(name.value.clone().into_owned(), of_model(files, &name.value));
        }
    }
    Json::Object(models)
}

fn of_model(files: FileReader<'_>, name: &str) -> Json {
    match files.named_model(name, Path::new("")) {
        Ok(file) => described(&file),
        Err(reason) => json!({ "error": reason }),
    }
}

fn described(file: &ModelFile) -> Json {
    let model = &file.task.model;
    let quantity =
        |of: &Quantity| json!({ "name": of.name, "unit": of.unit.to_string(), "about": of.about });
    let outputs = model.outputs.iter().map(|output| {
        let mut of = quantity(&output.quantity);
        of["tolerance"] = json!(output.tolerance.is_some());
        of
    });
    let inputs = model.inputs.iter().map(|input| {
        let mut of = quantity(&input.quantity);
        of["readings"] = json!(file.readings.inputs.contains(&input.quantity.name));
        of
    });
    let functions = file.task.curves.iter().filter(|of| !of.fit.is_complex());
    let functions = functions.map(|of| &of.fit.name);
    json!({
        "outputs": outputs.collect::<Vec<_>>(),
        "inputs": inputs.collect::<Vec<_>>(),
        "conditions": model.conditions.iter().map(quantity).collect::<Vec<_>>(),
        "functions": functions.collect::<Vec<_>>(),
        "rows": file.task.rows.len(),
        "sweep": !model.conditions.is_empty(),
    })
}

/// Takes those errors out of a list that only say what a certificate lacks, and returns their paths:
/// a form that is being filled in tells them as what is still to be done.
pub(crate) fn lacking(root: &Value<'_>, diagnostics: &mut Json) -> Vec<Json> {
    let lacks = missing(root);
    let Some(list) = diagnostics.as_array_mut() else { return Vec::new() };
    let mut found = Vec::new();
    list.retain(|of| {
        let lack = lacks.iter().find(|(above, _)| of["path"] == json!(above));
        found.extend(lack.map(|(_, what)| json!(what)));
        lack.is_none()
    });
    found
}

/// What a certificate lacks: the path at which its reader reports it, and the path of what is missing.
fn missing(root: &Value<'_>) -> Vec<(Vec<PathStep>, Vec<PathStep>)> {
    let mut missing = Vec::new();
    let rows = tree::get(root, "rows");
    if rows.and_then(Value::as_array).is_some_and(|of| of.elements.is_empty()) {
        missing.push((tree::path_of(["rows"]), tree::path_of(["rows"])));
    }
    if rows.is_none() {
        missing.push((Vec::new(), tree::path_of(["rows"])));
    }
    for key in ["device", "customer", "laboratory"] {
        let object = tree::get(root, key).and_then(Value::as_object);
        if object.is_some_and(|of| tree::member(of, "name").is_none()) {
            missing.push((tree::path_of([key]), tree::path_of([key, "name"])));
        }
    }
    missing
}
