//! Which parts of a formula are complex, and that what is done with them is known of complex numbers.

use super::error::FormulaError;
use super::function::{ComplexPart, Function};
use super::message::excerpt;
use super::syntax::{NodeKind, Operator, Tree};
use super::typing::Scope;
use crate::number::Unary;

/// Whether a formula's value is complex, and the operations that complex numbers do not have.
pub(super) fn complexity(text: &str, tree: &Tree, scope: &Scope) -> (bool, Vec<FormulaError>) {
    let mut complex: Vec<bool> = Vec::with_capacity(tree.nodes.len());
    let mut errors = Vec::new();
    for node in &tree.nodes {
        let is = |index: &usize| complex.get(*index).copied().unwrap_or(false);
        let refused = |what: &str, of: usize| {
            let span = tree.span(of);
            let quoted = excerpt(text, span.clone());
            let reason = format!(
                "`{quoted}` is complex, which {what} does not take; take a part of it with re, im, abs \
                 or arg"
            );
            FormulaError::Complex { reason, span }
        };
        let found = match &node.kind {
            NodeKind::Name => scope.is_complex(text.get(node.span.clone()).unwrap_or_default()),
            NodeKind::Negate(x) => is(x),
            NodeKind::InUnit { number, .. } => is(number),
            NodeKind::Infix {
                operator:
                    Operator::Add
                    | Operator::Subtract
                    | Operator::Multiply
                    | Operator::Divide
                    | Operator::Power,
                left,
                right,
                ..
            } => is(left) || is(right),
            NodeKind::Infix { operator, left, right, .. } => {
                let operand = [left, right].into_iter().find(|operand| is(operand));
                let what = format!("`{}`", operator.name());
                errors.extend(operand.map(|operand| refused(&what, *operand)));
                false
            }
            NodeKind::Call { function: Some(function), arguments, .. } => {
                let operand = arguments.iter().find(|operand| is(operand));
                match (function, operand) {
                    (_, None) => false,
                    (Function::One(Unary::Abs) | Function::Part(ComplexPart::Conjugate), _)
                    | (Function::Part(_), _) => *function == Function::Part(ComplexPart::Conjugate),
                    (
                        Function::One(
                            Unary::Sqrt
                            | Unary::Exp
                            | Unary::Ln
                            | Unary::Log10
                            | Unary::Sin
                            | Unary::Cos
                            | Unary::Tan
                            | Unary::Sinh
                            | Unary::Cosh
                            | Unary::Tanh,
                        )
                        | Function::Sum
                        | Function::Mean,
                        _,
                    ) => true,
                    (function, Some(operand)) => {
                        errors.push(refused(&format!("`{}`", function.name()), *operand));
                        false
                    }
                }
            }
            NodeKind::Curve { curve, argument, .. } => {
                if is(argument) {
                    errors.push(refused("a calibration function", *argument));
                }
                curve.fit.is_complex()
            }
            _ => false,
        };
        complex.push(found);
    }
    (complex.last().copied().unwrap_or(false), errors)
}
