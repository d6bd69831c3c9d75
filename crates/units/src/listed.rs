//! Lists of names and numbers in a sentence.

/// "a", "a and b", "a, b and c": separated by commas, with `last_word` and its spaces before the
/// last item.
///
/// ```
/// use gumption_units::listed;
///
/// assert_eq!(listed(&["tilt", "rotation", "a_ref"], " or "), "tilt, rotation or a_ref");
/// assert_eq!(listed(&["tilt", "rotation"], " and "), "tilt and rotation");
/// assert_eq!(listed(&["tilt"], " and "), "tilt");
/// ```
pub fn listed<S: AsRef<str>>(parts: &[S], last_word: &str) -> String {
    let parts: Vec<&str> = parts.iter().map(AsRef::as_ref).collect();
    match parts.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{}{last_word}{last}", rest.join(", ")),
        _ => parts.concat(),
    }
}
