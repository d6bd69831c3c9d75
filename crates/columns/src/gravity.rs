//! The letter `g` for the standard acceleration of free fall: makers of accelerometers write `g`
//! for the unit `g_n`, but `g` is the gram.

use gumption_units::{Dimension, Unit};

/// The unit of a text if its `g` means `g_n`, such as `mV/g_n` for `mV/g`; `None` if that unit does
/// not have the dimension `wanted`.
pub fn meant(text: &str, wanted: Dimension) -> Option<Unit> {
    let mut written = String::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let is_letter = |c: char| c.is_alphabetic() || c == '_';
        let end = rest.find(|c| is_letter(c) != is_letter(first)).unwrap_or(rest.len());
        let (word, behind) = rest.split_at(end);
        written.push_str(word);
        // `kg` hardly ever means a thousand times `g_n`
        let gram = word.ends_with('g') && word != "kg";
        if gram && Unit::parse(&format!("{word}_n")).is_ok() {
            written.push_str("_n");
        }
        rest = behind;
    }
    let unit = Unit::parse(&written).ok().filter(|_| written != text)?;
    (unit.dimension() == wanted).then_some(unit)
}

/// A hint for a unit that does not have the dimension `wanted`, to follow the error message; empty
/// if no `g` is the cause.
pub fn hint(text: &str, wanted: Dimension) -> String {
    meant(text, wanted).map_or(String::new(), |unit| {
        format!("; `g` is the gram, and standard gravity is `g_n`: write `{unit}` if that is meant")
    })
}

/// The same for two units that should have the same dimension: either may contain the `g`.
pub fn hint_of(text: &str, other: &str) -> String {
    let of = |text: &str, other: &str| {
        Unit::parse(other).map_or(String::new(), |other| hint(text, other.dimension()))
    };
    let first = of(text, other);
    if first.is_empty() { of(other, text) } else { first }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ISO 80000-3: the standard acceleration of free fall is 9.806 65 m/s^2 exactly.
    #[test]
    fn a_letter_g_among_accelerations() {
        let dimension = |text: &str| Unit::parse(text).expect("a unit").dimension();
        for (text, wanted, expected, factor) in [
            ("g", "m/s^2", "g_n", 9.80665),
            ("mg", "m/s^2", "mg_n", 9.80665e-3),
            ("mV/g", "V/(m/s^2)", "mV/g_n", 1e-3 / 9.80665),
            ("µg/√Hz", "m/s^2/√Hz", "µg_n/√Hz", 9.80665e-6),
        ] {
            let unit = meant(text, dimension(wanted)).expect(text);
            assert_eq!(unit.text(), expected);
            assert!((unit.factor() / factor - 1.0).abs() < 1e-15, "{text}");
        }
        for (text, wanted) in [("g", "kg"), ("g_n", "m/s^2"), ("kg", "m/s^2"), ("deg", "m/s^2")] {
            assert_eq!(meant(text, dimension(wanted)), None, "{text}");
        }
    }
}
