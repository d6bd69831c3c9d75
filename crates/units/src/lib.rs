//! Units of measurement at run time: reading them from text, their dimension and their size.
//!
//! [`Unit::parse`] reads SI units with prefixes, the usual non-SI units of metrology, and products,
//! quotients and powers of them:
//!
//! ```text
//! m/s^2   kg*m^-3   kg·m⁻³   W/(m^2 K)   nV/√Hz   nV/Hz^(1/2)   10^-6/K   1e-6/K   %   1
//! ```
//!
//! Three things to know:
//!
//! * `degC` has the dimension of temperature and the factor 1, because a difference of 1 degC is 1
//!   K. A value, unlike a difference, counts from a zero of its own, [`Unit::zero`]:
//!   [`Unit::convert`] adds 273.15, factors never do. The same applies to `degF` and to levels such
//!   as `dBm`.
//! * Levels in `dB` and `Np` are plain numbers but not ratios; they convert only into each other.
//! * Angles are dimensionless, so `deg`, `rad`, `%` and `1` convert into each other.
//! * `g` is the gram and `mg` the milligram; the standard acceleration of free fall is `g_n`.

#![cfg_attr(test, allow(clippy::disallowed_methods))] // tests compare within tolerances

mod defined;
mod dimension;
mod dsi;
mod error;
mod exponent;
mod factor;
mod listed;
mod names;
mod nearest;
mod parse;
mod power;
mod scale;
mod suggest;
#[cfg(test)]
mod tests;
mod zero;

use std::fmt;
use std::str::FromStr;

pub use dimension::Dimension;
pub use error::{IncompatibleUnits, MissingSide, UnitError};
pub use exponent::Exponent;
pub use factor::{Factor, FactorBase};
pub use listed::listed;
pub use names::{Prefix, Symbol, prefixes, symbols};
pub use nearest::{all_nearest, nearest};
pub use zero::{Turn, Zero};

use names::{Flavour, Meaning};
use scale::Scale;

/// A unit of measurement: its text as written, its factors, its dimension, and its size in coherent
/// SI units.
///
/// Two units are equal if their texts are; `mm` and `1e-3*m` are compatible but not equal.
///
/// ```
/// use gumption_units::{Dimension, Unit};
///
/// let sensitivity = Unit::parse("mV/(m/s²)")?;
/// assert_eq!(sensitivity.factor(), 1e-3);
/// assert_eq!(sensitivity.dimension().to_string(), "kg m s^-1 A^-1");
///
/// // the spelling is gone from the factors
/// let factors = sensitivity.factors();
/// assert_eq!(factors, Unit::parse("mV*m**-1 s^(2)")?.factors());
/// let written: Vec<String> =
///     factors.iter().map(|factor| format!("{}^{}", factor.base, factor.exponent)).collect();
/// assert_eq!(written, ["mV^1", "m^-1", "s^2"]);
///
/// let (speed, wanted) = (Unit::parse("km/h")?, Unit::parse("m/s")?);
/// assert_eq!(speed.to_si(36.0), 10.0);
/// assert_eq!(Unit::conversion_factor(&wanted, &speed)?, 3.6);
/// assert!(Unit::conversion_factor(&speed, &sensitivity).is_err());
///
/// let error = Unit::parse("m/sec").unwrap_err();
/// assert_eq!((error.span(), error.suggestions()), (2..5, vec!["s"]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Unit {
    text: String,
    factors: Vec<Factor>,
    dimension: Dimension,
    scale: Scale,
    factor: f64,
    fraction: Option<(f64, f64)>,
    flavour: Flavour,
}

impl Unit {
    /// The longest unit text, in bytes.
    pub const MAX_LENGTH: usize = parse::MAX_LENGTH;

    /// The largest exponent of a unit, in size, and the largest denominator of an exponent.
    pub const MAX_EXPONENT: u32 = error::MAX_EXPONENT;

    /// The unit of a plain number, `1`.
    pub fn one() -> Self {
        Self::new("1".to_owned(), parse::ONE, Vec::new())
    }

