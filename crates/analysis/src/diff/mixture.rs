//! Evaluations that take some inputs and settings from one task and the rest from the other.

use std::cell::OnceCell;
use std::collections::HashMap;
use std::sync::Arc;

use super::Side;
use gumption_engine::distribution::{Constant, Correlation, Distribution, Normal};
use gumption_engine::propagate::gum;
use gumption_engine::task::{Row, Task};
use gumption_units::Unit;

/// A cause: an item that can come from the first or from the second task.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Cause {
    /// The state of knowledge about a variable of both tasks.
    Moved(String),
    /// A variable that only the first task has; its uncertainty vanishes.
    Removed(String),
    /// A variable that only the second task has; its uncertainty appears.
    Added(String),
    /// The declared correlation coefficients.
    Correlations,
    /// Coverage probability or factor.
    Coverage,
}

/// A row of each of the two tasks.
pub(super) struct Mixture<'a> {
    tasks: [&'a Task; 2],
    rows: [&'a Row; 2],
    /// The tasks without their rows.
    empty: &'a [Task; 2],
    /// Indexed by the sides of the model, of the correlations and of the coverage: copying a task
    /// takes longer than evaluating it, and there are thousands of evaluations.
    made: [[[OnceCell<Task>; 2]; 2]; 2],
    indices: [HashMap<&'a str, usize>; 2],
    /// Indices of the outputs to compare.
    outputs: Vec<[usize; 2]>,
    /// Conversion factors from the second task's unit of each output to the first task's unit.
    factors: Vec<f64>,
}

impl<'a> Mixture<'a> {
    /// `empty` are the tasks without their rows.
    pub(crate) fn new(
        tasks: [&'a Task; 2],
        empty: &'a [Task; 2],
        rows: [&'a Row; 2],
        outputs: &[Common],
    ) -> Self {
        let indices = tasks.map(|task| {
            task.variables.iter().enumerate().map(|(index, v)| (v.name.as_str(), index)).collect()
        });
        Self {
            tasks,
            rows,
            empty,
            made: Default::default(),
            indices,
            outputs: outputs.iter().map(|output| output.indices).collect(),
            factors: outputs.iter().map(|output| output.factor).collect(),
        }
    }

    /// The causes with an effect, in the order of their names.
    pub(super) fn causes(&self) -> Vec<Cause> {
        let mut names: Vec<&str> = self.indices.iter().flat_map(|p| p.keys().copied()).collect();
        names.sort_unstable();
        names.dedup();
        let mut causes: Vec<Cause> = Vec::new();
        for name in names {
            let text = || name.to_owned();
            match self.indices.each_ref().map(|indices| indices.get(name)) {
                [Some(&first), Some(&second)] if self.differs(first, second) => {
                    causes.push(Cause::Moved(text()));
                }
                [Some(_), None] => causes.push(Cause::Removed(text())),
                [None, Some(_)] => causes.push(Cause::Added(text())),
                _ => {}
            }
        }
        if self.named_correlations(0) != self.named_correlations(1) {
            causes.push(Cause::Correlations);
        }
        let [first, second] = self.tasks.map(|task| task.settings);
        if first.coverage != second.coverage || first.real_dof != second.real_dof {
            causes.push(Cause::Coverage);
        }
        causes
    }

    fn differs(&self, first: usize, second: usize) -> bool {
        let [a, b] = [(0, first), (1, second)].map(|(side, index)| {
            (self.rows[side].distributions.get(index), self.tasks[side].variables.get(index))
        });
        let units = a.1.map(|v| v.unit.text()) == b.1.map(|v| v.unit.text());
        !units || a.0 != b.0
    }

    fn named_correlations(&self, side: usize) -> Vec<(&'a str, &'a str, f64)> {
        let task = self.tasks[side];
        let name = |index: usize| task.variables.get(index).map_or("", |v| v.name.as_str());
        let named = task.correlations.iter().filter(|c| c.coefficient != 0.0).map(|c| {
            let (a, b) = (name(c.first), name(c.second));
            (a.min(b), a.max(b), c.coefficient)
        });
        let mut named: Vec<_> = named.collect();
        named.sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)));
        named
    }

    /// u^2 and k of every common output, one after the other, by the model of one side, with some
    /// causes in effect. NaN if a value is undefined.
    pub(super) fn figures(&self, model: Side, in_effect: &[&Cause]) -> Vec<f64> {
        let own = model.index();
        let is = |cause: &Cause| in_effect.contains(&cause);
        let from = |cause: &Cause| if is(cause) { 1 } else { 0 };
        let mut moved = vec![false; self.tasks[own].variables.len()];
        for cause in in_effect {
            if let Cause::Moved(name) | Cause::Removed(name) | Cause::Added(name) = cause
                && let Some(&index) = self.indices[own].get(name.as_str())
            {
                moved[index] = true;
            }
        }
        let distributions = self.tasks[own].variables.iter().zip(&moved).enumerate().map(
            |(index, (variable, moved))| {
                let distribution = self.rows[own].distributions.get(index);
                if usize::from(*moved) == own {
                    return distribution.cloned();
                }
                match self.indices[1 - own].get(variable.name.as_str()) {
                    // the state that this side does not have: exactly known
                    None => distribution.map(|d| Arc::new(known(d))),
                    Some(&other) => self.taken(1 - own, other, &variable.unit),
                }
            },
        );
        let distributions: Option<Arc<[Arc<Distribution>]>> = distributions.collect();
        let Some(distributions) = distributions else {
            return vec![f64::NAN; 2 * self.outputs.len()];
        };
        let task = self.task(own, from(&Cause::Correlations), from(&Cause::Coverage));
        let row = Row { conditions: self.rows[own].conditions.clone(), distributions };
        let outputs = gum::evaluate(task, &row).outputs;
        let figures = self.outputs.iter().zip(&self.factors).flat_map(|(indices, factor)| {
            let gum = outputs.get(indices[own]).and_then(Option::as_ref);
            let factor = if own == 0 { 1.0 } else { *factor };
            let u = gum.map_or(f64::NAN, |gum| gum.standard_uncertainty * factor);
            let k = gum.and_then(|gum| gum.coverage_factor).unwrap_or(f64::NAN);
            [u * u, k]
        });
        figures.collect()
    }

    /// The task of one side with the correlations and the coverage of the other sides.
    fn task(&self, own: usize, correlations: usize, coverage: usize) -> &Task {
        self.made[own][correlations][coverage].get_or_init(|| {
            let mut task = self.empty[own].clone();
            task.correlations = self.correlations(correlations, own);
            let settings = self.tasks[coverage].settings;
            task.settings.coverage = settings.coverage;
            task.settings.real_dof = settings.real_dof;
            task
        })
    }

    /// A variable of one side, in the unit of the other.
    fn taken(&self, side: usize, index: usize, unit: &Unit) -> Option<Arc<Distribution>> {
        let distribution = self.rows[side].distributions.get(index)?;
        let variable = self.tasks[side].variables.get(index)?;
        if variable.unit.text() == unit.text() {
            return Some(Arc::clone(distribution));
        }
        // only estimate, uncertainty and degrees of freedom count here
        let factor = Unit::conversion_factor(&variable.unit, unit).ok()?;
        let mean = distribution.mean();
        // a component is a difference, so the zero of a scale does not matter
        let mean = match variable.name.contains('/') {
            true => mean * factor,
            false => Unit::convert(mean, &variable.unit, unit).ok()?,
        };
        let u = distribution.standard_uncertainty() * factor;
        let taken = if u > 0.0 {
            Normal::with_dof(mean, u, distribution.dof()).ok().map(Distribution::from)
        } else {
            Constant::new(mean).ok().map(Distribution::from)
        };
        taken.map(Arc::new)
    }

    /// The coefficients of one side between variables of another side's model.
    fn correlations(&self, side: usize, model: usize) -> Vec<Correlation> {
        let named = self.named_correlations(side).into_iter();
        let indexed = named.filter_map(|(a, b, coefficient)| {
            let (a, b) = (*self.indices[model].get(a)?, *self.indices[model].get(b)?);
            Some(Correlation { first: a.min(b), second: a.max(b), coefficient })
        });
        indexed.collect()
    }
}

/// The same estimate, known exactly.
fn known(distribution: &Distribution) -> Distribution {
    Constant::new(distribution.mean()).map_or_else(|_| distribution.clone(), Distribution::from)
}

/// An output of both tasks.
#[derive(Clone, Debug)]
pub(super) struct Common {
    pub(super) indices: [usize; 2],
    pub(super) factor: f64,
}
