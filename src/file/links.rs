//! The dependence of inputs that come from saved results.

use super::inputs::Inputs;
use crate::distribution::{Correlation, SavedResult};
use crate::task::Warning;

/// How many pairs a note names.
const NAMED: usize = 6;

/// The coefficients between inputs that are outputs of one result file, or that go back to common
/// inputs, and notes on what is kept and what cannot be.
pub(super) fn links(inputs: &Inputs) -> (Vec<Correlation>, Vec<Warning>) {
    let (mut found, mut warnings) = (Vec::new(), Vec::new());
    let saved = |q: usize| Some((q, inputs.known.get(q, 0)?.saved()?));
    let saved: Vec<(usize, &SavedResult)> = (0..inputs.variables.len()).filter_map(saved).collect();
    let name = |q: usize| inputs.variables.get(q).map_or("", |variable| variable.name.as_str());
    let mut kept = Vec::new();
    for (place, &(second, b)) in saved.iter().enumerate() {
        for &(first, a) in saved.iter().take(place) {
            let coefficient = a.drawn_coefficient(b);
            if let Some(coefficient) = coefficient.filter(|_| a.is_linked(b)) {
                found.push(Correlation { first, second, coefficient });
                if coefficient != 0.0 {
                    kept.push(format!(
                        "`{}` and `{}` ({coefficient:.3})",
                        name(first),
                        name(second)
                    ));
                }
            } else if may_depend(a, b) {
                let text = format!(
                    "`{}` and `{}` may depend on each other, because their results go back to the \
                     same model file, but one of them has no finite sensitivity coefficients, so \
                     the dependence cannot be told; they are taken as independent",
                    name(first),
                    name(second)
                );
                warnings.push(Warning::new("result-dependence-unknown", name(second), text));
            }
        }
    }
    if !kept.is_empty() {
        let more = kept.len().saturating_sub(NAMED);
        let rest = if more > 0 { format!(" and {more} more pairs") } else { String::new() };
        let named = kept.iter().take(NAMED).cloned().collect::<Vec<_>>().join(", ");
        let text = format!("the correlation of saved results is kept: {named}{rest}");
        warnings.push(Warning::new("result-correlation", "", text));
    }
    (found, warnings)
}

/// Whether two results that are not linked come from the same model file, or one from a result of
/// the other's, with the way between them unknown.
fn may_depend(a: &SavedResult, b: &SavedResult) -> bool {
    let (a, b) = (a.origin(), b.origin());
    if a.linear && b.linear {
        return false;
    }
    let models = |origin: &crate::distribution::Origin| {
        let roots = origin.roots.iter().map(|(root, _)| root.name.model.clone());
        roots.chain([origin.model.clone(), origin.file.clone()]).collect::<Vec<_>>()
    };
    let of_b = models(b);
    models(a).iter().any(|model| of_b.contains(model))
}

/// Whether the dependence of two variables comes from saved results.
pub(super) fn is_linked(inputs: &Inputs, first: usize, second: usize) -> bool {
    let saved = |q: usize| inputs.known.get(q, 0).and_then(|d| d.saved());
    saved(first).zip(saved(second)).is_some_and(|(a, b)| a.is_linked(b))
}
