//! The gallery of the start page: built-in models and examples by field of work.

use std::sync::LazyLock;

use serde::Deserialize;
use serde_json::{Map, Value as Json, json};

use crate::Live;

/// Which names belong to which field; a name stands in one field.
#[derive(Debug, Default, Deserialize)]
struct Arrangement {
    /// The entries that the start page shows first, with their results.
    large: Vec<String>,
    /// Lists of names by the names of the fields, in the order of the page.
    fields: Map<String, Json>,
    /// Titles of entries whose files are copies that must stay as they are, with a code as their title.
    titles: Map<String, Json>,
}

static ARRANGEMENT: LazyLock<Arrangement> = LazyLock::new(|| {
    // the text is part of the program, and a test reads it
    serde_json::from_str(include_str!("gallery.json")).unwrap_or(Arrangement::default())
});

/// The fields of work with the names of their entries, in the order of the page.
pub fn fields() -> impl Iterator<Item = (&'static str, Vec<&'static str>)> {
    ARRANGEMENT.fields.iter().map(|(field, names)| {
        let names = names.as_array().into_iter().flatten().filter_map(Json::as_str).collect();
        (field.as_str(), names)
    })
}

/// All starting points by field, and those that the page shows first.
pub(crate) fn list(live: &Live<'_>) -> Json {
    let templates =
        live.catalogue.iter().filter_map(|of| Some(entry("template", of.name(), of.template?)));
    let examples = live.examples.iter().map(|(name, text)| entry("example", name, text));
    let all: Vec<Json> = templates.chain(examples).collect();
    let of = |name: &str| all.iter().find(|entry| entry["name"] == name).cloned();
    let by_field: Vec<Json> = fields()
        .map(|(field, names)| {
            let entries: Vec<Json> = names.into_iter().filter_map(of).collect();
            json!({ "field": field, "entries": entries })
        })
        .filter(|field| field["entries"] != json!([]))
        .collect();
    let large: Vec<Json> = ARRANGEMENT.large.iter().filter_map(|name| of(name)).collect();
    json!({ "large": large, "fields": by_field })
}

/// A starting point: how it is asked for, its title and its source.
fn entry(kind: &str, name: &str, text: &str) -> Json {
    let of: Json = serde_json::from_str(text).unwrap_or(Json::Null);
    let title = title(name).map_or_else(|| of["title"].clone(), Json::from);
    json!({ "kind": kind, "name": name, "title": title, "source": of["source"] })
}

/// The title of an entry whose file has none in words; `None` for any other name.
pub fn title(name: &str) -> Option<&'static str> {
    ARRANGEMENT.titles.get(name)?.as_str()
}
