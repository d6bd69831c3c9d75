//! Runs cut into parts: the bytes of the whole, whatever the parts, and nothing else is taken.

use std::fs;
use std::path::Path;

use crate::support::command;
#[cfg(unix)]
use crate::support::root;

/// Several outputs, correlated inputs, a tolerance, undefined trials, few degrees of freedom, a phase,
/// a condition's value of its own, and an input from a file.
const MANY: &str = r#"{
  "inputs": {
    "a": {"unit": "V", "distribution": "normal", "mean": 1, "std": 0.5},
    "b": {"unit": "V", "distribution": "rectangular", "lower": 0, "upper": 2},
    "t": {"unit": "V", "distribution": "t", "mean": 0, "scale": 0.2, "dof": 5},
    "s": {"unit": "V", "distribution": "samples", "file": "samples.txt"}
  },
  "correlations": [["a", "b", 0.4]],
  "equations": {"y": "a*b + t^2 + s^2", "z": "sqrt(a + 0.4 [V])", "phi": "atan2(t, a)"},
  "outputs": {
    "y": {"unit": "V^2", "tolerance": {"upper": 4}},
    "z": {"unit": "V^0.5"},
    "phi": {"unit": "deg", "periodic": 360}
  },
  "allow_undefined": 0.05
}"#;

/// A sweep.
const ROWS: &str = r#"{
  "inputs": {"a": {"distribution": "normal", "mean": 1, "std": 0.1}},
  "conditions": {"x": {"values": [0, 1, 2, 3, 4, 5, 6]}},
  "equations": {"y": "exp(a*x)"}, "outputs": {"y": {}}
}"#;

struct Place(tempfile::TempDir);

