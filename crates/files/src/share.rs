//! Uncertainties in per cent, ppm and the like beside a value: shares of it, or numbers in its unit.

use gumption_units::Unit;

/// What an uncertainty in some unit is beside a value in another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Share {
    /// In a unit of its own, which is converted; per cent beside per cent.
    Own,
    /// A share of the value: per cent of a value in mV, in mg/kg or in degrees.
    OfValue,
    /// Either of them: per cent beside ppm, or beside a value in the unit 1.
    Doubtful,
}

impl Share {
    /// By the unit of the uncertainty and that of the value, which may have none.
    pub(super) fn of(uncertainty: &Unit, value: Option<&Unit>) -> Self {
        if !uncertainty.is_relative() {
            return Self::Own;
        }
        match value {
            Some(value) if value.is_relative() && value.factor() == uncertainty.factor() => {
                Self::Own
            }
            Some(value) if value.is_relative() || value.text().trim() == "1" => Self::Doubtful,
            _ => Self::OfValue,
        }
    }
}

/// The two meanings of an uncertainty in a unit of shares beside a value in another one, or in 1.
pub(super) fn two_meanings(uncertainty: &str, value: &str) -> String {
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
            ("ppm", "um/m", Share::OfValue),
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
