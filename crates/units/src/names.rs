//! The names: which unit symbols and prefixes exist, and what each stands for.

use super::dimension::Dimension;
use super::scale::Scale;

/// What a unit is besides its size.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Flavour {
    /// Nothing special.
    Plain,
    /// Degrees Celsius.
    Celsius,
    /// A fraction of something: %, ppm, ...
    Relative,
}

/// A unit symbol and its meaning.
#[derive(Debug)]
pub(super) struct Symbol {
    /// The symbol as written.
    pub(super) name: &'static str,
    /// Its dimension.
    pub(super) dimension: Dimension,
    /// Its size in coherent SI units: `fraction.0 / fraction.1 * 10^decimal * pi^pi`.
    fraction: (u64, u64),
    decimal: i32,
    pi: i8,
    /// Whether an SI prefix may stand before it.
    pub(super) prefixes: bool,
    /// What it is besides its size.
    pub(super) flavour: Flavour,
}

impl Symbol {
    /// The size in coherent SI units.
    pub(super) fn scale(&self) -> Scale {
        Scale::new(self.fraction.0, self.fraction.1, self.decimal, self.pi)
    }
}

/// A symbol that takes prefixes, `10^decimal` coherent SI units in size.
const fn si(name: &'static str, exponents: [i8; 7], decimal: i32) -> Symbol {
    Symbol {
        name,
        dimension: Dimension::of(exponents),
        fraction: (1, 1),
        decimal,
        pi: 0,
        prefixes: true,
        flavour: Flavour::Plain,
    }
}

/// A symbol that takes prefixes, `digits * 10^decimal` coherent SI units in size.
const fn measured(name: &'static str, exponents: [i8; 7], digits: u64, decimal: i32) -> Symbol {
    Symbol { fraction: (digits, 1), ..si(name, exponents, decimal) }
}

/// A symbol without prefixes, `fraction.0 / fraction.1 * 10^decimal` coherent SI units in size.
const fn bare(
    name: &'static str,
    exponents: [i8; 7],
    fraction: (u64, u64),
    decimal: i32,
) -> Symbol {
    Symbol { fraction, prefixes: false, ..si(name, exponents, decimal) }
}

/// An angle without prefixes, `fraction.0 / fraction.1 * pi` radians.
const fn angle(name: &'static str, fraction: (u64, u64)) -> Symbol {
    Symbol { pi: 1, ..bare(name, NUMBER, fraction, 0) }
}

/// A plain number without prefixes.
const fn number(name: &'static str) -> Symbol {
    bare(name, NUMBER, (1, 1), 0)
}

/// A fraction, `10^decimal`.
const fn relative(name: &'static str, decimal: i32) -> Symbol {
    Symbol { flavour: Flavour::Relative, ..bare(name, NUMBER, (1, 1), decimal) }
}

/// A spelling of the degree Celsius.
const fn celsius(name: &'static str) -> Symbol {
    Symbol { flavour: Flavour::Celsius, ..bare(name, TEMPERATURE, (1, 1), 0) }
}

// Exponents of kg, m, s, A, K, mol, cd.
const NUMBER: [i8; 7] = [0, 0, 0, 0, 0, 0, 0];
const MASS: [i8; 7] = [1, 0, 0, 0, 0, 0, 0];
const LENGTH: [i8; 7] = [0, 1, 0, 0, 0, 0, 0];
const TIME: [i8; 7] = [0, 0, 1, 0, 0, 0, 0];
const TEMPERATURE: [i8; 7] = [0, 0, 0, 0, 1, 0, 0];
const AREA: [i8; 7] = [0, 2, 0, 0, 0, 0, 0];
const VOLUME: [i8; 7] = [0, 3, 0, 0, 0, 0, 0];
const RATE: [i8; 7] = [0, 0, -1, 0, 0, 0, 0];
const ACCELERATION: [i8; 7] = [0, 1, -2, 0, 0, 0, 0];
const FORCE: [i8; 7] = [1, 1, -2, 0, 0, 0, 0];
const PRESSURE: [i8; 7] = [1, -1, -2, 0, 0, 0, 0];
const ENERGY: [i8; 7] = [1, 2, -2, 0, 0, 0, 0];
const RESISTANCE: [i8; 7] = [1, 2, -3, -2, 0, 0, 0];
const DOSE: [i8; 7] = [0, 2, -2, 0, 0, 0, 0];

