//! A case made ready: data, covariance, and which quantities are unknown whatever the hypothesis.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::correlated;
use super::covariance::Covariance;
use super::data::{Data, Spread};
use super::evaluators::Evaluators;
use super::latent::{Map, Role};
use super::likelihood::Likelihood;
use super::simulated_outputs::SimulatedOutputs;
use crate::noise::noise_model::NoiseModel;
use crate::{Case, Prior};
use gumption_engine::distribution::Distribution;
use gumption_engine::number::{elementary, largest_first, smallest_first};
use gumption_engine::task::Row;

/// Inputs whose whole effect on the data is below so many standard uncertainties act linearly as far
/// as anybody can tell, and are integrated out exactly.
const NEGLIGIBLE: f64 = 0.3;

/// At most so many inputs are unknown quantities of their own; the others act linearly.
const MOST_UNKNOWN_INPUTS: usize = 12;

/// Noise is taken to be proportional to a power of the model's size where that spans this factor.
const SPAN_FOR_POWER: f64 = 3.0;

/// What all hypotheses of a case have in common.
#[derive(Debug)]
pub struct Setup<'c> {
    /// The case itself.
    pub case: &'c Case,
    /// What was measured, and what the model says at the estimates.
    pub data: Data,
    /// How far each input may be from its estimate, at each point.
    pub spread: Spread,
    /// With the inputs that act linearly integrated out.
    pub covariance: Covariance,
    /// With all inputs integrated out as if they acted linearly.
    pub linear: Covariance,
    /// The inputs that are unknown quantities of their own.
    pub unknown_inputs: Vec<usize>,
    /// Unknown quantities of every hypothesis: inputs, then noise.
    pub roles: Vec<Role>,
    mixing: Option<Vec<Vec<f64>>>,
    /// Logarithm of the typical size of each observed output.
    pub ln_sizes: Vec<f64>,
    evaluators: Arc<Evaluators>,
    /// In a case with a simulator the covariance for each list of its effects, with what its emulator does not
    /// know of them.
    of_simulator: Option<OfSimulator>,
}

/// Covariances by the effects of a simulator.
#[derive(Clone, Debug)]
struct OfSimulator {
    /// Of effects that were never run together.
    others: Covariance,
    known: BTreeMap<Vec<usize>, Covariance>,
}

impl OfSimulator {
    fn with(&self, columns: &[Vec<f64>]) -> Self {
        let known = self.known.iter();
        let known = known.map(|(effects, of)| (effects.clone(), of.with(columns)));
        Self { others: self.others.with(columns), known: known.collect() }
    }
}

impl<'c> Setup<'c> {
    /// A case with its noise as stated.
    pub fn new(case: &'c Case) -> Self {
        let data = Data::measured(case);
        let spread = Spread::new(case, &data);
        let unknown_inputs = unknown_inputs(case, &data, &spread);
        let ln_sizes = ln_sizes(&data);
        let residuals = data.nominal_residuals();
        let fitted = (0..residuals.len()).filter(|&output| data.uncertainties[output].is_none());
        let noise: Vec<Role> =
            fitted.flat_map(|output| noise(output, &residuals[output], &data, &ln_sizes)).collect();
        Self::with_data_and_inputs(case, data, unknown_inputs, noise)
    }

    /// The names of effects of the list.
    pub fn effect_names(&self, effects: &[usize]) -> Vec<String> {
        effects.iter().map(|&effect| self.case.candidates[effect].effect.name.clone()).collect()
    }

    /// The same with another noise.
    pub fn with_noise(&self, noise: NoiseModel) -> Self {
        let mut roles = self.noise_roles();
        if let Some(factor) = noise.factor {
            let stated = &self.data.uncertainties;
            for output in (0..stated.len()).filter(|&output| stated[output].is_some()) {
                roles.push(factor.role(output));
                roles.extend(power(output, &self.data, &self.ln_sizes));
            }
        }
        let data = Data::of(self.case, self.data.ids.clone(), noise);
        Self::with_data_and_inputs(self.case, data, self.unknown_inputs.clone(), roles)
            .sharing(self)
    }

    /// The same, where another setup of the same rows, model and effects has programs that are ready.
    pub(crate) fn sharing(mut self, other: &Setup<'_>) -> Self {
        if self.unknown_inputs == other.unknown_inputs {
            self.evaluators = Arc::clone(&other.evaluators);
        }
        self
    }

