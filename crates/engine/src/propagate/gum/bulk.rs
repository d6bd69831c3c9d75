//! Budgets of many measurements of one model at once, as columns of numbers.
//!
//! [`evaluate`](crate::propagate::evaluate) gives each row of a sweep an evaluation of its own. Where
//! millions of budgets are wanted, as in a map of conditions or behind an optimisation, [`budgets`]
//! takes columns and hands back columns, some tens of times faster.

use std::collections::HashSet;
use std::fmt;
use std::ops::Range;
use std::slice::ChunksMut;

use crate::parallel;

use super::{Dof, Factors, left};
use crate::distribution::Correlation;
use crate::model::{Columns, Program, Slope, Slopes};
use crate::number::{COLUMN, CodePath, Column, Kernel, Operand};
use crate::task::Coverage;

/// Does some work with a quantity's value in each of the rows, compiled once for a column and once
/// for one value.
macro_rules! with {
    ($each:expr, $rows:expr, $value:ident => $work:block) => {
        match $each {
            BulkValue::Same(value) => {
                let $value = |_: usize| value;
                $work
            }
            BulkValue::Rows(values) => {
                let values = &values[$rows];
                let $value = |i: usize| values[i];
                $work
            }
        }
    };
}

/// A quantity's value in every row.
#[derive(Clone, Copy, Debug)]
pub enum BulkValue<'a> {
    /// The same in all rows.
    Same(f64),
    /// One value a row.
    Rows(&'a [f64]),
}

impl BulkValue<'_> {
    fn at(&self, row: usize) -> f64 {
        match self {
            Self::Same(value) => *value,
            Self::Rows(values) => values.get(row).copied().unwrap_or(f64::NAN),
        }
    }

    fn len(&self) -> Option<usize> {
        match self {
            Self::Same(_) => None,
            Self::Rows(values) => Some(values.len()),
        }
    }

    /// The first row whose value is so.
    fn first_where(&self, is_so: impl Fn(f64) -> bool) -> Option<usize> {
        match self {
            Self::Same(value) => is_so(*value).then_some(0),
            Self::Rows(values) => values.iter().position(|value| is_so(*value)),
        }
    }

    fn same(&self) -> Option<f64> {
        match self {
            Self::Same(value) => Some(*value),
            Self::Rows(_) => None,
        }
    }
}

/// What is known about an input in every row, in its unit.
#[derive(Clone, Copy, Debug)]
pub struct BulkInput<'a> {
    /// The estimate.
    pub estimate: BulkValue<'a>,
    /// The standard uncertainty, zero or more.
    pub standard_uncertainty: BulkValue<'a>,
    /// Its degrees of freedom, above 0; infinite unless it was estimated.
    pub dof: BulkValue<'a>,
}

impl<'a> BulkInput<'a> {
    /// Estimate and standard uncertainty, with infinite degrees of freedom.
    pub fn new(estimate: BulkValue<'a>, standard_uncertainty: BulkValue<'a>) -> Self {
        Self { estimate, standard_uncertainty, dof: BulkValue::Same(f64::INFINITY) }
    }
}

/// The budgets of one output, one entry a row in each column. Where an estimate, a sensitivity
/// coefficient or the standard uncertainty is not finite, the standard uncertainty, the degrees of
/// freedom and the coverage factor are NaN.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Budgets {
    /// Estimates y.
    pub estimates: Vec<f64>,
    /// Combined standard uncertainties u(y).
    pub standard_uncertainties: Vec<f64>,
    /// Effective degrees of freedom; infinite where every contribution's are, NaN where the
    /// Welch-Satterthwaite formula does not hold.
    pub dof: Vec<f64>,
    /// Coverage factors k; NaN where there is none.
    pub coverage_factors: Vec<f64>,
    /// For each input its sensitivity coefficients c_i.
    pub sensitivities: Vec<Vec<f64>>,
    /// For each input its contributions |c_i| u(x_i).
    pub contributions: Vec<Vec<f64>>,
}

/// Why there are no budgets.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BulkError {
    /// Another number of variables than the program has.
    Variables {
        /// How many are given.
        found: usize,
        /// How many the program has.
        expected: usize,
    },
    /// Columns of different lengths, or none.
    Rows,
    /// A correlation coefficient outside -1 to 1, or not of two different inputs.
    Correlation,
    /// Two inputs, by their numbers, whose correlation coefficient is given twice.
    CorrelationTwice([usize; 2]),
    /// A standard uncertainty below 0.
    Uncertainty {
        /// The number of the input.
        input: usize,
        /// The row.
        row: usize,
    },
    /// Degrees of freedom that are not above 0.
    Dof {
        /// The number of the input.
        input: usize,
        /// The row.
        row: usize,
    },
    /// A coverage out of its range.
    Coverage {
        /// What it must be.
        range: &'static str,
    },
}

