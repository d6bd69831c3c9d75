//! Differences of temperatures that a sheet states in °C: a difference counts from no zero, and is one in K.

use super::Budget;
use super::rows::Row;
use crate::dcc::is_of_difference;
use gumption_units::Unit;

/// Whether the name or the words of a row are those of a difference of temperatures: `dT`, `Δϑ`,
/// `Temperature difference`.
fn is_difference(row: &Row) -> bool {
    const SIGNS: [&str; 8] = ["delta_", "delta", "Delta_", "Delta", "d_", "d", "Δ", "δ"];
    const TEMPERATURES: [&str; 11] =
        ["T", "t", "ϑ", "θ", "Θ", "theta", "Theta", "vartheta", "temp", "Temp", "tau"];
    let behind = SIGNS.iter().filter_map(|sign| row.name.strip_prefix(sign));
    let is_symbol = behind.into_iter().any(|rest| {
        TEMPERATURES.iter().any(|of| {
            let index = rest.strip_prefix(of);
            index.is_some_and(|index| !index.starts_with(|c: char| c.is_alphabetic()))
        })
    });
    is_symbol || is_of_difference(&row.about) || is_of_difference(&row.name)
}

impl Budget<'_> {
    /// Takes quantities in °C that are differences by their names to be in K, and says so.
    pub(super) fn differences_in_kelvin(&mut self, rows: &mut [Row]) {
        for row in rows {
            let is_celsius =
                Unit::parse(&row.unit).is_ok_and(|unit| unit.is_celsius() && unit.factor() == 1.0);
            if is_celsius && is_difference(row) {
                self.guessed.push(format!(
                    "line {}: `{}` in {} is a difference of temperatures by its name, and taken in K",
                    row.line + 1,
                    row.name,
                    row.unit
                ));
                row.unit = "K".to_owned();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_differences() {
        let row = |name: &str, about: &str| Row {
            name: name.to_owned(),
            about: about.to_owned(),
            ..Row::default()
        };
        for (name, about) in [
            ("dT", ""),
            ("Δt_1", ""),
            ("delta_theta", ""),
            ("x_1", "Temperature difference"),
            ("c", "Korrektion des Thermometers"),
        ] {
            assert!(is_difference(&row(name, about)), "{name} {about}");
        }
        for (name, about) in [("T", "Temperature"), ("td", "dew point"), ("dew", ""), ("t_d", "")] {
            assert!(!is_difference(&row(name, about)), "{name} {about}");
        }
    }
}
