//! What parts and passes consist of, as bytes. Each `read` refuses what no run can have made, so that
//! nothing behind it has to expect it.

use std::ops::Range;

use super::encoding::{ByteReader, Damaged, Writer};
use crate::distribution::BLOCK;
use crate::propagate::monte_carlo::accumulate::{Accumulated, AccumulatedOutput};
use crate::propagate::monte_carlo::figures::Adaptive;
use crate::propagate::monte_carlo::figures::{Finished, MonteCarlo, NumericalError, Undefined};
use crate::propagate::monte_carlo::partition::{Partition, PassTally};
use crate::propagate::monte_carlo::passes::{Look, Stretch};
use crate::propagate::monte_carlo::plan::Plan;
use crate::propagate::monte_carlo::quantiles::{self, QuantilePasses};
use crate::propagate::monte_carlo::request::trials_in;
use crate::propagate::monte_carlo::several_pass::{
    MOST_PASSES, OrderStatistics, Passes, Phase, Whole,
};
use crate::propagate::monte_carlo::shortest_scatter::{BATCHES, ShortestScatter, batch_blocks};
use crate::propagate::monte_carlo::sums::Sums;
use crate::propagate::monte_carlo::totals::{ChunkSums, SumTree, Totals};
use crate::task::StoppingRule;

/// The blocks of some chunks of the first `count` trials.
fn blocks_of(chunks: &Range<u64>, count: u64) -> Range<u64> {
    let length = batch_blocks(count);
    let end = count.div_ceil(BLOCK as u64);
    (chunks.start * length).min(end)..chunks.end.saturating_mul(length).min(end)
}

/// How many of the first `count` trials lie in some chunks.
fn trials_of(chunks: &Range<u64>, count: u64) -> u64 {
    let blocks = blocks_of(chunks, count);
    let at = |block: u64| block.saturating_mul(BLOCK as u64).min(count);
    at(blocks.end) - at(blocks.start)
}

fn write_place(out: &mut Writer, place: Option<(u64, usize)>) {
    out.option(place, |out, (block, trial)| {
        out.number(block);
        out.number(trial as u64);
    });
}

/// The place of a trial in some blocks of the first `count` trials.
fn read_place(
    from: &mut ByteReader<'_>,
    blocks: &Range<u64>,
    count: u64,
) -> Result<Option<(u64, usize)>, Damaged> {
    from.option(|from| {
        let block = from.number()?;
        Damaged::unless(blocks.contains(&block), "a trial is not among its own")?;
        let last = (trials_in(block, count) as u64).saturating_sub(1);
        let trial = from.at_most(last, "a trial is not among its own")?;
        Ok((block, trial as usize))
    })
}

/// A list of which every entry is read.
fn read_each<T>(
    count: u64,
    mut read: impl FnMut() -> Result<T, Damaged>,
) -> Result<Vec<T>, Damaged> {
    // grows as there are bytes
    let mut all = Vec::new();
    for _ in 0..count {
        all.push(read()?);
    }
    Ok(all)
}

impl Sums {
    fn write(&self, out: &mut Writer) {
        out.number(self.inside);
        out.reals(&self.powers);
        out.list(&self.products);
    }

    /// Of so many trials, and of an output with so many after it.
    fn read(from: &mut ByteReader<'_>, trials: u64, after: u64) -> Result<Self, Damaged> {
        let inside = from.at_most(trials, "more values than trials")?;
        let powers = from.reals()?;
        let products = from.list(after)?;
        let right = products.is_empty() || products.len() as u64 == after;
        Damaged::unless(right, "products of other outputs")?;
        Ok(Self { inside, powers, products })
    }
}

impl ChunkSums {
    fn write(&self, out: &mut Writer) {
        out.number(self.trials);
        out.number(self.outputs.len() as u64);
        self.outputs.iter().for_each(|sums| sums.write(out));
    }

