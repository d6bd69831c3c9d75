//! Up to which order the trials of an output have moments, whatever their seed (JCGM 101, 3.6, note 1).
//!
//! A t distribution has moments below its degrees of freedom, a sum of such quantities those of the one
//! with the fewest. Through a formula that bends, large values grow beyond that: the square of a t has
//! half as many moments, its exponential none. Taken strictly that holds for any number of degrees of
//! freedom; it matters where trials come so far out. A moment counts as missing where one trial in a
//! thousand million, which one run of a thousand with the usual million of trials has, would change the
//! figure on its own; and where a pole lies as near as that.
//!
//! The formula is followed along ways through the space of its inputs: each input alone, inputs that are
//! correlated together, and all of them along the gradient in the space of their normal scores, where
//! several that are far out at once are as rare as one that is farther. The draws have no say in it.

use std::sync::Arc;

use super::exact::{folded, is_linear, pole_order};
use super::gum::GumRow;
use crate::distribution::{Distribution, connected};
use crate::model::{Node, Program};
use crate::number::{Binary, Unary, elementary};
use crate::special::normal;
use crate::task::{Row, Task};

/// Probabilities of the tails along a way, from the farthest to next to the median.
const TAILS: [f64; 16] =
    [1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 0.01, 0.03, 0.06, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45];

/// The place of the median among the points of a way: the tails below it come before, those above after.
const MEDIAN: usize = TAILS.len();

/// The points from which half of the central part of a distribution is taken, 1.88 standard deviations of
/// a normal one from its median.
const CENTRAL: usize = 6;
const CENTRAL_DEVIATIONS: f64 = 1.880_793_608_151_251;

/// The weight of one trial in the usual number of them.
const ONE_TRIAL: f64 = 1e-6;

/// The share of the spread by which one trial may move the mean: half of the last of two digits.
const OF_MEAN: f64 = 0.05;

/// The share of the variance that one trial may add.
const OF_VARIANCE: f64 = 0.25;

/// An output that is this many times as far away as its tangent says has left it: up to there its tail is
/// that of the input, which has the moments that its degrees of freedom tell.
const LEFT_TANGENT: f64 = 1.5;

/// An output that goes on from a probability of 1e-7 to one of 1e-9 by no more than this factor has no
/// tail there, as a comparison or a sine has none: a tail of a power would have moments beyond the
/// eleventh.
const STILL: f64 = 1.5;

/// Inputs that are followed one at a time, at most: those that move the output farthest.
const MOST_ALONE: usize = 200;

/// For each output the order from which on moments of its trials do not exist; infinite where all do.
pub(super) fn moment_orders(
    task: &Task,
    row: &Row,
    reaches: &[Vec<bool>],
    linear: &GumRow,
) -> Vec<f64> {
    let mut orders: Vec<f64> = reaches.iter().map(|reach| of_inputs(reach, row)).collect();
    if task.function.is_some() {
        // nothing tells whether a function that is not recorded bends
        let unknown = |order: f64| if order <= 2.0 { order.min(1.0) } else { order };
        return orders.into_iter().map(unknown).collect();
    }
    let program = &task.model.program;
    let folded = folded(program, row);
    let bends = |output: usize| {
        let node = program.outputs.get(output).copied();
        let comes_round =
            task.model.outputs.get(output).is_some_and(|output| output.period.is_some());
        !comes_round && node.is_some_and(|node| !is_linear(program, &folded, node))
    };
    let bent: Vec<usize> = (0..orders.len()).filter(|output| bends(*output)).collect();
    if bent.is_empty() {
        return orders;
    }
    let space = Space::of(row);
    let alone = Alone::of(program, &space, &bent, reaches, linear);
    for output in bent {
        let order = Bend { program, space: &space, linear, output }.order(&alone, &folded);
        orders[output] = orders[output].min(order);
    }
    orders
}

/// The order that a sum of the inputs has.
fn of_inputs(reach: &[bool], row: &Row) -> f64 {
    let reached = row.distributions.iter().zip(reach).filter(|(_, reached)| **reached);
    let of_input = |(distribution, _): (&Arc<Distribution>, &bool)| {
        let dof = distribution.drawn_dof();
        match (distribution.mean().is_finite(), distribution.standard_deviation().is_finite()) {
            (false, _) => dof.min(1.0),
            (true, false) => dof.min(2.0),
            (true, true) => dof,
        }
    };
    reached.map(of_input).fold(f64::INFINITY, f64::min)
}

/// The points of a way.
const POINTS: usize = 2 * MEDIAN + 1;

