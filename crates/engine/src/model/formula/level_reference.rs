//! What a level is above, by the argument of the logarithm that makes it: 1 mW in
//! `10*log10(P/[mW])`, 2 mW in `10*log10(P/2 [mW])`, nothing in `20*log10(V2/V1)`; and whether the
//! quantity that `10^(L/10)` of a level is multiplied by is its reference.

use super::dimension::Checker;
use super::function::Function;
use super::scale_fault::ScaleFault;
use super::syntax::{NodeKind, Operator};
use super::typing::{LevelReference, Typing};
use crate::number::Unary;
use gumption_units::{Dimension, Unit, Zero};

/// The dimensions of power, of voltage, and of its square.
const POWER: Dimension = Dimension::of([1, 2, -3, 0, 0, 0, 0]);
const VOLTAGE: Dimension = Dimension::of([1, 2, -3, -1, 0, 0, 0]);
const SQUARED_VOLTAGE: Dimension = Dimension::of([2, 4, -6, -2, 0, 0, 0]);

/// A quantity that is written out, in coherent SI units.
#[derive(Clone, Copy)]
struct WrittenQuantity {
    dimension: Dimension,
    value: f64,
}

/// The divisors of a level's argument.
struct Divisors {
    /// Those that are written out.
    written: Vec<WrittenQuantity>,
    /// Whether a quantity with a dimension is among them that is not.
    quantity: bool,
    /// Whether the argument is a number that is the ratio of two quantities.
    ratio: bool,
    /// Whether all of the argument is written out.
    constant: bool,
}

impl LevelReference {
    /// Of a level times a plain number: an average of levels may still come of it.
    pub(super) fn scaled(self) -> Self {
        match self {
            Self::Ratio | Self::Other => self,
            Self::Unknown | Self::Above(_) | Self::Added => Self::Unknown,
        }
    }

    /// Of a sum or a product of a plain number with another one, which no reference is known of.
    fn beside(self, other: Typing) -> Self {
        match self {
            Self::Above(_) if other.dimension == Some(Dimension::NONE) => self,
            _ => Self::Unknown,
        }
    }

    /// Of a product of plain numbers: `10^(L/10)` times a gain is above what L is above.
    pub(super) fn of_product(x: Typing, y: Typing) -> Self {
        match (x.reference, y.reference) {
            (Self::Above(_), Self::Above(_)) => Self::Unknown,
            (Self::Above(_), _) => x.reference.beside(y),
            (_, Self::Above(_)) => y.reference.beside(x),
            _ => Self::Unknown,
        }
    }

    /// Of a sum of plain numbers of one reference.
    pub(super) fn of_numbers(x: Typing, y: Typing) -> Self {
        match (x.reference, y.reference) {
            (Self::Above(a), Self::Above(b)) if a == b => Self::Above(a),
            (Self::Ratio, Self::Ratio) => Self::Ratio,
            _ => Self::Unknown,
        }
    }

    /// Of a sum of levels: what one of them is, beside one that is above nothing.
    pub(super) fn of_sum(sign: f64, x: Typing, y: Typing) -> Self {
        use LevelReference::{Above, Added, Other, Ratio, Unknown};
        let is_difference = sign < 0.0;
        match (x.reference, y.reference) {
            (Added, _) | (_, Added) => Added,
            (Ratio, Ratio) => Ratio,
            (Above(_), Above(_)) | (Other, Other) if is_difference => Ratio,
            (Other, Other | Ratio) => Other,
            (Ratio, Other) if !is_difference => Other,
            (Above(zero), Ratio | Unknown) if y.zero.is_none() => Above(zero),
            (Ratio | Unknown, Above(zero)) if x.zero.is_none() && !is_difference => Above(zero),
            _ => Unknown,
        }
    }
}

