//! An effect of the integrated input that is monotone in parts alone: at each point of the others the
//! output turns where it turns, and the probability is the sum over the parts.

use super::cdf::Cdf;
use super::{ENDED, Integrated, Net, OfNet, STEPS, Setup};
use crate::number::{COLUMN, Column};

/// Turns at a point at most.
const MOST_TURNS: usize = 4;

/// Probabilities between whose quantiles a turn is looked for, below the median.
const NODES: [f64; 17] = [
    1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 0.01, 0.03, 0.06, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45,
    0.475,
];

/// Golden sections after which a turn is known to 1e-13 of where it was looked for.
const SECTIONS: u32 = 62;

/// A turn that is so many times as far from the nodes beside it as these are from each other is a pole:
/// golden sections come as near to it as 1e-13 of their distance.
const POLE: f64 = 1e6;

/// A step that is longer than this share of the input's width does not show that the next, short one
/// ends the search: beside a pole, or at an end where the output is huge, secants are so steep that all
/// steps are short.
const NEAR: f64 = 1e-2;

/// The smaller part of the golden section.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// A boundary between two parts: the value of the integrated input, the output there, and the
/// probability of smaller values.
type Bound = [Column; 3];

/// The parts at one column of points.
#[derive(Debug)]
pub(super) struct ColumnPieces {
    /// From the lower end of the input to its upper one. Where a point has fewer turns than others of
    /// its column the last bounds are the same.
    bounds: Vec<Bound>,
    /// Where each part was found last.
    last: Vec<Column>,
}

/// The values of a column at one value of the integrated input for each point.
fn run(
    setup: &Setup,
    column: &[Column],
    place: usize,
    at: &Column,
    registers: &mut [Column],
) -> Column {
    registers[..column.len()].clone_from_slice(column);
    registers[place].0 = at.0;
    let mut out = Column::ZERO;
    setup.run(registers, &mut out);
    out
}

/// The parts of all columns of a net; `None` where the output is flat or not finite somewhere, or turns
/// too often.
pub(super) fn parts(
    setup: &Setup,
    net: &Net,
    place: usize,
    cdf: &Cdf,
) -> Option<Vec<ColumnPieces>> {
    let distribution = &setup.distributions[place];
    let nodes = distribution.quantiles_about_median(&NODES);
    let mut registers = setup.registers();
    net.columns
        .iter()
        .map(|column| of_column(setup, column, place, cdf, &nodes, &mut registers))
        .collect()
}

fn of_column(
    setup: &Setup,
    column: &[Column],
    place: usize,
    cdf: &Cdf,
    nodes: &[f64],
    registers: &mut [Column],
) -> Option<ColumnPieces> {
    let outputs: Vec<Column> = nodes
        .iter()
        .map(|&node| run(setup, column, place, &Column([node; COLUMN]), registers))
        .collect();
    let last = nodes.len().checked_sub(1)?;
    // for each turn and point the nodes between which it is, and whether it is a maximum
    let mut turns: Vec<[Option<(usize, usize, bool)>; COLUMN]> = Vec::new();
    for i in 0..COLUMN {
        let mut before: Option<(usize, bool)> = None;
        let mut count = 0;
        let mut flat = 0;
        for k in 0..last {
            let step = outputs[k + 1].0[i] - outputs[k].0[i];
            if !step.is_finite() {
                return None;
            }
            if step == 0.0 {
                // two nodes on either side of a turn can be as high; three cannot
                flat += 1;
                if flat > 1 {
                    return None;
                }
                continue;
            }
            flat = 0;
            let rises = step > 0.0;
            if let Some((from, rose)) = before
                && rose != rises
            {
                if count == MOST_TURNS {
                    return None;
                }
                if count == turns.len() {
                    turns.push([None; COLUMN]);
                }
                turns[count][i] = Some((from, k + 1, rose));
                count += 1;
            }
            before = Some((k, rises));
        }
        before?;
    }
    let bound = |at: Column, output: Column, p: Option<f64>| {
        let below = std::array::from_fn(|i| p.unwrap_or_else(|| cdf.at(at.0[i])[0]));
        [at, output, Column(below)]
    };
    let end = |k: usize| Column([nodes[k]; COLUMN]);
    let mut bounds = vec![bound(end(0), outputs[0].clone(), Some(0.0))];
    for turn in &turns {
        let (at, output) = turned(setup, column, place, nodes, turn, registers);
        let is_pole = |i: usize, &(from, to, _): &(usize, usize, bool)| {
            let beside: Vec<f64> = (from..=to).map(|k| outputs[k].0[i]).collect();
            let least = beside.iter().copied().fold(f64::INFINITY, f64::min);
            let most = beside.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let beyond = f64::max(output.0[i] - most, least - output.0[i]);
            beyond.is_nan() || beyond > POLE * (most - least)
        };
        if turn
            .iter()
            .enumerate()
            .any(|(i, value)| value.as_ref().is_some_and(|value| is_pole(i, value)))
        {
            return None;
        }
        let mut found = bound(at, output, None);
        for (i, turn) in turn.iter().enumerate() {
            if turn.is_none() {
                found[0].0[i] = nodes[last];
                found[1].0[i] = outputs[last].0[i];
                found[2].0[i] = 1.0;
            }
        }
        bounds.push(found);
    }
    bounds.push(bound(end(last), outputs[last].clone(), Some(1.0)));
    let last = bounds
        .windows(2)
        .map(|pair| Column(std::array::from_fn(|i| 0.5 * (pair[0][0].0[i] + pair[1][0].0[i]))));
    let last = last.collect();
    Some(ColumnPieces { bounds, last })
}

