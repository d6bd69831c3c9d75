//! The probability that Monte Carlo coverage intervals hold, under exactly known distributions.

#![allow(clippy::manual_div_ceil, clippy::manual_is_multiple_of)] // as the Supplement writes it

use std::f64::consts::{PI, SQRT_2};
use std::path::Path;

use gumption::file::read_text;
use gumption::propagate::{Control, evaluate};
use gumption::task::{Coverage, Task, Trials};
use statrs::distribution::{Beta, ContinuousCDF};

/// Outputs whose distributions are known exactly.
const MODEL: &str = r#"{
  "inputs": {
    "x": {"distribution": "normal", "mean": 0, "std": 1},
    "a": {"distribution": "rectangular", "lower": 0, "upper": 1},
    "b": {"distribution": "rectangular", "lower": 0, "upper": 1},
    "c": {"distribution": "rectangular", "lower": 0, "upper": 1},
    "d": {"distribution": "rectangular", "lower": 0, "upper": 1},
    "phase": {"unit": "deg", "distribution": "rectangular", "mean": 0, "half_width": 180}
  },
  "equations": {
    "normal": "x",
    "two": "a + b",
    "four": "a + b + c + d",
    "arcsine": "sin(phase)",
    "exponential": "-ln(a)"
  },
  "outputs": {"normal": {}, "two": {}, "four": {}, "arcsine": {}, "exponential": {}}
}"#;

/// Their distribution functions, in order.
const EXACT: [fn(f64) -> f64; 5] = [
    |x| 0.5 * statrs::function::erf::erfc(-x / SQRT_2),
    |x| irwin_hall(2, x),
    |x| irwin_hall(4, x),
    |x| 0.5 + x.clamp(-1.0, 1.0).asin() / PI,
    |x| -(-x.max(0.0)).exp_m1(),
];

/// The distribution function of the sum of n rectangular quantities on (0, 1):
/// the sum over k <= x of (-1)^k C(n, k) (x - k)^n / n!.
fn irwin_hall(n: i32, x: f64) -> f64 {
    let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
    (0..=n)
        .filter(|&k| f64::from(k) < x)
        .map(|k| {
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            let ways = factorial(n) / (factorial(k) * factorial(n - k));
            sign * ways * (x - f64::from(k)).powi(n) / factorial(n)
        })
        .sum::<f64>()
        .min(1.0)
}

fn task(text: &str, trials: u64, p: f64) -> Task {
    let mut task = read_text("intervals", text, Path::new(""), &[]).expect("a right model").task;
    task.settings.trials = Trials::Fixed(trials);
    task.settings.coverage = Coverage::Probability(p);
    task
}

/// q of JCGM 101, 7.7.2, from the text of the standard: pM if that is an integer, else the integer
/// part of pM + 1/2. The probability comes as per mille, so that no rounding is in it.
fn width_in_ranks(trials: u64, per_mille: u64) -> u64 {
    let product = trials * per_mille;
    if product % 1000 == 0 { product / 1000 } else { (2 * product + 1000) / 2000 }
}

/// r of 7.7.2: (M - q)/2 if that is an integer, else the integer part of (M - q + 1)/2.
fn lower_rank(trials: u64, q: u64) -> u64 {
    if (trials - q) % 2 == 0 { (trials - q) / 2 } else { (trials - q + 1) / 2 }
}

/// The largest distance between the empirical distribution function and the exact one.
fn kolmogorov(mut sample: Vec<f64>, exact: impl Fn(f64) -> f64) -> f64 {
    sample.sort_by(f64::total_cmp);
    let n = sample.len() as f64;
    sample
        .iter()
        .enumerate()
        .map(|(i, &x)| {
            let at = exact(x);
            (at - i as f64 / n).max((i + 1) as f64 / n - at)
        })
        .fold(0.0, f64::max)
}

