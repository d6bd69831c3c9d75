//! An input quantity of a measurement, with the state of knowledge about it.

use std::fmt;

use super::constant::Constant;
use super::shape::positive;
use super::{Distribution, Invalid, Normal, Readings, Rectangular, StudentT, Triangular};
use gumption_units::{Unit, UnitError};

/// How a standard uncertainty was evaluated (JCGM 100, 2.3.2 and 2.3.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EvaluationType {
    /// By statistical analysis of readings.
    A,
    /// By any other means.
    B,
}

impl EvaluationType {
    /// The usual evaluation of a distribution: A for readings, else B.
    pub fn of(distribution: &Distribution) -> Self {
        match distribution {
            Distribution::Readings(_) => Self::A,
            // from the scatter about a curve
            Distribution::Fitted(fitted) if fitted.fit().factor.is_some() => Self::A,
            _ => Self::B,
        }
    }

    /// The letter.
    pub fn letter(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::B => "B",
        }
    }
}

/// The state of knowledge about one input quantity: a distribution of its value in a unit.
///
/// ```
/// use gumption_engine::distribution::Input;
///
/// let tilt = Input::rectangular(35.0, 0.1, "deg")?;
/// assert_eq!(tilt.distribution.mean(), 35.0);
/// assert!(Input::rectangular(35.0, -0.1, "deg").is_err());
/// # Ok::<(), gumption_engine::distribution::InputError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Input {
    /// The distribution of the value in `unit`.
    pub distribution: Distribution,
    /// The unit.
    pub unit: Unit,
    /// Type A or B.
    pub evaluation: EvaluationType,
    /// A group for subtotals in the budget.
    pub group: Option<String>,
    /// The source of uncertainty, in words.
    pub about: String,
}

impl Input {
    /// An input with the given distribution of its value in `unit`.
    ///
    /// # Errors
    /// A unit that does not parse.
    pub fn new(distribution: impl Into<Distribution>, unit: &str) -> Result<Self, InputError> {
        let distribution = distribution.into();
        Ok(Self {
            evaluation: EvaluationType::of(&distribution),
            distribution,
            unit: Unit::parse(unit)?,
            group: None,
            about: String::new(),
        })
    }

    /// An exactly known value.
    ///
    /// # Errors
    /// A value that is not finite, a unit that does not parse.
    pub fn constant(value: f64, unit: &str) -> Result<Self, InputError> {
        Self::new(Constant::new(value)?, unit)
    }

    /// A normal distribution with standard deviation `std` > 0.
    ///
    /// # Errors
    /// The errors of [`Normal::new`], or a unit that does not parse.
    pub fn normal(mean: f64, std: f64, unit: &str) -> Result<Self, InputError> {
        Self::new(Normal::new(mean, std)?, unit)
    }

    /// A value with its expanded uncertainty U > 0 and the coverage factor k > 0, as certificates
    /// state them: a normal distribution of standard deviation U/k. Budgets show k as the divisor.
    ///
    /// ```
    /// use gumption_engine::distribution::Input;
    ///
    /// let block = Input::expanded(50.000_02, 30e-6, 2.0, "mm")?;
    /// assert!((block.distribution.standard_uncertainty() - 15e-6).abs() < 1e-18);
    /// # Ok::<(), gumption_engine::distribution::InputError>(())
    /// ```
    ///
    /// # Errors
    /// Numbers that are not finite or out of their range, a unit that does not parse.
    pub fn expanded(
        mean: f64,
        expanded_uncertainty: f64,
        coverage_factor: f64,
        unit: &str,
    ) -> Result<Self, InputError> {
        let factor = positive("k", coverage_factor)?;
        let std = positive("expanded uncertainty", expanded_uncertainty)? / factor;
        Self::new(Normal::new(mean, std)?.stated_with(factor)?, unit)
    }

    /// A rectangular distribution within `half_width` > 0 of `mean`.
    ///
    /// # Errors
    /// The errors of [`Rectangular::new`], or a unit that does not parse.
    pub fn rectangular(mean: f64, half_width: f64, unit: &str) -> Result<Self, InputError> {
        Self::new(Rectangular::new(mean, half_width)?, unit)
    }

    /// A symmetric triangular distribution within `half_width` > 0 of `mean`.
    ///
    /// # Errors
    /// The errors of [`Triangular::new`], or a unit that does not parse.
    pub fn triangular(mean: f64, half_width: f64, unit: &str) -> Result<Self, InputError> {
        Self::new(Triangular::new(mean, half_width)?, unit)
    }

    /// A t distribution of scale > 0 with `dof` > 0 degrees of freedom.
    ///
    /// # Errors
    /// The errors of [`StudentT::new`], or a unit that does not parse.
    pub fn t(mean: f64, scale: f64, dof: f64, unit: &str) -> Result<Self, InputError> {
        Self::new(StudentT::new(mean, scale, dof)?, unit)
    }

    /// Repeated readings (Type A).
    ///
    /// # Errors
    /// The errors of [`Readings::new`], or a unit that does not parse.
    pub fn readings(values: &[f64], unit: &str) -> Result<Self, InputError> {
        Self::new(Readings::new(values.to_vec())?, unit)
    }

    /// The same input in a group of the budget, for subtotals.
    #[must_use]
    pub fn group(self, group: &str) -> Self {
        Self { group: Some(group.to_owned()), ..self }
    }

    /// The same input with its source of uncertainty in words.
    #[must_use]
    pub fn about(self, about: &str) -> Self {
        Self { about: about.to_owned(), ..self }
    }
}

/// Why an input cannot be made.
#[derive(Clone, Debug, PartialEq)]
pub enum InputError {
    /// The distribution's parameters.
    Distribution(Invalid),
    /// The unit.
    Unit(UnitError),
}

impl From<Invalid> for InputError {
    fn from(error: Invalid) -> Self {
        Self::Distribution(error)
    }
}

impl From<UnitError> for InputError {
    fn from(error: UnitError) -> Self {
        Self::Unit(error)
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Distribution(error) => error.fmt(f),
            Self::Unit(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for InputError {}
