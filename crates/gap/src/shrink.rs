//! How far the gap shrinks with the verdict's correction, on conditions that were not fitted.

use std::sync::atomic::{AtomicBool, Ordering};

use gumption_engine::parallel;

use super::composed::Compositions;
use super::departure_prediction;
use super::diagnosis::{RowGap, Shrinkage, Shrunk, ValueGap};
use gumption_engine::distribution::StreamKey;
use gumption_engine::number::{ascending, elementary};
use gumption_engine::task::Row;
use gumption_inference::beside::Beside;
use gumption_inference::data::{Data, by_rows, within_half_a_turn};
use gumption_inference::discrepancy::{Discrepancy, Weighted};
use gumption_inference::integral::evidence::EvidenceEstimate;
use gumption_inference::logarithm::{HALF_LN_TWO_PI, ln_sum};
use gumption_inference::noise::shared_noise::SharedNoise;
use gumption_inference::posterior::{Effort, Posterior};
use gumption_inference::predict::{self, Normals, Values};
use gumption_inference::setup::Setup;

/// Blocks of conditions that are left out in turn.
const BLOCKS: usize = 6;

/// Draws of the posterior that a prediction is averaged over.
const DRAWS: usize = 192;

/// Below this gap, in standard uncertainties, a removed fraction is a ratio of two noises.
const MEANINGFUL: f64 = 3.0;

/// What is added to the model.
#[derive(Clone, Debug)]
pub(crate) enum Correction {
    /// Effects, or none of them.
    Effects(Vec<usize>),
    /// A discrepancy, smooth or composed, beside effects or not.
    Departure(Compositions),
}

