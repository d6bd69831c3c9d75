//! Numbers for people: how many digits a standard uncertainty deserves, an estimate rounded to
//! match, and decimal points that stand under each other (JCGM 100, 7.2.6).
//!
//! All rounding is done on the exact decimal expansion of the number, half to even, and the decimal
//! place is decided after rounding: 9.96 with two digits is 10, so its place is that of the units.

/// What is printed where there is no number.
pub const MISSING: &str = "-";

/// Digits of which an `f64` holds every one.
const MOST_DIGITS: i32 = 15;

/// Significant digits of a number that is known exactly; more would show binary rounding.
const EXACT_DIGITS: usize = 12;

/// Leading digits at these powers of ten and between are written without an exponent.
const PLAIN: std::ops::RangeInclusive<i32> = -5..=6;

/// A zero is written with this many decimals at most.
const ZERO_DECIMALS: i32 = 8;

/// The power of ten of the last of `digits` significant digits of a value, after rounding to them:
/// -3 for 0.0123 with two digits. `None` for zero and for what is not finite.
///
/// ```
/// use gumption_report::number::place;
///
/// assert_eq!(place(9.94, 2), Some(-1)); // 9.9
/// assert_eq!(place(9.96, 2), Some(0)); // 10
/// assert_eq!(place(1234.0, 2), Some(2)); // 1200
/// ```
pub fn place(value: f64, digits: u32) -> Option<i32> {
    if value == 0.0 || !value.is_finite() {
        return None;
    }
    let digits = digits.clamp(1, MOST_DIGITS.unsigned_abs());
    let (_, exponent) = scientific(value, digits as usize);
    Some(exponent - digits as i32 + 1)
}

/// The place that two demands allow: the coarser one, or the only one there is.
pub fn coarser(a: Option<i32>, b: Option<i32>) -> Option<i32> {
    a.max(b)
}

/// A value rounded to a decimal place, the power of ten of its last digit.
///
/// ```
/// use gumption_report::number::rounded;
///
/// assert_eq!(rounded(8.191_52, -4), "8.1915");
/// assert_eq!(rounded(56_789.0, 2), "56800");
/// assert_eq!(rounded(1.234e-7, -10), "1.234e-7");
/// ```
pub fn rounded(value: f64, place: i32) -> String {
    if !value.is_finite() {
        return MISSING.to_owned();
    }
    let zero = || {
        if (-ZERO_DECIMALS..0).contains(&place) {
            format!("0.{}", "0".repeat(place.unsigned_abs() as usize))
        } else {
            "0".to_owned()
        }
    };
    if value == 0.0 {
        return zero();
    }
    let (_, leading) = scientific(value, MOST_DIGITS as usize);
    let count = leading.saturating_sub(place).saturating_add(1);
    if count < 0 {
        return zero();
    }
    if count == 0 {
        // less than one unit of the last place: up or down to it
        let half: f64 = format!("5e{}", place - 1).parse().unwrap_or(f64::NAN);
        let up = value.abs() > half;
        return if up { layout(value < 0.0, "1", place) } else { zero() };
    }
    let (digits, exponent) = scientific(value, count.min(MOST_DIGITS) as usize);
    // rounding up to a new power of ten leaves one digit too many: 9.96 to one decimal is 10.0
    let digits = if exponent > leading && count < MOST_DIGITS { digits + "0" } else { digits };
    layout(value < 0.0, &digits, exponent)
}

/// A value rounded to a number of significant digits, such as a standard uncertainty.
///
/// ```
/// use gumption_report::number::significant;
///
/// assert_eq!(significant(0.003_456, 2), "0.0035");
/// assert_eq!(significant(1234.0, 2), "1200");
/// assert_eq!(significant(0.0, 2), "0");
/// ```
pub fn significant(value: f64, digits: u32) -> String {
    rounded(value, place(value, digits).unwrap_or(0))
}

/// A number that is known exactly: as many digits as it needs, up to twelve.
pub fn exact(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return rounded(value, 0);
    }
    let (digits, exponent) = scientific(value, EXACT_DIGITS);
    let digits = match digits.trim_end_matches('0') {
        "" => "0",
        digits => digits,
    };
    layout(value < 0.0, digits, exponent)
}

/// A value to a decimal place if there is one, otherwise exactly.
pub fn to(value: f64, place: Option<i32>) -> String {
    place.map_or_else(|| exact(value), |place| rounded(value, place))
}

