//! Models written as text: formulas, their dimensions, and the numbers they compute with.
//!
//! A [`Formula`] is read once, checked against the names it may use ([`Scope`]), and then computed
//! with whatever number is at hand: with a recording number it becomes part of a model's program,
//! with `f64` it is evaluated at once.
//!
//! ```
//! use std::collections::HashMap;
//! use gumption_engine::model::formula::{Formula, Scope, Typing};
//! use gumption_units::{Dimension, Unit};
//!
//! let formula = Formula::parse("2*height/duration^2")?;
//! let unit = |text: &str| Unit::parse(text).map(|unit| Typing::in_unit(&unit));
//! let scope = Scope::from_iter([("height", unit("cm")?), ("duration", unit("ms")?)]);
//! let typing = formula.check(&scope).map_err(|errors| errors[0].clone())?;
//! assert_eq!(typing.dimension, Some(Dimension::of([0, 1, -2, 0, 0, 0, 0])));
//!
//! // quantities in a formula are in SI units
//! let values = HashMap::from([("height".to_owned(), 5.0), ("duration".to_owned(), 2.0)]);
//! assert_eq!(formula.evaluate(&scope, &values)?, 2.5);
//!
//! let error = Formula::parse("height + duration")?.check(&scope).unwrap_err().remove(0);
//! assert_eq!(error.span(), 7..8);
//! assert_eq!(
//!     error.to_string(),
//!     "`height` is a length (m), but `duration` is a time (s); they cannot be added"
//! );
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The rules, in short; the grammar stands at the top of `parser.rs`:
//!
//! * `^` binds tighter than a minus sign in front and goes from right to left: `-2^2` is -4,
//!   `2^3^2` is 512. Comparisons bind loosest, give 1 or 0, and do not chain.
//! * A number in a formula is dimensionless, but a literal 0 fits every dimension. The exponent of
//!   a quantity with a dimension is a rational number written out.
//! * A unit in brackets is one such unit: `p/[hPa]`, `1.5 [mm]`, `20 [degC]`; `[c]`, `[h]`, `[e]`,
//!   `[k_B]` and `[N_A]` are the defining constants of the SI (the hour is `[hour]`).
//! * A temperature in degrees Celsius keeps its number and has a zero: it is a summand, and
//!   `kelvin(t)` adds 273.15, unless `t` is known to be in kelvin. Levels in decibels are made by
//!   `10*log10(x)` or `20*log10(x)` and are summands as well.
//! * `if(c, a, b)` is a where c is not 0, else b; what is not taken may be undefined. `and`, `or` and
//!   `not` join comparisons. `solve(f, x, from, to)` is the x at which f is 0, `table(x, 'file.csv')`
//!   a value between the points of a table, whose file whoever checks the formula has read.
//! * No text makes reading or checking panic, recurse deeply or take long.

#![warn(clippy::indexing_slicing)]

mod angle;
mod brackets;
mod complexity;
mod constant;
mod dimension;
mod error;
mod evaluate;
mod fraction;
mod function;
mod layout;
mod level_reference;
mod lexer;
mod message;
mod misfit;
mod name;
mod note;
mod note_bare;
mod note_frequency;
mod note_level;
mod note_product;
mod note_result;
mod note_turns;
mod note_unstated;
mod numbers;
mod parser;
mod plain;
mod scale;
mod scale_fault;
mod suggest;
mod syntax;
#[cfg(test)]
mod tests;
mod tie;
mod typing;
mod undefined;

use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

pub use angle::AnglePower;
pub use constant::{ExactConstant, constants};
pub use error::{Arity, FormulaError, NumberFault, Operand};
pub use function::functions;
pub use layout::Layout;
pub use misfit::ScaleMisfit;
pub use name::{NameError, check_name, is_name, looks_of};
pub use note::FormulaNote;
pub use note_product::Factors;
pub use numbers::{Numbers, Use, ValueSource};
pub use plain::{NameKind, PlainNumber};
pub use scale_fault::{ScaleFault, ScaledPlace};
pub use syntax::TableCall;
pub use typing::{KelvinKind, LevelReference, Rate, Scope, TableData, Typing};

