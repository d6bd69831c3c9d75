//! Unit symbols and prefixes, and their meanings.

use super::dimension::Dimension;
use super::scale::Scale;
use super::zero::Zero;

/// The kind of a unit besides its size.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Flavour {
    /// Nothing special.
    Plain,
    /// Degrees Celsius or Fahrenheit.
    Celsius,
    /// A fraction of something: %, ppm, ...
    Relative,
    /// A level in decibels or nepers, with a reference or as a difference.
    Level(Option<Zero>),
}

/// A unit symbol with all its accepted spellings, and its names in other systems.
///
/// Two symbols are equal if they are the same unit: `Ω` and `ohm` are one symbol.
#[derive(Debug)]
pub struct Symbol {
    /// The symbol, if possible in letters of any keyboard.
    name: &'static str,
    /// Other spellings.
    also: &'static [&'static str],
    /// Its dimension.
    pub(super) dimension: Dimension,
    /// Its size in coherent SI units: `fraction.0 / fraction.1 * 10^decimal * pi^pi`.
    fraction: (u64, u64),
    decimal: i32,
    pi: i8,
    /// Whether an SI prefix may precede it.
    pub(super) prefixes: bool,
    /// Its kind besides its size.
    pub(super) flavour: Flavour,
    dsi: Option<&'static str>,
    siunitx: Option<&'static str>,
}

impl Symbol {
    /// The symbol: `m`, `ohm`, `degC`.
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// The name in D-SI, the digital system of units that Digital Calibration Certificates are
    /// written in: `metre`. `None` if D-SI does not have the unit.
    pub const fn dsi_name(&self) -> Option<&'static str> {
        self.dsi
    }

    /// The name of the macro of the LaTeX package `siunitx`, without its backslash: `metre`.
    /// `None` if the package has none.
    pub const fn siunitx_name(&self) -> Option<&'static str> {
        self.siunitx
    }

    /// The size in coherent SI units.
    pub(super) fn scale(&self) -> Scale {
        Scale::new(self.fraction.0, self.fraction.1, self.decimal, self.pi)
    }

    /// Whether an SI prefix may precede it.
    pub const fn takes_prefixes(&self) -> bool {
        self.prefixes
    }

    /// Whether it takes this prefix. `Grad` is the German word for degree, and nobody measures in
    /// gigaradians; the tonne takes only kilo and larger prefixes, since `ct` is a carat.
    pub(super) fn takes(&self, prefix: &Prefix) -> bool {
        self.prefixes
            && match self.name {
                "rad" => prefix.symbol != "G",
                "t" => prefix.decimal >= 3,
                _ => true,
            }
    }

    /// Every spelling, [`Symbol::name`] first.
    pub fn spellings(&self) -> impl Iterator<Item = &'static str> {
        std::iter::once(self.name).chain(self.also.iter().copied())
    }

    /// The same symbol with additional spellings.
    const fn also(self, also: &'static [&'static str]) -> Self {
        Self { also, ..self }
    }

    /// The same symbol with its name in D-SI and siunitx.
    const fn named(self, name: &'static str) -> Self {
        Self { dsi: Some(name), siunitx: Some(name), ..self }
    }

    /// The same symbol with a name only in D-SI.
    const fn dsi(self, name: &'static str) -> Self {
        Self { dsi: Some(name), ..self }
    }

    /// The same symbol, pi times as large.
    const fn times_pi(self) -> Self {
        Self { pi: 1, ..self }
    }
}

