//! The rows of a certificate as texts, rounded once for all formats.

use super::CertificateReport;
use crate::number::{exact, rounded};
use crate::printed::{value_text, with_symbols};
use crate::sheet::Figure;
use crate::{conditions_text, plain};
use gumption_analysis::certificate::contents::{Asked, Certificate, Language, Line};
use gumption_analysis::certificate::rounding::expanded;
use gumption_analysis::certificate::{Basis, Statement};
use gumption_engine::decimal::{Decimal, position, to_digits, to_position};
use gumption_engine::model::Quantity;
use gumption_engine::propagate::gum::Dof;
use gumption_engine::propagate::{Conformity, OutputEvaluation};
use gumption_engine::special::student;

/// Position of the last digit of coverage factors.
const FACTOR: i32 = -2;

/// Numerical standard errors of a coverage factor within one unit of its last digit: three on either
/// side.
const SCATTER: f64 = 6.0;

/// Significant digits of percentages; more would show binary rounding.
const PERCENT_DIGITS: u32 = 12;

/// Larger degrees of freedom are printed as infinite.
const MOST_DOF: f64 = 10_000.0;

/// The notation of units in words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum UnitsAre {
    /// In typographic notation.
    Printed,
    /// As in the model file.
    OfFile,
}

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub(super) struct StatedRow<'a> {
    /// Its number, from 1.
    pub(super) number: usize,
    pub(super) line: &'a Line,
    pub(super) asked: &'a Asked,
    /// What is measured.
    pub(super) quantity: &'a Quantity,
    /// Values of the conditions.
    pub(super) conditions: &'a [f64],
    pub(super) statement: &'a Statement,
    /// The evaluation of the output.
    pub(super) found: &'a OutputEvaluation,
}

/// All rows.
pub(super) fn rows<'a>(report: &CertificateReport<'a>) -> Vec<StatedRow<'a>> {
    let CertificateReport { certificate, issued, .. } = *report;
    let lines = certificate.lines.iter().zip(&issued.statements).enumerate();
    let rows = lines.filter_map(|(number, (line, statement))| {
        let asked = certificate.evaluations.get(line.evaluation)?;
        let row = issued.evaluations.get(line.evaluation)?.rows.get(line.row)?;
        Some(StatedRow {
            number: number + 1,
            line,
            asked,
            quantity: &asked.task.model.outputs.get(line.output)?.quantity,
            conditions: &row.conditions,
            statement,
            found: row.outputs.get(line.output)?,
        })
    });
    rows.collect()
}

/// The rows of each output, in order of first appearance.
pub(super) fn groups<'a>(report: &CertificateReport<'a>) -> Vec<Vec<StatedRow<'a>>> {
    let mut groups: Vec<Vec<StatedRow<'a>>> = Vec::new();
    for row in rows(report) {
        let same = |group: &&mut Vec<StatedRow<'_>>| {
            group.first().is_some_and(|first| {
                let (a, b) = (first.quantity, row.quantity);
                a.name == b.name && a.unit.text() == b.unit.text()
            })
        };
        match groups.iter_mut().find(same) {
            Some(group) => group.push(row),
            None => groups.push(vec![row]),
        }
    }
    groups
}

