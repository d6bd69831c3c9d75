//! Chooses the sheet of a workbook to read: the visible one with the wanted content.

use super::{Book, SheetName};
use crate::DiagnosticKind;
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};

/// What a sheet must contain, in words.
#[derive(Debug)]
pub struct Wanted {
    /// With its article: `a budget`.
    pub a: &'static str,
    /// One of several: `one budget`.
    pub one: &'static str,
    /// Whether the command has an option for the sheet's name.
    pub has_option: bool,
}

/// The sheet of this name, or else the visible sheet with the wanted content, or else the first
/// visible one. The second result is a sentence that says which of several sheets it is.
pub fn of<T>(
    book: &mut Book,
    name: Option<&str>,
    wanted: &Wanted,
    mut read: impl FnMut(&mut Book, &SheetName) -> Result<T, DiagnosticKind>,
    holds: impl Fn(&T) -> bool,
) -> Result<(T, Option<Fact>), DiagnosticKind> {
    let unreadable = |message| DiagnosticKind::Unreadable { message };
    let sheets = book.sheets();
    if let Some(name) = name {
        let Some(sheet) = sheets.iter().find(|sheet| sheet.name == name) else {
            let message =
                format!("it has no sheet `{name}`; its sheets are {}", list(sheets.iter(), "and"));
            return Err(unreadable(message));
        };
        return Ok((read(book, sheet)?, told(sheet, &sheets)));
    }
    let mut first = None;
    let mut found: Vec<(&SheetName, T)> = Vec::new();
    for sheet in sheets.iter().filter(|sheet| !sheet.is_hidden) {
        let chosen = read(book, sheet)?;
        if holds(&chosen) {
            found.push((sheet, chosen));
        } else if first.is_none() {
            first = Some(chosen);
        }
    }
    let Wanted { a, one, has_option } = wanted;
    if found.len() > 1 {
        let say = if *has_option { "choose one with `--sheet NAME`, or " } else { "" };
        let names = list(found.iter().map(|(sheet, _)| *sheet), "and");
        let reason = format!("the sheets {names} hold {a} each: {say}keep {one} in a workbook");
        return Err(DiagnosticKind::Table { reason });
    }
    if found.is_empty() {
        for sheet in sheets.iter().filter(|sheet| sheet.is_hidden) {
            if holds(&read(book, sheet)?) {
                let name = &sheet.name;
                let say = if *has_option { ", or name it with `--sheet`" } else { "" };
                let reason = format!(
                    "no visible sheet holds {a}, but the hidden sheet `{name}` does: show it{say}"
                );
                return Err(DiagnosticKind::Table { reason });
            }
        }
    }
    match found.pop() {
        Some((sheet, chosen)) => Ok((chosen, told(sheet, &sheets))),
        None => first
            .map(|chosen| (chosen, None))
            .ok_or_else(|| unreadable("the workbook has no sheet".to_owned())),
    }
}

/// A sentence that says which of several sheets was read.
fn told(own: &SheetName, sheets: &[SheetName]) -> Option<Fact> {
    let others = sheets.iter().filter(|sheet| *sheet != own);
    let mut others: Vec<Fact> = others
        .map(|SheetName { name, is_hidden, .. }| match is_hidden {
            true => fact!("quoted.hidden", name),
            false => fact!("quoted", name),
        })
        .collect();
    if others.len() > MOST_NAMED {
        let count = others.split_off(MOST_NAMED).len();
        others.push(fact!("more", count));
    }
    (!others.is_empty())
        .then(|| fact!("sheet-chosen", sheet = &own.name, others = Argument::one_of(others)))
}

/// Sheets that a sentence names, at most.
const MOST_NAMED: usize = 10;

/// Names of sheets in a sentence.
fn list<'a>(sheets: impl Iterator<Item = &'a SheetName>, and: &str) -> String {
    let named = |sheet: &SheetName| {
        format!("`{}`{}", sheet.name, if sheet.is_hidden { " (hidden)" } else { "" })
    };
    let mut names: Vec<String> = sheets.map(named).collect();
    if names.len() > MOST_NAMED {
        let rest = names.split_off(MOST_NAMED).len();
        names.push(format!("{rest} more"));
    }
    gumption_units::listed(&names, &format!(" {and} "))
}