/// Every unit symbol.
///
/// Base and named derived units: SI Brochure, 9th ed., tables 2 and 4. Non-SI units accepted for
/// use with the SI: table 8. The standard acceleration of free fall, 9.80665 m/s^2, is that of the
/// 3rd CGPM (1901). The conventional millimetre of mercury, the inch, foot, pound, pound-force and
/// psi follow NIST SP 811, appendix B; the atmosphere is 101 325 Pa and the torr 1/760 of it.
#[rustfmt::skip]
pub(super) const SYMBOLS: &[Symbol] = &[
    // SI base units; the kilogram is `g` with a prefix.
    si("m", LENGTH, 0),
    si("g", MASS, -3),
    si("s", TIME, 0),
    si("A", [0, 0, 0, 1, 0, 0, 0], 0),
    si("K", TEMPERATURE, 0),
    si("mol", [0, 0, 0, 0, 0, 1, 0], 0),
    si("cd", [0, 0, 0, 0, 0, 0, 1], 0),
    // SI units with names of their own.
    si("rad", NUMBER, 0),
    si("sr", NUMBER, 0),
    si("Hz", RATE, 0),
    si("N", FORCE, 0),
    si("Pa", PRESSURE, 0),
    si("J", ENERGY, 0),
    si("W", [1, 2, -3, 0, 0, 0, 0], 0),
    si("C", [0, 0, 1, 1, 0, 0, 0], 0),
    si("V", [1, 2, -3, -1, 0, 0, 0], 0),
    si("F", [-1, -2, 4, 2, 0, 0, 0], 0),
    si("ohm", RESISTANCE, 0),
    si("Ω", RESISTANCE, 0),
    si("\u{2126}", RESISTANCE, 0),
    si("S", [-1, -2, 3, 2, 0, 0, 0], 0),
    si("Wb", [1, 2, -2, -1, 0, 0, 0], 0),
    si("T", [1, 0, -2, -1, 0, 0, 0], 0),
    si("H", [1, 2, -2, -2, 0, 0, 0], 0),
    si("lm", [0, 0, 0, 0, 0, 0, 1], 0),
    si("lx", [0, -2, 0, 0, 0, 0, 1], 0),
    si("Bq", RATE, 0),
    si("Gy", DOSE, 0),
    si("Sv", DOSE, 0),
    si("kat", [0, 0, -1, 0, 0, 1, 0], 0),
    celsius("degC"),
    celsius("°C"),
    celsius("℃"),
    // Non-SI units with prefixes.
    si("L", VOLUME, -3),
    si("l", VOLUME, -3),
    si("t", MASS, 3),
    si("bar", PRESSURE, 5),
    si("Gal", ACCELERATION, -2),
    measured("g_n", ACCELERATION, 980_665, -5),
    measured("eV", ENERGY, 1_602_176_634, -28),
    measured("Da", MASS, 166_053_906_660, -38),
    // Non-SI units without prefixes.
    bare("u", MASS, (166_053_906_660, 1), -38),
    bare("min", TIME, (60, 1), 0),
    bare("h", TIME, (3_600, 1), 0),
    bare("d", TIME, (86_400, 1), 0),
    bare("au", LENGTH, (149_597_870_700, 1), 0),
    bare("ha", AREA, (1, 1), 4),
    bare("in", LENGTH, (254, 1), -4),
    bare("ft", LENGTH, (3_048, 1), -4),
    bare("lb", MASS, (45_359_237, 1), -8),
    bare("lbf", FORCE, (44_482_216_152_605, 1), -13),
    bare("kgf", FORCE, (980_665, 1), -5),
    bare("psi", PRESSURE, (44_482_216_152_605, 64_516), -5),
    bare("mmHg", PRESSURE, (133_322_387_415, 1), -9),
    bare("Torr", PRESSURE, (101_325, 760), 0),
    bare("atm", PRESSURE, (101_325, 1), 0),
    bare("rpm", RATE, (1, 30), 0).times_pi(),
    // Angles.
    angle("deg", (1, 180)),
    angle("°", (1, 180)),
    angle("arcmin", (1, 10_800)),
    angle("'", (1, 10_800)),
    angle("′", (1, 10_800)),
    angle("arcsec", (1, 648_000)),
    angle("''", (1, 648_000)),
    angle("″", (1, 648_000)),
    angle("′′", (1, 648_000)),
    angle("rev", (2, 1)),
    angle("turn", (2, 1)),
    // Numbers.
    relative("%", -2),
    relative("‰", -3),
    relative("ppm", -6),
    relative("ppb", -9),
    number("dB"),
    number("D"),
    number("LSB"),
    number("count"),
];

