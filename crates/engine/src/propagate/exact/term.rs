//! The distribution of one group's summand: in closed form, or as weighted points of a quadrature
//! over the independent quantities behind the group.

use std::collections::HashMap;
use std::sync::Arc;

use super::invert::Decay;
use super::separate::{Leaf, SeparateGroup};
use super::tails::{Beyond, PANELS, RINGS};
use crate::distribution::characteristic::{Characteristic, Complex, Reach};
use crate::distribution::{Dependence, Distribution, Linked};
use crate::linalg::packed;
use crate::model::{Node, Program, RoutineCall};
use crate::number::{ascending, elementary};
use crate::special::{self, legendre};

/// A summand: a constant and a quantity whose characteristic function is known.
#[derive(Clone, Debug)]
pub(super) struct Term {
    /// Its mean, or its middle where there is none.
    pub(super) mean: f64,
    /// What the quantity of `law` is multiplied by.
    pub(super) factor: f64,
    pub(super) law: Characteristic,
    /// How far the characteristic function of the points may be off.
    pub(super) error: f64,
    /// Expectations of the exponential of the summand and of its square, where they were asked for, and
    /// how far each may be off, relative to itself.
    pub(super) powers: Option<[[f64; 2]; 2]>,
    /// What lies beyond the points of the law: to be added to the mean, and to the expectation of the
    /// square about `mean`.
    pub(super) beyond: [Beyond; 2],
}

impl Term {
    fn closed(mean: f64, factor: f64, law: Characteristic) -> Self {
        Self { mean, factor, law, error: 0.0, powers: None, beyond: [Beyond::default(); 2] }
    }

    /// The expectation, infinite or not a number where there is none.
    pub(super) fn expectation(&self) -> f64 {
        self.mean + self.beyond[0].value
    }

    /// The characteristic function of the summand less its mean.
    pub(super) fn at(&self, t: f64) -> Complex {
        let [re, im] = self.law.at(t * self.factor.abs());
        if self.factor < 0.0 { [re, -im] } else { [re, im] }
    }

    pub(super) fn bound(&self, t: f64) -> f64 {
        self.law.bound(t * self.factor.abs())
    }

    pub(super) fn reach(&self) -> Reach {
        let factor = self.factor.abs();
        match self.law.reach() {
            Reach::Bounded(reach) => Reach::Bounded(factor * reach),
            Reach::Light(reach) => Reach::Light(factor * reach),
            Reach::Heavy(reach) => Reach::Heavy(factor * reach),
        }
    }

    pub(super) fn variance(&self) -> f64 {
        let [mean, square] = self.beyond.map(|beyond| beyond.value);
        if square.is_infinite() {
            return square;
        }
        self.law.variance() * self.factor * self.factor + square - mean * mean
    }

    pub(super) fn width(&self) -> f64 {
        self.law.width() * self.factor.abs()
    }
}

/// What is known of the inputs of a row.
pub(super) struct TermInputs<'a> {
    pub(super) program: &'a Program,
    /// The values of the nodes that do not vary.
    pub(super) folded: &'a [Option<f64>],
    pub(super) distributions: &'a [Arc<Distribution>],
    pub(super) linked: &'a [Linked],
}

/// The mean of what is drawn, or the middle where there is none.
pub(super) fn middle(distribution: &Distribution) -> f64 {
    distribution.saved().map_or_else(|| distribution.mean(), |saved| saved.drawn_mean())
}

/// Standard deviation of a normal quantity that is drawn, scale of a t.
fn drawn_scale(distribution: &Distribution) -> f64 {
    match distribution {
        Distribution::Readings(readings) => readings.drawn_scale(),
        other => other.standard_uncertainty(),
    }
}

/// The summand of a group; `frequency` is the largest argument of its characteristic function that
/// will be asked for, and `exponentials` whether expectations of its exponential will be.
///
/// # Errors
/// Why it is not known.
pub(super) fn term(
    inputs: &TermInputs<'_>,
    group: &SeparateGroup,
    frequency: f64,
    exponentials: bool,
) -> Result<Term, String> {
    if let Some(term) = closed(inputs, group) {
        return Ok(term);
    }
    points(inputs, group, frequency, exponentials)
}

