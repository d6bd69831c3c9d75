//! Where the gap lies: a scan over outputs and intervals of each condition.
//!
//! A chi-square test of all residuals says that something is wrong, not where; and the residuals of
//! one interval may be large only because shared inputs were fitted to the others. The statistic of a
//! region is therefore by how much the smallest sum of squares falls when the region's values are left
//! out, the shared inputs being free to explain the rest. Without a gap it follows the chi-square
//! distribution with as many degrees of freedom as the region has values, which makes regions of
//! different sizes comparable.
//!
//! There are many regions, and they overlap, so that the smallest of their probabilities is no
//! probability. How surprising the most surprising one is, is found by the same scan of simulated data
//! without a gap (a scan statistic with a Monte Carlo reference, as Kulldorff 1997, Communications in
//! Statistics: Theory and Methods 26, 1481, has it). Sums of products over the bins of a condition are
//! cumulated once, so that every interval costs a difference and a small Cholesky factorization.
//!
//! An interval that leaves out what does not depart by chance is always a little more surprising than
//! the whole. A region therefore counts with a weight: all outputs everywhere, each output everywhere and
//! the intervals of conditions have equal shares, so that a condition is named where it matters.

use gumption_engine::parallel;

use crate::integral::mixture::standard_normals;
use crate::setup::Setup;
use gumption_engine::distribution::StreamKey;
use gumption_engine::linalg::packed::{self, TOGETHER, triangle};
use gumption_engine::number::{COLUMN, Column, elementary, largest_first};
use gumption_engine::special;

/// Conditions with more levels than this are scanned in so many bins.
const MOST_LEVELS: usize = 40;

/// Simulated data sets without a gap.
const SIMULATED: usize = 512;

/// A region is named if data without a gap have one as surprising with at most this probability. It
/// is a little below 5 % because it is itself estimated from the simulated sets.
const NAMED: f64 = 0.04;

/// At most so many regions are named.
const MOST_REGIONS: usize = 4;

/// A region of the conditions that departs from the rest.
#[derive(Clone, Debug, PartialEq)]
pub struct GapRegion {
    /// Place of the output; `None` for all of them together.
    pub output: Option<usize>,
    /// Place of the condition and its least and largest value, in its unit; `None` for all of them.
    pub range: Option<(usize, [f64; 2])>,
    /// The probability that data without a gap have a region as surprising anywhere.
    pub p_value: f64,
    /// Share of the excess of squared residuals that lies here.
    pub share_of_gap: f64,
    /// Mean of the residuals over their standard uncertainties.
    pub mean_z: f64,
}

/// The regions of a design.
struct Design {
    values: usize,
    outputs: usize,
    /// Number of shared unknowns.
    shared: usize,
    /// For each value the products that region sums need: those of the basis with itself.
    basis: Vec<Vec<f64>>,
    axes: Vec<Axis>,
}

/// Values sorted into bins of a condition, for one output or all.
struct Axis {
    output: Option<usize>,
    condition: Option<usize>,
    /// Values in each bin.
    bins: Vec<Vec<usize>>,
    /// Least and largest condition of each bin.
    ranges: Vec<[f64; 2]>,
    /// Sums of products of the basis, cumulated over the bins.
    products: Vec<Vec<f64>>,
    counts: Vec<usize>,
}

