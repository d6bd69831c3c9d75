//! Coefficients without a unit that can be read in two ways, because their quantity is of another dimension
//! than the result: 1 beside a quantity in ppm and a result in V is 1 V/ppm, or 1 ppm of the result per ppm.
//!
//! The sheet's contributions decide, or its combined or expanded uncertainty; else both are told.

use super::whole::Whole;
use super::{is_same, standard_uncertainty};
use crate::import::Budget;
use crate::import::columns::{Column, Header};
use crate::import::rows::{Row, is_near};
use gumption_engine::decimal::{significant, to_15_digits};
use gumption_engine::number::Shortest;
use gumption_units::Unit;

/// What a row's numbers are multiplied by.
pub(super) enum Factor {
    Known(f64),
    Open(Open),
}

/// A coefficient that is not clear.
pub(super) struct Open {
    /// As units of the result per unit of the quantity.
    plain: Reading,
    /// As a share of the result; `None` where a linear model has no other reading.
    other: Option<Reading>,
    /// What the sheet has to say.
    reason: String,
}

/// One reading of a coefficient.
pub(super) struct Reading {
    pub(super) factor: f64,
    words: String,
}

/// Exponents that products of powers have.
const EXPONENTS: [f64; 6] = [0.5, 1.0, 1.5, 2.0, 3.0, 4.0];

/// An estimate is written as a coefficient with an error of no more than this share.
const WRITTEN: f64 = 0.01;

/// A number in a unit per another one, of which either may be empty.
pub(super) fn per(number: f64, unit: &str, own: &str) -> String {
    let number = Shortest(to_15_digits(number));
    match (unit, own) {
        ("", "") => number.to_string(),
        ("", own) => format!("{number} per {own}"),
        (unit, "") => format!("{number} {unit}"),
        (unit, own) => format!("{number} {unit}/{own}"),
    }
}

/// Whether a coefficient may be an exponent.
fn is_exponent(c: f64) -> bool {
    EXPONENTS.contains(&c.abs())
}

/// The product of powers of which the coefficients are the exponents, where they can be that.
fn product_of_powers(rows: &[Row]) -> Option<String> {
    let power = |row: &Row| {
        let c = row.sensitivity.filter(|c| is_exponent(*c))?;
        row.estimate.filter(|estimate| *estimate != 0.0)?;
        Some(match c {
            1.0 => row.name.clone(),
            c if c < 0.0 => format!("{}^({})", row.name, Shortest(c)),
            c => format!("{}^{}", row.name, Shortest(c)),
        })
    };
    let powers: Vec<String> = rows.iter().map(power).collect::<Option<_>>()?;
    (powers.len() > 1).then(|| powers.join("*"))
}

