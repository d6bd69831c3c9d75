//! What is right by the rules of formulas and seldom meant.

use std::ops::Range;

use super::evaluate::constants;
use super::function::{ComplexPart, Function};
use super::message::excerpt;
use super::note_product::{Factors, factors};
use super::note_result::taken_up;
use super::numbers::{Numbers, Scaled, Use, ValueSource};
use super::syntax::{Node, NodeKind, Operator, Tree};
use crate::fact;
use crate::fact::Fact;
use crate::number::{Binary, Unary};
use gumption_units::{Dimension, Unit};

/// The code of shares that a product converts once more.
pub(super) const SHARE_TWICE: &str = "share-converted-twice";

/// The code of angles that a product converts once more.
pub(super) const ANGLE_TWICE: &str = "angle-converted-twice";

/// The code of rates that a product converts once more.
pub(super) const RATE_TWICE: &str = "rate-converted-twice";

/// The code of results that a formula converts to their unit.
pub(super) const RESULT_TWICE: &str = "result-converted-twice";

/// A note on a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FormulaNote {
    /// What was found.
    pub fact: Fact,
    /// Where in the formula, a half-open range of bytes.
    pub span: Range<usize>,
    /// Whether no meaning of the formula gives the result: a share that is converted to its unit twice.
    pub is_error: bool,
}

impl FormulaNote {
    /// What was found of a node.
    pub(super) fn at(node: &Node, fact: Fact) -> Self {
        Self { fact, span: node.span.clone(), is_error: false }
    }

    /// A short name of what it is about.
    pub fn code(&self) -> &'static str {
        self.fact.code()
    }
}

/// The notes on a formula. `numbers_of` gives what the numbers of a name, a column or a coordinate are in,
/// which formulas compute with in coherent SI; `None` if they are not, or if it is not known. `factors_of`
/// gives the factors of equations.
pub(super) fn notes<'u>(
    text: &str,
    tree: &Tree,
    numbers_of: impl Fn(ValueSource<'_>) -> Option<Numbers<'u>>,
    factors_of: impl Fn(&str) -> Option<Factors>,
    of: Use<'u>,
) -> (Vec<FormulaNote>, Option<Factors>) {
    let walk = Walk::new(text, tree, &numbers_of, of);
    let mut found: Vec<FormulaNote> =
        tree.nodes.iter().flat_map(|node| walk.of_node(node)).collect();
    found.extend(tree.nodes.iter().filter_map(|node| walk.unstated_beside(node)));
    found.extend(walk.unstated_result());
    found.extend(walk.conversions());
    found.extend(tree.nodes.iter().filter_map(|node| walk.of_logarithm(node)));
    let result = match of {
        Use::Output(unit) => Some((unit, fact!("result.output"))),
        Use::Estimate(unit) => Some((unit, fact!("result.quantity"))),
        Use::Quantity | Use::Width => None,
    };
    let result = result.as_ref().map(|(unit, what)| (*unit, what));
    let twice = result.and_then(|(unit, what)| walk.of_ratio(unit, what));
    if let Some(twice) = twice {
        // the factor of `c*100/p` that is reported in % may be meant for either
        found.retain(|note| !(note.code() == SHARE_TWICE && note.span == twice.span));
        found.push(twice);
    }
    let all = factors(&walk, &numbers_of, factors_of);
    let whole = walk.of_products(&all, result, &mut found);
    (found, whole)
}

/// A formula, and what the numbers of its nodes are in.
pub(super) struct Walk<'t, 'u> {
    pub(super) text: &'t str,
    pub(super) tree: &'t Tree,
    pub(super) constants: Vec<Option<f64>>,
    pub(super) of: Use<'u>,
    scaled: Vec<Scaled<'u>>,
    written: Vec<Option<f64>>,
}

