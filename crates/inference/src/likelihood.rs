//! The likelihood of a hypothesis at many points of its unknown quantities at once.
//!
//! The integral over the unknown quantities needs the likelihood at thousands of points, and each
//! evaluation runs the model at every condition of the data. Two things make that cheap. Points stand
//! side by side in the lanes of columns, so that the recorded program is interpreted once for 128 of
//! them, and repeats at one condition share one run of it. And what acts linearly is integrated out
//! in closed form: the covariance of the residuals is V = B + L L', with B in small blocks (one for
//! each row of the data) and a column of L for each shared input, so that by the matrix inversion
//! lemma (Sherman, Morrison, Woodbury)
//!
//! r' inv(V) r = |w|^2 - |inv(K) M' w|^2 and |V| = |B| |K|^2,
//!
//! where w and M are r and L whitened by B and K is the Cholesky root of I + M' M. V is never formed:
//! time and memory grow with the number of rows and not with its square.
//!
//! Where the noise of an output is estimated, B depends on the point. Then M' M is summed up lane by
//! lane with the squares, and K is factored for each point.

use std::sync::Arc;

use super::covariance::Covariance;
use super::data::Data;
use super::latent::{Role, ln_priors};
use super::logarithm::HALF_LN_TWO_PI;
use crate::Case;
use crate::simulated_outputs::SimulatedOutputs;
use gumption_engine::linalg::dot;
use gumption_engine::linalg::packed::{self, triangle};
use gumption_engine::model::{Program, Schedule, ScheduledOutput};
use gumption_engine::number::{COLUMN, CodePath, Column, Kernel, elementary};
use gumption_engine::task::Row;

/// Points with more conditions than this share one schedule: those of single points would not stay
/// in the cache.
const MOST_SCHEDULES: usize = 2048;

/// Everything that does not change while a hypothesis is explored.
#[derive(Debug)]
pub struct Likelihood<'c> {
    pub(crate) data: &'c Data,
    pub(crate) covariance: &'c Covariance,
    /// The unknown quantities, in the order of the scores.
    pub roles: Vec<Role>,
    /// How scores that are correlated beforehand follow from independent ones.
    mixing: Option<Vec<Vec<f64>>>,
    evaluator: Arc<Evaluator>,
    /// For each value the logarithm of the model's size, which proportional noise follows.
    ln_sizes: Vec<f64>,
    /// What a simulator gives, in a case with one.
    pub(crate) simulated: Option<SimulatedOutputs<'c>>,
}

/// A program over columns at every point of the data.
#[derive(Debug)]
pub(crate) struct Evaluator {
    schedules: Vec<Schedule>,
    /// With a schedule for all points: for each point the conditions, to fill registers with.
    conditions: Option<Vec<Vec<f64>>>,
    /// The register of each program's variable that varies.
    registers: Vec<Option<usize>>,
    first_condition: usize,
    outputs: Vec<usize>,
}

/// What happens with the residuals of a row: lanes of whitened residuals for each output and, where
/// noise is estimated, of the logarithm of their variance.
pub(crate) trait Visitor {
    fn row(&mut self, path: CodePath, row: usize, residuals: &[Column], ln_variances: &[Column]);
}

impl Evaluator {
    /// The program at points with these values of the conditions; `fixed` are variables with a value
    /// for each point, or `None` for those that vary from lane to lane.
    pub(crate) fn new(
        program: &Program,
        conditions: Vec<Vec<f64>>,
        first_condition: usize,
        fixed: &[Option<Vec<f64>>],
        outputs: &[usize],
    ) -> Self {
        let count = conditions.first().map_or(0, Vec::len);
        let is_condition = |v: usize| (first_condition..first_condition + count).contains(&v);
        let varying: Vec<usize> = (0..program.variables())
            .filter(|&v| !is_condition(v) && fixed.get(v).is_none_or(Option::is_none))
            .collect();
        let same = |values: &Vec<f64>| values.iter().all(|value| *value == values[0]);
        let few = conditions.len() <= MOST_SCHEDULES
            || fixed.iter().flatten().any(|values| !same(values));
        let bound = |point: usize| -> Vec<Option<f64>> {
            (0..program.variables())
                .map(|v| {
                    if is_condition(v) {
                        few.then(|| conditions[point][v - first_condition])
                    } else {
                        let values = fixed.get(v).and_then(Option::as_ref);
                        values.and_then(|values| values.get(point).copied())
                    }
                })
                .collect()
        };
        let schedules = if few {
            (0..conditions.len())
                .map(|point| Schedule::keeping_variables(program, &bound(point)))
                .collect()
        } else {
            vec![Schedule::keeping_variables(program, &bound(0))]
        };
        let mut registers = vec![None; program.variables()];
        let mut next = 0;
        for (v, register) in registers.iter_mut().enumerate() {
            if varying.contains(&v) || (!few && is_condition(v)) {
                *register = Some(next);
                next += 1;
            }
        }
        Self {
            schedules,
            conditions: (!few).then_some(conditions),
            registers,
            first_condition,
            outputs: outputs.to_vec(),
        }
    }

