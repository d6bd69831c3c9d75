//! The scores of a proficiency test in each format.

mod figure;
mod json;
mod words;

pub(super) use figure::figure;
pub(super) use json::json;
pub(super) use words::{explained, verdict};

use super::sheets::{has_name, score};
use crate::csv::{number, text};
use crate::number::{MISSING, exact, position, to, with_uncertainty};
use crate::plain;
use crate::sheet::Sheet;
use gumption_analysis::compare::ProficiencyTest;
use gumption_analysis::compare::proficiency::ParticipantScores;

/// Significant digits of the standard deviation to whose position results are printed, if they state
/// no uncertainty.
const DIGITS: u32 = 2;

/// z, z', zeta and En.
fn scores(row: &ParticipantScores) -> [Option<f64>; 4] {
    [row.z, row.z_prime, row.zeta, row.normalized_error]
}

/// One line for each participant, in full precision, below the names of the columns.
pub(super) fn records(test: &ProficiencyTest, unit: &str) -> Vec<Vec<String>> {
    let names = ["label", "value", "U", "k", "deviation", "z", "z_prime", "zeta", "en"];
    let names = names.into_iter().chain(["signal", "unit"]).map(str::to_owned).collect();
    let record = |row: &ParticipantScores| {
        let stated = row.participant.uncertainty;
        let numbers = [
            Some(row.participant.value),
            stated.map(|stated| stated.expanded),
            stated.map(|stated| stated.factor),
            Some(row.deviation),
        ];
        let mut record = vec![text(&row.participant.label)];
        record.extend(numbers.into_iter().chain(scores(row)).map(number));
        let signal = test.signal(row).map_or_else(String::new, |signal| signal.name().to_owned());
        record.extend([signal, text(unit)]);
        record
    };
    [names].into_iter().chain(test.rows.iter().map(record)).collect()
}

/// The scores as a table; a column that is not defined for any participant is left out.
pub(super) fn sheet(test: &ProficiencyTest, unit: &str) -> Sheet {
    let rows = &test.rows;
    let place = position(test.sigma, DIGITS);
    let printed = |value: f64| if test.sigma > 0.0 { to(value, place) } else { exact(value) };
    let stated = |row: &ParticipantScores| {
        let stated = row.participant.uncertainty?;
        Some(with_uncertainty(row.participant.value, stated.expanded, DIGITS))
    };
    let mut sheet = Sheet::default();
    sheet.text("participant", rows.iter().map(|row| plain(&row.participant.label)));
    let value = |row: &ParticipantScores| match stated(row) {
        Some((value, _)) => value,
        None => printed(row.participant.value),
    };
    sheet.numbers("x", rows.iter().map(value));
    if rows.iter().any(|row| row.participant.uncertainty.is_some()) {
        let expanded =
            |row: &ParticipantScores| stated(row).map_or_else(|| MISSING.to_owned(), |(_, u)| u);
        sheet.numbers("U(x)", rows.iter().map(expanded));
    }
    sheet.numbers("deviation", rows.iter().map(|row| printed(row.deviation)));
    if has_name(unit) {
        sheet.units("unit", rows.iter().map(|_| plain(unit)));
    }
    for (place, name) in ["z", "z'", "zeta", "En"].into_iter().enumerate() {
        let of = |row: &ParticipantScores| scores(row)[place];
        if rows.iter().any(|row| of(row).is_some()) {
            let cell = |row| of(row).map_or_else(|| MISSING.to_owned(), score);
            sheet.numbers(name, rows.iter().map(cell));
        }
    }
    let signal = |row| test.signal(row).map_or(MISSING, |signal| signal.name()).to_owned();
    sheet.text("by the score", rows.iter().map(signal));
    sheet
}
