//! A formula of conditions as a program, which is made once and computed in every row.

use std::collections::HashMap;

use super::scopes::shift;
use gumption_engine::model::formula::{Formula, Scope, Typing};
use gumption_engine::model::{NumberForm, Program, Quantity, Recorder};
use gumption_engine::number::Number;
use gumption_text::value_text::ValueOf;
use gumption_units::Unit;

/// A formula of conditions, whose value is wanted in a unit.
#[derive(Clone, Debug)]
pub(super) struct ConditionFormula {
    /// From the numbers of the conditions; none of a formula that has no value.
    program: Option<Program>,
    form: NumberForm,
    /// The units of the conditions.
    conditions: Vec<Unit>,
    unit: Unit,
    of: ValueOf,
    /// What is added to the formula's number before it becomes a value in the unit.
    shift: f64,
}

impl ConditionFormula {
    /// The scope has all names of the formula: those of the conditions, and of constants with their values.
    pub(super) fn new<'c>(
        formula: &Formula,
        scope: &Scope,
        form: NumberForm,
        conditions: &[Quantity],
        constants: impl Iterator<Item = &'c (Quantity, f64)>,
        (unit, of): (&Unit, ValueOf),
    ) -> Self {
        let recorder = Recorder::default();
        let mut values = HashMap::new();
        for (place, condition) in conditions.iter().enumerate() {
            values.insert(condition.name.clone(), recorder.variable(place));
        }
        for (constant, value) in constants {
            let number = form.number(*value, &constant.unit);
            values.insert(constant.name.clone(), Number::constant(number));
        }
        let value = formula.record(scope, &values).ok();
        let program = value.map(|value| recorder.program(conditions.len(), &[value]));
        let shift = match (form, of) {
            (NumberForm::Declared, _) | (_, ValueOf::Difference) => 0.0,
            _ => {
                let typing = formula.check_names(scope).unwrap_or(Typing::ANY);
                shift(typing, unit, of).unwrap_or(f64::NAN)
            }
        };
        let conditions = conditions.iter().map(|condition| condition.unit.clone()).collect();
        Self { program, form, conditions, unit: unit.clone(), of, shift }
    }

    /// The value for these values of the conditions; not a number where there is none.
    pub(super) fn at(&self, conditions: &[f64]) -> f64 {
        let Some(program) =
            self.program.as_ref().filter(|_| conditions.len() == self.conditions.len())
        else {
            return f64::NAN;
        };
        let given = conditions.iter().zip(&self.conditions);
        let numbers: Vec<f64> = given.map(|(value, unit)| self.form.number(*value, unit)).collect();
        let value = program.evaluate(&numbers).pop().unwrap_or(f64::NAN);
        match (self.form, self.of) {
            (NumberForm::Declared, _) => value,
            (_, ValueOf::Difference) => self.unit.from_si(value),
            _ => self.unit.value_from_si(value + self.shift),
        }
    }
}
