//! Headings of columns with a unit: `t [degC]`, `t (degC)`, `t / degC`, `t/degC`, `t in degC`.
//!
//! Text in brackets, or after a slash between spaces, is a unit. Text after a slash without spaces
//! (ISO 80000-1, 7.1.4: quantity over unit) or after `in` is a unit if it can be read as one: `x/g`
//! is x in g, `U1/U2` is a name.
//!
//! A file that names a column also states the unit of its values. If the heading has another unit,
//! the two contradict each other, and neither is used. A heading in `g` means `g_n` if the file
//! reads its column in `g_n`.

use std::fmt;

use crate::{ValueOf, gravity};
use gumption_units::Unit;

/// A column whose heading has another unit than the one in which its values are read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OtherUnit {
    /// The heading.
    pub column: String,
    /// Its unit.
    pub heading: String,
    /// The unit that the file declares.
    pub declared: String,
}

impl fmt::Display for OtherUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { column, heading, declared } = self;
        write!(
            f,
            "the heading of the column `{column}` says `{heading}`, but its values are read in \
             `{declared}`; state the unit that they have, or change the heading{}",
            gravity::hint_of(heading, declared)
        )
    }
}

/// The name of a column and its unit; 1 without a unit. `None` if brackets contain no unit, but a
/// number other than 1 or a value: `s (2)`, `r (10 V)`.
pub fn heading(unit: impl Fn(&str) -> Option<Unit>, text: &str) -> Option<(&str, Unit)> {
    let bracketed = enclosed(text, '[', "]").or_else(|| enclosed(text, '(', ")"));
    if bracketed.is_some_and(|(_, text)| begins_with_number(text)) {
        return None;
    }
    if let Some((name, text)) = enclosed(text, '[', "]") {
        return Some((name, unit(text)?));
    }
    let known = named_among(text, &unit);
    let known = known.and_then(|(name, text)| Some((name, unit(text)?)));
    Some(known.filter(|(name, _)| !name.is_empty()).unwrap_or((text.trim(), Unit::one())))
}

/// Whether the text in the place of a unit is a number other than 1, or a value. `10^-6/K`, `1e-3`,
/// `0.5*mm` are units.
fn begins_with_number(text: &str) -> bool {
    let rest = text.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.');
    let number = &text[..text.len() - rest.len()];
    let is_power = || {
        let exponent = rest.strip_prefix(['e', 'E']).is_some_and(|of| {
            of.trim_start_matches(['+', '-']).starts_with(|c: char| c.is_ascii_digit())
        });
        exponent || rest.starts_with(['^', '*', '/', '·', '×', '⁻', '¹', '²', '³'])
    };
    number.parse::<f64>().is_ok_and(|number| number != 1.0) && !is_power()
}

/// The name of a column without the unit after it; the whole heading if it has no unit.
pub fn bare(text: &str) -> &str {
    named(text).map(|(name, _)| name).filter(|name| !name.is_empty()).unwrap_or(text)
}

/// The name and the unit of a heading with a unit.
pub fn named(text: &str) -> Option<(&str, &str)> {
    named_among(text, |unit| Unit::parse(unit).ok())
}

/// The same with a given parser of units.
fn named_among(text: &str, unit: impl Fn(&str) -> Option<Unit>) -> Option<(&str, &str)> {
    let named = enclosed(text, '[', "]").or_else(|| enclosed(text, '(', ")"));
    named.or_else(|| after(text, " / ")).or_else(|| {
        let is_one = |(_, text): &(&str, &str)| unit(text).is_some();
        let worded = text.split_once(" in ").map(trimmed).filter(is_one);
        worded.or_else(|| {
            over(text).filter(is_one).filter(|(name, below)| !is_whole(name, below, &unit))
        })
    })
}

/// The parts before and after a slash without spaces.
fn over(text: &str) -> Option<(&str, &str)> {
    after(text, "/").filter(|(name, _)| !name.is_empty())
}

