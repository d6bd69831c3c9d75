//! Attributes the change of one output's u^2 and k between two saved results to the inputs.

use super::attribution::shapley;
use gumption_engine::propagate::gum;
use gumption_engine::propagate::gum::Dof;
use gumption_engine::task::Coverage;

/// Relative tolerance between a value in the file and the same value recomputed from the file's
/// inputs.
const ROUNDING: f64 = 1e-6;

/// How the coverage factor follows from the degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rule {
    coverage: Coverage,
    real_dof: bool,
}

impl Rule {
    fn factor(self, dof: f64) -> Option<f64> {
        let dof = if dof.is_nan() {
            Dof::Undefined
        } else if dof.is_infinite() {
            Dof::Infinite
        } else {
            Dof::Finite(dof)
        };
        gum::coverage_factor(self.coverage, dof, self.real_dof)
    }
}

/// The rules that give this coverage factor at these degrees of freedom: t with their integer part,
/// t with the real number, or a fixed factor.
fn rules(probability: Option<f64>, factor: f64, dof: f64) -> Vec<Rule> {
    let close = |rule: &Rule| {
        rule.factor(dof).is_some_and(|found| (found - factor).abs() <= ROUNDING * factor)
    };
    let of_probability = |p: f64| {
        let coverage = Coverage::Probability(p);
        [false, true].map(|real_dof| Rule { coverage, real_dof })
    };
    let mut fitting: Vec<Rule> = probability.into_iter().flat_map(of_probability).collect();
    fitting.retain(close);
    if fitting.is_empty() {
        let coverage = Coverage::Factor { factor, fixed: true };
        fitting.push(Rule { coverage, real_dof: false });
    }
    fitting
}

/// One output in one of two files; lists have an entry for each input of either file.
#[derive(Clone, Debug)]
pub(super) struct OutputFigures {
    /// Standard uncertainty.
    pub(super) standard_uncertainty: f64,
    /// Coverage factor.
    pub(super) coverage_factor: f64,
    /// Effective degrees of freedom; NaN if they are undefined.
    pub(super) dof: f64,
    /// Coverage probability, if it is known.
    pub(super) probability: Option<f64>,
    /// Signed contributions c u, in the unit of the standard uncertainty; 0 for an absent input.
    pub(super) contributions: Vec<f64>,
    /// Degrees of freedom of the inputs.
    pub(super) input_dof: Vec<f64>,
    /// Correlation coefficients between inputs, by their indices, in order.
    pub(super) correlations: Vec<(usize, usize, f64)>,
}

/// Who explains a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cause {
    /// The input of this index.
    Input(usize),
    /// Correlation coefficients.
    Correlations,
    /// Coverage probability, or the rule that gives the factor.
    Coverage,
    /// What none of them explains.
    Rest,
}

