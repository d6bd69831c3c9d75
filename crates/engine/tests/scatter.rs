//! Numerical standard errors against the scatter between seeds.
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(clippy::unwrap_used, clippy::panic)]

use std::path::Path;

use gumption_engine::propagate::monte_carlo::MonteCarlo;
use gumption_engine::propagate::{Control, Evaluation, evaluate, warnings};
use gumption_engine::task::{Coverage, Task, Trials};
use gumption_files as file;

/// A model of one output `y`.
fn task(inputs: &str, formula: &str) -> Task {
    let text = format!(
        r#"{{"inputs": {{{inputs}}}, "equations": {{"y": "{formula}"}}, "outputs": {{"y": {{}}}}}}"#
    );
    let mut task = file::read_text("m.json", &text, Path::new(""), &[]).unwrap().task;
    task.settings.coverage = Coverage::Probability(0.95);
    task
}

fn run(task: &mut Task, seed: u64, trials: u64) -> Evaluation {
    task.settings.seed = seed;
    task.settings.trials = Trials::Fixed(trials);
    evaluate(task, &Control::default()).unwrap()
}

fn figures(task: &mut Task, seed: u64, trials: u64) -> MonteCarlo {
    *run(task, seed, trials).rows[0].outputs[0].monte_carlo.clone().unwrap()
}

const SEEDS: u64 = 60;

/// The standard deviation of a figure between the seeds that state an error over the root mean square
/// of that, and the share of these seeds.
fn ratio(all: &[MonteCarlo], of: impl Fn(&MonteCarlo) -> (f64, Option<f64>)) -> (f64, f64) {
    let stated = all.iter().map(of).filter_map(|(value, error)| Some((value, error?)));
    let (values, errors): (Vec<f64>, Vec<f64>) = stated.unzip();
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let scatter = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0);
    let stated = errors.iter().map(|e| e * e).sum::<f64>() / errors.len().max(1) as f64;
    ((scatter / stated).sqrt(), n / all.len() as f64)
}

const NORMAL: &str = r#""x": {"distribution": "normal", "mean": 0, "std": 1}"#;

/// What the ends of the shortest interval scatter by over what they say, of one model.
fn of_ends(inputs: &str, formula: &str, seeds: u64, trials: u64) -> [f64; 2] {
    let mut task = task(inputs, formula);
    let all: Vec<MonteCarlo> = (1..=seeds).map(|s| figures(&mut task, s, trials)).collect();
    assert!(all.iter().all(|found| found.shortest_unique), "{inputs} {formula}");
    [0, 1].map(|end| {
        let of = |found: &MonteCarlo| {
            let error = found.errors.shortest_interval[end];
            (found.shortest_interval[end], Some(error).filter(|error| error.is_finite()))
        };
        let (ratio, stated) = ratio(&all, of);
        assert!(stated > 0.9, "{inputs} {formula}: {stated} of the seeds");
        ratio
    })
}

