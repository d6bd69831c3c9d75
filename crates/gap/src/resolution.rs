//! The resolution of measured values, from the digits that they have, where it is coarser than their noise.
//!
//! Readings of a display that shows no scatter are equal, and their mean is no better known than one of them:
//! off by up to half a digit (JCGM 100, F.2.2.1). Noise that is estimated from such repeats would be nearly
//! zero, and any effect would be found in what rounding leaves.

use gumption_engine::decimal::to_15_digits;
use gumption_engine::task::Row;

use super::data::{Data, numbered};
use crate::{Case, ObservedOutput};

/// Displays count in these steps of their last digit.
const STEPS: [i64; 3] = [10, 5, 2];

/// The odds against a step that values have in common by chance, at least.
const LEAST_ODDS: f64 = 1e3;

/// Decimals that a display has, at most; values that were computed have more.
const MOST_DECIMALS: usize = 12;

/// Whole steps that are exact in floating point, at most.
const MOST_STEPS: f64 = 9e15;

/// Rounding of an output's values that their noise does not hold.
#[derive(Clone, Debug)]
pub(crate) struct Rounding {
    /// The resolution, in the output's unit.
    pub(crate) resolution: f64,
    /// For each row whether it counts there.
    counts: Vec<bool>,
}

impl Rounding {
    /// That of an output of the data, if its values are rounded more coarsely than their noise.
    pub(crate) fn of(case: &Case, data: &Data, output: usize) -> Option<Self> {
        let observed = case.observed[data.outputs[output]].as_ref()?;
        let resolution = resolution(&observed.values)?;
        let least = deviation(resolution);
        let counts: Vec<bool> = match &observed.standard_uncertainties {
            Some(u) => data.ids.iter().map(|&id| u[id] < least).collect(),
            None => vec![scatter(case, observed)? < 0.5 * resolution; data.rows()],
        };
        counts.contains(&true).then_some(Self { resolution, counts })
    }

    /// The standard deviation of what rounding changes.
    pub(crate) fn deviation(&self) -> f64 {
        deviation(self.resolution)
    }

    /// The rows of values that are rounded so.
    pub(crate) fn rows(&self) -> impl Iterator<Item = usize> {
        (0..self.counts.len()).filter(|&row| self.counts[row])
    }

    /// The rows that share an error: equal values at the same conditions.
    pub(crate) fn equal(&self, case: &Case, data: &Data, output: usize) -> Vec<Vec<usize>> {
        let rows: Vec<usize> = self.rows().collect();
        let key = |&row: &usize| {
            let conditions = case.task.rows[data.ids[row]].conditions.iter();
            conditions.chain([&data.values[output][row]]).map(|value| value.to_bits()).collect()
        };
        let numbers = numbered(rows.iter().map(key));
        let mut groups = vec![Vec::new(); numbers.iter().max().map_or(0, |most| most + 1)];
        for (row, number) in rows.into_iter().zip(numbers) {
            groups[number].push(row);
        }
        groups
    }
}

/// The standard deviation of a rectangular distribution as wide as a step.
fn deviation(step: f64) -> f64 {
    step / 12f64.sqrt()
}

/// The pooled standard deviation of values at the same conditions; `None` where there are no repeats.
fn scatter(case: &Case, observed: &ObservedOutput) -> Option<f64> {
    let rows = case.task.rows.iter();
    let key = |row: &Row| row.conditions.iter().map(|value| value.to_bits()).collect();
    let numbers = numbered(rows.map(key));
    let mut points = vec![Vec::new(); numbers.iter().max().map_or(0, |most| most + 1)];
    for (number, &value) in numbers.into_iter().zip(&observed.values) {
        points[number].push(value);
    }
    let (mut squares, mut free) = (0.0, 0.0);
    for values in &points {
        let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
        squares += values.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
        free += values.len().saturating_sub(1) as f64;
    }
    (free > 0.0).then(|| (squares / free).sqrt())
}

/// The step in which values were rounded: one, two or five in the last decimal that any of them has.
pub(crate) fn resolution(values: &[f64]) -> Option<f64> {
    let mut most = 0;
    for value in values {
        let text = to_15_digits(*value).to_string();
        most = most.max(text.split_once('.').map_or(0, |(_, decimals)| decimals.len()));
        if most > MOST_DECIMALS {
            return None;
        }
    }
    let step = format!("1e-{most}").parse::<f64>().ok()?;
    let mut counts: Vec<i64> = Vec::with_capacity(values.len());
    for value in values {
        let count = (value / step).round();
        if count.abs() > MOST_STEPS {
            return None;
        }
        counts.push(count as i64);
    }
    counts.sort_unstable();
    counts.dedup();
    let first = *counts.first()?;
    let more = i32::try_from(counts.len() - 1).unwrap_or(i32::MAX);
    let is_common = |of: &&i64| {
        counts.iter().all(|count| (count - first) % **of == 0)
            && (**of as f64).powi(more) > LEAST_ODDS
    };
    let common = STEPS.iter().find(is_common);
    Some(to_15_digits(step * common.map_or(1.0, |of| *of as f64)))
}

#[cfg(test)]
mod tests {
    use super::resolution;

    #[test]
    fn steps_of_values() {
        let of = |count: i64, step: f64| -> Vec<f64> {
            let value = |n: i64| gumption_engine::decimal::to_15_digits(20.0 + step * n as f64);
            (0..count).map(|n| value(n * n % 37)).collect()
        };
        for (step, wanted) in [(0.01, 0.01), (0.05, 0.05), (0.002, 0.002), (1.0, 1.0), (10.0, 10.0)]
        {
            let found = resolution(&of(40, step)).unwrap();
            assert!((found / wanted - 1.0).abs() < 1e-12, "{found} {wanted}");
        }
        // three values with steps of five by chance
        assert_eq!(resolution(&[0.05, 0.10, 0.25]), Some(0.01));
        assert_eq!(resolution(&[0.1, 1.0 / 3.0]), None);
        assert_eq!(resolution(&[1e17, 2e17]), None);
    }
}