    /// The coherent SI unit of a dimension in base units, such as `kg m^2 s^-2`.
    pub fn coherent(dimension: Dimension) -> Self {
        let meaning = Meaning { dimension, ..parse::ONE };
        Self::new(dimension.to_string(), meaning, dimension.factors())
    }

    /// Reads a unit from text; an empty text is a plain number.
    ///
    /// # Errors
    ///
    /// [`UnitError`] says what is wrong, where, and what may be meant. No text causes a panic or a
    /// long run time.
    pub fn parse(text: &str) -> Result<Self, UnitError> {
        let (meaning, factors) = parse::parse(text)?;
        Ok(Self::new(text.to_owned(), meaning, factors))
    }

    /// Reads a unit from a text that may contain units defined by [`Unit::defined`].
    ///
    /// # Errors
    ///
    /// As [`Unit::parse`].
    ///
    /// ```
    /// use gumption_units::Unit;
    ///
    /// let own = [Unit::defined("tex", &Unit::parse("1e-6*kg/m")?)?];
    /// let tenacity = Unit::parse_among("cN/tex", &own)?;
    /// assert_eq!((tenacity.factor(), tenacity.normal_text()), (1e4, "cN/tex".to_owned()));
    /// assert!(Unit::parse("cN/tex").is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn parse_among(text: &str, own: &[Self]) -> Result<Self, UnitError> {
        let (meaning, factors) = parse::parse_among(text, own)?;
        Ok(Self::new(text.to_owned(), meaning, factors))
    }

    /// A unit with its own name and the size of another unit: the hardness `HBW`, which is a plain
    /// number. Its dimension and size are those of the definition, its text is the name.
    ///
    /// # Errors
    ///
    /// The name is not of letters and digits with a letter in front, it is the name of a unit
    /// already, or there are too many names.
    ///
    /// ```
    /// use gumption_units::Unit;
    ///
    /// let hardness = Unit::defined("HBW", &Unit::one())?;
    /// assert_eq!((hardness.text(), hardness.factor()), ("HBW", 1.0));
    /// assert_eq!(hardness.normal_text(), "HBW");
    /// assert!(Unit::defined("mm", &Unit::one()).is_err());
    /// # Ok::<(), &str>(())
    /// ```
    pub fn defined(name: &str, definition: &Self) -> Result<Self, &'static str> {
        let interned = defined::intern(name)?;
        let factors = if definition.has_kind() {
            definition.factors.clone()
        } else {
            vec![Factor::of(FactorBase::Defined(interned))]
        };
        Ok(Self::new(name.to_owned(), definition.meaning(), factors))
    }

    fn new(text: String, meaning: Meaning, factors: Vec<Factor>) -> Self {
        let Meaning { dimension, scale, flavour } = meaning;
        let (factor, fraction) = (scale.value(), scale.fraction());
        Self { text, factors, dimension, scale, factor, fraction, flavour }
    }

    /// What the unit is, without its text.
    fn meaning(&self) -> Meaning {
        Meaning { dimension: self.dimension, scale: self.scale, flavour: self.flavour }
    }

    /// Whether its values have a kind besides their size: temperatures and levels with a zero,
    /// fractions, angles and numbers of periods.
    fn has_kind(&self) -> bool {
        self.flavour != Flavour::Plain
            || self.turn().is_some()
            || [self.level_exponent(), self.celsius_exponent()].iter().any(|e| !e.is_zero())
    }

    /// The text as written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The factors whose product is the unit, in the order in which they are written; none for the
    /// number 1. Every spelling of a unit has the same: `m/s^2`, `m·s⁻²`, `m s**-2`. Factors of one
    /// unit are not merged: `um/m` and `s*s` have two each.
    pub fn factors(&self) -> &[Factor] {
        &self.factors
    }

    /// The factors as a text that is the same for every spelling of the unit and reads back as the
    /// same unit: `D·s^2/m` for `D/(m/s²)`, `W/(m^2·K)` for `W m^-2 K^-1`.
    pub fn normal_text(&self) -> String {
        factor::normal_text(&self.factors)
    }

    /// The dimension.
    pub fn dimension(&self) -> Dimension {
        self.dimension
    }

    /// The size of the unit in coherent SI units: 0.001 for `mm`, pi/180 for `deg`, 0.01 for `%`,
    /// 1 for `degC`.
    ///
    /// A normal positive number. It is the nearest `f64` to the exact value unless roots or very
    /// long literals occur; then it is within a few units in the last place.
    pub fn factor(&self) -> f64 {
        self.factor
    }

    /// Whether the unit is the degree Celsius or Fahrenheit on its own. `W/degC` is not.
    pub fn is_celsius(&self) -> bool {
        self.flavour == Flavour::Celsius
    }

    /// The zero from which values in the unit count: the zero of the Celsius scale for `degC` and
    /// `degF`, the reference for `dBm`. `None` for every other unit.
    pub fn zero(&self) -> Option<Zero> {
        match self.flavour {
            Flavour::Celsius => Some(Zero::Celsius),
            Flavour::Level(zero) => zero,
            Flavour::Plain | Flavour::Relative => None,
        }
    }

    /// Whether values in the unit are levels with a reference: true for `dBm`, false for `dB`.
    pub fn has_reference(&self) -> bool {
        matches!(self.flavour, Flavour::Level(Some(_)))
    }

    /// The exponent of the decibels (or nepers) in the unit: 1 for `dB` and `dB/m`, 0 without them.
    pub fn level_exponent(&self) -> Exponent {
        self.exponent_of(|symbol| matches!(symbol.flavour, Flavour::Level(_)))
    }

    /// The exponent of the degrees Celsius in the unit: -1 for `ppm/degC`. Degrees Fahrenheit do
    /// not count: formulas compute temperatures in `degF` as numbers of degrees Celsius, which a
    /// coefficient per degree Fahrenheit must not multiply.
    pub fn celsius_exponent(&self) -> Exponent {
        self.exponent_of(|symbol| symbol.flavour == Flavour::Celsius && symbol.name() != "degF")
    }

    /// The total exponent of the symbols of a kind; 0 if that is out of range.
    fn exponent_of(&self, is_of_kind: impl Fn(&Symbol) -> bool) -> Exponent {
        let of_kind = self.factors.iter().filter(|factor| match factor.base {
            FactorBase::Named { symbol, .. } => is_of_kind(symbol),
            FactorBase::Number(_) | FactorBase::Defined(_) => false,
        });
        let sum = of_kind
            .map(|factor| factor.exponent)
            .try_fold(Exponent::ZERO, |sum, exponent| sum.checked_add(exponent));
        sum.unwrap_or(Exponent::ZERO)
    }

    /// What numbers in the unit count, for plain numbers and powers of time: angle for `rad`,
    /// `deg/s`, `rpm`, periods for `Hz`; `None` for `1/s`, `Bq`, and for other dimensions.
    pub fn turn(&self) -> Option<Turn> {
        let of = |wanted: fn(&str) -> bool| {
            let exponents = self.factors.iter().filter_map(|factor| match factor.base {
                FactorBase::Named { symbol, .. } if wanted(symbol.name()) => Some(factor.exponent),
                _ => None,
            });
            exponents.into_iter().try_fold(Exponent::ZERO, Exponent::checked_add)
        };
        match (of(is_angle)?, of(|name| name == "Hz")?) {
            _ if !self.dimension.is_of_time() => None,
            (Exponent::ONE, Exponent::ZERO) => Some(Turn::Angle),
            (Exponent::ZERO, Exponent::ONE) => Some(Turn::Periods),
            _ => None,
        }
    }

    /// The offset that is added to a value in the unit, times its size, to give the number with
    /// which formulas compute: -160/9 for `degF`, and 0 for every other unit.
    pub fn offset(&self) -> f64 {
        let is_fahrenheit = self.flavour == Flavour::Celsius && self.factor != 1.0;
        if is_fahrenheit { FAHRENHEIT_OFFSET } else { 0.0 }
    }

    /// Whether values in both units count from the same zero, so that a quantity and a difference
    /// of quantities convert in the same way: true for `mm` and `m`, `K` and `mK`; false for `degC`
    /// and `K`, and for `degC` and `degF`.
    pub fn has_zero_of(&self, other: &Self) -> bool {
        self.zero() == other.zero() && self.offset() == other.offset()
    }

    /// Whether the unit is `%`, `‰`, `ppm` or `ppb` on its own. `ppm/K` is not.
    pub fn is_relative(&self) -> bool {
        self.flavour == Flavour::Relative
    }

    /// The unit in which differences of values and uncertainties are stated: `dB` for levels with a
    /// reference such as `dBm`, otherwise the unit itself.
    ///
    /// ```
    /// use gumption_units::Unit;
    ///
    /// assert_eq!(Unit::parse("dBm")?.of_differences().text(), "dB");
    /// assert_eq!(Unit::parse("degC")?.of_differences().text(), "degC");
    /// # Ok::<(), gumption_units::UnitError>(())
    /// ```
    #[must_use]
    pub fn of_differences(&self) -> Self {
        let decibel = Self::parse("dB").ok();
        decibel.filter(|_| self.has_reference()).unwrap_or_else(|| self.clone())
    }

    /// The product of powers of units, with the factors of one unit merged: `V/ohm` and `ohm` give `V`.
    /// `None` where an exponent or the text would be out of range.
    ///
    /// ```
    /// use gumption_units::{Exponent, Unit};
    ///
    /// let parts = [("g", 1), ("mm", -2), ("mm", -1)];
    /// let parts = parts.map(|(text, power)| (Unit::parse(text).unwrap(), Exponent::integer(power)));
    /// assert_eq!(Unit::product(parts).unwrap().text(), "g/mm^3");
    /// ```
    pub fn product(parts: impl IntoIterator<Item = (Self, Exponent)>) -> Option<Self> {
        let mut merged: Vec<Factor> = Vec::new();
        for (unit, power) in parts {
            for factor in unit.factors {
                let exponent = factor.exponent.checked_mul(power)?;
                match merged.iter_mut().find(|known| known.base == factor.base) {
                    Some(known) => known.exponent = known.exponent.checked_add(exponent)?,
                    None => merged.push(Factor { exponent, ..factor }),
                }
            }
        }
        merged.retain(|factor| !factor.exponent.is_zero());
        Self::parse(&factor::normal_text(&merged)).ok()
    }

    /// A value in this unit, converted to the coherent SI unit. Degrees Celsius are not shifted.
    ///
    /// Rounded once if the size of the unit is a quotient of moderate integers, as for `mm` or
    /// `km/h`: 9 mm is exactly the `f64` nearest to 0.009 m. A multiplication by [`Unit::factor`]
    /// may differ in the last bit.
    pub fn to_si(&self, value: f64) -> f64 {
        match self.fraction {
            Some((numerator, denominator)) => {
                let converted = value * numerator / denominator;
                if converted.is_finite() { converted } else { value * self.factor }
            }
            None => value * self.factor,
        }
    }

    /// A value in the coherent SI unit, converted to this unit. Degrees Celsius are not shifted.
    /// Rounded as by [`Unit::to_si`].
    pub fn from_si(&self, value: f64) -> f64 {
        match self.fraction {
            Some((numerator, denominator)) => {
                let converted = value * denominator / numerator;
                if converted.is_finite() { converted } else { value / self.factor }
            }
            None => value / self.factor,
        }
    }

    /// A value in this unit as the number with which formulas compute: as [`Unit::to_si`], but for
    /// degrees Fahrenheit the number of degrees Celsius.
    pub fn value_to_si(&self, value: f64) -> f64 {
        match self.offset() {
            0.0 => self.to_si(value),
            _ => self.to_si(value - FAHRENHEIT_ZERO),
        }
    }

    /// The number with which formulas compute as a value in this unit: as [`Unit::from_si`], but
    /// for degrees Fahrenheit from the number of degrees Celsius.
    pub fn value_from_si(&self, value: f64) -> f64 {
        match self.offset() {
            0.0 => self.from_si(value),
            _ => self.from_si(value) + FAHRENHEIT_ZERO,
        }
    }

    /// A value in the unit `from`, converted to the unit `to` with the zeros of their scales:
    /// 20 degC is 293.15 K, and 68 degF.
    ///
    /// For widths and differences use [`Unit::conversion_factor`].
    ///
    /// # Errors
    ///
    /// [`IncompatibleUnits`] under the conditions of [`Unit::conversion_factor`], and if the
    /// references of levels belong to different kinds of quantity.
    pub fn convert(value: f64, from: &Self, to: &Self) -> Result<f64, IncompatibleUnits> {
        let factor = Self::conversion_factor(from, to)?;
        let shift = Zero::shift(from.zero(), to.zero());
        let shift = shift.ok_or_else(|| Self::incompatible(from, to))?;
        if shift == 0.0 && from.offset() == 0.0 && to.offset() == 0.0 {
            return Ok(value * factor);
        }
        Ok(to.value_from_si(from.value_to_si(value) + shift))
    }

    /// What the unit measures, in words for an error message.
    pub fn describe(&self) -> String {
        match (self.flavour, self.turn()) {
            (Flavour::Level(_), _) => format!("a level ({})", self.text.trim()),
            _ if self.dimension.is_none() && !self.level_exponent().is_zero() => {
                "a level".to_owned()
            }
            (_, Some(Turn::Periods)) => "a frequency, which counts periods".to_owned(),
            (_, Some(Turn::Angle)) if self.dimension.is_none() => "an angle".to_owned(),
            (_, Some(Turn::Angle)) => "an angular velocity, which counts angle".to_owned(),
            _ => self.dimension.describe(),
        }
    }

    fn incompatible(from: &Self, to: &Self) -> IncompatibleUnits {
        let alike = from.is_compatible(to) && !from.counts_as(to);
        let beside = |unit: &Self| {
            let of = Counted::of(unit);
            match (unit.turn(), of.angle, of.periods) {
                _ if !alike => unit.describe(),
                (Some(_), ..) => unit.describe(),
                (None, true, _) => format!("{}, counted in angle", unit.describe()),
                (None, false, true) => format!("{}, counted in periods", unit.describe()),
                (None, false, false) => {
                    format!("{}, of revolutions or of radians", unit.describe())
                }
            }
        };
        IncompatibleUnits {
            from: from.text.clone().into(),
            from_dimension: from.dimension,
            from_is: beside(from).into(),
            to: to.text.clone().into(),
            to_dimension: to.dimension,
            to_is: beside(to).into(),
        }
    }

    /// Whether the unit contains revolutions: `rpm`, `rev/s`.
    pub fn counts_revolutions(&self) -> bool {
        self.factors.iter().any(|factor| match factor.base {
            FactorBase::Named { symbol, .. } => matches!(symbol.name(), "rpm" | "rev" | "turn"),
            FactorBase::Number(_) | FactorBase::Defined(_) => false,
        })
    }

    /// The exponent of angle in the unit: 1 for `rpm` and `rad/s`, -1 for `V/rpm`, 0 without angle.
    pub fn angle_exponent(&self) -> Exponent {
        self.exponent_of(|symbol| is_angle(symbol.name()))
    }

    /// Whether the unit contains angle, in any power: `deg`, `V/rpm`, `1/rev`.
    pub fn counts_angle(&self) -> bool {
        Counted::of(self).angle
    }

    /// Whether numbers in both units count the same. Not so for periods and angle, in any power, as
    /// in `V/Hz` and `V/rpm`; nor for revolutions, or degrees per time, and a unit that may mean
    /// revolutions or radians, such as `1/min`.
    fn counts_as(&self, other: &Self) -> bool {
        let own = Counted::of(self);
        let others = Counted::of(other);
        let unsaid = |of: Counted| !of.angle && !of.periods;
        let is_open =
            |of: Counted, unit: &Self| of.revolutions || of.degrees && !unit.dimension.is_none();
        !(own.angle && others.periods && !own.periods && !others.angle
            || own.periods && others.angle && !own.angle && !others.periods
            || is_open(own, self) && unsaid(others)
            || is_open(others, other) && unsaid(own))
    }

    /// Whether the other unit has the same dimension, and is a level if this one is.
    pub fn is_compatible(&self, other: &Self) -> bool {
        self.dimension == other.dimension && self.level_exponent() == other.level_exponent()
    }

    /// The factor by which a value in the unit `from` is multiplied to give the value in the unit
    /// `to`: 1000 from `m` to `mm`. Computed from the exact sizes, not from the rounded factors.
    /// May be infinite or zero if the sizes differ by more than about 300 powers of ten.
    ///
    /// # Errors
    ///
    /// [`IncompatibleUnits`] if the dimensions differ, if only one unit is a level, if one is a
    /// frequency in `Hz` and the other counts angle, or if one counts revolutions and the other
    /// nothing, as `1/min`.
    pub fn conversion_factor(from: &Self, to: &Self) -> Result<f64, IncompatibleUnits> {
        if !from.is_compatible(to) || !from.counts_as(to) {
            return Err(Self::incompatible(from, to));
        }
        let exact = to.scale.inverse().and_then(|inverse| from.scale.times(inverse));
        Ok(exact.map_or(from.factor / to.factor, Scale::value))
    }
}

