//! A diagnosis as JSON.

use std::collections::BTreeMap;

use serde::Serialize;

use gumption_gap::{Diagnosis, NamedQuantity, Shrunk};

/// Numbers by name, in the order in which they are given.
#[derive(Debug)]
struct Ordered<V>(Vec<(String, V)>);

impl<V: Serialize> Serialize for Ordered<V> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

#[derive(Serialize)]
struct Answer {
    title: String,
    gap: Gap,
    r#where: Vec<Region>,
    verdict: Verdict,
    hypotheses: Vec<Hypothesis>,
    shrinks: Shrinks,
    next_measurement: Option<Next>,
    #[serde(skip_serializing_if = "Option::is_none")]
    prediction: Option<Prediction>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    noise: BTreeMap<String, Noise>,
    rows: Vec<Row>,
    notes: Vec<Note>,
    coverage_probability: f64,
    seed: u64,
    version: &'static str,
}

#[derive(Serialize)]
struct Gap {
    present: bool,
    p_value: Option<f64>,
    chi2: Option<f64>,
    dof: f64,
}

#[derive(Serialize)]
struct Region {
    output: Option<String>,
    conditions: Ordered<[f64; 2]>,
    p_value: f64,
    share_of_gap: f64,
    mean_z: f64,
}

#[derive(Serialize)]
struct Verdict {
    kind: &'static str,
    effects: Vec<String>,
    probability: f64,
    group: Vec<Vec<String>>,
    group_probability: f64,
}

#[derive(Serialize)]
struct Hypothesis {
    effects: Option<Vec<String>>,
    probability: f64,
    prior: f64,
    log_evidence: Option<f64>,
    standard_error: f64,
    ess: f64,
    parameters: Ordered<Parameter>,
}

#[derive(Serialize)]
struct Parameter {
    unit: String,
    estimate: f64,
    standard_uncertainty: f64,
    interval: [f64; 2],
}

#[derive(Serialize)]
struct Shrinks {
    rms_before: f64,
    rms_after: f64,
    rms_after_interval: [f64; 2],
    noise_floor: f64,
    removed_fraction: f64,
    meaningful: bool,
    claimed_fraction: f64,
    chi2_per_dof_before: f64,
    chi2_per_dof_after: f64,
    within_before: f64,
    within_after: f64,
    log_density_gain: f64,
    blocks: usize,
    outputs: Ordered<OfOutput>,
}

#[derive(Serialize)]
struct OfOutput {
    unit: String,
    rms_before: f64,
    rms_after: f64,
    noise_floor: f64,
    removed_fraction: f64,
}

#[derive(Serialize)]
struct Next {
    separates: [Vec<String>; 2],
    conditions: Ordered<f64>,
    expected_log_odds: f64,
}

#[derive(Serialize)]
struct Prediction {
    rows: Vec<PredictedRow>,
}

#[derive(Serialize)]
struct PredictedRow {
    conditions: Ordered<f64>,
    outputs: Ordered<Predicted>,
}

#[derive(Serialize)]
struct Predicted {
    value: f64,
    standard_uncertainty: f64,
}

#[derive(Serialize)]
struct Noise {
    unit: String,
    standard_uncertainty: f64,
    power: f64,
}

#[derive(Serialize)]
struct Row {
    conditions: Ordered<f64>,
    outputs: Ordered<Value>,
}

#[derive(Serialize)]
struct Value {
    measured: f64,
    standard_uncertainty: f64,
    before: f64,
    u_before: f64,
    after: f64,
    u_after: f64,
}

#[derive(Serialize)]
struct Note {
    code: &'static str,
    message: String,
}

