//! Coefficients that are a power of ten from what the sheet's own result says.
//!
//! The derivatives of a product leave a constant between the linear model and the estimate of the sheet. So
//! does a coefficient in µm/K that is taken in mm/K, and there the uncertainty is wrong a thousandfold: where
//! a power of ten leaves no constant, both readings are told.

use super::Budget;
use super::columns::{Column, Header};
use super::rows::Row;
use gumption_engine::decimal::to_15_digits;
use gumption_engine::number::{Shortest, elementary};
use gumption_units::listed;

/// From this power of ten on: the derivative of x^10 is ten times the quotient.
const LEAST_POWER: i32 = 2;
const LARGEST_POWER: i32 = 12;

/// A product of less than so many halves of the last digit is not seen in the result.
const SEEN: f64 = 10.0;

impl Budget<'_> {
    /// Refuses coefficients of which one, or all that are not 1, times a power of ten make the estimate of the
    /// result without a constant; those with a unit of their own are what they are.
    pub(super) fn scaled_coefficients(
        &self,
        header: &Header,
        (rows, factors): (&[Row], &[f64]),
        (result, unit): (&Row, &str),
        constant: f64,
    ) -> Option<()> {
        let Some(estimate) = result.estimate.filter(|estimate| *estimate != 0.0) else {
            return Some(());
        };
        let half = self.half_digit(header, result, Column::Estimate);
        let shown = self.shown(header, result).filter(|shown| *shown != 0.0).unwrap_or(estimate);
        let half = half * (estimate / shown).abs();
        let products: Vec<f64> =
            rows.iter().zip(factors).map(|(row, c)| c * row.estimate.unwrap_or(0.0)).collect();
        let is_open = |place: &usize| {
            rows[*place].sensitivity.is_some() && rows[*place].unit_of_sensitivity.is_empty()
        };
        let open: Vec<usize> =
            (0..rows.len()).filter(is_open).filter(|place| products[*place] != 0.0).collect();
        let others: Vec<usize> =
            open.iter().copied().filter(|place| factors[*place].abs() != 1.0).collect();
        let groups = open.iter().map(|place| vec![*place]).chain([others, open.clone()]);
        let powers = (LEAST_POWER..=LARGEST_POWER).flat_map(|power| [-power, power]);
        let powers: Vec<i32> = powers.collect();
        for group in groups {
            let part: f64 = group.iter().map(|place| products[*place]).sum();
            let sum: f64 = products.iter().sum();
            let fits = |power: &&i32| {
                let scaled = part * elementary::pow(10.0, f64::from(**power));
                scaled.abs() > SEEN * half && (sum - part + scaled - estimate).abs() <= 1.2 * half
            };
            let Some(power) = powers.iter().find(fits) else { continue };
            let row = &rows[group[0]];
            let per = match row.unit.as_str() {
                "" => unit.to_owned(),
                "°C" => format!("{unit}/K"),
                own => format!("{unit}/{own}"),
            };
            let c = factors[group[0]];
            let scaled = to_15_digits(c * elementary::pow(10.0, f64::from(*power)));
            let rest: Vec<String> =
                group.iter().skip(1).map(|place| format!("`{}`", rows[*place].name)).collect();
            let rest = match rest.len() {
                0 => String::new(),
                _ => format!(", and of {} as well", listed(&rest, " and ")),
            };
            let reason = format!(
                "the coefficient {} of `{}` can be {} {per}, with which the constant {} is added to make the \
                 sheet's estimate {}, or {} {per}, with which there is none{rest}: write its unit into a column \
                 `Unit of c_i`",
                Shortest(c),
                row.name,
                Shortest(c),
                Shortest(constant),
                Shortest(estimate),
                Shortest(scaled)
            );
            self.fail(row.line, reason);
            return None;
        }
        Some(())
    }

    /// The number that the estimate of a row is written with.
    fn shown(&self, header: &Header, row: &Row) -> Option<f64> {
        let text = header.cell(self.cells, row.line, Column::Estimate);
        super::number::number_with_unit(text, self.cells.decimal_comma()).map(|(value, _)| value)
    }
}
