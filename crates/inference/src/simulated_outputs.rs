//! What a simulator gives in the rows of a case, as its emulator has it.

use std::collections::BTreeMap;
use std::sync::Arc;

use gumption_emulator::{Coordinate, Emulator, PosteriorEmulator, Prediction, Space};
use gumption_engine::model::variables;
use gumption_engine::number::{Column, elementary, median};
use gumption_engine::task::Row;

use crate::latent::Role;
use crate::simulator::{Elsewhere, Learnt, LinearAt, SimulatorModel};
use crate::{Candidate, Case};

impl Case {
    /// The same after runs of its simulator: `emulator` says what the outputs of all rows are, output after
    /// output, counted in `units` as [`Case::simulator_units`] has them; beside departures they are linear at
    /// `linear_at`, or at the estimates. What a scatter of the runs leaves in every row counts as an uncertainty
    /// of the simulation. `None` in a case without a simulator or with another number of values.
    pub fn emulated(
        &self,
        emulator: Emulator,
        units: Vec<f64>,
        linear_at: Option<LinearAt>,
    ) -> Option<Self> {
        let simulator = self.simulator.as_ref()?;
        let rows = self.task.rows.len();
        let values = (self.simulated - 1) * rows;
        if emulator.rows() != values || units.len() != values {
            return None;
        }
        let mut case = self.clone();
        let left = emulator.left_by_scatter();
        let left = left.map(|left| left.iter().zip(&units).map(|(u, unit)| u * unit).collect());
        let simulator = Arc::new(simulator.with(emulator, units, linear_at));
        case.simulator = Some(Arc::clone(&simulator));
        let first = self.described();
        for (number, row) in case.task.rows.iter_mut().enumerate() {
            let variables = row.estimates();
            let plain = simulator.plain_at(&variables[..simulator.space().inputs()])?;
            for (place, value) in values_of_row(self, number).enumerate() {
                row.conditions[first + place] = plain.values[value];
            }
        }
        if let Some(left) = left {
            case.add_uncertainties(left);
        }
        Some(case)
    }

    /// Adds to the uncertainties of the simulation those of a simulator's outputs, output after output in their
    /// units, which are independent.
    fn add_uncertainties(&mut self, of_simulator: Vec<f64>) {
        let rows = self.task.rows.len();
        let slopes: Vec<Vec<Vec<f64>>> = (0..rows).map(|row| self.slopes(row)).collect();
        for (output, observed) in self.observed.iter_mut().enumerate() {
            let Some(observed) = observed else { continue };
            let of_row = |(row, slopes): (usize, &Vec<Vec<f64>>)| {
                let parts = slopes[output].iter().enumerate();
                parts.fold(0.0, |sum, (place, slope)| {
                    elementary::hypot(sum, slope * of_simulator[place * rows + row])
                })
            };
            let mut own: Vec<f64> = slopes.iter().enumerate().map(of_row).collect();
            if let Some(before) = &observed.simulation_uncertainties {
                own.iter_mut()
                    .zip(before)
                    .for_each(|(u, other)| *u = elementary::hypot(*u, *other));
            }
            observed.simulation_uncertainties = Some(own);
        }
    }

    /// The same after runs of its simulator in other rows, and these rows with what it gives there at the
    /// estimates. `emulator` says what the outputs of all of them are, output after output, in u of the data:
    /// of each output the median. `None` in a case without an emulator, or with another number of values.
    pub fn elsewhere(
        &self,
        emulator: PosteriorEmulator,
        mut rows: Vec<Row>,
    ) -> Option<(Self, Vec<Row>)> {
        let simulator = self.simulator.as_ref()?;
        simulator.emulator()?;
        let outputs = self.simulated - 1;
        if emulator.rows() != outputs * rows.len() {
            return None;
        }
        let units = self.units_elsewhere().into_iter();
        let units = units.flat_map(|unit| vec![unit; rows.len()]).collect();
        let mut case = self.clone();
        case.simulator = Some(Arc::new(simulator.with_elsewhere(emulator, units)));
        let (first, before) = (self.described(), self.task.rows.len());
        for (number, row) in rows.iter_mut().enumerate() {
            row.conditions.resize(first, f64::NAN);
            row.conditions.resize(first + outputs, f64::NAN);
            row.conditions.push((before + number) as f64);
            let values = case.evaluated_simulator(row)?;
            row.conditions[first..first + outputs].copy_from_slice(&values);
        }
        Some((case, rows))
    }

