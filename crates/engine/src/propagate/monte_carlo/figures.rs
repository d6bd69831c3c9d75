//! What a Monte Carlo run gives.

use super::moments::Moments;
use crate::number::elementary;
use crate::task::StoppingRule;

/// How an adaptive run ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adaptive {
    /// The rule that stopped it.
    pub rule: StoppingRule,
    /// Trials in a block of the procedure: max(J, 10^4), J the least integer not below 100/(1 - p).
    pub block_trials: u64,
    /// Number of blocks; 0 if the largest number of trials is not even two blocks.
    pub blocks: u64,
    /// Numerical tolerance of the output's figures.
    pub tolerance: f64,
    /// Whether the rule was satisfied before the largest number of trials.
    pub converged: bool,
}

/// One output's figures from the trials.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MonteCarlo {
    /// Number of trials behind the figures.
    pub trials: u64,
    /// Mean of the trials; `None` if the distribution has no expectation: that of a t with one degree
    /// of freedom, or fewer, has none (JCGM 101, 6.4.9.4), nor has the exponential of one; or perhaps
    /// none ([`MonteCarlo::heavy_tailed`]).
    pub estimate: Option<f64>,
    /// Standard deviation of the trials; `None` if the distribution has none, or perhaps none, or of a
    /// single trial.
    pub standard_uncertainty: Option<f64>,
    /// Median of the trials.
    pub median: f64,
    /// Probabilistically symmetric coverage interval.
    pub symmetric_interval: [f64; 2],
    /// Shortest coverage interval.
    pub shortest_interval: [f64; 2],
    /// Whether the shortest interval is exactly that of the trials.
    pub shortest_exact: bool,
    /// Whether there is one shortest interval: where the density is flat, or rises to both limits,
    /// many intervals are equally short, and the trials choose among them by chance.
    pub shortest_unique: bool,
    /// Whether a few trials carry the sum of squares, so that expectation and standard deviation may
    /// not exist (JCGM 101, 3.6, note 1): their trials then say nothing of how far they scatter.
    pub heavy_tailed: bool,
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
    /// Of the estimate; `None` if the distribution has no standard deviation, or perhaps none
    /// ([`MonteCarlo::heavy_tailed`]).
    pub estimate: Option<f64>,
    /// Of the standard uncertainty; `None` if the distribution has no fourth moment, or perhaps no
    /// standard deviation.
    pub standard_uncertainty: Option<f64>,
    /// Of the median; NaN with two trials.
    pub median: f64,
    /// Of the ends of the symmetric interval; NaN where they are the least and the greatest
    /// trial, because there are too few.
    pub symmetric_interval: [f64; 2],
    /// Of the ends of the shortest interval, which mostly settles only with the cube root of the
    /// trials; NaN with too few trials to tell, and where there is no one shortest interval.
    pub shortest_interval: [f64; 2],
    /// Of the skewness; `None` if there is none, or where the trials do not tell: where they are too
    /// few, or a few of them carry it.
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

/// The coverage intervals of the trials.
#[derive(Clone, Copy, Debug)]
pub(super) struct Intervals {
    pub(super) symmetric: [f64; 2],
    pub(super) shortest: [f64; 2],
    /// Whether the shortest one is exactly that of the trials.
    pub(super) exact: bool,
    /// Whether there is one such interval.
    pub(super) unique: bool,
}

/// The share of a standard uncertainty that its numerical standard error has where a few trials carry
/// the sum of squares: the excess kurtosis is then above a hundredth of the number of trials.
const HEAVY: f64 = 0.01;

/// An excess kurtosis up to this is one of ordinary distributions, however few the trials.
const ORDINARY: f64 = 30.0;

/// The share of the sum of squares from which on the farthest trial carries it with few others; the
/// trials in which a rare event happens are as many as it says, and all as far.
const OF_FARTHEST: f64 = 0.05;

