//! What it does to the evidence of a hypothesis if values of the data are off.
//!
//! In the Gaussian approximation at its best mode the data are normal with covariance C = V + H H', H
//! being their derivatives by the scores, and inv(C) (y - E y) = inv(V) r with the residuals r at the
//! mode. Variances s^2 added to values change the logarithm of the density by
//!
//! -ln|I + S inv(C) S|/2 + |inv(K) S g|^2/2,
//!
//! with the rows and columns of inv(C) and the elements of g = inv(V) r of these values, S the
//! diagonal matrix of the s and K the Cholesky root of I + S inv(C) S (Sherman, Morrison, Woodbury).

use nalgebra::{DMatrix, DVector};

use crate::noise::noise_model::{SUSPECT_SIZES, Suspect};
use crate::posterior::WeighedHypothesis;
use crate::setup::Setup;
use crate::whitened::{self, WhitenedResiduals};
use gumption_engine::linalg::dot;
use gumption_engine::linalg::packed::{self, triangle};
use gumption_engine::number::elementary;

/// Half the step of differences in the scores.
const STEP: f64 = 1e-4;

/// A gain for each size of what is wrong with a value.
pub(crate) type SizeGains = [f64; SUSPECT_SIZES.len()];

/// The inverse covariance of the data of a hypothesis and what it makes of the residuals.
pub(crate) struct Influence {
    outputs: usize,
    /// For each value its standard uncertainty.
    uncertainties: Vec<f64>,
    /// For each value the whitened unit vector of it, within its row.
    units: Vec<f64>,
    /// For each value what the unit vector is in terms of all that is common to several rows.
    halves: Vec<f64>,
    /// The elements of inv(V) r.
    pulls: Vec<f64>,
    /// For each output, where its noise is estimated, the sum of the squares of its whitened
    /// residuals.
    squares: Vec<Option<f64>>,
}

impl Influence {
    /// That of a hypothesis at its best mode.
    pub(crate) fn of(setup: &Setup<'_>, hypothesis: &WeighedHypothesis) -> Option<Self> {
        let mode = hypothesis.evidence.modes.first()?;
        let likelihood = setup.likelihood(&hypothesis.effects);
        let covariance = likelihood.covariance;
        let unknowns = likelihood.unknowns();
        let mut points = vec![mode.scores.clone()];
        for i in 0..unknowns {
            for step in [-STEP, STEP] {
                let mut moved = mode.scores.clone();
                moved[i] += step;
                points.push(moved);
            }
        }
        let found = whitened::residuals(&likelihood, &points);
        let WhitenedResiduals { values: residuals, ln_variances } = found.first()?;
        let values = residuals.len();
        let outputs = setup.data.outputs.len();
        // the whitened columns of what is integrated out, and of the scores
        let mut columns: Vec<Vec<f64>> = if covariance.fitted {
            let root = |(value, x): (usize, &f64)| x * elementary::exp(-0.5 * ln_variances[value]);
            covariance.basis.iter().map(|c| c.iter().enumerate().map(root).collect()).collect()
        } else {
            covariance.basis.clone()
        };
        columns.extend((0..unknowns).filter(|&i| !likelihood.roles[i].is_noise()).map(|i| {
            let (low, high) = (&found[1 + 2 * i].values, &found[2 + 2 * i].values);
            low.iter().zip(high).map(|(low, high)| (high - low) / (2.0 * STEP)).collect()
        }));
        let k = columns.len();
        let information = DMatrix::from_fn(k, k, |i, j| {
            dot(&columns[i], &columns[j]) + if i == j { 1.0 } else { 0.0 }
        });
        let root = information.cholesky()?;
        let products = DVector::from_fn(k, |i, _| dot(&columns[i], residuals));
        // of what is integrated out linearly the residuals at the mode are not free yet
        let free = covariance.basis.len();
        let mut adjusted = residuals.clone();
        if free > 0 {
            let inner = root.l().view((0, 0), (free, free)).into_owned();
            let half = inner.solve_lower_triangular(&products.rows(0, free).into_owned())?;
            let solved = inner.tr_solve_lower_triangular(&half)?;
            for (column, factor) in columns.iter().take(free).zip(solved.iter()) {
                for (adjusted, x) in adjusted.iter_mut().zip(column) {
                    *adjusted -= factor * x;
                }
            }
        }
        let lower = packed::of_matrix(&root.l());
        let mut uncertainties = Vec::with_capacity(values);
        let mut units = vec![0.0; values * outputs];
        let mut halves = vec![0.0; values * k];
        let mut pulls = Vec::with_capacity(values);
        for (value, unit) in units.chunks_mut(outputs).enumerate() {
            let (row, output) = (value / outputs, value % outputs);
            // the whitened unit vector of the value: nothing of it lies outside of its row
            uncertainties.push(match (&setup.data.uncertainties[output], covariance.fitted) {
                (Some(u), _) => u[row],
                (None, _) => elementary::exp(0.5 * ln_variances[value]),
            });
            if covariance.fitted {
                unit[output] = elementary::exp(-0.5 * ln_variances[value]);
            } else {
                let block = &covariance.roots[row * triangle(outputs)..];
                for (i, part) in packed::rows(&block[..triangle(outputs)]).enumerate() {
                    unit[i] = part.get(output).copied().unwrap_or(0.0);
                }
            }
            let at = row * outputs;
            let half = &mut halves[value * k..(value + 1) * k];
            for (half, column) in half.iter_mut().zip(&columns) {
                *half = dot(&column[at..at + outputs], unit);
            }
            packed::solve(&lower, half);
            pulls.push(dot(unit, &adjusted[at..at + outputs]));
        }
        let square = |output: usize| {
            let own = adjusted.iter().skip(output).step_by(outputs);
            setup.data.uncertainties[output].is_none().then(|| own.map(|r| r * r).sum())
        };
        let squares = (0..outputs).map(square).collect();
        Some(Self { outputs, uncertainties, units, halves, pulls, squares })
    }

