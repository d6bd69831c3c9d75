//! The name that a user probably meant.

/// The known name nearest to `found`, if one is near: case does not count, nor does `-` for `_`; a
/// third of the letters may differ (a swap of neighbours counts once), but no name of one letter is
/// guessed. A tie goes to the first known name.
///
/// ```
/// use gumption::file::nearest;
///
/// assert_eq!(nearest("voltge", ["current", "voltage"]), Some("voltage"));
/// assert_eq!(nearest("halfwidth", ["half_width", "mean"]), Some("half_width"));
/// assert_eq!(nearest("xyz", ["voltage"]), None);
/// ```
pub fn nearest<'k>(found: &str, known: impl IntoIterator<Item = &'k str>) -> Option<&'k str> {
    let plain = |name: &str| name.to_lowercase().replace('-', "_");
    let wanted = plain(found);
    let limit = (wanted.chars().count() + 1) / 3;
    let mut best: Option<(usize, &str)> = None;
    for name in known {
        let candidate = plain(name);
        let distance = strsim::damerau_levenshtein(&wanted, &candidate);
        let near = distance <= limit && distance < candidate.chars().count();
        if near && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, name));
        }
    }
    best.map(|(_, name)| name)
}
