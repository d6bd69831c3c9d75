//! Cutting a formula into tokens.

use std::ops::Range;

use super::error::{FormulaError, NumberFault};
use super::name::{begins_name, continues_name, is_pi};
use super::syntax::Operator;

/// A token with its place.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Token {
    pub(super) kind: TokenKind,
    pub(super) span: Range<usize>,
}

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum TokenKind {
    Number(f64),
    Pi,
    Name,
    Operator(Operator),
    Open,
    Close,
    Comma,
    /// `[...]` as a whole.
    Bracket,
    /// A text in quotes, with the quotes.
    Text,
    End,
}

/// Reads one token after the other.
#[derive(Clone, Debug)]
pub(super) struct Lexer<'t> {
    text: &'t str,
    at: usize,
}

/// Signs made of two characters; they are looked for before those of one.
const DOUBLE: &[(&str, Operator)] = &[
    ("**", Operator::Power),
    ("<=", Operator::LessOrEqual),
    (">=", Operator::GreaterOrEqual),
    ("==", Operator::Equal),
    ("!=", Operator::NotEqual),
];

impl<'t> Lexer<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        Self { text, at: 0 }
    }

    /// The next token; `End`, with an empty span, once nothing is left.
    pub(super) fn next(&mut self) -> Result<Token, FormulaError> {
        self.take_while(char::is_whitespace);
        let start = self.at;
        let Some(c) = self.peek() else {
            // the place where something is missing is right behind the last token
            let end = self.text.trim_end().len();
            return Ok(Token { kind: TokenKind::End, span: end..end });
        };
        let kind = if c == '[' && self.rest().contains(']') {
            self.take_while(|c| c != ']');
            self.at += 1;
            TokenKind::Bracket
        } else if matches!(c, '"' | '\'') && self.rest().get(1..).is_some_and(|r| r.contains(c)) {
            self.at += 1;
            self.take_while(|other| other != c);
            self.at += 1;
            TokenKind::Text
        } else if c.is_ascii_digit() || (c == '.' && self.digit_after(1)) {
            self.number()?
        } else if begins_name(c) {
            let name = self.take_while(continues_name);
            // a part of a quantity: `line.a`
            let part = self.rest().strip_prefix('.');
            if part.is_some_and(|part| part.starts_with(begins_name)) {
                self.at += 1;
                self.take_while(continues_name);
            }
            if is_pi(name) { TokenKind::Pi } else { TokenKind::Name }
        } else {
            self.sign(c)?
        };
        Ok(Token { kind, span: start..self.at })
    }

    fn sign(&mut self, c: char) -> Result<TokenKind, FormulaError> {
        if let Some((text, operator)) =
            DOUBLE.iter().find(|(text, _)| self.rest().starts_with(text))
        {
            self.at += text.len();
            return Ok(TokenKind::Operator(*operator));
        }
        let kind = match c {
            '+' => TokenKind::Operator(Operator::Add),
            '-' | '−' => TokenKind::Operator(Operator::Subtract),
            '*' | '·' | '⋅' | '×' => TokenKind::Operator(Operator::Multiply),
            '/' => TokenKind::Operator(Operator::Divide),
            '^' => TokenKind::Operator(Operator::Power),
            '<' => TokenKind::Operator(Operator::Less),
            '>' => TokenKind::Operator(Operator::Greater),
            '≤' => TokenKind::Operator(Operator::LessOrEqual),
            '≥' => TokenKind::Operator(Operator::GreaterOrEqual),
            '≠' => TokenKind::Operator(Operator::NotEqual),
            '(' => TokenKind::Open,
            ')' => TokenKind::Close,
            ',' => TokenKind::Comma,
            _ => return Err(self.stray(c)),
        };
        self.at += c.len_utf8();
        Ok(kind)
    }

    /// The error for a character that begins no token.
    fn stray(&self, c: char) -> FormulaError {
        let (hint, suggestion) = match c {
            '=' if self.rest().starts_with("=<") => (None, Some("<=")),
            '=' if self.rest().starts_with("=>") => (None, Some(">=")),
            '=' => (
                Some("a comparison is written `==`, and a formula is only the right-hand side"),
                Some("=="),
            ),
            '!' => (Some("a comparison for different values is written `!=`"), Some("!=")),
            '%' => (Some("5 % is written `0.05` or `5 [%]`"), None),
            '|' if self.rest().starts_with("||") => {
                (Some("that one of two comparisons holds is written `or`"), None)
            }
            '|' => (Some("the modulus of x is written `abs(x)`"), None),
            '√' => (Some("the square root of x is written `sqrt(x)`"), None),
            '&' => (Some("that two comparisons both hold is written `and`"), Some("and")),
            '?' | ':' => (Some("a choice is written `if(condition, a, b)`"), None),
            '"' | '\'' => (Some("the quote at the end of this text is missing"), None),
            '°' | 'º' | '˚' => (Some("an angle of 30 degrees is written `30 [deg]`"), None),
            '[' => (Some("write a unit between `[` and `]`; parentheses are `(` and `)`"), None),
            '{' => (Some("parentheses are `(` and `)`"), Some("(")),
            ']' => (Some("there is no `[` before it"), None),
            '}' => (Some("parentheses are `(` and `)`"), Some(")")),
            ';' => (Some("arguments are separated by `,`"), Some(",")),
            '.' => (Some("a decimal fraction has digits beside its point, such as `0.5`"), None),
            '–' | '—' | '‐' | '‑' => (None, Some("-")),
            '÷' | '∕' | '⁄' => (None, Some("/")),
            '∗' | '∙' | '•' => (None, Some("*")),
            'ˆ' => (None, Some("^")),
            _ => (None, None),
        };
        let power: String = self.rest().chars().map_while(superscript).collect();
        let index: String = self.rest().chars().map_while(subscript).collect();
        let script = match (power.as_str(), index.as_str()) {
            ("", "") => None,
            ("", index) => Some(format!("_{index}")),
            (power, _) => Some(format!("^{power}")),
        };
        let suggestion = suggestion.map(str::to_owned).or(script);
        FormulaError::UnexpectedCharacter {
            found: c,
            span: self.at..self.at + c.len_utf8(),
            hint,
            suggestion,
        }
    }

    fn number(&mut self) -> Result<TokenKind, FormulaError> {
        let start = self.at;
        self.take_digits();
        if self.peek() == Some('.') {
            self.at += 1;
            self.take_digits();
        }
        self.take_exponent();
        if self.peek() == Some('.') {
            self.take_while(|c| c.is_ascii_digit() || c == '.');
            return Err(self.bad_number(start, NumberFault::TwoPoints, None));
        }
        if self.peek() == Some('_') && self.digit_after(1) {
            let written = self.take_while(|c| c.is_ascii_digit() || c == '_');
            let before = self.slice(start..self.at - written.len());
            let plain = format!("{before}{}", written.replace('_', ""));
            return Err(self.bad_number(start, NumberFault::Grouped, Some(plain)));
        }
        let written = self.slice(start..self.at).replace('−', "-");
        let mantissa = written.split(['e', 'E']).next().unwrap_or_default();
        let vanished = |value: f64| value == 0.0 && mantissa.contains(|c| matches!(c, '1'..='9'));
        match written.parse::<f64>() {
            Ok(value) if value.is_finite() && !vanished(value) => Ok(TokenKind::Number(value)),
            _ => Err(self.bad_number(start, NumberFault::OutOfRange, None)),
        }
    }

    /// An exponent such as `e-3`, if one is next. Without digits the `e` is a name's.
    fn take_exponent(&mut self) {
        let rest = self.rest();
        let Some(exponent) = rest.strip_prefix(['e', 'E']) else {
            return;
        };
        let digits = exponent.strip_prefix(['+', '-', '−']).unwrap_or(exponent);
        if digits.starts_with(|c: char| c.is_ascii_digit()) {
            self.at += rest.len() - digits.len();
            self.take_digits();
        }
    }

    fn bad_number(
        &self,
        start: usize,
        fault: NumberFault,
        suggestion: Option<String>,
    ) -> FormulaError {
        FormulaError::UnreadableNumber {
            text: self.slice(start..self.at).to_owned(),
            span: start..self.at,
            fault,
            suggestion,
        }
    }

    fn take_digits(&mut self) {
        self.take_while(|c| c.is_ascii_digit());
    }

    fn take_while(&mut self, belongs: impl Fn(char) -> bool) -> &'t str {
        let rest = self.rest();
        let length = rest.find(|c| !belongs(c)).unwrap_or(rest.len());
        self.at += length;
        rest.get(..length).unwrap_or_default()
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn digit_after(&self, bytes: usize) -> bool {
        self.rest().as_bytes().get(bytes).is_some_and(u8::is_ascii_digit)
    }

    fn rest(&self) -> &'t str {
        self.slice(self.at..self.text.len())
    }

    /// A part of the text.
    pub(super) fn slice(&self, span: Range<usize>) -> &'t str {
        self.text.get(span).unwrap_or_default()
    }
}

/// The digit or sign of a superscript.
fn superscript(c: char) -> Option<char> {
    Some(match c {
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        '⁻' => '-',
        '⁰' | '⁴'..='⁹' => char::from_digit(u32::from(c) - 0x2070, 10)?,
        _ => return None,
    })
}

/// The digit of a subscript.
fn subscript(c: char) -> Option<char> {
    matches!(c, '₀'..='₉').then(|| char::from_digit(u32::from(c) - 0x2080, 10)).flatten()
}
