//! Whether a task holds together: settings within their ranges, as many of everything as the model
//! has, limits that a value can lie within. A task's fields may be set by hand, so that it is checked
//! when it is evaluated.

use super::{Settings, Task, TaskError, Trials};
use crate::model::{Tolerance, variables};

impl Task {
    /// Checks that the task can be evaluated: the settings, that there are as many variables,
    /// distributions and conditions as the model has, correlation coefficients and regions of what
    /// there is, and tolerance limits. [`evaluate`](crate::propagate::evaluate) does it by itself.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn check(&self) -> Result<(), TaskError> {
        self.settings.check()?;
        let model = &self.model;
        let count = |what, found, expected| {
            if found == expected {
                return Ok(());
            }
            Err(TaskError::Count { what, found, expected })
        };
        let parts = variables(&model.inputs, &[]);
        count("variables", self.variables.len(), parts)?;
        let all = parts + model.conditions.len();
        count("variables and conditions in its program", model.program.variables(), all)?;
        count("outputs in its program", model.program.outputs(), model.outputs.len())?;
        for (number, row) in self.rows.iter().enumerate() {
            let expected = model.conditions.len();
            let finite = row.conditions.iter().all(|value| value.is_finite());
            if row.conditions.len() != expected || !finite {
                return Err(TaskError::Conditions { row: number, expected });
            }
            count("distributions in a row", row.distributions.len(), parts)?;
        }
        for of in &self.correlations {
            let variable = |index: usize| {
                let found = self.variables.get(index).map(|variable| variable.name.as_str());
                found
                    .ok_or_else(|| TaskError::Unknown { name: index.to_string(), kind: "variable" })
            };
            coefficient([variable(of.first)?, variable(of.second)?], of.coefficient)?;
        }
        for region in &self.regions {
            if let Some(number) = region.outputs.iter().find(|of| **of >= model.outputs.len()) {
                return Err(TaskError::Unknown { name: number.to_string(), kind: "output" });
            }
            if region.probability.is_some_and(|p| !(p > 0.0 && p < 1.0)) {
                let range = "a probability between 0 and 1";
                return Err(TaskError::Setting { name: "coverage of a region", range });
            }
        }
        for output in &model.outputs {
            if let Some(limits) = &output.tolerance {
                tolerance(&output.quantity.name, limits)?;
            }
        }
        Ok(())
    }
}

impl Settings {
    /// Checks that every setting is within its range.
    ///
    /// # Errors
    /// The first that is not.
    pub fn check(&self) -> Result<(), TaskError> {
        let outside = |name, range| Err(TaskError::Setting { name, range });
        if let Some(range) = self.coverage.fault() {
            return outside("coverage", range);
        }
        match self.trials {
            Trials::Fixed(1) => return outside("number of trials", "0 or at least 2"),
            Trials::Adaptive if self.max_trials < 2 => {
                return outside("largest number of trials", "at least 2");
            }
            _ => {}
        }
        if !(1..=15).contains(&self.digits) {
            return outside("number of meaningful digits", "from 1 to 15");
        }
        if !(0.0..=1.0).contains(&self.allowed_undefined) {
            return outside("share of trials that may be undefined", "from 0 to 1");
        }
        Ok(())
    }
}

/// Checks a correlation coefficient of two quantities.
pub(super) fn coefficient(between: [&str; 2], coefficient: f64) -> Result<(), TaskError> {
    let refuse =
        |reason| Err(TaskError::Coefficient { between: between.map(str::to_owned), reason });
    if !(-1.0..=1.0).contains(&coefficient) {
        refuse("must be from -1 to 1")
    } else if between[0] == between[1] {
        refuse("is between a quantity and itself")
    } else {
        Ok(())
    }
}

/// Checks that a value can lie within limits.
fn tolerance(of: &str, limits: &Tolerance) -> Result<(), TaskError> {
    let refuse = |reason| Err(TaskError::Tolerance { of: of.to_owned(), reason });
    match (limits.lower, limits.upper) {
        (None, None) => refuse("has neither a lower nor an upper limit"),
        (lower, upper) if [lower, upper].into_iter().flatten().any(|limit| !limit.is_finite()) => {
            refuse("has a limit that is not a finite number; leave out the one that there is not")
        }
        (Some(lower), Some(upper)) if lower >= upper => {
            refuse("has a lower limit that is not below the upper one")
        }
        _ => Ok(()),
    }
}