/// Models, and where the mode of their output lies: inside (the cube-root law), at the lower or the
/// upper bound (one end comes as near to it as the least trial, the other is a quantile).
const ENDS: [(&str, &str); 13] = [
    (r#"{"distribution": "exponential", "mean": 1}"#, "x"),
    (r#"{"distribution": "normal", "mean": 0, "std": 1}"#, "abs(x)"),
    (r#"{"distribution": "normal", "mean": 0.2, "std": 1}"#, "abs(x)"),
    (r#"{"distribution": "beta", "alpha": 1, "beta": 3}"#, "x"),
    (r#"{"distribution": "beta", "alpha": 5, "beta": 1}"#, "x"),
    // a triangular one with its mode at the lower bound
    (r#"{"distribution": "rectangular", "lower": 0, "upper": 1}"#, "1 - sqrt(x)"),
    // chi-squared of one and of two degrees of freedom
    (r#"{"distribution": "normal", "mean": 0, "std": 1}"#, "x^2"),
    (r#"{"distribution": "gamma", "shape": 1, "rate": 0.5}"#, "x"),
    (r#"{"distribution": "normal", "mean": 0, "std": 1}"#, "x"),
    (r#"{"distribution": "lognormal", "mean": 1, "std": 1}"#, "x"),
    (r#"{"distribution": "normal", "mean": 0, "std": 0.5}"#, "exp(x)"),
    (r#"{"distribution": "gamma", "shape": 2.5, "rate": 0.5}"#, "x"),
    (
        r#"{"distribution": "curvilinear-trapezoid", "lower": -1, "upper": 1, "inexactness": 0.3}"#,
        "x",
    ),
];

/// The ends of the shortest interval scatter as they say. A hundred seeds know a normal scatter to
/// 7 %, and that of an end at a bound, which is exponential, to 15 %. The lower end of a square is the
/// square of an exponential one: its kurtosis of 88 leaves the scatter of a hundred seeds known to
/// 47 % only, mostly too small, as the rare large ones are not among them. The seeds are fixed.
/// Before, the ends at a bound were stated 3 to 100 times too large.
#[test]
fn ends_of_the_shortest_interval_scatter_as_stated() {
    for (input, formula) in ENDS {
        let found = of_ends(&format!(r#""x": {input}"#), formula, 100, 30_000);
        let of_square = if formula == "x^2" { 0.35..1.9 } else { 0.65..1.45 };
        let limits = [of_square, 0.65..1.45];
        for (ratio, limits) in found.iter().zip(limits) {
            assert!(limits.contains(ratio), "{input} {formula}: {found:?}");
        }
    }
}

/// The whole study: 600 seeds know the scatters to 3 % and 6 %, and that of the lower end of a square
/// to sqrt(87/2400) = 19 %, mostly too small.
#[test]
#[ignore = "heavy: run by .ci/extra"]
fn ends_of_the_shortest_interval_scatter_as_stated_over_600_seeds() {
    for trials in [10_000, 30_000, 100_000] {
        for (input, formula) in ENDS {
            let found = of_ends(&format!(r#""x": {input}"#), formula, 600, trials);
            println!("{trials:7} {input} {formula}: {:.2} {:.2}", found[0], found[1]);
            let of_square = if formula == "x^2" { 0.5..1.6 } else { 0.7..1.35 };
            for (ratio, limits) in found.iter().zip([of_square, 0.7..1.35]) {
                assert!(limits.contains(ratio), "{trials} {input} {formula}: {found:?}");
            }
        }
    }
}

/// Where the density is flat or rises to both limits, there is no one shortest interval: no error is
/// stated, and the interval to be stated is the symmetric one. Before, the errors of a rectangular
/// output were 2.7 times too small.
#[test]
fn equally_short_intervals_are_said_to_be() {
    let rectangular = r#""x": {"distribution": "rectangular", "mean": 0, "half_width": 1}"#;
    let arcsine = r#""x": {"distribution": "arcsine", "mean": 0, "half_width": 1}"#;
    let beta = r#""x": {"distribution": "beta", "alpha": 0.3, "beta": 0.3}"#;
    for (inputs, formula) in [(rectangular, "x"), (arcsine, "x"), (beta, "x")] {
        let mut task = task(inputs, formula);
        for (seed, trials) in [(1, 50_000), (2, 50_000), (3, 1_000_000), (4, 3_000_000)] {
            let found = figures(&mut task, seed, trials);
            assert!(!found.shortest_unique, "{inputs}");
            assert!(found.errors.shortest_interval.iter().all(|error| error.is_nan()));
            let stated = found.stated_interval();
            assert!(!stated.shortest);
            assert_eq!(stated.ends, found.symmetric_interval);
        }
    }
}

/// A skew output states its shortest interval, a symmetric one the symmetric interval.
#[test]
fn skew_outputs_state_the_shortest_interval() {
    let exponential = r#""x": {"distribution": "exponential", "mean": 1}"#;
    let skew = figures(&mut task(exponential, "x"), 1, 100_000).stated_interval();
    // from 0 to -ln(0.05) = 2.996
    assert!(skew.shortest && skew.ends[0] < 0.01 && (skew.ends[1] - 2.996).abs() < 0.05);
    assert!(!figures(&mut task(NORMAL, "x"), 1, 100_000).stated_interval().shortest);
}

/// Skewness and kurtosis have honest errors or none. Of a lognormal distribution they were 2.4 and
/// 5.3 times too small: most parts of the trials have not seen the few that carry the moments.
#[test]
fn skewness_and_kurtosis_scatter_as_stated() {
    let lognormal = r#""x": {"distribution": "lognormal", "mean": 1, "std": 1}"#;
    let exponential = r#""x": {"distribution": "exponential", "mean": 1}"#;
    let rectangular = r#""x": {"distribution": "rectangular", "mean": 0, "half_width": 1}"#;
    let cases = [
        ("normal", NORMAL, 0.9),
        ("rectangular", rectangular, 0.9),
        ("exponential", exponential, 0.6),
        ("lognormal", lognormal, 0.0),
    ];
    for (name, inputs, least) in cases {
        let mut task = task(inputs, "x");
        let all: Vec<MonteCarlo> = (1..=SEEDS).map(|s| figures(&mut task, s, 50_000)).collect();
        let skewness = ratio(&all, |f| (f.skewness.unwrap(), f.errors.skewness));
        let kurtosis = ratio(&all, |f| (f.excess_kurtosis.unwrap(), f.errors.excess_kurtosis));
        for (ratio, stated) in [skewness, kurtosis] {
            assert!(stated >= least, "{name}: {stated} of the seeds");
            let honest = stated < 0.25 || (0.7..1.4).contains(&ratio);
            assert!(honest, "{name}: {ratio}, {stated} of the seeds");
        }
    }
}

/// 1/z with z about 0 has no expectation, nor has the exponential of a t. Their trials have no mean and no
/// standard deviation with any seed, a warning says so, and the output lies at the estimate by the law of
/// propagation: 1. An adaptive run watches the ends of the interval alone. Those of 1/z, z ~ N(1, 0.3),
/// were computed from 2e7 trials elsewhere: 0.63 and 2.41.
#[test]
fn tails_without_moments_are_said_to_be_heavy() {
    let z = r#""z": {"distribution": "normal", "mean": 1, "std": 0.3}"#;
    let t = r#""z": {"distribution": "t", "mean": 0, "scale": 0.5, "dof": 5}"#;
    for (inputs, formula) in [(z, "1/z"), (t, "exp(z)")] {
        let mut task = task(inputs, formula);
        for seed in 1..=3 {
            let evaluation = run(&mut task, seed, 1_000_000);
            let output = &evaluation.rows[0].outputs[0];
            let found = output.monte_carlo.as_deref().unwrap();
            assert_eq!((found.estimate, found.standard_uncertainty), (None, None), "{formula}");
            assert_eq!((found.errors.estimate, found.errors.standard_uncertainty), (None, None));
            assert_eq!(output.located(), Some((1.0, 0.0)), "{formula}");
            let noted = warnings(&task, &evaluation);
            assert!(noted.iter().any(|warning| warning.code() == "heavy-tails"), "{formula}");
            if formula == "1/z" {
                let [low, high] = found.symmetric_interval;
                assert!((low - 0.63).abs() < 0.005 && (high - 2.41).abs() < 0.02, "{low} {high}");
            }
        }
    }
    let mut adaptive = task(z, "1/z");
    adaptive.settings.trials = Trials::Adaptive;
    adaptive.settings.coverage = Coverage::Factor { factor: 2.0, fixed: false };
    (adaptive.settings.digits, adaptive.settings.seed) = (1, 3);
    let evaluation = evaluate(&adaptive, &Control::default()).unwrap();
    let found = evaluation.rows[0].outputs[0].monte_carlo.as_deref().unwrap();
    let end = found.adaptive.unwrap();
    assert!(found.estimate.is_none() && end.converged && found.trials < 1_000_000, "{end:?}");
    let noted = warnings(&adaptive, &evaluation);
    assert!(!noted.iter().any(|warning| warning.code() == "not-converged"));
    for (inputs, formula) in [(NORMAL, "x"), (NORMAL, "exp(x)"), (NORMAL, "x^2")] {
        let found = figures(&mut task(inputs, formula), 1, 1_000_000);
        assert!(!found.heavy_tailed && found.standard_uncertainty.is_some(), "{formula}");
    }
}

/// Correlation coefficients scatter between seeds as they say; where an output is heavy-tailed, none
/// says anything. For jointly normal outputs of coefficient 0.6 the error is (1 - r^2)/sqrt(M).
#[test]
fn correlations_have_numerical_standard_errors() {
    let text = r#"{"inputs": {
        "x": {"distribution": "normal", "mean": 0, "std": 0.6},
        "w": {"distribution": "normal", "mean": 0, "std": 0.8},
        "z": {"distribution": "normal", "mean": 1, "std": 0.3}},
        "equations": {"a": "x + w", "b": "x/0.6", "c": "1/z + x"},
        "outputs": {"a": {}, "b": {}, "c": {}}}"#;
    let mut task = file::read_text("m.json", text, Path::new(""), &[]).unwrap().task;
    let trials = 50_000;
    let mut values = Vec::new();
    let mut stated = Vec::new();
    for seed in 1..=SEEDS {
        let row = run(&mut task, seed, trials).rows.remove(0);
        let [ab, ac, bc] = row.correlation_errors[..] else { panic!("three pairs") };
        assert_eq!((ac, bc), (None, None));
        values.push(row.correlations[0]);
        stated.push(ab.unwrap());
    }
    let expected = (1.0 - 0.36) / (trials as f64).sqrt();
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let scatter = (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
    let rms = (stated.iter().map(|e| e * e).sum::<f64>() / n).sqrt();
    assert!((rms / expected - 1.0).abs() < 0.1, "{rms} for {expected}");
    assert!((scatter / rms - 1.0).abs() < 0.3, "{scatter} for {rms}");
}
