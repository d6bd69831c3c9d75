//! What is right by the rules of formulas and seldom meant.

use std::ops::Range;

use super::evaluate::constants;
use super::function::Function;
use super::message::excerpt;
use super::syntax::{Kind, Node, Operator, Tree};
use crate::number::{Binary, Shortest};
use gumption_units::{Turn, Unit};

/// Two factors are the same but for the digits that somebody wrote of pi.
const SAME_FACTOR: f64 = 1e-3;

/// The code of shares that a product converts once more.
const SHARE_TWICE: &str = "share-converted-twice";

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
/// compute with in coherent SI; `None` if they are not, or if it is not known. `result` is the unit
/// that the formula's value is reported in, if it is an output's.
pub(super) fn notes<'u>(
    text: &str,
    tree: &Tree,
    unit_of: impl Fn(&str) -> Option<&'u Unit>,
    result: Option<&Unit>,
) -> Vec<FormulaNote> {
    let walk = Walk { text, tree, constants: constants(tree) };
    let mut scaled: Vec<Scaled<'_>> = Vec::with_capacity(tree.nodes.len());
    let mut found = Vec::new();
    for node in &tree.nodes {
        found.extend(walk.turns(node));
        found.extend(walk.bare_number(node, &scaled));
        found.extend(walk.bare_argument(node, &scaled));
        let (of, converts) = walk.scaled(node, &scaled, &unit_of);
        found.extend(converts);
        scaled.push(of);
    }
    let whole = tree.nodes.last().zip(scaled.last());
    if let Some(twice) =
        whole.zip(result).and_then(|((node, of), unit)| walk.result(node, of, unit))
    {
        // the factor of `c*100/p` that is reported in % may be meant for either
        found.retain(|note| !(note.code == SHARE_TWICE && note.span == twice.span));
        found.push(twice);
    }
    found
}

/// What numbers a node's value is made of.
#[derive(Clone, Copy)]
struct Scaled<'u> {
    /// The unit of the one name among its factors whose values formulas have in another one.
    unit: Option<&'u Unit>,
    /// The product of the plain numbers among its factors.
    factor: f64,
    /// Whether there is no other factor, so that its numbers would be in the unit.
    is_bare: bool,
    /// Whether the name is divided by: `c*100/p`.
    is_divisor: bool,
    /// The square of what would be in a unit: where its base stands, and the unit.
    square: Option<(usize, &'u Unit)>,
}

impl<'u> Scaled<'u> {
    const UNKNOWN: Self =
        Self { unit: None, factor: 1.0, is_bare: false, is_divisor: false, square: None };

    /// Of a name with this unit.
    fn of(unit: &'u Unit) -> Self {
        let counts_turns = unit.turn() == Some(Turn::Angle);
        let is_scaled = (unit.is_relative() || counts_turns)
            && unit.factor() != 1.0
            && (counts_turns || unit.dimension().is_none());
        if is_scaled {
            Self { unit: Some(unit), is_bare: true, ..Self::UNKNOWN }
        } else {
            Self::UNKNOWN
        }
    }

