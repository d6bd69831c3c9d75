//! The spread of the outputs under changes of the inputs, all with the same random numbers.
//!
//! Trials are made in batches. The scatter of the batches' own results gives the uncertainty of the
//! ratio of two spreads, in which the common scatter cancels. Only the values near the endpoints of
//! the coverage interval are kept for each output, between limits that a pilot of the first blocks
//! sets.

use gumption_engine::parallel;

use super::lanes::{LANES, with_deviations};
use super::sampler::{Change, Outputs, Prepared, Sampler, Taker};
use gumption_engine::distribution::BLOCK;
use gumption_engine::number::{CodePath, Column, Kernel, at_rank};
use gumption_engine::propagate::Control;
use gumption_engine::propagate::monte_carlo::Ranks;

/// Batches whose scatter gives the numerical standard errors.
const BATCHES: u64 = 32;

/// Blocks of the pilot.
const PILOT: u64 = 16;

/// Runs of at most this many blocks keep all values.
const SMALL: u64 = 64;

/// How many standard deviations of a rank the limits are wider than needed on average.
const MARGIN: f64 = 6.0;

/// Values that are compared at a time in the search for those to keep.
const NEIGHBOURS: usize = 8;

/// The spread of one output under one change.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Spread {
    /// Standard deviation of the trials.
    pub(super) std: f64,
    /// Probabilistically symmetric coverage interval.
    pub(super) interval: [f64; 2],
    /// Half the interval's length in each batch.
    half_lengths: Vec<f64>,
    /// Fraction of trials that were left out because an output was not finite.
    pub(super) undefined: f64,
}

impl Spread {
    /// Half the length of the interval.
    pub(super) fn half_length(&self) -> f64 {
        0.5 * self.interval[1] - 0.5 * self.interval[0]
    }

    /// The relative change of half the length from another spread, and its numerical standard
    /// error; `None` if the length of the other one is zero.
    pub(super) fn change(&self, from: &Self) -> Option<[f64; 2]> {
        let ratio = |a: f64, b: f64| if b > 0.0 { Some(a / b - 1.0) } else { None };
        let change = ratio(self.half_length(), from.half_length())?;
        let batches = self.half_lengths.iter().zip(&from.half_lengths);
        let batches: Option<Vec<f64>> = batches.map(|(a, b)| ratio(*a, *b)).collect();
        Some([change, batches.map_or(f64::NAN, |batches| standard_error(&batches))])
    }
}

/// The standard error of the mean of independent values; NaN for fewer than two.
pub(super) fn standard_error(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    if n < 2.0 { f64::NAN } else { (squares / (n - 1.0) / n).sqrt() }
}

/// The blocks of each batch.
pub(super) fn batches(trials: u64) -> Vec<std::ops::Range<u64>> {
    let blocks = trials.div_ceil(BLOCK as u64);
    let count = blocks.min(BATCHES);
    (0..count).map(|b| b * blocks / count..(b + 1) * blocks / count).collect()
}

/// Number of the first `trials` trials that lie in a block.
pub(super) fn trials_in(block: u64, trials: u64) -> usize {
    trials.saturating_sub(block * BLOCK as u64).min(BLOCK as u64) as usize
}

/// Which values of one output are kept.
#[derive(Clone, Copy, Debug)]
enum Limits {
    All,
    About([[f64; 2]; 2]),
}

/// How the values of one output under one change are collected.
#[derive(Clone, Copy, Debug)]
struct OutputPlan {
    limits: Limits,
    /// What the sums are about.
    reference: f64,
    /// Whether they are collected: not if the change does not move the output, whose values are
    /// then those of the baseline.
    is_taken: bool,
}

/// A change's plans, output by output.
type ChangePlan = Vec<OutputPlan>;

/// One output's values in one batch.
#[derive(Clone, Debug, Default)]
struct BatchTally {
    trials: u64,
    sums: [f64; LANES],
    squares: [f64; LANES],
    below: [u64; 2],
    kept: [Vec<f64>; 2],
    /// Half the length of the coverage interval of a whole batch; `None` if an endpoint was not
    /// kept.
    half_length: Option<f64>,
}

/// One change's values in one batch.
#[derive(Clone, Debug)]
struct TrialBatch {
    undefined: u64,
    outputs: Vec<BatchTally>,
}

