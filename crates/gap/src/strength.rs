//! How strong the gap is along each condition: finer than where it can be told from chance.

use super::diagnosis::{GapStrength, RowGap, StrengthPart};
use gumption_engine::number::smallest_first;
use gumption_inference::setup::Setup;

/// Parts that a condition's values are taken in, at most: its levels where it has no more.
const MOST_PARTS: usize = 8;

/// For each output and each condition that varies the share of the gap and the mean residual along it.
pub(crate) fn along(setup: &Setup<'_>, rows: &[RowGap]) -> Vec<GapStrength> {
    let case = setup.case;
    let outputs = setup.data.outputs.len();
    let all = (0..outputs).flat_map(|output| (0..case.measured()).map(move |c| (output, c)));
    all.filter_map(|(output, condition)| {
        let parts = parts(rows, output, condition)?;
        Some(GapStrength { output, condition, parts })
    })
    .collect()
}

fn parts(rows: &[RowGap], output: usize, condition: usize) -> Option<Vec<StrengthPart>> {
    let mut values: Vec<(f64, f64)> = rows
        .iter()
        .filter_map(|row| {
            let value = row.outputs.get(output)?;
            Some((*row.conditions.get(condition)?, value.before / value.u_before))
        })
        .collect();
    smallest_first(&mut values, |a| a.0);
    let mut levels: Vec<f64> = values.iter().map(|(x, _)| *x).collect();
    levels.dedup();
    if levels.len() < 2 {
        return None;
    }
    let excess = |z: f64| z * z - 1.0;
    let total: f64 = values.iter().map(|(_, z)| excess(*z)).sum();
    let count = levels.len().min(MOST_PARTS);
    let part = |n: usize| {
        // whole levels, as evenly as they go
        let own = &levels[n * levels.len() / count..(n + 1) * levels.len() / count];
        let (from, to) = (*own.first()?, *own.last()?);
        let within: Vec<f64> =
            values.iter().filter(|(x, _)| (from..=to).contains(x)).map(|(_, z)| *z).collect();
        let sum: f64 = within.iter().map(|z| excess(*z)).sum();
        Some(StrengthPart {
            range: [from, to],
            share_of_gap: if total > 0.0 { (sum / total).clamp(0.0, 1.0) } else { 0.0 },
            mean_z: within.iter().sum::<f64>() / within.len().max(1) as f64,
        })
    };
    (0..count).map(part).collect()
}
