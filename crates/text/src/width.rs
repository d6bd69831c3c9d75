//! Widths as laboratories write them: a number in the input's unit, or a specification such as
//! `0.02 % + 0.005 % of 10 V + 2 uV`.

use super::DiagnosticKind;
use super::diagnostic_kind::WITHOUT_UNCERTAINTY;
use super::diagnostics::Collector;
use super::json::{Json, Node};
use super::share::counts_alike;
use super::value_text::{
    bare_number, decimal_comma, is_comma, unit_behind_number, with_plus_minus,
};
use gumption_units::Unit;

/// A width that may depend on the estimate: `relative` times its modulus, plus `absolute`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Width {
    /// Fraction of the estimate's modulus.
    pub relative: f64,
    /// Constant part, in the input's unit.
    pub absolute: f64,
}

impl Width {
    /// The width at an estimate, both in the input's unit.
    pub fn at(self, estimate: f64) -> f64 {
        self.relative * estimate.abs() + self.absolute
    }

    /// Whether the width has only a relative part, so that it may become 0 with the estimate.
    pub fn is_relative_only(self) -> bool {
        self.absolute == 0.0 && self.relative > 0.0
    }

    /// Reads the width at `key` of the input `name`, whose unit is `unit`.
    pub fn read(
        log: &Collector,
        node: &Node,
        name: &str,
        key: &str,
        unit: &Unit,
    ) -> Result<Self, DiagnosticKind> {
        match &node.value {
            Json::Number(_) => positive(key, node.number().unwrap_or(f64::NAN)),
            Json::Text(found) => {
                let wrong = |reason| {
                    let (name, found) = (name.to_owned(), found.clone());
                    DiagnosticKind::Width { name, found, reason }
                };
                let text = without_plus_minus(found, key).map_err(wrong)?;
                match bare_number(&text) {
                    // in the input's unit, as without the quotation marks
                    Some(absolute) => positive(key, absolute),
                    None => Self::specification(&text, unit, &log.own_units()).map_err(wrong),
                }
            }
            other => Err(DiagnosticKind::WrongType {
                what: format!("`{key}`"),
                found: other.kind(),
                expected: "a number or a specification such as \"0.02 % + 2 uV\"",
            }),
        }
    }

    /// Parses a specification for a quantity in `unit`; `own` are the units that the file defines.
    ///
    /// # Errors
    /// Why it is none, as a sentence without a capital.
    pub fn specification(text: &str, unit: &Unit, own: &[Unit]) -> Result<Self, String> {
        let mut width = Self { relative: 0.0, absolute: 0.0 };
        for term in terms(text) {
            let (value, rest) = number(term)?;
            if value.is_nan() || value < 0.0 || value.is_infinite() {
                return Err(format!("`{term}` is not a positive share or value"));
            }
            if is_comma(rest) {
                return Err(decimal_comma(value, rest));
            }
            match share(rest).or_else(|| ratio(rest, unit, own)) {
                Some((factor, "")) => {
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
                Some((factor, "reading")) => width.relative += value * factor,
                Some((factor, range)) => {
                    let (full, range_unit) = number(range).map_err(|_| {
                        format!(
                            "`{term}`: a share needs a value, such as `0.01 % of 10 V`, or \
                             `reading`; `{range}` is neither (for a share of a condition write a \
                             formula, such as `1e-4*{range}`)"
                        )
                    })?;
                    width.absolute +=
                        value * factor * converted(full, range_unit, own, unit, range)?;
                }
                None => width.absolute += converted(value, rest, own, unit, term)?,
            }
        }
        if width.relative > 0.0 || width.absolute > 0.0 {
            Ok(width)
        } else {
            Err(format!("it is zero, but a width must be above zero{WITHOUT_UNCERTAINTY}"))
        }
    }
}

/// A width as a number in the input's unit.
fn positive(key: &str, absolute: f64) -> Result<Width, DiagnosticKind> {
    if absolute > 0.0 {
        Ok(Width { relative: 0.0, absolute })
    } else {
        Err(DiagnosticKind::NotPositive { key: key.to_owned(), found: absolute })
    }
}

/// Keys of widths that extend to both sides of an estimate, so that `±` may precede them.
const BOTH_SIDES: [&str; 4] = ["half_width", "semi_range", "expanded", "cmc"];

/// A width without the `±` before it, as for limits and expanded uncertainties: `±0.05 mm`,
/// `±(0.02 % + 2 uV)`.
///
/// # Errors
/// The value is a standard deviation, which is never written with `±`.
pub fn without_plus_minus(text: &str, key: &str) -> Result<String, String> {
    let written = with_plus_minus(text.trim());
    let Some(width) = written.strip_prefix('±') else { return Ok(text.to_owned()) };
    if !BOTH_SIDES.contains(&key) {
        return Err(format!(
            "`±` belongs to limits or an expanded uncertainty, but `{key}` is a standard \
             deviation: write the `half_width` of a rectangular distribution, or `expanded` with \
             its `k`, or remove the sign"
        ));
    }
    let width = width.trim();
    let inside = width.strip_prefix('(').and_then(|width| width.strip_suffix(')'));
    Ok(inside.filter(|inside| !inside.contains(['(', ')'])).unwrap_or(width).trim().to_owned())
}

/// The terms between plus signs; the plus of an exponent (1e+3) is not a separator.
pub fn terms(text: &str) -> Vec<&str> {
    let mut terms = Vec::new();
    let mut start = 0;
    let bytes = text.as_bytes();
    for (at, _) in text.match_indices('+') {
        let exponent = at >= 2
            && bytes.get(at - 1).is_some_and(|b| matches!(b, b'e' | b'E'))
            && bytes.get(at - 2).is_some_and(u8::is_ascii_digit)
            && bytes.get(at + 1).is_some_and(u8::is_ascii_digit);
        if !exponent {
            terms.push(text.get(start..at).unwrap_or("").trim());
            start = at + 1;
        }
    }
    terms.push(text.get(start..).unwrap_or("").trim());
    terms
}

/// The number at the start of a term, and the rest.
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
    Ok((value, term.get(end..).unwrap_or("").trim()))
}

