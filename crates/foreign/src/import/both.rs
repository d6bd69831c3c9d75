//! Cells that hold an estimate and its uncertainty, `10.000 V ± 0.002 V (k=2)`.

use super::number::number_with_unit;
use gumption_text::value_text::PLUS_MINUS;

/// What a cell holds before and behind the sign; `None` where it holds one thing.
pub(crate) fn sides(cell: &str) -> Option<(&str, &str)> {
    let (estimate, uncertainty) = PLUS_MINUS.into_iter().find_map(|sign| cell.split_once(sign))?;
    let (estimate, uncertainty) = (estimate.trim(), uncertainty.trim());
    // both: `±` alone begins an uncertainty
    let is_both = number_with_unit(estimate, true).is_some() && !uncertainty.is_empty();
    is_both.then_some((estimate, uncertainty))
}
#[cfg(test)]
mod tests {
    use super::sides;

    #[test]
    fn sides_of_cells() {
        for (cell, found) in [
            ("10 V ± 20 µV", Some(("10 V", "20 µV"))),
            ("10.000 ± 0.002 (k=2)", Some(("10.000", "0.002 (k=2)"))),
            ("-0,5 +/- 0,1", Some(("-0,5", "0,1"))),
            ("3+-1", Some(("3", "1"))),
            ("± 20 µV", None),
            ("+/-3", None),
            ("10 V ±", None),
            ("10 V", None),
            ("the limits ± 3", None),
        ] {
            assert_eq!(sides(cell), found, "{cell}");
        }
    }
}
