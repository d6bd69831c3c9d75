//! What was measured and what the model says of it, row by row.

use std::collections::HashMap;

use crate::Case;
use crate::noise::copies::Copies;
use crate::noise::noise_model::{NoiseModel, lag};
use crate::tangent::Tangent;
use gumption_engine::distribution::Distribution;
use gumption_engine::number::elementary;
use gumption_engine::task::Sharing;

/// The data of a case beside the model's estimates.
#[derive(Clone, Debug)]
pub struct Data {
    /// The observed outputs, as places in the model's outputs.
    pub outputs: Vec<usize>,
    /// For each of them the length of a turn, for phases.
    pub turns: Vec<Option<f64>>,
    /// For each of them the measured values.
    pub values: Vec<Vec<f64>>,
    /// For each of them the standard uncertainties of measured values and of a simulation that came
    /// with the data, in quadrature; `None` where the noise is to be estimated.
    pub uncertainties: Vec<Option<Vec<f64>>>,
    /// The distinct conditions.
    pub points: Vec<Point>,
    /// The point of each row.
    pub point_of: Vec<usize>,
    /// The row of the case that each row is.
    pub ids: Vec<usize>,
    /// With noise that neighbouring rows share for each row its correlation with the one before; else
    /// none.
    pub(crate) lags: Vec<f64>,
    /// What the noise is taken to be.
    pub noise: NoiseModel,
    /// For each value (row by row, outputs fastest) the logarithm of what an estimated standard
    /// deviation is multiplied by: of the stated uncertainty where a factor of it is estimated.
    pub ln_scales: Vec<f64>,
}

/// Conditions at which there are one or more rows.
#[derive(Clone, Debug)]
pub struct Point {
    /// The rows.
    pub rows: Vec<usize>,
    /// For each observed output what the model says at the inputs' estimates.
    pub nominal: Vec<f64>,
    /// The same as linear functions of the inputs.
    pub tangent: Tangent,
}

impl Data {
    /// All rows of a case.
    pub fn new(case: &Case) -> Self {
        Self::of(case, (0..case.task.rows.len()).collect(), NoiseModel::default())
    }

    /// The rows of a case that count: those that repeat others beyond chance count once.
    pub(crate) fn measured(case: &Case) -> Self {
        Self::of(case, Copies::of(case).counted(case), NoiseModel::default())
    }

    /// Some rows of a case, with a noise.
    pub fn of(case: &Case, ids: Vec<usize>, noise: NoiseModel) -> Self {
        let outputs: Vec<usize> =
            (0..case.observed.len()).filter(|&output| case.observed[output].is_some()).collect();
        let observed: Vec<_> = case.observed.iter().flatten().collect();
        let mut points: Vec<Point> = Vec::new();
        let mut known: HashMap<Vec<u64>, usize> = HashMap::new();
        let mut point_of = Vec::with_capacity(ids.len());
        for (number, &id) in ids.iter().enumerate() {
            let row = &case.task.rows[id];
            let mut key: Vec<u64> = row.conditions.iter().map(|value| value.to_bits()).collect();
            // neighbours are told apart by their order, so that repeats are not taken together
            key.extend(noise.serial.map(|_| number as u64));
            let place = *known.entry(key).or_insert_with(|| {
                let mut tangent = case.tangent(row).of_outputs(&outputs);
                let inputs = row.distributions.len();
                tangent.gradients.iter_mut().for_each(|gradient| gradient.truncate(inputs));
                let nominal = if case.is_linear_at_estimates() {
                    tangent.touching.clone()
                } else {
                    let values = case.evaluate(&row.estimates());
                    outputs.iter().map(|&output| values[output]).collect()
                };
                points.push(Point { rows: Vec::new(), nominal, tangent });
                points.len() - 1
            });
            points[place].rows.push(number);
            point_of.push(place);
        }
        let in_quadrature = |output: &&crate::ObservedOutput| {
            let own = output.standard_uncertainties.as_ref()?;
            let other = output.simulation_uncertainties.as_ref();
            let both =
                |&id: &usize| other.map_or(own[id], |other| elementary::hypot(own[id], other[id]));
            Some(ids.iter().map(both).collect())
        };
        let mut uncertainties: Vec<Option<Vec<f64>>> = observed.iter().map(in_quadrature).collect();
        let mut ln_scales = vec![0.0; ids.len() * outputs.len()];
        for (output, stated) in uncertainties.iter_mut().enumerate() {
            for (row, &id) in ids.iter().enumerate() {
                let stretch = noise.stretch(id, output);
                let factor = noise.common.as_ref().map_or(1.0, |common| common.factor(output));
                let ln_scale = &mut ln_scales[row * outputs.len() + output];
                match stated {
                    Some(u) if noise.factor.is_some() => {
                        *ln_scale = elementary::ln(u[row] * stretch)
                    }
                    Some(u) => u[row] *= stretch * factor,
                    None => *ln_scale = elementary::ln(stretch),
                }
            }
            if noise.factor.is_some() {
                *stated = None;
            }
        }
        let lags = match noise.serial {
            None => Vec::new(),
            Some(coefficient) => {
                let of = |pair: &[usize]| lag(coefficient, pair[0], pair[1]);
                std::iter::once(0.0).chain(ids.windows(2).map(of)).collect()
            }
        };
        Self {
            lags,
            turns: outputs.iter().map(|&output| case.model.outputs[output].period).collect(),
            values: observed
                .iter()
                .map(|observed| ids.iter().map(|&id| observed.values[id]).collect())
                .collect(),
            uncertainties,
            outputs,
            points,
            point_of,
            ids,
            noise,
            ln_scales,
        }
    }