    /// Number of points.
    pub(crate) fn points(&self) -> usize {
        self.conditions.as_ref().map_or(self.schedules.len(), Vec::len)
    }

    /// Number of programs that are kept for them.
    pub(crate) fn schedules(&self) -> usize {
        self.schedules.len()
    }

    pub(crate) fn workspace(&self) -> Vec<Column> {
        let most = self.schedules.iter().map(|schedule| schedule.registers).max();
        vec![Column::ZERO; most.unwrap_or(0)]
    }

    #[inline(always)]
    pub(crate) fn set(&self, registers: &mut [Column], variable: usize, values: &Column) {
        if let Some(Some(register)) = self.registers.get(variable) {
            registers[*register].0.copy_from_slice(&values.0);
        }
    }

    /// Sets the first lanes of a variable.
    #[inline(always)]
    pub(crate) fn set_lanes(
        &self,
        registers: &mut [Column],
        variable: usize,
        values: impl Iterator<Item = f64>,
    ) {
        if let Some(Some(register)) = self.registers.get(variable) {
            registers[*register].0.iter_mut().zip(values).for_each(|(lane, value)| *lane = value);
        }
    }

    /// The outputs at a point into `out`.
    #[inline(always)]
    pub(crate) fn at(
        &self,
        path: CodePath,
        point: usize,
        registers: &mut [Column],
        out: &mut [Column],
    ) {
        let schedule = match &self.conditions {
            None => &self.schedules[point],
            Some(conditions) => {
                for (place, &value) in conditions[point].iter().enumerate() {
                    if let Some(register) = self.registers[self.first_condition + place] {
                        registers[register].0.fill(value);
                    }
                }
                &self.schedules[0]
            }
        };
        schedule.run_on(path, registers);
        for (out, &output) in out.iter_mut().zip(&self.outputs) {
            match schedule.outputs[output] {
                ScheduledOutput::Register(register) => {
                    out.0.copy_from_slice(&registers[register].0)
                }
                ScheduledOutput::Constant(value) => out.0.fill(value),
            }
        }
    }
}

impl<'c> Likelihood<'c> {
    /// `roles` are the unknown quantities.
    pub(crate) fn new(
        data: &'c Data,
        covariance: &'c Covariance,
        evaluator: Arc<Evaluator>,
        roles: Vec<Role>,
        mixing: Option<Vec<Vec<f64>>>,
        ln_sizes: Vec<f64>,
    ) -> Self {
        Self { data, covariance, roles, mixing, evaluator, ln_sizes, simulated: None }
    }

    /// The same with the outputs of a simulator.
    pub(crate) fn with_simulated(mut self, simulated: Option<SimulatedOutputs<'c>>) -> Self {
        self.simulated = simulated;
        self
    }

    /// A program at the points of the data; its variables without a role are at their estimates.
    pub(crate) fn evaluator(
        case: &Case,
        data: &Data,
        program: &Program,
        roles: &[Role],
    ) -> Evaluator {
        let rows: Vec<usize> = data
            .points
            .iter()
            .filter_map(|point| point.rows.first().map(|&row| data.ids[row]))
            .collect();
        let at: Vec<Row> = rows.iter().map(|&row| case.task.rows[row].clone()).collect();
        Evaluator::new(
            program,
            known_conditions(case, &at),
            case.task.variables.len(),
            &fixed_at(&at, roles),
            &data.outputs,
        )
    }

    /// For each unknown quantity whether its score is rectangular.
    pub(crate) fn bounded(&self) -> Vec<bool> {
        self.roles.iter().map(Role::is_bounded).collect()
    }

