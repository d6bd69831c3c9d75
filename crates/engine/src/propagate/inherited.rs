//! Numerical errors that figures inherit from saved results, whose quantile functions and, without
//! sensitivity coefficients, whose estimates and standard uncertainties are those of so many trials.
//!
//! An error of a saved result is one quantity, however many trials are made of it. Let a be the share of
//! the output's standard deviation that comes from the result, rho the correlation coefficient of the two
//! (a, but for correlated inputs), and M the result's trials. What a deviation of its quantile function in
//! the Hermite polynomial of degree n of its normal score does is a rho^(n-1) times what it does to the
//! result's own figure of that degree: of the mean (n = 1), the standard deviation (2), the skewness (3)
//! and the kurtosis (4). Of a quantile at the normal score k it is by Mehler's formula
//! (a/rho)^2 (P(X < k, Y < k) - p^2)/(p (1 - p)) of the variance, X and Y normal with the correlation
//! coefficient rho^2. So each error is a factor of that of a single trial; exact for normal quantities
//! and linear models, and near to it for others.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::gum::Gum;
use super::monte_carlo::{MonteCarlo, NumericalError};
use crate::distribution::SavedResult;
use crate::number::elementary::{asin, exp, sin};
use crate::special::{legendre, normal};
use crate::task::Row;

/// From this relative difference of the trials' standard uncertainty and that of a linear model on, the
/// whole output may hang on a result, whatever the sensitivity coefficients say.
const NOT_LINEAR: f64 = 0.1;

/// Below it a squared correlation coefficient is as good as 0.
const SMALL: f64 = 1e-9;

/// What the limited trials of saved results do to the figures of an output.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Inherited {
    /// The variables that are saved results, with the number of trials that these are worth.
    pub results: Vec<(usize, f64)>,
    /// The variances of the figures' errors, in those of a single trial.
    pub(super) variances: Variances,
}

/// Variances of errors of figures, each in that of a single trial: 1/M of M trials.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Variances {
    pub(super) estimate: f64,
    pub(super) standard_uncertainty: f64,
    median: f64,
    /// Of an end of a coverage interval.
    pub(super) end: f64,
    skewness: f64,
    excess_kurtosis: f64,
}

/// How an output goes back to the variables of one saved result.
#[derive(Clone, Copy, Debug)]
struct InheritedPart {
    /// The share of the output's standard deviation.
    share: f64,
    /// The correlation coefficient with the output.
    coefficient: f64,
    /// Trials that the result is worth.
    trials: f64,
    seed: Option<u64>,
}

impl Inherited {
    /// What an output inherits: `reached` are the variables that it depends on, `figures` those of its
    /// trials, without which only estimates and standard uncertainties that are those of trials count.
    /// `None` if nothing.
    pub(super) fn of(
        row: &Row,
        gum: Option<&Gum>,
        figures: Option<&MonteCarlo>,
        reached: &[bool],
        probability: f64,
    ) -> Option<Self> {
        let limited = |v: usize| {
            let saved = row.distributions.get(v)?.saved()?;
            let counts = figures.is_some() || !saved.origin().linear;
            (counts && saved.origin().trials.is_finite()).then_some(saved)
        };
        let all = reached.iter().enumerate().filter(|(_, reached)| **reached);
        let all: Vec<(usize, &SavedResult)> =
            all.filter_map(|(v, _)| Some((v, limited(v)?))).collect();
        if all.is_empty() {
            return None;
        }
        // what was drawn from one file was drawn in the same trials
        let mut files: BTreeMap<&str, Vec<(usize, &SavedResult)>> = BTreeMap::new();
        for &(v, saved) in &all {
            files.entry(&saved.origin().file).or_default().push((v, saved));
        }
        let is_linear = |gum: &&Gum| {
            let drawn = gum.drawn_uncertainty();
            let spread = figures.map_or(Some(drawn), |figures| figures.standard_uncertainty);
            let near = |spread: f64| (spread - drawn).abs() <= NOT_LINEAR * drawn;
            gum.standard_uncertainty > 0.0 && (!drawn.is_finite() || spread.is_none_or(near))
        };
        let linear = gum.filter(is_linear).map(|gum| Linear::of(row, gum));
        let parts = files.values().map(|members| {
            let [share, coefficient] = match &linear {
                Some(linear) => linear.part(members),
                None => [1.0; 2],
            };
            let trials = members.iter().map(|(_, saved)| saved.origin().trials);
            let trials = trials.fold(f64::INFINITY, f64::min);
            let seed = members.first().and_then(|(_, saved)| saved.origin().seed);
            InheritedPart { share, coefficient, trials, seed }
        });
        let variances = Variances::of(&parts.collect::<Vec<_>>(), probability);
        let results = all.iter().map(|(v, saved)| (*v, saved.origin().trials));
        Some(Self { results: results.collect(), variances })
    }

    /// Adds it to the errors of so many trials.
    pub(super) fn add_to(&self, errors: &mut NumericalError, trials: u64) {
        let of = &self.variances;
        let grown = |variance: f64| (1.0 + trials as f64 * variance).sqrt();
        let some = |error: &mut Option<f64>, variance: f64| {
            *error = error.map(|error| error * grown(variance));
        };
        some(&mut errors.estimate, of.estimate);
        some(&mut errors.standard_uncertainty, of.standard_uncertainty);
        some(&mut errors.skewness, of.skewness);
        some(&mut errors.excess_kurtosis, of.excess_kurtosis);
        errors.median *= grown(of.median);
        errors.symmetric_interval.iter_mut().for_each(|error| *error *= grown(of.end));
        // which settle with the cube root of the trials
        let slower = libm::cbrt(grown(of.end).powi(2));
        errors.shortest_interval.iter_mut().for_each(|error| *error *= slower);
    }

