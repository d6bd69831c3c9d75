//! What is right by the rules of formulas and seldom meant.

use std::ops::Range;

use super::evaluate::constants;
use super::message::excerpt;
use super::syntax::{Kind, Node, Operator, Tree};
use crate::number::Shortest;
use gumption_units::{Turn, Unit};

/// Two factors are the same but for the digits that somebody wrote of pi.
const SAME_FACTOR: f64 = 1e-3;

/// A note on a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FormulaNote {
    /// A short name of what it is about.
    pub code: &'static str,
    /// What is said.
    pub text: String,
    /// Where in the formula, a half-open range of bytes.
    pub span: Range<usize>,
}

/// The notes on a formula. `unit_of` gives the unit that a name's values are given in, which formulas
/// compute with in coherent SI; `None` if they are not, or if it is not known.
pub(super) fn notes<'u>(
    text: &str,
    tree: &Tree,
    unit_of: impl Fn(&str) -> Option<&'u Unit>,
) -> Vec<FormulaNote> {
    let walk = Walk { text, tree, constants: constants(tree) };
    // the unit that the numbers of a node would be in, and the factor that has been put to it
    let mut scaled: Vec<Option<(&Unit, f64)>> = Vec::with_capacity(tree.nodes.len());
    let mut found = Vec::new();
    for node in &tree.nodes {
        found.extend(walk.turns(node));
        found.extend(walk.bare_number(node, &scaled));
        let (of, converts) = walk.scaled(node, &scaled, &unit_of);
        found.extend(converts);
        scaled.push(of);
    }
    found
}

struct Walk<'t> {
    text: &'t str,
    tree: &'t Tree,
    constants: Vec<Option<f64>>,
}

impl Walk<'_> {
    fn constant(&self, index: usize) -> Option<f64> {
        self.constants.get(index).copied().flatten()
    }

    fn quoted(&self, span: &Range<usize>) -> String {
        excerpt(self.text, span.clone())
    }

    /// Whether a number is written with pi, as of angles in radians.
    fn has_pi(&self, index: usize) -> bool {
        let text = self.text.get(self.tree.span(index)).unwrap_or_default();
        text.contains("pi") || text.contains('π')
    }

    /// `sin(30)`, which is of 30 rad.
    fn turns(&self, node: &Node) -> Option<FormulaNote> {
        let Kind::Call { function: Some(function), arguments, .. } = &node.kind else {
            return None;
        };
        let [argument] = arguments.as_slice() else { return None };
        let angle = self.constant(*argument)?;
        if !function.takes_angle() || angle.abs() <= std::f64::consts::TAU {
            return None;
        }
        let text = self.text.get(self.tree.span(*argument)).unwrap_or_default();
        let note = format!(
            "`{}` takes radians, and {text} rad are more than a turn; an angle in degrees is written \
             `{text} [deg]`",
            function.name()
        );
        let span = node.span.clone();
        (!self.has_pi(*argument)).then_some(FormulaNote {
            code: "angle-of-turns",
            text: note,
            span,
        })
    }

    /// `phi + 90` of an angle in degrees, `p < 5` of per cent.
    fn bare_number(&self, node: &Node, scaled: &[Option<(&Unit, f64)>]) -> Option<FormulaNote> {
        let Kind::Infix { operator, left, right, .. } = &node.kind else { return None };
        if matches!(operator, Operator::Multiply | Operator::Divide | Operator::Power) {
            return None;
        }
        let of = |index: usize| scaled.get(index).copied().flatten();
        let (at, name) = match (self.constant(*left), self.constant(*right)) {
            (Some(_), None) => (*left, *right),
            (None, Some(_)) => (*right, *left),
            _ => return None,
        };
        let (number, (unit, _)) = (self.constant(at)?, of(name)?);
        // the whole beside a share of it, or the first term of an expansion
        let is_whole = number.abs() == 1.0 && (unit.is_relative() || at == *left);
        if number == 0.0 || is_whole || self.has_pi(at) {
            return None;
        }
        let written = Shortest(number);
        let is = match unit.turn() {
            Some(_) => format!("{written} rad"),
            None => {
                format!("the number {written}, that is {} {unit}", Shortest(unit.from_si(number)))
            }
        };
        let text = format!(
            "in `{}`, {written} is {is}, as `{}` is given in {unit}; {written} {unit} are written \
             `{written} [{unit}]`",
            self.quoted(&node.span),
            self.quoted(&self.tree.span(name)),
        );
        Some(FormulaNote { code: "bare-number", text, span: node.span.clone() })
    }

    /// `phi*pi/180` of an angle in degrees, `p/100` of per cent.
    fn converted_twice(&self, node: &Node, unit: &Unit) -> FormulaNote {
        let quoted = self.quoted(&node.span);
        let (code, text) = if unit.is_relative() {
            let text = format!(
                "`{quoted}` converts from {unit} once more: formulas have a share in {unit} as a plain \
                 number already, so that its name is enough"
            );
            ("share-converted-twice", text)
        } else {
            let text = format!(
                "`{quoted}` converts to radians once more: formulas have an angle in {unit} in radians \
                 already, so that its name is enough"
            );
            ("angle-converted-twice", text)
        };
        FormulaNote { code, text, span: node.span.clone() }
    }

    /// What the numbers of a node are in, for the sums that it stands in; a note where pi/180 or 1/100
    /// converts what formulas have converted already.
    fn scaled<'u>(
        &self,
        node: &Node,
        scaled: &[Option<(&'u Unit, f64)>],
        unit_of: &impl Fn(&str) -> Option<&'u Unit>,
    ) -> (Option<(&'u Unit, f64)>, Option<FormulaNote>) {
        let of = |index: usize| scaled.get(index).copied().flatten();
        let times = |(unit, factor): (&'u Unit, f64), by: f64| {
            let factor = factor * by;
            let converts = (factor.abs() / unit.factor() - 1.0).abs() < SAME_FACTOR;
            let note = converts.then(|| self.converted_twice(node, unit));
            (Some((unit, factor)), note)
        };
        match &node.kind {
            Kind::Name => {
                let unit = self.text.get(node.span.clone()).and_then(unit_of);
                let is_scaled = |unit: &&Unit| {
                    (unit.is_relative() || unit.turn() == Some(Turn::Angle))
                        && unit.dimension().is_none()
                        && unit.factor() != 1.0
                };
                (unit.filter(is_scaled).map(|unit| (unit, 1.0)), None)
            }
            Kind::Negate(x) => (of(*x), None),
            Kind::Infix { operator, left, right, .. } => match operator {
                Operator::Add | Operator::Subtract => (of(*left).or(of(*right)), None),
                Operator::Multiply => match (self.constant(*left), self.constant(*right)) {
                    (Some(by), None) => of(*right).map_or((None, None), |x| times(x, by)),
                    (None, Some(by)) => of(*left).map_or((None, None), |x| times(x, by)),
                    _ => (None, None),
                },
                Operator::Divide => match (of(*left), self.constant(*right)) {
                    (Some(x), Some(by)) => times(x, 1.0 / by),
                    _ => (None, None),
                },
                _ => (None, None),
            },
            _ => (None, None),
        }
    }
}