    /// Number of unknown quantities.
    pub(crate) fn unknowns(&self) -> usize {
        self.roles.len()
    }

    /// Points in the lanes of columns, at most as many as there are lanes; the last one fills what is
    /// left.
    pub(crate) fn columns(&self, points: &[Vec<f64>]) -> Vec<Column> {
        let mut scores = vec![Column::ZERO; self.unknowns()];
        for (i, column) in scores.iter_mut().enumerate() {
            for (lane, score) in column.0.iter_mut().enumerate() {
                *score = points[lane.min(points.len() - 1)][i];
            }
        }
        scores
    }

    /// The correlated scores of independent ones.
    pub fn mixed(&self, scores: &[Column]) -> Vec<Column> {
        let Some(mixing) = &self.mixing else { return scores.to_vec() };
        mixing
            .iter()
            .map(|row| {
                let mut mixed = Column::ZERO;
                for (factor, score) in row.iter().zip(scores) {
                    if *factor != 0.0 {
                        for (out, score) in mixed.0.iter_mut().zip(&score.0) {
                            *out += factor * score;
                        }
                    }
                }
                mixed
            })
            .collect()
    }

    /// Goes through the rows of the data for up to a column of points.
    pub(crate) fn visit(&self, scores: &[Column], lanes: usize, visitor: &mut dyn Visitor) {
        let path = CodePath::best();
        path.run(Walk { path, likelihood: self, scores: self.mixed(scores), lanes, visitor });
    }

    /// The logarithms of the likelihood of up to a column of points; minus infinity where the model is
    /// not finite.
    pub(crate) fn log_likelihood(&self, scores: &[Column], lanes: usize) -> Vec<f64> {
        let mut sums = LikelihoodSums::new(self.covariance);
        self.visit(scores, lanes, &mut sums);
        sums.log_likelihood(self.covariance, self.data.len(), lanes)
    }

    /// The logarithm of prior density times likelihood in the first lanes, without the constant of
    /// normal scores.
    pub(crate) fn log_target(&self, scores: &[Column], lanes: usize) -> Vec<f64> {
        let likelihoods = self.log_likelihood(scores, lanes);
        let priors = ln_priors(&self.bounded(), scores);
        likelihoods.into_iter().zip(priors).map(|(ln, prior)| ln + prior).collect()
    }
}

/// The conditions of rows whose values no hypothesis changes: all but what a simulator gives.
pub(crate) fn known_conditions(case: &Case, rows: &[Row]) -> Vec<Vec<f64>> {
    let simulated = case.simulator.as_ref().and_then(|simulator| simulator.emulator());
    let known = simulated.map_or(case.model.conditions.len(), |_| case.described());
    rows.iter().map(|row| row.conditions[..known].to_vec()).collect()
}

/// For each input its values in the rows where it is no unknown quantity.
pub(crate) fn fixed_at(rows: &[Row], roles: &[Role]) -> Vec<Option<Vec<f64>>> {
    let inputs = rows.first().map_or(0, |row| row.distributions.len());
    (0..inputs)
        .map(|v| {
            let is_it = |role: &Role| matches!(role, Role::Variable { place, .. } if *place == v);
            let mean = |row: &Row| row.distributions[v].mean();
            (!roles.iter().any(is_it)).then(|| rows.iter().map(mean).collect())
        })
        .collect()
}

/// One pass over the data.
struct Walk<'w, 'c> {
    path: CodePath,
    likelihood: &'w Likelihood<'c>,
    scores: Vec<Column>,
    lanes: usize,
    visitor: &'w mut dyn Visitor,
}

impl Kernel for Walk<'_, '_> {
    type Output = ();

    // programs take most of the time
    const WIDEST: bool = false;

