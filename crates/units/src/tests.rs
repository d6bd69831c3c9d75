use std::f64::consts::PI;

use super::names::{PREFIXES, SYMBOLS, Symbol, prefix_spellings, prefixed, read};
use super::zero::{Turn, Zero};
use super::{Dimension, Exponent, MissingSide, Unit, UnitError};

/// Text, factor, dimension.
type Right = (&'static str, f64, &'static str);

/// Factors that are exact.
#[rustfmt::skip]
const RIGHT: &[Right] = &[
    ("m (1/s)", 1.0, "m s^-1"), ("m (%^2)", 1e-4, "m"),
    // Base units, prefixes.
    ("", 1.0, "1"), ("  ", 1.0, "1"), ("1", 1.0, "1"), ("m", 1.0, "m"), ("kg", 1.0, "kg"),
    ("g", 1e-3, "kg"), ("mg", 1e-6, "kg"), ("ug", 1e-9, "kg"), ("s", 1.0, "s"), ("A", 1.0, "A"),
    ("K", 1.0, "K"), ("mol", 1.0, "mol"), ("cd", 1.0, "cd"), ("mm", 1e-3, "m"), ("um", 1e-6, "m"),
    ("µm", 1e-6, "m"), ("μm", 1e-6, "m"), ("nm", 1e-9, "m"), ("pm", 1e-12, "m"), ("fm", 1e-15, "m"),
    ("am", 1e-18, "m"), ("zm", 1e-21, "m"), ("ym", 1e-24, "m"), ("rm", 1e-27, "m"),
    ("qm", 1e-30, "m"), ("cm", 1e-2, "m"), ("dm", 0.1, "m"), ("dam", 10.0, "m"), ("hm", 100.0, "m"),
    ("km", 1e3, "m"), ("Mm", 1e6, "m"), ("Gm", 1e9, "m"), ("Tm", 1e12, "m"), ("Pm", 1e15, "m"),
    ("Em", 1e18, "m"), ("Zm", 1e21, "m"), ("Ym", 1e24, "m"), ("Rm", 1e27, "m"), ("Qm", 1e30, "m"),
    ("dag", 1e-2, "kg"), ("mmol", 1e-3, "mol"), ("mK", 1e-3, "K"), ("ms", 1e-3, "s"),
    // Units with names of their own, and names that could be read in two ways.
    ("rad", 1.0, "1"), ("mrad", 1e-3, "1"), ("sr", 1.0, "1"), ("Hz", 1.0, "s^-1"),
    ("kHz", 1e3, "s^-1"), ("N", 1.0, "kg m s^-2"), ("Pa", 1.0, "kg m^-1 s^-2"),
    ("kPa", 1e3, "kg m^-1 s^-2"), ("hPa", 1e2, "kg m^-1 s^-2"), ("J", 1.0, "kg m^2 s^-2"),
    ("W", 1.0, "kg m^2 s^-3"), ("C", 1.0, "s A"), ("V", 1.0, "kg m^2 s^-3 A^-1"),
    ("nV", 1e-9, "kg m^2 s^-3 A^-1"), ("F", 1.0, "kg^-1 m^-2 s^4 A^2"),
    ("pF", 1e-12, "kg^-1 m^-2 s^4 A^2"), ("ohm", 1.0, "kg m^2 s^-3 A^-2"),
    ("Ω", 1.0, "kg m^2 s^-3 A^-2"), ("\u{2126}", 1.0, "kg m^2 s^-3 A^-2"),
    ("kΩ", 1e3, "kg m^2 s^-3 A^-2"), ("Mohm", 1e6, "kg m^2 s^-3 A^-2"),
    ("S", 1.0, "kg^-1 m^-2 s^3 A^2"), ("Wb", 1.0, "kg m^2 s^-2 A^-1"),
    ("T", 1.0, "kg s^-2 A^-1"), ("mT", 1e-3, "kg s^-2 A^-1"), ("H", 1.0, "kg m^2 s^-2 A^-2"),
    ("lm", 1.0, "cd"), ("lx", 1.0, "m^-2 cd"), ("Bq", 1.0, "s^-1"), ("Gy", 1.0, "m^2 s^-2"),
    ("Sv", 1.0, "m^2 s^-2"), ("kat", 1.0, "s^-1 mol"), ("degC", 1.0, "K"), ("°C", 1.0, "K"),
    ("℃", 1.0, "K"), ("min", 60.0, "s"), ("h", 3600.0, "s"), ("d", 86400.0, "s"),
    ("L", 1e-3, "m^3"), ("l", 1e-3, "m^3"), ("mL", 1e-6, "m^3"), ("ul", 1e-9, "m^3"),
    ("t", 1e3, "kg"), ("kt", 1e6, "kg"), ("bar", 1e5, "kg m^-1 s^-2"),
    ("mbar", 1e2, "kg m^-1 s^-2"), ("ubar", 0.1, "kg m^-1 s^-2"), ("Gal", 1e-2, "m s^-2"),
    ("mGal", 1e-5, "m s^-2"), ("g_n", 9.80665, "m s^-2"), ("mg_n", 9.80665e-3, "m s^-2"),
    ("ug_n", 9.80665e-6, "m s^-2"), ("eV", 1.602176634e-19, "kg m^2 s^-2"),
    ("keV", 1.602176634e-16, "kg m^2 s^-2"), ("Da", 1.66053906660e-27, "kg"),
    ("u", 1.66053906660e-27, "kg"), ("au", 149597870700.0, "m"), ("ha", 1e4, "m^2"),
    // SP 811, B.6 and B.8, by rational arithmetic from the pound, the foot, g_n and the two gallons
    ("ozf", 0.2780138509537812, "kg m s^-2"), ("kip", 4448.2216152605, "kg m s^-2"),
    ("ksi", 6894757.293168361, "kg m^-1 s^-2"), ("mi", 1609.344, "m"),
    ("slug", 14.593902937206364, "kg"), ("floz_us", 2.95735295625e-5, "m^3"),
    ("floz_imp", 2.84130625e-5, "m^3"),
    ("in", 0.0254, "m"), ("ft", 0.3048, "m"), ("lb", 0.45359237, "kg"),
    ("lbf", 4.4482216152605, "kg m s^-2"), ("kgf", 9.80665, "kg m s^-2"),
    ("psi", 6894.757293168362, "kg m^-1 s^-2"), ("lbf/in^2", 6894.757293168362, "kg m^-1 s^-2"),
    ("mmHg", 133.322387415, "kg m^-1 s^-2"), ("Torr", 101325.0 / 760.0, "kg m^-1 s^-2"),
    ("atm", 101325.0, "kg m^-1 s^-2"), ("%", 1e-2, "1"), ("‰", 1e-3, "1"), ("ppm", 1e-6, "1"),
    ("ppb", 1e-9, "1"), ("dB", 1.0, "1"), ("D", 1.0, "1"), ("LSB", 1.0, "1"), ("count", 1.0, "1"),
    ("deg", PI / 180.0, "1"), ("°", PI / 180.0, "1"), ("rev", 2.0 * PI, "1"),
    ("turn", 2.0 * PI, "1"), ("rpm", 0.10471975511965978, "s^-1"),
    ("rev/min", 0.10471975511965978, "s^-1"),
    ("degF", 5.0 / 9.0, "K"), ("°F", 5.0 / 9.0, "K"), ("%RH", 1e-2, "1"), ("digit", 1.0, "1"),
    ("VA", 1.0, "kg m^2 s^-3"), ("kVA", 1e3, "kg m^2 s^-3"), ("kvar", 1e3, "kg m^2 s^-3"),
    ("Nm", 1.0, "kg m^2 s^-2"), ("mNm", 1e-3, "kg m^2 s^-2"), ("kWh", 3.6e6, "kg m^2 s^-2"),
    ("mAh", 3.6, "s A"), ("hour", 3600.0, "s"), ("day", 86400.0, "s"), ("week", 604800.0, "s"),
    ("month", 2_629_800.0, "s"), ("year", 31_557_600.0, "s"), ("gon", PI / 200.0, "1"),
    ("inHg", 3386.388640341, "kg m^-1 s^-2"), ("inH2O", 249.08891, "kg m^-1 s^-2"),
    ("mmH2O", 9.80665, "kg m^-1 s^-2"), ("dBm", 1.0, "1"), ("dBV", 1.0, "1"),
    ("Np", 8.685889638065037, "1"), ("dB/m", 1.0, "m^-1"),
    // Products, quotients, powers.
    ("m/s^2", 1.0, "m s^-2"), ("m/s²", 1.0, "m s^-2"), ("m s^-2", 1.0, "m s^-2"),
    ("m·s⁻²", 1.0, "m s^-2"), ("m*s**-2", 1.0, "m s^-2"), ("m.s^-2", 1.0, "m s^-2"),
    ("m⋅s⁻²", 1.0, "m s^-2"), ("m×s⁻²", 1.0, "m s^-2"), ("m / s ^ 2", 1.0, "m s^-2"),
    (" m/s/s ", 1.0, "m s^-2"), ("m/(s*s)", 1.0, "m s^-2"), ("m/(s s)", 1.0, "m s^-2"),
    ("((m))/((s)^(2))", 1.0, "m s^-2"), ("m^\u{2212}1", 1.0, "m^-1"), ("m^+2", 1.0, "m^2"),
    ("kg*m^-3", 1.0, "kg m^-3"), ("g/cm^3", 1e3, "kg m^-3"), ("g/mL", 1e3, "kg m^-3"),
    ("mm^2", 1e-6, "m^2"), ("mm^3", 1e-9, "m^3"), ("um^2", 1e-12, "m^2"), ("km^2", 1e6, "m^2"),
    ("mm²", 1e-6, "m^2"), ("cm^-1", 100.0, "m^-1"), ("in^2", 0.00064516, "m^2"),
    ("km/h", 1.0 / 3.6, "m s^-1"), ("m/min", 1.0 / 60.0, "m s^-1"),
    ("L/min", 1.0 / 60_000.0, "m^3 s^-1"), ("kW*h", 3.6e6, "kg m^2 s^-2"),
    ("N*m", 1.0, "kg m^2 s^-2"), ("N m", 1.0, "kg m^2 s^-2"), ("N.m", 1.0, "kg m^2 s^-2"),
    ("J/kg*K", 1.0, "m^2 s^-2 K"), ("J/(kg*K)", 1.0, "m^2 s^-2 K^-1"),
    ("J/kg/K", 1.0, "m^2 s^-2 K^-1"), ("W/(m K)", 1.0, "kg m s^-3 K^-1"),
    ("V/V", 1.0, "1"), ("mV/V", 1e-3, "1"), ("uV/V", 1e-6, "1"), ("um/m", 1e-6, "1"),
    ("1/K", 1.0, "K^-1"), ("10^-6/K", 1e-6, "K^-1"), ("1e-6/K", 1e-6, "K^-1"),
    ("10⁻⁶/K", 1e-6, "K^-1"), ("1e-6 K^-1", 1e-6, "K^-1"), ("ppm/degC", 1e-6, "K^-1"),
    ("%/K", 1e-2, "K^-1"), ("1E+3", 1e3, "1"), ("10mm", 1e-2, "m"), ("10 mm", 1e-2, "m"),
    ("1/2 mm", 5e-4, "m"), ("(J/kg) K", 1.0, "m^2 s^-2 K"), ("J kg^-1 K^-1", 1.0, "m^2 s^-2 K^-1"),
    ("2(m)", 2.0, "m"), ("1eV", 1.602176634e-19, "kg m^2 s^-2"),
    ("2.5e3*Pa", 2.5e3, "kg m^-1 s^-2"),
    ("0.1", 0.1, "1"), ("0.3*m", 0.3, "m"), ("10^-300", 1e-300, "1"), ("2^10", 1024.0, "1"),
    ("mg/LSB", 1e-6, "kg"), ("mg_n/LSB", 9.80665e-3, "m s^-2"), ("D/(m/s^2)", 1.0, "m^-1 s^2"),
    ("1/30*deg", PI / 5400.0, "1"), ("mV/g_n", 1.0197162129779283e-4, "kg m s^-1 A^-1"),
    ("pC/(m/s^2)", 1e-12, "m^-1 s^3 A"), ("m^0", 1.0, "1"), ("m^24/m^24", 1.0, "1"),
    ("Qm^24/Qm^24", 1.0, "1"), ("(m^1)/2", 0.5, "m"), ("m^2/30", 1.0 / 30.0, "m^2"),
    ("m^2/1e3", 1e-3, "m^2"), ("m^2/2.5", 0.4, "m^2"), ("m^2/2^3", 0.125, "m^2"),
    ("10^1/2", 5.0, "1"), ("m²/2", 0.5, "m^2"), ("m^2/1", 1.0, "m^2"), ("m^(1)/2", 0.5, "m"),
    // Roots.
    ("m^(1/2)", 1.0, "m^(1/2)"), ("nV/Hz^(1/2)", 1e-9, "kg m^2 s^(-5/2) A^-1"),
    ("nV/√Hz", 1e-9, "kg m^2 s^(-5/2) A^-1"), ("nV/sqrt(Hz)", 1e-9, "kg m^2 s^(-5/2) A^-1"),
    ("Hz^0.5", 1.0, "s^(-1/2)"), ("Hz^-0.5", 1.0, "s^(1/2)"), ("(mm^2)^(1/2)", 1e-3, "m"),
    ("Hz^(-1/2)", 1.0, "s^(1/2)"), ("Hz^-(1/2)", 1.0, "s^(1/2)"), ("√(mm^2)", 1e-3, "m"),
    ("MPa*m^(1/2)", 1e6, "kg m^(-1/2) s^-2"), ("4^(1/2)*m", 2.0, "m"), ("m^1.5", 1.0, "m^(3/2)"),
];

