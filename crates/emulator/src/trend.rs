//! What a Gaussian process varies about.

/// The mean of a Gaussian process, fitted along with it (Rasmussen and Williams 2006, 2.7).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trend {
    /// Zero.
    None,
    /// A constant and a slope along each dimension.
    Linear,
}

impl Trend {
    /// How many functions it has where so many points of some dimensions tell: slopes need more points than
    /// there are functions.
    pub(crate) fn functions(self, points: usize, dimensions: usize) -> usize {
        match self {
            Self::None => 0,
            Self::Linear if points > dimensions + 2 => dimensions + 1,
            Self::Linear => 1,
        }
    }
}

/// The first functions of a linear trend at a point: 1, then its coordinates.
pub(crate) fn functions(count: usize, point: &[f64]) -> impl Iterator<Item = f64> {
    std::iter::once(1.0).chain(point.iter().copied()).take(count)
}
