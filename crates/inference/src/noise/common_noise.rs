//! Noise that the outputs of a row have in common.
//!
//! What is read at the same moment, or against the same reference, shares errors: a supply, a vibration,
//! the reference itself. The uncertainties that are stated beside the readings say nothing of that. Taken
//! for independent, errors in common look like a departure that jumps from row to row, in all of these
//! outputs alike, which no effect makes. Here the noise of some outputs of a row is correlated, by one
//! coefficient with a sign for each of them; and the stated uncertainties of each output are right, or
//! multiplied by a factor.
//!
//! Coefficient and factors are not integrated over together with all else: they are taken as they are most
//! probable beside what the leading hypothesis leaves, and the width of that peak counts in the prior
//! probability (Laplace's method, as in MacKay 1992, Neural Computation 4, 415).

/// Noise that is correlated between the outputs of a row, and independent between rows.
#[derive(Clone, Debug, PartialEq)]
pub struct CommonNoise {
    /// For each observed output the sign of its share of what is common; 0 where it has none.
    pub(crate) signs: Vec<f64>,
    /// The coefficient of correlation of two outputs with shares of like signs, above 0.
    pub(crate) correlation: f64,
    /// The standard deviation of its inverse hyperbolic tangent.
    pub spread: f64,
    /// For each observed output what its stated uncertainties are multiplied by, with the standard
    /// deviation of the logarithm; `None` where they are right.
    pub factors: Vec<Option<(f64, f64)>>,
    /// The prior probability of all that is like this, among such noises.
    pub(crate) share: f64,
}

impl CommonNoise {
    /// What an output's stated uncertainties are multiplied by.
    pub(crate) fn factor(&self, output: usize) -> f64 {
        self.factors.get(output).copied().flatten().map_or(1.0, |(factor, _)| factor)
    }

    /// The coefficient of correlation of two outputs.
    pub fn between(&self, one: usize, other: usize) -> f64 {
        self.signs[one] * self.signs[other] * self.correlation
    }
}
