//! The evidence of a discrepancy where the noise is estimated from the data as well.
//!
//! With known noise a discrepancy that is a Gaussian process has its evidence in closed form. With
//! unknown noise there is one more integral, over the logarithms of the standard deviations, for each
//! of some hundred forms and each of fourteen amplitudes; sampling all of them would take most of the
//! time of a diagnosis. But a standard deviation that is estimated from many residuals is nearly
//! lognormal, so that Laplace's method is enough: the most probable noise by damped Fisher scoring,
//! and there the determinant of the expected information (Tierney and Kadane 1986, Journal of the
//! American Statistical Association 81, 82). The test compares it with a grid.
//!
//! Repeats that share conditions and variance enter as their mean and the sum of squares about it,
//! which are sufficient; the matrices then have a row for each condition and not for each value. A
//! discrepancy may imitate noise, so its size is counted in units of the noise: amplitude and noise
//! move together, and the gradient has a part for that.
//!
//! A form whose evidence at a few amplitudes is far below the leading hypothesis is left at these: its
//! weight would be lost in rounding.

use std::ops::Range;
use std::sync::Arc;

use gumption_engine::parallel;
use nalgebra::{DMatrix, DVector};

use super::form::Form;
use super::{AMPLITUDES, Discrepancy, Unexplained, Weighted, weigh};
use crate::latent::{EDGE, Role, ln_prior};
use crate::logarithm::HALF_LN_TWO_PI;
use crate::setup::Setup;
use gumption_engine::linalg::dot;
use gumption_engine::linalg::packed::{self, TOGETHER, triangle};
use gumption_engine::number::elementary;

/// Points of the integral over the logarithm of the amplitude.
pub(super) const STEPS: usize = 14;

/// Half the step of differences in the scores, by which a quantity's map is differentiated.
const STEP: f64 = 1e-4;

const MOST_STEPS: usize = 20;

/// The information that a rectangular score has where the data say nothing of it, so that its
/// integral is one: a rectangle of unit variance has the area of a normal peak of this curvature.
const FLAT: f64 = std::f64::consts::PI / 6.0;

/// A gain in the logarithm of the density that is not worth another step.
const ENOUGH: f64 = 1e-3;

/// An amplitude at which a discrepancy makes no difference, in standard uncertainties.
const NEGLIGIBLE: f64 = 1e-6;

/// Nor is one that is less than this share of what is missing to make a difference.
const ROUGHLY: f64 = 0.02;

/// Every so many-th amplitude is tried first.
const COARSE: usize = 4;

/// Forms whose evidence is lower than what leads by this factor's logarithm make no difference.
const HOPELESS: f64 = 12.0;

/// Between two amplitudes that are tried, a factor of 3.73 apart, the density may be higher than at
/// either by this factor's logarithm for each feature: with the peak a factor of 1.68 above the lower
/// one, where -ln a - (1/a^2)/2 has fallen by as much on both sides.
const PER_FEATURE: f64 = 0.4;

