//! The hypothesis "unexplained": the model plus a random discrepancy that no candidate makes.
//!
//! The discrepancy is one term of a small grammar (`grammar`); its amplitude
//! is log-uniform from 3 to 300 standard uncertainties. Each term is a Gaussian process, so that its
//! evidence is exact.

mod features;
mod fitted;
mod form;
mod grammar;
mod output_sets;
mod prediction;

pub use features::Axes;
pub use form::HISTORY;
pub(crate) use form::{Form, forms};
pub(crate) use grammar::levels;
pub use grammar::{Of, Term};
pub use output_sets::OutputSet;
pub use prediction::{conditioned, tangent};

use std::sync::Arc;

use gumption_engine::parallel;
use nalgebra::{DMatrix, DVector};

use super::latent::LN_BOUNDED;
use super::predict;
use super::setup::Setup;
use super::tangent::Tangent;
use crate::integral::search::Mode;
use crate::logarithm::{HALF_LN_TWO_PI, ln_add};
use gumption_engine::linalg::packed::{self, triangle};
use gumption_engine::number::{elementary, largest_first};
use gumption_engine::task::Row;

/// The lengths over which a smooth discrepancy varies, as shares of the range of what it is a
/// function of.
pub(crate) const LENGTHS: [f64; 6] = [0.05, 0.12, 0.29, 0.7, 1.7, 4.0];

/// Amplitudes in standard uncertainties (root mean square over the values that are touched).
const AMPLITUDES: [f64; 2] = [3.0, 300.0];

/// Points of the integral over the logarithm of the amplitude.
const AMPLITUDE_STEPS: usize = 48;

/// The amplitudes of the integral: midpoints, equally probable.
pub(crate) fn amplitudes() -> impl Iterator<Item = f64> {
    let [lower, upper] = AMPLITUDES;
    (0..AMPLITUDE_STEPS).map(move |step| {
        let share = (step as f64 + 0.5) / AMPLITUDE_STEPS as f64;
        lower * elementary::pow(upper / lower, share)
    })
}

/// How many amplitudes the integral has, with the noise estimated or known.
pub fn amplitude_steps(fitted: bool) -> usize {
    if fitted { fitted::STEPS } else { AMPLITUDE_STEPS }
}

/// The forms of a discrepancy for a design, ready for any data of it.
#[derive(Debug)]
pub struct Discrepancy {
    /// The conditions that departures are functions of.
    pub axes: Axes,
    /// Every form, each with its prior weight.
    pub forms: Vec<Form>,
    /// The outputs that may depart alike.
    sets: Vec<OutputSet>,
}

/// What parts of a hypothesis add to the sim at the data, by value: their expectations.
#[derive(Clone, Debug)]
pub struct Parts {
    /// The inputs, away from their estimates.
    pub inputs: Vec<f64>,
    /// The discrepancy.
    pub function: Vec<f64>,
}

/// What data say of the discrepancy.
#[derive(Clone, Debug)]
pub struct Unexplained {
    /// Logarithm of the evidence.
    pub ln_evidence: f64,
    /// Forms with amplitudes and posterior weights (of all; those that weigh little are left out),
    /// heaviest first.
    pub kinds: Vec<Weighted>,
}

/// A form with an amplitude.
#[derive(Clone, Debug)]
pub struct Weighted {
    /// Place of the form.
    pub form: usize,
    /// What the form's features are multiplied by.
    pub multiplier: f64,
    /// Posterior weight among all.
    pub weight: f64,
    /// The effects that act beside the discrepancy, if any.
    pub base: Option<Arc<Base>>,
    /// Variances of the noise by value, where they were estimated.
    pub variances: Option<Arc<Vec<f64>>>,
}

/// Effects that a discrepancy comes on top of, as if they were linear in their parameters about a point:
/// these are integrated out together with the discrepancy.
#[derive(Clone, Debug)]
pub struct Base {
    /// Places of the candidates.
    pub effects: Vec<usize>,
    /// Scores of all unknown quantities: of the inputs those at which the model is linear, of the noise 0.
    scores: Vec<f64>,
    /// How many of them are not parameters of the effects.
    shared: usize,
    /// What is said of the data, row by row, linear in the inputs and at their estimates.
    pub values: Vec<f64>,
    /// For each parameter the derivatives of these by its score.
    pub slopes: Vec<Vec<f64>>,
    /// The logarithm of the prior density of the parameters over that of standard normal scores.
    ln_prior: f64,
}