impl fmt::Display for BulkError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Variables { found, expected } => {
                write!(f, "{found} variables are given, but the model has {expected}")
            }
            Self::Rows => {
                f.write_str("the columns must have the same number of rows, at least one")
            }
            Self::Correlation => f.write_str(
                "a correlation coefficient must be of two different inputs, from -1 to 1",
            ),
            Self::CorrelationTwice([first, second]) => write!(
                f,
                "the correlation coefficient of the inputs {first} and {second} is given twice"
            ),
            Self::Uncertainty { input, row } => {
                write!(f, "the standard uncertainty of input {input} in row {row} is below 0")
            }
            Self::Dof { input, row } => {
                write!(f, "the degrees of freedom of input {input} in row {row} are not above 0")
            }
            Self::Coverage { range } => write!(f, "the coverage must be {range}"),
        }
    }
}

impl std::error::Error for BulkError {}

/// How budgets are made.
#[derive(Clone, Copy, Debug)]
pub struct BulkOptions<'a> {
    /// The coverage probability, or factor.
    pub coverage: Coverage,
    /// Whether the t factor is taken at the real degrees of freedom rather than at their integer
    /// part (JCGM 100, G.4.1).
    pub real_dof: bool,
    /// Correlation coefficients between inputs, the same in all rows.
    pub correlations: &'a [Correlation],
    /// The code path.
    pub path: CodePath,
}

impl Default for BulkOptions<'_> {
    fn default() -> Self {
        Self {
            coverage: Coverage::default(),
            real_dof: false,
            correlations: &[],
            path: CodePath::best(),
        }
    }
}