impl PartialEq for Symbol {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl Eq for Symbol {}

/// A symbol that takes prefixes, `10^decimal` coherent SI units in size.
const fn si(name: &'static str, exponents: [i8; 7], decimal: i32) -> Symbol {
    Symbol {
        name,
        also: &[],
        dimension: Dimension::of(exponents),
        fraction: (1, 1),
        decimal,
        pi: 0,
        prefixes: true,
        flavour: Flavour::Plain,
        dsi: None,
        siunitx: None,
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

/// A level, `digits * 10^decimal` decibels.
const fn level(name: &'static str, zero: Option<Zero>, digits: u64, decimal: i32) -> Symbol {
    Symbol { flavour: Flavour::Level(zero), ..bare(name, NUMBER, (digits, 1), decimal) }
}

/// A level in decibels above a reference.
const fn above(name: &'static str, reference: Zero) -> Symbol {
    level(name, Some(reference), 1, 0)
}

/// The degree Fahrenheit.
const fn fahrenheit(name: &'static str) -> Symbol {
    Symbol { flavour: Flavour::Celsius, ..bare(name, TEMPERATURE, (5, 9), 0) }
}

/// The degree Celsius.
const fn celsius(name: &'static str) -> Symbol {
    Symbol {
        flavour: Flavour::Celsius,
        dsi: Some("degreecelsius"),
        siunitx: Some("degreeCelsius"),
        ..bare(name, TEMPERATURE, (1, 1), 0)
    }
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
const POWER: [i8; 7] = [1, 2, -3, 0, 0, 0, 0];
const CHARGE: [i8; 7] = [0, 0, 1, 1, 0, 0, 0];
const RESISTANCE: [i8; 7] = [1, 2, -3, -2, 0, 0, 0];
const DOSE: [i8; 7] = [0, 2, -2, 0, 0, 0, 0];

/// Every unit symbol.
///
/// Base and named derived units: SI Brochure, 9th ed., tables 2 and 4. Non-SI units accepted for
/// use with the SI: table 8. The standard acceleration of free fall, 9.80665 m/s^2, is that of the
/// 3rd CGPM (1901). The conventional millimetre of mercury, the inch, foot, mile, pound, pound-force
/// and psi follow NIST SP 811, appendix B; an ozf is 1/16 lbf, a kip 1000 lbf, a ksi 1000 psi, a slug
/// 1 lbf s^2/ft. The fluid ounce of the US is 1/128 of a gallon of 231 cubic inches, the imperial one
/// 1/160 of a gallon of 4.546 09 L (SP 811, B.6). The atmosphere is 101 325 Pa and the torr 1/760 of it. The
/// conventional inch of mercury is 25.4 mmHg; columns of water are of 1000 kg/m^3 under g_n. The
/// carat is the metric one of 0.2 g (4th CGPM, 1907). The year is the Julian one of 365.25 days, the
/// month a twelfth of it. The neper is 20/ln(10) dB.
#[rustfmt::skip]
pub(super) static SYMBOLS: &[Symbol] = &[
    // SI base units; the kilogram is `g` with a prefix.
    si("m", LENGTH, 0).named("metre"),
    si("g", MASS, -3).named("gram"),
    si("s", TIME, 0).named("second"),
    si("A", [0, 0, 0, 1, 0, 0, 0], 0).named("ampere"),
    si("K", TEMPERATURE, 0).named("kelvin"),
    si("mol", [0, 0, 0, 0, 0, 1, 0], 0).named("mole"),
    si("cd", [0, 0, 0, 0, 0, 0, 1], 0).named("candela"),
    // SI units with names of their own.
    si("rad", NUMBER, 0).named("radian"),
    si("sr", NUMBER, 0).named("steradian"),
    si("Hz", RATE, 0).named("hertz"),
    si("N", FORCE, 0).named("newton"),
    si("Pa", PRESSURE, 0).named("pascal"),
    si("J", ENERGY, 0).named("joule"),
    si("W", POWER, 0).named("watt"),
    si("C", CHARGE, 0).named("coulomb"),
    si("V", [1, 2, -3, -1, 0, 0, 0], 0).named("volt"),
    si("F", [-1, -2, 4, 2, 0, 0, 0], 0).named("farad"),
    si("ohm", RESISTANCE, 0).named("ohm").also(&["Ω", "\u{2126}"]),
    si("S", [-1, -2, 3, 2, 0, 0, 0], 0).named("siemens"),
    si("Wb", [1, 2, -2, -1, 0, 0, 0], 0).named("weber"),
    si("T", [1, 0, -2, -1, 0, 0, 0], 0).named("tesla"),
    si("H", [1, 2, -2, -2, 0, 0, 0], 0).named("henry"),
    si("lm", [0, 0, 0, 0, 0, 0, 1], 0).named("lumen"),
    si("lx", [0, -2, 0, 0, 0, 0, 1], 0).named("lux"),
    si("Bq", RATE, 0).named("becquerel"),
    si("Gy", DOSE, 0).named("gray"),
    si("Sv", DOSE, 0).named("sievert"),
    si("kat", [0, 0, -1, 0, 0, 1, 0], 0).named("katal"),
    celsius("degC").also(&["°C", "℃"]),
    fahrenheit("degF").also(&["°F", "℉"]),
    // Common products with a symbol of their own.
    si("Nm", ENERGY, 0),
    si("VA", POWER, 0),
    si("var", POWER, 0),
    measured("Wh", ENERGY, 3_600, 0),
    measured("Ah", CHARGE, 3_600, 0),
    // Non-SI units with prefixes.
    si("L", VOLUME, -3).named("litre").also(&["l"]),
    si("t", MASS, 3).named("tonne"),
    si("bar", PRESSURE, 5),
    si("Gal", ACCELERATION, -2),
    measured("g_n", ACCELERATION, 980_665, -5),
    measured("eV", ENERGY, 1_602_176_634, -28).named("electronvolt"),
    measured("Da", MASS, 166_053_906_660, -38).named("dalton"),
    // Non-SI units without prefixes.
    bare("u", MASS, (166_053_906_660, 1), -38),
    bare("min", TIME, (60, 1), 0).named("minute"),
    bare("h", TIME, (3_600, 1), 0).named("hour").also(&["hour"]),
    bare("d", TIME, (86_400, 1), 0).named("day").also(&["day"]),
    bare("week", TIME, (604_800, 1), 0),
    bare("month", TIME, (2_629_800, 1), 0),
    bare("year", TIME, (31_557_600, 1), 0),
    bare("au", LENGTH, (149_597_870_700, 1), 0),
    bare("ha", AREA, (1, 1), 4).named("hectare"),
    bare("in", LENGTH, (254, 1), -4),
    bare("ft", LENGTH, (3_048, 1), -4),
    bare("mi", LENGTH, (1_609_344, 1), -3),
    bare("floz_us", VOLUME, (295_735_295_625, 1), -16),
    bare("floz_imp", VOLUME, (284_130_625, 1), -13),
    bare("lb", MASS, (45_359_237, 1), -8),
    bare("slug", MASS, (44_482_216_152_605, 3_048), -9),
    bare("ct", MASS, (2, 1), -4),
    bare("lbf", FORCE, (44_482_216_152_605, 1), -13),
    bare("ozf", FORCE, (44_482_216_152_605, 16), -13),
    bare("kip", FORCE, (44_482_216_152_605, 1), -10),
    bare("kgf", FORCE, (980_665, 1), -5),
    bare("psi", PRESSURE, (44_482_216_152_605, 64_516), -5),
    bare("ksi", PRESSURE, (44_482_216_152_605, 64_516), -2),
    bare("mmHg", PRESSURE, (133_322_387_415, 1), -9),
    bare("inHg", PRESSURE, (3_386_388_640_341, 1), -9),
    bare("mmH2O", PRESSURE, (980_665, 1), -5),
    bare("inH2O", PRESSURE, (24_908_891, 1), -5),
    bare("Torr", PRESSURE, (101_325, 760), 0),
    bare("atm", PRESSURE, (101_325, 1), 0),
    bare("rpm", RATE, (1, 30), 0).times_pi(),
    // Angles.
    angle("deg", (1, 180)).named("degree").also(&["°"]),
    angle("arcmin", (1, 10_800)).named("arcminute").also(&["'", "′"]),
    angle("arcsec", (1, 648_000)).named("arcsecond").also(&["''", "″", "′′"]),
    Symbol { prefixes: true, ..angle("gon", (1, 200)) },
    angle("rev", (2, 1)),
    angle("turn", (2, 1)),
    // Numbers.
    relative("%", -2).named("percent"),
    relative("%RH", -2),
    relative("‰", -3),
    relative("ppm", -6).dsi("ppm"),
    relative("ppb", -9),
    level("dB", None, 1, 0),
    // 20/ln(10) decibels
    level("Np", None, 8_685_889_638_065_036_553, -18).dsi("neper"),
    above("dBm", Zero::Milliwatt),
    above("dBW", Zero::Watt),
    above("dBV", Zero::Volt),
    above("dBmV", Zero::Millivolt),
    above("dBuV", Zero::Microvolt).also(&["dB\u{b5}V", "dB\u{3bc}V"]),
    above("dBFS", Zero::FullScale),
    above("dBc", Zero::Carrier),
    above("dBi", Zero::Isotropic),
    number("D"),
    number("digit"),
    number("LSB"),
    number("count"),
];

/// An SI prefix (SI Brochure, 9th ed., table 7).
#[derive(Debug, PartialEq, Eq)]
pub struct Prefix {
    symbol: &'static str,
    /// Other spellings.
    also: &'static [&'static str],
    name: &'static str,
    decimal: i32,
}

impl Prefix {
    /// The symbol: `m`, `k`; `u` for micro.
    pub const fn symbol(&self) -> &'static str {
        self.symbol
    }

    /// The English name: `milli`.
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// The power of ten: -3 for milli.
    pub const fn decimal(&self) -> i32 {
        self.decimal
    }

    /// The name in D-SI and in siunitx. `None` for the prefixes beyond 10^24 and 10^-24, added in
    /// 2022, which not every version of these has.
    pub fn macro_name(&self) -> Option<&'static str> {
        (self.decimal.abs() <= 24).then_some(self.name)
    }

    /// Every spelling, [`Prefix::symbol`] first.
    pub(super) fn spellings(&self) -> impl Iterator<Item = &'static str> {
        std::iter::once(self.symbol).chain(self.also.iter().copied())
    }
}

