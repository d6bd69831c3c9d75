//! The forms of calibration functions.

use crate::model::{Node, Program};
use crate::number::{Binary, Dual, Number};

/// A function of one variable with parameters.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Curve {
    /// a + b (x - origin) + c (x - origin)^2 + ...
    Polynomial {
        /// The highest power.
        degree: usize,
        /// Where the powers count from.
        origin: f64,
    },
    /// A program whose variables are x, then the parameters, and whose output is y; the outputs of
    /// a complex curve are the real and the imaginary part.
    Program(Program),
}

/// Number of variables for simultaneous differentiation.
const AT_A_TIME: usize = 8;

/// Number of bisections before Newton's method: the root is then known to 2e-5 of the range.
const HALVINGS: usize = 16;

/// Number of Newton steps thereafter; three already give all digits.
const STEPS: usize = 4;

/// Step of a difference quotient, as a fraction of the range.
const DIFFERENCE: f64 = 1e-5;

impl Curve {
    /// A polynomial of this degree in x itself; degree 1 is a straight line.
    pub fn polynomial(degree: usize) -> Self {
        Self::Polynomial { degree, origin: 0.0 }
    }

    /// The number of parameters.
    pub fn parameters(&self) -> usize {
        match self {
            Self::Polynomial { degree, .. } => degree + 1,
            Self::Program(program) => program.variables().saturating_sub(1),
        }
    }

    /// Whether its values are complex.
    pub fn is_complex(&self) -> bool {
        matches!(self, Self::Program(program) if program.outputs() == 2)
    }

    /// Real and imaginary part of a complex curve at x.
    pub fn parts<T: Number>(&self, x: T, parameters: &[T]) -> [T; 2] {
        let Self::Program(program) = self else { return [T::constant(f64::NAN); 2] };
        let variables: Vec<T> = std::iter::once(x).chain(parameters.iter().copied()).collect();
        let mut outputs = program.evaluate(&variables).into_iter();
        [(); 2].map(|()| outputs.next().unwrap_or_else(|| T::constant(f64::NAN)))
    }

    /// The curve's value at x; NaN for a complex curve.
    pub fn value<T: Number>(&self, x: T, parameters: &[T]) -> T {
        match self {
            Self::Polynomial { origin, .. } => {
                let x = if *origin == 0.0 { x } else { x - *origin };
                let mut powers = parameters.iter().rev().copied();
                let highest = powers.next().unwrap_or_else(|| T::constant(0.0));
                powers.fold(highest, |sum, parameter| sum * x + parameter)
            }
            Self::Program(_) if self.is_complex() => T::constant(f64::NAN),
            Self::Program(program) => {
                let variables: Vec<T> =
                    std::iter::once(x).chain(parameters.iter().copied()).collect();
                let value = program.evaluate(&variables).pop();
                value.unwrap_or_else(|| T::constant(f64::NAN))
            }
        }
    }

    /// The x in or near the range at which the curve has the value y; NaN if there is none. Over
    /// the range the curve increases (`sign` 1) or decreases (`sign` -1).
    ///
    /// A straight line has its own formula. Any other curve is solved by bisection of the range,
    /// with the same steps for all trials, and by Newton's steps, which also carry the exact
    /// derivatives.
    pub fn inverse<T: Number>(&self, y: T, parameters: &[T], range: [f64; 2], sign: f64) -> T {
        if let (Self::Polynomial { degree: 1, origin }, [a, b]) = (self, parameters) {
            let x = (y - *a) / *b;
            return if *origin == 0.0 { x } else { x + *origin };
        }
        let width = range[1] - range[0];
        let (mut least, mut most) = (T::constant(range[0]), T::constant(range[1]));
        for _ in 0..HALVINGS {
            let middle = (least + most) * 0.5;
            let missing = (y - self.value(middle, parameters)) * sign;
            // 1 if the root lies above the middle
            let above = T::constant(0.0).binary(Binary::Less, missing);
            least = least + above * (middle - least);
            most = middle + above * (most - middle);
        }
        let mut x = (least + most) * 0.5;
        for _ in 0..STEPS {
            x = x + (y - self.value(x, parameters)) / self.slope(x, parameters, width);
        }
        // without a root NaN: far beyond the range the steps may end anywhere
        let left = (y - self.value(x, parameters)).abs() / self.slope(x, parameters, width).abs();
        x + (T::constant(1e-6 * width) - left).sqrt() * 0.0
    }

