//! Decisions about rows with a tolerance, in the languages of the certificate (ISO/IEC 17025,
//! 7.8.6.2: which results, which specification, which rule).

use super::CertificateReport;
use super::layout;
use super::sentences::{SentenceLanguage, about};
use super::stated::{self, StatedRow};
use super::words::Words;
use crate::number::{Percent, exact, position, significant, to};
use crate::plain;
use crate::printed::with_symbols;
use crate::table::comparison::percent_of;
use crate::table::in_unit;
use gumption_engine::decimal::{to_15_digits, to_digits};
use gumption_engine::model::Tolerance;
use gumption_engine::propagate::{Conformity, ConformityLevel};

/// Significant digits of a guard band.
const GUARD_DIGITS: u32 = 3;

/// One statement for each row with a tolerance.
pub(super) fn statements(report: &CertificateReport<'_>, of: SentenceLanguage) -> Vec<String> {
    let rows = stated::rows(report);
    let one = |row: &StatedRow<'_>| {
        let found = row.conformity()?;
        Some(about(&[row.number], of.words()) + &said(row, &found, of))
    };
    rows.iter().filter_map(one).collect()
}

/// The statements of a page: one for each row with a tolerance, and the decision rule alone for rows
/// whose table shows limits and decision.
pub(super) fn on_page(report: &CertificateReport<'_>, of: SentenceLanguage) -> Vec<String> {
    let rows = stated::rows(report);
    let mut rules: Vec<(String, Vec<usize>)> = Vec::new();
    let mut alone: Vec<String> = Vec::new();
    for row in &rows {
        let Some(found) = row.conformity() else { continue };
        if !layout::shows_decision(report, row) {
            alone.push(about(&[row.number], of.words()) + &said(row, &found, of));
            continue;
        }
        let parts = specification(row, of).into_iter().chain([rule(row, &found, of)]);
        let text = parts.chain(agreed(row, of)).collect::<Vec<_>>().join(" ");
        match rules.iter_mut().find(|(known, _)| *known == text) {
            Some((_, numbers)) => numbers.push(row.number),
            None => rules.push((text, vec![row.number])),
        }
    }
    let decided = rules.iter().map(|(_, numbers)| numbers.len()).sum::<usize>();
    let of_all = rules.len() == 1 && decided == rows.len();
    let rules = rules.into_iter().map(|(text, numbers)| match of_all {
        true => text,
        false => about(&numbers, of.words()) + &text,
    });
    rules.chain(alone).collect()
}

/// The specification to which the tolerance of a row belongs, if it has a name.
fn specification(row: &StatedRow<'_>, of: SentenceLanguage) -> Option<String> {
    let output = row.asked.task.model.outputs.get(row.line.output)?;
    let name = output.specification.as_deref()?;
    Some(of.words().specification.replace("{name}", &plain(name)))
}

/// That the rule was agreed with the customer, if it was.
fn agreed(row: &StatedRow<'_>, of: SentenceLanguage) -> Option<String> {
    let output = row.asked.task.model.outputs.get(row.line.output)?;
    output.rule_agreed.then(|| of.words().rule_agreed.to_owned())
}

/// A decision in a few words, for a table.
pub(super) fn decided(found: &Conformity, words: &Words) -> &'static str {
    if let Some(level) = found.level {
        return words.levels[place_of(level)];
    }
    let [conforms, not, not_shown] = words.decided;
    match (found.conforms, found.tolerance.holds(found.estimate)) {
        (true, _) => conforms,
        (false, false) => not,
        (false, true) => not_shown,
    }
}

/// What is decided of each row with a tolerance.
pub(super) fn decisions(report: &CertificateReport<'_>) -> Vec<Conformity> {
    stated::rows(report).iter().filter_map(StatedRow::conformity).collect()
}

/// The place of a level among the words for levels.
fn place_of(level: ConformityLevel) -> usize {
    ConformityLevel::ALL.iter().position(|of| *of == level).unwrap_or(0)
}

