//! Budgets of many measurements of one model at once: columns in, columns out.

use std::collections::HashMap;
use std::sync::Arc;

use gumption::distribution::{Constant, Distribution, Normal};
use gumption::file::{ModelFile, bytes};
use gumption::propagate::gum::bulk::{self, BulkInput, BulkOptions, BulkValue};
use gumption::task::{Coverage, Row, Task};
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

    fn at(&self, row: usize) -> f64 {
        match self {
            Self::Same(value) => *value,
            Self::Rows(values) => values.get(row).copied().unwrap_or(f64::NAN),
        }
    }

    /// The number of its rows; `None` of a number for all of them.
    fn rows(&self) -> Option<usize> {
        match self {
            Self::Same(_) => None,
            Self::Rows(values) => Some(values.len()),
        }
    }

    fn write_to(&self, bytes: &mut Vec<u8>) {
        match self {
            Self::Same(value) => bytes.extend(value.to_le_bytes()),
            Self::Rows(values) => bytes.extend(values.iter().flat_map(|value| value.to_le_bytes())),
        }
    }
}

/// The columns that are given for a model.
struct Given {
    /// Estimate, standard uncertainty and degrees of freedom of each variable; `None` of one that is as
    /// the model has it.
    variables: Vec<Option<[Known; 3]>>,
    conditions: Vec<Option<Known>>,
}

impl Given {
    fn of(task: &Task, columns: &Bound<'_, PyDict>) -> PyResult<Self> {
        let mut given: HashMap<String, [Known; 3]> = HashMap::new();
        for (name, value) in columns {
            let [x, u, dof]: [Bound<'_, PyAny>; 3] = value.extract()?;
            given.insert(name.extract()?, [Known::of(&x)?, Known::of(&u)?, Known::of(&dof)?]);
        }
        let variables = task.variables.iter().map(|variable| given.remove(&variable.name));
        let variables = variables.collect();
        let conditions = task.model.conditions.iter();
        let conditions =
            conditions.map(|of| given.remove(&of.name).map(|[value, ..]| value)).collect();
        match given.keys().next() {
            Some(name) => {
                let reason = format!("the model has no input or condition `{name}`");
                Err(argument(columns.py(), reason))
            }
            None => Ok(Self { variables, conditions }),
        }
    }

    /// The number of rows.
    fn rows(&self) -> usize {
        let variables = self.variables.iter().flatten().flatten();
        let given = variables.chain(self.conditions.iter().flatten());
        given.filter_map(Known::rows).max().unwrap_or(1)
    }
}

/// What is known of a variable in a row: a normal distribution, or a t for few degrees of freedom; a
/// constant where its uncertainty is 0.
fn distribution([x, u, dof]: &[Known; 3], row: usize) -> Result<Arc<Distribution>, String> {
    let [x, u, dof] = [x, u, dof].map(|known| known.at(row));
    let made = match u {
        0.0 => Constant::new(x).map(Distribution::from),
        _ => Normal::with_dof(x, u, dof).map(Distribution::from),
    };
    made.map(Arc::new).map_err(|invalid| format!("in row {row} (from 0) the {invalid}"))
}

fn first_row<'t>(py: Python<'_>, task: &'t Task) -> PyResult<&'t Row> {
    task.rows.first().ok_or_else(|| argument(py, "the model has no row of conditions"))
}

/// The model in the rows of columns, as [`budgets`] takes them: a sweep of rows that each know something
/// else of the inputs.
#[pyfunction]
pub(crate) fn in_rows(
    py: Python<'_>,
    model: &Bound<'_, Model>,
    columns: &Bound<'_, PyDict>,
) -> PyResult<Model> {
    let file = &model.get().file;
    let mut task = file.task.clone();
    let given = Given::of(&task, columns)?;
    let first = first_row(py, &task)?;
    let of_row = |variable: usize, known: &[Known; 3], row| {
        let name = &task.variables[variable].name;
        distribution(known, row).map_err(|reason| argument(py, format!("`{name}`: {reason}")))
    };
    // what is the same in all rows is kept once; of others nothing
    let mut shared = Vec::with_capacity(task.variables.len());
    for (variable, (own, known)) in first.distributions.iter().zip(&given.variables).enumerate() {
        shared.push(match known {
            None => Some(Arc::clone(own)),
            Some(known) if known.iter().all(|known| known.rows().is_none()) => {
                Some(of_row(variable, known, 0)?)
            }
            Some(_) => None,
        });
    }
    let mut rows = Vec::with_capacity(given.rows());
    for row in 0..given.rows() {
        let conditions = given.conditions.iter().zip(&first.conditions);
        let conditions =
            conditions.map(|(known, own)| known.as_ref().map_or(*own, |known| known.at(row)));
        let mut distributions = Vec::with_capacity(shared.len());
        for (variable, (shared, known)) in shared.iter().zip(&given.variables).enumerate() {
            match (shared, known) {
                (None, Some(known)) => distributions.push(of_row(variable, known, row)?),
                (shared, _) => distributions.extend(shared.clone()),
            }
        }
        rows.push(Row { conditions: conditions.collect(), distributions: distributions.into() });
    }
    task.rows = rows;
    task.swept = true;
    // parts of a run of other columns are parts of another run
    let mut content = Vec::new();
    let variables = given.variables.iter().flatten().flatten();
    variables
        .chain(given.conditions.iter().flatten())
        .for_each(|known| known.write_to(&mut content));
    let mut files = file.files.clone();
    files.push(("columns".to_owned(), bytes::sha256(&content).into_bytes()));
    Ok(model.get().with_file(ModelFile {
        task,
        warnings: file.warnings.clone(),
        source: Arc::clone(&file.source),
        files,
        output_places: file.output_places.clone(),
        evidence: Vec::new(),
        readings: file.readings.clone(),
    }))
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
    let given = Given::of(task, columns)?;
    let row = first_row(py, task)?;
    let variables = given.variables.into_iter().zip(row.distributions.iter());
    let known: Vec<[Known; 3]> = variables
        .map(|(given, own)| {
            given.unwrap_or_else(|| {
                [own.mean(), own.standard_uncertainty(), own.dof()].map(Known::Same)
            })
        })
        .collect();
    let conditions = given.conditions.into_iter().zip(&row.conditions);
    let conditions: Vec<Known> =
        conditions.map(|(given, own)| given.unwrap_or(Known::Same(*own))).collect();
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
