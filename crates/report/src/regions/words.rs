//! What is said of a coverage region.

use crate::number::{degrees_of_freedom, exact, significant};
use crate::plain;
use crate::sheet::{Figure, Sheet};
use crate::table::unit_text;
use gumption_engine::decimal::to_position;
use gumption_engine::propagate::RegionEvaluation;
use gumption_engine::propagate::gum::Dof;
use gumption_engine::task::Task;

/// The names of the outputs.
pub(super) fn names(task: &Task, region: &RegionEvaluation) -> Vec<String> {
    let outputs = region.outputs.iter().filter_map(|output| task.model.outputs.get(*output));
    outputs.map(|output| plain(&output.quantity.name)).collect()
}

/// Where the factors of the law of propagation come from, where degrees of freedom are finite.
fn degrees(region: &RegionEvaluation) -> Option<String> {
    let gum = region.gum.as_ref()?;
    match region.dof? {
        Dof::Infinite => None,
        Dof::Finite(_) if gum.ellipsoid_k.is_none() => Some(
            "The law of propagation has no ellipsoid: the covariance matrix has too few degrees \
             of freedom for this number of outputs."
                .to_owned(),
        ),
        Dof::Finite(dof) => Some(format!(
            "The covariance matrix of the law of propagation has {}. The k of the ellipsoid is \
             from Hotelling's T^2 (an F distribution; JCGM 102, 5.3), the k of the box from t \
             distributions.",
            degrees_of_freedom(&significant(dof, 3))
        )),
        Dof::Undefined => Some(
            "The law of propagation has no factors: the degrees of freedom of correlated inputs \
             are finite, and the joint degrees of freedom are unknown."
                .to_owned(),
        ),
    }
}

/// The factors by both methods.
pub(super) fn sheet(region: &RegionEvaluation) -> Sheet {
    let (gum, found) = (region.gum.as_ref(), region.monte_carlo.as_ref());
    let k = |k: Option<f64>| Figure::rounded(k, |k| significant(k, 4));
    let error = |error: Option<f64>| Figure::rounded(error, |error| significant(error, 2));
    let mut sheet = Sheet::default();
    sheet.text("coverage factor", ["k of the ellipsoid".to_owned(), "k of the box".to_owned()]);
    let of_gum = [gum.and_then(|gum| gum.ellipsoid_k), gum.and_then(|gum| gum.box_k)];
    sheet.figures("law of propagation", of_gum.map(k));
    let of_trials =
        [found.and_then(|of| of.region.ellipsoid_k), found.and_then(|of| of.region.box_k)];
    sheet.figures("Monte Carlo", of_trials.map(k));
    let errors =
        [found.and_then(|found| found.ellipsoid_error), found.map(|found| found.box_error)];
    sheet.figures("numerical\nstd. error", errors.map(error));
    sheet
}

/// What the factors mean, the smallest region, and whether the two methods agree.
pub(super) fn sentences(task: &Task, region: &RegionEvaluation) -> Vec<String> {
    let percent = exact(to_position(100.0 * region.probability, -4));
    let mut said = vec![format!(
        "All outputs are in the ellipsoid (y - x)' U^-1 (y - x) <= k^2 with a probability of \
         {percent} %; U is their covariance matrix. They are in the box of half-lengths k u with \
         at least this probability (JCGM 102, 6.5)."
    )];
    said.extend(degrees(region));
    match region.monte_carlo.as_ref().map(|found| &found.smallest) {
        Some(Ok(smallest)) => {
            let units: Vec<String> = region
                .outputs
                .iter()
                .filter_map(|output| task.model.outputs.get(*output))
                .map(|output| unit_text(&output.quantity.unit).trim().to_owned())
                .filter(|unit| !matches!(unit.as_str(), "" | "1"))
                .map(|unit| plain(&unit))
                .collect();
            let unit =
                if units.is_empty() { String::new() } else { format!(" {}", units.join("*")) };
            said.push(format!(
                "The smallest region with this share of the trials has the volume {}{unit}, with \
                 a numerical standard error of {}.",
                significant(smallest.volume, 3),
                significant(smallest.error, 2),
            ));
        }
        Some(Err(reason)) => {
            said.push(format!("No volume of the smallest region is stated: {reason}."));
        }
        None => {}
    }
    if let Some(validation) = &region.validation {
        said.push(
            if validation.gum_valid {
                "Estimates, standard uncertainties, the largest eigenvalue of the correlation \
                 matrix and k of both methods agree within the numerical tolerance: the ellipsoid \
                 of the law of propagation is validated (JCGM 102, clause 8)."
            } else {
                "Estimates, standard uncertainties, the largest eigenvalue of the correlation \
                 matrix or k of both methods differ by more than the numerical tolerance: the \
                 ellipsoid of the law of propagation is not validated; use the ellipsoid of the \
                 trials (JCGM 102, clause 8)."
            }
            .to_owned(),
        );
    }
    said
}
