//! The rows of a recipe: files, frequencies and conditions of what was recorded together.

use std::ops::Range;

use super::super::keys;
use super::quantity::{of_object, own_unit, quantity, same_dimension, uncertainty, unit};
use super::recordings::{RecordingFile, check_part};
use super::{RecipeCondition, RecipeRow, check_name};
use gumption_signal::Frequency;
use gumption_text::DiagnosticKind;
use gumption_text::json::{Json, Member, Node};
use gumption_text::object::Object;

/// At most so many rows.
const MOST_ROWS: usize = 10_000;

type Read = (Vec<RecipeRow>, Vec<RecipeCondition>, String);

pub(super) fn read(
    root: &Object<'_>,
    recordings: &[RecordingFile],
    (single, has_frequency): (bool, Option<bool>),
) -> Option<Read> {
    let general = root.get("frequency").map(|member| (frequencies(root, member), member));
    let name = match root.get("frequency").map(|member| &member.value.value) {
        Some(Json::Object(members)) => members.iter().find(|m| m.key == "name"),
        _ => None,
    };
    let name = match name.map(|member| (&member.value.value, &member.value.span)) {
        Some((Json::Text(name), place)) => {
            check_name(root.log, name, place);
            name.clone()
        }
        _ => "f".to_owned(),
    };
    let (conditions, constants) = conditions(root)?;
    if let Some(member) =
        root.get("conditions").filter(|_| conditions.iter().any(|c| c.name == name))
    {
        root.log.report(&member.key_span, DiagnosticKind::NameTaken { name: name.clone() });
    }
    let nodes = match root.get("rows") {
        Some(_) => root.list("rows")?,
        None => &[],
    };
    let reader = RecipeRowsReader {
        root,
        recordings,
        conditions: &conditions,
        constants,
        general,
        single,
        has_frequency,
    };
    let rows: Vec<RecipeRow> = match root.get("rows") {
        Some(member) if nodes.is_empty() => {
            root.log.report(&member.key_span, DiagnosticKind::NoValues { name: "rows".into() });
            return None;
        }
        Some(member) if nodes.len() > MOST_ROWS => {
            let (what, found) = ("rows of a recipe", nodes.len());
            root.log
                .report(&member.key_span, DiagnosticKind::TooMany { what, found, most: MOST_ROWS });
            return None;
        }
        Some(_) => nodes.iter().filter_map(|node| reader.row(Some(node))).collect(),
        None => reader.row(None).into_iter().collect(),
    };
    Some((rows, conditions, name))
}

/// The conditions, and the value of each where it is the same in all rows.
fn conditions(root: &Object<'_>) -> Option<(Vec<RecipeCondition>, Vec<Option<f64>>)> {
    let (mut conditions, mut constants) = (Vec::new(), Vec::new());
    let Some(member) = root.get("conditions") else { return Some((conditions, constants)) };
    let object = Object::new(root.log, "`conditions`", &member.value, &member.key_span)?;
    for member in object.members() {
        check_name(root.log, &member.key, &member.key_span);
        let of =
            Object::new(root.log, "a condition of recordings", &member.value, &member.key_span)?;
        keys::check(&of, keys::RECIPE_CONDITION);
        of.text("about");
        let unit = unit(&of, "unit", "1")?;
        conditions.push(RecipeCondition { name: member.key.clone(), unit });
        constants.push(of.number("value"));
    }
    Some((conditions, constants))
}

struct RecipeRowsReader<'a> {
    root: &'a Object<'a>,
    recordings: &'a [RecordingFile],
    conditions: &'a [RecipeCondition],
    constants: Vec<Option<f64>>,
    general: Option<(Option<Vec<Frequency>>, &'a Member)>,
    /// Whether a row has one frequency at most.
    single: bool,
    /// Whether it has any; not known where the channels are wrong.
    has_frequency: Option<bool>,
}

