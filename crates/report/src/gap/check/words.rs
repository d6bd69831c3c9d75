//! A blind check in sentences.

use super::super::digits::{condition, share};
use super::super::words::in_unit;
use super::confusion::Wrong;
use super::design::CheckedDesign;
use super::label::Label;
use super::sheets;
use crate::plain;
use gumption_gap::check::{BlindCheckScores, CheckedNoise};

/// The title of the page.
pub(super) fn title(design: &CheckedDesign) -> String {
    let title = plain(&design.title);
    if title.is_empty() {
        "Blind check of the diagnosis".to_owned()
    } else {
        format!("Blind check of the diagnosis: {title}")
    }
}

/// The settings.
pub(super) fn settings(report: &BlindCheckScores) -> String {
    format!("{} draws; intervals at 95 %; seed {}", report.draws, report.seed)
}

/// How often the verdict was right, and how often there was a false alarm.
pub(super) fn verdict(report: &BlindCheckScores) -> String {
    let right = report.checked.iter().filter(|one| one.right).count();
    let [low, high] = report.top1_interval.map(share);
    let mut said = format!(
        "The verdict was right in {right} of {} draws (share {}, interval from {low} to {high}). ",
        report.draws,
        share(report.top1)
    );
    said += &if report.gap_free == 0 {
        "Every draw had a gap, so the rate of false alarms is unknown.".to_owned()
    } else {
        let [low, high] = report.false_alarms_interval().map(share);
        format!(
            "In {} of {} data sets without a gap it found one (share {}, interval from {low} to \
             {high}).",
            report.alarms(),
            report.gap_free,
            share(report.false_alarms)
        )
    };
    said
}

/// How often an effect was found beside one that was taken out of the list; `None` without such draws.
pub(super) fn beside(report: &BlindCheckScores) -> Option<String> {
    let of = report.beside;
    (of.drawn > 0).then(|| {
        format!(
            "If one of two effects was removed from the list, the verdict named the other one in \
             {} of {} data sets; in {} its probability was below 0.01.",
            of.listed_effect_named, of.drawn, of.lost
        )
    })
}

/// What was done.
pub(super) fn done(design: &CheckedDesign, report: &BlindCheckScores) -> String {
    let mut drawn = [0usize; 5];
    for one in &report.checked {
        let place = match Label::truth(one) {
            _ if one.listed_present.is_some() => 4,
            Label::None => 0,
            Label::One(_) => 1,
            Label::Several(_) | Label::Together => 2,
            Label::Unexplained => 3,
        };
        drawn[place] += 1;
    }
    let [none, one, two, withheld, beside] = drawn;
    let outputs: Vec<String> = design.outputs.iter().map(|name| plain(name)).collect();
    let rows = if design.rows == 1 { "row" } else { "rows" };
    let effects = if design.effects == 1 { "effect" } else { "effects" };
    let noise = match design.noise {
        CheckedNoise::AsStated => "the stated uncertainties",
        CheckedNoise::Uncertain => {
            "noise that was also drawn (as stated, with uncertainties wrong by a factor, with \
             outlying rows, with correlated neighbours)"
        }
    };
    format!(
        "Truths were drawn from the case's own prior and its list of {} candidate {effects}: \
         {none} without a gap, {one} with one effect, {two} with two, {withheld} with an effect \
         that was then removed from the list, {beside} with two effects of which one was removed. \
         Data were simulated from each truth with {noise} at the case's design: {} {rows} of \
         {}{}. They were diagnosed without the truths, which were compared afterwards.",
        design.effects,
        design.rows,
        outputs.join(", "),
        over(design)
    )
}

/// Over which conditions, if there are any.
fn over(design: &CheckedDesign) -> String {
    let ranges = design.conditions.iter().map(|(named, [low, high])| {
        let name = plain(&named.name);
        if low == high {
            return format!("{name} = {}", in_unit(&condition(*low), named));
        }
        format!("{name} from {} to {}", condition(*low), in_unit(&condition(*high), named))
    });
    let ranges: Vec<String> = ranges.collect();
    if ranges.is_empty() { String::new() } else { format!(", with {}", ranges.join("; ")) }
}

/// When a verdict is right.
pub(super) const RIGHT: &str = "A verdict is right if it names exactly the effects that were \
     drawn. If the effect was removed from the list, the verdict is right if it is \
     \"unexplained\" or predicts within the uncertainties. If one of two effects was removed, it \
     is right if it names the other one, alone or with a discrepancy, or predicts within the \
     uncertainties.";

/// What the scores are.
pub(super) const SCORES: &str = "Brier score: sum of the squared errors of all hypotheses' \
     probabilities; 0 is best. ln probability of the truth: 0 is best; less than 1e-6 counts as \
     1e-6. Intervals of parameters are counted if the verdict names exactly the true effects. Gap \
     left: root mean square error of the corrected prediction divided by the error of the sim, \
     without noise, if there was a gap. Claimed minus true removed fraction: mean for gaps of at \
     least 3 standard uncertainties; above zero, too much was claimed.";

/// Whether probabilities mean what they say.
pub(super) fn reliability(report: &BlindCheckScores) -> String {
    format!(
        "A share p of the verdicts with the probability p should be right. The mean distance from \
         this is {}; a perfect diagnosis with as many draws and the same probabilities has {} \
         (median), by chance alone.",
        share(report.calibration_error),
        share(report.perfect_calibration_error)
    )
}

/// What is said where there is nothing to list.
pub(super) const NONE_WRONG: &str = "No verdict was wrong.";

/// How many wrong verdicts the table leaves out.
pub(super) fn left_out(wrong: &[Wrong]) -> Option<String> {
    let rest = wrong.get(sheets::SHOWN..).unwrap_or_default();
    let count: usize = rest.iter().map(|kind| kind.count).sum();
    match count {
        0 => None,
        1 => Some("1 other wrong verdict is not listed.".to_owned()),
        count => Some(format!("{count} other wrong verdicts are not listed.")),
    }
}

/// What the smallest effects are.
pub(super) const SMALLEST: &str = "Size of a parameter at which its effect, acting alone, is \
     named with 90 % probability, and the root mean square of the change that it makes, in \
     standard uncertainties u of the data. No number: too few draws of this effect, almost all or \
     almost none of them found, or, for the size, other parameters matter more.";
