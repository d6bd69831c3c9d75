//! The diagnosis of a simulator that is a Python function.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};

use gumption::command::{Failure, KeptRuns, SimulatedCase, prediction_folder};
use gumption::file::CaseFile;
use gumption::gap::DiagnosisOptions;
use gumption::gap::simulated::{
    PREDICTION_RUNS, Run, RunResult, Runs, Simulator, SimulatorCase, SimulatorDiagnosis,
    simulator_case,
};
use gumption::report::{self, Provenance};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};

use crate::application;
use crate::errors::{argument, failed, failed_with};
use crate::supervised::{Watch, supervised, supervised_asking, supervised_within};

/// The name of the table of a prediction's conditions.
const ELSEWHERE: &str = "prediction.csv";

/// Parts of the work that progress is told in.
const PARTS: f64 = 1000.0;

/// A case of the gap diagnosis whose sim is a simulator.
#[pyclass(frozen, module = "gumption._gumption")]
#[derive(Debug)]
pub(crate) struct SimulatedGap(Arc<GapCase>);

#[derive(Debug)]
struct GapCase {
    file: CaseFile,
    held: Vec<(String, Vec<u8>)>,
    given: SimulatorCase,
}

/// What came of it.
#[pyclass(frozen, module = "gumption._gumption")]
#[derive(Debug)]
pub(crate) struct SimulatorGap(Arc<Diagnosed>);

#[derive(Debug)]
struct Diagnosed {
    read: Arc<GapCase>,
    found: SimulatorDiagnosis,
    provenance: Provenance,
}

/// Runs that are asked for: each result is given with its place; nothing more is wanted once `enough`.
struct Asked {
    batch: Vec<Vec<f64>>,
    give: Sender<(usize, RunResult)>,
    enough: Arc<AtomicBool>,
}

/// A simulator that another thread runs.
struct AskingSimulator(Mutex<Box<dyn Fn(Asked) -> bool + Send>>);

impl Simulator for AskingSimulator {
    fn run(
        &self,
        batch: &[Vec<f64>],
        _: &SimulatorCase,
        finished: &mut dyn FnMut(usize, RunResult) -> ControlFlow<()>,
    ) {
        let (give, take) = channel();
        let enough = Arc::new(AtomicBool::new(false));
        let asked = Asked { batch: batch.to_vec(), give, enough: Arc::clone(&enough) };
        let ask = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if batch.is_empty() || !ask(asked) {
            return;
        }
        for (index, result) in take {
            if finished(index, result).is_break() {
                enough.store(true, Ordering::Relaxed);
                return;
            }
        }
    }
}