impl Budget<'_> {
    /// The factor of a coefficient without a unit, whose quantity is of another dimension than the result.
    pub(super) fn across(
        &mut self,
        header: &Header,
        (row, rows): (&Row, &[Row]),
        c: f64,
        whole: &Whole,
    ) -> Factor {
        let fits = |c: f64| self.contribution(header, row, c, whole).is_some_and(is_same);
        let other = share_of_result(row, c, whole);
        let is_certain = standard_uncertainty(row).is_none() && row.estimate.unwrap_or(0.0) == 0.0;
        let plain = Reading { factor: c, words: per(c, whole.text, &row.unit) };
        if let Some((found, of)) = self.by_contribution(header, row, c, whole) {
            self.taken_by(row, &format!("in `{of}` per {}", row.unit), "contribution");
            return Factor::Known(found);
        }
        let other_fits = other.as_ref().is_some_and(|other| fits(other.factor));
        match (fits(c), other_fits) {
            (false, true) => {
                let words = other.as_ref().map_or("", |other| &other.words);
                self.taken_by(row, &format!("as {words}"), "contribution");
                return Factor::Known(other.map_or(c, |other| other.factor));
            }
            (false, false) if per_one(row, c).is_some_and(fits) => {
                self.taken_by(row, &format!("in `{}` per unit one", whole.text), "contribution");
                return Factor::Known(per_one(row, c).unwrap_or(c));
            }
            (is_it, _) if is_it && !other_fits || is_certain => {}
            _ if self.is_doubtful(header, row, c, whole) => {
                let reason = reason(row, rows, [&plain, other.as_ref().unwrap_or(&plain)], whole);
                return Factor::Open(Open { plain, other, reason });
            }
            _ => {}
        }
        if c.abs() == 1.0 && row.unit != whole.text && !whole.text.is_empty() {
            self.guessed.push(format!(
                "line {}: the coefficient {} of `{}` is taken in `{}` per {}",
                row.line + 1,
                Shortest(c),
                row.name,
                whole.text,
                if row.unit.is_empty() { "unit one" } else { row.unit.as_str() },
            ));
        }
        Factor::Known(c)
    }

    /// The factor of a coefficient without a unit beside others with one, where the row's contribution says
    /// what it is.
    pub(super) fn by_stated_contribution(
        &mut self,
        header: &Header,
        row: &Row,
        c: f64,
        whole: &Whole,
    ) -> Option<f64> {
        let fits = |c: f64| self.contribution(header, row, c, whole).is_some_and(is_same);
        let other = share_of_result(row, c, whole).filter(|other| fits(other.factor));
        match (fits(c), other) {
            (true, None) => {
                let of = if row.unit.is_empty() { "unit one" } else { &row.unit };
                self.taken_by(row, &format!("in `{}` per {of}", whole.text), "contribution");
                Some(c)
            }
            (false, Some(other)) => {
                self.taken_by(row, &format!("as {}", other.words), "contribution");
                Some(other.factor)
            }
            _ => None,
        }
    }

    /// Says how a coefficient is taken, as some figure of the sheet has it.
    fn taken_by(&mut self, row: &Row, how: &str, figure: &str) {
        self.guessed.push(format!(
            "line {}: the coefficient {} of `{}` is taken {how}, as its {figure} has it",
            row.line + 1,
            Shortest(row.sensitivity.unwrap_or(1.0)),
            row.name
        ));
    }

    /// Whether a coefficient without a unit can be something else than units of the result per unit of its
    /// quantity: 1, the estimate of the result, or an exponent.
    fn is_doubtful(&self, header: &Header, row: &Row, c: f64, whole: &Whole) -> bool {
        // a factor near 1 in a budget of relative uncertainties may be one of a product
        let is_of_relative = header.has(Column::Relative)
            && is_exponent(c)
            && row.estimate.is_some_and(|estimate| estimate != 0.0);
        if row.unit.is_empty() && !is_of_relative {
            return false;
        }
        let is_share = |unit: &str| Unit::parse(unit).is_ok_and(|own| own.is_relative());
        let is_estimate = |of: f64| is_near(c.abs(), of.abs(), WRITTEN);
        // a contribution in units of the result is none of a relative budget
        let contributes =
            self.contribution_of_cell(header, row).is_some_and(|(_, unit)| !is_share(unit));
        let may_be_power = is_exponent(c)
            && row.estimate.is_some_and(|estimate| estimate != 0.0)
            && (header.has(Column::Relative) || !whole.is_stated && !contributes);
        c.abs() == 1.0
            || is_share(&row.unit) && whole.estimate.is_some_and(is_estimate)
            || may_be_power
    }

    /// The factors where the figures of the result decide on those that are open; `None` where they do not,
    /// which is a mistake.
    pub(super) fn settled(
        &mut self,
        rows: &[Row],
        factors: Vec<Factor>,
        result: Option<&Row>,
        whole: &Whole,
    ) -> Option<Vec<f64>> {
        let with = |is_other: bool| {
            let of = |factor: &Factor| match factor {
                Factor::Known(c) => Some(*c),
                Factor::Open(Open { other, .. }) if is_other => Some(other.as_ref()?.factor),
                Factor::Open(Open { plain, .. }) => Some(plain.factor),
            };
            factors.iter().map(of).collect::<Option<Vec<f64>>>()
        };
        let open: Vec<(&Row, &Open)> = rows
            .iter()
            .zip(&factors)
            .filter_map(|(row, factor)| match factor {
                Factor::Open(open) => Some((row, open)),
                Factor::Known(_) => None,
            })
            .collect();
        if open.is_empty() {
            return with(false);
        }
        let both = [with(false), with(true)];
        let fits = both.each_ref().map(|factors| {
            let factors = factors.as_ref();
            factors.is_some_and(|factors| has_figures(rows, factors, result, whole))
        });
        if fits[0] == fits[1] {
            open.iter().for_each(|(row, open)| self.fail(row.line, open.reason.clone()));
            return None;
        }
        for (row, open) in open {
            let words = match &open.other {
                Some(other) if fits[1] => other.words.clone(),
                _ => open.plain.words.clone(),
            };
            self.guessed.push(format!(
                "line {}: the coefficient {} of `{}` is taken as {words}, as the uncertainty of the result \
                 has it",
                row.line + 1,
                Shortest(row.sensitivity.unwrap_or(1.0)),
                row.name
            ));
        }
        let [plain, other] = both;
        if fits[1] { other } else { plain }
    }

    /// Refuses contributions in per cent or ppm that are the relative uncertainties of the rows and not those
    /// of their sum: the result is a product then.
    pub(super) fn relative_budget(
        &self,
        header: &Header,
        rows: &[Row],
        factors: &[f64],
        whole: &Whole,
    ) -> Option<()> {
        let estimate = whole.estimate.filter(|_| !whole.has_variances);
        let Some(estimate) = estimate.map(f64::abs) else { return Some(()) };
        let shares: Option<Vec<[f64; 3]>> = rows
            .iter()
            .zip(factors)
            .map(|(row, factor)| {
                let (stated, unit) = self.contribution_of_cell(header, row)?;
                let unit = Unit::parse(unit).ok().filter(Unit::is_relative)?;
                let x = row.estimate.filter(|x| *x != 0.0)?;
                let u = standard_uncertainty(row)?;
                let own = (row.sensitivity.unwrap_or(1.0) * u / x).abs();
                Some([(stated * unit.factor()).abs(), own, (factor * u).abs() / estimate])
            })
            .collect();
        let Some(shares) = shares.filter(|shares| shares.len() > 1) else { return Some(()) };
        let are_relative = shares.iter().all(|[stated, own, _]| is_same([*stated, *own]));
        let other = shares.iter().position(|[stated, _, of_sum]| !is_same([*stated, *of_sum]));
        let Some(place) = other.filter(|_| are_relative) else { return Some(()) };
        let row = &rows[place];
        let product = product_of_powers(rows).map_or(String::new(), |of| format!(" (`y = {of}`)"));
        let reason = format!(
            "the contribution of `{}`, {} %, is its relative uncertainty, as in a product, and {} % in the sum \
             of the quantities: write the equation{product}, or correct the contributions",
            row.name,
            significant(100.0 * shares[place][0], 3),
            significant(100.0 * shares[place][2], 3)
        );
        self.fail(row.line, reason);
        None
    }
}

