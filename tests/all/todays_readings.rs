//! Readings of the day that replace those of a model file: the same figures as of an edited file.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::support::command;

/// A folder of files, in which the program runs.
struct Place(tempfile::TempDir);

impl Place {
    fn of(files: &[(&str, &str)]) -> Self {
        let place = Self(tempfile::tempdir().unwrap());
        for (name, content) in files {
            fs::write(place.path().join(name), content).unwrap();
        }
        place
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    /// Exit code, standard output and standard error.
    fn ended(&self, arguments: &[&str]) -> (i32, String, String) {
        let done = command().current_dir(self.path()).args(arguments).output().unwrap();
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        (done.status.code().unwrap(), text(&done.stdout), text(&done.stderr))
    }

    fn done(&self, arguments: &[&str]) -> String {
        let (code, answer, said) = self.ended(arguments);
        assert_eq!(code, 0, "{arguments:?}: {said}");
        answer
    }

    /// The JSON answer.
    fn answer(&self, arguments: &[&str]) -> Value {
        let arguments = [arguments, &["--format", "json", "--quiet"]].concat();
        serde_json::from_str(&self.done(&arguments)).unwrap()
    }
}

/// The answer without what says where its readings are from.
fn figures(mut answer: Value) -> Value {
    let root = answer.as_object_mut().unwrap();
    root.remove("provenance");
    let of_readings = |note: &Value| note["code"].as_str().unwrap().starts_with("readings-");
    root["warnings"].as_array_mut().unwrap().retain(|note| !of_readings(note));
    answer
}

/// A voltage with the component of its readings, and paired readings of a current and a phase.
fn model(voltages: &str, currents: &str, phases: &str) -> String {
    let paired = |name: &str, unit: &str, values: &str| {
        format!(
            r#""{name}": {{"unit": "{unit}", "distribution": "readings", "paired": true, "values": [{values}]}}"#
        )
    };
    format!(
        r#"{{"inputs": {{
            "V": {{"unit": "V", "components": [
                {{"name": "scatter", "distribution": "readings", "values": [{voltages}]}},
                {{"name": "scale", "distribution": "normal", "std": 0.001}}]}},
            {}, {}}},
          "equations": {{"R": "V/I*cos(phi)"}}, "outputs": {{"R": {{"unit": "ohm"}}}},
          "monte_carlo": {{"trials": 2000}}}}"#,
        paired("I", "A", currents),
        paired("phi", "rad", phases),
    )
}

const YESTERDAY: [&str; 3] = ["5.1, 5.2, 5.3", "0.1, 0.2, 0.3, 0.2, 0.1, 0.2", "1, 1, 2, 1, 1, 2"];
const VOLTAGES: &str = "5.007, 4.994, 5.005, 4.99, 4.999";
const CURRENTS: &str = "0.019663, 0.019639, 0.01964, 0.019685, 0.019678, 0.019661";
const PHASES: &str = "1.0456, 1.0438, 1.0468, 1.0428, 1.0433, 1.0445";
/// The same readings with columns of different length, as a spreadsheet with decimal commas writes them.
const TODAY: &str = "V [V];I [A];phi\n5,007;0,019663;1,0456\n4,994;0,019639;1,0438\n5,005;0,01964;1,0468\n\
                     4,99;0,019685;1,0428\n4,999;0,019678;1,0433\n;0,019661;1,0445\n";

fn voltage_and_current() -> Place {
    let [a, b, c] = YESTERDAY;
    Place::of(&[
        ("m.json", &model(a, b, c)),
        ("edited.json", &model(VOLTAGES, CURRENTS, PHASES)),
        ("today.csv", TODAY),
    ])
}

