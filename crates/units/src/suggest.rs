//! Suggests units for a name that is not a unit.

use std::ops::Range;

use super::error::UnitError;
use super::names::{
    Flavour, PREFIXES, Prefix, Prefixed, SYMBOLS, Symbol, is_unit, prefix_spellings, prefixed,
    symbol,
};
use super::nearest;

/// The most suggestions given.
const MOST: usize = 3;

/// Minimum length of a name, and of the candidates, for a search for similar names.
const SHORTEST: usize = 3;

/// Names that are not units here, in lower case, and their probable meaning. The right-hand sides
/// are unit texts, most likely first; empty if no unit corresponds.
#[rustfmt::skip]
const SPELLED: &[(&str, &[&str])] = &[
    ("meter", &["m"]), ("metre", &["m"]), ("mtr", &["m"]),
    ("gram", &["g"]), ("gramme", &["g"]), ("gr", &["g", "64.79891*mg"]),
    ("grain", &["64.79891*mg"]), ("gm", &["g"]), ("kilo", &["kg"]),
    ("second", &["s"]), ("sec", &["s"]), ("minute", &["min"]), ("mins", &["min"]),
    ("hr", &["h"]),
    ("yr", &["year"]), ("wk", &["week"]), ("annum", &["year"]), ("yrs", &["year"]),
    ("ampere", &["A"]), ("amp", &["A"]), ("kelvin", &["K"]), ("mole", &["mol"]),
    ("candela", &["cd"]), ("radian", &["rad"]), ("steradian", &["sr"]),
    ("hertz", &["Hz"]), ("cps", &["Hz"]), ("newton", &["N"]), ("pascal", &["Pa"]),
    ("joule", &["J"]), ("watt", &["W"]), ("coulomb", &["C"]), ("volt", &["V"]),
    ("farad", &["F"]), ("ohms", &["ohm"]), ("siemens", &["S"]), ("mho", &["S"]),
    ("weber", &["Wb"]), ("tesla", &["T"]), ("gauss", &["1e-4*T"]), ("henry", &["H"]),
    ("lumen", &["lm"]), ("lux", &["lx"]), ("becquerel", &["Bq"]), ("gray", &["Gy"]),
    ("sievert", &["Sv"]), ("katal", &["kat"]),
    ("celsius", &["degC"]), ("centigrade", &["degC"]), ("fahrenheit", &["degF"]),
    ("ºf", &["degF"]), ("˚f", &["degF"]), ("°k", &["K"]), ("degk", &["K"]),
    ("degree", &["deg"]), ("degs", &["deg"]), ("º", &["deg"]), ("˚", &["deg"]), ("ºc", &["degC"]),
    ("˚c", &["degC"]), ("arcminute", &["arcmin"]), ("amin", &["arcmin"]),
    ("arcsecond", &["arcsec"]), ("asec", &["arcsec"]), ("mas", &["1e-3*arcsec"]),
    ("grad", &["deg", "gon"]),
    ("\"", &["arcsec", "in"]), ("”", &["arcsec", "in"]), ("“", &["arcsec", "in"]),
    ("’", &["arcmin"]), ("‘", &["arcmin"]), ("`", &["arcmin"]), ("´", &["arcmin"]),
    ("revolution", &["rev"]), ("cycle", &["rev"]), ("rps", &["rev/s"]),
    ("percent", &["%"]), ("pct", &["%"]), ("permille", &["‰"]),
    ("permil", &["‰"]), ("ppt", &["1e-12", "‰"]), ("decibel", &["dB"]),
    ("dig", &["digit"]), ("dgt", &["digit"]), ("cnt", &["count"]), ("cts", &["count"]),
    ("bit", &["LSB"]),
    ("liter", &["L"]), ("litre", &["L"]), ("ltr", &["L"]), ("cc", &["cm^3"]), ("ccm", &["cm^3"]),
    ("tonne", &["t"]), ("ton", &["t", "907.18474*kg"]), ("electronvolt", &["eV"]), ("dalton", &["Da"]),
    ("amu", &["u"]), ("carat", &["ct"]), ("hectare", &["ha"]), ("torr", &["Torr"]), ("atmosphere", &["atm"]),
    ("inch", &["in"]), ("inches", &["in"]), ("foot", &["ft"]), ("feet", &["ft"]),
    ("yard", &["0.9144*m"]), ("yd", &["0.9144*m"]), ("mile", &["mi"]), ("miles", &["mi"]),
    ("mil", &["1e-3*in", "mL"]), ("thou", &["1e-3*in"]), ("pound", &["lb"]), ("lbs", &["lb"]),
    ("floz", &["floz_us", "floz_imp"]), ("fl_oz", &["floz_us", "floz_imp"]), ("kips", &["kip"]),
    ("ounce", &["28.349523125*g"]), ("oz", &["28.349523125*g"]), ("dyn", &["1e-5*N"]),
    ("dyne", &["1e-5*N"]), ("erg", &["1e-7*J"]), ("cal", &["4.184*J"]),
    ("calorie", &["4.184*J"]), ("gal", &["Gal", "3.785411784*L"]),
    ("gallon", &["3.785411784*L"]), ("mph", &["1609.344*m/h"]), ("kph", &["km/h"]),
    ("kmh", &["km/h"]), ("mps", &["m/s"]), ("fps", &["ft/s"]), ("sqm", &["m^2"]),
    ("micron", &["um"]), ("angstrom", &["1e-10*m"]), ("å", &["1e-10*m"]),
    ("\u{212b}", &["1e-10*m"]), ("gee", &["g_n"]), ("gn", &["g_n"]), ("g0", &["g_n"]),
    ("gravity", &["g_n"]), ("lbm", &["lb"]), ("psia", &["psi"]),
    ("oc", &["degC"]), ("c°", &["degC"]), ("neper", &["Np"]),
    ("microstrain", &["um/m"]), ("ustrain", &["um/m"]), ("µε", &["um/m"]), ("με", &["um/m"]),
    ("strain", &["m/m"]), ("vdc", &["V"]), ("vac", &["V"]), ("vrms", &["V"]),
    ("rms", &[]), ("pp", &[]), ("rdg", &[]), ("reading", &[]), ("nan", &[]),
    ("cst", &["mm^2/s"]), ("centistokes", &["mm^2/s"]), ("nit", &["cd/m^2"]),
    ("poise", &["0.1*Pa*s"]), ("st", &["1e-4*m^2/s"]), ("stokes", &["1e-4*m^2/s"]),
    ("cpm", &["1/min"]), ("dpm", &["1/min"]), ("molar", &["mol/L"]),
    ("cp", &["mPa*s"]), ("centipoise", &["mPa*s"]), ("btu", &["1055.05585262*J"]),
    ("hp", &["745.69987158227022*W", "735.49875*W"]), ("horsepower", &["745.69987158227022*W", "735.49875*W"]),
    ("oe", &["79.577471545947668*A/m"]), ("oersted", &["79.577471545947668*A/m"]),
    ("ci", &["3.7e10*Bq"]), ("curie", &["3.7e10*Bq"]), ("rem", &["0.01*Sv"]),
    ("gpm", &["3.785411784*L/min"]), ("cfm", &["28.316846592*L/min"]), ("lpm", &["L/min"]),
    ("at", &["98.0665*kPa"]), ("bara", &["bar"]),
    ("cmhg", &["10*mmHg"]), ("cmh2o", &["10*mmH2O"]), ("mh2o", &["1e3*mmH2O"]), ("fth2o", &["12*inH2O"]),
    ("cstokes", &["mm^2/s"]), ("mmbtu", &["1e6*1055.05585262*J"]), ("nmi", &["1852*m"]),
    ("nmile", &["1852*m"]), ("dbu", &[]), ("upm", &["rpm"]), ("umdr", &["rev"]),
];

