//! How a part of a formula hangs on a zero that it counts from.
//!
//! A sum of Celsius temperatures is one itself, or a difference, only as a whole: of `(t1 + t2)/2`
//! the first half is neither. So the factors are added up, and judged where the sum is used. In the
//! same way a product with a number of degrees Celsius is right only with the coefficient per degC
//! that may still follow.

use super::typing::{KelvinKind, LevelReference, Typing};
use gumption_units::{Dimension, Exponent, Zero};

/// What two sums of factors may differ by through rounding: far more than double precision leaves
/// in some thousand terms, far less than anybody writes.
const ROUNDING: f64 = 1e-9;

/// How a part hangs on a zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Tie {
    /// Not at all.
    None,
    /// A sum of quantities that count from a zero.
    Sum {
        zero: Zero,
        /// What their factors add to.
        weight: f64,
        /// The factors of quantities that may count from it or be differences: numbers of degrees
        /// by their coefficients.
        loose: f64,
    },
    /// A product of such quantities with a power of degrees Celsius that no coefficient has taken
    /// up; where that began, and the quantity.
    Product { power: Exponent, at: usize, of: usize },
}

impl Tie {
    /// Of a quantity as it is.
    pub(super) fn of(typing: Typing) -> Self {
        match typing.zero {
            Some(zero) => Self::Sum { zero, weight: 1.0, loose: 0.0 },
            None => Self::None,
        }
    }

    /// Whether its zero is a quantity that another level can be given above: a carrier, an isotropic
    /// antenna.
    pub(super) fn is_relative(self) -> bool {
        matches!(self, Self::Sum { zero: Zero::Carrier | Zero::Isotropic, .. })
    }

    /// The power of degrees Celsius that count from the zero.
    pub(super) fn power(self) -> Exponent {
        match self {
            Self::Sum { zero: Zero::Celsius, .. } => Exponent::ONE,
            Self::Product { power, .. } => power,
            Self::None | Self::Sum { .. } => Exponent::ZERO,
        }
    }

    /// All factors multiplied by a number.
    pub(super) fn times(self, factor: f64) -> Self {
        match self {
            Self::Sum { zero, weight, loose } => {
                Self::Sum { zero, weight: weight * factor, loose: loose * factor }
            }
            other => other,
        }
    }

    /// The same beside what hangs on the zero of a level: one whose logarithm names a reference hangs
    /// on that.
    pub(super) fn beside(self, typing: Typing, other: Self) -> Self {
        match (self, typing.reference, other) {
            (Self::None, LevelReference::Above(zero), Self::Sum { .. }) => {
                Self::Sum { zero, weight: 1.0, loose: 0.0 }
            }
            _ => self,
        }
    }

    /// The kind of a sum as a whole; `None` if it is none: factors that add to neither 1 nor 0.
    pub(super) fn settled(self, typing: Typing) -> Option<Typing> {
        let is = |sum: f64, whole: f64| (sum - whole).abs() < ROUNDING;
        let typing = match self {
            Self::Sum { zero, weight, .. } if zero != Zero::Celsius && is(weight, 0.0) => {
                Typing { reference: LevelReference::Ratio, ..typing }
            }
            Self::Sum { .. } => Typing { reference: LevelReference::Unknown, ..typing },
            Self::None | Self::Product { .. } => typing,
        };
        match self {
            Self::None => Some(typing),
            Self::Sum { zero, weight, .. } if is(weight, 1.0) => {
                Some(Typing { zero: Some(zero), ..typing })
            }
            Self::Sum { weight, loose, .. } if is(weight, 0.0) && is(loose, 0.0) => {
                Some(Typing { zero: None, kelvin: KelvinKind::Difference, ..typing })
            }
            Self::Sum { weight, loose, .. } if is(weight, 0.0) && is(loose, 1.0) => {
                Some(Typing { zero: None, celsius_exponent: Exponent::ONE, ..typing })
            }
            Self::Sum { zero, weight, loose } if is(weight + loose, 1.0) => {
                Some(Typing { zero: Some(zero), ..typing })
            }
            Self::Sum { weight, loose, .. } if is(weight + loose, 0.0) => {
                Some(Typing { zero: None, kelvin: KelvinKind::Difference, ..typing })
            }
            // levels may be added and scaled as one likes; then they are above no reference
            Self::Sum { zero, .. } if zero != Zero::Celsius => {
                Some(Typing { zero: None, reference: LevelReference::Added, ..typing })
            }
            Self::Sum { .. } | Self::Product { .. } => None,
        }
    }

    /// What a sum is that has come to an end of its own: a difference is no sum with a zero.
    pub(super) fn reduced(self, typing: Typing) -> (Self, Typing) {
        let weight = match self {
            Self::Sum { weight, .. } => weight,
            _ => 0.0,
        };
        match self.settled(typing) {
            // (L1 + L2)/2 is a level above the reference, although L1 + L2 is none
            Some(typing) if typing.zero.is_none() && weight.abs() < ROUNDING => {
                (Self::None, typing)
            }
            Some(typing) => (self, typing),
            None => (self, Typing { zero: None, ..typing }),
        }
    }
}

/// What is left of a power of degrees Celsius and of the exponent of degrees Celsius in the units of
/// coefficients, after the one has taken up the other.
pub(super) fn taken_up(power: Exponent, unit: Exponent) -> (Exponent, Exponent) {
    let (p, u) = (power.to_f64(), unit.to_f64());
    if p * u >= 0.0 {
        return (power, unit);
    }
    match power.checked_add(unit) {
        Some(rest) if p.abs() > u.abs() => (rest, Exponent::ZERO),
        Some(rest) => (Exponent::ZERO, rest),
        None => (power, unit),
    }
}

/// The exponent of degrees Celsius in a unit, as far as the dimension bears it: a coefficient per
/// degC times a difference in K is a number and takes up nothing more.
pub(super) fn borne(exponent: Exponent, dimension: Option<Dimension>) -> Exponent {
    let Some(dimension) = dimension else { return Exponent::ZERO };
    let (own, bound) = (exponent.to_f64(), dimension.of_temperature().to_f64());
    if own * bound <= 0.0 {
        Exponent::ZERO
    } else if own.abs() > bound.abs() {
        dimension.of_temperature()
    } else {
        exponent
    }
}
