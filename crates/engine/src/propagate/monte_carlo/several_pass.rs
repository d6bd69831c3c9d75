//! Order statistics in several passes, for runs whose kept values would not fit into memory.
//!
//! Exact quantiles of a stream of values need either all of them or a second look (Munro and
//! Paterson, Theoretical Computer Science 12, 1980: a pass over n values in memory for s narrows a
//! rank to about n/s candidates). Here a second look costs no storage: a trial is a function of seed
//! and number, so each pass generates the same trials again. A pass counts every output's values in
//! the cells of a partition; the counts bracket each wanted rank by one cell, and the next pass
//! divides that cell, or keeps its values where they fit. The shortest interval needs all cells
//! whose distance to the cell of the matching upper rank can still be the least; counts bound these
//! distances from both sides, so most cells are ruled out after one pass. A pilot refinement
//! ([`pilot_refinement`]) chooses narrow cells from a part of the trials first, so that one pass over
//! all of them is mostly enough.
//!
//! Memory does not grow with the trials, and the order statistics are exactly those of all trials,
//! except that beyond 10^8 trials the shortest interval is only sought to 10^-5 of the standard
//! uncertainty.

use super::block::RowTrials;
use super::figures::{Finished, Intervals, MonteCarlo, NumericalError, Undefined, of_moments};
use super::interval::{Ranks, is_extreme};
use super::partition::{Leaf, Partition};
use super::passes::{Look, Pass, first_partitions, kept_budget, narrow, pass};
use super::pilot_refinement;
use super::plan::Plan;
use super::request::Request;
use super::shortest_scatter::ShortestScatter;
use super::targets::{SearchTargets, leaf_of};
use super::totals::Totals;
use crate::propagate::Control;

/// Up to so many trials the shortest interval is exactly that of the trials.
const EXACT_SHORTEST: u64 = 100_000_000;

/// Beyond, its length is within this share of the standard uncertainty of the least.
const SHORTEST_TOLERANCE: f64 = 1e-5;

/// Passes after which a search ends at what it has; each narrows a cell at least sixteenfold, so
/// that the 2^53 numbers of a binade are told apart earlier.
pub(super) const MOST_PASSES: u32 = 20;

/// Runs all trials. `scatters` tell how the shortest intervals scatter, found otherwise. A run that
/// is stopped has the figures of all trials that were counted until then, their order statistics as
/// far as the cells tell; `None` if it was stopped before the first pass.
pub(super) fn run(
    trials: &RowTrials,
    request: Request<'_>,
    control: &Control<'_>,
    plans: &[Plan],
    scatters: &[ShortestScatter],
) -> Option<Finished> {
    let budget = kept_budget(plans, control);
    let mut passes = Passes::new(request, plans);
    loop {
        let made = pass(trials, passes.look(request, plans), control);
        if passes.take(made, request, plans, budget) {
            return passes.finish(trials, request, control, plans, scatters);
        }
    }
}

/// What the next pass is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Phase {
    /// The first over a part of the trials.
    Coarse,
    /// The second over that part.
    Narrow,
    /// Over all trials, so many times before.
    All(u32),
}

/// What the first pass over all trials told.
#[derive(Clone, Debug)]
pub(super) struct Whole {
    pub(super) trials: u64,
    pub(super) undefined: u64,
    pub(super) first_undefined: Option<(u64, usize)>,
    pub(super) totals: Totals,
    /// Whether the run was stopped.
    pub(super) stopped: bool,
}

/// Where a run in several passes stands: what the passes told so far, and in which cells the next
/// one counts.
#[derive(Clone, Debug)]
pub(super) struct Passes {
    pub(super) phase: Phase,
    pub(super) partitions: Vec<Partition>,
    pub(super) whole: Option<Whole>,
    /// For each output its order statistics, once they are found.
    pub(super) found: Vec<Option<OrderStatistics>>,
    /// What is known of them until then.
    bounds: Vec<Option<OrderStatistics>>,
}