/// Shrinkage, and the data row by row. `variances` are those of the noise by value.
pub(crate) fn shrinkage(
    setup: &Setup<'_>,
    discrepancy: &Discrepancy,
    posterior: &Posterior,
    correction: &Correction,
    variances: &[f64],
    seed: u64,
    stop: Option<&AtomicBool>,
) -> (Shrinkage, Vec<RowGap>) {
    let data = &setup.data;
    let outputs = data.outputs.len();
    let rows = setup.all_rows();
    let before = by_rows(&data.nominal_residuals());
    // what the correction says of the data that it was fitted to
    let fitted = in_sample(setup, discrepancy, posterior, correction, &rows);
    let stopped = || stop.is_some_and(|stop| stop.load(Ordering::Relaxed));
    let blocks = blocks(setup);
    // without each block in turn
    let left_out = parallel::map(blocks, |block| {
        (!stopped()).then(|| {
            let fold = fold(setup, discrepancy, posterior, correction, &block, seed);
            (block, fold)
        })
    });
    let left_out: Option<Vec<(Vec<usize>, Fold)>> = left_out.into_iter().collect();
    let blocks = left_out.as_ref().map_or(0, Vec::len);
    let of_settings = variances_of_settings(setup);
    let mut predicted: Vec<(f64, f64)> = fitted.iter().flatten().copied().collect();
    let mut gain = 0.0;
    for (block, fold) in left_out.iter().flatten() {
        for (n, &row) in block.iter().enumerate() {
            for output in 0..outputs {
                let value = row * outputs + output;
                let (mean, variance) = fold.predicted[n][output];
                predicted[value] = (mean, variance + of_settings[value]);
            }
        }
        let noise: Vec<f64> = block
            .iter()
            .flat_map(|&row| (0..outputs).map(move |output| row * outputs + output))
            .map(|value| variances[value] + of_settings[value])
            .collect();
        let measured: Vec<f64> = block
            .iter()
            .flat_map(|&row| (0..outputs).map(move |output| data.values[output][row]))
            .collect();
        let turns = data.turns.repeat(block.len());
        let of = |density: &PredictiveDensity| density.ln_density(&measured, &noise, &turns);
        gain += of(&fold.density) - of(&fold.base);
    }
    let linear: Vec<f64> =
        rows.iter().flat_map(|row| predict::linear_variances(setup, row)).collect();
    let nominal_variances = input_variances(setup);
    let after: Vec<f64> = (0..data.len())
        .map(|value| data.residual(value % outputs, value / outputs, predicted[value].0))
        .collect();
    let of_rows: Vec<RowGap> = rows
        .iter()
        .enumerate()
        .map(|(row, row_values)| RowGap {
            conditions: row_values.conditions.clone(),
            outputs: (0..outputs)
                .map(|output| {
                    let value = row * outputs + output;
                    let noise = variances[value];
                    ValueGap {
                        measured: data.values[output][row],
                        u: noise.sqrt(),
                        before: before[value],
                        u_before: (noise + nominal_variances[value]).sqrt(),
                        u_validation: {
                            let stated = stated_variance(setup, row, output).unwrap_or(noise);
                            (stated + nominal_variances[value]).sqrt()
                        },
                        after: after[value],
                        u_after: (noise + predicted[value].1 + linear[value]).sqrt(),
                        left: data.residual(output, row, fitted[row][output].0),
                        u_corrected: (fitted[row][output].1 + linear[value]).sqrt(),
                    }
                })
                .collect(),
        })
        .collect();
    let scaled = |values: &[f64], weights: &[f64]| -> Vec<f64> {
        values.iter().zip(weights).map(|(r, v)| r * r / v).collect()
    };
    let (before2, after2) = (scaled(&before, variances), scaled(&after, variances));
    // the noise as it happened to be, from the whole fit: it is in `after` as well
    let noise2: Vec<f64> = (0..data.len())
        .map(|value| {
            let (mean, variance) = fitted[value / outputs][value % outputs];
            let residual = data.residual(value % outputs, value / outputs, mean);
            (residual * residual + variance) / variances[value]
        })
        .collect();
    let n = data.len() as f64;
    let mean = |squares: &[f64]| squares.iter().sum::<f64>() / squares.len().max(1) as f64;
    // noise in standard uncertainties is 1 but for chance
    let chance = 2.0 * (2.0 / n).sqrt();
    let floor2 = mean(&noise2).clamp(1.0 - chance.min(0.5), 1.0 + chance);
    let all = shrunk(mean(&before2), mean(&after2), floor2);
    let per_output = (0..outputs)
        .map(|output| {
            // a value that is off would be all of a mean in the output's unit
            let is_off = |row: &usize| data.noise.stretch(data.ids[*row], output) != 1.0;
            let kept: Vec<usize> = (0..rows.len()).filter(|row| !is_off(row)).collect();
            let of = |squares: &dyn Fn(usize) -> f64| -> f64 {
                mean(&kept.iter().map(|row| squares(row * outputs + output)).collect::<Vec<_>>())
            };
            let [before2, after2, noise2] = [
                of(&|value| before[value] * before[value]),
                of(&|value| after[value] * after[value]),
                of(&|value| variances[value]),
            ];
            shrunk(before2, after2, noise2 * floor2)
        })
        .collect();
    let claimed = claimed(setup, &fitted, variances);
    let within = |squares: &[f64], variance: &dyn Fn(&ValueGap) -> f64| {
        let held = of_rows
            .iter()
            .flat_map(|row| &row.outputs)
            .zip(squares)
            .filter(|(value, residual)| residual.abs() <= 2.0 * variance(value))
            .count();
        held as f64 / n
    };
    let shrinkage = Shrinkage {
        shares: Vec::new(),
        rms_after_interval: interval(&after2, setup.case.coverage_probability(), seed),
        meaningful: all.rms_before * all.rms_before - 1.0 >= MEANINGFUL * MEANINGFUL,
        claimed_fraction: claimed,
        chi2_per_dof: [
            normalized(&of_rows, |value| value.before / value.u_before),
            normalized(&of_rows, |value| value.after / value.u_after),
        ],
        within: [within(&before, &|value| value.u_before), within(&after, &|value| value.u_after)],
        log_density_gain: gain,
        blocks,
        values: data.len(),
        outputs: per_output,
        all,
    };
    (shrinkage, of_rows)
}

/// Mean square of normalized residuals.
fn normalized(rows: &[RowGap], z: impl Fn(&ValueGap) -> f64) -> f64 {
    let squares: Vec<f64> =
        rows.iter().flat_map(|row| &row.outputs).map(|value| z(value).powi(2)).collect();
    squares.iter().sum::<f64>() / squares.len().max(1) as f64
}

