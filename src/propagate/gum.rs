//! The law of propagation of uncertainty (JCGM 100, clause 5) and the budget that follows from it.

use std::collections::BTreeMap;

use crate::distribution::{Correlation, Distribution, RootName, paired, special};
use crate::task::{Coverage, Row, Settings, Task};

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

/// One input's line in the budget.
#[derive(Clone, Debug, PartialEq)]
pub struct BudgetLine {
    /// Place of the variable in the task.
    pub variable: usize,
    /// Estimate x_i in the variable's unit.
    pub estimate: f64,
    /// Standard uncertainty u(x_i) in the variable's unit.
    pub standard_uncertainty: f64,
    /// Name of the distribution.
    pub distribution: &'static str,
    /// What the stated width was divided by to give u(x_i), if the distribution has one width.
    pub divisor: Option<f64>,
    /// Degrees of freedom of u(x_i); infinite unless it was estimated.
    pub dof: f64,
    /// Whether a normal distribution is drawn as a t for its few degrees of freedom.
    pub drawn_as_t: bool,
    /// Sensitivity coefficient c_i, output unit per input unit.
    pub sensitivity: f64,
    /// Contribution |c_i| u(x_i) in the output's unit.
    pub contribution: f64,
    /// Share of the combined variance.
    pub share: f64,
}

/// The line of a correlation coefficient in the budget.
#[derive(Clone, Debug, PartialEq)]
pub struct CorrelationLine {
    /// Places of the two variables.
    pub variables: [usize; 2],
    /// The declared coefficient.
    pub coefficient: f64,
    /// Share 2 c_i c_j u_i u_j r / u^2 of the combined variance; it may be negative.
    pub share: f64,
}

/// The evaluation of one output by the law of propagation.
#[derive(Clone, Debug, PartialEq)]
pub struct Gum {
    /// Estimate y of the output.
    pub estimate: f64,
    /// Combined standard uncertainty u(y).
    pub standard_uncertainty: f64,
    /// Effective degrees of freedom.
    pub dof: Dof,
    /// Coverage factor k; `None` where the degrees of freedom are undefined.
    pub coverage_factor: Option<f64>,
    /// One line for each variable.
    pub budget: Vec<BudgetLine>,
    /// One line for each declared coefficient that is not zero, then one for each pair of paired
    /// readings.
    pub correlations: Vec<CorrelationLine>,
}

impl Gum {
    /// Expanded uncertainty U = k u(y).
    pub fn expanded_uncertainty(&self) -> Option<f64> {
        Some(self.coverage_factor? * self.standard_uncertainty)
    }

    /// The coverage interval y - U to y + U.
    pub fn interval(&self) -> Option<[f64; 2]> {
        let expanded = self.expanded_uncertainty()?;
        Some([self.estimate - expanded, self.estimate + expanded])
    }
}

/// All outputs of one row by the law of propagation.
#[derive(Clone, Debug)]
pub(crate) struct GumRow {
    /// Estimates of the outputs, on their own branch for phases.
    pub(crate) estimates: Vec<f64>,
    /// The evaluations; `None` where an estimate or a sensitivity coefficient is not finite.
    pub(crate) outputs: Vec<Option<Gum>>,
    /// Correlation coefficients of the outputs i < j.
    pub(crate) correlations: Vec<f64>,
}

