//! The columns of a recording, as a recipe names them.

use gumption_columns::recording::ColumnName;
use gumption_text::json::{Json, Member};
use gumption_text::object::whole_number;
use gumption_text::{Collector, DiagnosticKind};

/// A column by its name, or by its number from 1.
pub(super) fn column(log: &Collector, member: &Member) -> Option<ColumnName> {
    match &member.value.value {
        Json::Text(name) => Some(ColumnName::Name(name.clone())),
        Json::Number(text) => match whole_number(text).filter(|n| (1..=100_000).contains(n)) {
            Some(number) => Some(ColumnName::Number(number as usize)),
            None => {
                let (key, found) = (member.key.clone(), text.to_string());
                let diagnostic = DiagnosticKind::NotWhole { key, found, least: 1, most: 100_000 };
                log.report(&member.value.span, diagnostic);
                None
            }
        },
        other => {
            let what = format!("`{}`", member.key);
            let expected = "the name of a column, or its number from 1";
            let diagnostic = DiagnosticKind::WrongType { what, found: other.kind(), expected };
            log.report(&member.value.span, diagnostic);
            None
        }
    }
}