    fn read(from: &mut ByteReader<'_>, most: u64, outputs: usize) -> Result<Self, Damaged> {
        let trials = from.at_most(most, "more trials than there can be")?;
        let count = from.number()?;
        let right = count == outputs as u64 || count == 0 && trials == 0;
        Damaged::unless(right, "sums of other outputs")?;
        let mut after = count;
        let sums = read_each(count, || {
            after -= 1;
            Sums::read(from, trials, after)
        })?;
        Ok(Self { trials, outputs: sums })
    }
}

impl SumTree {
    fn write(&self, out: &mut Writer) {
        let branches: Vec<_> = self.branches().collect();
        out.number(branches.len() as u64);
        for (first, length, sums) in branches {
            out.number(first);
            out.number(length);
            sums.write(out);
        }
    }

    /// The tree over some of so many chunks of `count` trials: all of its branches together are just
    /// these, and have just so many trials.
    fn read(
        from: &mut ByteReader<'_>,
        look: &Look<'_>,
        chunks: &Range<u64>,
        trials: u64,
    ) -> Result<Self, Damaged> {
        let mut tree = Self::new(look.chunks());
        let (mut next, mut sum) = (chunks.start, 0);
        for _ in 0..from.number()? {
            let (first, length) = (from.number()?, from.number()?);
            let fits = first == next && length <= chunks.end - next;
            Damaged::unless(fits && tree.is_branch(first, length), "sums of other trials")?;
            next += length;
            let sums = ChunkSums::read(from, trials - sum, look.plans.len())?;
            sum += sums.trials;
            tree.insert(first, length, sums);
        }
        Damaged::unless(next == chunks.end && sum == trials, "sums of other trials")?;
        Ok(tree)
    }
}

impl PassTally {
    fn write(&self, out: &mut Writer) {
        let mut empty = 0;
        for (count, [least, greatest]) in self.counted() {
            if count == 0 {
                empty += 1;
                continue;
            }
            // how many empty cells come before
            out.number(empty);
            empty = 0;
            out.number(count);
            out.real(least);
            out.real(greatest);
        }
        out.number(empty);
        out.list(self.kept());
    }

    /// Of so many values in the cells of a partition.
    fn read(
        from: &mut ByteReader<'_>,
        partition: &Partition,
        values: u64,
    ) -> Result<Self, Damaged> {
        let kept = partition.kept_leaves();
        let mut tally = partition.tally();
        let (mut leaf, mut left, mut held) = (0, values, 0);
        loop {
            let empty = from.at_most((kept.len() - leaf) as u64, "cells that are not there")?;
            leaf += empty as usize;
            if leaf == kept.len() {
                break;
            }
            let count = from.at_most(left, "more values than trials")?;
            Damaged::unless(count > 0, "a cell is empty that is said to be full")?;
            let (least, greatest) = (from.finite()?, from.finite()?);
            Damaged::unless(least <= greatest, "the ends of a cell are exchanged")?;
            left -= count;
            held += if kept[leaf] { count } else { 0 };
            tally.set(leaf, count, [least, greatest]);
            leaf += 1;
        }
        Damaged::unless(left == 0, "fewer values than trials")?;
        let values = from.list(held)?;
        Damaged::unless(values.len() as u64 == held, "values of kept cells are missing")?;
        Damaged::unless(values.iter().all(|v| v.is_finite()), "a value is not finite")?;
        Ok(tally.with_kept(values))
    }
}

impl Stretch {
    pub(super) fn write(&self, look: &Look<'_>, out: &mut Writer) {
        out.number(self.trials);
        out.number(self.undefined);
        write_place(out, self.first_undefined);
        if look.with_sums {
            self.sums.write(out);
        }
        self.tallies.iter().for_each(|tally| tally.write(out));
    }

