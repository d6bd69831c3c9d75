//! What a sheet says of its result, and what the model that was made of it says.
//!
//! A budget that was misread gives another result than its sheet: comparing the two finds what no look at a
//! single cell would. A difference is an error that says both.

use super::ask::ReadSheet;
use super::columns::{self, Column};
use super::coverage::{HeaderCoverage, Statement};
use super::model::{ImportedModel, result_of};
use super::number::constant;
use super::rows::{Cell, OfResult, Row, RowKind, Rows};
use super::table::Header;
use gumption_engine::decimal::significant;
use gumption_engine::number::elementary;
use gumption_engine::propagate::gum::{Dof, Gum};
use gumption_units::Unit;

/// A figure of the result.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Figure {
    Estimate,
    Standard,
    Expanded(HeaderCoverage),
    /// A standard or an expanded uncertainty.
    Uncertainty,
}

/// A figure of the result as the sheet states it.
#[derive(Clone, Debug)]
pub(super) struct StatedFigure {
    line: usize,
    figure: Figure,
    pub(super) cell: Cell,
}

/// Figures of a budget whose parts are rounded differ by up to this share.
const ROUNDED_PARTS: f64 = 0.02;

/// Estimates differ from this share of the standard uncertainty on.
const MATTERS: f64 = 0.1;

impl StatedFigure {
    pub(super) fn is_estimate(&self) -> bool {
        self.figure == Figure::Estimate
    }

    pub(super) fn is_uncertainty(&self) -> bool {
        !self.is_estimate() && self.cell.value > 0.0
    }

    /// An estimate in a unit.
    pub(super) fn in_unit(&self, whole: &Unit) -> Option<f64> {
        self.scale(whole).map(|scale| self.cell.value * scale)
    }

    /// What one of its unit is in that of the result; `None` where one is not the other.
    fn scale(&self, of_result: &Unit) -> Option<f64> {
        if self.cell.unit.is_empty() {
            return Some(1.0);
        }
        let unit = Unit::parse(&self.cell.unit).ok()?;
        let counts_alike = unit.has_zero_of(of_result) || !self.is_estimate();
        Unit::conversion_factor(&unit, of_result).ok().filter(|_| counts_alike)
    }

    /// What its number is multiplied by for one in the unit of the result: to convert it, and for an uncertainty
    /// in per cent or ppm as a share of the estimate.
    fn scales(&self, of_result: &Unit, estimate: f64) -> Vec<f64> {
        let share = Unit::parse(&self.cell.unit)
            .ok()
            .filter(|unit| unit.is_relative() && !self.is_estimate());
        let share = share.filter(|_| estimate != 0.0).map(|unit| unit.factor() * estimate.abs());
        self.scale(of_result).into_iter().chain(share).collect()
    }
}

