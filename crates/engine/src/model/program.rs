//! What a model computes, written down as a list of operations.
//!
//! Typed models and formulas both end up here, so everything after this point (estimates,
//! sensitivity coefficients, trials) is the same for both. Operations stand in an order in which
//! each comes after its operands; equal operations on equal operands stand only once.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::number::{Binary, Dual, Number, Routine, Shortest, Unary, derivative};

/// How many inputs one evaluation with dual numbers differentiates by.
const GRADIENT_CHUNK: usize = 8;

/// Variables from which on the way back from the outputs is taken, if these are few.
const MANY: usize = 512;

/// One operation, or a leaf. Operands are indices of earlier nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Node {
    /// The variable of this number.
    Variable(usize),
    /// A value.
    Constant(f64),
    /// An operation of one earlier node.
    Unary(Unary, usize),
    /// An operation of two earlier nodes.
    Binary(Binary, usize, usize),
    /// The call of this number in [`Program::routines`].
    Routine(usize),
}

/// A call of a function of several numbers.
#[derive(Clone, Debug)]
pub struct RoutineCall {
    /// The function.
    pub routine: Arc<dyn Routine>,
    /// Its operands: indices of earlier nodes.
    pub operands: Vec<usize>,
}

impl RoutineCall {
    fn values<T: Copy>(&self, of: &[T]) -> Vec<T> {
        self.operands.iter().map(|&x| of[x]).collect()
    }
}

/// A function from variables to outputs.
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// The operations, each after those that it needs.
    pub nodes: Vec<Node>,
    /// Number of variables.
    pub variables: usize,
    /// For each output the index of its node.
    pub outputs: Vec<usize>,
    /// The calls of functions of several numbers.
    pub routines: Vec<RoutineCall>,
}

impl Program {
    /// Number of variables.
    pub fn variables(&self) -> usize {
        self.variables
    }

    /// Number of outputs.
    pub fn outputs(&self) -> usize {
        self.outputs.len()
    }

    /// Number of operations, each counted once however often its result is used.
    pub fn operations(&self) -> usize {
        self.nodes.iter().filter(|n| !matches!(n, Node::Variable(_) | Node::Constant(_))).count()
    }

    /// The outputs at the given values of the variables. A missing value is taken as 0.
    pub fn evaluate<T: Number>(&self, variables: &[T]) -> Vec<T> {
        let values = self.values(variables);
        self.outputs.iter().map(|&o| values[o]).collect()
    }

