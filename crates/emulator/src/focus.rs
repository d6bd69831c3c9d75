//! Where the posterior of a hypothesis is.

use gumption_engine::linalg::dot;
use gumption_engine::linalg::packed;
use gumption_engine::number::smallest_first;

use crate::simulator_run::SimulatorRun;
use crate::space::Space;

/// The variance that is added along each scaled coordinate: a posterior of no width is one of about 0.01
/// standard deviations of the prior.
const LEAST_VARIANCE: f64 = 2e-5;

/// A posterior is narrow where the standard deviations of all normal scores of its effects are below this.
const NARROW: f64 = 0.3;

/// A local layer learns from so many runs for each unknown.
const NEAREST: usize = 6;

/// And from so many at least.
const LEAST_NEAREST: usize = 20;

/// How many runs a local layer of so many unknowns learns from.
pub(crate) fn nearest_count(unknowns: usize) -> usize {
    (NEAREST * unknowns).max(LEAST_NEAREST)
}

/// The place and the scale of a posterior.
#[derive(Clone, Debug, PartialEq)]
pub struct Focus {
    centre: Vec<f64>,
    /// The Cholesky root of the covariance, a packed lower triangle.
    root: Vec<f64>,
    narrow: bool,
}

impl Focus {
    /// Of draws of the scores of a hypothesis' unknowns, with weights that sum to one.
    pub fn of(space: &Space, effects: &[usize], draws: &[Vec<f64>], weights: &[f64]) -> Self {
        let points: Vec<Vec<f64>> = draws
            .iter()
            .map(|scores| space.at_scores(effects, scores).iter().map(|c| c.at).collect())
            .collect();
        let dimensions = space.unknowns(effects).len();
        let mean = |of: &[Vec<f64>], j: usize| weighted(weights, of.iter().map(|p| p[j]));
        let centre: Vec<f64> = (0..dimensions).map(|j| mean(&points, j)).collect();
        let mut root = Vec::new();
        for i in 0..dimensions {
            for j in 0..=i {
                let products = points.iter().map(|p| (p[i] - centre[i]) * (p[j] - centre[j]));
                let least = if i == j { LEAST_VARIANCE } else { 0.0 };
                root.push(weighted(weights, products) + least);
            }
        }
        packed::cholesky_of_definite(&mut root);
        let places = space.effect_unknowns(effects);
        let narrow = !places.is_empty()
            && places.into_iter().all(|j| {
                let middle = mean(draws, j);
                let squares = draws.iter().map(|z| (z[j] - middle) * (z[j] - middle));
                weighted(weights, squares) < NARROW * NARROW
            });
        Self { centre, root, narrow }
    }

    /// Whether the posterior is much narrower than the prior in every parameter of its effects, so that a
    /// layer of its own may forget what is far from it. One as wide as the prior needs a layer that knows all
    /// of it.
    pub fn is_narrow(&self) -> bool {
        self.narrow
    }

    /// Parts runs into those to learn from and those that then tell the error at the posterior: every third of
    /// the runs that a local layer learns from.
    pub fn parted(
        &self,
        space: &Space,
        effects: &[usize],
        runs: Vec<SimulatorRun>,
    ) -> (Vec<SimulatorRun>, Vec<SimulatorRun>) {
        let point = |run: &SimulatorRun| -> Vec<f64> {
            space.at_scores(effects, &run.scores).iter().map(|c| c.at).collect()
        };
        let points: Vec<Vec<f64>> = runs.iter().map(point).collect();
        let near = self.nearest(&points, nearest_count(self.centre.len()));
        let held: Vec<usize> = near.into_iter().skip(2).step_by(3).collect();
        let mut parts = (Vec::new(), Vec::new());
        for (place, run) in runs.into_iter().enumerate() {
            if held.contains(&place) { parts.1.push(run) } else { parts.0.push(run) }
        }
        parts
    }

    /// The places of the points that are nearest to the posterior in its own scale (the distance of
    /// Mahalanobis), the nearest first.
    pub(crate) fn nearest(&self, points: &[Vec<f64>], count: usize) -> Vec<usize> {
        let distance = |point: &[f64]| {
            let mut from: Vec<f64> = point.iter().zip(&self.centre).map(|(a, b)| a - b).collect();
            packed::solve(&self.root, &mut from);
            dot(&from, &from)
        };
        let mut places: Vec<usize> = (0..points.len()).collect();
        let distances: Vec<f64> = points.iter().map(|point| distance(point)).collect();
        smallest_first(&mut places, |&place| distances[place]);
        places.truncate(count);
        places
    }
}

fn weighted(weights: &[f64], values: impl Iterator<Item = f64>) -> f64 {
    weights.iter().zip(values).map(|(weight, value)| weight * value).sum()
}