    /// With other data of the case, and the unknown quantities of all of them.
    pub fn with_data_and_inputs(
        case: &'c Case,
        data: Data,
        unknown_inputs: Vec<usize>,
        noise: Vec<Role>,
    ) -> Self {
        let spread = Spread::new(case, &data);
        let varying: Vec<usize> = (0..case.task.variables.len())
            .filter(|&v| spread.deviations[v].iter().any(|deviation| *deviation > 0.0))
            .collect();
        let others: Vec<usize> =
            varying.iter().copied().filter(|v| !unknown_inputs.contains(v)).collect();
        let mut covariance = Covariance::new(case, &data, &spread, &others);
        let mut linear = Covariance::new(case, &data, &spread, &varying);
        let unseen = case.unseen(&data.ids, &data.outputs);
        let of_simulator = (!unseen.is_empty()).then(|| {
            let known = unseen.iter().map(|(effects, of)| (effects.clone(), covariance.with(of)));
            OfSimulator { others: covariance.clone(), known: known.collect() }
        });
        if let Some(of_plain) = unseen.get(&[][..]) {
            covariance = covariance.with(of_plain);
            linear = linear.with(of_plain);
        }
        let ln_sizes = ln_sizes(&data);
        let mut roles: Vec<Role> = unknown_inputs
            .iter()
            .map(|&place| Role::Variable { place, maps: maps(case, &data, place) })
            .collect();
        roles.extend(noise);
        let mixing = correlated::root(case, &unknown_inputs).map(|root| {
            let row = |i: usize| (0..root.ncols()).map(|j| root[(i, j)]).collect();
            (0..root.nrows()).map(row).collect()
        });
        let evaluators = Arc::default();
        Self {
            case,
            data,
            spread,
            covariance,
            linear,
            unknown_inputs,
            roles,
            mixing,
            ln_sizes,
            evaluators,
            of_simulator,
        }
    }

    /// The same with functions of unknown size integrated out: columns of values, in the outputs' units,
    /// whose factors are standard normal.
    pub(crate) fn with_functions(&self, columns: &[Vec<f64>]) -> Self {
        Self {
            case: self.case,
            data: self.data.clone(),
            spread: self.spread.clone(),
            covariance: self.covariance.with(columns),
            linear: self.linear.with(columns),
            unknown_inputs: self.unknown_inputs.clone(),
            roles: self.roles.clone(),
            mixing: self.mixing.clone(),
            ln_sizes: self.ln_sizes.clone(),
            evaluators: Arc::clone(&self.evaluators),
            of_simulator: self.of_simulator.as_ref().map(|of| of.with(columns)),
        }
    }