/// An abbreviation never means a prefix beyond these powers of ten.
const FARTHEST: i32 = 24;

/// Abbreviations in capitals that mean something else in small letters: molar, the unit of enzyme
/// activity, and full scale, for which there is no unit.
const ABBREVIATED: &[(&str, &[&str])] =
    &[("M", &["m", "mol/L"]), ("U", &["umol/min"]), ("FS", &[])];

/// Names that describe the quantity besides its unit, which a unit must not do (SI Brochure, 9th
/// edition, 5.4.2): the name, the unit, and the description. They take prefixes if the unit does.
#[rustfmt::skip]
const QUALIFIED: &[(&str, &str, &str)] = &[
    ("barg", "bar", GAUGE), ("psig", "psi", GAUGE), ("Pag", "Pa", GAUGE), ("atü", "98.0665*kPa", GAUGE),
    ("Vpp", "V", "a peak-to-peak value"), ("Vpk", "V", "a peak value"), ("App", "A", "a peak-to-peak value"),
    ("Nm3", "m^3", NORMAL), ("Nm³", "m^3", NORMAL), ("Nl", "L", NORMAL), ("Sm3", "m^3", STANDARD),
    ("Sm³", "m^3", STANDARD), ("sccm", "cm^3/min", STANDARD), ("slm", "L/min", STANDARD),
    ("slpm", "L/min", STANDARD), ("SLPM", "L/min", STANDARD), ("SCCM", "cm^3/min", STANDARD),
    ("scfm", "28.316846592*L/min", STANDARD), ("SCFM", "28.316846592*L/min", STANDARD),
    ("dBA", "dB", "an A-weighted level"), ("dBC", "dB", "a C-weighted level"),
    ("dBZ", "dB", "an unweighted level"), ("dB(A)", "dB", "an A-weighted level"),
    ("dB(C)", "dB", "a C-weighted level"), ("dB(Z)", "dB", "an unweighted level"),
];

