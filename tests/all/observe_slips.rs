//! Slips at the bench that give an answer and a wrong one: units, rates, frequencies and samples that
//! contradict the recording.

use std::f64::consts::PI;
use std::fmt::Write;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::observe::{answer, noise, observe};
use crate::support::command;

/// A sine of 200 (mV) at 16 Hz, sampled at 1000 Hz for 4 s with noise of 0.2/sqrt(12), and what
/// `change` makes of it.
fn recorded(
    folder: &Path,
    heading: &str,
    time: impl Fn(u32) -> String,
    change: impl Fn(u32, f64) -> f64,
) {
    let mut text = format!("{heading}\n");
    for i in 0..4000 {
        let value = 200.0 * (2.0 * PI * 16.0 * f64::from(i) / 1000.0 + 0.3).cos();
        let value = change(i, value + 0.2 * noise(i));
        writeln!(text, "{},{value:.4}", time(i)).unwrap();
    }
    fs::write(folder.join("run.csv"), text).unwrap();
}

fn seconds(i: u32) -> String {
    format!("{:.3}", f64::from(i) / 1000.0)
}

fn plain(folder: &Path) {
    recorded(folder, "t [s],acc [mV]", seconds, |_, value| value);
}

/// A recipe of the channel `acc` of that recording.
fn recipe(channel: &Value) -> Value {
    json!({
        "recordings": {"run": {"file": "run.csv", "time": "t"}},
        "channels": {"acc": channel}, "frequency": 16
    })
}

fn millivolts() -> Value {
    recipe(&json!({"column": "acc", "unit": "mV"}))
}

fn said(folder: &Path, recipe: &Value) -> String {
    let said = observe(folder, recipe, &["--format", "json"]);
    String::from_utf8(said.stderr).unwrap()
}

/// A refusal: exit code 2 and the words.
fn refused(folder: &Path, recipe: &Value, words: &[&str]) {
    let found = observe(folder, recipe, &[]);
    let said = String::from_utf8(found.stderr).unwrap();
    assert_eq!(found.status.code(), Some(2), "{said}");
    for word in words {
        assert!(said.contains(word), "{word}: {said}");
    }
}

/// The code and the text of each note.
fn notes(folder: &Path, recipe: &Value) -> Vec<(String, String)> {
    let answer = answer(folder, recipe);
    let notes = answer["warnings"].as_array().unwrap().iter();
    let text = |note: &Value, key: &str| note[key].as_str().unwrap().to_owned();
    notes.map(|note| (text(note, "code"), text(note, "text"))).collect()
}

fn note(folder: &Path, recipe: &Value, code: &str) -> String {
    let notes = notes(folder, recipe);
    let found = notes.iter().find(|(of, _)| of == code);
    found.unwrap_or_else(|| panic!("{code}: {notes:?}")).1.clone()
}

/// Samples that never stand in a row at the end of the range, at nearly four in each period: three are
/// saturated where the range is stated, and a heap of them is told where it is not.
#[test]
fn single_samples_at_the_end_of_the_range_are_saturated() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let clipped = |i: u32, _: f64| {
        let value = 200.0 * (2.0 * PI * 263.0 * f64::from(i) / 1000.0 + 0.3).cos();
        (value + 0.2 * noise(i)).clamp(-160.0, 160.0)
    };
    recorded(folder, "t [s],acc [mV]", seconds, clipped);
    let fast = |channel: Value| {
        let mut recipe = recipe(&channel);
        recipe["frequency"] = json!(263);
        recipe
    };
    let text = note(folder, &fast(json!({"column": "acc", "unit": "mV"})), "saturated");
    assert!(text.contains("of 4000 values are") && text.contains("may be saturated"), "{text}");
    let stated = fast(json!({"column": "acc", "unit": "mV", "range": [-160, 160]}));
    refused(folder, &stated, &["the channel is saturated", "at or beyond its range, -160 to 160"]);
    // a sine that is not, with 12 decimals and with two, and one whose samples repeat each period
    let sines: [&dyn Fn(u32) -> f64; 3] = [
        &|i| 200.0 * (2.0 * PI * 263.0 * f64::from(i) / 1000.0 + 0.3).cos(),
        &|i| (200.0 * (2.0 * PI * 16.0 * f64::from(i) / 1000.0).cos()).round(),
        &|i| 200.0 * (2.0 * PI * 20.0 * f64::from(i) / 1000.0).cos(),
    ];
    for sine in sines {
        recorded(folder, "t [s],acc [mV]", seconds, |i, _| sine(i));
        let notes = notes(folder, &millivolts());
        assert!(notes.iter().all(|(code, _)| code != "saturated"), "{notes:?}");
    }
}

