//! Bare numbers of an equation beside a quantity, `T - 20` of T in °C: they are in its unit, as every number
//! of a sheet is in the one beside it.

use super::Budget;
use super::equation::Equation;
use super::rows::Row;
use gumption_engine::model::formula::{Formula, FormulaError, Operand, Scope, Typing, is_name};
use gumption_units::Unit;

/// Usual temperatures of reference and of rooms, in degrees Celsius.
const REFERENCES: [f64; 9] = [15.0, 18.0, 20.0, 21.0, 22.0, 23.0, 25.0, 27.0, 37.0];

/// Numbers of an equation, at most.
const MOST: usize = 50;

/// The zero of the Celsius scale as sheets write it.
const CELSIUS_ZERO: [&str; 2] = ["273.15", "273"];

impl Budget<'_> {
    /// Writes the units of bare numbers into equations, where they pass the check of units with them and
    /// not without.
    pub(super) fn units_of_bare_numbers(&mut self, rows: &[Row], equations: &mut [Equation]) {
        let mut scope = Scope::new();
        for row in rows {
            let unit = Unit::parse(&row.unit).unwrap_or_default();
            scope.define(row.name.as_str(), Typing::in_unit(&unit));
            scope.give(&row.name, unit);
        }
        let estimate =
            |name: &str| rows.iter().find(|row| row.name == name).and_then(|row| row.estimate);
        let mut written: Vec<Equation> = equations.to_vec();
        let mut said = Vec::new();
        for equation in &mut written {
            for _ in 0..MOST {
                let Ok(formula) = Formula::parse(&equation.formula) else { return };
                let faults = match formula.check(&scope) {
                    Ok(typing) => {
                        scope.define(equation.name.as_str(), typing);
                        break;
                    }
                    Err(faults) => faults,
                };
                let mixed = |fault| of_two_scales(&equation.formula, fault, estimate);
                if let Some(part) = faults.iter().find_map(mixed) {
                    let reason = format!(
                        "`{part}` takes degrees Celsius from a temperature in K: write the quantity in °C, or the \
                         number in K"
                    );
                    return self.fail(equation.line, reason);
                }
                let change = faults.iter().find_map(|fault| changed(&equation.formula, fault));
                let Some((formula, part)) = change else { return };
                said.push(format!(
                    "line {}: a bare number of the equation of {} is in the unit of the quantity beside it: \
                     `{part}`",
                    equation.line + 1,
                    equation.name
                ));
                equation.formula = formula;
            }
        }
        if Self::typing_of(&written, scope).is_some() && !said.is_empty() {
            self.guessed.extend(said);
            equations.clone_from_slice(&written);
        }
    }
}

/// A usual reference temperature beside one above this, both said to be in K, is one of degrees Celsius.
const BETWEEN_SCALES: f64 = 150.0;

/// The difference of a thermodynamic temperature of a row and a number of degrees Celsius.
fn of_two_scales<'f>(
    formula: &'f str,
    fault: &FormulaError,
    estimate: impl Fn(&str) -> Option<f64>,
) -> Option<&'f str> {
    let FormulaError::MixedDimensions { operator: "-", operands, .. } = fault else { return None };
    let [left, right] = operands.as_ref();
    let (number, quantity) = if left.is_number { (left, right) } else { (right, left) };
    let value: f64 = formula.get(number.span.clone())?.parse().ok()?;
    let kelvin = estimate(formula.get(quantity.span.clone())?)?;
    let is_mixed = quantity.unit.as_deref() == Some("K")
        && REFERENCES.contains(&value)
        && kelvin > BETWEEN_SCALES;
    formula.get(left.span.start..right.span.end).filter(|_| is_mixed)
}

/// A formula with the unit of a number that has none beside a quantity, and the part of it that has changed.
fn changed(formula: &str, fault: &FormulaError) -> Option<(String, String)> {
    let FormulaError::MixedDimensions { operator, operands, .. } = fault else { return None };
    let [left, right] = operands.as_ref();
    let (number, quantity) = match (left.is_number, right.is_number) {
        (true, false) => (left, right),
        (false, true) => (right, left),
        _ => return None,
    };
    let text = |of: &Operand| formula.get(of.span.clone());
    // what a bare coefficient makes of a quantity, `0.39*T`, is in a unit that nothing tells
    let (digits, name) = (text(number)?, text(quantity).filter(|name| is_name(name))?);
    let unit = Unit::parse(quantity.unit.as_deref()?).ok()?;
    let is_absolute = CELSIUS_ZERO.contains(&digits) && unit.is_celsius();
    let span = left.span.start..right.span.end;
    let part = match *operator {
        "+" if is_absolute => format!("kelvin({name})"),
        "-" if CELSIUS_ZERO.contains(&digits) && unit.text() == "K" && right.is_number => {
            format!("celsius({name})")
        }
        // what is added to a Celsius temperature is a difference
        "+" if unit.is_celsius() && unit.factor() == 1.0 => {
            format!("{}{digits} [K]", formula.get(span.start..number.span.start)?)
                + formula.get(number.span.end..span.end)?
        }
        _ => {
            let before = formula.get(span.start..number.span.start)?;
            let behind = formula.get(number.span.end..span.end)?;
            format!("{before}{digits} [{}]{behind}", unit.text())
        }
    };
    let whole = format!("{}{part}{}", formula.get(..span.start)?, formula.get(span.end..)?);
    Some((whole, part))
}
