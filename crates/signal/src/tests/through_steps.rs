//! Noise that is not white, through steps: errors over standard uncertainties.

use std::f64::consts::PI;

use super::simulated::Bench;
use crate::{Band, Butterworth, ChannelStep, Measured, Response};
use gumption_engine::fact::{Argument, Fact};
use gumption_engine::parallel;

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

/// The figures of the last channel of one recording, less what their truth moves by.
fn figures(bench: &Bench, seed: u64) -> Vec<(String, Measured)> {
    let mut bench = bench.clone();
    for (number, channel) in bench.channels.iter_mut().enumerate() {
        let turn = (seed as f64 * 0.618_033_988_749_895 * (3.1 - number as f64)).fract();
        channel[0].1 += 2.0 * PI * turn;
    }
    let apart = bench.channels.last().unwrap()[0].1 - bench.channels[0][0].1;
    let period = 1.0 / bench.hertz;
    let less = |mut found: Measured, truth: f64, period: f64| {
        found.value -= truth;
        found.value -= period * (found.value / period).round();
        found
    };
    let observation = bench.observe(bench.values(seed));
    let of = observation.frequencies[0].last().unwrap();
    let component = &of.components[0];
    let mut figures = vec![
        ("amplitude".to_owned(), component.amplitude.measured),
        ("phase".to_owned(), less(component.phase.measured, apart, 2.0 * PI)),
        ("offset".to_owned(), of.offset.measured),
        ("SNR".to_owned(), of.signal_to_noise.measured),
        ("SINAD".to_owned(), of.sinad.measured),
    ];
    figures.extend(of.findings.iter().filter_map(|of| {
        let late = -apart / (2.0 * PI) * period;
        let value = of.measured()?;
        let value = if of.unit == "s" { less(value, late, period) } else { value };
        Some((of.name.clone(), value))
    }));
    figures
}

/// For each figure the standard deviation of its errors over so many recordings over the mean of its
/// standard uncertainties.
fn ratios(bench: &Bench, count: u64, counts: &[&str]) -> Vec<(String, f64)> {
    let all = parallel::map(0..count, |seed| figures(bench, seed));
    let n = count as f64;
    let ratio = |place: usize| {
        let of = |get: &dyn Fn(&Measured) -> f64| -> Vec<f64> {
            all.iter().map(|figures| get(&figures[place].1)).collect()
        };
        let mean = |values: &[f64]| values.iter().sum::<f64>() / n;
        let values = of(&|of| of.value);
        let middle = mean(&values);
        let squares: f64 = values.iter().map(|of| (of - middle) * (of - middle)).sum();
        (squares / (n - 1.0)).sqrt() / mean(&of(&|of| of.standard_uncertainty))
    };
    let names = all[0].iter().enumerate();
    let names = names.filter(|(_, (name, _))| counts.contains(&name.as_str()));
    names.map(|(place, (name, _))| (name.clone(), ratio(place))).collect()
}

const FIGURES: &[&str] =
    &["amplitude", "phase", "offset", "SNR", "SINAD", "RMS", "delay by cross-correlation"];

/// Benches by name, and the figures that count.
fn benches() -> Vec<(String, Bench)> {
    let rms = || vec![ChannelStep::Rms, ChannelStep::Delay { segments: None }];
    let with = |step: ChannelStep| [vec![step], rms()].concat();
    let steps = [
        ("no step", rms()),
        ("identity", with(identity())),
        ("low-pass", with(low_pass())),
        ("high-pass", with(high_pass())),
        ("derivative", with(derivative())),
    ];
    let mut benches = Vec::new();
    for memory in [0.0, 0.95, 0.97, -0.9] {
        for samples in [685, 3210] {
            for (about, steps) in &steps {
                if samples > 700 || *about != "high-pass" {
                    let about = format!("{about}, {memory}, {samples} values");
                    benches.push((about, bench(memory, samples, steps.clone())));
                }
            }
        }
    }
    benches
}

