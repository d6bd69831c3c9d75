//! Figures of an output without the noise of trials.
//!
//! Where the recorded program is a sum of functions of independent groups of inputs, or a product of
//! such functions, the distribution of the output follows from the characteristic functions of the
//! summands, or of the logarithms of the factors ([`invert`]); of one quantity alone from its quantile
//! function. All figures then come with a bound of what they may be off.

mod existence;
mod invert;
mod law;
mod separate;
mod tails;
mod term;
#[cfg(test)]
mod tests;
#[cfg(test)]
pub(super) use tests::task as test_task;

pub(super) use existence::{of_moments as moments_exist, pole_order};

use std::sync::Arc;

use self::invert::{Decay, Inversion, Sum};
use self::law::{BoundedValue, Law};
pub(super) use self::separate::is_linear;
use self::separate::{Leaf, Outer, SeparateGroup, Separated, separate};
use self::term::{Term, TermInputs};
use crate::distribution::characteristic::Characteristic;
use crate::distribution::{Dependence, Distribution, Joint, Normal, StudentT};
use crate::model::{Node, Output, Program, Tolerance, fold};
use crate::number::smallest_first;
use crate::task::{Row, Task};

/// Figures of an output that no seed moves.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Noiseless {
    /// Expectation; `None` if the distribution has none.
    pub estimate: Option<f64>,
    /// Standard deviation; `None` if the distribution has none.
    pub standard_uncertainty: Option<f64>,
    /// Median.
    pub median: f64,
    /// Probabilistically symmetric coverage interval.
    pub symmetric_interval: [f64; 2],
    /// Shortest coverage interval, never longer than the symmetric one; `None` where its ends are not known
    /// to a millionth of the standard uncertainty.
    pub shortest_interval: Option<[f64; 2]>,
    /// Whether there is one shortest interval: where the density is flat, or two intervals are as short,
    /// there is not, and one of them is given.
    pub shortest_unique: bool,
    /// The probability of values within the output's tolerance limits, where it has such.
    pub inside: Option<f64>,
    /// How far the figures may be off.
    pub accuracy: Accuracy,
}

/// How far figures may be off.
#[derive(Clone, Debug, PartialEq)]
pub enum Accuracy {
    /// None of them is off by more than this, in the output's unit.
    Bound(f64),
    /// Numerical standard errors, from independent randomizations.
    Scatter(Box<Scatter>),
}

impl Noiseless {
    /// The numerical standard errors, where the figures have such.
    pub fn scatter(&self) -> Option<&Scatter> {
        match &self.accuracy {
            Accuracy::Bound(_) => None,
            Accuracy::Scatter(scatter) => Some(scatter),
        }
    }
}

/// Numerical standard errors of [`Noiseless`], by its fields' names.
#[derive(Clone, Debug, PartialEq)]
pub struct Scatter {
    /// Of the expectation.
    pub estimate: Option<f64>,
    /// Of the standard deviation.
    pub standard_uncertainty: Option<f64>,
    /// Of the median.
    pub median: f64,
    /// Of the ends of the symmetric interval.
    pub symmetric_interval: [f64; 2],
    /// Of the ends of the shortest interval.
    pub shortest_interval: Option<[f64; 2]>,
    /// Of the probability within the tolerance limits.
    pub inside: Option<f64>,
    /// Points of a randomization.
    pub points: u64,
    /// Randomizations.
    pub randomizations: u32,
    /// The input that is integrated exactly.
    pub integrated: String,
}

/// Bounds beyond this share of the standard uncertainty are not exact.
const EXACT: f64 = 1e-9;

/// The same of the ends of a shortest interval, which are less certain than its length: that hardly changes
/// where they move together.
const OF_SHORTEST: f64 = 1e-6;

/// What an evaluation of one output needs.
pub(crate) struct Problem<'a> {
    pub(crate) task: &'a Task,
    pub(crate) row: &'a Row,
    pub(crate) joint: &'a Joint,
    /// Number of the output.
    pub(crate) output: usize,
    /// The fewest degrees of freedom among the t distributions that it depends on.
    pub(crate) drawn_dof: f64,
}

/// The values of a program's nodes that do not vary in a row.
pub(super) fn folded(program: &Program, row: &Row) -> Vec<Option<f64>> {
    let mut bound: Vec<Option<f64>> = row.distributions.iter().map(|d| d.constant()).collect();
    bound.extend(row.conditions.iter().map(|&value| Some(value)));
    fold(program, &bound)
}

impl<'a> Problem<'a> {
    /// The limits of the row's output.
    pub(crate) fn tolerance(&self) -> Option<Tolerance> {
        self.quantity().at(&self.row.conditions).tolerance
    }

