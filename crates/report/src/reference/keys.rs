//! The keys of files, from the JSON Schema.
//!
//! The schema is generated from the tables of the readers. This module walks its definitions from
//! the root of a kind of file, and makes a table of each one with keys.

use std::collections::BTreeSet;

use gumption_files::schema;
use serde_json::{Map, Value};

use crate::document::{Block, Document};
use crate::sheet::Sheet;

/// Definitions that are described elsewhere: with the distributions, and once for all inputs.
const OF_SHAPES: [&str; 2] = ["input-", "component-"];

/// The schema's definitions.
pub(super) struct Definitions(Map<String, Value>);

impl Definitions {
    pub(super) fn new() -> Self {
        let mut schema = schema::value();
        match schema.get_mut("$defs").map(Value::take) {
            Some(Value::Object(definitions)) => Self(definitions),
            _ => Self(Map::new()),
        }
    }

    pub(super) fn get(&self, name: &str) -> Option<&Value> {
        self.0.get(name)
    }

    /// The description of a node: its own, or that of the definition to which it refers.
    fn about<'a>(&'a self, node: &'a Value) -> &'a str {
        let own = text(node, "description");
        own.or_else(|| text(self.get(referred(node)?)?, "description")).unwrap_or_default()
    }

    /// The permitted forms of a node, in a few words.
    fn form(&self, node: &Value) -> String {
        if let Some(name) = referred(node) {
            return match self.get(name) {
                Some(of) if of.get("properties").is_some() => format!("object: {}", spaced(name)),
                _ => spaced(name),
            };
        }
        if let Some(values) = node.get("enum").and_then(Value::as_array) {
            return values.iter().map(code).collect::<Vec<_>>().join(", ");
        }
        if let Some(value) = node.get("const") {
            return code(value);
        }
        if let Some(choices) = node.get("anyOf").and_then(Value::as_array) {
            let mut forms: Vec<String> = Vec::new();
            for form in choices.iter().map(|choice| self.form(choice)) {
                if !form.is_empty() && !forms.contains(&form) {
                    forms.push(form);
                }
            }
            return forms.join(" or ");
        }
        match text(node, "type") {
            Some("string") => "text".to_owned(),
            Some("boolean") => "`true` or `false`".to_owned(),
            Some("integer") => "whole number".to_owned(),
            Some("array") => match node.get("items").map(|items| self.form(items)) {
                Some(form) if !form.is_empty() => format!("list of: {form}"),
                _ => "list".to_owned(),
            },
            Some("object") => match node.get("additionalProperties").map(|of| self.form(of)) {
                Some(form) if !form.is_empty() => format!("by name: {form}"),
                _ => "object".to_owned(),
            },
            other => other.unwrap_or_default().to_owned(),
        }
    }

