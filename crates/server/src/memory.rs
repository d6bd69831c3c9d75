//! Memory that a piece of work no longer needs goes back to the system.
//!
//! An evaluation of a million trials takes arrays of megabytes for some milliseconds. glibc raises its
//! limit for memory of its own mapping to the size of the largest array that was ever freed; after that
//! such arrays are cut from the arenas of the threads, and each arena keeps its largest. A server that
//! idles between two key presses would then hold 50 to 100 MB for nothing.

/// Arrays of this size and more are mapped for themselves and given back when they are freed, bytes.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const MAPPED: libc::c_int = 1 << 20;

/// Fixes, for the whole process, the size from which memory is mapped for itself. Other C libraries do
/// so without being told.
pub(crate) fn return_large_arrays() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    {
        // SAFETY: `mallopt` takes two numbers and may be called at any time (mallopt(3)); a setting that
        // it refuses changes nothing.
        unsafe {
            libc::mallopt(libc::M_MMAP_THRESHOLD, MAPPED);
        }
    }
}