    /// Whether these effects can be predicted: after runs of a simulator in other rows, whether these were made
    /// with them; always else.
    pub fn can_predict(&self, effects: &[usize]) -> bool {
        let elsewhere = self.simulator.as_ref().and_then(|simulator| simulator.elsewhere.as_ref());
        elsewhere.is_none_or(|of| of.emulator.knows(&self.simulator_effects(effects)))
    }

    /// What the simulator gives in a row at the estimates.
    fn evaluated_simulator(&self, row: &Row) -> Option<Vec<f64>> {
        let there = self.simulated_at(&row.estimates())?;
        let outputs = there.first..there.first + there.values.len();
        Some(there.variables[outputs].to_vec())
    }

    /// For each output of a simulator what its values in other rows than those of the data are counted in, in
    /// its unit: the median of what they are counted in there.
    pub fn units_elsewhere(&self) -> Vec<f64> {
        let rows = self.task.rows.len().max(1);
        let units = self.simulator_units();
        units.chunks(rows).map(|own| median(own.to_vec()).unwrap_or(1.0)).collect()
    }

    /// What the outputs of a simulator are counted in, for each value of a run: the standard uncertainty of the
    /// measured value, in the simulator's unit. Where it is not stated it is taken to be what neighbouring
    /// values depart from straight lines by.
    pub fn simulator_units(&self) -> Vec<f64> {
        let rows = self.task.rows.len();
        let slopes: Vec<Vec<Vec<f64>>> = (0..rows).map(|row| self.slopes(row)).collect();
        let mut units = Vec::with_capacity(rows * self.simulated);
        for place in 0..self.simulated.saturating_sub(1) {
            let name = &self.model.conditions[self.described() + place].name;
            let output = self.model.outputs.iter().position(|o| o.quantity.name == *name);
            let observed =
                output.and_then(|output| Some((output, self.observed[output].as_ref()?)));
            let Some((output, observed)) = observed else {
                units.extend(vec![1.0; rows]);
                continue;
            };
            let estimated = || vec![scatter(&observed.values); rows];
            let u = observed.standard_uncertainties.clone().unwrap_or_else(estimated);
            units.extend(u.iter().zip(&slopes).map(|(u, slopes)| u / slopes[output][place].abs()));
        }
        units
    }

    /// The effects of the simulator among candidates, in ascending order.
    pub fn simulator_effects(&self, effects: &[usize]) -> Vec<usize> {
        let own = |&effect: &usize| self.candidates[effect].simulator;
        let mut effects: Vec<usize> = effects.iter().filter_map(own).collect();
        effects.sort_unstable();
        effects
    }

    /// The outputs of the model without any effect, and for each output its derivatives with respect to the
    /// variables. `variables` are those of the program: inputs, then conditions. What the simulator gives is
    /// its emulator's word, whatever the conditions say.
    pub fn gradients(&self, variables: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let program = &self.task.model.program;
        let Some(there) = self.simulated_at(variables) else { return program.gradients(variables) };
        let (outputs, mut gradients) = program.gradients(&there.variables);
        let unknowns = there.simulator.space().unknowns(&[]);
        for gradient in &mut gradients {
            for (place, &value) in there.values.iter().enumerate() {
                let slope = gradient[there.first + place];
                for (&input, column) in unknowns.iter().zip(&there.plain.gradient) {
                    gradient[input] += slope * column.get(value).copied().unwrap_or(f64::NAN);
                }
            }
        }
        (outputs, gradients)
    }

    /// The outputs of the model without any effect, as [`Case::gradients`] has them.
    pub fn evaluate(&self, variables: &[f64]) -> Vec<f64> {
        let program = &self.task.model.program;
        match self.simulated_at(variables) {
            Some(there) => program.evaluate(&there.variables),
            None => program.evaluate(variables),
        }
    }

