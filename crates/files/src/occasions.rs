//! What tells an input from that of the same name in another evaluation of the same model file: the
//! content of the files that it is read from, or the values that replace its own, and where its figures follow the conditions, what stands
//! in place of the file's values. And what tells that inputs of two model files are the same: their place
//! in one certificate.
//!
//! A saved result keeps it, so that two evaluations of one file with other data are not taken for two
//! results of the same inputs.

use std::collections::HashMap;
use std::sync::Arc;

use super::input_set::InputSet;
use super::overrides::Override;
use gumption_engine::distribution::Occasion;
use gumption_text::bytes::sha256;

/// Tells all variables; `files` are the files that were read, by name, and `are_swept` is whether there
/// are conditions.
pub(super) fn tell(
    inputs: &mut InputSet,
    files: &[(String, Vec<u8>)],
    overrides: &[Override],
    are_swept: bool,
) {
    for (variable, data) in data(&inputs.read_from, files) {
        if let Some(variable) = inputs.variables.get_mut(variable) {
            variable.occasion.data = Some(data);
        }
    }
    for change in overrides {
        for variable in &mut inputs.variables {
            let is_readings = inputs.readings.inputs.contains(&variable.name);
            if change.is_list_of(&variable.name, is_readings) {
                variable.occasion.data = Some(sha256(change.value.as_bytes()).into());
            }
        }
    }
    for (name, place) in &inputs.from_certificates {
        let is_replaced = overrides.iter().any(|change| change.input == quantity(name));
        let variable = inputs.variables.iter_mut().find(|variable| variable.name == *name);
        if let Some(variable) = variable.filter(|_| !is_replaced) {
            variable.occasion.certified = Some(place.as_str().into());
        }
    }
    if !are_swept {
        return;
    }
    let constants: Vec<String> = inputs
        .variables
        .iter()
        .enumerate()
        .filter(|(place, _)| !inputs.known.varies(*place))
        .map(|(_, variable)| variable.name.clone())
        .collect();
    let known = &inputs.known;
    for (place, variable) in inputs.variables.iter_mut().enumerate() {
        if known.is_of_rows(place) {
            let follows = Some(replaced(&variable.name, &constants, overrides).into());
            variable.occasion = Occasion { follows, ..variable.occasion.clone() };
        }
    }
}

/// The digest of what each variable was read from; each file's is taken once.
fn data(read_from: &[(usize, String)], files: &[(String, Vec<u8>)]) -> Vec<(usize, Arc<str>)> {
    let mut digests: HashMap<&str, String> = HashMap::new();
    let mut found: Vec<(usize, Vec<String>)> = Vec::new();
    for (variable, name) in read_from {
        let Some((_, bytes)) = files.iter().find(|(known, _)| known == name) else { continue };
        let digest = digests.entry(name).or_insert_with(|| sha256(bytes)).clone();
        match found.iter_mut().find(|(known, _)| known == variable) {
            Some((_, list)) => list.push(digest),
            None => found.push((*variable, vec![digest])),
        }
    }
    let of_several = |list: Vec<String>| match list.as_slice() {
        [one] => Arc::from(one.as_str()),
        several => Arc::from(sha256(several.concat().as_bytes())),
    };
    found.into_iter().map(|(variable, list)| (variable, of_several(list))).collect()
}

/// The quantity that a variable belongs to.
fn quantity(name: &str) -> &str {
    name.split(['/', '.']).next().unwrap_or(name)
}

/// What stands in place of the file's values of this variable and of the constants, which formulas of
/// its figures may name.
fn replaced(variable: &str, constants: &[String], overrides: &[Override]) -> String {
    let own = quantity(variable);
    let counts = |change: &&Override| change.input == own || constants.contains(&change.input);
    let mut texts: Vec<String> = overrides
        .iter()
        .filter(counts)
        .map(|change| match &change.field {
            Some(field) => format!("{}.{field}={}", change.input, change.value),
            None => format!("{}={}", change.input, change.value),
        })
        .collect();
    texts.sort();
    texts.join("; ")
}
