//! Computing a formula with any kind of number.

use std::collections::HashMap;
use std::sync::Arc;

use super::dimension::check;
use super::error::FormulaError;
use super::function::{ComplexPart, Function};
use super::suggest;
use super::syntax::{Joint, NodeKind, Operator, Tree};
use super::typing::{Scope, Typing};
use crate::model::{NumberForm, Recorder, Root, Traced, in_unit};
use crate::number::{Binary, Number, Routine, Unary};
use gumption_units::{Dimension, Unit, Zero};

/// The zero of the Celsius scale in K.
const CELSIUS_ZERO: f64 = 273.15;

/// The largest exponent, in size, of a power that is computed by multiplication.
const MAX_WHOLE: f64 = 64.0;

/// Computes a formula.
pub(super) fn evaluate<T: Number>(
    text: &str,
    tree: &Tree,
    scope: &Scope,
    values: &HashMap<String, T>,
) -> Result<T, FormulaError> {
    // few values depend on what their parts are
    let typings =
        if tree.needs_typings() { check(text, tree, scope, false).typings } else { Vec::new() };
    let constants = constants(tree);
    let mut results: Vec<T> = Vec::with_capacity(tree.nodes.len());
    for node in &tree.nodes {
        if let NodeKind::Infix { operator: Operator::Divide, left, right, .. } = &node.kind
            && let Some((from, to)) = converted(text, tree, scope, [*left, *right])
        {
            let value = at(&results, *left);
            results.push(if from.factor() == to.factor() && from.offset() == to.offset() {
                value
            } else {
                (value * from.factor() + (from.offset() - to.offset())) / to.factor()
            });
            continue;
        }
        let result = match &node.kind {
            NodeKind::Name => {
                let name = text.get(node.span.clone()).unwrap_or_default();
                let value = values.get(name).copied();
                value.ok_or_else(|| FormulaError::UnknownName {
                    name: name.to_owned(),
                    span: node.span.clone(),
                    nearest: suggest::names(name, scope.names()),
                    known: scope.names().map(str::to_owned).collect(),
                })?
            }
            NodeKind::Call {
                function: Some(function @ (Function::Kelvin | Function::Celsius)),
                arguments,
                ..
            } if arguments.len() == 1 => {
                // no node has the number that stands for a missing argument
                let argument = arguments.first().copied().unwrap_or(usize::MAX);
                let typing = typings.get(argument).copied().unwrap_or(Typing::ANY);
                let value = at(&results, argument);
                if let Some(unit) = declared(text, tree, scope, argument)
                    && unit.dimension() == Dimension::TEMPERATURE
                    && (unit.factor() != 1.0 || unit.offset() != 0.0)
                {
                    results.push(temperature(value, unit, *function));
                    continue;
                }
                match function {
                    Function::Kelvin if typing.kelvin_shifts() => value + CELSIUS_ZERO,
                    Function::Celsius if typing.celsius_shifts() => value - CELSIUS_ZERO,
                    _ => value,
                }
            }
            NodeKind::Infix { operator: Operator::Divide, left, right, .. }
                if typings.get(*left).is_some_and(|typing| typing.zero.is_some()) =>
            {
                let zero = typings.get(*left).and_then(|typing| typing.zero);
                let shift = match tree.nodes.get(*right).map(|node| &node.kind) {
                    Some(NodeKind::Unit(unit)) if unit.zero().is_some() => {
                        Zero::shift(zero, unit.zero()).unwrap_or(0.0) - unit.offset()
                    }
                    _ => 0.0,
                };
                shifted(at(&results, *left), shift) / at(&results, *right)
            }
            NodeKind::Curve { curve, inverse, argument } => {
                let typing = typings.get(*argument).copied().unwrap_or(Typing::ANY);
                let from = if *inverse { &curve.y } else { &curve.x };
                let argument = at(&results, *argument);
                let argument = match curve.form {
                    NumberForm::Coherent => in_unit(argument, from, typing),
                    NumberForm::Declared => argument,
                };
                let parameters: Option<Vec<T>> =
                    curve.parameters.iter().map(|(name, _)| values.get(name).copied()).collect();
                let parameters = parameters.ok_or_else(|| FormulaError::UnknownName {
                    name: curve.fit.name.clone(),
                    span: node.span.clone(),
                    nearest: Vec::new(),
                    known: Vec::new(),
                })?;
                curve.value(argument, &parameters, *inverse)
            }
            NodeKind::InUnit { number, unit } => {
                match tree.nodes.get(*number).map(|node| &node.kind) {
                    Some(NodeKind::Number(number)) => T::constant(unit.value_to_si(*number)),
                    _ if unit.offset() == 0.0 => at(&results, *number) * unit.factor(),
                    _ => at(&results, *number) * unit.factor() + unit.offset(),
                }
            }
            NodeKind::Table { x, call } => match scope.table(call) {
                Some(Some(data)) => {
                    // the abscissas count from the zero of their column
                    let zero = typings.get(*x).and_then(|typing| typing.zero);
                    let shift = zero.and(Zero::shift(zero, data.units[0].zero())).unwrap_or(0.0);
                    let routine: Arc<dyn Routine> = Arc::clone(&data.table) as _;
                    T::routine(&routine, &[shifted(at(&results, *x), shift)])
                }
                _ => {
                    let (file, span) = (call.file.clone(), call.span.clone());
                    return Err(FormulaError::TableOutOfPlace { file, span });
                }
            },
            NodeKind::Solve { body, unknown, from, to } => {
                let typing = [from, to].map(|end| typings.get(*end).copied());
                let typing = typing.into_iter().flatten().find(|typing| typing.dimension.is_some());
                let mut inner = scope.clone();
                let name = text.get(unknown.clone()).unwrap_or_default();
                inner.define(name, typing.unwrap_or(Typing::ANY));
                let (root, names) = root(text, body, &inner, name)?;
                let mut operands = vec![at(&results, *from), at(&results, *to)];
                for name in names {
                    operands.push(value_of(&name, values).ok_or_else(|| {
                        let (span, nearest, known) = (node.span.clone(), Vec::new(), Vec::new());
                        FormulaError::UnknownName { name, span, nearest, known }
                    })?);
                }
                let routine: Arc<dyn Routine> = Arc::new(root);
                T::routine(&routine, &operands)
            }
            kind => apply(kind, &results, &constants).ok_or_else(|| wrong_call(text, kind))?,
        };
        results.push(result);
    }
    Ok(results.pop().unwrap_or_else(|| T::constant(f64::NAN)))
}