    /// What the plain simulator gives in a row, of a case with an emulator.
    fn simulated_at(&self, variables: &[f64]) -> Option<SimulatedAt<'_>> {
        let simulator = self.simulator.as_deref()?;
        let plain = simulator.plain_at(&variables[..simulator.space().inputs()])?;
        let first = self.first_simulated();
        let values: Vec<usize> = values_of_row(self, row_of(self, variables)).collect();
        let mut variables = variables.to_vec();
        for (place, &value) in values.iter().enumerate() {
            variables[first + place] = plain.values.get(value).copied().unwrap_or(f64::NAN);
        }
        Some(SimulatedAt { simulator, plain, variables, first, values })
    }

    /// The place among the program's variables of the first output of the simulator.
    pub(crate) fn first_simulated(&self) -> usize {
        self.task.variables.len() + self.described()
    }

    /// What the emulator does not know of the outputs, for each list of effects of the simulator that was run:
    /// columns of a factor of the covariance by value of the data, in the units of the model's outputs. Empty
    /// in a case without an emulator.
    /// `ids` are the places of the rows of the data among those of the case, `outputs` those of the observed
    /// outputs.
    pub(crate) fn unseen(
        &self,
        ids: &[usize],
        outputs: &[usize],
    ) -> BTreeMap<Vec<usize>, Vec<Vec<f64>>> {
        let simulator = self.simulator.as_ref();
        let Some(learnt) = simulator.and_then(|simulator| simulator.learnt.as_ref()) else {
            return BTreeMap::new();
        };
        let slopes: Vec<Vec<Vec<f64>>> = ids.iter().map(|&id| self.slopes(id)).collect();
        let column = |vector: &[f64], size: f64| -> Vec<f64> {
            let mut column = Vec::with_capacity(ids.len() * outputs.len());
            for (&id, slopes) in ids.iter().zip(&slopes) {
                let places: Vec<usize> = values_of_row(self, id).collect();
                for &output in outputs {
                    let parts = places.iter().zip(&slopes[output]);
                    let part = |(&place, slope): (&usize, &f64)| {
                        slope * size * vector[place] * learnt.units[place]
                    };
                    column.push(parts.map(part).sum());
                }
            }
            column
        };
        let of = |effects: &[usize]| {
            let unseen = learnt.emulator.unseen(effects)?;
            let factor = unseen.factor.vectors.iter().zip(&unseen.factor.sizes);
            let columns = factor.map(|(vector, &size)| column(vector, size)).collect();
            Some((effects.to_vec(), columns))
        };
        learnt.emulator.hypotheses().filter_map(of).collect()
    }

    /// For each output of the model in a row its derivatives by the outputs of the simulator.
    fn slopes(&self, row: usize) -> Vec<Vec<f64>> {
        let first = self.first_simulated();
        let (_, gradients) = self.gradients(&self.task.rows[row].estimates());
        let own = first..first + self.simulated - 1;
        gradients.into_iter().map(|gradient| gradient[own.clone()].to_vec()).collect()
    }
}

/// What values scatter by about straight lines through their neighbours, at least a thousandth of what they
/// span.
fn scatter(values: &[f64]) -> f64 {
    let bends = values.windows(3).map(|of| (of[0] - 2.0 * of[1] + of[2]).abs()).collect();
    // of normal noise the median is 0.6745 standard deviations, each of root 6 ones of a value
    let bend = median(bends).unwrap_or(0.0) / (0.6745 * 6.0f64.sqrt());
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    bend.max(1e-3 * (most - least)).max(f64::MIN_POSITIVE.sqrt())
}

/// The plain simulator in a row.
struct SimulatedAt<'c> {
    simulator: &'c SimulatorModel,
    plain: Arc<Prediction>,
    /// Those of the program, with what the simulator gives.
    variables: Vec<f64>,
    first: usize,
    /// For each output its place among the values of a run.
    values: Vec<usize>,
}

/// What a simulator gives under a hypothesis, for points of its unknown quantities side by side.
#[derive(Debug)]
pub(crate) struct SimulatedOutputs<'c> {
    case: &'c Case,
    learnt: &'c Learnt,
    elsewhere: Option<&'c Elsewhere>,
    space: &'c Space,
    /// Those of the simulator, in ascending order.
    effects: Vec<usize>,
    sources: Vec<Source>,
}

/// Where the value of an unknown parameter of the simulator comes from.
#[derive(Clone, Copy, Debug)]
enum Source {
    /// The unknown quantity at this place.
    Role(usize),
    /// The input's estimate.
    Estimate(f64),
}

impl<'c> SimulatedOutputs<'c> {
    /// Of a hypothesis with these roles; `None` in a case without an emulator.
    pub(crate) fn new(case: &'c Case, effects: &[usize], roles: &[Role]) -> Option<Self> {
        let simulator = case.simulator.as_deref()?;
        let (learnt, space) = (simulator.learnt.as_deref()?, simulator.space());
        let elsewhere = simulator.elsewhere.as_ref();
        let own = case.simulator_effects(effects);
        let first = variables(&case.model.inputs, &case.model.conditions);
        // the place among the simulator's parameters of each variable after the conditions
        let of_candidate = |candidate: &Candidate| -> Vec<Option<usize>> {
            match candidate.simulator {
                Some(effect) => space.parameters(effect).map(Some).collect(),
                None => vec![None; candidate.priors.len()],
            }
        };
        let of_effects: Vec<Option<usize>> =
            effects.iter().flat_map(|&effect| of_candidate(&case.candidates[effect])).collect();
        let parameter = |variable: usize| match variable.checked_sub(first) {
            Some(place) => of_effects.get(place).copied().flatten(),
            None => Some(variable),
        };
        let source = |unknown: usize| {
            let is_it = |role: &Role| match role {
                Role::Variable { place, .. } => parameter(*place) == Some(unknown),
                Role::Noise { .. } | Role::Power { .. } => false,
            };
            match roles.iter().position(is_it) {
                Some(place) => Source::Role(place),
                None => Source::Estimate(case.task.rows[0].distributions[unknown].mean()),
            }
        };
        let sources = space.unknowns(&own).into_iter().map(source).collect();
        Some(Self { case, learnt, elsewhere, space, effects: own, sources })
    }

