//! The hypothesis "unexplained": the model plus a random discrepancy that no candidate makes.
//!
//! The discrepancy is one term of a small grammar (`grammar`), all of equal weight; its amplitude
//! is log-uniform from 3 to 300 standard uncertainties. Each term is a Gaussian process, so that its
//! evidence is exact.

mod features;
mod fitted;
mod form;
mod grammar;
mod prediction;

pub use features::Axes;
pub use form::HISTORY;
pub(crate) use form::{Form, forms};
pub(crate) use grammar::levels;
pub use grammar::{Of, Term};
pub use prediction::{conditioned, nominal};

use std::sync::Arc;

use gumption_engine::parallel;
use nalgebra::DVector;

use super::predict;
use super::search::Mode;
use super::setup::Setup;
use crate::logarithm::{HALF_LN_TWO_PI, ln_add};
use gumption_engine::number::{elementary, largest_first};

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

/// Effects that a discrepancy comes on top of.
#[derive(Clone, Debug)]
pub struct Base {
    /// Places of the candidates.
    pub effects: Vec<usize>,
    /// Scores of all unknown quantities, those of the inputs and the noise at 0.
    pub(crate) scores: Vec<f64>,
    /// What is said of the data, row by row.
    pub values: Vec<f64>,
}

impl Base {
    /// The effects of a hypothesis at one of its modes, the inputs at their estimates.
    pub fn at(setup: &Setup<'_>, effects: &[usize], mode: &Mode) -> Option<Self> {
        let mut scores = mode.scores.clone();
        scores.iter_mut().take(setup.roles.len()).for_each(|score| *score = 0.0);
        let rows = setup.all_rows();
        let values = predict::values(setup, effects, &[scores.clone()], &rows);
        let first = |draws: Vec<f64>| draws.first().copied();
        let values: Option<Vec<f64>> = values.into_iter().flatten().map(first).collect();
        Some(Self { effects: effects.to_vec(), scores, values: values? })
    }

    /// What is left of the data of a setup, row by row.
    pub fn residuals(&self, setup: &Setup<'_>) -> Vec<f64> {
        let outputs = setup.data.outputs.len();
        let of = |(value, sim): (usize, &f64)| {
            setup.data.residual(value % outputs, value / outputs, *sim)
        };
        self.values.iter().enumerate().map(of).collect()
    }
}

impl Unexplained {
    /// The same beside effects.
    pub fn beside(mut self, base: Base) -> Self {
        let base = Arc::new(base);
        for kind in &mut self.kinds {
            kind.base = Some(base.clone());
        }
        self
    }

    /// Adds other forms, whose evidence has this prior share; those here have the rest.
    pub(crate) fn joined(self, others: Vec<(f64, Arc<Base>, Self)>, rest: f64) -> Self {
        let mut parts: Vec<(f64, Weighted)> = Vec::new();
        let mut add = |ln: f64, base: Option<&Arc<Base>>, kinds: Vec<Weighted>| {
            for kind in kinds {
                let own = ln + elementary::ln(kind.weight.max(f64::MIN_POSITIVE));
                parts.push((own, Weighted { base: base.cloned(), ..kind }));
            }
        };
        add(elementary::ln(rest) + self.ln_evidence, None, self.kinds);
        for (ln_share, base, other) in others {
            add(ln_share + other.ln_evidence, Some(&base), other.kinds);
        }
        weigh(parts)
    }
}

impl Discrepancy {
    pub(crate) fn new(setup: &Setup<'_>) -> Self {
        let axes = Axes::new(setup.case, &setup.data);
        let longest = LENGTHS[LENGTHS.len() - 1];
        let forms = forms(setup, &axes, &|term, length, coordinates| {
            !term.is_smooth() || length >= coordinates.shortest_length().min(longest)
        });
        Self { axes, forms }
    }

    /// For a part of the data: the forms that all of them leave probable.
    pub fn for_part(&self, part: &Setup<'_>, found: &Unexplained) -> Self {
        let axes = Axes::new(part.case, &part.data);
        let own: Vec<&Form> = found.kinds.iter().map(|kind| &self.forms[kind.form]).collect();
        let wanted = |term: &Term, length: f64, _: &features::Coordinates| {
            own.iter().any(|f| f.term == *term && f.length == length)
        };
        let forms = forms(part, &axes, &wanted);
        if forms.is_empty() { Self::new(part) } else { Self { axes, forms } }
    }

    /// The evidence of residuals (row by row, outputs fastest) of a setup's data. What lies far below
    /// `floor`, a logarithm of evidence, need not be known well.
    pub fn evidence(&self, setup: &Setup<'_>, residuals: &[f64], floor: f64) -> Unexplained {
        if setup.linear.fitted {
            return fitted::evidence(self, setup, residuals, floor);
        }
        let whitened = setup.linear.whiten_blocks(residuals);
        let base = ln_normal(setup, &whitened);
        let whitened = DVector::from_column_slice(&whitened);
        let ln_amplitude = -elementary::ln(AMPLITUDE_STEPS as f64);
        let of_form = |(place, form): (usize, &Form)| {
            let (eigenvalues, scores) = form.scores(setup, &self.axes, &whitened);
            let mut parts: Vec<(f64, Weighted)> = Vec::with_capacity(AMPLITUDE_STEPS);
            for amplitude in amplitudes() {
                let a = amplitude * amplitude;
                let mut ln = base + form.ln_weight + ln_amplitude;
                for (eigenvalue, score) in eigenvalues.iter().zip(scores.iter()) {
                    let growth = 1.0 + a * eigenvalue;
                    ln += 0.5 * (a * score * score / growth - elementary::ln(growth));
                }
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
