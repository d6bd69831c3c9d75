//! `simulator`: a program that gives the outputs; which one it is says the command line, and no file.

use std::ops::Range;

use gumption_emulator::{Parameter, SimulatorEffect, Space};
use gumption_engine::model::{Quantity, variables};
use gumption_engine::task::{Sharing, Task};
use gumption_gap::{ModelForm, ObservedOutput, OverridableModel, Simulator, simulator_conditions};
use gumption_text::DiagnosticKind;
use gumption_text::json::Member;
use gumption_text::object::Object;
use gumption_text::value_text::ValueOf;

use super::conditions::{Conditions, parse_unit};
use super::effects::Placed;
use super::input_set::InputSet;
use super::keys;
use super::outputs::Outputs;
use gumption_engine::model::formula::{Scope, Typing};

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
    outputs: &Outputs,
    check_units: bool,
) {
    let report = |place: &Range<usize>, reason: String| {
        root.log.report(place, DiagnosticKind::Simulator { reason });
    };
    for (output, place) in outputs.outputs.iter().zip(&outputs.places) {
        let Quantity { name, unit, .. } = &output.quantity;
        match given.iter().find(|(given, _)| given.name == *name) {
            None => report(
                place,
                format!("does not give the output `{name}`; add it to the simulator's `outputs`"),
            ),
            Some(_) if outputs.without_unit.contains(name) => {}
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
        if !outputs.outputs.iter().any(|output| output.quantity.name == given.name) {
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

/// Numbers the candidates that the simulator can do by itself; it with its parameters, unless they are none.
pub(super) fn of_case(
    root: &Object<'_>,
    sim: &OverridableModel,
    task: &Task,
    placed: &mut [Placed],
) -> Option<Simulator> {
    let member = root.get("simulator").filter(|_| matches!(sim.maker, ModelForm::Simulated))?;
    let report = |place: &Range<usize>, reason: String| {
        root.log.report(place, DiagnosticKind::Simulator { reason });
    };
    let mut names: Vec<&str> = Vec::new();
    let mut inputs = Vec::new();
    let first = task.rows.first()?;
    if variables(&sim.inputs, &[]) != sim.inputs.len() {
        report(&member.key_span, "takes inputs of one number each; an input here has parts".into());
        return None;
    }
    for (variable, prior) in task.variables.iter().zip(first.distributions.iter()) {
        let name = &variable.name;
        if variable.sharing != Sharing::All {
            let reason = format!(
                "is run with one value of each input for all rows, and `{name}` has one for each row \
                 or condition"
            );
            report(&member.key_span, reason);
            return None;
        }
        names.push(name);
        inputs.push(Parameter { name: name.clone(), prior: (**prior).clone() });
    }
    let mut effects = Vec::new();
    for placed in placed.iter_mut() {
        let Some(neutral) = placed.neutral.clone() else { continue };
        let candidate = &mut placed.candidate;
        candidate.simulator = Some(effects.len());
        let parameters = candidate.effect.parameters.iter().zip(&candidate.priors);
        let parameters =
            parameters.map(|(q, prior)| Parameter { name: q.name.clone(), prior: prior.clone() });
        let parameters: Vec<Parameter> = parameters.collect();
        effects.push(SimulatorEffect { name: candidate.effect.name.clone(), parameters, neutral });
    }
    for placed in placed.iter().filter(|placed| placed.neutral.is_some()) {
        for quantity in &placed.candidate.effect.parameters {
            if names.contains(&quantity.name.as_str()) {
                let reason = format!(
                    "gets all parameters by their names, and there are two of `{}`; give each a name of \
                     its own",
                    quantity.name
                );
                report(&placed.place, reason);
                return None;
            }
            names.push(&quantity.name);
        }
    }
    let space = Space::new(inputs, effects);
    let space = space.map_err(|error| report(&member.key_span, format!("cannot be run: {error}")));
    Some(Simulator::new(space.ok()?))
}

/// What makes an effect of the simulator absent: places of its parameters with values; `None` after a
/// mistake. With one parameter it is 0 where the file does not say so.
pub(super) fn neutral(
    effect: &Object<'_>,
    parameters: &[Quantity],
    diagnostic: impl Fn(&str) -> DiagnosticKind,
) -> Option<Vec<(usize, f64)>> {
    let Some(member) = effect.get("neutral") else {
        return match parameters {
            [_] => Some(vec![(0, 0.0)]),
            [] => {
                effect.report(diagnostic(
                    "has no parameter, and the simulator can only do what a parameter lets it",
                ));
                None
            }
            [first, ..] => {
                let reason = format!(
                    "has {} parameters; say which of them make it absent, and at what values: \
                     `\"neutral\": {{\"{}\": 0}}`, the others being its shape",
                    parameters.len(),
                    first.name
                );
                effect.report(diagnostic(&reason));
                None
            }
        };
    };
    let object = Object::new(effect.log, "`neutral`", &member.value, &member.key_span)?;
    if object.members().is_empty() {
        object.report(diagnostic("names no parameter that makes it absent"));
        return None;
    }
    let value = |member: &Member| {
        let Some(place) = parameters.iter().position(|p| p.name == member.key) else {
            let reason = format!("has no parameter `{}` that could make it absent", member.key);
            effect.log.report(&member.key_span, diagnostic(&reason));
            return None;
        };
        let unit = &parameters[place].unit;
        Some((place, object.value(&member.key, unit, ValueOf::Quantity)?))
    };
    object.members().iter().map(value).collect::<Vec<_>>().into_iter().collect()
}

#[cfg(test)]
mod tests;
