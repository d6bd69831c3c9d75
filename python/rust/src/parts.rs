//! A run that executors of Python make: its passes and parts as bytes, made anywhere and merged here.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use gumption::command::{Failure, MergedRun, PartedRun, PartsFolder};
use gumption::file::{ModelFile, Override, SharedRun};
use gumption::propagate::{Control, warnings};
use gumption::report::Provenance;
use gumption::task::Task;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors::{argument, failed};
use crate::function::PythonFunction;
use crate::model::Source;
use crate::run::{Ran, Run};
use crate::supervised::supervised_within;

/// A run in parts.
#[pyclass(frozen, module = "gumption._gumption")]
#[derive(Debug)]
pub(crate) struct Parts {
    file: Arc<ModelFile>,
    task: Arc<Task>,
    run: Arc<SharedRun>,
    provenance: Arc<Provenance>,
    replaced: Vec<String>,
    threads: usize,
    memory: usize,
    function: Option<Py<PyAny>>,
}

/// What a folder holds of a run: the pass as bytes, and path, first and behind the last block of each
/// part.
type Kept<'py> = (Bound<'py, PyBytes>, Vec<(PathBuf, u64, u64)>);

impl Parts {
    pub(crate) fn new(
        (file, task, provenance): (&Arc<ModelFile>, Task, &Arc<Provenance>),
        source: &Source,
        (threads, memory): (usize, usize),
        function: Option<Py<PyAny>>,
    ) -> Self {
        let overrides: Vec<Override> =
            source.replaced.iter().filter_map(|text| Override::parse(text)).collect();
        let run = SharedRun::new(file, source.path.as_deref(), &overrides, &task.settings, memory);
        Self {
            file: Arc::clone(file),
            task: Arc::new(task),
            run: Arc::new(run),
            provenance: Arc::clone(provenance),
            replaced: source.replaced.clone(),
            threads,
            memory,
            function,
        }
    }

    fn parted<'a>(&'a self, task: &'a Task) -> PartedRun<'a> {
        PartedRun::new(&self.file, task, &self.run)
    }

    fn control<'s>(&self, stop: &'s AtomicBool) -> Control<'s> {
        Control::default().with_threads(self.threads).with_memory(self.memory).with_stop(stop)
    }

    /// The task, with a function of Python where the model is one.
    fn task(&self, py: Python<'_>, stop: &Arc<AtomicBool>) -> (Task, Option<Arc<PythonFunction>>) {
        let mut task = Task::clone(&self.task);
        let function = self.function.as_ref().map(|function| function.clone_ref(py));
        let called = function.map(|f| Arc::new(PythonFunction::new(f, Arc::clone(stop))));
        if let Some(called) = &called {
            task.function = Some(called.clone());
        }
        (task, called)
    }

    /// Does some work on the threads of the pool, with the run and what controls it.
    fn made<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(PartedRun<'_>, &Control<'_>) -> Result<T, Failure> + Send,
    ) -> PyResult<T> {
        let stop = Arc::new(AtomicBool::new(false));
        let (task, called) = self.task(py, &stop);
        let (parted, control) = (self.parted(&task), self.control(&stop));
        let found = supervised_within(py, &stop, || work(parted, &control))?;
        raised(called.as_deref())?;
        found.map_err(|failure| failed(py, &failure))
    }
}

/// What a function of Python raised meanwhile.
fn raised(called: Option<&PythonFunction>) -> PyResult<()> {
    called.and_then(PythonFunction::raised).map_or(Ok(()), Err)
}

fn interrupted() -> PyErr {
    PyRuntimeError::new_err("the part was stopped")
}

#[pymethods]
impl Parts {
    /// How many blocks there are to share.
    #[getter]
    fn blocks(&self, py: Python<'_>) -> PyResult<u64> {
        self.parted(&self.task).blocks().map_err(|failure| failed(py, &failure))
    }

    /// Trials of a block, on the average.
    #[getter]
    fn trials_of_block(&self, py: Python<'_>) -> PyResult<f64> {
        use gumption::task::Trials;
        let blocks = self.blocks(py)? as f64;
        Ok(match self.task.settings.trials {
            Trials::Fixed(trials) => trials as f64 * self.task.rows.len() as f64 / blocks,
            Trials::Adaptive => 0.0,
        })
    }

