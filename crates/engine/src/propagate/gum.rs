//! The law of propagation of uncertainty (JCGM 100, clause 5) and the budget that follows from it.

pub mod bulk;
mod gradients;
mod joint_dof;

use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use crate::parallel;

pub use super::budget::{BudgetLine, CorrelationLine};
use crate::distribution::{Correlation, Distribution, RootName, paired};
use crate::number::CodePath;
use crate::special;
use crate::task::{Coverage, Row, Task};
use gradients::{Gradients, Linear};

/// The degrees of freedom of a combined standard uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dof {
    /// The effective degrees of freedom of the Welch-Satterthwaite formula (JCGM 100, G.2b).
    Finite(f64),
    /// Every contribution has infinite degrees of freedom.
    Infinite,
    /// The formula does not hold: correlated contributions have finite degrees of freedom.
    Undefined,
}

/// The evaluation of one output by the law of propagation.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Gum {
    /// Estimate y of the output.
    pub estimate: f64,
    /// Combined standard uncertainty u(y).
    pub standard_uncertainty: f64,
    /// Effective degrees of freedom.
    pub dof: Dof,
    /// Coverage factor k; `None` where the degrees of freedom are undefined, or so few that it is
    /// beyond all doubles.
    pub coverage_factor: Option<f64>,
    /// Sensitivity coefficients of all variables.
    pub(super) sensitivities: Box<[f64]>,
    /// The variables' distributions.
    pub(super) inputs: Arc<[Arc<Distribution>]>,
    /// Which variables and which coefficients have a line in the budget.
    linked: Arc<Linked>,
    /// The largest contribution.
    pub(super) largest: f64,
    /// The combined variance in squares of that.
    pub(super) variance: f64,
}

impl Gum {
    /// The variables that have a line in the budget.
    pub(super) fn shown(&self) -> &[usize] {
        &self.linked.shown
    }

    /// The coefficients that have one.
    pub(super) fn links(&self) -> &[Correlation] {
        &self.linked.correlations
    }

    /// The largest contribution of an input.
    pub(super) fn largest_contribution(&self) -> f64 {
        self.largest
    }

    /// Expanded uncertainty U = k u(y).
    pub fn expanded_uncertainty(&self) -> Option<f64> {
        Some(self.coverage_factor? * self.standard_uncertainty)
    }

    /// The standard deviation that the trials of a linear model would have: that of the Guide with the
    /// standard deviations of what is drawn. It is above u where an input has few degrees of freedom,
    /// and infinite where one has two or fewer.
    pub fn drawn_uncertainty(&self) -> f64 {
        self.with_widths(|known| known.standard_deviation())
    }

    /// The same as far as degrees of freedom make it. The trials of a saved result without them are wider
    /// or narrower than its standard uncertainty because its model is not linear.
    pub(super) fn drawn_by_dof(&self) -> f64 {
        self.with_widths(|known| {
            if is_bent_result(known) {
                known.standard_uncertainty()
            } else {
                known.standard_deviation()
            }
        })
    }

    /// The saved results whose trials have another standard deviation than their standard uncertainty,
    /// though no degrees of freedom are behind them, in the order of the task.
    pub(super) fn bent_results(&self) -> impl Iterator<Item = usize> {
        let known = self.inputs.iter().zip(&self.sensitivities).enumerate();
        let bent = known.filter(|(_, (known, c))| **c != 0.0 && is_bent_result(known));
        bent.map(|(variable, _)| variable)
    }

    /// The uncertainty of a linear model whose inputs have these widths.
    fn with_widths(&self, width: impl Fn(&Distribution) -> f64) -> f64 {
        let signed = |v: usize| {
            let known = self.inputs.get(v).zip(self.sensitivities.get(v));
            known.filter(|(_, c)| **c != 0.0).map_or(0.0, |(d, c)| c * width(d))
        };
        let own: f64 = (0..self.inputs.len()).map(|v| signed(v).powi(2)).sum();
        let joint =
            self.links().iter().map(|c| 2.0 * c.coefficient * signed(c.first) * signed(c.second));
        (own + joint.sum::<f64>()).max(0.0).sqrt()
    }

    /// The coverage interval y - U to y + U.
    pub fn interval(&self) -> Option<[f64; 2]> {
        let expanded = self.expanded_uncertainty()?;
        Some([self.estimate - expanded, self.estimate + expanded])
    }
}

