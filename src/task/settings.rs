//! How an evaluation is to be done.

use super::Coverage;

/// How many Monte Carlo trials to make.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trials {
    /// This many; 0 for an evaluation by the law of propagation alone.
    Fixed(u64),
    /// As many as the figures need to be stable to [`Settings::digits`] (JCGM 101, 7.9).
    Adaptive,
}

/// The settings of an evaluation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Coverage probability or factor.
    pub coverage: Coverage,
    /// Monte Carlo trials.
    pub trials: Trials,
    /// The largest number of trials of an adaptive run.
    pub max_trials: u64,
    /// Whether an adaptive run goes to a fifth of the tolerance, as the validation of the GUM
    /// interval asks (JCGM 101, 8.2).
    pub for_validation: bool,
    /// Seed of the random streams.
    pub seed: u64,
    /// Significant digits of the standard uncertainty that are held meaningful (JCGM 101, 7.9.2).
    pub digits: u32,
    /// Whether the coverage factor is taken at the real number of effective degrees of freedom
    /// instead of its integer part (JCGM 100, G.4.1).
    pub real_dof: bool,
    /// Share of trials that may be undefined (not finite).
    pub allowed_undefined: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            coverage: Coverage::Probability(0.95),
            trials: Trials::Fixed(1_000_000),
            max_trials: 1_000_000_000,
            for_validation: false,
            seed: 1,
            digits: 2,
            real_dof: false,
            allowed_undefined: 0.0,
        }
    }
}
