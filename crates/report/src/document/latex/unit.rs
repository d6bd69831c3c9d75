//! Units as `siunitx` wants them: `\metre\per\second\squared` for `m/s^2`.

use std::collections::BTreeMap;

use super::text::escaped;
use crate::si;

/// The package's names beside those that all know.
const OWN: [(&str, &str); 3] =
    [("degC", "degreeCelsius"), ("°C", "degreeCelsius"), ("℃", "degreeCelsius")];

/// The units that a document declares because the package does not know them.
#[derive(Clone, Debug, Default)]
pub(super) struct Declared {
    /// Macro and what it prints.
    units: BTreeMap<String, String>,
}

impl Declared {
    /// The declarations, in order.
    pub(super) fn lines(&self) -> Vec<String> {
        let units = self.units.iter();
        units.map(|(name, text)| format!("\\DeclareSIUnit{{\\{name}}}{{{text}}}")).collect()
    }

    /// A unit; the number 1 stands as it is.
    pub(super) fn unit(&mut self, text: &str) -> String {
        let text = text.trim();
        if text == "1" {
            return text.to_owned();
        }
        let macros = self.product(text).unwrap_or_else(|| {
            // parentheses, roots, broken exponents: as it is written
            let name = format!("gumptionunit{}", letters(self.units.len()));
            let known = self.units.iter().find(|(_, t)| **t == boxed(text)).map(|(n, _)| n.clone());
            let name = known.unwrap_or(name);
            self.units.insert(name.clone(), boxed(text));
            format!("\\{name}")
        });
        format!("\\unit{{{macros}}}")
    }

    /// A product of powers; `None` where it is more than that.
    fn product(&mut self, text: &str) -> Option<String> {
        let mut out = String::new();
        let mut rest = text;
        let mut per = false;
        loop {
            rest = rest.trim_start();
            let end = rest.find(['*', '.', '·', '⋅', '×', '/', '^', ' ', '(', ')', '√']);
            let (name, behind) = rest.split_at(end.unwrap_or(rest.len()));
            let unit = self.factor(name)?;
            if per {
                out += "\\per";
            }
            out += &unit;
            rest = behind.trim_start();
            if let Some(power) = rest.strip_prefix('^') {
                let end = power.find(|c: char| !c.is_ascii_digit() && c != '-');
                let (power, behind) = power.split_at(end.unwrap_or(power.len()));
                match power.parse::<i8>().ok()? {
                    1 => {}
                    2 => out += "\\squared",
                    3 => out += "\\cubed",
                    power => out += &format!("\\tothe{{{power}}}"),
                }
                rest = behind.trim_start();
            }
            let Some(sign) = rest.chars().next() else {
                return Some(out);
            };
            per = sign == '/';
            if matches!(sign, '*' | '.' | '·' | '⋅' | '×' | '/') {
                rest = rest.get(sign.len_utf8()..)?;
            } else if !sign.is_alphabetic() {
                return None;
            }
        }
    }

    /// A unit with its prefix.
    fn factor(&mut self, name: &str) -> Option<String> {
        if let Some(macros) = si::macros(name, &OWN, &[]) {
            return Some(macros);
        }
        // a name of its own: ppm, psi, kgf
        if name.is_empty() || !name.chars().all(|c| c.is_ascii_alphabetic()) {
            return None;
        }
        let declared = format!("gumption{name}");
        self.units.insert(declared.clone(), name.to_owned());
        Some(format!("\\{declared}"))
    }
}

fn boxed(text: &str) -> String {
    format!("\\mbox{{{}}}", escaped(text))
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
        assert_eq!(unit("kg*m^-3"), r"\unit{\kilo\gram\metre\tothe{-3}}");
        assert_eq!(unit("mV/(m/s^2)"), r"\unit{\gumptionunita}");
        assert_eq!(unit("J/kg K"), r"\unit{\joule\per\kilo\gram\kelvin}");
        assert_eq!(unit("µm"), r"\unit{\micro\metre}");
        assert_eq!(unit("1"), "1");
        assert_eq!(unit("D/psi"), r"\unit{\gumptionD\per\gumptionpsi}");
        assert_eq!(unit("mV/(m/s^2)"), r"\unit{\gumptionunita}");
        assert_eq!(
            declared.lines(),
            [
                r"\DeclareSIUnit{\gumptionD}{D}",
                r"\DeclareSIUnit{\gumptionpsi}{psi}",
                r"\DeclareSIUnit{\gumptionunita}{\mbox{mV/(m/s$^{2}$)}}",
            ]
        );
    }
}
