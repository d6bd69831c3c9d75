//! Dimensions: what kind of quantity a unit measures.

use std::fmt;

use super::exponent::Exponent;
use super::factor::Factor;

/// The base units in the order in which a dimension is written.
const SYMBOLS: [&str; 7] = ["kg", "m", "s", "A", "K", "mol", "cd"];

/// The dimension of a quantity: the exponents of the seven SI base units (SI Brochure, 9th ed.,
/// section 2.3.3). Plane and solid angles are dimensionless, as in the SI.
///
/// `Display` writes the coherent SI unit in base units, such as `kg m^2 s^-2`, and `1` for a plain
/// number; [`Unit::parse`](super::Unit::parse) reads that text back to the same dimension.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Dimension {
    exponents: [Exponent; 7],
}

impl Dimension {
    /// A plain number (also an angle): every exponent is zero.
    pub const NONE: Self = Self::of([0, 0, 0, 0, 0, 0, 0]);
    /// Mass, in kg.
    pub const MASS: Self = Self::of([1, 0, 0, 0, 0, 0, 0]);
    /// Length, in m.
    pub const LENGTH: Self = Self::of([0, 1, 0, 0, 0, 0, 0]);
    /// Time, in s.
    pub const TIME: Self = Self::of([0, 0, 1, 0, 0, 0, 0]);
    /// Electric current, in A.
    pub const CURRENT: Self = Self::of([0, 0, 0, 1, 0, 0, 0]);
    /// Thermodynamic temperature, in K.
    pub const TEMPERATURE: Self = Self::of([0, 0, 0, 0, 1, 0, 0]);
    /// Amount of substance, in mol.
    pub const AMOUNT: Self = Self::of([0, 0, 0, 0, 0, 1, 0]);
    /// Luminous intensity, in cd.
    pub const LUMINOUS_INTENSITY: Self = Self::of([0, 0, 0, 0, 0, 0, 1]);

    /// The dimension with these whole exponents, in the order kg, m, s, A, K, mol, cd.
    pub const fn of(exponents: [i8; 7]) -> Self {
        let [kg, m, s, a, k, mol, cd] = exponents;
        Self {
            exponents: [
                Exponent::integer(kg),
                Exponent::integer(m),
                Exponent::integer(s),
                Exponent::integer(a),
                Exponent::integer(k),
                Exponent::integer(mol),
                Exponent::integer(cd),
            ],
        }
    }

    /// The exponents, in the order kg, m, s, A, K, mol, cd.
    pub const fn exponents(&self) -> &[Exponent; 7] {
        &self.exponents
    }

    /// Whether this is the dimension of a plain number.
    pub fn is_none(&self) -> bool {
        *self == Self::NONE
    }

    /// Whether this is the dimension of a plain number or of a power of time.
    pub fn is_of_time(&self) -> bool {
        self.exponents.iter().enumerate().all(|(base, exponent)| base == 2 || exponent.is_zero())
    }

    /// The exponent of the thermodynamic temperature.
    pub fn of_temperature(&self) -> Exponent {
        let [.., of_temperature, _, _] = self.exponents;
        of_temperature
    }

    /// The dimension of a product of two quantities; `None` if an exponent leaves the range of
    /// [`Exponent`].
    pub fn checked_mul(self, other: Self) -> Option<Self> {
        self.combine(|i, e| e.checked_add(other.exponents[i]))
    }

    /// The dimension of a quotient of two quantities; `None` if an exponent leaves the range of
    /// [`Exponent`].
    pub fn checked_div(self, other: Self) -> Option<Self> {
        self.combine(|i, e| e.checked_add(other.exponents[i].checked_neg()?))
    }

    /// The dimension of a rational power; `None` if an exponent leaves the range of [`Exponent`].
    pub fn checked_pow(self, power: Exponent) -> Option<Self> {
        self.combine(|_, e| e.checked_mul(power))
    }

    /// The dimension of a whole power; `None` if an exponent leaves the range of [`Exponent`].
    pub fn checked_powi(self, power: i32) -> Option<Self> {
        self.checked_pow(Exponent::new(power, 1)?)
    }

    /// The dimension of the `n`-th root; `None` if `n` is zero or an exponent leaves the range of
    /// [`Exponent`].
    pub fn checked_root(self, n: i32) -> Option<Self> {
        self.checked_pow(Exponent::new(1, n)?)
    }

    /// Maps every exponent with its index; `None` as soon as one result is.
    fn combine(mut self, map: impl Fn(usize, Exponent) -> Option<Exponent>) -> Option<Self> {
        for (i, exponent) in self.exponents.iter_mut().enumerate() {
            *exponent = map(i, *exponent)?;
        }
        Some(self)
    }

