//! Long computations: without the interpreter's lock, on threads of our own, and watched for Ctrl-C.

use std::convert::Infallible;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use gumption::threads::OfProcess;
use pyo3::exceptions::{PyOSError, PyRuntimeError};
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// How often signals are looked at.
const LOOK: Duration = Duration::from_millis(30);

/// How long a computation that was told to stop is waited for. What cannot be stopped ends by itself,
/// unheard.
const PATIENCE: Duration = Duration::from_millis(60);

fn pool() -> PyResult<Arc<ThreadPool>> {
    static POOL: OfProcess<ThreadPool> = OfProcess::new();
    let named = |number| format!("gumption-{number}");
    let pool = POOL.of(|_| true, || ThreadPoolBuilder::new().thread_name(named).build());
    pool.map_err(|error| PyOSError::new_err(format!("cannot start threads: {error}")))
}

/// What a computation is watched by.
#[derive(Debug, Default)]
pub(crate) struct Watch {
    pub(crate) stop: Arc<AtomicBool>,
    pub(crate) done: AtomicU64,
}

/// Does some work on the threads of the pool while other Python threads run on. Ctrl-C, or whatever
/// exception a handler of signals raises, sets the flag of the watch and is raised; `progress` is
/// called now and then with what the work has counted.
///
/// # Errors
/// What a handler of signals raises or `progress` does; a panic of the work.
pub(crate) fn supervised<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Watch) -> T + Send + 'static,
) -> PyResult<T> {
    let watch = Arc::new(Watch::default());
    // called from within a computation, as by a model's function: the threads are busy with that
    if rayon::current_thread_index().is_some() {
        return Ok(py.detach(|| work(&watch)));
    }
    let (give, take) = channel();
    let given = Arc::clone(&watch);
    pool()?.spawn(move || {
        let done = catch_unwind(AssertUnwindSafe(|| work(&given)));
        // where nobody waits any more, nothing is to be told
        let _ = give.send(Message::<Infallible, T>::Done(done));
    });
    waited(py, progress, &watch, take, &mut |never| match never {})
}

/// Does work of less than a few milliseconds that starts no threads in the calling thread: waking another
/// one takes as long as the work.
///
/// # Errors
/// A panic of the work.
pub(crate) fn at_once<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    let done = py.detach(|| catch_unwind(AssertUnwindSafe(work)));
    done.map_err(|_| PyRuntimeError::new_err("an internal error of gumption"))
}

/// The same for work that borrows: it is waited for also where an exception is raised, which the flag
/// makes short.
///
/// # Errors
/// What a handler of signals raises; a panic of the work.
pub(crate) fn supervised_within<T: Send>(
    py: Python<'_>,
    stop: &AtomicBool,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    if rayon::current_thread_index().is_some() {
        return Ok(py.detach(work));
    }
    let pool = pool()?;
    let (give, take) = sync_channel(1);
    pool.in_place_scope(|scope| {
        scope.spawn(move |_| {
            let _ = give.send(catch_unwind(AssertUnwindSafe(work)));
        });
        let take = Mutex::new(take);
        let wait = |time: Duration| {
            let take = take.lock().unwrap_or_else(PoisonError::into_inner);
            take.recv_timeout(time)
        };
        let mut signalled = Ok(());
        loop {
            match py.detach(|| wait(LOOK)) {
                Ok(Ok(found)) => return signalled.map(|()| found),
                Ok(Err(_)) | Err(RecvTimeoutError::Disconnected) => {
                    return Err(PyRuntimeError::new_err("an internal error of gumption"));
                }
                Err(RecvTimeoutError::Timeout) => {
                    if signalled.is_ok() {
                        signalled = py.check_signals();
                        stop.fetch_or(signalled.is_err(), Ordering::Relaxed);
                    }
                }
            }
        }
    })
}

/// What work on threads of its own asks of the thread that waits for it.
enum Message<A, T> {
    Asked(A),
    Done(std::thread::Result<T>),
}

/// The same for work that asks for something while it goes on: `answer` is called with it in the thread that
/// calls this, where a user's function expects to be called. What `answer` raises stops the work and is raised.
///
/// # Errors
/// What a handler of signals raises, `progress` or `answer` does; a panic of the work.
pub(crate) fn supervised_asking<A: Send + 'static, T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    answer: &mut dyn FnMut(A) -> PyResult<()>,
    work: impl FnOnce(&Watch, Box<dyn Fn(A) -> bool + Send>) -> T + Send + 'static,
) -> PyResult<T> {
    let watch = Arc::new(Watch::default());
    let (give, take) = channel();
    let given = Arc::clone(&watch);
    let asks = give.clone();
    let ask = Box::new(move |asked| asks.send(Message::Asked(asked)).is_ok());
    // a thread of its own, as one of the pool may be who waits
    let pool = if rayon::current_thread_index().is_some() { None } else { Some(pool()?) };
    let worker = std::thread::Builder::new().name("gumption-diagnosis".to_owned());
    let started = worker.spawn(move || {
        let work = AssertUnwindSafe(|| match pool {
            Some(pool) => pool.install(|| work(&given, ask)),
            None => work(&given, ask),
        });
        let _ = give.send(Message::Done(catch_unwind(work)));
    });
    started.map_err(|error| PyOSError::new_err(format!("cannot start a thread: {error}")))?;
    waited(py, progress, &watch, take, answer)
}

/// Waits for work on other threads, and answers what it asks.
fn waited<A: Send, T: Send>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    watch: &Watch,
    take: Receiver<Message<A, T>>,
    answer: &mut dyn FnMut(A) -> PyResult<()>,
) -> PyResult<T> {
    let take = Mutex::new(take);
    let wait = |time: Duration| {
        let take = take.lock().unwrap_or_else(PoisonError::into_inner);
        take.recv_timeout(time)
    };
    loop {
        let looked = match py.detach(|| wait(LOOK)) {
            Ok(Message::Asked(asked)) => answer(asked).and_then(|()| tell(progress, watch)),
            Ok(Message::Done(Ok(found))) => {
                tell(progress, watch)?;
                return Ok(found);
            }
            Ok(Message::Done(Err(_))) | Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err("an internal error of gumption"));
            }
            Err(RecvTimeoutError::Timeout) => {
                py.check_signals().and_then(|()| tell(progress, watch))
            }
        };
        if let Err(raised) = looked {
            watch.stop.store(true, Ordering::Relaxed);
            let _ = py.detach(|| wait(PATIENCE));
            return Err(raised);
        }
    }
}

fn tell(progress: Option<&Bound<'_, PyAny>>, watch: &Watch) -> PyResult<()> {
    match progress {
        Some(progress) => progress.call1((watch.done.load(Ordering::Relaxed),)).map(|_| ()),
        None => Ok(()),
    }
}
