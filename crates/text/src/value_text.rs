//! Values as people write them: a number with a unit, `"100 ohm"`, `"20 degC"`.

use super::sexagesimal;
pub use gumption_columns::ValueOf;
use gumption_engine::number::Shortest;
use gumption_units::Unit;

/// The number and the unit of a text that is a value with a unit; `None` for anything else, such as
/// a formula.
pub fn with_unit(text: &str) -> Option<(f64, &str)> {
    if let Some((value, "")) = sexagesimal::degrees(text.trim()) {
        return Some((value, "deg"));
    }
    let (value, rest) = number(text.trim()).ok()?;
    let begins_unit = rest.chars().next().is_some_and(|c| {
        c.is_alphanumeric()
            || matches!(c, '%' | '‰' | '°' | '℃' | '℉' | '√' | '\'' | '"' | '′' | '″')
    });
    (value.is_finite() && (begins_unit || is_comma(rest))).then_some((value, rest))
}

/// The number at the start of a term, perhaps with a power of ten as it is printed (`5×10⁻⁴`), and the
/// rest.
///
/// # Errors
/// The term does not begin with a number, as a sentence without a capital.
pub fn number(term: &str) -> Result<(f64, &str), String> {
    let longest = term
        .char_indices()
        .map(|(at, c)| at + c.len_utf8())
        .take_while(|&end| end <= 40)
        .filter_map(|end| {
            let text = term.get(..end)?;
            let plain = !text.chars().any(|c| c.is_alphabetic() && !matches!(c, 'e' | 'E'));
            if plain { Some((text.parse::<f64>().ok()?, end)) } else { None }
        })
        .last();
    let Some((value, end)) = longest else {
        let shown = if term.is_empty() { "an empty term".to_owned() } else { format!("`{term}`") };
        return Err(format!("{shown} does not begin with a number"));
    };
    let (mantissa, rest) = term.split_at(end);
    if let Some((power, after)) = times_power_of_ten(rest).filter(|(_, after)| {
        // `5*10^-4` alone is a product in a formula
        !rest.trim_start().starts_with('*') || after.trim_start().starts_with(char::is_alphabetic)
    }) && let Ok(value) = format!("{mantissa}e{power}").parse()
    {
        return Ok((value, after.trim()));
    }
    Ok((value, rest.trim()))
}

/// The number of a text that contains nothing else. Its unit is that of the quantity, as without
/// the quotation marks.
pub fn bare_number(text: &str) -> Option<f64> {
    let (value, rest) = number(text.trim()).ok()?;
    (rest.is_empty() && value.is_finite()).then_some(value)
}

/// Whether a text is a value, that is a number with or without a unit, and not a formula.
pub fn is_value(text: &str) -> bool {
    with_unit(text).is_some() || bare_number(text).is_some()
}

/// A number with a decimal comma, rewritten with a point; `None` if the text is not such a number.
pub fn with_point(text: &str) -> Option<String> {
    let point = text.replacen(',', ".", 1);
    (point != text && point.parse::<f64>().is_ok()).then_some(point)
}

/// Whether the rest of a number begins with a decimal comma.
pub fn is_comma(rest: &str) -> bool {
    let digits = rest.strip_prefix(',');
    digits.is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
}

/// The message about a number with a comma and digits: a decimal fraction, or digits in groups of
/// three.
pub fn decimal_comma(whole: f64, rest: &str) -> String {
    let digits: String = rest.chars().skip(1).take_while(char::is_ascii_digit).collect();
    let whole = Shortest(whole);
    if digits.len() == 3 {
        format!(
            "`{whole},{digits}` can be {whole}.{digits} or {whole}{digits}; write a decimal \
             fraction with a point, and do not group digits"
        )
    } else {
        format!("write a decimal fraction with a point, such as `{whole}.{digits}`")
    }
}

/// The ways to write the sign before an uncertainty; the first one is understood everywhere.
pub const PLUS_MINUS: [&str; 3] = ["±", "+/-", "+-"];

/// A text with `±` instead of the other ways to write it.
pub fn with_plus_minus(text: &str) -> String {
    let [sign, others @ ..] = PLUS_MINUS;
    others.into_iter().fold(text.to_owned(), |text, other| text.replace(other, sign))
}