impl RecipeRowsReader<'_> {
    /// A row, or the only one where the recipe has no rows.
    fn row(&self, node: Option<&Node>) -> Option<RecipeRow> {
        let log = self.root.log;
        let object = match node {
            Some(node) => {
                let object = Object::new(log, "a row of a recipe", node, &node.span)?;
                keys::check(&object, keys::RECIPE_ROW);
                Some(object)
            }
            None => None,
        };
        let place = node.map_or(self.root.place().clone(), |node| node.span.clone());
        let own = object.as_ref().and_then(|object| object.get("frequency").map(|m| (object, m)));
        let (frequencies, frequency_place) = match (own, &self.general) {
            (Some((object, member)), _) => {
                if self.has_frequency == Some(false) {
                    let reason = "a row of waveforms has no `frequency`".to_owned();
                    log.report(&member.key_span, DiagnosticKind::Recipe { reason });
                }
                (frequencies(object, member), member.key_span.clone())
            }
            (None, Some((general, member))) => (general.clone(), member.key_span.clone()),
            (None, None) if self.has_frequency != Some(true) => (Some(Vec::new()), place.clone()),
            (None, None) => {
                let what = if node.is_some() { "a row of a recipe" } else { "a recipe" };
                log.report(&place, DiagnosticKind::MissingKey { key: "frequency", what });
                (None, place.clone())
            }
        };
        if self.single && frequencies.as_ref().is_some_and(|list| list.len() > 1) {
            let reason = "the method `fft` takes one frequency in each row".to_owned();
            log.report(&frequency_place, DiagnosticKind::Recipe { reason });
        }
        let values = self.values(object.as_ref(), &place);
        let files = self.files(object.as_ref(), &place);
        let seconds =
            |key| object.as_ref().and_then(|object| quantity(object, key, "s")).map(|q| q.si());
        let (from, to) = (seconds("from"), seconds("to"));
        if let Some(object) = &object {
            check_part(object, from, to);
        }
        let part = |file: &RecordingFile| [from.or(file.from), to.or(file.to)];
        Some(RecipeRow {
            frequencies: frequencies?,
            conditions: values?,
            files: files?,
            parts: self.recordings.iter().map(part).collect(),
            frequency_place,
        })
    }

    /// The values of the conditions.
    fn values(&self, row: Option<&Object<'_>>, place: &Range<usize>) -> Option<Vec<f64>> {
        let log = self.root.log;
        let mut values = self.constants.clone();
        if let Some((row, member)) = row.and_then(|row| row.get("conditions").map(|m| (row, m))) {
            let object = Object::new(log, "conditions of a row", &member.value, &member.key_span)?;
            for member in object.members() {
                let at = self.conditions.iter().position(|c| c.name == member.key);
                match at.and_then(|at| values.get_mut(at)) {
                    Some(value) => *value = object.number(&member.key).or(*value),
                    None => {
                        let names: Vec<&str> =
                            self.conditions.iter().map(|c| c.name.as_str()).collect();
                        let reason = format!(
                            "`{}` is no condition of this recipe; `conditions` at its root has {}",
                            member.key,
                            if names.is_empty() { "none".to_owned() } else { names.join(", ") }
                        );
                        row.log.report(&member.key_span, DiagnosticKind::Recipe { reason });
                    }
                }
            }
        }
        let missing = values.iter().position(Option::is_none);
        if let Some(at) = missing {
            let reason = format!(
                "the condition `{}` has no value here, and none for all rows",
                self.conditions[at].name
            );
            log.report(place, DiagnosticKind::Recipe { reason });
            return None;
        }
        values.into_iter().collect()
    }

    /// The file of each recording.
    fn files(
        &self,
        row: Option<&Object<'_>>,
        place: &Range<usize>,
    ) -> Option<Vec<(String, Range<usize>)>> {
        let log = self.root.log;
        let member = row.and_then(|row| row.get("files"));
        let of = match member {
            Some(member) => Some(Object::new(log, "`files`", &member.value, &member.key_span)?),
            None => None,
        };
        for member in of.iter().flat_map(|object| object.members()) {
            if !self.recordings.iter().any(|recording| recording.name == member.key) {
                let reason = format!("there is no recording `{}`", member.key);
                log.report(&member.key_span, DiagnosticKind::Recipe { reason });
            }
        }
        let file = |recording: &RecordingFile| {
            let own = of.as_ref().and_then(|object| {
                let member = object.get(&recording.name)?;
                Some((object.text(&recording.name)?.to_owned(), member.value.span.clone()))
            });
            let found = own.or_else(|| recording.file.clone());
            if found.is_none() {
                let reason = format!("the recording `{}` has no `file`", recording.name);
                let place = if row.is_some() { place } else { &recording.place };
                log.report(place, DiagnosticKind::Recipe { reason });
            }
            found
        };
        self.recordings.iter().map(file).collect()
    }
}

/// Frequencies: a number in hertz, a list of them, or an object.
fn frequencies(object: &Object<'_>, member: &Member) -> Option<Vec<Frequency>> {
    let stated =
        |hertz: f64| Frequency { hertz: Some(hertz), standard_uncertainty: 0.0, estimate: false };
    let list: Vec<Frequency> = match &member.value.value {
        Json::Number(_) => vec![stated(member.value.number()?)],
        Json::List(_) => object.numbers("frequency")?.into_iter().map(stated).collect(),
        _ => {
            let object = Object::new(object.log, "`frequency`", &member.value, &member.key_span)?;
            keys::check(&object, keys::FREQUENCY);
            object.text("name");
            let estimate = object.truth("estimate").unwrap_or(false);
            let hertz = own_unit("Hz");
            let unit = unit(&object, "unit", "Hz")?;
            if let Some(member) = object.get("unit") {
                same_dimension(&object, member, &unit, &hertz).then_some(())?;
            }
            let values = match (object.get("value"), object.get("values")) {
                (Some(_), Some(second)) => {
                    let diagnostic = DiagnosticKind::Exclusive { first: "value", second: "values" };
                    object.log.report(&second.key_span, diagnostic);
                    return None;
                }
                (Some(_), None) => vec![of_object(&object, "Hz")?.si()],
                (None, Some(_)) => {
                    object.numbers("values")?.iter().map(|v| unit.to_si(*v)).collect()
                }
                (None, None) if estimate => {
                    let frequency =
                        Frequency { hertz: None, standard_uncertainty: 0.0, estimate: true };
                    return Some(vec![frequency]);
                }
                (None, None) => {
                    object.required("value")?;
                    return None;
                }
            };
            let standard_uncertainty = unit.to_si(uncertainty(&object)?);
            values
                .into_iter()
                .map(|hertz| Frequency { hertz: Some(hertz), standard_uncertainty, estimate })
                .collect()
        }
    };
    let wrong = list.iter().filter_map(|frequency| frequency.hertz).find(|hertz| *hertz <= 0.0);
    if let Some(found) = wrong {
        let key = "frequency".to_owned();
        object.log.report(&member.value.span, DiagnosticKind::NotPositive { key, found });
        return None;
    }
    if list.is_empty() {
        object.log.report(&member.key_span, DiagnosticKind::NoValues { name: "frequency".into() });
        return None;
    }
    Some(list)
}
