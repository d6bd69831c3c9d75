//! What the fold costs a trial: moments, both coverage intervals, the median, and with several
//! outputs their correlations. A whole run less the same trials generated and hashed.
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(missing_docs, clippy::unwrap_used)]

mod measure;

use std::hint::black_box;

use criterion::{Criterion, Throughput};
use gumption::propagate::{Control, trial_hash};
use gumption::task::Task;

use measure::cpu_time::{CpuTime, criterion};
use measure::difference::{difference, run};
use measure::generated;
use measure::workloads::{PLANE, SUM, model};

const TRIALS: u64 = 1_000_000;

fn hash(task: &Task) {
    let control = Control::default().with_threads(1);
    black_box(trial_hash(task, TRIALS, &control).unwrap());
}

fn folds(criterion: &mut Criterion<CpuTime>) {
    let mut group = criterion.benchmark_group("fold");
    let cases = [
        ("sum of four", model(SUM, TRIALS).unwrap()),
        ("plane", model(PLANE, TRIALS).unwrap()),
        ("two outputs", generated::outputs(2, TRIALS).unwrap()),
        ("ten outputs", generated::outputs(10, TRIALS).unwrap()),
    ];
    for (name, task) in &cases {
        difference(&mut group, name, TRIALS, || run(task), || hash(task));
    }
    group.throughput(Throughput::Elements(TRIALS));
    for (name, task) in &cases {
        group.bench_function(format!("{name}, generated and hashed"), |b| b.iter(|| hash(task)));
    }
    group.finish();
}

fn main() {
    let mut criterion = criterion();
    folds(&mut criterion);
    criterion.final_summary();
}
