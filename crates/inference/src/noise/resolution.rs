//! The resolution of measured values, from the digits that they have, where it is coarser than their noise.
//!
//! Readings of a display that shows no scatter are equal, and their mean is no better known than one of them:
//! off by up to half a digit (JCGM 100, F.2.2.1). Noise that is estimated from such repeats would be nearly
//! zero, and any effect would be found in what rounding leaves.

use gumption_engine::decimal::to_15_digits;

use crate::Case;
use crate::data::{Data, numbered};

/// Displays count in these steps of their last digit.
const STEPS: [i64; 3] = [10, 5, 2];

/// The odds against a step that values have in common by chance, at least.
const LEAST_ODDS: f64 = 1e3;

/// Decimals that a display has, at most; values that were computed have more.
const MOST_DECIMALS: usize = 12;

/// Nominal values that are this near to whole steps, in steps, are set in them.
const SET_POINT: f64 = 0.05;

/// Whole steps that are exact in floating point, at most.
const MOST_STEPS: f64 = 9e15;

/// Rounding of an output's values that their noise does not hold.
#[derive(Clone, Debug)]
pub struct Rounding {
    /// The resolution, in the output's unit.
    pub resolution: f64,
    /// For each row whether it counts there.
    counts: Vec<bool>,
    /// For each row whether the stated uncertainty has room for it.
    stated: Vec<bool>,
    /// For each row the number of its set point.
    set_points: Vec<usize>,
}

impl Rounding {
    /// That of an output of the data, if its values are rounded more coarsely than their noise.
    pub fn of(case: &Case, data: &Data, output: usize) -> Option<Self> {
        let observed = case.observed[data.outputs[output]].as_ref()?;
        // steps between set points are none of a display
        let nominal = |step: f64| {
            let mut values = data.points.iter().map(|point| point.nominal[output] / step);
            values.all(|value| (value - value.round()).abs() < SET_POINT)
        };
        let resolution = resolution(&observed.values, observed.last_digit, nominal)?;
        let least = deviation(resolution);
        let set_points = set_points(case, data, output);
        let is_equal =
            scatter(data, output, &set_points).is_some_and(|scatter| scatter < 0.5 * resolution);
        let counts: Vec<bool> = match &observed.standard_uncertainties {
            Some(u) => data.ids.iter().map(|&id| is_equal || u[id] < least).collect(),
            None => vec![is_equal; data.rows()],
        };
        let stated = match &observed.standard_uncertainties {
            Some(u) => data.ids.iter().map(|&id| u[id] >= least).collect(),
            None => vec![false; data.rows()],
        };
        counts.contains(&true).then_some(Self { resolution, counts, stated, set_points })
    }

    /// The variance that the value of a row has beside its own: none where the stated uncertainty has room
    /// for the rounding.
    pub fn variance(&self, row: usize) -> f64 {
        if self.counts[row] && !self.stated[row] { self.deviation().powi(2) } else { 0.0 }
    }

    /// The standard deviation of what rounding changes.
    pub fn deviation(&self) -> f64 {
        deviation(self.resolution)
    }

    /// The rows of values that are rounded so.
    pub fn rows(&self) -> impl Iterator<Item = usize> {
        (0..self.counts.len()).filter(|&row| self.counts[row])
    }

    /// The rows that share an error: equal values at the same set point.
    pub(crate) fn equal(&self, data: &Data, output: usize) -> Vec<Vec<usize>> {
        let rows: Vec<usize> = self.rows().collect();
        let key =
            |&row: &usize| vec![self.set_points[row] as u64, data.values[output][row].to_bits()];
        let numbers = numbered(rows.iter().map(key));
        let mut groups = vec![Vec::new(); numbers.iter().max().map_or(0, |most| most + 1)];
        for (row, number) in rows.into_iter().zip(numbers) {
            groups[number].push(row);
        }
        groups
    }
}

/// For each row the number of its set point: that of its conditions, or where no row has those of another
/// one, as with the time of each reading beside them, that of what the sim says.
fn set_points(case: &Case, data: &Data, output: usize) -> Vec<usize> {
    let numbers = data.settings(case);
    if numbers.iter().max().map_or(0, |most| most + 1) < numbers.len() {
        return numbers;
    }
    let nominal = |&point: &usize| vec![data.points[point].nominal[output].to_bits()];
    numbered(data.point_of.iter().map(nominal))
}

/// The standard deviation of a rectangular distribution as wide as a step.
fn deviation(step: f64) -> f64 {
    step / 12f64.sqrt()
}

/// The pooled standard deviation of values at the same set points; `None` where there are no repeats.
fn scatter(data: &Data, output: usize, set_points: &[usize]) -> Option<f64> {
    let mut points = vec![Vec::new(); set_points.iter().max().map_or(0, |most| most + 1)];
    for (&number, &value) in set_points.iter().zip(&data.values[output]) {
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

/// The step in which values were rounded: one in the last decimal that any of them has, or is written with
/// (`last_digit`, its power of ten), or two, five or ten that they have in common and what is `set` has not.
pub(crate) fn resolution(
    values: &[f64],
    last_digit: Option<i32>,
    set: impl Fn(f64) -> bool,
) -> Option<f64> {
    let written = last_digit.map_or(0, |last| usize::try_from(-last).unwrap_or(0));
    let mut most = written.min(MOST_DECIMALS);
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
    let is_common = |divisor: &&i64| {
        counts.iter().all(|count| (count - first) % **divisor == 0)
            && (**divisor as f64).powi(more) > LEAST_ODDS
            && !set(step * **divisor as f64)
    };
    let common = STEPS.iter().find(is_common);
    Some(to_15_digits(step * common.map_or(1.0, |divisor| *divisor as f64)))
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
            let found = resolution(&of(40, step), None, |_| false).unwrap();
            assert!((found / wanted - 1.0).abs() < 1e-12, "{found} {wanted}");
        }
        // three values with steps of five by chance
        assert_eq!(resolution(&[0.05, 0.10, 0.25], None, |_| false), Some(0.01));
        // the zeros at their ends count, and steps of the set points do not
        let set: Vec<f64> = (0..12).map(|n| 0.2 * f64::from(n)).collect();
        assert_eq!(resolution(&set, Some(-2), |step| step > 0.05), Some(0.05));
        assert_eq!(resolution(&set, Some(-2), |_| true), Some(0.01));
        assert_eq!(resolution(&[0.1, 1.0 / 3.0], None, |_| false), None);
        assert_eq!(resolution(&[1e17, 2e17], None, |_| false), None);
    }
}
