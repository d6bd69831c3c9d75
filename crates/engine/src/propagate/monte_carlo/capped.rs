//! Runs whose kept values would not fit into memory: several passes over the same trials, which are
//! generated again in each. The first counts values in cells, narrow ones where a part of the trials
//! lets them be expected ([`foresight`]); the next keep or count more finely what the wanted order
//! statistics can depend on, until they are known. Memory does not grow with
//! the trials, and the order statistics are exactly those of all trials, except that beyond 10^8
//! trials the shortest interval is only sought to 10^-5 of the standard uncertainty.

use rayon::prelude::*;

use super::block::Trials;
use super::fold::{Plan, drop_undefined};
use super::foresight;
use super::interval::{Ranks, is_extreme, rank_spread};
use super::moments::{Moments, Sums, correlations};
use super::partition::{Leaf, Partition, Tally};
use super::products::{self, Products, waves};
use super::run::{Finished, MonteCarlo, NumericalError, Request, Undefined, trials_in};
use crate::distribution::BLOCK;
use crate::number::{CodePath, Kernel};
use crate::propagate::Control;

/// Up to so many trials the shortest interval is exactly that of the trials.
const EXACT_SHORTEST: u64 = 100_000_000;

/// Beyond, its length is within this share of the standard uncertainty of the least.
const SHORTEST_TOLERANCE: f64 = 1e-5;

/// Blocks that a thread works on at a time.
const CHUNK: u64 = 64;

/// Passes after which a search ends at what it has; each narrows a cell at least sixteenfold, so
/// that the 2^53 numbers of a binade are told apart earlier.
const MOST_PASSES: usize = 20;

/// What one pass over all trials gives.
#[derive(Debug)]
pub(super) struct Pass {
    pub(super) trials: u64,
    undefined: u64,
    first_undefined: Option<(u64, usize)>,
    /// Sums of each chunk with its number and its trials, without the products.
    sums: Vec<(u64, u64, Vec<Sums>)>,
    products: Products,
    pub(super) tallies: Vec<Tally>,
}

/// Adds a block's moments.
struct SumKernel<'a> {
    path: CodePath,
    values: &'a [[f64; BLOCK]],
    count: usize,
    plans: &'a [Plan],
    sums: &'a mut [Sums],
}

impl Kernel for SumKernel<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { path, values, count, plans, sums } = self;
        for ((plan, sums), values) in plans.iter().zip(sums.iter_mut()).zip(values) {
            sums.add(path, &values[..count], plan.reference);
        }
        products::add(values, count, plans, sums.iter_mut());
    }
}

