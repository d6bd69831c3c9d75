//! Limits long work: in number, in time, and to clients that are still connected.
//!
//! Each piece of work has a flag that stops it. The flag is set when the time is over, when the
//! client disconnects (its future is dropped), and when newer work needs the place.

use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::time::timeout;

/// What a lane holds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    /// Pieces of work at once.
    pub(crate) at_once: usize,
    /// Pieces that wait.
    pub(crate) waiting: usize,
    /// The time limit for one piece of work.
    pub(crate) time: Duration,
    /// How long work may continue after the stop flag before it is abandoned.
    pub(crate) grace: Duration,
    /// The time limit for waiting.
    pub(crate) patience: Duration,
    /// Whether the oldest work is stopped for newer work.
    pub(crate) newest_first: bool,
}

/// The reason why work was not done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Undone {
    /// Too much is going on.
    Busy,
    /// It was stopped and did not end.
    Endless,
    /// It panicked.
    Failed,
}

type Flags = Arc<Mutex<VecDeque<Arc<AtomicBool>>>>;

/// Places for work.
#[derive(Debug)]
pub(crate) struct Lane {
    limits: Limits,
    places: Arc<Semaphore>,
    queue: Arc<Semaphore>,
    /// The flags of running work, the oldest first.
    running: Flags,
}

/// Sets the flag when it is dropped.
struct StopWhenDropped(Arc<AtomicBool>);

impl Drop for StopWhenDropped {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// A place that is occupied until the work ends, whoever waits for it.
struct Place {
    _place: OwnedSemaphorePermit,
    flag: Arc<AtomicBool>,
    running: Flags,
}

impl Drop for Place {
    fn drop(&mut self) {
        lock(&self.running).retain(|flag| !Arc::ptr_eq(flag, &self.flag));
    }
}

fn lock(flags: &Flags) -> MutexGuard<'_, VecDeque<Arc<AtomicBool>>> {
    flags.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Lane {
    pub(crate) fn new(limits: Limits) -> Self {
        let queue = limits.at_once + limits.waiting;
        Self {
            limits,
            places: Arc::new(Semaphore::new(limits.at_once)),
            queue: Arc::new(Semaphore::new(queue)),
            running: Flags::default(),
        }
    }

    /// Runs a piece of work on its own thread.
    pub(crate) async fn run<T: Send + 'static>(
        &self,
        work: impl FnOnce(&Arc<AtomicBool>) -> T + Send + 'static,
    ) -> Result<T, Undone> {
        let _queued = self.queue.try_acquire().map_err(|_| Undone::Busy)?;
        let place = self.place().await?;
        let stop = Arc::clone(&place.flag);
        let _gone = StopWhenDropped(Arc::clone(&stop));
        let mut done = tokio::task::spawn_blocking(move || {
            let work = AssertUnwindSafe(|| work(&place.flag));
            catch_unwind(work).map_err(|_| Undone::Failed)
        });
        if let Ok(ended) = timeout(self.limits.time, &mut done).await {
            return ended.map_err(|_| Undone::Failed)?;
        }
        stop.store(true, Ordering::Relaxed);
        match timeout(self.limits.grace, done).await {
            Ok(ended) => ended.map_err(|_| Undone::Failed)?,
            Err(_) => Err(Undone::Endless),
        }
    }

    async fn place(&self) -> Result<Place, Undone> {
        let places = Arc::clone(&self.places);
        let taken = match Arc::clone(&places).try_acquire_owned() {
            Ok(taken) => taken,
            Err(_) => {
                if self.limits.newest_first {
                    self.stop_oldest();
                }
                let waited = timeout(self.limits.patience, places.acquire_owned()).await;
                waited.map_err(|_| Undone::Busy)?.map_err(|_| Undone::Busy)?
            }
        };
        let flag = Arc::new(AtomicBool::new(false));
        lock(&self.running).push_back(Arc::clone(&flag));
        Ok(Place { _place: taken, flag, running: Arc::clone(&self.running) })
    }

    fn stop_oldest(&self) {
        let running = lock(&self.running);
        if let Some(flag) = running.iter().find(|flag| !flag.load(Ordering::Relaxed)) {
            flag.store(true, Ordering::Relaxed);
        }
    }

    /// Stops everything.
    pub(crate) fn stop(&self) {
        self.queue.close();
        self.places.close();
        lock(&self.running).iter().for_each(|flag| flag.store(true, Ordering::Relaxed));
    }
}

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use super::*;

    fn limits() -> Limits {
        Limits {
            at_once: 2,
            waiting: 2,
            time: Duration::from_secs(60),
            grace: Duration::from_secs(60),
            patience: Duration::from_secs(60),
            newest_first: true,
        }
    }

    fn until_stopped(stop: &Arc<AtomicBool>) -> bool {
        let begun = Instant::now();
        while !stop.load(Ordering::Relaxed) && begun.elapsed() < Duration::from_secs(60) {
            std::thread::sleep(Duration::from_millis(1));
        }
        stop.load(Ordering::Relaxed)
    }

    fn block_on<T>(work: impl Future<Output = T>) -> T {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_time().build();
        runtime.unwrap().block_on(work)
    }

    #[test]
    fn the_oldest_is_stopped_for_a_newer_one() {
        block_on(async {
            let lane = Arc::new(Lane::new(limits()));
            let slow = |lane: &Arc<Lane>| {
                let lane = Arc::clone(lane);
                tokio::spawn(async move { lane.run(until_stopped).await })
            };
            let (first, second) = (slow(&lane), slow(&lane));
            tokio::time::sleep(Duration::from_millis(20)).await;
            assert_eq!(lane.run(|_| 7).await, Ok(7));
            assert_eq!(first.await.unwrap(), Ok(true));
            assert!(!second.is_finished());
            lane.stop();
            assert_eq!(second.await.unwrap(), Ok(true));
            assert_eq!(lane.run(|_| 7).await, Err(Undone::Busy));
        });
    }

    #[test]
    fn who_hangs_up_stops_his_work_and_time_does() {
        block_on(async {
            let lane = Arc::new(Lane::new(limits()));
            let (sender, receiver) = std::sync::mpsc::channel();
            let of_this = Arc::clone(&lane);
            let dropped = tokio::spawn(async move {
                of_this.run(move |stop| sender.send(until_stopped(stop)).unwrap()).await
            });
            tokio::time::sleep(Duration::from_millis(20)).await;
            dropped.abort();
            let _ = dropped.await;
            let stopped = tokio::task::spawn_blocking(move || receiver.recv().unwrap()).await;
            assert!(stopped.unwrap());

            let time = Duration::from_millis(10);
            let lane = Lane::new(Limits { time, ..limits() });
            assert_eq!(lane.run(until_stopped).await, Ok(true));
        });
    }
}