/// Whether no degrees of freedom are behind a saved result, so that only its model can have made its
/// trials wider than its standard uncertainty.
fn is_bent_result(known: &Distribution) -> bool {
    let has_dof = known.dof().is_finite() || known.drawn_dof().is_finite();
    known.saved().is_some_and(|saved| !has_dof && !saved.origin().has_finite_dof())
}

/// All outputs of one row by the law of propagation.
#[derive(Debug)]
pub struct GumRow {
    /// Estimates of the outputs, on their own branch for phases.
    pub estimates: Vec<f64>,
    /// The evaluations; `None` where an estimate, a sensitivity coefficient or the standard
    /// uncertainty is not finite.
    pub outputs: Vec<Option<Gum>>,
    /// For each output its sensitivity coefficients.
    gradients: Vec<Vec<f64>>,
    uncertainties: Vec<f64>,
    distributions: Distributions,
    linked: Arc<Linked>,
}

/// The evaluation of the rows of a task.
#[derive(Debug)]
pub(crate) struct GumRows<'a> {
    task: &'a Task,
    gradients: Gradients<'a>,
    shown: Arc<[usize]>,
    /// Coverage factors of all rows have the same probability.
    factors: Factors,
    /// What links the variables of the row before, as it mostly is the same.
    last: Mutex<Option<(Distributions, Arc<Linked>)>>,
}

/// What is known of the variables of a row.
type Distributions = Arc<[Arc<Distribution>]>;

/// Evaluates one row of a task.
pub fn evaluate(task: &Task, row: &Row) -> GumRow {
    GumRows::of(task).evaluate(row)
}

impl<'a> GumRows<'a> {
    pub(crate) fn of(task: &'a Task) -> Self {
        let shown = task.variables.iter().enumerate().filter(|(_, v)| v.shown).map(|(v, _)| v);
        Self {
            task,
            gradients: Gradients::of(task),
            shown: shown.collect(),
            factors: Factors::default(),
            last: Mutex::new(None),
        }
    }

    /// Evaluates one row of the task.
    pub(crate) fn evaluate(&self, row: &Row) -> GumRow {
        self.evaluate_from(row, self.gradients.one(row))
    }

    /// Evaluates consecutive rows of the task; each has the same bits as on its own.
    pub(crate) fn evaluate_all(&self, rows: &[Row], path: CodePath) -> Vec<GumRow> {
        let linear = self.gradients.all(rows, path).into_iter();
        rows.iter().zip(linear).map(|(row, linear)| self.evaluate_from(row, linear)).collect()
    }

    fn evaluate_from(&self, row: &Row, (estimates, gradients): Linear) -> GumRow {
        let uncertainties: Vec<f64> =
            row.distributions.iter().map(|d| d.standard_uncertainty()).collect();
        let linked = self.linked(row);
        let outputs = estimates
            .iter()
            .zip(&gradients)
            .map(|(&estimate, gradient)| {
                let slopes = gradient.get(..uncertainties.len())?;
                if !estimate.is_finite() || !slopes.iter().all(|c| c.is_finite()) {
                    return None;
                }
                self.output(row, estimate, slopes, &linked)
            })
            .collect();
        let distributions = Arc::clone(&row.distributions);
        GumRow { estimates, outputs, gradients, uncertainties, distributions, linked }
    }

    fn linked(&self, row: &Row) -> Arc<Linked> {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        let before = last.as_ref();
        if let Some((_, linked)) =
            before.filter(|(distributions, _)| Arc::ptr_eq(distributions, &row.distributions))
        {
            return Arc::clone(linked);
        }
        let mut linked = Arc::new(Linked::of(self.task, row, &self.shown));
        // equal ones are kept once
        if let Some((_, known)) = before.filter(|(_, known)| *known == linked) {
            linked = Arc::clone(known);
        }
        *last = Some((Arc::clone(&row.distributions), Arc::clone(&linked)));
        linked
    }
}

/// The law of propagation at the estimates of a row, for other uncertainties of the inputs: the
/// sensitivity coefficients are computed once.
#[derive(Debug)]
pub struct AtEstimates<'a> {
    rows: GumRows<'a>,
    row: &'a Row,
    linear: Linear,
}

impl<'a> AtEstimates<'a> {
    /// At the estimates of a row of a task.
    pub fn of(task: &'a Task, row: &'a Row) -> Self {
        let rows = GumRows::of(task);
        let linear = rows.gradients.one(row);
        Self { rows, row, linear }
    }

