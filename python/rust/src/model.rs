//! A model file, read and checked.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use gumption::command::Failure;
use gumption::file::{ModelFile, Override, ReadingsFile, bytes};
use gumption::propagate::{Control, Evaluation, evaluate, is_brief, warnings};
use gumption::report::Provenance;
use gumption::task::{
    Coverage, MethodChoice, SettingsChanges, StatementMethod, StoppingRule, Task, Trials,
};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::application;
use crate::coverage;
use crate::draws;
use crate::errors::{argument, failed, failed_with};
use crate::function::PythonFunction;
use crate::parts::Parts;
use crate::run::{Note, Ran, Run, notes};
use crate::supervised::{Watch, at_once, supervised, supervised_within};

/// A text of at most so many bytes that names no files is read in less than a millisecond, and without
/// calibration functions nothing in it is large enough for several threads.
const SHORT: usize = 16 << 10;

/// What a model is read from.
#[derive(Debug)]
pub(crate) struct Source {
    pub(crate) name: String,
    pub(crate) text: String,
    pub(crate) folder: PathBuf,
    pub(crate) held: Vec<(String, Vec<u8>)>,
    allowed: Vec<PathBuf>,
    pub(crate) replaced: Vec<String>,
    accept_changed: bool,
    /// The name and the content of a file of readings that replace those of the model.
    readings: Option<(String, Vec<u8>)>,
    /// Where the file is, if it is one.
    pub(crate) path: Option<PathBuf>,
}

/// A model file, read and checked.
#[pyclass(frozen, module = "gumption._gumption")]
#[derive(Debug)]
pub(crate) struct Model {
    pub(crate) source: Arc<Source>,
    pub(crate) file: Arc<ModelFile>,
    provenance: Arc<Provenance>,
}

/// What `run` is asked for beside what the file says.
#[derive(Debug, Default)]
struct RunRequest {
    changes: SettingsChanges,
    /// A coverage factor; whether it is kept fixed is said by the file.
    factor: Option<f64>,
    threads: usize,
    memory: usize,
}

impl RunRequest {
    fn of(py: Python<'_>, options: &Bound<'_, PyDict>) -> PyResult<Self> {
        let mut asked = Self { memory: 64 << 20, ..Self::default() };
        for (name, value) in options {
            if value.is_none() {
                continue;
            }
            let name: String = name.extract()?;
            let needed = |what: &str| coverage::needed(&value, &name, what);
            match name.as_str() {
                "trials" => {
                    asked.changes.trials = Some(trials(&value).ok_or_else(|| {
                        needed("a whole number (0, or from 2 to 1e12) or \"adaptive\"")
                    })?)
                }
                "seed" => {
                    let seed = value.extract().map_err(|_| needed("a whole number from 0"));
                    asked.changes.seed = Some(seed?);
                }
                "coverage" => {
                    let p = coverage::probability(&value)?;
                    asked.changes.coverage = Some(Coverage::Probability(p));
                }
                "k" => asked.factor = Some(coverage::factor(&value)?),
                "digits" => {
                    let digits = value.extract().ok().filter(|d| (1..=15).contains(d));
                    asked.changes.digits =
                        Some(digits.ok_or_else(|| needed("a whole number from 1 to 15"))?);
                }
                "real_dof" => asked.changes.real_dof = value.is_truthy()?,
                "validate" => asked.changes.validate = value.is_truthy()?,
                "rule" => {
                    let rule = value.extract::<String>().ok();
                    let rule = rule.and_then(|rule| StoppingRule::named(&rule));
                    asked.changes.rule = Some(rule.ok_or_else(|| needed("\"7.9\" or \"stein\""))?);
                }
                "method" => {
                    let method = value.extract::<String>().ok();
                    let method = method.and_then(|method| MethodChoice::named(&method));
                    let names = "\"auto\", \"monte-carlo\", \"exact\" or \"quasi\"";
                    asked.changes.method = Some(method.ok_or_else(|| needed(names))?);
                }
                "statement" => {
                    let method = value.extract::<String>().ok();
                    let method = method.and_then(|method| StatementMethod::named(&method));
                    let names = "\"auto\", \"gum\" or \"monte-carlo\"";
                    asked.changes.statement = Some(method.ok_or_else(|| needed(names))?);
                }
                "max_trials" => {
                    let most = value.extract().ok().filter(|n| *n >= 20_000);
                    asked.changes.max_trials =
                        Some(most.ok_or_else(|| needed("a whole number from 20000"))?);
                }
                "threads" => {
                    let threads = value.extract().ok().filter(|n| (1..=1024).contains(n));
                    asked.threads =
                        threads.ok_or_else(|| needed("a whole number from 1 to 1024"))?;
                }
                "memory" => {
                    let bytes = value.extract().ok().filter(|n| *n >= 1 << 20);
                    asked.memory = bytes.ok_or_else(|| needed("at least 1 MiB, in bytes,"))?;
                }
                _ => return Err(argument(py, format!("`run` has no option `{name}`"))),
            }
        }
        let refuse = |reason: &str| Err(argument(py, reason));
        coverage::check_one(py, asked.changes.coverage.is_some(), asked.factor.is_some())?;
        if asked.changes.validate && asked.changes.trials.is_some() {
            return refuse("`validate` finds the number of trials; leave `trials` out");
        }
        Ok(asked)
    }