    /// Of some chunks.
    pub(super) fn read(
        from: &mut ByteReader<'_>,
        look: &Look<'_>,
        chunks: &Range<u64>,
    ) -> Result<Self, Damaged> {
        let all = trials_of(chunks, look.count);
        let trials = from.at_most(all, "more trials than there can be")?;
        let undefined = from.number()?;
        Damaged::unless(undefined == all - trials, "trials are missing")?;
        let first_undefined = read_place(from, &blocks_of(chunks, look.count), look.count)?;
        let told = first_undefined.is_some() == (undefined > 0);
        Damaged::unless(told, "the first undefined trial is missing")?;
        let sums = if look.with_sums {
            SumTree::read(from, look, chunks, trials)?
        } else {
            SumTree::new(look.chunks())
        };
        let partitions = look.partitions.iter();
        let tallies = partitions
            .map(|partition| PassTally::read(from, partition, trials))
            .collect::<Result<_, _>>()?;
        Ok(Self { trials, undefined, first_undefined, sums, tallies })
    }
}

impl Accumulated {
    pub(super) fn write(&self, out: &mut Writer) {
        out.number(self.trials);
        out.number(self.undefined);
        write_place(out, self.first_undefined);
        for output in &self.outputs {
            output.sums.write(out);
            out.number(output.below_median);
            out.list(&output.kept);
        }
    }

    /// The chunk of a number of the first `count` trials.
    pub(super) fn read(
        from: &mut ByteReader<'_>,
        plans: &[Plan],
        number: u64,
        count: u64,
    ) -> Result<Self, Damaged> {
        let chunk = number..number + 1;
        let all = trials_of(&chunk, count);
        let trials = from.at_most(all, "more trials than there can be")?;
        let undefined = from.number()?;
        Damaged::unless(undefined == all - trials, "trials are missing")?;
        let first_undefined = read_place(from, &blocks_of(&chunk, count), count)?;
        let told = first_undefined.is_some() == (undefined > 0);
        Damaged::unless(told, "the first undefined trial is missing")?;
        let mut after = plans.len() as u64;
        let outputs = plans.iter().map(|plan| {
            after -= 1;
            let sums = Sums::read(from, trials, after)?;
            let below_median = from.at_most(trials, "more values than trials")?;
            let kept = from.list(trials)?;
            let keeps = |value: &f64| value.is_finite() && plan.windows.keeps(*value);
            Damaged::unless(kept.iter().all(keeps), "a value that is not kept")?;
            Ok(AccumulatedOutput { sums, kept, below_median })
        });
        let outputs = outputs.collect::<Result<_, Damaged>>()?;
        Ok(Self { trials, undefined, first_undefined, outputs })
    }
}

impl ShortestScatter {
    pub(super) fn write(&self, out: &mut Writer) {
        out.reals(&self.errors);
        out.flag(self.unique);
    }

    pub(super) fn read(from: &mut ByteReader<'_>) -> Result<Self, Damaged> {
        Ok(Self { errors: from.reals()?, unique: from.flag()? })
    }
}

impl OrderStatistics {
    fn write(&self, out: &mut Writer) {
        out.reals(&self.at);
        out.reals(&self.errors);
        out.reals(&self.extremes);
        out.reals(&self.shortest);
        out.flag(self.exact);
    }

    fn read(from: &mut ByteReader<'_>) -> Result<Self, Damaged> {
        Ok(Self {
            at: from.reals()?,
            errors: from.reals()?,
            extremes: from.reals()?,
            shortest: from.reals()?,
            exact: from.flag()?,
        })
    }
}

impl Totals {
    fn write(&self, out: &mut Writer) {
        self.whole.write(out);
        out.number(self.groups.len() as u64);
        self.groups.iter().for_each(|group| group.write(out));
    }

    fn read(from: &mut ByteReader<'_>, trials: u64, outputs: usize) -> Result<Self, Damaged> {
        let whole = ChunkSums::read(from, trials, outputs)?;
        Damaged::unless(whole.trials == trials, "sums of other trials")?;
        let groups = from.at_most(BATCHES as u64, "too many groups")?;
        let groups = read_each(groups, || ChunkSums::read(from, trials, outputs))?;
        Ok(Self::of(whole, groups))
    }
}

