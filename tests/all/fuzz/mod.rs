//! Model files, gap cases, tables, samples and saved results that are made by a grammar and damaged,
//! always the same ones: whatever they say, reading and evaluating them ends with an answer that
//! makes sense or with mistakes that point into their text, never with a panic.
//!
//! `GUMPTION_FUZZ=SEED:CASES cargo test --test all fuzz` makes others, and as many as are wanted.

mod answer;
mod choices;
mod folder;
mod grammar;
mod mutation;

use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, OnceLock};

use gumption::file::{check_text, read_text};
use serde_json::Value;

use choices::Choices;
use folder::Folder;

use crate::support::{model_files, root};

/// Cases without a wish of the user.
const CASES: u64 = 1_000;

/// Every so manieth case is given to the program itself, in a limited address space.
const PROGRAM: u64 = 200;

/// Seed and number of cases.
fn wanted(cases: u64) -> (u64, u64) {
    let wanted = std::env::var("GUMPTION_FUZZ").ok();
    let wanted = wanted.as_deref().and_then(|text| {
        let (seed, cases) = text.split_once(':')?;
        Some((seed.parse().ok()?, cases.parse().ok()?))
    });
    wanted.unwrap_or((1, cases))
}

/// A file as text and as what the text says.
struct Right {
    path: PathBuf,
    text: String,
    value: Value,
}

/// The files at some paths that are JSON, in the order of their paths.
fn files(paths: impl IntoIterator<Item = PathBuf>) -> Vec<Right> {
    let mut paths: Vec<PathBuf> = paths.into_iter().collect();
    paths.sort();
    let read = |path: PathBuf| {
        let text = std::fs::read_to_string(&path).ok()?;
        let value = serde_json::from_str(&text).ok()?;
        // the longest ones would take most of the time
        (text.len() < 20_000).then_some(Right { path, text, value })
    };
    paths.into_iter().filter_map(read).collect()
}

/// The files of a folder, or a file in each of its folders.
fn entries(folder: &str, file: &str) -> impl Iterator<Item = PathBuf> {
    let entries = std::fs::read_dir(root().join(folder)).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    paths.map(move |path| if path.is_dir() { path.join(file) } else { path })
}

/// Right model files to change: the ready models, their forms in formulas, and the examples.
fn models() -> &'static [Right] {
    static FILES: OnceLock<Vec<Right>> = OnceLock::new();
    FILES.get_or_init(|| {
        let others = ["models/formulas", "tests/cases"];
        let others = others.into_iter().flat_map(|folder| entries(folder, "model.json"));
        files(model_files().into_iter().chain(others))
    })
}

/// Right cases of the gap diagnosis to change.
fn cases() -> &'static [Right] {
    static FILES: OnceLock<Vec<Right>> = OnceLock::new();
    FILES.get_or_init(|| files(entries("models/gap", "case.json")))
}

/// The keys of all right files.
fn keys() -> &'static [String] {
    fn collect(value: &Value, keys: &mut BTreeSet<String>) {
        match value {
            Value::Array(items) => items.iter().for_each(|item| collect(item, keys)),
            Value::Object(members) => {
                for (key, value) in members {
                    keys.insert(key.clone());
                    collect(value, keys);
                }
            }
            _ => {}
        }
    }
    static KEYS: OnceLock<Vec<String>> = OnceLock::new();
    KEYS.get_or_init(|| {
        let mut keys = BTreeSet::new();
        models().iter().chain(cases()).for_each(|file| collect(&file.value, &mut keys));
        collect(&serde_json::from_str(folder::result()).expect("JSON"), &mut keys);
        keys.into_iter().collect()
    })
}

