//! What is known about a quantity before its value is.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::angle::AnglePower;
use super::syntax::TableCall;
use crate::model::Interpolation;
use gumption_units::{Dimension, Exponent, Turn, Unit, Zero};

/// The kind of a quantity: its dimension, and what its numbers count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Typing {
    /// The dimension. `None` fits every dimension: so does the literal 0, and so does a quantity
    /// about which a mistake has been reported already.
    pub dimension: Option<Dimension>,
    /// The zero that its numbers count from: that of a Celsius temperature, the reference of a
    /// level in dBm.
    pub zero: Option<Zero>,
    /// What is known about it if it is a temperature in K.
    pub kelvin: KelvinKind,
    /// The exponent of the degrees Celsius in the unit that it was given in: -1 of a coefficient in
    /// `ppm/degC`, which multiplies numbers of degrees Celsius.
    pub celsius_exponent: Exponent,
    /// The exponent of decibels in it: 1 of a level, 0 of everything that is no level.
    pub level: Exponent,
    /// What a level is above that has no declared zero; of a plain number, what a level of it is.
    pub reference: LevelReference,
    /// Whether it counts periods or angle, as far as that is known.
    pub turn: Option<Turn>,
    /// What a rate is by the unit that it was given in.
    pub rate: Rate,
    /// Whether angle stands in its unit in another power than the first, as in `1/rev`: what a product with
    /// it counts is not known.
    pub has_turns: bool,
    /// The power of angle in it.
    pub angle: AnglePower,
}

/// What a rate is by its unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rate {
    /// Nothing is known of it, or nothing that matters.
    #[default]
    Unknown,
    /// Of revolutions: `rpm`.
    Revolutions,
    /// Of what its unit does not say: `1/min`.
    Bare,
}

impl Rate {
    fn of(unit: &Unit) -> Self {
        match unit.turn() {
            Some(Turn::Angle) if unit.counts_revolutions() => Self::Revolutions,
            None if unit.dimension() == RATE && unit.has_name() => Self::Bare,
            _ => Self::Unknown,
        }
    }

    /// Whether one is of revolutions, and the other of what may be radians.
    pub(super) fn is_unlike(self, other: Self) -> bool {
        matches!((self, other), (Self::Revolutions, Self::Bare) | (Self::Bare, Self::Revolutions))
    }
}

/// The dimension of a rate.
pub(super) const RATE: Dimension = Dimension::of([0, 0, -1, 0, 0, 0, 0]);

/// What a level is above by the formula that makes it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LevelReference {
    /// Nothing is known of it.
    #[default]
    Unknown,
    /// None: it is a gain or a loss, the ratio of two quantities, the difference of two levels.
    Ratio,
    /// What its logarithm is divided by: 1 uV in `20*log10(v/[uV])`.
    Above(Zero),
    /// What its logarithm is divided by, and no unit of levels is above: 2 mW, 20 uPa.
    Other,
    /// It adds levels with a reference, or multiplies one, and is above none.
    Added,
}

/// What is known about a temperature in K.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum KelvinKind {
    /// Nothing: a unit does not tell a difference from a thermodynamic temperature.
    #[default]
    Either,
    /// It is the difference of two Celsius temperatures, or of two thermodynamic ones.
    Difference,
    /// It is a thermodynamic temperature that `kelvin` gave, or a sum with one.
    Thermodynamic,
}

impl Typing {
    /// A plain number.
    pub const NUMBER: Self = Self::of(Dimension::NONE);

    /// Fits everything.
    pub const ANY: Self = Self { dimension: None, ..Self::NUMBER };

    /// A quantity of that dimension, in coherent SI units.
    pub const fn of(dimension: Dimension) -> Self {
        Self {
            dimension: Some(dimension),
            zero: None,
            kelvin: KelvinKind::Either,
            celsius_exponent: Exponent::ZERO,
            level: Exponent::ZERO,
            reference: LevelReference::Unknown,
            turn: None,
            rate: Rate::Unknown,
            has_turns: false,
            angle: AnglePower::NONE,
        }
    }

    /// A quantity that is given in that unit.
    pub fn in_unit(unit: &Unit) -> Self {
        let zero = unit.zero();
        let celsius = unit.celsius_exponent();
        let is_level = !unit.level_exponent().is_zero();
        Self {
            zero,
            reference: match zero {
                None if is_level => LevelReference::Ratio,
                _ => LevelReference::Unknown,
            },
            celsius_exponent: if zero.is_some() { Exponent::ZERO } else { celsius },
            level: unit.level_exponent(),
            turn: unit.turn(),
            rate: Rate::of(unit),
            has_turns: unit.turn().is_none() && unit.counts_angle(),
            angle: AnglePower::of(unit),
            ..Self::of(unit.dimension())
        }
    }

    /// Whether the quantity can be one of that dimension.
    pub fn fits(self, dimension: Dimension) -> bool {
        self.dimension.is_none_or(|own| own == dimension)
    }

    /// Whether it is a Celsius temperature, which has a zero.
    pub fn is_celsius(self) -> bool {
        self.zero == Some(Zero::Celsius)
    }

