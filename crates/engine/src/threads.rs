//! What belongs to one process: pools of threads, which a forked child does not have.

use std::sync::{Arc, Mutex, TryLockError};

/// A pool of threads that is kept from one call to the next, for the process that made it.
///
/// A child that was forked inherits the memory of its parent and none of its threads: what it hands to
/// its parent's pool waits forever. Here a child makes a pool of its own.
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

    /// The kept pool, if this process made it and it fits; else a new one, which is kept in its place.
    ///
    /// # Errors
    /// Those of `make`.
    pub fn of<E>(
        &self,
        fits: impl FnOnce(&P) -> bool,
        make: impl FnOnce() -> Result<P, E>,
    ) -> Result<Arc<P>, E> {
        let process = std::process::id();
        // another thread may have held the lock when this process was forked: it is not waited for
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
            // waiting for the end of threads that are not there would take forever
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
