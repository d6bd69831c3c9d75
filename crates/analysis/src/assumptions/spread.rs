//! How widely the outputs scatter under changes of the inputs, all from the same random numbers.
//!
//! Trials are made in batches whose own figures tell how far the ratio of two spreads scatters; what
//! both have in common cancels in it. Of each output only the values about the ends of the coverage
//! interval are kept, between limits that a pilot of the first blocks fixes.

use rayon::prelude::*;

use super::sampler::{Change, Prepared, Sampler};
use gumption_engine::distribution::BLOCK;
use gumption_engine::number::Kernel;
use gumption_engine::propagate::Control;
use gumption_engine::propagate::monte_carlo::Ranks;

/// Batches whose scatter gives the numerical standard errors.
const BATCHES: u64 = 32;

/// Blocks of the pilot.
const PILOT: u64 = 16;

/// Runs of at most so many blocks keep all values.
const SMALL: u64 = 64;

/// How many standard deviations of a rank the limits are wider than they need to be on average.
const MARGIN: f64 = 6.0;

/// The spread of one output under one change.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Spread {
    /// Standard deviation of the trials.
    pub(super) std: f64,
    /// Probabilistically symmetric coverage interval.
    pub(super) interval: [f64; 2],
    /// Half the interval's length in each batch.
    half_lengths: Vec<f64>,
    /// Trials that were left out because an output was not finite, of all.
    pub(super) undefined: f64,
}

impl Spread {
    /// Half the length of the interval.
    pub(super) fn half_length(&self) -> f64 {
        0.5 * self.interval[1] - 0.5 * self.interval[0]
    }

    /// The change of half the length relative to another spread, and its numerical standard error;
    /// `None` where that other one has no length.
    pub(super) fn change(&self, from: &Self) -> Option<[f64; 2]> {
        let ratio = |a: f64, b: f64| if b > 0.0 { Some(a / b - 1.0) } else { None };
        let change = ratio(self.half_length(), from.half_length())?;
        let batches = self.half_lengths.iter().zip(&from.half_lengths);
        let batches: Option<Vec<f64>> = batches.map(|(a, b)| ratio(*a, *b)).collect();
        Some([change, batches.map_or(f64::NAN, |batches| standard_error(&batches))])
    }
}

/// The standard error of the mean of independent values; not a number of fewer than two.
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

/// How many of the first `trials` trials lie in a block.
pub(super) fn trials_in(block: u64, trials: u64) -> usize {
    trials.saturating_sub(block * BLOCK as u64).min(BLOCK as u64) as usize
}

/// Which values of one output are kept.
#[derive(Clone, Copy, Debug)]
enum Limits {
    All,
    About([[f64; 2]; 2]),
}

/// A change's limits and references, output by output.
type Plan = Vec<(Limits, f64)>;

/// One output's values in one batch.
#[derive(Clone, Debug, Default)]
struct Tally {
    trials: u64,
    sum: f64,
    squares: f64,
    below: [u64; 2],
    kept: [Vec<f64>; 2],
    /// Half the length of the coverage interval, of a whole batch; `None` if an end was not kept.
    half_length: Option<f64>,
}

/// One change's values in one batch.
#[derive(Clone, Debug)]
struct Batch {
    undefined: u64,
    outputs: Vec<Tally>,
}