    /// The conditions and inputs of a row of the data.
    pub fn row(&self, row: usize) -> &'c Row {
        &self.case.task.rows[self.data.ids[row]]
    }

    /// Those of all rows of the data.
    pub fn all_rows(&self) -> Vec<Row> {
        (0..self.data.rows()).map(|row| self.row(row).clone()).collect()
    }

    /// The rows of the data in the order of a condition.
    pub fn rows_along(&self, condition: usize) -> Vec<usize> {
        let mut rows: Vec<usize> = (0..self.data.rows()).collect();
        smallest_first(&mut rows, |&row| self.row(row).conditions[condition]);
        rows
    }

    /// Prior probabilities of the hypotheses.
    pub(crate) fn prior(&self) -> Prior {
        self.data.noise.hypotheses(self.case)
    }

    /// Whether an output states uncertainties of which a factor is estimated.
    pub fn has_factor(&self, output: usize) -> bool {
        let observed =
            self.data.outputs.get(output).and_then(|&output| self.case.observed[output].as_ref());
        self.data.noise.factor.is_some()
            && observed.is_some_and(|observed| observed.standard_uncertainties.is_some())
    }

    /// The likelihood with these effects acting.
    pub fn likelihood(&self, effects: &[usize]) -> Likelihood<'_> {
        let candidates: Vec<_> = effects.iter().map(|&e| &self.case.candidates[e]).collect();
        let first = self.case.task.variables.len() + self.case.model.conditions.len();
        let parameters = candidates.iter().flat_map(|candidate| &candidate.priors).enumerate();
        let mut roles = self.roles.clone();
        roles.extend(parameters.map(|(place, prior)| Role::Variable {
            place: first + place,
            maps: vec![Map::of(prior)],
        }));
        let mixing = self.mixing.as_ref().map(|rows| {
            (0..roles.len())
                .map(|i| {
                    let mut row = vec![0.0; roles.len()];
                    match rows.get(i) {
                        Some(own) => row[..own.len()].copy_from_slice(own),
                        None => row[i] = 1.0,
                    }
                    row
                })
                .collect()
        });
        let evaluator = self.evaluators.of(self.data.points.len(), effects, || {
            Likelihood::evaluator(self.case, &self.data, &self.case.program(effects), &roles)
        });
        let covariance = match &self.of_simulator {
            Some(of) => of.known.get(&self.case.simulator_effects(effects)).unwrap_or(&of.others),
            None => &self.covariance,
        };
        let simulated = SimulatedOutputs::new(self.case, effects, &roles);
        Likelihood::new(&self.data, covariance, evaluator, roles, mixing, self.ln_sizes.clone())
            .with_simulated(simulated)
    }

    /// About so many values, evenly spread over the rows.
    pub(crate) fn thinned(&self, values: usize) -> Self {
        let step = (self.data.len() / values.max(1)).max(1);
        let ids = self.data.ids.iter().step_by(step).copied().collect();
        let data = Data::of(self.case, ids, self.data.noise.clone());
        Self::with_data_and_inputs(self.case, data, self.unknown_inputs.clone(), self.noise_roles())
    }

    /// The unknown quantities of the noise.
    pub fn noise_roles(&self) -> Vec<Role> {
        self.roles.iter().filter(|role| role.is_noise()).cloned().collect()
    }

    /// Places of an effect's parameters among the unknown quantities of a hypothesis.
    pub fn parameters(&self, effects: &[usize], effect: usize) -> std::ops::Range<usize> {
        let count = |e: &usize| self.case.candidates[*e].priors.len();
        let before: usize = effects.iter().take_while(|e| **e != effect).map(count).sum();
        let first = self.roles.len() + before;
        first..first + count(&effect)
    }
}

/// The prior of an input at every point, or once if it is the same at all.
pub fn maps(case: &Case, data: &Data, variable: usize) -> Vec<Map> {
    let of =
        |row: usize| -> &Distribution { &case.task.rows[data.ids[row]].distributions[variable] };
    // normal scores are what declared correlations join
    let correlated =
        case.task.correlations.iter().any(|c| c.first == variable || c.second == variable);
    let map = |row: usize| match Map::of(of(row)) {
        bounded if bounded.is_bounded() && correlated => Map::Other(of(row).clone()),
        map => map,
    };
    let rows: Vec<usize> =
        data.points.iter().filter_map(|point| point.rows.first().copied()).collect();
    let first = rows.first().map(|&row| of(row));
    if rows.iter().all(|&row| Some(of(row)) == first) {
        rows.first().map(|&row| map(row)).into_iter().collect()
    } else {
        rows.iter().map(|&row| map(row)).collect()
    }
}

/// Shared inputs that matter, those that matter most first.
fn unknown_inputs(case: &Case, data: &Data, spread: &Spread) -> Vec<usize> {
    let residuals = data.nominal_residuals();
    let scales: Vec<f64> = residuals
        .iter()
        .map(|residuals| {
            let squares: f64 = residuals.iter().map(|r| r * r).sum();
            1e-3 * (squares / residuals.len().max(1) as f64).sqrt()
        })
        .collect();
    let influence = |v: usize| {
        let curved: Vec<Vec<f64>> = (0..data.points.len())
            .map(|point| curved_effects(case, data, point, v, spread.deviations[v][point]))
            .collect();
        let mut sum = 0.0;
        for (row, &point) in data.point_of.iter().enumerate() {
            for output in 0..data.outputs.len() {
                let linear =
                    data.points[point].tangent.gradients[output][v] * spread.deviations[v][point];
                let effect = linear.abs().max(curved[point][output]);
                let u = match &data.uncertainties[output] {
                    Some(u) => u[row],
                    None => scales[output],
                };
                sum += (effect / u).powi(2);
            }
        }
        sum.sqrt()
    };
    let mut ranked: Vec<(f64, usize)> = (0..case.task.variables.len())
        .filter(|&v| spread.shared[v].is_none())
        .filter(|&v| spread.deviations[v].iter().any(|deviation| *deviation > 0.0))
        .map(|v| (influence(v), v))
        .filter(|(influence, _)| *influence > NEGLIGIBLE || !influence.is_finite())
        .collect();
    largest_first(&mut ranked, |a| a.0);
    ranked.truncate(MOST_UNKNOWN_INPUTS);
    let mut chosen: Vec<usize> = ranked.into_iter().map(|(_, v)| v).collect();
    // an input that is correlated with an unknown one is unknown as well
    for correlation in &case.task.correlations {
        let (first, second) = (correlation.first, correlation.second);
        for (one, other) in [(first, second), (second, first)] {
            let shared = spread.shared.get(other).is_some_and(Option::is_none);
            if chosen.contains(&one) && !chosen.contains(&other) && shared {
                chosen.push(other);
            }
        }
    }
    chosen.sort_unstable();
    chosen
}

