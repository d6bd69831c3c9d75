//! Noise that rows share which belong together: the readings at one set point, where each was set anew.
//!
//! The uncertainty that is stated beside readings is often their repeatability alone. What a bath, a
//! weight that was put on or a clamp did at that setting is the same in all its readings and not at the
//! next one (JCGM 100, H.5: a component between days beside that within days). Taken for a departure of
//! the sim it would be one that no effect explains, and would hide those that are seen within the
//! settings. It is a normal error of each setting, of a standard deviation that is a multiple of the
//! stated uncertainty of each output, beside the noise as stated.

use gumption_engine::linalg::dot;
use gumption_engine::number::elementary;

use crate::data::Data;
use crate::latent::Role;
use crate::{Case, ObservedOutput};

/// The standard deviations of the shared error that are weighed, in stated uncertainties.
pub const LIMITS: [f64; 2] = [0.5, 256.0];

/// Standard deviations of the shared error that are tried, in stated uncertainties, equally probable
/// beforehand.
pub const RATIOS: [f64; 10] = [LIMITS[0], 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, LIMITS[1]];

/// From this standard deviation on, in stated uncertainties, errors are a gap.
pub(crate) const DEPARTURE: f64 = 2.0;

/// The prior probability that an output has no such error where some output has.
const NONE: f64 = 0.5;

/// Errors of fewer settings are a function of them: a departure of the sim.
pub(crate) const LEAST_SETTINGS: usize = 5;

/// Rows of a setting, at least, in the mean of all.
const LEAST_ROWS: usize = 2;

/// So many errors of settings, at most: each is one more unknown quantity of the covariance.
const MOST_ERRORS: usize = 200;

/// The same where the noise is estimated, and with it that covariance for every draw.
const MOST_FITTED: usize = 100;

/// What the rows of a setting have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    /// The value of a condition.
    Condition(usize),
    /// The values of all conditions: repeats.
    All,
}

/// Errors that the rows of each setting share.
#[derive(Clone, Debug, PartialEq)]
pub struct SharedNoise {
    /// What tells settings apart.
    pub setting: Setting,
    /// How many ways of telling them apart are weighed.
    pub(crate) among: usize,
    /// For each observed output their standard deviation in standard uncertainties of the noise.
    pub ratios: Vec<f64>,
    /// For each of them the standard uncertainty of its noise within the settings, where none is stated.
    pub(crate) within: Vec<Option<f64>>,
}

impl SharedNoise {
    /// Its prior probability among all such noises of the case.
    pub(crate) fn prior(&self) -> f64 {
        let outputs = i32::try_from(self.ratios.len()).unwrap_or(i32::MAX);
        let each = self.ratios.iter().map(|ratio| match *ratio {
            0.0 => NONE,
            _ => (1.0 - NONE) / RATIOS.len() as f64,
        });
        each.product::<f64>() / (1.0 - NONE.powi(outputs)) / self.among.max(1) as f64
    }

    /// The same with errors in one output less: what is a departure along the settings there no
    /// hypothesis has at its modes.
    pub(crate) fn without_one(&self) -> Vec<Self> {
        let with_errors = |noise: &Self| noise.ratios.iter().any(|ratio| *ratio > 0.0);
        let outputs = (0..self.ratios.len()).filter(|&output| self.ratios[output] > 0.0);
        let without = outputs.map(|output| {
            let mut fewer = self.clone();
            fewer.ratios[output] = 0.0;
            fewer
        });
        without.filter(with_errors).collect()
    }

    /// Whether errors are so large that they are a gap, and not noise that is a little larger than stated.
    pub(crate) fn is_departure(&self) -> bool {
        self.ratios.iter().any(|ratio| *ratio >= DEPARTURE)
    }

    /// The standard deviation of an output's errors, in its unit.
    pub fn deviation(&self, data: &Data, output: usize) -> f64 {
        self.ratios[output] * self.typical(data, output)
    }

    /// The standard uncertainty of an output's noise, in its unit: the root mean square of the stated
    /// ones, or that within the settings.
    pub fn typical(&self, data: &Data, output: usize) -> f64 {
        let stated = data.uncertainties[output].as_deref().map(root_mean_square);
        stated.or(self.within[output]).unwrap_or(0.0)
    }

