//! What is said of whole simulated recordings against their truth.

use std::f64::consts::PI;

use super::simulated::Bench;
use crate::study::Errors;
use crate::{ChannelObservation, ChannelStep, Measured, Method};
use gumption_engine::special::{normal, student};

/// The figures of channel b, and the frequency, with their true values.
pub(super) fn figures(
    bench: &Bench,
    of: &ChannelObservation,
    root: &ChannelObservation,
) -> Vec<(String, Measured, f64)> {
    let (a, b) = (&bench.channels[0], &bench.channels[1]);
    let mut figures = Vec::new();
    for (number, component) in of.components.iter().enumerate() {
        let n = number + 1;
        let phase = b[number].1 - n as f64 * a[0].1;
        let phase = phase - 2.0 * PI * (phase / (2.0 * PI)).round();
        let mut found = component.phase.measured;
        found.value -= 2.0 * PI * ((found.value - phase) / (2.0 * PI)).round();
        figures.push((format!("amplitude {n}"), component.amplitude.measured, b[number].0));
        figures.push((format!("phase {n}"), found, phase));
        if let Some(delay) = &component.delay {
            figures.push(("delay".into(), delay.measured, -phase / (2.0 * PI * bench.hertz)));
        }
    }
    figures.push(("reference".into(), root.components[0].amplitude.measured, a[0].0));
    figures.push(("offset".into(), of.offset.measured, bench.offset));
    let distortion = b[1].0 / b[0].0;
    figures.push(("distortion".into(), of.distortion.as_ref().unwrap().measured, distortion));
    if bench.noise > 0.0 && bench.resolution == 0.0 && bench.jitter == 0.0 {
        let power = bench.noise * bench.noise;
        let decibel = |noise: f64| 10.0 * (b[0].0 * b[0].0 / 2.0 / noise).log10();
        figures.push(("SNR".into(), of.signal_to_noise.measured, decibel(power)));
        let sinad = decibel(power + b[1].0 * b[1].0 / 2.0);
        figures.push(("SINAD".into(), of.sinad.measured, sinad));
    }
    if bench.estimate {
        figures.push(("frequency".into(), of.frequency, bench.hertz));
    }
    figures
}

/// Recordings of a bench, evaluated; `left_out` are figures that the bench says nothing about.
fn study(about: &str, bench: &Bench, count: u64, left_out: &[&str]) {
    let mut all: Vec<(String, Errors)> = Vec::new();
    for seed in 0..count {
        // amplitudes and levels that change, as those of real recordings do
        let mut bench = bench.clone();
        let turn = (seed as f64 * 0.618_033_988_749_895).fract();
        bench.offset += 3.7 * bench.resolution * turn;
        for channel in &mut bench.channels {
            channel[0].0 *= 1.0 + 0.05 * (turn * 7.3).fract();
            channel[0].1 += turn;
        }
        let observation = bench.observe(bench.values(seed));
        let [root, of] = observation.frequencies[0].as_slice() else { panic!() };
        for (number, (name, found, truth)) in figures(&bench, of, root).into_iter().enumerate() {
            if all.len() <= number {
                all.push((name, Errors::default()));
            }
            all[number].1.add(found, truth);
        }
    }
    for (name, errors) in all.iter().filter(|(name, _)| !left_out.contains(&name.as_str())) {
        errors.is_right(&format!("{about}, {name}"), None);
    }
}