/// What numbers in a unit count, in any power.
#[derive(Clone, Copy)]
struct Counted {
    /// Angle of any kind.
    angle: bool,
    /// Revolutions.
    revolutions: bool,
    /// Degrees and their parts, which are not coherent units.
    degrees: bool,
    /// Periods.
    periods: bool,
}

impl Counted {
    fn of(unit: &Unit) -> Self {
        let has = |is: fn(&str) -> bool| !unit.exponent_of(|symbol| is(symbol.name())).is_zero();
        let revolutions = unit.counts_revolutions();
        Self {
            angle: has(is_angle) || revolutions,
            revolutions,
            degrees: has(|name| matches!(name, "deg" | "arcmin" | "arcsec" | "gon")),
            periods: has(|name| name == "Hz"),
        }
    }
}

/// 0 degC in degF.
const FAHRENHEIT_ZERO: f64 = 32.0;

/// 0 degF in degC.
const FAHRENHEIT_OFFSET: f64 = -160.0 / 9.0;

/// Whether a symbol is a unit of plane angle, or a rate of one.
fn is_angle(name: &str) -> bool {
    matches!(name, "rad" | "deg" | "arcmin" | "arcsec" | "gon" | "rev" | "turn" | "rpm")
}

impl Default for Unit {
    /// The unit of a plain number.
    fn default() -> Self {
        Self::one()
    }
}

impl FromStr for Unit {
    type Err = UnitError;

    fn from_str(text: &str) -> Result<Self, UnitError> {
        Self::parse(text)
    }
}

impl Unit {
    /// Whether there is a unit to write after a number: false for the unit one.
    pub fn has_name(&self) -> bool {
        !matches!(self.text.trim(), "" | "1")
    }

    /// A number followed by the unit, unless the unit is 1.
    ///
    /// ```
    /// use gumption_units::Unit;
    /// assert_eq!(Unit::parse("m/s^2").unwrap().after("9.81"), "9.81 m/s^2");
    /// assert_eq!(Unit::one().after("0.5"), "0.5");
    /// ```
    pub fn after(&self, number: &str) -> String {
        if self.has_name() { format!("{number} {}", self.text) } else { number.to_owned() }
    }
}

impl fmt::Display for Unit {
    /// The text as written.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.text)
    }
}
