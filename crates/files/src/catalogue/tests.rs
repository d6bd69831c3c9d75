//! Every effect of the catalogue is read, fits its bench, and computes what its physics says.

use std::collections::BTreeSet;

use super::super::effect_context::EffectContext;
use super::super::{CaseFile, FileReader};
use super::{ANY_BENCH, Catalogue, TEXT, catalogue, fit};
use gumption_engine::fact;
use gumption_engine::model::formula::is_name;
use gumption_engine::task::Warning;
use gumption_gap::{History, HistoryKind};
use gumption_report::words::{Language, sentence};
use gumption_text::DiagnosticKind;

/// A sim of a bench: its file without the last brace, and two rows of data.
struct Bench {
    name: &'static str,
    file: &'static str,
    data: &'static str,
}

const PLANE: Bench = Bench {
    name: "inclined plane",
    file: r#"{"inputs": {
        "a_ref": {"unit": "m/s^2", "distribution": "normal", "mean": 10, "std": 0.01},
        "tilt_error": {"unit": "deg", "distribution": "rectangular", "mean": 0, "half_width": 0.1},
        "rotation_error": {"unit": "deg", "distribution": "rectangular", "mean": 0, "half_width": 0.1}},
      "conditions": {"f": {"unit": "Hz"}, "tilt": {"unit": "deg"}, "rotation": {"unit": "deg"}},
      "equations": {"alpha": "tilt + tilt_error", "omega": "rotation + rotation_error",
        "a_vertical": "a_ref", "a_x": "abs(a_vertical*sin(alpha)*cos(omega))",
        "a_y": "abs(a_vertical*sin(alpha)*sin(omega))", "a_z": "abs(a_vertical*cos(alpha))"},
      "outputs": {"a_x": {"unit": "m/s^2"}, "a_y": {"unit": "m/s^2"}, "a_z": {"unit": "m/s^2"}},
      "observations": {"file": "data.csv", "columns": {"a_x": {"value": "x"}, "a_y": {"value": "y"},
        "a_z": {"value": "z"}}}"#,
    data: "f,tilt,rotation,x,y,z\n5,35,30,5,3,8\n3000,35,120,3,5,8\n",
};

const PLANE_TYPED: Bench = Bench {
    name: "inclined plane",
    file: r#"{"model": "inclined-plane", "inputs": {
        "a_ref": {"unit": "m/s^2", "distribution": "normal", "mean": 10, "std": 0.01},
        "tilt": {"unit": "deg", "distribution": "rectangular", "mean": "tilt_set", "half_width": 0.1},
        "rotation": {"unit": "deg", "distribution": "rectangular", "mean": "turn", "half_width": 0.1}},
      "conditions": {"frequency": {"unit": "Hz"}, "tilt_set": {"unit": "deg"}, "turn": {"unit": "deg"}},
      "outputs": {"a_x": {"unit": "m/s^2"}, "a_y": {"unit": "m/s^2"}, "a_z": {"unit": "m/s^2"}},
      "observations": {"file": "data.csv", "columns": {"a_x": {"value": "x"}, "a_y": {"value": "y"},
        "a_z": {"value": "z"}}}"#,
    data: "frequency,tilt_set,turn,x,y,z\n5,35,30,5,3,8\n3000,35,120,3,5,8\n",
};

const TABLE: Bench = Bench {
    name: "oscillating table",
    file: r#"{"inputs": {
        "radius_error": {"unit": "mm", "distribution": "rectangular", "mean": 0, "half_width": 0.05},
        "encoder_gain": {"unit": "", "distribution": "normal", "mean": 1, "std": 0.001}},
      "conditions": {"f": {"unit": "Hz"}, "theta_0": {"unit": "deg"}, "radius": {"unit": "mm"}},
      "equations": {"r": "radius + radius_error", "omega_0": "2*pi*f*theta_0*encoder_gain",
        "a_t": "2*pi*f*r*omega_0", "a_r": "r*omega_0^2/2"},
      "outputs": {"a_t": {"unit": "m/s^2"}, "a_r": {"unit": "m/s^2"}},
      "observations": {"file": "data.csv", "columns": {"a_t": {"value": "t"}, "a_r": {"value": "c"}}}"#,
    data: "f,theta_0,radius,t,c\n5,17,170,49,7\n10,4.25,145,50,2\n",
};

const TABLE_TYPED: Bench = Bench {
    name: "oscillating table",
    file: r#"{"model": "rotating-table", "inputs": {
        "radius": {"unit": "mm", "distribution": "rectangular", "mean": 170, "half_width": 0.1},
        "angle_pp": {"unit": "deg", "distribution": "constant", "value": "angle"}},
      "conditions": {"frequency": {"unit": "Hz"}, "angle": {"unit": "deg"}},
      "outputs": {"a_t": {"unit": "m/s^2"}, "a_r_2f": {"unit": "m/s^2"},
        "a_r_mean": {"unit": "m/s^2"}, "a_r_peak": {"unit": "m/s^2"}},
      "observations": {"file": "data.csv", "columns": {"a_t": {"value": "t"},
        "a_r_peak": {"value": "c"}}}"#,
    data: "frequency,angle,t,c\n5,34,49,14\n10,8.5,50,4\n",
};