fn said(row: &StatedRow<'_>, found: &Conformity, of: SentenceLanguage) -> String {
    let words = of.words();
    // a risk that is the probability of conformity of a value that is rejected (JCGM 106, 9.3)
    let is_stated = found.conforms || found.level.is_some();
    let chance = if is_stated { words.conforming } else { words.all_the_same };
    // a stated uncertainty that replaces the evaluated one has no trials
    let trials = row.found.monte_carlo.as_deref().filter(|_| !row.is_raised());
    let trials = trials.map(|figures| figures.trials);
    let probability = percent(percent_of(found, found.probability, trials), of);
    let mut parts: Vec<String> = specification(row, of).into_iter().collect();
    parts.push(
        decision(found, words)
            .replace("{limits}", &of.in_marks(&limits(row, &found.tolerance, None, words))),
    );
    parts.extend(unrounded(row, found, of));
    parts.push(chance.replace("{p}", &probability));
    parts.extend(with_prior(row, found, (trials, of)));
    parts.push(rule(row, found, of));
    parts.extend(agreed(row, of));
    parts.extend(found.global.map(|risks| {
        let share = |risk: f64| of.in_marks(&significant(100.0 * risk, 3));
        let said = words.global_risks.replace("{a}", &share(risks.false_acceptance));
        said.replace("{b}", &share(risks.false_rejection))
    }));
    parts.join(" ")
}

/// A probability in percent.
fn percent(probability: Percent, of: SentenceLanguage) -> String {
    let (place, number) = match &probability {
        Percent::At(number) => (0, number),
        Percent::MoreThan(number) => (1, number),
        Percent::LessThan(number) => (2, number),
    };
    of.words().percent[place].replace("{p}", &of.in_marks(number))
}

/// The prior knowledge behind a probability besides the measurement (ISO/IEC 17025, 7.8.6; JCGM
/// 106:2012, 6.3), and the probability without it.
fn with_prior(
    row: &StatedRow<'_>,
    found: &Conformity,
    (trials, of): (Option<u64>, SentenceLanguage),
) -> Option<String> {
    let words = of.words();
    let share = found.without_prior?;
    let output = row.asked.task.model.outputs.get(row.line.output)?;
    let prior = output.prior.as_deref()?;
    let unit = with_symbols(&row.quantity.unit);
    let number = |value: f64| of.in_marks(&in_unit(&exact(to_15_digits(value)), &unit));
    let about = words
        .prior
        .replace("{shape}", prior.name())
        .replace("{mean}", &number(prior.mean()))
        .replace("{std}", &number(prior.standard_uncertainty()));
    let alone = percent(Percent::of(share, 0.0, trials), of);
    Some(words.with_prior.replace("{prior}", &about).replace("{p}", &alone))
}

/// The value on which the decision is based, if the stated one would suggest another decision.
fn unrounded(row: &StatedRow<'_>, found: &Conformity, of: SentenceLanguage) -> Option<String> {
    let shown = row.statement.rounded_value()?.value();
    let alike = |limits: &Tolerance| limits.holds(shown) == limits.holds(found.estimate);
    if alike(&found.tolerance) && found.acceptance.as_ref().is_none_or(alike) {
        return None;
    }
    let limits = [Some(&found.tolerance), found.acceptance.as_ref()].into_iter().flatten();
    let limits: Vec<&Tolerance> = limits.collect();
    let value =
        in_unit(&exact(telling(found.estimate, &limits)), &with_symbols(&row.quantity.unit));
    Some(of.words().unrounded.replace("{value}", &of.in_marks(&value)))
}

/// A value with one digit more than needed to show on which side of the limits it lies, whether a
/// reader uses that many digits or more.
fn telling(value: f64, limits: &[&Tolerance]) -> f64 {
    let tells = |digits: u32| {
        let shown = to_digits(value, digits);
        limits.iter().all(|limits| limits.holds(shown) == limits.holds(value))
    };
    let digits = (2..=15).rev().take_while(|digits| tells(*digits)).last();
    to_digits(value, digits.unwrap_or(15) + 1)
}

/// The decision. A value that a guarded rule rejects although it lies within the tolerance is not
/// shown to conform; its nonconformity is not shown either (JCGM 106:2012, 8.3).
fn decision(found: &Conformity, words: &Words) -> &'static str {
    if let Some(level) = found.level {
        return words.level_decisions[place_of(level)];
    }
    let [conforms, not] = words.decisions;
    let [outside, never] = words.not_shown;
    match (found.conforms, found.tolerance.holds(found.estimate)) {
        (true, _) => conforms,
        (false, false) => not,
        (false, true) if found.acceptance.is_some() => outside,
        (false, true) => never,
    }
}

