//! The units of a formula's parameters that are given as numbers alone, where they follow from those of
//! x and y: `c` of `a + b*exp(-x/c)` is in kN where x is.
//!
//! They are products of powers of both units with which the formula has the dimension of y, and with
//! which it has the values that it has of numbers in the declared units. If there is more than one such
//! set, nothing follows.

use std::collections::HashMap;

use super::form::{IMAGINARY_UNIT, define_imaginary_unit, imaginary_unit};
use super::texts_of;
use gumption_engine::model::formula::{Formula, Scope, Typing};
use gumption_engine::number::ComplexNumber;
use gumption_text::Collector;
use gumption_units::Unit;

/// Powers of y and of x of which a parameter's unit is the product, those that are met most often first.
const POWERS: [(i32, i32); 9] =
    [(1, 0), (0, 1), (0, 0), (0, -1), (1, -1), (1, -2), (-1, 0), (-1, 1), (1, 1)];

/// At most so many sets of units are tried.
const MOST_SETS: usize = 10_000;

/// Two values of a formula that are the same but for rounding.
const ROUNDING: f64 = 1e-9;

/// The parameters' units, in their order; `None` where they do not follow. `range` is that of x, and a
/// parameter has a value near its own.
pub(super) fn inferred(
    log: &Collector,
    formula: &Formula,
    x: &Unit,
    y: &Unit,
    [least, most]: [f64; 2],
    parameters: &[(String, Unit, f64)],
) -> Option<Vec<Unit>> {
    let is_plain = |unit: &Unit| unit.zero().is_none() && unit.level_exponent().is_zero();
    if !is_plain(x) || !is_plain(y) {
        return None;
    }
    let mut units: Vec<Unit> = Vec::new();
    for powers in POWERS {
        let Some(unit) = product(log, (x, y), powers) else { continue };
        let same =
            |known: &Unit| known.dimension() == unit.dimension() && known.factor() == unit.factor();
        if !units.iter().any(same) {
            units.push(unit);
        }
    }
    let sets = (0..parameters.len()).try_fold(1, |all: usize, _| all.checked_mul(units.len()))?;
    if sets > MOST_SETS {
        return None;
    }
    let has_imaginary_unit = !parameters.iter().any(|(name, ..)| name == IMAGINARY_UNIT);
    let with_imaginary_unit = |mut scope: Scope| {
        if has_imaginary_unit {
            define_imaginary_unit(&mut scope);
        }
        scope
    };
    let places = [least, least + 0.5 * (most - least), most];
    let declared = |place: f64| {
        let own = parameters.iter().map(|(name, _, value)| (name.clone(), *value));
        value(formula, &with_imaginary_unit(Scope::from_iter([("x", Typing::ANY)])), own, place)
    };
    let expected = places.map(declared);
    if !expected.iter().any(|value| value.is_some()) {
        return None;
    }
    let mut found: Option<Vec<Unit>> = None;
    for set in 0..sets {
        let mut rest = set;
        let chosen: Vec<&Unit> = parameters
            .iter()
            .filter_map(|_| {
                let unit = units.get(rest % units.len());
                rest /= units.len();
                unit
            })
            .collect();
        let mut scope = with_imaginary_unit(Scope::from_iter([("x", Typing::in_unit(x))]));
        for ((name, ..), unit) in parameters.iter().zip(&chosen) {
            scope.define(name, Typing::in_unit(unit));
        }
        let typing = formula.check(&scope).ok();
        let is_y = typing.is_some_and(|typing| {
            typing.dimension == Some(y.dimension()) && typing.reported_in(y).is_ok()
        });
        let agrees = |(place, expected): (&f64, &Option<[f64; 2]>)| {
            let own = parameters.iter().zip(&chosen);
            let own = own.map(|((name, _, value), unit)| (name.clone(), unit.to_si(*value)));
            let coherent = value(formula, &scope, own, x.to_si(*place));
            match (coherent.map(|parts| parts.map(|part| y.from_si(part))), expected) {
                (Some([re, im]), Some([other_re, other_im])) => {
                    let far = (re - other_re).abs() + (im - other_im).abs();
                    far <= ROUNDING * (other_re.abs() + other_im.abs())
                }
                (None, None) => true,
                _ => false,
            }
        };
        if is_y && places.iter().zip(&expected).all(agrees) {
            if found.is_some() {
                return None;
            }
            found = Some(chosen.into_iter().cloned().collect());
        }
    }
    found
}

/// Both parts of the value of a formula, if they are finite; a parameter may be called `i`.
fn value(
    formula: &Formula,
    scope: &Scope,
    parameters: impl Iterator<Item = (String, f64)>,
    x: f64,
) -> Option<[f64; 2]> {
    let real = |(name, value)| (name, ComplexNumber::real(value));
    let unit = [(IMAGINARY_UNIT.to_owned(), imaginary_unit())];
    let own = parameters.chain([("x".to_owned(), x)]).map(real);
    let values: HashMap<String, ComplexNumber<f64>> = unit.into_iter().chain(own).collect();
    let value = formula.evaluate(scope, &values).ok()?;
    let parts = [value.re, value.im.unwrap_or(0.0)];
    parts.iter().all(|part| part.is_finite()).then_some(parts)
}

/// The product of powers of both units.
fn product(log: &Collector, (x, y): (&Unit, &Unit), (of_y, of_x): (i32, i32)) -> Option<Unit> {
    let [x, y] = texts_of(x, y);
    let text = match (of_y, of_x) {
        (0, 0) => "1".to_owned(),
        (1, 0) => y,
        (0, 1) => x,
        (0, -1) => format!("1/{x}"),
        (1, -1) => format!("{y}/{x}"),
        (1, -2) => format!("{y}/{x}^2"),
        (-1, 0) => format!("1/({y})"),
        (-1, 1) => format!("{x}/({y})"),
        _ => format!("{y}*{x}"),
    };
    log.unit(&text).ok()
}
