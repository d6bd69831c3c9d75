//! A simulator that is known by its runs: what it gives stands in the conditions of every row.
//!
//! The model of such a case is [`ModelForm::Simulated`](crate::ModelForm). Its last conditions are the outputs
//! of the simulator and the number of the row ([`simulator_conditions`]), so that formulas of effects, noises
//! and everything else find the outputs where they would find somebody else's simulation. What their values
//! are at the inputs and effects of a hypothesis says an emulator.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

use gumption_emulator::{Emulator, Prediction, Space};
use gumption_engine::model::Quantity;
use gumption_units::Unit;

/// A simulator in the place of a model's formulas.
#[derive(Debug)]
pub struct SimulatorModel {
    space: Space,
    pub(crate) learnt: Option<Learnt>,
    /// What the emulator says of the plain simulator at the inputs that were asked for last.
    plain: Mutex<VecDeque<(Vec<u64>, Arc<Prediction>)>>,
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
        Self { space, learnt: None, plain: Mutex::default() }
    }

    /// The same after runs.
    pub(crate) fn with(&self, emulator: Emulator, units: Vec<f64>) -> Self {
        let learnt = Some(Learnt { emulator, units });
        Self { space: self.space.clone(), learnt, plain: Mutex::default() }
    }

    /// What it is run with.
    pub fn space(&self) -> &Space {
        &self.space
    }

    /// The plain simulator at values of all inputs, in the units of its outputs, with derivatives by those that
    /// vary; `None` before any run.
    pub(crate) fn plain_at(&self, inputs: &[f64]) -> Option<Arc<Prediction>> {
        let learnt = self.learnt.as_ref()?;
        let key: Vec<u64> = inputs.iter().map(|value| value.to_bits()).collect();
        let mut kept = self.plain.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, plain)) = kept.iter().find(|(known, _)| *known == key) {
            return Some(Arc::clone(plain));
        }
        let plain = Arc::new(learnt.plain(&self.space, inputs));
        if kept.len() == KEPT {
            kept.pop_front();
        }
        kept.push_back((key, Arc::clone(&plain)));
        Some(plain)
    }

    /// The emulator, once there were runs.
    pub fn emulator(&self) -> Option<&Emulator> {
        self.learnt.as_ref().map(|learnt| &learnt.emulator)
    }
}

impl Learnt {
    /// The plain simulator at values of all inputs, in the units of its outputs, with derivatives by those
    /// that vary.
    fn plain(&self, space: &Space, inputs: &[f64]) -> Prediction {
        let values: Vec<f64> = space.unknowns(&[]).into_iter().map(|place| inputs[place]).collect();
        let mut there = self.emulator.predict(&[], &space.at_values(&[], &values));
        for column in there.gradient.iter_mut().chain([&mut there.values]) {
            column.iter_mut().zip(&self.units).for_each(|(value, unit)| *value *= unit);
        }
        there
    }
}
