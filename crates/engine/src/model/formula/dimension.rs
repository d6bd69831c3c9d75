//! Checking names and dimensions through a formula.

use std::collections::HashSet;
use std::ops::Range;

use super::error::{FormulaError, Operand};
use super::fraction::{Fraction, fractions};
use super::function::Function;
use super::message::excerpt;
use super::suggest;
use super::syntax::{Kind, Node, Operator, Tree};
use super::typing::{Celsius, Scope, Typing};
use crate::number::{Binary, Unary};
use gumption_units::{Dimension, Exponent};

/// The most mistakes reported of one formula.
const MAX_ERRORS: usize = 50;

/// The most defined names that a message lists.
const MAX_KNOWN: usize = 12;

/// What came out of checking a formula.
pub(super) struct Checked {
    /// What is known about each node.
    pub(super) typings: Vec<Typing>,
    /// The mistakes, in the order in which the nodes stand.
    pub(super) errors: Vec<FormulaError>,
}

/// Checks a formula; dimensions only if `units` says so. A part with a mistake fits everything
/// around it, so that nothing is reported twice.
pub(super) fn check(text: &str, tree: &Tree, scope: &Scope, units: bool) -> Checked {
    let mut checker = Checker {
        text,
        tree,
        scope,
        units,
        fractions: fractions(text, tree),
        reported: HashSet::new(),
        done: Checked { typings: Vec::with_capacity(tree.nodes.len()), errors: Vec::new() },
    };
    for node in &tree.nodes {
        let typing = checker.node(node);
        checker.done.typings.push(typing);
    }
    checker.done
}

struct Checker<'c> {
    text: &'c str,
    tree: &'c Tree,
    scope: &'c Scope,
    units: bool,
    fractions: Vec<Option<Fraction>>,
    /// Unknown names and functions that have been reported, the latter with a parenthesis.
    reported: HashSet<&'c str>,
    done: Checked,
}

impl<'c> Checker<'c> {
    fn node(&mut self, node: &Node) -> Typing {
        match &node.kind {
            Kind::Number(0.0) => Typing::ANY,
            Kind::Number(_) | Kind::Pi => Typing::NUMBER,
            Kind::Name => self.name(&node.span),
            Kind::Negate(x) => self.typing(*x),
            Kind::Infix { operator, operator_span, left, right } => {
                self.infix(*operator, operator_span, &node.span, *left, *right)
            }
            Kind::Call { function: None, name_span, .. } => {
                self.no_function(name_span);
                Typing::ANY
            }
            Kind::Call { function: Some(function), name_span, arguments } => {
                if function.arity().admits(arguments.len()) {
                    self.call(*function, name_span, &node.span, arguments)
                } else {
                    self.argument_count(*function, name_span, arguments);
                    Typing::ANY
                }
            }
        }
    }

    fn name(&mut self, span: &Range<usize>) -> Typing {
        let name = self.slice(span);
        if let Some(typing) = self.scope.get(name) {
            return typing;
        }
        if self.has_room() && self.reported.insert(name) {
            let (name, span) = (name.to_owned(), span.clone());
            self.done.errors.push(if self.scope.is_announced(&name) {
                FormulaError::DefinedLater { name, span }
            } else {
                let nearest = suggest::names(&name, self.scope.names());
                let known = self.scope.names().take(MAX_KNOWN).map(str::to_owned).collect();
                FormulaError::UnknownName { name, span, nearest, known }
            });
        }
        Typing::ANY
    }

    fn no_function(&mut self, span: &Range<usize>) {
        let called = self.slice(&(span.start..span.end + 1));
        if !self.has_room() || !self.reported.insert(called) {
            return;
        }
        let (name, span) = (self.slice(span).to_owned(), span.clone());
        self.done.errors.push(if self.scope.get(&name).is_some() {
            FormulaError::NotAFunction { name, span }
        } else {
            let nearest = suggest::functions(&name);
            FormulaError::UnknownFunction { name, span, nearest }
        });
    }

