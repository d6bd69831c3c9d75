//! Many quantiles of all trials: for results that are saved.
//!
//! Few trials are kept whole. Of more, values are counted in cells, each with its least and its
//! greatest value; the cells of the first pass are 0.002 of a quartile's distance wide, and wider
//! ones (in far tails) are kept or split in further passes.

use crate::parallel;

use super::block::RowTrials;
use super::partition::{Leaf, Partition};
use super::passes::{Look, Pass, first_partitions, kept_budget, narrow, pass};
use super::pilot::plans;
use super::plan::Plan;
use super::repeat::collected;
use super::request::Request;
use super::sorting::sort;
use super::targets::leaf_of;
use crate::propagate::Control;
use crate::special;

/// Widest cell within which ranks are interpolated, as a share of half the quartiles' distance.
/// That of the first pass is 30/16384.
const WIDEST: f64 = 0.002;

/// Passes after which wider cells are taken as they are.
pub(super) const MOST_PASSES: u32 = 8;

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
    if are_held(count, trials.outputs(), control.memory) {
        let kept = collected(trials, count, control)?;
        return of_all(kept, scores);
    }
    of_cells(trials, count, scores, control)
}

/// The quantiles of values that are held, output by output; `None` where there are none.
pub(super) fn of_all(values: Vec<Vec<f64>>, scores: &[f64]) -> Option<Vec<Vec<f64>>> {
    if values.iter().any(Vec::is_empty) {
        return None;
    }
    Some(parallel::map(values, |values| of_values(values, scores)))
}

fn of_values(mut values: Vec<f64>, scores: &[f64]) -> Vec<f64> {
    sort(&mut values);
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
    let plans = quantile_plans(trials, count, control);
    let mut passes = QuantilePasses::new(&plans);
    loop {
        let made = pass(trials, passes.look(count, &plans), control);
        if made.stopped || made.trials == 0 {
            return None;
        }
        if passes.take(made, scores, &plans, kept_budget(&plans, control)) {
            return passes.quantiles();
        }
    }
}

/// Where the outputs' values lie.
pub(super) fn quantile_plans(trials: &RowTrials, count: u64, control: &Control<'_>) -> Vec<Plan> {
    let request = Request { trials: count, probability: 0.5, moment_order: &[] };
    plans(trials, request, control, 1.0)
}

/// Whether the values of so many trials are held to take quantiles of them.
pub(super) fn are_held(count: u64, outputs: usize, memory: usize) -> bool {
    count.saturating_mul(16 * outputs.max(1) as u64) <= memory as u64
}

/// Where the search for quantiles in cells stands.
#[derive(Clone, Debug)]
pub(super) struct QuantilePasses {
    /// Passes before.
    pub(super) before: u32,
    pub(super) partitions: Vec<Partition>,
    /// For each output its quantiles, once they are found.
    pub(super) found: Vec<Option<Vec<f64>>>,
}

impl QuantilePasses {
    /// Before the first pass.
    pub(super) fn new(plans: &[Plan]) -> Self {
        Self { before: 0, partitions: first_partitions(plans), found: vec![None; plans.len()] }
    }

    /// What the next pass looks at.
    pub(super) fn look<'a>(&'a self, count: u64, plans: &'a [Plan]) -> Look<'a> {
        Look { count, plans, partitions: &self.partitions, with_sums: false }
    }

    /// Takes what a pass found; whether it was the last one.
    pub(super) fn take(
        &mut self,
        made: Pass,
        scores: &[f64],
        plans: &[Plan],
        budget: usize,
    ) -> bool {
        self.before += 1;
        if made.trials == 0 {
            return true;
        }
        for (output, tally) in made.tallies.into_iter().enumerate() {
            if self.found[output].is_some() {
                continue;
            }
            let leaves = self.partitions[output].leaves(&tally);
            let kept = tally.into_sorted();
            let widest = WIDEST * plans[output].reference.scale;
            let needed = too_wide(&leaves, scores, made.trials, widest);
            let open = leaves.iter().zip(&needed).any(|(l, needed)| *needed && l.kept.is_none());
            if open && self.before < MOST_PASSES {
                narrow(&mut self.partitions[output], &leaves, &needed, budget);
                continue;
            }
            let at = |k: u64| order_statistic(&leaves, &kept, k);
            let values = scores.iter().map(|&z| interpolate(rank(z, made.trials), at));
            let mut values: Vec<f64> = values.collect();
            // interpolation may differ from its end by a rounding
            for k in 1..values.len() {
                values[k] = values[k].max(values[k - 1]);
            }
            self.found[output] = Some(values);
        }
        self.found.iter().all(Option::is_some)
    }

    /// The quantiles, if all are found.
    pub(super) fn quantiles(self) -> Option<Vec<Vec<f64>>> {
        self.found.into_iter().collect()
    }
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
