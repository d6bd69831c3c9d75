//! The emulator: a sum of layers.

use std::collections::BTreeMap;

use gumption_engine::linalg::add_multiple;

use crate::axis::Coordinate;
use crate::correction::Correction;
use crate::focus::Focus;
use crate::joint_sum::JointSum;
use crate::layer::{Layer, Reach};
use crate::prediction::Prediction;
use crate::scatter::Scatter;
use crate::simulator_run::SimulatorRun;
use crate::singular::SingularVectors;
use crate::space::Space;
use crate::unseen::UnseenError;

/// Runs with outputs beyond this, in u, tell nothing of where the data are.
const FARTHEST: f64 = 1e5;

/// What came of learning from runs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Learnt {
    /// The errors on these runs before they were learnt from; `None` where no run could be learnt from, or
    /// nothing was known of the hypothesis: of one effect before its first runs.
    pub unseen: Option<UnseenError>,
    /// How many runs were left out: with an output that is no number or beyond 100 000 u, or with another
    /// number of rows.
    pub left_out: usize,
}

/// What the outputs of all rows do as the parameters of a simulator move: the sum of the corrections of all
/// sets of the effects of a hypothesis. Without effects this is the plain simulator f0(x); with one a correction
/// is added, f0 + D_a; with two those of both and an interaction, f0 + D_a + D_b + I_ab, which is zero until
/// runs of the pair tell it. More effects go on like this.
///
/// ```
/// use gumption_emulator::{Emulator, Parameter, SimulatorEffect, SimulatorRun, Space};
/// use gumption_emulator::space_filling_scores;
/// use gumption_engine::distribution::{Normal, Rectangular, StreamKey};
///
/// let length = Parameter { name: "length".into(), prior: Normal::new(0.5, 0.01)?.into() };
/// let drag = Parameter { name: "drag".into(), prior: Rectangular::between(0.0, 0.2)?.into() };
/// let effect = SimulatorEffect { name: "air".into(), parameters: vec![drag], neutral: vec![(0, 0.0)] };
/// let space = Space::new(vec![length], vec![effect])?;
/// // ten rows, in units of 0.01
/// let simulator = |p: &[f64]| -> Vec<f64> {
///     (0..10).map(|t| 100.0 * (p[0] + p[1] * f64::from(t) / 10.0)).collect()
/// };
/// let mut emulator = Emulator::new(space.clone(), 10);
/// for (effects, count) in [(vec![], 8), (vec![0], 12)] {
///     let d = space.unknowns(&effects).len();
///     let runs = space_filling_scores(count, d, StreamKey::new(1, "start")).into_iter();
///     let runs: Vec<SimulatorRun> = runs
///         .map(|scores| SimulatorRun { outputs: simulator(&space.values(&effects, &scores)), scores })
///         .collect();
///     emulator.learn(&effects, &runs, None);
/// }
/// let there = emulator.predict(&[0], &space.at_values(&[0], &[0.503, 0.13]));
/// assert!((there.values[9] - simulator(&[0.503, 0.13])[9]).abs() < 0.05);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Emulator {
    space: Space,
    rows: usize,
    /// What was run of each hypothesis.
    known: BTreeMap<Vec<usize>, Known>,
    scatter: Option<Scatter>,
}

/// Directions that differ by less than this are one.
const SAME: f64 = 1e-6;

#[derive(Clone, Debug, Default)]
struct Known {
    /// Scaled coordinates.
    points: Vec<Vec<f64>>,
    outputs: Vec<Vec<f64>>,
    focus: Option<Focus>,
    correction: Option<Correction>,
    unseen: Option<UnseenError>,
}

impl Emulator {
    /// One that knows nothing, of so many rows of all outputs together.
    pub fn new(space: Space, rows: usize) -> Self {
        Self { space, rows, known: BTreeMap::new(), scatter: None }
    }

    /// The same of a simulator whose outputs scatter from run to run: it learns their mean.
    #[must_use]
    pub fn with_scatter(self, scatter: Option<Scatter>) -> Self {
        Self { scatter, ..self }
    }

    /// How the simulator's outputs scatter, if they do.
    pub fn scatter(&self) -> Option<&Scatter> {
        self.scatter.as_ref()
    }

