//! Checking names, dimensions and scales through a formula.

use std::collections::HashSet;
use std::ops::Range;

use super::error::{FormulaError, Operand};
use super::evaluate::constants;
use super::fraction::{Fraction, fractions};
use super::function::{ComplexPart, Function};
use super::message::excerpt;
use super::scale::LevelPart;
use super::suggest;
use super::syntax::{NEGATION, Node, NodeKind, Operator, TableCall, Tree};
use super::tie::Tie;
use super::typing::{Scope, TableData, Typing};
use crate::number::{Binary, Unary};
use crate::regression::CurveFunction;
use gumption_units::{Dimension, Exponent, Unit, Zero};

/// The most mistakes reported of one formula.
const MAX_ERRORS: usize = 50;

/// The most defined names that a message lists.
const MAX_KNOWN: usize = 12;

/// What came out of checking a formula.
pub(super) struct Checked {
    /// What is known about each node.
    pub(super) typings: Vec<Typing>,
    /// The value of every node that depends on no name and has no unit.
    pub(super) constants: Vec<Option<f64>>,
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
        ties: Vec::with_capacity(tree.nodes.len()),
        level_parts: Vec::with_capacity(tree.nodes.len()),
        reported: HashSet::new(),
        done: Checked {
            typings: Vec::with_capacity(tree.nodes.len()),
            constants: constants(tree),
            errors: Vec::new(),
        },
    };
    for (index, node) in tree.nodes.iter().enumerate() {
        let (typing, tie) = checker.node(index, node);
        let (tie, typing) = tie.reduced(typing);
        checker.done.typings.push(typing);
        checker.ties.push(tie);
        let part = checker.level_part(index, node);
        checker.level_parts.push(part);
    }
    if let Some(last) = tree.nodes.len().checked_sub(1) {
        let typing = checker.settled(last);
        let typing = checker.with_ratio(last, typing);
        if let Some(whole) = checker.done.typings.last_mut() {
            *whole = typing;
        }
    }
    checker.done
}

pub(super) struct Checker<'c> {
    pub(super) text: &'c str,
    pub(super) tree: &'c Tree,
    scope: &'c Scope,
    units: bool,
    fractions: Vec<Option<Fraction>>,
    /// How every node hangs on a zero.
    pub(super) ties: Vec<Tie>,
    /// What every node is in the making of a level.
    pub(super) level_parts: Vec<LevelPart>,
    /// Unknown names and functions that have been reported, the latter with a parenthesis.
    reported: HashSet<&'c str>,
    done: Checked,
}

impl<'c> Checker<'c> {
    fn node(&mut self, index: usize, node: &Node) -> (Typing, Tie) {
        let free = |typing: Typing| (typing, Tie::of(typing));
        match &node.kind {
            NodeKind::Number(0.0) => free(Typing::ANY),
            NodeKind::Number(_) | NodeKind::Pi => free(Typing::NUMBER),
            NodeKind::Name => free(self.name(&node.span)),
            NodeKind::Unit(unit) => {
                // one such unit is the size of a degree, not a temperature
                let celsius_exponent = unit.celsius_exponent();
                let typing = Typing { zero: None, celsius_exponent, ..Typing::in_unit(unit) };
                (typing, Tie::None)
            }
            NodeKind::Constant(constant) => free(Typing::of(constant.dimension())),
            NodeKind::InUnit { number, unit } => {
                self.refuse_unit_of_level(index, *number, unit);
                free(self.in_unit(*number, unit, &node.span))
            }
            NodeKind::Negate(x) => (self.typing(*x), self.tie(*x).times(-1.0)),
            NodeKind::Infix { operator, operator_span, left, right } => {
                self.infix(*operator, operator_span, (index, &node.span), [*left, *right])
            }
            NodeKind::Joined { joint, span, left, right } => {
                self.truths(joint.name(), span, &[*left, *right]);
                free(Typing::NUMBER)
            }
            NodeKind::Not { span, of } => {
                self.truths(NEGATION, span, &[*of]);
                free(Typing::NUMBER)
            }
            NodeKind::Table { x, call } => free(self.table(*x, call)),
            NodeKind::Solve { body, unknown, from, to } => {
                free(self.solve(&node.span, body, unknown, [*from, *to]))
            }
            NodeKind::Curve { curve, inverse, argument } => {
                free(self.curve(curve, *inverse, *argument))
            }
            NodeKind::Call { function: None, name_span, .. } => {
                self.no_function(name_span);
                free(Typing::ANY)
            }
            NodeKind::Call { function: Some(function), name_span, arguments } => {
                if function.arity().admits(arguments.len()) {
                    free(self.call(*function, name_span, &node.span, arguments))
                } else {
                    self.argument_count(*function, name_span, arguments);
                    free(Typing::ANY)
                }
            }
        }
    }