/// One row of [`PREFIXES`].
const fn prefix(symbol: &'static str, name: &'static str, decimal: i32) -> Prefix {
    Prefix { symbol, also: &[], name, decimal }
}

/// Every prefix, the commonest first.
pub(super) static PREFIXES: &[Prefix] = &[
    prefix("m", "milli", -3),
    prefix("k", "kilo", 3),
    // the micro sign and the Greek letter
    Prefix { also: &["\u{b5}", "\u{3bc}"], ..prefix("u", "micro", -6) },
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
];

/// Every unit symbol, base units first.
pub fn symbols() -> impl Iterator<Item = &'static Symbol> {
    SYMBOLS.iter()
}

/// Every SI prefix, the most common first.
pub fn prefixes() -> impl Iterator<Item = &'static Prefix> {
    PREFIXES.iter()
}

/// The symbol with exactly this spelling.
pub(super) fn symbol(name: &str) -> Option<&'static Symbol> {
    SYMBOLS.iter().find(|symbol| symbol.spellings().any(|spelling| spelling == name))
}

/// Every way to read a name as a prefix and a symbol, allowed or not, with the spelling of each.
pub(super) fn prefixed<'n>(name: &'n str) -> impl Iterator<Item = Prefixed<'n>> {
    prefix_spellings().filter_map(move |(spelling, prefix)| {
        let unit = name.strip_prefix(spelling)?;
        Some(Prefixed { prefix, spelling, symbol: symbol(unit)?, unit })
    })
}

