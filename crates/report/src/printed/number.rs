//! Numbers and exponents of a text in typographic notation.

/// Superscripts of the digits.
const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

/// A narrow space that does not break (SI brochure, 5.4.4).
const NARROW: char = '\u{202f}';

/// A text with raised exponents, `m/s²` for `m/s^2`, powers of ten, `5 × 10⁻⁷` for `5e-7`, a true minus
/// before a number, and narrow spaces between groups of three digits. What is between backticks is
/// unchanged.
pub(crate) fn text(text: &str) -> String {
    let parts: Vec<&str> = text.split('`').collect();
    // a single backtick quotes nothing
    if parts.len().is_multiple_of(2) {
        return unquoted(text);
    }
    let part = |(place, part): (usize, &&str)| match place % 2 {
        0 => unquoted(part),
        _ => (*part).to_owned(),
    };
    parts.iter().enumerate().map(part).collect::<Vec<_>>().join("`")
}

/// A count with its digits in groups of three: 1 000 000.
pub fn grouped(count: u64) -> String {
    let digits = count.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

fn unquoted(text: &str) -> String {
    let letters: Vec<char> = text.chars().collect();
    let mut made = String::with_capacity(text.len());
    let mut place = 0;
    while let Some(&letter) = letters.get(place) {
        let before = place.checked_sub(1).and_then(|place| letters.get(place)).copied();
        let rest = letters.get(place..).unwrap_or_default();
        let (written, length) = match letter {
            '^' => power(rest),
            '-' | '0'..='9' if begins_number(before) => number(rest),
            ' ' if is_group(&letters, place) => Some((NARROW.to_string(), 1)),
            _ => None,
        }
        .unwrap_or_else(|| (letter.to_string(), 1));
        made += &written;
        place += length;
    }
    made
}

/// Whether a number can begin after a letter: not within a word, a date or another number.
fn begins_number(before: Option<char>) -> bool {
    before.is_none_or(|before| {
        !(before.is_alphanumeric() || matches!(before, '_' | '.' | ',' | '-' | '^' | '/'))
    })
}

/// Whether the space at a place separates groups of three digits: it stands between a group of one to
/// three digits and a group of exactly three.
fn is_group(letters: &[char], place: usize) -> bool {
    let is_digit = |place: Option<usize>| {
        place.and_then(|place| letters.get(place)).is_some_and(char::is_ascii_digit)
    };
    let after = (1..=3).all(|by| is_digit(Some(place + by))) && !is_digit(Some(place + 4));
    let digits = (1..=4).take_while(|by| is_digit(place.checked_sub(*by))).count();
    let first = place.checked_sub(digits + 1).and_then(|place| letters.get(place));
    after && (1..=3).contains(&digits) && first.is_none_or(|c| !matches!(c, '.' | ','))
}

/// A whole exponent after `^`, raised, and how many letters it takes.
fn power(rest: &[char]) -> Option<(String, usize)> {
    let sign = usize::from(rest.get(1) == Some(&'-'));
    let digits: Vec<char> =
        rest.iter().skip(1 + sign).copied().take_while(char::is_ascii_digit).collect();
    let fraction = rest.get(1 + sign + digits.len()) == Some(&'.');
    (!digits.is_empty() && !fraction).then(|| (raised(sign == 1, &digits), 1 + sign + digits.len()))
}

fn raised(is_negative: bool, digits: &[char]) -> String {
    let digits = digits.iter().filter_map(|digit| digit.to_digit(10));
    let digits = digits.filter_map(|digit| RAISED.get(digit as usize));
    is_negative.then_some('⁻').iter().chain(digits).collect()
}

/// A number at the beginning of a text, and how many letters it takes; `None` if it is written in
/// print as it is here.
fn number(rest: &[char]) -> Option<(String, usize)> {
    let count = |from: usize, holds: fn(&char) -> bool| {
        rest.iter().skip(from).take_while(|letter| holds(letter)).count()
    };
    let sign = usize::from(rest.first() == Some(&'-'));
    let digits = count(sign, |letter| letter.is_ascii_digit() || *letter == '.');
    if digits == 0 || rest.get(sign) == Some(&'.') {
        return None;
    }
    let end = sign + digits;
    let mantissa: String = rest.get(sign..end)?.iter().collect();
    let minus = if sign == 1 { "\u{2212}" } else { "" };
    let is_word = |place: usize| rest.get(place).is_some_and(|c| c.is_alphanumeric());
    if rest.get(end) == Some(&'e') {
        let negative = usize::from(rest.get(end + 1) == Some(&'-'));
        let from = end + 1 + negative;
        let digits: Vec<char> =
            rest.iter().skip(from).copied().take_while(char::is_ascii_digit).collect();
        let end = from + digits.len();
        if (1..=3).contains(&digits.len()) && !is_word(end) {
            let power = raised(negative == 1, &digits);
            return Some((format!("{minus}{mantissa}{NARROW}×{NARROW}10{power}"), end));
        }
        return None;
    }
    (!is_word(end)).then(|| (format!("{minus}{mantissa}"), end))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_exponents_are_typographic() {
        let cases = [
            ("m/s^2, kg*m^-3*K, Hz^(1/2)", "m/s², kg*m⁻³*K, Hz^(1/2)"),
            ("from -0.5 to 1.2e-7 V", "from \u{2212}0.5 to 1.2\u{202f}×\u{202f}10⁻⁷ V"),
            ("(-3e12 ± 2)", "(\u{2212}3\u{202f}×\u{202f}10¹² ± 2)"),
            ("1 000 000 trials", "1\u{202f}000\u{202f}000 trials"),
            ("row 3 of 100 rows, 0.5 100", "row 3 of 100 rows, 0.5 100"),
            // dates, versions, clauses, digests, names and ranges are no such numbers
            ("2026-11-30, JCGM 101, 7.9.4", "2026-11-30, JCGM 101, 7.9.4"),
            ("12e45a7, x-1, 1-2, a_-1", "12e45a7, x-1, 1-2, a_-1"),
            ("`-5e-3` is -5e-3", "`-5e-3` is \u{2212}5\u{202f}×\u{202f}10⁻³"),
            ("a ` -1", "a ` \u{2212}1"),
            ("x^2.5 and ^", "x^2.5 and ^"),
            ("- none", "- none"),
        ];
        for (file, print) in cases {
            assert_eq!(text(file), print, "{file}");
        }
    }
}
