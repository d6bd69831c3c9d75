//! Where an error is in what Python gave. Functions, dictionaries and tables become texts that nobody
//! wrote: a line and a column in them say nothing, the argument and its keys do.

use std::sync::Arc;

use gumption::file::SourceText;
use gumption_text::json::{self, Json, Node};

/// The name of a text that somebody wrote, although it is no file.
const WRITTEN: &str = "<json>";

/// The name of what is given instead of standard input.
const GIVEN: &str = "stdin";

/// The keys that lead to a place, from the outside; an entry of a list has its name, or `[0]`.
type Keys = Vec<String>;

/// A place in what Python gave.
#[derive(Debug)]
pub(crate) enum Argument {
    /// In the arguments of a function that is a model.
    Function { name: String, keys: Keys },
    /// In a dictionary, which may have a name.
    Dictionary { name: Option<String>, keys: Keys },
    /// In a table, by the name of the argument; the headings are in no row.
    Table { name: String, row: Option<usize> },
}

impl Argument {
    /// The argument with the keys in it, `mass.std`; `None` where it is the whole.
    pub(crate) fn path(&self) -> Option<String> {
        let path = match self {
            Self::Function { keys, .. } => joined(&of_function(keys)),
            Self::Dictionary { keys, .. } => joined(keys),
            Self::Table { name, .. } => name.clone(),
        };
        (!path.is_empty()).then_some(path)
    }

    /// A message about the place.
    pub(crate) fn told(&self, message: &str) -> String {
        let named = |name: &str| format!("`{name}`: ");
        match self {
            Self::Function { name, .. } => match self.path() {
                None => named(name) + message,
                Some(path) => {
                    let (argument, rest) = path.split_once('.').unwrap_or((&path, ""));
                    // a message often begins with the key
                    let is_said = rest.is_empty() || message.contains(&format!("`{rest}`"));
                    let rest = if is_said { String::new() } else { format!(", `{rest}`") };
                    format!("`{name}`: argument `{argument}`{rest}: {message}")
                }
            },
            Self::Dictionary { name, .. } => {
                let name = name.as_deref().map_or_else(String::new, named);
                let place = self.path().map_or_else(String::new, |path| named(&path));
                name + &place + message
            }
            // a message about a cell says which row it is
            Self::Table { name, row: Some(row) } if !message.starts_with("row ") => {
                format!("`{name}`, row {row}: {message}")
            }
            Self::Table { name, .. } => named(name) + message,
        }
    }
}

/// Keys with points between them, `mass.std`; a place in a list follows at once, `correlations[0]`.
fn joined<K: AsRef<str>>(keys: &[K]) -> String {
    let mut path = String::new();
    for key in keys.iter().map(AsRef::as_ref) {
        if !path.is_empty() && !key.starts_with('[') {
            path.push('.');
        }
        path += key;
    }
    path
}

/// The argument of a function for a place in its model file, and the keys within the argument.
fn of_function(keys: &[String]) -> Vec<&str> {
    let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
    match keys.as_slice() {
        // each input is an argument, and so is each setting
        ["inputs" | "monte_carlo", rest @ ..] if !rest.is_empty() => rest.to_vec(),
        ["outputs", name, "tolerance", rest @ ..] => [&["tolerance", name], rest].concat(),
        _ => keys,
    }
}

/// The files that Python makes of tables, each for an argument of that name.
const TABLES: [(&str, &str); 3] =
    [("conditions.csv", "conditions"), ("readings.csv", "readings"), ("data.csv", "data")];

/// The name of a table that is given alone.
const ALONE: &str = "table";

/// Finds places in texts; a text is read once.
pub(crate) struct Places<'h> {
    held: &'h [&'h str],
    last: Option<(Arc<SourceText>, Option<Node>)>,
}

impl<'h> Places<'h> {
    /// Texts among which are these files, which Python gave.
    pub(crate) fn among(held: &'h [&'h str]) -> Self {
        Self { held, last: None }
    }

    /// The place of a byte of a text; `None` in a text that somebody wrote.
    pub(crate) fn of(&mut self, source: &Arc<SourceText>, byte: usize) -> Option<Argument> {
        let (line, _) = source.position(byte);
        let row = line.checked_sub(1).filter(|&row| row > 0);
        let table = TABLES.iter().find(|(file, _)| *file == source.name);
        if let Some((file, name)) = table
            && self.held.contains(file)
        {
            return Some(Argument::Table { name: (*name).to_owned(), row });
        }
        let is_written = source.name == WRITTEN;
        let name = source.name.strip_prefix('<')?.strip_suffix('>').filter(|_| !is_written)?;
        if !self.last.as_ref().is_some_and(|(known, _)| Arc::ptr_eq(known, source)) {
            self.last = Some((Arc::clone(source), json::parse(source).ok()));
        }
        let root = self.last.as_ref().and_then(|(_, root)| root.as_ref());
        let Some(root) = root else {
            return Some(Argument::Table { name: ALONE.to_owned(), row });
        };
        let mut keys = Keys::new();
        follow(root, byte, &mut keys);
        Some(match name.strip_prefix("dict") {
            Some("") => Argument::Dictionary { name: None, keys },
            Some(own) if own.starts_with(' ') => {
                Argument::Dictionary { name: Some(own.trim_start().to_owned()), keys }
            }
            _ if name == GIVEN => Argument::Dictionary { name: None, keys },
            _ => Argument::Function { name: name.to_owned(), keys },
        })
    }
}

/// The keys on the way to a byte. An entry of a list is called by its name if it has one.
fn follow(node: &Node, byte: usize, keys: &mut Keys) {
    match &node.value {
        Json::Object(members) => {
            let is_in = |span: &std::ops::Range<usize>| span.contains(&byte);
            let mut members = members.iter();
            if let Some(member) = members.find(|m| is_in(&m.key_span) || is_in(&m.value.span)) {
                keys.push(member.key.clone());
                follow(&member.value, byte, keys);
            }
        }
        Json::List(entries) => {
            let entry = entries.iter().enumerate().find(|(_, entry)| entry.span.contains(&byte));
            if let Some((place, entry)) = entry {
                keys.push(name_of(entry).unwrap_or_else(|| format!("[{place}]")));
                follow(entry, byte, keys);
            }
        }
        Json::Null | Json::Bool(_) | Json::Number(_) | Json::Text(_) => {}
    }
}

fn name_of(entry: &Node) -> Option<String> {
    let Json::Object(members) = &entry.value else { return None };
    let name = members.iter().find(|member| member.key == "name")?;
    match &name.value.value {
        Json::Text(text) => Some(text.clone()),
        _ => None,
    }
}