/// Inputs that move along a way, and how far each is from its median at the points.
type Moves = Vec<(usize, [f64; POINTS])>;

/// What a row's inputs are along ways.
struct Space<'a> {
    distributions: &'a [Arc<Distribution>],
    /// Their medians, and the conditions behind them.
    medians: Vec<f64>,
    /// How far each input alone is from its median at the points; `None` of one that cannot be followed.
    alone: Vec<Option<[f64; POINTS]>>,
}

impl<'a> Space<'a> {
    fn of(row: &'a Row) -> Self {
        let median = |distribution: &Distribution| match distribution.constant() {
            Some(value) => value,
            None if distribution.has_quantiles() => distribution.quantile(0.5),
            None => distribution.mean(),
        };
        let mut medians: Vec<f64> =
            row.distributions.iter().map(|distribution| median(distribution)).collect();
        let alone = |(distribution, median): (&Arc<Distribution>, &f64)| {
            let at = |point: usize| match point {
                MEDIAN => *median,
                lower if lower < MEDIAN => distribution.quantile(TAILS[lower]),
                upper => distribution.quantile_upper(TAILS[2 * MEDIAN - upper]),
            };
            let varies = distribution.constant().is_none() && distribution.has_quantiles();
            varies.then(|| std::array::from_fn(|point| at(point) - median))
        };
        let alone = row.distributions.iter().zip(&medians).map(alone).collect();
        medians.extend(&row.conditions);
        Self { distributions: &row.distributions, medians, alone }
    }

    /// The inputs that can be followed.
    fn varying(&self) -> impl Iterator<Item = usize> {
        (0..self.alone.len()).filter(|input| self.alone[*input].is_some())
    }

    /// Inputs that are far out together, as those of a multivariate t are: each goes its correlation with
    /// what they contribute of its own way, the other way round where that is negative.
    fn together(&self, correlations: &[(usize, f64)]) -> Moves {
        let of_input = |&(input, r): &(usize, f64)| {
            let own = self.alone[input]?;
            let at = |point: usize| if r < 0.0 { own[2 * MEDIAN - point] } else { own[point] };
            Some((input, std::array::from_fn(|point| r.abs() * at(point))))
        };
        correlations.iter().filter_map(of_input).collect()
    }

    /// Independent inputs: each goes to the probability of its share of the normal score.
    fn apart(&self, correlations: &[(usize, f64)]) -> Moves {
        let of_input = |&(input, r): &(usize, f64)| {
            let (of, median) = (&self.distributions[input], self.medians[input]);
            let at = |point: usize| {
                let tail = TAILS.get(point.min(2 * MEDIAN - point)).copied().unwrap_or(0.5);
                let outward = if point < MEDIAN { -r } else { r };
                let tail = normal::sf(outward.abs() * normal::quantile_upper(tail));
                if outward < 0.0 { of.quantile(tail) } else { of.quantile_upper(tail) }
            };
            (input, std::array::from_fn(|point| at(point) - median))
        };
        correlations.iter().map(of_input).collect()
    }

    /// The points of a way.
    fn points(&self, moves: &Moves) -> Vec<Vec<f64>> {
        let of_point = |point: usize| {
            let mut values = self.medians.clone();
            moves.iter().for_each(|(input, departures)| values[*input] += departures[point]);
            values
        };
        (0..POINTS).map(of_point).collect()
    }
}

/// The ways of the inputs one at a time, which all outputs share: the outputs at the points.
struct Alone {
    inputs: Vec<(usize, [f64; POINTS], Vec<Vec<f64>>)>,
}

impl Alone {
    fn of(
        program: &Program,
        space: &Space<'_>,
        bent: &[usize],
        reaches: &[Vec<bool>],
        linear: &GumRow,
    ) -> Self {
        let reached = |input: &usize| bent.iter().any(|output| reaches[*output][*input]);
        let mut inputs: Vec<usize> = space.varying().filter(reached).collect();
        if inputs.len() > MOST_ALONE {
            let reach = |input: usize| {
                let own = space.alone[input].unwrap_or([f64::NAN; POINTS]);
                let farthest = own[0].abs().max(own[2 * MEDIAN].abs());
                let moved = |output: &usize| {
                    let slope =
                        linear.gradient(*output).map_or(f64::NAN, |gradient| gradient[input]);
                    let moved = (slope * farthest).abs();
                    if moved.is_nan() { f64::INFINITY } else { moved }
                };
                bent.iter().map(moved).fold(0.0, f64::max)
            };
            let mut ranked: Vec<(usize, f64)> =
                inputs.iter().map(|&input| (input, reach(input))).collect();
            ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
            inputs = ranked.into_iter().take(MOST_ALONE).map(|(input, _)| input).collect();
        }
        let values = |input: usize| {
            let own = space.alone[input]?;
            let points = space.points(&vec![(input, own)]);
            Some((input, own, points.iter().map(|point| program.evaluate(point)).collect()))
        };
        Self { inputs: inputs.into_iter().filter_map(values).collect() }
    }
}

