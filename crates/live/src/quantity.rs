//! Quantities typed into a field of an input: a whole one (`5.0112(23) V`) fills all fields, one with a
//! unit (`100 ohm`) decides a unit that is not decided yet.

use gumption_text::notation;
use gumption_text::value_text::with_plus_minus;
use gumption_units::Unit;
use jsonc_parser::ast::{Object, Value};
use serde_json::json;

use crate::edit::{self, Edit};
use crate::tree::{self, PathStep, raw};
use crate::ways::{self, CENTRES};

/// As [`edit::edited`], where a quantity that is typed into a field of an input fills its other fields.
///
/// # Errors
/// The text is not a JSON object, or a change is not applicable; a sentence.
pub(crate) fn edited(text: &str, edits: &[Edit]) -> Result<String, String> {
    edits.iter().try_fold(text.to_owned(), |now, edit| {
        let bare = now.strip_prefix('\u{feff}').unwrap_or(&now);
        let meant = edit
            .as_typed()
            .and_then(|(path, typed)| taken(bare, &tree::parse(bare).ok()?, path, typed));
        match meant {
            Some(meant) => edit::edited(&now, &meant),
            None => edit::edited(&now, std::slice::from_ref(edit)),
        }
    })
}

/// The changes that a typed text means, if it is typed into a field of an input and says more than the
/// value of that field.
fn taken(text: &str, root: &Value<'_>, path: &[PathStep], typed: &str) -> Option<Vec<Edit>> {
    let [PathStep::Key(inputs), PathStep::Key(_), PathStep::Key(key)] = path else { return None };
    if inputs != "inputs"
        || ["about", "source", "group", "type", "file", "column"].contains(&key.as_str())
    {
        return None;
    }
    let (_, above) = path.split_last()?;
    let input = Input { text, above, object: tree::at(root, above)?.as_object()? };
    input
        .whole(typed)
        .or_else(|| input.with_unit(key, typed))
        .or_else(|| input.with_width(key, typed))
}

/// Whether a text is a value with ± and no coverage, of which the form has to ask what it is.
pub(crate) fn is_undecided(text: &str) -> bool {
    let text = with_plus_minus(text);
    let Some((value, width)) = text.split_once('±') else { return false };
    notation::written_out(value).is_some()
        && !width.trim().is_empty()
        && !notation::states_uncertainty(&text)
}

struct Input<'a> {
    text: &'a str,
    above: &'a [PathStep],
    object: &'a Object<'a>,
}

impl Input<'_> {
    fn step(&self, key: &str) -> Vec<PathStep> {
        let mut path = self.above.to_vec();
        path.push(PathStep::Key(key.to_owned()));
        path
    }

    /// A value with its uncertainty: the input is what it says.
    fn whole(&self, typed: &str) -> Option<Vec<Edit>> {
        let members =
            notation::written_out(typed).filter(|_| notation::states_uncertainty(typed))?;
        is_unit(&members).then_some(())?;
        let stays = |key: &str| members.iter().any(|(of, _)| of == key);
        let keys = self.object.properties.iter().map(|member| member.name.as_str());
        let gone = keys.filter(|key| ways::is_of_distribution(key) && !stays(key));
        let mut edits: Vec<Edit> = gone.map(|key| Edit::remove(self.step(key))).collect();
        edits.extend(members.iter().map(|(key, value)| self.written(key, value)));
        Some(edits)
    }

    /// A value with a unit in a field for the estimate, or for the unit, of an input without one.
    fn with_unit(&self, key: &str, typed: &str) -> Option<Vec<Edit>> {
        let members = notation::written_out(typed)?;
        let [(unit_key, unit), _, (_, value)] = members.as_slice() else { return None };
        let is_open = |key: &str| {
            tree::member(self.object, key).is_none_or(|of| {
                raw(self.text, &of.value).is_empty() || matches!(of.value, Value::NullKeyword(_))
            })
        };
        let centre = CENTRES.into_iter().find(|of| tree::member(self.object, of).is_some());
        let into = match key {
            "unit" => centre.filter(|centre| is_open(centre))?,
            _ => CENTRES.into_iter().find(|of| *of == key && is_open("unit"))?,
        };
        (unit_key == "unit" && is_unit(&members)).then_some(())?;
        Some(vec![self.written("unit", unit), self.written(into, value)])
    }

    /// A value with ±, in a field for the estimate of an input whose width is of a known kind.
    fn with_width(&self, key: &str, typed: &str) -> Option<Vec<Edit>> {
        CENTRES.contains(&key).then_some(())?;
        let typed = with_plus_minus(typed);
        let (value, width) = typed.split_once('±')?;
        let of = ["half_width", "expanded"]
            .into_iter()
            .find(|of| tree::member(self.object, of).is_some())?;
        notation::written_out(value)?;
        let (value, width) = (value.trim(), width.trim());
        let mut edits =
            self.with_unit(key, value).unwrap_or_else(|| vec![self.written(key, value)]);
        edits.push(self.written(of, width));
        Some(edits)
    }

    /// A member with a value as it is typed.
    fn written(&self, key: &str, value: &str) -> Edit {
        // a name stays a text
        match key {
            "unit" | "distribution" => Edit::set(self.step(key), json!(value)),
            _ => Edit::typed(self.step(key), value),
        }
    }
}

/// Whether the unit of a quantity is one, if it has any.
fn is_unit(members: &[(String, String)]) -> bool {
    let unit = members.iter().find(|(key, _)| key == "unit");
    unit.is_none_or(|(_, unit)| Unit::parse(unit).is_ok())
}
