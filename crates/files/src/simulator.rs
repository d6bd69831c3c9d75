//! `simulator`: a program that gives the outputs; which one it is says the command line, and no file.

use std::ops::Range;

use gumption_engine::model::formula::{Scope, Typing};
use gumption_engine::model::{Output, Quantity};
use gumption_gap::{ObservedOutput, OverridableModel, simulator_conditions};
use gumption_text::DiagnosticKind;
use gumption_text::json::Member;
use gumption_text::object::Object;

use super::conditions::{Conditions, parse_unit};
use super::input_set::InputSet;
use super::keys;

/// What a simulator gives: each output in the unit that it is given in, and where the file says so.
pub(super) type Given = Vec<(Quantity, Range<usize>)>;

/// Reads `simulator`; `None` after a mistake.
pub(super) fn read(root: &Object<'_>, member: &Member) -> Option<Given> {
    let log = root.log;
    let object = Object::new(log, "`simulator`", &member.value, &member.key_span)?;
    keys::check(&object, keys::SIMULATOR);
    for other in ["equations", "model", "fits"] {
        if let Some(other) = root.get(other) {
            let reason =
                format!("gives the outputs, and so does `{}`; take one of them out", other.key);
            log.report(&other.key_span, DiagnosticKind::Simulator { reason });
            return None;
        }
    }
    if root.get("observations").is_none() {
        let diagnostic = DiagnosticKind::OnlyWith { key: "simulator", with: "observations" };
        log.report(&member.key_span, diagnostic);
        return None;
    }
    let outputs = object.required("outputs")?;
    let outputs = Object::new(log, "`outputs`", &outputs.value, &outputs.key_span)?;
    let given = outputs.members().iter().map(|output| {
        let unit = parse_unit(log, outputs.text(&output.key)?, &output.value.span)?;
        let about = String::new();
        Some((Quantity { name: output.key.clone(), unit, about }, output.key_span.clone()))
    });
    // all mistakes at once
    given.collect::<Vec<_>>().into_iter().collect()
}

/// What formulas know: conditions and inputs, and the outputs as the simulator gives them.
pub(super) fn scope(mut scope: Scope, inputs: &InputSet, given: &Given) -> Scope {
    let inputs = inputs.quantities.iter().map(|input| &input.quantity);
    for Quantity { name, unit, .. } in inputs.chain(given.iter().map(|(output, _)| output)) {
        scope.define(name, Typing::in_unit(unit));
    }
    scope
}

/// Checks that the simulator gives all outputs and nothing else, in units that fit. Where units are not
/// checked nothing is converted, and units have to be the same.
pub(super) fn check_outputs(
    root: &Object<'_>,
    given: &Given,
    (outputs, places): (&[Output], &[Range<usize>]),
    check_units: bool,
) {
    let report = |place: &Range<usize>, reason: String| {
        root.log.report(place, DiagnosticKind::Simulator { reason });
    };
    for (output, place) in outputs.iter().zip(places) {
        let Quantity { name, unit, .. } = &output.quantity;
        match given.iter().find(|(given, _)| given.name == *name) {
            None => report(
                place,
                format!("does not give the output `{name}`; add it to the simulator's `outputs`"),
            ),
            Some((given, place)) => {
                let fits = if check_units {
                    given.unit.dimension() == unit.dimension()
                } else {
                    given.unit.text() == unit.text()
                };
                if !fits {
                    let given = &given.unit;
                    report(
                        place,
                        format!("gives `{name}` in {given}, and the output is in {unit}"),
                    );
                }
            }
        }
    }
    for (given, place) in given {
        if !outputs.iter().any(|output| output.quantity.name == given.name) {
            let name = &given.name;
            report(place, format!("gives `{name}`, which is none of the file's `outputs`"));
        }
    }
}

/// Adds what the simulator gives to the conditions: its outputs, as they were measured until it is run, and
/// the numbers of the rows. How many these are; `None` after a mistake.
pub(super) fn add_conditions(
    root: &Object<'_>,
    given: &Given,
    observed: &[Option<ObservedOutput>],
    sim: &mut OverridableModel,
    conditions: &mut Conditions,
) -> Option<usize> {
    let mut columns = Vec::new();
    for (quantity, place) in given {
        let output = sim.outputs.iter().position(|output| output.quantity.name == quantity.name)?;
        let Some(measured) = &observed[output] else {
            let reason = format!(
                "gives `{}`, which was not measured; add its column to the `observations`",
                quantity.name
            );
            root.log.report(place, DiagnosticKind::Simulator { reason });
            return None;
        };
        let (from, to) = (&sim.outputs[output].quantity.unit, &quantity.unit);
        let convert = |value: &f64| to.value_from_si(from.value_to_si(*value));
        columns.push(measured.values.iter().map(convert).collect::<Vec<f64>>());
    }
    let added = simulator_conditions(given.iter().map(|(quantity, _)| quantity.clone()));
    for (number, row) in conditions.rows.iter_mut().enumerate() {
        row.extend(columns.iter().map(|column| column[number]));
        row.push(number as f64);
    }
    conditions.reachable.extend(added.iter().map(|_| None));
    sim.conditions.extend(added.iter().cloned());
    let count = added.len();
    conditions.quantities.extend(added);
    Some(count)
}

#[cfg(test)]
mod tests;
