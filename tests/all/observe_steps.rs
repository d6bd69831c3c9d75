//! Steps of a recipe, end to end: synthetic recordings whose answer is known.

use std::f64::consts::TAU;
use std::path::Path;

use serde_json::{Value, json};

use crate::support::command;

const RATE: f64 = 1612.0;
const SAMPLES: u32 = 6000;

/// Nearly normal noise of standard deviation 1: the sum of 12 uniform numbers less 6, from a linear
/// congruential generator.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        let mut uniform = || {
            self.0 = self
                .0
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1u64 << 53) as f64
        };
        (0..12).map(|_| uniform()).sum::<f64>() - 6.0
    }
}

/// A file of doubles, one column for each function of the time.
fn write(folder: &Path, name: &str, rate: f64, noise: f64, columns: &[&dyn Fn(f64) -> f64]) {
    let mut source = Noise(7);
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    let shape = format!("({SAMPLES}, {})", columns.len());
    let header = format!(
        "{:<117}\n",
        format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}")
    );
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.bytes());
    for i in 0..SAMPLES {
        for column in columns {
            let value = column(f64::from(i) / rate) + noise * source.next();
            bytes.extend(value.to_le_bytes());
        }
    }
    std::fs::write(folder.join(name), bytes).unwrap();
}

fn answer(folder: &Path, recipe: &Value) -> Value {
    std::fs::write(folder.join("recipe.json"), recipe.to_string()).unwrap();
    let said = command()
        .current_dir(folder)
        .args(["observe", "recipe.json", "--format", "json", "--quiet"])
        .output()
        .unwrap();
    assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
    serde_json::from_slice(&said.stdout).unwrap()
}

fn component<'v>(answer: &'v Value, channel: &str, number: usize) -> &'v Value {
    &answer["rows"][0]["channels"][channel]["components"][number]
}

fn pair(found: &Value) -> (f64, f64) {
    (found["value"].as_f64().unwrap(), found["standard_uncertainty"].as_f64().unwrap())
}

/// |value - truth| < 3 u, and u within a tenth of what theory says.
fn check(found: &Value, truth: f64, u_truth: f64) {
    let (value, u) = pair(found);
    assert!((value - truth).abs() < 3.0 * u, "{value} {truth} u {u}");
    assert!((u / u_truth - 1.0).abs() < 0.1, "{found}: {u_truth}");
}

fn contribution(found: &Value, source: &str) -> f64 {
    let rows = found["budget"].as_array().unwrap().iter();
    let mut of = rows.filter(|row| row["source"] == source);
    of.next().map_or(0.0, |row| row["contribution"].as_f64().unwrap())
}