/// Names the regions that depart. `variances` are those of the values without shared inputs.
pub fn regions(setup: &Setup<'_>, variances: &[f64], seed: u64) -> Vec<GapRegion> {
    let residuals = crate::data::by_rows(&setup.data.linear_residuals());
    let white: Vec<f64> = residuals.iter().zip(variances).map(|(r, v)| r / v.sqrt()).collect();
    let design = Design::new(setup, variances);
    let of_block = |block| -> Vec<f64> {
        let drawn = design.simulated(StreamKey::new(seed, "gap/where"), block as u64);
        let surprise = |best: Option<Best>| best.map_or(f64::NEG_INFINITY, |best| best.surprise);
        design.scan(&drawn, &[], &Axis::intervals).into_iter().map(surprise).collect()
    };
    let null = parallel::map(0..SIMULATED / COLUMN, of_block).concat();
    let mut found: Vec<GapRegion> = Vec::new();
    let mut taken: Vec<usize> = Vec::new();
    let total: f64 = white.iter().map(|z| z * z).sum::<f64>() - white.len() as f64;
    let best_of = |taken: &[usize], wanted: &dyn Fn(&Axis) -> Vec<(usize, usize)>| {
        design.scan(std::slice::from_ref(&white), taken, wanted).pop().flatten()
    };
    while found.len() < MOST_REGIONS {
        let Some(best) = best_of(&taken, &Axis::intervals) else { break };
        let beyond = null.iter().filter(|surprise| **surprise >= best.surprise).count();
        let by_rank = (1 + beyond) as f64 / (1 + null.len()) as f64;
        // beyond all simulated sets the bound of all regions together tells more
        let bound = elementary::exp(-best.surprise);
        let p_value = if beyond == 0 { by_rank.min(bound) } else { by_rank };
        if p_value > NAMED {
            break;
        }
        let named = design.those_that_depart(&best, |output| {
            let same = |axis: &Axis| {
                let is_it =
                    axis.output == Some(output) && axis.condition == best.condition(&design);
                if is_it { vec![(best.from, best.to)] } else { Vec::new() }
            };
            best_of(&taken, &same)
        });
        let is_everything = named.len() == 1 && named[0].is_everything(&design);
        for best in named {
            let axis = &design.axes[best.axis];
            let values: Vec<usize> =
                axis.bins[best.from..=best.to].iter().flatten().copied().collect();
            let own: f64 = values.iter().map(|&v| white[v] * white[v] - 1.0).sum();
            found.push(GapRegion {
                output: axis.output,
                range: axis.condition.filter(|_| !axis.is_whole(best.from, best.to)).map(
                    |condition| (condition, [axis.ranges[best.from][0], axis.ranges[best.to][1]]),
                ),
                p_value,
                share_of_gap: if total > 0.0 { (own / total).clamp(0.0, 1.0) } else { 0.0 },
                mean_z: values.iter().map(|&v| white[v]).sum::<f64>() / values.len().max(1) as f64,
            });
            taken.extend(values);
        }
        if is_everything {
            break;
        }
    }
    found
}

impl Axis {
    /// Whether an interval is all of it.
    fn is_whole(&self, from: usize, to: usize) -> bool {
        from == 0 && to + 1 == self.bins.len()
    }

    /// All its intervals.
    fn intervals(&self) -> Vec<(usize, usize)> {
        let bins = self.bins.len();
        (0..bins).flat_map(|from| (from..bins).map(move |to| (from, to))).collect()
    }
}

impl Best {
    fn condition(&self, design: &Design) -> Option<usize> {
        design.axes[self.axis].condition
    }

    /// Whether it is all outputs everywhere.
    fn is_everything(&self, design: &Design) -> bool {
        let axis = &design.axes[self.axis];
        axis.output.is_none() && axis.is_whole(self.from, self.to)
    }
}

/// The most surprising region of some data.
#[derive(Clone)]
struct Best {
    axis: usize,
    from: usize,
    to: usize,
    /// Minus the logarithm of the region's own probability, over its weight.
    surprise: f64,
}

impl Design {
    fn new(setup: &Setup<'_>, variances: &[f64]) -> Self {
        let count = setup.data.outputs.len();
        let values = setup.data.len();
        let basis: Vec<Vec<f64>> = setup
            .linear
            .raw_basis
            .iter()
            .map(|column| column.iter().zip(variances).map(|(c, v)| c / v.sqrt()).collect())
            .collect();
        let mut outputs: Vec<Option<usize>> = (0..count).map(Some).collect();
        if count > 1 {
            outputs.push(None);
        }
        let mut design =
            Self { values, outputs: count, shared: basis.len(), basis, axes: Vec::new() };
        for &output in &outputs {
            let mut any = false;
            for condition in 0..setup.case.described() {
                let bins = bins(setup, condition);
                if bins.len() < 2 {
                    continue;
                }
                any = true;
                design.add(output, Some(condition), bins, count);
            }
            if !any {
                let rows = (0..setup.data.rows()).collect();
                design.add(output, None, vec![(rows, [0.0, 0.0])], count);
            }
        }
        design
    }