    /// A number of units.
    fn in_unit(&mut self, number: usize, unit: &Unit, span: &Range<usize>) -> Typing {
        let typing = self.typing(number);
        let given = self.operand(number, typing.dimension.unwrap_or_default());
        if typing.dimension.is_some_and(|dimension| !dimension.is_none()) || !typing.level.is_zero()
        {
            self.report_dimension(FormulaError::NumberWithUnit {
                number: given,
                unit: unit.text().to_owned(),
                span: span.clone(),
            });
            return Typing::ANY;
        }
        Typing::in_unit(unit)
    }

    /// Checks numbers that stand for truths.
    fn truths(&mut self, name: &'static str, span: &Range<usize>, parts: &[usize]) {
        for &part in parts {
            let typing = self.plain_argument(name, part);
            if let Some(argument) = self.not_plain(part).filter(|_| typing.is_some()) {
                let function_span = span.clone();
                let error =
                    FormulaError::ArgumentNotPlain { function: name, function_span, argument };
                self.report_dimension(error);
            }
        }
    }

    fn table(&mut self, x: usize, call: &TableCall) -> Typing {
        let scope = self.scope;
        let typing = self.settled(x);
        let Some(data) = scope.table(call) else {
            let (file, span) = (call.file.clone(), call.span.clone());
            self.report(FormulaError::TableOutOfPlace { file, span });
            return Typing::ANY;
        };
        let Some(TableData { units: [unit, of_values], .. }) = data else { return Typing::ANY };
        let column = call.columns.as_ref().map_or("the first column", |[x, _]| x);
        if let Some(dimension) = typing.dimension.filter(|found| *found != unit.dimension()) {
            let argument = self.operand(x, dimension);
            let expected = format!(
                "`{column}` of `{}` is {}",
                call.file,
                match unit.text() {
                    "" => "a column of plain numbers; write its unit into the header, such as \
                           `t [degC]`, or divide by one"
                        .to_owned(),
                    _ => unit.describe(),
                }
            );
            self.report_dimension(FormulaError::TableArgument { argument, expected });
        } else if let Err(misfit) = typing.given_in(unit) {
            let argument = self.operand(x, unit.dimension());
            let expected = format!("`{column}` of `{}` is in {unit}: it {misfit}", call.file);
            self.report_dimension(FormulaError::TableArgument { argument, expected });
        }
        Typing::in_unit(of_values)
    }