impl<'t, 'u> Walk<'t, 'u> {
    pub(super) fn new(
        text: &'t str,
        tree: &'t Tree,
        numbers_of: impl Fn(ValueSource<'_>) -> Option<Numbers<'u>>,
        of: Use<'u>,
    ) -> Self {
        let scaled = Vec::with_capacity(tree.nodes.len());
        let written = Vec::with_capacity(tree.nodes.len());
        let mut walk = Self { text, tree, constants: constants(tree), of, scaled, written };
        for (index, node) in tree.nodes.iter().enumerate() {
            let found = match walk.constant(index) {
                Some(factor) => Scaled { factor, ..Scaled::UNKNOWN },
                None => walk.computed(node, &numbers_of),
            };
            walk.scaled.push(found);
            let written = walk.constant(index).or_else(|| walk.chosen(node));
            walk.written.push(written);
        }
        walk
    }

    /// The largest of the plain numbers that a node chooses from.
    fn chosen(&self, node: &Node) -> Option<f64> {
        let parts = match &node.kind {
            NodeKind::Negate(x) => std::slice::from_ref(x),
            NodeKind::Call { function: Some(function @ Function::If), arguments, .. } => {
                taken_up(*function, arguments)
            }
            _ => return None,
        };
        let numbers: Option<Vec<f64>> = parts.iter().map(|part| self.written(*part)).collect();
        numbers?.into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// The plain number that a node is, or the largest of those that it chooses from.
    pub(super) fn written(&self, index: usize) -> Option<f64> {
        self.written.get(index).copied().flatten()
    }

    pub(super) fn constant(&self, index: usize) -> Option<f64> {
        self.constants.get(index).copied().flatten()
    }

    pub(super) fn node(&self, index: usize) -> Option<&'t NodeKind> {
        self.tree.nodes.get(index).map(|node| &node.kind)
    }

    /// What the numbers of a node are in.
    pub(super) fn scaled(&self, index: usize) -> Scaled<'u> {
        self.scaled.get(index).copied().unwrap_or(Scaled::UNKNOWN)
    }

