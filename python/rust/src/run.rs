//! A finished run, and what is made of it when it is asked for.

use gumption::report::words;
use std::sync::Arc;

use gumption::command::Failure;
use gumption::file::ModelFile;
use gumption::propagate::monte_carlo::{Histogram, MonteCarlo};
use gumption::propagate::{
    Control, Evaluation, EvaluationError, convergence, first_trials, for_each_block, histograms,
};
use gumption::report::{self, EvaluationReport, Provenance, SaveError, Shown, TrialsForm};
use gumption::task::{Task, Warning};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyIndexError, PyKeyError, PyOSError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::columns;
use crate::errors::{argument, failed};
use crate::supervised::{Watch, supervised};

/// What was evaluated and what came out.
#[derive(Debug)]
pub(crate) struct Ran {
    pub(crate) file: Arc<ModelFile>,
    pub(crate) task: Task,
    pub(crate) evaluation: Evaluation,
    /// Of a result file, where they are known already.
    pub(crate) quantiles: Option<Vec<Vec<f64>>>,
    pub(crate) notes: Vec<Warning>,
    pub(crate) provenance: Arc<Provenance>,
    pub(crate) replaced: Vec<String>,
    pub(crate) threads: usize,
    pub(crate) memory: usize,
}

/// Title, result, budget, conclusions and comparison of an output.
type OutputOfPage = (String, String, String, String, String);

/// A finished run.
#[pyclass(frozen, module = "gumption._gumption")]
#[derive(Debug)]
pub(crate) struct Run(Arc<Ran>);

impl Run {
    pub(crate) fn of(ran: Ran) -> Self {
        Self(Arc::new(ran))
    }

    /// The number of an output.
    fn output(&self, name: &str) -> PyResult<usize> {
        let mut outputs = self.0.task.model.outputs.iter();
        let found = outputs.position(|output| output.quantity.name == name);
        found.ok_or_else(|| PyKeyError::new_err(name.to_owned()))
    }

    fn check_row(&self, row: usize) -> PyResult<()> {
        let rows = self.0.evaluation.rows.len();
        if row < rows {
            return Ok(());
        }
        Err(PyIndexError::new_err(format!("row {row} of {rows} rows of conditions, from 0")))
    }

    /// Makes something of the run on the threads of the pool.
    fn made<T: Send + 'static>(
        &self,
        py: Python<'_>,
        make: impl FnOnce(&Ran, &Control<'_>) -> T + Send + 'static,
    ) -> PyResult<T> {
        let ran = Arc::clone(&self.0);
        supervised(py, None, move |watch: &Watch| make(&ran, &ran.control(watch)))
    }
}

impl Ran {
    fn report(&self) -> EvaluationReport<'_> {
        EvaluationReport {
            task: &self.task,
            evaluation: &self.evaluation,
            warnings: &self.notes,
            provenance: &self.provenance,
        }
    }

    fn control<'w>(&self, watch: &'w Watch) -> Control<'w> {
        let control = Control::default().with_threads(self.threads).with_memory(self.memory);
        control.with_stop(&watch.stop)
    }

    /// The answer in a format, as the command line gives it.
    fn formatted(&self, format: &str, control: &Control<'_>) -> Result<Option<Vec<u8>>, String> {
        let report = self.report();
        let rows = &self.evaluation.rows;
        let mut drawn: Vec<Vec<Option<Histogram>>> = Vec::new();
        let mut settled: Vec<Vec<MonteCarlo>> = Vec::new();
        if format == "html" && rows.len() == 1 {
            let found = histograms(&self.task, &self.evaluation, 0, control);
            drawn.push(found.map_err(|error| error.to_string())?.unwrap_or_default());
            let found = convergence(&self.task, &self.evaluation, 0, control);
            settled = found.map_err(|error| error.to_string())?.unwrap_or_default();
        }
        let mut first: Vec<Vec<f64>> = Vec::new();
        if format == "html" {
            let most = report::trials_of_pairs(&report);
            let found = first_trials(&self.task, &self.evaluation, 0, most, control);
            first = found.map_err(|error| error.to_string())?.unwrap_or_default();
        }
        let shown = Shown {
            trials: &first,
            columns: &[],
            histograms: &drawn,
            convergence: &settled,
            replaced: &self.replaced,
            extent: report::Extent::default(),
            language: words::Language::English,
            model: &self.file.source.text,
        };
        let text = match format {
            "json" => report::json(&report),
            "csv" => report::csv(&report),
            "table" => report::table(&report, &shown),
            "markdown" => report::markdown(&report, &shown),
            "latex" => report::latex(&report, &shown),
            "html" => report::html(&report, &shown),
            "xlsx" => {
                let book = report::xlsx(&report, &shown);
                return book.map(Some).map_err(|error| format!("no workbook: {error}"));
            }
            _ => return Ok(None),
        };
        Ok(Some(text.into_bytes()))
    }

    /// The trials of some outputs in a row.
    fn samples(
        &self,
        outputs: &[usize],
        row: usize,
        control: &Control<'_>,
    ) -> Result<Vec<Vec<f64>>, EvaluationError> {
        let figures = self.evaluation.rows.get(row).map_or(&[][..], |row| &row.outputs);
        let trials = figures.iter().find_map(|output| output.monte_carlo.as_deref());
        let count = trials.map_or(0, |figures| figures.trials) as usize;
        let mut samples: Vec<Vec<f64>> =
            outputs.iter().map(|_| Vec::with_capacity(count)).collect();
        for_each_block(&self.task, &self.evaluation, row, control, |block| {
            for (values, &output) in samples.iter_mut().zip(outputs) {
                values.extend_from_slice(block.get(output).map_or(&[][..], Vec::as_slice));
            }
            Ok::<(), EvaluationError>(())
        })?;
        Ok(samples)
    }
}

