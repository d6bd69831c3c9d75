//! Whether a result can be reported in a unit of its dimension: by its zero, as a level, by what it
//! counts.

use std::error::Error;
use std::fmt;

use super::typing::{KelvinKind, LevelReference, Typing};
use gumption_units::{Exponent, Turn, Unit, Zero};

/// Why a quantity cannot be given in a unit, although the dimension fits. `Display` gives the
/// reason and what to write, to be put after the quantity's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ScaleMisfit {
    /// A Celsius temperature in a unit that counts from absolute zero.
    CelsiusInKelvin,
    /// A thermodynamic temperature, or one in K that may be a difference, in degrees Celsius.
    KelvinInCelsius {
        /// Whether it is known to be a thermodynamic temperature.
        thermodynamic: bool,
    },
    /// A plain ratio in decibels.
    RatioAsLevel,
    /// A level in a unit of ratios.
    LevelAsRatio,
    /// A product of levels in a unit that is none of their power.
    LevelPower,
    /// A level whose reference is not that of the unit.
    OtherReference {
        /// The reference of the level.
        found: Option<Zero>,
        /// That of the unit.
        expected: Option<Zero>,
    },
    /// A gain, or the ratio of two quantities, in a unit whose levels are above a power or a voltage.
    RatioAboveReference {
        /// The reference of the unit.
        expected: Zero,
    },
    /// A level above what its formula names, in a unit whose levels are above something else.
    ReferenceOfNoUnit {
        /// The reference of the unit.
        expected: Zero,
    },
    /// A rate of revolutions where the unit does not say what it counts, or such a rate in revolutions.
    Revolutions,
    /// A power of revolutions, such as 1 over so many rpm, in a unit that does not name them.
    PowerOfRevolutions {
        /// The exponent of angle in it.
        exponent: Exponent,
    },
    /// Periods where angle is counted, or angle where periods are.
    Turns {
        /// What the quantity counts.
        found: Turn,
    },
}

impl Error for ScaleMisfit {}

impl fmt::Display for ScaleMisfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let level = |zero: Option<Zero>| zero.map_or("dB", Zero::unit);
        match self {
            Self::CelsiusInKelvin => f.write_str(
                "is a Celsius temperature, whose zero is at 273.15 K; write `kelvin(...)` for the \
                 thermodynamic temperature, or give it in `degC`",
            ),
            Self::KelvinInCelsius { thermodynamic: true } => f.write_str(
                "is a thermodynamic temperature in K; write `celsius(...)` for the Celsius \
                 temperature, or give it in `K`",
            ),
            Self::KelvinInCelsius { thermodynamic: false } => f.write_str(
                "is in K and not known to be a difference of Celsius temperatures; write \
                 `celsius(...)` of a temperature in K for the Celsius temperature, without \
                 `- 273.15 [K]`, `(...) [degC]` of its number of degrees Celsius, or give a difference \
                 in `K`",
            ),
            Self::RatioAsLevel => f.write_str(
                "is a plain ratio and no level; write `10*log10(...)` of a ratio of powers, \
                 `20*log10(...)` of a ratio of amplitudes, `ln(...)*1 [Np]` of it in nepers, or `... [dB]` \
                 for a number of decibels",
            ),
            Self::LevelAsRatio => f.write_str(
                "is a level in decibels; write `10^(.../10)` for the ratio of powers, \
                 `10^(.../20)` for the ratio of amplitudes, or give it in `dB`",
            ),
            Self::LevelPower => f.write_str(
                "is a product of levels in decibels, whose unit is a power of `dB`, such as `dB^2`",
            ),
            Self::OtherReference { found, expected: None } => write!(
                f,
                "is a level in {}, which has a reference; give it in `{0}`, or take the difference \
                 of two",
                level(*found)
            ),
            Self::OtherReference { found, expected } => {
                write!(f, "is a level in {}, not in {}", level(*found), level(*expected))?;
                match expected.and_then(written_out) {
                    Some(formula) => write!(f, "; write the reference out, such as `{formula}`"),
                    None => f.write_str("; write the reference out, such as `10*log10(P/1 [mW])`"),
                }
            }
            Self::RatioAboveReference { expected } => {
                let (unit, reference) = (expected.unit(), expected.reference().unwrap_or_default());
                write!(
                    f,
                    "is a ratio in dB (a gain, or the level of one quantity above another), and a \
                     level in {unit} is above 1 {reference}; give it in `dB`, add it to a level in \
                     {unit}"
                )?;
                written_out(*expected).map_or(Ok(()), |formula| write!(f, ", or write `{formula}`"))
            }
            Self::ReferenceOfNoUnit { expected } => {
                let (unit, reference) = (expected.unit(), expected.reference().unwrap_or_default());
                write!(
                    f,
                    "is a level above the reference that its formula names, and a level in {unit} \
                     is above 1 {reference}; give it in `dB`"
                )?;
                written_out(*expected).map_or(Ok(()), |formula| write!(f, ", or write `{formula}`"))
            }
            Self::Revolutions => f.write_str(
                "can count revolutions or radians, of which one is in the unit and the other in the formula; \
                 give both in `rpm` or both in `1/min`",
            ),
            Self::PowerOfRevolutions { exponent } => {
                let [whole, radians] = ["rev", "rad"].map(|unit| taken_out(unit, *exponent));
                let per = if exponent.to_f64() < 0.0 { "is divided by" } else { "is a power of" };
                write!(
                    f,
                    "{per} what counts revolutions, and the unit does not state whether of \
                     radians or of revolutions; write `...{whole}` for revolutions, \
                     `...{radians}` for radians"
                )
            }
            Self::Turns { found: Turn::Periods } => f.write_str(
                "counts periods, and the unit counts angle; write `2*pi*...` or `...*[rev]`",
            ),
            Self::Turns { found: Turn::Angle } => f.write_str(
                "counts angle, and the unit counts periods; write `.../(2*pi)` or `.../[rev]`",
            ),
        }
    }
}