#[test]
fn headings_are_checked_of_columns_by_number_and_of_scaled_ones() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    plain(folder);
    let in_millivolts =
        ["the heading of the column `acc [mV]` says `mV`", "`\"raw_unit\": \"mV\"`"];
    for channel in [
        json!({"column": 2, "unit": "V"}),
        json!({"column": 2, "unit": "m/s^2", "raw_unit": "V",
               "sensitivity": {"value": 10, "unit": "mV/(m/s^2)"}}),
        json!({"column": "acc", "unit": "m/s^2", "scale": {"value": 100, "unit": "m/s^2"}}),
        json!({"column": 2, "unit": "m/s^2", "scale": {"value": 100, "unit": "m/s^2"}}),
    ] {
        refused(folder, &recipe(&channel), &in_millivolts);
    }
    // as the heading has it: 200 mV over 10 mV/(m/s^2) are 20 m/s^2
    let right = recipe(&json!({"column": 2, "unit": "m/s^2", "raw_unit": "mV",
        "sensitivity": {"value": 10, "unit": "mV/(m/s^2)"}}));
    let amplitude = &answer(folder, &right)["rows"][0]["channels"]["acc"]["components"][0];
    let amplitude = amplitude["amplitude"]["value"].as_f64().unwrap();
    assert!((amplitude - 20.0).abs() < 1e-3, "{amplitude}");

    recorded(folder, "t [ms],acc [mV]", |i| i.to_string(), |_, value| value);
    let mut by_number = millivolts();
    by_number["recordings"]["run"]["time"] = json!(1);
    refused(folder, &by_number, &["`t [ms]` says `ms`", "`\"time_unit\": \"ms\"`"]);
    by_number["recordings"]["run"]["time_unit"] = json!("ms");
    assert_eq!(said(folder, &by_number), "");

    // quantity over unit without spaces (ISO 80000-1), by name and by number
    recorded(folder, "t/ms,acc/mV", |i| i.to_string(), |_, value| value);
    let mut over = recipe(&json!({"column": "acc", "unit": "V"}));
    refused(folder, &over, &["`acc/mV` says `mV`, but its values are read in `V`"]);
    over["channels"]["acc"] = json!({"column": 2, "unit": "mV"});
    refused(
        folder,
        &over,
        &["`t/ms` says `ms`, but its values are read in `s`", "`\"time_unit\": \"ms\"`"],
    );
    over["recordings"]["run"]["time_unit"] = json!("ms");
    assert_eq!(said(folder, &over), "");
    // a ratio's name
    recorded(folder, "t in s,U1/U2", seconds, |_, value| value);
    assert_eq!(said(folder, &recipe(&json!({"column": "U1/U2", "unit": "V"}))), "");

    // counts, and no unit at all
    let counts = recipe(&json!({"column": 2, "unit": "mV", "scale": {"value": 1, "unit": "mV"}}));
    for heading in ["t,acc [1]", "t,acc"] {
        recorded(folder, heading, seconds, |_, value| value);
        assert_eq!(said(folder, &counts), "", "{heading}");
    }
}

/// A channel is scaled, never shifted: an offset of 68 degF was one of 37.78 degC.
#[test]
fn raw_values_of_another_zero_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    recorded(folder, "t [s],T", seconds, |_, value| value);
    for (unit, raw) in [("degC", "degF"), ("K", "degC")] {
        let channel = recipe(&json!({"column": 2, "unit": unit, "raw_unit": raw}));
        refused(folder, &channel, &["another zero", &format!("let `unit` be `{raw}`")]);
    }
    let alike = recipe(&json!({"column": 2, "unit": "degF", "raw_unit": "degF"}));
    assert_eq!(said(folder, &alike), "");
}

