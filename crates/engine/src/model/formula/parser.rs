//! Reading a formula.
//!
//! ```text
//! formula    = truth
//! truth      = both { "or" both }
//! both       = not { "and" not }
//! not        = [ "not" ] comparison
//! comparison = sum [ ( "<" | "<=" | "≤" | ">" | ">=" | "≥" | "==" | "!=" | "≠" ) sum ]
//! sum        = product { ( "+" | "-" ) product }               from left to right
//! product    = signed { ( "*" | "/" ) signed }                 from left to right
//! signed     = ( "-" | "+" ) signed | power
//! power      = operand [ ( "^" | "**" ) exponent ]             from right to left: 2^3^2 is 2^9
//! exponent   = ( "-" | "+" ) signed | power
//! operand    = primary [ unit ] | unit                         1.5 [mm]
//! primary    = number | "pi" | "π" | name | call | "(" truth ")"
//! unit       = "[" a unit, or a defining constant "]"
//! call       = name "(" [ argument { "," argument } ] ")"
//! argument   = truth | text                                of `table` alone
//!            | "inverse" "(" calibration function "," truth ")"
//! number     = ( digits [ "." [ digits ] ] | "." digits ) [ ( "e" | "E" ) [ "+" | "-" ] digits ]
//! name       = a letter or "_", then letters, digits and "_" [ "." the same ]
//!            | ( "direction" | "previous" | "extreme" | "since" ) "(" name ")"   without white space
//! ```
//!
//! `-` may be the minus sign `−` and `*` one of `·`, `⋅`, `×`. White space is allowed between
//! tokens. The reader is a Pratt parser: every operator has a rank, and an operand goes to the
//! neighbour of higher rank. It calls itself only for what is nested, and nesting is limited.

use std::ops::Range;
use std::sync::Arc;

use super::constant::DefiningConstant;
use super::error::{FormulaError, NumberFault};
use super::function::Function;
use super::lexer::{Lexer, Token, TokenKind};
use super::message::excerpt;
use super::name::is_name;
use super::syntax::{Joint, NEGATION, Node, NodeKind, Operator, TableCall, Tree};
use crate::model::InterpolationMethod;
use crate::regression::CurveFunction;
use gumption_units::Unit;

/// The longest formula, in bytes.
pub(super) const MAX_LENGTH: usize = 100_000;

/// The deepest nesting of parentheses, calls, signs and exponents.
pub(super) const MAX_DEPTH: usize = 100;

const OPERAND: &str = "a number, a name, a function or `(`";

/// The call that turns a calibration function round.
const INVERSE: &str = "inverse";

/// What a condition was before, as the name of a quantity: `direction(m)` of the condition `m`.
const HISTORY: [&str; 4] = ["direction", "previous", "extreme", "since"];

/// A constant in brackets is no unit behind a number.
const HOUR: &str = "[hour]";
const AFTER_WHOLE: &str = "an operator or the end of the formula";
const AFTER_PART: &str = "an operator or `)`";
const AFTER_ARGUMENT: &str = "an operator, `,` or `)`";
const TEXT: &str = "a text in quotes: table(x, 'file.csv', 'x column', 'y column', 'linear')";
const SOLVE: &str = "`,`, as in solve(formula, unknown, from, to)";
const UNKNOWN: &str = "the name of the unknown, as in solve(formula, unknown, from, to)";

/// The rank of what an operand is part of.
type Rank = u8;

const LOOSEST: Rank = 0;
/// Above `*` and `/`, below `^`.
const SIGN: Rank = 13;
/// Above `and`, below comparisons.
const NOT: Rank = 6;

/// The ranks of a joint to its left and to its right.
fn joint_ranks(joint: Joint) -> (Rank, Rank) {
    match joint {
        Joint::And => (3, 4),
        Joint::Or => (1, 2),
    }
}

/// How deep equations to solve may be inside each other: the inner one is solved at every step of the
/// outer one.
const MAX_SOLVES: usize = 2;

/// The ranks of an operator to its left and to its right.
fn ranks(operator: Operator) -> (Rank, Rank) {
    match operator {
        Operator::Add | Operator::Subtract => (9, 10),
        Operator::Multiply | Operator::Divide => (11, 12),
        Operator::Power => (15, 14),
        _ => (7, 8),
    }
}

