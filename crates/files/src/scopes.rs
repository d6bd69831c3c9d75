//! What formulas of a file are checked against: the names that they may use, with their units.

use std::collections::HashSet;
use std::ops::Range;

use super::condition_formula::ConditionFormula;
use super::condition_values::{ConditionValues, ValuesOfRows};
use super::conditions::Conditions;
use super::constant_inputs::ConstantInputs;
use super::input_set::InputSet;
use super::numbers_alone;
use gumption_engine::model::NumberForm;
use gumption_engine::model::Quantity;
use gumption_engine::model::formula::{
    Formula, FormulaError, NameKind, ScaleMisfit, Scope, Typing,
};
use gumption_engine::model::typed::CatalogueEntry;
use gumption_text::json::Member;
use gumption_text::value_text::ValueOf;
use gumption_text::{Collector, DiagnosticKind};
use gumption_units::{Dimension, Unit};

/// A formula's mistake at its place inside the JSON text.
pub(super) fn report_formula(log: &Collector, member: &Member, error: FormulaError) {
    let place = place_in_formula(log, member, &error.span());
    log.report(&place, DiagnosticKind::Formula { error });
}

/// The place in the JSON text of a place in a formula.
pub(super) fn place_in_formula(
    log: &Collector,
    member: &Member,
    inner: &Range<usize>,
) -> Range<usize> {
    let span = &member.value.span;
    let raw = log.source.text.get(span.start + 1..span.end.saturating_sub(1));
    let plain = raw.is_some_and(|raw| !raw.contains('\\'));
    // escapes in the JSON text would shift the place, so the whole text is underlined then
    if plain {
        let start = (span.start + 1 + inner.start).min(span.end);
        start..(span.start + 1 + inner.end).clamp(start, span.end)
    } else {
        span.clone()
    }
}

/// A coherent unit of a dimension, as text.
pub(super) fn coherent(dimension: Dimension) -> String {
    dimension.usual_unit()
}

/// What is known of the names of a typed model.
pub(super) fn typed_scope(
    entry: &CatalogueEntry,
    inputs: &InputSet,
    conditions: &Conditions,
) -> Scope {
    let mut scope = condition_scope(conditions, true);
    for input in &inputs.quantities {
        let Quantity { name, unit, .. } = &input.quantity;
        scope.define(name, Typing::in_unit(unit));
    }
    for output in entry.typed.declaration.outputs {
        let unit = Unit::parse(output.unit).ok();
        scope.define(output.name, unit.map_or(Typing::ANY, |unit| Typing::in_unit(&unit)));
    }
    scope
}

/// What is known of the names of conditions, whose units are checked or not.
pub(super) fn condition_scope(conditions: &Conditions, check_units: bool) -> Scope {
    let mut scope = Scope::default();
    for condition in &conditions.quantities {
        let known = !conditions.without_unit.contains(&condition.name);
        let typing = if known { Typing::in_unit(&condition.unit) } else { Typing::ANY };
        scope.define(&condition.name, typing);
        if known && !check_units {
            scope.declare(&condition.name, condition.unit.clone());
        }
    }
    scope
}

/// Tells in which units conditions are given, for messages.
pub(super) fn give_units(scope: &mut Scope, conditions: &Conditions) {
    for condition in &conditions.quantities {
        scope.give(&condition.name, condition.unit.clone());
    }
}

/// What formulas compute with, where units are checked and where they are not.
pub(super) fn number_form(check_units: bool) -> NumberForm {
    if check_units { NumberForm::Coherent } else { NumberForm::Declared }
}

/// What is added to a formula's number where it becomes a value in a unit.
pub(super) fn shift(typing: Typing, unit: &Unit, of: ValueOf) -> Result<f64, ScaleMisfit> {
    let is_difference = of == ValueOf::Difference && typing.level == unit.level_exponent();
    match typing.given_in(unit) {
        Err(
            misfit @ (ScaleMisfit::Revolutions
            | ScaleMisfit::PowerOfRevolutions { .. }
            | ScaleMisfit::Turns { .. }),
        ) => Err(misfit),
        _ if is_difference => Ok(0.0),
        _ => typing.shift_to(unit),
    }
}

/// The conditions as estimates' formulas see them.
#[derive(Debug)]
pub(super) struct ConditionSet<'c> {
    pub(super) conditions: &'c Conditions,
    pub(super) check_units: bool,
    /// Inputs that are constants, which estimates may use.
    pub(super) constants: &'c ConstantInputs,
}

impl ConditionSet<'_> {
    /// What is known of the names that formulas may use, with what messages propose.
    fn scope(&self) -> Scope {
        let mut scope = self.scope_with(self.constants.known.iter());
        give_units(&mut scope, self.conditions);
        scope
    }

    /// The same without the constants whose names a formula does not have in its text. A file may have
    /// thousands of both.
    fn scope_of(&self, formula: &Formula) -> Scope {
        self.scope_with(self.constants_of(formula))
    }

    fn constants_of(&self, formula: &Formula) -> impl Iterator<Item = &(Quantity, f64)> {
        let text = formula.text();
        self.constants
            .known
            .iter()
            .filter(move |(constant, _)| text.contains(constant.name.as_str()))
    }

    fn scope_with<'a>(&self, constants: impl Iterator<Item = &'a (Quantity, f64)>) -> Scope {
        let mut scope = condition_scope(self.conditions, self.check_units);
        for (Quantity { name, unit, .. }, _) in constants {
            scope.define(name, Typing::in_unit(unit));
            if !self.check_units {
                scope.declare(name, unit.clone());
            }
        }
        scope
    }
}

