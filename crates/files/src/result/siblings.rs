//! How the outputs of a result file vary together where sensitivity coefficients do not tell it.
//!
//! An output without them is its own only root. What its trials had in common with those of the other
//! outputs becomes correlation coefficients between roots, so that it is kept through later models that
//! take one output each.

use std::sync::Arc;

use super::reader::SavedOutput;
use gumption_engine::distribution::{
    Distribution, Origin, Root, RootCorrelation, RootName, SavedResult,
};

/// Of an output's variance, what is left beside other outputs and is no more than their rounding.
const DEPENDENT: f64 = 1e-9;

/// Differences of correlation coefficients that are rounding.
const ROUNDING: f64 = 1e-9;

/// At most so many outputs with sensitivity coefficients tell of one without.
const MOST_TELLING: usize = 16;

/// Tells all outputs of the coefficients between those that are their own only roots, and between these
/// and the roots of the others. `roots` are those of the file, `correlations` the coefficients between
/// them.
pub(super) fn tell_each_other(
    outputs: &mut [SavedOutput],
    roots: &[Root],
    correlations: &[RootCorrelation],
) {
    let saved = || outputs.iter().filter_map(|output| output.distribution.saved());
    let alone: Vec<SavedResult> = saved().filter(|saved| !saved.origin().linear).cloned().collect();
    if alone.is_empty() {
        return;
    }
    let linear: Vec<SavedResult> = saved().filter(|saved| saved.origin().linear).cloned().collect();
    let own = |saved: &SavedResult| saved.origin().roots.first().map(|(root, _)| root.clone());
    let own_roots: Vec<Root> = alone.iter().filter_map(own).collect();
    let mut all = correlations.to_vec();
    all.extend(among(&alone, &own_roots));
    let inputs = RootInputs::new(roots, correlations, &linear);
    for (result, root) in alone.iter().zip(&own_roots) {
        all.extend(inputs.with(result, &root.name));
    }
    let all: Arc<[RootCorrelation]> = all.into();
    let known: Arc<[Root]> = roots.iter().cloned().chain(own_roots).collect();
    for output in outputs {
        if let Distribution::SavedResult(saved) = &mut output.distribution {
            let (known, correlations) = (known.clone(), all.clone());
            *saved = saved.with_origin(Origin { known, correlations, ..saved.origin().clone() });
        }
    }
}

/// The coefficients between outputs that are their own only roots: those of their trials.
fn among(alone: &[SavedResult], own: &[Root]) -> Vec<RootCorrelation> {
    let name = |wanted: &str| own.iter().find(|root| *root.name.name == *wanted);
    let mut found = Vec::new();
    for saved in alone {
        let origin = saved.origin();
        let Some(first) = name(&origin.output) else { continue };
        for (other, coefficient) in &origin.siblings {
            let Some(second) = name(other).filter(|second| first.name < second.name) else {
                continue;
            };
            let (first, second) = (first.name.clone(), second.name.clone());
            found.push(RootCorrelation { first, second, coefficient: *coefficient });
        }
    }
    found
}

/// The inputs of the file, and the outputs that go back to them.
struct RootInputs<'a> {
    roots: &'a [Root],
    /// Places in `roots`, and a coefficient.
    correlations: Vec<(usize, usize, f64)>,
    /// Names of outputs, with the weights of the roots in their standard uncertainties.
    outputs: Vec<(&'a str, Vec<f64>)>,
}

/// A linear function of the inputs of variance 1, uncorrelated with others: its coefficients with the
/// inputs, and with the output that is looked at.
struct Direction {
    with_inputs: Vec<f64>,
    coefficient: f64,
}

