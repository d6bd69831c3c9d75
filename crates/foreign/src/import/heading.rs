//! What stands in the heading of a column of numbers beside its words: a unit, the coverage, symbols.
//!
//! A unit or a factor that is dropped makes results wrong by powers of ten. So everything that stands
//! there is read or looked at: what may be a unit or a factor and is none that is known is refused.

use super::columns::{is_of_estimate, is_symbol, unit_as_meant};
use super::coverage::Statement;
use super::{symbol, words};
use gumption_text::named_shape::NamedShape;
use gumption_units::Unit;

/// Words of columns of results, which a budget has none of.
const VALUES: [&str; 3] = ["result", "ergebnis", "x"];

/// What a piece of a heading says.
enum HeadingPiece {
    Nothing,
    Unit(String),
}

/// The unit that a header's cell has behind its words, `Estimate (mm)`, `u / µV`, `Uncertainty mV`,
/// `U (k=2) in mV`, `Uncertainty (% of reading)`; letters that are symbols of uncertainties are none,
/// `Half-width (a)`, but of values (`is_value`) they are.
///
/// # Errors
/// What is not understood and may be a unit or a factor, as a sentence.
pub(crate) fn unit_of_header(text: &str, is_value: bool) -> Result<Option<String>, String> {
    if let Some((_, rest)) = symbol::of_uncertainties(text) {
        return of_pieces(pieces_of(rest).into_iter(), is_value).map_err(|reason| reason.of(text));
    }
    let (outside, insides) = parts(text);
    let outside = match behind_words(&outside) {
        Some(rest) => separated(rest),
        // the first piece is a name that nothing here knows
        None => separated(&outside).split_off(1),
    };
    let inside = insides.iter().flat_map(|inside| separated(inside));
    of_pieces(inside.chain(outside), is_value).map_err(|reason| reason.of(text))
}

/// All pieces of a text without words of a column, those in brackets first.
fn pieces_of(text: &str) -> Vec<String> {
    let (outside, insides) = parts(text);
    insides.iter().flat_map(|inside| separated(inside)).chain(separated(&outside)).collect()
}

/// Why a piece of a heading is refused.
enum Refused {
    /// It may be a unit or a factor.
    Unknown(String),
    /// Another sentence.
    Reason(String),
}

impl Refused {
    fn of(self, heading: &str) -> String {
        let heading = heading.trim();
        match self {
            Self::Reason(reason) => format!("in the heading `{heading}`: {reason}"),
            Self::Unknown(piece) => format!(
                "`{piece}` in the heading `{heading}` is not understood: `{piece}` is no unit, factor or \
                 probability that is known; write the unit of the numbers alone (`mV`), `%` or `ppm` for \
                 shares of the estimates, a factor as `k=2`; a share of a range is written as a value"
            ),
        }
    }
}

fn of_pieces(
    pieces: impl Iterator<Item = String>,
    is_value: bool,
) -> Result<Option<String>, Refused> {
    let mut unit: Option<String> = None;
    for piece in pieces {
        if let HeadingPiece::Unit(found) = said(&piece, is_value)? {
            match &unit {
                Some(known) if *known != found => {
                    let reason = format!(
                        "`{known}` and `{found}` both are units: write the one of its numbers"
                    );
                    return Err(Refused::Reason(reason));
                }
                _ => unit = Some(found),
            }
        }
    }
    Ok(unit)
}

/// What stands outside of brackets, and inside of each, with the brackets of a divisor in it:
/// `u [mV/(m/s^2)]`.
fn parts(text: &str) -> (String, Vec<String>) {
    let (mut outside, mut insides) = (String::new(), Vec::<String>::new());
    // of each open bracket whether it belongs to a unit
    let mut open: Vec<bool> = Vec::new();
    for c in text.chars() {
        let c = if c.is_whitespace() { ' ' } else { c };
        let (opens, closes) = (matches!(c, '(' | '['), matches!(c, ')' | ']'));
        let Some(inside) = insides.last_mut().filter(|_| !open.is_empty()) else {
            if opens {
                open.push(false);
                insides.push(String::new());
            }
            outside.extend((!closes).then_some(if opens { ' ' } else { c }));
            continue;
        };
        if opens {
            open.push(inside.trim_end().ends_with(['/', '*', '·', '⋅']));
        }
        let is_kept = !(opens || closes) || open.last() == Some(&true);
        inside.extend(is_kept.then_some(c));
        if closes {
            open.pop();
        }
    }
    (outside.split_whitespace().collect::<Vec<_>>().join(" "), insides)
}

/// The pieces of a text between strokes, commas, semicolons and `in`; a comma between digits is a decimal
/// one. At least one, which may be empty.
fn separated(text: &str) -> Vec<String> {
    let mut text = format!(" {text} ");
    for sign in [" / ", " - ", " – ", " — ", " in ", " en ", ": "] {
        text = text.replace(sign, " ; ");
    }
    let mut pieces = vec![String::new()];
    let mut before = ' ';
    let mut signs = text.chars().peekable();
    while let Some(sign) = signs.next() {
        let is_decimal = before.is_ascii_digit() && signs.peek().is_some_and(char::is_ascii_digit);
        if sign == ';' || sign == ',' && !is_decimal {
            pieces.push(String::new());
        } else {
            pieces.last_mut().into_iter().for_each(|piece| piece.push(sign));
        }
        before = sign;
    }
    pieces
}