/// The benches of the studies.
fn benches() -> Vec<(&'static str, Bench, &'static [&'static str])> {
    let plain = Bench::default();
    vec![
        ("white noise", plain.clone(), &[]),
        ("SNR 20 dB", Bench { noise: 0.07, ..plain.clone() }, &["distortion"]),
        ("SNR 100 dB", Bench { noise: 7e-6, ..plain.clone() }, &[]),
        ("3 periods", Bench { samples: 300, hertz: 10.07, ..plain.clone() }, &["distortion"]),
        (
            "400 periods",
            Bench { hertz: 200.1, rate: 5000.0, samples: 10_000, ..plain.clone() },
            &[],
        ),
        ("estimated", Bench { estimate: true, ..plain.clone() }, &[]),
        (
            "estimated, 3 periods",
            Bench { estimate: true, samples: 320, ..plain.clone() },
            &["distortion"],
        ),
        (
            "noise with a memory",
            Bench { memory: 0.9, samples: 8000, ..plain.clone() },
            &["distortion"],
        ),
        ("rounded to 0.01", Bench { resolution: 0.01, ..plain.clone() }, &[]),
        (
            "8 bit without noise",
            Bench {
                resolution: 2.0 / 256.0,
                noise: 1e-5,
                samples: 20_000,
                hertz: 10.313,
                ..plain.clone()
            },
            &["offset", "distortion", "amplitude 2", "phase 2", "phase 1", "delay", "reference"],
        ),
        (
            "jitter",
            Bench { jitter: 1e-3, noise: 0.001, ..plain.clone() },
            &["distortion", "amplitude 2", "phase 2"],
        ),
        (
            "uncertain rate",
            Bench { rate_uncertainty: 0.3, noise: 0.001, ..plain.clone() },
            &[
                "distortion",
                "offset",
                "amplitude 1",
                "reference",
                "amplitude 2",
                "phase 1",
                "delay",
                "phase 2",
                "SNR",
                "SINAD",
            ],
        ),
        (
            "by bins",
            Bench { method: Method::Fft, hertz: 10.0, rate: 1000.0, ..plain.clone() },
            // a cut at whole samples leaves some of the sine in the residuals
            &["SNR", "SINAD"],
        ),
    ]
}

#[test]
fn uncertainties_are_those_of_200_recordings() {
    for (about, bench, left_out) in benches().iter().filter(|(_, bench, _)| bench.samples <= 2000) {
        study(about, bench, 200, left_out);
    }
}

/// The whole study: 1000 recordings of every bench.
#[test]
#[ignore = "heavy: run by .ci/extra"]
fn uncertainties_are_those_of_1000_recordings() {
    for (about, bench, left_out) in benches() {
        study(about, &bench, 1000, left_out);
    }
}

/// What makes noise of a number from 0 to 1.
type Shape = fn(f64) -> f64;

const SHAPES: [(&str, Shape); 3] = [
    ("uniform", |p| 12f64.sqrt() * (p - 0.5)),
    ("normal", normal::quantile),
    ("t, 5", |p| 0.6f64.sqrt() * student::quantile(p, 5.0)),
];

/// The ratios of the errors of SNR, SINAD and RMS to their standard uncertainties, for noise that is
/// uniform (as rounding makes it), normal, and of a t-distribution with 5 degrees of freedom. By the
/// variance of normal noise they would be 0.63, 1 and up to 2. Of 300 recordings a ratio has a
/// standard deviation of 4 % for normal noise and of some 6 % for the t-distribution.
fn judge_power_of_noise(shapes: &[(&str, Shape)]) {
    // of the RMS with little noise most is the sine, and of SNR with much noise
    for (noise, counts) in [(0.01, &["SNR", "SINAD"][..]), (2.0, &["RMS"][..])] {
        for &(about, shape) in shapes {
            let bench = Bench { noise, shape, steps: vec![ChannelStep::Rms], ..Bench::default() };
            let mut all: Vec<Errors> = counts.iter().map(|_| Errors::default()).collect();
            for seed in 0..300 {
                let observation = bench.observe(bench.values(seed));
                let [root, of] = observation.frequencies[0].as_slice() else { panic!() };
                let mut figures = figures(&bench, of, root);
                let power = 0.5 * (0.5 * 0.5 + 0.01 * 0.01) + noise * noise;
                figures.push(("RMS".into(), of.findings[0].measured().unwrap(), power.sqrt()));
                for (errors, name) in all.iter_mut().zip(counts) {
                    let (_, found, truth) = figures.iter().find(|of| of.0 == *name).unwrap();
                    errors.add(*found, *truth);
                }
            }
            for (errors, name) in all.iter().zip(counts) {
                let ratio = errors.ratio();
                println!("{about}, {name}: {ratio:.3}");
                assert!((0.8..1.2).contains(&ratio), "{about}, {name}: {ratio}");
            }
        }
    }
}

#[test]
fn power_of_heavy_tailed_noise_is_known_by_its_kurtosis() {
    judge_power_of_noise(&SHAPES[2..]);
}

#[test]
#[ignore = "heavy: run by .ci/extra"]
fn power_of_noise_is_known_by_its_kurtosis() {
    judge_power_of_noise(&SHAPES);
}
