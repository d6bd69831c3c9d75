//! A simulator that is known by its runs: what it gives stands in the conditions of every row.
//!
//! The model of such a case is [`ModelForm::Simulated`](crate::ModelForm). Its last conditions are the outputs
//! of the simulator and the number of the row ([`simulator_conditions`]), so that formulas of effects, noises
//! and everything else find the outputs where they would find somebody else's simulation. What their values
//! are at the inputs and effects of a hypothesis says an emulator.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

use gumption_emulator::{Coordinate, Emulator, PosteriorEmulator, Prediction, Space};
use gumption_engine::model::Quantity;
use gumption_units::Unit;

/// A simulator in the place of a model's formulas.
#[derive(Debug)]
pub struct SimulatorModel {
    space: Space,
    noisy: bool,
    pub(crate) learnt: Option<Arc<Learnt>>,
    pub(crate) elsewhere: Option<Elsewhere>,
    /// The inputs at which it is linear, beside departures; the estimates where there are none.
    pub(crate) linear_at: Option<LinearAt>,
    /// What the emulators say of the plain simulator at the inputs that were asked for last.
    plain: Mutex<VecDeque<(Vec<u64>, Arc<Prediction>)>>,
}

/// Inputs at which a model is linear.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearAt {
    /// The values of all inputs.
    pub(crate) values: Vec<f64>,
    /// The places of those that are unknown quantities, each with its score.
    pub(crate) scores: Vec<(usize, f64)>,
}

/// So many inputs are kept with what the plain simulator gives.
const KEPT: usize = 16;

/// An emulator of a simulator's outputs, and what they are counted in.
#[derive(Debug)]
pub(crate) struct Learnt {
    pub(crate) emulator: Emulator,
    /// The size of u by value, in the unit of the simulator's output: output after output.
    pub(crate) units: Vec<f64>,
}

/// What a simulator gives in other rows than those of the data.
#[derive(Clone, Debug)]
pub(crate) struct Elsewhere {
    pub(crate) emulator: PosteriorEmulator,
    /// The size of u by value, in the unit of the simulator's output: output after output.
    pub(crate) units: Vec<f64>,
}

/// The name of the condition that numbers the rows; no formula can use it.
const ROW: &str = "number of the row";

/// The conditions that hold what a simulator gives: its outputs, each called like the output of the model
/// that it is, and the number of the row, from 0.
pub fn simulator_conditions(outputs: impl IntoIterator<Item = Quantity>) -> Vec<Quantity> {
    let about = String::new();
    let row = Quantity { name: ROW.to_owned(), unit: Unit::one(), about };
    outputs.into_iter().chain([row]).collect()
}

impl SimulatorModel {
    /// One that was never run. `space` are its parameters: all inputs of the model in their order, then those
    /// of the candidates that it can do by itself.
    pub fn new(space: Space) -> Self {
        Self {
            space,
            noisy: false,
            learnt: None,
            elsewhere: None,
            linear_at: None,
            plain: Mutex::default(),
        }
    }

    /// The same, of which is said whether its outputs scatter from run to run at the same parameters.
    #[must_use]
    pub fn noisy(self, noisy: bool) -> Self {
        Self { noisy, ..self }
    }

    /// Whether its outputs scatter from run to run.
    pub fn is_noisy(&self) -> bool {
        self.noisy
    }

    /// The same that was never run.
    fn without_runs(&self) -> Self {
        Self::new(self.space.clone()).noisy(self.noisy)
    }

    /// The same after runs.
    pub(crate) fn with(
        &self,
        emulator: Emulator,
        units: Vec<f64>,
        linear_at: Option<LinearAt>,
    ) -> Self {
        let learnt = Some(Arc::new(Learnt { emulator, units }));
        Self { learnt, linear_at, ..self.without_runs() }
    }

    /// The same after runs in other rows as well.
    pub(crate) fn with_elsewhere(&self, emulator: PosteriorEmulator, units: Vec<f64>) -> Self {
        let elsewhere = Some(Elsewhere { emulator, units });
        let linear_at = self.linear_at.clone();
        Self { learnt: self.learnt.clone(), elsewhere, linear_at, ..self.without_runs() }
    }

    /// What it is run with.
    pub fn space(&self) -> &Space {
        &self.space
    }

    /// The plain simulator at values of all inputs, in the units of its outputs, with derivatives by those that
    /// vary: in the rows of the data, then in the others. `None` before any run.
    pub(crate) fn plain_at(&self, inputs: &[f64]) -> Option<Arc<Prediction>> {
        let learnt = self.learnt.as_ref()?;
        let key: Vec<u64> = inputs.iter().map(|value| value.to_bits()).collect();
        let mut kept = self.plain.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, plain)) = kept.iter().find(|(known, _)| *known == key) {
            return Some(Arc::clone(plain));
        }
        let mut plain = learnt.plain(&self.space, inputs);
        if let Some(elsewhere) = &self.elsewhere {
            let there = elsewhere.plain(&self.space, inputs);
            plain.values.extend(there.values);
            for (column, other) in plain.gradient.iter_mut().zip(there.gradient) {
                column.extend(other);
            }
        }
        let plain = Arc::new(plain);
        if kept.len() == KEPT {
            kept.pop_front();
        }
        kept.push_back((key, Arc::clone(&plain)));
        Some(plain)
    }

    /// The emulator, once there were runs.
    pub fn emulator(&self) -> Option<&Emulator> {
        self.learnt.as_deref().map(|learnt| &learnt.emulator)
    }
}

impl Learnt {
    /// The plain simulator at values of all inputs, in the units of its outputs, with derivatives by those
    /// that vary.
    fn plain(&self, space: &Space, inputs: &[f64]) -> Prediction {
        in_units(self.emulator.predict(&[], &plain_point(space, inputs)), &self.units)
    }
}

impl Elsewhere {
    /// The same; no numbers where nothing is known of the plain simulator.
    fn plain(&self, space: &Space, inputs: &[f64]) -> Prediction {
        let point = plain_point(space, inputs);
        let there = self.emulator.predict(&[], &point);
        let unknown = || Prediction {
            values: vec![f64::NAN; self.units.len()],
            gradient: vec![vec![f64::NAN; self.units.len()]; point.len()],
            deviations: Vec::new(),
        };
        in_units(there.unwrap_or_else(unknown), &self.units)
    }
}

/// The unknown inputs of the plain simulator at values of all inputs.
fn plain_point(space: &Space, inputs: &[f64]) -> Vec<Coordinate> {
    let values: Vec<f64> = space.unknowns(&[]).into_iter().map(|place| inputs[place]).collect();
    space.at_values(&[], &values)
}

/// Values and gradients that are counted in u, in the units of the outputs.
fn in_units(mut there: Prediction, units: &[f64]) -> Prediction {
    for column in there.gradient.iter_mut().chain([&mut there.values]) {
        column.iter_mut().zip(units).for_each(|(value, unit)| *value *= unit);
    }
    there
}