/// How far from the estimate an input is tried, in standard deviations: within the limits of a
/// symmetric distribution, the arc sine among them.
const TRIED: [f64; 2] = [-1.4, 1.4];

/// For each output the largest change of the sim at a point for an input away from its estimate, by the
/// standard deviation. Where the sim has no slope at the estimate, as of a cosine at 0 or a modulus, the
/// input counts all the same.
fn curved_effects(
    case: &Case,
    data: &Data,
    point: usize,
    variable: usize,
    deviation: f64,
) -> Vec<f64> {
    let point = &data.points[point];
    let mut largest = vec![0.0; data.outputs.len()];
    let row = point.rows.first().and_then(|&row| case.task.rows.get(data.ids[row]));
    let Some(row) = row.filter(|_| deviation > 0.0) else { return largest };
    let mut at = row.estimates();
    let estimate = at[variable];
    for tried in TRIED {
        at[variable] = estimate + tried * deviation;
        let values = case.evaluate(&at);
        for (place, (largest, &output)) in largest.iter_mut().zip(&data.outputs).enumerate() {
            let change = (values[output] - point.nominal[place]).abs() / TRIED[1];
            // outside the sim's domain nothing is known
            if change.is_finite() {
                *largest = change.max(*largest);
            }
        }
    }
    largest
}

/// For each value the logarithm of the model's size relative to its geometric mean over the rows.
fn ln_sizes(data: &Data) -> Vec<f64> {
    let count = data.outputs.len();
    let mut ln_sizes = vec![0.0; data.len()];
    for output in 0..count {
        let size = |point: usize| data.points[point].nominal[output].abs();
        let most = (0..data.points.len()).map(size).fold(0.0, f64::max);
        let least = (0..data.points.len())
            .map(size)
            .filter(|size| *size > 1e-9 * most)
            .fold(f64::INFINITY, f64::min);
        if most <= 0.0 || !least.is_finite() {
            continue;
        }
        let ln = |row: usize| elementary::ln(size(data.point_of[row]).max(least));
        let mean = (0..data.rows()).map(ln).sum::<f64>() / data.rows().max(1) as f64;
        for row in 0..data.rows() {
            ln_sizes[row * count + output] = ln(row) - mean;
        }
    }
    ln_sizes
}

/// The noise of an output without stated uncertainties: its standard deviation is log-uniform over
/// all sizes that the data allow, and it may grow with the model's size.
fn noise(output: usize, residuals: &[f64], data: &Data, ln_sizes: &[f64]) -> Vec<Role> {
    let rms = |values: &mut dyn Iterator<Item = f64>| {
        let (count, squares) = values.fold((0usize, 0.0), |(n, sum), v| (n + 1, sum + v * v));
        (squares / count.max(1) as f64).sqrt()
    };
    let scale = rms(&mut residuals.iter().copied())
        .max(1e-12 * rms(&mut data.values[output].iter().copied()))
        .max(f64::MIN_POSITIVE.sqrt());
    let ln_lower = elementary::ln(1e-6 * scale);
    let mut roles = vec![Role::Noise {
        output,
        map: Map::Uniform { lower: ln_lower, width: elementary::ln(3e6f64) },
    }];
    roles.extend(power(output, data, ln_sizes));
    roles
}

/// The power of the model's size that the noise of an output grows with, where that spans enough.
fn power(output: usize, data: &Data, ln_sizes: &[f64]) -> Option<Role> {
    let sizes = ln_sizes.iter().skip(output).step_by(data.outputs.len().max(1));
    let (least, most) =
        sizes.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &ln| (a.min(ln), b.max(ln)));
    (most - least > elementary::ln(SPAN_FOR_POWER))
        .then_some(Role::Power { output, map: Map::Uniform { lower: 0.0, width: 1.0 } })
}