/// Budgets of every output in every row by the law of propagation (JCGM 100, equations 10, 13 and
/// G.2b), on the threads of the current rayon pool.
///
/// The program's variables are the inputs, in their order, then the conditions, which are known
/// exactly. A task has its program in `task.model.program`; a [`Recorder`](crate::model::Recorder)
/// writes down any other.
///
/// ```
/// use gumption_engine::model::Recorder;
/// use gumption_engine::number::Number;
/// use gumption_engine::propagate::gum::bulk::{BulkValue, BulkInput, BulkOptions, budgets};
///
/// // the resistance of a conductor at 1000 voltages, all measured with the same ammeter
/// let recorder = Recorder::default();
/// let (voltage, current) = (recorder.variable(0), recorder.variable(1));
/// let program = recorder.program(2, &[voltage / current]);
/// let volts: Vec<f64> = (1..=1000).map(f64::from).collect();
/// let known = [
///     BulkInput::new(BulkValue::Rows(&volts), BulkValue::Same(0.1)),
///     BulkInput::new(BulkValue::Same(2.0), BulkValue::Same(0.01)),
/// ];
/// let resistance = &budgets(&program, &known, &[], BulkOptions::default())?[0];
/// assert_eq!(resistance.estimates[99], 50.0);
/// // 100 V / (2 A)^2 x 0.01 A = 0.25 Ohm and 0.1 V / 2 A = 0.05 Ohm
/// assert!((resistance.standard_uncertainties[99] - 0.065_f64.sqrt()).abs() < 1e-15);
/// # Ok::<(), gumption_engine::propagate::gum::bulk::BulkError>(())
/// ```
///
/// # Errors
/// [`BulkError`].
pub fn budgets(
    program: &Program,
    inputs: &[BulkInput<'_>],
    conditions: &[BulkValue<'_>],
    options: BulkOptions<'_>,
) -> Result<Vec<Budgets>, BulkError> {
    let found = inputs.len() + conditions.len();
    if found != program.variables() {
        return Err(BulkError::Variables { found, expected: program.variables() });
    }
    let rows = rows(inputs, conditions).ok_or(BulkError::Rows)?;
    let possible = |c: &Correlation| {
        let different = c.first < inputs.len() && c.second < inputs.len() && c.first != c.second;
        different && c.coefficient.abs() <= 1.0
    };
    if !options.correlations.iter().all(possible) {
        return Err(BulkError::Correlation);
    }
    let mut pairs = HashSet::new();
    for correlation in options.correlations {
        let pair =
            [correlation.first.min(correlation.second), correlation.first.max(correlation.second)];
        if !pairs.insert(pair) {
            return Err(BulkError::CorrelationTwice(pair));
        }
    }
    if let Some(range) = options.coverage.fault() {
        return Err(BulkError::Coverage { range });
    }
    for (input, known) in inputs.iter().enumerate() {
        if let Some(row) = known.standard_uncertainty.first_where(|u| u < 0.0) {
            return Err(BulkError::Uncertainty { input, row });
        }
        if let Some(row) = known.dof.first_where(|dof| dof <= 0.0) {
            return Err(BulkError::Dof { input, row });
        }
    }
    let mut made: Vec<Budgets> =
        (0..program.outputs()).map(|_| Budgets::new(inputs.len(), rows)).collect();
    let values: Vec<BulkValue<'_>> =
        inputs.iter().map(|known| known.estimate).chain(conditions.iter().copied()).collect();
    let same: Vec<Option<f64>> = values.iter().map(BulkValue::same).collect();
    let slopes = Slopes::new(program, &same, inputs.len());
    let bulk = Bulk { program, inputs, values, options, slopes, factors: Factors::default() };
    let mut pieces: Vec<Vec<Piece<'_>>> = Vec::new();
    for budgets in &mut made {
        for (number, piece) in budgets.pieces().enumerate() {
            if pieces.len() == number {
                pieces.push(Vec::new());
            }
            pieces[number].push(piece);
        }
    }
    parallel::map(pieces.into_iter().enumerate(), |(number, mut outputs)| {
        bulk.fill(number * PIECE, &mut outputs);
    });
    Ok(made)
}

/// Rows that a thread takes at a time.
const PIECE: usize = 32 * COLUMN;

/// The number of rows, if all columns have it.
fn rows(inputs: &[BulkInput<'_>], conditions: &[BulkValue<'_>]) -> Option<usize> {
    let of = |k: &BulkInput<'_>| [k.estimate.len(), k.standard_uncertainty.len(), k.dof.len()];
    let of_inputs = inputs.iter().flat_map(of);
    let mut lengths = of_inputs.chain(conditions.iter().map(BulkValue::len)).flatten();
    let Some(rows) = lengths.next() else { return Some(1) };
    (rows > 0 && lengths.all(|length| length == rows)).then_some(rows)
}

/// Consecutive rows of the columns of one output.
struct Piece<'a> {
    estimates: &'a mut [f64],
    standard_uncertainties: &'a mut [f64],
    dof: &'a mut [f64],
    coverage_factors: &'a mut [f64],
    sensitivities: Vec<&'a mut [f64]>,
    contributions: Vec<&'a mut [f64]>,
}

impl Budgets {
    fn new(inputs: usize, rows: usize) -> Self {
        let column = || vec![0.0; rows];
        Self {
            estimates: column(),
            standard_uncertainties: column(),
            dof: column(),
            coverage_factors: column(),
            sensitivities: (0..inputs).map(|_| column()).collect(),
            contributions: (0..inputs).map(|_| column()).collect(),
        }
    }

    fn pieces(&mut self) -> impl Iterator<Item = Piece<'_>> {
        let count = self.estimates.len().div_ceil(PIECE);
        let mut estimates = self.estimates.chunks_mut(PIECE);
        let mut standard_uncertainties = self.standard_uncertainties.chunks_mut(PIECE);
        let mut dof = self.dof.chunks_mut(PIECE);
        let mut coverage_factors = self.coverage_factors.chunks_mut(PIECE);
        let mut sensitivities = chunks(&mut self.sensitivities);
        let mut contributions = chunks(&mut self.contributions);
        (0..count).map_while(move |_| {
            Some(Piece {
                estimates: estimates.next()?,
                standard_uncertainties: standard_uncertainties.next()?,
                dof: dof.next()?,
                coverage_factors: coverage_factors.next()?,
                sensitivities: sensitivities
                    .iter_mut()
                    .map(Iterator::next)
                    .collect::<Option<_>>()?,
                contributions: contributions
                    .iter_mut()
                    .map(Iterator::next)
                    .collect::<Option<_>>()?,
            })
        })
    }
}

fn chunks(columns: &mut [Vec<f64>]) -> Vec<ChunksMut<'_, f64>> {
    columns.iter_mut().map(|column| column.chunks_mut(PIECE)).collect()
}

