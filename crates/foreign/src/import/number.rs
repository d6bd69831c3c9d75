//! Numbers as sheets write them.

use std::collections::HashMap;

use gumption_engine::model::formula::{Formula, Scope};
use gumption_engine::number::elementary;
use gumption_text::value_text::{RAISED, power_of_ten, with_exponents};

/// Spaces that stand between groups of digits.
const SPACES: [char; 4] = [' ', '\u{a0}', '\u{202f}', '\u{2009}'];

/// A number as spreadsheets write them; `1,5` where commas are decimal ones, `0.41·10⁻⁶`. Per cent are a
/// share.
pub(crate) fn number(text: &str, decimal_comma: bool) -> Option<f64> {
    if let Some(percent) = text.trim().strip_suffix('%') {
        return number(percent, decimal_comma).map(|share| share / 100.0);
    }
    plain(text, decimal_comma).map(|(value, _)| value)
}

/// A number as spreadsheets write it, and its digits as programs do.
fn plain(text: &str, decimal_comma: bool) -> Option<(f64, String)> {
    let text = text.trim().replace(&SPACES[1..], "").replace(['−', '–'], "-");
    let text = with_exponent(&text);
    let text = without_groups(&text).map_or(text, |text| text.replace(',', "."));
    let read = |text: String| {
        let value = text.parse::<f64>().ok().filter(|value| value.is_finite())?;
        text.contains(|c: char| c.is_ascii_digit()).then_some((value, text))
    };
    let one = decimal_comma && text.matches(',').count() == 1 && !text.contains('.');
    let with_comma = one.then(|| text.replace(',', "."));
    read(text).or_else(|| with_comma.and_then(read))
}

/// A number of a cell, its digits as programs write them, and the unit behind it: also per cent are one.
/// The unit is empty where there is none, and not looked at.
pub(crate) fn written(text: &str, decimal_comma: bool) -> Option<(f64, String, &str)> {
    let text = text.trim();
    let (_, unit) = number_with_unit(text, decimal_comma)?;
    let unit = if unit.is_empty() && text.ends_with('%') { "%" } else { unit };
    let digits = text.strip_suffix(unit)?.trim_end();
    let (value, digits) = plain(&ungrouped(&with_exponents(digits))?, decimal_comma)?;
    Some((value, digits, unit))
}

/// `10.000,005` and `10,000.005` without the marks between groups of three digits: of a number with both
/// marks the last one is the decimal one. `None` of other numbers.
pub(crate) fn without_groups(text: &str) -> Option<String> {
    let (whole, fraction) = text.rsplit_once(['.', ','])?;
    let mark = text.get(whole.len()..)?.chars().next()?;
    let other = if mark == '.' { ',' } else { '.' };
    let mut groups = whole.trim_start_matches(['-', '+']).split(other);
    let are_digits = |group: &str| group.bytes().all(|byte| byte.is_ascii_digit());
    let is_first =
        groups.next().is_some_and(|group| (1..=3).contains(&group.len()) && are_digits(group));
    let mut rest = groups.peekable();
    let is_grouped =
        rest.peek().is_some() && rest.all(|group| group.len() == 3 && are_digits(group));
    (is_first && is_grouped).then(|| format!("{}{mark}{fraction}", whole.replace(other, "")))
}

/// `0.41·10^-6` and `10⁻³` as `0.41e-6` and `1e-3`.
fn with_exponent(text: &str) -> String {
    let bare = text.strip_prefix('-').unwrap_or(text);
    match power_of_ten(bare) {
        Some((power, "")) => format!("{}1e{power}", text.strip_suffix(bare).unwrap_or("")),
        _ => with_exponents(text),
    }
}

/// A text with `^` and digits in place of raised ones.
fn lowered(text: &str) -> String {
    let mut lowered = String::new();
    let mut is_raised = false;
    for c in text.chars() {
        let digit = RAISED
            .chars()
            .position(|raised| raised == c)
            .and_then(|digit| char::from_digit(digit as u32, 10));
        let plain = if c == '⁻' { Some('-') } else { digit };
        if plain.is_some() && !is_raised {
            lowered.push('^');
        }
        is_raised = plain.is_some();
        lowered.push(plain.unwrap_or(c));
    }
    lowered
}

/// The longest number before a unit, in letters.
const LONGEST: usize = 64;

