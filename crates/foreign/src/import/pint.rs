//! Units in the words of Pint (the unit library of Python), `meter / second ** 2`, as unit symbols.

use gumption_units::Unit;

const PREFIXES: [(&str, &str); 20] = [
    ("yotta", "Y"),
    ("zetta", "Z"),
    ("exa", "E"),
    ("peta", "P"),
    ("tera", "T"),
    ("giga", "G"),
    ("mega", "M"),
    ("kilo", "k"),
    ("hecto", "h"),
    ("deca", "da"),
    ("deci", "d"),
    ("centi", "c"),
    ("milli", "m"),
    ("micro", "u"),
    ("nano", "n"),
    ("pico", "p"),
    ("femto", "f"),
    ("atto", "a"),
    ("zepto", "z"),
    ("yocto", "y"),
];

/// Words and their symbols; those of the second list take prefixes.
const PLAIN: [(&str, &str); 38] = [
    ("dimensionless", "1"),
    ("percent", "%"),
    ("permille", "‰"),
    ("ppm", "ppm"),
    ("ppb", "ppb"),
    ("degree_Celsius", "degC"),
    ("celsius", "degC"),
    ("degC", "degC"),
    ("delta_degree_Celsius", "K"),
    ("delta_degC", "K"),
    ("delta_celsius", "K"),
    ("degree_Fahrenheit", "degF"),
    ("fahrenheit", "degF"),
    ("degF", "degF"),
    ("degree", "deg"),
    ("arcminute", "arcmin"),
    ("arcsecond", "arcsec"),
    ("turn", "rev"),
    ("revolution", "rev"),
    ("revolutions_per_minute", "rpm"),
    ("minute", "min"),
    ("hour", "hour"),
    ("day", "day"),
    ("week", "week"),
    ("month", "month"),
    ("year", "year"),
    ("inch", "in"),
    ("foot", "ft"),
    ("pound", "lb"),
    ("force_pound", "lbf"),
    ("pound_force", "lbf"),
    ("pound_force_per_square_inch", "psi"),
    ("standard_atmosphere", "atm"),
    ("torr", "Torr"),
    ("inch_Hg", "inHg"),
    ("inch_H2O_39F", "inH2O"),
    ("decibel", "dB"),
    ("count", "1"),
];

const WITH_PREFIXES: [(&str, &str); 32] = [
    ("meter", "m"),
    ("metre", "m"),
    ("gram", "g"),
    ("second", "s"),
    ("ampere", "A"),
    ("kelvin", "K"),
    ("delta_kelvin", "K"),
    ("mole", "mol"),
    ("candela", "cd"),
    ("radian", "rad"),
    ("steradian", "sr"),
    ("hertz", "Hz"),
    ("newton", "N"),
    ("pascal", "Pa"),
    ("joule", "J"),
    ("watt", "W"),
    ("coulomb", "C"),
    ("volt", "V"),
    ("farad", "F"),
    ("ohm", "ohm"),
    ("siemens", "S"),
    ("weber", "Wb"),
    ("tesla", "T"),
    ("henry", "H"),
    ("lumen", "lm"),
    ("lux", "lx"),
    ("becquerel", "Bq"),
    ("gray", "Gy"),
    ("liter", "L"),
    ("litre", "L"),
    ("bar", "bar"),
    ("electron_volt", "eV"),
];

/// The symbol of one word.
fn symbol(word: &str) -> Option<String> {
    let of = |list: &[(&str, &str)], word: &str| {
        let found = list.iter().find(|(name, _)| *name == word || word == format!("{name}s"));
        found.map(|(_, symbol)| (*symbol).to_owned())
    };
    if let Some(found) = of(&PLAIN, word).or_else(|| of(&WITH_PREFIXES, word)) {
        return Some(found);
    }
    let prefixed = PREFIXES.iter().find_map(|(name, prefix)| {
        of(&WITH_PREFIXES, word.strip_prefix(name)?).map(|symbol| format!("{prefix}{symbol}"))
    });
    // `degC` is degrees of temperature, `delta_degC` their difference, and so are symbols otherwise
    let plain = word.strip_prefix("delta_").unwrap_or(word);
    prefixed.or_else(|| Unit::parse(plain).ok().map(|_| plain.to_owned()))
}

/// A unit of Pint as one of ours.
pub(super) fn unit(text: &str) -> Option<String> {
    let text = text.trim();
    if matches!(text, "" | "1" | "dimensionless") {
        return Some("1".to_owned());
    }
    let (mut above, mut below): (Vec<String>, Vec<String>) = (Vec::new(), Vec::new());
    let spaced = text.replace("**", "^").replace('·', "*");
    for (number, part) in spaced.split('/').enumerate() {
        for factor in part.split('*') {
            let (word, power) = factor.split_once('^').unwrap_or((factor, "1"));
            let (word, power) = (word.trim(), power.trim());
            if word == "1" && number == 0 {
                continue;
            }
            let power: i32 = power.trim_end_matches(".0").parse().ok()?;
            let symbol = symbol(word)?;
            let (side, power) = if (number == 0) == (power > 0) {
                (&mut above, power)
            } else {
                (&mut below, power)
            };
            let size = power.unsigned_abs();
            side.push(if size == 1 { symbol } else { format!("{symbol}^{size}") });
        }
    }
    let numerator = if above.is_empty() { "1".to_owned() } else { above.join(" ") };
    let made = match below.as_slice() {
        [] => numerator,
        [one] => format!("{numerator}/{one}"),
        _ => format!("{numerator}/({})", below.join(" ")),
    };
    // what is written as a symbol is taken as it is
    let made = if Unit::parse(&made).is_ok() { made } else { text.to_owned() };
    Unit::parse(&made).is_ok().then_some(made)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_symbols() {
        for (pint, ours) in [
            ("meter / second ** 2", "m/s^2"),
            ("kilogram / meter ** 3", "kg/m^3"),
            ("millivolt", "mV"),
            ("microohm", "uohm"),
            ("joule / kelvin / kilogram", "J/(K kg)"),
            ("1 / kelvin", "1/K"),
            ("degree_Celsius", "degC"),
            ("delta_degree_Celsius", "K"),
            ("pound_force_per_square_inch", "psi"),
            ("percent", "%"),
            ("dimensionless", "1"),
            ("mV", "mV"),
            ("m/s^2", "m/s^2"),
            ("second ** -1", "1/s"),
            ("grams", "g"),
        ] {
            assert_eq!(unit(pint).as_deref(), Some(ours), "{pint}");
        }
        for unknown in
            ["furlong", "meter ** x", "meter /", "/", "smoot * meter", "a ** 99999999999"]
        {
            assert_eq!(unit(unknown), None, "{unknown}");
        }
        // every word stands for a unit
        let all = PLAIN.iter().chain(&WITH_PREFIXES);
        let wrong: Vec<_> = all.filter(|(_, symbol)| Unit::parse(symbol).is_err()).collect();
        assert!(wrong.is_empty(), "{wrong:?}");
    }
}