/// The summand of a group whose characteristic function has a closed form.
pub(super) fn closed(inputs: &TermInputs<'_>, group: &SeparateGroup) -> Option<Term> {
    let distribution = |v: usize| inputs.distributions.get(v).map(|d| &**d);
    let variable = |leaf: &Leaf| match inputs.program.nodes[leaf.node] {
        Node::Variable(v) if !leaf.logarithm => Some(v),
        _ => None,
    };
    if let ([leaf], [v]) = (group.leaves.as_slice(), group.variables.as_slice()) {
        let alone = distribution(*v)?;
        let bare = matches!(inputs.program.nodes[leaf.node], Node::Variable(_));
        return match alone {
            Distribution::Lognormal(shape) if leaf.logarithm && bare => {
                let [mean, std] = shape.of_logarithm();
                let law = Characteristic::Normal { std };
                let mut term = Term::closed(leaf.factor * mean, leaf.factor, law);
                let power = |n: f64| {
                    let f = n * leaf.factor;
                    elementary::exp(f * mean + 0.5 * f * f * std * std)
                };
                term.powers = Some([[power(1.0), 0.0], [power(2.0), 0.0]]);
                Some(term)
            }
            _ if leaf.logarithm || !bare => None,
            _ => {
                let law = Characteristic::of(alone)?;
                Some(Term::closed(leaf.factor * middle(alone), leaf.factor, law))
            }
        };
    }
    // a linear function of one set of linked quantities
    let [set] = group.linked.as_slice() else {
        return None;
    };
    let set = &inputs.linked[*set];
    let mut weights = vec![0.0; set.members.len()];
    let mut mean = 0.0;
    for leaf in &group.leaves {
        let v = variable(leaf)?;
        let place = set.members.iter().position(|&m| m == v)?;
        let of = distribution(v)?;
        weights[place] += leaf.factor * drawn_scale(of);
        mean += leaf.factor * of.mean();
    }
    let scale = |factor: &[f64]| {
        let mut mixed = vec![0.0; weights.len()];
        for (weight, row) in weights.iter().zip(packed::rows(factor)) {
            for (mixed, entry) in mixed.iter_mut().zip(row) {
                *mixed += weight * entry;
            }
        }
        mixed.iter().map(|m| m * m).sum::<f64>().sqrt()
    };
    match &set.dependence {
        Dependence::Scores(factor) => {
            let normal = set
                .members
                .iter()
                .all(|&m| distribution(m).is_some_and(Distribution::is_drawn_normal));
            let std = scale(factor);
            (normal && std > 0.0).then(|| Term::closed(mean, 1.0, Characteristic::Normal { std }))
        }
        Dependence::Student(dof, factor) => {
            let scale = scale(factor);
            (scale > 0.0).then(|| Term::closed(mean, 1.0, Characteristic::student(scale, *dof)))
        }
        Dependence::Trials => None,
    }
}

/// A quantity that is integrated over.
enum Coordinate {
    /// A standard normal score.
    Score,
    /// The probability of a quantity of its own.
    Probability(Arc<Distribution>),
}

/// A place on a coordinate.
#[derive(Clone, Copy)]
struct CoordinatePlace {
    /// The score, or the value of the quantity.
    at: f64,
    weight: f64,
    /// At which end, and in which ring, the innermost first, if it lies in one.
    ring: Option<(End, usize)>,
}

/// An end of a coordinate.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    Lower,
    Upper,
}

impl End {
    pub(super) const BOTH: [Self; 2] = [Self::Lower, Self::Upper];
}

/// Why quantities that are drawn in sets have no distribution here.
pub(super) const DRAWN_TOGETHER: &str = "the joint distribution of outputs of one saved result, or of parameters of a fit, is known \
     only by draws";

/// Scores farther out have no weight.
const FARTHEST: f64 = 8.6;

/// Levels of refinement.
const LEVELS: u32 = 6;

/// At most so many points.
const MOST_POINTS: usize = 40_000;

