//! Dates as values: each becomes the number of days since the day that the file counts from.

use std::borrow::Cow;

use gumption_engine::fact;
use gumption_engine::task::Warning;
use gumption_text::date::Day;
use gumption_text::json::{Json, Node};
use gumption_text::object::Object;
use gumption_text::{Collector, DiagnosticKind};

/// The key at the root of the file that has the day from which dates count.
pub(super) const ORIGIN: &str = "date_origin";

/// What holds values that may be dates.
const HOLDERS: [&str; 3] = ["inputs", "conditions", "fits"];

/// Keys of such values.
const VALUES: [&str; 8] = ["value", "values", "mean", "lower", "upper", "mode", "limits", "origin"];

/// Why a date without a day from which it counts is rejected.
pub(super) fn without_origin() -> String {
    format!(
        "a date is a number of days since another one: add the day from which dates count, such as \
         `\"{ORIGIN}\": \"2020-01-01\"`, at the root of the file"
    )
}

/// Notes the day from which dates count, if the file states one.
pub(super) fn notes(root: &Object<'_>) -> Vec<Warning> {
    let origin = root.text(ORIGIN);
    origin.map(|origin| Warning::new("", fact!("date-origin", origin))).into_iter().collect()
}

/// Puts numbers of days in the place of dates.
pub(super) fn apply(log: &Collector, root: &mut Node) {
    let Json::Object(members) = &mut root.value else { return };
    if let Some(member) = members.iter().find(|member| member.key == ORIGIN) {
        match &member.value.value {
            Json::Text(text) => match Day::parse(text) {
                Some(origin) => log.define_date_origin(origin),
                None => {
                    let kind = DiagnosticKind::NotDate { key: ORIGIN, found: text.clone() };
                    log.report(&member.value.span, kind);
                    return;
                }
            },
            other => {
                let (what, found) = (format!("`{ORIGIN}`"), other.kind());
                let expected = "a day as a text, such as \"2020-01-01\"";
                log.report(&member.value.span, DiagnosticKind::WrongType { what, found, expected });
                return;
            }
        }
    }
    for member in members.iter_mut().filter(|member| HOLDERS.contains(&member.key.as_str())) {
        let is_inputs = member.key == "inputs";
        let Json::Object(quantities) = &mut member.value.value else { continue };
        for quantity in quantities {
            match &mut quantity.value.value {
                // a whole input as a text
                Json::Text(_) if is_inputs => replace(log, &quantity.key, &mut quantity.value),
                _ => within(log, &mut quantity.value),
            }
        }
    }
}

/// A date as a number of days, and any other text as it is.
///
/// # Errors
/// The file states no day from which dates count.
pub(super) fn in_days<'t>(log: &Collector, text: &'t str) -> Result<Cow<'t, str>, String> {
    let Some(day) = Day::parse(text.trim()) else { return Ok(Cow::Borrowed(text)) };
    let origin = log.date_origin().ok_or_else(without_origin)?;
    Ok(Cow::Owned(format!("{} d", day.since(origin))))
}

/// The dates among the values of an object, and of the objects in it.
fn within(log: &Collector, node: &mut Node) {
    match &mut node.value {
        Json::Object(members) => {
            for member in members {
                if VALUES.contains(&member.key.as_str()) {
                    replace(log, &member.key, &mut member.value);
                } else {
                    within(log, &mut member.value);
                }
            }
        }
        Json::List(items) => items.iter_mut().for_each(|item| within(log, item)),
        _ => {}
    }
}

/// A date, or the dates of a list, as numbers of days.
fn replace(log: &Collector, key: &str, node: &mut Node) {
    match &mut node.value {
        Json::List(items) => items.iter_mut().for_each(|item| replace(log, key, item)),
        Json::Text(text) => match in_days(log, text) {
            Ok(Cow::Borrowed(_)) => {}
            Ok(Cow::Owned(days)) => *text = days,
            Err(reason) => {
                let (key, found) = (key.to_owned(), text.clone());
                log.report(&node.span, DiagnosticKind::Value { key, found, reason });
                // one error is enough
                "0 d".clone_into(text);
            }
        },
        _ => {}
    }
}
