//! The columns of budgets, and what their headings are called.

use super::coverage::HeaderCoverage;
use super::{symbol, words};
use gumption_text::value_text::PLUS_MINUS;
use gumption_units::Unit;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Column {
    Quantity,
    Symbol,
    Description,
    Estimate,
    Unit,
    /// The unit of the uncertainties alone.
    UnitOfUncertainty,
    /// An uncertainty whose kind the row says: by a distribution, a divisor or a coverage factor.
    Uncertainty,
    HalfWidth,
    FullWidth,
    /// Expanded uncertainties.
    Expanded,
    /// Standard uncertainties.
    Standard,
    /// Standard deviations, of single readings or of their mean.
    Deviation,
    /// Standard uncertainties as shares of the estimates.
    Relative,
    /// The limits of the values of a quantity.
    Lower,
    Upper,
    Distribution,
    /// What uncertainties are divided by.
    Divisor,
    /// What uncertainties are multiplied by.
    Multiplier,
    /// Coverage factors of expanded uncertainties.
    Factor,
    Dof,
    Sensitivity,
    UnitOfSensitivity,
    /// Contributions to the standard uncertainty of the result; computed here, and compared.
    Contribution,
    /// Whether the evaluation is of type A or B.
    Type,
    /// Words on the quantity, which the model file keeps.
    Remark,
    /// Not read.
    Ignored,
}

/// The names of columns in `--column NAME=...` and in `words.csv`; the first of a column is the one that
/// messages have.
const NAMES: [(&str, Column); 32] = [
    ("quantity", Column::Quantity),
    ("name", Column::Quantity),
    ("symbol", Column::Symbol),
    ("description", Column::Description),
    ("estimate", Column::Estimate),
    ("unit", Column::Unit),
    ("uncertainty-unit", Column::UnitOfUncertainty),
    ("uncertainty", Column::Uncertainty),
    ("half-width", Column::HalfWidth),
    ("full-width", Column::FullWidth),
    ("U", Column::Expanded),
    ("standard-uncertainty", Column::Standard),
    ("u", Column::Standard),
    ("standard-deviation", Column::Deviation),
    ("relative-uncertainty", Column::Relative),
    ("lower", Column::Lower),
    ("upper", Column::Upper),
    ("distribution", Column::Distribution),
    ("divisor", Column::Divisor),
    ("multiplier", Column::Multiplier),
    ("k", Column::Factor),
    ("dof", Column::Dof),
    ("sensitivity", Column::Sensitivity),
    ("coefficient", Column::Sensitivity),
    ("sensitivity-unit", Column::UnitOfSensitivity),
    ("contribution", Column::Contribution),
    ("type", Column::Type),
    ("remark", Column::Remark),
    ("comment", Column::Remark),
    ("ignore", Column::Ignored),
    ("share", Column::Ignored),
    ("none", Column::Ignored),
];

impl Column {
    /// The columns that state how wide the values of a quantity are.
    pub(crate) const WIDTHS: [Self; 4] =
        [Self::Uncertainty, Self::HalfWidth, Self::FullWidth, Self::Expanded];

    /// Whether several columns may be of this kind.
    pub(super) fn may_repeat(self) -> bool {
        matches!(self, Self::Remark | Self::Description | Self::Ignored)
    }

    /// Whether its cells are numbers of a quantity, in units.
    pub(super) fn is_of_numbers(self) -> bool {
        self.is_of_values()
            || Self::WIDTHS.contains(&self)
            || matches!(
                self,
                Self::Standard | Self::Relative | Self::Deviation | Self::Contribution
            )
    }

    /// Whether its cells are values of a quantity, which may lie below zero.
    pub(super) fn is_of_values(self) -> bool {
        matches!(self, Self::Estimate | Self::Lower | Self::Upper)
    }

    /// That of a name, as `--column` has it.
    pub(super) fn named(name: &str) -> Option<Self> {
        NAMES.iter().find(|(known, _)| *known == name).map(|(_, column)| *column)
    }

    /// What `--column` and messages call it.
    pub(super) fn name(self) -> &'static str {
        NAMES.iter().find(|(_, column)| *column == self).map_or("", |(name, _)| name)
    }

    /// All names; of several of one column the first.
    pub(super) fn names() -> Vec<&'static str> {
        let mut names: Vec<&str> = Vec::new();
        for (_, column) in NAMES {
            if !names.contains(&column.name()) {
                names.push(column.name());
            }
        }
        names
    }

    /// All names, in a sentence.
    pub(super) fn all_names() -> String {
        Self::names().join(", ")
    }

    /// Whether `--column-unit` says the unit of its cells.
    pub(super) fn has_unit(self) -> bool {
        self.is_of_numbers() || self == Self::Sensitivity
    }
}

