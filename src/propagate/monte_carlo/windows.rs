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

    /// The windows for coverage probability `p`, from a sorted pilot, their margins times
    /// `widening`. The lower end of any interval
    /// of that content is one of the lowest 1 - p of the values, the upper end one of the highest.
    pub(crate) fn from_pilot(sorted: &[f64], p: f64, widening: f64) -> Self {
        let n = sorted.len() as f64;
        let at = |share: f64, margin: f64| {
            let rank = share * n
                + margin * widening * MARGIN * (n * share * (1.0 - share)).sqrt()
                + 2.0 * margin;
            let place = rank.round();
            if place < 0.0 || place >= n { None } else { sorted.get(place as usize).copied() }
        };
        let windows = (|| {
            Some(Self {
                low: at(1.0 - p, 1.0)?,
                median_low: at(0.5, -1.0)?,
                median_high: at(0.5, 1.0)?,
                high: at(p, -1.0)?,
                ends: [*sorted.first()?, *sorted.last()?],
            })
        })();
        match windows {
            Some(w) if w.low < w.median_low && w.median_high < w.high => w,
            _ => Self::ALL,
        }
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
