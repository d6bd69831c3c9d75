//! Changes to a text that keep everything else in it: order, comments, line breaks.
//!
//! The parser's editable tree breaks the lines of every object into which something is inserted;
//! here an object on one line stays on one.

use std::ops::Range;

use jsonc_parser::ast::{Array, Object, Value};
use jsonc_parser::common::Ranged;
use serde::Deserialize;

use crate::tree::{self, PathStep};

/// One change.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Edit {
    /// The path of the changed value.
    path: Vec<PathStep>,
    /// What it becomes.
    #[serde(default, with = "given")]
    value: Option<serde_json::Value>,
    /// The new value, as typed: a number as it is, otherwise a text.
    #[serde(default)]
    typed: Option<String>,
    /// Whether it goes.
    #[serde(default)]
    remove: bool,
    /// The new name of the key.
    #[serde(default)]
    rename: Option<String>,
    /// The index among its neighbours at which a new element is inserted; by default the end.
    #[serde(default)]
    before: Option<usize>,
    /// The index of the neighbour in its list with which an element changes places.
    #[serde(default)]
    exchange: Option<usize>,
    /// The wanted members of an object, in this order; unchanged members stay untouched.
    #[serde(default)]
    members: Option<Vec<(String, serde_json::Value)>>,
}

/// A value that is present, even if it is null.
mod given {
    use serde::{Deserialize, Deserializer};

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Option<serde_json::Value>, D::Error> {
        serde_json::Value::deserialize(from).map(Some)
    }
}

impl Edit {
    /// Sets a value, existing or new.
    pub(crate) fn set(path: Vec<PathStep>, value: serde_json::Value) -> Self {
        Self { value: Some(value), ..Self::of(path) }
    }

    /// Sets a value as it is typed.
    pub(crate) fn typed(path: Vec<PathStep>, typed: &str) -> Self {
        Self { typed: Some(typed.to_owned()), ..Self::of(path) }
    }

    /// Removes an existing value.
    pub(crate) fn remove(path: Vec<PathStep>) -> Self {
        Self { remove: true, ..Self::of(path) }
    }

    /// Another key.
    pub(crate) fn rename(path: Vec<PathStep>, name: &str) -> Self {
        Self { rename: Some(name.to_owned()), ..Self::of(path) }
    }

    fn of(path: Vec<PathStep>) -> Self {
        let (value, typed, rename, members) = (None, None, None, None);
        Self { path, value, typed, remove: false, rename, before: None, exchange: None, members }
    }

    /// The place of what is typed, and the text.
    pub(crate) fn as_typed(&self) -> Option<(&[PathStep], &str)> {
        Some((&self.path, self.typed.as_deref()?))
    }

    fn path(&self) -> String {
        let steps: Vec<String> = self.path.iter().map(PathStep::to_string).collect();
        steps.join("/")
    }
}

/// The text with all changes, one after the other.
///
/// # Errors
/// The text is not a JSON object, or a change is not applicable; a sentence.
pub(crate) fn edited(text: &str, edits: &[Edit]) -> Result<String, String> {
    let bare = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mark = text.strip_suffix(bare).unwrap_or("");
    let mut now = bare.to_owned();
    for edit in edits {
        now = one(&now, edit)?;
    }
    Ok(mark.to_owned() + &now)
}

fn one(text: &str, edit: &Edit) -> Result<String, String> {
    let root = tree::parse(text).map_err(|why| format!("the text cannot be edited: {why}"))?;
    if root.as_object().is_none() {
        return Err("the text cannot be edited: it is no object".to_owned());
    }
    let nothing = || format!("there is nothing at `{}`", edit.path());
    if edit.remove {
        let cut = removed(&root, &edit.path).ok_or_else(nothing)?;
        return Ok(spliced(text, cut, ""));
    }
    if let Some(with) = edit.exchange {
        return exchanged(text, &root, &edit.path, with).ok_or_else(nothing);
    }
    if let Some(name) = &edit.rename {
        return renamed(text, &root, edit, name);
    }
    if let Some(members) = &edit.members {
        return with_members(text, &root, edit, members);
    }
    let written = match (&edit.value, &edit.typed) {
        (Some(value), _) => written(value),
        (None, Some(typed)) => as_typed(typed),
        (None, None) => return Err(format!("no change is asked for at `{}`", edit.path())),
    };
    if let Some(found) = tree::at(&root, &edit.path).filter(|_| edit.before.is_none()) {
        return Ok(spliced(text, found.start()..found.end(), &written));
    }
    added(text, &root, &edit.path, &written, edit.before).ok_or_else(nothing)
}

