//! Recordings to observations, and on to a gap case and a model.

use std::f64::consts::PI;
use std::fmt::Write;
use std::path::Path;
use std::process::Output;

use serde_json::{Value, json};

use crate::support::command;

const RATE: f64 = 1612.0;

/// A number that looks random between -1/2 and 1/2.
pub(crate) fn noise(i: u32) -> f64 {
    f64::from((u64::from(i) * u64::from(i) * 7919 % 10007) as u32) / 10007.0 - 0.5
}

/// Reference and sensor of a bench at a frequency: 10 m/s^2 and 9.9 m/s^2, 17 degrees later, with
/// 0.05 m/s^2 at twice the frequency.
fn values(hertz: f64, i: u32) -> [f64; 2] {
    let angle = 2.0 * PI * hertz * f64::from(i) / RATE;
    let late = 17f64.to_radians();
    let sensor = 9.9 * (angle + 0.3 - late).cos() + 0.05 * (2.0 * angle).cos();
    [10.0 * (angle + 0.3).cos() + 0.02 * noise(i), 0.4 + sensor + 0.02 * noise(i + 5000)]
}

/// The bench as a CSV of volts (10 mV/(m/s^2)) and metres per second squared.
fn csv(folder: &Path, name: &str, hertz: f64, samples: u32, digits: usize) {
    let mut text = "# synthetic\nt,ref,x\n".to_owned();
    for i in 0..samples {
        let [reference, sensor] = values(hertz, i);
        let t = f64::from(i) / RATE;
        writeln!(text, "{t:.8},{:.digits$},{sensor:.digits$}", reference / 100.0).unwrap();
    }
    std::fs::write(folder.join(name), text).unwrap();
}

fn recipe(file: &str) -> Value {
    json!({
        "title": "A bench",
        "recordings": {"run": {"file": file, "sampling_rate": RATE}},
        "channels": {
            "a_ref": {"column": "ref", "unit": "m/s^2", "raw_unit": "V",
                      "sensitivity": {"value": 10, "unit": "mV/(m/s^2)"}},
            "a_x": {"column": "x", "unit": "m/s^2"}
        },
        "reference": "a_ref", "frequency": 5, "components": [1, 2]
    })
}

pub(crate) fn observe(folder: &Path, recipe: &Value, arguments: &[&str]) -> Output {
    std::fs::write(folder.join("recipe.json"), recipe.to_string()).unwrap();
    let mut command = command();
    command.current_dir(folder).args(["observe", "recipe.json"]).args(arguments);
    command.output().unwrap()
}

pub(crate) fn answer(folder: &Path, recipe: &Value) -> Value {
    let said = observe(folder, recipe, &["--format", "json"]);
    assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
    serde_json::from_slice(&said.stdout).unwrap()
}

fn component<'v>(answer: &'v Value, channel: &str, number: usize) -> &'v Value {
    &answer["rows"][0]["channels"][channel]["components"][number]
}

/// |value - truth| < 3 u, u above 0 and below a bound.
fn check(found: &Value, truth: f64, bound: f64) {
    let (value, u) =
        (found["value"].as_f64().unwrap(), found["standard_uncertainty"].as_f64().unwrap());
    assert!(u > 0.0 && u < bound && (value - truth).abs() < 3.0 * u, "{value} {truth} u {u}");
}

/// What every form of the bench's recording must give.
fn check_bench(answer: &Value) {
    // noise of 0.02/sqrt(12) over 4836 samples: u of an amplitude 1.2e-4 m/s^2, of a phase 0.001 deg
    check(&component(answer, "a_ref", 0)["amplitude"], 10.0, 5e-4);
    let sensor = component(answer, "a_x", 0);
    check(&sensor["amplitude"], 9.9, 5e-4);
    check(&sensor["phase"], -17.0, 0.005);
    check(&sensor["delay"], 17.0 / 360.0 / 5.0, 3e-6);
    let second = component(answer, "a_x", 1);
    check(&second["amplitude"], 0.05, 5e-4);
    // 2 x 0.3 rad less
    check(&second["phase"], -0.6f64.to_degrees(), 0.3);
    check(&answer["rows"][0]["channels"]["a_x"]["offset"], 0.4, 5e-4);
    check(&answer["rows"][0]["channels"]["a_x"]["thd"], 0.05 / 9.9, 5e-5);
}