/// What is fed to the reader.
enum Case {
    /// A model file.
    Model(String),
    /// A gap case, with the folder of its data.
    Gap(String, &'static Path),
}

/// The case of a number; files that it names are changed in the folder.
fn case(choices: &mut Choices, folder: &Folder) -> Case {
    let formula = |formula: String| {
        let x = r#"{"distribution": "normal", "mean": 0.5, "std": 1e-3}"#;
        let t = r#"{"unit": "degC", "distribution": "rectangular", "mean": 20, "half_width": 1}"#;
        format!(
            r#"{{"inputs": {{"x": {x}, "t": {t}}}, "check_units": false, "allow_undefined": 1,
              "equations": {{"y": "{formula}"}}, "outputs": {{"y": {{}}}}}}"#
        )
    };
    let times = choices.pick(&[0, 1, 1, 1, 2, 2, 3, 6]);
    let right = choices.below(models().len());
    let mut file = match choices.below(100) {
        0 => return Case::Model(choices.text()),
        1..=4 => return Case::Model(formula(grammar::signs(choices))),
        5..=8 => {
            let case = &cases()[choices.below(cases().len())];
            let mut file = case.value.clone();
            for _ in 0..times / 2 {
                mutation::mutate(choices, &mut file);
            }
            let text = if times < 2 { case.text.clone() } else { file.to_string() };
            let times = choices.below(4);
            let text = mutation::damage(choices, &text, times);
            return Case::Gap(text, case.path.parent().expect("a folder"));
        }
        9..=20 => return Case::Model(mutation::damage(choices, &models()[right].text, times)),
        21..=60 => grammar::model(choices),
        _ => models()[right].value.clone(),
    };
    for _ in 0..times {
        mutation::mutate(choices, &mut file);
    }
    if choices.chance(15) {
        folder.change(choices);
    }
    let times = usize::from(choices.chance(8));
    Case::Model(mutation::damage(choices, &file.to_string(), times))
}

impl Case {
    /// Reads and evaluates it, and checks what comes out. Whether it was right.
    fn answer(&self, folder: &Folder, program: bool) -> bool {
        match self {
            Self::Model(text) => {
                if program {
                    answer::of_program(text, folder);
                }
                answer::of(text, folder.path())
            }
            // reading a case tries all of its effects at all of its data
            Self::Gap(text, data) => {
                let checked =
                    [*data, Path::new("no folder")].map(|at| check_text("case", text, at));
                let [in_place, _] = checked.map(|of| of.map_err(|e| answer::explained(&e)).is_ok());
                in_place
            }
        }
    }

    fn text(&self) -> &str {
        match self {
            Self::Model(text) | Self::Gap(text, _) => text,
        }
    }
}

#[test]
fn whatever_a_file_says_is_answered() {
    let (seed, cases) = wanted(CASES);
    let next = AtomicU64::new(0);
    let failed: Mutex<Vec<String>> = Mutex::default();
    let read = AtomicU64::new(0);
    let threads = std::thread::available_parallelism().map_or(2, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                let folder = Folder::new();
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    if number >= cases || failed.lock().unwrap().len() >= 5 {
                        break;
                    }
                    // every case finds the folder as it was, so that its number is all that counts
                    folder.restore();
                    let case = case(&mut Choices::of(seed, number), &folder);
                    let work = || case.answer(&folder, number.is_multiple_of(PROGRAM));
                    match catch_unwind(AssertUnwindSafe(work)) {
                        Ok(right) => {
                            read.fetch_add(u64::from(right), Ordering::Relaxed);
                        }
                        Err(panic) => {
                            let said = panic.downcast_ref::<String>().map(String::as_str);
                            let said = said.or_else(|| panic.downcast_ref::<&str>().copied());
                            let said = said.unwrap_or("?");
                            let text = format!("case {seed}:{number}: {said}\n{}\n", case.text());
                            failed.lock().unwrap().push(text);
                        }
                    }
                }
            });
        }
    });
    let failed = failed.into_inner().unwrap();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    // a grammar whose files are all refused would show little
    let read = read.into_inner();
    assert!(10 * read > cases || cases < 100, "{read} of {cases} files are right");
    crate::support::announce(&format!("fuzzing: {read} of {cases} files are right"));
}

/// One case by its number, for a closer look: `GUMPTION_FUZZ=SEED:NUMBER cargo test one_case --
/// --ignored --nocapture`.
#[test]
#[ignore = "for a closer look at a case"]
fn one_case() {
    let (seed, number) = wanted(0);
    let folder = Folder::new();
    let case = case(&mut Choices::of(seed, number), &folder);
    println!("{}", case.text());
    println!("{}", if case.answer(&folder, true) { "right" } else { "refused" });
}