    /// The parameters.
    pub fn space(&self) -> &Space {
        &self.space
    }

    /// Number of rows of all outputs together.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Learns from runs of a hypothesis, and where its posterior is if that is known: what the
    /// hypothesis adds, then what all those add that have more effects.
    pub fn learn(
        &mut self,
        effects: &[usize],
        runs: &[SimulatorRun],
        focus: Option<Focus>,
    ) -> Learnt {
        let is_near = |run: &&SimulatorRun| {
            run.outputs.len() == self.rows
                && run.outputs.iter().all(|output| output.abs() <= FARTHEST)
        };
        let usable: Vec<&SimulatorRun> = runs.iter().filter(is_near).collect();
        let was_known = self.correction(effects).is_some();
        let points = usable.iter().map(|run| self.space.at_scores(effects, &run.scores));
        let points: Vec<Vec<Coordinate>> = points.collect();
        let errors: Vec<Vec<f64>> = usable
            .iter()
            .zip(&points)
            .map(|(run, point)| difference(&run.outputs, &self.values(effects, point)))
            .collect();
        let known = self.known.entry(effects.to_vec()).or_default();
        for (run, point) in usable.iter().zip(&points) {
            known.points.push(point.iter().map(|coordinate| coordinate.at).collect());
            known.outputs.push(run.outputs.clone());
        }
        if focus.is_some() {
            known.focus = focus;
        }
        let holds = |of: &Vec<usize>| effects.iter().all(|effect| of.contains(effect));
        let mut above: Vec<Vec<usize>> =
            self.known.keys().filter(|of| holds(of)).cloned().collect();
        above.sort_by_key(Vec::len);
        for of in above {
            self.learn_correction(&of);
        }
        let mut learnt = Learnt { unseen: None, left_out: runs.len() - usable.len() };
        // without runs a pair is known by superposition, a single effect not at all
        if !errors.is_empty() && (was_known || effects.len() > 1) {
            learnt.unseen = Some(self.unseen_error(effects, &points, &errors));
            if let Some(known) = self.known.get_mut(effects) {
                known.unseen.clone_from(&learnt.unseen);
            }
        }
        learnt
    }

    /// What the errors on runs at some points tell.
    fn unseen_error(
        &self,
        effects: &[usize],
        points: &[Vec<Coordinate>],
        errors: &[Vec<f64>],
    ) -> UnseenError {
        let Some(scatter) = &self.scatter else { return UnseenError::of(errors) };
        // the mean may be wrong in the directions in which it varies at the first run, which is the mode
        let vectors = self.serving(effects, &points[0]);
        let vectors = vectors.flat_map(|(_, _, layer)| layer.directions().to_vec());
        let directions = SingularVectors::of(&vectors.collect::<Vec<_>>(), SAME);
        let scattered = points.iter().flat_map(|point| {
            self.serving(effects, point)
                .flat_map(|(own, share, layer)| layer.scattered(&own, share))
        });
        UnseenError::of_mean(errors, &directions, scattered.collect(), scatter)
    }

    /// The layers that serve at a point of a hypothesis, each with its part of the point and its share.
    fn serving(
        &self,
        effects: &[usize],
        point: &[Coordinate],
    ) -> impl Iterator<Item = (Vec<Coordinate>, f64, &Layer)> {
        self.terms(effects, true).flat_map(move |(places, term)| {
            let own: Vec<Coordinate> = places.iter().map(|&place| point[place]).collect();
            let serving: Vec<(f64, &Layer)> = term.serving(&own).collect();
            serving.into_iter().map(move |(share, layer)| (own.clone(), share, layer))
        })
    }

    /// The standard deviations that the scatter of the runs leaves in the mean of each row, in u; `None` of a
    /// simulator without scatter, or of which nothing is known. It is that of the mean of the plain simulator's
    /// runs; what corrections leave is along their singular vectors.
    pub fn left_by_scatter(&self) -> Option<Vec<f64>> {
        let scatter = self.scatter.as_ref()?;
        let plain = self.correction(&[])?.everywhere().runs();
        Some(scatter.of_mean(self.rows, plain))
    }