/// 5 Hz with 3 m/s^2 of hum at 300 Hz: what a low-pass and a band-pass filter leave has the amplitude
/// and the phase before them; the noise of the fit is that before, sigma sqrt(2/N), as the hum is
/// gone. Without the correction the gain of the filter is in the answer and said.
#[test]
fn filters_give_back_what_went_in() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let clean = |t: f64| 10.0 * (TAU * 5.0 * t).cos();
    let late = |t: f64| 9.0 * (TAU * 5.0 * t - 0.3).cos();
    write(folder, "run.npy", RATE, 0.02, &[&clean, &late]);
    let noise = |samples: f64| 0.02 * (2.0 / samples).sqrt();
    let recipe = |step: Value| {
        json!({
            "recordings": {"run": {"file": "run.npy", "sampling_rate": RATE}},
            "channels": {
                "r": {"column": 1, "unit": "m/s^2"},
                "x": {"column": 2, "unit": "m/s^2", "steps": [step]}
            },
            "reference": "r", "frequency": 5
        })
    };
    for step in [
        json!({"step": "low-pass", "cutoff": 40, "order": 6}),
        json!({"step": "low-pass", "cutoff": {"value": 0.02, "unit": "kHz"}, "both_ways": true}),
        json!({"step": "high-pass", "cutoff": 1, "order": 2}),
        json!({"step": "band-pass", "low": 3, "high": 8, "order": 4}),
    ] {
        let found = answer(folder, &recipe(step));
        let x = component(&found, "x", 0);
        let samples = found["rows"][0]["channels"]["x"]["samples"].as_f64().unwrap();
        assert!(samples > 1000.0 && samples < f64::from(SAMPLES), "{samples}");
        check(&x["amplitude"], 9.0, noise(samples));
        let of_both = (noise(samples) / 9.0).hypot(noise(f64::from(SAMPLES)) / 10.0);
        check(&x["phase"], -0.3f64.to_degrees(), of_both.to_degrees());
    }
    let plain = answer(folder, &recipe(json!({"step": "low-pass", "cutoff": 5, "correct": false})));
    // at its corner a filter of six poles has the gain 1/sqrt(2) and has turned by 6 x 45 deg
    let (amplitude, u) = pair(&component(&plain, "x", 0)["amplitude"]);
    assert!((amplitude - 9.0 / 2f64.sqrt()).abs() < 3.0 * u);
    let (phase, u) = pair(&component(&plain, "x", 0)["phase"]);
    assert!((phase - (90.0 - 0.3f64.to_degrees())).abs() < 3.0 * u, "{phase}");
    let findings = &plain["rows"][0]["channels"]["x"]["findings"];
    let gain = findings["gain of the low-pass at 5 Hz"]["value"].as_f64().unwrap();
    assert!((gain - 0.5f64.sqrt()).abs() < 1e-9);
    assert!(plain["warnings"].to_string().contains("filter-not-corrected"));

    // strong hum: without the filter it is the noise
    let hum = |t: f64| 9.0 * (TAU * 5.0 * t - 0.3).cos() + 3.0 * (TAU * 300.0 * t).cos();
    write(folder, "run.npy", RATE, 0.02, &[&clean, &hum]);
    let found = answer(folder, &recipe(json!({"step": "low-pass", "cutoff": 40, "order": 6})));
    let (amplitude, u) = pair(&component(&found, "x", 0)["amplitude"]);
    assert!((amplitude - 9.0).abs() < 3.0 * u && u < 3e-3, "{amplitude} {u}");
}

/// 20 mm/s at 5 Hz: acceleration and displacement have 2 pi f and 1/(2 pi f) of it, a quarter turn
/// before and after; with u(f)/f = 1e-4 in both.
#[test]
fn derivatives_and_integrals_have_their_gain_and_unit() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let velocity = |t: f64| 20.0 * (TAU * 5.0 * t + 0.2).cos();
    write(folder, "run.npy", RATE, 0.02, &[&velocity]);
    let channel = |step: Value| json!({"column": 1, "unit": "mm/s", "steps": [step]});
    let recipe = json!({
        "recordings": {"run": {"file": "run.npy", "sampling_rate": RATE}},
        "channels": {
            "v": {"column": 1, "unit": "mm/s"},
            "a": channel(json!({"step": "derivative", "unit": "m/s^2"})),
            "j": channel(json!({"step": "derivative", "times": 2})),
            "d": channel(json!({"step": "integral", "unit": "um"}))
        },
        "reference": "v",
        "frequency": {"value": 5, "standard_uncertainty": 0.0005}
    });
    let found = answer(folder, &recipe);
    let w = TAU * 5.0;
    let noise = 0.02 / 20.0 * (2.0 / f64::from(SAMPLES)).sqrt();
    for (name, unit, amplitude, order, phase) in [
        ("a", "m/s^2", 0.02 * w, 1.0, 90.0),
        ("j", "(mm/s)/s^2", 20.0 * w * w, 2.0, 180.0),
        ("d", "um", 20_000.0 / w, 1.0, -90.0),
    ] {
        let of = component(&found, name, 0);
        assert_eq!(of["amplitude"]["unit"], unit);
        // a fit at the stated frequency that is 1e-4 off: relative cycles 1e-4 x 18.6 periods, x =
        // pi 1.86e-3 = 5.8e-3, 1 - sinc is x^2/6: 1e-5 of the amplitude
        let known = of["amplitude"]["value"].as_f64().unwrap() * 1e-4 * order;
        check(&of["amplitude"], amplitude, (amplitude * noise).hypot(known));
        assert!((contribution(&of["amplitude"], "derivative") / known - 1.0).abs() < 1e-6);
        let (found, u) = pair(&of["phase"]);
        let apart = (found - phase + 540.0).rem_euclid(360.0) - 180.0;
        assert!(apart.abs() < 3.0 * u && u < 0.01, "{name}: {found} {u}");
    }
}

