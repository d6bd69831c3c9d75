//! The evidence of a hypothesis: the probability density of the data, integrated over everything
//! that is unknown, by adaptive multiple importance sampling (Cornuet, Marin, Mira, Robert 2012,
//! Scandinavian Journal of Statistics 39, 798).

use crate::integral::differential_evolution;
use crate::integral::line_profile;
use crate::integral::mixture::{Mixture, add_ln, standard_normals};
use crate::integral::profile_path;
use crate::integral::search::{self, Mode};
use crate::latent::bounded_from_normal;
use crate::likelihood::Likelihood;
use gumption_engine::distribution::StreamKey;
use gumption_engine::number::{COLUMN, Column, elementary, largest_first};

/// Draws of the prior from which the search starts.
const SCREENED: usize = 4;

/// Logarithms of two integrals of the same that differ by more than this cannot both be right.
pub const DISAGREE: f64 = 0.5;

/// Modes that are kept, at most.
const MOST_MODES: usize = 10;

/// An integral that is being refined.
#[derive(Clone, Debug)]
pub struct EvidenceEstimate {
    unknowns: usize,
    key: StreamKey,
    /// The modes found.
    pub modes: Vec<Mode>,
    mixtures: Vec<(Mixture, usize)>,
    /// Columns of drawn scores.
    pub columns: Vec<Vec<Column>>,
    /// For each draw the logarithm of prior density (without its constant) times likelihood.
    ln_targets: Vec<f64>,
    /// For each draw the logarithm of the sum over mixtures of columns drawn times density.
    ln_proposals: Vec<f64>,
    /// Normalized weights of the draws.
    pub weights: Vec<f64>,
    /// Logarithm of the evidence.
    pub ln_evidence: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// Effective number of draws.
    pub effective_sample_size: f64,
    /// How far the logarithm of an independent integral of the same is off; 0 where none was made.
    pub disagreement: f64,
}

impl EvidenceEstimate {
    /// Finds the modes and draws once from them. `seeds` are points to start from beside draws of
    /// the prior.
    pub fn begin(
        likelihood: &Likelihood<'_>,
        key: StreamKey,
        seeds: &[Vec<f64>],
        starts: usize,
    ) -> Self {
        let unknowns = likelihood.unknowns();
        let mut evidence = Self {
            unknowns,
            key,
            modes: Vec::new(),
            mixtures: Vec::new(),
            columns: Vec::new(),
            ln_targets: Vec::new(),
            ln_proposals: Vec::new(),
            weights: Vec::new(),
            ln_evidence: f64::NEG_INFINITY,
            standard_error: f64::INFINITY,
            effective_sample_size: 0.0,
            disagreement: 0.0,
        };
        let mut points = vec![vec![0.0; unknowns]];
        points.extend_from_slice(seeds);
        points.extend(evidence.screened(likelihood, starts));
        let found = search::modes(likelihood, &points, MOST_MODES);
        let resolved = line_profile::resolved(likelihood, found, MOST_MODES);
        evidence.modes = resolved.modes;
        let mixture = Mixture::at_modes(&likelihood.bounded(), &resolved.neighbourhoods);
        evidence.draw(likelihood, mixture, 2);
        evidence
    }

    /// Searches for modes from more points; where there is one that was not known, the neighbourhoods
    /// of all modes are drawn from again. Whether there was.
    pub(crate) fn explore(&mut self, likelihood: &Likelihood<'_>, seeds: &[Vec<f64>]) -> bool {
        let found = search::modes(likelihood, seeds, MOST_MODES);
        let resolved = line_profile::resolved(likelihood, found, MOST_MODES);
        let new = search::join(&mut self.modes, resolved.modes, MOST_MODES);
        if new {
            let all: Vec<Mode> =
                resolved.neighbourhoods.iter().chain(&self.modes).cloned().collect();
            let mixture = Mixture::at_modes(&likelihood.bounded(), &all);
            self.draw(likelihood, mixture, 2);
        }
        new
    }

    /// Takes notice of how far an independent integral of the same is off: beyond [`DISAGREE`] that
    /// is the standard error.
    pub(crate) fn disagrees_by(&mut self, difference: f64) {
        self.disagreement = difference;
        if difference > DISAGREE {
            self.standard_error = self.standard_error.max(difference);
        }
    }

    /// The most likely of draws of the prior, far from each other.
    fn screened(&self, likelihood: &Likelihood<'_>, starts: usize) -> Vec<Vec<f64>> {
        if self.unknowns == 0 || starts == 0 {
            return Vec::new();
        }
        let bounded = likelihood.bounded();
        let mut drawn: Vec<(f64, Vec<f64>)> = Vec::new();
        for block in 0..SCREENED {
            let mut stream = self.key.block(u64::MAX - block as u64);
            let mut scores = vec![Column::ZERO; self.unknowns];
            for (column, bounded) in scores.iter_mut().zip(&bounded) {
                standard_normals(&mut stream, column);
                if *bounded {
                    column.0 = column.0.map(bounded_from_normal);
                }
            }
            let likelihoods = likelihood.log_likelihood(&scores, COLUMN);
            drawn.extend(
                likelihoods
                    .iter()
                    .enumerate()
                    .map(|(lane, &ln)| (ln, scores.iter().map(|column| column.0[lane]).collect())),
            );
        }
        largest_first(&mut drawn, |a| a.0);
        let mut chosen: Vec<Vec<f64>> = Vec::new();
        let apart = 0.35 * (self.unknowns as f64).sqrt();
        for (ln, point) in drawn {
            let near = chosen.iter().any(|other| {
                let squares: f64 = point.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum();
                squares.sqrt() < apart
            });
            if !near && ln.is_finite() {
                chosen.push(point);
                if chosen.len() == starts {
                    break;
                }
            }
        }
        chosen
    }