    /// Scores of unknown quantities with an estimated noise as it is within the settings: without errors of
    /// them it was larger.
    pub(crate) fn with_noise_within(&self, mut scores: Vec<f64>, roles: &[Role]) -> Vec<f64> {
        for (score, role) in scores.iter_mut().zip(roles) {
            if let Role::Noise { output, map } = role
                && let Some(within) = self.within.get(*output).copied().flatten()
                && self.ratios[*output] > 0.0
                && let Some(found) = map.score(elementary::ln(within))
            {
                *score = found;
            }
        }
        scores
    }

    /// The columns of the covariance's root: one for each setting and output.
    pub(crate) fn columns(&self, case: &Case, data: &Data) -> Vec<Vec<f64>> {
        let (rows, outputs) = (data.rows(), data.outputs.len());
        let settings = self.setting.of_rows(case);
        let count = count_of(&settings);
        let mut columns = Vec::new();
        for (output, &ratio) in self.ratios.iter().enumerate() {
            if ratio == 0.0 {
                continue;
            }
            let size = self.deviation(data, output);
            let mut own = vec![vec![0.0; rows * outputs]; count];
            for (row, &id) in data.ids.iter().enumerate() {
                own[settings[id]][row * outputs + output] = size;
            }
            columns.extend(own);
        }
        columns
    }
}

pub(crate) fn root_mean_square(values: &[f64]) -> f64 {
    (dot(values, values) / values.len().max(1) as f64).sqrt()
}

impl Setting {
    /// The setting of each row of a case, numbered in their order: rows that follow each other with the
    /// same values. What comes back with a value that was left in between is a function of it.
    pub(crate) fn of_rows(self, case: &Case) -> Vec<usize> {
        let of = |conditions: &[f64]| match self {
            Self::Condition(place) => conditions.get(place).map(|value| vec![value.to_bits()]),
            Self::All => Some(conditions.iter().map(|value| value.to_bits()).collect()),
        };
        let mut settings = Vec::with_capacity(case.task.rows.len());
        let (mut number, mut before) = (0, None);
        for row in &case.task.rows {
            let here = of(&row.conditions);
            number += usize::from(!settings.is_empty() && here != before);
            before = here;
            settings.push(number);
        }
        settings
    }

    /// The settings that rows of a case may share errors of, of several rows, and how many errors
    /// that are.
    pub(crate) fn candidates(case: &Case) -> Vec<(Self, usize)> {
        let outputs = case.observed.iter().flatten().count();
        let each = (0..case.measured()).map(Self::Condition).chain([Self::All]);
        let mut found: Vec<(Self, Vec<usize>)> = Vec::new();
        for setting in each {
            let rows = setting.of_rows(case);
            let count = count_of(&rows);
            // in rows of any order two follow each other by chance
            let are_held = LEAST_ROWS * count <= rows.len();
            if count >= LEAST_SETTINGS && are_held && found.iter().all(|(_, known)| *known != rows)
            {
                found.push((setting, rows));
            }
        }
        found.into_iter().map(|(setting, rows)| (setting, count_of(&rows) * outputs)).collect()
    }

    /// Those that are not too many.
    pub(crate) fn all(case: &Case) -> Vec<Self> {
        let most = most_errors(case);
        let all = Self::candidates(case).into_iter();
        all.filter(|(_, errors)| *errors <= most).map(|(setting, _)| setting).collect()
    }
}

/// The number of settings, from that of each row.
pub(crate) fn count_of(settings: &[usize]) -> usize {
    settings.last().map_or(0, |last| last + 1)
}

/// How many errors of settings are weighed, at most.
pub(crate) fn most_errors(case: &Case) -> usize {
    let is_stated = |output: &ObservedOutput| output.standard_uncertainties.is_some();
    match case.observed.iter().flatten().all(is_stated) {
        true => MOST_ERRORS,
        false => MOST_FITTED,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Over all combinations of two outputs the prior probabilities sum to one.
    #[test]
    fn priors_sum_to_one() {
        let each: Vec<f64> = std::iter::once(0.0).chain(RATIOS).collect();
        let mut sum = 0.0;
        for &first in &each {
            for &second in each.iter().filter(|second| first + *second > 0.0) {
                let (setting, ratios) = (Setting::All, vec![first, second]);
                let noise = SharedNoise { setting, among: 2, ratios, within: vec![None; 2] };
                sum += 2.0 * noise.prior();
            }
        }
        assert!((sum - 1.0).abs() < 1e-12, "{sum}");
    }
}
