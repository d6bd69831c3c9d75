//! What the simulator of a case is run with.

use std::ops::Range;

use gumption_emulator::{Parameter, SimulatorEffect, Space};
use gumption_engine::model::variables;
use gumption_engine::task::{Sharing, Task};
use gumption_gap::{ModelForm, OverridableModel, SimulatorModel};
use gumption_text::DiagnosticKind;
use gumption_text::object::Object;

use super::effects::Placed;

/// Numbers the candidates that the simulator can do by itself; it with its parameters, unless they are none.
pub(super) fn read(
    root: &Object<'_>,
    sim: &OverridableModel,
    task: &Task,
    placed: &mut [Placed],
) -> Option<SimulatorModel> {
    let member = root.get("simulator").filter(|_| matches!(sim.maker, ModelForm::Simulated))?;
    let report = |place: &Range<usize>, reason: String| {
        root.log.report(place, DiagnosticKind::Simulator { reason });
    };
    let object = Object::new(root.log, "`simulator`", &member.value, &member.key_span)?;
    let noisy = object.truth("noisy").unwrap_or(false);
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
    Some(SimulatorModel::new(space.ok()?).noisy(noisy))
}