impl Coordinate {
    /// The places of a rule, finer with every level.
    fn places(&self, level: u32) -> Vec<CoordinatePlace> {
        match self {
            Self::Score => {
                let steps = 24 << level;
                let step = 2.0 * FARTHEST / f64::from(steps);
                let scale = step / std::f64::consts::TAU.sqrt();
                let at = |k: u32| {
                    let at = -FARTHEST + step * f64::from(k);
                    CoordinatePlace {
                        at,
                        weight: scale * elementary::exp(-0.5 * at * at),
                        ring: None,
                    }
                };
                (0..=steps).map(at).collect()
            }
            Self::Probability(distribution) => probabilities(distribution, level),
        }
    }
}

/// Where the quantile function has a kink.
fn kinks(distribution: &Distribution) -> Vec<f64> {
    match distribution {
        Distribution::Triangular(shape) => vec![shape.share_below_mode()],
        Distribution::Trapezoidal(shape) => {
            vec![shape.share_of_flank(), 1.0 - shape.share_of_flank()]
        }
        _ => Vec::new(),
    }
}

/// Whether the quantile function is smooth up to both ends.
fn is_smooth(distribution: &Distribution) -> bool {
    match distribution {
        Distribution::Rectangular(_) | Distribution::LogUniform(_) => {
            distribution.dof().is_infinite()
        }
        Distribution::Arcsine(_) => true,
        _ => false,
    }
}

/// The probabilities between which the quantile function is smooth.
fn edges(distribution: &Distribution) -> Vec<f64> {
    let mut edges = vec![0.0, 0.5, 1.0];
    edges.extend(kinks(distribution));
    edges.retain(|p| (0.0..=1.0).contains(p));
    ascending(&mut edges);
    edges.dedup();
    edges
}

/// The probability between an end and the edge next to it.
fn last_stretch(distribution: &Distribution, end: End) -> f64 {
    let edges = edges(distribution);
    match end {
        End::Lower => edges[1],
        End::Upper => 1.0 - edges[edges.len() - 2],
    }
}

/// Panels at an end: to probabilities of 1e-17, each a quarter of the one before.
const AT_END: u32 = 27;

/// Places of a panel of so many pieces, whose probabilities are counted from an end.
fn panel(
    distribution: &Distribution,
    end: End,
    start: f64,
    width: f64,
    pieces: u32,
    ring: Option<usize>,
) -> impl Iterator<Item = CoordinatePlace> {
    let width = width / f64::from(pieces);
    let piece = move |piece: u32| legendre::nodes().map(|node| (piece, node));
    (0..pieces).flat_map(piece).map(move |(piece, [node, weight])| {
        let p = start + width * (f64::from(piece) + node);
        let at = match end {
            End::Lower => distribution.quantile(p),
            End::Upper => distribution.quantile_upper(p),
        };
        CoordinatePlace { at, weight: weight * width, ring: ring.map(|ring| (end, ring)) }
    })
}

/// Values and weights of a ring at an end, the innermost first.
pub(super) fn ring_at_end(
    distribution: &Distribution,
    end: End,
    ring: usize,
) -> impl Iterator<Item = [f64; 2]> {
    let stretch = last_stretch(distribution, end);
    let last = AT_END - 1 - ring as u32 * PANELS;
    (last + 1 - PANELS..=last).flat_map(move |depth| {
        let outer = stretch * 0.25f64.powi(depth as i32);
        let places = panel(distribution, end, 0.25 * outer, 0.75 * outer, 1, None);
        places.map(|place| [place.at, place.weight])
    })
}

/// Values and weights of a rule over the probability, finer towards both ends unless the quantile
/// function is smooth there.
fn probabilities(distribution: &Distribution, level: u32) -> Vec<CoordinatePlace> {
    let mut places = Vec::new();
    let pieces = 1 << level;
    for pair in edges(distribution).windows(2) {
        let end = if pair[0] >= 0.5 { End::Upper } else { End::Lower };
        let [low, high] = match end {
            End::Upper => [1.0 - pair[1], 1.0 - pair[0]],
            End::Lower => [pair[0], pair[1]],
        };
        if low > 0.0 || is_smooth(distribution) {
            places.extend(panel(distribution, end, low, high - low, pieces, None));
            continue;
        }
        let mut outer = high;
        for depth in 0..AT_END {
            let ring = Some(((AT_END - 1 - depth) / PANELS) as usize).filter(|ring| *ring < RINGS);
            let pieces = if depth < 5 { pieces } else { 1 };
            places.extend(panel(distribution, end, 0.25 * outer, 0.75 * outer, pieces, ring));
            outer *= 0.25;
        }
    }
    places
}

