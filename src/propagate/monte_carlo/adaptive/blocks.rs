//! The blocks of the procedure: the figures of every output in M trials.

use rayon::prelude::*;

use super::{FIGURES, Search};
use crate::distribution::BLOCK;
use crate::propagate::Control;
use crate::propagate::monte_carlo::block::{Trials, Workspace};
use crate::propagate::monte_carlo::interval::Ranks;

/// One output's figures in one block of the procedure: estimate, standard uncertainty, ends.
pub(super) type Figures = [f64; FIGURES];

/// Trials in a block of which all values are held; of larger ones only the tails are.
const HELD: u64 = 1 << 17;

/// Values that are collected before the tails are cut back.
const FRESH: usize = 4096;

/// The figures of every output in some blocks of `size` trials.
pub(super) fn figures(
    trials: &Trials,
    numbers: std::ops::Range<u64>,
    size: u64,
    search: Search<'_>,
    control: &Control<'_>,
) -> Vec<Vec<Option<Figures>>> {
    let of_block = |workspace: &mut Workspace, number: u64| {
        let (first, last) = (number * size, (number + 1) * size);
        let empty = || Values::new(size, search.probability);
        let mut values: Vec<Values> = (0..trials.outputs()).map(|_| empty()).collect();
        for block in first / BLOCK as u64..last.div_ceil(BLOCK as u64) {
            if control.is_stopped() {
                break;
            }
            trials.block(control.path, block, workspace);
            let start = block * BLOCK as u64;
            let from = first.saturating_sub(start) as usize;
            let to = (last - start).min(BLOCK as u64) as usize;
            for trial in from..to {
                if workspace.outputs.iter().all(|output| output[trial].is_finite()) {
                    for (values, output) in values.iter_mut().zip(&workspace.outputs) {
                        values.push(output[trial]);
                    }
                }
            }
        }
        values.iter_mut().map(|values| values.figures(search.probability)).collect()
    };
    numbers.into_par_iter().map_init(|| trials.workspace(), of_block).collect()
}

/// The values of one output in a block.
#[derive(Debug)]
enum Values {
    All(Vec<f64>),
    Tails(Tails),
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
    fn new(size: u64, probability: f64) -> Self {
        if size <= HELD {
            return Self::All(Vec::with_capacity(size as usize));
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

    fn push(&mut self, value: f64) {
        match self {
            Self::All(values) => values.push(value),
            Self::Tails(tails) => tails.push(value),
        }
    }

    fn figures(&mut self, probability: f64) -> Option<Figures> {
        match self {
            Self::All(values) => of_all(values, probability),
            Self::Tails(tails) => tails.figures(probability),
        }
    }
}

fn of_all(values: &mut [f64], probability: f64) -> Option<Figures> {
    let count = values.len() as u64;
    let middle = *values.first()?;
    if count < 2 {
        return None;
    }
    let n = count as f64;
    let offset = values.iter().map(|v| v - middle).sum::<f64>() / n;
    let squares: f64 = values.iter().map(|v| (v - middle - offset).powi(2)).sum();
    let Ranks { q, r } = Ranks::new(count, probability);
    let (low, high) = (r as usize - 1, (r + q).min(count) as usize - 1);
    let (_, high_end, _) = values.select_nth_unstable_by(high, f64::total_cmp);
    let high_end = *high_end;
    let (_, low_end, _) = values.select_nth_unstable_by(low, f64::total_cmp);
    Some([middle + offset, (squares / (n - 1.0)).sqrt(), *low_end, high_end])
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

    /// The figures from sums and tails are those of all values: the ends exactly, mean and standard
    /// deviation to the rounding of their sums.
    #[test]
    fn tails_hold_the_ends() {
        // a full cycle of a linear congruence: every number below 2^18 once, far from zero
        let size = 1u64 << 18;
        let value = |i: u64| ((i * 5 * 4001 + 12_345) % size) as f64 - 1e6;
        for (count, probability) in [(size, 0.9995), (size - 1000, 0.9999), (300_000 / 2, 0.99925)]
        {
            let (mut all, mut values) = (Vec::new(), Values::new(size, probability));
            for i in 0..count {
                all.push(value(i));
                values.push(value(i));
            }
            assert!(matches!(values, Values::Tails(_)));
            let (exact, found) =
                (of_all(&mut all, probability).unwrap(), values.figures(probability).unwrap());
            assert_eq!(exact[2..], found[2..]);
            assert!((exact[0] - found[0]).abs() < 1e-6, "{exact:?}, {found:?}");
            assert!((exact[1] / found[1] - 1.0).abs() < 1e-9, "{exact:?}, {found:?}");
        }
    }
}
