//! The tables of a blind check.

use super::super::digits::share;
use super::super::words::unit;
use super::confusion::Wrong;
use crate::number::{MISSING, significant};
use crate::plain;
use crate::sheet::Sheet;
use gumption_gap::check::{BlindCheckScores, SmallestEffect};

/// So many kinds of wrong verdicts are listed at most.
pub(super) const SHOWN: usize = 15;

/// Digits of sizes, which are estimated from few draws.
const DIGITS: u32 = 2;

fn missing() -> String {
    MISSING.to_owned()
}

/// A score: its name, value, interval and how many it was counted over.
struct Score {
    name: &'static str,
    value: f64,
    interval: Option<[f64; 2]>,
    /// `None` where it is no mean over something.
    count: Option<usize>,
}

/// All scores.
pub(super) fn scores(report: &BlindCheckScores) -> Sheet {
    let score = |name, value, count| Score { name, value, interval: None, count: Some(count) };
    let fractions = report.checked.iter().filter(|one| one.fractions.is_some()).count();
    let with_gap = report.draws - report.gap_free;
    let alarms = report.false_alarms_interval();
    let scores = [
        Score {
            interval: Some(report.top1_interval),
            ..score("right verdicts", report.top1, report.draws)
        },
        Score {
            interval: Some(alarms),
            ..score("false alarms without a gap", report.false_alarms, report.gap_free)
        },
        score("Brier score, mean", report.brier, report.draws),
        score("ln probability of the truth, mean", report.mean_log_probability, report.draws),
        score("calibration error", report.calibration_error, report.draws),
        Score {
            count: None,
            ..score("calibration error, perfect diagnosis", report.perfect_calibration_error, 0)
        },
        score("intervals that hold the true parameter", report.interval_coverage, report.intervals),
        score("gap left, median", report.left, with_gap),
        score("corrections worse than none", report.worse_than_none, with_gap),
        score("claimed minus true removed fraction", report.claim_bias, fractions),
    ];
    // without a count there is nothing to show
    let shown = |score: &Score, value: f64| {
        if score.count == Some(0) { missing() } else { share(value) }
    };
    let end = |score: &Score, place: usize| {
        score.interval.map_or_else(missing, |ends| shown(score, ends[place]))
    };
    let mut sheet = Sheet::default();
    sheet.text("", scores.iter().map(|score| score.name.to_owned()));
    sheet.numbers("value", scores.iter().map(|score| shown(score, score.value)));
    sheet.numbers("interval\nfrom", scores.iter().map(|score| end(score, 0)));
    sheet.numbers("\nto", scores.iter().map(|score| end(score, 1)));
    let count = |score: &Score| score.count.map_or_else(missing, |count| count.to_string());
    sheet.numbers("counted\nover", scores.iter().map(count));
    sheet
}

/// The reliability of probabilities.
pub(super) fn reliability(report: &BlindCheckScores) -> Sheet {
    let bins = &report.reliability;
    let mut sheet = Sheet::default();
    sheet.numbers("mean\nprobability", bins.iter().map(|bin| share(bin.probability)));
    sheet.numbers("share\nright", bins.iter().map(|bin| share(bin.fraction)));
    sheet.numbers("interval\nfrom", bins.iter().map(|bin| share(bin.interval()[0])));
    sheet.numbers("\nto", bins.iter().map(|bin| share(bin.interval()[1])));
    sheet.numbers("verdicts", bins.iter().map(|bin| bin.count.to_string()));
    sheet
}

/// The most frequent kinds of wrong verdicts; `None` where there are none.
pub(super) fn wrong(wrong: &[Wrong]) -> Option<Sheet> {
    if wrong.is_empty() {
        return None;
    }
    let shown = wrong.get(..SHOWN.min(wrong.len())).unwrap_or_default();
    let mut sheet = Sheet::default();
    sheet.text("truth", shown.iter().map(|kind| kind.truth.name()));
    sheet.text("verdict", shown.iter().map(|kind| kind.said.name()));
    sheet.numbers("draws", shown.iter().map(|kind| kind.count.to_string()));
    sheet.numbers("with this\ntruth", shown.iter().map(|kind| kind.of.to_string()));
    Some(sheet)
}

/// The smallest effects that are found; `None` where no effect has a parameter.
pub(super) fn smallest(report: &BlindCheckScores) -> Option<Sheet> {
    let smallest = &report.smallest;
    if smallest.is_empty() {
        return None;
    }
    let number = |value: Option<f64>| value.map_or_else(missing, |v| significant(v, DIGITS));
    let mut sheet = Sheet::default();
    sheet.text("parameter", smallest.iter().map(|effect| plain(&effect.parameter)));
    let unit = |effect: &SmallestEffect| unit(&effect.unit).unwrap_or_default();
    sheet.text("unit", smallest.iter().map(unit));
    sheet.numbers("found at\nsize", smallest.iter().map(|e| number(e.value_at_90_percent)));
    sheet.numbers("change\nin u", smallest.iter().map(|e| number(e.gap_at_90_percent)));
    Some(sheet)
}
