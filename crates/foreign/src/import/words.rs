//! The words of budgets in English, German, French and Spanish: one table, `words.csv`.
//!
//! Its second column says what a word stands for: a column (by the name that `--column` has for it), a kind
//! of row (`row:`), or a part of a heading (`heading:`).

use std::collections::HashMap;
use std::sync::LazyLock;

/// What a word stands for, by the word, for each kind of place: headings of columns (`""`), `row`, ...
type WordTable = HashMap<(&'static str, &'static str), &'static str>;

static TABLE: LazyLock<WordTable> = LazyLock::new(|| {
    let known = entries().map(|[_, meaning, word]| {
        let (place, of_place) = meaning.split_once(':').unwrap_or(("", meaning));
        ((place, word), of_place)
    });
    known.collect()
});

/// The words of each meaning.
static LISTS: LazyLock<HashMap<&'static str, Vec<&'static str>>> = LazyLock::new(|| {
    let mut lists: HashMap<&str, Vec<&str>> = HashMap::new();
    for [_, meaning, word] in entries() {
        lists.entry(meaning).or_default().push(word);
    }
    lists
});

/// The words of all columns, with what they stand for.
static COLUMNS: LazyLock<Vec<(&'static str, &'static str)>> = LazyLock::new(|| {
    let columns = entries().filter(|[_, meaning, _]| !meaning.contains(':'));
    columns.map(|[_, meaning, word]| (word, meaning)).collect()
});

/// Language, meaning and word of each line of the table.
fn entries() -> impl Iterator<Item = [&'static str; 3]> {
    include_str!("words.csv").lines().skip(1).filter_map(|line| {
        let mut cells = line.splitn(3, ',');
        Some([cells.next()?, cells.next()?, cells.next()?.trim_matches('"')])
    })
}

/// What a word stands for in a place. A word is looked for in its own letters first, then in small ones:
/// `U` is not `u`, and `Estimate` is `estimate`.
pub(super) fn meaning(place: &'static str, word: &str) -> Option<&'static str> {
    let small = word.to_lowercase();
    [word, &small].into_iter().find_map(|word| TABLE.get(&(place, word)).copied())
}

/// The words of a meaning, `heading:share`.
pub(super) fn of(meaning: &str) -> impl Iterator<Item = &'static str> {
    LISTS.get(meaning).into_iter().flatten().copied()
}

/// The words of all columns, with what they stand for.
pub(super) fn of_columns() -> impl Iterator<Item = (&'static str, &'static str)> {
    COLUMNS.iter().copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn no_word_stands_for_two_columns() {
        let mut known: HashMap<(&str, &str), &str> = HashMap::new();
        for [language, meaning, word] in entries() {
            assert!(["any", "en", "de", "fr", "es"].contains(&language), "{language},{word}");
            assert!(!word.is_empty() && word.trim() == word, "{meaning}: `{word}`");
            // a word of a heading may be of several lists
            let place = match meaning.split_once(':') {
                Some(("row", _)) => "row",
                Some(_) => meaning,
                None => "",
            };
            if let Some(other) = known.insert((place, word), meaning) {
                panic!("`{word}` stands for {other} and for {meaning}");
            }
        }
        // the table is there
        assert!(known.len() > 900, "{}", known.len());
    }

    /// Each meaning is one that the program knows, so that no line of the table is idle.
    #[test]
    fn every_meaning_is_known() {
        let meanings: HashSet<&str> = entries().map(|[_, meaning, _]| meaning).collect();
        for meaning in meanings {
            let is_column = crate::import::columns::Column::named(meaning).is_some();
            let is_row = matches!(
                meaning,
                "row:result"
                    | "row:combined"
                    | "row:expanded"
                    | "row:subtotal"
                    | "row:k"
                    | "row:dof"
            );
            let is_other = ["heading:", "title:", "text:"].iter().any(|of| meaning.starts_with(of));
            assert!(is_column || is_row || is_other, "{meaning}");
        }
    }
}
