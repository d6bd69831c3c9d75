//! Reading a unit from text.
//!
//! ```text
//! unit     = [ product ]                               nothing at all is the number 1
//! product  = power { operator power }                  from left to right
//! operator = "*" | "." | "·" | "⋅" | "×"               times
//!          | "/"                                       divided by
//!          | space                                     times, before anything but a number
//!          | nothing                                   times, after a number: 10mm
//! power    = factor [ ( "^" | "**" ) exponent | superscripts ]
//! factor   = number | name | "(" product ")" | "√" factor | "sqrt" "(" product ")"
//! exponent = whole | decimal | [ sign ] "(" rational ")"
//! rational = whole [ "/" digits ] | decimal
//! whole    = [ sign ] digits                           sign is + or - or the minus sign
//! decimal  = whole "." digits
//! number   = digits [ "." digits ] [ ( "e" | "E" ) [ sign ] digits ]
//! name     = a letter, "_" or "°", then letters, digits, "_" and "°"
//!          | "%" or "‰", then letters | apostrophes, primes, quotation marks
//! ```
//!
//! Products and quotients have the same rank and are read from left to right, as in formulas:
//! `J/kg*K` is `(J/kg)*K`, `a/b/c` is `a/(b*c)`. A product written with a space or a dot after a
//! quotient, `J/kg K`, means `J/(kg K)` to most writers. It is an error, and the message names both
//! readings (ISO 80000-1:2022 allows it with parentheses only). A symbol with a space in it, `° C`,
//! is an error too. A number in parentheses after a unit without an operator, `V (23)`, is an
//! error: it may be an uncertainty. Spaces are allowed around every operator.

use std::ops::Range;

use super::dimension::Dimension;
use super::error::{MAX_EXPONENT, MissingSide, UnitError};
use super::exponent::Exponent;
use super::factor::{Factor, FactorBase};
use super::names::{Flavour, Meaning, meaning, read};
use super::power::superscript;
use super::scale::Scale;
use super::{Unit, suggest};

/// The longest accepted text, in bytes.
pub(super) const MAX_LENGTH: usize = 256;

/// The deepest nesting of parentheses and roots.
pub(super) const MAX_DEPTH: usize = 16;

/// The largest exponent of a number such as the 10 in `10^-6`, in absolute value.
const MAX_NUMBER_EXPONENT: u32 = 300;

const FACTOR: &str = "a unit, a positive number or `(`";
const OPERATOR: &str = "`*`, `/`, `^` or the end of the unit";
const SECOND_EXPONENT: &str =
    "`*`, `/` or the end of the unit, because a unit takes one exponent only";

/// Symbols that become another unit if they contain a space: the part before it, the part after it,
/// and the symbol. `° C` would be degree times coulomb, `% RH` a per cent of a ronnahenry.
const SPLIT: &[(&[&str], &[&str], &str)] = &[
    (&["°", "deg", "˚"], &["C"], "degC"),
    (&["°", "deg", "˚"], &["F"], "degF"),
    (&["°", "deg", "˚"], &["K"], "K"),
    (&["%"], &["RH"], "%RH"),
    (&["dB"], &["m"], "dBm"),
];

/// The exponent of a divisor.
const MINUS_ONE: Exponent = Exponent::integer(-1);

/// The number 1.
pub(super) const ONE: Meaning =
    Meaning { dimension: Dimension::NONE, scale: Scale::ONE, flavour: Flavour::Plain };

/// Reads a whole text without units that a file defines: its meaning and its factors.
pub(super) fn parse(text: &str) -> Result<(Meaning, Vec<Factor>), UnitError> {
    parse_among(text, &[])
}

