//! The inputs that outputs go back to, through saved results as well: what a result needs to know
//! for its dependence on others to be kept.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::OutputEvaluation;
use super::gum::Gum;
use crate::distribution::{Root, RootCorrelation, RootName, SavedResult};
use crate::task::{Row, Task};

/// The roots of the outputs of a row.
#[derive(Clone, Debug, Default)]
pub struct Origins {
    /// The inputs, in order of appearance: those of the model file, and in place of a saved result
    /// its own.
    pub roots: Vec<Root>,
    /// For each output its sensitivity coefficients to the roots, in output unit per input unit;
    /// `None` where they are not finite.
    pub sensitivities: Vec<Option<Vec<f64>>>,
    /// Correlation coefficients between roots.
    pub correlations: Vec<RootCorrelation>,
}

/// The GUM evaluation of an output whose sensitivity coefficients say how it varies: finite, and not
/// all zero where the trials scatter.
pub fn linear(output: &OutputEvaluation) -> Option<&Gum> {
    let spread = output.monte_carlo.as_ref().and_then(|figures| figures.standard_uncertainty);
    output.gum.as_ref().filter(|gum| gum.standard_uncertainty > 0.0 || spread == Some(0.0))
}

/// Follows the outputs' sensitivities to the inputs that vary. `model` is the SHA-256 of the model
/// file, in hexadecimal.
pub fn origins(task: &Task, row: &Row, outputs: &[Option<&Gum>], model: &str) -> Origins {
    let model: Arc<str> = model.into();
    let mut origins = Origins::default();
    let mut indices: BTreeMap<RootName, usize> = BTreeMap::new();
    // for each variable, its roots with their weights in its standard uncertainty
    let mut parts: Vec<Vec<(usize, f64)>> = Vec::new();
    let mut coefficients: BTreeMap<(usize, usize), f64> = BTreeMap::new();
    let mut index = |root: Root, roots: &mut Vec<Root>| -> usize {
        *indices.entry(root.name.clone()).or_insert_with(|| {
            roots.push(root);
            roots.len() - 1
        })
    };
    for (variable, distribution) in task.variables.iter().zip(row.distributions.iter()) {
        if distribution.constant().is_some() {
            parts.push(Vec::new());
        } else if let Some(saved) = distribution.saved() {
            let weights = saved.origin().roots.iter();
            let weights =
                weights.map(|(root, weight)| (index(root.clone(), &mut origins.roots), *weight));
            parts.push(weights.collect());
        } else {
            let root = Root {
                name: RootName { model: model.clone(), name: variable.name.as_str().into() },
                unit: variable.unit.text().to_owned(),
                distribution: distribution.name().to_owned(),
                estimate: distribution.mean(),
                standard_uncertainty: distribution.standard_uncertainty(),
                standard_deviation: distribution.standard_deviation(),
                dof: distribution.dof(),
            };
            parts.push(vec![(index(root, &mut origins.roots), 1.0)]);
        }
    }
    let find = |name: &RootName| origins.roots.iter().position(|root| root.name == *name);
    for saved in row.distributions.iter().filter_map(|d| d.saved()) {
        for c in saved.origin().correlations.iter() {
            if let (Some(a), Some(b)) = (find(&c.first), find(&c.second)) {
                coefficients.insert((a.min(b), a.max(b)), c.coefficient);
            }
        }
    }
    for c in outputs.iter().flatten().next().into_iter().flat_map(|gum| gum.correlations()) {
        let [first, second] = c.variables;
        let saved = |q: usize| row.distributions.get(q).and_then(|d| d.saved());
        let told = |(a, b): (&SavedResult, &SavedResult)| a.linear_coefficient(b).is_some();
        if saved(first).zip(saved(second)).is_some_and(told) {
            continue;
        }
        // the least change of the roots' coefficients that gives the variables theirs
        let (Some(a), Some(b)) = (parts.get(first), parts.get(second)) else {
            continue;
        };
        let square = |part: &[(usize, f64)]| part.iter().map(|(_, w)| w * w).sum::<f64>();
        let norm = square(a) * square(b);
        for (i, w) in a {
            for (j, v) in b {
                let r = c.coefficient * w * v / norm;
                if i != j && r != 0.0 && r.is_finite() {
                    *coefficients.entry((*i.min(j), *i.max(j))).or_insert(0.0) += r;
                }
            }
        }
    }
    let named = |index: usize| origins.roots[index].name.clone();
    origins.correlations = coefficients
        .iter()
        .map(|(&(a, b), &coefficient)| {
            let coefficient = f64::clamp(coefficient, -1.0, 1.0);
            RootCorrelation { first: named(a), second: named(b), coefficient }
        })
        .collect();
    origins.sensitivities = outputs
        .iter()
        .map(|gum| gum.map(|gum| sensitivities(gum, &parts, &origins.roots)))
        .collect();
    origins
}

fn sensitivities(gum: &Gum, parts: &[Vec<(usize, f64)>], roots: &[Root]) -> Vec<f64> {
    let mut found = vec![0.0; roots.len()];
    for line in gum.budget() {
        for &(root, weight) in parts.get(line.variable).map_or(&[][..], Vec::as_slice) {
            let own = parts[line.variable].len() == 1 && weight == 1.0;
            let u = roots[root].standard_uncertainty;
            // of an input itself the coefficient as it is, without a rounding
            let ratio = if own && line.standard_uncertainty == u {
                1.0
            } else {
                weight * (line.standard_uncertainty / u)
            };
            found[root] += line.sensitivity * ratio;
        }
    }
    found
}
