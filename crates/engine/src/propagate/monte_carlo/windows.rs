//! Which values can matter: the tails that hold the ends of every coverage interval, and a window
//! about the median. Everything between is only counted.

/// What is kept of one output's values: those up to `low`, from `median_low` to `median_high`, and
/// from `high` on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Windows {
    pub(crate) low: f64,
    pub(crate) median_low: f64,
    pub(crate) median_high: f64,
    pub(crate) high: f64,
    /// The least and the greatest value of the pilot.
    pub(crate) ends: [f64; 2],
}

/// How many standard deviations of a rank the windows are wider than they need to be on average.
/// A tail falls short once in 3e5 runs; the run is then repeated with `ALL`.
const MARGIN: f64 = 4.5;

impl Windows {
    /// Every value is kept.
    pub(crate) const ALL: Self = Self {
        low: f64::INFINITY,
        median_low: f64::NEG_INFINITY,
        median_high: f64::INFINITY,
        high: f64::NEG_INFINITY,
        ends: [f64::NEG_INFINITY, f64::INFINITY],
    };

    /// The windows for coverage probability `p`, from a pilot of `count` values, `nth` the value at an index in
    /// their order; their margins are times `widening`. The lower end of any interval of that content
    /// is one of the lowest 1 - p of the values, the upper end one of the highest.
    pub(crate) fn from_pilot(
        count: usize,
        mut nth: impl FnMut(usize) -> Option<f64>,
        p: f64,
        widening: f64,
    ) -> Self {
        let n = count as f64;
        let mut at = |share: f64, margin: f64| {
            let rank = share * n
                + margin * widening * MARGIN * (n * share * (1.0 - share)).sqrt()
                + 2.0 * margin;
            let index = rank.round();
            if index < 0.0 || index >= n { None } else { nth(index as usize) }
        };
        let [low, high] = [at(1.0 - p, 1.0), at(p, -1.0)];
        let [median_low, median_high] = [at(0.5, -1.0), at(0.5, 1.0)];
        let ends = nth(0).zip(nth(count.saturating_sub(1)));
        let windows = low.zip(high).zip(median_low.zip(median_high)).zip(ends);
        let windows = windows.map(|(((low, high), (median_low, median_high)), (least, most))| {
            Self { low, median_low, median_high, high, ends: [least, most] }
        });
        match windows {
            Some(w) if w.low < w.median_low && w.median_high < w.high => w,
            _ => Self::ALL,
        }
    }

    /// Windows that keep what either of two keeps.
    pub(crate) fn joined(&self, other: &Self) -> Self {
        if self.keep_all() || other.keep_all() {
            return Self::ALL;
        }
        let [[a, b], [c, d]] = [self.ends, other.ends];
        Self {
            low: self.low.max(other.low),
            median_low: self.median_low.min(other.median_low),
            median_high: self.median_high.max(other.median_high),
            high: self.high.min(other.high),
            ends: [a.min(c), b.max(d)],
        }
    }

    /// Whether all values are kept that other windows keep.
    pub(crate) fn cover(&self, other: &Self) -> bool {
        self.low >= other.low
            && self.median_low <= other.median_low
            && self.median_high >= other.median_high
            && self.high <= other.high
    }

    /// Whether all values are kept.
    pub(crate) fn keep_all(&self) -> bool {
        self.low == f64::INFINITY
    }

    /// Whether a value is kept.
    #[inline(always)]
    pub(crate) fn keeps(&self, value: f64) -> bool {
        (value <= self.low)
            | ((value >= self.median_low) & (value <= self.median_high))
            | (value >= self.high)
    }
}
