//! Angular frequencies that are reported in hertz, `sqrt(k/m)`, and torques times revolutions in a time:
//! both lack 2 pi, and the units of neither show it.

use super::dimension::check;
use super::function::Function;
use super::note::{FormulaNote, Walk};
use super::note_result::terms;
use super::numbers::{Use, is_same_factor};
use super::syntax::{Node, NodeKind, Operator, Tree};
use super::typing::{RATE, Scope, Typing};
use crate::fact;
use crate::number::Unary;
use gumption_units::{Dimension, Exponent, Turn, Unit};

const ACCELERATION: Dimension = Dimension::of([0, 1, -2, 0, 0, 0, 0]);
const TORQUE: Dimension = Dimension::of([1, 2, -2, 0, 0, 0, 0]);
const RESISTANCE: Dimension = Dimension::of([1, 2, -3, -2, 0, 0, 0]);
const CAPACITANCE: Dimension = Dimension::of([-1, -2, 4, 2, 0, 0, 0]);
const INDUCTANCE: Dimension = Dimension::of([1, 2, -2, -2, 0, 0, 0]);

/// A term of a value in Hz that is an angular frequency by what it is made of: a root of a stiffness by a
/// mass, of an inductance times a capacitance, of the acceleration of free fall by a length, or the inverse
/// of a time constant.
pub(super) fn angular(text: &str, tree: &Tree, scope: &Scope) -> Option<FormulaNote> {
    let walk = Walk::new(text, tree, |_| None, Use::Quantity);
    let typings = check(text, tree, scope, true).typings;
    let typed = Typed { walk: &walk, typings: &typings };
    let terms = terms(tree, &walk.constants).into_iter().filter(|term| !term.is_factor);
    let index = terms.map(|term| term.index).find(|index| typed.is_angular(*index))?;
    let span = tree.span(index);
    let formula = walk.quoted(&span);
    Some(FormulaNote { fact: fact!("radians-as-periods", formula), span, is_error: false })
}

/// A torque in N m times what is in 1/min or Hz. `unit_of` gives the units of names that are given in one.
pub(super) fn torque<'u>(
    text: &str,
    tree: &Tree,
    unit_of: impl Fn(&str) -> Option<&'u Unit>,
) -> Option<FormulaNote> {
    let walk = Walk::new(text, tree, |_| None, Use::Quantity);
    let terms = terms(tree, &walk.constants).into_iter().filter(|term| !term.is_factor);
    let products = terms.filter(|term| walk.is_product(term.index));
    let node = products.filter_map(|term| tree.nodes.get(term.index)).find(|node| {
        let (factor, operands) = walk.factor_and_operands(node);
        let (mut torques, mut rates) = (0, 0);
        for (index, is_divided) in operands {
            match (walk.node(index), unit_of(walk.slice(index))) {
                (Some(NodeKind::Name), Some(unit)) if is_torque(unit) && !is_divided => {
                    torques += 1
                }
                (Some(NodeKind::Name), Some(unit)) if is_bare_rate(unit) && !is_divided => {
                    rates += 1
                }
                // an efficiency
                (Some(NodeKind::Name), Some(unit)) if unit.dimension().is_none() => {}
                _ => return false,
            }
        }
        torques == 1 && rates == 1 && is_same_factor(factor, 1.0)
    })?;
    let formula = walk.quoted(&node.span);
    Some(FormulaNote::at(node, fact!("periods-as-radians.torque", formula)))
}

/// Whether a unit is that of a torque and not of an energy: `N m`, `kN*m`.
fn is_torque(unit: &Unit) -> bool {
    let mut factors = unit.factors().iter();
    unit.dimension() == TORQUE && factors.any(|factor| factor.base.to_string().ends_with('N'))
}

