//! The gate: how many times faster the engine is than a fixed plain loop in the same binary, in CPU
//! time, against the ratios that were recorded. Absolute times say nothing on a shared machine;
//! ratios of work measured in turn do.
//!
//! ```text
//! cargo bench --bench gate                      compares; exit code 1 below 80 % of the record
//! cargo bench --bench gate -- --record          writes the record of this machine's code path
//! cargo bench --bench gate -- --path baseline   slowed down on purpose: must fail
//! ```
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(missing_docs, clippy::print_stdout, clippy::print_stderr)]

mod measure;

use std::hint::black_box;
use std::process::ExitCode;

use clap::Parser;
use gumption::number::CodePath;
use gumption::propagate::{Control, evaluate};
use gumption::task::Task;
use serde_json::{Map, Value, json};

use measure::cpu_time::cpu_seconds;
use measure::median::median;
use measure::plain;
use measure::workloads::workload;

/// Measurements in turn behind each median.
const ROUNDS: usize = 9;

/// The share of a recorded ratio that must be reached.
const FLOOR: f64 = 0.8;

const RECORD: &str = "benches/recorded.json";

/// Workloads and their trials (of each row), enough of them for some hundredths of a second.
const CASES: [(&str, u64); 4] =
    [("W1", 1_000_000), ("W2", 2_000_000), ("W3", 10_000), ("W4", 1_000_000)];

#[derive(Debug, Parser)]
struct Arguments {
    /// Writes the ratios to the record instead of comparing them with it.
    #[arg(long)]
    record: bool,
    /// A code path to measure instead of the machine's best; the record is that of the best.
    #[arg(long)]
    path: Option<CodePath>,
    /// Passed by `cargo bench`; without it everything is only tried.
    #[arg(long, hide = true)]
    bench: bool,
}

/// CPU time of the plain loop over that of the task, each a trial: one measurement of both.
fn ratio(task: &Task, path: CodePath) -> Result<f64, String> {
    let control = Control::default().with_threads(1).with_path(path);
    let mut done = Ok(());
    let loop_seconds = cpu_seconds(|| {
        black_box(plain::run());
    });
    let seconds = cpu_seconds(|| {
        done = evaluate(task, &control).map(|evaluation| {
            black_box(evaluation);
        });
    });
    done.map_err(|error| error.to_string())?;
    Ok(loop_seconds / seconds)
}

/// The median ratio of each case, scaled to equal numbers of trials.
fn ratios(path: CodePath, rounds: usize, share: u64) -> Result<Vec<f64>, String> {
    let mut tasks = Vec::new();
    for (name, trials) in CASES {
        tasks.push(workload(name, trials / share)?);
    }
    let mut measured = vec![Vec::new(); tasks.len()];
    // the first round warms up
    for round in 0..=rounds {
        for ((task, (_, trials)), ratios) in tasks.iter().zip(CASES).zip(&mut measured) {
            let all = (trials / share) as f64 * task.rows.len() as f64;
            let ratio = ratio(task, path)? * all / plain::TRIALS as f64;
            if round > 0 {
                ratios.push(ratio);
            }
        }
    }
    Ok(measured.into_iter().map(median).collect())
}

fn recorded() -> Result<Map<String, Value>, String> {
    let text = std::fs::read_to_string(RECORD).map_err(|e| format!("{RECORD}: {e}"))?;
    serde_json::from_str(&text).map_err(|e| format!("{RECORD}: {e}"))
}

fn record(path: CodePath, ratios: &[f64]) -> Result<(), String> {
    let mut record = recorded().unwrap_or_default();
    let cases = CASES.iter().zip(ratios);
    let of_path: Map<String, Value> =
        cases.map(|(&(name, _), r)| (name.to_owned(), json!((r * 10.0).round() / 10.0))).collect();
    record.insert(path.name().to_owned(), Value::Object(of_path));
    let text = serde_json::to_string_pretty(&record).map_err(|e| e.to_string())?;
    std::fs::write(RECORD, text + "\n").map_err(|e| format!("{RECORD}: {e}"))
}

/// Whether all ratios reach their floor.
fn compare(best: CodePath, measured: CodePath, ratios: &[f64]) -> Result<bool, String> {
    let record = recorded()?;
    let mut passed = true;
    println!("times the speed of the plain loop, median of {ROUNDS}, path {}", measured.name());
    for ((name, _), ratio) in CASES.iter().zip(ratios) {
        let found = record.get(best.name()).and_then(|of_path| of_path.get(*name)?.as_f64());
        let found = found.ok_or_else(|| {
            format!("{RECORD} has no ratio of {name} for {}; make one with --record", best.name())
        })?;
        let share = ratio / found;
        let verdict = if share >= FLOOR { "ok" } else { "TOO SLOW" };
        passed &= share >= FLOOR;
        println!(
            "  {name:<4} {ratio:6.1}  recorded {found:6.1}  {:4.0} %  {verdict}",
            100.0 * share
        );
    }
    Ok(passed)
}

fn run(arguments: &Arguments) -> Result<bool, String> {
    if !plain::is_right() {
        return Err("the plain loop computes something else".to_owned());
    }
    let best = CodePath::best();
    let path = arguments.path.unwrap_or(best);
    if !arguments.bench {
        // `cargo test --benches` only tries whether everything runs
        return ratios(path, 1, 100).map(|_| true);
    }
    let ratios = ratios(path, ROUNDS, 1)?;
    if arguments.record {
        record(path, &ratios)?;
        println!("{}: {ratios:.1?} written to {RECORD}", path.name());
        return Ok(true);
    }
    compare(best, path, &ratios)
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}