impl Passes {
    pub(super) fn write(&self, out: &mut Writer) {
        out.number(match self.phase {
            Phase::Coarse => 0,
            Phase::Narrow => 1,
            Phase::All(before) => 2 + u64::from(before),
        });
        self.partitions.iter().for_each(|partition| partition.write(out));
        out.option(self.whole.as_ref(), |out, whole| {
            out.number(whole.trials);
            out.number(whole.undefined);
            write_place(out, whole.first_undefined);
            whole.totals.write(out);
        });
        for found in &self.found {
            out.option(found.as_ref(), |out, found| found.write(out));
        }
    }

    /// Of so many outputs and trials.
    pub(super) fn read(
        from: &mut ByteReader<'_>,
        outputs: usize,
        count: u64,
    ) -> Result<Self, Damaged> {
        let most = u64::from(MOST_PASSES);
        let phase = match from.at_most(1 + most, "too many passes")? {
            0 => Phase::Coarse,
            1 => Phase::Narrow,
            later => Phase::All((later - 2) as u32),
        };
        let partitions = read_each(outputs as u64, || Partition::read(from))?;
        let whole = from.option(|from| {
            let trials = from.at_most(count, "more trials than there can be")?;
            let undefined = from.number()?;
            Damaged::unless(undefined == count - trials, "trials are missing")?;
            let blocks = 0..count.div_ceil(BLOCK as u64);
            let first_undefined = read_place(from, &blocks, count)?;
            let told = first_undefined.is_some() == (undefined > 0);
            Damaged::unless(told, "the first undefined trial is missing")?;
            let totals = Totals::read(from, trials, outputs)?;
            Ok(Whole { trials, undefined, first_undefined, totals, stopped: false })
        })?;
        let later = matches!(phase, Phase::All(before) if before > 0);
        Damaged::unless(whole.is_some() == later, "it does not say what was found")?;
        let found = read_each(outputs as u64, || from.option(OrderStatistics::read))?;
        Ok(Self::at(phase, partitions, whole, found))
    }
}

impl QuantilePasses {
    pub(super) fn write(&self, out: &mut Writer) {
        out.number(u64::from(self.before));
        self.partitions.iter().for_each(|partition| partition.write(out));
        for found in &self.found {
            out.option(found.as_ref(), |out, found| out.list(found));
        }
    }

    /// Of so many outputs, and quantiles of each.
    pub(super) fn read(
        from: &mut ByteReader<'_>,
        outputs: usize,
        scores: usize,
    ) -> Result<Self, Damaged> {
        let before = from.at_most(u64::from(quantiles::MOST_PASSES), "too many passes")? as u32;
        let partitions = read_each(outputs as u64, || Partition::read(from))?;
        let found = read_each(outputs as u64, || {
            from.option(|from| {
                let found = from.list(scores as u64)?;
                Damaged::unless(found.len() == scores, "quantiles are missing")?;
                Ok(found)
            })
        })?;
        Ok(Self { before, partitions, found })
    }
}

impl NumericalError {
    fn write(&self, out: &mut Writer) {
        let exists =
            [self.estimate, self.standard_uncertainty, self.skewness, self.excess_kurtosis];
        exists.into_iter().for_each(|error| out.option(error, Writer::real));
        out.real(self.median);
        out.reals(&self.symmetric_interval);
        out.reals(&self.shortest_interval);
    }

    fn read(from: &mut ByteReader<'_>) -> Result<Self, Damaged> {
        let mut exists = [None; 4];
        for error in &mut exists {
            *error = from.option(ByteReader::real)?;
        }
        let [estimate, standard_uncertainty, skewness, excess_kurtosis] = exists;
        Ok(Self {
            estimate,
            standard_uncertainty,
            median: from.real()?,
            symmetric_interval: from.reals()?,
            shortest_interval: from.reals()?,
            skewness,
            excess_kurtosis,
        })
    }
}

impl Adaptive {
    fn write(&self, out: &mut Writer) {
        let rule = StoppingRule::ALL.iter().position(|rule| *rule == self.rule);
        out.number(rule.unwrap_or(0) as u64);
        out.number(self.block_trials);
        out.number(self.blocks);
        out.real(self.tolerance);
        out.flag(self.converged);
    }