/// The right files are right in the folder of the cases, so that what is found wrong in a case is
/// due to its changes.
#[test]
fn right_files_are_right() {
    let folder = Folder::new();
    let right = |file: &&Right| read_text("m", &file.text, folder.path(), &[]).is_ok();
    let count = models().iter().filter(right).count();
    let wrong = models().len() - count;
    // the examples of wrong files are among them
    assert!(count > 100 && wrong <= 8, "{count} right, {wrong} wrong");
    assert!(cases().len() >= 9);
}

/// Every distribution at the ends of what its parameters may be, in formulas that leave the range of
/// doubles.
#[test]
fn extremes_are_answered() {
    let folder = Folder::new();
    for input in [
        r#""normal", "mean": 1e308, "std": 1e308"#,
        r#""normal", "mean": 0, "std": 5e-324"#,
        r#""normal", "mean": 1, "std": 1e-300"#,
        r#""rectangular", "lower": -1.7e308, "upper": 1.7e308"#,
        r#""rectangular", "mean": 1, "half_width": 5e-324"#,
        r#""triangular", "lower": 0, "upper": 5e-324"#,
        r#""t", "mean": 0, "scale": 1, "dof": 1e-300"#,
        r#""t", "mean": 0, "scale": 1, "dof": 0.5"#,
        r#""t", "mean": 0, "scale": 1e-320, "dof": 1e300"#,
        r#""normal", "mean": 0, "std": 1, "dof": 1e-5"#,
        r#""normal", "mean": 0, "expanded": 1, "p": 0.9999999999999999"#,
        r#""normal", "mean": 0, "expanded": 1, "p": 1e-300"#,
        r#""normal", "mean": 0, "expanded": 1, "p": 0.95, "dof": 1e-3"#,
        r#""normal", "mean": 0, "expanded": 1, "k": 5e-324"#,
        r#""readings", "values": [1e308, -1e308]"#,
        r#""readings", "values": [1, 1.0000000000000002]"#,
        r#""readings", "values": [5e-324, 0]"#,
        r#""constant", "value": 1e308"#,
        r#""trapezoidal", "lower": -1.7e308, "upper": 1.7e308, "beta": 1"#,
        r#""trapezoidal", "lower": 0, "upper": 5e-324, "beta": 0"#,
        r#""curvilinear-trapezoid", "lower": 0, "upper": 1, "inexactness": 0.5"#,
        r#""curvilinear-trapezoid", "lower": 0, "upper": 1e308, "inexactness": 5e-324"#,
        r#""arcsine", "mean": 0, "half_width": 1.7e308"#,
        r#""exponential", "mean": 1.7e308"#,
        r#""exponential", "mean": 5e-324"#,
        r#""gamma", "shape": 1e-300, "rate": 1e300"#,
        r#""gamma", "shape": 1e300, "rate": 1e-300"#,
        r#""gamma", "shape": 1e300, "rate": 1e300"#,
        r#""lognormal", "mean": 1e300, "std": 5e-324"#,
        r#""lognormal", "mean": 5e-324, "std": 1e300"#,
        r#""beta", "alpha": 1e-300, "beta": 1e-300"#,
        r#""beta", "alpha": 1e300, "beta": 1e300"#,
        r#""beta", "alpha": 1e-300, "beta": 1e300, "lower": -1e308, "upper": 1e308"#,
        r#""log-uniform", "lower": 5e-324, "upper": 1.7e308"#,
        r#""log-uniform", "lower": 1, "upper": 1.0000000000000002"#,
        r#""poisson-count", "count": 0"#,
        r#""poisson-count", "count": 999999999999999"#,
        r#""samples", "values": [1e308, -1e308, 1e308]"#,
        r#""samples", "values": [5e-324]"#,
    ] {
        for equation in ["x", "x*x", "1/x", "exp(x)", "x - x", "x^x", "0*x", "x > 0", "1e308*x"] {
            let text = format!(
                r#"{{"inputs": {{"x": {{"distribution": {input}}}}},
                    "equations": {{"y": "{equation}"}}, "outputs": {{"y": {{}}}}}}"#
            );
            answer::of(&text, folder.path());
        }
    }
}