const TABLE_CORRECTED: Bench = Bench {
    name: "oscillating table",
    file: r#"{"model": "rotating-table", "inputs": {
        "radius": {"unit": "mm", "distribution": "rectangular", "mean": 170, "half_width": 0.1},
        "angle_correction": {"unit": "%", "distribution": "normal", "mean": 0, "std": 0.1}},
      "conditions": {"frequency": {"unit": "Hz"}, "angle_pp": {"unit": "deg"}},
      "outputs": {"a_t": {"unit": "m/s^2"}, "a_r_2f": {"unit": "m/s^2"}},
      "observations": {"file": "data.csv", "columns": {"a_t": {"value": "t"},
        "a_r_2f": {"value": "c"}}}"#,
    data: "frequency,angle_pp,t,c\n5,34,49,14\n10,8.5,50,4\n",
};

const CHAIN: Bench = Bench {
    name: "measuring chain",
    file: r#"{"inputs": {"ldv_gain": {"distribution": "normal", "mean": 1, "std": 0.003}},
      "conditions": {"f": {"unit": "Hz"}},
      "equations": {"s": "1.0*ldv_gain", "phi": "0*f"},
      "outputs": {"s": {"unit": ""}, "phi": {"unit": "deg"}},
      "observations": {"file": "data.csv", "columns": {"s": {"value": "m"}, "phi": {"value": "p"}}}"#,
    data: "f,m,p\n0.5,1,0.1\n20,1,0.2\n",
};

const CHAIN_TYPED: Bench = Bench {
    name: "measuring chain",
    file: r#"{"model": "measuring-chain",
      "inputs": {"high_pass_1": {"unit": "Hz", "distribution": "rectangular", "lower": 0.09, "upper": 0.11}},
      "conditions": {"frequency": {"unit": "Hz"}},
      "outputs": {"gain": {"unit": "1"}, "phase": {"unit": "deg"}, "delay": {"unit": "s"}},
      "observations": {"file": "data.csv", "columns": {"gain": {"value": "m"}, "phase": {"value": "p"},
        "delay": {"value": "d"}}}"#,
    data: "frequency,m,p,d\n0.5,1,0.1,0.01\n20,1,0.2,0.01\n",
};

const GIMBAL: Bench = Bench {
    name: "gravity rotation",
    file: r#"{"inputs": {
        "g": {"unit": "m/s^2", "distribution": "normal", "mean": 9.8, "std": 0.0001},
        "zero": {"unit": "deg", "distribution": "rectangular", "mean": 0, "half_width": 0.01}},
      "conditions": {"theta": {"unit": "deg"}, "phi": {"unit": "deg"}},
      "equations": {"outer": "theta + zero", "inner": "phi + 0*zero", "a_x": "g*sin(outer)*sin(inner)",
        "a_y": "g*sin(outer)*cos(inner)", "a_z": "g*cos(outer)"},
      "outputs": {"a_x": {"unit": "m/s^2"}, "a_y": {"unit": "m/s^2"}, "a_z": {"unit": "m/s^2"}},
      "observations": {"file": "data.csv", "columns": {"a_x": {"value": "x"}, "a_y": {"value": "y"},
        "a_z": {"value": "z"}}}"#,
    data: "theta,phi,x,y,z\n35,30,3,5,8\n90,120,8,-5,0\n",
};

const SIGNAL: Bench = Bench {
    name: "signal over time",
    file: r#"{"inputs": {"f": {"unit": "Hz", "distribution": "constant", "value": 0.5}},
      "conditions": {"t": {"unit": "s"}, "velocity": {"unit": "m/s"}},
      "outputs": {"acc": {"unit": "m/s^2"}},
      "observations": {"file": "data.csv", "columns": {"acc": {"value": "x", "sim": "reference"}}}"#,
    data: "t,velocity,reference,x\n0,-0.05,0,0\n0.5,0,0.25,0.2\n",
};

const OTHER: Bench = Bench {
    name: ANY_BENCH,
    file: r#"{"inputs": {"c": {"unit": "V", "distribution": "normal", "mean": 2, "std": 0.01}},
      "conditions": {"frequency": {"unit": "kHz"}},
      "equations": {"u": "c", "w": "2*c", "psi": "0*frequency"},
      "outputs": {"u": {"unit": "mV"}, "w": {"unit": "V"}, "psi": {"unit": "deg"}},
      "observations": {"file": "data.csv", "columns": {"u": {"value": "a"}, "w": {"value": "b"},
        "psi": {"value": "p"}}}"#,
    data: "frequency,a,b,p\n0.1,2000,4,0.1\n10,2000,-4.5,0.2\n",
};

/// Loads up and down, each read twice.
const LOOP: Bench = Bench {
    name: ANY_BENCH,
    file: r#"{"inputs": {"c": {"distribution": "normal", "mean": 2, "std": 0.01}},
      "conditions": {"m": {"unit": "kg"}},
      "equations": {"y": "c*m/[kg]"},
      "outputs": {"y": {"unit": "1"}},
      "observations": {"file": "data.csv", "columns": {"y": {"value": "y"}}}"#,
    data: "m,y\n1,2\n1,2.1\n3,6.2\n3,6\n5,9.9\n5,10\n3,6.1\n3,6.2\n1,2\n1,1.9\n\
           3,6.1\n3,6.2\n5,10.1\n5,9.8\n3,6.1\n3,6\n1,2\n1,2.2\n",
};

