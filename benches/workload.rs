//! One workload in a process of its own: prints CPU time and wall time of each repeat, the most
//! memory that the process has held, and the figures, as one line of JSON.
//!
//! ```text
//! cargo bench --bench workload -- --workload W1 --trials 1e7 --threads 2 --path avx2
//! ```
//!
//! With `--on-demand` it makes one repeat for each line of standard input, so that several tools
//! can be measured in turn; it answers `ready` after the warm-up and `done` after each repeat, and
//! prints the JSON at the end of input. Without a workload it tries all of them on a few trials.
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(missing_docs, clippy::print_stderr)]

mod measure;

use std::fmt::Display;
use std::io::{BufRead, Write};
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use cpu_time::ProcessTime;
use gumption::number::CodePath;
use gumption::propagate::gum::Dof;
use gumption::propagate::{Control, Evaluation, OutputEvaluation, evaluate};
use gumption::task::{Task, Trials};
use gumption_engine::propagate::gum::bulk::Budgets;
use serde_json::{Value, json};

use measure::columns::Columns;
use measure::workloads::workload;

/// Trials of the warm-up of a single evaluation.
const WARM_UP: u64 = 20_000;

/// Trials of the warm-up of each row of a sweep, and budgets of that of W5.
const WARM_UP_ROW: u64 = 1000;

#[derive(Debug, Parser)]
struct Arguments {
    /// W1, W1-formula, W2, W3, W4, W5, W5-all, W5-rows, sum:N, correlated:N, formula:N or outputs:N.
    #[arg(long)]
    workload: Option<String>,
    /// Trials of each row, such as 1e6, or `adaptive`; for W5 the number of budgets.
    #[arg(long, default_value = "1e6")]
    trials: String,
    /// Threads; 0 for as many as the machine has.
    #[arg(long, default_value_t = 1)]
    threads: usize,
    /// Code path: baseline, avx2, avx512; the machine's best without it.
    #[arg(long)]
    path: Option<CodePath>,
    /// Repeats after the warm-up.
    #[arg(long, default_value_t = 5)]
    repeats: usize,
    /// Kept values in MiB.
    #[arg(long, default_value_t = 64)]
    memory: usize,
    /// Digits that an adaptive run is to settle.
    #[arg(long, default_value_t = 3)]
    digits: u32,
    /// One repeat for each line of standard input.
    #[arg(long)]
    on_demand: bool,
    /// Prints the code paths of this machine, slowest first.
    #[arg(long)]
    paths: bool,
    /// Passed by `cargo bench`.
    #[arg(long, hide = true)]
    bench: bool,
}

/// The most memory that the process has held so far, in MB (1e6 bytes); where the system tells.
fn peak() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kibibytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kibibytes * 1024.0 / 1e6)
}

/// A count such as `1000` or `1e6`.
fn count(text: &str) -> Result<u64, String> {
    let wrong = || format!("`{text}` is no number of trials, such as 1000 or 1e6");
    let value: f64 = text.parse().map_err(|_| wrong())?;
    if value.fract() == 0.0 && (0.0..=1e15).contains(&value) {
        Ok(value as u64)
    } else {
        Err(wrong())
    }
}

/// One output's figures and their numerical standard errors.
fn figures(output: &OutputEvaluation) -> Value {
    if let Some(y) = &output.monte_carlo {
        let errors = &y.errors;
        return json!({
            "mean": y.estimate,
            "u": y.standard_uncertainty,
            "symmetric": y.symmetric_interval,
            "shortest": y.shortest_interval,
            "errors": {
                "mean": errors.estimate,
                "u": errors.standard_uncertainty,
                "symmetric": errors.symmetric_interval,
                "shortest": errors.shortest_interval,
            },
        });
    }
    output.gum.as_ref().map_or(Value::Null, |gum| {
        let dof = if let Dof::Finite(dof) = gum.dof { Some(dof) } else { None };
        json!({"mean": gum.estimate, "u": gum.standard_uncertainty, "dof": dof})
    })
}

/// The outputs of the first row and of the last.
fn result(evaluation: &Evaluation) -> Value {
    let ends = [evaluation.rows.first(), evaluation.rows.last()];
    let outputs = ends.into_iter().flatten().flat_map(|row| &row.outputs);
    outputs.map(figures).collect()
}