/// The spreads of all outputs under each of the changes, the first of which is the baseline; `None`
/// if stopped.
pub(super) fn spreads(
    sampler: &Sampler,
    changes: &[Change],
    trials: u64,
    probability: f64,
    control: &Control<'_>,
) -> Option<Vec<Vec<Spread>>> {
    let changes = sampler.prepared(changes);
    let mut plans = plans(sampler, &changes, trials, probability, control);
    loop {
        let batches = tallies(sampler, &changes, &plans, trials, probability, control)?;
        if let Some(found) = finish_all(&batches, &plans, probability) {
            return Some(found);
        }
        if plans.iter().flatten().any(|plan| !plan.is_taken) {
            // trials were left out, so an output that is not moved has other ones
            plans.iter_mut().flatten().for_each(|plan| plan.is_taken = true);
        } else {
            // a limit missed a value that is needed
            plans.iter_mut().flatten().for_each(|plan| plan.limits = Limits::All);
        }
    }
}

/// The bytes of kept values of one change.
pub(super) fn bytes(sampler: &Sampler, trials: u64) -> usize {
    let all = trials.div_ceil(BLOCK as u64) <= SMALL;
    let kept = if all { 1.0 } else { 0.04 };
    let values = (8.0 * kept * trials as f64) as usize * sampler.outputs();
    values + sampler.outputs() * 8 * BLOCK + sampler.prepared_bytes()
}

fn plans(
    sampler: &Sampler,
    changes: &[Prepared<'_>],
    trials: u64,
    probability: f64,
    control: &Control<'_>,
) -> Vec<ChangePlan> {
    let blocks = trials.div_ceil(BLOCK as u64);
    let mut buffers = sampler.buffers();
    let values = vec![vec![Vec::new(); sampler.outputs()]; changes.len()];
    let mut pilot = Pilot { changes, values };
    for block in 0..blocks.min(PILOT) {
        let count = trials_in(block, trials);
        sampler.changed(control.path, block, count, changes, &mut buffers, &mut pilot);
    }
    let batch = trials as f64 / batches(trials).len().max(1) as f64;
    let tail = 0.5 - 0.5 * probability;
    let plan = |values: &mut Vec<f64>| {
        let n = values.len() as f64;
        let spread = (tail * (1.0 - tail)).sqrt();
        let margin = MARGIN * spread * (1.0 / n.sqrt() + 1.0 / batch.sqrt()) + 2.0 / batch;
        let ends = [tail - margin, tail + margin, 1.0 - tail - margin, 1.0 - tail + margin];
        let place = |share: f64| {
            let place = share * n;
            (place >= 1.0 && place < n - 1.0).then_some(place as usize)
        };
        let middle = place(0.5);
        let ends = if blocks <= SMALL { [None; 4] } else { ends.map(place) };
        let mut places: Vec<usize> = ends.into_iter().chain([middle]).flatten().collect();
        places.sort_unstable();
        places.dedup();
        put_in_order(values, 0, &places);
        let reference = middle.map_or(0.0, |place| values[place]);
        if blocks <= SMALL {
            return OutputPlan { limits: Limits::All, reference, is_taken: true };
        }
        let at = |place: Option<usize>, otherwise: f64| place.map_or(otherwise, |p| values[p]);
        let about = |low, high| [at(low, f64::NEG_INFINITY), at(high, f64::INFINITY)];
        let limits = Limits::About([about(ends[0], ends[1]), about(ends[2], ends[3])]);
        OutputPlan { limits, reference, is_taken: true }
    };
    let mut planned: Vec<ChangePlan> = Vec::with_capacity(changes.len());
    for (outputs, change) in pilot.values.iter_mut().zip(changes) {
        let baseline = planned.first();
        let plans = outputs.iter_mut().enumerate().map(|(output, values)| match baseline {
            // the values of the baseline
            Some(baseline) if !change.moves(output) => {
                OutputPlan { is_taken: false, ..baseline[output] }
            }
            _ => plan(values),
        });
        let plans = plans.collect();
        planned.push(plans);
    }
    planned
}

/// Moves the numbers with some ranks (from 0, rising) to their sorted positions; the first number
/// has the rank `first`.
fn put_in_order(values: &mut [f64], first: usize, ranks: &[usize]) {
    let Some(&middle) = ranks.get(ranks.len() / 2) else { return };
    let (lower, upper) = (&ranks[..ranks.len() / 2], &ranks[ranks.len() / 2 + 1..]);
    at_rank(values, middle - first);
    let (below, above) = values.split_at_mut(middle - first);
    put_in_order(below, first, lower);
    put_in_order(&mut above[1..], middle + 1, upper);
}

/// The finite values of the first blocks, of the outputs that the changes move.
struct Pilot<'a> {
    changes: &'a [Prepared<'a>],
    values: Vec<Vec<Vec<f64>>>,
}