impl Place {
    fn new(model: &str) -> Self {
        let place = tempfile::tempdir().unwrap();
        fs::write(place.path().join("m.json"), model).unwrap();
        fs::write(place.path().join("samples.txt"), "0.1\n0.2\n-0.1\n0.05\n").unwrap();
        fs::create_dir(place.path().join("parts")).unwrap();
        Self(place)
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    /// Exit code, standard output and standard error.
    fn ended(&self, arguments: &[&str]) -> (i32, Vec<u8>, String) {
        let done = command().current_dir(self.path()).args(arguments).output().unwrap();
        let said = String::from_utf8_lossy(&done.stderr).into_owned();
        (done.status.code().unwrap(), done.stdout, said)
    }

    fn done(&self, arguments: &[&str]) -> Vec<u8> {
        let (code, answer, said) = self.ended(arguments);
        assert_eq!(code, 0, "{arguments:?}: {said}");
        answer
    }

    /// The parts of one pass, in the order of `ranges`; their files' names tell nothing.
    fn make(&self, options: &[&str], ranges: &[&str], pass: u32) {
        for (number, range) in ranges.iter().enumerate() {
            let file = format!("parts/{}.bin", ranges.len() - number);
            let part = ["run", "m.json", "--blocks", range, "--partial", &file, "--quiet"];
            let later: &[&str] = if pass > 1 { &["--pass", "parts/next-pass"] } else { &[] };
            assert_eq!(self.done(&[&part[..], options, later].concat()), b"", "{range}");
        }
    }

    /// All passes; how many they were, and the answer.
    fn merged(&self, options: &[&str], ranges: &[&str], merge: &[&str]) -> (u32, Vec<u8>) {
        for pass in 1..=20 {
            self.make(options, ranges, pass);
            let (code, answer, said) = self.ended(&[&["merge", "parts"][..], merge].concat());
            let next = self.path().join("parts/next-pass");
            if code == 0 {
                assert_eq!(next.is_file(), pass > 1);
                return (pass, answer);
            }
            assert_eq!((code, answer.as_slice()), (75, &b""[..]), "{said}");
            assert!(next.is_file() && said.contains("--pass parts/next-pass"), "{said}");
        }
        panic!("twenty passes");
    }

    /// The parts of the folder are gone.
    fn clear(&self) {
        fs::remove_dir_all(self.path().join("parts")).unwrap();
        fs::create_dir(self.path().join("parts")).unwrap();
    }
}

const FORMATS: [&str; 7] = ["json", "csv", "table", "markdown", "latex", "html", "xlsx"];

/// One, three and seven uneven parts in no order, in all formats, with a result file.
#[test]
fn parts_give_the_bytes_of_one_run() {
    let place = Place::new(MANY);
    let options = ["--trials", "300001", "--seed", "7", "--coverage", "0.9"];
    let run = |more: &[&'static str]| [&["run", "m.json"][..], &options, more].concat();
    let whole: Vec<Vec<u8>> = FORMATS
        .iter()
        .map(|format| place.done(&run(&["--format", format, "--output", "/dev/stdout"])))
        .collect();
    place.done(&run(&["--save", "whole.json", "--quiet"]));
    // 293 blocks
    for ranges in [
        &["0..293"][..],
        &["100..101", "101..293", "0..100"],
        &["200..210", "3..150", "292..300", "150..151", "0..3", "151..200", "210..292"],
        &["2/4", "4/4", "1/4", "3/4"],
    ] {
        place.clear();
        let (passes, answer) = place.merged(&options, ranges, &["--format", "json"]);
        assert_eq!((passes, &answer), (1, &whole[0]), "{ranges:?}");
        for (format, whole) in FORMATS.iter().zip(&whole) {
            let merge = ["merge", "parts", "--format", format, "--output", "/dev/stdout"];
            assert!(place.done(&merge) == *whole, "{format}, {ranges:?}");
        }
        place.done(&["merge", "parts", "--save", "merged.json", "--quiet"]);
        let read = |name: &str| fs::read(place.path().join(name)).unwrap();
        assert_eq!(read("whole.json"), read("merged.json"), "{ranges:?}");
    }
}

/// With little memory a run takes several passes, whose parts are other ranges each time.
#[test]
fn several_passes_give_the_bytes_of_one_run() {
    let place = Place::new(MANY);
    let options = ["--trials", "600000", "--memory", "1M"];
    let whole = place.done(&[&["run", "m.json", "--format", "json"][..], &options].concat());
    for ranges in [&["0..586"][..], &["300..301", "301..586", "0..300"]] {
        place.clear();
        let (passes, answer) = place.merged(&options, ranges, &["--format", "json"]);
        assert!(passes >= 3, "{passes}");
        assert!(answer == whole, "{ranges:?}");
        // once more gives the same, and parts of an earlier pass do not matter
        fs::write(place.path().join("parts/notes.txt"), "0..586").unwrap();
        assert!(place.done(&["merge", "parts", "--format", "json"]) == whole);
    }
}

/// A pass that only `--save` needs is none that a plain answer waits for.
#[test]
fn a_plain_merge_needs_no_pass_of_a_saved_one() {
    let place = Place::new(
        r#"{"inputs": {"a": {"distribution": "normal", "mean": 1, "std": 0.1}},
            "equations": {"y": "a^2"}, "outputs": {"y": {}}}"#,
    );
    let options = ["--trials", "600000", "--memory", "1M"];
    let whole = place.done(&[&["run", "m.json", "--format", "json"][..], &options].concat());
    place.make(&options, &["0..300", "300..586"], 1);
    let (code, _, said) = place.ended(&["merge", "parts", "--save", "r.json"]);
    assert_eq!(code, 75, "{said}");
    assert!(place.done(&["merge", "parts", "--format", "json"]) == whole);
    // what is to be saved still wants the pass
    let (code, _, said) = place.ended(&["merge", "parts", "--save", "r.json"]);
    assert!(code == 2 && said.contains("lacks blocks of pass 2"), "{said}");
}

/// Rows of conditions, an adaptive sweep, a replaced value, a model from standard input, and one that
/// is nowhere any more.
#[test]
fn rows_and_replaced_values_are_carried() {
    let place = Place::new(ROWS);
    for options in [
        &["--trials", "20000"][..],
        &["--trials", "adaptive", "--max-trials", "40000"],
        &["--trials", "20000", "--set", "a=2", "--k", "1.5", "--digits", "1"],
    ] {
        place.clear();
        let whole = place.done(&[&["run", "m.json", "--format", "json"][..], options].concat());
        let (passes, answer) = place.merged(options, &["2/3", "1/3", "3/3"], &["--format", "json"]);
        assert!(passes == 1 && answer == whole, "{options:?}");
    }
    fs::rename(place.path().join("m.json"), place.path().join("other.json")).unwrap();
    let again = place.done(&["merge", "parts", "--format", "json"]);
    let model = ["merge", "parts", "--format", "json", "--model", "other.json"];
    assert_eq!(place.done(&model), again);
    // with files it is looked for
    let place = Place::new(MANY);
    let options = ["--trials", "2000"];
    place.make(&options, &["0..2"], 1);
    let answer = place.done(&["merge", "parts", "--format", "json"]);
    fs::rename(place.path().join("m.json"), place.path().join("other.json")).unwrap();
    assert_eq!(place.ended(&["merge", "parts"]).0, 2);
    assert_eq!(place.done(&model), answer);
    fs::write(place.path().join("samples.txt"), "0.1\n0.3\n").unwrap();
    let (code, _, said) = place.ended(&model);
    assert!(code == 2 && said.contains("`samples.txt`"), "{said}");
}

/// A part that was killed leaves no file; it is told what is missing, and once it is made the answer
/// is that of one run.
#[cfg(unix)]
#[test]
fn a_killed_part_is_made_again() {
    let place = Place::new(MANY);
    let options = ["--trials", "300000"];
    place.make(&options, &["0..100"], 1);
    let part = ["run", "m.json", "--blocks", "100..293", "--partial", "parts/2.bin"];
    let all = ["run", "m.json", "--blocks", "100..900000", "--partial", "parts/2.bin"];
    let long = [&all[..], &["--trials", "1000000000", "--memory", "100G"]].concat();
    let mut child = command().current_dir(place.path()).args(long).spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_millis(200));
    child.kill().unwrap();
    child.wait().unwrap();
    let (code, answer, said) = place.ended(&["merge", "parts"]);
    assert_eq!((code, answer.as_slice()), (2, &b""[..]));
    assert!(said.contains("100..293"), "{said}");
    place.done(&[&part[..], &options].concat());
    let whole = place.done(&[&["run", "m.json", "--format", "json"][..], &options].concat());
    assert_eq!(place.done(&["merge", "parts", "--format", "json"]), whole);
}

