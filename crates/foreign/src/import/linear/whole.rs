//! The result that the rows of a linear budget contribute to, and what a sheet says of their contributions.
//!
//! Budgets state contributions in the unit of the result, as shares of its estimate, or as shares of its
//! variance, which add up to 100 %.

use super::{is_same, standard_uncertainty};
use crate::import::Budget;
use crate::import::columns::{Column, Header};
use crate::import::number::number_with_unit;
use crate::import::rows::Row;
use crate::import::stated::share_of;
use gumption_engine::decimal::significant;
use gumption_engine::number::Shortest;
use gumption_units::Unit;

/// The result of a budget.
pub(super) struct Whole<'u> {
    /// Its unit as it is written; empty for a plain number.
    pub(super) text: &'u str,
    pub(super) unit: Unit,
    /// What shares are of: `None` where it is 0, a level or a temperature in °C.
    pub(super) estimate: Option<f64>,
    /// Whether the sheet states its unit.
    pub(super) is_stated: bool,
    /// Whether the contributions are shares of its variance.
    pub(super) has_variances: bool,
}

/// Sums of shares that are rounded differ from 100 % by no more than this.
const SUM_OF_SHARES: f64 = 1.5;

/// Shares of the variance that differ by more points than this are told.
const POINTS: f64 = 5.0;

/// Whether shares in per cent are all of something.
pub(in crate::import) fn are_all(sum_of_percent: f64) -> bool {
    (sum_of_percent - 100.0).abs() < SUM_OF_SHARES
}

impl<'u> Whole<'u> {
    /// By its unit and what is known of its estimate; `None` for a unit that nobody knows.
    pub(super) fn of(text: &'u str, rows: &[Row], result: Option<&Row>) -> Option<Self> {
        let unit = Unit::parse(text).ok()?;
        let stated = result.and_then(|result| result.estimate);
        let sum = || rows.iter().filter_map(|row| product(row, &unit)).sum::<f64>();
        let estimate = stated.unwrap_or_else(sum);
        let estimate = share_of(&unit, estimate).map(|_| estimate);
        let is_stated = result.is_some_and(|result| result.unit == text) && !text.is_empty();
        Some(Self { text, unit, estimate, is_stated, has_variances: false })
    }

    /// What a contribution in some unit is multiplied by: to convert it, or as a share of the estimate.
    fn scales(&self, unit: &str) -> Vec<f64> {
        let Ok(stated) = Unit::parse(unit) else { return Vec::new() };
        let share = share_of(&self.unit, self.estimate.unwrap_or(0.0))
            .filter(|_| stated.is_relative() && !self.has_variances)
            .map(|whole| stated.factor() * whole);
        let own = Unit::conversion_factor(&stated, &self.unit).ok();
        let own = own.filter(|_| !(self.has_variances && stated.is_relative()));
        own.into_iter().chain(share).collect()
    }
}

/// A row's estimate times its coefficient in a unit, where it can be added to others in it.
fn product(row: &Row, unit: &Unit) -> Option<f64> {
    let own = Unit::parse(&row.unit).ok()?;
    let (c, estimate) = (row.sensitivity.unwrap_or(1.0), row.estimate?);
    if row.unit_of_sensitivity.is_empty() {
        let scale = Unit::conversion_factor(&own, unit).ok()?;
        return own.has_zero_of(unit).then_some(c * scale * estimate);
    }
    let per = Unit::parse(&row.unit_of_sensitivity).ok()?;
    let is_it = per.dimension().checked_mul(own.dimension()) == Some(unit.dimension());
    is_it.then(|| c * estimate * per.factor() * own.factor() / unit.factor())
}