/// `g` is the gram here and standard gravity on an accelerometer: 9.806 65 m/s^2 (ISO 80000-3).
#[test]
fn a_heading_in_g_is_standard_gravity_where_the_recipe_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    recorded(folder, "t [s],acc [g]", seconds, |_, value| value);
    let channel = |raw: &str| recipe(&json!({"column": 2, "unit": "m/s^2", "raw_unit": raw}));
    let amplitude = |recipe: &Value| {
        let answer = answer(folder, recipe);
        let component = &answer["rows"][0]["channels"]["acc"]["components"][0];
        component["amplitude"]["value"].as_f64().unwrap()
    };
    assert!((amplitude(&channel("g_n")) / (200.0 * 9.80665) - 1.0).abs() < 1e-4);
    assert_eq!(said(folder, &channel("g_n")), "");
    let in_gravity = recipe(&json!({"column": "acc", "unit": "g_n"}));
    assert!((amplitude(&in_gravity) / 200.0 - 1.0).abs() < 1e-4);
    assert_eq!(said(folder, &in_gravity), "");

    let plain = recipe(&json!({"column": 2, "unit": "m/s^2"}));
    refused(folder, &plain, &["says `g`", "`g` is the gram", "`\"raw_unit\": \"g_n\"`"]);
    refused(folder, &channel("g"), &["`g` is the gram", "write `g_n`"]);
    recorded(folder, "t [s],acc", seconds, |_, value| value);
    let scaled =
        recipe(&json!({"column": 2, "unit": "m/s^2", "scale": {"value": 0.1, "unit": "g"}}));
    refused(folder, &scaled, &["`g` is the gram", "write `g_n`"]);
    let sensitivity = json!({"column": 2, "unit": "m/s^2", "raw_unit": "V",
        "sensitivity": {"value": 100, "unit": "mV/g"}});
    refused(folder, &recipe(&sensitivity), &["`g` is the gram", "write `mV/g_n`"]);
    let of_channel =
        recipe(&json!({"column": 2, "unit": "g", "scale": {"value": 0.1, "unit": "g_n"}}));
    refused(folder, &of_channel, &["`g` is the gram", "write `g_n`"]);
    // no advice of a wrong dimension, and a word about grams
    recorded(folder, "t [s],acc [V]", seconds, |_, value| value);
    refused(folder, &plain, &["`\"raw_unit\": \"V\"` and a `scale` or a `sensitivity`"]);
    recorded(folder, "t [s],acc [g]", seconds, |_, value| value);
    let grams = recipe(&json!({"column": 2, "unit": "g"}));
    let note = note(folder, &grams, "grams");
    assert!(note.contains("the unit of a mass") && note.contains("`g_n`"), "{note}");
}

#[test]
fn rates_that_contradict_the_file_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    plain(folder);
    let mut other = millivolts();
    other["recordings"]["run"]["sampling_rate"] = json!(1100);
    // 16 Hz x 1100/1000
    let text = note(folder, &other, "sampling-rates-differ");
    assert!(text.contains("states a sampling rate of 1100 Hz, but its time column has 1000 Hz"));
    assert!(text.contains("frequencies are 1.1 times"), "{text}");
    // within a thousandth, and within what is stated
    let known = json!({"value": 1100, "unit": "Hz", "standard_uncertainty": 50});
    for rate in [json!(1000.9), known] {
        other["recordings"]["run"]["sampling_rate"] = rate;
        let notes = notes(folder, &other);
        assert!(notes.iter().all(|(code, _)| code != "sampling-rates-differ"), "{notes:?}");
    }
    let spec = hound::WavSpec {
        channels: 1,
        sample_rate: 1000,
        bits_per_sample: 16,
        sample_format: hound::SampleFormat::Int,
    };
    let mut wav = hound::WavWriter::create(folder.join("run.wav"), spec).unwrap();
    for i in 0..4000 {
        let value = 20_000.0 * (2.0 * PI * 0.016 * f64::from(i)).cos();
        wav.write_sample((value + 9.0 * noise(i)) as i16).unwrap();
    }
    wav.finalize().unwrap();
    let mut of_wav = json!({
        "recordings": {"run": {"file": "run.wav", "sampling_rate": 2000}},
        "channels": {"acc": {"column": 1}}, "frequency": 32
    });
    let text = note(folder, &of_wav, "sampling-rates-differ");
    assert!(text.contains("2000 Hz, but its header says 1000 Hz"), "{text}");
    of_wav["recordings"]["run"]["sampling_rate"] = json!(1000.4);
    of_wav["frequency"] = json!(16);
    let notes = notes(folder, &of_wav);
    assert!(notes.iter().all(|(code, _)| code != "sampling-rates-differ"), "{notes:?}");
}

