//! The same bits on any number of threads, on every code path, with any memory.
//!
//! `tests/data/golden.csv` holds a hash over all trials of every model file, so that a change of
//! any bit is seen. `GUMPTION_GOLDEN=write cargo test --test all golden` writes it and the hashes of
//! answers anew; such a change belongs into the changelog.

use std::fs;
use std::path::{Path, PathBuf};

use gumption::file::{self, read_text};
use gumption::number::CodePath;
use gumption::propagate::{Control, Evaluation, evaluate, trial_hash};
use gumption::task::{Task, Trials};

use crate::support::{command, file_name, model_files, root};

/// Trials of each comparison: some dozen blocks of different threads, and more than a pilot.
const TRIALS: u64 = 200_000;

fn task(path: &Path) -> Task {
    file::read(path, &[]).unwrap_or_else(|problems| panic!("{problems}")).task
}

/// On one thread and on three; the hashes of the next test are on one and on two.
#[test]
fn answers_are_the_same_bytes_on_any_number_of_threads() {
    for path in model_files() {
        let answer = |threads: &str| {
            let arguments = ["--format", "json", "--quiet", "--trials", "100000"];
            let mut run = command();
            run.arg("run").arg(&path).args(arguments).args(["--threads", threads]);
            let run = run.output().expect("the program runs");
            assert!(run.status.success(), "{}", path.display());
            run.stdout
        };
        let one = answer("1");
        assert!(one.len() > 500);
        assert!(answer("3") == one, "{} on three threads", path.display());
    }
}

/// The lines of `verify --paths` as code path and hash.
fn verified(path: &Path, threads: &str) -> Vec<(String, String)> {
    let arguments = ["--trials", "100000", "--threads", threads, "--fail"];
    let mut run = command();
    run.args(["verify", "--paths", "--model"]).arg(path).args(arguments);
    let run = run.output().expect("the program runs");
    assert_eq!(run.status.code(), Some(0), "{}", path.display());
    let text = String::from_utf8(run.stdout).expect("UTF-8");
    assert!(text.contains("100000 trials: the same bits on every path"), "{text}");
    text.lines()
        .filter_map(|line| line.split_once(' '))
        .map(|(name, hash)| (name.to_owned(), hash.trim().to_owned()))
        .filter(|(_, hash)| hash.len() == 16)
        .collect()
}

#[test]
fn hashes_over_all_trials_are_the_same_on_one_and_two_threads_and_every_path() {
    for path in model_files() {
        let one = verified(&path, "1");
        assert_eq!(one.len(), CodePath::available().len(), "{}", path.display());
        assert!(one.windows(2).all(|pair| pair[0].1 == pair[1].1), "{}: {one:?}", path.display());
        assert_eq!(one, verified(&path, "2"), "{}", path.display());
    }
}

/// One line for each model file.
fn golden_lines() -> Vec<String> {
    let line = |path: &PathBuf| {
        let task = task(path);
        let hash = trial_hash(&task, TRIALS, &Control::default()).expect("a hash");
        format!("{},{TRIALS},{},{hash:016x}", file_name(path), task.settings.seed)
    };
    model_files().iter().map(line).collect()
}

#[test]
fn golden_hashes() {
    let path = root().join("tests/data/golden.csv");
    let now = format!("file,trials,seed,hash\n{}\n", golden_lines().join("\n"));
    if std::env::var_os("GUMPTION_GOLDEN").is_some_and(|value| value == "write") {
        fs::write(&path, &now).expect("the list is written");
    }
    let golden = fs::read_to_string(&path).expect("tests/data/golden.csv");
    for (now, golden) in now.lines().zip(golden.lines()) {
        assert_eq!(now, golden, "the trials have changed");
    }
    assert_eq!(now.lines().count(), golden.lines().count(), "model files without a hash");
}