    /// What the numbers of the whole formula are in.
    pub(super) fn whole(&self) -> Option<Scaled<'u>> {
        self.scaled.last().copied()
    }

    pub(super) fn quoted(&self, span: &Range<usize>) -> String {
        excerpt(self.text, span.clone())
    }

    /// The text of a node as it is written.
    pub(super) fn slice(&self, index: usize) -> &'t str {
        self.text.get(self.tree.span(index)).unwrap_or_default()
    }

    /// Whether a number is written with pi, as of angles in radians.
    pub(super) fn has_pi(&self, index: usize) -> bool {
        let text = self.slice(index);
        text.contains("pi") || text.contains('π')
    }

    /// Whether a number beside what is in a unit is 1, as the whole beside a share of it, or as the
    /// first term of an expansion.
    pub(super) fn is_whole(number: f64, unit: Option<&Unit>, is_first: bool) -> bool {
        number.abs() == 1.0 && (is_first || unit.is_some_and(Unit::is_relative))
    }

    /// What converts from a name's unit to coherent ones, which formulas have already: pi/180, 1/100,
    /// 2 pi.
    fn conversions(&self) -> Vec<FormulaNote> {
        let products = self.products();
        // of a width, `0.01*p` is a hundredth of p; `0.1 [V]*p/100` is none
        let is_share = |node: &Node, of: Scaled<'_>| {
            let is_divided =
                matches!(node.kind, NodeKind::Infix { operator: Operator::Divide, .. });
            let is_relative = of.unit.is_some_and(|unit| unit.turn().is_none());
            self.of == Use::Width && is_relative && (of.is_bare || !is_divided)
        };
        let mut found = Vec::new();
        // where `2*pi*n` of `2*pi*n/60` is told, of a node that may be the whole conversion
        let mut turned: Vec<Option<usize>> = Vec::with_capacity(self.tree.nodes.len());
        for (index, (node, product)) in self.tree.nodes.iter().zip(products).enumerate() {
            let operands = match &node.kind {
                NodeKind::Infix { left, right, .. } => vec![*left, *right],
                NodeKind::InUnit { number, .. } => vec![*number],
                _ => Vec::new(),
            };
            let of = self.scaled(index);
            let Some(unit) = of.unit.filter(|_| of.converts() && !operands.is_empty()) else {
                turned.push(None);
                continue;
            };
            // one note for a chain of factors
            let is_told = operands.iter().any(|&operand| self.scaled(operand).converts());
            let of_part = || operands.iter().find_map(|&operand| *turned.get(operand)?);
            let is_area = || of.has_turn() && self.is_of_area(of, product);
            let at = match of_part() {
                Some(at) => Some(at),
                None if !is_told && !is_share(node, of) && !is_area() => {
                    found.push(self.converted_twice(node, unit));
                    Some(found.len() - 1)
                }
                None => None,
            };
            if is_told
                && !of.has_turn()
                && let Some(note) = at.and_then(|at| found.get_mut(at))
            {
                *note = self.converted_twice(node, unit);
            }
            turned.push(at.filter(|_| of.has_turn()));
        }
        found
    }

    /// Of every node the whole product that it is a factor of, and whether it is divided by there.
    fn products(&self) -> Vec<(usize, bool)> {
        let mut found: Vec<_> = (0..self.tree.nodes.len()).map(|index| (index, false)).collect();
        for (index, node) in self.tree.nodes.iter().enumerate().rev() {
            let NodeKind::Infix {
                operator: operator @ (Operator::Multiply | Operator::Divide),
                left,
                right,
                ..
            } = &node.kind
            else {
                continue;
            };
            let Some((top, is_divided)) = found.get(index).copied() else { continue };
            let is_divisor = is_divided != (*operator == Operator::Divide);
            for (operand, is_divided) in [(*left, is_divided), (*right, is_divisor)] {
                if let Some(found) = found.get_mut(operand) {
                    *found = (top, is_divided);
                }
            }
        }
        found
    }

    /// Whether the product that a factor is part of has two or more lengths where the factor has 2 pi:
    /// those of `2*pi*R^3*L*n` are the area of a cylinder.
    fn is_of_area(&self, factor: Scaled<'u>, (product, is_divided): (usize, bool)) -> bool {
        let lengths = self.scaled(product).lengths;
        if factor.is_divisor != is_divided { lengths <= -2.0 } else { lengths >= 2.0 }
    }

    /// `phi*pi/180` of an angle in degrees, `p/100` and `c*100/p` of per cent.
    fn converted_twice(&self, node: &Node, unit: &Unit) -> FormulaNote {
        let formula = self.quoted(&node.span);
        let fact = if unit.turn().is_none() {
            fact!("share-converted-twice", formula, unit)
        } else if !unit.dimension().is_none() {
            fact!("rate-converted-twice", formula, unit)
        } else {
            fact!("angle-converted-twice", formula, unit)
        };
        FormulaNote::at(node, fact)
    }

    /// What the numbers of a node are in, of those before it.
    fn computed(
        &self,
        node: &Node,
        numbers_of: &impl Fn(ValueSource<'_>) -> Option<Numbers<'u>>,
    ) -> Scaled<'u> {
        let taken_from = |source: Option<ValueSource<'_>>| {
            source.and_then(numbers_of).map_or(Scaled::UNKNOWN, Scaled::of)
        };
        match &node.kind {
            NodeKind::Name => {
                let name = self.text.get(node.span.clone());
                taken_from(name.map(ValueSource::Name))
            }
            NodeKind::Table { call, .. } => taken_from(Some(ValueSource::TableValue(call))),
            NodeKind::Curve { curve, inverse: false, .. } => {
                taken_from(Some(ValueSource::CurveY(curve)))
            }
            NodeKind::Curve { curve, inverse: true, .. } => {
                taken_from(Some(ValueSource::CurveX(curve)))
            }
            NodeKind::Negate(x) => self.scaled(*x),
            NodeKind::Unit(unit) => Scaled { factor: plain_factor(unit), ..Scaled::UNKNOWN },
            // a quantity of its own is no factor
            NodeKind::InUnit { unit, .. } if unit.dimension() == Dimension::LENGTH => {
                Scaled::of(Numbers::Length)
            }
            NodeKind::InUnit { unit, .. } if !unit.dimension().is_none() => Scaled::UNKNOWN,
            NodeKind::InUnit { number, unit } => {
                let number = self.scaled(*number);
                Scaled { factor: number.factor * plain_factor(unit), ..number }
            }
            NodeKind::Infix { operator, left, right, .. } => {
                self.of_operands(*operator, *left, *right)
            }
            NodeKind::Call { function: Some(function), arguments, .. } => {
                self.of_call(*function, arguments)
            }
            _ => Scaled::UNKNOWN,
        }
    }

    fn of_operands(&self, operator: Operator, left: usize, right: usize) -> Scaled<'u> {
        let (x, y) = (self.scaled(left), self.scaled(right));
        let is_number = |index: usize| self.constant(index).is_some();
        let is_multiple = |of: &Scaled<'u>, by: usize| of.is_alone_or_unstated() && is_number(by);
        match operator {
            Operator::Add | Operator::Subtract => self.of_sum(operator, [left, right]),
            Operator::Multiply => x.times(y, is_multiple(&x, right) || is_multiple(&y, left)),
            Operator::Divide => x.times(y.inverse(), is_multiple(&x, right)),
            Operator::Power => {
                let power = self.constant(right);
                let square = x.bare_unit().filter(|_| power == Some(2.0)).map(|unit| (left, unit));
                let lengths = power.map_or(0.0, |power| x.lengths * power);
                Scaled { square, lengths, ..Scaled::UNKNOWN }
            }
            _ => Scaled::UNKNOWN,
        }
    }

    fn of_sum(&self, operator: Operator, [left, right]: [usize; 2]) -> Scaled<'u> {
        let sides = [left, right].map(|side| self.scaled(side));
        // `1 + p` is no share, but the whole with one
        let is_whole = |number: usize, other: &Scaled<'u>| {
            let number_is = |value| Self::is_whole(value, other.unit, number == left);
            other.is_alone() && self.constant(number).is_some_and(number_is)
        };
        let [x, y] = &sides;
        if is_whole(left, y) || is_whole(right, x) {
            return Scaled::UNKNOWN;
        }
        let square = sides.iter().find_map(|side| side.square);
        let square = square.filter(|_| operator == Operator::Add);
        let is_length = sides.iter().all(|side| side.lengths == 1.0);
        let lengths = if is_length { 1.0 } else { 0.0 };
        let is_unstated = sides.iter().all(|side| side.is_unstated);
        let sum = sides.into_iter().find(Scaled::is_alone);
        sum.unwrap_or(Scaled { square, lengths, is_unstated, ..Scaled::UNKNOWN })
    }

    fn of_call(&self, function: Function, arguments: &[usize]) -> Scaled<'u> {
        let alike = match function {
            Function::One(Unary::Asin | Unary::Acos | Unary::Atan)
            | Function::Two(Binary::Atan2)
            | Function::Part(ComplexPart::Argument) => return Scaled::RADIANS,
            Function::One(Unary::Abs) | Function::Fold(_) => arguments,
            Function::Two(Binary::Modulo) => arguments.get(..1).unwrap_or_default(),
            Function::If => arguments.get(1..).unwrap_or_default(),
            _ => &[],
        };
        let alike: Vec<_> = alike.iter().map(|argument| self.scaled(*argument)).collect();
        let is_unstated = !alike.is_empty() && alike.iter().all(|part| part.is_unstated);
        let found = alike.into_iter().find(Scaled::is_alone);
        found.unwrap_or(Scaled { is_unstated, ..Scaled::UNKNOWN })
    }
}

/// What a unit without a dimension is as a plain number.
fn plain_factor(unit: &Unit) -> f64 {
    if unit.dimension().is_none() { unit.factor() } else { 1.0 }
}
