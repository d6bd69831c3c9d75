//! Keeps memory that an evaluation frees for the next one.
//!
//! A run of a million trials uses a megabyte or two for some milliseconds. From 128 KiB on, glibc
//! returns freed memory at the end of a heap to the system and then gets it again page by page,
//! which takes a quarter of the time of a short run. It also raises this limit, and the limit for
//! separately mapped memory, depending on what is freed. Time and peak memory of a campaign then
//! depend on chance. A command ends when its work is done, so it may keep a few megabytes; the
//! server of the live page, which idles, does the opposite.

/// Arrays of at least this size are mapped separately, and this much free memory is kept at the end
/// of a heap, in bytes.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const KEPT: libc::c_int = 16 << 20;

/// Fixes both limits for the whole process. Other C libraries have no such limits.
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
