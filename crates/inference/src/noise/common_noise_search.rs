//! Which noises that the outputs of a row have in common may be worth an evidence of their own.

use gumption_engine::linalg::dot;
use gumption_engine::linalg::packed::{self, triangle};
use gumption_engine::number::{elementary, largest_first};
use gumption_engine::parallel;

use crate::logarithm::{HALF_LN_TWO_PI, ln_add};
use crate::noise::common_noise::CommonNoise;
use crate::noise::noise_model::{FACTORS, NoiseModel, WORTH_TRYING};
use crate::noise::remainder::Remainder;
use crate::noise::weighing::{Weighing, ln_total, ln_weight_at_mode};
use crate::setup::Setup;

/// Fewer rows say nothing of a correlation.
const LEAST_ROWS: usize = 8;

/// The prior probability that the stated uncertainties of an output are right where its noise may be
/// correlated with that of others.
const AS_STATED: f64 = 0.5;

/// Models that are tried, at most.
const MOST_MODELS: usize = 3;

/// The coefficient of correlation is looked for between these.
const CORRELATIONS: [f64; 2] = [0.05, 0.998];

/// The correlated noises that may be worth an evidence of their own: by the densities of the residuals that
/// the hypotheses leave at their modes, with such noise and without.
pub(crate) fn worth_trying(weighings: &[Weighing<'_>]) -> Vec<CommonNoise> {
    let Some(Weighing { setup, posterior, .. }) = weighings.first() else { return Vec::new() };
    let outputs = setup.data.outputs.len();
    if outputs < 2 || setup.linear.fitted || setup.data.rows() < LEAST_ROWS {
        return Vec::new();
    }
    let left: Vec<(f64, NoiseMoments)> = parallel::map(&posterior.hypotheses, |hypothesis| {
        let moments = NoiseMoments::of(setup, &Remainder::of(setup, hypothesis));
        (ln_weight_at_mode(setup, hypothesis), moments)
    });
    let free = vec![true; outputs];
    let leading = left.iter().filter_map(|(ln, moments)| {
        let best = moments
            .patterns()
            .into_iter()
            .filter_map(|signs| Some(moments.peak(&signs, &free)?.ln));
        Some((ln + best.max_by(f64::total_cmp)?, moments))
    });
    let Some((_, leading)) = leading.max_by(|a, b| a.0.total_cmp(&b.0)) else { return Vec::new() };
    let mut found: Vec<(f64, CommonNoise)> = leading
        .peaks()
        .into_iter()
        .filter_map(|peak| {
            let noise = peak.noise();
            let gains = left
                .iter()
                .map(|(ln, moments)| ln + moments.ln_density(&noise) - moments.ln_as_stated());
            let ln = gains.filter(|ln| !ln.is_nan()).fold(f64::NEG_INFINITY, ln_add);
            let prior = NoiseModel::with_common(noise.clone()).prior(setup.data.len());
            (prior > 0.0).then(|| (ln + elementary::ln(prior), noise))
        })
        .collect();
    largest_first(&mut found, |(ln, _)| *ln);
    let best = found.iter().map(|(ln, _)| *ln).fold(ln_total(weighings), f64::max);
    let is_worth = |ln: f64| ln - best > elementary::ln(WORTH_TRYING);
    let found = found.into_iter().filter(|(ln, _)| is_worth(*ln));
    found.map(|(_, noise)| noise).take(MOST_MODELS).collect()
}

/// What is left of the data, in stated standard uncertainties, and how it is spread over the outputs of a
/// row.
struct NoiseMoments {
    outputs: usize,
    /// Rows with the same covariance beside their noise.
    groups: Vec<NoiseGroup>,
}

/// Rows whose inputs of their own add the same covariance to that of the noise.
struct NoiseGroup {
    rows: f64,
    /// Lower triangle of that covariance, in stated standard uncertainties.
    known: Vec<f64>,
    /// That of the sum of the outer products of what is left.
    squares: Vec<f64>,
}

/// The most probable correlation and factors for outputs that take part.
struct Peak {
    signs: Vec<f64>,
    /// The logarithms of factors (0 where the stated uncertainties are right), then the inverse hyperbolic
    /// tangent of the coefficient of correlation.
    at: Vec<f64>,
    /// The quantities that are free, as places in `at`, and their standard deviations.
    free: Vec<usize>,
    deviations: Vec<f64>,
    /// The logarithm of the prior probability of the peak, and that times the gain in density there.
    ln_share: f64,
    ln: f64,
}

impl NoiseMoments {
    fn of(setup: &Setup<'_>, left: &Remainder) -> Self {
        let outputs = setup.data.outputs.len();
        let mut groups: Vec<NoiseGroup> = Vec::new();
        let roots = setup.covariance.roots.chunks_exact(triangle(outputs));
        for (row, (whitened, root)) in left.residuals.chunks_exact(outputs).zip(roots).enumerate() {
            let u: Vec<f64> = (0..outputs)
                .map(|output| setup.data.uncertainties[output].as_ref().map_or(1.0, |u| u[row]))
                .collect();
            // the root of the block itself, in stated uncertainties
            let mut root = root.to_vec();
            packed::invert(&mut root);
            for (i, u) in u.iter().enumerate() {
                root[triangle(i)..triangle(i + 1)].iter_mut().for_each(|entry| *entry /= u);
            }
            let residuals: Vec<f64> = packed::rows(&root).map(|row| dot(row, whitened)).collect();
            let (mut known, mut squares) = (Vec::new(), Vec::new());
            for (i, row) in packed::rows(&root).enumerate() {
                for (j, other) in packed::rows(&root).enumerate().take(i + 1) {
                    let beside = dot(row, other) - f64::from(u8::from(i == j));
                    // of nothing but noise there remains rounding
                    known.push(if beside.abs() < 1e-9 { 0.0 } else { beside });
                    squares.push(residuals[i] * residuals[j]);
                }
            }
            match groups.iter_mut().find(|group| group.known == known) {
                Some(group) => {
                    group.rows += 1.0;
                    let sums = group.squares.iter_mut().zip(squares);
                    sums.for_each(|(sum, square)| *sum += square);
                }
                None => groups.push(NoiseGroup { rows: 1.0, known, squares }),
            }
        }
        Self { outputs, groups }
    }

    /// The logarithm of the density of what is left, without a constant; minus infinity where the
    /// covariance is none.
    fn ln_at(&self, signs: &[f64], at: &[f64]) -> f64 {
        let Some((&ahead, ln_factors)) = at.split_last() else { return f64::NEG_INFINITY };
        let correlation = elementary::tanh(ahead);
        let factors: Vec<f64> = ln_factors.iter().map(|ln| elementary::exp(*ln)).collect();
        let mut noise = Vec::with_capacity(triangle(self.outputs));
        for i in 0..self.outputs {
            for j in 0..i {
                noise.push(factors[i] * factors[j] * signs[i] * signs[j] * correlation);
            }
            noise.push(factors[i] * factors[i]);
        }
        let of = |group: &NoiseGroup| {
            let mut block: Vec<f64> =
                noise.iter().zip(&group.known).map(|(noise, known)| noise + known).collect();
            if packed::cholesky(&mut block, 0.0).is_err() {
                return f64::NEG_INFINITY;
            }
            let half_ln_det = packed::ln_diagonal(&block);
            packed::invert(&mut block);
            let of_row = |row: &[f64]| {
                let entry = |i: usize, j: usize| group.squares[place(i, j)];
                let of = |i: usize| (0..row.len()).map(|j| row[j] * entry(i, j)).sum::<f64>();
                (0..row.len()).map(|i| row[i] * of(i)).sum::<f64>()
            };
            let square = packed::rows(&block).map(of_row).sum::<f64>();
            -0.5 * square - group.rows * half_ln_det
        };
        self.groups.iter().map(of).sum()
    }

    fn ln_density(&self, noise: &CommonNoise) -> f64 {
        let factors = (0..self.outputs).map(|output| elementary::ln(noise.factor(output)));
        let at: Vec<f64> = factors.chain([elementary::atanh(noise.correlation)]).collect();
        self.ln_at(&noise.signs, &at)
    }

    fn ln_as_stated(&self) -> f64 {
        self.ln_at(&vec![0.0; self.outputs], &vec![0.0; self.outputs + 1])
    }

    /// The sums of the products of what is left of two outputs.
    fn products(&self, i: usize, j: usize) -> f64 {
        self.groups.iter().map(|group| group.squares[place(i, j)]).sum()
    }

    /// The coefficient of correlation of what is left of two outputs, not about its means.
    fn correlation(&self, i: usize, j: usize) -> f64 {
        let found = self.products(i, j) / (self.products(i, i) * self.products(j, j)).sqrt();
        if found.is_finite() { found } else { 0.0 }
    }

    /// Which outputs take part, and with which signs: the pair that is correlated most, and with one more at
    /// a time of those that are correlated most with these.
    fn patterns(&self) -> Vec<Vec<f64>> {
        let pairs = (0..self.outputs).flat_map(|i| (0..i).map(move |j| (i, j)));
        let size = |&(i, j): &(usize, usize)| self.correlation(i, j).abs();
        let Some((one, other)) = pairs.max_by(|a, b| size(a).total_cmp(&size(b))) else {
            return Vec::new();
        };
        let mut signs = vec![0.0; self.outputs];
        signs[one] = 1.0;
        signs[other] = if self.correlation(one, other) < 0.0 { -1.0 } else { 1.0 };
        let mut all = vec![signs.clone()];
        loop {
            let with = |output: usize| -> f64 {
                (0..self.outputs).map(|known| signs[known] * self.correlation(known, output)).sum()
            };
            let others = (0..self.outputs).filter(|output| signs[*output] == 0.0);
            let next = others.max_by(|a, b| with(*a).abs().total_cmp(&with(*b).abs()));
            let Some(next) = next else { return all };
            signs[next] = if with(next) < 0.0 { -1.0 } else { 1.0 };
            all.push(signs.clone());
        }
    }

    /// The peaks for all patterns, with factors that are free where that makes them more probable.
    fn peaks(&self) -> Vec<Peak> {
        let mut all = Vec::new();
        for signs in self.patterns() {
            let mut free = vec![true; self.outputs];
            all.extend(self.peak(&signs, &vec![false; self.outputs]));
            while free.contains(&true) {
                all.extend(self.peak(&signs, &free));
                let without = |output: usize| {
                    let mut fewer = free.clone();
                    fewer[output] = false;
                    (self.peak(&signs, &fewer).map_or(f64::NEG_INFINITY, |peak| peak.ln), fewer)
                };
                let each = (0..self.outputs).filter(|output| free[*output]).map(without);
                let Some((_, fewer)) = each.max_by(|a, b| a.0.total_cmp(&b.0)) else { break };
                free = fewer;
            }
        }
        all
    }

    /// The peak for outputs that take part, and those whose factors are free; `None` where the data know
    /// nothing of some of them.
    fn peak(&self, signs: &[f64], is_free: &[bool]) -> Option<Peak> {
        let pairs = (0..self.outputs).flat_map(|i| (0..i).map(move |j| (i, j)));
        let own: Vec<f64> = pairs
            .filter(|&(i, j)| signs[i] * signs[j] != 0.0)
            .map(|(i, j)| signs[i] * signs[j] * self.correlation(i, j))
            .collect();
        let mean = own.iter().sum::<f64>() / own.len().max(1) as f64;
        let limits: Vec<[f64; 2]> = std::iter::repeat_n(FACTORS.map(elementary::ln), self.outputs)
            .chain([CORRELATIONS.map(elementary::atanh)])
            .collect();
        let rows: f64 = self.groups.iter().map(|group| group.rows).sum();
        let size = |output: usize| 0.5 * elementary::ln(self.products(output, output) / rows);
        let start =
            (0..self.outputs).map(|output| if is_free[output] { size(output) } else { 0.0 });
        let mut at: Vec<f64> = start.chain([elementary::atanh(mean.clamp(0.1, 0.9))]).collect();
        let free: Vec<usize> =
            (0..self.outputs).filter(|o| is_free[*o]).chain([self.outputs]).collect();
        let within = |at: &mut Vec<f64>| {
            for &place in &free {
                at[place] = at[place].clamp(limits[place][0], limits[place][1]);
            }
        };
        within(&mut at);
        let mut ln = self.ln_at(signs, &at);
        for _ in 0..MOST_STEPS {
            let (gradient, curvature) = self.slopes(signs, &at, &free);
            let step = newton(&gradient, &curvature);
            let mut share = 1.0;
            let next = loop {
                let mut next = at.clone();
                for (&place, step) in free.iter().zip(step.iter()) {
                    next[place] += share * step;
                }
                within(&mut next);
                let there = self.ln_at(signs, &next);
                if there > ln {
                    break Some((there, next));
                }
                share *= 0.5;
                if share < LEAST_SHARE {
                    break None;
                }
            };
            let Some((there, next)) = next else { break };
            let gain = there - ln;
            (ln, at) = (there, next);
            if gain < ENOUGH {
                break;
            }
        }
        let (_, curvature) = self.slopes(signs, &at, &free);
        let mut root = curvature;
        packed::cholesky(&mut root, 0.0).ok()?;
        let half_ln_det = packed::ln_diagonal(&root);
        packed::invert(&mut root);
        let variance =
            |i: usize| packed::rows(&root).skip(i).map(|row| row[i] * row[i]).sum::<f64>();
        let deviations: Vec<f64> = (0..free.len()).map(|i| variance(i).sqrt()).collect();
        let correlation = elementary::tanh(at[self.outputs]);
        let [least, most] = FACTORS;
        let factors = (free.len() - 1) as f64;
        // the coefficient is uniform beforehand, factors are log-uniform
        let ln_density = elementary::ln((1.0 - correlation) * (1.0 + correlation))
            - factors * elementary::ln(elementary::ln(most / least));
        let ln_width = free.len() as f64 * HALF_LN_TWO_PI - half_ln_det;
        let ln_free = self.outputs as f64 * elementary::ln(AS_STATED);
        let ln_share =
            (ln_density + ln_width).min(0.0) + ln_free - elementary::ln(patterns(self.outputs));
        let ln = ln - self.ln_as_stated() + ln_share;
        ln.is_finite().then(|| Peak { signs: signs.to_vec(), at, free, deviations, ln_share, ln })
    }

    /// The gradient of the logarithm of the density, and the lower triangle of the matrix of its second
    /// derivatives with the sign reversed.
    fn slopes(&self, signs: &[f64], at: &[f64], free: &[usize]) -> (Vec<f64>, Vec<f64>) {
        let shifted = |shifts: &[(usize, f64)]| {
            let mut there = at.to_vec();
            shifts.iter().for_each(|&(place, shift)| there[place] += shift);
            self.ln_at(signs, &there)
        };
        let here = shifted(&[]);
        let (mut gradient, mut curvature) = (Vec::new(), Vec::new());
        for (n, &i) in free.iter().enumerate() {
            let [above, below] = [STEP, -STEP].map(|step| shifted(&[(i, step)]));
            gradient.push((above - below) / (2.0 * STEP));
            for &j in &free[..n] {
                let both = |a: f64, b: f64| shifted(&[(i, a * STEP), (j, b * STEP)]);
                let second = both(1.0, 1.0) - both(1.0, -1.0) - both(-1.0, 1.0) + both(-1.0, -1.0);
                curvature.push(-second / (4.0 * STEP * STEP));
            }
            curvature.push((2.0 * here - above - below) / (STEP * STEP));
        }
        (gradient, curvature)
    }
}

/// The place of an entry of a symmetric matrix in its lower triangle.
fn place(i: usize, j: usize) -> usize {
    triangle(i.max(j)) + i.min(j)
}

/// Steps of differences: small against the width of a peak (a share of 1/sqrt(2 n)), and large against the
/// square root of rounding.
const STEP: f64 = 1e-3;

const MOST_STEPS: usize = 40;

/// Shorter shares of a step are not tried.
const LEAST_SHARE: f64 = 1e-3;

/// A gain in the logarithm of the density that is not worth another step.
const ENOUGH: f64 = 1e-6;

/// A step uphill: that of Newton where the density is curved like a peak, else along the gradient.
fn newton(gradient: &[f64], curvature: &[f64]) -> Vec<f64> {
    let (mut root, mut step) = (curvature.to_vec(), gradient.to_vec());
    if packed::cholesky(&mut root, 0.0).is_ok() {
        packed::solve(&root, &mut step);
        packed::solve_transposed(&root, &mut step);
    } else {
        let length = dot(gradient, gradient).sqrt().max(f64::MIN_POSITIVE);
        step.iter_mut().for_each(|entry| *entry /= length);
    }
    step
}

/// How many outputs may take part, and with which signs: two or more of them, where all signs together mean
/// nothing.
fn patterns(outputs: usize) -> f64 {
    let n = outputs as f64;
    let all = i32::try_from(outputs).map_or(f64::INFINITY, |n| 3f64.powi(n));
    (0.5 * (all - 1.0 - 2.0 * n)).max(1.0)
}

impl Peak {
    fn noise(self) -> CommonNoise {
        let Self { signs, at, free, deviations, ln_share, .. } = self;
        let outputs = signs.len();
        let deviation = |place: usize| {
            let found = free.iter().position(|free| *free == place)?;
            Some(deviations[found])
        };
        let factor = |place: usize| Some((elementary::exp(at[place]), deviation(place)?));
        CommonNoise {
            correlation: elementary::tanh(at[outputs]),
            spread: deviation(outputs).unwrap_or(0.0),
            factors: (0..outputs).map(factor).collect(),
            share: elementary::exp(ln_share),
            signs,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    /// 40 rows of two outputs: half of the squares that stated uncertainties of 1 let expect, or twice
    /// those, correlated by 0.6; the same with inputs of each row.
    fn moments(known: &[f64]) -> NoiseMoments {
        let (a, b) = (2.0f64, 0.5f64);
        let between = 0.6 * (a * b).sqrt();
        let squares = [a, between, b].map(|of| 40.0 * of).to_vec();
        NoiseMoments {
            outputs: 2,
            groups: vec![NoiseGroup { rows: 40.0, known: known.to_vec(), squares }],
        }
    }

    /// The density is that of normal residuals, by their matrices.
    #[test]
    fn density_by_determinants() {
        let moments = moments(&[0.3, 0.1, 0.2]);
        let (signs, at) = ([1.0, -1.0], [0.2, -0.1, 0.4]);
        let [one, other] = [at[0], at[1]].map(elementary::exp);
        let between = -one * other * elementary::tanh(at[2]) + 0.1;
        let block = DMatrix::from_row_slice(
            2,
            2,
            &[one * one + 0.3, between, between, other * other + 0.2],
        );
        let inverse = block.clone().try_inverse().unwrap();
        let square = (inverse * packed::to_symmetric(&moments.groups[0].squares)).trace();
        let wanted = -0.5 * square - 20.0 * block.determinant().ln();
        assert!((moments.ln_at(&signs, &at) - wanted).abs() < 1e-10);
    }

    /// The share of a peak times the density there is the integral over factors and coefficient. Laplace's
    /// method is off by a share of a few over the 40 rows, of which 0.1 in the logarithm leaves room.
    #[test]
    fn peaks_are_integrals() {
        let moments = moments(&[0.0; 3]);
        let signs = [1.0, 1.0];
        let [least, most] = FACTORS.map(elementary::ln);
        let cells = 200;
        let middle = |n: usize| (n as f64 + 0.5) / cells as f64;
        for free in [[true, true], [false, true], [false, false]] {
            let peak = moments.peak(&signs, &free).unwrap();
            let grid = |is_free: bool| -> Vec<f64> {
                match is_free {
                    true => (0..cells).map(|n| least + (most - least) * middle(n)).collect(),
                    false => vec![0.0],
                }
            };
            let (first, second) = (grid(free[0]), grid(free[1]));
            let mut sum = f64::NEG_INFINITY;
            for &one in &first {
                for &other in &second {
                    for n in 0..cells {
                        let at = [one, other, elementary::atanh(middle(n))];
                        sum = ln_add(sum, moments.ln_at(&signs, &at));
                    }
                }
            }
            let count = (first.len() * second.len() * cells) as f64;
            let integral = sum - count.ln() + 2.0 * AS_STATED.ln() - patterns(2).ln();
            let found = peak.ln + moments.ln_as_stated();
            assert!((found - integral).abs() < 0.1, "{free:?} {found} {integral}");
        }
    }

    /// The outputs that take part are found with their signs, and all ways of taking part are counted.
    #[test]
    fn outputs_that_take_part() {
        let squares = [1.0, -0.8, 1.0, 0.1, 0.05, 1.0].map(|of| 30.0 * of).to_vec();
        let group = NoiseGroup { rows: 30.0, known: vec![0.0; 6], squares };
        let found = NoiseMoments { outputs: 3, groups: vec![group] }.patterns();
        assert_eq!(found[0], [-1.0, 1.0, 0.0]);
        assert_eq!(found.len(), 2);
        // + + and + -; the three pairs of them, and four of all three
        assert_eq!([patterns(2), patterns(3)], [2.0, 10.0]);
    }
}
