//! Coverage regions of several outputs together (JCGM 102).
//!
//! By the law of propagation the outputs are jointly normal, with the covariance matrix U: the
//! ellipsoid (y - x)' U^-1 (y - x) <= k_p^2 has the chi-squared quantile as k_p^2 (6.5.2), and the
//! hyper-rectangle of half-lengths k_q u(y_j) holds at least p with the k_q of Bonferroni (6.5.3). Where
//! U has nu effective degrees of freedom the outputs have a multivariate t distribution: k_p^2 is the
//! quantile of Hotelling's T^2, nu m/(nu - m + 1) F(m, nu - m + 1) of m outputs, as for paired readings
//! (5.3; Hotelling, Ann. Math. Stat. 2 (1931) 360), and k_q that of a t distribution. From
//! trials k_p and k_q are the p-quantiles of the distances and of the largest standardized deviations
//! (7.7.2, 7.7.3), and the smallest region (7.7.4) lies within a level of their density.

mod smallest;

use nalgebra::DMatrix;

use crate::number::ascending;

use super::Control;
use super::evaluation_error::EvaluationError;
use super::figures::RowEvaluation;
use super::gum::{self, Dof, GumRow};
use super::monte_carlo::{Ranks, RowTrials, repeat};
use super::region_figures::{
    JointRegion, Region, RegionEvaluation, RegionValidation, SampledRegion, SmallestRegion,
};
use super::validate::numerical_tolerance;
use crate::linalg::{Eigen, packed};
use crate::special;
use crate::task::Task;

/// Trials that distances are kept of, at most: two numbers each.
const MOST_TRIALS: u64 = 8_000_000;

/// Trials of a figure.
const SHOWN: usize = 2000;

/// The regions of a row, whose figures are known.
pub(super) fn regions(
    task: &Task,
    row: &RowEvaluation,
    linear: &GumRow,
    trials: &RowTrials,
    control: &Control<'_>,
) -> Result<Vec<RegionEvaluation>, EvaluationError> {
    let usual = task.settings.coverage.probability();
    let correlations = linear.correlations();
    let evaluate = |region: &Region| {
        let probability = region.probability.unwrap_or(usual);
        let real_dof = task.settings.real_dof;
        let of_law = by_law(region, row, linear, &correlations, real_dof, probability);
        let (gum, dof) = of_law.unzip();
        let monte_carlo = from_trials(region, row, trials, probability, control)?;
        let validation = gum.as_ref().zip(monte_carlo.as_ref());
        let validation =
            validation.map(|(gum, monte_carlo)| compare(gum, monte_carlo, task.settings.digits));
        let outputs = region.outputs.clone();
        Ok(RegionEvaluation {
            outputs,
            probability,
            gum,
            dof: dof.flatten(),
            monte_carlo,
            validation,
        })
    };
    task.regions.iter().map(evaluate).collect()
}

/// The coefficient of outputs i and j among those of all pairs of `count` outputs.
fn coefficient(correlations: &[f64], count: usize, i: usize, j: usize) -> f64 {
    if i == j {
        return 1.0;
    }
    let (i, j) = (i.min(j), i.max(j));
    let place = i * count - i * (i + 1) / 2 + (j - i - 1);
    correlations.get(place).copied().unwrap_or(0.0)
}

/// The covariance matrix of a region's outputs; `None` where one has no standard uncertainty.
fn covariance(
    region: &Region,
    row: &RowEvaluation,
    correlations: &[f64],
    uncertainty: impl Fn(usize) -> Option<f64>,
) -> Option<Vec<f64>> {
    let u: Vec<f64> = region.outputs.iter().map(|o| uncertainty(*o)).collect::<Option<_>>()?;
    let count = row.outputs.len();
    let mut matrix = Vec::with_capacity(u.len() * u.len());
    for (a, i) in region.outputs.iter().enumerate() {
        for (b, j) in region.outputs.iter().enumerate() {
            // a constant output varies with none
            let r = coefficient(correlations, count, *i, *j);
            let r = if r.is_finite() { r } else { 0.0 };
            matrix.push(r * u[a] * u[b]);
        }
    }
    Some(matrix)
}

/// The Cholesky root of a covariance matrix as a packed triangle; `None` if it is singular.
fn root(covariance: &[f64], order: usize) -> Option<Vec<f64>> {
    let mut lower: Vec<f64> = (0..order)
        .flat_map(|i| (0..=i).map(move |j| (i, j)))
        .map(|(i, j)| covariance[i * order + j])
        .collect();
    packed::cholesky(&mut lower, 0.0).ok()?;
    let definite = |i: usize| {
        let pivot = lower[packed::triangle(i) + i];
        pivot * pivot > 1e-12 * covariance[i * order + i]
    };
    (0..order).all(definite).then_some(lower)
}

