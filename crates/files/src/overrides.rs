//! Values that stand in place of those of a file: estimates, fields of inputs, values of conditions.

use std::ops::Range;

use super::dates;
use gumption_text::json::{Json, Member, Node};
use gumption_text::value_text::{ValueOf, converted, with_unit};
use gumption_text::{Collector, DiagnosticKind};
use gumption_units::Unit;
use gumption_units::nearest;

/// A replacement as text: `NAME=VALUE` or `NAME.field=VALUE`.
#[derive(Clone, Debug, PartialEq)]
pub struct Override {
    /// The option's text.
    pub text: String,
    /// The input.
    pub input: String,
    /// The field, or none for the estimate.
    pub field: Option<String>,
    /// What to put there.
    pub value: String,
}

/// At most so many names are listed in a message.
const MOST_NAMES: usize = 12;

/// Replacements in the order of the command line.
pub type Overrides = Vec<Override>;

impl Override {
    /// Parses `NAME=VALUE` or `NAME.field=VALUE`; `None` if there is no `=` or no name.
    pub fn parse(text: &str) -> Option<Self> {
        let (name, value) = text.split_once('=')?;
        let (input, field) = match name.split_once('.') {
            Some((input, field)) => (input, Some(field.trim().to_owned())),
            None => (name, None),
        };
        let input = input.trim().to_owned();
        (!input.is_empty()).then(|| Self {
            text: text.to_owned(),
            input,
            field,
            value: value.trim().to_owned(),
        })
    }

    /// Whether both say the same of an input: of `a=1` and `a.mean=2` one would be lost.
    fn contradicts(&self, other: &Self) -> bool {
        let same = |whole: &Option<String>, field: &Option<String>| match (whole, field) {
            (None, Some(field)) => is_estimate(field),
            // parts of complex quantities
            (Some(part), Some(field)) => {
                let of_part =
                    field.strip_prefix(part.as_str()).and_then(|rest| rest.strip_prefix('.'));
                of_part.is_some_and(is_estimate)
            }
            _ => false,
        };
        let (a, b) = (&self.field, &other.field);
        self.input == other.input && (a == b || same(a, b) || same(b, a))
    }

    /// The value in `unit` as [`value_in`](Self::value_in) gives it, which may be a date of the file.
    pub(super) fn value_of_file(
        &self,
        unit: &Unit,
        log: &Collector,
    ) -> Result<f64, DiagnosticKind> {
        let value = dates::in_days(log, &self.value).map_err(|reason| {
            let text = self.text.clone();
            DiagnosticKind::Override { text, reason }
        })?;
        Self { value: value.into_owned(), ..self.clone() }.value_in(unit, &log.own_units())
    }

    /// The value in `unit`: a number in it, or a number with another unit, also one that the file
    /// defines, converted with the zeros of their scales.
    pub(super) fn value_in(&self, unit: &Unit, own: &[Unit]) -> Result<f64, DiagnosticKind> {
        let diagnostic =
            |reason: String| DiagnosticKind::Override { text: self.text.clone(), reason };
        if let Ok(value) = self.value.parse::<f64>() {
            if value.is_finite() {
                return Ok(value);
            }
            return Err(diagnostic("the value must be a finite number".to_owned()));
        }
        let value = with_unit(&self.value).ok_or_else(|| {
            diagnostic("a number is needed, or one with a unit: \"35 deg\"".to_owned())
        })?;
        converted(value, unit, ValueOf::Quantity, own).map_err(diagnostic)
    }
}

/// Whether a field is the estimate, which a replacement without a field is as well.
fn is_estimate(field: &str) -> bool {
    matches!(field, "mean" | "value")
}