/// Where the output turns, and how high it is there, by golden sections.
fn turned(
    setup: &Setup,
    column: &[Column],
    place: usize,
    nodes: &[f64],
    turn: &[Option<(usize, usize, bool)>; COLUMN],
    registers: &mut [Column],
) -> (Column, Column) {
    let mut low = [nodes[0]; COLUMN];
    let mut high = low;
    let mut sign = [1.0; COLUMN];
    for (i, turn) in turn.iter().enumerate() {
        if let Some((from, to, maximum)) = *turn {
            (low[i], high[i]) = (nodes[from], nodes[to]);
            sign[i] = if maximum { 1.0 } else { -1.0 };
        }
    }
    let inner = |low: &[f64; COLUMN], high: &[f64; COLUMN], share: f64| {
        Column(std::array::from_fn(|i| low[i] + share * (high[i] - low[i])))
    };
    let (mut a, mut b) = (inner(&low, &high, GOLDEN), inner(&low, &high, 1.0 - GOLDEN));
    let mut at_a = run(setup, column, place, &a, registers);
    let mut at_b = run(setup, column, place, &b, registers);
    for _ in 0..SECTIONS {
        let mut next = Column::ZERO;
        let mut left = [false; COLUMN];
        for i in 0..COLUMN {
            left[i] = sign[i] * at_a.0[i] >= sign[i] * at_b.0[i];
            if left[i] {
                high[i] = b.0[i];
                (b.0[i], at_b.0[i]) = (a.0[i], at_a.0[i]);
                next.0[i] = low[i] + GOLDEN * (high[i] - low[i]);
            } else {
                low[i] = a.0[i];
                (a.0[i], at_a.0[i]) = (b.0[i], at_b.0[i]);
                next.0[i] = low[i] + (1.0 - GOLDEN) * (high[i] - low[i]);
            }
        }
        let at_next = run(setup, column, place, &next, registers);
        for (i, left) in left.into_iter().enumerate() {
            if left {
                (a.0[i], at_a.0[i]) = (next.0[i], at_next.0[i]);
            } else {
                (b.0[i], at_b.0[i]) = (next.0[i], at_next.0[i]);
            }
        }
    }
    for (i, sign) in sign.into_iter().enumerate() {
        if sign * at_b.0[i] > sign * at_a.0[i] {
            (a.0[i], at_a.0[i]) = (b.0[i], at_b.0[i]);
        }
    }
    (a, at_a)
}

