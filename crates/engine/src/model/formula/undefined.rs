//! Parts of a formula that depend on nothing and have no value: `asin(2)`, `1/0`. No trial would have a
//! finite result, and none could say which operation it fails at.

use super::error::FormulaError;
use super::function::Function;
use super::message::excerpt;
use super::syntax::{NodeKind, Tree};

/// The first such part; none of a formula with a branch that need not be taken.
pub(super) fn constant_part(
    text: &str,
    tree: &Tree,
    constants: &[Option<f64>],
) -> Option<FormulaError> {
    let is_branch =
        |kind: &NodeKind| matches!(kind, NodeKind::Call { function: Some(Function::If), .. });
    if tree.nodes.iter().any(|node| is_branch(&node.kind)) {
        return None;
    }
    // operands stand before what is made of them
    constants.iter().zip(&tree.nodes).find_map(|(value, node)| {
        let value = value.filter(|value| !value.is_finite())?;
        let (part, span) = (excerpt(text, node.span.clone()), node.span.clone());
        Some(FormulaError::ConstantUndefined { part, is_infinite: value.is_infinite(), span })
    })
}
