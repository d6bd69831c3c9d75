//! Modes of the posterior of a hypothesis: damped Fisher scoring from many starts side by side.

use nalgebra::{DMatrix, DVector};

use crate::covariance::Covariance;
use crate::latent::EDGE;
use crate::likelihood::{Likelihood, Visitor};
use crate::logarithm::HALF_LN_TWO_PI;
use gumption_engine::linalg::packed::{self, triangle};
use gumption_engine::number::{COLUMN, CodePath, Column, Kernel, elementary, smallest_first};

/// The step of differences, in standard normal scores: the truncation error is of its order and the
/// rounding error about 1e-11 over it.
const STEP: f64 = 1e-5;

/// Normal scores are kept within this of 0; the prior probability beyond is below 1e-15.
pub(crate) const FARTHEST: f64 = 8.0;

const MOST_STEPS: usize = 30;

/// A walker from which the cost would fall by less is where it was to come.
const NEGLIGIBLE: f64 = 1e-4;

/// Modes whose density is lower than the best's by this factor's logarithm are left out.
const DEPTH: f64 = 14.0;

/// A local maximum of the posterior density.
#[derive(Clone, Debug)]
pub struct Mode {
    /// The scores.
    pub scores: Vec<f64>,
    /// Minus the logarithm of prior density times likelihood, without the prior's constant; here the
    /// prior of every score is taken as normal.
    pub(crate) cost: f64,
    /// Expected information of data and prior together.
    pub(crate) information: DMatrix<f64>,
}

/// A mode that is better than the one in whose neighbourhood it is by more than this is another one:
/// neighbourhoods are told from curvatures, which say little where the density has edges.
const ELSEWHERE: f64 = 0.5;

/// A mode that is found again counts as better from this gain on.
pub(crate) const GAIN: f64 = 1e-3;

impl Mode {
    fn of(scores: Vec<f64>, local: Local) -> Self {
        Self { scores, cost: local.cost, information: local.information }
    }

    /// Whether another point is within the neighbourhood of this mode.
    fn is_near(&self, other: &Self) -> bool {
        near(&self.information, &self.scores, &other.scores)
    }

    /// The logarithm of the likelihood there.
    pub fn ln_likelihood(&self) -> f64 {
        -self.cost + 0.5 * self.scores.iter().map(|score| score * score).sum::<f64>()
    }

    /// The logarithm of the evidence in its neighbourhood, in the Gaussian approximation.
    pub(crate) fn ln_evidence(&self) -> f64 {
        -self.cost - 0.5 * ln_det(self.information.clone())
    }
}

/// The logarithm of the determinant of an information: the prior adds the identity, so that it is
/// positive definite.
fn ln_det(information: DMatrix<f64>) -> f64 {
    let mut root = packed::of_matrix(&information);
    packed::cholesky_of_definite(&mut root);
    2.0 * packed::ln_diagonal(&root)
}

/// The cost at a point with its gradient and information.
#[derive(Clone, Debug)]
struct Local {
    cost: f64,
    gradient: DVector<f64>,
    information: DMatrix<f64>,
}

struct Walker {
    scores: Vec<f64>,
    local: Local,
    /// The score that stays as it is, if any.
    held: Option<usize>,
    damping: f64,
    done: bool,
}

/// The modes that are reached from `starts`, best first, at most `most` of them.
pub(crate) fn modes(likelihood: &Likelihood<'_>, starts: &[Vec<f64>], most: usize) -> Vec<Mode> {
    let starts = starts.iter().map(|scores| (None, scores.clone())).collect();
    let mut walkers = Walker::at(likelihood, starts);
    let farthest = farthest(likelihood);
    for step in 0..MOST_STEPS {
        // the laggards are given up: they end where a better walker is, or in a worse mode
        if step == 8 || step == 16 {
            let best = walkers.iter().map(|walker| walker.local.cost).fold(f64::INFINITY, f64::min);
            let slack: f64 = if step == 8 { 60.0 } else { 25.0 };
            walkers.retain(|walker| walker.local.cost < best + slack.max(0.3 * best.abs().sqrt()));
            merge(&mut walkers);
        }
        if !advance(likelihood, &mut walkers, &farthest) {
            break;
        }
    }
    merge(&mut walkers);
    let best = walkers.first().map_or(f64::INFINITY, |walker| walker.local.cost);
    walkers.retain(|walker| walker.local.cost < best + DEPTH);
    walkers.truncate(most);
    walkers.into_iter().map(Walker::mode).collect()
}

