//! What makes how much of a gap: the mean square of the residuals as the effects of the verdict, and what
//! is left beside them, are taken out of the data one after the other.
//!
//! All are at their best point together, the inputs too, so that an input whose value is hardly known is no
//! part of the gap.

use super::diagnosis::{GapPart, GapShare};
use gumption_inference::discrepancy::{Base, Discrepancy, Weighted};
use gumption_inference::integral::search::Mode;
use gumption_inference::setup::Setup;

/// The shares of effects at a mode and of the heaviest of the departures beside them, what takes most first
/// and the noise last. `variances` are those of the noise by value. Empty where the effects have no value.
pub(crate) fn shares(
    setup: &Setup<'_>,
    discrepancy: &Discrepancy,
    effects: &[usize],
    mode: &Mode,
    departure: Option<&Weighted>,
    variances: &[f64],
) -> Vec<GapShare> {
    let found = Base::at(setup, effects, mode)
        .and_then(|base| Some((discrepancy.parts(setup, &base, departure, variances)?, base)));
    let Some((parts, base)) = found else { return Vec::new() };
    let outputs = setup.data.outputs.len();
    let square = |taken: &[f64]| {
        let of = |(value, variance): (usize, &f64)| {
            let said = taken[value] + parts.inputs[value];
            let (row, output) = (value / outputs, value % outputs);
            setup.data.residual(output, row, said).powi(2) / variance
        };
        variances.iter().enumerate().map(of).sum::<f64>() / variances.len().max(1) as f64
    };
    let said = |acting: &[usize]| base.with(setup, acting);
    let mut acting: Vec<usize> = Vec::new();
    let whole = square(&said(&acting));
    let mut last = whole;
    let mut shares = Vec::new();
    let mut take = |what: GapPart, left: f64| {
        shares.push(GapShare { what, share_of_gap: (last - left) / whole });
        last = left;
    };
    while acting.len() < effects.len() {
        let more = |effect: usize| -> Vec<usize> {
            // in the order of the list, as they are composed
            let is_in = |other: &&usize| **other == effect || acting.contains(*other);
            effects.iter().filter(is_in).copied().collect()
        };
        let others = effects.iter().copied().filter(|effect| !acting.contains(effect));
        let lefts = others.map(|effect| (effect, square(&said(&more(effect)))));
        let Some((effect, left)) = lefts.min_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        take(GapPart::Effect(setup.case.candidates[effect].effect.name.clone()), left);
        acting = more(effect);
    }
    if departure.is_some() {
        let with =
            base.values.iter().zip(&parts.function).map(|(value, departure)| value + departure);
        take(GapPart::Departure, square(&with.collect::<Vec<f64>>()));
    }
    let noise = last / whole;
    shares.push(GapShare { what: GapPart::Noise, share_of_gap: noise });
    let finite = shares.iter().all(|share| share.share_of_gap.is_finite());
    if finite { shares } else { Vec::new() }
}
