//! The layout of a sheet besides the values: hidden rows, formulas without calculated values,
//! merged and struck-through cells.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::io::{Cursor, Read};

use quick_xml::events::{BytesStart, Event};
use zip::ZipArchive;

use super::rich::{self, RichTextParts};
use super::{
    COLUMNS, MOST_COLUMNS, MOST_OF_PART, MOST_ROWS, MOST_SHEETS, ROWS, attribute, date, place,
    reference,
};

/// A row and a column, both counted from 0.
pub type Place = (u32, u32);

/// The first of the needed cells, with a sentence that begins with it.
fn first(
    cells: &[Place],
    is_needed: impl Fn(Place) -> bool,
    reason: &str,
) -> Option<(Place, String)> {
    let cell = cells.iter().find(|cell| is_needed(**cell))?;
    Some((*cell, format!("cell {} {reason}", reference(*cell))))
}

/// The layout of a sheet.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Layout {
    /// Rows that are hidden or have no height.
    pub(crate) hidden: BTreeSet<u32>,
    /// Columns that are hidden or have no width.
    pub hidden_columns: BTreeSet<u32>,
    /// Cells whose value is an XML entity, which is not resolved.
    pub(crate) entities: Vec<Place>,
    /// Formulas without a stored value.
    pub(crate) unfilled: Vec<Place>,
    /// Formulas, if the stored value of every one is 0: a program that never calculates stores it.
    pub(crate) zeros: Vec<Place>,
    /// Merged cells, from the first to the last one.
    pub merged: Vec<(Place, Place)>,
    /// Cells with content that is struck through.
    pub struck: BTreeSet<Place>,
    /// Cells with a text; a number in a text has the decimal marks of its writer.
    pub texts: BTreeSet<Place>,
    /// Cells with a raised, lowered or struck-through part, and the message about each.
    pub(crate) rich: BTreeMap<Place, String>,
    /// Cells that display a date or a time, with the displayed text.
    pub dates: BTreeMap<Place, String>,
    /// The power of ten of the last digit that a cell displays, if its format determines it.
    pub last_digits: BTreeMap<Place, i32>,
    /// The first cell beyond those that are read.
    pub beyond: Option<Place>,
}

impl Layout {
    /// The layout of the sheet with this index, from 0; empty if its part is not found.
    pub(super) fn of(parts: &mut PartsOf, sheet: usize) -> Self {
        let text = parts.sheets.get(sheet).cloned().flatten().and_then(|name| parts.part(&name));
        text.map(|text| Self::of_text(&text, &parts.shared)).unwrap_or_default()
    }

    /// Why a cell holds no number although its value is one: it displays a date or a time, or a
    /// part of its text is raised.
    pub fn no_number(&self, cell: Place) -> Option<String> {
        if let Some(reason) = self.rich.get(&cell) {
            return Some(format!("cell {} {reason}", reference(cell)));
        }
        let shown = self.dates.get(&cell)?;
        Some(format!("cell {} {}", reference(cell), date::no_number(shown)))
    }

    /// How a row with a struck-through cell or a hidden row is withdrawn, and how to undo that.
    pub fn withdrawn(&self, row: u32, is_struck: bool) -> Option<(&'static str, &'static str)> {
        if self.hidden.contains(&row) {
            Some(("hidden", "show it"))
        } else if is_struck {
            Some(("struck through", "remove the strikethrough"))
        } else {
            None
        }
    }