impl Checker<'_> {
    /// What a level is above that is the product of a factor and a logarithm.
    pub(super) fn reference_of_level(&self, left: usize, right: usize) -> LevelReference {
        let (factor, logarithm) = match self.constant(left) {
            Some(factor) => (Some(factor.abs()), right),
            None => (self.constant(right).map(f64::abs), left),
        };
        match self.kind(logarithm) {
            Some(NodeKind::Call { arguments, .. }) => {
                arguments.first().map_or(LevelReference::Unknown, |&argument| {
                    self.reference_of_argument(factor, argument)
                })
            }
            _ => LevelReference::Unknown,
        }
    }

    /// What `10^(L/10)` and `10^(L/20)` give: a number that is above what L is above.
    pub(super) fn number_of_level(&mut self, exponent: usize) -> Typing {
        let Some((level, divisor)) = self.divided(exponent) else { return Typing::NUMBER };
        let typing = self.settled(level);
        let reference = match typing.zero {
            Some(zero) => LevelReference::Above(zero),
            None => typing.reference,
        };
        match reference {
            LevelReference::Above(zero) if is_of_kind(zero, divisor) => {
                Typing { reference, ..Typing::NUMBER }
            }
            _ => Typing::NUMBER,
        }
    }

    /// A quantity and the constant that it is divided by, if it is one: `L/10`, `0.1*L`.
    fn divided(&self, index: usize) -> Option<(usize, Option<f64>)> {
        match self.kind(index)? {
            NodeKind::Infix { operator: Operator::Divide, left, right, .. } => {
                Some((*left, self.constant(*right)))
            }
            NodeKind::Infix { operator: Operator::Multiply, left, right, .. } => {
                let (of, factor) = match self.constant(*left) {
                    Some(factor) => (*right, Some(factor)),
                    None => (*left, self.constant(*right)),
                };
                Some((of, factor.map(|factor| 1.0 / factor)))
            }
            _ => None,
        }
    }

    /// Refuses plain numbers together of which each is above another reference.
    pub(super) fn refuse_other_references(
        &mut self,
        operator: &'static str,
        index: usize,
        [left, right]: [usize; 2],
    ) {
        let (x, y) = (self.typing(left), self.typing(right));
        let are_numbers = x.level.is_zero() && y.level.is_zero();
        if let (LevelReference::Above(a), LevelReference::Above(b)) = (x.reference, y.reference)
            && a != b
            && are_numbers
        {
            let texts = [left, right].map(|part| self.quoted(part));
            self.fault(index, ScaleFault::OtherReferences { operator, texts, zeros: [a, b] });
        }
    }

    /// A number with what is known of levels of it: that they are above nothing, if it is the ratio of
    /// two quantities.
    pub(super) fn with_ratio(&self, index: usize, typing: Typing) -> Typing {
        let is_number = typing == Typing::NUMBER;
        match self.divisors(index) {
            divisors if is_number && self.is_ratio(index, &divisors) => {
                Typing { reference: LevelReference::Ratio, ..typing }
            }
            _ => typing,
        }
    }

    fn reference_of_argument(&self, factor: Option<f64>, argument: usize) -> LevelReference {
        if let LevelReference::Above(zero) = self.typing(argument).reference {
            return match is_of_kind(zero, factor) {
                true => LevelReference::Above(zero),
                false => LevelReference::Unknown,
            };
        }
        let divisors = self.divisors(argument);
        let references: Vec<WrittenQuantity> =
            divisors.written.iter().copied().filter(|of| is_reference(of.dimension)).collect();
        match (factor, references.as_slice()) {
            // a number of decibels
            _ if divisors.constant => LevelReference::Unknown,
            (Some(factor), [one]) => above(factor, *one),
            (_, [_, ..]) => LevelReference::Unknown,
            (_, []) if self.is_ratio(argument, &divisors) => LevelReference::Ratio,
            (_, []) if self.names_reference(argument) => LevelReference::Unknown,
            (_, []) if !divisors.written.is_empty() => LevelReference::Other,
            (_, []) => LevelReference::Unknown,
        }
    }

    /// Whether a number is the ratio of two quantities, neither of which is a power or a voltage that
    /// is written out.
    fn is_ratio(&self, index: usize, divisors: &Divisors) -> bool {
        (divisors.quantity || divisors.ratio) && !self.names_reference(index)
    }

    /// What a product or a quotient is divided by.
    fn divisors(&self, index: usize) -> Divisors {
        let mut found =
            Divisors { written: Vec::new(), quantity: false, ratio: false, constant: true };
        let mut left = vec![(index, false)];
        while let Some((index, divides)) = left.pop() {
            if self.constant(index).is_some() {
                continue;
            }
            if let Some(written) = self.written(index) {
                found.written.extend(divides.then_some(written));
                continue;
            }
            match self.kind(index) {
                Some(NodeKind::Infix {
                    operator: Operator::Multiply, left: a, right: b, ..
                }) => {
                    left.extend([(*a, divides), (*b, divides)]);
                }
                Some(NodeKind::Infix { operator: Operator::Divide, left: a, right: b, .. }) => {
                    left.extend([(*a, divides), (*b, !divides)]);
                }
                Some(NodeKind::Negate(x)) => left.push((*x, divides)),
                Some(NodeKind::Call {
                    function: Some(Function::One(Unary::Abs)),
                    arguments,
                    ..
                }) => {
                    left.extend(arguments.first().map(|&x| (x, divides)));
                }
                _ => {
                    found.constant = false;
                    let typing = self.typing(index);
                    let is_number = typing.dimension.is_none_or(|of| of.is_none());
                    found.quantity |= divides && !is_number;
                    found.ratio |= is_number
                        && typing.level.is_zero()
                        && typing.reference == LevelReference::Ratio;
                }
            }
        }
        found
    }

    /// Refuses a factor that is one unit of the kind of a level's reference and not that reference, as
    /// in `10^(L/10)*1 [W]` of a level in dBm.
    pub(super) fn refuse_other_reference(&mut self, index: usize, [left, right]: [usize; 2]) {
        for (power, quantity) in [(left, right), (right, left)] {
            let is_one = match self.kind(quantity) {
                Some(NodeKind::Unit(_)) => true,
                Some(NodeKind::InUnit { number, .. }) => self.constant(*number) == Some(1.0),
                _ => false,
            };
            if let Some(written) = self.written(quantity).filter(|_| is_one) {
                let quantity = self.quoted(quantity);
                self.refuse_if_other(index, power, written, quantity);
            }
        }
    }

    /// Refuses the unit of a level's number that is of the kind of its reference and not that reference,
    /// as in `(10^(L/10)) [W]` of a level in dBm.
    pub(super) fn refuse_unit_of_level(&mut self, index: usize, number: usize, unit: &Unit) {
        let written = WrittenQuantity { dimension: unit.dimension(), value: unit.factor() };
        self.refuse_if_other(index, number, written, format!("1 [{unit}]"));
    }

    fn refuse_if_other(
        &mut self,
        index: usize,
        power: usize,
        written: WrittenQuantity,
        quantity: String,
    ) {
        let Some((level, zero, divisor)) = self.taken_away(power) else { return };
        let is_of_kind = match (zero, divisor) {
            (Zero::Milliwatt | Zero::Watt, _) => written.dimension == POWER,
            (Zero::Volt | Zero::Millivolt | Zero::Microvolt, 10.0) => {
                [VOLTAGE, SQUARED_VOLTAGE].contains(&written.dimension)
            }
            (Zero::Volt | Zero::Millivolt | Zero::Microvolt, _) => written.dimension == VOLTAGE,
            _ => false,
        };
        if is_of_kind && above(divisor, written) != LevelReference::Above(zero) {
            let level = self.quoted(level);
            self.fault(index, ScaleFault::OtherReference { level, zero, quantity });
        }
    }

    /// The name of a level in `10^(L/10)` or `10^(L/20)`, its zero and the divisor.
    fn taken_away(&self, index: usize) -> Option<(usize, Zero, f64)> {
        let NodeKind::Infix { operator: Operator::Power, left, right, .. } = self.kind(index)?
        else {
            return None;
        };
        let (level, divisor) = self.divided(*right)?;
        let divisor = divisor.filter(|divisor| matches!(*divisor, 10.0 | 20.0))?;
        let is_taken = self.constant(*left) == Some(10.0);
        let zero = self.typing(level).zero.filter(|_| is_taken)?;
        (self.kind(level)? == &NodeKind::Name).then_some((level, zero, divisor))
    }

    /// Whether a node is a quantity that is written out.
    pub(super) fn is_written_out(&self, index: usize) -> bool {
        self.written(index).is_some()
    }

    /// A quantity that is written out: `[mW]`, `2 [mW]`, `2*[mW]`.
    fn written(&self, index: usize) -> Option<WrittenQuantity> {
        match self.kind(index)? {
            NodeKind::Unit(unit) => {
                Some(WrittenQuantity { dimension: unit.dimension(), value: unit.factor() })
            }
            NodeKind::InUnit { number, unit } => Some(WrittenQuantity {
                dimension: unit.dimension(),
                value: self.constant(*number)? * unit.factor(),
            }),
            NodeKind::Infix { operator: Operator::Multiply, left, right, .. } => {
                let (number, of) = match self.constant(*left) {
                    Some(number) => (number, *right),
                    None => (self.constant(*right)?, *left),
                };
                let of = self.written(of)?;
                Some(WrittenQuantity { value: number * of.value, ..of })
            }
            _ => None,
        }
    }

    /// Whether a power or a voltage is written out anywhere in a part of the formula.
    fn names_reference(&self, index: usize) -> bool {
        let whole = self.tree.span(index);
        self.tree.nodes.iter().any(|node| {
            let inside = whole.start <= node.span.start && node.span.end <= whole.end;
            let unit = match &node.kind {
                NodeKind::Unit(unit) | NodeKind::InUnit { unit, .. } => Some(unit),
                _ => None,
            };
            inside && unit.is_some_and(|unit| is_reference(unit.dimension()))
        })
    }

    fn kind(&self, index: usize) -> Option<&NodeKind> {
        self.tree.nodes.get(index).map(|node| &node.kind)
    }
}

/// Whether levels above a reference are so many times the decimal logarithm.
fn is_of_kind(zero: Zero, factor: Option<f64>) -> bool {
    factor.is_some_and(|factor| zero.decibels_per_decade().map(f64::from) == Some(factor))
}

/// Whether levels can be above a quantity of that dimension.
fn is_reference(dimension: Dimension) -> bool {
    [POWER, VOLTAGE, SQUARED_VOLTAGE].contains(&dimension)
}

/// What `factor*log10(x/reference)` is above: a power with the factor 10, a voltage with 20, or its
/// square with 10.
fn above(factor: f64, reference: WrittenQuantity) -> LevelReference {
    let WrittenQuantity { dimension, value } = reference;
    let zero = match (dimension, factor) {
        (POWER, 10.0) | (VOLTAGE, 20.0) => Zero::above(dimension, value),
        (SQUARED_VOLTAGE, 10.0) => Zero::above(VOLTAGE, value.sqrt()),
        _ => None,
    };
    zero.map_or(LevelReference::Other, LevelReference::Above)
}
