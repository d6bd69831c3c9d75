//! What a simulator gives where posteriors are, learnt from runs at their draws alone.

use std::collections::BTreeMap;

use crate::axis::Coordinate;
use crate::focus::Focus;
use crate::layer::{Layer, Reach};
use crate::prediction::Prediction;
use crate::scatter::Scatter;
use crate::simulator_run::SimulatorRun;
use crate::space::Space;

/// What the outputs of all rows do within the posteriors of hypotheses: each hypothesis has one layer, which
/// learnt from runs at draws of its posterior and from nothing else. An [`Emulator`](crate::Emulator) knows
/// corrections over all of the prior and needs hundreds of runs; for other rows, where only predictions are
/// wanted, a few runs near each posterior are enough.
#[derive(Clone, Debug)]
pub struct PosteriorEmulator {
    space: Space,
    rows: usize,
    layers: BTreeMap<Vec<usize>, Layer>,
    scatter: Option<Scatter>,
}

impl PosteriorEmulator {
    /// One that knows nothing, of so many rows of all outputs together.
    pub fn new(space: Space, rows: usize) -> Self {
        Self { space, rows, layers: BTreeMap::new(), scatter: None }
    }

    /// The same of a simulator whose outputs scatter from run to run.
    #[must_use]
    pub fn with_scatter(self, scatter: Option<Scatter>) -> Self {
        Self { scatter, ..self }
    }

    /// Number of rows of all outputs together.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Whether there were runs of a hypothesis.
    pub fn knows(&self, effects: &[usize]) -> bool {
        self.layers.contains_key(effects)
    }

    /// Learns a hypothesis from runs about its posterior. Runs with an output that is no finite number or
    /// with another number of rows are left out; where none is left the hypothesis is not known.
    pub fn learn(&mut self, effects: &[usize], runs: &[SimulatorRun], focus: &Focus) {
        let is_usable = |run: &&SimulatorRun| {
            run.outputs.len() == self.rows && run.outputs.iter().all(|output| output.is_finite())
        };
        let usable: Vec<&SimulatorRun> = runs.iter().filter(is_usable).collect();
        if usable.is_empty() {
            return;
        }
        let point = |run: &&SimulatorRun| -> Vec<f64> {
            self.space.at_scores(effects, &run.scores).iter().map(|c| c.at).collect()
        };
        let points: Vec<Vec<f64>> = usable.iter().map(point).collect();
        let outputs: Vec<Vec<f64>> = usable.iter().map(|run| run.outputs.clone()).collect();
        let layer = Layer::learn(&points, &outputs, &Reach::Near(focus), self.scatter.as_ref());
        self.layers.insert(effects.to_vec(), layer);
    }

    /// The expected outputs of all rows at a point of a hypothesis; `None` of one that is not known.
    pub fn values(&self, effects: &[usize], point: &[Coordinate]) -> Option<Vec<f64>> {
        let mut values = vec![0.0; self.rows];
        self.layers.get(effects)?.add_values(point, 1.0, &mut values);
        Some(values)
    }

    /// The same with the gradient along the unknowns and standard deviations.
    pub fn predict(&self, effects: &[usize], point: &[Coordinate]) -> Option<Prediction> {
        let mut prediction = Prediction::zero(self.rows, point.len());
        let places: Vec<usize> = (0..point.len()).collect();
        self.layers.get(effects)?.add(point, &places, 1.0, &mut prediction);
        prediction.deviations.iter_mut().for_each(|variance| *variance = variance.sqrt());
        Some(prediction)
    }
}
