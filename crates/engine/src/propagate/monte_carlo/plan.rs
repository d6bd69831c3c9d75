//! How an output's trials are summed up: about which value, in which lanes, beside how many other
//! outputs, and which values are kept.

use super::windows::Windows;

/// Where an output's values lie and how far they spread: the pilot's median and a width. Sums are
/// taken of (value - middle)/scale, so that they neither cancel nor overflow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reference {
    pub(crate) middle: f64,
    pub(crate) scale: f64,
    /// The output's tolerance limits, infinite where there are none; the lower one above the upper
    /// one where values beyond either of them are inside.
    pub(crate) limits: [f64; 2],
}

/// How one output's trials are accumulated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plan {
    pub(crate) reference: Reference,
    pub(crate) windows: Windows,
    /// Share of the values that the windows keep.
    pub(crate) kept: f64,
}

/// Lanes of a sum: every lane adds its own trials.
pub(super) const LANES: usize = 8;

/// Outputs of either side whose products are added up side by side: their values stay in the
/// first-level cache and the sums in registers.
pub(super) const TOGETHER: usize = 2;

/// The values of such outputs in chunks of lanes.
pub(super) type Chunks<'v> = [&'v [[f64; LANES]]; TOGETHER];

/// For each two such outputs the sum of products in each lane.
pub(super) type Products = [[[f64; LANES]; TOGETHER]; TOGETHER];

/// The sum of the lanes, in an order that every vector width can follow.
#[inline(always)]
pub(super) fn pairwise(lane: [f64; LANES]) -> f64 {
    let [a, b, c, d, e, f, g, h] = lane;
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}