    pub(crate) fn quantity(&self) -> &'a Output {
        &self.task.model.outputs[self.output]
    }

    /// The values of the program's nodes that do not vary.
    pub(crate) fn folded(&self) -> Vec<Option<f64>> {
        folded(&self.task.model.program, self.row)
    }

    /// Whether the output is a sum of inputs times constants.
    pub(crate) fn is_linear(&self) -> bool {
        let program = &self.task.model.program;
        let output = program.outputs.get(self.output);
        let is_sum = output.is_some_and(|node| is_linear(program, &self.folded(), *node));
        self.task.function.is_none() && self.quantity().period.is_none() && is_sum
    }

    pub(crate) fn probability(&self) -> f64 {
        self.task.settings.coverage.probability()
    }
}

/// The exact figures of an output.
///
/// # Errors
/// Why there are none.
pub(crate) fn evaluate(problem: &Problem<'_>) -> Result<Noiseless, String> {
    let output = problem.quantity();
    if output.period.is_some() {
        return Err("a phase is periodic and not a sum".to_owned());
    }
    let program = &problem.task.model.program;
    let node = program.outputs[problem.output];
    let folded = problem.folded();
    let linked = problem.joint.linked();
    let inputs = TermInputs {
        program,
        folded: &folded,
        distributions: &problem.row.distributions,
        linked: &linked,
    };
    let separated = checked(&inputs, separate(program, &folded, node, &linked), node)?;
    let drawn = |l: &usize| linked[*l].dependence == Dependence::Trials;
    if separated.groups.iter().any(|group| group.linked.iter().any(drawn)) {
        return Err(term::DRAWN_TOGETHER.to_owned());
    }
    if separated.groups.is_empty() {
        return Err("the output does not vary".to_owned());
    }
    let (law, moments) = distribution(problem, &inputs, &separated)?;
    figures(problem, &law, moments)
}

/// The most by which the parts together may differ from the formula, in parts of the largest of them:
/// far beyond rounding, and far below any mistake.
const SAME: f64 = 1e-6;

/// Holds the parts against the formula at the inputs' expectations. A product has the sign there that
/// the logarithms of its factors have lost: each factor keeps its own, or it is refused later. A root or
/// a logarithm of what is below zero has no value there.
fn checked(
    inputs: &TermInputs<'_>,
    separated: Separated,
    node: usize,
) -> Result<Separated, String> {
    let value = |group: &SeparateGroup| {
        let part = term::SubProgram::new(inputs, group);
        let of = |v: &usize| inputs.distributions.get(*v).map_or(f64::NAN, |of| term::middle(of));
        let values: Vec<f64> = group.variables.iter().map(of).collect();
        part.value(&values, &mut vec![0.0; part.leaves()])
    };
    let whole = SeparateGroup {
        variables: separate::variables_of(inputs.program, inputs.folded, node),
        linked: Vec::new(),
        leaves: vec![Leaf { node, factor: 1.0, logarithm: false }],
    };
    let parts: Option<Vec<f64>> = separated.groups.iter().map(value).collect();
    let (whole, parts) = match (value(&whole), parts) {
        (Some(whole), Some(parts)) => (whole, parts),
        // what has no value at the expectations alone is met where the distribution is looked for
        (None, None) | (Some(_), None) => return Ok(separated),
        (None, Some(_)) => {
            return Err("the formula has no value at the estimates of the inputs".to_owned());
        }
    };
    let sum = separated.constant + parts.iter().sum::<f64>();
    let (outer, together, largest) = match separated.outer {
        Outer::Sum => {
            let largest =
                parts.iter().map(|part| part.abs()).fold(separated.constant.abs(), f64::max);
            (Outer::Sum, sum, largest)
        }
        Outer::Product { factor, shift } => {
            let modulus = factor.abs() * crate::number::elementary::exp(sum);
            let factor = factor.abs() * (whole - shift).signum();
            let outer = Outer::Product { factor, shift };
            (outer, shift + factor.signum() * modulus, modulus.max(shift.abs()))
        }
    };
    if (together - whole).abs() > SAME * largest {
        return Err(format!(
            "the formula is {whole} at the estimates of the inputs, and its parts together are {together}"
        ));
    }
    Ok(Separated { outer, ..separated })
}

/// Expectation and standard deviation of an output; not finite where there are none.
#[derive(Clone, Copy, Debug)]
struct ExactMoments {
    mean: f64,
    std: f64,
    /// How far the two may be off.
    off: f64,
}

impl ExactMoments {
    /// Those that are known to rounding.
    fn known(mean: f64, std: f64) -> Self {
        Self { mean, std, off: 0.0 }
    }

    /// Of a constant and summands.
    fn of_sum(constant: f64, terms: &[Term]) -> Self {
        let mean = constant + terms.iter().map(Term::expectation).sum::<f64>();
        let std = terms.iter().map(Term::variance).sum::<f64>().sqrt();
        let off = |of: usize| terms.iter().map(|term| term.beyond[of].off).sum::<f64>();
        Self { mean, std, off: f64::max(off(0), 0.5 * off(1) / std) }
    }
}

