//! A diagnosis as JSON.

use serde_json::{Value, json};

use super::words::note;
use super::{composed, departure, strength};
use crate::answer::{list, object, pretty};
use crate::number::exact;
use gumption_gap::{
    Diagnosis, EffectParameter, Hypothesis, NamedQuantity, PresentEffect, PriorConflict,
    ProposalKind, ReplicatedEffect, UnlistedEffect,
};

/// The diagnosis as JSON, keys in a fixed order; `null` for what is not defined. It ends in a
/// newline.
pub fn json(diagnosis: &Diagnosis) -> String {
    let Diagnosis { gap, most_probable: verdict, .. } = diagnosis;
    let mut entries = vec![
        ("title", json!(diagnosis.title)),
        ("sim", sim(diagnosis)),
        (
            "gap",
            json!({
                "present": gap.present,
                "p_value": gap.p_value,
                "chi2": gap.chi2,
                "dof": gap.dof,
            }),
        ),
        ("where", regions(diagnosis)),
        ("strength", strength::strength(diagnosis)),
        (
            "verdict",
            json!({
                "kind": verdict.kind.name(),
                "effects": verdict.effects,
                "prior_conflict": verdict.prior_conflict,
                "probability": verdict.probability,
                "beside": departure::beside(diagnosis),
                "group": verdict.indistinguishable,
                "group_probability": verdict.indistinguishable_probability,
            }),
        ),
        ("present", present(diagnosis)),
        ("replication", replication(diagnosis)),
    ];
    entries.extend(simulator(diagnosis).map(|simulator| ("simulator", simulator)));
    entries.extend([
        ("prior_conflicts", list(diagnosis.prior_conflicts.iter().map(prior_conflict))),
        ("hypotheses", list(diagnosis.hypotheses.iter().map(hypothesis))),
    ]);
    if !diagnosis.departure.is_empty() {
        entries.push(("departure", departure::departure(diagnosis)));
        entries.push(("composed", composed::composed(diagnosis)));
        entries.push(("unlisted", list(diagnosis.unlisted.iter().map(unlisted))));
    }
    entries.extend([
        ("shrinks", shrinks(diagnosis)),
        ("next_measurement", next(diagnosis)),
        ("equivalent", json!(diagnosis.next.equivalent)),
        ("entropy", json!(diagnosis.next.entropy)),
    ]);
    entries.extend(prediction(diagnosis).map(|prediction| ("prediction", prediction)));
    entries.push(("noise", noise(diagnosis)));
    let notes = diagnosis.notes.iter();
    entries.extend([
        ("rows", rows(diagnosis)),
        ("interrupted", json!(diagnosis.interrupted)),
        ("notes", list(notes.map(|of| json!({"code": of.code(), "message": note(of)})))),
        ("coverage_probability", json!(diagnosis.probability)),
        ("seed", json!(diagnosis.seed)),
        ("version", json!(env!("CARGO_PKG_VERSION"))),
    ]);
    pretty(&object(entries))
}

/// Values by name, in the order in which they are given.
fn named<V: Into<Value>>(names: &[NamedQuantity], values: impl IntoIterator<Item = V>) -> Value {
    object(names.iter().map(|named| named.name.as_str()).zip(values))
}

/// What the sim computes.
fn sim(diagnosis: &Diagnosis) -> Value {
    let given = |text: &str| Some(text.trim().to_owned()).filter(|text| !text.is_empty());
    let of = &diagnosis.sim;
    let equations = of.equations.iter();
    object([
        ("source", json!(given(&diagnosis.source))),
        ("model", json!(of.name)),
        ("model_source", json!(given(&of.source))),
        (
            "equations",
            object(equations.map(|(name, text)| (name.as_str(), Value::from(text.as_str())))),
        ),
    ])
}

fn regions(diagnosis: &Diagnosis) -> Value {
    list(diagnosis.regions.iter().map(|region| {
        let output = region.output.and_then(|output| diagnosis.outputs.get(output));
        let range = region.range.and_then(|(condition, range)| {
            Some((diagnosis.conditions.get(condition)?.name.as_str(), range))
        });
        json!({
            "output": output.map(|named| &named.name),
            "conditions": object(range),
            "p_value": region.p_value,
            "share_of_gap": region.share_of_gap,
            "mean_z": region.mean_z,
        })
    }))
}

/// What is known of a parameter.
fn parameter(of: &EffectParameter) -> Value {
    json!({
        "unit": of.unit,
        "estimate": of.estimate,
        "standard_uncertainty": of.standard_uncertainty,
        "interval": of.interval,
    })
}

/// Parameters by name.
fn parameters(of: &[EffectParameter]) -> Value {
    object(of.iter().map(|of| (of.name.as_str(), parameter(of))))
}