/// The text with a range replaced.
fn spliced(text: &str, range: Range<usize>, with: &str) -> String {
    let before = text.get(..range.start).unwrap_or(text);
    let after = text.get(range.end..).unwrap_or("");
    [before, with, after].concat()
}

/// JSON on one line, with the usual spaces.
fn written(value: &serde_json::Value) -> String {
    let text = |text: &str| serde_json::Value::from(text).to_string();
    match value {
        serde_json::Value::Object(members) => {
            let members: Vec<String> =
                members.iter().map(|(key, of)| format!("{}: {}", text(key), written(of))).collect();
            format!("{{{}}}", members.join(", "))
        }
        serde_json::Value::Array(elements) => {
            let elements: Vec<String> = elements.iter().map(written).collect();
            format!("[{}]", elements.join(", "))
        }
        scalar => scalar.to_string(),
    }
}

/// A typed value: a number with its digits, a list of numbers, or a text.
fn as_typed(typed: &str) -> String {
    let typed = typed.trim();
    let number = |text: &str| -> Option<String> {
        if serde_json::from_str::<serde_json::Number>(text).is_ok() {
            return Some(text.to_owned());
        }
        // people also write `.5`, `5.` and `+5`
        let plain = text.strip_prefix('+').unwrap_or(text);
        let begins =
            plain.trim_start_matches('-').starts_with(|c: char| c.is_ascii_digit() || c == '.');
        let value: f64 = plain.parse().ok().filter(|value: &f64| begins && value.is_finite())?;
        serde_json::Number::from_f64(value).map(|number| number.to_string())
    };
    if let Some(number) = number(typed) {
        return number;
    }
    let inside = typed.strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
    if let Some(inside) = inside {
        let parts = inside.split([' ', ',', ';', '\n', '\t']).filter(|part| !part.is_empty());
        let parts: Vec<String> =
            parts.map(|part| number(part).unwrap_or_else(|| written(&part.into()))).collect();
        return format!("[{}]", parts.join(", "));
    }
    written(&typed.into())
}

/// The object or list that contains a value, and the last step to it.
fn container<'v, 't>(
    root: &'v Value<'t>,
    path: &'v [PathStep],
) -> Option<(&'v Value<'t>, &'v PathStep)> {
    let (last, above) = path.split_last()?;
    Some((tree::at(root, above)?, last))
}

/// The text with two elements of a list in each other's place.
fn exchanged(text: &str, root: &Value<'_>, path: &[PathStep], with: usize) -> Option<String> {
    let (Value::Array(array), PathStep::Place(place)) = container(root, path)? else { return None };
    let ranges = ranges(&array.elements);
    let (first, second) = (ranges.get(*place.min(&with))?, ranges.get(*place.max(&with))?);
    if first == second {
        return Some(text.to_owned());
    }
    let own = |range: &Range<usize>| text.get(range.clone()).unwrap_or("");
    let after = spliced(text, second.clone(), own(first));
    Some(spliced(&after, first.clone(), own(second)))
}

/// The range to remove with a value: its key, and a comma.
fn removed(root: &Value<'_>, path: &[PathStep]) -> Option<Range<usize>> {
    let (of, last) = container(root, path)?;
    let (ranges, place) = match (of, last) {
        (Value::Object(object), PathStep::Key(key)) => {
            let place = object.properties.iter().position(|of| of.name.as_str() == key)?;
            (ranges(&object.properties), place)
        }
        (Value::Array(array), PathStep::Place(place)) => (ranges(&array.elements), *place),
        _ => return None,
    };
    let own = ranges.get(place)?;
    if let Some(next) = ranges.get(place + 1) {
        return Some(own.start..next.start);
    }
    match place.checked_sub(1).and_then(|before| ranges.get(before)) {
        Some(before) => Some(before.end..own.end),
        None => Some(of.start() + 1..of.end().checked_sub(1)?),
    }
}

fn ranges(of: &[impl Ranged]) -> Vec<Range<usize>> {
    of.iter().map(|one| one.start()..one.end()).collect()
}

fn renamed(text: &str, root: &Value<'_>, edit: &Edit, name: &str) -> Result<String, String> {
    let found = container(root, &edit.path).and_then(|(of, last)| match last {
        PathStep::Key(key) => Some((of.as_object()?, key)),
        PathStep::Place(_) => None,
    });
    let Some((object, key)) = found else {
        return Err(format!("`{}` is no key", edit.path()));
    };
    if key != name && tree::member(object, name).is_some() {
        return Err(format!("there is a `{name}` already"));
    }
    let member = tree::member(object, key).ok_or_else(|| format!("there is no `{key}`"))?;
    let place = member.name.start()..member.name.end();
    Ok(spliced(text, place, &written(&name.into())))
}

