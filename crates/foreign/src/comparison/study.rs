//! The readings of a gauge study: columns `part`, `operator` and `value`.

use super::numbers::{Number, Numbers};
use gumption_analysis::compare::StudyReading;
use gumption_engine::fact;
use gumption_engine::task::Warning;
use gumption_text::value_text::{ValueOf, bare_number, converted, with_unit};
use gumption_text::{DiagnosticKind, column_heading};
use gumption_units::Unit;

/// Words of the headings of each column.
const WORDS: [(&str, &[&str]); 3] = [
    ("part", &["part", "parts", "sample", "item", "teil", "prüfling", "werkstück"]),
    ("operator", &["operator", "appraiser", "inspector", "operators", "prüfer", "bediener"]),
    ("value", &["value", "x", "reading", "measurement", "result", "messwert", "wert"]),
];

/// Which of the columns a heading names.
fn column(heading: &str) -> Option<usize> {
    let bare = column_heading::bare(heading).trim().to_lowercase();
    WORDS.iter().position(|(_, words)| words.contains(&bare.as_str()))
}

/// Whether a header has the three columns of a study.
pub(super) fn is_header(header: &[String]) -> bool {
    (0..WORDS.len()).all(|wanted| header.iter().any(|cell| column(cell) == Some(wanted)))
}

/// The readings and their unit; `None` after a mistake.
pub(super) fn read(
    numbers: &Numbers<'_>,
    warnings: &mut Vec<Warning>,
) -> Option<(Vec<StudyReading>, String)> {
    let table = numbers.table;
    let headings = table.columns();
    let fail = |reason: String| {
        numbers.log.report_at(table.header(), DiagnosticKind::Table { reason });
    };
    let mut places = [None; WORDS.len()];
    let mut unread: Vec<&str> = Vec::new();
    for (place, heading) in headings.iter().enumerate() {
        match column(heading) {
            None => unread.push(heading),
            Some(wanted) if places[wanted].is_some() => {
                fail(format!("there are two columns for `{}`", WORDS[wanted].0));
                return None;
            }
            Some(wanted) => places[wanted] = Some(place),
        }
    }
    let missing = WORDS.iter().zip(places).find(|(_, place)| place.is_none());
    if let Some(((name, _), _)) = missing {
        fail(format!(
            "a gauge study needs the columns part, operator and value, one line a reading, and `{name}` is \
             not there"
        ));
        return None;
    }
    let [part, operator, value] = places.map(Option::unwrap_or_default);
    let of_heading = column_heading::heading(numbers.log, &headings[value]).map(|(_, unit)| unit);
    if !numbers.has_known_mark(|place| place == value) {
        return None;
    }
    warnings.extend(
        unread.iter().map(|name| Warning::new("", fact!("columns-not-read.one", name = *name))),
    );
    let mut wanted: Option<Option<Unit>> = None;
    let mut readings = Vec::new();
    for row in (0..table.rows()).filter(|row| table.is_whole(*row)) {
        let [part, operator] = [part, operator].map(|place| numbers.name(row, place).trim());
        if part.is_empty() || operator.is_empty() {
            let reason = format!("row {}: every reading has a part and an operator", row + 1);
            numbers.log.report_at(table.place(row, 0), DiagnosticKind::Table { reason });
            continue;
        }
        let Some(Number { value: found, unit, .. }) = numbers.number(row, value) else { continue };
        let unit = unit.or(of_heading.clone());
        // all in the unit of the first one
        let first = wanted.get_or_insert_with(|| unit.clone());
        let in_unit = match (&unit, &*first) {
            (Some(unit), Some(first)) => Unit::convert(found, unit, first).ok(),
            (None, None) => Some(found),
            _ => None,
        };
        let Some(in_unit) = in_unit else {
            let others = first.as_ref().map_or("which have none", Unit::text);
            let reason =
                format!("row {}: the reading is not in the unit of the others, {others}", row + 1);
            numbers.log.report_at(table.place(row, value), DiagnosticKind::Table { reason });
            continue;
        };
        let [part, operator] = [part, operator].map(str::to_owned);
        readings.push(StudyReading { part, operator, value: in_unit });
    }
    Some((readings, wanted.flatten().map(|unit| unit.to_string()).unwrap_or_default()))
}

/// A limit of the tolerance, from a text such as `4.2` or `4.2 mm`, in `unit`, that of the readings.
///
/// # Errors
/// What is wrong, as a sentence that begins with the option.
pub fn limit_of(
    option: &str,
    text: Option<&str>,
    unit: Option<&Unit>,
) -> Result<Option<f64>, String> {
    let Some(text) = text else { return Ok(None) };
    let found = match (bare_number(text), with_unit(text), unit) {
        (Some(value), ..) => Ok(value),
        (None, Some(value), Some(unit)) => converted(value, unit, ValueOf::Quantity, &[]),
        (None, Some(_), None) => Err("the readings have no unit to convert it to".to_owned()),
        (None, None, _) => Err("it is no number".to_owned()),
    };
    found.map(Some).map_err(|reason| format!("`{option} {text}`: {reason}"))
}