    fn learn_correction(&mut self, effects: &[usize]) {
        let Some(known) = self.known.get(effects).filter(|known| !known.points.is_empty()) else {
            return;
        };
        let corrections: Vec<Vec<f64>> = known
            .points
            .iter()
            .zip(&known.outputs)
            .map(|(point, outputs)| {
                let point: Vec<Coordinate> =
                    point.iter().map(|&at| Coordinate { at, slope: 0.0 }).collect();
                let mut below = vec![0.0; self.rows];
                self.add_values(effects, &point, false, &mut below);
                difference(outputs, &below)
            })
            .collect();
        let reach = match effects {
            [] => Reach::Plain,
            _ => Reach::Zero(self.space.free_points(effects)),
        };
        let focus = known.focus.as_ref();
        let correction =
            Correction::learn(&known.points, &corrections, &reach, focus, self.scatter.as_ref());
        if let Some(known) = self.known.get_mut(effects) {
            known.correction = Some(correction);
        }
    }

    /// What a hypothesis adds to those with fewer effects, if it was run.
    pub fn correction(&self, effects: &[usize]) -> Option<&Correction> {
        self.known.get(effects)?.correction.as_ref()
    }

    /// The hypotheses that were run.
    pub fn hypotheses(&self) -> impl Iterator<Item = &[usize]> {
        self.known.keys().map(Vec::as_slice)
    }

    /// The errors on the runs of a hypothesis that were learnt last, before they were: what they leave counts
    /// as an uncertainty of the simulator.
    pub fn unseen(&self, effects: &[usize]) -> Option<&UnseenError> {
        self.known.get(effects)?.unseen.as_ref()
    }

    /// The corrections of the sets of effects of a hypothesis, each with the places of its unknowns among
    /// those of the hypothesis; that of the whole set only if it is asked for.
    fn terms(
        &self,
        effects: &[usize],
        whole: bool,
    ) -> impl Iterator<Item = (Vec<usize>, &Correction)> {
        let unknowns = self.space.unknowns(effects);
        let known = self.known.iter().filter(move |(of, _)| {
            of.iter().all(|effect| effects.contains(effect)) && (whole || of.len() < effects.len())
        });
        known.filter_map(move |(of, known)| {
            let own = self.space.unknowns(of);
            let place = |own: &usize| unknowns.iter().position(|unknown| unknown == own);
            Some((own.iter().filter_map(place).collect(), known.correction.as_ref()?))
        })
    }

    fn add_values(&self, effects: &[usize], point: &[Coordinate], whole: bool, values: &mut [f64]) {
        for (places, term) in self.terms(effects, whole) {
            let own: Vec<Coordinate> = places.iter().map(|&place| point[place]).collect();
            term.add_values(&own, values);
        }
    }

    /// The expected outputs of all rows at a point of a hypothesis, in u.
    pub fn values(&self, effects: &[usize], point: &[Coordinate]) -> Vec<f64> {
        let mut values = vec![0.0; self.rows];
        self.add_values(effects, point, true, &mut values);
        values
    }

    /// The same at many points, to the bit.
    pub fn values_at(&self, effects: &[usize], points: &[Vec<Coordinate>]) -> Vec<Vec<f64>> {
        let mut sum = JointSum::new(points.len());
        for (places, term) in self.terms(effects, true) {
            let own = |point: &Vec<Coordinate>| -> Vec<Coordinate> {
                places.iter().map(|&place| point[place]).collect()
            };
            let own: Vec<Vec<Coordinate>> = points.iter().map(own).collect();
            term.add_jointly(&own, &mut sum);
        }
        sum.values(self.rows)
    }

    /// The outputs of all rows at a point of a hypothesis, with gradient and standard deviations.
    pub fn predict(&self, effects: &[usize], point: &[Coordinate]) -> Prediction {
        let mut prediction = Prediction::zero(self.rows, point.len());
        for (places, term) in self.terms(effects, true) {
            let own: Vec<Coordinate> = places.iter().map(|&place| point[place]).collect();
            term.add(&own, &places, &mut prediction);
        }
        prediction.deviations.iter_mut().for_each(|variance| *variance = variance.sqrt());
        prediction
    }
}

fn difference(of: &[f64], from: &[f64]) -> Vec<f64> {
    let mut difference = of.to_vec();
    add_multiple(&mut difference, -1.0, from);
    difference
}