    /// The slope at x: for a program a central difference, whose second-order error does not
    /// noticeably slow Newton's method.
    fn slope<T: Number>(&self, x: T, parameters: &[T], width: f64) -> T {
        match self {
            Self::Polynomial { origin, .. } => {
                let x = if *origin == 0.0 { x } else { x - *origin };
                let mut terms =
                    parameters.iter().enumerate().skip(1).rev().map(|(k, p)| *p * k as f64);
                let highest = terms.next().unwrap_or_else(|| T::constant(0.0));
                terms.fold(highest, |sum, term| sum * x + term)
            }
            Self::Program(_) => {
                let step = DIFFERENCE * width;
                let [above, below] = [x + step, x - step].map(|x| self.value(x, parameters));
                (above - below) / (2.0 * step)
            }
        }
    }
}

/// A program that is differentiated at many points: the values of its nodes are reused.
#[derive(Clone, Debug)]
pub(super) struct Differentiated<'p> {
    program: &'p Program,
    values: Vec<Dual<AT_A_TIME>>,
    variables: Vec<f64>,
}

impl<'p> Differentiated<'p> {
    pub(super) fn of(program: &'p Program) -> Self {
        Self { program, values: Vec::new(), variables: vec![0.0; program.variables()] }
    }

    /// The value at x, the derivative with respect to x, and those with respect to the parameters.
    pub(super) fn at(&mut self, x: f64, parameters: &[f64], each: &mut [f64]) -> (f64, f64) {
        let [(value, slope)] = self.outputs(x, parameters, [each]);
        (value, slope)
    }

    /// The same for each output; NaN if there is another number of them.
    pub(super) fn outputs<const N: usize>(
        &mut self,
        x: f64,
        parameters: &[f64],
        mut each: [&mut [f64]; N],
    ) -> [(f64, f64); N] {
        if let Some((first, rest)) = self.variables.split_first_mut() {
            *first = x;
            rest.copy_from_slice(parameters);
        }
        let mut found = [(f64::NAN, f64::NAN); N];
        if self.program.outputs.len() != N {
            return found;
        }
        for first in (0..self.variables.len()).step_by(AT_A_TIME) {
            self.values.clear();
            for node in &self.program.nodes {
                let value = match *node {
                    Node::Variable(v) => {
                        let x = self.variables.get(v).copied().unwrap_or(0.0);
                        match v.checked_sub(first) {
                            Some(index) => Dual::variable(x, index),
                            None => Dual::constant(x),
                        }
                    }
                    Node::Constant(c) => Dual::constant(c),
                    Node::Unary(operation, x) => self.values[x].unary(operation),
                    Node::Binary(operation, x, y) => {
                        self.values[x].binary(operation, self.values[y])
                    }
                    Node::Routine(call) => {
                        let call = &self.program.routines[call];
                        let operands: Vec<_> =
                            call.operands.iter().map(|&x| self.values[x]).collect();
                        Dual::routine(&call.routine, &operands)
                    }
                };
                self.values.push(value);
            }
            let outputs = self.program.outputs.iter().zip(&mut found).zip(&mut each);
            for ((&output, (value, slope)), each) in outputs {
                let dual = self.values[output];
                *value = dual.value;
                for (index, derivative) in dual.gradient.into_iter().enumerate() {
                    match (first + index).checked_sub(1) {
                        None => *slope = derivative,
                        Some(parameter) => {
                            if let Some(place) = each.get_mut(parameter) {
                                *place = derivative;
                            }
                        }
                    }
                }
            }
        }
        found
    }
}