impl ConditionSet<'_> {
    /// The names of a formula that are plain numbers by their units.
    fn plain_names<'s>(&'s self, formula: &'s Formula) -> HashSet<&'s str> {
        let constants = self.constants_of(formula).map(|(quantity, _)| quantity);
        let all = self.conditions.quantities.iter().chain(constants);
        let plain = all.filter(|quantity| quantity.unit.dimension().is_none());
        plain.map(|quantity| quantity.name.as_str()).collect()
    }

    /// A formula whose value is wanted in a unit.
    pub(super) fn compiled(&self, formula: &Formula, unit: &Unit, of: ValueOf) -> ConditionFormula {
        let form = number_form(self.check_units);
        let scope = self.scope_of(formula);
        let constants = self.constants_of(formula);
        let conditions = &self.conditions.quantities;
        ConditionFormula::new(formula, &scope, form, conditions, constants, (unit, of))
    }

    /// What a formula is; `None` where it cannot be told.
    pub(super) fn typing(&self, formula: &Formula) -> Option<Typing> {
        formula.check_names(&self.scope_of(formula)).ok()
    }
}

impl ConditionValues for ConditionSet<'_> {
    fn rows(&self) -> usize {
        self.conditions.rows.len()
    }

    fn are_unreadable(&self) -> bool {
        self.conditions.unreadable
    }

    fn check(
        &self,
        formula: &Formula,
        unit: &Unit,
        of: ValueOf,
    ) -> Result<(), Vec<DiagnosticKind>> {
        if self.conditions.unreadable {
            return Ok(());
        }
        let check = |scope: &Scope| match self.check_units {
            true => formula.check(scope),
            false => formula.check_names(scope),
        };
        // messages propose names that the formula does not have
        let result = check(&self.scope_of(formula)).or_else(|_| check(&self.scope()));
        let kind = |error: FormulaError| match error {
            FormulaError::UnknownName { name, .. } if self.constants.uncertain.contains(&name) => {
                DiagnosticKind::EstimateOfInput { name }
            }
            FormulaError::UnknownName { name, .. } if self.constants.computed.contains(&name) => {
                DiagnosticKind::EstimateOfFormula { name }
            }
            FormulaError::UnknownName { name, known, .. } if known.is_empty() => {
                DiagnosticKind::NothingToUse { name }
            }
            error => DiagnosticKind::Formula { error },
        };
        let kinds = |errors: Vec<FormulaError>| errors.into_iter().map(kind).collect::<Vec<_>>();
        let typing = result.map_err(kinds)?;
        if let Some(kind) = numbers_alone::mistake(formula, unit, of).filter(|_| self.check_units) {
            return Err(vec![kind]);
        }
        let is_unstated = |name: &str| {
            let lists = [&self.conditions.unstated, &self.constants.unstated];
            lists.into_iter().flatten().any(|unstated| unstated == name)
        };
        let unstated = numbers_alone::without_unit(formula, unit, is_unstated);
        let plain = || {
            let plain = self.plain_names(formula);
            numbers_alone::plain_number(formula, unit, of, |name| match is_unstated(name) {
                true => NameKind::Unstated,
                false if plain.contains(name) => NameKind::Stated,
                false => NameKind::Other,
            })
        };
        if self.check_units
            && let Some(kind) = unstated.or_else(plain)
        {
            return Err(vec![kind]);
        }
        match typing.dimension.filter(|_| self.check_units) {
            Some(dimension) if dimension != unit.dimension() => {
                return Err(vec![DiagnosticKind::WrongDimension {
                    name: "mean".to_owned(),
                    found: coherent(dimension),
                    found_as: dimension.describe(),
                    expected: unit.to_string(),
                    expected_as: unit.dimension().describe(),
                }]);
            }
            _ => {}
        }
        match shift(typing, unit, of) {
            Err(misfit) if self.check_units => {
                let (name, unit) = ("mean".to_owned(), unit.to_string());
                Err(vec![DiagnosticKind::WrongScale { name, unit, misfit }])
            }
            _ => Ok(()),
        }
    }

    fn values(&self, formula: &Formula, unit: &Unit, of: ValueOf) -> ValuesOfRows<'_> {
        if self.conditions.unreadable {
            return Box::new(|_| 1.0);
        }
        let compiled = self.compiled(formula, unit, of);
        let rows = &self.conditions.rows;
        Box::new(move |row| compiled.at(rows.get(row).map_or(&[][..], Vec::as_slice)))
    }

    fn place(&self, name: &str) -> Option<usize> {
        if self.conditions.unreadable {
            return Some(0);
        }
        self.conditions.quantities.iter().position(|quantity| quantity.name == name)
    }

    fn names(&self) -> Vec<String> {
        self.conditions.quantities.iter().map(|quantity| quantity.name.clone()).collect()
    }
}