/// What stands behind the words of a column, of which the longest are taken; `None` where it begins with
/// none.
fn behind_words(text: &str) -> Option<&str> {
    words::of_columns()
        .map(|(word, _)| word)
        .chain(VALUES)
        .filter_map(|word| behind(text, word))
        .filter(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
        .min_by_key(|rest| rest.len())
}

/// What stands behind a word in whatever letters.
fn behind<'t>(text: &'t str, word: &str) -> Option<&'t str> {
    let mut rest = text.chars();
    let is_it = word
        .chars()
        .all(|small| rest.next().is_some_and(|c| c.to_lowercase().eq(std::iter::once(small))));
    is_it.then_some(rest.as_str())
}

/// What a piece says.
fn said(piece: &str, is_value: bool) -> Result<HeadingPiece, Refused> {
    const SYMBOLS: [&str; 8] = ["a", "u", "U", "k", "x", "X", "y", "n"];
    // a unit as well
    const OF_UNCERTAINTIES: [&str; 5] = ["c", "d", "s", "A", "B"];
    // a probability stands behind other words
    let statement = Statement::of(&format!("; {piece}")).map_err(Refused::Reason)?;
    let trimmed = |text: &str| {
        let text = text.trim_matches([' ', '±', ';', ':', '.', ',', '=', '-', '–', '·', '|']);
        let text = text.strip_prefix("+/").unwrap_or(text).trim_start_matches(['-', '/', ' ']);
        text.strip_prefix("in ").unwrap_or(text).trim().to_owned()
    };
    let rest = trimmed(&statement.rest);
    let mut text = rest.as_str();
    // `u mV` is no product
    let is_of_words = |word: &str| is_symbol(word) || matches!(word, "u" | "U" | "x" | "X" | "a");
    while let Some((_, behind)) = text.split_once(' ').filter(|(word, behind)| {
        // `x 1000` multiplies
        is_of_words(word) && !behind.trim_start().starts_with(|c: char| c.is_ascii_digit())
    }) {
        text = behind.trim_start_matches([' ', '/', ',']);
    }
    let is_symbol =
        is_symbol(text) || SYMBOLS.contains(&text) || !is_value && OF_UNCERTAINTIES.contains(&text);
    if text.is_empty() || text == "1" || is_symbol {
        return Ok(HeadingPiece::Nothing);
    }
    let is_power = ["1/", "10^", "10⁻"].iter().any(|begin| text.starts_with(begin));
    let is_number = text.starts_with(|c: char| c.is_ascii_digit()) && !is_power;
    if !is_number && Unit::parse(text).is_ok() {
        return Ok(HeadingPiece::Unit(text.to_owned()));
    }
    if let Some(meant) = unit_as_meant(text).filter(|_| !is_number) {
        return Ok(HeadingPiece::Unit(meant));
    }
    let (share, of) = text.split_once(' ').unwrap_or((text, ""));
    // `% v.M.` without its last point
    let is_of = is_of_estimate(of) || is_of_estimate(&format!("{of}."));
    if matches!(share, "%" | "‰" | "ppm" | "ppb") && is_of {
        return Ok(HeadingPiece::Unit(share.to_owned()));
    }
    if matches!(text.to_lowercase().as_str(), "percent" | "per cent" | "prozent" | "pour cent") {
        return Ok(HeadingPiece::Unit("%".to_owned()));
    }
    match NamedShape::of(text).filter(|_| text.chars().count() > 2) {
        Some(NamedShape::Known("normal")) => return Ok(HeadingPiece::Nothing),
        Some(NamedShape::Known(_)) => {
            let reason = format!(
                "the distribution `{text}` is read in a column `Distribution`: write it into the rows"
            );
            return Err(Refused::Reason(reason));
        }
        _ => {}
    }
    let small = text.to_lowercase();
    // conditions, and the number of readings that a standard deviation is of
    let is_condition = ["at ", "bei ", "à ", "@"].iter().any(|word| small.starts_with(word));
    let is_count = small
        .strip_prefix('n')
        .is_some_and(|rest| rest.trim_start().starts_with('=') || matches!(rest, "-1" | "−1"));
    if is_condition || is_count {
        return Ok(HeadingPiece::Nothing);
    }
    let mut words = text.split([' ', '/', '-', '·']).filter(|word| !word.is_empty());
    if words.any(may_be_unit) {
        return Err(Refused::Unknown(text.to_owned()));
    }
    Ok(HeadingPiece::Nothing)
}

/// Whether a word is the name of a unit, `millivolts`, which is read by its symbol alone.
fn is_name_of_unit(small: &str) -> bool {
    let mut prefixes = words::of("heading:unit-prefix");
    let bare = prefixes.find_map(|prefix| small.strip_prefix(prefix)).unwrap_or(small);
    words::of("heading:unit-name").any(|name| {
        [small, bare].iter().any(|form| *form == name || form.trim_end_matches('s') == name)
    })
}

