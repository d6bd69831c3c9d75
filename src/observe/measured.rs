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
