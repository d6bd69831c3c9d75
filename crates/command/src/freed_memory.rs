//! Memory that an evaluation frees is kept for the next one.
//!
//! A run of a million trials takes a megabyte or two for some milliseconds. glibc gives freed memory at
//! the end of a heap back to the system from 128 KiB on and then gets it again page by page, which is a
//! quarter of the time of a short run; and it raises that limit, and the one from which memory is mapped
//! for itself, to what it happens to see freed, so that the time and the peak of a campaign depend on
//! chance. A command ends when its work is done, so it may hold on to a few megabytes; the server of the
//! live page, which idles, does the opposite.

/// Arrays of this size and more are mapped for themselves, and so much is kept at the end of a heap,
/// bytes.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const KEPT: libc::c_int = 16 << 20;

/// Fixes both limits for the whole process. Other C libraries have none to be fixed.
pub fn keep() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    for limit in [libc::M_MMAP_THRESHOLD, libc::M_TRIM_THRESHOLD] {
        #[allow(unsafe_code)]
        // SAFETY: `mallopt` takes two numbers and may be called at any time (mallopt(3)); a setting that
        // it refuses changes nothing.
        unsafe {
            libc::mallopt(limit, KEPT);
        }
    }
}
