//! Differences of temperatures that a sheet states in °C: a difference counts from no zero, and is one in K.

use super::Budget;
use super::rows::Row;
use gumption_text::deviation_words::is_of_difference;
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
    is_symbol || is_called_difference(&row.about) || is_called_difference(&row.name)
}

/// Whether words call something a difference, and are none of a temperature that say one of it besides: `Air
/// temperature (max. deviation 1 K)`, `Bath temperature, corrected for the deviation of the sensor`.
fn is_called_difference(words: &str) -> bool {
    const DIFFERENCES: [&str; 4] = ["difference", "differenz", "différence", "diferencia"];
    let words = words.split(['(', '[', ',', ';']).next().unwrap_or_default().to_lowercase();
    let first = words.split_whitespace().next().unwrap_or_default();
    let is_of_temperature = first != words.trim()
        && ["temperature", "temperatur", "température", "temperatura"]
            .iter()
            .any(|of| words.contains(of));
    let is_said = DIFFERENCES.iter().any(|of| words.contains(of)) || is_of_difference(first);
    is_of_difference(&words) && (!is_of_temperature || is_said)
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
            ("c", "Correction of the air temperature"),
        ] {
            assert!(is_difference(&row(name, about)), "{name} {about}");
        }
        for (name, about) in [
            ("T", "Temperature"),
            ("td", "dew point"),
            ("dew", ""),
            ("t_d", ""),
            ("T", "Air temperature (max. deviation 1 K)"),
            ("t", "Bath temperature corrected for the deviation of the sensor"),
        ] {
            assert!(!is_difference(&row(name, about)), "{name} {about}");
        }
    }
}