/// Whether a few trials carry the sum of squares, though a kurtosis should exist. The farthest trial has
/// at most the share sqrt(kurtosis/trials) of it, and one that has the share s brings the kurtosis to
/// s^2 trials. `extremes` are the least and the greatest trial.
fn is_heavy(moments: &Moments, moment_order: f64, extremes: [f64; 2]) -> bool {
    let share = farthest(moments, extremes).powi(2) / moments.trials;
    moment_order > 4.0
        && moments.excess_kurtosis > f64::max(HEAVY * moments.trials, ORDINARY)
        && share > OF_FARTHEST
}

/// How many standard deviations the farthest trial lies from the mean.
fn farthest(moments: &Moments, extremes: [f64; 2]) -> f64 {
    let away = extremes.map(|x| (x - moments.mean).abs() / moments.std);
    away[0].max(away[1])
}

/// The shares of the sums of third and of fourth powers from which on the farthest trial has too much
/// of them: then others that far out, of which the trials have none, would change the figure by more
/// than its scatter between parts of the trials tells.
const TOO_FAR: [f64; 2] = [0.02, 0.04];

/// Whether the trials tell how far skewness and excess kurtosis scatter; `extremes` are the least and
/// the greatest trial.
fn tells_shape(moments: &Moments, extremes: [f64; 2]) -> [bool; 2] {
    let Moments { trials, skewness, excess_kurtosis, .. } = *moments;
    let farthest = farthest(moments, extremes);
    let cube = farthest.powi(3);
    // of a normal distribution the mean cube without its sign
    let cubes = trials * skewness.abs().max(1.6);
    let fourths = trials * (excess_kurtosis + 3.0);
    // few trials have a farthest one with a large share
    let least = 1000.0 / trials;
    let [third, fourth] = TOO_FAR.map(|share| share.max(least));
    [cube <= third * cubes, cube * farthest <= fourth * fourths]
}

/// What a run of one row gives.
#[derive(Clone, Debug, Default)]
pub(crate) struct Finished {
    /// Trials behind the figures.
    pub(crate) trials: u64,
    /// One entry for each output.
    pub outputs: Vec<MonteCarlo>,
    /// Correlation coefficients of the outputs i < j.
    pub(crate) correlations: Vec<f64>,
    /// Their numerical standard errors, where they can be told.
    pub(crate) correlation_errors: Vec<Option<f64>>,
    /// Trials that were left out.
    pub(crate) undefined: Option<Undefined>,
    /// Whether the run was stopped early.
    pub(crate) stopped: bool,
}

impl MonteCarlo {
    /// The figures, without the moments of `moment_order` and above, which do not exist; `extremes` are
    /// the least and the greatest trial.
    pub(super) fn new(
        moments: &Moments,
        extremes: [f64; 2],
        moment_order: f64,
        median: f64,
        intervals: Intervals,
        errors: NumericalError,
    ) -> Self {
        let spread = moments.std > 0.0;
        // a single trial does not scatter
        let several = moments.trials > 1.0;
        let heavy_tailed = is_heavy(moments, moment_order, extremes);
        let exists = |order: f64| moment_order > order && !heavy_tailed;
        Self {
            trials: moments.trials as u64,
            estimate: exists(1.0).then_some(moments.mean),
            standard_uncertainty: (exists(2.0) && several).then_some(moments.std),
            median,
            symmetric_interval: intervals.symmetric,
            shortest_interval: intervals.shortest,
            shortest_exact: intervals.exact,
            shortest_unique: intervals.unique,
            heavy_tailed,
            inside: moments.inside,
            adaptive: None,
            skewness: (exists(3.0) && spread).then_some(moments.skewness),
            excess_kurtosis: (exists(4.0) && spread).then_some(moments.excess_kurtosis),
            errors,
        }
    }
}

/// The coverage interval of the trials that is to be stated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StatedInterval {
    /// Its ends.
    pub ends: [f64; 2],
    /// Their numerical standard errors; NaN where the trials do not tell.
    pub errors: [f64; 2],
    /// Whether it is the shortest interval, and not the probabilistically symmetric one.
    pub shortest: bool,
}

/// How many numerical standard errors longer than the shortest interval the symmetric one may be and
/// still count as the shortest: the shortest is the least of many that scatter by about one.
const AS_SHORT: f64 = 4.0;