/// A text with `e-3` instead of a power of ten after a number or a parenthesis, as in tables of
/// constants and certificates: `1.234(5)×10⁻³ kg`, `(1.234 ± 0.005) × 10^-3 kg`.
pub fn with_exponents(text: &str) -> String {
    let mut written = String::new();
    let mut rest = text;
    while let Some(at) = rest.find(TIMES) {
        let (before, behind) = rest.split_at(at);
        written.push_str(before);
        let mantissa = written.trim_end();
        let is_mantissa =
            mantissa.ends_with(|c: char| c.is_ascii_digit() || matches!(c, '.' | ')'));
        match times_power_of_ten(behind).filter(|_| is_mantissa) {
            Some((power, after)) => {
                written.truncate(mantissa.len());
                written.push_str(&format!("e{power}"));
                rest = after;
            }
            None => {
                let sign = behind.chars().next().map_or(0, char::len_utf8);
                let (sign, after) = behind.split_at(sign);
                written.push_str(sign);
                rest = after;
            }
        }
    }
    written + rest
}

/// Signs of multiplication before a power of ten.
const TIMES: [char; 5] = ['×', '·', '⋅', '*', 'x'];

/// The power of ten by which a text multiplies the number before it, `×10⁻³`, and what follows.
pub(crate) fn times_power_of_ten(text: &str) -> Option<(i32, &str)> {
    power_of_ten(text.trim_start().strip_prefix(TIMES)?.trim_start())
}

/// Raised digits, by their values.
pub const RAISED: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/// The power of `10^-3`, `10^(-3)` or `10⁻³` at the start of a text, and what follows it.
pub fn power_of_ten(text: &str) -> Option<(i32, &str)> {
    let behind = text.strip_prefix("10")?;
    let (is_raised, behind) = match behind.strip_prefix('^') {
        Some(rest) => (false, rest.trim_start()),
        None => (true, behind),
    };
    for (open, close) in [("(", ')'), ("{", '}')] {
        if let Some(inside) = behind.strip_prefix(open).filter(|_| !is_raised) {
            let (power, after) = inside.split_once(close)?;
            return Some((power.trim().replace('−', "-").parse().ok()?, after));
        }
    }
    let mut power = String::new();
    let mut length = 0;
    for sign in behind.chars() {
        let digit = RAISED.chars().position(|raised| raised == sign);
        let plain = match (digit, sign) {
            (Some(digit), _) if is_raised => char::from_digit(digit as u32, 10),
            (None, '⁻') if is_raised && power.is_empty() => Some('-'),
            (None, '-' | '−') if !is_raised && power.is_empty() => Some('-'),
            (None, '+') if !is_raised && power.is_empty() => Some('+'),
            (None, '0'..='9') if !is_raised => Some(sign),
            _ => None,
        };
        let Some(plain) = plain else { break };
        power.push(plain);
        length += sign.len_utf8();
    }
    Some((power.parse().ok()?, behind.get(length..)?))
}

/// The message about a unit that begins with digits, as in `1 234 V` (digits in groups) or
/// `1 1/2 in` (one and a half). A unit may begin with 1/.
pub fn grouped_digits(unit: &str) -> Option<String> {
    // 1'000.5, as in Switzerland
    let group = unit
        .strip_prefix(['\'', '’'])
        .map(|rest| rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit()).len());
    if group == Some(3) {
        return Some(format!(
            "the number is followed by `{unit}`: write digits without thousands separators, such \
             as `1234.5`"
        ));
    }
    let digits = unit.len() - unit.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let below = unit.get(digits..)?.trim_start().strip_prefix('/').map(str::trim_start);
    let is_digit = |below: &str| below.starts_with(|c: char| c.is_ascii_digit());
    if digits > 0 && below.is_some_and(is_digit) {
        return Some(format!(
            "`{unit}` after a number can be a fraction to add or a factor: write a decimal \
             fraction, such as `1.5 in` for one inch and a half"
        ));
    }
    let per = unit.starts_with('1') && digits == 1 && below.is_some();
    (unit.starts_with(|c: char| c.is_ascii_digit()) && !per).then(|| {
        format!(
            "the space is followed by another number (`{unit}`): write digits without spaces, such \
             as `1234.5`"
        )
    })
}

/// The number, alone in parentheses, at the start of a text.
pub(crate) fn number_in_parentheses(text: &str) -> Option<&str> {
    let (inside, _) = text.trim_start().strip_prefix('(')?.split_once(')')?;
    inside.trim().parse::<f64>().is_ok().then_some(inside)
}

/// Whether a unit is followed by another number with a unit, with or without a plus sign:
/// `ft 3 in`, `deg + 30 arcmin`. Text after a multiplication or division sign is part of the unit.
fn is_sum_of_units(text: &str) -> bool {
    let mut words = text.split_whitespace();
    let is_name =
        |word: &str| word.starts_with(char::is_alphabetic) && !word.ends_with(['*', '/', '^']);
    let first = words.next().is_some_and(is_name);
    let mut rest = words.skip_while(|word| *word == "+").peekable();
    let is_number = rest.next().is_some_and(|word| word.parse::<f64>().is_ok());
    first && is_number && rest.next().is_some_and(is_name)
}