/// An effect of the shipped catalogue that would explain the gap.
fn unlisted(of: &UnlistedEffect) -> Value {
    json!({
        "effect": of.effect,
        "probability": of.probability,
        "parameters": parameters(&of.parameters),
    })
}

/// By effect, most probable first.
fn present(diagnosis: &Diagnosis) -> Value {
    let of = |present: &PresentEffect| {
        json!({
            "probability": present.probability,
            "parameters": parameters(&present.parameters),
        })
    };
    object(diagnosis.present.iter().map(|present| (present.effect.as_str(), of(present))))
}

/// Sizes of effects by group of rows.
/// How a simulator was run; `None` of another sim.
fn simulator(diagnosis: &Diagnosis) -> Option<Value> {
    let simulator = diagnosis.simulator.as_ref()?;
    let at_verdict = simulator.at_verdict.as_ref().map(|run| {
        let parameters = run.parameters.iter();
        let parameters = parameters.map(|(named, value)| (named.name.as_str(), *value));
        json!({
            "parameters": object(parameters),
            "error": run.error,
            "rms_residual": run.residual,
        })
    });
    Some(json!({
        "runs": simulator.runs,
        "failed": simulator.failed,
        "error": simulator.error,
        "at_verdict": at_verdict,
    }))
}

fn replication(diagnosis: &Diagnosis) -> Value {
    let Some(replication) = &diagnosis.replication else { return Value::Null };
    let of = |effect: &ReplicatedEffect| {
        let groups = replication.groups.iter().map(|group| exact(*group));
        let sizes: Vec<(String, Value)> = groups.zip(effect.sizes.iter().map(parameter)).collect();
        json!({
            "probability_shared": effect.probability_shared,
            "probability_own": effect.probability_own,
            "by_ratios": effect.by_ratios,
            "spread": effect.spread.as_ref().map(parameter),
            "sizes": object(sizes.iter().map(|(name, of)| (name.as_str(), of.clone()))),
        })
    };
    let effects = replication.effects.iter();
    json!({
        "condition": replication.condition.name,
        "effects": object(effects.map(|effect| (effect.effect.as_str(), of(effect)))),
    })
}

fn prior_conflict(of: &PriorConflict) -> Value {
    json!({
        "effect": of.effect,
        "effects": of.effects,
        "parameter": of.parameter.name,
        "unit": of.parameter.unit,
        "estimate": of.parameter.estimate,
        "standard_uncertainty": of.parameter.standard_uncertainty,
        "interval": of.parameter.interval,
        "prior_distance": of.prior_distance,
        "beyond_bound": of.bounded,
        "probability": of.probability,
    })
}

fn hypothesis(of: &Hypothesis) -> Value {
    json!({
        "effects": of.effects,
        "beside": of.beside,
        "probability": of.probability,
        "prior": of.prior,
        "log_evidence": of.log_evidence,
        // an error that is not known is larger than any
        "standard_error": if of.standard_error.is_finite() { of.standard_error } else { f64::MAX },
        "ess": of.effective_sample_size,
        "parameters": parameters(&of.parameters),
    })
}

fn shrinks(diagnosis: &Diagnosis) -> Value {
    let shrinkage = &diagnosis.shrinkage;
    let all = &shrinkage.all;
    let outputs = diagnosis.outputs.iter().zip(&shrinkage.outputs).map(|(output, shrunk)| {
        json!({
            "unit": output.unit,
            "rms_before": shrunk.rms_before,
            "rms_after": shrunk.rms_after,
            "noise_floor": shrunk.noise_floor,
            "removed_fraction": shrunk.removed_fraction,
        })
    });
    let shares = shrinkage.shares.iter();
    let shares = shares.map(|of| json!({"what": of.what.name(), "share_of_gap": of.share_of_gap}));
    json!({
        "rms_before": all.rms_before,
        "rms_after": all.rms_after,
        "rms_after_interval": shrinkage.rms_after_interval,
        "noise_floor": all.noise_floor,
        "removed_fraction": all.removed_fraction,
        "meaningful": shrinkage.meaningful,
        "claimed_fraction": shrinkage.claimed_fraction,
        "chi2_per_dof_before": shrinkage.chi2_per_dof[0],
        "chi2_per_dof_after": shrinkage.chi2_per_dof[1],
        "within_before": shrinkage.within[0],
        "within_after": shrinkage.within[1],
        "log_density_gain": shrinkage.log_density_gain,
        "blocks": shrinkage.blocks,
        "shares": list(shares),
        "outputs": named(&diagnosis.outputs, outputs),
    })
}

