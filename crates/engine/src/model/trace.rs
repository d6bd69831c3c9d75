//! Recording: a number that writes down what is done to it.

use std::cell::RefCell;
use std::collections::HashMap;
use std::sync::Arc;

use super::program::{Node, Program, RoutineCall};
use crate::number::{Binary, Number, Routine, Unary, number_operators};

/// Where the operations of a function are written down.
#[derive(Debug, Default)]
pub struct Recorder {
    graph: RefCell<Graph>,
}

#[derive(Debug, Default)]
struct Graph {
    nodes: Vec<Node>,
    routines: Vec<RoutineCall>,
    index_of: HashMap<Key, usize>,
}

/// What makes two nodes the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Key {
    Variable(usize),
    Constant(u64),
    Unary(Unary, usize),
    Binary(Binary, usize, usize),
    Routine(usize),
}

impl Graph {
    fn node_index(&mut self, node: Node) -> usize {
        let key = match node {
            Node::Variable(v) => Key::Variable(v),
            Node::Constant(c) => Key::Constant(c.to_bits()),
            Node::Unary(operation, x) => Key::Unary(operation, x),
            Node::Binary(operation, x, y) => Key::Binary(operation, x, y),
            Node::Routine(call) => Key::Routine(call),
        };
        *self.index_of.entry(key).or_insert_with(|| {
            self.nodes.push(node);
            self.nodes.len() - 1
        })
    }

    fn call_index(&mut self, call: RoutineCall) -> usize {
        let same = |known: &RoutineCall| {
            Arc::ptr_eq(&known.routine, &call.routine) && known.operands == call.operands
        };
        let index = self.routines.iter().position(same).unwrap_or_else(|| {
            self.routines.push(call.clone());
            self.routines.len() - 1
        });
        self.node_index(Node::Routine(index))
    }
}

/// A number whose value is not known yet. Constants are computed at once; whatever involves a
/// variable is recorded.
#[derive(Clone, Copy, Debug)]
pub struct Traced<'r>(Recorded<'r>);

#[derive(Clone, Copy, Debug)]
enum Recorded<'r> {
    Constant(f64),
    Node(&'r Recorder, usize),
}

impl Recorder {
    /// The variable of that index.
    pub fn variable(&self, index: usize) -> Traced<'_> {
        let index = self.graph.borrow_mut().node_index(Node::Variable(index));
        Traced(Recorded::Node(self, index))
    }

    /// The program that computes `outputs` from `variables` many variables.
    pub fn program(&self, variables: usize, outputs: &[Traced<'_>]) -> Program {
        let outputs = outputs.iter().map(|&output| self.index(output)).collect();
        let graph = self.graph.borrow();
        let (nodes, routines) = (graph.nodes.clone(), graph.routines.clone());
        Program { nodes, variables, outputs, routines }
    }

    fn index(&self, number: Traced<'_>) -> usize {
        match number.0 {
            Recorded::Constant(c) => self.graph.borrow_mut().node_index(Node::Constant(c)),
            Recorded::Node(_, index) => index,
        }
    }
}

impl Number for Traced<'_> {
    fn constant(value: f64) -> Self {
        Self(Recorded::Constant(value))
    }

    fn unary(self, operation: Unary) -> Self {
        match self.0 {
            Recorded::Constant(c) => Self::constant(c.unary(operation)),
            Recorded::Node(recorder, x) => {
                let index = recorder.graph.borrow_mut().node_index(Node::Unary(operation, x));
                Self(Recorded::Node(recorder, index))
            }
        }
    }

    fn binary(self, operation: Binary, other: Self) -> Self {
        let recorder = match (self.0, other.0) {
            (Recorded::Constant(x), Recorded::Constant(y)) => {
                return Self::constant(x.binary(operation, y));
            }
            (Recorded::Node(recorder, _), _) | (_, Recorded::Node(recorder, _)) => recorder,
        };
        let (x, y) = (recorder.index(self), recorder.index(other));
        let index = recorder.graph.borrow_mut().node_index(Node::Binary(operation, x, y));
        Self(Recorded::Node(recorder, index))
    }

    fn routine(routine: &Arc<dyn Routine>, operands: &[Self]) -> Self {
        let known = |operand: &Self| match operand.0 {
            Recorded::Constant(c) => Ok(c),
            Recorded::Node(recorder, _) => Err(recorder),
        };
        let recorder = match operands.iter().map(known).collect::<Result<Vec<f64>, _>>() {
            Ok(values) => return Self::constant(routine.value(&values)),
            Err(recorder) => recorder,
        };
        let operands = operands.iter().map(|&operand| recorder.index(operand)).collect();
        let call = RoutineCall { routine: Arc::clone(routine), operands };
        let index = recorder.graph.borrow_mut().call_index(call);
        Self(Recorded::Node(recorder, index))
    }
}