    fn add(
        &mut self,
        output: Option<usize>,
        condition: Option<usize>,
        bins: Vec<(Vec<usize>, [f64; 2])>,
        outputs: usize,
    ) {
        let of_bin = |rows: &Vec<usize>| -> Vec<usize> {
            let of_row = |&row: &usize| {
                (0..outputs)
                    .filter(move |o| output.is_none_or(|own| own == *o))
                    .map(move |o| row * outputs + o)
            };
            rows.iter().flat_map(of_row).collect()
        };
        let ranges = bins.iter().map(|(_, range)| *range).collect();
        let bins: Vec<Vec<usize>> = bins.iter().map(|(rows, _)| of_bin(rows)).collect();
        let mut sums = vec![0.0; triangle(self.shared)];
        let mut count = 0;
        let (mut products, mut counts) = (vec![sums.clone()], vec![count]);
        for bin in &bins {
            for &value in bin {
                self.add_products(value, &mut sums);
            }
            products.push(sums.clone());
            count += bin.len();
            counts.push(count);
        }
        self.axes.push(Axis { output, condition, bins, ranges, products, counts });
    }

    /// The logarithm of the weight of the regions of an axis: of all of it, and of its other intervals.
    /// Those of all different regions sum to 1 at most.
    fn ln_weights(&self, axis: &Axis) -> [f64; 2] {
        let intervals: usize = self.axes.iter().map(|axis| triangle(axis.bins.len())).sum();
        let share = if self.outputs > 1 { 1.0 / 3.0 } else { 0.5 };
        let whole = match axis.output {
            Some(_) => share / self.outputs as f64,
            None => share,
        };
        [elementary::ln(whole), elementary::ln(share / intervals as f64)]
    }

    /// A region of all outputs as regions of those outputs that depart there by themselves, where
    /// others do not; `of_output` is the region of one output.
    fn those_that_depart(
        &self,
        best: &Best,
        of_output: impl Fn(usize) -> Option<Best>,
    ) -> Vec<Best> {
        let all = vec![best.clone()];
        if self.axes[best.axis].output.is_some() {
            return all;
        }
        let departs = |own: &Best| elementary::exp(-own.surprise) <= NAMED;
        let mut own: Vec<Best> = (0..self.outputs).filter_map(of_output).filter(departs).collect();
        if own.is_empty() || own.len() == self.outputs {
            return all;
        }
        largest_first(&mut own, |region| region.surprise);
        own
    }

    /// Whitened residuals of data without a gap.
    fn simulated(&self, key: StreamKey, block: u64) -> Vec<Vec<f64>> {
        let mut stream = key.block(block);
        let mut draws = vec![vec![0.0; self.values]; COLUMN];
        let mut column = Column::ZERO;
        for value in 0..self.values {
            standard_normals(&mut stream, &mut column);
            for (draw, normal) in draws.iter_mut().zip(&column.0) {
                draw[value] = *normal;
            }
        }
        for basis in &self.basis {
            standard_normals(&mut stream, &mut column);
            for (draw, normal) in draws.iter_mut().zip(&column.0) {
                for (value, factor) in draw.iter_mut().zip(basis) {
                    *value += normal * factor;
                }
            }
        }
        draws
    }