/// Signs for fractions, and their sizes.
const SHARES: [(&str, f64); 3] = [("%", 1e-2), ("ppm", 1e-6), ("ppb", 1e-9)];

/// Parses the rest of a term as a fraction: its size and its base (`""` if not given).
pub fn share(rest: &str) -> Option<(f64, &str)> {
    let (factor, after) =
        SHARES.iter().find_map(|(sign, factor)| Some((*factor, rest.strip_prefix(sign)?)))?;
    if after.is_empty() {
        return Some((factor, ""));
    }
    let of = after.trim_start().strip_prefix("of")?;
    of.starts_with(char::is_whitespace).then(|| (factor, of.trim()))
}

/// The same for a ratio of like units, `um/m` or `mV/V`, unless the quantity is a plain number, and
/// for a fraction with a divisor, `0.1 %/sqrt(3)`, for any quantity.
fn ratio<'r>(rest: &'r str, unit: &Unit, own: &[Unit]) -> Option<(f64, &'r str)> {
    let (text, of) = rest.split_once(" of ").unwrap_or((rest, ""));
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

fn converted(value: f64, text: &str, own: &[Unit], unit: &Unit, term: &str) -> Result<f64, String> {
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
    // data sheets count digits of a display
    let is_of_display =
        matches!(text, "digit" | "digits" | "count" | "counts" | "lsd" | "LSD" | "LSB");
    // and fractions of a range or a reading, in letters
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
        } else if is_of_display {
            format!(
                "the size of a digit depends on the range: write `{term}` as a value in `{unit}`"
            )
        } else {
            error
        }
    };
    // a count is a count of a plain number, and a digit belongs to a display only
    let is_number = unit.factor() == 1.0 && unit.turn().is_none();
    let counts = is_number && text.starts_with("count");
    if is_of_display && unit.dimension().is_none() && !counts {
        return Err(said(String::new()));
    }
    let given =
        unit_behind_number(text, own).map_err(|error| said(format!("in `{term}`: {error}")))?;
    let factor = Unit::conversion_factor(&given, unit).map_err(|_| {
        said(format!("`{text}` in `{term}` cannot be converted to the unit `{unit}`"))
    })?;
    Ok(value * factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_of_what_and_digits_of_a_display() {
        let volt = Unit::parse("V").unwrap();
        let wrong = |text: &str| Width::specification(text, &volt, &[]).unwrap_err();
        assert!(wrong("0.02 % of reading + 0.01 % of range").contains("such as `0.01 % of 10 V`"));
        for text in ["0.02 % of 20 V + 3 digits", "3 digit"] {
            assert!(wrong(text).contains("the size of a digit"), "{}", wrong(text));
        }
    }

    fn read(text: &str, unit: &str) -> Result<Width, String> {
        Width::specification(text, &Unit::parse(unit).unwrap(), &[])
    }

    #[test]
    fn a_multimeter_specification() {
        let width = read("0.02 % + 0.005 % of 10 V + 2 uV", "V").unwrap();
        assert!((width.at(-5.0) - (0.001 + 0.0005 + 2e-6)).abs() < 1e-15);
        assert!(
            (read("50 ppm of reading + 1e-3 mV", "V").unwrap().at(2.0) - 1.01e-4).abs() < 1e-15
        );
        let gauge = read("0.5 um + 5 um/m", "mm").unwrap();
        assert!((gauge.at(100.0) - (0.5e-3 + 0.5e-3)).abs() < 1e-15);
        let bridge = read("2 uV/V of reading + 1 uV/V of 10 V", "mV").unwrap();
        assert!((bridge.at(5.0) - (1e-5 + 1e-2)).abs() < 1e-15);
        assert!((read("3", "").unwrap().at(7.0) - 3.0).abs() < 1e-15);
        assert!((read("1e+1 mV", "V").unwrap().at(7.0) - 0.01).abs() < 1e-15);
    }

    /// Limits on both sides, and no other widths, may have `±`.
    #[test]
    fn plus_minus_before_limits() {
        for (text, expected) in [
            ("±0.05 mm", "0.05 mm"),
            ("+/- 5", "5"),
            ("±(0.02 % + 2 uV)", "0.02 % + 2 uV"),
            ("1", "1"),
        ] {
            assert_eq!(without_plus_minus(text, "half_width").as_deref(), Ok(expected));
        }
        assert!(without_plus_minus("±0.05 mm", "std").unwrap_err().contains("`half_width`"));
    }

    /// A ratio such as 1 um/m counts as ppm; a ratio of another size does not.
    #[test]
    fn shares_of_ratios() {
        for (text, unit) in
            [("1 ppm", "umol/mol"), ("5 ppm", "uV/V"), ("2 ppb", "umol/mol"), ("1 %", "cg/g")]
        {
            let error = read(text, unit).unwrap_err();
            assert!(error.contains("is unclear"), "{text} {unit}: {error}");
            let of_reading = read(&format!("{text} of reading"), unit).unwrap();
            assert!(of_reading.is_relative_only(), "{text} {unit}");
        }
        assert!((read("5 ppm", "mV/V").unwrap().at(2.0) - 1e-5).abs() < 1e-18);
        assert!((read("0.1 %", "1").unwrap().at(0.5) - 5e-4).abs() < 1e-18);
    }

    /// For plain numbers too, a fraction with a divisor is a fraction, and a digit does not belong
    /// to a display.
    #[test]
    fn shares_and_digits_of_plain_numbers() {
        for unit in ["mV/V", "1", "mm/m"] {
            for (text, expected) in [
                ("0.1 %/sqrt(3)", 2e-3 / 3_f64.sqrt()),
                ("50 ppm/2", 5e-5),
                ("0.1 %/2 of reading", 1e-3),
            ] {
                let width = read(text, unit).unwrap();
                assert!((width.at(2.0) - expected).abs() < 1e-15, "{text} of 2 {unit}");
            }
            assert!(read("1 digit", unit).unwrap_err().contains("the size of a digit"));
        }
        assert!(read("1 LSB", "deg").unwrap_err().contains("the size of a digit"));
        assert!(read("0.1 %/2", "%").unwrap_err().contains("of reading"));
        assert_eq!(read("3 count", "1").unwrap().at(7.0), 3.0);
        assert_eq!(read("3 um/m", "1").unwrap().at(7.0), 3e-6);
    }

    #[test]
    fn what_cannot_be_read_is_explained() {
        assert!(read("0.05 % FS", "V").unwrap_err().contains("`0.05 % of 10 V`"));
        assert!(read("0.5 + 1 ppm of reading", "%").unwrap_err().contains("components"));
        assert!(read("0.02 % + 3", "V").unwrap_err().contains("no unit"));
        assert!(read("1 %", "degC").unwrap_err().contains("of reading"));
        assert!(read("2 s", "V").unwrap_err().contains("converted"));
        assert!(read("2 um/V", "m").unwrap_err().contains("converted"));
        assert!(read("2 mm/m", "degC").unwrap_err().contains("of reading"));
        assert!(read("", "V").unwrap_err().contains("empty"));
        assert!(read("0 %", "V").unwrap_err().contains("zero"));
        assert!(read("1 % + ", "V").unwrap_err().contains("empty"));
        assert!(read("-1 %", "V").is_err());
        assert!(read("1 furlong", "m").unwrap_err().contains("furlong"));
    }
}