/// Reads a whole text that may contain the units `own` of a file: its meaning and its factors.
pub(super) fn parse_among(text: &str, own: &[Unit]) -> Result<(Meaning, Vec<Factor>), UnitError> {
    if text.len() > MAX_LENGTH {
        return Err(UnitError::TooLong { length: text.len(), limit: MAX_LENGTH });
    }
    let mut parser = Parser { own, ..Parser::new(text, 0) };
    parser.skip_space();
    let start = parser.at;
    if parser.peek().is_none() {
        return Ok((ONE, Vec::new()));
    }
    // `dB(A)` would be a product
    let is_own = || own.iter().any(|unit| unit.text() == text.trim());
    if let Some(error) = suggest::whole(text.trim(), start..text.trim_end().len())
        && !is_own()
    {
        return Err(error);
    }
    let meaning = parser.product(0)?;
    if let Some(found) = parser.peek() {
        return Err(UnitError::UnbalancedParenthesis { found, span: parser.next_span() });
    }
    if !meaning.scale.in_range() {
        return Err(UnitError::FactorOutOfRange { span: start..text.trim_end().len() });
    }
    refuse_conductivity(text.trim(), &parser.factors, start)?;
    Ok((meaning, parser.factors))
}

/// Rejects `W/mK`: most writers mean the conductivity in W/(m K), some a conductance per
/// millikelvin.
fn refuse_conductivity(text: &str, factors: &[Factor], start: usize) -> Result<(), UnitError> {
    let [watt, kelvin] = factors else { return Ok(()) };
    let is = |factor: &Factor, name: &str, exponent: Exponent| match factor.base {
        FactorBase::Named { symbol, .. } => symbol.name() == name && factor.exponent == exponent,
        FactorBase::Number(_) | FactorBase::Defined(_) => false,
    };
    let is_one = is(watt, "W", Exponent::ONE) && is(kelvin, "K", MINUS_ONE);
    let divisor = text.split_once('/').map(|(_, divisor)| divisor.trim());
    if is_one && matches!(divisor, Some("mK" | "(mK)")) {
        return Err(UnitError::AmbiguousProduct {
            found: text.to_owned(),
            span: start..start + text.len(),
            likelier: format!("{}/(m*K)", watt.base),
            other: format!("1e3*{}/K", watt.base),
        });
    }
    Ok(())
}

/// A text, and the position up to which it has been read.
pub(super) struct Parser<'t> {
    pub(super) text: &'t str,
    pub(super) at: usize,
    /// Units that the file defines.
    own: &'t [Unit],
    /// The factors read so far. Those of a group or of a divisor get their exponent when it ends.
    factors: Vec<Factor>,
}

/// The kind of factor that has been read, for the rules that depend on it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum FactorKind {
    Number,
    Name,
    Group,
}

/// A factor with its exponent.
struct Power {
    meaning: Meaning,
    kind: FactorKind,
    start: usize,
    has_exponent: bool,
}

impl<'t> Parser<'t> {
    /// Reads a text from an index on.
    pub(super) fn new(text: &'t str, at: usize) -> Self {
        Self { text, at, own: &[], factors: Vec::new() }
    }

