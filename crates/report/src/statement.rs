//! What the pages state of the measurement: its source, its model and the equations.

use super::document::Document;
use super::plain;
use super::sheet::{ColumnKind, Sheet};
use gumption_engine::task::{ModelStatement, Task};

/// Equations on a page, at most; the rest is in the JSON answer.
const MOST_EQUATIONS: usize = 200;

/// The title of the section of a measurement.
pub(crate) const TITLE: &str = "Measurement model";

/// What is stated of a measurement.
#[derive(Clone, Copy)]
pub(crate) struct Measurement<'a> {
    /// The document that the measurement follows; empty if none.
    pub(crate) source: &'a str,
    /// Its model.
    pub(crate) model: &'a ModelStatement,
}

impl<'a> From<&'a Task> for Measurement<'a> {
    fn from(task: &'a Task) -> Self {
        Self { source: &task.source, model: &task.statement }
    }
}

/// The documents that the measurement and its model follow, as sentences without full stops.
pub(crate) fn sources(of: Measurement<'_>) -> Vec<String> {
    let mut said = Vec::new();
    let source = plain(of.source);
    if !source.is_empty() {
        said.push(format!("source: {source}"));
    }
    if let Some(name) = &of.model.name {
        let of_model = plain(&of.model.source);
        let of_model = if of_model.is_empty() { of_model } else { format!(": {of_model}") };
        said.push(format!("model {}{of_model}", plain(name)));
    }
    said
}

/// Quantities and their equations as the page shows them.
pub(crate) fn equations(of: Measurement<'_>) -> Vec<(String, String)> {
    let shown = of.model.equations.iter().take(MOST_EQUATIONS);
    shown.map(|(name, text)| (plain(name), plain(text))).collect()
}

/// How many equations the page leaves out, in words.
pub(crate) fn left_out(of: Measurement<'_>) -> Option<String> {
    let more = of.model.equations.len().saturating_sub(MOST_EQUATIONS);
    (more > 0).then(|| format!("and {more} more equations: --format json"))
}

/// Sources and equations, a line each.
pub(crate) fn lines(of: Measurement<'_>) -> Vec<String> {
    let equations = equations(of).into_iter().map(|(name, text)| format!("{name} = {text}"));
    sources(of).into_iter().chain(equations).chain(left_out(of)).collect()
}

/// The equations as a table; `None` where there are none.
pub(crate) fn sheet(of: Measurement<'_>) -> Option<Sheet> {
    let equations = equations(of);
    if equations.is_empty() {
        return None;
    }
    let mut sheet = Sheet::default();
    sheet.text("quantity", equations.iter().map(|(name, _)| name.clone()));
    sheet.push("equation", equations.into_iter().map(|(_, text)| text), ColumnKind::Equations);
    Some(sheet)
}

/// The measurement under a title: its sources and equations.
pub(crate) fn section(document: &mut Document, title: &str, of: Measurement<'_>) {
    let sources = sources(of);
    let equations = sheet(of);
    if sources.is_empty() && equations.is_none() {
        return;
    }
    document.section(title);
    for said in sources {
        document.sentence(&said);
    }
    equations.into_iter().for_each(|sheet| document.table(sheet));
    left_out(of).into_iter().for_each(|said| document.sentence(&said));
}