fn shrunk(before2: f64, after2: f64, floor2: f64) -> Shrunk {
    let removable = before2 - floor2;
    let fraction = if removable > 0.0 { (before2 - after2) / removable } else { 0.0 };
    Shrunk {
        rms_before: before2.sqrt(),
        rms_after: after2.sqrt(),
        noise_floor: floor2.sqrt(),
        removed_fraction: fraction.clamp(0.0, 1.0),
    }
}

/// The posterior expectation of the fraction of the gap that a correction removes.
pub(crate) fn claim(
    setup: &Setup<'_>,
    discrepancy: &Discrepancy,
    posterior: &Posterior,
    correction: &Correction,
    variances: &[f64],
) -> f64 {
    let rows = setup.all_rows();
    let fitted = in_sample(setup, discrepancy, posterior, correction, &rows);
    claimed(setup, &fitted, variances)
}

/// The posterior expectation of the removed fraction of the gap without noise.
fn claimed(setup: &Setup<'_>, fitted: &Normals, variances: &[f64]) -> f64 {
    let outputs = setup.data.outputs.len();
    let (mut left, mut gap) = (0.0, 0.0);
    for value in 0..variances.len() {
        let (mean, variance) = fitted[value / outputs][value % outputs];
        let nominal =
            setup.data.points[setup.data.point_of[value / outputs]].nominal[value % outputs];
        let shift = mean - nominal;
        left += variance / variances[value];
        gap += (shift * shift + variance) / variances[value];
    }
    if gap > 0.0 { (1.0 - left / gap).clamp(0.0, 1.0) } else { 0.0 }
}

/// The variance of a value that its case states: of the measured value and of the sim that came with it;
/// `None` where no uncertainty is stated.
fn stated_variance(setup: &Setup<'_>, row: usize, output: usize) -> Option<f64> {
    let (data, case) = (&setup.data, setup.case);
    let observed = case.observed.get(*data.outputs.get(output)?)?.as_ref()?;
    let id = *data.ids.get(row)?;
    let measured = observed.standard_uncertainties.as_ref()?.get(id)?;
    let of_sim = observed.simulation_uncertainties.as_ref().map_or(0.0, |u| u[id]);
    let covariance = observed.simulation_covariance.as_ref().map_or(0.0, |matrix| matrix[id][id]);
    Some(measured * measured + of_sim * of_sim + covariance)
}

/// Variances of the model's values from all inputs, by the law of propagation.
pub(crate) fn input_variances(setup: &Setup<'_>) -> Vec<f64> {
    let data = &setup.data;
    let outputs = data.outputs.len();
    (0..data.len())
        .map(|value| {
            let (row, output) = (value / outputs, value % outputs);
            let point = data.point_of[row];
            let gradients = &data.points[point].tangent.gradients[output];
            (0..gradients.len())
                .map(|v| (gradients[v] * setup.spread.deviations[v][point]).powi(2))
                .sum()
        })
        .collect()
}

/// What the correction says of the data that it was fitted to.
fn in_sample(
    setup: &Setup<'_>,
    discrepancy: &Discrepancy,
    posterior: &Posterior,
    correction: &Correction,
    rows: &[Row],
) -> Normals {
    match correction {
        Correction::Effects(effects) => {
            let own = posterior.hypotheses.iter().find(|h| h.effects == *effects);
            own.map_or_else(Vec::new, |own| {
                let draws = own.evidence.resampled(draws_for(rows.len()));
                moments(&predict::values(setup, effects, &draws, rows))
            })
        }
        Correction::Departure(compositions) => {
            let kinds = &posterior.kinds();
            departure_prediction::departure(setup, discrepancy, kinds, compositions, rows)
        }
    }
}

/// The kinds that make up nearly all of the weight.
pub(crate) fn top(kinds: &[Weighted]) -> &[Weighted] {
    let mut sum = 0.0;
    let total: f64 = kinds.iter().map(|kind| kind.weight).sum();
    let enough = kinds.iter().position(|kind| {
        sum += kind.weight;
        sum > 0.95 * total
    });
    &kinds[..enough.map_or(kinds.len(), |last| last + 1).min(40)]
}

/// Fewer draws for long records, so that memory stays small.
pub(crate) fn draws_for(rows: usize) -> usize {
    if rows > 5000 { 32 } else { DRAWS }
}

