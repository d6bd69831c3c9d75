//! Notes on inputs that a saved result beside them goes back to, as far as nothing says how they depend
//! on each other.

use std::collections::HashMap;
use std::sync::Arc;

use gumption_engine::distribution::{Root, RootFigures, RootName};
use gumption_engine::fact;
use gumption_engine::task::{Task, Warning};

/// Digits to which the figures of one quantity agree, whichever file they were read from.
const SAME: f64 = 1e-12;

/// Tells of inputs with the name and the figures of one that a saved result was evaluated from: the two
/// are drawn independently, as nothing else says that they are one quantity.
pub(super) fn notes(task: &Task) -> Vec<Warning> {
    let Some(row) = task.rows.first() else { return Vec::new() };
    if row.distributions.iter().all(|distribution| distribution.saved().is_none()) {
        return Vec::new();
    }
    let names = task.variables.iter().map(|variable| variable.name.as_str());
    let places: HashMap<&str, usize> = names.zip(0..).collect();
    let is_same = |root: &Root, place: usize| {
        let (Some(variable), Some(own)) = (task.variables.get(place), row.distributions.get(place))
        else {
            return false;
        };
        let figures = [own.mean(), own.standard_uncertainty()];
        let near = |(a, b): (f64, f64)| (a - b).abs() <= SAME * b.abs();
        root.unit == variable.unit.text()
            && root.distribution == own.name()
            && own.standard_uncertainty() > 0.0
            && figures.into_iter().zip([root.estimate, root.standard_uncertainty]).all(near)
    };
    // a value of a certificate goes by any name
    let certified: HashMap<RootName, usize> = task
        .variables
        .iter()
        .zip(row.distributions.iter())
        .enumerate()
        .filter(|(_, (_, own))| own.standard_uncertainty() > 0.0)
        .map(|(place, (variable, own))| {
            let figures = RootFigures::of(own);
            let named = (Arc::from(""), variable.name.as_str().into());
            (RootName::new(named, &variable.occasion, &figures), place)
        })
        .filter(|(name, _)| name.certified.is_some())
        .collect();
    let are_correlated = |a: usize, b: usize| {
        let pair = |of: [usize; 2]| of == [a, b] || of == [b, a];
        task.correlations.iter().any(|correlation| pair([correlation.first, correlation.second]))
    };
    let mut found = Vec::new();
    let results = task.variables.iter().zip(row.distributions.iter()).enumerate();
    for (result, (variable, saved)) in results {
        let roots = saved.saved().map(|saved| saved.origin().roots.as_slice()).unwrap_or_default();
        for (root, _) in roots {
            let certified = certified.get(&root.name).copied();
            if let Some(place) = certified.filter(|place| !are_correlated(*place, result)) {
                let name = task.variables.get(place).map_or("", |variable| variable.name.as_str());
                let fact = fact!("counted-twice.certificate", name, result = &variable.name);
                found.push(Warning::new(name, fact));
                continue;
            }
            let place = places.get(&*root.name.name).copied();
            // a result without sensitivity coefficients is its own root
            let place = place.filter(|place| *place != result && is_same(root, *place));
            if place.is_some_and(|place| !are_correlated(place, result)) {
                let name = &*root.name.name;
                let fact = fact!("counted-twice", name, result = &variable.name);
                found.push(Warning::new(name, fact));
            }
        }
    }
    found
}
