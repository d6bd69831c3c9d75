//! Rates that are given in revolutions and count radians in formulas, and periods that are taken for
//! radians.

use std::f64::consts::{FRAC_PI_4, PI, TAU};

use super::dimension::check;
use super::function::Function;
use super::note::{FormulaNote, Walk};
use super::note_result::terms;
use super::numbers::{Use, is_same_factor};
use super::syntax::{Node, NodeKind, Tree};
use super::typing::{RATE, Scope, Typing};
use crate::fact;
use crate::number::Unary;
use gumption_units::{Dimension, Exponent, Turn, Unit};

/// What a machine moves in a revolution: volume, mass, amount, charge.
const DISPLACED: [Dimension; 4] = [
    Dimension::of([0, 3, 0, 0, 0, 0, 0]),
    Dimension::MASS,
    Dimension::AMOUNT,
    Dimension::of([0, 0, 1, 1, 0, 0, 0]),
];

/// What a volume is multiplied by to give a mass or an amount.
const DENSITIES: [Dimension; 2] =
    [Dimension::of([1, -3, 0, 0, 0, 0, 0]), Dimension::of([0, -3, 0, 0, 0, 1, 0])];

/// What stands beside pi and a diameter: minutes and millimetres.
const BESIDE_PI: [f64; 4] = [1.0, 1.0 / 60.0, 1e-3, 1.0 / 60e3];

/// A term of the value that multiplies what is per revolution by a rate in radians.
pub(super) fn of_revolutions(text: &str, tree: &Tree, scope: &Scope) -> Option<FormulaNote> {
    let walk = Walk::new(text, tree, |_| None, Use::Quantity);
    let typings = check(text, tree, scope, true).typings;
    let is_wrong = |node: &&Node| Product::of(&walk, node, &typings).is_per_revolution();
    let terms = terms(tree, &walk.constants).into_iter().filter(|term| !term.is_factor);
    let node = terms.filter_map(|term| tree.nodes.get(term.index)).find(is_wrong)?;
    let formula = walk.quoted(&node.span);
    Some(FormulaNote::at(node, fact!("radians-of-turns.product", formula)))
}

/// Functions of angles of what counts periods.
pub(super) fn periods<'u>(
    text: &str,
    tree: &Tree,
    scope: &Scope,
    unit_of: impl Fn(&str) -> Option<&'u Unit>,
) -> Vec<FormulaNote> {
    let calls = || tree.nodes.iter().filter_map(|node| Some((node, taken_as_angle(node)?)));
    if calls().next().is_none() {
        return Vec::new();
    }
    let walk = Walk::new(text, tree, |_| None, Use::Quantity);
    let typings = check(text, tree, scope, true).typings;
    let found = calls().filter_map(|(node, (function, argument))| {
        let typing = typings.get(argument)?;
        let counts_periods =
            typing.turn == Some(Turn::Periods) && typing.dimension == Some(Dimension::NONE);
        let is_wrong = counts_periods && is_of_periods(&walk, argument, scope, function, &unit_of);
        is_wrong.then(|| {
            let (function, argument) = (function.name(), walk.quoted(&tree.span(argument)));
            FormulaNote::at(node, fact!("periods-as-radians", function, argument))
        })
    });
    found.collect()
}

/// The argument that a function may take for an angle.
fn taken_as_angle(node: &Node) -> Option<(Function, usize)> {
    let NodeKind::Call { function: Some(function), arguments, .. } = &node.kind else {
        return None;
    };
    let is_exp = *function == Function::One(Unary::Exp);
    match arguments.as_slice() {
        [argument] if function.takes_angle() || is_exp => Some((*function, *argument)),
        _ => None,
    }
}

/// Whether an argument is a product of a name in Hz and of others that are given, without a factor of pi;
/// what is computed may have that. `exp` takes an angle times the imaginary unit.
fn is_of_periods<'u>(
    walk: &Walk<'_, '_>,
    argument: usize,
    scope: &Scope,
    function: Function,
    unit_of: &impl Fn(&str) -> Option<&'u Unit>,
) -> bool {
    let Some(node) = walk.tree.nodes.get(argument) else { return false };
    let (mut factor, mut of_periods, mut is_imaginary) = (1.0, false, false);
    for (index, is_divided) in walk.operands(node) {
        if let Some(number) = walk.constant(index) {
            factor *= if is_divided { 1.0 / number } else { number };
            continue;
        }
        let name = walk.slice(index);
        match (walk.node(index), unit_of(name)) {
            (Some(NodeKind::Name), Some(unit)) => of_periods |= unit.turn() == Some(Turn::Periods),
            (Some(NodeKind::Name), None) if name == "i" && scope.is_complex(name) => {
                is_imaginary = true;
            }
            (Some(NodeKind::InUnit { .. } | NodeKind::Unit(_)), _) => {}
            _ => return false,
        }
    }
    let eighths = factor / FRAC_PI_4;
    let has_pi = (eighths - eighths.round()).abs() < 5e-3 * eighths.abs() && eighths.round() != 0.0;
    of_periods && !has_pi && (is_imaginary || function.takes_angle())
}

/// The factors of a product by what they are.
#[derive(Default)]
struct Product {
    /// The plain number.
    factor: f64,
    has_pi: bool,
    /// Rates that are given in revolutions.
    rates: usize,
    displaced: usize,
    densities: usize,
    lengths: usize,
    /// Plain numbers that are not written out.
    plain: usize,
    /// Factors of other kinds, and divisors that are no plain numbers.
    others: usize,
}

impl Product {
    fn of(walk: &Walk<'_, '_>, node: &Node, typings: &[Typing]) -> Self {
        let mut found = Self { factor: 1.0, ..Self::default() };
        for (index, is_divided) in walk.operands(node) {
            if let Some(number) = walk.constant(index) {
                found.factor *= if is_divided { 1.0 / number } else { number };
                found.has_pi |= walk.has_pi(index);
                continue;
            }
            let typing = typings.get(index).copied().unwrap_or(Typing::ANY);
            *found.count(typing, is_divided) += 1;
        }
        found
    }

    /// What counts the factors of that kind.
    fn count(&mut self, typing: Typing, is_divided: bool) -> &mut usize {
        let Some(dimension) = typing.dimension else { return &mut self.others };
        let is_rate = dimension == RATE
            && typing.angle.of_revolutions
            && typing.angle.exponent == Exponent::ONE;
        if is_rate && !is_divided {
            return &mut self.rates;
        }
        let counts_nothing = typing.angle.exponent.is_zero() && !typing.has_turns;
        if !counts_nothing || is_divided && !dimension.is_none() {
            &mut self.others
        } else if DISPLACED.contains(&dimension) {
            &mut self.displaced
        } else if DENSITIES.contains(&dimension) {
            &mut self.densities
        } else if dimension == Dimension::LENGTH {
            &mut self.lengths
        } else if dimension.is_none() && typing.turn.is_none() {
            &mut self.plain
        } else {
            &mut self.others
        }
    }

    /// Whether it is a volume or the like, or a circumference, times revolutions. A product of a radius
    /// and an area is none, nor is one of a radius: they are right by radians.
    fn is_per_revolution(&self) -> bool {
        if self.rates != 1 || self.others != 0 {
            return false;
        }
        match (self.displaced, self.densities, self.lengths) {
            (1, 0 | 1, 0) => !self.has_pi && !is_same_factor(self.factor * TAU, 1.0),
            (0, 0, 1) => BESIDE_PI.iter().any(|beside| is_same_factor(self.factor, PI * beside)),
            _ => false,
        }
    }
}