/// The rotating table of paper 002 at 8 Hz: an angle of 13 deg from end to end at 170 mm; tangential
/// r w^2 theta at 8 Hz, radial r (w theta)^2 / 2 at 16 Hz and as a mean; u(r)/r = 0.1/170 in all.
#[test]
fn an_angle_becomes_tangential_and_radial_acceleration() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let angle = |t: f64| 6.5 * (TAU * 8.0 * t + 0.4).cos();
    write(folder, "run.npy", RATE, 0.005, &[&angle]);
    let channel = |step: &str| {
        json!({"column": 1, "unit": "deg", "steps": [{"step": step,
            "radius": {"value": 170, "unit": "mm", "standard_uncertainty": 0.1}}]})
    };
    let recipe = json!({
        "recordings": {"run": {"file": "run.npy", "sampling_rate": RATE}},
        "channels": {"theta": {"column": 1, "unit": "deg"}, "t": channel("tangential"),
                     "r": channel("radial")},
        "reference": "theta", "frequency": 8, "components": [1, 2]
    });
    let found = answer(folder, &recipe);
    let (w, theta) = (TAU * 8.0, 6.5f64.to_radians());
    let (tangential, radial) = (0.17 * w * w * theta, 0.17 * (w * theta).powi(2) / 2.0);
    let noise = 0.005 / 6.5 * (2.0 / f64::from(SAMPLES)).sqrt();
    let of_radius = 0.1 / 170.0;
    let t = component(&found, "t", 0);
    assert_eq!(t["amplitude"]["unit"], "m/s^2");
    check(&t["amplitude"], tangential, tangential * noise.hypot(of_radius));
    assert!((contribution(&t["amplitude"], "radius") / tangential / of_radius - 1.0).abs() < 1e-3);
    // a fit after a derivative takes up some of the stronger noise above it: 13 % at 29.8 periods
    assert!((contribution(&t["amplitude"], "noise") / tangential / noise - 1.13).abs() < 0.1);
    let (phase, u) = pair(&t["phase"]);
    assert!((phase.abs() - 180.0).abs() < 3.0 * u);
    let r = component(&found, "r", 1);
    // a square has twice the relative noise of the velocity, at f and at 3 f, where the derivative
    // makes it three times as strong
    let of_noise = 2.0 * radial * noise * 10f64.sqrt();
    check(&r["amplitude"], radial, of_noise.hypot(radial * of_radius));
    assert!((contribution(&r["amplitude"], "noise") / of_noise - 1.0).abs() < 0.1);
    let (phase, u) = pair(&r["phase"]);
    assert!((phase.abs() - 180.0).abs() < 3.0 * u, "{phase} {u}");
    let (mean, u) = pair(&found["rows"][0]["channels"]["r"]["offset"]);
    assert!((mean - radial).abs() < 3.0 * u, "{mean} {radial} {u}");
}