/// Whether a point is in the neighbourhood of a mode that is known and no worse.
pub(crate) fn is_known(known: &[Mode], mode: &Mode) -> bool {
    known.iter().any(|other| other.is_near(mode) && other.cost <= mode.cost + ELSEWHERE)
}

/// Adds modes to those that are known, best first and at most `most` of them; whether there was any
/// among them that is not where a known one is.
pub(crate) fn join(known: &mut Vec<Mode>, found: Vec<Mode>, most: usize) -> bool {
    let mut new = vec![false; known.len()];
    for mode in found {
        // a mode that is known better takes the other's position
        match known.iter().position(|other| other.is_near(&mode) || mode.is_near(other)) {
            Some(n) if mode.cost < known[n].cost - GAIN => {
                new[n] |= mode.cost < known[n].cost - ELSEWHERE;
                known[n] = mode;
            }
            Some(_) => {}
            None => {
                known.push(mode);
                new.push(true);
            }
        }
    }
    let best = known.iter().map(|mode| mode.cost).fold(f64::INFINITY, f64::min);
    let mut order: Vec<usize> = (0..known.len()).collect();
    smallest_first(&mut order, |&a| known[a].cost);
    order.retain(|&n| known[n].cost < best + DEPTH);
    order.truncate(most);
    let any = order.iter().any(|&n| std::mem::take(&mut new[n]));
    *known = order.iter().map(|&n| known[n].clone()).collect();
    any
}

/// The best points with one score held at its value in the start; the held score with each.
pub(crate) fn profile(
    likelihood: &Likelihood<'_>,
    starts: &[(usize, Vec<f64>)],
) -> Vec<(usize, Mode)> {
    let farthest = farthest(likelihood);
    let within = |scores: &Vec<f64>| -> Vec<f64> {
        scores.iter().zip(&farthest).map(|(score, most)| score.clamp(-most, *most)).collect()
    };
    let starts = starts.iter().map(|(held, scores)| (Some(*held), within(scores))).collect();
    let mut walkers = Walker::at(likelihood, starts);
    for _ in 0..MOST_STEPS {
        if !advance(likelihood, &mut walkers, &farthest) {
            break;
        }
    }
    walkers.into_iter().filter_map(|walker| Some((walker.held?, walker.mode()))).collect()
}

/// Points as modes, though they may be none.
pub(crate) fn at_points(likelihood: &Likelihood<'_>, points: &[Vec<f64>]) -> Vec<Mode> {
    let mode = |(local, scores): (Local, &Vec<f64>)| Mode::of(scores.clone(), local);
    locals(likelihood, points).into_iter().zip(points).map(mode).collect()
}

/// Information without what it says about one score, which is held.
pub(crate) fn freed(information: &DMatrix<f64>, held: usize) -> DMatrix<f64> {
    let mut freed = information.clone();
    freed.row_mut(held).fill(0.0);
    freed.column_mut(held).fill(0.0);
    freed[(held, held)] = 1.0;
    freed
}

/// How far from 0 each score is looked for.
pub(crate) fn farthest(likelihood: &Likelihood<'_>) -> Vec<f64> {
    likelihood.bounded().iter().map(|b| if *b { EDGE } else { FARTHEST }).collect()
}

