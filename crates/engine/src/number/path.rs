//! Code paths: the same source compiled for several vector widths, chosen at run time.
//!
//! The paths differ only in speed. No path fuses a product and a sum, and no path uses the
//! platform's own elementary functions, so all give the same bits (a test compares them).
#![allow(unsafe_code)]

use std::fmt;
use std::str::FromStr;

/// A compiled form of the engine's inner loops that this machine can run. Values are created only
/// by detection, so a value proves that its instructions exist.
///
/// ```
/// use gumption_engine::number::CodePath;
///
/// let paths = CodePath::available();
/// assert_eq!(paths.first(), Some(&CodePath::BASELINE));
/// assert_eq!(paths.last(), Some(&CodePath::best()));
/// assert_eq!("baseline".parse(), Ok(CodePath::BASELINE));
/// assert!("avx3".parse::<CodePath>().is_err());
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct CodePath(Instructions);

/// The instructions for which a path is compiled.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(not(target_arch = "x86_64"), allow(dead_code))]
pub(crate) enum Instructions {
    /// What every processor of this kind can run.
    Baseline,
    /// x86-64 with AVX2.
    Avx2,
    /// x86-64 with AVX-512 (F, DQ, VL, BW) and POPCNT.
    Avx512,
}

/// A name that no code path of this machine has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnavailablePath {
    /// The name.
    pub name: String,
}

impl fmt::Display for UnavailablePath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<_> = CodePath::available().into_iter().map(CodePath::name).collect();
        write!(f, "this machine has no code path `{}`, only {}", self.name, names.join(", "))
    }
}

impl std::error::Error for UnavailablePath {}

/// Work that is compiled once for each code path. `run` and everything in its inner loops must be
/// `#[inline(always)]`, so that they get the vector width of their caller.
pub trait Kernel {
    /// The result of the work.
    type Output;

    /// Whether it is compiled for the widest registers as well; false if it takes little of the
    /// time of its callers.
    const WIDEST: bool = true;

    /// Does the work.
    fn run(self) -> Self::Output;
}

impl CodePath {
    /// What every processor of this kind can run.
    pub const BASELINE: Self = Self(Instructions::Baseline);

    /// The paths that this machine can run, slowest first.
    pub fn available() -> Vec<Self> {
        [Instructions::Baseline, Instructions::Avx2, Instructions::Avx512]
            .into_iter()
            .filter(|instructions| instructions.are_available())
            .map(Self)
            .collect()
    }

    /// The fastest path of this machine.
    pub fn best() -> Self {
        [Instructions::Avx512, Instructions::Avx2]
            .into_iter()
            .find(|instructions| instructions.are_available())
            .map_or(Self::BASELINE, Self)
    }

    /// The name that is printed.
    pub fn name(self) -> &'static str {
        match self.0 {
            Instructions::Baseline => "baseline",
            Instructions::Avx2 => "avx2",
            Instructions::Avx512 => "avx512",
        }
    }

    /// The instructions, which the machine has.
    #[inline(always)]
    #[cfg_attr(not(target_arch = "x86_64"), allow(dead_code))]
    pub(crate) fn instructions(self) -> Instructions {
        self.0
    }

    /// Runs the work on this path.
    pub fn run<K: Kernel>(self, kernel: K) -> K::Output {
        #[cfg(target_arch = "x86_64")]
        match self.0 {
            // SAFETY: a path exists only if the machine has its instructions.
            Instructions::Avx512 if K::WIDEST => return unsafe { run_avx512(kernel) },
            // SAFETY: as above; a machine with AVX-512 has AVX2.
            Instructions::Avx512 | Instructions::Avx2 => return unsafe { run_avx2(kernel) },
            Instructions::Baseline => {}
        }
        kernel.run()
    }
}

impl fmt::Debug for CodePath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "CodePath({})", self.name())
    }
}

impl FromStr for CodePath {
    type Err = UnavailablePath;

    fn from_str(name: &str) -> Result<Self, UnavailablePath> {
        let path = Self::available().into_iter().find(|path| path.name() == name);
        path.ok_or_else(|| UnavailablePath { name: name.to_owned() })
    }
}

impl Instructions {
    #[cfg(target_arch = "x86_64")]
    fn are_available(self) -> bool {
        match self {
            Self::Baseline => true,
            Self::Avx2 => is_x86_feature_detected!("avx2"),
            Self::Avx512 => {
                Self::Avx2.are_available()
                    && is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("avx512bw")
                    && is_x86_feature_detected!("popcnt")
            }
        }
    }

    #[cfg(not(target_arch = "x86_64"))]
    fn are_available(self) -> bool {
        self == Self::Baseline
    }
}

/// # Safety
/// The machine has the instructions of [`Instructions::Avx512`].
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw")]
fn run_avx512<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}

/// # Safety
/// The machine has AVX2.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn run_avx2<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}