impl Budget<'_> {
    /// The contribution that a row states, and its unit: the cell's, or that of the heading.
    pub(super) fn contribution_of_cell<'h>(
        &'h self,
        header: &'h Header,
        row: &Row,
    ) -> Option<(f64, &'h str)> {
        let text = header.cell(self.cells, row.line, Column::Contribution).trim();
        let (stated, unit) = number_with_unit(text, self.cells.decimal_comma())?;
        Some(match unit.trim() {
            // the number of a cell in per cent is a share already
            "" if text.ends_with('%') => (100.0 * stated, "%"),
            "" => (stated, header.unit(Column::Contribution).unwrap_or("")),
            unit => (stated, unit),
        })
    }

    /// Whether the contributions of rows are shares of the variance: per cent that add up to 100.
    pub(super) fn are_variances(&self, header: &Header, rows: &[Row]) -> bool {
        let stated: Vec<(f64, &str)> =
            rows.iter().filter_map(|row| self.contribution_of_cell(header, row)).collect();
        let sum: f64 = stated.iter().map(|(value, _)| value.abs()).sum();
        stated.len() > 1 && stated.iter().all(|(_, unit)| *unit == "%") && are_all(sum)
    }

    /// The contribution of a row to the result as the sheet states it and that of the model, both without a
    /// sign and in the unit of the result.
    pub(super) fn contribution(
        &self,
        header: &Header,
        row: &Row,
        factor: f64,
        whole: &Whole,
    ) -> Option<[f64; 2]> {
        let (stated, unit) = self.contribution_of_cell(header, row)?;
        let scales = if unit.is_empty() { vec![1.0] } else { whole.scales(unit) };
        let own = (factor * standard_uncertainty(row).unwrap_or(0.0)).abs();
        let both = |scale: &f64| [(stated * scale).abs(), own];
        let mut all = scales.iter().map(both);
        all.clone().find(|both| is_same(*both)).or_else(|| all.next())
    }

    /// A contribution of the model, in the unit of the result or of the shares that the sheet states.
    pub(super) fn in_unit_of_contribution(
        &self,
        header: &Header,
        row: &Row,
        own: f64,
        whole: &Whole,
    ) -> String {
        let plain = whole.unit.after(&Shortest(own).to_string());
        let share = self.contribution_of_cell(header, row).and_then(|(_, unit)| {
            let unit = Unit::parse(unit).ok().filter(Unit::is_relative)?;
            let of = whole.estimate.filter(|_| !whole.unit.is_compatible(&unit))?;
            Some(unit.after(&significant(own / of.abs() / unit.factor(), 3)))
        });
        share.map_or(plain.clone(), |share| format!("{plain}, which is {share} of the result"))
    }

    /// Tells where the sheet's share of the variance of a row is not that of the model; shares of the plain
    /// sum of the contributions are passed by.
    pub(super) fn compare_variances(&mut self, header: &Header, rows: &[Row], factors: &[f64]) {
        let parts: Vec<f64> = rows
            .iter()
            .zip(factors)
            .map(|(row, c)| (c * standard_uncertainty(row).unwrap_or(0.0)).abs())
            .collect();
        let shares = |power: i32| {
            let powers: Vec<f64> = parts.iter().map(|part| part.powi(power)).collect();
            let sum: f64 = powers.iter().sum();
            powers.into_iter().map(|part| 100.0 * part / sum).collect::<Vec<f64>>()
        };
        let stated: Vec<Option<f64>> = rows
            .iter()
            .map(|row| self.contribution_of_cell(header, row).map(|(value, _)| value.abs()))
            .collect();
        let differs =
            |stated: &Option<f64>, own: f64| stated.is_some_and(|of| (of - own).abs() > POINTS);
        if stated.iter().zip(shares(1)).all(|(stated, own)| !differs(stated, own)) {
            return;
        }
        for ((row, stated), own) in rows.iter().zip(&stated).zip(shares(2)) {
            if differs(stated, own) {
                self.guessed.push(format!(
                    "line {}: the sheet says that `{}` has {} of 100 % of the variance, this model {} %",
                    row.line + 1,
                    row.name,
                    header.cell(self.cells, row.line, Column::Contribution).trim(),
                    significant(own, 3)
                ));
            }
        }
    }
}
