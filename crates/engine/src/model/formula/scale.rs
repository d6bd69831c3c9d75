//! What formulas do with quantities that have a zero, with levels, and with what counts periods or
//! angle. Celsius temperatures are summands; everything else asks for `kelvin`.

use std::ops::Range;

use super::angle::AnglePower;
use super::dimension::Checker;
use super::error::FormulaError;
use super::function::Function;
use super::scale_fault::{ScaleFault, ScaledPlace};
use super::syntax::{Node, NodeKind, Operator};
use super::tie::{Tie, borne, taken_up};
use super::typing::{KelvinKind, LevelReference, Rate, Typing};
use crate::number::Unary;
use gumption_units::{Dimension, Exponent, Turn, Unit, Zero};

/// What a node is in the making of a level, `10*n*log10(x)` with a plain number n.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LevelPart {
    /// Nothing.
    None,
    /// 10 or 20, times or over plain numbers.
    Factor,
    /// A logarithm to base 10, times or over plain numbers.
    Logarithm,
}

impl Checker<'_> {
    /// What a node is in the making of a level, from what its parts are.
    pub(super) fn level_part(&self, index: usize, node: &Node) -> LevelPart {
        if let Some(constant) = self.constant(index) {
            let is_factor = matches!(constant.abs(), 10.0 | 20.0);
            return if is_factor { LevelPart::Factor } else { LevelPart::None };
        }
        let part = |index: usize| self.level_parts.get(index).copied().unwrap_or(LevelPart::None);
        // a plain number that is no logarithm itself
        let is_plain = |index: usize| {
            let typing = self.typing(index);
            typing.dimension == Some(Dimension::NONE)
                && typing.level.is_zero()
                && typing.zero.is_none()
                && part(index) != LevelPart::Logarithm
        };
        match &node.kind {
            NodeKind::Call { function, .. } if *function == Some(Function::One(Unary::Log10)) => {
                LevelPart::Logarithm
            }
            NodeKind::Negate(x) => part(*x),
            NodeKind::Infix { operator: Operator::Multiply, left, right, .. } => {
                match (part(*left), part(*right)) {
                    (LevelPart::None, of) if is_plain(*left) => of,
                    (of, _) if is_plain(*right) => of,
                    _ => LevelPart::None,
                }
            }
            NodeKind::Infix { operator: Operator::Divide, left, right, .. } if is_plain(*right) => {
                part(*left)
            }
            _ => LevelPart::None,
        }
    }

    /// Whether the product of two nodes is a level.
    fn makes_level(&self, left: usize, right: usize) -> bool {
        let part = |index: usize| self.level_parts.get(index).copied().unwrap_or(LevelPart::None);
        matches!(
            (part(left), part(right)),
            (LevelPart::Factor, LevelPart::Logarithm) | (LevelPart::Logarithm, LevelPart::Factor)
        )
    }

    /// What a node is where it is used as a whole; anything after a mistake.
    pub(super) fn settled(&mut self, index: usize) -> Typing {
        let (typing, tie) = (self.typing(index), self.tie(index));
        if let Some(settled) = tie.settled(typing) {
            return settled;
        }
        match tie {
            Tie::Sum { zero, weight, .. } => {
                let total = (weight * 1e6).round() / 1e6;
                let fault = ScaleFault::FactorsOfSum {
                    text: self.quoted(index),
                    zero,
                    total: total.to_string(),
                };
                self.fault(index, fault);
            }
            Tie::Product { at, of, .. } => self.fault_of_product(at, of),
            Tie::None => {}
        }
        Typing::ANY
    }

    pub(super) fn fault(&mut self, index: usize, fault: ScaleFault) {
        let span = self.tree.span(index);
        self.report_dimension(FormulaError::Scale { fault: Box::new(fault), span });
    }

    fn fault_at(&mut self, span: &Range<usize>, fault: ScaleFault) {
        self.report_dimension(FormulaError::Scale { fault: Box::new(fault), span: span.clone() });
    }

    /// A Celsius temperature that is part of a product, quotient or power which needs a ratio.
    fn fault_of_product(&mut self, at: usize, of: usize) {
        let place = match self.tree.nodes.get(at).map(|node| &node.kind) {
            Some(NodeKind::Infix { operator: Operator::Divide, .. }) => ScaledPlace::Quotient,
            Some(NodeKind::Infix { operator: Operator::Power, .. }) => ScaledPlace::Power,
            _ => ScaledPlace::Product,
        };
        let fault =
            ScaleFault::ZeroOutOfPlace { text: self.quoted(of), zero: Zero::Celsius, place };
        self.fault(at, fault);
    }

    /// The argument of a function that takes quantities with a dimension, but none with a zero.
    pub(super) fn without_zero(&mut self, function: &'static str, index: usize) -> Typing {
        let typing = self.settled(index);
        let Some(zero) = typing.zero else { return typing };
        let place = ScaledPlace::Function(function);
        self.fault(index, ScaleFault::ZeroOutOfPlace { text: self.quoted(index), zero, place });
        Typing::ANY
    }

    /// Arguments that a function takes together and that may have no zero.
    pub(super) fn all_without_zero(
        &mut self,
        function: &'static str,
        span: &Range<usize>,
        arguments: &[usize],
    ) -> Typing {
        let has_zero = |&&argument: &&usize| {
            let (typing, tie) = (self.typing(argument), self.tie(argument));
            tie.settled(typing).is_none_or(|typing| typing.zero.is_some())
        };
        match arguments.iter().find(has_zero) {
            Some(&argument) => self.without_zero(function, argument),
            None => self.together(function, span, arguments),
        }
    }

    /// The argument of a function of plain numbers; `None` after a mistake.
    pub(super) fn plain_argument(
        &mut self,
        function: &'static str,
        index: usize,
    ) -> Option<Typing> {
        let typing = self.settled(index);
        if !typing.level.is_zero() {
            let text = self.quoted(index);
            self.fault(index, ScaleFault::LevelInFunction { function, text });
            None
        } else if typing.zero.is_some() {
            self.without_zero(function, index);
            None
        } else {
            Some(typing)
        }
    }

    /// What several quantities are that a function or a comparison takes together.
    pub(super) fn together(
        &mut self,
        operator: &'static str,
        span: &Range<usize>,
        parts: &[usize],
    ) -> Typing {
        let mut first: Option<(usize, Typing)> = None;
        for &part in parts {
            let typing = self.settled(part);
            if typing.dimension.is_none() {
                continue;
            }
            let Some((known_part, known)) = first else {
                first = Some((part, typing));
                continue;
            };
            if known.dimension != typing.dimension {
                continue; // has been reported
            }
            self.refuse_unlike(operator, span, [(known_part, known), (part, typing)]);
            let loose = |typing: Typing| typing.counts_degrees();
            if known.zero != typing.zero && !loose(known) && !loose(typing) {
                let texts = [self.quoted(known_part), self.quoted(part)];
                let zeros = [known.zero, typing.zero];
                self.fault_at(span, ScaleFault::DifferentZeros { operator, texts, zeros });
                return Typing::ANY;
            }
            if known.zero.is_none() && typing.zero.is_some() {
                first = Some((part, typing));
            }
        }
        first.map_or(Typing::ANY, |(_, typing)| typing)
    }

    /// Refuses a level beside a number, and periods beside angle.
    fn refuse_unlike(
        &mut self,
        operator: &'static str,
        span: &Range<usize>,
        [(left, x), (right, y)]: [(usize, Typing); 2],
    ) {
        if x.level != y.level {
            let (level, number) = if x.level.is_zero() { (right, left) } else { (left, right) };
            let is_literal = self.is_rational(number);
            let (level, number) = (self.quoted(level), self.quoted(number));
            let fault = ScaleFault::LevelAndNumber { operator, level, number, is_literal };
            self.fault_at(span, fault);
        } else {
            self.refuse_periods_and_angle(operator, span, [(left, x), (right, y)]);
        }
    }

    fn refuse_periods_and_angle(
        &mut self,
        operator: &'static str,
        span: &Range<usize>,
        [(left, x), (right, y)]: [(usize, Typing); 2],
    ) {
        if x.rate.is_unlike(y.rate) {
            let (revolutions, rate) =
                if x.rate == Rate::Revolutions { (left, right) } else { (right, left) };
            let (revolutions, rate) = (self.quoted(revolutions), self.quoted(rate));
            self.fault_at(span, ScaleFault::RevolutionsAndRate { operator, revolutions, rate });
        } else if let (Some(a), Some(b)) = (x.turn, y.turn)
            && a != b
        {
            let (periods, angle) = if a == Turn::Periods { (left, right) } else { (right, left) };
            let (periods, angle) = (self.quoted(periods), self.quoted(angle));
            self.fault_at(span, ScaleFault::PeriodsAndAngle { operator, periods, angle });
        }
    }

    /// Whether a node is 273.15 K, written out, perhaps with fewer digits.
    fn is_ice_point(&self, index: usize) -> bool {
        let Some(NodeKind::InUnit { number, unit }) =
            self.tree.nodes.get(index).map(|node| &node.kind)
        else {
            return false;
        };
        let kelvins = self.constant(*number).map(|number| number * unit.factor());
        unit.dimension() == Dimension::TEMPERATURE
            && unit.zero().is_none()
            && kelvins.is_some_and(|kelvins| (kelvins - 273.15).abs() < 0.16)
    }

    /// A sum or a difference.
    pub(super) fn sum(
        &mut self,
        sign: f64,
        operator_span: &Range<usize>,
        [left, right]: [usize; 2],
    ) -> (Typing, Tie) {
        let operator = if sign > 0.0 { "+" } else { "-" };
        let (x, y) = (self.typing(left), self.typing(right));
        if x.dimension.is_some() && y.dimension.is_some() && x.dimension != y.dimension {
            return (Typing::ANY, Tie::None); // has been reported
        }
        // an unfinished product is no summand
        for part in [left, right] {
            if matches!(self.tie(part), Tie::Product { .. }) {
                self.settled(part);
                return (Typing::ANY, Tie::None);
            }
        }
        let (a, b) = (self.tie(left), self.tie(right));
        // 10*log10(P/[mW]) beside a level in dBm counts from the same zero
        let (a, b) = (a.beside(x, b), b.beside(y, a).times(sign));
        // a gain above an isotropic antenna, or a level above a carrier, beside one above a power
        let (a, b) = match (a.is_relative(), b.is_relative()) {
            (true, false) if b != Tie::None => (Tie::None, b),
            (false, true) if a != Tie::None => (a, Tie::None),
            _ => (a, b),
        };
        if x.dimension.is_none() && a == Tie::None {
            return (y, b);
        }
        if y.dimension.is_none() && b == Tie::None {
            return (x, a);
        }
        for (celsius, added, tie) in [(left, right, a), (right, left, b)] {
            let is_celsius = matches!(tie, Tie::Sum { zero: Zero::Celsius, weight: 1.0, .. });
            if sign > 0.0 && is_celsius && self.is_ice_point(added) {
                let text = self.quoted(celsius);
                self.fault_at(operator_span, ScaleFault::IcePointAdded { text });
                return (Typing::ANY, Tie::None);
            }
        }
        self.refuse_unlike(operator, operator_span, [(left, x), (right, y)]);
        self.refuse_other_references(operator, left, [left, right]);
        let typing = Typing {
            zero: None,
            kelvin: kelvin_of_sum(sign, x.kelvin, y.kelvin),
            celsius_exponent: nearer_zero(x.celsius_exponent, y.celsius_exponent),
            reference: match x.level.is_zero() && y.level.is_zero() {
                true => LevelReference::of_numbers(x, y),
                false => LevelReference::of_sum(sign, x, y),
            },
            turn: x.turn.or(y.turn),
            rate: if x.rate == y.rate { x.rate } else { Rate::Unknown },
            has_turns: x.has_turns || y.has_turns,
            angle: x.angle.plus(y.angle),
            ..x
        };
        let unlike = |of: Zero| {
            let [p, q] = [a, b].map(|tie| match tie {
                Tie::Sum { zero, .. } => Some(zero),
                _ => None,
            });
            let texts = [left, right];
            (of, texts, [p, q])
        };
        let different = match (a, b) {
            (Tie::None | Tie::Product { .. }, Tie::None | Tie::Product { .. }) => {
                return (typing, Tie::None);
            }
            (
                Tie::Sum { zero, weight: p, loose: q },
                Tie::Sum { zero: other, weight: r, loose: s },
            ) => {
                if zero == other {
                    return (typing, Tie::Sum { zero, weight: p + r, loose: q + s });
                }
                unlike(zero)
            }
            (Tie::Sum { zero, weight, loose }, _) => {
                if y.kelvin != KelvinKind::Thermodynamic {
                    let loose = if y.counts_degrees() { loose + sign } else { loose };
                    return (typing, Tie::Sum { zero, weight, loose });
                }
                unlike(zero)
            }
            (_, Tie::Sum { zero, weight, loose }) => {
                if x.kelvin != KelvinKind::Thermodynamic {
                    let loose = if x.counts_degrees() { loose + 1.0 } else { loose };
                    return (typing, Tie::Sum { zero, weight, loose });
                }
                unlike(zero)
            }
        };
        let (_, texts, zeros) = different;
        let texts = texts.map(|part| self.quoted(part));
        self.fault_at(operator_span, ScaleFault::DifferentZeros { operator, texts, zeros });
        (Typing::ANY, Tie::None)
    }

    /// A product; `dimension` is its dimension.
    pub(super) fn product(
        &mut self,
        index: usize,
        dimension: Option<Dimension>,
        [left, right]: [usize; 2],
    ) -> (Typing, Tie) {
        if self.makes_level(left, right) {
            let reference = self.reference_of_level(left, right);
            return (Typing { level: Exponent::ONE, reference, ..Typing::NUMBER }, Tie::None);
        }
        for (number, other) in [(left, right), (right, left)] {
            let Some(factor) = self.constant(number) else { continue };
            let typing = self.typing(other);
            let turn = self.turned(typing.turn, number, factor);
            let angle = self.angle_of(number).times(typing.angle);
            let reference = scaled(typing);
            return (
                Typing { dimension, turn, angle, reference, ..typing },
                self.tie(other).times(factor),
            );
        }
        self.refuse_other_reference(index, [left, right]);
        let (x, y) = (self.typing(left), self.typing(right));
        let has_turns = x.has_turns || y.has_turns;
        let turn = match (x.turn, y.turn) {
            _ if has_turns => None,
            (None, turn) | (turn, None) => turn,
            // so much angle in each period
            (Some(Turn::Periods), Some(Turn::Angle)) | (Some(Turn::Angle), Some(Turn::Periods)) => {
                Some(Turn::Angle)
            }
            _ => None,
        };
        let angle = x.angle.times(y.angle);
        let level = x.level.checked_add(y.level).unwrap_or(Exponent::ZERO);
        let unit = x.celsius_exponent.checked_add(y.celsius_exponent).unwrap_or(Exponent::ZERO);
        let reference = match (x.level, y.level) {
            (Exponent::ZERO, Exponent::ZERO) => LevelReference::of_product(x, y),
            (_, Exponent::ZERO) => x.reference.scaled(),
            _ => y.reference.scaled(),
        };
        let plain = Typing { dimension, ..Typing::ANY };
        let typing = Typing { level, turn, angle, reference, has_turns, ..plain };
        let powers = [self.tie(left).power(), self.tie(right).power()];
        self.tied(index, typing, unit, powers, [left, right])
    }

    /// A quotient; `dimension` is its dimension.
    pub(super) fn quotient(
        &mut self,
        index: usize,
        dimension: Option<Dimension>,
        [left, right]: [usize; 2],
    ) -> (Typing, Tie) {
        let (x, y) = (self.typing(left), self.typing(right));
        if let Some(divisor) = self.constant(right).filter(|divisor| *divisor != 0.0) {
            let turn = match self.turned(Some(Turn::Periods), right, divisor) {
                Some(Turn::Periods) => x.turn,
                Some(Turn::Angle) if x.turn == Some(Turn::Angle) => Some(Turn::Periods),
                _ => None,
            };
            let angle = x.angle.over(self.angle_of(right));
            let reference = scaled(x);
            return (
                Typing { dimension, turn, angle, reference, ..x },
                self.tie(left).times(1.0 / divisor),
            );
        }
        if let Some(NodeKind::Unit(unit)) = self.tree.nodes.get(right).map(|node| &node.kind)
            && unit.zero().is_some()
        {
            let unit = unit.as_ref().clone();
            self.refuse_kelvin_per_celsius(left, &unit);
            if x.zero.is_some() && Zero::shift(x.zero, unit.zero()).is_none() {
                let texts = [self.quoted(left), self.quoted(right)];
                let zeros = [x.zero, unit.zero()];
                self.fault(index, ScaleFault::DifferentZeros { operator: "/", texts, zeros });
                return (Typing::ANY, Tie::None);
            }
            let level = x.level.checked_add(Exponent::integer(-1)).unwrap_or(Exponent::ZERO);
            let level = if unit.is_celsius() { x.level } else { level };
            match dimension {
                None => return (Typing::ANY, Tie::None),
                Some(Dimension::NONE) => {
                    return (Typing { level, ..Typing::NUMBER }, Tie::None);
                }
                Some(_) => {}
            }
        }
        // as in `angle*f/[Hz]`
        let leaves_angle = y.turn == Some(Turn::Periods) && self.is_angle_and_periods(left);
        // the number of `[rpm]` in what is in Hz would be 2 pi times off
        if dimension == Some(Dimension::NONE) && self.is_written_out(right) && !leaves_angle {
            let span = self.tree.span(index);
            self.refuse_periods_and_angle("/", &span, [(left, x), (right, y)]);
        }
        let has_turns = x.has_turns || y.has_turns;
        let angle = self.angle_of(left).over(y.angle);
        let turn = match (x.turn, y.turn) {
            _ if has_turns => None,
            _ if leaves_angle => x.turn,
            // `n^2/n`
            (None, _) if angle.is_angle() => Some(Turn::Angle),
            (turn, None) => turn,
            (Some(Turn::Angle), Some(Turn::Angle)) if self.is_unit(right, "rev") => {
                Some(Turn::Periods)
            }
            _ => None,
        };
        let minus = |exponent: Exponent| exponent.checked_neg().unwrap_or(Exponent::ZERO);
        let level = x.level.checked_add(minus(y.level)).unwrap_or(Exponent::ZERO);
        let unit = x.celsius_exponent.checked_add(minus(y.celsius_exponent));
        self.refuse_other_references("/", index, [left, right]);
        let reference = match (x.level, x.reference, y.reference) {
            (Exponent::ZERO, LevelReference::Above(a), LevelReference::Above(b)) if a == b => {
                LevelReference::Ratio
            }
            (Exponent::ZERO, _, LevelReference::Above(_)) => LevelReference::Unknown,
            (Exponent::ZERO, ..) => LevelReference::of_product(x, y),
            _ => x.reference.scaled(),
        };
        let plain = Typing { dimension, ..Typing::ANY };
        let typing = Typing { level, turn, angle, reference, has_turns, ..plain };
        let powers = [self.tie(left).power(), minus(self.tie(right).power())];
        self.tied(index, typing, unit.unwrap_or(Exponent::ZERO), powers, [left, right])
    }

    /// A power with an exponent other than 0 and 1; `dimension` is its dimension.
    pub(super) fn raised(
        &mut self,
        index: usize,
        dimension: Option<Dimension>,
        base: usize,
        exponent: Exponent,
    ) -> (Typing, Tie) {
        let typing = self.typing(base);
        let times = |of: Exponent| of.checked_mul(exponent).unwrap_or(Exponent::ZERO);
        let (unit, power) = (times(typing.celsius_exponent), times(self.tie(base).power()));
        let angle = typing.angle.to_the(exponent);
        let turn = angle.is_angle().then_some(Turn::Angle);
        let plain = Typing { dimension, ..Typing::ANY };
        let raised = Typing { level: times(typing.level), turn, angle, ..plain };
        self.tied(index, raised, unit, [power, Exponent::ZERO], [base, base])
    }

    /// The root of a quantity without a zero.
    pub(super) fn rooted(
        &self,
        dimension: Option<Dimension>,
        typing: Typing,
        power: Exponent,
    ) -> Typing {
        let times = |of: Exponent| of.checked_mul(power).unwrap_or(Exponent::ZERO);
        let celsius_exponent = borne(times(typing.celsius_exponent), dimension);
        let level = times(typing.level);
        let angle = typing.angle.to_the(power);
        let turn = angle.is_angle().then_some(Turn::Angle);
        Typing { level, celsius_exponent, turn, angle, ..Typing { dimension, ..Typing::ANY } }
    }

    /// A product with powers of degrees Celsius in its factors, as far as the units of coefficients
    /// do not take them up.
    fn tied(
        &mut self,
        index: usize,
        typing: Typing,
        unit: Exponent,
        [first, second]: [Exponent; 2],
        [left, right]: [usize; 2],
    ) -> (Typing, Tie) {
        let of = if first.is_zero() { right } else { left };
        if typing.dimension.is_none() {
            return (typing, Tie::None);
        }
        if first.to_f64() * second.to_f64() < 0.0 {
            // the quotient of two Celsius temperatures
            self.fault_of_product(index, of);
            return (Typing::ANY, Tie::None);
        }
        let power = first.checked_add(second).unwrap_or(Exponent::ZERO);
        let (power, unit) = taken_up(power, unit);
        if power.is_zero() {
            let celsius_exponent = borne(unit, typing.dimension);
            return (Typing { celsius_exponent, ..typing }, Tie::None);
        }
        let (at, of) = match self.tie(of) {
            Tie::Product { at, of, .. } => (at, of),
            _ => (index, of),
        };
        (Typing { celsius_exponent: unit, ..typing }, Tie::Product { power, at, of })
    }

    /// What something counts after a multiplication with a number written out: periods become angle
    /// by 2 pi.
    fn turned(&self, turn: Option<Turn>, number: usize, factor: f64) -> Option<Turn> {
        let is = |wanted: f64| (factor.abs() / wanted - 1.0).abs() < 1e-12;
        let turns = std::f64::consts::TAU;
        match turn {
            _ if self.is_rational(number) => turn,
            Some(Turn::Periods) if is(turns) => Some(Turn::Angle),
            Some(Turn::Angle) if is(1.0 / turns) => Some(Turn::Periods),
            _ => None,
        }
    }

    /// The power of angle in a factor. Numbers that are written out have none, and `2*pi` may be a
    /// revolution.
    fn angle_of(&self, factor: usize) -> AnglePower {
        match self.constant(factor) {
            Some(_) if self.is_rational(factor) => AnglePower::NUMBER,
            Some(_) => AnglePower::NONE,
            None => self.typing(factor).angle,
        }
    }

    /// Whether a node is a product of an angle and of what counts periods, whatever else it has.
    fn is_angle_and_periods(&self, index: usize) -> bool {
        let has = |turn: Turn| self.has_factor(index, turn);
        has(Turn::Angle) && has(Turn::Periods)
    }

    fn has_factor(&self, index: usize, turn: Turn) -> bool {
        match self.tree.nodes.get(index).map(|node| &node.kind) {
            Some(NodeKind::Infix { operator: Operator::Multiply, left, right, .. }) => {
                self.has_factor(*left, turn) || self.has_factor(*right, turn)
            }
            Some(NodeKind::Negate(of)) => self.has_factor(*of, turn),
            _ => self.typing(index).turn == Some(turn),
        }
    }

    fn is_unit(&self, index: usize, text: &str) -> bool {
        let kind = self.tree.nodes.get(index).map(|node| &node.kind);
        matches!(kind, Some(NodeKind::Unit(unit)) if unit.text().trim() == text)
    }

    /// Checks `10^(L/10)`, the only kind of power that a level is the exponent of.
    pub(super) fn check_level_as_exponent(&mut self, base: usize, exponent: usize) {
        let mut inner = exponent;
        while let Some(NodeKind::Negate(x)) = self.tree.nodes.get(inner).map(|node| &node.kind) {
            inner = *x;
        }
        let is = |factor: Option<f64>, wanted: [f64; 2]| {
            factor.is_some_and(|factor| wanted.contains(&factor.abs()))
        };
        let is_right = match self.tree.nodes.get(inner).map(|node| &node.kind) {
            Some(NodeKind::Infix { operator: Operator::Divide, right, .. }) => {
                is(self.constant(*right), [10.0, 20.0])
            }
            Some(NodeKind::Infix { operator: Operator::Multiply, left, right, .. }) => {
                let factor = self.constant(*left).or(self.constant(*right));
                is(factor, [0.1, 0.05])
            }
            _ => false,
        };
        if !is_right
            || self.constant(base) != Some(10.0)
            || self.typing(exponent).level != Exponent::ONE
        {
            let text = self.quoted(exponent);
            self.fault(exponent, ScaleFault::LevelAsExponent { text });
        }
    }

    pub(super) fn refuse_difference(
        &mut self,
        function: &'static str,
        argument: usize,
        typing: Typing,
    ) {
        if typing.zero.is_none() && typing.kelvin == KelvinKind::Difference {
            let text = self.quoted(argument);
            self.fault(argument, ScaleFault::OfDifference { function, text });
        }
    }

    /// What `kelvin` and `celsius` give.
    pub(super) fn scaled_temperature(&self, function: Function) -> Typing {
        let typing = Typing::of(Dimension::TEMPERATURE);
        match function {
            Function::Celsius => Typing { zero: Some(Zero::Celsius), ..typing },
            _ => Typing { kelvin: KelvinKind::Thermodynamic, ..typing },
        }
    }

    /// `T/[degC]` of a temperature in K that is not known to be a difference.
    fn refuse_kelvin_per_celsius(&mut self, left: usize, unit: &Unit) {
        // a sum with a coefficient's unit takes up any factors
        if !unit.is_celsius() || (unit.offset() == 0.0 && self.tie(left) != Tie::None) {
            return;
        }
        let typing = self.settled(left);
        if typing.dimension == Some(Dimension::TEMPERATURE)
            && typing.zero.is_none()
            && typing.kelvin != KelvinKind::Difference
            && !typing.counts_degrees()
        {
            let (text, unit) = (self.quoted(left), unit.text().trim().to_owned());
            self.fault(left, ScaleFault::KelvinPerCelsius { text, unit });
        }
    }
}

/// What is known of the reference of a level, or of a number of one, times a plain number.
fn scaled(typing: Typing) -> LevelReference {
    if typing.level.is_zero() { typing.reference } else { typing.reference.scaled() }
}

/// What is known of a sum of temperatures in K.
fn kelvin_of_sum(sign: f64, x: KelvinKind, y: KelvinKind) -> KelvinKind {
    use KelvinKind::{Difference, Either, Thermodynamic};
    match (x, y) {
        (Difference, Difference) => Difference,
        (Thermodynamic, Thermodynamic) if sign < 0.0 => Difference,
        (Thermodynamic, Difference) => Thermodynamic,
        (Difference, Thermodynamic)
        | (Thermodynamic, Thermodynamic | Either)
        | (Either, Thermodynamic)
            if sign > 0.0 =>
        {
            Thermodynamic
        }
        _ => Either,
    }
}

/// Of two exponents that nearer to 0; 0 if they have different signs.
fn nearer_zero(a: Exponent, b: Exponent) -> Exponent {
    let (x, y) = (a.to_f64(), b.to_f64());
    if x * y <= 0.0 {
        Exponent::ZERO
    } else if x.abs() <= y.abs() {
        a
    } else {
        b
    }
}
