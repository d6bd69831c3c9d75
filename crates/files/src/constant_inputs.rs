//! Inputs that are constants, as estimates' formulas see them: `"mean": "2*k"`.

use std::collections::HashSet;

use super::condition_values::ConditionValues;
use super::conditions::{Conditions, unit};
use super::overrides::Override;
use super::scopes::ConditionSet;
use gumption_engine::model::Quantity;
use gumption_engine::model::formula::Formula;
use gumption_text::Collector;
use gumption_text::json::{Json, Member};
use gumption_text::object::Object;
use gumption_text::value_text::{ValueOf, is_value};
use gumption_units::Unit;

/// The inputs of a file by whether formulas of estimates may use them.
#[derive(Debug, Default)]
pub(super) struct ConstantInputs {
    /// Those with a constant for a distribution, each with its value in its unit.
    pub(super) known: Vec<(Quantity, f64)>,
    /// The names of those of which no unit is said, so that they are plain numbers.
    pub(super) unstated: Vec<String>,
    /// The names of constants whose value is a formula of conditions, or one with a mistake.
    pub(super) computed: Vec<String>,
    /// The names of the others.
    pub(super) uncertain: Vec<String>,
}

/// What the text of a constant says of its value.
enum ConstantText {
    /// A number written out, in the constant's unit.
    Value(Unit, f64),
    /// A formula, whose value is in the constant's unit.
    Formula(Unit, Formula),
}

impl ConstantInputs {
    /// Of `inputs`. Mistakes are reported where the inputs themselves are read.
    pub(super) fn read(
        log: &Collector,
        inputs: &Member,
        overrides: &[Override],
        check_units: bool,
    ) -> Self {
        let mut found = Self::default();
        let Json::Object(members) = &inputs.value.value else { return found };
        let unsaid = Collector::new(log.source.clone());
        log.own_units().iter().for_each(|unit| unsaid.define_unit(unit.clone()));
        let quantity = |name: &str, unit| {
            let (name, about) = (name.to_owned(), String::new());
            Quantity { name, unit, about }
        };
        let mut formulas = Vec::new();
        for member in members {
            let object = Object::new(&unsaid, "an input", &member.value, &member.key_span);
            if object.is_some_and(|object| object.get("unit").is_none()) {
                found.unstated.push(member.key.clone());
            }
            match constant(&unsaid, member, overrides) {
                Some(ConstantText::Value(unit, value)) => {
                    found.known.push((quantity(&member.key, unit), value));
                }
                Some(ConstantText::Formula(unit, formula)) => {
                    formulas.push((&member.key, unit, formula))
                }
                None => found.uncertain.push(member.key.clone()),
            }
        }
        // of other constants, whose formulas may stand behind
        let conditions = Conditions::none();
        let mut known: HashSet<String> =
            found.known.iter().map(|(quantity, _)| quantity.name.clone()).collect();
        loop {
            let set = ConditionSet { conditions: &conditions, check_units, constants: &found };
            let of = ValueOf::Quantity;
            let next = formulas.iter().position(|(_, unit, formula)| {
                formula.names().all(|(name, _)| known.contains(name))
                    && set.check(formula, unit, of).is_ok()
            });
            let Some((name, unit, formula)) = next.map(|next| formulas.remove(next)) else { break };
            let value = set.value(&formula, 0, &unit, of);
            known.insert(name.clone());
            found.known.push((quantity(name, unit), value));
        }
        found.computed.extend(formulas.into_iter().map(|(name, ..)| name.clone()));
        found
    }
}

