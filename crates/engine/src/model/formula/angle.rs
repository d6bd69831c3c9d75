//! The power of angle in a quantity: what `1/n` of an `n` in rpm is per.

use gumption_units::{Exponent, Unit};

/// The power of angle in a quantity, by the units that its factors were given in: 1 of an angle or an
/// angular velocity, -1 of what is divided by one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct AnglePower {
    /// The exponent.
    pub exponent: Exponent,
    /// Whether revolutions are among the units, so that two readings differ by 2 pi.
    pub of_revolutions: bool,
    /// Whether it has no factors but angles, their rates and whole or decimal numbers that are written
    /// out, so that nothing else can tell whether it is per radian or per revolution: of `1/n`, not of
    /// `P/n`, which is a torque.
    pub is_alone: bool,
}

impl AnglePower {
    /// None that is known.
    pub const NONE: Self =
        Self { exponent: Exponent::ZERO, of_revolutions: false, is_alone: false };

    /// Of a number that is written out.
    pub(super) const NUMBER: Self = Self { is_alone: true, ..Self::NONE };

    /// Of a quantity that is given in that unit.
    pub(super) fn of(unit: &Unit) -> Self {
        let of_revolutions = unit.counts_revolutions();
        let exponent = unit.angle_exponent();
        let is_alone = !exponent.is_zero() && unit.dimension().is_of_time();
        Self { exponent, of_revolutions, is_alone }
    }

    /// Of the product of two quantities.
    pub(super) fn times(self, other: Self) -> Self {
        let Some(exponent) = self.exponent.checked_add(other.exponent) else { return Self::NONE };
        Self {
            exponent,
            of_revolutions: self.of_revolutions || other.of_revolutions,
            is_alone: self.is_alone && other.is_alone,
        }
    }

    /// Of a power.
    pub(super) fn to_the(self, power: Exponent) -> Self {
        match self.exponent.checked_mul(power) {
            Some(exponent) => Self { exponent, ..self },
            None => Self::NONE,
        }
    }

    /// Of a quotient.
    pub(super) fn over(self, divisor: Self) -> Self {
        self.times(divisor.to_the(Exponent::integer(-1)))
    }

    /// Of the sum of two quantities.
    pub(super) fn plus(self, other: Self) -> Self {
        if self.exponent != other.exponent {
            return Self::NONE;
        }
        Self {
            of_revolutions: self.of_revolutions || other.of_revolutions,
            is_alone: self.is_alone && other.is_alone,
            ..self
        }
    }

    /// Whether it is an angle or an angular velocity, and nothing else.
    pub(super) fn is_angle(self) -> bool {
        self.is_alone && self.exponent == Exponent::ONE
    }

    /// Whether a result of this kind is read in two ways in a unit that names no angle.
    pub(super) fn is_ambiguous(self) -> bool {
        self.is_alone
            && self.of_revolutions
            && !matches!(self.exponent, Exponent::ZERO | Exponent::ONE)
    }
}