/// A sensor with a digital output in a climate chamber, at two sampling rates.
const DIGITAL: Bench = Bench {
    name: ANY_BENCH,
    file: r#"{"inputs": {"c": {"unit": "V", "distribution": "normal", "mean": 2, "std": 0.01}},
      "conditions": {"f": {"unit": "Hz"}, "sampling_rate": {"unit": "Hz"}, "temp": {"unit": "degC"}},
      "equations": {"u": "c", "psi": "0*f"},
      "outputs": {"u": {"unit": "mV"}, "psi": {"unit": "deg"}},
      "observations": {"file": "data.csv", "columns": {"u": {"value": "a"}, "psi": {"value": "p"}}}"#,
    data: "f,sampling_rate,temp,a,p\n10,1600,23,2000,0.1\n200,3200,40,2000,0.2\n",
};

const DIGITAL_CHAIN: Bench = Bench {
    name: "measuring chain",
    file: r#"{"model": "measuring-chain",
      "inputs": {"high_pass_1": {"unit": "Hz", "distribution": "rectangular", "lower": 0.09, "upper": 0.11}},
      "conditions": {"frequency": {"unit": "Hz"}, "fs": {"unit": "Hz"}},
      "outputs": {"gain": {"unit": "1"}, "phase": {"unit": "deg"}, "delay": {"unit": "s"}},
      "observations": {"file": "data.csv", "columns": {"gain": {"value": "m"}, "phase": {"value": "p"},
        "delay": {"value": "d"}}}"#,
    data: "frequency,fs,m,p,d\n0.5,1600,1,0.1,0.01\n20,3200,1,0.2,0.01\n",
};

const BENCHES: [Bench; 13] = [
    PLANE,
    PLANE_TYPED,
    TABLE,
    TABLE_TYPED,
    TABLE_CORRECTED,
    CHAIN,
    CHAIN_TYPED,
    GIMBAL,
    SIGNAL,
    OTHER,
    LOOP,
    DIGITAL,
    DIGITAL_CHAIN,
];

impl Bench {
    fn read(&self, effects: &[&str]) -> Result<CaseFile, Vec<DiagnosticKind>> {
        let names: Vec<String> = effects.iter().map(|name| format!("{name:?}")).collect();
        self.read_catalogue(&format!("[{}]", names.join(", ")))
    }

    fn read_catalogue(&self, catalogue: &str) -> Result<CaseFile, Vec<DiagnosticKind>> {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("data.csv"), self.data).unwrap();
        let text = format!("{}, \"catalogue\": {catalogue}}}", self.file);
        let read = FileReader::default().case_text("case.json", &text, folder.path());
        read.map_err(|diagnostics| {
            diagnostics.0.into_iter().map(|diagnostic| diagnostic.kind).collect()
        })
    }
}

#[test]
fn nothing_of_the_file_is_left_out() {
    let file: serde_json::Value = serde_json::from_str(TEXT).unwrap();
    let shipped = Catalogue::shipped();
    assert_eq!(shipped.entries.len(), file["effects"].as_array().unwrap().len());
    assert_eq!(shipped.names.len(), file["names"].as_object().unwrap().len());
    for effect in catalogue().effects {
        let place = format!("{} ({})", effect.name, effect.bench);
        assert!(!effect.about.is_empty() && !effect.source.is_empty(), "{place}");
        assert!(!effect.parameters.is_empty() && !effect.overrides.is_empty(), "{place}");
        assert!(BENCHES.iter().any(|bench| bench.name == effect.bench), "{place}");
    }
    // entries of a bench come before those of any
    for (number, entry) in shipped.entries.iter().enumerate() {
        let known = ["parameters", "overrides", "about", "source"];
        assert!(entry.members.iter().all(|m| known.contains(&m.key.as_str())), "{}", entry.name);
        let later = || shipped.entries.iter().skip(number);
        let special = |other: &super::Entry| other.bench != ANY_BENCH;
        assert!(special(entry) || !later().any(|o| o.name == entry.name && special(o)));
    }
    for (name, alternatives) in &shipped.names {
        assert_eq!(alternatives.first(), Some(name));
        assert!(alternatives.iter().all(|name| is_name(name)));
        // a parameter would hide the quantity
        for effect in catalogue().effects {
            for parameter in &effect.parameters {
                let place = format!("{} in {}", parameter.name, effect.name);
                let reads = effect.overrides.iter().any(|(_, formula)| {
                    let formula = gumption_engine::model::formula::Formula::parse(formula);
                    formula.is_ok_and(|f| f.names().any(|(used, _)| used == name))
                });
                assert!(!reads || !alternatives.contains(&parameter.name), "{place}");
            }
        }
    }
}

