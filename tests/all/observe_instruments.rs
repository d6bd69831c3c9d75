//! Recordings as oscilloscopes and loggers export them: what stands above and below the header, stamps of
//! a clock.

use std::f64::consts::PI;
use std::fmt::Write;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::observe::{answer, noise, observe};

/// 1.5 V at 5 Hz with a phase of 0.3 rad and an offset of 0.1 V, at 1000 Hz for 1 s.
fn volts(i: u32) -> f64 {
    0.1 + 1.5 * (2.0 * PI * 5.0 * f64::from(i) / 1000.0 + 0.3).cos() + 1e-3 * noise(i)
}

/// A file of these lines above and one for each sample.
fn written(folder: &Path, name: &str, above: &str, line: impl Fn(u32, f64) -> String) {
    let mut text = above.to_owned();
    for i in 0..1000 {
        writeln!(text, "{}", line(i, volts(i))).unwrap();
    }
    fs::write(folder.join(name), text).unwrap();
}

fn recipe(name: &str, recording: &Value, channel: &Value) -> Value {
    let mut recording = recording.clone();
    recording["file"] = json!(name);
    let mut channel = channel.clone();
    channel["unit"] = json!("V");
    json!({"recordings": {"r": recording}, "channels": {"a": channel}, "frequency": 5})
}

/// The amplitude is 1.5 V and the phase 0.3 rad, whatever stands around the samples; the codes of the notes.
fn is_found(folder: &Path, recipe: &Value) -> Vec<String> {
    let found = answer(folder, recipe);
    let text = serde_json::to_string(&found["rows"]).unwrap();
    let channel = &found["rows"][0]["channels"]["a"];
    let component = &channel["components"][0];
    let value = |key: &str| component[key]["value"].as_f64().unwrap_or_else(|| panic!("{text}"));
    assert!((value("amplitude") - 1.5).abs() < 1e-3, "{text}");
    assert!((value("phase") - 0.3_f64.to_degrees()).abs() < 0.05, "{text}");
    let notes = found["warnings"].as_array().unwrap().iter();
    notes.map(|note| note["code"].as_str().unwrap().to_owned()).collect()
}

fn refusal(folder: &Path, recipe: &Value) -> String {
    let found = observe(folder, recipe, &[]);
    let said = String::from_utf8(found.stderr).unwrap();
    assert_eq!(found.status.code(), Some(2), "{said}");
    said
}

fn seconds(i: u32) -> f64 {
    f64::from(i) / 1000.0
}

#[test]
fn lines_above_the_header_are_passed_by_and_told() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let tektronix = "Model,MSO44\nFirmware Version,1.28\n\nSample Interval,1.0e-3\nRecord Length,1000,\n\
                     Vertical Units,V\nLabel,,\nTIME,CH1\n";
    written(folder, "tek.csv", tektronix, |i, v| format!("{:.6},{v:.6}", seconds(i)));
    let lvm = "LabVIEW Measurement\t\nSeparator\tTab\nDecimal_Separator\t,\n***End_of_Header***\t\n\t\n\
               Channels\t1\nSamples\t1000\nY_Unit_Label\tVolts\nDelta_X\t0,001\n***End_of_Header***\n\
               X_Value\tVoltage\tComment\n";
    let commas = |i: u32, v: f64| format!("{:.6}\t{v:.6}", seconds(i)).replace('.', ",");
    written(folder, "run.lvm", lvm, commas);
    let lecroy = "LECROYWS3024,1,Waveform\nSegments,1,SegmentSize,1000\n\
                  Segment,TrigTime,TimeSinceSegment1\n#1,01-Jan-2026 12:00:00,0\nTime,Ampl\n";
    written(folder, "lecroy.csv", lecroy, |i, v| format!("{:.6},{v:.6}", seconds(i)));
    for (file, name, time) in [
        ("tek.csv", "CH1", "TIME"),
        ("run.lvm", "Voltage", "X_Value"),
        ("lecroy.csv", "Ampl", "Time"),
    ] {
        for (column, time) in [(json!(name), json!(time)), (json!(2), json!(1))] {
            let recipe = recipe(file, &json!({"time": time}), &json!({"column": column}));
            assert_eq!(is_found(folder, &recipe), ["preamble"], "{file}");
        }
    }
    // a unit of the preamble that is not the channel's
    written(folder, "milli.lvm", &lvm.replace("Volts", "mV"), commas);
    let of = recipe("milli.lvm", &json!({"time": 1}), &json!({"column": 2}));
    assert!(refusal(folder, &of).contains("`Voltage [mV]` says `mV`"));
    // samples beside the preamble belong to the record
    let beside = |i: u32, v: f64| match i {
        0 => format!("Record Length,1000,,{:.6},{v:.6}", seconds(i)),
        1 => format!("Source,CH1,,{:.6},{v:.6}", seconds(i)),
        _ => format!(",,,{:.6},{v:.6}", seconds(i)),
    };
    written(folder, "tds.csv", "", beside);
    let of = recipe("tds.csv", &json!({"time": 4}), &json!({"column": 5}));
    assert!(is_found(folder, &of).is_empty());
}