#[test]
fn readings_of_a_file_are_those_of_an_edited_model() {
    let place = voltage_and_current();
    let edited = place.answer(&["run", "edited.json"]);
    let today = place.answer(&["run", "m.json", "--readings", "today.csv"]);
    assert_eq!(figures(edited.clone()), figures(today.clone()));
    // the model file is the same one, and the readings stand beside it
    let model = place.answer(&["run", "m.json"])["provenance"]["model_sha256"].clone();
    assert_eq!(today["provenance"]["model_sha256"], model);
    let digest = today["provenance"]["files"]["today.csv"].as_str().unwrap();
    assert_eq!(digest, gumption::file::bytes::sha256(TODAY.as_bytes()));
    // a replacement on the command line is the same as well
    let set = [
        format!("V.values={VOLTAGES}"),
        format!("I.values={CURRENTS} A"),
        format!("phi.values={}", PHASES.replace(',', ";").replace('.', ",")),
    ];
    let [v, i, phi] = &set;
    let set = place.answer(&["run", "m.json", "--set", v, "--set", i, "--set", phi]);
    assert_eq!(figures(edited), figures(set));
}

/// A run in parts carries the readings, so that `merge` gives the bytes of the whole run.
#[test]
fn parts_of_a_run_carry_the_readings() {
    let place = voltage_and_current();
    let run = ["run", "m.json", "--readings", "today.csv", "--format", "json"];
    let whole = place.done(&run);
    fs::create_dir(place.path().join("parts")).unwrap();
    for (blocks, partial) in [("1/2", "parts/1"), ("2/2", "parts/2")] {
        place.done(&[
            "run",
            "m.json",
            "--readings",
            "today.csv",
            "--blocks",
            blocks,
            "--partial",
            partial,
        ]);
    }
    fs::remove_file(place.path().join("today.csv")).unwrap();
    loop {
        let (code, answer, said) = place.ended(&["merge", "parts", "--format", "json"]);
        if code == 0 {
            assert_eq!(answer, whole);
            return;
        }
        assert_eq!(code, 75, "{said}");
        fs::write(place.path().join("today.csv"), TODAY).unwrap();
        for (blocks, partial) in [("1/2", "parts/1"), ("2/2", "parts/2")] {
            place.done(&[
                "run",
                "m.json",
                "--readings",
                "today.csv",
                "--blocks",
                blocks,
                "--partial",
                partial,
                "--pass",
                "parts/next-pass",
            ]);
        }
    }
}

/// 20.1 degC and 20.3 degC are 293.25 K and 293.45 K: the mean is 293.35 K, and s/sqrt(2) is 0.1 K.
#[test]
fn units_are_converted_with_their_zero() {
    let model = r#"{"inputs": {"T": {"unit": "K", "distribution": "readings", "values": [1, 2]}},
        "equations": {"y": "T"}, "outputs": {"y": {"unit": "K"}}, "monte_carlo": {"trials": 0}}"#;
    let place = Place::of(&[("m.json", model), ("t.csv", "T in degC\n20.1\n20.3\n")]);
    let gum = &place.answer(&["run", "m.json", "--readings", "t.csv"])["outputs"]["y"]["gum"];
    let (estimate, u) =
        (gum["estimate"].as_f64().unwrap(), gum["standard_uncertainty"].as_f64().unwrap());
    // rounding of the readings in kelvins
    assert!((estimate - 293.35).abs() < 1e-12 * 293.35, "{estimate}");
    assert!((u - 0.1).abs() < 1e-12, "{u}");
}

/// A gauge at three pressures; `readings` are numbers, or columns of the table of pressures.
fn gauge(readings: &str, conditions: &str) -> String {
    format!(
        r#"{{"inputs": {{"I": {{"unit": "bar", "distribution": "readings", "values": [{readings}]}},
            "d": {{"unit": "bar", "distribution": "rectangular", "mean": 0, "half_width": 0.001}}}},
          "conditions": {conditions}, "equations": {{"E": "I + d - p"}}, "outputs": {{"E": {{"unit": "mbar"}}}},
          "monte_carlo": {{"trials": 1000}}}}"#
    )
}

const PRESSURES: &str = r#"{"p": {"unit": "bar", "values": [0, 1, 2]}}"#;
const TABLE: &str = "p [bar],r1 [bar],r2 [bar],r3 [bar]\n0,0.001,0.002,0.0015\n1,1.003,1.002,1.001\n\
                     2,2.004,2.003,2.006\n";