fn by_law(
    region: &Region,
    row: &RowEvaluation,
    linear: &GumRow,
    correlations: &[f64],
    real_dof: bool,
    probability: f64,
) -> Option<(JointRegion, Option<Dof>)> {
    let of = |output: usize| row.outputs.get(output)?.gum.as_ref();
    let estimates: Option<Vec<f64>> =
        region.outputs.iter().map(|o| Some(of(*o)?.estimate)).collect();
    let uncertainty = |output: usize| Some(of(output)?.standard_uncertainty);
    let covariance = covariance(region, row, correlations, uncertainty)?;
    let order = region.outputs.len();
    let dof = root(&covariance, order).map(|root| linear.joint_dof(&region.outputs, &root));
    let ellipsoid_k =
        dof.and_then(|dof| ellipsoid_factor(probability, order as f64, dof, real_dof));
    let each: Vec<Dof> = region.outputs.iter().filter_map(|o| Some(of(*o)?.dof)).collect();
    let box_k = box_factor(probability, &each, real_dof);
    Some((JointRegion { estimates: estimates?, covariance, ellipsoid_k, box_k }, dof))
}

/// k_p of the ellipsoid of so many outputs, whose covariance matrix has these degrees of freedom.
fn ellipsoid_factor(probability: f64, order: f64, dof: Dof, real_dof: bool) -> Option<f64> {
    match dof {
        Dof::Undefined => None,
        Dof::Infinite => Some((2.0 * special::gamma::quantile(probability, 0.5 * order)).sqrt()),
        Dof::Finite(dof) => {
            let dof = gum::used(dof, real_dof);
            let left = dof - order + 1.0;
            // of F = (left/order) (1 - x)/x, x has a beta distribution
            let x = || special::beta::quantile(1.0 - probability, 0.5 * left, 0.5 * order);
            (left > 0.0).then(|| (dof * (1.0 - x()) / x()).sqrt()).filter(|k| k.is_finite())
        }
    }
}

/// k_q of the hyper-rectangle of outputs with these degrees of freedom, the fewest of which decide: each
/// interval alone holds 1 - (1 - p)/m, all together at least p.
fn box_factor(probability: f64, each: &[Dof], real_dof: bool) -> Option<f64> {
    let outside = 0.5 * (1.0 - probability) / each.len() as f64;
    let fewest = each.iter().try_fold(f64::INFINITY, |fewest, dof| match dof {
        Dof::Undefined => None,
        Dof::Infinite => Some(fewest),
        Dof::Finite(dof) => Some(fewest.min(gum::used(*dof, real_dof))),
    })?;
    let k = if fewest.is_infinite() {
        -special::normal::quantile(outside)
    } else {
        -special::student::quantile(outside, fewest)
    };
    Some(k).filter(|k| k.is_finite())
}

