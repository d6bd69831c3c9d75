//! A coverage region for programs.

use gumption_engine::propagate::gum::Dof;
use gumption_engine::propagate::{JointRegion, RegionEvaluation, RegionValidation, SampledRegion};
use gumption_engine::task::Task;
use serde::Serialize;

/// A coverage region in the answer.
#[derive(Serialize)]
pub(crate) struct RegionSide<'a> {
    outputs: Vec<&'a str>,
    probability: f64,
    gum: Option<LawSide<'a>>,
    monte_carlo: Option<SampledSide<'a>>,
    validation: Option<ValidationSide>,
}

/// By the law of propagation, with the effective degrees of freedom of the covariance matrix where they
/// are finite.
#[derive(Serialize)]
struct LawSide<'a> {
    #[serde(flatten)]
    region: JointSide<'a>,
    dof: Option<f64>,
}

#[derive(Serialize)]
struct JointSide<'a> {
    estimates: &'a [f64],
    covariance: Vec<&'a [f64]>,
    ellipsoid_k: Option<f64>,
    box_k: Option<f64>,
}

#[derive(Serialize)]
struct SampledSide<'a> {
    trials: u64,
    #[serde(flatten)]
    region: JointSide<'a>,
    smallest: Option<SmallestSide>,
    /// Why there is no smallest region.
    #[serde(skip_serializing_if = "Option::is_none")]
    no_smallest: Option<&'a str>,
    numerical_standard_error: ErrorSide,
}

#[derive(Serialize)]
struct SmallestSide {
    volume: f64,
}

#[derive(Serialize)]
struct ErrorSide {
    ellipsoid_k: Option<f64>,
    box_k: f64,
    volume: Option<f64>,
}

/// Moduli of differences, each with its tolerance.
#[derive(Serialize)]
struct ValidationSide {
    estimates: Vec<[f64; 2]>,
    standard_uncertainties: Vec<[f64; 2]>,
    largest_eigenvalue: [f64; 2],
    ellipsoid_k: Option<[f64; 2]>,
    gum_valid: bool,
}

impl<'a> RegionSide<'a> {
    pub(crate) fn of(task: &'a Task, region: &'a RegionEvaluation) -> Self {
        let output = |number: &usize| task.model.outputs.get(*number);
        let names = region.outputs.iter().filter_map(output);
        Self {
            outputs: names.map(|output| output.quantity.name.as_str()).collect(),
            probability: region.probability,
            gum: region.gum.as_ref().map(|gum| LawSide {
                region: JointSide::of(gum),
                dof: match region.dof {
                    Some(Dof::Finite(dof)) => Some(dof),
                    _ => None,
                },
            }),
            monte_carlo: region.monte_carlo.as_ref().map(SampledSide::of),
            validation: region.validation.as_ref().map(ValidationSide::of),
        }
    }
}

impl<'a> JointSide<'a> {
    fn of(region: &'a JointRegion) -> Self {
        let rows = region.covariance.chunks_exact(region.estimates.len().max(1));
        Self {
            estimates: &region.estimates,
            covariance: rows.collect(),
            ellipsoid_k: region.ellipsoid_k,
            box_k: region.box_k,
        }
    }
}

impl<'a> SampledSide<'a> {
    fn of(found: &'a SampledRegion) -> Self {
        let smallest = found.smallest.as_ref().ok();
        Self {
            trials: found.trials,
            region: JointSide::of(&found.region),
            smallest: smallest.map(|of| SmallestSide { volume: of.volume }),
            no_smallest: found.smallest.as_ref().err().map(String::as_str),
            numerical_standard_error: ErrorSide {
                ellipsoid_k: found.ellipsoid_error,
                box_k: found.box_error,
                volume: smallest.map(|of| of.error),
            },
        }
    }
}

impl ValidationSide {
    fn of(validation: &RegionValidation) -> Self {
        let (estimates, uncertainties) =
            validation.differences.split_at(validation.differences.len() / 2);
        Self {
            estimates: estimates.to_vec(),
            standard_uncertainties: uncertainties.to_vec(),
            largest_eigenvalue: validation.eigenvalue,
            ellipsoid_k: validation.ellipsoid,
            gum_valid: validation.gum_valid,
        }
    }
}