/// What a function adds to the variance of the residuals in some direction, over that of the noise, is left
/// out below this: it changes the logarithm of an evidence by half of it.
const LEAST_SHOWN: f64 = 1e-4;

/// Half the step of differences in the scores.
const STEP: f64 = 1e-3;

impl Base {
    /// The effects of a hypothesis at one of its modes, the inputs at their estimates. `None` where they
    /// have no value or no derivative.
    pub fn at(setup: &Setup<'_>, effects: &[usize], mode: &Mode) -> Option<Self> {
        let shared = setup.roles.len();
        let mut scores = mode.scores.clone();
        scores[..shared].copy_from_slice(&setup.case.linear_scores(&setup.roles));
        let bounded = setup.likelihood(effects).bounded();
        let ln_prior = (bounded.iter().zip(&scores).skip(shared))
            .filter(|(bounded, _)| **bounded)
            .map(|(_, score)| LN_BOUNDED + 0.5 * score * score)
            .sum();
        let effects = effects.to_vec();
        let (values, slopes) = (Vec::new(), Vec::new());
        let mut base = Self { effects, scores, shared, values, slopes, ln_prior };
        (base.values, base.slopes) = base.in_rows(setup, &setup.all_rows());
        let mut all = base.values.iter().chain(base.slopes.iter().flatten());
        all.all(|value| value.is_finite()).then_some(base)
    }

    /// What is said in rows, row by row, and for each parameter its derivatives by the score.
    pub(crate) fn in_rows(&self, setup: &Setup<'_>, rows: &[Row]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let mut points = vec![self.scores.clone()];
        for place in self.shared..self.scores.len() {
            for step in [STEP, -STEP] {
                let mut moved = self.scores.clone();
                moved[place] += step;
                points.push(moved);
            }
        }
        let values = predict::values(setup, &self.effects, &points, rows);
        let values: Vec<Vec<f64>> = values.into_iter().flatten().collect();
        let at_estimates = shifts(setup, rows);
        let of = |point: usize| values.iter().map(move |draws| draws[point]);
        let slope = |parameter: usize| -> Vec<f64> {
            let sides = of(2 * parameter + 1).zip(of(2 * parameter + 2));
            sides.map(|(up, down)| (up - down) / (2.0 * STEP)).collect()
        };
        let said = of(0).zip(at_estimates).map(|(value, shift)| value + shift);
        (said.collect(), (0..self.scores.len() - self.shared).map(slope).collect())
    }

    /// What is said of the data where only some of the effects act, at the same point.
    pub fn with(&self, setup: &Setup<'_>, acting: &[usize]) -> Vec<f64> {
        let mut scores = self.scores[..self.shared].to_vec();
        for &effect in acting {
            scores.extend_from_slice(&self.scores[setup.parameters(&self.effects, effect)]);
        }
        let rows = setup.all_rows();
        let values = predict::values(setup, acting, &[scores], &rows).into_iter().flatten();
        let said = values.filter_map(|draws| draws.first().copied()).zip(shifts(setup, &rows));
        said.map(|(value, shift)| value + shift).collect()
    }

    /// What slopes make of the scores of the point, for so many values.
    pub(crate) fn linear_part(&self, slopes: &[Vec<f64>], values: usize) -> Vec<f64> {
        let mut sum = vec![0.0; values];
        for (slope, score) in slopes.iter().zip(&self.scores[self.shared..]) {
            sum.iter_mut().zip(slope).for_each(|(sum, slope)| *sum += slope * score);
        }
        sum
    }

    /// What is left of the data of a setup, row by row.
    pub fn left(&self, setup: &Setup<'_>) -> Vec<f64> {
        let outputs = setup.data.outputs.len();
        let of = |(value, sim): (usize, &f64)| {
            setup.data.residual(value % outputs, value / outputs, *sim)
        };
        self.values.iter().enumerate().map(of).collect()
    }

    /// What is left of them before what the parameters do, which are linear and standard normal.
    pub fn residuals(&self, setup: &Setup<'_>) -> Vec<f64> {
        let linear = self.linear_part(&self.slopes, self.values.len());
        self.left(setup).iter().zip(linear).map(|(left, linear)| left + linear).collect()
    }
}

