//! Rounding of stated results: the expanded uncertainty by a named rule. The digits are those of
//! [`gumption_engine::decimal`], so that `0.4 * 0.3`, which differs from 0.12 only in its last bit,
//! is not rounded up to 0.13.

use crate::certificate::contents::Rounding;
use gumption_engine::decimal::{Decimal, Direction};

/// EA-4/02 requires rounding up if rounding to nearest reduces U by more than this fraction.
const EA_LOSS: f64 = 0.05;

/// An expanded uncertainty, above 0, rounded to `digits` significant digits by a rule; `None` for a
/// value that is not positive, which has no significant digits.
///
/// ```
/// use gumption_analysis::certificate::rounding::expanded;
/// use gumption_analysis::certificate::contents::Rounding;
///
/// let round = |value, digits, rule| expanded(value, digits, rule).map(|r| r.to_string());
/// assert_eq!(round(9.96, 2, Rounding::Nearest).as_deref(), Some("10"));
/// // 0.349 to 0.3 would lose 14 %
/// assert_eq!(round(0.349, 1, Rounding::Ea).as_deref(), Some("0.4"));
/// assert_eq!(round(0.121, 2, Rounding::Up).as_deref(), Some("0.13"));
/// ```
pub fn expanded(value: f64, digits: u32, rule: Rounding) -> Option<Decimal> {
    let exact = Decimal::shortest(value).filter(|_| value > 0.0)?;
    let to = |direction| exact.round_to_digits(digits, direction);
    let nearest = to(Direction::Nearest);
    Some(match rule {
        Rounding::Nearest => nearest,
        Rounding::Ea if !takes_away_too_much(value, nearest) => nearest,
        Rounding::Ea | Rounding::Up => to(Direction::Up),
    })
}

/// Whether rounding reduces an expanded uncertainty by more than EA-4/02 M:2022, 6.3, allows.
pub fn takes_away_too_much(value: f64, rounded: Decimal) -> bool {
    rounded.value() < (1.0 - EA_LOSS) * value
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn said(value: f64, digits: u32, rule: Rounding) -> String {
        expanded(value, digits, rule).map_or("-".to_owned(), |r| r.to_string())
    }

    #[test]
    fn the_hard_ones() {
        use Rounding::{Ea, Nearest, Up};
        let cases = [
            (9.96, 2, Nearest, "10"),
            (99.6, 2, Nearest, "100"),
            (999.9, 2, Nearest, "1000"),
            (999.9, 1, Nearest, "1000"),
            (1234.0, 2, Nearest, "1200"),
            (1250.0, 2, Nearest, "1300"),
            (1234.0, 2, Up, "1300"),
            (0.0996, 2, Nearest, "0.10"),
            (0.125, 2, Nearest, "0.13"),
            // a product that differs from 0.12 only in its last bit
            (0.4 * 0.3, 2, Up, "0.12"),
            (0.12, 2, Up, "0.12"),
            (0.120_000_1, 2, Up, "0.13"),
            (9.91, 2, Up, "10"),
            // EA-4/02: with one digit 0.349 to 0.3 loses 14 %, 0.52 to 0.5 loses 3.8 %
            (0.349, 1, Ea, "0.4"),
            (0.52, 1, Ea, "0.5"),
            (0.53, 1, Ea, "0.6"),
            (1.04, 1, Ea, "1"),
            // with two digits the loss is below 5 %: the worst is 1.05 to 1.0, which is a half
            (1.049, 2, Ea, "1.0"),
            (9.96, 2, Ea, "10"),
            (0.0, 2, Nearest, "-"),
            (f64::INFINITY, 2, Up, "-"),
            (f64::NAN, 2, Up, "-"),
            (-1.0, 2, Nearest, "-"),
            (1e-300, 2, Nearest, "1.0e-300"),
        ];
        for (value, digits, rule, expected) in cases {
            assert_eq!(said(value, digits, rule), expected, "{value} {digits} {rule:?}");
        }
    }

    proptest! {
        #[test]
        fn rules_keep_what_they_promise(value in 1e-9..1e9, digits in 1_u32..5) {
            let of = |rule| expanded(value, digits, rule).unwrap().value();
            let unit = 10_f64.powi(expanded(value, digits, Rounding::Up).unwrap().position());
            // twelve digits are held, at least
            let tiny = 1e-11 * value;
            prop_assert!((of(Rounding::Nearest) - value).abs() <= 0.5 * unit + tiny);
            prop_assert!(of(Rounding::Up) >= value - tiny && of(Rounding::Up) <= value + unit + tiny);
            prop_assert!(of(Rounding::Ea) >= 0.95 * value - tiny);
            prop_assert!(of(Rounding::Ea) >= of(Rounding::Nearest));
        }
    }
}
