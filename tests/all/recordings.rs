//! The benches of `models/recordings/`: their recordings are what their program makes, and the
//! commands of `docs/recordings.md` find what it put in.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::support::{command, root};

#[path = "../../examples/recordings.rs"]
pub(crate) mod program;

use program::truth;

const BENCHES: [&str; 4] = ["iepe_chain", "rotating_table", "shock", "spurious_components"];

/// The same bytes, but for one step where the sine of another platform rounds to another one.
#[test]
fn the_recordings_are_what_the_program_makes() {
    let mut size = 0;
    for (name, made) in program::recordings().expect("the recordings") {
        let committed = fs::read(root().join("models/recordings").join(&name)).expect("committed");
        size += committed.len();
        assert_eq!(made.len(), committed.len(), "{name}");
        // the header of a WAV of whole numbers
        assert_eq!(made[..44], committed[..44], "{name}");
        let values = |bytes: &[u8]| -> Vec<i32> {
            bytes[44..].chunks(2).map(|two| i16::from_le_bytes([two[0], two[1]]).into()).collect()
        };
        let steps = values(&made).iter().zip(values(&committed)).map(|(a, b)| (a - b).abs()).max();
        assert!(steps.is_some_and(|steps| steps <= 1), "{name}: {steps:?}");
    }
    assert!(size < 1_500_000, "{size}");
}

/// The commands of the page, in order.
fn documented() -> Vec<Vec<String>> {
    let page = fs::read_to_string(root().join("docs/recordings.md")).expect("the page");
    let shell = page.split("```").skip(1).step_by(2).filter_map(|block| block.strip_prefix("sh\n"));
    let words = |line: &str| line.split_whitespace().skip(1).map(str::to_owned).collect();
    shell.flat_map(str::lines).map(words).collect()
}

fn json(folder: &Path, arguments: &[&str]) -> Value {
    let mut command = command();
    command.current_dir(folder).args(arguments).args(["--format", "json", "--quiet"]);
    let said = command.output().expect("it runs");
    assert!(said.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&said.stderr));
    serde_json::from_slice(&said.stdout).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Within three standard uncertainties of the truth; the draws of the recordings are fixed. The
/// least u of all is what rounding leaves.
fn near(what: &str, value: &Value, u: &Value, truth: f64) {
    let (value, u) = (number(value), number(u));
    assert!(u > 0.0 && (value - truth).abs() < 3.0 * u, "{what}: {value}, u {u}, for {truth}");
}

fn near_observed(what: &str, observed: &Value, truth: f64) {
    near(what, &observed["value"], &observed["standard_uncertainty"], truth);
}

/// Runs every command of the page in a copy of the folder, and compares each result with what the
/// recordings were made with.
#[test]
#[ignore = "heavy: run by .ci/extra"]
fn documented_commands_find_what_was_put_in() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    for bench in BENCHES {
        let bench = Path::new("models/recordings").join(bench);
        fs::create_dir_all(folder.join(&bench)).expect("made");
        for entry in fs::read_dir(root().join(&bench)).expect("the bench") {
            let entry = entry.expect("an entry");
            // observations are to come from the commands
            if entry.file_name() != "observations.csv" {
                fs::copy(entry.path(), folder.join(&bench).join(entry.file_name()))
                    .expect("copied");
            }
        }
    }
    let commands = documented();
    assert_eq!(commands.len(), 12);
    for arguments in &commands {
        let said = command().current_dir(folder).args(arguments).output().expect("it runs");
        let error = String::from_utf8_lossy(&said.stderr);
        assert!(said.status.success(), "{arguments:?}: {error}");
        assert!(!said.stdout.is_empty() || arguments.iter().any(|word| word == "--output"));
    }
    // the committed observations are those of the commands; the last digits of another platform's
    // arithmetic are left out
    // a waveform has no observations
    for bench in BENCHES.into_iter().filter(|bench| *bench != "shock") {
        let name = format!("models/recordings/{bench}/observations.csv");
        let read = |folder: &Path| fs::read_to_string(folder.join(&name)).expect("observations");
        let (made, committed) = (read(folder), read(root()));
        assert_eq!(made.lines().next(), committed.lines().next(), "{name}");
        let cells = |text: &str| -> Vec<f64> {
            text.lines().skip(1).flat_map(|l| l.split(',').map(|c| c.parse().unwrap())).collect()
        };
        let (made, committed) = (cells(&made), cells(&committed));
        assert_eq!(made.len(), committed.len());
        let same = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-6 * b.abs() + 1e-9;
        assert!(made.iter().zip(&committed).all(same), "{name}");
    }
    rotating_table(folder);
    iepe_chain(folder);
    spurious_components(folder);
}

