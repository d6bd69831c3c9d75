//! Factors that convert between units beside the conversion of the program: `1000*m/V` of mg and mL that is
//! reported in mg/L, `(I/1000)^2*R` of mA, or a factor in one equation and the units that it converts in
//! another, `n = c*V/1000` of mol/L and mL and `m = n*M` in g. The numbers of a product, those of the equations
//! that it takes up among them, are held against the factor by which the program converts.

use std::f64::consts::{FRAC_1_PI, PI, TAU};

use super::function::Function;
use super::note::{ANGLE_TWICE, FormulaNote, RATE_TWICE, RESULT_TWICE, SHARE_TWICE, Walk};
use super::note_result::{taken_up, terms};
use super::numbers::{Numbers, Use, ValueSource, is_same_factor};
use super::syntax::{Node, NodeKind, Operator};
use super::typing::RATE;
use crate::decimal::{to_15_digits, to_digits};
use crate::fact;
use crate::fact::{Argument, Fact};
use crate::number::elementary::{log10, pow};
use crate::number::{Binary, Shortest, Unary};
use gumption_units::{Turn, Unit};

/// The code of quantities that a product converts to coherent units.
const QUANTITY_TWICE: &str = "quantity-converted-twice";

/// The codes of notes that a note on the whole product has the part of.
const OF_PARTS: [&str; 3] = [SHARE_TWICE, ANGLE_TWICE, RATE_TWICE];

/// The numbers and the units that a value is a product of, through the equations that it takes up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factors {
    /// The product of all plain numbers.
    numbers: f64,
    /// The same without those that are hardly conversions: pi, 2, 9.81.
    conversions: f64,
    /// The coherent value where every quantity is one of its units, without the following.
    size: f64,
    /// That of shares and of angles in degrees, which may have been left to the program.
    shares: f64,
    /// That of what is in revolutions, and their exponent.
    turns: (f64, f64),
    /// The exponent of rates in 1/min and the like, of which the unit says nothing of what they count.
    rates: f64,
    /// How many factors are in units that are not coherent.
    scaled: u32,
    /// How many factors are no plain numbers, in the formula itself.
    own: u32,
    is_linear: bool,
    /// Whether equations have conversions among its numbers.
    of_equations: bool,
    /// Whether a note has told of its numbers.
    is_told: bool,
}

impl Factors {
    const ONE: Self = Self {
        numbers: 1.0,
        conversions: 1.0,
        size: 1.0,
        shares: 1.0,
        turns: (1.0, 0.0),
        rates: 0.0,
        scaled: 0,
        own: 0,
        is_linear: true,
        of_equations: false,
        is_told: false,
    };

    /// A quantity that is in coherent units, or a plain number that is not written out.
    const COHERENT: Self = Self { own: 1, ..Self::ONE };

    fn of_number(number: f64) -> Option<Self> {
        let is_usable = number.is_finite() && number != 0.0;
        is_usable.then(|| Self { numbers: number, conversions: conversion(number), ..Self::ONE })
    }

    /// A quantity in that unit.
    fn in_unit(unit: &Unit) -> Option<Self> {
        let factor = unit.factor();
        let is_scale = unit.level_exponent().is_zero() && (unit.zero().is_none() || factor == 1.0);
        let is_usable = is_scale && factor.is_finite() && factor > 0.0;
        let scaled = u32::from(factor != 1.0);
        let is_plain = unit.dimension().is_none();
        let is_of_angle = unit.turn() == Some(Turn::Angle);
        let of = Self { scaled, ..Self::COHERENT };
        is_usable.then(|| {
            if unit.counts_revolutions() {
                let exponent = unit.angle_exponent().to_f64();
                Self { turns: (factor / pow(TAU, exponent), exponent), ..of }
            } else if is_plain || is_of_angle {
                Self { shares: factor, ..of }
            } else {
                let is_rate = unit.dimension() == RATE && unit.turn().is_none();
                let rates = if is_rate && factor != 1.0 { 1.0 } else { 0.0 };
                Self { size: factor, rates, ..of }
            }
        })
    }