/// What the heading of a column names, by the table of words; what is not in it is `None`.
pub(crate) fn column(heading: &str) -> Option<Column> {
    let named = |text: &str| words::meaning("", text).and_then(Column::named);
    if let Some(found) = named(heading.trim()) {
        return Some(found);
    }
    // `Value (±)` is no value
    if PLUS_MINUS.into_iter().any(|sign| heading.contains(sign)) {
        return Some(Column::Uncertainty);
    }
    if let Some((column, _)) = symbol::of_uncertainties(heading) {
        return Some(column);
    }
    let clean = plain_case(heading);
    if let Some(found) = named(&clean) {
        return Some(found);
    }
    // as cells break words: `Standardmess-unsicherheit`
    let joined = clean.replace("- ", "").replace('-', "");
    if let Some(found) = named(&joined) {
        return Some(found);
    }
    // `u / mm`, `Estimate in mm`
    let before = symbol::before_unit(&clean);
    if before != clean {
        return column(before);
    }
    // `Estimate x_i`, `Uncertainty mV`: behind the words stands a symbol or a unit, and nothing else
    let known = words::of_columns().filter(|(word, _)| {
        let behind = strip_word(&clean, word);
        behind.is_some_and(|rest| rest.split_whitespace().all(is_symbol_or_unit))
    });
    let longest = known.max_by_key(|(word, _)| word.len());
    longest.and_then(|(_, name)| Column::named(name))
}

/// What stands behind a word that a text begins with, in whatever letters where the word has small ones.
fn strip_word<'t>(text: &'t str, word: &str) -> Option<&'t str> {
    let mut rest = text.chars();
    let is_one_letter = word.chars().count() < 3;
    let is_it = word.chars().all(|character| {
        rest.next()
            .is_some_and(|c| c == character || !is_one_letter && c.to_lowercase().eq([character]))
    });
    let rest = rest.as_str();
    let ends = rest.starts_with([' ', ',', ';']) && !rest.trim_matches([' ', ',', ';']).is_empty();
    (is_it && ends).then_some(rest.trim_matches([' ', ',', ';']))
}

fn is_symbol_or_unit(word: &str) -> bool {
    let word = word.trim_matches([',', ';']);
    is_symbol(word)
        || ["u", "U", "x", "X", "a", "c", "k", "ν", "in", "±"].contains(&word)
        || word.parse::<f64>().is_err() && Unit::parse(word).is_ok()
        || unit_as_meant(word).is_some()
}

/// A text without what stands in brackets.
pub(super) fn plain_case(text: &str) -> String {
    let mut depth = 0_u32;
    let mut plain = String::new();
    for c in text.chars() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            c if depth == 0 => plain.push(c),
            _ => {}
        }
    }
    let words: Vec<&str> = plain.split_whitespace().collect();
    words.join(" ").trim_end_matches([':', '.', ',', ';']).to_owned()
}

/// The same in small letters.
pub(crate) fn plain(text: &str) -> String {
    plain_case(text).to_lowercase()
}

/// Whether a heading speaks of nominal values.
pub(crate) fn is_nominal(heading: &str) -> bool {
    let words = plain(heading);
    let small = heading.to_lowercase();
    ["nominal", "nennwert", "valeur nominale"].iter().any(|start| words.starts_with(start))
        || ["(nominal", "(nennwert"].iter().any(|start| small.contains(start))
}

/// Whether a text is a symbol with an index or an argument, as `x_i`, `u(x_i)` and `u_i(y)`.
pub(super) fn is_symbol(text: &str) -> bool {
    let compact: String = text.split_whitespace().collect();
    words::of("heading:symbol").any(|symbol| symbol == compact.replace('_', ""))
}

/// A unit without the word before it: `in mV` is `mV`, and no product with an inch.
pub(crate) fn without_in(text: &str) -> &str {
    let behind = text.strip_prefix("in ").map(str::trim);
    let is_unit = |unit: &&str| Unit::parse(unit.trim_matches(['(', ')', '[', ']'])).is_ok();
    behind.filter(is_unit).unwrap_or(text)
}

