//! What is said of a coverage region.

use crate::number::{degrees_of_freedom, exact, significant};
use crate::plain;
use crate::sheet::{Figure, Sheet};
use gumption_engine::decimal::to_position;
use gumption_engine::propagate::gum::Dof;
use gumption_engine::propagate::{RegionEvaluation, RowEvaluation};
use gumption_engine::task::Task;

/// The names of the outputs.
pub(super) fn names(task: &Task, region: &RegionEvaluation) -> Vec<String> {
    let outputs = region.outputs.iter().filter_map(|output| task.model.outputs.get(*output));
    outputs.map(|output| plain(&output.quantity.name)).collect()
}

/// Effective degrees of freedom below which the factor of a t distribution is noteworthily larger than
/// that of a normal one: 2.01 in place of 1.96 for 95 %.
const FEW: f64 = 50.0;

/// The fewest effective degrees of freedom of a region's outputs where they are few and only the law of
/// propagation gives factors.
fn few_degrees_of_freedom(row: &RowEvaluation, region: &RegionEvaluation) -> Option<String> {
    let of_output = |output: &usize| row.outputs.get(*output)?.gum.as_ref();
    let dof = region.outputs.iter().filter_map(of_output).map(|gum| match gum.dof {
        Dof::Finite(dof) => dof,
        Dof::Infinite => f64::INFINITY,
        // of correlated readings, of which the components know
        Dof::Undefined => gum.budget().map(|line| line.dof).fold(f64::INFINITY, f64::min),
    });
    let fewest = dof.fold(f64::INFINITY, f64::min);
    let is_alone = region.monte_carlo.is_none() && region.gum.is_some();
    (is_alone && fewest < FEW).then(|| significant(fewest, 2))
}

/// The factors by both methods.
pub(super) fn sheet(region: &RegionEvaluation) -> Sheet {
    let (gum, found) = (region.gum.as_ref(), region.monte_carlo.as_ref());
    let k = |k: Option<f64>| Figure::rounded(k, |k| significant(k, 4));
    let error = |error: Option<f64>| Figure::rounded(error, |error| significant(error, 2));
    let mut sheet = Sheet::default();
    sheet.text("coverage factor", ["k of the ellipsoid".to_owned(), "k of the box".to_owned()]);
    let of_gum = [gum.and_then(|gum| gum.ellipsoid_k), gum.map(|gum| gum.box_k)];
    sheet.figures("law of propagation", of_gum.map(k));
    let of_trials =
        [found.and_then(|found| found.region.ellipsoid_k), found.map(|found| found.region.box_k)];
    sheet.figures("Monte Carlo", of_trials.map(k));
    let errors =
        [found.and_then(|found| found.ellipsoid_error), found.map(|found| found.box_error)];
    sheet.figures("numerical\nstd. error", errors.map(error));
    sheet
}

/// What the factors mean, the smallest region, and whether the two methods agree.
pub(super) fn sentences(
    task: &Task,
    row: &RowEvaluation,
    region: &RegionEvaluation,
) -> Vec<String> {
    let percent = exact(to_position(100.0 * region.probability, -4));
    let mut said = vec![format!(
        "With a probability of {percent} % all outputs lie together in the ellipsoid \
         (y - x)' U^-1 (y - x) <= k^2, U being their covariance matrix, and in the box of half-lengths \
         k u (JCGM 102, 6.5)."
    )];
    said.extend(few_degrees_of_freedom(row, region).map(|dof| {
        format!(
            "The factors of the law of propagation are those of a normal distribution, though an \
             output has {}: with them the regions hold less than {percent} %.",
            degrees_of_freedom(&dof)
        )
    }));
    if let Some((found, smallest)) =
        region.monte_carlo.as_ref().and_then(|found| Some((found, found.smallest?)))
    {
        let units: Vec<String> = region
            .outputs
            .iter()
            .filter_map(|output| task.model.outputs.get(*output))
            .map(|output| output.quantity.unit.text().trim().to_owned())
            .filter(|unit| !matches!(unit.as_str(), "" | "1"))
            .map(|unit| plain(&unit))
            .collect();
        let unit = if units.is_empty() { String::new() } else { format!(" {}", units.join("*")) };
        said.push(format!(
            "The smallest region that holds as many trials has the volume {}{unit}, with a numerical \
             standard error of {}: {} cells of a mesh.",
            significant(smallest.volume, 3),
            significant(found.volume_error.unwrap_or(f64::NAN), 2),
            smallest.cells
        ));
    }
    if let Some(validation) = &region.validation {
        said.push(
            if validation.gum_valid {
                "Estimates, standard uncertainties, the largest eigenvalue of the correlation matrix and \
                 k of both methods agree within the numerical tolerance: the ellipsoid of the law of \
                 propagation is valid here (JCGM 102, clause 8)."
            } else {
                "Estimates, standard uncertainties, the largest eigenvalue of the correlation matrix or \
                 k of both methods differ by more than the numerical tolerance: the ellipsoid of the law \
                 of propagation is not confirmed; take that of the trials (JCGM 102, clause 8)."
            }
            .to_owned(),
        );
    }
    said
}