/// Factors that go through floating point somewhere: within 1e-15 of their size.
const NEARLY: &[Right] = &[
    ("'", PI / 10_800.0, "1"),
    ("′", PI / 10_800.0, "1"),
    ("arcmin", PI / 10_800.0, "1"),
    ("''", PI / 648_000.0, "1"),
    ("″", PI / 648_000.0, "1"),
    ("arcsec", PI / 648_000.0, "1"),
    ("deg/s", PI / 180.0, "s^-1"),
    ("1/deg", 180.0 / PI, "1"),
    ("deg^2", PI / 180.0 * PI / 180.0, "1"),
    ("deg^3", PI / 180.0 * PI / 180.0 * PI / 180.0, "1"),
    ("2^(1/2)", std::f64::consts::SQRT_2, "1"),
    ("kHz^(1/2)", 31.622776601683793, "s^(-1/2)"),
    ("kHz^(1/3)", 10.0, "s^(-1/3)"),
    ("10^(1/4)", 1.7782794100389228, "1"),
    ("3^100", 5.153_775_207_320_113e47, "1"),
    ("3^100/3^100", 1.0, "1"),
];

#[test]
fn right_texts_have_the_right_factor_and_dimension() {
    assert!(RIGHT.len() + NEARLY.len() >= 130);
    for (text, factor, dimension) in RIGHT {
        let unit = Unit::parse(text).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert_eq!(unit.factor(), *factor, "{text}");
        assert_eq!(unit.dimension().to_string(), *dimension, "{text}");
        assert_eq!(unit.text(), *text);
    }
    for (text, factor, dimension) in NEARLY {
        let unit = Unit::parse(text).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert!((unit.factor() / factor - 1.0).abs() <= 1e-15, "{text}: {}", unit.factor());
        assert_eq!(unit.dimension().to_string(), *dimension, "{text}");
    }
}

