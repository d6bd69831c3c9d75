//! Factors that convert between units beside the conversion of the program: `1000*m/V` of mg and mL that is
//! reported in mg/L, `60*V/t` of seconds in mL/min.

use super::function::Function;
use super::note::{FormulaNote, RESULT_TWICE, Walk};
use super::note_result::terms;
use super::numbers::{Numbers, ValueSource, is_same_factor};
use super::syntax::{Kind, Node, Operator};
use crate::decimal::to_15_digits;
use crate::number::elementary::pow;
use crate::number::{Binary, Shortest, Unary};
use gumption_units::Unit;

impl<'u> Walk<'_, 'u> {
    /// The size of a node, of those of its operands.
    pub(super) fn computed_size(
        &self,
        node: &Node,
        numbers_of: &impl Fn(ValueSource<'_>) -> Option<Numbers<'u>>,
    ) -> Option<f64> {
        let given = |source: ValueSource<'_>| match numbers_of(source)? {
            Numbers::Given(unit) => factor(unit),
            Numbers::Unstated => Some(1.0),
            _ => None,
        };
        match &node.kind {
            Kind::Number(_) | Kind::Pi | Kind::Constant(_) => Some(1.0),
            Kind::Name => given(ValueSource::Name(self.text.get(node.span.clone())?)),
            Kind::Table { call, .. } => given(ValueSource::TableValue(call)),
            Kind::Unit(unit) => factor(unit),
            Kind::InUnit { unit, .. } => factor(unit),
            Kind::Negate(x) => self.size(*x),
            Kind::Infix { operator, left, right, .. } => {
                let (x, y) = (self.size(*left)?, self.size(*right)?);
                match operator {
                    Operator::Multiply => Some(x * y),
                    Operator::Divide => Some(x / y),
                    Operator::Power => Some(pow(x, self.constant(*right)?)),
                    Operator::Add | Operator::Subtract => (x == y).then_some(x),
                    _ => None,
                }
            }
            Kind::Call { function: Some(function), arguments, .. } => {
                let mut sizes = arguments.iter().map(|argument| self.size(*argument));
                match function {
                    Function::One(Unary::Sqrt) => Some(sizes.next()??.sqrt()),
                    Function::One(Unary::Abs)
                    | Function::Fold(Binary::Min | Binary::Max | Binary::Hypot) => {
                        let first = sizes.next()??;
                        sizes.all(|size| size == Some(first)).then_some(first)
                    }
                    // plain numbers of plain numbers
                    Function::One(_) => Some(1.0),
                    _ => None,
                }
            }
            _ => None,
        }
    }

    /// A product that is the value, or a term of it, with the factor by which the program converts from
    /// the units of its quantities to that of the value. `what` is what is in the unit.
    pub(super) fn of_units(&self, unit: &Unit, what: &str) -> Option<FormulaNote> {
        let of_unit = factor(unit).filter(|_| !unit.dimension().is_none())?;
        let terms = terms(self.tree, &self.constants);
        let products = terms.iter().filter(|term| !term.is_factor && self.is_product(term.index));
        products.into_iter().find_map(|term| {
            let node = self.tree.nodes.get(term.index)?;
            let conversion = self.size(term.index)? / of_unit;
            if is_same_factor(conversion, 1.0) {
                return None;
            }
            let constants = self.operands(node).into_iter().filter_map(|(index, is_divided)| {
                let number = self.constant(index).filter(|number| *number != 0.0)?;
                Some(if is_divided { 1.0 / number } else { number })
            });
            let constants: Vec<f64> = constants.collect();
            let is_conversion = |number: f64| is_same_factor(number, conversion);
            let is_one = constants.iter().copied().any(is_conversion)
                || is_conversion(constants.iter().product());
            is_one.then(|| {
                let text = format!(
                    "`{}` has the factor of {} that converts from the units of its quantities to {unit}, \
                     and {what} in {unit} is converted, too: formulas compute in coherent SI units; leave \
                     the factor out, or let it be an input of its own if it is no conversion",
                    self.quoted(&node.span),
                    Shortest(to_15_digits(conversion)),
                );
                FormulaNote { code: RESULT_TWICE, text, span: node.span.clone() }
            })
        })
    }
}

/// The size of a unit of which a factor is all that converts.
fn factor(unit: &Unit) -> Option<f64> {
    (unit.turn().is_none() && unit.level_exponent().is_zero()).then(|| unit.factor())
}
