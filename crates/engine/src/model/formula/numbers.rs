//! What the numbers of a name or of a part of a formula are in, as far as notes ask for it.

use super::syntax::TableCall;
use crate::regression::CurveFunction;
use gumption_units::{Dimension, Turn, Unit};

/// Two factors are the same but for the digits that somebody wrote of pi.
const SAME_FACTOR: f64 = 1e-3;

/// The degrees in a radian.
const DEGREES: f64 = 180.0 / std::f64::consts::PI;

/// Whether two factors are the same up to their signs and to the digits that somebody wrote.
pub(super) fn is_same_factor(a: f64, b: f64) -> bool {
    (a.abs() / b.abs() - 1.0).abs() < SAME_FACTOR
}

/// What a value in a formula is taken from.
#[derive(Clone, Copy, Debug)]
pub enum ValueSource<'f> {
    /// A quantity, by its name.
    Name(&'f str),
    /// The column of a table that its argument is looked up in.
    TableArgument(&'f TableCall),
    /// The column of a table that its values are from.
    TableValue(&'f TableCall),
    /// x of a calibration function.
    CurveX(&'f CurveFunction),
    /// y of a calibration function.
    CurveY(&'f CurveFunction),
}

/// What is known of the numbers of a name, a column or a coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Numbers<'u> {
    /// They are given in this unit, and formulas have them in coherent ones.
    Given(&'u Unit),
    /// An equation computes them from what is given in this unit, by sums and small factors.
    Computed(&'u Unit),
    /// They are an angle that a function gave, in radians.
    Radians,
    /// They are the number of degrees of an angle.
    Degrees,
    /// They are a length, by an equation.
    Length,
    /// No unit is said of them, so that they are taken as plain numbers.
    Unstated,
}

/// What a formula's value is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Use<'u> {
    /// A quantity that is reported nowhere, or about whose unit nothing is known.
    Quantity,
    /// An output that is reported in this unit.
    Output(&'u Unit),
    /// The estimate of a quantity that is given in this unit.
    Estimate(&'u Unit),
    /// A width.
    Width,
}

/// What numbers a node's value is made of.
#[derive(Clone, Copy)]
pub(super) struct Scaled<'u> {
    /// The unit of the one name among its factors whose values formulas have in another one.
    pub(super) unit: Option<&'u Unit>,
    /// The product of the plain numbers among its factors.
    pub(super) factor: f64,
    /// Whether there is no other factor, so that its numbers would be in the unit.
    pub(super) is_bare: bool,
    /// Whether the name is divided by: `c*100/p`.
    pub(super) is_divisor: bool,
    /// The square of what would be in a unit: where its base stands, and the unit.
    pub(super) square: Option<(usize, &'u Unit)>,
    /// Whether it is an angle that a function gave, times plain numbers.
    pub(super) of_function: bool,
    /// Whether an equation computes it.
    pub(super) is_computed: bool,
    /// Whether its numbers, but for a small factor, are those of which no unit is said.
    pub(super) is_unstated: bool,
    /// How many factors of it are lengths.
    pub(super) lengths: f64,
}

impl<'u> Scaled<'u> {
    pub(super) const UNKNOWN: Self = Self {
        unit: None,
        factor: 1.0,
        is_bare: false,
        is_divisor: false,
        square: None,
        of_function: false,
        is_computed: false,
        is_unstated: false,
        lengths: 0.0,
    };

    /// The angle that a function gave.
    pub(super) const RADIANS: Self = Self { of_function: true, ..Self::UNKNOWN };

    /// Of a name.
    pub(super) fn of(numbers: Numbers<'u>) -> Self {
        match numbers {
            Numbers::Given(unit) => Self::in_unit(unit),
            Numbers::Computed(unit) => Self { is_computed: true, ..Self::in_unit(unit) },
            Numbers::Radians => Self::RADIANS,
            Numbers::Degrees => Self { factor: DEGREES, ..Self::RADIANS },
            Numbers::Length => Self { lengths: 1.0, ..Self::UNKNOWN },
            Numbers::Unstated => Self { is_unstated: true, ..Self::UNKNOWN },
        }
    }

    /// Of a name with this unit.
    fn in_unit(unit: &'u Unit) -> Self {
        let counts_turns = unit.turn() == Some(Turn::Angle);
        // a share, or a ratio of like units: mV/V
        let is_ratio =
            unit.dimension().is_none() && unit.turn().is_none() && unit.level_exponent().is_zero();
        let is_scaled = (is_ratio || counts_turns) && unit.factor() != 1.0;
        let lengths = if unit.dimension() == Dimension::LENGTH { 1.0 } else { 0.0 };
        if is_scaled {
            Self { unit: Some(unit), is_bare: true, lengths, ..Self::UNKNOWN }
        } else {
            Self { lengths, ..Self::UNKNOWN }
        }
    }

    /// What is known of a name with this value; nothing where a factor changes what it is in.
    pub(super) fn numbers(&self) -> Option<Numbers<'u>> {
        if self.counts_degrees() {
            return Some(Numbers::Degrees);
        }
        if self.takes_unstated() {
            return Some(Numbers::Unstated);
        }
        let is_small = self.has_small_factor();
        match self.unit.filter(|_| self.is_bare && !self.converts()) {
            Some(unit) => is_small.then_some(Numbers::Computed(unit)),
            None => (self.of_function && is_small).then_some(Numbers::Radians),
        }
    }

    /// Whether no unit is said of its numbers, nor converts a factor them.
    pub(super) fn takes_unstated(&self) -> bool {
        self.is_unstated && self.has_small_factor()
    }

    /// Whether its plain numbers are no conversion, but for those with pi.
    fn has_small_factor(&self) -> bool {
        (0.02..50.0).contains(&self.factor.abs())
    }

    /// The unit, of a share or an angle and not of a rate, where its numbers would be in it. Those of
    /// `100*p` of per cent and of `phi*180/pi` of degrees are the plain numbers of units.
    pub(super) fn bare_unit(&self) -> Option<&'u Unit> {
        let is_plain = |unit: &&Unit| is_same_factor(self.factor * unit.factor(), 1.0);
        let unit = self.unit.filter(|unit| self.is_bare && unit.dimension().is_none());
        unit.filter(|unit| !is_plain(unit))
    }

    /// Whether it is an angle in radians that a function gave, and no number of degrees of one.
    pub(super) fn is_in_radians(&self) -> bool {
        self.of_function && !self.counts_degrees()
    }

    /// Whether its numbers are of degrees, by a factor of 180/pi.
    pub(super) fn counts_degrees(&self) -> bool {
        let is_angle = |unit: &Unit| unit.dimension().is_none() && unit.turn().is_some();
        let of_unit = self.is_bare && self.unit.is_some_and(is_angle);
        (self.of_function || of_unit) && is_same_factor(self.factor, DEGREES)
    }

    /// Its plain numbers, as those that its unit is multiplied by.
    fn own(&self) -> f64 {
        if self.is_divisor { 1.0 / self.factor } else { self.factor }
    }

    /// Whether its plain numbers convert from its unit to the one that formulas compute with.
    pub(super) fn converts(&self) -> bool {
        let own = self.own();
        self.unit.is_some_and(|unit| {
            // revolutions per minute, with kilowatts as in `9550*P/n`
            let in_kilo = unit.counts_revolutions() && is_same_factor(own * 1e3, unit.factor());
            let is_rate = !unit.dimension().is_none();
            is_same_factor(own, unit.factor()) || (is_rate && in_kilo) || self.has_turn()
        })
    }

    /// Whether it has a factor of 2 pi beside a rate, as from revolutions to radians.
    pub(super) fn has_turn(&self) -> bool {
        let is_rate = self.unit.is_some_and(|unit| !unit.dimension().is_none());
        is_rate && is_same_factor(self.own(), std::f64::consts::TAU)
    }

    /// Of the product of two; `is_bare` says whether one of them is a plain number.
    pub(super) fn times(self, other: Self, is_bare: bool) -> Self {
        let lengths = self.lengths + other.lengths;
        if self.unit.is_some() && other.unit.is_some() {
            return Scaled { lengths, ..Scaled::UNKNOWN };
        }
        let unit = self.unit.or(other.unit);
        let is_divisor = self.is_divisor || other.is_divisor;
        Scaled {
            unit,
            factor: self.factor * other.factor,
            is_bare: is_bare && unit.is_some() && !is_divisor,
            is_divisor,
            of_function: is_bare && (self.of_function || other.of_function),
            is_computed: self.is_computed || other.is_computed,
            is_unstated: is_bare && (self.is_unstated || other.is_unstated),
            lengths,
            square: None,
        }
    }

    /// Of the inverse.
    pub(super) fn inverse(self) -> Self {
        let is_divisor = self.unit.is_some() && !self.is_divisor;
        Scaled {
            factor: 1.0 / self.factor,
            is_divisor,
            of_function: false,
            is_unstated: false,
            lengths: -self.lengths,
            ..self
        }
    }

    /// Whether it is of a share, an angle or the like, and has no factors but plain numbers.
    pub(super) fn is_alone(&self) -> bool {
        self.is_bare || self.of_function
    }

    /// Whether it has no factors but plain numbers, or is of what no unit is said.
    pub(super) fn is_alone_or_unstated(&self) -> bool {
        self.is_alone() || self.is_unstated
    }
}