/// The name of a variant, and what it carries besides places.
fn variant(error: &UnitError) -> &'static str {
    match error {
        UnitError::UnknownUnit { .. } => "unknown",
        UnitError::QualifiedUnit { .. } => "qualified",
        UnitError::PrefixNotAllowed { .. } => "prefix",
        UnitError::UnexpectedCharacter { .. } => "character",
        UnitError::MissingFactor { side: MissingSide::Before, .. } => "missing before",
        UnitError::MissingFactor { side: MissingSide::After, .. } => "missing after",
        UnitError::MissingFactor { side: MissingSide::Inside, .. } => "missing inside",
        UnitError::UnbalancedParenthesis { .. } => "parenthesis",
        UnitError::ExponentNotANumber { .. } => "exponent",
        UnitError::ExponentTooLarge { .. } => "too large",
        UnitError::AmbiguousPower { .. } | UnitError::AmbiguousProduct { .. } => "ambiguous",
        UnitError::NumberInParentheses { .. } => "number",
        UnitError::FactorOutOfRange { .. } => "range",
        UnitError::TooLong { .. } => "long",
        UnitError::NestedTooDeep { .. } => "deep",
    }
}

/// Text, variant, the part of the text that the span covers and where it starts, suggestions.
type Wrong = (&'static str, &'static str, usize, &'static str, &'static [&'static str]);

#[rustfmt::skip]
const WRONG: &[Wrong] = &[
    // Misspelt and spelled-out names.
    ("Kg", "unknown", 0, "Kg", &["kg"]), ("sec", "unknown", 0, "sec", &["s"]),
    ("hz", "unknown", 0, "hz", &["Hz"]), ("celsius", "unknown", 0, "celsius", &["degC"]),
    ("celcius", "unknown", 0, "celcius", &["degC"]), ("degrees", "unknown", 0, "degrees", &["deg"]),
    ("meter", "unknown", 0, "meter", &["m"]), ("percent", "unknown", 0, "percent", &["%"]),
    ("M/s", "unknown", 0, "M", &["m", "mol/L"]), ("m/S2", "unknown", 2, "S2", &["S^2"]),
    ("m/s2", "unknown", 2, "s2", &["s^2"]), ("cm3", "unknown", 0, "cm3", &["cm^3"]),
    ("msec", "unknown", 0, "msec", &["ms"]), ("amp", "unknown", 0, "amp", &["A"]),
    ("mAmps", "unknown", 0, "mAmps", &["mA"]), ("volt", "unknown", 0, "volt", &["V"]),
    ("Ohm", "unknown", 0, "Ohm", &["ohm"]), ("kOhm", "unknown", 0, "kOhm", &["kohm"]),
    ("inch", "unknown", 0, "inch", &["in"]), ("micron", "unknown", 0, "micron", &["um"]),
    ("millimetres", "unknown", 0, "millimetres", &["mm"]),
    ("kilogram", "unknown", 0, "kilogram", &["kg"]),
    ("Kilohertz", "unknown", 0, "Kilohertz", &["kHz"]), ("MIN", "unknown", 0, "MIN", &["min"]),
    ("Min", "unknown", 0, "Min", &["min"]), ("KHz", "unknown", 0, "KHz", &["kHz"]),
    ("mhz", "unknown", 0, "mhz", &["mHz", "MHz"]), ("k", "unknown", 0, "k", &["K"]),
    ("Ws", "unknown", 0, "Ws", &["W*s"]), ("kVs", "unknown", 0, "kVs", &["kV*s"]),
    ("mPas", "unknown", 0, "mPas", &["mPa*s"]), ("kmh", "unknown", 0, "kmh", &["km/h"]),
    ("yd", "unknown", 0, "yd", &["0.9144*m"]), ("Fahrenheit", "unknown", 0, "Fahrenheit", &["degF"]),
    ("kg/metre^3", "unknown", 3, "metre", &["m"]), 
    ("\"", "unknown", 0, "\"", &["arcsec", "in"]), ("º", "unknown", 0, "º", &["deg"]),
    ("radiant", "unknown", 0, "radiant", &["rad"]), ("qqq", "unknown", 0, "qqq", &[]),
    ("parsec", "unknown", 0, "parsec", &["arcsec"]), ("µ", "unknown", 0, "µ", &[]),
    ("counts", "unknown", 0, "counts", &["count"]), ("krads", "unknown", 0, "krads", &["krad"]),
    ("neper", "unknown", 0, "neper", &["Np"]), ("HRC", "unknown", 0, "HRC", &[]), ("%FS", "unknown", 0, "%FS", &["%"]),
    ("floz", "unknown", 0, "floz", &["floz_us", "floz_imp"]), ("mile", "unknown", 0, "mile", &["mi"]),
    ("lsb", "unknown", 0, "lsb", &["LSB"]), ("gal", "unknown", 0, "gal", &["Gal", "3.785411784*L"]),
    ("м", "unknown", 0, "м", &[]), ("_", "unknown", 0, "_", &[]),
    // Prefixes.
    ("mdegC", "prefix", 0, "mdegC", &["mK"]), ("m°C", "prefix", 0, "m°C", &["mK"]),
    ("W/mdeg", "prefix", 2, "mdeg", &["1e-3*deg"]), ("kmin", "prefix", 0, "kmin", &["1e3*min"]),
    ("µin", "prefix", 0, "µin", &["1e-6*in"]), ("mkg", "prefix", 0, "mkg", &["g"]),
    ("mmm", "prefix", 0, "mmm", &["um"]), ("kkm", "prefix", 0, "kkm", &["Mm"]),
    ("mD", "prefix", 0, "mD", &["1e-3*D"]),
    // Characters.
    ("m-3", "character", 1, "-", &["m^-3"]),
    ("kg m\u{2212}3", "character", 4, "\u{2212}", &["m^-3"]),
    ("m 2", "character", 2, "2", &["m^2"]), ("10 000/K", "character", 3, "0", &["10000"]),
    ("1,5", "character", 1, ",", &[]), ("-1", "character", 0, "-", &[]),
    ("m/#", "character", 2, "#", &[]), ("m(s)", "character", 1, "(", &[]),
    ("m²s", "character", 3, "s", &[]), ("m^2^3", "character", 3, "^", &[]),
    ("m^2**3", "character", 3, "*", &[]), ("m^2 ³", "character", 4, "³", &[]),
    ("^2", "character", 0, "^", &[]), (".5*m", "character", 0, ".", &["0.5"]),
    ("²", "character", 0, "²", &[]),
    ("m\u{7}", "character", 1, "\u{7}", &[]), ("€/m", "character", 0, "€", &[]),
    // Something missing.
    ("m/", "missing after", 1, "/", &[]), ("m * ", "missing after", 2, "*", &[]),
    ("m//s", "missing after", 1, "/", &[]), ("m/(s*)", "missing after", 4, "*", &[]),
    ("√", "missing after", 0, "√", &[]), ("5.", "missing after", 1, ".", &[]),
    ("/s", "missing before", 0, "/", &[]), (" *s", "missing before", 1, "*", &[]),
    ("m*( )", "missing inside", 2, "( )", &[]),
    ("m/(s", "parenthesis", 2, "(", &[]), ("(", "parenthesis", 0, "(", &[]),
    ("m)", "parenthesis", 1, ")", &[]), (")", "parenthesis", 0, ")", &[]),
    ("m^(1/2", "parenthesis", 2, "(", &[]), ("sqrt(Hz", "parenthesis", 4, "(", &[]),
    // Exponents.
    ("m^", "exponent", 1, "^", &[]), ("m**", "exponent", 1, "**", &[]),
    ("m^x", "exponent", 2, "x", &[]), ("m^2s", "exponent", 2, "2s", &[]),
    ("m^-", "exponent", 2, "-", &[]), ("m^(1/0)", "exponent", 2, "(1/0)", &[]),
    ("m^(a)", "exponent", 2, "(a)", &[]), ("m⁻", "exponent", 1, "⁻", &[]),
    ("m^25", "too large", 2, "25", &[]), ("m^-25", "too large", 2, "-25", &[]),
    ("m^99999999999", "too large", 2, "99999999999", &[]),
    ("m^(1/25)", "too large", 2, "(1/25)", &[]), ("m^0.333", "too large", 2, "0.333", &[]),
    ("(((m^24)^24)^24)^24", "too large", 0, "(((m^24)^24)^24)^24", &[]),
    ("10^301", "too large", 3, "301", &[]),
    ("1/((m^24)^24)^24^1", "character", 16, "^", &[]),
    ("Hz^1/2", "ambiguous", 3, "1/2", &["Hz^(1/2)", "(Hz^1)/2"]),
    ("m^-3 / 2", "ambiguous", 2, "-3 / 2", &["m^(-3/2)", "(m^-3)/2"]),
    ("J/kg K", "ambiguous", 0, "J/kg K", &["J/(kg K)", "(J/kg) K"]),
    ("g/100g", "ambiguous", 0, "g/100g", &["g/(100g)", "(g/100) g"]),
    ("mg/100 mL", "ambiguous", 0, "mg/100 mL", &["mg/(100 mL)", "(mg/100) mL"]),
    ("mV W / m² · K", "ambiguous", 0, "mV W / m² · K", &["mV W/(m² · K)", "(mV W / m²) · K"]),
    ("° C", "ambiguous", 0, "° C", &["degC", "°*C"]), ("W/deg K", "ambiguous", 2, "deg K", &["K", "deg*K"]),
    ("° F", "ambiguous", 0, "° F", &["degF", "°*F"]), ("% rh", "ambiguous", 0, "% rh", &["%RH", "%*RH"]),
    ("dB m", "ambiguous", 0, "dB m", &["dBm", "dB*m"]), ("V/dB M", "ambiguous", 2, "dB M", &["dBm", "dB*m"]),
    ("1/(N/mm.s)", "ambiguous", 3, "N/mm.s", &["N/(mm.s)", "(N/mm).s"]),
    // Uncertainties and coverages behind units.
    ("V (23)", "number", 2, "(23)", &[]), ("ohm (0.1 %)", "number", 4, "(0.1 %)", &[]),
    ("V (95 %)", "number", 2, "(95 %)", &[]), ("V (%)", "number", 2, "(%)", &[]),
    ("V (1/√3)", "number", 2, "(1/√3)", &[]), ("J/kg (2)", "number", 5, "(2)", &[]),
    // Factors.
    ("0", "range", 0, "0", &[]), ("m/0.0", "range", 2, "0.0", &[]),
    ("1e400*m", "range", 0, "1e400*m", &[]),
    (" Qm^24 ", "range", 1, "Qm^24", &[]),
    ("1e99999999999999999999", "range", 0, "1e99999999999999999999", &[]),
];

#[test]
fn wrong_texts_are_refused_with_place_and_suggestion() {
    assert!(WRONG.len() >= 30);
    for (text, kind, start, part, suggestions) in WRONG {
        let error = Unit::parse(text).expect_err(text);
        assert_eq!(variant(&error), *kind, "{text}: {error}");
        assert_eq!((error.span().start, text.get(error.span())), (*start, Some(*part)), "{text}");
        assert_eq!(error.suggestions(), *suggestions, "{text}: {error}");
    }
}

/// A product with a group is one, and a number with its sign is a factor.
#[test]
fn groups_behind_units_are_factors() {
    for text in ["V*(2)", "V/(2)", "mV/(10 V)", "W (m K)", "2 (mm)", "10^-6 (m/m)"] {
        assert!(Unit::parse(text).is_ok(), "{text}");
    }
}

/// SI brochure, 9th edition, table 8: only prefixes above 1 stand before the tonne.
#[test]
fn carats_are_no_centitonnes() {
    assert_eq!(Unit::parse("ct").unwrap().to_si(5.0), 0.001);
    assert_eq!(Unit::parse("kt").unwrap().factor(), 1e6);
    let refused = |text: &str| Unit::parse(text).unwrap_err().to_string();
    assert_eq!(refused("mt"), "`t` does not take the prefix `m`; write `1e-3*t`");
    assert_eq!(refused("dt"), "`t` does not take the prefix `d`; write `1e-1*t`");
    assert_eq!(refused("kct"), "`ct` does not take the prefix `k`; write `1e3*ct`");
}

/// A near name of another kind is worse than none.
#[test]
fn names_of_another_kind_are_not_suggested() {
    let suggested = |text: &str| -> Vec<String> {
        let error = Unit::parse(text).unwrap_err().in_whole(text);
        error.suggestions().into_iter().map(str::to_owned).collect()
    };
    for (text, expected) in [
        ("kg/m3", vec!["kg/m^3"]),
        ("g/cm3", vec!["g/cm^3"]),
        ("gr", vec!["g", "64.79891*mg"]),
        ("mM", vec!["mmol/L"]),
        ("U/L", vec!["umol/min/L"]),
        ("Ncm", vec!["N*cm"]),
        ("Nmm", vec!["N*mm"]),
        ("HBW", vec![]),
        ("FS", vec![]),
        ("cpm", vec!["1/min"]),
        ("N/mdeg", vec!["N/(1e-3*deg)"]),
    ] {
        assert_eq!(suggested(text), expected, "{text}");
    }
}

#[test]
fn limits_are_enforced() {
    let long = "m*".repeat(129) + "m";
    assert_eq!(Unit::parse(&long), Err(UnitError::TooLong { length: 259, limit: 256 }));
    let deep = "(".repeat(17) + "m" + &")".repeat(17);
    assert_eq!(Unit::parse(&deep), Err(UnitError::NestedTooDeep { span: 16..17, limit: 16 }));
    assert!(Unit::parse(&("(".repeat(16) + "m" + &")".repeat(16))).is_ok());
    assert!(Unit::parse(&"(".repeat(256)).is_err());
    assert!(Unit::parse(&"√".repeat(17)).is_err());
    assert!(Unit::parse(&"9".repeat(256)).is_ok_and(|u| u.factor() == 1e256));
    assert!(Unit::parse(&("1".to_owned() + &"^300".repeat(2))).is_err());
    assert!(Unit::parse("((((((10^300)^300)^300)^300)^300)^300)").is_err());
}

#[test]
fn messages_read_well() {
    let cases = [
        ("Kg", "`Kg` is not a known unit; did you mean `kg`?"),
        ("mhz", "`mhz` is not a known unit; did you mean `mHz` or `MHz`?"),
        ("qqq", "`qqq` is not a known unit; write units like `mm`, `kg*m^-3` or `m/s^2`"),
        ("mdegC", "`degC` does not take the prefix `m`; write `mK`"),
        (
            "m-3",
            "`-` is not allowed here; expected `*`, `/`, `^` or the end of the unit; did you mean \
             `m^-3`?",
        ),
        ("m\u{7}", "`\\u{7}` is not allowed here; expected `*`, `/`, `^` or the end of the unit"),
        ("m/", "`/` needs a unit or a number after it"),
        ("/s", "`/` needs a unit or a number before it, such as `1/`"),
        ("m/(s", "`(` opens a parenthesis that is not closed; add `)`"),
        ("m^", "the exponent is missing; write it like `^2`, `^-3` or `^(1/2)`"),
        ("m^x", "`x` is not an exponent; write it like `^2`, `^-3` or `^(1/2)`"),
        (
            "Hz^1/2",
            "a power followed by a division by a number can be read in two ways; write \
             `Hz^(1/2)` or `(Hz^1)/2`",
        ),
    ];
    for (text, message) in cases {
        assert_eq!(Unit::parse(text).unwrap_err().to_string(), message);
    }
}

#[test]
fn celsius_and_relative_units_are_flagged_only_on_their_own() {
    let unit = |text| Unit::parse(text).unwrap();
    for text in ["degC", "°C", "℃", "(degC)", "degC^1"] {
        assert!(unit(text).is_celsius(), "{text}");
        assert_eq!(unit(text).to_si(20.0), 20.0);
    }
    for text in ["K", "1/degC", "W/degC", "degC^2", "1*degC"] {
        assert!(!unit(text).is_celsius(), "{text}");
    }
    for text in ["%", "‰", "ppm", "ppb"] {
        assert!(unit(text).is_relative(), "{text}");
    }
    for text in ["1", "ppm/K", "dB", "deg", "%*%"] {
        assert!(!unit(text).is_relative(), "{text}");
    }
}

#[test]
fn values_convert_to_the_last_bit() {
    let unit = |text| Unit::parse(text).unwrap();
    assert_eq!(unit("mm").to_si(9.0), 0.009);
    assert_eq!(unit("um").to_si(7.0), 7e-6);
    assert_eq!(unit("ug").to_si(3.0), 3e-9);
    assert_eq!(unit("mm").from_si(0.009), 9.0);
    assert_eq!(unit("km/h").to_si(36.0), 10.0);
    assert_eq!(unit("km/h").from_si(10.0), 36.0);
    assert_eq!(unit("deg").to_si(180.0), PI);
    assert_eq!(unit("%").to_si(f64::MAX), f64::MAX / 100.0);
    assert_eq!(unit("mm").from_si(1e308), f64::INFINITY);
    assert_eq!(unit("km").to_si(-0.0).to_bits(), (-0.0_f64).to_bits());
    assert!(unit("km").to_si(f64::NAN).is_nan());
    let factor = |from, to| Unit::conversion_factor(&unit(from), &unit(to));
    assert_eq!(factor("m", "mm"), Ok(1000.0));
    assert_eq!(factor("um", "in"), Ok(1e-6 / 0.0254));
    assert_eq!(factor("km/h", "m/s"), Ok(1.0 / 3.6));
    assert_eq!(factor("rev", "deg"), Ok(360.0));
    assert_eq!(factor("deg", "arcmin"), Ok(60.0));
    assert_eq!(factor("%", "ppm"), Ok(1e4));
    assert_eq!(factor("degC", "K"), Ok(1.0));
    let error = factor("mm", "ms").unwrap_err();
    assert_eq!(
        error.to_string(),
        "`mm` measures a length (m), and `ms` a time (s); one cannot be converted to the other"
    );
}

#[test]
fn values_convert_with_the_zero_of_their_scale() {
    let unit = |text: &str| Unit::parse(text).unwrap();
    let convert = |value, from, to| Unit::convert(value, &unit(from), &unit(to));
    assert_eq!(convert(20.0, "degC", "K"), Ok(293.15));
    assert_eq!(convert(293.15, "K", "degC"), Ok(293.15 - 273.15));
    assert_eq!(convert(20.0, "degC", "mK"), Ok(293_150.0));
    // 0 degF is 459.67 * 5/9 K (NIST SP 811, B.8); two roundings of 16 digits
    for (value, from, to, right) in [
        (0.0, "degF", "K", 459.67 * 5.0 / 9.0),
        (212.0, "degF", "degC", 100.0),
        (20.0, "degC", "degF", 68.0),
        (-40.0, "degF", "degC", -40.0),
        (10.0, "dBm", "dBW", -20.0),
        (0.0, "dBV", "dBuV", 120.0),
        // 1 Np is 20 lg(e) dB (ISO 80000-3)
        (1.0, "Np", "dB", 8.685889638065037),
        (20.0, "mm", "m", 0.02),
        (90.0, "deg", "rad", PI / 2.0),
    ] {
        let found = convert(value, from, to).unwrap();
        assert!((found - right).abs() <= 1e-15 * right.abs().max(300.0), "{value} {from}: {found}");
    }
    for (from, to) in [("dBm", "dB"), ("dBm", "dBV")] {
        assert!(convert(1.0, from, to).is_err(), "{from} {to}");
    }
    // of a width as well
    for (from, to) in [
        ("dB", "1"),
        ("1", "dB"),
        ("rpm", "Hz"),
        ("Hz", "rad/s"),
        ("rpm", "1/min"),
        ("1/s", "rev/s"),
        ("rev", "1"),
        ("V/rpm", "V/Hz"),
        ("rpm^2", "Hz^2"),
        ("s", "s/rev"),
        ("1/min", "deg/s"),
    ] {
        assert!(convert(1.0, from, to).is_err(), "{from} {to}");
        assert!(Unit::conversion_factor(&unit(from), &unit(to)).is_err(), "{from} {to}");
    }
    for (from, to) in [
        ("rad/s", "1/s"),
        ("Hz", "1/min"),
        ("deg", "1"),
        ("rpm", "rad/s"),
        ("nV/Hz^(1/2)", "V*s^(1/2)"),
        ("N*m/rad", "N*m"),
        ("V/rpm", "V*s/rad"),
        ("mV/(deg/s)", "V*s/rad"),
    ] {
        assert!(Unit::conversion_factor(&unit(from), &unit(to)).is_ok(), "{from} {to}");
    }
    assert_eq!(
        convert(60.0, "rpm", "Hz").unwrap_err().to_string(),
        "`rpm` measures an angular velocity, which counts angle, and `Hz` a frequency, which counts \
         periods; one cannot be converted to the other"
    );
    // differences know no zero
    let factor = Unit::conversion_factor(&unit("degF"), &unit("degC"));
    assert_eq!(factor, Ok(5.0 / 9.0));
}

#[test]
fn how_units_are_written_tells_what_they_count() {
    let unit = |text: &str| Unit::parse(text).unwrap();
    let exponent = |text: &str| unit(text).celsius_exponent().to_f64();
    for (text, of_celsius) in
        [("1/degC", -1.0), ("ppm/degC^2", -2.0), ("mV/K", 0.0), ("degF", 0.0), ("W/(m^2 °C)", -1.0)]
    {
        assert_eq!(exponent(text), of_celsius, "{text}");
    }
    assert_eq!(unit("dB/km").level_exponent(), Exponent::ONE);
    assert_eq!(unit("dBm").zero(), Some(Zero::Milliwatt));
    assert_eq!(unit("degF").zero(), Some(Zero::Celsius));
    assert_eq!(unit("degF/s").zero(), None);
    assert_eq!(unit("rev/min").turn(), Some(Turn::Angle));
    assert_eq!(unit("kHz").turn(), Some(Turn::Periods));
    assert_eq!(unit("mrad").turn(), Some(Turn::Angle));
    for text in ["1/s", "Bq", "rad*Hz", "Hz/V"] {
        assert_eq!(unit(text).turn(), None, "{text}");
    }
}

/// A name of one's own for a unit with a zero, a level, a share or an angle does not lose it.
#[test]
fn names_of_ones_own_keep_the_kind() {
    let unit = |text: &str| Unit::parse(text).unwrap();
    for (name, definition) in [
        ("Cel", "degC"),
        ("Fahr", "degF"),
        ("dezM", "dBm"),
        ("Proz", "%"),
        ("upm", "rpm"),
        ("Hx", "kHz"),
    ] {
        let definition = unit(definition);
        let own = [Unit::defined(name, &definition).unwrap()];
        for text in [name, &format!("({name})")] {
            let read = Unit::parse_among(text, &own).unwrap();
            assert_eq!(
                (read.zero(), read.turn()),
                (definition.zero(), definition.turn()),
                "{text}"
            );
            assert_eq!(read.offset(), definition.offset(), "{text}");
            assert_eq!(read.is_relative(), definition.is_relative(), "{text}");
            assert_eq!(read.level_exponent(), definition.level_exponent(), "{text}");
        }
        let per = [
            Unit::parse_among(&format!("V/{name}"), &own).unwrap(),
            unit(&format!("V/{definition}")),
        ];
        assert_eq!(per[0].celsius_exponent(), per[1].celsius_exponent(), "{name}");
    }
}

#[test]
fn dimensions_calculate_and_describe_themselves() {
    let length = Dimension::LENGTH;
    let speed = length.checked_div(Dimension::TIME).unwrap();
    let acceleration = speed.checked_div(Dimension::TIME).unwrap();
    assert_eq!(acceleration.describe(), "an acceleration (m s^-2)");
    assert_eq!(Dimension::NONE.describe(), "a plain number");
    assert_eq!(Unit::parse("mV").unwrap().dimension().quantity(), Some("a voltage"));
    assert_eq!(length.checked_powi(5).unwrap().describe(), "a quantity in m^5");
    let root = length.checked_root(2).unwrap();
    assert_eq!(root.to_string(), "m^(1/2)");
    assert_eq!(root.checked_mul(root), Some(length));
    assert_eq!(root.checked_powi(-2), Dimension::NONE.checked_div(length));
    assert_eq!(length.checked_root(0), None);
    assert_eq!(length.checked_powi(40_000), None);
    assert_eq!(length.checked_powi(i32::MIN), None);
    assert_eq!(Exponent::new(2, -4), Exponent::new(-1, 2));
    assert_eq!(Exponent::new(i32::MIN, i32::MIN), Some(Exponent::ONE));
    assert_eq!(format!("{acceleration:?}"), "Dimension(m s^-2)");
    let mut d = length;
    while let Some(next) = d.checked_mul(d) {
        d = next;
    }
    assert!(d.exponents()[1].to_f64() >= 16_384.0);
}

#[test]
fn coherent_units_read_back() {
    for (text, ..) in RIGHT.iter().chain(NEARLY) {
        let dimension = Unit::parse(text).unwrap().dimension();
        let coherent = Unit::coherent(dimension);
        assert_eq!(coherent.text().parse(), Ok(coherent.clone()), "{text}");
        assert_eq!(coherent.factor(), 1.0);
    }
    assert_eq!(Unit::one(), Unit::parse("1").unwrap());
    assert_eq!(Unit::default(), Unit::one());
    assert_eq!(format!("{:>4}|", Unit::parse("mm").unwrap()), "  mm|");
}

#[test]
fn no_name_has_two_meanings() {
    let spellings: Vec<&str> = SYMBOLS.iter().flat_map(Symbol::spellings).collect();
    for (i, a) in spellings.iter().enumerate() {
        assert!(!spellings[i + 1..].contains(a), "{a}");
    }
    let prefixes: Vec<&str> = prefix_spellings().map(|(spelling, _)| spelling).collect();
    assert_eq!(prefixes.len(), 26);
    let takes = |found: &super::names::Prefixed<'_>| found.symbol.takes(found.prefix);
    for symbol in SYMBOLS.iter().filter(|symbol| symbol.prefixes) {
        for (spelling, prefix) in prefix_spellings() {
            for a in symbol.spellings().filter(|_| symbol.takes(prefix)) {
                let name = format!("{spelling}{a}");
                assert!(read(&name).is_some(), "{name}");
                assert_eq!(prefixed(&name).filter(takes).count(), 1, "{name}");
            }
        }
    }
    assert!(read("Grad").is_none() && read("mt").is_none());
    // no symbol hides a prefix and a unit: `ft` and `ct` are no femtotonnes and centitonnes
    assert!(!spellings.iter().any(|name| prefixed(name).any(|found| takes(&found))));
}

/// `Grad` is the German word for a degree and no gigaradian.
#[test]
fn no_gigaradian() {
    assert!(Unit::parse("mrad").is_ok() && Unit::parse("krad").is_ok());
    let error = Unit::parse("Grad").unwrap_err();
    assert_eq!(error.suggestions(), ["deg", "gon"]);
}

/// Factors as `base^exponent`.
fn shown(unit: &Unit) -> Vec<String> {
    let factors = unit.factors().iter();
    factors.map(|factor| format!("{}^{}", factor.base, factor.exponent)).collect()
}

#[test]
fn factors_keep_the_order_and_not_the_spelling() {
    let cases: &[(&[&str], &[&str], &str)] = &[
        (&["", "1", "1.0", "(1)", "1*1", "1^3"], &[], "1"),
        (&["m^2", "m**2", "m²", "m^(2)", "m^2.0", "(m)^2", "m^+2", "1*m^2"], &["m^2"], "m^2"),
        (
            &["m/s^2", "m/s²", "m·s⁻²", "m*s**-2", "m s^-2", "m.s^(-2)", "(m)/(s^2)", "m×s^(-4/2)"],
            &["m^1", "s^-2"],
            "m/s^2",
        ),
        (&["m/s/s", "m/(s s)"], &["m^1", "s^-1", "s^-1"], "m/(s·s)"),
        (
            &["mV/(m/s²)", "mV*m^-1*s^2", "mV/m*s^2", "(mV/m) s²"],
            &["mV^1", "m^-1", "s^2"],
            "mV·s^2/m",
        ),
        (&["J/kg*K", "J kg^-1 K"], &["J^1", "kg^-1", "K^1"], "J·K/kg"),
        (
            &["nV/√Hz", "nV/Hz^(1/2)", "nV/sqrt(Hz)", "nV Hz^-0.5", "√(nV^2/Hz)"],
            &["nV^1", "Hz^-1/2"],
            "nV/Hz^(1/2)",
        ),
        (&["1e-6/K", "10^-6/K", "10⁻⁶ K⁻¹", "0.000001/K"], &["10^-6", "K^-1"], "10^-6/K"),
        (&["1/30*deg", "30^-1 °", "1/(30/deg)"], &["30^-1", "deg^1"], "30^-1·deg"),
        (&["2.5e3*Pa", "2500 Pa", "2500Pa"], &["2500^1", "Pa^1"], "2500·Pa"),
        (&["µΩ", "uohm", "μ\u{2126}"], &["uohm^1"], "uohm"),
        (&["1/K", "K^-1"], &["K^-1"], "1/K"),
        (&["um/m", "µm m⁻¹"], &["um^1", "m^-1"], "um/m"),
        (&["degC", "°C", "℃"], &["degC^1"], "degC"),
        (&["25e400/1e400*m"], &["25^1", "10^400", "10^-400", "m^1"], "25·10^400·10^-400·m"),
    ];
    for (spellings, factors, normal) in cases {
        for spelling in *spellings {
            let unit = Unit::parse(spelling).unwrap();
            assert_eq!(shown(&unit), *factors, "{spelling}");
            assert_eq!(unit.normal_text(), *normal, "{spelling}");
        }
    }
}

/// What the factors multiply to is what the text was read as: two ways to the same number.
#[test]
fn factors_multiply_to_the_unit() {
    for (text, ..) in RIGHT.iter().chain(NEARLY) {
        let unit = Unit::parse(text).unwrap();
        let mut dimension = Dimension::NONE;
        let mut logarithm = 0.0;
        for factor in unit.factors() {
            let base = Unit::parse(&factor.base.to_string()).unwrap();
            let power = base.dimension().checked_pow(factor.exponent).unwrap();
            dimension = dimension.checked_mul(power).unwrap();
            logarithm += base.factor().log10() * factor.exponent.to_f64();
        }
        assert_eq!(dimension, unit.dimension(), "{text}");
        // a few roundings of logarithms up to some hundreds
        assert!((logarithm - unit.factor().log10()).abs() < 1e-12, "{text}");
        let normal = Unit::parse(&unit.normal_text()).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert_eq!(normal.normal_text(), unit.normal_text(), "{text}");
        assert!((normal.factor() / unit.factor() - 1.0).abs() < 1e-14, "{text}");
        assert_eq!(normal.dimension(), unit.dimension(), "{text}");
    }
}

/// Every name that another language of units has for a symbol is that of one symbol only.
#[test]
fn names_in_other_languages_are_unique() {
    for name_of in [Symbol::dsi_name, Symbol::siunitx_name] {
        let names: Vec<&str> = SYMBOLS.iter().filter_map(name_of).collect();
        for (i, name) in names.iter().enumerate() {
            assert!(!names[i + 1..].contains(name), "{name}");
            assert!(!name.is_empty() && name.chars().all(|c| c.is_ascii_alphabetic()));
        }
    }
    let named = PREFIXES.iter().filter(|prefix| prefix.macro_name().is_some());
    assert_eq!(named.count(), 20);
}

/// Prefixes are kept, of words and of units that take none; a name that says more than a unit says what.
#[test]
fn suggestions_keep_prefixes() {
    for (text, wanted) in [
        ("kcal", "1e3*4.184*J"),
        ("Mcal", "1e6*4.184*J"),
        ("mrem", "1e-3*0.01*Sv"),
        ("kGauss", "1e3*1e-4*T"),
        ("kBtu", "1e3*1055.05585262*J"),
        ("MMBTU", "1e6*1055.05585262*J"),
        ("cStokes", "mm^2/s"),
        ("µinch", "1e-6*in"),
        ("mtorr", "1e-3*Torr"),
        ("kton", "kt"),
        ("cmHg", "10*mmHg"),
        ("mH2O", "1e3*mmH2O"),
        ("ftH2O", "12*inH2O"),
        ("nmile", "1852*m"),
        ("dpm", "1/min"),
        ("U/min", "rpm"),
        ("mbarg", "mbar"),
        ("atü", "98.0665*kPa"),
        ("mVpp", "mV"),
        ("Nm3/h", "m^3/h"),
        ("dB(A)", "dB"),
        ("sccm", "cm^3/min"),
        ("W/mK", "W/(m*K)"),
        ("kW/(mK)", "kW/(m*K)"),
    ] {
        let error = Unit::parse(text).expect_err(text).in_whole(text);
        assert_eq!(error.suggestions().first(), Some(&wanted), "{text}: {error}");
        assert!(Unit::parse(wanted).is_ok(), "{wanted}");
    }
    let own = Unit::defined("sccm", &Unit::parse("cm^3/min").unwrap()).unwrap();
    assert!(Unit::parse_among("sccm", &[own]).is_ok());
    assert!(Unit::parse("dBu").expect_err("no reference").suggestions().is_empty());
    let error = Unit::parse("Vpp").expect_err("no unit").to_string();
    assert!(error.contains("a peak-to-peak value") && error.contains("`V`"), "{error}");
    for text in ["mJ/mK", "V/mK", "W/mK^2", "dB", "nm^3", "N*m^3"] {
        assert!(Unit::parse(text).is_ok(), "{text}");
    }
}

#[test]
fn every_suggestion_parses() {
    let words = super::suggest::words();
    assert!(words.len() > 100);
    for (wrong, right) in words {
        let error = Unit::parse(wrong).expect_err(wrong);
        assert!(matches!(
            error,
            UnitError::UnknownUnit { .. } | UnitError::UnexpectedCharacter { .. }
        ));
        for text in *right {
            assert!(Unit::parse(text).is_ok(), "{text}");
        }
    }
}

/// A small generator, so that a failure can be repeated.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % n
    }
}

