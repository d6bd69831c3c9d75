//! Measurement models: named inputs with units, a function from inputs to outputs, named outputs.
//!
//! A [`Model`] is the same thing whether it was written as a Rust function ([`typed`]) or as
//! formulas in a file: quantities on both sides and a [`Program`] between them.

pub mod formula;
mod guard_rule;
mod interpolation;
mod of_conditions;
mod program;
mod root;
mod schedule;
mod slopes;
mod trace;
pub mod typed;
pub use guard_rule::GuardRule;
pub use interpolation::{Interpolation, InterpolationMethod, TableFault};
pub use of_conditions::{FollowingConditions, OfConditions};
pub use program::Node;
pub use program::Program;
pub use program::RoutineCall;
pub(crate) use root::Root;
pub(crate) use schedule::fold;
pub use schedule::{Following, Schedule, ScheduledOutput};
pub(crate) use slopes::{Columns, Slope, Slopes};
pub use trace::{Recorder, Traced};

use std::borrow::Cow;
use std::sync::Arc;

use crate::decimal::to_digits;
use crate::distribution::Distribution;
use crate::number::Number;
use formula::Typing;
use gumption_units::{Unit, Zero};

/// A named quantity with its unit.
#[derive(Clone, Debug)]
pub struct Quantity {
    /// The name that equations use.
    pub name: String,
    /// The unit that its values are given and reported in.
    pub unit: Unit,
    /// What it is, in words.
    pub about: String,
}

/// An input quantity: the sum of one or more variables of the program, its components.
#[derive(Clone, Debug)]
pub struct InputQuantity {
    /// Name and unit.
    pub quantity: Quantity,
    /// How many consecutive variables of the program add up to it; one unless it has components.
    pub parts: usize,
}

/// An output quantity (measurand).
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Output {
    /// Name and unit.
    pub quantity: Quantity,
    /// The length of a turn in the output's unit, for phases: values are taken on the branch within
    /// half a turn of the estimate.
    pub period: Option<f64>,
    /// The limits that a conforming value lies within, in the output's unit.
    pub tolerance: Option<Tolerance>,
    /// What was known about the values of the items before measuring, in the output's unit; for
    /// global risks.
    pub prior: Option<Arc<Distribution>>,
    /// The risk of false acceptance that is wanted; simple acceptance without one.
    pub risk: Option<f64>,
    /// The width of the guard band in expanded uncertainties (ILAC-G8:09/2019, 4.2.2).
    pub guard_factor: Option<f64>,
    /// Whether the decision has four levels rather than two (ILAC-G8:09/2019, 4.2.3).
    pub non_binary: bool,
    /// The rule of a name that gives the width of the guard band; it needs two limits.
    pub guard_rule: Option<GuardRule>,
    /// What the tolerance is that of, in words: `DIN EN 60751 class A`.
    pub specification: Option<Arc<str>>,
    /// Whether the decision rule was agreed with the customer (ISO/IEC 17025, 7.1.3).
    pub rule_agreed: bool,
    /// The smallest expanded uncertainty that the laboratory may state.
    pub capability: Option<Capability>,
    /// The line over a condition that is to lie on or above U of all rows.
    pub capability_line: Option<CapabilityLine>,
    /// Limits and capability that are others in every row of conditions. Where there are such,
    /// `tolerance` and `capability` are those of the first row.
    pub following: Option<Arc<FollowingConditions>>,
}

impl Output {
    /// An output without limits, period or capability.
    pub fn new(quantity: Quantity) -> Self {
        let (period, tolerance, prior, risk, capability) = (None, None, None, None, None);
        Self {
            quantity,
            period,
            tolerance,
            prior,
            risk,
            guard_factor: None,
            non_binary: false,
            guard_rule: None,
            specification: None,
            rule_agreed: false,
            capability,
            capability_line: None,
            following: None,
        }
    }

    /// The output with the limits and the capability that it has at these values of the conditions.
    pub fn at(&self, conditions: &[f64]) -> Cow<'_, Self> {
        let Some(following) = self.following.as_deref() else { return Cow::Borrowed(self) };
        let mut own = self.clone();
        let at = |of: &Option<OfConditions>| of.as_ref().map(|of| of.at(conditions));
        if let Some(tolerance) = &mut own.tolerance {
            tolerance.lower = at(&following.lower).or(tolerance.lower);
            tolerance.upper = at(&following.upper).or(tolerance.upper);
        }
        if let Some(capability) = &mut own.capability {
            capability.absolute = at(&following.capability).unwrap_or(capability.absolute);
        }
        Cow::Owned(own)
    }
}

/// Digits of a computed figure that are believed.
pub(crate) const COMPUTED_DIGITS: u32 = 12;

/// A laboratory's calibration and measurement capability (CMC), in the output's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capability {
    /// Share of the modulus of the estimate.
    pub relative: f64,
    /// What is added to that.
    pub absolute: f64,
    /// Whether a smaller expanded uncertainty is raised to it.
    pub floor: bool,
}

/// A line over a condition, to be fitted to the expanded uncertainties of all rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CapabilityLine {
    /// The place of the condition.
    pub condition: usize,
    /// Whether the terms add in squares, Q\[a; bL\], and not as a + b L.
    pub is_quadratic: bool,
    /// Significant digits of both numbers.
    pub digits: u32,
}

impl Capability {
    /// The smallest expanded uncertainty at an estimate, without the last bits that binary sums
    /// leave: 0.1 + 0.02 is 0.12.
    pub fn at(&self, estimate: f64) -> f64 {
        to_digits(self.relative * estimate.abs() + self.absolute, COMPUTED_DIGITS)
    }
}

/// Tolerance limits of an output; at least one is given (JCGM 106).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Lower limit.
    pub lower: Option<f64>,
    /// Upper limit.
    pub upper: Option<f64>,
}

