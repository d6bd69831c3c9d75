//! The residuals of one output over one condition, as figures show them.

use super::words;
use gumption_engine::number::ascending;
use gumption_gap::{Diagnosis, RowGap, ValueGap};

/// One residual before and after the correction, each with its standard uncertainty.
#[derive(Clone, Copy, Debug)]
pub(super) struct Residual {
    /// Number of the row, from 0.
    pub(super) row: usize,
    /// Value of the condition.
    pub(super) x: f64,
    /// Before: residual and standard uncertainty.
    pub(super) before: (f64, f64),
    /// After.
    pub(super) after: (f64, f64),
}

/// What residuals are drawn over: a condition by its place, or the number of the row where no
/// condition varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Over {
    Condition(usize),
    Row,
}

impl Over {
    /// Where a row stands, the first having the number 0.
    pub(super) fn of(self, number: usize, row: &RowGap) -> Option<f64> {
        match self {
            Self::Condition(place) => row.conditions.get(place).copied(),
            Self::Row => Some((number + 1) as f64),
        }
    }

    /// What stands at the axis: the condition with its unit, or what the numbers are.
    pub(super) fn axis(self, diagnosis: &Diagnosis) -> String {
        match self {
            Self::Condition(place) => words::axis(&diagnosis.conditions[place]),
            Self::Row => "number of the row".to_owned(),
        }
    }

    /// The same within a sentence.
    pub(super) fn in_sentence(self, diagnosis: &Diagnosis) -> String {
        match self {
            Self::Condition(_) => self.axis(diagnosis),
            Self::Row => format!("the {}", self.axis(diagnosis)),
        }
    }
}

/// The distinct values of a condition in the data, in order.
pub(super) fn levels(diagnosis: &Diagnosis, condition: usize) -> Vec<f64> {
    let rows = diagnosis.rows.iter();
    let mut levels: Vec<f64> =
        rows.filter_map(|row| row.conditions.get(condition).copied()).collect();
    ascending(&mut levels);
    levels.dedup();
    levels
}

/// The conditions that vary and do not follow from the order of the rows.
pub(super) fn varying(diagnosis: &Diagnosis) -> Vec<usize> {
    let conditions = 0..diagnosis.conditions.len();
    let conditions = conditions.filter(|condition| !diagnosis.history.contains(condition));
    conditions.filter(|&condition| levels(diagnosis, condition).len() > 1).collect()
}

/// What the panels of a figure are drawn over: each condition that varies, or the number of the row.
pub(super) fn panels(diagnosis: &Diagnosis) -> Vec<Over> {
    let varying = varying(diagnosis);
    if varying.is_empty() {
        vec![Over::Row]
    } else {
        varying.into_iter().map(Over::Condition).collect()
    }
}

/// The condition with most levels.
pub(super) fn finest(diagnosis: &Diagnosis) -> Over {
    let varying = varying(diagnosis).into_iter();
    // of equals the first
    let finest = varying.rev().max_by_key(|&condition| levels(diagnosis, condition).len());
    finest.map_or(Over::Row, Over::Condition)
}

/// The residuals of an output.
pub(super) fn of(diagnosis: &Diagnosis, output: usize, over: Over) -> Vec<Residual> {
    let rows = diagnosis.rows.iter().enumerate();
    rows.filter_map(|(number, row)| {
        let x = over.of(number, row)?;
        let ValueGap { before, u_before, after, u_after, .. } = *row.outputs.get(output)?;
        let numbers = [x, before, u_before, after, u_after];
        let found =
            Residual { row: number, x, before: (before, u_before), after: (after, u_after) };
        numbers.iter().all(|number| number.is_finite()).then_some(found)
    })
    .collect()
}

/// The mean of what was measured of an output at some conditions; `None` where nothing was.
pub(super) fn measured_at(diagnosis: &Diagnosis, output: usize, conditions: &[f64]) -> Option<f64> {
    let rows = diagnosis.rows.iter().filter(|row| row.conditions == conditions);
    let values: Vec<f64> =
        rows.filter_map(|row| row.outputs.get(output)).map(|value| value.measured).collect();
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// What was measured of an output, what the sim says and what the corrected sim says, over a condition.
pub(super) fn overlaid(diagnosis: &Diagnosis, output: usize, over: Over) -> Vec<(f64, [f64; 3])> {
    let rows = diagnosis.rows.iter().enumerate();
    rows.filter_map(|(number, row)| {
        let x = over.of(number, row)?;
        let value = row.outputs.get(output)?;
        let values = [value.measured, value.sim(), value.corrected()];
        let finite = x.is_finite() && values.iter().all(|value| value.is_finite());
        finite.then_some((x, values))
    })
    .collect()
}
