//! What a case must be as a whole: enough data, and values of the sim at all of them.

use super::effect_context::EffectContext;
use super::effects::Placed;
use gumption_gap::Effect;
use gumption_text::table::Table;
use gumption_text::{Collector, DiagnosticKind};

/// Checks a case that was read.
pub(super) fn check(log: &Collector, read: &EffectContext<'_>, placed: &[Placed], data: &Table) {
    enough(log, read, placed, data);
    // what could not be read of an effect is left out of it
    if log.is_clean() {
        placed.iter().for_each(|placed| changes_an_observed_output(log, read, placed));
    }
    if defined(log, read, data) {
        for placed in placed {
            defined_with(log, read, placed, data);
        }
    }
}

/// More unknown quantities than measured values leave nothing to tell them by.
fn enough(log: &Collector, read: &EffectContext<'_>, placed: &[Placed], data: &Table) {
    let rows = data.rows.len();
    let values = rows * read.observed.iter().flatten().count();
    for placed in placed {
        let Effect { name, parameters, .. } = &placed.candidate.effect;
        if values < parameters.len() {
            let reason = format!(
                "has {} parameters, but the data have only {values} measured value{}; no effect can \
                 be told from fewer values than it has parameters",
                parameters.len(),
                if values == 1 { "" } else { "s" }
            );
            log.report(&placed.place, DiagnosticKind::Effect { name: name.clone(), reason });
        }
    }
    let unknown =
        |observed: &&gumption_gap::ObservedOutput| observed.standard_uncertainties.is_none();
    if rows < 2 && read.observed.iter().flatten().any(|observed| unknown(&observed)) {
        let reason = "the data have one row and no standard uncertainties; the noise can be \
                      estimated from several rows only"
            .to_owned();
        log.report_at(data.place(0, 0), DiagnosticKind::Observation { reason });
    }
}

/// An effect that no observed output depends on can be neither found nor excluded.
fn changes_an_observed_output(log: &Collector, read: &EffectContext<'_>, placed: &Placed) {
    let effect = &placed.candidate.effect;
    if placed.neutral.is_some() || read.is_changed_by(effect) {
        return;
    }
    let quoted = |names: Vec<&str>| {
        names.into_iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
    };
    let overridden = quoted(effect.overrides.iter().map(|(name, _)| name.as_str()).collect());
    let outputs = read.sim.outputs.iter().zip(read.observed);
    let observed: Vec<&str> = outputs
        .filter(|(_, observed)| observed.is_some())
        .map(|(output, _)| output.quantity.name.as_str())
        .collect();
    let reason = format!(
        "changes no observed output: {} not computed from {overridden}; override a quantity that \
         they are computed from, or the output itself (the only way where `sim` names a column of \
         the data)",
        match observed.as_slice() {
            [one] => format!("`{one}` is"),
            _ => format!("{} are", quoted(observed)),
        }
    );
    let name = effect.name.clone();
    log.report(&placed.place, DiagnosticKind::Effect { name, reason });
}

/// Whether the sim has a value for every measured one.
fn defined(log: &Collector, read: &EffectContext<'_>, data: &Table) -> bool {
    let found = undefined(read, None);
    if let Some((row, output, why)) = &found {
        let reason = format!(
            "at the conditions of row {} of the data the sim gives no finite number for \
             `{output}`{why}",
            row + 1
        );
        log.report_at(data.place(*row, 0), DiagnosticKind::Observation { reason });
    }
    found.is_none()
}

/// Whether an effect leaves the sim a value for every measured one.
fn defined_with(log: &Collector, read: &EffectContext<'_>, placed: &Placed, data: &Table) {
    if let Some((row, output, why)) = undefined(read, Some(placed)) {
        let line_of = data.place(row, 0);
        let (line, _) = line_of.source.position(line_of.span.start);
        let reason = format!(
            "gives no finite number for `{output}` at the conditions of row {} of the data (line \
             {line} of `{}`), its parameters at their medians{why}",
            row + 1,
            line_of.source.name
        );
        let name = placed.candidate.effect.name.clone();
        log.report(&placed.place, DiagnosticKind::Effect { name, reason });
    }
}

/// The first row and observed output without a finite value, and the operation that gave none.
fn undefined(read: &EffectContext<'_>, placed: Option<&Placed>) -> Option<(usize, String, String)> {
    let candidate = placed.map(|placed| &placed.candidate);
    let effects: Vec<&Effect> = candidate.iter().map(|candidate| &candidate.effect).collect();
    // what is circular has been reported
    let program = read.sim.program(&effects).ok()?;
    let parameters: Vec<f64> = candidate
        .map(|candidate| candidate.priors.iter().map(|prior| prior.quantile(0.5)).collect())
        .unwrap_or_default();
    for (number, row) in read.task.rows.iter().enumerate() {
        let mut variables = row.estimates();
        variables.extend(&parameters);
        let values = program.evaluate(&variables);
        let faulty = read
            .sim
            .outputs
            .iter()
            .zip(values)
            .zip(read.observed)
            .find(|((_, value), observed)| observed.is_some() && !value.is_finite());
        if let Some(((output, _), _)) = faulty {
            let operation = program.first_undefined(&variables);
            let why = operation.map(|operation| format!(": {operation}")).unwrap_or_default();
            return Some((number, output.quantity.name.clone(), why));
        }
    }
    None
}