/// The independent quantities behind a group.
fn coordinates(inputs: &TermInputs<'_>, group: &SeparateGroup) -> Result<Vec<Coordinate>, String> {
    let mut coordinates = Vec::new();
    for &v in &group.variables {
        let linked = group.linked.iter().map(|&l| &inputs.linked[l]);
        if linked.into_iter().any(|set| set.members.contains(&v)) {
            coordinates.push(Coordinate::Score);
            continue;
        }
        let distribution = &inputs.distributions[v];
        coordinates.push(match &**distribution {
            shape if shape.is_drawn_normal() => Coordinate::Score,
            Distribution::Lognormal(_) => Coordinate::Score,
            Distribution::Samples(_) => {
                return Err("samples go through a function that is not linear".to_owned());
            }
            shape if shape.has_quantiles() => Coordinate::Probability(Arc::clone(distribution)),
            shape => {
                return Err(format!(
                    "no quantiles are known of the distribution `{}`",
                    shape.name()
                ));
            }
        });
    }
    Ok(coordinates)
}

/// The value of a quantity at a standard normal score.
fn at_score(distribution: &Distribution, z: f64) -> f64 {
    match distribution {
        shape if shape.is_drawn_normal() => shape.mean() + shape.standard_uncertainty() * z,
        shape if z < 0.0 => shape.quantile(special::normal::cdf(z)),
        shape => shape.quantile_upper(special::normal::sf(z)),
    }
}

/// The part of a program that some nodes need.
pub(super) struct SubProgram {
    program: Program,
    /// Which nodes.
    leaves: Vec<Leaf>,
}

impl SubProgram {
    /// How many summands there are.
    pub(super) fn leaves(&self) -> usize {
        self.leaves.len()
    }

    pub(super) fn new(inputs: &TermInputs<'_>, group: &SeparateGroup) -> Self {
        let leaves = group.leaves.iter().map(|leaf| leaf.node);
        // of a sum of many groups each needs few nodes of the program
        let needed = inputs.program.nodes_behind(inputs.folded, leaves);
        let place: HashMap<usize, usize> =
            needed.iter().enumerate().map(|(place, &node)| (node, place)).collect();
        let (mut nodes, mut routines) = (Vec::new(), Vec::new());
        for &index in &needed {
            nodes.push(match (inputs.folded[index], inputs.program.nodes[index]) {
                (Some(value), _) => Node::Constant(value),
                (None, Node::Variable(v)) => {
                    Node::Variable(group.variables.binary_search(&v).unwrap_or(0))
                }
                (None, Node::Unary(operation, x)) => Node::Unary(operation, place[&x]),
                (None, Node::Binary(operation, x, y)) => {
                    Node::Binary(operation, place[&x], place[&y])
                }
                (None, Node::Routine(call)) => {
                    let call = &inputs.program.routines[call];
                    let operands = call.operands.iter().map(|x| place[x]).collect();
                    routines.push(RoutineCall { routine: Arc::clone(&call.routine), operands });
                    Node::Routine(routines.len() - 1)
                }
                (None, constant) => constant,
            });
        }
        let outputs = group.leaves.iter().map(|leaf| place[&leaf.node]).collect();
        let program = Program { nodes, variables: group.variables.len(), outputs, routines };
        Self { program, leaves: group.leaves.clone() }
    }

    /// The summand at some values; `signs` are the signs that logarithms' arguments had so far.
    pub(super) fn value(&self, values: &[f64], signs: &mut [f64]) -> Option<f64> {
        let mut sum = 0.0;
        let outputs = self.program.evaluate(values);
        for ((leaf, value), sign) in self.leaves.iter().zip(outputs).zip(signs) {
            if leaf.logarithm {
                if value == 0.0 || value * *sign < 0.0 {
                    return None;
                }
                *sign = value.signum();
                sum += leaf.factor * elementary::ln(value.abs());
            } else {
                sum += leaf.factor * value;
            }
        }
        sum.is_finite().then_some(sum)
    }
}

/// Points of a summand.
struct Points {
    /// Values and weights.
    points: Vec<[f64; 2]>,
    /// Which of them lie in a ring at an end of a coordinate: the point, the coordinate, end and ring.
    in_rings: Vec<(usize, usize, End, usize)>,
}

