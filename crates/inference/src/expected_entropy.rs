//! By how much a measurement is expected to lower the entropy of the probabilities of hypotheses:
//! the mutual information of which hypothesis is true and what will be measured.
//!
//! A hypothesis predicts the outputs by draws of its posterior. Kernels about them, with the
//! covariance of the noise and a share of that of the draws, make a density of the draws' own mean and
//! covariance (West 1993, J. R. Stat. Soc. B 55, 409): draws alone would leave gaps where the noise is
//! small. What may be measured is drawn from these densities, with the same random numbers for every
//! measurement that is compared.

use super::logarithm::ln_sum;
use crate::integral::mixture::standard_normals;
use gumption_engine::distribution::StreamKey;
use gumption_engine::linalg::packed::{self, triangle};
use gumption_engine::number::{CodePath, Column, Kernel, elementary};

/// Measurements that are drawn, over all hypotheses.
const SIMULATED: usize = 384;

/// At least so many of each hypothesis.
const LEAST_SIMULATED: usize = 12;

/// What a hypothesis says of a measurement.
#[derive(Clone, Copy, Debug)]
pub struct Outlook<'d> {
    /// Probability of the hypothesis.
    pub probability: f64,
    /// For each output draws of its value without noise.
    pub draws: &'d [Vec<f64>],
}

/// Standard normal numbers for simulated measurements.
#[derive(Clone, Debug)]
pub struct Normals(Vec<f64>);

impl Normals {
    /// For measurements of at most so many outputs.
    pub fn new(seed: u64, outputs: usize) -> Self {
        let mut stream = StreamKey::new(seed, "gap/next").block(0);
        let mut values = Vec::new();
        while values.len() < 2 * SIMULATED * outputs.max(1) {
            let mut column = Column::ZERO;
            standard_normals(&mut stream, &mut column);
            values.extend(column.0);
        }
        Self(values)
    }

    fn get(&self, simulated: usize, output: usize, outputs: usize) -> f64 {
        self.0[(simulated * outputs + output) % self.0.len()]
    }
}

/// How finely a prediction is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// A normal density with the draws' mean and covariance.
    Normal,
    /// A kernel for every draw.
    Kernels,
}

/// The density of a measurement that a hypothesis predicts.
struct KernelDensity {
    /// Centres of the kernels, whitened by the root: those of each output one after the other.
    centres: Vec<f64>,
    /// Lower Cholesky root of a kernel's covariance.
    root: Vec<f64>,
    ln_constant: f64,
    outputs: usize,
    kernels: usize,
}

impl KernelDensity {
    /// `noise` holds a variance for each output.
    fn new(draws: &[Vec<f64>], noise: &[f64], detail: Detail) -> Self {
        let outputs = draws.len();
        let count = draws.first().map_or(0, Vec::len).max(1);
        let n = count as f64;
        let means: Vec<f64> = draws.iter().map(|draw| draw.iter().sum::<f64>() / n).collect();
        // the width of kernels that keeps the shape of a normal density (Silverman)
        let share = match detail {
            Detail::Normal => 1.0,
            Detail::Kernels => elementary::pow(n, -2.0 / (outputs as f64 + 4.0)),
        };
        let mut root = vec![0.0; triangle(outputs)];
        for i in 0..outputs {
            for j in 0..=i {
                let product = |(a, b): (&f64, &f64)| (a - means[i]) * (b - means[j]);
                let covariance = draws[i].iter().zip(&draws[j]).map(product).sum::<f64>() / n;
                root[triangle(i) + j] = share * covariance + if i == j { noise[i] } else { 0.0 };
            }
        }
        packed::cholesky_of_definite(&mut root);
        let shrink = (1.0 - share).max(0.0).sqrt();
        let kernels = if detail == Detail::Normal { 1 } else { count };
        let mut centres = vec![0.0; kernels * outputs];
        for kernel in 0..kernels {
            let mut centre: Vec<f64> = (0..outputs)
                .map(|output| match detail {
                    Detail::Normal => means[output],
                    Detail::Kernels => {
                        means[output] + shrink * (draws[output][kernel] - means[output])
                    }
                })
                .collect();
            packed::solve(&root, &mut centre);
            for (output, value) in centre.into_iter().enumerate() {
                centres[output * kernels + kernel] = value;
            }
        }
        let ln_constant = -packed::ln_diagonal(&root) - elementary::ln(kernels as f64);
        Self { centres, root, ln_constant, outputs, kernels }
    }

