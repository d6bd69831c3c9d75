//! Mistakes as the page underlines them.

use gumption_text::Diagnostics;
use jsonc_parser::ast::Value;
use jsonc_parser::common::Ranged;
use serde_json::{Value as Json, json};

use crate::tree::{self, PathStep};

/// Mistakes that are told, at most: a table of a million faulty cells helps nobody.
const MOST: usize = 100;

/// The mistakes of a text as the page lists and underlines them, for programs that find them
/// elsewhere than in a call of the page.
pub fn mistakes(text: &str, found: &Diagnostics) -> Json {
    list(text, found)
}

/// The mistakes of a text as a list, each with its place in UTF-16 units, as scripts count, and the
/// path of the value that it is about.
pub(crate) fn list(text: &str, found: &Diagnostics) -> Json {
    let bare = text.strip_prefix('\u{feff}').unwrap_or(text);
    let shift = usize::from(bare.len() < text.len());
    let root = tree::parse(bare).ok();
    let mut place = Places { text: bare, byte: 0, units: shift, shift };
    let list = found.0.iter().take(MOST).map(|diagnostic| {
        let (line, column) = diagnostic.position();
        // mistakes of other files have no place in this text
        let own = diagnostic.source.text == bare;
        let span = if own { diagnostic.span.clone() } else { 0..0 };
        let path = root.as_ref().filter(|_| own).map(|root| tree::path_to(root, span.start));
        let path = path.unwrap_or_default();
        let within = root.as_ref().and_then(|root| within(bare, root, &path, &span));
        let [start, end] = [span.start, span.end].map(|byte| place.of(byte));
        json!({
            "severity": "error",
            "message": diagnostic.message(),
            "hint": diagnostic.kind.suggestion(),
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

/// The place within a text in quotes, in UTF-16 units of what stands between them; `None` where that
/// has escapes, or the place lies elsewhere.
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

/// Bytes of a text as UTF-16 units: counted on from the last one where that is possible.
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