#[test]
fn wrong_frequencies_are_told_with_the_tone_that_is_there() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    plain(folder);
    let mut wrong = millivolts();
    // 2 pi 16
    wrong["frequency"] = json!(100.531);
    let all = notes(folder, &wrong);
    let text = note(folder, &wrong, "strong-tone");
    let named = "a tone that the recipe does not name has an amplitude of 200 mV at 16 Hz";
    assert!(text.contains(named), "{text}");
    assert!(text.contains("at 100.531 Hz; check the frequency"), "{text}");
    assert!(text.contains("(100.531 rad/s is 16 Hz)"), "{text}");
    assert!(all.iter().all(|(code, _)| code != "wandering-level"), "{all:?}");
    wrong["frequency"] = json!(8);
    let text = note(folder, &wrong, "strong-tone");
    assert!(text.contains("the multiple 2 of a frequency"), "{text}");
    assert!(text.contains("200 mV at 16 Hz"), "{text}");
    // who asks for that multiple knows
    wrong["components"] = json!([1, 2]);
    assert_eq!(said(folder, &wrong), "");
    wrong = millivolts();
    wrong["frequency"] = json!({"value": 100.531, "unit": "rad/s"});
    refused(folder, &wrong, &["`rad/s` counts angle", "1 rad/s is 0.159155 Hz"]);
    wrong["frequency"] = json!({"values": [960], "unit": "rpm"});
    refused(folder, &wrong, &["`rpm` counts angle", "1 rpm is 0.0166667 Hz"]);
    // the seventh multiple, of which 5 are fitted
    let seventh = |i: u32| 50.0 * (2.0 * PI * 7.0 * 0.016 * f64::from(i)).cos();
    recorded(folder, "t,acc", seconds, |i, value| value + seventh(i));
    let text = note(folder, &millivolts(), "tone-in-residuals");
    assert!(text.contains("50 mV at about 112 Hz"), "{text}");
    assert!(text.contains("the multiple 7 of the frequency, and `harmonics` is 5"), "{text}");
    let mut more = millivolts();
    more["harmonics"] = json!(7);
    assert_eq!(said(folder, &more), "");
}

#[test]
fn samples_far_beyond_the_rest_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    plain(folder);
    assert_eq!(said(folder, &millivolts()), "");
    let at = |sample: u32, put: f64| move |i: u32, of: f64| if i == sample { put } else { of };
    recorded(folder, "t,acc", seconds, at(1234, 9999.0));
    let text = note(folder, &millivolts(), "far-samples");
    assert!(text.contains("`acc`: 9999 mV at 1.234 s is far beyond the rest"), "{text}");
    recorded(folder, "t,acc", seconds, |i, value| if i % 1900 == 7 { value + 20.0 } else { value });
    let text = note(folder, &millivolts(), "far-samples");
    for word in ["at 0.007 s", "at 1.907 s", "at 3.807 s", "are far beyond"] {
        assert!(text.contains(word), "{word}: {text}");
    }
}

#[test]
fn time_stamps_that_repeat_are_too_coarse() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    // milliseconds at 2048 Hz: 0, 0.488 ms
    let stamp = |i: u32| format!("{:.3}", f64::from(i) / 2048.0);
    recorded(folder, "t,acc", stamp, |_, value| value);
    refused(folder, &millivolts(), &["sample 2: the time repeats, 0 s", "leave out `time`"]);
}

