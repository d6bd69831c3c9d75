//! Units as D-SI writes them: `\metre\second\tothe{-2}` for `m/s^2`.

use crate::si;
use gumption_units::Unit;

/// D-SI's names beside those that all know.
const OWN: [(&str, &str); 6] = [
    ("kg", "kilogram"),
    ("degC", "degreecelsius"),
    ("°C", "degreecelsius"),
    ("℃", "degreecelsius"),
    ("ppm", "ppm"),
    ("1", "one"),
];

/// Symbols that take no prefix.
const BARE: [&str; 4] = ["1", "%", "ppm", "kg"];

/// A unit as D-SI writes it; one that D-SI does not have stands behind a bar, as it is written.
pub(super) fn unit(unit: &Unit) -> String {
    of_the_si(unit.text()).unwrap_or_else(|| {
        let text: String = unit.text().split_whitespace().collect::<Vec<_>>().join("·");
        format!("|{text}")
    })
}

/// Whether D-SI has a unit.
pub(super) fn is_of_the_si(unit: &Unit) -> bool {
    of_the_si(unit.text()).is_some()
}

fn of_the_si(text: &str) -> Option<String> {
    let text = text.trim();
    if text.is_empty() {
        return Some("\\one".to_owned());
    }
    let mut reader = Reader { rest: text, factors: Vec::new() };
    reader.product(1)?;
    if !reader.rest.is_empty() {
        return None;
    }
    let mut factors = reader.factors;
    if factors.len() > 1 {
        factors.retain(|(name, _)| name != "\\one");
    }
    let written = factors.iter().map(|(name, power)| match power {
        1 => name.clone(),
        power => format!("{name}\\tothe{{{power}}}"),
    });
    Some(written.collect())
}

/// Reads products, quotients and whole powers of units.
struct Reader<'a> {
    rest: &'a str,
    factors: Vec<(String, i32)>,
}

impl Reader<'_> {
    /// Factors up to the end or a closing parenthesis, all to the power `sign` besides their own.
    fn product(&mut self, sign: i32) -> Option<()> {
        let mut side = sign;
        loop {
            self.skip();
            if let Some(rest) = self.rest.strip_prefix('(') {
                self.rest = rest;
                let from = self.factors.len();
                self.product(side)?;
                self.rest = self.rest.strip_prefix(')')?;
                let power = self.power()?;
                for (_, own) in self.factors.iter_mut().skip(from) {
                    *own = own.checked_mul(power)?;
                }
            } else {
                let name = self.name()?;
                let power = self.power()?.checked_mul(side)?;
                self.factors.push((name, power));
            }
            self.skip();
            let Some(next) = self.rest.chars().next() else { return Some(()) };
            match next {
                ')' => return Some(()),
                '/' => side = -sign,
                _ => side = sign,
            }
            if matches!(next, '/' | '*' | '.' | '·' | '⋅' | '×') {
                self.rest = self.rest.get(next.len_utf8()..)?;
            }
        }
    }

    fn skip(&mut self) {
        self.rest = self.rest.trim_start();
    }

    fn name(&mut self) -> Option<String> {
        let end = self.rest.find(['*', '.', '·', '⋅', '×', '/', '^', ' ', '(', ')']);
        let (name, behind) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        let found = si::macros(name, &OWN, &BARE)?;
        self.rest = behind;
        Some(found)
    }

    fn power(&mut self) -> Option<i32> {
        let Some(power) = self.rest.strip_prefix('^') else { return Some(1) };
        let end = power.find(|c: char| !c.is_ascii_digit() && c != '-').unwrap_or(power.len());
        let (power, behind) = power.split_at(end);
        self.rest = behind;
        power.parse().ok().filter(|power: &i32| power.abs() < 100)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_of_the_si_and_others() {
        let said = |text: &str| unit(&Unit::parse(text).unwrap());
        assert_eq!(said("m/s^2"), r"\metre\second\tothe{-2}");
        assert_eq!(said("kg*m^-3"), r"\kilogram\metre\tothe{-3}");
        assert_eq!(said("mg"), r"\milli\gram");
        assert_eq!(said("mV/(m/s^2)"), r"\milli\volt\metre\tothe{-1}\second\tothe{2}");
        assert_eq!(said("W/(m^2 K)"), r"\watt\metre\tothe{-2}\kelvin\tothe{-1}");
        assert_eq!(said("1/K"), r"\kelvin\tothe{-1}");
        assert_eq!(said("m/s/K"), r"\metre\second\tothe{-1}\kelvin\tothe{-1}");
        assert_eq!(said("µm"), r"\micro\metre");
        assert_eq!(said("degC"), r"\degreecelsius");
        assert_eq!(said("kHz"), r"\kilo\hertz");
        assert_eq!(said("%"), r"\percent");
        assert_eq!(said("1"), r"\one");
        assert_eq!(said(""), r"\one");
        // the digit of a converter is no unit of the SI
        assert_eq!(said("D/(m/s^2)"), "|D/(m/s^2)");
        assert_eq!(said("nV/Hz^(1/2)"), "|nV/Hz^(1/2)");
        assert_eq!(said("W/(m^2 lbf)"), "|W/(m^2·lbf)");
    }

    /// What stands in the text means the same unit: its factors multiply to the same dimension.
    #[test]
    fn names_belong_to_their_symbols() {
        for (symbol, name) in OWN.iter().chain(&si::UNITS) {
            let parsed = Unit::parse(symbol).unwrap();
            assert!(!name.is_empty() && parsed.factor() > 0.0, "{symbol}");
        }
        for (symbol, prefix) in si::PREFIXES {
            let parsed = Unit::parse(&format!("{symbol}m")).unwrap();
            let power = parsed.factor().log10();
            assert!((power - power.round()).abs() < 1e-9, "{prefix}");
        }
    }
}