impl Points {
    /// The expectation of a function of the summand.
    fn expectation(&self, of: impl Fn(f64) -> f64) -> f64 {
        self.points.iter().map(|&[value, weight]| weight * of(value)).sum()
    }

    /// What the rings of a coordinate's end contribute to the expectation of a function.
    fn rings(&self, coordinate: usize, end: End, of: impl Fn(f64) -> f64) -> [f64; RINGS] {
        let mut rings = [0.0; RINGS];
        for &(point, at, side, ring) in &self.in_rings {
            if (at, side) == (coordinate, end) {
                let [value, weight] = self.points[point];
                rings[ring] += weight * of(value);
            }
        }
        rings
    }
}

/// Points of the summand at one level.
fn level_points(
    inputs: &TermInputs<'_>,
    group: &SeparateGroup,
    part: &SubProgram,
    coordinates: &[Coordinate],
    level: u32,
) -> Result<Points, String> {
    let places: Vec<Vec<CoordinatePlace>> = coordinates.iter().map(|c| c.places(level)).collect();
    let count = places.iter().map(Vec::len).try_fold(1usize, usize::checked_mul);
    let count = count.filter(|&count| count <= MOST_POINTS).ok_or_else(|| {
        let names = coordinates.len();
        format!("{names} inputs are in one function that is not a sum of functions of one input")
    })?;
    let mut points = Vec::with_capacity(count);
    let mut in_rings = Vec::new();
    let mut signs = vec![0.0; part.leaves.len()];
    let mut at = vec![0usize; places.len()];
    let mut values = vec![0.0; places.len()];
    loop {
        let mut weight = 1.0;
        for ((value, places), &at) in values.iter_mut().zip(&places).zip(&at) {
            *value = places[at].at;
            weight *= places[at].weight;
        }
        if weight > 1e-22 {
            place_values(inputs, group, coordinates, &mut values);
            let value = part.value(&values, &mut signs).ok_or_else(no_value)?;
            for (coordinate, (places, &at)) in places.iter().zip(&at).enumerate() {
                if let Some((end, ring)) = places[at].ring {
                    in_rings.push((points.len(), coordinate, end, ring));
                }
            }
            points.push([value, weight]);
        }
        let mut done = true;
        for (at, places) in at.iter_mut().zip(&places) {
            *at += 1;
            if *at < places.len() {
                done = false;
                break;
            }
            *at = 0;
        }
        if done {
            break;
        }
    }
    let sum: f64 = points.iter().map(|[_, weight]| weight).sum();
    for point in &mut points {
        point[1] /= sum;
    }
    Ok(Points { points, in_rings })
}

fn no_value() -> String {
    "a quantity under a logarithm, a quotient or a root changes its sign or has no finite value"
        .to_owned()
}

/// Panels beyond those of the quadrature in which a tail is followed: to probabilities of 1e-290.
const FARTHER: u32 = 150;

/// What lies beyond the points of a summand for the expectations of some functions of it.
///
/// # Errors
/// A tail has no value.
fn beyond<const N: usize>(
    part: &SubProgram,
    coordinates: &[Coordinate],
    points: &Points,
    functions: [&dyn Fn(f64) -> f64; N],
) -> Result<[Beyond; N], String> {
    let scales = functions.map(|function| points.expectation(|value| function(value).abs()));
    let mut all = [Beyond::default(); N];
    for (number, coordinate) in coordinates.iter().enumerate() {
        let Coordinate::Probability(distribution) = coordinate else { continue };
        for end in End::BOTH {
            let mut rings = functions.map(|function| points.rings(number, end, function));
            let mut added = [0.0; N];
            let open = |rings: &[[f64; RINGS]; N]| {
                let mut each = rings.iter().zip(scales);
                each.any(|(rings, scale)| {
                    let beyond = Beyond::of(*rings, scale);
                    !beyond.is_negligible() && beyond.value.is_finite()
                })
            };
            // the tail of one quantity alone is followed
            if coordinates.len() == 1 && open(&rings) {
                let mut signs = vec![0.0; part.leaves.len()];
                let mut outer = last_stretch(distribution, end) * 0.25f64.powi(AT_END as i32);
                for _ in 0..FARTHER {
                    let mut ring = [0.0; N];
                    for _ in 0..PANELS {
                        for place in panel(distribution, end, 0.25 * outer, 0.75 * outer, 1, None) {
                            let value = part.value(&[place.at], &mut signs).ok_or_else(no_value)?;
                            for (ring, function) in ring.iter_mut().zip(functions) {
                                *ring += place.weight * function(value);
                            }
                        }
                        outer *= 0.25;
                    }
                    for ((rings, added), ring) in rings.iter_mut().zip(&mut added).zip(ring) {
                        *added += ring;
                        *rings = [ring, rings[0], rings[1]];
                    }
                    if !open(&rings) {
                        break;
                    }
                }
            }
            for (((all, added), rings), scale) in all.iter_mut().zip(added).zip(rings).zip(scales) {
                *all += Beyond { value: added, off: 0.0 };
                *all += Beyond::of(rings, scale);
            }
        }
    }
    Ok(all)
}