/// Runs all trials. `shortest_errors` are the numerical standard errors of the shortest intervals'
/// ends, found otherwise. `None` if the run was stopped.
pub(super) fn run(
    trials: &Trials,
    request: Request<'_>,
    control: &Control<'_>,
    plans: &[Plan],
    shortest_errors: &[[f64; 2]],
) -> Option<Finished> {
    let mut partitions = first_partitions(plans);
    let budget = kept_budget(plans, control);
    foresight::prepare(trials, request, control, plans, &mut partitions, budget)?;
    let mut searches: Vec<Option<Search>> = vec![None; plans.len()];
    let mut first: Option<(Pass, Vec<(Moments, Sums)>)> = None;
    for number in 0..MOST_PASSES {
        let mut found = pass(trials, request.trials, control, plans, &partitions, number == 0)?;
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
            let last = number + 1 == MOST_PASSES;
            let needed = search.step(&leaves, &tally.into_sorted(), last);
            if search.found.is_none() {
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
    Some(finish(trials, (request, control.path), whole, &summaries, searches, shortest_errors))
}

/// The cells of the first pass: the quartiles lie one scale from the middle, and fifteen of them
/// hold nearly all values of most shapes.
pub(super) fn first_partitions(plans: &[Plan]) -> Vec<Partition> {
    let references = plans.iter().map(|plan| (plan.reference.middle, plan.reference.scale));
    references
        .map(|(middle, scale)| Partition::new(middle - 15.0 * scale, middle + 15.0 * scale))
        .collect()
}

/// How many values of each output may be kept: half of the memory, as the threads' values are
/// copied when they are put together.
pub(super) fn kept_budget(plans: &[Plan], control: &Control<'_>) -> usize {
    control.memory / 16 / plans.len().max(1)
}

/// Decides which leaves to keep and which to split, within the budget of kept values.
pub(super) fn narrow(partition: &mut Partition, leaves: &[Leaf], needed: &[bool], budget: usize) {
    let wanted: Vec<usize> = (0..leaves.len()).filter(|&l| needed[l]).collect();
    let total: u64 = wanted.iter().map(|&l| leaves[l].count).sum();
    let parts = (1 << 16) / wanted.len().max(1);
    let parts = parts.clamp(16, 4096);
    let share = (budget / wanted.len().max(1)) as u64;
    let splits = |l: usize| total > budget as u64 && leaves[l].count > share;
    partition.refine(
        leaves,
        |l| needed[l] && !splits(l),
        |l| if needed[l] && splits(l) { parts } else { 0 },
    );
}

pub(super) fn pass(
    trials: &Trials,
    count: u64,
    control: &Control<'_>,
    plans: &[Plan],
    partitions: &[Partition],
    with_sums: bool,
) -> Option<Pass> {
    let blocks = count.div_ceil(BLOCK as u64);
    let empty = || Pass {
        trials: 0,
        undefined: 0,
        first_undefined: None,
        sums: Vec::new(),
        products: Products::default(),
        tallies: partitions.iter().map(Partition::tally).collect(),
    };
    let mut whole = empty();
    whole.products = Products::new(if with_sums { plans.len() } else { 0 });
    for wave in waves(blocks.div_ceil(CHUNK), if with_sums { plans.len() } else { 0 }) {
        let wave = wave.into_par_iter().with_min_len(16).fold(
            || (empty(), trials.workspace()),
            |(mut pass, mut workspace), chunk| {
                let chunk = chunk as u64;
                let mut sums = vec![Sums::default(); plans.len()];
                let before = pass.trials;
                for block in chunk * CHUNK..((chunk + 1) * CHUNK).min(blocks) {
                    if control.is_stopped() {
                        break;
                    }
                    trials.block(control.path, block, &mut workspace);
                    let wanted = trials_in(block, count);
                    let (left, first) =
                        drop_undefined(control.path, &mut workspace.outputs, wanted);
                    if let Some(first) = first {
                        pass.undefined += (wanted - left) as u64;
                        let found = (block, first);
                        let earlier = pass.first_undefined.unwrap_or(found);
                        pass.first_undefined = Some(earlier.min(found));
                    }
                    let values = &workspace.outputs;
                    if with_sums {
                        let sums = &mut sums[..];
                        let path = control.path;
                        path.run(SumKernel { path, values, count: left, plans, sums });
                        control.advance(wanted as u64);
                    }
                    pass.trials += left as u64;
                    for ((tally, partition), v) in
                        pass.tallies.iter_mut().zip(partitions).zip(values)
                    {
                        tally.add(partition, &v[..left]);
                    }
                }
                if with_sums {
                    pass.sums.push((chunk, pass.trials - before, sums));
                }
                (pass, workspace)
            },
        );
        let mut found = wave.map(|(pass, _)| pass).reduce(empty, |mut a, b| {
            a.add(b);
            a
        });
        found.sums.sort_by_key(|(chunk, ..)| *chunk);
        for (_, _, sums) in &mut found.sums {
            whole.products.take(sums.iter_mut());
        }
        whole.add(found);
    }
    (!control.is_stopped()).then_some(whole)
}

impl Pass {
    /// Takes over what another part of the trials gave.
    fn add(&mut self, other: Self) {
        self.trials += other.trials;
        self.undefined += other.undefined;
        self.first_undefined = match (self.first_undefined, other.first_undefined) {
            (Some(x), Some(y)) => Some(x.min(y)),
            (x, y) => x.or(y),
        };
        self.sums.extend(other.sums);
        for (tally, other) in self.tallies.iter_mut().zip(other.tallies) {
            tally.merge(other);
        }
    }
}

/// One output's moments and total from its sums, chunk by chunk in order.
fn summary(sums: &[(u64, u64, Vec<Sums>)], output: usize, plan: &Plan) -> (Moments, Sums) {
    let parts = sums.iter().filter(|(_, trials, _)| *trials > 0);
    let parts = parts.map(|(_, trials, sums)| (*trials, &sums[output]));
    Moments::of_parts(parts, plan.reference)
}

/// The figures of one output that are order statistics.
#[derive(Clone, Copy, Debug)]
struct Found {
    /// Lower end, upper end, median.
    at: [f64; 3],
    errors: [f64; 3],
    shortest: [f64; 2],
    exact: bool,
}

/// The order statistics that the symmetric interval, the median and their errors are made of.
#[derive(Clone, Copy, Debug)]
pub(super) struct SearchTargets {
    trials: u64,
    ranks: Ranks,
}

impl SearchTargets {
    pub(super) fn new(trials: u64, probability: f64) -> Self {
        Self { trials, ranks: Ranks::new(trials, probability) }
    }

    /// The ranks of the lower end, the upper end and the median with one standard deviation of the
    /// rank below and above each, and the two middle ranks.
    fn ranks(&self) -> [u64; 11] {
        let Ranks { q, r } = self.ranks;
        let upper = (r + q).min(self.trials);
        let (middle, next) = (self.trials.div_ceil(2), self.trials / 2 + 1);
        let around = |rank: u64| {
            let spread = rank_spread(self.trials, rank);
            [rank.saturating_sub(spread).max(1), rank, (rank + spread).min(self.trials)]
        };
        let ([a, b, c], [d, e, f], [g, h, i]) = (around(r), around(upper), around(middle));
        [a, b, c, d, e, f, g, h, i, middle, next]
    }

    /// The share of the trials that each rank is.
    pub(super) fn shares(&self) -> [f64; 11] {
        self.ranks().map(|rank| (rank as f64 - 0.5) / self.trials as f64)
    }
}

/// The search for one output's order statistics.
#[derive(Clone, Debug)]
struct Search {
    trials: u64,
    ranks: Ranks,
    std: f64,
    found: Option<Found>,
}

impl Search {
    fn new(trials: u64, probability: f64, std: f64) -> Self {
        Self { trials, ranks: Ranks::new(trials, probability), std, found: None }
    }

    /// Looks for the figures in what a pass kept; gives the leaves that are still needed. With
    /// `last` it takes what there is.
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
            self.found = Some(Found { at: [b, e, median], errors, shortest, exact });
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

/// The leaf that holds the order statistic of a rank.
pub(super) fn leaf_of(leaves: &[Leaf], rank: u64) -> usize {
    let after = leaves.partition_point(|leaf| leaf.below < rank);
    // the last leaf that begins below the rank; empty ones begin there too
    let mut number = after.saturating_sub(1);
    while number > 0 && leaves[number].count == 0 {
        number -= 1;
    }
    number
}

/// Whether every order statistic in a leaf is known.
fn is_known(leaf: &Leaf) -> bool {
    leaf.kept.is_some() || leaf.least == leaf.greatest
}

fn value_at(leaf: &Leaf, kept: &[f64], rank: u64, anyway: bool) -> Option<f64> {
    if leaf.least == leaf.greatest || (anyway && leaf.kept.is_none()) {
        return Some(leaf.least);
    }
    let offset = (rank - leaf.below - 1) as usize;
    kept.get(leaf.kept? + offset).copied()
}

fn finish(
    trials: &Trials,
    (request, path): (Request<'_>, CodePath),
    whole: Pass,
    summaries: &[(Moments, Sums)],
    searches: Vec<Option<Search>>,
    shortest_errors: &[[f64; 2]],
) -> Finished {
    let undefined = whole.first_undefined.map(|(block, trial)| Undefined {
        count: whole.undefined,
        trials: whole.trials + whole.undefined,
        first: trials.inputs_of(path, block, trial),
    });
    let totals: Vec<&Sums> = summaries.iter().map(|(_, total)| total).collect();
    let correlations = correlations(whole.trials, &totals, &whole.products);
    let figures = searches.into_iter().zip(summaries).enumerate();
    let outputs: Vec<MonteCarlo> = figures
        .filter_map(|(output, (search, (moments, _)))| {
            let found = search?.found?;
            let dof = request.drawn_dof.get(output).copied().unwrap_or(f64::INFINITY);
            let shortest_error = shortest_errors.get(output).copied().unwrap_or([f64::NAN; 2]);
            let errors = NumericalError::new(moments, dof, found.errors, shortest_error);
            let [low, high, median] = found.at;
            let intervals = ([low, high], found.shortest, found.exact);
            Some(MonteCarlo::new(moments, dof, median, intervals, errors))
        })
        .collect();
    let trials = if outputs.len() == summaries.len() { whole.trials } else { 0 };
    Finished { trials, outputs, correlations, undefined, stopped: false }
}