/// Evaluates one row of a task.
pub(crate) fn evaluate(task: &Task, row: &Row) -> GumRow {
    let mut values: Vec<f64> = row.distributions.iter().map(Distribution::mean).collect();
    values.extend(&row.conditions);
    let (estimates, gradients) = task.model.program.gradients(&values);
    let uncertainties: Vec<f64> =
        row.distributions.iter().map(Distribution::standard_uncertainty).collect();
    let linked = Linked::of(task, row);
    let correlations = &linked.correlations;

    let outputs = estimates
        .iter()
        .zip(&gradients)
        .map(|(&estimate, gradient)| {
            let slopes = gradient.get(..uncertainties.len())?;
            if !estimate.is_finite() || !slopes.iter().all(|c| c.is_finite()) {
                return None;
            }
            let mut gum = output(&task.settings, row, estimate, slopes, &linked);
            gum.budget.retain(|line| task.variables.get(line.variable).is_some_and(|v| v.shown));
            Some(gum)
        })
        .collect();

    let covariance = |a: &[f64], b: &[f64]| -> f64 {
        let own: f64 =
            (0..uncertainties.len()).map(|i| a[i] * b[i] * uncertainties[i].powi(2)).sum();
        let joint: f64 = correlations
            .iter()
            .map(|c| {
                let (i, j) = (c.first, c.second);
                (a[i] * b[j] + a[j] * b[i]) * uncertainties[i] * uncertainties[j] * c.coefficient
            })
            .sum();
        own + joint
    };
    let mut output_correlations = Vec::new();
    for (i, a) in gradients.iter().enumerate() {
        for b in &gradients[i + 1..] {
            let scale = (covariance(a, a) * covariance(b, b)).sqrt();
            output_correlations.push((covariance(a, b) / scale).clamp(-1.0, 1.0));
        }
    }
    GumRow { estimates, outputs, correlations: output_correlations }
}

