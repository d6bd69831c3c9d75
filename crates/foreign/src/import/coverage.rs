//! What a heading or a cell says of the coverage of uncertainties: `k=2`, `2σ`, `95 %`, `dof=10`.
//!
//! A stated factor goes before a probability. A comma between two digits is a decimal one, a comma before
//! a space separates. What may be either, `k=2,95 %`, is refused: 2.95 and 2 differ by half.

use std::ops::Range;

use super::columns::plain_case;
use super::symbol::before_unit;
use gumption_engine::number::smallest_first;
use gumption_engine::special::student;

/// What is said of the coverage of expanded uncertainties.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum HeaderCoverage {
    /// Nothing: the text does not speak of expanded uncertainties.
    None,
    /// The factor: `U (k=2)`.
    Factor(f64),
    /// The coverage probability, and no factor: `U (p=95 %)`.
    Probability(f64),
    /// That they are expanded, and no more.
    Expanded,
}

/// What a text says of the coverage, and what else stands in it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Statement {
    pub(crate) coverage: HeaderCoverage,
    /// The degrees of freedom that the factor goes with.
    pub(crate) dof: Option<f64>,
    /// The text without all of that; a semicolon stands in its place.
    pub(crate) rest: String,
}

/// A number that was found, and where what says it stands.
type FoundNumber = Option<(f64, Range<usize>)>;

impl HeaderCoverage {
    /// Of a header's cell; nothing where it can be read in two ways, which [`Statement::of`] tells.
    pub(crate) fn of(text: &str) -> Self {
        Statement::of(text).map_or(Self::None, |statement| statement.coverage)
    }

    /// The factor of uncertainties with these degrees of freedom, `None` where they are infinite: of a
    /// probability that of the t distribution (JCGM 100, G.3.2).
    pub(crate) fn factor(self, dof: Option<f64>) -> Option<f64> {
        match self {
            Self::Factor(factor) => Some(factor),
            Self::Probability(p) => {
                let dof = dof.filter(|dof| *dof > 0.0).unwrap_or(f64::INFINITY);
                Some(student::two_sided_factor(p, dof))
            }
            Self::None | Self::Expanded => None,
        }
    }

    /// The coverage probability, if that is what is stated.
    pub(crate) fn probability(self) -> Option<f64> {
        if let Self::Probability(p) = self { Some(p) } else { None }
    }

    /// Whether a text speaks of expanded uncertainties without a factor or a probability.
    fn expanded(text: &str) -> Self {
        let compact: String = text.to_lowercase().split_whitespace().collect();
        let words = [
            "expanded",
            "erweiterte",
            "erw.",
            "incertitudeélargie",
            "incertitudeelargie",
            "incertidumbreexpandida",
        ];
        // `Uncertainty U`: the symbol stands behind the words
        let symbol = plain_case(before_unit(text));
        let symbol = symbol.split_whitespace().next_back();
        if words.iter().any(|word| compact.starts_with(word)) || symbol == Some("U") {
            Self::Expanded
        } else {
            Self::None
        }
    }
}

impl Statement {
    /// What a text says.
    ///
    /// # Errors
    /// What can be read in two ways, or is no factor, as a sentence.
    pub(crate) fn of(text: &str) -> Result<Self, String> {
        // of the same length in bytes
        let small = text.to_ascii_lowercase().replace('\u{a0}', "  ");
        let small = small.replace(['\u{202f}', '\u{2009}'], "   ");
        let (factor, sigmas) = (factor(&small)?, standard_deviations(&small));
        if let (Some((k, _)), Some((sigmas, _))) = (&factor, &sigmas)
            && k != sigmas
        {
            return Err(format!("`{text}` says k = {k} and {sigmas} σ: which factor is it?"));
        }
        let (p, dof) = (probability(&small), degrees_of_freedom(&small));
        let coverage = match (&factor, &sigmas, &p) {
            (Some((k, _)), _, _) | (None, Some((k, _)), _) => HeaderCoverage::Factor(*k),
            (None, None, Some((p, _))) => HeaderCoverage::Probability(*p),
            (None, None, None) => HeaderCoverage::expanded(text),
        };
        let mut spans: Vec<Range<usize>> =
            [&factor, &sigmas, &p, &dof].into_iter().flatten().map(|(_, at)| at.clone()).collect();
        smallest_first(&mut spans, |span| span.start as f64);
        let mut rest = text.to_owned();
        for span in spans.into_iter().rev() {
            if rest.get(span.clone()).is_some() {
                rest.replace_range(span, ";");
            }
        }
        Ok(Self { coverage, dof: dof.map(|(dof, _)| dof), rest })
    }
}

