//! The terms of a specification: shares of the reading, of a range or of full scale, counts of a
//! display, and values with a unit.

use super::forms::{Instrument, LinearWidth};
use crate::share::counts_alike;
use crate::value_text::{decimal_comma, is_comma, number, unit_behind_number};
use gumption_engine::number::Shortest;
use gumption_units::Unit;

/// The sum of the terms of a specification.
///
/// # Errors
/// Why a term cannot be read, as a sentence without a capital.
pub(super) fn sum(
    text: &str,
    unit: &Unit,
    own: &[Unit],
    instrument: Option<&Instrument>,
) -> Result<LinearWidth, String> {
    let mut width = LinearWidth::default();
    for term in terms(text) {
        let (value, rest) = number(term)?;
        if value.is_nan() || value < 0.0 || value.is_infinite() {
            return Err(format!("`{term}` is not a positive share or value"));
        }
        if is_comma(rest) {
            return Err(decimal_comma(value, rest));
        }
        let Some((factor, base)) = share(rest).or_else(|| ratio(rest, unit, own)) else {
            width.absolute += match counts(term, value, rest, unit, instrument)? {
                Some(counted) => counted,
                None => converted(value, rest, own, unit, term)?,
            };
            continue;
        };
        match Base::of(base) {
            Base::Unsaid => {
                let is_ratio = unit.is_relative() || counts_alike(factor, unit);
                if is_ratio || unit.is_celsius() || !unit.level_exponent().is_zero() {
                    let own = if is_ratio {
                        format!("the number alone, without quotes, for a width in `{unit}`")
                    } else {
                        "a value with its unit".to_owned()
                    };
                    return Err(format!(
                        "for a quantity in `{unit}` the base of `{term}` is unclear: write \
                         `{term} of reading`, or {own}"
                    ));
                }
                width.relative += value * factor;
            }
            Base::Reading => width.relative += value * factor,
            Base::Range => {
                let range = instrument.map(|instrument| instrument.range);
                width.absolute += value * factor * stated(term, base, "range", range)?;
            }
            Base::FullScale => {
                let scale = instrument.map(|instrument| instrument.full_scale);
                width.absolute += value * factor * stated(term, base, "full_scale", scale)?;
            }
            Base::Other(range) => {
                let (full, range_unit) = number(range).map_err(|_| {
                    format!(
                        "`{term}`: a share needs a value, such as `0.01 % of 10 V`, or \
                         `reading`; `{range}` is neither (for a share of a condition write a \
                         formula, such as `1e-4*{range}`)"
                    )
                })?;
                width.absolute += value * factor * converted(full, range_unit, own, unit, range)?;
            }
        }
    }
    Ok(width)
}

/// What a share is of.
enum Base<'t> {
    Unsaid,
    Reading,
    Range,
    FullScale,
    Other(&'t str),
}

/// Names of the reading, of the range and of full scale on data sheets.
const READING: [&str; 3] = ["reading", "rdg", "rdg."];
const RANGE: [&str; 2] = ["range", "rng"];
const FULL_SCALE: [&str; 4] = ["FS", "F.S.", "full scale", "full-scale"];

impl<'t> Base<'t> {
    fn of(text: &'t str) -> Self {
        let is_among = |names: &[&str]| names.iter().any(|name| name.eq_ignore_ascii_case(text));
        match text {
            "" => Self::Unsaid,
            _ if is_among(&READING) => Self::Reading,
            _ if is_among(&RANGE) => Self::Range,
            _ if is_among(&FULL_SCALE) => Self::FullScale,
            _ => Self::Other(text),
        }
    }
}

/// The range or the full scale that a key beside the width states; outside `None` where no such key
/// can stand.
#[allow(clippy::option_option)]
fn stated(term: &str, base: &str, key: &str, found: Option<Option<f64>>) -> Result<f64, String> {
    let share = term.strip_suffix(base).unwrap_or(term).trim_end();
    let share = share.strip_suffix("of").unwrap_or(share).trim_end();
    match found {
        Some(Some(found)) => Ok(found),
        Some(None) => Err(format!(
            "`{term}` needs its value: add the key `{key}`, such as `\"{key}\": \"10 V\"`, or \
                 write `{share} of 10 V`"
        )),
        None => Err(format!(
            "`{term}`: a share needs a value, such as `{share} of 10 V`, or `reading`; the value of \
             `{base}` is not stated"
        )),
    }
}

/// Names of the last digit of a display on data sheets.
const COUNTS: [&str; 9] =
    ["digit", "digits", "dgt", "dgts", "count", "counts", "lsd", "LSD", "LSB"];

/// The value of counts of a display; inside `None` if the text is no name of them, or the name of a
/// unit for a plain number.
fn counts(
    term: &str,
    value: f64,
    text: &str,
    unit: &Unit,
    instrument: Option<&Instrument>,
) -> Result<Option<f64>, String> {
    if !COUNTS.contains(&text) || text == unit.text().trim() {
        return Ok(None);
    }
    let resolution = instrument.and_then(|instrument| instrument.resolution);
    // a count is a count of a plain number, and a digit belongs to a display only
    let is_number = unit.dimension().is_none() && unit.factor() == 1.0 && unit.turn().is_none();
    match resolution {
        Some(_) if is_number && text.starts_with("count") => Err(format!(
            "`{term}` can be the number or {term} of the display: write `{value} digits` for the \
             display, or the number alone",
            value = Shortest(value)
        )),
        Some(resolution) => Ok(Some(value * resolution)),
        None if is_number && text.starts_with("count") => Ok(None),
        None if instrument.is_some() => Err(format!(
            "the size of a digit is not stated: add the key `resolution`, such as \
             `\"resolution\": \"0.1 mV\"`, or write `{term}` as a value in `{unit}`"
        )),
        None => Err(format!(
            "the size of a digit depends on the range: write `{term}` as a value in `{unit}`"
        )),
    }
}

