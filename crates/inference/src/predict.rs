//! What a hypothesis says at any conditions, after what the data taught about its unknowns.

use super::data;
use super::latent::{Map, Role};
use super::likelihood::{Evaluator, Likelihood, fixed_at, known_conditions};
use super::setup::Setup;
use super::simulated_outputs::{SimulatedOutputs, row_of};
use gumption_engine::number::{COLUMN, CodePath, Column, Kernel};
use gumption_engine::task::Row;

/// Values of outputs in rows: for each row and observed output, one for each draw.
pub type Values = Vec<Vec<Vec<f64>>>;

/// What a hypothesis says in these rows for draws of its unknown quantities.
pub fn values(setup: &Setup<'_>, effects: &[usize], draws: &[Vec<f64>], rows: &[Row]) -> Values {
    Predictor::new(setup, effects, rows, &setup.data.outputs).values(draws)
}

/// A hypothesis made ready to say what outputs of the model are in some rows.
#[derive(Debug)]
pub struct Predictor<'s> {
    likelihood: Likelihood<'s>,
    /// As in the rows.
    roles: Vec<Role>,
    evaluator: Evaluator,
    outputs: usize,
    /// The places of the rows among those of the case, where it has a simulator.
    places: Vec<usize>,
}

impl<'s> Predictor<'s> {
    /// `outputs` are places in the model's outputs.
    pub fn new(setup: &'s Setup<'_>, effects: &[usize], rows: &[Row], outputs: &[usize]) -> Self {
        let likelihood = setup.likelihood(effects);
        let program = setup.case.program(effects);
        // inputs have their prior from these rows, once if it is the same in all of them
        let first = rows.first().map_or(&[][..], |row| &row.distributions);
        let roles: Vec<Role> = likelihood
            .roles
            .iter()
            .map(|role| match role {
                Role::Variable { place, .. } if *place < setup.case.task.variables.len() => {
                    // as in the data, where correlated quantities have normal scores
                    let of = |row: &Row| match Map::of(&row.distributions[*place]) {
                        bounded if bounded.is_bounded() && !role.is_bounded() => {
                            Map::Other((*row.distributions[*place]).clone())
                        }
                        map => map,
                    };
                    let is_first = |row: &Row| row.distributions[*place] == first[*place];
                    let different = if rows.iter().all(is_first) { 1 } else { rows.len() };
                    let maps = rows.iter().take(different).map(of).collect();
                    Role::Variable { place: *place, maps }
                }
                other => other.clone(),
            })
            .collect();
        let evaluator = Evaluator::new(
            &program,
            known_conditions(setup.case, rows),
            setup.case.task.variables.len(),
            &fixed_at(rows, &roles),
            outputs,
        );
        let places = match likelihood.simulated {
            Some(_) => rows.iter().map(|row| row_of(setup.case, &row.conditions)).collect(),
            None => Vec::new(),
        };
        Self { likelihood, roles, evaluator, outputs: outputs.len(), places }
    }

    /// Values for draws of the unknown quantities.
    pub fn values(&self, draws: &[Vec<f64>]) -> Values {
        let Self { likelihood, roles, evaluator, outputs, places } = self;
        let outputs = *outputs;
        let mut values = vec![vec![Vec::with_capacity(draws.len()); outputs]; evaluator.points()];
        for draws in draws.chunks(COLUMN) {
            let mut scores = vec![Column::ZERO; roles.len()];
            for (lane, draw) in draws.iter().enumerate() {
                for (column, score) in scores.iter_mut().zip(draw) {
                    column.0[lane] = *score;
                }
            }
            let scores = likelihood.mixed(&scores);
            let path = CodePath::best();
            let simulated = likelihood.simulated.as_ref();
            let simulated = simulated.map(|own| (own, own.lanes(roles, &scores, draws.len())));
            let lanes = draws.len();
            let walk = Walk { path, evaluator, roles, scores, lanes, outputs, places, simulated };
            for (of_row, columns) in values.iter_mut().zip(path.run(walk)) {
                for (of_output, column) in of_row.iter_mut().zip(columns) {
                    of_output.extend(column);
                }
            }
        }
        values
    }
}

