//! Budgets without an equation whose result is a difference: an error of indication is the indication less
//! the reference, and their sum means nothing.

use super::Budget;
use super::columns::{Column, Header};
use super::linear::{difference, standard_uncertainty};
use super::number::number_with_unit;
use super::rows::{Row, in_unit_of, is_near, without_factor};
use super::stated::half_digit;
use gumption_engine::decimal::{significant, to_15_digits};
use gumption_engine::number::Shortest;
use gumption_units::Unit;

/// Rows whose signs are tried, at most.
const MOST_SIGNS: u32 = 8;

/// From this share of the largest one on, a temperature is none that corrects it.
const LARGE: f64 = 0.1;

impl Budget<'_> {
    /// The signs with which the other rows make the estimate of the last one, where their combined
    /// uncertainty is its own as well; with another uncertainty it could be a further quantity, and is
    /// refused. The sum without signs is told elsewhere.
    pub(super) fn signs(&self, header: &Header, rows: &[Row]) -> Option<Vec<f64>> {
        let (last, others) = rows.split_last().filter(|(_, others)| others.len() > 1)?;
        if rows.iter().any(|row| row.sensitivity.is_some()) {
            return None;
        }
        let scaled =
            if are_of_one_unit(last, others) { None } else { Some(in_unit_of(last, others)?) };
        let others = scaled.as_deref().unwrap_or(others);
        let estimate = last.estimate?;
        let stated = last.std.or(last.width)?;
        let signs = signs_of(others, estimate, self.half_digit(header, last, Column::Estimate))?;
        let negative = || signs.iter().zip(others).filter(|(sign, _)| **sign < 0.0);
        let squares = others.iter().filter_map(|row| Some(standard_uncertainty(row)?.powi(2)));
        let combined = squares.sum::<f64>().sqrt();
        let column = if last.std.is_some() { Column::Std } else { Column::Width };
        let half = 1.2 * self.half_digit(header, last, column) / stated;
        let is_combined =
            [1.0, 2.0].iter().any(|k| is_near(stated, k * combined, half.clamp(0.01, 0.05)));
        let own = standard_uncertainty(last).unwrap_or(stated);
        if is_combined {
            return Some(signs);
        }
        // quantities that are added to what they are made of are less uncertain by chance
        if own > combined && combined > 0.0 && estimate != 0.0 {
            let names: Vec<String> = negative().map(|(_, row)| format!("`{}`", row.name)).collect();
            let reason = format!(
                "`{}` is {}, the others with the sign of {} turned, and can be the result or a quantity \
                 that is added to them: its standard uncertainty, {}, is not the combined one of the others, \
                 {}; write the equation, or name the result `Result`",
                last.name,
                Shortest(estimate),
                gumption_units::listed(&names, " and "),
                significant(own, 3),
                significant(combined, 3)
            );
            self.fail(last.line, reason);
        }
        None
    }

    /// Writes the signs of a result that is a difference into the coefficients of its quantities.
    pub(super) fn difference(&mut self, rows: &mut [Row], last: &mut Row, signs: &[f64]) {
        let mut negative = Vec::new();
        for (row, sign) in rows.iter_mut().zip(signs) {
            row.sensitivity = Some(*sign);
            if row.unit != last.unit && !row.unit.is_empty() {
                row.unit_of_sensitivity = format!("({0})/({0})", row.unit);
            }
            if *sign < 0.0 {
                negative.push(format!("`{}`", row.name));
            }
        }
        // of temperatures in °C it counts from no zero
        let is_celsius = Unit::parse(&last.unit).is_ok_and(|unit| unit.is_celsius());
        if is_celsius && signs.iter().sum::<f64>() != 1.0 {
            "K".clone_into(&mut last.unit);
        }
        self.guessed.push(format!(
            "line {}: `{}` is what the others make with the sign of {} turned, with their combined uncertainty, \
             and is taken for the result",
            last.line + 1,
            last.name,
            gumption_units::listed(&negative, " and ")
        ));
    }

    /// Half of a unit of the last digit of the number in a cell.
    pub(super) fn half_digit(&self, header: &Header, row: &Row, column: Column) -> f64 {
        let text = without_factor(header.cell(self.cells, row.line, column).trim());
        let unit = number_with_unit(text, self.cells.decimal_comma()).map_or("", |(_, unit)| unit);
        half_digit(text.strip_suffix(unit).unwrap_or(text))
    }

    /// Refuses a sum that nobody means, where neither an equation nor coefficients say what the result is:
    /// an indication and a reference, or two temperatures in degrees Celsius.
    pub(super) fn meaningless_sum(&self, rows: &[Row]) -> Option<()> {
        let of_levels = levels(rows);
        if let Some([first, second]) = of_levels {
            let reason = format!(
                "without an equation the result would be the sum of `{}` and `{}`, which are levels above a \
                 reference: write the equation (`y = 10*log10(10^({}/10) + 10^({}/10))` of powers), or give \
                 gains in dB",
                first.name, second.name, first.name, second.name
            );
            self.fail(second.line, reason);
            return None;
        }
        let Some([first, second]) = indication_and_reference(rows).or_else(|| temperatures(rows))
        else {
            return Some(());
        };
        let [a, b] = [first, second].map(|row| row.estimate.unwrap_or(0.0));
        let unit = Unit::parse(&first.unit).unwrap_or_default();
        let after = |value: f64| unit.after(&Shortest(to_15_digits(value)).to_string());
        let (less, hint) = if unit.is_celsius() {
            let hint = "; a correction of a temperature is in K";
            (format!("{} K", Shortest(difference(a, b))), hint)
        } else {
            (after(difference(a, b)), "")
        };
        let reason = format!(
            "without an equation the result can be the sum of `{}` and `{}`, {}, or their difference, \
             {less}: write the equation (`E = {} - {}`), or 1 and -1 into a column `Sensitivity \
             coefficient`{hint}",
            first.name,
            second.name,
            after(a + b),
            first.name,
            second.name
        );
        self.fail(second.line, reason);
        None
    }
}

