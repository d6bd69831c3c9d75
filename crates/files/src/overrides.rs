//! Values that stand in place of those of a file: estimates, fields of inputs, values of conditions.

use std::borrow::Cow;
use std::ops::Range;

use super::dates;
use gumption_columns::separator::{DecimalMarks, Separator};
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

/// The field of readings and samples, which is a list.
const LIST: &str = "values";

/// The shapes that have it.
const LISTED: [&str; 3] = ["readings", "samples", "quantiles"];

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

    /// The variable whose listed values it replaces, `V` of `V.values=1,2`; readings that are a component
    /// of `V` as well.
    pub(super) fn is_list_of(&self, variable: &str, is_readings: bool) -> bool {
        let Some(part) = self.field.as_deref().and_then(|field| field.strip_suffix(LIST)) else {
            return false;
        };
        let rest = variable.strip_prefix(self.input.as_str());
        let rest = rest.and_then(|rest| match part.strip_suffix('.') {
            Some(part) => rest.strip_prefix('.')?.strip_prefix(part),
            None => Some(rest).filter(|_| part.is_empty()),
        });
        rest.is_some_and(|rest| rest.is_empty() || is_readings && rest.starts_with('/'))
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
        let (own, component) = match (&replaced.field, replaced.input.split_once('/')) {
            (Some(_), Some((own, component))) => (own, Some(component)),
            _ => (replaced.input.as_str(), None),
        };
        let Some(input) = inputs.iter_mut().find(|m| m.key == own) else {
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
        let report = |reason| {
            let text = replaced.text.clone();
            log.report(&whole, DiagnosticKind::Override { text, reason });
        };
        let span = input.key_span.clone();
        let fields = match component {
            None => fields,
            Some(name) => match component_of(fields, |fields| has_text(fields, "name", name)) {
                Some(fields) => fields,
                None => {
                    report(format!("`{own}` has no component `{name}`"));
                    continue;
                }
            },
        };
        if field == LIST {
            if let Err(reason) = replace_list(fields, replaced, &span) {
                report(reason);
            }
            continue;
        }
        let finite = replaced.value.parse::<f64>().is_ok_and(f64::is_finite);
        let value = if finite {
            Json::Number(replaced.value.as_str().into())
        } else {
            Json::Text(replaced.value.clone())
        };
        put(fields, field, value, &span);
    }
}

/// Puts a value into the fields of an object.
fn put(fields: &mut Vec<Member>, key: &str, value: Json, span: &Range<usize>) {
    match fields.iter_mut().find(|member| member.key == key) {
        Some(member) => member.value.value = value,
        None => {
            let value = Node { span: span.clone(), value };
            fields.push(Member { key: key.to_owned(), key_span: span.clone(), value });
        }
    }
}

/// Whether a field is this text.
fn has_text(fields: &[Member], key: &str, text: &str) -> bool {
    let is_it = |member: &Member| matches!(&member.value.value, Json::Text(found) if found == text);
    fields.iter().any(|member| member.key == key && is_it(member))
}

/// The fields of a component.
fn component_of(
    fields: &mut [Member],
    is_wanted: impl Fn(&[Member]) -> bool,
) -> Option<&mut Vec<Member>> {
    let components = fields.iter_mut().find(|member| member.key == "components")?;
    let Json::List(components) = &mut components.value.value else { return None };
    components.iter_mut().find_map(|node| match &mut node.value {
        Json::Object(fields) if is_wanted(fields) => Some(fields),
        _ => None,
    })
}

/// Puts listed values in place of those of an input, of its component of readings, or of the file that
/// they are read from; or why that cannot be.
fn replace_list(
    fields: &mut Vec<Member>,
    replaced: &Override,
    span: &Range<usize>,
) -> Result<(), String> {
    let has = |fields: &[Member], key: &str| fields.iter().any(|member| member.key == key);
    let fields = match has(fields, "components") {
        false => Some(fields),
        true => component_of(fields, |fields| has_text(fields, "distribution", "readings")),
    };
    let input = &replaced.input;
    let is_listed = |fields: &&mut Vec<Member>| {
        LISTED.iter().any(|shape| has_text(fields, "distribution", shape))
    };
    let fields = fields.filter(is_listed);
    let Some(fields) = fields else {
        return Err(format!("`{input}` has no values; `--set {input}=...` changes its estimate"));
    };
    if has(fields, "groups") {
        return Err(format!(
            "the readings of `{input}` are in groups, which a list does not name; give a file with \
             `--readings`"
        ));
    }
    let list = listed_values(&replaced.value)?;
    let nodes = list.into_iter().map(|value| Node { span: span.clone(), value }).collect();
    fields.retain(|member| !["file", "column"].contains(&member.key.as_str()));
    put(fields, LIST, Json::List(nodes), span);
    Ok(())
}