    /// Number of values.
    pub(crate) fn values(&self) -> usize {
        self.pulls.len()
    }

    /// An element of inv(C).
    fn inverse(&self, one: usize, other: usize) -> f64 {
        let k = self.halves.len() / self.values();
        let half = |value: usize| &self.halves[value * k..(value + 1) * k];
        let unit = |value: usize| &self.units[value * self.outputs..(value + 1) * self.outputs];
        let within = if one / self.outputs == other / self.outputs {
            dot(unit(one), unit(other))
        } else {
            0.0
        };
        within - dot(half(one), half(other))
    }

    /// The standard deviation of what is wrong with a value.
    fn deviation(&self, value: usize, size: usize) -> f64 {
        SUSPECT_SIZES[size].0 * self.uncertainties[value]
    }

    /// With values that are off, each with the place of the size of what is wrong with it.
    pub(crate) fn with(&self, off: &[(usize, usize)]) -> WithOff<'_> {
        let deviations: Vec<f64> =
            off.iter().map(|&(value, size)| self.deviation(value, size)).collect();
        let mut root = vec![0.0; triangle(off.len())];
        for (i, (one, _)) in off.iter().enumerate() {
            for (j, (other, _)) in off.iter().enumerate().take(i + 1) {
                let product = deviations[i] * deviations[j] * self.inverse(*one, *other);
                root[triangle(i) + j] = product + if i == j { 1.0 } else { 0.0 };
            }
        }
        packed::cholesky_of_definite(&mut root);
        let mut solved: Vec<f64> =
            off.iter().zip(&deviations).map(|((value, _), s)| s * self.pulls[*value]).collect();
        packed::solve(&root, &mut solved);
        let members = off.iter().zip(deviations).map(|((value, _), s)| (*value, s)).collect();
        WithOff { influence: self, members, root, solved }
    }

    /// What is wrong with values, as all others have it.
    pub(crate) fn errors(&self, values: &[usize]) -> Option<Vec<f64>> {
        let k = values.len();
        let inverse = DMatrix::from_fn(k, k, |i, j| self.inverse(values[i], values[j]));
        let pulls = DVector::from_fn(k, |i, _| self.pulls[values[i]]);
        Some(inverse.cholesky()?.solve(&pulls).iter().copied().collect())
    }

    /// As the gain of these values, where the noise of some outputs is estimated: values that are off
    /// enlarge the noise in which they hide, and it falls as they are told. Its standard deviation is
    /// the most probable one, what is left of the squares is that without these values, and each of
    /// them has the size that suits what is wrong with it, which is put into `off`.
    pub(crate) fn gain_with_less_noise(&self, off: &mut [(usize, usize)]) -> f64 {
        let mut gain = 0.0;
        let is_of = |value: usize, output: usize| value % self.outputs == output;
        let stated = |&(value, _): &(usize, usize)| self.squares[value % self.outputs].is_none();
        let known: Vec<(usize, usize)> = off.iter().copied().filter(stated).collect();
        gain += self.with(&known).gain();
        for (output, square) in self.squares.iter().enumerate() {
            let own: Vec<usize> =
                off.iter().map(|value| value.0).filter(|value| is_of(*value, output)).collect();
            let (Some(square), false) = (square, own.is_empty()) else { continue };
            let Some(errors) = self.errors(&own) else { return f64::NEG_INFINITY };
            let explained: f64 =
                own.iter().zip(&errors).map(|(value, error)| error * self.pulls[*value]).sum();
            let k = own.len();
            let count = self.values() / self.outputs;
            let rest = count.saturating_sub(k).max(1) as f64;
            let left = (square - explained).max(LEAST_LEFT * square);
            let mut variance = left / rest;
            // in units of the noise before
            let errors: Vec<f64> = own
                .iter()
                .zip(errors)
                .map(|(value, error)| error / self.uncertainties[*value])
                .collect();
            let mut sizes = vec![0; k];
            let ln_density = |size: usize, error: f64, variance: f64| {
                let (size, prior) = SUSPECT_SIZES[size];
                let square = error * error / (size * size * variance);
                elementary::ln(prior / size) - 0.5 * square
            };
            for _ in 0..ROUNDS {
                for (size, error) in sizes.iter_mut().zip(&errors) {
                    let of = |size: &usize| ln_density(*size, *error, variance);
                    let all = 0..SUSPECT_SIZES.len();
                    *size = all.max_by(|a, b| of(a).total_cmp(&of(b))).unwrap_or(0);
                }
                let square =
                    |(size, error): (&usize, &f64)| (error / SUSPECT_SIZES[*size].0).powi(2);
                let own: f64 = sizes.iter().zip(&errors).map(square).sum();
                variance = (left + own) / count as f64;
            }
            // at the most probable variance all squares together are as many as there are values
            gain += 0.5 * square - 0.5 * count as f64 * (1.0 + elementary::ln(variance));
            gain -= sizes.iter().map(|size| elementary::ln(SUSPECT_SIZES[*size].0)).sum::<f64>();
            let members = off.iter_mut().filter(|value| is_of(value.0, output));
            members.zip(sizes).for_each(|(member, size)| member.1 = size);
        }
        gain
    }

    /// Whether the noise of an output is estimated.
    pub(crate) fn is_fitted(&self) -> bool {
        self.squares.iter().any(Option::is_some)
    }
}

