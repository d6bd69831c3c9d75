//! Answers of every command to the last bit, on any processor.
//!
//! `tests/data/answers.csv` holds a hash over every answer (of `run` with all moments and numerical
//! errors), so that a change of any digit is seen. `GUMPTION_GOLDEN=write cargo test --test all golden`
//! writes it and the hashes over all trials anew; such a change belongs into the changelog.

use std::fs;
use std::path::Path;

use sha2::{Digest, Sha256};

use crate::process::Command;
use crate::support::{command, file_name, model_files, root};

/// Turns the C library's kernels with fused products off, as on a processor without them.
#[cfg(all(target_arch = "x86_64", target_os = "linux", target_env = "gnu"))]
const WITHOUT_FUSED_PRODUCTS: &str = "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F,-AVX512VL";

/// Trials of `run`: enough for every branch of the intervals and moments.
const TRIALS: &str = "100000";

/// A command, the files that it is asked about, and its own arguments.
type Question = (&'static str, String, Vec<&'static str>);

/// Every ready file, with the command that answers it.
fn questions() -> Vec<Question> {
    let of = |command, folder: &'static str, file: &'static str| {
        let entries = fs::read_dir(root().join(folder)).expect("a folder of ready files");
        let mut paths: Vec<String> = entries
            .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
            .filter(|name| root().join(folder).join(name).join(file).is_file())
            .map(|name| format!("{folder}/{name}/{file}"))
            .collect();
        paths.sort();
        paths.into_iter().map(move |path| (command, path, vec!["--format", "json"]))
    };
    let mut questions: Vec<_> = of("gap", "models/gap", "case.json").collect();
    questions.extend(of("observe", "models/recordings", "recipe.json"));
    assert!(questions.len() >= 12, "only {} ready files", questions.len());
    for path in model_files() {
        let path = format!("models/{}", file_name(&path));
        questions.push(("run", path, vec!["--trials", TRIALS, "--format", "json"]));
    }
    let mut one = |command, path: &str, arguments: &[&'static str]| {
        questions.push((command, path.to_owned(), arguments.to_vec()));
    };
    let json = ["--format", "json"];
    // pages: figures, and what is rounded for people
    one("run", "models/phase_budget.json", &["--trials", TRIALS, "--format", "html"]);
    one("gap", "models/gap/radius/case.json", &["--format", "html"]);
    one("gap-check", "models/gap/radius/case.json", &["--draws", "2", "--format", "json"]);
    for path in ["models/inclined_plane.json", "models/spurious_component.json"] {
        one("assumptions", path, &json);
    }
    one("compare", "tests/data/pairs.csv", &json);
    one("diff", "models/sensitivity.json models/sensitivity_datasheet.json", &json);
    one("diff", "models/rotating_table.json models/rotating_table_instant.json", &json);
    for format in ["csv", "dcc"] {
        let path = "models/certificates/three_axis_accelerometer.json";
        one("certificate", path, &["--format", format]);
    }
    questions
}

/// Diagnoses that take several seconds each.
const SLOW: [&str; 3] = ["gap/iepe_signal/", "gap/lateral_motion/", "gap/plane_resonance/"];

/// Those that do not take seconds.
fn quick_questions() -> Vec<Question> {
    let is_quick = |(_, path, _): &Question| !SLOW.iter().any(|slow| path.contains(slow));
    questions().into_iter().filter(is_quick).collect()
}

/// One line for each answer.
fn lines(questions: Vec<Question>, environment: &dyn Fn(&mut Command)) -> Vec<String> {
    let line = |(verb, paths, arguments): Question| {
        let mut run = command();
        run.current_dir(root()).arg(verb).args(paths.split(' ')).args(&arguments).arg("--quiet");
        environment(&mut run);
        let run = run.output().expect("the program runs");
        assert!(run.status.success(), "{verb} {paths}: {}", String::from_utf8_lossy(&run.stderr));
        let hash: String =
            Sha256::digest(&run.stdout).iter().map(|byte| format!("{byte:02x}")).collect();
        format!("{verb},{paths},{},{hash}", arguments.join(" "))
    };
    questions.into_iter().map(line).collect()
}

fn file() -> std::path::PathBuf {
    Path::new(root()).join("tests/data/answers.csv")
}

fn golden() -> Vec<String> {
    let text = fs::read_to_string(file()).expect("tests/data/answers.csv");
    text.lines().skip(1).map(str::to_owned).collect()
}

/// The answers have the hashes of the list.
fn assert_golden(questions: Vec<Question>, environment: &dyn Fn(&mut Command)) {
    let golden = golden();
    for line in lines(questions, environment) {
        assert!(golden.contains(&line), "the answer has changed: {line}");
    }
}

#[test]
fn golden_answers() {
    if std::env::var_os("GUMPTION_GOLDEN").is_some_and(|value| value == "write") {
        let lines = lines(questions(), &|_| {}).join("\n");
        let text = format!("command,file,arguments,sha256\n{lines}\n");
        fs::write(file(), text).expect("the list is written");
    }
    assert_eq!(golden().len(), questions().len(), "answers without a hash");
    assert_golden(quick_questions(), &|_| {});
}

#[test]
#[ignore = "heavy: run by .ci/extra"]
fn all_golden_answers() {
    assert_golden(questions(), &|_| {});
}

/// Without the kernels of the C library that a processor with fused products gets.
#[cfg(all(target_arch = "x86_64", target_os = "linux", target_env = "gnu"))]
fn without_fused_products(run: &mut Command) {
    run.env("GLIBC_TUNABLES", WITHOUT_FUSED_PRODUCTS);
}

/// The C library chooses among kernels of its functions by what the processor can. An answer that
/// took one of them would differ here. Every kind of question is asked; those of diagnoses, and five of
/// six of the others, are left to the next test.
#[test]
#[cfg(all(target_arch = "x86_64", target_os = "linux", target_env = "gnu"))]
fn answers_do_not_depend_on_the_c_library_s_kernels() {
    let few = questions().into_iter().enumerate().filter(|(number, (command, path, _))| {
        if *command == "gap" { path.contains("gap/radius/") } else { number % 6 == 0 }
    });
    assert_golden(few.map(|(_, question)| question).collect(), &without_fused_products);
}

#[test]
#[cfg(all(target_arch = "x86_64", target_os = "linux", target_env = "gnu"))]
#[ignore = "heavy: run by .ci/extra"]
fn no_answer_depends_on_the_c_library_s_kernels() {
    assert_golden(questions(), &without_fused_products);
}