/// What the inputs add in rows, by value, on the way from where the model is linear to their estimates.
fn shifts(setup: &Setup<'_>, rows: &[Row]) -> Vec<f64> {
    if setup.case.is_linear_at_estimates() {
        return vec![0.0; rows.len() * setup.data.outputs.len()];
    }
    let shift = |row: &Row| -> Vec<f64> {
        let Tangent { touching, at_estimates, .. } = tangent(setup, row);
        at_estimates.iter().zip(touching).map(|(to, from)| to - from).collect()
    };
    rows.iter().flat_map(shift).collect()
}

impl Unexplained {
    /// Those of several, each with the logarithm of its share of the evidence.
    pub(crate) fn joined<'u>(of: impl Iterator<Item = (f64, &'u Self)>) -> Self {
        let mut parts: Vec<(f64, Weighted)> = Vec::new();
        for (ln_share, own) in of {
            let ln = |kind: &Weighted| {
                ln_share + own.ln_evidence + elementary::ln(kind.weight.max(f64::MIN_POSITIVE))
            };
            parts.extend(own.kinds.iter().map(|kind| (ln(kind), kind.clone())));
        }
        weigh(parts)
    }
}

impl Discrepancy {
    pub(crate) fn new(setup: &Setup<'_>) -> Self {
        let axes = Axes::new(setup.case, &setup.data);
        let longest = LENGTHS[LENGTHS.len() - 1];
        let sets = OutputSet::all(&setup.data);
        let forms = forms(setup, &axes, &sets, &|term, length, coordinates| {
            !term.is_smooth() || length >= coordinates.shortest_length().min(longest)
        });
        Self { axes, forms, sets }
    }

    /// Whether its forms are kept factored, so that more evidences with them cost little.
    pub(crate) fn is_kept(&self) -> bool {
        self.forms.iter().all(Form::is_kept)
    }

    /// For a part of the data: the forms that all of them leave probable.
    pub fn for_part(&self, part: &Setup<'_>, found: &[Weighted]) -> Self {
        let axes = Axes::new(part.case, &part.data);
        let own: Vec<&Form> = found.iter().map(|kind| &self.forms[kind.form]).collect();
        let wanted = |term: &Term, length: f64, _: &features::Coordinates| {
            own.iter().any(|f| f.term == *term && f.length == length)
        };
        let sets = self.sets.clone();
        let forms = forms(part, &axes, &sets, &wanted);
        if forms.is_empty() { Self::new(part) } else { Self { axes, forms, sets } }
    }

    /// A departure's functions at the data's values: columns whose factors are standard normal, as few as
    /// leave out nothing that shows beside the noise.
    pub(crate) fn columns(&self, setup: &Setup<'_>, kind: &Weighted) -> Vec<Vec<f64>> {
        let features = kind.multiplier * self.forms[kind.form].features(setup, &self.axes).as_ref();
        let variances = kind.variances.as_deref().unwrap_or(&setup.linear.variances);
        let mut white = features.clone();
        for (mut row, variance) in white.row_iter_mut().zip(variances) {
            row /= variance.max(f64::MIN_POSITIVE).sqrt();
        }
        let eigen = white.tr_mul(&white).symmetric_eigen();
        let shows = |&k: &usize| eigen.eigenvalues[k] > LEAST_SHOWN;
        let kept = (0..features.ncols()).filter(shows);
        kept.map(|k| (&features * eigen.eigenvectors.column(k)).as_slice().to_vec()).collect()
    }

    /// The evidence of residuals (row by row, outputs fastest) of a setup's data. What lies far below
    /// `floor`, a logarithm of evidence, need not be known well.
    pub fn evidence(&self, setup: &Setup<'_>, residuals: &[f64], floor: f64) -> Unexplained {
        if setup.linear.fitted {
            return fitted::evidence(self, setup, residuals, floor);
        }
        self.evidence_beside_columns(setup, residuals, &[])
    }