/// Quick, so that it runs with every test: the shock, its accelerometer, and their ratio.
#[test]
fn a_shock_is_corrected() {
    let run = json(root(), &["run", "models/recordings/shock/sensor.json", "--trials", "0"]);
    let [sensitivity, resonance, damping, delay] = truth::PIEZO;
    let parameters = [
        ("S0", sensitivity),
        ("f0", 1e-3 * resonance),
        ("damping", damping),
        ("delay", 1e6 * delay),
    ];
    for (name, truth) in parameters {
        let gum = &run["outputs"][name]["gum"];
        near(name, &gum["estimate"], &gum["standard_uncertainty"], truth);
    }
    let observed = json(root(), &["observe", "models/recordings/shock/recipe.json"]);
    let waveforms = &observed["rows"][0]["waveforms"];
    let [peak, width] = truth::SHOCK;
    near_observed("reference", &waveforms["reference"]["quantities"]["maximum"], peak);
    let quantities = &waveforms["a"]["quantities"];
    near_observed("maximum", &quantities["maximum"], peak);
    near_observed("time", &quantities["maximum_time"], 1e-3 + 0.5 * width);
    near_observed("ratio", &quantities["ratio"], 1.0);
    near_observed("velocity", &quantities["velocity_change"], 0.5 * peak * width);
    // of a squared sine: twice the arc cosine of the root of a tenth, of the half width
    let lasts = width * 2.0 / std::f64::consts::PI * 0.1f64.sqrt().acos();
    near_observed("duration", &quantities["duration"], lasts);
    // what rings after the shock is taken off
    let values = waveforms["a"]["values"].as_array().expect("values");
    assert_eq!(values.len(), 2000);
    let last = number(values.last().expect("a value"));
    assert!(last.abs() < 0.01 * peak, "{last}");
}

fn rotating_table(folder: &Path) {
    let observed = json(folder, &["observe", "models/recordings/rotating_table/recipe.json"]);
    let run = json(folder, &["run", "models/recordings/rotating_table/sensitivity.json"]);
    let against = ["models/recordings/rotating_table/linear_bench.csv", "--against", "run.json"];
    let compared = json(folder, &["compare", against[0], against[1], against[2]]);
    for (row, (hertz, angle)) in truth::OSCILLATIONS.into_iter().enumerate() {
        let channels = &observed["rows"][row]["channels"];
        let component = |channel: &str, number: usize| &channels[channel]["components"][number];
        let amplitude = truth::ENCODER * angle / 2.0;
        near_observed("angle", &component("theta", 0)["amplitude"], amplitude);
        // the file says 1660 Hz
        let rate = &channels["d_t"]["sampling_rate"];
        near_observed("rate", rate, truth::RATE);
        assert!((number(&rate["value"]) - truth::RATE).abs() < 0.05, "{rate}");
        // r theta_0 (2 pi f)^2 at f and r (theta_0 2 pi f)^2 / 2 at 2 f
        let speed = angle.to_radians() / 2.0 * std::f64::consts::TAU * hertz;
        let a_t = truth::RADIUS * speed * std::f64::consts::TAU * hertz;
        let a_r = truth::RADIUS * speed * speed / 2.0;
        let [s_t, s_r] = truth::SENSITIVITY;
        near_observed("tangential", &component("d_t", 0)["amplitude"], s_t * a_t);
        near_observed("radial", &component("d_r", 1)["amplitude"], s_r * a_r);
        // by the nominal radius, through the encoder's own error; the radius's share of u is most of it
        let reading = truth::ENCODER;
        near_observed("a_t", &component("a_t", 0)["amplitude"], a_t * reading);
        near_observed("a_r", &component("a_r", 1)["amplitude"], a_r * reading * reading);
        for (name, truth) in [("S_t", s_t), ("S_r", s_r), ("a_t", a_t), ("a_r", a_r)] {
            let gum = &run["rows"][row]["outputs"][name]["gum"];
            near(name, &gum["estimate"], &gum["standard_uncertainty"], truth);
        }
        // the recording's share of the sensitivity is that of its u
        let gum = &run["rows"][row]["outputs"]["S_t"]["gum"];
        let budget = gum["budget"].as_array().expect("a budget");
        let of = budget.iter().find(|row| row["input"] == "d_t").expect("the output");
        let u = &component("d_t", 0)["amplitude"]["standard_uncertainty"];
        assert!((number(&of["standard_uncertainty"]) / number(u) - 1.0).abs() < 1e-12);
        // En from the two results
        for (position, x1, u1, name) in [(row, 420.0, 7.0, "S_t"), (row + 3, 418.0, 9.0, "S_r")] {
            let gum = &run["rows"][row]["outputs"][name]["gum"];
            let u2 = 2.0 * number(&gum["standard_uncertainty"]);
            let en = (x1 - number(&gum["estimate"])).abs() / f64::hypot(u1, u2);
            assert!((number(&compared["rows"][position]["en"]) - en).abs() < 1e-9, "{name}");
            assert_eq!(compared["rows"][position]["compatible"], true);
        }
    }
}

