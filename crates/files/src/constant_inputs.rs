//! Inputs that are constants, as estimates' formulas see them: `"mean": "2*k"`.

use super::conditions::unit;
use super::diagnostics::Collector;
use super::json::{Json, Member};
use super::object::Object;
use super::overrides::Override;
use super::value_text::{ValueOf, is_value};
use gumption_engine::model::Quantity;
use gumption_units::Unit;

/// The inputs of a file by whether formulas of estimates may use them.
#[derive(Debug, Default)]
pub(super) struct ConstantInputs {
    /// Those with a constant for a distribution, each with its value in its unit.
    pub(super) known: Vec<(Quantity, f64)>,
    /// The names of the others.
    pub(super) uncertain: Vec<String>,
}

impl ConstantInputs {
    /// Of `inputs`. Mistakes are reported where the inputs themselves are read.
    pub(super) fn read(log: &Collector, inputs: &Member, overrides: &[Override]) -> Self {
        let mut found = Self::default();
        let Json::Object(members) = &inputs.value.value else { return found };
        let unsaid = Collector::new(log.source.clone());
        log.own_units().iter().for_each(|unit| unsaid.define_unit(unit.clone()));
        for member in members {
            match value(&unsaid, member, overrides) {
                Some((unit, value)) => {
                    let (name, about) = (member.key.clone(), String::new());
                    found.known.push((Quantity { name, unit, about }, value));
                }
                None => found.uncertain.push(member.key.clone()),
            }
        }
        found
    }
}

/// The value of an input that is a constant written out, with its unit.
fn value(log: &Collector, member: &Member, overrides: &[Override]) -> Option<(Unit, f64)> {
    let object = Object::new(log, "an input", &member.value, &member.key_span)?;
    let is_constant = object.text("distribution") == Some("constant");
    if !is_constant || ["components", "complex"].iter().any(|key| object.get(key).is_some()) {
        return None;
    }
    let unit = unit(&object, "unit")?;
    let moved = overrides.iter().rev().find(|o| o.input == member.key && o.field.is_none());
    let value = match moved {
        Some(moved) => moved.value_in(&unit, &log.own_units()).ok()?,
        None => {
            let is_formula = match &object.get("value")?.value.value {
                Json::Text(text) => !is_value(text),
                _ => false,
            };
            if is_formula {
                return None;
            }
            object.value("value", &unit, ValueOf::Quantity)?
        }
    };
    Some((unit, value))
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
