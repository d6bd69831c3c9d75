//! What a vibration laboratory looks for first, `models/laboratory/`, against independent computations.

use std::fs;

use serde_json::Value;

use crate::support::{output, root};

/// A ready file and its answer by the law of propagation.
struct Ready {
    file: Value,
    answer: Value,
}

impl Ready {
    fn of(name: &str) -> Self {
        let path = format!("models/laboratory/{name}.json");
        let text = fs::read_to_string(root().join(&path)).expect("a ready file");
        let answer = output(&["run", &path, "--trials", "0", "--format", "json", "--quiet"]);
        let json = |text: &str| serde_json::from_str(text).expect("JSON");
        Self { file: json(&text), answer: json(&answer) }
    }

    /// Estimate and standard uncertainty of an output.
    fn result(&self, output: &str) -> [f64; 2] {
        let gum = &self.answer["outputs"][output]["gum"];
        ["estimate", "standard_uncertainty"].map(|key| gum[key].as_f64().expect("a number"))
    }

    /// A number of an input.
    fn number(&self, input: &str, key: &str) -> f64 {
        let value = &self.file["inputs"][input][key];
        let text = value.as_str().and_then(|text| text.split(' ').next());
        value.as_f64().or_else(|| text?.parse().ok()).unwrap_or_else(|| panic!("{input}: {key}"))
    }

    /// Sum of the squares of what inputs in % contribute to a product of factors 1 + input, in %².
    fn squares(&self, factors: &[&str]) -> f64 {
        let square = |input: &&str| {
            let (key, divisor) = match self.file["inputs"][*input]["distribution"].as_str() {
                Some("rectangular") => ("half_width", 3f64.sqrt()),
                Some("arcsine") => ("half_width", 2f64.sqrt()),
                Some("normal") => ("expanded", 2.0),
                other => panic!("{input}: {other:?}"),
            };
            (self.number(input, key) / divisor).powi(2)
        };
        factors.iter().map(square).sum()
    }
}

/// Ten digits of an estimate and eight of a standard uncertainty: more than a double's roundings
/// leave out, fewer than the digits of the values below.
fn assert_near(name: &str, [estimate, u]: [f64; 2], expected: [f64; 2]) {
    assert!((estimate / expected[0] - 1.0).abs() < 1e-10, "{name}: {estimate}");
    assert!((u / expected[1] - 1.0).abs() < 1e-8, "{name}: {u}, not {}", expected[1]);
}

/// The relative variance of a product is the sum of the relative variances, by hand.
#[test]
fn comparison_of_an_accelerometer() {
    let ready = Ready::of("accelerometer_comparison");
    let factors = [
        "S_ref",
        "ratio_linearity",
        "drift",
        "gain_ref",
        "gain",
        "amplitude",
        "transverse",
        "transverse_ref",
        "strain",
        "relative_motion",
        "mounting",
        "distortion",
        "noise",
        "magnetic",
    ];
    let estimate = ready.number("S_ref", "mean") * ready.number("ratio", "mean");
    let ratio = ready.number("ratio", "std");
    let temperature =
        ready.number("temperature_coefficient", "mean") * ready.number("dT", "half_width");
    let relative = ready.squares(&factors) + ratio.powi(2) + temperature.powi(2) / 3.0;
    let expected = [estimate, estimate * relative.sqrt() / 100.0];
    assert_near("S", ready.result("S"), expected);
}

/// By hand, with the displacement of phi_M lambda/(4 pi) times the square of the angular frequency;
/// the frequency counts twice. The readings' mean is 0.
#[test]
fn interferometer_by_sine_approximation() {
    let ready = Ready::of("accelerometer_interferometer");
    let displacement = ready.number("phi_M", "value") * 632.81e-9 / (4.0 * std::f64::consts::PI);
    let a = displacement * (2.0 * std::f64::consts::PI * 160.0).powi(2);
    let phase = ["phi_Q", "phi_F", "phi_VD", "phi_MD", "phi_PD", "phi_RE"];
    let ppm = 1.0 + 100f64.powi(2) / 3.0;
    let of_a = ready.squares(&phase) + ppm * 1e-8;
    assert_near("a", ready.result("a"), [a, a * of_a.sqrt() / 100.0]);
    // readings 0.02, -0.03, 0.01, 0.04, -0.05, 0.01: squares 0.0056, over 5 and 6
    let relative = of_a + ready.squares(&["u_V", "u_F", "u_D", "u_T"]) + 0.0056 / 30.0;
    let estimate = 1000.0 * ready.number("u_V", "mean") / a;
    assert_near("S", ready.result("S"), [estimate, estimate * relative.sqrt() / 100.0]);
}

/// u² = mean(u_i²) + s² (1 + 1/n), with s² from the differences of all pairs. The mixture of the
/// certificates themselves (Prato et al. 2024) has the variance mean(u_i²) + s² (n - 1)/n: a further
/// sensor is not one of those that were calibrated, which adds 2 s²/n.
#[test]
fn a_sensor_of_the_batch() {
    let ready = Ready::of("sensor_batch");
    let values = |name: &str| -> Vec<f64> {
        (1..=8).map(|k| ready.number(&format!("{name}_{k}"), "value")).collect()
    };
    let (sensitivities, expanded) = (values("S"), values("U"));
    let pairs =
        sensitivities.iter().flat_map(|a| sensitivities.iter().map(move |b| (a - b).powi(2)));
    let between = pairs.sum::<f64>() / (2.0 * 8.0 * 7.0);
    let certificates = expanded.iter().map(|u| u * u / 4.0).sum::<f64>() / 8.0;
    let mean = sensitivities.iter().sum::<f64>() / 8.0;
    let [estimate, u] = ready.result("S");
    assert_near("S", [estimate, u], [mean, (certificates + between * 1.125).sqrt()]);
    let components = sensitivities.iter().zip(&expanded);
    let mixture = components.map(|(s, u)| s * s + u * u / 4.0).sum::<f64>() / 8.0 - mean * mean;
    // the squares of 418 lose five of sixteen digits
    assert!((u * u - mixture - 2.0 * between / 8.0).abs() < 1e-9);
}

/// By numpy: `lstsq` and the inverse of the normal matrix, with the scale of the reference added.
#[test]
fn linearity_of_each_axis_and_of_all() {
    let ready = Ready::of("linearity");
    for (name, estimate, u) in [
        ("S_x", 418.4274642268206, 1.0465220328521083),
        ("S_y", 417.1573434757167, 1.0436552180950718),
        ("S_z", 420.55925847119516, 1.056118021742883),
        ("S", 418.71468872457746, 1.1603961607380044),
        ("bias_x", 2.3735145486474765, 0.8025360251198697),
        ("bias_y", -2.975365710940543, 1.0388350033908926),
        ("bias_z", 8.387052502795415, 2.5986371326947837),
        ("bias", 2.595067113500191, 13.047318829492312),
        ("linearity_x", -0.008221210881483112, 0.0013854150175357535),
        ("linearity_y", 0.007084089707267317, 0.003998350523680158),
        ("linearity_z", -0.025824487823795667, 0.005180491670750476),
    ] {
        assert_near(name, ready.result(name), [estimate, u]);
    }
}