struct Walk<'w> {
    path: CodePath,
    evaluator: &'w Evaluator,
    roles: &'w [Role],
    scores: Vec<Column>,
    lanes: usize,
    outputs: usize,
    places: &'w [usize],
    simulated: Option<(&'w SimulatedOutputs<'w>, Vec<Vec<f64>>)>,
}

impl Kernel for Walk<'_> {
    type Output = Vec<Vec<Vec<f64>>>;

    // programs take most of the time
    const WIDEST: bool = false;

    #[inline(always)]
    fn run(self) -> Self::Output {
        let Self { path, evaluator, roles, scores, lanes, outputs, places, simulated } = self;
        let mut registers = evaluator.workspace();
        let mut values = Column::ZERO;
        let mut sims = vec![Column::ZERO; outputs];
        // a loop and no closure, which would not be compiled for the path
        let mut of_rows = Vec::with_capacity(evaluator.points());
        for row in 0..evaluator.points() {
            for (n, role) in roles.iter().enumerate() {
                if let Role::Variable { place, maps } = role {
                    let map = maps.get(row).or(maps.first());
                    let (Some(map), true) = (map, maps.len() > 1 || row == 0) else { continue };
                    for lane in 0..lanes {
                        values.0[lane] = map.value(scores[n].0[lane]);
                    }
                    evaluator.set(&mut registers, *place, &values);
                }
            }
            if let Some((own, of_lanes)) = &simulated {
                for (variable, values) in own.of_row(places[row], of_lanes) {
                    evaluator.set_lanes(&mut registers, variable, values);
                }
            }
            evaluator.at(path, row, &mut registers, &mut sims);
            of_rows.push(sims.iter().map(|column| column.0[..lanes].to_vec()).collect());
        }
        of_rows
    }
}

/// What the model says of the observed outputs in a row at the inputs' estimates.
pub fn nominal(setup: &Setup<'_>, row: &Row) -> Vec<f64> {
    let variables = row.estimates();
    let values = setup.case.evaluate(&variables);
    setup.data.outputs.iter().map(|&output| values[output]).collect()
}

/// Variances of the outputs in a row from inputs that act linearly: those that belong to the row
/// alone, and those that are too small to be unknown quantities of their own.
pub fn linear_variances(setup: &Setup<'_>, row: &Row) -> Vec<f64> {
    variances_of(setup, row, &setup.data.outputs, |v| !setup.unknown_inputs.contains(&v))
}

/// Variances of outputs in a row from some of the inputs, by the law of propagation.
pub fn variances_of(
    setup: &Setup<'_>,
    row: &Row,
    outputs: &[usize],
    wanted: impl Fn(usize) -> bool,
) -> Vec<f64> {
    let variables = row.estimates();
    let (_, gradients) = setup.case.gradients(&variables);
    let of = |&output: &usize| {
        let part = |v: usize| {
            let distribution = row.distributions.get(v).filter(|_| wanted(v));
            let deviation = distribution.map_or(0.0, |distribution| data::deviation(distribution));
            // an input that does not vary may act without bound
            if deviation == 0.0 { 0.0 } else { gradients[output][v] * deviation }
        };
        let squares: f64 = (0..row.distributions.len()).map(|v| part(v) * part(v)).sum();
        let joint = setup.case.task.correlations.iter();
        let joint = joint.map(|correlation| {
            2.0 * correlation.coefficient * part(correlation.first) * part(correlation.second)
        });
        (squares + joint.sum::<f64>()).max(0.0)
    };
    outputs.iter().map(of).collect()
}

/// Mean and variance of every output in every row.
pub type Normals = Vec<Vec<(f64, f64)>>;