/// The distribution of the output, and its moments.
fn distribution(
    problem: &Problem<'_>,
    inputs: &TermInputs<'_>,
    separated: &Separated,
) -> Result<(Law, ExactMoments), String> {
    if let ([group], Outer::Sum) = (separated.groups.as_slice(), separated.outer) {
        return one(inputs, group, separated.constant);
    }
    let tail = 0.5 * (1.0 - problem.probability());
    let product = separated.outer != Outer::Sum;
    let (mut terms, mut open) = (Vec::new(), Vec::new());
    for group in &separated.groups {
        match term::closed(inputs, group) {
            Some(term) => terms.push(term),
            None => open.push(group),
        }
    }
    let rectangles = if open.is_empty() { Inversion::of_rectangles(&terms) } else { None };
    let inversion = match rectangles {
        Some(inversion) => inversion,
        None => {
            let decays: Vec<Decay> =
                open.iter().map(|group| term::decay(inputs, group)).collect::<Result<_, _>>()?;
            let plan = Sum { closed: &terms, open: &decays, tail }.plan()?;
            for group in open {
                terms.push(term::term(inputs, group, plan.last, product)?);
            }
            Inversion::new(&terms, plan)
        }
    };
    let mean = separated.constant + terms.iter().map(|term| term.mean).sum::<f64>();
    let symmetric = terms.iter().all(|term| term.law.is_symmetric_unimodal());
    let moments = match separated.outer {
        Outer::Sum => ExactMoments::of_sum(separated.constant, &terms),
        Outer::Product { factor, shift } => {
            let scale = factor * crate::number::elementary::exp(separated.constant);
            // the relative variance of a product, from those of its factors
            let (mut expectation, mut excess) = (scale, 0.0);
            let mut off = [0.0; 2];
            for term in &terms {
                let [first, second] = match (term.powers, &term.law) {
                    (Some(powers), _) => powers,
                    (None, Characteristic::Normal { std }) => {
                        let s = std * term.factor;
                        let power = |n: f64| {
                            crate::number::elementary::exp(n * term.mean + 0.5 * n * n * s * s)
                        };
                        [[power(1.0), 0.0], [power(2.0), 0.0]]
                    }
                    // a factor that is the exponential of a quantity
                    _ => [[f64::NAN, 0.0]; 2],
                };
                off[0] += first[1];
                off[1] += second[1] + 2.0 * first[1];
                let [first, second] = [first[0], second[0]];
                expectation *= first;
                let own = second / (first * first) - 1.0;
                excess = excess + own + excess * own;
            }
            let std = expectation.abs() * excess.max(0.0).sqrt();
            let of_square = 0.5 * off[1] * (expectation * expectation + std * std) / std;
            let off = f64::max(off[0] * expectation.abs(), of_square);
            ExactMoments { mean: shift + expectation, std, off }
        }
    };
    let outer = separated.outer;
    let last = std::cell::Cell::new([0.0; 2]);
    Ok((Law::Sum { inversion, mean, outer, symmetric, last }, moments))
}

