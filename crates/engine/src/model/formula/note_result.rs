//! What a formula converts to the unit of its result, which converts it once more.

use std::f64::consts::TAU;

use super::function::Function;
use super::note::{FormulaNote, Walk};
use super::numbers::is_same_factor;
use super::syntax::{Node, NodeKind, Operator, Tree};
use crate::fact;
use crate::fact::Fact;
use crate::number::{Binary, Unary, elementary};
use gumption_units::{Turn, Unit};

/// A node that a value is a sum, a small multiple or a choice of.
#[derive(Clone, Copy)]
pub(super) struct SummandNode {
    pub(super) index: usize,
    /// Whether it is a factor of a product among the terms, whose factors are looked at together: a chain
    /// of factors is walked once.
    pub(super) is_factor: bool,
}

/// The terms of a value, the whole among them.
pub(super) fn terms(tree: &Tree, constants: &[Option<f64>]) -> Vec<SummandNode> {
    let constant = |index: usize| constants.get(index).copied().flatten();
    // a larger factor, or one of 2 pi, may be a conversion itself
    let is_small = |index: usize| {
        let is_small =
            constant(index).is_some_and(|x| (0.02..50.0).contains(&x.abs()) && !is_turn(x));
        is_small && !has_pi(tree, index)
    };
    let term = |index: usize| SummandNode { index, is_factor: false };
    let factor = |index: usize| SummandNode { index, is_factor: true };
    let mut found = Vec::new();
    let mut rest: Vec<SummandNode> =
        tree.nodes.len().checked_sub(1).into_iter().map(term).collect();
    while let Some(next) = rest.pop() {
        let Some(node) = tree.nodes.get(next.index) else { continue };
        found.push(next);
        match &node.kind {
            NodeKind::Negate(x) => rest.push(SummandNode { index: *x, ..next }),
            NodeKind::Infix { operator, left, right, .. } => match operator {
                Operator::Add | Operator::Subtract => rest.extend([*right, *left].map(term)),
                Operator::Multiply if is_small(*left) => rest.push(factor(*right)),
                Operator::Multiply | Operator::Divide if is_small(*right) => {
                    rest.push(factor(*left));
                }
                _ => {}
            },
            NodeKind::Call { function: Some(function), arguments, .. } => {
                rest.extend(taken_up(*function, arguments).iter().map(|index| term(*index)));
            }
            _ => {}
        }
    }
    found
}

/// Whether a factor is a turn, or one over it, but for the digits that somebody wrote.
fn is_turn(factor: f64) -> bool {
    is_same_factor(factor, TAU) || is_same_factor(factor * TAU, 1.0)
}

/// Whether pi stands in a plain number.
fn has_pi(tree: &Tree, number: usize) -> bool {
    let mut rest = vec![number];
    while let Some(index) = rest.pop() {
        match tree.nodes.get(index).map(|node| &node.kind) {
            Some(NodeKind::Pi) => return true,
            Some(NodeKind::Negate(x)) => rest.push(*x),
            Some(NodeKind::Infix { left, right, .. }) => rest.extend([*left, *right]),
            _ => {}
        }
    }
    false
}

/// The arguments that a function's value is one of, or a sum as of hypot.
pub(super) fn taken_up(function: Function, arguments: &[usize]) -> &[usize] {
    match function {
        Function::Fold(Binary::Min | Binary::Max | Binary::Hypot) | Function::One(Unary::Abs) => {
            arguments
        }
        Function::If => arguments.get(1..).unwrap_or_default(),
        _ => &[],
    }
}

impl Walk<'_, '_> {
    /// `(a - b)/b*100` that is reported in %, also as a term of a sum. `what` is what is in the unit.
    pub(super) fn of_ratio(&self, unit: &Unit, what: &Fact) -> Option<FormulaNote> {
        // a share, an angle, or a ratio of like units: mV/V; a rate in degrees per second
        let is_scaled = unit.level_exponent().is_zero() && unit.turn() != Some(Turn::Periods);
        if !is_scaled || unit.factor() == 1.0 {
            return None;
        }
        let whole = self.tree.nodes.len().checked_sub(1)?;
        let terms = terms(self.tree, &self.constants);
        let converts = |term: &SummandNode| {
            self.converts_from(term.index, unit)
                || unit.dimension().is_none() && self.converts_to(*term, unit, term.index == whole)
        };
        let term = terms.into_iter().find(converts)?;
        let index = term.index;
        let node = self.tree.nodes.get(index)?;
        // without a unit, the other terms of a sum would be wrong, and so would what is from another unit
        let may_be_plain = index == whole && !self.converts_from(index, unit);
        let or_plain = may_be_plain.then(|| fact!("or-without-unit", what = what.clone()));
        let computed = match unit.turn() {
            Some(_) if !unit.dimension().is_none() => fact!("computed.rates"),
            Some(_) => fact!("computed.angles"),
            None if unit.is_relative() => fact!("computed.shares"),
            None => fact!("computed.ratios"),
        };
        let (formula, what) = (self.quoted(&node.span), what.clone());
        let fact = fact!("result-converted-twice", formula, unit, what, computed, or_plain);
        let is_by_size = || {
            let is_inverse = |factor: f64| is_same_factor(factor * unit.factor(), 1.0);
            is_inverse(self.scaled(index).factor) || self.factors(node).into_iter().any(is_inverse)
        };
        let is_error = unit.is_relative() && (self.converts_from(index, unit) || is_by_size());
        Some(FormulaNote { is_error, ..FormulaNote::at(node, fact) })
    }