use super::Traced;
use crate::fact::Fact;
use crate::number::{Number, smallest_first};
use crate::regression::CurveFunction;
use gumption_units::Unit;
use syntax::{NodeKind, Tree};

/// A formula that has been read.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    text: String,
    tree: Tree,
}

impl Formula {
    /// The longest formula, in bytes.
    pub const MAX_LENGTH: usize = parser::MAX_LENGTH;

    /// The deepest nesting of parentheses, calls, signs and exponents.
    pub const MAX_DEPTH: usize = parser::MAX_DEPTH;

    /// Reads a formula. What names and functions it uses is not looked at.
    ///
    /// # Errors
    /// The first place where the text does not follow the grammar.
    pub fn parse(text: &str) -> Result<Self, FormulaError> {
        Self::parse_with(text, &[], &[])
    }

    /// Reads a formula that may call calibration functions, `line(x)`, `inverse(line, y)`, and have
    /// units with names of their own in brackets, as [`Unit::defined`] makes them.
    ///
    /// # Errors
    /// As [`Formula::parse`]; a calibration function that is called in a wrong way.
    pub fn parse_with(
        text: &str,
        curves: &[Arc<CurveFunction>],
        units: &[Unit],
    ) -> Result<Self, FormulaError> {
        Ok(Self { tree: parser::parse_with(text, curves, units)?, text: text.to_owned() })
    }

    /// The text as written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The names of quantities that the formula uses, in the order of the text and as often as they
    /// occur, each with its place. Of a calibration function they are those of its parameters.
    pub fn names(&self) -> impl Iterator<Item = (&str, Range<usize>)> {
        let mut places = Vec::new();
        self.tree.names(&self.text, &mut places);
        let own = places.into_iter().filter_map(|span| Some((self.text.get(span.clone())?, span)));
        let parameters = self.tree.nodes.iter().flat_map(|node| {
            let parameters = match &node.kind {
                NodeKind::Curve { curve, .. } => curve.parameters.as_slice(),
                _ => &[],
            };
            parameters.iter().map(|(name, _)| (name.as_str(), node.span.clone()))
        });
        own.chain(parameters)
    }

    /// The tables that the formula uses, in the order of the text and as often as they occur.
    pub fn tables(&self) -> Vec<&TableCall> {
        let mut calls = Vec::new();
        self.tree.tables(&mut calls);
        calls
    }

    /// Checks names, calls and dimensions, and tells what the result is.
    ///
    /// # Errors
    /// All mistakes (fifty at most), in the order of their places; never an empty list.
    pub fn check(&self, scope: &Scope) -> Result<Typing, Vec<FormulaError>> {
        self.checked(scope, true)
    }

    /// Whether the value is complex, by the names and the calibration functions that are.
    pub fn is_complex(&self, scope: &Scope) -> bool {
        self.uses_complex(scope) && complexity::complexity(&self.text, &self.tree, scope).0
    }

    /// Checks names and calls but not dimensions, for empirical formulas. The result's dimension is
    /// known as far as the formula is consistent.
    ///
    /// # Errors
    /// All mistakes (fifty at most), in the order of their places; never an empty list.
    pub fn check_names(&self, scope: &Scope) -> Result<Typing, Vec<FormulaError>> {
        self.checked(scope, false)
    }

    /// What is right by the rules and seldom meant: `sin(30)`, which is of 30 rad, `phi + 90` of an
    /// angle in degrees. `numbers_of` tells what the numbers of a name, a column or a coordinate are in
    /// where formulas have them in coherent SI, else `None`, and `factors_of` what an equation is a product of;
    /// `of` is what the formula's value is for. What the value is a product of comes with the notes.
    pub fn notes<'u>(
        &self,
        numbers_of: impl Fn(ValueSource<'_>) -> Option<Numbers<'u>>,
        factors_of: impl Fn(&str) -> Option<Factors>,
        of: Use<'u>,
    ) -> (Vec<FormulaNote>, Option<Factors>) {
        note::notes(&self.text, &self.tree, numbers_of, factors_of, of)
    }

