//! The words of a certificate, one file for each language. Sentences are the project's own; what they
//! have to say is asked by EA-4/02 M:2022, clause 6, and ILAC-P14:09/2020, clause 5.

mod english;
mod german;

use gumption_analysis::certificate::contents::Language;

/// The words of a language. Names in braces are filled in.
#[derive(Debug)]
pub(super) struct Words {
    pub(super) title: &'static str,
    pub(super) number: &'static str,
    pub(super) device: &'static str,
    pub(super) manufacturer: &'static str,
    pub(super) model: &'static str,
    pub(super) serial_number: &'static str,
    pub(super) customer_number: &'static str,
    pub(super) customer: &'static str,
    pub(super) laboratory: &'static str,
    pub(super) code: &'static str,
    pub(super) responsible: &'static str,
    pub(super) calibrated: &'static str,
    /// From one day to another: `{first}`, `{last}`.
    pub(super) period: &'static str,
    pub(super) issued: &'static str,
    pub(super) place: &'static str,
    /// In the order of [`PerformanceLocation::ALL`](gumption_analysis::certificate::contents::PerformanceLocation::ALL).
    pub(super) places: [&'static str; 5],
    pub(super) environment: &'static str,
    pub(super) method: &'static str,
    pub(super) traceability: &'static str,
    pub(super) remarks: &'static str,

    pub(super) results: &'static str,
    pub(super) row: &'static str,
    pub(super) quantity: &'static str,
    pub(super) conditions: &'static str,
    pub(super) nominal: &'static str,
    pub(super) value: &'static str,
    pub(super) expanded: &'static str,
    pub(super) unit: &'static str,
    pub(super) probability: &'static str,
    pub(super) low: &'static str,
    pub(super) high: &'static str,

    pub(super) uncertainty: &'static str,
    /// Begins a sentence about one row, and about several: `{rows}`.
    pub(super) rows: [&'static str; 2],
    pub(super) and: &'static str,
    /// `{k}`, `{p}`
    pub(super) normal: &'static str,
    /// `{p}`
    pub(super) student: &'static str,
    /// `{k}`
    pub(super) fixed: &'static str,
    /// `{p}`
    pub(super) shortest: &'static str,
    pub(super) propagation: &'static str,
    /// About all rows.
    pub(super) time: &'static str,
    pub(super) confirmed: &'static str,
    /// `{rule}`; digits stand in it.
    pub(super) rounding: &'static str,
    /// By rule, in the order of [`Rounding::ALL`](gumption_analysis::certificate::contents::Rounding::ALL).
    pub(super) rules: [&'static str; 3],
    /// One digit, and `{digits}` digits.
    pub(super) digits: [&'static str; 2],
    pub(super) raised: &'static str,
    /// `{p}`
    pub(super) approximately: &'static str,

    /// `{name}`
    pub(super) function: &'static str,
    /// `{equation}`, `{low}`, `{high}`
    pub(super) in_range: &'static str,
    /// `{k}`, and how k is said: `{coverage}`
    pub(super) band: &'static str,
    pub(super) parameter: &'static str,
    pub(super) standard: &'static str,
    pub(super) correlation: &'static str,
    pub(super) correlated: &'static str,
    /// `{rows}`: how many.
    pub(super) many: &'static str,
    pub(super) conformity: &'static str,
    pub(super) provenance: &'static str,
    pub(super) program: &'static str,
    pub(super) certificate_file: &'static str,
    pub(super) seed: &'static str,
    pub(super) trials: &'static str,
    pub(super) adaptive: &'static str,
}

/// The words of a language.
pub(super) fn of(language: Language) -> &'static Words {
    match language {
        Language::English => &english::WORDS,
        Language::German => &german::WORDS,
    }
}

/// A word in all languages, one below the other.
pub(super) fn stacked(languages: &[Language], word: impl Fn(&Words) -> &'static str) -> String {
    each(languages, word).join(" /\n")
}

/// A word in all languages on one line.
pub(super) fn beside(languages: &[Language], word: impl Fn(&Words) -> &'static str) -> String {
    each(languages, word).join(" / ")
}

fn each(languages: &[Language], word: impl Fn(&Words) -> &'static str) -> Vec<&'static str> {
    let mut words: Vec<&'static str> = Vec::new();
    for language in languages {
        let next = word(of(*language));
        if !words.contains(&next) {
            words.push(next);
        }
    }
    words
}
