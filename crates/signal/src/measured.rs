//! A value that a step found, with how well it is known.

/// A value with its standard uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The estimate, in the unit that its owner states.
    pub value: f64,
    /// Its standard uncertainty, in the same unit; zero or more.
    pub standard_uncertainty: f64,
    /// The effective degrees of freedom of the standard uncertainty; infinite where it is taken as
    /// known.
    pub degrees_of_freedom: f64,
}

/// A value whose standard uncertainty has independent parts, each with its degrees of freedom.
///
/// Source: JCGM 100, 5.1.2 and formula of Welch and Satterthwaite (G.4.1).
pub(super) fn of_parts(value: f64, parts: &[(f64, f64)]) -> Measured {
    let variance: f64 = parts.iter().map(|(u, _)| u * u).sum();
    let scatter: f64 = parts.iter().map(|(u, freedom)| u * u * (u * u) / freedom).sum();
    Measured {
        value,
        standard_uncertainty: variance.sqrt(),
        degrees_of_freedom: if scatter > 0.0 {
            variance * variance / scatter
        } else {
            f64::INFINITY
        },
    }
}
