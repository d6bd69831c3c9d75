//! Where else in a file a key stands that was written at the wrong place.

use super::{
    CERTIFICATE, CERTIFICATE_FUNCTION, CERTIFICATE_ROW, CHANNEL, COMPONENT, CONDITION, DEVICE,
    EFFECT, FIT, FREQUENCY, INPUT, Key, MODEL, MONTE_CARLO, OBSERVATIONS, OBSERVED, OUTPUT, PARTY,
    QUANTITY, RECIPE, RECIPE_ROW, RECORDING, SEARCH, SHAPES, TOLERANCE,
};

/// An object of a file, as messages call it, and its keys.
type Home = (&'static str, &'static [Key]);

/// The objects of each kind of file, the outer ones first.
const FILES: [&[Home]; 3] = [
    &[
        ("a model file", MODEL),
        ("`monte_carlo`", MONTE_CARLO),
        ("an output", OUTPUT),
        ("`tolerance`", TOLERANCE),
        ("a condition", CONDITION),
        ("a fit", FIT),
        ("an effect", EFFECT),
        ("`observations`", OBSERVATIONS),
        ("an observed output", OBSERVED),
    ],
    &[
        ("a certificate file", CERTIFICATE),
        ("a row", CERTIFICATE_ROW),
        ("a function", CERTIFICATE_FUNCTION),
        ("`device`", DEVICE),
        ("`laboratory`", PARTY),
        ("`customer`", PARTY),
    ],
    &[
        ("a recipe", RECIPE),
        ("a recording", RECORDING),
        ("a channel", CHANNEL),
        ("a search", SEARCH),
        ("a row of a recipe", RECIPE_ROW),
        ("`frequency`", FREQUENCY),
        ("a quantity", QUANTITY),
    ],
];

/// The objects that an input is made of, whose keys depend on their distributions.
const OF_INPUTS: [&str; 2] = ["an input", "a component"];

/// The objects of the file around an object which have a key of this name, in words; none where the
/// object is not one of those above.
pub(crate) fn homes(key: &str, object: &str) -> Vec<&'static str> {
    let is_of = |file: &&&[Home]| file.iter().any(|(what, _)| *what == object);
    let of_input = OF_INPUTS.contains(&object);
    let models = FILES.first().filter(|_| of_input);
    let Some(file) = models.or_else(|| FILES.iter().find(is_of)) else { return Vec::new() };
    let others = file
        .iter()
        .filter(|(what, keys)| *what != object && keys.iter().any(|known| known.name == key));
    let mut homes: Vec<&'static str> = others.map(|(what, _)| *what).collect();
    let is_model = FILES.first().is_some_and(|models| std::ptr::eq(*models, *file));
    let is_of_inputs = || {
        let mut shapes = SHAPES.iter().flat_map(|shape| shape.fields);
        INPUT.contains(&key) || COMPONENT.contains(&key) || shapes.any(|field| *field == key)
    };
    if is_model && !of_input && is_of_inputs() {
        homes.push("an input");
    }
    homes
}
