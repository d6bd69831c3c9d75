//! Rooms that the library does not open to callers, measured as the difference of two whole runs
//! that differ in that room alone.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkGroup, Throughput};
use gumption::propagate::{Control, evaluate};
use gumption::task::Task;

use super::cpu_time::{CpuTime, cpu_seconds};

/// One evaluation on one thread.
#[allow(clippy::unwrap_used)] // the benches' own tasks can be evaluated
pub fn run(task: &Task) {
    let control = Control::default().with_threads(1);
    black_box(evaluate(black_box(task), &control).unwrap());
}

/// Measures the CPU time of `more` less that of `less`, in turn, as the time of `elements`
/// elements.
pub fn difference(
    group: &mut BenchmarkGroup<'_, CpuTime>,
    name: &str,
    elements: u64,
    mut more: impl FnMut(),
    mut less: impl FnMut(),
) {
    group.throughput(Throughput::Elements(elements));
    group.bench_function(name, |bencher| {
        bencher.iter_custom(|times| {
            let each = |_| cpu_seconds(&mut more) - cpu_seconds(&mut less);
            let seconds: f64 = (0..times).map(each).sum();
            // noise can turn a difference of nothing around; a duration cannot be negative
            Duration::from_secs_f64(seconds.max(1e-9))
        });
    });
}