/// The distribution of a function of one quantity.
fn one(
    inputs: &TermInputs<'_>,
    group: &SeparateGroup,
    constant: f64,
) -> Result<(Law, ExactMoments), String> {
    let closed = term::closed(inputs, group);
    let linear = |variable: Option<usize>| -> Option<Law> {
        let (leaf, v) = (group.leaves.first()?, variable?);
        let distribution = Arc::clone(inputs.distributions.get(v)?);
        let factor = leaf.factor;
        let function = Box::new(move |x: f64| constant + factor * x);
        distribution.has_quantiles().then_some(())?;
        Some(Law::One { distribution, rising: factor > 0.0, function })
    };
    let variable = match (group.leaves.as_slice(), group.variables.as_slice()) {
        ([leaf], [v]) if !leaf.logarithm => {
            matches!(inputs.program.nodes[leaf.node], Node::Variable(_)).then_some(*v)
        }
        _ => None,
    };
    if let Some(v) = variable {
        let law = linear(Some(v)).ok_or_else(|| "no quantiles are known".to_owned())?;
        let distribution = &inputs.distributions[v];
        let factor = group.leaves[0].factor;
        let mean = constant + factor * term::middle(distribution);
        let std = factor.abs() * distribution.standard_deviation();
        return Ok((law, ExactMoments::known(mean, std)));
    }
    if let Some(term) = closed {
        let scale = term.factor.abs();
        let made = match &term.law {
            Characteristic::Normal { std } => {
                Normal::new(0.0, std * scale).ok().map(Distribution::from)
            }
            Characteristic::Student(student) => {
                let scale = term.width();
                StudentT::new(0.0, scale, student.dof()).ok().map(Distribution::from)
            }
            _ => None,
        };
        let made = made.ok_or_else(|| "the quantity has no width".to_owned())?;
        let std = made.standard_deviation();
        let mean = constant + term.mean;
        let function = Box::new(move |x: f64| mean + x);
        return Ok((
            Law::One { distribution: Arc::new(made), rising: true, function },
            ExactMoments::known(mean, std),
        ));
    }
    let [v] = group.variables.as_slice() else {
        return Err(format!(
            "{} inputs are in one function that is neither a sum nor a product of functions of \
             one input",
            group.variables.len()
        ));
    };
    let distribution = Arc::clone(&inputs.distributions[*v]);
    let part = term::SubProgram::new(inputs, group);
    let value = move |x: f64| {
        let mut signs = vec![0.0; part.leaves()];
        part.value(&[x], &mut signs).map_or(f64::NAN, |value| constant + value)
    };
    let places: Vec<f64> = (1..512)
        .map(|k| f64::from(k) / 512.0)
        .chain([1e-12, 1e-9, 1e-6, 1e-4])
        .map(|p| distribution.quantile(p))
        .chain([1e-4, 1e-6, 1e-9, 1e-12].map(|q| distribution.quantile_upper(q)))
        .collect();
    let mut pairs: Vec<[f64; 2]> = places.into_iter().map(|x| [x, value(x)]).collect();
    smallest_first(&mut pairs, |pair| pair[0]);
    let steps: Vec<f64> =
        pairs.windows(2).filter(|w| w[1][0] > w[0][0]).map(|w| w[1][1] - w[0][1]).collect();
    let rising = steps.iter().all(|step| *step > 0.0);
    if !rising && !steps.iter().all(|step| *step < 0.0) {
        return Err("the output is not a monotone function of its only input".to_owned());
    }
    let frequency = 1e-3 / (pairs[pairs.len() / 2][1] - pairs[0][1]).abs();
    let found = term::term(inputs, group, frequency, false)?;
    let moments = ExactMoments::of_sum(constant, &[found]);
    Ok((Law::One { distribution, rising, function: Box::new(value) }, moments))
}

/// The figures of a distribution.
fn figures(problem: &Problem<'_>, law: &Law, moments: ExactMoments) -> Result<Noiseless, String> {
    let ExactMoments { mean, std, off } = moments;
    let p = problem.probability();
    let tail = 0.5 * (1.0 - p);
    let missing =
        || "the density is nearly zero at an endpoint of the interval or at the median".to_owned();
    let found = |p: f64, q: f64| law.quantile(p, q).ok_or_else(missing);
    let median = found(0.5, 0.5)?;
    let symmetric = [found(tail, 1.0 - tail)?, found(1.0 - tail, tail)?];
    let length = symmetric[1].value - symmetric[0].value;
    let scale = if std.is_finite() && std > 0.0 { std } else { 0.25 * length };
    let bounds = [median, symmetric[0], symmetric[1]].map(|value: BoundedValue| value.bound);
    let mut bound = bounds.into_iter().fold(0.0, f64::max);
    if bound.is_nan() || bound > EXACT * scale {
        return Err(format!(
            "the endpoints of the interval would be known only to {:.0e} of the standard \
             uncertainty",
            bound / scale
        ));
    }
    // of moments that do not exist nothing is off
    if std.is_finite() && mean.is_finite() {
        if off.is_nan() || off > EXACT * scale {
            return Err(format!(
                "the tails beyond probabilities of 1e-17 hold so much of the standard uncertainty \
                 that it would be known to {:.0e} of itself only",
                off / scale
            ));
        }
        bound = bound.max(off);
    }
    let shortest = law.shortest(p, symmetric);
    let unique = shortest.is_some_and(|(_, unique)| unique);
    let known = |ends: &[BoundedValue; 2]| ends.iter().all(|end| end.bound <= OF_SHORTEST * scale);
    let shortest = shortest.map(|(ends, _)| ends).filter(known);
    if let Some([low, high]) = &shortest {
        bound = bound.max(low.bound).max(high.bound);
    }
    let inside = problem.tolerance().map(|tolerance| {
        let [low, high] = tolerance.ends();
        (law.probability(high) - law.probability(low)).clamp(0.0, 1.0)
    });
    Ok(Noiseless {
        estimate: (problem.drawn_dof > 1.0 && mean.is_finite()).then_some(mean),
        standard_uncertainty: (problem.drawn_dof > 2.0 && std.is_finite()).then_some(std),
        median: median.value,
        symmetric_interval: symmetric.map(|end| end.value),
        shortest_interval: shortest.map(|ends| ends.map(|end| end.value)),
        shortest_unique: unique,
        inside,
        accuracy: Accuracy::Bound(bound),
    })
}
