//! The tables of a comparison.

use crate::number::{MISSING, exact, position, rounded, significant, to, with_uncertainty};
use crate::plain;
use crate::sheet::Sheet;
use gumption_analysis::compare::{
    ComparedPair, Comparison, ConsensusValue, DegreeOfEquivalence, FACTOR, ResultPair, StatedResult,
};

/// Decimal places of scores.
const SCORE: i32 = -2;

/// Decimal places of probabilities.
const PROBABILITY: i32 = -3;

/// Significant digits of expanded uncertainties.
const DIGITS: u32 = 2;

/// Whether there is a unit to write after a number.
pub(super) fn has_name(unit: &str) -> bool {
    !matches!(unit.trim(), "" | "1")
}

/// A number followed by the unit, unless the unit is 1.
pub(super) fn in_unit(number: &str, unit: &str) -> String {
    if has_name(unit) { format!("{number} {}", plain(unit)) } else { number.to_owned() }
}

/// Results two by two.
pub(super) fn pairs(
    (pairs, compared): (&[ResultPair], &[ComparedPair]),
    units: &[String],
    rounding: bool,
) -> Sheet {
    let mut sheet = Sheet::default();
    sheet.text("", compared.iter().map(|row| plain(&row.label)));
    for (which, name) in ["first", "second"].into_iter().enumerate() {
        sheet.text(name, pairs.iter().map(|pair| stated(&pair.results[which])));
    }
    let of = |row: &ComparedPair| with_uncertainty(row.difference, row.expanded, DIGITS);
    sheet.numbers("difference", compared.iter().map(|row| of(row).0));
    sheet.numbers("U", compared.iter().map(|row| of(row).1));
    if units.iter().any(|unit| has_name(unit)) {
        sheet.units("unit", units.iter().map(|unit| plain(unit)));
    }
    sheet.numbers("En", compared.iter().map(|row| score(row.normalized_error)));
    if rounding {
        sheet
            .text("En by the digits", compared.iter().map(|row| row.range.map(score).join(" to ")));
    }
    sheet.numbers("zeta", compared.iter().map(|row| score(row.zeta)));
    sheet.numbers("probability", compared.iter().map(|row| probability(row.probability)));
    sheet.text("compatible", compared.iter().map(|row| yes(row.is_compatible())));
    sheet
}

/// Degrees of equivalence.
pub(super) fn laboratories(comparison: &Comparison, unit: &str) -> Sheet {
    let rows = &comparison.rows;
    let mut sheet = Sheet::default();
    sheet.text("laboratory", rows.iter().map(|row| plain(&row.label)));
    let own = |row: &DegreeOfEquivalence| with_uncertainty(row.value, row.expanded_stated, DIGITS);
    sheet.numbers("x", rows.iter().map(|row| own(row).0));
    sheet.numbers("U(x)", rows.iter().map(|row| own(row).1));
    if rows.iter().any(|row| row.factor_stated != FACTOR) {
        sheet.numbers("k of\nthis U", rows.iter().map(|row| factor(row.factor_stated)));
    }
    let of = |row: &DegreeOfEquivalence| with_uncertainty(row.difference, row.expanded, DIGITS);
    sheet.numbers("difference", rows.iter().map(|row| of(row).0));
    sheet.numbers("U", rows.iter().map(|row| of(row).1));
    if has_name(unit) {
        sheet.units("unit", rows.iter().map(|_| plain(unit)));
    }
    sheet.numbers("En", rows.iter().map(|row| score(row.normalized_error)));
    sheet.numbers("zeta", rows.iter().map(|row| score(row.zeta)));
    sheet.numbers("probability", rows.iter().map(|row| probability(row.probability)));
    sheet.text(
        "compatible",
        rows.iter().map(|row| row.is_compatible().map_or_else(|| MISSING.to_owned(), yes)),
    );
    sheet.text("in the\nreference", rows.iter().map(|row| yes(row.member)));
    sheet
}

/// The values of every estimator.
pub(super) fn estimators(comparison: &Comparison) -> Sheet {
    let values = &comparison.estimators;
    let mut sheet = Sheet::default();
    sheet.text("reference value by", values.iter().map(|of| of.estimator.name().to_owned()));
    let stated = |of: &ConsensusValue| {
        with_uncertainty(of.reference.value, FACTOR * of.reference.standard_uncertainty, DIGITS)
    };
    sheet.numbers("value", values.iter().map(|of| stated(of).0));
    sheet.numbers("U (k = 2)", values.iter().map(|of| stated(of).1));
    let added = |of: &ConsensusValue| match (of.birge_ratio, of.tau) {
        (Some(ratio), _) => format!("factor {}", rounded(ratio, SCORE)),
        (None, Some(tau)) => format!("tau = {}", significant(tau, DIGITS)),
        (None, None) => MISSING.to_owned(),
    };
    sheet.text("added to stated\nuncertainties", values.iter().map(added));
    let observed = |of: &ConsensusValue| {
        of.hartung_knapp.map_or_else(|| MISSING.to_owned(), |of| significant(of.expanded(), DIGITS))
    };
    sheet.numbers("U by\nHartung-Knapp", values.iter().map(observed));
    let factor = |of: &ConsensusValue| {
        of.hartung_knapp.map_or_else(|| MISSING.to_owned(), |of| rounded(of.coverage_factor, SCORE))
    };
    sheet.numbers("k of\nthis U", values.iter().map(factor));
    sheet
}

/// A result as stated: to the position of its printed digits, or of its uncertainty.
fn stated(of: &StatedResult) -> String {
    let [own, of_u] = of.rounding.map(|half| position(2.0 * half, 1));
    let fine = position(of.expanded, DIGITS + 1);
    let [x, u] = of.printed;
    let (x, u) = (to(x, own.or(fine)), to(u, of_u.or(fine)));
    let factor =
        if of.factor == 2.0 { String::new() } else { format!(", k = {}", factor(of.factor)) };
    format!("{x} ± {u}{factor}")
}

fn factor(k: f64) -> String {
    if k.fract() == 0.0 { exact(k) } else { significant(k, 3) }
}

pub(super) fn score(value: f64) -> String {
    if value.is_infinite() { "any".to_owned() } else { rounded(value, SCORE) }
}

pub(super) fn probability(p: f64) -> String {
    if p.is_nan() {
        MISSING.to_owned()
    } else if p < 0.001 {
        "<0.001".to_owned()
    } else {
        rounded(p, PROBABILITY)
    }
}

fn yes(is: bool) -> String {
    if is { "yes" } else { "no" }.to_owned()
}
