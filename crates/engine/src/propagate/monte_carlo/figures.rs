//! What a Monte Carlo run gives.

use super::adaptive::Adaptive;
use super::moments::Moments;

/// One output's figures from the trials.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MonteCarlo {
    /// Number of trials behind the figures.
    pub trials: u64,
    /// Mean of the trials.
    pub estimate: f64,
    /// Standard deviation of the trials; `None` if the distribution has none, or of a single trial.
    pub standard_uncertainty: Option<f64>,
    /// Median of the trials.
    pub median: f64,
    /// Probabilistically symmetric coverage interval.
    pub symmetric_interval: [f64; 2],
    /// Shortest coverage interval.
    pub shortest_interval: [f64; 2],
    /// Whether the shortest interval is exactly that of the trials.
    pub shortest_exact: bool,
    /// Skewness; `None` if the distribution has none, or if all trials are equal.
    pub skewness: Option<f64>,
    /// Excess kurtosis; `None` as for the skewness.
    pub excess_kurtosis: Option<f64>,
    /// Numerical standard errors.
    pub errors: NumericalError,
    /// Share of the trials within the output's tolerance limits; 1 where it has none.
    pub inside: f64,
    /// How the adaptive procedure ended, if the number of trials was found by it.
    pub adaptive: Option<Adaptive>,
}

/// How far the finite number of trials lets each figure scatter: one standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NumericalError {
    /// Of the estimate; `None` if the distribution has no standard deviation.
    pub estimate: Option<f64>,
    /// Of the standard uncertainty; `None` if the distribution has no fourth moment.
    pub standard_uncertainty: Option<f64>,
    /// Of the median; NaN with two trials.
    pub median: f64,
    /// Of the ends of the symmetric interval; NaN where they are the least and the greatest
    /// trial, because there are too few.
    pub symmetric_interval: [f64; 2],
    /// Of the ends of the shortest interval, which settles only with the cube root of the trials;
    /// NaN with too few trials to tell.
    pub shortest_interval: [f64; 2],
    /// Of the skewness; `None` if there is none, or with too few trials to tell.
    pub skewness: Option<f64>,
    /// Of the excess kurtosis; `None` as for the skewness.
    pub excess_kurtosis: Option<f64>,
}

/// Trials whose outputs were not all finite.
#[derive(Clone, Debug, PartialEq)]
pub struct Undefined {
    /// How many there were.
    pub count: u64,
    /// Out of how many.
    pub trials: u64,
    /// The drawn values of the varying inputs in the first such trial, in order.
    pub first: Vec<f64>,
}

/// What a run of one row gives.
#[derive(Clone, Debug)]
pub(crate) struct Finished {
    /// Trials behind the figures.
    pub(crate) trials: u64,
    /// One entry for each output.
    pub outputs: Vec<MonteCarlo>,
    /// Correlation coefficients of the outputs i < j.
    pub(crate) correlations: Vec<f64>,
    /// Trials that were left out.
    pub(crate) undefined: Option<Undefined>,
    /// Whether the run was stopped early.
    pub(crate) stopped: bool,
}

impl MonteCarlo {
    /// The figures, without the moments that do not exist for t distributions of `drawn_dof`
    /// degrees of freedom. The intervals are the symmetric one, the shortest one and whether that
    /// is exact.
    pub(super) fn new(
        moments: &Moments,
        drawn_dof: f64,
        median: f64,
        intervals: ([f64; 2], [f64; 2], bool),
        errors: NumericalError,
    ) -> Self {
        let spread = moments.std > 0.0;
        // a single trial does not scatter
        let several = moments.trials > 1.0;
        Self {
            trials: moments.trials as u64,
            estimate: moments.mean,
            standard_uncertainty: (drawn_dof > 2.0 && several).then_some(moments.std),
            median,
            symmetric_interval: intervals.0,
            shortest_interval: intervals.1,
            shortest_exact: intervals.2,
            inside: moments.inside,
            adaptive: None,
            skewness: (drawn_dof > 3.0 && spread).then_some(moments.skewness),
            excess_kurtosis: (drawn_dof > 4.0 && spread).then_some(moments.excess_kurtosis),
            errors,
        }
    }
}

impl NumericalError {
    /// The errors, `quantiles` being those of the lower end, the upper end and the median.
    pub(super) fn new(
        moments: &Moments,
        drawn_dof: f64,
        quantiles: [f64; 3],
        shortest_interval: [f64; 2],
    ) -> Self {
        let [low, high, median] = quantiles;
        let shape = |order: f64, which: usize| {
            let exists = drawn_dof > order && moments.std > 0.0;
            moments.shape_errors.filter(|_| exists).map(|errors| errors[which])
        };
        let several = moments.trials > 1.0;
        Self {
            estimate: (drawn_dof > 2.0 && several).then(|| moments.mean_error()),
            standard_uncertainty: (drawn_dof > 4.0 && several).then(|| moments.std_error()),
            median,
            symmetric_interval: [low, high],
            shortest_interval,
            // the variance of the third moment is of sixth order, that of the fourth of eighth
            skewness: shape(6.0, 0),
            excess_kurtosis: shape(8.0, 1),
        }
    }
}