    /// Arguments of tables and calibration functions that are in a unit, where no unit is said of the
    /// numbers that they are looked up among: `table(a, 'c.csv')` of an angle in degrees, whose column
    /// can be of degrees or radians.
    pub fn unstated_arguments<'u>(
        &self,
        numbers_of: impl Fn(ValueSource<'_>) -> Option<Numbers<'u>>,
    ) -> Vec<FormulaError> {
        let looks_up =
            |kind: &NodeKind| matches!(kind, NodeKind::Table { .. } | NodeKind::Curve { .. });
        if !self.tree.nodes.iter().any(|node| looks_up(&node.kind)) {
            return Vec::new();
        }
        let walk = note::Walk::new(&self.text, &self.tree, &numbers_of, Use::Quantity);
        walk.unstated_arguments(numbers_of)
    }

    /// A plain number that the value of a formula of conditions is, or is a sum with, where nothing in the
    /// value has the unit of a share or an angle: `if(f > 100 [Hz], 5, 8)`. `is_width` says whether it is
    /// one of a width, which is no whole.
    pub fn plain_number(
        &self,
        kind_of: impl Fn(&str) -> NameKind,
        is_width: bool,
    ) -> Option<PlainNumber> {
        plain::plain_number(&self.text, &self.tree, kind_of, is_width)
    }

