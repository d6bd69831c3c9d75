//! What a sheet says of its result, and what the model that was made of it says.
//!
//! A budget that was misread mostly gives another result than its sheet: comparing the two finds what
//! no look at a single cell would.

mod numbers;

use std::path::Path;

use super::Budget;
use super::columns::{self, Column, Header};
use super::coverage::HeaderCoverage;
use super::linear::are_all;
use super::number::{constant, number_with_unit};
use super::rows::{Row, without_factor, without_sign};
use gumption_engine::decimal::significant;
use gumption_engine::number::elementary;
use gumption_engine::propagate::gum::{self, Dof, Gum};
use gumption_files::read_text;
use gumption_units::Unit;

/// A figure of the result.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Figure {
    Estimate,
    StandardUncertainty,
    /// With its coverage, if the sheet states it, and its degrees of freedom.
    ExpandedUncertainty(HeaderCoverage, Option<f64>),
}

/// A figure of the result as the sheet states it.
#[derive(Clone, Debug)]
pub(super) struct Stated {
    line: usize,
    figure: Figure,
    /// As it is written.
    text: String,
    value: f64,
    /// Half of a unit of its last digit.
    half_digit: f64,
    /// Empty where the sheet states none.
    unit: String,
    /// Whether it is a share of the estimate by its heading.
    is_share: bool,
}

/// What shares of an estimate are of; `None` of 0, of levels and of temperatures in °C, which count from no
/// zero.
pub(super) fn share_of(unit: &Unit, estimate: f64) -> Option<f64> {
    let counts = unit.zero().is_none() && unit.level_exponent().is_zero();
    Some(estimate.abs()).filter(|whole| counts && *whole > 0.0 && whole.is_finite())
}

/// Figures differ from this share on where digits do not tell: parts of a budget are rounded too.
const ROUNDED_PARTS: f64 = 0.02;

/// Estimates differ from this share of the standard uncertainty on.
const MATTERS: f64 = 0.1;

/// An estimate that differs by more than this share, and by more than its expanded uncertainty, is that of
/// another model.
const LARGE: f64 = 0.05;

/// Uncertainties that differ by more than this factor, and by more than rounding, are those of other rows
/// or divisors; parts that are neglected or rounded make less.
const FAR: f64 = 1.25;

/// A model's result by the law of propagation, and its unit.
fn result_of(model: &str) -> Option<(Gum, Unit)> {
    let file = read_text("the model", model, Path::new(""), &[]).ok()?;
    let evaluated = gum::evaluate(&file.task, file.task.rows.first()?);
    let output = file.task.model.outputs.first()?;
    Some((evaluated.outputs.into_iter().next()??, output.quantity.unit.clone()))
}

/// Whether a model without a check of units has all estimates that a sheet states, of which there is one.
pub(super) fn is_of_numbers(model: &str, stated: &[Stated]) -> bool {
    let Some((gum, unit)) = result_of(model) else { return false };
    let mut estimates = stated.iter().filter(|of| of.figure == Figure::Estimate).peekable();
    estimates.peek().is_some()
        && estimates.all(|of| {
            of.scale(&unit).is_some_and(|scale| of.is_near(gum.estimate, scale, 0.0))
                && of.value != 0.0
        })
}

impl Stated {
    /// What one of the sheet's unit is in that of the result; `None` where one is not the other, or an
    /// estimate counts from another zero.
    fn scale(&self, of_result: &Unit) -> Option<f64> {
        let unit = match self.unit.as_str() {
            "" => of_result.clone(),
            unit => Unit::parse(unit).ok()?,
        };
        let counts_alike = unit.has_zero_of(of_result) || self.figure != Figure::Estimate;
        Unit::conversion_factor(&unit, of_result).ok().filter(|_| counts_alike)
    }

    /// What its number is multiplied by for one in the unit of a result of this estimate: to convert it, and
    /// for an uncertainty in per cent or ppm as a share of the estimate.
    fn scales(&self, of_result: &Unit, estimate: f64) -> Vec<f64> {
        let size = Unit::parse(&self.unit).ok();
        let size =
            size.filter(|unit| unit.is_relative() || self.is_share).map(|unit| unit.factor());
        let share = size.filter(|_| self.figure != Figure::Estimate);
        let share = share.and_then(|size| Some(size * share_of(of_result, estimate)?));
        self.scale(of_result).filter(|_| !self.is_share).into_iter().chain(share).collect()
    }

