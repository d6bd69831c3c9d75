//! The blocks of the procedure: the figures of every output in M trials.

use std::ops::Range;

use crate::parallel;

use super::{AdaptiveSearch, FIGURES};
use crate::distribution::BLOCK;
use crate::number::{CodePath, Kernel, at_rank};
use crate::propagate::Control;
use crate::propagate::monte_carlo::accumulate::drop_undefined;
use crate::propagate::monte_carlo::block::{RowTrials, Workspace};
use crate::propagate::monte_carlo::condensed::{CondensedBlock, Share, condense};
use crate::propagate::monte_carlo::interval::Ranks;
use crate::propagate::monte_carlo::moments::Moments;
use crate::propagate::monte_carlo::plan::Plan;
use crate::propagate::monte_carlo::sums::Sums;
use crate::propagate::monte_carlo::windows::Windows;

/// One output's figures in one block of the procedure: estimate, standard uncertainty, ends.
pub(super) type Figures = [f64; FIGURES];

/// Trials in a block of which all values may be held; of larger ones only the tails are.
const HELD: u64 = 1 << 17;

/// Values that are collected before the tails are cut back.
const FRESH: usize = 4096;

/// The figures of every output in some blocks of `size` trials.
pub(super) fn figures(
    trials: &mut RowTrials,
    numbers: Range<u64>,
    size: u64,
    plans: &[Plan],
    search: AdaptiveSearch<'_>,
    control: &Control<'_>,
) -> Vec<Vec<Option<Figures>>> {
    let run = BlockRun { size, plans, search, control };
    let share: f64 = plans.iter().map(|plan| plan.kept).sum();
    let kept = 8.0 * share * ((numbers.end - numbers.start) * size) as f64;
    let keeps_all = plans.iter().any(|plan| plan.windows.keep_all());
    if keeps_all || size < BLOCK as u64 || kept > control.memory as f64 {
        return run.figures_of_drawn_blocks(trials, numbers);
    }
    let (first, end) = (numbers.start * size, numbers.end * size);
    let (first, end) = (first / BLOCK as u64, end.div_ceil(BLOCK as u64));
    let known = trials.condensed.len();
    let from = if first <= known { known } else { first };
    let Some(made) = condense(trials, control, plans, from..end, size) else {
        return Vec::new();
    };
    let block = |block: u64| match trials.condensed.get(block) {
        Some(found) => Some(found),
        None => made.get(usize::try_from(block.checked_sub(from)?).ok()?),
    };
    // a block with more values beyond the windows than a pilot lets expect is made again
    let of_block = |workspace: &mut Workspace, number: u64| {
        run.figures_of_condensed(&block, number)
            .unwrap_or_else(|| run.figures_of_drawn(trials, workspace, number))
    };
    let found = parallel::map_with(numbers, || trials.workspace(), of_block);
    if from == known {
        trials.condensed.extend(made, control.memory);
    }
    found
}

/// How blocks are made.
#[derive(Clone, Copy)]
struct BlockRun<'a> {
    size: u64,
    plans: &'a [Plan],
    search: AdaptiveSearch<'a>,
    control: &'a Control<'a>,
}