/// Reads a whole formula without calibration functions.
#[cfg(test)]
pub(super) fn parse(text: &str) -> Result<Tree, FormulaError> {
    parse_with(text, &[], &[])
}

/// Reads a whole formula, which may call these calibration functions and use these units.
pub(super) fn parse_with(
    text: &str,
    curves: &[Arc<CurveFunction>],
    units: &[Unit],
) -> Result<Tree, FormulaError> {
    if text.len() > MAX_LENGTH {
        return Err(FormulaError::TooLong { length: text.len(), limit: MAX_LENGTH });
    }
    let mut lexer = Lexer::new(text);
    let token = lexer.next()?;
    if token.kind == TokenKind::End {
        return Err(FormulaError::Empty);
    }
    let mut parser = Parser {
        text,
        curves,
        units,
        lexer,
        token,
        last: None,
        depth: 0,
        solves: 0,
        opened: Vec::new(),
        nodes: Vec::new(),
    };
    parser.expression(LOOSEST)?;
    if parser.token.kind != TokenKind::End {
        return Err(parser.unexpected(AFTER_WHOLE));
    }
    Ok(Tree { nodes: parser.nodes })
}

struct Parser<'t> {
    text: &'t str,
    curves: &'t [Arc<CurveFunction>],
    /// Units with names of their own.
    units: &'t [Unit],
    lexer: Lexer<'t>,
    /// The token that is next.
    token: Token,
    /// The token before it.
    last: Option<Token>,
    depth: usize,
    /// Equations to solve around this place.
    solves: usize,
    /// The parentheses that are open.
    opened: Vec<Range<usize>>,
    nodes: Vec<Node>,
}

/// What has been read: a node, and its place with the parentheses around it.
struct ReadNode {
    node: usize,
    outer: Range<usize>,
}

