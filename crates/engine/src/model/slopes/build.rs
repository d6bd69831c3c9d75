//! The steps of a program with derivatives.

use std::collections::{BTreeMap, HashMap};

use super::registers::{self, Arena};
use super::{Slope, SlopeStep, Slopes};
use crate::model::program::{Node, Program};
use crate::number::{Binary, Number, Operand, Unary, derivative, smallest_first};

/// At most so many steps on derivatives; programs beyond it take them one row after the other.
const MOST_STEPS: usize = 100_000;

/// What is known of a node: its value, and its derivatives by the variables that it depends on.
#[derive(Clone, Debug)]
struct NodeSlopes {
    value: Operand,
    gradient: BTreeMap<usize, Operand>,
}

/// Registers are numbered as they come; [`registers::assign`] assigns the final ones.
#[derive(Debug, Default)]
struct Builder {
    steps: Vec<SlopeStep>,
    registers: [usize; 2],
    filled: [HashMap<u64, usize>; 2],
    /// Of the angles that a sine or a cosine was taken of, both.
    angles: HashMap<usize, [usize; 2]>,
}

pub(super) fn build(program: &Program, same: &[Option<f64>], wanted: usize) -> Option<Slopes> {
    // functions of several numbers have their derivatives one row after the other
    if program.goes_backward() || !program.routines.is_empty() {
        return None;
    }
    let needed = program.needed_by(&[], program.outputs.iter().copied());
    let mut builder = Builder::default();
    let mut varying = Vec::new();
    let mut known: Vec<Option<NodeSlopes>> = Vec::with_capacity(program.nodes.len());
    for (node, needed) in program.nodes.iter().zip(needed) {
        let at = |index: usize| known.get(index).and_then(Option::as_ref);
        let made = match *node {
            _ if !needed => None,
            Node::Constant(c) => Some(NodeSlopes::constant(c)),
            Node::Variable(v) => {
                let value = same.get(v).copied().flatten().map_or_else(
                    || {
                        let register = builder.register(Arena::Values);
                        varying.push((v, register));
                        Operand::Register(register)
                    },
                    Operand::Constant,
                );
                let own = (v < wanted).then_some((v, Operand::Constant(1.0)));
                Some(NodeSlopes { value, gradient: own.into_iter().collect() })
            }
            Node::Unary(operation, x) => Some(builder.unary(operation, at(x)?)),
            Node::Binary(operation, x, y) => Some(builder.binary(operation, at(x)?, at(y)?)),
            Node::Routine(_) => return None,
        };
        known.push(made);
        if builder.steps.len() > MOST_STEPS {
            return None;
        }
    }
    let outputs = program.outputs.iter().map(|&output| {
        let of = known.get(output)?.clone()?;
        Some(Slope { value: of.value, gradient: of.gradient.into_iter().collect() })
    });
    let outputs: Option<Vec<Slope>> = outputs.collect();
    let filled = builder.filled.map(|filled| {
        let mut pairs: Vec<(usize, f64)> =
            filled.into_iter().map(|(bits, register)| (register, f64::from_bits(bits))).collect();
        smallest_first(&mut pairs, |(register, _)| *register as f64);
        pairs
    });
    let steps = builder.steps;
    let made = Slopes { steps, registers: builder.registers, filled, varying, outputs: outputs? };
    Some(registers::assign(made))
}

impl NodeSlopes {
    fn constant(value: f64) -> Self {
        Self { value: Operand::Constant(value), gradient: BTreeMap::new() }
    }
}

impl Builder {
    fn register(&mut self, arena: Arena) -> usize {
        let next = &mut self.registers[arena as usize];
        *next += 1;
        *next - 1
    }

    /// The register of an operand; a number gets one that is filled with it.
    fn fill(&mut self, arena: Arena, operand: Operand) -> usize {
        match operand {
            Operand::Register(register) => register,
            Operand::Constant(value) => {
                let bits = value.to_bits();
                if let Some(&register) = self.filled[arena as usize].get(&bits) {
                    return register;
                }
                let register = self.register(arena);
                self.filled[arena as usize].insert(bits, register);
                register
            }
        }
    }

    fn value(&mut self, step: impl FnOnce(usize) -> SlopeStep) -> Operand {
        let out = self.register(Arena::Values);
        self.steps.push(step(out));
        Operand::Register(out)
    }

    fn unary(&mut self, operation: Unary, of: &NodeSlopes) -> NodeSlopes {
        let x = match of.value {
            Operand::Constant(x) => {
                let y = x.unary(operation);
                let slope = Operand::Constant(derivative::unary(operation, x, y));
                let gradient = self.chain_all(&of.gradient, slope);
                return NodeSlopes { value: Operand::Constant(y), gradient };
            }
            Operand::Register(x) => x,
        };
        let (value, slope) = match operation {
            Unary::Sin | Unary::Cos => {
                let [sin, cos] = self.sin_cos(x);
                if operation == Unary::Sin {
                    (sin, Operand::Register(cos))
                } else {
                    let slope = (!of.gradient.is_empty())
                        .then(|| self.value(|out| SlopeStep::Unary(Unary::Negate, sin, out)));
                    (cos, slope.unwrap_or(Operand::Constant(0.0)))
                }
            }
            _ => {
                let out = self.register(Arena::Values);
                self.steps.push(SlopeStep::Unary(operation, x, out));
                let slope = match operation {
                    _ if of.gradient.is_empty() => Operand::Constant(0.0),
                    Unary::Negate => Operand::Constant(-1.0),
                    Unary::Exp => Operand::Register(out),
                    _ => {
                        self.value(|slope| SlopeStep::SlopeOfUnary { operation, x, y: out, slope })
                    }
                };
                (out, slope)
            }
        };
        NodeSlopes {
            value: Operand::Register(value),
            gradient: self.chain_all(&of.gradient, slope),
        }
    }

