//! What an inference found of a hypothesis with the emulator as it is.

use gumption_engine::distribution::StreamKey;

use crate::focus::Focus;
use crate::space::Space;
use crate::step::Batch;
use crate::uniforms::Uniforms;

/// The posterior of a hypothesis.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Its effects, in ascending order.
    pub effects: Vec<usize>,
    /// The logarithm of prior probability times evidence.
    pub score: f64,
    /// The scores of its unknowns where the posterior density is greatest.
    pub mode: Vec<f64>,
    /// Draws of the scores from the posterior; at least one.
    pub draws: Vec<Vec<f64>>,
    /// Their weights, which sum to one.
    pub weights: Vec<f64>,
}

impl State {
    /// The mode and draws of the posterior as runs, so many in all at most; the draws follow from the key and
    /// the number of the stream.
    pub fn batch(&self, space: &Space, count: usize, key: StreamKey, stream: u64) -> Batch {
        let mut random = Uniforms::new(key, stream);
        let mut weights = self.weights.clone();
        let mut scores = vec![self.mode.clone()];
        for _ in 1..count {
            // each draw once, as a run that was made tells nothing new
            let Some(place) = random.place(&weights) else { break };
            weights[place] = 0.0;
            scores.push(self.draws[place].clone());
        }
        let focus = Focus::of(space, &self.effects, &self.draws, &self.weights);
        Batch { effects: self.effects.clone(), scores, focus: Some(focus) }
    }
}