/// A number with the unit behind it, perhaps with digits in groups of three: `10 000,005 g`. The unit is
/// empty where there is none, and not looked at.
pub(super) fn number_with_unit(text: &str, decimal_comma: bool) -> Option<(f64, &str)> {
    let text = text.trim();
    if let Some(value) = number(text, decimal_comma) {
        return Some((value, ""));
    }
    // of a text that begins as no number nothing else is looked at
    let begins = |c: char| {
        c.is_ascii_digit() || matches!(c, '+' | '-' | '\u{2212}' | '\u{2013}' | '.' | ',')
    };
    if !text.starts_with(begins) {
        return None;
    }
    let ends = text.char_indices().take(LONGEST).map(|(at, c)| at + c.len_utf8());
    ends.collect::<Vec<_>>().into_iter().rev().find_map(|end| {
        let (digits, unit) = text.split_at_checked(end)?;
        let value = number(&ungrouped(&with_exponents(digits.trim_end()))?, decimal_comma)?;
        // `20.00(6) V` is no number of a unit `(6) V`
        let inside = unit.trim_start().strip_prefix('(').unwrap_or_default();
        let is_unit = !inside.starts_with(|c: char| c.is_ascii_digit());
        is_unit.then_some((value, unit.trim()))
    })
}

/// A number without the spaces between groups of three digits, on both sides of the decimal mark;
/// `None` where there are others.
fn ungrouped(digits: &str) -> Option<String> {
    let mut groups = digits.split(SPACES);
    let mut whole = groups.next()?.to_owned();
    for group in groups {
        let fraction = whole.rsplit_once(['.', ',']).map(|(_, fraction)| fraction.to_owned());
        let is_group = match fraction {
            // groups behind the mark are full, but for the last one
            Some(fraction) => {
                let is_full = fraction.len() % 3 == 0 && !fraction.is_empty();
                let are_digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
                is_full
                    && are_digits(&fraction)
                    && are_digits(group)
                    && (1..=3).contains(&group.len())
            }
            None => {
                let (head, rest) = group.split_at_checked(3)?;
                head.bytes().all(|b| b.is_ascii_digit())
                    && !rest.starts_with(|c: char| c.is_ascii_digit())
                    && whole.ends_with(|c: char| c.is_ascii_digit())
            }
        };
        if !is_group {
            return None;
        }
        whole.push_str(group);
    }
    Some(whole)
}

/// A number that may be written as an expression: `√3`, `2*√3`, `1/3`, `3^0.5`, `sqrt(3)`, and what
/// repeats it: `√3 (1.73)`, `√3 = 1.732`, `2 (k=2)`, `k = 2`.
pub(super) fn constant(text: &str, decimal_comma: bool) -> Option<f64> {
    let text = text.trim();
    if let Some(value) = number(text, decimal_comma) {
        return Some(value);
    }
    if let Some((before, _)) = text.strip_suffix(')').and_then(|text| text.rsplit_once(" (")) {
        return constant(before, decimal_comma);
    }
    if let Some((before, after)) = text.split_once('=') {
        let is_name = before.trim().chars().all(|c| c.is_alphabetic() || c == '_');
        return constant(if is_name { after } else { before }, decimal_comma);
    }
    let text = text.to_lowercase().replace("sqrt", "√");
    let text = if decimal_comma { text.replace(',', ".") } else { text };
    let formula = Formula::parse(&expression(&text)).ok()?;
    if formula.names().next().is_some() {
        return None;
    }
    let value: f64 = formula.evaluate(&Scope::new(), &HashMap::new()).ok()?;
    value.is_finite().then_some(value)
}

/// Signs of sheets as formulas have them: `–`, `·`, `×`, `²`, `√3`.
pub(super) fn expression(text: &str) -> String {
    let lowered = lowered(text).replace(['−', '–'], "-").replace(['·', '×', '⋅'], "*");
    let lowered = lowered.replace("Wurzel", "√").replace("wurzel", "√");
    let mut parts = lowered.split('√');
    let mut written = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let before = written.trim_end();
        if before.ends_with(|c: char| c.is_ascii_digit() || c == ')') {
            written.push('*');
        }
        let part = part.trim_start();
        let end = part.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(part.len());
        let (radicand, rest) = part.split_at(end);
        // what is in brackets already has them
        if radicand.is_empty() {
            written.push_str(&format!("sqrt{rest}"));
        } else {
            written.push_str(&format!("sqrt({radicand}){rest}"));
        }
    }
    written
}

