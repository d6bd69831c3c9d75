//! Budgets of many measurements of one model at once: columns in, columns out.

use std::collections::HashMap;
use std::sync::Arc;

use gumption::propagate::gum::bulk::{self, BulkInput, BulkOptions, BulkValue};
use gumption::task::Coverage;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::coverage::{check_one, factor, probability};
use crate::errors::argument;
use crate::model::Model;
use crate::supervised::supervised;

/// A number for all rows, or one for each.
enum Known {
    Same(f64),
    Rows(Vec<f64>),
}

impl Known {
    fn of(value: &Bound<'_, PyAny>) -> PyResult<Self> {
        match value.extract::<PyReadonlyArray1<'_, f64>>() {
            Ok(rows) => Ok(Self::Rows(rows.as_array().to_vec())),
            Err(_) => value.extract().map(Self::Same),
        }
    }

    fn as_bulk(&self) -> BulkValue<'_> {
        match self {
            Self::Same(value) => BulkValue::Same(*value),
            Self::Rows(values) => BulkValue::Rows(values),
        }
    }
}

/// Budgets of every output: for each a dictionary of columns. `columns` has for each variable or
/// condition that is given its estimate, its standard uncertainty and its degrees of freedom; what is
/// not given is as the model has it in its first row.
#[pyfunction]
#[pyo3(signature = (model, columns, coverage=None, k=None, real_dof=false))]
pub(crate) fn budgets<'py>(
    py: Python<'py>,
    model: &Bound<'py, Model>,
    columns: &Bound<'py, PyDict>,
    coverage: Option<Bound<'py, PyAny>>,
    k: Option<Bound<'py, PyAny>>,
    real_dof: bool,
) -> PyResult<Bound<'py, PyList>> {
    let file = Arc::clone(&model.get().file);
    let task = &file.task;
    let mut given: HashMap<String, [Known; 3]> = HashMap::new();
    for (name, value) in columns {
        let name: String = name.extract()?;
        let [x, u, dof]: [Bound<'_, PyAny>; 3] = value.extract()?;
        given.insert(name, [Known::of(&x)?, Known::of(&u)?, Known::of(&dof)?]);
    }
    let row = task.rows.first();
    let row = row.ok_or_else(|| argument(py, "the model has no row of conditions"))?;
    let variables = task.variables.iter().map(|variable| &variable.name);
    let mut known = Vec::with_capacity(task.variables.len());
    for (name, distribution) in variables.zip(row.distributions.iter()) {
        known.push(given.remove(name).unwrap_or_else(|| {
            [distribution.mean(), distribution.standard_uncertainty(), distribution.dof()]
                .map(Known::Same)
        }));
    }
    let mut conditions = Vec::new();
    for (condition, &value) in task.model.conditions.iter().zip(&row.conditions) {
        let own = given.remove(&condition.name).map(|[value, ..]| value);
        conditions.push(own.unwrap_or(Known::Same(value)));
    }
    if let Some(name) = given.keys().next() {
        return Err(argument(py, format!("the model has no input or condition `{name}`")));
    }
    let own = task.settings.coverage;
    check_one(py, coverage.is_some(), k.is_some())?;
    let factor = k.as_ref().map(factor).transpose()?;
    let factor = factor.map(|factor| Coverage::Factor { factor, fixed: false });
    let probability = coverage.as_ref().map(probability).transpose()?;
    let coverage = probability.map(Coverage::Probability).or(factor).unwrap_or(own);
    let real_dof = real_dof || task.settings.real_dof;
    let of = Arc::clone(&file);
    let made = supervised(py, None, move |_| {
        let inputs: Vec<BulkInput<'_>> = known
            .iter()
            .map(|[x, u, dof]| BulkInput {
                estimate: x.as_bulk(),
                standard_uncertainty: u.as_bulk(),
                dof: dof.as_bulk(),
            })
            .collect();
        let conditions: Vec<BulkValue<'_>> = conditions.iter().map(Known::as_bulk).collect();
        let correlations = &of.task.correlations;
        let options = BulkOptions { coverage, real_dof, correlations, ..BulkOptions::default() };
        bulk::budgets(&of.task.model.program, &inputs, &conditions, options)
    })?;
    let made = made.map_err(|error| argument(py, error.to_string()))?;
    let outputs = PyList::empty(py);
    for budgets in made {
        let columns = PyDict::new(py);
        let column = |values: Vec<f64>| PyArray1::from_vec(py, values);
        columns.set_item("estimate", column(budgets.estimates))?;
        columns.set_item("standard_uncertainty", column(budgets.standard_uncertainties))?;
        columns.set_item("dof", column(budgets.dof))?;
        columns.set_item("coverage_factor", column(budgets.coverage_factors))?;
        let each = |all: Vec<Vec<f64>>| -> PyResult<Bound<'py, PyDict>> {
            let by_name = PyDict::new(py);
            for (variable, values) in file.task.variables.iter().zip(all) {
                by_name.set_item(&variable.name, column(values))?;
            }
            Ok(by_name)
        };
        columns.set_item("sensitivities", each(budgets.sensitivities)?)?;
        columns.set_item("contributions", each(budgets.contributions)?)?;
        outputs.append(columns)?;
    }
    Ok(outputs)
}