impl Parser<'_> {
    /// Reads operands and operators down to rank `least`.
    fn expression(&mut self, least: Rank) -> Result<ReadNode, FormulaError> {
        let mut left = self.operand()?;
        let mut compared: Option<Range<usize>> = None;
        loop {
            if let Some(joint) = self.joint() {
                if joint_ranks(joint).0 < least {
                    break;
                }
                left = self.joined(joint, left)?;
                continue;
            }
            let TokenKind::Operator(operator) = self.token.kind else { break };
            let (rank, rank_right) = ranks(operator);
            if rank < least {
                break;
            }
            let operator_span = self.token.span.clone();
            if operator.is_comparison() {
                if let Some(first) = compared {
                    return Err(FormulaError::ChainedComparison { span: operator_span, first });
                }
                compared = Some(operator_span.clone());
            }
            self.advance()?;
            let right = if operator == Operator::Power {
                self.nested(&operator_span, |parser| parser.expression(rank_right))?
            } else {
                self.expression(rank_right)?
            };
            let span = left.outer.start..right.outer.end;
            let (left_node, right_node) = (left.node, right.node);
            let kind =
                NodeKind::Infix { operator, operator_span, left: left_node, right: right_node };
            left = self.push(kind, span);
        }
        Ok(left)
    }

    /// Reads what stands behind `and` or `or`; apart, to leave room on the stack.
    #[inline(never)]
    fn joined(&mut self, joint: Joint, left: ReadNode) -> Result<ReadNode, FormulaError> {
        let (_, rank) = joint_ranks(joint);
        let span = self.token.span.clone();
        self.advance()?;
        let right = self.nested(&span, |parser| parser.expression(rank))?;
        let outer = left.outer.start..right.outer.end;
        let kind = NodeKind::Joined { joint, span, left: left.node, right: right.node };
        Ok(self.push(kind, outer))
    }

    /// The joint that is next: `and` or `or`, which are names where an operand stands.
    fn joint(&self) -> Option<Joint> {
        match (self.token.kind, self.slice(&self.token.span)) {
            (TokenKind::Name, word) => Joint::ALL.into_iter().find(|joint| joint.name() == word),
            _ => None,
        }
    }

    /// Reads an operand with its signs and the unit behind it.
    fn operand(&mut self) -> Result<ReadNode, FormulaError> {
        let signed = matches!(self.token.kind, TokenKind::Operator(_));
        let part = self.primary()?;
        if signed || self.token.kind != TokenKind::Bracket {
            return Ok(part);
        }
        self.number_of_units(part)
    }

    /// Reads the unit behind a number; apart from [`Self::operand`], which calls itself in the end
    /// and so has little room on the stack.
    #[inline(never)]
    fn number_of_units(&mut self, part: ReadNode) -> Result<ReadNode, FormulaError> {
        let place = self.token.span.clone();
        let span = part.outer.start..place.end;
        let text = self.slice(&span).to_owned();
        let number = self.slice(&part.outer).to_owned();
        let two = |first: String, second: String| {
            let (text, readings) = (text.clone(), [first, second]);
            Err(FormulaError::TwoReadings { text, span: span.clone(), readings })
        };
        let unit = match self.bracket(&place)? {
            NodeKind::Unit(unit) => unit,
            NodeKind::Constant(DefiningConstant::Planck) => {
                return two(format!("{number} {HOUR}"), format!("{number}*[h]"));
            }
            _ => {
                let constant = self.slice(&place).to_owned();
                return two(format!("{number}*{constant}"), format!("{number}/{constant}"));
            }
        };
        self.advance()?;
        if self.token.kind == TokenKind::Operator(Operator::Power) {
            let text = unit.text().trim();
            return two(format!("{number} [({text})^2]"), format!("({number} [{text}])^2"));
        }
        Ok(self.push(NodeKind::InUnit { number: part.node, unit }, span))
    }

    /// What stands between brackets.
    #[inline(never)]
    fn bracket(&self, place: &Range<usize>) -> Result<NodeKind, FormulaError> {
        let inside = self.slice(place);
        let inside = inside.strip_prefix('[').and_then(|text| text.strip_suffix(']'));
        let text = inside.unwrap_or_default();
        if let Some(constant) = DefiningConstant::named(text.trim()) {
            return Ok(NodeKind::Constant(constant));
        }
        match Unit::parse_among(text, self.units) {
            Ok(unit) if !text.trim().is_empty() => Ok(NodeKind::Unit(Box::new(unit))),
            Ok(_) => Err(self.unexpected(OPERAND)),
            Err(error) => {
                let (text, error) = (text.to_owned(), Box::new(error));
                Err(FormulaError::BadUnit { text, span: place.clone(), error })
            }
        }
    }

    /// Reads an operand with its signs.
    fn primary(&mut self) -> Result<ReadNode, FormulaError> {
        let span = self.token.span.clone();
        match self.token.kind {
            TokenKind::Bracket => {
                let kind = self.bracket(&span)?;
                self.advance()?;
                Ok(self.push(kind, span))
            }
            TokenKind::Number(value) => {
                self.advance()?;
                Ok(self.push(NodeKind::Number(value), span))
            }
            TokenKind::Pi => {
                self.advance()?;
                Ok(self.push(NodeKind::Pi, span))
            }
            TokenKind::Name => self.name_or_call(),
            TokenKind::Open => {
                self.open()?;
                let part = self.nested(&span, |parser| parser.expression(LOOSEST))?;
                let outer = span.start..self.token.span.end;
                self.close(AFTER_PART)?;
                Ok(ReadNode { outer, ..part })
            }
            TokenKind::Operator(sign @ (Operator::Subtract | Operator::Add)) => {
                self.advance()?;
                let part = self.nested(&span, |parser| parser.expression(SIGN))?;
                let outer = span.start..part.outer.end;
                Ok(match sign {
                    Operator::Subtract if self.negate_literal(part.node) => {
                        ReadNode { outer, ..part }
                    }
                    Operator::Subtract => self.push(NodeKind::Negate(part.node), outer),
                    _ => ReadNode { outer, ..part },
                })
            }
            _ => Err(self.unexpected(OPERAND)),
        }
    }

    /// Makes -5 degC of a minus sign before `5 [degC]`: the number is negative, not the temperature.
    fn negate_literal(&mut self, node: usize) -> bool {
        let number = match self.nodes.get(node).map(|node| &node.kind) {
            Some(NodeKind::InUnit { number, unit }) if unit.zero().is_some() => *number,
            _ => return false,
        };
        match self.nodes.get_mut(number).map(|node| &mut node.kind) {
            Some(NodeKind::Number(value)) => {
                *value = -*value;
                true
            }
            _ => false,
        }
    }

    #[inline(never)]
    fn name_or_call(&mut self) -> Result<ReadNode, FormulaError> {
        let name_span = self.token.span.clone();
        let function = Function::named(self.slice(&name_span));
        self.advance()?;
        if self.slice(&name_span) == NEGATION && self.truth_follows() {
            return self.negated(name_span);
        }
        if self.token.kind != TokenKind::Open {
            return match function {
                Some(function) if function.is_reserved() => {
                    Err(self.without_arguments(function, name_span))
                }
                _ => Ok(self.push(NodeKind::Name, name_span)),
            };
        }
        if function.is_none() && !self.curves.is_empty() {
            let name = self.slice(&name_span);
            if let Some(curve) = self.curve(name) {
                return self.curve_call(&curve, &name_span, false);
            }
            if name == INVERSE {
                return self.inverse(&name_span);
            }
        }
        if let Some(end) = self.end_of_history(&name_span) {
            while self.token.span.start < end {
                self.advance()?;
            }
            return Ok(self.push(NodeKind::Name, name_span.start..end));
        }
        self.open()?;
        if let Some(function @ (Function::Table | Function::Solve)) = function {
            return self.special(function, name_span);
        }
        let arguments = self.nested(&name_span, Self::arguments)?;
        let span = name_span.start..self.token.span.end;
        self.close(AFTER_ARGUMENT)?;
        if let Some(Function::Sum | Function::Mean) = function
            && arguments.len() > 1
        {
            return Ok(self.summed(function, &arguments, (name_span, span)));
        }
        Ok(self.push(NodeKind::Call { function, name_span, arguments }, span))
    }

    /// Whether something follows that can be a truth, so that `not` is no name.
    fn truth_follows(&self) -> bool {
        let begins = matches!(
            self.token.kind,
            TokenKind::Name | TokenKind::Number(_) | TokenKind::Open | TokenKind::Pi
        );
        begins && self.joint().is_none()
    }

    /// Reads what stands behind `not`.
    #[inline(never)]
    fn negated(&mut self, span: Range<usize>) -> Result<ReadNode, FormulaError> {
        let of = self.nested(&span, |parser| parser.expression(NOT))?;
        let outer = span.start..of.outer.end;
        Ok(self.push(NodeKind::Not { span, of: of.node }, outer))
    }

    /// Reads a call whose arguments are not all formulas.
    #[inline(never)]
    fn special(
        &mut self,
        function: Function,
        name: Range<usize>,
    ) -> Result<ReadNode, FormulaError> {
        self.nested(&name, |parser| match function {
            Function::Table => parser.table(&name),
            _ => parser.solve(&name),
        })
    }

    /// Reads the arguments of `table`: the abscissa, then texts.
    #[inline(never)]
    fn table(&mut self, name_span: &Range<usize>) -> Result<ReadNode, FormulaError> {
        let x = self.expression(LOOSEST)?.node;
        let mut texts: Vec<(String, Range<usize>)> = Vec::new();
        while self.token.kind == TokenKind::Comma {
            self.advance()?;
            if self.token.kind != TokenKind::Text {
                return Err(self.unexpected(TEXT));
            }
            let span = self.token.span.clone();
            let text = self.slice(&(span.start + 1..span.end - 1)).to_owned();
            texts.push((text, span));
            self.advance()?;
        }
        let span = name_span.start..self.token.span.end;
        self.close(AFTER_ARGUMENT)?;
        let count = |found: usize| FormulaError::ArgumentCount {
            function: Function::Table.name(),
            span: name_span.clone(),
            expected: Function::Table.arity(),
            found,
            suggestion: None,
        };
        let mut texts = texts.into_iter();
        let Some((file, _)) = texts.next() else { return Err(count(1)) };
        let columns = match (texts.next(), texts.next()) {
            (None, _) => None,
            (Some(_), None) => return Err(FormulaError::TableColumns { span }),
            (Some((x, _)), Some((y, _))) => Some([x, y]),
        };
        let method = match texts.next() {
            None => InterpolationMethod::default(),
            Some((text, span)) => {
                let named = InterpolationMethod::ALL.into_iter().find(|m| m.name() == text);
                named.ok_or(FormulaError::TableMethod { found: text, span })?
            }
        };
        if texts.next().is_some() {
            return Err(count(6));
        }
        let call = Box::new(TableCall { file, columns, method, span: span.clone() });
        Ok(self.push(NodeKind::Table { x, call }, span))
    }

    /// Reads the arguments of `solve`: a formula, the name of the unknown, two ends.
    #[inline(never)]
    fn solve(&mut self, name_span: &Range<usize>) -> Result<ReadNode, FormulaError> {
        if self.solves == MAX_SOLVES {
            let (span, limit) = (name_span.clone(), MAX_SOLVES);
            return Err(FormulaError::TooManySolves { span, limit });
        }
        self.solves += 1;
        let outer = std::mem::take(&mut self.nodes);
        self.expression(LOOSEST)?;
        let body = Box::new(Tree { nodes: std::mem::replace(&mut self.nodes, outer) });
        self.solves -= 1;
        self.comma(SOLVE)?;
        if self.token.kind != TokenKind::Name {
            return Err(self.unexpected(UNKNOWN));
        }
        let unknown = self.token.span.clone();
        self.advance()?;
        self.comma(SOLVE)?;
        let from = self.expression(LOOSEST)?.node;
        self.comma(SOLVE)?;
        let to = self.expression(LOOSEST)?.node;
        let span = name_span.start..self.token.span.end;
        self.close(AFTER_ARGUMENT)?;
        Ok(self.push(NodeKind::Solve { body, unknown, from, to }, span))
    }

    fn comma(&mut self, expected: &'static str) -> Result<(), FormulaError> {
        if self.token.kind != TokenKind::Comma {
            return Err(self.unexpected(expected));
        }
        self.advance()
    }

    /// Where a name such as `direction(m)` ends, of which the first word was read.
    fn end_of_history(&self, word: &Range<usize>) -> Option<usize> {
        let behind = self.text.get(word.end..)?.strip_prefix('(')?;
        let (of, _) = behind.split_once(')')?;
        let is_one = HISTORY.contains(&self.slice(word)) && is_name(of);
        is_one.then_some(word.end + of.len() + 2)
    }

    fn curve(&self, name: &str) -> Option<Arc<CurveFunction>> {
        self.curves.iter().find(|curve| curve.fit.name == name).cloned()
    }

    /// `inverse(line, y)`, from its parenthesis on.
    fn inverse(&mut self, name_span: &Range<usize>) -> Result<ReadNode, FormulaError> {
        self.open()?;
        let (name, span) = (self.slice(&self.token.span).to_owned(), self.token.span.clone());
        let Some(curve) = self.curve(&name) else {
            let known: Vec<String> =
                self.curves.iter().map(|curve| format!("`{}`", curve.fit.name)).collect();
            let reason = format!(
                "the first argument of `inverse` is a calibration function: {}",
                known.join(", ")
            );
            return Err(FormulaError::Curve { reason, span });
        };
        self.advance()?;
        if self.token.kind != TokenKind::Comma {
            return Err(self.unexpected("`,` and the value of y"));
        }
        if curve.fit.is_complex() {
            let reason = format!(
                "`{name}` is complex and has no inverse: a real x cannot give every value; fit a part \
                 of it as a real form, such as its modulus"
            );
            return Err(FormulaError::Curve { reason, span });
        }
        if let Err(at) = curve.fit.direction() {
            let reason = format!(
                "`{name}` turns at about x = {}{}, so that some values of y belong to two x; fit the \
                 points on one side of it",
                crate::decimal::significant(at, 3),
                match curve.x.text().trim() {
                    "" | "1" => String::new(),
                    unit => format!(" {unit}"),
                }
            );
            return Err(FormulaError::Curve { reason, span });
        }
        self.curve_call(&curve, name_span, true)
    }

    /// A calibration function at its argument, from the parenthesis or the comma before it on.
    fn curve_call(
        &mut self,
        curve: &Arc<CurveFunction>,
        name_span: &Range<usize>,
        inverse: bool,
    ) -> Result<ReadNode, FormulaError> {
        if inverse {
            self.advance()?;
        } else {
            self.open()?;
        }
        let arguments = self.nested(name_span, Self::arguments)?;
        let span = name_span.start..self.token.span.end;
        self.close(AFTER_ARGUMENT)?;
        let &[argument] = arguments.as_slice() else {
            let name = &curve.fit.name;
            let call = if inverse { format!("inverse({name}, y)") } else { format!("{name}(x)") };
            let reason = format!("a calibration function is called as `{call}`");
            return Err(FormulaError::Curve { reason, span });
        };
        let curve = Arc::clone(curve);
        Ok(self.push(NodeKind::Curve { curve, inverse, argument }, span))
    }

    /// `sum(a, b, c)` as `a + b + c`, and `mean` of them as that over 3.
    #[inline(never)]
    fn summed(
        &mut self,
        function: Option<Function>,
        arguments: &[usize],
        (name_span, span): (Range<usize>, Range<usize>),
    ) -> ReadNode {
        let mut nodes = arguments.iter().copied();
        let mut part = ReadNode { node: nodes.next().unwrap_or_default(), outer: span.clone() };
        for right in nodes {
            let (operator, operator_span) = (Operator::Add, name_span.clone());
            let kind = NodeKind::Infix { operator, operator_span, left: part.node, right };
            part = self.push(kind, span.clone());
        }
        if function == Some(Function::Sum) {
            return part;
        }
        let count = self.push(NodeKind::Number(arguments.len() as f64), name_span.clone());
        let (operator, operator_span) = (Operator::Divide, name_span);
        let (left, right) = (part.node, count.node);
        self.push(NodeKind::Infix { operator, operator_span, left, right }, span)
    }

    /// Reads the arguments of a call up to its closing parenthesis.
    #[inline(never)]
    fn arguments(&mut self) -> Result<Vec<usize>, FormulaError> {
        let mut arguments = Vec::new();
        if self.token.kind == TokenKind::Close {
            return Ok(arguments);
        }
        loop {
            arguments.push(self.expression(LOOSEST)?.node);
            if self.token.kind != TokenKind::Comma {
                return Ok(arguments);
            }
            self.advance()?;
        }
    }

    /// Reads something that is inside of something else.
    fn nested<R>(
        &mut self,
        span: &Range<usize>,
        read: impl FnOnce(&mut Self) -> Result<R, FormulaError>,
    ) -> Result<R, FormulaError> {
        if self.depth == MAX_DEPTH {
            return Err(FormulaError::TooDeep { span: span.clone(), limit: MAX_DEPTH });
        }
        self.depth += 1;
        let result = read(self);
        self.depth -= 1;
        result
    }

    fn open(&mut self) -> Result<(), FormulaError> {
        self.opened.push(self.token.span.clone());
        self.advance()
    }

    fn close(&mut self, expected: &'static str) -> Result<(), FormulaError> {
        if self.token.kind != TokenKind::Close {
            return Err(self.unexpected(expected));
        }
        self.opened.pop();
        self.advance()
    }

    fn advance(&mut self) -> Result<(), FormulaError> {
        let next = self.lexer.next()?;
        self.last = Some(std::mem::replace(&mut self.token, next));
        Ok(())
    }

    fn push(&mut self, kind: NodeKind, span: Range<usize>) -> ReadNode {
        self.nodes.push(Node { kind, span: span.clone() });
        ReadNode { node: self.nodes.len() - 1, outer: span }
    }

    fn slice(&self, span: &Range<usize>) -> &str {
        self.text.get(span.clone()).unwrap_or_default()
    }

    /// The error for a next token that cannot stand where it does.
    #[inline(never)]
    fn unexpected(&self, expected: &'static str) -> FormulaError {
        let Token { kind, span } = &self.token;
        if *kind == TokenKind::End {
            let opened = self.opened.last().cloned();
            return FormulaError::UnexpectedEnd { span: span.clone(), expected, opened };
        }
        if let Some(error) = self.decimal_comma() {
            return error;
        }
        let (hint, suggestion) = match kind {
            _ if expected == OPERAND => self.missing_operand(),
            _ if matches!(expected, TEXT | UNKNOWN | SOLVE) => (None, None),
            TokenKind::Close => {
                (Some("this parenthesis closes nothing; remove it or add `(`".into()), None)
            }
            TokenKind::Number(_) if self.last_is_number() => {
                (Some("two numbers need an operator between them".into()), None)
            }
            TokenKind::Name
                if self.last_is_number()
                    && Unit::parse_among(self.slice(span), self.units).is_ok() =>
            {
                let number = self.last.as_ref().map_or("", |last| self.slice(&last.span));
                let unit = self.slice(span);
                if self.last.as_ref().is_some_and(|last| last.span.end == span.start) {
                    // `2V` may be two volts, or twice a quantity of that name
                    let hint = format!(
                        "write the unit of a number in brackets, `{number} [{unit}]`, and a \
                         product with `*`, `{number}*{unit}`"
                    );
                    (Some(hint.into()), None)
                } else {
                    let hint = "write the unit of a number in brackets";
                    (Some(hint.into()), Some(format!("{number} [{unit}]")))
                }
            }
            TokenKind::Number(_) | TokenKind::Pi | TokenKind::Name | TokenKind::Open => {
                let before = self.last.as_ref().map_or("", |last| self.slice(&last.span));
                let here = self.slice(span);
                let short = before.len() + here.len() < 60;
                // `V/2R` is meant as V/(2*R), and `V/2*R` is (V/2)*R
                let divides = self.last.as_ref().is_some_and(|last| {
                    let text = self.text.get(..last.span.start).unwrap_or_default();
                    text.trim_end().ends_with(['/', '÷'])
                });
                let product = short.then(|| match divides {
                    true => format!("({before}*{here})"),
                    false => format!("{before}*{here}"),
                });
                (Some("a product is written with `*`".into()), product)
            }
            _ => (None, None),
        };
        FormulaError::UnexpectedToken {
            found: excerpt(self.text, span.clone()),
            span: span.clone(),
            expected,
            hint,
            suggestion,
        }
    }

    /// What may be meant where an operand is missing: `<>`.
    fn missing_operand(&self) -> (Option<Box<str>>, Option<String>) {
        let before = self.last.as_ref().map(|last| (last.kind, last.span.end));
        let here = (self.token.kind, self.token.span.start);
        match (before, here) {
            (
                Some((TokenKind::Operator(Operator::Less), end)),
                (TokenKind::Operator(Operator::Greater), start),
            ) if start == end => (None, Some("!=".to_owned())),
            _ => (None, None),
        }
    }

    fn last_is_number(&self) -> bool {
        self.last.as_ref().is_some_and(|last| matches!(last.kind, TokenKind::Number(_)))
    }

    /// The error for a comma between digits, where no comma can stand.
    #[inline(never)]
    fn decimal_comma(&self) -> Option<FormulaError> {
        let last = self.last.as_ref().filter(|_| self.last_is_number())?;
        let comma = &self.token;
        let behind = self.text.get(comma.span.end..)?;
        let digits = behind.find(|c: char| !c.is_ascii_digit()).unwrap_or(behind.len());
        let adjacent = comma.kind == TokenKind::Comma && last.span.end == comma.span.start;
        if !adjacent || digits == 0 {
            return None;
        }
        let span = last.span.start..comma.span.end + digits;
        let text = self.slice(&span).to_owned();
        let suggestion = Some(text.replace(',', ".")).filter(|t| t.matches('.').count() == 1);
        Some(FormulaError::UnreadableNumber { text, span, fault: NumberFault::Comma, suggestion })
    }

    /// The error for a function's name without parentheses behind it.
    #[inline(never)]
    fn without_arguments(&self, function: Function, span: Range<usize>) -> FormulaError {
        let name = function.name().to_owned();
        let argument = match self.token.kind {
            TokenKind::Number(_) | TokenKind::Pi | TokenKind::Name => {
                excerpt(self.text, self.token.span.clone())
            }
            _ if function.arity().admits(1) => "x".to_owned(),
            _ => "x, y".to_owned(),
        };
        let suggestion = format!("{name}({argument})");
        FormulaError::FunctionWithoutArguments { name, span, suggestion }
    }
}