const GAUGE: &str = "a pressure above the ambient one, which formulas of the pressure itself add";
const NORMAL: &str = "a volume of gas at 0 degC and 101.325 kPa";
const STANDARD: &str = "a volume of gas at standard conditions, of which there are several";

/// Products written without an operator, and the same with one. They take prefixes.
const JOINED: &[(&str, &str)] = &[
    ("As", "A*s"),
    ("Vs", "V*s"),
    ("Ws", "W*s"),
    ("Pas", "Pa*s"),
    ("Ncm", "N*cm"),
    ("Nmm", "N*mm"),
    // molar
    ("M", "mol/L"),
];

/// The error for a whole text whose parts are units, or look like units.
pub(super) fn whole(text: &str, span: Range<usize>) -> Option<UnitError> {
    // revolutions in German; alone, or in other quotients, U is the enzyme unit
    let rate = match text {
        "U/min" => "rpm",
        "U/s" => "rev/s",
        _ => return qualified(text, &span),
    };
    Some(UnitError::UnknownUnit { name: text.to_owned(), span, nearest: vec![rate.to_owned()] })
}

/// The error for a name that says more than a unit may.
fn qualified(name: &str, span: &Range<usize>) -> Option<UnitError> {
    let of = |name: &str| QUALIFIED.iter().find(|(wrong, ..)| *wrong == name);
    let prefixed = || {
        prefix_spellings().find_map(|(spelling, prefix)| {
            let (_, unit, says) = of(name.strip_prefix(spelling)?)?;
            takes_prefix(unit, prefix).then(|| (format!("{spelling}{unit}"), *says))
        })
    };
    let plain = of(name).map(|(_, unit, says)| ((*unit).to_owned(), *says));
    let (unit, says) = plain.or_else(prefixed)?;
    Some(UnitError::QualifiedUnit { name: name.to_owned(), span: span.clone(), unit, says })
}

/// The error for a name at `span` that is not a unit.
pub(super) fn unknown(name: &str, span: Range<usize>) -> UnitError {
    if let Some(error) = qualified(name, &span) {
        return error;
    }
    if let Some(nearest) = spelled_out(name) {
        return UnitError::UnknownUnit { name: name.to_owned(), span, nearest };
    }
    // `Min` and `MIN` are minutes in the wrong case, not a mega-inch.
    let unprefixed = spellings().any(|symbol| same_letters(symbol, name));
    if !unprefixed && let Some(error) = bare_unit_with_prefix(name, &span) {
        return error;
    }
    let nearest = wrong_case(name);
    if nearest.is_empty()
        && let Some(error) = two_prefixes(name, &span)
    {
        return error;
    }
    let mut nearest = nearest;
    for guess in [joined, similar] {
        if nearest.is_empty() {
            nearest = guess(name);
        }
    }
    UnitError::UnknownUnit { name: name.to_owned(), span, nearest }
}

