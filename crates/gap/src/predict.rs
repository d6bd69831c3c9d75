//! What a hypothesis says at any conditions, after what the data taught about its unknowns.

use nalgebra::{DMatrix, DVector};

use super::discrepancy::{Coordinates, Discrepancy, Site, Weighted};
use super::evidence::Evidence;
use super::latent::{Map, Role};
use super::likelihood::{Evaluator, fixed_at};
use super::setup::Setup;
use crate::Effect;
use gumption_engine::number::{COLUMN, CodePath, Column, Kernel};
use gumption_engine::task::Row;

/// Values of outputs in rows: for each row and observed output, one for each draw.
pub(crate) type Values = Vec<Vec<Vec<f64>>>;

/// Draws of equal weight from a posterior: systematic resampling.
pub(crate) fn resampled(evidence: &Evidence, count: usize) -> Vec<Vec<f64>> {
    let mut draws = Vec::with_capacity(count);
    let mut sum = 0.0;
    let mut next = 0.5 / count as f64;
    for (place, weight) in evidence.weights.iter().enumerate() {
        sum += weight;
        while next < sum && draws.len() < count {
            let column = &evidence.columns[place / COLUMN];
            draws.push(column.iter().map(|scores| scores.0[place % COLUMN]).collect());
            next += 1.0 / count as f64;
        }
    }
    // rounding may leave the last one out
    while draws.len() < count {
        let Some(last) = draws.last().cloned() else { break };
        draws.push(last);
    }
    draws
}

/// What a hypothesis says in these rows for draws of its unknown quantities.
pub(crate) fn values(
    setup: &Setup<'_>,
    effects: &[usize],
    draws: &[Vec<f64>],
    rows: &[Row],
) -> Values {
    let likelihood = setup.likelihood(effects);
    let candidates = effects.iter().map(|&e| &setup.case.candidates[e]);
    let acting: Vec<&Effect> = candidates.map(|candidate| &candidate.effect).collect();
    let program = setup.case.sim.program(&acting).unwrap_or_default();
    // inputs whose prior differs from row to row have it from these rows
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
                let maps: Vec<Map> = rows.iter().map(of).collect();
                Role::Variable { place: *place, maps }
            }
            other => other.clone(),
        })
        .collect();
    let evaluator = Evaluator::new(
        &program,
        rows.iter().map(|row| row.conditions.clone()).collect(),
        setup.case.task.variables.len(),
        &fixed_at(rows, &roles),
        &setup.data.outputs,
    );
    let outputs = setup.data.outputs.len();
    let mut values = vec![vec![Vec::with_capacity(draws.len()); outputs]; rows.len()];
    for draws in draws.chunks(COLUMN) {
        let mut scores = vec![Column::ZERO; roles.len()];
        for (lane, draw) in draws.iter().enumerate() {
            for (column, score) in scores.iter_mut().zip(draw) {
                column.0[lane] = *score;
            }
        }
        let scores = likelihood.mixed(&scores);
        let walk =
            Walk { evaluator: &evaluator, roles: &roles, scores, lanes: draws.len(), outputs };
        for (of_row, columns) in values.iter_mut().zip(CodePath::best().run(walk)) {
            for (of_output, column) in of_row.iter_mut().zip(columns) {
                of_output.extend(column);
            }
        }
    }
    values
}

struct Walk<'w> {
    evaluator: &'w Evaluator,
    roles: &'w [Role],
    scores: Vec<Column>,
    lanes: usize,
    outputs: usize,
}

impl Kernel for Walk<'_> {
    type Output = Vec<Vec<Vec<f64>>>;

    #[inline(always)]
    fn run(self) -> Self::Output {
        let Self { evaluator, roles, scores, lanes, outputs } = self;
        let mut registers = evaluator.workspace();
        let mut values = Column::ZERO;
        let mut sims = vec![Column::ZERO; outputs];
        (0..evaluator.points())
            .map(|row| {
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
                evaluator.at(row, &mut registers, &mut sims);
                sims.iter().map(|column| column.0[..lanes].to_vec()).collect()
            })
            .collect()
    }
}

/// Variances of the outputs in a row from inputs that act linearly: those that belong to the row
/// alone, and those that are too small to be unknown quantities of their own.
pub(crate) fn linear_variances(setup: &Setup<'_>, row: &Row) -> Vec<f64> {
    let mut variables: Vec<f64> = row.distributions.iter().map(|d| d.mean()).collect();
    variables.extend(&row.conditions);
    let (_, gradients) = setup.case.task.model.program.gradients(&variables);
    let of = |&output: &usize| {
        let parts = row.distributions.iter().enumerate().map(|(v, distribution)| {
            if setup.unknown_inputs.contains(&v) {
                return 0.0;
            }
            let deviation = distribution.standard_deviation();
            let deviation =
                if deviation.is_finite() { deviation } else { distribution.standard_uncertainty() };
            (gradients[output][v] * deviation).powi(2)
        });
        parts.sum()
    };
    setup.data.outputs.iter().map(of).collect()
}