impl Passes {
    /// Before the first pass.
    pub(super) fn new(request: Request<'_>, plans: &[Plan]) -> Self {
        let part = pilot_refinement::part(request.trials, plans.len());
        let phase = if part.is_some() { Phase::Coarse } else { Phase::All(0) };
        Self::at(phase, first_partitions(plans), None, vec![None; plans.len()])
    }

    /// After some passes.
    pub(super) fn at(
        phase: Phase,
        partitions: Vec<Partition>,
        whole: Option<Whole>,
        found: Vec<Option<OrderStatistics>>,
    ) -> Self {
        let bounds = vec![None; found.len()];
        Self { phase, partitions, whole, found, bounds }
    }

    /// What the next pass looks at.
    pub(super) fn look<'a>(&'a self, request: Request<'_>, plans: &'a [Plan]) -> Look<'a> {
        let part = pilot_refinement::part(request.trials, plans.len());
        let part = part.filter(|_| self.is_beforehand());
        let count = part.unwrap_or(request.trials);
        let with_sums = self.phase == Phase::All(0);
        Look { count, plans, partitions: &self.partitions, with_sums }
    }

    fn is_beforehand(&self) -> bool {
        !matches!(self.phase, Phase::All(_))
    }

    /// Takes what a pass found; whether it was the last one.
    pub(super) fn take(
        &mut self,
        made: Pass,
        request: Request<'_>,
        plans: &[Plan],
        budget: usize,
    ) -> bool {
        if made.stopped && self.is_beforehand() {
            return true;
        }
        match self.phase {
            Phase::Coarse => {
                pilot_refinement::divide(&made, request, &mut self.partitions);
                self.phase = Phase::Narrow;
                false
            }
            Phase::Narrow => {
                pilot_refinement::mark(&made, request, &mut self.partitions, budget);
                self.phase = Phase::All(0);
                false
            }
            Phase::All(before) => {
                self.phase = Phase::All(before + 1);
                self.take_all(before, made, request, plans, budget)
            }
        }
    }

    /// Takes a pass over all trials, so many such passes before.
    fn take_all(
        &mut self,
        before: u32,
        made: Pass,
        request: Request<'_>,
        plans: &[Plan],
        budget: usize,
    ) -> bool {
        let Pass { trials, undefined, first_undefined, totals, tallies, stopped } = made;
        if before == 0 {
            self.whole = Some(Whole { trials, undefined, first_undefined, totals, stopped });
        }
        let Some(whole) = &mut self.whole else { return true };
        if stopped && before > 0 {
            // what the passes before it told is all that is known
            whole.stopped = true;
            return true;
        }
        if whole.trials == 0 {
            return true;
        }
        let last = before + 1 >= MOST_PASSES || stopped;
        let mut open = false;
        for (output, tally) in tallies.into_iter().enumerate() {
            if self.found[output].is_some() {
                continue;
            }
            let std = whole.totals.moments(output, plans[output].reference).std;
            let mut search = OrderSearch::new(whole.trials, request.probability, std);
            let partition = &mut self.partitions[output];
            let leaves = partition.leaves(&tally);
            let kept = tally.into_sorted();
            let needed = search.step(&leaves, &kept, last);
            if search.found.is_none() {
                let mut bounded = search.clone();
                bounded.step(&leaves, &kept, true);
                self.bounds[output] = bounded.found;
                open = true;
                narrow(partition, &leaves, &needed, budget);
            }
            self.found[output] = search.found;
        }
        !open
    }

    /// The figures; `None` if no pass over all trials was begun.
    pub(super) fn finish(
        self,
        trials: &RowTrials,
        request: Request<'_>,
        control: &Control<'_>,
        plans: &[Plan],
        scatters: &[ShortestScatter],
    ) -> Option<Finished> {
        let whole = self.whole?;
        let undefined = whole.first_undefined.map(|(block, trial)| Undefined {
            count: whole.undefined,
            trials: whole.trials + whole.undefined,
            first: trials.inputs_of(control.path, block, trial),
        });
        let correlations = whole.totals.correlations();
        let correlation_errors = whole.totals.correlation_errors(&correlations);
        let figures = self.found.into_iter().zip(self.bounds).zip(plans).enumerate();
        let outputs: Vec<MonteCarlo> = figures
            .filter_map(|(output, ((found, bounds), plan))| {
                let found = found.or(bounds)?;
                let moments = &whole.totals.moments(output, plan.reference);
                let dof = request.moment_order.get(output).copied().unwrap_or(f64::INFINITY);
                let scatter = scatters.get(output).copied();
                let shortest_error = scatter.map_or([f64::NAN; 2], |scatter| scatter.errors);
                let errors =
                    NumericalError::new(moments, dof, found.errors, shortest_error, found.extremes);
                let [low, high, median] = found.at;
                let intervals = Intervals {
                    symmetric: [low, high],
                    shortest: found.shortest,
                    exact: found.exact,
                    unique: scatter.is_none_or(|scatter| scatter.unique),
                };
                Some(MonteCarlo::new(moments, found.extremes, dof, median, intervals, errors))
            })
            .collect();
        let trials = if outputs.len() == plans.len() { whole.trials } else { 0 };
        let correlation_errors = of_moments(correlation_errors, &outputs);
        let stopped = whole.stopped;
        Some(Finished { trials, outputs, correlations, correlation_errors, undefined, stopped })
    }
}

