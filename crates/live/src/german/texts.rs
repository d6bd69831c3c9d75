//! The tables that translate, `texts.json`: English as the reports and the notes print it, then German.
//!
//! - `words`, `shapes`: words of tables and figures that stand alone; names of distributions.
//! - `between`: what stands between names in enumerations.
//! - `sentences`: sentences, captions and cells; the first one that matches is used. English has `{}`
//!   for variable parts, and German their positions: `{0}` unchanged, `{0:}` translated, `{0+}` with
//!   German words between names. A full stop at the end belongs to neither.
//! - `brief`: parts of sentences and cells, which might be found in many sentences: they are looked for
//!   last, and in short texts alone.

use std::sync::LazyLock;

use serde::{Deserialize, Deserializer};

/// The longest text in which the brief ones are looked for, in characters.
pub(super) const BRIEF_LENGTH: usize = 60;

/// A text in English and in German.
type Pair = (String, String);

/// The tables, read when the first text is translated.
pub(super) static TEXTS: LazyLock<Texts> = LazyLock::new(Texts::of_program);

/// The tables of one language.
#[derive(Debug, Deserialize)]
pub(super) struct Texts {
    #[serde(deserialize_with = "of_sections")]
    pub words: Vec<Pair>,
    #[serde(deserialize_with = "of_sections")]
    pub shapes: Vec<Pair>,
    #[serde(deserialize_with = "of_sections")]
    pub between: Vec<Pair>,
    #[serde(deserialize_with = "of_sections")]
    pub sentences: Vec<Sentence>,
    #[serde(deserialize_with = "of_sections")]
    pub brief: Vec<Sentence>,
}

/// A sentence in both languages.
#[derive(Debug, Deserialize)]
#[serde(from = "Pair")]
pub(super) struct Sentence {
    /// What stands between the places of the English one: one piece more than it has places.
    pub pieces: Vec<String>,
    /// The length of all pieces in bytes: no shorter text has them.
    pub least: usize,
    pub german: String,
}

/// Texts of one subject; the file names it.
#[derive(Deserialize)]
struct TextSection<T> {
    texts: Vec<T>,
}

impl Texts {
    #[expect(
        clippy::expect_used,
        reason = "the file is part of the program, and the tests read it"
    )]
    fn of_program() -> Self {
        serde_json::from_str(include_str!("texts.json")).expect("the tables are of this form")
    }
}

/// A table, whose sections are there for those who read the file.
fn of_sections<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    from: D,
) -> Result<Vec<T>, D::Error> {
    let sections = Vec::<TextSection<T>>::deserialize(from)?;
    Ok(sections.into_iter().flat_map(|section| section.texts).collect())
}

impl From<Pair> for Sentence {
    fn from((english, german): Pair) -> Self {
        let pieces: Vec<String> = english.split("{}").map(str::to_owned).collect();
        Self { least: pieces.iter().map(String::len).sum(), pieces, german }
    }
}