/// The text with a new element in an object or a list. Missing objects on the path are created.
fn added(
    text: &str,
    root: &Value<'_>,
    path: &[PathStep],
    written: &str,
    before: Option<usize>,
) -> Option<String> {
    let known = (0..path.len()).rev().find(|&steps| tree::at(root, &path[..steps]).is_some())?;
    let of = tree::at(root, &path[..known])?;
    let mut value = written.to_owned();
    for step in path[known + 1..].iter().rev() {
        let PathStep::Key(key) = step else { return None };
        value = format!("{{{}: {value}}}", self::written(&key.as_str().into()));
    }
    match (of, &path[known]) {
        (Value::Object(object), PathStep::Key(key)) => {
            let value = format!("{}: {value}", self::written(&key.as_str().into()));
            Some(put_into_object(text, object, &value, before, known))
        }
        (Value::Array(array), PathStep::Place(_)) => {
            Some(put_into_array(text, array, &value, before))
        }
        _ => None,
    }
}

fn put_into_object(
    text: &str,
    object: &Object<'_>,
    value: &str,
    before: Option<usize>,
    depth: usize,
) -> String {
    let ranges = ranges(&object.properties);
    // named elements of a file are on lines of their own, the description of each is on one line
    put(text, object.start()..object.end(), &ranges, value, before, depth < 2)
}

fn put_into_array(text: &str, array: &Array<'_>, value: &str, before: Option<usize>) -> String {
    // an object is an element of its own, numbers and texts are those of a list
    let own_lines = value.starts_with('{');
    put(text, array.start()..array.end(), &ranges(&array.elements), value, before, own_lines)
}

fn put(
    text: &str,
    whole: Range<usize>,
    ranges: &[Range<usize>],
    value: &str,
    before: Option<usize>,
    own_lines: bool,
) -> String {
    if let Some(next) = before.and_then(|place| ranges.get(place)) {
        let gap = own_line(text, next.start).map_or_else(|| " ".to_owned(), |of| format!("\n{of}"));
        return spliced(text, next.start..next.start, &format!("{value},{gap}"));
    }
    if let Some(last) = ranges.last() {
        let first = ranges.first().unwrap_or(last);
        // like the last element that begins a line, unless all are on the line of the bracket
        let lines = ranges.iter().rev().find_map(|one| own_line(text, one.start));
        let broken = own_line(text, first.start).is_some();
        let gap = match lines {
            Some(indent) if broken || own_lines => format!("\n{indent}"),
            _ => " ".to_owned(),
        };
        let comma = text.get(last.end..whole.end).unwrap_or("").trim_start().starts_with(',');
        let glue = if comma { "" } else { "," };
        let place = if comma {
            last.end + text.get(last.end..).and_then(|rest| rest.find(',')).map_or(0, |at| at + 1)
        } else {
            last.end
        };
        return spliced(text, place..place, &format!("{glue}{gap}{value}"));
    }
    let inside = whole.start + 1..whole.end.saturating_sub(1);
    if !own_lines {
        return spliced(text, inside, value);
    }
    let start =
        text.get(..whole.start).and_then(|before| before.rfind('\n')).map_or(0, |at| at + 1);
    let line = text.get(start..).unwrap_or("");
    let indent: String = line.chars().take_while(|c| *c == ' ' || *c == '\t').collect();
    spliced(text, inside, &format!("\n{indent}  {value}\n{indent}"))
}

/// The white space before a position, if nothing else precedes it on its line.
fn own_line(text: &str, place: usize) -> Option<String> {
    let before = text.get(..place)?;
    let start = before.rfind('\n')? + 1;
    let indent = before.get(start..)?;
    indent.chars().all(|c| c == ' ' || c == '\t').then(|| indent.to_owned())
}

