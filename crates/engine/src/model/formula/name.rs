//! Which texts may be the name of a quantity.

use std::error::Error;
use std::fmt;

use super::function::Function;
use super::syntax::{Joint, NEGATION};

/// Whether a name may begin with this character.
pub(super) fn begins_name(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}

/// Whether a name may go on with this character.
pub(super) fn continues_name(c: char) -> bool {
    begins_name(c) || c.is_ascii_digit()
}

/// Whether a text is the constant pi.
pub(super) fn is_pi(text: &str) -> bool {
    matches!(text, "pi" | "π")
}

/// Whether a text is a word that stands between truths, or before one.
fn is_operator(text: &str) -> bool {
    text == NEGATION || Joint::ALL.into_iter().any(|joint| joint.name() == text)
}

/// Whether a text has the form of a name: letters of any alphabet, digits and `_`, with no digit in
/// front. Reserved words have that form too; [`check_name`] tells them apart.
pub fn is_name(text: &str) -> bool {
    text.starts_with(begins_name) && text.chars().all(continues_name)
}

/// A name with letters in place of those of other alphabets, and of signs of units, that nobody can
/// tell from them.
pub fn looks_of(name: &str) -> String {
    const ALIKE: [(&str, &str); 3] = [
        // signs of units
        ("\u{b5}\u{2126}\u{212a}\u{212b}", "\u{3bc}\u{3a9}K\u{c5}"),
        // Cyrillic
        ("аеорсухіјѕАВЕКМНОРСТХІЈЅ", "aeopcyxijsABEKMHOPCTXIJS"),
        // Greek
        ("οΑΒΕΖΗΙΚΜΝΟΡΤΥΧ", "oABEZHIKMNOPTYX"),
    ];
    if name.is_ascii() {
        return name.to_owned();
    }
    let plain = |letter: char| {
        let pairs = ALIKE.iter().flat_map(|(from, to)| from.chars().zip(to.chars()));
        pairs.into_iter().find(|(from, _)| *from == letter).map_or(letter, |(_, to)| to)
    };
    name.chars().map(plain).collect()
}

/// Checks that a quantity may be called so.
///
/// ```
/// use gumption_engine::model::formula::check_name;
///
/// assert!(check_name("θ_1").is_ok());
/// assert!(check_name("sqrt").is_err());
/// assert!(check_name("2nd").is_err());
/// ```
///
/// # Errors
/// [`NameError`] if the text does not have the form of a name, or is a function's name (but `gamma`,
/// `mean`, `re`, `im`, `arg` and `conj`, which name a quantity where no parenthesis follows), an
/// operator's (`and`, `or`, `not`), `pi` or `π`.
pub fn check_name(text: &str) -> Result<(), NameError> {
    match text.chars().next() {
        None => return Err(NameError::Empty),
        Some(c) if !begins_name(c) => return Err(NameError::Start { found: c }),
        Some(_) => {}
    }
    if let Some(found) = text.chars().find(|c| !continues_name(*c)) {
        return Err(NameError::Character { found });
    }
    if Function::named(text).is_some_and(Function::is_reserved) {
        return Err(NameError::Function);
    }
    if is_operator(text) {
        return Err(NameError::Operator);
    }
    if is_pi(text) { Err(NameError::Pi) } else { Ok(()) }
}

/// Why a text cannot be the name of a quantity. `Display` gives the reason, to be put after the
/// name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NameError {
    /// No text at all.
    Empty,
    /// A first character that no name begins with.
    Start {
        /// The character.
        found: char,
    },
    /// A character that no name has.
    Character {
        /// The character.
        found: char,
    },
    /// The name of a function.
    Function,
    /// `and`, `or` or `not`.
    Operator,
    /// The constant pi.
    Pi,
}

impl Error for NameError {}

impl fmt::Display for NameError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("a name has at least one letter"),
            Self::Start { found } => {
                write!(f, "a name begins with a letter or `_`, not with `{}`", ShownChar(*found))
            }
            Self::Character { found } => {
                write!(f, "a name has letters, digits and `_` only, not `{}`", ShownChar(*found))
            }
            Self::Function => f.write_str("it is the name of a function"),
            Self::Operator => f.write_str("it is an operator of formulas"),
            Self::Pi => f.write_str("it is the constant pi"),
        }
    }
}

/// A character in a message: quotes as they are, control characters escaped.
pub(super) struct ShownChar(pub(super) char);

impl fmt::Display for ShownChar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            '\'' | '"' | '\\' => write!(f, "{}", self.0),
            c => write!(f, "{}", c.escape_debug()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_what_is_none() {
        for good in
            ["a", "_", "a_ref", "θ", "Δt_1", "é", "sin1", "Pi", "e", "µ", "gamma", "mean", "re"]
        {
            assert_eq!(check_name(good), Ok(()), "{good}");
            assert!(is_name(good));
        }
        let bad = [
            ("", NameError::Empty),
            ("1a", NameError::Start { found: '1' }),
            ("-a", NameError::Start { found: '-' }),
            ("a-b", NameError::Character { found: '-' }),
            ("a b", NameError::Character { found: ' ' }),
            ("x²", NameError::Character { found: '²' }),
            ("sin", NameError::Function),
            ("kelvin", NameError::Function),
            ("celsius", NameError::Function),
            ("floor", NameError::Function),
            ("mod", NameError::Function),
            ("expm1", NameError::Function),
            ("erf", NameError::Function),
            ("if", NameError::Function),
            ("sum", NameError::Function),
            ("table", NameError::Function),
            ("solve", NameError::Function),
            ("and", NameError::Operator),
            ("or", NameError::Operator),
            ("not", NameError::Operator),
            ("pi", NameError::Pi),
            ("π", NameError::Pi),
        ];
        for (text, error) in bad {
            assert_eq!(check_name(text), Err(error), "{text}");
        }
        assert!(is_name("sin"), "reserved, but of the form of a name");
    }
}