/// One step of all walkers that are not done; whether there were any.
fn advance(likelihood: &Likelihood<'_>, walkers: &mut [Walker], farthest: &[f64]) -> bool {
    let mut active = Vec::new();
    let mut proposals = Vec::new();
    for walker in walkers.iter_mut().filter(|walker| !walker.done) {
        match walker.proposal(farthest) {
            Some(proposal) => {
                active.push(walker);
                proposals.push(proposal);
            }
            None => walker.done = true,
        }
    }
    let locals = locals(likelihood, &proposals);
    for ((walker, proposal), local) in active.iter_mut().zip(&proposals).zip(locals) {
        walker.decide(proposal, local);
    }
    !proposals.is_empty()
}

/// Sorts by cost and drops walkers that stand where a better one does.
fn merge(walkers: &mut Vec<Walker>) {
    smallest_first(walkers, |a| a.local.cost);
    let mut kept: Vec<Walker> = Vec::new();
    for walker in walkers.drain(..) {
        let same =
            kept.iter().any(|other| near(&other.local.information, &other.scores, &walker.scores));
        if !same {
            kept.push(walker);
        }
    }
    *walkers = kept;
}

/// Whether two points are within less than a standard deviation of each other.
fn near(information: &DMatrix<f64>, here: &[f64], there: &[f64]) -> bool {
    let difference = DVector::from_iterator(here.len(), here.iter().zip(there).map(|(a, b)| a - b));
    (information * &difference).dot(&difference) < 0.5 * here.len() as f64
}

impl Walker {
    /// Walkers at starts where the likelihood is finite, with the scores that are held.
    fn at(likelihood: &Likelihood<'_>, starts: Vec<(Option<usize>, Vec<f64>)>) -> Vec<Self> {
        let (held, points): (Vec<_>, Vec<_>) = starts.into_iter().unzip();
        let locals = locals(likelihood, &points);
        points
            .into_iter()
            .zip(held)
            .zip(locals)
            .filter(|(_, local)| local.cost.is_finite())
            .map(|((scores, held), local)| Self { scores, local, held, damping: 1e-2, done: false })
            .collect()
    }

    fn mode(self) -> Mode {
        Mode::of(self.scores, self.local)
    }

    /// Where to go next; `None` where nothing is to be gained.
    fn proposal(&self, farthest: &[f64]) -> Option<Vec<f64>> {
        let Local { gradient, information, .. } = &self.local;
        let mut gradient = gradient.clone();
        let mut damped = information.clone();
        for (i, (score, most)) in self.scores.iter().zip(farthest).enumerate() {
            // a score at an edge that it would cross stays, and the others move without it
            let is_at_edge = score.abs() >= *most && score * gradient[i] < 0.0;
            if is_at_edge || self.held == Some(i) {
                gradient[i] = 0.0;
                damped = freed(&damped, i);
            }
        }
        for i in 0..damped.nrows() {
            damped[(i, i)] *= 1.0 + self.damping;
        }
        let step = damped.cholesky().map(|root| root.solve(&gradient));
        let step = step.unwrap_or_else(|| gradient.clone());
        // as the damping is, the decrease of the cost would be half of this or more
        let is_there = step.dot(&gradient) < NEGLIGIBLE && self.damping < 1.0;
        let to = |((score, step), most): ((&f64, &f64), &f64)| (score - step).clamp(-most, *most);
        (!is_there).then(|| self.scores.iter().zip(step.iter()).zip(farthest).map(to).collect())
    }

    fn decide(&mut self, proposal: &[f64], local: Local) {
        if local.cost < self.local.cost {
            self.done = self.local.cost - local.cost < 1e-3 && self.damping < 1.0;
            self.scores.clear();
            self.scores.extend_from_slice(proposal);
            self.local = local;
            self.damping = (self.damping * 0.2).max(1e-9);
        } else {
            self.damping *= 8.0;
            self.done = self.damping > 1e6;
        }
    }
}

