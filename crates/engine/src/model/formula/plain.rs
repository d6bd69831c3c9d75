//! Values that are plain numbers by how a formula is made, `if(f > 100 [Hz], 5, 8)`: of a quantity in per
//! cent they can be 5 %, as the quantity is given, or 500 %, as formulas count.

use super::evaluate::constants;
use super::function::Function;
use super::note_result::taken_up;
use super::syntax::{Node, NodeKind, Operator, Tree};
use crate::number::{Binary, Unary};

/// What a name of a formula of conditions is, as far as its numbers can be taken for those of a share or an
/// angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NameKind {
    /// A share, an angle or a number whose unit is stated.
    Stated,
    /// A number of which no unit is said.
    Unstated,
    /// A quantity with a dimension.
    Other,
}

/// A number in a value that no unit is said of.
#[derive(Clone, Debug, PartialEq)]
pub struct PlainNumber {
    /// The number, or the name, as the formula has it.
    pub text: String,
    /// The number; `None` of a name.
    pub number: Option<f64>,
    /// Whether nothing stands beside it but numbers, as those that `if` chooses from.
    pub is_alone: bool,
}

/// What a node is in a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NodeRole {
    /// Plain numbers, of which one stands there, also beside numbers of units.
    Number(usize),
    /// A plain number beside ratios of quantities.
    Mixed(usize),
    /// 1 beside a ratio: the whole.
    Whole,
    /// The whole beside what is divided by a number of units: `1 + f/1000 [Hz]`.
    WholeOfUnits,
    /// A ratio of quantities, or what a function gives.
    Ratio,
    /// What is divided by a number of units: `f/1000 [Hz]`, `f/[Hz]`.
    OfUnits,
    /// A number of units, which are a share or an angle: `5 [%]`.
    InUnit,
    /// A quantity whose unit is stated, which notes are about.
    Stated,
}

/// The parts of a formula.
struct NodeRoles {
    constants: Vec<Option<f64>>,
    parts: Vec<NodeRole>,
    is_width: bool,
}

/// A plain number that is the value of a formula or a summand of it, where nothing in the value has the unit
/// of a share or an angle.
pub(super) fn plain_number(
    text: &str,
    tree: &Tree,
    kind_of: impl Fn(&str) -> NameKind,
    is_width: bool,
) -> Option<PlainNumber> {
    let parts = Vec::with_capacity(tree.nodes.len());
    let mut all = NodeRoles { constants: constants(tree), parts, is_width };
    for (index, node) in tree.nodes.iter().enumerate() {
        let part = match (all.constants.get(index).copied().flatten(), &node.kind) {
            (Some(_), _) => NodeRole::Number(index),
            (None, NodeKind::Name) => {
                match kind_of(text.get(node.span.clone()).unwrap_or_default()) {
                    NameKind::Stated => NodeRole::Stated,
                    NameKind::Unstated => NodeRole::Number(index),
                    NameKind::Other => NodeRole::Ratio,
                }
            }
            _ => all.of_node(node),
        };
        all.parts.push(part);
    }
    let (at, is_alone) = match all.parts.last()? {
        NodeRole::Number(at) => (*at, true),
        NodeRole::Mixed(at) => (*at, false),
        _ => return None,
    };
    let number = all.constants.get(at).copied().flatten();
    let is_told = number.is_none_or(|number| number != 0.0 && number.is_finite());
    let text = text.get(tree.span(at)).unwrap_or_default().to_owned();
    is_told.then_some(PlainNumber { text, number, is_alone })
}

impl NodeRoles {
    fn part(&self, index: usize) -> NodeRole {
        self.parts.get(index).copied().unwrap_or(NodeRole::Ratio)
    }

    fn constant(&self, index: usize) -> Option<f64> {
        self.constants.get(index).copied().flatten()
    }