impl Taker for Pilot<'_> {
    fn take(&mut self, _: CodePath, number: usize, outputs: Outputs<'_>, count: usize) {
        for (output, values) in self.values[number].iter_mut().enumerate() {
            if self.changes[number].moves(output) {
                let column = &outputs.column(output).0[..count];
                values.extend(column.iter().filter(|value| value.is_finite()));
            }
        }
    }
}

/// All batches, in order; each holds the changes.
fn tallies(
    sampler: &Sampler,
    changes: &[Prepared<'_>],
    plans: &[ChangePlan],
    trials: u64,
    probability: f64,
    control: &Control<'_>,
) -> Option<Vec<Vec<TrialBatch>>> {
    let batch = |blocks: std::ops::Range<u64>| {
        let mut buffers = sampler.buffers();
        let empty =
            TrialBatch { undefined: 0, outputs: vec![BatchTally::default(); sampler.outputs()] };
        let mut tallies = Tallies { found: vec![empty; changes.len()], plans };
        for block in blocks {
            if control.is_stopped() {
                return None;
            }
            let count = trials_in(block, trials);
            sampler.changed(control.path, block, count, changes, &mut buffers, &mut tallies);
            control.advance((count * changes.len()) as u64);
        }
        let mut found = tallies.found;
        for (batch, plan) in found.iter_mut().zip(plans) {
            for (tally, plan) in batch.outputs.iter_mut().zip(plan) {
                if tally.trials > 0 {
                    let interval = tally.interval(plan.limits, probability);
                    tally.half_length = interval.map(|[low, high]| 0.5 * high - 0.5 * low);
                }
            }
        }
        Some(found)
    };
    parallel::map(batches(trials), batch).into_iter().collect()
}

/// Whether the outputs are finite in all of the first `count` trials.
#[inline(always)]
fn are_defined(outputs: Outputs<'_>, count: usize) -> bool {
    // all values are counted, so that several are compared at a time
    let finite = |column: &Column| {
        column.0[..count].iter().map(|value| u64::from(value.is_finite())).sum::<u64>()
    };
    let mut all = true;
    for column in outputs.columns() {
        all &= finite(column) == count as u64;
    }
    all
}

/// Collects values into the tallies of a batch.
struct Tallies<'a> {
    found: Vec<TrialBatch>,
    plans: &'a [ChangePlan],
}

impl Taker for Tallies<'_> {
    fn take(&mut self, path: CodePath, number: usize, outputs: Outputs<'_>, count: usize) {
        path.run(AddTallies { tallies: self, number, outputs, count });
    }
}

struct AddTallies<'a, 't> {
    tallies: &'a mut Tallies<'t>,
    number: usize,
    outputs: Outputs<'a>,
    count: usize,
}

impl Kernel for AddTallies<'_, '_> {
    type Output = ();

    // evaluating the model takes most of the time
    const WIDEST: bool = false;

    #[inline(always)]
    fn run(self) {
        let Self { tallies, number, outputs, count } = self;
        let batch = &mut tallies.found[number];
        let plan = &tallies.plans[number];
        if !are_defined(outputs, count) {
            batch.add_defined(outputs, count, plan);
            return;
        }
        for ((output, tally), plan) in batch.outputs.iter_mut().enumerate().zip(plan) {
            if plan.is_taken {
                tally.add(&outputs.column(output).0[..count], plan);
            }
        }
    }
}

impl TrialBatch {
    /// Adds the trials with finite outputs, of which some of the first `count` are not.
    #[inline(never)]
    fn add_defined(&mut self, outputs: Outputs<'_>, count: usize, plan: &ChangePlan) {
        let is_defined = |trial: &usize| outputs.columns().all(|of| of.0[*trial].is_finite());
        let defined: Vec<usize> = (0..count).filter(is_defined).collect();
        self.undefined += (count - defined.len()) as u64;
        for ((output, tally), plan) in self.outputs.iter_mut().enumerate().zip(plan) {
            if plan.is_taken {
                let column = outputs.column(output);
                let values: Vec<f64> = defined.iter().map(|&trial| column.0[trial]).collect();
                tally.add(&values, plan);
            }
        }
    }
}