/// Whatever the text, the answer is a sound unit or a sound error.
fn check(text: &str) {
    match Unit::parse(text) {
        Ok(unit) => {
            assert!(unit.factor().is_normal() && unit.factor() > 0.0, "{text:?}");
            let one = unit.to_si(1.0) / unit.factor();
            assert!((one - 1.0).abs() < 1e-14, "{text:?}: {one}");
            assert_eq!(Unit::parse(text), Ok(unit));
        }
        Err(error) => {
            assert!(text.get(error.span()).is_some(), "{text:?}: {error:?}");
            assert!(!error.span().is_empty(), "{text:?}: {error:?}");
            assert!(!error.to_string().is_empty());
            for suggestion in error.suggestions() {
                assert!(Unit::parse(suggestion).is_ok(), "{text:?}: {suggestion}");
            }
        }
    }
}

#[test]
fn no_text_panics() {
    const PARTS: &[&str] = &[
        "m",
        "s",
        "kg",
        "mm",
        "Hz",
        "degC",
        "deg",
        "%",
        "ppm",
        "'",
        "''",
        "\"",
        "°",
        "µ",
        "Ω",
        "√",
        "sqrt",
        "(",
        "(",
        ")",
        ")",
        "*",
        "**",
        "/",
        "/",
        ".",
        "·",
        "^",
        "^",
        "-",
        "+",
        "−",
        "²",
        "³",
        "⁻",
        "¹",
        "0",
        "1",
        "2",
        "3",
        "10",
        "24",
        "300",
        "1e",
        "e-6",
        "E",
        "999999999999",
        " ",
        " ",
        "\t",
        "_",
        "k",
        "K",
        "meter",
        "sec",
        "\u{0}",
        "\u{301}",
        "🦀",
        "é",
        "İ",
        "ß",
        ",",
        "#",
        "g_n",
        "1/2",
        "mkg",
        "mdeg",
        "in",
        "lbf",
        "eV",
        "rev",
        "℃",
        "‰",
        "½",
        "１",
        "٣",
    ];
    let mut random = Random(20_240_501);
    for _ in 0..15_000 {
        let length = 1 + random.below(9);
        let text: String = (0..length).map(|_| PARTS[random.below(PARTS.len())]).collect();
        check(&text);
    }
    for _ in 0..5_000 {
        let length = random.below(12);
        let any = |r: &mut Random| {
            let limit = [0x80, 0x800, 0x3000, 0x11_0000][r.below(4)];
            char::from_u32(r.below(limit) as u32).unwrap_or('?')
        };
        let text: String = (0..length).map(|_| any(&mut random)).collect();
        check(&text);
    }
    for c in ('\0'..=char::MAX).step_by(97) {
        check(&format!("m{c}2"));
    }
    for (text, ..) in WRONG {
        check(text);
    }
}