/// The evidence; forms that cannot come near `floor` or near the best of them are left at a few
/// amplitudes.
pub(crate) fn evidence(
    discrepancy: &Discrepancy,
    setup: &Setup<'_>,
    residuals: &[f64],
    floor: f64,
) -> Unexplained {
    let noise: Vec<&Role> = setup.roles.iter().filter(|role| role.is_noise()).collect();
    // how far the density may rise between the amplitudes that are tried
    let reach = |place: usize| {
        let features = discrepancy.forms[place].nodes.rank() * setup.data.outputs.len();
        PER_FEATURE * features as f64
    };
    let at = |place: usize, problem: &Problem<'_>, step: usize, start: &[f64]| {
        let form = &discrepancy.forms[place];
        let share = (step as f64 + 0.5) / STEPS as f64;
        let amplitude = AMPLITUDES[0] * elementary::pow(AMPLITUDES[1] / AMPLITUDES[0], share);
        let mut scores = start.to_vec();
        let ln_share = form.ln_weight - elementary::ln(STEPS as f64);
        let worth = floor - HOPELESS - reach(place) - ln_share;
        let ln = problem.integrate(amplitude, &mut scores, worth) + ln_share;
        let variances = problem.variances(&scores);
        let own = problem.means.iter().map(|mean| variances[mean.value]);
        let multiplier = amplitude * problem.scale(own);
        let variances = Some(Arc::new(variances));
        let kind = Weighted { form: place, multiplier, weight: 0.0, base: None, variances };
        WeighedForm { step, ln, kind, scores }
    };
    let problem = |place: usize| {
        let form = &discrepancy.forms[place];
        let features = form.features(setup, &discrepancy.axes);
        Problem::new(setup, &features, &noise, residuals)
    };
    let mut alone = vec![0.0; noise.len()];
    if !discrepancy.forms.is_empty() {
        problem(0).integrate(NEGLIGIBLE, &mut alone, f64::NEG_INFINITY);
    }
    let is_coarse = |step: &usize| step % COARSE == 1;
    // forms of one term differ little: the noise beside one of them is where to look for that of the
    // next
    let terms: Vec<&[Form]> = discrepancy.forms.chunk_by(|a, b| a.term == b.term).collect();
    let ends = terms.iter().scan(0, |end, forms| {
        *end += forms.len();
        Some(*end - forms.len()..*end)
    });
    let of_term = |places: Range<usize>| {
        let mut found: Vec<Vec<WeighedForm>> = Vec::with_capacity(places.len());
        for place in places {
            let problem = problem(place);
            let mut parts: Vec<WeighedForm> = Vec::new();
            // from the largest amplitude on, where the noise is least
            for step in (0..STEPS).rev().filter(is_coarse) {
                let before = found.last().and_then(|parts| parts.iter().find(|p| p.step == step));
                let start = before.or(parts.last()).map_or(&alone, |part| &part.scores);
                parts.push(at(place, &problem, step, start));
            }
            found.push(parts);
        }
        found
    };
    let ends: Vec<Range<usize>> = ends.collect();
    let mut parts: Vec<Vec<WeighedForm>> =
        parallel::map(ends, of_term).into_iter().flatten().collect();
    let best =
        |parts: &[WeighedForm]| parts.iter().map(|part| part.ln).fold(f64::NEG_INFINITY, f64::max);
    let leads = parts.iter().map(|parts| best(parts)).fold(floor, f64::max);
    parallel::map(parts.iter_mut().enumerate(), |(place, parts)| {
        if best(parts) + reach(place) <= leads - HOPELESS {
            return;
        }
        let problem = problem(place);
        for step in (0..STEPS).rev().filter(|step| !is_coarse(step)) {
            let above = parts.iter().filter(|part| part.step > step).min_by_key(|part| part.step);
            let start = above.or(parts.first()).map_or(&alone, |part| &part.scores);
            let part = at(place, &problem, step, start);
            parts.push(part);
        }
    });
    let parts = parts.into_iter().flatten().map(|WeighedForm { ln, kind, .. }| (ln, kind));
    weigh(parts.collect())
}

/// A form at an amplitude, with the logarithm of its share of the evidence.
struct WeighedForm {
    /// Which amplitude.
    step: usize,
    ln: f64,
    kind: Weighted,
    /// The most probable scores of the noise.
    scores: Vec<f64>,
}

struct Problem<'p> {
    setup: &'p Setup<'p>,
    noise: &'p [&'p Role],
    /// Repeats are one mean each.
    means: Vec<Mean>,
    /// The discrepancy's features at each mean, then the shared inputs' basis.
    rows: Vec<Vec<f64>>,
    /// Those of a row's features that are not zero: they are of one output each.
    spans: Vec<Range<usize>>,
    features: usize,
    /// For each mean the variance of the discrepancy at unit variance of the function.
    own: Vec<f64>,
    touched: f64,
}

/// A quantity of the noise at its score.
struct NoiseAt {
    output: usize,
    /// Whether it is the power of the model's size that the noise follows, or the logarithm of its
    /// standard deviation.
    is_power: bool,
    value: f64,
    /// By how much it rises from [`STEP`] below the score to as much above.
    rise: f64,
}

/// The mean of values that differ by nothing but noise.
struct Mean {
    /// Place of the first of them.
    value: usize,
    count: f64,
    residual: f64,
    /// Sum of the squared deviations from the mean.
    squares: f64,
}

/// The logarithm of the density at scores of the noise, with its gradient and expected information.
struct Local {
    ln: f64,
    gradient: DVector<f64>,
    information: DMatrix<f64>,
}

