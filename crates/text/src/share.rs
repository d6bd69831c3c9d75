//! Uncertainties in per cent, ppm and similar units: fractions of the value, or numbers in its
//! unit.

use gumption_units::Unit;

/// How to read an uncertainty in one unit for a value in another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Share {
    /// In its own unit, which is converted; per cent for a value in per cent.
    Own,
    /// A fraction of the value: per cent for a value in mV, mg/kg or degrees.
    OfValue,
    /// Ambiguous: per cent for a value in ppm or in the unit 1.
    Doubtful,
}

impl Share {
    /// Decides by the unit of the uncertainty and the unit of the value, if it has one.
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

/// Whether a fraction of this size, 1e-6 for ppm, equals a ratio of like units: ppm and `umol/mol`
/// or `uV/V`, and ppb with any of these.
pub(crate) fn counts_alike(share: f64, unit: &Unit) -> bool {
    let is_ratio = unit.dimension().is_none() && unit.turn().is_none() && unit.factor() != 1.0;
    let is_small = |size: f64| size <= 1.000_001e-6;
    is_ratio
        && ((unit.factor() / share - 1.0).abs() < 1e-9
            || is_small(share) && is_small(unit.factor()))
}

/// The two meanings of an uncertainty in a unit of fractions for a value in another such unit, or
/// in 1.
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