#[test]
fn seeds_and_trials_change_the_hash() {
    let mut task = task(&root().join("models/inclined_plane.json"));
    let hash = |task: &Task, trials: u64| trial_hash(task, trials, &Control::default());
    let first = hash(&task, 10_000).expect("a hash");
    assert_ne!(first, hash(&task, 10_001).expect("a hash"));
    task.settings.seed += 1;
    assert_ne!(first, hash(&task, 10_000).expect("a hash"));
}

/// A sum of many kinds of inputs, more curved than the models are.
const CURVED: &str = r#"{
  "inputs": {
    "a": {"distribution": "normal", "mean": 1, "std": 0.5},
    "b": {"distribution": "rectangular", "lower": 0, "upper": 1},
    "c": {"distribution": "t", "mean": 0, "scale": 1, "dof": 5},
    "d": {"distribution": "triangular", "lower": 0, "upper": 2, "mode": 0.5}
  },
  "equations": {"y": "a^3 + b*c", "z": "exp(-d) + sin(6*b)", "n": "b > 0.25"},
  "outputs": {"y": {}, "z": {}, "n": {}}
}"#;

fn curved(trials: u64) -> Task {
    let mut task = read_text("curved", CURVED, Path::new(""), &[]).expect("a right model").task;
    task.settings.trials = Trials::Fixed(trials);
    task
}

fn figures(evaluation: &Evaluation) -> Vec<[f64; 5]> {
    let outputs = evaluation.rows.iter().flat_map(|row| &row.outputs);
    outputs
        .map(|output| {
            let found = output.monte_carlo.as_deref().expect("trials");
            assert!(found.shortest_exact);
            let ([a, b], [c, d]) = (found.symmetric_interval, found.shortest_interval);
            [a, b, c, d, found.median]
        })
        .collect()
}

#[test]
fn capped_runs_are_the_same_on_any_number_of_threads() {
    let task = curved(300_001);
    let with = |threads: usize| {
        let control = Control::default().with_memory(100 << 10).with_threads(threads);
        format!("{:?}", evaluate(&task, &control).expect("an evaluation"))
    };
    let one = with(1);
    assert!(one == with(2) && one == with(3));
}

/// With little memory the trials are made again in several passes instead of kept; all figures and
/// their numerical standard errors are those of the same trials, bit for bit.
#[test]
fn capped_memory_gives_the_same_figures() {
    let trials = 1_200_000;
    for task in [curved(trials), curved(300_001), {
        let mut task = task(&root().join("models/inclined_plane_spurious.json"));
        task.settings.trials = Trials::Fixed(trials);
        task
    }] {
        let with = |memory: usize, threads: usize| {
            let control = Control::default().with_memory(memory).with_threads(threads);
            evaluate(&task, &control).expect("an evaluation")
        };
        let whole = with(1 << 30, 2);
        for (memory, threads) in [(1 << 20, 3), (100 << 10, 1)] {
            let capped = with(memory, threads);
            assert_eq!(figures(&capped), figures(&whole), "{memory} bytes");
            // moments and numerical standard errors as well
            assert_eq!(format!("{:?}", capped.rows), format!("{:?}", whole.rows), "{memory} bytes");
        }
    }
}

#[test]
fn the_code_path_and_the_number_of_threads_do_not_matter() {
    let task = curved(300_001);
    let with = |path: CodePath, threads: usize| {
        let control = Control::default().with_path(path).with_threads(threads);
        format!("{:?}", evaluate(&task, &control).expect("an evaluation"))
    };
    let first = with(CodePath::best(), 1);
    for path in CodePath::available() {
        for threads in [1, 2, 7] {
            assert!(with(path, threads) == first, "{} on {threads} threads", path.name());
        }
    }
}