/// Whether all of these rows have a coverage probability, stated or reached.
pub(super) fn reach_something(rows: &[StatedRow<'_>]) -> bool {
    rows.iter().all(|row| row.reached().is_some())
}

impl StatedRow<'_> {
    /// Its number.
    pub(super) fn numbered(&self) -> Figure {
        Figure::of(self.number as f64, self.number.to_string())
    }

    /// The label of the row.
    pub(super) fn name(&self, languages: &[Language]) -> String {
        match &self.line.label {
            Some(label) => plain(&label.all(languages).join(" / ")),
            None => plain(&self.quantity.name),
        }
    }

    pub(super) fn value(&self) -> Figure {
        match self.statement.rounded_value() {
            Some(value) => figure(value),
            None => Figure::of(self.statement.value, exact(self.statement.value)),
        }
    }

    pub(super) fn expanded(&self) -> Figure {
        self.statement.rounded.map_or_else(|| Figure::of(0.0, "0".to_owned()), figure)
    }

    /// The decision about a tolerance, with the stated uncertainty (ISO/IEC 17025, 7.8.6).
    pub(super) fn conformity(&self) -> Option<Conformity> {
        let output = self.asked.task.model.outputs.get(self.line.output)?;
        let output = &*output.at(self.conditions);
        if !self.is_raised() {
            let own = self.found.conformity.as_deref();
            // the capability of the row may differ from that of the output
            return match own.filter(|own| own.stated_uncertainty.is_none()) {
                Some(own) => Some(*own),
                None => Conformity::evaluated(output, self.found, &self.asked.task.settings),
            };
        }
        let Statement { value, standard_uncertainty, expanded_uncertainty, .. } = *self.statement;
        Conformity::with_stated(output, value, standard_uncertainty, expanded_uncertainty)
    }

    /// Whether the uncertainty is the laboratory's capability.
    pub(super) fn is_raised(&self) -> bool {
        self.statement.limit.is_some_and(|limit| limit.raised)
    }

    /// Whether rounding by the rule of the certificate would have reduced U below the capability.
    pub(super) fn is_kept(&self, report: &CertificateReport<'_>) -> bool {
        let Certificate { digits, rounding, .. } = *report.certificate;
        let by_rule = expanded(self.statement.expanded_uncertainty, digits, rounding);
        by_rule.map(Decimal::value) != self.statement.rounded.map(Decimal::value)
    }

    /// The endpoints of the interval, if it may be stated: it must not be narrower than the
    /// laboratory's capability.
    pub(super) fn interval(&self, report: &CertificateReport<'_>) -> Option<[Figure; 2]> {
        let ends = self.statement.interval.filter(|_| !self.is_raised())?;
        let rounded = self.statement.rounded_interval(report.certificate.rounding);
        Some(match rounded {
            Some(ends) => ends.map(figure),
            None => ends.map(|end| Figure::of(end, exact(end))),
        })
    }

    pub(super) fn factor(&self) -> Figure {
        let factor = self.statement.coverage_factor;
        let place = self.factor_place();
        Figure::of(to_position(factor, place), rounded(factor, place))
    }

    /// The last digit of the coverage factor: with trials, a digit that another seed would not
    /// change, so that similar rows do not seem to differ.
    fn factor_place(&self) -> i32 {
        let trials = self.found.monte_carlo.as_deref();
        let (Basis::Shortest, Some(trials)) = (self.statement.basis, trials) else { return FACTOR };
        // results without noise do not depend on the seed
        if self.statement.without_trials {
            return FACTOR;
        }
        let interval = trials.stated_interval();
        let farther = interval.errors.into_iter().fold(0.0, f64::max);
        let error = farther / self.statement.standard_uncertainty;
        // if the error is unknown, the digits are unchanged
        let unsettled = |place: &i32| SCATTER * error > Decimal::new(1, *place).value();
        (FACTOR..0).find(|place| !unsettled(place)).unwrap_or(0)
    }

    /// Effective degrees of freedom, if k follows from them.
    pub(super) fn dof(&self) -> Figure {
        if self.statement.basis != Basis::Student || self.is_raised() {
            return Figure { text: String::new(), value: None };
        }
        self.evaluated_dof()
    }

    /// Effective degrees of freedom, their integer part (JCGM 100, G.4.1), of any row.
    pub(super) fn evaluated_dof(&self) -> Figure {
        match self.statement.dof {
            Dof::Finite(dof) if dof >= MOST_DOF => Figure { text: "∞".to_owned(), value: None },
            Dof::Infinite => Figure { text: "∞".to_owned(), value: None },
            Dof::Undefined => Figure::missing(),
            Dof::Finite(dof) if dof >= 1.0 => {
                let whole = (dof * (1.0 + 1e-9)).floor();
                Figure::of(whole, rounded(whole, 0))
            }
            Dof::Finite(dof) => Figure::of(dof, rounded(dof, -2)),
        }
    }

    /// The actual coverage probability of the interval: the stated one, or that of an agreed factor
    /// by the t distribution with the effective degrees of freedom. `None` if these are not
    /// defined, or if trials show another distribution.
    pub(super) fn reached(&self) -> Option<f64> {
        if self.statement.basis != Basis::Fixed {
            return self.statement.coverage_probability;
        }
        let gum = self.found.gum.as_ref()?;
        let Dof::Finite(exact) = gum.dof else { return None };
        let within = |dof: f64, k: f64| 1.0 - 2.0 * student::sf(k, dof);
        if !self.found.agrees(self.asked.task.settings.statement_tolerance) {
            return None;
        }
        let dof = self.evaluated_dof().value.unwrap_or(exact);
        let k = match self.statement.limit.filter(|limit| limit.raised) {
            // at least that of the evaluated one
            Some(_) => self.asked.task.settings.coverage.given_factor()?,
            None => self.statement.coverage_factor,
        };
        Some(within(dof, k))
    }

    /// The coverage probability in percent.
    pub(super) fn percent(&self) -> Figure {
        Figure::rounded(self.statement.coverage_probability.map(percent_of_coverage), exact)
    }

    pub(super) fn nominal(&self) -> Figure {
        Figure::rounded(self.line.nominal, exact)
    }

    /// The conditions in the table, with their values.
    pub(super) fn shown(&self, report: &CertificateReport<'_>) -> Vec<(&Quantity, f64)> {
        let shown = &report.certificate.shown;
        let conditions = self.asked.task.model.conditions.iter().zip(self.conditions);
        conditions
            .filter(|(condition, _)| shown.is_empty() || shown.contains(&condition.name))
            .map(|(condition, value)| (condition, *value))
            .collect()
    }

    /// Replacements and shown conditions in words, on one line; a row with its own label does not
    /// mention replacements.
    pub(super) fn circumstances(
        &self,
        report: &CertificateReport<'_>,
        units: UnitsAre,
    ) -> Vec<String> {
        let mut parts = if self.line.label.is_some() { Vec::new() } else { self.replaced(units) };
        let shown = self.shown(report);
        let written = |quantity: &Quantity| match units {
            UnitsAre::Printed => {
                Quantity { unit: with_symbols(&quantity.unit), ..quantity.clone() }
            }
            UnitsAre::OfFile => quantity.clone(),
        };
        let (quantities, values): (Vec<Quantity>, Vec<f64>) =
            shown.into_iter().map(|(quantity, value)| (written(quantity), value)).unzip();
        let conditions = conditions_text(&quantities, &values);
        parts.extend((!conditions.is_empty()).then_some(conditions));
        parts
    }

    /// Replacements of the row, as `tilt = 35 deg`.
    pub(super) fn replaced(&self, units: UnitsAre) -> Vec<String> {
        let unit = |name: &str| {
            let input = self.asked.task.model.inputs.iter().find(|i| i.quantity.name == name);
            input.map(|input| plain(input.quantity.unit.text())).filter(|unit| unit != "1")
        };
        let one = |(name, value): &(String, String)| {
            let value = match (value.parse::<f64>(), unit(name)) {
                (Ok(_), Some(unit)) => format!("{} {unit}", plain(value)),
                _ => plain(value),
            };
            let value = match units {
                UnitsAre::Printed => value_text(&value),
                UnitsAre::OfFile => value,
            };
            format!("{} = {value}", plain(name))
        };
        self.asked.set.iter().map(one).collect()
    }
}

/// A coverage probability in percent, to three decimals or two digits of the difference from 100:
/// 99.73 and 99.9937 for the factors 3 and 4.
pub(super) fn percent_of_coverage(share: f64) -> f64 {
    let missing = position(100.0 - 100.0 * share, 2).unwrap_or(-3);
    to_position(100.0 * share, missing.min(-3))
}

/// A share in percent, without the digits that its binary form adds.
pub(super) fn percent(share: f64) -> f64 {
    to_digits(100.0 * share, PERCENT_DIGITS)
}

/// A rounded number with its text.
fn figure(of: Decimal) -> Figure {
    Figure::of(of.value(), of.to_string())
}
