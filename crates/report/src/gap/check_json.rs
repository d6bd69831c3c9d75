//! The scores of a blind check as JSON.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::answer::pretty;
use gumption_gap::check::{
    BesideScores, BlindCheckScores, BlindDraw, CheckedNoise, SmallestEffect,
};

#[derive(Serialize)]
struct CheckAnswer<'r> {
    title: &'r str,
    draws: usize,
    noise: CheckedNoise,
    seed: u64,
    top1: f64,
    top1_interval: [f64; 2],
    brier: f64,
    mean_log_probability: f64,
    false_alarms: f64,
    gap_free: usize,
    confusion: Vec<(&'r str, &'r str, usize)>,
    reliability: Vec<(f64, f64, usize)>,
    calibration_error: f64,
    perfect_calibration_error: f64,
    interval_coverage: f64,
    intervals: usize,
    gap_left: f64,
    worse_than_none: f64,
    claim_bias: f64,
    smallest_effect: BTreeMap<&'r str, Smallest<'r>>,
    beside: BesideScores,
    cases: &'r [BlindDraw],
    version: &'static str,
}

#[derive(Serialize)]
struct Smallest<'r> {
    unit: &'r str,
    value_at_90_percent: Option<f64>,
    gap_at_90_percent: Option<f64>,
}

impl<'r> Smallest<'r> {
    fn of(effect: &'r SmallestEffect) -> Self {
        Self {
            unit: &effect.unit,
            value_at_90_percent: effect.value_at_90_percent,
            gap_at_90_percent: effect.gap_at_90_percent,
        }
    }
}

/// The scores of data that were drawn with this noise, as JSON with keys in a fixed order. It ends in a
/// newline.
pub fn check_json(title: &str, noise: CheckedNoise, report: &BlindCheckScores) -> String {
    let answer = CheckAnswer {
        title,
        draws: report.draws,
        noise,
        seed: report.seed,
        top1: report.top1,
        top1_interval: report.top1_interval,
        brier: report.brier,
        mean_log_probability: report.mean_log_probability,
        false_alarms: report.false_alarms,
        gap_free: report.gap_free,
        confusion: report
            .confusion
            .iter()
            .map(|c| (c.truth.as_str(), c.said.as_str(), c.count))
            .collect(),
        reliability: report
            .reliability
            .iter()
            .map(|r| (r.probability, r.fraction, r.count))
            .collect(),
        calibration_error: report.calibration_error,
        perfect_calibration_error: report.perfect_calibration_error,
        interval_coverage: report.interval_coverage,
        intervals: report.intervals,
        gap_left: report.left,
        worse_than_none: report.worse_than_none,
        claim_bias: report.claim_bias,
        smallest_effect: report
            .smallest
            .iter()
            .map(|effect| (effect.parameter.as_str(), Smallest::of(effect)))
            .collect(),
        beside: report.beside,
        cases: &report.checked,
        version: env!("CARGO_PKG_VERSION"),
    };
    pretty(&answer)
}