#[test]
fn every_effect_fits_its_bench_without_a_warning() {
    let shipped = Catalogue::shipped();
    let mut taken = BTreeSet::new();
    for bench in &BENCHES {
        let plain = bench.read(&[]).unwrap();
        let case = &plain.case;
        let history: Vec<_> = (case.measured()..).zip(case.history.iter().copied()).collect();
        let is_order = |of: &&(usize, History)| of.1.kind == HistoryKind::Order;
        let read = EffectContext {
            sim: &case.model,
            task: &case.task,
            observed: &case.observed,
            history: &history,
            clock: history.iter().find(is_order).map(|(place, _)| *place),
        };
        let here = Catalogue::shipped().with_history(&read);
        for entry in &here.entries {
            if entry.bench != bench.name && entry.bench != ANY_BENCH {
                continue;
            }
            let Ok(chosen) = super::chosen(&here, &entry.name, &read) else { continue };
            taken.insert(chosen.key_span.start);
            let file = bench.read(&[&entry.name]).unwrap_or_else(|kinds| {
                panic!("{} on {}: {kinds:?}", entry.name, bench.name);
            });
            // an input of the bench that is there for other effects
            let of_effect = |note: &&Warning| note.code() != "unused-input";
            let said: Vec<&Warning> = file.warnings.iter().filter(of_effect).collect();
            assert!(said.is_empty(), "{}: {said:?}", entry.name);
            assert_eq!(file.case.candidates[0].effect.name, entry.name);
        }
    }
    for entry in &shipped.entries {
        let place = entry.members[0].key_span.start;
        assert!(taken.contains(&place), "{} ({}) fits no bench", entry.name, entry.bench);
    }
}

/// The effects that the inclined plane, the table and the chain have in both their forms.
#[test]
fn typed_models_take_the_same_effects_as_formulas() {
    let names = |bench: &str| -> Vec<String> {
        let of_bench = catalogue().effects.into_iter().filter(|effect| effect.bench == bench);
        let names: BTreeSet<String> = of_bench.map(|effect| effect.name).collect();
        names.into_iter().collect()
    };
    for (formulas, typed) in [(PLANE, PLANE_TYPED), (TABLE, TABLE_TYPED), (CHAIN, CHAIN_TYPED)] {
        for name in names(formulas.name) {
            for bench in [&formulas, &typed] {
                assert!(bench.read(&[&name]).is_ok(), "{name} on {}", bench.name);
            }
        }
    }
}

/// Outputs at conditions with one effect at the given parameters, each in its unit.
fn with(bench: &Bench, effect: &str, parameters: &[f64], conditions: &[f64]) -> Vec<f64> {
    let file = bench.read(&[effect]).unwrap();
    let case = &file.case;
    let effect = &case.candidates[0].effect;
    assert_eq!(effect.parameters.len(), parameters.len());
    let program = case.model.program(&[effect]).unwrap();
    let inputs = case.task.rows[0].distributions.iter().map(|distribution| distribution.mean());
    let all: Vec<f64> =
        inputs.chain(conditions.iter().copied()).chain(parameters.iter().copied()).collect();
    program.evaluate(&all)
}

/// Expected values with 40 digits from complex vectors that are rotated by matrices, from complex
/// responses, and for the sampling rate from the mean of a rotating phasor: none of them in the form
/// of the catalogue's formulas. The tolerance of 1e-13 leaves room for some dozens of roundings.
fn assert_close(name: &str, got: &[f64], expected: &[f64]) {
    for (got, expected) in got.iter().zip(expected) {
        let tolerance = 1e-13 * expected.abs().max(1e-3);
        assert!((got - expected).abs() <= tolerance, "{name}: {got} in place of {expected}");
    }
    assert_eq!(got.len(), expected.len(), "{name}");
}