/// The diagnosis as JSON, keys in a fixed order; `null` for what is not defined. It ends in a
/// newline.
pub fn json(diagnosis: &Diagnosis) -> String {
    let mut text = serde_json::to_string_pretty(&answer(diagnosis)).unwrap_or_default();
    text.push('\n');
    text
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

fn named<V>(names: &[NamedQuantity], values: impl Iterator<Item = V>) -> Ordered<V> {
    Ordered(names.iter().map(|named| named.name.clone()).zip(values).collect())
}

fn answer(diagnosis: &Diagnosis) -> Answer {
    let Diagnosis { outputs, conditions, gap, most_probable: verdict, shrinkage, .. } = diagnosis;
    let of_output = |(named, shrunk): (&NamedQuantity, &Shrunk)| OfOutput {
        unit: named.unit.clone(),
        rms_before: shrunk.rms_before,
        rms_after: shrunk.rms_after,
        noise_floor: shrunk.noise_floor,
        removed_fraction: shrunk.removed_fraction,
    };
    Answer {
        title: diagnosis.title.clone(),
        gap: Gap {
            present: gap.present,
            p_value: gap.p_value,
            chi2: finite(gap.chi2),
            dof: gap.dof,
        },
        r#where: diagnosis
            .regions
            .iter()
            .map(|region| Region {
                output: region
                    .output
                    .and_then(|output| outputs.get(output))
                    .map(|named| named.name.clone()),
                conditions: Ordered(
                    region
                        .range
                        .and_then(|(place, range)| {
                            Some((conditions.get(place)?.name.clone(), range))
                        })
                        .into_iter()
                        .collect(),
                ),
                p_value: region.p_value,
                share_of_gap: region.share_of_gap,
                mean_z: region.mean_z,
            })
            .collect(),
        verdict: Verdict {
            kind: verdict.kind.name(),
            effects: verdict.effects.clone(),
            probability: verdict.probability,
            group: verdict.indistinguishable.clone(),
            group_probability: verdict.indistinguishable_probability,
        },
        hypotheses: diagnosis
            .hypotheses
            .iter()
            .map(|hypothesis| Hypothesis {
                effects: hypothesis.effects.clone(),
                probability: hypothesis.probability,
                prior: hypothesis.prior,
                log_evidence: finite(hypothesis.log_evidence),
                standard_error: finite(hypothesis.standard_error).unwrap_or(f64::MAX),
                ess: hypothesis.effective_sample_size,
                parameters: Ordered(
                    hypothesis
                        .parameters
                        .iter()
                        .map(|parameter| {
                            let value = Parameter {
                                unit: parameter.unit.clone(),
                                estimate: parameter.estimate,
                                standard_uncertainty: parameter.standard_uncertainty,
                                interval: parameter.interval,
                            };
                            (parameter.name.clone(), value)
                        })
                        .collect(),
                ),
            })
            .collect(),
        shrinks: Shrinks {
            rms_before: shrinkage.all.rms_before,
            rms_after: shrinkage.all.rms_after,
            rms_after_interval: shrinkage.rms_after_interval,
            noise_floor: shrinkage.all.noise_floor,
            removed_fraction: shrinkage.all.removed_fraction,
            meaningful: shrinkage.meaningful,
            claimed_fraction: shrinkage.claimed_fraction,
            chi2_per_dof_before: shrinkage.chi2_per_dof[0],
            chi2_per_dof_after: shrinkage.chi2_per_dof[1],
            within_before: shrinkage.within[0],
            within_after: shrinkage.within[1],
            log_density_gain: shrinkage.log_density_gain,
            blocks: shrinkage.blocks,
            outputs: named(outputs, outputs.iter().zip(&shrinkage.outputs).map(of_output)),
        },
        next_measurement: diagnosis.next.as_ref().map(|next| Next {
            separates: next.separates.clone(),
            conditions: named(conditions, next.conditions.iter().copied()),
            expected_log_odds: next.expected_log_odds,
        }),
        prediction: diagnosis.prediction.as_ref().map(|rows| Prediction {
            rows: rows
                .iter()
                .map(|row| PredictedRow {
                    conditions: named(conditions, row.conditions.iter().copied()),
                    outputs: named(
                        outputs,
                        row.outputs.iter().map(|&(value, standard_uncertainty)| Predicted {
                            value,
                            standard_uncertainty,
                        }),
                    ),
                })
                .collect(),
        }),
        noise: diagnosis
            .noise
            .iter()
            .filter_map(|noise| {
                let named = outputs.get(noise.output)?;
                let value = Noise {
                    unit: named.unit.clone(),
                    standard_uncertainty: noise.standard_uncertainty,
                    power: noise.power,
                };
                Some((named.name.clone(), value))
            })
            .collect(),
        rows: diagnosis
            .rows
            .iter()
            .map(|row| Row {
                conditions: named(conditions, row.conditions.iter().copied()),
                outputs: named(
                    outputs,
                    row.outputs.iter().map(|value| Value {
                        measured: value.measured,
                        standard_uncertainty: value.u,
                        before: value.before,
                        u_before: value.u_before,
                        after: value.after,
                        u_after: value.u_after,
                    }),
                ),
            })
            .collect(),
        notes: diagnosis
            .notes
            .iter()
            .map(|note| Note { code: note.code, message: note.text.clone() })
            .collect(),
        coverage_probability: diagnosis.probability,
        seed: diagnosis.seed,
        version: env!("CARGO_PKG_VERSION"),
    }
}
