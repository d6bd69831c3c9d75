//! What a saved result tells: outputs as weighted sums of inputs.

use gumption_engine::distribution::{Root, RootName};
use gumption_engine::propagate::gum;
use gumption_engine::propagate::gum::{Dof, Gum};
use gumption_engine::propagate::origins;
use gumption_files::{ModelFile, ResultFile, SavedOutput};
use gumption_units::Unit;

/// Outputs to first order in the inputs that they go back to.
#[derive(Clone, Debug)]
pub(super) struct Linear {
    /// The outputs, in order.
    pub outputs: Vec<LinearOutput>,
    /// The inputs that they go back to.
    pub(super) inputs: Vec<Root>,
    /// The model that has the inputs without a result between, by the name of its file's hash.
    model: String,
    /// Correlation coefficients between inputs, by their places.
    pub(super) correlations: Vec<(usize, usize, f64)>,
}

/// An output and its sensitivity coefficients.
#[derive(Clone, Debug)]
pub(super) struct LinearOutput {
    /// Its name.
    pub(super) name: String,
    /// Its unit.
    pub(super) unit: Unit,
    /// Standard uncertainty.
    pub(super) standard_uncertainty: f64,
    /// Effective degrees of freedom; not a number where they are undefined.
    pub(super) dof: f64,
    /// Coverage factor; `None` where U is not defined.
    pub(super) coverage_factor: Option<f64>,
    /// Coverage probability, if it is known.
    pub(super) probability: Option<f64>,
    /// Sensitivity coefficients to the inputs, in order; 0 beyond the end.
    pub(super) sensitivities: Vec<f64>,
}

impl LinearOutput {
    /// The coefficient to the input at a place.
    pub(super) fn sensitivity(&self, place: usize) -> f64 {
        self.sensitivities.get(place).copied().unwrap_or(0.0)
    }
}

impl Linear {
    /// The outputs of a result file. One without sensitivity coefficients is its own input.
    pub(super) fn of_result(file: &ResultFile) -> Self {
        let mut inputs = file.inputs.clone();
        let output = |saved: &SavedOutput| {
            let sensitivities = saved.sensitivities.clone().unwrap_or_else(|| {
                let own = saved.distribution.saved().map(|s| &s.origin().roots);
                let before = inputs.len();
                inputs.extend(own.into_iter().flatten().map(|(root, _)| root.clone()));
                let coefficient = |place| if place < before { 0.0 } else { 1.0 };
                (0..inputs.len()).map(coefficient).collect()
            });
            LinearOutput {
                name: saved.name.clone(),
                unit: saved.unit.clone(),
                standard_uncertainty: saved.distribution.standard_uncertainty(),
                dof: saved.distribution.dof(),
                coverage_factor: saved.coverage_factor,
                probability: file.coverage_probability,
                sensitivities,
            }
        };
        let outputs = file.outputs.iter().map(output).collect();
        let place = |name: &RootName| file.inputs.iter().position(|root| root.name == *name);
        let correlations = file.input_correlations.iter();
        let correlations =
            correlations.filter_map(|c| Some((place(&c.first)?, place(&c.second)?, c.coefficient)));
        let correlations = correlations.collect();
        Self { outputs, inputs, model: file.model.to_string(), correlations }
    }

    /// The outputs of a model file's first row by the law of propagation.
    pub(super) fn of_model(file: &ModelFile) -> Self {
        // any name serves that no file's hash has
        const MODEL: &str = "this file";
        let task = &file.task;
        let Some(row) = task.rows.first() else {
            let (outputs, inputs, correlations) = (Vec::new(), Vec::new(), Vec::new());
            return Self { outputs, inputs, model: MODEL.to_owned(), correlations };
        };
        let evaluated = gum::evaluate(task, row).outputs;
        let gums: Vec<Option<&Gum>> = evaluated.iter().map(Option::as_ref).collect();
        let origins = origins(task, row, &gums, MODEL);
        let outputs = task.model.outputs.iter().zip(&gums).zip(origins.sensitivities);
        let outputs = outputs.map(|((output, gum), sensitivities)| LinearOutput {
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
        let place = |name: &RootName| origins.roots.iter().position(|root| root.name == *name);
        let correlations = origins.correlations.iter();
        let correlations =
            correlations.filter_map(|c| Some((place(&c.first)?, place(&c.second)?, c.coefficient)));
        Self {
            outputs: outputs.collect(),
            correlations: correlations.collect(),
            model: MODEL.to_owned(),
            inputs: origins.roots,
        }
    }

    /// Whether the input is the model's own, not one of a saved result that it took.
    fn is_own(&self, place: usize) -> bool {
        self.inputs.get(place).is_some_and(|root| *root.name.model == *self.model)
    }
}

/// An input of one side or of both.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Matched {
    /// Its name; of an input behind a saved result whose name others have as well, with the
    /// beginning of its file's hash.
    pub(super) label: String,
    /// Its places.
    pub(super) places: [Option<usize>; 2],
}

/// The inputs of both sides, those of the first in order, then what only the second has. Own inputs
/// are the same by their name. Inputs behind saved results are the same by file and name, and where
/// that file is not on the other side, by name.
pub(super) fn matched(sides: [&Linear; 2]) -> Vec<Matched> {
    let [first, second] = sides;
    let name = |side: usize, place: usize| sides[side].inputs.get(place).map(|root| &root.name);
    let mut other: Vec<Option<usize>> = vec![None; first.inputs.len()];
    let mut taken = vec![false; second.inputs.len()];
    let mut pair = |same: &dyn Fn(usize, usize) -> bool| {
        for (place, other) in other.iter_mut().enumerate().filter(|(_, other)| other.is_none()) {
            let found = (0..taken.len()).find(|&q| !taken[q] && same(place, q));
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

    let of_first = other.iter().enumerate().map(|(place, &other)| [Some(place), other]);
    let added = taken.iter().enumerate().filter(|(_, taken)| !**taken);
    let all: Vec<[Option<usize>; 2]> =
        of_first.chain(added.map(|(place, _)| [None, Some(place)])).collect();
    let seen = |places: &[Option<usize>; 2]| match *places {
        [Some(place), _] => (0, place),
        [None, place] => (1, place.unwrap_or(0)),
    };
    let names: Vec<Option<&RootName>> =
        all.iter().map(|places| name(seen(places).0, seen(places).1)).collect();
    let label = |(root, places): (&Option<&RootName>, &[Option<usize>; 2])| {
        let Some(root) = root else {
            return String::new();
        };
        let (side, place) = seen(places);
        let equal = names.iter().flatten().filter(|other| other.name == root.name);
        if sides[side].is_own(place) || equal.count() == 1 {
            root.name.to_string()
        } else {
            let hash: String = root.model.chars().take(8).collect();
            format!("{} ({hash})", root.name)
        }
    };
    let labels = names.iter().zip(&all).map(label);
    labels.zip(&all).map(|(label, places)| Matched { label, places: *places }).collect()
}
