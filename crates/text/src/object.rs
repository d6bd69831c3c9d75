//! Reading the members of an object, with every mistake reported where it stands.

use std::collections::HashSet;
use std::ops::Range;

use super::DiagnosticKind;
use super::diagnostics::Collector;
use super::json::{Json, Member, Node};
use super::value_text::{ValueOf, bare_number, converted, is_value, with_unit};
use gumption_units::Unit;

/// An object that is being read.
#[derive(Clone, Copy, Debug)]
pub struct Object<'a> {
    /// Where mistakes are reported.
    pub log: &'a Collector,
    /// What it is, for messages.
    what: &'static str,
    members: &'a [Member],
    /// Where a missing key is reported: the key that the object belongs to.
    place: &'a Range<usize>,
}

impl<'a> Object<'a> {
    /// The object at `node`; `place` is the key that it belongs to.
    pub fn new(
        log: &'a Collector,
        what: &'static str,
        node: &'a Node,
        place: &'a Range<usize>,
    ) -> Option<Self> {
        let Json::Object(members) = &node.value else {
            log.report(
                &node.span,
                DiagnosticKind::WrongType {
                    what: what.into(),
                    found: node.value.kind(),
                    expected: "an object",
                },
            );
            return None;
        };
        let mut seen = HashSet::new();
        for member in members {
            if !seen.insert(member.key.as_str()) {
                log.report(
                    &member.key_span,
                    DiagnosticKind::DuplicateKey { key: member.key.clone() },
                );
            }
        }
        Some(Self { log, what, members, place })
    }