    /// Whether a product converts from the unit of its name to another one: `3600*a` of degrees that is
    /// reported in seconds of arc.
    fn converts_from(&self, index: usize, unit: &Unit) -> bool {
        let of = self.scaled(index);
        self.is_product(index)
            && of.is_bare
            && of.unit.is_some_and(|from| {
                let is_alike = from.dimension() == unit.dimension() && from.turn() == unit.turn();
                let factor = from.factor() / unit.factor();
                is_alike && !is_same_factor(factor, 1.0) && is_same_factor(of.factor, factor)
            })
    }

    /// Whether a product converts plain numbers to a unit: by one of its factors, or by all of them
    /// together.
    fn converts_to(
        &self,
        SummandNode { index, is_factor }: SummandNode,
        unit: &Unit,
        is_whole: bool,
    ) -> bool {
        let Some(node) = self.tree.nodes.get(index).filter(|_| self.is_product(index)) else {
            return false;
        };
        let is_inverse = |factor: &f64| is_same_factor(factor * unit.factor(), 1.0);
        let is_converted = is_inverse(&self.scaled(index).factor);
        if is_factor {
            return is_converted && !is_power_of_ten(1.0 / unit.factor());
        }
        let factors = self.factors(node);
        let is_once = is_converted || factors.iter().any(is_inverse);
        // a hundred may be a coefficient of a sum, and stands seldom before a ratio or a difference
        let is_meant = is_whole || !is_power_of_ten(1.0 / unit.factor()) || self.is_ratio(node);
        // a deviation of its own unit, `(a - b)/b*1e4`, is a number of some unit by any power of ten
        let is_share = unit.is_relative() && unit.factor() < 1.0;
        let is_number = |factor: &f64| *factor >= 100.0 && is_power_of_ten(*factor);
        let of_deviation = || is_share && factors.iter().any(is_number) && self.has_deviation(node);
        is_once && is_meant || of_deviation()
    }

    pub(super) fn is_product(&self, index: usize) -> bool {
        let operator = match self.node(index) {
            Some(NodeKind::Infix { operator, .. }) => *operator,
            _ => return false,
        };
        matches!(operator, Operator::Multiply | Operator::Divide) && self.constant(index).is_none()
    }

    /// The operands of a product, each with whether it is divided by.
    pub(super) fn operands(&self, node: &Node) -> Vec<(usize, bool)> {
        let mut found = Vec::new();
        let mut rest = vec![(node, false)];
        while let Some((node, is_divided)) = rest.pop() {
            let parts = match &node.kind {
                NodeKind::Infix { operator: Operator::Multiply, left, right, .. } => {
                    vec![(*right, is_divided), (*left, is_divided)]
                }
                NodeKind::Infix { operator: Operator::Divide, left, right, .. } => {
                    vec![(*right, !is_divided), (*left, is_divided)]
                }
                NodeKind::Negate(x) => vec![(*x, is_divided)],
                _ => Vec::new(),
            };
            for (part, is_divided) in parts {
                let is_product = self.is_product(part)
                    || self.constant(part).is_none()
                        && matches!(self.node(part), Some(NodeKind::Negate(_)));
                match self.tree.nodes.get(part).filter(|_| is_product) {
                    Some(inner) => rest.push((inner, is_divided)),
                    None => found.push((part, is_divided)),
                }
            }
        }
        found
    }

    /// The plain number that a product has in all, and its other operands, each with whether it is divided by.
    pub(super) fn factor_and_operands(&self, node: &Node) -> (f64, Vec<(usize, bool)>) {
        let mut factor = 1.0;
        let mut operands = self.operands(node);
        operands.retain(|(index, is_divided)| {
            let number = self.constant(*index);
            match number {
                Some(number) if *is_divided => factor /= number,
                Some(number) => factor *= number,
                None => {}
            }
            number.is_none()
        });
        (factor, operands)
    }

    /// The plain numbers that a product is multiplied by.
    fn factors(&self, node: &Node) -> Vec<f64> {
        let operands = self.operands(node).into_iter().filter(|(_, is_divided)| !is_divided);
        operands.filter_map(|(index, _)| self.constant(index)).collect()
    }

    /// Whether a product has a divisor that is no number, or a sum or a function among its factors.
    fn is_ratio(&self, node: &Node) -> bool {
        self.operands(node).into_iter().any(|(index, is_divided)| {
            let is_name = matches!(self.node(index), Some(NodeKind::Name | NodeKind::Unit(_)));
            let is_power = matches!(
                self.node(index),
                Some(NodeKind::Infix { operator: Operator::Power, .. } | NodeKind::InUnit { .. })
            );
            self.constant(index).is_none() && (is_divided || !is_name && !is_power)
        })
    }

    /// Whether `(a - b)/b` is a factor of a product.
    fn has_deviation(&self, node: &Node) -> bool {
        let operands = self.operands(node);
        let divisors = operands.iter().filter(|(_, is_divided)| *is_divided);
        let divisors: Vec<&str> = divisors.map(|(index, _)| self.slice(*index)).collect();
        operands.iter().filter(|(_, is_divided)| !is_divided).any(|(index, _)| {
            let Some(NodeKind::Infix { operator: Operator::Subtract, left, right, .. }) =
                self.node(*index)
            else {
                return false;
            };
            [*left, *right].into_iter().any(|side| divisors.contains(&self.slice(side)))
        })
    }
}

fn is_power_of_ten(number: f64) -> bool {
    let power = elementary::log10(number.abs());
    (power - power.round()).abs() < 1e-9
}