fn iepe_chain(folder: &Path) {
    let observed = json(folder, &["observe", "models/recordings/iepe_chain/recipe.json"]);
    let (mut ratios, mut leads) = (0.0, 0.0);
    for (row, hertz) in truth::SLIDE.into_iter().enumerate() {
        let channels = &observed["rows"][row]["channels"];
        let component = |channel: &str| &channels[channel]["components"][0];
        let (mut gain, mut lead) = (1.0, 0.0);
        for cut_off in truth::HIGH_PASS {
            gain /= (cut_off / hertz).hypot(1.0);
            lead += (cut_off / hertz).atan().to_degrees();
        }
        let acceleration = (0.5 * hertz).min(2.0);
        near_observed("acceleration", &component("acc")["amplitude"], gain * acceleration);
        // the run's own error is in the reference: 0.3 % and 0.3 deg about those of the vibrometer
        ratios += number(&component("a_ref")["amplitude"]["value"]) / acceleration / 12.0;
        leads += (number(&component("acc")["phase"]["value"]) - lead) / 12.0;
    }
    // means of twelve; three standard deviations of them
    let (gain, phase) = truth::VIBROMETER;
    assert!((ratios - gain).abs() < 3.0 * 0.003 / 12f64.sqrt(), "{ratios}");
    assert!((leads + phase).abs() < 3.0 * 0.3 / 12f64.sqrt(), "{leads}");

    let found = json(folder, &["gap", "models/recordings/iepe_chain/case.json"]);
    let verdict = &found["verdict"];
    assert_eq!(verdict["effects"], serde_json::json!(["high-pass-cascade"]), "{verdict}");
    let of = found["hypotheses"].as_array().expect("hypotheses").iter();
    let best = of.clone().find(|of| of["effects"] == verdict["effects"]).expect("the verdict");
    assert!(number(&best["probability"]) > 0.5, "{verdict}");
    for (name, cut_off) in ["fc1", "fc2"].into_iter().zip(truth::HIGH_PASS) {
        let parameter = &best["parameters"][format!("high-pass-cascade/{name}")];
        near(name, &parameter["estimate"], &parameter["standard_uncertainty"], cut_off);
    }
}

fn spurious_components(folder: &Path) {
    let observed = json(folder, &["observe", "models/recordings/spurious_components/recipe.json"]);
    let channels = &observed["rows"][0]["channels"];
    let component = |channel: &str| &channels[channel]["components"][0];
    near_observed("reference", &component("a_ref")["amplitude"], truth::REFERENCE);
    for (channel, (amplitude, phase)) in ["x", "y"].into_iter().zip(truth::SPURIOUS) {
        near_observed(channel, &component(channel)["amplitude"], amplitude);
        near_observed(channel, &component(channel)["phase"], phase);
    }
    let run = json(folder, &["run", "models/recordings/spurious_components/plane.json"]);
    let certificate = "models/recordings/spurious_components/certificate.json";
    let stated = json(folder, &["certificate", certificate]);
    for (index, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let seen = program::on_the_plane()[index];
        let gum = &run["rows"][0]["outputs"][format!("a_{axis}")]["gum"];
        near(axis, &gum["estimate"], &gum["standard_uncertainty"], seen.modulus());
        // U is at least 1.9 u, so 1.5 U is about 3 u
        let row = &stated["rows"][index];
        let (value, expanded) = (number(&row["value"]), number(&row["expanded_uncertainty"]));
        assert!((value - truth::AXES[index]).abs() < 1.5 * expanded, "{axis}: {row}");
        assert_eq!(row["unit"], "D/(m/s^2)");
    }
    // the budget has what the recording says of the amplitude along z' less the reference: it is
    // 0.1 m/s^2 at 5 deg
    let gum = &run["rows"][0]["outputs"]["a_z"]["gum"];
    assert!(gum["budget"].to_string().contains("a_z_syst/recording"), "{gum}");
}

/// What is not so shows: without its filters no cascade would be found, so the case is run once
/// against an ideal chain.
#[test]
fn an_ideal_chain_has_no_gap() {
    let folder = tempfile::tempdir().expect("a folder");
    let case = root().join("models/recordings/iepe_chain/case.json");
    fs::copy(case, folder.path().join("case.json")).expect("copied");
    let mut table =
        "f,a_ref_amplitude,acc_amplitude,u_acc_amplitude,acc_phase,u_acc_phase\n".to_owned();
    for hertz in truth::SLIDE {
        table += &format!("{hertz},0.5,0.501,0.0002,0.1,0.02\n");
    }
    fs::write(folder.path().join("observations.csv"), table).expect("written");
    let found = json(folder.path(), &["gap", "case.json"]);
    assert_eq!(found["verdict"]["effects"], serde_json::json!([]), "{}", found["verdict"]);
    let none = &found["hypotheses"].as_array().expect("hypotheses")[0];
    assert_eq!(none["effects"], serde_json::json!([]), "{none}");
}
