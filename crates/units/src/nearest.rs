//! Finds names that a user probably meant. The same rule holds for units, names in formulas, keys
//! and file names.

/// Names longer than this, in letters, are not compared.
const LONGEST: usize = 64;

/// Minimum length of a partial name, in letters.
const SHORTEST_PART: usize = 4;

/// The most names given.
const MOST: usize = 3;

/// The known name nearest to `found`, if one is near enough: the first of [`all_nearest`].
///
/// ```
/// use gumption_units::nearest;
///
/// assert_eq!(nearest("voltge", ["current", "voltage"]), Some("voltage"));
/// assert_eq!(nearest("halfwidth", ["half_width", "mean"]), Some("half_width"));
/// assert_eq!(nearest("xyz", ["voltage"]), None);
/// ```
pub fn nearest<'k>(found: &str, known: impl IntoIterator<Item = &'k str>) -> Option<&'k str> {
    all_nearest(found, known).into_iter().next()
}

/// The known names nearest to `found`, if any is near enough: up to three names at the least
/// distance, in the order of `known`.
///
/// The distance counts omitted, inserted, changed and swapped letters (Damerau and Levenshtein). At
/// most a third of the letters of `found` may differ, rounded to the nearest whole number, and at
/// least one letter must agree. If no name is that near, `found` matches a name of which it is a
/// part, or a word of which it is near (words are separated by `-` or `_`); this requires four
/// letters or more. Case is ignored, `-` equals `_`, and the micro sign equals the Greek letter.
/// Names of more than 64 letters are not compared.
///
/// ```
/// use gumption_units::all_nearest;
///
/// assert_eq!(all_nearest("t3", ["t1", "t2", "tilt"]), ["t1", "t2"]);
/// assert_eq!(all_nearest("inclined", ["inclined-plane", "chain"]), ["inclined-plane"]);
/// assert_eq!(all_nearest("inclned", ["inclined-plane", "chain"]), ["inclined-plane"]);
/// ```
pub fn all_nearest<'k>(found: &str, known: impl IntoIterator<Item = &'k str>) -> Vec<&'k str> {
    let plain = |name: &str| name.to_lowercase().replace('-', "_").replace('\u{b5}', "\u{3bc}");
    let wanted = plain(found);
    let length = wanted.chars().count();
    let mut near: Vec<&str> = Vec::new();
    if length > LONGEST {
        return near;
    }
    let allowed = (length + 1) / 3;
    let mut least = allowed;
    let mut around: Vec<&str> = Vec::new();
    for name in known {
        let candidate = plain(name);
        let within = || {
            let near = |word| strsim::damerau_levenshtein(&wanted, word) <= allowed;
            let words = || candidate.split('_').filter(|word| word.len() >= SHORTEST_PART);
            candidate.contains(&wanted) || words().any(near)
        };
        if length >= SHORTEST_PART
            && around.len() < MOST
            && candidate.len() <= 4 * LONGEST
            && within()
        {
            around.push(name);
        }
        let letters = candidate.chars().count();
        if letters.abs_diff(length) > least {
            continue;
        }
        let distance = strsim::damerau_levenshtein(&wanted, &candidate);
        if distance > least || distance >= letters {
            continue;
        }
        if distance < least {
            near.clear();
            least = distance;
        }
        if near.len() < MOST && !near.contains(&name) {
            near.push(name);
        }
    }
    if near.is_empty() { around } else { near }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_names() {
        let known = ["voltage", "a_ref", "t1", "t2", "m", "\u{3bc}", "T0"];
        let names = |found: &str| all_nearest(found, known);
        assert_eq!(names("voltge"), ["voltage"]);
        assert_eq!(names("VOLTAGE"), ["voltage"]);
        assert_eq!(names("aref"), ["a_ref"]);
        assert_eq!(names("a-ref"), ["a_ref"]);
        assert_eq!(names("t0"), ["T0"]);
        assert_eq!(names("t3"), ["t1", "t2", "T0"]);
        assert_eq!(names("M"), ["m"]);
        assert_eq!(names("\u{b5}"), ["\u{3bc}"]);
        assert!(names("x").is_empty());
        assert!(names("current").is_empty());
    }

    #[test]
    fn very_long_names_are_not_compared() {
        let long = "voltage".repeat(100_000);
        assert_eq!(nearest(&long, [long.as_str(), "voltage"]), None);
        assert_eq!(nearest("voltag", [long.as_str(), "voltage"]), Some("voltage"));
    }
}