impl BatchTally {
    /// Adds at most a column of values.
    #[inline(always)]
    fn add(&mut self, values: &[f64], plan: &OutputPlan) {
        self.trials += values.len() as u64;
        [self.sums, self.squares] =
            with_deviations([self.sums, self.squares], values, plan.reference);
        match plan.limits {
            Limits::All => self.kept[0].extend_from_slice(values),
            Limits::About(about) => {
                for (below, [low, _]) in self.below.iter_mut().zip(about) {
                    *below += values.iter().map(|&value| u64::from(value < low)).sum::<u64>();
                }
                let [[a, b], [c, d]] = about;
                let is_kept = |v: f64| ((v >= a) & (v <= b)) | ((v >= c) & (v <= d));
                // few values are kept, and mostly none of some neighbours
                for chunk in values.chunks(NEIGHBOURS) {
                    if chunk.iter().map(|&value| u64::from(is_kept(value))).sum::<u64>() == 0 {
                        continue;
                    }
                    for &value in chunk.iter().filter(|&&value| is_kept(value)) {
                        for (kept, [low, high]) in self.kept.iter_mut().zip(about) {
                            if value >= low && value <= high {
                                kept.push(value);
                            }
                        }
                    }
                }
            }
        }
    }

    /// The sums of all lanes.
    fn sums(&self) -> [f64; 2] {
        [self.sums.iter().sum(), self.squares.iter().sum()]
    }

    /// The coverage interval; `None` if an endpoint was not kept.
    fn interval(&mut self, limits: Limits, probability: f64) -> Option<[f64; 2]> {
        let ranks = Ranks::new(self.trials, probability);
        let mut at = |side: usize, rank: u64| {
            let side = if matches!(limits, Limits::All) { 0 } else { side };
            let place = rank.checked_sub(self.below[side] + 1)? as usize;
            let kept = &mut self.kept[side];
            let is_kept = place < kept.len();
            is_kept.then(|| at_rank(kept, place))
        };
        Some([at(0, ranks.r)?, at(1, (ranks.r + ranks.q).min(self.trials))?])
    }
}

/// The spreads under all changes; `None` if an endpoint was not kept.
fn finish_all(
    batches: &[Vec<TrialBatch>],
    plans: &[ChangePlan],
    probability: f64,
) -> Option<Vec<Vec<Spread>>> {
    let mut found: Vec<Vec<Spread>> = Vec::with_capacity(plans.len());
    for change in 0..plans.len() {
        let spreads = finish(batches, change, plans, probability, found.first())?;
        found.push(spreads);
    }
    Some(found)
}

/// The spreads under one change; `None` if an endpoint was not kept.
fn finish(
    batches: &[Vec<TrialBatch>],
    change: usize,
    plans: &[ChangePlan],
    probability: f64,
    baseline: Option<&Vec<Spread>>,
) -> Option<Vec<Spread>> {
    let batches: Vec<&TrialBatch> = batches.iter().filter_map(|batch| batch.get(change)).collect();
    let undefined: u64 = batches.iter().map(|batch| batch.undefined).sum();
    let plan = plans.get(change)?;
    let spread = |(output, plan): (usize, &OutputPlan)| {
        if !plan.is_taken {
            // if trials are left out of either, they are not the same trials
            let baseline = baseline?.get(output)?;
            return (undefined == 0 && baseline.undefined == 0.0).then(|| baseline.clone());
        }
        let parts = batches.iter().filter_map(|batch| batch.outputs.get(output));
        let parts: Vec<&BatchTally> = parts.filter(|tally| tally.trials > 0).collect();
        let mut all = BatchTally::default();
        let (mut sum, mut squares) = (0.0, 0.0);
        for part in &parts {
            all.trials += part.trials;
            let [own_sum, own_squares] = part.sums();
            sum += own_sum;
            squares += own_squares;
            for side in 0..2 {
                all.below[side] += part.below[side];
                all.kept[side].extend_from_slice(&part.kept[side]);
            }
        }
        let n = all.trials as f64;
        let share = undefined as f64 / (n + undefined as f64);
        if all.trials < 2 {
            let interval = [f64::NAN; 2];
            return Some(Spread {
                std: f64::NAN,
                interval,
                half_lengths: Vec::new(),
                undefined: share,
            });
        }
        let half_lengths: Option<Vec<f64>> = parts.iter().map(|part| part.half_length).collect();
        let variance = (squares - sum * (sum / n)) / (n - 1.0);
        Some(Spread {
            std: variance.max(0.0).sqrt(),
            interval: all.interval(plan.limits, probability)?,
            half_lengths: half_lengths?,
            undefined: share,
        })
    };
    plan.iter().enumerate().map(spread).collect()
}