/// Has a Python generator make runs: it takes an array, a line of parameters for each run, and yields the
/// place of a run with an array of all outputs, or with the reason why there is none.
fn make(simulate: &Bound<'_, PyAny>, asked: &Asked, given: &SimulatorCase) -> PyResult<()> {
    let batch = lines(simulate.py(), &asked.batch, given)?;
    let runs = simulate.call1((batch,))?;
    for run in runs.try_iter()? {
        let (index, result): (usize, Bound<'_, PyAny>) = run?.extract()?;
        let result = match result.extract::<String>() {
            Ok(reason) => Err(reason),
            Err(_) => Ok(result.cast::<PyArray1<f64>>()?.readonly().as_array().to_vec()),
        };
        // who waits may have gone
        if asked.give.send((index, result)).is_err() || asked.enough.load(Ordering::Relaxed) {
            runs.call_method0("close")?;
            break;
        }
    }
    Ok(())
}

#[pymethods]
impl SimulatedGap {
    /// Reads a case's text; `held` are the files that it names.
    #[new]
    fn new(py: Python<'_>, text: String, held: Vec<(String, Vec<u8>)>) -> PyResult<Self> {
        let read = supervised_within(py, &AtomicBool::new(false), || {
            application().files().holding(&held).case_text("<stdin>", &text, Path::new(""))
        })?;
        let names: Vec<&str> = held.iter().map(|(name, _)| name.as_str()).collect();
        let file = read.map_err(|found| failed_with(py, &Failure::Diagnostics(found), &names))?;
        let given = simulator_case(&file.case, &file.case.task.rows);
        let given = given.ok_or_else(|| argument(py, "the case has no simulator"))?;
        Ok(Self(Arc::new(GapCase { file, held, given })))
    }

    /// The names of the simulator's parameters in their order.
    #[getter]
    fn parameters(&self) -> Vec<String> {
        self.0.given.parameter_names()
    }

    /// The names of its outputs in their order.
    #[getter]
    fn outputs(&self) -> Vec<String> {
        self.0.given.output_names()
    }

    /// The values of a condition in the rows of the data, in its unit, by name.
    #[getter]
    fn conditions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let conditions = PyDict::new(py);
        for condition in &self.0.given.conditions {
            let values = PyArray1::from_slice(py, &condition.values);
            conditions.set_item(&condition.quantity.name, values)?;
        }
        Ok(conditions)
    }

    /// The notes on what was read.
    #[getter]
    fn notes(&self) -> Vec<String> {
        report::words::notes(&self.0.file.warnings).into_iter().map(|note| note.text).collect()
    }

    /// Diagnoses it with at most so many runs, which `simulate` makes.
    #[pyo3(signature = (simulate, runs, seed=None, folder=None, name="", progress=None))]
    #[allow(clippy::too_many_arguments)] // those of the Python function
    fn diagnose(
        &self,
        py: Python<'_>,
        simulate: &Bound<'_, PyAny>,
        runs: usize,
        seed: Option<u64>,
        folder: Option<PathBuf>,
        name: &str,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<SimulatorGap> {
        let given = self.0.given.clone();
        let kept = match folder {
            Some(folder) => opened(py, &folder, given, name)?,
            None => KeptRuns::in_memory(given),
        };
        self.diagnosed(py, Some(simulate), seed, progress, move |simulator, stop| {
            SimulatedCase::new(kept, simulator, runs, stop)
        })
    }

    /// Diagnoses it with runs that were made before: a line of parameters for each, and one of all outputs.
    #[pyo3(signature = (parameters, outputs, seed=None, progress=None))]
    fn diagnose_made(
        &self,
        py: Python<'_>,
        parameters: PyReadonlyArray2<'_, f64>,
        outputs: PyReadonlyArray2<'_, f64>,
        seed: Option<u64>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<SimulatorGap> {
        let given = self.0.given.clone();
        let (parameters, outputs) = (parameters.as_array(), outputs.as_array());
        let mut runs = Runs::new(given.parameter_names());
        for (parameters, outputs) in parameters.rows().into_iter().zip(outputs.rows()) {
            let parameters = parameters.to_vec();
            let repetition = runs.repetitions(&parameters);
            let run = Run { parameters, repetition, result: Ok(outputs.to_vec()) };
            runs.keep(run).map_err(|error| argument(py, error.to_string()))?;
        }
        self.diagnosed(py, None, seed, progress, move |_, stop| {
            SimulatedCase::of_made(given, runs, stop)
        })
    }
}

impl SimulatedGap {
    fn diagnosed(
        &self,
        py: Python<'_>,
        simulate: Option<&Bound<'_, PyAny>>,
        seed: Option<u64>,
        progress: Option<&Bound<'_, PyAny>>,
        with: impl FnOnce(Box<dyn Simulator + Send>, Arc<AtomicBool>) -> SimulatedCase + Send + 'static,
    ) -> PyResult<SimulatorGap> {
        let read = Arc::clone(&self.0);
        let options = DiagnosisOptions::new(seed.unwrap_or(read.file.case.task.settings.seed));
        let found = simulated(py, &read.given, simulate, progress, {
            let read = Arc::clone(&read);
            move |watch, simulator| {
                let told = |share: f64| watch.done.store((share * PARTS) as u64, Ordering::Relaxed);
                with(simulator, Arc::clone(&watch.stop)).diagnose(&read.file.case, options, &told)
            }
        })?;
        let provenance = Provenance::of(&read.file.source.text, &read.file.files);
        Ok(SimulatorGap(Arc::new(Diagnosed { read, found, provenance })))
    }
}

/// Kept runs in a folder.
fn opened(py: Python<'_>, folder: &Path, given: SimulatorCase, name: &str) -> PyResult<KeptRuns> {
    let (kept, notes) = KeptRuns::open(folder, given, name).map_err(|e| failed(py, &e))?;
    for note in notes {
        py.import("warnings")?.call_method1("warn", (note,))?;
    }
    Ok(kept)
}

/// A line of parameters for each run.
fn lines<'py>(
    py: Python<'py>,
    runs: &[Vec<f64>],
    given: &SimulatorCase,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    PyArray1::from_vec(py, runs.concat()).reshape([runs.len(), given.parameters.len()])
}

/// Does some work with a simulator that is run in this thread.
fn simulated<T: Send + 'static>(
    py: Python<'_>,
    given: &SimulatorCase,
    simulate: Option<&Bound<'_, PyAny>>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Watch, Box<dyn Simulator + Send>) -> Result<Option<T>, Failure> + Send + 'static,
) -> PyResult<T> {
    let mut answer = |asked: Asked| match simulate {
        Some(simulate) => make(simulate, &asked, given),
        None => Ok(()),
    };
    let done = supervised_asking(py, progress, &mut answer, |watch, ask| {
        work(watch, Box::new(AskingSimulator(Mutex::new(ask))))
    })?;
    let found = done.map_err(|failure| failed(py, &failure))?;
    found.ok_or_else(|| PyKeyboardInterrupt::new_err("the diagnosis was stopped"))
}