impl ReadSheet<'_> {
    /// The name of the result in its row; empty where it has the words of results alone.
    pub(super) fn name_of_result(&self, header: &Header, line: usize) -> String {
        let cells =
            [Column::Symbol, Column::Quantity].map(|column| header.cell(self.cells, line, column));
        let words = cells.into_iter().find(|text| !text.is_empty()).unwrap_or("");
        let clean = columns::plain_case(words);
        let name = columns::identifier(words.split('=').next().unwrap_or(""));
        let is_named = super::words::meaning("row", &clean).is_none()
            && gumption_engine::model::formula::check_name(&name).is_ok();
        if is_named { name } else { String::new() }
    }

    /// What the rows of the result state; `None` after a mistake.
    pub(super) fn stated(&self, header: &Header, rows: &Rows) -> Option<Vec<StatedFigure>> {
        let mut found = Vec::new();
        for row in &rows.of_result {
            found.extend(self.stated_by(header, *row)?);
        }
        let factor = rows
            .of_result
            .iter()
            .filter(|row| row.kind == RowKind::Factor)
            .find_map(|row| self.factor_of_row(row.line));
        if let Some(factor) = factor {
            for stated in &mut found {
                if let Figure::Expanded(
                    coverage @ (HeaderCoverage::None | HeaderCoverage::Expanded),
                ) = &mut stated.figure
                {
                    *coverage = HeaderCoverage::Factor(factor);
                }
            }
        }
        Some(found)
    }

    /// The one number of a row that states a coverage factor.
    fn factor_of_row(&self, line: usize) -> Option<f64> {
        let comma = self.cells.decimal_comma();
        let mut numbers = self.cells.row(line).iter().filter_map(|cell| constant(cell, comma));
        numbers.find(|factor| *factor > 0.0)
    }

    fn stated_by(
        &self,
        header: &Header,
        OfResult { line, kind }: OfResult,
    ) -> Option<Vec<StatedFigure>> {
        let mut found = Vec::new();
        if matches!(kind, RowKind::Factor) {
            return Some(found);
        }
        let uncertain = [
            Column::Standard,
            Column::Contribution,
            Column::Uncertainty,
            Column::Expanded,
            Column::HalfWidth,
        ];
        let own_unit = header.cell(self.cells, line, Column::Unit);
        let mut push = |cell: Cell, figure: Figure| {
            let unit = if cell.unit.is_empty() { own_unit.to_owned() } else { cell.unit.clone() };
            found.push(StatedFigure { line, figure, cell: Cell { unit, ..cell } });
        };
        let mut coverage = self.coverage_of_row(header, line);
        let mut has_uncertainty = false;
        for column in uncertain {
            let Some(place) = header.place(column) else { continue };
            // a word beside the numbers of a summary is no mistake
            if !self.cells.text(line, place).contains(|c: char| c.is_ascii_digit())
                || self.is_factor_cell(line, place)
            {
                continue;
            }
            let Some(cell) = self.number(header, line, place).ok()? else { continue };
            if cell.value == 0.0 {
                continue;
            }
            if coverage == HeaderCoverage::None && column == Column::Expanded {
                coverage = header.coverage(column);
            }
            // all of the variance
            let is_whole = column == Column::Contribution
                && cell.unit == "%"
                && (cell.value - 100.0).abs() < 1.5;
            if is_whole {
                continue;
            }
            has_uncertainty = true;
            push(
                cell,
                match (kind, column) {
                    (RowKind::Expanded, _) => Figure::Expanded(coverage),
                    (RowKind::Combined, _) => Figure::Standard,
                    (_, Column::Standard | Column::Contribution) => Figure::Standard,
                    (_, Column::Expanded) => Figure::Expanded(coverage),
                    _ if coverage.factor(None).is_some() => Figure::Expanded(coverage),
                    _ => Figure::Uncertainty,
                },
            );
        }
        if let Some(place) = header.place(Column::Estimate)
            && let Some(cell) = self.number(header, line, place).ok()?
        {
            push(
                cell,
                match kind {
                    RowKind::Result => Figure::Estimate,
                    _ if has_uncertainty => Figure::Estimate,
                    RowKind::Expanded => Figure::Expanded(coverage),
                    _ => Figure::Standard,
                },
            );
        }
        let is_nothing = found.is_empty();
        if is_nothing && let Some(stated) = self.beside_its_words(header, line, kind, coverage) {
            found.push(stated);
        }
        Some(found)
    }

    /// The one number of a row whose words stand right before it.
    fn beside_its_words(
        &self,
        header: &Header,
        line: usize,
        kind: RowKind,
        coverage: HeaderCoverage,
    ) -> Option<StatedFigure> {
        let figure = match kind {
            RowKind::Combined => Figure::Standard,
            RowKind::Expanded => Figure::Expanded(coverage),
            _ => return None,
        };
        let comma = self.cells.decimal_comma();
        let is_number = |place: &usize| {
            super::number::number_with_unit(self.cells.text(line, *place), comma).is_some()
        };
        let places: Vec<usize> = (0..self.cells.row(line).len()).filter(is_number).collect();
        let &[place] = places.as_slice() else { return None };
        let cell = self.number(header, line, place).ok()??;
        Some(StatedFigure { line, figure, cell })
    }

    fn is_factor_cell(&self, line: usize, place: usize) -> bool {
        let text = self.cells.text(line, place).trim().to_lowercase();
        text.starts_with('k') && text.contains('=')
    }

    /// The coverage that a row of the result states in its words, its divisor or its distribution.
    fn coverage_of_row(&self, header: &Header, line: usize) -> HeaderCoverage {
        let comma = self.cells.decimal_comma();
        let of_divisor = [Column::Divisor, Column::Factor].into_iter().find_map(|column| {
            constant(header.cell(self.cells, line, column), comma).filter(|factor| *factor > 1.0)
        });
        let mut of_words = HeaderCoverage::None;
        for cell in self.cells.row(line) {
            let stated = match Statement::of(cell) {
                Ok(statement) => statement.coverage,
                Err(_) => continue,
            };
            let of_symbol = columns::probability_of_symbol(&columns::plain_case(cell))
                .map(HeaderCoverage::Probability);
            if stated.factor(None).is_some() {
                of_words = stated;
            } else if let (HeaderCoverage::None, Some(p)) = (of_words, of_symbol) {
                of_words = p;
            }
        }
        match of_words {
            HeaderCoverage::Factor(_) => of_words,
            _ => of_divisor.map_or(of_words, HeaderCoverage::Factor),
        }
    }

    /// Refuses a model whose result, or whose contributions, are not those of the sheet.
    pub(super) fn compare(&self, rows: &[Row], stated: &[StatedFigure], model: &ImportedModel) {
        let Some((gum, of_result)) = result_of(&model.text) else { return };
        let (estimates, others): (Vec<&StatedFigure>, Vec<&StatedFigure>) =
            stated.iter().partition(|figure| figure.is_estimate());
        for stated in estimates.into_iter().chain(others) {
            self.compare_figure(stated, &gum, &of_result, model);
        }
        if let Some(factors) = &model.factors {
            self.compare_contributions(rows, factors, &gum, &of_result);
        }
    }

    fn compare_figure(
        &self,
        stated: &StatedFigure,
        gum: &Gum,
        of_result: &Unit,
        model: &ImportedModel,
    ) {
        let u = gum.standard_uncertainty;
        let dof = if let Dof::Finite(dof) = gum.dof { Some(dof) } else { None };
        let usual = || [gum.coverage_factor, Some(2.0)].into_iter().flatten();
        let (what, own, slack): (&str, Vec<f64>, f64) = match stated.figure {
            Figure::Estimate => ("the estimate", vec![gum.estimate], MATTERS * u),
            Figure::Standard => ("the standard uncertainty", vec![u], ROUNDED_PARTS * u),
            Figure::Expanded(coverage) => {
                // of a probability the sheet may have the factor of a normal distribution
                let said = [coverage.factor(dof), coverage.factor(None)].into_iter().flatten();
                let mut factors: Vec<f64> = said.collect();
                if factors.is_empty() {
                    factors.extend(usual());
                }
                let own: Vec<f64> = factors.into_iter().map(|k| k * u).collect();
                let slack = ROUNDED_PARTS * own[0];
                ("the expanded uncertainty", own, slack)
            }
            Figure::Uncertainty => {
                let own = std::iter::once(u).chain(usual().map(|k| k * u)).collect();
                ("the uncertainty", own, ROUNDED_PARTS * u)
            }
        };
        let cell = &stated.cell;
        let scales = stated.scales(of_result, gum.estimate);
        if scales.is_empty() {
            self.fail(stated.line, format!("the sheet says that {what} of the result is `{}` in `{}`, and this model has it in `{}`", cell.text, cell.unit, of_result.text()));
            return;
        }
        let is_near = |scale: f64, own: f64| {
            (cell.value * scale - own).abs() <= 1.2 * cell.half_digit * scale.abs() + slack
        };
        if scales.iter().any(|scale| own.iter().any(|own| is_near(*scale, *own))) {
            return;
        }
        let scale = scales[0];
        let digits = if stated.is_estimate() { digits_of(gum) } else { 3 };
        let unit = if cell.unit.is_empty() { of_result.text() } else { &cell.unit };
        let with_unit = |text: String| {
            if text.ends_with(unit) { text } else { format!("{text} {unit}").trim_end().to_owned() }
        };
        self.ask(
            stated.line..=stated.line,
            format!(
                "the sheet says that {what} of the result is {}, and this model {}",
                with_unit(cell.text.clone()),
                with_unit(significant(own[0] / scale, digits))
            ),
            ["a row or an equation that is misread, or wrong on the sheet", "a figure that does not count"],
            format!(
                "{}, an option for the row or the column that is misread, or `--row ignore={}`",
                match model.factors {
                    Some(_) => "`--coefficients KIND`",
                    None => "`--equation \"y = FORMULA\"`, `--numbers` (the equation is one of numbers)",
                },
                stated.line + 1
            ),
        );
    }

    /// Refuses contributions of rows that are not those of the model: in the unit of the result, as shares of its
    /// estimate, or as shares of its variance.
    fn compare_contributions(&self, rows: &[Row], factors: &[f64], gum: &Gum, of_result: &Unit) {
        let own: Vec<f64> = rows
            .iter()
            .zip(factors)
            .map(|(row, c)| (c * row.standard_uncertainty()).abs())
            .collect();
        let variance: f64 = own.iter().map(|u| u * u).sum();
        for (row, own) in rows.iter().zip(own) {
            let Some(cell) = &row.contribution else { continue };
            let unit = Unit::parse(&cell.unit).unwrap_or_default();
            let mut readings: Vec<f64> = Vec::new();
            if cell.unit.is_empty() {
                readings.push(own);
            } else if let Ok(scale) = Unit::conversion_factor(&unit, of_result) {
                readings.push(own / scale);
            }
            if unit.is_relative() || cell.unit.is_empty() && variance > 0.0 {
                let size = if cell.unit.is_empty() { 1.0 } else { unit.factor() };
                readings.extend(
                    (gum.estimate != 0.0)
                        .then(|| own / gum.estimate.abs() / size)
                        .filter(|_| unit.is_relative()),
                );
                readings.extend(unit.is_relative().then(|| own * own / variance / size));
            }
            let is_near = |reading: &f64| {
                (cell.value.abs() - reading).abs()
                    <= 1.2 * cell.half_digit + ROUNDED_PARTS * reading
            };
            if readings.iter().any(is_near) {
                continue;
            }
            let shown = readings
                .first()
                .map_or_else(|| "none in that unit".to_owned(), |reading| significant(*reading, 3));
            let in_unit = if cell.unit.is_empty() { of_result.text() } else { &cell.unit };
            self.ask(
                row.line..=row.line,
                format!(
                    "the sheet says that `{}` contributes `{}`{}, and this model {shown} {in_unit}",
                    row.name,
                    cell.text,
                    if cell.text.ends_with(in_unit) { String::new() } else { format!(" {in_unit}") }
                ),
                ["a row, a coefficient or a unit that is misread, or wrong on the sheet", "a column that does not count"],
                "`--coefficients units` or `--coefficients ratios`, `--unit UNIT`, or `--column ignore=COLUMN` for the contributions",
            );
        }
    }
}

/// Digits of an estimate to the place of the second digit of its uncertainty.
fn digits_of(gum: &Gum) -> u32 {
    let (estimate, u) = (gum.estimate, gum.standard_uncertainty);
    if estimate == 0.0 || u <= 0.0 {
        return 6;
    }
    (elementary::log10(estimate.abs() / u).ceil() + 2.0).clamp(3.0, 15.0) as u32
}