    /// Checks that all rows of a table are visible and not struck through, and that all formulas
    /// are calculated.
    ///
    /// # Errors
    /// A sentence about the first problem.
    pub(super) fn check_shown<'r>(
        &self,
        rows: impl Iterator<Item = &'r u32>,
    ) -> Result<(), String> {
        let rows: BTreeSet<u32> = rows.copied().collect();
        let is_zero = self.uncalculated(|(row, _)| rows.contains(&row));
        let without = self.without_values(|_| true).into_iter().chain(is_zero).next();
        if let Some((_, reason)) = without {
            return Err(format!("its {reason}"));
        }
        let struck: BTreeSet<u32> = self.struck.iter().map(|(row, _)| *row).collect();
        let withdrawn = |row: &u32| Some((*row, self.withdrawn(*row, struck.contains(row))?));
        match rows.iter().find_map(withdrawn) {
            Some((row, (how, undo))) => {
                Err(format!("its row {} is {how}: {undo}, or delete it", row + 1))
            }
            None => Ok(()),
        }
    }

    /// The first needed cell that is a formula without a stored value, and the first one with an
    /// entity, each with advice.
    pub fn without_values(
        &self,
        is_needed: impl Fn(Place) -> bool,
    ) -> impl IntoIterator<Item = (Place, String)> {
        let kinds = [
            (
                &self.unfilled,
                "is a formula without a stored value; open and save the workbook in a spreadsheet \
                 program",
            ),
            (&self.entities, "holds an XML entity instead of a number; write the number"),
        ];
        kinds.map(|(cells, reason)| first(cells, &is_needed, reason)).into_iter().flatten()
    }

    /// The first needed cell that is a formula, if the stored value of all formulas is 0, with
    /// advice.
    pub fn uncalculated(&self, is_needed: impl Fn(Place) -> bool) -> Option<(Place, String)> {
        let reason = "is a formula with the stored value 0, like every other formula, so the \
                      workbook was probably never calculated; open and save it in a spreadsheet \
                      program, or write \
            0 in place of the formula";
        first(&self.zeros, is_needed, reason)
    }

    /// Reads the XML of a sheet, given the doubts about the shared texts.
    fn of_text(text: &str, shared: &[Option<String>]) -> Self {
        let mut found = Self::default();
        let mut xml = quick_xml::Reader::from_str(text);
        // the next row and column, from 1
        let (mut row, mut column) = (0, 0);
        let (mut is_formula, mut has_value, mut in_value) = (false, false, false);
        let (mut value, mut has_other) = (String::new(), false);
        let (mut parts, mut is_shared) = (RichTextParts::default(), false);
        loop {
            let event = match xml.read_event() {
                Ok(Event::Eof) | Err(_) => break,
                Ok(event) => event,
            };
            let is_empty = matches!(event, Event::Empty(_));
            parts.take(&event);
            match event {
                Event::Start(element) | Event::Empty(element) => {
                    match element.local_name().as_ref() {
                        "row" => {
                            let own = attribute(&element, "r").and_then(|r| r.parse().ok());
                            row = own.unwrap_or(row + 1_u32).min(ROWS);
                            column = 0;
                            if is_hidden(&element) && row > 0 {
                                found.hidden.insert(row - 1);
                            }
                        }
                        "col" => found.hidden_columns.extend(hidden_columns(&element)),
                        "c" => {
                            value.clear();
                            let own = attribute(&element, "r").and_then(|r| place(&r));
                            (column, row) = own.unwrap_or(((column + 1).min(COLUMNS), row.max(1)));
                            parts = RichTextParts::default();
                            is_shared = attribute(&element, "t").is_some_and(|kind| kind == "s");
                            is_formula = false;
                            // a formula may give an empty text
                            has_value = attribute(&element, "t").is_some_and(|kind| kind == "str");
                        }
                        "f" => is_formula = true,
                        "v" | "is" => in_value = !is_empty,
                        "mergeCell" => {
                            let range = attribute(&element, "ref").unwrap_or_default();
                            let ends = range.split_once(':');
                            let ends = ends.and_then(|(a, b)| place(a).zip(place(b)));
                            // more columns than a table can have
                            let is_full = found.merged.len() >= MOST_ROWS as usize;
                            let ends = ends.filter(|_| !is_full);
                            found.merged.extend(ends.map(|(a, b)| (from_zero(a), from_zero(b))));
                        }
                        _ => {}
                    }
                }
                Event::End(element) => match element.local_name().as_ref() {
                    "v" if is_shared => {
                        in_value = false;
                        let doubt =
                            value.trim().parse().ok().and_then(|at: usize| shared.get(at)?.clone());
                        found.rich.extend(doubt.map(|doubt| (from_zero((column, row)), doubt)));
                    }
                    "is" => {
                        in_value = false;
                        let doubt = parts.doubt();
                        found.rich.extend(doubt.map(|doubt| (from_zero((column, row)), doubt)));
                    }
                    "v" => in_value = false,
                    "c" if is_formula && !has_value => {
                        found.unfilled.push(from_zero((column, row)));
                    }
                    "c" if is_formula && value.trim() == "0" => {
                        found.zeros.push(from_zero((column, row)));
                    }
                    "c" if is_formula => has_other = true,
                    _ => {}
                },
                Event::Text(text) if in_value => {
                    has_value = true;
                    value.push_str(&text);
                }
                Event::CData(_) if in_value => has_value = true,
                Event::GeneralRef(of) if in_value => {
                    has_value = true;
                    let is_known = matches!(&*of, "amp" | "lt" | "gt" | "quot" | "apos");
                    if !is_known && !of.is_char_ref() {
                        found.entities.push(from_zero((column, row)));
                    }
                }
                _ => {}
            }
        }
        if has_other {
            found.zeros.clear();
        }
        found
    }
}