    /// The usual name of a quantity with this dimension, with its article: `an acceleration`,
    /// `a plain number`. `None` if no single name fits. If several kinds of quantity share a
    /// dimension, the most common are named: `an energy or a torque`.
    pub fn quantity(&self) -> Option<&'static str> {
        QUANTITIES.iter().find(|(d, _)| d == self).map(|(_, words)| *words)
    }

    /// The coherent unit in which a quantity of this dimension is usually given: `W` and not
    /// `kg m^2 s^-3`; base units if there is no single name. For a frequency or a rate it is `Hz`,
    /// for an energy or a torque `J`.
    pub fn usual_unit(&self) -> String {
        let usual = USUAL_UNITS.iter().find(|(dimension, _)| dimension == self);
        usual.map_or_else(|| self.to_string(), |(_, unit)| (*unit).to_owned())
    }

    /// Words for an error message: `an acceleration (m s^-2)`, `a plain number`, or
    /// `a quantity in kg^3 m` where the dimension has no usual name.
    pub fn describe(&self) -> String {
        match self.quantity() {
            Some(words) if self.is_none() => words.to_owned(),
            Some(words) => format!("{words} ({self})"),
            None => format!("a quantity in {self}"),
        }
    }
}

impl Dimension {
    /// The coherent SI unit in factors: the base units in order, without those of exponent 0.
    pub(super) fn factors(&self) -> Vec<Factor> {
        let powers = SYMBOLS.iter().zip(self.exponents).filter(|(_, exponent)| !exponent.is_zero());
        powers.filter_map(|(symbol, exponent)| Factor::named(symbol, exponent)).collect()
    }
}

impl Default for Dimension {
    fn default() -> Self {
        Self::NONE
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_none() {
            return f.write_str("1");
        }
        let mut separator = "";
        for (symbol, exponent) in SYMBOLS.iter().zip(self.exponents) {
            if exponent.is_zero() {
                continue;
            }
            write!(f, "{separator}{symbol}")?;
            separator = " ";
            if !exponent.is_integer() {
                write!(f, "^({exponent})")?;
            } else if exponent != Exponent::ONE {
                write!(f, "^{exponent}")?;
            }
        }
        Ok(())
    }
}

impl fmt::Debug for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Dimension({self})")
    }
}

/// Coherent units with usual names (SI Brochure, 9th ed., tables 4 and 5).
const USUAL_UNITS: &[(Dimension, &str)] = &[
    row([0, 0, -1, 0, 0, 0, 0], "Hz"),
    row([0, 1, -1, 0, 0, 0, 0], "m/s"),
    row([0, 1, -2, 0, 0, 0, 0], "m/s^2"),
    row([0, 3, -1, 0, 0, 0, 0], "m^3/s"),
    row([1, -3, 0, 0, 0, 0, 0], "kg/m^3"),
    row([1, 1, -2, 0, 0, 0, 0], "N"),
    row([1, -1, -2, 0, 0, 0, 0], "Pa"),
    row([1, 0, -2, 0, 0, 0, 0], "N/m"),
    row([1, -1, -1, 0, 0, 0, 0], "Pa*s"),
    row([1, 2, -2, 0, 0, 0, 0], "J"),
    row([1, 2, -3, 0, 0, 0, 0], "W"),
    row([1, 0, -3, 0, 0, 0, 0], "W/m^2"),
    row([0, 0, 1, 1, 0, 0, 0], "C"),
    row([1, 2, -3, -1, 0, 0, 0], "V"),
    row([1, 1, -3, -1, 0, 0, 0], "V/m"),
    row([1, 2, -3, -2, 0, 0, 0], "ohm"),
    row([1, 3, -3, -2, 0, 0, 0], "ohm*m"),
    row([-1, -2, 3, 2, 0, 0, 0], "S"),
    row([-1, -2, 4, 2, 0, 0, 0], "F"),
    row([1, 2, -2, -2, 0, 0, 0], "H"),
    row([1, 2, -2, -1, 0, 0, 0], "Wb"),
    row([1, 0, -2, -1, 0, 0, 0], "T"),
    row([1, 2, -3, -1, -1, 0, 0], "V/K"),
    row([1, 2, -2, 0, -1, 0, 0], "J/K"),
    row([0, 2, -2, 0, -1, 0, 0], "J/(kg*K)"),
    row([1, 1, -3, 0, -1, 0, 0], "W/(m*K)"),
    row([0, 0, -1, 0, 0, 1, 0], "kat"),
];

/// One row of [`QUANTITIES`].
const fn row(exponents: [i8; 7], words: &'static str) -> (Dimension, &'static str) {
    (Dimension::of(exponents), words)
}

