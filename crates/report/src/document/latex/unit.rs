//! Units in the syntax of `siunitx`: `\metre\per\second\squared` for `m/s^2`.

use std::collections::BTreeMap;

use gumption_units::{Factor, FactorBase, Unit};

use super::text::escaped;

/// The units that a document declares because the package does not know them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Declared {
    /// Macro and what it prints.
    units: BTreeMap<String, String>,
}

impl Declared {
    /// The declarations, in order.
    pub(crate) fn lines(&self) -> Vec<String> {
        let units = self.units.iter();
        units.map(|(name, text)| format!("\\DeclareSIUnit{{\\{name}}}{{{text}}}")).collect()
    }

    /// A unit; the number 1 is printed as it is, and so is a text that is not a unit.
    pub(crate) fn unit(&mut self, text: &str) -> String {
        let macros = match Unit::parse(text) {
            Ok(unit) if unit.factors().is_empty() => return "1".to_owned(),
            Ok(unit) => unit.factors().iter().map(|factor| self.factor(factor)).collect(),
            Err(_) => self.declared(text.trim()),
        };
        format!("\\unit{{{macros}}}")
    }

    /// A factor. A root keeps its sign in the exponent, because the package does not calculate with
    /// fractions behind `\per`.
    fn factor(&mut self, factor: &Factor) -> String {
        let base = self.base(&factor.base);
        let (power, denominator) = (factor.exponent.numerator(), factor.exponent.denominator());
        if denominator != 1 {
            return format!("{base}\\tothe{{{power}/{denominator}}}");
        }
        let per = if power < 0 { "\\per" } else { "" };
        let power = match power.unsigned_abs() {
            1 => String::new(),
            2 => "\\squared".to_owned(),
            3 => "\\cubed".to_owned(),
            power => format!("\\tothe{{{power}}}"),
        };
        format!("{per}{base}{power}")
    }

    /// A unit with its prefix, or a number.
    fn base(&mut self, base: &FactorBase) -> String {
        let FactorBase::Named { prefix, symbol } = base else {
            return self.declared(&base.to_string());
        };
        let unit = |declared: &mut Self| match symbol.siunitx_name() {
            Some(name) => format!("\\{name}"),
            None => declared.declared(symbol.name()),
        };
        match prefix.map(|prefix| prefix.macro_name()) {
            None => unit(self),
            Some(Some(prefix)) => format!("\\{prefix}{}", unit(self)),
            Some(None) => self.declared(&base.to_string()),
        }
    }

    /// The macro for a text that the package does not know: made of its letters, or numbered.
    fn declared(&mut self, text: &str) -> String {
        let (name, printed) = if text.chars().all(|c| c.is_ascii_alphabetic()) {
            // the one for which the package has no symbol
            let printed = if text == "degF" { "\\textdegree F" } else { text };
            (format!("gumption{text}"), printed.to_owned())
        } else {
            let printed = format!("\\mbox{{{}}}", escaped(text));
            let known = self.units.iter().find(|(_, t)| **t == printed).map(|(n, _)| n.clone());
            let counted = || format!("gumptionunit{}", letters(self.units.len()));
            (known.unwrap_or_else(counted), printed)
        };
        self.units.insert(name.clone(), printed);
        format!("\\{name}")
    }
}

/// A number in letters, because a macro has no digits.
fn letters(number: usize) -> String {
    number.to_string().bytes().map(|digit| char::from(digit - b'0' + b'a')).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_become_macros() {
        let mut declared = Declared::default();
        let mut unit = |text: &str| declared.unit(text);
        assert_eq!(unit("m/s^2"), r"\unit{\metre\per\second\squared}");
        assert_eq!(unit("kg*m^-3"), r"\unit{\kilo\gram\per\metre\cubed}");
        assert_eq!(unit("mV/(m/s^2)"), r"\unit{\milli\volt\per\metre\second\squared}");
        assert_eq!(unit("J/kg*K"), r"\unit{\joule\per\kilo\gram\kelvin}");
        assert_eq!(unit("µm"), r"\unit{\micro\metre}");
        assert_eq!(unit("1"), "1");
        assert_eq!(unit("1/K"), r"\unit{\per\kelvin}");
        assert_eq!(unit("°C"), r"\unit{\degreeCelsius}");
        assert_eq!(unit("D/psi"), r"\unit{\gumptionD\per\gumptionpsi}");
        assert_eq!(unit("mbar"), r"\unit{\milli\gumptionbar}");
        assert_eq!(unit("Qm"), r"\unit{\gumptionQm}");
        assert_eq!(unit("nV/√Hz"), r"\unit{\nano\volt\hertz\tothe{-1/2}}");
        assert_eq!(unit("1e-6/K"), r"\unit{\per\gumptionunite\tothe{6}\per\kelvin}");
        assert_eq!(unit("10^-6"), r"\unit{\per\gumptionunite\tothe{6}}");
        assert_eq!(unit("several units"), r"\unit{\gumptionunitf}");
        assert_eq!(unit("degF"), r"\unit{\gumptiondegF}");
        assert_eq!(
            declared.lines(),
            [
                r"\DeclareSIUnit{\gumptionD}{D}",
                r"\DeclareSIUnit{\gumptionQm}{Qm}",
                r"\DeclareSIUnit{\gumptionbar}{bar}",
                r"\DeclareSIUnit{\gumptiondegF}{\textdegree F}",
                r"\DeclareSIUnit{\gumptionpsi}{psi}",
                r"\DeclareSIUnit{\gumptionunite}{\mbox{10}}",
                r"\DeclareSIUnit{\gumptionunitf}{\mbox{several units}}",
            ]
        );
    }
}