    fn times(self, other: Self) -> Self {
        Self {
            numbers: self.numbers * other.numbers,
            conversions: self.conversions * other.conversions,
            size: self.size * other.size,
            shares: self.shares * other.shares,
            turns: (self.turns.0 * other.turns.0, self.turns.1 + other.turns.1),
            rates: self.rates + other.rates,
            scaled: self.scaled.saturating_add(other.scaled),
            own: self.own.saturating_add(other.own),
            is_linear: self.is_linear && other.is_linear,
            of_equations: self.of_equations || other.of_equations,
            is_told: self.is_told || other.is_told,
        }
    }

    fn to(self, exponent: f64) -> Self {
        let to = |base: f64| pow(base.abs(), exponent);
        Self {
            numbers: to(self.numbers),
            conversions: to(self.conversions),
            size: to(self.size),
            shares: to(self.shares),
            turns: (to(self.turns.0), self.turns.1 * exponent),
            rates: self.rates * exponent,
            is_linear: self.is_linear && exponent.abs() == 1.0,
            ..self
        }
    }

    /// What the units of a sum's terms or of the branches of a choice are, with their conversions, where they
    /// are the same.
    fn alike(self, other: Self) -> Option<Self> {
        let is_same = |of: fn(&Self) -> f64| is_same_factor(of(&self), of(&other));
        let is_alike = is_same(|of| of.size)
            && is_same(|of| of.shares)
            && is_same(|of| of.turns.0)
            && self.turns.1 == other.turns.1
            && is_same(|of| of.conversions);
        is_alike.then_some(Self { numbers: self.conversions, own: 1, ..self })
    }

    /// Whether a factor that converts it is hardly a share of it, as `0.001*U*k` of mV is.
    fn is_sure(&self) -> bool {
        self.scaled > 1 || !self.is_linear || !is_power_of_ten(self.conversions)
    }

    /// Whether it has no conversions, and one size whatever has been left to the program.
    fn has_one_size(&self) -> bool {
        self.conversions == 1.0 && self.shares == 1.0 && self.turns == (1.0, 0.0)
    }

    fn is_finite(&self) -> bool {
        let all = [self.numbers, self.conversions, self.size, self.shares, self.turns.0];
        all.into_iter().all(|factor| factor.is_finite() && factor != 0.0)
    }

    /// What converts from its units to one of that size, by the units that may have been left to the
    /// program. `others` are numbers of which each may be the whole conversion.
    fn converts_to(&self, size: f64, others: &[f64]) -> Option<Converted> {
        let (turns, exponent) = self.turns;
        let shares = if self.shares == 1.0 { vec![1.0] } else { vec![self.shares, 1.0] };
        let turned = match exponent == 0.0 {
            true => vec![turns],
            false => vec![turns * pow(TAU, exponent), turns, 1.0],
        };
        let rest = self.size / size;
        let all = shares.iter().flat_map(|share| turned.iter().map(move |turn| share * turn));
        let own = [self.conversions, self.numbers];
        let has_conversion = |factor: f64| {
            let mut numbers = own.iter().chain(others);
            !is_same_factor(factor, 1.0) && numbers.any(|number| is_same_factor(*number, factor))
        };
        let found = all.map(|of_turns| of_turns * rest).find(|factor| has_conversion(*factor));
        // `T*n/9550` of 1/min has 2 pi in its number
        let by_turns = || {
            let factor = rest * pow(TAU, self.rates);
            let is_of_turns = self.rates != 0.0 && !is_power_of_ten(self.conversions);
            (is_of_turns && is_same_factor(self.numbers, factor)).then_some(factor)
        };
        let has_rest = !is_same_factor(rest, 1.0);
        let converted = |factor, has_turns| Converted { factor, has_rest, has_turns };
        let found = found.map(|factor| converted(factor, false));
        found.or_else(|| by_turns().map(|factor| converted(factor, true)))
    }
}

/// A factor that converts, and whether it does from others than shares, angles and revolutions.
struct Converted {
    factor: f64,
    has_rest: bool,
    /// Whether 2 pi of a rate in 1/min is in it.
    has_turns: bool,
}

/// A factor in six digits, as somebody writes it: 1/60 for 0.0166667.
fn shown(factor: f64) -> Argument {
    let [own, inverse] = [factor, 1.0 / factor].map(|x| Shortest(to_digits(x, 6)).to_string());
    let is_inverse = own.len() > 8 && inverse.len() + 1 < own.len();
    Argument::Number(if is_inverse { format!("1/{inverse}") } else { own })
}