/// A figure from trials to a decimal place, without the digits that its numerical standard error
/// does not justify: those behind the place of the error's leading digit.
///
/// ```
/// use gumption_report::number::justified;
///
/// assert_eq!(justified(8.191_524, Some(-5), 0.0003), "8.1915");
/// assert_eq!(justified(8.191_524, Some(-2), 0.0003), "8.19");
/// ```
pub fn justified(value: f64, place: Option<i32>, error: f64) -> String {
    to(value, coarser(place, self::place(error, 1)))
}

/// An estimate and its standard uncertainty as a report prints them: the uncertainty to `digits`
/// significant digits, the estimate to the same decimal place (JCGM 100, 7.2.6).
///
/// ```
/// use gumption_report::number::with_uncertainty;
///
/// let (y, u) = with_uncertainty(10.057_62, 0.0996, 2);
/// assert_eq!((y.as_str(), u.as_str()), ("10.06", "0.10"));
/// ```
pub fn with_uncertainty(estimate: f64, uncertainty: f64, digits: u32) -> (String, String) {
    let place = place(uncertainty, digits);
    (to(estimate, place), to(uncertainty, place))
}

/// Pads texts with spaces, so that their decimal points stand under each other and all have the
/// same width.
///
/// ```
/// use gumption_report::number::align;
///
/// assert_eq!(align(&["10.5", "-3", "1e-7"]), ["10.5 ", "-3   ", " 1e-7"]);
/// ```
pub fn align<S: AsRef<str>>(texts: &[S]) -> Vec<String> {
    let split = |text: &S| {
        let text = text.as_ref();
        let whole = text.find(['.', 'e']).unwrap_or(text.len());
        (text[..whole].chars().count(), text[whole..].chars().count())
    };
    let sizes: Vec<(usize, usize)> = texts.iter().map(split).collect();
    let left = sizes.iter().map(|size| size.0).max().unwrap_or(0);
    let right = sizes.iter().map(|size| size.1).max().unwrap_or(0);
    let pad = |(text, (whole, rest)): (&S, &(usize, usize))| {
        format!("{0:1$}{2}{0:3$}", "", left - whole, text.as_ref(), right - rest)
    };
    texts.iter().zip(&sizes).map(pad).collect()
}

/// The modulus of a value in `count` significant digits, and the power of ten of the first.
fn scientific(value: f64, count: usize) -> (String, i32) {
    let text = format!("{:.*e}", count.saturating_sub(1), value.abs());
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    (mantissa.replace('.', ""), exponent.parse().unwrap_or(0))
}