#[test]
fn effects_of_the_inclined_plane() {
    let third = |f: f64| [f, 35.0, 210.0];
    let cases: [(&str, &[f64], f64, [f64; 3]); 14] = [
        (
            "spurious-x",
            &[0.03, 120.0],
            80.0,
            [4.8643996142114514, 2.8084624267108932, 8.2788981870181641],
        ),
        (
            "spurious-y",
            &[0.02, -60.0],
            80.0,
            [4.9180802006875883, 2.9582900421225257, 8.1915204428899179],
        ),
        (
            "spurious-z",
            &[0.01, 5.0],
            80.0,
            [5.0168036719860339, 2.8964529504926396, 8.2731270157367595],
        ),
        (
            "lateral-mode",
            &[0.04, 80.0, 6.0, 30.0],
            95.0,
            [4.9096355284753979, 2.8345793939882215, 8.2390574740464103],
        ),
        (
            "plane-resonance",
            &[6000.0, 20.0],
            3000.0,
            [6.6194137674164012, 3.821720320495374, 10.915964516082607],
        ),
        ("tilt-offset", &[0.4], 80.0, [5.0167221118279143, 2.8964058617133942, 8.1512779572855422]),
        (
            "rotation-offset",
            &[-0.4],
            80.0,
            [4.9872180309090756, 2.8331341559996706, 8.1915204428899179],
        ),
        (
            "mounting-misalignment",
            &[1.0, 2.0],
            80.0,
            [5.2518748632631437, 2.7244836452994184, 8.0619476112860426],
        ),
        (
            "transverse-sensitivity",
            &[1.0, -2.0, 3.0],
            80.0,
            [5.1598268795968913, 2.6718097449577484, 8.2048303304156918],
        ),
        (
            // the product of the matrix with the signed accelerations
            "cross-axis-matrix",
            &[1.0, -2.0, 3.0, 1.5, -2.5, 0.5],
            80.0,
            [5.1598268795968913, 2.8940289045795279, 8.3013639732041803],
        ),
        (
            "background-vibration",
            &[0.3],
            80.0,
            [4.9763686183086782, 2.8835305110973147, 8.1970120877233941],
        ),
        (
            "amplitude-nonlinearity",
            &[0.1],
            80.0,
            [4.9919918935468281, 2.8761069299636596, 8.2586214500562013],
        ),
        (
            "scale-factor",
            &[2.0],
            80.0,
            // 1.02 times the values without an effect
            [4.9673176489215407 * 1.02, 2.8678821817552305 * 1.02, 8.1915204428899179 * 1.02],
        ),
        (
            "offset",
            &[0.01, -0.02, 0.03],
            80.0,
            [4.9773176489215407, 2.8478821817552305, 8.2215204428899179],
        ),
    ];
    for (name, parameters, f, expected) in cases {
        for bench in [&PLANE, &PLANE_TYPED] {
            let conditions = third(f);
            let got = if bench.file == PLANE.file {
                with(bench, name, parameters, &conditions)
            } else {
                typed(bench, name, parameters, &conditions)
            };
            assert_close(name, &got, &expected);
        }
    }
    // across the plane the sign of sin(rotation) cos(rotation) counts
    let second = with(&PLANE, "spurious-y", &[0.02, -60.0], &[80.0, 35.0, 120.0]);
    let expected = [2.9582900421225257, 4.9180802006875883, 8.1915204428899179];
    assert_close("spurious-y", &second, &expected);
}

/// The typed plane has tilt and rotation among its inputs, with means from the conditions.
fn typed(bench: &Bench, effect: &str, parameters: &[f64], conditions: &[f64]) -> Vec<f64> {
    let [f, tilt, rotation] = conditions else { panic!("three conditions") };
    let file = bench.read(&[effect]).unwrap();
    let case = &file.case;
    let program = case.model.program(&[&case.candidates[0].effect]).unwrap();
    let mut all = vec![10.0, *tilt, *rotation, *f, *tilt, *rotation];
    all.extend(parameters);
    program.evaluate(&all)
}

#[test]
fn effects_of_the_oscillating_table() {
    let cases: [(&str, &[f64], [f64; 2]); 13] = [
        ("radius-offset", &[-3.0], [47.868178967417536, 2.7152363222248403]),
        ("encoder-scale", &[1.0], [49.215367237758029, 2.8195696843788331]),
        ("sampling-rate", &[12.0], [47.992734895220274, 2.5994292140806573]),
        // the mean of a cosine over normal phases, by quadrature
        ("timestamp-jitter", &[2.0], [48.482472877231821, 2.7087050181294494]),
        ("table-tilt", &[0.1], [48.739431014155814, 2.7640130226240889]),
        ("mounting-misalignment", &[5.0], [48.542661293953212, 2.7534951185946573]),
        ("processing-filter", &[40.0], [48.72808627422273, 2.7639898366940813]),
        ("low-pass", &[65.0], [48.363162266963199, 2.683897770537446]),
        ("high-pass", &[3.0], [45.625529039097498, 2.7166715242614836]),
        ("ac-coupling", &[0.5], [48.633192250125423, 2.7626643945747251]),
        ("background-vibration", &[0.5], [48.730651562171259, 2.8088730817243331]),
        ("amplitude-nonlinearity", &[0.02], [49.2029716543526, 2.765540976221936]),
        // 1.01 times the values without an effect
        ("scale-factor", &[1.0], [48.728086374017851 * 1.01, 2.7640130226240889 * 1.01]),
    ];
    for (name, parameters, expected) in cases {
        let got = with(&TABLE, name, parameters, &[8.0, 6.5, 170.0]);
        assert_close(name, &got, &expected);
        if name == "encoder-scale" || name == "scale-factor" {
            continue;
        }
        // the typed model: inputs radius and angle_pp, conditions frequency and angle
        let file = TABLE_TYPED.read(&[name]).unwrap();
        let program = file.case.model.program(&[&file.case.candidates[0].effect]).unwrap();
        let mut all = vec![170.0, 13.0, 8.0, 13.0];
        all.extend(parameters);
        let got = program.evaluate(&all);
        assert_close(name, &got[..2], &expected);
        // the largest radial acceleration is the mean and the component together, but coupled AC
        let mean = match name {
            "high-pass" | "ac-coupling" => 0.0,
            "radius-offset" | "mounting-misalignment" => expected[1],
            _ => 2.7640130226240889,
        };
        if !["background-vibration", "amplitude-nonlinearity"].contains(&name) {
            assert_close(name, &got[2..], &[mean, mean + expected[1]]);
        }
    }
    let typed = |bench: &Bench, all: &[f64]| {
        let file = bench.read(&["encoder-scale"]).unwrap();
        let program = file.case.model.program(&[&file.case.candidates[0].effect]).unwrap();
        program.evaluate(all)[..2].to_vec()
    };
    let expected = [49.215367237758029, 2.8195696843788331];
    assert_close("angle_pp", &typed(&TABLE_TYPED, &[170.0, 13.0, 8.0, 13.0, 1.0]), &expected);
    assert_close(
        "angle_correction",
        &typed(&TABLE_CORRECTED, &[170.0, 0.0, 8.0, 13.0, 1.0]),
        &expected,
    );
}

