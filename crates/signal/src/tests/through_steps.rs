//! Noise that is not white, through steps: errors over standard uncertainties.

use std::f64::consts::PI;

use super::simulated::Bench;
use super::study::figures;
use crate::{Band, Butterworth, ChannelStep, Response};

fn low_pass() -> ChannelStep {
    let filter = Butterworth { band: Band::LowPass(40.0), poles: 6, both_ways: false };
    ChannelStep::Filter { filter, correct: true }
}

fn high_pass() -> ChannelStep {
    let filter = Butterworth { band: Band::HighPass(4.0), poles: 2, both_ways: false };
    ChannelStep::Filter { filter, correct: true }
}

fn identity() -> ChannelStep {
    let response = Response::Delayed { gain: 1.0, delay: 0.0 };
    ChannelStep::Correct { response, of_gain: 0.0, of_phase: 0.0, of_delay: 0.0 }
}

fn derivative() -> ChannelStep {
    ChannelStep::Derivative { order: 1, highest: None, factor: 1.0 }
}

fn bench(memory: f64, samples: usize, steps: Vec<ChannelStep>) -> Bench {
    Bench {
        hertz: 7.3,
        samples,
        channels: vec![vec![(1.5, 0.3), (0.02, 1.0)], vec![(1.5, 0.8), (0.01, 0.4)]],
        noise: 0.1,
        offset: 0.2,
        memory,
        steps,
        ..Bench::default()
    }
}

/// For each figure of channel b the standard deviation of its errors over so many recordings over the
/// mean of its standard uncertainties.
fn ratios(bench: &Bench, count: u64, counts: &[&str]) -> Vec<(String, f64)> {
    let mut all: Vec<(String, Vec<[f64; 2]>)> = Vec::new();
    for seed in 0..count {
        let mut bench = bench.clone();
        for (number, channel) in bench.channels.iter_mut().enumerate() {
            let turn = (seed as f64 * 0.618_033_988_749_895 * (3.1 - number as f64)).fract();
            channel[0].1 += 2.0 * PI * turn;
        }
        let observation = bench.observe(bench.values(seed));
        let [root, of] = observation.frequencies[0].as_slice() else { panic!() };
        let figures = figures(&bench, of, root).into_iter();
        let figures = figures.filter(|(name, ..)| counts.contains(&name.as_str()));
        let findings = of.findings.iter().map(|of| (of.name.clone(), of.value, 0.0));
        let findings = findings.filter(|(name, ..)| counts.contains(&name.as_str()));
        for (number, (name, found, truth)) in figures.chain(findings).enumerate() {
            if all.len() <= number {
                all.push((name, Vec::new()));
            }
            all[number].1.push([found.value - truth, found.standard_uncertainty]);
        }
    }
    let n = count as f64;
    let ratio = |all: &[[f64; 2]]| {
        let [mean, u] = [0, 1].map(|i| all.iter().map(|of| of[i]).sum::<f64>() / n);
        let squares: f64 = all.iter().map(|of| (of[0] - mean) * (of[0] - mean)).sum();
        (squares / (n - 1.0)).sqrt() / u
    };
    all.iter().map(|(name, all)| (name.clone(), ratio(all))).collect()
}

#[test]
#[ignore = "a minute"]
fn scores() {
    const ALL: &[&str] = &["amplitude 1", "phase 1", "offset", "SNR", "SINAD", "amplitude 2", "phase 2"];
    for memory in [0.95, 0.97, 0.0, -0.9, 1.0] {
        for samples in [685, 3210] {
            for (about, steps) in [
                ("none", vec![]),
                ("identity", vec![identity()]),
                ("low-pass", vec![low_pass()]),
                ("high-pass", vec![high_pass()]),
                ("derivative", vec![derivative()]),
            ] {
                if about == "high-pass" && samples < 3000 { continue; }
                let of = bench(memory, samples, steps);
                let of = if memory == 1.0 { Bench { noise: 0.01, ..of } } else { of };
                let mut notes = std::collections::BTreeMap::new();
                for (code, channel, _) in of.observe(of.values(3)).notes {
                    if channel == 1 { *notes.entry(code).or_insert(0) += 1; }
                }
                let found = ratios(&of, 100, ALL);
                let scores: Vec<String> =
                    found.iter().map(|(name, e)| format!("{name} {e:.2}")).collect();
                println!("{memory:5} {samples:5} {about:10} {} {notes:?}", scores.join(", "));
            }
        }
    }
}
