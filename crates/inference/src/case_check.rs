//! Whether a case can be diagnosed at all: as many data as rows, numbers that are numbers, priors.

use gumption_engine::task::Row;

use super::case::{Candidate, Case, ObservedOutput, Prior};
use super::model::OverrideError;

impl Case {
    /// Checks data, priors and rows, which may have been set by hand.
    ///
    /// # Errors
    /// [`OverrideError::Case`] with the first thing that is wrong.
    pub(crate) fn check_data(&self) -> Result<(), OverrideError> {
        self.task.check().map_err(|error| refused(error.to_string()))?;
        let (rows, outputs) = (self.task.rows.len(), self.task.model.outputs.len());
        let conditions = self.task.model.conditions.len();
        if rows == 0 {
            return Err(refused("there are no rows".to_owned()));
        }
        let of_model = self.model.outputs.len();
        if self.observed.len() != outputs || of_model != outputs {
            return Err(refused(format!(
                "what was observed is given for {} outputs, and the model has {outputs}",
                self.observed.len().min(of_model)
            )));
        }
        if self.observed.iter().all(Option::is_none) {
            return Err(refused("no output was observed".to_owned()));
        }
        for (observed, output) in self.observed.iter().zip(&self.task.model.outputs) {
            let fault = observed.as_ref().and_then(|observed| fault(observed, rows));
            if let Some(fault) = fault {
                return Err(refused(format!("`{}`: {fault}", output.quantity.name)));
            }
        }
        let (simulated, derived) = (self.simulated, self.history.len());
        if simulated.saturating_add(derived) > conditions {
            return Err(refused(format!(
                "{simulated} of the conditions are said to be simulated and {derived} to follow from the \
                 order of the rows, and there are {conditions}"
            )));
        }
        let is_range = |[low, high]: &[f64; 2]| low <= high && low.is_finite() && high.is_finite();
        if !self.reachable.iter().flatten().all(is_range) {
            return Err(refused("a condition can be set within no finite range".to_owned()));
        }
        for candidate in self.candidates.iter().chain(&self.shipped) {
            let effect = &candidate.effect;
            let (found, expected) = (candidate.priors.len(), effect.parameters.len());
            if found != expected {
                return Err(refused(format!(
                    "the effect `{}` has {found} prior distributions for {expected} parameters",
                    effect.name
                )));
            }
        }
        if let Some(simulator) = &self.simulator {
            let space = simulator.space();
            let is_of_it = |candidate: &Candidate| {
                let own = candidate.simulator.filter(|effect| *effect < space.effects());
                own.map_or(candidate.simulator.is_none(), |effect| {
                    space.parameters(effect).len() == candidate.priors.len()
                })
            };
            let inputs = self.task.variables.len();
            if simulated < 2 || space.inputs() != inputs || !self.candidates.iter().all(is_of_it) {
                return Err(refused(
                    "the simulator's outputs, inputs or effects are not those of the case"
                        .to_owned(),
                ));
            }
        }
        let Prior { none, one, two, three, unexplained } = self.prior;
        let shares = [none, one, two, three, unexplained];
        let sum: f64 = shares.iter().sum();
        if !shares.iter().all(|share| (0.0..=1.0).contains(share)) || (sum - 1.0).abs() > 1e-3 {
            return Err(refused(
                "the prior probabilities must be from 0 to 1 and sum to one".to_owned(),
            ));
        }
        let effects = self.candidates.len();
        if !self.prior.is_possible(effects) {
            return Err(refused(format!(
                "no hypothesis has a prior probability above 0: there are {effects} effects, and what \
                 has one needs more of them"
            )));
        }
        Ok(())
    }

    /// Checks rows that are to be predicted at.
    ///
    /// # Errors
    /// As `Case::check_data`.
    pub fn check_rows(&self, rows: &[Row]) -> Result<(), OverrideError> {
        let conditions = self.task.model.conditions.len();
        let variables = self.task.variables.len();
        let is_right = |row: &Row| {
            row.conditions.len() == conditions
                && row.conditions.iter().all(|value| value.is_finite())
                && row.distributions.len() == variables
        };
        match rows.iter().position(|row| !is_right(row)) {
            Some(number) => Err(refused(format!(
                "row {number} to predict at must have {conditions} finite conditions and {variables} \
                 distributions"
            ))),
            None => Ok(()),
        }
    }
}

fn refused(reason: String) -> OverrideError {
    OverrideError::Case { reason }
}

/// What is wrong with the data of an output.
fn fault(observed: &ObservedOutput, rows: usize) -> Option<String> {
    let ObservedOutput {
        values,
        last_digit: _,
        standard_uncertainties,
        simulation_uncertainties,
        simulation_covariance,
    } = observed;
    let column = |what: &str, values: &[f64], is_right: fn(f64) -> bool, must: &str| {
        if values.len() != rows {
            return Some(format!("there are {} {what} in {rows} rows", values.len()));
        }
        let wrong = values.iter().position(|value| !(is_right(*value) && value.is_finite()))?;
        Some(format!("the {what} must be {must}; row {wrong} has {}", values[wrong]))
    };
    column("values", values, |_| true, "finite numbers")
        .or_else(|| {
            let of = standard_uncertainties.as_deref()?;
            column("standard uncertainties", of, |u| u > 0.0, "above 0")
        })
        .or_else(|| {
            let of = simulation_uncertainties.as_deref()?;
            column("standard uncertainties of the simulation", of, |u| u >= 0.0, "0 or above")
        })
        .or_else(|| {
            let matrix = simulation_covariance.as_ref()?;
            let is_row =
                |row: &Vec<f64>| row.len() == rows && row.iter().all(|value| value.is_finite());
            (matrix.len() != rows || !matrix.iter().all(is_row)).then(|| {
                format!("the simulation's covariance matrix must be of {rows} by {rows} numbers")
            })
        })
}