    /// Whether the number times this factor is one of the model, but for rounding and for a slack.
    fn is_near(&self, own: f64, scale: f64, slack: f64) -> bool {
        (self.value * scale - own).abs() <= 1.2 * self.half_digit * scale.abs() + slack
    }

    /// Whether an uncertainty is that of a result with this estimate and standard uncertainty; `None` of an
    /// estimate, and of what cannot be compared.
    pub(super) fn is_of(&self, [estimate, u]: [f64; 2], of_result: &Unit) -> Option<bool> {
        let own = match self.figure {
            Figure::Estimate => return None,
            Figure::StandardUncertainty => u,
            Figure::ExpandedUncertainty(coverage, dof) => u * coverage.factor(dof).unwrap_or(2.0),
        };
        let scales = self.scales(of_result, estimate);
        let is_it = |scale: &f64| self.is_near(own, *scale, ROUNDED_PARTS * own);
        (!scales.is_empty()).then(|| scales.iter().any(is_it))
    }
}

impl Budget<'_> {
    /// What a row of the result, or of a summary, states.
    pub(super) fn stated(&self, header: &Header, line: usize, row: &Row) -> Vec<Stated> {
        let label = header.cell(self.cells, line, Column::Quantity).trim();
        let symbol = header.cell(self.cells, line, Column::Symbol).trim();
        let is_symbol = |texts: &[&str]| {
            [label, symbol].iter().any(|text| {
                let compact: String =
                    text.split('(').next().unwrap_or_default().split_whitespace().collect();
                texts.contains(&compact.as_str())
            })
        };
        let is_expanded = columns::is_expanded(label)
            || is_symbol(&["U"])
            || [label, symbol]
                .into_iter()
                .any(|words| columns::probability_of_symbol(words).is_some());
        let is_uncertainty =
            is_expanded || columns::is_of_uncertainty(label) || is_symbol(&["u", "uc", "u_c"]);
        let divisor = header.cell(self.cells, line, Column::Divisor);
        let comma = self.cells.decimal_comma();
        let of_divisor = constant(divisor, comma).filter(|factor| *factor > 0.0);
        let coverage = match HeaderCoverage::of(label) {
            HeaderCoverage::None | HeaderCoverage::Expanded => {
                of_divisor.map_or(HeaderCoverage::None, HeaderCoverage::Factor)
            }
            stated => stated,
        };
        let columns =
            [Column::Estimate, Column::Width, Column::Std, Column::Relative, Column::Contribution];
        let mut found = Vec::new();
        for column in columns {
            let text = header.cell(self.cells, line, column).trim();
            let digits = without_factor(without_sign(text));
            let Some((value, unit)) = number_with_unit(digits, comma) else { continue };
            let expanded = Figure::ExpandedUncertainty(coverage, row.dof);
            let figure = match column {
                Column::Estimate if !is_uncertainty => Figure::Estimate,
                Column::Width if !is_expanded => {
                    let all = [coverage, HeaderCoverage::of(text), header.coverage(column)];
                    match all.into_iter().find(|of| of.factor(None).is_some()) {
                        Some(coverage) => Figure::ExpandedUncertainty(coverage, row.dof),
                        None if is_uncertainty => Figure::StandardUncertainty,
                        None => continue,
                    }
                }
                _ if is_expanded => expanded,
                _ => Figure::StandardUncertainty,
            };
            // the number of a cell in per cent is a share already
            let is_percent = unit.is_empty() && digits.ends_with('%');
            let value = if is_percent { 100.0 * value } else { value };
            let of_header = header.unit(column);
            let is_in_percent =
                is_percent || unit == "%" || unit.is_empty() && of_header == Some("%");
            // all of the variance
            let is_whole = column == Column::Contribution && is_in_percent && are_all(value);
            if is_whole || value == 0.0 && figure != Figure::Estimate {
                continue;
            }
            let unit = match (unit, of_header) {
                ("", _) if is_percent => "%",
                ("", Some(of_header)) => of_header,
                ("", None) if column == Column::Relative => "",
                ("", None) => row.unit.as_str(),
                (unit, _) => unit,
            };
            found.push(Stated {
                line,
                figure,
                text: text.to_owned(),
                value,
                half_digit: half_digit(digits),
                unit: unit.to_owned(),
                is_share: column == Column::Relative,
            });
        }
        found
    }

    /// The model without a check of units where numbers stand for units in its equation: its estimate is
    /// that of the sheet times a power of ten, and without the check it is that of the sheet. `model` is
    /// the model file with the check or without it.
    pub(super) fn of_numbers(
        &mut self,
        made: String,
        stated: &[Stated],
        model: &impl Fn(bool) -> String,
    ) -> String {
        let estimates = || stated.iter().filter(|stated| stated.figure == Figure::Estimate);
        let of = |result: &(Gum, Unit), stated: &Stated| {
            Some(result.0.estimate / stated.scale(&result.1)?)
        };
        let Some(checked) = result_of(&made) else { return made };
        let decides = |stated: &Stated| !stated.scales(&checked.1, checked.0.estimate).is_empty();
        if !stated.iter().any(decides) {
            let without = model(false);
            if without != made {
                self.converted_twice(&made, &without);
            }
            return made;
        }
        let converts = numbers::converting(&made).is_some() || numbers::may_convert(&made);
        let is_scaled = |stated: &Stated| {
            let own = of(&checked, stated)?;
            // 60 of rpm is no power of ten
            if converts && (own - stated.value).abs() > LARGE * own.abs() {
                return Some(true);
            }
            let ratio = elementary::log10(own / stated.value);
            let power = ratio.round();
            let value = stated.value * elementary::pow(10.0, power);
            let half = stated.half_digit * elementary::pow(10.0, power);
            Some(power != 0.0 && (own - value).abs() <= 1.2 * half)
        };
        let Some(first) = estimates().find(|stated| is_scaled(stated) == Some(true)) else {
            return made;
        };
        let without = model(false);
        let unchecked = result_of(&without);
        let is_it = |stated: &Stated| {
            let own = unchecked.as_ref().and_then(|result| of(result, stated));
            own.is_some_and(|own| (own - stated.value).abs() <= 1.2 * stated.half_digit)
        };
        if without == made || !estimates().all(is_it) {
            return made;
        }
        self.guessed.push(format!(
            "line {}: the equation has numbers in place of units: it gives the estimate {} of the sheet with \
             the numbers of the rows in their own units, and another one with a check of units; units are \
             not checked",
            first.line + 1,
            first.text
        ));
        without
    }

    /// Tells where the sheet's figures of the result are not those of the model, and refuses what no
    /// rounding explains, unless the sheet has a correlation that is not taken; `factor` is the coverage
    /// factor that the sheet states for all.
    pub(super) fn compare(
        &mut self,
        model: &str,
        stated: &[Stated],
        factor: Option<f64>,
    ) -> Option<()> {
        let is_clean = self.log.is_clean();
        self.compare_figures(model, stated, factor);
        (!is_clean || self.log.is_clean()).then_some(())
    }

    fn compare_figures(&mut self, model: &str, stated: &[Stated], factor: Option<f64>) {
        let Some((gum, of_result)) = result_of(model) else { return };
        let is_correlated = (0..self.cells.lines())
            .any(|line| self.cells.row(line).iter().any(|cell| columns::is_of_correlation(cell)));
        for stated in stated {
            let scales = stated.scales(&of_result, gum.estimate);
            let Some(scale) = scales.first().copied() else { continue };
            let u = gum.standard_uncertainty;
            let near = |own: f64, slack: f64| {
                scales.iter().any(|scale| stated.is_near(own, *scale, slack))
            };
            let (own, is_same, what) = match stated.figure {
                Figure::Estimate => (gum.estimate, near(gum.estimate, MATTERS * u), "the estimate"),
                Figure::StandardUncertainty => {
                    (u, near(u, ROUNDED_PARTS * u), "the standard uncertainty")
                }
                Figure::ExpandedUncertainty(coverage, dof) => {
                    let effective = if let Dof::Finite(dof) = gum.dof { Some(dof) } else { None };
                    let own = coverage.factor(dof.or(effective));
                    let k = own.or(factor).or(gum.coverage_factor).unwrap_or(2.0);
                    // of a probability the sheet may have the factor of a normal distribution
                    let is_same = [Some(k), coverage.factor(None)]
                        .into_iter()
                        .flatten()
                        .any(|k| near(k * u, ROUNDED_PARTS * k * u));
                    (k * u, is_same, "the expanded uncertainty")
                }
            };
            if is_same || !own.is_finite() {
                continue;
            }
            // both in the unit of the sheet
            let unit = match stated.unit.as_str() {
                "" if !stated.is_share => of_result.text(),
                unit => unit,
            };
            let with_unit = |number: String| match unit {
                unit if !number.ends_with(unit) => format!("{number} {unit}").trim_end().to_owned(),
                _ => number,
            };
            let digits = digits_for(stated.figure, own, u);
            let written = with_unit(significant(own / scale, digits));
            let text = with_unit(stated.text.clone());
            let said =
                format!("the sheet says that {what} of the result is {text}, this model {written}");
            let is_far = scales.iter().all(|scale| {
                let value = stated.value * scale;
                let far = (value - own).abs() - 1.2 * stated.half_digit * scale.abs();
                match stated.figure {
                    // an estimate near 0 has no share
                    Figure::Estimate => far > LARGE * own.abs() && far > 2.0 * u,
                    _ => far > 0.0 && (value / own).max(own / value) > FAR,
                }
            });
            if is_far && !is_correlated {
                // of a result of another dimension
                let is_relative = stated.scale(&of_result).is_none() || stated.is_share;
                let hint = match is_relative {
                    true => {
                        " (of a relative budget, whose result is a product of powers, write the equation)"
                    }
                    false => "",
                };
                let reason = format!(
                    "{said}: correct the row or the equation that is misread{hint}, or take this figure away"
                );
                self.fail(stated.line, reason);
            } else {
                self.guessed.push(format!("line {}: {said}", stated.line + 1));
            }
        }
    }
}

