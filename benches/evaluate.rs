//! What evaluating a model costs a trial: a whole run less one that draws the same inputs and adds
//! them up.
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(missing_docs, clippy::unwrap_used)]

mod measure;

use criterion::Criterion;
use gumption::task::Task;

use measure::cpu_time::{CpuTime, criterion};
use measure::difference::{difference, run};
use measure::generated;
use measure::workloads::{PLANE, PLANE_FORMULA, model};

const TRIALS: u64 = 1 << 18;

/// Of the models that cost a hundred times as much.
const FEWER: u64 = 1 << 14;

/// Operations of the long formula, and how many the short one has less.
const OPERATIONS: [usize; 2] = [10_000, 5_000];

/// The nine inputs of the plane, added up.
fn inputs_of_the_plane() -> Task {
    let mut file: serde_json::Value = serde_json::from_str(PLANE_FORMULA).unwrap();
    let names: Vec<String> = file["inputs"].as_object().unwrap().keys().cloned().collect();
    file["equations"] = serde_json::json!({"y": names.join(" + ")});
    file["outputs"] = serde_json::json!({"y": {}});
    file["check_units"] = false.into();
    model(&file.to_string(), TRIALS).unwrap()
}

fn models(criterion: &mut Criterion<CpuTime>) {
    let mut group = criterion.benchmark_group("evaluate");
    let inputs = inputs_of_the_plane();
    for (name, text) in [("plane, typed", PLANE), ("plane, formula", PLANE_FORMULA)] {
        let plane = model(text, TRIALS).unwrap();
        difference(&mut group, name, TRIALS, || run(&plane), || run(&inputs));
    }

    let [long, short] = OPERATIONS.map(|n| generated::formula(n, FEWER).unwrap());
    let operations = (OPERATIONS[0] - OPERATIONS[1]) as u64;
    let elements = operations * FEWER;
    difference(&mut group, "an operation of 10,000", elements, || run(&long), || run(&short));

    let correlated = generated::correlated(1000, FEWER).unwrap();
    let independent = generated::sum(1000, FEWER).unwrap();
    // finding the joint draw is not part of a trial and is kept by the task after the first run
    run(&correlated);
    let more = || run(&correlated);
    difference(&mut group, "correlating 1,000 inputs", FEWER, more, || run(&independent));
    group.finish();
}

fn main() {
    let mut criterion = criterion();
    models(&mut criterion);
    criterion.final_summary();
}