/// A shorter run's trials are the first of a longer one's, as far as their sum shows it.
#[test]
fn the_first_trials_of_a_longer_run_are_those_of_a_shorter_one() {
    let text = r#"{"inputs": {"x": {"distribution": "normal", "mean": 0, "std": 1}},
        "equations": {"y": "x"}, "outputs": {"y": {}}}"#;
    let mut task = read_text("first", text, Path::new(""), &[]).expect("a right model").task;
    let mut sum = |trials: u64| {
        task.settings.trials = Trials::Fixed(trials);
        let evaluation = evaluate(&task, &Control::default()).expect("an evaluation");
        let figures = evaluation.rows[0].outputs[0].monte_carlo.clone().expect("trials");
        (figures.location() * trials as f64, figures.symmetric_interval)
    };
    // adding the trials one by one moves the sum by a value that one trial can have
    for trials in [1023, 1024, 1025, 4095, 70_000] {
        let ((shorter, _), (longer, _)) = (sum(trials), sum(trials + 1));
        assert!((longer - shorter).abs() < 6.0, "{trials}");
    }
}

/// Inputs keep their draws when others are added or the order changes: their streams go by name.
#[test]
fn an_input_keeps_its_draws_whatever_stands_beside_it() {
    let one = r#""x": {"distribution": "normal", "mean": 0, "std": 1}"#;
    let other = r#""w": {"distribution": "rectangular", "mean": 0, "half_width": 1}"#;
    let interval = |inputs: &[&str]| {
        let inputs = inputs.join(", ");
        let text = format!(
            r#"{{"inputs": {{{inputs}}}, "equations": {{"y": "x^3"}}, "outputs": {{"y": {{}}}},
                "monte_carlo": {{"trials": 50000}}}}"#
        );
        let task = read_text("draws", &text, Path::new(""), &[]).expect("a right model").task;
        figures(&evaluate(&task, &Control::default()).expect("an evaluation"))
    };
    let alone = interval(&[one]);
    assert_eq!(alone, interval(&[one, other]));
    assert_eq!(alone, interval(&[other, one]));
}

/// A system that gives no threads, as a container with a limit of processes: one thread does the work,
/// with one sentence about it and the same bytes. Here every thread is to have a stack that no address
/// space holds, so that the system refuses it.
#[cfg(target_os = "linux")]
#[test]
fn without_threads_the_answer_is_the_same() {
    let plane = ["models/inclined_plane.json", "--trials", "20000", "--format", "json"];
    let sweep = ["models/inclined_plane_campaign.json", "--trials", "20000", "--format", "csv"];
    let certificate = ["models/certificates/three_axis_accelerometer.json", "--trials", "20000"];
    for (name, arguments, threads) in [
        ("run", &plane[..], &[][..]),
        ("run", &plane, &["--threads", "4"]),
        ("run", &sweep, &[]),
        ("assumptions", &plane, &[]),
        ("certificate", &certificate, &["--threads", "1"]),
    ] {
        let done = |stack: &str| {
            let mut run = command();
            run.current_dir(root()).env("RUST_MIN_STACK", stack);
            let run = run.arg(name).args(arguments).args(threads).arg("--quiet").output().unwrap();
            let said = String::from_utf8_lossy(&run.stderr).into_owned();
            assert_eq!(run.status.code(), Some(0), "{name} {arguments:?}: {said}");
            (run.stdout, said)
        };
        let (usual, said) = done("2097152");
        assert_eq!(said, "", "{name} {arguments:?}");
        let (without, said) = done("1000000000000000");
        assert!(usual == without && usual.len() > 500, "{name} {arguments:?}");
        assert_eq!(said.lines().count(), 1, "{said}");
        assert!(said.starts_with("warning: the system provides no threads ("), "{said}");
    }
    let mut open = command();
    open.current_dir(root()).args(["open", "models", "--no-browser"]);
    let refused = open.env("RUST_MIN_STACK", "1000000000000000").output().unwrap();
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert_eq!(refused.status.code(), Some(1), "{said}");
    assert!(said.contains("the server: "), "{said}");
}