    fn argument_count(&mut self, function: Function, span: &Range<usize>, arguments: &[usize]) {
        // `sin(1,5)` is one argument with a decimal comma
        let suggestion = match arguments {
            &[whole, decimals] if function.arity().admits(1) => {
                let (whole, decimals) = (self.tree.span(whole), self.tree.span(decimals));
                let digits =
                    |span: &Range<usize>| self.slice(span).bytes().all(|b| b.is_ascii_digit());
                let adjacent = decimals.start == whole.end + 1;
                (adjacent && digits(&whole) && digits(&decimals)).then(|| {
                    let (whole, decimals) = (self.slice(&whole), self.slice(&decimals));
                    format!("{}({whole}.{decimals})", function.name())
                })
            }
            _ => None,
        };
        self.report(FormulaError::ArgumentCount {
            function: function.name(),
            span: span.clone(),
            expected: function.arity(),
            found: arguments.len(),
            suggestion,
        });
    }

    fn infix(
        &mut self,
        operator: Operator,
        operator_span: &Range<usize>,
        span: &Range<usize>,
        left: usize,
        right: usize,
    ) -> Typing {
        let (x, y) = (self.typing(left), self.typing(right));
        match operator {
            Operator::Add | Operator::Subtract => {
                let dimension = self.alike(operator.name(), operator_span, &[left, right]);
                let celsius = match operator {
                    Operator::Add => sum(x, y, Celsius::plus),
                    _ => sum(x, y, Celsius::minus),
                };
                Typing { dimension, celsius }
            }
            Operator::Multiply => {
                let (a, b) = (x.dimension, y.dimension);
                let product = a.zip(b).map(|(a, b)| a.checked_mul(b));
                let celsius = match (a, b) {
                    (Some(Dimension::NONE), _) => y.celsius,
                    (_, Some(Dimension::NONE)) => x.celsius,
                    _ => Celsius::No,
                };
                Typing { dimension: self.in_range(product, span), celsius }
            }
            Operator::Divide => {
                let quotient = x.dimension.zip(y.dimension).map(|(a, b)| a.checked_div(b));
                let by_number = y.dimension == Some(Dimension::NONE);
                let celsius = if by_number { x.celsius } else { Celsius::No };
                Typing { dimension: self.in_range(quotient, span), celsius }
            }
            Operator::Power => self.power(span, left, right),
            _ => {
                self.alike(operator.name(), operator_span, &[left, right]);
                Typing::NUMBER
            }
        }
    }

    fn power(&mut self, span: &Range<usize>, base: usize, exponent: usize) -> Typing {
        let base_dimension = self.typing(base).dimension;
        if let Some(operand) = self.not_plain(exponent) {
            self.report_dimension(FormulaError::ExponentNotPlain { exponent: operand });
            return Typing::ANY;
        }
        let constant = self.fractions.get(exponent).copied().flatten();
        if constant.and_then(Fraction::exponent) == Some(Exponent::ZERO) {
            return Typing::NUMBER;
        }
        let dimension = match base_dimension {
            None => return Typing::ANY,
            Some(Dimension::NONE) => return Typing::NUMBER,
            Some(dimension) => dimension,
        };
        let Some(constant) = constant else {
            let base = self.operand(base, dimension);
            let exponent_span = self.tree.span(exponent);
            self.report_dimension(FormulaError::ExponentNotConstant {
                base,
                exponent: excerpt(self.text, exponent_span.clone()),
                span: exponent_span,
            });
            return Typing::ANY;
        };
        let power = constant.exponent().and_then(|exponent| dimension.checked_pow(exponent));
        Typing { dimension: self.in_range(Some(power), span), celsius: Celsius::No }
    }

