//! Whether what is stated of whole observations is right: errors over standard uncertainties in
//! situations that are easily got wrong.

use std::f64::consts::PI;

use super::simulated::Bench;
use super::study::figures;
use crate::study::Errors;
use crate::{ChannelStep, Method};

/// A bench, what it is about, and the figures that count.
pub(super) struct Situation {
    about: &'static str,
    bench: Bench,
    counts: &'static [&'static str],
}

const ALL: &[&str] = &["amplitude 1", "phase 1", "offset", "amplitude 2", "phase 2"];
const MAIN: &[&str] = &["amplitude 1", "phase 1", "offset"];
const RATIOS: &[&str] = &["amplitude 1", "phase 1", "offset", "SNR", "SINAD"];

/// 23 periods at 1 kHz, as a record of the bench for accelerometers has them.
fn plain() -> Bench {
    Bench { hertz: 7.3, samples: 3150, ..Bench::default() }
}

fn situations() -> Vec<Situation> {
    let of = |about, counts, bench| Situation { about, bench, counts };
    let plain = plain();
    let near = vec![vec![(1.0, 0.3), (0.02, 1.0)], vec![(0.9, 0.1), (0.01, 0.4)]];
    // 1.5 over 0.05: 30 steps; the second channel has 15
    let coarse = |step: f64, noise: f64, hertz: f64, samples: usize| Bench {
        channels: vec![vec![(1.5, 0.3), (0.02, 1.0)], vec![(1.5, -1.2), (0.02, 0.4)]],
        resolution: step,
        noise: noise * step,
        hertz,
        samples,
        ..plain.clone()
    };
    let jitter =
        |jitter: f64| Bench { jitter, noise: 1e-4, samples: 3210, trials: 2000, ..plain.clone() };
    vec![
        of("white", RATIOS, Bench { trials: 2000, ..plain.clone() }),
        of("jitter 0.2 ms", MAIN, jitter(0.2e-3)),
        of("jitter 1 ms", MAIN, jitter(1e-3)),
        of("jitter 8 ms", MAIN, jitter(8e-3)),
        of("AR(1) 0.9", MAIN, Bench { memory: 0.9, ..plain.clone() }),
        of("AR(1) 0.97", MAIN, Bench { memory: 0.97, ..plain.clone() }),
        of("AR(1) 0.99", MAIN, Bench { memory: 0.99, ..plain.clone() }),
        of("AR(1) -0.9", MAIN, Bench { memory: -0.9, ..plain.clone() }),
        of("random walk", MAIN, Bench { memory: 1.0, noise: 0.001, ..plain.clone() }),
        of("AR(1) 0.95, 5 periods", MAIN, Bench { memory: 0.95, samples: 685, ..plain.clone() }),
        of("AR(1) 0.95, 3 periods", MAIN, Bench { memory: 0.95, samples: 411, ..plain.clone() }),
        of("steps of 1/30, noise 0.1 LSB", ALL, coarse(0.05, 0.1, 7.3, 3150)),
        of("steps of 1/30, noise 0.01 LSB", ALL, coarse(0.05, 0.01, 7.3, 3150)),
        of("steps of 1/7.5, noise 0.01 LSB", MAIN, coarse(0.2, 0.01, 7.3, 3150)),
        of("coherent, noise 0.002 LSB", ALL, coarse(0.05, 0.002, 8.0, 1000)),
        of("coherent, noise 0.1 LSB", ALL, coarse(0.05, 0.1, 8.0, 1000)),
        of("coherent, noise 0.3 LSB", ALL, coarse(0.05, 0.3, 8.0, 1000)),
        of("steps of 1/30, trials", ALL, Bench { trials: 2000, ..coarse(0.05, 0.01, 7.3, 3150) }),
        of("steps of 1/7.5, trials", MAIN, Bench { trials: 2000, ..coarse(0.2, 0.01, 7.3, 3150) }),
        of("resolution not stated", ALL, Bench { hidden: true, ..coarse(0.05, 0.1, 8.0, 1000) }),
        of("common noise", MAIN, Bench { common: 0.6, channels: near.clone(), ..plain.clone() }),
        of("opposite noise", MAIN, Bench { common: -0.8, channels: near.clone(), ..plain.clone() }),
        of(
            "common noise with a memory",
            MAIN,
            Bench { common: 0.6, memory: 0.9, channels: near, ..plain.clone() },
        ),
        of(
            "frequency off",
            RATIOS,
            Bench { frequency_uncertainty: 0.01, noise: 1e-3, ..plain.clone() },
        ),
        of("bins", RATIOS, Bench { method: Method::Fft, noise: 1e-3, ..plain.clone() }),
        of(
            "trend removed",
            &["amplitude 1", "phase 1", "SNR", "SINAD"],
            Bench {
                steps: vec![ChannelStep::RemoveTrend],
                noise: 1e-3,
                samples: 3210,
                ..plain.clone()
            },
        ),
    ]
}

/// Runs `count` recordings and gives each figure's errors.
fn errors(situation: &Situation, count: u64) -> Vec<(String, Errors)> {
    let mut all: Vec<(String, Errors)> = Vec::new();
    for seed in 0..count {
        // levels, sizes and phases that change, as those of real recordings do
        let mut bench = situation.bench.clone();
        let turn = |times: f64| (seed as f64 * 0.618_033_988_749_895 * times).fract();
        bench.offset += 3.7 * bench.resolution * turn(1.0);
        for (number, channel) in bench.channels.iter_mut().enumerate() {
            channel[0].0 *= 1.0 + 0.05 * turn(7.3 + number as f64);
            // channels that move together where they have their noise in common
            let own = if bench.common == 0.0 { number as f64 } else { 0.0 };
            channel[0].1 += 2.0 * PI * turn(3.1 - own);
        }
        let observation = bench.observe(bench.values(seed));
        let [root, of] = observation.frequencies[0].as_slice() else { panic!() };
        let figures = figures(&bench, of, root).into_iter();
        let figures = figures.filter(|(name, ..)| situation.counts.contains(&name.as_str()));
        for (number, (name, found, truth)) in figures.enumerate() {
            if all.len() <= number {
                all.push((name, Errors::default()));
            }
            all[number].1.add(found, truth);
        }
    }
    all
}

/// Prints the root mean square of error over standard uncertainty of each figure.
#[test]
#[ignore = "two minutes"]
fn standard_scores_of_300_recordings() {
    let mut wrong = Vec::new();
    for situation in situations() {
        for (name, errors) in errors(&situation, 300) {
            let score = errors.score();
            let verdict = if (0.85..=1.15).contains(&score) { "" } else { "  <<<" };
            println!("{:32} {name:14} {score:7.3}{verdict}", situation.about);
            if !verdict.is_empty() {
                wrong.push(format!("{} {name} {score:.3}", situation.about));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
