//! Words for errors, deviations and corrections in column headings and in names of results.

/// Words for an error: indicated value minus reference value.
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

/// Words for a deviation from a nominal value.
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

/// Parts of the English words for differences, as in the reference types of certificates
/// (`basic_measurementError` and similar).
pub const PARTS_OF_TYPES: [&str; 6] =
    ["error", "correction", "deviation", "difference", "drift", "hysteresis"];

/// Parts of the words for differences in the other languages of the certificates that are read.
const OTHER_PARTS: [&str; 6] =
    ["abweichung", "korrektion", "korrektur", "differenz", "erreur", "écart"];

/// Whether a name contains a word for a difference.
pub fn is_of_difference(name: &str) -> bool {
    let small = name.to_lowercase();
    PARTS_OF_TYPES.iter().chain(&OTHER_PARTS).any(|word| small.contains(word))
}
