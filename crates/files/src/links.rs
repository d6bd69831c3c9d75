//! The dependence of inputs that come from saved results.

use std::collections::HashMap;

use super::input_set::InputSet;
use gumption_engine::distribution::{Correlation, Root, SavedResult};
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};
use gumption_engine::task::Warning;

/// How many pairs a note names.
const NAMED: usize = 6;

/// The coefficients between inputs that are outputs of one result file, or that go back to common
/// inputs, and notes on what is kept and what cannot be.
pub(super) fn links(inputs: &InputSet) -> (Vec<Correlation>, Vec<Warning>) {
    let (mut found, mut warnings) = (Vec::new(), Vec::new());
    let saved = |q: usize| Some((q, inputs.known.get(q, 0)?.saved()?));
    let saved: Vec<(usize, &SavedResult)> = (0..inputs.variables.len()).filter_map(saved).collect();
    let name = |q: usize| inputs.variables.get(q).map_or("", |variable| variable.name.as_str());
    let mut kept = Vec::new();
    let mut old = Vec::new();
    let mut apart = Vec::new();
    for (place, &(second, b)) in saved.iter().enumerate() {
        for &(first, a) in saved.iter().take(place) {
            let (of_a, of_b) = (a.origin(), b.origin());
            let names = [name(first), name(second)];
            let one_file = of_a.file == of_b.file && of_a.output != of_b.output;
            if one_file && (of_a.ranks.is_none() || of_b.ranks.is_none()) {
                old.push(fact!("pair", first = names[0], second = names[1]));
            }
            let coefficient = a.drawn_coefficient(b);
            if let Some(coefficient) = coefficient.filter(|_| a.is_linked(b)) {
                found.push(Correlation { first, second, coefficient });
                if coefficient != 0.0 {
                    let coefficient = Argument::Number(format!("{coefficient:.3}"));
                    let [first, second] = names;
                    kept.push(fact!("pair.correlated", first, second, coefficient));
                }
            } else if may_depend(a, b) {
                let [first, second] = names;
                let fact = fact!("result-dependence-unknown", first, second);
                warnings.push(Warning::new(second, fact));
            }
            if of_a.file != of_b.file {
                let [first, second] = names;
                apart.extend(
                    namesakes(a, b).into_iter().map(|(input, reason)| {
                        fact!("pair.with-input", input, first, second, reason)
                    }),
                );
            }
        }
    }
    if !kept.is_empty() {
        warnings.push(Warning::new("", fact!("result-correlation", pairs = some(kept))));
    }
    if !apart.is_empty() {
        warnings.push(Warning::new("", fact!("result-inputs-differ", pairs = some(apart))));
    }
    if !old.is_empty() {
        warnings.push(Warning::new("", fact!("result-without-ranks", pairs = some(old))));
    }
    (found, warnings)
}

/// The inputs of the same name in the same model file that both results go back to and that are not the
/// same quantity, and why not.
fn namesakes(a: &SavedResult, b: &SavedResult) -> Vec<(String, Fact)> {
    let (of_a, of_b) = (&a.origin().roots, &b.origin().roots);
    let mut places: HashMap<(&str, &str), Vec<&Root>> = HashMap::new();
    for (root, _) in of_b {
        places.entry((&*root.name.model, &*root.name.name)).or_default().push(root);
    }
    let mut found = Vec::new();
    for (root, _) in of_a {
        let others = places.get(&(&*root.name.model, &*root.name.name));
        let others = others.map_or(&[][..], Vec::as_slice);
        // of several the one that it shares is what it has in common
        if let Some(other) = others.first()
            && others.iter().all(|other| other.name != root.name)
        {
            found.push((root.name.name.to_string(), reason(root, other)));
        }
    }
    found
}

/// Why two inputs of one name are not the same quantity.
fn reason(a: &Root, b: &Root) -> Fact {
    let (of_a, of_b) = (&a.occasion, &b.occasion);
    let stated = |root: &Root| [&root.occasion.data, &root.occasion.row].map(Option::is_some);
    if stated(a) != stated(b) || of_a.follows.is_some() != of_b.follows.is_some() {
        fact!("other-input.unknown-row")
    } else if of_a.row != of_b.row {
        fact!("other-input.row")
    } else if of_a.follows != of_b.follows {
        fact!("other-input.values-set")
    } else if a.figures() != b.figures() {
        fact!("other-input.figures")
    } else if of_a.certified.is_some() != of_b.certified.is_some() {
        fact!("other-input.unknown-place")
    } else {
        fact!("other-input.content")
    }
}

/// The first of some pairs, and how many more there are.
pub(super) fn some(mut pairs: Vec<Fact>) -> Fact {
    let count = pairs.len().saturating_sub(NAMED);
    pairs.truncate(NAMED);
    fact!("pairs", pairs, more = (count > 0).then(|| fact!("pairs.more", count)))
}

/// Whether two results that are not linked come from the same model file, or one from a result of
/// the other's, with the way between them unknown.
fn may_depend(a: &SavedResult, b: &SavedResult) -> bool {
    let (a, b) = (a.origin(), b.origin());
    if a.linear && b.linear {
        return false;
    }
    let models = |origin: &gumption_engine::distribution::Origin| {
        let roots = origin.roots.iter().map(|(root, _)| root.name.model.clone());
        roots.chain([origin.model.clone(), origin.file.clone()]).collect::<Vec<_>>()
    };
    let of_b = models(b);
    models(a).iter().any(|model| of_b.contains(model))
}

/// The pairs of variables whose dependence comes from saved results.
pub(super) fn pairs(inputs: &InputSet) -> Vec<(usize, usize)> {
    let saved = |q: usize| Some((q, inputs.known.get(q, 0)?.saved()?));
    let saved: Vec<(usize, &SavedResult)> = (0..inputs.variables.len()).filter_map(saved).collect();
    let before = |place: usize| saved.iter().take(place);
    let all = saved.iter().enumerate().flat_map(|(place, b)| before(place).map(move |a| (a, b)));
    all.filter(|((_, a), (_, b))| a.is_linked(b)).map(|((a, _), (b, _))| (*a, *b)).collect()
}

/// Whether the dependence of two variables comes from saved results.
pub(super) fn is_linked(inputs: &InputSet, first: usize, second: usize) -> bool {
    let saved = |q: usize| inputs.known.get(q, 0).and_then(|d| d.saved());
    saved(first).zip(saved(second)).is_some_and(|(a, b)| a.is_linked(b))
}
