//! The unit that a line beside the table states for all of its values: `Budget (all values in mV)`, `alle
//! Werte in mV`.

use super::columns::{Column, Header, UNITS, unit_as_meant};
use super::grid::Cells;
use super::heading::may_be_unit;
use gumption_units::Unit;

/// What stands before the unit.
const BEFORE: [&str; 20] = [
    "values",
    "figures",
    "numbers",
    "quantities",
    "data",
    "entries",
    "all",
    "budget",
    "werte",
    "angaben",
    "größen",
    "grössen",
    "zahlenwerte",
    "zahlen",
    "messunsicherheitsbudget",
    "unsicherheitsbudget",
    "valeurs",
    "grandeurs",
    "valores",
    "bilan",
];

/// Words that may follow them.
const BETWEEN: [&str; 19] = [
    "are",
    "given",
    "stated",
    "expressed",
    "listed",
    "below",
    "here",
    "sind",
    "angegeben",
    "jeweils",
    "sont",
    "exprimées",
    "données",
    "indiquées",
    "están",
    "expresados",
    "dados",
    "the",
    "table",
];

/// What may stand behind the unit.
const BEHIND: [&str; 9] =
    ["unless", "except", "wenn", "sofern", "soweit", "außer", "sauf", "salvo", "excepto"];

/// A unit of all values, or the word in its place that is none; `None` where a text states none.
fn stated(text: &str) -> Option<Result<String, String>> {
    let clean = text.replace(['(', ')', '[', ']', ';', ','], " ");
    let words: Vec<&str> = clean.split_whitespace().collect();
    let small: Vec<String> = words.iter().map(|word| word.to_lowercase()).collect();
    let is_label = |at: usize| {
        let bare = small[at].strip_suffix(':');
        bare.is_some_and(|bare| UNITS.contains(&bare))
            || small.get(at + 1).is_some_and(|next| next == ":")
                && UNITS.contains(&small[at].as_str())
    };
    let of_label = (0..words.len())
        .find(|at| is_label(*at))
        .map(|at| if small[at].ends_with(':') { at + 1 } else { at + 2 });
    let is_in = |at: &usize| {
        let mut before = small[..*at].iter().rev();
        let is_noun = before.find(|word| !BETWEEN.contains(&word.as_str()));
        matches!(small[*at].as_str(), "in" | "en")
            && is_noun.is_some_and(|word| BEFORE.contains(&word.as_str()))
    };
    let of_values = || (1..words.len()).find(is_in).map(|at| at + 1);
    // `Budget of a length measurement in mm`
    let of_budget = || {
        let at = words.len().checked_sub(1)?;
        let is_unit = words[at].chars().count() > 1 && Unit::parse(words[at]).is_ok();
        let is_it = matches!(small.get(at.checked_sub(1)?)?.as_str(), "in" | "en")
            && small.iter().any(|word| word.contains("budget"));
        (is_unit && is_it).then_some(at)
    };
    let at = of_label.or_else(of_values).or_else(of_budget)?;
    let rest = words.get(at..).filter(|rest| !rest.is_empty())?;
    let end = rest.iter().position(|word| BEHIND.contains(&word.to_lowercase().as_str()));
    let rest = &rest[..end.unwrap_or(rest.len())];
    let parsed = |text: &str| {
        let known = Unit::parse(text).is_ok() && text.parse::<f64>().is_err();
        known.then(|| text.to_owned()).or_else(|| unit_as_meant(text))
    };
    let whole = rest.join(" ");
    let trimmed = |text: &str| text.trim_end_matches(['.', ':', '!']).to_owned();
    let first = trimmed(rest.first()?);
    if let Some(unit) = parsed(&trimmed(&whole)) {
        return Some(Ok(unit));
    }
    // `in the table below`, `in SI units` and `in A1 to A5` are no units, and `Unit: DMM 1` is an instrument
    let is_word = first.chars().all(char::is_lowercase);
    let is_doubtful = of_label.is_none() && rest.len() == 1 && !is_word;
    (is_doubtful && may_be_unit(&first)).then_some(Err(trimmed(&whole)))
}

impl Header {
    /// Takes the unit that a line above or below the table states for all values, for the columns that say
    /// none; refuses one that contradicts them.
    pub(super) fn unit_of_all(&mut self, cells: &Cells) {
        let is_beside = |line: usize| {
            let count = cells.row(line).iter().filter(|cell| !cell.trim().is_empty()).count();
            line < self.first || line > self.line && count == 1
        };
        let lines = (0..cells.lines()).filter(|line| is_beside(*line));
        let found = lines.flat_map(|line| {
            let row = cells.row(line);
            let pair = format!("{}: {}", cells.text(line, 0).trim(), cells.text(line, 1).trim());
            let is_pair = row.iter().filter(|cell| !cell.trim().is_empty()).count() == 2;
            let texts = row.iter().cloned().chain(is_pair.then_some(pair));
            texts
                .filter_map(|text| Some((text.trim().to_owned(), stated(&text)?)))
                .collect::<Vec<_>>()
        });
        let Some((text, unit)) = found.into_iter().next() else { return };
        let units = self.columns.iter().find(|(_, column)| *column == Column::Unit);
        let below = units.map_or_else(Vec::new, |(place, _)| {
            let lines = self.line + 1..cells.lines();
            lines.map(|line| cells.text(line, *place).trim().to_owned()).collect::<Vec<_>>()
        });
        let has_units = below.iter().any(|text| !super::rows::is_empty(text));
        let unit = match unit {
            Err(_) if has_units => return,
            Ok(unit) => unit,
            Err(word) => {
                self.doubtful.push(format!(
                    "`{text}`: `{word}` is no unit that is known: write the unit of all values alone, `all \
                     values in mV`, or a column `Unit`"
                ));
                return;
            }
        };
        let dimension = |unit: &str| Unit::parse(unit).ok().map(|unit| unit.dimension());
        let differs = |other: &str| other != unit && dimension(other) == dimension(&unit);
        let of_headings = self.units_of_columns().map(str::to_owned);
        let stated: Vec<String> = of_headings.chain(below.iter().cloned()).collect();
        if let Some(other) = stated.into_iter().find(|other| differs(other)) {
            self.doubtful.push(format!(
                "`{text}` says `{unit}`, and the table `{other}`: write the unit of each column into its \
                 heading, and take the line away"
            ));
            return;
        }
        if has_units {
            return;
        }
        let taken = self.take_unit_of_all(&unit);
        if taken {
            self.unit_of_all = Some((text, unit));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::stated;

    #[test]
    fn units_of_all_values() {
        for (text, unit) in [
            ("Budget (all values in mV)", "mV"),
            ("alle Werte in mV", "mV"),
            ("Messunsicherheitsbudget, alle Angaben in µm/m", "µm/m"),
            ("All values are given in mV unless otherwise stated.", "mV"),
            ("Toutes les valeurs sont exprimées en mm", "mm"),
            ("Todos los valores en mm", "mm"),
            ("Budget in mV", "mV"),
            ("Unsicherheitsbudget Längenmessung in mm", "mm"),
            ("Unit: mV", "mV"),
            ("Einheit : mm", "mm"),
        ] {
            assert_eq!(stated(text), Some(Ok(unit.to_owned())), "{text}");
        }
        for text in [
            "all in one budget",
            "all values in the table below",
            "Values of 2024",
            "Budget",
            "Werte in Klammern",
        ] {
            assert_eq!(stated(text), None, "{text}");
        }
        assert_eq!(stated("all values in mVrms"), Some(Err("mVrms".to_owned())));
    }
}