    /// A measurement, the one of this number of so many.
    fn simulated(&self, number: usize, normals: &Normals) -> Vec<f64> {
        let outputs = self.outputs;
        let kernel = number * SPREAD % self.kernels;
        let white: Vec<f64> = (0..outputs)
            .map(|output| {
                self.centres[output * self.kernels + kernel] + normals.get(number, output, outputs)
            })
            .collect();
        (0..outputs).map(|i| (0..=i).map(|j| self.root[triangle(i) + j] * white[j]).sum()).collect()
    }

    /// Logarithm of the density, without the powers of two pi that all have in common.
    fn ln_density(&self, measured: &[f64]) -> f64 {
        let mut white = measured.to_vec();
        packed::solve(&self.root, &mut white);
        let mut terms = vec![0.0; self.kernels];
        self.ln_constant
            + CodePath::best().run(LnKernels { density: self, white: &white, terms: &mut terms })
    }
}

/// The logarithm of the sum of the kernels at a whitened measurement; a quarter of a diagnosis is spent
/// here.
struct LnKernels<'a> {
    density: &'a KernelDensity,
    white: &'a [f64],
    terms: &'a mut [f64],
}

impl Kernel for LnKernels<'_> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let Self { density, white, terms } = self;
        for (centres, white) in density.centres.chunks(density.kernels).zip(white) {
            for (term, centre) in terms.iter_mut().zip(centres) {
                *term += (white - centre) * (white - centre);
            }
        }
        let mut most = f64::NEG_INFINITY;
        for term in terms.iter_mut() {
            *term *= -0.5;
            most = most.max(*term);
        }
        if most == f64::NEG_INFINITY {
            return most;
        }
        for term in terms.iter_mut() {
            *term = elementary::exp(*term - most);
        }
        most + elementary::ln(terms.iter().sum())
    }
}

/// Odd, so that successive numbers go through all kernels of an even number of draws, far apart.
const SPREAD: usize = 29;

/// The expected fall of the entropy of the hypotheses' probabilities once outputs have been measured
/// with these variances of their noise; what is not among the hypotheses is not learnt about.
pub fn expected_loss(
    hypotheses: &[Outlook<'_>],
    noise: &[f64],
    normals: &Normals,
    detail: Detail,
) -> f64 {
    let total: f64 = hypotheses.iter().map(|hypothesis| hypothesis.probability).sum();
    if total <= 0.0 {
        return 0.0;
    }
    let densities: Vec<KernelDensity> = hypotheses
        .iter()
        .map(|hypothesis| KernelDensity::new(hypothesis.draws, noise, detail))
        .collect();
    let ln_priors: Vec<f64> = hypotheses
        .iter()
        .map(|hypothesis| elementary::ln(hypothesis.probability / total))
        .collect();
    let mut loss = 0.0;
    for (own, hypothesis) in hypotheses.iter().enumerate() {
        let share = hypothesis.probability / total;
        let simulated = SIMULATED / if detail == Detail::Normal { 8 } else { 1 };
        let count = ((simulated as f64 * share) as usize).max(LEAST_SIMULATED);
        let gain = |number: usize| {
            let measured = densities[own].simulated(number, normals);
            let each: Vec<f64> = densities
                .iter()
                .zip(&ln_priors)
                .map(|(density, ln_prior)| density.ln_density(&measured) + ln_prior)
                .collect();
            each[own] - ln_sum(each.iter().copied()) - ln_priors[own]
        };
        loss += share * (0..count).map(gain).sum::<f64>() / count as f64;
    }
    total * loss.max(0.0)
}

/// Logarithms of the odds of the truth after a measurement, be it the one hypothesis or the other,
/// with weights that sum to one.
pub fn ln_odds(pair: [Outlook<'_>; 2], noise: &[f64], normals: &Normals) -> Vec<(f64, f64)> {
    let total = pair[0].probability + pair[1].probability;
    let densities =
        pair.map(|hypothesis| KernelDensity::new(hypothesis.draws, noise, Detail::Kernels));
    let mut all = Vec::with_capacity(2 * ODDS);
    for (own, other) in [(0, 1), (1, 0)] {
        let before = elementary::ln(pair[own].probability / pair[other].probability);
        let weight = pair[own].probability / total / ODDS as f64;
        all.extend((0..ODDS).map(|number| {
            let measured = densities[own].simulated(number, normals);
            let gain =
                densities[own].ln_density(&measured) - densities[other].ln_density(&measured);
            (before + gain, weight)
        }));
    }
    all
}

/// Measurements that odds are looked at for, of each hypothesis.
const ODDS: usize = 96;