/// What of a number is a conversion: not that of 2, 9.81 or 4 pi; of 4000 it is 1000.
fn conversion(number: f64) -> f64 {
    let size = number.abs();
    let is_of_pi = [PI, FRAC_1_PI, PI * PI].into_iter().any(|pi| {
        let of = size / pi;
        let is_whole = |x: f64| (x - x.round()).abs() < 1e-3 && (1.0..=64.0).contains(&x.round());
        (number.fract() != 0.0) && (is_whole(of) || is_whole(1.0 / of))
    });
    let is_small = (0.05..20.0).contains(&size)
        && !is_power_of_ten(size)
        && !is_same_factor(size, 3.6)
        && !is_same_factor(size * 3.6, 1.0);
    if is_of_pi || is_small || size == 1.0 {
        return 1.0;
    }
    let multiple = [2.0, 4.0, 8.0].into_iter().find(|of| size >= 1e3 && is_power_of_ten(size / of));
    size / multiple.unwrap_or(1.0)
}

fn is_power_of_ten(number: f64) -> bool {
    let power = log10(number.abs());
    (power - power.round()).abs() < 1e-9
}

/// The factors of every node of a formula; `None` of what is no product of what is known. `factors_of` gives
/// those of equations.
pub(super) fn factors<'u>(
    walk: &Walk<'_, 'u>,
    numbers_of: impl Fn(ValueSource<'_>) -> Option<Numbers<'u>>,
    factors_of: impl Fn(&str) -> Option<Factors>,
) -> Vec<Option<Factors>> {
    let mut all: Vec<Option<Factors>> = Vec::with_capacity(walk.tree.nodes.len());
    let given = |source: ValueSource<'_>| match numbers_of(source)? {
        Numbers::Given(unit) => Factors::in_unit(unit),
        Numbers::Unstated => Some(Factors::COHERENT),
        _ => None,
    };
    for (index, node) in walk.tree.nodes.iter().enumerate() {
        let of = |index: &usize| all.get(*index).copied().flatten();
        let alike = |parts: &[usize]| {
            let mut parts = parts.iter().map(of);
            let first = parts.next()??;
            let first = first.alike(first)?;
            parts.try_fold(first, |known, part| known.alike(part?))
        };
        let found = match &node.kind {
            NodeKind::Number(number) => Factors::of_number(*number),
            NodeKind::Pi => Factors::of_number(PI),
            NodeKind::Name => {
                let name = walk.slice(index);
                let of_equation = || {
                    let of = factors_of(name)?;
                    Some(Factors { own: 1, of_equations: of.conversions != 1.0, ..of })
                };
                given(ValueSource::Name(name)).or_else(of_equation)
            }
            NodeKind::Constant(_) => Some(Factors::COHERENT),
            NodeKind::Table { call, .. } => given(ValueSource::TableValue(call)),
            NodeKind::Curve { curve, inverse: false, .. } => given(ValueSource::CurveY(curve)),
            NodeKind::Curve { curve, inverse: true, .. } => given(ValueSource::CurveX(curve)),
            NodeKind::Unit(unit) | NodeKind::InUnit { unit, .. } => Factors::in_unit(unit),
            NodeKind::Negate(x) => of(x),
            NodeKind::Infix { operator, left, right, .. } => match operator {
                Operator::Multiply => of(left).zip(of(right)).map(|(x, y)| x.times(y)),
                Operator::Divide => of(left).zip(of(right)).map(|(x, y)| x.times(y.to(-1.0))),
                Operator::Power => {
                    of(left).zip(walk.constant(*right)).map(|(x, power)| x.to(power))
                }
                Operator::Add | Operator::Subtract => {
                    let sides = [walk.constant(*left), walk.constant(*right)];
                    match sides {
                        [Some(_), Some(_)] => walk.constant(index).and_then(Factors::of_number),
                        // what is added to a plain number is one
                        [None, None] => alike(&[*left, *right]),
                        _ => Some(Factors::COHERENT),
                    }
                }
                _ => None,
            },
            NodeKind::Call { function: Some(function), arguments, .. } => match function {
                Function::One(Unary::Sqrt) => arguments.first().and_then(of).map(|x| x.to(0.5)),
                Function::One(Unary::Abs)
                | Function::Fold(Binary::Min | Binary::Max | Binary::Hypot)
                | Function::If => alike(taken_up(*function, arguments)),
                Function::One(_) | Function::Kelvin => Some(Factors::COHERENT),
                _ => None,
            },
            _ => None,
        };
        all.push(found.filter(Factors::is_finite));
    }
    all
}