/// The unit after a number; `own` holds the units that the file defines.
///
/// # Errors
/// Why the text is invalid, as a sentence without a capital.
pub(crate) fn unit_behind_number(text: &str, own: &[Unit]) -> Result<Unit, String> {
    if let Some(digits) = number_in_parentheses(text) {
        return Err(format!(
            "`({digits})` after a number can be an uncertainty or a factor: combine uncertainties \
             and write them once; a unit does not begin with a number"
        ));
    }
    if text.contains('=') {
        return Err(format!(
            "`{text}` is more than a unit: write a coverage factor or probability as the key `k` \
             or `p` next to `expanded`, or the whole input as one text, `\"5.0112 V ± 0.0046 V \
             (k=2)\"`"
        ));
    }
    if sexagesimal::has_minutes(text) {
        return Err(
            "write an angle in degrees, minutes and seconds as `12°30'15.2\"` or `12 deg 30 \
                    arcmin 15.2 arcsec`, with minutes and seconds below 60"
                .to_owned(),
        );
    }
    match grouped_digits(text) {
        Some(reason) => Err(reason),
        None if is_sum_of_units(text) => Err(format!(
            "`{text}` is more than one unit: write a sum of values as a formula, with each unit in \
             brackets, such as `5 [ft] + 3 [in]`"
        )),
        None => Unit::parse_among(text, own).map_err(|error| {
            let error = error.in_whole(text);
            // `28.35*g` for an ounce would follow a number here
            let near = error.suggestions().into_iter().next();
            match near.filter(|unit| unit.starts_with(|c: char| c.is_ascii_digit())) {
                Some(size) => format!(
                    "{error} Define a unit of your own: `\"units\": {{\"{text}\": \
                     \"{size}\"}}` at the root of the file"
                ),
                None => error.to_string(),
            }
        }),
    }
}

/// A number with a unit given as text, converted to another unit. Both may be units that the file
/// defines.
///
/// # Errors
/// Why it cannot be read or converted, as a sentence without a capital.
pub fn converted(
    (value, text): (f64, &str),
    unit: &Unit,
    of: ValueOf,
    own: &[Unit],
) -> Result<f64, String> {
    if is_comma(text) {
        return Err(decimal_comma(value, text));
    }
    // also one that another file defines
    if text == unit.text().trim() && unit.has_name() {
        return Ok(value);
    }
    let given = unit_behind_number(text, own)?;
    if of == ValueOf::Either && !converts_alike(&given, unit) {
        return Err(either_temperature(unit));
    }
    let found = match of {
        ValueOf::Quantity | ValueOf::Either => Unit::convert(value, &given, unit),
        ValueOf::Difference => Unit::conversion_factor(&given, unit).map(|factor| value * factor),
    };
    match found {
        Ok(found) if found.is_finite() => Ok(found),
        Ok(found) => Err(format!("it is {found} in `{unit}`")),
        Err(error) => Err(error.to_string()),
    }
}

/// Whether a quantity and a difference of quantities convert in the same way, or both units are
/// levels with a reference.
pub fn converts_alike(given: &Unit, unit: &Unit) -> bool {
    given.has_zero_of(unit) || given.has_reference() && unit.has_reference()
}

/// The message that a number in a unit with another zero could be converted in two ways.
pub fn either_temperature(unit: &Unit) -> String {
    let (value, difference) = if unit.level_exponent().is_zero() {
        ("a temperature", "a difference of temperatures")
    } else {
        ("a level above a reference", "a difference of levels")
    };
    format!("it can be {value} or {difference}; write it in `{unit}`")
}

