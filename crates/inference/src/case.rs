//! A case of the gap diagnosis: a model, what was measured, and the effects that may be missing.

use std::sync::Arc;

use crate::{Effect, History, OverridableModel, OverrideError, Replication, SimulatorModel};
use gumption_engine::distribution::Distribution;
use gumption_engine::model::Program;
use gumption_engine::task::{Coverage, Task};
use gumption_units::Unit;

/// A model with measured data and candidate effects.
#[derive(Clone, Debug)]
pub struct Case {
    /// The model at the conditions of every row of the data.
    pub task: Task,
    /// The model in a form that effects can override.
    pub model: OverridableModel,
    /// What was measured of each output of the model, in the order of the outputs; `None` where an
    /// output was not observed.
    pub observed: Vec<Option<ObservedOutput>>,
    /// How many of the last conditions are columns of somebody else's simulation rather than
    /// conditions of the measurement. Of a case with a simulator they are its outputs and the number of
    /// the row.
    pub simulated: usize,
    /// The simulator that the model is; `None` of formulas and typed models.
    pub simulator: Option<Arc<SimulatorModel>>,
    /// The conditions before those that follow from the order of the rows, in their places.
    pub history: Vec<History>,
    /// Between which values each condition can be set, in its unit; `None` where that is not known,
    /// or none at all, so that measurements are proposed among the values of the data.
    pub reachable: Vec<Option<[f64; 2]>>,
    /// The candidate effects.
    pub candidates: Vec<Candidate>,
    /// Effects that ship with the program, can act on the model and are not among the candidates; they
    /// are tried where no candidate explains the data.
    pub shipped: Vec<Candidate>,
    /// Which rows belong to one device or day; see [`Case::replicated`].
    pub replication: Option<Replication>,
    /// The prior probabilities.
    pub prior: Prior,
}

/// Measured values of one output, a row of the data each, in the output's unit.
#[derive(Clone, Debug, PartialEq)]
pub struct ObservedOutput {
    /// The values.
    pub values: Vec<f64>,
    /// The power of ten of the last digit that any of them is written with, zeros at its end included: -2
    /// of `0.20`. `None` where it is not known.
    pub last_digit: Option<i32>,
    /// Their standard uncertainties; without them the noise is estimated from the data.
    pub standard_uncertainties: Option<Vec<f64>>,
    /// Standard uncertainties of somebody else's simulation of the same rows.
    pub simulation_uncertainties: Option<Vec<f64>>,
    /// Covariance matrix of somebody else's simulation of the same rows.
    pub simulation_covariance: Option<Vec<Vec<f64>>>,
}

/// An effect with what is known of its parameters beforehand.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The effect.
    pub effect: Effect,
    /// The prior distribution of each parameter, in its unit.
    pub priors: Vec<Distribution>,
    /// What it is, in words.
    pub about: String,
    /// Where it comes from.
    pub source: String,
    /// Which effect of the case's simulator it is, if the simulator can do it by itself.
    pub simulator: Option<usize>,
}

/// Prior probabilities; they sum to one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prior {
    /// No gap.
    pub none: f64,
    /// One effect, shared equally among them.
    pub one: f64,
    /// Two effects, shared equally among the pairs.
    pub two: f64,
    /// Three effects, shared equally among the triples.
    pub three: f64,
    /// A gap that no candidate makes.
    pub unexplained: f64,
}

impl Case {
    /// Coverage probability of the intervals of its answer.
    pub fn coverage_probability(&self) -> f64 {
        match self.task.settings.coverage {
            Coverage::Usual => 0.95,
            stated => stated.probability(),
        }
    }

    /// Checks the data and the priors, and that every effect, and every pair that is among the
    /// hypotheses, can act on the model.
    ///
    /// # Errors
    /// Of the first that cannot.
    pub fn check(&self) -> Result<(), OverrideError> {
        self.check_data()?;
        self.recorded(&[])?;
        for one in 0..self.candidates.len() {
            self.recorded(&[one])?;
        }
        if self.prior.two > 0.0 {
            self.pairs().iter().try_for_each(|pair| self.recorded(pair).map(|_| ()))?;
        }
        Ok(())
    }

    /// The same with other priors of the listed parameters, of two effects at most: more wide ones
    /// together would explain anything.
    pub(crate) fn with_priors(&self, other: impl Fn(&Distribution, &Unit) -> Distribution) -> Self {
        let mut case = self.clone();
        case.prior = Prior { three: 0.0, ..case.prior };
        for place in 0..case.candidates.len() {
            // a simulator was run within the priors as they are stated
            if case.candidates[place].simulator.is_some() {
                continue;
            }
            let listed = self.listed_parameters(place);
            let candidate = &mut case.candidates[place];
            let priors = candidate.priors.iter_mut().zip(&candidate.effect.parameters);
            for (prior, parameter) in priors.take(listed) {
                *prior = other(prior, &parameter.unit);
            }
        }
        case
    }

    fn recorded(&self, effects: &[usize]) -> Result<Program, OverrideError> {
        let acting: Vec<&Effect> = effects.iter().map(|&e| &self.candidates[e].effect).collect();
        self.model.program(&acting)
    }

    /// The program with these effects acting, of a case that was checked.
    #[expect(clippy::expect_used, reason = "hypotheses have the effects that `check` tried")]
    pub fn program(&self, effects: &[usize]) -> Program {
        self.recorded(effects).expect("effects that were checked")
    }
}

impl Prior {
    /// The prior of a file that says nothing of it.
    pub const DEFAULT: Self =
        Self { none: 0.15, one: 0.55, two: 0.15, three: 0.0, unexplained: 0.15 };

    /// Whether a hypothesis has a probability above 0 where there are so many effects: three of them
    /// cannot act together where there are two.
    ///
    /// ```
    /// let prior = gumption_inference::Prior { none: 0.0, one: 0.0, two: 1.0, three: 0.0, unexplained: 0.0 };
    /// assert!(prior.is_possible(2) && !prior.is_possible(1));
    /// ```
    pub fn is_possible(&self, effects: usize) -> bool {
        let Self { none, one, two, three, unexplained } = *self;
        let least = [(none, 0), (unexplained, 0), (one, 1), (two, 2), (three, 3)];
        least.iter().any(|&(share, least)| share > 0.0 && effects >= least)
    }
}