#[test]
fn only_the_first_mistake_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    plain(folder);
    let mut two = millivolts();
    two["channels"] = json!({"ref": {"column": 2, "unit": "mV"},
                             "out": {"column": 2, "unit": "mV", "scale": 2}});
    two["reference"] = json!("ref");
    let text = said(folder, &two);
    assert!(text.contains("with a `scale` in `1`") && !text.contains("no channel"), "{text}");
    two["reference"] = json!("rf");
    assert!(said(folder, &two).contains("did you mean `ref`?"));
    let mut none = millivolts();
    none["recordings"] = json!([]);
    none["channels"]["acc"]["recording"] = json!("run");
    let text = said(folder, &none);
    assert!(!text.contains("no recording"), "{text}");

    fs::write(folder.join("c.csv"), "x,u_x,nu\n1,0.1,9\n2,,9\n").unwrap();
    let model = json!({
        "inputs": {"a": {"distribution": "normal", "mean": "x", "std": "2*u_x", "dof": "nu"}},
        "conditions": {"file": "c.csv"}, "equations": {"y": "a"}, "outputs": {"y": {}}
    });
    fs::write(folder.join("m.json"), model.to_string()).unwrap();
    let said = command().current_dir(folder).args(["run", "m.json"]).output().unwrap();
    let said = String::from_utf8(said.stderr).unwrap();
    assert_eq!(said.matches("m.json:").count() + said.matches("c.csv:").count(), 1, "{said}");
    assert!(!said.contains("there are none"), "{said}");
}

/// A model that reads a column of the table in another unit, or peak values where there are RMS, is
/// refused.
#[test]
fn tables_have_units_and_say_rms() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    plain(folder);
    let mut of = millivolts();
    let table = |of: &Value| {
        let said = observe(folder, of, &["--format", "csv", "--output", "data.csv", "--quiet"]);
        assert!(said.status.success());
        fs::read_to_string(folder.join("data.csv")).unwrap()
    };
    let text = table(&of);
    let head = "f [Hz],acc_amplitude [mV],u_acc_amplitude [mV],acc_phase [deg],u_acc_phase [deg],";
    assert!(text.starts_with(head), "{text}");
    assert!(text.contains(",acc_thd,u_acc_thd,acc_snr [dB],"), "{text}");
    let run = |unit: &str| {
        let model = json!({
            "inputs": {"a": {"unit": unit, "distribution": "normal",
                             "mean": "acc_amplitude", "std": "u_acc_amplitude"}},
            "conditions": {"file": "data.csv", "columns": ["acc_amplitude", "u_acc_amplitude"],
                           "units": {"acc_amplitude": unit, "u_acc_amplitude": unit}},
            "equations": {"y": "a"}, "outputs": {"y": {"unit": "V"}},
            "monte_carlo": {"trials": 0}
        });
        fs::write(folder.join("m.json"), model.to_string()).unwrap();
        let mut run = command();
        run.current_dir(folder).args(["run", "m.json", "--format", "json", "--quiet"]);
        run.output().unwrap()
    };
    let right: Value = serde_json::from_slice(&run("mV").stdout).unwrap();
    let y = right["rows"][0]["outputs"]["y"]["gum"]["estimate"].as_f64();
    assert!((y.unwrap() - 0.2).abs() < 1e-5, "{right}");
    let wrong = run("V");
    let said = String::from_utf8(wrong.stderr).unwrap();
    assert_eq!(wrong.status.code(), Some(2));
    assert!(said.contains("`acc_amplitude [mV]` says `mV`"), "{said}");
    of["amplitude"] = json!("rms");
    of["components"] = json!([1, 2]);
    let text = table(&of);
    assert!(text.contains("acc_amplitude_rms [mV]"), "{text}");
    assert!(text.contains("u_acc_amplitude_rms_2 [mV]"), "{text}");
    let said = String::from_utf8(run("mV").stderr).unwrap();
    assert!(said.contains("acc_amplitude_rms"), "{said}");
}

/// Crossings of the mean upwards lie at 0.702, 1.702, ... periods of the oscillation; 0.08 s are 81
/// samples, 1.296 periods.
#[test]
fn bins_without_a_whole_period_say_why() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    plain(folder);
    let mut bins = millivolts();
    bins["method"] = json!("fft");
    assert_eq!(said(folder, &bins), "");
    bins["recordings"]["run"]["to"] = json!(0.08);
    refused(folder, &bins, &["1.296 periods of 16 Hz, and no whole one between two crossings"]);
    bins["recordings"]["run"]["to"] = json!(0.05);
    refused(folder, &bins, &["0.816 periods of 16 Hz; one at least is needed"]);
    // 62 periods of 16 Hz are 19.4 of 5 Hz
    let mut wrong = millivolts();
    wrong["method"] = json!("fft");
    wrong["frequency"] = json!(5);
    refused(folder, &wrong, &["its crossings of the mean upwards are not whole periods of 5 Hz"]);
}
