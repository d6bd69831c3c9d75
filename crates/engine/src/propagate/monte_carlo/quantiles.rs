//! Many quantiles of all trials: for results that are saved.
//!
//! Few trials are kept whole. Of more, values are counted in cells, each with its least and its
//! greatest value; the cells of the first pass are 0.002 of a quartile's distance wide, and wider
//! ones (in far tails) are kept or split in further passes.

use super::block::RowTrials;
use super::partition::Leaf;
use super::passes::{Look, first_partitions, kept_budget, narrow, pass};
use super::pilot::plans;
use super::repeat::repeat;
use super::request::Request;
use super::targets::leaf_of;
use crate::propagate::Control;
use crate::special;

/// Widest cell within which ranks are interpolated, as a share of half the quartiles' distance.
/// That of the first pass is 30/16384.
const WIDEST: f64 = 0.002;

/// Passes after which wider cells are taken as they are.
const MOST_PASSES: usize = 8;

/// For each output the quantiles at the probabilities Phi(score) among the first `count` trials;
/// `None` if the run was stopped or no trial is finite. The order statistic of rank k of M stands
/// for the probability (k - 1/2)/M, between them the quantile is interpolated, beyond the first and
/// the last one it is constant.
pub(crate) fn quantiles(
    trials: &RowTrials,
    count: u64,
    scores: &[f64],
    control: &Control<'_>,
) -> Option<Vec<Vec<f64>>> {
    let outputs = trials.outputs().max(1) as u64;
    if count.saturating_mul(16 * outputs) <= control.memory as u64 {
        let mut kept: Vec<Vec<f64>> = vec![Vec::new(); trials.outputs()];
        let whole = repeat(trials, count, control, |block| {
            for (kept, values) in kept.iter_mut().zip(block) {
                kept.extend_from_slice(values);
            }
            Ok::<(), std::convert::Infallible>(())
        });
        if !whole.unwrap_or(false) || kept.iter().any(Vec::is_empty) {
            return None;
        }
        return Some(kept.into_iter().map(|values| of_values(values, scores)).collect());
    }
    of_cells(trials, count, scores, control)
}

fn of_values(mut values: Vec<f64>, scores: &[f64]) -> Vec<f64> {
    values.sort_unstable_by(f64::total_cmp);
    let count = values.len() as u64;
    scores.iter().map(|&z| interpolate(rank(z, count), |k| values[k as usize - 1])).collect()
}

/// The real rank of the quantile at probability Phi(z), from 1 to `count`.
fn rank(z: f64, count: u64) -> f64 {
    let m = count as f64;
    let below = m * special::normal::cdf(z) + 0.5;
    let above = m * special::normal::sf(z) + 0.5;
    // the tail on the near side keeps its digits
    let rank = if z < 0.0 { below } else { m + 1.0 - above };
    rank.clamp(1.0, m)
}

fn interpolate(rank: f64, at: impl Fn(u64) -> f64) -> f64 {
    let (low, share) = (rank.floor(), rank.fract());
    let lower = at(low as u64);
    if share == 0.0 { lower } else { lower + share * (at(low as u64 + 1) - lower) }
}

fn of_cells(
    trials: &RowTrials,
    count: u64,
    scores: &[f64],
    control: &Control<'_>,
) -> Option<Vec<Vec<f64>>> {
    let request = Request { trials: count, probability: 0.5, drawn_dof: &[] };
    let plans = plans(trials, request, control, 1.0);
    let mut partitions = first_partitions(&plans);
    let budget = kept_budget(&plans, control);
    let mut found: Vec<Option<Vec<f64>>> = vec![None; plans.len()];
    for number in 1..=MOST_PASSES {
        let look = Look { count, plans: &plans, partitions: &partitions, with_sums: false };
        let made = pass(trials, look, control);
        if made.stopped {
            return None;
        }
        if made.trials == 0 {
            return None;
        }
        for (output, tally) in made.tallies.into_iter().enumerate() {
            if found[output].is_some() {
                continue;
            }
            let leaves = partitions[output].leaves(&tally);
            let kept = tally.into_sorted();
            let widest = WIDEST * plans[output].reference.scale;
            let needed = too_wide(&leaves, scores, made.trials, widest);
            let open = leaves.iter().zip(&needed).any(|(l, needed)| *needed && l.kept.is_none());
            if open && number < MOST_PASSES {
                narrow(&mut partitions[output], &leaves, &needed, budget);
                continue;
            }
            let at = |k: u64| order_statistic(&leaves, &kept, k);
            let values = scores.iter().map(|&z| interpolate(rank(z, made.trials), at));
            let mut values: Vec<f64> = values.collect();
            // interpolation may differ from its end by a rounding
            for k in 1..values.len() {
                values[k] = values[k].max(values[k - 1]);
            }
            found[output] = Some(values);
        }
        if found.iter().all(Option::is_some) {
            break;
        }
    }
    found.into_iter().collect()
}