#[test]
fn effects_of_the_measuring_chain() {
    // amplitude, phase in degrees, delay in seconds
    let cases: [(&str, &[f64], f64, [f64; 3]); 10] = [
        (
            "high-pass",
            &[0.3],
            1.0,
            [0.95782628522115139, 16.699244233993622, -0.046386789538871172],
        ),
        (
            "high-pass-cascade",
            &[0.1, 0.3],
            1.0,
            [0.95307277555572612, 22.409837371493264, -0.062249548254147957],
        ),
        (
            "ac-coupling",
            &[0.5],
            1.0,
            [0.89442719099991588, 26.565051177077989, -0.073791808825216637],
        ),
        (
            "low-pass",
            &[65.0],
            20.0,
            [0.95577900872195007, -17.102728969052372, 0.0023753790234794961],
        ),
        (
            "second-order-low-pass",
            &[100.0, 0.5],
            20.0,
            [1.0197712705600052, -11.768288932020645, 0.0016344845738917562],
        ),
        ("time-delay", &[0.002], 20.0, [1.0, -14.4, 0.002]),
        ("phase-offset", &[3.6], 20.0, [1.0, 3.6, -0.0005]),
        ("scale-factor", &[2.0], 20.0, [1.02, 0.0, 0.0]),
        ("mounting-misalignment", &[1.0], 20.0, [0.98239528871910773, 0.0, 0.0]),
        ("transverse-sensitivity", &[2.0, 3.0], 20.0, [1.0224264068711929, 0.0, 0.0]),
    ];
    for (name, parameters, f, expected) in cases {
        assert_close(name, &with(&CHAIN, name, parameters, &[f]), &expected[..2]);
        // the typed model with its own high-pass filter taken out
        let file = CHAIN_TYPED.read(&[name]).unwrap();
        let program = file.case.model.program(&[&file.case.candidates[0].effect]).unwrap();
        let mut all = vec![0.0, f];
        all.extend(parameters);
        assert_close(name, &program.evaluate(&all), &expected);
    }
}

#[test]
fn effects_of_the_gravity_rotation() {
    let cases: [(&str, &[f64], [f64; 3]); 2] = [
        (
            "gimbal-misalignment",
            &[0.3, -0.2],
            [2.8791909393185096, 4.8282377587988625, 8.0273519718182992],
        ),
        ("step-error", &[0.4, -0.5], [2.8071844578414846, 4.8950146753378059, 8.0123995624207812]),
    ];
    for (name, parameters, expected) in cases {
        assert_close(name, &with(&GIMBAL, name, parameters, &[35.0, 30.0]), &expected);
    }
}

/// At 120 Hz, 1600 Hz and 33 degC: 2000 mV and 0 deg without an effect. A coefficient times 10 K; the
/// mean of a cosine over normal phases by quadrature; 3.5 samples of 1/1600 s; 3090 Hz, which folds to
/// 110 Hz; and the response of a mass on a complex spring.
#[test]
fn effects_of_a_sensor_with_a_clock() {
    let at =
        |name: &str, parameters: &[f64]| with(&DIGITAL, name, parameters, &[120.0, 1600.0, 33.0]);
    let cases: [(&str, &[f64], [f64; 2]); 6] = [
        ("offset-temperature", &[0.7], [2007.0, 0.0]),
        ("sensitivity-temperature", &[-0.05], [1990.0, 0.0]),
        ("digital-filter-delay", &[3.5], [2000.0, -94.5]),
        ("timestamp-jitter", &[0.0005], [1862.8098668046111, 0.0]),
        ("aliasing", &[3090.0, 20.0, 300.0], [2017.4469188745528, 0.0]),
        ("mounting-resonance", &[500.0, 10.0], [2122.1641373887703, -0.083995381491573336]),
    ];
    for (name, parameters, expected) in cases {
        assert_close(name, &at(name, parameters), &expected);
    }
    // Fresnel integrals of a record with a rate that drifts, to the error of the rule of 8 points: 1e-12
    // here and, by quadrature, 4e-5 where one period of slip meets the largest drift of the prior
    let fresnel = [([0.002, 0.004], 0.902_555_530_834_752, 2e-12)];
    let corner = [([1.0 / 120.0, 4.0 / 120.0], 0.489_030_93, 4e-5)];
    for (parameters, expected, tolerance) in fresnel.into_iter().chain(corner) {
        let got = at("sensor-clock", &parameters)[0] / 2000.0;
        assert!((got - expected).abs() < tolerance, "{got} in place of {expected}");
    }
    // without a drift it is that of a sampling rate
    let steady = at("sensor-clock", &[0.003, 0.0]);
    // the rule has 1e-10 at 0.36 periods
    assert!((steady[0] / at("sampling-rate", &[0.003])[0] - 1.0).abs() < 1e-10, "{steady:?}");
    let chain = |name: &str, parameters: &[f64]| {
        let file = DIGITAL_CHAIN.read(&[name]).unwrap();
        let program = file.case.model.program(&[&file.case.candidates[0].effect]).unwrap();
        program.evaluate(&[&[0.0, 20.0, 1600.0], parameters].concat())
    };
    assert_close(
        "digital-filter-delay",
        &chain("digital-filter-delay", &[3.5]),
        &[1.0, -15.75, 0.0021875],
    );
    let expected = [1.0412282603989039, -0.23626991647385729, 3.2815266176924623e-5];
    assert_close("mounting-resonance", &chain("mounting-resonance", &[100.0, 2.0]), &expected);
}