/// A coefficient of a quantity in ppm or per cent as that of a share of the result.
pub(super) fn share_of_result(row: &Row, c: f64, whole: &Whole) -> Option<Reading> {
    let own = Unit::parse(&row.unit).ok().filter(Unit::is_relative)?;
    let estimate = whole.estimate?.abs();
    // 10 V beside a result of 10 V is the derivative by the share
    let c = if is_near(c.abs(), estimate, WRITTEN) && c.abs() != 1.0 { c.signum() } else { c };
    let factor = to_15_digits(c * own.factor() * estimate);
    let words = format!("{} {} of the result per {}", Shortest(c), row.unit, row.unit);
    Some(Reading { factor, words })
}

/// A coefficient of a quantity in ppm or per cent as that of its number in unit one.
fn per_one(row: &Row, c: f64) -> Option<f64> {
    let own = Unit::parse(&row.unit).ok().filter(Unit::is_relative)?;
    Some(to_15_digits(c * own.factor()))
}

/// Why a coefficient is refused, with its readings.
fn reason(row: &Row, rows: &[Row], [plain, other]: [&Reading; 2], whole: &Whole) -> String {
    const WRITE: &str = "write its unit into a column `Unit of c_i`";
    let c = Shortest(row.sensitivity.unwrap_or(1.0));
    let name = &row.name;
    let (own, of_result) = (&row.unit, whole.text);
    let is_share = Unit::parse(own).is_ok_and(|own| own.is_relative());
    let begin = format!("the coefficient {c} of `{name}` in {own} can be {}", plain.words);
    if is_share && other.words != plain.words {
        return format!(
            "{begin} or {}, which is {}: {WRITE}, or the quantity in {of_result}",
            other.words,
            per(other.factor, of_result, own)
        );
    }
    if is_share {
        let of = if whole.unit.level_exponent().is_zero() {
            "the result"
        } else {
            "a power or an amplitude"
        };
        return format!(
            "{begin} or {c} {own} of {of} per {own}: {WRITE}, or the quantity in {of_result}"
        );
    }
    let equation = match product_of_powers(rows) {
        Some(product) => format!(
            ", or an exponent, as in a relative budget, whose result is a product of powers: write the \
             equation then (`y = {product}`)"
        ),
        None => format!(
            ", or lack its unit, as {own} and {} cannot be added: write the equation",
            if of_result.is_empty() { "a plain number" } else { of_result }
        ),
    };
    format!("{begin}{equation}, or {}", WRITE.replace("its unit", "the unit of the coefficient"))
}

/// Whether the uncertainties that the sheet states of its result, if any, are those of some factors.
fn has_figures(rows: &[Row], factors: &[f64], result: Option<&Row>, whole: &Whole) -> bool {
    let squares = rows
        .iter()
        .zip(factors)
        .map(|(row, c)| (c * standard_uncertainty(row).unwrap_or(0.0)).powi(2));
    let u = squares.sum::<f64>().sqrt();
    let figures = result.map_or(&[][..], |result| &result.figures);
    let mut known = figures
        .iter()
        .filter_map(|stated| stated.is_of([whole.estimate.unwrap_or(0.0), u], &whole.unit))
        .peekable();
    known.peek().is_some() && known.all(|is_it| is_it)
}