fn from_trials(
    region: &Region,
    row: &RowEvaluation,
    trials: &RowTrials,
    probability: f64,
    control: &Control<'_>,
) -> Result<Option<SampledRegion>, EvaluationError> {
    let of = |output: usize| row.outputs.get(output)?.monte_carlo.as_ref();
    let uncertainty = |output: usize| of(output)?.standard_uncertainty;
    let estimates: Option<Vec<f64>> = region.outputs.iter().map(|o| of(*o)?.estimate).collect();
    let covariance = covariance(region, row, &row.correlations, uncertainty);
    let (Some(estimates), Some(covariance), Some(made)) = (estimates, covariance, row.made())
    else {
        return Ok(None);
    };
    let order = region.outputs.len();
    let root = root(&covariance, order);
    let scales: Vec<f64> = (0..order).map(|i| covariance[i * order + i].sqrt()).collect();
    if scales.contains(&0.0) {
        return Ok(None);
    }
    let count = made.min(MOST_TRIALS);
    let mut distances: Vec<f64> = Vec::new();
    let mut deviations: Vec<f64> = Vec::new();
    let mut places: Vec<smallest::TrialPlace> = Vec::new();
    let every = (count as usize).div_ceil(SHOWN).max(1);
    let mut sample = vec![Vec::new(); order];
    let mut number = 0;
    let finished = repeat(trials, count, control, |block: &[Vec<f64>]| {
        let columns: Vec<&[f64]> =
            region.outputs.iter().map(|o| block.get(*o).map_or(&[][..], Vec::as_slice)).collect();
        let length = columns.first().map_or(0, |column| column.len());
        let mut off = vec![0.0; order];
        for trial in 0..length {
            let mut largest = 0.0_f64;
            for (i, column) in columns.iter().enumerate() {
                off[i] = column[trial] - estimates[i];
                largest = largest.max((off[i] / scales[i]).abs());
                if number % every == 0 {
                    sample[i].push(column[trial]);
                }
            }
            number += 1;
            deviations.push(largest);
            if let Some(root) = &root {
                packed::solve(root, &mut off);
                distances.push(off.iter().map(|z| z * z).sum::<f64>().sqrt());
                if order <= smallest::MOST_OUTPUTS && places.len() < smallest::MOST_TRIALS {
                    let mut place = smallest::TrialPlace::default();
                    place[..order].copy_from_slice(&off);
                    places.push(place);
                }
            }
        }
        Ok::<(), EvaluationError>(())
    })?;
    let trials = deviations.len() as u64;
    if !finished || trials < 100 {
        return Ok(None);
    }
    let (box_k, box_error) = quantile(&mut deviations, probability);
    let ellipsoid = root.as_ref().map(|_| quantile(&mut distances, probability));
    let smallest = match &root {
        None => Err("the covariance matrix is singular: the outputs lie on a surface without a \
                     volume"
            .to_owned()),
        Some(_) if order > smallest::MOST_OUTPUTS => {
            Err(format!("trials give the density of at most {} outputs", smallest::MOST_OUTPUTS))
        }
        Some(root) => smallest::smallest(&places, root, probability),
    };
    let ellipsoid_k = ellipsoid.map(|(k, _)| k);
    Ok(Some(SampledRegion {
        region: JointRegion { estimates, covariance, ellipsoid_k, box_k: Some(box_k) },
        trials,
        smallest,
        ellipsoid_error: ellipsoid.map(|(_, error)| error),
        box_error,
        sample,
    }))
}

/// The p-quantile of values by the rank of JCGM 101, 7.7, and its numerical standard error from the
/// values a standard deviation of the rank below and above.
fn quantile(values: &mut [f64], probability: f64) -> (f64, f64) {
    ascending(values);
    let count = values.len();
    let rank = (Ranks::new(count as u64, probability).q as usize).clamp(1, count);
    let spread = (count as f64 * probability * (1.0 - probability)).sqrt().ceil() as usize;
    let at = |rank: usize| values[rank.clamp(1, count) - 1];
    (at(rank), 0.5 * (at(rank + spread) - at(rank.saturating_sub(spread))))
}

fn compare(gum: &JointRegion, found: &SampledRegion, digits: u32) -> RegionValidation {
    let (order, of_trials) = (gum.estimates.len(), &found.region);
    let u = |of: &JointRegion, i: usize| of.covariance[i * order + i].sqrt();
    let mut differences = Vec::with_capacity(2 * order);
    for i in 0..order {
        let tolerance = numerical_tolerance(u(gum, i), digits);
        differences.push([(gum.estimates[i] - of_trials.estimates[i]).abs(), tolerance]);
    }
    for i in 0..order {
        let tolerance = numerical_tolerance(u(gum, i), digits);
        differences.push([(u(gum, i) - u(of_trials, i)).abs(), tolerance]);
    }
    let largest = |of: &JointRegion| {
        let matrix = DMatrix::from_fn(order, order, |i, j| {
            let scale = u(of, i) * u(of, j);
            if scale > 0.0 { of.covariance[i * order + j] / scale } else { f64::from(i == j) }
        });
        Eigen::of(&matrix).values.into_iter().fold(0.0, f64::max)
    };
    let value = largest(gum);
    let eigenvalue = [(value - largest(of_trials)).abs(), numerical_tolerance(value, digits)];
    let factors = gum.ellipsoid_k.zip(of_trials.ellipsoid_k);
    let ellipsoid = factors.map(|(a, b)| [(a - b).abs(), numerical_tolerance(a, digits)]);
    let all = differences.iter().chain(std::iter::once(&eigenvalue)).chain(&ellipsoid);
    let gum_valid = ellipsoid.is_some() && all.into_iter().all(|[d, tolerance]| d <= tolerance);
    RegionValidation { differences, eigenvalue, ellipsoid, gum_valid }
}