/// Whether a word says what kind of numbers stand in a column: `rms`, `rel`.
pub(super) fn is_scale(word: &str) -> bool {
    words::of("heading:scale").any(|scale| scale == word.to_lowercase())
}

/// Whether a word that is none of those known may be a unit, or change what numbers mean.
pub(super) fn may_be_unit(word: &str) -> bool {
    let small = word.trim_matches(['.', '\'', '"', '*', '†', '|']).to_lowercase();
    if small.is_empty()
        || is_symbol(word)
        || words::of("heading:filler").any(|filler| filler == small)
    {
        return false;
    }
    let has_sign = small.contains(|c: char| c.is_ascii_digit() || "%‰×^°µμω²³⁻".contains(c));
    has_sign
        || small.chars().count() <= 3
        || is_scale(&small)
        // `milliV`
        || word.trim_start_matches(|c: char| !c.is_lowercase()).contains(char::is_uppercase)
        || is_name_of_unit(&small)
        || Unit::parse(word).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_wherever_they_stand() {
        for (text, unit) in [
            ("Standard uncertainty mV", Some("mV")),
            ("Uncertainty - mV", Some("mV")),
            ("± mV", Some("mV")),
            ("Half-width mV", Some("mV")),
            ("U (mV, k=2)", Some("mV")),
            ("U (k=2, mV)", Some("mV")),
            ("Uncertainty (mV, 95 %)", Some("mV")),
            ("Uncertainty (k=2, %)", Some("%")),
            ("Uncertainty (k=2.0 mV)", Some("mV")),
            ("Uncertainty %", Some("%")),
            ("Uncertainty (percent)", Some("%")),
            ("Uncertainty ppm", Some("ppm")),
            ("Uncertainty % rdg", Some("%")),
            ("Uncertainty µm", Some("µm")),
            ("Estimate/mm", Some("mm")),
            ("u_i/mV", Some("mV")),
            ("u(x_i) / µV", Some("µV")),
            ("Value (s)", Some("s")),
            ("Standard uncertainty u(x) mV", Some("mV")),
            ("Expanded uncertainty U mV", Some("mV")),
            ("Uncertainty (10^-3 V)", Some("10^-3 V")),
            ("x, mV", Some("mV")),
            ("Standard uncertainty u(x_i)", None),
            ("Estimate x_i", None),
            ("Half-width (a)", None),
            ("Half-width a", None),
            ("Uncertainty of measurement (certificate)", None),
            ("Uncertainty (at 50 % RH)", None),
            ("Standard deviation (n = 10)", None),
            ("Resolution / half-width", None),
            ("|ci|·u(xi)", None),
            ("Measured value (ohm)", Some("ohm")),
            ("Standard uncertainty [mV/(m/s^2)]", Some("mV/(m/s^2)")),
            ("U (k=2) (W/(m*K))", Some("W/(m*K)")),
            ("Half-width (a_i (mm))", Some("mm")),
            ("Std. dev. (n-1)", None),
            ("Std. uncertainty u(x_i)", None),
            ("Standard uncertainty (type A)", None),
            ("Standard uncertainty (repeatability, cal. lab)", None),
            ("Uncertainty (k=2) from certificate", None),
            ("Contribution to the combined uncertainty u_i(y)", None),
            ("Beitrag zur Standardunsicherheit u_i(y)", None),
            ("Half-width of the interval a_i", None),
            ("Limits of error (secondary parameter, sample)", None),
            ("Value (at 20 °C)", None),
            ("Value (nominal)", None),
            ("Value (-)", None),
            ("Best estimate of X_i", None),
        ] {
            let found = unit_of_header(text, text.starts_with("Value"));
            assert_eq!(found, Ok(unit.map(str::to_owned)), "{text}");
        }
        for (text, said) in [
            ("Uncertainty (mV rms)", "`mV rms` in the heading"),
            ("Uncertainty (mV, rect.)", "the distribution `rect`"),
            ("Uncertainty (rectangular)", "the distribution `rectangular`"),
            ("Uncertainty (millivolts)", "`millivolts` in the heading"),
            ("Uncertainty (milliV)", "`milliV` in the heading"),
            ("Uncertainty (1e-6)", "`1e-6` in the heading"),
            ("Uncertainty x 1000", "`x 1000` in the heading"),
            ("Uncertainty (relative)", "`relative` in the heading"),
            ("Uncertainty (of reading)", "`of reading` in the heading"),
            ("Uncertainty (range)", "`range` in the heading"),
            ("Uncertainty % FS", "`% FS` in the heading"),
            ("Uncertainty (x10^-6)", "`x10^-6` in the heading"),
            ("Value [mV] (V)", "`mV` and `V` both are units"),
            ("U (k=2,95 %)", "can say k = 2"),
        ] {
            let found = unit_of_header(text, false).unwrap_err();
            assert!(found.contains(said), "{text}: {found}");
        }
    }
}