    /// One more step: the proposal is adapted to what was drawn, and more is drawn from it.
    pub fn refine(&mut self, likelihood: &Likelihood<'_>, columns: usize) {
        let Some((last, _)) = self.mixtures.last() else { return };
        let mixture = last.adapted(&self.columns, &self.weights);
        self.draw(likelihood, mixture, columns);
    }

    /// Draws along the ridges of the posterior in the quantities after the first `shared` ones.
    pub(crate) fn along_profile_paths(&mut self, likelihood: &Likelihood<'_>, shared: usize) {
        if let Some(mixture) = profile_path::mixture(likelihood, &self.modes, shared) {
            self.draw(likelihood, mixture, 4);
            self.refine(likelihood, 4);
        }
    }

    /// Lets chains roam from what was drawn, and draws from a mixture fitted to where they went.
    pub(crate) fn sample_chains(&mut self, likelihood: &Likelihood<'_>, generations: usize) {
        if self.unknowns == 0 || self.effective_sample_size == 0.0 {
            return;
        }
        let drawn = self.resampled(COLUMN);
        let mut start = vec![Column::ZERO; self.unknowns];
        for (lane, draw) in drawn.iter().enumerate() {
            for (column, score) in start.iter_mut().zip(draw) {
                column.0[lane] = *score;
            }
        }
        let visited = differential_evolution::sample(likelihood, start, generations, self.key);
        let count = if self.unknowns > 2 { 12 } else { 6 };
        if let Some(mixture) = Mixture::fitted(&likelihood.bounded(), &visited, count) {
            self.draw(likelihood, mixture, 4);
        }
    }

    /// Draws of equal weight from a posterior: systematic resampling.
    pub fn resampled(&self, count: usize) -> Vec<Vec<f64>> {
        let mut draws = Vec::with_capacity(count);
        let mut sum = 0.0;
        let mut next = 0.5 / count as f64;
        for (place, weight) in self.weights.iter().enumerate() {
            sum += weight;
            while next < sum && draws.len() < count {
                let column = &self.columns[place / COLUMN];
                draws.push(column.iter().map(|scores| scores.0[place % COLUMN]).collect());
                next += 1.0 / count as f64;
            }
        }
        // rounding may leave the last one out
        while draws.len() < count {
            let Some(last) = draws.last().cloned() else { break };
            draws.push(last);
        }
        draws
    }

    /// The evidence alone, where what was drawn is of no use.
    pub(crate) fn without_draws(self) -> Self {
        Self {
            modes: Vec::new(),
            columns: Vec::new(),
            weights: Vec::new(),
            ln_targets: Vec::new(),
            ln_proposals: Vec::new(),
            ..self
        }
    }

    /// Adds draws of the same hypothesis with something else about it that is not known: weights
    /// times `share`. There are no more draws to be made then.
    pub(crate) fn append(&mut self, share: f64, columns: Vec<Vec<Column>>, weights: &[f64]) {
        self.columns.extend(columns);
        self.weights.extend(weights.iter().map(|weight| share * weight));
    }

    /// Multiplies the weights of all draws.
    pub(crate) fn scale_weights(&mut self, by: f64) {
        self.weights.iter_mut().for_each(|weight| *weight *= by);
    }

    /// Whether there are draws of the posterior.
    pub fn has_draws(&self) -> bool {
        self.weights.iter().any(|weight| *weight > 0.0)
    }

    /// Number of unknown quantities.
    pub fn unknowns(&self) -> usize {
        self.unknowns
    }

    fn draw(&mut self, likelihood: &Likelihood<'_>, mixture: Mixture, columns: usize) {
        let first = self.columns.len();
        let ln_count = elementary::ln(columns as f64);
        // the new mixture's density at the old draws
        for (scores, sums) in self.columns.iter().zip(self.ln_proposals.chunks_mut(COLUMN)) {
            add_ln(sums, &mixture.ln_density(scores), ln_count);
        }
        self.mixtures.push((mixture, columns));
        for number in 0..columns {
            let mut stream = self.key.block((first + number) as u64);
            let Some((mixture, _)) = self.mixtures.last() else { return };
            let scores = mixture.draw(&mut stream);
            let mut sums = [f64::NEG_INFINITY; COLUMN];
            for (mixture, columns) in &self.mixtures {
                let ln_count = elementary::ln(*columns as f64);
                add_ln(&mut sums, &mixture.ln_density(&scores), ln_count);
            }
            self.ln_proposals.extend(sums);
            self.ln_targets.extend(likelihood.log_target(&scores, COLUMN));
            self.columns.push(scores);
        }
        self.weigh();
    }

    fn weigh(&mut self) {
        let ln_total = elementary::ln(self.columns.len() as f64);
        let ln_weights: Vec<f64> = self
            .ln_targets
            .iter()
            .zip(&self.ln_proposals)
            .map(|(target, proposal)| target - proposal + ln_total)
            .collect();
        let most = ln_weights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let count = ln_weights.len() as f64;
        if !most.is_finite() {
            self.weights = vec![0.0; ln_weights.len()];
            self.ln_evidence = f64::NEG_INFINITY;
            return;
        }
        self.weights = ln_weights.iter().map(|ln| elementary::exp(ln - most)).collect();
        let sum: f64 = self.weights.iter().sum();
        let squares: f64 = self.weights.iter().map(|w| w * w).sum();
        self.ln_evidence = most + elementary::ln(sum / count);
        self.effective_sample_size = sum * sum / squares;
        self.standard_error = (1.0 / self.effective_sample_size - 1.0 / count).max(0.0).sqrt();
        self.disagrees_by(self.disagreement);
        for weight in &mut self.weights {
            *weight /= sum;
        }
    }
}