#[test]
fn a_bench_is_recovered_from_every_kind_of_file() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    csv(folder, "run.csv", 5.0, 4836, 7);
    let by_rate = recipe("run.csv");
    let found = answer(folder, &by_rate);
    check_bench(&found);
    let share: f64 = component(&found, "a_x", 0)["amplitude"]["budget"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| row["share"].as_f64().unwrap())
        .sum();
    assert!((share - 1.0).abs() < 1e-12);

    let mut by_time = recipe("run.csv");
    by_time["recordings"]["run"] = json!({"file": "run.csv", "time": "t"});
    check_bench(&answer(folder, &by_time));

    // counts of 1 mm/s^2 in a WAV of 16 bits
    let spec = hound::WavSpec {
        channels: 2,
        sample_rate: 1612,
        bits_per_sample: 16,
        sample_format: hound::SampleFormat::Int,
    };
    let mut wav = hound::WavWriter::create(folder.join("run.wav"), spec).unwrap();
    for i in 0..4836 {
        for value in values(5.0, i) {
            wav.write_sample((value * 1000.0).round() as i16).unwrap();
        }
    }
    wav.finalize().unwrap();
    let mut counts = recipe("run.wav");
    counts["recordings"]["run"] = json!({"file": "run.wav"});
    for (number, name) in ["a_ref", "a_x"].into_iter().enumerate() {
        counts["channels"][name] = json!({"column": number + 1, "unit": "m/s^2",
            "scale": {"value": 1, "unit": "mm/s^2"}});
    }
    let of_counts = answer(folder, &counts);
    check_bench(&of_counts);
    let sources = component(&of_counts, "a_x", 0)["amplitude"]["budget"].to_string();
    assert!(sources.contains("quantization"), "{sources}");

    // double precision in a NumPy file, as `gumption run --samples` writes them
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    let header =
        format!("{:<117}\n", "{'descr': '<f8', 'fortran_order': False, 'shape': (4836, 2), }");
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.bytes());
    bytes.extend((0..4836).flat_map(|i| values(5.0, i)).flat_map(f64::to_le_bytes));
    std::fs::write(folder.join("run.npy"), bytes).unwrap();
    let mut array = recipe("run.npy");
    for (number, name) in ["a_ref", "a_x"].into_iter().enumerate() {
        array["channels"][name] = json!({"column": number + 1, "unit": "m/s^2"});
    }
    check_bench(&answer(folder, &array));
    // the same bench, the frequency found in the recording, and the bins of whole periods
    array["frequency"] = json!({"estimate": true});
    let estimated = answer(folder, &array);
    check_bench(&estimated);
    check(&estimated["rows"][0]["frequency"], 5.0, 1e-4);
    array["frequency"] = json!(5);
    array["method"] = json!("fft");
    let bins = answer(folder, &array);
    // the cut at whole samples leaves some of the sine, which counts as noise near it
    check(&component(&bins, "a_x", 0)["phase"], -17.0, 0.1);
}

/// A table of UTF-16 with a byte-order mark, as Windows programs save it, is the same recording.
#[test]
fn recordings_in_utf_16() {
    let folder = tempfile::tempdir().unwrap();
    csv(folder.path(), "plain.csv", 5.0, 4000, 6);
    let right = answer(folder.path(), &recipe("plain.csv"));
    let text = std::fs::read_to_string(folder.path().join("plain.csv")).unwrap();
    for (name, of) in
        [("little.csv", u16::to_le_bytes as fn(u16) -> [u8; 2]), ("big.csv", u16::to_be_bytes)]
    {
        let wide: Vec<u8> =
            std::iter::once(0xfeff).chain(text.encode_utf16()).flat_map(of).collect();
        std::fs::write(folder.path().join(name), wide).unwrap();
        let found = answer(folder.path(), &recipe(name));
        assert_eq!(found["rows"], right["rows"], "{name}");
    }
}

/// A column is found by its name before the unit of its heading, which must be that of its values.
#[test]
fn headings_with_units() {
    let folder = tempfile::tempdir().unwrap();
    csv(folder.path(), "plain.csv", 5.0, 4000, 6);
    let right = answer(folder.path(), &recipe("plain.csv"));
    let text = std::fs::read_to_string(folder.path().join("plain.csv")).unwrap();
    let headed = |head: &str| {
        let text = text.replace("t,ref,x", head);
        std::fs::write(folder.path().join("headed.csv"), text).unwrap();
        recipe("headed.csv")
    };
    let found = answer(folder.path(), &headed("t / s,ref [V],x (m/s^2)"));
    assert_eq!(found["rows"], right["rows"]);
    let said = observe(folder.path(), &headed("t,ref [mV],x"), &[]);
    let said = String::from_utf8_lossy(&said.stderr).into_owned();
    assert!(said.contains("the heading of the column `ref [mV]` says `mV`"), "{said}");
    let said = observe(folder.path(), &headed("t,ref [V],ref [mV]"), &[]);
    assert_eq!(said.status.code(), Some(2));
}