impl Symbol {
    /// The same symbol, pi times as large.
    const fn times_pi(self) -> Self {
        Self { pi: 1, ..self }
    }
}

/// An SI prefix (SI Brochure, 9th ed., table 7).
#[derive(Debug)]
pub(super) struct Prefix {
    /// The symbol.
    pub(super) symbol: &'static str,
    /// The name, or nothing for a second spelling of a symbol.
    pub(super) name: &'static str,
    /// The power of ten.
    pub(super) decimal: i32,
}

/// One row of [`PREFIXES`].
const fn prefix(symbol: &'static str, name: &'static str, decimal: i32) -> Prefix {
    Prefix { symbol, name, decimal }
}

/// Every prefix, the commonest first.
pub(super) const PREFIXES: &[Prefix] = &[
    prefix("m", "milli", -3),
    prefix("k", "kilo", 3),
    prefix("u", "micro", -6),
    prefix("M", "mega", 6),
    prefix("n", "nano", -9),
    prefix("c", "centi", -2),
    prefix("h", "hecto", 2),
    prefix("d", "deci", -1),
    prefix("G", "giga", 9),
    prefix("p", "pico", -12),
    prefix("T", "tera", 12),
    prefix("f", "femto", -15),
    prefix("da", "deca", 1),
    prefix("P", "peta", 15),
    prefix("E", "exa", 18),
    prefix("Z", "zetta", 21),
    prefix("Y", "yotta", 24),
    prefix("R", "ronna", 27),
    prefix("Q", "quetta", 30),
    prefix("a", "atto", -18),
    prefix("z", "zepto", -21),
    prefix("y", "yocto", -24),
    prefix("r", "ronto", -27),
    prefix("q", "quecto", -30),
    // The micro sign and the Greek letter.
    prefix("\u{b5}", "", -6),
    prefix("\u{3bc}", "", -6),
];

/// The symbol with exactly this name.
pub(super) fn symbol(name: &str) -> Option<&'static Symbol> {
    SYMBOLS.iter().find(|symbol| symbol.name == name)
}

/// Every way to read a name as a prefix before a symbol, allowed or not.
pub(super) fn prefixed(name: &str) -> impl Iterator<Item = (&'static Prefix, &'static Symbol)> {
    PREFIXES.iter().filter_map(move |prefix| {
        name.strip_prefix(prefix.symbol).and_then(symbol).map(|symbol| (prefix, symbol))
    })
}

/// What a unit name means.
#[derive(Debug, Clone, Copy)]
pub(super) struct Meaning {
    /// The dimension.
    pub(super) dimension: Dimension,
    /// The size in coherent SI units.
    pub(super) scale: Scale,
    /// What it is besides its size.
    pub(super) flavour: Flavour,
}

/// The meaning of a name: a symbol as it stands first (so that `min` is a minute, `ft` a foot,
/// `Pa` a pascal and `cd` a candela), then a prefix and a symbol that takes one. No name has two
/// readings of the second kind.
pub(super) fn meaning(name: &str) -> Option<Meaning> {
    if let Some(symbol) = symbol(name) {
        return Some(Meaning {
            dimension: symbol.dimension,
            scale: symbol.scale(),
            flavour: symbol.flavour,
        });
    }
    let (prefix, symbol) = prefixed(name).find(|(_, symbol)| symbol.prefixes)?;
    Some(Meaning {
        dimension: symbol.dimension,
        scale: symbol.scale().times(Scale::power_of_ten(prefix.decimal))?,
        flavour: symbol.flavour,
    })
}