/// Cost, gradient and information at many points.
fn locals(likelihood: &Likelihood<'_>, points: &[Vec<f64>]) -> Vec<Local> {
    let unknowns = likelihood.unknowns();
    let together = (COLUMN / (unknowns + 1)).max(1);
    let mut locals = Vec::with_capacity(points.len());
    for points in points.chunks(together) {
        let count = points.len();
        let mut scores = vec![Column::ZERO; unknowns];
        for (i, column) in scores.iter_mut().enumerate() {
            for group in column.0.chunks_exact_mut(count).take(unknowns + 1) {
                group.iter_mut().zip(points).for_each(|(score, point)| *score = point[i]);
            }
            column.0[(i + 1) * count..][..count].iter_mut().for_each(|score| *score += STEP);
        }
        let mut moments = ColumnMoments::new(likelihood, count);
        likelihood.visit(&scores, count * (unknowns + 1), &mut moments);
        let local = |(number, point): (usize, &Vec<f64>)| {
            moments.local(number, likelihood.covariance, likelihood.data.len(), point)
        };
        locals.extend(points.iter().enumerate().map(local));
    }
    locals
}

/// Points whose sums are added up side by side.
const SIDE_BY_SIDE: usize = 8;

/// A number for each of so many points.
type Points = [f64; SIDE_BY_SIDE];

/// Sums for the points of one column. Its lanes are the points themselves, then all of them with the
/// first score moved, and so on; what belongs to one point stands in the same lane of `Points`, in the
/// block of sums of its number.
struct ColumnMoments<'l> {
    basis: &'l [Vec<f64>],
    fitted: bool,
    points: usize,
    /// The scores that move the residuals, and those that move their variances.
    moving: Vec<usize>,
    noise: Vec<usize>,
    blocks: Vec<Block>,
}

/// Sums for [`SIDE_BY_SIDE`] points.
struct Block {
    square: Points,
    half_ln_variances: Points,
    gradient: Vec<Points>,
    information: Vec<Points>,
    /// Products of the basis with the residual, then with its derivatives.
    products: Vec<Points>,
    inner: Vec<Points>,
    /// For each score of `noise` what the basis changes of its gradient.
    shares: Vec<NoiseShare>,
    /// Of the value that is being added, by score.
    slopes: Vec<Points>,
}

/// Sums of products of the basis with the slopes of the logarithm of the variance: what the basis
/// explains of a residual is not noise.
#[derive(Clone)]
struct NoiseShare {
    /// Of the basis with the residual.
    products: Vec<Points>,
    inner: Vec<Points>,
    /// Of the squared slopes.
    inner_squared: Vec<Points>,
}

/// The lanes of a column, with room to read a whole block from any of them.
type Lanes = [f64; COLUMN + SIDE_BY_SIDE];

impl<'l> ColumnMoments<'l> {
    fn new(likelihood: &'l Likelihood<'_>, points: usize) -> Self {
        let unknowns = likelihood.unknowns();
        let basis = &likelihood.covariance.basis;
        let fitted = likelihood.covariance.fitted;
        let is_noise = |i: &usize| likelihood.roles[*i].is_noise();
        let (noise, moving): (Vec<usize>, Vec<usize>) = (0..unknowns).partition(is_noise);
        let zeros = |count: usize| vec![[0.0; SIDE_BY_SIDE]; count];
        let block = || Block {
            square: [0.0; SIDE_BY_SIDE],
            half_ln_variances: [0.0; SIDE_BY_SIDE],
            gradient: zeros(unknowns),
            information: zeros(triangle(unknowns)),
            products: zeros(basis.len() * (unknowns + 1)),
            inner: zeros(if fitted { triangle(basis.len()) } else { 0 }),
            shares: vec![
                NoiseShare {
                    products: zeros(basis.len()),
                    inner: zeros(triangle(basis.len())),
                    inner_squared: zeros(triangle(basis.len())),
                };
                if fitted { noise.len() } else { 0 }
            ],
            slopes: zeros(unknowns),
        };
        let blocks = (0..points.div_ceil(SIDE_BY_SIDE)).map(|_| block()).collect();
        Self { basis, fitted, points, moving, noise, blocks }
    }