impl<'p> Problem<'p> {
    fn new(
        setup: &'p Setup<'p>,
        features: &DMatrix<f64>,
        noise: &'p [&'p Role],
        residuals: &[f64],
    ) -> Self {
        let means = means(setup, residuals);
        let basis = &setup.linear.basis;
        let row = |mean: &Mean| -> Vec<f64> {
            let features = features.row(mean.value);
            features.iter().copied().chain(basis.iter().map(|column| column[mean.value])).collect()
        };
        let rows: Vec<Vec<f64>> = means.iter().map(row).collect();
        let features = features.ncols();
        let span = |row: &Vec<f64>| {
            let filled = |f: &f64| *f != 0.0;
            let first = row[..features].iter().position(filled).unwrap_or(features);
            first..row[..features].iter().rposition(filled).map_or(first, |last| last + 1)
        };
        let spans = rows.iter().map(span).collect();
        let own: Vec<f64> =
            rows.iter().map(|row| row[..features].iter().map(|f| f * f).sum()).collect();
        let touched = own.iter().zip(&means).filter(|(own, _)| **own > 0.0).map(|(_, m)| m.count);
        let touched = touched.sum::<f64>().max(1.0);
        Self { setup, noise, means, rows, spans, features, own, touched }
    }

    /// The noise's quantities at these scores, with the differences for their derivatives.
    fn noise_at(&self, scores: &[f64]) -> Vec<NoiseAt> {
        let of = |(role, &score): (&&Role, &f64)| {
            let (output, map, is_power) = match role {
                Role::Noise { output, map } => (*output, map, false),
                Role::Power { output, map } => (*output, map, true),
                Role::Variable { .. } => return None,
            };
            let rise = map.value(score + STEP) - map.value(score - STEP);
            Some(NoiseAt { output, is_power, value: map.value(score), rise })
        };
        self.noise.iter().zip(scores).filter_map(of).collect()
    }

    /// Variance of a value's noise, and its derivatives by the scores over it.
    fn variance(&self, value: usize, noise: &[NoiseAt], slopes: &mut [f64]) -> f64 {
        let output = value % self.setup.data.outputs.len();
        let known = self.setup.linear.variances[value];
        let (mut ln, mut found) = (self.setup.data.ln_scales[value], false);
        slopes.fill(0.0);
        for (shared, slope) in
            noise.iter().zip(slopes.iter_mut()).filter(|(noise, _)| noise.output == output)
        {
            let factor = if shared.is_power { self.setup.ln_sizes[value] } else { 1.0 };
            found |= !shared.is_power;
            ln += factor * shared.value;
            *slope = factor * shared.rise / STEP;
        }
        if !found {
            return known;
        }
        let own = elementary::exp(2.0 * ln);
        slopes.iter_mut().for_each(|slope| *slope *= own / (own + known));
        own + known
    }

    /// Variance of the noise by value.
    fn variances(&self, scores: &[f64]) -> Vec<f64> {
        let mut slopes = vec![0.0; scores.len()];
        let values = 0..self.setup.linear.variances.len();
        let noise = self.noise_at(scores);
        values.map(|value| self.variance(value, &noise, &mut slopes)).collect()
    }

    /// What unit variance is multiplied by for an amplitude of one standard uncertainty; `own` are
    /// variances of the noise by mean.
    fn scale(&self, variances: impl Iterator<Item = f64>) -> f64 {
        let means = self.own.iter().zip(&self.means).zip(variances);
        let squares: f64 = means.map(|((own, mean), v)| mean.count * own / v).sum();
        (self.touched / squares.max(f64::MIN_POSITIVE)).sqrt()
    }

    /// Logarithm of likelihood times prior of the scores, without the prior's constant, with its
    /// gradient; and the expected information, where the directions that the discrepancy can follow
    /// are taken as either wholly free or not at all.
    fn local(&self, amplitude: f64, scores: &[f64]) -> Local {
        let d = scores.len();
        let order = self.rows.first().map_or(0, Vec::len);
        let mut slopes = vec![0.0; d];
        let noise = self.noise_at(scores);
        let mut variances = Vec::with_capacity(self.means.len());
        let mut all_slopes = Vec::with_capacity(self.means.len() * d);
        for mean in &self.means {
            variances.push(self.variance(mean.value, &noise, &mut slopes));
            all_slopes.extend_from_slice(&slopes);
        }
        let multiplier = amplitude * self.scale(variances.iter().copied());
        let mut inner = vec![0.0; triangle(order)];
        for i in 0..order {
            inner[triangle(i) + i] = 1.0;
        }
        let mut products = vec![0.0; order];
        let mut whitened = vec![0.0; self.rows.len() * order];
        let mut ln = 0.0;
        for (n, (mean, &variance)) in self.means.iter().zip(&variances).enumerate() {
            let root = (mean.count / variance).sqrt();
            let white_row = &mut whitened[n * order..(n + 1) * order];
            for (part, factor) in
                [(self.spans[n].clone(), multiplier * root), (self.features..order, root)]
            {
                let entries = white_row[part.clone()].iter_mut().zip(&self.rows[n][part]);
                entries.for_each(|(white, entry)| *white = factor * entry);
            }
            let white = mean.residual * root;
            ln -= 0.5
                * (mean.count * elementary::ln(variance) + mean.squares / variance + white * white);
            ln -= mean.count * HALF_LN_TWO_PI;
            for part in [self.spans[n].clone(), self.features..order] {
                for (product, factor) in products[part.clone()].iter_mut().zip(&white_row[part]) {
                    *product += factor * white;
                }
            }
        }
        packed::add_squares(&mut inner, &whitened);
        packed::cholesky_of_definite(&mut inner);
        ln -= packed::ln_diagonal(&inner);
        packed::solve(&inner, &mut products);
        ln += 0.5 * products.iter().map(|y| y * y).sum::<f64>();
        packed::solve_transposed(&inner, &mut products);
        let mut gradient = DVector::zeros(d);
        let mut information = DMatrix::zeros(d, d);
        let (mut leverages, mut weight) = (0.0, 0.0);
        let mut follows = DVector::zeros(d);
        let all_leverages = leverages_of(&inner, &whitened, self.means.len());
        for (n, (mean, &variance)) in self.means.iter().zip(&variances).enumerate() {
            let row = &whitened[n * order..(n + 1) * order];
            let slopes = &all_slopes[n * d..(n + 1) * d];
            let leverage = all_leverages[n];
            leverages += leverage;
            let span = self.spans[n].clone();
            let fitted = dot(&row[span.clone()], &products[span])
                + dot(&row[self.features..], &products[self.features..]);
            let rest = mean.residual * (mean.count / variance).sqrt() - fitted;
            let excess = rest * rest + mean.squares / variance - (mean.count - leverage);
            let share = mean.count * self.own[n] / variance;
            weight += share;
            for i in 0..d {
                gradient[i] += 0.5 * slopes[i] * excess;
                follows[i] += share * slopes[i];
                for j in 0..=i {
                    information[(i, j)] += 0.5 * (mean.count - leverage) * slopes[i] * slopes[j];
                }
            }
        }
        // the discrepancy's size follows the noise
        follows /= weight.max(f64::MIN_POSITIVE);
        let taken = (leverages - shared(&inner, self.features, order)).max(0.0);
        let square: f64 = products[..self.features].iter().map(|b| b * b).sum();
        for i in 0..d {
            gradient[i] += 0.5 * follows[i] * (square - taken);
            for j in 0..=i {
                information[(i, j)] += 0.5 * taken * follows[i] * follows[j];
                information[(j, i)] = information[(i, j)];
            }
        }
        for (i, (role, &score)) in self.noise.iter().zip(scores).enumerate() {
            ln += ln_prior(role.is_bounded(), score);
            if !role.is_bounded() {
                gradient[i] -= score;
                information[(i, i)] += 1.0;
            }
        }
        Local { ln, gradient, information }
    }

    /// The logarithm of the integral over the scores of the noise; `scores` are where to start, and
    /// become the most probable ones. What lies far below `worth` is found roughly.
    fn integrate(&self, amplitude: f64, scores: &mut [f64], worth: f64) -> f64 {
        let mut here = self.local(amplitude, scores);
        let mut damping = 1e-4;
        for _ in 0..MOST_STEPS {
            let enough = ENOUGH.max(ROUGHLY * (worth - here.ln));
            let mut damped = here.information.clone();
            for i in 0..scores.len() {
                damped[(i, i)] = damped[(i, i)] * (1.0 + damping) + 1e-6;
            }
            let mut gradient = here.gradient.clone();
            for (i, score) in scores.iter().enumerate() {
                // at an edge that it would cross it stays, and the others move without it
                if score.abs() >= EDGE && score * gradient[i] > 0.0 {
                    gradient[i] = 0.0;
                    damped.row_mut(i).fill(0.0);
                    damped.column_mut(i).fill(0.0);
                    damped[(i, i)] = 1.0;
                }
            }
            let Some(root) = damped.cholesky() else { break };
            let step = root.solve(&gradient);
            if step.dot(&gradient) < 2.0 * enough {
                break;
            }
            let next: Vec<f64> = scores
                .iter()
                .zip(step.iter())
                .map(|(score, step)| (score + step.clamp(-1.0, 1.0)).clamp(-EDGE, EDGE))
                .collect();
            let there = self.local(amplitude, &next);
            if there.ln >= here.ln {
                let gain = there.ln - here.ln;
                scores.copy_from_slice(&next);
                here = there;
                damping *= 0.1;
                if gain < enough {
                    break;
                }
            } else {
                damping = (damping * 30.0).max(1e-2);
            }
        }
        let mut information = here.information;
        for (i, role) in self.noise.iter().enumerate() {
            if role.is_bounded() {
                information[(i, i)] += FLAT;
            }
        }
        let determinant = information.determinant();
        here.ln - 0.5 * if determinant > 0.0 { elementary::ln(determinant) } else { 0.0 }
    }
}