/// The power of ten of the last written digit of a number, counting trailing zeros: -3 for `0.100`.
pub fn power_of_last_digit(number: &str) -> i32 {
    let (mantissa, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.trim().len());
    let exponent: i32 = exponent.parse().unwrap_or(0);
    exponent.saturating_sub(i32::try_from(decimals).unwrap_or(i32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, unit: &str, of: ValueOf) -> Result<f64, String> {
        let unit = Unit::parse(unit).unwrap();
        converted(with_unit(text).ok_or("no value with a unit")?, &unit, of, &[])
    }

    #[test]
    fn values_with_units() {
        let value = |text, unit| read(text, unit, ValueOf::Quantity).unwrap();
        assert_eq!(value("100 ohm", "ohm"), 100.0);
        assert_eq!(value("5.1V", "mV"), 5100.0);
        assert_eq!(value("-5 degC", "K"), 268.15);
        assert_eq!(value("300 K", "degC"), 300.0 - 273.15);
        assert_eq!(value("1e-3 m/s^2", "mm/s^2"), 1.0);
        assert_eq!(value("50 %", "1"), 0.5);
        assert_eq!(value("5 1/degC", "1/K"), 5.0);
        assert_eq!(value("30°", "deg"), 30.0);
        assert_eq!(read("2 degC", "K", ValueOf::Difference), Ok(2.0));
        assert_eq!(read("2 degC", "degC", ValueOf::Either), Ok(2.0));
        assert!(read("2 degC", "K", ValueOf::Either).unwrap_err().contains("difference"));
        assert!(read("0.36 degF", "degC", ValueOf::Either).unwrap_err().contains("difference"));
        assert!(read("60 rpm", "Hz", ValueOf::Quantity).unwrap_err().contains("periods"));
        for text in ["1 1/2 in", "5 1/4 in", "3 1 / 8 in", "2 10/16 in"] {
            assert!(
                read(text, "mm", ValueOf::Quantity).unwrap_err().contains("a fraction"),
                "{text}"
            );
        }
        for text in ["5 ft 3 in", "5 ft + 3 in", "3 h + 20 min"] {
            let said = read(text, "m", ValueOf::Quantity).unwrap_err();
            assert!(said.contains("`5 [ft] + 3 [in]`"), "{text}: {said}");
        }
        assert_eq!(read("12°30'", "deg", ValueOf::Quantity), Ok(12.5));
        assert_eq!(read("1°30'", "arcmin", ValueOf::Quantity), Ok(90.0));
        for text in ["12 deg 30 min 15 s", "12°60'", "12° 30"] {
            let said = read(text, "deg", ValueOf::Quantity).unwrap_err();
            assert!(said.contains("12 deg 30 arcmin"), "{text}: {said}");
        }
        assert!(read("5,01 V", "V", ValueOf::Quantity).unwrap_err().contains("point"));
        assert!(read("5 furlong", "m", ValueOf::Quantity).unwrap_err().contains("furlong"));
    }

    #[test]
    fn powers_of_ten_are_exponents() {
        for (text, wanted) in [
            ("1.234(5)×10⁻³ kg", "1.234(5)e-3 kg"),
            ("(1.234 ± 0.005) × 10^-3 kg", "(1.234 ± 0.005)e-3 kg"),
            ("6.02·10²³ 1/mol", "6.02e23 1/mol"),
            ("5 x 10^+3 m", "5e3 m"),
            ("1*10^−6 m", "1e-6 m"),
            ("1·10^(−6) m", "1e-6 m"),
            ("1·10^(2/3) m", "1·10^(2/3) m"),
            ("5 kg*10^3", "5 kg*10^3"),
            ("5 lux", "5 lux"),
            ("5 × 10 m", "5 × 10 m"),
            ("5 N·m", "5 N·m"),
        ] {
            assert_eq!(with_exponents(text), wanted);
        }
    }

    /// A number in parentheses after a unit is not a factor, and a coverage is not a unit.
    #[test]
    fn what_belongs_to_uncertainties_is_no_unit() {
        for text in ["5.0112 V (23)", "100 ohm (0.1 %)", "2 mV (95 %)", "2 mV (2)"] {
            let error = read(text, "V", ValueOf::Difference).unwrap_err();
            assert!(error.contains("`5.0112(23) V`") && error.contains("(k=2)"), "{text}: {error}");
        }
        assert!(read("2 mV (k=2)", "V", ValueOf::Difference).unwrap_err().contains("key `k`"));
        assert!(read("5 kg/m3", "g/L", ValueOf::Quantity).unwrap_err().contains("`kg/m^3`"));
        assert_eq!(read("10 V/2", "V", ValueOf::Quantity), Ok(5.0));
        assert_eq!([bare_number(" 1e-3 "), bare_number("-3")], [Some(1e-3), Some(-3.0)]);
        assert_eq!([bare_number("3/2"), bare_number("inf"), bare_number("")], [None; 3]);
    }

    #[test]
    fn formulas_are_none() {
        for text in ["2*f", "2/f", "f", "100", "2 + f", "2^f", "(2)", "1.5 [mm]", "2 > f", ""] {
            assert_eq!(with_unit(text), None, "{text}");
        }
    }
}
