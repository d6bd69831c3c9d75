//! Values that are off beside a departure without a name.
//!
//! Where an effect acts that the list does not have, no hypothesis of the list leaves residuals in which
//! a wrong value would stand out. It stands out among its neighbours, though: a departure moves them
//! about as much as it. Such a value is proposed here, and weighed with "unexplained".

use crate::data::by_rows;
use crate::discrepancy::Discrepancy;
use crate::noise::noise_model::{NoiseModel, STILL_OFF, SUSPECT_SIZES, Suspect};
use crate::noise::weighing::Weighing;
use crate::posterior::ln_weight;
use crate::setup::Setup;
use gumption_engine::number::{elementary, largest_first, median};

/// Neighbours on each side that a value is compared with, at most.
const BESIDE: usize = 2;

/// A value differs from its neighbours by more than this, over the median of all such differences: of
/// normal noise a quarter of it is the most that is usual, and steps and narrow humps stay below it
/// where they have more than three rows.
const STANDS_OUT: f64 = 8.0;

/// So many of those that stand out are weighed.
const WEIGHED: usize = 2;

/// The logarithm of the weight of "unexplained" alone with these values off, but for its prior
/// probability: that of the values times the evidence of the residuals at the estimates.
pub(crate) fn ln_departure(weighing: &Weighing<'_>, suspects: &[Suspect]) -> f64 {
    let model = NoiseModel::with_suspects(suspects.to_vec());
    let prior = model.prior(weighing.setup.data.len());
    let setup = weighing.setup.with_noise(model);
    let residuals = by_rows(&setup.data.linear_residuals());
    let found = Discrepancy::new(&setup).evidence(&setup, &residuals, f64::NEG_INFINITY);
    elementary::ln(prior) + found.ln_evidence
}

/// The suspects of a weighing and a value that stands out among its neighbours, if "unexplained" with
/// them weighs more than `enough`.
pub(crate) fn beside_departure(last: &Weighing<'_>, enough: f64) -> Option<Vec<Suspect>> {
    let known = &last.setup.data.noise.suspects;
    let unexplained = last.setup.prior().unexplained;
    standing_out(&last.setup).into_iter().take(WEIGHED).find_map(|(ratio, row, output)| {
        let id = last.setup.data.ids[row];
        if known.iter().any(|known| known.is_of(id, output)) {
            return None;
        }
        // the least size that makes such a value usual
        let is_usual = |size: &(f64, f64)| ratio <= STILL_OFF * size.0;
        let size = SUSPECT_SIZES.iter().position(is_usual).unwrap_or(SUSPECT_SIZES.len() - 1);
        let mut more = known.clone();
        more.push(Suspect { id, output, size });
        (ln_weight(unexplained, ln_departure(last, &more)) > enough).then_some(more)
    })
}

/// Values that differ from their neighbours along each condition, most first, by how much over the
/// median of their output.
fn standing_out(setup: &Setup<'_>) -> Vec<(f64, usize, usize)> {
    let rows = setup.data.rows();
    let conditions = setup.case.set_conditions();
    let orders: Vec<Vec<usize>> = conditions.map(|condition| setup.rows_along(condition)).collect();
    let mut found = Vec::new();
    for (output, residuals) in setup.data.linear_residuals().into_iter().enumerate() {
        let scaled = |row: usize| match &setup.data.uncertainties[output] {
            Some(stated) => residuals[row] / stated[row],
            None => residuals[row],
        };
        let values: Vec<f64> = (0..rows).map(scaled).collect();
        let mut least = vec![f64::INFINITY; rows];
        for order in &orders {
            for (place, &row) in order.iter().enumerate() {
                let beside = place.saturating_sub(BESIDE)..rows.min(place + BESIDE + 1);
                let others = order[beside].iter().filter(|other| **other != row);
                let middle = median(others.map(|&other| values[other]).collect());
                let differs = middle.map_or(f64::INFINITY, |middle| (values[row] - middle).abs());
                least[row] = least[row].min(differs);
            }
        }
        let Some(usual) = median(least.clone()) else { continue };
        let ratios = least.into_iter().enumerate().map(|(row, least)| (least / usual, row, output));
        found.extend(ratios.filter(|(ratio, ..)| ratio.is_finite() && *ratio > STANDS_OUT));
    }
    largest_first(&mut found, |ratio| ratio.0);
    found
}