    #[inline(always)]
    fn run(self) {
        let Self { path, likelihood, scores, lanes, visitor } = self;
        let Likelihood { data, covariance, roles, evaluator, ln_sizes, simulated, .. } = likelihood;
        let count = data.outputs.len();
        let mut registers = evaluator.workspace();
        let mut varying: Vec<(usize, usize, &[super::latent::Map])> = Vec::new();
        let mut ln_noise = vec![Column::ZERO; count];
        let mut power = vec![Column::ZERO; count];
        let mut values = Column::ZERO;
        for (n, role) in roles.iter().enumerate() {
            match role {
                Role::Variable { place, maps } => {
                    for lane in 0..lanes {
                        values.0[lane] = maps[0].value(scores[n].0[lane]);
                    }
                    evaluator.set(&mut registers, *place, &values);
                    if maps.len() > 1 {
                        varying.push((n, *place, maps));
                    }
                }
                Role::Noise { output, map } => {
                    for lane in 0..lanes {
                        ln_noise[*output].0[lane] = map.value(scores[n].0[lane]);
                    }
                }
                Role::Power { output, map } => {
                    for lane in 0..lanes {
                        power[*output].0[lane] = map.value(scores[n].0[lane]);
                    }
                }
            }
        }
        let of_simulator = simulated.as_ref().map(|own| (own, own.lanes(roles, &scores, lanes)));
        let mut sims = vec![Column::ZERO; count];
        let mut raw = vec![Column::ZERO; count];
        let mut residuals = vec![Column::ZERO; count];
        let mut before = vec![Column::ZERO; count];
        let mut ln_variances = vec![Column::ZERO; count];
        // what the noise of the last row's outputs is made of, and the root of its inverse variance
        let mut last: Vec<Option<[f64; 3]>> = vec![None; count];
        let mut roots = vec![Column::ZERO; count];
        for (number, point) in data.points.iter().enumerate() {
            for (n, place, maps) in &varying {
                for lane in 0..lanes {
                    values.0[lane] = maps[number].value(scores[*n].0[lane]);
                }
                evaluator.set(&mut registers, *place, &values);
            }
            if let Some((own, outputs)) = &of_simulator {
                for (variable, values) in own.of_row(data.ids[point.rows[0]], outputs) {
                    evaluator.set_lanes(&mut registers, variable, values);
                }
            }
            evaluator.at(path, number, &mut registers, &mut sims);
            for &row in &point.rows {
                for output in 0..count {
                    let value = data.values[output][row];
                    let (raw, sim) = (&mut raw[output].0, &sims[output].0);
                    for lane in 0..COLUMN {
                        raw[lane] = value - sim[lane];
                    }
                    if let Some(turn) = data.turns[output] {
                        for residual in raw.iter_mut() {
                            *residual -= turn * (*residual / turn).round();
                        }
                    }
                }
                if covariance.fitted {
                    for output in 0..count {
                        let place = row * count + output;
                        let known = covariance.variances[place];
                        let variance_of = [known, ln_sizes[place], data.ln_scales[place]];
                        let is_same = last[output] == Some(variance_of);
                        last[output] = Some(variance_of);
                        if is_same {
                            // the columns are those of the row before
                        } else if data.uncertainties[output].is_some() {
                            ln_variances[output].0.fill(elementary::ln(known));
                        } else {
                            for lane in 0..lanes {
                                let ln = ln_noise[output].0[lane]
                                    + power[output].0[lane] * ln_sizes[place]
                                    + data.ln_scales[place];
                                ln_variances[output].0[lane] = if known > 0.0 {
                                    elementary::ln(elementary::exp(2.0 * ln) + known)
                                } else {
                                    2.0 * ln
                                };
                            }
                        }
                        if !is_same {
                            for lane in 0..lanes {
                                roots[output].0[lane] =
                                    elementary::exp(-0.5 * ln_variances[output].0[lane]);
                            }
                        }
                        for lane in 0..lanes {
                            residuals[output].0[lane] = raw[output].0[lane] * roots[output].0[lane];
                        }
                    }
                } else {
                    let root = &covariance.roots[row * triangle(count)..];
                    for i in 0..count {
                        let factor = root[triangle(i)];
                        for lane in 0..COLUMN {
                            residuals[i].0[lane] = factor * raw[0].0[lane];
                        }
                        for j in 1..=i {
                            let factor = root[triangle(i) + j];
                            for lane in 0..COLUMN {
                                residuals[i].0[lane] += factor * raw[j].0[lane];
                            }
                        }
                    }
                    if let Some(&lag) = covariance.lags.get(row) {
                        let scale = (1.0 - lag * lag).sqrt().recip();
                        for (here, before) in residuals.iter_mut().zip(&mut before) {
                            for lane in 0..COLUMN {
                                let own = here.0[lane];
                                here.0[lane] = (own - lag * before.0[lane]) * scale;
                                before.0[lane] = own;
                            }
                        }
                    }
                }
                visitor.row(path, row, &residuals, &ln_variances);
            }
        }
    }
}