impl BlockRun<'_> {
    /// The figures of every output in a block, from what is kept of the blocks of trials; `None` if an
    /// end may lie where nothing is kept.
    fn figures_of_condensed<'b>(
        self,
        block: &impl Fn(u64) -> Option<&'b CondensedBlock>,
        number: u64,
    ) -> Option<Vec<Option<Figures>>> {
        let (first, last) = (number * self.size, (number + 1) * self.size);
        let of_output = |(output, plan): (usize, &Plan)| {
            let mut fenced = Fenced::new(*plan);
            for number in first / BLOCK as u64..last.div_ceil(BLOCK as u64) {
                let start = number * BLOCK as u64;
                let share = if start < first {
                    Share::AfterEdge
                } else if last < start + BLOCK as u64 {
                    Share::BeforeEdge
                } else {
                    Share::Whole
                };
                let block = block(number)?;
                let (sums, kept) = block.output(share, output)?;
                fenced.count += block.trials(share);
                fenced.sums.merge(sums);
                fenced.kept.extend_from_slice(kept);
            }
            if fenced.count < 2 {
                return Some(None);
            }
            fenced.figures(self.search.probability).map(Some)
        };
        self.plans.iter().enumerate().map(of_output).collect()
    }

    /// The figures of every output in some blocks, from all of their values.
    fn figures_of_drawn_blocks(
        self,
        trials: &RowTrials,
        numbers: Range<u64>,
    ) -> Vec<Vec<Option<Figures>>> {
        let of_block = |workspace: &mut Workspace, number: u64| {
            self.figures_of_drawn(trials, workspace, number)
        };
        parallel::map_with(numbers, || trials.workspace(), of_block)
    }

    /// The figures of every output in a block, from all of its values.
    fn figures_of_drawn(
        self,
        trials: &RowTrials,
        workspace: &mut Workspace,
        number: u64,
    ) -> Vec<Option<Figures>> {
        let Self { size, plans, search, control } = self;
        let path = control.path;
        let (first, last) = (number * size, (number + 1) * size);
        let new = |plan: &Plan| BlockValues::new(size, search.probability, *plan);
        let mut values: Vec<BlockValues> = plans.iter().map(new).collect();
        for block in first / BLOCK as u64..last.div_ceil(BLOCK as u64) {
            if control.is_stopped() {
                break;
            }
            let start = block * BLOCK as u64;
            trials.block(path, block, workspace);
            let from = first.saturating_sub(start) as usize;
            let to = (last - start).min(BLOCK as u64) as usize;
            for output in &mut workspace.outputs {
                output.copy_within(from..to, 0);
            }
            let (count, _) = drop_undefined(path, &mut workspace.outputs, to - from);
            for (values, output) in values.iter_mut().zip(&workspace.outputs) {
                path.run(Add { path, values, new: &output[..count] });
            }
        }
        values.iter_mut().map(|values| values.figures(search.probability)).collect()
    }
}

/// Adds values to those of a block.
struct Add<'a> {
    path: CodePath,
    values: &'a mut BlockValues,
    new: &'a [f64],
}

impl Kernel for Add<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { path, values, new } = self;
        match values {
            BlockValues::All(all) => {
                all.count += new.len() as u64;
                all.sums.add(path, new, all.plan.reference);
                all.kept.extend_from_slice(new);
            }
            BlockValues::Tails(tails) => new.iter().for_each(|&value| tails.push(value)),
        }
    }
}

/// The values of one output in a block.
#[derive(Debug)]
enum BlockValues {
    All(Fenced),
    Tails(Tails),
}

/// Sums of values, and those that the windows keep.
#[derive(Debug)]
struct Fenced {
    plan: Plan,
    count: u64,
    sums: Sums,
    kept: Vec<f64>,
}

/// Sums of values and their tails.
#[derive(Debug)]
struct Tails {
    count: u64,
    /// About this one sums are taken.
    middle: f64,
    sum: f64,
    squares: f64,
    /// The lowest values, at least so many.
    low: (Vec<f64>, usize),
    /// The highest ones, negative.
    high: (Vec<f64>, usize),
}

impl BlockValues {
    /// Of so many trials, of which some may not count.
    fn new(size: u64, probability: f64, plan: Plan) -> Self {
        if size <= HELD {
            return Self::All(Fenced::new(Plan { windows: Windows::ALL, ..plan }));
        }
        let Ranks { q, r } = Ranks::new(size, probability);
        // of fewer trials the ranks are no farther from the ends, but for rounding
        let (low, high) = (r as usize + 2, (size + 1).saturating_sub(r + q) as usize + 2);
        Self::Tails(Tails {
            count: 0,
            middle: 0.0,
            sum: 0.0,
            squares: 0.0,
            low: (Vec::new(), low),
            high: (Vec::new(), high),
        })
    }

    /// The figures, if there are enough values to have any.
    fn figures(&mut self, probability: f64) -> Option<Figures> {
        match self {
            Self::All(all) if all.count < 2 => None,
            Self::All(all) => all.figures(probability),
            Self::Tails(tails) => tails.figures(probability),
        }
    }
}

impl Fenced {
    fn new(plan: Plan) -> Self {
        Self { plan, count: 0, sums: Sums::default(), kept: Vec::new() }
    }

    /// The figures; `None` if an end may lie where nothing is kept.
    fn figures(&mut self, probability: f64) -> Option<Figures> {
        let Self { plan: Plan { reference, windows, .. }, count, sums, kept } = self;
        let Ranks { q, r } = Ranks::new(*count, probability);
        let (from_bottom, from_top) = (r as usize - 1, (*count - (r + q).min(*count)) as usize);
        let beyond = |is: &dyn Fn(f64) -> bool| kept.iter().filter(|&&value| is(value)).count();
        let enough = windows.keep_all()
            || beyond(&|value| value <= windows.low) > from_bottom
                && beyond(&|value| value >= windows.high) > from_top;
        if !enough {
            return None;
        }
        let high = kept.len() - 1 - from_top;
        let high_end = at_rank(kept, high);
        let low_end = at_rank(kept, from_bottom);
        let moments = Moments::new(*count, *reference, sums);
        Some([moments.mean, moments.std, low_end, high_end])
    }
}

