//! A saved result as a linear model: outputs as weighted sums of inputs, to first order.

use std::fmt;

use super::trials::{self, ByTrials};
use gumption_engine::distribution::{Root, RootName};
use gumption_engine::propagate::Control;
use gumption_engine::propagate::gum;
use gumption_engine::propagate::gum::{Dof, Gum};
use gumption_engine::propagate::origins;
use gumption_engine::task::Task;
use gumption_units::Unit;

/// Outputs to first order in their original inputs.
#[derive(Clone, Debug)]
pub struct LinearResult {
    /// The outputs, in order.
    pub outputs: Vec<LinearOutput>,
    /// The original inputs.
    pub inputs: Vec<Root>,
    /// The model that has these inputs directly, as [`RootName::model`] names it (the SHA-256 of a
    /// model file); the other inputs come from saved results.
    pub model: String,
    /// Correlation coefficients between inputs: their indices and the coefficient.
    pub correlations: Vec<(usize, usize, f64)>,
}

/// An output and its sensitivity coefficients.
#[derive(Clone, Debug)]
pub struct LinearOutput {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: Unit,
    /// Standard uncertainty.
    pub standard_uncertainty: f64,
    /// Effective degrees of freedom; not a number where they are undefined.
    pub dof: f64,
    /// Coverage factor; `None` if U is not defined.
    pub coverage_factor: Option<f64>,
    /// Coverage probability, if it is known.
    pub probability: Option<f64>,
    /// The results of the trials; `None` without trials.
    pub by_trials: Option<ByTrials>,
    /// Sensitivity coefficients with respect to the inputs, in order; 0 beyond the end.
    pub sensitivities: Vec<f64>,
}

impl LinearOutput {
    /// The sensitivity coefficient for the input with this index.
    pub(super) fn sensitivity(&self, index: usize) -> f64 {
        self.sensitivities.get(index).copied().unwrap_or(0.0)
    }
}

/// A task with another number of rows of conditions than one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SeveralRows {
    /// The number of rows; 0 is possible.
    pub rows: usize,
}

impl fmt::Display for SeveralRows {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the task has {} rows of conditions; one is needed", self.rows)
    }
}

impl std::error::Error for SeveralRows {}

impl LinearResult {
    /// The outputs of a task's only row by the law of propagation, and the results of its trials.
    ///
    /// # Errors
    /// The task does not have exactly one row of conditions.
    pub fn of_task(task: &Task, control: &Control<'_>) -> Result<Self, SeveralRows> {
        // any name that is not a hash
        const MODEL: &str = "this file";
        let [row] = task.rows.as_slice() else {
            return Err(SeveralRows { rows: task.rows.len() });
        };
        let evaluated = gum::evaluate(task, row).outputs;
        let gums: Vec<Option<&Gum>> = evaluated.iter().map(Option::as_ref).collect();
        let origins = origins(task, row, &gums, MODEL);
        let tried = trials::of_rows(task, &[row], control).into_iter().next().unwrap_or_default();
        let outputs = task.model.outputs.iter().zip(&gums).zip(origins.sensitivities);
        let outputs =
            outputs.enumerate().map(|(place, ((output, gum), sensitivities))| LinearOutput {
                by_trials: tried.get(place).copied().flatten(),
                name: output.quantity.name.clone(),
                unit: output.quantity.unit.clone(),
                standard_uncertainty: gum.map_or(f64::NAN, |gum| gum.standard_uncertainty),
                dof: match gum.map(|gum| gum.dof) {
                    Some(Dof::Finite(dof)) => dof,
                    Some(Dof::Infinite) => f64::INFINITY,
                    Some(Dof::Undefined) | None => f64::NAN,
                },
                coverage_factor: gum.and_then(|gum| gum.coverage_factor),
                probability: Some(task.settings.coverage.probability()),
                sensitivities: sensitivities.unwrap_or_default(),
            });
        let index = |name: &RootName| origins.roots.iter().position(|root| root.name == *name);
        let correlations = origins.correlations.iter();
        let correlations =
            correlations.filter_map(|c| Some((index(&c.first)?, index(&c.second)?, c.coefficient)));
        Ok(Self {
            outputs: outputs.collect(),
            correlations: correlations.collect(),
            model: MODEL.to_owned(),
            inputs: origins.roots,
        })
    }

    /// Whether the input belongs to the model itself, not to a saved result that it uses.
    pub(super) fn is_own(&self, index: usize) -> bool {
        self.inputs.get(index).is_some_and(|root| *root.name.model == *self.model)
    }
}

/// An input of one side or both sides.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Matched {
    /// Its name; for an input of a saved result whose name is not unique, with the beginning of its
    /// file's hash.
    pub(super) label: String,
    /// Its indices.
    pub(super) indices: [Option<usize>; 2],
}

/// The inputs of both sides: first those of the first side in order, then those that only the
/// second has. Own inputs are matched by name. Inputs of saved results are matched by file and
/// name, or by name alone if that file is not on the other side.
pub(super) fn matched(sides: [&LinearResult; 2]) -> Vec<Matched> {
    let [first, second] = sides;
    let name = |side: usize, index: usize| sides[side].inputs.get(index).map(|root| &root.name);
    let mut other: Vec<Option<usize>> = vec![None; first.inputs.len()];
    let mut taken = vec![false; second.inputs.len()];
    let mut pair = |same: &dyn Fn(usize, usize) -> bool| {
        for (index, other) in other.iter_mut().enumerate().filter(|(_, other)| other.is_none()) {
            let found = (0..taken.len()).find(|&q| !taken[q] && same(index, q));
            if let Some(q) = found {
                taken[q] = true;
                *other = found;
            }
        }
    };
    let own = |a: usize, b: usize| [first.is_own(a), second.is_own(b)];
    let same_name = |a, b| name(0, a).map(|n| &n.name) == name(1, b).map(|n| &n.name);
    pair(&|a, b| own(a, b) == [true, true] && same_name(a, b));
    pair(&|a, b| own(a, b) == [false, false] && name(0, a) == name(1, b));
    pair(&|a, b| own(a, b) == [false, false] && same_name(a, b));

    let of_first = other.iter().enumerate().map(|(index, &other)| [Some(index), other]);
    let added = taken.iter().enumerate().filter(|(_, taken)| !**taken);
    let all: Vec<[Option<usize>; 2]> =
        of_first.chain(added.map(|(index, _)| [None, Some(index)])).collect();
    let seen = |indices: &[Option<usize>; 2]| match *indices {
        [Some(index), _] => (0, index),
        [None, index] => (1, index.unwrap_or(0)),
    };
    let names: Vec<Option<&RootName>> =
        all.iter().map(|indices| name(seen(indices).0, seen(indices).1)).collect();
    let label = |(root, indices): (&Option<&RootName>, &[Option<usize>; 2])| {
        let Some(root) = root else {
            return String::new();
        };
        let (side, index) = seen(indices);
        let equal = names.iter().flatten().filter(|other| other.name == root.name);
        if sides[side].is_own(index) || equal.count() == 1 {
            root.name.to_string()
        } else {
            let hash: String = root.model.chars().take(8).collect();
            format!("{} ({hash})", root.name)
        }
    };
    let labels = names.iter().zip(&all).map(label);
    labels.zip(&all).map(|(label, indices)| Matched { label, indices: *indices }).collect()
}
