//! The catalogue for people and programs: what `gumption models --effects` shows.

use serde::ser::{Serialize, SerializeMap, SerializeSeq, Serializer};

use super::measured::Measured;
use super::{Catalogue, Entry};
use gumption_text::json::{Json, Member, Node};

/// The catalogue of ready-made effects.
#[derive(Clone, Debug)]
pub struct EffectListing {
    /// Names of quantities, each with what it may be called in a sim: the first that the sim has is
    /// taken.
    pub names: Vec<(String, Vec<String>)>,
    /// The effects in their order.
    pub effects: Vec<ListedEffect>,
}

impl EffectListing {
    pub(super) fn of(catalogue: &Catalogue) -> Self {
        let effects = catalogue.entries.iter().map(ListedEffect::of).collect();
        Self { names: catalogue.names.clone(), effects }
    }
}

impl Serialize for EffectListing {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(2))?;
        map.serialize_entry("names", &Names(&self.names))?;
        map.serialize_entry("effects", &self.effects)?;
        map.end()
    }
}

/// Names with their alternatives, in their order.
struct Names<'n>(&'n [(String, Vec<String>)]);

impl Serialize for Names<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, alternatives)| (name, alternatives)))
    }
}

/// An effect of the catalogue.
#[derive(Clone, Debug)]
pub struct ListedEffect {
    /// Its name; several effects for different sims may share it.
    pub name: String,
    /// The bench that it is for, or `any`.
    pub bench: String,
    /// What it is, in words.
    pub about: String,
    /// Where it comes from.
    pub source: String,
    /// Its parameters.
    pub parameters: Vec<ListedParameter>,
    /// The quantities that it overrides, each with its formula.
    pub overrides: Vec<(String, String)>,
    members: Vec<Member>,
}

/// A parameter of an effect.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ListedParameter {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// Its prior distribution in words, in its unit.
    pub prior: String,
    /// What it is, in words.
    pub about: String,
}

impl ListedEffect {
    pub(super) fn of(entry: &Entry) -> Self {
        let override_of = |member: &Member| (member.key.clone(), plain(&member.value));
        Self {
            name: entry.name.clone(),
            bench: entry.bench.clone(),
            about: entry.text("about").to_owned(),
            source: entry.text("source").to_owned(),
            parameters: entry.object("parameters").iter().map(parameter).collect(),
            overrides: entry.object("overrides").iter().map(override_of).collect(),
            members: entry.members.clone(),
        }
    }
}

fn parameter(member: &Member) -> ListedParameter {
    let fields: &[Member] = match &member.value.value {
        Json::Object(fields) => fields,
        _ => &[],
    };
    let text = |key: &str| {
        let field = fields.iter().find(|field| field.key == key);
        field.map(|field| plain(&field.value)).unwrap_or_default()
    };
    let mut prior = text("distribution");
    let own = fields
        .iter()
        .filter(|field| !["unit", "distribution", "about"].contains(&field.key.as_str()));
    for (number, field) in own.enumerate() {
        let separator = if number == 0 { " " } else { ", " };
        prior.push_str(&format!("{separator}{} {}", field.key, plain(&field.value)));
    }
    ListedParameter { name: member.key.clone(), unit: text("unit"), prior, about: text("about") }
}

/// A value in words.
fn plain(node: &Node) -> String {
    match &node.value {
        Json::Object(members) => Measured::of(members).map(|m| m.words()).unwrap_or_default(),
        other => other.written().unwrap_or_default().to_owned(),
    }
}

/// In the form of a case file's effects, with the name and the bench before it.
impl Serialize for ListedEffect {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(2 + self.members.len()))?;
        map.serialize_entry("name", &self.name)?;
        map.serialize_entry("bench", &self.bench)?;
        for member in &self.members {
            map.serialize_entry(&member.key, &WrittenValue(&member.value))?;
        }
        map.end()
    }
}

/// A value as it was written, its keys in their order.
struct WrittenValue<'n>(&'n Node);

impl Serialize for WrittenValue<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.0.value {
            Json::Null => serializer.serialize_unit(),
            Json::Bool(truth) => serializer.serialize_bool(*truth),
            Json::Number(text) => match text.parse::<i64>() {
                Ok(whole) => serializer.serialize_i64(whole),
                Err(_) => serializer.serialize_f64(text.parse().unwrap_or(f64::NAN)),
            },
            Json::Text(text) => serializer.serialize_str(text),
            Json::List(list) => {
                let mut sequence = serializer.serialize_seq(Some(list.len()))?;
                for node in list {
                    sequence.serialize_element(&WrittenValue(node))?;
                }
                sequence.end()
            }
            Json::Object(members) => {
                let mut map = serializer.serialize_map(Some(members.len()))?;
                for member in members {
                    map.serialize_entry(&member.key, &WrittenValue(&member.value))?;
                }
                map.end()
            }
        }
    }
}
