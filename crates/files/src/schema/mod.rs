//! The JSON Schema of the files, for editors that complete and check while a file is written.
//!
//! A schema cannot say everything: units, formulas and names that belong together are checked by
//! [`file`](crate). What it refuses, reading refuses too.

mod case;
mod certificate;
mod model_file;
mod node;
mod recipe;
mod result_file;
mod shapes;
mod values;

#[cfg(test)]
mod tests;

use node::{Node, object, reference};

/// The schema (draft 2020-12) as text that ends in a newline.
///
/// ```
/// let schema = gumption_files::schema::text();
/// assert!(schema.contains("\"$schema\": \"https://json-schema.org/draft/2020-12/schema\""));
/// ```
pub fn text() -> String {
    // only a map with keys that are not text could fail
    serde_json::to_string_pretty(&schema()).unwrap_or_default() + "\n"
}

fn schema() -> Node {
    let mut definitions = model_file::definitions();
    definitions.extend(case::definitions());
    definitions.extend(certificate::definitions());
    definitions.extend(recipe::definitions());
    definitions.extend(result_file::definitions());
    definitions.extend(shapes::definitions());
    definitions.extend(values::definitions());
    object([
        ("$schema", Node::from("https://json-schema.org/draft/2020-12/schema")),
        ("title", Node::from("Files of gumption")),
        (
            "description",
            Node::from(
                "Files of gumption, format 1. Model files: a measurement with what is known about \
                 its inputs, to be evaluated by the GUM and by Monte Carlo; with observations a case \
                 of the gap diagnosis. Certificate files: which results of which models are stated. \
                 Recipes: what is taken from which recordings. Result files: what an evaluation found, to be the input of another one.",
            ),
        ),
        ("if", with_key("result")),
        ("then", reference("result")),
        (
            "else",
            object([
                ("if", recipe::meant()),
                ("then", reference("recipe")),
                (
                    "else",
                    object([
                        ("if", certificate::meant()),
                        ("then", reference("certificate")),
                        ("else", reference("model")),
                    ]),
                ),
            ]),
        ),
        ("$defs", object(definitions)),
    ])
}

/// An object with a key of this name.
fn with_key(key: &str) -> Node {
    object([("type", Node::from("object")), ("required", node::texts([key]))])
}

/// An object that has these properties and no others; keys that begin with `$` belong to editors.
fn closed(about: &str, properties: Vec<(&str, Node)>, required: &[&str]) -> Node {
    let closed = object([
        ("description", Node::from(about)),
        ("type", Node::from("object")),
        ("properties", object(properties)),
        ("patternProperties", object([("^\\$", Node::from(true))])),
        ("additionalProperties", Node::from(false)),
    ]);
    if required.is_empty() {
        closed
    } else {
        closed.with("required", node::texts(required.iter().copied()))
    }
}

/// An object whose keys are names of quantities.
fn named(about: &str, value: Node) -> Node {
    object([
        ("description", Node::from(about)),
        ("type", Node::from("object")),
        ("propertyNames", reference("name")),
        ("additionalProperties", value),
    ])
}

/// A text with a description.
fn text_of(about: &str) -> Node {
    described("string", about)
}

fn described(kind: &str, about: &str) -> Node {
    object([("description", Node::from(about)), ("type", Node::from(kind))])
}

/// A reference with a description of its own.
fn referenced(name: &str, about: &str) -> Node {
    object([("description", Node::from(about)), ("$ref", Node::from(format!("#/$defs/{name}")))])
}