fn shifted<T: Number>(value: T, by: f64) -> T {
    if by == 0.0 { value } else { value + by }
}

/// The unit that the value of a node is the number in, if the node is a name whose units are not
/// checked.
fn declared<'s>(text: &str, tree: &Tree, scope: &'s Scope, index: usize) -> Option<&'s Unit> {
    let node = tree.nodes.get(index).filter(|node| node.kind == NodeKind::Name)?;
    scope.declared(text.get(node.span.clone())?)
}

/// A temperature of a name whose units are not checked, in K or in degC.
fn temperature<T: Number>(value: T, unit: &Unit, function: Function) -> T {
    let coherent = value * unit.factor();
    match (function, unit.is_celsius()) {
        (Function::Kelvin, true) => coherent + (unit.offset() + CELSIUS_ZERO),
        (Function::Celsius, false) => coherent - CELSIUS_ZERO,
        _ => coherent + unit.offset(),
    }
}

/// The two units of a name whose units are not checked and of the unit in brackets that it is
/// divided by, where the quotient is the number of one in the other.
fn converted<'s>(
    text: &str,
    tree: &'s Tree,
    scope: &'s Scope,
    [left, right]: [usize; 2],
) -> Option<(&'s Unit, &'s Unit)> {
    let from = declared(text, tree, scope, left)?;
    let to = match tree.nodes.get(right).map(|node| &node.kind) {
        Some(NodeKind::Unit(unit)) => unit.as_ref(),
        _ => return None,
    };
    let is_alike = from.is_compatible(to) && from.zero() == to.zero();
    is_alike.then_some((from, to))
}

/// The value of every node that depends on no name and has no unit.
pub(super) fn constants(tree: &Tree) -> Vec<Option<f64>> {
    let mut constants: Vec<Option<f64>> = Vec::with_capacity(tree.nodes.len());
    let mut values: Vec<f64> = Vec::with_capacity(tree.nodes.len());
    for node in &tree.nodes {
        let known = |index: &usize| constants.get(*index).is_some_and(Option::is_some);
        let is_constant = match &node.kind {
            NodeKind::Number(_) | NodeKind::Pi => true,
            NodeKind::Name
            | NodeKind::Unit(_)
            | NodeKind::Constant(_)
            | NodeKind::InUnit { .. } => false,
            NodeKind::Table { .. } | NodeKind::Solve { .. } | NodeKind::Curve { .. } => false,
            NodeKind::Joined { left, right, .. } => known(left) && known(right),
            NodeKind::Not { of, .. } => known(of),
            NodeKind::Negate(x) => known(x),
            NodeKind::Infix { left, right, .. } => known(left) && known(right),
            NodeKind::Call {
                function: None | Some(Function::Kelvin | Function::Celsius), ..
            } => false,
            NodeKind::Call { arguments, .. } => arguments.iter().all(known),
        };
        let value = if is_constant { apply(&node.kind, &values, &constants) } else { None };
        constants.push(value);
        values.push(value.unwrap_or(f64::NAN));
    }
    constants
}