    /// The evidence of a setup's data with effects whose parameters are integrated out as well, each
    /// with its prior. What lies far below `floor` need not be known well.
    pub fn evidence_beside(&self, setup: &Setup<'_>, base: &Arc<Base>, floor: f64) -> Unexplained {
        let residuals = base.residuals(setup);
        let mut found = if setup.linear.fitted {
            let with = setup.with_functions(&base.slopes);
            fitted::evidence(self, &with, &residuals, floor - base.ln_prior)
        } else {
            self.evidence_beside_columns(setup, &residuals, &base.slopes)
        };
        found.ln_evidence += base.ln_prior;
        found.kinds.iter_mut().for_each(|kind| kind.base = Some(Arc::clone(base)));
        found
    }

    /// The evidence where the noise is known, with functions whose factors are standard normal
    /// integrated out: columns of values.
    fn evidence_beside_columns(
        &self,
        setup: &Setup<'_>,
        residuals: &[f64],
        columns: &[Vec<f64>],
    ) -> Unexplained {
        let whitened = setup.linear.whiten_blocks(residuals);
        let base = ln_normal(setup, &whitened);
        // the residuals last
        let all: Vec<DVector<f64>> =
            (columns.iter().map(|column| setup.linear.whiten_blocks(column)))
                .chain([whitened])
                .map(DVector::from_vec)
                .collect();
        let products = setup.linear.products(&all);
        let all = DMatrix::from_columns(&all);
        let ln_amplitude = -elementary::ln(AMPLITUDE_STEPS as f64);
        let of_form = |(place, form): (usize, &Form)| {
            let (eigenvalues, scores) = form.scores(setup, &self.axes, &all);
            let mut parts: Vec<(f64, Weighted)> = Vec::with_capacity(AMPLITUDE_STEPS);
            for amplitude in amplitudes() {
                let a = amplitude * amplitude;
                let mut ln = base + form.ln_weight + ln_amplitude;
                let mut left = products.clone();
                for (k, eigenvalue) in eigenvalues.iter().enumerate() {
                    let growth = 1.0 + a * eigenvalue;
                    ln -= 0.5 * elementary::ln(growth);
                    for i in 0..=columns.len() {
                        let own = a / growth * scores[(k, i)];
                        for j in 0..=i {
                            left[triangle(i) + j] -= own * scores[(k, j)];
                        }
                    }
                }
                ln += gain_of_columns(products[products.len() - 1], left, columns.len());
                let kind = Weighted {
                    form: place,
                    multiplier: amplitude,
                    weight: 0.0,
                    variances: None,
                    base: None,
                };
                parts.push((ln, kind));
            }
            parts
        };
        let parts = parallel::map(self.forms.iter().enumerate(), of_form);
        weigh(parts.into_iter().flatten().collect())
    }
}

/// By how much the logarithm of the density of residuals rises with a function, where columns with
/// standard normal factors are integrated out in both: `square` are the residuals without it, `left` the
/// products of columns and residuals (the last row) in the metric with it.
fn gain_of_columns(square: f64, mut left: Vec<f64>, columns: usize) -> f64 {
    let (gram, last) = left.split_at_mut(triangle(columns));
    for i in 0..columns {
        gram[triangle(i) + i] += 1.0;
    }
    packed::cholesky_of_definite(gram);
    let (products, own) = last.split_at_mut(columns);
    packed::solve(gram, products);
    let explained: f64 = products.iter().map(|y| y * y).sum();
    0.5 * (square - own[0] + explained) - packed::ln_diagonal(gram)
}

/// Normalizes kinds given with the logarithms of their evidence.
fn weigh(mut parts: Vec<(f64, Weighted)>) -> Unexplained {
    let ln_evidence = parts.iter().fold(f64::NEG_INFINITY, |sum, (ln, _)| ln_add(sum, *ln));
    parts.retain(|(ln, _)| *ln > ln_evidence - 7.0);
    largest_first(&mut parts, |a| a.0);
    let weighted = |(ln, kind): (f64, Weighted)| Weighted {
        weight: elementary::exp(ln - ln_evidence),
        ..kind
    };
    Unexplained { ln_evidence, kinds: parts.into_iter().map(weighted).collect() }
}

/// The logarithm of the density of residuals, whitened by the blocks, without any discrepancy.
pub fn ln_normal(setup: &Setup<'_>, whitened: &[f64]) -> f64 {
    let square = setup.linear.square(whitened);
    -0.5 * square - setup.linear.half_ln_det - whitened.len() as f64 * HALF_LN_TWO_PI
}
