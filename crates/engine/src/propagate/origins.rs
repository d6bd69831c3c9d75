//! The inputs that outputs go back to, through saved results as well: what a result needs to know
//! for its dependence on others to be kept.

use std::collections::{BTreeMap, HashSet};
use std::sync::Arc;

use super::OutputEvaluation;
use super::gum::Gum;
use crate::distribution::{
    Distribution, Occasion, Root, RootCorrelation, RootFigures, RootName, SavedResult,
};
use crate::task::{Row, Task, Variable};

/// The roots of the outputs of a row.
#[derive(Clone, Debug, Default)]
pub struct Origins {
    /// The inputs, in order of appearance: those of the model file, and in place of a saved result
    /// its own. Behind them those that no output goes back to, but which are correlated with one that
    /// a saved result goes back to.
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
    let spread = output.monte_carlo.as_deref().and_then(|figures| figures.standard_uncertainty);
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
    let own = own(task, row, &model);
    for (own, distribution) in own.into_iter().zip(row.distributions.iter()) {
        if let Some(saved) = distribution.saved() {
            let weights = saved.origin().roots.iter();
            let weights =
                weights.map(|(root, weight)| (index(root.clone(), &mut origins.roots), *weight));
            parts.push(weights.collect());
        } else {
            let root = own.map(|root| (index(root, &mut origins.roots), 1.0));
            parts.push(root.into_iter().collect());
        }
    }
    for partner in partners(row, &origins.roots) {
        index(partner, &mut origins.roots);
    }
    let find = |name: &RootName| indices.get(name).copied();
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
        let told = |(a, b): (&SavedResult, &SavedResult)| {
            a.linear_coefficient(b).is_some() || a.is_told_by_roots(b)
        };
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

/// What is known of the variables of a row; `None` of constants and of saved results. A value of a
/// certificate that the row has twice, or that one of its saved results goes back to, counts as
/// independent there and is told from that.
fn own(task: &Task, row: &Row, model: &Arc<str>) -> Vec<Option<Root>> {
    let saved = row.distributions.iter().filter_map(|d| d.saved()).map(SavedResult::origin);
    let of_results = saved.flat_map(|origin| origin.known.iter().map(|root| &root.name));
    let mut taken: HashSet<RootName> =
        of_results.filter(|name| name.certified.is_some()).cloned().collect();
    let all = task.variables.iter().zip(row.distributions.iter());
    all.map(|(variable, distribution)| {
        if distribution.constant().is_some() || distribution.saved().is_some() {
            return None;
        }
        let occasion = variable.occasion.clone();
        let found = root(task, row, variable, distribution, model, occasion);
        if found.name.certified.is_none() || taken.insert(found.name.clone()) {
            return Some(found);
        }
        let occasion = Occasion { certified: None, ..variable.occasion.clone() };
        Some(root(task, row, variable, distribution, model, occasion))
    })
    .collect()
}

/// What is known of an input that is no saved result.
fn root(
    task: &Task,
    row: &Row,
    variable: &Variable,
    distribution: &Distribution,
    model: &Arc<str>,
    occasion: Occasion,
) -> Root {
    let figures = RootFigures::of(distribution);
    let own_row = variable.sharing.conditions_of(&task.model.conditions, &row.conditions);
    let occasion = Occasion { row: own_row.map(Arc::from), ..occasion };
    let named = (model.clone(), variable.name.as_str().into());
    Root {
        name: RootName::new(named, &occasion, &figures),
        unit: variable.unit.text().to_owned(),
        distribution: distribution.name().to_owned(),
        estimate: figures.estimate,
        standard_uncertainty: figures.standard_uncertainty,
        standard_deviation: distribution.standard_deviation(),
        dof: figures.dof,
        occasion,
    }
}

/// The names of a row's inputs that vary and are no saved results; `model` as for [`origins`].
pub fn own_roots(task: &Task, row: &Row, model: &str) -> Vec<RootName> {
    let model: Arc<str> = model.into();
    own(task, row, &model).into_iter().flatten().map(|root| root.name).collect()
}

/// The inputs behind the files of saved results that are correlated with these roots and not among
/// them: only where they are named as well is the coefficient known to whoever meets both.
fn partners(row: &Row, roots: &[Root]) -> Vec<Root> {
    let known: HashSet<&RootName> = roots.iter().map(|root| &root.name).collect();
    let mut found: Vec<Root> = Vec::new();
    let mut files: HashSet<&str> = HashSet::new();
    let mut listed: HashSet<RootName> = HashSet::new();
    for origin in row.distributions.iter().filter_map(|d| d.saved()).map(SavedResult::origin) {
        let is_new = files.insert(&origin.file);
        for pair in origin.correlations.iter().filter(|_| is_new) {
            let wanted = match [&pair.first, &pair.second].map(|name| known.contains(name)) {
                [true, false] => &pair.second,
                [false, true] => &pair.first,
                _ => continue,
            };
            let root = origin.known.iter().find(|root| root.name == *wanted);
            found.extend(root.filter(|root| listed.insert(root.name.clone())).cloned());
        }
    }
    found
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
