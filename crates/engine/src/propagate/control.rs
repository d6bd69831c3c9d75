//! What the caller of a long computation keeps in hand.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::number::CodePath;

/// Threads, memory, progress and a way to stop. The default uses the caller's thread pool, keeps at
/// most 64 MiB of trial values, reports nothing and never stops early.
///
/// ```
/// use gumption_engine::propagate::Control;
///
/// let control = Control::default().with_threads(2).with_memory(1 << 20);
/// assert_eq!((control.threads, control.memory), (2, 1 << 20));
/// ```
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct Control<'a> {
    /// Number of threads of a pool of its own; 0 for the rayon pool of the caller, which has as many
    /// as the machine unless the caller made another.
    pub threads: usize,
    /// Bytes of trial values that may be kept at a time.
    pub memory: usize,
    /// The compiled form of the inner loops; all give the same bits.
    pub path: CodePath,
    /// When this becomes true, the run ends early and hands back what it has.
    pub stop: Option<&'a AtomicBool>,
    /// Called now and then, from any thread, with the number of trials finished since the last
    /// call.
    pub progress: Option<&'a (dyn Fn(u64) + Sync)>,
}

impl Default for Control<'_> {
    fn default() -> Self {
        Self { threads: 0, memory: 64 << 20, path: CodePath::best(), stop: None, progress: None }
    }
}

impl std::fmt::Debug for Control<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Control")
            .field("threads", &self.threads)
            .field("memory", &self.memory)
            .field("path", &self.path)
            .finish_non_exhaustive()
    }
}

impl<'a> Control<'a> {
    /// On so many threads; see [`Control::threads`].
    #[must_use]
    pub fn with_threads(self, threads: usize) -> Self {
        Self { threads, ..self }
    }

    /// With so many bytes of trial values at a time.
    #[must_use]
    pub fn with_memory(self, memory: usize) -> Self {
        Self { memory, ..self }
    }

    /// On this code path.
    #[must_use]
    pub fn with_path(self, path: CodePath) -> Self {
        Self { path, ..self }
    }

    /// Stopped by this.
    #[must_use]
    pub fn with_stop(self, stop: &'a AtomicBool) -> Self {
        Self { stop: Some(stop), ..self }
    }

    /// Reporting to this.
    #[must_use]
    pub fn with_progress(self, progress: &'a (dyn Fn(u64) + Sync)) -> Self {
        Self { progress: Some(progress), ..self }
    }

    /// Whether the caller wants the computation to end.
    pub fn is_stopped(&self) -> bool {
        self.stop.is_some_and(|stop| stop.load(Ordering::Relaxed))
    }

    /// Reports so many more finished trials.
    pub fn advance(&self, trials: u64) {
        if let Some(progress) = self.progress {
            progress(trials);
        }
    }
}
