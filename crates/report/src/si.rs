//! The names of SI units and prefixes that typesetters (`siunitx`) and data formats (D-SI) share: a
//! unit is written as a macro of its name after one of its prefix.

/// Units by the symbol that files write.
pub(super) const UNITS: [(&str, &str); 44] = [
    ("m", "metre"),
    ("g", "gram"),
    ("s", "second"),
    ("A", "ampere"),
    ("K", "kelvin"),
    ("mol", "mole"),
    ("cd", "candela"),
    ("rad", "radian"),
    ("sr", "steradian"),
    ("Hz", "hertz"),
    ("N", "newton"),
    ("Pa", "pascal"),
    ("J", "joule"),
    ("W", "watt"),
    ("C", "coulomb"),
    ("V", "volt"),
    ("F", "farad"),
    ("ohm", "ohm"),
    ("Ω", "ohm"),
    ("\u{2126}", "ohm"),
    ("S", "siemens"),
    ("Wb", "weber"),
    ("T", "tesla"),
    ("H", "henry"),
    ("lm", "lumen"),
    ("lx", "lux"),
    ("Bq", "becquerel"),
    ("Gy", "gray"),
    ("Sv", "sievert"),
    ("kat", "katal"),
    ("L", "litre"),
    ("l", "litre"),
    ("t", "tonne"),
    ("eV", "electronvolt"),
    ("Da", "dalton"),
    ("min", "minute"),
    ("h", "hour"),
    ("d", "day"),
    ("ha", "hectare"),
    ("deg", "degree"),
    ("°", "degree"),
    ("arcmin", "arcminute"),
    ("arcsec", "arcsecond"),
    ("%", "percent"),
];

/// Prefixes; of those that begin alike the longer one comes first.
pub(super) const PREFIXES: [(&str, &str); 22] = [
    ("da", "deca"),
    ("m", "milli"),
    ("k", "kilo"),
    ("u", "micro"),
    ("\u{b5}", "micro"),
    ("\u{3bc}", "micro"),
    ("M", "mega"),
    ("n", "nano"),
    ("c", "centi"),
    ("h", "hecto"),
    ("d", "deci"),
    ("G", "giga"),
    ("p", "pico"),
    ("T", "tera"),
    ("f", "femto"),
    ("P", "peta"),
    ("E", "exa"),
    ("Z", "zetta"),
    ("Y", "yotta"),
    ("a", "atto"),
    ("z", "zepto"),
    ("y", "yocto"),
];

/// A unit with its prefix in macros. `own` are names beside the shared ones, `bare` are symbols that
/// take no prefix.
pub(super) fn macros(name: &str, own: &[(&str, &str)], bare: &[&str]) -> Option<String> {
    let known = |name: &str| {
        let found = own.iter().chain(&UNITS).find(|(symbol, _)| *symbol == name);
        found.map(|(_, unit)| *unit)
    };
    if let Some(unit) = known(name) {
        return Some(format!("\\{unit}"));
    }
    PREFIXES.iter().find_map(|(symbol, prefix)| {
        let rest = name.strip_prefix(symbol).filter(|rest| !bare.contains(rest))?;
        Some(format!("\\{prefix}\\{}", known(rest)?))
    })
}
