//! Coverage regions of several outputs together: which are asked for, and what is found of them.

use super::gum::Dof;

/// Outputs that are covered together.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// The outputs, by their numbers.
    pub outputs: Vec<usize>,
    /// The coverage probability; that of the settings unless given.
    pub probability: Option<f64>,
}

/// The coverage regions of several outputs.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RegionEvaluation {
    /// The outputs, by their numbers.
    pub outputs: Vec<usize>,
    /// The coverage probability.
    pub probability: f64,
    /// By the law of propagation; `None` where an output has none.
    pub gum: Option<JointRegion>,
    /// Effective degrees of freedom of the covariance matrix of the law of propagation; `None` without
    /// one, and where it is singular.
    pub dof: Option<Dof>,
    /// From the trials; `None` without them, or where an output has no variance.
    pub monte_carlo: Option<SampledRegion>,
    /// The comparison of the two (clause 8).
    pub validation: Option<RegionValidation>,
}

/// An ellipsoid and a hyper-rectangle about the estimates.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct JointRegion {
    /// The estimates.
    pub estimates: Vec<f64>,
    /// The covariance matrix, row by row.
    pub covariance: Vec<f64>,
    /// k_p of the ellipsoid; `None` where the covariance matrix is singular, its degrees of freedom
    /// undefined, or less than there are outputs.
    pub ellipsoid_k: Option<f64>,
    /// k_q of the hyper-rectangle; `None` where the degrees of freedom of an output are undefined.
    pub box_k: Option<f64>,
}

/// The same from trials, and the smallest region.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SampledRegion {
    /// Estimates, covariance matrix and factors.
    pub region: JointRegion,
    /// How many trials they are from.
    pub trials: u64,
    /// The smallest region, or why the trials do not tell it.
    pub smallest: Result<SmallestRegion, String>,
    /// Numerical standard error of the factor of the ellipsoid.
    pub ellipsoid_error: Option<f64>,
    /// Numerical standard error of the factor of the hyper-rectangle.
    pub box_error: f64,
    /// Some of the trials, one output after the other, for figures.
    pub sample: Vec<Vec<f64>>,
}

/// The region that holds the probability with the least volume.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SmallestRegion {
    /// Its volume, in the product of the outputs' units.
    pub volume: f64,
    /// Numerical standard error of that, with what smoothing of the density may add.
    pub error: f64,
}

/// Whether the law of propagation is confirmed (JCGM 102, clause 8).
#[derive(Clone, Debug, PartialEq)]
pub struct RegionValidation {
    /// The moduli of the differences of estimates and of standard uncertainties, each with its
    /// tolerance.
    pub differences: Vec<[f64; 2]>,
    /// That of the largest eigenvalues of the correlation matrices, with its tolerance.
    pub eigenvalue: [f64; 2],
    /// That of the factors k_p, with its tolerance.
    pub ellipsoid: Option<[f64; 2]>,
    /// Whether all are within.
    pub gum_valid: bool,
}
