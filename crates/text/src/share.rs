//! Uncertainties in per cent, ppm and the like beside a value: shares of it, or numbers in its unit.

use gumption_units::Unit;

/// What an uncertainty in some unit is beside a value in another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Share {
    /// In a unit of its own, which is converted; per cent beside per cent.
    Own,
    /// A share of the value: per cent of a value in mV, in mg/kg or in degrees.
    OfValue,
    /// Either of them: per cent beside ppm, or beside a value in the unit 1.
    Doubtful,
}

impl Share {
    /// By the unit of the uncertainty and that of the value, which may have none.
    pub fn of(uncertainty: &Unit, value: Option<&Unit>) -> Self {
        if !uncertainty.is_relative() {
            return Self::Own;
        }
        match value {
            Some(value) if value.is_relative() && value.factor() == uncertainty.factor() => {
                Self::Own
            }
            Some(value) if value.is_relative() || value.text().trim() == "1" => Self::Doubtful,
            Some(value) if counts_alike(uncertainty.factor(), value) => Self::Doubtful,
            _ => Self::OfValue,
        }
    }
}

/// Whether a share of this size, 1e-6 for ppm, counts as a ratio of like units does: ppm beside
/// `umol/mol` or `uV/V`, and ppb beside them.
pub(crate) fn counts_alike(share: f64, unit: &Unit) -> bool {
    let is_ratio = unit.dimension().is_none() && unit.turn().is_none() && unit.factor() != 1.0;
    let is_small = |size: f64| size <= 1.000_001e-6;
    is_ratio
        && ((unit.factor() / share - 1.0).abs() < 1e-9
            || is_small(share) && is_small(unit.factor()))
}

/// The two meanings of an uncertainty in a unit of shares beside a value in another one, or in 1.
pub fn two_meanings(uncertainty: &str, value: &str) -> String {
    format!(
        "an uncertainty in `{uncertainty}` of a value in `{value}` can be a share of the value, or be \
         counted as the value is: write it in `{value}`"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_beside_values() {
        for (uncertainty, value, expected) in [
            ("%", "mV", Share::OfValue),
            ("%", "mg/kg", Share::OfValue),
            ("ppm", "um/m", Share::Doubtful),
            ("ppm", "umol/mol", Share::Doubtful),
            ("ppb", "uV/V", Share::Doubtful),
            ("%", "cg/g", Share::Doubtful),
            ("ppm", "mV/V", Share::OfValue),
            ("ppm", "urad", Share::OfValue),
            ("%", "deg", Share::OfValue),
            ("%", "%", Share::Own),
            ("ppm", "%", Share::Doubtful),
            ("%", "ppm", Share::Doubtful),
            ("%", "1", Share::Doubtful),
            ("mg/kg", "%", Share::Own),
            ("mV", "V", Share::Own),
        ] {
            let [u, x] = [uncertainty, value].map(|text| Unit::parse(text).unwrap());
            assert_eq!(Share::of(&u, Some(&x)), expected, "{uncertainty} {value}");
        }
        assert_eq!(Share::of(&Unit::parse("%").unwrap(), None), Share::OfValue);
    }
}
