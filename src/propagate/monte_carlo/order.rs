//! Order statistics of all trials from the values that were kept.

use super::windows::Windows;

/// The kept values in order, and which ranks they have among all trials.
#[derive(Clone, Debug)]
pub(crate) struct Order {
    /// Number of all trials.
    pub(crate) trials: u64,
    sorted: Vec<f64>,
    /// Runs of kept values: first rank (from 1), place in `sorted`, length.
    runs: Vec<Run>,
}

#[derive(Clone, Copy, Debug)]
struct Run {
    rank: u64,
    place: usize,
    length: usize,
}

impl Order {
    /// From all values.
    #[cfg(test)]
    pub(crate) fn of_all(mut values: Vec<f64>) -> Self {
        values.sort_unstable_by(f64::total_cmp);
        Self::new(values.len() as u64, values, 0, &Windows::ALL)
    }

    /// From the sorted values that `windows` keeps of `trials` many trials, of which
    /// `below_median` lie below the window about the median.
    pub(crate) fn new(trials: u64, sorted: Vec<f64>, below_median: u64, windows: &Windows) -> Self {
        let length = sorted.len();
        let runs = if windows.keep_all() {
            vec![Run { rank: 1, place: 0, length }]
        } else {
            let low = sorted.partition_point(|&v| v <= windows.low);
            let median = sorted.partition_point(|&v| v < windows.high);
            vec![
                Run { rank: 1, place: 0, length: low },
                Run { rank: below_median + 1, place: low, length: median - low },
                Run {
                    rank: (trials + 1).saturating_sub((length - median) as u64),
                    place: median,
                    length: length - median,
                },
            ]
        };
        Self { trials, sorted, runs }
    }

    /// The order statistic of rank `rank`, counted from 1; `None` if it was not kept.
    pub(crate) fn get(&self, rank: u64) -> Option<f64> {
        self.runs.iter().find_map(|run| {
            let offset = rank.checked_sub(run.rank)? as usize;
            if offset < run.length { self.sorted.get(run.place + offset).copied() } else { None }
        })
    }

    /// The order statistics of `length` many ranks from `rank` on; `None` if some were not kept.
    pub(crate) fn slice(&self, rank: u64, length: u64) -> Option<&[f64]> {
        self.runs.iter().find_map(|run| {
            let offset = rank.checked_sub(run.rank)? as usize;
            let end = offset.checked_add(usize::try_from(length).ok()?)?;
            if end <= run.length {
                self.sorted.get(run.place + offset..run.place + end)
            } else {
                None
            }
        })
    }

    /// The kept values, sorted.
    pub(crate) fn into_sorted(self) -> Vec<f64> {
        self.sorted
    }

    /// The median: the middle value, or the mean of the two middle ones.
    pub(crate) fn median(&self) -> Option<f64> {
        let (lower, upper) = (self.get(self.trials.div_ceil(2))?, self.get(self.trials / 2 + 1)?);
        Some(if lower == upper { lower } else { 0.5 * lower + 0.5 * upper })
    }
}