/// The leaves that hold a wanted rank and are too wide to interpolate in.
fn too_wide(leaves: &[Leaf], scores: &[f64], trials: u64, widest: f64) -> Vec<bool> {
    let mut needed = vec![false; leaves.len()];
    for &z in scores {
        let rank = rank(z, trials).floor() as u64;
        for rank in [rank, (rank + 1).min(trials)] {
            let number = leaf_of(leaves, rank);
            let leaf = &leaves[number];
            needed[number] |= leaf.count > 2 && leaf.greatest - leaf.least > widest;
        }
    }
    needed
}

/// The order statistic of rank `k`, counted from 1: exact in kept cells and at the ends of others.
fn order_statistic(leaves: &[Leaf], kept: &[f64], k: u64) -> f64 {
    let leaf = &leaves[leaf_of(leaves, k)];
    let offset = k.saturating_sub(leaf.below + 1);
    if let Some(&value) = leaf.kept.and_then(|first| kept.get(first + offset as usize)) {
        return value;
    }
    if leaf.count < 2 {
        return leaf.least;
    }
    let share = offset as f64 / (leaf.count - 1) as f64;
    (leaf.least + share * (leaf.greatest - leaf.least)).min(leaf.greatest)
}

#[cfg(test)]
#[allow(unreachable_pub, reason = "the macro writes public structs")]
mod tests {
    use super::*;
    use crate::distribution::Input;
    use crate::distribution::Scores;
    use crate::measurement;
    use crate::model::typed::Equations;
    use crate::propagate::gum;
    use crate::task::{Settings, Task};

    measurement! {
        /// A normal quantity, its square, and a quantity of the Cauchy distribution.
        pub Shapes as "shapes" from "a test";
        inputs { #[doc = "Normal."] x: "1", #[doc = "Cauchy."] t: "1" }
        outputs ShapesSeen {
            #[doc = "x"] y: "1" = "x",
            #[doc = "x^2"] square: "1" = "x^2",
            #[doc = "t"] z: "1" = "t",
        }
    }

    impl<T: crate::number::Number> Equations<T> for Shapes<T> {
        type Outputs = ShapesSeen<T>;

        fn equations(self) -> Self::Outputs {
            ShapesSeen { y: self.x, square: self.x * self.x, z: self.t }
        }
    }

    /// Counting in cells gives the order statistics of the kept trials to the width of a cell where
    /// trials are sparse, on average to 1e-4 of half the quartiles' distance, and exactly in the far
    /// tails of a Cauchy distribution, which are kept or split.
    #[test]
    fn cells_give_the_quantiles_of_all_values() {
        let inputs = Shapes {
            x: Input::normal(3.0, 1.0, "1").unwrap(),
            t: Input::t(0.0, 1.0, 1.0, "1").unwrap(),
        };
        let task = Task::of(inputs, Settings::default()).unwrap();
        let row = &task.rows[0];
        let estimates = gum::evaluate(&task, row).estimates;
        let trials = RowTrials::new(
            &task,
            row,
            &estimates,
            &std::sync::Arc::new(crate::distribution::Joint::default()),
        );
        let scores: Vec<f64> = Scores::WRITTEN.values().collect();
        let control = Control { memory: 64 << 20, ..Control::default() };
        let count = 200_000;
        let exact = quantiles(&trials, count, &scores, &control).unwrap();
        let small = Control { memory: 1 << 20, ..control };
        let counted = quantiles(&trials, count, &scores, &small).unwrap();
        // half the distance of the quartiles: 0.674; about 4.05 for the square; 1
        for (output, scale) in [0.674, 4.1, 1.0].into_iter().enumerate() {
            let pairs = exact[output].iter().zip(&counted[output]);
            let differences: Vec<f64> = pairs.map(|(a, b)| (a - b).abs() / scale).collect();
            assert!(differences.iter().all(|d| *d <= WIDEST), "{output}");
            let mean = differences.iter().sum::<f64>() / differences.len() as f64;
            assert!(mean < 1e-4, "{output}: {mean}");
            assert!(counted[output].windows(2).all(|w| w[0] <= w[1]));
        }
        assert_eq!(exact[2][0], counted[2][0]);
        assert_eq!(exact[2].last(), counted[2].last());
        assert_eq!(exact[2][200], counted[2][200]);
    }
}
