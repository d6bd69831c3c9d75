//! Numbers without a unit beside what formulas have in radians or as a share: `phi + 90`, `mod(a, 360)`,
//! and functions that round to whole radians.

use std::f64::consts::{FRAC_PI_4, TAU};

use super::function::Function;
use super::note::{FormulaNote, Walk};
use super::numbers::{Scaled, Use};
use super::syntax::{Node, NodeKind, Operator};
use crate::fact;
use crate::fact::Fact;
use crate::number::{Binary, Shortest, Unary};
use gumption_units::{Turn, Unit};

/// Beside an angle in degrees, smaller numbers are hardly degrees.
const SMALLEST_ANGLE: f64 = 0.01;

/// Beside a share, of which one chooses the larger, smaller numbers may be shares.
const LARGEST_SHARE: f64 = 0.1;

/// What a plain number stands beside.
#[derive(Clone, Copy)]
enum Neighbour<'u> {
    /// What is given in a unit.
    Unit(&'u Unit),
    /// An angle that a function gives.
    Angle,
}

impl<'u> Neighbour<'u> {
    fn of(scaled: Scaled<'u>) -> Option<Self> {
        let angle = || scaled.is_in_radians().then_some(Self::Angle);
        scaled.bare_unit().map(Self::Unit).or_else(angle)
    }

    fn unit(self) -> Option<&'u Unit> {
        match self {
            Self::Unit(unit) => Some(unit),
            Self::Angle => None,
        }
    }

    fn is_angle(self) -> bool {
        self.unit().is_none_or(|unit| unit.turn().is_some())
    }
}

