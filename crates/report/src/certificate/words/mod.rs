//! The words of a certificate, one file for each language. The sentences are the project's own;
//! their content is required by EA-4/02 M:2022, clause 6, ILAC-P14:09/2020, clause 5, and ISO/IEC
//! 17025:2017, 7.8.

mod english;
mod french;
mod german;
mod italian;

use gumption_analysis::certificate::contents::{Language, Localized};

/// The words of a language. Names in braces are placeholders.
#[derive(Debug)]
pub(super) struct Words {
    pub(super) title: &'static str,
    pub(super) number: &'static str,
    pub(super) device: &'static str,
    pub(super) manufacturer: &'static str,
    pub(super) model: &'static str,
    /// The condition of the device on receipt.
    pub(super) condition: &'static str,
    pub(super) serial_number: &'static str,
    pub(super) customer_number: &'static str,
    pub(super) customer: &'static str,
    pub(super) laboratory: &'static str,
    pub(super) accreditation: &'static str,
    pub(super) code: &'static str,
    pub(super) responsible: &'static str,
    pub(super) calibrated: &'static str,
    /// From one day to another: `{first}`, `{last}`.
    pub(super) period: &'static str,
    /// Date of receipt of the device.
    pub(super) received: &'static str,
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
    /// `{unit}`
    pub(super) in_unit: &'static str,
    pub(super) limits_heading: &'static str,
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
    /// `{k}`; if the corresponding probability is stated.
    pub(super) agreed: &'static str,
    /// `{p}`
    pub(super) shortest: &'static str,
    /// `{p}`; the same for results without the noise of trials
    pub(super) without_trials: &'static str,
    pub(super) propagation: &'static str,
    /// About all rows.
    pub(super) time: &'static str,
    pub(super) confirmed: &'static str,
    /// `{rule}`; digits stand in it.
    pub(super) rounding: &'static str,
    /// By rule, in the order of [`Rounding::ALL`](gumption_analysis::certificate::contents::Rounding::ALL).
    pub(super) rules: [&'static str; 3],
    /// That rounding violates the rule where U would be below the capability.
    pub(super) kept: &'static str,
    /// One digit, and `{digits}` digits.
    pub(super) digits: [&'static str; 2],
    /// `{factor}`, and with the minimum actual probability: `{p}`.
    pub(super) raised: [&'static str; 2],
    /// The factor of a capability as stated, and after conversion from 2 to another: `{k}`.
    pub(super) of_capability: [&'static str; 2],
    /// `{list}`; if no table contains them.
    pub(super) dof_list: &'static str,
    /// `{p}`
    pub(super) approximately: &'static str,

    /// `{name}`
    pub(super) function: &'static str,
    /// `{equation}`, `{low}`, `{high}`
    pub(super) in_range: &'static str,
    /// `{k}`, and the sentence about k: `{coverage}`
    pub(super) band: &'static str,
    pub(super) parameter: &'static str,
    pub(super) standard: &'static str,
    pub(super) region: &'static str,
    pub(super) ellipsoid: &'static str,
    pub(super) cuboid: &'static str,
    /// `{volume}`
    pub(super) smallest: &'static str,
    pub(super) measurement: &'static str,
    pub(super) equation: &'static str,
    pub(super) symbol: &'static str,
    pub(super) meaning: &'static str,
    pub(super) correlation: &'static str,
    pub(super) correlated: &'static str,
    pub(super) correlated_raised: &'static str,
    /// `{inputs}`: which inputs the rows share.
    pub(super) shared: &'static str,
    /// `{rows}`: how many.
    pub(super) many: &'static str,
    pub(super) conformity: &'static str,
    /// In a table: that a value conforms, that it does not, and that it is not shown to conform.
    pub(super) decided: [&'static str; 3],
    /// That a value conforms to a tolerance, and that it does not: `{limits}`.
    pub(super) decisions: [&'static str; 2],
    /// That a value within the tolerance is rejected: it lies outside the acceptance limits, or
    /// there are none; `{limits}`.
    pub(super) not_shown: [&'static str; 2],
    /// In a table: the levels of a non-binary statement, best first (ILAC-G8:09/2019, 4.2.3).
    pub(super) levels: [&'static str; 4],
    /// The same as sentences: `{limits}`.
    pub(super) level_decisions: [&'static str; 4],
    /// Limits with their unit: both, the lower one, the upper one; `{low}`, `{high}`, `{unit}`.
    pub(super) limits: [&'static str; 3],
    /// The probability that an accepted value conforms: `{p}`, one of `percent`.
    pub(super) conforming: &'static str,
    /// The risk that a rejected value conforms: `{p}`, one of `percent`.
    pub(super) all_the_same: &'static str,
    /// That the decision used other digits than the stated ones: `{value}`.
    pub(super) unrounded: &'static str,
    /// The prior knowledge behind the probability besides the measurement, and the probability
    /// without it: `{prior}`, `{p}`.
    pub(super) with_prior: &'static str,
    /// `{shape}`, `{mean}`, `{std}`
    pub(super) prior: &'static str,
    /// `{a}`, `{b}`
    pub(super) global_risks: &'static str,
    /// A probability, one above a number and one below it: `{p}`.
    pub(super) percent: [&'static str; 3],
    pub(super) simple: &'static str,
    /// A guard band by U: `{band}`, `{clause}`, `{guard}`, `{limits}`
    pub(super) multiple: &'static str,
    /// The same for a guard band that leaves no acceptance interval: `{band}`, `{clause}`,
    /// `{guard}`
    pub(super) too_wide: &'static str,
    /// The same for a rule that has no guard band for so large a U: `{band}`, `{clause}`.
    pub(super) no_band: &'static str,
    /// The name of a rule, and how it differs if U is not for approximately 95 %: `{rule}`, `{k}`.
    pub(super) of_rule: [&'static str; 2],
    /// The clause for this guard band, and how it differs if U is not for approximately 95 %:
    /// `{k}`.
    pub(super) of_ilac_g8: [&'static str; 2],
    pub(super) rule_agreed: &'static str,
    /// The specification to which the tolerance belongs: `{name}`
    pub(super) specification: &'static str,
    /// `{kind}`, `{risk}`, `{guard}`, `{limits}`
    pub(super) guarded: &'static str,
    /// A guarded rule by which no value is accepted: `{kind}`, `{risk}`.
    pub(super) never: &'static str,
    /// For one value, and for all values under decision.
    pub(super) kinds: [&'static str; 2],

    /// `{page}`, `{pages}`
    pub(super) page: &'static str,
    pub(super) end: &'static str,
    pub(super) signed: [&'static str; 2],
    /// ISO/IEC 17025, 7.8.2.1 l.
    pub(super) relates: &'static str,
    /// ISO/IEC 17025, 7.8.2.1, note 1.
    pub(super) copies: &'static str,
    pub(super) provenance: &'static str,
    pub(super) program: &'static str,
    pub(super) certificate_file: &'static str,
    pub(super) certificate_name: &'static str,
    pub(super) model_file: &'static str,
    pub(super) table: &'static str,
    pub(super) seed: &'static str,
    pub(super) trials: &'static str,
    pub(super) adaptive: &'static str,

    pub(super) nominal_value: &'static str,
    pub(super) measured_value: &'static str,
    pub(super) coverage_interval: &'static str,
    pub(super) files: &'static str,
    pub(super) answer: &'static str,
}

/// The words of a language.
pub(super) fn of(language: Language) -> &'static Words {
    match language {
        Language::English => &english::WORDS,
        Language::German => &german::WORDS,
        Language::Italian => &italian::WORDS,
        Language::French => &french::WORDS,
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

/// A unit below the heading of a column, in the first language.
pub(super) fn in_unit(languages: &[Language], unit: &str) -> String {
    let first = languages.first().copied().unwrap_or(Language::English);
    of(first).in_unit.replace("{unit}", unit)
}

/// A word as a text with a version for every language.
pub(super) fn localized(
    languages: &[Language],
    word: impl Fn(&Words) -> &'static str,
) -> Localized {
    let texts = languages.iter().map(|language| (Some(*language), word(of(*language)).to_owned()));
    Localized { texts: texts.collect() }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A sentence that omits a value in one language would state less in it.
    #[test]
    fn every_language_fills_in_the_same() {
        fn marks(text: &str) -> Vec<&str> {
            let mut marks: Vec<&str> =
                text.split('{').skip(1).filter_map(|rest| rest.split('}').next()).collect();
            marks.sort_unstable();
            marks
        }
        let templates: [fn(&Words) -> &'static str; 40] = [
            |w| w.period,
            |w| w.rows[0],
            |w| w.rows[1],
            |w| w.normal,
            |w| w.student,
            |w| w.fixed,
            |w| w.shortest,
            |w| w.without_trials,
            |w| w.rounding,
            |w| w.raised[0],
            |w| w.raised[1],
            |w| w.agreed,
            |w| w.dof_list,
            |w| w.unrounded,
            |w| w.with_prior,
            |w| w.prior,
            |w| w.global_risks,
            |w| w.multiple,
            |w| w.no_band,
            |w| w.of_rule[0],
            |w| w.of_rule[1],
            |w| w.specification,
            |w| w.approximately,
            |w| w.many,
            |w| w.shared,
            |w| w.in_unit,
            |w| w.conforming,
            |w| w.all_the_same,
            |w| w.not_shown[0],
            |w| w.not_shown[1],
            |w| w.level_decisions[0],
            |w| w.level_decisions[1],
            |w| w.level_decisions[2],
            |w| w.level_decisions[3],
            |w| w.percent[0],
            |w| w.percent[1],
            |w| w.percent[2],
            |w| w.guarded,
            |w| w.never,
            |w| w.page,
        ];
        for language in Language::ALL {
            for template in templates {
                let (own, english) = (template(of(language)), template(of(Language::English)));
                assert_eq!(marks(own), marks(english), "{own}");
            }
            for place in 0..3 {
                let limits = [of(language), of(Language::English)].map(|w| marks(w.limits[place]));
                assert_eq!(limits[0], limits[1]);
            }
        }
    }
}
