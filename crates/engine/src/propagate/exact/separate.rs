//! A program taken apart: an output as a sum, or a product, of functions of groups of inputs that do
//! not depend on each other.

use std::collections::{BTreeMap, HashMap};

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
pub(super) struct SeparateGroup {
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
    pub(super) groups: Vec<SeparateGroup>,
    pub(super) outer: Outer,
}

/// Steps in which a sum is taken apart path by path, at most: less than a second. What equations use
/// twice is met twice, and what is made of that four times, so that a few dozen equations may have more
/// paths than can be counted.
const MOST_STEPS: usize = 1 << 24;

/// A node with a factor, of its value or of the logarithm of its modulus.
type Summand = (usize, f64, bool);

struct SeparatedParts<'p> {
    program: &'p Program,
    folded: &'p [Option<f64>],
    constant: f64,
    leaves: Vec<Leaf>,
    /// Places of the leaves by their nodes, and whether they are logarithms.
    places: HashMap<(usize, bool), usize>,
}

impl<'p> SeparatedParts<'p> {
    fn new(program: &'p Program, folded: &'p [Option<f64>]) -> Self {
        Self { program, folded, constant: 0.0, leaves: Vec::new(), places: HashMap::new() }
    }

    /// The parts of a node, or of the logarithm of its modulus.
    fn of(program: &'p Program, folded: &'p [Option<f64>], node: usize, logarithm: bool) -> Self {
        let mut parts = Self::new(program, folded);
        let mut open = vec![(node, 1.0, logarithm)];
        for _ in 0..MOST_STEPS {
            let Some(summand) = open.pop() else { return parts };
            open.extend(parts.step(summand).into_iter().rev().flatten());
        }
        parts = Self::new(program, folded);
        parts.add_by_nodes(node, logarithm);
        parts
    }

    /// The same with the factors of all paths to a node added up before it is taken apart itself: each
    /// node is met once, and the last bits of the factors may be others.
    fn add_by_nodes(&mut self, node: usize, logarithm: bool) {
        let mut open = BTreeMap::from([((node, logarithm), 1.0)]);
        // nodes stand behind their operands
        while let Some(((node, logarithm), factor)) = open.pop_last() {
            for (node, factor, logarithm) in
                self.step((node, factor, logarithm)).into_iter().flatten()
            {
                *open.entry((node, logarithm)).or_insert(0.0) += factor;
            }
        }
    }

    /// Adds a summand, or gives those that it is the sum of.
    fn step(&mut self, (node, factor, logarithm): Summand) -> [Option<Summand>; 2] {
        if let Some(value) = self.folded[node] {
            let ln = || crate::number::elementary::ln(value.abs());
            self.constant += factor * if logarithm { ln() } else { value };
            return [None, None];
        }
        let parts = match logarithm {
            true => self.summands_of_logarithm(node, factor),
            false => self.summands(node, factor),
        };
        parts.unwrap_or_else(|| {
            self.leaf(node, factor, logarithm);
            [None, None]
        })
    }

    /// What a node is the sum of; `None` where it is none.
    fn summands(&self, node: usize, factor: f64) -> Option<[Option<Summand>; 2]> {
        let one = |node: usize, factor: f64| [Some((node, factor, false)), None];
        Some(match self.program.nodes[node] {
            Node::Binary(Binary::Add, x, y) => [Some((x, factor, false)), Some((y, factor, false))],
            Node::Binary(Binary::Subtract, x, y) => {
                [Some((x, factor, false)), Some((y, -factor, false))]
            }
            Node::Unary(Unary::Negate, x) => one(x, -factor),
            Node::Binary(Binary::Multiply, x, y) => match (self.folded[x], self.folded[y]) {
                (Some(c), None) => one(y, factor * c),
                (None, Some(c)) => one(x, factor * c),
                _ => return None,
            },
            Node::Binary(Binary::Divide, x, y) => one(x, factor / self.folded[y]?),
            Node::Unary(Unary::Ln, x) => [Some((x, factor, true)), None],
            Node::Unary(Unary::Log10, x) => {
                [Some((x, factor * std::f64::consts::LOG10_E, true)), None]
            }
            _ => return None,
        })
    }

    /// What the logarithm of the modulus of a node is the sum of; `None` where it is none.
    fn summands_of_logarithm(&self, node: usize, factor: f64) -> Option<[Option<Summand>; 2]> {
        let one = |node: usize, factor: f64| [Some((node, factor, true)), None];
        Some(match self.program.nodes[node] {
            Node::Binary(Binary::Multiply, x, y) => {
                [Some((x, factor, true)), Some((y, factor, true))]
            }
            Node::Binary(Binary::Divide, x, y) => {
                [Some((x, factor, true)), Some((y, -factor, true))]
            }
            Node::Binary(Binary::Power, x, y) => one(x, factor * self.folded[y]?),
            Node::Unary(Unary::Sqrt, x) => one(x, 0.5 * factor),
            Node::Unary(Unary::Cbrt, x) => one(x, factor / 3.0),
            Node::Unary(Unary::Negate | Unary::Abs, x) => one(x, factor),
            Node::Unary(Unary::Exp, x) => [Some((x, factor, false)), None],
            _ => return None,
        })
    }