/// All figures of all benches, printed.
#[test]
#[ignore = "heavy: run by .ci/extra"]
fn scores() {
    for (about, of) in benches() {
        let notes: Vec<&str> =
            of.observe(of.values(3)).notes.iter().map(|note| note.code()).collect();
        let found = ratios(&of, 60, FIGURES);
        let found: Vec<String> =
            found.iter().map(|(name, ratio)| format!("{name} {ratio:.2}")).collect();
        println!("{about:32} {} {notes:?}", found.join(", "));
    }
}

/// The ratios of figures that were once furthest off: u was too small by 9 (offset after a correction),
/// by 5 (SNR), by 4 (RMS of noise with a memory, delay), by 3 (RMS after a low-pass of white noise) and by
/// 2 (amplitude of a derivative of five periods), and too large by 4 (offset with a coefficient of -0.9).
/// Of 16 recordings a ratio has a standard deviation of 18 %, of 32 one of 13 %: 0.5 to 1.6 and 0.6 to 1.5
/// are passed by all but one right figure in 500; fixed seeds, so that a test that passes once passes
/// always.
#[test]
fn noise_with_a_memory_goes_through_steps() {
    let delay = ChannelStep::Delay { segments: None };
    let rms = ChannelStep::Rms;
    let few = |memory, steps| (16, [0.5, 1.6], bench(memory, 1200, steps));
    let short = |steps| (32, [0.6, 1.5], bench(0.95, 685, steps));
    type Judged = ((u64, [f64; 2], Bench), &'static [&'static str]);
    let settings: [Judged; 6] = [
        (few(0.95, vec![identity(), rms.clone()]), &["offset", "SNR", "SINAD", "RMS"]),
        (few(-0.9, vec![low_pass()]), &["offset", "amplitude"]),
        (few(0.0, vec![low_pass(), rms, delay.clone()]), &["RMS", "delay by cross-correlation"]),
        (few(0.95, vec![delay]), &["delay by cross-correlation"]),
        (short(vec![derivative()]), &["amplitude"]),
        (short(vec![low_pass()]), &["amplitude", "SNR"]),
    ];
    for ((count, limits, mut bench), counts) in settings {
        if !bench.steps.iter().any(ChannelStep::needs_reference) {
            bench.channels.truncate(1);
        }
        for (name, ratio) in ratios(&bench, count, counts) {
            let about = format!("{} {} {name} {ratio:.3}", bench.memory, bench.samples);
            println!("{about}");
            assert!(limits[0] < ratio && ratio < limits[1], "{about}");
        }
    }
}

/// What the noise near the tones is taken from after steps is said where it was not white before them:
/// of five periods a process that fits, or, with a hum that none does, nothing. White noise has no note.
#[test]
fn what_the_noise_after_steps_is_taken_from_is_said() {
    // the keys of the notes, and of the ways to the noise
    let said = |bench: &Bench| -> Vec<(&'static str, Option<&'static str>)> {
        let notes = bench.observe(bench.values(3)).notes.into_iter().filter(|of| of.channel == 1);
        let way = |fact: &Fact| {
            fact.arguments.iter().find_map(|(name, argument)| match argument {
                Argument::Fact(way) if *name == "way" => Some(way.key),
                _ => None,
            })
        };
        notes.map(|note| (note.fact.key, way(&note.fact))).collect()
    };
    let of_process = said(&bench(0.95, 685, vec![derivative()]));
    let wanted = ("correlated-residuals.before-steps", Some("noise-of-process.before-steps"));
    assert!(of_process.contains(&wanted), "{of_process:?}");
    // of both channels' noise, and of nothing else
    assert_eq!(said(&bench(0.0, 685, vec![derivative()])), [("common-noise", None)]);
    // a hum that no process describes: nothing tells the noise beside it
    let hum = Bench { beside: Some((0.9, 0.8)), ..bench(0.0, 685, vec![low_pass()]) };
    let of_hum = said(&hum);
    assert!(of_hum.iter().any(|(_, way)| *way == Some("noise-even")), "{of_hum:?}");
}