/// Whether the last word before a slash is the numerator of a unit, `v m/s`; the heading then
/// states nothing.
fn is_whole(name: &str, below: &str, unit: impl Fn(&str) -> Option<Unit>) -> bool {
    let last = name.rsplit_once(char::is_whitespace).map(|(_, last)| last);
    last.is_some_and(|above| unit(&format!("{above}/{below}")).is_some())
}

/// The index of the column with this name: an exact header first, otherwise the only header that is
/// this name with a unit, `f [Hz]` for `f`.
pub fn place_of(columns: &[String], name: &str) -> Option<usize> {
    let exact = columns.iter().position(|column| column == name);
    exact.or_else(|| {
        let named = |(_, column): &(usize, &String)| bare(column) == name;
        let mut places = columns.iter().enumerate().filter(named).map(|(place, _)| place);
        places.next().filter(|_| places.next().is_none())
    })
}

/// The name and the unit of a heading that ends in brackets.
pub fn enclosed<'h>(text: &'h str, open: char, close: &str) -> Option<(&'h str, &'h str)> {
    let (name, unit) = trimmed(text.trim_end().strip_suffix(close)?.rsplit_once(open)?);
    // `x/(m/s^2)`
    Some((name.strip_suffix('/').map_or(name, str::trim_end), unit))
}

fn after<'h>(text: &'h str, sign: &str) -> Option<(&'h str, &'h str)> {
    text.split_once(sign).map(trimmed)
}

fn trimmed<'h>((name, unit): (&'h str, &'h str)) -> (&'h str, &'h str) {
    (name.trim(), unit.trim())
}

/// The unit in the heading of a column whose values are `declared` in a file, and its text; `None`
/// if there is none, or if it has the same text as the declared unit.
pub fn stated<'h>(
    unit: impl Fn(&str) -> Option<Unit>,
    column: &'h str,
    declared: &Unit,
) -> Option<(Unit, &'h str)> {
    // a heading that is itself a unit of the same kind, `km/h` for `m/s`, is not a name with a unit
    let whole = unit(column.trim()).filter(|whole| whole.is_compatible(declared));
    let (name, text) = match whole.filter(|_| over(column).is_some()) {
        Some(_) => (column, column.trim()),
        None => named_among(column, &unit)?,
    };
    if name.is_empty() || text.parse::<f64>().is_ok() || text == declared.text() {
        return None;
    }
    // the unit alone in `kHz, nominal`
    let whole = unit(text).map(|of| (of, text));
    let parts = || text.split([',', ';', ' ']).map(str::trim).filter(|part| !part.is_empty());
    let part = || parts().find_map(|part| Some((unit(part)?, part)));
    whole.or_else(|| {
        part().filter(|(of, _)| of.is_compatible(declared) && !of.dimension().is_none())
    })
}

/// Prefixes that are written out.
const PREFIXES: [&str; 7] = ["nano", "micro", "mikro", "milli", "kilo", "mega", "giga"];

/// Words for the output values of a converter.
const COUNTS: [&str; 5] = ["counts", "count", "cts", "digits", "codes"];

/// Text in square brackets that should be a unit but cannot be the declared one: the number 1, a
/// misspelt unit, or a count of a converter: `lbs`, `millivolt`, `counts`. Other words may mean
/// anything.
fn unreadable<'h>(
    unit: impl Fn(&str) -> Option<Unit>,
    column: &'h str,
    declared: &Unit,
) -> Option<&'h str> {
    let (name, text) = enclosed(column, '[', "]")?;
    let is_nearly = || {
        let lower = text.to_lowercase();
        let is_word = PREFIXES
            .iter()
            .any(|prefix| lower.strip_prefix(prefix).is_some_and(|of| !of.is_empty()));
        is_word
            || COUNTS.contains(&lower.as_str())
            || Unit::parse(text).is_err_and(|error| !error.suggestions().is_empty())
    };
    let is_wrong = text == "1" || unit(text).is_none() && text != declared.text() && is_nearly();
    (declared.has_name() && !name.is_empty() && is_wrong).then_some(text)
}