/// The parts of the changes of u^2 and k; they sum to the changes. Causes without effect are left
/// out.
pub(super) fn parts(sides: [&OutputFigures; 2]) -> Vec<(Cause, [f64; 2])> {
    let [first, second] = sides;
    let fitting = sides.map(|side| rules(side.probability, side.coverage_factor, side.dof));
    let common = fitting[0].iter().find(|rule| fitting[1].contains(rule));
    let rule = |side: usize| common.or(fitting[side].first()).copied();
    let (Some(from), Some(to)) = (rule(0), rule(1)) else {
        return Vec::new();
    };
    let moved = |&index: &usize| {
        let of = |side: &OutputFigures| {
            let dof = side.input_dof.get(index).map(|dof| dof.to_bits());
            (side.contributions.get(index).map(|c| c.to_bits()), dof)
        };
        of(first) != of(second)
    };
    let mut causes: Vec<Cause> =
        (0..first.contributions.len()).filter(moved).map(Cause::Input).collect();
    if first.correlations != second.correlations {
        causes.push(Cause::Correlations);
    }
    if from != to {
        causes.push(Cause::Coverage);
    }
    // the index of each cause, found once for all evaluations
    let place = |wanted: Cause| causes.iter().position(|cause| *cause == wanted);
    let (of_correlations, of_coverage) = (place(Cause::Correlations), place(Cause::Coverage));
    let mut of_input = vec![None; first.contributions.len()];
    for (place, cause) in causes.iter().enumerate() {
        if let Cause::Input(index) = cause {
            of_input[*index] = Some(place);
        }
    }
    let figures = |marks: &[bool]| {
        let is = |place: Option<usize>| place.is_some_and(|place| marks[place]);
        let side = |place: Option<usize>| sides[usize::from(is(place))];
        let rule = if is(of_coverage) { to } else { from };
        let contributions: Vec<f64> = of_input
            .iter()
            .enumerate()
            .map(|(q, place)| side(*place).contributions.get(q).copied().unwrap_or(0.0))
            .collect();
        let dof: Vec<f64> = of_input
            .iter()
            .enumerate()
            .map(|(q, place)| side(*place).input_dof.get(q).copied().unwrap_or(f64::INFINITY))
            .collect();
        let combined = combined(&contributions, &dof, &side(of_correlations).correlations);
        vec![combined.variance, rule.factor(combined.dof).unwrap_or(f64::NAN)]
    };
    let stated =
        |side: &OutputFigures| vec![side.standard_uncertainty.powi(2), side.coverage_factor];
    // both ends are the files' own values, so that the parts sum to the change to the last digit
    let value = |marks: &[bool]| {
        let computed = figures(marks);
        let end = match marks.iter().filter(|mark| **mark).count() {
            0 => stated(first),
            n if n == marks.len() => stated(second),
            _ => return computed,
        };
        let close = |(a, b): (&f64, &f64)| (a - b).abs() <= ROUNDING * b.abs();
        computed
            .iter()
            .zip(&end)
            .map(|(computed, stated)| if close((computed, stated)) { *stated } else { *computed })
            .collect()
    };
    let shares = shapley(causes.len(), &value);
    let mut parts: Vec<(Cause, [f64; 2])> = causes
        .iter()
        .zip(shares)
        .map(|(cause, share)| (*cause, [0, 1].map(|i| share.get(i).copied().unwrap_or(0.0))))
        .collect();
    let rest = [0, 1].map(|i| {
        let change = stated(second)[i] - stated(first)[i];
        change - parts.iter().map(|(_, part)| part[i]).sum::<f64>()
    });
    parts.push((Cause::Rest, rest));
    parts
}

/// u^2 and its effective degrees of freedom.
struct Combined {
    variance: f64,
    dof: f64,
}

/// The law of propagation and the Welch-Satterthwaite formula (JCGM 100, 5.2.2 and G.2b).
/// Correlated inputs with finite degrees of freedom form one term, because a result with degrees of
/// freedom has such inputs only from paired readings.
fn combined(contributions: &[f64], dof: &[f64], correlations: &[(usize, usize, f64)]) -> Combined {
    let at = |list: &[f64], index: usize| list.get(index).copied().unwrap_or(0.0);
    // the first input of the term to which each belongs
    let mut term: Vec<usize> = (0..contributions.len()).collect();
    let mut variance: f64 = contributions.iter().map(|c| c * c).sum();
    for &(i, j, r) in correlations {
        variance += 2.0 * r * at(contributions, i) * at(contributions, j);
        let joins = r != 0.0 && at(contributions, i) != 0.0 && at(contributions, j) != 0.0;
        if joins
            && at(dof, i).is_finite()
            && at(dof, j).is_finite()
            && let (Some(&a), Some(&b)) = (term.get(i), term.get(j))
        {
            term.iter_mut().filter(|t| **t == b).for_each(|t| *t = a);
        }
    }
    let variance = variance.max(0.0);
    let own = contributions.iter().map(|c| c * c);
    let mut of_term = vec![0.0; contributions.len()];
    for (index, square) in own.enumerate() {
        of_term[term[index]] += square;
    }
    for &(i, j, r) in correlations {
        if let (Some(a), Some(b)) = (term.get(i), term.get(j))
            && a == b
        {
            of_term[*a] += 2.0 * r * at(contributions, i) * at(contributions, j);
        }
    }
    let mut fewest = vec![f64::INFINITY; contributions.len()];
    for (&of, &dof) in term.iter().zip(dof) {
        fewest[of] = f64::min(fewest[of], dof);
    }
    let sum: f64 = of_term
        .iter()
        .zip(&fewest)
        .filter(|(part, _)| **part != 0.0)
        .map(|(part, fewest)| (part / variance).powi(2) / fewest)
        .sum();
    Combined { variance, dof: if sum > 0.0 { 1.0 / sum } else { f64::INFINITY } }
}