    /// The table of an object's keys.
    pub(super) fn table<'a>(
        &self,
        keys: impl Iterator<Item = (&'a String, &'a Value)> + Clone,
        required: &[&str],
    ) -> Sheet {
        let mut sheet = Sheet::default();
        sheet.text("key", keys.clone().map(|(key, _)| format!("`{key}`")));
        sheet.text("value", keys.clone().map(|(_, node)| self.form(node)));
        if !required.is_empty() {
            let needed = |key: &str| if required.contains(&key) { "needed" } else { "" };
            sheet.text("", keys.clone().map(|(key, _)| needed(key).to_owned()));
        }
        sheet.text("meaning", keys.map(|(_, node)| self.about(node).to_owned()));
        sheet
    }

    /// The keys that all objects of these definitions have.
    fn common(&self, prefix: &str) -> Vec<(String, Value)> {
        let mut of_shapes = self.0.iter().filter_map(|(name, node)| {
            let is_shape = name.starts_with(prefix) && !name.ends_with("of-components");
            is_shape.then(|| node.get("properties")?.as_object()).flatten()
        });
        let Some(first) = of_shapes.next() else { return Vec::new() };
        let rest: Vec<_> = of_shapes.collect();
        let in_all = |key: &String| rest.iter().all(|keys| keys.contains_key(key));
        let common = first.iter().filter(|(key, _)| in_all(key));
        common.map(|(key, node)| (key.clone(), node.clone())).collect()
    }

    /// A section for a definition: its description, its keys, and which of them exclude each other.
    fn section(&self, document: &mut Document, name: &str, left_out: &[&str]) {
        let Some(node) = self.get(name) else { return };
        document.section(capital(&spaced(name)));
        document.text(self.about(node));
        let shapes = format!("{name}-");
        if OF_SHAPES.contains(&shapes.as_str()) {
            let common = self.common(&shapes);
            document.text(
                "Keys that every one has whatever its distribution; those of a distribution stand \
                 with it (`gumption help distributions`).",
            );
            document.table(self.table(common.iter().map(|(k, v)| (k, v)), &["distribution"]));
        } else if let Some(keys) = node.get("properties").and_then(Value::as_object) {
            let required = required(node);
            let keys = keys.iter().filter(|(key, _)| !left_out.contains(&key.as_str()));
            document.table(self.table(keys.clone(), &required));
            if let Some(said) = self.rules(node) {
                document.sentence(&said);
            }
            for (key, node) in keys {
                self.inside(document, key, node);
            }
        }
        if let Some(examples) = node.get("examples").and_then(Value::as_array) {
            for example in examples {
                let text = format!("{example:#}");
                document.blocks.push(Block::Listing { about: "Example:".to_owned(), text });
            }
        }
    }

    /// The keys of an object at a key, or of the objects in its list, without a section of its own.
    pub(super) fn inside(&self, document: &mut Document, key: &str, node: &Value) {
        let items = node.get("items").filter(|items| items.get("properties").is_some());
        let of = items.unwrap_or(node);
        let Some(keys) = of.get("properties").and_then(Value::as_object) else { return };
        document.text(format!("Keys of `{key}`:"));
        document.table(self.table(keys.iter(), &required(of)));
        if let Some(said) = self.rules(of) {
            document.sentence(&said);
        }
    }

    /// The object with its own section to which a key refers.
    pub(super) fn object_at(&self, node: &Value) -> Option<&Value> {
        self.get(referred(node)?).filter(|of| of.get("properties").is_some())
    }

    /// Which keys are alternatives, and which need others.
    pub(super) fn rules(&self, node: &Value) -> Option<String> {
        let one =
            alternatives(node, "oneOf").map(|said| format!("exactly one of {said} is needed"));
        let any =
            alternatives(node, "anyOf").map(|said| format!("at least one of {said} is needed"));
        let not = node.get("not").and_then(|not| alternatives(not, "anyOf"));
        let not = not.map(|said| format!("not together: {said}"));
        let needs = node.get("dependentRequired").and_then(Value::as_object);
        let needs = needs.map(|needs| {
            let said = |(key, of): (&String, &Value)| {
                let of: Vec<String> = of.as_array().into_iter().flatten().map(code).collect();
                format!("`{key}` needs {}", of.join(" and "))
            };
            needs.iter().map(said).collect::<Vec<_>>().join(", ")
        });
        let said: Vec<String> = [one, any, not, needs].into_iter().flatten().collect();
        (!said.is_empty()).then(|| said.join("; "))
    }
}

/// A document about a kind of file: its root, then every object to which it refers, then the forms
/// of values. `left_out` are keys of the root that other topics describe.
pub(super) fn document(title: &str, root: &str, left_out: &[&str]) -> Document {
    of_roots(title, &[root], left_out)
}

/// The keys of a case besides those of a model file.
pub(super) fn of_case() -> Document {
    let roots = ["observations", "effects", "catalogue", "prior"];
    let mut document = of_roots("Case of the gap diagnosis", &roots, &[]);
    let definitions = Definitions::new();
    let model = definitions.get("model").and_then(|model| model.get("properties")?.as_object());
    let keys = model.into_iter().flatten().filter(|(key, _)| roots.contains(&key.as_str()));
    document
        .blocks
        .insert(0, Block::Table(definitions.table(keys.collect::<Vec<_>>().into_iter(), &[])));
    document.subtitle = vec![
        "A case is a model file (`gumption help model`) that also has measured data and candidate \
         effects, at its root:"
            .to_owned(),
    ];
    document
}