/// Repeats that have the same variance and the same share of the shared inputs, together.
fn means(setup: &Setup<'_>, residuals: &[f64]) -> Vec<Mean> {
    let outputs = setup.data.outputs.len();
    let linear = &setup.linear;
    let alike = |a: usize, b: usize| {
        linear.variances[a] == linear.variances[b]
            && linear.basis.iter().all(|column| column[a] == column[b])
    };
    let mut means: Vec<Mean> = Vec::new();
    // those of an output together, as features mostly are of one output each
    for output in 0..outputs {
        for point in &setup.data.points {
            let first = means.len();
            for &row in &point.rows {
                let (value, residual) = (row * outputs + output, residuals[row * outputs + output]);
                match means[first..].iter_mut().find(|mean| alike(mean.value, value)) {
                    Some(mean) => {
                        let before = residual - mean.residual;
                        mean.count += 1.0;
                        mean.residual += before / mean.count;
                        mean.squares += before * (residual - mean.residual);
                    }
                    None => means.push(Mean { value, count: 1.0, residual, squares: 0.0 }),
                }
            }
        }
    }
    means
}

/// The squares of inv(L) w for the Cholesky root L and each of so many whitened rows w.
fn leverages_of(root: &[f64], whitened: &[f64], count: usize) -> Vec<f64> {
    let order = whitened.len() / count.max(1);
    let groups = count.div_ceil(TOGETHER);
    let mut vectors = vec![0.0; groups * TOGETHER * order];
    for (n, row) in whitened.chunks_exact(order.max(1)).enumerate() {
        let group = &mut vectors[n / TOGETHER * TOGETHER * order..];
        for (value, entries) in row.iter().zip(group.chunks_exact_mut(TOGETHER)) {
            entries[n % TOGETHER] = *value;
        }
    }
    let mut leverages = vec![0.0; groups * TOGETHER];
    packed::solve_many(root, &mut vectors, &mut leverages);
    leverages
}