    /// The first pass.
    fn first<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let file = self.made(py, |run, control| Ok(run.first(control)?.file(&self.run)))?;
        Ok(PyBytes::new(py, &file))
    }

    /// The part of a pass that belongs to the blocks from one to before another.
    fn part<'py>(
        &self,
        py: Python<'py>,
        current: &Bound<'_, PyBytes>,
        start: u64,
        end: u64,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = current.as_bytes();
        let part = self.made(py, |run, control| {
            let pass = run.pass(&"the pass", bytes)?;
            run.part(&pass, start..end, control)
        })?;
        Ok(PyBytes::new(py, &part.ok_or_else(interrupted)?))
    }

    /// Puts the parts of a pass together as an iterator gives them, in any order: the run, or the
    /// next pass as bytes.
    fn merge(
        &self,
        py: Python<'_>,
        current: &Bound<'_, PyBytes>,
        parts: &Bound<'_, PyAny>,
        with_quantiles: bool,
    ) -> PyResult<Py<PyAny>> {
        let stop = Arc::new(AtomicBool::new(false));
        let (task, called) = self.task(py, &stop);
        let (parted, control) = (self.parted(&task), self.control(&stop));
        let bytes = current.as_bytes();
        let of = |failure: Failure| failed(py, &failure);
        let pass = supervised_within(py, &stop, || parted.pass(&"the pass", bytes))?.map_err(of)?;
        let merging = supervised_within(py, &stop, || parted.merging(&pass, control))?;
        raised(called.as_deref())?;
        let mut merging = merging.map_err(of)?;
        for part in parts.try_iter()? {
            let part = part?;
            let part = part.cast::<PyBytes>()?.as_bytes();
            let added = supervised_within(py, &stop, || merging.add(&"a part", part))?;
            added.map_err(of)?;
        }
        if let Some(range) = merging.missing().first() {
            let reason = format!("the blocks {}..{} are missing", range.start, range.end);
            return Err(argument(py, reason));
        }
        let merged = supervised_within(py, &stop, || merging.finish(with_quantiles))?;
        raised(called.as_deref())?;
        let (evaluation, quantiles) = match merged.map_err(of)? {
            MergedRun::Again(next) => {
                return Ok(PyBytes::new(py, &next.file(&self.run)).into_any().unbind());
            }
            MergedRun::Evaluation(evaluation, quantiles) => (*evaluation, quantiles),
        };
        let mut notes = self.file.warnings.clone();
        notes.extend(warnings(&task, &evaluation));
        let run = Run::of(Ran {
            file: Arc::clone(&self.file),
            task,
            evaluation,
            quantiles,
            notes,
            provenance: Arc::clone(&self.provenance),
            replaced: self.replaced.clone(),
            threads: 0,
            memory: self.memory,
        });
        Ok(Py::new(py, run)?.into_any())
    }

    /// What a folder holds of this run; the folder is made where there is none.
    fn kept<'py>(&self, py: Python<'py>, folder: PathBuf) -> PyResult<Kept<'py>> {
        let (pass, parts) = self.made(py, |run, control| {
            let folder = PartsFolder::made(&folder)?;
            let pass = folder.pass(&run, control)?;
            let parts = folder.parts(&run, &pass)?.into_iter();
            let parts: Vec<(PathBuf, u64, u64)> =
                parts.map(|(path, range)| (path.to_owned(), range.start, range.end)).collect();
            Ok((pass.file(&self.run), parts))
        })?;
        Ok((PyBytes::new(py, &pass), parts))
    }

    /// Keeps a part in a folder.
    fn keep(&self, py: Python<'_>, folder: PathBuf, part: &Bound<'_, PyBytes>) -> PyResult<()> {
        let part = part.as_bytes();
        self.made(py, |run, _| run.keep(&folder, part))
    }

    /// Goes on to the next pass in a folder: its parts of the pass before it are no longer needed.
    fn go_on(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        following: &Bound<'_, PyBytes>,
    ) -> PyResult<()> {
        let next = following.as_bytes();
        self.made(py, |run, _| {
            let next = run.pass(&"the pass", next)?;
            let folder = PartsFolder::open(&folder)?;
            folder.write_next(&self.run, &next)?;
            folder.remove_kept(next.number() - 1)
        })
    }
}
