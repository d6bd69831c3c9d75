//! A program taken apart: an output as a sum, or a product, of functions of groups of inputs that do
//! not depend on each other.

use crate::distribution::{Dependence, Linked};
use crate::model::{Node, Program};
use crate::number::{Binary, Unary};

/// A summand: a factor times the value of a node, or times the logarithm of its modulus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Leaf {
    pub(super) node: usize,
    pub(super) factor: f64,
    pub(super) logarithm: bool,
}

/// A function of some inputs, on which no other group depends.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Group {
    /// The inputs that it depends on, and those that depend on them, in order.
    pub(super) variables: Vec<usize>,
    /// The dependences among them.
    pub(super) linked: Vec<usize>,
    /// What is summed.
    pub(super) leaves: Vec<Leaf>,
}

/// How an output follows from the sum of its groups.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Outer {
    /// It is the sum.
    Sum,
    /// It is the exponential of the sum times `factor`, and `shift` more. The factor has lost the signs
    /// of what was multiplied.
    Product { factor: f64, shift: f64 },
}

/// An output as a function of a sum.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Separated {
    /// What is added to the groups.
    pub(super) constant: f64,
    pub(super) groups: Vec<Group>,
    pub(super) outer: Outer,
}

struct Parts<'p> {
    program: &'p Program,
    folded: &'p [Option<f64>],
    constant: f64,
    leaves: Vec<Leaf>,
}

impl Parts<'_> {
    fn add(&mut self, node: usize, factor: f64) {
        if let Some(value) = self.folded[node] {
            self.constant += factor * value;
            return;
        }
        match self.program.nodes[node] {
            Node::Binary(Binary::Add, x, y) => {
                self.add(x, factor);
                self.add(y, factor);
            }
            Node::Binary(Binary::Subtract, x, y) => {
                self.add(x, factor);
                self.add(y, -factor);
            }
            Node::Unary(Unary::Negate, x) => self.add(x, -factor),
            Node::Binary(Binary::Multiply, x, y) => match (self.folded[x], self.folded[y]) {
                (Some(c), None) => self.add(y, factor * c),
                (None, Some(c)) => self.add(x, factor * c),
                _ => self.leaf(node, factor, false),
            },
            Node::Binary(Binary::Divide, x, y) => match self.folded[y] {
                Some(c) => self.add(x, factor / c),
                None => self.leaf(node, factor, false),
            },
            Node::Unary(Unary::Ln, x) => self.add_logarithm(x, factor),
            Node::Unary(Unary::Log10, x) => {
                self.add_logarithm(x, factor * std::f64::consts::LOG10_E);
            }
            _ => self.leaf(node, factor, false),
        }
    }

    /// Adds `factor` times the logarithm of the modulus of a node.
    fn add_logarithm(&mut self, node: usize, factor: f64) {
        if let Some(value) = self.folded[node] {
            self.constant += factor * crate::number::elementary::ln(value.abs());
            return;
        }
        match self.program.nodes[node] {
            Node::Binary(Binary::Multiply, x, y) => {
                self.add_logarithm(x, factor);
                self.add_logarithm(y, factor);
            }
            Node::Binary(Binary::Divide, x, y) => {
                self.add_logarithm(x, factor);
                self.add_logarithm(y, -factor);
            }
            Node::Binary(Binary::Power, x, y) if self.folded[y].is_some() => {
                self.add_logarithm(x, factor * self.folded[y].unwrap_or(1.0));
            }
            Node::Unary(Unary::Sqrt, x) => self.add_logarithm(x, 0.5 * factor),
            Node::Unary(Unary::Cbrt, x) => self.add_logarithm(x, factor / 3.0),
            Node::Unary(Unary::Negate | Unary::Abs, x) => self.add_logarithm(x, factor),
            Node::Unary(Unary::Exp, x) => self.add(x, factor),
            _ => self.leaf(node, factor, true),
        }
    }

    fn leaf(&mut self, node: usize, factor: f64, logarithm: bool) {
        let same = |leaf: &&mut Leaf| leaf.node == node && leaf.logarithm == logarithm;
        match self.leaves.iter_mut().find(same) {
            Some(leaf) => leaf.factor += factor,
            None => self.leaves.push(Leaf { node, factor, logarithm }),
        }
    }
}