    fn values<T: Number>(&self, variables: &[T]) -> Vec<T> {
        let mut values: Vec<T> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            values.push(match *node {
                Node::Variable(v) => variables.get(v).copied().unwrap_or_else(|| T::constant(0.0)),
                Node::Constant(c) => T::constant(c),
                Node::Unary(operation, x) => values[x].unary(operation),
                Node::Binary(operation, x, y) => values[x].binary(operation, values[y]),
                Node::Routine(call) => {
                    let call = &self.routines[call];
                    T::routine(&call.routine, &call.values(&values))
                }
            });
        }
        values
    }

    /// The outputs and, for each output, its partial derivatives with respect to the variables
    /// (JCGM 100, 5.1.3), exact to rounding.
    pub fn gradients(&self, variables: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let used = self.used_variables();
        if self.goes_backward_from(used.len()) {
            let (outputs, gradients) = self.gradients_backward(variables);
            // where something is not finite, what it means is decided by dual numbers
            if gradients.iter().flatten().all(|slope| slope.is_finite()) {
                return (outputs, gradients);
            }
        }
        self.gradients_forward(variables, &used)
    }

    /// Whether the way from the outputs back to the variables is the shorter one.
    pub(crate) fn goes_backward(&self) -> bool {
        self.goes_backward_from(self.used_variables().len())
    }

    fn goes_backward_from(&self, used: usize) -> bool {
        used >= MANY && used >= GRADIENT_CHUNK * self.outputs.len()
    }

    /// With dual numbers, some variables at a time.
    fn gradients_forward(&self, variables: &[f64], used: &[usize]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let outputs = self.evaluate(variables);
        let mut gradients = vec![vec![0.0; self.variables]; self.outputs.len()];
        for chunk in used.chunks(GRADIENT_CHUNK) {
            let mut duals: Vec<Dual<GRADIENT_CHUNK>> =
                variables.iter().map(|&v| Dual::constant(v)).collect();
            for (index, &v) in chunk.iter().enumerate() {
                if let Some(dual) = duals.get_mut(v) {
                    *dual = Dual::variable(dual.value, index);
                }
            }
            for (gradient, output) in gradients.iter_mut().zip(self.evaluate(&duals)) {
                for (index, &v) in chunk.iter().enumerate() {
                    gradient[v] = output.gradient[index];
                }
            }
        }
        (outputs, gradients)
    }

    /// From each output back to the variables: one pass over the operations for an output, however
    /// many variables there are.
    fn gradients_backward(&self, variables: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let values: Vec<f64> = self.values(variables);
        let gradients = self.outputs.iter().map(|&output| {
            let mut gradient = vec![0.0; self.variables];
            let slopes = self.slopes_backward(&values, output);
            for (node, slope) in self.nodes.iter().zip(slopes).rev() {
                if let Node::Variable(v) = *node {
                    gradient[v] += slope;
                }
            }
            gradient
        });
        let gradients = gradients.collect();
        (self.outputs.iter().map(|&output| values[output]).collect(), gradients)
    }

    /// What an output's node changes by with the result of each node up to it, whose values are given; 0
    /// of those that it does not need.
    fn slopes_backward(&self, values: &[f64], output: usize) -> Vec<f64> {
        // what the output changes by with each operation's result
        let mut slopes = vec![0.0; output + 1];
        let mut needed = vec![false; output + 1];
        (slopes[output], needed[output]) = (1.0, true);
        for (index, node) in self.nodes[..=output].iter().enumerate().rev() {
            if !needed[index] {
                continue;
            }
            let slope = slopes[index];
            match *node {
                Node::Constant(_) | Node::Variable(_) => {}
                Node::Unary(operation, x) => {
                    let [by_x] = Dual::<1>::variable(values[x], 0).unary(operation).gradient;
                    slopes[x] += slope * by_x;
                    needed[x] = true;
                }
                // a branch that is not taken has no say
                Node::Binary(Binary::When, x, y) => {
                    if values[x] != 0.0 {
                        (slopes[y], needed[y]) = (slopes[y] + slope, true);
                    }
                }
                Node::Binary(Binary::Unless, x, y) => {
                    if values[x] == 0.0 {
                        (slopes[y], needed[y]) = (slopes[y] + slope, true);
                    }
                }
                Node::Routine(call) => {
                    let call = &self.routines[call];
                    let by = call.routine.slopes(&call.values(values), values[index]);
                    for (&x, by) in call.operands.iter().zip(by) {
                        slopes[x] += derivative::chain(slope, by);
                        needed[x] = true;
                    }
                }
                Node::Binary(operation, x, y) => {
                    let [a, b] = [(x, 0), (y, 1)].map(|(x, i)| Dual::variable(values[x], i));
                    let [by_x, by_y] = Dual::<2>::binary(a, operation, b).gradient;
                    slopes[x] += slope * by_x;
                    slopes[y] += slope * by_y;
                    (needed[x], needed[y]) = (true, true);
                }
            }
        }
        slopes
    }

    /// How far the rounding of the operations may move each output: half a spacing of the result of each
    /// operation, times what the output changes by with it (Higham, Accuracy and Stability of Numerical
    /// Algorithms, 3.3). What is not finite has no bound.
    pub(crate) fn rounding(&self, variables: &[f64]) -> Vec<f64> {
        let values: Vec<f64> = self.values(variables);
        let of_output = |&output: &usize| {
            let slopes = self.slopes_backward(&values, output);
            let nodes = self.nodes.iter().zip(&values).zip(slopes);
            let computed = nodes
                .filter(|((node, _), _)| !matches!(node, Node::Variable(_) | Node::Constant(_)));
            let sum: f64 = computed.map(|((_, value), slope)| (slope * value).abs()).sum();
            0.5 * f64::EPSILON * sum
        };
        self.outputs.iter().map(of_output).collect()
    }

    /// For each output whether a product, a quotient or a power that it is computed from, of numbers that
    /// are not zero, is below the smallest normal number.
    pub(crate) fn underflows(&self, variables: &[f64]) -> Vec<bool> {
        let values: Vec<f64> = self.values(variables);
        let vanishes = |(index, node): (usize, &Node)| match *node {
            Node::Binary(Binary::Multiply | Binary::Divide | Binary::Power, x, y) => {
                let is_small = values[index].is_finite() && !values[index].is_normal();
                let of = |x: usize| values[x] != 0.0 && values[x].is_finite();
                is_small && of(x) && of(y)
            }
            _ => false,
        };
        let vanishing = self.nodes.iter().enumerate().filter(|of| vanishes(*of));
        let vanishing: Vec<usize> = vanishing.map(|(index, _)| index).collect();
        if vanishing.is_empty() {
            return vec![false; self.outputs.len()];
        }
        let has_one = |output: &usize| {
            let needed = self.needed_by(&[], [*output]);
            vanishing.iter().any(|index| needed[*index])
        };
        self.outputs.iter().map(has_one).collect()
    }

    /// The variables that some output depends on, in order.
    fn used_variables(&self) -> Vec<usize> {
        let reach = self.reach();
        (0..self.variables).filter(|&v| reach.iter().any(|output| output[v])).collect()
    }

    /// For each output, whether it depends on each variable.
    pub fn reach(&self) -> Vec<Vec<bool>> {
        let reach_of = |output: usize| {
            let mut reach = vec![false; self.variables];
            let needed = self.needed_by(&[], [output]);
            for (node, _) in self.nodes.iter().zip(needed).filter(|(_, needed)| *needed) {
                if let Node::Variable(v) = *node {
                    reach[v] = true;
                }
            }
            reach
        };
        self.outputs.iter().map(|&output| reach_of(output)).collect()
    }

    /// Calls for each node that a node is computed from.
    pub(crate) fn for_each_operand(&self, node: usize, mut each: impl FnMut(usize)) {
        match self.nodes[node] {
            Node::Variable(_) | Node::Constant(_) => {}
            Node::Unary(_, x) => each(x),
            Node::Binary(_, x, y) => {
                each(x);
                each(y);
            }
            Node::Routine(call) => self.routines[call].operands.iter().copied().for_each(each),
        }
    }

    /// For each node whether one of these comes from it. A node whose value is known beforehand, by
    /// its place in `folded`, comes from no other.
    pub(crate) fn needed_by(
        &self,
        folded: &[Option<f64>],
        nodes: impl IntoIterator<Item = usize>,
    ) -> Vec<bool> {
        let mut needed = vec![false; self.nodes.len()];
        let mut count = 0;
        for node in nodes {
            needed[node] = true;
            count = count.max(node + 1);
        }
        for node in (0..count).rev() {
            if needed[node] && folded.get(node).is_none_or(Option::is_none) {
                self.for_each_operand(node, |operand| needed[operand] = true);
            }
        }
        needed
    }

    /// The nodes that these come from, and they themselves, in order. It takes as long as there are such
    /// nodes, however long the program is.
    pub(crate) fn nodes_behind(
        &self,
        folded: &[Option<f64>],
        nodes: impl IntoIterator<Item = usize>,
    ) -> Vec<usize> {
        let mut open: Vec<usize> = nodes.into_iter().collect();
        let mut found: BTreeSet<usize> = open.iter().copied().collect();
        while let Some(node) = open.pop() {
            if folded.get(node).is_none_or(Option::is_none) {
                self.for_each_operand(node, |operand| {
                    if found.insert(operand) {
                        open.push(operand);
                    }
                });
            }
        }
        found.into_iter().collect()
    }

    /// For each node whether an output comes from it at these values: not where only a branch of a
    /// choice uses it that is not taken.
    fn taken(&self, values: &[f64]) -> Vec<bool> {
        let mut taken = vec![false; self.nodes.len()];
        self.outputs.iter().for_each(|&output| taken[output] = true);
        for (index, node) in self.nodes.iter().enumerate().rev() {
            if !taken[index] {
                continue;
            }
            match *node {
                Node::Binary(Binary::When, x, y) => {
                    taken[x] = true;
                    taken[y] |= values[x] != 0.0;
                }
                Node::Binary(Binary::Unless, x, y) => {
                    taken[x] = true;
                    taken[y] |= values[x] == 0.0;
                }
                _ => self.for_each_operand(index, |operand| taken[operand] = true),
            }
        }
        taken
    }

    /// The first operation whose result is not finite although its operands are, in words such as
    /// `sqrt of -0.25` or `1 / 0`; `None` if all is finite. An infinite constant that a model
    /// uses on purpose (a filter that is absent) is not reported.
    pub fn first_undefined(&self, variables: &[f64]) -> Option<String> {
        let values = self.values(variables);
        let taken = self.taken(&values);
        for (index, node) in self.nodes.iter().enumerate() {
            if values[index].is_finite() || !taken[index] {
                continue;
            }
            match *node {
                // what `solve` of numbers alone gives is known before any trial
                Node::Constant(value) if value.is_nan() => {
                    let part = "a part of the model that depends on no input and has no value";
                    return Some(part.to_owned());
                }
                Node::Unary(operation, x) if values[x].is_finite() => {
                    return Some(format!("{} of {}", operation.name(), Shortest(values[x])));
                }
                Node::Binary(operation, x, y) if values[x].is_finite() && values[y].is_finite() => {
                    let name = operation.name();
                    let (x, y) = (Shortest(values[x]), Shortest(values[y]));
                    return Some(if operation.is_infix() {
                        format!("{x} {name} {y}")
                    } else {
                        format!("{name} of {x} and {y}")
                    });
                }
                Node::Routine(call) => {
                    let call = &self.routines[call];
                    let operands = call.values(&values);
                    if operands.iter().all(|operand| operand.is_finite()) {
                        return Some(call.routine.undefined(&operands));
                    }
                }
                _ => {}
            }
        }
        let is_infinite = |(node, taken): (&Node, bool)| {
            taken && matches!(node, Node::Constant(value) if value.is_infinite())
        };
        let has_infinite = self.nodes.iter().zip(taken).any(is_infinite);
        has_infinite.then(|| {
            "a part of the model that depends on no input and is infinite, as `1/0` is".to_owned()
        })
    }
}