    fn read(from: &mut ByteReader<'_>) -> Result<Self, Damaged> {
        let rule = StoppingRule::ALL.get(from.number()? as usize);
        Ok(Self {
            rule: *rule.ok_or(Damaged::new("there is no such rule"))?,
            block_trials: from.number()?,
            blocks: from.number()?,
            tolerance: from.real()?,
            converged: from.flag()?,
        })
    }
}

impl MonteCarlo {
    fn write(&self, out: &mut Writer) {
        out.number(self.trials);
        let exists =
            [self.estimate, self.standard_uncertainty, self.skewness, self.excess_kurtosis];
        exists.into_iter().for_each(|figure| out.option(figure, Writer::real));
        out.reals(&[self.median, self.inside]);
        out.reals(&self.symmetric_interval);
        out.reals(&self.shortest_interval);
        let told = [self.shortest_exact, self.shortest_unique, self.heavy_tailed];
        told.into_iter().for_each(|told| out.flag(told));
        self.errors.write(out);
        out.option(self.adaptive.as_ref(), |out, adaptive| adaptive.write(out));
    }

    fn read(from: &mut ByteReader<'_>, trials: u64) -> Result<Self, Damaged> {
        Damaged::unless(from.number()? == trials, "figures of other trials")?;
        let mut exists = [None; 4];
        for figure in &mut exists {
            *figure = from.option(ByteReader::real)?;
        }
        let [estimate, standard_uncertainty, skewness, excess_kurtosis] = exists;
        let [median, inside] = from.reals()?;
        Ok(Self {
            trials,
            estimate,
            standard_uncertainty,
            median,
            symmetric_interval: from.reals()?,
            shortest_interval: from.reals()?,
            shortest_exact: from.flag()?,
            shortest_unique: from.flag()?,
            heavy_tailed: from.flag()?,
            skewness,
            excess_kurtosis,
            errors: NumericalError::read(from)?,
            inside,
            adaptive: from.option(Adaptive::read)?,
        })
    }
}

impl Finished {
    /// The figures of a row as bytes.
    pub(crate) fn write(&self, out: &mut Writer) {
        // without trials there are no figures
        let known = self.trials > 0;
        let outputs = if known { self.outputs.as_slice() } else { &[] };
        out.number(self.trials);
        out.number(outputs.len() as u64);
        outputs.iter().for_each(|output| output.write(out));
        out.list(if known { &self.correlations } else { &[] });
        let errors = self.correlation_errors.iter().filter(|_| known);
        errors.for_each(|error| out.option(*error, Writer::real));
        out.option(self.undefined.as_ref(), |out, undefined| {
            out.number(undefined.count);
            out.number(undefined.trials);
            out.list(&undefined.first);
        });
    }

    /// Of a row with so many outputs and varying inputs.
    ///
    /// # Errors
    /// Bytes that are no such figures.
    pub(crate) fn read(
        from: &mut ByteReader<'_>,
        outputs: usize,
        inputs: usize,
    ) -> Result<Self, Damaged> {
        let trials = from.number()?;
        let count = from.number()?;
        let right = if trials == 0 { 0 } else { outputs as u64 };
        Damaged::unless(count == right, "figures of other outputs")?;
        let found = read_each(count, || MonteCarlo::read(from, trials))?;
        let pairs = count * count.saturating_sub(1) / 2;
        let correlations = from.list(pairs)?;
        Damaged::unless(correlations.len() as u64 == pairs, "correlations are missing")?;
        let correlation_errors = read_each(pairs, || from.option(ByteReader::real))?;
        let undefined = from.option(|from| {
            let (count, trials) = (from.number()?, from.number()?);
            let first = from.list(inputs as u64)?;
            let right = count <= trials && first.len() == inputs;
            Damaged::unless(right, "an undefined trial of another model")?;
            Ok(Undefined { count, trials, first })
        })?;
        let stopped = false;
        Ok(Self { trials, outputs: found, correlations, correlation_errors, undefined, stopped })
    }
}
