//! What is known about a quantity before its value is.

use std::collections::{HashMap, HashSet};

use gumption_units::{Dimension, Unit};

/// The kind of a quantity: its dimension, and how it goes back to temperatures in degrees Celsius.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Typing {
    /// The dimension. `None` fits every dimension: so does the literal 0, and so does a quantity
    /// about which a mistake has been reported already.
    pub dimension: Option<Dimension>,
    /// How it comes from temperatures in degrees Celsius.
    pub celsius: Celsius,
}

/// How a quantity comes from temperatures that are given in degrees Celsius, which keep their
/// number in a formula.
///
/// Followed through sums, differences, signs, `abs`, `min`, `max`, `hypot` and products with plain
/// numbers. Everything else (a power, a product with another quantity) is [`Celsius::No`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Celsius {
    /// Not at all.
    #[default]
    No,
    /// From them alone: a number of degrees Celsius, not of kelvin.
    Value,
    /// The difference of two of them, which is in kelvin just as well.
    Difference,
    /// From them and temperatures in kelvin, added or subtracted: usually degrees Celsius with a
    /// correction.
    Mixed,
    /// It is a thermodynamic temperature that `kelvin` gave, or a sum with one.
    Kelvin,
}

impl Typing {
    /// A plain number.
    pub const NUMBER: Self = Self { dimension: Some(Dimension::NONE), celsius: Celsius::No };

    /// Fits everything.
    pub const ANY: Self = Self { dimension: None, celsius: Celsius::No };

    /// A quantity of that dimension, in coherent SI units.
    pub const fn of(dimension: Dimension) -> Self {
        Self { dimension: Some(dimension), celsius: Celsius::No }
    }

    /// A quantity that is given in that unit.
    pub fn in_unit(unit: &Unit) -> Self {
        let celsius = if unit.is_celsius() { Celsius::Value } else { Celsius::No };
        Self { dimension: Some(unit.dimension()), celsius }
    }

    /// Whether the quantity can be one of that dimension.
    pub fn fits(self, dimension: Dimension) -> bool {
        self.dimension.is_none_or(|own| own == dimension)
    }

    /// Whether it is a number of degrees Celsius that nothing has turned into a thermodynamic
    /// temperature, so that it is an unlikely result in K.
    pub fn is_celsius(self) -> bool {
        self.celsius == Celsius::Value
    }

    /// Whether `kelvin` of it adds 273.15: unless it is known to be in kelvin.
    pub(super) fn kelvin_shifts(self) -> bool {
        match self.celsius {
            Celsius::Kelvin => false,
            Celsius::No => self.dimension != Some(Dimension::TEMPERATURE),
            Celsius::Value | Celsius::Difference | Celsius::Mixed => true,
        }
    }
}

impl Celsius {
    /// Of a sum, or of the larger or smaller of two.
    pub(super) fn plus(self, other: Self) -> Self {
        match (self, other) {
            (Self::Kelvin, _) | (_, Self::Kelvin) => Self::Kelvin,
            (Self::No, Self::No) => Self::No,
            (Self::No | Self::Mixed, _) | (_, Self::No | Self::Mixed) => Self::Mixed,
            (Self::Difference, Self::Difference) => Self::Difference,
            (Self::Value | Self::Difference, Self::Value | Self::Difference) => Self::Value,
        }
    }

    /// Of a difference.
    pub(super) fn minus(self, other: Self) -> Self {
        match (self, other) {
            (Self::Value, Self::Value) => Self::Difference,
            _ => self.plus(other),
        }
    }
}

/// The names that a formula may use.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    names: Vec<(String, Typing)>,
    index_of: HashMap<String, usize>,
    later: HashSet<String>,
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

    /// Says that a name will be defined later, so that a formula that uses it too early is told so.
    pub fn announce(&mut self, name: impl Into<String>) {
        let name = name.into();
        if !self.index_of.contains_key(&name) {
            self.later.insert(name);
        }
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