    /// What the sums say of a point.
    fn local(&self, number: usize, covariance: &Covariance, values: usize, point: &[f64]) -> Local {
        let unknowns = point.len();
        let k = covariance.basis.len();
        let block = &self.blocks[number / SIDE_BY_SIDE];
        let lane = number % SIDE_BY_SIDE;
        let mut square = block.square[lane];
        let mut half_ln_det = covariance.half_ln_det + block.half_ln_variances[lane];
        let mut gradient = DVector::from_fn(unknowns, |i, _| block.gradient[i][lane]);
        let mut information = DMatrix::from_fn(unknowns, unknowns, |i, j| {
            block.information[triangle(i.max(j)) + i.min(j)][lane]
        });
        if k > 0 {
            let inner = if covariance.fitted {
                let mut root: Vec<f64> = block.inner.iter().map(|sums| sums[lane]).collect();
                for i in 0..k {
                    root[triangle(i) + i] += 1.0;
                }
                packed::cholesky_of_definite(&mut root);
                half_ln_det += packed::ln_diagonal(&root);
                let shares: Vec<[f64; 2]> = block.noise_shares(&root, lane, &self.noise).collect();
                for (&t, [gradient_less, share]) in self.noise.iter().zip(&shares) {
                    gradient[t] -= gradient_less;
                    for (&u, [_, other]) in self.noise.iter().zip(&shares) {
                        information[(t, u)] *= (share * other).sqrt();
                    }
                }
                packed::to_matrix(&root)
            } else {
                packed::to_matrix(&covariance.inner)
            };
            let products = DMatrix::from_fn(k, unknowns + 1, |i, j| {
                block.products[i * (unknowns + 1) + j][lane]
            });
            if let Some(y) = inner.solve_lower_triangular(&products) {
                let first = y.column(0);
                let others = y.columns(1, unknowns);
                square -= first.norm_squared();
                gradient -= others.transpose() * first;
                information -= others.transpose() * others;
            }
        }
        let prior: f64 = point.iter().map(|score| score * score).sum();
        for (i, score) in point.iter().enumerate() {
            gradient[i] += score;
            information[(i, i)] += 1.0;
        }
        let cost = 0.5 * (square + prior) + half_ln_det + values as f64 * HALF_LN_TWO_PI;
        let cost = if cost.is_finite() && gradient.iter().all(|g| g.is_finite()) {
            cost
        } else {
            f64::INFINITY
        };
        Local { cost, gradient, information }
    }
}

#[inline(always)]
fn lanes(column: &Column) -> Lanes {
    let mut lanes = [0.0; COLUMN + SIDE_BY_SIDE];
    lanes[..COLUMN].copy_from_slice(&column.0);
    lanes
}

#[inline(always)]
fn block_at(lanes: &Lanes, first: usize) -> Points {
    std::array::from_fn(|n| lanes[first + n])
}

#[inline(always)]
fn each(of: impl Fn(usize) -> f64) -> Points {
    std::array::from_fn(of)
}

/// Adds products, point by point.
#[inline(always)]
fn add_product(sums: &mut Points, a: &Points, b: &Points) {
    for n in 0..SIDE_BY_SIDE {
        sums[n] += a[n] * b[n];
    }
}

