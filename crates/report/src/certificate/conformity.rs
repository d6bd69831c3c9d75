//! What is decided about rows with a tolerance, in the languages of the certificate (ISO/IEC 17025,
//! 7.8.6.2: which results, which specification, which rule).

use super::CertificateReport;
use super::sentences::{about, in_marks};
use super::stated::{self, Stated};
use super::words::{self, Words};
use crate::number::{exact, justified, position, to};
use crate::plain;
use crate::table::in_unit;
use gumption_analysis::certificate::contents::Language;
use gumption_engine::model::Tolerance;
use gumption_engine::propagate::Conformity;

/// Decimal place of probabilities in percent.
const PERCENT_PLACE: i32 = -2;

/// Significant digits of a guard band.
const GUARD_DIGITS: u32 = 3;

/// One statement for each row with a tolerance.
pub(super) fn statements(report: &CertificateReport<'_>, language: Language) -> Vec<String> {
    let words = words::of(language);
    let rows = stated::rows(report);
    let of = |row: &Stated<'_>| {
        let found = row.conformity()?;
        Some(about(&[row.number], words) + &said(report, row, &found, words))
    };
    rows.iter().filter_map(of).collect()
}

/// Whether each row with a tolerance conforms.
pub(super) fn decisions(report: &CertificateReport<'_>) -> Vec<bool> {
    let rows = stated::rows(report);
    rows.iter().filter_map(|row| Some(row.conformity()?.conforms)).collect()
}

fn said(
    report: &CertificateReport<'_>,
    row: &Stated<'_>,
    found: &Conformity,
    words: &Words,
) -> String {
    let [conforms, not] = words.decisions;
    let decision = if found.conforms { conforms } else { not };
    let error = 100.0 * found.numerical_standard_error;
    let probability = justified(100.0 * found.probability, Some(PERCENT_PLACE), error);
    let parts = [
        decision
            .replace("{limits}", &in_marks(report, &limits(row, &found.tolerance, None, words))),
        words.conforming.replace("{p}", &in_marks(report, &probability)),
        rule(report, row, found, words),
    ];
    parts.join(" ")
}

fn rule(
    report: &CertificateReport<'_>,
    row: &Stated<'_>,
    found: &Conformity,
    words: &Words,
) -> String {
    let Some(risk) = found.wanted_risk else { return words.simple.to_owned() };
    let kind = words.kinds[usize::from(found.global.is_some())];
    let filled = |template: &str| {
        let risk = in_marks(report, &exact(stated::percent(risk)));
        template.replace("{kind}", kind).replace("{risk}", &risk)
    };
    let (Some(width), Some(acceptance)) = (found.guard_band, &found.acceptance) else {
        return filled(words.never);
    };
    let place = position(width, GUARD_DIGITS);
    let guard = in_marks(report, &in_unit(&to(width, place), &row.quantity.unit));
    let accepted = in_marks(report, &limits(row, acceptance, place, words));
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
    let unit = match plain(row.quantity.unit.text()).as_str() {
        "" | "1" => String::new(),
        unit => format!(" {unit}"),
    };
    form.replace("{low}", &low.unwrap_or_default())
        .replace("{high}", &high.unwrap_or_default())
        .replace("{unit}", &unit)
}
