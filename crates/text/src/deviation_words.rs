//! Words of errors, deviations and corrections at the head of columns and in names of results.

/// Words of errors, which are added to what is right and taken from what is indicated.
pub const ERRORS: [&str; 13] = [
    "error",
    "error of indication",
    "measurement error",
    "measured error",
    "bias",
    "fehler",
    "messfehler",
    "messabweichung",
    "anzeigeabweichung",
    "erreur",
    "erreur de mesure",
    "erreur d'indication",
    "justesse",
];

/// Words of what is added to a nominal value.
pub const DEVIATIONS: [&str; 10] = [
    "deviation",
    "deviation from nominal",
    "deviation from nominal value",
    "abweichung",
    "abweichung vom nennwert",
    "écart",
    "ecart",
    "écart au nominal",
    "écart à la valeur nominale",
    "desviación",
];

/// Parts of the English words of differences, of which the reference types of certificates consist
/// (`basic_measurementError` and its kind).
pub const PARTS_OF_TYPES: [&str; 6] =
    ["error", "correction", "deviation", "difference", "drift", "hysteresis"];

/// Parts of the words of differences in other languages of the certificates that are read.
const OTHER_PARTS: [&str; 6] =
    ["abweichung", "korrektion", "korrektur", "differenz", "erreur", "écart"];

/// Whether a name has a word of differences in it.
pub fn is_of_difference(name: &str) -> bool {
    let small = name.to_lowercase();
    PARTS_OF_TYPES.iter().chain(&OTHER_PARTS).any(|word| small.contains(word))
}