/// A column and a row, counted from 1, as a [`Place`].
const fn from_zero((column, row): (u32, u32)) -> Place {
    (row.saturating_sub(1), column.saturating_sub(1))
}

fn is_hidden(row: &BytesStart<'_>) -> bool {
    let is_set = attribute(row, "hidden").is_some_and(|text| matches!(text.as_str(), "1" | "true"));
    is_set || attribute(row, "ht").and_then(|ht| ht.parse().ok()).is_some_and(|ht: f64| ht == 0.0)
}

/// The columns of an element `col`, from 0, if they are hidden; at most as many as a table has.
fn hidden_columns(col: &BytesStart<'_>) -> std::ops::Range<u32> {
    let is_set = attribute(col, "hidden").is_some_and(|text| matches!(text.as_str(), "1" | "true"));
    let number = |name: &str| attribute(col, name).and_then(|text| text.parse::<f64>().ok());
    if !is_set && number("width").is_none_or(|width| width > 0.0) {
        return 0..0;
    }
    let end = |name: &str| number(name).map_or(0, |number| number as u32).min(MOST_COLUMNS);
    end("min").saturating_sub(1)..end("max")
}

/// The parts of a workbook.
pub(super) struct PartsOf {
    archive: ZipArchive<Cursor<Vec<u8>>>,
    /// The part of each sheet, in their order.
    sheets: Vec<Option<String>>,
    /// Doubts about the texts that cells share.
    shared: Vec<Option<String>>,
}

impl PartsOf {
    /// # Errors
    /// The workbook has too many sheets, or two sheets share one part; each is read separately.
    pub(super) fn of(bytes: Vec<u8>) -> Result<Self, String> {
        let archive = ZipArchive::new(Cursor::new(bytes)).map_err(super::is_none)?;
        let mut parts = Self { archive, sheets: Vec::new(), shared: Vec::new() };
        let shared = parts.part("xl/sharedStrings.xml");
        parts.shared = shared.map(|text| rich::shared(&text)).unwrap_or_default();
        parts.sheets = parts.names_of_sheets().unwrap_or_default();
        let count = parts.sheets.len();
        if count > MOST_SHEETS {
            return Err(format!("it has {count} sheets; this version reads at most {MOST_SHEETS}"));
        }
        let mut known: HashMap<String, usize> = HashMap::new();
        for (number, name) in parts.sheets.iter().enumerate() {
            let Some(name) = name else { continue };
            if let Some(first) = known.insert(name.to_lowercase(), number) {
                return Err(format!(
                    "its sheets {} and {} are both the part `{name}`; each sheet needs its own \
                     part",
                    first + 1,
                    number + 1
                ));
            }
        }
        Ok(parts)
    }

    /// The text of the part of that name.
    fn part(&mut self, name: &str) -> Option<String> {
        let is_it = |path: &str| path.replace('\\', "/").eq_ignore_ascii_case(name);
        let at = self
            .archive
            .file_names()
            .position(|file_name| file_name.is_ok_and(|path| is_it(&path)))?;
        let mut text = String::new();
        let part = self.archive.by_index(at).ok()?;
        part.take(MOST_OF_PART).read_to_string(&mut text).ok()?;
        Some(text)
    }

