//! Units in D-SI: `\metre\second\tothe{-2}` for `m/s^2`.

use gumption_units::{Factor, FactorBase, Unit, Zero};

use crate::number::exact;

/// A unit in D-SI; one that D-SI does not have follows a bar, in a text that is the same for every
/// spelling of the unit.
pub(crate) fn unit(unit: &Unit) -> String {
    of_the_si(unit).unwrap_or_else(|| format!("|{}", unit.normal_text()))
}

/// Whether D-SI has a unit.
pub(super) fn is_of_the_si(unit: &Unit) -> bool {
    of_the_si(unit).is_some()
}

fn of_the_si(unit: &Unit) -> Option<String> {
    match unit.factors() {
        [] => Some("\\one".to_owned()),
        factors => factors.iter().map(factor).collect(),
    }
}

/// A factor; `None` for factors that D-SI does not have: numbers, its own names of other units,
/// roots.
fn factor(factor: &Factor) -> Option<String> {
    let FactorBase::Named { prefix, symbol } = factor.base else { return None };
    let name = match (prefix.map(|prefix| prefix.macro_name()), symbol.dsi_name()?) {
        (None, name) => format!("\\{name}"),
        // the one unit whose name includes its prefix
        (Some(Some("kilo")), "gram") => "\\kilogram".to_owned(),
        (Some(prefix), name) => format!("\\{}\\{name}", prefix?),
    };
    match (factor.exponent.numerator(), factor.exponent.denominator()) {
        (1, 1) => Some(name),
        (power, 1) => Some(format!("{name}\\tothe{{{power}}}")),
        _ => None,
    }
}

/// The definition of a unit that D-SI does not have: its size in the SI, or the ratio of which a
/// level is the logarithm (IEC 60027-3).
pub(super) fn definition(unit: &Unit) -> String {
    // as written after the bar
    let text = unit.normal_text();
    let power = |over: &str| format!("{text} is the level 10 lg({over}) of a power P");
    let voltage = |over: &str| format!("{text} is the level 20 lg({over}) of a voltage U");
    match unit.zero() {
        Some(Zero::Milliwatt) => power("P/(1 mW)"),
        Some(Zero::Watt) => power("P/(1 W)"),
        Some(Zero::Volt) => voltage("U/(1 V)"),
        Some(Zero::Millivolt) => voltage("U/(1 mV)"),
        Some(Zero::Microvolt) => voltage("U/(1 uV)"),
        Some(Zero::FullScale) => {
            format!("{text} is the level 20 lg(x/x_FS) of a signal x above the full scale x_FS")
        }
        Some(Zero::Carrier) => {
            format!("{text} is the level 10 lg(P/P_c) of a power P above that of the carrier P_c")
        }
        Some(Zero::Isotropic) => {
            format!("{text} is the gain 10 lg(G) of an antenna above the isotropic one, G = 1")
        }
        // a level difference: one number for powers and for the corresponding field quantities
        _ if !unit.level_exponent().is_zero() && text == "dB" => {
            "dB is the level difference 10 lg(P1/P2) of powers, 20 lg(x1/x2) of field quantities"
                .to_owned()
        }
        // the one scale whose zero belongs to no unit of D-SI
        Some(Zero::Celsius) if unit.offset() != 0.0 => {
            format!("t in {text} is the temperature T with T/K = (t/{text} + 459.67)*5/9")
        }
        _ => {
            let dimension = unit.dimension();
            let size = exact(unit.factor());
            let levels = unit.level_exponent();
            let level = match (levels.numerator(), levels.denominator()) {
                (1, 1) => "dB".to_owned(),
                _ => format!("dB^{levels}"),
            };
            let si = match (dimension.is_none(), levels.is_zero()) {
                (true, true) => return format!("{text} = {size}"),
                (false, true) => dimension.to_string(),
                (true, false) => level,
                (false, false) => format!("{level} {dimension}"),
            };
            format!("{text} = {size} {si}")
        }
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
        assert_eq!(said("ppm/K"), r"\ppm\kelvin\tothe{-1}");
        assert_eq!(said("1"), r"\one");
        assert_eq!(said(""), r"\one");
        // the digit of a converter is not an SI unit
        assert_eq!(said("D/(m/s^2)"), "|D·s^2/m");
        assert_eq!(said("nV/Hz^(1/2)"), "|nV/Hz^(1/2)");
        assert_eq!(said("W/(m^2 lbf)"), "|W/(m^2·lbf)");
        assert_eq!(said("10^-6/K"), "|10^-6/K");
        assert_eq!(said("Qm"), "|Qm");
    }
    /// A level is the logarithm of a ratio, not a number of ones (IEC 60027-3).
    #[test]
    fn definitions_of_levels_and_others() {
        let said = |text: &str| definition(&Unit::parse(text).unwrap());
        assert_eq!(said("mbar"), "mbar = 100 kg m^-1 s^-2");
        assert_eq!(said("dBm"), "dBm is the level 10 lg(P/(1 mW)) of a power P");
        assert_eq!(said("dBuV"), "dBuV is the level 20 lg(U/(1 uV)) of a voltage U");
        assert!(said("dB").starts_with("dB is the level difference 10 lg(P1/P2)"));
        assert_eq!(said("dB/m"), "dB/m = 1 dB m^-1");
        assert_eq!(said("LSB"), "LSB = 1");
        assert_eq!(said("degF"), "t in degF is the temperature T with T/K = (t/degF + 459.67)*5/9");
    }
}
