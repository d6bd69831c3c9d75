//! Tables of a page.

use maud::{Markup, html};

use super::{mathml, raised};
use crate::number::align;
use crate::printed;
use crate::sheet::{ColumnKind, Sheet, SheetColumn};

/// Maximum number of rows of a table that is kept on one printed page.
const UNBROKEN: usize = 12;

/// A table; numbers are padded so that their decimal points are aligned.
pub(crate) fn table(sheet: &Sheet) -> Markup {
    let class = |column: &SheetColumn| column.is_numeric().then_some("number");
    let columns: Vec<Vec<String>> = sheet
        .columns
        .iter()
        .map(
            |column| if column.is_numeric() { padded(&column.cells) } else { column.cells.clone() },
        )
        .collect();
    let is_total = |row: usize| sheet.footer && row + 1 == sheet.rows();
    let class_of_table = match (sheet.rows() > UNBROKEN, sheet.has_headers()) {
        (false, true) => "table",
        (true, true) => "table long",
        // particulars, whose words may break rather than leave a narrow screen
        (false, false) => "table bare",
        (true, false) => "table bare long",
    };
    html! {
        // a table wider than the screen can also be scrolled with keys
        div class=(class_of_table) tabindex="0" {
            table {
                @if sheet.has_headers() {
                    thead {
                        tr {
                            @for column in &sheet.columns {
                                @let title = column.title();
                                @if title.is_empty() {
                                    td {}
                                } @else {
                                    th scope="col" class=[class(column)] { (raised(&title)) }
                                }
                            }
                        }
                    }
                }
                tbody {
                    @for row in 0..sheet.rows() {
                        tr class=[is_total(row).then_some("total")] {
                            @for (place, (column, cells)) in sheet.columns.iter().zip(&columns).enumerate() {
                                @let cell = cells.get(row).map_or("", String::as_str);
                                @let text = match column.kind {
                                    ColumnKind::Units => raised(cell),
                                    ColumnKind::Equations => mathml::equation(cell),
                                    ColumnKind::Text | ColumnKind::Numbers => html! { (cell) },
                                };
                                @if place == 0 && sheet.columns.len() > 1 && !cell.is_empty() {
                                    th scope="row" class=[class(column)] { (text) }
                                } @else {
                                    td class=[class(column)] { (text) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Numbers padded with spaces of the width of a digit, and of a point for numbers without one.
fn padded(cells: &[String]) -> Vec<String> {
    let cells: Vec<String> = cells.iter().map(|cell| printed::text(cell)).collect();
    let has_points = cells.iter().any(|cell| cell.contains('.'));
    let pad = |cell: String| {
        let end = cell.trim_end_matches(' ').len();
        let (number, behind) = cell.split_at(end);
        let words = number.trim_start_matches(' ');
        let before = "\u{2007}".repeat(number.len() - words.len());
        let whole = has_points && !number.contains('.');
        let point = if whole && !behind.is_empty() { "\u{2008}" } else { "" };
        let digits = behind.len() - usize::from(!point.is_empty());
        before + words + point + &"\u{2007}".repeat(digits)
    };
    align(&cells).into_iter().map(pad).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_stand_under_each_other() {
        let cells = ["1203", "4.25", "-0.5", "-"].map(str::to_owned);
        let wanted = [
            "1203\u{2008}\u{2007}\u{2007}",
            "\u{2007}\u{2007}\u{2007}4.25",
            "\u{2007}\u{2007}-0.5\u{2007}",
        ];
        assert_eq!(padded(&cells)[..3], wanted);
    }
}