    fn of_node(&self, node: &Node) -> NodeRole {
        match &node.kind {
            NodeKind::InUnit { unit, .. } | NodeKind::Unit(unit) => {
                match unit.dimension().is_none() {
                    true => NodeRole::InUnit,
                    false => NodeRole::OfUnits,
                }
            }
            NodeKind::Negate(x) => self.part(*x),
            NodeKind::Infix { operator, left, right, .. } => {
                let sides = [self.part(*left), self.part(*right)];
                match operator {
                    Operator::Add | Operator::Subtract => self.together(&[*left, *right]),
                    Operator::Multiply => self.product(sides),
                    Operator::Divide => self.quotient(sides),
                    Operator::Power if self.constant(*right).is_some() => self.part(*left),
                    _ => NodeRole::Ratio,
                }
            }
            NodeKind::Call { function: Some(function), arguments, .. } => match function {
                Function::One(Unary::Sqrt | Unary::Round | Unary::Floor | Unary::Ceil)
                | Function::Two(Binary::Modulo) => {
                    arguments.first().map_or(NodeRole::Ratio, |argument| self.part(*argument))
                }
                _ => match taken_up(*function, arguments) {
                    [] => NodeRole::Ratio,
                    parts => self.together(parts),
                },
            },
            // their units are looked at where they are read
            NodeKind::Table { .. } | NodeKind::Curve { .. } | NodeKind::Solve { .. } => {
                NodeRole::Stated
            }
            _ => NodeRole::Ratio,
        }
    }

    /// A sum of parts, or a choice of them.
    fn together(&self, parts: &[usize]) -> NodeRole {
        let is_zero = |index: &&usize| self.constant(**index) == Some(0.0);
        let kept = parts.iter().filter(|index| !is_zero(index)).map(|index| self.part(*index));
        let zero = parts.first().map_or(NodeRole::Ratio, |index| self.part(*index));
        kept.reduce(|x, y| self.both(x, y)).unwrap_or(zero)
    }

    fn both(&self, x: NodeRole, y: NodeRole) -> NodeRole {
        use NodeRole::{InUnit, Mixed, Number, OfUnits, Ratio, Stated, Whole, WholeOfUnits};
        match (x, y) {
            (Stated, _) | (_, Stated) => Stated,
            (Number(at), Number(_)) => Number(at),
            (Mixed(at), _) | (_, Mixed(at)) => Mixed(at),
            (Number(at), other) | (other, Number(at)) => {
                // no width is the whole
                let is_whole = !self.is_width && self.constant(at).is_some_and(|x| x.abs() == 1.0);
                match other {
                    InUnit if !is_whole => Number(at),
                    _ if !is_whole => Mixed(at),
                    InUnit => InUnit,
                    OfUnits | WholeOfUnits => WholeOfUnits,
                    _ => Whole,
                }
            }
            (InUnit, _) | (_, InUnit) => InUnit,
            (WholeOfUnits, _) | (_, WholeOfUnits) => WholeOfUnits,
            (Whole, _) | (_, Whole) => Whole,
            (OfUnits, _) | (_, OfUnits) => OfUnits,
            (Ratio, Ratio) => Ratio,
        }
    }

    fn product(&self, sides: [NodeRole; 2]) -> NodeRole {
        use NodeRole::{InUnit, Mixed, Number, OfUnits, Ratio, Stated, Whole, WholeOfUnits};
        match sides {
            [Stated, _] | [_, Stated] => Stated,
            [InUnit, _] | [_, InUnit] => InUnit,
            [Number(at), Number(other)] => {
                Number(if self.constant(at).is_some() { at } else { other })
            }
            [Number(at), Mixed(_)] | [Mixed(_), Number(at)] => Mixed(at),
            [Number(at), WholeOfUnits] | [WholeOfUnits, Number(at)]
                if self.constant(at).is_none_or(|x| x.abs() != 1.0) =>
            {
                Mixed(at)
            }
            [Number(_), Whole | WholeOfUnits] | [Whole | WholeOfUnits, Number(_)] => Whole,
            [OfUnits, _] | [_, OfUnits] => OfUnits,
            _ => Ratio,
        }
    }

    fn quotient(&self, sides: [NodeRole; 2]) -> NodeRole {
        use NodeRole::{InUnit, Mixed, Number, OfUnits, Ratio, Stated, Whole, WholeOfUnits};
        match sides {
            [Stated, _] | [_, Stated | InUnit] => Stated,
            [InUnit, _] => InUnit,
            [Number(at), Number(_)] => Number(at),
            [Mixed(at), Number(_)] => Mixed(at),
            [Whole | WholeOfUnits, Number(_)] => Whole,
            [OfUnits, _] | [_, OfUnits] => OfUnits,
            _ => Ratio,
        }
    }
}
