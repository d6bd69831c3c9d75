//! Units with the symbols of the SI brochure: `µL` for `uL`, `Ω` for `ohm`, `°C` for `degC`, `°` for
//! `deg`.

use gumption_units::{Factor, FactorBase, Unit};

/// Symbols in letters of any keyboard, as in files, and those of the SI brochure.
const SYMBOLS: [(&str, &str); 7] = [
    ("ohm", "Ω"),
    ("deg", "°"),
    ("arcmin", "′"),
    ("arcsec", "″"),
    ("degC", "°C"),
    ("degF", "°F"),
    ("dBuV", "dB\u{b5}V"),
];

/// A unit in typographic notation: the same unit, written as in the file apart from its symbols.
pub(crate) fn with_symbols(unit: &Unit) -> Unit {
    let mut text = String::new();
    let mut rest = unit.text();
    while let Some(first) = rest.chars().next() {
        let is_letter = |letter: char| letter.is_alphabetic() || letter == '°';
        let end = rest.find(|letter| is_letter(letter) != is_letter(first)).unwrap_or(rest.len());
        let (run, behind) = rest.split_at(end);
        text += &factor_of(unit, run).map_or_else(|| run.to_owned(), symbol);
        rest = behind;
    }
    // a unit that the file defines is known only to the file
    Unit::parse(&text).unwrap_or_else(|_| unit.clone())
}

/// The factor with this symbol.
fn factor_of<'u>(unit: &'u Unit, letters: &str) -> Option<&'u Factor> {
    let name = letters.replace(['\u{b5}', '\u{3bc}'], "u");
    unit.factors().iter().find(|factor| factor.base.to_string() == name)
}

/// The symbol of a factor without its prefix.
fn symbol(factor: &Factor) -> String {
    let FactorBase::Named { prefix, symbol } = factor.base else {
        return factor.base.to_string();
    };
    let prefix = match prefix.map_or("", |prefix| prefix.symbol()) {
        "u" => "\u{b5}",
        other => other,
    };
    let known = SYMBOLS.iter().find(|(name, _)| *name == symbol.name());
    format!("{prefix}{}", known.map_or(symbol.name(), |(_, printed)| printed))
}

/// A unit's text in typographic notation; a text that is not a unit is unchanged.
pub(crate) fn unit_text(text: &str) -> String {
    Unit::parse(text).map_or_else(|_| text.to_owned(), |unit| with_symbols(&unit).text().to_owned())
}

/// A value as in files, `20 degC`, with its unit in typographic notation.
pub(crate) fn value_text(value: &str) -> String {
    match value.trim().split_once(' ') {
        Some((number, unit)) if number.parse::<f64>().is_ok() => {
            format!("{number} {}", unit_text(unit.trim()))
        }
        _ => value.to_owned(),
    }
}

/// A formula with the units of its literals, `20 [degC]`, in typographic notation.
pub(crate) fn formula_text(formula: &str) -> String {
    let mut parts = formula.split('[');
    let mut made = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        made.push('[');
        match part.split_once(']') {
            Some((unit, behind)) => made += &format!("{}]{behind}", unit_text(unit)),
            None => made += part,
        }
    }
    made
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_are_those_of_the_si_brochure() {
        let cases = [
            ("uL", "µL"),
            ("uohm", "µΩ"),
            ("ohm*m", "Ω*m"),
            ("ohm/degC", "Ω/°C"),
            ("degC", "°C"),
            ("dBuV", "dB\u{b5}V"),
            ("uV/V", "µV/V"),
            ("µohm", "µΩ"),
            ("kΩ", "kΩ"),
            ("nV/Hz^(1/2)", "nV/Hz^(1/2)"),
            ("umol mol^-1", "µmol mol^-1"),
            // the unified atomic mass unit is not a prefix
            ("u", "u"),
            ("deg", "°"),
            ("deg/s", "°/s"),
            ("urad", "µrad"),
            ("1", "1"),
            ("", ""),
        ];
        for (text, wanted) in cases {
            let unit = Unit::parse(text).unwrap();
            let shown = with_symbols(&unit);
            assert_eq!(shown.text(), wanted, "{text}");
            assert_eq!(shown.factors(), unit.factors(), "{text}");
        }
        assert_eq!(value_text("20 degC"), "20 °C");
        assert_eq!(value_text("20"), "20");
        assert_eq!(value_text("upper end"), "upper end");
        assert_eq!(formula_text("R*(1 + a*(t - 23 [degC]))"), "R*(1 + a*(t - 23 [°C]))");
        assert_eq!(formula_text("x[0] + 1 [nothing"), "x[0] + 1 [nothing");
    }
}