#[test]
fn rows_become_observations_of_a_gap_case_and_conditions_of_a_model() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut many = recipe("run5.csv");
    many["conditions"] = json!({"tilt": {"unit": "deg", "value": 35}});
    many["components"] = json!([1]);
    let mut rows = Vec::new();
    for hertz in [5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 12.0, 14.0, 16.0, 20.0] {
        let name = format!("run{hertz}.csv");
        csv(folder, &name, hertz, 1000, 7);
        rows.push(json!({"files": {"run": name}, "frequency": hertz, "from": 0, "to": 0.5}));
    }
    many["rows"] = Value::Array(rows);
    let said = observe(folder, &many, &["--format", "csv", "--output", "data.csv"]);
    assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
    let case = json!({
        "inputs": {"a": {"unit": "m/s^2", "distribution": "normal", "mean": 9.9, "std": 0.001}},
        "conditions": {"f": {"unit": "Hz"}, "tilt": {"unit": "deg"}},
        "equations": {"a_x": "a + 0*f*a/f"},
        "outputs": {"a_x": {"unit": "m/s^2"}},
        "observations": {"file": "data.csv", "columns": {
            "a_x": {"value": "a_x_amplitude", "standard_uncertainty": "u_a_x_amplitude"}}},
        "effects": {"scale": {"overrides": {"a_x": "a_x*(1 + s)"}, "parameters": {
            "s": {"distribution": "normal", "mean": 0, "std": 0.05}}}}
    });
    std::fs::write(folder.join("case.json"), case.to_string()).unwrap();
    let said = command()
        .current_dir(folder)
        .args(["gap", "case.json", "--format", "json", "--quiet"])
        .output()
        .unwrap();
    assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
    let model = json!({
        "inputs": {"k": {"distribution": "constant", "value": 1}},
        "conditions": {"file": "data.csv", "units": {"a_x_amplitude": "m/s^2", "f": "Hz"}},
        "equations": {"y": "k*a_x_amplitude"}, "outputs": {"y": {"unit": "m/s^2"}},
        "monte_carlo": {"trials": 0}
    });
    std::fs::write(folder.join("model.json"), model.to_string()).unwrap();
    let said = command()
        .current_dir(folder)
        .args(["run", "model.json", "--format", "json", "--quiet"])
        .output()
        .unwrap();
    assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
    let found: Value = serde_json::from_slice(&said.stdout).unwrap();
    assert_eq!(found["rows"].as_array().unwrap().len(), 10);
}

#[test]
fn answers_are_the_same_bytes_and_tables_name_what_they_show() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    csv(folder, "run.csv", 5.0, 1612, 4);
    let recipe = recipe("run.csv");
    let first = observe(folder, &recipe, &["--format", "json", "--quiet"]);
    let second = observe(folder, &recipe, &["--format", "json", "--quiet"]);
    assert_eq!(first.stdout, second.stdout);
    assert!(first.stderr.is_empty());
    let page = observe(folder, &recipe, &[]);
    let page = String::from_utf8(page.stdout).unwrap();
    for word in ["A bench", "a_ref", "SNR", "against `a_ref`", "noise", "f = 5 Hz"] {
        assert!(page.contains(word), "{word}: {page}");
    }
}

/// A recording longer than what is held in memory gives the same answer as one that is held.
#[test]
#[ignore = "heavy: run by .ci/extra"]
fn long_recordings_stream() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let samples = 35_000_000u32;
    let spec = hound::WavSpec {
        channels: 1,
        sample_rate: 50_000,
        bits_per_sample: 16,
        sample_format: hound::SampleFormat::Int,
    };
    let mut wav = hound::WavWriter::create(folder.join("long.wav"), spec).unwrap();
    for i in 0..samples {
        let angle = 2.0 * PI * 0.0001 * f64::from(i);
        wav.write_sample((20_000.0 * angle.cos() + 30.0 * noise(i % 9000)).round() as i16).unwrap();
    }
    wav.finalize().unwrap();
    let recipe = json!({
        "recordings": {"run": {"file": "long.wav"}}, "channels": {"a": {"column": 1}},
        "frequency": 5
    });
    let found = answer(folder, &recipe);
    let amplitude = &component(&found, "a", 0)["amplitude"];
    check(amplitude, 20_000.0, 0.1);
}
