//! Whole evaluations: both methods with all their figures, as `gumption run` makes them.
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

mod measure;

use std::hint::black_box;

use criterion::{Criterion, Throughput};
use gumption::propagate::{Control, evaluate};
use gumption::task::Task;

use measure::cpu_time::{CpuTime, cpu_seconds, criterion};
use measure::median::median;
use measure::workloads::{BLOCK, CAMPAIGN, PLANE, PLANE_FORMULA, SUM, model, workload};

const TRIALS: u64 = 1_000_000;

/// Trials of each of the 384 conditions.
const CAMPAIGN_TRIALS: u64 = 10_000;

/// Budgets of the inclined plane.
const BUDGETS: u64 = 100_000;

/// Runs of each kind behind the medians of the summary.
const ROUNDS: usize = 15;

fn run(task: &Task, threads: usize) {
    let control = Control::default().with_threads(threads);
    black_box(evaluate(black_box(task), &control).unwrap());
}

fn whole_runs(criterion: &mut Criterion<CpuTime>) {
    let mut group = criterion.benchmark_group("run");
    let cases = [
        ("plane, typed (W1)", PLANE, TRIALS, TRIALS),
        ("plane, formula", PLANE_FORMULA, TRIALS, TRIALS),
        ("sum (W2)", SUM, TRIALS, TRIALS),
        ("campaign (W3)", CAMPAIGN, CAMPAIGN_TRIALS, 384 * CAMPAIGN_TRIALS),
        ("gauge block (W4)", BLOCK, TRIALS, TRIALS),
    ];
    for (name, text, trials, elements) in cases {
        let task = model(text, trials).unwrap();
        group.throughput(Throughput::Elements(elements));
        group.bench_function(name, |bencher| bencher.iter(|| run(&task, 1)));
    }
    group.finish();
}

/// The law of propagation without trials, and reading the file that it starts from.
fn without_trials(criterion: &mut Criterion<CpuTime>) {
    let mut group = criterion.benchmark_group("without trials");
    let typed = model(PLANE, 0).unwrap();
    group.bench_function("plane, GUM", |bencher| bencher.iter(|| run(&typed, 1)));
    let read = |text| black_box(model(black_box(text), 0).unwrap());
    group.bench_function("plane, reading the typed file", |b| b.iter(|| read(PLANE)));
    group.bench_function("plane, reading the formulas", |b| b.iter(|| read(PLANE_FORMULA)));
    let budgets = workload("W5", BUDGETS).unwrap();
    group.throughput(Throughput::Elements(BUDGETS));
    group.bench_function("budgets of the plane (W5)", |bencher| bencher.iter(|| run(&budgets, 1)));
    group.finish();
}

/// The same work in turn, so that a change of the machine's speed meets all alike.
fn summary() {
    let tasks = [PLANE, PLANE_FORMULA, SUM, BLOCK].map(|text| model(text, TRIALS).unwrap());
    let cases: Vec<(&Task, usize)> =
        tasks.iter().flat_map(|task| [1, 2].map(|threads| (task, threads))).collect();
    let seconds = |&(task, threads): &(&Task, usize)| cpu_seconds(|| run(task, threads));
    let rounds: Vec<Vec<f64>> = (0..ROUNDS).map(|_| cases.iter().map(seconds).collect()).collect();
    let column = |case: usize| rounds.iter().map(|round| round[case]).collect::<Vec<_>>();
    println!("million trials per second of CPU time, median of {ROUNDS} runs in turn");
    let names = ["plane, typed", "plane, formula", "sum", "gauge block"];
    for (place, name) in names.into_iter().enumerate() {
        let rate = |case: usize| TRIALS as f64 / 1e6 / median(column(case));
        let [one, two] = [rate(2 * place), rate(2 * place + 1)];
        println!("  {name:<16} {one:6.1} on one thread, {two:6.1} on two");
    }
    let ratios = column(2).iter().zip(column(0)).map(|(formula, typed)| formula / typed).collect();
    println!("formula / typed, one thread: {:.2}", median(ratios));
}

fn main() {
    let mut criterion = criterion();
    whole_runs(&mut criterion);
    without_trials(&mut criterion);
    criterion.final_summary();
    // `cargo test --benches` only tries whether everything runs
    if !std::env::args().any(|argument| argument == "--test" || argument == "--list") {
        summary();
    }
}