/// Turns scores into values, in place.
fn place_values(
    inputs: &TermInputs<'_>,
    group: &SeparateGroup,
    coordinates: &[Coordinate],
    values: &mut [f64],
) {
    let mut mixed = values.to_vec();
    for &l in &group.linked {
        let set = &inputs.linked[l];
        let Dependence::Scores(factor) = &set.dependence else {
            continue;
        };
        let place = |m: &usize| group.variables.binary_search(m).unwrap_or(0);
        for (member, row) in set.members.iter().zip(packed::rows(factor)) {
            let own = row.iter().zip(&set.members);
            mixed[place(member)] = own.map(|(weight, m)| weight * values[place(m)]).sum();
        }
    }
    for (i, coordinate) in coordinates.iter().enumerate() {
        if let Coordinate::Score = coordinate {
            values[i] = match &*inputs.distributions[group.variables[i]] {
                Distribution::Lognormal(shape) => {
                    let [mean, std] = shape.of_logarithm();
                    elementary::exp(mean + std * mixed[i])
                }
                other => at_score(other, mixed[i]),
            };
        }
    }
}

/// The characteristic function of points less a value.
fn transform(points: &[[f64; 2]], origin: f64, t: f64) -> Complex {
    let mut sum = [0.0; 2];
    for &[value, weight] in points {
        let (sin, cos) = elementary::sin_cos(t * (value - origin));
        sum[0] += weight * cos;
        sum[1] += weight * sin;
    }
    sum
}

/// Two levels that differ by less than this are the same.
const SAME: f64 = 3e-14;

/// Differences beyond this leave nothing to print.
const MOST_DIFFERENT: f64 = 1e-11;

/// Quantities that depend on each other are integrated over only where scores stand behind them.
fn check_dependence(inputs: &TermInputs<'_>, group: &SeparateGroup) -> Result<(), String> {
    for &l in &group.linked {
        match inputs.linked[l].dependence {
            Dependence::Scores(_) => {}
            Dependence::Student(..) => {
                return Err("paired readings go through a function that is not linear".to_owned());
            }
            Dependence::Trials => {
                return Err(DRAWN_TOGETHER.to_owned());
            }
        }
    }
    Ok(())
}

