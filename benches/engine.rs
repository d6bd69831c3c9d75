//! Whole evaluations in CPU time: both methods with all their figures, as `gumption run` makes them.
#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

use cpu_time::ProcessTime;
use criterion::measurement::{Measurement, ValueFormatter, WallTime};
use criterion::{Criterion, Throughput};
use gumption::file::read_text;
use gumption::propagate::{Control, evaluate};
use gumption::task::{Task, Trials};

/// Trials of every run.
const TRIALS: u64 = 1_000_000;

/// Runs of each kind behind the medians of the summary.
const ROUNDS: usize = 15;

const TYPED: &str = include_str!("models/plane_typed.json");
const FORMULA: &str = include_str!("models/plane_formula.json");
const SUM: &str = include_str!("models/sum_of_four.json");

/// CPU time of the process: what other programs on the machine do costs wall time only.
struct CpuTime;

impl Measurement for CpuTime {
    type Intermediate = ProcessTime;
    type Value = Duration;

    fn start(&self) -> ProcessTime {
        ProcessTime::now()
    }

    fn end(&self, start: ProcessTime) -> Duration {
        start.elapsed()
    }

    fn add(&self, one: &Duration, other: &Duration) -> Duration {
        *one + *other
    }

    fn zero(&self) -> Duration {
        Duration::ZERO
    }

    fn to_f64(&self, value: &Duration) -> f64 {
        value.as_nanos() as f64
    }

    fn formatter(&self) -> &dyn ValueFormatter {
        WallTime.formatter()
    }
}

fn task(text: &str, trials: u64) -> Task {
    let mut task = read_text("model", text, Path::new(""), &[]).unwrap().task;
    task.settings.trials = Trials::Fixed(trials);
    task
}

fn run(task: &Task, threads: usize) {
    let control = Control { threads, ..Control::default() };
    black_box(evaluate(black_box(task), &control).unwrap());
}

fn whole_runs(criterion: &mut Criterion<CpuTime>) {
    let mut group = criterion.benchmark_group("run");
    group.throughput(Throughput::Elements(TRIALS)).sample_size(15);
    for (name, text) in [("plane, typed", TYPED), ("plane, formula", FORMULA), ("sum", SUM)] {
        let task = task(text, TRIALS);
        group.bench_function(name, |bencher| bencher.iter(|| run(&task, 1)));
    }
    group.finish();
}

/// The law of propagation without trials, and reading the file that it starts from.
fn without_trials(criterion: &mut Criterion<CpuTime>) {
    let mut group = criterion.benchmark_group("without trials");
    let typed = task(TYPED, 0);
    group.bench_function("plane, GUM", |bencher| bencher.iter(|| run(&typed, 1)));
    let read = |text| black_box(task(black_box(text), 0));
    group.bench_function("plane, reading the typed file", |b| b.iter(|| read(TYPED)));
    group.bench_function("plane, reading the formulas", |b| b.iter(|| read(FORMULA)));
    group.finish();
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn seconds(task: &Task, threads: usize) -> f64 {
    let start = ProcessTime::now();
    run(task, threads);
    start.elapsed().as_secs_f64()
}

/// The same work in turn, so that a change of the machine's speed meets all alike.
fn summary() {
    let tasks = [TYPED, FORMULA, SUM].map(|text| task(text, TRIALS));
    let cases = tasks.iter().flat_map(|task| [1, 2].map(|threads| (task, threads)));
    let cases: Vec<_> = cases.collect();
    let rounds: Vec<Vec<f64>> = (0..ROUNDS)
        .map(|_| cases.iter().map(|&(task, threads)| seconds(task, threads)).collect())
        .collect();
    let column = |case: usize| rounds.iter().map(|round| round[case]).collect::<Vec<_>>();
    println!("million trials per second of CPU time, median of {ROUNDS} runs in turn");
    for (name, case) in [("plane, typed", 0), ("plane, formula", 2), ("sum", 4)] {
        let [one, two] = [case, case + 1].map(|case| TRIALS as f64 / 1e6 / median(column(case)));
        println!("  {name:<16} {one:6.1} on one thread, {two:6.1} on two");
    }
    let ratios = column(2).iter().zip(column(0)).map(|(formula, typed)| formula / typed).collect();
    println!("formula / typed, one thread: {:.2}", median(ratios));
}

fn main() {
    let mut criterion = Criterion::default().with_measurement(CpuTime).configure_from_args();
    whole_runs(&mut criterion);
    without_trials(&mut criterion);
    criterion.final_summary();
    // `cargo test --benches` only tries whether everything runs
    if !std::env::args().any(|argument| argument == "--test" || argument == "--list") {
        summary();
    }
}