impl Tails {
    fn push(&mut self, value: f64) {
        if self.count == 0 {
            self.middle = value;
        }
        self.count += 1;
        let offset = value - self.middle;
        self.sum += offset;
        self.squares += offset * offset;
        for ((kept, wanted), value) in [(&mut self.low, value), (&mut self.high, -value)] {
            kept.push(value);
            if kept.len() >= *wanted + FRESH {
                at_rank(kept, *wanted);
                kept.truncate(*wanted);
            }
        }
    }

    fn figures(&mut self, probability: f64) -> Option<Figures> {
        let count = self.count;
        if count < 2 {
            return None;
        }
        let n = count as f64;
        let offset = self.sum / n;
        let squares = f64::max(self.squares - n * offset * offset, 0.0);
        let Ranks { q, r } = Ranks::new(count, probability);
        let from_top = count - (r + q).min(count);
        let end = |kept: &mut Vec<f64>, rank: usize| {
            let found = rank < kept.len();
            found.then(|| at_rank(kept, rank))
        };
        let low = end(&mut self.low.0, r as usize - 1)?;
        let high = -end(&mut self.high.0, from_top as usize)?;
        Some([self.middle + offset, (squares / (n - 1.0)).sqrt(), low, high])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::propagate::monte_carlo::plan::Reference;

    /// Mean and standard deviation in two passes, the ends from a full sort.
    fn directly(values: &[f64], probability: f64) -> Figures {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
        let mut sorted = values.to_vec();
        sorted.sort_unstable_by(f64::total_cmp);
        let Ranks { q, r } = Ranks::new(values.len() as u64, probability);
        let at = |rank: u64| sorted[rank as usize - 1];
        [mean, (squares / (n - 1.0)).sqrt(), at(r), at((r + q).min(values.len() as u64))]
    }

    /// A plan with windows beyond two values.
    fn plan(middle: f64, windows: Option<[f64; 2]>) -> Plan {
        let (scale, kept) = (1e5, 1.0);
        let limits = [f64::NEG_INFINITY, f64::INFINITY];
        let windows = windows.map_or(Windows::ALL, |[low, high]| Windows {
            low,
            median_low: f64::INFINITY,
            median_high: f64::NEG_INFINITY,
            high,
            ends: [low - 1.0, high + 1.0],
        });
        Plan { reference: Reference { middle, scale, limits }, windows, kept }
    }

    /// The figures from sums and tails are those of all values: the ends exactly, mean and standard
    /// deviation to the rounding of their sums.
    #[test]
    fn tails_hold_the_ends() {
        // a full cycle of a linear congruence: every number below 2^18 once, far from zero
        let size = 1u64 << 18;
        let value = |i: u64| ((i * 5 * 4001 + 12_345) % size) as f64 - 1e6;
        let path = CodePath::best();
        let cases = [(size, 0.9995), (size - 1000, 0.9999), (300_000 / 2, 0.99925), (10_000, 0.95)];
        for (count, probability) in cases {
            let all: Vec<f64> = (0..count).map(value).collect();
            let exact = directly(&all, probability);
            let agrees = |found: Figures| {
                assert_eq!(exact[2..], found[2..]);
                assert!((exact[0] - found[0]).abs() < 1e-6, "{exact:?}, {found:?}");
                assert!((exact[1] / found[1] - 1.0).abs() < 1e-9, "{exact:?}, {found:?}");
            };
            let mut values = BlockValues::new(size.min(count), probability, plan(-9e5, None));
            assert_eq!(matches!(values, BlockValues::Tails(_)), count > HELD);
            for part in all.chunks(1000) {
                path.run(Add { path, values: &mut values, new: part });
            }
            agrees(values.figures(probability).unwrap());
            // 3 % on each side, and too little for the ends of 95 %
            for share in [0.03, 0.006] {
                let width = share * size as f64;
                let windows = [width - 1e6, size as f64 - width - 1e6];
                let mut fenced = Fenced::new(plan(-9e5, Some(windows)));
                fenced.count = count;
                fenced.sums.add(path, &all, fenced.plan.reference);
                fenced.kept =
                    all.iter().copied().filter(|v| fenced.plan.windows.keeps(*v)).collect();
                let found = fenced.figures(probability);
                if share == 0.006 && probability == 0.95 {
                    assert_eq!(found, None);
                } else {
                    agrees(found.unwrap());
                }
            }
        }
    }
}