/// What an output does along a way.
struct Along {
    /// Its values at the points.
    values: [f64; POINTS],
    /// How far its tangent would have it at the ends of the way, if it has one.
    tangent: [f64; 2],
    moves: Moves,
}

impl Along {
    fn departure(&self, point: usize) -> f64 {
        (self.values[point] - self.values[MEDIAN]).abs()
    }

    /// Half of the central part, as a standard deviation.
    fn spread(&self) -> f64 {
        let ends = [CENTRAL, 2 * MEDIAN - CENTRAL].map(|point| self.departure(point));
        ends.into_iter().fold(0.0, f64::max) / CENTRAL_DEVIATIONS
    }

    /// The mean square of the departure as far out as the way goes: the integral over the logarithm of the
    /// probability, in which the tails of a power are straight.
    fn variance(&self) -> f64 {
        let at = |point: usize, tail: usize| {
            let square = TAILS[tail] * self.departure(point).powi(2);
            if square.is_finite() { square } else { 0.0 }
        };
        let of_tail = |tail: usize| {
            let width = elementary::ln(TAILS[tail + 1] / TAILS[tail]);
            let of_end =
                |end: fn(usize) -> usize| at(end(tail), tail) + at(end(tail + 1), tail + 1);
            0.5 * width * (of_end(|tail| tail) + of_end(|tail| 2 * MEDIAN - tail))
        };
        (0..MEDIAN - 1).map(of_tail).sum()
    }

    /// The order that the tails leave, where they leave the tangent.
    fn order(&self, spread: f64, variance: f64) -> f64 {
        let of_end = |((point, before), tangent): ((usize, usize), f64)| {
            let far = self.departure(point);
            // what is not defined there is in no trial
            let straight = tangent.is_finite() && far <= LEFT_TANGENT * tangent;
            let bounded = far.is_finite() && far <= STILL * self.departure(before);
            if straight || bounded || self.values[point].is_nan() {
                f64::INFINITY
            } else if ONE_TRIAL * far > OF_MEAN * spread {
                1.0
            } else if ONE_TRIAL * far.powi(2) > OF_VARIANCE * variance {
                2.0
            } else {
                f64::INFINITY
            }
        };
        let ends = [(0, 1), (2 * MEDIAN, 2 * MEDIAN - 1)].into_iter().zip(self.tangent);
        ends.map(of_end).fold(f64::INFINITY, f64::min)
    }
}

/// An output that is no sum of its inputs times constants.
struct Bend<'a> {
    program: &'a Program,
    space: &'a Space<'a>,
    linear: &'a GumRow,
    output: usize,
}

