//! The name that a user probably meant.

/// The longest name that is compared, in letters.
const LONGEST: usize = 64;

/// The known name nearest to `found`, if one is near: case does not count, nor does `-` for `_`; a
/// third of the letters may differ (a swap of neighbours counts once), but no name of one letter is
/// guessed. A tie goes to the first known name. Names of more than 64 letters are not compared.
///
/// ```
/// use gumption_files::nearest;
///
/// assert_eq!(nearest("voltge", ["current", "voltage"]), Some("voltage"));
/// assert_eq!(nearest("halfwidth", ["half_width", "mean"]), Some("half_width"));
/// assert_eq!(nearest("xyz", ["voltage"]), None);
/// ```
pub fn nearest<'k>(found: &str, known: impl IntoIterator<Item = &'k str>) -> Option<&'k str> {
    let plain = |name: &str| name.to_lowercase().replace('-', "_");
    let wanted = plain(found);
    let length = wanted.chars().count();
    if length > LONGEST {
        return None;
    }
    let limit = (length + 1) / 3;
    let mut best: Option<(usize, &str)> = None;
    for name in known {
        let candidate = plain(name);
        if candidate.chars().count().abs_diff(length) > limit {
            continue;
        }
        let distance = strsim::damerau_levenshtein(&wanted, &candidate);
        let near = distance <= limit && distance < candidate.chars().count();
        if near && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, name));
        }
    }
    best.map(|(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn very_long_names_are_not_compared() {
        let long = "voltage".repeat(100_000);
        assert_eq!(nearest(&long, [long.as_str(), "voltage"]), None);
        assert_eq!(nearest("voltag", [long.as_str(), "voltage"]), Some("voltage"));
    }
}