/// The content of the symmetric intervals over many seeds follows Beta(q, M - q + 1).
///
/// A Kolmogorov-Smirnov distance above 2.82/sqrt(n) has a probability of 2 exp(-2 * 2.82^2) =
/// 2.5e-7 under the law; five outputs make a false failure of one call 1.3e-6 likely. Seeds are
/// fixed, so it fails for all or for none.
fn contents_follow_beta(trials: u64, per_mille: u64, seeds: u64, control: &Control<'_>) {
    let mut task = task(MODEL, trials, per_mille as f64 / 1000.0);
    let mut contents = [const { Vec::new() }; EXACT.len()];
    for seed in 1..=seeds {
        task.settings.seed = seed;
        let evaluation = evaluate(&task, control).expect("an evaluation");
        for ((output, exact), contents) in
            evaluation.rows[0].outputs.iter().zip(EXACT).zip(&mut contents)
        {
            let [low, high] = output.monte_carlo.as_deref().expect("trials").symmetric_interval;
            contents.push(exact(high) - exact(low));
        }
    }
    let q = width_in_ranks(trials, per_mille);
    let law = Beta::new(q as f64, (trials - q + 1) as f64).expect("a beta distribution");
    for (number, contents) in contents.into_iter().enumerate() {
        let distance = kolmogorov(contents, |x| law.cdf(x));
        let limit = 2.82 / (seeds as f64).sqrt();
        assert!(distance < limit, "output {number}, M = {trials}: {distance} above {limit}");
    }
}

fn one_thread() -> Control<'static> {
    Control::default().with_threads(1)
}

#[test]
fn contents_at_95_percent() {
    contents_follow_beta(1000, 950, 1000, &one_thread());
}

#[test]
fn contents_where_the_product_is_no_integer() {
    contents_follow_beta(1013, 950, 1000, &one_thread());
}

#[test]
fn contents_at_one_half() {
    contents_follow_beta(2000, 500, 1000, &one_thread());
}

#[test]
fn contents_at_99_percent() {
    contents_follow_beta(1500, 990, 1000, &one_thread());
}

/// More trials than a pilot has, so that only the tails and the middle are kept.
#[test]
fn contents_from_kept_tails() {
    contents_follow_beta(70_000, 950, 200, &Control::default());
}

/// With the least memory, so that the trials are made in several passes.
#[test]
fn contents_from_several_passes() {
    let memory = 64 << 10;
    contents_follow_beta(70_000, 900, 20, &Control::default().with_memory(memory));
}

/// The shortest interval is no longer than the symmetric one, and holds its share of the
/// probability but for the optimism of a shortest one. For the exponential it begins near 0.
#[test]
fn shortest_intervals_hold_what_they_say() {
    let task = task(MODEL, 200_000, 0.95);
    let evaluation = evaluate(&task, &Control::default()).expect("an evaluation");
    for (output, exact) in evaluation.rows[0].outputs.iter().zip(EXACT) {
        let figures = output.monte_carlo.as_deref().expect("trials");
        let length = |[low, high]: [f64; 2]| high - low;
        assert!(length(figures.shortest_interval) <= length(figures.symmetric_interval));
        let [low, high] = figures.shortest_interval;
        // standard deviation of a content: sqrt(0.95 * 0.05 / 2e5) = 4.9e-4; ten of them leave room
        // for the optimism and make a false failure less likely than 1e-9
        assert!((exact(high) - exact(low) - 0.95).abs() < 4.9e-3);
    }
    let exponential = evaluation.rows[0].outputs[4].monte_carlo.as_deref().expect("trials");
    assert!(exponential.shortest_interval[0] < 0.01);
}