impl Integrated<'_> {
    /// Distribution function and density of the output at `y`, over the first `columns` columns.
    pub(super) fn in_parts(
        &self,
        net: &Net,
        parts: &mut [ColumnPieces],
        registers: &mut [Column],
        y: f64,
        columns: usize,
    ) -> OfNet {
        let (mut sums, mut count) = ([0.0; 2], 0.0);
        for (column, parts) in net.columns.iter().zip(parts).take(columns) {
            let ColumnPieces { bounds, last } = parts;
            for (pair, last) in bounds.windows(2).zip(last) {
                if let [from, to] = pair {
                    let found = self.part(column, [from, to], last, registers, y);
                    sums[0] += found[0];
                    sums[1] += found[1];
                }
            }
            count += COLUMN as f64;
        }
        sums.map(|sum| sum / count)
    }

    /// The sums over the points of a column of one part's probability of outputs up to `y`, and of its
    /// density there.
    fn part(
        &self,
        column: &[Column],
        [from, to]: [&Bound; 2],
        last: &mut Column,
        registers: &mut [Column],
        y: f64,
    ) -> [f64; 2] {
        let mut sums = [0.0; 2];
        let mut inside = [false; COLUMN];
        for (i, inside) in inside.iter_mut().enumerate() {
            let (low, high) = (from[1].0[i].min(to[1].0[i]), from[1].0[i].max(to[1].0[i]));
            *inside = y > low && y < high;
            if y >= high && high > low {
                sums[0] += to[2].0[i] - from[2].0[i];
            }
        }
        if inside == [false; COLUMN] {
            return sums;
        }
        let (mut low, mut high) = (from[0].0, to[0].0);
        let rises: [bool; COLUMN] = std::array::from_fn(|i| to[1].0[i] > from[1].0[i]);
        let mut before = from[0].clone();
        let mut at_before = Column(std::array::from_fn(|i| from[1].0[i] - y));
        let mut at = Column::ZERO;
        for i in 0..COLUMN {
            let last = last.0[i];
            at.0[i] = if last > low[i] && last < high[i] { last } else { 0.5 * (low[i] + high[i]) };
            if !inside[i] {
                at.0[i] = from[0].0[i];
            }
        }
        let mut slope = [0.0; COLUMN];
        let mut open = inside;
        for step in 0..STEPS {
            let out = run(self.setup, column, self.place, &at, registers);
            for i in 0..COLUMN {
                if !open[i] {
                    continue;
                }
                let (x, above) = (at.0[i], out.0[i] - y);
                if (above > 0.0) == rises[i] {
                    high[i] = x;
                } else {
                    low[i] = x;
                }
                let secant = (above - at_before.0[i]) / (x - before.0[i]);
                if secant.is_finite()
                    && secant != 0.0
                    && (x - before.0[i]).abs() > 1e-9 * self.width
                {
                    slope[i] = secant;
                }
                let newton = x - above / slope[i];
                // halvings where the secant leaves what holds the place, and now and then
                let halved = 0.5 * (low[i] + high[i]);
                let within = newton > low[i] && newton < high[i];
                let next = if above == 0.0 {
                    x
                } else if within && step % 6 != 5 {
                    newton
                } else {
                    halved
                };
                let moved = (x - before.0[i]).abs();
                let is_short = (next - x).abs() <= ENDED * self.width;
                let shrank = above.abs() <= 0.5 * at_before.0[i].abs();
                let near = moved <= NEAR * self.width;
                let held = high[i] - low[i] <= ENDED * self.width;
                open[i] = !(is_short && (near && shrank || above == 0.0 || held));
                // a short step that did not bring the output nearer
                at.0[i] = if open[i] && is_short && near { halved } else { next };
                (before.0[i], at_before.0[i]) = (x, above);
            }
            if open == [false; COLUMN] {
                break;
            }
        }
        for i in 0..COLUMN {
            if !inside[i] {
                continue;
            }
            last.0[i] = at.0[i];
            let [p, density] = self.cdf.at(at.0[i]);
            sums[0] += if rises[i] { p - from[2].0[i] } else { to[2].0[i] - p };
            if slope[i] != 0.0 {
                sums[1] += density / slope[i].abs();
            }
        }
        sums
    }
}