/// Whether words behind a share say that it is one of the estimate.
pub(crate) fn is_of_estimate(words: &str) -> bool {
    let small = words.trim().to_lowercase();
    words::of("heading:share").any(|word| word == small)
}

/// Whether a text speaks of correlation.
pub(super) fn is_of_correlation(text: &str) -> bool {
    let words = text.to_lowercase();
    let compact: String = words.split_whitespace().collect();
    if words::of("text:no-correlation").any(|word| compact.contains(word)) {
        return false;
    }
    words::of("text:correlation").any(|word| words.contains(word))
        || compact.starts_with("r(") && compact.contains('=')
        || ["r(", "ρ("].iter().any(|begin| compact.starts_with(begin))
            && compact.ends_with(')')
            && compact.contains([',', ';'])
}

/// The probability that the symbol of an expanded uncertainty states: `U95`, `U_0.95`, `U95%`.
pub(super) fn probability_of_symbol(words: &str) -> Option<f64> {
    let index = words.trim().strip_prefix('U')?.trim_start_matches('_').trim_end_matches('%');
    let p = index.replace(',', ".").parse::<f64>().ok()?;
    let p = if p >= 50.0 { p / 100.0 } else { p };
    (0.5..1.0).contains(&p).then_some(p)
}

/// What a heading says of the coverage of its numbers.
pub(super) fn coverage(heading: &str) -> HeaderCoverage {
    match (HeaderCoverage::of(heading), probability_of_symbol(&plain_case(heading))) {
        (HeaderCoverage::None | HeaderCoverage::Expanded, Some(p)) => {
            HeaderCoverage::Probability(p)
        }
        (stated, _) => stated,
    }
}

/// A name and the unit that stands in brackets behind it, `dT [K]`, `A (mV)`; `None` where there is none. A
/// letter in parentheses is a symbol, `Length (L)`.
pub(super) fn with_unit_in_brackets(words: &str) -> Option<(&str, String)> {
    let brackets = |open: char, close: char| words.trim().strip_suffix(close)?.rsplit_once(open);
    let is_unit = |unit: &str| unit.trim().chars().count() > 1;
    let (name, unit) =
        brackets('[', ']').or_else(|| brackets('(', ')').filter(|(_, unit)| is_unit(unit)))?;
    // `u(V)` and `r(m)` are names, and so is `Value (2)`
    let is_argument = words.trim().ends_with(')') && !name.ends_with(char::is_whitespace);
    let (name, unit) = (name.trim(), without_in(unit.trim()));
    let is_value = unit.starts_with(|c: char| c.is_ascii_digit()) && !unit.starts_with("1/");
    if name.is_empty() || unit.is_empty() || is_argument || is_value {
        return None;
    }
    let unit = Unit::parse(unit).map(|_| unit.to_owned()).ok().or_else(|| unit_as_meant(unit))?;
    Some((name, unit))
}

/// A unit as tables have it that formulas could not: `/K` for `1/K`, `K-1` and `m/s2` for `K^-1` and
/// `m/s^2`, `mOhm` for `mohm`.
pub(super) fn unit_as_meant(text: &str) -> Option<String> {
    let written = text;
    let text = &text.replace("Ohm", "ohm");
    let mut meant = String::new();
    if text.starts_with('/') {
        meant.push('1');
    }
    let mut before = ' ';
    let mut signs = text.chars().peekable();
    while let Some(sign) = signs.next() {
        let next_is_digit = signs.peek().is_some_and(char::is_ascii_digit);
        let begins_power = sign.is_ascii_digit() || (matches!(sign, '-' | '−') && next_is_digit);
        if begins_power && before.is_alphabetic() {
            meant.push('^');
        }
        meant.push(if sign == '−' { '-' } else { sign });
        before = sign;
    }
    (meant != written && Unit::parse(&meant).is_ok()).then_some(meant)
}

/// Words as a name of formulas: other signs become `_`.
pub(super) fn identifier(words: &str) -> String {
    let mut name = String::new();
    for c in words.trim().chars() {
        if c.is_alphabetic() || c.is_ascii_digit() || c == '_' {
            name.push(c);
        } else if !name.ends_with('_') {
            name.push('_');
        }
    }
    let name = name.trim_matches('_');
    if name.starts_with(|c: char| c.is_ascii_digit()) {
        format!("x_{name}")
    } else {
        name.to_owned()
    }
}
