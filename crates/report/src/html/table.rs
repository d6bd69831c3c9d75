//! Tables of a page.

use maud::{Markup, html};

use super::raised;
use crate::number::align;
use crate::sheet::{Column, Kind, Sheet};

/// Rows up to which a table is kept on one printed page.
const UNBROKEN: usize = 12;

/// A table; numbers are padded so that their decimal points stand under each other.
pub(crate) fn table(sheet: &Sheet) -> Markup {
    let class = |column: &Column| column.is_numeric().then_some("number");
    let columns: Vec<Vec<String>> = sheet
        .columns
        .iter()
        .map(
            |column| if column.is_numeric() { padded(&column.cells) } else { column.cells.clone() },
        )
        .collect();
    let is_total = |row: usize| sheet.footer && row + 1 == sheet.rows();
    let class_of_table = if sheet.rows() > UNBROKEN { "table long" } else { "table" };
    html! {
        div class=(class_of_table) {
            table {
                @if sheet.has_headers() {
                    thead {
                        tr {
                            @for column in &sheet.columns {
                                th class=[class(column)] { (column.title()) }
                            }
                        }
                    }
                }
                tbody {
                    @for row in 0..sheet.rows() {
                        tr class=[is_total(row).then_some("total")] {
                            @for (column, cells) in sheet.columns.iter().zip(&columns) {
                                @let cell = cells.get(row).map_or("", String::as_str);
                                td class=[class(column)] {
                                    @if column.kind == Kind::Units { (raised(cell)) }
                                    @else { (cell) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Numbers padded with spaces of the width of a digit.
fn padded(cells: &[String]) -> Vec<String> {
    align(cells).into_iter().map(|cell| cell.replace(' ', "\u{2007}")).collect()
}
