//! What a draw costs, shape by shape: the sum of sixteen quantities of a shape less the sum of
//! eight. Each draw has the addition of its value in it.
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(missing_docs, clippy::unwrap_used)]

mod measure;

use criterion::Criterion;
use serde_json::{Value, json};

use measure::cpu_time::{CpuTime, criterion};
use measure::difference::{difference, run};
use measure::generated::sum_of;

const TRIALS: u64 = 1 << 18;

/// Every shape that an input can have by itself. Together these cover all methods of drawing.
fn shapes() -> Vec<Value> {
    let values: Vec<f64> = (0..1000).map(|i| f64::from(i).sqrt()).collect();
    vec![
        json!({"distribution": "rectangular", "mean": 1, "half_width": 0.1}),
        json!({"distribution": "normal", "mean": 1, "std": 0.1}),
        json!({"distribution": "triangular", "mean": 1, "half_width": 0.1}),
        json!({"distribution": "trapezoidal", "mean": 1, "half_width": 0.1, "beta": 0.5}),
        json!({"distribution": "curvilinear-trapezoid", "lower": 0, "upper": 1, "inexactness": 0.1}),
        json!({"distribution": "arcsine", "mean": 1, "half_width": 0.1}),
        json!({"distribution": "t", "mean": 1, "scale": 0.1, "dof": 8}),
        json!({"distribution": "readings", "values": [9.9, 10.0, 10.1, 10.3, 9.8]}),
        json!({"distribution": "exponential", "mean": 1}),
        json!({"distribution": "gamma", "shape": 2.5, "rate": 1}),
        json!({"distribution": "lognormal", "mean": 1, "std": 0.1}),
        json!({"distribution": "beta", "alpha": 2, "beta": 3}),
        json!({"distribution": "log-uniform", "lower": 1, "upper": 10}),
        json!({"distribution": "poisson-count", "count": 12}),
        json!({"distribution": "samples", "values": values}),
    ]
}

fn draws(criterion: &mut Criterion<CpuTime>) {
    let mut group = criterion.benchmark_group("draw");
    for shape in shapes() {
        let (more, less) = (sum_of(16, &shape, TRIALS), sum_of(8, &shape, TRIALS));
        let (more, less) = (more.unwrap(), less.unwrap());
        let name = shape["distribution"].as_str().unwrap();
        difference(&mut group, name, 8 * TRIALS, || run(&more), || run(&less));
    }
    group.finish();
}

fn main() {
    let mut criterion = criterion();
    draws(&mut criterion);
    criterion.final_summary();
}
