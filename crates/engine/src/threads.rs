//! Pools of threads belong to one process: a forked child does not have them.

use std::sync::{Arc, Mutex, TryLockError};

/// A pool of threads that is kept from one call to the next, for the process that made it.
///
/// A forked child inherits the memory of its parent but none of its threads: work for its parent's
/// pool would wait forever. Here a child creates its own pool.
#[derive(Debug)]
pub struct OfProcess<P>(Mutex<Option<(u32, Arc<P>)>>);

impl<P> Default for OfProcess<P> {
    fn default() -> Self {
        Self::new()
    }
}

impl<P> OfProcess<P> {
    /// No pool yet.
    pub const fn new() -> Self {
        Self(Mutex::new(None))
    }

    /// The stored pool, if this process created it and it fits; otherwise a new one, which replaces
    /// it.
    ///
    /// # Errors
    /// Those of `make`.
    pub fn of<E>(
        &self,
        fits: impl FnOnce(&P) -> bool,
        make: impl FnOnce() -> Result<P, E>,
    ) -> Result<Arc<P>, E> {
        let process = std::process::id();
        // another thread may have held the lock when this process was forked, so do not wait for it
        let mut kept = match self.0.try_lock() {
            Ok(kept) => kept,
            Err(TryLockError::Poisoned(kept)) => kept.into_inner(),
            Err(TryLockError::WouldBlock) => return make().map(Arc::new),
        };
        if let Some((of, pool)) = &*kept
            && *of == process
            && fits(pool)
        {
            return Ok(Arc::clone(pool));
        }
        let made = Arc::new(make()?);
        if let Some((of, pool)) = kept.replace((process, Arc::clone(&made)))
            && of != process
        {
            // waiting for the end of threads that do not exist would take forever
            std::mem::forget(pool);
        }
        Ok(made)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::{ThreadPool, ThreadPoolBuilder};

    #[test]
    fn a_pool_is_kept_while_it_fits_and_belongs_to_this_process() {
        let own: OfProcess<ThreadPool> = OfProcess::new();
        let of = |threads: usize| {
            let make = || ThreadPoolBuilder::new().num_threads(threads).build();
            own.of(|pool| pool.current_num_threads() == threads, make).unwrap()
        };
        let first = of(2);
        assert!(Arc::ptr_eq(&first, &of(2)));
        let other = of(1);
        assert_eq!((other.current_num_threads(), first.current_num_threads()), (1, 2));
        // as a forked child finds it
        own.0.lock().unwrap().as_mut().unwrap().0 ^= 1;
        let again = of(1);
        assert!(!Arc::ptr_eq(&other, &again) && Arc::ptr_eq(&again, &of(1)));
        // while another thread makes one
        let held = own.0.lock().unwrap();
        assert_eq!(of(1).install(rayon::current_num_threads), 1);
        drop(held);
    }
}
