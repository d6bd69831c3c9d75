//! The verdict alone: what a blind check asks of many data sets.

use super::diagnose::hypotheses;
use super::diagnosis::{Hypothesis, MostProbable, Predicted};
use super::known_gap::prediction;
use super::shrink;
use super::weighed::Weighed;
use crate::{Case, OverrideError};
use gumption_engine::task::Row;
use gumption_inference::noise::prior_widths::OtherPriors;
use gumption_inference::posterior::Effort;

/// A diagnosis without regions, cross-validation and advice.
#[derive(Clone, Debug)]
pub struct ModelSelection {
    /// The hypothesis of highest posterior probability.
    pub most_probable: MostProbable,
    /// All hypotheses, most probable first.
    pub hypotheses: Vec<Hypothesis>,
    /// Corrected predictions at the case's own rows.
    pub predicted: Vec<Predicted>,
    /// Posterior expectation of the fraction of the gap that the correction removes.
    pub claimed_fraction: f64,
}

/// The standard deviation of the noise of every measured value, output by output: as stated, or as
/// the case's own data tell.
///
/// # Errors
/// Effects that cannot act on the model.
pub fn noise(case: &Case, seed: u64) -> Result<Vec<Vec<f64>>, OverrideError> {
    case.check()?;
    let data = gumption_inference::data::Data::new(case);
    let stated: Option<Vec<Vec<f64>>> = data.uncertainties.into_iter().collect();
    Ok(stated.unwrap_or_else(|| {
        let others = OtherPriors::of(case);
        let weighed = Weighed::new(case, &others, seed, Effort::QUICK, &|_| {});
        let outputs = weighed.setup.data.outputs.len();
        (0..outputs)
            .map(|output| {
                let own = weighed.variances.iter().skip(output).step_by(outputs);
                own.map(|variance| variance.sqrt()).collect()
            })
            .collect()
    }))
}

/// What the model says of every observed output in every row at the inputs' estimates.
pub fn nominal(case: &Case) -> Vec<Vec<f64>> {
    let data = gumption_inference::data::Data::new(case);
    (0..data.outputs.len())
        .map(|output| data.point_of.iter().map(|&p| data.points[p].nominal[output]).collect())
        .collect()
}

/// Weighs the hypotheses of a case.
///
/// # Errors
/// Effects that cannot act on the model.
pub fn select_model(case: &Case, seed: u64) -> Result<ModelSelection, OverrideError> {
    case.check()?;
    let others = OtherPriors::of(case);
    let weighed = Weighed::new(case, &others, seed, Effort::QUICK, &|_| {});
    let rows: Vec<Row> = case.task.rows.clone();
    let group = weighed.indistinguishable();
    Ok(ModelSelection {
        most_probable: weighed.most_probable(&group, &weighed.shares()),
        hypotheses: hypotheses(&weighed.setup, &weighed.posterior, case.coverage_probability()),
        predicted: prediction(
            &weighed.setup,
            &weighed.discrepancy,
            &weighed.posterior,
            &weighed.compositions,
            &rows,
        )
        .0,
        claimed_fraction: shrink::claim(
            &weighed.setup,
            &weighed.discrepancy,
            &weighed.posterior,
            &weighed.correction,
            &weighed.variances,
        ),
    })
}
