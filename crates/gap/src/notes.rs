//! What to bear in mind when a diagnosis is read.

use super::diagnosis::{
    DiagnosisNote, GapTest, HypothesisKind, MostProbable, NoiseEstimate, Shrinkage,
};
use super::far_input::{self, FarInput};
use super::goodness_of_fit::misfit;
use super::row_drift;
use super::simulated::untold;
use super::turns;
use super::unit_slip;
use gumption_engine::decimal::significant;
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};
use gumption_engine::model::Quantity;
use gumption_engine::number::Shortest;
use gumption_inference::integral::evidence::DISAGREE;
use gumption_inference::noise::copies::Copies;
use gumption_inference::noise::resolution::Rounding;
use gumption_inference::noise::shared_noise_search;
use gumption_inference::posterior::{Posterior, WeighedHypothesis};
use gumption_inference::setup::Setup;

pub(crate) fn notes(
    setup: &Setup<'_>,
    posterior: &Posterior,
    verdict: &MostProbable,
    shrinkage: &Shrinkage,
    gap: &GapTest,
    noise: &[NoiseEstimate],
    winner: &WeighedHypothesis,
) -> Vec<DiagnosisNote> {
    let quantity = |output: usize| {
        let output = setup.data.outputs[output];
        &setup.case.model.outputs[output].quantity
    };
    let mut notes = Vec::new();
    let mut note = |fact: Fact| notes.push(DiagnosisNote { fact });
    if noise.iter().any(|noise| noise.estimated.is_some()) {
        let repeats = setup.data.repeats(setup.case).iter().any(|rows| rows.len() > 1);
        note(match repeats {
            true => fact!("estimated-noise"),
            false => fact!("estimated-noise.from-residuals"),
        });
    }
    for output in 0..setup.data.outputs.len() {
        let Some(rounding) = Rounding::of(setup.case, &setup.data, output) else { continue };
        let Quantity { name, unit, .. } = quantity(output);
        let resolution = unit.after(&Shortest(rounding.resolution).to_string());
        let deviation = unit.after(&significant(rounding.deviation(), 2));
        note(fact!(
            "resolution",
            name,
            resolution = Argument::Number(resolution),
            deviation = Argument::Number(deviation),
        ));
    }
    if let Some(alike) = shared_noise_search::not_weighed(setup, winner) {
        note(fact!(
            "many-settings",
            name = &quantity(alike.output).name,
            ratio = Argument::Number(significant(alike.ratio, 2)),
            most = alike.most,
            errors = alike.errors,
        ));
    }
    if let Some(slip) = unit_slip::found(setup).filter(|_| verdict.kind != HypothesisKind::None) {
        let name = &quantity(slip.output).name;
        let ratio = Argument::Number(significant(slip.ratio, 3));
        let rows = slip.rows.as_deref().map_or_else(|| fact!("slip-in-all-rows"), slipped);
        note(fact!("unit-slip", name, ratio, rows, cause = slip.cause));
    }
    let is_named = verdict.kind == HypothesisKind::Explained && verdict.probability > SURE;
    if !is_named && let [nearest, others @ ..] = &far_input::found(setup)[..] {
        let name = |of: &FarInput| &setup.case.task.variables[of.variable].name;
        let inputs: Vec<String> = others.iter().map(|other| format!("`{}`", name(other))).collect();
        let others = (!inputs.is_empty()).then(|| fact!("other-far-inputs", inputs));
        let input = name(nearest);
        let distance = Argument::Number(significant(nearest.distance.abs(), 2));
        note(match nearest.distance > 0.0 {
            true => fact!("far-input", input, distance, others),
            false => fact!("far-input.below", input, distance, others),
        });
    }
    turns::note(setup).into_iter().for_each(&mut note);
    let worth = posterior.named().filter(|h| h.probability > WORTH_A_NOTE);
    let apart = worth.map(|h| h.evidence.disagreement).fold(0.0, f64::max);
    if apart > DISAGREE {
        note(fact!("poor-integral", apart = Argument::Number(format!("{apart:.1}"))));
    } else if verdict.kind != HypothesisKind::Unexplained
        && winner.evidence.effective_sample_size < 50.0
    {
        let draws = Argument::Number(format!("{:.0}", winner.evidence.effective_sample_size));
        let error = Argument::Number(format!("{:.2}", winner.evidence.standard_error));
        note(fact!("poor-integral.few-draws", draws, error));
    }
    if verdict.indistinguishable.len() > 1 {
        note(fact!("look-alikes"));
    }
    untold::facts(setup, winner).into_iter().for_each(&mut note);
    if gap.present && !shrinkage.meaningful {
        note(fact!("small-gap"));
    }
    let left = shrinkage.chi2_per_dof[1];
    let misfits = left > misfit(setup.data.len());
    if verdict.kind == HypothesisKind::Explained && misfits {
        note(fact!("poor-fit", chi_square = Argument::Number(format!("{left:.2}"))));
    }
    let of_noise = noise.iter().any(|noise| {
        noise.factor.is_some_and(|factor| factor.probability > LIKELY)
            || noise.correlations.iter().any(|correlation| correlation.probability > LIKELY)
            || noise.serial.is_some_and(|serial| serial.probability > LIKELY)
            || noise.settings.as_ref().is_some_and(|settings| settings.probability > LIKELY)
            || noise.suspects.iter().any(|suspect| suspect.probability > LIKELY)
    });
    if let (HypothesisKind::None, Some(p)) = (verdict.kind, gap.p_value)
        && p < OVERDISPERSED
        && !of_noise
        && noise.iter().all(|noise| noise.estimated.is_none())
    {
        let times = Argument::Number(format!("{:.2}", (gap.chi2 / gap.dof).sqrt()));
        note(match misfits {
            true => fact!("scatter", times),
            false => fact!("curved-sim", times),
        });
    }
    if let Some((output, change)) = row_drift::drift(setup, winner) {
        let name = &quantity(output).name;
        let change = Argument::Number(format!("{change:.1}"));
        note(match verdict.kind {
            HypothesisKind::Explained => fact!("row-drift", name, change),
            _ => fact!("row-drift.best-hypothesis", name, change),
        });
    } else if verdict.kind == HypothesisKind::None
        && noise.iter().any(|noise| noise.factor.is_some_and(|factor| factor.probability > LIKELY))
        && let Some((output, coefficient)) = row_drift::memory(setup, winner)
    {
        let name = &quantity(output).name;
        let coefficient = Argument::Number(format!("{coefficient:.2}"));
        note(fact!("row-drift.memory", name, coefficient));
    }
    Copies::of(setup.case).note(setup.case).into_iter().for_each(&mut note);
    match setup.data.repeats(setup.case).len() {
        1 => note(fact!("few-conditions.one")),
        count @ ..8 => note(fact!("few-conditions", count)),
        _ => {}
    }
    notes
}

/// The rows that have the unit of another, counted from 0.
fn slipped(rows: &[usize]) -> Fact {
    let [first, last] = [rows.first(), rows.last()].map(|row| row.map_or(0, |row| row + 1));
    let count = rows.len();
    match last + 1 - first == count {
        true => fact!("slip-in-rows", first, last),
        false => fact!("slip-in-rows.some", count, first, last),
    }
}

/// The integral of a hypothesis with less than this probability changes the others by less than they
/// are known.
const WORTH_A_NOTE: f64 = 0.01;

/// With an effect that is more probable than this it is not asked whether an input would explain the data.
const SURE: f64 = 0.9;

/// A departure of the noise from what is stated is said in the verdict from this probability on.
const LIKELY: f64 = 0.5;

/// The chi-square test speaks against the verdict "no gap" below this probability.
const OVERDISPERSED: f64 = 1e-3;