/// One node from those before it; `None` for a call that is wrong, and for a name.
fn apply<T: Number>(kind: &NodeKind, results: &[T], constants: &[Option<f64>]) -> Option<T> {
    Some(match kind {
        NodeKind::Number(value) => T::constant(*value),
        NodeKind::Pi => T::constant(std::f64::consts::PI),
        NodeKind::Name
        | NodeKind::InUnit { .. }
        | NodeKind::Table { .. }
        | NodeKind::Solve { .. }
        | NodeKind::Curve { .. } => return None,
        NodeKind::Joined { joint, left, right, .. } => {
            let [x, y] = [left, right].map(|part| truth(at(results, *part)));
            match joint {
                Joint::And => x * y,
                Joint::Or => x.max(y),
            }
        }
        NodeKind::Not { of, .. } => at(results, *of).binary(Binary::Equal, T::constant(0.0)),
        NodeKind::Unit(unit) => T::constant(unit.factor()),
        NodeKind::Constant(constant) => T::constant(constant.value()),
        NodeKind::Negate(x) => -at(results, *x),
        NodeKind::Infix { operator: Operator::Power, left, right, .. } => {
            let exponent = constants.get(*right).copied().flatten();
            power(at(results, *left), at(results, *right), exponent)
        }
        NodeKind::Infix { operator, left, right, .. } => {
            infix(*operator, at(results, *left), at(results, *right))
        }
        NodeKind::Call { function, arguments, .. } => {
            let function = (*function)?;
            if !function.arity().admits(arguments.len()) {
                return None;
            }
            let mut arguments = arguments.iter().map(|&index| at(results, index));
            let first = arguments.next()?;
            match function {
                Function::One(operation) => first.unary(operation),
                Function::Two(operation) | Function::Fold(operation) => {
                    arguments.fold(first, |result, argument| result.binary(operation, argument))
                }
                Function::Part(ComplexPart::Real) => first.real_part(),
                Function::Part(ComplexPart::Imaginary) => first.imaginary_part(),
                Function::Part(ComplexPart::Argument) => first.argument(),
                Function::Part(ComplexPart::Conjugate) => first.conjugate(),
                Function::If => {
                    let (yes, no) = (arguments.next()?, arguments.next()?);
                    first.binary(Binary::When, yes) + first.binary(Binary::Unless, no)
                }
                Function::Sum
                | Function::Mean
                | Function::Kelvin
                | Function::Celsius
                | Function::Table
                | Function::Solve => return None,
            }
        }
    })
}

/// 1 for a number that is not 0.
fn truth<T: Number>(x: T) -> T {
    x.binary(Binary::NotEqual, T::constant(0.0))
}

fn value_of<T: Copy>(name: &str, values: &HashMap<String, T>) -> Option<T> {
    values.get(name).copied()
}

/// The equation of a body as a function of the unknown and of the names that come with it.
fn root(
    text: &str,
    body: &Tree,
    scope: &Scope,
    unknown: &str,
) -> Result<(Root, Vec<String>), FormulaError> {
    let mut places = Vec::new();
    body.names(text, &mut places);
    let mut names: Vec<String> = Vec::new();
    for name in places.into_iter().filter_map(|span| text.get(span)) {
        if name != unknown && !names.iter().any(|known| known == name) {
            names.push(name.to_owned());
        }
    }
    let recorder = Recorder::default();
    let all = std::iter::once(unknown).chain(names.iter().map(String::as_str));
    let values: HashMap<String, Traced<'_>> =
        all.zip(0..).map(|(name, index)| (name.to_owned(), recorder.variable(index))).collect();
    let result = evaluate(text, body, scope, &values)?;
    let program = recorder.program(names.len() + 1, &[result]);
    Ok((Root::new(unknown, program), names))
}

fn infix<T: Number>(operator: Operator, x: T, y: T) -> T {
    match operator {
        Operator::Add => x + y,
        Operator::Subtract => x - y,
        Operator::Multiply => x * y,
        Operator::Divide => x / y,
        Operator::Power => x.pow(y),
        Operator::Less => x.binary(Binary::Less, y),
        Operator::LessOrEqual => x.binary(Binary::LessOrEqual, y),
        Operator::Greater => y.binary(Binary::Less, x),
        Operator::GreaterOrEqual => y.binary(Binary::LessOrEqual, x),
        Operator::Equal => x.binary(Binary::Equal, y),
        Operator::NotEqual => x.binary(Binary::NotEqual, y),
    }
}

/// A power; whole exponents by multiplication, so that the base may be negative.
fn power<T: Number>(base: T, exponent: T, constant: Option<f64>) -> T {
    match constant {
        Some(whole) if whole.trunc() == whole && whole.abs() <= MAX_WHOLE => {
            base.powi(whole as i32)
        }
        Some(0.5) => base.unary(Unary::Sqrt),
        _ => base.pow(exponent),
    }
}

fn at<T: Number>(results: &[T], index: usize) -> T {
    results.get(index).copied().unwrap_or_else(|| T::constant(f64::NAN))
}

/// The error for a call that cannot be computed.
fn wrong_call(text: &str, kind: &NodeKind) -> FormulaError {
    let NodeKind::Call { function, name_span, arguments } = kind else {
        return FormulaError::Empty;
    };
    let span = name_span.clone();
    match function {
        Some(function) => FormulaError::ArgumentCount {
            function: function.name(),
            span,
            expected: function.arity(),
            found: arguments.len(),
            suggestion: None,
        },
        None => {
            let name = text.get(span.clone()).unwrap_or_default().to_owned();
            FormulaError::UnknownFunction { nearest: suggest::functions(&name), name, span }
        }
    }
}
