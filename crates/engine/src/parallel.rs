//! Threads, and loops over independent items on all threads of the current pool.
//!
//! A system may refuse threads: a container with a limit of processes, `ulimit -u`. Then whoever asks
//! is the one thread, and the answer is the same; [`refused`] says why.
//!
//! A loop of rayon's iterators is compiled for every function that it calls, ten kilobytes each; here
//! the scheduling is compiled once, and what is compiled for each loop is the loop. It costs a lock and a
//! call per item, which items of a microsecond do not notice. Loops whose items are shorter, and those
//! that keep sums for each thread, stay with rayon.

use std::convert::Infallible;
use std::error::Error;
use std::mem;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

use crate::threads::OfProcess;

/// What the system said when it first refused a thread.
static REFUSED: OnceLock<String> = OnceLock::new();

/// Why the system gave no threads, if that has happened: one thread does the work since.
pub fn refused() -> Option<&'static str> {
    REFUSED.get().map(String::as_str)
}

/// Whether the system gives one more thread now.
///
/// # Errors
/// Why it does not.
pub fn spare_thread() -> std::io::Result<()> {
    std::thread::Builder::new().spawn(|| ()).map(drop)
}

/// Threads that loops run on.
#[derive(Debug)]
pub struct Pool(PoolKind);

#[derive(Debug)]
enum PoolKind {
    /// The pool that the calling thread is in, and rayon's global one if it is in none.
    Callers,
    Own(ThreadPool),
    /// The calling thread alone.
    Alone,
}

impl Pool {
    /// A pool of so many threads for itself, 0 for as many as the machine has; where the system gives
    /// none, the calling thread alone.
    pub fn new(threads: usize) -> Self {
        let made = ThreadPoolBuilder::new().num_threads(threads).build();
        Self(made.map_or_else(|error| refuse(&error), PoolKind::Own))
    }

    /// Does work on the threads.
    pub fn install<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        match &self.0 {
            PoolKind::Own(pool) => return pool.install(work),
            PoolKind::Callers => enter(),
            PoolKind::Alone => alone(),
        }
        work()
    }

    /// Whether it is one of so many threads for itself.
    fn is_of(&self, threads: usize) -> bool {
        matches!(&self.0, PoolKind::Own(pool) if pool.current_num_threads() == threads)
    }
}

/// A pool of so many threads: the last one, if it has as many. New threads begin on the processor of
/// the one that starts them and may wait there for milliseconds, as long as a run of a million trials
/// takes. 0 for the pool that the caller is in, rayon's global one if it is in none.
pub fn pool(threads: usize) -> Arc<Pool> {
    static LAST: OfProcess<Pool> = OfProcess::new();
    if threads == 0 {
        enter();
        return Arc::new(Pool(PoolKind::Callers));
    }
    let made = LAST.of(|pool| pool.is_of(threads), || Ok::<_, Infallible>(Pool::new(threads)));
    let Ok(pool) = made;
    pool
}

/// Sees to it that the calling thread has threads: those of the pool that it is in, or of rayon's
/// global one, whose first use by itself panics where the system gives no threads.
fn enter() {
    static HAS_GLOBAL: OnceLock<bool> = OnceLock::new();
    if rayon::current_thread_index().is_some() {
        return;
    }
    let has_global = HAS_GLOBAL.get_or_init(|| match ThreadPoolBuilder::new().build_global() {
        // without a source: somebody else has made it
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
fn refuse(error: &ThreadPoolBuildError) -> PoolKind {
    REFUSED.get_or_init(|| error.to_string());
    PoolKind::Alone
}

/// Makes the calling thread a pool of one for good, unless it is in one.
fn alone() {
    if rayon::current_thread_index().is_none() {
        let pool = ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
        mem::forget(pool);
    }
}

/// An item before its turn, and what became of it.
enum Slot<I, T> {
    Waiting(I),
    Taken,
    Done(T),
}

/// What a function makes of each item, in the order of the items.
pub fn map<I: Send, T: Send>(
    items: impl IntoIterator<Item = I>,
    of: impl Fn(I) -> T + Sync,
) -> Vec<T> {
    let slots: Vec<Mutex<Slot<I, T>>> =
        items.into_iter().map(|item| Mutex::new(Slot::Waiting(item))).collect();
    each(slots.len(), &|place| {
        // no two calls have the same place: the lock is never waited for
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

/// The same with room to work in, of which no more are made than calls go on at a time.
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

    /// A thousand items that move, within one another, in their order; and places that are written to.
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

    /// No more rooms than threads, and every item has one to itself.
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
