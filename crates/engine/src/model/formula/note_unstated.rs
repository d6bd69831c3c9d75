//! Numbers of which no unit is said, of an input, a column of a table or a coordinate of a calibration
//! function, where they can be in the unit of what stands beside them or be plain ones: `a + c` of an
//! angle in degrees.

use super::error::FormulaError;
use super::note::{FormulaNote, Walk};
use super::note_result::taken_up;
use super::numbers::{Numbers, Use, ValueSource};
use super::syntax::{Node, NodeKind, Operator};
use crate::decimal;
use crate::fact;
use crate::fact::Argument;
use gumption_units::{Turn, Unit};

/// The unit of plain numbers that count what a unit does: radians of an angle.
fn plain(unit: &Unit) -> &'static str {
    if unit.turn() == Some(Turn::Angle) { "rad" } else { "1" }
}

/// How many of a unit a plain 1 is.
fn one_in(unit: &Unit) -> Argument {
    Argument::Number(decimal::exact(unit.from_si(1.0)))
}

impl<'u> Walk<'_, 'u> {
    /// A sum, a comparison or a choice of what is in a unit and of what has none.
    pub(super) fn unstated_beside(&self, node: &Node) -> Option<FormulaNote> {
        let sides: &[usize] = match &node.kind {
            NodeKind::Infix { operator, left, right, .. } => match operator {
                Operator::Multiply | Operator::Divide | Operator::Power => return None,
                _ => &[*left, *right],
            },
            NodeKind::Call { function: Some(function), arguments, .. } => {
                taken_up(*function, arguments)
            }
            _ => return None,
        };
        let in_unit = |side: &usize| Some((*side, self.scaled(*side).bare_unit()?));
        let (beside, unit) = sides.iter().find_map(in_unit)?;
        let unstated = sides.iter().find(|side| self.is_unstated(**side))?;
        let [formula, beside] = [*unstated, beside].map(|of| self.quoted(&self.tree.span(of)));
        let (one, plain) = (one_in(unit), plain(unit));
        Some(FormulaNote::at(node, fact!("unit-left-out", formula, one, unit, beside, plain)))
    }

    /// Whether no unit is said of the numbers of a node, nor converts it them.
    fn is_unstated(&self, index: usize) -> bool {
        self.scaled(index).takes_unstated() && !self.has_pi(index)
    }

    /// An output that is reported in a unit and has none by its formula.
    pub(super) fn unstated_result(&self) -> Option<FormulaNote> {
        let Use::Output(unit) = self.of else { return None };
        let is_scaled =
            unit.dimension().is_none() && unit.level_exponent().is_zero() && unit.factor() != 1.0;
        let whole = self.tree.nodes.len().checked_sub(1)?;
        let is_told = is_scaled && self.is_unstated(whole);
        let last = self.tree.nodes.last().filter(|_| is_told)?;
        let (formula, one, plain) = (self.quoted(&last.span), one_in(unit), plain(unit));
        Some(FormulaNote::at(last, fact!("unit-left-out.output", formula, one, unit, plain)))
    }

    /// Arguments in a unit, of tables and calibration functions of which it is not said in what their
    /// arguments are.
    pub(super) fn unstated_arguments(
        &self,
        numbers_of: impl Fn(ValueSource<'_>) -> Option<Numbers<'u>>,
    ) -> Vec<FormulaError> {
        let is_unstated = |of: ValueSource<'_>| numbers_of(of) == Some(Numbers::Unstated);
        let found = self.tree.nodes.iter().filter_map(|node| {
            let (argument, source) = match &node.kind {
                NodeKind::Table { x, call } => (*x, ValueSource::TableArgument(call)),
                NodeKind::Curve { curve, inverse: false, argument } => {
                    (*argument, ValueSource::CurveX(curve))
                }
                NodeKind::Curve { curve, inverse: true, argument } => {
                    (*argument, ValueSource::CurveY(curve))
                }
                _ => return None,
            };
            let scaled = self.scaled(argument);
            let (unit, other) = match scaled.bare_unit() {
                Some(unit) => (unit.text().to_owned(), plain(unit)),
                None if scaled.is_in_radians() => ("rad".to_owned(), "deg"),
                None => return None,
            };
            is_unstated(source).then(|| {
                let reason = self.unstated_argument(argument, source, [&unit, other]);
                FormulaError::UnstatedUnit { reason, span: self.tree.span(argument) }
            })
        });
        found.collect()
    }

    fn unstated_argument(
        &self,
        argument: usize,
        source: ValueSource<'_>,
        [unit, other]: [&str; 2],
    ) -> String {
        let quoted = self.quoted(&self.tree.span(argument));
        let (of, remedy) = match source {
            ValueSource::TableArgument(call) => {
                let file = &call.file;
                let (of, heading) = match &call.columns {
                    Some([x, _]) => (format!("`{x}` of `{file}`"), x.as_str()),
                    None => (format!("the first column of `{file}`"), "x"),
                };
                let remedy = format!(
                    "write it into the heading, `{heading} [{unit}]` or `{heading} [{other}]`"
                );
                (of, remedy)
            }
            ValueSource::CurveX(curve) | ValueSource::CurveY(curve) => {
                let side = if matches!(source, ValueSource::CurveX(_)) { "x" } else { "y" };
                let of = format!("{side} of `{}`", curve.fit.name);
                (of, format!("state it there, `\"unit\": \"{unit}\"` or `\"unit\": \"{other}\"`"))
            }
            _ => return String::new(),
        };
        let numbers = if other == "1" { "plain ones".to_owned() } else { format!("in `{other}`") };
        format!(
            "`{quoted}` is in {unit}, but {of} has no unit: its numbers can be in `{unit}`, or {numbers}; \
             {remedy}"
        )
    }
}