/// The inputs that a node depends on, among those that vary.
pub(super) fn variables_of(program: &Program, folded: &[Option<f64>], node: usize) -> Vec<usize> {
    let needed = program.needed_by(folded, [node]);
    let varies = |index: &usize| needed[*index] && folded[*index].is_none();
    let variable = |index: usize| match program.nodes[index] {
        Node::Variable(v) => Some(v),
        _ => None,
    };
    let mut found: Vec<usize> = (0..=node).filter(varies).filter_map(variable).collect();
    found.sort_unstable();
    found
}

/// Puts summands together that depend on the same inputs or on linked ones.
fn grouped(parts: &Parts<'_>, linked: &[Linked]) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for leaf in parts.leaves.iter().filter(|leaf| leaf.factor != 0.0) {
        let mut variables = variables_of(parts.program, parts.folded, leaf.node);
        let own: Vec<usize> = (0..linked.len())
            .filter(|&l| linked[l].members.iter().any(|m| variables.binary_search(m).is_ok()))
            .collect();
        variables.extend(own.iter().flat_map(|&l| linked[l].members.iter().copied()));
        let mut whole = Group { variables, linked: own, leaves: vec![*leaf] };
        groups.retain_mut(|group| {
            let common = group.variables.iter().any(|v| whole.variables.contains(v));
            if common {
                whole.variables.append(&mut group.variables);
                whole.linked.append(&mut group.linked);
                group.leaves.append(&mut whole.leaves);
                whole.leaves = std::mem::take(&mut group.leaves);
            }
            !common
        });
        whole.variables.sort_unstable();
        whole.variables.dedup();
        whole.linked.sort_unstable();
        whole.linked.dedup();
        groups.push(whole);
    }
    groups
}

/// How many independent quantities a group has.
fn independent(group: &Group, linked: &[Linked]) -> usize {
    let tied = group.linked.iter().map(|&l| match &linked[l].dependence {
        Dependence::Scores(_) => 0,
        Dependence::Student(..) | Dependence::Trials => linked[l].members.len() - 1,
    });
    group.variables.len() - tied.sum::<usize>()
}

/// Whether a node is a sum of variables times constants.
pub(super) fn is_linear(program: &Program, folded: &[Option<f64>], node: usize) -> bool {
    let mut parts = Parts { program, folded, constant: 0.0, leaves: Vec::new() };
    parts.add(node, 1.0);
    let is_variable = |leaf: &Leaf| matches!(program.nodes[leaf.node], Node::Variable(_));
    parts.leaves.iter().all(|leaf| !leaf.logarithm && is_variable(leaf))
}

/// Takes an output apart. `folded` are the values of the nodes that do not vary.
pub(super) fn separate(
    program: &Program,
    folded: &[Option<f64>],
    output: usize,
    linked: &[Linked],
) -> Separated {
    let mut parts = Parts { program, folded, constant: 0.0, leaves: Vec::new() };
    parts.add(output, 1.0);
    let groups = grouped(&parts, linked);
    let sum = Separated { constant: parts.constant, groups, outer: Outer::Sum };
    let ([group], [leaf]) = (sum.groups.as_slice(), parts.leaves.as_slice()) else {
        return sum;
    };
    if leaf.logarithm || independent(group, linked) < 2 {
        return sum;
    }
    let mut logarithms = Parts { program, folded, constant: 0.0, leaves: Vec::new() };
    logarithms.add_logarithm(leaf.node, 1.0);
    let groups = grouped(&logarithms, linked);
    if groups.len() < 2 {
        return sum;
    }
    let outer = Outer::Product { factor: leaf.factor, shift: sum.constant };
    Separated { constant: logarithms.constant, groups, outer }
}