impl<'a> RootInputs<'a> {
    fn new(roots: &'a [Root], correlations: &[RootCorrelation], linear: &'a [SavedResult]) -> Self {
        let place = |name: &RootName| roots.iter().position(|root| root.name == *name);
        let coefficients = correlations.iter();
        let coefficients =
            coefficients.filter_map(|c| Some((place(&c.first)?, place(&c.second)?, c.coefficient)));
        let outputs = linear.iter().map(|saved| {
            let mut weights = vec![0.0; roots.len()];
            for (root, weight) in &saved.origin().roots {
                if let Some(own) = place(&root.name).and_then(|place| weights.get_mut(place)) {
                    *own += weight;
                }
            }
            (saved.origin().output.as_str(), weights)
        });
        Self { roots, correlations: coefficients.collect(), outputs: outputs.collect() }
    }

    /// The coefficients of each input with the output of these weights.
    fn with_inputs(&self, weights: &[f64]) -> Vec<f64> {
        let mut found = weights.to_vec();
        for &(i, j, r) in &self.correlations {
            if let (Some(a), Some(b)) = (weights.get(i), weights.get(j)) {
                let [to_first, to_second] = [r * b, r * a];
                found[i] += to_first;
                found[j] += to_second;
            }
        }
        found
    }

    /// The coefficients of the inputs with an output that has none to them: those of a quantity that
    /// varies with the other outputs as its trials did, and with nothing else of the inputs. One output
    /// after the other is taken in, that first of which the least is told so far.
    fn with(&self, result: &SavedResult, name: &RootName) -> Vec<RootCorrelation> {
        let siblings = &result.origin().siblings;
        let trials =
            |output: &str| siblings.iter().find(|(sibling, _)| sibling == output).map(|(_, r)| *r);
        let mut directions: Vec<Direction> = Vec::new();
        // what is not told yet of each coefficient
        let mut left: Vec<(&[f64], f64)> = Vec::new();
        for (output, weights) in &self.outputs {
            left.extend(trials(output).map(|r| (weights.as_slice(), r)));
        }
        while directions.len() < MOST_TELLING {
            let sizes = left.iter().map(|(_, untold)| untold.abs()).enumerate();
            let Some((place, size)) = sizes.max_by(|a, b| a.1.total_cmp(&b.1)) else { break };
            if size <= ROUNDING {
                break;
            }
            let (weights, untold) = left.swap_remove(place);
            let Some(direction) = self.direction(weights, untold, &directions) else { continue };
            for (weights, untold) in &mut left {
                *untold -= direction.coefficient * dot(weights, &direction.with_inputs);
            }
            directions.push(direction);
        }
        let mut found = vec![0.0; self.roots.len()];
        for direction in &directions {
            for (found, with) in found.iter_mut().zip(&direction.with_inputs) {
                *found += direction.coefficient * with;
            }
        }
        let told = self.roots.iter().zip(found).filter(|(_, r)| r.abs() > ROUNDING);
        told.map(|(root, r)| RootCorrelation {
            first: root.name.clone(),
            second: name.clone(),
            coefficient: r.clamp(-1.0, 1.0),
        })
        .collect()
    }

    /// What the output of these weights has beside `others`, of which the coefficient `untold` is left;
    /// `None` if that is no more than rounding.
    fn direction(&self, weights: &[f64], untold: f64, others: &[Direction]) -> Option<Direction> {
        let mut with_inputs = self.with_inputs(weights);
        let mut variance = dot(weights, &with_inputs);
        let mut told = 0.0;
        for other in others {
            let share = dot(weights, &other.with_inputs);
            variance -= share * share;
            told += other.coefficient * other.coefficient;
            for (own, with) in with_inputs.iter_mut().zip(&other.with_inputs) {
                *own -= share * with;
            }
        }
        if variance.is_nan() || variance <= DEPENDENT {
            return None;
        }
        let scale = variance.sqrt();
        with_inputs.iter_mut().for_each(|with| *with /= scale);
        // no quantity has more in common with others than its whole variance
        let most = (1.0 - told).max(0.0).sqrt();
        let coefficient = (untold / scale).clamp(-most, most);
        Some(Direction { with_inputs, coefficient })
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