    /// The outputs with other distributions of the same estimates, as many as the task has variables;
    /// `None` as for [`GumRow::outputs`].
    pub fn with(&self, distributions: Arc<[Arc<Distribution>]>) -> Vec<Option<Gum>> {
        let row = Row { conditions: self.row.conditions.clone(), distributions };
        self.rows.evaluate_from(&row, self.linear.clone()).outputs
    }
}

/// From so many outputs on their correlations are worth the threads of the pool.
pub(super) const MANY_OUTPUTS: usize = 64;

impl GumRow {
    /// The sensitivity coefficients of an output.
    pub(crate) fn gradient(&self, output: usize) -> Option<&[f64]> {
        self.gradients.get(output).map(Vec::as_slice)
    }

    /// The standard uncertainties of the inputs, and what links them.
    pub(super) fn known(&self) -> (&[f64], &[Correlation]) {
        (&self.uncertainties, &self.linked.correlations)
    }

    /// Whether correlation coefficients link quantities that vary.
    pub(crate) fn is_correlated(&self) -> bool {
        !self.linked.correlations.is_empty()
    }

    /// Correlation coefficients of the outputs i < j; NaN where one does not vary or is not linear.
    pub fn correlations(&self) -> Vec<f64> {
        let u = &self.uncertainties;
        let covariance = |a: &[f64], b: &[f64]| -> f64 {
            let own: f64 = (0..u.len()).map(|i| a[i] * b[i] * u[i].powi(2)).sum();
            let joint = self.linked.correlations.iter().map(|c| {
                let (i, j) = (c.first, c.second);
                (a[i] * b[j] + a[j] * b[i]) * u[i] * u[j] * c.coefficient
            });
            own + joint.sum::<f64>()
        };
        let variances: Vec<f64> = self.gradients.iter().map(|a| covariance(a, a)).collect();
        let of_first = |i: usize| {
            let (a, own) = (&self.gradients[i], variances[i]);
            let others = self.gradients.iter().zip(&variances).skip(i + 1);
            others
                .map(|(b, other)| (covariance(a, b) / (own * other).sqrt()).clamp(-1.0, 1.0))
                .collect::<Vec<f64>>()
        };
        let count = self.gradients.len();
        if count < MANY_OUTPUTS {
            return (0..count).flat_map(of_first).collect();
        }
        parallel::map(0..count, of_first).concat()
    }
}

/// The coefficients that say something: not zero, between quantities that vary. Between saved
/// results it is that of the law of propagation, so that what is computed from them is as if
/// computed at once.
pub(super) fn effective(
    correlations: &[Correlation],
    distributions: &[Arc<Distribution>],
) -> Vec<Correlation> {
    let varies = |q: usize| distributions.get(q).is_some_and(|d| d.standard_uncertainty() > 0.0);
    let saved = |q: usize| distributions.get(q).and_then(|d| d.saved());
    correlations
        .iter()
        .map(|c| {
            let linear =
                saved(c.first).zip(saved(c.second)).and_then(|(a, b)| a.linear_coefficient(b));
            Correlation { coefficient: linear.unwrap_or(c.coefficient), ..*c }
        })
        .filter(|c| c.coefficient != 0.0 && varies(c.first) && varies(c.second))
        .collect()
}

/// What links the variables of a row.
#[derive(Debug, PartialEq)]
struct Linked {
    /// The declared coefficients, then those of paired readings.
    correlations: Vec<Correlation>,
    /// The variables that have a line in the budget.
    shown: Arc<[usize]>,
    /// The sets of paired readings.
    ensembles: Vec<Vec<usize>>,
    /// For each variable with paired readings the number of its set.
    ensemble_of: HashMap<usize, usize>,
}

impl Linked {
    fn of(task: &Task, row: &Row, shown: &Arc<[usize]>) -> Self {
        let ensembles = paired::ensembles(&row.distributions);
        let mut correlations = effective(&task.correlations, &row.distributions);
        correlations.extend(ensembles.iter().flat_map(paired::Ensemble::correlations));
        let ensembles: Vec<Vec<usize>> =
            ensembles.into_iter().map(|ensemble| ensemble.members).collect();
        let numbered = ensembles.iter().enumerate();
        let ensemble_of =
            numbered.flat_map(|(set, members)| members.iter().map(move |&m| (m, set)));
        let ensemble_of = ensemble_of.collect();
        Self { correlations, shown: Arc::clone(shown), ensembles, ensemble_of }
    }