/// The number that a text begins with, and what stands behind it. A mark belongs to it between two digits.
fn number_at(text: &str) -> Option<(&str, &str)> {
    let digits = |text: &str| text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    let whole = digits(text);
    let behind = text[whole..].strip_prefix(['.', ',']).map_or(0, digits);
    let end = if behind > 0 { whole + 1 + behind } else { whole };
    (whole > 0).then(|| text.split_at(end))
}

/// The number that a text ends in, and where it begins.
fn number_before(text: &str) -> Option<(f64, usize)> {
    let text = text.trim_end_matches([' ', '-', '·']);
    let is_part = |c: char| c.is_ascii_digit() || matches!(c, '.' | ',');
    let length: usize = text.chars().rev().take_while(|c| is_part(*c)).map(char::len_utf8).sum();
    let number = text[text.len() - length..].trim_start_matches(['.', ',']);
    Some((value(number)?, text.len() - number.len()))
}

fn value(number: &str) -> Option<f64> {
    number.replace(',', ".").parse().ok()
}

/// Whether a word may begin at this place of a text.
fn begins_word(text: &str, at: usize) -> bool {
    !text[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_')
}

/// The coverage factor that stands behind `k=` or behind its words.
fn factor(text: &str) -> Result<FoundNumber, String> {
    const WORDS: [&str; 9] = [
        "coverage factor",
        "Überdeckungsfaktor",
        "k-factor",
        "k factor",
        "erweiterungsfaktor",
        "überdeckungsfaktor",
        "facteur d'élargissement",
        "kp",
        "k",
    ];
    for word in WORDS {
        for (at, _) in text.match_indices(word).filter(|(at, _)| begins_word(text, *at)) {
            let behind = text[at + word.len()..].trim_start();
            let signed = behind.strip_prefix("k ").map_or(behind, str::trim_start);
            let signed = signed.strip_prefix("k=").or(signed.strip_prefix(['=', '≈', ':']));
            // the words alone say what the number is
            let number = match signed {
                Some(number) => number.trim_start(),
                None if word.len() > 2 => behind.strip_prefix("of ").unwrap_or(behind),
                None => continue,
            };
            let Some((number, behind)) = number_at(number) else { continue };
            return checked(text, number, behind).map(|k| Some((k, at..text.len() - behind.len())));
        }
    }
    Ok(None)
}

/// A factor whose comma separates nothing, and which is no share and no range.
fn checked(text: &str, number: &str, behind: &str) -> Result<f64, String> {
    let next = behind.trim_start();
    let text = text.trim_matches([' ', ';']);
    let goes_on = next.starts_with(|c: char| c.is_alphabetic() || matches!(c, '%' | '°' | '‰'));
    let is_second_comma =
        behind.strip_prefix(',').is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
    if let Some((whole, rest)) = number.split_once(',')
        && (goes_on || is_second_comma)
    {
        let word = next.split_whitespace().next().unwrap_or_default();
        let word = word.trim_end_matches([')', ']']);
        return Err(format!(
            "`{text}` can say k = {whole} and `{rest} {word}`, or k = {whole}.{rest}: write a space behind a \
             comma that separates, or a decimal point"
        ));
    }
    if next.starts_with(['%', '‰']) {
        return Err(format!("`{text}`: a coverage factor such as `k=2` is no share"));
    }
    if next.starts_with(['-', '–', '…']) {
        return Err(format!("`{text}`: a coverage factor is one number, such as `k=2`"));
    }
    value(number)
        .filter(|k| *k > 0.0)
        .ok_or_else(|| format!("`{text}`: a coverage factor is above 0"))
}

/// A number of standard deviations, `2σ` or `1.96 sigma`.
fn standard_deviations(text: &str) -> FoundNumber {
    ["σ", "sigma"].into_iter().find_map(|sign| {
        text.match_indices(sign).find_map(|(at, _)| {
            let (number, start) = number_before(&text[..at])?;
            (number > 0.0).then_some((number, start..at + sign.len()))
        })
    })
}

/// A coverage probability behind `p=`, or one of 50 % or more behind other words. A relative humidity and
/// a share of a reading are none.
fn probability(text: &str) -> FoundNumber {
    let stated =
        text.match_indices('p').filter(|(at, _)| begins_word(text, *at)).find_map(|(at, _)| {
            let number = text[at + 1..].trim_start().strip_prefix('=')?.trim_start();
            let (number, behind) = number_at(number)?;
            let behind = behind.trim_start();
            let behind = behind.strip_prefix('%').unwrap_or(behind);
            Some((value(number)?, at..text.len() - behind.len()))
        });
    let bare = || {
        text.match_indices('%').find_map(|(at, _)| {
            let (number, start) = number_before(&text[..at])?;
            let before = text[..start].trim_end();
            let is_width = before.is_empty() || before.ends_with(['±', '+', '-', '<', '≤']);
            let behind = of_coverage(&text[at + 1..])?;
            (number >= 50.0 && !is_width).then(|| (number, start..text.len() - behind.len()))
        })
    };
    let (p, span) = stated.or_else(bare)?;
    let share = if p > 1.0 { p / 100.0 } else { p };
    (share > 0.0 && share < 1.0).then_some((share, span))
}

/// What follows behind a coverage probability and its words, `confidence level`; `None` where it is the
/// share of something, `% rh`.
fn of_coverage(behind: &str) -> Option<&str> {
    const WORDS: [&str; 14] = [
        "conf",
        "cov",
        "level",
        "prob",
        "interv",
        "ci",
        "cl",
        "two",
        "überd",
        "vertrauen",
        "niveau",
        "wahrsch",
        "de confiance",
        "erweit",
    ];
    const JOINS: [&str; 8] = ["k", "and", "und", "et", "normal", "with", "mit", "at"];
    let mut rest = behind;
    loop {
        let next = rest.trim_start();
        if !next.starts_with(char::is_alphabetic) {
            return Some(rest);
        }
        let end = next.find(|c: char| !c.is_alphanumeric()).unwrap_or(next.len());
        let word = &next[..end];
        if JOINS.contains(&word) || word.starts_with("dof") || word.starts_with('ν') {
            return Some(rest);
        }
        let known = WORDS.iter().find(|word| next.starts_with(**word))?;
        rest = &next[end.max(known.len())..];
    }
}

/// Degrees of freedom, `dof=10`, `ν = 9` or `20 degrees of freedom`.
fn degrees_of_freedom(text: &str) -> FoundNumber {
    const BEHIND: [&str; 4] = ["degrees of freedom", "deg of freedom", "freiheitsgrade", "dof"];
    const BEFORE: [&str; 9] = [
        "degrees of freedom",
        "freiheitsgrade",
        "νeff",
        "ν_eff",
        "ν",
        "veff",
        "v_eff",
        "dof",
        "df",
    ];
    let stated = BEFORE.into_iter().find_map(|word| {
        let at = text.match_indices(word).find(|(at, _)| begins_word(text, *at))?.0;
        let number = text[at + word.len()..].trim_start();
        let (number, behind) = number_at(number.trim_start_matches(['=', ':', '≥', '>', ' ']))?;
        Some((value(number)?, at..text.len() - behind.len()))
    });
    stated.or_else(|| {
        BEHIND.into_iter().find_map(|word| {
            let at = text.find(word)?;
            let (number, start) = number_before(&text[..at])?;
            Some((number, start..at + word.len()))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use HeaderCoverage::{Expanded, Factor, None as Nothing, Probability};

    #[test]
    fn factors_go_before_probabilities() {
        for (text, coverage, rest) in [
            ("U (k=2, 95 %)", Factor(2.0), "U (;, ;)"),
            ("normal (k=2, 95.45 %)", Factor(2.0), "normal (;, ;)"),
            ("U (k=2,05)", Factor(2.05), "U (;)"),
            ("U (k = 2,05, 95 %)", Factor(2.05), "U (;, ;)"),
            ("U (k=2, %)", Factor(2.0), "U (;, %)"),
            ("U (k=2, 23 °C)", Factor(2.0), "U (;, 23 °C)"),
            ("U (k=2.0 mV)", Factor(2.0), "U (; mV)"),
            ("normal (2.58σ)", Factor(2.58), "normal (;)"),
            ("U (1,96 sigma)", Factor(1.96), "U (;)"),
            ("Uncertainty ±2σ", Factor(2.0), "Uncertainty ±;"),
            ("normal (coverage factor 2)", Factor(2.0), "normal (;)"),
            ("normal (coverage factor k = 2)", Factor(2.0), "normal (;)"),
            ("U (95,45 %)", Probability(0.9545), "U (;)"),
            ("U (k\u{a0}=\u{202f}2, 95\u{2009}%)", Factor(2.0), "U (;, ;)"),
            ("Überdeckungsfaktor 2", Factor(2.0), ";"),
            ("U (95 % confidence level)", Probability(0.95), "U (;)"),
            ("0.02 % (95 %)", Probability(0.95), "0.02 % (;)"),
            ("U (p=95 %)", Probability(0.95), "U (;)"),
            ("U (p = 0.95)", Probability(0.95), "U (;)"),
            ("Uncertainty (at 50 % RH)", Nothing, "Uncertainty (at 50 % RH)"),
            ("rectangular (60 % of reading)", Nothing, "rectangular (60 % of reading)"),
            ("± 60 %", Nothing, "± 60 %"),
            ("Uncertainty U", Expanded, "Uncertainty U"),
        ] {
            let found = Statement::of(text).unwrap();
            assert_eq!((found.coverage, found.rest.as_str()), (coverage, rest), "{text}");
        }
        for (text, said) in [
            ("U (k=2,95 %)", "can say k = 2 and `95 %`, or k = 2.95"),
            ("U (k=2,05,95 %)", "can say k = 2"),
            ("U (k=2,23 °C)", "can say k = 2 and `23 °c`"),
            ("U (k=2 %)", "is no share"),
            ("U (k=0)", "is above 0"),
            ("U (k=2-3)", "is one number"),
            ("U (k=2, 3σ)", "says k = 2 and 3 σ"),
        ] {
            let found = Statement::of(text).unwrap_err();
            assert!(found.contains(said), "{text}: {found}");
        }
    }

    #[test]
    fn degrees_of_freedom_stand_with_factors() {
        for (text, dof) in [
            ("normal (k=2.28; dof=10)", Some(10.0)),
            ("t (k=2.13, ν = 9)", Some(9.0)),
            ("normal (k=2, 20 deg of freedom)", Some(20.0)),
            ("normal (k=2)", None),
        ] {
            let found = Statement::of(text).unwrap();
            assert_eq!(found.dof, dof, "{text}");
            assert!(matches!(found.coverage, Factor(_)), "{text}");
        }
    }
}
