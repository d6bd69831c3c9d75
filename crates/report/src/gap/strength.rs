//! How strong the gap is along each condition.

use serde_json::{Value, json};

use super::digits::{condition, share, tenths};
use super::words::in_unit;
use crate::answer::list;
use crate::plain;
use gumption_gap::{Diagnosis, GapStrength, StrengthPart};

/// A part is worth a word where its share of the gap is so many times that of an even gap.
const STRONG: f64 = 1.5;

/// The parts by output and condition.
pub(super) fn strength(diagnosis: &Diagnosis) -> Value {
    list(diagnosis.strength.iter().filter_map(|of| {
        let parts = of.parts.iter().map(|part| {
            json!({
                "range": part.range,
                "share_of_gap": part.share_of_gap,
                "mean_z": part.mean_z,
            })
        });
        Some(json!({
            "output": diagnosis.outputs.get(of.output)?.name,
            "condition": diagnosis.conditions.get(of.condition)?.name,
            "parts": list(parts),
        }))
    }))
}

/// Where along each condition the gap is strongest, a sentence for each output and condition along
/// which it is uneven.
pub(super) fn sentences(diagnosis: &Diagnosis) -> Vec<String> {
    diagnosis.strength.iter().filter_map(|of| sentence(diagnosis, of)).collect()
}

fn sentence(diagnosis: &Diagnosis, of: &GapStrength) -> Option<String> {
    let output = diagnosis.outputs.get(of.output)?;
    let named = diagnosis.conditions.get(of.condition)?;
    let most = of.parts.iter().max_by(|a, b| a.share_of_gap.total_cmp(&b.share_of_gap))?;
    if most.share_of_gap * of.parts.len() as f64 <= STRONG {
        return None;
    }
    let name = plain(&named.name);
    let range = |part: &StrengthPart| {
        let [from, to] = part.range;
        if from == to {
            format!("{name} = {}", in_unit(&condition(from), named))
        } else {
            format!("{name} from {} to {}", condition(from), in_unit(&condition(to), named))
        }
    };
    let least = of.parts.iter().min_by(|a, b| a.share_of_gap.total_cmp(&b.share_of_gap))?;
    Some(format!(
        "Along {name} the gap of {} is strongest at {} (share {}, mean z {}) and weakest at {} (share \
         {}, mean z {}).",
        plain(&output.name),
        range(most),
        share(most.share_of_gap),
        tenths(most.mean_z),
        range(least),
        share(least.share_of_gap),
        tenths(least.mean_z),
    ))
}
