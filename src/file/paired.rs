//! Readings that belong together: `"paired": true`.

use super::Fault;
use super::inputs::Inputs;
use super::problem::Log;
use crate::distribution::{Distribution, Readings};

/// Makes ensembles of the paired readings, all those of equal length one. The variables must be
/// complete in every row; else a mistake has been reported already.
pub(super) fn apply(log: &Log, inputs: &mut Inputs) {
    let count = inputs.variables.len();
    if inputs.rows.iter().any(|row| row.len() != count) {
        return;
    }
    let Some(row) = inputs.rows.first() else {
        return;
    };
    let length = |v: usize| match row.get(v) {
        Some(Distribution::Readings(readings)) => readings.values().len(),
        _ => 0,
    };
    let mut ensembles: Vec<(usize, Vec<usize>)> = Vec::new();
    for &variable in &inputs.paired {
        let length = length(variable);
        match ensembles.iter_mut().find(|(known, _)| *known == length) {
            Some((_, members)) => members.push(variable),
            None => ensembles.push((length, vec![variable])),
        }
    }
    for (length, members) in &ensembles {
        if let Err((variable, fault)) = check(inputs, *length, members) {
            if let Some(place) = inputs.places.get(variable) {
                log.report(place, fault);
            }
            continue;
        }
        for row in &mut inputs.rows {
            for &member in members {
                if let Some(Distribution::Readings(readings)) = row.get_mut(member) {
                    if let Ok(paired) = readings.clone().paired(members.len()) {
                        *readings = paired;
                    }
                }
            }
        }
    }
}

/// Whether these variables, read `length` times each, can be an ensemble; else the variable at
/// fault and why.
fn check(inputs: &Inputs, length: usize, members: &[usize]) -> Result<(), (usize, Fault)> {
    let name = |v: usize| inputs.variables.get(v).map_or("", |variable| variable.name.as_str());
    let Some((&first, others)) = members.split_first() else {
        return Ok(());
    };
    if others.is_empty() {
        let reason = if inputs.paired.len() > 1 {
            format!(
                "`{}` has {length} paired readings, but no other paired readings are as many; \
                 readings that belong together are equally many",
                name(first)
            )
        } else {
            format!(
                "`{}` has the only paired readings; paired readings are two or more",
                name(first)
            )
        };
        return Err((first, Fault::Correlation { reason }));
    }
    let sharing = |v: usize| inputs.variables.get(v).map(|variable| &variable.sharing);
    if let Some(&other) = others.iter().find(|&&other| sharing(other) != sharing(first)) {
        let reason = format!(
            "`{}` and `{}` have paired readings, but not the same `per`",
            name(first),
            name(other)
        );
        return Err((other, Fault::Correlation { reason }));
    }
    match inputs.rows.first().and_then(|row| row.get(first)) {
        Some(Distribution::Readings(readings)) => Readings::clone(readings)
            .paired(members.len())
            .map(|_| ())
            .map_err(|error| (first, Fault::Distribution { name: name(first).to_owned(), error })),
        _ => Ok(()),
    }
}