/// Names in words, with plurals and prefixes; products without an operator; powers without `^`. An
/// empty list means that the name is known but no unit corresponds to it.
fn spelled_out(name: &str) -> Option<Vec<String>> {
    if let Some((_, right)) = ABBREVIATED.iter().find(|(wrong, _)| *wrong == name) {
        return Some(right.iter().map(|text| (*text).to_owned()).collect());
    }
    if let Some((_, right)) = JOINED.iter().find(|(wrong, _)| *wrong == name) {
        return Some(vec![(*right).to_owned()]);
    }
    let lower = name.to_lowercase();
    if let Some(right) = word(&lower) {
        return Some(right.iter().map(|text| (*text).to_owned()).collect());
    }
    for (spelling, prefix) in prefix_spellings() {
        if let Some(rest) = name.strip_prefix(spelling) {
            if let Some((_, right)) = JOINED.iter().find(|(wrong, _)| *wrong == rest) {
                return Some(vec![format!("{spelling}{right}")]);
            }
            if let Some(text) = word(&rest.to_lowercase()).and_then(|right| right.first())
                && rest.chars().count() > 2
                && let Some(text) = with_prefix(text, spelling, prefix)
            {
                return Some(vec![text]);
            }
        }
        if let Some(rest) = lower.strip_prefix(prefix.name())
            && let Some(text) = word(rest)
                .and_then(|right| right.first().copied())
                .or_else(|| spellings().find(|symbol| same_letters(symbol, rest)))
            && let Some(text) = with_prefix(text, spelling, prefix)
        {
            return Some(vec![text]);
        }
    }
    if name.starts_with('%') {
        return Some(vec!["%".to_owned()]);
    }
    if let Some(singular) = name.strip_suffix('s')
        && singular.chars().count() > 2
        && is_unit(singular)
    {
        return Some(vec![singular.to_owned()]);
    }
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let power = name.strip_prefix(stem).filter(|power| power.len() == 1 && *power != "0")?;
    is_unit(stem).then(|| vec![format!("{stem}^{power}")])
}

/// The meaning of a word in lower case, in the singular or the plural.
fn word(lower: &str) -> Option<&'static [&'static str]> {
    let find = |text: &str| SPELLED.iter().find(|(wrong, _)| *wrong == text).map(|(_, r)| *r);
    find(lower).or_else(|| lower.strip_suffix('s').and_then(find))
}

/// A unit text with a prefix, as a power of ten if the unit takes no prefix: `1e3*4.184*J` for
/// kcal. `None` for a prefix that nobody means, and for Celsius temperatures.
fn with_prefix(text: &str, spelling: &str, prefix: &Prefix) -> Option<String> {
    if takes_prefix(text, prefix) {
        return Some(format!("{spelling}{text}"));
    }
    let has_zero = symbol(text).is_some_and(|symbol| symbol.flavour != Flavour::Plain);
    let is_usual = (-12..=9).contains(&prefix.decimal());
    (is_usual && !has_zero).then(|| format!("1e{}*{text}", prefix.decimal()))
}

/// Whether a text is one symbol that takes the prefix.
fn takes_prefix(text: &str, prefix: &Prefix) -> bool {
    symbol(text).is_some_and(|symbol| symbol.takes(prefix))
}

/// Whether two names differ at most in case.
fn same_letters(a: &str, b: &str) -> bool {
    a.chars().flat_map(char::to_lowercase).eq(b.chars().flat_map(char::to_lowercase))
}

/// The error for a prefix before a unit that takes none.
fn bare_unit_with_prefix(name: &str, span: &Range<usize>) -> Option<UnitError> {
    let near = |found: &Prefixed<'_>| found.prefix.decimal().abs() <= FARTHEST;
    let found = prefixed(name).find(|found| !found.symbol.takes(found.prefix) && near(found))?;
    let instead = match found.symbol.flavour {
        Flavour::Celsius => format!("{}K", found.spelling),
        _ => format!("1e{}*{}", found.prefix.decimal(), found.unit),
    };
    Some(UnitError::PrefixNotAllowed {
        prefix: found.spelling.to_owned(),
        unit: found.unit.to_owned(),
        span: span.clone(),
        instead,
    })
}