impl MonteCarlo {
    /// The interval that is stated where one is: the shortest one where the output is so skew that
    /// the symmetric one is longer beyond its numerical error (JCGM 101, 5.3.5 and 9.4.3.2), else the
    /// symmetric one. So it is where the shortest one is one of many: the scatter of the trials would
    /// choose among them.
    pub fn stated_interval(&self) -> StatedInterval {
        let length = |[low, high]: [f64; 2]| high - low;
        let (symmetric, shortest) = (self.symmetric_interval, self.shortest_interval);
        let [low, high] = self.errors.symmetric_interval;
        let allowed = AS_SHORT * elementary::hypot(low, high);
        if self.shortest_unique && length(symmetric) - length(shortest) > allowed {
            let errors = self.errors.shortest_interval;
            StatedInterval { ends: shortest, errors, shortest: true }
        } else {
            let errors = self.errors.symmetric_interval;
            StatedInterval { ends: symmetric, errors, shortest: false }
        }
    }

    /// The figures of an output whose trials are all this value but for rounding.
    pub(in crate::propagate) fn settle(&mut self, value: f64) {
        let errors = NumericalError {
            estimate: self.errors.estimate.map(|_| 0.0),
            standard_uncertainty: self.errors.standard_uncertainty.map(|_| 0.0),
            median: 0.0,
            symmetric_interval: [0.0; 2],
            shortest_interval: [0.0; 2],
            skewness: None,
            excess_kurtosis: None,
        };
        self.estimate = self.estimate.map(|_| value);
        self.standard_uncertainty = self.standard_uncertainty.map(|_| 0.0);
        self.median = value;
        (self.symmetric_interval, self.shortest_interval) = ([value; 2], [value; 2]);
        (self.shortest_exact, self.shortest_unique, self.heavy_tailed) = (true, true, false);
        (self.skewness, self.excess_kurtosis, self.errors) = (None, None, errors);
    }

    /// Where the trials lie: their mean, or their median where they have no variance, so that their mean
    /// settles slowly, or never.
    pub fn location(&self) -> f64 {
        self.settled_mean().unwrap_or(self.median)
    }

    /// The mean of the trials where they have a variance.
    pub(in crate::propagate) fn settled_mean(&self) -> Option<f64> {
        self.estimate.filter(|_| self.standard_uncertainty.is_some())
    }
}

impl NumericalError {
    /// The errors, `quantiles` being those of the lower end, the upper end and the median, `extremes`
    /// the least and the greatest trial.
    pub(super) fn new(
        moments: &Moments,
        moment_order: f64,
        quantiles: [f64; 3],
        shortest_interval: [f64; 2],
        extremes: [f64; 2],
    ) -> Self {
        let [low, high, median] = quantiles;
        let heavy = is_heavy(moments, moment_order, extremes);
        let told = tells_shape(moments, extremes);
        let shape = |order: f64, which: usize| {
            let exists = moment_order > order && moments.std > 0.0 && !heavy && told[which];
            moments.shape_errors[which].filter(|_| exists)
        };
        let several = moments.trials > 1.0 && !heavy;
        Self {
            estimate: (moment_order > 2.0 && several).then(|| moments.mean_error()),
            standard_uncertainty: (moment_order > 4.0 && several).then(|| moments.std_error()),
            median,
            symmetric_interval: [low, high],
            shortest_interval,
            // the variance of the third moment is of sixth order, that of the fourth of eighth
            skewness: shape(6.0, 0),
            excess_kurtosis: shape(8.0, 1),
        }
    }
}

/// The errors of correlation coefficients, without those of outputs that have no fourth moment or
/// perhaps no standard deviation.
pub(super) fn of_moments(errors: Vec<Option<f64>>, outputs: &[MonteCarlo]) -> Vec<Option<f64>> {
    let scatters = |i: usize| {
        outputs.get(i).is_some_and(|figures| figures.errors.standard_uncertainty.is_some())
    };
    let count = outputs.len();
    let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j)));
    let known = pairs.map(|(i, j)| scatters(i) && scatters(j));
    errors.into_iter().zip(known).map(|(error, known)| error.filter(|_| known)).collect()
}