impl Walk<'_, '_> {
    /// Adds the notes on products that convert to the unit of the value, or to coherent ones, to those that
    /// are `found`. What is told of a part of such a product is told with the whole.
    pub(super) fn of_products(
        &self,
        all: &[Option<Factors>],
        result: Option<(&Unit, &Fact)>,
        found: &mut Vec<FormulaNote>,
    ) -> Option<Factors> {
        let whole = all.last().copied().flatten();
        if self.of == Use::Width {
            return whole;
        }
        let mut notes = Vec::new();
        if let Some((unit, what)) = result {
            let terms = terms(self.tree, &self.constants).into_iter();
            let mut terms = terms.filter(|term| !term.is_factor);
            notes.extend(terms.find_map(|term| self.of_value(all, term.index, unit, what)));
        }
        notes.extend(self.tree.nodes.iter().find_map(|node| self.of_summand(all, node)));
        for Told { note, has_rest } in notes {
            let is_within = |other: &FormulaNote| {
                note.span.start <= other.span.start && other.span.end <= note.span.end
            };
            let is_about = |other: &FormulaNote| {
                other.span.start < note.span.end && note.span.start < other.span.end
            };
            let is_result = |other: &FormulaNote| {
                [RESULT_TWICE, QUANTITY_TWICE].contains(&other.code()) && is_about(other)
            };
            let is_part =
                |other: &FormulaNote| OF_PARTS.contains(&other.code()) && is_within(other);
            if found.iter().any(is_result) || !has_rest && found.iter().any(is_part) {
                continue;
            }
            found.retain(|other| !is_part(other));
            found.push(note);
        }
        let is_told = found.iter().any(|note| {
            OF_PARTS.contains(&note.code()) || [RESULT_TWICE, QUANTITY_TWICE].contains(&note.code())
        });
        whole.map(|whole| Factors { is_told: whole.is_told || is_told, ..whole })
    }

    /// A product that is the value, or a term of it.
    fn of_value(
        &self,
        all: &[Option<Factors>],
        index: usize,
        unit: &Unit,
        what: &Fact,
    ) -> Option<Told> {
        let node = self.tree.nodes.get(index)?;
        let of = all.get(index).copied().flatten().filter(|of| !of.is_told)?;
        // an equation that is a term is told of itself
        let is_term = of.own == 1 && of.is_linear && self.has_equation_alone(all, index);
        let is_level = !unit.level_exponent().is_zero() || unit.counts_revolutions();
        // of plain numbers a hundred may be a coefficient, as it is asked elsewhere
        let is_of_numbers = unit.dimension().is_none() && of.scaled == 0;
        let is_other = is_term || is_level || is_of_numbers || unit.turn() == Some(Turn::Angle);
        if of.own == 0 || is_other {
            return None;
        }
        let formula = self.quoted(&node.span);
        let with = of.of_equations.then(|| fact!("with-equations"));
        let or_turns = |of: &Converted| of.has_turns.then(|| fact!("or-turns"));
        let constants = self.operands(node).into_iter().filter_map(|(index, is_divided)| {
            let number = self.constant(index).filter(|number| *number != 0.0)?;
            Some(if is_divided { 1.0 / number } else { number })
        });
        // what one equation converts another may convert back
        let constants: Vec<f64> = if of.of_equations { Vec::new() } else { constants.collect() };
        if let Some(converted) = of.converts_to(unit.factor(), &constants) {
            let to = match unit.factor() == 1.0 {
                true => fact!("converted-to.coherent-unit", unit),
                false => fact!("converted-to.unit", unit, what = what.clone()),
            };
            let (factor, or_turns) = (shown(converted.factor), or_turns(&converted));
            let fact = fact!("result-converted-twice.product", formula, with, factor, to, or_turns);
            return Some(Told::of(node, fact, &converted));
        }
        // `0.001*U*k` of mV may be a share of it
        let converted = of.converts_to(1.0, &[]).filter(|_| of.is_sure())?;
        let (factor, or_turns) = (shown(converted.factor), or_turns(&converted));
        let fact = fact!("quantity-converted-twice.product", formula, with, factor, or_turns);
        Some(Told::of(node, fact, &converted))
    }

