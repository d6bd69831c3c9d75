//! Order statistics of all trials from the values that were kept.

use super::bucket_partition::BucketPartition;
use super::windows::Windows;
use crate::number::CodePath;

/// The kept values, and which ranks they have among all trials.
#[derive(Clone, Debug)]
pub(crate) struct Order {
    /// Number of all trials.
    pub(crate) trials: u64,
    buckets: BucketPartition,
    /// Runs of kept values: first rank (from 1), index among the kept ones, length.
    runs: Vec<OrderedRun>,
}

#[derive(Clone, Copy, Debug)]
struct OrderedRun {
    rank: u64,
    index: usize,
    length: usize,
}

impl Order {
    /// From all values.
    #[cfg(test)]
    pub(crate) fn of_all(values: Vec<f64>) -> Self {
        Self::new(CodePath::best(), values.len() as u64, &[&values], 0, &Windows::ALL)
    }

    /// From the values that `windows` keeps of `trials` many trials, in any order and any number of
    /// parts; `below_median` of the trials lie below the window about the median.
    pub(super) fn new(
        path: CodePath,
        trials: u64,
        kept: &[&[f64]],
        below_median: u64,
        windows: &Windows,
    ) -> Self {
        let buckets = BucketPartition::new(path, kept, windows);
        let [low, median, high] = buckets.regions();
        let run = |rank: u64, index: usize, length: usize| OrderedRun { rank, index, length };
        let runs = if windows.keep_all() {
            vec![run(1, 0, low + median + high)]
        } else {
            vec![
                run(1, 0, low),
                run(below_median + 1, low, median),
                run((trials + 1).saturating_sub(high as u64), low + median, high),
            ]
        };
        Self { trials, buckets, runs }
    }

    /// The index of a rank among the kept values, and how many ranks from it on are kept.
    fn index_of(&self, rank: u64) -> Option<(usize, usize)> {
        self.runs.iter().find_map(|run| {
            let offset = rank.checked_sub(run.rank)? as usize;
            (offset < run.length).then(|| (run.index + offset, run.length - offset))
        })
    }

    /// The order statistic of rank `rank`, counted from 1; `None` if it was not kept.
    pub(crate) fn get(&mut self, rank: u64) -> Option<f64> {
        let (index, _) = self.index_of(rank)?;
        Some(self.buckets.at(index))
    }

    /// The median: the middle value, or the mean of the two middle ones.
    pub(crate) fn median(&mut self) -> Option<f64> {
        let (lower, upper) = (self.get(self.trials.div_ceil(2))?, self.get(self.trials / 2 + 1)?);
        Some(if lower == upper { lower } else { 0.5 * lower + 0.5 * upper })
    }

    /// The least y(r + q) - y(r) over the ranks r from 1 to `count`, and its ends; of equally short
    /// ones that with r nearest to `middle`; and that r. `None` if an order statistic was not kept.
    pub(crate) fn closest(&mut self, q: u64, count: u64, middle: u64) -> Option<([f64; 2], u64)> {
        let length = usize::try_from(count).ok()?;
        let (low, low_length) = self.index_of(1)?;
        let (high, high_length) = self.index_of(q + 1)?;
        if low_length < length || high_length < length {
            return None;
        }
        let middle = middle.saturating_sub(1) as usize;
        let (ends, index) = self.buckets.closest(low, high, length, middle)?;
        Some((ends, index as u64 + 1))
    }
}
