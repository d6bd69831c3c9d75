//! Figures of an evaluation as columns, one entry for each row of conditions.

use gumption::distribution::EvaluationType;
use gumption::propagate::gum::{BudgetLine, Dof, Gum};
use gumption::propagate::monte_carlo::MonteCarlo;
use gumption::propagate::{Evaluation, OutputEvaluation};
use gumption::task::Task;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The column of that name for an output; `None` if there is no such figure. What is not defined is
/// NaN, and infinite degrees of freedom are infinite.
pub(crate) fn column(evaluation: &Evaluation, output: usize, name: &str) -> Option<Vec<f64>> {
    let of = figure(name)?;
    let rows = evaluation.rows.iter();
    Some(rows.map(|row| row.outputs.get(output).and_then(&of).unwrap_or(f64::NAN)).collect())
}

type Figure = Box<dyn Fn(&OutputEvaluation) -> Option<f64>>;

fn figure(name: &str) -> Option<Figure> {
    let gum = |of: fn(&Gum) -> Option<f64>| -> Option<Figure> {
        Some(Box::new(move |output| output.gum.as_ref().and_then(of)))
    };
    let trials = |of: fn(&MonteCarlo) -> Option<f64>| -> Option<Figure> {
        Some(Box::new(move |output| output.monte_carlo.as_deref().and_then(of)))
    };
    match name {
        "gum.estimate" => gum(|g| Some(g.estimate)),
        "gum.standard_uncertainty" => gum(|g| Some(g.standard_uncertainty)),
        "gum.dof" => gum(|g| match g.dof {
            Dof::Finite(dof) => Some(dof),
            Dof::Infinite => Some(f64::INFINITY),
            Dof::Undefined => None,
        }),
        "gum.coverage_factor" => gum(|g| g.coverage_factor),
        "gum.expanded_uncertainty" => gum(Gum::expanded_uncertainty),
        "gum.low" => gum(|g| g.interval().map(|[low, _]| low)),
        "gum.high" => gum(|g| g.interval().map(|[_, high]| high)),
        "monte_carlo.trials" => trials(|m| Some(m.trials as f64)),
        "monte_carlo.estimate" => trials(|m| m.estimate),
        "monte_carlo.standard_uncertainty" => trials(|m| m.standard_uncertainty),
        "monte_carlo.median" => trials(|m| Some(m.median)),
        "monte_carlo.symmetric_low" => trials(|m| Some(m.symmetric_interval[0])),
        "monte_carlo.symmetric_high" => trials(|m| Some(m.symmetric_interval[1])),
        "monte_carlo.shortest_low" => trials(|m| Some(m.shortest_interval[0])),
        "monte_carlo.shortest_high" => trials(|m| Some(m.shortest_interval[1])),
        "monte_carlo.skewness" => trials(|m| m.skewness),
        "monte_carlo.excess_kurtosis" => trials(|m| m.excess_kurtosis),
        "validation.tolerance" => Some(Box::new(|o| o.validation.map(|v| v.tolerance))),
        "validation.gum_valid" => Some(Box::new(|o| {
            o.validation.and_then(|v| v.gum_valid).map(|valid| f64::from(u8::from(valid)))
        })),
        "conformity.probability" => {
            Some(Box::new(|o| o.conformity.as_ref().map(|c| c.probability)))
        }
        _ => None,
    }
}

/// The columns of a budget: the lines of the inputs, then those of correlation coefficients, which are
/// called `r(a, b)` and have a share only.
pub(crate) fn budget<'py>(py: Python<'py>, task: &Task, gum: &Gum) -> PyResult<Bound<'py, PyDict>> {
    let variable = |number: usize| task.variables.get(number);
    let name = |number: usize| variable(number).map_or("", |v| v.name.as_str());
    let lines: Vec<_> = gum.budget().collect();
    let links: Vec<_> = gum.correlations().collect();
    let texts = |of: &dyn Fn(usize) -> Option<String>| -> Vec<Option<String>> {
        let own = lines.iter().map(|line| of(line.variable));
        own.chain(links.iter().map(|_| None)).collect()
    };
    let numbers = |of: fn(&BudgetLine) -> f64| -> Bound<'py, PyArray1<f64>> {
        let own = lines.iter().map(of);
        PyArray1::from_iter(py, own.chain(links.iter().map(|_| f64::NAN)).collect::<Vec<_>>())
    };
    let columns = PyDict::new(py);
    let inputs: Vec<String> = lines
        .iter()
        .map(|line| name(line.variable).to_owned())
        .chain(links.iter().map(|link| {
            let [a, b] = link.variables.map(name);
            format!("r({a}, {b})")
        }))
        .collect();
    columns.set_item("input", inputs)?;
    columns.set_item("unit", texts(&|v| Some(variable(v)?.unit.text().to_owned())))?;
    columns.set_item("estimate", numbers(|line| line.estimate))?;
    columns.set_item("standard_uncertainty", numbers(|line| line.standard_uncertainty))?;
    let distributions = lines.iter().map(|line| Some(line.distribution));
    let distributions: Vec<_> = distributions.chain(links.iter().map(|_| None)).collect();
    columns.set_item("distribution", distributions)?;
    let kind = |v: usize| {
        let evaluation = variable(v)?.evaluation;
        Some(if evaluation == EvaluationType::A { "A" } else { "B" }.to_owned())
    };
    columns.set_item("type", texts(&kind))?;
    columns.set_item("group", texts(&|v| variable(v)?.group.clone()))?;
    columns.set_item("dof", numbers(|line| line.dof))?;
    columns.set_item("sensitivity", numbers(|line| line.sensitivity))?;
    columns.set_item("contribution", numbers(|line| line.contribution))?;
    let shares = lines.iter().map(|line| line.share).chain(links.iter().map(|link| link.share));
    columns.set_item("share", PyArray1::from_vec(py, shares.collect()))?;
    Ok(columns)
}