    /// Sine and cosine of an angle, which stand in a model together more often than not.
    fn sin_cos(&mut self, angle: usize) -> [usize; 2] {
        if let Some(&both) = self.angles.get(&angle) {
            return both;
        }
        let [sin, cos] = [self.register(Arena::Values), self.register(Arena::Values)];
        self.steps.push(SlopeStep::SinCos { angle, sin, cos });
        self.angles.insert(angle, [sin, cos]);
        [sin, cos]
    }

    fn binary(&mut self, operation: Binary, first: &NodeSlopes, second: &NodeSlopes) -> NodeSlopes {
        let (x, y) = (first.value, second.value);
        let value = match (x, y) {
            (Operand::Constant(x), Operand::Constant(y)) => {
                Operand::Constant(x.binary(operation, y))
            }
            _ => self.value(|out| SlopeStep::Binary(operation, x, y, out)),
        };
        let mut variables: Vec<usize> =
            first.gradient.keys().chain(second.gradient.keys()).copied().collect();
        variables.sort_unstable();
        variables.dedup();
        if variables.is_empty() || operation.is_flat() {
            return NodeSlopes { value, gradient: BTreeMap::new() };
        }
        let by_variable = |known: &NodeSlopes, v: usize| known.gradient.get(&v).copied();
        let chosen = operation.chooses();
        let slopes = if chosen { [x, y] } else { self.slopes(operation, x, y, value) };
        let gradient = variables.into_iter().map(|v| {
            let of = [by_variable(first, v), by_variable(second, v)];
            let out = if chosen {
                self.choose(operation, slopes, of)
            } else {
                self.chain_two(of, slopes)
            };
            (v, out)
        });
        NodeSlopes { value, gradient: gradient.collect() }
    }

    /// The derivatives of an operation by its operands.
    fn slopes(
        &mut self,
        operation: Binary,
        x: Operand,
        y: Operand,
        value: Operand,
    ) -> [Operand; 2] {
        if let (Operand::Constant(x), Operand::Constant(y), Operand::Constant(value)) =
            (x, y, value)
        {
            return derivative::binary(operation, x, y, value).map(Operand::Constant);
        }
        match operation {
            Binary::Add => [Operand::Constant(1.0), Operand::Constant(1.0)],
            Binary::Subtract => [Operand::Constant(1.0), Operand::Constant(-1.0)],
            Binary::Multiply => [y, x],
            _ => {
                let [x, y, value] = [x, y, value].map(|of| self.fill(Arena::Values, of));
                let slopes = [self.register(Arena::Values), self.register(Arena::Values)];
                self.steps.push(SlopeStep::SlopesOfBinary { operation, x, y, value, slopes });
                slopes.map(Operand::Register)
            }
        }
    }

    fn gradient(&mut self, step: impl FnOnce(usize) -> SlopeStep) -> Operand {
        let out = self.register(Arena::Gradients);
        self.steps.push(step(out));
        Operand::Register(out)
    }

    fn chain_all(
        &mut self,
        gradient: &BTreeMap<usize, Operand>,
        slope: Operand,
    ) -> BTreeMap<usize, Operand> {
        gradient.iter().map(|(&v, &of)| (v, self.chain(of, slope))).collect()
    }

    fn chain(&mut self, gradient: Operand, slope: Operand) -> Operand {
        if let (Operand::Constant(gradient), Operand::Constant(slope)) = (gradient, slope) {
            return Operand::Constant(derivative::chain(gradient, slope));
        }
        let gradient = self.fill(Arena::Gradients, gradient);
        let slope = self.fill(Arena::Values, slope);
        self.gradient(|out| SlopeStep::Chain { gradient, slope, out })
    }

    fn chain_two(&mut self, of: [Option<Operand>; 2], slopes: [Operand; 2]) -> Operand {
        let [first, second] = match of {
            [Some(first), Some(second)] => [first, second],
            [Some(first), None] => return self.chain(first, slopes[0]),
            [None, Some(second)] => return self.chain(second, slopes[1]),
            [None, None] => return Operand::Constant(0.0),
        };
        if let [Operand::Constant(first), Operand::Constant(second)] = [first, second]
            && let [Operand::Constant(by_first), Operand::Constant(by_second)] = slopes
        {
            let sum = derivative::chain(first, by_first) + derivative::chain(second, by_second);
            return Operand::Constant(sum);
        }
        let gradients = [first, second].map(|of| self.fill(Arena::Gradients, of));
        let slopes = slopes.map(|of| self.fill(Arena::Values, of));
        self.gradient(|out| SlopeStep::ChainTwo { gradients, slopes, out })
    }

    fn choose(&mut self, operation: Binary, of: [Operand; 2], by: [Option<Operand>; 2]) -> Operand {
        let by = by.map(|of| of.unwrap_or(Operand::Constant(0.0)));
        if let (
            [Operand::Constant(x), Operand::Constant(y)],
            [Operand::Constant(first), Operand::Constant(second)],
        ) = (of, by)
        {
            let [by_first, by_second] = derivative::binary(operation, x, y, 0.0);
            let taken = [(by_first, first), (by_second, second)];
            let taken = taken.into_iter().find(|(by, _)| *by != 0.0).map_or(0.0, |(_, of)| of);
            return Operand::Constant(derivative::chain(taken, 1.0));
        }
        let [x, y] = of.map(|of| self.fill(Arena::Values, of));
        let gradients = by.map(|of| self.fill(Arena::Gradients, of));
        self.gradient(|out| SlopeStep::Choose { operation, x, y, gradients, out })
    }
}
