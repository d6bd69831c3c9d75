//! Errors for the page to underline.

use gumption_engine::model::formula::FormulaError;
use gumption_text::{DiagnosticKind, Diagnostics};
use jsonc_parser::ast::Value;
use jsonc_parser::common::Ranged;
use serde_json::{Value as Json, json};

use crate::tree::{self, PathStep};

/// Maximum number of errors in an answer: a list of a million faulty cells helps nobody.
const MOST: usize = 100;

/// The errors of a text in the form of the page, for programs that find errors outside a call of
/// the page.
pub fn mistakes(text: &str, found: &Diagnostics) -> Json {
    list(text, found)
}

/// The errors of a text as a list, each with its position in UTF-16 units, as scripts count, and
/// the path of its value.
pub(crate) fn list(text: &str, found: &Diagnostics) -> Json {
    let bare = text.strip_prefix('\u{feff}').unwrap_or(text);
    let shift = usize::from(bare.len() < text.len());
    let root = tree::parse(bare).ok();
    let mut place = Places { text: bare, byte: 0, units: shift, shift };
    let list = found.0.iter().take(MOST).map(|diagnostic| {
        let (line, column) = diagnostic.position();
        // errors in other files have no position in this text
        let own = diagnostic.source.text == bare;
        let span = if own { diagnostic.span.clone() } else { 0..0 };
        let path = root.as_ref().filter(|_| own).map(|root| tree::path_to(root, span.start));
        let path = path.unwrap_or_default();
        let within = root.as_ref().and_then(|root| within(bare, root, &path, &span));
        let [start, end] = [span.start, span.end].map(|byte| place.of(byte));
        json!({
            "severity": "error",
            "isOfUnits": is_of_units(&diagnostic.kind),
            "message": diagnostic.message(),
            "hint": diagnostic.kind.suggestion(),
            "unit": unit(&diagnostic.kind),
            "file": (!own).then(|| diagnostic.source.name.clone()),
            "line": line,
            "column": column,
            "start": start,
            "end": end,
            "path": path,
            "within": within,
        })
    });
    let list: Vec<Json> = list.collect();
    Json::Array(list)
}

/// Whether another unit of a quantity could take the error away.
fn is_of_units(kind: &DiagnosticKind) -> bool {
    match kind {
        DiagnosticKind::WrongDimension { .. } => true,
        DiagnosticKind::Formula { error } => matches!(
            error,
            FormulaError::MixedDimensions { .. }
                | FormulaError::ArgumentNotPlain { .. }
                | FormulaError::ExponentNotPlain { .. }
        ),
        _ => false,
    }
}

/// A unit that would be right, of a quantity whose unit is wrong.
fn unit(kind: &DiagnosticKind) -> Option<&str> {
    match kind {
        DiagnosticKind::WrongDimension { expected, .. } => Some(expected),
        _ => None,
    }
}

/// The position within a quoted text, in UTF-16 units of its content; `None` if it has escapes, or
/// if the position lies elsewhere.
fn within(
    text: &str,
    root: &Value<'_>,
    path: &[PathStep],
    span: &std::ops::Range<usize>,
) -> Option<[usize; 2]> {
    let Value::StringLit(found) = tree::at(root, path)? else { return None };
    let (from, to) = (found.start() + 1, found.end().checked_sub(1)?);
    let inside = text.get(from..to)?;
    if inside != found.value || span.start < from || span.end > to {
        return None;
    }
    let units = |to: usize| Some(text.get(from..to)?.encode_utf16().count());
    Some([units(span.start)?, units(span.end)?])
}

/// Converts bytes of a text to UTF-16 units, counting on from the last position if possible.
struct Places<'t> {
    text: &'t str,
    byte: usize,
    units: usize,
    shift: usize,
}

impl Places<'_> {
    fn of(&mut self, byte: usize) -> usize {
        let byte = byte.min(self.text.len());
        if byte < self.byte {
            (self.byte, self.units) = (0, self.shift);
        }
        let between = self.text.get(self.byte..byte).unwrap_or("");
        self.units += between.encode_utf16().count();
        self.byte = byte;
        self.units
    }
}
