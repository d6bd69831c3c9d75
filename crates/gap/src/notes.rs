//! What to bear in mind when a diagnosis is read.

use super::diagnosis::{
    DiagnosisNote, GapTest, HypothesisKind, MostProbable, NoiseEstimate, Shrinkage,
};
use super::far_input;
use super::goodness_of_fit::misfit;
use super::row_drift;
use super::turns;
use super::unit_slip;
use gumption_engine::decimal::significant;
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
    let mut note = |code: &'static str, text: String| notes.push(DiagnosisNote { code, text });
    if noise.iter().any(|noise| noise.estimated.is_some()) {
        let repeats = setup.data.repeats(setup.case).iter().any(|rows| rows.len() > 1);
        note(
            "estimated-noise",
            if repeats {
                "The noise of outputs without stated uncertainties is estimated from repeated rows \
                 and residuals together."
                    .to_owned()
            } else {
                "Neither stated uncertainties nor repeated rows are there, so the noise is estimated \
                 from the residuals themselves: a departure that looks like noise cannot be told from \
                 it, and the chi-square test says nothing."
                    .to_owned()
            },
        );
    }
    for output in 0..setup.data.outputs.len() {
        let Some(rounding) = Rounding::of(setup.case, &setup.data, output) else { continue };
        let quantity = quantity(output);
        let deviation = significant(rounding.deviation(), 2);
        note(
            "resolution",
            format!(
                "The values of {} are rounded to {}, more coarsely than their noise: what that may have \
                 changed counts as a standard uncertainty of {}, the same for equal values at the same \
                 conditions.",
                quantity.name,
                quantity.unit.after(&Shortest(rounding.resolution).to_string()),
                quantity.unit.after(&deviation)
            ),
        );
    }
    if let Some(alike) = shared_noise_search::not_weighed(setup, winner) {
        note(
            "many-settings",
            format!(
                "What is left of {} is alike in the rows of each setting, as if they shared an error of \
                 about {} times the noise of one row. Such errors are weighed up to {} settings times \
                 outputs, and here are {}: give an input that has a value for each setting (`per`), or \
                 the means of the settings with their uncertainties.",
                quantity(alike.output).name,
                significant(alike.ratio, 2),
                alike.most,
                alike.errors
            ),
        );
    }
    if let Some(slip) = unit_slip::found(setup).filter(|_| verdict.kind != HypothesisKind::None) {
        let quantity = quantity(slip.output);
        let which = slip.rows.as_deref().map_or("in all rows".to_owned(), |rows| {
            let ends = [rows.first(), rows.last()].map(|row| row.map_or(0, |row| row + 1));
            let [first, last] = ends;
            let count = rows.len();
            let some =
                if last + 1 - first == count { String::new() } else { format!("{count} of ") };
            format!("in {some}the rows {first} to {last}, and agree with it in the others")
        });
        note(
            "unit-slip",
            format!(
                "The values of {} are about {} times what the sim says {which}: {} makes such a \
                 factor; look at the unit of the data and of the sim before an effect is believed.",
                quantity.name,
                significant(slip.ratio, 3),
                slip.cause
            ),
        );
    }
    let is_named = verdict.kind == HypothesisKind::Explained && verdict.probability > SURE;
    if !is_named && let [nearest, others @ ..] = &far_input::found(setup)[..] {
        let name = |variable: usize| format!("`{}`", setup.case.task.variables[variable].name);
        let also: Vec<String> = others.iter().map(|other| name(other.variable)).collect();
        let also = match also.is_empty() {
            true => String::new(),
            false => format!(" So would {}, further from their estimates.", also.join(", ")),
        };
        note(
            "far-input",
            format!(
                "The input {} alone would explain the data if it were {} standard uncertainties {} its \
                 estimate.{also} That is no hypothesis, as inputs are what they are stated to be: look at \
                 where the value comes from and how its uncertainty was found.",
                name(nearest.variable),
                significant(nearest.distance.abs(), 2),
                if nearest.distance > 0.0 { "above" } else { "below" },
            ),
        );
    }
    if let Some(text) = turns::note(setup) {
        note("whole-turns", text);
    }
    let worth = posterior.named().filter(|h| h.probability > WORTH_A_NOTE);
    let apart = worth.map(|h| h.evidence.disagreement).fold(0.0, f64::max);
    if apart > DISAGREE {
        note(
            "poor-integral",
            format!(
                "Two independent integrals of the same hypothesis differ by {apart:.1} in the logarithm \
                 of the evidence; the probabilities are averages over that error, and less sure for it."
            ),
        );
    } else if verdict.kind != HypothesisKind::Unexplained
        && winner.evidence.effective_sample_size < 50.0
    {
        note(
            "poor-integral",
            format!(
                "The evidence of the verdict rests on {:.0} effective draws only (standard error of its \
                 logarithm {:.2}); the probabilities are averages over that error, and less sure for \
                 it.",
                winner.evidence.effective_sample_size, winner.evidence.standard_error
            ),
        );
    }
    if verdict.indistinguishable.len() > 1 {
        note(
            "look-alikes",
            "These data cannot tell the hypotheses of the verdict's group apart: their predictions \
             coincide within the uncertainties, and what decides between them is prior: their \
             probabilities and how wide their sizes may be."
                .to_owned(),
        );
    }
    if gap.present && !shrinkage.meaningful {
        note(
            "small-gap",
            "The gap is below 3 standard uncertainties of the data, so the removed fraction is a ratio \
             of two noises and is not stated."
                .to_owned(),
        );
    }
    if verdict.kind == HypothesisKind::Explained
        && shrinkage.chi2_per_dof[1] > misfit(setup.data.len())
    {
        note(
            "poor-fit",
            format!(
                "The verdict is the best of the hypotheses but leaves a chi-square of {:.2} per value \
                 on conditions that were left out: something is still missing.",
                shrinkage.chi2_per_dof[1]
            ),
        );
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
        let times = (gap.chi2 / gap.dof).sqrt();
        if shrinkage.chi2_per_dof[1] > misfit(setup.data.len()) {
            note(
                "scatter",
                format!(
                    "The residuals are {times:.2} times as large as their uncertainties allow, but \
                     without a pattern that an effect or a smooth discrepancy would make: the stated \
                     noise is probably too small, or values are wrong one by one."
                ),
            );
        } else {
            note(
                "curved-sim",
                format!(
                    "At the estimates of the inputs the residuals are {times:.2} times as large as the \
                     law of propagation allows, but values within what is known of the inputs explain \
                     them: the sim is not linear in its inputs there."
                ),
            );
        }
    }
    if let Some((output, change)) = row_drift::drift(setup, winner) {
        note(
            "row-drift",
            format!(
                "What {} leaves of `{}` drifts along the rows, from the first to the last by {:.1} \
                 times the standard deviation that its noise is found to have (so steep by chance in one \
                 of 10 000 tables). If that is the order in which they were taken, something changes with \
                 time: give the time as a condition, or an effect that drifts; sizes that are found \
                 without it are means over the rows.",
                match verdict.kind {
                    HypothesisKind::Explained => "the verdict",
                    _ => "the best hypothesis",
                },
                quantity(output).name,
                change
            ),
        );
    } else if verdict.kind == HypothesisKind::None
        && noise.iter().any(|noise| noise.factor.is_some_and(|factor| factor.probability > LIKELY))
        && let Some((output, coefficient)) = row_drift::memory(setup, winner)
    {
        note(
            "row-drift",
            format!(
                "What is left of `{}` changes slowly along the rows: neighbouring ones have a coefficient \
                 of correlation of {coefficient:.2} (as large by chance in one of 10 000 tables). If that is \
                 the order in which they were taken, something changes with time, and the stated \
                 uncertainties may be right: give the time as a condition, or an effect that changes with it.",
                quantity(output).name
            ),
        );
    }
    if let Some(text) = Copies::of(setup.case).note(setup.case) {
        note("copied-rows", text);
    }
    let settings = setup.data.repeats(setup.case).len();
    if settings < 8 {
        let said = match settings {
            1 => "There is only one condition".to_owned(),
            count => format!("There are only {count} different conditions"),
        };
        note("few-conditions", format!("{said}; effects that differ elsewhere look alike here."));
    }
    notes
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