/// The error for a prefix before a unit that already has one.
fn two_prefixes(name: &str, span: &Range<usize>) -> Option<UnitError> {
    let near = prefix_spellings().filter(|(_, outer)| outer.decimal().abs() <= FARTHEST);
    near.into_iter().find_map(|(spelling, outer)| {
        let unit = name.strip_prefix(spelling)?;
        let inner = prefixed(unit).find(|inner| inner.symbol.takes(inner.prefix))?;
        let decimal = outer.decimal() + inner.prefix.decimal();
        let instead = if decimal == 0 {
            inner.unit.to_owned()
        } else if let Some(one) = PREFIXES.iter().find(|prefix| prefix.decimal() == decimal) {
            format!("{}{}", one.symbol(), inner.unit)
        } else {
            format!("1e{decimal}*{}", inner.unit)
        };
        Some(UnitError::PrefixNotAllowed {
            prefix: spelling.to_owned(),
            unit: unit.to_owned(),
            span: span.clone(),
            instead,
        })
    })
}

/// Units that differ from the name only in case, those with the fewest differences first.
fn wrong_case(name: &str) -> Vec<String> {
    let mut found: Vec<(usize, String)> = every_name()
        .filter(|candidate| same_letters(candidate, name))
        .map(|candidate| {
            (candidate.chars().zip(name.chars()).filter(|(a, b)| a != b).count(), candidate)
        })
        .collect();
    found.sort_by_key(|(differences, _)| *differences);
    found.into_iter().take(MOST).map(|(_, candidate)| candidate).collect()
}

/// Every unit name that can be typed on any keyboard: symbols, then symbols with prefixes.
fn every_name() -> impl Iterator<Item = String> {
    let with_prefix = PREFIXES.iter().flat_map(|prefix| {
        SYMBOLS
            .iter()
            .filter(move |symbol| symbol.takes(prefix))
            .flat_map(Symbol::spellings)
            .map(move |symbol| format!("{}{symbol}", prefix.symbol()))
    });
    spellings().map(str::to_owned).chain(with_prefix).filter(|name| name.is_ascii())
}

/// Every spelling of every symbol.
fn spellings() -> impl Iterator<Item = &'static str> {
    SYMBOLS.iter().flat_map(Symbol::spellings)
}

/// The name as two units without an operator between them. Only common products are considered:
/// with prefixes in the middle, or rare ones in front, almost every abbreviation would match.
fn joined(name: &str) -> Vec<String> {
    let usual = |left: &str| {
        let seldom = |found: &Prefixed<'_>| !(-12..=9).contains(&found.prefix.decimal());
        symbol(left).is_some() || (is_unit(left) && !prefixed(left).any(|found| seldom(&found)))
    };
    name.char_indices()
        .skip(1)
        .filter_map(|(at, _)| name.split_at_checked(at))
        .filter(|(left, right)| usual(left) && symbol(right).is_some())
        .map(|(left, right)| format!("{left}*{right}"))
        .take(MOST)
        .collect()
}

/// Words and symbols of three letters or more that are one typing error away.
fn similar(name: &str) -> Vec<String> {
    if name.chars().count() < SHORTEST {
        return Vec::new();
    }
    let words = SPELLED.iter().filter(|(_, right)| !right.is_empty()).map(|(wrong, _)| *wrong);
    // for three letters the first one counts most: `HBW` is not a misspelt dBW, and `cpm` is not
    // rpm
    let is_short = name.chars().count() == SHORTEST;
    let first = |text: &str| text.chars().next().map(|c| c.to_lowercase().to_string());
    let known = words.chain(spellings()).filter(|known| {
        known.chars().count() >= SHORTEST && (!is_short || first(known) == first(name))
    });
    let mut found: Vec<String> = Vec::new();
    for near in nearest::all_nearest(name, known) {
        let right = word(near).and_then(|right| right.first()).copied().unwrap_or(near);
        if found.len() < MOST && !found.iter().any(|text| text == right) {
            found.push(right.to_owned());
        }
    }
    found
}

/// The table of spelled-out names.
#[cfg(test)]
pub(super) fn words() -> &'static [(&'static str, &'static [&'static str])] {
    SPELLED
}
