//! What the pages state of the measurement: its source, its model and the equations.

use super::document::Document;
use super::plain;
use super::sheet::{Kind, Sheet};
use gumption_engine::task::Task;

/// Equations on a page, at most; the rest is in the JSON answer.
const MOST_EQUATIONS: usize = 200;

/// The documents that the measurement and its model follow, as sentences without full stops.
pub(crate) fn sources(task: &Task) -> Vec<String> {
    let mut said = Vec::new();
    let source = plain(&task.source);
    if !source.is_empty() {
        said.push(format!("source: {source}"));
    }
    if let Some(name) = &task.statement.name {
        let of_model = plain(&task.statement.source);
        let of_model = if of_model.is_empty() { of_model } else { format!(": {of_model}") };
        said.push(format!("model {}{of_model}", plain(name)));
    }
    said
}

/// Quantities and their equations as the page shows them.
pub(crate) fn equations(task: &Task) -> Vec<(String, String)> {
    let shown = task.statement.equations.iter().take(MOST_EQUATIONS);
    shown.map(|(name, text)| (plain(name), plain(text))).collect()
}

/// How many equations the page leaves out, in words.
pub(crate) fn left_out(task: &Task) -> Option<String> {
    let more = task.statement.equations.len().saturating_sub(MOST_EQUATIONS);
    (more > 0).then(|| format!("and {more} more equations: --format json"))
}

/// Sources and equations, a line each.
pub(crate) fn lines(task: &Task) -> Vec<String> {
    let equations = equations(task).into_iter().map(|(name, text)| format!("{name} = {text}"));
    sources(task).into_iter().chain(equations).chain(left_out(task)).collect()
}

/// The equations as a table; `None` where there are none.
pub(crate) fn sheet(task: &Task) -> Option<Sheet> {
    let equations = equations(task);
    if equations.is_empty() {
        return None;
    }
    let mut sheet = Sheet::default();
    sheet.text("quantity", equations.iter().map(|(name, _)| name.clone()));
    sheet.push("equation", equations.into_iter().map(|(_, text)| text), Kind::Equations);
    Some(sheet)
}

/// The measurement: its sources and equations.
pub(crate) fn section(document: &mut Document, task: &Task) {
    let sources = sources(task);
    let equations = sheet(task);
    if sources.is_empty() && equations.is_none() {
        return;
    }
    document.section("Measurement model");
    for said in sources {
        document.sentence(&said);
    }
    equations.into_iter().for_each(|sheet| document.table(sheet));
    left_out(task).into_iter().for_each(|said| document.sentence(&said));
}
