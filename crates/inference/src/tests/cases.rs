//! Small cases for the tests of the inference and of the diagnosis.

use std::sync::Arc;

use crate::{Candidate, Case, Effect, ModelForm, ObservedOutput, OverridableModel, Prior};
use gumption_engine::distribution::{Distribution, Normal};
use gumption_engine::model::formula::{Formula, Scope, Typing};
use gumption_engine::model::{InputQuantity, NumberForm, Output, Quantity};
use gumption_engine::task::{Row, Sharing, Task, Variable};
use gumption_units::Unit;

/// A normal distribution.
pub(crate) fn normal(mean: f64, std: f64) -> Distribution {
    Normal::new(mean, std).unwrap().into()
}

/// A dimensionless quantity.
pub(crate) fn quantity(name: &str) -> Quantity {
    Quantity { name: name.to_owned(), unit: Unit::one(), about: String::new() }
}

/// Formulas by name.
pub(crate) fn formulas(texts: &[(&str, &str)]) -> Vec<(String, Formula)> {
    texts.iter().map(|(name, text)| ((*name).to_owned(), Formula::parse(text).unwrap())).collect()
}

/// An effect with one parameter.
pub(crate) fn candidate(
    name: &str,
    parameter: &str,
    prior: Distribution,
    of: &[(&str, &str)],
) -> Candidate {
    let effect = Effect {
        name: name.to_owned(),
        parameters: vec![quantity(parameter)],
        overrides: formulas(of),
    };
    Candidate {
        effect,
        priors: vec![prior],
        about: String::new(),
        source: String::new(),
        simulator: None,
    }
}

/// A model of the input `a` and the condition `x` = 0, 1, 2, ..., all of them dimensionless, with an
/// output for each equation.
pub(crate) fn case(
    a: Distribution,
    sharing: Sharing,
    equations: &[(&str, &str)],
    observed: Vec<ObservedOutput>,
    candidates: Vec<Candidate>,
) -> Case {
    let names = ["a", "x"].into_iter().chain(equations.iter().map(|(name, _)| *name));
    let sim = OverridableModel {
        inputs: vec![InputQuantity { quantity: quantity("a"), parts: 1 }],
        conditions: vec![quantity("x")],
        outputs: equations.iter().map(|(name, _)| Output::new(quantity(name))).collect(),
        maker: ModelForm::Equations(formulas(equations)),
        numbers: NumberForm::Coherent,
        scope: Scope::from_iter(names.map(|name| (name, Typing::in_unit(&Unit::one())))),
    };
    let distributions: Arc<[Arc<Distribution>]> = Arc::new([Arc::new(a)]);
    let row = |n: usize| Row { conditions: vec![n as f64], distributions: distributions.clone() };
    let mut variable = Variable::new("a", Unit::one());
    variable.sharing = sharing;
    let rows = (0..observed[0].values.len()).map(row).collect();
    let task = Task::new(sim.model().unwrap(), vec![variable], rows);
    let observed = observed.into_iter().map(Some).collect();
    Case {
        task,
        model: sim,
        observed,
        simulated: 0,
        simulator: None,
        history: Vec::new(),
        reachable: Vec::new(),
        candidates,
        shipped: Vec::new(),
        replication: None,
        prior: Prior::DEFAULT,
    }
}

/// Measured values with their standard uncertainties, if these are known.
pub(crate) fn observed(values: &[f64], uncertainties: Option<&[f64]>) -> ObservedOutput {
    ObservedOutput {
        values: values.to_vec(),
        last_digit: None,
        standard_uncertainties: uncertainties.map(<[f64]>::to_vec),
        simulation_uncertainties: None,
        simulation_covariance: None,
    }
}

/// A line through measured points with an offset and a slope as candidate effects; `a` is its input.
pub(crate) fn line_with(a: Distribution, sharing: Sharing) -> Case {
    let u: &[f64] = &[0.1, 0.1, 0.12, 0.1, 0.2, 0.1];
    case(
        a,
        sharing,
        &[("y", "a + 0.5*x"), ("z", "a*x - x")],
        vec![
            observed(&[1.12, 1.55, 2.31, 2.64, 3.18, 3.9], Some(u)),
            observed(&[0.03, -0.08, 0.21, 0.1, 0.31, 0.26], Some(u)),
        ],
        vec![
            candidate("offset", "o", normal(0.0, 0.4), &[("y", "y + o")]),
            candidate("slope", "s", normal(0.1, 0.3), &[("y", "y + s*x"), ("z", "z - s*x")]),
        ],
    )
}

/// The line with one unknown `a` for all points.
pub(crate) fn line() -> Case {
    line_with(normal(1.0, 0.3), Sharing::All)
}