/// Every spelling of every prefix.
pub(super) fn prefix_spellings() -> impl Iterator<Item = (&'static str, &'static Prefix)> {
    PREFIXES.iter().flat_map(|prefix| prefix.spellings().map(move |spelling| (spelling, prefix)))
}

/// A name read as a prefix and a symbol.
#[derive(Debug)]
pub(super) struct Prefixed<'n> {
    /// The prefix.
    pub(super) prefix: &'static Prefix,
    /// The prefix as written.
    pub(super) spelling: &'static str,
    /// The symbol.
    pub(super) symbol: &'static Symbol,
    /// The symbol as written.
    pub(super) unit: &'n str,
}

/// A name read as a unit: first as a symbol (so that `min` is a minute, `ft` a foot, `Pa` a pascal
/// and `cd` a candela), then as a prefix and a symbol that takes one. No name has two readings of
/// the second kind.
pub(super) fn read(name: &str) -> Option<(Option<&'static Prefix>, &'static Symbol)> {
    match symbol(name) {
        Some(symbol) => Some((None, symbol)),
        None => {
            let found = prefixed(name).find(|found| found.symbol.takes(found.prefix))?;
            Some((Some(found.prefix), found.symbol))
        }
    }
}

/// Whether a name is a unit.
pub(super) fn is_unit(name: &str) -> bool {
    read(name).is_some()
}

/// The meaning of a text besides its factors.
#[derive(Debug, Clone, Copy)]
pub(super) struct Meaning {
    /// The dimension.
    pub(super) dimension: Dimension,
    /// The size in coherent SI units.
    pub(super) scale: Scale,
    /// Its kind besides its size.
    pub(super) flavour: Flavour,
}

/// The meaning of a symbol, with or without a prefix.
pub(super) fn meaning(prefix: Option<&Prefix>, symbol: &Symbol) -> Option<Meaning> {
    let power = prefix.map_or(Scale::ONE, |prefix| Scale::power_of_ten(prefix.decimal));
    Some(Meaning {
        dimension: symbol.dimension,
        scale: symbol.scale().times(power)?,
        flavour: symbol.flavour,
    })
}
