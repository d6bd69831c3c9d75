//! Units as D-SI writes them: `\metre\second\tothe{-2}`.

use super::Unit;
use super::names::{PREFIXES, SYMBOLS};

impl Unit {
    /// Parses a unit of D-SI: names with prefixes and exponents, each after a backslash; or, after
    /// a bar, a text in the syntax of [`Unit::parse`]; or a text without a backslash in that
    /// syntax. Names are accepted in any case, because certificates have `\degreeCelsius` and
    /// `\degreecelsius`.
    ///
    /// ```
    /// use gumption_units::Unit;
    ///
    /// let unit = Unit::parse_dsi(r"\milli\volt\second\tothe{-2}").expect("a unit of D-SI");
    /// assert_eq!(unit, Unit::parse("mV*s^-2").unwrap());
    /// assert!(Unit::parse_dsi(r"\furlong").is_none());
    /// ```
    ///
    /// `None` for anything else.
    pub fn parse_dsi(text: &str) -> Option<Self> {
        let text = text.trim();
        if let Some(ours) = text.strip_prefix('|') {
            return Self::parse(ours).ok();
        }
        let Some(names) = text.strip_prefix('\\') else { return Self::parse(text).ok() };
        let mut written = String::new();
        let (mut prefix, mut inverse) = (None, false);
        let mut names = names.split('\\').map(str::trim).peekable();
        while let Some(name) = names.next() {
            let lower = name.to_lowercase();
            if lower == "per" {
                inverse = true;
                continue;
            }
            if prefix.is_none()
                && let Some(found) = PREFIXES.iter().find(|of| of.name() == lower)
            {
                prefix = Some(found.symbol());
                continue;
            }
            let symbol = match lower.as_str() {
                "one" => "1",
                "kilogram" => "kg",
                // editors have the decibel in their lists; D-SI itself has `\deci\bel`
                "decibel" if prefix.is_none() => "dB",
                "bel" if prefix == Some("d") => {
                    prefix = None;
                    "dB"
                }
                "bel" if prefix.is_none() => "10*dB",
                _ => {
                    let is_it = |of: &&super::names::Symbol| {
                        of.dsi_name().is_some_and(|dsi| dsi.eq_ignore_ascii_case(name))
                            || of.name() == name
                            || of.name().len() > 1 && of.name().eq_ignore_ascii_case(name)
                    };
                    SYMBOLS.iter().find(is_it)?.name()
                }
            };
            let power = names.next_if(|next| next.starts_with("tothe"));
            let power = match power {
                None => "1",
                Some(power) => power.strip_prefix("tothe{")?.strip_suffix('}')?.trim(),
            };
            let power = match power {
                "0.5" => "(1/2)".to_owned(),
                "-0.5" => "(-1/2)".to_owned(),
                whole => whole.parse::<i32>().ok()?.to_string(),
            };
            let power = match (inverse, power.strip_prefix('-')) {
                (false, _) => power,
                (true, Some(positive)) => positive.to_owned(),
                (true, None) => format!("-{power}"),
            };
            if !written.is_empty() {
                written.push('*');
            }
            written.push_str(prefix.take().unwrap_or_default());
            written.push_str(symbol);
            if power != "1" {
                written.push_str(&format!("^{power}"));
            }
            inverse = false;
        }
        if prefix.is_some() || inverse { None } else { Self::parse(&written).ok() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_of_certificates() {
        for (dsi, text) in [
            (r"\metre\second\tothe{-2}", "m/s^2"),
            (r"\kilogram\metre\tothe{2}\second\tothe{-3}\ampere\tothe{-2}", "kg m^2 s^-3 A^-2"),
            (r"\degreeCelsius", "degC"),
            (r"\degreecelsius\tothe{-1}", "degC^-1"),
            (r"\kilo\hertz", "kHz"),
            (r"\percent", "%"),
            (r"\metre\per\second", "m/s"),
            (r"\one", "1"),
            (r"\decibel", "dB"),
            (r"\deci\bel", "dB"),
            (r"\bel", "10*dB"),
            (r"\neper\metre\tothe{-1}", "Np/m"),
            (r"\mmHg", "mmHg"),
            (r"\volt\hertz\tothe{-0.5}", "V/Hz^(1/2)"),
            ("|D·s^2/m", "D*s^2/m"),
            ("mm", "mm"),
        ] {
            let found = Unit::parse_dsi(dsi).unwrap_or_else(|| panic!("{dsi}"));
            let expected = Unit::parse(text).unwrap();
            assert_eq!(found.dimension(), expected.dimension(), "{dsi}");
            assert_eq!(found.factor(), expected.factor(), "{dsi}");
            assert_eq!(found.zero(), expected.zero(), "{dsi}");
        }
        for none in [
            r"\furlong",
            r"\kilo",
            r"\kilo\bel",
            r"\milli\decibel",
            r"\metre\tothe{x}",
            r"\metre\per",
            "§unit§",
        ] {
            assert!(Unit::parse_dsi(none).is_none(), "{none}");
        }
    }
}