/// Dimensions with a usual name (SI Brochure, 9th ed., tables 2 and 4 to 6, and a few more that
/// turn up in measurement models). Exponents of kg, m, s, A, K, mol, cd.
const QUANTITIES: &[(Dimension, &str)] = &[
    row([0, 0, 0, 0, 0, 0, 0], "a plain number"),
    row([1, 0, 0, 0, 0, 0, 0], "a mass"),
    row([0, 1, 0, 0, 0, 0, 0], "a length"),
    row([0, 0, 1, 0, 0, 0, 0], "a time"),
    row([0, 0, 0, 1, 0, 0, 0], "an electric current"),
    row([0, 0, 0, 0, 1, 0, 0], "a temperature"),
    row([0, 0, 0, 0, 0, 1, 0], "an amount of substance"),
    row([0, 0, 0, 0, 0, 0, 1], "a luminous intensity"),
    row([0, 2, 0, 0, 0, 0, 0], "an area"),
    row([0, 3, 0, 0, 0, 0, 0], "a volume"),
    row([0, -1, 0, 0, 0, 0, 0], "a number per length"),
    row([0, 1, -1, 0, 0, 0, 0], "a speed"),
    row([0, 1, -2, 0, 0, 0, 0], "an acceleration"),
    row([0, 1, -3, 0, 0, 0, 0], "a jerk"),
    row([0, -1, 2, 0, 0, 0, 0], "a number per acceleration"),
    row([0, 0, -1, 0, 0, 0, 0], "a frequency or a rate"),
    row([0, 0, -2, 0, 0, 0, 0], "an angular acceleration"),
    row([0, 3, -1, 0, 0, 0, 0], "a volume flow rate"),
    row([0, 2, -1, 0, 0, 0, 0], "a kinematic viscosity or a diffusivity"),
    row([0, 2, -2, 0, 0, 0, 0], "a specific energy or an absorbed dose"),
    row([1, -3, 0, 0, 0, 0, 0], "a density"),
    row([-1, 3, 0, 0, 0, 0, 0], "a specific volume"),
    row([1, -2, 0, 0, 0, 0, 0], "a mass per area"),
    row([1, -1, 0, 0, 0, 0, 0], "a mass per length"),
    row([1, 0, -1, 0, 0, 0, 0], "a mass flow rate"),
    row([1, 1, -1, 0, 0, 0, 0], "a momentum"),
    row([1, 2, -1, 0, 0, 0, 0], "an angular momentum"),
    row([1, 2, 0, 0, 0, 0, 0], "a moment of inertia"),
    row([1, 1, -2, 0, 0, 0, 0], "a force"),
    row([1, -1, -2, 0, 0, 0, 0], "a pressure"),
    row([-1, 1, 2, 0, 0, 0, 0], "a compressibility"),
    row([1, 0, -2, 0, 0, 0, 0], "a stiffness or a surface tension"),
    row([1, -1, -1, 0, 0, 0, 0], "a dynamic viscosity"),
    row([1, 2, -2, 0, 0, 0, 0], "an energy or a torque"),
    row([1, 2, -3, 0, 0, 0, 0], "a power"),
    row([1, 0, -3, 0, 0, 0, 0], "an irradiance or a heat flux"),
    row([0, 0, 1, 1, 0, 0, 0], "an electric charge"),
    row([1, 2, -3, -1, 0, 0, 0], "a voltage"),
    row([1, 1, -3, -1, 0, 0, 0], "an electric field strength"),
    row([1, 2, -3, -2, 0, 0, 0], "an electric resistance"),
    row([1, 3, -3, -2, 0, 0, 0], "a resistivity"),
    row([-1, -2, 3, 2, 0, 0, 0], "an electric conductance"),
    row([-1, -3, 3, 2, 0, 0, 0], "an electric conductivity"),
    row([-1, -2, 4, 2, 0, 0, 0], "a capacitance"),
    row([-1, -3, 4, 2, 0, 0, 0], "a permittivity"),
    row([1, 2, -2, -2, 0, 0, 0], "an inductance"),
    row([1, 1, -2, -2, 0, 0, 0], "a permeability"),
    row([1, 2, -2, -1, 0, 0, 0], "a magnetic flux"),
    row([1, 0, -2, -1, 0, 0, 0], "a magnetic flux density"),
    row([0, -1, 0, 1, 0, 0, 0], "a magnetic field strength"),
    row([0, -2, 0, 1, 0, 0, 0], "a current density"),
    row([0, 0, 0, 0, -1, 0, 0], "a temperature coefficient"),
    row([0, 1, 0, 0, 1, 0, 0], "a length times a temperature"),
    row([0, -1, 0, 0, 1, 0, 0], "a temperature gradient"),
    row([0, 0, -1, 0, 1, 0, 0], "a rate of temperature change"),
    row([1, 2, -3, -1, -1, 0, 0], "a thermoelectric sensitivity"),
    row([1, 2, -2, 0, -1, 0, 0], "a heat capacity or an entropy"),
    row([0, 2, -2, 0, -1, 0, 0], "a specific heat capacity"),
    row([1, 1, -3, 0, -1, 0, 0], "a thermal conductivity"),
    row([1, 0, -3, 0, -1, 0, 0], "a heat transfer coefficient"),
    row([-1, -2, 3, 0, 1, 0, 0], "a thermal resistance"),
    row([0, -3, 0, 0, 0, 1, 0], "an amount concentration"),
    row([-1, 0, 0, 0, 0, 1, 0], "a molality"),
    row([1, 0, 0, 0, 0, -1, 0], "a molar mass"),
    row([0, 3, 0, 0, 0, -1, 0], "a molar volume"),
    row([1, 2, -2, 0, 0, -1, 0], "a molar energy"),
    row([1, 2, -2, 0, -1, -1, 0], "a molar heat capacity"),
    row([0, 0, -1, 0, 0, 1, 0], "a catalytic activity"),
    row([0, -2, 0, 0, 0, 0, 1], "a luminance or an illuminance"),
];