/// Words for hundredths and thousandths, with their units.
const SHARES: [(&str, &str); 9] = [
    ("%", "%"),
    ("percent", "%"),
    ("percentage", "%"),
    ("pct", "%"),
    ("prozent", "%"),
    ("pourcent", "%"),
    ("‰", "‰"),
    ("permille", "‰"),
    ("promille", "‰"),
];

/// Words for multiples, and for fractions of a range or a screen.
const MULTIPLES: [&str; 7] =
    ["thousand", "thousands", "million", "millions", "fs", "div", "division"];

/// Text in brackets that says that the numbers are multiples or fractions of the declared unit:
/// `x1000 V`, `V x1000`, `1e-3`, `percent`, `% FS`, `V per div`. A small whole number alone counts
/// something.
fn multiple(column: &str) -> Option<&str> {
    let (name, text) = enclosed(column, '[', "]").or_else(|| enclosed(column, '(', ")"))?;
    let power = |word: &str| {
        let word = word.strip_prefix("10^").map_or(word.to_owned(), |of| format!("1e{of}"));
        word.parse::<f64>().ok().filter(|number| *number != 1.0)
    };
    let is_multiple = |word: &str| {
        let factor = word.strip_prefix(['x', 'X', '×', '*']).and_then(power);
        let factor = factor.or_else(|| word.strip_suffix(['x', 'X', '×']).and_then(power));
        let lower = word.to_lowercase();
        let behind_share = lower.strip_prefix(['%', '‰']).unwrap_or(&lower);
        factor.is_some() || share(&lower).is_some() || MULTIPLES.contains(&behind_share)
    };
    let is_scale = |number: f64| number >= 1e3 || number.fract() != 0.0;
    let times = text.strip_prefix(['x', '×', '*']).map_or("", str::trim_start);
    let is_scaled = power(text).is_some_and(is_scale)
        || times.split_whitespace().next().and_then(power).is_some()
        || text.split([' ', '/']).any(is_multiple);
    (!name.is_empty() && is_scaled).then_some(text)
}

/// The unit for a word such as `percent`: `%`.
fn share(lower: &str) -> Option<&'static str> {
    SHARES.iter().find(|(word, unit)| *word == lower && *word != *unit).map(|(_, unit)| *unit)
}

/// Whether a text is the declared unit of fractions in words: `percent`, `% FS`.
fn is_share_in(text: &str, declared: &Unit) -> bool {
    let first = text.split(' ').next().unwrap_or_default().to_lowercase();
    let is_word = |rest: &str| rest.chars().all(char::is_alphabetic);
    SHARES.iter().any(|(word, unit)| {
        let is_symbol = || word == unit && first.strip_prefix(word).is_some_and(is_word);
        *unit == declared.text() && (first == *word || is_symbol())
    })
}

/// Suffixes of units in the notation of instruments, `mVrms`.
const OF_SIGNALS: [&str; 14] =
    ["rms", "eff", "pp", "p-p", "pk", "pk-pk", "peak", "ptp", "dc", "ac", "olt", "olts", "ec", "s"];

/// A unit of the declared kind among other words of a heading: in brackets anywhere, after a comma
/// or ` in `, in the wrong case (`mv`), or with a suffix of an instrument (`mVrms`, `mVolt`).
fn among<'h>(
    unit: impl Fn(&str) -> Option<Unit>,
    column: &'h str,
    declared: &Unit,
) -> Option<(Unit, &'h str)> {
    if !declared.has_name() {
        return None;
    }
    let bracketed =
        column.split(['[', '(']).skip(1).filter_map(|rest| rest.split([']', ')']).next());
    let behind = [column.rsplit_once(',').map(|(_, rest)| rest)];
    let worded = column.split(" in ").skip(1);
    let places = bracketed.chain(behind.into_iter().flatten()).chain(worded);
    let words = places.filter_map(|place| place.split_whitespace().next());
    let is_of_kind = |of: &Unit| of.is_compatible(declared);
    let of_word = |word: &'h str| {
        let whole = unit(word).filter(is_of_kind);
        let begun = || {
            let ends = word.char_indices().map(|(end, _)| end).filter(|end| *end > 0);
            ends.rev().find_map(|end| {
                let (begin, rest) = word.split_at(end);
                let rest = rest.trim_start_matches(['_', '.', '-']).to_lowercase();
                OF_SIGNALS.contains(&rest.as_str()).then(|| unit(begin))?.filter(is_of_kind)
            })
        };
        let capital = || {
            let (end, last) = word.char_indices().next_back().filter(|(end, _)| *end > 0)?;
            unit(&format!("{}{}", &word[..end], last.to_uppercase())).filter(is_of_kind)
        };
        Some((whole.or_else(begun).or_else(capital)?, word))
    };
    words.into_iter().find_map(of_word)
}