/// 0.25 m/s^2 at 0.5 Hz, 0.3 s after a zero: 15 % less with a lead of 15 deg; and 1/12 s ahead; and at
/// the true time 0.3 s 1.02 + 5 %/s (0.3 s)^2/2.
#[test]
fn effects_of_a_signal() {
    let at = [0.3, -0.046774464189431952, 0.20225424859373686];
    let got = with(&SIGNAL, "amplitude-and-phase", &[-15.0, 15.0], &at);
    assert_close("amplitude-and-phase", &got, &[0.19838584063065537]);
    let got = with(&SIGNAL, "time-delay", &[-1.0 / 12.0], &at);
    assert_close("time-delay", &got, &[0.23339510662430044]);
    let got = with(&SIGNAL, "sensor-clock", &[2.0, 5.0], &at);
    assert_close("sensor-clock", &got, &[0.20599446889381948]);
}

/// Priors of effects for any bench follow the data: 0.1 kHz to 10 kHz, at most 2000 mV and 4.5 V.
#[test]
fn priors_that_follow_the_data() {
    let prior = |name: &str, parameter: usize, p: f64| {
        let case = OTHER.read(&[name]).unwrap().case;
        case.candidates[0].priors[parameter].quantile(p)
    };
    // quantiles of log-uniform and normal distributions; 1e-9 for the roundings of logarithms
    let near = |got: f64, expected: f64| {
        assert!((got / expected - 1.0).abs() < 1e-9, "{got} in place of {expected}");
    };
    near(prior("high-pass", 0, 0.5), 100.0 * (0.02f64 * 3.0).sqrt());
    near(prior("low-pass", 0, 0.5), 1e4 * (0.3f64 * 20.0).sqrt());
    near(prior("sampling-rate", 0, 0.5), 1e-4 * 0.02f64.sqrt());
    let one_sigma = 0.841_344_746_068_542_9;
    near(prior("offset", 0, one_sigma), 20.0);
    near(prior("offset", 1, one_sigma), 0.045);
    near(prior("amplitude-nonlinearity", 1, one_sigma), 0.01 / 4.5);
    near(prior("time-delay", 0, one_sigma), 3e-6);
    let case = OTHER.read(&["phase-offset"]).unwrap().case;
    let names: Vec<&str> =
        case.candidates[0].effect.overrides.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["psi"]);
}

#[test]
fn an_effect_that_does_not_fit_says_what_it_needs() {
    let says = |bench: &Bench, name: &str| {
        let file = bench.read(&[name]).unwrap();
        assert!(file.case.candidates.is_empty(), "{name} was taken");
        let notes = file.warnings.into_iter().filter(|note| note.code() == "effect-misfit");
        let said = notes.map(|note| sentence(&note.fact, Language::English));
        said.collect::<Vec<_>>().join("\n")
    };
    let text = says(&CHAIN, "lateral-mode");
    for needed in
        ["`lateral-mode`", "that it changes: `a_x`, `a_y`, `a_z`", "`alpha` or `tilt`", "`f`"]
    {
        assert!(text.contains(needed), "{text}");
    }
    let text = says(&TABLE, "time-delay");
    assert!(text.contains("each observed output that is a phase"), "{text}");
    assert!(matches!(
        CHAIN.read(&["lateral_mod"]).unwrap_err().as_slice(),
        [DiagnosticKind::UnknownEffect { nearest: Some(near), .. }] if near == "lateral-mode"
    ));
    let twice = CHAIN.read(&["low-pass", "low-pass"]).unwrap_err();
    assert!(twice[0].to_string().contains("second time"), "{twice:?}");
    // radius is a condition and nothing is computed from it
    let fixed = Bench {
        file: r#"{"model": "rotating-table",
          "inputs": {"angle_pp": {"unit": "deg", "distribution": "constant", "value": 13}},
          "conditions": {"frequency": {"unit": "Hz"}, "radius": {"unit": "mm"}},
          "outputs": {"a_t": {"unit": "m/s^2"}},
          "observations": {"file": "data.csv", "columns": {"a_t": {"value": "t"}}}"#,
        data: "frequency,radius,t\n5,170,49\n10,145,50\n",
        ..TABLE
    };
    let text = says(&fixed, "radius-offset");
    assert!(text.contains("the condition `radius` is set and known"), "{text}");
}