impl<'u> Walk<'_, 'u> {
    /// The notes on a node about numbers without units.
    pub(super) fn of_node(&self, node: &Node) -> Option<FormulaNote> {
        match &node.kind {
            NodeKind::Infix { operator, left, right, .. } => {
                let is_factor =
                    matches!(operator, Operator::Multiply | Operator::Divide | Operator::Power);
                if is_factor { None } else { self.in_sum(node, *operator, [*left, *right]) }
            }
            NodeKind::Call { function: Some(function), arguments, .. } => {
                self.in_call(node, *function, arguments)
            }
            _ => None,
        }
    }

    fn in_call(&self, node: &Node, function: Function, arguments: &[usize]) -> Option<FormulaNote> {
        match (function, arguments) {
            (Function::Fold(Binary::Min | Binary::Max | Binary::Hypot), _) => {
                self.among(node, function, arguments)
            }
            (Function::If, [_, branches @ ..]) => self.among(node, function, branches),
            (Function::Two(Binary::Modulo), [of, period]) => self.period(node, *of, *period),
            (Function::One(Unary::Round | Unary::Floor | Unary::Ceil), [of]) => {
                self.rounded(node, function, *of)
            }
            (_, [angle]) if function.takes_angle() => {
                self.turns(node, function, *angle).or_else(|| self.degrees(node, function, *angle))
            }
            _ => None,
        }
    }

    /// `sin(30)`, which is of 30 rad.
    fn turns(&self, node: &Node, function: Function, argument: usize) -> Option<FormulaNote> {
        let angle = self.constant(argument).filter(|angle| angle.abs() > TAU)?;
        let is_told = angle.is_finite() && !self.has_pi(argument);
        is_told.then(|| {
            let (function, angle) = (function.name(), self.slice(argument));
            FormulaNote::at(node, fact!("angle-of-turns.constant", function, angle))
        })
    }

    /// `sin(t)` of a number of degrees, `t = atan(x)*180/pi`.
    fn degrees(&self, node: &Node, function: Function, argument: usize) -> Option<FormulaNote> {
        self.scaled(argument).counts_degrees().then(|| {
            let (function, argument) = (function.name(), self.quoted(&self.tree.span(argument)));
            FormulaNote::at(node, fact!("angle-converted-twice.degrees", function, argument))
        })
    }

    /// `phi + 90` of an angle in degrees, `p < 5` of per cent.
    fn in_sum(
        &self,
        node: &Node,
        operator: Operator,
        [left, right]: [usize; 2],
    ) -> Option<FormulaNote> {
        let (at, name) = match (self.written(left), self.written(right)) {
            (Some(_), None) => (left, right),
            (None, Some(_)) => (right, left),
            _ => return None,
        };
        let of = self.scaled(name);
        let square = of.square.filter(|_| operator == Operator::Add);
        let square = square.map(|(name, unit)| (name, Neighbour::Unit(unit)));
        let is_square = square.is_some();
        let (name, beside) = square.or_else(|| Some((name, Neighbour::of(of)?)))?;
        // `3^2`, or 9, beside the square of a quantity
        let number = match is_square {
            true => self.written(at).filter(|square| *square >= 0.0)?.sqrt(),
            false => self.written(at)?,
        };
        // an estimate of per cent that begins with its condition is no whole beside a share
        let is_estimate = matches!(self.of, Use::Estimate(unit) if unit.is_relative());
        let is_first = at == left;
        // and no width is the whole
        let is_whole = Self::is_whole(number, beside.unit(), is_first)
            && (is_first || !is_estimate)
            && self.of != Use::Width;
        // what a function gives is in radians for whoever reads only this
        let is_small = beside.unit().is_none() && number.abs() <= TAU && !self.is_result(node);
        // 0.622 beside a mixing ratio in g/kg is a ratio itself
        let is_ratio = beside.unit().is_some_and(is_ratio) && number.abs() <= 1.0;
        if number == 0.0 || is_whole || is_small || is_ratio || self.has_pi(at) {
            return None;
        }
        Some(self.number_beside(node, number, (name, beside)))
    }

    /// Whether a node is the whole of an angle that is reported in degrees or the like.
    fn is_result(&self, node: &Node) -> bool {
        let is_whole = self.tree.nodes.last().is_some_and(|last| last.span == node.span);
        is_whole && self.unit_of_result().is_some()
    }

    /// The unit of angle, not the radian, that the value is reported or given in.
    fn unit_of_result(&self) -> Option<&'u Unit> {
        let unit = match self.of {
            Use::Output(unit) | Use::Estimate(unit) => Some(unit),
            Use::Quantity | Use::Width => None,
        };
        unit.filter(|unit| {
            unit.turn() == Some(Turn::Angle) && unit.dimension().is_none() && unit.factor() != 1.0
        })
    }

    /// `min(p, 100)` of per cent: a number that is far from every share and angle.
    fn among(&self, node: &Node, function: Function, parts: &[usize]) -> Option<FormulaNote> {
        let beside = |index: &usize| Some((*index, Neighbour::of(self.scaled(*index))?));
        let (name, beside) = parts.iter().find_map(beside)?;
        let is_width = matches!(self.of, Use::Width | Use::Estimate(_));
        // the legs of a triangle are added, of which every number is wrong
        let most = match (function, beside.is_angle()) {
            (Function::Fold(Binary::Hypot), _) if beside.unit().is_some() => 0.0,
            // an estimate and its width are in the unit that is declared beside them
            (_, true) if is_width && beside.unit().is_some() => SMALLEST_ANGLE,
            (_, true) => TAU,
            (_, false) if beside.unit().is_some_and(is_ratio) => 1.0,
            (_, false) => LARGEST_SHARE,
        };
        // a share is 1 at most, and a width is no whole
        let is_limit = |number: f64| number.abs() == 1.0 && self.of != Use::Width;
        let is_far = |number: &f64| {
            number.abs() > most && !is_limit(*number) && !(beside.is_angle() && is_of_turn(*number))
        };
        let numbers = parts.iter().filter(|index| !self.has_pi(**index));
        let number = numbers.filter_map(|index| self.written(*index)).find(is_far)?;
        Some(self.number_beside(node, number, (name, beside)))
    }

    /// `mod(a, 360)` of an angle in degrees, which is modulo 360 rad.
    fn period(&self, node: &Node, of: usize, period: usize) -> Option<FormulaNote> {
        let number = self.constant(period).filter(|number| *number != 0.0)?;
        let beside = Neighbour::of(self.scaled(of))?;
        let is_share_of_whole = number.abs() == 1.0 && !beside.is_angle();
        let is_of_radians = beside.is_angle() && (self.has_pi(period) || is_of_turn(number));
        let is_small = beside.unit().is_none() && number.abs() <= TAU;
        let is_told = !is_share_of_whole && !is_of_radians && !is_small;
        is_told.then(|| self.number_beside(node, number, (of, beside)))
    }

    /// `round(a)` of an angle in degrees, which is to whole radians.
    fn rounded(&self, node: &Node, function: Function, of: usize) -> Option<FormulaNote> {
        let scaled = self.scaled(of);
        let beside = Neighbour::of(scaled)?;
        let unit = beside.unit().or_else(|| self.unit_of_result())?;
        // `floor(1000*p)/1000` is of plain numbers, and right
        let is_plain = match beside.is_angle() {
            true => is_decimal(scaled.factor) && !self.has_pi(of),
            false => scaled.factor.abs() == 1.0,
        };
        let (name, quoted) = (function.name(), self.quoted(&self.tree.span(of)));
        is_plain.then(|| {
            let formula = self.quoted(&node.span);
            let meant = format!("{name}({quoted}/[{unit}])*[{unit}]");
            let fact = match beside.is_angle() {
                true => fact!("rounded-as-number.radians", formula, unit, meant),
                false => fact!("rounded-as-number", formula, unit, meant),
            };
            FormulaNote::at(node, fact)
        })
    }

    /// Says of a number what it is beside a quantity of that unit.
    fn number_beside(
        &self,
        node: &Node,
        number: f64,
        (name, beside): (usize, Neighbour<'_>),
    ) -> FormulaNote {
        let (formula, quantity) = (self.quoted(&node.span), self.quoted(&self.tree.span(name)));
        let in_unit = |unit: &str| format!("{} [{unit}]", Shortest(number));
        let fact = match beside {
            Neighbour::Unit(unit) => {
                let (given, meant) = (self.given(name, unit), in_unit(unit.text()));
                match unit.turn() {
                    Some(_) => {
                        fact!("bare-number.radians", formula, number, quantity, given, unit, meant)
                    }
                    None => {
                        let converted = unit.from_si(number);
                        fact!(
                            "bare-number",
                            formula,
                            number,
                            converted,
                            quantity,
                            given,
                            unit,
                            meant
                        )
                    }
                }
            }
            Neighbour::Angle => {
                let unit = self.unit_of_result().map_or("deg", Unit::text);
                let meant = in_unit(unit);
                fact!("bare-number.angle", formula, number, quantity, unit, meant)
            }
        };
        FormulaNote::at(node, fact)
    }

    /// How a quantity comes to its unit.
    fn given(&self, name: usize, unit: &Unit) -> Fact {
        match self.scaled(name).is_computed {
            true => fact!("beside.computed", unit),
            false => fact!("beside.given", unit),
        }
    }
}

/// Whether a unit is a ratio of like units, `mV/V`, and no share.
fn is_ratio(unit: &Unit) -> bool {
    unit.turn().is_none() && !unit.is_relative()
}

/// Whether a number is a multiple of pi/4 but for the digits that somebody wrote.
fn is_of_turn(number: f64) -> bool {
    let eighths = number / FRAC_PI_4;
    let whole = eighths.round();
    (1.0..=8.0).contains(&whole.abs()) && (eighths - whole).abs() < 2e-3 * whole.abs()
}

/// Whether a factor is a whole number or one over a whole number.
fn is_decimal(factor: f64) -> bool {
    let is_whole = |x: f64| (x - x.round()).abs() < 1e-9 * x && (1.0..=1e6).contains(&x.round());
    is_whole(factor.abs()) || is_whole(1.0 / factor.abs())
}