/// Means and variances over draws.
pub(crate) fn moments(values: &Values) -> Normals {
    let of = |draws: &Vec<f64>| {
        let n = draws.len().max(1) as f64;
        let mean = draws.iter().sum::<f64>() / n;
        let square = draws.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / n;
        (mean, square)
    };
    values.iter().map(|row| row.iter().map(of).collect()).collect()
}

/// What is predicted of a block of rows from all others.
struct Fold {
    predicted: Normals,
    density: PredictiveDensity,
    base: PredictiveDensity,
}

/// A predictive density of a block.
enum PredictiveDensity {
    /// A mixture over draws, each a value for every measured one.
    Draws(Vec<Vec<f64>>),
    /// Independent normal values.
    Normal(Vec<(f64, f64)>),
}

impl PredictiveDensity {
    fn of(values: &Values) -> Self {
        let draws = values.first().and_then(|row| row.first()).map_or(0, Vec::len);
        let flat: Vec<&Vec<f64>> = values.iter().flatten().collect();
        Self::Draws((0..draws).map(|d| flat.iter().map(|value| value[d]).collect()).collect())
    }

    /// The logarithm of the density of measured values with these variances of their noise; those of
    /// phases are within half a turn (`turns`) of what is predicted.
    fn ln_density(&self, measured: &[f64], noise: &[f64], turns: &[Option<f64>]) -> f64 {
        let ln = |mean: f64, value: f64, variance: f64, turn: Option<f64>| {
            let residual = within_half_a_turn(value - mean, turn);
            -0.5 * (residual.powi(2) / variance + elementary::ln(variance)) - HALF_LN_TWO_PI
        };
        let of_block = || measured.iter().zip(noise).zip(turns);
        match self {
            Self::Draws(draws) => {
                let each: Vec<f64> = draws
                    .iter()
                    .map(|draw| {
                        let each = draw.iter().zip(of_block());
                        each.map(|(mean, ((y, v), turn))| ln(*mean, *y, *v, *turn)).sum()
                    })
                    .collect();
                ln_sum(each.iter().copied()) - elementary::ln(each.len().max(1) as f64)
            }
            Self::Normal(values) => values
                .iter()
                .zip(of_block())
                .map(|((mean, variance), ((y, v), turn))| ln(*mean, *y, variance + v, *turn))
                .sum(),
        }
    }
}

/// For each value the variance of the error of its setting, of which rows of others say nothing.
fn variances_of_settings(setup: &Setup<'_>) -> Vec<f64> {
    let data = &setup.data;
    let outputs = data.outputs.len();
    let of = |value: usize| {
        let of = |noise: &SharedNoise| noise.deviation(data, value % outputs);
        data.noise.shared.as_ref().map_or(0.0, of).powi(2)
    };
    (0..data.len()).map(of).collect()
}

