//! Reads the members of an object and reports every error at its position.

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
    /// Where errors are reported.
    pub log: &'a Collector,
    /// What it is, for messages.
    what: &'static str,
    members: &'a [Member],
    /// Where a missing key is reported: at the key of the object.
    place: &'a Range<usize>,
}

impl<'a> Object<'a> {
    /// The object at `node`; `place` is the span of its key.
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

    /// The members, in the order of the text.
    pub fn members(&self) -> &'a [Member] {
        self.members
    }

    /// The span of the object's key, as a half-open range of bytes.
    pub fn place(&self) -> &'a Range<usize> {
        self.place
    }

    /// Reports an error in the object at its key.
    pub fn report(&self, diagnostic: DiagnosticKind) {
        self.log.report(self.place, diagnostic);
    }

    /// The first member with this key.
    pub fn get(&self, key: &str) -> Option<&'a Member> {
        self.members.iter().find(|member| member.key == key)
    }

    /// The member; its absence is reported. If a misspelt key is reported in the object, that
    /// report replaces this one in the end.
    pub fn required(&self, key: &'static str) -> Option<&'a Member> {
        let member = self.get(key);
        if member.is_none() {
            self.report(DiagnosticKind::MissingKey { key, what: self.what });
        }
        member
    }

    /// The member; its absence is reported. For objects that may have unknown keys, so that no key
    /// counts as misspelt.
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

    /// A number, if the key is present.
    pub fn number(&self, key: &str) -> Option<f64> {
        let member = self.get(key)?;
        let number = member.value.number();
        if number.is_none() {
            self.wrong_type(member, "a number");
        }
        number
    }

    /// A value in `unit`, if the key is present: a number in that unit, also as text, or a text
    /// with a number and a unit.
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

    /// A value that is an element of a list, read as by [`value`](Self::value).
    pub fn value_at(&self, key: &str, node: &Node, unit: &Unit, of: ValueOf) -> Option<f64> {
        match self.value_of(key, node, unit, of) {
            Some(value) => value,
            None => self.element(key, node),
        }
    }

    /// A list of values, read as by [`value`](Self::value).
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

    /// The value of a text: the outer `None` if the text is not a value, the inner one after an
    /// error.
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

    /// A text, if the key is present.
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

    /// A truth value, if the key is present.
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

    /// A list, if the key is present.
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

    /// A list of numbers, if the key is present; every other element is reported.
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

    /// A whole number from `least` to `most`, if the key is present; 1e6 is one.
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
                DiagnosticKind::NotWhole { key: key.into(), found: text.to_string(), least, most },
            );
        }
        whole
    }
}

/// Parses a whole number, written plainly or as 1e6.
pub fn whole_number(text: &str) -> Option<u64> {
    text.parse().ok().or_else(|| {
        let value: f64 = text.parse().ok()?;
        (value.fract() == 0.0 && (0.0..9e15).contains(&value)).then_some(value as u64)
    })
}