#[test]
fn a_line_of_units_belongs_to_the_headings() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let plain = |i: u32, v: f64| format!("{:.6},{v:.6}", seconds(i));
    written(folder, "keysight.csv", "x-axis,1\nsecond,Volt\n", plain);
    let of = recipe("keysight.csv", &json!({"time": 1}), &json!({"column": 2}));
    assert!(is_found(folder, &of).is_empty());
    let pico = |i: u32, v: f64| format!("{i},{:.4}", v * 1e3);
    written(folder, "pico.csv", "Time,Channel A\n(ms),(mV)\n\n", pico);
    let of = |time: &Value, channel: &Value| recipe("pico.csv", time, channel);
    let (time, channel) = (json!({"time": "Time"}), json!({"column": "Channel A"}));
    assert!(refusal(folder, &of(&time, &channel)).contains("this is `\"raw_unit\": \"mV\"`"));
    let channel = json!({"column": "Channel A", "raw_unit": "mV"});
    assert!(refusal(folder, &of(&time, &channel)).contains("this is `\"time_unit\": \"ms\"`"));
    let time = json!({"time": "Time", "time_unit": "ms"});
    assert!(is_found(folder, &of(&time, &channel)).is_empty());
    // a count of samples is no time
    let above = "X,CH1,Start,Increment,\nSequence,Volt,0.000000e+00,1.000000e-03\n";
    written(folder, "rigol.csv", above, |i, v| format!("{i},{v:.6},,"));
    let of = recipe("rigol.csv", &json!({"time": "X"}), &json!({"column": "CH1"}));
    assert!(refusal(folder, &of).contains("counts samples"));
    let of = recipe("rigol.csv", &json!({"sampling_rate": 1000}), &json!({"column": "CH1"}));
    assert!(is_found(folder, &of).is_empty());
}

#[test]
fn stamps_of_a_clock_are_instants() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let of = recipe("clock.csv", &json!({"time": 1}), &json!({"column": 2}));
    for begin in [
        "12:00:00",
        "23:59:59",
        "2026-03-02T12:00:00",
        "2026-12-31 23:59:59",
        "31.12.2026 23:59:59",
    ] {
        // the second half of the record is in the next second
        let next = match begin {
            "12:00:00" => "12:00:01",
            "23:59:59" => "00:00:00",
            "2026-03-02T12:00:00" => "2026-03-02T12:00:01",
            "2026-12-31 23:59:59" => "2027-01-01 00:00:00",
            _ => "01.01.2027 00:00:00",
        };
        written(folder, "clock.csv", "Time [hh:mm:ss.ms],U [V]\n", |i, v| {
            let (second, i) = if i < 500 { (begin, i + 500) } else { (next, i - 500) };
            format!("{second}.{i:03},{v:.6}")
        });
        assert!(is_found(folder, &of).is_empty(), "{begin}");
    }
    written(folder, "clock.csv", "Time,U [V]\n", |i, v| format!("12:00:{:02},{v:.6}", i / 100));
    assert!(refusal(folder, &of).contains("the time repeats"));
}