fn of_roots(title: &str, roots: &[&str], left_out: &[&str]) -> Document {
    let definitions = Definitions::new();
    let mut document = Document { title: title.to_owned(), ..Document::default() };
    let mut names: Vec<String> = roots.iter().map(|root| (*root).to_owned()).collect();
    let mut next = 0;
    while let Some(name) = names.get(next).cloned() {
        next += 1;
        let Some(node) = definitions.get(&name) else { continue };
        let mut found = BTreeSet::new();
        references(node, if next == 1 { left_out } else { &[] }, &mut found);
        // in the order of the schema, which is that of the file
        for of in definitions.0.keys().filter(|of| found.contains(of.as_str())) {
            let is_shape = OF_SHAPES.iter().any(|prefix| of.starts_with(prefix));
            let is_sum = of == "input-of-components";
            if (!is_shape || is_sum) && of != "distribution" && !names.contains(of) {
                names.push(of.clone());
            }
        }
    }
    let is_object = |name: &&String| {
        let node = definitions.get(name);
        node.is_some_and(|node| node.get("type") == Some(&Value::from("object")))
            || roots.contains(&name.as_str())
    };
    for name in names.iter().filter(is_object) {
        let left_out = if roots.contains(&name.as_str()) { left_out } else { &[] };
        definitions.section(&mut document, name, left_out);
    }
    let forms: Vec<&String> = names.iter().filter(|name| !is_object(name)).collect();
    if !forms.is_empty() {
        document.section("Values");
        let nodes = || forms.iter().filter_map(|name| Some((*name, definitions.get(name)?)));
        let mut sheet = Sheet::default();
        sheet.text("form", nodes().map(|(name, _)| spaced(name)));
        sheet.text("is", nodes().map(|(_, node)| definitions.form(node)));
        sheet.text("meaning", nodes().map(|(_, node)| meaning(node)));
        document.table(sheet);
    }
    document
}

/// The description of a form with those of its alternatives and its examples.
fn meaning(node: &Value) -> String {
    let choices = node.get("anyOf").and_then(Value::as_array).into_iter().flatten();
    let of_choices = choices.filter_map(|choice| text(choice, "description"));
    let mut said: Vec<String> =
        text(node, "description").into_iter().chain(of_choices).map(str::to_owned).collect();
    if let Some(examples) = node.get("examples").and_then(Value::as_array) {
        let examples: Vec<String> = examples.iter().map(code).collect();
        said.push(format!("For example {}.", examples.join(", ")));
    }
    said.join(" ")
}

/// All definitions to which a node refers, except those under keys that are left out.
fn references(node: &Value, left_out: &[&str], found: &mut BTreeSet<String>) {
    match node {
        Value::Object(members) => {
            found.extend(referred(node).map(str::to_owned));
            let members = members.iter().filter(|(key, _)| !left_out.contains(&key.as_str()));
            members.for_each(|(_, member)| references(member, left_out, found));
        }
        Value::Array(items) => items.iter().for_each(|item| references(item, left_out, found)),
        _ => {}
    }
}

/// The sets of keys of which one is required: `a`, or `b` with `c`.
fn alternatives(node: &Value, key: &str) -> Option<String> {
    let choices = node.get(key)?.as_array()?;
    let of = |choice: &Value| {
        let keys: Vec<String> =
            required(choice).into_iter().map(|key| format!("`{key}`")).collect();
        let inner = alternatives(choice, "oneOf");
        let keys = keys.join(" and ");
        (!keys.is_empty()).then(|| match inner {
            Some(inner) => format!("{keys} (with {inner})"),
            None => keys,
        })
    };
    let choices: Vec<String> = choices.iter().filter_map(of).collect();
    (!choices.is_empty()).then(|| choices.join(" or "))
}

pub(super) fn required(node: &Value) -> Vec<&str> {
    let keys = node.get("required").and_then(Value::as_array);
    keys.into_iter().flatten().filter_map(Value::as_str).collect()
}

fn referred(node: &Value) -> Option<&str> {
    node.get("$ref")?.as_str()?.strip_prefix("#/$defs/")
}

pub(super) fn text<'a>(node: &'a Value, key: &str) -> Option<&'a str> {
    node.get(key)?.as_str()
}

fn code(value: &Value) -> String {
    match value {
        Value::String(text) => format!("`{text}`"),
        other => format!("`{other}`"),
    }
}

fn spaced(name: &str) -> String {
    name.replace('-', " ")
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |c| c.to_uppercase().chain(letters).collect())
}
