//! Marks that could group thousands: `10.000` under German headings and `10,000` under English ones, in a
//! sheet that nothing else tells the decimal mark of.

use super::Budget;
use super::columns::{Column, Header};
use gumption_columns::separator::Separator;

/// What a number says of the decimal mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mark {
    /// It has one, a point or a comma.
    Shown,
    /// It has a mark before three digits, which it tells: `10.000`.
    Doubtful(char),
}

impl Mark {
    /// That of the number which a cell begins with; `None` where it has no mark.
    fn of(cell: &str) -> Option<Self> {
        let text = cell.trim().trim_start_matches(['±', '+', '-', '−', '–', ' ']);
        let is_part = |c: char| c.is_ascii_digit() || matches!(c, '.' | ',');
        let end = text.find(|c: char| !is_part(c)).unwrap_or(text.len());
        let (number, behind) = text.split_at(end);
        if number.contains(',') && number.contains('.') {
            return Some(Self::Shown);
        }
        let mark = if number.contains(',') { ',' } else { '.' };
        let (whole, fraction) = number.split_once(mark)?;
        // a date, or groups
        if fraction.contains(mark) || whole.is_empty() && fraction.is_empty() {
            return (mark == ',').then_some(Self::Shown);
        }
        let is_group = (1..=3).contains(&whole.len()) && !whole.starts_with('0');
        let is_doubtful =
            is_group && fraction.len() == 3 && !behind.starts_with(['e', 'E', '·', '×', '*']);
        Some(if is_doubtful { Self::Doubtful(mark) } else { Self::Shown })
    }
}

/// Whether a heading is a German or French one, in whose tables points may group thousands.
fn is_of_commas(heading: &str) -> bool {
    const WORDS: [&str; 16] = [
        "größe",
        "groesse",
        "wert",
        "einheit",
        "unsicherheit",
        "verteilung",
        "teiler",
        "breite",
        "beitrag",
        "freiheitsgrad",
        "koeffizient",
        "quelle",
        "bezeichnung",
        "grandeur",
        "incertitude",
        "unité",
    ];
    let small = heading.to_lowercase();
    WORDS.iter().any(|word| small.contains(word))
}

impl Budget<'_> {
    /// Whether the decimal mark of the numbers is known; otherwise after a mistake.
    pub(super) fn has_known_mark(&self, header: &Header) -> bool {
        if self.cells.separator() == Some(Separator::Comma) {
            return true;
        }
        let headings = header.columns.iter().map(|(place, _)| header.heading(*place));
        let grouping = if headings.into_iter().any(is_of_commas) { '.' } else { ',' };
        let mut doubtful = None;
        for line in 0..self.cells.lines() {
            for (place, cell) in self.cells.row(line).iter().enumerate() {
                let mark = Mark::of(cell).filter(|_| self.cells.is_written(line, place));
                match mark {
                    Some(Mark::Doubtful(mark)) if mark != grouping => return true,
                    Some(Mark::Shown) => return true,
                    Some(Mark::Doubtful(_)) if doubtful.is_none() => {
                        let is_number = |(of, column): &(usize, Column)| {
                            *of == place && *column != Column::Quantity && *column != Column::Symbol
                        };
                        let is_one = header.columns.iter().any(is_number) && line > header.line;
                        doubtful = is_one.then_some((line, cell));
                    }
                    _ => {}
                }
            }
        }
        let Some((line, cell)) = doubtful else { return true };
        let cell = cell.trim();
        let other = if grouping == '.' { "," } else { "." };
        let reason = format!(
            "`{cell}` can be `{}` or `{}`, as no other number of this sheet shows which decimal mark it \
             has: write one of them",
            cell.replace(grouping, other),
            cell.replace(grouping, "")
        );
        self.fail(line, reason);
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_of_numbers() {
        for (text, mark) in [
            ("10.000", Some(Mark::Doubtful('.'))),
            ("±1.500 V", Some(Mark::Doubtful('.'))),
            ("0.005", Some(Mark::Shown)),
            ("1234.567", Some(Mark::Shown)),
            ("1.5", Some(Mark::Shown)),
            ("1,500", Some(Mark::Doubtful(','))),
            ("1,500.5", Some(Mark::Shown)),
            ("0,500", Some(Mark::Shown)),
            ("1.000e3", Some(Mark::Shown)),
            ("10", None),
            ("12.03.2026", None),
            ("Normal", None),
        ] {
            assert_eq!(Mark::of(text), mark, "{text}");
        }
    }
}