/// The readings of the table, in the order in which they were taken.
const POINTS: &str = "p [mbar],I [bar]\n0,0.001\n1000,1.003\n2000,2.004\n2000,2.003\n1000,1.002\n0,0.002\n\
                      0,0.0015\n1000,1.001\n2000,2.006\n";

/// Each row has its own readings, as with columns of the conditions' table: the draws of a row depend on
/// its conditions, so that only the model with the same conditions has the same trials.
#[test]
fn lines_belong_to_points() {
    let place = Place::of(&[
        ("grid.json", &gauge("1, 2", PRESSURES)),
        ("table.json", &gauge(r#""r1", "r2", "r3""#, r#"{"file": "table.csv"}"#)),
        ("table.csv", TABLE),
        ("points.csv", POINTS),
    ]);
    let table = place.answer(&["run", "table.json"]);
    let replaced = place.answer(&["run", "table.json", "--readings", "points.csv"]);
    assert_eq!(figures(table.clone()), figures(replaced));
    let grid = place.answer(&["run", "grid.json", "--readings", "points.csv"]);
    for row in 0..3 {
        let gum = |answer: &Value| answer["rows"][row]["outputs"]["E"]["gum"].clone();
        assert!(gum(&grid)["estimate"].is_f64());
        assert_eq!(gum(&table), gum(&grid), "{row}");
    }
    // the heading of such a file
    let heading = "p [bar],I [bar]\n0,\n0,\n1,\n1,\n2,\n2,\n";
    for model in ["grid.json", "table.json"] {
        assert_eq!(place.done(&["readings", "--template", model, "--lines", "2"]), heading);
    }
}

#[test]
fn headings_have_units_groups_and_no_components() {
    let [a, b, c] = YESTERDAY;
    let nested = r#"{"inputs": {"x": {"unit": "mm", "distribution": "readings", "file": "old.csv",
        "column": "x", "groups": "day"}}, "equations": {"y": "2*x"}, "outputs": {"y": {"unit": "mm"}},
        "monte_carlo": {"trials": 1000}}"#;
    let old = "x,day\n1.0,1\n1.1,1\n1.3,2\n1.5,2\n";
    let place =
        Place::of(&[("m.json", &model(a, b, c)), ("nested.json", nested), ("old.csv", old)]);
    assert_eq!(place.done(&["readings", "--template", "m.json"]), "V [V],I [A],phi [rad]\n");
    assert_eq!(place.done(&["readings", "--template", "nested.json"]), "day,x [mm]\n");
    // a nested design is read again
    let whole = figures(place.answer(&["run", "nested.json"]));
    let again = place.answer(&["run", "nested.json", "--readings", "old.csv"]);
    assert_eq!(whole, figures(again));
    fs::write(place.path().join("new.csv"), "x\n1.0\n1.1\n").unwrap();
    let (code, _, said) = place.ended(&["run", "nested.json", "--readings", "new.csv"]);
    assert_eq!(code, 2);
    assert!(said.contains("add the column `day`"), "{said}");
}

