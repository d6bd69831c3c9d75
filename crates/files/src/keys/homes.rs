//! Where else in a file a key stands that was written at the wrong place.

use super::{
    CERTIFICATE, CERTIFICATE_FUNCTION, CERTIFICATE_ROW, CHANNEL, CMC_LINE, COMPONENT, CONDITION,
    DEVICE, EFFECT, FIT, FREQUENCY, INPUT, Key, MODEL, MONTE_CARLO, OBSERVATIONS, OBSERVED, OUTPUT,
    PARTY, QUANTITY, RECIPE, RECIPE_ROW, RECORDING, SEARCH, SHAPES, TOLERANCE,
};

/// An object of a file, as messages call it, and its keys.
type Home = (&'static str, &'static [Key]);

/// The objects of a model file beside its inputs, whose keys depend on their distributions.
const OF_MODELS: &[Home] = &[
    ("a model file", MODEL),
    ("`monte_carlo`", MONTE_CARLO),
    ("an output", OUTPUT),
    ("`tolerance`", TOLERANCE),
    ("`cmc_line`", CMC_LINE),
    ("a condition", CONDITION),
    ("a fit", FIT),
    ("an effect", EFFECT),
    ("`observations`", OBSERVATIONS),
    ("an observed output", OBSERVED),
];

/// The objects of each kind of file, the outer ones first.
const FILES: [&[Home]; 3] = [
    OF_MODELS,
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

/// What an input is called, and what it may be made of.
const OF_INPUTS: [&str; 2] = ["an input", "a component"];

/// The objects of the file around an object which have a key of this name, in words; none where the
/// object is not one of those above.
pub(super) fn homes(key: &str, object: &str) -> Vec<&'static str> {
    let is_of_input = OF_INPUTS.contains(&object);
    let holds = |file: &[Home]| file.iter().any(|(what, _)| *what == object);
    let file =
        if is_of_input { Some(OF_MODELS) } else { FILES.into_iter().find(|file| holds(file)) };
    let has_key = |home: &&Home| home.0 != object && home.1.iter().any(|known| known.name == key);
    let homes = file.unwrap_or_default().iter().filter(has_key).map(|(what, _)| *what);
    let input = (holds(OF_MODELS) && is_key_of_inputs(key)).then_some("an input");
    homes.chain(input).collect()
}

fn is_key_of_inputs(key: &str) -> bool {
    let mut shapes = SHAPES.iter().flat_map(|shape| shape.fields);
    INPUT.contains(&key) || COMPONENT.contains(&key) || shapes.any(|field| *field == key)
}