/// The text with an object of these members.
fn with_members(
    text: &str,
    root: &Value<'_>,
    edit: &Edit,
    members: &[(String, serde_json::Value)],
) -> Result<String, String> {
    let Some(found) = tree::at(root, &edit.path) else {
        let all: serde_json::Map<_, _> = members.iter().cloned().collect();
        let made = added(text, root, &edit.path, "{}", edit.before)
            .ok_or_else(|| format!("there is no place for `{}`", edit.path()))?;
        return if all.is_empty() { Ok(made) } else { one(&made, edit) };
    };
    let object = found.as_object().ok_or_else(|| format!("`{}` is no object", edit.path()))?;
    let now: Vec<&str> = object.properties.iter().map(|member| member.name.as_str()).collect();
    let mut names: Vec<&str> = Vec::new();
    for (name, _) in members {
        if names.contains(&name.as_str()) {
            return Err(format!("there are two of the name `{name}`"));
        }
        names.push(name);
    }
    let step = |key: &str| {
        let mut path = edit.path.clone();
        path.push(PathStep::Key(key.to_owned()));
        path
    };
    let mut edits = Vec::new();
    let differ: Vec<usize> =
        (0..now.len().min(names.len())).filter(|&i| now[i] != names[i]).collect();
    let mut had: Vec<String> = now.iter().map(|name| (*name).to_owned()).collect();
    if now.len() == names.len()
        && let [place] = differ.as_slice()
    {
        // a member with a new name
        edits.push(Edit::rename(step(now[*place]), names[*place]));
        had[*place] = names[*place].to_owned();
    } else {
        for name in now.iter().filter(|name| !names.contains(*name)) {
            edits.push(Edit::remove(step(name)));
        }
        had.retain(|name| names.contains(&name.as_str()));
    }
    for (place, (name, value)) in members.iter().enumerate() {
        if had.get(place).map(String::as_str) == Some(name) {
            let before = tree::member(object, now.get(place).copied().unwrap_or(name))
                .or_else(|| tree::member(object, name));
            let same = before.is_some_and(|member| same_value(text, &member.value, value));
            if !same {
                edits.push(Edit::set(step(name), value.clone()));
            }
            continue;
        }
        if let Some(from) = had.iter().position(|of| of == name) {
            edits.push(Edit::remove(step(name)));
            had.remove(from);
        }
        let before = (place < had.len()).then_some(place);
        edits.push(Edit { before, ..Edit::set(step(name), value.clone()) });
        had.insert(place.min(had.len()), name.clone());
    }
    edited(text, &edits)
}