/// The summand of a group by quadrature.
fn points(
    inputs: &TermInputs<'_>,
    group: &SeparateGroup,
    frequency: f64,
    exponentials: bool,
) -> Result<Term, String> {
    check_dependence(inputs, group)?;
    let part = SubProgram::new(inputs, group);
    let coordinates = coordinates(inputs, group)?;
    let at = |level: u32| level_points(inputs, group, &part, &coordinates, level);
    let mut before = at(0)?;
    let mut error = f64::INFINITY;
    for level in 1..=LEVELS {
        let Ok(finer) = at(level) else {
            break;
        };
        let mean = finer.expectation(|value| value);
        let square = |points: &Points| points.expectation(|value| (value - mean).powi(2));
        let spread = square(&finer).sqrt();
        let shift = before.expectation(|value| value - mean).abs() / spread;
        let wider = (square(&before) / (spread * spread) - 1.0).abs();
        error = f64::max(shift, wider);
        for share in [1.0, 0.7, 0.4, 0.1] {
            let [a, b] =
                [&before, &finer].map(|sum| transform(&sum.points, mean, share * frequency));
            error = error.max((a[0] - b[0]).abs()).max((a[1] - b[1]).abs());
        }
        before = finer;
        if error < SAME {
            break;
        }
    }
    if error.is_nan() || error >= MOST_DIFFERENT {
        return Err(
            "the distribution of a function of several inputs is not found to enough digits"
                .to_owned(),
        );
    }
    let mean = before.expectation(|value| value);
    let moments: [&dyn Fn(f64) -> f64; 2] =
        [&|value| value - mean, &|value| (value - mean).powi(2)];
    let exponentials = if exponentials {
        let functions: [&dyn Fn(f64) -> f64; 2] =
            [&|value| elementary::exp(value), &|value| elementary::exp(2.0 * value)];
        let beyond = beyond(&part, &coordinates, &before, functions)?;
        let mut all = functions.into_iter().zip(beyond).map(|(function, beyond)| {
            let value = before.expectation(function) + beyond.value;
            [value, beyond.off / value]
        });
        all.next().zip(all.next()).map(|(first, second)| [first, second])
    } else {
        None
    };
    let beyond = beyond(&part, &coordinates, &before, moments)?;
    let points: Vec<[f64; 2]> =
        before.points.iter().map(|[value, weight]| [value - mean, *weight]).collect();
    let law = Characteristic::Points(points);
    Ok(Term { mean, factor: 1.0, law, error, powers: exponentials, beyond })
}

/// Arguments of the table of a decay for an octave.
const IN_OCTAVE: f64 = 2.0;

/// A modulus below this is lost in rounding.
const LOST: f64 = 1e-16;

/// How the characteristic function of a group falls, as far as points tell: at each argument two
/// levels of the quadrature agree.
pub(super) fn decay(inputs: &TermInputs<'_>, group: &SeparateGroup) -> Result<Decay, String> {
    check_dependence(inputs, group)?;
    let part = SubProgram::new(inputs, group);
    let coordinates = coordinates(inputs, group)?;
    let at = |level: u32| {
        level_points(inputs, group, &part, &coordinates, level).map(|made| made.points)
    };
    let mut level = 1;
    let (mut rough, mut fine) = (at(0)?, at(1)?);
    let mean: f64 = fine.iter().map(|[value, weight]| value * weight).sum();
    let variance: f64 = fine.iter().map(|[v, w]| w * (v - mean).powi(2)).sum();
    let width = variance.sqrt();
    let reach = fine.iter().map(|[value, _]| (value - mean).abs()).fold(0.0, f64::max);
    let mut bounds = Vec::new();
    let mut work = 0;
    'arguments: for k in 0..24 {
        let t = elementary::exp(f64::from(k) * std::f64::consts::LN_2 / IN_OCTAVE) / width;
        let mut largest: f64 = 0.0;
        // neighbours, so that a zero is no fall
        for share in [1.0, 1.13, 1.27] {
            let modulus = loop {
                let [a, b] = [&rough, &fine].map(|points| transform(points, mean, share * t));
                work += rough.len() + fine.len();
                let off = elementary::hypot(a[0] - b[0], a[1] - b[1]);
                let modulus = elementary::hypot(b[0], b[1]);
                if off <= f64::max(LOST, 0.1 * modulus) {
                    break modulus;
                }
                level += 1;
                match at(level) {
                    Ok(finer) if level <= LEVELS && work < MOST_WORK => {
                        rough = std::mem::replace(&mut fine, finer);
                    }
                    _ => break 'arguments,
                }
            };
            largest = largest.max(modulus);
        }
        bounds.push([t, largest]);
        if largest < LOST {
            break;
        }
    }
    // what was found at an argument holds from there on only as far as nothing larger follows
    for k in (1..bounds.len()).rev() {
        bounds[k - 1][1] = f64::min(1.0, bounds[k - 1][1].max(bounds[k][1]));
    }
    for bound in &mut bounds {
        bound[1] = f64::min(1.0, 2.0 * bound[1]);
    }
    Ok(Decay { bounds, width, reach, points: fine.len() })
}

/// Terms of sums for the table of a decay, at most.
const MOST_WORK: usize = 1_000_000;
