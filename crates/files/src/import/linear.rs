//! The linear model of a budget that has no equation: the sum of its quantities, each times its
//! sensitivity coefficient.
//!
//! Coefficients are in the unit of the result per unit of the quantity. Budgets state that in a column
//! of its own, or leave it to the reader; where one row can be read in two ways, both are named.

use super::Budget;
use super::columns::{Column, Header};
use super::number::number_with_unit;
use super::rows::{Row, divisor_of};
use gumption_engine::decimal::{significant, to_15_digits};
use gumption_engine::number::{Shortest, elementary};
use gumption_units::Unit;

/// The model of a budget without an equation.
pub(super) struct Linear {
    /// Its right side, of numbers in the units of the quantities.
    pub(super) formula: String,
    /// The unit of the result; empty if nothing tells it.
    pub(super) unit: String,
}

/// From this ratio on, the sheet's contribution and that of the model are not the same number
/// rounded: a single digit is 1.5 at worst.
pub(super) const CONTRIBUTIONS_DIFFER: f64 = 1.6;

impl Budget<'_> {
    /// The linear model of the sensitivity coefficients; `None` after a mistake.
    pub(super) fn linear(
        &mut self,
        header: &Header,
        rows: &[Row],
        result: Option<&Row>,
        measurand: &str,
    ) -> Option<Linear> {
        let with = rows.iter().filter(|row| row.sensitivity.is_some()).count();
        if with == 0 && result.and_then(|result| result.estimate).is_none() {
            self.meaningless_sum(rows)?;
        }
        if with == 0 {
            self.guessed.push(format!(
                "there is neither an equation nor a column of sensitivity coefficients: {measurand} \
                 is taken for the sum of the quantities"
            ));
        } else {
            let said = "the linear model of the sensitivity coefficients, which are in units of the \
                        result per unit of the quantity";
            self.understood.push(said.to_owned());
            for row in rows.iter().filter(|row| row.sensitivity.is_none()) {
                self.guessed.push(format!(
                    "line {}: `{}` has no sensitivity coefficient; 1 is taken",
                    row.line + 1,
                    row.name
                ));
            }
        }
        let unit = self.unit_of_result(rows, result, measurand);
        // where a sheet states units of coefficients, one without is a plain number
        let states_units = rows.iter().any(|row| !row.unit_of_sensitivity.is_empty());
        let factors: Vec<Option<f64>> =
            rows.iter().map(|row| self.coefficient(header, row, &unit, states_units)).collect();
        let factors: Vec<f64> = factors.into_iter().collect::<Option<_>>()?;
        for (row, factor) in rows.iter().zip(&factors) {
            self.compare_contribution(header, row, *factor, &unit);
        }
        self.contradicting_contributions(header, rows, &factors, &unit)?;
        let written = |x: f64| Shortest(x).to_string();
        let sum: f64 =
            rows.iter().zip(&factors).map(|(row, c)| c * row.estimate.unwrap_or(0.0)).sum();
        let estimate = result.and_then(|result| result.estimate);
        let mut terms = Vec::new();
        match estimate {
            Some(estimate) if (estimate - sum).abs() > 1e-9 * estimate.abs().max(sum.abs()) => {
                let constant = difference(estimate, sum);
                if let Some(result) = result {
                    let of = (result, unit.as_str());
                    self.scaled_coefficients(header, (rows, &factors), of, constant)?;
                }
                let constant = written(constant);
                let what = if with == 0 { "" } else { ", times their coefficients," };
                let turned = Self::sign_that_explains(rows, &factors, estimate - sum);
                // the derivatives of a product leave a constant; a plain sum has none
                let is_sum = rows.iter().all(|row| row.sensitivity.is_none_or(|c| c.abs() == 1.0));
                let is_guess = is_sum || !turned.is_empty();
                let told = if is_guess { &mut self.guessed } else { &mut self.understood };
                told.push(format!(
                    "the quantities{what} add up to {}, and the sheet has {}: the constant {constant} \
                     is added{turned}",
                    written(to_15_digits(sum)),
                    written(estimate),
                ));
                terms.push(constant);
            }
            Some(_) => {}
            None if with > 0 => self.guessed.push(format!(
                "the estimate of {measurand} is not given: that of the linear model is taken, {}",
                written(to_15_digits(sum))
            )),
            None => {}
        }
        for (row, factor) in rows.iter().zip(&factors) {
            terms.push(match *factor {
                1.0 => row.name.clone(),
                factor => format!("({})*{}", written(to_15_digits(factor)), row.name),
            });
        }
        Some(Linear { formula: terms.join(" + "), unit })
    }

    /// The row whose coefficient with the other sign makes the sheet's estimate, as the end of a
    /// sentence.
    fn sign_that_explains(rows: &[Row], factors: &[f64], difference: f64) -> String {
        let mut turned = rows.iter().zip(factors).filter(|(row, factor)| {
            let product = **factor * row.estimate.unwrap_or(0.0);
            (difference + 2.0 * product).abs() <= 1e-6 * product.abs()
        });
        match (turned.next(), turned.next()) {
            (Some((row, factor)), None) => format!(
                "; with the coefficient {} of `{}` (line {}) there would be none",
                Shortest(-factor),
                row.name,
                row.line + 1
            ),
            _ => String::new(),
        }
    }

    /// The unit of the result: that of its row, else that of the first row whose coefficient says it.
    fn unit_of_result(&mut self, rows: &[Row], result: Option<&Row>, measurand: &str) -> String {
        if let Some(result) = result.filter(|result| !result.unit.is_empty()) {
            return result.unit.clone();
        }
        let of = |row: &Row| {
            if !row.unit_of_sensitivity.is_empty() {
                return of_coefficient(&row.unit_of_sensitivity, &row.unit);
            }
            let is_one = row.sensitivity.is_none_or(|c| c.abs() == 1.0);
            (is_one && !row.unit.is_empty()).then(|| row.unit.clone())
        };
        let Some((unit, row)) = rows.iter().find_map(|row| Some((of(row)?, row))) else {
            return String::new();
        };
        self.guessed.push(format!(
            "the unit of {measurand} is not given: `{unit}` is taken, as of `{}` in line {}",
            row.name,
            row.line + 1
        ));
        unit
    }

    /// What a row's numbers are multiplied by; `None` after a mistake.
    fn coefficient(
        &mut self,
        header: &Header,
        row: &Row,
        unit: &str,
        states_units: bool,
    ) -> Option<f64> {
        let line = row.line + 1;
        let (of_row, of_result) = (Unit::parse(&row.unit).ok(), Unit::parse(unit).ok());
        let (own, whole) = of_row.zip(of_result)?;
        if let Some(c) = row.sensitivity.filter(|_| states_units) {
            let stated = match row.unit_of_sensitivity.as_str() {
                "" => "1",
                stated => stated,
            };
            let Ok(per) = Unit::parse(stated) else {
                self.fail(row.line, format!("the unit `{stated}` of the coefficient is not known"));
                return None;
            };
            if unit.is_empty() {
                return Some(c);
            }
            let product = per.dimension().checked_mul(own.dimension());
            if product != Some(whole.dimension()) {
                let found = product.map_or_else(String::new, |found| {
                    format!(", {}, where the result is in `{unit}`", found.describe())
                });
                let is_plain = row.unit_of_sensitivity.is_empty();
                if is_plain && self.contribution(header, row, c, &whole).is_some_and(is_same) {
                    let of = if row.unit.is_empty() { "unit one" } else { &row.unit };
                    self.guessed.push(format!(
                        "line {line}: the coefficient {} of `{}` is taken in `{unit}` per {of}, as its \
                         contribution has it",
                        Shortest(c),
                        row.name
                    ));
                    return Some(c);
                }
                let coefficient = if is_plain {
                    "a coefficient without a unit".to_owned()
                } else {
                    format!("a coefficient in `{stated}`")
                };
                let times = match row.unit.as_str() {
                    "" => "a quantity without one".to_owned(),
                    own => format!("`{own}`"),
                };
                self.fail(row.line, format!("{coefficient} times {times}{found}"));
                return None;
            }
            let scale = per.factor() * own.factor() / whole.factor();
            let is_one = (scale - 1.0).abs() < 1e-12;
            // each step rounded once
            return Some(if is_one { c } else { whole.from_si(own.to_si(per.to_si(c))) });
        }
        let scale = Unit::conversion_factor(&own, &whole).ok();
        let shifted = own.offset() != whole.offset();
        let c = row.sensitivity.unwrap_or(1.0);
        // a coefficient multiplies differences, whose zeros do not matter
        match scale.filter(|_| !shifted || row.sensitivity.is_some()) {
            Some(1.0) => Some(c),
            Some(scale) if row.sensitivity.is_none() => {
                let of = match row.unit.as_str() {
                    "" => "without a unit".to_owned(),
                    unit => format!("in {unit}"),
                };
                self.guessed
                    .push(format!("line {line}: `{}` {of} is converted to {unit}", row.name));
                Some(scale)
            }
            Some(scale) if (c.abs() / scale - 1.0).abs() < 1e-6 => Some(c),
            // nearer to a plain factor than to the ratio of the two units
            Some(scale) if far_from_one(c) < far_from_one(c / scale) => {
                let fits = |c: f64| self.contribution(header, row, c, &whole).is_some_and(is_same);
                match (fits(c), fits(c * scale)) {
                    (true, false) => return Some(c),
                    (false, true) => return Some(c * scale),
                    _ => {}
                }
                let (c, converted) = (Shortest(c), Shortest(c * scale));
                let reason = format!(
                    "the coefficient {c} of `{}` in {own} can be {c} {unit}/{own} or {c} {unit}/{unit}, \
                     which is {converted} {unit}/{own}; write that with a column `Unit of c_i`, or the \
                     quantity in {unit}",
                    row.name
                );
                self.fail(row.line, reason);
                None
            }
            None if row.sensitivity.is_none() && row.unit != unit => {
                let of = |unit: &str| match unit {
                    "" => "without a unit".to_owned(),
                    unit => format!("in `{unit}`"),
                };
                let reason = format!(
                    "`{}` is {}, the result {}: its sensitivity coefficient or the equation is missing",
                    row.name,
                    of(&row.unit),
                    of(unit)
                );
                self.fail(row.line, reason);
                None
            }
            Some(_) | None => {
                if scale.is_none()
                    && let Some((found, of)) = self.by_contribution(header, row, c, &whole)
                {
                    self.guessed.push(format!(
                        "line {line}: the coefficient {} of `{}` is taken in `{of}` per {}, as its \
                         contribution has it",
                        Shortest(c),
                        row.name,
                        row.unit
                    ));
                    return Some(found);
                }
                if c.abs() == 1.0 && row.unit != unit && !unit.is_empty() {
                    self.guessed.push(format!(
                        "line {line}: the coefficient {} of `{}` is taken in `{unit}` per {}",
                        Shortest(c),
                        row.name,
                        if row.unit.is_empty() { "unit one" } else { row.unit.as_str() },
                    ));
                }
                Some(c)
            }
        }
    }

    /// The contribution of a row to the result as the sheet states it, perhaps with a unit, and that of
    /// the model, both without a sign and in the unit of the result.
    fn contribution(
        &self,
        header: &Header,
        row: &Row,
        factor: f64,
        of_result: &Unit,
    ) -> Option<[f64; 2]> {
        let text = header.cell(self.cells, row.line, Column::Contribution).trim();
        let (stated, unit) = number_with_unit(text, self.cells.decimal_comma())?;
        let scale = match unit.trim() {
            "" => match header.unit(Column::Contribution) {
                None => 1.0,
                Some(unit) => Unit::conversion_factor(&Unit::parse(unit).ok()?, of_result).ok()?,
            },
            unit => Unit::conversion_factor(&Unit::parse(unit).ok()?, of_result).ok()?,
        };
        let u = standard_uncertainty(row).unwrap_or(0.0);
        (!text.ends_with('%')).then(|| [(stated * scale).abs(), (factor * u).abs()])
    }

    /// A coefficient that is stated in the unit of the contributions and not in that of the result, where
    /// the row's contribution says so; and that unit.
    fn by_contribution<'h>(
        &self,
        header: &'h Header,
        row: &Row,
        c: f64,
        of_result: &Unit,
    ) -> Option<(f64, &'h str)> {
        let unit = header.unit(Column::Contribution)?;
        let scale = Unit::conversion_factor(&Unit::parse(unit).ok()?, of_result).ok()?;
        let fits = |c: f64| self.contribution(header, row, c, of_result).is_some_and(is_same);
        (scale != 1.0 && !fits(c) && fits(c * scale)).then_some((c * scale, unit))
    }

    /// Refuses contributions of which some are those of the model and others a power of ten from it: the
    /// unit of the result, or a coefficient, is another one then.
    fn contradicting_contributions(
        &self,
        header: &Header,
        rows: &[Row],
        factors: &[f64],
        unit: &str,
    ) -> Option<()> {
        let of_result = Unit::parse(unit).ok()?;
        let ratio = |(row, factor): (&Row, &f64)| {
            let [stated, own] = self.contribution(header, row, *factor, &of_result)?;
            (stated > 0.0 && own > 0.0).then(|| (row.line, row.name.clone(), stated / own))
        };
        let ratios: Vec<(usize, String, f64)> =
            rows.iter().zip(factors).filter_map(ratio).collect();
        let is_scaled = |ratio: f64| {
            let power = elementary::log10(ratio).round();
            power.abs() >= 2.0 && is_same([ratio, elementary::pow(10.0, power)])
        };
        let scaled = ratios.iter().find(|(_, _, ratio)| is_scaled(*ratio));
        let right = ratios.iter().find(|(_, _, ratio)| is_same([*ratio, 1.0]));
        if let (Some((line, name, ratio)), Some((_, other, _))) = (scaled, right) {
            let reason = format!(
                "the contribution of `{name}` is {} times that of this model in `{unit}`, and that of \
                 `{other}` is the same: write the unit of the result into its row, of the contributions \
                 into their heading (`u_i(y) (µm)`), and of the coefficients into a column `Unit of c_i`",
                significant(*ratio, 2)
            );
            self.fail(*line, reason);
            return None;
        }
        Some(())
    }

    /// Tells where the sheet's contribution of a row is not that of the model.
    fn compare_contribution(&mut self, header: &Header, row: &Row, factor: f64, unit: &str) {
        let Ok(of_result) = Unit::parse(unit) else { return };
        let both = self.contribution(header, row, factor, &of_result);
        if let Some([_, own]) = both.filter(|both| !is_same(*both)) {
            self.guessed.push(format!(
                "line {}: the sheet says that `{}` contributes {}, this model {}",
                row.line + 1,
                row.name,
                header.cell(self.cells, row.line, Column::Contribution).trim(),
                of_result.after(&Shortest(own).to_string())
            ));
        }
    }
}

