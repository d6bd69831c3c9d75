//! Results in one cell: `10.0 V ± 0.2 V (k=2)`, `(10.0 ± 0.2) V`, `10.0(2) V`.

use super::ComparisonReader;
use super::headings::{self, Role};
use super::numbers::Number;
use crate::import::both::sides;
use crate::import::concise::concise;
use crate::import::coverage::HeaderCoverage;
use crate::import::number::number;
use gumption_engine::number::Shortest;
use gumption_text::value_text::PLUS_MINUS;

/// What a cell holds.
#[derive(Clone, Debug, PartialEq)]
struct InOneCell {
    /// The text of the estimate, with its unit.
    estimate: String,
    uncertainty: Uncertainty,
}

#[derive(Clone, Debug, PartialEq)]
enum Uncertainty {
    /// In brackets behind the digits of the estimate, a standard uncertainty (JCGM 100, 7.2.2).
    InDigits(f64),
    /// Behind the sign, as text, with what is said of its coverage.
    BehindSign(String, HeaderCoverage),
}

impl InOneCell {
    /// What a cell holds; `None` where it holds one number or none.
    fn of(text: &str, decimal_comma: bool) -> Option<Self> {
        let text = text.trim();
        if let Some((_, std, _)) = concise(text, decimal_comma) {
            let (digits, rest) = text.split_once('(')?;
            let (_, behind) = rest.split_once(')')?;
            let estimate = format!("{}{behind}", digits.trim_end());
            return Some(Self { estimate, uncertainty: Uncertainty::InDigits(std) });
        }
        if let Some((digits, std, behind)) = in_unit_of_estimate(text, decimal_comma) {
            let estimate = format!("{digits}{behind}");
            return Some(Self { estimate, uncertainty: Uncertainty::InDigits(std) });
        }
        let coverage = HeaderCoverage::of(text);
        let bare = headings::without_coverage(text);
        let enclosed = bare.strip_prefix('(').and_then(|rest| rest.split_once(')'));
        let (inside, unit) = match enclosed {
            Some((inside, unit)) if PLUS_MINUS.iter().any(|sign| inside.contains(sign)) => {
                (inside, unit.trim())
            }
            _ => (bare.as_str(), ""),
        };
        let (estimate, uncertainty) = sides(inside)?;
        let with_unit = |text: &str| format!("{text} {unit}").trim_end().to_owned();
        Some(Self {
            estimate: with_unit(estimate),
            uncertainty: Uncertainty::BehindSign(with_unit(uncertainty), coverage),
        })
    }
}

/// The estimate, its standard uncertainty as a number in the unit of it, and what stands behind:
/// `100.02147(0.00035) g` (JCGM 100, 7.2.2). Without a decimal mark the digits are the last ones.
fn in_unit_of_estimate(text: &str, decimal_comma: bool) -> Option<(&str, f64, &str)> {
    let (digits, rest) = text.split_once('(')?;
    let (inside, behind) = rest.split_once(')')?;
    number(digits, decimal_comma).filter(|_| digits == digits.trim_end())?;
    let std = number(inside, decimal_comma).filter(|_| inside.contains(['.', ',']))?;
    (std >= 0.0 && !inside.contains('%')).then_some((digits, std, behind))
}

/// Whether a cell holds an estimate and its uncertainty.
pub(super) fn is_of_both(text: &str, decimal_comma: bool) -> bool {
    InOneCell::of(text, decimal_comma).is_some()
}

/// Whether the heading of such cells says that their uncertainties are standard ones: `x ± u`.
fn is_of_standard(heading: &str) -> bool {
    let behind = PLUS_MINUS.iter().find_map(|sign| heading.split_once(sign));
    behind.is_some_and(|(_, behind)| headings::name(behind) == "u")
}