/// What to measure next, best first.
fn next(diagnosis: &Diagnosis) -> Value {
    list(diagnosis.next.proposals.iter().map(|proposal| {
        let mut entries = vec![("kind", json!(proposal.kind.name()))];
        if let Some(conditions) = proposal.kind.conditions() {
            let conditions = named(&diagnosis.conditions, conditions.iter().copied());
            entries.push(("conditions", conditions));
        }
        let standing = |named: &NamedQuantity, standard_uncertainty: f64| {
            [("unit", json!(named.unit)), ("standard_uncertainty", json!(standard_uncertainty))]
        };
        match &proposal.kind {
            ProposalKind::Input { input, standard_uncertainty, stated } => {
                entries.push(("input", json!(input.name)));
                entries.extend(standing(input, *standard_uncertainty));
                entries.push(("stated_standard_uncertainty", json!(stated)));
            }
            ProposalKind::Output { output, standard_uncertainty, .. } => {
                entries.push(("output", json!(output.name)));
                entries.extend(standing(output, *standard_uncertainty));
            }
            _ => {}
        }
        entries.extend([
            ("count", json!(proposal.count)),
            ("expected_entropy_loss", json!(proposal.expected_entropy_loss)),
            ("rows_for_20_to_1", json!(proposal.count_for_20_to_1)),
            ("separates", json!(diagnosis.next.separates)),
        ]);
        object(entries)
    }))
}

fn prediction(diagnosis: &Diagnosis) -> Option<Value> {
    let rows = diagnosis.prediction.as_ref()?.iter().map(|row| {
        let outputs = row.outputs.iter().zip(&row.model).map(|((value, standard_uncertainty), sim)| {
            json!({"value": value, "standard_uncertainty": standard_uncertainty, "sim": sim})
        });
        json!({
            "conditions": named(&diagnosis.conditions, row.conditions.iter().copied()),
            "outputs": named(&diagnosis.outputs, outputs),
        })
    });
    Some(json!({"rows": list(rows)}))
}

/// What is known of the noise, by output.
fn noise(diagnosis: &Diagnosis) -> Value {
    object(diagnosis.noise.iter().filter_map(|noise| {
        let output = diagnosis.outputs.get(noise.output)?;
        let mut entries = vec![("unit", json!(output.unit))];
        if let Some(estimated) = noise.estimated {
            entries.push(("standard_uncertainty", json!(estimated.standard_uncertainty)));
            entries.push(("power", json!(estimated.power)));
        }
        let figures = |estimate: f64, interval: [f64; 2], probability: f64| {
            json!({"estimate": estimate, "interval": interval, "probability": probability})
        };
        let factor = noise.factor.map(|of| figures(of.estimate, of.interval, of.probability));
        let serial = noise.serial.map(|of| figures(of.estimate, of.interval, of.probability));
        let suspects = noise.suspects.iter().map(|suspect| {
            json!({
                "row": suspect.row + 1,
                "output": output.name,
                "probability": suspect.probability,
                "size": suspect.size,
            })
        });
        entries.push(("factor", json!(factor)));
        entries.push(("serial_correlation", json!(serial)));
        let correlations = noise.correlations.iter().filter_map(|of| {
            let other = diagnosis.outputs.get(of.other)?;
            let mut entry = json!({"output": other.name});
            entry["estimate"] = json!(of.estimate);
            entry["interval"] = json!(of.interval);
            entry["probability"] = json!(of.probability);
            Some(entry)
        });
        entries.push(("output_correlations", list(correlations)));
        let settings = noise.settings.as_ref().map(|of| {
            let mut settings = figures(of.estimate, of.interval, of.probability);
            settings["condition"] = json!(of.condition);
            settings["standard_deviation"] = json!(of.standard_deviation);
            settings
        });
        entries.push(("setting_error", json!(settings)));
        entries.push(("suspect_rows", list(suspects)));
        Some((output.name.as_str(), object(entries)))
    }))
}

fn rows(diagnosis: &Diagnosis) -> Value {
    list(diagnosis.rows.iter().map(|row| {
        let outputs = row.outputs.iter().map(|value| {
            json!({
                "measured": value.measured,
                "standard_uncertainty": value.u,
                "before": value.before,
                "u_before": value.u_before,
                "comparison_error": value.comparison_error(),
                "validation_uncertainty": value.u_validation,
                "after": value.after,
                "u_after": value.u_after,
                "sim": value.sim(),
                "corrected": value.corrected(),
                "u_corrected": value.u_corrected,
            })
        });
        json!({
            "conditions": named(&diagnosis.conditions, row.conditions.iter().copied()),
            "outputs": named(&diagnosis.outputs, outputs),
        })
    }))
}