/// The difference of two numbers without the digits that only rounding makes.
pub(super) fn difference(a: f64, b: f64) -> f64 {
    let decimals = 12 - elementary::log10(a.abs().max(b.abs())).ceil() as i32;
    let decimals = usize::try_from(decimals).unwrap_or_default().min(300);
    format!("{:.decimals$}", a - b).parse().unwrap_or(a - b)
}

/// A factor or its inverse, whichever is above 1.
fn far_from_one(factor: f64) -> f64 {
    factor.abs().max(1.0 / factor.abs())
}

/// Whether two contributions are the same number but for rounding.
fn is_same([a, b]: [f64; 2]) -> bool {
    a.max(b) <= CONTRIBUTIONS_DIFFER * a.min(b)
}

/// The unit of the result of which a coefficient is stated: what stands above the stroke, if that
/// times nothing else is the product.
fn of_coefficient(coefficient: &str, unit: &str) -> Option<String> {
    let (per, own) = (Unit::parse(coefficient).ok()?, Unit::parse(unit).ok()?);
    let whole = per.dimension().checked_mul(own.dimension())?;
    let scale = per.factor() * own.factor();
    let above = coefficient.split_once('/').map_or(coefficient, |(above, _)| above).trim();
    [above, unit].into_iter().map(str::trim).find_map(|text| {
        let found = Unit::parse(text).ok().filter(|_| !text.is_empty())?;
        let fits = found.dimension() == whole && (found.factor() / scale - 1.0).abs() < 1e-12;
        fits.then(|| text.to_owned())
    })
}

/// The standard uncertainty of a row, in its own unit.
pub(super) fn standard_uncertainty(row: &Row) -> Option<f64> {
    if row.width.is_none() {
        return row.std.filter(|u| *u > 0.0);
    }
    let divisor = || row.divisor.or_else(|| row.distribution.and_then(divisor_of)).unwrap_or(1.0);
    row.width.map(|width| width / divisor()).or(row.std).filter(|u| *u > 0.0)
}