/// Checks whether a heading has another unit than `declared`, the unit in which its values
/// (quantities or widths) are read; `unit` parses the text of a unit. `None` if the heading has no
/// unit; a number alone counts something.
pub fn contradiction(
    unit: impl Fn(&str) -> Option<Unit>,
    column: &str,
    (declared, of): (&Unit, ValueOf),
) -> Option<OtherUnit> {
    let other_than = |heading: &str| OtherUnit {
        column: column.to_owned(),
        heading: heading.to_owned(),
        declared: declared.text().to_owned(),
    };
    let is_declared = |unit: &Unit| {
        Unit::conversion_factor(unit, declared) == Ok(1.0)
            && (of == ValueOf::Difference || unit.has_zero_of(declared))
    };
    let bracketed = enclosed(column, '[', "]").or_else(|| enclosed(column, '(', ")"));
    if bracketed.is_some_and(|(_, text)| is_share_in(text, declared)) {
        return None;
    }
    let is_its =
        |text: &str| text == declared.text() || unit(text).is_some_and(|of| is_declared(&of));
    if let Some(text) = multiple(column).filter(|text| !is_its(text)) {
        return Some(other_than(text));
    }
    let other = among(&unit, column, declared);
    let unreadable = unreadable(&unit, column, declared);
    if let Some(text) =
        unreadable.filter(|_| !other.as_ref().is_some_and(|(of, _)| is_declared(of)))
    {
        return Some(other_than(text));
    }
    let (unit, text) = stated(&unit, column, declared).or(other)?;
    let meant = || gravity::meant(text, declared.dimension());
    let is_same = is_declared(&unit) || meant().as_ref().is_some_and(is_declared);
    (!is_same).then(|| other_than(text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_behind_slashes_and_words() {
        for (text, expected) in [
            ("x/g", Some(("x", "g"))),
            ("t/ms", Some(("t", "ms"))),
            ("x / g", Some(("x", "g"))),
            ("x [g]", Some(("x", "g"))),
            ("x (g)", Some(("x", "g"))),
            ("x/(m/s^2)", Some(("x", "m/s^2"))),
            ("x / (m/s^2)", Some(("x", "m/s^2"))),
            ("v/km/h", Some(("v", "km/h"))),
            ("x in g", Some(("x", "g"))),
            ("speed in m/s", Some(("speed", "m/s"))),
            // names
            ("U1/U2", None),
            ("out/in2", None),
            ("/m", None),
            ("drift in run2", None),
            ("x", None),
            // a unit after a space alone states nothing, nor does a part of itself
            ("v m/s", None),
        ] {
            assert_eq!(named(text), expected, "{text}");
        }
    }

    #[test]
    fn numbers_and_values_are_no_units() {
        for text in ["2", "10 V", "23", "0.1 %"] {
            assert!(begins_with_number(text), "{text}");
        }
        for text in ["1", "1 V", "10^-6/K", "1e-6/K", "2e3", "0.5*mm", "10⁻³", "V", ""] {
            assert!(!begins_with_number(text), "{text}");
        }
    }

    #[test]
    fn a_slash_without_spaces_contradicts() {
        let unit = |text: &str| Unit::parse(text).expect("a unit");
        let said = |heading: &str, declared: &str| {
            let of = (&unit(declared), ValueOf::Quantity);
            contradiction(|text| Unit::parse(text).ok(), heading, of).map(|found| found.heading)
        };
        assert_eq!(said("x/g", "m/s^2").as_deref(), Some("g"));
        assert_eq!(said("t/ms", "s").as_deref(), Some("ms"));
        assert_eq!(said("x in mV", "V").as_deref(), Some("mV"));
        assert_eq!(said("x/mV", "mV"), None);
        assert_eq!(said("U1/U2", "1"), None);
        // a heading that is itself a unit
        assert_eq!(said("km/h", "km/h"), None);
        assert_eq!(said("km/h", "m/s").as_deref(), Some("km/h"));
        // a voltage in mV under a heading that is a unit of another kind
        assert_eq!(said("V/mV", "mV"), None);
        assert_eq!(said("V/mV", "V").as_deref(), Some("mV"));
        // a `g` that does not mean the gram
        assert_eq!(said("x [g]", "g_n"), None);
        assert_eq!(said("x [mg]", "mg_n"), None);
        assert_eq!(said("x [mg]", "g_n").as_deref(), Some("mg"));
        assert_eq!(said("x [g]", "g"), None);
        // a unit among other words
        assert_eq!(said("f (kHz, nominal)", "Hz").as_deref(), Some("kHz"));
        assert_eq!(said("f (nominal, kHz)", "Hz").as_deref(), Some("kHz"));
        assert_eq!(said("f (kHz, nominal)", "kHz"), None);
        assert_eq!(said("f (set m)", "Hz"), None);
    }

    #[test]
    fn units_among_other_words() {
        let unit = |text: &str| Unit::parse(text).expect("a unit");
        let said = |heading: &str, declared: &str| {
            let of = (&unit(declared), ValueOf::Quantity);
            contradiction(|text| Unit::parse(text).ok(), heading, of).map(|found| found.heading)
        };
        for (heading, found) in [
            ("x [mVrms]", "mVrms"),
            ("x [mVpp]", "mVpp"),
            ("x [mV pk]", "mV pk"),
            ("x [mV_RMS]", "mV_RMS"),
            ("x [mVolt]", "mVolt"),
            ("x [millivolt]", "millivolt"),
            ("x [milliV]", "milliV"),
            ("x [mv]", "mv"),
            ("x [counts]", "counts"),
            ("[mV] x", "mV"),
            ("(mV) x", "mV"),
            ("x [mV]*", "mV"),
            ("x, mV", "mV"),
            ("x in mV rms", "mV"),
            ("Channel 1 (mV) filtered", "mV"),
            ("x [mV (gain 10)]", "mV (gain 10)"),
        ] {
            assert_eq!(said(heading, "V").as_deref(), Some(found), "{heading}");
        }
        for heading in [
            "x [x1000 V]",
            "x [×1000 V]",
            "x [V x1000]",
            "x [thousands V]",
            "x [% FS]",
            "x [%FS]",
            "x [V per div]",
            "x [percent]",
            "x [1e-3]",
            "x [1000]",
            "x (x 10^-3)",
            "x (10x)",
        ] {
            for declared in ["V", "1"] {
                assert!(said(heading, declared).is_some(), "{heading} in {declared}");
            }
        }
        for heading in ["x (2)", "x [2]", "x [1]", "run (x)"] {
            assert_eq!(said(heading, "1"), None, "{heading}");
        }
        assert_eq!(said("a [10^-6/K]", "10^-6/K"), None);
        assert_eq!(said("x [1e-3]", "0.001"), None);
        for heading in ["x [percent]", "x [% FS]", "x [%FS]", "x [Prozent]", "x [%]"] {
            assert_eq!(said(heading, "%"), None, "{heading}");
        }
        assert_eq!(said("x [%/K]", "%").as_deref(), Some("%/K"));
        assert_eq!(said("x [V/div]", "V").as_deref(), Some("V/div"));
        for heading in ["x [Vrms]", "x [V pk]", "x (left)", "drift in run2", "x [mean]", "x, m"] {
            assert_eq!(said(heading, "V"), None, "{heading}");
        }
        assert_eq!(said("x [mVrms]", "mV"), None);
        assert_eq!(said("t [mins]", "s").as_deref(), Some("mins"));
    }
}