    /// For each of some whitened residuals the most surprising region of those that are `wanted`, as
    /// intervals of an axis; values that are `taken` count as left out already. What a region leaves of the
    /// basis is factored once for all of them.
    fn scan(
        &self,
        whites: &[Vec<f64>],
        taken: &[usize],
        wanted: &dyn Fn(&Axis) -> Vec<(usize, usize)>,
    ) -> Vec<Option<Best>> {
        let k = self.shared;
        let mut out = vec![false; self.values];
        for &value in taken {
            out[value] = true;
        }
        let mut inner = vec![0.0; triangle(k)];
        for i in 0..k {
            inner[triangle(i) + i] = 1.0;
        }
        for value in (0..self.values).filter(|&value| !out[value]) {
            self.add_products(value, &mut inner);
        }
        let all: Vec<ResidualSums> = whites.iter().map(|white| self.sums(white, &out)).collect();
        let mut explained = Explained::new(k, whites.len());
        explained.with(&inner, |n, place| all[n].cross[place]);
        let lengths: Vec<f64> =
            all.iter().zip(&explained.squares).map(|(all, square)| all.square - square).collect();
        let mut best: Vec<Option<Best>> = whites.iter().map(|_| None).collect();
        let mut rest_inner = vec![0.0; triangle(k)];
        for (number, axis) in self.axes.iter().enumerate() {
            let intervals = wanted(axis);
            if intervals.is_empty() {
                continue;
            }
            let [ln_whole, ln_interval] = self.ln_weights(axis);
            let (counts, products) = self.without(axis, &out);
            let cumulated: Vec<Vec<ResidualSums>> =
                whites.iter().map(|white| self.cumulated(axis, white, &out)).collect();
            for (from, to) in intervals {
                let count = counts[to + 1] - counts[from];
                // what is named once is not named again as a part of something larger
                let whole = axis.counts[to + 1] - axis.counts[from];
                if count == 0 || count < whole {
                    continue;
                }
                let ln_weight = if axis.is_whole(from, to) { ln_whole } else { ln_interval };
                for (rest, ((all, up), low)) in rest_inner
                    .iter_mut()
                    .zip(inner.iter().zip(&products[to + 1]).zip(&products[from]))
                {
                    *rest = all - (up - low);
                }
                explained.with(&rest_inner, |n, place| {
                    let [up, low] = [&cumulated[n][to + 1], &cumulated[n][from]];
                    all[n].cross[place] - (up.cross[place] - low.cross[place])
                });
                for (n, best) in best.iter_mut().enumerate() {
                    let [up, low] = [&cumulated[n][to + 1], &cumulated[n][from]];
                    let square = all[n].square - (up.square - low.square);
                    let gone = (lengths[n] - (square - explained.squares[n])).max(0.0);
                    // a cheap bound spares most regions the tail of the chi-square distribution
                    let bounded = count > 1
                        && best.as_ref().is_some_and(|best| 0.5 * gone + ln_weight < best.surprise);
                    if bounded {
                        continue;
                    }
                    let surprise =
                        ln_weight - special::gamma::ln_sf(0.5 * gone, 0.5 * count as f64);
                    if best.as_ref().is_none_or(|best| surprise > best.surprise) {
                        *best = Some(Best { axis: number, from, to, surprise });
                    }
                }
            }
        }
        best
    }

    /// Adds to a triangle the products of the basis with itself at a value.
    fn add_products(&self, value: usize, sums: &mut [f64]) {
        for (i, column) in self.basis.iter().enumerate().filter(|(_, c)| c[value] != 0.0) {
            for (sum, other) in sums[triangle(i)..].iter_mut().zip(&self.basis[..=i]) {
                *sum += column[value] * other[value];
            }
        }
    }

    /// The sums of residuals over all values that are in.
    fn sums(&self, white: &[f64], out: &[bool]) -> ResidualSums {
        let mut sums = ResidualSums { square: 0.0, cross: vec![0.0; self.shared] };
        for value in (0..self.values).filter(|&value| !out[value]) {
            self.add_value(&mut sums, white, value);
        }
        sums
    }