    /// Whether the two variables have paired readings of the same ensemble.
    fn are_paired(&self, c: &Correlation) -> bool {
        let set = |variable: usize| self.ensemble_of.get(&variable);
        set(c.first).is_some_and(|of_first| set(c.second) == Some(of_first))
    }
}

impl GumRows<'_> {
    /// The evaluation of one output from its estimate and its sensitivity coefficients; `None` where
    /// the standard uncertainty is not finite.
    fn output(
        &self,
        row: &Row,
        estimate: f64,
        slopes: &[f64],
        linked: &Arc<Linked>,
    ) -> Option<Gum> {
        let settings = &self.task.settings;
        let lines: Vec<BudgetLine> = row
            .distributions
            .iter()
            .zip(slopes)
            .enumerate()
            .map(|(variable, (distribution, &slope))| {
                BudgetLine::new(variable, distribution, slope)
            })
            .collect();
        // contributions relative to the largest, so that no square over- or underflows
        let largest = lines.iter().map(|line| line.contribution).fold(0.0, f64::max);
        if !largest.is_finite() {
            return None;
        }
        let signed = |i: usize| lines[i].relative(largest);
        let squares: f64 = (0..lines.len()).map(|i| signed(i).powi(2)).sum();
        let (mut variance, mut terms) = (squares, squares);
        for c in linked.correlations.iter() {
            let term = 2.0 * signed(c.first) * signed(c.second) * c.coefficient;
            variance += term;
            terms += term.abs();
        }
        if variance.is_nan() {
            return None;
        }
        let variance = left(variance, terms);
        let standard_uncertainty = largest * variance.sqrt();
        let dof = effective_dof(&lines, &row.distributions, linked, standard_uncertainty);
        let gum = Gum {
            estimate,
            standard_uncertainty,
            dof,
            coverage_factor: self.factors.factor(settings.coverage, dof, settings.real_dof),
            sensitivities: slopes.into(),
            inputs: Arc::clone(&row.distributions),
            linked: Arc::clone(linked),
            largest,
            variance,
        };
        standard_uncertainty.is_finite().then_some(gum)
    }
}

/// What is left of a sum, 0 where that is no more than the rounding of its terms: full correlation that
/// cancels them may leave something above or below zero. `terms` is the sum of their moduli.
#[inline(always)]
fn left(variance: f64, terms: f64) -> f64 {
    const ROUNDING: f64 = 32.0 * f64::EPSILON;
    if variance > ROUNDING * terms { variance } else { 0.0 }
}

/// The Welch-Satterthwaite formula (JCGM 100, equation G.2b). Paired readings are one term: their
/// joint contribution is itself the mean of n values, with n - 1 degrees of freedom (H.2, note 2 of
/// table H.4 and approach 2). Saved results enter it by the inputs that they go back to; alone, this
/// is the same as by their own degrees of freedom.
fn effective_dof(
    budget: &[BudgetLine],
    distributions: &[Arc<Distribution>],
    linked: &Linked,
    combined: f64,
) -> Dof {
    let contributes = |q: usize| budget.get(q).is_some_and(|line| line.contribution > 0.0);
    let saved = |q: usize| distributions.get(q).and_then(|d| d.saved());
    let estimated = |q: usize| {
        let own = budget.get(q).is_some_and(|line| !line.dof.is_infinite());
        let by_root = || saved(q).is_some_and(|saved| saved.origin().has_finite_dof());
        contributes(q) && (own || by_root())
    };
    if !(0..budget.len()).any(estimated) || combined == 0.0 {
        return Dof::Infinite;
    }
    let correlated = linked.correlations.iter().any(|c| {
        !linked.are_paired(c)
            && contributes(c.first)
            && contributes(c.second)
            && [c.first, c.second].into_iter().any(estimated)
            && !saved(c.first).zip(saved(c.second)).is_some_and(|(a, b)| a.is_by_roots(b))
    });
    // a result whose own degrees of freedom are undefined
    if correlated || budget.iter().any(|line| line.contribution > 0.0 && line.dof.is_nan()) {
        return Dof::Undefined;
    }
    let by_roots = |q: usize| saved(q).filter(|saved| saved.origin().has_independent_roots());
    let alone = |q: usize| by_roots(q).is_none() && !linked.ensemble_of.contains_key(&q);
    let single: f64 = budget
        .iter()
        .enumerate()
        .filter(|(q, line)| estimated(*q) && alone(*q) && line.dof.is_finite())
        .map(|(_, line)| (line.contribution / combined).powi(4) / line.dof)
        .sum();
    let joint: f64 = linked
        .ensembles
        .iter()
        .enumerate()
        .map(|(number, set)| {
            let dof = set.first().and_then(|&q| budget.get(q)).map_or(f64::INFINITY, |l| l.dof);
            joint_variance(number, set, budget, linked, combined).powi(2) / dof
        })
        .sum();
    let mut roots: BTreeMap<&RootName, (f64, f64)> = BTreeMap::new();
    for (q, line) in budget.iter().enumerate().filter(|(q, _)| contributes(*q)) {
        for (root, weight) in by_roots(q).map_or(&[][..], |saved| &saved.origin().roots) {
            let part = weight * line.contribution.copysign(line.sensitivity) / combined;
            let (total, dof) = roots.entry(&root.name).or_insert((0.0, f64::INFINITY));
            *total += part;
            *dof = dof.min(root.dof);
        }
    }
    let common: f64 = roots.values().map(|(part, dof)| part.powi(4) / dof).sum();
    let dof = 1.0 / (single + joint + common);
    if dof.is_finite() { Dof::Finite(dof) } else { Dof::Infinite }
}

