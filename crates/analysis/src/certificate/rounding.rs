//! Rounding of what a certificate states: the expanded uncertainty by a named rule, the value to the
//! place of the rounded uncertainty.
//!
//! All rounding is done on twelve significant decimal digits, so that a product that is 0.12 but for
//! its last bit is not rounded up to 0.13; a half goes away from zero.

use crate::certificate::contents::Rounding;

/// Significant digits that a computed figure is held to have.
const DIGITS: usize = 12;

/// EA-4/02 rounds up where rounding to the nearest would take away more than this share.
const EA_LOSS: f64 = 0.05;

/// A rounded figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounded {
    /// The number, nearest to its decimal digits.
    pub value: f64,
    /// The power of ten of its last digit.
    pub place: i32,
}

/// Which way to go from a number that is not one of those allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// To the nearest, a half away from zero.
    Nearest,
    /// Away from minus infinity.
    Up,
    /// Towards minus infinity.
    Down,
}

/// An expanded uncertainty, above 0, rounded to `digits` significant digits by a rule; `None` for zero
/// and for what is not a positive number, which has no place to round to.
///
/// ```
/// use gumption_analysis::certificate::rounding::expanded;
/// use gumption_analysis::certificate::contents::Rounding;
///
/// let round = |value, digits, rule| expanded(value, digits, rule).map(|r| (r.value, r.place));
/// assert_eq!(round(9.96, 2, Rounding::Nearest), Some((10.0, 0)));
/// // 0.349 to 0.3 would lose 14 %
/// assert_eq!(round(0.349, 1, Rounding::Ea), Some((0.4, -1)));
/// assert_eq!(round(0.121, 2, Rounding::Up), Some((0.13, -2)));
/// ```
pub fn expanded(value: f64, digits: u32, rule: Rounding) -> Option<Rounded> {
    if !(value > 0.0 && value.is_finite()) {
        return None;
    }
    let digits = i32::try_from(digits).unwrap_or(2).clamp(1, DIGITS as i32);
    let (_, leading) = decimal(value);
    let to = |direction| {
        let place = leading - digits + 1;
        let rounded = at(value, place, direction);
        // 9.96 becomes 10, whose second digit is that of the units
        let place = if decimal(rounded).1 > leading { place + 1 } else { place };
        Rounded { value: rounded, place }
    };
    let nearest = to(Direction::Nearest);
    Some(match rule {
        Rounding::Nearest => nearest,
        Rounding::Ea if nearest.value >= (1.0 - EA_LOSS) * value => nearest,
        Rounding::Ea | Rounding::Up => to(Direction::Up),
    })
}

/// A number rounded to a place, the power of ten of its last digit.
pub fn at(value: f64, place: i32, direction: Direction) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let (digits, leading) = decimal(value);
    let negative = value < 0.0;
    // digits before the place, and whether there is something behind it
    let kept = leading - place + 1;
    let (kept, behind) = match usize::try_from(kept) {
        Ok(kept) => digits.split_at(kept.min(digits.len())),
        Err(_) => ("", "0"),
    };
    let rest = behind.bytes().any(|digit| digit != b'0') || (leading - place + 1 < 0);
    let away = match direction {
        Direction::Nearest => leading - place + 1 >= 0 && behind.as_bytes().first() >= Some(&b'5'),
        Direction::Up => rest && !negative,
        Direction::Down => rest && negative,
    };
    // digits kept beyond the twelve are zeros
    let missing = usize::try_from(leading - place + 1).unwrap_or(0).saturating_sub(DIGITS);
    let kept: u64 = kept.parse().unwrap_or(0);
    let count = kept + u64::from(away);
    let exponent = place + i32::try_from(missing).unwrap_or(0);
    let rounded: f64 = format!("{count}e{exponent}").parse().unwrap_or(value);
    if negative { -rounded } else { rounded }
}

/// The twelve leading digits of a number, and the power of ten of the first.
fn decimal(value: f64) -> (String, i32) {
    let text = format!("{:.*e}", DIGITS - 1, value.abs());
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    (mantissa.replace('.', ""), exponent.parse().unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use gumption_report::number::rounded;

    fn said(value: f64, digits: u32, rule: Rounding) -> String {
        expanded(value, digits, rule).map_or("-".to_owned(), |r| rounded(r.value, r.place))
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
            // a product that is 0.12 but for its last bit
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

    #[test]
    fn values_go_to_a_place() {
        let cases = [
            (10.057_62, -3, Direction::Nearest, "10.058"),
            (123_456.0, 2, Direction::Nearest, "123500"),
            (-8.191_52, -4, Direction::Nearest, "-8.1915"),
            (2.675, -2, Direction::Nearest, "2.68"),
            (0.4, 0, Direction::Nearest, "0"),
            (0.5, 0, Direction::Nearest, "1"),
            (4.0, 2, Direction::Nearest, "0"),
            (4.0, 2, Direction::Up, "100"),
            (4.0, 1, Direction::Up, "10"),
            (-4.0, 2, Direction::Up, "0"),
            (-4.0, 2, Direction::Down, "-100"),
            (1.21, -1, Direction::Down, "1.2"),
            (1.21, -1, Direction::Up, "1.3"),
            (1.25e9, -8, Direction::Nearest, "1.2500000000000e9"),
            (0.0, -2, Direction::Up, "0.00"),
        ];
        for (value, place, direction, expected) in cases {
            let found = at(value, place, direction);
            let found = if found == 0.0 { 0.0 } else { found };
            let shown = rounded(found, place);
            let same = shown == expected || shown.parse::<f64>().ok() == expected.parse().ok();
            assert!(same, "{value} {place} {direction:?}: {shown}");
        }
    }

    proptest! {
        #[test]
        fn rules_keep_what_they_promise(value in 1e-9..1e9, digits in 1_u32..5) {
            let of = |rule| expanded(value, digits, rule).unwrap().value;
            let unit = 10_f64.powi(expanded(value, digits, Rounding::Up).unwrap().place);
            // twelve digits are held
            let tiny = 1e-11 * value;
            prop_assert!((of(Rounding::Nearest) - value).abs() <= 0.5 * unit + tiny);
            prop_assert!(of(Rounding::Up) >= value - tiny && of(Rounding::Up) <= value + unit + tiny);
            prop_assert!(of(Rounding::Ea) >= 0.95 * value - tiny);
            prop_assert!(of(Rounding::Ea) >= of(Rounding::Nearest));
        }
    }
}