/// Values between commas, or between semicolons, where numbers may have decimal commas: `5.01, 5.02`. One
/// unit behind the last one is the unit of all.
fn listed_values(text: &str) -> Result<Vec<Json>, String> {
    let separator = match text.contains(';') {
        true => Separator::Semicolon,
        false => Separator::Comma,
    };
    let mut marks = DecimalMarks::of(separator);
    let cells = text.split(separator.sign()).map(|cell| marks.with_point(cell.trim()));
    let cells: Vec<Cow<'_, str>> = cells.collect::<Result<_, _>>()?;
    let is_number = |cell: &Cow<'_, str>| cell.parse::<f64>().is_ok_and(f64::is_finite);
    if cells.iter().all(is_number) {
        return Ok(cells.into_iter().map(|cell| Json::Number(cell.into())).collect());
    }
    let of_unit = |cell: &Cow<'_, str>| with_unit(cell).is_some();
    let (last, others) = cells.split_last().unwrap_or((&Cow::Borrowed(""), &[]));
    let unit = match with_unit(last) {
        Some((_, unit)) if others.iter().all(is_number) => Some(unit),
        Some(_) if others.iter().all(of_unit) => None,
        _ => {
            let wrong = cells.iter().find(|cell| !is_number(cell) && !of_unit(cell));
            return Err(match wrong {
                Some(wrong) => format!(
                    "`{wrong}` is no number; values stand between commas: `5.01, 5.02, 5.03` or \
                     `5.01, 5.02, 5.03 V`"
                ),
                None => "some values have a unit and others none; write it behind the last one, or behind \
                         each"
                    .to_owned(),
            });
        }
    };
    let whole = |cell: &Cow<'_, str>| match unit.filter(|_| is_number(cell)) {
        Some(unit) => format!("{cell} {unit}"),
        None => cell.clone().into_owned(),
    };
    Ok(cells.iter().map(|cell| Json::Text(whole(cell))).collect())
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
            values.value =
                Json::List(vec![Node { span, value: Json::Number(value.to_string().into()) }]);
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

    #[test]
    fn lists_have_one_unit_or_a_unit_each() {
        let read = |text: &str| {
            let list = listed_values(text)?;
            Ok::<_, String>(list.iter().map(|value| format!("{value:?}")).collect::<Vec<_>>())
        };
        let number = |text: &str| format!("{:?}", Json::Number(text.into()));
        let text = |text: &str| format!("{:?}", Json::Text(text.to_owned()));
        assert_eq!(read("5.01, 5.02").unwrap(), [number("5.01"), number("5.02")]);
        assert_eq!(read("5,01; 5,02").unwrap(), [number("5.01"), number("5.02")]);
        assert_eq!(read("5.01,5.02 V").unwrap(), [text("5.01 V"), text("5.02 V")]);
        assert_eq!(read("5.01 V, 5020 mV").unwrap(), [text("5.01 V"), text("5020 mV")]);
        for wrong in ["", "5.01,", "5.01 V, 5.02", "5.01, x", "nan", "5.01 V, 5.02, 5.03 V"] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn lists_are_of_variables() {
        for (text, variable, is_readings, expected) in [
            ("V.values=1,2", "V", true, true),
            ("V.values=1,2", "V/scatter", true, true),
            ("V.values=1,2", "V/scale", false, false),
            ("V.values=1,2", "V2", true, false),
            ("V/scatter.values=1,2", "V/scatter", true, true),
            ("z.re.values=1,2", "z.re", true, true),
            ("z.re.values=1,2", "z.im", true, false),
            ("V.mean=1", "V", true, false),
        ] {
            let of = Override::parse(text).unwrap();
            assert_eq!(of.is_list_of(variable, is_readings), expected, "{text} {variable}");
        }
    }

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