/// Puts the values of fields and of conditions into the tree; those of estimates are taken when the
/// input is read.
pub(super) fn apply(log: &Collector, root: &mut Node, overrides: &[Override]) {
    let whole = root.span.start..root.span.start;
    for (number, replaced) in overrides.iter().enumerate() {
        if let Some(first) =
            overrides.iter().take(number).find(|change| change.contradicts(replaced))
        {
            let text = replaced.text.clone();
            let reason = format!("it and `{}` replace the same; give one of them", first.text);
            log.report(&whole, DiagnosticKind::Override { text, reason });
            return;
        }
        if override_condition(log, root, replaced) {
            continue;
        }
        let table = table_of_conditions(root, &replaced.input);
        let inputs = match &mut root.value {
            Json::Object(members) => members.iter_mut().find(|m| m.key == "inputs"),
            _ => None,
        };
        let inputs = match inputs.map(|m| &mut m.value.value) {
            Some(Json::Object(members)) => members,
            _ => return,
        };
        let names: Vec<String> = inputs.iter().map(|m| m.key.clone()).collect();
        let Some(input) = inputs.iter_mut().find(|m| m.key == replaced.input) else {
            if let Some((file, Some(place))) = &table {
                let name = &replaced.input;
                let reason = format!(
                    "`{name}` is a condition, whose values stand in the rows of `{file}`: change rows \
                     or leave them out there, or write `conditions` as a grid, \
                     {{\"{name}\": {{\"unit\": ..., \"values\": [...]}}}}, which a replacement sets to one \
                     value; a row of a certificate chooses among them with `set`"
                );
                log.report(place, DiagnosticKind::Override { text: replaced.text.clone(), reason });
                continue;
            }
            let nearest = nearest(&replaced.input, names.iter().map(String::as_str));
            let reason = match nearest {
                Some(name) => format!("there is no input of that name; did you mean `{name}`?"),
                None => {
                    let most = names.iter().take(MOST_NAMES).map(|name| format!("`{name}`"));
                    let more = if names.len() > MOST_NAMES { ", ..." } else { "" };
                    let list = most.collect::<Vec<_>>().join(", ");
                    let rows = table.map_or_else(String::new, |(file, _)| {
                        format!("; conditions are rows of `{file}` and are changed there")
                    });
                    format!("there is no input of that name; the inputs are {list}{more}{rows}")
                }
            };
            log.report(&whole, DiagnosticKind::Override { text: replaced.text.clone(), reason });
            continue;
        };
        let (Some(field), Json::Object(fields)) = (&replaced.field, &mut input.value.value) else {
            continue;
        };
        let (field, fields) = match fields.iter().position(|member| member.key == "complex") {
            None => (field.as_str(), fields),
            Some(complex) => {
                // estimates of parts are taken when these are read
                let (part, field) = match field.split_once('.') {
                    Some((part, field)) => (part, Some(field)),
                    None => (field.as_str(), None),
                };
                let key = match part {
                    "abs" => "modulus",
                    "arg" => "phase",
                    part => part,
                };
                match fields.get_mut(complex).and_then(|field| member_of(&mut field.value, key)) {
                    Some(Node { value: Json::Object(fields), .. }) => match field {
                        Some(field) => (field, fields),
                        None => continue,
                    },
                    _ => {
                        let reason = format!("`{}` has no part `{part}`", replaced.input);
                        let text = replaced.text.clone();
                        log.report(&whole, DiagnosticKind::Override { text, reason });
                        continue;
                    }
                }
            }
        };
        let finite = replaced.value.parse::<f64>().is_ok_and(f64::is_finite);
        let value = if finite {
            Json::Number(replaced.value.clone())
        } else {
            Json::Text(replaced.value.clone())
        };
        match fields.iter_mut().find(|m| m.key == field) {
            Some(member) => member.value.value = value,
            None => {
                let span = input.key_span.clone();
                fields.push(Member {
                    key: field.to_owned(),
                    key_span: span.clone(),
                    value: Node { span, value },
                });
            }
        }
    }
}

/// Puts one value in place of those of a condition of a grid; false if there is none of that name.
fn override_condition(log: &Collector, root: &mut Node, replaced: &Override) -> bool {
    let Some((unit, values)) = condition_of_grid(log, root, &replaced.input) else {
        return false;
    };
    if replaced.field.is_some() {
        return false;
    }
    match replaced.value_of_file(&unit, log) {
        Ok(value) => {
            let span = values.span.clone();
            values.value = Json::List(vec![Node { span, value: Json::Number(value.to_string()) }]);
        }
        Err(diagnostic) => log.report(&values.span, diagnostic),
    }
    true
}

/// The table whose rows are the conditions, and the place where the file names one of its columns.
fn table_of_conditions(root: &mut Node, name: &str) -> Option<(String, Option<Range<usize>>)> {
    let conditions = member_of(root, "conditions")?;
    let file = match &member_of(conditions, "file")?.value {
        Json::Text(file) => file.clone(),
        _ => return None,
    };
    let place = match member_of(conditions, "units").map(|units| &units.value) {
        Some(Json::Object(units)) => units.iter().find(|unit| unit.key == name),
        _ => None,
    };
    Some((file, place.map(|unit| unit.key_span.clone())))
}

/// The values of a condition of a grid, and its unit.
fn condition_of_grid<'n>(
    log: &Collector,
    root: &'n mut Node,
    name: &str,
) -> Option<(Unit, &'n mut Node)> {
    let condition = member_of(member_of(root, "conditions")?, name)?;
    let unit = match member_of(condition, "unit").map(|unit| &unit.value) {
        Some(Json::Text(text)) => log.unit(text).ok()?,
        _ => Unit::one(),
    };
    Some((unit, member_of(condition, "values")?))
}

fn member_of<'n>(node: &'n mut Node, key: &str) -> Option<&'n mut Node> {
    match &mut node.value {
        Json::Object(members) => {
            members.iter_mut().find(|member| member.key == key).map(|member| &mut member.value)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In either order, and of the parts of a complex quantity.
    #[test]
    fn two_estimates_of_one_input_contradict() {
        let of = |text: &str| Override::parse(text).unwrap();
        for (a, b, expected) in [
            ("a=1", "a=2", true),
            ("a=1", "a.mean=2", true),
            ("a=1", "a.value=2", true),
            ("g.re=1", "g.re.mean=2", true),
            ("a.std=1", "a.std=2", true),
            ("a=1", "a.std=2", false),
            ("a=1", "b.mean=2", false),
            ("g.re=1", "g.im.mean=2", false),
        ] {
            assert_eq!(of(a).contradicts(&of(b)), expected, "{a} {b}");
            assert_eq!(of(b).contradicts(&of(a)), expected, "{b} {a}");
        }
    }
}