fn fold(
    setup: &Setup<'_>,
    discrepancy: &Discrepancy,
    posterior: &Posterior,
    correction: &Correction,
    block: &[usize],
    seed: u64,
) -> Fold {
    let others: Vec<usize> = (0..setup.data.rows())
        .filter(|row| block.binary_search(row).is_err())
        .map(|row| setup.data.ids[row])
        .collect();
    let rows: Vec<Row> = block.iter().map(|&row| setup.row(row).clone()).collect();
    let part = Setup::with_data_and_inputs(
        setup.case,
        Data::of(setup.case, others, setup.data.noise.clone()),
        setup.unknown_inputs.clone(),
        setup.noise_roles(),
    );
    let of = |effects: &Vec<usize>| {
        let likelihood = part.likelihood(effects);
        let whole = posterior.hypotheses.iter().find(|h| h.effects == *effects);
        let seeds: Vec<Vec<f64>> = whole
            .map(|h| h.evidence.modes.iter().map(|mode| mode.scores.clone()).collect())
            .unwrap_or_default();
        let key = StreamKey::new(seed, "gap/without a block");
        let many = part.data.len() > 20_000;
        let mut evidence =
            EvidenceEstimate::begin(&likelihood, key, &seeds, if many { 0 } else { 4 });
        for _ in 0..6 {
            if evidence.effective_sample_size > 150.0
                || many && evidence.effective_sample_size > 30.0
            {
                break;
            }
            evidence.refine(&likelihood, 2);
        }
        let draws = evidence.resampled(draws_for(rows.len()));
        predict::values(&part, effects, &draws, &rows)
    };
    let none = of(&Vec::new());
    match correction {
        Correction::Effects(effects) => {
            let values = if effects.is_empty() { none.clone() } else { of(effects) };
            Fold {
                predicted: moments(&values),
                density: PredictiveDensity::of(&values),
                base: PredictiveDensity::of(&none),
            }
        }
        Correction::Departure(compositions) => {
            let all = posterior.kinds();
            let discrepancy = discrepancy.for_part(&part, &all);
            // an effect that acts beside the discrepancy is fitted anew with it
            let beside = all.first().and_then(|kind| kind.base.as_ref()).and_then(|base| {
                let modes = &posterior.beside(&base.effects)?.named.evidence.modes;
                let key = StreamKey::new(seed, "gap/without a block");
                let effort = Effort { starts: 0, ..Effort::QUICK };
                let floor = f64::NEG_INFINITY;
                Beside::fitted(&part, &discrepancy, &base.effects, modes, key, effort, floor)
            });
            let found = match beside {
                Some(beside) => beside.departure,
                None => {
                    let residuals = by_rows(&part.data.linear_residuals());
                    discrepancy.evidence(&part, &residuals, f64::NEG_INFINITY)
                }
            };
            // the composed functions and their weights are those of all data; their sizes are not
            let compositions = compositions.for_part(setup, &part);
            let predicted = departure_prediction::within(
                &part,
                &discrepancy,
                &found.kinds,
                &compositions,
                &rows,
            );
            let density = PredictiveDensity::Normal(predicted.iter().flatten().copied().collect());
            Fold { predicted, density, base: PredictiveDensity::of(&none) }
        }
    }
}

/// Rows in blocks of whole levels of the condition with the most levels, or in their order. Levels
/// take turns, so that what is left out lies between conditions that are not. None of a single row,
/// without which nothing is left to fit.
pub(crate) fn blocks(setup: &Setup<'_>) -> Vec<Vec<usize>> {
    let rows = setup.data.rows();
    if rows < 2 {
        return Vec::new();
    }
    let conditions = setup.case.measured();
    let value = |row: usize, condition: usize| setup.row(row).conditions[condition];
    let levels = |condition: usize| {
        let mut values: Vec<f64> = (0..rows).map(|row| value(row, condition)).collect();
        ascending(&mut values);
        values.dedup();
        values
    };
    let widest =
        (0..conditions).max_by_key(|&condition| (levels(condition).len(), conditions - condition));
    let Some(condition) = widest.filter(|&condition| levels(condition).len() > 1) else {
        let count = BLOCKS.min(rows);
        return (0..count).map(|b| (0..rows).filter(|row| row % count == b).collect()).collect();
    };
    let levels = levels(condition);
    let count = BLOCKS.min(levels.len());
    let block_of =
        |row: usize| levels.partition_point(|level| *level < value(row, condition)) % count;
    let mut blocks = vec![Vec::new(); count];
    for row in 0..rows {
        blocks[block_of(row)].push(row);
    }
    blocks
}

/// Coverage interval of the root mean square of values with these squares: bootstrap.
fn interval(squares: &[f64], probability: f64, seed: u64) -> [f64; 2] {
    const RESAMPLED: usize = 1000;
    let count = squares.len();
    if count == 0 {
        return [0.0, 0.0];
    }
    let mut stream = StreamKey::new(seed, "gap/bootstrap").block(0);
    let mut uniform = [0.0; 128];
    let mut left = 0;
    let resamples = if count > 20_000 { 100 } else { RESAMPLED };
    let mut roots: Vec<f64> = (0..resamples)
        .map(|_| {
            let mut sum = 0.0;
            for _ in 0..count {
                if left == 0 {
                    stream.uniform(&mut uniform);
                    left = uniform.len();
                }
                left -= 1;
                sum += squares[((uniform[left] * count as f64) as usize).min(count - 1)];
            }
            (sum / count as f64).sqrt()
        })
        .collect();
    ascending(&mut roots);
    let tail = 0.5 * (1.0 - probability);
    let at = |p: f64| roots[((p * resamples as f64) as usize).min(resamples - 1)];
    [at(tail), at(1.0 - tail)]
}