/// The figures of one output that are order statistics.
#[derive(Clone, Copy, Debug)]
pub(super) struct OrderStatistics {
    /// Lower end, upper end, median.
    pub(super) at: [f64; 3],
    pub(super) errors: [f64; 3],
    /// The least and the greatest trial.
    pub(super) extremes: [f64; 2],
    pub(super) shortest: [f64; 2],
    pub(super) exact: bool,
}

/// The search for one output's order statistics.
#[derive(Clone, Debug)]
struct OrderSearch {
    trials: u64,
    ranks: Ranks,
    std: f64,
    found: Option<OrderStatistics>,
}

impl OrderSearch {
    fn new(trials: u64, probability: f64, std: f64) -> Self {
        Self { trials, ranks: Ranks::new(trials, probability), std, found: None }
    }

    /// Looks for the figures in what a pass kept; gives the leaves that are still needed. With
    /// `last` the best bounds known are taken.
    fn step(&mut self, leaves: &[Leaf], kept: &[f64], last: bool) -> Vec<bool> {
        let mut needed = vec![false; leaves.len()];
        let at = |rank: u64| {
            let number = leaf_of(leaves, rank);
            (number, value_at(&leaves[number], kept, rank, last))
        };
        let mut complete = true;
        let mut values = [0.0; 11];
        let targets = SearchTargets { trials: self.trials, ranks: self.ranks };
        for (value, rank) in values.iter_mut().zip(targets.ranks()) {
            match at(rank) {
                (_, Some(found)) => *value = found,
                (number, None) => {
                    needed[number] = true;
                    complete = false;
                }
            }
        }
        let shortest = self.shortest(leaves, kept, &mut needed, last);
        if let (true, Some((shortest, exact))) = (complete, shortest) {
            let [a, b, c, d, e, f, g, _, i, lower, upper] = values;
            let median = if lower == upper { lower } else { 0.5 * lower + 0.5 * upper };
            let Ranks { q, r } = self.ranks;
            let of_end = |rank: u64, width: f64| {
                if is_extreme(self.trials, rank) { f64::NAN } else { width / 2.0 }
            };
            let upper_rank = (r + q).min(self.trials);
            let errors = [of_end(r, c - a), of_end(upper_rank, f - d), (i - g) / 2.0];
            let full = || leaves.iter().filter(|leaf| leaf.count > 0);
            let extremes = [full().next().map(|l| l.least), full().next_back().map(|l| l.greatest)];
            let extremes = extremes.map(|end| end.unwrap_or(f64::NAN));
            let at = [b, e, median];
            self.found = Some(OrderStatistics { at, errors, extremes, shortest, exact });
        } else {
            // everything that this search still needs is wanted again in the next pass
            for rank in targets.ranks() {
                needed[leaf_of(leaves, rank)] = true;
            }
        }
        needed
    }