/// What takes a power of a unit out of a formula: `*[rev]` of the exponent -1.
fn taken_out(unit: &str, exponent: Exponent) -> String {
    let negative = exponent.to_f64() < 0.0;
    let operator = if negative { '*' } else { '/' };
    let size = if negative { exponent.checked_neg().unwrap_or(exponent) } else { exponent };
    match size {
        Exponent::ONE => format!("{operator}[{unit}]"),
        size if size.is_integer() => format!("{operator}[{unit}]^{size}"),
        size => format!("{operator}[{unit}]^({size})"),
    }
}

/// A formula of the levels above a reference.
fn written_out(zero: Zero) -> Option<String> {
    let unit = zero.reference()?;
    let factor = zero.decibels_per_decade()?;
    let of = if factor == 10 { 'P' } else { 'V' };
    Some(format!("{factor}*log10({of}/1 [{unit}])"))
}

impl Typing {
    /// Whether a value can be given in a unit, where nobody is told of what it counts: as
    /// [`Self::reported_in`], and no revolutions for `1/min`, nor the reverse.
    ///
    /// # Errors
    /// Why not.
    pub fn given_in(self, unit: &Unit) -> Result<(), ScaleMisfit> {
        match self.rate.is_unlike(Self::in_unit(unit).rate) {
            true => Err(ScaleMisfit::Revolutions),
            false => self.reported_in(unit),
        }
    }

    /// Whether a result can be reported in a unit of its dimension as it is.
    ///
    /// # Errors
    /// Why not.
    pub fn reported_in(self, unit: &Unit) -> Result<(), ScaleMisfit> {
        if self.dimension.is_none() {
            return Ok(());
        }
        match (self.turn, unit.turn()) {
            (Some(found), Some(expected)) if found != expected => {
                return Err(ScaleMisfit::Turns { found });
            }
            _ => {}
        }
        let is_of_time = unit.dimension().is_of_time();
        if is_of_time && self.angle.is_ambiguous() && !unit.counts_angle() {
            return Err(ScaleMisfit::PowerOfRevolutions { exponent: self.angle.exponent });
        }
        let level = unit.level_exponent();
        if self.level != level {
            return match (self.level, level) {
                (Exponent::ZERO, _) => Err(ScaleMisfit::RatioAsLevel),
                // what a number of decibels is above would be lost
                (_, Exponent::ZERO) if self.zero.is_some() => {
                    Err(ScaleMisfit::OtherReference { found: self.zero, expected: None })
                }
                // the number of decibels, as a number
                (_, Exponent::ZERO) if unit.factors().is_empty() => Ok(()),
                (Exponent::ONE, _) => Err(ScaleMisfit::LevelAsRatio),
                _ => Err(ScaleMisfit::LevelPower),
            };
        }
        match (self.zero, unit.zero()) {
            (Some(Zero::Celsius), None) => Err(ScaleMisfit::CelsiusInKelvin),
            (None, Some(Zero::Celsius))
                if self.kelvin != KelvinKind::Difference && !self.counts_degrees() =>
            {
                let thermodynamic = self.kelvin == KelvinKind::Thermodynamic;
                Err(ScaleMisfit::KelvinInCelsius { thermodynamic })
            }
            (None, expected @ Some(zero)) => match self.reference {
                LevelReference::Above(found) if found != zero => {
                    Err(ScaleMisfit::OtherReference { found: Some(found), expected })
                }
                // of a full scale or a carrier nothing is known
                _ if zero.reference().is_none() => Ok(()),
                LevelReference::Ratio => Err(ScaleMisfit::RatioAboveReference { expected: zero }),
                LevelReference::Other => Err(ScaleMisfit::ReferenceOfNoUnit { expected: zero }),
                _ => Ok(()),
            },
            (None, None) => Ok(()),
            (found, expected) => match Zero::shift(found, expected) {
                Some(_) => Ok(()),
                None => Err(ScaleMisfit::OtherReference { found, expected }),
            },
        }
    }

    /// What is added to a number of formulas where it becomes a value that counts from the zero of a
    /// unit of its dimension: an estimate in K from a Celsius temperature.
    ///
    /// # Errors
    /// Where nothing that is added makes it one.
    pub fn shift_to(self, unit: &Unit) -> Result<f64, ScaleMisfit> {
        match self.reported_in(unit) {
            Ok(()) if self.zero.is_some() => Ok(Zero::shift(self.zero, unit.zero()).unwrap_or(0.0)),
            Ok(()) => Ok(0.0),
            Err(misfit @ (ScaleMisfit::CelsiusInKelvin | ScaleMisfit::KelvinInCelsius { .. })) => {
                Zero::shift(self.zero, unit.zero()).ok_or(misfit)
            }
            Err(misfit) => Err(misfit),
        }
    }
}