struct Bulk<'a> {
    program: &'a Program,
    inputs: &'a [BulkInput<'a>],
    /// The values of the program's variables.
    values: Vec<BulkValue<'a>>,
    options: BulkOptions<'a>,
    slopes: Option<Slopes>,
    factors: Factors,
}

impl Bulk<'_> {
    /// Fills consecutive rows of every output; the first of them is row `first`.
    fn fill(&self, first: usize, outputs: &mut [Piece<'_>]) {
        let rows = outputs.first().map_or(0, |piece| piece.estimates.len());
        match &self.slopes {
            Some(slopes) => {
                let mut columns = slopes.columns();
                let mut budget = Scratch::new(self.inputs.len());
                for at in (0..rows).step_by(COLUMN) {
                    let rows = at..rows.min(at + COLUMN);
                    let of = Lanes { bulk: self, slopes, columns: &mut columns, first, rows };
                    self.options.path.run(LanesKernel { of, budget: &mut budget, outputs });
                }
            }
            None => {
                for row in 0..rows {
                    self.one_by_one(first, row, outputs);
                }
            }
        }
        for piece in outputs {
            let lines = piece.coverage_factors.iter_mut().zip(&*piece.dof);
            for ((k, &dof), u) in lines.zip(&*piece.standard_uncertainties) {
                *k = if u.is_nan() { f64::NAN } else { self.coverage_factor(dof) };
            }
        }
    }

    fn coverage_factor(&self, dof: f64) -> f64 {
        let dof = match dof {
            f64::INFINITY => Dof::Infinite,
            dof if dof.is_nan() => Dof::Undefined,
            dof => Dof::Finite(dof),
        };
        let BulkOptions { coverage, real_dof, .. } = self.options;
        self.factors.factor(coverage, dof, real_dof).unwrap_or(f64::NAN)
    }

    /// A row whose derivatives are taken on their own.
    fn one_by_one(&self, first: usize, row: usize, outputs: &mut [Piece<'_>]) {
        let values: Vec<f64> = self.values.iter().map(|value| value.at(first + row)).collect();
        let (estimates, gradients) = self.program.gradients(&values);
        let mut budget = Scratch::new(self.inputs.len());
        for ((piece, estimate), gradient) in outputs.iter_mut().zip(estimates).zip(gradients) {
            piece.estimates[row] = estimate;
            for (column, slope) in piece.sensitivities.iter_mut().zip(gradient) {
                column[row] = slope;
            }
            budget.evaluate(self, first, row..row + 1, piece);
        }
    }
}

/// One column of rows.
struct Lanes<'a, 'b> {
    bulk: &'a Bulk<'b>,
    slopes: &'a Slopes,
    columns: &'a mut Columns,
    /// The row of the sweep that the piece begins with.
    first: usize,
    /// The rows of the piece.
    rows: Range<usize>,
}

struct LanesKernel<'a, 'b, 'c, 'd> {
    of: Lanes<'a, 'b>,
    budget: &'a mut Scratch,
    outputs: &'c mut [Piece<'d>],
}

impl Kernel for LanesKernel<'_, '_, '_, '_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { of: Lanes { bulk, slopes, columns, first, rows }, budget, outputs } = self;
        let of_sweep = first + rows.start..first + rows.end;
        for &(variable, register) in &slopes.varying {
            if let BulkValue::Rows(values) = bulk.values[variable] {
                columns.values[register].0[..rows.len()].copy_from_slice(&values[of_sweep.clone()]);
            }
        }
        slopes.run(columns);
        for (piece, Slope { value, gradient }) in outputs.iter_mut().zip(&slopes.outputs) {
            copy(*value, &columns.values, &mut piece.estimates[rows.clone()]);
            for (variable, slope) in gradient {
                let column = &mut piece.sensitivities[*variable][rows.clone()];
                copy(*slope, &columns.gradients, column);
            }
            budget.evaluate(bulk, first, rows.clone(), piece);
        }
    }
}

#[inline(always)]
fn copy(from: Operand, registers: &[Column], to: &mut [f64]) {
    match from {
        Operand::Register(register) => to.copy_from_slice(&registers[register].0[..to.len()]),
        Operand::Constant(value) => to.fill(value),
    }
}

/// Columns of one thread for what is summed over the variables.
struct Scratch {
    largest: Column,
    variance: Column,
    /// The moduli of what the variance is the sum of.
    terms: Column,
    /// Whether nothing so far is infinite or not a number: the sum of all is finite.
    sum: Column,
    fourth: Column,
    /// For each variable, contributions in the largest one, with the signs of the sensitivity
    /// coefficients.
    relative: Vec<Column>,
}

