//! An evaluated certificate: every model is evaluated once, then each row is stated.

use std::fmt;
use std::sync::Arc;

use super::correlations::{self, RowCorrelations};
use super::statement::{self, Statement, StatementRules};
use crate::certificate::contents::Certificate;
use gumption_engine::propagate::{Control, Evaluation, EvaluationError, evaluate};
use gumption_engine::task::StatementMethod;

/// The results of a certificate.
#[derive(Clone, Debug)]
pub struct Issued {
    /// The evaluations, in the certificate's order.
    pub evaluations: Vec<Evaluation>,
    /// The statements, row by row.
    pub statements: Vec<Statement>,
    /// Correlation coefficients between the rows by the law of propagation: the full matrix, with 1
    /// on its diagonal. `None` if a result has no finite sensitivity coefficients, or zero
    /// uncertainty. The part that raises a row to the laboratory's capability is uncorrelated with
    /// all other rows.
    pub correlations: Vec<Vec<Option<f64>>>,
    /// The standard uncertainties to which the coefficients belong: by the law of propagation, or
    /// the stated one for a row raised to the laboratory's capability.
    pub spreads: Vec<Option<f64>>,
    /// The names of the inputs that are one unknown value of two rows or more, in order.
    pub shared_inputs: Vec<String>,
    /// Whether the evaluation was stopped before all trials were drawn.
    pub stopped: bool,
}

impl Issued {
    /// Standard uncertainty of the difference between two rows of the same unit, in that unit;
    /// `None` if their correlation is unknown.
    pub fn difference(&self, first: usize, second: usize) -> Option<f64> {
        let u = |row: usize| self.spreads.get(row).copied().flatten();
        let (a, b) = (u(first)?, u(second)?);
        let r = (*self.correlations.get(first)?.get(second)?)?;
        Some((a * a + b * b - 2.0 * r * a * b).max(0.0).sqrt())
    }
}

/// Why a certificate cannot be issued.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Failed {
    /// An evaluation that is not possible.
    Evaluation {
        /// Which one.
        evaluation: usize,
        /// Why not.
        error: EvaluationError,
    },
    /// A row that names an unknown evaluation, row of conditions, or output.
    NoResult {
        /// The row, counted from 0.
        line: usize,
    },
    /// A row without an expanded uncertainty.
    NoUncertainty {
        /// The row, counted from 0.
        line: usize,
        /// The method that is asked for.
        statement: StatementMethod,
    },
}

impl fmt::Display for Failed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Evaluation { error, .. } => error.fmt(f),
            Self::NoResult { line } => write!(
                f,
                "row {} states a result that there is not: no such evaluation, row of conditions or \
                 output",
                line + 1
            ),
            Self::NoUncertainty { line, statement } => {
                let why = match statement {
                    StatementMethod::Auto => {
                        "neither the law of propagation nor the trials give one"
                    }
                    StatementMethod::Gum => {
                        "`statement` is `gum`, and the law of propagation gives none; `monte-carlo` \
                         states the trials"
                    }
                    StatementMethod::MonteCarlo => {
                        "`statement` is `monte-carlo`, and there are no trials; `gum` states the law \
                         of propagation"
                    }
                };
                write!(f, "row {} has no expanded uncertainty: {why}", line + 1)
            }
        }
    }
}

impl std::error::Error for Failed {}

/// Evaluates the models of a certificate and states their results. `digests` are the SHA-256 of the
/// model files, in hexadecimal.
///
/// # Errors
/// An evaluation fails, a row names an unknown result, or a result has no expanded uncertainty.
pub fn issue(
    certificate: &Certificate,
    digests: &[Arc<str>],
    control: &Control<'_>,
) -> Result<Issued, Failed> {
    let mut evaluations = Vec::with_capacity(certificate.evaluations.len());
    for (number, asked) in certificate.evaluations.iter().enumerate() {
        let found = evaluate(&asked.task, control);
        evaluations.push(found.map_err(|error| Failed::Evaluation { evaluation: number, error })?);
    }
    let stopped = evaluations.iter().any(|evaluation| evaluation.stopped);
    let mut statements = Vec::with_capacity(certificate.lines.len());
    for (number, line) in certificate.lines.iter().enumerate() {
        let found = evaluations.get(line.evaluation).and_then(|evaluation| {
            Some((evaluation, evaluation.rows.get(line.row)?.outputs.get(line.output)?))
        });
        let (evaluation, output) = found.ok_or(Failed::NoResult { line: number })?;
        let wanted = StatementRules {
            settings: &evaluation.settings,
            rounding: certificate.rounding,
            digits: certificate.digits,
        };
        let stated = statement::of(output, line.capability.as_ref(), wanted);
        statements.push(stated.ok_or(Failed::NoUncertainty {
            line: number,
            statement: evaluation.settings.statement,
        })?);
    }
    let raised = statements.iter().map(|statement| {
        let limit = statement.limit.filter(|limit| limit.raised);
        limit.map(|_| statement.standard_uncertainty)
    });
    let raised: Vec<Option<f64>> = raised.collect();
    let RowCorrelations { coefficients, spreads, shared_inputs } =
        correlations::between(certificate, &evaluations, digests, &raised);
    let correlations = coefficients;
    Ok(Issued { evaluations, statements, correlations, spreads, shared_inputs, stopped })
}
