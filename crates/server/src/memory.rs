//! Returns memory that is no longer needed to the system.
//!
//! An evaluation of a million trials uses arrays of megabytes for some milliseconds. glibc raises
//! its threshold for separately mapped memory to the size of the largest array that was ever freed.
//! After that, such arrays come from the arenas of the threads, and each arena keeps its largest. A
//! server that idles between two key presses would then hold 50 to 100 MB for nothing.

/// Arrays of at least this size are mapped separately and returned when they are freed, in bytes.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const MAPPED: libc::c_int = 1 << 20;

/// Fixes, for the whole process, the size from which memory is mapped separately. Other C libraries
/// do so by default.
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