/// The terms between plus signs; the plus of an exponent (1e+3) is not a separator.
pub fn terms(text: &str) -> Vec<&str> {
    let mut terms = Vec::new();
    let mut start = 0;
    let bytes = text.as_bytes();
    for (at, _) in text.match_indices('+') {
        let is_before = |back: usize, is: fn(&u8) -> bool| {
            at.checked_sub(back).and_then(|at| bytes.get(at)).is_some_and(is)
        };
        let of_number =
            is_before(1, |b| matches!(b, b'e' | b'E')) && is_before(2, u8::is_ascii_digit);
        let exponent = (of_number || is_before(1, |b| matches!(b, b'^' | b'(')))
            && bytes.get(at + 1).is_some_and(u8::is_ascii_digit);
        if !exponent {
            terms.push(text.get(start..at).unwrap_or("").trim());
            start = at + 1;
        }
    }
    terms.push(text.get(start..).unwrap_or("").trim());
    terms
}

/// Signs for fractions, and their sizes.
const SHARES: [(&str, f64); 3] = [("%", 1e-2), ("ppm", 1e-6), ("ppb", 1e-9)];

/// Parses the rest of a term as a fraction: its size and its base (`""` if not given), which follows
/// `of` or is one of the words of data sheets, `% rdg`.
pub fn share(rest: &str) -> Option<(f64, &str)> {
    let (factor, after) =
        SHARES.iter().find_map(|(sign, factor)| Some((*factor, rest.strip_prefix(sign)?)))?;
    let base = after.trim_start();
    let of = base.strip_prefix("of").filter(|of| of.starts_with(char::is_whitespace));
    let base = of.map_or(base, str::trim);
    let is_word = !matches!(Base::of(base), Base::Other(_));
    // `%` alone, or with words after a space
    (after.is_empty() || of.is_some() || is_word).then_some((factor, base))
}

/// The same for a ratio of like units, `um/m` or `mV/V`, unless the quantity is a plain number, and
/// for a fraction with a divisor, `0.1 %/sqrt(3)`, for any quantity.
pub(super) fn ratio<'r>(rest: &'r str, unit: &Unit, own: &[Unit]) -> Option<(f64, &'r str)> {
    let said = rest.split_once(" of ").or_else(|| {
        let (text, word) = rest.split_once(' ')?;
        (!matches!(Base::of(word.trim()), Base::Other(_))).then_some((text, word))
    });
    let (text, of) = said.unwrap_or((rest, ""));
    let ratio = unit_behind_number(text.trim(), own).ok().filter(|_| text.contains('/'))?;
    let is_share = ratio.dimension().is_none() && ratio.turn().is_none();
    let divided = SHARES.iter().filter_map(|(sign, _)| text.trim().strip_prefix(sign));
    let is_divided_share = divided.into_iter().any(|rest| !rest.starts_with(char::is_alphabetic));
    (is_share && (is_divided_share || !unit.dimension().is_none()))
        .then(|| (ratio.factor(), of.trim()))
}

/// Whether a term is a fraction without a base: `0.1 %`.
pub fn is_bare_share(term: &str) -> bool {
    let share = number(term).ok().and_then(|(_, rest)| share(rest));
    share.is_some_and(|(_, rest)| rest.is_empty())
}

pub(super) fn converted(
    value: f64,
    text: &str,
    own: &[Unit],
    unit: &Unit,
    term: &str,
) -> Result<f64, String> {
    if text.is_empty() {
        return if unit.dimension().is_none() && !unit.is_relative() {
            Ok(value)
        } else {
            Err(match unit.is_relative() {
                // per cent of what, if the quantity itself is in per cent?
                true => format!(
                    "`{term}` has no unit, and the base of `{term} {unit}` would be unclear: write \
                     the two terms as components"
                ),
                false => format!("`{term}` has no unit; write for example `{term} {unit}`"),
            })
        };
    }
    if text == unit.text().trim() {
        return Ok(value);
    }
    // fractions of a range or a reading, in letters
    let words = SHARES.iter().find_map(|(sign, _)| text.strip_prefix(sign));
    let words = words.map(str::trim).filter(|words| words.starts_with(char::is_alphabetic));
    let said = |error: String| {
        if let Some(words) = words.filter(|_| unit_behind_number(text, own).is_err()) {
            let number = term.strip_suffix(words).unwrap_or(term).trim_end();
            format!(
                "`{words}` in `{term}` is not a unit: write a share of a range, or of full scale, \
                 with its value, such as `{number} of 10 V`, and a share of the reading as \
                 `{number} of reading`"
            )
        } else {
            error
        }
    };
    let given =
        unit_behind_number(text, own).map_err(|error| said(format!("in `{term}`: {error}")))?;
    let factor = Unit::conversion_factor(&given, unit).map_err(|_| {
        said(format!("`{text}` in `{term}` cannot be converted to the unit `{unit}`"))
    })?;
    Ok(value * factor)
}