impl Scratch {
    fn new(variables: usize) -> Self {
        let [largest, variance, terms, sum, fourth] = [const { Column::ZERO }; 5];
        Self { largest, variance, terms, sum, fourth, relative: vec![Column::ZERO; variables] }
    }

    /// The budget of rows whose estimates and sensitivity coefficients are there.
    #[inline(always)]
    fn evaluate(
        &mut self,
        bulk: &Bulk<'_>,
        first: usize,
        rows: Range<usize>,
        piece: &mut Piece<'_>,
    ) {
        let count = rows.len();
        let sweep = first + rows.start..first + rows.end;
        let Self { largest, variance, terms, sum, fourth, relative } = self;
        let [largest, variance, terms, sum, fourth] =
            [largest, variance, terms, sum, fourth].map(|column| &mut column.0[..count]);
        largest.fill(0.0);
        variance.fill(0.0);
        fourth.fill(0.0);
        sum.copy_from_slice(&piece.estimates[rows.clone()]);
        for (v, known) in bulk.inputs.iter().enumerate() {
            let slopes = &piece.sensitivities[v][rows.clone()];
            let contributions = &mut piece.contributions[v][rows.clone()];
            with!(known.standard_uncertainty, sweep.clone(), u => {
                for i in 0..count {
                    let contribution = (slopes[i] * u(i)).abs();
                    contributions[i] = contribution;
                    largest[i] = if contribution > largest[i] { contribution } else { largest[i] };
                    // infinite or not a number if one of them is
                    sum[i] += 0.0 * (slopes[i] + contribution);
                }
            });
        }
        for (v, relative) in relative.iter_mut().enumerate() {
            let slopes = &piece.sensitivities[v][rows.clone()];
            let contributions = &piece.contributions[v][rows.clone()];
            for i in 0..count {
                let part = contributions[i].copysign(slopes[i]) / largest[i];
                let part = if largest[i] > 0.0 { part } else { 0.0 };
                relative.0[i] = part;
                variance[i] += part * part;
            }
        }
        terms.copy_from_slice(variance);
        for c in bulk.options.correlations {
            let (a, b) = (&relative[c.first].0, &relative[c.second].0);
            for i in 0..count {
                let term = 2.0 * a[i] * b[i] * c.coefficient;
                variance[i] += term;
                terms[i] += term.abs();
            }
        }
        let combined = &mut piece.standard_uncertainties[rows.clone()];
        for i in 0..count {
            let u = largest[i] * left(variance[i], terms[i]).sqrt();
            let finite = (sum[i] + 0.0 * (variance[i] + u)).is_finite();
            combined[i] = if finite { u } else { f64::NAN };
        }
        for (v, known) in bulk.inputs.iter().enumerate() {
            if known.dof.same() == Some(f64::INFINITY) {
                continue;
            }
            let contributions = &piece.contributions[v][rows.clone()];
            with!(known.dof, sweep.clone(), dof => {
                for i in 0..count {
                    let share = contributions[i] / combined[i];
                    let share = share * share;
                    let term = share * share / dof(i);
                    let part = contributions[i] > 0.0 && combined[i] > 0.0;
                    fourth[i] += if part { term } else { 0.0 };
                }
            });
        }
        let dof = &mut piece.dof[rows.clone()];
        for i in 0..count {
            let effective = 1.0 / fourth[i];
            dof[i] = if combined[i].is_nan() { f64::NAN } else { effective };
        }
        bulk.undefine(first, rows, piece);
    }
}

impl Bulk<'_> {
    /// Where contributions of finite degrees of freedom are correlated, the Welch-Satterthwaite
    /// formula does not hold.
    fn undefine(&self, first: usize, rows: Range<usize>, piece: &mut Piece<'_>) {
        for c in self.options.correlations.iter().filter(|c| c.coefficient != 0.0) {
            let both = [c.first, c.second];
            for row in rows.clone() {
                let contribute = both.iter().all(|&v| piece.contributions[v][row] > 0.0);
                let estimated = |&v: &usize| self.inputs[v].dof.at(first + row).is_finite();
                let combined = piece.standard_uncertainties[row];
                if contribute && combined > 0.0 && both.iter().any(estimated) {
                    piece.dof[row] = f64::NAN;
                }
            }
        }
    }
}
