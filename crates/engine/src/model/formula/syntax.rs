//! The tree of a formula.
//!
//! Nodes stand in one list, operands before the operation that uses them, so that everything that
//! walks the tree is a loop: a sum of thirty thousand terms needs no deep stack.

use std::ops::Range;
use std::sync::Arc;

use super::constant::DefiningConstant;
use super::function::Function;
use crate::model::InterpolationMethod;
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
    pub(super) kind: NodeKind,
    pub(super) span: Range<usize>,
}

/// What a node is. Operands are indices in the list of nodes.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum NodeKind {
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
    /// A call of `table`.
    Table {
        /// The abscissa.
        x: usize,
        /// Which table.
        call: Box<TableCall>,
    },
    /// A call of `solve`.
    Solve {
        /// The formula that is to be 0, whose places are those of the same text.
        body: Box<Tree>,
        /// Where the name of the unknown stands.
        unknown: Range<usize>,
        /// The ends of the range that is searched.
        from: usize,
        to: usize,
    },
    /// Two truths of which both, or at least one, is wanted: numbers that are not 0.
    Joined { joint: Joint, span: Range<usize>, left: usize, right: usize },
    /// Whether a truth is none.
    Not { span: Range<usize>, of: usize },
    /// A call. A name that is no function's is kept, because only the names in scope tell what is
    /// wrong with it.
    Call { function: Option<Function>, name_span: Range<usize>, arguments: Vec<usize> },
    /// A calibration function at an argument, or with `inverse` the x that belongs to a value.
    Curve { curve: Arc<CurveFunction>, inverse: bool, argument: usize },
}

/// A table that a formula names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TableCall {
    /// The file, as written.
    pub file: String,
    /// The columns of abscissas and of values; the first two without them.
    pub columns: Option<[String; 2]>,
    /// How values between the points are found.
    pub method: InterpolationMethod,
    /// Where the call stands in the formula, a half-open range of bytes.
    pub span: Range<usize>,
}

impl TableCall {
    /// Whether both are of the same table.
    pub fn is_same(&self, other: &Self) -> bool {
        (&self.file, &self.columns, self.method) == (&other.file, &other.columns, other.method)
    }
}

/// What joins two truths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Joint {
    And,
    Or,
}

/// What stands before a truth that is wanted not to hold.
pub(super) const NEGATION: &str = "not";

impl Joint {
    pub(super) const ALL: [Self; 2] = [Self::And, Self::Or];

    /// The joint as it is written.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::And => "and",
            Self::Or => "or",
        }
    }
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
    /// The places of the names of quantities, without the unknowns of equations to solve.
    pub(super) fn names(&self, text: &str, places: &mut Vec<Range<usize>>) {
        for node in &self.nodes {
            match &node.kind {
                NodeKind::Name => places.push(node.span.clone()),
                NodeKind::Solve { body, unknown, .. } => {
                    let before = places.len();
                    body.names(text, places);
                    let is_other =
                        |span: &Range<usize>| text.get(span.clone()) != text.get(unknown.clone());
                    let inner: Vec<_> = places.drain(before..).filter(is_other).collect();
                    places.extend(inner);
                }
                _ => {}
            }
        }
    }

    /// The tables.
    pub(super) fn tables<'t>(&'t self, calls: &mut Vec<&'t TableCall>) {
        for node in &self.nodes {
            match &node.kind {
                NodeKind::Table { call, .. } => calls.push(call),
                NodeKind::Solve { body, .. } => body.tables(calls),
                _ => {}
            }
        }
    }

    /// Whether some value depends on what its parts are: `kelvin(t)` adds 273.15 to a Celsius
    /// temperature, and `t/[degF]` counts from another zero.
    pub(super) fn needs_typings(&self) -> bool {
        self.nodes.iter().any(|node| match &node.kind {
            NodeKind::Call { function: Some(Function::Kelvin | Function::Celsius), .. } => true,
            NodeKind::Unit(unit) => unit.zero().is_some(),
            // the range tells what the unknown is, and the columns what they count from
            NodeKind::Solve { .. } | NodeKind::Curve { .. } | NodeKind::Table { .. } => true,
            _ => false,
        })
    }

    /// Whether there is an equation to solve in it.
    pub(super) fn has_solve(&self) -> bool {
        self.nodes.iter().any(|node| matches!(node.kind, NodeKind::Solve { .. }))
    }

    /// The place of a node in the text; empty for a node that is not there.
    pub(super) fn span(&self, node: usize) -> Range<usize> {
        self.nodes.get(node).map_or(0..0, |node| node.span.clone())
    }
}
