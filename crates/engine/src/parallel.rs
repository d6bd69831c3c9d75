//! Threads, and loops over independent items on all threads of the current pool.
//!
//! A system may refuse threads: a container with a limit of processes, `ulimit -u`. Then the
//! calling thread does the work, and the answer is the same; [`refused`] gives the reason.
//!
//! A loop of rayon's iterators is compiled for every function that it calls, ten kilobytes each.
//! Here the scheduling is compiled once, and only the loop body for each use. The cost is a lock
//! and a call per item, which is negligible for items of a microsecond. Loops with shorter items,
//! and loops that keep sums for each thread, use rayon.

use std::convert::Infallible;
use std::error::Error;
use std::mem;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

use crate::threads::OfProcess;

/// The system's message when it first refused a thread.
static REFUSED: OnceLock<String> = OnceLock::new();

/// Why the system refused threads, if it did: since then one thread does the work.
pub fn refused() -> Option<&'static str> {
    REFUSED.get().map(String::as_str)
}

/// Whether the system provides one more thread now.
///
/// # Errors
/// Why it does not.
pub fn spare_thread() -> std::io::Result<()> {
    std::thread::Builder::new().spawn(|| ()).map(drop)
}

/// Threads that loops run on.
#[derive(Debug)]
pub struct Pool(Kind);

#[derive(Debug)]
enum Kind {
    /// The pool of the calling thread, or rayon's global one.
    Callers,
    Own(ThreadPool),
    /// The calling thread alone.
    Alone,
}

impl Pool {
    /// A new pool with `threads` threads, 0 for as many as the machine has; if the system provides
    /// none, only the calling thread.
    pub fn new(threads: usize) -> Self {
        let made = ThreadPoolBuilder::new().num_threads(threads).build();
        Self(made.map_or_else(|error| refuse(&error), Kind::Own))
    }

    /// Does work on the threads.
    pub fn install<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        match &self.0 {
            Kind::Own(pool) => return pool.install(work),
            Kind::Callers => enter(),
            Kind::Alone => alone(),
        }
        work()
    }

    /// Whether it is a separate pool with this number of threads.
    fn is_of(&self, threads: usize) -> bool {
        matches!(&self.0, Kind::Own(pool) if pool.current_num_threads() == threads)
    }
}

/// A pool with this number of threads: the last one, if it has as many. New threads begin on the
/// processor of the thread that starts them and may wait there for milliseconds, as long as a run
/// of a million trials takes. 0 means the caller's pool, or rayon's global one.
pub fn pool(threads: usize) -> Arc<Pool> {
    static LAST: OfProcess<Pool> = OfProcess::new();
    if threads == 0 {
        enter();
        return Arc::new(Pool(Kind::Callers));
    }
    let made = LAST.of(|pool| pool.is_of(threads), || Ok::<_, Infallible>(Pool::new(threads)));
    let Ok(pool) = made;
    pool
}

/// Ensures that the calling thread has a pool: its own, or rayon's global one, whose first use
/// panics if the system provides no threads.
fn enter() {
    static HAS_GLOBAL: OnceLock<bool> = OnceLock::new();
    if rayon::current_thread_index().is_some() {
        return;
    }
    let has_global = HAS_GLOBAL.get_or_init(|| match ThreadPoolBuilder::new().build_global() {
        // an error without a source: another thread has created it
        Err(error) if error.source().is_some() => {
            refuse(&error);
            false
        }
        _ => true,
    });
    if !has_global {
        alone();
    }
}

/// Remembers what the system said.
fn refuse(error: &ThreadPoolBuildError) -> Kind {
    REFUSED.get_or_init(|| error.to_string());
    Kind::Alone
}

/// Makes the calling thread a permanent pool of one, unless it is in a pool.
fn alone() {
    if rayon::current_thread_index().is_none() {
        let pool = ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
        mem::forget(pool);
    }
}

/// An item before its call, and its result.
enum Slot<I, T> {
    Waiting(I),
    Taken,
    Done(T),
}

/// Applies a function to each item; the results are in the order of the items.
pub fn map<I: Send, T: Send>(
    items: impl IntoIterator<Item = I>,
    of: impl Fn(I) -> T + Sync,
) -> Vec<T> {
    let slots: Vec<Mutex<Slot<I, T>>> =
        items.into_iter().map(|item| Mutex::new(Slot::Waiting(item))).collect();
    each(slots.len(), &|place| {
        // no two calls have the same index: the lock is never contended
        let mut slot = slots[place].lock().unwrap_or_else(PoisonError::into_inner);
        if let Slot::Waiting(item) = mem::replace(&mut *slot, Slot::Taken) {
            *slot = Slot::Done(of(item));
        }
    });
    let done = slots.into_iter().filter_map(|slot| {
        match slot.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Slot::Done(value) => Some(value),
            Slot::Waiting(_) | Slot::Taken => None,
        }
    });
    done.collect()
}

/// The same with working memory; no more are created than there are calls at a time.
pub fn map_with<W: Send, I: Send, T: Send>(
    items: impl IntoIterator<Item = I>,
    room: impl Fn() -> W + Sync,
    of: impl Fn(&mut W, I) -> T + Sync,
) -> Vec<T> {
    let rooms: Mutex<Vec<W>> = Mutex::new(Vec::new());
    map(items, |item| {
        let free = rooms.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let mut own = free.unwrap_or_else(&room);
        let value = of(&mut own, item);
        rooms.lock().unwrap_or_else(PoisonError::into_inner).push(own);
        value
    })
}

/// Calls a function with every number below `count`.
fn each(count: usize, of: &(dyn Fn(usize) + Sync)) {
    enter();
    (0..count).into_par_iter().for_each(of);
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// A thousand items that are moved, in nested loops, in their order; and slots that are
    /// written.
    #[test]
    fn items_keep_their_order() {
        let texts = (0..1000).map(|n| n.to_string());
        let found = map(texts, |text| map(0..text.len(), |n| text[n..].to_owned()).join(","));
        assert_eq!((found[7].as_str(), found[123].as_str()), ("7", "123,23,3"));
        assert_eq!(found.len(), 1000);
        let mut values = vec![1.0; 100];
        map(values.iter_mut().enumerate(), |(n, value)| *value += n as f64);
        assert!(values.iter().enumerate().all(|(n, value)| *value == 1.0 + n as f64));
        assert!(map(Vec::<u8>::new(), |n| n).is_empty());
    }

    /// No more working memories than threads, and every item has one to itself.
    #[test]
    fn rooms_are_used_again() {
        let pool = Pool::new(3);
        let made = AtomicUsize::new(0);
        let room = || {
            made.fetch_add(1, Ordering::Relaxed);
            Vec::new()
        };
        let of = |room: &mut Vec<usize>, n: usize| {
            room.clear();
            room.extend(0..n);
            room.len()
        };
        let found = pool.install(|| map_with(0..1000, room, of));
        assert!(found.into_iter().eq(0..1000));
        assert!((1..=3).contains(&made.load(Ordering::Relaxed)));
    }
}