    /// The number of trials without saved results whose estimate would be as uncertain as that of these.
    pub fn effective_trials(&self, trials: u64) -> f64 {
        let trials = trials as f64;
        trials / (1.0 + trials * self.variances.estimate)
    }
}

/// The drawn standard deviations of a linear model's contributions, signed, and how they depend on each
/// other.
struct Linear {
    parts: Vec<f64>,
    /// For each the covariance with the output.
    with_output: Vec<f64>,
    links: Vec<(usize, usize, f64)>,
    variance: f64,
}

impl Linear {
    fn of(row: &Row, gum: &Gum) -> Self {
        let mut parts = vec![0.0; row.distributions.len()];
        for line in gum.budget() {
            let Some(known) = row.distributions.get(line.variable) else { continue };
            let drawn = known.standard_deviation();
            let width = if drawn.is_finite() { drawn } else { known.standard_uncertainty() };
            parts[line.variable] = line.sensitivity * width;
        }
        let mut with_output: Vec<f64> = parts.iter().map(|part| part * part).collect();
        let links = gum.correlations().map(|c| (c.variables[0], c.variables[1], c.coefficient));
        let links: Vec<(usize, usize, f64)> = links.collect();
        for &(i, j, r) in &links {
            let joint = r * parts[i] * parts[j];
            with_output[i] += joint;
            with_output[j] += joint;
        }
        let variance = with_output.iter().sum::<f64>().max(0.0);
        Self { parts, with_output, links, variance }
    }

    /// The share of the output's standard deviation that variables have together, and their correlation
    /// coefficient with it.
    fn part(&self, members: &[(usize, &SavedResult)]) -> [f64; 2] {
        let has = |v: usize| members.iter().any(|(member, _)| *member == v);
        let own: f64 = members.iter().map(|(v, _)| self.parts[*v].powi(2)).sum();
        let inside = self.links.iter().filter(|(i, j, _)| has(*i) && has(*j));
        let joint: f64 = inside.map(|(i, j, r)| 2.0 * r * self.parts[*i] * self.parts[*j]).sum();
        let variance = (own + joint).max(0.0);
        if variance == 0.0 || self.variance == 0.0 {
            return [0.0; 2];
        }
        let with: f64 = members.iter().map(|(v, _)| self.with_output[*v]).sum();
        let share = (variance / self.variance).sqrt();
        [share, (with / (variance * self.variance).sqrt()).clamp(-1.0, 1.0)]
    }
}

impl Variances {
    /// The errors of results with one seed may be those of the same draws: they add up at most. Others
    /// are independent.
    fn of(parts: &[InheritedPart], probability: f64) -> Self {
        let together = |addend: &dyn Fn(&InheritedPart) -> f64| {
            let mut seeds: BTreeMap<u64, f64> = BTreeMap::new();
            let mut sum = 0.0;
            for part in parts {
                let variance = addend(part) / part.trials;
                match part.seed {
                    Some(seed) => *seeds.entry(seed).or_insert(0.0) += variance.sqrt(),
                    None => sum += variance,
                }
            }
            sum + seeds.values().map(|error| error * error).sum::<f64>()
        };
        let degree =
            |n: i32| together(&|part| part.share.powi(2) * part.coefficient.powi(2).powi(n - 1));
        let quantile = |p: f64| together(&|part| quantile(part.share, part.coefficient, p));
        Self {
            estimate: degree(1),
            standard_uncertainty: degree(2),
            median: quantile(0.5),
            end: quantile(0.5 * (1.0 - probability)),
            skewness: degree(3),
            excess_kurtosis: degree(4),
        }
    }
}

/// The variance of a quantile's error that comes from a part, in that of the quantile of a trial.
fn quantile(share: f64, coefficient: f64, p: f64) -> f64 {
    let squared = coefficient * coefficient;
    let k = normal::quantile(p);
    let own = p * (1.0 - p) * TAU;
    if squared < SMALL {
        return share * share * exp(-k * k) / own;
    }
    // P(X < k, Y < k) - p^2, an integral over the correlation coefficient sin(t)
    let joint = legendre::integrate(0.0, asin(squared), |t| exp(-k * k / (1.0 + sin(t))));
    share * share / squared * joint / own
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the whole output, a quantile has the error of its own trials: P(X < k, Y < k) of equal
    /// quantities is p. Of a part with rho^2 = 0.5 it is by `numpy`, the trapezoidal rule over
    /// phi(x) Phi((2 - x/2)/0.75^(1/2)) up to x = 2 less Phi(2)^2, over p (1 - p), 0.159 018. Without
    /// correlation it is phi(2)^2/(p (1 - p)) = 0.131 115.
    #[test]
    fn quantiles_inherit_errors() {
        let p = normal::cdf(-2.0);
        assert!((quantile(1.0, 1.0, p) - 1.0).abs() < 1e-9);
        assert!((quantile(1.0, -1.0, 0.5) - 1.0).abs() < 1e-9);
        let without = quantile(1.0, 0.0, p);
        assert!((without - 0.131_115).abs() < 1e-6, "{without}");
        let part = quantile(0.5_f64.sqrt(), 0.5_f64.sqrt(), p);
        assert!((part - 0.159_018).abs() < 1e-6, "{part}");
        // of the median: 2 asin(rho^2)/pi
        let median = quantile(0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.5);
        assert!((median - 1.0 / 3.0).abs() < 1e-9, "{median}");
    }
}