/// What an input says of its value that is a constant; `None` of every other one.
fn constant(log: &Collector, member: &Member, overrides: &[Override]) -> Option<ConstantText> {
    let object = Object::new(log, "an input", &member.value, &member.key_span)?;
    let is_constant = object.text("distribution") == Some("constant");
    if !is_constant || ["components", "complex"].iter().any(|key| object.get(key).is_some()) {
        return None;
    }
    let unit = unit(&object, "unit")?;
    let moved = overrides.iter().rev().find(|o| o.input == member.key && o.field.is_none());
    if let Some(moved) = moved {
        let value = moved.value_of_file(&unit, log).ok()?;
        return Some(ConstantText::Value(unit, value));
    }
    match &object.get("value")?.value.value {
        Json::Text(text) if !is_value(text) => {
            let formula = Formula::parse_with(text, &[], &log.own_units()).ok()?;
            Some(ConstantText::Formula(unit, formula))
        }
        _ => {
            let value = object.value("value", &unit, ValueOf::Quantity)?;
            Some(ConstantText::Value(unit, value))
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::read_text;

    fn file(inputs: &str, equation: &str) -> String {
        format!(
            r#"{{"inputs": {{{inputs}}}, "equations": {{"y": "{equation}"}},
              "outputs": {{"y": {{"unit": "V"}}}}}}"#
        )
    }

    /// 2 k of 1.5 V is 3000 mV, wherever k stands and however it is written; 1 % of it is 30 mV.
    #[test]
    fn an_estimate_of_a_constant() {
        let a = r#""a": {"unit": "mV", "distribution": "normal", "mean": "2*k", "std": "1 %"}"#;
        for k in [
            r#"{"unit": "V", "distribution": "constant", "value": 1.5}"#,
            r#"{"unit": "mV", "distribution": "constant", "value": "1.5 V"}"#,
        ] {
            for inputs in [format!(r#""k": {k}, {a}"#), format!(r#"{a}, "k": {k}"#)] {
                let task = read_text("t", &file(&inputs, "a"), Path::new(""), &[]).unwrap().task;
                let number = task.variables.iter().position(|of| of.name == "a").unwrap();
                let known = &task.rows[0].distributions[number];
                assert!((known.mean() - 3000.0).abs() < 1e-9, "{inputs}");
                assert!((known.standard_uncertainty() - 30.0).abs() < 1e-9, "{inputs}");
            }
        }
    }

    /// 2 c is 12 V where c is 4 k + 2 V and k is 1 V, in whatever order they stand.
    #[test]
    fn constants_that_are_formulas_of_constants() {
        let k = r#""k": {"unit": "V", "distribution": "constant", "value": 1}"#;
        let c = r#""c": {"unit": "mV", "distribution": "constant", "value": "4*k + 2 [V]"}"#;
        let a = r#""a": {"unit": "V", "distribution": "normal", "mean": "2*c", "std": 1}"#;
        for inputs in [[k, c, a], [a, c, k], [c, k, a]] {
            let text = file(&inputs.join(", "), "a");
            let task = read_text("t", &text, Path::new(""), &[]).unwrap().task;
            let number = task.variables.iter().position(|of| of.name == "a").unwrap();
            assert!((task.rows[0].distributions[number].mean() - 12.0).abs() < 1e-12);
        }
        let circular = c.replace("4*k + 2 [V]", "2*c");
        let said = read_text("t", &file(&[&circular, a].join(", "), "a"), Path::new(""), &[]);
        let said = said.unwrap_err().to_string();
        assert!(said.contains("`c` is itself a formula"), "{said}");
    }

    /// A replaced value counts, and dimensions are checked.
    #[test]
    fn replaced_and_wrong_constants() {
        let inputs = r#""k": {"unit": "V", "distribution": "constant", "value": 1},
            "a": {"unit": "mV", "distribution": "normal", "mean": "2*k", "std": 1}"#;
        let set = [Override::parse("k=2 V").unwrap()];
        let task = read_text("t", &file(inputs, "a"), Path::new(""), &set).unwrap().task;
        assert!((task.rows[0].distributions[1].mean() - 4000.0).abs() < 1e-9);
        let wrong = file(&inputs.replace("2*k", "k^2"), "a");
        let said = read_text("t", &wrong, Path::new(""), &[]).unwrap_err().to_string();
        assert!(said.contains("mean"), "{said}");
        let uncertain =
            inputs.replace(r#""constant", "value": 1"#, r#""normal", "mean": 1, "std": 1"#);
        let said =
            read_text("t", &file(&uncertain, "a"), Path::new(""), &[]).unwrap_err().to_string();
        assert!(said.contains("`k` has an uncertainty") && said.contains("equations"), "{said}");
    }
}