/// Half of a unit of the last digit of a number as it is written.
pub(super) fn half_digit(text: &str) -> f64 {
    let end = text.find(['e', 'E', '·', '×', '*']).unwrap_or(text.len());
    let (mantissa, rest) = text.split_at(end);
    let digits: String =
        mantissa.chars().filter(|c| c.is_ascii_digit() || matches!(c, '.' | ',')).collect();
    let decimals = digits.rsplit_once(['.', ',']).map_or(0, |(_, decimals)| decimals.len());
    let power: i32 = rest
        .trim_start_matches(['e', 'E', '·', '×', '*', ' '])
        .trim_start_matches("10^")
        .split(|c: char| !(c.is_ascii_digit() || c == '-'))
        .next()
        .and_then(|power| power.parse().ok())
        .unwrap_or(0);
    0.5 * elementary::pow(10.0, f64::from(power) - decimals as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_of_numbers() {
        for (text, half) in [
            ("34,3 nm", 0.05),
            ("12", 0.5),
            ("0.0242", 5e-5),
            ("1.5e-3", 5e-5),
            ("10 000,025 g", 5e-4),
        ] {
            assert!((half_digit(text) / half - 1.0).abs() < 1e-12, "{text}");
        }
    }

    #[test]
    fn numbers() {
        for (text, value) in [
            ("1.5", 1.5),
            ("1,5", 1.5),
            ("–1", -1.0),
            ("0,41·10^-6", 0.41e-6),
            ("0,41×10⁻⁶", 0.41e-6),
            ("10⁻³", 1e-3),
            ("2 %", 0.02),
            ("1e-3", 1e-3),
            ("10.000,005", 10_000.005),
            ("-1,234,567.5", -1_234_567.5),
        ] {
            assert_eq!(number(text, true), Some(value), "{text}");
        }
        for text in ["", "inf", "nan", "x", "1,2,3", "1.2,3", "1234.567,8", "0.001,5.2", "y10^3"] {
            assert_eq!(number(text, true), None, "{text}");
        }
        for (text, value, unit) in [
            ("10 000,005 g", 10_000.005, "g"),
            ("10,000 00 V", 10.0, "V"),
            ("1,000 010 5", 1.000_010_5, ""),
            ("0,000 12 V", 0.000_12, "V"),
            ("-575 nm/K", -575.0, "nm/K"),
            ("0,41·10^-6 V", 0.41e-6, "V"),
            ("5 × 10³ V", 5e3, "V"),
            ("5 × 10^3", 5e3, ""),
            ("1,5 x 10^(-3) kg", 1.5e-3, "kg"),
            ("10⁻³ m", 1e-3, "m"),
        ] {
            assert_eq!(number_with_unit(text, true), Some((value, unit)), "{text}");
        }
        for (text, value, digits, unit) in [
            ("10 000,005 g", 10_000.005, "10000.005", "g"),
            ("−1,50", -1.5, "-1.50", ""),
            ("0.050%", 0.05, "0.050", "%"),
            ("0,410·10^-6 V", 0.41e-6, "0.410e-6", "V"),
            ("10,000.50", 10_000.5, "10000.50", ""),
        ] {
            assert_eq!(written(text, true), Some((value, digits.to_owned(), unit)), "{text}");
        }
        assert_eq!(written("inf", true), None);
        for text in ["50 12", "1,00 05", "1,000 0105"] {
            let found = number_with_unit(text, true);
            assert!(found.is_none_or(|(_, unit)| !unit.is_empty()), "{text} {found:?}");
        }
    }

    #[test]
    fn expressions() {
        let root = 3f64.sqrt();
        for (text, value) in [
            ("√3", root),
            ("SQRT(3)", root),
            ("sqrt3", root),
            ("Wurzel(3)", root),
            ("2√3", 2.0 * root),
            ("2*√3", 2.0 * root),
            ("1/√3", 1.0 / root),
            ("3^0,5", root),
            ("√3 (1,73)", root),
            ("√3=1,732", root),
            ("2 (k=2)", 2.0),
            ("k = 2", 2.0),
            ("t=2,87", 2.87),
            ("1/3", 1.0 / 3.0),
            ("10^-3", 1e-3),
            ("1·10^-3", 1e-3),
        ] {
            let found = constant(text, true).unwrap_or(f64::NAN);
            assert!((found / value - 1.0).abs() < 1e-15, "{text} {found}");
        }
        for text in ["zero", "", "x/3", "k=", "(2)x"] {
            assert_eq!(constant(text, true), None, "{text}");
        }
    }
}