    /// The values of the simulator's unknowns in a lane.
    fn values(&self, roles: &[Role], scores: &[Column], lane: usize) -> Vec<f64> {
        let value = |source: &Source| match *source {
            Source::Estimate(value) => value,
            Source::Role(place) => {
                let map = roles[place].map();
                map.map_or(f64::NAN, |map| map.value(scores[place].0[lane]))
            }
        };
        self.sources.iter().map(value).collect()
    }

    /// The scores of the simulator's unknowns in a lane.
    pub(crate) fn scores(&self, roles: &[Role], scores: &[Column], lane: usize) -> Vec<f64> {
        self.space.scores(&self.effects, &self.values(roles, scores, lane))
    }

    /// The values of all rows for the first lanes of scores, output after output; then those of other rows that
    /// it was run in.
    pub(crate) fn lanes(&self, roles: &[Role], scores: &[Column], lanes: usize) -> Vec<Vec<f64>> {
        let point =
            |lane: usize| self.space.at_values(&self.effects, &self.values(roles, scores, lane));
        let points: Vec<Vec<Coordinate>> = (0..lanes).map(point).collect();
        let mut values = self.learnt.emulator.values_at(&self.effects, &points);
        for (outputs, point) in values.iter_mut().zip(&points) {
            outputs.iter_mut().zip(&self.learnt.units).for_each(|(value, unit)| *value *= unit);
            if let Some(elsewhere) = &self.elsewhere {
                let there = elsewhere.emulator.values(&self.effects, point);
                let there = there.unwrap_or_else(|| vec![f64::NAN; elsewhere.units.len()]);
                outputs
                    .extend(there.iter().zip(&elsewhere.units).map(|(value, unit)| value * unit));
            }
        }
        values
    }

    /// The program's variables that the simulator gives in a row of the data, by its place among those of the
    /// case, each with its values in the lanes of [`SimulatedOutputs::lanes`]; not numbers in a row in which it
    /// was not run.
    pub(crate) fn of_row<'l>(
        &self,
        row: usize,
        lanes: &'l [Vec<f64>],
    ) -> impl Iterator<Item = (usize, impl Iterator<Item = f64> + use<'l>)> + use<'l> {
        let first = self.case.first_simulated();
        values_of_row(self.case, row).enumerate().map(move |(output, place)| {
            let value = move |values: &Vec<f64>| values.get(place).copied().unwrap_or(f64::NAN);
            (first + output, lanes.iter().map(value))
        })
    }
}

/// The place among the rows of a case, and after them those elsewhere, of one with these conditions, which a
/// simulator was run at; beyond all of them where it was not.
pub(crate) fn row_of(case: &Case, conditions: &[f64]) -> usize {
    let row = conditions.last().copied().unwrap_or(f64::NAN);
    let rows = case.task.rows.len() + rows_elsewhere(case);
    if row >= 0.0 && row < rows as f64 { row as usize } else { usize::MAX }
}

/// For each output of a simulator the place of a row's value among those of a run, and after them those
/// elsewhere; beyond all of them where it was not run at the row.
fn values_of_row(case: &Case, row: usize) -> impl Iterator<Item = usize> + use<> {
    let (rows, elsewhere) = (case.task.rows.len(), rows_elsewhere(case));
    let outputs = case.simulated - 1;
    let place = move |output: usize| match row.checked_sub(rows) {
        None => output * rows + row,
        Some(row) if row < elsewhere => outputs * rows + output * elsewhere + row,
        Some(_) => usize::MAX,
    };
    (0..outputs).map(place)
}

/// The number of other rows than those of the data that a simulator was run in.
fn rows_elsewhere(case: &Case) -> usize {
    let elsewhere = case.simulator.as_ref().and_then(|simulator| simulator.elsewhere.as_ref());
    elsewhere.map_or(0, |elsewhere| elsewhere.units.len() / (case.simulated - 1))
}
