//! Rows that state their quantity by a lower and an upper limit (JCGM 100, 4.3.7).

use gumption_engine::decimal::to_15_digits;
use gumption_engine::number::Shortest;

use super::Budget;
use super::columns::{Column, Header};
use super::rows::Row;
use gumption_text::named_shape::NamedShape;

/// Limits lie alike about an estimate to this share of their distance, which rounding of the sheet leaves.
const ALIKE: f64 = 1e-9;

/// Limits are deviations where they are no more than this share of an estimate that is not between them.
const SMALL: f64 = 0.1;

impl Budget<'_> {
    /// Takes the half width, and where the row has none the estimate, of its limits; `None` where it has
    /// no limits, or after a mistake. In a row of results there is nothing to take.
    pub(super) fn limits(&mut self, header: &Header, row: &mut Row, lenient: bool) -> Option<()> {
        let line = row.line;
        let mut read = |column| self.in_unit(header, line, (column, lenient), row);
        let limits = [read(Column::Lower), read(Column::Upper)];
        if lenient || limits == [None, None] {
            return None;
        }
        let shape = NamedShape::of(header.cell(self.cells, line, Column::Distribution));
        match take(limits, row, shape) {
            Ok(said) => {
                let said = said.map(|said| format!("line {}: {said}", line + 1));
                self.guessed.extend(said);
                Some(())
            }
            Err(reason) => {
                self.fail(line, reason);
                None
            }
        }
    }
}

/// Writes the half width of two limits into their row, and where it has none the estimate; what is to be
/// told of it.
fn take(
    limits: [Option<f64>; 2],
    row: &mut Row,
    shape: Option<NamedShape>,
) -> Result<Option<String>, String> {
    let [Some(lower), Some(upper)] = limits else {
        return Err("the row has one limit only; it needs both".to_owned());
    };
    if row.width.is_some() {
        let reason = "the row has limits and a stated uncertainty; only one of them can be taken";
        return Err(reason.to_owned());
    }
    let half = to_15_digits(0.5 * (upper - lower));
    let middle = to_15_digits(0.5 * (upper + lower));
    if half < 0.0 {
        let [lower, upper] = [lower, upper].map(Shortest);
        return Err(format!("the upper limit {upper} is below the lower one, {lower}"));
    }
    row.width = Some(half);
    let is_alike = |a: f64, b: f64| (a - b).abs() <= ALIKE * half.max(a.abs());
    match row.estimate {
        None => {
            row.estimate = Some(middle);
            Ok(Some("the estimate is the middle of the limits".to_owned()))
        }
        Some(estimate) if is_alike(estimate, middle) => Ok(None),
        // ±0.5 beside 10: tolerances
        Some(estimate) if is_alike(upper, -lower) && !(lower..=upper).contains(&estimate) => {
            let half = Shortest(half);
            Ok(Some(format!("the limits are taken as deviations of ±{half} from the estimate")))
        }
        // -0.0005 to 0.0003 beside 10: deviations
        Some(estimate)
            if !(lower..=upper).contains(&estimate)
                && lower.abs().max(upper.abs()) <= SMALL * estimate.abs() =>
        {
            let unit = if row.unit.is_empty() { String::new() } else { format!(" {}", row.unit) };
            let moved = to_15_digits(estimate + middle);
            let [estimate, lower, upper, moved] = [estimate, lower, upper, moved].map(Shortest);
            let [low, high] = [-half, half].map(Shortest);
            Err(format!(
                "the limits {lower} and {upper} do not contain the estimate {estimate}: as deviations from \
                 it, which do not lie alike, write the estimate {moved}{unit} and the limits {low} and {high}"
            ))
        }
        Some(estimate) => {
            let [estimate, lower, upper, middle] = [estimate, lower, upper, middle].map(Shortest);
            let advice = match shape {
                None | Some(NamedShape::Known("rectangular")) => {
                    format!(
                        "write the middle {middle} as the estimate if every value between them is as \
                             likely, or a half-width"
                    )
                }
                Some(NamedShape::Known("triangular")) => format!(
                    "write the middle {middle} as the estimate if that is the most probable value; where it \
                     is {estimate}, do the same here, and state `lower`, `upper` and `mode` in the model file"
                ),
                Some(_) => format!(
                    "write the middle {middle} as the estimate, or the uncertainty of the estimate {estimate}"
                ),
            };
            Err(format!(
                "the limits {lower} and {upper} do not lie alike about the estimate {estimate}; {advice}"
            ))
        }
    }
}
