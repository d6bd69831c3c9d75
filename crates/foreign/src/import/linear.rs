//! The linear model of a budget that has no equation: the sum of its quantities, each times its
//! sensitivity coefficient.
//!
//! Coefficients are in the unit of the result per unit of the quantity. Budgets state that in a column
//! of its own, or leave it to the reader; where one row can be read in two ways, both are named.

mod open;
mod whole;

use super::Budget;
use super::columns::{Column, Header};
use super::rows::{Row, divisor_of};
use gumption_engine::decimal::{significant, to_15_digits};
use gumption_engine::number::{Shortest, elementary};
use gumption_units::Unit;
use open::{Factor, per, share_of_result};
use whole::Whole;
pub(super) use whole::are_all;

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

/// Units of numbers that a display or a converter counts.
const COUNTS: [&str; 5] = ["digit", "digits", "D", "LSB", "count"];

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
        let unit = self.unit_of_result(header, rows, result, measurand);
        let mut whole = Whole::of(&unit, rows, result)?;
        whole.has_variances = self.are_variances(header, rows);
        let factors = self.factors(header, rows, result, &whole)?;
        self.contributions(header, rows, &factors, &whole)?;
        let written = |x: f64| Shortest(x).to_string();
        let sum: f64 =
            rows.iter().zip(&factors).map(|(row, c)| c * row.estimate.unwrap_or(0.0)).sum();
        let estimate = result.and_then(|result| result.estimate);
        let mut terms = Vec::new();
        if estimate.is_none() {
            terms.extend(self.shift_of_temperatures(rows, &factors, &unit));
        }
        let sum = sum + terms.iter().sum::<f64>();
        let mut terms: Vec<String> = terms.into_iter().map(written).collect();
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

    /// What is taken from a sum in which Celsius temperatures are multiplied by coefficients of a result in
    /// another unit, and no estimate of the result is stated: those products, as their zero is none of the
    /// result's.
    fn shift_of_temperatures(&mut self, rows: &[Row], factors: &[f64], unit: &str) -> Option<f64> {
        let is_celsius = |unit: &str| Unit::parse(unit).is_ok_and(|unit| unit.is_celsius());
        if is_celsius(unit) {
            return None;
        }
        let mut shift = 0.0;
        for (row, factor) in rows.iter().zip(factors).filter(|(row, _)| is_celsius(&row.unit)) {
            let Some(estimate) = row.estimate.filter(|estimate| *estimate != 0.0) else { continue };
            self.guessed.push(format!(
                "line {}: `{}` counts in the result by what it differs from its estimate, {} {}, as a coefficient multiplies no temperature",
                row.line + 1,
                row.name,
                Shortest(estimate),
                row.unit
            ));
            shift -= factor * estimate;
        }
        Some(to_15_digits(shift)).filter(|shift| *shift != 0.0)
    }

    /// The row whose coefficient with the other sign makes the sheet's estimate, as the end of a
    /// sentence.
    pub(super) fn sign_that_explains(rows: &[Row], factors: &[f64], difference: f64) -> String {
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

    /// What the numbers of each row are multiplied by; `None` after a mistake.
    fn factors(
        &mut self,
        header: &Header,
        rows: &[Row],
        result: Option<&Row>,
        whole: &Whole,
    ) -> Option<Vec<f64>> {
        // where a sheet states units of coefficients, one without is a plain number
        let states_units = rows.iter().any(|row| !row.unit_of_sensitivity.is_empty());
        let factors: Vec<Option<Factor>> = rows
            .iter()
            .map(|row| self.coefficient(header, (row, rows), whole, states_units))
            .collect();
        self.settled(rows, factors.into_iter().collect::<Option<_>>()?, result, whole)
    }

    /// Compares the contributions that the sheet states with those of the model.
    fn contributions(
        &mut self,
        header: &Header,
        rows: &[Row],
        factors: &[f64],
        whole: &Whole,
    ) -> Option<()> {
        if whole.has_variances {
            self.compare_variances(header, rows, factors);
            return Some(());
        }
        self.relative_budget(header, rows, factors, whole)?;
        for (row, factor) in rows.iter().zip(factors) {
            self.compare_contribution(header, row, *factor, whole);
        }
        self.contradicting_contributions(header, rows, factors, whole)
    }

    /// The unit of the result: that of its row, else that of the first row whose coefficient says it, where
    /// quantities in per cent or ppm are shares of others.
    fn unit_of_result(
        &mut self,
        header: &Header,
        rows: &[Row],
        result: Option<&Row>,
        measurand: &str,
    ) -> String {
        let is_share = |unit: &str| Unit::parse(unit).is_ok_and(|unit| unit.is_relative());
        let is_one = |row: &Row| row.sensitivity.is_none_or(|c| c.abs() == 1.0);
        let of = |row: &Row| {
            if !row.unit_of_sensitivity.is_empty() {
                return of_coefficient(&row.unit_of_sensitivity, &row.unit);
            }
            (is_one(row) && !row.unit.is_empty()).then(|| row.unit.clone())
        };
        let found: Vec<(String, &Row)> =
            rows.iter().filter_map(|row| Some((of(row)?, row))).collect();
        let whole = found.iter().find(|(unit, row)| {
            let is_of_shares = Unit::parse(unit).is_ok_and(|of| of.dimension().is_none());
            !is_of_shares && row.estimate.is_some_and(|x| x != 0.0)
        });
        if let Some(result) = result.filter(|result| !result.unit.is_empty()) {
            // the unit of its uncertainty alone
            let is_figure = result.is_summary && is_share(&result.unit) && whole.is_some();
            if !is_figure {
                return result.unit.clone();
            }
        }
        let (unit, row) = match (whole, found.first()) {
            (Some(whole), Some((first, _))) if is_share(first) => whole,
            (_, Some(first)) => first,
            (_, None) => {
                let unit = self.unit_of_product(rows, measurand);
                if unit.is_empty() && rows.iter().any(|row| !row.unit.is_empty()) {
                    self.guessed.push(format!(
                        "nothing says the unit of {measurand}: write it into its row; it is taken for a plain \
                         number"
                    ));
                }
                return unit;
            }
        };
        let is_number = |row: &&Row| {
            let text = header.cell(self.cells, row.line, Column::Unit).trim();
            let is_known = text == "1" || row.estimate.is_some_and(|x| x != 0.0);
            let is_plain = row.sensitivity.is_some() && row.unit_of_sensitivity.is_empty();
            row.unit.is_empty() && is_plain && is_one(row) && is_known
        };
        if let Some(number) = rows.iter().find(is_number).filter(|_| is_share(unit)) {
            self.guessed.push(format!(
                "the unit of {measurand} is not given: it is taken for a plain number, as `{}` in line {}",
                number.name,
                number.line + 1
            ));
            return String::new();
        }
        self.guessed.push(format!(
            "the unit of {measurand} is not given: `{unit}` is taken, as of `{}` in line {}",
            row.name,
            row.line + 1
        ));
        unit.clone()
    }

    /// The usual unit of what the first coefficient with a unit makes of its quantity; empty for a plain
    /// number, or where there is none.
    fn unit_of_product<'r>(&mut self, rows: &'r [Row], measurand: &str) -> String {
        let of = |row: &'r Row| {
            let per = Unit::parse(&row.unit_of_sensitivity).ok()?;
            let own = Unit::parse(&row.unit).ok()?;
            let product = per.dimension().checked_mul(own.dimension())?;
            (!row.unit_of_sensitivity.is_empty() && !product.is_none()).then_some((product, row))
        };
        let Some((product, row)) = rows.iter().find_map(of) else { return String::new() };
        let unit = product.usual_unit();
        self.guessed.push(format!(
            "the unit of {measurand} is not given: `{unit}` is taken, as the coefficient of `{}` in line {} \
             is in `{}`",
            row.name,
            row.line + 1,
            row.unit_of_sensitivity
        ));
        unit
    }

    /// What a row's numbers are multiplied by; `None` after a mistake.
    fn coefficient(
        &mut self,
        header: &Header,
        (row, rows): (&Row, &[Row]),
        result: &Whole,
        states_units: bool,
    ) -> Option<Factor> {
        let (unit, whole) = (result.text, &result.unit);
        let own = Unit::parse(&row.unit).ok()?;
        if let Some(c) = row.sensitivity.filter(|_| states_units) {
            return self.with_unit_of_coefficient(header, row, c, result).map(Factor::Known);
        }
        let line = row.line + 1;
        // what one digit is of the result only its coefficient says
        let is_count = COUNTS.contains(&row.unit.as_str()) && row.unit != unit;
        let scale = Unit::conversion_factor(&own, whole).ok();
        let scale = scale.filter(|_| !is_count || row.sensitivity.is_some());
        let shifted = own.offset() != whole.offset();
        let c = row.sensitivity.unwrap_or(1.0);
        // a coefficient multiplies differences, whose zeros do not matter
        let known = match scale.filter(|_| !shifted || row.sensitivity.is_some()) {
            Some(1.0) => c,
            Some(scale) if row.sensitivity.is_none() => {
                let of = match row.unit.as_str() {
                    "" => "without a unit".to_owned(),
                    unit => format!("in {unit}"),
                };
                self.guessed
                    .push(format!("line {line}: `{}` {of} is converted to {unit}", row.name));
                scale
            }
            Some(scale) if (c.abs() / scale - 1.0).abs() < 1e-6 => c,
            // nearer to a plain factor than to the ratio of the two units
            Some(scale) if far_from_one(c) < far_from_one(c / scale) => {
                self.of_one_dimension(header, row, scale, result)?
            }
            Some(_) => c,
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
                return None;
            }
            None => return Some(self.across(header, (row, rows), c, result)),
        };
        Some(Factor::Known(known))
    }

    /// The factor of a coefficient in a sheet that states units of coefficients; one without is a plain
    /// number.
    fn with_unit_of_coefficient(
        &mut self,
        header: &Header,
        row: &Row,
        c: f64,
        result: &Whole,
    ) -> Option<f64> {
        let (unit, whole) = (result.text, &result.unit);
        let own = Unit::parse(&row.unit).ok()?;
        let stated = match row.unit_of_sensitivity.as_str() {
            "" => "1",
            stated => stated,
        };
        let Ok(per) = Unit::parse(stated) else {
            self.fail(row.line, format!("the unit `{stated}` of the coefficient is not known"));
            return None;
        };
        let product = per.dimension().checked_mul(own.dimension());
        if product == Some(whole.dimension()) {
            let scale = per.factor() * own.factor() / whole.factor();
            let is_one = (scale - 1.0).abs() < 1e-12;
            // each step rounded once
            return Some(if is_one { c } else { whole.from_si(own.to_si(per.to_si(c))) });
        }
        let found = product.map_or_else(String::new, |found| {
            let of_result = match unit {
                "" => "a plain number".to_owned(),
                unit => format!("in `{unit}`"),
            };
            format!(", {}, where the result is {of_result}", found.describe())
        });
        let is_plain = row.unit_of_sensitivity.is_empty();
        if let Some(factor) =
            self.by_stated_contribution(header, row, c, result).filter(|_| is_plain)
        {
            return Some(factor);
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
        None
    }

    /// The factor of a coefficient without a unit of a quantity in another unit of the dimension of the
    /// result, by its contribution; `None` after a mistake.
    fn of_one_dimension(
        &self,
        header: &Header,
        row: &Row,
        scale: f64,
        result: &Whole,
    ) -> Option<f64> {
        let c = row.sensitivity.unwrap_or(1.0);
        let fits = |c: &f64| self.contribution(header, row, *c, result).is_some_and(is_same);
        let of_result = share_of_result(row, c, result).map(|share| share.factor);
        // a plain number of 1 has one reading less
        let of_result = of_result.filter(|of| !result.unit.is_relative() && *of != c * scale);
        let readings = [Some(c), Some(c * scale), of_result];
        let mut fitting = readings.into_iter().flatten().filter(fits);
        if let (Some(only), None) = (fitting.next(), fitting.next()) {
            return Some(only);
        }
        let (own, unit) = (row.unit.as_str(), result.text);
        let alike = if unit.is_empty() { own } else { unit };
        let third = of_result.map_or(String::new(), |of| {
            let of = per(of, unit, own);
            format!(", or {} {own} of the result per {own}, which is {of}", Shortest(c))
        });
        let reason = format!(
            "the coefficient {} of `{}` in {} can be {} or {}, which is {}{third}; write that with a column \
             `Unit of c_i`, or the quantity {}",
            Shortest(c),
            row.name,
            if own.is_empty() { "plain numbers" } else { own },
            per(c, unit, own),
            per(c, alike, alike),
            per(c * scale, unit, own),
            if unit.is_empty() { "as a plain number".to_owned() } else { format!("in {unit}") },
        );
        self.fail(row.line, reason);
        None
    }

    /// A coefficient that is stated in the unit of the contributions and not in that of the result, where
    /// the row's contribution says so; and that unit.
    fn by_contribution<'h>(
        &self,
        header: &'h Header,
        row: &Row,
        c: f64,
        whole: &Whole,
    ) -> Option<(f64, &'h str)> {
        let unit = header.unit(Column::Contribution)?;
        let scale = Unit::conversion_factor(&Unit::parse(unit).ok()?, &whole.unit).ok()?;
        let fits = |c: f64| self.contribution(header, row, c, whole).is_some_and(is_same);
        (scale != 1.0 && !fits(c) && fits(c * scale)).then_some((c * scale, unit))
    }

    /// Refuses contributions of which some are those of the model and others a power of ten from it: the
    /// unit of the result, or a coefficient, is another one then.
    fn contradicting_contributions(
        &self,
        header: &Header,
        rows: &[Row],
        factors: &[f64],
        whole: &Whole,
    ) -> Option<()> {
        let unit = whole.text;
        let ratio = |(row, factor): (&Row, &f64)| {
            let [stated, own] = self.contribution(header, row, *factor, whole)?;
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
    fn compare_contribution(&mut self, header: &Header, row: &Row, factor: f64, whole: &Whole) {
        let both = self.contribution(header, row, factor, whole);
        if let Some([_, own]) = both.filter(|both| !is_same(*both)) {
            self.guessed.push(format!(
                "line {}: the sheet says that `{}` contributes {}, this model {}",
                row.line + 1,
                row.name,
                header.cell(self.cells, row.line, Column::Contribution).trim(),
                self.in_unit_of_contribution(header, row, own, whole)
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