    /// Whether the one factor of a product that is no number is an equation.
    fn has_equation_alone(&self, all: &[Option<Factors>], index: usize) -> bool {
        let Some(node) = self.tree.nodes.get(index) else { return false };
        let operands =
            if self.is_product(index) { self.operands(node) } else { vec![(index, false)] };
        operands.into_iter().any(|(index, _)| {
            let is_converted =
                all.get(index).copied().flatten().is_some_and(|of| of.conversions != 1.0);
            is_converted && matches!(self.node(index), Some(NodeKind::Name))
        })
    }

    /// A product beside a plain number, or that a function of plain numbers takes, `1 + a*1e-6*(t - t0)` of
    /// an a in ppm/K, or beside what has no conversion, `R^2 + (2*pi*f*1000*L)^2` of kHz.
    fn of_summand(&self, all: &[Option<Factors>], node: &Node) -> Option<Told> {
        let of = |index: usize| all.get(index).copied().flatten();
        let (product, of, converted, to) = match &node.kind {
            NodeKind::Infix {
                operator: Operator::Add | Operator::Subtract, left, right, ..
            } => {
                let to = |product: usize, beside: usize| {
                    let (found, other) = (of(product)?, of(beside)?);
                    let is_plain = self.constant(beside).is_some();
                    let is_sure = is_plain || found.is_sure() && other.has_one_size();
                    let size = if is_plain { 1.0 } else { other.size };
                    let converted = found.converts_to(size, &[]).filter(|_| is_sure)?;
                    Some((product, found, converted, fact!("converted-to.beside")))
                };
                to(*right, *left).or_else(|| to(*left, *right))?
            }
            NodeKind::Call { function: Some(Function::One(function)), arguments, .. }
                if !matches!(function, Unary::Sqrt | Unary::Abs) =>
            {
                let product = *arguments.first()?;
                let converted = of(product)?.converts_to(1.0, &[])?;
                (product, of(product)?, converted, fact!("converted-to.number"))
            }
            _ => return None,
        };
        if of.own < 2 || of.is_told {
            return None;
        }
        let node = self.tree.nodes.get(product)?;
        let (formula, factor) = (self.quoted(&node.span), shown(converted.factor));
        let fact = fact!("quantity-converted-twice", formula, factor, to);
        Some(Told::of(node, fact, &converted))
    }

    /// `2 - log10(T)` of per cent: the absorbance of a transmittance that is a plain number already.
    pub(super) fn of_logarithm(&self, node: &Node) -> Option<FormulaNote> {
        let NodeKind::Infix {
            operator: operator @ (Operator::Add | Operator::Subtract),
            left,
            right,
            ..
        } = &node.kind
        else {
            return None;
        };
        let (number, other, is_negative) = match [self.constant(*left), self.constant(*right)] {
            [Some(number), None] => (number, *right, *operator == Operator::Subtract),
            [None, Some(number)] if *operator == Operator::Subtract => (-number, *left, false),
            [None, Some(number)] => (number, *left, false),
            _ => return None,
        };
        let (other, is_negative) = match self.node(other)? {
            NodeKind::Negate(x) => (*x, !is_negative),
            _ => (other, is_negative),
        };
        let NodeKind::Call { function: Some(Function::One(Unary::Log10)), arguments, .. } =
            self.node(other)?
        else {
            return None;
        };
        let of = self.scaled(*arguments.first()?);
        let unit =
            of.unit.filter(|unit| unit.turn().is_none() && is_same_factor(of.factor, 1.0))?;
        // less that of the number of per cent, or the same with the other sign
        let of_unit = -log10(unit.factor());
        let expected = if is_negative { of_unit } else { -of_unit };
        let is_conversion =
            unit.factor() != 1.0 && !of.is_divisor && (number - expected).abs() < 1e-9;
        is_conversion.then(|| {
            let (formula, number) = (self.quoted(&node.span), number.abs());
            let of = to_15_digits(1.0 / unit.factor());
            FormulaNote::at(
                node,
                fact!("share-converted-twice.logarithm", formula, unit, number, of),
            )
        })
    }
}

/// A note on a product, and whether it converts from others than shares, angles and revolutions.
struct Told {
    note: FormulaNote,
    has_rest: bool,
}

impl Told {
    fn of(node: &Node, fact: Fact, converted: &Converted) -> Self {
        Self { note: FormulaNote::at(node, fact), has_rest: converted.has_rest }
    }
}
