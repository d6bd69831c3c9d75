//! What is decided about rows with a tolerance, in the languages of the certificate (ISO/IEC 17025,
//! 7.8.6.2: which results, which specification, which rule).

use super::CertificateReport;
use super::sentences::{Said, about};
use super::stated::{self, Stated};
use super::units::printed;
use super::words::Words;
use crate::number::{Percent, exact, position, to};
use crate::plain;
use crate::table::comparison::percent_of;
use crate::table::in_unit;
use gumption_engine::model::Tolerance;
use gumption_engine::propagate::Conformity;

/// Significant digits of a guard band.
const GUARD_DIGITS: u32 = 3;

/// One statement for each row with a tolerance.
pub(super) fn statements(report: &CertificateReport<'_>, of: Said) -> Vec<String> {
    let rows = stated::rows(report);
    let one = |row: &Stated<'_>| {
        let found = row.conformity()?;
        Some(about(&[row.number], of.words()) + &said(row, &found, of))
    };
    rows.iter().filter_map(one).collect()
}

/// Whether each row with a tolerance conforms.
pub(super) fn decisions(report: &CertificateReport<'_>) -> Vec<bool> {
    let rows = stated::rows(report);
    rows.iter().filter_map(|row| Some(row.conformity()?.conforms)).collect()
}

fn said(row: &Stated<'_>, found: &Conformity, of: Said) -> String {
    let words = of.words();
    // a risk that is the probability of conformity of a value that is rejected (JCGM 106, 9.3)
    let chance = if found.conforms { words.conforming } else { words.all_the_same };
    // an uncertainty that is stated in place of the evaluated one has no trials
    let trials = row.found.monte_carlo.as_ref().filter(|_| !row.is_raised());
    let probability = percent_of(found, found.probability, trials.map(|figures| figures.trials));
    let probability = match &probability {
        Percent::At(number) => words.percent[0].replace("{p}", number),
        Percent::MoreThan(number) => words.percent[1].replace("{p}", number),
        Percent::LessThan(number) => words.percent[2].replace("{p}", number),
    };
    let parts = [
        decision(found, words)
            .replace("{limits}", &of.in_marks(&limits(row, &found.tolerance, None, words))),
        chance.replace("{p}", &of.in_marks(&probability)),
        rule(row, found, of),
    ];
    parts.join(" ")
}

/// What is decided. A value that a guarded rule rejects although it lies within the tolerance is not
/// shown to conform; that it does not conform is not shown either (JCGM 106:2012, 8.3).
fn decision(found: &Conformity, words: &Words) -> &'static str {
    let [conforms, not] = words.decisions;
    let [outside, never] = words.not_shown;
    match (found.conforms, found.tolerance.holds(found.estimate)) {
        (true, _) => conforms,
        (false, false) => not,
        (false, true) if found.acceptance.is_some() => outside,
        (false, true) => never,
    }
}

fn rule(row: &Stated<'_>, found: &Conformity, of: Said) -> String {
    let words = of.words();
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
    let guard = of.in_marks(&in_unit(&to(width, place), &printed(&row.quantity.unit)));
    let accepted = of.in_marks(&limits(row, acceptance, place, words));
    filled(words.guarded).replace("{guard}", &guard).replace("{limits}", &accepted)
}

/// Limits with their unit; to a place if there is one.
fn limits(row: &Stated<'_>, of: &Tolerance, place: Option<i32>, words: &Words) -> String {
    let [both, lower, upper] = words.limits;
    let (low, high) = (of.lower.map(|end| to(end, place)), of.upper.map(|end| to(end, place)));
    let form = match (&low, &high) {
        (Some(_), Some(_)) => both,
        (_, None) => lower,
        (None, Some(_)) => upper,
    };
    let unit = match plain(printed(&row.quantity.unit).text()).as_str() {
        "" | "1" => String::new(),
        unit => format!(" {unit}"),
    };
    form.replace("{low}", &low.unwrap_or_default())
        .replace("{high}", &high.unwrap_or_default())
        .replace("{unit}", &unit)
}