/// Digits of a figure of the model: an estimate to the place of the second digit of its uncertainty.
fn digits_for(figure: Figure, own: f64, u: f64) -> u32 {
    if figure != Figure::Estimate || own == 0.0 || u <= 0.0 {
        return 3;
    }
    let places = elementary::log10(own.abs() / u).ceil();
    (places + 2.0).clamp(3.0, 15.0) as u32
}

/// Half of a unit of the last digit of a number as it is written.
pub(super) fn half_digit(text: &str) -> f64 {
    let end = text.find(['e', 'E', '·', '×', '*']).unwrap_or(text.len());
    let (mantissa, rest) = text.split_at(end);
    let digits: String =
        mantissa.chars().filter(|c| c.is_ascii_digit() || matches!(c, '.' | ',')).collect();
    let decimals = digits.rsplit_once(['.', ',']).map_or(0, |(_, decimals)| decimals.len());
    let power: i32 = rest
        .trim_start_matches(['e', 'E', '·', '×', '*', ' '])
        .trim_start_matches("10^")
        .split(|c: char| !(c.is_ascii_digit() || c == '-'))
        .next()
        .and_then(|power| power.parse().ok())
        .unwrap_or(0);
    0.5 * elementary::pow(10.0, f64::from(power) - decimals as f64)
}

#[cfg(test)]
mod tests {
    use super::half_digit;

    #[test]
    fn digits_of_numbers() {
        for (text, half) in [
            ("34,3 nm", 0.05),
            ("12", 0.5),
            ("0.0242", 5e-5),
            ("1.5e-3", 5e-5),
            ("10 000,025 g", 5e-4),
        ] {
            assert!((half_digit(text) / half - 1.0).abs() < 1e-12, "{text}");
        }
    }
}