number_operators!(['r] Traced<'r>);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_operations_are_recorded_once() {
        let recorder = Recorder::default();
        let (x, y) = (recorder.variable(0), recorder.variable(1));
        let sum = (x * y).sin() + (x * y).sin() * 2.0;
        let program = recorder.program(2, &[sum]);
        // x y, its sine, twice the sine, the sum
        assert_eq!(program.operations(), 4);
        let expected = 3.0 * Number::sin(0.3 * 0.7);
        assert!((program.evaluate(&[0.3, 0.7])[0] - expected).abs() < 1e-15);
    }

    #[test]
    fn constants_are_computed_at_once() {
        let recorder = Recorder::default();
        let x = recorder.variable(0);
        let factor = Traced::constant(2.0).sqrt() * 3.0;
        let program = recorder.program(1, &[x * factor, factor]);
        assert_eq!(program.operations(), 1);
        assert_eq!(program.evaluate(&[1.0])[1], 3.0 * 2f64.sqrt());
    }

    #[test]
    fn a_place_without_a_value_is_named() {
        let recorder = Recorder::default();
        let x = recorder.variable(0);
        let program = recorder.program(1, &[(x - 2.0).sqrt() / x]);
        assert_eq!(program.first_undefined(&[3.0]), None);
        assert_eq!(program.first_undefined(&[1.0]).as_deref(), Some("sqrt of -1"));
    }

    /// A model of many inputs and one output is differentiated from the output back, with the same
    /// derivatives as forwards; where one is infinite or undefined, dual numbers decide. 1e-14 is
    /// the rounding of three factors.
    #[test]
    fn gradients_of_many_inputs_are_those_of_few() {
        let derivatives = |n: usize, at: &dyn Fn(usize) -> f64| {
            let recorder = Recorder::default();
            let x: Vec<_> = (0..n).map(|i| recorder.variable(i)).collect();
            let term = |i: usize| match i % 4 {
                0 => x[i] * x[(i + 1) % n].sin(),
                1 => x[i].pow(Traced::constant(1.5)) / x[(i + 2) % n],
                2 => x[i].sqrt() * Traced::constant(0.0) + x[i].max(x[(i + 3) % n]),
                _ => x[i].atan2(x[(i + 4) % n]) + x[i] * x[i],
            };
            let sum = (0..n).fold(Traced::constant(0.0), |sum, i| sum + term(i));
            let program = recorder.program(n, &[sum]);
            let at: Vec<f64> = (0..n).map(at).collect();
            program.gradients(&at).1[0].clone()
        };
        let at = |i: usize| 0.5 + (i % 20) as f64;
        // 20 inputs and 600: those in the middle have the same neighbours
        let (few, many) = (derivatives(20, &at), derivatives(600, &at));
        for (i, slope) in few.iter().enumerate() {
            assert!((slope - many[i + 300]).abs() <= 1e-14 * slope.abs(), "{i}");
        }
        let at = |i: usize| if i % 20 == 2 { 0.0 } else { 0.5 + (i % 20) as f64 };
        let (few, many) = (derivatives(20, &at), derivatives(600, &at));
        assert!(few[2].is_nan());
        for (i, slope) in few.iter().enumerate() {
            assert_eq!(slope.is_finite(), many[i + 300].is_finite(), "{i}");
        }
    }

    #[test]
    fn gradients_of_more_inputs_than_a_chunk() {
        let recorder = Recorder::default();
        let n = 19;
        let x: Vec<_> = (0..n).map(|i| recorder.variable(i)).collect();
        let sum = x
            .iter()
            .enumerate()
            .fold(Traced::constant(0.0), |s, (i, x)| s + x.square() * (i as f64));
        let program = recorder.program(n, &[sum]);
        let at: Vec<f64> = (0..n).map(|i| 0.5 + i as f64).collect();
        let (_, gradients) = program.gradients(&at);
        for i in 0..n {
            assert_eq!(gradients[0][i], 2.0 * i as f64 * at[i]);
        }
    }
}
