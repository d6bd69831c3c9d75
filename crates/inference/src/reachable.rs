//! Where measurements can be made: conditions of the data, between them, and beyond them where the
//! case says that they can be reached.

use crate::setup::Setup;
use gumption_engine::number::{ascending, elementary, median, smallest_first};
use gumption_engine::task::Row;

/// Places that are tried, at most.
const MOST_PLACES: usize = 240;

/// Values of a condition over its reachable range.
const STEPS: usize = 25;

/// A range of positive values that spans more than this factor is divided by ratios.
const BY_RATIOS: f64 = 20.0;

/// Where a measurement can be made.
#[derive(Clone, Debug)]
pub struct Place {
    /// Conditions, and what is known of the inputs there.
    pub row: Row,
    /// Whether it lies outside of the data's range of some condition.
    pub outside: bool,
    /// Places in the data's points of those that are nearest.
    pub near: Vec<usize>,
}

impl Place {
    /// The variance of a row's noise there: that of the nearest rows, of an observed output. `variances` are
    /// those of the data by value.
    pub fn noise(&self, setup: &Setup<'_>, variances: &[f64], output: usize) -> f64 {
        let data = &setup.data;
        let rows = self.near.iter().flat_map(|&point| &data.points[point].rows);
        let of = |&row: &usize| {
            // what is wrong with a value that is off is not there again
            let stretch = data.noise.stretch(data.ids[row], output);
            variances[row * data.outputs.len() + output] / (stretch * stretch)
        };
        median(rows.map(of).collect()).unwrap_or(f64::NAN)
    }
}

/// The conditions of the measurement that say no range.
pub fn without_range(setup: &Setup<'_>) -> Vec<usize> {
    let case = setup.case;
    let groups = case.replication.as_ref().map(|replication| replication.condition);
    let stated = |condition: usize| case.reachable.get(condition).copied().flatten().is_some();
    (0..case.measured()).filter(|&c| !stated(c) && Some(c) != groups).collect()
}

/// All places. What is known about inputs that differ from row to row is known in the data's own rows
/// only, so such cases stay there.
pub fn places(setup: &Setup<'_>) -> Vec<Place> {
    let conditions = setup.case.measured();
    let measured: Vec<&Row> = setup
        .data
        .points
        .iter()
        .filter_map(|point| point.rows.first())
        .filter_map(|&row| setup.case.task.rows.get(setup.data.ids[row]))
        .collect();
    let Some(template) = measured.first() else { return Vec::new() };
    let design: Vec<Vec<f64>> = (0..conditions)
        .map(|condition| {
            let mut values: Vec<f64> =
                measured.iter().map(|row| row.conditions[condition]).collect();
            ascending(&mut values);
            values.dedup();
            values
        })
        .collect();
    let spans: Vec<[f64; 2]> = design
        .iter()
        .map(|values| {
            let ends = [values.first(), values.last()].map(|end| end.copied().unwrap_or(0.0));
            [ends[0], ends[1]]
        })
        .collect();
    let same = measured.iter().all(|row| row.distributions == template.distributions);
    let rows: Vec<Row> = if same && setup.case.simulated == 0 && conditions > 0 {
        let reachable = |condition: usize| setup.case.reachable.get(condition).copied().flatten();
        let groups = setup.case.replication.as_ref().map(|replication| replication.condition);
        // what the order of the rows tells is as in the nearest row of the data
        let at = |conditions: Vec<f64>| {
            let mut row = Row { conditions, distributions: template.distributions.clone() };
            let nearest = nearest(&row, &measured, &spans);
            let nearest = nearest.first().and_then(|&place| measured.get(place));
            let history =
                nearest.and_then(|nearest| nearest.conditions.get(row.conditions.len()..));
            row.conditions.extend(history.unwrap_or_default());
            row
        };
        combinations(axes(&design, &reachable, groups)).into_iter().map(at).collect()
    } else {
        let step = measured.len().div_ceil(MOST_PLACES).max(1);
        measured.iter().step_by(step).map(|row| (*row).clone()).collect()
    };
    rows.into_iter()
        .map(|row: Row| {
            let outside = |(value, [low, high]): (&f64, &[f64; 2])| value < low || value > high;
            let outside = row.conditions.iter().zip(&spans).any(outside);
            let near = nearest(&row, &measured, &spans);
            Place { row, outside, near }
        })
        .collect()
}