/// Sums over the rows from which the likelihood follows.
struct LikelihoodSums<'c> {
    basis: &'c [Vec<f64>],
    squares: Column,
    half_ln_variances: Column,
    fitted: bool,
    products: Vec<Column>,
    /// With estimated noise: the lower triangle of L' inv(D) L.
    inner: Vec<Column>,
}

impl<'c> LikelihoodSums<'c> {
    fn new(covariance: &'c Covariance) -> Self {
        let k = covariance.basis.len();
        Self {
            basis: &covariance.basis,
            squares: Column::ZERO,
            half_ln_variances: Column::ZERO,
            fitted: covariance.fitted,
            products: vec![Column::ZERO; k],
            inner: vec![Column::ZERO; if covariance.fitted { triangle(k) } else { 0 }],
        }
    }

    fn log_likelihood(&self, covariance: &Covariance, values: usize, lanes: usize) -> Vec<f64> {
        let k = self.products.len();
        let mut inner = vec![0.0; self.inner.len()];
        let mut y = vec![0.0; k];
        (0..lanes)
            .map(|lane| {
                let mut half_ln_det = covariance.half_ln_det + self.half_ln_variances.0[lane];
                let root = if self.fitted {
                    for (sum, lanes) in inner.iter_mut().zip(&self.inner) {
                        *sum = lanes.0[lane];
                    }
                    for i in 0..k {
                        inner[triangle(i) + i] += 1.0;
                    }
                    packed::cholesky_of_definite(&mut inner);
                    half_ln_det += packed::ln_diagonal(&inner);
                    &inner
                } else {
                    &covariance.inner
                };
                for (y, product) in y.iter_mut().zip(&self.products) {
                    *y = product.0[lane];
                }
                packed::solve(root, &mut y);
                let square = self.squares.0[lane] - dot(&y, &y);
                let log = -0.5 * square - half_ln_det - values as f64 * HALF_LN_TWO_PI;
                if log.is_finite() { log } else { f64::NEG_INFINITY }
            })
            .collect()
    }
}

impl Visitor for LikelihoodSums<'_> {
    fn row(&mut self, path: CodePath, row: usize, residuals: &[Column], ln_variances: &[Column]) {
        path.run(RowOfSums { sums: self, row, residuals, ln_variances });
    }
}

struct RowOfSums<'a, 'c> {
    sums: &'a mut LikelihoodSums<'c>,
    row: usize,
    residuals: &'a [Column],
    ln_variances: &'a [Column],
}

impl Kernel for RowOfSums<'_, '_> {
    type Output = ();

    // programs take most of the time
    const WIDEST: bool = false;

    #[inline(always)]
    fn run(self) {
        let Self { sums, row, residuals, ln_variances } = self;
        let outputs = residuals.len();
        for (output, residual) in residuals.iter().enumerate() {
            for lane in 0..COLUMN {
                sums.squares.0[lane] += residual.0[lane] * residual.0[lane];
            }
            let place = row * outputs + output;
            if !sums.fitted {
                for (product, column) in sums.products.iter_mut().zip(sums.basis) {
                    let factor = column[place];
                    if factor != 0.0 {
                        for lane in 0..COLUMN {
                            product.0[lane] += factor * residual.0[lane];
                        }
                    }
                }
                continue;
            }
            for lane in 0..COLUMN {
                sums.half_ln_variances.0[lane] += 0.5 * ln_variances[output].0[lane];
            }
            if sums.basis.is_empty() {
                continue;
            }
            let mut root = Column::ZERO;
            for lane in 0..COLUMN {
                root.0[lane] = elementary::exp(-0.5 * ln_variances[output].0[lane]);
            }
            for (i, column) in sums.basis.iter().enumerate() {
                let factor = column[place];
                if factor == 0.0 {
                    continue;
                }
                for lane in 0..COLUMN {
                    sums.products[i].0[lane] += factor * root.0[lane] * residual.0[lane];
                }
                for (j, other) in sums.basis.iter().enumerate().take(i + 1) {
                    let product = factor * other[place];
                    if product != 0.0 {
                        let inner = &mut sums.inner[triangle(i) + j];
                        for lane in 0..COLUMN {
                            inner.0[lane] += product * root.0[lane] * root.0[lane];
                        }
                    }
                }
            }
        }
    }
}