    /// The unit, of a share or an angle and not of a rate, where its numbers would be in it.
    fn bare_unit(&self) -> Option<&'u Unit> {
        self.unit.filter(|unit| self.is_bare && unit.dimension().is_none())
    }

    /// Whether its plain numbers convert from its unit to the one that formulas compute with.
    fn converts(&self) -> bool {
        let own = if self.is_divisor { 1.0 / self.factor } else { self.factor };
        let is = |factor: f64| (own.abs() / factor - 1.0).abs() < SAME_FACTOR;
        self.unit.is_some_and(|unit| {
            // revolutions per second, or per minute, to radians per second
            let is_rate = !unit.dimension().is_none();
            is(unit.factor()) || (is_rate && is(std::f64::consts::TAU))
        })
    }
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
    fn bare_number(&self, node: &Node, scaled: &[Scaled<'_>]) -> Option<FormulaNote> {
        let Kind::Infix { operator, left, right, .. } = &node.kind else { return None };
        if matches!(operator, Operator::Multiply | Operator::Divide | Operator::Power) {
            return None;
        }
        let (at, name) = match (self.constant(*left), self.constant(*right)) {
            (Some(_), None) => (*left, *right),
            (None, Some(_)) => (*right, *left),
            _ => return None,
        };
        let of = scaled.get(name)?;
        let square = of.square.filter(|_| *operator == Operator::Add);
        let (name, unit) = square.or_else(|| Some((name, of.bare_unit()?)))?;
        // `3^2`, or 9, beside the square of a quantity
        let number = match square {
            Some(_) => self.constant(at).filter(|square| *square >= 0.0)?.sqrt(),
            None => self.constant(at)?,
        };
        // the whole beside a share of it, or the first term of an expansion
        let is_whole = number.abs() == 1.0 && (unit.is_relative() || at == *left);
        if number == 0.0 || is_whole || self.has_pi(at) {
            return None;
        }
        Some(self.number_beside(node, number, (name, unit)))
    }

    /// `min(p, 100)` of per cent: a number that is far from every share and angle.
    fn bare_argument(&self, node: &Node, scaled: &[Scaled<'_>]) -> Option<FormulaNote> {
        let Kind::Call { function: Some(function), arguments, .. } = &node.kind else {
            return None;
        };
        let Function::Fold(of @ (Binary::Min | Binary::Max | Binary::Hypot)) = function else {
            return None;
        };
        let unit = |index: &usize| Some((*index, scaled.get(*index)?.bare_unit()?));
        let (name, unit) = arguments.iter().find_map(unit)?;
        // the legs of a triangle are added, of which every number is wrong
        let most = match (of, unit.turn()) {
            (Binary::Hypot, _) => 0.0,
            (_, Some(_)) => std::f64::consts::TAU,
            (_, None) => 1.0,
        };
        let numbers = arguments.iter().filter(|index| !self.has_pi(**index));
        let is_far = |number: &f64| number.abs() > most && number.abs() != 1.0;
        let number = numbers.filter_map(|index| self.constant(*index)).find(is_far)?;
        Some(self.number_beside(node, number, (name, unit)))
    }

    /// Says of a number what it is beside a quantity of that unit.
    fn number_beside(&self, node: &Node, number: f64, (name, unit): (usize, &Unit)) -> FormulaNote {
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
        FormulaNote { code: "bare-number", text, span: node.span.clone() }
    }

    /// `phi*pi/180` of an angle in degrees, `p/100` and `c*100/p` of per cent.
    fn converted_twice(&self, node: &Node, unit: &Unit) -> FormulaNote {
        let quoted = self.quoted(&node.span);
        let (code, text) = if unit.is_relative() {
            let text = format!(
                "`{quoted}` converts from {unit} once more: formulas have a share in {unit} as a plain \
                 number already, so that its name is enough"
            );
            (SHARE_TWICE, text)
        } else if !unit.dimension().is_none() {
            let text = format!(
                "`{quoted}` converts to radians per second once more: formulas have what is given in \
                 {unit} in radians per second already, so that its name is enough"
            );
            ("rate-converted-twice", text)
        } else {
            let text = format!(
                "`{quoted}` converts to radians once more: formulas have an angle in {unit} in radians \
                 already, so that its name is enough"
            );
            ("angle-converted-twice", text)
        };
        FormulaNote { code, text, span: node.span.clone() }
    }

    /// `(a - b)/b*100` that is reported in %.
    fn result(&self, node: &Node, of: &Scaled<'_>, unit: &Unit) -> Option<FormulaNote> {
        let is_product = matches!(
            node.kind,
            Kind::Infix { operator: Operator::Multiply | Operator::Divide, .. }
        );
        // a share, an angle, or a ratio of like units: mV/V
        let is_scaled = unit.level_exponent().is_zero() && unit.turn() != Some(Turn::Periods);
        let is_inverse = |factor: &f64| (factor.abs() * unit.factor() - 1.0).abs() < SAME_FACTOR;
        // among other numbers one that is it, or all of them together
        let is_once = is_inverse(&of.factor) || self.factors(node).iter().any(is_inverse);
        if !is_product || !is_scaled || !unit.dimension().is_none() || unit.factor() == 1.0 {
            return None;
        }
        let text = format!(
            "`{}` converts to {unit}, and so does the output in {unit}, once more: formulas compute \
             {}; leave the factor out, or give the output without a unit",
            self.quoted(&node.span),
            match unit.turn() {
                Some(_) => "angles in radians",
                None if unit.is_relative() => "shares as plain numbers",
                None => "ratios as plain numbers",
            },
        );
        is_once.then(|| FormulaNote {
            code: "result-converted-twice",
            text,
            span: node.span.clone(),
        })
    }

    /// The plain numbers that a product is multiplied by.
    fn factors(&self, node: &Node) -> Vec<f64> {
        let mut found = Vec::new();
        let mut rest = vec![node];
        while let Some(Node { kind: Kind::Infix { operator, left, right, .. }, .. }) = rest.pop() {
            let numerators: &[usize] = match operator {
                Operator::Multiply => &[*left, *right],
                Operator::Divide => &[*left],
                _ => &[],
            };
            for &index in numerators {
                match self.constant(index) {
                    Some(value) => found.push(value),
                    None => rest.extend(self.tree.nodes.get(index)),
                }
            }
        }
        found
    }

    /// What the numbers of a node are in; a note where pi/180, 1/100 or 2 pi converts what formulas
    /// have converted already.
    fn scaled<'u>(
        &self,
        node: &Node,
        scaled: &[Scaled<'u>],
        unit_of: &impl Fn(&str) -> Option<&'u Unit>,
    ) -> (Scaled<'u>, Option<FormulaNote>) {
        let of = |index: usize| scaled.get(index).copied().unwrap_or(Scaled::UNKNOWN);
        let is_constant = |index: usize| self.constant(index).is_some();
        let product = |left: Scaled<'u>, right: Scaled<'u>, bare: bool| {
            if left.unit.is_some() && right.unit.is_some() {
                return Scaled::UNKNOWN;
            }
            let unit = left.unit.or(right.unit);
            let is_divisor = left.is_divisor || right.is_divisor;
            let factor = left.factor * right.factor;
            let is_bare = bare && unit.is_some() && !is_divisor;
            Scaled { unit, factor, is_bare, is_divisor, square: None }
        };
        let found = match &node.kind {
            Kind::Name => {
                let unit = self.text.get(node.span.clone()).and_then(unit_of);
                unit.map_or(Scaled::UNKNOWN, Scaled::of)
            }
            Kind::Negate(x) => of(*x),
            Kind::Unit(unit) => Scaled { factor: plain_factor(unit), ..Scaled::UNKNOWN },
            // a quantity of its own is no factor
            Kind::InUnit { unit, .. } if !unit.dimension().is_none() => Scaled::UNKNOWN,
            Kind::InUnit { number, unit } => {
                let number = of(*number);
                Scaled { factor: number.factor * plain_factor(unit), ..number }
            }
            Kind::Infix { operator, left, right, .. } => match operator {
                Operator::Add | Operator::Subtract => {
                    let sides = [of(*left), of(*right)].into_iter();
                    let square = sides.clone().find_map(|side| side.square);
                    let square = square.filter(|_| *operator == Operator::Add);
                    let sum = sides.rev().rfind(|side| side.is_bare);
                    sum.unwrap_or(Scaled { square, ..Scaled::UNKNOWN })
                }
                Operator::Multiply => {
                    let (x, y) = (of(*left), of(*right));
                    let bare =
                        (x.is_bare && is_constant(*right)) || (y.is_bare && is_constant(*left));
                    product(x, y, bare)
                }
                Operator::Divide => {
                    let (x, y) = (of(*left), of(*right));
                    let is_divisor = y.unit.is_some() && !y.is_divisor;
                    let inverse = Scaled { factor: 1.0 / y.factor, is_divisor, ..y };
                    product(x, inverse, x.is_bare && is_constant(*right))
                }
                Operator::Power if self.constant(*right) == Some(2.0) => {
                    let square = of(*left).bare_unit().map(|unit| (*left, unit));
                    Scaled { square, ..Scaled::UNKNOWN }
                }
                _ => Scaled::UNKNOWN,
            },
            _ => Scaled::UNKNOWN,
        };
        let found = match self.constant(scaled.len()) {
            Some(value) => Scaled { factor: value, ..Scaled::UNKNOWN },
            None => found,
        };
        let operands = match &node.kind {
            Kind::Infix { left, right, .. } => vec![*left, *right],
            Kind::InUnit { number, .. } => vec![*number],
            _ => Vec::new(),
        };
        // one note for a chain of factors
        let is_new = !operands.is_empty() && !operands.iter().any(|&index| of(index).converts());
        let unit = found.unit.filter(|_| is_new && found.converts());
        (found, unit.map(|unit| self.converted_twice(node, unit)))
    }
}

/// What a unit without a dimension is as a plain number.
fn plain_factor(unit: &Unit) -> f64 {
    if unit.dimension().is_none() { unit.factor() } else { 1.0 }
}