    /// Whether it is a number of degrees by the unit of a coefficient, which may be a Celsius
    /// temperature or a difference: `dR/S` with S in ohm/degC.
    pub fn counts_degrees(self) -> bool {
        self.zero.is_none()
            && self.dimension == Some(Dimension::TEMPERATURE)
            && self.celsius_exponent == Exponent::ONE
    }

    /// Whether `kelvin` of it adds 273.15: unless it is known to be in kelvin.
    pub(super) fn kelvin_shifts(self) -> bool {
        self.is_celsius()
            || self.counts_degrees()
            || self.dimension != Some(Dimension::TEMPERATURE)
            || self.kelvin == KelvinKind::Difference
    }

    /// Whether `celsius` of it subtracts 273.15: unless it is in degrees Celsius already.
    pub(super) fn celsius_shifts(self) -> bool {
        !self.is_celsius() && !self.counts_degrees()
    }
}

/// A table that formulas may use.
#[derive(Clone, Debug)]
pub struct TableData {
    /// The function, of numbers as formulas have them.
    pub table: Arc<Interpolation>,
    /// What its abscissas and its values are.
    pub units: [Unit; 2],
    /// Whether that is said of each of them; what it is not said of is taken as plain numbers.
    pub is_stated: [bool; 2],
}

/// The names that a formula may use.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    tables: Vec<(TableCall, Option<TableData>)>,
    names: Vec<(String, Typing)>,
    index_of: HashMap<String, usize>,
    later: HashSet<String>,
    complex: HashSet<String>,
    declared: HashMap<String, Unit>,
    given: HashMap<String, Unit>,
}

impl Scope {
    /// No names.
    pub fn new() -> Self {
        Self::default()
    }

    /// Defines a name, anew if it was defined already.
    pub fn define(&mut self, name: impl Into<String>, typing: Typing) {
        let name = name.into();
        self.later.remove(&name);
        if let Some((_, known)) =
            self.index_of.get(&name).and_then(|&index| self.names.get_mut(index))
        {
            *known = typing;
            return;
        }
        self.index_of.insert(name.clone(), self.names.len());
        self.names.push((name, typing));
    }

    /// Says that a name's value is the number in this unit, and not in coherent SI units: of
    /// quantities of a formula whose units are not checked.
    pub fn declare(&mut self, name: impl Into<String>, unit: Unit) {
        self.declared.insert(name.into(), unit);
    }

    /// Says in which unit a quantity is given, which messages propose for numbers beside it.
    pub fn give(&mut self, name: impl Into<String>, unit: Unit) {
        self.given.insert(name.into(), unit);
    }

    /// The unit that a quantity is given in.
    pub(super) fn given(&self, name: &str) -> Option<&Unit> {
        self.given.get(name)
    }

    /// The unit that a name's value is the number in, where that need not be the coherent one.
    pub(super) fn declared(&self, name: &str) -> Option<&Unit> {
        self.declared.get(name)
    }

    /// The first name, by its letters, whose value is the number in a unit of that dimension that is
    /// not the coherent one.
    pub(super) fn declared_of(&self, dimension: Dimension) -> Option<(&str, &Unit)> {
        let coherent = |unit: &Unit| unit.factor() == 1.0 && unit.offset() == 0.0;
        let of = self.declared.iter().map(|(name, unit)| (name.as_str(), unit));
        of.filter(|(_, unit)| unit.dimension() == dimension && !coherent(unit))
            .min_by_key(|of| of.0)
    }

    /// Says that a name will be defined later, so that a formula that uses it too early is told so.
    pub fn announce(&mut self, name: impl Into<String>) {
        let name = name.into();
        if !self.index_of.contains_key(&name) {
            self.later.insert(name);
        }
    }

    /// Defines a table; `None` is one that could not be read, which has been reported.
    pub fn define_table(&mut self, call: TableCall, data: Option<TableData>) {
        self.tables.push((call, data));
    }

    /// A table that has been defined.
    pub fn table(&self, call: &TableCall) -> Option<Option<&TableData>> {
        let found = self.tables.iter().find(|(known, _)| known.is_same(call))?;
        Some(found.1.as_ref())
    }

    /// What is known about a name; `None` if it is not defined.
    pub fn get(&self, name: &str) -> Option<Typing> {
        let index = *self.index_of.get(name)?;
        self.names.get(index).map(|(_, typing)| *typing)
    }

    /// The defined names, in the order of their definition.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.names.iter().map(|(name, _)| name.as_str())
    }

    /// Says that a name's value is complex.
    pub fn define_complex(&mut self, name: impl Into<String>) {
        self.complex.insert(name.into());
    }

    /// Whether a name's value is complex.
    pub fn is_complex(&self, name: &str) -> bool {
        self.complex.contains(name)
    }

    /// Whether there are complex values.
    pub(super) fn has_complex(&self) -> bool {
        !self.complex.is_empty()
    }

    /// Whether a name has been announced and not defined.
    pub(super) fn is_announced(&self, name: &str) -> bool {
        self.later.contains(name)
    }
}

impl<N: Into<String>> FromIterator<(N, Typing)> for Scope {
    fn from_iter<I: IntoIterator<Item = (N, Typing)>>(names: I) -> Self {
        let mut scope = Self::new();
        for (name, typing) in names {
            scope.define(name, typing);
        }
        scope
    }
}