    /// What the numbers of the formula's value are in, by those of its names.
    pub fn numbers<'u>(
        &self,
        numbers_of: impl Fn(ValueSource<'_>) -> Option<Numbers<'u>>,
    ) -> Option<Numbers<'u>> {
        note::Walk::new(&self.text, &self.tree, numbers_of, Use::Quantity).whole()?.numbers()
    }

    /// A factor of the value, or of a term of it, that converts to a unit in which `what` is reported,
    /// which converts it once more: `(a - b)/b*1e6 + c` in ppm. `what` is a part of the note.
    pub fn converted_to<'u>(
        &self,
        numbers_of: impl Fn(ValueSource<'_>) -> Option<Numbers<'u>>,
        factors_of: impl Fn(&str) -> Option<Factors>,
        unit: &'u Unit,
        what: &Fact,
    ) -> Option<FormulaNote> {
        let walk = note::Walk::new(&self.text, &self.tree, &numbers_of, Use::Quantity);
        let of_products = || {
            let mut found = Vec::new();
            let all = note_product::factors(&walk, &numbers_of, factors_of);
            walk.of_products(&all, Some((unit, what)), &mut found);
            found.into_iter().next()
        };
        walk.of_ratio(unit, what).or_else(of_products)
    }

    /// The names that the value is a sum, a small multiple or a choice of.
    pub fn terms(&self) -> Vec<&str> {
        let terms = note_result::terms(&self.tree, &evaluate::constants(&self.tree)).into_iter();
        let names = terms.filter_map(|term| self.tree.nodes.get(term.index));
        let names = names.filter(|node| node.kind == NodeKind::Name);
        names.filter_map(|node| self.text.get(node.span.clone())).collect()
    }

    /// A term of the value that multiplies what is per revolution by a rate that was given in
    /// revolutions and counts radians: `Vg*n`, `pi*d*n`.
    pub fn of_revolutions(&self, scope: &Scope) -> Option<FormulaNote> {
        note_turns::of_revolutions(&self.text, &self.tree, scope)
    }

    /// Functions of angles that take what counts periods: `sin(f*t)` of an `f` in Hz. `unit_of` gives
    /// the units of names that are given in one.
    pub fn periods_as_radians<'u>(
        &self,
        scope: &Scope,
        unit_of: impl Fn(&str) -> Option<&'u Unit>,
    ) -> Vec<FormulaNote> {
        note_turns::periods(&self.text, &self.tree, scope, unit_of)
    }

    /// A term of a value in Hz that is an angular frequency by what it is made of: `sqrt(k/m)`,
    /// `1/sqrt(L*C)`, `1/(R*C)`.
    pub fn angular_frequency(&self, scope: &Scope) -> Option<FormulaNote> {
        note_frequency::angular(&self.text, &self.tree, scope)
    }

    /// A term of the value that multiplies a torque by periods in a time: `M*n` of N m and 1/min. `unit_of`
    /// gives the units of names that are given in one.
    pub fn torque_by_periods<'u>(
        &self,
        unit_of: impl Fn(&str) -> Option<&'u Unit>,
    ) -> Option<FormulaNote> {
        note_frequency::torque(&self.text, &self.tree, unit_of)
    }

    /// A level with the factor of another kind of quantity: `10*log10` of a ratio of voltages, `20*log10`
    /// of one of powers.
    pub fn level_of_other_kind(&self, scope: &Scope) -> Option<FormulaNote> {
        note_level::of_other_kind(&self.text, &self.tree, scope)
    }

    /// The names that `sin`, `cos` and `tan` take as they are, with the name of the function.
    pub fn angles(&self) -> impl Iterator<Item = (&'static str, &str)> {
        self.tree.nodes.iter().filter_map(|node| {
            let NodeKind::Call { function: Some(function), arguments, .. } = &node.kind else {
                return None;
            };
            let [argument] = arguments.as_slice() else { return None };
            let of = self.tree.nodes.get(*argument).filter(|of| of.kind == NodeKind::Name)?;
            function.takes_angle().then_some((function.name(), self.text.get(of.span.clone())?))
        })
    }

    /// Where the formula calls calibration functions: each with the text of the x at which it is used,
    /// its argument or, of `inverse(line, y)`, the whole call.
    pub fn curve_calls(&self) -> impl Iterator<Item = (&Arc<CurveFunction>, &str)> {
        self.tree.nodes.iter().filter_map(|node| {
            let NodeKind::Curve { curve, inverse, argument } = &node.kind else { return None };
            let span = if *inverse { node.span.clone() } else { self.tree.span(*argument) };
            Some((curve, self.text.get(span)?))
        })
    }

    /// Whether there are complex names, or calibration functions with complex values.
    fn uses_complex(&self, scope: &Scope) -> bool {
        scope.has_complex() || self.curve_calls().any(|(curve, _)| curve.fit.is_complex())
    }

    fn checked(&self, scope: &Scope, units: bool) -> Result<Typing, Vec<FormulaError>> {
        let dimension::Checked { typings, constants, mut errors } =
            dimension::check(&self.text, &self.tree, scope, units);
        if self.uses_complex(scope) {
            errors.extend(complexity::complexity(&self.text, &self.tree, scope).1);
        }
        if !units {
            errors.extend(brackets::misread(&self.text, &self.tree, scope));
        }
        if errors.is_empty() {
            errors.extend(undefined::constant_part(&self.text, &self.tree, &constants));
        }
        if errors.is_empty() {
            return Ok(typings.last().copied().unwrap_or(Typing::ANY));
        }
        smallest_first(&mut errors, |error| error.span().start as f64);
        Err(errors)
    }

    /// Computes the formula from the values of its names, which are in coherent SI units (degrees
    /// Celsius as they are). The scope tells `kelvin` what its argument is.
    ///
    /// # Errors
    /// A name without a value, or a call that [`Formula::check_names`] reports.
    pub fn evaluate<T: Number>(
        &self,
        scope: &Scope,
        values: &HashMap<String, T>,
    ) -> Result<T, FormulaError> {
        evaluate::evaluate(&self.text, &self.tree, scope, values)
    }

    /// Writes the formula down as part of a program: [`Formula::evaluate`] with recording numbers.
    ///
    /// # Errors
    /// As [`Formula::evaluate`].
    pub fn record<'r>(
        &self,
        scope: &Scope,
        values: &HashMap<String, Traced<'r>>,
    ) -> Result<Traced<'r>, FormulaError> {
        self.evaluate(scope, values)
    }
}