    /// What is asked for beats the file, as on the command line.
    fn settings(&self, task: &mut Task) {
        let of_file = task.settings.coverage;
        let factor = self.factor.map(|factor| of_file.with_factor(factor));
        let coverage = self.changes.coverage.or(factor);
        task.settings = SettingsChanges { coverage, ..self.changes }.applied(task.settings);
    }
}

/// A number of trials, a whole float or a text such as `1e6` as well.
fn trials(value: &Bound<'_, PyAny>) -> Option<Trials> {
    if value.extract::<String>().is_ok_and(|text| text == "adaptive") {
        return Some(Trials::Adaptive);
    }
    let count: f64 = value.extract().ok()?;
    let right = count.fract() == 0.0 && (0.0..=1e12).contains(&count) && count != 1.0;
    right.then_some(Trials::Fixed(count as u64))
}

#[pymethods]
impl Model {
    #[new]
    #[pyo3(signature = (name, text, folder="", held=Vec::new(), allow=Vec::new(), replaced=Vec::new(), accept_changed=false, readings=None))]
    #[allow(clippy::too_many_arguments)] // it is only called by the package
    fn new(
        py: Python<'_>,
        name: &str,
        text: &str,
        folder: &str,
        held: Vec<(String, Vec<u8>)>,
        allow: Vec<PathBuf>,
        replaced: Vec<String>,
        accept_changed: bool,
        readings: Option<(String, Vec<u8>)>,
    ) -> PyResult<Self> {
        let (name, text) = (name.to_owned(), text.to_owned());
        let folder = PathBuf::from(folder);
        // a text of another name than a file's is none
        let path = Some(Path::new(&name)).filter(|path| path.is_file()).map(Path::to_owned);
        let (allowed, of) = (allow, replaced);
        let source = Source {
            name,
            text,
            folder,
            held,
            allowed,
            replaced: of,
            accept_changed,
            readings,
            path,
        };
        let overrides = source.replaced.iter().map(|text| {
            let needed =
                || argument(py, format!("`{text}`: NAME=VALUE or NAME.field=VALUE is needed"));
            Override::parse(text).ok_or_else(needed)
        });
        let overrides = overrides.collect::<PyResult<Vec<Override>>>()?;
        let read = || {
            let files = application().files().allowing(&source.allowed);
            let files = files.accepting_changed_results(source.accept_changed);
            let readings = source.readings.as_ref();
            let readings = readings.map(|(name, content)| ReadingsFile::of(name, content.clone()));
            let readings = readings.transpose()?;
            let files = files.holding(&source.held).with_readings(readings.as_ref());
            files.model_text(&source.name, &source.text, &source.folder, &overrides)
        };
        let has_none = |key| !source.text.contains(key);
        let is_short = source.text.len() <= SHORT && ["\"file\"", "\"fits\""].iter().all(has_none);
        let read = if is_short {
            at_once(py, read)?
        } else {
            // on threads of this process: a forked child has none of its parent's
            supervised_within(py, &AtomicBool::new(false), read)?
        };
        let given = source.held.iter().chain(&source.readings).map(|(name, _)| name.as_str());
        let given: Vec<&str> = given.collect();
        let file = read.map_err(|found| failed_with(py, &Failure::Diagnostics(found), &given))?;
        let provenance = Provenance::of(&file.source.text, &file.files);
        Ok(Self {
            source: Arc::new(source),
            file: Arc::new(file),
            provenance: Arc::new(provenance),
        })
    }