impl Tolerance {
    /// The limits, infinite where there is none.
    pub fn ends(&self) -> [f64; 2] {
        [self.lower.unwrap_or(f64::NEG_INFINITY), self.upper.unwrap_or(f64::INFINITY)]
    }

    /// Between two limits, infinite where there is none.
    pub(crate) fn between([lower, upper]: [f64; 2]) -> Self {
        let finite = |limit: f64| Some(limit).filter(|limit| limit.is_finite());
        Self { lower: finite(lower), upper: finite(upper) }
    }

    /// The limits moved inwards by a width; `None` where nothing is left between them.
    ///
    /// ```
    /// use gumption_engine::model::Tolerance;
    ///
    /// let tolerance = Tolerance { lower: Some(10.2), upper: Some(10.6) };
    /// assert_eq!(tolerance.narrowed(0.1).map(|left| left.ends()), Some([10.2 + 0.1, 10.6 - 0.1]));
    /// assert_eq!(tolerance.narrowed(0.3), None);
    /// ```
    pub fn narrowed(&self, width: f64) -> Option<Self> {
        let narrowed =
            Self { lower: self.lower.map(|l| l + width), upper: self.upper.map(|u| u - width) };
        // where both limits meet the value there is left, also if they are rounded past each other
        let is_left = match (narrowed.lower, narrowed.upper) {
            (Some(lower), Some(upper)) => lower <= upper || narrowed.holds(lower),
            _ => true,
        };
        is_left.then_some(narrowed)
    }

    /// Whether a value lies within the limits, or on one of them but for the rounding of binary
    /// fractions.
    ///
    /// ```
    /// use gumption_engine::model::Tolerance;
    ///
    /// let tolerance = Tolerance { lower: None, upper: Some(0.3) };
    /// assert!(tolerance.holds(0.1 + 0.2) && !tolerance.holds(0.3 + 1e-9));
    /// ```
    pub fn holds(&self, value: f64) -> bool {
        let rounding = |limit: f64| 1e-12 * limit.abs().max(value.abs());
        self.lower.is_none_or(|lower| value >= lower - rounding(lower))
            && self.upper.is_none_or(|upper| value <= upper + rounding(upper))
    }
}

/// A measurement model. The program's variables are the parts of the inputs, then the conditions,
/// each in its own unit; its results are the outputs in their own units.
#[derive(Clone, Debug)]
pub struct Model {
    /// The input quantities.
    pub inputs: Vec<InputQuantity>,
    /// The conditions of the measurement: quantities that are set and known.
    pub conditions: Vec<Quantity>,
    /// The output quantities.
    pub outputs: Vec<Output>,
    /// The function between them.
    pub program: Program,
}

/// The numbers that formulas compute with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NumberForm {
    /// Those of coherent SI units; of Celsius temperatures the number of degrees Celsius, of levels
    /// that of decibels.
    #[default]
    Coherent,
    /// Those of the units that the quantities are declared in, for empirical formulas.
    Declared,
}

impl NumberForm {
    /// The number that a value in a unit is in formulas.
    pub fn number(self, value: f64, unit: &Unit) -> f64 {
        match self {
            Self::Coherent => unit.value_to_si(value),
            Self::Declared => value,
        }
    }

    /// A recorded value in a unit as the number of formulas.
    pub fn taken<'r>(self, value: Traced<'r>, unit: &Unit) -> Traced<'r> {
        match self {
            Self::Coherent => in_si(value, unit),
            Self::Declared => value,
        }
    }

    /// A number of formulas of that kind as a recorded value in a unit.
    pub fn given<'r>(self, value: Traced<'r>, unit: &Unit, typing: Typing) -> Traced<'r> {
        match self {
            Self::Coherent => in_unit(value, unit, typing),
            Self::Declared => value,
        }
    }
}

/// The recorded values of a model's inputs and conditions as formulas take them, by name.
pub fn recorded_values<'r>(
    recorder: &'r Recorder,
    inputs: &[InputQuantity],
    conditions: &[Quantity],
    form: NumberForm,
) -> Vec<(String, Traced<'r>)> {
    let mut next = 0;
    let mut variable = || {
        next += 1;
        recorder.variable(next - 1)
    };
    let mut values = Vec::with_capacity(inputs.len() + conditions.len());
    for input in inputs {
        let mut sum = variable();
        for _ in 1..input.parts {
            sum = sum + variable();
        }
        values.push((input.quantity.name.clone(), form.taken(sum, &input.quantity.unit)));
    }
    for condition in conditions {
        values.push((condition.name.clone(), form.taken(variable(), &condition.unit)));
    }
    values
}

/// How many variables the program of these inputs and conditions has.
pub fn variables(inputs: &[InputQuantity], conditions: &[Quantity]) -> usize {
    inputs.iter().map(|input| input.parts).sum::<usize>() + conditions.len()
}

/// A value in a unit, converted to SI (a Celsius temperature to degrees Celsius).
pub fn in_si<T: Number>(value: T, unit: &Unit) -> T {
    let scaled = if unit.factor() == 1.0 { value } else { value * unit.factor() };
    if unit.offset() == 0.0 { scaled } else { scaled + unit.offset() }
}

/// A value in SI of that kind, converted to a unit. A difference knows no zero.
pub fn in_unit<T: Number>(value: T, unit: &Unit, typing: Typing) -> T {
    let shift = match typing.zero {
        Some(_) => Zero::shift(typing.zero, unit.zero()).unwrap_or(0.0) - unit.offset(),
        None => 0.0,
    };
    let value = if shift == 0.0 { value } else { value + shift };
    if unit.factor() == 1.0 { value } else { value / unit.factor() }
}
