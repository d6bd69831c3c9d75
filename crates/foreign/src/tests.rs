//! Workbooks that tests write, as those of the reader of sheets.

#[path = "../../text/src/workbook/tests/written.rs"]
mod written;

pub(crate) use written::sheets;

/// A workbook of one sheet; cells as of [`sheets`].
pub(crate) fn styled(rows: &[&[&str]]) -> Vec<u8> {
    sheets(&[("a", false, rows)])
}
