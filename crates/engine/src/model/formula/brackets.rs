//! Units in brackets of a formula whose units are not checked. Its quantities are the numbers in their
//! own units, 1013 of `1013 hPa`, and a unit in brackets is a number of coherent ones, 100: `p/[hPa]` is
//! the number that `p` is, and `p + 1 [hPa]` and `2*p/[hPa]` would be a hundred times off.

use std::collections::HashSet;

use super::error::FormulaError;
use super::syntax::{NodeKind, Operator, Tree};
use super::typing::Scope;

/// The brackets that stand for another number than the quantities of their dimension.
pub(super) fn misread(text: &str, tree: &Tree, scope: &Scope) -> Vec<FormulaError> {
    let name = |node: usize| {
        let node = tree.nodes.get(node).filter(|node| node.kind == NodeKind::Name)?;
        text.get(node.span.clone())
    };
    // `p/[hPa]` knows the unit of `p`
    let known: HashSet<usize> = tree
        .nodes
        .iter()
        .filter_map(|node| match &node.kind {
            NodeKind::Infix { operator: Operator::Divide, left, right, .. } => {
                name(*left).and_then(|name| scope.declared(name)).map(|_| *right)
            }
            _ => None,
        })
        .collect();
    let brackets = tree.nodes.iter().enumerate().filter_map(|(index, node)| match &node.kind {
        NodeKind::Unit(unit) if !known.contains(&index) => Some((unit, &node.span)),
        NodeKind::InUnit { unit, .. } => Some((unit, &node.span)),
        _ => None,
    });
    brackets
        .filter(|(unit, _)| !unit.dimension().is_none())
        .filter_map(|(unit, span)| {
            let (name, own) = scope.declared_of(unit.dimension())?;
            Some(FormulaError::UncheckedUnit {
                found: unit.text().trim().to_owned(),
                name: name.to_owned(),
                unit: own.to_string(),
                span: span.clone(),
            })
        })
        .collect()
}