/// Whether all rows are in the unit of the last one, or in °C where that is a difference in K.
fn are_of_one_unit(last: &Row, others: &[Row]) -> bool {
    let Some(first) = others.first() else { return false };
    let is_celsius = Unit::parse(&first.unit).is_ok_and(|unit| unit.is_celsius());
    others.iter().all(|row| row.unit == first.unit)
        && (last.unit == first.unit || is_celsius && last.unit == "K")
}

/// The signs with which rows add up to a number, of which the fewest are negative; `None` where all are
/// positive, where others turn as few, and where none do.
fn signs_of(rows: &[Row], wanted: f64, half_digit: f64) -> Option<Vec<f64>> {
    let estimates: Vec<f64> = rows.iter().map(|row| row.estimate.unwrap_or(0.0)).collect();
    let turnable: Vec<usize> = (0..rows.len()).filter(|place| estimates[*place] != 0.0).collect();
    let count = u32::try_from(turnable.len()).ok().filter(|count| *count <= MOST_SIGNS)?;
    let size: f64 = estimates.iter().map(|estimate| estimate.abs()).sum();
    let near = (1.2 * half_digit).max(1e-12 * size);
    let signs = |pattern: u32| {
        let mut signs = vec![1.0; rows.len()];
        for (bit, place) in turnable.iter().enumerate() {
            if pattern >> bit & 1 == 1 {
                signs[*place] = -1.0;
            }
        }
        signs
    };
    let fits = |pattern: &u32| {
        let sum: f64 = signs(*pattern).iter().zip(&estimates).map(|(sign, of)| sign * of).sum();
        (sum - wanted).abs() <= near
    };
    let found: Vec<u32> = (0..1 << count).filter(fits).collect();
    let fewest = found.iter().map(|pattern| pattern.count_ones()).min().filter(|of| *of > 0)?;
    let mut best = found.into_iter().filter(|pattern| pattern.count_ones() == fewest);
    match (best.next(), best.next()) {
        (Some(pattern), None) => Some(signs(pattern)),
        _ => None,
    }
}

/// A row of an indication and one of the reference that it is held against, of about the same value.
fn indication_and_reference(rows: &[Row]) -> Option<[&Row; 2]> {
    const INDICATIONS: [&str; 9] = [
        "indication",
        "indicated",
        "reading",
        "dut",
        "uut",
        "anzeige",
        "ablesung",
        "prüfling",
        "lecture",
    ];
    const REFERENCES: [&str; 5] = ["reference", "ref", "referenz", "référence", "bezugswert"];
    let is = |row: &Row, words: &[&str]| {
        let text = row.about.to_lowercase();
        let first = text.split(|c: char| !c.is_alphanumeric()).find(|word| !word.is_empty());
        first.is_some_and(|word| {
            words.iter().any(|of| word == *of || of.len() > 4 && word.starts_with(of))
        })
    };
    let indication = rows.iter().find(|row| is(row, &INDICATIONS))?;
    let reference = rows.iter().find(|row| is(row, &REFERENCES))?;
    let [a, b] = [indication.estimate?, reference.estimate?];
    let are_alike = indication.unit == reference.unit && a / b > 0.5 && a / b < 2.0;
    are_alike.then_some([indication, reference])
}

/// Two levels above a reference, of which neither is 0 as a correction may be.
fn levels(rows: &[Row]) -> Option<[&Row; 2]> {
    let is_level = |row: &&Row| {
        row.estimate != Some(0.0) && Unit::parse(&row.unit).is_ok_and(|unit| unit.has_reference())
    };
    let mut found = rows.iter().filter(is_level);
    Some([found.next()?, found.next()?])
}

/// Two temperatures in °C of which neither is as small as a correction.
fn temperatures(rows: &[Row]) -> Option<[&Row; 2]> {
    let is_celsius = |row: &&Row| Unit::parse(&row.unit).is_ok_and(|unit| unit.is_celsius());
    let size = |row: &Row| row.estimate.map_or(0.0, f64::abs);
    let largest = rows.iter().filter(is_celsius).map(size).fold(0.0, f64::max);
    let is_large = |row: &&Row| size(row) > LARGE * largest;
    let mut large = rows.iter().filter(is_celsius).filter(is_large);
    Some([large.next()?, large.next()?])
}