/// Each refusal has exit code 2, says what is wrong and with which file, and leaves all as it was.
#[test]
fn what_does_not_belong_together_is_refused() {
    let place = Place::new(MANY);
    let part = |range: &str, name: &str, options: &[&str]| {
        let file = format!("parts/{name}");
        let part = ["run", "m.json", "--blocks", range, "--partial", &file];
        place.ended(&[&part[..], options].concat())
    };
    let refused = |words: &[&str]| {
        let (code, answer, said) = place.ended(&["merge", "parts", "--output", "answer"]);
        assert_eq!((code, answer.len()), (2, 0), "{said}");
        assert!(words.iter().all(|word| said.contains(word)), "{said}");
        assert!(said.lines().count() <= 3, "{said}");
        assert!(!place.path().join("answer").exists());
    };
    refused(&["no part of a run"]);
    let usual = ["--trials", "50000"];
    assert_eq!(part("0..20", "a", &usual).0, 0);
    refused(&["20..49"]);
    for (options, words) in [
        (&["--trials", "50000", "--seed", "2"][..], &["parts/b", "seed 2, not 1"][..]),
        (&["--trials", "60000"], &["parts/b", "60000 trials"]),
        (&["--trials", "50000", "--set", "a=2"], &["parts/b", "a=2"]),
        (&["--trials", "50000", "--digits", "3"], &["parts/b", "digits"]),
        (&["--trials", "50000", "--memory", "1G"], &["parts/b", "--memory"]),
    ] {
        assert_eq!(part("20..49", "b", options).0, 0);
        refused(words);
    }
    assert_eq!(part("19..49", "b", &usual).0, 0);
    refused(&["parts/a", "parts/b", "19..20"]);
    // another model
    let model = fs::read_to_string(place.path().join("m.json")).unwrap();
    fs::write(place.path().join("m.json"), model.replace("t^2", "t^3/(1 [V])")).unwrap();
    assert_eq!(part("20..49", "b", &usual).0, 0);
    refused(&["m.json", "not the one"]);
    fs::write(place.path().join("m.json"), &model).unwrap();
    refused(&["parts/b", "another model"]);
    // damaged
    assert_eq!(part("20..49", "b", &usual).0, 0);
    let whole = fs::read(place.path().join("parts/b")).unwrap();
    for (bytes, words) in [
        (whole[..whole.len() - 1].to_vec(), &["parts/b", "SHA-256"][..]),
        (whole[..100].to_vec(), &["parts/b", "too early"]),
        ([&whole[..], b"x"].concat(), &["parts/b", "SHA-256"]),
        (whole[..5].to_vec(), &["20..49"]),
        (Vec::new(), &["20..49"]),
    ] {
        fs::write(place.path().join("parts/b"), bytes).unwrap();
        refused(words);
    }
    fs::write(place.path().join("parts/b"), &whole).unwrap();
    // a part is no answer, and no answer takes the place of a part
    let (code, _, said) = place.ended(&["merge", "parts", "--output", "parts/b"]);
    assert!(code == 2 && said.contains("would overwrite"), "{said}");
    let (code, _, said) = part("0..5", "c", &["--trials", "50000", "--pass", "parts/a"]);
    assert!(code == 2 && said.contains("next-pass"), "{said}");
    place.done(&["merge", "parts"]);
}