impl ComparisonReader<'_> {
    /// Estimate, uncertainty and factor of a cell that holds all of it; `None` after a mistake.
    pub(super) fn in_one_cell(
        &self,
        row: usize,
        of: u8,
        place: usize,
    ) -> Option<(Number, Number, f64)> {
        let text = self.numbers.table.text(row, place);
        let fail = |reason: String| {
            let reason = format!("row {}, column `{}`: {reason}", row + 1, self.heading(place));
            self.fail_at(self.numbers.table.place(row, place), reason);
        };
        let Some(InOneCell { estimate, uncertainty }) =
            InOneCell::of(text, self.numbers.has_commas())
        else {
            // what is no number is told as such
            if self.numbers.number(row, place).is_some() {
                fail(format!(
                    "`{text}` has no uncertainty behind it, as other cells of the column do, and the table has \
                     no column `U` or `u`"
                ));
            }
            return None;
        };
        let mut value = self.in_unit_of(row, place, &estimate)?;
        let heading = self.columns.coverage(place);
        let of_column = match self.columns.place(Role::Factor(of)) {
            Some(k) => Some(self.numbers.bare(row, k)?),
            None => None,
        };
        let (text_of_u, of_cell) = match uncertainty {
            Uncertainty::InDigits(std) => {
                if let Some(k) = of_column.or(heading.factor(None)).filter(|k| *k != 1.0) {
                    fail(format!(
                        "`{text}` states the standard uncertainty {} in brackets, and the table the \
                         coverage factor {}: write value and uncertainty into columns `x` and `u`, or `U`",
                        Shortest(std),
                        Shortest(k)
                    ));
                    return None;
                }
                let own = Number { value: std, printed: std, ..value.clone() };
                return Some((value, own, 1.0));
            }
            Uncertainty::BehindSign(text, coverage) => (text, coverage),
        };
        let own = self.in_unit_of(row, place, &text_of_u)?;
        // `10.0 ± 0.2 V`; per cent may be a share
        if value.unit.is_none() && own.unit.as_ref().is_some_and(|unit| !unit.is_relative()) {
            value.unit.clone_from(&own.unit);
        }
        let standard = is_of_standard(self.heading(place)).then_some(1.0);
        let usual = (HeaderCoverage::Expanded == heading).then_some(super::stated::USUAL_FACTOR);
        let said = [of_cell.factor(None), of_column, heading.factor(None), standard];
        let mut said = said.into_iter().flatten();
        let Some(factor) = said.next().or(usual) else {
            fail(format!(
                "`{text}` can state the standard uncertainty or an expanded one: write the coverage factor \
                 into the heading, `{} (k=2)`, or call the uncertainty `u` or `U` in a column of its own",
                headings::name(self.heading(place))
            ));
            return None;
        };
        if let Some(other) = said.find(|other| super::stated::differs(*other, factor)) {
            fail(format!(
                "`{text}`: its coverage factor is {} in one place and {} in another: which is it?",
                Shortest(factor),
                Shortest(other)
            ));
            return None;
        }
        if factor <= 0.0 {
            fail(format!("the coverage factor is {}, but must be above 0", Shortest(factor)));
            return None;
        }
        Some((value, own, factor))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_that_hold_both() {
        let behind = |text: &str, coverage| Uncertainty::BehindSign(text.to_owned(), coverage);
        let none = HeaderCoverage::None;
        for (cell, estimate, uncertainty) in [
            ("10.0(2)", "10.0", Uncertainty::InDigits(0.2)),
            ("10.0(2) V", "10.0 V", Uncertainty::InDigits(0.2)),
            ("10.00(0.20) V", "10.00 V", Uncertainty::InDigits(0.2)),
            ("10.0 ± 0.2", "10.0", behind("0.2", none)),
            ("10.0 V ± 0.2 mV (k=2)", "10.0 V", behind("0.2 mV", HeaderCoverage::Factor(2.0))),
            ("(10.0 ± 0.2) V", "10.0 V", behind("0.2 V", none)),
            ("(10.0 +/- 0.2) V (k=2)", "10.0 V", behind("0.2 V", HeaderCoverage::Factor(2.0))),
        ] {
            let expected = InOneCell { estimate: estimate.to_owned(), uncertainty };
            assert_eq!(InOneCell::of(cell, false), Some(expected), "{cell}");
        }
        for cell in ["10.0", "± 0.2", "10.0 V", "(10.0)", "", "n/a", "10.0 (k=2)", "10.0 (1.5)"] {
            assert_eq!(InOneCell::of(cell, false), None, "{cell}");
        }
    }
}