/// What the sim says in a row at the inputs' estimates, with its derivatives.
fn nominal(setup: &Setup<'_>, row: &Row) -> (Vec<f64>, Vec<Vec<f64>>) {
    let mut variables: Vec<f64> = row.distributions.iter().map(|d| d.mean()).collect();
    variables.extend(&row.conditions);
    let (values, gradients) = setup.case.task.model.program.gradients(&variables);
    let outputs = &setup.data.outputs;
    (
        outputs.iter().map(|&output| values[output]).collect(),
        outputs.iter().map(|&output| gradients[output].clone()).collect(),
    )
}

/// Mean and variance of every output in every row.
pub(crate) type Normals = Vec<Vec<(f64, f64)>>;

/// What "unexplained" says in these rows: the sim at the inputs' estimates, corrected by what the
/// data say of shared inputs and of the discrepancy (a Gaussian process conditioned on the data).
pub(crate) fn unexplained(
    setup: &Setup<'_>,
    discrepancy: &Discrepancy,
    kinds: &[Weighted],
    rows: &[Row],
) -> Normals {
    let outputs = setup.data.outputs.len();
    let plain = super::discrepancy::by_rows(&setup.data.nominal_residuals());
    let nominals: Vec<(Vec<f64>, Vec<Vec<f64>>)> =
        rows.iter().map(|row| nominal(setup, row)).collect();
    let sites: Vec<Site> = rows
        .iter()
        .zip(&nominals)
        .map(|(row, (nominal, _))| Site {
            conditions: row.conditions.clone(),
            nominal: nominal.clone(),
        })
        .collect();
    let shared: Vec<usize> = (0..setup.case.task.variables.len())
        .filter(|&v| setup.spread.shared[v].is_none())
        .collect();
    let total: f64 = kinds.iter().map(|kind| kind.weight).sum();
    let mut sums = vec![vec![(0.0, 0.0); outputs]; rows.len()];
    for kind in kinds {
        let form = &discrepancy.forms[kind.form];
        let share = kind.weight / total;
        // the sim, or the effects that act beside the discrepancy
        let (residuals, sims) = match &kind.base {
            None => (plain.clone(), nominals.iter().flat_map(|(sim, _)| sim.clone()).collect()),
            Some(base) => {
                let residuals = base.residuals(setup);
                let there_too =
                    values(setup, &base.effects, std::slice::from_ref(&base.scores), rows);
                let first = |draws: Vec<f64>| draws.first().copied();
                let sims: Vec<f64> = there_too.into_iter().flatten().filter_map(first).collect();
                (residuals, sims)
            }
        };
        let variances = kind.variances.as_deref().unwrap_or(&setup.linear.variances);
        let coordinates = Coordinates::new(&form.term, &discrepancy.axes, &sites, outputs);
        let roots = coordinates.roots(&form.term, form.length, &form.nodes);
        let there = coordinates.features(&roots, rows.len() * outputs) * form.scale;
        // coefficients: one for each shared input, then those of the discrepancy
        let features = form.features(setup, &discrepancy.axes);
        let m = features.ncols();
        let order = shared.len() + m;
        let effect = |gradients: &[Vec<f64>], row: &Row, output: usize, v: usize| {
            let deviation = row.distributions[v].standard_deviation();
            gradients[output][v] * if deviation.is_finite() { deviation } else { 0.0 }
        };
        let mut design = DMatrix::zeros(plain.len(), order);
        for (row, &id) in setup.data.ids.iter().enumerate() {
            let point = &setup.data.points[setup.data.point_of[row]];
            for output in 0..outputs {
                let value = row * outputs + output;
                let weight = variances[value].sqrt().recip();
                for (j, &v) in shared.iter().enumerate() {
                    let own = effect(&point.gradients, &setup.case.task.rows[id], output, v);
                    design[(value, j)] = own * weight;
                }
                for j in 0..m {
                    design[(value, shared.len() + j)] =
                        kind.multiplier * features[(value, j)] * weight;
                }
            }
        }
        let white = DVector::from_iterator(
            residuals.len(),
            residuals.iter().zip(variances.iter()).map(|(r, v)| r / v.sqrt()),
        );
        let precision = design.tr_mul(&design) + DMatrix::identity(order, order);
        let Some(root) = precision.cholesky() else { continue };
        let coefficients = root.solve(&design.tr_mul(&white));
        let lower = root.l();
        for (row, (_, gradients)) in nominals.iter().enumerate() {
            for output in 0..outputs {
                let value = row * outputs + output;
                let mut features = DVector::zeros(order);
                for (j, &v) in shared.iter().enumerate() {
                    features[j] = effect(gradients, &rows[row], output, v);
                }
                for j in 0..m {
                    features[shared.len() + j] = kind.multiplier * there[(value, j)];
                }
                let mean = sims[value] + features.dot(&coefficients);
                let half = lower.solve_lower_triangular(&features);
                // what the nodes do not determine of the function is left at its prior variance
                let variance = half.map_or(0.0, |half| half.norm_squared());
                sums[row][output].0 += share * mean;
                sums[row][output].1 += share * (variance + mean * mean);
            }
        }
    }
    for of_row in &mut sums {
        for (mean, square) in of_row {
            *square = (*square - *mean * *mean).max(0.0);
        }
    }
    sums
}
