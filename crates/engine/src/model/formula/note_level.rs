//! Levels whose factor is that of another kind of quantity: `10*log10` of a ratio of voltages,
//! `20*log10` of a ratio of powers (IEC 60027-3, 3.1 and 3.2).

use super::dimension::check;
use super::function::Function;
use super::note::{FormulaNote, Walk};
use super::numbers::Use;
use super::syntax::{Node, NodeKind, Operator, Tree};
use super::typing::{Scope, Typing};
use crate::fact;
use crate::number::Unary;
use gumption_units::Dimension;

/// Root-power quantities, whose squares are proportional to a power: voltage, current, electric and magnetic
/// field strength, (sound) pressure, velocity, acceleration.
const ROOT_POWER: [Dimension; 7] = [
    Dimension::of([1, 2, -3, -1, 0, 0, 0]),
    Dimension::of([0, 0, 0, 1, 0, 0, 0]),
    Dimension::of([1, 1, -3, -1, 0, 0, 0]),
    Dimension::of([0, -1, 0, 1, 0, 0, 0]),
    Dimension::of([1, -1, -2, 0, 0, 0, 0]),
    Dimension::of([0, 1, -1, 0, 0, 0, 0]),
    Dimension::of([0, 1, -2, 0, 0, 0, 0]),
];

/// Power and intensity.
const POWER: [Dimension; 2] =
    [Dimension::of([1, 2, -3, 0, 0, 0, 0]), Dimension::of([1, 0, -3, 0, 0, 0, 0])];

/// The first level of a formula that has the factor of another kind of quantity.
pub(super) fn of_other_kind(text: &str, tree: &Tree, scope: &Scope) -> Option<FormulaNote> {
    let walk = Walk::new(text, tree, |_| None, Use::Quantity);
    let levels: Vec<_> = whole_products(&walk).filter_map(|node| level(&walk, node)).collect();
    if levels.is_empty() {
        return None;
    }
    let typings = check(text, tree, scope, true).typings;
    levels.into_iter().find_map(|Level { node, factor, argument }| {
        let compared = compared(&walk, argument, &typings)?;
        let formula = walk.quoted(&node.span);
        let fact = match factor {
            10.0 if ROOT_POWER.contains(&compared) => fact!("level-of-other-kind", formula),
            20.0 if POWER.contains(&compared) => fact!("level-of-other-kind.powers", formula),
            _ => return None,
        };
        Some(FormulaNote::at(node, fact))
    })
}

/// A number times a decadic logarithm.
struct Level<'t> {
    node: &'t Node,
    /// The size of the number.
    factor: f64,
    /// The logarithm's.
    argument: usize,
}

fn level<'t>(walk: &Walk<'t, '_>, node: &'t Node) -> Option<Level<'t>> {
    let (factor, operands) = walk.factor_and_operands(node);
    let [(logarithm, false)] = operands[..] else { return None };
    match walk.node(logarithm)? {
        NodeKind::Call { function: Some(Function::One(Unary::Log10)), arguments, .. } => {
            Some(Level { node, factor: factor.abs(), argument: *arguments.first()? })
        }
        _ => None,
    }
}

/// The products that are no factors of others.
fn whole_products<'t>(walk: &Walk<'t, '_>) -> impl Iterator<Item = &'t Node> {
    let tree = walk.tree;
    let mut is_factor = vec![false; tree.nodes.len()];
    for node in &tree.nodes {
        let operands = match &node.kind {
            NodeKind::Infix {
                operator: Operator::Multiply | Operator::Divide,
                left,
                right,
                ..
            } => [Some(*left), Some(*right)],
            NodeKind::Negate(x) => [Some(*x), None],
            _ => continue,
        };
        for operand in operands.into_iter().flatten() {
            if let Some(is_factor) = is_factor.get_mut(operand) {
                *is_factor = true;
            }
        }
    }
    tree.nodes.iter().zip(is_factor).filter(|(_, is_factor)| !is_factor).map(|(node, _)| node)
}

/// The dimension of what an argument compares: that of its factors which are not divided by.
fn compared(walk: &Walk<'_, '_>, argument: usize, typings: &[Typing]) -> Option<Dimension> {
    let node = walk.tree.nodes.get(argument)?;
    let factors = walk.operands(node).into_iter().filter(|(_, is_divided)| !is_divided);
    let mut dimensions = factors.map(|(index, _)| typings.get(index)?.dimension);
    dimensions.try_fold(Dimension::NONE, |product, of| product.checked_mul(of?))
}