fn rule(row: &StatedRow<'_>, found: &Conformity, of: SentenceLanguage) -> String {
    let words = of.words();
    if let Some((band, clause)) = band(row, found, of) {
        let unit = with_symbols(&row.quantity.unit);
        let place = found.guard_band.and_then(|width| position(width, GUARD_DIGITS));
        let guard = found.guard_band.map(|width| of.in_marks(&in_unit(&to(width, place), &unit)));
        let (said, accepted) = match (&found.acceptance, &guard) {
            (Some(to), _) => (words.multiple, of.in_marks(&limits(row, to, place, words))),
            (None, Some(_)) => (words.too_wide, String::new()),
            (None, None) => (words.no_band, String::new()),
        };
        let clause = match found.level {
            Some(_) => clause.replace("4.2.2", "4.2.3"),
            None => clause,
        };
        let said = said.replace("{band}", &band).replace("{clause}", &clause);
        return said.replace("{guard}", &guard.unwrap_or_default()).replace("{limits}", &accepted);
    }
    let Some(risk) = found.wanted_risk else { return words.simple.to_owned() };
    let kind = words.kinds[usize::from(found.global.is_some())];
    let filled = |template: &str| {
        let risk = of.in_marks(&exact(stated::percent(risk)));
        template.replace("{kind}", kind).replace("{risk}", &risk)
    };
    let (Some(width), Some(acceptance)) = (found.guard_band, &found.acceptance) else {
        return filled(words.never);
    };
    let place = position(width, GUARD_DIGITS);
    let guard = of.in_marks(&in_unit(&to(width, place), &with_symbols(&row.quantity.unit)));
    let accepted = of.in_marks(&limits(row, acceptance, place, words));
    filled(words.guarded).replace("{guard}", &guard).replace("{limits}", &accepted)
}

/// The guard band of a rule that is stated by U, as a formula, and where the rule comes from.
fn band(row: &StatedRow<'_>, found: &Conformity, of: SentenceLanguage) -> Option<(String, String)> {
    let words = of.words();
    let otherwise = usize::from(!row.asked.task.settings.coverage.is_about_95());
    let factor = of.in_marks(&row.factor().text);
    if let Some(rule) = found.guard_rule {
        let clause = words.of_rule[otherwise].replace("{rule}", rule.title());
        return Some((of.in_marks(rule.formula()), clause.replace("{k}", &factor)));
    }
    // without U there is no multiple of it
    let multiple = found.guard_factor.filter(|_| found.guard_band.is_some())?;
    let clause = words.of_ilac_g8[otherwise].replace("{k}", &factor);
    Some((format!("{} U", of.in_marks(&exact(multiple))), clause))
}

/// Limits with their unit; rounded to a position if it is given.
fn limits(row: &StatedRow<'_>, of: &Tolerance, place: Option<i32>, words: &Words) -> String {
    let [both, lower, upper] = words.limits;
    let (low, high) = (of.lower.map(|end| to(end, place)), of.upper.map(|end| to(end, place)));
    let form = match (&low, &high) {
        (Some(_), Some(_)) => both,
        (_, None) => lower,
        (None, Some(_)) => upper,
    };
    let unit = match plain(with_symbols(&row.quantity.unit).text()).as_str() {
        "" | "1" => String::new(),
        unit => format!(" {unit}"),
    };
    form.replace("{low}", &low.unwrap_or_default())
        .replace("{high}", &high.unwrap_or_default())
        .replace("{unit}", &unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 10.064 with two decimals is beyond 10.06 by rounding, with four digits it is not: it needs
    /// the five. The same holds if the limit lies between 10.055 and the 10.06 of four digits.
    #[test]
    fn a_value_is_told_with_the_digits_that_decide() {
        let below = |upper: f64| Tolerance { lower: None, upper: Some(upper) };
        for (value, upper, expected) in [
            (10.064, 10.06, 10.064),
            (10.055, 10.059, 10.055),
            (10.004, 10.0, 10.004),
            (1.1004, 1.1, 1.1004),
            (1.100_412_3, 1.1, 1.100_41),
            (104.0, 100.0, 104.0),
            (95.1, 95.100_000_000_01, 95.1),
        ] {
            assert_eq!(telling(value, &[&below(upper)]), expected, "{value} {upper}");
        }
        let both = [&below(10.1), &below(10.059)];
        assert_eq!(telling(10.0553, &both), 10.0553);
    }
}
