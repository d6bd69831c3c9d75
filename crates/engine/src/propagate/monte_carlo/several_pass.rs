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
use super::moments::{Moments, Parts, correlation_errors, correlations};
use super::partition::Leaf;
use super::passes::{Pass, first_partitions, kept_budget, narrow, pass};
use super::pilot_refinement;
use super::plan::Plan;
use super::request::Request;
use super::shortest_scatter::ShortestScatter;
use super::sums::Sums;
use super::targets::{SearchTargets, leaf_of};
use crate::number::CodePath;
use crate::propagate::Control;

/// Up to so many trials the shortest interval is exactly that of the trials.
const EXACT_SHORTEST: u64 = 100_000_000;

/// Beyond, its length is within this share of the standard uncertainty of the least.
const SHORTEST_TOLERANCE: f64 = 1e-5;

/// Passes after which a search ends at what it has; each narrows a cell at least sixteenfold, so
/// that the 2^53 numbers of a binade are told apart earlier.
const MOST_PASSES: usize = 20;

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
    let mut partitions = first_partitions(plans);
    let budget = kept_budget(plans, control);
    pilot_refinement::prepare(trials, request, control, plans, &mut partitions, budget)?;
    let mut searches: Vec<Option<Search>> = vec![None; plans.len()];
    let mut first: Option<(Pass, Vec<(Moments, Parts)>)> = None;
    for number in 0..MOST_PASSES {
        let mut found = pass(trials, request.trials, control, plans, &partitions, number == 0);
        let stopped = found.stopped;
        if stopped && number > 0 {
            // what the passes before it told is all that is known
            if let Some((whole, _)) = &mut first {
                whole.stopped = true;
            }
            break;
        }
        let tallies = std::mem::take(&mut found.tallies);
        if number == 0 {
            let summary = |(output, plan)| summary(&found.sums, output, plan);
            let summaries = plans.iter().enumerate().map(summary).collect();
            first = Some((found, summaries));
        }
        let (whole, summaries) = first.as_ref()?;
        if whole.trials == 0 {
            break;
        }
        let mut open = false;
        for (output, tally) in tallies.into_iter().enumerate() {
            if searches[output].as_ref().is_some_and(|search| search.found.is_some()) {
                continue;
            }
            let std = summaries[output].0.std;
            let mut search = Search::new(whole.trials, request.probability, std);
            let leaves = partitions[output].leaves(&tally);
            let last = number + 1 == MOST_PASSES || stopped;
            let kept = tally.into_sorted();
            let needed = search.step(&leaves, &kept, last);
            if search.found.is_none() {
                let mut bounded = search.clone();
                bounded.step(&leaves, &kept, true);
                search.bounds = bounded.found;
                open = true;
                narrow(&mut partitions[output], &leaves, &needed, budget);
            }
            searches[output] = Some(search);
        }
        if !open {
            break;
        }
    }
    let (whole, summaries) = first?;
    Some(finish(trials, (request, control.path), whole, &summaries, searches, scatters))
}

/// One output's moments and parts from its sums, chunk by chunk in order.
fn summary(sums: &[(u64, u64, Vec<Sums>)], output: usize, plan: &Plan) -> (Moments, Parts) {
    let parts = Parts::of(sums.iter().map(|(_, trials, sums)| (*trials, &sums[output])));
    (parts.moments(plan.reference), parts)
}

/// The figures of one output that are order statistics.
#[derive(Clone, Copy, Debug)]
struct Found {
    /// Lower end, upper end, median.
    at: [f64; 3],
    errors: [f64; 3],
    /// The least and the greatest trial.
    extremes: [f64; 2],
    shortest: [f64; 2],
    exact: bool,
}

/// The search for one output's order statistics.
#[derive(Clone, Debug)]
struct Search {
    trials: u64,
    ranks: Ranks,
    std: f64,
    found: Option<Found>,
    /// What is known until it is found.
    bounds: Option<Found>,
}

impl Search {
    fn new(trials: u64, probability: f64, std: f64) -> Self {
        Self { trials, ranks: Ranks::new(trials, probability), std, found: None, bounds: None }
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
            self.found = Some(Found { at, errors, extremes, shortest, exact });
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

fn finish(
    trials: &RowTrials,
    (request, path): (Request<'_>, CodePath),
    whole: Pass,
    summaries: &[(Moments, Parts)],
    searches: Vec<Option<Search>>,
    scatters: &[ShortestScatter],
) -> Finished {
    let undefined = whole.first_undefined.map(|(block, trial)| Undefined {
        count: whole.undefined,
        trials: whole.trials + whole.undefined,
        first: trials.inputs_of(path, block, trial),
    });
    let parts: Vec<&Parts> = summaries.iter().map(|(_, parts)| parts).collect();
    let correlations = correlations(whole.trials, &parts, &whole.products);
    let correlation_errors = correlation_errors(&parts, &whole.products, &correlations);
    let figures = searches.into_iter().zip(summaries).enumerate();
    let outputs: Vec<MonteCarlo> = figures
        .filter_map(|(output, (search, (moments, _)))| {
            let search = search?;
            let found = search.found.or(search.bounds)?;
            let dof = request.drawn_dof.get(output).copied().unwrap_or(f64::INFINITY);
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
            Some(MonteCarlo::new(moments, dof, median, intervals, errors))
        })
        .collect();
    let trials = if outputs.len() == summaries.len() { whole.trials } else { 0 };
    let correlation_errors = of_moments(correlation_errors, &outputs);
    let stopped = whole.stopped;
    Finished { trials, outputs, correlations, correlation_errors, undefined, stopped }
}