/// Digits of which the first stands at the power of ten `exponent`, in plain decimals where that is
/// readable.
fn layout(negative: bool, digits: &str, exponent: i32) -> String {
    let sign = if negative { "-" } else { "" };
    if !PLAIN.contains(&exponent) {
        let (first, rest) = digits.split_at(1);
        let point = if rest.is_empty() { "" } else { "." };
        return format!("{sign}{first}{point}{rest}e{exponent}");
    }
    if exponent < 0 {
        let zeros = "0".repeat(exponent.unsigned_abs() as usize - 1);
        return format!("{sign}0.{zeros}{digits}");
    }
    let whole = exponent as usize + 1;
    if digits.len() > whole {
        format!("{sign}{}.{}", &digits[..whole], &digits[whole..])
    } else {
        format!("{sign}{digits:0<whole$}")
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn what_is_printed_reads_back_within_half_a_unit(
            value in prop::num::f64::NORMAL,
            digits in 1_u32..9,
        ) {
            let place = place(value, digits).unwrap();
            let read: f64 = significant(value, digits).parse().unwrap();
            let half: f64 = format!("5e{}", place - 1).parse().unwrap();
            prop_assert!((read - value).abs() <= half * (1.0 + 1e-6) || read.is_infinite());
        }

        #[test]
        fn any_place_is_printed(value in any::<f64>(), place in any::<i32>()) {
            let text = rounded(value, place);
            prop_assert!(text == MISSING || text.parse::<f64>().is_ok(), "{}", text);
            prop_assert!(text.len() < 40, "{}", text);
        }

        #[test]
        fn rounding_moves_by_less_than_a_unit(value in -1e6..1e6, place in -6..7) {
            let read: f64 = rounded(value, place).parse().unwrap();
            prop_assert!((read - value).abs() <= 0.5 * 10_f64.powi(place) * (1.0 + 1e-6));
        }
    }

    #[test]
    fn uncertainties_and_estimates_to_match() {
        let pairs = [
            ((10.0, 9.96), ("10", "10")),
            ((1234.5, 99.6), ("1230", "100")),
            ((123_456.0, 999.9), ("123500", "1000")),
            ((0.123_45, 0.0996), ("0.12", "0.10")),
            ((56_789.0, 1234.0), ("56800", "1200")),
            ((-56_789.0, 1234.0), ("-56800", "1200")),
            ((-8.191_52, 0.0123), ("-8.192", "0.012")),
            ((0.0, 0.0123), ("0.000", "0.012")),
            ((1.234_56e-12, 1.2e-14), ("1.235e-12", "1.2e-14")),
            ((1e300, 1.5e298), ("1.000e300", "1.5e298")),
            ((12.0, 0.0), ("12", "0")),
            ((0.1 + 0.2, 0.0), ("0.3", "0")),
            ((9_999_999.6, 0.15), ("9999999.60", "0.15")),
            ((9.996, 0.012), ("9.996", "0.012")),
            ((9.9996, 0.012), ("10.000", "0.012")),
            ((0.3, 4.0), ("0.3", "4.0")),
            ((-0.04, 40.0), ("0", "40")),
            ((60.0, 4000.0), ("100", "4000")),
            ((50.0, 4000.0), ("0", "4000")),
            ((f64::NAN, 0.5), ("-", "0.50")),
            ((1.5, f64::INFINITY), ("1.5", "-")),
        ];
        for ((estimate, uncertainty), (y, u)) in pairs {
            let got = with_uncertainty(estimate, uncertainty, 2);
            assert_eq!(got, (y.to_owned(), u.to_owned()), "{estimate} {uncertainty}");
        }
    }

    #[test]
    fn half_goes_to_even_on_the_exact_expansion() {
        assert_eq!(rounded(0.125, -2), "0.12");
        assert_eq!(rounded(0.375, -2), "0.38");
        // 2.675 is a little less than that in binary, 1.005 as well
        assert_eq!(rounded(2.675, -2), "2.67");
        assert_eq!(rounded(2.5, 0), "2");
        assert_eq!(rounded(0.5, 0), "0");
        assert_eq!(rounded(0.500_001, 0), "1");
        assert_eq!(rounded(-0.6, 0), "-1");
        assert_eq!(rounded(-0.4, 0), "0");
        assert_eq!(rounded(0.04, 0), "0");
    }

    #[test]
    fn extremes_stay_readable() {
        assert_eq!(rounded(1e300, -12), "1.00000000000000e300");
        assert_eq!(rounded(0.0, -12), "0");
        assert_eq!(significant(5e-324, 2), "4.9e-324");
        assert_eq!(significant(f64::MAX, 3), "1.80e308");
        assert_eq!(exact(-1e-5), "-0.00001");
        assert_eq!(exact(-9e-6), "-9e-6");
        assert_eq!(exact(1e7), "1e7");
        assert_eq!(exact(9_999_999.0), "9999999");
        assert_eq!(exact(-0.0), "0");
        assert_eq!(rounded(f64::NEG_INFINITY, -2), "-");
        assert_eq!(place(0.0, 2), None);
        assert_eq!(place(f64::NAN, 2), None);
        assert_eq!(rounded(1.0, i32::MIN), "1.00000000000000");
        assert_eq!(rounded(1.0, i32::MAX), "0");
    }

    #[test]
    fn unjustified_digits_are_dropped() {
        // an error of 0.0996 has its leading digit at 0.1
        assert_eq!(justified(2.345_6, Some(-4), 0.0996), "2.3");
        assert_eq!(justified(2.345_6, Some(-1), 0.0001), "2.3");
        assert_eq!(justified(2.345_6, Some(-2), f64::NAN), "2.35");
        assert_eq!(justified(2.345_6, None, 0.01), "2.35");
        assert_eq!(justified(0.02, Some(-3), 0.6), "0.0");
        assert_eq!(justified(1234.0, Some(0), 30.0), "1230");
    }

    #[test]
    fn points_stand_under_each_other() {
        let texts = ["10.000", "-0.5", "1200", "1.2e-7", "-", "", "∞"];
        let aligned = align(&texts);
        assert!(aligned.iter().all(|text| text.chars().count() == 9), "{aligned:?}");
        insta::assert_snapshot!(aligned.iter().map(|text| format!("|{text}|\n")).collect::<String>(), @r"
            |  10.000 |
            |  -0.5   |
            |1200     |
            |   1.2e-7|
            |   -     |
            |         |
            |   ∞     |
            ");
    }
}