fn same_value(text: &str, found: &Value<'_>, value: &serde_json::Value) -> bool {
    let found = text.get(found.start()..found.end()).unwrap_or("");
    serde_json::from_str::<serde_json::Value>(found).is_ok_and(|found| found == *value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    const TEXT: &str = "{\n  \"format\": 1,\n  \"inputs\": {\n    \"a\": {\"unit\": \"V\", \"mean\": 5.010,\n          \"std\": 1e-3}, // of 2024\n    \"b\": \"5.0(2) V\"\n  },\n  \"equations\": {\"y\": \"a*b\"}\n}\n";

    fn changed(edits: serde_json::Value) -> String {
        let edits: Vec<Edit> = serde_json::from_value(edits).unwrap();
        edited(TEXT, &edits).unwrap()
    }

    /// All unchanged lines, to compare with the lines before.
    fn lines_of(before: &str, after: &str) -> Vec<String> {
        let known: Vec<&str> = before.lines().collect();
        after.lines().filter(|line| !known.contains(line)).map(str::to_owned).collect()
    }

    #[test]
    fn a_value_is_changed_and_nothing_else() {
        let after = changed(json!([{"path": ["inputs", "a", "mean"], "typed": "5.020"}]));
        assert_eq!(after, TEXT.replace("5.010", "5.020"));
        let after = changed(json!([{"path": ["inputs", "a", "mean"], "typed": "5 V"}]));
        assert_eq!(after, TEXT.replace("5.010", "\"5 V\""));
        let after = changed(json!([{"path": ["inputs", "a", "mean"], "typed": ".5"}]));
        assert_eq!(after, TEXT.replace("5.010", "0.5"));
        let after = changed(json!([{"path": ["inputs", "a", "mean"], "value": null}]));
        assert_eq!(after, TEXT.replace("5.010", "null"));
        let after = changed(json!([{"path": ["inputs", "a", "mean"], "typed": "[1.0 2;x]"}]));
        assert_eq!(after, TEXT.replace("5.010", "[1.0, 2, \"x\"]"));
    }

    #[test]
    fn what_is_new_stands_as_its_neighbours_do() {
        let after = changed(json!([{"path": ["inputs", "c"], "value": {"unit": "1", "mean": 2}}]));
        assert_eq!(
            lines_of(TEXT, &after),
            ["    \"b\": \"5.0(2) V\",", "    \"c\": {\"unit\": \"1\", \"mean\": 2}"]
        );
        let after = changed(json!([{"path": ["inputs", "a", "dof"], "value": 4}]));
        assert_eq!(lines_of(TEXT, &after), ["          \"std\": 1e-3, \"dof\": 4}, // of 2024"]);
        let after = changed(json!([{"path": ["outputs", "y", "unit"], "value": "V"}]));
        assert_eq!(
            lines_of(TEXT, &after),
            ["  \"equations\": {\"y\": \"a*b\"},", "  \"outputs\": {\"y\": {\"unit\": \"V\"}}"]
        );
        let first = json!([{"path": ["inputs", "c"], "value": "1 V", "before": 0}]);
        assert_eq!(lines_of(TEXT, &changed(first)), ["    \"c\": \"1 V\","]);
        assert_eq!(
            edited("{}", &[Edit::set(tree::path_of(["title"]), json!("a"))]).unwrap(),
            "{\n  \"title\": \"a\"\n}"
        );
    }

    #[test]
    fn what_goes_takes_its_comma_along() {
        let gone = changed(json!([{"path": ["inputs", "b"], "remove": true}]));
        assert!(gone.contains("1e-3}\n  },"), "{gone}");
        let gone = changed(json!([{"path": ["inputs", "a"], "remove": true}]));
        assert!(gone.contains("{\n    \"b\": \"5.0(2) V\"\n  }"), "{gone}");
        let gone = changed(json!([{"path": ["equations", "y"], "remove": true}]));
        assert!(gone.contains("\"equations\": {}"), "{gone}");
        let wrong: Vec<Edit> =
            serde_json::from_value(json!([{"path": ["inputs", "x"], "remove": true}])).unwrap();
        assert_eq!(edited(TEXT, &wrong).unwrap_err(), "there is nothing at `inputs/x`");
    }

    #[test]
    fn members_are_kept_where_they_are_the_same() {
        let members = |of: serde_json::Value| {
            let after = changed(json!([{"path": ["equations"], "members": of}]));
            after.lines().find(|line| line.contains("equations")).unwrap_or("").to_owned()
                + after
                    .split("\"equations\"")
                    .nth(1)
                    .unwrap_or("")
                    .split_once('\n')
                    .map_or("", |t| t.1)
        };
        assert_eq!(members(json!([["y", "a*b"]])), "  \"equations\": {\"y\": \"a*b\"}}\n");
        assert_eq!(members(json!([["z", "a*b"]])), "  \"equations\": {\"z\": \"a*b\"}}\n");
        assert_eq!(
            members(json!([["x", "a"], ["y", "x*b"]])),
            "  \"equations\": {\"x\": \"a\", \"y\": \"x*b\"}}\n"
        );
        assert_eq!(members(json!([])), "  \"equations\": {}}\n");
        let edits: Vec<Edit> = serde_json::from_value(
            json!([{"path": ["equations"], "members": [["y", "a"], ["z", "2*y"]]}]),
        )
        .unwrap();
        let of_nothing = edited("{\n  \"format\": 1\n}\n", &edits).unwrap();
        assert_eq!(
            of_nothing,
            "{\n  \"format\": 1,\n  \"equations\": {\n    \"y\": \"a\",\n    \"z\": \"2*y\"\n  }\n}\n"
        );
        let order: Vec<Edit> = serde_json::from_value(
            json!([{"path": ["equations"], "members": [["z", "2*a"], ["y", "z"]]}]),
        )
        .unwrap();
        let turned = edited(&of_nothing, &order).unwrap();
        let found: serde_json::Value = serde_json::from_str(&turned).unwrap();
        assert_eq!(found["equations"], json!({"z": "2*a", "y": "z"}), "{turned}");
        assert!(turned.find("\"z\"").unwrap() < turned.find("\"y\"").unwrap(), "{turned}");
    }

    #[test]
    fn keys_get_other_names() {
        let after = changed(json!([{"path": ["inputs", "a"], "rename": "voltage"}]));
        assert_eq!(after, TEXT.replace("\"a\"", "\"voltage\""));
        let taken: Vec<Edit> =
            serde_json::from_value(json!([{"path": ["inputs", "a"], "rename": "b"}])).unwrap();
        assert_eq!(edited(TEXT, &taken).unwrap_err(), "there is a `b` already");
    }

    #[test]
    fn a_byte_order_mark_stays() {
        let edit = Edit::set(tree::path_of(["a"]), json!(2));
        assert_eq!(edited("\u{feff}{\"a\": 1}", &[edit]).unwrap(), "\u{feff}{\"a\": 2}");
    }
}
