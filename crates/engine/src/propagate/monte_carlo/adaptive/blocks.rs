//! The blocks of the procedure: the figures of every output in M trials.

use rayon::prelude::*;

use super::{FIGURES, Search};
use crate::distribution::BLOCK;
use crate::number::{CodePath, Kernel};
use crate::propagate::Control;
use crate::propagate::monte_carlo::accumulate::{drop_undefined, keep};
use crate::propagate::monte_carlo::block::{RowTrials, Workspace};
use crate::propagate::monte_carlo::interval::Ranks;
use crate::propagate::monte_carlo::moments::Moments;
use crate::propagate::monte_carlo::pilot::plans;
use crate::propagate::monte_carlo::plan::Plan;
use crate::propagate::monte_carlo::request::Request;
use crate::propagate::monte_carlo::sums::Sums;
use crate::propagate::monte_carlo::windows::Windows;

/// One output's figures in one block of the procedure: estimate, standard uncertainty, ends.
pub(super) type Figures = [f64; FIGURES];

/// Trials in a block of which all values may be held; of larger ones only the tails are.
const HELD: u64 = 1 << 17;

/// Values that are collected before the tails are cut back.
const FRESH: usize = 4096;

/// Trials that the pilot takes itself to be one of many of.
const MANY: u64 = 1 << 40;

/// How much wider than those of a long run the windows are: a block has fewer trials, whose ranks
/// scatter more.
const WIDENING: f64 = 1.5;

/// Where in a block the ends of the symmetric interval lie: windows from the pilot.
pub(super) fn fences(trials: &RowTrials, search: Search<'_>, control: &Control<'_>) -> Vec<Plan> {
    let Search { probability, drawn_dof, .. } = search;
    // each end leaves half of what is not covered
    let probability = 0.5 + 0.5 * probability;
    let request = Request { trials: MANY, probability, drawn_dof };
    let plans = plans(trials, request, control, WIDENING).into_iter();
    plans.map(|plan| Plan { windows: plan.windows.without_median(), ..plan }).collect()
}

/// The figures of every output in some blocks of `size` trials.
pub(super) fn figures(
    trials: &RowTrials,
    numbers: std::ops::Range<u64>,
    size: u64,
    fences: &[Plan],
    search: Search<'_>,
    control: &Control<'_>,
) -> Vec<Vec<Option<Figures>>> {
    let everything: Vec<Plan> =
        fences.iter().map(|plan| Plan { windows: Windows::ALL, ..*plan }).collect();
    let of_block = |drawn: &mut Drawn, number: u64| {
        let run = Run { trials, size, search, control };
        // a block with more values beyond a fence than a pilot lets expect is made again
        run.figures(drawn, number, fences)
            .or_else(|| run.figures(drawn, number, &everything))
            .unwrap_or_else(|| vec![None; fences.len()])
    };
    let drawn = || Drawn { workspace: trials.workspace(), shared: None };
    numbers.into_par_iter().map_init(drawn, of_block).collect()
}

/// The values of trials, which are drawn in blocks of their own: the last one of a block of the
/// procedure is mostly the first one of the next.
struct Drawn {
    workspace: Workspace,
    shared: Option<(u64, Vec<[f64; BLOCK]>)>,
}

impl Drawn {
    /// Draws a block of trials, unless it is the one that was drawn last; `is_last` tells that another
    /// block of the procedure begins in it.
    fn draw(&mut self, trials: &RowTrials, path: CodePath, block: u64, is_last: bool) {
        match &self.shared {
            Some((known, values)) if *known == block => {
                self.workspace.outputs.copy_from_slice(values);
            }
            _ => trials.block(path, block, &mut self.workspace),
        }
        if is_last {
            self.shared = Some((block, self.workspace.outputs.clone()));
        }
    }
}

/// How blocks are made.
#[derive(Clone, Copy)]
struct Run<'a> {
    trials: &'a RowTrials,
    size: u64,
    search: Search<'a>,
    control: &'a Control<'a>,
}

