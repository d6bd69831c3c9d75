//! What the caller of a long computation keeps in hand.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::number::CodePath;

/// Threads, memory, progress and a way to stop. The default uses all processors, keeps at most
/// 64 MiB of trial values, reports nothing and never stops early.
#[derive(Clone, Copy)]
pub struct Control<'a> {
    /// Number of threads; 0 for as many as the machine has.
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

impl Control<'_> {
    pub fn is_stopped(&self) -> bool {
        self.stop.is_some_and(|stop| stop.load(Ordering::Relaxed))
    }

    pub fn advance(&self, trials: u64) {
        if let Some(progress) = self.progress {
            progress(trials);
        }
    }
}