/// A certificate, its readings by model files, and one certificate for each file of a folder.
#[test]
fn certificates_of_the_day() {
    let [a, b, c] = YESTERDAY;
    let rows = |first: &str| json!({"rows": [{"model": first, "output": "R"}, {"model": "other.json", "output": "R"}]});
    let place = Place::of(&[
        ("m.json", &model(a, b, c)),
        // another text, so that its inputs are not those of the first model
        ("other.json", &model(b, b, c)),
        ("edited.json", &model(VOLTAGES, CURRENTS, PHASES)),
        ("c.json", &rows("m.json").to_string()),
        ("edited_c.json", &rows("edited.json").to_string()),
        ("today.csv", &TODAY.replace("V [V];I [A];phi", "m.json:V [V];m.json:I [A];m.json:phi")),
    ]);
    let stated = |answer: &Value| {
        let rows = answer["rows"].as_array().unwrap().clone();
        let without = |mut row: Value| {
            row.as_object_mut().unwrap().remove("model");
            row
        };
        rows.into_iter().map(without).collect::<Vec<_>>()
    };
    let edited = place.answer(&["certificate", "edited_c.json"]);
    let today = place.answer(&["certificate", "c.json", "--readings", "today.csv"]);
    assert_eq!(stated(&edited), stated(&today));
    let files = &today["provenance"]["models"][0]["files"];
    assert!(files["today.csv"].is_string(), "{files}");
    assert_eq!(today["provenance"]["models"][1]["files"], json!({}));
    // readings in a row of the certificate
    let set = json!({"V.values": VOLTAGES, "I.values": CURRENTS, "phi.values": PHASES});
    let of_row = json!({"rows": [{"model": "m.json", "output": "R", "set": set},
        {"model": "other.json", "output": "R"}]});
    fs::write(place.path().join("set.json"), of_row.to_string()).unwrap();
    let by_row = place.answer(&["certificate", "set.json"]);
    for key in ["value", "expanded_uncertainty", "coverage_factor"] {
        assert_eq!(by_row["rows"][0][key], today["rows"][0][key], "{key}");
    }
}

