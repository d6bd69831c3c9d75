//! Marks that could group thousands: `10.000` under German headings and `10,000` under English ones, in a
//! sheet that nothing else tells the decimal mark of.

use super::words;

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
    let small = heading.to_lowercase();
    words::of("text:comma-language").any(|word| small.contains(word))
}

/// A cell of a table: where it stands, its text, and whether the table reads it as a number.
pub(crate) struct MarkedCell<'c, P> {
    pub(crate) place: P,
    pub(crate) text: &'c str,
    pub(crate) is_number: bool,
}

/// The first number whose mark may be the decimal one or group thousands, under headings of a language in
/// which it does either and with no other cell that tells; where it stands, and what it can be.
pub(crate) fn doubt<'c, P>(
    headings: impl IntoIterator<Item = &'c str>,
    cells: impl IntoIterator<Item = MarkedCell<'c, P>>,
) -> Option<(P, String)> {
    let grouping = if headings.into_iter().any(is_of_commas) { '.' } else { ',' };
    let mut doubtful = None;
    for MarkedCell { place, text, is_number } in cells {
        match Mark::of(text) {
            Some(Mark::Doubtful(mark)) if mark != grouping => return None,
            Some(Mark::Shown) => return None,
            Some(Mark::Doubtful(_)) if is_number && doubtful.is_none() => {
                doubtful = Some((place, text.trim()));
            }
            _ => {}
        }
    }
    let (place, text) = doubtful?;
    let other = if grouping == '.' { "," } else { "." };
    let reason = format!(
        "`{text}` can be `{}` or `{}`, as no other number of this table shows which decimal mark it has: \
         write one of them",
        text.replace(grouping, other),
        text.replace(grouping, "")
    );
    Some((place, reason))
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