/// The spreads of all outputs under each of the changes; `None` if stopped.
pub(super) fn spreads(
    sampler: &Sampler,
    changes: &[Change],
    (trials, probability): (u64, f64),
    control: &Control<'_>,
) -> Option<Vec<Vec<Spread>>> {
    let changes = sampler.prepared(changes);
    let mut plans = plans(sampler, &changes, (trials, probability), control);
    loop {
        let request = (trials, probability);
        let batches = tallies(sampler, &changes, &plans, request, control)?;
        let found: Option<Vec<Vec<Spread>>> =
            (0..changes.len()).map(|c| finish(&batches, c, &plans, probability)).collect();
        if found.is_some() {
            return found;
        }
        // a limit missed a value that is needed
        plans.iter_mut().flatten().for_each(|(limits, _)| *limits = Limits::All);
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
    (trials, probability): (u64, f64),
    control: &Control<'_>,
) -> Vec<Plan> {
    let blocks = trials.div_ceil(BLOCK as u64);
    let pilot = blocks.min(PILOT);
    let mut buffers = sampler.buffers();
    let mut out = sampler.blocks(changes.len());
    let mut values: Vec<Vec<Vec<f64>>> = vec![vec![Vec::new(); sampler.outputs()]; changes.len()];
    for block in 0..pilot {
        sampler.changed(control.path, block, changes, &mut buffers, &mut out);
        let count = trials_in(block, trials);
        for (values, out) in values.iter_mut().zip(&out) {
            for (values, out) in values.iter_mut().zip(out) {
                values.extend(out[..count].iter().filter(|value| value.is_finite()));
            }
        }
    }
    let batch = trials as f64 / batches(trials).len().max(1) as f64;
    let plan = |values: &mut Vec<f64>| {
        values.sort_unstable_by(f64::total_cmp);
        let n = values.len() as f64;
        let at = |share: f64| {
            let place = share * n;
            let inside = place >= 1.0 && place < n - 1.0;
            inside.then(|| values.get(place as usize).copied()).flatten()
        };
        let reference = at(0.5).unwrap_or(0.0);
        if blocks <= SMALL {
            return (Limits::All, reference);
        }
        let tail = 0.5 - 0.5 * probability;
        let spread = (tail * (1.0 - tail)).sqrt();
        let margin = MARGIN * spread * (1.0 / n.sqrt() + 1.0 / batch.sqrt()) + 2.0 / batch;
        let about = |share: f64| {
            [
                at(share - margin).unwrap_or(f64::NEG_INFINITY),
                at(share + margin).unwrap_or(f64::INFINITY),
            ]
        };
        (Limits::About([about(tail), about(1.0 - tail)]), reference)
    };
    values.iter_mut().map(|outputs| outputs.iter_mut().map(plan).collect()).collect()
}

/// All batches, in order; for each the changes.
fn tallies(
    sampler: &Sampler,
    changes: &[Prepared<'_>],
    plans: &[Plan],
    (trials, probability): (u64, f64),
    control: &Control<'_>,
) -> Option<Vec<Vec<Batch>>> {
    let batch = |blocks: std::ops::Range<u64>| {
        let mut buffers = sampler.buffers();
        let mut out = sampler.blocks(changes.len());
        let empty = Batch { undefined: 0, outputs: vec![Tally::default(); sampler.outputs()] };
        let mut found = vec![empty; changes.len()];
        for block in blocks {
            if control.is_stopped() {
                return None;
            }
            sampler.changed(control.path, block, changes, &mut buffers, &mut out);
            let count = trials_in(block, trials);
            for ((batch, values), plan) in found.iter_mut().zip(&mut out).zip(plans) {
                let defined = defined(values, count);
                batch.undefined += (count - defined) as u64;
                for ((tally, values), plan) in batch.outputs.iter_mut().zip(values).zip(plan) {
                    control.path.run(Add { tally, values: &values[..defined], plan: *plan });
                }
            }
            control.advance((count * changes.len()) as u64);
        }
        for (batch, plan) in found.iter_mut().zip(plans) {
            for (tally, &(limits, _)) in batch.outputs.iter_mut().zip(plan) {
                if tally.trials > 0 {
                    let interval = tally.interval(limits, probability);
                    tally.half_length = interval.map(|[low, high]| 0.5 * high - 0.5 * low);
                }
            }
        }
        Some(found)
    };
    batches(trials).into_par_iter().map(batch).collect()
}

/// Moves the trials whose outputs are all finite to the front, and tells how many there are.
fn defined(values: &mut [[f64; BLOCK]], count: usize) -> usize {
    let finite =
        |values: &[[f64; BLOCK]], trial: usize| values.iter().all(|v| v[trial].is_finite());
    // all values are looked at, so that several are at a time
    if values.iter().all(|v| v[..count].iter().fold(true, |all, x| all & x.is_finite())) {
        return count;
    }
    let mut left = 0;
    for trial in 0..count {
        if finite(values, trial) {
            values.iter_mut().for_each(|v| v[left] = v[trial]);
            left += 1;
        }
    }
    left
}

/// Sums are taken in so many lanes, and values sought among so many at a time.
const LANES: usize = 16;

/// Takes values into a tally.
struct Add<'a> {
    tally: &'a mut Tally,
    values: &'a [f64],
    plan: (Limits, f64),
}

impl Kernel for Add<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { tally, values, plan: (limits, reference) } = self;
        tally.trials += values.len() as u64;
        let (mut sums, mut squares) = ([0.0; LANES], [0.0; LANES]);
        let (chunks, rest) = values.as_chunks::<LANES>();
        let mut add = |lane: usize, value: f64| {
            let d = value - reference;
            sums[lane] += d;
            squares[lane] += d * d;
        };
        for chunk in chunks {
            (0..LANES).for_each(|lane| add(lane, chunk[lane]));
        }
        rest.iter().enumerate().for_each(|(lane, &value)| add(lane, value));
        tally.sum += sums.iter().sum::<f64>();
        tally.squares += squares.iter().sum::<f64>();
        match limits {
            Limits::All => tally.kept[0].extend_from_slice(values),
            Limits::About(about) => {
                for ([low, high], (below, kept)) in
                    about.into_iter().zip(tally.below.iter_mut().zip(&mut tally.kept))
                {
                    let is_kept = |value: f64| (value >= low) & (value <= high);
                    *below += values.iter().map(|&value| u64::from(value < low)).sum::<u64>();
                    // few are kept, and mostly none of some neighbours
                    for chunk in chunks {
                        if chunk.iter().fold(false, |any, &value| any | is_kept(value)) {
                            kept.extend(chunk.iter().filter(|value| is_kept(**value)));
                        }
                    }
                    kept.extend(rest.iter().filter(|value| is_kept(**value)));
                }
            }
        }
    }
}