impl Bend<'_> {
    fn order(&self, alone: &Alone, folded: &[Option<f64>]) -> f64 {
        let sets = self.linked();
        let is_linked = |input: usize| sets.iter().flatten().any(|linked| linked.0 == input);
        let mut ways: Vec<Along> = Vec::new();
        for (input, own, outputs) in alone.inputs.iter().filter(|way| !is_linked(way.0)) {
            let values = std::array::from_fn(|point| outputs[point][self.output]);
            ways.push(self.along(vec![(*input, *own)], values));
        }
        let follow = |moves: Moves| {
            let points = self.space.points(&moves);
            let values = std::array::from_fn(|point| self.value(&points[point]));
            self.along(moves, values)
        };
        ways.extend(sets.iter().map(|set| follow(self.space.together(set))));
        let spread = ways.iter().map(|way| way.spread().powi(2)).sum::<f64>().sqrt();
        let variance = ways.iter().map(Along::variance).sum();
        if ways.len() > 1 {
            let all: Vec<usize> = self.space.varying().collect();
            ways.extend(self.correlations(&all).map(|all| follow(self.space.apart(&all))));
        }
        let tails = ways.iter().map(|way| way.order(spread, variance));
        let order = tails.fold(f64::INFINITY, f64::min);
        if order <= 1.0 || !may_have_pole(self.program, folded, self.output) {
            return order;
        }
        ways.iter().map(|way| self.order_of_pole(way)).fold(order, f64::min)
    }

    fn value(&self, inputs: &[f64]) -> f64 {
        self.program.evaluate(inputs)[self.output]
    }

    fn along(&self, moves: Moves, values: [f64; POINTS]) -> Along {
        let gradient = self.linear.gradient(self.output);
        let slope = |input: usize| gradient.and_then(|gradient| gradient.get(input)).copied();
        let tangent = [0, 2 * MEDIAN].map(|end| {
            let moved =
                moves.iter().map(|(input, own)| slope(*input).unwrap_or(f64::NAN) * own[end]);
            moved.sum::<f64>().abs()
        });
        Along { values, tangent, moves }
    }

    /// The covariance of each input with the output by the law of propagation, over the input's standard
    /// uncertainty.
    fn covariances(&self) -> Option<Vec<f64>> {
        let gradient = self.linear.gradient(self.output)?;
        let (u, links) = self.linear.known();
        let signed = |input: usize| gradient[input] * u[input];
        let mut found: Vec<f64> = (0..u.len()).map(signed).collect();
        for link in links {
            found[link.first] += link.coefficient * signed(link.second);
            found[link.second] += link.coefficient * signed(link.first);
        }
        found.iter().all(|value| value.is_finite()).then_some(found)
    }

    /// The correlation of each of these inputs with what they contribute together, of those that have one.
    /// `None` where they contribute nothing.
    fn correlations(&self, inputs: &[usize]) -> Option<Vec<(usize, f64)>> {
        let covariances = self.covariances()?;
        let (u, _) = self.linear.known();
        let gradient = self.linear.gradient(self.output)?;
        let variance: f64 =
            inputs.iter().map(|&input| gradient[input] * u[input] * covariances[input]).sum();
        let step = |&input: &usize| (input, covariances[input] / variance.sqrt());
        (variance > 0.0).then(|| inputs.iter().map(step).filter(|step| step.1 != 0.0).collect())
    }

    /// The sets of inputs that coefficients link. A set that contributes nothing is left to its inputs one
    /// at a time.
    fn linked(&self) -> Vec<Vec<(usize, f64)>> {
        let (_, links) = self.linear.known();
        let varies = |input: &usize| self.space.alone[*input].is_some();
        let sets = connected(links).into_iter();
        let varying = sets.map(|set| set.into_iter().filter(varies).collect());
        varying.filter_map(|set: Vec<usize>| self.correlations(&set)).collect()
    }

    /// The order that the sharpest pole on a way leaves: 1/x has moments below 1, 1/sqrt(x) below 2. A pole
    /// beyond a probability of 1e-7 does not count: a trial that moves the mean has to come so near to it
    /// that no one in a thousand million does.
    fn order_of_pole(&self, way: &Along) -> f64 {
        let points = self.space.points(&way.moves);
        let inner = &way.values[1..POINTS - 1];
        let heights: Vec<f64> = inner.iter().map(|value| value.abs()).collect();
        let modulus = |place: usize, share: f64| {
            let ends = points[place + 1].iter().zip(&points[place + 2]);
            let between: Vec<f64> = ends.map(|(from, to)| from + share * (to - from)).collect();
            self.value(&between).abs()
        };
        let pole = pole_order(&heights, modulus);
        let lacks = |power: f64| power * pole >= 1.0 - OF_ORDER;
        if lacks(1.0) {
            1.0
        } else if lacks(2.0) {
            2.0
        } else {
            f64::INFINITY
        }
    }
}

/// What the order of a pole may be off by.
const OF_ORDER: f64 = 0.02;

/// Whether an operation that an output comes from has a pole where its operands vary.
fn may_have_pole(program: &Program, folded: &[Option<f64>], output: usize) -> bool {
    let needed = program.needed_by(folded, [program.outputs[output]]);
    let varies = |node: usize| folded[node].is_none();
    let has_pole = |node: &Node| match *node {
        Node::Variable(_) | Node::Constant(_) => false,
        Node::Unary(of, x) => matches!(of, Unary::Tan | Unary::Gamma) && varies(x),
        Node::Binary(Binary::Divide, _, y) => varies(y),
        Node::Binary(Binary::Power, _, y) => folded[y].is_none_or(|power| power < 0.0),
        Node::Binary(..) => false,
        Node::Routine(_) => true,
    };
    let nodes = program.nodes.iter().enumerate().zip(needed);
    nodes.into_iter().any(|((index, node), needed)| needed && varies(index) && has_pole(node))
}
