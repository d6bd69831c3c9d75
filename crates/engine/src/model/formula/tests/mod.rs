//! Tests of the formula language.

mod dimensions;
mod errors;
mod random;
mod scales;
mod syntax;
mod values;

use super::{Formula, FormulaError, Scope, Typing};
use gumption_units::Unit;

/// Quantities of many kinds, by name and unit.
fn scope() -> Scope {
    let units = [
        ("n", "1"),
        ("k", "%"),
        ("l", "m"),
        ("d", "mm"),
        ("s", "ms"),
        ("f", "Hz"),
        ("v", "m/s"),
        ("a", "m/s^2"),
        ("m", "kg"),
        ("u", "V"),
        ("i", "A"),
        ("tilt", "deg"),
        ("t", "degC"),
        ("t1", "degC"),
        ("dt", "K"),
        ("sigma", "W*m^-2*K^-4"),
        ("en", "nV/√Hz"),
        ("θ", "rad"),
    ];
    let mut scope: Scope = units
        .into_iter()
        .map(|(name, unit)| (name, Typing::in_unit(&Unit::parse(unit).unwrap())))
        .collect();
    scope.define("bad", Typing::ANY);
    scope.announce("below");
    scope
}

/// All mistakes of a formula.
fn mistakes(text: &str) -> Vec<FormulaError> {
    match Formula::parse(text) {
        Ok(formula) => formula.check(&scope()).err().unwrap_or_default(),
        Err(error) => vec![error],
    }
}

/// The only mistake of a formula.
fn mistake(text: &str) -> FormulaError {
    let [error] = mistakes(text).try_into().unwrap_or_else(|all| panic!("{text}: {all:?}"));
    error
}