/// `"all"` is every effect that would be read if a list named it alone.
#[test]
fn all_are_those_that_fit_one_by_one() {
    for bench in [&PLANE, &TABLE, &CHAIN, &SIGNAL, &OTHER, &LOOP] {
        let file = bench.read_catalogue("\"all\"").unwrap();
        let all: Vec<&str> =
            file.case.candidates.iter().map(|of| of.effect.name.as_str()).collect();
        let names: BTreeSet<String> =
            catalogue().effects.iter().map(|effect| effect.name.clone()).collect();
        let fits = |name: &str| !bench.read(&[name]).unwrap().case.candidates.is_empty();
        let fitting: BTreeSet<&str> =
            names.iter().map(String::as_str).filter(|name| fits(name)).collect();
        assert!(!fitting.is_empty() && fitting.len() < names.len());
        assert_eq!(all.iter().copied().collect::<BTreeSet<_>>(), fitting, "{}", bench.name);
        assert!(file.case.shipped.is_empty());
        assert!(file.warnings.iter().all(|note| note.code() != "effect-misfit"));
    }
}

/// A loop at 3 of 1 to 5 kg is whole, and closed at 1 kg; what came before is counted by the largest.
#[test]
fn effects_of_what_came_before() {
    let file = LOOP.read(&[]).unwrap();
    let (case, names) = (&file.case, ["direction(m)", "previous(m)", "since(m)", "order"]);
    let known: Vec<&str> =
        case.model.conditions.iter().skip(1).map(|condition| condition.name.as_str()).collect();
    assert!(names.iter().all(|name| known.contains(name)), "{known:?}");
    let row = |number: usize| case.task.rows[number].conditions.as_slice();
    // 3 kg the first time: up from 1 kg, just put on, the third of 18 rows
    let third = |effect: &str, parameters: &[f64]| with(&LOOP, effect, parameters, row(2));
    assert_close("hysteresis", &third("hysteresis", &[0.5, 0.3]), &[6.5]);
    assert_close("creep", &third("creep", &[3.0, 0.5]), &[6.0]);
    assert_close("memory", &third("memory", &[0.5]), &[6.0 + 0.5 / 5.0]);
    assert_close("drift", &third("drift", &[0.5]), &[6.0 + 0.5 * 2.0 / 17.0]);
    // exp(-2/17/0.25)
    assert_close(
        "warm-up",
        &third("warm-up", &[0.5, 0.25]),
        &[6.0 + 0.5 * 0.624_634_728_000_274_4],
    );
    // 3 kg on the way down, the second reading: 1 - exp(-2)
    let later = |effect: &str, parameters: &[f64]| with(&LOOP, effect, parameters, row(7));
    assert_close("hysteresis", &later("hysteresis", &[0.5, 0.3]), &[5.5]);
    assert_close(
        "creep",
        &later("creep", &[3.0, 0.5]),
        &[6.0 * (1.0 + 0.03 * 0.864_664_716_763_387_3)],
    );
    // closed where it turns round
    assert_close("hysteresis", &with(&LOOP, "hysteresis", &[0.5, 0.3], row(8)), &[2.0]);
    let note = |bench: &Bench, name: &str| {
        let file = bench.read(&[name]).unwrap();
        file.warnings.into_iter().find(|note| note.code() == "effect-misfit").map(|note| note.fact)
    };
    let reason = fact!("misfit.history");
    assert_eq!(
        note(&OTHER, "hysteresis"),
        Some(fact!("effect-misfit", name = "hysteresis", reason))
    );
}

/// Overrides of outputs that a sim does not have are left out.
#[test]
fn a_part_of_the_outputs_is_enough() {
    let fewer = Bench {
        file: r#"{"model": "inclined-plane", "inputs": {
            "a_ref": {"unit": "m/s^2", "distribution": "normal", "mean": 10, "std": 0.01},
            "tilt": {"unit": "deg", "distribution": "rectangular", "mean": 35, "half_width": 0.1},
            "rotation": {"unit": "deg", "distribution": "rectangular", "mean": 30, "half_width": 0.1}},
          "conditions": {"f": {"unit": "Hz"}},
          "outputs": {"a_z": {"unit": "m/s^2"}},
          "observations": {"file": "data.csv", "columns": {"a_z": {"value": "z"}}}"#,
        data: "f,z\n5,8\n50,8\n80,8\n90,8\n",
        ..PLANE
    };
    let case = fewer.read(&["lateral-mode"]).unwrap().case;
    assert_eq!(case.candidates[0].effect.overrides.len(), 1);
    let shipped = Catalogue::shipped();
    let read = EffectContext {
        sim: &case.model,
        task: &case.task,
        observed: &case.observed,
        history: &[],
        clock: None,
    };
    let count = |name: &str| {
        let entry = shipped.entries.iter().find(|entry| entry.name == name).unwrap();
        fit::fit(&shipped, entry, &read).map(|(count, _)| count).ok()
    };
    assert_eq!(
        (count("lateral-mode"), count("spurious-y"), count("tilt-offset")),
        (Some(1), None, Some(1))
    );
}