#[pymethods]
impl SimulatorGap {
    /// The answer of `gumption gap --format json`.
    fn json(&self) -> String {
        report::gap::json(&self.0.found.diagnosis)
    }

    /// The answer in another format: `html`, `table`, `markdown` or `csv`.
    fn to<'py>(&self, py: Python<'py>, format: &str) -> PyResult<Bound<'py, PyBytes>> {
        let of = Arc::clone(&self.0);
        let format = format.to_owned();
        let text = supervised(py, None, move |_| {
            let (diagnosis, provenance) = (&of.found.diagnosis, &of.provenance);
            Some(match &*format {
                "json" => report::gap::json(diagnosis),
                "html" => report::gap::html(diagnosis, provenance),
                "table" => report::gap::table(diagnosis, provenance),
                "markdown" => report::gap::markdown(diagnosis, provenance),
                "csv" => report::gap::csv(diagnosis),
                _ => return None,
            })
        })?;
        let formats = "`format` is one of html, table, markdown, json and csv";
        let text = text.ok_or_else(|| argument(py, formats))?;
        Ok(PyBytes::new(py, text.as_bytes()))
    }

    /// What is to be said beside the answer.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.0.found.diagnosis.notes.iter().map(report::gap::note).collect()
    }

    /// Runs that would tell more, a line of parameters each; there are some of runs that were made before.
    fn more<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        lines(py, &self.0.found.more, &self.0.read.given)
    }

    /// All runs: an array with a line of parameters for each, and for each an array of all outputs or the
    /// reason why there is none.
    #[allow(clippy::type_complexity)] // what stands in the line above
    fn runs<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyArray2<f64>>, Bound<'py, PyList>)> {
        let made = self.0.found.runs.made();
        let parameters: Vec<Vec<f64>> = made.iter().map(|run| run.parameters.clone()).collect();
        let parameters = lines(py, &parameters, &self.0.read.given)?;
        let results = PyList::empty(py);
        for run in made {
            match &run.result {
                Ok(outputs) => results.append(PyArray1::from_slice(py, outputs))?,
                Err(reason) => results.append(reason)?,
            }
        }
        Ok((parameters, results))
    }

    /// The corrected simulator in the rows of a table of conditions: for each output its values and their
    /// standard uncertainties, in the output's unit, and what is to be said of them. `simulate` makes its
    /// runs, at most about `runs`; it is called with the conditions first.
    #[pyo3(signature = (simulate, table, runs=None, folder=None, name=""))]
    #[allow(clippy::type_complexity)] // what stands in the lines above
    fn predict<'py>(
        &self,
        py: Python<'py>,
        simulate: &Bound<'py, PyAny>,
        table: Vec<u8>,
        runs: Option<usize>,
        folder: Option<PathBuf>,
        name: &str,
    ) -> PyResult<(Bound<'py, PyDict>, Vec<String>)> {
        let of = Arc::clone(&self.0);
        let GapCase { file, held, .. } = &*of.read;
        let mut files = held.clone();
        files.push((ELSEWHERE.to_owned(), table));
        let reader = application().files().holding(&files);
        let rows =
            reader.case_text_at("<stdin>", &file.source.text, Path::new(""), Path::new(ELSEWHERE));
        let rows = rows.map_err(|found| failed(py, &Failure::Diagnostics(found)))?;
        let given = simulator_case(&file.case, &rows);
        let given = given.ok_or_else(|| argument(py, "the case has no simulator"))?;
        let conditions = PyDict::new(py);
        for condition in &given.conditions {
            let values = PyArray1::from_slice(py, &condition.values);
            conditions.set_item(&condition.quantity.name, values)?;
        }
        let simulate = simulate.call1((conditions,))?;
        let kept = match folder {
            Some(folder) => opened(py, &prediction_folder(&folder, &given), given, name)?,
            None => KeptRuns::in_memory(given),
        };
        let runs = runs.unwrap_or(PREDICTION_RUNS);
        let diagnosis = simulated(py, &of.read.given, Some(&simulate), None, {
            let of = Arc::clone(&of);
            move |watch, simulator| {
                let stop = Arc::clone(&watch.stop);
                SimulatedCase::new(kept, simulator, runs, stop).predict(&of.found, rows)
            }
        })?;
        let predicted = diagnosis.prediction.unwrap_or_default();
        let found = PyDict::new(py);
        for (place, output) in diagnosis.outputs.iter().enumerate() {
            let part = |of: fn((f64, f64)) -> f64| -> Vec<f64> {
                predicted.iter().map(|row| of(row.outputs[place])).collect()
            };
            let (values, u) = (part(|(value, _)| value), part(|(_, u)| u));
            let pair = (PyArray1::from_vec(py, values), PyArray1::from_vec(py, u));
            found.set_item(&output.name, pair)?;
        }
        let notes = diagnosis.notes.iter().skip(of.found.diagnosis.notes.len());
        Ok((found, notes.map(report::gap::note).collect()))
    }
}