#[test]
fn one_certificate_for_each_file() {
    let certificate = json!({"rows": [{"model": "grid.json", "output": "E"}], "conditions": "p"});
    let place = Place::of(&[
        ("grid.json", &gauge("1, 2", PRESSURES)),
        ("c.json", &certificate.to_string()),
    ]);
    let folder = place.path().join("devices");
    fs::create_dir(&folder).unwrap();
    for (name, content) in [
        ("b.csv", POINTS.to_owned()),
        ("a.csv", POINTS.replace("0.0015", "0.0005")),
        ("wrong.csv", POINTS.replace("p [mbar]", "p [mm]")),
        ("remark.txt", "no readings".to_owned()),
    ] {
        fs::write(folder.join(name), content).unwrap();
    }
    let each = [
        "certificate",
        "c.json",
        "--each",
        "devices",
        "--output-folder",
        "out",
        "--format",
        "json",
    ];
    let (code, answer, said) = place.ended(&each);
    assert_eq!((code, answer.as_str()), (2, ""));
    assert!(said.contains("devices/wrong.csv:1:1: "), "{said}");
    assert!(said.contains("1 of 3 certificates were not made: `devices/wrong.csv`"), "{said}");
    let mut made: Vec<String> = fs::read_dir(place.path().join("out"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    made.sort();
    assert_eq!(made, ["a.json", "b.json"]);
    for device in ["a", "b"] {
        let readings = format!("devices/{device}.csv");
        let alone = place.done(&[
            "certificate",
            "c.json",
            "--readings",
            &readings,
            "--format",
            "json",
            "--quiet",
        ]);
        let written = fs::read_to_string(place.path().join(format!("out/{device}.json"))).unwrap();
        assert_eq!(written, alone, "{device}");
    }
    let (code, _, said) =
        place.ended(&["certificate", "c.json", "--each", "out", "--output-folder", "out"]);
    assert_eq!(code, 2);
    assert!(said.contains("has no files of readings"), "{said}");
}

/// Certificates of several devices differ in their numbers, which the names of the files give.
#[test]
fn certificates_of_several_devices_have_numbers_of_their_own() {
    let row = json!({"model": "grid.json", "output": "E"});
    let certificate = |number: &str, serial: &str| json!({"number": number, "device": {"name": "d", "serial_number": serial}, "rows": [row]});
    let place = Place::of(&[
        ("grid.json", &gauge("1, 2", PRESSURES)),
        ("same.json", &certificate("C-1", "{readings}").to_string()),
        ("alike.json", &certificate("C-{readings}", "77").to_string()),
        ("own.json", &certificate("C-{readings}", "{readings}").to_string()),
    ]);
    let folder = place.path().join("devices");
    fs::create_dir(&folder).unwrap();
    for name in ["0815.csv", "0816.csv"] {
        fs::write(folder.join(name), POINTS).unwrap();
    }
    let each = |file: &str| {
        let options =
            ["--each", "devices", "--output-folder", "out", "--format", "json", "--quiet"];
        place.ended(&[&["certificate", file][..], &options].concat())
    };
    for (file, key) in [("same.json", "`number`"), ("alike.json", "`device.serial_number`")] {
        let (code, _, said) = each(file);
        assert_eq!(code, 2);
        assert!(said.contains(key) && said.contains("{readings}"), "{said}");
        assert!(!place.path().join("out").exists());
    }
    assert_eq!(each("own.json").0, 0);
    let text = fs::read_to_string(place.path().join("out/0816.json")).unwrap();
    let found: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(found["administrative"]["number"], "C-0816");
    assert_eq!(found["administrative"]["device"]["serial_number"], "0816");
    assert_eq!(place.ended(&["check", "own.json"]).0, 0);
    let (code, _, said) = place.ended(&["certificate", "own.json"]);
    assert_eq!(code, 2);
    assert!(said.contains("own.json:1:") && said.contains("`--readings` or `--each`"), "{said}");
}

/// Results of two days are two quantities, and results of one file of readings are one: the difference
/// of equal results has u = 0, of independent ones the root of the sum of the squares.
#[test]
fn results_of_two_days_are_independent() {
    let model = r#"{"inputs": {"x": {"unit": "V", "distribution": "readings", "values": [1, 2, 3, 4]}},
        "equations": {"y": "x"}, "outputs": {"y": {"unit": "V"}}, "monte_carlo": {"trials": 2000}}"#;
    let difference = r#"{"inputs": {"a": {"distribution": "result", "file": "a.result", "output": "y"},
        "b": {"distribution": "result", "file": "b.result", "output": "y"}},
        "equations": {"d": "a - b"}, "outputs": {"d": {"unit": "V"}}, "monte_carlo": {"trials": 0}}"#;
    let readings = "x\n1\n2\n3\n4\n5\n";
    let place = Place::of(&[
        ("m.json", model),
        ("d.json", difference),
        ("monday.csv", readings),
        ("tuesday.csv", "x\n2\n3\n4\n5\n6\n"),
    ]);
    let u = |of_a: &[&str], of_b: &[&str]| {
        place.done(&[&["run", "m.json", "--save", "a.result"], of_a].concat());
        place.done(&[&["run", "m.json", "--save", "b.result"], of_b].concat());
        let answer = place.answer(&["run", "d.json"]);
        answer["outputs"]["d"]["gum"]["standard_uncertainty"].as_f64().unwrap()
    };
    let (monday, tuesday) = (["--readings", "monday.csv"], ["--readings", "tuesday.csv"]);
    assert_eq!(u(&monday, &monday), 0.0);
    // five readings with s^2 = 2.5: u^2 = 0.5 each
    assert!((u(&monday, &tuesday) - 1.0).abs() < 1e-12);
    let set = ["--set", "x.values=2,3,4,5,6"];
    assert!((u(&monday, &set) - 1.0).abs() < 1e-12);
    assert_eq!(u(&set, &set), 0.0);
}

/// A sheet of a workbook is read as its text.
#[test]
fn workbooks_hold_readings() {
    let place = voltage_and_current();
    let mut book = rust_xlsxwriter::Workbook::new();
    let sheet = book.add_worksheet();
    for (column, (heading, values)) in
        [("V [V]", VOLTAGES), ("I [A]", CURRENTS), ("phi [rad]", PHASES)].into_iter().enumerate()
    {
        let column = u16::try_from(column).unwrap();
        sheet.write_string(0, column, heading).unwrap();
        for (row, value) in values.split(", ").enumerate() {
            let row = u32::try_from(row + 1).unwrap();
            sheet.write_number(row, column, value.parse::<f64>().unwrap()).unwrap();
        }
    }
    book.save(place.path().join("today.xlsx")).unwrap();
    let edited = place.answer(&["run", "edited.json"]);
    let today = place.answer(&["run", "m.json", "--readings", "today.xlsx"]);
    assert_eq!(figures(edited), figures(today));
}