/// The variance that a set of paired readings contributes, as a share of the combined one.
fn joint_variance(
    number: usize,
    set: &[usize],
    budget: &[BudgetLine],
    linked: &Linked,
    combined: f64,
) -> f64 {
    let signed =
        |q: usize| budget.get(q).map_or(0.0, |l| l.contribution.copysign(l.sensitivity) / combined);
    let own: f64 = set.iter().map(|&q| signed(q).powi(2)).sum();
    let is_inside = |c: &&Correlation| linked.ensemble_of.get(&c.first) == Some(&number);
    let inside = linked.correlations.iter().filter(is_inside);
    let mixed: f64 = inside.map(|c| 2.0 * signed(c.first) * signed(c.second) * c.coefficient).sum();
    (own + mixed).max(0.0)
}

/// Coverage factors that were found before: those of whole degrees of freedom come again and again.
#[derive(Debug)]
struct Factors([OnceLock<Option<f64>>; KNOWN]);

/// Degrees of freedom up to this are remembered.
const KNOWN: usize = 256;

impl Default for Factors {
    fn default() -> Self {
        Self([const { OnceLock::new() }; KNOWN])
    }
}

impl Factors {
    fn factor(&self, coverage: Coverage, dof: Dof, real: bool) -> Option<f64> {
        let find = || coverage_factor(coverage, dof, real);
        // the first index is that of infinite degrees of freedom
        let index = match dof {
            Dof::Infinite => Some(0),
            Dof::Finite(dof) if !real && dof >= 1.0 => Some(whole(dof) as usize),
            Dof::Finite(_) | Dof::Undefined => None,
        };
        match index.and_then(|index| self.0.get(index)) {
            Some(known) => *known.get_or_init(find),
            None => find(),
        }
    }
}

/// The degrees of freedom that a factor is taken at: the integer part of the effective ones (JCGM 100,
/// G.4.1), below 1 the real value, or that always if asked for.
pub(super) fn used(dof: f64, real: bool) -> f64 {
    let whole = whole(dof);
    if real || whole < 1.0 { dof } else { whole }
}

/// The integer part of degrees of freedom; 19 computed as 18.999999999 means 19.
fn whole(dof: f64) -> f64 {
    (dof * (1.0 + 1e-9)).floor()
}

/// The coverage factor k_p (JCGM 100, G.3.3 and G.4.1): the t factor at the integer part of the
/// effective degrees of freedom (below 1 at the real value), or at the real value if asked for.
pub fn coverage_factor(coverage: Coverage, dof: Dof, real: bool) -> Option<f64> {
    if let Coverage::Factor { factor, fixed: true } = coverage {
        return Some(factor);
    }
    let probability = coverage.probability();
    match dof {
        Dof::Undefined => coverage.given_factor(),
        // K itself, and not the factor at its probability of 0.9545, which is 2.000 02
        Dof::Infinite => coverage
            .nominal_factor()
            .or_else(|| Some(special::student::two_sided_factor(probability, f64::INFINITY))),
        Dof::Finite(dof) => {
            // at a thousandth of a degree of freedom it is beyond all doubles
            let k = special::student::two_sided_factor(probability, used(dof, real));
            Some(k).filter(|k| k.is_finite())
        }
    }
}