    /// What it is, for messages.
    pub fn what(&self) -> &'static str {
        self.what
    }

    /// Its members, in the order of the text.
    pub fn members(&self) -> &'a [Member] {
        self.members
    }

    /// The key that it belongs to, as a half-open range of bytes.
    pub fn place(&self) -> &'a Range<usize> {
        self.place
    }

    /// A mistake in the object, reported at its key.
    pub fn report(&self, diagnostic: DiagnosticKind) {
        self.log.report(self.place, diagnostic);
    }

    /// The first member of this key.
    pub fn get(&self, key: &str) -> Option<&'a Member> {
        self.members.iter().find(|member| member.key == key)
    }

    /// The member, or its absence reported; if a misspelt key is reported where it stands, that is
    /// left out in the end.
    pub fn required(&self, key: &'static str) -> Option<&'a Member> {
        let member = self.get(key);
        if member.is_none() {
            self.report(DiagnosticKind::MissingKey { key, what: self.what });
        }
        member
    }

    /// The member, or its absence reported, in an object that may have keys beside the known ones, so
    /// that none of them is a misspelt one.
    pub fn needed(&self, key: &'static str) -> Option<&'a Member> {
        let member = self.get(key);
        if member.is_none() {
            self.report(DiagnosticKind::MissingKey { key, what: self.what });
        }
        member
    }

    fn wrong_type(&self, member: &Member, expected: &'static str) {
        self.log.report(
            &member.value.span,
            DiagnosticKind::WrongType {
                what: format!("`{}`", member.key),
                found: member.value.value.kind(),
                expected,
            },
        );
    }

    /// A number, if the key is there.
    pub fn number(&self, key: &str) -> Option<f64> {
        let member = self.get(key)?;
        let number = member.value.number();
        if number.is_none() {
            self.wrong_type(member, "a number");
        }
        number
    }

    /// A value in a unit, if the key is there: a number in that unit, which may be a text, or a text with
    /// a number and a unit of its own.
    pub fn value(&self, key: &str, unit: &Unit, of: ValueOf) -> Option<f64> {
        let member = self.get(key)?;
        match self.value_of(key, &member.value, unit, of) {
            Some(value) => value,
            None => {
                let number = member.value.number();
                if number.is_none() {
                    self.wrong_type(member, "a number, or one with its unit, such as \"1.2 mm\"");
                }
                number
            }
        }
    }

    /// A value that is an element of a list, as [`value`](Self::value).
    pub fn value_at(&self, key: &str, node: &Node, unit: &Unit, of: ValueOf) -> Option<f64> {
        match self.value_of(key, node, unit, of) {
            Some(value) => value,
            None => self.element(key, node),
        }
    }

    /// A list of values, as [`value`](Self::value).
    pub fn values(&self, key: &str, unit: &Unit, of: ValueOf) -> Option<Vec<f64>> {
        let list = self.list(key)?;
        let is_text = |node: &Node| matches!(&node.value, Json::Text(text) if is_value(text));
        if !list.iter().any(is_text) {
            return self.numbers(key);
        }
        let mut values = Vec::new();
        for node in list {
            let value = match self.value_of(key, node, unit, of) {
                Some(value) => value,
                None => self.element(key, node),
            };
            values.extend(value);
        }
        (values.len() == list.len()).then_some(values)
    }

    /// The value of a text that is one; outside `None` if it is none, inside after a mistake.
    #[allow(clippy::option_option)]
    pub fn value_of(
        &self,
        key: &str,
        node: &Node,
        unit: &Unit,
        of: ValueOf,
    ) -> Option<Option<f64>> {
        let Json::Text(text) = &node.value else { return None };
        if let Some(value) = bare_number(text) {
            return Some(Some(value));
        }
        let read = converted(with_unit(text)?, unit, of, &self.log.own_units());
        let read = read.map_err(|reason| DiagnosticKind::Value {
            key: key.to_owned(),
            found: text.clone(),
            reason,
        });
        Some(self.log.value(&node.span, read))
    }

    /// A text, if the key is there.
    pub fn text(&self, key: &str) -> Option<&'a str> {
        let member = self.get(key)?;
        match &member.value.value {
            Json::Text(text) => Some(text),
            _ => {
                self.wrong_type(member, "a text");
                None
            }
        }
    }

    /// True or false, if the key is there.
    pub fn truth(&self, key: &str) -> Option<bool> {
        let member = self.get(key)?;
        match member.value.value {
            Json::Bool(truth) => Some(truth),
            _ => {
                self.wrong_type(member, "true or false");
                None
            }
        }
    }

    /// A list, if the key is there.
    pub fn list(&self, key: &str) -> Option<&'a [Node]> {
        let member = self.get(key)?;
        match &member.value.value {
            Json::List(list) => Some(list),
            _ => {
                self.wrong_type(member, "a list");
                None
            }
        }
    }

    /// A list of numbers, if the key is there; every element that is none is reported.
    pub fn numbers(&self, key: &str) -> Option<Vec<f64>> {
        let list = self.list(key)?;
        let numbers: Vec<f64> = list.iter().filter_map(|node| self.element(key, node)).collect();
        (numbers.len() == list.len()).then_some(numbers)
    }

    /// A number that is an element of a list.
    fn element(&self, key: &str, node: &Node) -> Option<f64> {
        let number = node.number();
        if number.is_none() {
            let (what, found) = (format!("an element of `{key}`"), node.value.kind());
            let expected = "a number";
            self.log.report(&node.span, DiagnosticKind::WrongType { what, found, expected });
        }
        number
    }

    /// A whole number from `least` to `most`, if the key is there; 1e6 counts as one.
    pub fn whole(&self, key: &'static str, least: u64, most: u64) -> Option<u64> {
        let member = self.get(key)?;
        let Json::Number(text) = &member.value.value else {
            self.wrong_type(member, "a number");
            return None;
        };
        let whole = whole_number(text).filter(|n| (least..=most).contains(n));
        if whole.is_none() {
            self.log.report(
                &member.value.span,
                DiagnosticKind::NotWhole { key: key.into(), found: text.clone(), least, most },
            );
        }
        whole
    }
}

/// The whole number that a text is, written plainly or as 1e6.
pub fn whole_number(text: &str) -> Option<u64> {
    text.parse().ok().or_else(|| {
        let value: f64 = text.parse().ok()?;
        (value.fract() == 0.0 && (0.0..9e15).contains(&value)).then_some(value as u64)
    })
}