impl Run<'_> {
    /// The figures of every output; `None` if an end may lie inside the fences.
    fn figures(
        self,
        drawn: &mut Drawn,
        number: u64,
        fences: &[Plan],
    ) -> Option<Vec<Option<Figures>>> {
        let Self { trials, size, search, control } = self;
        let path = control.path;
        let (first, last) = (number * size, (number + 1) * size);
        let new = |plan: &Plan| Values::new(size, search.probability, *plan);
        let mut values: Vec<Values> = fences.iter().map(new).collect();
        for block in first / BLOCK as u64..last.div_ceil(BLOCK as u64) {
            if control.is_stopped() {
                break;
            }
            let start = block * BLOCK as u64;
            drawn.draw(trials, path, block, last < start + BLOCK as u64);
            let workspace = &mut drawn.workspace;
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
    values: &'a mut Values,
    new: &'a [f64],
}

impl Kernel for Add<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { path, values, new } = self;
        match values {
            Values::Kept(fenced) => {
                fenced.count += new.len() as u64;
                fenced.sums.add(path, new, fenced.plan.reference);
                keep(path, new, &fenced.plan.windows, &mut fenced.kept);
            }
            Values::Tails(tails) => new.iter().for_each(|&value| tails.push(value)),
        }
    }
}

/// The values of one output in a block.
#[derive(Debug)]
enum Values {
    Kept(Fenced),
    Tails(Tails),
}

/// Sums of values, and those beyond the fences.
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

impl Values {
    /// Of so many trials, of which some may not count.
    fn new(size: u64, probability: f64, plan: Plan) -> Self {
        if size <= HELD || !plan.windows.keep_all() {
            let (sums, kept) = (Sums::default(), Vec::new());
            return Self::Kept(Fenced { plan, count: 0, sums, kept });
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

    /// The figures, if there are enough values to have any; `None` if an end may lie inside the
    /// fences.
    fn figures(&mut self, probability: f64) -> Option<Option<Figures>> {
        match self {
            Self::Kept(fenced) if fenced.count < 2 => Some(None),
            Self::Kept(fenced) => fenced.figures(probability).map(Some),
            Self::Tails(tails) => Some(tails.figures(probability)),
        }
    }
}

impl Fenced {
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
        let high_end = *kept.select_nth_unstable_by(high, f64::total_cmp).1;
        let low_end = *kept.select_nth_unstable_by(from_bottom, f64::total_cmp).1;
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
                kept.select_nth_unstable_by(*wanted, f64::total_cmp);
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
            found.then(|| *kept.select_nth_unstable_by(rank, f64::total_cmp).1)
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
        sorted.sort_by(f64::total_cmp);
        let Ranks { q, r } = Ranks::new(values.len() as u64, probability);
        let at = |rank: u64| sorted[rank as usize - 1];
        [mean, (squares / (n - 1.0)).sqrt(), at(r), at((r + q).min(values.len() as u64))]
    }

    /// A plan with windows beyond two values.
    fn plan(middle: f64, windows: Option<[f64; 2]>) -> Plan {
        let scale = 1e5;
        let limits = [f64::NEG_INFINITY, f64::INFINITY];
        let windows = windows.map_or(Windows::ALL, |[low, high]| {
            Windows { low, high, ends: [low - 1.0, high + 1.0], ..Windows::ALL }.without_median()
        });
        Plan { reference: Reference { middle, scale, limits }, windows, kept: 1.0 }
    }

    /// The figures from sums and tails are those of all values: the ends exactly, mean and standard
    /// deviation to the rounding of their sums.
    #[test]
    fn tails_hold_the_ends() {
        // a full cycle of a linear congruence: every number below 2^18 once, far from zero
        let size = 1u64 << 18;
        let value = |i: u64| ((i * 5 * 4001 + 12_345) % size) as f64 - 1e6;
        let cases = [(size, 0.9995), (size - 1000, 0.9999), (300_000 / 2, 0.99925), (10_000, 0.95)];
        for (count, probability) in cases {
            let all: Vec<f64> = (0..count).map(value).collect();
            let exact = directly(&all, probability);
            // 3 % on each side, nothing, and too little for the ends of 95 %
            let third = 0.03 * size as f64;
            let fences = [third - 1e6, size as f64 - third - 1e6];
            let narrow = [0.2 * third - 1e6, size as f64 - 0.2 * third - 1e6];
            for windows in [None, Some(fences), Some(narrow)] {
                let mut values = Values::new(size, probability, plan(-9e5, windows));
                for part in all.chunks(1000) {
                    let path = CodePath::best();
                    path.run(Add { path, values: &mut values, new: part });
                }
                assert_eq!(matches!(values, Values::Tails(_)), windows.is_none());
                let found = values.figures(probability);
                if windows == Some(narrow) && probability == 0.95 {
                    assert_eq!(found, None);
                    continue;
                }
                let found = found.unwrap().unwrap();
                assert_eq!(exact[2..], found[2..]);
                assert!((exact[0] - found[0]).abs() < 1e-6, "{exact:?}, {found:?}");
                assert!((exact[1] / found[1] - 1.0).abs() < 1e-9, "{exact:?}, {found:?}");
            }
        }
    }
}
