//! Reads the exponent of a power; the grammar is at the top of `parse.rs`.

use std::ops::Range;

use super::error::{MAX_EXPONENT, UnitError};
use super::exponent::Exponent;
use super::parse::Parser;

/// An exponent as read.
pub(super) struct Read {
    /// Its value.
    pub(super) exponent: Exponent,
    /// Its span, without the power sign.
    pub(super) span: Range<usize>,
    /// Written as `^2`, without parentheses or a point.
    pub(super) bare: bool,
}

impl Parser<'_> {
    /// Reads a power sign and an exponent, or superscripts, if they are next.
    pub(super) fn exponent(&mut self, limit: u32) -> Result<Option<Read>, UnitError> {
        let start = self.at;
        if self.peek().is_some_and(|c| superscript(c).is_some()) {
            let written = self.take_while(|c| superscript(c).is_some());
            let plain: String = written.chars().filter_map(superscript).collect();
            return exponent(&plain, written, start..self.at, limit)
                .map(|e| Some(Read { exponent: e, span: start..self.at, bare: false }));
        }
        if !self.take("^") && !self.take("**") {
            return Ok(None);
        }
        let sign = start..self.at;
        self.skip_space();
        let start = self.at;
        let negative = self.sign();
        let bare = self.peek() != Some('(');
        let inner = if bare {
            self.take_while(|c| c.is_alphanumeric() || matches!(c, '_' | '%' | '°'));
            if matches!(self.rest().as_bytes(), [b'.', b'0'..=b'9', ..]) {
                self.at += 1;
                self.take_while(|c| c.is_ascii_digit());
            }
            self.slice(start..self.at).to_owned()
        } else {
            let open = self.next_span();
            self.at = open.end;
            let content = self.take_while(|c| !matches!(c, '(' | ')'));
            if !self.take(")") {
                if self.peek().is_none() {
                    return Err(UnitError::UnbalancedParenthesis { found: '(', span: open });
                }
                let found = self.slice(start..self.at).to_owned();
                return Err(UnitError::ExponentNotANumber { found, span: start..self.at });
            }
            content.to_owned()
        };
        let span = start..self.at;
        let written = self.slice(span.clone());
        if written.is_empty() {
            return Err(UnitError::ExponentNotANumber { found: String::new(), span: sign });
        }
        let mut value = exponent(&inner, written, span.clone(), limit)?;
        if !bare && negative {
            let found = written.to_owned();
            let negative = value.checked_neg();
            value =
                negative.ok_or(UnitError::ExponentTooLarge { found, span: span.clone(), limit })?;
        }
        Ok(Some(Read { exponent: value, span, bare: bare && !inner.contains('.') }))
    }

    /// Rejects `Hz^1/2`: a bare whole exponent before a division by a small whole number.
    pub(super) fn refuse_ambiguous(
        &self,
        base: Range<usize>,
        read: &Read,
    ) -> Result<(), UnitError> {
        let mut ahead = Parser::new(self.text, self.at);
        ahead.skip_space();
        if !ahead.take("/") {
            return Ok(());
        }
        ahead.skip_space();
        let digits = ahead.take_while(|c| c.is_ascii_digit());
        let end = ahead.at;
        let Some(divisor) = digits.parse::<u32>().ok().filter(|d| (2..=MAX_EXPONENT).contains(d))
        else {
            return Ok(());
        };
        let longer_number = ahead.exponent_of_literal().is_some()
            || matches!(ahead.rest().as_bytes(), [b'.', b'0'..=b'9', ..]);
        ahead.skip_space();
        let power = ahead.rest().starts_with("**")
            || ahead.peek().is_some_and(|c| c == '^' || superscript(c).is_some());
        if longer_number || power {
            return Ok(());
        }
        let (base, exponent) = (self.slice(base), read.exponent);
        Err(UnitError::AmbiguousPower {
            span: read.span.start..end,
            as_root: format!("{base}^({exponent}/{divisor})"),
            as_quotient: format!("({base}^{exponent})/{divisor}"),
        })
    }
}

/// The value of an exponent: `2`, `-3`, `1/2`, `0.5`, with spaces. `written` is the whole text at
/// `span`.
fn exponent(
    text: &str,
    written: &str,
    span: Range<usize>,
    limit: u32,
) -> Result<Exponent, UnitError> {
    let found = || written.to_owned();
    let not_a_number = || UnitError::ExponentNotANumber { found: found(), span: span.clone() };
    let too_large = || UnitError::ExponentTooLarge { found: found(), span: span.clone(), limit };
    let text = text.trim();
    let (negative, text) = match text.strip_prefix(['-', '\u{2212}']) {
        Some(rest) => (true, rest.trim_start()),
        None => (false, text.strip_prefix('+').unwrap_or(text).trim_start()),
    };
    let (upper, lower) = match text.split_once('/') {
        Some((upper, lower)) => (upper.trim_end().to_owned(), lower.trim_start().to_owned()),
        None => match text.split_once('.') {
            Some((whole, "")) => (whole.to_owned(), String::new()),
            Some((whole, part)) => {
                (format!("{whole}{part}"), format!("1{}", "0".repeat(part.len())))
            }
            None => (text.to_owned(), "1".to_owned()),
        },
    };
    let digits = |t: &str| !t.is_empty() && t.bytes().all(|b| b.is_ascii_digit());
    if !digits(&upper) || !digits(&lower) || lower.bytes().all(|b| b == b'0') {
        return Err(not_a_number());
    }
    let upper = upper.parse::<i32>().map_err(|_| too_large())?;
    let lower = lower.parse::<i32>().map_err(|_| too_large())?;
    let exponent =
        Exponent::new(if negative { -upper } else { upper }, lower).ok_or_else(too_large)?;
    let fits = exponent.to_f64().abs() <= f64::from(limit)
        && exponent.denominator().unsigned_abs() <= MAX_EXPONENT as u16;
    if fits { Ok(exponent) } else { Err(too_large()) }
}

/// The plain character for a superscript one.
pub(super) fn superscript(c: char) -> Option<char> {
    Some(match c {
        '⁰' => '0',
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        '⁴' => '4',
        '⁵' => '5',
        '⁶' => '6',
        '⁷' => '7',
        '⁸' => '8',
        '⁹' => '9',
        '⁺' => '+',
        '⁻' => '-',
        _ => return None,
    })
}