    /// Reads a file from the disk.
    #[staticmethod]
    #[pyo3(signature = (path, allow=Vec::new(), replaced=Vec::new(), accept_changed=false))]
    fn load(
        py: Python<'_>,
        path: PathBuf,
        allow: Vec<PathBuf>,
        replaced: Vec<String>,
        accept_changed: bool,
    ) -> PyResult<Self> {
        let name = path.display().to_string();
        let folder = path.parent().unwrap_or(Path::new("")).display().to_string();
        let bytes = std::fs::File::open(&path).ok().and_then(|f| bytes::of(f, bytes::MOST).ok());
        match bytes.and_then(|bytes| bytes::text(&bytes).ok().map(|text| text.into_owned())) {
            Some(text) => Self::new(
                py,
                &name,
                &text,
                &folder,
                Vec::new(),
                allow,
                replaced,
                accept_changed,
                None,
            ),
            // the reader of files says why, with its place
            None => Err(match application().files().model(&path, &[]) {
                Err(found) => failed(py, &Failure::Diagnostics(found)),
                Ok(_) => argument(py, format!("{name}: it cannot be read")),
            }),
        }
    }

    /// All that the model is read from, in the order of the constructor's arguments. Files that it names
    /// are there with the content that was read, so that it can be read again elsewhere.
    #[getter]
    fn source<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let Source {
            name, text, folder, held, allowed, replaced, accept_changed, readings, ..
        } = &*self.source;
        let is_readings = |name: &str| readings.as_ref().is_some_and(|(own, _)| own == name);
        let known = |name: &str| is_readings(name) || held.iter().any(|(held, _)| held == name);
        let read = self.file.files.iter().filter(|(name, _)| !known(name));
        let held: Vec<(String, Bound<'_, pyo3::types::PyBytes>)> = held
            .iter()
            .chain(read)
            .map(|(name, bytes)| (name.clone(), pyo3::types::PyBytes::new(py, bytes)))
            .collect();
        let folder = folder.display().to_string();
        let bytes = |content: &Vec<u8>| pyo3::types::PyBytes::new(py, content);
        let readings = readings.as_ref().map(|(name, content)| (name.clone(), bytes(content)));
        (name, text, folder, held, allowed, replaced, accept_changed, readings).into_pyobject(py)
    }

    #[getter]
    fn title(&self) -> &str {
        &self.file.task.title
    }

    /// Names and units of the inputs.
    #[getter]
    fn inputs(&self) -> Vec<(String, String)> {
        let inputs = self.file.task.model.inputs.iter().map(|input| &input.quantity);
        inputs.map(|of| (of.name.clone(), of.unit.text().to_owned())).collect()
    }

    /// Names and units of the outputs.
    #[getter]
    fn outputs(&self) -> Vec<(String, String)> {
        let outputs = self.file.task.model.outputs.iter().map(|output| &output.quantity);
        outputs.map(|of| (of.name.clone(), of.unit.text().to_owned())).collect()
    }

    /// Names and units of the conditions.
    #[getter]
    fn conditions(&self) -> Vec<(String, String)> {
        let conditions = self.file.task.model.conditions.iter();
        conditions.map(|of| (of.name.clone(), of.unit.text().to_owned())).collect()
    }

    #[getter]
    fn rows(&self) -> usize {
        self.file.task.rows.len()
    }

    /// Names of the random variables: inputs, and `input/component` where an input has components.
    #[getter]
    fn variables(&self) -> Vec<String> {
        self.file.task.variables.iter().map(|variable| variable.name.clone()).collect()
    }

    /// Codes, places and texts of the notes on what was read.
    #[getter]
    fn warnings(&self) -> Vec<Note> {
        notes(&self.file.warnings)
    }