/// The outputs of the first budget and of the last.
fn result_in_columns(budgets: &[Budgets]) -> Value {
    let of = |row: Option<usize>| {
        budgets.iter().zip(row).map(|(of, row)| {
            json!({"mean": of.estimates[row], "u": of.standard_uncertainties[row], "dof": of.dof[row]})
        }).collect::<Vec<_>>()
    };
    let last = budgets.first().and_then(|of| of.estimates.len().checked_sub(1));
    of(last.map(|_| 0)).into_iter().chain(of(last)).collect()
}

fn trials_made(evaluation: &Evaluation) -> Option<u64> {
    Some(evaluation.rows.first()?.outputs.first()?.monte_carlo.as_deref()?.trials)
}

/// A line on standard output; an error if nobody reads it any more.
fn say(line: impl Display) -> Result<(), String> {
    let mut out = std::io::stdout();
    writeln!(out, "{line}").and_then(|()| out.flush()).map_err(|e| e.to_string())
}

/// The task and that of its warm-up.
fn tasks(name: &str, arguments: &Arguments) -> Result<[Task; 2], String> {
    let adaptive = arguments.trials == "adaptive";
    let trials = if adaptive { WARM_UP } else { count(&arguments.trials)? };
    let few = if name == "W3" || name.starts_with("W5") { WARM_UP_ROW } else { WARM_UP };
    let mut task = workload(name, trials)?;
    if adaptive {
        task.settings.trials = Trials::Adaptive;
        task.settings.digits = arguments.digits;
    }
    Ok([task, workload(name, few.min(trials))?])
}

/// What the last repeat gave.
#[derive(Default)]
struct Last {
    evaluation: Option<Evaluation>,
    budgets: Vec<Budgets>,
}

fn measured(name: &str, arguments: &Arguments) -> Result<Value, String> {
    let [task, warm_up] = tasks(name, arguments)?;
    let control = Control::default()
        .with_threads(arguments.threads)
        .with_memory(arguments.memory << 20)
        .with_path(arguments.path.unwrap_or_else(CodePath::best));
    let columns = matches!(name, "W5" | "W5-all").then(|| Columns::of(&task, name == "W5-all"));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(arguments.threads).build();
    let pool = pool.map_err(|e| e.to_string())?;
    evaluate(&warm_up, &control).map_err(|e| e.to_string())?;
    let before = peak();
    let (mut cpu, mut wall, mut last) = (Vec::new(), Vec::new(), Last::default());
    let mut repeat = || {
        let (clock, start) = (ProcessTime::now(), Instant::now());
        let made = match &columns {
            Some(columns) => {
                let budgets = pool.install(|| columns.budgets(control.path))?;
                Last { budgets, evaluation: None }
            }
            None => {
                let evaluation = evaluate(&task, &control).map_err(|e| e.to_string())?;
                Last { budgets: Vec::new(), evaluation: Some(evaluation) }
            }
        };
        cpu.push(clock.elapsed().as_secs_f64());
        wall.push(start.elapsed().as_secs_f64());
        last = made;
        Ok::<(), String>(())
    };
    if arguments.on_demand {
        say("ready")?;
        for line in std::io::stdin().lock().lines() {
            line.map_err(|e| e.to_string())?;
            repeat()?;
            say("done")?;
        }
    } else {
        for _ in 0..arguments.repeats {
            repeat()?;
        }
    }
    Ok(json!({
        "tool": "gumption",
        "workload": name,
        "trials": last.evaluation.as_ref().and_then(trials_made),
        "rows": task.rows.len(),
        "threads": arguments.threads,
        "path": control.path.name(),
        "cpu_s": cpu,
        "wall_s": wall,
        "before_mb": before,
        "peak_mb": peak(),
        "result": last.evaluation.as_ref().map_or_else(|| result_in_columns(&last.budgets), result),
    }))
}

/// Every workload on a few trials.
fn tried() -> Result<(), String> {
    let names =
        "W1 W1-formula W2 W3 W4 W5 W5-all W5-rows sum:10 correlated:10 formula:100 outputs:10";
    let arguments = Arguments::parse_from(["workload", "--trials", "1000", "--repeats", "1"]);
    for name in names.split_whitespace() {
        say(measured(name, &arguments)?)?;
    }
    Ok(())
}

fn main() -> ExitCode {
    // as the program does
    gumption_command::freed_memory::keep();
    let arguments = Arguments::parse();
    let paths = CodePath::available().into_iter().map(CodePath::name).collect::<Vec<_>>();
    let done = match &arguments.workload {
        _ if arguments.paths => say(paths.join(",")),
        Some(name) => measured(name, &arguments).and_then(say),
        None => tried(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}