/// How many of the shared inputs' directions the data decide: their number less the trace of their
/// block of the inverse.
fn shared(root: &[f64], first: usize, order: usize) -> f64 {
    let mut trace = 0.0;
    let mut column = vec![0.0; order];
    for j in first..order {
        column.fill(0.0);
        column[j] = 1.0;
        packed::solve(root, &mut column);
        trace += column[j..].iter().map(|y| y * y).sum::<f64>();
    }
    (order - first) as f64 - trace
}

#[cfg(test)]
mod tests {
    use super::Problem;
    use crate::data::by_rows;
    use crate::discrepancy::Discrepancy;
    use crate::latent::Role;
    use crate::setup::Setup;
    use crate::tests::cases::line;

    #[test]
    fn gradients_are_those_of_differences() {
        let mut case = line();
        for observed in case.observed.iter_mut().flatten() {
            observed.standard_uncertainties = None;
        }
        let setup = Setup::new(&case);
        let discrepancy = Discrepancy::new(&setup);
        let noise: Vec<&Role> = setup.roles.iter().filter(|role| role.is_noise()).collect();
        let residuals = by_rows(&setup.data.nominal_residuals());
        for form in discrepancy.forms.iter().step_by(5) {
            let features = form.features(&setup, &discrepancy.axes);
            let problem = Problem::new(&setup, &features, &noise, &residuals);
            for amplitude in [3.0, 30.0] {
                let scores = vec![0.4; noise.len()];
                let local = problem.local(amplitude, &scores);
                for i in 0..scores.len() {
                    let at = |step: f64| {
                        let mut moved = scores.clone();
                        moved[i] += step;
                        problem.local(amplitude, &moved).ln
                    };
                    let slope = (at(1e-4) - at(-1e-4)) / 2e-4;
                    // truncation: 1e-8 times the third derivative, of the order of the value itself
                    // times the cube of the score's share of the logarithm, some 100
                    let miss = local.gradient[i] - slope;
                    let scale = slope.abs().max(1.0);
                    assert!(miss.abs() < 1e-5 * scale, "{:?} {miss} of {slope}", form.term);
                }
            }
        }
    }
}
