//! What is known of a gap once it is diagnosed, as far as predictions need it.

use std::sync::Arc;

use super::composed::Compositions;
use super::diagnosis::{Diagnosis, DiagnosisNote, HypothesisKind, MostProbable, Predicted};
use super::{departure, departure_prediction, shrink};
use crate::Case;
use gumption_engine::fact;
use gumption_engine::fact::Fact;
use gumption_engine::number::elementary;
use gumption_engine::task::Row;
use gumption_inference::discrepancy::Discrepancy;
use gumption_inference::noise::noise_model::NoiseModel;
use gumption_inference::posterior::Posterior;
use gumption_inference::predict;
use gumption_inference::setup::Setup;

/// The hypotheses of a case with what the data say of each.
#[derive(Debug)]
pub(crate) struct KnownGap {
    /// With priors of the widths that are most probable.
    pub(crate) case: Case,
    /// What is most probable of the noise.
    pub(crate) noise: NoiseModel,
    pub(crate) discrepancy: Arc<Discrepancy>,
    pub(crate) posterior: Posterior,
    pub(crate) compositions: Compositions,
    /// For each observed output the variance of its noise that all values share.
    pub(crate) shared: Vec<f64>,
}

impl KnownGap {
    /// A case with the noise that is most probable.
    pub(crate) fn setup<'c>(&self, case: &'c Case) -> Setup<'c> {
        Setup::new(case).with_noise(self.noise.clone())
    }

    /// Adds the corrected predictions in rows of conditions to a diagnosis, and the notes on them. `case` is
    /// the one that was diagnosed; of one with a simulator, after runs in these rows.
    pub(crate) fn predict(&self, case: &Case, at: &[Row], diagnosis: &mut Diagnosis) {
        let setup = self.setup(case);
        let Self { discrepancy, posterior, compositions, shared, .. } = self;
        let (mut rows, partly_defined) =
            prediction(&setup, discrepancy, posterior, compositions, at);
        enlarge(&mut rows, shared);
        let undefined = (partly_defined > 0)
            .then(|| fact!("undefined-prediction", count = partly_defined, rows = at.len()));
        let extrapolated = extrapolated(&setup, posterior, &diagnosis.most_probable, at);
        let facts = undefined.into_iter().chain(extrapolated);
        diagnosis.notes.extend(facts.map(|fact| DiagnosisNote { fact }));
        diagnosis.prediction = Some(rows);
    }
}

/// What is to be said of predictions outside of the conditions of the data: how a departure that
/// nothing of the list explains goes on the data do not tell, and that an effect does is a statement
/// of its formula.
fn extrapolated(
    setup: &Setup<'_>,
    posterior: &Posterior,
    verdict: &MostProbable,
    at: &[Row],
) -> Option<Fact> {
    let outside = departure_prediction::outside(setup, at);
    let rows = at.len();
    if outside == 0 {
        None
    } else if posterior.departs() > departure::WORTH_TELLING {
        Some(fact!("extrapolation", outside, rows))
    } else if verdict.kind == HypothesisKind::Explained {
        Some(fact!("extrapolation.effects", outside, rows))
    } else {
        None
    }
}

/// A prediction is stated where hypotheses of at least this probability are defined.
const DEFINED: f64 = 0.5;

/// Hypotheses of less than this probability do not count in predictions.
const LEAST_SHARE: f64 = 1e-3;

/// Corrected predictions, averaged over the hypotheses by their probabilities: over those that are defined
/// in a row; not a number where these are less probable than the others. With the number of rows in which
/// some are not.
pub(crate) fn prediction(
    setup: &Setup<'_>,
    discrepancy: &Discrepancy,
    posterior: &Posterior,
    compositions: &Compositions,
    rows: &[Row],
) -> (Vec<Predicted>, usize) {
    let outputs = setup.data.outputs.len();
    let mut sums = vec![vec![(0.0, 0.0, 0.0); outputs]; rows.len()];
    let mut total = 0.0;
    let mut add = |share: f64, normals: &predict::Normals| {
        total += share;
        for (sums, values) in sums.iter_mut().zip(normals) {
            for (sum, (mean, variance)) in sums.iter_mut().zip(values) {
                // what is not defined there says nothing
                if !(mean.is_finite() && variance.is_finite()) {
                    continue;
                }
                sum.0 += share * mean;
                sum.1 += share * (variance + mean * mean);
                sum.2 += share;
            }
        }
    };
    for hypothesis in posterior
        .hypotheses
        .iter()
        .filter(|h| h.probability > LEAST_SHARE && h.evidence.has_draws())
        .filter(|h| setup.case.can_predict(&h.effects))
    {
        let draws = hypothesis.evidence.resampled(shrink::draws_for(rows.len()));
        let values = predict::values(setup, &hypothesis.effects, &draws, rows);
        add(hypothesis.probability, &shrink::moments(&values));
    }
    if posterior.departs() > LEAST_SHARE {
        let mut kinds = posterior.kinds();
        kinds.retain(|kind| {
            let effects = kind.base.as_ref().map_or(&[][..], |base| &base.effects);
            setup.case.can_predict(effects)
        });
        let normals =
            departure_prediction::departure(setup, discrepancy, &kinds, compositions, rows);
        add(posterior.departs(), &normals);
    }
    let is_partly = |sums: &&Vec<(f64, f64, f64)>| {
        sums.iter().any(|(_, _, share)| *share < (1.0 - LEAST_SHARE) * total)
    };
    let partly_defined = sums.iter().filter(is_partly).count();
    let rows = rows
        .iter()
        .zip(sums)
        .map(|(row, sums)| {
            let linear = predict::linear_variances(setup, row);
            let outputs = sums.iter().zip(linear).map(|((mean, square, share), linear)| {
                if *share < DEFINED * total {
                    return (f64::NAN, f64::NAN);
                }
                let mean = mean / share;
                let variance = (square / share - mean * mean).max(0.0) + linear;
                (mean, variance.sqrt())
            });
            let model = predict::nominal(setup, row);
            let outputs = outputs.collect();
            Predicted { conditions: row.conditions.clone(), outputs, model }
        })
        .collect();
    (rows, partly_defined)
}

/// Adds variances to the predictions of outputs.
fn enlarge(rows: &mut [Predicted], variances: &[f64]) {
    for row in rows {
        for ((_, u), variance) in row.outputs.iter_mut().zip(variances) {
            *u = elementary::hypot(*u, variance.sqrt());
        }
    }
}