/// Whether a unit is that of periods, or of a rate of what it does not say. In 1/s it may be an angular
/// frequency.
fn is_bare_rate(unit: &Unit) -> bool {
    let is_of_periods = unit.turn() == Some(Turn::Periods);
    unit.dimension() == RATE && !unit.counts_angle() && (is_of_periods || unit.factor() != 1.0)
}

/// The nodes of a formula with what is known of each.
struct Typed<'w> {
    walk: &'w Walk<'w, 'w>,
    typings: &'w [Typing],
}

impl Typed<'_> {
    fn dimension(&self, index: usize) -> Option<Dimension> {
        self.typings.get(index)?.dimension
    }

    /// Whether a value without a factor of its own is an angular frequency.
    fn is_angular(&self, index: usize) -> bool {
        let counts = self.typings.get(index).is_some_and(|typing| typing.turn.is_none());
        if !counts || self.dimension(index) != Some(RATE) {
            return false;
        }
        if let Some(radicand) = self.radicand(index) {
            return self.is_of_oscillator(radicand);
        }
        let Some(node) = self.walk.tree.nodes.get(index) else { return false };
        let (factor, operands) = self.walk.factor_and_operands(node);
        is_same_factor(factor, 1.0)
            && (self.is_of_roots(&operands) || self.is_of_time_constant(node, &operands))
    }

    /// Whether a product is one of roots, of which some make an oscillator: `1/sqrt(L*C)`,
    /// `sqrt(k)/sqrt(m)`, `sqrt(k/m)*sqrt(1 - z^2)`.
    fn is_of_roots(&self, operands: &[(usize, bool)]) -> bool {
        let radicands = operands.iter().map(|(index, _)| self.radicand(*index));
        let radicands: Option<Vec<_>> = radicands.collect();
        radicands.is_some_and(|of| of.into_iter().any(|index| self.is_of_oscillator(index)))
    }

    /// Whether a product is `1/(R*C)` or `R/L`.
    fn is_of_time_constant(&self, node: &Node, operands: &[(usize, bool)]) -> bool {
        let mut dimensions: Vec<_> = operands
            .iter()
            .filter_map(|(index, is_divided)| Some((self.dimension(*index)?, *is_divided)))
            .collect();
        let is_one = |of: Dimension, divided: bool| {
            move |(dimension, is_divided): &(Dimension, bool)| {
                (*dimension, *is_divided) == (of, divided)
            }
        };
        dimensions.retain(|(dimension, _)| !dimension.is_none());
        let has = |of, divided| dimensions.iter().any(is_one(of, divided));
        matches!(node.kind, NodeKind::Infix { .. })
            && dimensions.len() == 2
            && operands.len() == 2
            && (has(RESISTANCE, true) && has(CAPACITANCE, true)
                || has(RESISTANCE, false) && has(INDUCTANCE, true))
    }

    /// The argument of a square root.
    fn radicand(&self, index: usize) -> Option<usize> {
        match self.walk.node(index)? {
            NodeKind::Call { function: Some(Function::One(Unary::Sqrt)), arguments, .. } => {
                arguments.first().copied()
            }
            NodeKind::Infix { operator: Operator::Power, left, right, .. } => {
                (self.walk.constant(*right)?.abs() == 0.5).then_some(*left)
            }
            _ => None,
        }
    }

    /// Whether a mass, a current or an acceleration is among what a radicand is made of, so that it is no
    /// mean of frequencies.
    fn is_of_oscillator(&self, radicand: usize) -> bool {
        let span = self.walk.tree.span(radicand);
        let nodes = self.walk.tree.nodes.iter().enumerate();
        let within = nodes.filter(|(_, node)| {
            span.start <= node.span.start
                && node.span.end <= span.end
                && node.kind == NodeKind::Name
        });
        let has = |exponent: &Exponent| !exponent.is_zero();
        within.filter_map(|(index, _)| self.dimension(index)).any(|dimension| {
            let [mass, _, _, current, ..] = dimension.exponents();
            has(mass) || has(current) || dimension == ACCELERATION
        })
    }
}