impl Block {
    /// For each score of `noise` what its gradient is less, and the share of its information that is
    /// left, with the root of the basis' inner products at a point: with w for what the basis leaves of
    /// the residual and h for its share in each value, half the sum of slope times 1 - h - w^2 in place
    /// of 1 - r^2, and of squared slopes times 1 - h in place of 1. Slopes may have either sign, as of a
    /// power of sizes about their mean.
    fn noise_shares(
        &self,
        root: &[f64],
        lane: usize,
        noise: &[usize],
    ) -> impl Iterator<Item = [f64; 2]> {
        let k = packed::rows(root).len();
        let moved = self.products.len() / k;
        let mut sizes: Vec<f64> = (0..k).map(|i| self.products[i * moved][lane]).collect();
        packed::solve(root, &mut sizes);
        packed::solve_transposed(root, &mut sizes);
        let mut inverse_root = root.to_vec();
        packed::invert(&mut inverse_root);
        let mut inverse = vec![0.0; root.len()];
        for row in packed::rows(&inverse_root) {
            for (i, own) in row.iter().enumerate() {
                for (j, other) in row[..=i].iter().enumerate() {
                    inverse[triangle(i) + j] += own * other;
                }
            }
        }
        // half of the sums of the squared slopes
        let squares = noise.iter().map(|&t| 2.0 * self.information[triangle(t) + t][lane]);
        self.shares.iter().zip(squares.collect::<Vec<_>>()).map(move |(share, squares)| {
            let (mut explained, mut less, mut explained_squares) = (0.0, 0.0, 0.0);
            for i in 0..k {
                less += 2.0 * sizes[i] * share.products[i][lane];
                for j in 0..=i {
                    let place = triangle(i) + j;
                    // the other half of the symmetric matrices is the same
                    let halves = if i == j { 1.0 } else { 2.0 };
                    let inner = share.inner[place][lane];
                    explained += halves * inverse[place] * inner;
                    explained_squares += halves * inverse[place] * share.inner_squared[place][lane];
                    less -= halves * sizes[i] * sizes[j] * inner;
                }
            }
            let left =
                if squares > 0.0 { (1.0 - explained_squares / squares).max(0.0) } else { 1.0 };
            [0.5 * (explained - less), left]
        })
    }

    /// Adds what one value gives to the gradient, a multiple of its slopes by these scores, and to the
    /// information, a multiple of their products.
    #[inline(always)]
    fn add_slopes(&mut self, scores: &[usize], first: &Points, second: f64) {
        for (number, &t) in scores.iter().enumerate() {
            let slope = self.slopes[t];
            add_product(&mut self.gradient[t], first, &slope);
            let slope = slope.map(|slope| second * slope);
            for &u in &scores[..=number] {
                add_product(&mut self.information[triangle(t) + u], &slope, &self.slopes[u]);
            }
        }
    }
}

impl Visitor for ColumnMoments<'_> {
    fn row(&mut self, path: CodePath, row: usize, residuals: &[Column], ln_variances: &[Column]) {
        path.run(RowOfMoments { moments: self, row, residuals, ln_variances });
    }
}

struct RowOfMoments<'a, 'c> {
    moments: &'a mut ColumnMoments<'c>,
    row: usize,
    residuals: &'a [Column],
    ln_variances: &'a [Column],
}

impl Kernel for RowOfMoments<'_, '_> {
    type Output = ();

    // programs take most of the time
    const WIDEST: bool = false;