    /// The name of each sheet's part, in the order of the workbook.
    fn names_of_sheets(&mut self) -> Option<Vec<Option<String>>> {
        let book = self.part("xl/workbook.xml")?;
        let is_sheet = |element: &BytesStart<'_>| element.local_name().as_ref() == "sheet";
        let ids = elements(&book, is_sheet, |element| {
            // in whichever namespace
            let mut attributes = element.attributes().flatten();
            let id = attributes.find(|attribute| attribute.key.local_name().as_ref() == "id")?;
            Some(id.value.into_owned())
        });
        let relations = self.part("xl/_rels/workbook.xml.rels")?;
        let all = elements(
            &relations,
            |_| true,
            |element| Some((attribute(element, "Id")?, attribute(element, "Target")?)),
        );
        let mut targets: HashMap<String, String> = HashMap::new();
        for (id, target) in all.into_iter().flatten() {
            targets.entry(id).or_insert(target);
        }
        let name = |id: String| {
            let target = targets.get(&id)?;
            Some(target.strip_prefix('/').map_or_else(|| format!("xl/{target}"), str::to_owned))
        };
        Some(ids.into_iter().map(|id| name(id?)).collect())
    }
}

/// The contents of the wanted elements of an XML document.
fn elements<T>(
    text: &str,
    wanted: impl Fn(&BytesStart<'_>) -> bool,
    of: impl Fn(&BytesStart<'_>) -> T,
) -> Vec<T> {
    let mut xml = quick_xml::Reader::from_str(text);
    let mut found = Vec::new();
    loop {
        match xml.read_event() {
            Ok(Event::Start(element) | Event::Empty(element)) if wanted(&element) => {
                found.push(of(&element));
            }
            Ok(Event::Eof) | Err(_) => return found,
            Ok(_) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hidden_rows_formulas_and_merged_cells() {
        let sheet = r#"<worksheet><sheetData><row r="2" hidden="1"/><row ht="0" customHeight="1">
            <c r="D3"><f>1+1</f></c><c><f>1+1</f><v></v></c></row><row><c r="A4"><f>2</f><v>2</v></c>
            <c t="str"><f>""</f><v/></c><c t="inlineStr"><is><t>a</t></is></c></row></sheetData>
            <mergeCells><mergeCell ref="C2:C5"/></mergeCells></worksheet>"#;
        let found = Layout::of_text(sheet, &[]);
        assert_eq!(found.hidden, BTreeSet::from([1, 2]));
        assert_eq!(found.unfilled, [(2, 3), (2, 4)]);
        assert_eq!(found.merged, [((1, 2), (4, 2))]);
        let cells = r#"<cols><col min="2" max="3" hidden="1"/><col min="5" max="16384" width="9"/></cols>
            <row><c r="A1"><v>&e;</v></c><c><v>&#49;</v></c><c><f>1-1</f><v>0</v></c><c><f>2</f>"#;
        let zeros = Layout::of_text(&format!("{cells}<v>0</v></c></row>"), &[]);
        assert_eq!(zeros.hidden_columns, BTreeSet::from([1, 2]));
        assert_eq!((&*zeros.entities, &*zeros.zeros), (&[(0, 0)][..], &[(0, 2), (0, 3)][..]));
        assert!(Layout::of_text(&format!("{cells}<v>2</v></c></row>"), &[]).zeros.is_empty());
        // for a table only the zeros of its own rows
        let zeros = Layout { entities: Vec::new(), ..zeros };
        let said = zeros.check_shown([0].iter()).unwrap_err();
        assert!(said.starts_with("its cell C1 is a formula with the stored value 0"), "{said}");
        assert_eq!(zeros.check_shown([1, 2].iter()), Ok(()));
        assert_eq!(
            Layout::of_text("<row hidden=\"1\"><c", &[]),
            Layout { hidden: BTreeSet::from([0]), ..Layout::default() }
        );
    }
}
