//! The words of facts: a sentence for each key, one file for each language. A sentence has the names of
//! its arguments in braces.

mod english;
mod german;
#[cfg(test)]
mod tests;

use std::collections::HashMap;
use std::sync::LazyLock;

use gumption_engine::fact::{Argument, Fact};
use gumption_engine::task::Warning;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::answer::{list, object};
use crate::plain;
use crate::printed::{Notation, in_print, number_in_sentence};

/// A language in which the facts of all rooms have words.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub enum Language {
    /// English.
    #[default]
    #[serde(rename = "en")]
    English,
    /// German.
    #[serde(rename = "de")]
    German,
}

impl Language {
    /// How a page in this language writes numbers and units.
    pub(crate) fn notation(self) -> Notation {
        match self {
            Self::English => Notation::Print,
            Self::German => Notation::PrintWithComma,
        }
    }
}

/// Keys with their sentences, of one room.
type Sentences = &'static [(&'static str, &'static str)];

/// The sentences of a language by their keys.
type Table = HashMap<&'static str, &'static str>;

static ENGLISH: LazyLock<Table> = LazyLock::new(|| table(&english::ROOMS));
static GERMAN: LazyLock<Table> = LazyLock::new(|| table(&german::ROOMS));

fn table(rooms: &[Sentences]) -> Table {
    rooms.iter().flat_map(|sentences| sentences.iter().copied()).collect()
}

/// What a fact says in a language. No sentence ends with a full stop.
///
/// ```
/// use gumption_engine::fact;
/// use gumption_report::words::{Language, sentence};
///
/// let fact = fact!("undefined-trials", count = 3_u64, trials = 1000_u64);
/// let said = sentence(&fact, Language::English);
/// assert_eq!(said, "3 of 1000 trials have no finite result and were left out");
/// ```
pub fn sentence(fact: &Fact, language: Language) -> String {
    let words = match language {
        Language::English => &ENGLISH,
        Language::German => &GERMAN,
    };
    // a key without a sentence, of a library's user, is told as it is
    let mut rest = words.get(fact.key).copied().unwrap_or(fact.key);
    let mut said = String::with_capacity(2 * rest.len());
    while let Some((before, (name, after))) =
        rest.split_once('{').and_then(|(before, rest)| Some((before, rest.split_once('}')?)))
    {
        said += before;
        if let Some(argument) = fact.argument(name) {
            said += &of_argument(argument, language);
        }
        rest = after;
    }
    said + rest
}

/// What a warning says in a language: where it is, and the fact.
pub fn note(warning: &Warning, language: Language) -> String {
    let within = warning.within.as_ref().map(|part| sentence(part, language));
    within.unwrap_or_default() + &sentence(&warning.fact, language)
}

/// As [`note`], with numbers as a page in the language has them.
pub fn note_on_page(warning: &Warning, language: Language) -> String {
    in_print(language.notation(), || note(warning, language))
}

/// What warnings say in English, a line each.
pub(crate) fn lines(warnings: &[Warning]) -> Vec<String> {
    warnings.iter().map(|warning| plain(&note(warning, Language::English))).collect()
}

/// A warning as answers for programs have it.
#[derive(Debug, Serialize)]
pub struct Note<'w> {
    /// A short fixed name.
    pub code: &'static str,
    /// The input, output or row that it is about.
    pub r#where: &'w str,
    /// The sentence, in English.
    pub text: String,
}

/// Warnings as answers for programs have them.
pub fn notes<'w>(warnings: &'w [Warning]) -> Vec<Note<'w>> {
    let as_note = |warning: &'w Warning| Note {
        code: warning.code(),
        r#where: &warning.place,
        text: note(warning, Language::English),
    };
    warnings.iter().map(as_note).collect()
}

/// The same as JSON.
pub(crate) fn listed(warnings: &[Warning]) -> Value {
    list(notes(warnings).into_iter().map(|note| {
        object([("code", note.code), ("where", note.r#where), ("text", note.text.as_str())])
    }))
}

fn of_argument(argument: &Argument, language: Language) -> String {
    match argument {
        Argument::Text(text) => text.clone(),
        Argument::Number(text) => number_in_sentence(text),
        Argument::Fact(fact) => sentence(fact, language),
        Argument::List(parts) => {
            let said: Vec<String> = parts.iter().map(|part| of_argument(part, language)).collect();
            said.join(", ")
        }
    }
}