    fn leaf(&mut self, node: usize, factor: f64, logarithm: bool) {
        let place = *self.places.entry((node, logarithm)).or_insert(self.leaves.len());
        match self.leaves.get_mut(place) {
            Some(leaf) => leaf.factor += factor,
            None => self.leaves.push(Leaf { node, factor, logarithm }),
        }
    }
}

/// The inputs that a node depends on, among those that vary.
pub(super) fn variables_of(program: &Program, folded: &[Option<f64>], node: usize) -> Vec<usize> {
    let varies = |index: &usize| folded[*index].is_none();
    let variable = |index: usize| match program.nodes[index] {
        Node::Variable(v) => Some(v),
        _ => None,
    };
    let nodes = program.nodes_behind(folded, [node]).into_iter();
    let mut found: Vec<usize> = nodes.filter(varies).filter_map(variable).collect();
    found.sort_unstable();
    found
}

/// Puts summands together that depend on the same inputs or on linked ones.
fn grouped(parts: &SeparatedParts<'_>, linked: &[Linked]) -> Vec<SeparateGroup> {
    // groups with the number of the leaf that came last, which is their order; one that went into
    // another has no leaves
    let mut groups: Vec<(usize, SeparateGroup)> = Vec::new();
    let mut group_of: HashMap<usize, usize> = HashMap::new();
    let mut linked_by: HashMap<usize, Vec<usize>> = HashMap::new();
    for (place, link) in linked.iter().enumerate() {
        for &member in &link.members {
            linked_by.entry(member).or_default().push(place);
        }
    }
    for (number, leaf) in parts.leaves.iter().enumerate().filter(|(_, leaf)| leaf.factor != 0.0) {
        let mut variables = variables_of(parts.program, parts.folded, leaf.node);
        let links = variables.iter().filter_map(|v| linked_by.get(v)).flatten();
        let mut own: Vec<usize> = links.copied().collect();
        own.sort_unstable();
        own.dedup();
        variables.extend(own.iter().flat_map(|&l| linked[l].members.iter().copied()));
        let mut common: Vec<usize> =
            variables.iter().filter_map(|v| group_of.get(v)).copied().collect();
        common.sort_unstable_by_key(|&place| groups[place].0);
        common.dedup();
        // the largest one takes the others in, so that few inputs move
        let largest = common.iter().copied().max_by_key(|&place| groups[place].1.variables.len());
        let into = largest.unwrap_or(groups.len());
        if into == groups.len() {
            groups.push((number, SeparateGroup::default()));
        }
        let mut leaves = vec![*leaf];
        for place in common {
            let mut before = std::mem::take(&mut groups[place].1.leaves);
            before.append(&mut leaves);
            leaves = before;
            if place != into {
                let other = std::mem::take(&mut groups[place].1);
                group_of.extend(other.variables.iter().map(|&v| (v, into)));
                groups[into].1.variables.extend(other.variables);
                groups[into].1.linked.extend(other.linked);
            }
        }
        let (last, whole) = &mut groups[into];
        *last = number;
        whole.variables.extend(variables.iter().filter(|&&v| group_of.insert(v, into).is_none()));
        whole.linked.extend(own);
        whole.leaves = leaves;
    }
    groups.retain(|(_, group)| !group.leaves.is_empty());
    groups.sort_unstable_by_key(|(last, _)| *last);
    let in_order = |(_, mut group): (usize, SeparateGroup)| {
        group.variables.sort_unstable();
        group.linked.sort_unstable();
        group.linked.dedup();
        group
    };
    groups.into_iter().map(in_order).collect()
}

/// How many independent quantities a group has.
fn independent(group: &SeparateGroup, linked: &[Linked]) -> usize {
    let tied = group.linked.iter().map(|&l| match &linked[l].dependence {
        Dependence::Scores(_) => 0,
        Dependence::Student(..) | Dependence::Trials => linked[l].members.len() - 1,
    });
    group.variables.len() - tied.sum::<usize>()
}

/// Whether a node is a sum of variables times constants.
pub(in crate::propagate) fn is_linear(
    program: &Program,
    folded: &[Option<f64>],
    node: usize,
) -> bool {
    let mut parts = SeparatedParts::new(program, folded);
    parts.add_by_nodes(node, false);
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
    let parts = SeparatedParts::of(program, folded, output, false);
    let groups = grouped(&parts, linked);
    let sum = Separated { constant: parts.constant, groups, outer: Outer::Sum };
    let ([group], [leaf]) = (sum.groups.as_slice(), parts.leaves.as_slice()) else {
        return sum;
    };
    if leaf.logarithm || independent(group, linked) < 2 {
        return sum;
    }
    let logarithms = SeparatedParts::of(program, folded, leaf.node, true);
    let groups = grouped(&logarithms, linked);
    if groups.len() < 2 {
        return sum;
    }
    let outer = Outer::Product { factor: leaf.factor, shift: sum.constant };
    Separated { constant: logarithms.constant, groups, outer }
}