    fn call(
        &mut self,
        function: Function,
        name_span: &Range<usize>,
        span: &Range<usize>,
        arguments: &[usize],
    ) -> Typing {
        let first = arguments.first().copied().unwrap_or_default();
        let typing = self.typing(first);
        match function {
            Function::One(Unary::Negate | Unary::Abs) => typing,
            Function::One(operation @ (Unary::Sqrt | Unary::Cbrt)) => {
                let degree = if operation == Unary::Sqrt { 2 } else { 3 };
                let root = typing.dimension.map(|dimension| dimension.checked_root(degree));
                Typing { dimension: self.in_range(root, span), celsius: Celsius::No }
            }
            Function::One(_) => {
                if let Some(argument) = self.not_plain(first) {
                    self.report_dimension(FormulaError::ArgumentNotPlain {
                        function: function.name(),
                        function_span: name_span.clone(),
                        argument,
                    });
                }
                Typing::NUMBER
            }
            Function::Two(Binary::Atan2) => {
                self.alike(function.name(), name_span, arguments);
                Typing::NUMBER
            }
            Function::Two(_) | Function::Fold(_) => {
                let dimension = self.alike(function.name(), name_span, arguments);
                let together = |x: Typing, &argument: &usize| {
                    let y = self.typing(argument);
                    let celsius = sum(x, y, Celsius::plus);
                    Typing { dimension: x.dimension.or(y.dimension), celsius }
                };
                let celsius = arguments.iter().fold(Typing::ANY, together).celsius;
                Typing { dimension, celsius }
            }
            Function::Kelvin => {
                if !typing.fits(Dimension::TEMPERATURE)
                    && let Some(dimension) = typing.dimension
                {
                    let argument = self.operand(first, dimension);
                    self.report_dimension(FormulaError::NotATemperature {
                        function_span: name_span.clone(),
                        argument,
                    });
                }
                Typing { dimension: Some(Dimension::TEMPERATURE), celsius: Celsius::Kelvin }
            }
        }
    }

    /// The dimension that all parts have; `None` if any does, or if they differ.
    fn alike(
        &mut self,
        operator: &'static str,
        span: &Range<usize>,
        parts: &[usize],
    ) -> Option<Dimension> {
        let mut first: Option<(usize, Dimension)> = None;
        let mut differ = false;
        for &part in parts {
            let Some(dimension) = self.typing(part).dimension else {
                continue;
            };
            match first {
                None => first = Some((part, dimension)),
                Some((_, known)) if known == dimension => {}
                Some((known_part, known)) => {
                    differ = true;
                    let operands = Box::new([
                        *self.operand(known_part, known),
                        *self.operand(part, dimension),
                    ]);
                    let span = span.clone();
                    let error = FormulaError::MixedDimensions { operator, span, operands };
                    self.report_dimension(error);
                }
            }
        }
        if differ { None } else { first.map(|(_, dimension)| dimension) }
    }

    /// A node that has a dimension, although a plain number is needed.
    fn not_plain(&self, index: usize) -> Option<Box<Operand>> {
        let dimension = self.typing(index).dimension.filter(|dimension| !dimension.is_none())?;
        Some(self.operand(index, dimension))
    }

    /// The dimension of a result, or an error if it has left the range of exponents.
    fn in_range(
        &mut self,
        dimension: Option<Option<Dimension>>,
        span: &Range<usize>,
    ) -> Option<Dimension> {
        if dimension == Some(None) {
            let text = excerpt(self.text, span.clone());
            self.report_dimension(FormulaError::DimensionOverflow { text, span: span.clone() });
        }
        dimension.flatten()
    }

    fn operand(&self, index: usize, dimension: Dimension) -> Box<Operand> {
        let span = self.tree.span(index);
        let text = excerpt(self.text, span.clone());
        let is_number = self.fractions.get(index).is_some_and(Option::is_some);
        Box::new(Operand { text, span, dimension, is_number })
    }

    fn typing(&self, index: usize) -> Typing {
        self.done.typings.get(index).copied().unwrap_or(Typing::ANY)
    }

    fn slice(&self, span: &Range<usize>) -> &'c str {
        self.text.get(span.clone()).unwrap_or_default()
    }

    fn has_room(&self) -> bool {
        self.done.errors.len() < MAX_ERRORS
    }

    fn report(&mut self, error: FormulaError) {
        if self.has_room() {
            self.done.errors.push(error);
        }
    }

    fn report_dimension(&mut self, error: FormulaError) {
        if self.units {
            self.report(error);
        }
    }
}

/// How a sum or the like comes from degrees Celsius. What fits every dimension is a zero and
/// changes nothing.
fn sum(x: Typing, y: Typing, joined: fn(Celsius, Celsius) -> Celsius) -> Celsius {
    match (x.dimension, y.dimension) {
        (None, _) if x.celsius == Celsius::No => y.celsius,
        (_, None) if y.celsius == Celsius::No => x.celsius,
        _ => joined(x.celsius, y.celsius),
    }
}