/// For each condition the values to measure at: those of the data and, between those of the condition
/// with most, their middles; over the reachable range where that is known. `groups` is the condition
/// that tells devices or days apart.
fn axes(
    design: &[Vec<f64>],
    reachable: &dyn Fn(usize) -> Option<[f64; 2]>,
    groups: Option<usize>,
) -> Vec<Vec<f64>> {
    let middle = |pair: &[f64]| {
        if pair[0] > 0.0 { (pair[0] * pair[1]).sqrt() } else { 0.5 * (pair[0] + pair[1]) }
    };
    // there is nothing between two devices
    let between = (0..design.len()).rev().filter(|&condition| Some(condition) != groups);
    let longest = between.max_by_key(|&condition| design[condition].len());
    let mut axes: Vec<Vec<f64>> = design.to_vec();
    for (condition, axis) in axes.iter_mut().enumerate() {
        if let Some([low, high]) = reachable(condition) {
            axis.retain(|value| (low..=high).contains(value));
            axis.extend(divided(low, high));
        } else if Some(condition) == longest && axis.len() < 100 {
            let middles: Vec<f64> = axis.windows(2).map(middle).collect();
            axis.extend(middles);
        }
        ascending(axis);
        axis.dedup();
    }
    axes
}

/// Values over a range, both ends among them.
fn divided(low: f64, high: f64) -> impl Iterator<Item = f64> {
    let by_ratios = low > 0.0 && high / low > BY_RATIOS;
    (0..STEPS).map(move |step| {
        let share = step as f64 / (STEPS - 1) as f64;
        match step {
            0 => low,
            _ if step == STEPS - 1 => high,
            _ if by_ratios => low * elementary::pow(high / low, share),
            _ => low + (high - low) * share,
        }
    })
}

/// All combinations of values; where there are too many, as many values of each axis as there is room
/// for, the ends always.
fn combinations(mut axes: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let count = |axes: &[Vec<f64>]| {
        axes.iter().try_fold(1usize, |n, axis| n.checked_mul(axis.len())).unwrap_or(usize::MAX)
    };
    while count(&axes) > MOST_PLACES {
        let Some(longest) = axes.iter_mut().max_by_key(|axis| axis.len()) else { break };
        if longest.len() <= 2 {
            break;
        }
        // one value fewer, evenly over the axis
        let (last, fewer) = (longest.len() - 1, longest.len() - 2);
        *longest = (0..=fewer).map(|n| longest[(2 * n * last + fewer) / (2 * fewer)]).collect();
    }
    let all = count(&axes);
    // with very many conditions some of the corners
    let wanted = all.min(MOST_PLACES);
    (0..wanted)
        .map(|number| {
            let mut left = (number as u128 * all as u128 / wanted as u128) as usize;
            let value = |axis: &Vec<f64>| {
                let value = axis[left % axis.len()];
                left /= axis.len();
                value
            };
            axes.iter().map(value).collect()
        })
        .collect()
}

/// The points of the data that are nearest to a row.
fn nearest(row: &Row, measured: &[&Row], spans: &[[f64; 2]]) -> Vec<usize> {
    const NEAR: usize = 3;
    let distance = |other: &Row| -> f64 {
        let squares =
            row.conditions.iter().zip(&other.conditions).zip(spans).map(|((a, b), ends)| {
                let span = ends[1] - ends[0];
                if span > 0.0 { ((a - b) / span).powi(2) } else { 0.0 }
            });
        squares.sum()
    };
    let mut ranked: Vec<(f64, usize)> =
        measured.iter().enumerate().map(|(place, other)| (distance(other), place)).collect();
    smallest_first(&mut ranked, |(distance, _)| *distance);
    ranked.into_iter().take(NEAR).map(|(_, place)| place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_over_a_range_hold_both_ends() {
        let far: Vec<f64> = divided(1.0, 1e4).collect();
        assert_eq!([far[0], far[STEPS - 1]], [1.0, 1e4]);
        // by ratios: the middle one is the geometric mean
        assert!((far[STEPS / 2] - 100.0).abs() < 1e-9);
        let near: Vec<f64> = divided(-1.0, 3.0).collect();
        assert_eq!([near[0], near[STEPS / 2], near[STEPS - 1]], [-1.0, 1.0, 3.0]);
    }

    #[test]
    fn many_combinations_are_thinned_and_keep_the_corners() {
        let axis: Vec<f64> = (0..40).map(f64::from).collect();
        let found = combinations(vec![axis.clone(), axis.clone(), axis]);
        assert!(found.len() <= MOST_PLACES && found.len() > MOST_PLACES / 3, "{}", found.len());
        for corner in [vec![0.0, 0.0, 0.0], vec![39.0, 39.0, 39.0], vec![0.0, 39.0, 0.0]] {
            assert!(found.contains(&corner), "{corner:?}");
        }
        let many = combinations(vec![vec![0.0, 1.0]; 40]);
        assert_eq!(many.len(), MOST_PLACES);
    }
}
