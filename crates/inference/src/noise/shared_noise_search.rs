//! Which errors of settings may be worth an evidence of their own, by what hypotheses leave of the data.

use gumption_engine::linalg::dot;
use gumption_engine::number::{elementary, largest_first};
use gumption_engine::parallel;

use crate::Case;
use crate::data::Data;
use crate::discrepancy::levels;
use crate::logarithm::ln_add;
use crate::noise::noise_model::{NoiseModel, WORTH_TRYING};
use crate::noise::remainder::Remainder;
use crate::noise::shared_noise::{DEPARTURE, RATIOS, Setting, SharedNoise, count_of, most_errors};
use crate::noise::weighing::{Weighing, ln_total, ln_weight_at_mode};
use crate::posterior::WeighedHypothesis;
use crate::setup::Setup;

/// Standard deviations are tried that are as probable as the best by a factor of this logarithm.
const NEAR: f64 = 4.0;

/// Errors that are not weighed are told where the density of what is left rises with them by a factor
/// of this logarithm.
const CLEAR: f64 = 10.0;

/// From this probability of "unexplained" on, with the noise as stated, errors are tried beside a departure.
const UNEXPLAINED: f64 = 0.5;

/// Models that are tried, at most.
const MOST_MODELS: usize = 6;

impl Setting {
    /// Whether a condition had each of its values once.
    pub fn is_per_value(self, case: &Case, data: &Data) -> bool {
        let Self::Condition(place) = self else { return false };
        count_of(&self.of_rows(case)) == levels(case, data, place)
    }
}

/// Errors of settings that a hypothesis leaves and that are too many to be weighed.
#[derive(Clone, Copy, Debug)]
pub struct TooMany {
    /// The output where they are clearest.
    pub output: usize,
    /// Their standard deviation in standard uncertainties of the noise.
    pub ratio: f64,
    /// How many there are, over all outputs.
    pub errors: usize,
    /// How many would be weighed.
    pub most: usize,
}

/// Errors of settings that were not weighed, where what the hypothesis leaves speaks clearly for them.
pub fn not_weighed(setup: &Setup<'_>, hypothesis: &WeighedHypothesis) -> Option<TooMany> {
    let most = most_errors(setup.case);
    let candidates = Setting::candidates(setup.case);
    let mut too_many = candidates.into_iter().filter(|(_, errors)| *errors > most).peekable();
    too_many.peek()?;
    let left = Remainder::of(setup, hypothesis);
    let mut found: Vec<(f64, TooMany)> = Vec::new();
    for (setting, errors) in too_many {
        let groups = Groups::of(setup, setting);
        for output in 0..groups.outputs {
            let of = |ratio: f64| {
                let all = TooMany { output, ratio, errors, most };
                (groups.gain(&left, output, ratio), all)
            };
            found.extend(RATIOS.map(of));
        }
    }
    let best = found.into_iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
    (best.0 > CLEAR && best.1.ratio >= DEPARTURE).then_some(best.1)
}