    /// Sets of values of the variables and conditions, and what the formulas give at them: a column for
    /// each variable, condition and output, in their units. For each of some rows they are the
    /// estimates and then the first of its draws, `count` of all rows together or a few more.
    #[allow(clippy::type_complexity)] // two lists of what stands in the lines above
    fn draws<'py>(
        &self,
        py: Python<'py>,
        count: usize,
    ) -> PyResult<(Vec<Bound<'py, PyArray1<f64>>>, Vec<Bound<'py, PyArray1<f64>>>)> {
        let task = &self.file.task;
        let found = at_once(py, || draws::draws(task, count))?;
        let columns =
            |of: Vec<Vec<f64>>| of.into_iter().map(|v| PyArray1::from_vec(py, v)).collect();
        Ok((columns(found.variables), columns(found.outputs)))
    }

    /// Evaluates the model.
    #[pyo3(signature = (options, progress=None, function=None))]
    fn run(
        &self,
        py: Python<'_>,
        options: &Bound<'_, PyDict>,
        progress: Option<&Bound<'_, PyAny>>,
        function: Option<Py<PyAny>>,
    ) -> PyResult<Run> {
        let asked = RunRequest::of(py, options)?;
        let task = self.asked_task(py, &asked)?;
        let file = Arc::clone(&self.file);
        let counted = progress.is_some();
        let is_brief = progress.is_none() && function.is_none() && is_brief(&task);
        let work = move |watch: &Watch| evaluated(&file, task, &asked, counted, function, watch);
        let found = match is_brief {
            true => at_once(py, || work(&Watch::default()))?,
            false => supervised(py, progress, work)?,
        };
        let found = match found {
            Ok(found) => found,
            Err(Failed::Python(raised)) => return Err(raised),
            Err(Failed::Evaluation(failure)) => return Err(failed(py, &failure)),
        };
        let Evaluated { task, evaluation, notes, threads, memory } = found;
        let provenance = Arc::clone(&self.provenance);
        let (file, replaced) = (Arc::clone(&self.file), self.source.replaced.clone());
        let quantiles = None;
        let ran =
            Ran { file, task, evaluation, quantiles, notes, provenance, replaced, threads, memory };
        Ok(Run::of(ran))
    }

    /// The run in parts, for executors.
    #[pyo3(signature = (options, function=None))]
    fn parts(
        &self,
        py: Python<'_>,
        options: &Bound<'_, PyDict>,
        function: Option<Py<PyAny>>,
    ) -> PyResult<Parts> {
        let asked = RunRequest::of(py, options)?;
        let task = self.asked_task(py, &asked)?;
        let of = (&self.file, task, &self.provenance);
        Ok(Parts::new(of, &self.source, (asked.threads, asked.memory), function))
    }

    fn __repr__(&self) -> String {
        format!("<gumption._gumption.Model {:?}>", self.source.name)
    }
}

impl Model {
    /// The same of another file.
    pub(crate) fn with_file(&self, file: ModelFile) -> Self {
        let (source, provenance) = (Arc::clone(&self.source), Arc::clone(&self.provenance));
        Self { source, file: Arc::new(file), provenance }
    }

    /// The task with what is asked for.
    fn asked_task(&self, py: Python<'_>, asked: &RunRequest) -> PyResult<Task> {
        let mut task = self.file.task.clone();
        asked.settings(&mut task);
        if asked.changes.rule.is_some() && task.settings.trials != Trials::Adaptive {
            let reason = "`rule` is about adaptive runs; add `trials=\"adaptive\"`";
            return Err(argument(py, reason));
        }
        Ok(task)
    }
}

struct Evaluated {
    task: Task,
    evaluation: Evaluation,
    notes: Vec<gumption::task::Warning>,
    threads: usize,
    memory: usize,
}

enum Failed {
    Python(PyErr),
    Evaluation(Failure),
}

fn evaluated(
    file: &ModelFile,
    mut task: Task,
    asked: &RunRequest,
    counted: bool,
    function: Option<Py<PyAny>>,
    watch: &Watch,
) -> Result<Evaluated, Failed> {
    let called = function.map(|f| Arc::new(PythonFunction::new(f, Arc::clone(&watch.stop))));
    if let Some(called) = &called {
        task.function = Some(called.clone());
    }
    let RunRequest { threads, memory, .. } = *asked;
    let advance = |trials: u64| {
        watch.done.fetch_add(trials, std::sync::atomic::Ordering::Relaxed);
    };
    let control = Control::default().with_threads(threads).with_memory(memory);
    let control = control.with_stop(&watch.stop);
    let control = if counted { control.with_progress(&advance) } else { control };
    let evaluation = evaluate(&task, &control);
    if let Some(raised) = called.and_then(|called| called.raised()) {
        return Err(Failed::Python(raised));
    }
    let evaluation = evaluation.map_err(|error| {
        Failed::Evaluation(Failure::Diagnostics(file.evaluation_failed(error.to_string())))
    })?;
    let mut notes = file.warnings.clone();
    notes.extend(warnings(&task, &evaluation));
    Ok(Evaluated { task, evaluation, notes, threads, memory })
}
