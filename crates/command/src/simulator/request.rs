//! What a program reads: the parameters of a run and the conditions of all rows.

use gumption_emulator::{SimulatorCase, SimulatorQuantity};
use serde_json::{Map, Value, json};

/// Makes the requests of a case.
#[derive(Debug)]
pub(super) struct Requests<'c> {
    parameters: &'c [SimulatorQuantity],
    /// The member `conditions`, which is the same in all requests.
    conditions: String,
}

impl<'c> Requests<'c> {
    pub(super) fn of(case: &'c SimulatorCase) -> Self {
        let conditions = case.conditions.iter();
        let conditions: Map<String, Value> = conditions
            .map(|condition| (condition.quantity.name.clone(), json!(condition.values)))
            .collect();
        Self { parameters: &case.parameters, conditions: Value::Object(conditions).to_string() }
    }

    /// The request of a run on one line, with its end. Numbers are written so that they are read to the
    /// bit.
    pub(super) fn request(&self, values: &[f64]) -> Vec<u8> {
        let parameters: Map<String, Value> = self
            .parameters
            .iter()
            .zip(values)
            .map(|(parameter, value)| (parameter.name.clone(), json!(value)))
            .collect();
        let (parameters, conditions) = (Value::Object(parameters), &self.conditions);
        format!("{{\"parameters\":{parameters},\"conditions\":{conditions}}}\n").into_bytes()
    }
}