/// The shared errors that may be worth an evidence of their own: by the densities of the residuals that
/// the hypotheses leave at their modes, with such errors and without.
pub(crate) fn worth_trying(weighings: &[Weighing<'_>]) -> Vec<SharedNoise> {
    let Some(Weighing { setup, posterior, .. }) = weighings.first() else { return Vec::new() };
    let settings = Setting::all(setup.case);
    if settings.is_empty() {
        return Vec::new();
    }
    let left: Vec<(f64, Remainder)> = parallel::map(&posterior.hypotheses, |hypothesis| {
        (ln_weight_at_mode(setup, hypothesis), Remainder::of(setup, hypothesis))
    });
    let Some((_, leading)) = left.iter().max_by(|a, b| a.0.total_cmp(&b.0)) else {
        return Vec::new();
    };
    let mut found = Vec::new();
    for &setting in &settings {
        let groups = Groups::of(setup, setting);
        // for each hypothesis and output the gain with each standard deviation
        let gains: Vec<Vec<Vec<f64>>> = left
            .iter()
            .map(|(_, left)| {
                let of = |output| RATIOS.map(|ratio| groups.gain(left, output, ratio)).to_vec();
                (0..groups.outputs).map(of).collect()
            })
            .collect();
        let within = |output: usize| groups.within(leading, output).map(|(_, within)| within);
        let within: Vec<Option<f64>> = (0..groups.outputs).map(within).collect();
        let ln: Vec<f64> = left.iter().map(|(ln, _)| *ln).collect();
        for ratios in combinations(&ln, &gains) {
            let of = |(output, ratio): (usize, &Option<usize>), gains: &[Vec<f64>]| {
                ratio.map_or(0.0, |ratio| gains[output][ratio])
            };
            let ln = ln.iter().zip(&gains).map(|(ln, gains)| {
                ln + ratios.iter().enumerate().map(|ratio| of(ratio, gains)).sum::<f64>()
            });
            let ln = ln.fold(f64::NEG_INFINITY, ln_add);
            let ratios =
                ratios.iter().map(|ratio| ratio.map_or(0.0, |place| RATIOS[place])).collect();
            let (among, within) = (settings.len(), within.clone());
            let noise = SharedNoise { setting, among, ratios, within };
            let prior = NoiseModel::with_shared(noise.clone()).prior(setup.data.len());
            found.push((ln + elementary::ln(prior), noise));
        }
    }
    largest_first(&mut found, |(ln, _)| *ln);
    let leading = found.first().map(|(ln, noise)| {
        let alike: Vec<SharedNoise> =
            std::iter::once(noise.clone()).chain(noise.without_one()).collect();
        (*ln, alike)
    });
    let best = found.iter().map(|(ln, _)| *ln).fold(ln_total(weighings), f64::max);
    let is_worth = |ln: f64| ln - best > elementary::ln(WORTH_TRYING);
    let mut found: Vec<SharedNoise> = found
        .into_iter()
        .filter_map(|(ln, noise)| is_worth(ln).then_some(noise))
        .take(MOST_MODELS)
        .collect();
    // a departure beside such errors is in none of these estimates, and one over a short length looks
    // like such errors
    let is_unexplained = posterior.departs() > UNEXPLAINED;
    if let Some((_, alike)) = leading.filter(|(ln, _)| is_worth(*ln) || is_unexplained) {
        let more: Vec<SharedNoise> =
            alike.into_iter().filter(|alike| !found.contains(alike)).collect();
        found.extend(more);
    }
    found
}

/// The standard deviations of all outputs, as places in the list or none, of which each alone is near the
/// most probable of its output; at least one output has an error.
fn combinations(ln: &[f64], gains: &[Vec<Vec<f64>>]) -> Vec<Vec<Option<usize>>> {
    let outputs = gains.first().map_or(0, Vec::len);
    let mut all: Vec<Vec<Option<usize>>> = vec![Vec::new()];
    for output in 0..outputs {
        let each = [None].into_iter().chain((0..RATIOS.len()).map(Some));
        let with_ln = each.map(|place| {
            let gain = |gains: &Vec<Vec<f64>>| place.map_or(0.0, |place| gains[output][place]);
            let of = ln.iter().zip(gains).map(|(ln, gains)| ln + gain(gains));
            (place, of.fold(f64::NEG_INFINITY, ln_add))
        });
        let with_ln: Vec<(Option<usize>, f64)> = with_ln.collect();
        let best = with_ln.iter().map(|(_, ln)| *ln).fold(f64::NEG_INFINITY, f64::max);
        let near: Vec<Option<usize>> =
            with_ln.iter().filter(|(_, ln)| best - ln < NEAR).map(|(place, _)| *place).collect();
        all = all
            .iter()
            .flat_map(|before| near.iter().map(|place| [&before[..], &[*place]].concat()))
            .collect();
    }
    all.retain(|ratios| ratios.iter().any(Option::is_some));
    all
}

/// The rows of each setting.
#[derive(Debug)]
pub struct Groups {
    rows: Vec<Vec<usize>>,
    outputs: usize,
}

impl Groups {
    /// Of the rows of a case.
    pub fn of(setup: &Setup<'_>, setting: Setting) -> Self {
        let settings = setting.of_rows(setup.case);
        let mut rows = vec![Vec::new(); count_of(&settings)];
        for (row, &id) in setup.data.ids.iter().enumerate() {
            rows[settings[id]].push(row);
        }
        Self { rows, outputs: setup.data.outputs.len() }
    }

    /// Where the noise is estimated the standard deviation of an output's noise within the settings: as
    /// a share of that without errors of them, and in its unit.
    pub(crate) fn within(&self, left: &Remainder, output: usize) -> Option<(f64, f64)> {
        let places = || (output..left.deviations.len()).step_by(self.outputs);
        let (mut squares, mut free) = (0.0, 0.0);
        for rows in &self.rows {
            let own = self.own(left, rows, output);
            let mean = own.iter().sum::<f64>() / own.len().max(1) as f64;
            squares += own.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
            free += own.len().saturating_sub(1) as f64;
        }
        let variance = squares / free;
        let typical = places().map(|place| left.deviations[place].powi(2)).sum::<f64>()
            / places().count() as f64;
        (variance > 0.0 && typical > 0.0).then(|| (variance.sqrt(), (variance * typical).sqrt()))
    }

    /// The residuals of an output in some rows.
    fn own(&self, left: &Remainder, rows: &[usize], output: usize) -> Vec<f64> {
        let at = |row: &usize| left.residuals.get(row * self.outputs + output).copied();
        rows.iter().filter_map(at).collect()
    }

    /// By how much the logarithm of the density of an output's residuals rises if the rows of a setting
    /// share an error of a standard deviation in standard uncertainties of the noise, which is then
    /// that within the settings where it is estimated.
    pub fn gain(&self, left: &Remainder, output: usize, ratio: f64) -> f64 {
        let within = match left.deviations.is_empty() {
            true => 1.0,
            false => match self.within(left, output) {
                Some((share, _)) => share,
                None => return f64::NEG_INFINITY,
            },
        };
        let square = ratio * ratio;
        let of = |rows: &Vec<usize>| {
            let own = self.own(left, rows, output);
            let shares = rows.iter().filter_map(|row| left.shares.get(row * self.outputs + output));
            let squares = dot(&own, &own);
            let (mut sum, mut total) = (0.0, 1.0);
            for (own_value, share) in own.iter().zip(shares) {
                sum += share * own_value / within;
                total += square * share * share;
            }
            let noise = squares * (1.0 - 1.0 / (within * within))
                - 2.0 * own.len() as f64 * elementary::ln(within);
            0.5 * (noise + square * sum * sum / total - elementary::ln(total))
        };
        self.rows.iter().map(of).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The gain is the difference of logarithms of two normal densities, computed by their matrices.
    #[test]
    fn gain_by_determinants() {
        let groups = Groups { rows: vec![vec![0, 2], vec![1], vec![3, 4, 5]], outputs: 1 };
        let residuals = vec![0.7, -1.2, 1.9, 0.3, -0.4, 2.2];
        let shares = vec![1.0, 0.5, 2.0, 1.0, 0.3, 1.4];
        let [residuals_of, deviations] = [residuals.clone(), Vec::new()];
        let mut left = Remainder { residuals: residuals_of, deviations, shares: shares.clone() };
        let ratio = 1.7;
        let mut wanted = 0.0;
        for rows in &groups.rows {
            let n = rows.len();
            let matrix = nalgebra::DMatrix::from_fn(n, n, |i, j| {
                ratio * ratio * shares[rows[i]] * shares[rows[j]] + f64::from(u8::from(i == j))
            });
            let r = nalgebra::DVector::from_iterator(n, rows.iter().map(|&row| residuals[row]));
            let inverse = matrix.clone().try_inverse().unwrap();
            wanted += 0.5 * (r.dot(&r) - r.dot(&(inverse * &r)) - matrix.determinant().ln());
        }
        let found = groups.gain(&left, 0, ratio);
        assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
        // an estimated noise of 0.1, which is smaller within the settings
        left.deviations = vec![0.1; 6];
        let (share, within) = groups.within(&left, 0).unwrap();
        assert!((within - 0.1 * share).abs() < 1e-15);
        let scaled = residuals.iter().map(|r| r / share).collect();
        let own = Remainder { residuals: scaled, deviations: Vec::new(), shares };
        let ln_normal =
            |s: f64| -> f64 { residuals.iter().map(|r| -0.5 * (r / s).powi(2) - s.ln()).sum() };
        let wanted = groups.gain(&own, 0, ratio) + ln_normal(share) - ln_normal(1.0);
        let found = groups.gain(&left, 0, ratio);
        assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
    }
}