fn broken(py: Python<'_>, error: &EvaluationError) -> PyErr {
    failed(py, &Failure::System(error.to_string()))
}

#[pymethods]
impl Run {
    /// The answer in a format of the command line.
    fn formatted<'py>(&self, py: Python<'py>, format: &str) -> PyResult<Bound<'py, PyBytes>> {
        let asked = format.to_owned();
        let found = self.made(py, move |ran, control| ran.formatted(&asked, control))?;
        match found.map_err(PyOSError::new_err)? {
            Some(bytes) => Ok(PyBytes::new(py, &bytes)),
            None => Err(argument(
                py,
                format!(
                    "there is no format `{format}`; the formats are table, json, csv, markdown, \
                     latex, html \
                     and xlsx"
                ),
            )),
        }
    }

    /// The result file of the run, from which inputs of other models are taken.
    fn saved(&self, py: Python<'_>) -> PyResult<String> {
        let found = self.made(py, |ran, control| {
            report::saved_result(&ran.report(), ran.quantiles.as_deref(), control)
        })?;
        match found {
            Ok(Some(text)) => Ok(text),
            Ok(None) => Err(PyOSError::new_err("the run was stopped")),
            Err(SaveError::Evaluation(error)) => Err(broken(py, &error)),
            Err(error) => Err(argument(py, error.to_string())),
        }
    }

    /// The trials of some outputs in a row, an array for each.
    fn samples<'py>(
        &self,
        py: Python<'py>,
        outputs: Vec<String>,
        row: usize,
    ) -> PyResult<Vec<Bound<'py, PyArray1<f64>>>> {
        self.check_row(row)?;
        let outputs = outputs.iter().map(|name| self.output(name)).collect::<PyResult<Vec<_>>>()?;
        if self.0.evaluation.rows[row].outputs.iter().all(|output| output.monte_carlo.is_none()) {
            return Err(argument(py, "the run has no trials, as their number was 0"));
        }
        let found = self.made(py, move |ran, control| ran.samples(&outputs, row, control))?;
        let found = found.map_err(|error| broken(py, &error))?;
        Ok(found.into_iter().map(|values| PyArray1::from_vec(py, values)).collect())
    }

    /// Lower end, width and counts of the bins of each output's histogram in a row; `None` for one
    /// that does not vary.
    #[allow(clippy::type_complexity)] // a list of what stands in the line above
    fn histograms<'py>(
        &self,
        py: Python<'py>,
        row: usize,
    ) -> PyResult<Vec<Option<(f64, f64, Bound<'py, PyArray1<u64>>)>>> {
        self.check_row(row)?;
        let found = self
            .made(py, move |ran, control| histograms(&ran.task, &ran.evaluation, row, control))?;
        let found = found.map_err(|error| broken(py, &error))?.unwrap_or_default();
        let of = |found: Option<Histogram>| {
            found.map(|h| (h.low, h.width, PyArray1::from_vec(py, h.counts)))
        };
        Ok(found.into_iter().map(of).collect())
    }

    /// A figure of an output in every row of conditions.
    fn column<'py>(
        &self,
        py: Python<'py>,
        output: &str,
        name: &str,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let column = columns::column(&self.0.evaluation, self.output(output)?, name);
        let column = column.ok_or_else(|| PyKeyError::new_err(name.to_owned()))?;
        Ok(PyArray1::from_vec(py, column))
    }

    /// The conditions, a column for each in an array of rows.
    fn condition_rows<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rows = &self.0.evaluation.rows;
        let width = self.0.task.model.conditions.len();
        let values = rows.iter().flat_map(|row| row.conditions.iter().copied()).collect();
        PyArray1::from_vec(py, values).reshape([rows.len(), width])
    }

    /// For each output of a row its title, and as HTML what the page says of it: the result, the
    /// budget, what follows from it, and both methods side by side. Without the distribution of the
    /// trials, for which they would be made again.
    fn page_parts(&self, py: Python<'_>, row: usize) -> PyResult<Vec<OutputOfPage>> {
        self.check_row(row)?;
        self.made(py, move |ran, _| {
            let choice = report::PageChoice { row, ..report::PageChoice::default() };
            let shown = Shown { replaced: &ran.replaced, ..Shown::default() };
            let size = report::FigureSize::Narrow;
            let parts = report::page_parts(&ran.report(), &shown, size, choice);
            let of = |one: report::OutputParts| {
                (one.title, one.verdict, one.budget, one.conclusions, one.comparison)
            };
            parts.outputs.into_iter().map(of).collect()
        })
    }

    /// The columns of an output's budget in a row; none where there is no budget.
    fn budget<'py>(
        &self,
        py: Python<'py>,
        output: &str,
        row: usize,
    ) -> PyResult<Option<Bound<'py, PyDict>>> {
        self.check_row(row)?;
        let Ran { task, evaluation, .. } = &*self.0;
        let found = evaluation.rows[row].outputs.get(self.output(output)?);
        found
            .and_then(|found| found.gum.as_ref())
            .map(|gum| columns::budget(py, task, gum))
            .transpose()
    }

    /// Correlation coefficients between the outputs i < j of a row.
    fn correlations(&self, row: usize) -> PyResult<Vec<f64>> {
        self.check_row(row)?;
        Ok(self.0.evaluation.rows[row].correlations.clone())
    }

    /// Codes, places and texts of the notes and warnings.
    #[getter]
    fn warnings(&self) -> Vec<Note> {
        notes(&self.0.notes)
    }

    #[getter]
    fn swept(&self) -> bool {
        self.0.task.swept
    }

    #[getter]
    fn rows(&self) -> usize {
        self.0.evaluation.rows.len()
    }

    #[getter]
    fn coverage_probability(&self) -> f64 {
        self.0.evaluation.coverage_probability
    }

    #[getter]
    fn seed(&self) -> u64 {
        self.0.evaluation.settings.seed
    }

    /// Names and units of the outputs.
    #[getter]
    fn outputs(&self) -> Vec<(String, String)> {
        let outputs = self.0.task.model.outputs.iter().map(|output| &output.quantity);
        outputs.map(|of| (of.name.clone(), of.unit.text().to_owned())).collect()
    }

    /// Names and units of the conditions.
    #[getter]
    fn conditions(&self) -> Vec<(String, String)> {
        let conditions = self.0.task.model.conditions.iter();
        conditions.map(|of| (of.name.clone(), of.unit.text().to_owned())).collect()
    }

    /// The outputs' trials of a row as the bytes of a file, as `--samples` writes it.
    fn trials_file<'py>(&self, py: Python<'py>, form: &str) -> PyResult<Bound<'py, PyBytes>> {
        let of = TrialsForm::of_extension(form);
        let form =
            of.ok_or_else(|| argument(py, "a file name that ends in .csv or .npy is needed"))?;
        self.check_row(0)?;
        let found = self.made(py, move |ran, control| {
            let outputs = &ran.task.model.outputs;
            let names: Vec<&str> = outputs.iter().map(|o| o.quantity.name.as_str()).collect();
            let samples = ran.samples(&(0..names.len()).collect::<Vec<_>>(), 0, control)?;
            let count = samples.first().map_or(0, Vec::len) as u64;
            let mut bytes = form.header(&names, count);
            bytes.extend(form.block(&samples));
            Ok::<_, EvaluationError>(bytes)
        })?;
        Ok(PyBytes::new(py, &found.map_err(|error| broken(py, &error))?))
    }

    fn __repr__(&self) -> String {
        format!("<gumption._gumption.Run {:?}>", self.0.task.title)
    }
}

/// A note: its code, its place and its sentence.
pub(crate) type Note = (&'static str, String, String);

pub(crate) fn notes(warnings: &[Warning]) -> Vec<Note> {
    let notes = words::notes(warnings).into_iter();
    notes.map(|note| (note.code, note.r#where.to_owned(), note.text)).collect()
}