/// The coefficients that say something: not zero, between quantities that vary. Between saved
/// results it is that of the law of propagation, so that what is computed from them is as if
/// computed at once.
fn effective(correlations: &[Correlation], distributions: &[Distribution]) -> Vec<Correlation> {
    let varies = |q: usize| distributions.get(q).is_some_and(|d| d.standard_uncertainty() > 0.0);
    let saved = |q: usize| distributions.get(q).and_then(Distribution::saved);
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
struct Linked {
    /// The declared coefficients, then those of paired readings.
    correlations: Vec<Correlation>,
    /// The sets of paired readings.
    ensembles: Vec<Vec<usize>>,
}

impl Linked {
    fn of(task: &Task, row: &Row) -> Self {
        let ensembles = paired::ensembles(&row.distributions);
        let mut correlations = effective(&task.correlations, &row.distributions);
        correlations.extend(ensembles.iter().flat_map(paired::Ensemble::correlations));
        let ensembles = ensembles.into_iter().map(|ensemble| ensemble.members).collect();
        Self { correlations, ensembles }
    }

    /// Whether the two variables have paired readings of the same ensemble.
    fn are_paired(&self, c: &Correlation) -> bool {
        self.ensembles.iter().any(|set| set.contains(&c.first) && set.contains(&c.second))
    }
}

fn output(settings: &Settings, row: &Row, estimate: f64, slopes: &[f64], linked: &Linked) -> Gum {
    let correlations = &linked.correlations;
    let mut budget: Vec<BudgetLine> = row
        .distributions
        .iter()
        .zip(slopes)
        .enumerate()
        .map(|(variable, (distribution, &sensitivity))| BudgetLine {
            variable,
            estimate: distribution.mean(),
            standard_uncertainty: distribution.standard_uncertainty(),
            distribution: distribution.name(),
            divisor: distribution.divisor(),
            dof: distribution.dof(),
            drawn_as_t: matches!(distribution, Distribution::Normal(_))
                && distribution.drawn_dof().is_finite(),
            sensitivity,
            contribution: (sensitivity * distribution.standard_uncertainty()).abs(),
            share: 0.0,
        })
        .collect();
    // contributions relative to the largest, so that no square over- or underflows
    let largest = budget.iter().map(|line| line.contribution).fold(0.0, f64::max);
    let signed = |i: usize| budget[i].contribution.copysign(slopes[i]) / largest;
    let (mut variance, mut joint) = (0.0, Vec::new());
    if largest > 0.0 {
        variance = (0..budget.len()).map(|i| signed(i).powi(2)).sum();
        for c in correlations {
            let term = 2.0 * signed(c.first) * signed(c.second) * c.coefficient;
            variance += term;
            joint.push(term);
        }
    }
    // full negative correlation may leave a rounding error below zero
    let variance = f64::max(variance, 0.0);
    let standard_uncertainty = largest * variance.sqrt();
    let dof = effective_dof(&budget, &row.distributions, linked, standard_uncertainty);
    let share = |term: f64| if variance > 0.0 { term / variance } else { 0.0 };
    let correlation_lines = correlations
        .iter()
        .enumerate()
        .map(|(place, c)| CorrelationLine {
            variables: [c.first, c.second],
            coefficient: c.coefficient,
            share: share(joint.get(place).copied().unwrap_or(0.0)),
        })
        .collect();
    if largest > 0.0 {
        for line in &mut budget {
            line.share = share((line.contribution / largest).powi(2));
        }
    }
    Gum {
        estimate,
        standard_uncertainty,
        dof,
        coverage_factor: coverage_factor(settings.coverage, dof, settings.real_dof),
        budget,
        correlations: correlation_lines,
    }
}

/// The Welch-Satterthwaite formula (JCGM 100, equation G.2b). Paired readings are one term: their
/// joint contribution is itself the mean of n values, with n - 1 degrees of freedom (H.2, note 2 of
/// table H.4 and approach 2). Saved results enter it by the inputs that they go back to; alone, this
/// is the same as by their own degrees of freedom.
fn effective_dof(
    budget: &[BudgetLine],
    distributions: &[Distribution],
    linked: &Linked,
    combined: f64,
) -> Dof {
    let contributes = |q: usize| budget.get(q).is_some_and(|line| line.contribution > 0.0);
    let saved = |q: usize| distributions.get(q).and_then(Distribution::saved);
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
    let alone =
        |q: usize| by_roots(q).is_none() && !linked.ensembles.iter().any(|set| set.contains(&q));
    let single: f64 = budget
        .iter()
        .enumerate()
        .filter(|(q, line)| estimated(*q) && alone(*q) && line.dof.is_finite())
        .map(|(_, line)| (line.contribution / combined).powi(4) / line.dof)
        .sum();
    let joint: f64 = linked
        .ensembles
        .iter()
        .map(|set| {
            let dof = set.first().and_then(|&q| budget.get(q)).map_or(f64::INFINITY, |l| l.dof);
            (joint_variance(set, budget, linked, combined)).powi(2) / dof
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
fn joint_variance(set: &[usize], budget: &[BudgetLine], linked: &Linked, combined: f64) -> f64 {
    let signed =
        |q: usize| budget.get(q).map_or(0.0, |l| l.contribution.copysign(l.sensitivity) / combined);
    let own: f64 = set.iter().map(|&q| signed(q).powi(2)).sum();
    let inside = linked.correlations.iter().filter(|c| set.contains(&c.first));
    let mixed: f64 = inside.map(|c| 2.0 * signed(c.first) * signed(c.second) * c.coefficient).sum();
    (own + mixed).max(0.0)
}

/// The coverage factor k_p (JCGM 100, G.3.3 and G.4.1): the t factor at the integer part of the
/// effective degrees of freedom (below 1 at the real value), or at the real value if asked for.
pub(crate) fn coverage_factor(coverage: Coverage, dof: Dof, real: bool) -> Option<f64> {
    if let Coverage::Factor { factor, fixed: true } = coverage {
        return Some(factor);
    }
    let probability = coverage.probability();
    match dof {
        Dof::Undefined => coverage.given_factor(),
        Dof::Infinite => Some(special::student::two_sided_factor(probability, f64::INFINITY)),
        Dof::Finite(dof) => {
            // a dof of 19 computed as 18.999999999 means 19
            let whole = (dof * (1.0 + 1e-9)).floor();
            let used = if real || whole < 1.0 { dof } else { whole };
            Some(special::student::two_sided_factor(probability, used))
        }
    }
}