    /// The shortest interval, or the leaves on which it can depend.
    fn shortest(
        &self,
        leaves: &[Leaf],
        kept: &[f64],
        needed: &mut [bool],
        last: bool,
    ) -> Option<([f64; 2], bool)> {
        let q = self.ranks.q;
        let top = self.trials.saturating_sub(q).max(1);
        // for each leaf of lower ends: its ranks, and the leaves of the upper ends
        let mut spans = Vec::new();
        for (number, leaf) in leaves.iter().enumerate().filter(|(_, leaf)| leaf.count > 0) {
            let (first, final_rank) = (leaf.below + 1, (leaf.below + leaf.count).min(top));
            if first > top {
                break;
            }
            let (from, to) = (leaf_of(leaves, first + q), leaf_of(leaves, final_rank + q));
            let least = leaves[from].least - leaf.greatest;
            let most = leaves[to].greatest - leaf.least;
            spans.push((number, first, final_rank, from, to, f64::max(least, 0.0), most));
        }
        let bound = spans.iter().map(|s| s.6).fold(f64::INFINITY, f64::min);
        let floor = spans.iter().map(|s| s.5).fold(f64::INFINITY, f64::min);
        let close = bound - floor <= SHORTEST_TOLERANCE * self.std;
        if last || (self.trials > EXACT_SHORTEST && close) {
            let best = spans.iter().find(|s| s.6 <= bound)?;
            let ends = [leaves[best.0].least, leaves[best.4].greatest];
            return Some((ends, false));
        }
        let candidates: Vec<_> = spans.into_iter().filter(|s| s.5 <= bound).collect();
        let known = |number: usize| is_known(&leaves[number]);
        let settled = candidates
            .iter()
            .all(|s| known(s.0) && (s.3..=s.4).all(|l| leaves[l].count == 0 || known(l)));
        if !settled {
            for s in &candidates {
                needed[s.0] = true;
                needed[s.3..=s.4].fill(true);
            }
            return None;
        }
        let mut best: Option<(f64, u64, [f64; 2])> = None;
        for (lower, first, final_rank, from, ..) in candidates {
            let mut upper = from;
            for rank in first..=final_rank {
                while rank + q > leaves[upper].below + leaves[upper].count {
                    upper += 1;
                }
                let low = value_at(&leaves[lower], kept, rank, false)?;
                let high = value_at(&leaves[upper], kept, rank + q, false)?;
                let candidate = (high - low, rank.abs_diff(self.ranks.r), [low, high]);
                let better = best.is_none_or(|(length, distance, _)| {
                    candidate.0 < length || (candidate.0 == length && candidate.1 < distance)
                });
                if better {
                    best = Some(candidate);
                }
            }
        }
        best.map(|(_, _, ends)| (ends, true))
    }
}

/// Whether every order statistic in a leaf is known.
fn is_known(leaf: &Leaf) -> bool {
    leaf.kept.is_some() || leaf.least == leaf.greatest
}

fn value_at(leaf: &Leaf, kept: &[f64], rank: u64, anyway: bool) -> Option<f64> {
    if leaf.least == leaf.greatest {
        return Some(leaf.least);
    }
    if anyway && leaf.kept.is_none() {
        // as if the values were evenly spread in the cell
        let share = ((rank - leaf.below) as f64 - 0.5) / leaf.count as f64;
        return Some(leaf.least + share * (leaf.greatest - leaf.least));
    }
    let offset = (rank - leaf.below - 1) as usize;
    kept.get(leaf.kept? + offset).copied()
}