    #[inline(always)]
    fn run(self) {
        let Self { moments, row, residuals, ln_variances } = self;
        let ColumnMoments { basis, fitted, points, moving, noise, blocks } = moments;
        let outputs = residuals.len();
        let unknowns = moving.len() + noise.len();
        for (output, (residual, ln_variance)) in residuals.iter().zip(ln_variances).enumerate() {
            let residual = lanes(residual);
            let ln_variance = lanes(ln_variance);
            let place = row * outputs + output;
            for (number, block) in blocks.iter_mut().enumerate() {
                let first = number * SIDE_BY_SIDE;
                let r = block_at(&residual, first);
                add_product(&mut block.square, &r, &r);
                for &t in &*moving {
                    let moved = block_at(&residual, first + (t + 1) * *points);
                    block.slopes[t] = each(|n| (moved[n] - r[n]) / STEP);
                }
                block.add_slopes(moving, &r, 1.0);
                let ln = block_at(&ln_variance, first);
                if *fitted {
                    for (sum, ln) in block.half_ln_variances.iter_mut().zip(&ln) {
                        *sum += 0.5 * ln;
                    }
                    for &t in &*noise {
                        let moved = block_at(&ln_variance, first + (t + 1) * *points);
                        block.slopes[t] = each(|n| (moved[n] - ln[n]) / STEP);
                    }
                    let excess = each(|n| 0.5 * (1.0 - r[n] * r[n]));
                    block.add_slopes(noise, &excess, 0.5);
                }
                if basis.is_empty() {
                    continue;
                }
                let root = if *fitted {
                    each(|n| elementary::exp(-0.5 * ln[n]))
                } else {
                    [1.0; SIDE_BY_SIDE]
                };
                for (i, column) in basis.iter().enumerate() {
                    let own = column[place];
                    if own == 0.0 {
                        continue;
                    }
                    let factor = each(|n| own * root[n]);
                    let products = &mut block.products[i * (unknowns + 1)..];
                    add_product(&mut products[0], &factor, &r);
                    for &t in &*moving {
                        add_product(&mut products[1 + t], &factor, &block.slopes[t]);
                    }
                    if *fitted {
                        for (&t, share) in noise.iter().zip(&mut block.shares) {
                            let factor = each(|n| factor[n] * block.slopes[t][n]);
                            add_product(&mut share.products[i], &factor, &r);
                        }
                        let factor = each(|n| factor[n] * root[n]);
                        for (j, other) in basis.iter().enumerate().take(i + 1) {
                            if other[place] == 0.0 {
                                continue;
                            }
                            let product = each(|n| factor[n] * other[place]);
                            let sums = &mut block.inner[triangle(i) + j];
                            sums.iter_mut().zip(product).for_each(|(sum, product)| *sum += product);
                            for (&t, share) in noise.iter().zip(&mut block.shares) {
                                let (slope, place) = (&block.slopes[t], triangle(i) + j);
                                add_product(&mut share.inner[place], &product, slope);
                                let squared = slope.map(|slope| slope * slope);
                                add_product(&mut share.inner_squared[place], &product, &squared);
                            }
                        }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::locals;
    use crate::noise::noise_model::NoiseModel;
    use crate::noise::shared_noise::{Setting, SharedNoise};
    use crate::setup::Setup;
    use crate::tests::cases::{candidate, case, normal, observed};
    use gumption_engine::task::Sharing;

    /// With an estimated noise, and errors that the rows of a setting share beside it.
    #[test]
    fn gradients_are_those_of_differences() {
        let off = |n: usize| [0.3, 1.5, -0.2, 0.1, -1.2, 0.1, 0.7][n % 7] + 0.2 * (n / 2) as f64;
        let values: Vec<f64> = (0..12).map(|n| 1.0 + 0.5 * n as f64 + off(n)).collect();
        let mut case = case(
            normal(1.0, 0.3),
            Sharing::All,
            &[("y", "a + 0.5*x")],
            vec![observed(&values, None)],
            vec![candidate("offset", "o", normal(0.0, 0.4), &[("y", "y + o")])],
        );
        for (n, row) in case.task.rows.iter_mut().enumerate() {
            row.conditions = vec![(n / 2) as f64];
        }
        let setup = Setup::new(&case);
        let shared = SharedNoise {
            setting: Setting::All,
            among: 1,
            ratios: vec![2.0],
            within: vec![Some(0.4)],
        };
        let setup = setup.with_noise(NoiseModel::with_shared(shared));
        let likelihood = setup.likelihood(&[0]);
        let scores = vec![0.4; likelihood.unknowns()];
        assert!(likelihood.roles.iter().any(crate::latent::Role::is_noise));
        assert!(likelihood.covariance.basis.len() >= 6);
        let at = |scores: &[f64]| locals(&likelihood, &[scores.to_vec()]).remove(0);
        let local = at(&scores);
        for i in 0..scores.len() {
            let cost = |step: f64| {
                let mut moved = scores.clone();
                moved[i] += step;
                at(&moved).cost
            };
            let slope = (cost(1e-4) - cost(-1e-4)) / 2e-4;
            // slopes inside are differences to one side with steps of 1e-5
            let miss = (local.gradient[i] - slope).abs();
            assert!(miss < 1e-3 * slope.abs().max(1.0), "{i}: {} {slope}", local.gradient[i]);
        }
    }
}
