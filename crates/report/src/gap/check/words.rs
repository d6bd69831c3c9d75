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
        "No draw was without a gap, so that nothing is known of false alarms.".to_owned()
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
            "Where one of two effects had been taken out of the list, the verdict named the other one in {} \
             of {} data sets; in {} it had a probability below 0.01.",
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
            "noise that was drawn too (as stated, uncertainties off by a factor, single rows off, \
             neighbours correlated)"
        }
    };
    format!(
        "Truths were drawn from the case's own prior and its list of {} candidate {effects}: {none} \
         without a gap, {one} with one effect, {two} with two, {withheld} with an effect that was then \
         taken out of the list, {beside} with two of which one was. Each made data with {noise} at the case's design: {} {rows} of {}{}. \
         The data were diagnosed without the truths, which were opened afterwards.",
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
pub(super) const RIGHT: &str = "A verdict is right if it names just the effects that were drawn. Where the effect had been \
     taken out of the list it is right if it is \"unexplained\", or if it names something that \
     predicts within the uncertainties; where one of two had been, if it names the other one, with \
     something beside it or not, or predicts within the uncertainties.";

/// What the scores are.
pub(super) const SCORES: &str = "Brier score: sum of the squared errors of all hypotheses' probabilities, 0 is best. ln \
     probability of the truth: 0 is best; less than 1e-6 counts as 1e-6. Intervals of parameters \
     are counted where the verdict names just the true effects. Gap left: root mean square error of \
     the corrected prediction over that of the sim, without noise, where there was a gap. Claimed \
     less true fraction removed: mean where the gap was at least 3 standard uncertainties; claims \
     above zero promise too much.";

/// Whether probabilities mean what they say.
pub(super) fn reliability(report: &BlindCheckScores) -> String {
    format!(
        "Of verdicts with the probability p a share p should be right. Their mean distance is {}; that \
         of a perfect diagnosis with as many draws and the same probabilities is {} (median), by \
         chance alone.",
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
pub(super) const SMALLEST: &str = "Size of a parameter at which its effect, acting alone, is named with 90 % probability, and \
     the root mean square of what it then changes, in standard uncertainties u of the data. No \
     number: too few draws of this effect, all or hardly any of them found, or, for the size, \
     other parameters matter more.";
