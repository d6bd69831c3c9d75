//! What to bear in mind when a diagnosis is read.

use super::diagnosis::{
    DiagnosisNote, GapTest, HypothesisKind, MostProbable, NoiseEstimate, Shrinkage,
};
use super::evidence::DISAGREE;
use super::goodness_of_fit::misfit;
use super::posterior::Posterior;
use super::row_drift;
use super::setup::Setup;

pub(crate) fn notes(
    setup: &Setup<'_>,
    posterior: &Posterior,
    verdict: &MostProbable,
    shrinkage: &Shrinkage,
    gap: &GapTest,
    noise: &[NoiseEstimate],
    best: usize,
) -> Vec<DiagnosisNote> {
    let mut notes = Vec::new();
    let mut note = |code: &'static str, text: String| notes.push(DiagnosisNote { code, text });
    if noise.iter().any(|of| of.estimated.is_some()) {
        let repeats = setup.data.points.iter().any(|point| point.rows.len() > 1);
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
    let winner = &posterior.hypotheses[best];
    let worth = posterior.hypotheses.iter().filter(|h| h.probability > WORTH_A_NOTE);
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
    let of_noise = noise.iter().any(|of| {
        of.factor.is_some_and(|factor| factor.probability > LIKELY)
            || of.serial.is_some_and(|serial| serial.probability > LIKELY)
            || of.suspects.iter().any(|suspect| suspect.probability > LIKELY)
    });
    if let (HypothesisKind::None, Some(p)) = (verdict.kind, gap.p_value)
        && p < OVERDISPERSED
        && !of_noise
    {
        note(
            "scatter",
            format!(
                "The residuals are {:.2} times as large as their uncertainties allow, but without a \
                 pattern that an effect or a smooth discrepancy would make: the stated noise is \
                 probably too small, or values are wrong one by one.",
                (gap.chi2 / gap.dof).sqrt()
            ),
        );
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
                setup.case.model.outputs[setup.data.outputs[output]].quantity.name,
                change
            ),
        );
    }
    let copies = copies(setup);
    if let [(row, copy), more @ ..] = copies.as_slice() {
        let others = match more.len() {
            0 => String::new(),
            count => format!(", and {count} more rows are such copies"),
        };
        note(
            "copied-rows",
            format!(
                "Row {} has the conditions and, to all digits, the values of row {}{others}. What was \
                 copied counts as measured again, with noise of its own, and makes the diagnosis too \
                 sure: leave such rows out unless they were measured.",
                copy + 1,
                row + 1
            ),
        );
    }
    if setup.data.points.len() < 8 {
        let said = match setup.data.points.len() {
            1 => "There is only one condition".to_owned(),
            count => format!("There are only {count} different conditions"),
        };
        note("few-conditions", format!("{said}; effects that differ elsewhere look alike here."));
    }
    notes
}

/// Rows of the same conditions and values, each with the row of the case that it repeats; only of
/// values with so many digits that no two readings are the same by chance.
fn copies(setup: &Setup<'_>) -> Vec<(usize, usize)> {
    let data = &setup.data;
    let value = |row: usize, output: usize| data.values[output][row];
    let outputs = data.outputs.len();
    let is_copy = |row: usize, other: usize| {
        (0..outputs).all(|output| value(row, output).to_bits() == value(other, output).to_bits())
            && (0..outputs).any(|output| significant_digits(value(row, output)) >= TELLING_DIGITS)
    };
    let mut found: Vec<(usize, usize)> = Vec::new();
    for point in &data.points {
        let mut of_point = point.rows.clone();
        let bits = |row: usize| (0..outputs).map(move |output| value(row, output).to_bits());
        of_point.sort_by(|&a, &b| bits(a).cmp(bits(b)).then(a.cmp(&b)));
        let pairs = of_point.windows(2).filter(|pair| is_copy(pair[0], pair[1]));
        found.extend(pairs.map(|pair| (data.ids[pair[0]], data.ids[pair[1]])));
    }
    found.sort_unstable_by_key(|(_, copy)| *copy);
    found
}

/// The digits of a number as it would be written.
fn significant_digits(value: f64) -> usize {
    let text = format!("{value:e}");
    text.bytes().take_while(|byte| *byte != b'e').filter(u8::is_ascii_digit).count()
}

/// Two readings of so many digits are hardly ever the same.
const TELLING_DIGITS: usize = 5;

/// The integral of a hypothesis with less than this probability changes the others by less than they
/// are known.
const WORTH_A_NOTE: f64 = 0.01;

/// A departure of the noise from what is stated is said in the verdict from this probability on.
const LIKELY: f64 = 0.5;

/// The chi-square test speaks against the verdict "no gap" below this probability.
const OVERDISPERSED: f64 = 1e-3;