#[test]
fn what_cannot_be_cut_is_refused() {
    let place = Place::new(MANY);
    for (options, words) in [
        (&["--blocks", "0..5", "--partial", "p", "--trials", "adaptive"][..], "adaptive"),
        (&["--blocks", "0..5", "--partial", "p", "--trials", "0"], "no blocks"),
        (&["--blocks", "3..6", "--partial", "p", "--trials", "2000"], "2 blocks (0..2)"),
        (&["--blocks", "1/9", "--partial", "p", "--trials", "2000"], "2 blocks"),
        (&["--blocks", "5..5", "--partial", "p"], "0..500"),
        (&["--blocks", "0..5"], "--partial"),
        (&["--partial", "p"], "--blocks"),
        (&["--blocks", "0..5", "--partial", "p", "--save", "r.json"], "--save"),
        (&["--resume", "d", "--trials", "adaptive"], "adaptive"),
    ] {
        let (code, answer, said) = place.ended(&[&["run", "m.json"][..], options].concat());
        assert_eq!((code, answer.len()), (2, 0), "{options:?}: {said}");
        assert!(said.contains(words), "{options:?}: {said}");
        assert!(!place.path().join("p").exists());
    }
    let (code, _, said) = place.ended(&["merge", "nowhere"]);
    assert!(code == 2 && said.contains("nowhere"), "{said}");
}

/// A run that was interrupted goes on from its parts.
#[cfg(unix)]
#[test]
fn an_interrupted_run_is_resumed() {
    let place = Place::new(MANY);
    let options = ["--trials", "600000", "--memory", "1M", "--format", "json"];
    let whole = place.done(&[&["run", "m.json"][..], &options].concat());
    let kept = [&["run", "m.json", "--resume", "kept", "--quiet"][..], &options].concat();
    let mut child = command().current_dir(place.path()).args(&kept).spawn().unwrap();
    let folder = place.path().join("kept");
    crate::process::until("three files", || {
        assert!(child.try_wait().unwrap().is_none(), "it ended before");
        fs::read_dir(&folder).map_or(0, Iterator::count) >= 3
    });
    child.kill().unwrap();
    child.wait().unwrap();
    let made = fs::read_dir(&folder).unwrap().count();
    assert!(made >= 3);
    assert_eq!(place.done(&kept), whole);
    // all is there: the answer comes at once, and other runs are refused
    assert_eq!(place.done(&kept), whole);
    let (code, _, said) = place.ended(&[&kept[..], &["--seed", "5"]].concat());
    assert!(code == 2 && said.contains("seed"), "{said}");
}

/// The example for batch systems does what it says, here with the shell in place of Slurm.
#[cfg(unix)]
#[test]
fn the_example_of_a_batch_system_works() {
    let place = Place::new(MANY);
    let script = root().join("examples/batch/parts.sh");
    let program = env!("CARGO_BIN_EXE_gumption");
    let options = ["--trials", "600000", "--memory", "1M"];
    let done = crate::process::Command::new("sh")
        .current_dir(place.path())
        .env("GUMPTION", program)
        .arg(script)
        .args(["3", "m.json", "work", "--format json --output answer.json"])
        .args(options)
        .output()
        .unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let whole = place.done(&[&["run", "m.json", "--format", "json"][..], &options].concat());
    assert_eq!(fs::read(place.path().join("answer.json")).unwrap(), whole);
}
