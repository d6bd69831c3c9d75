//! Whether two statements of a certificate say the same: the parts of a hybrid, or two lists of
//! reference values, perhaps in different units and rounded differently.

use gumption_engine::number::Shortest;
use gumption_units::Unit;

use super::document::{Measured, StatedUncertainties, at};

/// Standard uncertainties that have lost their digits are the same within this share of them.
pub(super) const ROUNDED: f64 = 0.05;

/// What two statements say that cannot both be right, in words; `None` where they agree to the digits
/// that they are written with.
pub(super) fn contradiction(one: &Measured, other: &Measured) -> Option<[String; 2]> {
    let said = |measured: &Measured, value: f64| measured.unit.after(&Shortest(value).to_string());
    let Ok(by) = Unit::conversion_factor(&other.unit, &one.unit) else {
        let first = |measured: &Measured| {
            said(measured, measured.values.first().copied().unwrap_or(f64::NAN))
        };
        return Some([first(one), first(other)]);
    };
    if one.values.len() != other.values.len() {
        return Some([one, other].map(|measured| format!("{} values", measured.values.len())));
    }
    for (place, (&a, &b)) in one.values.iter().zip(&other.values).enumerate() {
        let digit = |measured: &Measured| measured.last_digits.get(place).copied().unwrap_or(0.0);
        // to the nearest, but for the bits of the conversion
        let rounding = 0.5 * (digit(one) + by.abs() * digit(other)) * 1.001 + 1e-12 * a.abs();
        let is_same = |b: f64| (a - b).abs() <= rounding;
        // a temperature, or a difference of temperatures
        let is_value = Unit::convert(b, &other.unit, &one.unit).is_ok_and(is_same);
        if !is_value && !is_same(by * b) {
            return Some([said(one, a), said(other, b)]);
        }
        let both = one.uncertainty.as_ref().zip(other.uncertainty.as_ref());
        let both =
            both.and_then(|(one, other)| Some((standard(one, place)?, standard(other, place)?)));
        if let Some(((a, of_a), (b, of_b))) = both
            && (a - by.abs() * b).abs() > of_a + by.abs() * of_b + 1e-12 * a.abs()
        {
            let said = |values, u| format!("a standard uncertainty of {}", said(values, u));
            return Some([said(one, a), said(other, b)]);
        }
    }
    None
}

/// Whether two statements in °C and in K that agree are of differences of temperatures.
pub(super) fn is_difference([one, other]: [&Measured; 2]) -> bool {
    let is_scaled = Unit::convert(0.0, &one.unit, &other.unit).is_ok_and(|zero| zero != 0.0);
    let same = one.values.iter().zip(&other.values).all(|(a, b)| (a - b).abs() < 1.0);
    is_scaled && same
}

/// The standard uncertainty of a value, and what its rounding may have taken: that of an expanded one is
/// to the nearest or up. `None` where its factor is not stated.
fn standard(stated: &StatedUncertainties, place: usize) -> Option<(f64, f64)> {
    if let Some(u) = at(&stated.standard, place) {
        return Some((u, ROUNDED * u));
    }
    let (expanded, factor) = (at(&stated.expanded, place)?, at(&stated.factors, place)?);
    let digit = |numbers| at(numbers, place).unwrap_or(0.0);
    let of_expanded = digit(&stated.last_digits.expanded);
    // a whole factor is chosen, not rounded
    let of_factor = if factor.fract() == 0.0 { 0.0 } else { digit(&stated.last_digits.factors) };
    let u = expanded / factor;
    (factor > 0.0).then_some((u, 1.001 * (of_expanded + 0.5 * u * of_factor) / factor))
}