/// Paper 002's sensor: 5 Hz, true rate 1612.3 Hz, sought from 1560 Hz to 1760 Hz. The uncertainty of
/// a rate in white noise: sqrt(6) rate^2 sigma/(pi f A N^(3/2)); with u(f)/f = 1e-5 in addition. Its
/// amplitude and its distance to the second channel are what they are.
#[test]
fn a_sampling_rate_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let first = |t: f64| 0.3 + 10.0 * (TAU * 5.0 * t + 0.4).cos() + 0.1 * (TAU * 10.0 * t).cos();
    let second = |t: f64| 5.0 * (TAU * 5.0 * t + 0.1).cos();
    write(folder, "run.npy", 1612.3, 0.05, &[&first, &second]);
    let recipe = |frequency: Value| {
        json!({
            "recordings": {"run": {"file": "run.npy", "sampling_rate":
                {"search": {"channel": "x", "from": 1560, "to": 1760, "step": 1}}}},
            "channels": {"x": {"column": 1, "unit": "m/s^2"}, "y": {"column": 2, "unit": "m/s^2"}},
            "reference": "x", "frequency": frequency
        })
    };
    let n = f64::from(SAMPLES);
    let noise = 6f64.sqrt() * 1612.3 * 1612.3 * 0.05 / (TAU / 2.0 * 5.0 * 10.0 * n.powf(1.5));
    let found = answer(folder, &recipe(json!(5)));
    let x = &found["rows"][0]["channels"]["x"];
    check(&x["sampling_rate"], 1612.3, noise);
    check(&x["findings"]["sampling rate"], 1612.3, noise);
    let of_noise = 0.05 * (2.0 / n).sqrt();
    check(&component(&found, "x", 0)["amplitude"], 10.0, of_noise);
    let of_phase = (of_noise / 10.0).hypot(of_noise / 5.0).to_degrees();
    check(&component(&found, "y", 0)["phase"], -0.3f64.to_degrees(), of_phase);

    // a rate from the frequency is as uncertain as the frequency; the number of periods is not
    let with_u = answer(folder, &recipe(json!({"value": 5, "standard_uncertainty": 5e-5})));
    let x = &with_u["rows"][0]["channels"]["x"];
    check(&x["sampling_rate"], 1612.3, noise.hypot(1612.3e-5));
    check(&x["periods"], 5.0 * n / 1612.3, 5.0 * n / 1612.3 * noise / 1612.3);
    check(&component(&with_u, "x", 0)["amplitude"], 10.0, of_noise);
}

/// A sine 0.3 rad late through a gain of 0.85: delay, RMS and correction say so. The two ways to a
/// delay agree; after the correction what is left of the difference is the noise of both, sigma
/// sqrt(1 + 1/0.85^2).
#[test]
fn delays_and_corrections_are_found() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let first = |t: f64| 10.0 * (TAU * 5.0 * t + 0.4).cos();
    let second = |t: f64| 8.5 * (TAU * 5.0 * t + 0.1).cos();
    write(folder, "run.npy", RATE, 0.02, &[&first, &second]);
    let correct = json!({"step": "correct", "gain": {"value": 0.85, "standard_uncertainty": 0.001},
        "phase": {"value": -0.3, "unit": "rad", "standard_uncertainty": 0.002}});
    let recipe = json!({
        "recordings": {"run": {"file": "run.npy", "sampling_rate": RATE}},
        "channels": {"r": {"column": 1, "unit": "m/s^2"},
                     "x": {"column": 2, "unit": "m/s^2", "steps": ["delay", "rms", correct]}},
        "reference": "r", "frequency": 5
    });
    let found = answer(folder, &recipe);
    let findings = &found["rows"][0]["channels"]["x"]["findings"];
    let n = f64::from(SAMPLES);
    let of_noise = 0.02 * (2.0 / n).sqrt();
    let of_phase = (of_noise / 10.0).hypot(of_noise / 8.5);
    check(&findings["delay by cross-correlation"], 0.3 / (TAU * 5.0), of_phase / (TAU * 5.0));
    let (phase, u) = pair(&findings["phase by cross-spectrum"]);
    assert!((phase + 0.3f64.to_degrees()).abs() < 3.0 * u && u < 2.0 * of_phase.to_degrees());
    // of 1 - g of the coherence u is a part, 1 over the root of one less than the segments near 1
    let (coherence, u) = pair(&findings["coherence"]);
    assert!(u > 0.0 && (1.0 - coherence) / u < 10.0);
    let no_u = &findings["normalized error of the delays"];
    assert!(no_u["value"].as_f64().unwrap() < 1.0);
    assert!(no_u["standard_uncertainty"].is_null() && no_u["dof"].is_null());
    let (rms, u) = pair(&findings["RMS"]);
    assert!((rms - (8.5f64 * 8.5 / 2.0 + 0.0004).sqrt()).abs() < 3.0 * u && u < 1e-3);
    let (after, u) = pair(&findings["RMS difference after correction"]);
    assert!((after - 0.02 * 1f64.hypot(1.0 / 0.85)).abs() < 4.0 * u && u < 1e-3, "{after} {u}");
    let x = component(&found, "x", 0);
    // 1/850 and 2 mrad of the correction are nearly all of the uncertainty
    check(&x["amplitude"], 10.0, 10.0 * 0.001 / 0.85);
    check(&x["phase"], 0.0, 0.002f64.to_degrees());
}