    /// The part that has not been read yet.
    pub(super) fn rest(&self) -> &'t str {
        self.slice(self.at..self.text.len())
    }

    /// A part of the text, between characters.
    pub(super) fn slice(&self, span: Range<usize>) -> &'t str {
        &self.text[span]
    }

    /// The next character.
    pub(super) fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    /// The span of the next character.
    pub(super) fn next_span(&self) -> Range<usize> {
        self.at..self.at + self.peek().map_or(0, char::len_utf8)
    }

    /// Reads a fixed text if it is next.
    pub(super) fn take(&mut self, text: &str) -> bool {
        let found = self.rest().starts_with(text);
        if found {
            self.at += text.len();
        }
        found
    }

    /// Reads the characters that satisfy a condition.
    pub(super) fn take_while(&mut self, condition: impl Fn(char) -> bool) -> &'t str {
        let rest = self.rest();
        let end = rest.find(|c| !condition(c)).unwrap_or(rest.len());
        self.at += end;
        &rest[..end]
    }

    /// Skips white space; whether there was any.
    pub(super) fn skip_space(&mut self) -> bool {
        !self.take_while(char::is_whitespace).is_empty()
    }

    /// The next character is wrong.
    fn unexpected(&self, expected: &'static str, suggestion: Option<String>) -> UnitError {
        let found = self.peek().unwrap_or(' ');
        UnitError::UnexpectedCharacter { found, span: self.next_span(), expected, suggestion }
    }

    /// Reads factors up to the end or a closing parenthesis. The next character is not a space.
    fn product(&mut self, depth: usize) -> Result<Meaning, UnitError> {
        if let [b'.', b'0'..=b'9', ..] = self.rest().as_bytes() {
            let mut ahead = Parser::new(self.text, self.at + 1);
            let suggestion = format!("0.{}", ahead.take_while(|c| c.is_ascii_digit()));
            let suggestion = Some(suggestion).filter(|text| parse(text).is_ok());
            return Err(self.unexpected(FACTOR, suggestion));
        }
        if self.peek().is_some_and(is_operator) {
            let span = self.next_span();
            let operator = self.slice(span.clone()).to_owned();
            return Err(UnitError::MissingFactor { operator, span, side: MissingSide::Before });
        }
        let mut last = self.power(depth)?;
        let start = last.start;
        let mut product = last.meaning;
        let mut quotient = None;
        loop {
            let end = self.at;
            let spaced = self.skip_space();
            let (divide, typeset) = match self.peek() {
                None | Some(')') => return Ok(product),
                Some('*') if self.rest().starts_with("**") => {
                    return Err(self.unexpected(SECOND_EXPONENT, None));
                }
                Some(operator) if is_operator(operator) => {
                    let at = self.at;
                    self.operator()?;
                    if operator == '/' {
                        quotient = Some(at);
                    }
                    (operator == '/', !matches!(operator, '*' | '/'))
                }
                Some(next)
                    if starts_factor(next)
                        && !next.is_ascii_digit()
                        && (spaced || last.kind == FactorKind::Number && !last.has_exponent) =>
                {
                    self.refuse_split(&last, end)?;
                    // half a millimetre, 1/2 mm, has only one reading, and `g/100 g` has not
                    let is_number = |solidus: usize| {
                        !self
                            .slice(start..solidus)
                            .contains(|c: char| c.is_alphabetic() || c == '%')
                    };
                    (false, last.kind != FactorKind::Number || !quotient.is_none_or(is_number))
                }
                Some(_) => return Err(self.no_operator(&last, end)),
            };
            let from = self.factors.len();
            let is_joined = !self.slice(end..self.at).contains(is_operator);
            last = self.power(depth)?;
            if is_joined && last.kind == FactorKind::Group {
                self.refuse_number(last.start, from)?;
            }
            if let Some(solidus) = quotient.filter(|_| typeset) {
                return Err(self.ambiguous_product(start, solidus, end));
            }
            let fits = !divide || self.raise(from, MINUS_ONE);
            product = self.combine(product, last.meaning, divide, start, fits)?;
        }
    }

    /// Reads an operator and checks that a factor follows.
    fn operator(&mut self) -> Result<(), UnitError> {
        let span = self.next_span();
        self.at = span.end;
        self.skip_space();
        match self.peek() {
            Some(next) if !is_operator(next) && !matches!(next, ')' | '^') => Ok(()),
            _ => {
                let operator = self.slice(span.clone()).to_owned();
                Err(UnitError::MissingFactor { operator, span, side: MissingSide::After })
            }
        }
    }

    /// Rejects a group without an operator before it that begins with a number, contains a number
    /// among numbers and fractions only, or is a single fraction: `V (23)`, `ohm (0.1 %)`, `V (%)`.
    /// Its factors begin at `from`.
    fn refuse_number(&self, start: usize, from: usize) -> Result<(), UnitError> {
        let group = self.slice(start..self.at);
        let inside = group.trim_start_matches(|c: char| c == '(' || c.is_whitespace());
        let is_number = |factor: &Factor| matches!(factor.base, FactorBase::Number(_));
        let is_share = |factor: &Factor| match factor.base {
            FactorBase::Named { symbol, .. } => symbol.flavour == Flavour::Relative,
            FactorBase::Number(_) | FactorBase::Defined(_) => false,
        };
        let mut factors = self.factors.iter().skip(from);
        let is_one = factors.clone().all(|factor| factor.exponent.to_f64() == 1.0);
        // `V (1/s)` is a product
        let reciprocal =
            inside.strip_prefix('1').is_some_and(|of| of.trim_start().starts_with('/'));
        let begins = inside.starts_with(|c: char| c.is_ascii_digit()) && !reciprocal;
        let alone = factors.clone().all(|factor| is_number(factor) || is_share(factor));
        if begins || alone && (is_one && factors.len() == 1 || factors.any(is_number)) {
            let (found, span) = (group.to_owned(), start..self.at);
            return Err(UnitError::NumberInParentheses { found, span });
        }
        Ok(())
    }

    /// The text read since `start` has a factor after the quotient that ends at `end`, with the
    /// solidus at `solidus`: does the factor divide or multiply the quotient?
    fn ambiguous_product(&self, start: usize, solidus: usize, end: usize) -> UnitError {
        let [whole, dividend, divisor] = [start..self.at, start..solidus, solidus + 1..self.at]
            .map(|span| self.slice(span).trim());
        let (quotient, factor) = (self.slice(start..end), self.slice(end..self.at));
        let space = if factor.starts_with(starts_factor) { " " } else { "" };
        UnitError::AmbiguousProduct {
            found: whole.to_owned(),
            span: start..self.at,
            likelier: format!("{dividend}/({divisor})"),
            other: format!("({quotient}){space}{factor}"),
        }
    }

    /// Rejects a space inside a symbol; the factor before the space ends at `end`.
    fn refuse_split(&self, last: &Power, end: usize) -> Result<(), UnitError> {
        let before = self.slice(last.start..end);
        let mut ahead = Parser::new(self.text, self.at);
        let behind = ahead.take_while(|c| starts_name(c) || c.is_ascii_digit());
        let split = SPLIT.iter().find(|(first, second, _)| {
            first.contains(&before) && second.iter().any(|of| of.eq_ignore_ascii_case(behind))
        });
        match split {
            Some((_, of, symbol)) if !last.has_exponent => Err(UnitError::AmbiguousProduct {
                found: self.slice(last.start..ahead.at).to_owned(),
                span: last.start..ahead.at,
                likelier: (*symbol).to_owned(),
                other: format!("{before}*{}", of.first().copied().unwrap_or(behind)),
            }),
            _ => Ok(()),
        }
    }

    /// The error if neither an operator nor a factor follows; `end` is where `last` ends.
    fn no_operator(&self, last: &Power, end: usize) -> UnitError {
        let next = self.peek().unwrap_or(' ');
        if last.has_exponent && (next == '^' || superscript(next).is_some()) {
            return self.unexpected(SECOND_EXPONENT, None);
        }
        // `m-3` and `m 2` are powers without their operator, `10 000` is one number.
        let mut ahead = Parser::new(self.text, self.at);
        let sign = if ahead.sign() { "-" } else { "" };
        let digits = ahead.take_while(|c| c.is_ascii_digit());
        let before = self.slice(last.start..end);
        let suggestion = match last.kind {
            _ if digits.is_empty() || last.has_exponent => None,
            FactorKind::Name => Some(format!("{before}^{sign}{digits}")),
            FactorKind::Number if next.is_ascii_digit() => Some(format!("{before}{digits}")),
            _ => None,
        };
        self.unexpected(OPERATOR, suggestion.filter(|text| parse(text).is_ok()))
    }

    /// Raises the factors from an index on to a power; whether all exponents fit.
    fn raise(&mut self, from: usize, power: Exponent) -> bool {
        let mut raised = self.factors.iter_mut().skip(from);
        raised.all(|factor| match factor.exponent.checked_mul(power) {
            Some(exponent) => {
                factor.exponent = exponent;
                true
            }
            None => false,
        })
    }

    /// The product or quotient of the text read since `start`, if the exponents of its factors fit.
    fn combine(
        &self,
        left: Meaning,
        right: Meaning,
        divide: bool,
        start: usize,
        fits: bool,
    ) -> Result<Meaning, UnitError> {
        let span = start..self.at;
        let (dimension, scale) = if divide {
            (
                left.dimension.checked_div(right.dimension),
                right.scale.inverse().and_then(|inverse| left.scale.times(inverse)),
            )
        } else {
            (left.dimension.checked_mul(right.dimension), left.scale.times(right.scale))
        };
        self.meaning(dimension.filter(|_| fits), scale, Flavour::Plain, span)
    }

    /// A meaning whose parts must both be in range.
    fn meaning(
        &self,
        dimension: Option<Dimension>,
        scale: Option<Scale>,
        flavour: Flavour,
        span: Range<usize>,
    ) -> Result<Meaning, UnitError> {
        let Some(dimension) = dimension else {
            let found = self.slice(span.clone()).to_owned();
            return Err(UnitError::ExponentTooLarge { found, span, limit: MAX_EXPONENT });
        };
        let Some(scale) = scale else {
            return Err(UnitError::FactorOutOfRange { span });
        };
        Ok(Meaning { dimension, scale, flavour })
    }

    /// Reads a factor and its exponent, if it has one.
    fn power(&mut self, depth: usize) -> Result<Power, UnitError> {
        let (start, from) = (self.at, self.factors.len());
        let (base, kind) = self.factor(depth)?;
        let end = self.at;
        let limit = if kind == FactorKind::Number { MAX_NUMBER_EXPONENT } else { MAX_EXPONENT };
        self.skip_space();
        let Some(read) = self.exponent(limit)? else {
            self.at = end;
            return Ok(Power { meaning: base, kind, start, has_exponent: false });
        };
        if read.bare && kind != FactorKind::Number {
            self.refuse_ambiguous(start..end, &read)?;
        }
        let flavour = if read.exponent == Exponent::ONE { base.flavour } else { Flavour::Plain };
        let fits = self.raise(from, read.exponent);
        let meaning = self.meaning(
            base.dimension.checked_pow(read.exponent).filter(|_| fits),
            base.scale.power(read.exponent),
            flavour,
            start..self.at,
        )?;
        Ok(Power { meaning, kind, start, has_exponent: true })
    }

    /// Reads a number, a name, a group or a root.
    fn factor(&mut self, depth: usize) -> Result<(Meaning, FactorKind), UnitError> {
        let (start, from) = (self.at, self.factors.len());
        match self.peek() {
            Some('(') => self.group(start, depth),
            Some('√') => {
                self.at += '√'.len_utf8();
                let span = start..self.at;
                self.skip_space();
                if !self.peek().is_some_and(starts_factor) {
                    let operator = "√".to_owned();
                    return Err(UnitError::MissingFactor {
                        operator,
                        span,
                        side: MissingSide::After,
                    });
                }
                let (inner, _) = self.factor(deeper(depth, span)?)?;
                self.root(inner, start, from)
            }
            Some(c) if c.is_ascii_digit() => self.number(),
            Some(c) if starts_factor(c) => self.name(depth),
            Some(')') if depth == 0 => {
                Err(UnitError::UnbalancedParenthesis { found: ')', span: self.next_span() })
            }
            _ => Err(self.unexpected(FACTOR, None)),
        }
    }

    /// Reads a product in parentheses; the opening one is the next character.
    fn group(&mut self, start: usize, depth: usize) -> Result<(Meaning, FactorKind), UnitError> {
        let open = self.next_span();
        let depth = deeper(depth, open.clone())?;
        self.at = open.end;
        self.skip_space();
        let meaning = match self.peek() {
            None => None,
            Some(')') => {
                return Err(UnitError::MissingFactor {
                    operator: "()".to_owned(),
                    span: start..self.at + 1,
                    side: MissingSide::Inside,
                });
            }
            Some(_) => Some(self.product(depth)?),
        };
        match meaning {
            Some(meaning) if self.take(")") => Ok((meaning, FactorKind::Group)),
            _ => Err(UnitError::UnbalancedParenthesis { found: '(', span: open }),
        }
    }

    /// The square root of the text read since `start`, with the factors from an index on.
    fn root(
        &mut self,
        inner: Meaning,
        start: usize,
        from: usize,
    ) -> Result<(Meaning, FactorKind), UnitError> {
        let fits = self.raise(from, Exponent::HALF);
        let dimension = inner.dimension.checked_pow(Exponent::HALF).filter(|_| fits);
        let scale = inner.scale.power(Exponent::HALF);
        let meaning = self.meaning(dimension, scale, Flavour::Plain, start..self.at)?;
        Ok((meaning, FactorKind::Group))
    }

    /// Reads a number; the next character is a digit.
    fn number(&mut self) -> Result<(Meaning, FactorKind), UnitError> {
        let start = self.at;
        self.take_while(|c| c.is_ascii_digit());
        if matches!(self.rest().as_bytes(), [b'.', b'0'..=b'9', ..]) {
            self.at += 1;
            self.take_while(|c| c.is_ascii_digit());
        }
        if let Some(length) = self.exponent_of_literal() {
            self.at += length;
        }
        let span = start..self.at;
        let scale = Scale::literal(self.slice(span.clone()));
        if let Some(literal) = scale {
            let (number, power) = literal.number_and_power();
            if number != 1.0 {
                self.factors.push(Factor::of(FactorBase::Number(number)));
            }
            if power != 0 {
                let exponent = i32::try_from(power).ok().and_then(|power| Exponent::new(power, 1));
                let exponent =
                    exponent.ok_or(UnitError::FactorOutOfRange { span: span.clone() })?;
                self.factors.push(Factor { base: FactorBase::Number(10.0), exponent });
            }
        }
        Ok((self.meaning(Some(Dimension::NONE), scale, Flavour::Plain, span)?, FactorKind::Number))
    }

    /// The length of an `e-6` that is next.
    pub(super) fn exponent_of_literal(&self) -> Option<usize> {
        let rest = self.rest();
        let after = rest.strip_prefix(['e', 'E'])?;
        let digits = after.strip_prefix(['+', '-']).unwrap_or(after);
        let end = digits.trim_start_matches(|c: char| c.is_ascii_digit());
        (end.len() < digits.len()).then_some(rest.len() - end.len())
    }

    /// Reads a name; the next character is its first one.
    fn name(&mut self, depth: usize) -> Result<(Meaning, FactorKind), UnitError> {
        let (start, from) = (self.at, self.factors.len());
        match self.peek() {
            Some(c) if is_quote(c) => {
                self.take_while(is_quote);
            }
            Some('%' | '‰') => {
                self.at = self.next_span().end;
                self.take_while(char::is_alphabetic);
            }
            _ => {
                let part = |c: char| starts_name(c) || c.is_ascii_digit();
                self.take_while(part);
            }
        }
        let span = start..self.at;
        let name = self.slice(span.clone());
        if name == "sqrt" && self.rest().trim_start().starts_with('(') {
            self.skip_space();
            let (inner, _) = self.group(self.at, depth)?;
            return self.root(inner, start, from);
        }
        if let Some(unit) = self.own.iter().find(|unit| unit.text() == name) {
            self.factors.extend_from_slice(&unit.factors);
            return Ok((unit.meaning(), FactorKind::Name));
        }
        let Some((prefix, symbol)) = read(name) else {
            return Err(suggest::unknown(name, span));
        };
        self.factors.push(Factor::of(FactorBase::Named { prefix, symbol }));
        let meaning = meaning(prefix, symbol).ok_or(UnitError::FactorOutOfRange { span })?;
        Ok((meaning, FactorKind::Name))
    }

    /// Reads a sign; whether it is a minus.
    pub(super) fn sign(&mut self) -> bool {
        self.take("-") || self.take("\u{2212}") || {
            self.take("+");
            false
        }
    }
}

/// The next nesting level, if it is allowed.
fn deeper(depth: usize, span: Range<usize>) -> Result<usize, UnitError> {
    if depth >= MAX_DEPTH {
        return Err(UnitError::NestedTooDeep { span, limit: MAX_DEPTH });
    }
    Ok(depth + 1)
}

/// A sign between two factors.
fn is_operator(c: char) -> bool {
    matches!(c, '*' | '/' | '.' | '·' | '⋅' | '×')
}

/// Apostrophes and primes, and characters that look like them.
fn is_quote(c: char) -> bool {
    matches!(c, '\'' | '"' | '′' | '″' | '’' | '‘' | '“' | '”' | '`' | '´')
}

/// The first character of a name in letters.
fn starts_name(c: char) -> bool {
    c.is_alphabetic() || matches!(c, '_' | '°' | '˚' | '℃')
}

/// The first character of a factor.
fn starts_factor(c: char) -> bool {
    starts_name(c) || is_quote(c) || c.is_ascii_digit() || matches!(c, '(' | '√' | '%' | '‰')
}
