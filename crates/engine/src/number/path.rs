//! Code paths: the same source compiled for several vector widths, chosen at run time.
//!
//! The paths differ in speed only. No path fuses a product and a sum, and no path uses the
//! platform's own elementary functions, so all give the same bits (a test compares them).
#![allow(unsafe_code)]

/// A compiled form of the engine's inner loops.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum CodePath {
    /// What every processor of this kind can run.
    Baseline,
    /// x86-64 with AVX2.
    Avx2,
    /// x86-64 with AVX-512 (F, DQ, VL, BW) and POPCNT.
    Avx512,
}

/// Work that is compiled once for each code path. `run` must be `#[inline(always)]`, and all that
/// it does in its inner loops as well, so that it takes on the vector width of its caller.
pub trait Kernel {
    type Output;
    fn run(self) -> Self::Output;
}

impl CodePath {
    /// The paths that this machine can run, slowest first.
    pub fn available() -> Vec<Self> {
        [Self::Baseline, Self::Avx2, Self::Avx512]
            .into_iter()
            .filter(|path| path.is_available())
            .collect()
    }

    /// The fastest path of this machine.
    pub fn best() -> Self {
        [Self::Avx512, Self::Avx2]
            .into_iter()
            .find(|path| path.is_available())
            .unwrap_or(Self::Baseline)
    }

    /// The name that is printed.
    pub fn name(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }

    #[cfg(target_arch = "x86_64")]
    fn is_available(self) -> bool {
        match self {
            Self::Baseline => true,
            Self::Avx2 => is_x86_feature_detected!("avx2"),
            Self::Avx512 => {
                is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("avx512bw")
                    && is_x86_feature_detected!("popcnt")
            }
        }
    }

    #[cfg(not(target_arch = "x86_64"))]
    fn is_available(self) -> bool {
        self == Self::Baseline
    }

    /// This path, or the baseline where the machine does not have it.
    pub fn or_baseline(self) -> Self {
        if self.is_available() { self } else { Self::Baseline }
    }

    /// Runs the work on this path, or on the baseline where the machine does not have it.
    pub fn run<K: Kernel>(self, kernel: K) -> K::Output {
        #[cfg(target_arch = "x86_64")]
        {
            if self == Self::Avx512 && self.is_available() {
                // SAFETY: the processor has just been asked for these instructions.
                return unsafe { run_avx512(kernel) };
            }
            if self == Self::Avx2 && self.is_available() {
                // SAFETY: the processor has just been asked for these instructions.
                return unsafe { run_avx2(kernel) };
            }
        }
        kernel.run()
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw")]
fn run_avx512<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn run_avx2<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}