    /// The same cumulated over the bins of an axis.
    fn cumulated(&self, axis: &Axis, white: &[f64], out: &[bool]) -> Vec<ResidualSums> {
        let mut sums = ResidualSums { square: 0.0, cross: vec![0.0; self.shared] };
        let mut cumulated = vec![sums.clone()];
        for bin in &axis.bins {
            for &value in bin.iter().filter(|&&value| !out[value]) {
                self.add_value(&mut sums, white, value);
            }
            cumulated.push(sums.clone());
        }
        cumulated
    }

    fn add_value(&self, sums: &mut ResidualSums, white: &[f64], value: usize) {
        sums.square += white[value] * white[value];
        for (sum, column) in sums.cross.iter_mut().zip(&self.basis) {
            *sum += column[value] * white[value];
        }
    }

    /// The counts and products of an axis without the values that are out.
    fn without(&self, axis: &Axis, out: &[bool]) -> (Vec<usize>, Vec<Vec<f64>>) {
        let (mut counts, mut products) = (axis.counts.clone(), axis.products.clone());
        let (mut less, mut fewer) = (vec![0.0; triangle(self.shared)], 0);
        for (b, bin) in axis.bins.iter().enumerate() {
            for &value in bin.iter().filter(|&&value| out[value]) {
                fewer += 1;
                self.add_products(value, &mut less);
            }
            counts[b + 1] -= fewer;
            for (sum, less) in products[b + 1].iter_mut().zip(&less) {
                *sum -= less;
            }
        }
        (counts, products)
    }
}

/// Sums over values.
#[derive(Clone)]
struct ResidualSums {
    /// Of the squares of the residuals.
    square: f64,
    /// Of the products of the basis with the residuals.
    cross: Vec<f64>,
}

/// The part of squared residuals that shared unknowns explain, for many residuals.
struct Explained {
    residuals: usize,
    root: Vec<f64>,
    vectors: Vec<f64>,
    squares: Vec<f64>,
}

impl Explained {
    fn new(shared: usize, residuals: usize) -> Self {
        let count = residuals.next_multiple_of(TOGETHER);
        let (vectors, squares) = (vec![0.0; count * shared], vec![0.0; count]);
        Self { residuals, root: vec![0.0; triangle(shared)], vectors, squares }
    }

    /// With these products of the basis with itself; `cross` are those with the residuals, by their
    /// number and the place in the basis. Groups are filled up with the last ones.
    fn with(&mut self, inner: &[f64], cross: impl Fn(usize, usize) -> f64) {
        let Self { residuals, root, vectors, squares } = self;
        root.copy_from_slice(inner);
        packed::cholesky_of_definite(root);
        let shared = vectors.len() / squares.len().max(1);
        for (group, vectors) in vectors.chunks_exact_mut((shared * TOGETHER).max(1)).enumerate() {
            for (place, entries) in vectors.chunks_exact_mut(TOGETHER).enumerate() {
                for (n, entry) in entries.iter_mut().enumerate() {
                    *entry = cross((group * TOGETHER + n).min(*residuals - 1), place);
                }
            }
        }
        packed::solve_many(root, vectors, squares);
    }
}

/// The rows at each level of a condition, in order; many levels are put together.
fn bins(setup: &Setup<'_>, condition: usize) -> Vec<(Vec<usize>, [f64; 2])> {
    let value = |row: usize| setup.row(row).conditions[condition];
    let mut levels: Vec<(Vec<usize>, [f64; 2])> = Vec::new();
    for row in setup.rows_along(condition) {
        match levels.last_mut() {
            Some((level, range)) if range[1] == value(row) => level.push(row),
            _ => levels.push((vec![row], [value(row); 2])),
        }
    }
    if levels.len() <= MOST_LEVELS {
        return levels;
    }
    let mut joined: Vec<(Vec<usize>, [f64; 2])> = Vec::new();
    let count = levels.len();
    for (number, (rows, range)) in levels.into_iter().enumerate() {
        let bin = number * MOST_LEVELS / count;
        if joined.len() <= bin {
            joined.push((rows, range));
        } else if let Some((all, whole)) = joined.last_mut() {
            all.extend(rows);
            whole[1] = range[1];
        }
    }
    joined
}
