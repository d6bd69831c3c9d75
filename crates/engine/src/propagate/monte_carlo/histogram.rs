//! How the trials of each output are spread, for pictures. The trials are generated again and only
//! counted, so that a run without a picture costs nothing and the figures of a run with one are the
//! same bits.

use crate::number::ascending;
use rayon::prelude::*;

use super::accumulate::drop_undefined;
use super::block::{RowTrials, Workspace};
use super::repeat::collected;
use super::request::trials_in;
use crate::distribution::BLOCK;
use crate::propagate::Control;

/// Trials that are counted, at most: more change no picture.
const MOST_TRIALS: u64 = 10_000_000;

/// Blocks from which the range of a histogram is taken.
const PILOT_BLOCKS: u64 = 16;

/// Share of the pilot's trials beyond each end of that range before it is widened.
const TAIL: f64 = 0.0005;

/// By how much the range is widened on each side.
const MARGIN: f64 = 0.08;

/// Blocks that a thread counts at a time.
const CHUNK: u64 = 64;

/// The number of bins.
const BINS: usize = 80;

/// Counts of trials in bins of equal width, in the unit of the output.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    /// The lower end of the first bin.
    pub low: f64,
    /// Width of a bin, above zero.
    pub width: f64,
    /// Trials in each bin.
    pub counts: Vec<u64>,
    /// Trials below the first bin and above the last one.
    pub beyond: [u64; 2],
}

impl Histogram {
    /// Bins that cover a range; `None` where it has no width.
    fn over([low, high]: [f64; 2]) -> Option<Self> {
        let width = (high - low) / BINS as f64;
        // bins must be told apart in double precision
        let least = 4.0 * f64::EPSILON * low.abs().max(high.abs());
        let usable = width.is_finite() && width > least && (1.0 / width).is_finite();
        usable.then(|| Self { low, width, counts: vec![0; BINS], beyond: [0; 2] })
    }

    /// The upper end of the last bin.
    pub fn high(&self) -> f64 {
        self.low + self.width * self.counts.len() as f64
    }

    /// How many trials were counted.
    pub fn trials(&self) -> u64 {
        self.counts.iter().chain(&self.beyond).sum()
    }

    /// Density of each bin: its share of the trials over its width.
    pub fn densities(&self) -> impl Iterator<Item = f64> + '_ {
        let whole = self.trials().max(1) as f64 * self.width;
        self.counts.iter().map(move |&count| count as f64 / whole)
    }

    fn add(&mut self, values: &[f64]) {
        let (low, inverse) = (self.low, 1.0 / self.width);
        for value in values {
            let position = (value - low) * inverse;
            match self.counts.get_mut(position as usize) {
                _ if position < 0.0 => self.beyond[0] += 1,
                Some(count) => *count += 1,
                None => self.beyond[1] += 1,
            }
        }
    }

    /// Sums of counts do not depend on their order.
    fn merge(&mut self, other: &Self) {
        for (count, more) in self.counts.iter_mut().zip(&other.counts) {
            *count += more;
        }
        for (count, more) in self.beyond.iter_mut().zip(other.beyond) {
            *count += more;
        }
    }
}

/// The histograms of all outputs over the first `count` trials, or as many of them as a picture
/// needs; `None` for an output that does not vary, and nothing at all if the run is stopped. Each
/// shows at least its entry of `shown`, a range of values.
pub(crate) fn histograms(
    trials: &RowTrials,
    count: u64,
    shown: &[Option<[f64; 2]>],
    control: &Control<'_>,
) -> Option<Vec<Option<Histogram>>> {
    let count = count.min(MOST_TRIALS);
    let empty: Vec<Option<Histogram>> = ranges(trials, count, control)?
        .into_iter()
        .zip(shown)
        .map(|(range, shown)| Histogram::over(widened(range?, *shown)))
        .collect();
    let blocks = count.div_ceil(BLOCK as u64);
    let count_chunk = |workspace: &mut Workspace, chunk: u64| {
        let mut counted = empty.clone();
        for block in chunk * CHUNK..((chunk + 1) * CHUNK).min(blocks) {
            if control.is_stopped() {
                break;
            }
            trials.block(control.path, block, workspace);
            let (left, _) =
                drop_undefined(control.path, &mut workspace.outputs, trials_in(block, count));
            for (histogram, values) in counted.iter_mut().zip(&workspace.outputs) {
                if let Some(histogram) = histogram {
                    histogram.add(&values[..left]);
                }
            }
        }
        counted
    };
    let merge = |mut all: Vec<Option<Histogram>>, part: Vec<Option<Histogram>>| {
        for (histogram, more) in all.iter_mut().zip(&part) {
            if let Some((histogram, more)) = histogram.as_mut().zip(more.as_ref()) {
                histogram.merge(more);
            }
        }
        all
    };
    let counted = (0..blocks.div_ceil(CHUNK))
        .into_par_iter()
        .map_init(|| trials.workspace(), count_chunk)
        .reduce(|| empty.clone(), merge);
    (!control.is_stopped()).then_some(counted)
}

/// For each output the range of nearly all of its first trials, `None` where they are all equal.
fn ranges(trials: &RowTrials, count: u64, control: &Control<'_>) -> Option<Vec<Option<[f64; 2]>>> {
    let pilot = collected(trials, count.min(PILOT_BLOCKS * BLOCK as u64), control)?;
    let range = |mut values: Vec<f64>| {
        ascending(&mut values);
        let last = values.len().checked_sub(1)?;
        let tail = (TAIL * last as f64) as usize;
        let (low, high) = (values[tail], values[last - tail]);
        (low < high).then_some([low, high])
    };
    Some(pilot.into_iter().map(range).collect())
}

/// A range that also shows what else is to be seen, with some room.
fn widened([low, high]: [f64; 2], shown: Option<[f64; 2]>) -> [f64; 2] {
    let [low, high] = match shown {
        Some([from, to]) if from.is_finite() && to.is_finite() => [low.min(from), high.max(to)],
        _ => [low, high],
    };
    let room = MARGIN * (high - low);
    [low - room, high + room]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_is_counted_once() {
        let mut histogram = Histogram::over([0.0, 8.0]).unwrap();
        histogram.add(&[-1e300, -1e-9, 0.0, 0.05, 0.1, 7.95, 8.0, 1e300]);
        assert_eq!(histogram.beyond, [2, 2]);
        assert_eq!((histogram.counts[0], histogram.counts[1], histogram.counts[79]), (2, 1, 1));
        assert_eq!(histogram.trials(), 8);
        let inside: f64 = histogram.densities().map(|density| density * histogram.width).sum();
        assert!((inside - 0.5).abs() < 1e-12);
    }

    #[test]
    fn what_cannot_be_divided_has_no_bins() {
        assert_eq!(Histogram::over([1.0, 1.0]), None);
        assert_eq!(Histogram::over([1.0, 1.0 + 1e-15]), None);
        assert_eq!(Histogram::over([-f64::MAX, f64::MAX]), None);
        assert_eq!(Histogram::over([0.0, f64::from_bits(1)]), None);
    }
}
