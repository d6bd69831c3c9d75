//! Facts: what an evaluation or a reader has found, without the words for it. A report has a sentence for
//! each key, in each of its languages.

use std::fmt;

use crate::number::Shortest;

/// What was found. [`crate::fact!`] makes one.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Fact {
    /// Names the sentence: a code, or a code, a full stop and a variant of it.
    pub key: &'static str,
    /// What stands at the places of the sentence, by their names.
    pub arguments: Vec<(&'static str, Argument)>,
}

/// What stands at a place of a sentence.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Argument {
    /// The same in every language: a name, a formula, a unit.
    Text(String),
    /// A number, with a decimal point, and its unit where it has one.
    Number(String),
    /// A part that has its own words.
    Fact(Box<Fact>),
    /// Parts of an enumeration; nothing where it is empty.
    List(Vec<Argument>),
}

impl Fact {
    /// The short name of what it is about: the key without its variant.
    pub fn code(&self) -> &'static str {
        self.key.split_once('.').map_or(self.key, |(code, _)| code)
    }

    /// What stands at a place of the sentence.
    pub fn argument(&self, name: &str) -> Option<&Argument> {
        let argument = self.arguments.iter().find(|(known, _)| *known == name);
        argument.map(|(_, argument)| argument)
    }
}

impl Argument {
    /// A number with its unit, as it is printed with a decimal point.
    pub fn number(printed: impl fmt::Display) -> Self {
        Self::Number(printed.to_string())
    }

    /// An enumeration with "and" before its last part.
    pub fn all_of(mut parts: Vec<Fact>) -> Self {
        match parts.pop() {
            Some(last) if !parts.is_empty() => crate::fact!("all-of", parts, last).into(),
            last => last.into(),
        }
    }

    /// An enumeration with "or" before its last part.
    pub fn one_of(mut parts: Vec<Fact>) -> Self {
        match parts.pop() {
            Some(last) if !parts.is_empty() => crate::fact!("one-of", parts, last).into(),
            last => last.into(),
        }
    }
}

impl From<&str> for Argument {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Argument {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<&String> for Argument {
    fn from(text: &String) -> Self {
        Self::Text(text.clone())
    }
}

impl From<&gumption_units::Unit> for Argument {
    fn from(unit: &gumption_units::Unit) -> Self {
        Self::Text(unit.to_string())
    }
}

impl From<f64> for Argument {
    fn from(number: f64) -> Self {
        Self::Number(Shortest(number).to_string())
    }
}

impl From<u64> for Argument {
    fn from(count: u64) -> Self {
        Self::Number(count.to_string())
    }
}

impl From<u32> for Argument {
    fn from(count: u32) -> Self {
        Self::Number(count.to_string())
    }
}

impl From<usize> for Argument {
    fn from(count: usize) -> Self {
        Self::Number(count.to_string())
    }
}

impl From<Fact> for Argument {
    fn from(fact: Fact) -> Self {
        Self::Fact(Box::new(fact))
    }
}

impl<A: Into<Argument>> From<Vec<A>> for Argument {
    fn from(parts: Vec<A>) -> Self {
        Self::List(parts.into_iter().map(Into::into).collect())
    }
}

impl<A: Into<Argument>> From<Option<A>> for Argument {
    fn from(part: Option<A>) -> Self {
        part.map_or(Self::List(Vec::new()), Into::into)
    }
}

/// A [`Fact`](crate::fact::Fact): its key, then its arguments by name.
///
/// ```
/// let (trials, needed) = (100_u64, 200_000_u64);
/// let fact = gumption_engine::fact!("few-trials", trials, probability = 0.95, needed);
/// assert_eq!(fact.code(), "few-trials");
/// assert_eq!(fact.arguments.len(), 3);
/// ```
#[macro_export]
macro_rules! fact {
    (@value $name:ident) => { $name };
    (@value $name:ident $value:expr) => { $value };
    ($key:literal $(, $name:ident $(= $value:expr)?)* $(,)?) => {
        $crate::fact::Fact {
            key: $key,
            arguments: vec![$((
                stringify!($name),
                $crate::fact::Argument::from($crate::fact!(@value $name $($value)?)),
            )),*],
        }
    };
}