/// Rounds in which the noise and the sizes of what is wrong with values are found from each other.
const ROUNDS: usize = 4;

/// The share of the squares of residuals that is left at least, whatever values are off.
const LEAST_LEFT: f64 = 1e-10;

/// What is known of the data once some values are off.
pub(crate) struct WithOff<'i> {
    influence: &'i Influence,
    /// The values and the standard deviations of what is wrong with them.
    members: Vec<(usize, f64)>,
    root: Vec<f64>,
    solved: Vec<f64>,
}

impl WithOff<'_> {
    /// By how much the logarithm of the evidence rises.
    pub(crate) fn gain(&self) -> f64 {
        0.5 * dot(&self.solved, &self.solved) - packed::ln_diagonal(&self.root)
    }

    /// By how much it rises if a further value is off by each size.
    pub(crate) fn more(&self, value: usize) -> SizeGains {
        let influence = self.influence;
        let (mut c, mut g) = (influence.inverse(value, value), influence.pulls[value]);
        if !self.members.is_empty() {
            let members = self.members.iter();
            let mut shared: Vec<f64> =
                members.map(|(member, s)| s * influence.inverse(value, *member)).collect();
            packed::solve(&self.root, &mut shared);
            c -= dot(&shared, &shared);
            g -= dot(&shared, &self.solved);
        }
        std::array::from_fn(|size| {
            let s2 = influence.deviation(value, size).powi(2);
            let growth = 1.0 + s2 * c.max(0.0);
            0.5 * (s2 * g * g / growth - elementary::ln(growth))
        })
    }
}

/// A value of the data, as its place and the size of what is wrong with it, of the case.
pub(crate) fn suspect(setup: &Setup<'_>, (value, size): (usize, usize)) -> Suspect {
    let outputs = setup.data.outputs.len();
    Suspect { id: setup.data.ids[value / outputs], output: value % outputs, size }
}