/// The ranks of clause 7.7 seen from outside: how many of the very same trials lie below each end.
/// The standard's q reaches 0 or M with a few trials, which leave no interval or no trial outside; the
/// ends are then neighbours, or the extreme trials.
fn ends_are_order_statistics(trials: u64, per_mille: u64) {
    let model = |extra: &str, outputs: &str| {
        format!(
            r#"{{"inputs": {{"x": {{"distribution": "normal", "mean": 0, "std": 1}}}},
                "equations": {{"y": "x * x * x + x"{extra}}}, "outputs": {{"y": {{}}{outputs}}}}}"#
        )
    };
    let p = per_mille as f64 / 1000.0;
    let found = evaluate(&task(&model("", ""), trials, p), &Control::default());
    let figures = found.expect("an evaluation").rows.remove(0).outputs.remove(0);
    let figures = figures.monte_carlo.expect("trials");
    let [low, high] = figures.symmetric_interval;
    let [first, last] = figures.shortest_interval;
    let extra = format!(
        r#", "below": "y < ({low:?})", "upto": "y <= ({high:?})",
           "inside": "(y >= ({first:?})) * (y <= ({last:?}))""#
    );
    let counting = model(
        &extra,
        r#", "below": {"tolerance": {"lower": 0.5}}, "upto": {"tolerance": {"lower": 0.5}},
            "inside": {"tolerance": {"lower": 0.5}}"#,
    );
    let counts = evaluate(&task(&counting, trials, p), &Control::default());
    let counts = counts.expect("an evaluation").rows.remove(0).outputs;
    let count = |output: usize| {
        let share = counts[output].monte_carlo.as_deref().expect("trials").inside;
        (share * trials as f64).round() as u64
    };
    let q = width_in_ranks(trials, per_mille).clamp(1, trials - 1);
    let r = lower_rank(trials, q);
    assert_eq!(count(1) + 1, r, "lower end at M = {trials}, p = {p}");
    assert_eq!(count(2), r + q, "upper end at M = {trials}, p = {p}");
    assert_eq!(count(3), q + 1, "shortest interval at M = {trials}, p = {p}");
}

#[test]
fn ends_are_the_order_statistics_of_clause_7_7() {
    for (trials, per_mille) in
        [(1000, 950), (999, 950), (10, 500), (13, 777), (100_007, 950), (100_000, 951)]
    {
        ends_are_order_statistics(trials, per_mille);
    }
}

#[test]
fn ends_of_very_few_trials_are_order_statistics() {
    for trials in 2..40 {
        for per_mille in [1, 500, 950, 999] {
            ends_are_order_statistics(trials, per_mille);
        }
    }
}

/// How often the intervals of 10,000 seeds hold a value drawn anew, both kinds of interval and five
/// distributions, with so many trials that only tails are kept: a binomial count. It lies beyond
/// five standard deviations once in 1.7 million, so ten of them fail falsely with a probability of
/// 6e-6. The symmetric interval holds q/(M + 1) on average; the shortest one, chosen among all,
/// a little less, at 70,000 trials by less than 0.001.
#[test]
#[ignore = "heavy: run by .ci/extra"]
fn coverage_over_ten_thousand_seeds() {
    const SEEDS: u64 = 10_000;
    const TRIALS: u64 = 70_000;
    let mut task = task(MODEL, TRIALS, 0.95);
    let mut held = [[0u64; 2]; EXACT.len()];
    // the values drawn anew, as shares of the distribution: a Weyl sequence shuffled by its bits
    let share = |seed: u64, output: usize| {
        let mut bits = (seed * 8 + output as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        for factor in [0xbf58_476d_1ce4_e5b9, 0x94d0_49bb_1331_11eb] {
            bits = (bits ^ (bits >> 30)).wrapping_mul(factor);
        }
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    };
    for seed in 1..=SEEDS {
        task.settings.seed = seed;
        let evaluation = evaluate(&task, &Control::default()).expect("an evaluation");
        for (number, output) in evaluation.rows[0].outputs.iter().enumerate() {
            let figures = output.monte_carlo.as_deref().expect("trials");
            let drawn = share(seed, number);
            let intervals = [figures.symmetric_interval, figures.shortest_interval];
            for (held, [low, high]) in held[number].iter_mut().zip(intervals) {
                let exact = EXACT[number];
                *held += u64::from(exact(low) <= drawn && drawn <= exact(high));
            }
        }
    }
    let n = SEEDS as f64;
    let band = 5.0 * (0.95 * 0.05 / n).sqrt();
    for (number, held) in held.into_iter().enumerate() {
        let shares = held.map(|held| held as f64 / n);
        println!("output {number}: symmetric {}, shortest {}", shares[0], shares[1]);
        assert!((shares[0] - 0.95).abs() < band, "output {number}: {shares:?}");
        assert!((shares[1] - 0.95).abs() < band + 0.001, "output {number}: {shares:?}");
    }
}