    /// An equation to solve: what the unknown is comes from the range.
    fn solve(
        &mut self,
        span: &Range<usize>,
        body: &Tree,
        unknown: &Range<usize>,
        ends: [usize; 2],
    ) -> Typing {
        let dimension = self.alike("solve", span, &ends);
        let typing = Typing { dimension, ..self.together("solve", span, &ends) };
        let name = self.slice(unknown);
        // not one that is only announced: `t = solve(..., t, ...)` is how people write it
        if self.scope.get(name).is_some() {
            let (name, span) = (name.to_owned(), unknown.clone());
            self.report(FormulaError::UnknownIsDefined { name, span });
            return typing;
        }
        let is_unknown = |node: &Node| {
            node.kind == NodeKind::Name && self.text.get(node.span.clone()) == Some(name)
        };
        if !body.nodes.iter().any(is_unknown) && !body.has_solve() {
            let (name, span) = (name.to_owned(), unknown.clone());
            self.report(FormulaError::UnknownNotUsed { name, span });
        }
        let mut scope = self.scope.clone();
        scope.define(name, typing);
        let inner = check(self.text, body, &scope, self.units);
        inner.errors.into_iter().for_each(|error| self.report(error));
        typing
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

    /// A calibration function: its argument has to be a quantity of that side.
    fn curve(&mut self, curve: &CurveFunction, inverse: bool, argument: usize) -> Typing {
        let (from, to) = if inverse { (&curve.y, &curve.x) } else { (&curve.x, &curve.y) };
        let side = if inverse { "y" } else { "x" };
        let typing = self.settled(argument);
        let span = self.tree.span(argument);
        let expected = Typing::in_unit(from);
        if let Some(dimension) = typing.dimension
            && Some(dimension) != expected.dimension
        {
            let operand = self.operand(argument, dimension);
            let reason = format!(
                "{operand}, but {side} of `{}` is {} (in {from})",
                curve.fit.name,
                from.describe()
            );
            self.report_dimension(FormulaError::Curve { reason, span });
        } else if let Err(misfit) = typing.given_in(from) {
            let text = self.quoted(argument);
            let reason =
                format!("`{text}` cannot be {side} of `{}` in {from}: {misfit}", curve.fit.name);
            self.report_dimension(FormulaError::Curve { reason, span });
        }
        Typing::in_unit(to)
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
        (index, span): (usize, &Range<usize>),
        [left, right]: [usize; 2],
    ) -> (Typing, Tie) {
        let (x, y) = (self.typing(left), self.typing(right));
        match operator {
            Operator::Add | Operator::Subtract => {
                let dimension = self.alike(operator.name(), operator_span, &[left, right]);
                let sign = if operator == Operator::Add { 1.0 } else { -1.0 };
                let (typing, tie) = self.sum(sign, operator_span, [left, right]);
                (Typing { dimension, ..typing }, tie)
            }
            Operator::Multiply => {
                let product = x.dimension.zip(y.dimension).map(|(a, b)| a.checked_mul(b));
                let dimension = self.in_range(product, span);
                self.product(index, dimension, [left, right])
            }
            Operator::Divide => {
                let quotient = x.dimension.zip(y.dimension).map(|(a, b)| a.checked_div(b));
                let dimension = self.in_range(quotient, span);
                self.quotient(index, dimension, [left, right])
            }
            Operator::Power => self.power(index, span, [left, right]),
            _ => {
                self.alike(operator.name(), operator_span, &[left, right]);
                self.together(operator.name(), operator_span, &[left, right]);
                (Typing::NUMBER, Tie::None)
            }
        }
    }

    fn power(
        &mut self,
        index: usize,
        span: &Range<usize>,
        [base, exponent]: [usize; 2],
    ) -> (Typing, Tie) {
        let (base_typing, exponent_typing) = (self.typing(base), self.typing(exponent));
        if let Some(operand) = self.not_plain(exponent) {
            self.report_dimension(FormulaError::ExponentNotPlain { exponent: operand });
            return (Typing::ANY, Tie::None);
        }
        if !exponent_typing.level.is_zero() {
            self.check_level_as_exponent(base, exponent);
            return (self.number_of_level(exponent), Tie::None);
        }
        let constant = self.fractions.get(exponent).copied().flatten();
        if constant.and_then(Fraction::exponent) == Some(Exponent::ZERO) {
            return (Typing::NUMBER, Tie::None);
        }
        if base_typing.level.is_zero() {
            match base_typing.dimension {
                None => return (Typing::ANY, Tie::None),
                Some(Dimension::NONE) => return (Typing::NUMBER, Tie::None),
                Some(_) => {}
            }
        }
        let Some(dimension) = base_typing.dimension else { return (Typing::ANY, Tie::None) };
        let Some(constant) = constant else {
            let base = self.operand(base, dimension);
            let exponent_span = self.tree.span(exponent);
            self.report_dimension(FormulaError::ExponentNotConstant {
                base,
                exponent: excerpt(self.text, exponent_span.clone()),
                span: exponent_span,
            });
            return (Typing::ANY, Tie::None);
        };
        let power = constant.exponent().and_then(|exponent| dimension.checked_pow(exponent));
        let dimension = self.in_range(Some(power), span);
        match constant.exponent() {
            Some(Exponent::ONE) => (base_typing, self.tie(base)),
            Some(exponent) => self.raised(index, dimension, base, exponent),
            None => (Typing { dimension, ..Typing::ANY }, Tie::None),
        }
    }

    fn call(
        &mut self,
        function: Function,
        name_span: &Range<usize>,
        span: &Range<usize>,
        arguments: &[usize],
    ) -> Typing {
        let first = arguments.first().copied().unwrap_or_default();
        let name = function.name();
        match function {
            Function::One(Unary::Negate | Unary::Abs) => self.without_zero(name, first),
            Function::One(operation @ (Unary::Sqrt | Unary::Cbrt)) => {
                let degree = if operation == Unary::Sqrt { 2 } else { 3 };
                let typing = self.without_zero(name, first);
                let root = typing.dimension.map(|dimension| dimension.checked_root(degree));
                let dimension = self.in_range(root, span);
                let power = Exponent::new(1, degree).unwrap_or(Exponent::ONE);
                self.rooted(dimension, typing, power)
            }
            Function::One(_) => {
                let typing = self.plain_argument(name, first);
                if let Some(argument) = self.not_plain(first).filter(|_| typing.is_some()) {
                    self.report_dimension(FormulaError::ArgumentNotPlain {
                        function: name,
                        function_span: name_span.clone(),
                        argument,
                    });
                }
                Typing::NUMBER
            }
            Function::Two(Binary::Atan2) => {
                self.alike(name, name_span, arguments);
                self.all_without_zero(name, name_span, arguments);
                Typing::NUMBER
            }
            Function::Fold(Binary::Hypot) => {
                let dimension = self.alike(name, name_span, arguments);
                let typing = self.all_without_zero(name, name_span, arguments);
                Typing { dimension, ..typing }
            }
            Function::Two(_) | Function::Fold(_) => {
                let dimension = self.alike(name, name_span, arguments);
                let typing = self.together(name, name_span, arguments);
                Typing { dimension, ..typing }
            }
            Function::If => {
                self.truths(name, name_span, &[first]);
                let branches = arguments.get(1..).unwrap_or_default();
                let dimension = self.alike(name, name_span, branches);
                let typing = self.together(name, name_span, branches);
                Typing { dimension, ..typing }
            }
            // the parser reads them as sums, and as nodes of their own
            Function::Sum | Function::Mean | Function::Table | Function::Solve => Typing::ANY,
            Function::Part(ComplexPart::Argument) => {
                self.without_zero(name, first);
                Typing::NUMBER
            }
            Function::Part(_) => self.without_zero(name, first),
            Function::Kelvin | Function::Celsius => {
                self.temperature(name, name_span, first);
                self.scaled_temperature(function)
            }
        }
    }

    /// Checks that an argument is a temperature and no difference of two.
    fn temperature(&mut self, function: &'static str, span: &Range<usize>, argument: usize) {
        let typing = self.settled(argument);
        if !typing.fits(Dimension::TEMPERATURE)
            && let Some(dimension) = typing.dimension
        {
            let argument = self.operand(argument, dimension);
            self.report_dimension(FormulaError::NotATemperature {
                function,
                function_span: span.clone(),
                argument,
            });
        } else {
            self.refuse_difference(function, argument, typing);
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
        let celsius = matches!(self.tie(index), Tie::Sum { zero: Zero::Celsius, .. });
        let is_celsius = celsius || self.typing(index).is_celsius();
        let unit = self.given_unit(index).filter(|unit| unit.dimension() == dimension);
        let unit = unit.map(|unit| unit.text().to_owned());
        Box::new(Operand { text, span, dimension, is_number, is_celsius, unit })
    }

    /// The unit of the quantity that a part of the formula is a multiple or a sum of.
    fn given_unit(&self, mut index: usize) -> Option<&'c Unit> {
        let is_number = |index: usize| self.fractions.get(index).is_some_and(Option::is_some);
        loop {
            index = match &self.tree.nodes.get(index)?.kind {
                NodeKind::Name => return self.scope.given(self.slice(&self.tree.span(index))),
                NodeKind::Negate(x) => *x,
                NodeKind::Infix { operator: Operator::Multiply, left, right, .. }
                    if is_number(*left) =>
                {
                    *right
                }
                NodeKind::Infix { operator, left, right, .. } => match operator {
                    Operator::Add | Operator::Subtract => *left,
                    Operator::Multiply | Operator::Divide if is_number(*right) => *left,
                    _ => return None,
                },
                _ => return None,
            };
        }
    }

    pub(super) fn typing(&self, index: usize) -> Typing {
        self.done.typings.get(index).copied().unwrap_or(Typing::ANY)
    }

    pub(super) fn tie(&self, index: usize) -> Tie {
        self.ties.get(index).copied().unwrap_or(Tie::None)
    }

    /// The text of a node for a message.
    pub(super) fn quoted(&self, index: usize) -> String {
        excerpt(self.text, self.tree.span(index))
    }

    /// The value of a node that is a plain number written out.
    pub(super) fn constant(&self, index: usize) -> Option<f64> {
        self.done.constants.get(index).copied().flatten()
    }

    /// Whether a node is a rational number written out.
    pub(super) fn is_rational(&self, index: usize) -> bool {
        self.fractions.get(index).is_some_and(Option::is_some)
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

    pub(super) fn report_dimension(&mut self, error: FormulaError) {
        if self.units {
            self.report(error);
        }
    }
}