    /// For each row the number of its setting: rows have the same one where their conditions are the
    /// same but for those that follow from the order of the rows.
    pub(crate) fn settings(&self, case: &Case) -> Vec<usize> {
        numbered(self.ids.iter().map(|&id| case.setting(id)))
    }

    /// The rows of each setting, in the order in which they first appear.
    pub fn repeats(&self, case: &Case) -> Vec<Vec<usize>> {
        let mut rows: Vec<Vec<usize>> = Vec::new();
        for (row, setting) in self.settings(case).into_iter().enumerate() {
            if setting == rows.len() {
                rows.push(Vec::new());
            }
            rows[setting].push(row);
        }
        rows
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.point_of.len()
    }

    /// Number of measured values.
    #[allow(clippy::len_without_is_empty)] // a case without data is refused
    pub fn len(&self) -> usize {
        self.rows() * self.outputs.len()
    }

    /// A measured value less a value of the model, for phases within half a turn.
    pub fn residual(&self, output: usize, row: usize, sim: f64) -> f64 {
        within_half_a_turn(self.values[output][row] - sim, self.turns[output])
    }

    /// The residuals against the model at the inputs' estimates, output by output.
    pub fn nominal_residuals(&self) -> Vec<Vec<f64>> {
        self.residuals(|point| &point.nominal)
    }

    /// The same against the model as a linear function of the inputs.
    pub fn linear_residuals(&self) -> Vec<Vec<f64>> {
        self.residuals(|point| &point.tangent.at_estimates)
    }

    fn residuals(&self, sims: impl Fn(&Point) -> &[f64]) -> Vec<Vec<f64>> {
        (0..self.outputs.len())
            .map(|output| {
                self.point_of
                    .iter()
                    .enumerate()
                    .map(|(row, &point)| {
                        self.residual(output, row, sims(&self.points[point])[output])
                    })
                    .collect()
            })
            .collect()
    }
}

/// Numbers keys, equal ones alike, in the order in which they first appear.
pub(crate) fn numbered(keys: impl Iterator<Item = Vec<u64>>) -> Vec<usize> {
    let mut known: HashMap<Vec<u64>, usize> = HashMap::new();
    let number = |key| {
        let next = known.len();
        *known.entry(key).or_insert(next)
    };
    keys.map(number).collect()
}

/// A difference of phases on the branch next to zero; of other values as it is.
pub fn within_half_a_turn(difference: f64, turn: Option<f64>) -> f64 {
    match turn {
        Some(turn) => difference - turn * (difference / turn).round(),
        None => difference,
    }
}

/// Values of outputs as one list, row by row, outputs fastest.
pub fn by_rows(values: &[Vec<f64>]) -> Vec<f64> {
    let rows = values.first().map_or(0, Vec::len);
    (0..rows).flat_map(|row| values.iter().map(move |output| output[row])).collect()
}

/// Standard deviations of the variables in every row, and which rows share a value.
#[derive(Clone, Debug)]
pub struct Spread {
    /// For each variable its standard deviation at each point.
    pub deviations: Vec<Vec<f64>>,
    /// For each variable the rows that share its value: `None` for all rows, else a number for each
    /// row.
    pub shared: Vec<Option<Vec<usize>>>,
}

/// The standard deviation of what is known about an input; its standard uncertainty where it has none.
pub(crate) fn deviation(of: &Distribution) -> f64 {
    let deviation = of.standard_deviation();
    if deviation.is_finite() { deviation } else { of.standard_uncertainty() }
}

impl Spread {
    /// The spread of a case as it is stated.
    pub fn new(case: &Case, data: &Data) -> Self {
        let variables = case.task.variables.len();
        let deviations = (0..variables)
            .map(|variable| {
                let of = |point: &Point| {
                    let row = point.rows.first().and_then(|&row| case.task.rows.get(data.ids[row]));
                    let distribution = row.and_then(|row| row.distributions.get(variable));
                    distribution.map_or(0.0, |distribution| deviation(distribution))
                };
                data.points.iter().map(of).collect()
            })
            .collect();
        let shared = case.task.variables.iter().map(|variable| match variable.sharing {
            Sharing::All => None,
            Sharing::Row => Some((0..data.rows()).collect()),
            Sharing::Condition(place) => {
                let value = |&id: &usize| case.task.rows[id].conditions.get(place).copied();
                let level = |id| vec![value(id).unwrap_or(0.0).to_bits()];
                Some(numbered(data.ids.iter().map(level)))
            }
        });
        Self { deviations, shared: shared.collect() }
    }
}