impl Tally {
    /// The coverage interval; `None` if an end was not kept.
    fn interval(&mut self, limits: Limits, probability: f64) -> Option<[f64; 2]> {
        let ranks = Ranks::new(self.trials, probability);
        let mut at = |side: usize, rank: u64| {
            let side = if matches!(limits, Limits::All) { 0 } else { side };
            let place = rank.checked_sub(self.below[side] + 1)? as usize;
            let kept = &mut self.kept[side];
            let is_kept = place < kept.len();
            is_kept.then(|| *kept.select_nth_unstable_by(place, f64::total_cmp).1)
        };
        Some([at(0, ranks.r)?, at(1, (ranks.r + ranks.q).min(self.trials))?])
    }
}

/// The spreads under one change; `None` if an end was not kept.
fn finish(
    batches: &[Vec<Batch>],
    change: usize,
    plans: &[Plan],
    probability: f64,
) -> Option<Vec<Spread>> {
    let batches: Vec<&Batch> = batches.iter().filter_map(|batch| batch.get(change)).collect();
    let undefined: u64 = batches.iter().map(|batch| batch.undefined).sum();
    let plan = plans.get(change)?;
    let spread = |(output, &(limits, _)): (usize, &(Limits, f64))| {
        let parts = batches.iter().filter_map(|batch| batch.outputs.get(output));
        let parts: Vec<&Tally> = parts.filter(|tally| tally.trials > 0).collect();
        let mut all = Tally::default();
        for part in &parts {
            all.trials += part.trials;
            all.sum += part.sum;
            all.squares += part.squares;
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
        let variance = (all.squares - all.sum * (all.sum / n)) / (n - 1.0);
        Some(Spread {
            std: variance.max(0.0).sqrt(),
            interval: all.interval(limits, probability)?,
            half_lengths: half_lengths?,
            undefined: share,
        })
    };
    plan.iter().enumerate().map(spread).collect()
}
