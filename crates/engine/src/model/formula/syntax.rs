//! The tree of a formula.
//!
//! Nodes stand in one list, operands before the operation that uses them, so that everything that
//! walks the tree is a loop: a sum of thirty thousand terms needs no deep stack.

use std::ops::Range;
use std::sync::Arc;

use super::constant::DefiningConstant;
use super::function::Function;
use crate::regression::CurveFunction;
use gumption_units::Unit;

/// A formula as a tree; the last node is the whole.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Tree {
    pub nodes: Vec<Node>,
}

/// A node with its place in the text, a half-open range of bytes. Parentheses around the whole of a
/// node are not part of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    pub(super) kind: Kind,
    pub(super) span: Range<usize>,
}

/// What a node is. Operands are indices in the list of nodes.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    /// A number as written.
    Number(f64),
    /// The constant pi.
    Pi,
    /// A name; it is the text at the node's span.
    Name,
    /// A unit in brackets: one such unit.
    Unit(Box<Unit>),
    /// A constant in brackets.
    Constant(DefiningConstant),
    /// A number of units: `1.5 [mm]`.
    InUnit { number: usize, unit: Box<Unit> },
    /// The opposite of an operand.
    Negate(usize),
    /// Two operands with an operator between them.
    Infix { operator: Operator, operator_span: Range<usize>, left: usize, right: usize },
    /// A call. A name that is no function's is kept, because only the names in scope tell what is
    /// wrong with it.
    Call { function: Option<Function>, name_span: Range<usize>, arguments: Vec<usize> },
    /// A calibration function at an argument, or with `inverse` the x that belongs to a value.
    Curve { curve: Arc<CurveFunction>, inverse: bool, argument: usize },
}

/// An operator between two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Equal,
    NotEqual,
}

impl Operator {
    /// The operator as it is usually written.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::Power => "^",
            Self::Less => "<",
            Self::LessOrEqual => "<=",
            Self::Greater => ">",
            Self::GreaterOrEqual => ">=",
            Self::Equal => "==",
            Self::NotEqual => "!=",
        }
    }

    /// Whether it compares its operands.
    pub(super) fn is_comparison(self) -> bool {
        !matches!(self, Self::Add | Self::Subtract | Self::Multiply | Self::Divide | Self::Power)
    }
}

impl Tree {
    /// Whether some value depends on what its parts are: `kelvin(t)` adds 273.15 to a Celsius
    /// temperature, and `t/[degF]` counts from another zero.
    pub(super) fn needs_typings(&self) -> bool {
        self.nodes.iter().any(|node| match &node.kind {
            Kind::Call { function: Some(Function::Kelvin | Function::Celsius), .. } => true,
            Kind::Unit(unit) => unit.offset() != 0.0,
            Kind::Curve { .. } => true,
            _ => false,
        })
    }

    /// The place of a node in the text; empty for a node that is not there.
    pub(super) fn span(&self, node: usize) -> Range<usize> {
        self.nodes.get(node).map_or(0..0, |node| node.span.clone())
    }
}
